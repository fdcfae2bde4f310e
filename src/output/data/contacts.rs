//! All contacts as a table, one row each.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;

use super::number_cell;
use super::quoted;
use crate::output::error::OutputError;
use crate::output::summary::Summary;

/// Name of the table in a result folder.
pub const CONTACTS: &str = "contacts.csv";

/// A resultant below this share of the force is rounding, as that of a pressure all around: it has no direction.
const ROUNDING: f64 = 1e-6;

const COLUMNS: &str = "name,boundary_1,boundary_2,force,direction_x,direction_y,x,y,width,pressure_max,trust,verdict";

/// Writes `contacts.csv`: a line with the names of the columns, and one for each contact of the summary, given by its name and its
/// two boundaries. What is not known, or does not apply, is left empty.
///
/// # Errors
/// The operating system refuses.
pub fn write_contacts<'a>(
    path: &Path,
    contacts: impl Iterator<Item = (&'a str, &'a [String; 2])>,
    summary: &Summary,
) -> Result<(), OutputError> {
    File::create(path)
        .and_then(|file| write_rows(BufWriter::new(file), contacts, summary))
        .map_err(OutputError::io("write", path))
}

fn write_rows<'a>(
    mut out: impl Write,
    contacts: impl Iterator<Item = (&'a str, &'a [String; 2])>,
    summary: &Summary,
) -> std::io::Result<()> {
    writeln!(out, "{COLUMNS}")?;
    for (name, between) in contacts {
        let Some(contact) = summary.contact.get(name) else { continue };
        let least = ROUNDING * contact.force.unwrap_or(0.0).abs();
        let size = contact.resultant.map(|[x, y]| x.hypot(y)).filter(|size| *size > least);
        let along = |axis: usize| Some(contact.resultant?[axis] / size?);
        let place = |axis: usize| contact.place.map(|place| place[axis]);
        let numbers = [contact.force, along(0), along(1), place(0), place(1), contact.width(), contact.pressure_max];
        write!(out, "{},{},{}", quoted(name), quoted(&between[0]), quoted(&between[1]))?;
        for number in numbers {
            write!(out, ",{}", number_cell(number))?;
        }
        let trust = contact.judged.trust.map_or(String::new(), |trust| trust.to_string());
        writeln!(out, ",{trust},{}", quoted(contact.judged.verdict.as_deref().unwrap_or_default()))?;
    }
    out.flush()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::summary::{ContactSummary, ContactTrust};
    use proptest::prelude::*;

    #[test]
    fn a_pressure_all_around_has_no_direction() {
        let cells = |resultant: [f64; 2]| {
            let contact = ContactSummary { force: Some(2.0), resultant: Some(resultant), ..ContactSummary::default() };
            let summary = Summary { contact: [("c".to_owned(), contact)].into(), ..Summary::default() };
            let between = ["a".to_owned(), "b".to_owned()];
            let mut text = Vec::new();
            write_rows(&mut text, [("c", &between)].into_iter(), &summary).unwrap();
            let text = String::from_utf8(text).unwrap();
            let row: Vec<String> = text.lines().nth(1).expect("a row").split(',').map(String::from).collect();
            [row[4].clone(), row[5].clone()]
        };
        assert_eq!(cells([0.0, -1e-9]), ["", ""]);
        assert_eq!(cells([0.0, -1e-3]).map(|cell| cell.parse::<f64>().expect("a number")), [0.0, -1.0]);
    }

    proptest! {
        #[test]
        fn a_row_reads_back_as_the_contact_was(
            force in proptest::array::uniform2(-1e9..1e9), place in proptest::array::uniform2(-1e-9..1e9),
            closed in proptest::collection::vec(0.0..1.0, 0..4), trust in proptest::option::of(proptest::bool::ANY)
        ) {
            let contact = ContactSummary {
                force: Some(f64::hypot(force[0], force[1])),
                resultant: Some(force),
                place: Some(place),
                closed: Some(closed.iter().map(|width| [3.0, 3.0 + width]).collect()),
                judged: ContactTrust { trust, verdict: Some("not trusted: \"a\"; b".into()), ..ContactTrust::default() },
                ..ContactSummary::default()
            };
            let summary = Summary { contact: [("a,b".to_owned(), contact.clone())].into(), ..Summary::default() };
            let between = ["one.rim".to_owned(), "two \"x\"".to_owned()];
            let mut text = Vec::new();
            write_rows(&mut text, [("a,b", &between), ("none", &between)].into_iter(), &summary).unwrap();
            let text = String::from_utf8(text).unwrap();
            let lines: Vec<&str> = text.lines().collect();
            prop_assert_eq!(lines.len(), 2, "what is not solved has no row");
            let rest = lines[1].strip_prefix("\"a,b\",one.rim,\"two \"\"x\"\"\",").expect("names");
            let cells: Vec<&str> = rest.splitn(9, ',').collect();
            let number = |at: usize| cells[at].parse::<f64>().expect("a number");
            prop_assert_eq!(number(0), contact.force.unwrap());
            prop_assert!((number(1) * number(0) - force[0]).abs() <= 1e-6 && (number(2) * number(0) - force[1]).abs() <= 1e-6);
            prop_assert_eq!([number(3), number(4), number(5)], [place[0], place[1], contact.width().unwrap()]);
            prop_assert_eq!((cells[6], cells[7]), ("", trust.map_or("", |trust| if trust { "true" } else { "false" })));
            prop_assert_eq!(cells[8], "\"not trusted: \"\"a\"\"; b\"");
        }
    }
}
