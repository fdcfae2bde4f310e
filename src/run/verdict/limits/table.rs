//! Every limit, with its derivation or its measurement where there is one.
//!
//! A row is the limit of a figure of `summary.json`, which its comment names, how the value is written, what helps, the cause,
//! and the sentence.

use super::Remedy::{Finer, MoreSegments, Stability, Words};
use super::{Limit, least, most};
use crate::accuracy::{CUT, DOUBTED_WITHIN_SEGMENTS};
use crate::run::words::{short, two_digits};

fn one(value: f64) -> String { format!("{value:.1}") }
fn two(value: f64) -> String { format!("{value:.2}") }
fn three(value: f64) -> String { format!("{value:.3}") }
fn whole(value: f64) -> String { format!("{value:.0}") }

/// A share in per cent.
pub fn percent(value: f64) -> String { format!("{:.0}", 100.0 * value) }

// Stability: what the displacements do not control.

/// `inf_sup`: scaled by the length of segments over the modulus, so that one limit is good for every mesh and material: below it
/// the displacements do not control λ, which is wrong by 30 % up to any factor.
pub static INF_SUP: Limit = least((0.1, three, Stability, "the inf-sup constant is too small",
    "inf-sup constant {value}{segment}, at least {limit} wanted"));

/// `oscillation`: the alternating part of λ: a pressure with more of it is none. It tells where no inf-sup constant is computed.
pub static OSCILLATION: Limit = most((0.05, three, Stability, "the pressure oscillates",
    "oscillation {value}{segment}, at most {limit} wanted"));

// Zones. The limits of `whole` and `peak` were chosen on the 200 scenes of `ci/scenes`, of which 193 are sure enough: lines and
// arcs, gaps with up to three humps, E from 1:1000 to 1000:1, edges from 1:20 to 20:1, all pairs of spaces, `refine` 1 to 3,
// against solutions on much finer meshes. Of the 15 good pressures that are not trusted most are so for their `peak` or for
// `whole`. `whole` by the true error: of 86 runs 72 are within 0.5 to 3, three below 0.3.

/// `zones[].edges`: on 3 edges peaks were 6 to 79 % off, unless the estimate proves the pressure good.
pub static EDGES: Limit = least((4.0, one, Finer, "contact is narrower than four edges",
    "contact{place} {value} edges wide, at least {limit} wanted"));

/// `zones[].segments`: on fewer segments, too, the pressure of a zone is off by tens of per cent, unless the estimate proves it
/// good.
pub static SEGMENTS: Limit = least((4.0, whole, MoreSegments, "contact lies on fewer than four segments",
    "contact{place} on {value} segments, at least {limit} wanted"));

/// `zones[].lambda`: λ in the middle of a zone, root mean square.
pub static MIDDLE: Limit = most((0.08, two, Finer, "λ is too inexact",
    "estimated error of λ{place} {value}, at most {limit} wanted"));

const ALL_OVER_CAUSE: &str = "λ is too inexact up to the ends of contact";
const ALL_OVER_WORDS: &str = "estimated error of λ up to the ends of contact{place} {value}, at most {limit} wanted";

/// `zones[].whole`: λ all over a zone: where it falls to zero it is steep.
pub static ALL_OVER: Limit = most((0.06, two, Finer, ALL_OVER_CAUSE, ALL_OVER_WORDS));

/// `zones[].whole`: steps (`p0`) miss what is steep by more than their means do.
pub static STEPS_ALL_OVER: Limit = most((0.12, two, Finer, ALL_OVER_CAUSE, ALL_OVER_WORDS));

/// `zones[].peak`: the largest λ of a zone.
pub static PEAK: Limit = most((0.12, two, Finer, "the largest λ is too inexact",
    "estimated error of the largest λ{place} {value}, at most {limit} wanted"));

/// `zones[].peak` where `peak_at_end`, but for P0: that of `whole`, which leaves the ends of Γ_C out.
pub static PEAK_AT_END: Limit = most((ALL_OVER.value, two, Finer, "the largest λ is too inexact",
    "estimated error of the largest λ, at an end of Γ_C{place}, {value}, at most {limit} wanted"));

/// `zones[].force`: the force of a zone.
pub static ZONE_FORCE: Limit = most((0.08, two, Finer, "the force is too inexact",
    "estimated error of the force{place} {value}, at most {limit} wanted"));

/// Share of the force of a contact from which that of a zone is judged.
pub const LEAST_FORCE_SHARE: f64 = 0.05;

/// The largest sign of an error that proves a pressure good; on one or two segments all may be small beside the error, unless
/// they are next to nothing, as where the pressure is even.
pub const PROVES: f64 = 0.05;
pub const NEXT_TO_NOTHING: f64 = 1e-3;

/// From this error on λ may grow at a corner as it does towards a singular end.
pub const GROWS_AT_CORNERS: f64 = 5e-3;

/// `missing`: force, relative to that found, that overlaps of the bodies beside the zones may ask for; where nothing presses, the
/// largest overlap relative to the displacements, ten times what a solve leaves (`LEFT`).
pub static OVERLAP: Limit = most((0.1, two, MoreSegments, "the bodies overlap where no segment presses",
    "the bodies overlap where no segment presses"));
pub const OVERLAP_ALONE: f64 = 1e-5;

/// `missing_beyond`: force, relative to that found, that overlaps all beyond the contact boundary may be worth: what presses there is
/// lost, a third to a half of that (3.4 % of the force for 8.3 beside a clamp, 5.4 for 15 on a leaf spring).
pub static OVERLAP_BEYOND: Limit = most((0.01, two_digits, Words("take ends = \"fixed\""),
    "the bodies overlap beyond the contact boundary",
    "the bodies overlap beyond the contact boundary by what is worth {value} of its force, at most {bound} wanted"));

/// `unresolved_force`: share of the force that penetration within single segments may be worth: more is contact narrower than
/// they are.
pub static WITHIN_SEGMENTS: Limit = most((DOUBTED_WITHIN_SEGMENTS, two, MoreSegments, "the bodies penetrate each other within segments",
    "the bodies penetrate each other within segments{worth}"));

/// `zones[].cut_off`: λ where a zone is cut off, by its largest.
pub static CUT_OFF: Limit = most((CUT, two,
    Words("name what lies beyond in this contact, too, if it goes on as the same line or circle, or else give it a name and a contact of its own that begins there"),
    "contact goes on beyond the end of its boundary",
    "it presses up to an end of its boundary, with {value} of its largest λ there, and both bodies go on beyond"));

/// `cut_at_joint`: λ where another contact goes on smoothly, and one of both presses alone, by its largest: as of `zones[].cut_off`.
pub static CUT_AT_JOINT: Limit = most((CUT, two, Words("draw shorter edges on both sides of where the two meet"), "it and the contact that goes on from it do not both press where they meet",
    "of it and the contact that goes on from it one alone presses where they meet, with {value} of its largest λ"));

// The whole solution.

/// `estimate.energy`: beyond it a solution is too far from that of the bodies for its pressure to be theirs.
pub static ENERGY: Limit = most((0.3, two, Finer, "the error in the energy norm is too large",
    "estimated error in the energy norm {value}, at most {limit} wanted"));

/// `estimate.NAME.force`: the force of a contact, if its pressure is to be trusted; and if the force itself is.
pub static FORCE: Limit = most((0.08, two, Finer, "the whole force is too inexact",
    "estimated error of the whole force {value}, at most {limit} wanted"));
pub const TRUSTED_FORCE: f64 = 0.01;

/// The same where a zone lies on one or two segments: a disc squeezed by 5 % between rigid plates had two on the mesh before, too, and a
/// force 2.8e-2 off where 5.5e-3 was estimated. What statics decides is known far better.
pub const TRUSTED_FORCE_ON_FEW: f64 = TRUSTED_FORCE / 5.0;

/// `corner_error`: corners of a body within what presses, by what they do to λ.
pub static CORNERS: Limit = most((0.04, short,
    Words("give the curve by a [geometry] if these are chords of one, or, if the corners are meant, name the pieces between them, each with a contact of its own"),
    "a body has corners within the contact",
    "\"{first}\" or \"{second}\" has corners of up to {angle} degrees within the contact, which change λ by about {value}"));

/// `shape_error`: what the nodes of a boundary without a declared shape leave unknown of it, by what that does to λ. On Hertz contacts with
/// coordinates of six digits .13 and .031 where λ was up to .29 and .065 off, 1e-9 with sixteen; on a rounded punch whose flat and arcs
/// are one curve .29, and .017 with chords a fifth as long, where the largest λ was .13 and .012 off. Where nothing presses, the force that
/// may, as a share of the largest: 1.2 on a tooth that carries a quarter of all on a finer mesh.
pub static SHAPE: Limit = most((0.04, short,
    Words("give the shape by a [geometry], write the mesh with all digits of its coordinates, or give lines and arcs that go on as each other a name and a contact each, or finer edges where they meet"),
    "the nodes tell too little of a boundary's shape",
    "the nodes of \"{first}\" or \"{second}\" scatter or are too few, or the curvature jumps between them: {wrong}, at most {limit} wanted"));

/// `balance.bodies`: all forces on a body, as a share of their magnitudes; and the share beyond which there is no result.
pub static BODY_BALANCE: Limit = most((0.01, two_digits, Words("take a smaller solver.tolerance, or correct what holds the bodies"),
    "the forces on a body are out of balance", "the forces on a body are out of balance by {value}, at most {bound} wanted"));
pub const OUT_OF_BALANCE: f64 = 0.1;

/// `balance.force`: the forces of a contact on its two bodies: the pressure is off by their difference at least.
pub static SIDE_BALANCE: Limit = most((0.01, two_digits,
    Words("give what does face the other body all along a name and a contact of its own"),
    "forces on the two bodies differ", "forces on the two bodies differ by {value}, at most {bound} wanted"));

/// Strain energy, by that of the softest body strained by the largest displacement over its length, below which bodies have moved
/// and not strained: what is left there is rounding.
pub const NOT_STRAINED: f64 = 1e-12;

/// `solver.residual`: of a linear solve that no estimate has stopped: forces were off by up to 5 % at ten times as much.
pub static RESIDUAL: Limit = most((1e-4, short, Words("take a smaller solver.tolerance, or \"discretisation\""),
    "the linear solve has stopped early", "the linear solve has stopped at a residual of {value}, at most {limit} wanted"));

// Motions and strains beyond the model.

/// Sliding by less than this share of the length in contact changes no normal.
pub const LITTLE_SLIP: f64 = 0.02;

/// `slip_error`: error of force or pressure by sliding along a curve.
pub static SLIP: Limit = most((0.01, two_digits, Words("take configuration = \"deformed\""),
    "the bodies slide too far along each other",
    "the bodies slide along each other by {slip} of the length in contact: force or pressure wrong by about {value} (relative), at most {bound} wanted"));

const SLIDING_CAUSE: &str = "sliding changes what the bodies have in common";
const AFTER_SLIDING: &str = "draw the bodies as they lie after sliding, or take curve = \"fit\" with configuration = \"deformed\"";

/// `lost_at_ends`: share of the length in contact that bodies lose by sliding at their ends, or of the force that passes to a contact
/// beside it: the force is off by about as much.
pub static LOST_AT_ENDS: Limit = most((0.02, two_digits, Words(AFTER_SLIDING), SLIDING_CAUSE,
    "sliding takes {value} of the contact from what the bodies have in common, or to the contact beside it, at most {bound} wanted: force or pressure wrong by about as much"));

/// `slip_at_ends`: share by which one body slides along another that goes on: the force stays, the pressure on that one lies
/// elsewhere.
pub static SLIP_AT_ENDS: Limit = most((0.1, two_digits, Words(AFTER_SLIDING), SLIDING_CAUSE,
    "one body slides along the other by {value} times the length in contact, at most {bound} times wanted: the pressure lies elsewhere"));

/// `slant`: angle between Γ_C and the side on which a corner of the other one presses: the force acts along the normal of that side. With a
/// curve half-way between sides at 3 degrees the part along it was 2.6 instead of 5.2 (5.1 on deformed bodies).
pub static SLANT: Limit = most((0.01, two_digits,
    Words("take as curve the side that goes on beyond the corner, as in curve = \"BODY.SIDE\", or curve = \"fit\" with configuration = \"deformed\""),
    "a corner presses askew to the contact boundary",
    "a corner presses on a side that lies at an angle of {value} to the contact boundary, at most {bound} wanted: the direction of the force is off by that"));

/// `direction_error`: a body that rolls or slides turns the direction of what presses on it, and what else holds it takes the difference. A
/// rocker that is pushed onto a wall with a fiftieth of its load, and turned by .03, .015 and .007 by that load off its centre: 3.1 for
/// errors of the wall's force of .75, .41 and .21 of itself.
pub static DIRECTION: Limit = most((0.01, two_digits, Words("take curve = \"fit\" with configuration = \"deformed\" in all contacts of these bodies, or draw them as they lie"),
    "forces turn with the bodies",
    "the bodies roll, slide or turn, and forces on them with them: this one wrong by about {value} (relative), at most {bound} wanted"));

/// `held_force`: change of the force if contact carried what a mean motion is held against, by the force. A roller in a groove whose `ux`
/// was held, too, pressed its flanks with 222 each under a load that takes 155 and 289, which this tells: .300.
pub static HELD_FORCE: Limit = most((TRUSTED_FORCE, two_digits,
    Words("hold of these bodies no more than `mezha check` proposes without that support"),
    "a held mean motion carries what contact could",
    "a mean motion is held against what contact could carry, which changes its force by {value}, at most {bound} wanted"));

const TURNING_CAUSE: &str = "the bodies turn too far";
const TURN_LESS: &str = "the theory is that of small rotations: draw the bodies as they lie after turning, and turn them by less";

/// `rotation_error`: error of force or pressure by turning.
pub static TURNING: Limit = most((0.01, two_digits, Words(TURN_LESS), TURNING_CAUSE,
    "the bodies turn: force or pressure wrong by about {value} (relative), at most {bound} wanted"));

/// `rotation_error`: growth of bodies that turn, by the smallest gap of a contact where nothing presses: half of it is closed by
/// a growth that is none.
pub static GROWTH: Limit = most((0.5, short, Words(TURN_LESS), TURNING_CAUSE,
    "nothing presses, but bodies that turn grow in this theory, by {value} times the smallest gap"));

/// `rotation_max`: largest rotation in a body (radians): forces and lengths are off by half its square, here 2 %. A strip bent over a drum
/// whose ends turned by .54 had a pressure 22 % off, and no mean rotation.
pub static ROTATION: Limit = most((0.2, two, Words(TURN_LESS), "a body turns too far",
    "body {of} turns by {value}, at most {limit} wanted"));

/// `strain_max`: mean strain of a macro triangle: products of strains, which the theory leaves out, are a fifth of what it has;
/// and the strain from which a warning comes, as they are more than pressures are computed to.
pub static STRAIN: Limit = most((0.2, percent,
    Words("press less, or correct the units of E, loads and displacements: the model is that of small strain"),
    "a body is strained too much", "body {of} strained by {value} %, at most {most} % wanted"));
pub const SMALL_STRAIN: f64 = 0.05;

/// ν of P1 triangles: Poisson's ratio in the plane of P1 triangles, whose error grows like (1 - 2ν)^-½: on rings λ was off by 2 %
/// at 0.49, by 16 % at 0.499. From `P1_STIFF` on a warning comes, and P1 counts as the cause of what is unstable.
pub static P1_LOCKS: Limit = most((0.495, short, Words("take mesh.order = 2: P1 triangles lock"),
    "P1 triangles lock", "body {of} has ν = {poisson} with P1 triangles, at most {limit} wanted"));
pub const P1_STIFF: f64 = 0.45;

// What is no result, whatever its residual says.

/// Overlap of bodies between which nothing presses, relative to the displacements.
pub const PASSED_THROUGH: f64 = 0.05;

// What is not resolved.

/// Relative error of a force by turning and sliding of its bodies. What is estimated is .55 to 1.5 times the true error
/// (`tests/turning.rs`); a pile that cannot stand stood with .55, since turned discs are larger ones.
pub const FORCE_OFF: f64 = 0.5;

// What the largest von Mises stress of a body is worth.

/// Share by which it may differ from that of the refinement before: of P2 a third of that is left, of P1 all of it.
pub const STRESS_APART: f64 = 0.05;

/// Share of the largest of all bodies below which it is next to nothing.
pub const STRESS_COUNTS: f64 = 1e-6;

// What is warned of.

/// A support at a point that carries more than this share of all forces changes displacements by what shows.
pub const LITTLE_FORCE: f64 = 1e-4;

/// Angles that are smaller make a sliver (degrees); slivers are told from this share of all triangles on.
pub const SLIVER: f64 = 10.0;
pub const MANY_SLIVERS: f64 = 0.1;

/// Share of a segment, and with a formula of the drawn distance too, by which a declared gap may differ from the drawn one.
pub const GAP_OFF: f64 = 0.1;
pub const FORMULA_OFF: f64 = 0.25;
