//! Whether contact pressures are to be trusted, and what to do where they are not.

mod balance;
mod doubt;
mod no_result;
mod remedies;
mod stability;
mod told;
mod unestimated;
mod zones;

pub(crate) use no_result::{NO_NUMBERS, no_result};
pub(crate) use unestimated::MOST_ROTATION;
pub(crate) use zones::{LEAST_PARTS, PROVES};

use crate::accuracy::share_of_nothing;
use crate::case::Case;
use crate::contact::{Pair, SegmentRule};
use crate::output::Summary;
use crate::output::summary::{ContactSummary, ZoneSummary};
use crate::run::report::short;
use balance::{balance_doubts, is_in_balance, is_strained};
use doubt::Doubt;
use remedies::{FINER, more_segments, on_order};
use stability::stability_doubts;
use std::collections::BTreeMap;
use told::{Unknown, Verdict, in_order, unknown, unreliable};
use unestimated::unestimated_doubts;
use zones::{MOST_PRESSURE_ERROR, overlaps, unknown_of, zone_doubts};

/// Largest estimated relative error in the energy norm.
const MOST_ERROR: f64 = 0.3;

/// The same of a force that is to be trusted.
const MOST_FORCE_ERROR: f64 = 0.01;

/// Largest error of the pressure by corners within a contact.
const MOST_CORNER_ERROR: f64 = 0.04;

/// What a contact without force is called.
const NOTHING_PRESSES: &str = "nothing presses";

/// What is said of the pressures of a run.
#[derive(Debug, Default)]
pub struct Judgement {
    /// Figures that speak against pressures, with what to do about them.
    pub unreliable: Option<String>,
    /// What nothing tells, a sentence each.
    pub unknown: Vec<String>,
}

/// Sets `trust`, `trust_force` and `verdict` of every contact.
pub fn judge(summary: &mut Summary, case: &Case, converged: bool) -> Judgement {
    let most = summary.largest_force();
    let mut verdicts = BTreeMap::new();
    for pair in &as_solved(case) {
        let Some(contact) = summary.contact.get(&pair.name) else { continue };
        let mut verdict = judge_contact(summary, contact, pair, case, converged, most);
        verdict.doubts.iter_mut().for_each(|doubt| doubt.remedy = on_order(doubt.remedy, pair, case));
        verdicts.insert(pair.name.clone(), verdict);
    }
    for (name, verdict) in &verdicts {
        let Some(contact) = summary.contact.get_mut(name) else { continue };
        (contact.trust, contact.trust_force) = (verdict.trust, verdict.trust_force);
        contact.verdict = Some(verdict.words());
    }
    let names = in_order(summary, case, &verdicts);
    Judgement { unreliable: unreliable(&names, &verdicts), unknown: unknown(&names, &verdicts) }
}

/// The contacts of a case as they were solved: with an accuracy the segments are the program's own.
fn as_solved(case: &Case) -> Vec<Pair> {
    let rule = |pair: &Pair| if case.accuracy.is_some() { SegmentRule::Auto } else { pair.segments.clone() };
    case.contacts.iter().map(|pair| Pair { segments: rule(pair), ..pair.clone() }).collect()
}

/// Trust is false if a figure speaks against the pressure, or if the solve that it comes from has not `converged`; it is null
/// if nothing tells, or if the corner of a body presses on too few edges.
/// Of the contacts of a scene the largest force is `most`: one that carries next to nothing of that needs no zone resolved.
fn judge_contact(summary: &Summary, contact: &ContactSummary, pair: &Pair, case: &Case, converged: bool, most: f64) -> Verdict {
    let mut doubts = stability_doubts(contact, pair, case);
    if !converged {
        return Verdict { doubts, trust: Some(false), trust_force: Some(false), ..Verdict::default() };
    }
    if is_rounding(summary, contact, case) {
        let words = "the bodies touch without being strained, and press by rounding alone";
        return Verdict { unknown: Some(Unknown { cause: words, words: words.into(), remedy: None }), ..Verdict::default() };
    }
    let idle = idle_words(contact, case, most);
    let force = summary.estimate.contact.get(&pair.name).and_then(|own| own.force);
    // Where nothing presses, meshes agree on a force of zero though the bodies overlap.
    let pressed = !contact.zones.is_empty() || !overlaps(contact);
    let trust_force = force.map(|error| error <= MOST_FORCE_ERROR && is_in_balance(summary, case) && pressed);
    let carries = idle.is_none();
    doubts.extend(zone_doubts(contact, trust_force, more_segments(pair)));
    doubts.retain(|_| carries);
    doubts.extend(energy_doubt(summary));
    doubts.extend(balance_doubts(summary, case));
    doubts.extend(force_doubt(force).filter(|_| carries));
    let beyond = unestimated_doubts(summary, contact, case, more_segments(pair), carries);
    let trust_force = trust_force.map(|trust| trust && beyond.is_empty());
    doubts.extend(beyond);
    let corners = corner_doubt(contact, pair.between.each_ref().map(String::as_str));
    doubts.extend(corners.filter(|_| carries));
    let unknown = unknown_of(contact, trust_force, on_order(more_segments(pair), pair, case)).filter(|_| carries);
    let trust = if doubts.is_empty() { unknown.is_none().then_some(true) } else { Some(false) };
    let idle = idle.or_else(|| (contact.force == Some(0.0) && contact.zones.is_empty()).then(|| NOTHING_PRESSES.into()));
    Verdict { doubts, unknown, trust, trust_force, idle }
}

/// What a contact is called that carries next to nothing of the largest force, with all that overlaps beside it are worth.
fn idle_words(contact: &ContactSummary, case: &Case, most: f64) -> Option<String> {
    let share = share_of_nothing(case.accuracy.as_ref());
    let force = contact.force?.abs();
    let worth = force + contact.unresolved_force?.max(contact.missing_force.unwrap_or(0.0));
    (worth < share * most).then(|| match force {
        0.0 => NOTHING_PRESSES.into(),
        _ => format!("touches; carries less than {share:e} of the largest force"),
    })
}

/// Whether bodies have only moved, so that the little that presses is noise, which no mesh repeats.
fn is_rounding(summary: &Summary, contact: &ContactSummary, case: &Case) -> bool {
    let is_noise = |zone: &ZoneSummary| zone.lambda.is_none_or(|error| error > MOST_ERROR);
    !contact.zones.is_empty() && contact.zones.iter().all(is_noise) && !is_strained(summary, case)
}

/// What tells that a solution is too far from the bodies' own to have their pressure.
fn energy_doubt(summary: &Summary) -> Option<Doubt> {
    let error = summary.estimate.energy.filter(|error| *error > MOST_ERROR)?;
    Some(Doubt {
        cause: "the error in the energy norm is too large",
        figure: format!("estimated error in the energy norm {error:.2}, at most {MOST_ERROR} wanted"),
        remedy: FINER,
    })
}

/// What tells that the force of a contact is not known.
fn force_doubt(error: Option<f64>) -> Option<Doubt> {
    let error = error.filter(|error| *error > MOST_PRESSURE_ERROR)?;
    Some(Doubt {
        cause: "the whole force is too inexact",
        figure: format!("estimated error of the whole force {error:.2}, at most {MOST_PRESSURE_ERROR} wanted"),
        remedy: FINER,
    })
}

/// What tells that bodies press with corners that the smooth contact boundary has not.
fn corner_doubt(contact: &ContactSummary, [a, b]: [&str; 2]) -> Option<Doubt> {
    let error = contact.corner_error.filter(|error| *error > MOST_CORNER_ERROR)?;
    let angle = contact.corner_angle.unwrap_or(f64::NAN);
    Some(Doubt {
        cause: "a body has corners within the contact",
        figure: format!(
            "\"{a}\" or \"{b}\" has corners of up to {angle:.0} degrees within the contact, which change λ by about {}",
            short(error)
        ),
        remedy: "if these are chords of a curve, give it by a [geometry]; if the corners are meant, name the pieces between them, each with a contact of its own",
    })
}

#[cfg(test)]
mod tests;
