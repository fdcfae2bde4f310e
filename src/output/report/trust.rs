//! What can be trusted of a result, and how large its errors are thought to be.

use super::numbers::{number, trust_word};
use super::page::ReportPage;
use crate::output::markup::{UNKNOWN, list, paragraph, subsection, table};
use crate::output::plot::number_text;
use crate::output::summary::{Status, ZoneSummary};

/// The word on each contact, and what was warned of.
pub fn trust(page: &ReportPage) -> String {
    let summary = page.summary;
    let mut text = String::new();
    if summary.status != Status::Converged && summary.contact.is_empty() {
        text += &paragraph("There is no solution, so there is nothing to trust.");
    }
    let row = |(name, _): &(String, [String; 2])| {
        let contact = summary.contact.get(name)?;
        let estimate = summary.estimate.contact.get(name);
        Some(vec![
            name.clone(),
            trust_word(contact.judged.trust),
            trust_word(contact.judged.trust_force),
            number(estimate.and_then(|estimate| estimate.lambda)),
            number(estimate.and_then(|estimate| estimate.force)),
            number(contact.inf_sup),
            number(contact.oscillation),
            number(contact.closed_edges),
        ])
    };
    let rows: Vec<Vec<String>> = page.told().filter_map(row).collect();
    let header = [
        "contact",
        "pressure",
        "force",
        "error of λ",
        "error of the force",
        "inf-sup constant",
        "oscillation",
        "edges in contact",
    ];
    text += &table(&header, &rows);
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
    let mut rows = Vec::new();
    for (name, contact) in summary.contacts_told() {
        let counting = contact.zones.iter().filter(|zone| zone.counts(&contact.zones));
        rows.extend(counting.map(|zone| row(name, zone)));
    }
    let header = [
        "contact",
        "zone, s",
        "share of the force",
        "λ in its middle",
        "λ all over it",
        "largest λ",
        "its force",
        "edges",
        "segments",
    ];
    let zones = table(&header, &rows);
    if zones.is_empty() && energy.is_none() {
        return String::new();
    }
    let words = "Relative errors of what presses, zone by zone. The error of λ in the middle is a root mean square over the middle \
                 60 % of a zone, and summary.json has the worst of them as estimate.NAME.lambda: it says nothing of the ends. The \
                 largest λ has an estimate of its own, which counts where the peak is at an end, as on a plane of symmetry; there \
                 is none where λ grows without bound.";
    energy.unwrap_or_default() + &if zones.is_empty() { zones } else { paragraph(words) + &zones }
}

fn row(name: &str, zone: &ZoneSummary) -> Vec<String> {
    let peak = if zone.singular == Some(true) { "without bound".into() } else { number(zone.peak) };
    vec![
        name.to_owned(),
        zone.ends.map_or(UNKNOWN.into(), |[from, to]| format!("{} to {}", number_text(from), number_text(to))),
        number(zone.share),
        number(zone.lambda),
        number(zone.whole),
        peak,
        number(zone.force),
        number(zone.edges),
        zone.segments.map_or(UNKNOWN.into(), |segments| segments.to_string()),
    ]
}
