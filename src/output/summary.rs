//! `summary.json`: the numbers of a run, for people and for other tools.
//!
//! The names of the fields are the keys of the file. `None` is written as `null`, and so is every number that is not finite:
//! what does not apply, or was not reached, never shows as a made-up number.

use crate::contact::zone_counts;
mod accuracy;
mod passes;
mod provenance;
mod steps;
mod thickness;
mod told;

pub use accuracy::{AccuracyStep, ContactGoals, Cycles, GoalSummary, ProbeGoals};
pub use provenance::Provenance;
pub use steps::{StepContact, StepSummary};
pub use told::{MOST_TOLD, MOST_WITH_FIGURES, WORST, listed};

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use serde::{Deserialize, Deserializer, Serialize};

use super::OutputError;

/// The summary of a run. Start from [`Summary::new`] and fill in what is known.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// Version of mezha.
    pub mezha: String,
    /// Name of the case.
    pub case: String,
    /// Verdict.
    pub status: Status,
    /// The verdict in words.
    pub reason: Option<String>,
    /// Number of ranks.
    pub ranks: usize,
    /// What made the result, and of what; null in results of older versions.
    #[serde(default)]
    pub provenance: Option<Provenance>,
    /// Names of all files of the result, relative to its folder, sorted: a run that replaces it removes these and no others.
    #[serde(default)]
    pub files: Vec<String>,
    /// The mesh after refinement.
    pub mesh: Mesh,
    /// Sizes of the linear system.
    pub unknowns: Unknowns,
    /// One entry per outer iteration.
    pub outer: Vec<OuterIteration>,
    /// One entry per contact boundary, where some follow the solution; otherwise empty.
    pub boundaries: Vec<BoundaryIteration>,
    /// By name of the contact.
    pub contact: BTreeMap<String, ContactSummary>,
    /// By name of the rigid tool, or of the load that stays rigid.
    pub rigid: BTreeMap<String, RigidSummary>,
    /// By name of the support.
    #[serde(default)]
    pub support: BTreeMap<String, SupportSummary>,
    /// Energies of the solution.
    pub energy: Energy,
    /// Largest displacement of a node (length).
    #[serde(default)]
    pub displacement_max: Option<f64>,
    /// Largest strain by name of the body: the mean of the larger principal strain over a macro triangle.
    #[serde(default)]
    pub strain_max: BTreeMap<String, Option<f64>>,
    /// Mean rotation by name of the body, anticlockwise (radians).
    #[serde(default)]
    pub rotation: BTreeMap<String, Option<f64>>,
    /// Estimated discretisation errors.
    pub estimate: EstimateSummary,
    /// Relative residuals of force, moment and energy balance.
    pub balance: BalanceSummary,
    /// By name of the probe.
    pub probe: BTreeMap<String, ProbeSummary>,
    /// The linear solver.
    pub solver: SolverSummary,
    /// Wall time of the stages in seconds, slowest rank.
    pub time_s: Time,
    /// Memory in MiB.
    pub memory_mib: Memory,
    /// Relative errors against exact or reference values: `energy`, `force_CONTACT`, `lambda_CONTACT`, `displacement_BODY`,
    /// `energy_norm_BODY`, `u_BODY`.
    pub errors: BTreeMap<String, Option<f64>>,
    /// One entry per mesh that was adapted to an accuracy, the last one is that of the result; the key is missing if no accuracy
    /// was asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub accuracy: Option<Vec<AccuracyStep>>,
    /// One entry per load step; everything else is that of the last one. The key is missing if the case has no steps.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub steps: Option<Vec<StepSummary>>,
}

/// Verdict of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Status {
    /// The result can be used.
    Converged,
    /// It cannot; see the reason.
    #[default]
    NotConverged,
    /// It is solved on a mesh, or contact boundaries, that cannot hold what the case says; see the reason.
    Unresolved,
    /// There is none: a signal has ended the run before. What was reached is told, and nothing else.
    Interrupted,
}

/// The mesh after refinement.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Mesh {
    /// Number of triangles.
    pub triangles: Option<u64>,
    /// Number of vertices, without midside nodes.
    pub vertices: Option<u64>,
    /// Polynomial degree of the displacement, 1 or 2.
    pub order: Option<u8>,
    /// Shortest edge (length).
    pub h_min: Option<f64>,
    /// Longest edge (length).
    pub h_max: Option<f64>,
}

/// Sizes of the linear system.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Unknowns {
    /// Displacement components.
    pub displacement: Option<u64>,
    /// Contact pressures.
    pub multiplier: Option<u64>,
}

/// A coarser mesh that was solved first.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct CoarseSolveSummary {
    /// Refinements of the macro mesh.
    pub refine: usize,
    /// Displacement unknowns.
    pub unknowns: usize,
    /// One number per linear solve.
    pub iterations: Vec<usize>,
}

/// One outer iteration.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct OuterIteration {
    /// Number, from 1.
    pub iteration: usize,
    /// Number of the contact boundary it was made on, from 1.
    pub boundary: usize,
    /// Active multipliers.
    pub active: Option<usize>,
    /// Multipliers that became active.
    pub added: Option<usize>,
    /// Multipliers that became inactive.
    pub released: Option<usize>,
    /// Krylov iterations of its linear solves.
    pub krylov_iterations: Option<usize>,
    /// Relative residual.
    pub residual: Option<f64>,
    /// Largest penetration (length).
    pub max_penetration: Option<f64>,
    /// Relative change of the displacement.
    pub du: Option<f64>,
}

/// One contact boundary of those that followed the solution.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct BoundaryIteration {
    /// Number, from 1.
    pub iteration: usize,
    /// Its length.
    pub length: Option<f64>,
    /// Largest way of a segment end to the next boundary, relative to the length; null if the segments are others.
    pub moved: Option<f64>,
    /// Relative change of the displacement since the boundary before.
    pub du: Option<f64>,
    /// Multipliers that changed state since the boundary before.
    pub flipped: Option<usize>,
}

/// One contact.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ContactSummary {
    /// Length of the contact boundary.
    pub length: Option<f64>,
    /// Number of its segments.
    pub segments: Option<usize>,
    /// Multiplier space, as in the case: `p0`, `p1-discontinuous`, `p1-continuous`.
    pub multiplier: Option<String>,
    /// Length of the shortest segment, in edges of the softer body.
    pub h_ratio: Option<f64>,
    /// Inf-sup constant.
    pub inf_sup: Option<f64>,
    /// The two ends of the contact boundary.
    pub ends: Option<[[f64; 2]; 2]>,
    /// Intervals of arc length in contact.
    pub closed: Option<Vec<[f64; 2]>>,
    /// Number of edges of the softer body on that interval of `closed` that has most of them.
    pub closed_edges: Option<f64>,
    /// The ends of the intervals of `closed` as points in the plane.
    pub closed_points: Option<Vec<[[f64; 2]; 2]>>,
    /// ∫ λ ds (force per thickness).
    pub force: Option<f64>,
    /// Force that penetration within single segments is worth (force per thickness).
    pub unresolved_force: Option<f64>,
    /// Resultant on body 2 (force per thickness).
    #[serde(deserialize_with = "numbers")]
    pub resultant: Option<[f64; 2]>,
    /// Where it acts: the centre of the pressure; where nothing presses, the point with the smallest gap.
    #[serde(default, deserialize_with = "numbers")]
    pub place: Option<[f64; 2]>,
    /// Moment on body 2 about the origin.
    pub moment: Option<f64>,
    /// Largest contact pressure.
    pub pressure_max: Option<f64>,
    /// Oscillation figure of the contact pressure.
    pub oscillation: Option<f64>,
    /// Quadrature points without a corresponding point.
    pub lost_points: Option<usize>,
    /// Way of the bodies along each other, by the length that presses; of curved fits on undeformed bodies only.
    pub slip: Option<f64>,
    /// The same at an end of the contact boundary where the bodies press and one of them ends, in all contacts of undeformed
    /// bodies.
    pub slip_at_ends: Option<f64>,
    /// What sliding there, or towards an end, takes from the length that the bodies have in common.
    pub lost_at_ends: Option<f64>,
    /// Estimated relative error of force or pressure by that way, and by the turning of the bodies.
    pub slip_error: Option<f64>,
    /// The same by their turning alone, in all contacts; where nothing presses, the growth of what turns by the smallest gap.
    pub rotation_error: Option<f64>,
    /// Sharpest corner of a body within what presses, in degrees; of fitted curves only.
    pub corner_angle: Option<f64>,
    /// Estimated relative error of λ by that corner.
    pub corner_error: Option<f64>,
    /// Intervals of arc length that press, each with what is estimated of it.
    pub zones: Vec<ZoneSummary>,
    /// Force that is missing because the bodies overlap where no segment presses, relative to `force`; where nothing presses,
    /// the largest overlap relative to the largest displacement.
    pub missing: Option<f64>,
    /// The same as a force (force per thickness), on undeformed bodies.
    #[serde(default)]
    pub missing_force: Option<f64>,
    /// Deepest place of one body in the other, by their whole sides (length).
    #[serde(default)]
    pub depth: Option<f64>,
    /// Where that is.
    #[serde(default)]
    pub deepest: Option<[f64; 2]>,
    /// How far the sides have come together since they touched first, or have parted that were drawn in each other (length).
    #[serde(default)]
    pub approach: Option<f64>,
    /// Whether the contact pressure can be trusted; null if nothing tells, or if the corner of a body presses on too
    /// few edges: the reason says which.
    pub trust: Option<bool>,
    /// Whether ∫ λ ds can be trusted to one per cent; null if nothing estimates it.
    pub trust_force: Option<bool>,
    /// The verdict on it in a few words: `trusted`, why not, or that it only touches.
    #[serde(default)]
    pub verdict: Option<String>,
}

impl ContactSummary {
    /// Length of all intervals in contact.
    pub fn width(&self) -> Option<f64> {
        self.closed.as_ref().map(|intervals| intervals.iter().fold(0.0, |sum, [first, last]| sum + last - first))
    }
}

/// An interval of a contact that presses.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ZoneSummary {
    /// Arc lengths of its ends.
    pub ends: Option<[f64; 2]>,
    /// Edges of the softer body on it.
    pub edges: Option<f64>,
    /// Segments on it.
    pub segments: Option<usize>,
    /// Its share of the force.
    pub share: Option<f64>,
    /// Width that its force asks for between smooth convex sides (length); null elsewhere.
    #[serde(default)]
    pub hertz_width: Option<f64>,
    /// Largest contact pressure.
    pub pressure_max: Option<f64>,
    /// Estimated relative error of λ in its middle, root mean square.
    pub lambda: Option<f64>,
    /// The same all over it, without the tenth beside an end of the contact boundary.
    pub whole: Option<f64>,
    /// The largest of all signs of an error of λ; where it is small, so is the error.
    pub worst: Option<f64>,
    /// Estimated relative error of its force.
    pub force: Option<f64>,
    /// Estimated relative error of its largest pressure; null where that is singular.
    pub peak: Option<f64>,
    /// Whether λ grows without bound towards an end of the contact boundary, as far as can be seen.
    pub singular: Option<bool>,
    /// Whether it lies at an end of the contact boundary where one body has a corner and the other goes on.
    pub corner: Option<bool>,
}

impl ZoneSummary {
    /// Whether anyone would look at it, among `all` of its contact.
    pub fn counts(&self, all: &[Self]) -> bool {
        let highest = all.iter().filter_map(|zone| zone.pressure_max).fold(0.0, f64::max);
        self.share.is_none_or(|share| zone_counts(share, self.pressure_max.unwrap_or(f64::NAN), highest))
    }
}

/// A rigid tool, or a boundary that stays rigid.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RigidSummary {
    /// Shift of the reference point (length), and turn about it (radians).
    pub motion: Option<[f64; 3]>,
    /// The reference point.
    pub about: Option<[f64; 2]>,
    /// Force on the bodies (per thickness).
    pub force: Option<[f64; 2]>,
    /// Its moment about the reference point.
    pub moment: Option<f64>,
}

/// One support.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SupportSummary {
    /// Its force on the bodies (per thickness).
    #[serde(deserialize_with = "numbers")]
    pub reaction: Option<[f64; 2]>,
    /// Its moment about the middle of the body, where it holds a mean motion.
    #[serde(default)]
    pub moment: Option<f64>,
}

/// Energies per thickness.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Energy {
    /// Strain energy by name of the body.
    pub strain: BTreeMap<String, Option<f64>>,
    /// The same by name of the part, of bodies with parts; the key is missing if there are none.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub parts: BTreeMap<String, Option<f64>>,
    /// Total strain energy U.
    pub total: Option<f64>,
    /// U from the stationary value of the Lagrangian, of second order in the algebraic error; not in all scenes.
    pub stationary: Option<f64>,
    /// Energy in elastic supports, ½∫k u²; null without any.
    #[serde(default)]
    pub springs: Option<f64>,
    /// f·u + r·u_D, without the factor one half.
    pub external_work: Option<f64>,
}

/// Estimated discretisation errors.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct EstimateSummary {
    /// Relative error in the energy norm.
    pub energy: Option<f64>,
    /// By name of the contact, on the same level of the file as `energy`.
    #[serde(flatten)]
    pub contact: BTreeMap<String, ContactEstimate>,
}

/// Estimated relative errors of a contact.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ContactEstimate {
    /// Of ∫ λ ds.
    pub force: Option<f64>,
    /// Of λ in the middle of its worst zone, root mean square.
    pub lambda: Option<f64>,
    /// Of the largest λ; null where that is singular.
    pub peak: Option<f64>,
}

/// Relative residuals of the balances.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct BalanceSummary {
    /// Of the contact forces on both bodies.
    pub force: Option<f64>,
    /// Of the contact moments on both bodies.
    pub moment: Option<f64>,
    /// Of twice the strain energy and the work done.
    pub energy: Option<f64>,
    /// Largest sum of loads, reactions and contact forces on a body, over the sum of their magnitudes.
    pub bodies: Option<f64>,
}

/// The solution at a point.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ProbeSummary {
    /// The point, undeformed.
    #[serde(deserialize_with = "numbers")]
    pub x: Option<[f64; 2]>,
    /// Displacement.
    #[serde(deserialize_with = "numbers")]
    pub u: Option<[f64; 2]>,
    /// Stress xx, yy, xy.
    #[serde(deserialize_with = "numbers")]
    pub stress: Option<[f64; 3]>,
}

/// The linear solver.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SolverSummary {
    /// `fieldsplit` or `direct`.
    pub name: Option<String>,
    /// What solved it, in words, such as `fieldsplit (multigrid F-cycle)`.
    pub krylov: Option<String>,
    /// One number per linear solve.
    pub iterations: Vec<usize>,
    /// Solves on coarser meshes before, the coarsest first.
    pub coarse: Vec<CoarseSolveSummary>,
    /// Iterations on all meshes, each by its unknowns, in iterations on the last one.
    #[serde(default)]
    pub cycles: Option<f64>,
    /// Relative residual of the scaled augmented system.
    pub residual: Option<f64>,
    /// Relative residual of the system as it stands.
    pub plain_residual: Option<f64>,
    /// The BLAS in use.
    pub blas: Option<String>,
}

/// Wall time in seconds, slowest rank.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Time {
    /// Reading, partition, refinement.
    pub mesh: Option<f64>,
    /// Stiffness and loads.
    pub assemble: Option<f64>,
    /// Contact boundary and coupling.
    pub contact: Option<f64>,
    /// Setting up the solver.
    pub setup: Option<f64>,
    /// Linear solves.
    pub solve: Option<f64>,
    /// Writing the result.
    pub output: Option<f64>,
    /// From the start of the program to its end.
    pub total: Option<f64>,
}

/// Largest resident memory in MiB.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Memory {
    /// Of the rank that uses most.
    pub max_rank: Option<f64>,
    /// Of all ranks together.
    pub sum: Option<f64>,
}

impl Summary {
    /// An empty summary of this version of mezha: not converged, nothing known.
    pub fn new(case: &str, ranks: usize) -> Summary {
        Summary { mezha: env!("CARGO_PKG_VERSION").into(), case: case.into(), ranks, ..Summary::default() }
    }

    /// Writes `summary.json`, indented.
    ///
    /// # Errors
    /// The operating system refuses.
    pub fn write(&self, path: &Path) -> Result<(), OutputError> {
        serde_json::to_string_pretty(self)
            .map_err(std::io::Error::from)
            .and_then(|text| fs::write(path, text + "\n"))
            .map_err(OutputError::io("write", path))
    }

    /// Reads a `summary.json` back; numbers that are null inside a vector become NaN.
    ///
    /// # Errors
    /// The file cannot be read, or is no summary.
    pub fn read(path: &Path) -> Result<Summary, OutputError> {
        fs::read_to_string(path)
            .and_then(|text| serde_json::from_str(&text).map_err(std::io::Error::from))
            .map_err(OutputError::io("read", path))
    }
}

/// Reads a vector whose numbers may be null.
fn numbers<'de, D, const N: usize>(source: D) -> Result<Option<[f64; N]>, D::Error>
where
    D: Deserializer<'de>,
    [Option<f64>; N]: Deserialize<'de>,
{
    let vector = Option::<[Option<f64>; N]>::deserialize(source)?;
    Ok(vector.map(|vector| vector.map(|number| number.unwrap_or(f64::NAN))))
}

#[cfg(test)]
mod tests;
