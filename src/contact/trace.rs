//! Traces: a body's fields at the points of Γ_C, through their corresponding points on the body's boundary.
//!
//! A body couples to Γ_C alone, so each rank works on the boundary edges it owns and on nothing else.

use super::contact_boundary::ContactBoundary;
use crate::element::{edge_shape, edge_slope};
use crate::geometry::Point;
use crate::mesh::BoundaryEdge;

/// A part of Γ_C that sees one boundary edge along its normals and lies in one segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EdgeOverlap {
    /// Index of the boundary edge.
    pub edge: usize,
    /// Segment of Γ_C.
    pub segment: usize,
    /// Parameters of Γ_C where it starts and ends.
    pub range: [f64; 2],
}

/// A body's trace at one point of Γ_C.
#[derive(Clone, Copy, Debug)]
pub struct Trace {
    /// Fraction of the edge where the corresponding point lies.
    pub fraction: f64,
    /// Values of the edge's shape functions there.
    pub values: [f64; 3],
    /// Where the corresponding point lies undeformed.
    pub place: Point,
}

/// Cuts Γ_C at the feet of the edges' ends and at the segment ends; edges that see no part of it give none.
pub fn edge_overlaps(boundary: &ContactBoundary, edges: &[BoundaryEdge]) -> Vec<EdgeOverlap> {
    let (knots, [first, last]) = (boundary.knots(), boundary.ends());
    let least = 1e-13 * (last - first);
    let mut overlaps = Vec::new();
    let parts = |(edge, small): (usize, &BoundaryEdge)| {
        let parts: Vec<[f64; 2]> = boundary.parts([small.points[0], small.points[1]]).collect();
        parts.into_iter().map(move |part| (edge, part))
    };
    for (edge, part) in edges.iter().enumerate().flat_map(parts) {
        let (start, end) = (part[0].max(first), part[1].min(last));
        if end - start <= least {
            continue;
        }
        let (mut segment, mut from) = (boundary.locate(start + least).0, start);
        while from < end - least {
            let to = if segment + 1 == boundary.segments() { end } else { end.min(knots[segment + 1]) };
            if to - from > least {
                overlaps.push(EdgeOverlap { edge, segment, range: [from, to] });
            }
            (from, segment) = (to, segment + 1);
        }
    }
    overlaps
}

/// Trace on an edge at parameter `t` of Γ_C: where the normal line meets the edge.
pub fn trace(boundary: &ContactBoundary, small: &BoundaryEdge, t: f64) -> Trace {
    let (x, normal) = (boundary.point(t), boundary.normal(t));
    let tangent = crate::geometry::turn_right(normal);
    let along: Vec<f64> = small.points.iter().map(|point| (point - x).dot(&tangent)).collect();
    let mut fraction = along[0] / (along[0] - along[1]);
    if along.len() == 3 {
        for _ in 0..30 {
            let (values, slopes) = (edge_shape(3, fraction), edge_slope(3, fraction));
            let (mut value, mut slope) = (0.0, 0.0);
            for a in 0..3 {
                value += values[a] * along[a];
                slope += slopes[a] * along[a];
            }
            let step = value / slope;
            fraction -= step;
            if step.abs() < 1e-15 {
                break;
            }
        }
    }
    let fraction = fraction.clamp(0.0, 1.0);
    let values = edge_shape(small.points.len(), fraction);
    let place = small.places.iter().zip(values).fold(Point::zeros(), |sum, (place, value)| sum + value * place);
    Trace { fraction, values, place }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::element::Order;
    use crate::geometry::Curve;
    use crate::mesh::samples::two_blocks;
    use crate::mesh::{Level, Numbering, Partition};
    use std::rc::Rc;

    /// Γ_C lies below the seam: the normal line through x meets the seam in (x, 1).
    #[test]
    fn a_trace_lies_where_the_normal_line_meets_the_edge() {
        let mesh = two_blocks();
        let boundary = ContactBoundary::new(Curve::Line([[0.0, 0.7], [2.0, 0.7]]), [0.0, 1.0], Point::new(0.0, 1.0));
        for order in [Order::P1, Order::P2] {
            let numbering = Numbering::new(Level { intervals: 4, order }, &Rc::new(Partition::new(&mesh, &[0; 6], 1)));
            let edges = &mesh.boundary("upper.seam").expect("named").edges;
            for edge in edges.iter().flat_map(|&edge| BoundaryEdge::all_of(&mesh, edge, &numbering)) {
                for share in [0.1, 0.35, 0.8] {
                    let wanted = edge.points[0] + share * (edge.points[1] - edge.points[0]);
                    let found = trace(&boundary, &edge, boundary.foot(wanted));
                    assert!((found.fraction - share).abs() < 1e-12, "{} instead of {share}", found.fraction);
                    assert!((found.place - wanted).norm() < 1e-12, "{} instead of {wanted}", found.place);
                    assert!((found.values.iter().sum::<f64>() - 1.0).abs() < 1e-12);
                }
            }
        }
    }
}
