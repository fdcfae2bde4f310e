//! Words for macro meshes whose triangles are too flat.

use crate::mesh::MacroMesh;
use crate::run::verdict::limits::{MANY_SLIVERS, SLIVER};
use crate::run::words::short;

/// What is said of an adapted mesh that is too large for its accuracy, if slivers of the file are left in many places.
pub fn slivers(mesh: &MacroMesh) -> Option<String> {
    let angles = (0..mesh.triangles.len()).map(|triangle| mesh.smallest_angle(triangle).to_degrees());
    let flat: Vec<f64> = angles.filter(|angle| *angle < SLIVER).collect();
    let smallest = flat.iter().copied().fold(f64::INFINITY, f64::min);
    (flat.len() as f64 >= MANY_SLIVERS * mesh.triangles.len() as f64).then(|| {
        format!(
            "{} of {} macro triangles have angles below {SLIVER} degrees, down to {}: such slivers need many more unknowns; draw the mesh file without them",
            flat.len(),
            mesh.triangles.len(),
            short(smallest)
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::samples::{columns, two_blocks};

    #[test]
    fn slivers_are_told_and_good_triangles_are_not() {
        assert_eq!(slivers(&two_blocks()), None);
        let words = slivers(&columns(4, 20.0)).expect("columns of 1 x 20");
        assert!(words.starts_with("8 of 8 macro triangles have angles below 10 degrees, down to 2.86: "), "{words}");
    }
}
