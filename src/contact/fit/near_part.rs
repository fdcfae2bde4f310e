//! The part of a stretch of boundary that is near the other body: from the first to the last node that touches or penetrates it,
//! but for a tolerance.

use crate::contact::pair::{Configuration, Pair};
use crate::contact::smooth_side::SmoothSide;
use crate::geometry::Point;

/// A contact that goes all around but for so many edges has no ends beside them.
const BRIDGED_EDGES: f64 = 4.0;

/// What may be done about several stretches that touch.
const OF_ITS_OWN: &str = "give each a name and a contact of its own, or tell the curve of all by a [geometry]";

/// Angle (radians) at which straight pieces go on as each other: that of coordinates of six digits.
const STRAIGHT: f64 = 1e-5;

/// Pieces that meet at a smaller angle (radians) are not split by a corner there.
const JOINT: f64 = 0.3;

/// A stretch, and which of its nodes are near the other body.
#[derive(Clone, Copy)]
pub struct NearPart<'a> {
    pub side: &'a SmoothSide,
    /// First and last node. On a closed stretch the last may lie a turn farther, and it does so if all nodes but few are near.
    pub nodes: [usize; 2],
}

impl<'a> NearPart<'a> {
    /// The part that is near some stretch of the other body, within a share of the length; nothing if it has one node only.
    fn new(side: &'a SmoothSide, others: &[SmoothSide], pair: &Pair, share: f64) -> Option<Self> {
        let near = |&node: &usize| is_near(side, node, others, pair, share);
        let count = side.nodes();
        let nodes = match side.turn() {
            Some(_) => beside_the_widest_gap(side, &(0..count).filter(near).collect::<Vec<_>>())?,
            None => [(0..count).find(near)?, (0..count).rev().find(near)?],
        };
        (nodes[1] > nodes[0]).then_some(Self { side, nodes })
    }

    /// From the node before the one nearest to the first of three places to the node behind the one nearest to the last; on a closed
    /// stretch by way of the one between.
    pub fn beside(side: &'a SmoothSide, places: [Point; 3]) -> Self {
        let ([a, between, b], count) = (places.map(|x| side.nearest_node(x)), side.nodes());
        if side.turn().is_none() {
            return Self { side, nodes: [a.min(b).saturating_sub(1), (a.max(b) + 1).min(count - 1)] };
        }
        let way = |from: usize, to: usize| (to + count - from) % count;
        let [first, last] = if way(a, between) <= way(a, b) { [a, b] } else { [b, a] };
        let before = (first + count - 1) % count;
        Self { side, nodes: [before, before + way(first, last) + 2] }
    }

    /// Whether it goes all around a closed stretch.
    pub fn is_whole(&self) -> bool {
        self.side.turn().is_some() && self.nodes[1] - self.nodes[0] >= self.side.nodes()
    }

    fn length(&self) -> f64 {
        self.side.unrolled(self.nodes[1]) - self.side.unrolled(self.nodes[0])
    }

    /// Middle node of the part, which may lie a turn farther; nothing if it goes all around.
    fn middle(&self) -> Option<usize> {
        (!self.is_whole()).then(|| self.nodes.iter().sum::<usize>() / 2)
    }

    /// Node at which the stretch is begun: opposite to the middle of this part, or of the other body's if this one goes all around.
    /// Zero on an open stretch.
    pub fn seam(&self, other: &Self, configuration: Configuration) -> usize {
        let (side, count) = (self.side, self.side.nodes());
        let across = || {
            let x = other.side.positions(configuration)[other.middle()? % other.side.nodes()];
            let away = |node: &usize| (side.positions(configuration)[*node] - x).norm();
            (0..count).min_by(|a, b| away(a).total_cmp(&away(b)))
        };
        let middle = side.turn().and_then(|_| self.middle().or_else(across));
        middle.map_or(0, |middle| (middle + count / 2) % count)
    }

    /// First and last node of the part as they are counted from a seam of the stretch.
    pub fn counted_from(&self, seam: usize) -> [usize; 2] {
        let ([first, last], count) = (self.nodes, self.side.nodes());
        let from = (first + count - seam) % count;
        match self.side.turn() {
            None => self.nodes,
            Some(_) if self.is_whole() => [0, count],
            Some(_) => [from, from + last - first],
        }
    }
}

/// Whether a node touches or penetrates the other body, but for a share of the length.
pub fn is_near(side: &SmoothSide, node: usize, others: &[SmoothSide], pair: &Pair, share: f64) -> bool {
    others.iter().any(|other| {
        let tolerance = share * side.length().max(other.length());
        side.gap(node, other, pair, tolerance).is_some_and(|gap| gap < tolerance)
    })
}

/// First and last of those nodes of a closed side that are near the other body (`near`, ascending), beside the widest part of the
/// side without such nodes.
fn beside_the_widest_gap(side: &SmoothSide, near: &[usize]) -> Option<[usize; 2]> {
    let count = side.nodes();
    let next = |i: usize| near.get(i + 1).copied().unwrap_or(near[0] + count);
    let gap = |i: usize| side.unrolled(next(i)) - side.unrolled(near[i]);
    let widest = (0..near.len()).max_by(|&a, &b| gap(a).total_cmp(&gap(b)))?;
    if gap(widest) <= BRIDGED_EDGES * side.edge_length(0, count) {
        return Some([0, count]);
    }
    let (first, last) = (next(widest) % count, near[widest]);
    Some([first, if last < first { last + count } else { last }])
}

/// The stretch of body `k`'s boundary that is near the other body, and its part that is so; others may be at a corner only.
/// Nothing if none is.
///
/// # Errors
/// Words, if there are several.
pub fn only_near_part<'a>(
    sides: &'a [Vec<SmoothSide>; 2],
    k: usize,
    pair: &Pair,
    share: f64,
) -> Result<Option<(usize, NearPart<'a>)>, String> {
    let parts: Vec<_> = sides[k].iter().map(|side| NearPart::new(side, &sides[1 - k], pair, share)).collect();
    let length = |part: &Option<NearPart>| part.map_or(0.0, |part| part.length());
    let longest = parts.iter().enumerate().max_by(|a, b| length(a.1).total_cmp(&length(b.1)));
    let Some((stretch, Some(part))) = longest else { return Ok(None) };
    let touching: Vec<usize> = (0..parts.len()).filter(|&other| length(&parts[other]) > 0.05 * part.length()).collect();
    if touching.len() == 1 {
        return Ok(Some((stretch, *part)));
    }
    let [own, other] = [k, 1 - k].map(|k| &pair.between[k]);
    let (splits, remedy) = what_splits(&sides[k], &touching);
    Err(format!("\"{own}\" {splits} touch \"{other}\"; {remedy}"))
}

/// Why the stretches of a boundary that touch are several, in words between its name and "touch", and what may be done.
fn what_splits(sides: &[SmoothSide], touching: &[usize]) -> (String, String) {
    let others = |k: usize| (0..sides.len()).filter(move |&other| other != k).map(move |other| (k, other));
    let turns = touching.iter().flat_map(|&k| others(k)).filter_map(|(k, other)| corner(&sides[k], &sides[other]));
    let count = touching.len();
    match turns.reduce(f64::max) {
        None => (format!("is of pieces that do not hang together, {count} of which"), OF_ITS_OWN.into()),
        Some(_) if is_torn(sides, touching) => (
            format!("is torn where its nodes lie on each other and are not merged, and {count} of its pieces"),
            "merge the nodes (`Coherence Mesh` in Gmsh)".into(),
        ),
        Some(turn) if turn < JOINT => (
            format!("is of pieces with different shapes, {count} of which"),
            format!("{OF_ITS_OWN}; if they are one curve, mesh it finer where they meet"),
        ),
        Some(_) => (format!("has corners of more than 20 degrees, and {count} of its smooth stretches"), OF_ITS_OWN.into()),
    }
}

/// Whether straight stretches go on as each other: they would be one if they had a node in common.
fn is_torn(sides: &[SmoothSide], touching: &[usize]) -> bool {
    let is_smooth = |a: usize, b: usize| corner(&sides[a], &sides[b]).is_some_and(|turn| turn < STRAIGHT);
    touching.iter().all(|&k| sides[k].shape.is_line() && touching.iter().any(|&other| other != k && is_smooth(k, other)))
}

/// The largest angle (radians) between two stretches where an end of one is an end of the other.
fn corner(side: &SmoothSide, other: &SmoothSide) -> Option<f64> {
    let least = 1e-9 * side.length();
    let pairs = ends(side).into_iter().flat_map(|a| ends(other).map(|b| (a, b)));
    pairs.filter(|(a, b)| (a.0 - b.0).norm() <= least).map(|(a, b)| a.1.angle(&-b.1)).reduce(f64::max)
}

/// Both ends of a stretch, each with the direction in which it goes on there.
fn ends(side: &SmoothSide) -> [(Point, Point); 2] {
    let curve = side.curve(Configuration::Reference);
    let [first, last] = [0.0, side.length()];
    [(curve.point(first), -curve.tangent(first)), (curve.point(last), curve.tangent(last))]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Curve;

    /// A circle of 40 nodes, counted against the clock; the last is the first again.
    fn circle() -> SmoothSide {
        let at = |k: usize| Point::new((9.0 * k as f64).to_radians().cos(), (9.0 * k as f64).to_radians().sin());
        let points: Vec<Point> = (0..=40).map(at).collect();
        SmoothSide::through(Curve::Circle { centre: [0.0, 0.0], radius: 1.0 }, points.clone(), points, 1.0, 1, true)
    }

    #[test]
    fn nodes_that_are_not_merged_are_told_from_shapes_that_differ() {
        let line = |[from, to]: [[f64; 2]; 2]| {
            let at = |k: usize| Point::from(from) + k as f64 / 4.0 * (Point::from(to) - Point::from(from));
            let points: Vec<Point> = (0..=4).map(at).collect();
            SmoothSide::through(Curve::Line([from, to]), points.clone(), points, 1.0, 1, false)
        };
        let words = |second| what_splits(&[line([[0.0, 0.0], [1.0, 0.0]]), line(second)], &[0, 1]);
        let (torn, remedy) = words([[1.0, 0.0], [2.0, 0.0]]);
        assert!(torn.contains("not merged") && remedy.contains("merge the nodes"), "{torn}{remedy}");
        assert!(words([[1.0, 0.0], [2.0, 0.2]]).0.contains("different shapes"));
        assert!(words([[1.0, 0.0], [1.0, 1.0]]).0.contains("corners"));
        assert!(words([[1.5, 0.0], [2.0, 0.0]]).0.contains("do not hang together"));
    }

    #[test]
    fn a_part_of_a_closed_side_goes_by_way_of_its_middle_however_long_it_is() {
        let side = circle();
        let places = |nodes: [usize; 3]| nodes.map(|node| side.points[node % 40]);
        for (nodes, wanted) in [([5, 10, 15], [4, 16]), ([5, 20, 35], [4, 36]), ([35, 40, 45], [34, 46])] {
            for places in [places(nodes), places([nodes[2], nodes[1], nodes[0]])] {
                assert_eq!(NearPart::beside(&side, places).nodes, wanted, "{nodes:?}");
            }
        }
    }
}
