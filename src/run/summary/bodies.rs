//! The largest stress of each body.

use crate::case::Case;
use crate::output::plot::DrawnPeak;
use crate::output::summary::{BodySummary, ContactSummary, Status, Summary};
use crate::procedure::Solved;
use crate::recovery::Evaluation;
use crate::run::outcome::RunError;
use crate::run::verdict::largest_stress::{PartStress, stress_doubt};
use std::collections::BTreeMap;

/// The largest von Mises stress of each body that is no rigid tool.
pub struct LargestStresses {
    /// By name of the body.
    pub bodies: BTreeMap<String, BodySummary>,
    /// The same as figures show it.
    pub drawn: Vec<DrawnPeak>,
}

/// The same of one part.
struct OfPart {
    name: String,
    body: usize,
    stress: PartStress,
    place: [f64; 2],
    displacement: [f64; 2],
}

/// Looks for the largest stresses of a solution with this summary so far, and of this status. **Collective**
///
/// # Errors
/// PETSc fails.
pub fn largest_stresses(
    found: &Evaluation,
    solved: &Solved,
    case: &Case,
    (summary, status): (&Summary, Status),
) -> Result<LargestStresses, RunError> {
    let scene = &found.problem.scene;
    let grows = |name: &String| summary.contact.get(name).is_some_and(ContactSummary::is_singular);
    let grows: Vec<bool> = found.problem.contacts.iter().map(|contact| grows(&contact.pair.name)).collect();
    let before = |part: usize| solved.coarse_stress.as_ref().map(|all| all[part]);
    let own = found.stress_peaks(&grows)?.into_iter().zip(&scene.mesh.parts).enumerate();
    let own = own.filter(|(_, (_, part))| !scene.is_rigid(part.body as usize)).map(|(at, (peak, part))| OfPart {
        name: part.name.clone(),
        body: part.body as usize,
        stress: PartStress { now: peak.von_mises, before: before(at), unbounded: peak.unbounded.map(|place| place.to_string()) },
        place: peak.place.into(),
        displacement: peak.displacement.into(),
    });
    Ok(summed_up(&scene.mesh.bodies, &own.collect::<Vec<_>>(), status, &finer(case)))
}

/// What makes a mesh finer, in the terms of the case.
fn finer(case: &Case) -> String {
    match case.accuracy {
        Some(_) => "ask for a smaller error".into(),
        None => format!("take mesh.refine = {}", case.mesh.refine + 1),
    }
}

/// The largest stress of each body out of those of its parts.
fn summed_up(names: &[String], parts: &[OfPart], status: Status, finer: &str) -> LargestStresses {
    let most = parts.iter().map(|part| part.stress.now).fold(0.0, f64::max);
    let told = |part: &OfPart| {
        let verdict = stress_doubt(status, &part.stress, most, finer);
        let (von_mises_max, place) = (Some(part.stress.now), Some(part.place));
        BodySummary { von_mises_max, place, is_believed: verdict.is_none(), verdict, ..BodySummary::default() }
    };
    let mut all = LargestStresses { bodies: BTreeMap::new(), drawn: Vec::new() };
    for (body, name) in names.iter().enumerate() {
        let own: Vec<&OfPart> = parts.iter().filter(|part| part.body == body).collect();
        let Some(first) = own.iter().max_by(|a, b| a.stress.now.total_cmp(&b.stress.now)) else { continue };
        let of_parts = own.iter().filter(|_| own.len() > 1).map(|part| (part.name.clone(), told(part)));
        let part = (own.len() > 1).then(|| first.name.clone());
        let summary = BodySummary { part, parts: of_parts.collect(), ..told(first) };
        let OfPart { stress: PartStress { now: von_mises, .. }, place, displacement, .. } = **first;
        all.drawn.push(DrawnPeak { place, displacement, von_mises, is_believed: summary.is_believed });
        all.bodies.insert(name.clone(), summary);
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_body_has_the_stress_of_its_worst_part() {
        let part = |name: &str, body: usize, now: f64, unbounded: Option<&str>| OfPart {
            name: name.into(),
            body,
            stress: PartStress { now, before: Some(now), unbounded: unbounded.map(String::from) },
            place: [now, 0.0],
            displacement: [0.0, 1.0],
        };
        let parts = [part("core", 0, 3.0, None), part("film", 0, 5.0, Some("at a corner")), part("block", 2, 4.0, None)];
        let names = ["coated", "tool", "block"].map(String::from);
        let found = summed_up(&names, &parts, Status::Converged, "refine");
        assert_eq!(found.bodies.keys().collect::<Vec<_>>(), ["block", "coated"], "nothing of a tool");
        let coated = &found.bodies["coated"];
        assert_eq!((coated.von_mises_max, coated.part.as_deref(), coated.is_believed), (Some(5.0), Some("film"), false));
        assert_eq!(coated.place, Some([5.0, 0.0]));
        assert!(
            coated.parts["core"].is_believed
                && coated.parts["film"] == BodySummary { part: None, parts: BTreeMap::new(), ..coated.clone() }
        );
        let block = &found.bodies["block"];
        assert!(block.is_believed && block.part.is_none() && block.parts.is_empty() && block.verdict.is_none());
        assert_eq!(
            found.drawn.iter().map(|peak| (peak.von_mises, peak.is_believed)).collect::<Vec<_>>(),
            [(5.0, false), (4.0, true)]
        );
    }
}
