//! Where the coupling integrals of a body are evaluated: points of Γ_C, each with the boundary edge that it sees.
//!
//! Between fixed points of a segment the shape functions of a body have kinks, so that no rule that does not cut is exact. Both
//! bodies make the same error, and all balances hold to rounding; the patch test tells. On `cases/patch_flat` with 5 points λ is
//! off by 1.0e-2, 8.9e-3 and 7.4e-3 (P1 with `p0`, `p1-discontinuous`, `p1-continuous`) and by 9.5e-3, 1.6e-2 and 2.8e-3 (P2),
//! with cut integrals by less than 1e-11. Refining mesh and segments together does not mend it: P2 with `p1-discontinuous` is
//! off by 1.6e-2, 1.6e-2, 1.8e-2 and 1.8e-2 at `mesh.refine` 2 to 5. More points do, slowly: P2 with `p0` is off by 2.9e-2 with
//! 2 points, 9.5e-3 with 5, 1.3e-3 with 12 and 2.1e-4 with 20.

use super::contact_boundary::ContactBoundary;
use super::pair::Quadrature;
use super::trace::edge_overlaps;
use crate::geometry::gauss_points;
use crate::mesh::BoundaryEdge;

/// A point counts to the edge that begins there, also where rounding puts the two a little apart: share of Γ_C.
const SNAP: f64 = 1e-12;

/// A quadrature point of one body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct QuadraturePoint {
    /// Index of the boundary edge that holds the corresponding point.
    pub edge: usize,
    /// Segment of Γ_C.
    pub segment: usize,
    /// Fraction of the segment, in the parameter, that lies before it.
    pub fraction: f64,
    /// Parameter of Γ_C.
    pub parameter: f64,
    /// Weight (length).
    pub weight: f64,
}

/// The quadrature points that a body's edges see, by edge and then along Γ_C.
pub fn quadrature_points(boundary: &ContactBoundary, edges: &[BoundaryEdge], rule: Quadrature) -> Vec<QuadraturePoint> {
    match rule {
        Quadrature::Cut => points_of_overlaps(boundary, edges),
        Quadrature::Segment { points } => points_of_segments(boundary, edges, points),
    }
}

/// Gauss points of each overlap of an edge and a segment: two are exact where everything is straight.
fn points_of_overlaps(boundary: &ContactBoundary, edges: &[BoundaryEdge]) -> Vec<QuadraturePoint> {
    let mut points = Vec::new();
    for overlap in edge_overlaps(boundary, edges) {
        let count = if boundary.is_straight() && edges[overlap.edge].straight { 2 } else { 8 };
        points.extend(gauss_points_between(boundary, overlap.range, overlap.edge, overlap.segment, count));
    }
    points
}

/// Gauss points of each segment, which are those of both bodies. Each belongs to one edge, whichever rank owns it: that whose
/// feet are at or before the point and behind it. A point that no edge sees is lost.
fn points_of_segments(boundary: &ContactBoundary, edges: &[BoundaryEdge], count: usize) -> Vec<QuadraturePoint> {
    let knots = boundary.knots();
    let between = |(segment, ends): (usize, &[f64])| gauss_points_between(boundary, [ends[0], ends[1]], 0, segment, count);
    let all: Vec<QuadraturePoint> = knots.windows(2).enumerate().flat_map(between).collect();
    let snap = SNAP * (knots[knots.len() - 1] - knots[0]);
    let seen = |(edge, small): (usize, &BoundaryEdge)| {
        let parts = boundary.parts([small.points[0], small.points[1]]).map(|part| {
            let [first, end] = part.map(|foot| all.partition_point(|point| point.parameter < foot - snap));
            all[first..end].iter().map(|point| QuadraturePoint { edge, ..*point }).collect::<Vec<_>>()
        });
        parts.flatten().collect::<Vec<_>>()
    };
    edges.iter().enumerate().flat_map(seen).collect()
}

/// The Gauss points between two parameters in one segment.
fn gauss_points_between(
    boundary: &ContactBoundary,
    [from, to]: [f64; 2],
    edge: usize,
    segment: usize,
    count: usize,
) -> impl Iterator<Item = QuadraturePoint> {
    let (start, end) = (boundary.knots()[segment], boundary.knots()[segment + 1]);
    gauss_points(count).iter().map(move |(z, weight)| {
        let parameter = from + z * (to - from);
        let fraction = (parameter - start) / (end - start);
        let weight = weight * (to - from) * boundary.speed(parameter) * boundary.width(parameter);
        QuadraturePoint { edge, segment, fraction, parameter, weight }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::element::Order;
    use crate::geometry::{Curve, Point};
    use crate::mesh::samples::two_blocks;
    use crate::mesh::{Level, Numbering, Partition};
    use std::rc::Rc;

    /// The flat seam between the sample blocks, 16 edges below and 32 above, in equal segments.
    fn setting(segments: usize) -> (ContactBoundary, [Vec<BoundaryEdge>; 2]) {
        let mesh = two_blocks();
        let numbering = Numbering::new(Level { intervals: 16, order: Order::P1 }, &Rc::new(Partition::new(&mesh, &[0; 6], 1)));
        let mut boundary = ContactBoundary::new(Curve::Line([[0.0, 1.0], [2.0, 1.0]]), [0.0, 1.0], Point::new(0.0, 1.0));
        boundary.cut(&(0..=segments).map(|k| k as f64 / segments as f64).collect::<Vec<_>>());
        let edges = ["lower.seam", "upper.seam"].map(|name| {
            let edges = &mesh.boundary(name).expect("named").edges;
            edges.iter().flat_map(|&edge| BoundaryEdge::all_of(&mesh, edge, &numbering)).collect()
        });
        (boundary, edges)
    }

    fn length(points: &[QuadraturePoint]) -> f64 {
        points.iter().map(|point| point.weight).sum()
    }

    /// A shape function of an edge times one of a segment is quadratic where both overlap, times a gap that is linear cubic.
    #[test]
    fn cut_quadrature_is_exact_for_cubics() {
        let (boundary, edges) = setting(5);
        for edges in &edges {
            let points = quadrature_points(&boundary, edges, Quadrature::Cut);
            let found: f64 = points.iter().map(|point| point.weight * point.parameter.powi(3)).sum();
            assert!((found - 0.5).abs() < 1e-14, "{found}");
            assert!(points.iter().all(|point| point.fraction > 0.0 && point.fraction < 1.0));
        }
    }

    #[test]
    fn the_weights_of_both_rules_sum_to_the_length() {
        let (boundary, edges) = setting(5);
        for rule in [Quadrature::Cut, Quadrature::Segment { points: 1 }, Quadrature::Segment { points: 20 }] {
            for edges in &edges {
                assert!((length(&quadrature_points(&boundary, edges, rule)) - 2.0).abs() < 1e-14, "{rule:?}");
            }
        }
    }

    /// Of 1, 3 and 5 points the middle one of a segment lies on a node, over and over.
    #[test]
    fn every_point_of_a_segment_belongs_to_one_edge() {
        for (segments, count) in [(1, 1), (2, 1), (8, 1), (16, 3), (1, 5), (4, 5), (7, 20)] {
            let (boundary, edges) = setting(segments);
            let sets = edges.map(|edges| {
                let mut points = quadrature_points(&boundary, &edges, Quadrature::Segment { points: count });
                points.sort_by(|a, b| a.parameter.total_cmp(&b.parameter));
                points.iter().map(|point| (point.segment, point.parameter)).collect::<Vec<_>>()
            });
            assert_eq!(sets[0].len(), segments * count);
            assert!(
                sets[0].windows(2).all(|pair| pair[0].1 < pair[1].1),
                "{segments} segments of {count} points: one is taken twice"
            );
            assert_eq!(sets[0], sets[1]);
        }
    }

    /// Each rank sees its own edges only.
    #[test]
    fn edges_taken_apart_see_what_they_see_together() {
        let (boundary, [edges, _]) = setting(8);
        let rule = Quadrature::Segment { points: 1 };
        let alone = |edge: &BoundaryEdge| quadrature_points(&boundary, std::slice::from_ref(edge), rule);
        let apart: Vec<f64> = edges.iter().flat_map(alone).map(|point| point.parameter).collect();
        let together: Vec<f64> = quadrature_points(&boundary, &edges, rule).iter().map(|point| point.parameter).collect();
        assert_eq!(apart, together);
    }

    #[test]
    fn a_point_that_no_edge_sees_is_lost() {
        let (boundary, [mut edges, _]) = setting(4);
        edges.retain(|edge| edge.points.iter().all(|point| point.x < 1.4));
        let points = quadrature_points(&boundary, &edges, Quadrature::Segment { points: 5 });
        assert!(points.iter().all(|point| point.segment < 3) && (10..15).contains(&points.len()), "{}", points.len());
    }

    /// Each fixed point belongs to the edge that begins at or before it, once, and is lost where the body has no edge.
    #[test]
    fn fixed_points_belong_to_one_edge_each_and_are_lost_beyond_the_body() {
        for (segments, count) in [(8, 1), (5, 3), (1, 20)] {
            let (boundary, edges) = setting(segments);
            for edges in &edges {
                let points = quadrature_points(&boundary, edges, Quadrature::Segment { points: count });
                assert_eq!(points.len(), segments * count);
                assert!((length(&points) - 2.0).abs() < 1e-12);
                for point in &points {
                    let x = boundary.point(point.parameter).x;
                    let [a, b] = [0, 1].map(|k| edges[point.edge].points[k].x);
                    assert!(a.min(b) <= x + 1e-9 && x < a.max(b) - 1e-9, "{x} is not on {a} to {b}");
                    assert!((2.0 * (point.segment as f64 + point.fraction) / segments as f64 - x).abs() < 1e-12);
                }
            }
        }
        // Half as long again on the left, a quarter on the right.
        let (_, edges) = setting(1);
        let mut long = ContactBoundary::new(Curve::Line([[-1.0, 1.0], [2.5, 1.0]]), [0.0, 1.0], Point::new(0.0, 1.0));
        long.cut(&[0.0, 0.3, 0.7, 1.0]);
        for edges in &edges {
            let seen = quadrature_points(&long, edges, Quadrature::Segment { points: 6 });
            let between =
                |segment: usize| gauss_points_between(&long, [long.knots()[segment], long.knots()[segment + 1]], 0, segment, 6);
            let on_body = |point: &QuadraturePoint| (0.0..2.0).contains(&long.point(point.parameter).x);
            let wanted: f64 = (0..3).flat_map(between).filter(on_body).map(|point| point.weight).sum();
            assert!((length(&seen) - wanted).abs() < 1e-12 && wanted < 2.4 && seen.iter().all(on_body));
        }
    }
}
