//! Levels of mezha's own, below a mesh that has none, or whose macro mesh is large: continuous bilinear functions on
//! quadtrees, one for each body, whose cells are 2.5 edges wide and double from level to level (auxiliary space method,
//! Xu 1996). Nodes of the mesh take over the values of the functions, those of supports nothing of what they prescribe.
//!
//! The macro mesh is on every rank, and so are the trees.
//!
//! Linear motions are met exactly, on graded meshes and beside curved boundaries, too, and as all trees are cut from one grid
//! the traces of two bodies in contact match on coarse levels. Measured on example 1, bilateral, two meshes of Gmsh that do not
//! match, one rank, to 1e-8: iterations; seconds of set-up and solve; with reading and assembly, processor seconds of the whole
//! run. The machine did other things meanwhile: compare within a column only. *Factor* is Cholesky of `K + BᵀDB` in the place of
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
//! 0.49 28 and 29, with two CG steps. Functions that lie outside of their body but for a node or two are kept: without them P1
//! takes 14 iterations instead of 12, without those that a support cuts 19 to 58.

mod grid;
mod level;
mod operators;
mod tree;

pub use operators::GalerkinLevels;

use crate::discretisation::{Discretisation, SystemError};
use crate::discretisation::{SMALL, ranks_in_group};
use crate::petsc::{Index, Matrix, Session};
use grid::Grid;
use level::{Coarsening, LevelNodes};
use tree::Tree;

/// Unknowns of a level that needs none below it.
const FEW: usize = 500;

/// Share of unknowns that the next level must do without.
const LEAST_GAIN: f64 = 0.3;

/// Interpolations from auxiliary levels up to the coarsest space of a problem, the first from the coarsest of them; none if
/// that space is small. **Collective**
pub fn auxiliary_interpolations(problem: &Discretisation, session: &Session) -> Result<Vec<Matrix>, SystemError> {
    let space = &problem.spaces[0];
    if 2 * space.numbering.node_count() <= SMALL {
        return Ok(Vec::new());
    }
    let grid = Grid::new(&problem.scene.mesh);
    let (mut nodes, mut trees) = (grid.nodes(space, session.size()), grid.trees());
    let mut interpolations = Vec::new();
    while nodes.count() > FEW {
        let mut coarsening = Coarsening::new(&nodes, &trees);
        if coarsening.coarse.count() as f64 > (1.0 - LEAST_GAIN) * nodes.count() as f64 {
            break;
        }
        let ranks = session.size();
        coarsening.coarse.bring_together(ranks_in_group(coarsening.coarse.count(), ranks));
        interpolations.push(interpolation(&nodes, &coarsening, session)?);
        nodes = coarsening.coarse;
        let coarser: Vec<Option<Tree>> = trees.iter().map(Tree::coarser).collect();
        trees = coarser.into_iter().zip(trees).map(|(coarser, tree)| coarser.unwrap_or(tree)).collect();
    }
    interpolations.reverse();
    Ok(interpolations)
}

/// The interpolation of a coarsening (fine unknowns x coarse unknowns). Rows of prescribed components are zero. **Collective**
fn interpolation(fine: &LevelNodes, coarsening: &Coarsening, session: &Session) -> Result<Matrix, SystemError> {
    let rank = session.rank();
    let (rows, columns) = (fine.own(rank), coarsening.coarse.own(rank));
    let nodes = fine.first[rank]..fine.first[rank + 1];
    let components = || nodes.clone().flat_map(|at| fine.all[at].components().map(move |(unknown, axis)| (unknown, at, axis)));
    let (mut diagonal, mut off_diagonal) = (vec![0; rows.len()], vec![0; rows.len()]);
    for (row, at, axis) in components() {
        for (column, _) in coarsening.row(at, axis) {
            let counts = if columns.contains(&column) { &mut diagonal } else { &mut off_diagonal };
            counts[row - rows.start] += 1;
        }
    }
    let mut matrix = Matrix::aij(session, rows.len(), columns.len(), 1, &diagonal, &off_diagonal)?;
    for (row, at, axis) in components() {
        let (columns, weights): (Vec<Index>, Vec<f64>) =
            coarsening.row(at, axis).map(|(column, weight)| (column as Index, weight)).unzip();
        matrix.insert(&[row as Index], &columns, &weights)?;
    }
    matrix.assemble()?;
    Ok(matrix)
}
