//! The study file: TOML text to a checked list of runs.

use std::cell::RefCell;
use std::path::{Path, PathBuf};
use std::time::Duration;

use toml::{Table, Value};

use super::summary_path::SummaryPath;
use crate::case::error::{CaseError, dotted};
use crate::case::overrides::read_key;
use crate::case::section::{Log, Section, read_text};
use crate::case::{Case, name_of, values};

/// More runs than anybody wants to wait for.
const MOST_RUNS: usize = 10_000;
/// Longest time limit of a run, in seconds: a month.
const LONGEST: f64 = 30.0 * 86_400.0;
const CASES: &str = "a list of case files";

/// A checked study: what is run, and what is asked of each result.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Name of the folder if the file is called `study.toml`, else the file's stem.
    pub name: String,
    /// Dotted keys of `[grid]`, in the order of the file.
    pub keys: Vec<String>,
    /// Where the error axis stands in `summary.json`.
    pub error: Option<SummaryPath>,
    /// What else is asked of `summary.json`.
    pub columns: Vec<SummaryPath>,
    /// Time limit of a run.
    pub timeout: Duration,
    /// In the order in which they are made.
    pub runs: Vec<PlannedRun>,
}

/// One run of a study.
#[derive(Clone, Debug, PartialEq)]
pub struct PlannedRun {
    /// The case file.
    pub file: PathBuf,
    /// Name of the case in the table: that of its results, or its path in the study if another one is called the same.
    pub case: String,
    /// Name of the curve.
    pub curve: Option<String>,
    /// Number of ranks.
    pub ranks: usize,
    /// Which of the repeats this is, from 1.
    pub repeat: usize,
    /// Values of [`Plan::keys`].
    pub values: Vec<Value>,
    /// `KEY=VALUE` of `[set]`, curve and grid.
    pub overrides: Vec<String>,
}

/// A key of the case and what stands there: a value in `[set]` and in a curve, a list of values in the grid.
#[derive(Clone, Debug)]
struct Setting<T> {
    /// Where it is written in the study file, from its root.
    written: Vec<String>,
    /// Names of the key.
    path: Vec<String>,
    value: T,
}

/// `[[curve]]`
struct Curve {
    name: String,
    set: Vec<Setting<Value>>,
    /// The cases that it is drawn for, as they stand in `cases`; None: for all.
    cases: Option<Vec<String>>,
}

impl Plan {
    /// Reads and checks a study file.
    ///
    /// # Errors
    /// [`CaseError`] with everything that is wrong.
    pub fn read(file: &Path) -> Result<Self, CaseError> {
        Self::parse(&read_text(file, "study")?, file)
    }

    /// Checks the text of a study file; case files are relative to the folder of `file`.
    ///
    /// # Errors
    /// [`CaseError`] with everything that is wrong.
    pub fn parse(text: &str, file: &Path) -> Result<Self, CaseError> {
        let table: Table = toml::from_str(text).map_err(|error| CaseError::of_syntax(file, text, &error))?;
        let log = RefCell::new(Log::default());
        let draft = Self::from_section(&Section::root(&table, &log), file);
        let problems = log.into_inner().problems;
        draft.filter(|_| problems.is_empty()).ok_or(CaseError { file: file.into(), problems })
    }

    /// None if a value is missing or bad; the log knows why.
    fn from_section(root: &Section, file: &Path) -> Option<Self> {
        let cases = root.required("cases", "[\"case.toml\"]", values::list(CASES, values::name));
        let ranks = root.or("ranks", vec![1], values::list("a list of numbers of ranks", values::count));
        let repeat = root.or("repeat", 1, values::count);
        let timeout = root.or("timeout", 600, |value| match values::positive(value)? {
            seconds if seconds <= LONGEST => Ok(Duration::from_secs_f64(seconds)),
            _ => Err(format!("must be at most {LONGEST} seconds")),
        });
        let error = root.optional("error", SummaryPath::read);
        let columns = root.optional("columns", values::list("a list of paths in summary.json", SummaryPath::read));
        let common = settings(&root.optional("set", values::table).unwrap_or_default(), &["set"], root);
        let grid = read_grid(root);
        let curves = root.listed("curve", read_curve);
        let cases = cases?;
        let scenes = find_cases(&cases, file, root);
        check_curves(&curves, &scenes, root);
        let moves = Moves { common, grid, curves };
        moves.check_overlaps(root);
        moves.check_keys(&scenes, root);
        let (ranks, repeat, timeout) = (ranks?, repeat?, timeout?);
        let runs = moves.expand(&scenes, &ranks, repeat, root)?;
        Some(Self {
            name: name_of(file, "study.toml"),
            keys: moves.grid.iter().map(|axis| dotted(&axis.path)).collect(),
            error,
            columns: columns.unwrap_or_default(),
            timeout,
            runs,
        })
    }
}

/// A case of the study.
struct Scene {
    /// As it stands in `cases`.
    written: String,
    file: PathBuf,
    label: String,
}

impl Scene {
    /// The curves of this case; one that is none if the study has no curves.
    fn curves<'a>(&self, curves: &'a [Curve]) -> Vec<Option<&'a Curve>> {
        if curves.is_empty() {
            return vec![None];
        }
        let drawn = |curve: &&Curve| curve.cases.as_ref().is_none_or(|cases| cases.contains(&self.written));
        curves.iter().filter(drawn).map(Some).collect()
    }
}

/// Finds the case files, and a name for each that no other has.
fn find_cases(cases: &[String], study: &Path, root: &Section) -> Vec<Scene> {
    let folder = study.parent().unwrap_or(Path::new(""));
    let files: Vec<PathBuf> = cases.iter().map(|case| folder.join(case)).collect();
    let names: Vec<String> = files.iter().map(|file| name_of(file, "case.toml")).collect();
    for (case, file) in cases.iter().zip(&files).filter(|(_, file)| !file.is_file()) {
        let words = format!("there is no file {} for \"{case}\"; case files are relative to the study file", file.display());
        root.problem(&["cases"], words);
    }
    let label = |index: usize| {
        let alone = names.iter().filter(|name| **name == names[index]).count() == 1;
        if alone { names[index].clone() } else { cases[index].clone() }
    };
    let scene =
        |(index, file): (usize, &PathBuf)| Scene { written: cases[index].clone(), file: file.clone(), label: label(index) };
    files.iter().enumerate().map(scene).collect()
}

/// `[grid]`
fn read_grid(root: &Section) -> Vec<Setting<Vec<Value>>> {
    let table = root.optional("grid", values::table).unwrap_or_default();
    let mut axes = Vec::new();
    for setting in settings(&table, &["grid"], root) {
        let below: Vec<&str> = setting.written.iter().map(String::as_str).collect();
        match values::list("a list of values, as in [2, 3]", |value| Ok(value.clone()))(&setting.value) {
            Ok(value) => axes.push(Setting { written: setting.written, path: setting.path, value }),
            Err(words) => root.problem(&below, words),
        }
    }
    axes
}

/// `[[curve]]`
fn read_curve(section: &Section) -> Option<Curve> {
    let name = section.required("name", "\"P1/P0\"", values::name);
    let table = section.optional("set", values::table).unwrap_or_default();
    let mut set = settings(&table, &["set"], section);
    for setting in &mut set {
        setting.written.splice(0..0, ["curve".into(), section.name().into()]);
    }
    let cases = section.optional("cases", values::list(CASES, values::name));
    Some(Curve { name: name?, set, cases })
}

/// All keys of a table, which stands at `below` in the section. A table inside, which comes from dots that are not in quotes,
/// is one more name of the key.
fn settings(table: &Table, below: &[&str], section: &Section) -> Vec<Setting<Value>> {
    let mut found = Vec::new();
    for (name, value) in table {
        let here: Vec<&str> = below.iter().copied().chain([name.as_str()]).collect();
        let Some(names) = read_key(name) else {
            section.problem(&here, "must be a key of the case with dots, as in \"mesh.refine\"".into());
            continue;
        };
        let inner = match value {
            Value::Table(table) => settings(table, &here, section),
            value => {
                let written = here.iter().map(|name| (*name).to_owned()).collect();
                vec![Setting { written, path: Vec::new(), value: value.clone() }]
            }
        };
        for mut setting in inner {
            setting.path.splice(0..0, names.iter().cloned());
            found.push(setting);
        }
    }
    found
}

/// Curves are told apart by their names, and drawn for cases of the study.
fn check_curves(curves: &[Curve], scenes: &[Scene], root: &Section) {
    for (index, curve) in curves.iter().enumerate() {
        let number = (index + 1).to_string();
        if curves[..index].iter().any(|other| other.name == curve.name) {
            root.problem(
                &["curve", &number, "name"],
                format!("\"{}\" is another curve's name; choose one of its own", curve.name),
            );
        }
        for case in curve.cases.iter().flatten().filter(|case| scenes.iter().all(|scene| scene.written != **case)) {
            let words = format!("\"{case}\" does not stand in cases; write it there, letter by letter");
            root.problem(&["curve", &number, "cases"], words);
        }
    }
    for scene in scenes.iter().filter(|scene| scene.curves(curves).is_empty()) {
        let words = format!("no [[curve]] is drawn for \"{}\"; take it from cases, or name it in a curve", scene.written);
        root.problem(&["cases"], words);
    }
}

/// Keys of the cases that the study sets, and where they move.
struct Moves {
    /// `[set]`: in every run, but where a curve sets the same key.
    common: Vec<Setting<Value>>,
    /// `[grid]`
    grid: Vec<Setting<Vec<Value>>>,
    curves: Vec<Curve>,
}

impl Moves {
    /// A key moves in one place: in the grid, or with a curve. Only `[set]` gives way to a curve.
    fn check_overlaps(&self, root: &Section) {
        let complain = |written: &[String], other: &[String]| {
            let below: Vec<&str> = written.iter().map(String::as_str).collect();
            root.problem(&below, format!("is also set by {}; a key moves in one place", dotted(other)));
        };
        for (index, axis) in self.grid.iter().enumerate() {
            for other in self.grid[..index].iter().filter(|other| meet(&other.path, &axis.path)) {
                complain(&axis.written, &other.written);
            }
        }
        for set in self.curves.iter().map(|curve| &curve.set).chain([&self.common]) {
            for (index, setting) in set.iter().enumerate() {
                let axes = self.grid.iter().map(|axis| (&axis.path, &axis.written));
                let earlier = set[..index].iter().map(|other| (&other.path, &other.written));
                for (_, other) in axes.chain(earlier).filter(|(path, _)| meet(path, &setting.path)) {
                    complain(&setting.written, other);
                }
            }
        }
    }

    /// What a curve sets, and before it what `[set]` does and the curve does not.
    fn set<'a>(&'a self, curve: Option<&'a Curve>) -> impl Iterator<Item = &'a Setting<Value>> + Clone {
        let own = curve.map_or(&[][..], |curve| &curve.set);
        let left = move |setting: &&Setting<Value>| own.iter().all(|other| !meet(&other.path, &setting.path));
        self.common.iter().filter(left).chain(own)
    }

    /// A key that no case can have is a slip of the pen: it is told before anything runs. What else is wrong with a case, a
    /// value that it refuses, say, is the row of its run.
    fn check_keys(&self, scenes: &[Scene], root: &Section) {
        let mut told: Vec<&[String]> = Vec::new();
        for scene in scenes {
            for curve in scene.curves(&self.curves) {
                let set = self.set(curve);
                let first = self.grid.iter().map(|axis| overriding(&axis.path, &axis.value[0]));
                let overrides: Vec<String> =
                    set.clone().map(|setting| overriding(&setting.path, &setting.value)).chain(first).collect();
                let Err(error) = Case::read(&scene.file, &overrides) else { continue };
                let axes = self.grid.iter().map(|axis| (&axis.path, &axis.written));
                for (path, written) in set.map(|setting| (&setting.path, &setting.written)).chain(axes) {
                    let key = dotted(path);
                    let meant = |unknown: &str| key == unknown || key.starts_with(&format!("{unknown}."));
                    let problem = error.problems.iter().find(|problem| problem.is_unknown() && meant(&problem.key));
                    if let Some(problem) = problem.filter(|_| !told.contains(&written.as_slice())) {
                        let below: Vec<&str> = written.iter().map(String::as_str).collect();
                        root.problem(&below, format!("{} (asked of case {})", problem.words, scene.label));
                        told.push(written);
                    }
                }
            }
        }
    }

    /// Every run: cases, then their curves, then combinations of the grid with the last key running fastest, then ranks and
    /// repeats.
    fn expand(&self, scenes: &[Scene], ranks: &[usize], repeat: usize, root: &Section) -> Option<Vec<PlannedRun>> {
        let lines: Vec<_> =
            scenes.iter().flat_map(|scene| scene.curves(&self.curves).into_iter().map(move |curve| (scene, curve))).collect();
        let factors = self.grid.iter().map(|axis| axis.value.len()).chain([lines.len(), ranks.len(), repeat]);
        let count = factors.fold(1usize, usize::saturating_mul);
        if count > MOST_RUNS {
            root.problem(&[], format!("the study makes {count} runs, more than {MOST_RUNS}; make several studies of it"));
            return None;
        }
        let combinations = combinations(&self.grid);
        let mut runs = Vec::with_capacity(count);
        for (scene, curve) in lines {
            for values in &combinations {
                let set = self.set(curve).map(|setting| overriding(&setting.path, &setting.value));
                let moved = self.grid.iter().zip(values).map(|(axis, value)| overriding(&axis.path, value));
                let overrides: Vec<String> = set.chain(moved).collect();
                for (&ranks, repeat) in ranks.iter().flat_map(|ranks| (1..=repeat).map(move |repeat| (ranks, repeat))) {
                    runs.push(PlannedRun {
                        file: scene.file.clone(),
                        case: scene.label.clone(),
                        curve: curve.map(|curve| curve.name.clone()),
                        ranks,
                        repeat,
                        values: values.clone(),
                        overrides: overrides.clone(),
                    });
                }
            }
        }
        Some(runs)
    }
}

/// Whether two keys are the same, or one stands in the table of the other.
fn meet(a: &[String], b: &[String]) -> bool {
    a.starts_with(b) || b.starts_with(a)
}

/// `KEY=VALUE`
fn overriding(path: &[String], value: &Value) -> String {
    format!("{}={value}", dotted(path))
}

/// One value of each axis, in every way.
fn combinations(grid: &[Setting<Vec<Value>>]) -> Vec<Vec<Value>> {
    grid.iter().fold(vec![Vec::new()], |so_far, axis| {
        let extended = |values: &Vec<Value>, value: &Value| values.iter().chain([value]).cloned().collect();
        so_far.iter().flat_map(|values| axis.value.iter().map(move |value| extended(values, value))).collect()
    })
}

#[cfg(test)]
mod tests;
