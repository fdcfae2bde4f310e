//! What a study is made of: its cases, keys of them as a study file sets them in `[set]`, `[grid]` and `[[curve]]`, and the runs
//! of every combination.

use crate::case::error::dotted;
use crate::case::overrides::read_key;
use crate::case::schema::study::{CURVE_CASES, CURVE_NAME, GRID, SET};
use crate::case::section::Section;
use crate::case::{Case, values};
use std::path::PathBuf;
use toml::{Table, Value};

/// One run of a study.
#[derive(Clone, Debug, PartialEq)]
pub struct PlannedRun {
    /// The case file.
    pub file: PathBuf,
    /// Name of the case in the table: that of its results, or its path in the study if another one is called the same.
    pub case: String,
    /// Title of the case.
    pub title: String,
    /// Name of the curve.
    pub curve: Option<String>,
    /// Number of ranks.
    pub ranks: usize,
    /// Which of the repeats this is, from 1.
    pub repeat: usize,
    /// Values of [`super::Plan::keys`]; None where the key does not move.
    pub values: Vec<Option<Value>>,
    /// `KEY=VALUE` of `[set]`, curve and grid.
    pub overrides: Vec<String>,
}

/// A case of the study.
pub struct PlannedCase {
    /// As it stands in `cases`.
    pub written: String,
    /// The case file.
    pub file: PathBuf,
    /// A name that no other has.
    pub label: String,
    /// Title of the case.
    pub title: String,
}

impl PlannedCase {
    /// The curves of this case; one that is none if the study has no curves.
    pub fn curves<'a>(&self, curves: &'a [StudyCurve]) -> Vec<Option<&'a StudyCurve>> {
        if curves.is_empty() {
            return vec![None];
        }
        let drawn = |curve: &&StudyCurve| curve.cases.as_ref().is_none_or(|cases| cases.contains(&self.written));
        curves.iter().filter(drawn).map(Some).collect()
    }
}

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

/// More runs than anybody wants to wait for.
const MOST_RUNS: usize = 10_000;

/// Keys of the cases that the study sets.
pub struct Moves {
    /// `[set]`: in every run, but where a curve sets the same key.
    pub common: Vec<Setting>,
    /// `[grid]`: for every curve, but those that have an axis of their own for the same key.
    pub grid: Vec<Setting>,
    /// `[[curve]]`
    pub curves: Vec<StudyCurve>,
}

impl Moves {
    /// Dotted keys of all axes: of the grid, then of the curves.
    pub fn keys(&self) -> Vec<String> {
        let mut keys: Vec<String> = Vec::new();
        for axis in self.grid.iter().chain(self.curves.iter().flat_map(|curve| &curve.grid)) {
            let key = dotted(&axis.path);
            if !keys.contains(&key) {
                keys.push(key);
            }
        }
        keys
    }

    /// A key moves in one place: in a grid, or with a curve. Only `[set]` and `[grid]` give way to a curve, which takes their
    /// place.
    pub fn check_overlaps(&self, root: &Section) {
        let mut found = meeting(&self.grid.iter().chain(&self.common).collect::<Vec<_>>());
        for curve in &self.curves {
            let left = self.grid.iter().filter(|axis| curve.grid.iter().all(|own| own.path != axis.path));
            let own = meeting(&left.chain(&curve.set).chain(&curve.grid).collect::<Vec<_>>());
            // What is wrong in the grid alone has been told.
            found.extend(own.into_iter().filter(|[setting, _]| setting.written[0] == "curve"));
        }
        for [setting, other] in found {
            setting.problem(format!("is also set by {}; a key moves in one place", dotted(&other.written)), root);
        }
    }

    /// What a curve sets, and before it what `[set]` does and the curve does not.
    fn set<'a>(&'a self, curve: Option<&'a StudyCurve>) -> Vec<&'a Setting> {
        let (own, grid) = curve.map_or((&[][..], &[][..]), |curve| (&curve.set[..], &curve.grid[..]));
        let left = |setting: &&Setting| own.iter().chain(grid).all(|other| !other.meets(setting));
        self.common.iter().filter(left).chain(own).collect()
    }

    /// Axes of a curve: those of the grid, with its own in their place, and then the rest of its own.
    fn axes<'a>(&'a self, curve: Option<&'a StudyCurve>) -> Vec<&'a Setting> {
        let own = curve.map_or(&[][..], |curve| &curve.grid);
        let replaced = |axis: &'a Setting| own.iter().find(|other| other.path == axis.path).unwrap_or(axis);
        let more = own.iter().filter(|other| self.grid.iter().all(|axis| axis.path != other.path));
        self.grid.iter().map(replaced).chain(more).collect()
    }

    /// Each case with each of its curves.
    fn lines<'a>(&'a self, cases: &'a [PlannedCase]) -> impl Iterator<Item = (&'a PlannedCase, Option<&'a StudyCurve>)> + Clone {
        cases.iter().flat_map(|case| case.curves(&self.curves).into_iter().map(move |curve| (case, curve)))
    }

    /// A key that no case can have is a slip of the pen: it is told before anything runs. What else is wrong with a case, a
    /// value that it refuses, say, is the row of its run.
    pub fn check_keys(&self, cases: &[PlannedCase], root: &Section) {
        let mut told: Vec<&[String]> = Vec::new();
        for (case, curve) in self.lines(cases) {
            let all = [self.set(curve), self.axes(curve)].concat();
            let overrides: Vec<String> = all.iter().map(|setting| setting.overriding(&setting.values[0])).collect();
            let Err(error) = Case::read(&case.file, &overrides) else { continue };
            for setting in all {
                let key = dotted(&setting.path);
                let meant = |unknown: &str| key == unknown || key.starts_with(&format!("{unknown}."));
                let problem = error.problems.iter().find(|problem| problem.is_unknown() && meant(&problem.key));
                if let Some(problem) = problem.filter(|_| !told.contains(&&setting.written[..])) {
                    setting.problem(format!("{} (asked of case {})", problem.words, case.label), root);
                    told.push(&setting.written);
                }
            }
        }
    }

    /// Every run: cases, then their curves, then combinations of the grid with the last key running fastest, then ranks and
    /// repeats.
    pub fn expand(&self, cases: &[PlannedCase], ranks: &[usize], repeat: usize, root: &Section) -> Option<Vec<PlannedRun>> {
        let of_line = |axes: Vec<&Setting>| axes.iter().map(|axis| axis.values.len()).fold(1usize, usize::saturating_mul);
        let combined = self.lines(cases).map(|(_, curve)| of_line(self.axes(curve))).fold(0, usize::saturating_add);
        let count = [ranks.len(), repeat].into_iter().fold(combined, usize::saturating_mul);
        if count > MOST_RUNS {
            root.problem(&[], format!("the study makes {count} runs, more than {MOST_RUNS}; make several studies of it"));
            return None;
        }
        let alike = |planned: PlannedRun| {
            let each = ranks.iter().flat_map(|&ranks| (1..=repeat).map(move |repeat| (ranks, repeat)));
            each.map(move |(ranks, repeat)| PlannedRun { ranks, repeat, ..planned.clone() })
        };
        Some(self.lines(cases).flat_map(|(case, curve)| self.line(case, curve)).flat_map(alike).collect())
    }

    /// Every combination of one case and one curve.
    fn line(&self, case: &PlannedCase, curve: Option<&StudyCurve>) -> Vec<PlannedRun> {
        let (keys, axes) = (self.keys(), self.axes(curve));
        let set: Vec<String> = self.set(curve).iter().map(|setting| setting.overriding(&setting.values[0])).collect();
        let planned = |values: Vec<&Value>| {
            let moved = axes.iter().zip(&values).map(|(axis, value)| axis.overriding(value));
            let of_key = |key: &String| axes.iter().position(|axis| dotted(&axis.path) == *key).map(|at| values[at].clone());
            PlannedRun {
                file: case.file.clone(),
                case: case.label.clone(),
                title: case.title.clone(),
                curve: curve.map(|curve| curve.name.clone()),
                ranks: 1,
                repeat: 1,
                values: keys.iter().map(of_key).collect(),
                overrides: set.iter().cloned().chain(moved).collect(),
            }
        };
        combinations(&axes).into_iter().map(planned).collect()
    }
}

/// Each key that meets an earlier one, with that.
fn meeting<'a>(settings: &[&'a Setting]) -> Vec<[&'a Setting; 2]> {
    let earlier = |(at, setting): (usize, &&'a Setting)| {
        let setting = *setting;
        settings[..at].iter().filter(|other| other.meets(setting)).map(move |other| [setting, *other]).collect::<Vec<_>>()
    };
    settings.iter().enumerate().flat_map(earlier).collect()
}

/// One value of each axis, in every way.
fn combinations<'a>(axes: &[&'a Setting]) -> Vec<Vec<&'a Value>> {
    axes.iter().fold(vec![Vec::new()], |so_far, axis| {
        let extended = |values: &Vec<&'a Value>, value: &'a Value| values.iter().copied().chain([value]).collect();
        so_far.iter().flat_map(|values| axis.values.iter().map(move |value| extended(values, value))).collect()
    })
}
