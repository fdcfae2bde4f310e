//! Rigid tools as layers of triangles, and the mesh without them.

mod tool;
mod without_tools;
