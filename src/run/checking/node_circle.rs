//! Circles that the nodes of a boundary lie on.

use crate::geometry::{Point, cross};
use crate::mesh::{MacroMesh, WIDEST_CHORD};

/// Distance of nodes from the circle at most, as a share of its radius.
const OFF: f64 = 1e-6;

/// Edges at least.
const LEAST_EDGES: usize = 3;

/// A circle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NodeCircle {
    pub centre: Point,
    pub radius: f64,
}

impl NodeCircle {
    /// The circle that the nodes of straight edges of a mesh lie on, as [`through`](Self::through) their lines.
    pub fn of_edges(mesh: &MacroMesh, edges: &[u32]) -> Option<Self> {
        let is_straight = |&edge: &u32| mesh.edges[edge as usize].shape.is_none();
        let line = |&edge: &u32| mesh.edges[edge as usize].vertices.map(|vertex| mesh.vertices[vertex as usize]);
        edges.iter().all(is_straight).then(|| Self::through(&edges.iter().map(line).collect::<Vec<_>>()))?
    }

    /// The circle that all ends of some lines lie on, if there is one that the lines follow in small steps.
    pub fn through(lines: &[[Point; 2]]) -> Option<Self> {
        if lines.len() < LEAST_EDGES {
            return None;
        }
        let points = lines.as_flattened();
        let first = points[0];
        let far = |from: Point| move |a: &&Point, b: &&Point| (*a - from).norm().total_cmp(&(*b - from).norm());
        let second = *points.iter().max_by(far(first))?;
        // The third point is the one that is farthest from the line through both.
        let height = |x: &Point| cross(second - first, x - first).abs();
        let third = *points.iter().max_by(|a, b| height(a).total_cmp(&height(b)))?;
        let centre = circumcentre([first, second, third])?;
        let radius = (first - centre).norm();
        let is_on = points.iter().all(|x| ((x - centre).norm() - radius).abs() <= OFF * radius);
        let angle = |[a, b]: &[Point; 2]| 2.0 * (0.5 * (b - a).norm() / radius).min(1.0).asin();
        (is_on && lines.iter().all(|line| angle(line) < WIDEST_CHORD)).then_some(Self { centre, radius })
    }
}

/// The point as far from each of three points; none if these lie on a line.
fn circumcentre([a, b, c]: [Point; 3]) -> Option<Point> {
    let (u, v) = (b - a, c - a);
    let area = 2.0 * cross(u, v);
    let (uu, vv) = (u.norm_squared(), v.norm_squared());
    let from_a = Point::new(v.y * uu - u.y * vv, u.x * vv - v.x * uu) / area;
    (area.abs() > OFF * (uu + vv)).then(|| a + from_a)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::samples::{columns, fan};

    #[test]
    fn a_fine_polygon_is_a_circle_and_a_coarse_one_and_a_line_are_none() {
        let found = |mesh: &MacroMesh| NodeCircle::of_edges(mesh, &mesh.boundaries[0].edges);
        let circle = found(&fan(16)).expect("16 edges of 22.5 degrees");
        assert!((circle.centre - Point::new(3.0, -1.0)).norm() < 1e-12 && (circle.radius - 2.0).abs() < 1e-12, "{circle:?}");
        assert!(found(&fan(7)).is_some());
        assert_eq!(found(&fan(6)), None, "a hexagon");
        assert_eq!(found(&columns(5, 1.0)), None);
    }
}
