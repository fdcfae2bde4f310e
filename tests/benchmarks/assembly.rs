//! Stiffness of all levels at a million unknowns: seconds and memory, with all rows stored and with even macro triangles as wholes.
//!
//! `cargo bench --bench assembly --no-run` names the program; `mpirun -n 2 PROGRAM [P1] [P2]` runs it. Prints one line for
//! each element order and form: seconds of the slowest rank (median of five) and the growth of resident memory over all
//! ranks, which counts for the first one only: the others find the first's memory free.

#[path = "../support/bars.rs"]
mod bars;

use mezha::discretisation::{Discretisation, Form};
use mezha::element::Order;
use mezha::multigrid::Elastic;
use mezha::petsc::Session;
use std::time::Instant;

fn main() {
    let session = Session::start(&[], &[]).expect("PETSc starts");
    let wanted: Vec<String> = std::env::args().skip(1).filter(|word| word.starts_with('P')).collect();
    for (order, refine) in [(Order::P1, 7), (Order::P2, 6)] {
        if wanted.is_empty() || wanted.contains(&format!("{order:?}")) {
            let scene = bars::scene(&session, order, refine, false);
            let problem = Discretisation::new(scene, &session).expect("a discretisation");
            measure(&session, &problem, Form::Augmented, &format!("{order:?}, all levels, whole"));
            measure(&session, &problem, Form::Plain, &format!("{order:?}, finest level, stored"));
        }
    }
}

fn measure(session: &Session, problem: &Discretisation, form: Form, words: &str) {
    let before = resident(session);
    let make = || {
        let load = vec![0.0; problem.finest().local_unknowns()];
        Elastic::alone(problem, load, form).expect("a stiffness")
    };
    let (elastic, first) = timed(session, make);
    let memory = resident(session) - before;
    drop(elastic);
    let mut times: Vec<f64> = (0..5).map(|_| timed(session, make).1).collect();
    times.sort_by(f64::total_cmp);
    if session.rank() == 0 {
        let unknowns = problem.unknown_count();
        println!(
            "{words}: {unknowns} unknowns on {} ranks: first {first:.3} s, again {:.3} s, {memory:.0} MiB",
            session.size(),
            times[2]
        );
    }
}

/// Wall seconds of the slowest rank.
fn timed<T>(session: &Session, work: impl FnOnce() -> T) -> (T, f64) {
    session.any(true);
    let start = Instant::now();
    let result = work();
    let mut seconds = [start.elapsed().as_secs_f64()];
    session.max(&mut seconds);
    (result, seconds[0])
}

/// Resident memory of all ranks, MiB.
fn resident(session: &Session) -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:")).unwrap_or("0");
    let own = line.split_whitespace().next().and_then(|kib| kib.parse::<f64>().ok()).unwrap_or(0.0) / 1024.0;
    let mut sum = [own];
    session.sum(&mut sum);
    sum[0]
}
