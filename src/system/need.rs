//! How much memory a run will take, before it takes it.
//!
//! Rows of the stiffness are counted, since bent macro triangles store all of theirs, graded ones share most of them, and even ones store next to none; all else goes
//! with the unknowns of the finest level and with the macro triangles. Processes and libraries, some 60 MB for each rank, are
//! there already when this is asked.

use crate::discretisation::{Form, Scene, node_count, ranks_in_group};
use crate::element::Order;
use crate::mesh::{Level, Numbering, lattice, levels};
use crate::system::choice::{SolverChoice, Tolerance};
use crate::system::solver::{MANY, Preconditioning};

/// Bytes for each unknown of the displacement in vectors, preconditioner and interpolations, at the peak of a solve: with GMRES, of
/// some ten iterations; with BiCGStab, on so many unknowns that it takes the place of GMRES; and where BiCGStab does not come to a
/// tight tolerance, so that GMRES follows it, with as many vectors as from the start at most. Measured as resident memory less that
/// of the processes themselves, on one rank and on two, with fields and without, which are written after that peak: example 1 with
/// P1 and P2 at 66 thousand to 16.8 million unknowns, and whole rings up to 0.86 million. Forecasts are within a fifth of all of
/// these; where GMRES follows they may be above by more.
const BY_UNKNOWN: [f64; 3] = [250.0, 175.0, 250.0];

/// Relative residual below which BiCGStab mostly stops too early.
const TIGHT: f64 = 1e-9;

/// What flat triangles add to that: flexible GMRES keeps two vectors for each iteration, and CG on the levels its own. Measured
/// on graded meshes of example 1 at 0.9 million unknowns.
const BY_UNKNOWN_IF_FLAT: f64 = 270.0;

/// Bytes for each macro triangle on every rank: the mesh, its partition, the lists of assembly. Measured at 369 thousand of them
/// with P2, `refine` 0 and 2.
const BY_MACRO_TRIANGLE: f64 = 500.0;

/// Bytes for each macro triangle in the partition of levels that are brought together on fewer ranks: one for each size of group.
const BY_PARTITION: f64 = 52.0;

/// A block with its column, and what a row has besides: its node, its inverse, its beginnings.
const BY_BLOCK: f64 = 36.0;
const BY_ROW: f64 = 44.0;

/// The column of a block that other rows of a graded macro triangle have, too.
const BY_SHARED_BLOCK: f64 = 4.0;

/// Share of the stored rows that is there at the peak; measured on whole rings, which store most of theirs.
const AT_THE_PEAK: f64 = 0.6;

/// A block of the coarsest level in a matrix of PETSc's, which has all of its rows.
const BY_ENTRIES: f64 = 48.0;

/// Mean number of blocks in a stored row, P1 and P2.
const BLOCKS: [f64; 2] = [7.0, 11.5];

/// Bytes for each unknown in a factorisation of the plain system at a million unknowns, P1 and P2, and by how much that grows
/// with four times the unknowns. Measured on example 1 at 66 thousand to 1.1 million unknowns.
const BY_FACTOR: [[f64; 2]; 2] = [[2000.0, 150.0], [2500.0, 200.0]];

/// Bytes that a scene takes on a rank with so many refinements.
pub fn memory_need(scene: &Scene, refine: usize, (choice, tolerance): (SolverChoice, Tolerance), rank: usize) -> f64 {
    let levels = levels(scene.order, refine);
    let finest = levels[levels.len() - 1];
    let nodes = |level: Level| Numbering::new(level, &scene.partition);
    let unknowns = 2.0 * nodes(finest).range(rank).len() as f64;
    let of_macro_mesh = memory_of_macro_mesh(scene) + memory_of_partitions(scene, &levels);
    // Where boundaries follow the solution, each has its own copy.
    let copies = if scene.pairs.iter().any(|pair| pair.follows()) { 2.0 } else { 1.0 };
    let by_row =
        |level: Level, by_block: f64| AT_THE_PEAK * copies * (BY_ROW + by_block * BLOCKS[usize::from(level.order == Order::P2)]);
    match choice.form() {
        Form::Augmented => {
            let of_levels = |&level: &Level| {
                let [whole, shared] = nodes_inside(scene, level, rank);
                let stored = nodes(level).range(rank).len() - whole - shared;
                by_row(level, BY_BLOCK) * stored as f64 + by_row(level, BY_SHARED_BLOCK) * shared as f64
            };
            let flat = Preconditioning::of(refine + 1, &scene.mesh.ratios) != Preconditioning::Sweep;
            let more = if flat { BY_UNKNOWN_IF_FLAT } else { 0.0 };
            let is_large = !flat && 2 * nodes(finest).node_count() > MANY;
            let method = if is_large { 1 + usize::from(tolerance.residual() < TIGHT) } else { 0 };
            let by_unknown = more + BY_UNKNOWN[method];
            let coarsest = nodes(levels[0]).range(rank).len() as f64 * BLOCKS[0] * BY_ENTRIES;
            of_macro_mesh + by_unknown * unknowns + coarsest + levels.iter().map(of_levels).sum::<f64>()
        }
        Form::Plain => {
            let [at_a_million, growth] = BY_FACTOR[usize::from(scene.order == Order::P2)];
            let all = 2.0 * nodes(finest).node_count() as f64;
            let by_unknown = (at_a_million + growth * (all / 1e6).ln() / 4f64.ln()).max(0.5 * at_a_million);
            of_macro_mesh + by_unknown * unknowns + by_row(finest, BY_BLOCK) * nodes(finest).range(rank).len() as f64
        }
    }
}

/// Bytes that the macro mesh of a scene takes on every rank.
pub fn memory_of_macro_mesh(scene: &Scene) -> f64 {
    BY_MACRO_TRIANGLE * scene.mesh.triangles.len() as f64
}

/// Bytes of the partitions of levels that fewer ranks share, on every rank.
fn memory_of_partitions(scene: &Scene, levels: &[Level]) -> f64 {
    let ranks = scene.partition.size();
    let group = |level: &Level| ranks_in_group(2 * node_count(&scene.mesh, *level) as usize, ranks);
    let mut groups: Vec<usize> = levels[..levels.len() - 1].iter().map(group).filter(|&group| group > 1).collect();
    groups.dedup();
    BY_PARTITION * (groups.len() * scene.mesh.triangles.len()) as f64
}

/// Nodes of a rank inside of macro triangles: those whose rows are not stored, and those whose rows share their blocks.
fn nodes_inside(scene: &Scene, level: Level, rank: usize) -> [usize; 2] {
    let own = scene.partition.triangles_of(rank).iter().map(|&triangle| triangle as usize);
    let (whole, others): (Vec<usize>, Vec<usize>) = own.partition(|&triangle| scene.mesh.is_whole(triangle, level));
    let shared = others.into_iter().filter(|&triangle| scene.mesh.repeats(triangle)).count();
    [whole.len(), shared].map(|count| count * lattice::inner_count(level.intervals))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::MultiplierSpace;
    use crate::discretisation::samples::{blocks, pair};
    use crate::geometry::{Curve, Point};
    use std::rc::Rc;

    /// Each refinement takes four times as much, in the end, a bent mesh more than a straight one, and a factor more than both.
    #[test]
    fn need_grows_with_the_unknowns_and_with_what_is_stored() {
        let scene = blocks(pair(MultiplierSpace::P0, 4), |_| Point::zeros(), Vec::new());
        let need = |scene: &Scene, refine, choice| memory_need(scene, refine, (choice, Tolerance::Residual(1e-8)), 0);
        let growth = need(&scene, 10, SolverChoice::Auto) / need(&scene, 9, SolverChoice::Auto);
        assert!((3.8..4.0).contains(&growth), "{growth}");
        let mut mesh = (*scene.mesh).clone();
        let circle = Curve::Circle { centre: [1.0, -2.0], radius: 10f64.sqrt() };
        mesh.bend("arc", &["lower.seam".into()], &circle).expect("the ends lie on it");
        let bent = Scene { mesh: Rc::new(mesh), ..scene.clone() };
        let [straight, bent] = [scene, bent].map(|scene| {
            let [split, direct] = [SolverChoice::FieldSplit, SolverChoice::Direct].map(|choice| need(&scene, 9, choice));
            assert!(direct > 2.0 * split, "{direct} {split}");
            split
        });
        assert!(bent > 1.05 * straight, "{bent} {straight}");
    }
}
