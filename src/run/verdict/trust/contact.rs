//! The verdict on one contact; with it what speaks against pressures and forces though no difference between meshes shows it:
//! motions and strains beyond the model, locking, a solve that has stopped early, contact within segments.

use super::remedies::{CUT, Mended};
use super::told::{Objection, Verdict};
use super::zones::{fewest_edges, is_on_few_segments, is_proved, overlaps, unknown_of, zone_doubts};
use crate::accuracy::{CARRIES_NOTHING, Quantity, share_of_nothing};
use crate::body::BodyPart;
use crate::case::Case;
use crate::contact::{Pair, Quadrature};
use crate::element::Order;
use crate::output::Summary;
use crate::output::summary::{ContactSummary, ZoneSummary};
use crate::run::verdict::limits::*;
use crate::run::verdict::no_result::{balance_doubts, is_strained};
use crate::run::words::short;

/// What a contact without force is called.
const NOTHING_PRESSES: &str = "nothing presses";

/// The verdict on a contact, as it was solved. Trust is false if a figure speaks against the pressure, or if the solve that it comes
/// from has not `converged`; it is null if nothing tells, or if the corner of a body presses on too few edges. Of a contact that
/// carries next to nothing of the largest force no zone need be resolved: it is null if that is only what the accuracy allows, and the
/// zones do not hold.
pub fn verdict(summary: &Summary, contact: &ContactSummary, mended: Mended, converged: bool) -> Verdict {
    let case = mended.case;
    if !converged {
        return Verdict { trust: Some(false), trust_force: Some(false), ..Verdict::of(stability_doubts(contact), mended) };
    }
    if is_rounding(summary, contact, case) {
        let words = "the bodies touch without being strained, and press by rounding alone";
        return Verdict { unknown: Some(Objection { cause: words, words: words.into(), remedy: None }), ..Verdict::default() };
    }
    let Some(idle) = idle_words(contact, case, summary.largest_force()) else { return judged(summary, contact, mended, true) };
    let own = judged(summary, contact, mended, false);
    // What counts as nothing because no more is asked for may have a pressure all the same, and is believed where its zones hold.
    let is_something = contact.force.is_some_and(|force| force.abs() > CARRIES_NOTHING * summary.largest_force());
    if own.trust == Some(true) && is_something && judged(summary, contact, mended, true).trust != Some(true) {
        return Verdict { trust: None, idle: Some(format!("{idle}; its pressure is not resolved")), ..own };
    }
    Verdict { idle: Some(idle), ..own }
}

/// The verdict on a contact of a solve that has converged. Of one that `carries` next to nothing its zones, force and sliding do not count.
fn judged(summary: &Summary, contact: &ContactSummary, mended: Mended, carries: bool) -> Verdict {
    let Mended { pair, case, .. } = mended;
    let mut doubts = stability_doubts(contact);
    let force = summary.estimate.contact.get(&pair.name).and_then(|own| own.force);
    let unbalanced = balance_doubts(summary, case);
    // Where nothing presses, meshes agree on a force of zero though the bodies overlap.
    let pressed = !contact.zones.is_empty() || !overlaps(contact);
    let limit = if is_on_few_segments(contact) { TRUSTED_FORCE_ON_FEW } else { TRUSTED_FORCE };
    let trust_force = force.map(|error| error <= limit && unbalanced.is_empty() && pressed);
    doubts.extend(zone_doubts(contact, trust_force));
    doubts.retain(|_| carries);
    doubts.extend(ENERGY.judge(summary.estimate.energy, &[]));
    doubts.extend(unbalanced);
    doubts.extend(FORCE.judge(force, &[]).filter(|_| carries));
    let mut beyond = doubts_beyond(summary, contact, case, carries);
    beyond.extend(direction_doubt(contact, pair, case).filter(|_| carries));
    // An open contact may press all the same, where the nodes leave its gap unknown.
    let has_shape = carries || contact.force == Some(0.0);
    let shapes: Vec<Doubt> = shape_doubts(contact, pair, case).into_iter().filter(|_| has_shape).collect();
    let is_known = contact.shape_error_force.is_none_or(|error| error <= shape_limit(pair, case, false));
    let trust_force = trust_force.map(|trust| trust && beyond.is_empty() && (is_known || !has_shape));
    doubts.extend(beyond);
    doubts.extend(shapes);
    let unknown = uncut(pair).or_else(|| unknown_of(contact, trust_force, mended.by(Remedy::MoreSegments)));
    let unknown = unknown.filter(|_| carries);
    let trust = if doubts.is_empty() { unknown.is_none().then_some(true) } else { Some(false) };
    let idle = (contact.force == Some(0.0) && contact.zones.is_empty()).then(|| NOTHING_PRESSES.into());
    Verdict { unknown, trust, trust_force, idle, ..Verdict::of(doubts, mended) }
}

/// Refinements that give each contact which carries something enough edges; one at least.
pub fn refinements_wanted(summary: &Summary, case: &Case) -> usize {
    let most = summary.largest_force();
    let carrying = summary.contact.values().filter(|contact| idle_words(contact, case, most).is_none());
    (EDGES.value / carrying.map(fewest_edges).fold(f64::INFINITY, f64::min)).log2().ceil().max(1.0) as usize
}

/// What a contact is called that carries next to nothing of the largest force, with all that overlaps beside it are worth.
pub fn idle_words(contact: &ContactSummary, case: &Case, most: f64) -> Option<String> {
    // What goes on smoothly from another contact has the edge of its pressure.
    if !contact.shares_with.is_empty() {
        return None;
    }
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
    let is_noise = |zone: &ZoneSummary| zone.lambda.is_none_or(|error| error > ENERGY.value);
    !contact.zones.is_empty() && contact.zones.iter().all(is_noise) && !is_strained(summary, case)
}

/// What tells that the displacements do not control the pressure; it may be why a solve has failed.
fn stability_doubts(contact: &ContactSummary) -> Vec<Doubt> {
    let segment = contact.h_ratio.map_or(String::new(), |ratio| format!(" with segments of {} edges", short(ratio)));
    // Beside a singular end λ swings without harm to its middle, which the estimate tells.
    let harmless = ZoneSummary::counting(&contact.zones).all(|zone| is_proved(zone.lambda));
    let figures = [(&INF_SUP, contact.inf_sup), (&OSCILLATION, contact.oscillation.filter(|_| !harmless))];
    figures.into_iter().filter_map(|(limit, value)| limit.judge(value, &[("segment", &segment)])).collect()
}

/// What no difference of meshes tells where integrals are not cut at the nodes: λ was off by 1 to 9 % then.
fn uncut(pair: &Pair) -> Option<Objection> {
    let cause = "its integrals are not cut at the nodes, which moves λ by per cents on any mesh";
    (pair.quadrature != Quadrature::Cut).then(|| Objection { cause, words: cause.into(), remedy: Some(CUT.into()) })
}

/// What tells that bodies press with corners that the smooth contact boundary has not, or in shapes that their nodes tell less well than
/// is asked for.
pub fn shape_doubts(contact: &ContactSummary, pair: &Pair, case: &Case) -> Vec<Doubt> {
    let angle = format!("{:.0}", contact.corner_angle.unwrap_or(f64::NAN));
    let limits = [contact.shape_error, contact.shape_error_force].into_iter().zip([true, false]);
    let off = limits
        .filter_map(|(error, of_pressure)| Some((error?, shape_limit(pair, case, of_pressure))))
        .find(|(error, most)| error > most);
    let limit = off.map_or(String::new(), |(_, most)| most.to_string());
    let wrong = off.map_or(String::new(), |(error, _)| match contact.force {
        Some(0.0) => format!("though nothing presses, {} of the largest force may", short(error)),
        _ => format!("λ is wrong by about {} (relative)", short(error)),
    });
    let [first, second] = &pair.between;
    let named: [(&str, &str); 5] =
        [("first", first), ("second", second), ("angle", &angle), ("limit", &limit), ("wrong", &wrong)];
    let shape = off.map(|(error, _)| SHAPE.doubt(error, &named));
    CORNERS.judge(contact.corner_error, &named[..3]).into_iter().chain(shape).collect()
}

/// What tells that forces turn with the bodies by more than is allowed, or than is asked for.
pub fn direction_doubt(contact: &ContactSummary, pair: &Pair, case: &Case) -> Option<Doubt> {
    let most = asked(pair, case, false).min(DIRECTION.value);
    contact.direction_error.filter(|error| *error > most).map(|error| DIRECTION.doubt(error, &[("bound", &short(most))]))
}

/// How well the shape must be known, by what it does to λ or to the force: as well as either is asked for.
fn shape_limit(pair: &Pair, case: &Case, of_pressure: bool) -> f64 {
    asked(pair, case, of_pressure).min(SHAPE.value)
}

/// How exact the pressure of a contact is asked to be, or its force.
fn asked(pair: &Pair, case: &Case, of_pressure: bool) -> f64 {
    let asked = case.accuracy.iter().flat_map(|accuracy| &accuracy.goals).filter(|goal| match &goal.quantity {
        Quantity::Pressure(name) | Quantity::Peak(name) => of_pressure && *name == pair.name,
        Quantity::Force(name) => !of_pressure && *name == pair.name,
        _ => false,
    });
    asked.map(|goal| goal.tolerance).fold(f64::INFINITY, f64::min)
}

/// What speaks against pressure and force beyond all differences between meshes. Of a contact that carries nothing what is measured
/// by its own length or force does not count.
fn doubts_beyond(summary: &Summary, contact: &ContactSummary, case: &Case, carries: bool) -> Vec<Doubt> {
    let own =
        slip_doubt(contact).into_iter().chain(end_doubt(contact)).chain(unresolved_doubt(contact)).chain(cut_doubt(contact));
    let own = own.chain(OVERLAP_BEYOND.judge(contact.missing_beyond, &[])).chain(SLANT.judge(contact.slant, &[]));
    let joint = CUT_AT_JOINT.judge(contact.cut_at_joint, &[]).into_iter().chain(HELD_FORCE.judge(contact.held_force, &[]));
    let turning = turning_doubt(contact).filter(|_| carries || contact.zones.is_empty());
    let residual = summary.solver.residual.filter(|_| !case.solver.goes_by_estimate());
    let bodies = strain_doubts(summary).into_iter().chain(rotation_doubts(summary)).chain(locking_doubt(case));
    own.filter(|_| carries).chain(joint).chain(turning).chain(bodies).chain(RESIDUAL.judge(residual, &[])).collect()
}

/// What tells that curved bodies have slid along each other too far for normals of the undeformed ones.
pub fn slip_doubt(contact: &ContactSummary) -> Option<Doubt> {
    let (slip, error) = (contact.slip?, contact.slip_error?);
    let by_turning = contact.rotation_error.is_some_and(|turning| turning > SLIP.value && turning > 0.5 * error);
    SLIP.judge(Some(error).filter(|_| slip > LITTLE_SLIP && !by_turning), &[("slip", &short(slip))])
}

/// What tells that contact goes on beyond the end of its boundary.
fn cut_doubt(contact: &ContactSummary) -> Option<Doubt> {
    let cut_off = ZoneSummary::counting(&contact.zones).filter_map(|zone| zone.cut_off);
    CUT_OFF.judge(cut_off.reduce(f64::max), &[])
}

/// What tells that bodies have slid along each other so far that they have another length in common, or lie elsewhere.
pub fn end_doubt(contact: &ContactSummary) -> Option<Doubt> {
    LOST_AT_ENDS.judge(contact.lost_at_ends, &[]).or_else(|| SLIP_AT_ENDS.judge(contact.slip_at_ends, &[]))
}

/// What tells that bodies have turned too far for a theory that makes larger what turns.
pub fn turning_doubt(contact: &ContactSummary) -> Option<Doubt> {
    if contact.zones.is_empty() {
        return GROWTH.judge(contact.rotation_error, &[]);
    }
    // Sliding and turning may undo each other, as where a round body turns about its centre.
    let is_left = contact.slip_error.is_none_or(|error| error > SLIP.value);
    TURNING.judge(contact.rotation_error.filter(|_| is_left), &[])
}

/// What tells that bodies are strained beyond a theory of small strain.
pub fn strain_doubts(summary: &Summary) -> Vec<Doubt> {
    let most = percent(STRAIN.value);
    let strained = summary.strain_max.iter();
    strained.filter_map(|(body, strain)| STRAIN.judge(*strain, &[("of", body), ("most", &most)])).collect()
}

/// What tells that bodies turn farther than any theory of small rotations goes.
pub fn rotation_doubts(summary: &Summary) -> Vec<Doubt> {
    let far = summary.rotation_max.iter().filter_map(|(body, angle)| Some((body, angle.filter(|a| a.abs() > ROTATION.value)?)));
    far.map(|(body, angle)| ROTATION.doubt(angle, &[("of", body)])).collect()
}

/// What tells that P1 triangles have locked: meshes that all lock alike have differences that say too little.
fn locking_doubt(case: &Case) -> Option<Doubt> {
    let mut parts = case.bodies.iter().flat_map(|body| &body.parts).filter(|_| case.mesh.order == Order::P1);
    parts.find_map(|BodyPart { name, material, .. }| {
        P1_LOCKS.judge(Some(material.poisson_in_plane()), &[("of", name), ("poisson", &material.poisson.to_string())])
    })
}

/// What tells of contact that is narrower than a segment.
pub fn unresolved_doubt(contact: &ContactSummary) -> Option<Doubt> {
    let force = contact.force.unwrap_or(0.0).abs();
    let off = contact.unresolved_force.filter(|off| *off > WITHIN_SEGMENTS.value * force)?;
    let worth = if force > 0.0 {
        format!(": to press them apart would take {} times its force", short(off / force))
    } else {
        String::new()
    };
    Some(WITHIN_SEGMENTS.doubt(off, &[("worth", &worth)]))
}

#[cfg(test)]
mod tests {
    use super::super::samples::case;
    use super::*;

    #[test]
    fn corners_are_doubted_by_what_they_do() {
        let contact =
            |error| ContactSummary { corner_angle: Some(11.25), corner_error: Some(error), ..ContactSummary::default() };
        let case = case(&[]);
        let told = |error| shape_doubts(&contact(error), &case.contacts[0], &case).into_iter().map(|doubt| doubt.figure).next();
        assert_eq!(told(0.03), None);
        assert!(
            told(0.07).is_some_and(|words| words.contains("\"lower.seam\" or \"upper.seam\" has corners of up to 11 degrees"))
        );
    }

    /// A shape that is known to .039 is known well enough, unless more of λ is asked for; or of a force that no load sets.
    #[test]
    fn shapes_are_doubted_by_what_is_asked_for() {
        let told = |settings: &[&str], of_force| {
            let case = case(settings);
            let contact =
                ContactSummary { shape_error: Some(0.039), shape_error_force: Some(of_force), ..ContactSummary::default() };
            shape_doubts(&contact, &case.contacts[0], &case).into_iter().map(|doubt| doubt.figure).collect::<String>()
        };
        for settings in [&[][..], &["accuracy.pressure=5e-2"], &["accuracy.force=1e-2"]] {
            assert_eq!(told(settings, 0.009), "", "{settings:?}");
        }
        for (setting, of_force) in [("accuracy.pressure=1e-2", 0.0), ("accuracy.peak=1e-2", 0.0), ("accuracy.force=1e-2", 0.039)]
        {
            assert!(told(&[setting], of_force).ends_with("at most 0.01 wanted"), "{setting}: {}", told(&[setting], of_force));
        }
    }

    #[test]
    fn what_overlaps_is_not_said_to_touch() {
        let case = case(&[]);
        let told = |unresolved: f64, missing: f64| {
            let (force, unresolved_force, missing_force) = (Some(1e-6), Some(unresolved), Some(missing));
            let contact = ContactSummary { force, unresolved_force, missing_force, ..ContactSummary::default() };
            idle_words(&contact, &case, 1.0).is_some()
        };
        assert_eq!([told(1e-6, 1e-6), told(1e-3, 0.0), told(0.0, 1e-3)], [true, false, false]);
        let unknown = ContactSummary { force: Some(0.0), ..ContactSummary::default() };
        assert_eq!(idle_words(&unknown, &case, 1.0), None);
    }

    #[test]
    fn sliding_is_doubted_where_a_body_ends() {
        let told = |slip_at_ends, lost_at_ends| {
            end_doubt(&ContactSummary { slip_at_ends, lost_at_ends, ..ContactSummary::default() }).map(|doubt| doubt.figure)
        };
        assert_eq!((told(None, None), told(Some(0.05), Some(0.01))), (None, None));
        assert!(told(Some(0.6), Some(0.4)).is_some_and(|words| words.starts_with("sliding takes 0.40 of the contact")));
        assert!(told(Some(0.6), Some(0.0)).is_some_and(|words| words.contains("slides along the other by 0.60")));
    }
}
