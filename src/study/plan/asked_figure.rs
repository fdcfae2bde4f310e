//! The figure that a study asks for, by names of columns.

use super::summary_path::{ONLY, SummaryPath};
use crate::case::listed;
use crate::case::section::Section;

/// Columns of every study.
const WORDS: [&str; 7] = ["case", "curve", "ranks", "unknowns", "multipliers", "krylov_iterations", "outer_iterations"];

/// Figures of a contact, which mean those of the only contact of a case.
const OF_CONTACT: [&str; 5] = ["force", "pressure_max", "approach", "slip", "oscillation"];

/// Whole names of the columns that `figure` means; those that are places in `summary.json` join `columns`, beside `others` that the
/// study asks for. Empty if the log knows what is wrong.
pub fn asked_columns(
    root: &Section,
    names: &[String],
    keys: &[String],
    others: &[SummaryPath],
    columns: &mut Vec<SummaryPath>,
) -> Vec<String> {
    let known: Vec<&str> = WORDS.into_iter().chain(keys.iter().map(String::as_str)).collect();
    let places: Vec<SummaryPath> = others.iter().chain(columns.iter()).cloned().collect();
    let all = || names.iter().map(|name| column(name, &known, &places)).collect();
    let found: Vec<String> = root.made("figure", Some(()), |()| all()).unwrap_or_default();
    for name in found.iter().filter(|name| !known.contains(&name.as_str())) {
        let place = SummaryPath::parse(name).ok().filter(|place| !columns.contains(place));
        columns.extend(place);
    }
    found
}

/// The whole name of a column by that, or by its last part.
fn column(name: &str, known: &[&str], places: &[SummaryPath]) -> Result<String, String> {
    let all = || known.iter().copied().chain(places.iter().map(|place| place.text.as_str()));
    let mut same: Vec<&str> = all().filter(|other| other.strip_suffix(name).is_some_and(|rest| rest.ends_with('.'))).collect();
    same.sort_unstable();
    same.dedup();
    match same[..] {
        _ if all().any(|other| other == name) => Ok(name.into()),
        [one] => Ok(one.into()),
        [] if name.contains('.') => SummaryPath::parse(name).map(|place| place.text),
        [] if OF_CONTACT.contains(&name) => Ok(SummaryPath::new(&["contact", ONLY, name]).text),
        [] => {
            Err(format!("there is no column {name}; there are {}, and any path in summary.json", listed(all().map(String::from))))
        }
        _ => Err(format!("{name} may be {}; write out which", same.join(" or "))),
    }
}
