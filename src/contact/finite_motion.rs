//! What a linear contact model leaves out where bodies move far: its normals and corresponding points stay, while curved
//! bodies that slide along each other, or turn, face each other with other parts of their boundaries; and bodies that turn grow.

use super::contact_boundary::ContactBoundary;
use super::multiplier::Multipliers;
use super::pair::Configuration;
use super::smooth_side::SmoothSide;
use crate::geometry::{Point, gauss_points, turn_right};
use nalgebra::Rotation2;

/// Gauss points of a segment.
const POINTS: usize = 2;

/// A body that turns.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Turn {
    /// Rotation of the body (radians).
    pub angle: f64,
    /// Middle of the body, about which the linear theory makes it larger by half the square of the angle.
    pub middle: Point,
}

/// A gap that the linear theory leaves out, over the part of Γ_C that presses.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GapError {
    /// `∫λ e ds` (force times length); growth is not part of it.
    pub work: f64,
    /// Standard deviation of e from its mean, weighted with λ (length); of the zone where it is largest.
    pub deviation: f64,
    /// Standard deviation of e from a straight line along Γ_C, weighted with λ (length): without the tilt that moves a contact with
    /// two free ends; of the zone where it is largest.
    pub bend: f64,
    /// The force of each zone times how far its mean of e is from that of all, added up (force times length).
    pub between: f64,
}

/// How far two bodies slide and turn where they press, and what the linear gap leaves out.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FiniteMotion {
    /// Way along each other, root mean square weighted with λ (length).
    pub slip: f64,
    /// Gap of the displaced bodies less that of the linear theory.
    pub whole: GapError,
    /// What of it is left out because bodies turn.
    pub turning: GapError,
    /// `∫λ ds` (force per thickness).
    pub force: f64,
    /// Length of the segments that press.
    pub length: f64,
}

/// A point that presses.
struct PressedPoint {
    /// λ times the length it stands for.
    weight: f64,
    arc: f64,
    slip: f64,
    /// Gap that is left out: by all motion, by translations alone, by growth.
    moved: f64,
    shifted: f64,
    grown: f64,
}

/// Integrates over the segments that press; `lambda` are the multipliers' values, tension does not count. Without `sides`
/// (straight lines, and boundaries that follow the deformed bodies) only growth is left out.
pub fn finite_motion(
    sides: Option<[&SmoothSide; 2]>,
    turns: [Turn; 2],
    boundary: &ContactBoundary,
    multipliers: &Multipliers,
    lambda: &[f64],
) -> FiniteMotion {
    let (points, length) = pressed_places(boundary, multipliers, lambda);
    let force: f64 = points.iter().map(|[_, weight, _]| weight).sum();
    if force == 0.0 {
        return FiniteMotion::default();
    }
    let pressed_point = |&[t, weight, arc]: &[f64; 3], tilts: [f64; 2]| {
        let (x, normal) = (boundary.point(t), boundary.normal(t));
        let [slip, moved, shifted] = match sides {
            Some(sides) => {
                let [[slip, moved], [_, shifted]] = [left_out(sides, tilts, x, normal)?, left_out(sides, [0.0; 2], x, normal)?];
                [slip, moved, shifted]
            }
            None => [0.0; 3],
        };
        let growth = turns.map(|turn| 0.5 * turn.angle * turn.angle * (x - turn.middle).dot(&normal));
        Some(PressedPoint { weight, arc, slip, moved, shifted, grown: growth[0] - growth[1] })
    };
    // Between zones that lie farther apart than all of them are long, bodies may bend: each turns by itself.
    let zones = points.chunk_by(|one, next| next[2] - one[2] <= length).map(|points| {
        let tilts = sides.map_or([0.0; 2], |sides| sides.map(|side| mean_tilt(side, boundary, points)));
        points.iter().filter_map(|point| pressed_point(point, tilts)).collect()
    });
    let zones: Vec<Vec<PressedPoint>> = zones.collect();
    FiniteMotion {
        slip: mean(zones.iter().flatten(), |point| point.slip * point.slip).sqrt(),
        whole: gap_error(&zones, force, |point| point.moved),
        turning: gap_error(&zones, force, |point| point.moved - point.shifted),
        force,
        length,
    }
}

/// Parameter, weight and arc length of the points that press, and the length of the segments that do.
pub fn pressed_places(boundary: &ContactBoundary, multipliers: &Multipliers, lambda: &[f64]) -> (Vec<[f64; 3]>, f64) {
    let (mut points, mut length): (Vec<[f64; 3]>, f64) = (Vec::new(), 0.0);
    for (k, ends) in boundary.knots().windows(2).enumerate() {
        let before = points.len();
        for (z, weight) in gauss_points(POINTS) {
            let pressure = multipliers.value(lambda, k, *z);
            let t = ends[0] + z * (ends[1] - ends[0]);
            if pressure > 0.0 {
                points.push([t, pressure * weight * boundary.segment_length(k) * boundary.width(t), boundary.arc(t)]);
            }
        }
        length += if points.len() > before { boundary.segment_length(k) } else { 0.0 };
    }
    if let Some(turn) = boundary.turn() {
        count_from_a_gap(&mut points, turn);
    }
    (points, length)
}

/// Counts the arc lengths of points on a closed boundary from the widest gap between them, so that what presses hangs together.
fn count_from_a_gap(points: &mut [[f64; 3]], turn: f64) {
    let count = points.len();
    let gap = |k: usize| if k == 0 { points[0][2] + turn - points[count - 1][2] } else { points[k][2] - points[k - 1][2] };
    let first = (0..count).max_by(|&a, &b| gap(a).total_cmp(&gap(b))).unwrap_or(0);
    points[..first].iter_mut().for_each(|point| point[2] += turn);
    points.rotate_left(first);
}

/// Mean weighted with λ; zero without points.
fn mean<'a>(pressed: impl IntoIterator<Item = &'a PressedPoint>, value: impl Fn(&PressedPoint) -> f64) -> f64 {
    let weighted = |[sum, total]: [f64; 2], point: &PressedPoint| [sum + point.weight * value(point), total + point.weight];
    let [sum, total] = pressed.into_iter().fold([0.0; 2], weighted);
    if total == 0.0 { 0.0 } else { sum / total }
}

/// Work of a gap that is left out, and how uneven it is together with growth.
fn gap_error(zones: &[Vec<PressedPoint>], force: f64, gap: impl Fn(&PressedPoint) -> f64) -> GapError {
    let all = |point: &PressedPoint| gap(point) + point.grown;
    let mean_of_all = mean(zones.iter().flatten(), all);
    let start = GapError { work: force * mean(zones.iter().flatten(), &gap), ..GapError::default() };
    zones.iter().fold(start, |found, zone| {
        let (middle, error) = (mean(zone, |point| point.arc), mean(zone, all));
        let square = mean(zone, |point| (all(point) - error).powi(2));
        let spread = mean(zone, |point| (point.arc - middle).powi(2));
        let common = mean(zone, |point| (point.arc - middle) * (all(point) - error));
        let tilted = if spread > 0.0 { common * common / spread } else { 0.0 };
        GapError {
            deviation: found.deviation.max(square.sqrt()),
            bend: found.bend.max((square - tilted).max(0.0).sqrt()),
            between: found.between + zone.iter().map(|point| point.weight).sum::<f64>() * (error - mean_of_all).abs(),
            ..found
        }
    })
}

/// Angle by which a side is turned where it presses, its mean weighted with λ (radians).
fn mean_tilt(side: &SmoothSide, boundary: &ContactBoundary, points: &[[f64; 3]]) -> f64 {
    let (mut sum, mut total) = (0.0, 0.0);
    for &[t, weight, _] in points {
        let foot = side.nearest(boundary.point(t), Configuration::Reference);
        let [before, after] = [Configuration::Reference, Configuration::Deformed].map(|which| side.curve(which).tangent(foot));
        sum += weight * before.perp(&after).atan2(before.dot(&after));
        total += weight;
    }
    sum / total
}

/// Parameters of the places of both sides that correspond to a point of Γ_C.
pub fn feet(sides: [&SmoothSide; 2], x: Point, normal: Point) -> Option<[f64; 2]> {
    let foot = |side: &SmoothSide| {
        let curve = side.curve(Configuration::Reference);
        curve.hit_from(curve.nearest(x - side.shift), x - side.shift, normal)
    };
    Some([foot(sides[0])?, foot(sides[1])?])
}

/// Slip, and gap of the displaced bodies less the linear one, at a point of Γ_C that moves with the bodies' mean. Each
/// boundary keeps its shape, moves by the displacement of its corresponding point, and turns by its tilt about it: what it
/// is strained moves on with the contact, and is no error.
fn left_out(sides: [&SmoothSide; 2], tilts: [f64; 2], x: Point, normal: Point) -> Option<[f64; 2]> {
    let [undeformed, deformed] =
        [Configuration::Reference, Configuration::Deformed].map(|which| sides.map(|side| side.curve(which)));
    let feet = feet(sides, x, normal)?;
    let moved = [0, 1].map(|k| deformed[k].point(feet[k]) - undeformed[k].point(feet[k]));
    // From where corresponding points are those of Γ_C.
    let since = [0, 1].map(|k| moved[k] - sides[k].shift);
    let mean_tilt = 0.5 * (tilts[0] + tilts[1]);
    let mut change = [0.0; 2];
    for k in 0..2 {
        // The line along which the gap is measured, as seen from the body.
        let (curve, start) = (undeformed[k], undeformed[k].point(feet[k]));
        let origin = start + Rotation2::new(-tilts[k]) * (x + 0.5 * (since[0] + since[1]) - start - moved[k]);
        let direction = Rotation2::new(mean_tilt - tilts[k]) * normal;
        let foot = curve.hit_from(feet[k], origin, direction)?;
        change[k] = (curve.point(foot) - origin).dot(&direction) - (start - x).dot(&normal);
    }
    let apart = moved[1] - moved[0];
    let slip = (since[1] - since[0]).dot(&turn_right(normal));
    Some([slip.abs(), change[1] - change[0] - apart.dot(&normal)])
}

#[cfg(test)]
mod tests {
    use super::super::pair::MultiplierSpace;
    use super::*;
    use crate::contact::samples;
    use crate::element::Order;
    use crate::geometry::Curve;
    use crate::mesh::samples::two_blocks;
    use crate::mesh::{EdgeNode, Level, Numbering, Partition};
    use std::rc::Rc;

    /// The flat lower side, and the upper one over it, bent, each moved by a function of the place.
    fn sides(moves: [&dyn Fn(Point) -> Point; 2]) -> [SmoothSide; 2] {
        let mut mesh = two_blocks();
        // The vertex between both edges of the upper seam is lifted: a smooth arch.
        mesh.vertices.iter_mut().filter(|x| x.x == 0.9 && x.y == 1.0).for_each(|x| x.y = 1.1);
        let numbering = Numbering::new(Level { intervals: 16, order: Order::P2 }, &Rc::new(Partition::new(&mesh, &[0; 6], 1)));
        let upper = mesh.bodies.iter().position(|name| name == "upper");
        let places = SmoothSide::of_pair(&mesh, &numbering, &samples::seam(), &|_| Point::zeros());
        let displacement = |node: EdgeNode| {
            let side = usize::from(Some(mesh.body_beside(node.edge)) == upper);
            let near = |place: &&Point| (*place - node.place(&mesh, &numbering)).norm();
            let place = places[side][0].places.iter().min_by(|a, b| near(a).total_cmp(&near(b))).expect("nodes");
            moves[side](*place)
        };
        SmoothSide::of_pair(&mesh, &numbering, &samples::seam(), &displacement).map(|mut stretches| stretches.swap_remove(0))
    }

    /// The line y = 1 in segments of a tenth, and a pressure that differs from one to the next; nothing presses at its ends.
    fn seam() -> (ContactBoundary, Multipliers, Vec<f64>) {
        let mut boundary = ContactBoundary::new(Curve::Line([[0.0, 1.0], [2.0, 1.0]]), [0.0, 1.0], Point::new(0.0, 1.0));
        boundary.cut(&(0..=20).map(|k| f64::from(k) / 20.0).collect::<Vec<_>>());
        let multipliers = Multipliers::new(MultiplierSpace::P0, &boundary);
        let pressure = |k: usize| if (4..14).contains(&k) { 1.0 + 0.3 * k as f64 } else { -0.5 };
        (boundary, multipliers, (0..20).map(pressure).collect())
    }

    /// Points that press on the seam: x and λ times length, by the Gauss points of each segment.
    fn presses(lambda: &[f64]) -> Vec<[f64; 2]> {
        let on = |k: usize| gauss_points(POINTS).iter().map(move |(z, weight)| [0.1 * (k as f64 + z), 0.1 * weight * lambda[k]]);
        (0..lambda.len()).filter(|&k| lambda[k] > 0.0).flat_map(on).collect()
    }

    /// Work, deviation from the mean, and deviation from the line of least squares, of an error at the points that press.
    fn expected(points: &[[f64; 2]], error: impl Fn(f64) -> f64) -> GapError {
        let total: f64 = points.iter().map(|point| point[1]).sum();
        let sum = |value: &dyn Fn(f64) -> f64| points.iter().map(|[x, weight]| weight * value(*x)).sum::<f64>();
        let (mean_x, mean) = (sum(&|x| x) / total, sum(&error) / total);
        let slope = sum(&|x| (x - mean_x) * error(x)) / sum(&|x| (x - mean_x) * (x - mean_x));
        let deviation = (sum(&|x| (error(x) - mean).powi(2)) / total).sqrt();
        let bend = (sum(&|x| (error(x) - mean - slope * (x - mean_x)).powi(2)) / total).sqrt();
        GapError { work: sum(&error), deviation, bend, between: 0.0 }
    }

    fn assert_near(found: GapError, wanted: GapError, tolerance: f64) {
        let pairs = [(found.work, wanted.work), (found.deviation, wanted.deviation), (found.bend, wanted.bend)];
        assert!(pairs.iter().all(|(a, b)| (a - b).abs() < tolerance * b.abs()), "{found:?} instead of {wanted:?}");
    }

    /// Height of a curve over x by bisection.
    fn height(curve: &Curve, x: f64) -> f64 {
        let [mut from, mut to] = curve.range();
        for _ in 0..60 {
            let middle = 0.5 * (from + to);
            if curve.point(middle).x < x { from = middle } else { to = middle }
        }
        curve.point(from).y
    }

    #[test]
    fn an_arch_that_slides_is_seen_at_half_the_way_behind() {
        for (first, second) in [([0.0, 0.0], [0.2, 0.07]), ([0.2, -0.05], [0.0, 0.0]), ([-0.05, 0.01], [0.1, 0.02])] {
            let (first, second) = (Point::from(first), Point::from(second));
            let (boundary, multipliers, lambda) = seam();
            let sides = sides([&|_| first, &|_| second]);
            let found = finite_motion(Some([&sides[0], &sides[1]]), [Turn::default(); 2], &boundary, &multipliers, &lambda);
            let way = second - first;
            assert!((found.slip - way.x.abs()).abs() < 1e-9 && (found.length - 1.0).abs() < 1e-9, "{found:?}");
            let points = presses(&lambda);
            assert!((found.force - points.iter().map(|point| point[1]).sum::<f64>()).abs() < 1e-9);
            // The line of the gap goes with the mean of both: over the arch it lags half the way behind.
            let arch = sides[1].curve(Configuration::Reference);
            assert_near(found.whole, expected(&points, |x| height(arch, x - 0.5 * way.x) - height(arch, x)), 1e-6);
            assert!(found.turning.work.abs() < 1e-9 && found.turning.deviation < 1e-9, "nothing turns: {found:?}");
        }
    }

    #[test]
    fn an_arch_that_turns_opens_the_gap_that_its_true_rotation_opens() {
        for angle in [0.06, -0.04] {
            let (boundary, multipliers, lambda) = seam();
            let pivot = Point::new(0.7, 1.4);
            let turned = |x: Point| pivot + Rotation2::new(angle) * (x - pivot);
            let sides = sides([&|_| Point::zeros(), &|x| turned(x) - x]);
            let found = finite_motion(Some([&sides[0], &sides[1]]), [Turn::default(); 2], &boundary, &multipliers, &lambda);
            let arch = sides[1].curve(Configuration::Reference);
            let moved = |x: f64| turned(Point::new(x, height(arch, x))) - Point::new(x, height(arch, x));
            // Along a line from half the way, tilted by half the angle, from the flat side to the arch as it lies now.
            let gap = |x: f64| {
                let origin = Point::new(x, 1.0) + 0.5 * moved(x);
                let direction = Rotation2::new(0.5 * angle) * Point::new(0.0, 1.0);
                let (mut low, mut high) = (-1.0, 1.0);
                for _ in 0..60 {
                    let middle = 0.5 * (low + high);
                    let back = pivot + Rotation2::new(-angle) * (origin + middle * direction - pivot);
                    if back.y < height(arch, back.x) { low = middle } else { high = middle }
                }
                low - (1.0 - origin.y) / direction.y
            };
            let points = presses(&lambda);
            let linear = |x: f64| height(arch, x) - 1.0 + moved(x).y;
            assert_near(found.whole, expected(&points, |x| gap(x) - linear(x)), 1e-5);
            let shifted = |x: f64| height(arch, x - 0.5 * moved(x).x) - height(arch, x);
            assert_near(found.turning, expected(&points, |x| gap(x) - linear(x) - shifted(x)), 1e-5);
            let slip = points.iter().map(|[x, weight]| weight * moved(*x).x.powi(2)).sum::<f64>() / found.force;
            assert!((found.slip - slip.sqrt()).abs() < 1e-8, "{} instead of {}", found.slip, slip.sqrt());
        }
    }

    /// Growth is half the square of the angle times the distance from the middle along the normal: uneven around an arc where
    /// that middle is not the arc's, and nothing where both bodies grow alike.
    #[test]
    fn bodies_that_turn_grow_unevenly_about_another_middle_than_that_of_the_arc() {
        let arc = Curve::Circle { centre: [1.0, 2.0], radius: 0.5 };
        let mut boundary = ContactBoundary::new(arc, [-1.0, 1.0], Point::new(1.0, 0.0));
        boundary.cut(&(0..=50).map(|k| f64::from(k) / 50.0).collect::<Vec<_>>());
        let multipliers = Multipliers::new(MultiplierSpace::P0, &boundary);
        let at = |x: f64, y: f64| Turn { angle: -0.2, middle: Point::new(1.0 + x, 2.0 + y) };
        let of = |turns: [Turn; 2]| finite_motion(None, turns, &boundary, &multipliers, &[3.0; 50]);
        let nothing = Turn::default();
        let found = of([at(0.0, 0.0), nothing]);
        assert!(found.whole.deviation < 1e-9 && found.whole.bend < 1e-9 && found.slip == 0.0);
        assert!((found.force - 3.0).abs() < 1e-9 && (found.length - 1.0).abs() < 1e-9);
        // Mean and mean square of cos and sin on -1 to 1; the line of least squares takes 3 (sin 1 - cos 1)² off the latter.
        let (mean, sine) = (1f64.sin(), 0.5 - 0.25 * 2f64.sin());
        let even = (1.0 - sine - mean * mean).sqrt();
        let odd = (sine - 3.0 * (1f64.sin() - 1f64.cos()).powi(2)).sqrt();
        for turns in [[at(0.3, 0.0), nothing], [nothing, at(0.3, 0.0)], [at(0.5, 0.4), at(0.2, 0.4)]] {
            let found = of(turns).whole;
            let wanted = 0.02 * 0.3 * even;
            assert!((found.deviation / wanted - 1.0).abs() < 1e-3 && (found.bend / wanted - 1.0).abs() < 1e-3, "{found:?}");
            assert_eq!(found.work, 0.0);
        }
        let found = of([at(0.0, 0.3), nothing]);
        assert!((found.whole.deviation / (0.02 * 0.3 * sine.sqrt()) - 1.0).abs() < 1e-3, "{found:?}");
        assert!((found.turning.bend / (0.02 * 0.3 * odd) - 1.0).abs() < 1e-2, "{found:?}");
        assert_eq!(of([at(0.1, 0.3); 2]).whole, GapError::default(), "both grow alike");
        assert_eq!(finite_motion(None, [nothing; 2], &boundary, &multipliers, &[-1.0; 50]), FiniteMotion::default());
    }

    /// Both ends of an arc press: each is judged by itself, and the way from one to the other by their forces.
    #[test]
    fn zones_that_lie_far_apart_turn_by_themselves() {
        let arc = Curve::Circle { centre: [1.0, 2.0], radius: 0.5 };
        let mut boundary = ContactBoundary::new(arc, [-1.0, 1.0], Point::new(1.0, 0.0));
        boundary.cut(&(0..=50).map(|k| f64::from(k) / 50.0).collect::<Vec<_>>());
        let multipliers = Multipliers::new(MultiplierSpace::P0, &boundary);
        let turn = Turn { angle: -0.2, middle: Point::new(1.0, 2.3) };
        let of = |presses: fn(usize) -> bool| {
            let lambda: Vec<f64> = (0..50).map(|k| if presses(k) { 3.0 } else { 0.0 }).collect();
            finite_motion(None, [turn, Turn::default()], &boundary, &multipliers, &lambda).whole
        };
        let found = of(|k| !(5..45).contains(&k));
        // Growth goes like the sine of the angle; its mean and mean square between .8 and 1.
        let mean = (0.8f64.cos() - 1f64.cos()) / 0.2;
        let square = 0.5 - (2f64.sin() - 1.6f64.sin()) / 0.8;
        let growth = 0.02 * 0.3;
        assert!((found.between / (0.6 * growth * mean) - 1.0).abs() < 1e-3, "{found:?}");
        assert!((found.deviation / (growth * (square - mean * mean).sqrt()) - 1.0).abs() < 1e-2, "{found:?}");
        let near = of(|k| !(15..35).contains(&k));
        assert!(near.between == 0.0 && near.deviation > 0.5 * growth, "they lie nearer than they are long: {near:?}");
    }
}
