//! Gmsh files, read and written.

mod gmsh;
mod gmsh_writer;
mod regular_file;

pub use gmsh::{parse_gmsh, read_bytes, surfaces, touching_surfaces};
pub use regular_file::read_regular;
