//! Vertices of boundaries, and the angle of the body at each.

use crate::geometry::{Point, cross};
use crate::mesh::macro_mesh::MacroMesh;
use std::collections::HashMap;
use std::f64::consts::TAU;

/// A smaller angle is that of a slit: the body lies all around its tip (radians).
const SLIT: f64 = 1e-6;

/// A vertex on the boundary of a body, between two boundary edges.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundaryVertex {
    /// The vertex.
    pub vertex: u32,
    /// The boundary edges before and behind it, with the body on the left.
    pub edges: [u32; 2],
    /// Angle of the body between them, in their true shapes (radians).
    pub angle: f64,
}

impl MacroMesh {
    /// The vertices on the boundaries of all bodies, named or not. One where a boundary touches itself is left out.
    pub fn boundary_vertices(&self) -> Vec<BoundaryVertex> {
        let edges = (0..self.edges.len() as u32).filter(|&edge| self.is_outer(edge));
        let mut beside: HashMap<u32, [Vec<u32>; 2]> = HashMap::new();
        for edge in edges {
            let [from, to] = self.directed(edge);
            beside.entry(to).or_default()[0].push(edge);
            beside.entry(from).or_default()[1].push(edge);
        }
        let between = |(vertex, [before, behind]): (u32, [Vec<u32>; 2])| match (&before[..], &behind[..]) {
            (&[before], &[behind]) => {
                let [back, on] = [before, behind].map(|edge| self.direction_from(edge, vertex));
                let angle = cross(on, back).atan2(on.dot(&back)).rem_euclid(TAU);
                Some(BoundaryVertex { vertex, edges: [before, behind], angle: if angle < SLIT { TAU } else { angle } })
            }
            _ => None,
        };
        let mut found: Vec<BoundaryVertex> = beside.into_iter().filter_map(between).collect();
        found.sort_unstable_by_key(|vertex| vertex.vertex);
        found
    }

    /// Unit vector along an edge in its true shape, away from one of its vertices.
    pub fn direction_from(&self, edge: u32, vertex: u32) -> Point {
        let edge = &self.edges[edge as usize];
        let end = usize::from(edge.vertices[1] == vertex);
        let [a, b] = [end, 1 - end].map(|end| self.vertices[edge.vertices[end] as usize]);
        let along = edge.shape.as_ref().map(|shape| {
            let way = shape.range[1 - end] - shape.range[end];
            way * shape.curve.derivative(shape.range[end])
        });
        along.filter(|along| along.norm() > 0.0).unwrap_or(b - a).normalize()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Curve;
    use crate::mesh::raw_mesh::RawMesh;
    use crate::mesh::samples::{fan, two_blocks};
    use std::f64::consts::{FRAC_PI_2, PI};
    use std::path::Path;

    #[test]
    fn blocks_have_right_angles_and_straight_ones() {
        let mesh = two_blocks();
        let found = mesh.boundary_vertices();
        assert_eq!(found.len(), 4 + 6);
        for BoundaryVertex { vertex, edges: [before, behind], angle } in found {
            let x = mesh.vertices[vertex as usize];
            let wanted = if x.x == 0.9 { PI } else { FRAC_PI_2 };
            assert!((angle - wanted).abs() < 1e-12, "{angle} at {x}");
            assert!(mesh.directed(before)[1] == vertex && mesh.directed(behind)[0] == vertex);
        }
    }

    #[test]
    fn angles_are_those_of_true_shapes() {
        let mut mesh = fan(6);
        assert!(mesh.boundary_vertices().iter().all(|found| (found.angle - 2.0 * PI / 3.0).abs() < 1e-12));
        let circle = Curve::Circle { centre: [3.0, -1.0], radius: 2.0 };
        mesh.bend("rim", &["rim".into()], &circle).expect("a polygon on it");
        assert!(mesh.boundary_vertices().iter().all(|found| (found.angle - PI).abs() < 1e-9));
    }

    #[test]
    fn a_notch_and_the_tip_of_a_slit_are_more_than_straight() {
        let mut mesh = two_blocks();
        mesh.vertices.iter_mut().filter(|x| x.x == 0.9 && x.y == 1.0).for_each(|x| x.y = 1.3);
        let largest = |mesh: &MacroMesh| mesh.boundary_vertices().iter().map(|found| found.angle).fold(0.0, f64::max);
        let below = (0.9f64 / 0.3).atan() + (1.1f64 / 0.3).atan();
        assert!((largest(&mesh) - (TAU - below)).abs() < 1e-12, "{}", largest(&mesh));
        let places = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0], [1.0, 0.0]];
        let mut raw = RawMesh { vertices: places.map(Point::from).into(), ..RawMesh::default() };
        raw.add("plate", [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]]);
        let slit = MacroMesh::build(raw, Path::new("slit.msh")).expect("a good mesh");
        assert_eq!(largest(&slit), TAU);
    }
}
