//! Keys of the cases, as a study file sets them in `[set]`, `[grid]` and `[[curve]]`.

use toml::{Table, Value};

use crate::case::error::dotted;
use crate::case::overrides::read_key;
use crate::case::schema::study::{CURVE_CASES, CURVE_NAME, GRID, SET};
use crate::case::section::Section;
use crate::case::values;

/// A key of the case and what stands there: a value, or the values on an axis of a grid.
#[derive(Clone, Debug)]
pub struct Setting {
    /// Where it is written in the study file, from its root.
    pub written: Vec<String>,
    /// Names of the key.
    pub path: Vec<String>,
    /// What stands there.
    pub values: Vec<Value>,
}

impl Setting {
    /// Whether the keys are the same, or one stands in the table of the other.
    pub fn meets(&self, other: &Self) -> bool {
        self.path.starts_with(&other.path) || other.path.starts_with(&self.path)
    }

    /// `KEY=VALUE`
    pub fn overriding(&self, value: &Value) -> String {
        format!("{}={value}", dotted(&self.path))
    }

    /// Tells what is wrong where it is written.
    pub fn problem(&self, words: String, section: &Section) {
        section.problem(&self.written.iter().map(String::as_str).collect::<Vec<_>>(), words);
    }
}

/// `[[curve]]`
pub struct StudyCurve {
    /// Name of the curve.
    pub name: String,
    /// Keys that move together.
    pub set: Vec<Setting>,
    /// Axes of its own, in place of those of `[grid]` for the same keys, and beside the others.
    pub grid: Vec<Setting>,
    /// The cases that it is drawn for, as they stand in `cases`; None: for all.
    pub cases: Option<Vec<String>>,
}

impl StudyCurve {
    /// Whether both are drawn for some case.
    pub fn meets(&self, other: &Self) -> bool {
        match (&self.cases, &other.cases) {
            (Some(own), Some(others)) => own.iter().any(|case| others.contains(case)),
            _ => true,
        }
    }
}

/// `[set]`
pub fn read_set(section: &Section) -> Vec<Setting> {
    settings(&section.optional(SET).unwrap_or_default(), &["set"], section)
}

/// `[grid]`
pub fn read_grid(section: &Section) -> Vec<Setting> {
    let axis = |setting: Setting| match values::list("a list of values, as in [2, 3]", &setting.values[0]) {
        Ok(values) => Some(Setting { values, ..setting }),
        Err(words) => {
            setting.problem(words, section);
            None
        }
    };
    settings(&section.optional(GRID).unwrap_or_default(), &["grid"], section).into_iter().filter_map(axis).collect()
}

/// `[[curve]]`
pub fn read_curve(section: &Section) -> Option<StudyCurve> {
    let name = section.required(CURVE_NAME);
    let (mut set, mut grid) = (read_set(section), read_grid(section));
    for setting in set.iter_mut().chain(&mut grid) {
        setting.written.splice(0..0, ["curve".into(), section.name().into()]);
    }
    let cases = section.optional(CURVE_CASES);
    Some(StudyCurve { name: name?, set, grid, cases })
}

/// All keys of a table, which stands at `below` in the section. A table inside, which comes from dots that are not in quotes,
/// is one more name of the key.
fn settings(table: &Table, below: &[&str], section: &Section) -> Vec<Setting> {
    let mut found = Vec::new();
    for (name, value) in table {
        let here: Vec<&str> = below.iter().copied().chain([name.as_str()]).collect();
        let Some(names) = read_key(name) else {
            section.problem(&here, "must be a key of the case with dots, as in \"mesh.refine\"");
            continue;
        };
        let inner = match value {
            Value::Table(table) => settings(table, &here, section),
            value => {
                let written = here.iter().map(|name| (*name).to_owned()).collect();
                vec![Setting { written, path: Vec::new(), values: vec![value.clone()] }]
            }
        };
        found.extend(inner.into_iter().map(|setting| Setting { path: [&names[..], &setting.path].concat(), ..setting }));
    }
    found
}
