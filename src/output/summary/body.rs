//! What the summary says of a body: its largest stress.

use super::Summary;
use super::told::WORST;
use crate::geometry::{Coordinates, Rounded};
use serde::Serialize;
use std::collections::BTreeMap;

/// The largest von Mises stress of one body, or of a part of one.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct BodySummary {
    /// How large it is at the nodes (stress).
    pub von_mises_max: Option<f64>,
    /// The node, undeformed.
    pub place: Option<[f64; 2]>,
    /// Its displacement, for figures.
    #[serde(skip)]
    pub displacement: [f64; 2],
    /// The part that has it; the key is missing if the body has one part.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub part: Option<String>,
    /// Whether it can be believed.
    pub is_believed: bool,
    /// Why not; null if it can.
    pub verdict: Option<String>,
    /// The same of each part by its name; the key is missing if the body has one part.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub parts: BTreeMap<String, BodySummary>,
}

impl Summary {
    /// All bodies whose largest stress is known, with that, those with the largest first.
    pub fn most_stressed(&self) -> Vec<(&str, &BodySummary, f64)> {
        let known = |body: &BodySummary| body.von_mises_max.filter(|stress| stress.is_finite());
        let all = self.body.iter().filter_map(|(name, body)| Some((name.as_str(), body, known(body)?)));
        let mut all: Vec<(&str, &BodySummary, f64)> = all.collect();
        all.sort_by(|a, b| b.2.total_cmp(&a.2));
        all
    }

    /// The largest von Mises stress of each body, with what speaks against it; of many the largest ones, and how many cannot be
    /// believed.
    pub fn stresses_in_words(&self) -> Option<String> {
        let all = self.most_stressed();
        let one = |(name, body, stress): &(&str, &BodySummary, f64)| {
            let place = body.place.map_or(String::new(), |place| format!(" at {}", Coordinates(place.into())));
            let against = body.verdict.as_ref().map_or(String::new(), |words| format!(" (not to be believed: {words})"));
            format!("{name} {}{}{place}{against}", Rounded(*stress), self.units.stress().after())
        };
        let told: Vec<String> = all.iter().take(WORST).map(one).collect();
        let of = if all.len() > WORST { format!(" of {} bodies", all.len()) } else { String::new() };
        let doubted = all.iter().filter(|(_, body, _)| !body.is_believed).count();
        let others = match (all.len() > WORST, doubted) {
            (false, _) => String::new(),
            (true, 0) => "; the others have less".into(),
            (true, doubted) => format!("; the others have less, and {doubted} of all cannot be believed"),
        };
        (!told.is_empty()).then(|| format!("largest von Mises stress{of}: {}{others}", told.join("; ")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::units::Units;

    fn summary(stresses: &[(&str, f64, Option<&str>)]) -> Summary {
        let body = |(name, stress, against): &(&str, f64, Option<&str>)| {
            let verdict = against.map(String::from);
            let (von_mises_max, place) = (Some(*stress), Some([2.0, 1.0 / 3.0]));
            let body = BodySummary { von_mises_max, place, is_believed: verdict.is_none(), verdict, ..BodySummary::default() };
            (name.to_string(), body)
        };
        Summary { body: stresses.iter().map(body).collect(), ..Summary::default() }
    }

    #[test]
    fn three_bodies_are_told_one_by_one_and_more_are_summed_up() {
        assert_eq!(summary(&[]).stresses_in_words(), None);
        assert_eq!(summary(&[("one", f64::NAN, None)]).stresses_in_words(), None, "nothing is known");
        let two = summary(&[("block", 12.3456789, None), ("punch", 400.0, Some("it grows"))]);
        let words =
            "largest von Mises stress: punch 400 at (2, 0.333333) (not to be believed: it grows); block 12.3457 at (2, 0.333333)";
        assert_eq!(two.stresses_in_words().as_deref(), Some(words));
        let many = summary(&[("a", 1.0, None), ("b", 4.0, Some("x")), ("c", 3.0, None), ("d", 2.0, None), ("e", 0.5, Some("y"))]);
        let words = many.stresses_in_words().expect("five bodies");
        let named = Summary { units: Units::new(Some("m"), Some("N"), false), ..two };
        assert!(named.stresses_in_words().expect("two bodies").contains("punch 400 Pa at (2, 0.333333)"));
        assert!(words.starts_with("largest von Mises stress of 5 bodies: b 4 at"), "{words}");
        assert!(words.ends_with("d 2 at (2, 0.333333); the others have less, and 2 of all cannot be believed"), "{words}");
    }
}
