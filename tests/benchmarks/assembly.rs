//! Assembly of the stiffness at a million unknowns: preparation, first fill, refill, and memory.
//!
//! `cargo bench --bench assembly --no-run` names the program; `mpirun -n 2 PROGRAM [P1] [P2]` runs it. Prints one line
//! per element order: seconds of the slowest rank (median of five refills) and the growth of resident memory over all
//! ranks, which counts for the first one only: the second finds the first's memory free.

use mezha::body::{Body, Material};
use mezha::element::Order;
use mezha::geometry::Formula;
use mezha::mesh::{Graph, Partition, read_gmsh};
use mezha::petsc::{Session, partition};
use mezha::system::{Scene, fill_stiffness, prepare_stiffness, spaces};
use std::path::Path;
use std::rc::Rc;
use std::time::Instant;

fn main() {
    let session = Session::start(&[], &[]).expect("PETSc starts");
    let wanted: Vec<String> = std::env::args().skip(1).filter(|word| word.starts_with('P')).collect();
    for (order, refine) in [(Order::P1, 7), (Order::P2, 6)] {
        if wanted.is_empty() || wanted.contains(&format!("{order:?}")) {
            measure(&session, order, refine);
        }
    }
}

fn measure(session: &Session, order: Order, refine: usize) {
    let scene = scene(session, order, refine);
    let spaces = spaces(&scene, session.rank()).expect("supports agree");
    let space = &spaces[spaces.len() - 1];
    let before = resident(session);
    let none = Default::default();
    let (mut matrix, prepare) =
        timed(session, || prepare_stiffness(&scene, space, &none, session).expect("room for the stiffness"));
    let ((), fill) = timed(session, || fill_stiffness(&mut matrix, &scene, space, &none, session, |_, _| {}).expect("filled"));
    let memory = resident(session) - before;
    let mut refills: Vec<f64> = (0..5)
        .map(|_| {
            timed(session, || {
                matrix.zero_entries().expect("zeros");
                fill_stiffness(&mut matrix, &scene, space, &none, session, |_, _| {}).expect("filled again");
            })
            .1
        })
        .collect();
    refills.sort_by(f64::total_cmp);
    if session.rank() == 0 {
        println!(
            "{order:?}: {} unknowns, {} entries on {} ranks: prepare {prepare:.3} s, first fill {fill:.3} s, refill {:.3} s, {memory:.0} MiB",
            2 * space.numbering.node_count(),
            matrix.nonzeros().expect("counted"),
            session.size(),
            refills[2]
        );
    } else {
        matrix.nonzeros().expect("counted");
    }
}

/// The bars of example 1, free of supports and contacts.
fn scene(session: &Session, order: Order, refine: usize) -> Scene {
    let mesh =
        read_gmsh(Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/cases/bars_inclined/bars.msh"))).expect("the case's mesh");
    let graph = Graph::new(&mesh, &[]);
    let ranks = partition(session, session.size(), &graph.offsets, &graph.neighbours, &graph.weights, None).expect("a partition");
    let body = |name: &String| Body {
        name: name.clone(),
        material: Material { young: 7000.0, poisson: 0.227 },
        force: [Formula::constant(0.0), Formula::constant(0.0)],
    };
    Scene {
        bodies: mesh.bodies.iter().map(body).collect(),
        partition: Rc::new(Partition::new(&mesh, &ranks, session.size())),
        order,
        refine,
        supports: Vec::new(),
        loads: Vec::new(),
        pairs: Vec::new(),
        mesh,
    }
}

/// Wall seconds of the slowest rank.
fn timed<T>(session: &Session, work: impl FnOnce() -> T) -> (T, f64) {
    session.barrier();
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
