//! Macro mesh, partition, refinement and its levels: pure functions of (file, geometry, refine, partition).
//!
//! A Gmsh file is a *macro mesh*. At `n = 2^level` intervals per macro edge every macro triangle carries the lattice
//! of [`lattice`]; node numbers follow in closed form ([`Numbering`]) and positions from one map per macro triangle
//! ([`MacroMesh::node_position`]), so no rank ever asks another about the mesh.

mod bisection;
mod cells;
mod chain;
mod connected;
mod edge_shape;
mod edge_trace;
mod edges;
mod file_place;
mod gmsh;
mod gmsh_writer;
mod grading;
mod hierarchy;
mod insertion;
pub mod lattice;
mod located;
mod macro_mesh;
mod midside;
mod morton;
mod numbering;
mod origin;
mod overlap;
mod partition;
mod pieces;
mod raw_mesh;
mod regular_file;
#[cfg(test)]
pub(crate) mod samples;
mod shape;
mod slit;
mod smooth_normal;
mod spline_shape;
mod spot;
mod strip;
mod tool;
mod without_tools;
mod work;

pub use bisection::BisectedMesh;
pub use cells::Cells;
pub use chain::Stretch;
pub use edge_shape::EdgeShape;
pub use edge_trace::{BoundaryEdge, EdgeNode};
pub use file_place::FilePlace;
pub use gmsh::{parse_gmsh, parse_joined, read_bytes, read_gmsh, surfaces, touching_surfaces};
pub use hierarchy::Shapes;
pub use macro_mesh::{BodyPiece, Boundary, MacroEdge, MacroMesh, MacroTriangle, Region, Surface};
pub use numbering::{Level, Numbering, TriangleNumbers, levels};
pub use origin::Origin;
pub use partition::{Graph, Partition, middle_of_group};
pub use regular_file::read_regular;
pub use slit::Slit;
pub use smooth_normal::{SmoothNormals, SmoothPoint};
pub use spline_shape::Corner;
pub use spot::{NamedPoint, Spot};
pub use strip::Strip;
pub use tool::SurfacePart;

use std::path::{Path, PathBuf};

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
