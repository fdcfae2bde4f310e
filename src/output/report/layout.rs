//! The page as a whole.

use std::path::Path;

use super::page::ReportPage;
use super::{drawings, history, numbers, trust, verdict};
use crate::output::data::write_text;
use crate::output::error::OutputError;
use crate::output::markup::{document, escape, header, section, verbatim};

/// Writes `report.html` into the folder of a result, with the figures that are there.
///
/// # Errors
/// The operating system refuses.
pub fn write_report(folder: &Path, page: &ReportPage) -> Result<(), OutputError> {
    write_text(&folder.join("report.html"), &html(folder, page))
}

/// The text of the page.
fn html(folder: &Path, page: &ReportPage) -> String {
    let summary = page.summary;
    let title = if page.title.is_empty() { &summary.case } else { page.title };
    let sections = [
        ("figures", "Figures", drawings::of_solution(folder, page)),
        ("contacts", "Contacts", numbers::contacts(page)),
        ("trust", "What can be trusted", trust::trust(page)),
        ("estimate", "Estimated errors", trust::estimate(page)),
        ("history", "How it went", history::history(folder, page)),
        ("forces", "Forces and balances", numbers::forces(page)),
        ("stresses", "Largest stresses", trust::stresses(page)),
        ("points", "Points", numbers::points(page)),
        ("effort", "Mesh, solver, time", numbers::effort(page)),
        ("provenance", "Where it comes from", numbers::provenance(page)),
        ("case", "The case as it ran", verbatim(page.case)),
    ];
    let shown: Vec<_> = sections.iter().filter(|(_, _, text)| !text.is_empty()).collect();
    let links: String = shown.iter().map(|(place, name, _)| format!("<a href=\"#{place}\">{}</a>\n", escape(name))).collect();
    let body: String = shown.iter().map(|(place, name, text)| section(place, name) + text).collect();
    let header = header(&format!("Case {}, mezha {}", summary.case, summary.mezha), title);
    let (name, verdict) = (format!("{title}: {}", verdict::word(summary.status)), verdict::verdict(page));
    document(&name, &format!("{header}{verdict}<nav>\n{links}</nav>\n{body}"))
}

#[cfg(test)]
mod tests;
