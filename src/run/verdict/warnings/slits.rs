//! Words for bodies that are cut open though they are drawn closed.

use crate::mesh::{MacroMesh, Slit};
use crate::run::words::short;

/// A sentence for each body of whose boundary edges some lie on each other.
pub fn slits(mesh: &MacroMesh) -> Vec<String> {
    let words = |Slit { body, pairs, place }: Slit| {
        let edges = if pairs == 1 { "pair of boundary edges that lies" } else { "pairs of boundary edges that lie" };
        format!(
            "body \"{}\" has {pairs} {edges} on each other, near ({}, {}): a slit that nothing closes; if none is meant, its nodes were not merged: merge them with `Coherence Mesh` in gmsh",
            mesh.bodies[body],
            short(place.x),
            short(place.y)
        )
    };
    mesh.slits().into_iter().map(words).collect()
}
