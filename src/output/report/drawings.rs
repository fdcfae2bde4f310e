//! The figures of a result, as they lie in its folder.

use std::fs;
use std::path::Path;

use super::page::ReportPage;
use crate::element::{MEASURES, StressMeasure};
use crate::output::markup::{figure, paragraph, subsection};
use crate::output::plot::stress_file;
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
    let along = [
        ("pressure", with("Contact pressure λ".into(), follow)),
        (
            "gap",
            with(
                format!("Gap between {one} and {two} after deformation"),
                ": zero where they touch, positive where they are apart.",
            ),
        ),
        ("displacement", format!("Normal displacements, positive from {one} to {two}.")),
    ];
    zooms.chain(along.iter().map(|(file, words)| drawing(folder, &format!("{file}_{name}.svg"), words))).collect()
}
