//! Γ_C of a pair, placed between two boundaries of the mesh and cut by the pair's rule.

use super::bisector::stray;
use super::cutting::fractions;
use super::{Configuration, ContactBoundary, CurveChoice, Displacement, Meeting, Pair, SegmentRule, Side, SmoothSide};
use crate::geometry::{Curve, Point};
use crate::mesh::{BoundaryEdge, MacroMesh, Numbering};

/// Why no contact boundary can be placed: the key of the case, and words.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("contact.{pair}: {words}")]
pub struct PlacingError {
    /// Name of the pair.
    pub pair: String,
    /// What is wrong and what to do.
    pub words: String,
}

/// What is known of a contact boundary from the last time it was placed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Known {
    /// Where the two sides meet, for a fitted one.
    pub meeting: Option<Meeting>,
    /// Parameters of its ends.
    pub ends: Option<[f64; 2]>,
    /// Number of its segments.
    pub segments: Option<usize>,
}

/// A contact boundary with what it was placed by.
pub struct Placed {
    /// Γ_C, cut.
    pub boundary: ContactBoundary,
    /// Parameters beyond which one of the bodies has no boundary.
    pub limits: [f64; 2],
    /// What a fitted one was fitted to.
    pub meeting: Option<Meeting>,
}

/// Places Γ_C of a pair and cuts it into segments. `young` are the moduli of body 1 and body 2 (stress); `numbering`
/// is that of the finest level, whose edge lengths the automatic rule follows; a curve that follows the bodies is fitted
/// to their nodes moved by `displacement`. The same on every rank.
///
/// # Errors
/// [`PlacingError`] if the boundaries are not straight or do not share a geometry, as the pair claims, or do not overlap.
pub fn place(
    mesh: &MacroMesh,
    numbering: &Numbering,
    pair: &Pair,
    young: [f64; 2],
    known: &Known,
    displacement: Displacement,
) -> Result<Placed, PlacingError> {
    let error = |words: String| PlacingError { pair: pair.name.clone(), words };
    let sides = [0, 1].map(|k| mesh.boundary(&pair.between[k]).map(|b| b.edges.as_slice()).unwrap_or(&[]));
    let mut fitted = None;
    let (curve, limits) = match pair.curve {
        CurveChoice::Fit => {
            check_open(mesh, pair, sides).map_err(error)?;
            let smooth = SmoothSide::of_pair(mesh, numbering, pair, displacement);
            let mut meeting = known.meeting.clone().map_or_else(|| Meeting::at_rest(&smooth, pair), Ok).map_err(error)?;
            let found = meeting.fit(&smooth, pair, known.ends.unwrap_or(meeting.ends)).map_err(error)?;
            fitted = Some((meeting, smooth));
            (found.curve, found.limits)
        }
        CurveChoice::Line => line_between(mesh, pair, sides).map_err(error)?,
        CurveChoice::Geometry => shared_geometry(mesh, pair, sides).map_err(error)?,
    };
    let wanted = known.ends.or(fitted.as_ref().map(|(meeting, _)| meeting.ends)).unwrap_or(limits);
    let range = [wanted[0].max(limits[0]), wanted[1].min(limits[1])];
    if range[1] - range[0] <= 1e-9 * (wanted[1] - wanted[0]) {
        return Err(error("the two boundaries face each other nowhere over a length".into()));
    }
    let middle = curve.point(0.5 * (range[0] + range[1]));
    let edges = all_edges(mesh, numbering, pair, displacement);
    let nearest = edges[0].iter().min_by(|a, b| {
        let away = |edge: &BoundaryEdge| (0.5 * (edge.points[0] + edge.points[1]) - middle).norm();
        away(a).total_cmp(&away(b))
    });
    let Some(nearest) = nearest else { return Err(error(format!("\"{}\" has no edges", pair.between[0]))) };
    let mut boundary = ContactBoundary::new(curve, range, nearest.outward());
    if pair.curve != CurveChoice::Fit {
        check_cover(mesh, pair, sides, &boundary).map_err(error)?;
    }
    check_count(pair, &edges).map_err(error)?;
    boundary.cut(&fractions(&edges, numbering.level.order, pair, young, &boundary, known.segments));
    if let Some((meeting, smooth)) = &fitted {
        check_stray(meeting.sides(smooth), &boundary, pair).map_err(error)?;
    }
    Ok(Placed { boundary, limits, meeting: fitted.map(|(meeting, _)| meeting) })
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

/// A fitted boundary has two ends, and so have the boundaries that it lies between.
fn check_open(mesh: &MacroMesh, pair: &Pair, sides: [&[u32]; 2]) -> Result<(), String> {
    let closed = |edges: &[u32]| mesh.stretches(edges).iter().any(|stretch| mesh.is_closed(&stretch.edges));
    match (0..2).find(|&k| closed(sides[k])) {
        Some(k) => Err(closed_curve(&pair.between[k])),
        None => Ok(()),
    }
}

fn closed_curve(name: &str) -> String {
    format!("\"{name}\" is a closed curve; closed contact boundaries are not available yet: name an arc of it that is open")
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

/// Both boundaries must cover Γ_C without a hole, and must not close around it.
fn check_cover(mesh: &MacroMesh, pair: &Pair, sides: [&[u32]; 2], boundary: &ContactBoundary) -> Result<(), String> {
    let (first, last) = (boundary.knots()[0], boundary.knots()[1]);
    let least = 1e-6 * (last - first);
    for (side, edges) in sides.into_iter().enumerate() {
        let part = |edge: &u32| boundary.feet(mesh.edges[*edge as usize].vertices.map(|vertex| mesh.vertices[vertex as usize]));
        let mut parts: Vec<[f64; 2]> = edges.iter().map(part).collect();
        let whole: f64 = parts.iter().map(|[a, b]| b - a).sum();
        if boundary.period().is_some_and(|period| whole > (1.0 - 1e-6) * period) {
            return Err(closed_curve(&pair.between[side]));
        }
        parts.sort_by(|a, b| a[0].total_cmp(&b[0]));
        parts.push([last; 2]);
        let mut reached = first;
        for [from, to] in parts.iter().copied().filter(|[_, to]| *to > first) {
            if from.min(last) > reached + least {
                let [a, b] = [reached, from].map(|t| boundary.point(t));
                return Err(format!(
                    "\"{}\" has a hole between ({}, {}) and ({}, {}); give each part a name and a contact of its own",
                    pair.between[side], a.x, a.y, b.x, b.y
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
    let mut extents = [[0.0; 2]; 2];
    let mut offsets = [0.0; 2];
    let (mut origin, mut along) = (Point::zeros(), Point::zeros());
    for (side, edges) in sides.into_iter().enumerate() {
        let (a, b) = ends(mesh, edges);
        if side == 0 {
            let towards = (b - a).normalize();
            let falls = towards.x < -1e-9 || (towards.x <= 1e-9 && towards.y < 0.0);
            (origin, along) = (a, if falls { -towards } else { towards });
        }
        let own = (b - a).normalize();
        if (own.dot(&along).abs() - 1.0).abs() > 1e-9 {
            return Err(format!(
                "curve = \"line\", but \"{}\" and \"{}\" are not parallel; give a [geometry] that lists both, and curve = \"geometry\"",
                pair.between[0], pair.between[1]
            ));
        }
        // Far from the origin coordinates lose digits; what that bends is straight.
        let allowed = 1e-9 * (b - a).norm() + 4.0 * f64::EPSILON * a.amax().max(b.amax());
        for &edge in edges {
            let bent = mesh.edges[edge as usize].shape.is_some();
            let off = mesh.edges[edge as usize]
                .vertices
                .iter()
                .any(|&vertex| crate::geometry::cross(own, mesh.vertices[vertex as usize] - a).abs() > allowed);
            if bent || off {
                return Err(format!(
                    "curve = \"line\", but \"{}\" is not straight; give a [geometry] that lists both boundaries, and curve = \"geometry\"",
                    pair.between[side]
                ));
            }
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

/// The two vertices of a set of edges that are farthest apart, seen from the first vertex.
fn ends(mesh: &MacroMesh, edges: &[u32]) -> (Point, Point) {
    let points =
        || edges.iter().flat_map(|&edge| mesh.edges[edge as usize].vertices).map(|vertex| mesh.vertices[vertex as usize]);
    let farthest = |from: Point| points().max_by(|a, b| (a - from).norm().total_cmp(&(b - from).norm())).unwrap_or(from);
    let a = points().next().map(farthest).unwrap_or_default();
    (a, farthest(a))
}

/// The declared geometry of both boundaries, over the extent that both have.
fn shared_geometry(mesh: &MacroMesh, pair: &Pair, sides: [&[u32]; 2]) -> Result<(Curve, [f64; 2]), String> {
    let mut common: Option<(Curve, [f64; 2])> = None;
    for (side, edges) in sides.into_iter().enumerate() {
        let mut extent: Option<[f64; 2]> = None;
        for &edge in edges {
            let Some(shape) = mesh.edges[edge as usize].shape.as_ref().filter(|shape| !shape.is_spline()) else {
                return Err(format!("curve = \"geometry\", but no curved [geometry] lists \"{}\"", pair.between[side]));
            };
            let middle_of = |[a, b]: [f64; 2]| 0.5 * (a + b);
            let reference = extent.or(common.as_ref().map(|(_, range)| *range)).map(middle_of).filter(|t| t.is_finite());
            let middle = 0.5 * (shape.range[0] + shape.range[1]);
            let turn = match (shape.curve.period(), reference) {
                (Some(period), Some(reference)) => ((reference - middle) / period).round() * period,
                _ => 0.0,
            };
            let [a, b] = shape.range.map(|t| t + turn);
            let [low, high] = extent.unwrap_or([f64::INFINITY, f64::NEG_INFINITY]);
            extent = Some([low.min(a).min(b), high.max(a).max(b)]);
            common.get_or_insert_with(|| ((*shape.curve).clone(), [f64::NEG_INFINITY, f64::INFINITY]));
        }
        if let (Some((_, range)), Some([low, high])) = (&mut common, extent) {
            *range = [range[0].max(low), range[1].min(high)];
        }
    }
    match common {
        Some((curve, range)) if range[1] > range[0] => Ok((curve, range)),
        _ => Err(format!(
            "\"{}\" and \"{}\" do not face each other: they have no extent in common",
            pair.between[0], pair.between[1]
        )),
    }
}

/// All element edges of a pair's two boundaries, at the level that is numbered, where contact is modelled.
pub fn all_edges(mesh: &MacroMesh, numbering: &Numbering, pair: &Pair, displacement: Displacement) -> [Vec<BoundaryEdge>; 2] {
    [0, 1].map(|k| {
        let edges = mesh.boundary(&pair.between[k]).map(|b| b.edges.as_slice()).unwrap_or(&[]);
        let all = edges.iter().flat_map(|&edge| BoundaryEdge::all_of(mesh, edge, numbering));
        match pair.configuration {
            Configuration::Reference => all.collect(),
            Configuration::Deformed => all.map(|edge| edge.moved(displacement)).collect(),
        }
    })
}

/// Whether an edge looks at Γ_C: what lies behind a body does not touch.
pub fn faces(boundary: &ContactBoundary, side: Side, edge: &BoundaryEdge) -> bool {
    let middle = 0.5 * (edge.points[0] + edge.points[1]);
    edge.outward().dot(&boundary.normal(boundary.foot(middle))) * side.sign() > 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::{EndRule, GapChoice, Law, MultiplierSpace, Quadrature, Stabilise};
    use crate::element::Order;
    use crate::mesh::samples::two_blocks;
    use crate::mesh::{Level, Partition};
    use std::rc::Rc;

    fn pair(segments: SegmentRule) -> Pair {
        Pair {
            name: "seam".into(),
            between: ["lower.seam".into(), "upper.seam".into()],
            curve: CurveChoice::Line,
            gap: GapChoice::Closed,
            space: MultiplierSpace::P0,
            segments,
            law: Law::Unilateral,
            quadrature: Quadrature::Cut,
            stabilise: Stabilise::Off,
            configuration: Configuration::Reference,
            spans: None,
            grading: [1.0, 1.0],
            ends: EndRule::Fixed,
        }
    }

    fn cover(mesh: &MacroMesh, curve: Curve) -> Result<(), String> {
        let sides = ["lower.seam", "upper.seam"].map(|name| mesh.boundary(name).expect("named").edges.as_slice());
        let range = curve.range();
        check_cover(mesh, &pair(SegmentRule::Auto), sides, &ContactBoundary::new(curve, range, Point::new(0.0, 1.0)))
    }

    #[test]
    fn holes_at_any_place_are_refused() {
        let mut mesh = two_blocks();
        assert_eq!(cover(&mesh, Curve::Line([[0.0, 1.0], [2.0, 1.0]])), Ok(()));
        for line in [[[-1.0, 1.0], [2.0, 1.0]], [[0.0, 1.0], [3.0, 1.0]]] {
            assert!(cover(&mesh, Curve::Line(line)).unwrap_err().contains("has a hole between"));
        }
        mesh.boundaries.iter_mut().filter(|b| b.name == "upper.seam").for_each(|b| b.edges.truncate(1));
        assert!(cover(&mesh, Curve::Line([[0.0, 1.0], [2.0, 1.0]])).unwrap_err().contains("\"upper.seam\" has a hole"));
    }

    fn at_rest(
        mesh: &MacroMesh,
        numbering: &Numbering,
        rule: SegmentRule,
        young: [f64; 2],
    ) -> Result<ContactBoundary, PlacingError> {
        place(mesh, numbering, &pair(rule), young, &Known::default(), &|_| Point::zeros()).map(|placed| placed.boundary)
    }

    #[test]
    fn automatic_segments_follow_the_edges() {
        let mesh = two_blocks();
        let partition = Rc::new(Partition::new(&mesh, &vec![0; mesh.triangles.len()], 1));
        let numbering = Numbering::new(Level { intervals: 8, order: Order::P1 }, &partition);
        let boundary = at_rest(&mesh, &numbering, SegmentRule::Auto, [1.0, 1.0]).expect("a flat seam");
        // Longest edge 2/8, 1.5 of them on a length of 2.
        assert_eq!(boundary.segments(), 5);
        // A stiff lower body leaves the rule to the upper one: 8 edges of .9/8, 8 of 1.1/8, 1.5 of them and more to a segment.
        let boundary = at_rest(&mesh, &numbering, SegmentRule::Auto, [10.0, 1.0]).expect("a flat seam");
        assert_eq!(boundary.segments(), 10);
        let lengths = [0, 9].map(|k| boundary.segment_length(k));
        assert!((lengths[0] - 1.6 * 0.9 / 8.0).abs() < 1e-12 && (lengths[1] - 1.6 * 1.1 / 8.0).abs() < 1e-12);
        assert!(boundary.normal(0.5).y > 0.0);
    }

    #[test]
    fn rounding_bends_no_line_and_a_bend_is_one_anywhere() {
        for far in [0.0, 1e8] {
            for (bend, straight) in [(0.0, true), (1e-3, false)] {
                let mut mesh = two_blocks();
                mesh.boundaries.iter_mut().for_each(|boundary| boundary.edges.sort());
                for x in &mut mesh.vertices {
                    let bent = if x.y == 1.0 { bend * x.x * (2.0 - x.x) } else { 0.0 };
                    // Turned, so that the coordinates of the line are rounded.
                    *x = Point::new(far + 0.8 * x.x - 0.6 * (x.y + bent), 3.0 * far + 0.6 * x.x + 0.8 * (x.y + bent));
                }
                let sides = ["lower.seam", "upper.seam"].map(|name| mesh.boundary(name).expect("named").edges.as_slice());
                let line = line_between(&mesh, &pair(SegmentRule::Auto), sides);
                assert_eq!(line.is_ok(), straight, "at {far}, bent by {bend}: {line:?}");
            }
        }
    }

    #[test]
    fn a_number_of_segments_without_measure_is_refused() {
        let mesh = two_blocks();
        let partition = Rc::new(Partition::new(&mesh, &vec![0; mesh.triangles.len()], 1));
        let numbering = Numbering::new(Level { intervals: 2, order: Order::P1 }, &partition);
        let words = at_rest(&mesh, &numbering, SegmentRule::Count(100_000), [1.0, 1.0]).unwrap_err().to_string();
        assert!(words.contains("segments = 100000") && words.contains("give 128 or fewer, or \"auto\""), "{words}");
        assert!(at_rest(&mesh, &numbering, SegmentRule::Count(128), [1.0, 1.0]).is_ok());
    }

    #[test]
    fn boundaries_that_do_not_face_each_other_are_refused() {
        let mut mesh = two_blocks();
        let upper: Vec<u32> = mesh.triangles.iter().filter(|t| t.body == 1).flat_map(|t| t.vertices).collect();
        let moved: std::collections::BTreeSet<u32> = upper.into_iter().collect();
        moved.into_iter().for_each(|vertex| mesh.vertices[vertex as usize].x += 5.0);
        let partition = Rc::new(Partition::new(&mesh, &vec![0; mesh.triangles.len()], 1));
        let numbering = Numbering::new(Level { intervals: 2, order: Order::P1 }, &partition);
        let words = at_rest(&mesh, &numbering, SegmentRule::Count(3), [1.0, 1.0]).unwrap_err().to_string();
        assert!(words.starts_with("contact.seam: ") && words.contains("do not face each other"), "{words}");
    }

    /// What is known of an earlier place of Γ_C stays: its ends, no farther than both bodies reach, and its number of segments.
    #[test]
    fn known_ends_and_segments_stay_within_the_bodies() {
        let mesh = two_blocks();
        let partition = Rc::new(Partition::new(&mesh, &vec![0; mesh.triangles.len()], 1));
        let numbering = Numbering::new(Level { intervals: 8, order: Order::P1 }, &partition);
        let pair = pair(SegmentRule::Auto);
        for (ends, found) in [([0.25, 0.75], [0.25, 0.75]), ([-0.5, 0.4], [0.0, 0.4]), ([0.6, 1.5], [0.6, 1.0])] {
            let known = Known { ends: Some(ends), segments: Some(4), ..Known::default() };
            let placed = place(&mesh, &numbering, &pair, [1.0; 2], &known, &|_| Point::zeros()).expect("a flat seam");
            assert_eq!((placed.limits, placed.boundary.segments()), ([0.0, 1.0], 4));
            let knots = placed.boundary.knots();
            assert!((knots[0] - found[0]).abs() < 1e-12 && (knots[4] - found[1]).abs() < 1e-12, "{knots:?}");
            assert!((placed.boundary.length() - 2.0 * (found[1] - found[0])).abs() < 1e-12);
        }
        for ends in [[1.2, 1.5], [0.5, 0.5 + 1e-300]] {
            let known = Known { ends: Some(ends), ..Known::default() };
            let placed = place(&mesh, &numbering, &pair, [1.0; 2], &known, &|_| Point::zeros());
            assert!(placed.err().expect("nothing there").words.contains("face each other nowhere over a length"));
        }
    }

    /// The upper block lies to the right of the lower one and above it; both are turned together.
    #[test]
    fn a_line_lies_half_way_and_runs_to_larger_x_however_it_is_turned() {
        for angle in [0.0f64, 30.0, 90.0, 135.0, 200.0, 270.0, 300.0] {
            let turn = nalgebra::Rotation2::new(angle.to_radians());
            for shift in [0.3, -0.3] {
                let mut mesh = two_blocks();
                let upper = mesh.bodies.iter().position(|name| name == "upper").expect("a body");
                let own = |t: &&crate::mesh::MacroTriangle| t.body as usize == upper;
                let own: std::collections::BTreeSet<u32> = mesh.triangles.iter().filter(own).flat_map(|t| t.vertices).collect();
                for (vertex, x) in mesh.vertices.iter_mut().enumerate() {
                    let moved = if own.contains(&(vertex as u32)) { Point::new(shift, 0.2) } else { Point::zeros() };
                    *x = turn * (*x + moved);
                }
                let mut wanted = [Point::new(0f64.max(shift), 1.1), Point::new(2f64.min(2.0 + shift), 1.1)].map(|x| turn * x);
                let along = wanted[1] - wanted[0];
                if along.x < -1e-9 || (along.x < 1e-9 && along.y < 0.0) {
                    wanted.reverse();
                }
                for between in [["lower.seam", "upper.seam"], ["upper.seam", "lower.seam"]] {
                    let sides = between.map(|name| mesh.boundary(name).expect("named").edges.as_slice());
                    let (curve, limits) = line_between(&mesh, &pair(SegmentRule::Auto), sides).expect("two lines");
                    assert_eq!(limits, [0.0, 1.0]);
                    let off = [0, 1].map(|k| (curve.point(limits[k]) - wanted[k]).norm());
                    assert!(off.iter().all(|off| *off < 1e-12), "{angle}, {shift}: {curve:?} instead of {wanted:?}");
                }
            }
        }
    }

    /// A circle of radius 10 through the seam, of which the upper block has 0.4 to 1.6 only, turned so that its parameter begins
    /// anew anywhere on it.
    #[test]
    fn a_shared_circle_reaches_as_far_as_both_bodies_wherever_its_parameter_begins() {
        let height = 99f64.sqrt();
        for angle in [0.0f64, -90.0, -84.5, -86.5, -92.0, -95.5, 100.0] {
            let turn = nalgebra::Rotation2::new(angle.to_radians());
            let mut mesh = two_blocks();
            let upper = mesh.bodies.iter().position(|name| name == "upper").expect("a body");
            let own = |t: &&crate::mesh::MacroTriangle| t.body as usize == upper;
            let own: std::collections::BTreeSet<u32> = mesh.triangles.iter().filter(own).flat_map(|t| t.vertices).collect();
            for (vertex, x) in mesh.vertices.iter_mut().enumerate() {
                let is_upper = own.contains(&(vertex as u32));
                *x = turn * if is_upper { Point::new(0.4 + 0.6 * x.x, x.y) } else { *x };
            }
            let centre = turn * Point::new(1.0, 1.0 - height);
            let circle = Curve::Circle { centre: [centre.x, centre.y], radius: 10.0 };
            mesh.bend("arc", &["lower.seam".into(), "upper.seam".into()], &circle).expect("near the circle");
            for between in [["lower.seam", "upper.seam"], ["upper.seam", "lower.seam"]] {
                let sides = between.map(|name| mesh.boundary(name).expect("named").edges.as_slice());
                let (curve, [from, to]) = shared_geometry(&mesh, &pair(SegmentRule::Auto), sides).expect("a circle");
                let half = (0.6 / (0.36 + height * height).sqrt()).asin();
                assert!((to - from - 2.0 * half).abs() < 1e-9, "{angle}: {} instead of {}", to - from, 2.0 * half);
                let top = centre + turn * Point::new(0.0, 10.0);
                assert!((curve.point(0.5 * (from + to)) - top).norm() < 1e-9, "{angle}");
            }
        }
    }

    #[test]
    fn bodies_on_other_parts_of_a_circle_do_not_face_each_other() {
        let mut mesh = two_blocks();
        let circle = Curve::Circle { centre: [1.0, 1.0 - 99f64.sqrt()], radius: 10.0 };
        mesh.bend("arc", &["lower.seam".into(), "upper.seam".into()], &circle).expect("near the circle");
        let upper = mesh.boundary("upper.seam").expect("named").edges.clone();
        let (first, second) = (&upper[..1], &upper[1..]);
        let words = shared_geometry(&mesh, &pair(SegmentRule::Auto), [first, second]).expect_err("side by side");
        assert!(words.contains("no extent in common"), "{words}");
    }

    #[test]
    fn edges_that_look_away_from_the_boundary_do_not_face_it() {
        let mesh = two_blocks();
        let partition = Rc::new(Partition::new(&mesh, &vec![0; mesh.triangles.len()], 1));
        let numbering = Numbering::new(Level { intervals: 2, order: Order::P1 }, &partition);
        let line = Curve::Line([[0.0, 1.0], [2.0, 1.0]]);
        let boundary = ContactBoundary::new(line, [0.0, 1.0], Point::new(0.0, 1.0));
        for (name, first, second) in
            [("lower.seam", true, false), ("top", true, false), ("upper.seam", false, true), ("bottom", false, true)]
        {
            let edges = &mesh.boundary(name).expect("named").edges;
            for edge in edges.iter().flat_map(|&edge| BoundaryEdge::all_of(&mesh, edge, &numbering)) {
                let found = [Side::First, Side::Second].map(|side| faces(&boundary, side, &edge));
                assert_eq!(found, [first, second], "{name}");
            }
        }
    }

    /// The outline of the lower block around a circle in its middle, whole and with an edge left out.
    #[test]
    fn boundaries_that_close_around_a_circle_are_refused() {
        let mesh = two_blocks();
        let lower = mesh.bodies.iter().position(|name| name == "lower").expect("a body");
        let outline = |edge: &u32| mesh.edges[*edge as usize].triangles[1].is_none() && mesh.body_beside(*edge) == lower;
        let outline: Vec<u32> = (0..mesh.edges.len() as u32).filter(outline).collect();
        assert_eq!(outline.len(), 4);
        let circle = Curve::Circle { centre: [1.0, 0.5], radius: 0.4 };
        let boundary = ContactBoundary::new(circle, [-0.1, 0.1], Point::new(1.0, 0.0));
        let cover = |edges: &[u32]| check_cover(&mesh, &pair(SegmentRule::Auto), [edges, edges], &boundary);
        assert!(cover(&outline).expect_err("closed").contains("\"lower.seam\" is a closed curve"));
        let right =
            |edge: &u32| mesh.edges[*edge as usize].vertices.iter().all(|&vertex| mesh.vertices[vertex as usize].x == 2.0);
        let kept: Vec<u32> = outline.iter().copied().filter(right).collect();
        assert_eq!((kept.len(), cover(&kept)), (1, Ok(())), "the one before it covers the part");
    }
}
