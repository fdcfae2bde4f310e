//! What the summary says of an accuracy that was asked for.

use serde::Serialize;
use std::collections::BTreeMap;

/// One mesh of those that were adapted to an accuracy. Goals that are not asked for are missing.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct AccuracyStep {
    /// Its macro triangles.
    pub macro_triangles: usize,
    /// Refinements of each of them.
    pub refine: usize,
    /// Displacement unknowns.
    pub unknowns: usize,
    /// What was solved on it, the coarsest refinement first.
    pub cycles: Vec<Cycles>,
    /// Seconds since the first mesh was begun.
    pub seconds: f64,
    /// The displacement in the energy norm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub energy: Option<GoalSummary>,
    /// By name of the contact: `force` (∫λ ds), `pressure` (λ over the middle of what presses, root mean square), `peak` (the
    /// largest λ) and `ends` (the ends of contact, by its width).
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub contact: BTreeMap<String, GoalsByWord>,
    /// By name of the probe: `displacement` and `stress`, each by its own size.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub probe: BTreeMap<String, GoalsByWord>,
}

/// Goals of one contact or probe by the words that the case has for them.
pub type GoalsByWord = BTreeMap<String, GoalSummary>;

/// All solves on one refinement of a mesh.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Cycles {
    /// Displacement unknowns.
    pub unknowns: usize,
    /// Krylov iterations, each with one cycle of the preconditioner.
    pub iterations: usize,
}

/// A relative error.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct GoalSummary {
    /// As estimated; null where there is not enough to tell.
    pub estimate: Option<f64>,
    /// As the expected values of the case tell it; null where they do not.
    pub error: Option<f64>,
    /// The largest that was asked for.
    pub asked: f64,
}
