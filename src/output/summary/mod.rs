//! `summary.json`: the numbers of a run, for people and for other tools.
//!
//! The names of the fields are the keys of the file. `None` is written as `null`, and so is every number that is not finite:
//! what does not apply, or was not reached, never shows as a made-up number.

mod accuracy;
mod body;
mod contact;
mod provenance;
mod steps;
mod told;

pub use accuracy::{AccuracyStep, Cycles, GoalSummary};
pub use body::BodySummary;
pub use contact::{ContactEstimate, ContactSummary, ContactTrust, ZoneSummary};
pub use provenance::{Provenance, machine, whole_machine};
pub use steps::{StepContact, StepSummary};
pub use told::{MOST_TOLD, MOST_WITH_FIGURES, WORST, alike, capital, clauses, lines_alike, listed};

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use serde::Serialize;
use serde_json::Value;

use crate::output::error::OutputError;
use crate::output::units::Units;
use crate::procedure::{BoundaryStep, CoarseSolve, Pass};

/// The file that makes a folder a result.
pub const SUMMARY: &str = "summary.json";

/// The summary of the result in a folder; null if there is none that can be read.
pub fn read_summary(folder: &Path) -> Value {
    fs::read(folder.join(SUMMARY)).ok().and_then(|text| serde_json::from_slice(&text).ok()).unwrap_or_default()
}

/// The summary of a run. Start from [`Summary::new`] and fill in what is known.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
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
    /// What made the result, and of what.
    pub provenance: Option<Provenance>,
    /// Names of all files of the result, relative to its folder, sorted: a run that replaces it removes these and no others.
    pub files: Vec<String>,
    /// `axisymmetric` if bodies are of revolution: forces, energies and resultants are then those of whole bodies, not per
    /// thickness. The key is missing in the plane.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub plane: Option<String>,
    /// The units that the case names; the key is missing if it names none.
    #[serde(skip_serializing_if = "Units::is_none")]
    pub units: Units,
    /// The mesh after refinement.
    pub mesh: Mesh,
    /// Sizes of the linear system.
    pub unknowns: Unknowns,
    /// One entry per outer iteration.
    pub outer: Vec<Pass>,
    /// One entry per contact boundary, where some follow the solution; otherwise empty.
    pub boundaries: Vec<BoundaryStep>,
    /// By name of the contact.
    pub contact: BTreeMap<String, ContactSummary>,
    /// The largest stress by name of the body, of those that are no rigid tools.
    pub body: BTreeMap<String, BodySummary>,
    /// By name of the rigid tool, or of the load that stays rigid.
    pub rigid: BTreeMap<String, RigidSummary>,
    /// By name of the support.
    pub support: BTreeMap<String, SupportSummary>,
    /// Energies of the solution.
    pub energy: Energy,
    /// Largest displacement of a node (length).
    pub displacement_max: Option<f64>,
    /// By how much heat would let the bodies grow (length).
    #[serde(skip)]
    pub growth: f64,
    /// Largest strain by name of the body: the mean of the larger principal strain over a macro triangle.
    pub strain_max: BTreeMap<String, Option<f64>>,
    /// Mean rotation by name of the body, anticlockwise (radians).
    pub rotation: BTreeMap<String, Option<f64>>,
    /// Largest rotation by magnitude by name of the body: the mean over a macro triangle (radians).
    pub rotation_max: BTreeMap<String, Option<f64>>,
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
    #[serde(skip_serializing_if = "Option::is_none")]
    pub accuracy: Option<Vec<AccuracyStep>>,
    /// One entry per load step; everything else is that of the last one. The key is missing if the case has no steps.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub steps: Option<Vec<StepSummary>>,
}

/// Verdict of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
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
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
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
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Unknowns {
    /// Displacement components.
    pub displacement: Option<u64>,
    /// Contact pressures.
    pub multiplier: Option<u64>,
}

/// A rigid tool, or a boundary that stays rigid.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
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
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct SupportSummary {
    /// Its force on the bodies (per thickness).
    pub reaction: Option<[f64; 2]>,
    /// Its moment about the middle of the body, where it holds a mean motion.
    pub moment: Option<f64>,
}

/// Energies per thickness.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Energy {
    /// Strain energy by name of the body.
    pub strain: BTreeMap<String, Option<f64>>,
    /// The same by name of the part, of bodies with parts; the key is missing if there are none.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub parts: BTreeMap<String, Option<f64>>,
    /// Total strain energy U.
    pub total: Option<f64>,
    /// U from the stationary value of the Lagrangian, of second order in the algebraic error; not in all scenes.
    pub stationary: Option<f64>,
    /// Energy in elastic supports, ½∫k u²; null without any.
    pub springs: Option<f64>,
    /// f·u + r·u_D, without the factor one half.
    pub external_work: Option<f64>,
}

/// Estimated discretisation errors.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct EstimateSummary {
    /// Relative error in the energy norm.
    pub energy: Option<f64>,
    /// By name of the contact, on the same level of the file as `energy`.
    #[serde(flatten)]
    pub contact: BTreeMap<String, ContactEstimate>,
}

/// Relative residuals of the balances.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
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
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct ProbeSummary {
    /// The point, undeformed.
    pub x: Option<[f64; 2]>,
    /// Displacement.
    pub u: Option<[f64; 2]>,
    /// Stress xx, yy, xy.
    pub stress: Option<[f64; 3]>,
    /// Hoop stress; the key is missing in the plane.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hoop: Option<f64>,
}

/// The linear solver.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct SolverSummary {
    /// `fieldsplit` or `direct`.
    pub name: Option<String>,
    /// What solved it, in words, such as `fieldsplit (multigrid F-cycle)`.
    pub krylov: Option<String>,
    /// One number per linear solve.
    pub iterations: Vec<usize>,
    /// Solves on coarser meshes before, the coarsest first.
    pub coarse: Vec<CoarseSolve>,
    /// Iterations on all meshes, each by its unknowns, in iterations on the last one.
    pub cycles: Option<f64>,
    /// Relative residual of the scaled augmented system.
    pub residual: Option<f64>,
    /// Relative residual of the system as it stands.
    pub plain_residual: Option<f64>,
    /// The BLAS in use.
    pub blas: Option<String>,
}

/// Wall time in seconds, slowest rank.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
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
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
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
            .map_err(OutputError::unwritten(path))
    }

    /// Multiplies everything that is a force, a moment or an energy by a thickness.
    pub fn times_thickness(&mut self, thickness: f64) {
        let scale = |value: &mut Option<f64>| *value = value.map(|value| thickness * value);
        let scale_both = |value: &mut Option<[f64; 2]>| *value = value.map(|value| value.map(|one| thickness * one));
        for contact in self.contact.values_mut() {
            let forces = [&mut contact.force, &mut contact.unresolved_force, &mut contact.missing_force, &mut contact.moment];
            forces.into_iter().for_each(scale);
            scale_both(&mut contact.resultant);
        }
        for support in self.support.values_mut() {
            scale(&mut support.moment);
            scale_both(&mut support.reaction);
        }
        for rigid in self.rigid.values_mut() {
            scale(&mut rigid.moment);
            scale_both(&mut rigid.force);
        }
        let energy = &mut self.energy;
        energy.strain.values_mut().chain(energy.parts.values_mut()).for_each(scale);
        [&mut energy.total, &mut energy.stationary, &mut energy.springs, &mut energy.external_work].into_iter().for_each(scale);
    }
}

#[cfg(test)]
mod tests;
