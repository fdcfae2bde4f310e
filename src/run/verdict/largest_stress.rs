//! Whether the largest stress of a body can be believed.

use crate::output::summary::Status;
use crate::run::verdict::limits::{STRESS_APART, STRESS_COUNTS};

/// What is known of the largest von Mises stress of a part.
#[derive(Default)]
pub struct PartStress {
    /// Name of the part.
    pub name: String,
    /// Number of its body.
    pub body: usize,
    /// Where the stress is, undeformed.
    pub place: [f64; 2],
    /// Displacement of that place.
    pub displacement: [f64; 2],
    /// How large it is (stress).
    pub now: f64,
    /// The same on the refinement before; nothing if none was solved.
    pub before: Option<f64>,
    /// Where the stress has no bound that is near, or is as large soon, in words.
    pub unbounded: Option<String>,
    /// Contacts of the body whose pressure is not trusted, in words.
    pub distrusted: Option<String>,
}

/// What speaks against a largest stress; nothing if it can be believed. `most` is the largest of all bodies, `finer` what makes the
/// mesh finer.
pub fn stress_doubt(status: Status, stress: &PartStress, most: f64, finer: &str) -> Option<String> {
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
