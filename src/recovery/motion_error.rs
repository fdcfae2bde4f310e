//! What finite motions do to contact pressures of the linear theory.
//!
//! On undeformed bodies the fit bisects both boundaries, so that the error of the gap is of second order in the slip s:
//! `s²/(8R)`, evenly, for a cylinder of radius R on a flat block. Measured on a cylinder that a prescribed displacement presses
//! and shifts by s (half width a of 0.114, equal moduli; strains of 3 %), by the same with `"deformed"` and no slip:
//!
//! | s/a | `∫λ ds`, `"reference"` | `slip_error` | largest λ | `"deformed"`: `∫λ ds`, largest λ |
//! |---|---|---|---|---|
//! | 0.13 | +0.2 % | 0.2 % | +0.2 % | 0.0 %, 0.0 % |
//! | 0.26 | +0.7 % | 0.6 % | +0.5 % | 0.0 %, 0.0 % |
//! | 0.53 | +2.6 % | 2.2 % | +1.6 % | 0.0 %, +0.1 % |
//! | 1.05 | +10.5 % | 9.0 % | +5.7 % | 0.0 %, +0.3 % |
//!
//! A pad in a bore of radius 2 that is turned by 0.02 and pushed by 5e-4 loses 40 % of its force by the growth `θ²/2`, and 15 %
//! more on deformed bodies. On pads of half a radian, turned by 0.02 to 0.1, `rotation_error` was between 0.55 and 1.5 times the
//! true error of the force, on undeformed and on deformed bodies. Sliding and turning count together in `slip_error`, since a
//! round body that turns about its centre does both, and the one undoes the other. Where equilibrium sets the force its error is
//! zero. Where both ends of contact lie inside the boundaries, a tilt of the gap moves the contact and does not change λ.
//!
//! Zones that lie farther apart than all of them are long are judged by themselves. A leaf that is bent round a former presses at its root
//! and where it leaves the former: as one stretch it was told to be off by .95, by zones .09; on edges a quarter as long .007 is told for
//! a true 1.5e-3.

use super::balance::Balance;
use super::deformation::Deformation;
use super::direction_error::direction_errors;
use super::slant::slant;
use super::traces::TracePoint;
use crate::body::RigidSet;
use crate::contact::{Configuration, FiniteMotion, GapError, SmoothSide, Turn, TurnedForce, finite_motion, turned_force};
use crate::discretisation::{BoundaryMotion, Contact, ContactPressure, Discretisation, Freedom, Solution};
use crate::geometry::Point;
use crate::mesh::{EdgeNode, MacroEdge, MacroMesh};

/// A gap smaller than this share of the growth counts as large as that.
const NO_GAP: f64 = 1e-3;

/// The reference point of a tool that may turn may lie above its curved boundary by this share of the radius R. A roller that turns
/// about a point at the height h is held by its force times R - h; normals of where it is drawn make `(R - h)²/R` of it, so that
/// the turn is off by h/(R - h), here by a third of itself.
const NEAR_ENOUGH: f64 = 0.25;

/// Relative error beyond: the turn is not known.
const UNKNOWN: f64 = 1.0;

/// Growth by less than this share of the displacements is rounding.
const ROUNDING: f64 = 1e-5;

/// The same share of the largest displacement of all.
const NO_MOTION: f64 = 1e-12;

/// Sliding and turning of the two bodies in a contact, and what they spoil.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotionError {
    /// Way of the bodies along each other, as a share of the length that presses; of curved fits on undeformed bodies.
    pub slip: Option<f64>,
    /// Estimated relative error of force or pressure by sliding and turning together; of such fits too.
    pub slip_error: Option<f64>,
    /// The part of it that comes from turning; for all contacts.
    pub rotation_error: f64,
    /// Angle between Γ_C and the side on which a corner of the other one presses (radians): the direction of the force is off by it.
    pub slant: f64,
    /// Force that this contact takes up once those on its bodies have turned with the bodies, by its own.
    pub direction_error: f64,
}

/// For each contact what motions spoil; nothing where no body is strained. Equilibrium sets the forces of contacts that are
/// `needed`, and `turns` is the rotation of each macro triangle (radians).
/// **Collective**
pub fn motion_errors(
    (problem, needed): (&Discretisation, &[bool]),
    solution: &Solution,
    balance: &Balance,
    (bodies, turns): (&[Deformation], &[f64]),
) -> Vec<Option<MotionError>> {
    let is_reference = |contact: &Contact| contact.pair.configuration == Configuration::Reference;
    let follows = |contact: &Contact| is_reference(contact) && contact.known.meeting.is_some();
    // What equilibrium sets is right whatever is left out, but the motion of a tool is off by all of that.
    let is_set =
        |(contact, &needed): (&Contact, &bool)| needed && !is_between_tools(problem, contact, &|set| set.free().next().is_some());
    let set: Vec<bool> = problem.contacts.iter().zip(needed).map(is_set).collect();
    let freedoms = Freedom::of_bodies(&problem.scene);
    let beside = |body: usize| problem.contacts.iter().filter(|contact| contact.bodies.contains(&body)).count() > 1;
    let turns_others =
        |contact: &Contact| is_reference(contact) && contact.bodies.iter().any(|&body| freedoms[body].is_some() && beside(body));
    let (mesh, space) = (&problem.scene.mesh, problem.finest());
    let motion = || BoundaryMotion::new(&problem.scene, space, &solution.displacement, &problem.session);
    let motion = problem.contacts.iter().any(|contact| follows(contact) || turns_others(contact)).then(motion);
    let with_sides = |(contact, &is_set): (&Contact, &bool)| {
        let sides_of = |motion: &BoundaryMotion| {
            SmoothSide::of_pair(mesh, &space.numbering, &contact.pair, &|node: EdgeNode| motion.at(node, mesh, space))
        };
        let mut sides = motion.as_ref().filter(|_| follows(contact) || turns_others(contact)).map(sides_of);
        let meeting = contact.known.meeting.as_ref().filter(|_| follows(contact));
        meeting.zip(sides.as_mut()).into_iter().for_each(|(meeting, sides)| meeting.begin(sides));
        let met = meeting.zip(sides.as_ref()).map(|(meeting, sides)| meeting.sides(sides));
        let whole = sides.as_ref().filter(|sides| sides.iter().all(|side| side.len() == 1)).map(|[a, b]| [&a[0], &b[0]]);
        let turned = turned(solution, contact, met.or(whole));
        (one(problem, solution, (contact, is_set), &balance.strain, (bodies, turns), met), turned)
    };
    let (found, forces): (Vec<Option<MotionError>>, Vec<TurnedForce>) = problem.contacts.iter().zip(&set).map(with_sides).unzip();
    let moments: Vec<f64> = bodies.iter().zip(&balance.guided).map(|(body, guided)| body.moment - guided).collect();
    let directions = direction_errors(problem, freedoms, &forces, &moments);
    found.iter().zip(directions).map(|(found, direction_error)| Some(MotionError { direction_error, ..(*found)? })).collect()
}

/// How the force of a contact has turned with its bodies.
fn turned(solution: &Solution, contact: &Contact, sides: Option<[&SmoothSide; 2]>) -> TurnedForce {
    turned_force(sides, &contact.boundary, &contact.multipliers, &solution.multipliers[contact.range()])
}

/// What motions spoil of one contact but for the direction of forces; equilibrium may set its force (`is_set`). **Collective**
fn one(
    problem: &Discretisation,
    solution: &Solution,
    (contact, is_set): (&Contact, bool),
    energy: &[f64],
    (bodies, turns): (&[Deformation], &[f64]),
    sides: Option<[&SmoothSide; 2]>,
) -> Option<MotionError> {
    let turns = [0, 1].map(|side| {
        let body = &bodies[contact.bodies[side]];
        let is_tool = problem.scene.tool(contact.bodies[side]).is_some();
        let here = if is_tool { body.rotation } else { turn_at(&problem.scene.mesh, &solution.pressure(contact), side, turns) };
        Turn { angle: counted(here, body.rotation), middle: body.middle }
    });
    let found = finite_motion(sides, turns, &contact.boundary, &contact.multipliers, &solution.multipliers[contact.range()]);
    let energy: f64 = contact.bodies.iter().map(|&body| energy[body]).sum();
    let growth: f64 = contact.bodies.iter().map(|&body| bodies[body].growth).sum();
    let (tool_turn, lever) = tool_lever(problem, solution, contact, bodies);
    let growth = growth + 0.5 * tool_turn * tool_turn * lever;
    if found.force <= 0.0 || energy <= 0.0 {
        return None;
    }
    let is_straight = match sides {
        Some(sides) => sides.iter().all(|side| side.shape.is_line()),
        None => contact.boundary.is_straight(),
    };
    let may_turn = !is_straight && is_between_tools(problem, contact, &|set| set.prescribed[2].is_none());
    let rolled = if may_turn { rolling_error(contact, &found, tool_turn, lever / found.force) } else { 0.0 };
    let error = |gap: &GapError| {
        // By how much the energy, and so the force where displacements set it, is off.
        let force = if is_set { 0.0 } else { (growth - gap.work).abs() / (2.0 * energy) };
        // Between two zones the bodies give way as they do to the loads, and their energy tells by how much that is.
        let between = gap.between / (2.0 * energy);
        force.max(pressure_error(contact, &found, gap)).max(between).max(rolled)
    };
    Some(MotionError {
        slip: sides.map(|_| found.slip / found.length),
        slip_error: sides.map(|_| error(&found.whole)),
        rotation_error: error(&found.turning),
        slant: sides.map_or(0.0, |sides| slant(&problem.scene, &solution.pressure(contact), sides)),
        direction_error: 0.0,
    })
}

/// The turn of a body that counts in a contact (radians), by that beside it and the mean of the body: the smaller one, and none where a
/// bent body turns there against its mean. The error that is told is so never larger than by the mean alone.
fn counted(here: f64, mean: f64) -> f64 {
    if here * mean > 0.0 { here.abs().min(mean.abs()).copysign(mean) } else { 0.0 }
}

/// By how much a body turns where it presses (radians): the largest rotation of the macro triangles beside the ends and the centre of what presses.
/// A half of a strip that is bent turns in the mean, and not where it is cut in two; so whole and half are judged alike.
fn turn_at(mesh: &MacroMesh, pressure: &ContactPressure, side: usize, turns: &[f64]) -> f64 {
    let (zones, boundary) = (pressure.zones(), &pressure.contact.boundary);
    let ends = zones.first().zip(zones.last()).map(|(first, last)| [first.arcs[0], last.arcs[1]]);
    let ends = ends.into_iter().flatten().map(|arc| boundary.point(boundary.parameter_at(arc)));
    let edges: Vec<&MacroEdge> =
        mesh.edges_of(&pressure.contact.pair.between[side]).iter().map(|&edge| &mesh.edges[edge as usize]).collect();
    let middle = |edge: &MacroEdge| 0.5 * edge.vertices.map(|vertex| mesh.vertices[vertex as usize]).into_iter().sum::<Point>();
    let turn = |place: Point| {
        let distance = |edge: &&&MacroEdge| (middle(edge) - place).norm_squared();
        let nearest = edges.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
        Some(turns[nearest.triangles.iter().flatten().next().copied()? as usize])
    };
    let found = ends.chain(pressure.centre()).filter_map(turn);
    found.fold(0.0, |most, turn| if turn.abs() > f64::abs(most) { turn } else { most })
}

/// Whether a body of the contact is a rigid tool of which this is true.
fn is_between_tools(problem: &Discretisation, contact: &Contact, is: &dyn Fn(&RigidSet) -> bool) -> bool {
    let scene = &problem.scene;
    contact.bodies.iter().filter_map(|&body| scene.tool(body)).any(is)
}

/// Turn of the tool in a contact (radians), and how far its reference point x₀ lies behind what presses, times the force:
/// `∫λ n·(x - x₀) ds`. The tool seems to grow by half the square of the turn times that. **Collective**
fn tool_lever(problem: &Discretisation, solution: &Solution, contact: &Contact, bodies: &[Deformation]) -> (f64, f64) {
    let (scene, numbering) = (&problem.scene, &problem.finest().numbering);
    let mut lever = [0.0];
    for row in problem.coupling.own(contact.range(), problem.session.rank()) {
        for coupled in &problem.coupling.rows[row] {
            if let Some(tool) = scene.tool(coupled.body) {
                let arm = coupled.node.place(&scene.mesh, numbering) - tool.about;
                lever[0] += solution.multipliers[row] * coupled.value.dot(&arm);
            }
        }
    }
    problem.session.sum(&mut lever);
    let tool = contact.bodies.into_iter().find(|&body| scene.tool(body).is_some());
    (tool.map_or(0.0, |body| bodies[body].rotation), lever[0])
}

/// Relative error of λ where a tool rolls on a curved boundary, its reference point `lever` away from it (a length): the contact
/// lies elsewhere by turn times lever, of half the length that presses. Measured on a roller of R = 50 (half width 1.7, turned by
/// about .01 by a moment) against one drawn turned until it turns no more: .083 for .104 at h = 10, .056 for .046 at -10, .0001 for
/// 0 at 0; the peak changes by less than 2e-4.
fn rolling_error(contact: &Contact, found: &FiniteMotion, turn: f64, lever: f64) -> f64 {
    let boundary = &contact.boundary;
    let between = |ends: &[f64]| boundary.normal(ends[0]).dot(&boundary.normal(ends[1])).clamp(-1.0, 1.0).acos();
    let curvature = boundary.knots().windows(2).map(between).sum::<f64>() / boundary.length();
    if curvature * lever.abs() > NEAR_ENOUGH { UNKNOWN } else { 2.0 * (turn * lever).abs() / found.length }
}

/// Relative error of λ by an uneven gap that is left out. On a half-plane a gap that varies by e over the half length a takes
/// the pressure E* e/a; E* is about E_c/2.
fn pressure_error(contact: &Contact, found: &FiniteMotion, gap: &GapError) -> f64 {
    let is_whole = contact.boundary.turn().is_some_and(|turn| found.length > turn * (1.0 - 1e-9));
    let ends_inside = contact.ends_with_a_body() == [false; 2] && !is_whole;
    let modulus = contact.moduli.iter().copied().fold(0.0, f64::max);
    let middle = contact.boundary.parameter_at(0.5 * contact.boundary.length());
    let width = contact.boundary.width(middle);
    modulus * width * if ends_inside { gap.bend } else { gap.deviation } / found.force
}

/// Growth of two bodies by their turning, relative to the smallest gap; nothing if it is rounding beside their displacements in the
/// contact, or beside the `farthest` displacement of all.
pub fn growth_by_gap(bodies: [&Deformation; 2], points: &[TracePoint], farthest: f64) -> Option<f64> {
    let growth: f64 = bodies.iter().map(|body| 0.5 * body.rotation * body.rotation * body.radius).sum();
    let moved = points.iter().map(TracePoint::largest_displacement).fold(0.0, f64::max);
    let smallest = points.iter().map(|point| point.gap).filter(|gap| gap.is_finite()).reduce(f64::min)?;
    (growth > ROUNDING * moved && growth > NO_MOTION * farthest).then(|| growth / smallest.max(NO_GAP * growth))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::{Known, MultiplierSpace};
    use crate::discretisation::samples::{blocks, contact, pair};

    #[test]
    fn bodies_that_turn_grow_by_half_the_square_of_the_angle() {
        let turned = |rotation: f64| {
            let (place, middle) = (Point::zeros(), Point::zeros());
            Deformation { strain: 0.0, place, rotation, turned: rotation, growth: 0.0, moment: 0.0, middle, radius: 3.0 }
        };
        let point = |gap: f64| {
            let (x, normal) = (Point::zeros(), Point::y());
            let displacement = [1e-4, -2e-4];
            TracePoint { arc: 0.0, x, normal, lambda: 0.0, displacement, slip: 0.0, stress: [0.0; 2], distance: [0.0, gap], gap }
        };
        let points = [point(0.02), point(0.01), point(f64::NAN)];
        let found = growth_by_gap([&turned(0.01), &turned(-0.02)], &points, 0.1).expect("growth");
        assert!((found / (1.5 * (0.01f64.powi(2) + 0.02f64.powi(2)) / 0.01) - 1.0).abs() < 1e-12, "{found}");
        assert_eq!(growth_by_gap([&turned(1e-6), &turned(0.0)], &points, 0.1), None, "rounding beside the displacements");
        assert_eq!(growth_by_gap([&turned(0.1), &turned(0.0)], &[], 0.1), None, "no gap");
    }

    #[test]
    fn a_contact_turns_by_what_turns_beside_it() {
        assert_eq!(
            [(0.01, 0.5), (-0.7, -0.5), (-0.01, 0.5), (0.0, 0.5)].map(|(here, mean)| counted(here, mean)),
            [0.01, -0.5, 0.0, 0.0]
        );
        let scene = blocks(pair(MultiplierSpace::P0, 8), |_| Point::zeros(), Vec::new());
        let contact = contact(&scene, Known::default());
        let pressure = ContactPressure { contact: &contact, values: &[1.0; 8], active: &[true; 8] };
        let mut turns = vec![0.5; scene.mesh.triangles.len()];
        for (side, turn) in [(0, 0.01), (1, -0.02)] {
            for &edge in scene.mesh.edges_of(&contact.pair.between[side]) {
                let beside = scene.mesh.edges[edge as usize].triangles.iter().flatten().next().expect("a triangle");
                turns[*beside as usize] = turn;
            }
            assert_eq!(turn_at(&scene.mesh, &pressure, side, &turns), turn);
        }
    }
}
