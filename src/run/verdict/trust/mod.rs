//! Whether contact pressures are to be trusted, and what to do where they are not.
//!
//! In comes the summary of a run with all its figures, out comes the [`ContactTrust`] of each contact, and what the run says of them.
//! Every figure is held against its row of `limits/table.rs`; nothing here has a number of its own. A figure that speaks against a
//! pressure is a doubt; where no figure speaks for it either, it is unknown.

mod contact;
mod remedies;
#[cfg(test)]
pub(super) mod samples;
mod told;
mod zones;

pub(super) use contact::{refinements_wanted, slip_doubt};
pub(super) use remedies::finer_mesh;
pub(super) use zones::width;

use crate::case::Case;
use crate::contact::{Pair, SegmentRule};
use crate::output::Summary;
use crate::output::summary::{ContactSummary, ContactTrust};
use crate::run::verdict::limits::TRUSTED_FORCE;
use contact::verdict;
use remedies::Mended;
use std::collections::BTreeMap;
use told::{TRUSTED, Verdict, clauses, in_order};

/// What is said of the pressures of a run.
#[derive(Debug, Default)]
pub struct Judgement {
    /// Clauses: figures that speak against pressures, each with what to do about it.
    pub unreliable: Option<String>,
    /// What nothing tells, a clause each.
    pub unknown: Vec<String>,
}

/// Sets the trust of every contact of a solution: of none where the run has no result, which is `why`, as in "is not resolved".
pub fn judge(summary: &mut Summary, case: &Case, converged: bool, why: Option<&str>) -> Judgement {
    let refinements = refinements_wanted(summary, case);
    let judged = as_solved(case).into_iter().filter_map(|pair| {
        let contact = summary.contact.get(&pair.name)?;
        Some((pair.name.clone(), verdict(summary, contact, Mended { pair: &pair, case, refinements }, converged)))
    });
    let mut verdicts: BTreeMap<String, Verdict> = judged.collect();
    distrust_shared_forces(&mut verdicts, summary);
    if why.is_some() {
        verdicts.values_mut().for_each(|verdict| verdict.trust_force = Some(false));
    }
    for (name, contact) in &mut summary.contact {
        contact.judged = verdicts.get(name).map(Verdict::trust).unwrap_or_default();
        let singular = contact.singular_words().filter(|_| contact.judged.verdict.as_deref() == Some(TRUSTED));
        if let Some(place) = singular {
            contact.judged.verdict = Some(format!("{TRUSTED}, but for the largest value: λ grows without bound {place}"));
        }
    }
    why.into_iter().for_each(|why| distrust(summary, why));
    let names = in_order(summary, case, &verdicts);
    let doubts = clauses(&names, &verdicts, |verdict| &verdict.doubts);
    let unknown = clauses(&names, &verdicts, |verdict| verdict.unknown.as_slice());
    Judgement { unreliable: (!doubts.is_empty()).then(|| doubts.join("; ")), unknown }
}

/// What a contact that goes on smoothly from another one lacks that one has: a force that is not trusted leaves none on the other side
/// of the joint, unless it is next to nothing beside it.
fn distrust_shared_forces(verdicts: &mut BTreeMap<String, Verdict>, summary: &Summary) {
    let is_sure = |name: &String| verdicts.get(name).is_none_or(|verdict| verdict.trust_force == Some(true));
    let force = |name: &String| summary.contact.get(name).and_then(|contact| contact.force).unwrap_or(0.0);
    let counts = |name: &String, other: &String| force(other) > TRUSTED_FORCE * force(name);
    let shares =
        |name: &String, contact: &ContactSummary| contact.shares_with.iter().any(|other| counts(name, other) && !is_sure(other));
    let shared: Vec<&String> =
        summary.contact.iter().filter(|(name, contact)| shares(name, contact)).map(|(name, _)| name).collect();
    for name in shared {
        verdicts.entry(name.clone()).and_modify(|verdict| verdict.trust_force = verdict.trust_force.map(|_| false));
    }
}

/// Leaves no contact trusted, of a run that is not resolved, or that has not converged though its solve has.
fn distrust(summary: &mut Summary, why: &str) {
    for ContactSummary { judged, .. } in summary.contact.values_mut() {
        let why = match judged.trust {
            Some(false) => judged.verdict.take(),
            _ => Some(format!("not trusted: the run {why}")),
        };
        *judged = ContactTrust { trust: Some(false), trust_force: Some(false), verdict: why };
    }
}

/// The contacts of a case as they were solved: with an accuracy the segments are the program's own.
fn as_solved(case: &Case) -> Vec<Pair> {
    let rule = |pair: &Pair| if case.accuracy.is_some() { SegmentRule::Auto } else { pair.segments.clone() };
    case.contacts.iter().map(|pair| Pair { segments: rule(pair), ..pair.clone() }).collect()
}

#[cfg(test)]
mod tests;
