//! Γ_C of a pair, placed between two boundaries of the mesh and cut by the pair's rule.

mod looking;

use super::contact_boundary::ContactBoundary;
use super::cutting::fractions;
use super::pair::{Configuration, CurveChoice, Pair, SegmentRule};
use super::side::Side;
use super::smooth_side::{Displacement, SmoothSide};
use crate::contact::fit::{Meeting, PointContact, stray};
use crate::element::Order;
use crate::geometry::{Coordinates, Curve, Point};
use crate::mesh::{BoundaryEdge, MacroMesh, Numbering};
pub use looking::faces;
use looking::leave_what_looks_at;

/// What is known of a contact boundary from the last time it was placed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Known {
    /// Where the two sides meet, for one that is found by that.
    pub meeting: Option<Meeting>,
    /// Parameters of the ends of the contact boundary.
    pub ends: Option<[f64; 2]>,
    /// Number of segments of the contact boundary.
    pub segments: Option<usize>,
    /// Ends of the contact boundary as a coarser mesh has found them, if there was one.
    pub coarser: Option<[Point; 2]>,
    /// Where undeformed sides touch first, if they are smooth and convex against each other there: what its force presses on is as
    /// wide as Hertz has it.
    pub touch: Option<PointContact>,
}

/// A contact boundary with what it was placed by.
#[derive(Clone)]
pub struct Placed {
    /// Γ_C, cut.
    pub boundary: ContactBoundary,
    /// Parameters beyond which one of the bodies has no boundary; infinite where both go all around.
    pub limits: [f64; 2],
    /// Where the two sides meet, for one that is found by that.
    pub meeting: Option<Meeting>,
    /// Displacement of body 1 and of body 2 at both ends of Γ_C, where it lies on deformed bodies; zero elsewhere.
    pub moved: [[Point; 2]; 2],
    /// Edges of body 1 and of body 2 that it lies between.
    pub edges: [Vec<BoundaryEdge>; 2],
    /// Moduli of both bodies (stress), by which the softer one is told.
    young: [f64; 2],
}

impl Placed {
    /// Γ_C where it lies, cut into segments by the rule of a pair, or into so many as are known.
    pub fn cut(mut self, order: Order, pair: &Pair, known: Option<usize>) -> Self {
        self.boundary.cut(&fractions(&self.edges, order, pair, self.young, &self.boundary, known));
        self
    }
}

/// Places Γ_C of a pair and cuts it into segments. `young` are the moduli of body 1 and body 2 (stress); `numbering`
/// is that of the finest level, whose edge lengths the automatic rule follows; a curve that follows the bodies is fitted
/// to their nodes moved by `displacement`. The same on every rank.
///
/// # Errors
/// Words, if the boundaries are not straight or do not share a geometry, as the pair claims, or do not overlap.
pub fn place(
    mesh: &MacroMesh,
    numbering: &Numbering,
    pair: &Pair,
    young: [f64; 2],
    known: &Known,
    displacement: Displacement,
) -> Result<Placed, String> {
    let sides = [0, 1].map(|k| mesh.edges_of(&pair.between[k]));
    let mut fitted = None;
    let (curve, limits) = match pair.curve {
        CurveChoice::Fit | CurveChoice::Own(_) => {
            let mut smooth = SmoothSide::of_pair(mesh, numbering, pair, displacement);
            let mut meeting = known.meeting.clone().map_or_else(|| Meeting::at_rest(&smooth, pair), Ok)?;
            meeting.begin(&mut smooth);
            let curve_and_limits = meeting.curve(&smooth, pair, known.ends.unwrap_or(meeting.ends))?;
            fitted = Some((meeting, smooth));
            curve_and_limits
        }
        CurveChoice::Line => line_between(mesh, pair, sides)?,
        CurveChoice::Geometry => shared_geometry(mesh, pair, sides)?,
    };
    let wanted = known.ends.or(fitted.as_ref().map(|(meeting, _)| meeting.ends)).unwrap_or(limits);
    let goes_round = curve.period().is_some_and(|period| limits[1] - limits[0] > (1.0 - 1e-9) * period);
    let limits = if goes_round { [f64::NEG_INFINITY, f64::INFINITY] } else { limits };
    let range = [wanted[0].max(limits[0]), wanted[1].min(limits[1])];
    if range[1] - range[0] <= 1e-9 * (wanted[1] - wanted[0]) {
        return Err("the two boundaries face each other nowhere over a length".into());
    }
    let middle = curve.point(0.5 * (range[0] + range[1]));
    let mut edges = all_edges(mesh, numbering, pair, displacement);
    if let Some((meeting, _)) = &fitted {
        for (edges, shift) in edges.iter_mut().zip(meeting.shifts).filter(|(_, shift)| *shift != Point::zeros()) {
            *edges = std::mem::take(edges).into_iter().map(|edge| edge.moved(|_| shift)).collect();
        }
    }
    check_count(pair, &edges)?;
    let nearest = edges[0].iter().min_by(|a, b| {
        let away = |edge: &BoundaryEdge| (0.5 * (edge.points[0] + edge.points[1]) - middle).norm();
        away(a).total_cmp(&away(b))
    });
    let Some(nearest) = nearest else { return Err(format!("\"{}\" has no edges", pair.between[0])) };
    let boundary = ContactBoundary::new(curve, range, nearest.outward()).in_plane(mesh.plane);
    check_grading(pair, &boundary)?;
    if pair.curve.is_found() {
        [Side::First, Side::Second]
            .into_iter()
            .zip(&mut edges)
            .for_each(|(side, edges)| leave_what_looks_at(&boundary, side, edges));
    } else {
        check_cover(mesh, pair, sides, &boundary)?;
    }
    let (meeting, smooth) = fitted.unzip();
    let placed = Placed { boundary, limits, moved: Default::default(), meeting, edges, young };
    let mut placed = placed.cut(numbering.level.order, pair, known.segments);
    if let Some((meeting, smooth)) = placed.meeting.as_ref().zip(smooth).filter(|_| pair.curve == CurveChoice::Fit) {
        let sides = meeting.sides(&smooth);
        check_stray(sides, &placed.boundary, pair)?;
        if pair.configuration == Configuration::Deformed {
            placed.moved = sides.map(|side| placed.boundary.ends().map(|t| side.moved(placed.boundary.point(t))));
        }
    }
    Ok(placed)
}

/// Segments to an edge at most: shorter ones tell nothing, and their active set changes one by one.
const MOST_TO_AN_EDGE: usize = 32;

/// A number of segments that has nothing to do with the edges is a slip.
fn check_count(pair: &Pair, edges: &[Vec<BoundaryEdge>; 2]) -> Result<(), String> {
    let count = edges[0].len().max(edges[1].len());
    match pair.segments {
        SegmentRule::Count(segments) if segments > MOST_TO_AN_EDGE * count => Err(format!(
            "segments = {segments}: \"{}\" and \"{}\" have {count} edges at most, {MOST_TO_AN_EDGE} segments to an edge are none too few; give {} or fewer, or \"auto\"",
            pair.between[0],
            pair.between[1],
            MOST_TO_AN_EDGE * count
        )),
        _ => Ok(()),
    }
}

/// What goes all around has no ends towards which its segments could be graded, unless they follow the pressure.
fn check_grading(pair: &Pair, boundary: &ContactBoundary) -> Result<(), String> {
    if boundary.is_closed() && pair.grading != [1.0, 1.0] && !pair.has_free_ends() {
        let [a, b] = pair.grading;
        return Err(format!(
            "grading = [{a}, {b}]: \"{}\" and \"{}\" face each other all around, and the contact boundary has no ends; leave grading out, or give segments as a list",
            pair.between[0], pair.between[1]
        ));
    }
    Ok(())
}

/// A fitted boundary stays between the bodies.
fn check_stray(sides: [&SmoothSide; 2], boundary: &ContactBoundary, pair: &Pair) -> Result<(), String> {
    match stray(sides, boundary, pair) {
        Some(distance) => Err(format!(
            "the fitted contact boundary leaves the bodies: one of its points lies {distance:.1e} away from \"{}\" or \"{}\", more than their distance and an edge; refine the mesh, or give `curve` and `gap` by a [geometry]",
            pair.between[0], pair.between[1]
        )),
        None => Ok(()),
    }
}

/// Both boundaries must cover Γ_C without a hole.
fn check_cover(mesh: &MacroMesh, pair: &Pair, sides: [&[u32]; 2], boundary: &ContactBoundary) -> Result<(), String> {
    let [first, last] = boundary.ends();
    let least = 1e-6 * (last - first);
    for (side, edges) in sides.into_iter().enumerate() {
        let parts_of = |edge: &u32| {
            let ends = mesh.edge_ends(*edge);
            boundary.parts(ends).collect::<Vec<_>>()
        };
        let mut parts: Vec<[f64; 2]> = edges.iter().flat_map(parts_of).collect();
        parts.sort_by(|a, b| a[0].total_cmp(&b[0]));
        parts.push([last; 2]);
        let mut reached = first;
        for [from, to] in parts.iter().copied().filter(|[_, to]| *to > first) {
            if from.min(last) > reached + least {
                let [a, b] = [reached, from].map(|t| Coordinates(boundary.point(t)));
                return Err(format!(
                    "\"{}\" has a hole between {a} and {b}; give each part a name and a contact of its own",
                    pair.between[side]
                ));
            }
            reached = reached.max(to);
        }
    }
    Ok(())
}

/// A straight line between two straight boundaries, over the extent that both have. It runs to larger x, or upwards if
/// it is vertical: given segments stay where they are, whichever body is named first and however the mesh is numbered.
fn line_between(mesh: &MacroMesh, pair: &Pair, sides: [&[u32]; 2]) -> Result<(Curve, [f64; 2]), String> {
    let [first, second] = sides.map(|edges| ends(mesh, edges));
    let (origin, along) = (first.0, upwards((first.1 - first.0).normalize()));
    let mut extents = [[0.0; 2]; 2];
    let mut offsets = [0.0; 2];
    for (side, (a, b)) in [first, second].into_iter().enumerate() {
        if (((b - a).normalize()).dot(&along).abs() - 1.0).abs() > 1e-9 {
            return Err(format!(
                "curve = \"line\", but \"{}\" and \"{}\" are not parallel; give a [geometry] that lists both, and curve = \"geometry\"",
                pair.between[0], pair.between[1]
            ));
        }
        if !is_straight(mesh, sides[side], (a, b)) {
            return Err(format!(
                "curve = \"line\", but \"{}\" is not straight; give a [geometry] that lists both boundaries, and curve = \"geometry\"",
                pair.between[side]
            ));
        }
        let (s, t) = ((a - origin).dot(&along), (b - origin).dot(&along));
        extents[side] = [s.min(t), s.max(t)];
        offsets[side] = crate::geometry::cross(along, a - origin);
    }
    let (start, end) = (extents[0][0].max(extents[1][0]), extents[0][1].min(extents[1][1]));
    if end - start <= 1e-9 * (extents[0][1] - extents[0][0]) {
        return Err(format!(
            "\"{}\" and \"{}\" do not face each other: they have no extent in common",
            pair.between[0], pair.between[1]
        ));
    }
    // `cross(along, left) = 1`: the mean of both lines, where they lie apart.
    let lift = Point::new(-along.y, along.x) * (0.5 * (offsets[0] + offsets[1]));
    let at = |s: f64| {
        let x = origin + s * along + lift;
        [x.x, x.y]
    };
    Ok((Curve::Line([at(start), at(end)]), [0.0, 1.0]))
}

/// A direction or its opposite: the one to larger x, or upwards if it is vertical.
fn upwards(direction: Point) -> Point {
    let falls = direction.x < -1e-9 || (direction.x <= 1e-9 && direction.y < 0.0);
    if falls { -direction } else { direction }
}

/// Whether edges lie on the straight line between their ends.
fn is_straight(mesh: &MacroMesh, edges: &[u32], (a, b): (Point, Point)) -> bool {
    let along = (b - a).normalize();
    // Far from the origin coordinates lose digits; what that bends is straight.
    let allowed = 1e-9 * (b - a).norm() + 4.0 * f64::EPSILON * a.amax().max(b.amax());
    let lies_off = |vertex: u32| crate::geometry::cross(along, mesh.vertices[vertex as usize] - a).abs() > allowed;
    edges
        .iter()
        .map(|&edge| &mesh.edges[edge as usize])
        .all(|edge| edge.shape.is_none() && !edge.vertices.into_iter().any(lies_off))
}

/// The two vertices of a set of edges that are farthest apart, seen from the first vertex.
fn ends(mesh: &MacroMesh, edges: &[u32]) -> (Point, Point) {
    let points =
        || edges.iter().flat_map(|&edge| mesh.edges[edge as usize].vertices).map(|vertex| mesh.vertices[vertex as usize]);
    let farthest = |from: Point| points().max_by(|a, b| (a - from).norm().total_cmp(&(b - from).norm())).unwrap_or(from);
    let a = points().next().map(farthest).unwrap_or_default();
    (a, farthest(a))
}

/// The declared geometry of both boundaries, over the extent that both have: all of it, where both go all around.
fn shared_geometry(mesh: &MacroMesh, pair: &Pair, sides: [&[u32]; 2]) -> Result<(Curve, [f64; 2]), String> {
    let mut curve: Option<Curve> = None;
    let mut extents = [[0.0; 2]; 2];
    for (side, edges) in sides.into_iter().enumerate() {
        let mut ranges = Vec::new();
        for &edge in edges {
            let Some(shape) = mesh.edges[edge as usize].shape.as_ref().filter(|shape| !shape.is_spline()) else {
                return Err(format!("curve = \"geometry\", but no curved [geometry] lists \"{}\"", pair.between[side]));
            };
            let [a, b] = shape.range;
            ranges.push([a.min(b), a.max(b)]);
            curve.get_or_insert_with(|| (*shape.curve).clone());
        }
        extents[side] = extent(ranges, curve.as_ref().and_then(Curve::period));
    }
    let nowhere =
        || format!("\"{}\" and \"{}\" do not face each other: they have no extent in common", pair.between[0], pair.between[1]);
    let curve = curve.ok_or_else(nowhere)?;
    let mut common = common_extents(extents, &curve);
    common.sort_by(|a, b| (b[1] - b[0]).total_cmp(&(a[1] - a[0])));
    match common[..] {
        [] => Err(nowhere()),
        [range] => Ok((curve, range)),
        [range, other, ..] => {
            let [a, b] = [range, other].map(|range| curve.point(0.5 * (range[0] + range[1])));
            Err(format!(
                "\"{}\" and \"{}\" face each other on two stretches, near ({:.6}, {:.6}) and near ({:.6}, {:.6}); give the parts of one of them names of their own, and each a contact",
                pair.between[0], pair.between[1], a.x, a.y, b.x, b.y
            ))
        }
    }
}

/// From the first to the last parameter of pieces of a curve; on a closed one what is left of a turn without the widest gap
/// between them, or, without a gap, a turn from the beginning of the curve.
fn extent(mut ranges: Vec<[f64; 2]>, period: Option<f64>) -> [f64; 2] {
    let whole = |ranges: &[[f64; 2]]| {
        ranges.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], [a, b]| [low.min(*a), high.max(*b)])
    };
    let Some(period) = period else { return whole(&ranges) };
    for range in &mut ranges {
        let turns = (range[0] / period + 1e-9).floor() * period;
        *range = range.map(|t| t - turns);
    }
    ranges.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let (mut widest, mut reached) = ([0.0; 2], f64::NEG_INFINITY);
    let again = ranges.first().map(|range| range.map(|t| t + period));
    for [from, to] in ranges.iter().copied().chain(again) {
        if from - reached > widest[1] - widest[0] && reached.is_finite() {
            widest = [reached, from];
        }
        reached = reached.max(to);
    }
    if widest[1] - widest[0] <= 1e-9 * period { [0.0, period] } else { [widest[1] - period, widest[0]] }
}

/// What two extents on a curve have in common; on a closed one that may be two stretches.
fn common_extents([first, second]: [[f64; 2]; 2], curve: &Curve) -> Vec<[f64; 2]> {
    let Some(period) = curve.period() else {
        let both = [first[0].max(second[0]), first[1].min(second[1])];
        return if both[1] > both[0] { vec![both] } else { Vec::new() };
    };
    let whole = |range: [f64; 2]| range[1] - range[0] > (1.0 - 1e-9) * period;
    if whole(first) || whole(second) {
        let start = curve.range()[0];
        return vec![match (whole(first), whole(second)) {
            (true, true) => [start, start + period],
            (true, false) => second,
            _ => first,
        }];
    }
    let turned = [-1.0, 0.0, 1.0].map(|turns| second.map(|t| t + turns * period));
    let both = turned.into_iter().map(|[a, b]| [first[0].max(a), first[1].min(b)]);
    both.filter(|both| both[1] - both[0] > 1e-9 * period).collect()
}

/// All element edges of a pair's two boundaries, at the level that is numbered, where contact is modelled.
pub fn all_edges(mesh: &MacroMesh, numbering: &Numbering, pair: &Pair, displacement: Displacement) -> [Vec<BoundaryEdge>; 2] {
    [0, 1].map(|k| {
        let edges = mesh.edges_of(&pair.between[k]);
        let all = edges.iter().flat_map(|&edge| BoundaryEdge::all_of(mesh, edge, numbering));
        match pair.configuration {
            Configuration::Reference => all.collect(),
            Configuration::Deformed => all.map(|edge| edge.moved(displacement)).collect(),
        }
    })
}

#[cfg(test)]
mod tests;
