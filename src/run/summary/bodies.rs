//! The largest stress of each body, and whether it can be believed.

use crate::case::Case;
use crate::geometry::Point;
use crate::output::RunError;
use crate::output::summary::{BodySummary, ContactSummary, Status, Summary, listed};
use crate::procedure::Solved;
use crate::recovery::Evaluation;
use crate::run::verdict::limits::{STRESS_APART, STRESS_COUNTS};

/// The largest von Mises stress of each body that is no rigid tool, by its name, in the order of the mesh: of a solution with this
/// summary so far, and of this status. **Collective**
///
/// # Errors
/// PETSc fails.
pub fn largest_stresses(
    found: &Evaluation,
    solved: &Solved,
    case: &Case,
    (summary, status): (&Summary, Status),
) -> Result<Vec<(String, BodySummary)>, RunError> {
    let scene = &found.problem.scene;
    let grows = |name: &String| summary.contact.get(name).is_some_and(ContactSummary::is_singular_at_end);
    let is_distrusted = |name: &String| summary.contact.get(name).is_some_and(|contact| contact.judged.trust == Some(false));
    let grows: Vec<bool> = found.problem.contacts.iter().map(|contact| grows(&contact.pair.name)).collect();
    let distrusted = |body: usize| {
        let own = found.problem.contacts.iter().filter(|contact| contact.bodies.contains(&body));
        let names = own.map(|contact| &contact.pair.name).filter(|name| is_distrusted(name)).collect::<Vec<_>>();
        (!names.is_empty()).then(|| listed(&names))
    };
    let before = |part: usize| solved.coarse_stress.as_ref().map(|all| all[part]);
    let joints = |name: &String| summary.contact.get(name).map(ContactSummary::singular_places).unwrap_or_default();
    let joints: Vec<Vec<Point>> = found.problem.contacts.iter().map(|contact| joints(&contact.pair.name)).collect();
    let own = found.stress_peaks(&grows, &joints)?.into_iter().zip(&scene.mesh.parts).enumerate();
    let own = own.filter(|(_, (_, part))| !scene.is_rigid(part.body as usize)).map(|(at, (peak, part))| PartStress {
        name: part.name.clone(),
        body: part.body as usize,
        now: peak.von_mises,
        before: before(at),
        unbounded: peak.unbounded.map(|place| place.to_string()),
        distrusted: distrusted(part.body as usize),
        place: peak.place.into(),
        displacement: peak.displacement.into(),
    });
    let [_, pressed] = scene.growth();
    Ok(summed_up(&scene.mesh.bodies, &own.collect::<Vec<_>>(), pressed, (status, &finer(case))))
}

/// What makes a mesh finer, in the terms of the case.
fn finer(case: &Case) -> String {
    match case.accuracy {
        Some(_) => "ask for a smaller error".into(),
        None => format!("take mesh.refine = {}", case.mesh.refine + 1),
    }
}

/// The largest stress of each body out of those of its parts, beside that by which heat would press.
fn summed_up(
    names: &[String],
    parts: &[PartStress],
    pressed: f64,
    (status, finer): (Status, &str),
) -> Vec<(String, BodySummary)> {
    let most = parts.iter().map(|part| part.now).fold(pressed, f64::max);
    let told = |part: &PartStress| {
        let verdict = stress_doubt(status, part, most, finer);
        let (von_mises_max, place, displacement) = (Some(part.now), Some(part.place), part.displacement);
        let is_believed = verdict.is_none();
        BodySummary { von_mises_max, place, displacement, is_believed, verdict, ..BodySummary::default() }
    };
    let body = |(body, name): (usize, &String)| {
        let own: Vec<&PartStress> = parts.iter().filter(|part| part.body == body).collect();
        let first = own.iter().max_by(|a, b| a.now.total_cmp(&b.now))?;
        if own.len() == 1 {
            return Some((name.clone(), told(first)));
        }
        let parts = own.iter().map(|part| (part.name.clone(), told(part))).collect();
        Some((name.clone(), BodySummary { part: Some(first.name.clone()), parts, ..told(first) }))
    };
    names.iter().enumerate().filter_map(body).collect()
}

/// What is known of the largest von Mises stress of a part.
#[derive(Default)]
struct PartStress {
    /// Name of the part.
    name: String,
    /// Number of its body.
    body: usize,
    /// Where the stress is, undeformed.
    place: [f64; 2],
    /// Displacement of that place.
    displacement: [f64; 2],
    /// How large it is (stress).
    now: f64,
    /// The same on the refinement before; nothing if none was solved.
    before: Option<f64>,
    /// Where the stress has no bound that is near, or is as large soon, in words.
    unbounded: Option<String>,
    /// Contacts of the body whose pressure is not trusted, in words.
    distrusted: Option<String>,
}

/// What speaks against a largest stress; nothing if it can be believed. `most` is the largest of all bodies, `finer` what makes the
/// mesh finer.
fn stress_doubt(status: Status, stress: &PartStress, most: f64, finer: &str) -> Option<String> {
    let PartStress { now, before, unbounded, distrusted, .. } = stress;
    match status {
        Status::NotConverged | Status::Interrupted => return Some("the run has not converged".into()),
        Status::Unresolved => return Some("the run is not resolved".into()),
        Status::Converged => {}
    }
    if *now <= STRESS_COUNTS * most {
        return None;
    }
    if let Some(place) = unbounded {
        return Some(format!("{place}, where the stress has no bound: it grows with each mesh"));
    }
    if let Some(contacts) = distrusted {
        return Some(format!("the pressure of contact {contacts} is not trusted"));
    }
    let Some(before) = before else {
        return Some(format!("nothing tells its error, since no coarser refinement was solved before; {finer}"));
    };
    let apart = (now - before).abs() / now;
    (apart > STRESS_APART).then(|| {
        let [apart, most] = [apart, STRESS_APART].map(|share| 100.0 * share);
        format!("on the refinement before it differs by {apart:.1} %, at most {most:.1} % wanted; {finer}")
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_body_has_the_stress_of_its_worst_part() {
        let part = |name: &str, body: usize, now: f64, unbounded: Option<&str>| PartStress {
            name: name.into(),
            body,
            now,
            before: Some(now),
            unbounded: unbounded.map(String::from),
            distrusted: None,
            place: [now, 0.0],
            displacement: [0.0, 1.0],
        };
        let parts = [part("core", 0, 3.0, None), part("film", 0, 5.0, Some("at a corner")), part("block", 2, 4.0, None)];
        let names = ["coated", "tool", "block"].map(String::from);
        let found = summed_up(&names, &parts, 0.0, (Status::Converged, "refine"));
        let [(first, coated), (second, block)] = &found[..] else { panic!("nothing of a tool: {found:?}") };
        assert_eq!((&first[..], &second[..]), ("coated", "block"), "in the order of the mesh");
        assert_eq!((coated.von_mises_max, coated.part.as_deref(), coated.is_believed), (Some(5.0), Some("film"), false));
        assert_eq!(coated.place, Some([5.0, 0.0]));
        assert!(
            coated.parts["core"].is_believed
                && coated.parts["film"] == BodySummary { part: None, parts: Default::default(), ..coated.clone() }
        );
        assert!(block.is_believed && block.part.is_none() && block.parts.is_empty() && block.verdict.is_none());
        assert_eq!((block.von_mises_max, block.displacement), (Some(4.0), [0.0, 1.0]));
        let hot = summed_up(&names, &parts, 1e9, (Status::Converged, "refine"));
        assert!(hot[0].1.is_believed, "stresses beside which heat presses by 1e9 are rounding");
    }

    #[test]
    fn a_stress_is_believed_where_it_has_a_bound_and_two_meshes_agree() {
        let doubt = |before: Option<f64>, unbounded: Option<&str>, most: f64| {
            let stress = PartStress { now: 100.0, before, unbounded: unbounded.map(String::from), ..PartStress::default() };
            stress_doubt(Status::Converged, &stress, most, "refine").unwrap_or_default()
        };
        assert_eq!(doubt(Some(104.0), None, 100.0), "");
        assert_eq!(doubt(Some(80.0), None, 100.0), "on the refinement before it differs by 20.0 %, at most 5.0 % wanted; refine");
        let words = "at the corner (2, 1), where the stress has no bound: it grows with each mesh";
        assert_eq!(doubt(Some(100.0), Some("at the corner (2, 1)"), 100.0), words);
        let pressed = PartStress { now: 1.0, before: Some(1.0), distrusted: Some("seam, foot".into()), ..PartStress::default() };
        let doubted = stress_doubt(Status::Converged, &pressed, 1.0, "").unwrap_or_default();
        assert_eq!(doubted, "the pressure of contact seam, foot is not trusted");
        assert!(doubt(None, None, 100.0).contains("nothing tells its error"));
        assert_eq!(doubt(None, Some("at a corner"), 1e9), "", "it is rounding beside that of other bodies");
    }

    #[test]
    fn no_stress_is_believed_of_a_run_that_cannot_be_used() {
        let stress = PartStress { now: 1.0, before: Some(1.0), ..PartStress::default() };
        for (status, words) in [(Status::NotConverged, "not converged"), (Status::Unresolved, "not resolved")] {
            assert!(stress_doubt(status, &stress, 1.0, "").expect("a doubt").contains(words));
        }
    }
}
