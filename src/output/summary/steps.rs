//! What a summary says of load steps.

use super::contact::ContactSummary;
use super::{BalanceSummary, ProbeSummary, RigidSummary, Status, Summary, SupportSummary};
use serde::Serialize;
use std::collections::BTreeMap;

/// One load step.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct StepSummary {
    /// Its number, from 1.
    pub step: usize,
    /// Factors by name.
    pub factors: BTreeMap<String, f64>,
    /// Its own verdict.
    pub status: Status,
    /// The verdict in words.
    pub reason: Option<String>,
    /// By name of the contact.
    pub contact: BTreeMap<String, StepContact>,
    /// By name of the support.
    pub support: BTreeMap<String, SupportSummary>,
    /// By name of the rigid tool, or of the load that stays rigid.
    pub rigid: BTreeMap<String, RigidSummary>,
    /// By name of the probe.
    pub probe: BTreeMap<String, ProbeSummary>,
    /// Largest displacement of a node (length).
    pub displacement_max: Option<f64>,
    /// Strain energy.
    pub energy: Option<f64>,
    /// f·u + r·u_D of this step by itself, without the factor one half.
    pub external_work: Option<f64>,
    /// Relative residuals of the balances of this step by itself.
    pub balance: BalanceSummary,
    /// Krylov iterations of each solve on the mesh of the case.
    pub iterations: Vec<usize>,
    /// Wall time of the step (seconds), slowest rank.
    pub seconds: Option<f64>,
}

/// A contact in one load step.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct StepContact {
    /// ∫ λ ds (force per thickness).
    pub force: Option<f64>,
    /// Resultant on body 2 (force per thickness).
    pub resultant: Option<[f64; 2]>,
    /// Intervals of arc length in contact.
    pub closed: Option<Vec<[f64; 2]>>,
    /// Length of all of them.
    pub width: Option<f64>,
    /// Largest contact pressure.
    pub pressure_max: Option<f64>,
    /// Whether the contact pressure can be trusted.
    pub trust: Option<bool>,
}

impl StepSummary {
    /// What a list of steps keeps of the summary of one.
    pub fn new(step: usize, factors: &[(String, f64)], of: &Summary, seconds: f64) -> Self {
        let contact = |(name, contact): (&String, &ContactSummary)| {
            let (closed, width) = (contact.closed.clone(), contact.width());
            let (force, resultant, pressure_max) = (contact.force, contact.resultant, contact.pressure_max);
            (name.clone(), StepContact { force, resultant, closed, width, pressure_max, trust: contact.judged.trust })
        };
        Self {
            step,
            factors: factors.iter().cloned().collect(),
            status: of.status,
            reason: of.reason.clone(),
            contact: of.contact.iter().map(contact).collect(),
            support: of.support.clone(),
            rigid: of.rigid.clone(),
            probe: of.probe.clone(),
            displacement_max: of.displacement_max,
            energy: of.energy.total,
            external_work: of.energy.external_work,
            balance: of.balance.clone(),
            iterations: of.solver.iterations.clone(),
            seconds: Some(seconds),
        }
    }
}
