//! Macro mesh, partition, refinement and its levels: pure functions of (file, geometry, refine, partition).
//!
//! A Gmsh file is a *macro mesh*. At `n = 2^level` intervals per macro edge every macro triangle carries the lattice
//! of [`lattice`]; node numbers follow in closed form ([`Numbering`]) and positions from one map per macro triangle
//! ([`MacroMesh::node_position`]), so no rank ever asks another about the mesh.
//!
//! # Numbers of nodes
//!
//! `refine = r` cuts each macro triangle into 4^r. At n intervals per macro edge it carries a lattice of nodes (i, j):
//!
//! ```text
//! n = 4            2                       macro vertices   0 1 2         one node each
//!                  | \                     macro edges      a ... l      n - 1 nodes each, along the edge
//!                  h   f                   macro triangle   ● ● ●         (n-1)(n-2)/2 nodes, row by row
//!                  |     \
//!                  i   ●   e               number of a node =
//!                  |         \                 first number of its owner
//!                  k   ●   ●   d             + macro vertices of the owner before it
//!                  |             \           + (n - 1) · macro edges before it
//!                  0 - a - b - c - 1         + (n-1)(n-2)/2 · macro triangles before it + place inside
//! ```
//!
//! Only the counts of macro entities per rank are tables; every node of every level has its number from a formula, on any rank,
//! without communication. Rows inside a macro triangle are contiguous, which caches and point smoothers want.
//! A straight macro triangle has one element matrix for all its triangles, in two orientations. Positions come from one smooth
//! map per macro triangle, so a curved edge moves its inner nodes with it, on every level alike.
//! Refinement towards named vertices (`[mesh.grade]`) leaves the numbers as they are and moves the nodes: on an edge that ends
//! at such a vertex the new node stands at the fraction κ < ½ from there, and has the weights 1 - κ and κ of its two parents.
//! Cut so, a triangle is one like itself at the vertex and three others, refined evenly from then on:
//!
//! ```text
//!   2                        positions are affine in the lattice on each of the three, for each level;
//!   | \                      those of one level are like those of the next, and a triangle's stiffness
//!   |   \                    does not depend on its size: at most 17 element matrices for a straight
//!   |     o                  macro triangle, whatever its corners and its level. Γ_C sees nothing of it
//!   |  . / \                 but edges that shorten, and segments that count them.
//!   o '/    \
//!   |\/      \
//!   0-o-------1
//! ```
//!
//! P2 on n intervals uses the nodes of P1 on twice as many triangles; below P2 comes P1 on the same triangles, then the coarser
//! levels.
//!
//! Macro triangles are spread by PTScotch on a graph with an edge for each shared macro edge and for each pair of macro
//! triangles that face each other across Γ_C, so that contact stays local. Each counts by its work: the bytes that a sweep of
//! multigrid moves on its nodes, on every level (`MacroMesh::work`); a bent one, all of whose rows are stored, is some three to
//! four times an even straight one, and graded ones lie between. A vertex or edge belongs to the rank whose macro triangle
//! visits it first. The levels nest on every rank, but for those that are brought together on fewer ranks
//! (`Partition::brought_together`).
//! What it costs: every rank holds the macro mesh. PETSc's DMPlex does not need that, but took 14.5 s where this takes 1.4 s to
//! read, distribute and refine to 1 million triangles, and gave NaN coordinates for second-order Gmsh files.

mod boundaries;
mod chain;
mod curve_piece;
mod curved;
mod edges;
mod faults;
mod file;
pub mod lattice;
mod levels;
mod lists;
mod located;
mod macro_mesh;
mod morton;
mod partition;
mod raw_mesh;
mod refined;
mod revolution;
#[cfg(test)]
pub(crate) mod samples;
mod tools;

pub use boundaries::{Boundaries, Boundary};
pub use chain::{Stretch, WIDEST_CHORD};
pub use curve_piece::{CurvePiece, LooseCurve};
pub use curved::{BoundaryVertex, Corner, SmoothNormals, SmoothPoint};
pub use faults::Slit;
pub use file::{parse_gmsh, read_bytes, read_regular, surfaces, touching_surfaces};
pub use levels::{BoundaryEdge, EdgeNode, Level, Numbering, Shapes, TriangleNumbers, levels};
pub use lists::{Lists, each_once};
pub use macro_mesh::{BodyPiece, MacroEdge, MacroMesh, MacroTriangle, NamedPoint, Region, Spot, Surface};
pub use partition::{Graph, Partition, middle_of_group};
pub use refined::{BisectedMesh, Cells, Origin};

use std::path::{Path, PathBuf};

/// A place in a mesh file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FilePlace {
    /// A line of a text, from 1.
    #[error("line {0}")]
    Line(usize),
    /// This number of bytes from the beginning of a binary file.
    #[error("byte {0}")]
    Byte(usize),
}

/// Why a mesh cannot be used: file, place, what was found and what to do.
#[derive(Debug, thiserror::Error)]
pub enum MeshError {
    /// The file cannot be opened or read.
    #[error("{file}: cannot be read: {source}")]
    Unreadable {
        /// The mesh file.
        file: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// The text of the file is not what is expected.
    #[error("{file}, {place}: {message}")]
    Syntax {
        /// The mesh file.
        file: PathBuf,
        /// Line or byte.
        place: FilePlace,
        /// What was found and what to do.
        message: String,
    },
    /// The mesh as a whole cannot be used.
    #[error("{file}: {message}")]
    Unusable {
        /// The mesh file.
        file: PathBuf,
        /// What was found and what to do.
        message: String,
    },
}

impl MeshError {
    fn unusable(file: &Path, message: impl Into<String>) -> Self {
        Self::Unusable { file: file.to_path_buf(), message: message.into() }
    }
}
