//! How Γ_C is cut into segments: by the case's rule, graded, and no finer than the softer body's edges allow.
//!
//! Counting edges along Γ_C is safe on meshes that are graded towards points: the inf-sup constants of all six pairs of spaces
//! on example 1, with ratios from 0.15 to 0.4 and on two levels, are 0.37 to 0.83, as on even meshes. Segments that are measured
//! by the longest edge that they meet are long at the very point: on `bars_inclined/even.msh`, κ = 0.18 and 0.3, 66 thousand
//! unknowns, the energy was off by 7.4e-7 instead of 1.5e-7.
//!
//! The safe lengths are those of a prototype: at 1.1, 1.0 and 2.5 edges (P1 with `p0`, `p1-continuous`, `p1-discontinuous`) and
//! at 0.67, 0.5 and 1.1 (P2) the inf-sup constant is 0.3. Ends of contact that are known are worth more than more segments: in a
//! Hertz problem of the prototype the L2 error of λ was 0.046 with 13 segments, of which the active set chose, and 0.011 with 8
//! that end where contact ends.

use super::contact_boundary::ContactBoundary;
use super::pair::{MultiplierSpace, Pair, SegmentRule};
use crate::element::Order;
use crate::geometry::{Disc, Point, overlapping_discs};
use crate::mesh::BoundaryEdge;

/// Edge ends closer than this share of the edge are the same.
const SAME: f64 = 1e-6;

/// Segment ends of a pair by its rule, as fractions of the length; `edges` are those of both bodies. The automatic rule
/// keeps the number of segments that is `known`.
pub fn fractions(
    edges: &[Vec<BoundaryEdge>; 2],
    order: Order,
    pair: &Pair,
    young: [f64; 2],
    boundary: &ContactBoundary,
    known: Option<usize>,
) -> Vec<f64> {
    let least = safe_ratio_of(order, pair.space, edges);
    match &pair.segments {
        SegmentRule::Fractions(fractions) => fractions.clone(),
        SegmentRule::Count(count) => graded(*count, pair.grading),
        SegmentRule::Auto if pair.grading == [1.0, 1.0] => {
            let edges = EdgeCount::new(boundary, edges, young);
            edges.even_parts(known.unwrap_or_else(|| edges.most_parts(least)))
        }
        SegmentRule::Auto => {
            let least = least * softer_edge_length(boundary, edges, young) / boundary.length() * (1.0 - 1e-9);
            let shortest = |fractions: &[f64]| fractions.windows(2).map(|ends| ends[1] - ends[0]).fold(1.0, f64::min);
            let mut count = known.unwrap_or((1.0 / least) as usize).max(1);
            while known.is_none() && count > 1 && shortest(&graded(count, pair.grading)) < least * (1.0 - 1e-9) {
                count -= 1;
            }
            // Ends are found from the last two segments that carry pressure.
            let least = if pair.has_free_ends() { 3 } else { 1 };
            graded(count.max(least), pair.grading)
        }
    }
}

/// Ends of `count` segments as fractions of the length. From the middle to the first and last end they shorten
/// geometrically by the two factors of `grading`.
fn graded(count: usize, grading: [f64; 2]) -> Vec<f64> {
    let shares: Vec<f64> = (0..count)
        .map(|k| {
            let z = (2 * k + 1) as f64 / count as f64 - 1.0;
            if z < 0.0 { grading[0].powf(z) } else { grading[1].powf(-z) }
        })
        .collect();
    let whole: f64 = shares.iter().sum();
    let mut fractions = vec![0.0];
    for share in &shares {
        fractions.push(fractions[fractions.len() - 1] + share / whole);
    }
    if grading == [1.0, 1.0] {
        fractions = (0..=count).map(|k| k as f64 / count as f64).collect();
    }
    fractions[count] = 1.0;
    fractions
}

/// Edges that rule the segment length, as `(part of Γ_C that sees the edge, its length)`: those of the softer body, or
/// of both where the moduli are within a factor 3. Edges beyond the ends of Γ_C are left out.
fn softer_edges<'a>(
    boundary: &'a ContactBoundary,
    edges: &'a [Vec<BoundaryEdge>; 2],
    young: [f64; 2],
) -> impl Iterator<Item = ([f64; 2], f64)> + 'a {
    let counts = [young[0] <= 3.0 * young[1], young[1] <= 3.0 * young[0]];
    let ruling = edges.iter().zip(counts).filter(|(_, counts)| *counts).flat_map(|(edges, _)| edges);
    let [first, last] = boundary.ends();
    let least = 1e-9 * (last - first);
    ruling.flat_map(move |edge| {
        let parts = boundary.parts([edge.points[0], edge.points[1]]).map(move |part| [part[0].max(first), part[1].min(last)]);
        parts.filter(move |part| part[1] - part[0] > least).map(|part| (part, edge.length()))
    })
}

/// Length of the longest ruling edge; that of Γ_C where none lies, as far from all bodies.
fn softer_edge_length(boundary: &ContactBoundary, edges: &[Vec<BoundaryEdge>; 2], young: [f64; 2]) -> f64 {
    softer_edges(boundary, edges, young).map(|(_, length)| length).reduce(f64::max).unwrap_or(boundary.length())
}

/// Mean length of the ruling edges beside each segment: the `h` of the jump term.
pub fn segment_edge_lengths(boundary: &ContactBoundary, edges: &[Vec<BoundaryEdge>; 2], young: [f64; 2]) -> Vec<f64> {
    let count = EdgeCount::new(boundary, edges, young);
    boundary.arcs().windows(2).map(|ends| (ends[1] - ends[0]) / (count.before(ends[1]) - count.before(ends[0]))).collect()
}

/// Smallest length of a segment in ruling edges.
pub fn segment_ratio(boundary: &ContactBoundary, edges: &[Vec<BoundaryEdge>; 2], young: [f64; 2]) -> f64 {
    let count = EdgeCount::new(boundary, edges, young);
    boundary.arcs().windows(2).map(|ends| count.before(ends[1]) - count.before(ends[0])).fold(f64::INFINITY, f64::min)
}

/// How many ruling edges lie along Γ_C: `N(s) = ∫ds/h` from its start, `h` the longest edge that `s` sees. Between two
/// places there are `N(t) - N(s)` edges, the length by that of an edge where all are alike.
struct EdgeCount {
    /// Arc lengths where `h` changes, ascending, with `N` there.
    steps: Vec<[f64; 2]>,
}

impl EdgeCount {
    fn new(boundary: &ContactBoundary, edges: &[Vec<BoundaryEdge>; 2], young: [f64; 2]) -> Self {
        let mut parts: Vec<([f64; 2], f64)> =
            softer_edges(boundary, edges, young).map(|(part, h)| (part.map(|t| boundary.arc(t)), h)).collect();
        let longest = parts.iter().map(|(_, h)| *h).reduce(f64::max).unwrap_or(boundary.length());
        parts.sort_by(|(a, _), (b, _)| a[0].total_cmp(&b[0]));
        let mut cuts: Vec<f64> = parts.iter().flat_map(|(part, _)| *part).chain([0.0, boundary.length()]).collect();
        cuts.sort_by(f64::total_cmp);
        let (mut here, mut coming) = (Vec::new(), parts.into_iter().peekable());
        let mut steps = vec![[0.0; 2]];
        for ends in cuts.windows(2).filter(|ends| ends[1] > ends[0] && ends[0] >= 0.0) {
            while let Some(next) = coming.next_if(|(part, _)| part[0] <= ends[0]) {
                here.push(next);
            }
            here.retain(|(part, _)| part[1] > ends[0]);
            let h = here.iter().map(|(_, h)| *h).reduce(f64::max).unwrap_or(longest);
            steps.push([ends[1], steps[steps.len() - 1][1] + (ends[1] - ends[0]) / h]);
        }
        Self { steps }
    }

    /// Edges before arc length `s`.
    fn before(&self, s: f64) -> f64 {
        self.interpolate(s, 0)
    }

    /// Arc length after so many edges.
    fn place(&self, count: f64) -> f64 {
        self.interpolate(count, 1)
    }

    /// The other number where number `known` of the steps has this value.
    fn interpolate(&self, value: f64, known: usize) -> f64 {
        let at = self.steps.partition_point(|step| step[known] < value).clamp(1, self.steps.len() - 1);
        let (low, high) = (self.steps[at - 1], self.steps[at]);
        let other = 1 - known;
        low[other] + (value - low[known]) / (high[known] - low[known]) * (high[other] - low[other])
    }

    /// The most parts that hold `least` edges each.
    fn most_parts(&self, least: f64) -> usize {
        let [_, whole] = self.steps[self.steps.len() - 1];
        ((whole / least * (1.0 + 1e-9)) as usize).max(1)
    }

    /// Ends of so many parts with as many edges each, as fractions of the length.
    fn even_parts(&self, count: usize) -> Vec<f64> {
        let [length, whole] = self.steps[self.steps.len() - 1];
        let end = |k: usize| if k == count { 1.0 } else { self.place(whole * k as f64 / count as f64) / length };
        (0..=count).map(end).collect()
    }
}

/// Smallest safe segment length, in edges of the softer body: the discrete inf-sup constant stays above 0.3 with some
/// margin. P2 with discontinuous multipliers needs more where the meshes match.
fn safe_ratio(order: Order, space: MultiplierSpace, matching: bool) -> f64 {
    match (order, space) {
        (Order::P1, MultiplierSpace::P0) => 1.5,
        (Order::P1, MultiplierSpace::P1Continuous) => 1.25,
        (Order::P1, MultiplierSpace::P1Discontinuous) => 3.0,
        (Order::P2, MultiplierSpace::P1Discontinuous) if matching => 2.0,
        (Order::P2, MultiplierSpace::P1Discontinuous) => 1.5,
        (Order::P2, _) => 0.75,
    }
}

/// Smallest safe segment length of a pair on its meshes, in edges of the softer body.
pub fn safe_ratio_of(order: Order, space: MultiplierSpace, edges: &[Vec<BoundaryEdge>; 2]) -> f64 {
    safe_ratio(order, space, matching(edges))
}

/// Whether every edge end of body 2 coincides with one of body 1.
fn matching(edges: &[Vec<BoundaryEdge>; 2]) -> bool {
    if edges[0].len() != edges[1].len() {
        return false;
    }
    let near = |a: &BoundaryEdge, b: &BoundaryEdge| {
        let close = |p: Point, q: Point| (p - q).norm() < SAME * a.length();
        close(a.points[0], b.points[1]) && close(a.points[1], b.points[0])
    };
    let disc = |edge: &BoundaryEdge| Disc { middle: 0.5 * (edge.points[0] + edge.points[1]), radius: SAME * edge.length() };
    let discs = edges.each_ref().map(|edges| edges.iter().map(disc).collect::<Vec<_>>());
    let mut has_partner = vec![false; edges[0].len()];
    overlapping_discs(&discs[0], &discs[1], |a, b| has_partner[a] |= near(&edges[0][a], &edges[1][b]));
    !has_partner.contains(&false)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Curve;
    use crate::mesh::samples::two_blocks;
    use crate::mesh::{Level, Numbering, Partition};
    use std::rc::Rc;

    /// Both sides of the seam of two blocks, refined towards its left end, and the seam.
    fn graded_seam(ratio: f64) -> ([Vec<BoundaryEdge>; 2], ContactBoundary) {
        let mut mesh = two_blocks();
        mesh.grade(Point::new(0.0, 1.0), ratio).expect("a vertex of each block");
        let partition = Rc::new(Partition::new(&mesh, &[0; 6], 1));
        let numbering = Numbering::new(Level { intervals: 64, order: Order::P2 }, &partition);
        let edges = ["lower.seam", "upper.seam"].map(|name| {
            let edges = &mesh.boundary(name).expect("named").edges;
            edges.iter().flat_map(|&edge| BoundaryEdge::all_of(&mesh, edge, &numbering)).collect()
        });
        let line = Curve::Line([[0.0, 1.0], [2.0, 1.0]]);
        (edges, ContactBoundary::new(line, [0.0, 1.0], Point::new(0.0, 1.0)))
    }

    #[test]
    fn a_boundary_far_from_all_edges_is_one_segment() {
        let (_, boundary) = graded_seam(0.5);
        let nothing = [Vec::new(), Vec::new()];
        let count = EdgeCount::new(&boundary, &nothing, [1.0, 1.0]);
        assert_eq!((count.most_parts(1.5), count.even_parts(1)), (1, vec![0.0, 1.0]));
    }

    #[test]
    fn automatic_segments_hold_as_many_edges_each() {
        let young = [1.0, 1.0];
        for (ratio, parts, shortening) in [(0.5, 21, 1.0), (0.3, 21, 5.0), (0.15, 18, 50.0)] {
            let (edges, mut boundary) = graded_seam(ratio);
            let count = EdgeCount::new(&boundary, &edges, young);
            assert_eq!(count.most_parts(1.5), parts, "even: 1.5 of the 32 edges of the lower block");
            boundary.cut(&count.even_parts(parts));
            let edges_of = |k: usize| count.before(boundary.arcs()[k + 1]) - count.before(boundary.arcs()[k]);
            assert!((0..parts).all(|k| (edges_of(k) / edges_of(0) - 1.0).abs() < 1e-9));
            assert!((segment_ratio(&boundary, &edges, young) / edges_of(0) - 1.0).abs() < 1e-9);
            let [first, last] = [0, parts - 1].map(|k| boundary.segment_length(k));
            assert!(first * shortening <= last * (1.0 + 1e-9), "ratio {ratio}: {first}, {last}");
            assert!((count.place(count.before(0.7)) - 0.7).abs() < 1e-12);
        }
    }

    #[test]
    fn graded_segments_shorten_towards_their_ends() {
        assert_eq!(graded(4, [1.0, 1.0]), [0.0, 0.25, 0.5, 0.75, 1.0]);
        let fractions = graded(40, [1.0, 8.0]);
        let length = |k: usize| fractions[k + 1] - fractions[k];
        assert!((length(0) / length(19) - 1.0).abs() < 1e-9, "even before the middle");
        assert!((length(19) / length(39) / 8.0 - 1.0).abs() < 0.1 && fractions.is_sorted_by(|a, b| a < b));
    }

    #[test]
    fn the_softer_body_rules_alone_from_a_third_of_the_modulus_on() {
        let (edges, boundary) = graded_seam(0.5);
        // Even: 32 edges on each macro edge, the first of 2 below, of 0.9 above.
        let [lower, upper] = [2.0 / 32.0, 0.9 / 32.0];
        let first = |edges: &[Vec<BoundaryEdge>; 2], young: [f64; 2]| {
            let mut boundary = boundary.clone();
            boundary.cut(&[0.0, 0.25, 0.5, 1.0]);
            segment_edge_lengths(&boundary, edges, young)[0]
        };
        let swapped = [edges[1].clone(), edges[0].clone()];
        for (ratio, wanted) in [(1.0, lower), (2.9, lower), (3.1, upper)] {
            let found = [first(&edges, [ratio, 1.0]), first(&swapped, [1.0, ratio])];
            assert!(found.iter().all(|found| (found - wanted).abs() < 1e-9), "{ratio}: {found:?} instead of {wanted}");
        }
        for ratio in [1.0, 2.9, 3.1, 100.0] {
            assert!((first(&edges, [1.0, ratio]) - lower).abs() < 1e-9, "the coarse body is the softer one");
        }
    }

    #[test]
    fn meshes_match_where_each_edge_lies_on_one_of_the_other_side_the_other_way_round() {
        let ([lower, upper], _) = graded_seam(0.5);
        let mut across = lower.clone();
        across.iter_mut().for_each(|edge| edge.points.swap(0, 1));
        let ratio =
            |other: Vec<BoundaryEdge>| safe_ratio_of(Order::P2, MultiplierSpace::P1Discontinuous, &[lower.clone(), other]);
        assert_eq!(ratio(across.clone()), 2.0);
        assert_eq!([ratio(upper), ratio(lower.clone()), ratio(across[1..].to_vec())], [1.5; 3]);
    }
}
