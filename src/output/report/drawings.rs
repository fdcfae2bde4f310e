//! The figures of a result, as they lie in its folder.

use std::fs;
use std::path::Path;

use super::page::{ReportPage, number};
use crate::element::{MEASURES, StressMeasure};
use crate::output::markup::{figure, paragraph, subsection};
use crate::output::plot::{number_text, stress_file};
use crate::output::summary::{MOST_WITH_FIGURES, Status};

/// The text of a figure with a caption; nothing if there is no such figure.
pub fn drawing(folder: &Path, name: &str, words: &str) -> String {
    match fs::read_to_string(folder.join(name)) {
        Ok(svg) if svg.starts_with("<svg ") => figure(&svg, words),
        _ => String::new(),
    }
}

/// Bodies, zooms, and what happens along each contact.
pub fn of_solution(folder: &Path, page: &ReportPage) -> String {
    let summary = page.summary;
    let mut all = drawing(
        folder,
        "deformed.svg",
        "The deformed bodies, coloured by von Mises stress; displacements are drawn larger than they are by the factor above.",
    );
    for measure in MEASURES {
        let words = match measure {
            StressMeasure::Shear => {
                "The same bodies, coloured by half of the largest difference between any two of the three principal stresses."
            }
            _ => "The same bodies, coloured by the stress that the bar names; tension is positive.",
        };
        all += &drawing(folder, &stress_file(measure), words);
    }
    for (at, (name, _)) in page.told().enumerate() {
        let own = of_contact(folder, page, name, at == 0);
        if !own.is_empty() {
            all += &subsection(&format!("Contact {name}"));
            all += &own;
        }
    }
    let left = page.contacts.len() - page.told().count();
    if left > 0 && !all.is_empty() {
        let others = match page.contacts.len() > MOST_WITH_FIGURES {
            true => format!("the {left} others have none, but a contact_NAME.csv each"),
            false => format!("the figures of {left} others lie beside this page"),
        };
        let words = format!("These are the contacts that are trusted least, and those with the largest forces; {others}.");
        all += &paragraph(&words);
    }
    let steps = summary.steps.as_ref().filter(|_| !all.is_empty() && summary.status != Status::Interrupted);
    let last = steps.and_then(|steps| steps.last());
    let words = last.map(|last| format!("<p class=\"soft\">All of this is load step {}, the last one.</p>\n", last.step));
    words.unwrap_or_default() + &all
}

/// The figures of one contact: each interval that presses, then λ, gap and displacements all along it. What holds of all contacts
/// stands at the first of them.
fn of_contact(folder: &Path, page: &ReportPage, name: &str, is_first: bool) -> String {
    let [one, two] = page.bodies(name);
    let intervals = page.summary.contact.get(name).and_then(|contact| contact.closed.as_ref()).map_or(0, Vec::len);
    let with = |words: String, more: &str| if is_first { words + more } else { words + "." };
    let zooms = (1..=intervals).map(|number| {
        let words = if intervals == 1 { "Where it presses".into() } else { format!("Interval {number} of those that press") };
        let more = ", with displacements as they are. The blue line is the contact pressure, upon the boundary.";
        drawing(folder, &format!("deformed_{name}_{number}.svg"), &with(words, if number == 1 { more } else { "." }))
    });
    let follow = ", and the normal pressures of both bodies on it: they follow λ where the meshes are fine enough.";
    let gap = format!("Gap between {one} and {two} after deformation");
    let along = [
        ("pressure", with("Contact pressure λ".into(), follow) + &exactness(page, name, is_first)),
        ("gap", with(gap, ": zero where they touch, positive where they are apart.")),
        ("displacement", format!("Normal displacements, positive from {one} to {two}.")),
    ];
    zooms.chain(along.iter().map(|(file, words)| drawing(folder, &format!("{file}_{name}.svg"), words))).collect()
}

/// What is told of the errors of a pressure, at the first contact with words on what they are of, in a sentence that begins with a
/// space.
fn exactness(page: &ReportPage, name: &str, is_first: bool) -> String {
    let known = page.summary.contact.get(name).zip(page.summary.estimate.contact.get(name));
    let Some((contact, (error, estimate))) = known.and_then(|(contact, all)| Some((contact, (all.lambda?, all)))) else {
        return String::new();
    };
    let value = number(contact.pressure_max) + &page.summary.units.stress().after();
    let jumps = match contact.multiplier.as_deref() {
        Some("p1-continuous") | None => "",
        _ => " is the higher of both values where λ jumps, and",
    };
    let peak = match estimate.peak {
        _ if contact.is_singular() => "grows without bound as meshes become finer".into(),
        Some(peak) => format!("has an error of its own, {}", number_text(peak)),
        None => "has no estimate of its error".into(),
    };
    let error = number_text(error);
    if !is_first {
        return format!(" The error of the pressure is {error}; the largest λ, {value}, {peak}.");
    }
    format!(
        " The error of the pressure, {error}, is a root mean square over the middle 60 % of each zone that presses; the largest λ, {value},{jumps} {peak}."
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::summary::{ContactEstimate, ContactSummary, Summary, ZoneSummary};

    #[test]
    fn the_errors_of_a_pressure_are_explained_beside_its_figure() {
        let told = |is_first: bool, multiplier: &str, singular: bool, estimate: ContactEstimate| {
            let zones = vec![ZoneSummary { singular: Some(singular), singular_at_end: Some(singular), ..ZoneSummary::default() }];
            let multiplier = Some(multiplier.to_owned());
            let contact = ContactSummary { pressure_max: Some(231.6), multiplier, zones, ..ContactSummary::default() };
            let mut summary = Summary { contact: [("seam".to_owned(), contact)].into(), ..Summary::default() };
            summary.estimate.contact.insert("seam".into(), estimate);
            let page = ReportPage { title: "", summary: &summary, expected: &[], contacts: &[], warnings: &[], case: "" };
            exactness(&page, "seam", is_first)
        };
        let words = |multiplier: &str, singular, estimate| told(true, multiplier, singular, estimate);
        let known = |peak| ContactEstimate { lambda: Some(7.9e-3), peak, ..ContactEstimate::default() };
        assert_eq!(
            words("p1-discontinuous", false, known(Some(2e-3))),
            " The error of the pressure, 0.0079, is a root mean square over the middle 60 % of each zone that presses; the largest λ, 231.6, is the higher of both values where λ jumps, and has an error of its own, 0.002."
        );
        assert!(
            words("p1-continuous", true, known(None))
                .ends_with("the largest λ, 231.6, grows without bound as meshes become finer.")
        );
        assert!(words("p0", false, known(None)).ends_with("where λ jumps, and has no estimate of its error."));
        assert_eq!(words("p0", false, ContactEstimate::default()), "");
        assert_eq!(
            told(false, "p0", false, known(Some(2e-3))),
            " The error of the pressure is 0.0079; the largest λ, 231.6, has an error of its own, 0.002."
        );
    }
}
