//! What can be trusted of a result: the pressure of each contact, how large its errors are thought to be, and the largest stress of each
//! body.

use super::page::{ReportPage, TableColumn, long_table, number, table_of, trust_word};
use crate::output::markup::{UNKNOWN, list, paragraph, subsection};
use crate::output::plot::{number_text, number_to};
use crate::output::summary::{BodySummary, ContactEstimate, ContactSummary, Status, ZoneSummary, capital};

/// The word on each contact, and what was warned of.
pub fn trust(page: &ReportPage) -> String {
    let summary = page.summary;
    let mut text = String::new();
    if summary.status != Status::Converged && summary.contact.is_empty() {
        text += &paragraph("There is no solution, so there is nothing to trust.");
    }
    let told = page.told().filter_map(|(name, _)| Some((name, summary.contact.get(name)?, summary.estimate.contact.get(name))));
    let columns: [TableColumn<(&String, &ContactSummary, Option<&ContactEstimate>)>; 8] = [
        ("contact", &|(name, ..)| (*name).clone()),
        ("pressure", &|(_, contact, _)| trust_word(contact.judged.trust)),
        ("force", &|(_, contact, _)| trust_word(contact.judged.trust_force)),
        ("error of λ", &|(.., estimate)| number(estimate.and_then(|estimate| estimate.lambda))),
        ("error of the force", &|(.., estimate)| number(estimate.and_then(|estimate| estimate.force))),
        ("inf-sup constant", &|(_, contact, _)| number(contact.inf_sup)),
        ("oscillation", &|(_, contact, _)| number(contact.oscillation)),
        ("edges in contact", &|(_, contact, _)| number(contact.closed_edges)),
    ];
    text += &table_of(&columns, told, None);
    if !page.warnings.is_empty() {
        text += &subsection("Warnings");
        text += &list(page.warnings);
    }
    text
}

/// Estimated errors, and what each of them is of.
pub fn estimate(page: &ReportPage) -> String {
    let summary = page.summary;
    let energy = summary.estimate.energy.map(|error| {
        paragraph(&format!("The displacement of all bodies has an estimated error of {} in the energy norm.", number_text(error)))
    });
    let counting =
        summary.contacts_told().flat_map(|(name, contact)| ZoneSummary::counting(&contact.zones).map(move |zone| (name, zone)));
    let ends = |[from, to]: [f64; 2]| format!("{} to {}", number_text(from), number_text(to));
    let peak = |zone: &ZoneSummary| if zone.singular == Some(true) { "without bound".into() } else { number(zone.peak) };
    let columns: [TableColumn<(&str, &ZoneSummary)>; 9] = [
        ("contact", &|(name, _)| (*name).to_owned()),
        ("zone, s", &|(_, zone)| zone.ends.map_or(UNKNOWN.into(), ends)),
        ("share of the force", &|(_, zone)| number(zone.share)),
        ("λ in its middle", &|(_, zone)| number(zone.lambda)),
        ("λ all over it", &|(_, zone)| number(zone.whole)),
        ("largest λ", &|(_, zone)| peak(zone)),
        ("its force", &|(_, zone)| number(zone.force)),
        ("edges", &|(_, zone)| number(zone.edges)),
        ("segments", &|(_, zone)| zone.segments.map_or(UNKNOWN.into(), |segments| segments.to_string())),
    ];
    let zones = table_of(&columns, counting, None);
    if zones.is_empty() && energy.is_none() {
        return String::new();
    }
    let words = "Relative errors of what presses, zone by zone. The error of λ in the middle is a root mean square over the middle \
                 60 % of a zone, and summary.json has the worst of them as estimate.NAME.lambda: it says nothing of the ends. The \
                 largest λ has an estimate of its own, which counts where the peak is at an end, as on a plane of symmetry; there \
                 is none where λ grows without bound.";
    energy.unwrap_or_default() + &if zones.is_empty() { zones } else { paragraph(words) + &zones }
}

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
