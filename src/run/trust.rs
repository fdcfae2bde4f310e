//! Whether contact pressures are to be trusted, and what to do where they are not.

mod doubt;
mod told;
mod unestimated;

pub(super) use unestimated::MOST_ROTATION;

use super::report::short;
use crate::accuracy::share_of_nothing;
use crate::case::Case;
use crate::contact::{MultiplierSpace, Pair, Quadrature, SegmentRule};
use crate::element::Order;
use crate::output::Summary;
use crate::output::summary;
use doubt::Doubt;
use std::collections::BTreeMap;
use told::{Unknown, Verdict, in_order, unknown, unreliable};
use unestimated::unestimated_doubts;

/// A contact whose inf-sup constant is below this has pressures that its displacements do not control.
const LEAST_INF_SUP: f64 = 0.1;

/// A pressure with more alternation than this is not one.
const MOST_OSCILLATION: f64 = 0.05;

/// On fewer edges, or fewer segments, the pressure of a zone is off by tens of per cent, unless the estimate proves it good.
pub(super) const LEAST_PARTS: f64 = 4.0;

/// The largest sign of an error that proves a pressure good.
pub(super) const PROVES: f64 = 0.05;

/// Signs of error that prove a pressure on one or two segments, too.
const NEXT_TO_NOTHING: f64 = 1e-3;

/// Largest estimated relative error in the energy norm.
const MOST_ERROR: f64 = 0.3;

/// The same of λ in the middle of a zone that presses, and of the force of a zone.
const MOST_PRESSURE_ERROR: f64 = 0.08;

/// The same of λ all over a zone: where it falls to zero it is steep, and steps (`p0`) miss it by more than their means do.
const MOST_ERROR_ALL_OVER: f64 = 0.06;
const MOST_ERROR_OF_STEPS: f64 = 0.12;

/// The same of the largest λ of a zone.
const MOST_PEAK_ERROR: f64 = 0.12;

/// The same of a force that is to be trusted.
const MOST_FORCE_ERROR: f64 = 0.01;

/// Share of the force of a contact from which that of a zone is judged.
const LEAST_FORCE_SHARE: f64 = 0.05;

/// Largest force, relative to that found, that overlaps of the bodies beside the zones may ask for; where nothing presses, the
/// largest overlap relative to the displacements.
const MOST_MISSING: [f64; 2] = [0.1, 1e-5];

/// Overlap of bodies between which nothing presses, relative to the displacements, that is no result any more.
const MOST_PASSED: f64 = 0.05;

/// Largest sum of all forces on a body, as a share of their magnitudes: beyond the first no force is trusted, beyond the second there
/// is no result.
const MOST_UNBALANCED_BODY: f64 = 0.01;
const MOST_OUT_OF_BALANCE: f64 = 0.1;

/// Largest difference of the forces on both bodies, relative: the pressure is off by as much at least.
const MOST_UNBALANCED: f64 = 0.01;

/// Largest error of the pressure by corners within a contact.
const MOST_CORNER_ERROR: f64 = 0.04;

/// What a contact without force is called.
const NOTHING_PRESSES: &str = "nothing presses";

/// What mends a pressure whose bodies are too coarse for it.
const FINER: &str = "refine the mesh where contact is";

/// The same where the mesh makes itself.
const LESS_ERROR: &str =
    "let the mesh become finer where contact is: ask for a smaller error, of pressure too, or allow more unknowns";

/// What keeps it from becoming better there, however fine the mesh is.
const CUT: &str = "take quadrature = \"cut\"";

/// Why values that are no numbers are no result.
pub const NO_NUMBERS: &str =
    "the solution goes beyond the numbers of a computer: correct the units of E, loads, displacements and coordinates";

/// Strain energy, by that of the softest body strained by the largest displacement over its length, below which bodies have moved
/// and not strained.
const NOT_STRAINED: f64 = 1e-12;

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

/// What mends a pressure of a mesh that makes itself, instead of a finer one.
fn on_order(remedy: &'static str, pair: &Pair, case: &Case) -> &'static str {
    match remedy {
        FINER if case.accuracy.is_some() && pair.quadrature == Quadrature::Cut => LESS_ERROR,
        FINER if case.accuracy.is_some() => CUT,
        _ => remedy,
    }
}

/// Trust is false if a figure speaks against the pressure, or if the solve that it comes from has not `converged`; it is null
/// if nothing tells, or if the corner of a body presses on too few edges.
/// Of the contacts of a scene the largest force is `most`: one that carries next to nothing of that needs no zone resolved.
fn judge_contact(
    summary: &Summary,
    contact: &summary::ContactSummary,
    pair: &Pair,
    case: &Case,
    converged: bool,
    most: f64,
) -> Verdict {
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
    let in_balance = is_balanced(summary) && out_of_balance(summary, case).is_none_or(|off| off <= MOST_UNBALANCED_BODY);
    let trust_force = force.map(|error| error <= MOST_FORCE_ERROR && in_balance && pressed);
    let carries = idle.is_none();
    doubts.extend(zone_doubts(contact, trust_force, more_segments(pair)));
    doubts.retain(|_| carries);
    doubts.extend(size_doubts(summary, case));
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
fn idle_words(contact: &summary::ContactSummary, case: &Case, most: f64) -> Option<String> {
    let share = share_of_nothing(case.accuracy.as_ref());
    let force = contact.force?.abs();
    let worth = force + contact.unresolved_force?.max(contact.missing_force.unwrap_or(0.0));
    (worth < share * most).then(|| match force {
        0.0 => NOTHING_PRESSES.into(),
        _ => format!("touches; carries less than {share:e} of the largest force"),
    })
}

/// Whether bodies have only moved, so that the little that presses is noise, which no mesh repeats.
fn is_rounding(summary: &Summary, contact: &summary::ContactSummary, case: &Case) -> bool {
    let is_noise = |zone: &summary::ZoneSummary| zone.lambda.is_none_or(|error| error > MOST_ERROR);
    !contact.zones.is_empty() && contact.zones.iter().all(is_noise) && !is_strained(summary, case)
}

/// Whether bodies are strained by more than rounding.
fn is_strained(summary: &Summary, case: &Case) -> bool {
    let young = case.bodies.iter().flat_map(|body| &body.parts).map(|part| part.material.young).fold(f64::INFINITY, f64::min);
    let moved = summary.displacement_max.zip(summary.energy.total);
    moved.is_none_or(|(moved, energy)| energy > NOT_STRAINED * young * moved * moved)
}

/// What tells that the displacements do not control the pressure; it may be why a solve has failed.
fn stability_doubts(contact: &summary::ContactSummary, pair: &Pair, case: &Case) -> Vec<Doubt> {
    let unstable = contact.inf_sup.filter(|beta| *beta < LEAST_INF_SUP);
    let segment = contact.h_ratio.map_or(String::new(), |ratio| format!(" with segments of {} edges", short(ratio)));
    let unstable = unstable.map(|beta| {
        let figure = format!("inf-sup constant {beta:.3}{segment}, at least {LEAST_INF_SUP} wanted");
        ("the inf-sup constant is too small", figure)
    });
    // Beside a singular end λ swings without harm to its middle, which the estimate tells.
    let harmless = contact.zones.iter().filter(|zone| zone.counts(&contact.zones)).all(|zone| is_proved(zone.lambda));
    let rough = contact.oscillation.filter(|share| *share > MOST_OSCILLATION && !harmless);
    let rough = rough.map(|share| {
        let figure = format!("oscillation {share:.3}{segment}, at most {MOST_OSCILLATION} wanted");
        ("the pressure oscillates", figure)
    });
    let remedy = stability(pair, case);
    [unstable, rough].into_iter().flatten().map(|(cause, figure)| Doubt { cause, figure, remedy }).collect()
}

/// What tells that zones are too narrow, or too coarse, for their pressure.
fn zone_doubts(contact: &summary::ContactSummary, trust_force: Option<bool>, shorter: &'static str) -> Vec<Doubt> {
    let mut doubts = Vec::new();
    let zones = &contact.zones;
    for zone in zones.iter().filter(|zone| zone.counts(zones)) {
        let place = if zones.len() > 1 {
            zone.ends.map_or(String::new(), |[a, b]| format!(" at s = {} to {}", short(a), short(b)))
        } else {
            String::new()
        };
        let (edges, segments) = (zone.edges.unwrap_or(f64::NAN), zone.segments.unwrap_or(0));
        if is_concentrated(zone, trust_force) {
            continue;
        }
        let proved = is_proved(zone.worst) && edges >= 1.0 && is_divided(zone);
        let good = proved || is_proved(zone.lambda) && zone.worst.is_some_and(|worst| worst <= MOST_PEAK_ERROR);
        if edges < LEAST_PARTS && !proved {
            doubts.push(Doubt {
                cause: "contact is narrower than four edges",
                figure: format!("contact{place} {edges:.1} edges wide, at least {LEAST_PARTS} wanted"),
                remedy: FINER,
            });
        } else if (segments as f64) < LEAST_PARTS && !good {
            let words = format!("contact{place} on {segments} segments, at least {LEAST_PARTS} wanted");
            doubts.push(Doubt { cause: "contact lies on fewer than four segments", figure: words, remedy: shorter });
        }
        let force = zone.force.filter(|_| zone.share.is_some_and(|share| share.abs() >= LEAST_FORCE_SHARE));
        let steps = contact.multiplier.as_deref() == Some("p0");
        let most_all_over = if steps { MOST_ERROR_OF_STEPS } else { MOST_ERROR_ALL_OVER };
        let errors = [
            ("of λ", "λ is too inexact", zone.lambda, MOST_PRESSURE_ERROR),
            ("of λ up to the ends of contact", "λ is too inexact up to the ends of contact", zone.whole, most_all_over),
            ("of the largest λ", "the largest λ is too inexact", zone.peak, MOST_PEAK_ERROR),
            ("of the force", "the force is too inexact", force, MOST_PRESSURE_ERROR),
        ];
        for (what, cause, error, most) in errors {
            let wrong = error.filter(|error| *error > most);
            let figure = |error| format!("estimated error {what}{place} {error:.2}, at most {most} wanted");
            doubts.extend(wrong.map(|error| Doubt { cause, figure: figure(error), remedy: FINER }));
        }
    }
    let cause = "the bodies overlap where no segment presses";
    doubts.extend(overlaps(contact).then(|| Doubt { cause, figure: cause.into(), remedy: shorter }));
    doubts
}

/// Whether bodies overlap where no segment presses by what a force that counts would part.
fn overlaps(contact: &summary::ContactSummary) -> bool {
    let [most, most_alone] = MOST_MISSING;
    contact.missing.is_some_and(|missing| missing > if contact.zones.is_empty() { most_alone } else { most })
}

/// What makes a run one that has not converged, whatever its residual says: values that are no numbers.
pub fn no_number(summary: &Summary) -> Option<String> {
    let values = [summary.energy.total, summary.displacement_max];
    values.into_iter().flatten().any(|value| !value.is_finite()).then(|| NO_NUMBERS.into())
}

/// What makes a run one that has not converged, whatever its active set says: bodies that pass through each other where nothing
/// presses, since no segment saw them meet.
pub fn passed_through(summary: &Summary) -> Option<String> {
    let is_passed = |contact: &summary::ContactSummary| {
        // Bodies that just touch overlap by nothing but rounding, which is worth no force.
        let is_worth = contact.unresolved_force.is_some_and(|force| force > 0.0);
        let is_idle = contact.force == Some(0.0) && contact.closed.as_ref().is_some_and(Vec::is_empty);
        is_idle && is_worth && contact.missing.is_some_and(|missing| missing > MOST_PASSED)
    };
    let passed = summary.named(is_passed);
    (!passed.is_empty()).then(|| {
        let names = summary::listed(&passed);
        format!("on contact {names} nothing presses, though the bodies overlap: its segments are too few or too long to see it")
    })
}

/// What tells that a solution is too far from the bodies' own to have their pressure.
fn size_doubts(summary: &Summary, case: &Case) -> Vec<Doubt> {
    let mut doubts = Vec::new();
    let wrong = summary.estimate.energy.filter(|error| *error > MOST_ERROR);
    let words = |error| format!("estimated error in the energy norm {error:.2}, at most {MOST_ERROR} wanted");
    doubts.extend(wrong.map(|error| ("the error in the energy norm is too large", words(error), FINER)));
    let off = out_of_balance(summary, case).filter(|off| *off > MOST_UNBALANCED_BODY);
    let words = |off| format!("the forces on a body are out of balance by {}, at most {MOST_UNBALANCED_BODY} wanted", short(off));
    let remedy = "take a smaller solver.tolerance, or correct what holds the bodies";
    doubts.extend(off.map(|off| ("the forces on a body are out of balance", words(off), remedy)));
    let off = summary.balance.force.filter(|_| !is_balanced(summary));
    let words = |off| format!("forces on the two bodies differ by {}, at most {MOST_UNBALANCED} wanted", short(off));
    let remedy = "see lost_points: the bodies must face each other all along the boundary";
    doubts.extend(off.map(|off| ("forces on the two bodies differ", words(off), remedy)));
    doubts.into_iter().map(|(cause, figure, remedy)| Doubt { cause, figure, remedy }).collect()
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

/// What makes segments shorter.
fn more_segments(pair: &Pair) -> &'static str {
    match pair.segments {
        SegmentRule::Auto => FINER,
        _ => "take more segments (\"auto\" takes as many as the mesh bears), or refine the mesh where contact is",
    }
}

/// What tells that bodies press with corners that the smooth contact boundary has not.
fn corner_doubt(contact: &summary::ContactSummary, [a, b]: [&str; 2]) -> Option<Doubt> {
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

/// What neither speaks for a pressure nor against it.
fn unknown_of(contact: &summary::ContactSummary, trust_force: Option<bool>, remedy: &'static str) -> Option<Unknown> {
    let zones = &contact.zones;
    let counting = || zones.iter().filter(|zone| zone.counts(zones));
    if let Some(zone) = counting().find(|zone| is_concentrated(zone, trust_force)) {
        let edges = zone.edges.unwrap_or(f64::NAN);
        let words = format!(
            "the corner of a body presses on {edges:.1} edges: its force is to be trusted, its pressure is singular there"
        );
        return Some(Unknown { cause: "the corner of a body presses, the force is to be trusted", words, remedy: None });
    }
    let cause = "nothing estimates the error of its pressure";
    counting().any(|zone| zone.lambda.is_none() && !(is_proved(zone.worst) && is_divided(zone))).then(|| Unknown {
        cause,
        words: cause.into(),
        remedy: Some(remedy),
    })
}

/// A reaction at the corner of a body that no mesh resolves: the force is right.
fn is_concentrated(zone: &summary::ZoneSummary, trust_force: Option<bool>) -> bool {
    zone.corner == Some(true) && zone.edges.is_some_and(|edges| edges < LEAST_PARTS) && trust_force == Some(true)
}

/// Whether its signs of error can tell anything: on one or two segments they may all be small beside the error, unless they
/// are next to nothing, as where the pressure is even.
fn is_divided(zone: &summary::ZoneSummary) -> bool {
    zone.segments.is_some_and(|segments| segments > 2) || zone.worst.is_some_and(|worst| worst <= NEXT_TO_NOTHING)
}

fn is_proved(worst: Option<f64>) -> bool {
    worst.is_some_and(|worst| worst <= PROVES)
}

fn is_balanced(summary: &Summary) -> bool {
    summary.balance.force.is_none_or(|off| off <= MOST_UNBALANCED)
}

/// By how much the forces on a body are out of balance, where mean motions are held: what holds such a body while the system is
/// solved may carry what a contact should. Elsewhere supports carry all, and beside no strain these forces are rounding.
fn out_of_balance(summary: &Summary, case: &Case) -> Option<f64> {
    let holds = summary.support.values().any(|support| support.moment.is_some());
    summary.balance.bodies.filter(|_| holds && is_strained(summary, case))
}

/// What makes a run one that has not converged, whatever its residual says: a body whose forces are far from balance.
pub fn not_in_balance(summary: &Summary, case: &Case) -> Option<String> {
    let off = out_of_balance(summary, case).filter(|off| *off > MOST_OUT_OF_BALANCE)?;
    Some(format!(
        "the forces on a body are out of balance by {} of their sum: a contact beside a mean motion that is held leaves the body free to move; hold it by a support, or leave out what contact holds already",
        short(off)
    ))
}

/// What mends a space too rich for the displacements; P1 has locked before its multipliers are too many.
fn stability(pair: &Pair, case: &Case) -> &'static str {
    let mut parts = case.bodies.iter().flat_map(|body| &body.parts);
    let locked = case.mesh.order == Order::P1 && parts.any(|part| part.material.poisson_in_plane() > super::report::LOCKING);
    match (locked, pair.segments == SegmentRule::Auto, pair.space) {
        (true, ..) => "take mesh.order = 2: P1 triangles lock",
        (_, true, MultiplierSpace::P1Continuous) => "take another multiplier space, or refine the mesh",
        (_, true, _) => "take stabilise = true, another multiplier space, or refine the mesh",
        (_, _, MultiplierSpace::P1Continuous) => "take fewer segments (\"auto\" is safe), or another multiplier space",
        _ => "take fewer segments (\"auto\" is safe), stabilise = true, or another multiplier space",
    }
}

#[cfg(test)]
mod tests;
