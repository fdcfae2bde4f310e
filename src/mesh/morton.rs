//! Morton's space-filling curve: what follows each other on it lies together in the plane.

use super::raw_mesh::{RawMesh, RawTriangle};
use crate::geometry::{Point, bounds};

/// Meshes of more triangles are put in order: what passes over them finds neighbours in the caches then.
const LARGE: usize = 10_000;

/// Bits of a place along the curve: 21 of each coordinate. Those above them tell the physical surface, of which there are fewer
/// than 2^22.
const PLACE_BITS: u32 = 42;

/// Places along the curve in the box around some points.
pub(super) struct MortonCurve {
    low: Point,
    size: f64,
}

impl MortonCurve {
    /// The curve that fills the square around some points.
    pub fn around(points: &[Point]) -> Self {
        let [low, high] = bounds(points.iter().copied());
        Self { low, size: (high - low).max() }
    }

    /// The place of a triangle, by its middle: of [`PLACE_BITS`] bits.
    pub fn place(&self, points: &[Point], corners: [u32; 3]) -> u64 {
        let [a, b, c] = corners.map(|corner| points[corner as usize]);
        let middle = ((a + b + c) / 3.0 - self.low) / self.size * f64::from(1u32 << 20);
        spread(middle.x as u64) | spread(middle.y as u64) << 1
    }
}

/// The lowest 21 bits with a zero behind each of them.
fn spread(bits: u64) -> u64 {
    let halves = [(16, 0xffff_0000_ffff), (8, 0xff_00ff_00ff_00ff), (4, 0xf0f_0f0f_0f0f_0f0f), (2, 0x3333_3333_3333_3333)];
    let apart = halves.into_iter().fold(bits & 0x1f_ffff, |bits, (shift, mask)| (bits | bits << shift) & mask);
    (apart | apart << 1) & 0x5555_5555_5555_5555
}

impl RawMesh {
    /// Puts the triangles of a large mesh in order along the curve, one physical surface after the other, and the vertices in the
    /// order in which they name them. All vertices must belong to triangles.
    pub fn put_in_order(&mut self) {
        if self.triangles.len() <= LARGE {
            return;
        }
        let curve = MortonCurve::around(&self.vertices);
        let key = |(at, triangle): (usize, &RawTriangle)| {
            (u64::from(triangle.names) << PLACE_BITS | curve.place(&self.vertices, triangle.corners), at as u32)
        };
        let mut order: Vec<(u64, u32)> = self.triangles.iter().enumerate().map(key).collect();
        order.sort_unstable();
        self.triangles = order.iter().map(|&(_, at)| self.triangles[at as usize]).collect();
        let mut new = vec![u32::MAX; self.vertices.len()];
        let mut vertices = Vec::with_capacity(self.vertices.len());
        for corner in self.triangles.iter_mut().flat_map(|triangle| &mut triangle.corners) {
            let place = &mut new[*corner as usize];
            if *place == u32::MAX {
                *place = vertices.len() as u32;
                vertices.push(self.vertices[*corner as usize]);
            }
            *corner = *place;
        }
        self.vertices = vertices;
        // An end that belongs to no triangle stays one.
        let lines = self.lines.iter_mut().flat_map(|(_, ends, _)| ends);
        for end in lines.chain(self.midsides.iter_mut().flat_map(|(ends, _)| ends)) {
            *end = new.get(*end as usize).copied().unwrap_or(u32::MAX);
        }
        self.midsides.iter_mut().for_each(|(ends, _)| ends.sort_unstable());
    }
}

#[cfg(test)]
mod tests {
    use super::super::macro_mesh::MacroMesh;
    use super::*;
    use std::path::Path;

    #[test]
    fn bits_are_spread() {
        for bits in [0, 1, 0b101, 0x1f_ffff, 0x12_3456] {
            assert_eq!(spread(bits), (0..21).fold(0, |sum, k| sum | ((bits >> k) & 1) << (2 * k)));
        }
    }

    /// Columns of a strip, the middle first, whose vertices stand in the file from right to left.
    #[test]
    fn a_large_mesh_is_put_in_order_with_its_lines() {
        let count = LARGE;
        let mut raw = RawMesh::default();
        for k in (0..=count).rev() {
            raw.vertices.extend([Point::new(k as f64, 0.0), Point::new(k as f64, 1.0)]);
        }
        let at = |k: usize, upper: usize| 2 * (count - k) + upper;
        for k in (count / 2..count).chain(0..count / 2) {
            raw.add("strip", [[at(k, 0), at(k + 1, 0), at(k + 1, 1)], [at(k, 0), at(k + 1, 1), at(k, 1)]]);
            raw.add_line("bottom", [at(k, 0), at(k + 1, 0)]);
        }
        let mesh = MacroMesh::build(raw, Path::new("strip.msh")).expect("a good mesh");
        let left = |vertices: &[u32]| vertices.iter().map(|&v| mesh.vertices[v as usize].x).fold(f64::INFINITY, f64::min);
        assert!(mesh.triangles.is_sorted_by_key(|triangle| left(&triangle.vertices)));
        let mut named = 0;
        for vertex in mesh.triangles.iter().flat_map(|triangle| triangle.vertices) {
            assert!(vertex <= named, "a vertex is named before one of a lower number");
            named = named.max(vertex + 1);
        }
        let bottom = &mesh.boundary("bottom").expect("named").edges;
        let on_bottom = |&&edge: &&u32| mesh.edges[edge as usize].vertices.iter().all(|&v| mesh.vertices[v as usize].y == 0.0);
        assert_eq!(bottom.iter().filter(on_bottom).count(), count);
    }
}
