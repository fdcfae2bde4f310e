//! The largest stress of each body, and whether it can be believed.

use super::page::{ReportPage, long_table, number, trust_word};
use crate::output::markup::{UNKNOWN, paragraph};
use crate::output::plot::number_to;
use crate::output::summary::{BodySummary, Status, capital};

/// A line on the bodies, and a table of all of them, the largest stress first.
pub fn stresses(page: &ReportPage) -> String {
    let summary = page.summary;
    let row = |name: &str, part: Option<&str>, body: &BodySummary| {
        let [x, y] = [0, 1].map(|axis| number(body.place.map(|place| place[axis])));
        vec![
            name.to_owned(),
            part.unwrap_or(UNKNOWN).to_owned(),
            body.von_mises_max.map_or(UNKNOWN.into(), |stress| number_to(6, stress)),
            x,
            y,
            trust_word(Some(body.is_believed)),
            body.verdict.clone().unwrap_or_default(),
        ]
    };
    let all = summary.most_stressed();
    let rows = all.iter().flat_map(|(name, body, _)| match body.parts.is_empty() {
        true => vec![row(name, None, body)],
        false => body.parts.iter().map(|(part, own)| row(name, Some(part), own)).collect(),
    });
    let largest = summary.units.stress().of("largest von Mises stress");
    let [x, y] = ["x", "y"].map(|what| summary.units.length().of(what));
    let header = ["body", "part", &largest, &x, &y, "", "why not"];
    let table = long_table(&header, rows.collect(), "summary.json");
    let words = summary.stresses_in_words().filter(|_| summary.status == Status::Converged);
    words.map_or(String::new(), |words| paragraph(&format!("{}.", capital(&words)))) + &table
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::summary::Summary;
    use crate::output::units::Units;

    #[test]
    fn bodies_and_parts_have_a_row_each() {
        let of = |stress: f64, against: Option<&str>| BodySummary {
            von_mises_max: Some(stress),
            place: Some([1.0, 2.0]),
            is_believed: against.is_none(),
            verdict: against.map(String::from),
            ..BodySummary::default()
        };
        let coated = BodySummary {
            part: Some("film".into()),
            parts: [("core".into(), of(3.0, None)), ("film".into(), of(70.0, Some("it grows")))].into(),
            ..of(70.0, Some("it grows"))
        };
        let body = [("block".into(), of(12.5, None)), ("coated".into(), coated)].into();
        let summary = Summary { status: Status::Converged, body, ..Summary::default() };
        let page = ReportPage { title: "", summary: &summary, expected: &[], contacts: &[], warnings: &[], case: "" };
        let text = stresses(&page);
        assert!(
            text.contains("Largest von Mises stress: coated 70 at (1, 2) (not to be believed: it grows); block 12.5"),
            "{text}"
        );
        assert_eq!((text.matches("<tr>").count(), text.matches("it grows").count()), (4, 2), "{text}");
        let named = Summary { units: Units::new(Some("mm"), Some("N"), false), ..summary.clone() };
        let text = stresses(&ReportPage { summary: &named, ..page });
        assert!(
            text.contains("largest von Mises stress [MPa]") && text.contains("x [mm]") && text.contains("coated 70 MPa"),
            "{text}"
        );
        let nothing = Summary::default();
        assert_eq!(stresses(&ReportPage { summary: &nothing, ..page }), "");
    }
}
