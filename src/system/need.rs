//! How much memory a run will take, before it takes it.
//!
//! Rows of the stiffness are counted by what is stored of each: bent macro triangles store all of theirs, the rows inside of others
//! are alike but for a few, and large even ones store none, nor do straight P2 triangles of a mesh that is not cut up. All else goes
//! with the unknowns of the finest level and with the macro triangles. Processes and libraries, some 60 MB for each rank, are there
//! already when this is asked.
//!
//! Forecast, by the rounded figures of `mezha check`, and resident memory of all ranks with those 60 MB, on two ranks, MB:
//!
//! | scene | unknowns | forecast | taken |
//! |---|---|---|---|
//! | `bars_inclined`, P2, `refine = 7` | 4.2 million | 1160 | 889 |
//! | `bars_parabola`, P2, `refine = 7` | 3.0 million | 831 | 842 |
//! | `rigid_strip`, P2, `refine = 6` | 4.3 million | 1760 | 1705 |
//! | `hertz`, P2, `refine = 6` | 3.0 million | 750 | 781 |
//! | `graded.toml` of `bars_inclined`, P2, `refine = 6` | 0.9 million | 614 | 601 |
//! | a million triangles of a file, P1 | 1.0 million | 1190 | 1050 |
//! | the same, P2 | 4.0 million | 2080 | 1925 |
//! | 182 thousand triangles of Gmsh, P2, `refine = 1` | 2.9 million | 2004 | 2003 |
//! | thick sphere, ν = 0.4999, by a factor, P1, `refine = 6` | 0.1 million | 325 | 323 |
//! | the same, P2, `refine = 6` | 0.4 million | 1260 | 1160 |
//! | the same, P2, `refine = 7` | 1.7 million | 4960 | 4488 |

use crate::discretisation::{Form, SMALL, Scene, node_count, ranks_in_group};
use crate::element::Order;
use crate::mesh::{Level, Numbering, lattice, levels};
use crate::system::choice::{SolverChoice, Tolerance};
use crate::system::rigid_border::moves_rigidly;
use crate::system::solver::{MANY, Preconditioning};

/// Bytes for each unknown of the displacement in vectors, preconditioner and interpolations, at the peak of a solve: with GMRES, of
/// some ten iterations; with BiCGStab, on so many unknowns that it takes the place of GMRES; and where BiCGStab does not come to a
/// tight tolerance, so that GMRES follows it, with as many vectors as from the start at most: where it need not, as in the first row
/// of the table, forecasts are too large.
const BY_UNKNOWN: [f64; 3] = [250.0, 175.0, 250.0];

/// Relative residual below which BiCGStab mostly stops too early.
const TIGHT: f64 = 1e-9;

/// What flat triangles add to that: flexible GMRES keeps two vectors for each iteration, and CG on the levels its own. Measured
/// on graded meshes of example 1 at 0.9 million unknowns.
const BY_UNKNOWN_IF_FLAT: f64 = 270.0;

/// What unknown rigid motions add: seven vectors. Measured on `rigid_strip` and `rigid_tools` at 3 and 4.3 million unknowns.
const BY_UNKNOWN_IF_RIGID: f64 = 56.0;

/// Bytes for each macro triangle on every rank: the mesh and its partition.
const BY_MACRO_TRIANGLE: f64 = 180.0;

/// Bytes for each macro triangle of a rank where auxiliary levels stand below them: their functions at the vertices, with lists both
/// ways, and their rows. These and the figure above were counted on 1.13 million triangles by the places that ask for memory.
const BY_AUXILIARY: f64 = 260.0;

/// Bytes for each macro triangle in the partition of levels that are brought together on fewer ranks: one for each size of group.
const BY_PARTITION: f64 = 24.0;

/// A block.
const BY_BLOCK: f64 = 32.0;

/// Its column, and what a row has besides: its node, its inverse, its beginnings. Copies of the rows have their own.
const BY_COLUMN: f64 = 4.0;
const BY_ROW: f64 = 56.0;

/// What sweeps read where all rows are stored: a block in single precision of each coupling with a later node; of a row where these begin,
/// its inverse, a sum.
const BY_SWEPT_BLOCK: f64 = 16.0;
const BY_SWEPT_ROW: f64 = 52.0;

/// A straight triangle of P2 whose nodes have no stored rows: there is one for two nodes. A node couples to 3.75 later ones then.
const BY_STRAIGHT: f64 = 64.0;
const LATER: f64 = 3.75;

/// What a row without blocks has: its node, its beginnings.
const BY_EMPTY_ROW: f64 = 24.0;

/// Mean number of blocks in a stored row, P1 and P2.
const BLOCKS: [f64; 2] = [7.0, 11.5];

/// Bytes for each unknown in a factorisation, of the plain system or of the displacements, at a million unknowns, P1 and P2, and by
/// how much that grows with four times the unknowns. Measured on example 1 at 66 thousand to 1.1 million unknowns.
const BY_FACTOR: [[f64; 2]; 2] = [[2000.0, 150.0], [2500.0, 200.0]];

/// Bytes that a scene takes on a rank with so many refinements.
pub fn memory_need(scene: &Scene, refine: usize, (choice, tolerance): (SolverChoice, Tolerance), rank: usize) -> f64 {
    let levels = levels(scene.order, refine);
    let finest = levels[levels.len() - 1];
    let nodes = |level: Level| Numbering::new(level, &scene.partition);
    let unknowns = 2.0 * nodes(finest).range(rank).len() as f64;
    let of_macro_mesh = memory_of_macro_mesh(scene) + memory_of_partitions(scene, &levels);
    let all = 2 * nodes(finest).node_count();
    let begins = || Preconditioning::first(&Scene { refine, ..scene.clone() }, all).0;
    if choice == SolverChoice::Direct || choice == SolverChoice::Auto && begins() == Preconditioning::Factor {
        let [at_a_million, growth] = BY_FACTOR[usize::from(scene.order == Order::P2)];
        let by_unknown = (at_a_million + growth * (all as f64 / 1e6).ln() / 4f64.ln()).max(0.5 * at_a_million);
        return of_macro_mesh + by_unknown * unknowns + memory_of_level(scene, finest, Form::Plain, rank);
    }
    let flat = Preconditioning::of(scene, refine) != Preconditioning::Sweep;
    let more = if flat { BY_UNKNOWN_IF_FLAT } else { 0.0 };
    let method = if !flat && all > MANY { 1 + usize::from(tolerance.residual() < TIGHT) } else { 0 };
    let rigid = if moves_rigidly(scene) { BY_UNKNOWN_IF_RIGID } else { 0.0 };
    let by_unknown = more + rigid + BY_UNKNOWN[method];
    let has_auxiliary = 2 * scene.mesh.vertices.len() > SMALL;
    let own = if has_auxiliary { scene.partition.triangles_of(rank).len() as f64 } else { 0.0 };
    of_macro_mesh
        + BY_AUXILIARY * own
        + by_unknown * unknowns
        + levels.iter().map(|&level| memory_of_level(scene, level, Form::Augmented, rank)).sum::<f64>()
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

/// Bytes that the rows of a level take on a rank.
fn memory_of_level(scene: &Scene, level: Level, form: Form, rank: usize) -> f64 {
    let blocks = BLOCKS[usize::from(level.order == Order::P2)];
    // Where boundaries follow the solution, each has columns of its own, and its blocks but for those of contact from the bodies.
    let copies = if scene.pairs.iter().any(|pair| pair.follows()) { 2.0 } else { 1.0 };
    let [whole, alike] = match (nodes_inside(scene, level, rank), form) {
        (inside, Form::Augmented) => inside,
        // All rows are stored; those that would be worked on as a whole are alike.
        ([whole, alike], Form::Plain) => [0, whole + alike],
    };
    let stored = Numbering::new(level, &scene.partition).range(rank).len() - whole;
    let swept = if whole == 0 && form == Form::Augmented { BY_SWEPT_ROW + 0.5 * BY_SWEPT_BLOCK * (blocks - 1.0) } else { 0.0 };
    let of_row = copies * (BY_ROW + BY_COLUMN * blocks) + swept;
    let straight = if form == Form::Augmented { share_straight(scene, level, rank) } else { 0.0 };
    let of_straight =
        copies * (BY_EMPTY_ROW + BY_COLUMN * (1.0 + LATER)) + BY_SWEPT_ROW + BY_SWEPT_BLOCK * LATER + 0.5 * BY_STRAIGHT;
    let of_stored = of_row * stored as f64 + BY_BLOCK * blocks * (stored - alike) as f64;
    straight * of_straight * stored as f64 + (1.0 - straight) * of_stored
}

/// Share of a rank's nodes that have no stored rows because triangles around them are straight; those on sides of the rank are few.
fn share_straight(scene: &Scene, level: Level, rank: usize) -> f64 {
    let own = scene.partition.triangles_of(rank);
    if level.order == Order::P1 || !level.is_one_triangle() || !scene.springs.is_empty() || own.is_empty() {
        return 0.0;
    }
    own.iter().filter(|&&triangle| scene.mesh.repeats(triangle as usize)).count() as f64 / own.len() as f64
}

/// Nodes of a rank inside of macro triangles: those whose rows are not stored, and those whose blocks another row has, too.
fn nodes_inside(scene: &Scene, level: Level, rank: usize) -> [usize; 2] {
    let own = scene.partition.triangles_of(rank).iter().map(|&triangle| triangle as usize);
    let (whole, others): (Vec<usize>, Vec<usize>) = own.partition(|&triangle| scene.mesh.is_whole(triangle, level));
    let repeating = others.into_iter().filter(|&triangle| scene.mesh.repeats(triangle)).count();
    let inside = lattice::inner_count(level.intervals);
    // Inside of an even macro triangle corners of P2 are alike, and midsides along each direction.
    let different = if level.order == Order::P2 { 4 } else { 1 };
    [whole.len() * inside, repeating * inside.saturating_sub(different)]
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
