//! Whether contact pressures are to be trusted, and what to do where they are not.

use super::report::short;
use crate::case::Case;
use crate::contact::{MultiplierSpace, Pair, SegmentRule};
use crate::element::Order;
use crate::output::Summary;
use crate::output::summary;

/// A contact whose inf-sup constant is below this has pressures that its displacements do not control.
const LEAST_INF_SUP: f64 = 0.1;

/// A pressure with more alternation than this is not one.
const MOST_OSCILLATION: f64 = 0.05;

/// On fewer edges the pressure of a contact that ends between them is off by tens of per cent.
const LEAST_EDGES: f64 = 4.0;

/// Largest estimated relative error, of λ and in the energy norm.
const MOST_ERROR: f64 = 0.3;

/// Largest difference of the forces on both bodies, relative: the pressure is off by as much at least.
const MOST_UNBALANCED: f64 = 0.01;

/// Share of the force that penetration within single segments may be worth: more is contact narrower than they are.
const MOST_UNRESOLVED: f64 = 0.2;

/// A figure that speaks against a pressure, and what mends it.
struct Doubt {
    figure: String,
    remedy: &'static str,
}

/// Sets `trust` of every contact: false if a figure speaks against its pressure, or if the solve it comes from has not
/// `converged`; nothing if there is no figure to judge by. Gives the figures in words, with what to do about them.
pub fn judge(summary: &mut Summary, case: &Case, converged: bool) -> Option<String> {
    let (mut told, mut remedies) = (Vec::new(), Vec::new());
    for pair in &case.contacts {
        let Some(contact) = summary.contact.get(&pair.name) else { continue };
        let mut doubts = stability_doubts(contact, pair, case);
        if converged {
            doubts.extend(size_doubts(summary, contact, &pair.name));
        }
        let known = contact.inf_sup.is_some() || contact.oscillation.is_some();
        let trust = if doubts.is_empty() && converged { known.then_some(true) } else { Some(false) };
        if !doubts.is_empty() {
            let mut figures: Vec<String> = doubts.iter().map(|doubt| doubt.figure.clone()).collect();
            figures.extend(contact.h_ratio.map(|ratio| format!("shortest segment {} edges of the softer body", short(ratio))));
            told.push(format!("contact {} ({})", pair.name, figures.join("; ")));
        }
        let new = doubts.into_iter().map(|doubt| doubt.remedy);
        new.for_each(|remedy| {
            if !remedies.contains(&remedy) {
                remedies.push(remedy)
            }
        });
        if let Some(contact) = summary.contact.get_mut(&pair.name) {
            contact.trust = trust;
        }
    }
    (!told.is_empty()).then(|| format!("{}; {}", told.join(", "), remedies.join("; ")))
}

/// What tells that the displacements do not control the pressure; it may be why a solve has failed.
fn stability_doubts(contact: &summary::Contact, pair: &Pair, case: &Case) -> Vec<Doubt> {
    let unstable = contact.inf_sup.filter(|beta| *beta < LEAST_INF_SUP);
    let unstable = unstable.map(|beta| format!("inf-sup constant {beta:.3}, at least {LEAST_INF_SUP} wanted"));
    let rough = contact.oscillation.filter(|share| *share > MOST_OSCILLATION);
    let rough = rough.map(|share| format!("oscillation {share:.3}, at most {MOST_OSCILLATION} wanted"));
    let remedy = stability(pair, case);
    [unstable, rough].into_iter().flatten().map(|figure| Doubt { figure, remedy }).collect()
}

/// What tells that a solution is too far from the bodies' own to have their pressure.
fn size_doubts(summary: &Summary, contact: &summary::Contact, name: &str) -> Vec<Doubt> {
    let finer = "refine the mesh where contact is";
    let mut doubts = Vec::new();
    let narrow = contact.closed_edges.filter(|edges| *edges < if ends_inside(contact) { LEAST_EDGES } else { 1.0 });
    doubts.extend(narrow.map(|edges| (format!("contact {edges:.1} edges wide, at least {LEAST_EDGES} wanted"), finer)));
    let unresolved = contact.unresolved_force.filter(|off| *off > MOST_UNRESOLVED * contact.force.unwrap_or(0.0).abs());
    let words = |off| format!("the bodies penetrate each other within segments, worth a force of {}", short(off));
    doubts.extend(unresolved.map(|off| (words(off), "take more segments, and refine the mesh where contact is")));
    let estimate = &summary.estimate;
    let errors = [("of λ", estimate.contact.get(name).and_then(|own| own.lambda)), ("in the energy norm", estimate.energy)];
    for (what, error) in errors {
        let wrong = error.filter(|error| *error > MOST_ERROR);
        doubts.extend(wrong.map(|error| (format!("estimated error {what} {error:.2}, at most {MOST_ERROR} wanted"), finer)));
    }
    let off = summary.balance.force.filter(|off| *off > MOST_UNBALANCED);
    let words = |off| format!("forces on the two bodies differ by {}, at most {MOST_UNBALANCED} wanted", short(off));
    doubts.extend(off.map(|off| (words(off), "see lost_points: the bodies must face each other all along the boundary")));
    doubts.into_iter().map(|(figure, remedy)| Doubt { figure, remedy }).collect()
}

/// Whether contact ends between the ends of its boundary.
fn ends_inside(contact: &summary::Contact) -> bool {
    let closed = contact.closed.iter().flatten().map(|[from, to]| to - from).sum::<f64>();
    contact.length.is_some_and(|length| closed < length * (1.0 - 1e-9))
}

/// What mends a space too rich for the displacements; P1 has locked before its multipliers are too many.
fn stability(pair: &Pair, case: &Case) -> &'static str {
    let locked = case.mesh.order == Order::P1 && case.bodies.iter().any(|body| body.material.poisson > super::report::LOCKING);
    match (locked, pair.segments == SegmentRule::Auto, pair.space) {
        (true, ..) => "take mesh.order = 2: P1 triangles lock",
        (_, true, MultiplierSpace::P1Continuous) => "take another multiplier space, or refine the mesh",
        (_, true, _) => "take stabilise = true, another multiplier space, or refine the mesh",
        (_, _, MultiplierSpace::P1Continuous) => "take fewer segments (\"auto\" is safe), or another multiplier space",
        _ => "take fewer segments (\"auto\" is safe), stabilise = true, or another multiplier space",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::summary::{Balance, Contact, ContactEstimate, Estimate};

    fn words(change: impl Fn(&mut Summary, &mut Contact)) -> String {
        let estimate = ContactEstimate { force: None, lambda: Some(0.01) };
        let mut summary = Summary {
            estimate: Estimate { energy: Some(0.02), contact: [("seam".to_string(), estimate)].into() },
            balance: Balance { force: Some(1e-15), ..Balance::default() },
            ..Summary::default()
        };
        let mut contact =
            Contact { length: Some(1.0), closed: Some(vec![[0.0, 0.4]]), closed_edges: Some(8.0), ..Contact::default() };
        change(&mut summary, &mut contact);
        size_doubts(&summary, &contact, "seam").into_iter().map(|doubt| doubt.figure).collect::<Vec<_>>().join("; ")
    }

    #[test]
    fn a_pressure_is_doubted_by_what_is_far_off() {
        assert_eq!(words(|_, _| ()), "");
        assert!(words(|_, contact| contact.closed_edges = Some(1.5)).starts_with("contact 1.5 edges wide"));
        assert!(words(|summary, _| summary.estimate.energy = Some(0.6)).contains("energy norm 0.60"));
        let worse = |summary: &mut Summary| summary.estimate.contact.get_mut("seam").expect("there").lambda = Some(0.9);
        assert!(words(|summary, _| worse(summary)).contains("of λ 0.90"));
        assert!(words(|summary, _| summary.balance.force = Some(1.0)).contains("differ by 1.00"));
        let within =
            |force: f64, off: f64| words(|_, contact| (contact.force, contact.unresolved_force) = (Some(force), Some(off)));
        assert_eq!((within(5.4, 0.2), within(0.0, 0.0)), (String::new(), String::new()));
        assert!(within(5.4, 4.2).contains("worth a force of 4.20") && within(0.0, 4.2).contains("within segments"));
    }

    #[test]
    fn a_short_boundary_may_be_closed_from_end_to_end() {
        let whole = |contact: &mut Contact, edges| {
            contact.closed = Some(vec![[0.0, 1.0]]);
            contact.closed_edges = Some(edges);
        };
        assert_eq!(words(|_, contact| whole(contact, 2.0)), "");
        assert!(words(|_, contact| whole(contact, 0.5)).contains("0.5 edges wide"));
        assert_eq!(words(|_, contact| (contact.closed, contact.closed_edges) = (Some(Vec::new()), None)), "");
    }
}
