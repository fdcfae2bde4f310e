//! Pressures and penetrations of a solve, for every multiplier, and whether they are a solution of the contact conditions.
//!
//! A residual of 1e-8 may leave 1 % in λ of slender bodies (measured: 0.4 % of the force on a leaf 50 times longer than thick):
//! so the conditions are looked at whatever led to the set, and solves go on below the tolerance where they are not met.

use crate::contact::{Law, SetSolution};
use crate::discretisation::{Contact, Discretisation};
use crate::system::System;

/// Largest violation of the contact conditions, as a share of the largest pressure.
const MOST_VIOLATED: f64 = 1e-3;

/// The same, by the relative residual of the solve; the larger one counts.
const BY_RESIDUAL: f64 = 1e4;

/// Violations by more than this share of the largest pressure are not of rounding: a roller that its load drives up its groove pulls by
/// all of it.
const MORE_THAN_ROUNDING: f64 = 10.0 * MOST_VIOLATED;

/// What helps where rounding is all that is wrong with the contact conditions, and where it is not.
const BY_ROUNDING: &str = "rounding allows no better; take bodies that are less slender or less unlike in stiffness, or, without [accuracy], fewer segments";
const BY_LOADS: &str = "no set of what presses was found that holds the bodies: the loads may drive one off this contact or along it; if they do not, refine the mesh where contact is";

/// Share of the largest displacement by which rounding alone moves bodies apart or into each other. Contact that presses by no
/// more, as where bodies touch without a force between them, meets its conditions.
const ROUNDING: f64 = 1e-12;

/// Length, in edges, below which a multiplier is too short for its gap to be a pressure of its own.
const LEAST_LENGTH: f64 = 0.1;

/// What was solved for an active set; the same on every rank.
#[derive(Clone)]
pub(crate) struct ContactState {
    /// `λ_i`, zero on open multipliers (stress).
    lambda: Vec<f64>,
    /// `(B u - C λ - c)_i` of all multipliers, active or not (length squared).
    penetration: Vec<f64>,
    /// `κ_i` (stress per length squared).
    penalty: Vec<f64>,
    /// Pressure that rounding makes of the displacements (stress).
    noise: Vec<f64>,
}

impl ContactState {
    /// Reads it off the unknowns of a system. **Collective**
    pub(crate) fn new(system: &System) -> Self {
        let mut lambda = system.pressures();
        lambda.iter_mut().zip(system.active()).filter(|(_, active)| !**active).for_each(|(value, _)| *value = 0.0);
        let jumps = system.jump_term(&lambda);
        let mut penetration = system.with_free_displacement(|u| system.penetration(u));
        penetration.iter_mut().zip(&jumps).for_each(|(sum, jump)| *sum -= jump);
        let (penalty, moved) = (penalties(system.problem()), ROUNDING * system.largest_displacement());
        let of = |contact: &Contact| -> Vec<f64> {
            contact.range().map(|i| moved * penalty[i] * contact.multipliers.integral(i - contact.first)).collect()
        };
        let noise = system.problem().contacts.iter().flat_map(of).collect();
        Self { lambda, penetration, penalty, noise }
    }

    /// The same without pulls and penetrations that are smaller than a `share` of the largest pressure of all contacts, which solves
    /// are exact for, or than rounding.
    pub(crate) fn told_from(&self, problem: &Discretisation, share: f64) -> Self {
        let mut told = self.clone();
        let share = share * self.largest_pressure();
        for contact in &problem.contacts {
            for i in contact.range() {
                let least = share.max(self.noise[i]);
                if self.lambda[i].abs() <= self.noise[i] {
                    told.lambda[i] = 0.0;
                } else if self.lambda[i].abs() <= least {
                    told.lambda[i] = self.lambda[i].max(0.0);
                }
                if (self.penetration[i] * self.penalty[i]).abs() <= least {
                    told.penetration[i] = 0.0;
                }
            }
        }
        told
    }

    /// `λ_i + κ_i (B u - C λ - c)_i`: positive where the next set of the plain rule is active.
    pub(crate) fn force(&self, i: usize) -> f64 {
        self.lambda[i] + self.penalty[i] * self.penetration[i]
    }

    /// For the search by rising energy.
    pub(crate) fn found(&self) -> SetSolution<'_> {
        SetSolution { lambda: &self.lambda, penetration: &self.penetration, penalty: &self.penalty }
    }

    /// Largest mean penetration over a multiplier (length).
    pub(crate) fn largest_penetration(&self, problem: &Discretisation) -> f64 {
        let mean = |contact: &Contact| {
            let own = |i: usize| self.penetration[i] / contact.multipliers.integral(i - contact.first);
            contact.range().map(own).fold(0.0, f64::max)
        };
        problem.contacts.iter().map(mean).fold(0.0, f64::max)
    }

    /// Looks at the contact conditions themselves, whatever led to the set: no multiplier of a unilateral contact pulls, none
    /// that is open penetrates, and closed ones touch, to a share of the largest pressure that the relative `residual` allows.
    /// Otherwise words with the figure of the worst, and with what helps.
    pub(crate) fn violated(&self, problem: &Discretisation, active: &[bool], residual: f64) -> Option<String> {
        let allowed = MOST_VIOLATED.max(BY_RESIDUAL * residual);
        let most = self.largest_pressure();
        let mut worst: Option<(f64, String)> = None;
        for contact in &problem.contacts {
            for i in contact.range() {
                let (off, what) = self.off(contact, i, active[i]);
                // Written so that what is not a number counts.
                let holds = off <= allowed * most;
                if !holds && worst.as_ref().is_none_or(|(value, _)| off > *value) {
                    let place = crate::procedure::sets::unsettled::place(contact, i);
                    let by = if most > 0.0 { format!(", by {:.1e} of the largest pressure", off / most) } else { String::new() };
                    let helps = if off > MORE_THAN_ROUNDING * most { BY_LOADS } else { BY_ROUNDING };
                    worst = Some((off, format!("{place} {what}{by}; {helps}")));
                }
            }
        }
        worst.map(|(_, words)| words)
    }

    /// Largest violation of the contact conditions, as a share of the largest pressure.
    pub(crate) fn violation(&self, problem: &Discretisation, active: &[bool]) -> f64 {
        // What is not a number is the worst.
        let larger = |worst: f64, off: f64| if off <= worst { worst } else { off };
        let of = |contact: &Contact| contact.range().map(|i| self.off(contact, i, active[i]).0).fold(0.0, larger);
        let worst = problem.contacts.iter().map(of).fold(0.0, larger);
        if worst == 0.0 { 0.0 } else { worst / self.largest_pressure() }
    }

    fn largest_pressure(&self) -> f64 {
        self.lambda.iter().fold(0.0_f64, |most, value| most.max(value.abs()))
    }

    /// By how much more than rounding a multiplier violates the contact conditions (stress), and how.
    fn off(&self, contact: &Contact, i: usize, is_active: bool) -> (f64, &'static str) {
        // A gap over next to no length takes the pressure that it would take over a part of an edge.
        let (own, segment) = (i - contact.first, contact.multipliers.segment_of(i - contact.first));
        let share = (contact.multipliers.length(own) / (LEAST_LENGTH * contact.edge_lengths[segment])).min(1.0);
        let apart = share * self.penalty[i] * self.penetration[i];
        let (off, what) = match (is_active, contact.pair.law == Law::Unilateral) {
            (true, true) if self.lambda[i] < 0.0 => (-self.lambda[i], "pulls"),
            (true, _) => (apart.abs(), "does not touch"),
            (false, _) => (apart, "penetrates"),
        };
        (if off <= self.noise[i] { 0.0 } else { off }, what)
    }
}

/// `κ_i` of all multipliers.
fn penalties(problem: &Discretisation) -> Vec<f64> {
    let own = |contact: &Contact| -> Vec<f64> {
        (0..contact.multipliers.count()).map(|i| contact.multipliers.penalty(i, contact.multiplier_moduli[i])).collect()
    };
    problem.contacts.iter().flat_map(own).collect()
}
