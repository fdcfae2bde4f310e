//! Where two bodies touch or penetrate each other: the ends of Γ_C, and the nodes whose points half-way it is fitted to.

use crate::contact::contact_boundary::ContactBoundary;
use crate::contact::fit::bisector::Bisector;
use crate::contact::fit::near_part::{NearPart, is_near, only_near_part};
use crate::contact::fit::node_window::NodeWindow;
use crate::contact::fit::own_curve::OwnCurve;
use crate::contact::pair::{GapChoice, Pair};
use crate::contact::penetration::rows_beyond;
use crate::contact::smooth_side::SmoothSide;
use crate::geometry::{Coordinates, Curve, Point};
use std::ops::Range;

/// Before anything is solved, nodes closer to the other body than this share of the boundary's length count as touching.
const MEETS_AT_REST: f64 = 1e-3;

/// Multiples of [`MEETS_AT_REST`] within which bodies are looked for that are about to touch, the widest first.
const WIDENINGS: [f64; 4] = [64.0, 16.0, 4.0, 1.0];

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

/// Overlaps of two bodies beyond the ends of their Γ_C.
pub struct OverlapBeyond {
    /// Of all nodes that count, the deepest (length).
    pub depth: f64,
    /// Of those with an open node between them and Γ_C, which has lost them, the deepest (length).
    pub lost: f64,
    /// Parameters of the ends of a Γ_C that takes these in.
    pub ends: [f64; 2],
}

impl Meeting {
    /// Where undeformed bodies touch, or are about to: the tolerance grows until both have two nodes in reach.
    ///
    /// # Errors
    /// Words, if they are far apart, or touch on more than one stretch.
    pub fn at_rest(sides: &[Vec<SmoothSide>; 2], pair: &Pair) -> Result<Self, String> {
        for factor in WIDENINGS.iter().rev() {
            if let Some(meeting) = Self::within(sides, pair, factor * MEETS_AT_REST)? {
                return Ok(meeting);
            }
        }
        Err(why_apart(sides, pair))
    }

    /// Stretches on which undeformed bodies face each other with a gap that small strains, or a small motion, may close: the widest
    /// first.
    pub fn within_reach<'a>(sides: &'a [Vec<SmoothSide>; 2], pair: &'a Pair) -> impl Iterator<Item = Self> + 'a {
        WIDENINGS.iter().filter_map(|factor| Self::within(sides, pair, factor * MEETS_AT_REST).ok().flatten())
    }

    /// Beside a Γ_C that has these ends, with a place between them: from the node before the one nearest to the first of them to the node
    /// behind the other one.
    pub fn beside(sides: &[Vec<SmoothSide>; 2], pair: &Pair, places: [Point; 3]) -> Option<Self> {
        let nearest = |stretches: &[SmoothSide]| {
            let away = |at: &usize| {
                [places[0], places[2]].map(|x| (stretches[*at].nearest_place(x).0 - x).norm()).into_iter().fold(0.0, f64::max)
            };
            (0..stretches.len()).min_by(|a, b| away(a).total_cmp(&away(b)))
        };
        let stretches = [nearest(&sides[0])?, nearest(&sides[1])?];
        Some(Self::on_a_part([0, 1].map(|k| NearPart::beside(&sides[k][stretches[k]], places)), stretches, pair))
    }

    /// Where nodes of both sides are nearer to the other one than a share of the length; nothing if none are.
    ///
    /// # Errors
    /// Words, if they are so on more than one stretch.
    fn within(sides: &[Vec<SmoothSide>; 2], pair: &Pair, share: f64) -> Result<Option<Self>, String> {
        let Some((first, part)) = only_near_part(sides, 0, pair, share)? else { return Ok(None) };
        let Some((second, other)) = only_near_part(sides, 1, pair, share)? else { return Ok(None) };
        let goes_round = part.is_whole() && other.is_whole();
        let build = if goes_round { Self::around } else { Self::on_a_part };
        Ok(Some(build([part, other], [first, second], pair)))
    }

    /// All around two closed sides.
    fn around(parts: [NearPart; 2], stretches: [usize; 2], pair: &Pair) -> Self {
        let sides = parts.map(|part| part.side);
        let length = sides[0].length();
        let (ends, origin) = match OwnCurve::of_pair(sides, pair) {
            Some(own) => (own.turn(), (0.0, None)),
            None => ([0.0, length], (0.0, Some(length))),
        };
        Self { origin, goes_round: true, ..Self::open(stretches, sides.map(|side| 0..side.nodes()), ends) }
    }

    /// Where one of two sides at least is open, or near the other on a part only. Closed ones are begun opposite to that.
    fn on_a_part(parts: [NearPart; 2], stretches: [usize; 2], pair: &Pair) -> Self {
        let seams = [0, 1].map(|k| parts[k].seam(&parts[1 - k], pair.configuration));
        let shifts = OwnCurve::shifts(parts.map(|part| part.side), pair);
        let begun = [0, 1].map(|k| parts[k].side.laid(seams[k], shifts[k]));
        let begun_parts = [0, 1].map(|k| NearPart { side: &begun[k], nodes: parts[k].counted_from(seams[k]) });
        let meeting = Self { seams, shifts, ..Self::between(begun_parts, stretches, pair) };
        match OwnCurve::of_pair(begun.each_ref(), pair) {
            Some(own) => Self { ends: own.ends(meeting.ends), ..meeting },
            None => Self { origin: (parts[0].side.parameters[seams[0]], parts[0].side.turn()), ..meeting },
        }
    }

    /// From the first to the last node that is near, where both bodies have such nodes, and one edge farther.
    fn between(parts: [NearPart; 2], stretches: [usize; 2], pair: &Pair) -> Self {
        let ([first, second], [own, other]) = (parts.map(|part| part.side), parts.map(|part| part.nodes));
        let configuration = pair.configuration;
        let far = other.map(|k| first.nearest(second.positions(configuration)[k], configuration));
        // A body that is near all around has no first and no last node there.
        let [low, high] = match parts[1].is_whole() {
            true => [f64::NEG_INFINITY, f64::INFINITY],
            false => [far[0].min(far[1]), far[0].max(far[1])],
        };
        let edge = first.edge_length(own[0], own[1]).max(second.edge_length(other[0], other[1]));
        let ends = [first.parameters[own[0]].max(low) - edge, first.parameters[own[1]].min(high) + edge];
        let mut nodes = [own, other].map(|[from, to]| from..to + 1);
        NodeWindow::new([first, second], configuration, ends, 1.0).take_in(&mut nodes);
        Self::open(stretches, nodes, ends)
    }

    /// On stretches that are begun where they are by themselves, with a Γ_C that lies apart from none.
    fn open(stretches: [usize; 2], nodes: [Range<usize>; 2], ends: [f64; 2]) -> Self {
        let (seams, shifts) = ([0; 2], [Point::zeros(); 2]);
        Self { stretches, nodes, ends, seams, origin: (0.0, None), goes_round: false, shifts }
    }

    /// Begins closed sides at the seams that this counts from, and tells each how far Γ_C is shifted from it.
    pub fn begin(&self, sides: &mut [Vec<SmoothSide>; 2]) {
        for (k, stretches) in sides.iter_mut().enumerate() {
            let side = &mut stretches[self.stretches[k]];
            *side = side.laid(self.seams[k], self.shifts[k]);
        }
    }

    /// Where nodes of body 1 lie in body 2 as they are now beyond the ends of Γ_C; `margin` (length) is how far beyond they begin to
    /// count for the depth.
    pub fn overlap_beyond(
        &self,
        sides: &[Vec<SmoothSide>; 2],
        pair: &Pair,
        boundary: &ContactBoundary,
        margin: f64,
    ) -> OverlapBeyond {
        let [first, second] = self.sides(sides);
        let ends = boundary.ends();
        let own = OwnCurve::of_pair([first, second], pair);
        let margins = if own.is_some() { ends.map(|t| margin / boundary.speed(t)) } else { [margin; 2] };
        // Γ_C may lie across the seam of a closed side: places are counted from its middle.
        let turn = own.as_ref().map_or(first.turn(), |own| own.curve.period());
        let middle = 0.5 * (ends[0] + ends[1]);
        let node = |node: usize| {
            let place = own.as_ref().map_or(first.parameters[node], |own| own.node(node));
            let place = turn.map_or(place, |turn| place - turn * ((place - middle) / turn).round());
            let gaps = first.facing_gaps(node, second, pair, 1e-9 * second.length());
            (place, gaps.map_or(0.0, |gaps| -gaps.now))
        };
        let mut nodes: Vec<_> = (0..first.points.len()).map(node).collect();
        nodes.sort_by(|a, b| a.0.total_cmp(&b.0));
        nodes.iter_mut().for_each(|(place, _)| *place = (*place - ends[1]).max(0.0) + (*place - ends[0]).min(0.0));
        let beyond = nodes.iter().filter(|(away, _)| *away < -margins[0] || *away > margins[1]);
        let mut found = OverlapBeyond { depth: beyond.fold(0.0, |depth, node| depth.max(node.1)), lost: 0.0, ends };
        for &(away, overlap) in rows_beyond(&nodes).into_iter().flatten() {
            found.lost = found.lost.max(overlap);
            match away < 0.0 {
                true => found.ends[0] = found.ends[0].min(ends[0] + away - margins[0]),
                false => found.ends[1] = found.ends[1].max(ends[1] + away + margins[1]),
            }
        }
        found
    }

    /// The curve of Γ_C and the parameters up to which both sides are there: that of one of the sides, or the curve half-way
    /// between both, from an edge before these ends of Γ_C to an edge behind.
    ///
    /// # Errors
    /// Words, if the sides do not face each other there, or if the pair wants more spans than the nodes bear.
    pub fn curve(&mut self, sides: &[Vec<SmoothSide>; 2], pair: &Pair, ends: [f64; 2]) -> Result<(Curve, [f64; 2]), String> {
        let both = self.sides(sides);
        if let Some(own) = OwnCurve::of_pair(both, pair) {
            let limits = if self.goes_round { own.turn() } else { own.limits(0.5 * (ends[0] + ends[1])) };
            return Ok((own.curve.clone(), limits));
        }
        let bisector = if self.goes_round {
            Bisector::around(both, pair)
        } else {
            // The spans of the curve are for what lies between.
            NodeWindow::new(both, pair.configuration, ends, 2.0).leave_outer(&mut self.nodes);
            NodeWindow::new(both, pair.configuration, ends, 1.0).take_in(&mut self.nodes);
            Bisector::between(both, &self.nodes, pair)
        };
        bisector.map(|bisector| (bisector.curve, bisector.limits))
    }

    /// The two stretches that meet.
    pub fn sides<'a>(&self, sides: &'a [Vec<SmoothSide>; 2]) -> [&'a SmoothSide; 2] {
        [0, 1].map(|k| &sides[k][self.stretches[k]])
    }
}

/// Why bodies meet nowhere, in words, and what to do.
fn why_apart(sides: &[Vec<SmoothSide>; 2], pair: &Pair) -> String {
    let [first, second] = &pair.between;
    let is_undefined = |side: &SmoothSide, node: usize, others: &[SmoothSide]| {
        others.iter().any(|other| side.gap(node, other, pair, other.length()).is_some_and(|gap| !gap.is_finite()))
    };
    if let GapChoice::Formula(formula) = &pair.gap
        && let Some(x) = find_node(sides, is_undefined)
    {
        return format!(
            "gap = {} is no number at {}, and small over no length elsewhere; correct the formula: it needs a value wherever \"{first}\" and \"{second}\" may touch",
            formula.text(),
            Coordinates(x)
        );
    }
    if let Some(x) = find_node(sides, |side, node, others| is_near(side, node, others, pair, WIDENINGS[0] * MEETS_AT_REST)) {
        return format!(
            "curve = \"fit\", but \"{first}\" and \"{second}\" come near each other at one node only, at {}: a corner, or edges too long; refine the mesh there",
            Coordinates(x)
        );
    }
    let remedy = match pair.gap {
        GapChoice::Geometry => "move the bodies together, or give a smaller `gap`, a number or a formula",
        GapChoice::Closed => "move the bodies together: gap = \"closed\" says that they touch",
        GapChoice::Formula(_) => "give a smaller `gap`, or name boundaries that face each other",
    };
    format!(
        "curve = \"fit\", but the gap between \"{first}\" and \"{second}\" is wider than 6 % of their length everywhere, or they do not face each other; {remedy}"
    )
}

/// Position of the first node of either side for which something holds of the stretches of the other side.
fn find_node(sides: &[Vec<SmoothSide>; 2], holds: impl Fn(&SmoothSide, usize, &[SmoothSide]) -> bool) -> Option<Point> {
    let all = (0..2).flat_map(|k| sides[k].iter().map(move |side| (side, &sides[1 - k])));
    let mut nodes = all.flat_map(|(side, others)| (0..side.points.len()).map(move |node| (side, node, others)));
    nodes.find(|(side, node, others)| holds(side, *node, others)).map(|(side, node, _)| side.points[node])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::pair::{Configuration, CurveChoice};
    use crate::contact::samples::seam;
    use crate::element::Order;
    use crate::geometry::{Formula, ParametricCurve};
    use crate::mesh::samples::two_blocks;
    use crate::mesh::{EdgeNode, Level, Numbering, Partition};
    use std::rc::Rc;

    fn pair() -> Pair {
        Pair { curve: CurveChoice::Fit, configuration: Configuration::Deformed, ..seam() }
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
        let meeting = Meeting::open([0, 0], [0..17, 0..33], [0.0, 2.0]);
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
            let found = meeting.overlap_beyond(&sides, &pair(), &part(ends), margin).depth;
            assert!((found - depth).abs() < 1e-5, "{found} beyond {ends:?} by {margin}, instead of {depth}");
        }
        assert_eq!(meeting.overlap_beyond(&lowered(|_| -0.01), &pair(), &part([0.5, 1.0]), 0.1).depth, 0.0, "they are apart");
    }

    /// The upper block lies in the lower one around x = .3 and from 1.2 on, and Γ_C has the second stretch alone.
    #[test]
    fn the_ends_take_in_what_overlaps_apart_from_them() {
        let meeting = Meeting::open([0, 0], [0..17, 0..33], [0.0, 2.0]);
        let sides = lowered(|x| if x < 0.5 { 0.02 - 0.1 * (x - 0.3).abs() } else { 0.05 * (x - 1.2) });
        let found = |ends| meeting.overlap_beyond(&sides, &pair(), &part(ends), 0.1);
        // Nodes of body 1 at .125, .25 and .375 overlap, by .0025, .015 and .0125.
        let apart = found([1.0, 2.0]);
        assert!((apart.lost - 0.015).abs() < 1e-3, "{}", apart.lost);
        assert!((apart.ends[0] - 0.025).abs() < 0.02 && apart.ends[1] == 2.0, "{:?}", apart.ends);
        let beside = found([0.3, 2.0]);
        assert_eq!((beside.lost, beside.ends), (0.0, [0.3, 2.0]), "what goes on from its end is its own");
    }

    /// A pin in a bore, drawn in it where Γ_C lies, which goes across the seam of both: nothing lies beyond it.
    #[test]
    fn a_contact_boundary_across_the_seam_of_its_sides_has_lost_nothing() {
        let ring = |radius: f64, x: f64, hand: f64| {
            let points: Vec<Point> = (0..=40)
                .map(|k| (9.0 * f64::from(k)).to_radians())
                .map(|a| Point::new(x + radius * a.cos(), radius * a.sin()))
                .collect();
            vec![SmoothSide::through(Curve::Circle { centre: [x, 0.0], radius }, points.clone(), points, hand, 2, true)]
        };
        let sides = [ring(1.0, 0.05, 1.0), ring(1.02, 0.0, -1.0)];
        let meeting = Meeting::within(&sides, &pair(), 1.0).expect("one stretch").expect("they are near all around");
        let circle = Curve::Circle { centre: [0.0, 0.0], radius: 1.0 };
        let found = |ends| {
            meeting.overlap_beyond(&sides, &pair(), &ContactBoundary::new(circle.clone(), ends, Point::new(1.0, 0.0)), 0.1)
        };
        let across = found([-1.5, 1.5]);
        assert_eq!((across.depth, across.lost), (0.0, 0.0));
        assert!(found([1.7, 4.5]).depth > 0.02, "the other half has none of it");
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
        let ends = [1.55, 1.65];
        let mut meeting = Meeting::open([0, 0], nodes, ends);
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
