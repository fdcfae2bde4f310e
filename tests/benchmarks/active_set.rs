//! One multiplier that opens, at a million unknowns and 500 segments, and on a seam of 50 000 segments: seconds until all blocks
//! are those of the new set.
//!
//! `cargo bench --bench active_set --no-run` names the program; `mpirun -n 2 PROGRAM` runs it. Prints a line for each pair of
//! spaces and number of multipliers that change: seconds of the slowest rank, median of nine.

#[path = "../support/bars.rs"]
mod bars;
#[path = "../support/contact.rs"]
mod contact;
#[path = "../support/mesh.rs"]
#[allow(dead_code)] // Other programs use the rest.
mod meshes;

use mezha::contact::{MultiplierSpace, Stabilise};
use mezha::discretisation::{Discretisation, Scene, load, nodal_forces};
use mezha::element::Order;
use mezha::mesh::parse_gmsh;
use mezha::multigrid::interpolations;
use mezha::petsc::Session;
use mezha::system::{Preconditioning, SaddlePoint, SolverChoice, System};
use std::time::Instant;

/// Segments of the long seam.
const SEGMENTS: usize = 50_000;

fn main() {
    let session = Session::start(&[], &[]).expect("PETSc starts");
    let bars = |order, refine| bars::scene(&session, order, refine, false);
    measure(contact::with_contact(bars(Order::P1, 7), MultiplierSpace::P0, 500, Stabilise::Off), &session);
    measure(contact::with_contact(bars(Order::P2, 6), MultiplierSpace::P1Discontinuous, 500, Stabilise::Off), &session);
    let text = meshes::Mesh::long_seam(SEGMENTS / 5).text();
    let mesh = parse_gmsh(text.as_bytes(), "seam.msh".as_ref(), Default::default()).expect("a mesh");
    let seam = bars::on(mesh, &session, Order::P1, 3);
    measure(contact::with_contact(seam, MultiplierSpace::P0, SEGMENTS, Stabilise::Off), &session);
}

fn measure(scene: Scene, session: &Session) {
    let start = Instant::now();
    let (order, space) = (scene.order, scene.pairs[0].space);
    let problem = Discretisation::new(scene, session).expect("a discretisation");
    let load = load(&problem, &nodal_forces(&problem).expect("loads"));
    let choice = SolverChoice::FieldSplit;
    let blocks = SaddlePoint::new(&problem, load, choice.form()).expect("blocks");
    let interpolations = interpolations(&problem).into();
    let mut system = System::new(&problem, blocks, &interpolations, choice, Preconditioning::Sweep).expect("a system");
    let (unknowns, ranks, multipliers) = (problem.unknown_count(), session.size(), problem.multiplier_count());
    if session.rank() == 0 {
        let seconds = start.elapsed().as_secs_f64();
        println!("{order:?} {space:?}: {unknowns} unknowns on {ranks} ranks, {multipliers} multipliers: made in {seconds:.2} s");
    }
    for count in [1, 10, 100, multipliers] {
        let mut active = system.active().to_vec();
        let mut times: Vec<f64> = (0..9)
            .map(|_| {
                active.iter_mut().take(count).for_each(|active| *active ^= true);
                timed(session, || system.set_active(&active).expect("a set"))
            })
            .collect();
        times.sort_by(f64::total_cmp);
        if session.rank() == 0 {
            println!("    {count} of {multipliers} multipliers: {:.2} ms", 1e3 * times[4]);
        }
    }
}

/// Wall seconds of the slowest rank.
fn timed(session: &Session, work: impl FnOnce()) -> f64 {
    session.any(true);
    let start = Instant::now();
    work();
    let mut seconds = [start.elapsed().as_secs_f64()];
    session.max(&mut seconds);
    seconds[0]
}
