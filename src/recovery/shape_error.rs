//! What splines through the nodes of undeclared boundaries leave unknown of their shape, and what that does to λ.
//!
//! A spline through every node is compared with that through every other one, and that with the one through every fourth. Where a boundary
//! is smooth, the slopes of the first two differ by much less than those of the last two, and the difference tells the error
//! of the first. Where its nodes scatter, or where its curvature jumps, it does not fall. A gap that is uneven by waves with slopes
//! e' takes pressures of E* e'/2 on a half-plane (Johnson, Contact mechanics, 1985, 13.2). Root mean squares by that, and measured on
//! whole rings of 30/36, 24/32, 20/28 and 40/48 chords that overlap by 5e-4 of the radius: .031 and .033, .059 and .058, .10 and .10,
//! .013 and .014.

use super::traces::TracePoint;
use crate::discretisation::Contact;
use crate::geometry::{Curve, Point, Spline, turn_right};

/// The slopes of a spline through nodes of a smooth boundary are exact to the third power of their distance.
const ORDER: f64 = 8.0;

/// Where a short piece that presses is looked at, by the distance of nodes: from the node before to the one behind. On teeth of gears
/// half as far told .012 instead of .031.
const SHIFTS: [f64; 5] = [-1.0, -0.5, 0.0, 0.5, 1.0];

/// Width of a contact boundary at an end by that at its middle, on the axis of revolution.
const ON_AXIS: f64 = 1e-9;

/// Approach of two round bodies by force and compliance, at a half width of a fiftieth of the radius: (2 ln(4R/b) - 1)/π of Hertz's.
const APPROACH: f64 = 3.0;

/// A side that is a spline through nodes, with splines through every other one of them, the even and the odd ones, and through every
/// other one of these.
struct NodedSide<'c> {
    all: &'c Curve,
    /// Parameters of its nodes: lengths of chords.
    nodes: &'c [f64],
    halves: [[Curve; 2]; 2],
}

/// Angles (radians), or distances along the normal (length), from a spline to that through half of its nodes, and from that to the one
/// through a quarter, at places that press; none on a side whose shape is known.
type SplineErrors = Vec<[f64; 2]>;

/// What is compared of two curves beside a point.
type Comparison = fn(&Curve, &Curve, Point) -> f64;

/// Estimated relative error of λ, root mean square over what presses, by the shapes of sides that nobody has declared; nothing if gaps are
/// not measured between shapes, or if nothing presses. Where a load sets the force, the force is not off by that.
pub fn shape_error(contact: &Contact, points: &[TracePoint]) -> Option<f64> {
    let sides = noded_sides(contact)?;
    let pressing = pressing_places(points);
    let length: f64 = pressing.iter().map(|(_, length)| length).sum();
    let force: f64 = pressing.iter().map(|(point, length)| point.lambda * length).sum();
    // With both ends free a tilt moves what presses, and no more; at an axis, or at a line of symmetry, it is a ridge or a groove.
    let (boundary, middle) = (&contact.boundary, contact.boundary.parameter_at(0.5 * contact.boundary.length()));
    let is_on_axis = |end: f64| boundary.width(end) < ON_AXIS * boundary.width(middle);
    let is_free = contact.ends_with_a_body() == [false; 2] && !boundary.ends().into_iter().any(is_on_axis);
    let slope = spline_error_about(&sides, &pressing, is_free, angle);
    (force > 0.0 && contact.compliance > 0.0).then(|| 0.5 * slope * length / (contact.compliance * force))
}

/// Force that a contact on which nothing presses may carry all the same, since the nodes of undeclared boundaries leave unknown more of
/// its shape than its gap is wide (force per thickness).
pub fn force_by_shape(contact: &Contact, points: &[TracePoint]) -> f64 {
    let complete = points.iter().filter(|point| point.is_complete());
    let closest = complete.min_by(|a, b| a.gap.total_cmp(&b.gap)).filter(|_| contact.compliance > 0.0);
    let Some((closest, sides)) = closest.zip(noded_sides(contact)) else { return 0.0 };
    let unknown = spline_error_about(&sides, &[(closest, 1.0)], false, offset);
    (unknown - closest.gap.max(0.0)).max(0.0) / (APPROACH * contact.compliance)
}

/// The sides whose shape nobody has declared; nothing if gaps are not measured between shapes.
fn noded_sides(contact: &Contact) -> Option<[Vec<NodedSide<'_>>; 2]> {
    Some(contact.shapes.as_ref()?.each_ref().map(|curves| curves.iter().filter_map(NodedSide::of).collect()))
}

/// The places that press, each with the length that it stands for.
fn pressing_places(points: &[TracePoint]) -> Vec<(&TracePoint, f64)> {
    let arc = |k: usize| points[k].arc;
    let last = points.len().saturating_sub(1);
    let own = |k: usize| 0.5 * (arc((k + 1).min(last)) - arc(k.saturating_sub(1)));
    (0..points.len()).filter(|&k| points[k].lambda > 0.0).map(|k| (&points[k], own(k))).collect()
}

/// Error of the slopes, or of the width, of the gap where it presses, or, where that is less than a node to either side, of as long a
/// piece anywhere within a node: between nodes splines may agree at a point by chance. Root mean square.
fn spline_error_about(
    sides: &[Vec<NodedSide>; 2],
    pressing: &[(&TracePoint, f64)],
    without_mean: bool,
    compare: Comparison,
) -> f64 {
    let Some((middle, _)) = pressing.get(pressing.len() / 2) else { return 0.0 };
    let half = 0.5 * (pressing[pressing.len() - 1].0.arc - pressing[0].0.arc);
    let node = sides.iter().filter_map(|side| nearest(side, middle.x)?.node_distance(middle.x)).fold(0.0, f64::max);
    let squared = |share: f64| {
        let shift = share * (node - half).max(0.0);
        spline_error(sides.each_ref().map(|side| spline_errors(side, pressing, shift, compare)), pressing, without_mean).powi(2)
    };
    (SHIFTS.map(squared).iter().sum::<f64>() / SHIFTS.len() as f64).sqrt()
}

/// Of the even nodes of a side, and of the odd ones, at what presses, moved along itself.
fn spline_errors(sides: &[NodedSide], pressing: &[(&TracePoint, f64)], shift: f64, compare: Comparison) -> [SplineErrors; 2] {
    let mut errors = [Vec::new(), Vec::new()];
    for (point, _) in pressing {
        let x = point.x - shift * turn_right(point.normal);
        let Some(side) = nearest(sides, x) else { continue };
        for (errors, [half, quarter]) in errors.iter_mut().zip(&side.halves) {
            errors.push([compare(side.all, half, x), compare(half, quarter, x)]);
        }
    }
    errors
}

/// The curve of a side that a point is nearest to.
fn nearest<'s, 'c>(sides: &'s [NodedSide<'c>], x: Point) -> Option<&'s NodedSide<'c>> {
    let away = |side: &&NodedSide| (side.all.point(side.all.nearest(x)) - x).norm_squared();
    sides.iter().min_by(|a, b| away(a).total_cmp(&away(b)))
}

/// Error of the slopes of the gap (radians), or of its width (length), root mean square: what both sides miss alike, as where they share
/// their nodes, is no part of it. Of even and odd nodes the worse counts, paired across the contact as they agree best.
fn spline_error([first, second]: [[SplineErrors; 2]; 2], pressing: &[(&TracePoint, f64)], without_mean: bool) -> f64 {
    let between = |a: &SplineErrors, b: &SplineErrors| {
        let difference = |level: usize| {
            let at = |errors: &SplineErrors, k: usize| errors.get(k).map_or(0.0, |errors| errors[level]);
            deviation(pressing.iter().enumerate().map(|(k, (_, length))| (at(a, k) - at(b, k), *length)), without_mean)
        };
        let (half, quarter) = (difference(0), difference(1));
        // A share that stays on each coarser spline makes a series; what does not fall is all error.
        let share = (half / quarter).max(1.0 / ORDER);
        if share < 0.5 { half * share / (1.0 - share) } else { half }
    };
    let paired = |other: [usize; 2]| between(&first[0], &second[other[0]]).max(between(&first[1], &second[other[1]]));
    paired([0, 1]).min(paired([1, 0]))
}

impl<'c> NodedSide<'c> {
    fn of(curve: &'c Curve) -> Option<Self> {
        let Curve::Spline(spline) = curve else { return None };
        let with_quarter = |half: Spline| {
            let quarter = half.through_half(false).unwrap_or_else(|| half.clone());
            [half, quarter].map(Curve::Spline)
        };
        // Of three nodes there is one half.
        let halves = [false, true].map(|odd| spline.through_half(odd).or_else(|| spline.through_half(!odd)));
        let [Some(even), Some(odd)] = halves else { return None };
        Some(Self { all: curve, nodes: spline.knots(), halves: [even, odd].map(with_quarter) })
    }

    /// Distance of the nodes on either side of a point; nothing beside an end, which a line of symmetry may have made exact.
    fn node_distance(&self, x: Point) -> Option<f64> {
        let nodes = self.nodes;
        let after = nodes.partition_point(|node| *node < self.all.nearest(x));
        let is_beside_an_end = self.all.period().is_none() && (after < 2 || after + 1 >= nodes.len());
        let after = after.clamp(1, nodes.len() - 1);
        (!is_beside_an_end).then(|| nodes[after] - nodes[after - 1])
    }
}

/// Angle between two curves beside a point (radians).
fn angle(one: &Curve, other: &Curve, x: Point) -> f64 {
    let [a, b] = [one, other].map(|curve| curve.tangent(curve.nearest(x)));
    a.perp(&b).atan2(a.dot(&b))
}

/// Distance of two curves beside a point along the normal of the first (length).
fn offset(one: &Curve, other: &Curve, x: Point) -> f64 {
    let [a, b] = [one, other].map(|curve| curve.point(curve.nearest(x)));
    one.tangent(one.nearest(x)).perp(&(b - a))
}

/// Root mean square of values, each with its weight, or of what differs from their mean; 0 without any.
fn deviation(values: impl Iterator<Item = (f64, f64)>, without_mean: bool) -> f64 {
    let [whole, first, second] = values.fold([0.0; 3], |[whole, first, second], (value, weight)| {
        [whole + weight, first + weight * value, second + weight * value * value]
    });
    let mean = if without_mean { first / whole } else { 0.0 };
    if whole > 0.0 { (second / whole - mean * mean).max(0.0).sqrt() } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A place on the line y = 0 that presses.
    fn place(arc: f64) -> TracePoint {
        let (displacement, stress, distance) = ([0.0; 2], [0.0; 2], [0.0; 2]);
        let (x, normal) = (Point::new(arc, 0.0), Point::y());
        TracePoint { arc, x, normal, lambda: 1.0, displacement, slip: 0.0, stress, distance, gap: 0.0 }
    }

    /// Error of the slopes of the spline through points of a height over x, where it presses around the origin.
    fn off(height: impl Fn(f64) -> f64) -> f64 {
        let points: Vec<Point> = (-40..=40).map(|k| 0.05 * f64::from(k)).map(|x| Point::new(x, height(x))).collect();
        let spline = Spline::through(points.iter().map(|point| point.x).collect(), &points, false);
        let points: Vec<TracePoint> = (-30..=30).map(|k| place(0.013 * f64::from(k))).collect();
        let pressing = pressing_places(&points);
        let curve = Curve::Spline(spline);
        let own = spline_errors(&[NodedSide::of(&curve).expect("nodes")], &pressing, 0.0, angle);
        let [alike, other] = [own.clone(), Default::default()].map(|other| spline_error([own.clone(), other], &pressing, true));
        assert_eq!(alike, 0.0, "sides that share their nodes");
        other
    }

    #[test]
    fn what_nodes_leave_unknown_is_of_the_size_of_what_they_miss() {
        let round = |x: f64| 2.0 - (4.0 - x * x).sqrt();
        assert!(off(round) < 1e-6, "{}", off(round));
        assert_eq!(off(|_| 0.0), 0.0);
        // Every third node is off by 1e-4: slopes by that over the distance of nodes.
        let scatter = off(|x| round(x) + if (20.0 * x).round() as i32 % 3 == 0 { 1e-4 } else { 0.0 });
        assert!((1e-3..5e-3).contains(&scatter), "{scatter}");
        // A curvature that jumps at an even node, and at an odd one.
        for junction in [0.2, 0.15] {
            let jump = off(|x| 0.3 * (x.abs() - junction).max(0.0).powi(2));
            assert!((5e-4..1e-2).contains(&jump), "{jump} at {junction}");
        }
        // A ridge of two planes at .02 that nodes round off over two of their distances.
        let ridge = off(|x| 0.02 * x.abs());
        assert!((1e-3..1e-2).contains(&ridge), "{ridge}");
    }

    /// A curvature that jumps between two nodes, and a contact of a fiftieth of their distance: wherever that lies between them, it tells as
    /// much. At a point the splines may agree by chance: alone it told up to four times less, and .006 in the place of .031 for teeth of
    /// gears, whose pressure was a tenth off.
    #[test]
    fn a_narrow_contact_knows_no_more_of_its_shape_at_a_lucky_place() {
        let x = |k: i32| 0.05 * f64::from(k);
        let points: Vec<Point> = (-40..=40).map(x).map(|x| Point::new(x, 0.3 * (x - 0.02).max(0.0).powi(2))).collect();
        let curve = Curve::Spline(Spline::through((-40..=40).map(x).collect(), &points, false));
        let sides = [vec![NodedSide::of(&curve).expect("nodes")], Vec::new()];
        let told = |middle: f64, about: bool| {
            let places: Vec<TracePoint> = (-5..=5).map(|k| place(middle + 1e-4 * f64::from(k))).collect();
            let pressing = pressing_places(&places);
            let at = spline_error([spline_errors(&sides[0], &pressing, 0.0, angle), Default::default()], &pressing, true);
            if about { spline_error_about(&sides, &pressing, true, angle) } else { at }
        };
        let spread = |about: bool| {
            let told: Vec<f64> = (-10..=10).map(|k| told(0.02 + 0.005 * f64::from(k), about)).collect();
            told.iter().copied().fold(0.0, f64::max) / told.iter().copied().fold(f64::INFINITY, f64::min)
        };
        assert!(spread(true) < 2.0 && spread(false) > 3.0, "{} and {}", spread(true), spread(false));
    }

    /// Half of a round body by chords of 15 degrees, which presses beside its end: there the spline is not square to the line of symmetry,
    /// and that is a ridge. With the mean slope left out hardly anything would be seen of it.
    #[test]
    fn a_tilt_at_a_line_of_symmetry_is_seen() {
        let on_arc = |k: u32| f64::from(15 * k).to_radians();
        let points: Vec<Point> = (0..=6).map(|k| Point::new(on_arc(k).sin(), 1.0 - on_arc(k).cos())).collect();
        let curve = Curve::Spline(Spline::through((0..=6).map(on_arc).collect(), &points, false));
        let places: Vec<TracePoint> = (0..=15).map(|k| place(1e-3 * f64::from(k))).collect();
        let pressing = pressing_places(&places);
        let slope = |without_mean: bool| {
            spline_error(
                [spline_errors(&[NodedSide::of(&curve).expect("nodes")], &pressing, 0.0, angle), Default::default()],
                &pressing,
                without_mean,
            )
        };
        assert!(slope(false) > 1e-3 && slope(false) > 5.0 * slope(true), "{} and {}", slope(false), slope(true));
    }
}
