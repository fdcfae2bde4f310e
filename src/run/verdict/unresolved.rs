//! Whether a solution is one of what the case says: not if its mesh, or its contact boundaries, cannot hold that.

use crate::accuracy::{
    DEEPEST, Goal, HERTZ_BY_UNRESOLVED, LEFT, NARROWEST, Quantity, ROUNDING_BY_OVERLAP, WORTH_WITHIN_SEGMENTS, share_of_nothing,
};
use crate::case::Case;
use crate::contact::{Configuration, Law, Pair, SegmentRule};
use crate::output::Summary;
use crate::output::summary::ContactSummary;
use crate::procedure::MOVES;
use crate::run::verdict::limits::{FORCE_OFF, OVERLAP_ALONE};
use crate::run::verdict::trust::{finer_mesh, refinements_wanted, slip_doubt, width};
use crate::run::words::short;

/// A force below this share of the least one that counts is what solves leave: rings that heat has loosened had 4e-6 to 6e-5 of it.
const ROUNDING: f64 = 1e-2;

/// What is judged at.
struct Judged<'a> {
    summary: &'a Summary,
    case: &'a Case,
    /// How far the ends of a contact boundary moved last that are held now, as a share of its length.
    moved: Option<f64>,
}

/// A cause: words, if it holds.
type Cause = fn(&Judged) -> Option<String>;

/// All causes, the first one counts.
const CAUSES: [Cause; 5] = [too_narrow, in_each_other, within_segments, still_moving, moved_too_far];

/// Why a solution is not resolved, and what would do; nothing if it is. `moved` is how far the ends of a contact boundary moved
/// last that are held now, as a share of its length.
pub fn unresolved(summary: &Summary, case: &Case, moved: Option<f64>) -> Option<String> {
    let judged = Judged { summary, case, moved };
    CAUSES.iter().find_map(|cause| cause(&judged))
}

/// A contact narrower than an edge that carries a force which counts.
fn too_narrow(judged: &Judged) -> Option<String> {
    let least = judged.least_force();
    let narrow = judged.contacts().flat_map(|(name, contact)| contact.zones.iter().map(move |zone| (name, contact, zone)));
    let counting = narrow.filter(|(_, contact, zone)| {
        let force = contact.force.unwrap_or(0.0) * zone.share.unwrap_or(1.0);
        // The force of a corner is right on any mesh.
        force.abs() > least && (zone.corner != Some(true) || zone.hertz_width.is_some())
    });
    let widths = counting.filter_map(|(name, _, zone)| Some((name, width(zone)?)));
    let (name, (width, edge)) = widths.filter(|(_, (width, edge))| *width < NARROWEST * edge).min_by(|a, b| {
        let share = |(_, (width, edge)): &(&str, (f64, f64))| width / edge;
        share(a).total_cmp(&share(b))
    })?;
    let (remedy, [width, edge]) = (judged.remedy(name), [width, edge].map(short));
    Some(format!("contact {name} is {width} wide by its force, less than an edge of {edge} there; {remedy}"))
}

/// Bodies that lie in each other, on Γ_C or beyond its ends.
fn in_each_other(judged: &Judged) -> Option<String> {
    let left = LEFT * judged.summary.displacement_max?;
    let deep = |contact: &ContactSummary| contact.depth.zip(contact.approach).filter(|(depth, _)| *depth > left);
    // What only touches has not come together by much: it lies in each other if others that carry would have.
    let least = judged.least_force();
    let largest = judged.contacts().filter_map(|(_, contact)| contact.approach).fold(0.0, f64::max);
    let touches = |contact: &ContactSummary| contact.force.is_some_and(|force| force.abs() < least);
    let share = |contact: &ContactSummary| {
        deep(contact).map_or(0.0, |(depth, approach)| depth / if touches(contact) { largest } else { approach })
    };
    let (name, contact) = judged.contacts().max_by(|a, b| share(a.1).total_cmp(&share(b.1)))?;
    let (depth, approach) = deep(contact).filter(|_| share(contact) > DEEPEST)?;
    let [x, y] = contact.deepest?.map(short);
    let remedy = judged.remedy(name);
    Some(format!(
        "contact {name}: the bodies lie in each other by {depth:.1e} near ({x}, {y}), and have come together by {approach:.1e}; {remedy}"
    ))
}

/// Contacts whose bodies lie in each other within segments while what presses is rounding, so that nothing drives them together and where
/// they lie is not told.
pub fn pressed_by_rounding(summary: &Summary, case: &Case) -> Vec<String> {
    let judged = Judged { summary, case, moved: None };
    let is_rounding = |contact: &ContactSummary| {
        let (force, off) = (contact.force.unwrap_or(0.0).abs(), contact.unresolved_force.unwrap_or(0.0));
        !contact.zones.is_empty() && force < f64::max(ROUNDING * judged.least_force(), ROUNDING_BY_OVERLAP * off)
    };
    let pressed = judged.contacts().filter(|(_, contact)| judged.is_missed(contact) && is_rounding(contact));
    pressed.map(|(name, _)| name.into()).collect()
}

/// Contacts that can but press, and whose multipliers were left to pull in all.
pub fn pulled(summary: &Summary, case: &Case) -> Vec<String> {
    let is_pulled = |pair: &&Pair| {
        let force = summary.contact.get(&pair.name).and_then(|contact| contact.force);
        pair.law == Law::Unilateral && force.is_some_and(|force| force < 0.0)
    };
    case.contacts.iter().filter(is_pulled).map(|pair| pair.name.clone()).collect()
}

/// Bodies that lie in each other within segments which are longer than the contact.
fn within_segments(judged: &Judged) -> Option<String> {
    let (name, _) = judged.contacts().find(|(_, contact)| judged.is_missed(contact))?;
    let words = format!("contact {name}: the bodies lie in each other within segments that are longer than what presses");
    let is_auto = judged.case.contacts.iter().any(|pair| pair.name == name && pair.segments == SegmentRule::Auto);
    if is_auto || judged.case.accuracy.is_some() {
        return Some(format!("{words}; {}", judged.remedy(name)));
    }
    Some(format!("{words}; take contact.{name}.segments = \"auto\", or more of them"))
}

/// A contact boundary whose ends are held because they found no rest.
fn still_moving(judged: &Judged) -> Option<String> {
    let moved = judged.moved.filter(|moved| *moved > MOVES)?;
    let (name, _) = judged.contacts().next()?;
    let remedy = judged.against_sliding().unwrap_or_else(|| judged.remedy(name));
    Some(format!("the ends of the contact boundary find no rest: they still moved by {moved:.0e} of its length; {remedy}"))
}

/// Bodies that turn or slide so far that a linear theory has them meet as they would not.
fn moved_too_far(judged: &Judged) -> Option<String> {
    let error = |contact: &ContactSummary| contact.slip_error.unwrap_or(0.0).max(contact.rotation_error.unwrap_or(0.0));
    let counting = judged.contacts().filter(|(_, contact)| contact.force.is_some_and(|force| force.abs() > judged.least_force()));
    let (name, contact) = counting.max_by(|a, b| error(a.1).total_cmp(&error(b.1)))?;
    let off = error(contact);
    let turning = contact.rotation_error.filter(|turning| *turning > FORCE_OFF);
    let angles = judged.summary.rotation.iter().filter_map(|(body, angle)| Some((body, (*angle)?)));
    let farthest = turning.and_then(|_| angles.max_by(|a, b| a.1.abs().total_cmp(&b.1.abs())));
    let turns = farthest.map_or(String::new(), |(body, angle)| format!("body {body} turns most, by {} radians; ", short(angle)));
    let is_tool = farthest.is_some_and(|(body, _)| body.starts_with("rigid."));
    let about = if is_tool { ", and lay the reference point (about) of a tool that may turn where it presses" } else { "" };
    (off > FORCE_OFF).then(|| {
        format!(
            "contact {name}: the bodies turn or slide so far that its force is wrong by about {} of itself in a theory of small motions; {turns}draw them nearer to where they come to lie{about}",
            short(off)
        )
    })
}

impl Judged<'_> {
    /// Unilateral contacts.
    fn contacts(&self) -> impl Iterator<Item = (&str, &ContactSummary)> {
        let pairs = self.case.contacts.iter().filter(|pair| pair.law == Law::Unilateral);
        pairs.filter_map(|pair| Some((pair.name.as_str(), self.summary.contact.get(&pair.name)?)))
    }

    /// What helps where bodies slide so far along a curve that its normals are those of other places: no finer mesh does.
    fn against_sliding(&self) -> Option<String> {
        let slides = |pair: &&Pair| self.summary.contact.get(&pair.name).and_then(slip_doubt).is_some();
        let stays = |pair: &&Pair| pair.configuration == Configuration::Reference;
        let pair = self.case.contacts.iter().filter(stays).find(slides)?;
        Some(format!("its bodies slide far along each other: take contact.{}.configuration = \"deformed\"", pair.name))
    }

    /// Whether bodies lie in each other within segments by more than what presses is worth.
    fn is_missed(&self, contact: &ContactSummary) -> bool {
        let (force, off) = (contact.force.unwrap_or(0.0).abs(), contact.unresolved_force.unwrap_or(0.0));
        let is_worth = if force > 0.0 {
            off > WORTH_WITHIN_SEGMENTS * force
        } else {
            contact.missing.is_some_and(|missing| missing > OVERLAP_ALONE)
        };
        HERTZ_BY_UNRESOLVED * off > self.least_force() && is_worth
    }

    /// The force from which a contact counts.
    fn least_force(&self) -> f64 {
        share_of_nothing(self.case.accuracy.as_ref()) * self.summary.largest_force()
    }

    /// What would resolve a contact: a mesh with enough edges on each, or an accuracy.
    fn remedy(&self, contact: &str) -> String {
        if let Some(accuracy) = &self.case.accuracy {
            let tolerance = 0.25 * share_of_nothing(Some(accuracy));
            let of_pressure = |goal: &&Goal| matches!(&goal.quantity, Quantity::Pressure(of) if of == contact);
            let pressure = accuracy.goals.iter().filter(of_pressure).map(|goal| 0.25 * goal.tolerance).reduce(f64::min);
            // A force that statics tells is exact on any mesh: another error of it makes none finer.
            let error = self.summary.estimate.contact.get(contact).and_then(|own| own.force);
            let (quantity, tolerance) = match error.is_some_and(|error| error < tolerance) {
                true => ("pressure", pressure.unwrap_or(4.0 * tolerance)),
                false => ("force", tolerance),
            };
            return format!("ask for a smaller error, as in [accuracy.contact.{contact}] {quantity} = {tolerance:.0e}");
        }
        finer_mesh(self.case, refinements_wanted(self.summary, self.case), "force")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::summary::{ContactEstimate, ZoneSummary};
    use crate::run::verdict::trust::samples::{case, zone};

    /// A ring that is loose on its hub, or a sleeve between heads where nothing else presses, is held by rounding.
    #[test]
    fn what_presses_by_rounding_is_told_from_what_is_too_coarse() {
        let told = |force: f64, most: f64, zones: Vec<ZoneSummary>| {
            let contact = ContactSummary { force: Some(force), unresolved_force: Some(1.0), zones, ..ContactSummary::default() };
            let other = ContactSummary { force: Some(most), ..ContactSummary::default() };
            let contact = [("seam".to_owned(), contact), ("other".to_owned(), other)].into();
            pressed_by_rounding(&Summary { contact, ..Summary::default() }, &case(&[])).len()
        };
        assert_eq!([told(1e-5, 20.0, vec![zone()]), told(1e-7, 0.0, vec![zone()])], [1, 1]);
        assert_eq!([told(1e-3, 20.0, vec![zone()]), told(1e-5, 0.0, vec![zone()]), told(1e-7, 0.0, Vec::new())], [0, 0, 0]);
    }

    /// Where the force is known better than would be asked for, another quantity makes the mesh finer.
    #[test]
    fn an_error_that_is_small_enough_is_not_asked_for() {
        for (error, asked, told) in [
            (Some(1e-8), "accuracy.force=1e-2", "[accuracy.contact.seam] pressure = 1e-2"),
            (None, "accuracy.force=1e-2", "[accuracy.contact.seam] force = 3e-3"),
            (Some(1e-8), "accuracy.pressure=1e-2", "[accuracy.contact.seam] pressure = 3e-3"),
        ] {
            let contact = ContactSummary { unresolved_force: Some(1.0), force: Some(1.0), ..ContactSummary::default() };
            let mut summary = Summary { contact: [("seam".to_owned(), contact)].into(), ..Summary::default() };
            summary.estimate.contact.insert("seam".into(), ContactEstimate { force: error, ..ContactEstimate::default() });
            let words = unresolved(&summary, &case(&[asked]), None).expect("it is within segments");
            assert!(words.ends_with(told), "{words}");
        }
    }

    /// Ends that move because the bodies have slid far are not brought to rest by a finer mesh.
    #[test]
    fn ends_that_find_no_rest_are_mended_by_what_moves_them() {
        let told = |slip: f64, settings: &[&str]| {
            let contact = ContactSummary { slip: Some(slip), slip_error: Some(0.1 * slip), ..ContactSummary::default() };
            let summary = Summary { contact: [("seam".to_owned(), contact)].into(), ..Summary::default() };
            unresolved(&summary, &case(settings), Some(2.0 * MOVES)).expect("they move")
        };
        let deformed = "take contact.seam.configuration = \"deformed\"";
        assert!(told(1.4, &[]).ends_with(deformed), "{}", told(1.4, &[]));
        for (slip, settings) in [(0.01, &[][..]), (1.4, &["contact.seam.configuration=deformed"])] {
            assert!(told(slip, settings).contains("by [accuracy] with force"), "{}", told(slip, settings));
        }
        const LOADED: &str = "load.top={ on = \"top\", pressure = 1.0 }";
        let stepped = ["steps.up.factors=[0.5, 1.0]", "steps.up.scales=[\"load.top\"]", LOADED];
        assert!(told(0.01, &stepped).contains("--set steps={} --set accuracy.force"), "{}", told(0.01, &stepped));
    }
}
