//! The study file: TOML text to a checked list of runs.

pub(super) mod planned;
pub(super) mod summary_path;

use std::ops::Range;
use std::path::Path;
use std::time::Duration;

use toml::Value;

use crate::case::error::{CaseError, dotted};
use crate::case::overrides::{overridden, read_key};
use crate::case::schema::STUDY;
use crate::case::schema::study::{ALONG, CASES, COLUMNS, ERROR, FIGURE, RANKS, REPEAT, TIME, TIMEOUT};
use crate::case::section::{Section, read_whole};
use crate::case::{Case, listed, name_of, read_text, values};

use planned::{Moves, PlannedCase, PlannedRun, StudyCurve, read_curve, read_grid, read_set};
use summary_path::{ONLY, SummaryPath};

/// A checked study: what is run, and what is asked of each result.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Name of the folder if the file is called `study.toml`, else the file's stem.
    pub name: String,
    /// Dotted keys of all grids, in the order of the file.
    pub keys: Vec<String>,
    /// Where the errors stand in `summary.json`, each an axis; the first one is the column `error`.
    pub errors: Vec<SummaryPath>,
    /// Where the time axis does.
    pub time: SummaryPath,
    /// The keys along which the points of a line are joined.
    pub along: Vec<String>,
    /// What else is asked of `summary.json`.
    pub columns: Vec<SummaryPath>,
    /// Names of the two or three columns of the figure that it asks for, or none.
    pub figure: Vec<String>,
    /// Time limit of a run.
    pub timeout: Duration,
    /// In the order in which they are made.
    pub runs: Vec<PlannedRun>,
}

impl Plan {
    /// Runs that differ in nothing but the number of their repeat; they follow each other.
    pub fn groups(&self) -> Vec<Range<usize>> {
        let starts: Vec<usize> = (0..self.runs.len()).filter(|&index| self.runs[index].repeat == 1).collect();
        let ends = starts.iter().copied().skip(1).chain([self.runs.len()]);
        starts.iter().copied().zip(ends).map(|(start, end)| start..end).collect()
    }

    /// Reads and checks a study file, after the overrides `KEY=VALUE`.
    ///
    /// # Errors
    /// [`CaseError`] with everything that is wrong.
    pub fn read(file: &Path, overrides: &[String]) -> Result<Self, CaseError> {
        Self::parse(&read_text(file, "study")?, file, overrides)
    }

    /// Checks the text of a study file; case files are relative to the folder of `file`.
    ///
    /// # Errors
    /// [`CaseError`] with everything that is wrong.
    pub fn parse(text: &str, file: &Path, overrides: &[String]) -> Result<Self, CaseError> {
        let (table, log) = overridden(text, file, overrides, &[])?;
        read_whole((&table, log), &STUDY, file, |root| Self::from_section(root, file)).map(|(plan, _)| plan)
    }

    /// None if a value is missing or bad; the log knows why.
    fn from_section(root: &Section, file: &Path) -> Option<Self> {
        let cases = root.required(CASES);
        let (ranks, repeat) = (root.or(RANKS), root.or(REPEAT));
        let timeout = root.or(TIMEOUT).map(Duration::from_secs_f64);
        let errors = root.made("error", root.optional(ERROR), |value| values::one_or_each(&value, SummaryPath::read));
        let time = root.made("time", root.or(TIME), |value| SummaryPath::read(&value));
        let along = root.made("along", root.optional(ALONG), |value| values::one_or_each(&value, read_along));
        let columns = root.made("columns", root.optional(COLUMNS), |value| values::one_or_each(&value, SummaryPath::read));
        let figure = root.optional(FIGURE).unwrap_or_default();
        let (common, grid, curves) = (read_set(root), read_grid(root), root.listed("curve", read_curve));
        let cases = cases?;
        let planned = find_cases(&cases, file, root);
        check_curves(&curves, &planned, root);
        let moves = Moves { common, grid, curves };
        moves.check_overlaps(root);
        moves.check_keys(&planned, root);
        let keys = moves.keys();
        if let Some(along) = along.iter().flatten().find(|along| !keys.contains(along)) {
            root.problem(&["along"], format!("{along} stands in no grid; take one of its keys"));
        }
        let mut columns = columns.unwrap_or_default();
        let others: Vec<SummaryPath> = errors.iter().flatten().chain(&time).cloned().collect();
        let figure = asked_columns(root, &figure, &keys, &others, &mut columns);
        let (ranks, repeat, timeout) = (ranks?, repeat?, timeout?);
        let runs = moves.expand(&planned, &ranks, repeat, root)?;
        Some(Self {
            name: name_of(file, "study.toml"),
            keys,
            errors: errors.unwrap_or_default(),
            time: time?,
            along: along.unwrap_or(vec!["mesh.refine".into()]),
            columns,
            figure,
            timeout,
            runs,
        })
    }
}

/// A key of the case, as it is told from others.
fn read_along(value: &Value) -> Result<String, String> {
    let names = read_key(&values::name(value)?);
    names.map(|names| dotted(&names)).ok_or("must be a key of the case with dots, as in \"mesh.refine\"".into())
}

/// Finds the case files, and a name for each that no other has.
fn find_cases(cases: &[String], study: &Path, root: &Section) -> Vec<PlannedCase> {
    let folder = study.parent().unwrap_or(Path::new(""));
    let name = |case: &String| name_of(&folder.join(case), "case.toml");
    let planned = |written: &String| {
        let file = folder.join(written);
        if !file.is_file() {
            let words =
                format!("there is no file {} for \"{written}\"; case files are relative to the study file", file.display());
            root.problem(&["cases"], words);
        }
        let is_alone = cases.iter().filter(|case| name(case) == name(written)).count() == 1;
        PlannedCase {
            label: if is_alone { name(written) } else { written.clone() },
            title: Case::read(&file, &[]).map(|case| case.title).unwrap_or_default(),
            written: written.clone(),
            file,
        }
    };
    cases.iter().map(planned).collect()
}

/// Curves of one case are told apart by their names, and drawn for cases of the study.
fn check_curves(curves: &[StudyCurve], cases: &[PlannedCase], root: &Section) {
    for (index, curve) in curves.iter().enumerate() {
        let number = (index + 1).to_string();
        if curves[..index].iter().any(|other| other.name == curve.name && other.meets(curve)) {
            let words = format!("\"{}\" is another curve's name; choose one of its own", curve.name);
            root.problem(&["curve", &number, "name"], words);
        }
        for name in curve.cases.iter().flatten().filter(|name| cases.iter().all(|case| case.written != **name)) {
            let words = format!("\"{name}\" does not stand in cases; write it there, letter by letter");
            root.problem(&["curve", &number, "cases"], words);
        }
    }
    for case in cases.iter().filter(|case| case.curves(curves).is_empty()) {
        let words = format!("no [[curve]] is drawn for \"{}\"; take it from cases, or name it in a curve", case.written);
        root.problem(&["cases"], words);
    }
}

/// Columns of every study.
const WORDS: [&str; 7] = ["case", "curve", "ranks", "unknowns", "multipliers", "krylov_iterations", "outer_iterations"];

/// Figures of a contact, which mean those of the only contact of a case.
const OF_CONTACT: [&str; 5] = ["force", "pressure_max", "approach", "slip", "oscillation"];

/// Whole names of the columns that `figure` means; those that are places in `summary.json` join `columns`, beside `others` that the
/// study asks for. Empty if the log knows what is wrong.
fn asked_columns(
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

#[cfg(test)]
mod tests;
