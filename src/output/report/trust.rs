//! What can be trusted of a result, and how large its errors are thought to be.

use super::page::{ReportPage, TableColumn, number, table_of, trust_word};
use crate::output::markup::{UNKNOWN, list, paragraph, subsection};
use crate::output::plot::number_text;
use crate::output::summary::{ContactEstimate, ContactSummary, Status, ZoneSummary};

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
