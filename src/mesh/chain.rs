//! Boundaries as chains of vertices, split at corners.

use super::MacroMesh;
use crate::geometry::{Curve, Point, Spline, cross};

/// A boundary that turns by more than this at a vertex (radians, 20 degrees) has a corner there.
const CORNER: f64 = 20.0 * std::f64::consts::PI / 180.0;

/// A part of a boundary without corners and gaps.
#[derive(Clone, Debug)]
pub struct Stretch {
    /// Its edges in the order and direction of the boundary, with the body on the left.
    pub edges: Vec<u32>,
    /// Its smooth shape: the declared geometry where the edges have one, a straight line where they lie on one,
    /// otherwise the spline through their vertices. Never the polygon: its error would enter the gap.
    pub curve: Curve,
}

impl MacroMesh {
    /// The smooth stretches of a set of boundary edges.
    pub fn stretches(&self, edges: &[u32]) -> Vec<Stretch> {
        let stretch = |edges: Vec<u32>| Stretch { curve: self.smooth_curve(&edges), edges };
        self.chains(edges).into_iter().map(stretch).collect()
    }

    /// Smooth shapes of a set of boundary edges, one for each stretch.
    pub fn smooth_curves(&self, edges: &[u32]) -> Vec<Curve> {
        self.stretches(edges).into_iter().map(|stretch| stretch.curve).collect()
    }

    fn smooth_curve(&self, chain: &[u32]) -> Curve {
        if let Some(shape) = &self.edges[chain[0] as usize].shape {
            return (*shape.curve).clone();
        }
        let points = self.chain_points(chain);
        let (first, last) = (points[0], points[points.len() - 1]);
        let straight =
            first != last && points.iter().all(|x| cross(last - first, x - first).abs() <= 1e-12 * (last - first).norm_squared());
        match straight {
            true => Curve::Line([first.into(), last.into()]),
            false if self.is_closed(chain) => Curve::Spline(Spline::through_closed(&points)),
            false => Curve::Spline(Spline::through(&points)),
        }
    }

    /// Whether a chain of edges comes back to where it begins, and goes on there without a corner.
    pub fn is_closed(&self, chain: &[u32]) -> bool {
        let [first, last] = [chain[0], chain[chain.len() - 1]];
        chain.len() > 2 && self.directed(first)[0] == self.directed(last)[1] && self.goes_on(last, first)
    }

    /// Edges in the order and direction of the boundary (body on the left), cut at corners and gaps, and where the
    /// shape changes.
    fn chains(&self, edges: &[u32]) -> Vec<Vec<u32>> {
        let follows = |a: u32, b: u32| a != b && self.directed(a)[1] == self.directed(b)[0] && self.goes_on(a, b);
        let next = |edge: u32| edges.iter().copied().find(|&other| follows(edge, other));
        let mut left: Vec<u32> = edges.to_vec();
        let mut chains = Vec::new();
        while let Some(&start) = left.iter().find(|&&edge| !edges.iter().any(|&other| follows(other, edge))).or(left.first()) {
            let mut chain = vec![start];
            left.retain(|&edge| edge != start);
            while let Some(edge) = next(chain[chain.len() - 1]).filter(|edge| left.contains(edge)) {
                left.retain(|&other| other != edge);
                chain.push(edge);
            }
            chains.push(chain);
        }
        chains
    }

    /// Whether a boundary edge goes on as another that begins at its end: without a corner, in the same shape.
    pub(super) fn goes_on(&self, edge: u32, other: u32) -> bool {
        let along = |edge: u32| {
            let [a, b] = self.directed(edge).map(|vertex| self.vertices[vertex as usize]);
            (b - a).normalize()
        };
        match (&self.edges[edge as usize].shape, &self.edges[other as usize].shape) {
            (None, None) => along(edge).dot(&along(other)) > CORNER.cos(),
            (Some(a), Some(b)) => a.curve == b.curve,
            _ => false,
        }
    }

    /// Vertices of a chain of edges.
    pub(super) fn chain_points(&self, chain: &[u32]) -> Vec<Point> {
        let corner = |edge: u32, end: usize| self.vertices[self.directed(edge)[end] as usize];
        let mut points: Vec<Point> = chain.iter().map(|&edge| corner(edge, 0)).collect();
        points.push(corner(chain[chain.len() - 1], 1));
        points
    }
}

#[cfg(test)]
mod tests {
    use super::super::samples::two_blocks;
    use super::*;

    #[test]
    fn a_straight_boundary_of_many_edges_is_one_line() {
        let mesh = two_blocks();
        let curves = mesh.smooth_curves(&mesh.boundary("upper.seam").expect("named").edges);
        assert_eq!(curves.len(), 1);
        assert!(curves[0].is_line());
    }

    #[test]
    fn corners_and_shapes_split_a_boundary() {
        let mut mesh = two_blocks();
        let mut edges = mesh.boundary("upper.seam").expect("named").edges.clone();
        edges.extend(&mesh.boundary("top").expect("named").edges);
        assert_eq!(mesh.smooth_curves(&edges).len(), 2, "seam and top have no end in common");
        mesh.vertices.iter_mut().filter(|x| x.x == 0.9 && x.y == 1.0).for_each(|x| x.y = 1.3);
        let seam = mesh.boundary("upper.seam").expect("named").edges.clone();
        assert_eq!(mesh.smooth_curves(&seam).len(), 2, "a kink of more than 20 degrees");
        mesh.vertices.iter_mut().filter(|x| x.x == 0.9 && x.y == 1.3).for_each(|x| x.y = 1.1);
        let [Curve::Spline(spline)] = &mesh.smooth_curves(&seam)[..] else { panic!("one spline") };
        assert!((spline.point(spline.range()[0]) - Point::new(0.0, 1.0)).norm() < 1e-14);
    }
}
