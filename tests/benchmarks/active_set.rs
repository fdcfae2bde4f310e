//! One multiplier that opens, at a million unknowns and 500 segments: seconds until all blocks are those of the new set.
//!
//! `cargo bench --bench active_set --no-run` names the program; `mpirun -n 2 PROGRAM` runs it. Prints a line for each pair of
//! spaces and number of multipliers that change: seconds of the slowest rank, median of nine.

#[path = "../support/bars.rs"]
mod bars;
#[path = "../support/contact.rs"]
mod contact;

use mezha::contact::{MultiplierSpace, Stabilise};
use mezha::element::Order;
use mezha::petsc::Session;
use mezha::system::{Discretisation, Preconditioning, SaddlePoint, SolverChoice, System, interpolations, load, nodal_forces};
use std::time::Instant;

fn main() {
    let session = Session::start(&[], &[]).expect("PETSc starts");
    for (order, refine, space) in [(Order::P1, 7, MultiplierSpace::P0), (Order::P2, 6, MultiplierSpace::P1Discontinuous)] {
        let scene = contact::with_contact(bars::scene(&session, order, refine, false), space, 500, Stabilise::Off);
        let problem = Discretisation::new(scene, &session).expect("a discretisation");
        let load = load(&problem, &nodal_forces(&problem, &session).expect("loads"));
        let choice = SolverChoice::FieldSplit;
        let blocks = SaddlePoint::new(&problem, load, choice.form(), &session).expect("blocks");
        let interpolations = interpolations(&problem, &session).expect("interpolations").into();
        let mut system =
            System::new(&problem, blocks, &interpolations, choice, Preconditioning::Sweep, &session).expect("a system");
        for count in [1, 10, 100, problem.multiplier_count()] {
            let mut active = system.active().to_vec();
            let mut times: Vec<f64> = (0..9)
                .map(|_| {
                    active.iter_mut().take(count).for_each(|active| *active ^= true);
                    timed(&session, || system.set_active(&active).expect("a set"))
                })
                .collect();
            times.sort_by(f64::total_cmp);
            if session.rank() == 0 {
                let (unknowns, ranks) = (problem.unknown_count(), session.size());
                println!(
                    "{order:?} {space:?}: {unknowns} unknowns on {ranks} ranks, {count} of {} multipliers: {:.2} ms",
                    active.len(),
                    1e3 * times[4]
                );
            }
        }
    }
}

/// Wall seconds of the slowest rank.
fn timed(session: &Session, work: impl FnOnce()) -> f64 {
    session.barrier();
    let start = Instant::now();
    work();
    let mut seconds = [start.elapsed().as_secs_f64()];
    session.max(&mut seconds);
    seconds[0]
}
