//! Which edges of a body look at Γ_C: those before which nothing else of the body lies.

use crate::contact::contact_boundary::ContactBoundary;
use crate::contact::side::Side;
use crate::mesh::BoundaryEdge;
use std::collections::BTreeMap;

/// Sine of the angle between the way to a foot and the normal there above which it is none.
const NO_FOOT: f64 = 1e-4;

/// The foot of the middle of an edge lies between those of its ends but for this share of their distance.
const NOT_BETWEEN: f64 = 0.25;

/// Leaves the edges of a body that look at a part of Γ_C.
pub fn leave_what_looks_at(boundary: &ContactBoundary, side: Side, edges: &mut Vec<BoundaryEdge>) {
    edges.retain(|edge| lies_at(boundary, side, edge));
    leave_nearest(boundary, edges);
}

/// Whether an edge looks at a part of Γ_C, not beside it. On a large body most do not, which few looks tell.
fn lies_at(boundary: &ContactBoundary, side: Side, edge: &BoundaryEdge) -> bool {
    let middle = 0.5 * (edge.points[0] + edge.points[1]);
    let [first, last] = boundary.ends();
    let near = boundary.near(middle);
    if edge.outward().dot(&boundary.normal(near)) * side.sign() < LOOKS_AWAY {
        return false;
    }
    let beyond = (middle - boundary.point(near)).dot(&boundary.tangent(near));
    let is_open = boundary.period().is_none();
    if is_open && (near <= first && beyond < -edge.length() || near >= last && beyond > edge.length()) {
        return false;
    }
    let is_within = |[from, to]: [f64; 2]| from < last && to > first;
    faces(boundary, side, edge) && boundary.parts([edge.points[0], edge.points[1]]).any(is_within)
}

/// Leaves of edges that look at the same part of Γ_C the nearest: what lies behind it, as the next tooth of a gear, touches nothing there.
fn leave_nearest(boundary: &ContactBoundary, edges: &mut Vec<BoundaryEdge>) {
    let [first, last] = boundary.ends();
    // Where an edge has the middle of its part, and that part; parameters as whole numbers, which can be ordered.
    let whole = |t: f64| ((t - first) / (last - first) * 1e15) as i64;
    let seen = |edge: &BoundaryEdge| {
        let [from, to] = boundary.parts([edge.points[0], edge.points[1]]).next()?;
        let middle = 0.5 * (edge.points[0] + edge.points[1]);
        let distance = (middle - boundary.point(boundary.foot(middle))).norm();
        Some((distance, [whole(from.max(first)), whole(to.min(last))]))
    };
    let parts: Vec<_> = edges.iter().map(seen).collect();
    let mut order: Vec<usize> = (0..edges.len()).collect();
    let distance = |k: usize| parts[k].map_or(0.0, |(distance, _)| distance);
    order.sort_by(|&a, &b| distance(a).total_cmp(&distance(b)));
    let mut nearest: BTreeMap<i64, i64> = BTreeMap::new();
    let mut stays = vec![true; edges.len()];
    for k in order {
        let Some((_, [from, to])) = parts[k] else { continue };
        let middle = from.midpoint(to);
        stays[k] = nearest.range(..=middle).next_back().is_none_or(|(_, end)| *end <= middle);
        if stays[k] {
            nearest.insert(from, to);
        }
    }
    let mut stays = stays.into_iter();
    edges.retain(|_| stays.next().expect("as many as edges"));
}

/// Cosine of the angle between the normals of an edge and of Γ_C about its foot, below which the foot itself tells nothing else.
const LOOKS_AWAY: f64 = -0.5;

/// Whether an edge looks at Γ_C: what lies behind a body does not touch. Neither does what has no foot on it: from the far side of
/// a closed body the search for the nearest point of a short Γ_C may end anywhere, and the two ends of an edge there may have
/// their feet beyond both ends of Γ_C.
pub fn faces(boundary: &ContactBoundary, side: Side, edge: &BoundaryEdge) -> bool {
    let middle = 0.5 * (edge.points[0] + edge.points[1]);
    let foot = boundary.foot(middle);
    let (normal, away) = (boundary.normal(foot), middle - boundary.point(foot));
    if edge.outward().dot(&normal) * side.sign() <= 0.0 {
        return false;
    }
    // Far from the origin coordinates lose digits.
    let rounding = 1e-9 * edge.length() + 16.0 * f64::EPSILON * middle.amax();
    let is_foot = crate::geometry::cross(away, normal).abs() <= NO_FOOT * away.norm() + rounding;
    let [from, to] = boundary.feet([edge.points[0], edge.points[1]]);
    let off = foot - 0.5 * (from + to);
    let turns = boundary.period().map_or(0.0, |period| (off / period).round() * period);
    let is_between = (off - turns).abs() <= NOT_BETWEEN * (to - from);
    is_foot && is_between
}
