//! Where two bodies touch or penetrate each other: the ends of Γ_C, and the nodes whose points half-way it is fitted to.

use super::bisector::Bisector;
use super::own_curve::{OwnCurve, shortest_way};
use super::smooth_side::SmoothSide;
use super::{Configuration, ContactBoundary, CurveChoice, GapChoice, Pair, Side};
use crate::geometry::{Curve, Point};
use std::ops::Range;

/// Before anything is solved, nodes closer to the other body than this share of the boundary's length count as touching.
const MEETS_AT_REST: f64 = 1e-3;

/// Multiples of it that are tried.
const REACH: [f64; 4] = [64.0, 16.0, 4.0, 1.0];

/// Pieces that meet at a smaller angle (radians) are not split by a corner there.
const JOINT: f64 = 0.3;

/// Where two sides meet: what Γ_C is fitted to, and its ends.
#[derive(Clone, Debug, PartialEq)]
pub struct Meeting {
    /// Which stretch of each boundary.
    pub stretches: [usize; 2],
    /// Nodes of each that the curve is fitted to, counted from its seam.
    pub nodes: [Range<usize>; 2],
    /// Parameters of the ends of Γ_C: on body 1's stretch, from its seam, or on the curve of the side that Γ_C lies on.
    pub ends: [f64; 2],
    /// Node at which each stretch is begun, if it is closed: opposite to where the bodies meet.
    pub seams: [usize; 2],
    /// Parameter of body 1's seam on the stretch as it is by itself, and the length of one turn, if it is closed and the ends are
    /// counted from there.
    pub origin: (f64, Option<f64>),
    /// Whether they meet all around.
    pub goes_round: bool,
    /// The way from each side to Γ_C, where that has its shape (length).
    pub shifts: [Point; 2],
}

/// Nodes of one stretch that are near the other body: first and last. Of a closed one the last may lie a turn farther, and it
/// does so in all if only few nodes are not near.
type Near = Option<[usize; 2]>;

/// Edges without contact that do not make two ends of a contact that goes all around but for them.
const FEW: f64 = 4.0;

impl Meeting {
    /// Where undeformed bodies touch, or are about to: the tolerance grows until both have two nodes in reach.
    ///
    /// # Errors
    /// Words, if they are far apart, or touch on more than one stretch.
    pub fn at_rest(sides: &[Vec<SmoothSide>; 2], pair: &Pair) -> Result<Self, String> {
        for factor in REACH.iter().rev() {
            if let Some(found) = Self::within(sides, pair, factor * MEETS_AT_REST)? {
                return Ok(found);
            }
        }
        let [first, second] = &pair.between;
        if let (GapChoice::Formula(formula), Some(x)) = (&pair.gap, undefined_node(sides, pair)) {
            return Err(format!(
                "gap = {} is no number at ({:.6}, {:.6}), and small over no length elsewhere; correct the formula: it needs a value wherever \"{first}\" and \"{second}\" may touch",
                formula.text(),
                x.x,
                x.y
            ));
        }
        if let Some(x) = nearest_node(sides, pair, 64.0 * MEETS_AT_REST) {
            return Err(format!(
                "curve = \"fit\", but \"{first}\" and \"{second}\" come near each other at one node only, at ({}, {}): a corner, or edges too long; refine the mesh there",
                x.x, x.y
            ));
        }
        let remedy = match pair.gap {
            GapChoice::Geometry => "move the bodies together, or give `gap` as a number or a formula",
            GapChoice::Closed => "move the bodies together: gap = \"closed\" says that they touch",
            GapChoice::Formula(_) => "correct `gap`, or name boundaries that face each other",
        };
        Err(format!(
            "curve = \"fit\", but the gap between \"{first}\" and \"{second}\" is wider than 6 % of their length everywhere, or they do not face each other; {remedy}"
        ))
    }

    /// Stretches on which undeformed bodies face each other with a gap that small strains, or a small motion, may close: the widest
    /// first.
    pub fn within_reach<'a>(sides: &'a [Vec<SmoothSide>; 2], pair: &'a Pair) -> impl Iterator<Item = Self> + 'a {
        REACH.iter().filter_map(|factor| Self::within(sides, pair, factor * MEETS_AT_REST).ok().flatten())
    }

    /// Beside a Γ_C that has these ends: from the node before the one nearest to the first of them to the node behind the other one.
    pub fn beside(sides: &[Vec<SmoothSide>; 2], pair: &Pair, ends: [Point; 2]) -> Option<Self> {
        let mut found = Vec::new();
        for stretches in sides {
            let away = |at: &usize| ends.map(|x| (stretches[*at].nearest_place(x).0 - x).norm()).into_iter().fold(0.0, f64::max);
            let stretch = (0..stretches.len()).min_by(|a, b| away(a).total_cmp(&away(b)))?;
            let side = &stretches[stretch];
            let [a, b] = ends.map(|x| side.nearest_node(x));
            let round = side.turn().map(|_| side.nodes());
            let way = |from: usize, to: usize| round.map(|count| (to + count - from) % count);
            let near = match (way(a, b), way(b, a)) {
                (Some(there), Some(back)) => {
                    let first = if back < there { b } else { a };
                    let before = (first + side.nodes() - 1) % side.nodes();
                    [before, before + there.min(back) + 2]
                }
                _ => [a.min(b).saturating_sub(1), (a.max(b) + 1).min(side.nodes() - 1)],
            };
            found.push((stretch, near));
        }
        let [first, second] = [found[0], found[1]];
        let of = |k: usize, (stretch, near): (usize, [usize; 2])| (&sides[k][stretch], near);
        Some(Self::on_a_part([of(0, first), of(1, second)], [first.0, second.0], pair))
    }

    fn within(sides: &[Vec<SmoothSide>; 2], pair: &Pair, share: f64) -> Result<Option<Self>, String> {
        let near: [Vec<Near>; 2] =
            [0, 1].map(|k| sides[k].iter().map(|side| near_nodes(side, &sides[1 - k], pair, share)).collect());
        let mut stretches = [0; 2];
        for k in 0..2 {
            let Some(found) = only_stretch(&sides[k], &near[k]).map_err(|touching| {
                format!(
                    "\"{}\" {} touch \"{}\"; give each a name and a contact of its own, or tell the curve of all by a [geometry]",
                    pair.between[k],
                    what_splits(&sides[k], &touching),
                    pair.between[1 - k]
                )
            })?
            else {
                return Ok(None);
            };
            stretches[k] = found;
        }
        let of = |k: usize| (&sides[k][stretches[k]], near[k][stretches[k]].unwrap_or([0; 2]));
        let [first, second] = [of(0), of(1)];
        if [first, second].iter().all(|(side, near)| is_whole(side, *near)) {
            return Ok(Some(Self::around([first.0, second.0], stretches, pair)));
        }
        Ok(Some(Self::on_a_part([first, second], stretches, pair)))
    }

    /// All around two closed sides.
    fn around(sides: [&SmoothSide; 2], stretches: [usize; 2], pair: &Pair) -> Self {
        let length = sides[0].length();
        let nodes = sides.map(|side| 0..side.nodes());
        let (ends, origin) = match own_curve(sides, pair) {
            Some(own) => (own.turn(), (0.0, None)),
            None => ([0.0, length], (0.0, Some(length))),
        };
        Self { stretches, nodes, ends, seams: [0; 2], origin, goes_round: true, shifts: [Point::zeros(); 2] }
    }

    /// Where one of two sides at least is open, or near the other on a part only. Closed ones are begun opposite to that.
    fn on_a_part(sides: [(&SmoothSide, [usize; 2]); 2], stretches: [usize; 2], pair: &Pair) -> Self {
        let middles = sides.map(|(side, near)| (!is_whole(side, near)).then(|| near.iter().sum::<usize>() / 2));
        let seams = [0, 1].map(|k| {
            let ((side, _), (other, _)) = (sides[k], sides[1 - k]);
            // What is near all around has its middle where the other side has its own.
            let across = || {
                let x = other.positions(pair.configuration)[middles[1 - k]? % other.nodes()];
                let away = |node: &usize| (side.positions(pair.configuration)[*node] - x).norm();
                (0..side.nodes()).min_by(|a, b| away(a).total_cmp(&away(b)))
            };
            let middle = side.turn().and_then(|_| middles[k].or_else(across));
            middle.map_or(0, |middle| (middle + side.nodes() / 2) % side.nodes())
        });
        let shifts = shifts(sides.map(|(side, _)| side), pair);
        let begun = [0, 1].map(|k| {
            let (side, near) = sides[k];
            let from_seam =
                |near| if is_whole(side, near) { [0, side.nodes()] } else { counted_from(seams[k], near, side.nodes()) };
            let near = if side.turn().is_some() { from_seam(near) } else { near };
            (side.laid(seams[k], shifts[k]), near)
        });
        let of = |k: usize| (&begun[k].0, begun[k].1);
        let meeting = Self { seams, shifts, ..Self::between([of(0), of(1)], stretches, pair) };
        match own_curve([of(0).0, of(1).0], pair) {
            Some(own) => Self { ends: own.ends(meeting.ends), ..meeting },
            None => Self { origin: (sides[0].0.parameters[seams[0]], sides[0].0.turn()), ..meeting },
        }
    }

    /// Begins closed sides at the seams that this counts from, and tells each how far Γ_C is shifted from it.
    pub fn begin(&self, sides: &mut [Vec<SmoothSide>; 2]) {
        for (k, stretches) in sides.iter_mut().enumerate() {
            let side = &mut stretches[self.stretches[k]];
            *side = side.laid(self.seams[k], self.shifts[k]);
        }
    }

    /// From the first to the last node that is near, where both bodies have such nodes, and one edge farther.
    fn between(sides: [(&SmoothSide, [usize; 2]); 2], stretches: [usize; 2], pair: &Pair) -> Self {
        let [(first, own), (second, other)] = sides;
        let configuration = pair.configuration;
        let far = other.map(|k| first.nearest(second.positions(configuration)[k], configuration));
        // A body that is near all around has no first and no last node there.
        let [low, high] = match is_whole(second, other) {
            true => [f64::NEG_INFINITY, f64::INFINITY],
            false => [far[0].min(far[1]), far[0].max(far[1])],
        };
        let edge = first.edge_length(own[0], own[1]).max(second.edge_length(other[0], other[1]));
        let ends = [first.parameters[own[0]].max(low) - edge, first.parameters[own[1]].min(high) + edge];
        let nodes = [own, other].map(|[from, to]| from..to + 1);
        let (seams, shifts) = ([0; 2], [Point::zeros(); 2]);
        let mut meeting = Self { stretches, nodes, ends, seams, origin: (0.0, None), goes_round: false, shifts };
        meeting.reach(ends, [first, second], pair);
        meeting
    }

    /// Leaves out nodes of both sides more than two edges beyond these ends of Γ_C: the spans of the curve are for what lies between.
    fn leave(&mut self, ends: [f64; 2], [first, second]: [&SmoothSide; 2], pair: &Pair) {
        let edge = edge_within(ends, [first, second], pair);
        let inside = |t: f64| t >= ends[0] - 2.0 * edge && t <= ends[1] + 2.0 * edge;
        for (k, side) in [first, second].into_iter().enumerate() {
            let parameter = |node: usize| match k {
                0 => first.parameters[node],
                _ => first.nearest(side.positions(pair.configuration)[node], pair.configuration),
            };
            let mut kept = self.nodes[k].clone().filter(|&node| inside(parameter(node)));
            if let Some(from) = kept.next() {
                self.nodes[k] = from..kept.next_back().unwrap_or(from) + 1;
            }
        }
    }

    /// Takes in nodes of both sides up to an edge beyond these ends of Γ_C.
    fn reach(&mut self, ends: [f64; 2], [first, second]: [&SmoothSide; 2], pair: &Pair) {
        let edge = edge_within(ends, [first, second], pair);
        let inside = |t: f64| t >= ends[0] - edge && t <= ends[1] + edge;
        for (k, side) in [first, second].into_iter().enumerate() {
            let parameter = |node: usize| match k {
                0 => first.parameters[node],
                _ => first.nearest(second.positions(pair.configuration)[node], pair.configuration),
            };
            let other = [second, first][k];
            let faces = |node: usize| {
                let foot = other.nearest(side.positions(pair.configuration)[node], pair.configuration);
                inside(parameter(node)) && side.looks_at(side.parameters[node], other, foot, pair.configuration)
            };
            let nodes = &mut self.nodes[k];
            while nodes.start > 0 && faces(nodes.start - 1) {
                nodes.start -= 1;
            }
            while nodes.end < side.points.len() && faces(nodes.end) {
                nodes.end += 1;
            }
        }
    }

    /// How deep nodes of body 1 lie in body 2 as they are now, more than `margin` beyond the ends of Γ_C.
    pub fn depth_beyond(&self, sides: &[Vec<SmoothSide>; 2], pair: &Pair, boundary: &ContactBoundary, margin: f64) -> f64 {
        let [first, second] = [0, 1].map(|k| &sides[k][self.stretches[k]]);
        let knots = boundary.knots();
        let ends = [knots[0], knots[knots.len() - 1]];
        let own = own_curve([first, second], pair);
        let margins = if own.is_some() { ends.map(|t| margin / boundary.speed(t)) } else { [margin; 2] };
        let [low, high] = [ends[0] - margins[0], ends[1] + margins[1]];
        let place = |node: usize| own.as_ref().map_or(first.parameters[node], |own| own.node(node));
        let beyond = (0..first.points.len()).filter(|&node| place(node) < low || place(node) > high);
        let depth = beyond.filter_map(|node| first.facing_gaps(node, second, pair, 1e-9 * second.length())).map(|gaps| -gaps.now);
        depth.fold(0.0, f64::max)
    }

    /// The curve of Γ_C and the parameters up to which both sides are there: that of one of the sides, or the curve half-way
    /// between both, from an edge before these ends of Γ_C to an edge behind.
    ///
    /// # Errors
    /// Words, if the sides do not face each other there, or if the pair wants more spans than the nodes bear.
    pub fn curve(&mut self, sides: &[Vec<SmoothSide>; 2], pair: &Pair, ends: [f64; 2]) -> Result<(Curve, [f64; 2]), String> {
        let both = self.sides(sides);
        if let Some(own) = own_curve(both, pair) {
            let limits = if self.goes_round { own.turn() } else { own.limits(0.5 * (ends[0] + ends[1])) };
            return Ok((own.curve().clone(), limits));
        }
        let found = if self.goes_round {
            Bisector::around(both, pair)
        } else {
            self.leave(ends, both, pair);
            self.reach(ends, both, pair);
            Bisector::between(both, &self.nodes, pair)
        };
        found.map(|found| (found.curve, found.limits))
    }

    /// The two stretches that meet.
    pub fn sides<'a>(&self, sides: &'a [Vec<SmoothSide>; 2]) -> [&'a SmoothSide; 2] {
        [0, 1].map(|k| &sides[k][self.stretches[k]])
    }
}

/// The curve of the side that Γ_C lies on, if it lies on one; closed sides are begun at their seams.
fn own_curve<'a>(sides: [&'a SmoothSide; 2], pair: &Pair) -> Option<OwnCurve<'a>> {
    match pair.curve {
        CurveChoice::Own(side) => Some(OwnCurve::new(sides, side)),
        CurveChoice::Fit | CurveChoice::Line | CurveChoice::Geometry => None,
    }
}

/// How far Γ_C is shifted from the side that it has the shape of.
fn shifts([first, second]: [&SmoothSide; 2], pair: &Pair) -> [Point; 2] {
    let way = |side, other| shortest_way(side, other).unwrap_or_default();
    match pair.curve {
        CurveChoice::Own(Side::First) => [way(first, second), Point::zeros()],
        CurveChoice::Own(Side::Second) => [Point::zeros(), way(second, first)],
        CurveChoice::Fit | CurveChoice::Line | CurveChoice::Geometry => [Point::zeros(); 2],
    }
}

/// The longest edge of both sides that Γ_C meets between these ends: long ones beside fine ones are no measure of it.
fn edge_within(ends: [f64; 2], [first, second]: [&SmoothSide; 2], pair: &Pair) -> f64 {
    let far = ends.map(|t| second.nearest(first.curve(pair.configuration).point(t), pair.configuration));
    let longest = |side: &SmoothSide, [a, b]: [f64; 2]| {
        let beside = |t: f64| side.parameters.partition_point(|own| *own < t);
        side.edge_length(beside(a.min(b)).saturating_sub(1), beside(a.max(b)))
    };
    longest(first, ends).max(longest(second, far))
}

/// A node of either side that is near the other body.
fn nearest_node(sides: &[Vec<SmoothSide>; 2], pair: &Pair, share: f64) -> Option<Point> {
    let near = |side: &SmoothSide, others: &[SmoothSide]| {
        (0..side.points.len()).find(|&node| is_near(side, node, others, pair, share)).map(|node| side.points[node])
    };
    (0..2).find_map(|k| sides[k].iter().find_map(|side| near(side, &sides[1 - k])))
}

/// Whether a node touches or penetrates the other body, but for a share of the length.
fn is_near(side: &SmoothSide, node: usize, others: &[SmoothSide], pair: &Pair, share: f64) -> bool {
    others.iter().any(|other| {
        let tolerance = share * side.length().max(other.length());
        side.gap(node, other, pair, tolerance).is_some_and(|gap| gap < tolerance)
    })
}

/// Whether the nodes of a side that are near go all around it.
fn is_whole(side: &SmoothSide, near: [usize; 2]) -> bool {
    side.turn().is_some() && near[1] - near[0] >= side.nodes()
}

/// Nodes of a closed side as they are counted from its seam.
fn counted_from(seam: usize, [first, last]: [usize; 2], count: usize) -> [usize; 2] {
    let from = (first + count - seam) % count;
    [from, from + last - first]
}

/// First and last node of a closed side that is near some stretch of the other body, beside the widest part of it that is not.
fn near_nodes_around(side: &SmoothSide, near: impl Fn(&usize) -> bool, turn: f64) -> Near {
    let count = side.nodes();
    let all: Vec<usize> = (0..count).filter(near).collect();
    let next = |i: usize| if i + 1 < all.len() { all[i + 1] } else { all[0] + count };
    let place = |node: usize| side.parameters[node % count] + (node / count) as f64 * turn;
    let gap = |i: usize| place(next(i)) - place(all[i]);
    let widest = (0..all.len()).max_by(|&a, &b| gap(a).total_cmp(&gap(b)))?;
    if gap(widest) <= FEW * side.edge_length(0, count) {
        return Some([0, count]);
    }
    let (first, last) = (next(widest) % count, all[widest]);
    let last = if last < first { last + count } else { last };
    (last > first).then_some([first, last])
}

/// First and last node of a side that is near some stretch of the other body.
fn near_nodes(side: &SmoothSide, others: &[SmoothSide], pair: &Pair, share: f64) -> Near {
    let near = |&node: &usize| is_near(side, node, others, pair, share);
    if let Some(turn) = side.turn() {
        return near_nodes_around(side, near, turn);
    }
    let first = (0..side.points.len()).find(near)?;
    let last = (0..side.points.len()).rev().find(near)?;
    (last > first).then_some([first, last])
}

/// A node of either side at which the gap to the other body is no number.
fn undefined_node(sides: &[Vec<SmoothSide>; 2], pair: &Pair) -> Option<Point> {
    let undefined = |side: &SmoothSide, node: usize, other: &SmoothSide| {
        side.gap(node, other, pair, other.length()).is_some_and(|gap| !gap.is_finite())
    };
    let of = |side: &SmoothSide, others: &[SmoothSide]| {
        let node = (0..side.points.len()).find(|&node| others.iter().any(|other| undefined(side, node, other)));
        node.map(|node| side.points[node])
    };
    (0..2).find_map(|k| sides[k].iter().find_map(|side| of(side, &sides[1 - k])))
}

/// The stretch that touches; others may do so at a corner only. Nothing if none does.
///
/// # Errors
/// The stretches that touch, if there are several.
fn only_stretch(sides: &[SmoothSide], near: &[Near]) -> Result<Option<usize>, Vec<usize>> {
    let place = |side: &SmoothSide, node: usize| {
        let count = side.nodes();
        side.turn().map_or_else(|| side.parameters[node], |turn| side.parameters[node % count] + (node / count) as f64 * turn)
    };
    let length = |k: usize| near[k].map_or(0.0, |[a, b]| place(&sides[k], b) - place(&sides[k], a));
    let longest = (0..sides.len()).max_by(|&a, &b| length(a).total_cmp(&length(b)));
    let Some(longest) = longest.filter(|&k| near[k].is_some()) else { return Ok(None) };
    let touching: Vec<usize> = (0..sides.len()).filter(|&k| length(k) > 0.05 * length(longest)).collect();
    if touching.len() == 1 { Ok(Some(longest)) } else { Err(touching) }
}

/// Why the stretches of a boundary that touch are several, in words between its name and "touch".
fn what_splits(sides: &[SmoothSide], touching: &[usize]) -> String {
    // Both ends of a stretch, each with the direction in which it goes on there.
    let ends = |side: &SmoothSide| {
        let curve = side.curve(Configuration::Reference);
        let [first, last] = [0.0, side.length()];
        [(curve.point(first), -curve.tangent(first)), (curve.point(last), curve.tangent(last))]
    };
    let turn = |k: usize, other: usize| {
        let least = 1e-9 * sides[k].length();
        let pairs = ends(&sides[k]).into_iter().flat_map(|a| ends(&sides[other]).map(|b| (a, b)));
        pairs.filter(|(a, b)| (a.0 - b.0).norm() <= least).map(|(a, b)| a.1.angle(&-b.1)).reduce(f64::max)
    };
    let others = |k: usize| (0..sides.len()).filter(move |&other| other != k).map(move |other| (k, other));
    let turns = touching.iter().flat_map(|&k| others(k)).filter_map(|(k, other)| turn(k, other));
    let count = touching.len();
    match turns.reduce(f64::max) {
        None => format!("is of pieces that do not hang together, {count} of which"),
        Some(turn) if turn < JOINT => format!("is of pieces with different shapes, {count} of which"),
        Some(_) => format!("has corners of more than 20 degrees, and {count} of its smooth stretches"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::samples::seam;
    use crate::element::Order;
    use crate::geometry::{Curve, Formula, ParametricCurve};
    use crate::mesh::samples::two_blocks;
    use crate::mesh::{EdgeNode, Level, Numbering, Partition};
    use std::rc::Rc;

    fn pair() -> Pair {
        Pair { curve: super::super::CurveChoice::Fit, configuration: Configuration::Deformed, ..seam() }
    }

    /// The seam of the two blocks, nodes every eighth of an edge, the upper one lowered by a function of x.
    fn lowered(by: impl Fn(f64) -> f64) -> [Vec<SmoothSide>; 2] {
        let mesh = two_blocks();
        let numbering = Numbering::new(Level { intervals: 16, order: Order::P1 }, &Rc::new(Partition::new(&mesh, &[0; 6], 1)));
        let upper = mesh.bodies.iter().position(|name| name == "upper");
        let displacement = |node: EdgeNode| {
            let x = node.place(&mesh, &numbering);
            Point::new(0.0, if Some(mesh.body_beside(node.edge)) == upper { -by(x.x) } else { 0.0 })
        };
        SmoothSide::of_pair(&mesh, &numbering, &pair(), &displacement)
    }

    /// Γ_C over a part of the seam; its parameter is x.
    fn part([from, to]: [f64; 2]) -> ContactBoundary {
        let formula = |text| Formula::parse(text, &["t"]).expect("a formula");
        let curve = Curve::Parametric(ParametricCurve::new(formula("t"), formula("1"), [0.0, 2.0]));
        ContactBoundary::new(curve, [from, to], Point::new(0.0, 1.0))
    }

    #[test]
    fn the_depth_beyond_the_ends_is_that_of_the_deepest_node_outside_the_margin() {
        let meeting = Meeting {
            stretches: [0, 0],
            nodes: [0..17, 0..33],
            ends: [0.0, 2.0],
            seams: [0; 2],
            origin: (0.0, None),
            goes_round: false,
            shifts: [Point::zeros(); 2],
        };
        let sides = lowered(|x| 0.01 * x);
        // Nodes of body 1 lie at each eighth.
        for (ends, margin, depth) in [
            ([0.5, 1.0], 0.1, 0.02),
            ([0.5, 1.9], 0.2, 0.0025),
            ([0.5, 1.9], 0.05, 0.02),
            ([0.5, 2.0], 0.1, 0.00375),
            ([0.5, 2.0], 0.2, 0.0025),
            ([0.1, 1.9], 0.2, 0.0),
        ] {
            let found = meeting.depth_beyond(&sides, &pair(), &part(ends), margin);
            assert!((found - depth).abs() < 1e-5, "{found} beyond {ends:?} by {margin}, instead of {depth}");
        }
        assert_eq!(meeting.depth_beyond(&lowered(|_| -0.01), &pair(), &part([0.5, 1.0]), 0.1), 0.0, "they are apart");
    }

    /// A round body on a plane, with edges of .02 where they touch and of up to 1 beside them: what lies half-way bends as evenly as
    /// between fine edges. With the long ones it was tilted by 1e-3.
    #[test]
    fn long_edges_beside_fine_ones_do_not_tilt_the_curve() {
        let round = [-66, -51, -36, -21].into_iter().chain(-6..=8).chain([23, 38, 53, 68]).map(|a| f64::from(a).to_radians());
        let round: Vec<Point> = round.map(|a| Point::new(a.sin(), 1.0 - a.cos())).collect();
        let long = [-1.6, -1.1, -0.6, -0.35];
        let plane = long.into_iter().chain((-10..=10).map(|k| 0.01 * f64::from(k))).chain([0.35, 0.6, 1.1, 1.6]);
        let plane: Vec<Point> = plane.map(|x| Point::new(x, 0.0)).collect();
        let circle = Curve::Circle { centre: [0.0, 1.0], radius: 1.0 };
        let nodes = [0..plane.len(), 0..round.len()];
        let sides = [
            vec![SmoothSide::through(Curve::Line([[-1.6, 0.0], [1.6, 0.0]]), plane.clone(), plane, -1.0, 2, false)],
            vec![SmoothSide::through(circle, round.clone(), round, 1.0, 2, false)],
        ];
        let (seams, shifts) = ([0; 2], [Point::zeros(); 2]);
        let ends = [1.55, 1.65];
        let mut meeting = Meeting { stretches: [0, 0], nodes, ends, seams, origin: (0.0, None), goes_round: false, shifts };
        let (curve, _) = meeting.curve(&sides, &pair(), ends).expect("they face each other");
        for t in [1.55, 1.57, 1.6, 1.63, 1.65] {
            let (x, slope) = (curve.point(t), curve.derivative(t));
            assert!((slope.y / slope.x - 0.5 * x.x).abs() < 1e-4, "it turns at {x}: {slope}");
        }
    }

    /// Contact is where the upper block is lowered: from the first node to the last, and an edge of 0.125 farther.
    #[test]
    fn a_boundary_is_fitted_an_edge_beyond_where_bodies_penetrate() {
        let sides = lowered(|x| if (0.45..1.3).contains(&x) { 0.01 } else { -0.05 });
        let meeting = Meeting::within(&sides, &pair(), 1e-4).expect("one stretch").expect("they touch");
        let [first, last] = meeting.ends;
        assert!((first - (0.5 - 0.125)).abs() < 0.03 && (last - (1.25 + 0.125)).abs() < 0.03, "{:?}", meeting.ends);
        // Nodes of both as far as an edge beyond these ends.
        for (side, nodes) in meeting.sides(&sides).into_iter().zip(&meeting.nodes) {
            let [from, to] = [nodes.start, nodes.end - 1].map(|node| side.parameters[node]);
            assert!((first - from) > 0.0 && first - from < 0.126 && to - last > 0.0 && to - last < 0.126, "{from} to {to}");
        }
        assert_eq!(Meeting::within(&lowered(|_| -0.05), &pair(), 1e-4), Ok(None));
    }
}
