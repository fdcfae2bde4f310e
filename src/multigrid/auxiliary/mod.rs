//! Levels of mezha's own, below a mesh that has none, or whose macro mesh is large: continuous bilinear functions on
//! quadtrees, one for each body, whose cells are 2.5 edges wide and double from level to level (auxiliary space method,
//! Xu 1996). Nodes of the mesh take over the values of the functions, those of supports nothing of what they prescribe.
//!
//! The macro mesh is on every rank, and so are the trees.
//!
//! Linear motions are met exactly, on graded meshes and beside curved boundaries, too, and as all trees are cut from one grid
//! the traces of two bodies in contact match on coarse levels. Measured on example 1, bilateral, two meshes of Gmsh that do not
//! match, one rank, to 1e-8: iterations; seconds of set-up and solve; with reading and assembly, processor seconds of the whole
//! run. The machine did other things meanwhile: compare within a column only. Products and sweeps of these levels were PETSc's then,
//! with as many iterations. *Factor* is Cholesky of `K + BᵀDB` in the place of
//! the cycle, *BoomerAMG* likewise (for P2 below a smoothing step).
//!
//! | | P1, 98 thousand | P1, 961 thousand | P2, 98 thousand | P2, 966 thousand |
//! |---|---|---|---|---|
//! | auxiliary levels | 12; 1.0; 0.9 | 11; 11; 12 | 10; 0.6; 0.6 | 10; 8.0; 6.3 |
//! | BoomerAMG | 19; 2.7; 1.7 | 29; 54; 25 | 14; 1.0; 0.9 | 19; 21; 11 |
//! | factor | 11; 2.6; 1.8 | 11; –; 25 | 10; 2.4; 1.5 | 10; 41; 19 |
//! | `direct` | 1; 1.8; 1.3 | 1; 23; 17 | 1; 1.5; 1.1 | 1; 26; 12 |
//!
//! Iterations on other meshes of this kind, P1 and P2: edges 30 times shorter at the corners 12 and 10; turned by 20 degrees on
//! inclined or clamped supports 11 and 10; moduli 1e6 apart 18 and 17 to rounding (BoomerAMG 90 and 111); ν = 0.45 16 and 14;
//! 0.49 28 and 29, with two CG steps (four today). Functions that lie outside of their body but for a node or two are kept: without
//! them P1 takes 14 iterations instead of 12, without those that a support cuts 19 to 58.

mod grid;
mod known_step;
mod level;
mod operators;
mod product;
mod tree;

pub use level::Coarsening;
pub use operators::GalerkinLevels;

use crate::discretisation::{Discretisation, SMALL, ranks_in_group};
use grid::Grid;
use std::rc::Rc;
use tree::Tree;

/// Share of nodes that the next level must do without, if a further one is to follow it.
const LEAST_GAIN: f64 = 0.3;

/// Steps from the coarsest space of a problem down to a level that is small, or, of very many bodies, cannot be much smaller, the lowest
/// first; none if that space is small. One rank has all of the lowest level. Alike on each rank.
pub fn coarsenings(problem: &Discretisation) -> Vec<Rc<Coarsening>> {
    let (space, ranks) = (&problem.spaces[0], problem.session.size());
    let mut coarsenings: Vec<Rc<Coarsening>> = Vec::new();
    if 2 * space.numbering.node_count() <= SMALL {
        return coarsenings;
    }
    let grid = Grid::new(&problem.scene.mesh);
    let (mesh, mut trees) = (grid.nodes(space, ranks), grid.trees());
    loop {
        let nodes = coarsenings.last().map_or(&mesh, |step| &step.coarse);
        let mut step = Coarsening::new(nodes, &trees);
        let count = step.coarse.all.len();
        let coarser: Vec<Option<Tree>> = trees.iter().map(Tree::coarser).collect();
        let is_coarsest = coarser.iter().all(Option::is_none);
        trees = coarser.into_iter().zip(trees).map(|(coarser, tree)| coarser.unwrap_or(tree)).collect();
        // Bodies of few triangles would have more functions than nodes, and a singular level.
        if count > nodes.all.len() && !is_coarsest {
            continue;
        }
        let is_lowest = 2 * count <= SMALL || count as f64 > (1.0 - LEAST_GAIN) * nodes.all.len() as f64;
        step.coarse.bring_together(if is_lowest { ranks.next_power_of_two() } else { ranks_in_group(2 * count, ranks) });
        coarsenings.push(Rc::new(step));
        if is_lowest {
            break;
        }
    }
    coarsenings.reverse();
    coarsenings
}
