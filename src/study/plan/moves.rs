//! Where the keys of the cases move, and every combination of them.

use toml::Value;

use super::planned::{PlannedCase, PlannedRun};
use super::settings::{GridAxis, Setting, StudyCurve, problem_at};
use crate::case::Case;
use crate::case::error::dotted;
use crate::case::section::Section;

/// More runs than anybody wants to wait for.
const MOST_RUNS: usize = 10_000;

/// Keys of the cases that the study sets.
pub struct Moves {
    /// `[set]`: in every run, but where a curve sets the same key.
    pub common: Vec<Setting<Value>>,
    /// `[grid]`: for every curve, but those that have an axis of their own for the same key.
    pub grid: Vec<GridAxis>,
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
        let complain = |written: &[String], other: &[String]| {
            problem_at(written, format!("is also set by {}; a key moves in one place", dotted(other)), root);
        };
        let common = self.common.iter().map(places);
        one_by_one(&self.grid.iter().map(places).chain(common).collect::<Vec<_>>(), complain);
        for curve in &self.curves {
            let left = self.grid.iter().filter(|axis| curve.grid.iter().all(|own| own.path != axis.path));
            let own = curve.set.iter().map(places).chain(curve.grid.iter().map(places));
            one_by_one(&left.map(places).chain(own).collect::<Vec<_>>(), |written, other| {
                // What is wrong in the grid alone has been told.
                if written[0] == "curve" {
                    complain(written, other);
                }
            });
        }
    }

    /// What a curve sets, and before it what `[set]` does and the curve does not.
    fn set<'a>(&'a self, curve: Option<&'a StudyCurve>) -> impl Iterator<Item = &'a Setting<Value>> + Clone {
        let (own, grid) = curve.map_or((&[][..], &[][..]), |curve| (&curve.set[..], &curve.grid[..]));
        let left = move |setting: &&Setting<Value>| {
            own.iter().map(|other| &other.path).chain(grid.iter().map(|axis| &axis.path)).all(|path| !meet(path, &setting.path))
        };
        self.common.iter().filter(left).chain(own)
    }

    /// Axes of a curve: those of the grid, with its own in their place, and then the rest of its own.
    fn axes<'a>(&'a self, curve: Option<&'a StudyCurve>) -> Vec<&'a GridAxis> {
        let own = curve.map_or(&[][..], |curve| &curve.grid);
        let replaced = |axis: &'a GridAxis| own.iter().find(|other| other.path == axis.path).unwrap_or(axis);
        let more = own.iter().filter(|other| self.grid.iter().all(|axis| axis.path != other.path));
        self.grid.iter().map(replaced).chain(more).collect()
    }

    /// A key that no case can have is a slip of the pen: it is told before anything runs. What else is wrong with a case, a
    /// value that it refuses, say, is the row of its run.
    pub fn check_keys(&self, cases: &[PlannedCase], root: &Section) {
        let mut told: Vec<&[String]> = Vec::new();
        for case in cases {
            for curve in case.curves(&self.curves) {
                let (set, axes) = (self.set(curve), self.axes(curve));
                let first = axes.iter().map(|axis| overriding(&axis.path, &axis.value[0]));
                let overrides: Vec<String> =
                    set.clone().map(|setting| overriding(&setting.path, &setting.value)).chain(first).collect();
                let Err(error) = Case::read(&case.file, &overrides) else { continue };
                for (path, written) in set.map(places).chain(axes.into_iter().map(places)) {
                    let key = dotted(path);
                    let meant = |unknown: &str| key == unknown || key.starts_with(&format!("{unknown}."));
                    let problem = error.problems.iter().find(|problem| problem.is_unknown() && meant(&problem.key));
                    if let Some(problem) = problem.filter(|_| !told.contains(&written)) {
                        problem_at(written, format!("{} (asked of case {})", problem.words, case.label), root);
                        told.push(written);
                    }
                }
            }
        }
    }

    /// Every run: cases, then their curves, then combinations of the grid with the last key running fastest, then ranks and
    /// repeats.
    pub fn expand(&self, cases: &[PlannedCase], ranks: &[usize], repeat: usize, root: &Section) -> Option<Vec<PlannedRun>> {
        let lines: Vec<_> =
            cases.iter().flat_map(|case| case.curves(&self.curves).into_iter().map(move |curve| (case, curve))).collect();
        let of_line = |axes: Vec<&GridAxis>| axes.iter().map(|axis| axis.value.len()).fold(1usize, usize::saturating_mul);
        let combined = lines.iter().map(|(_, curve)| of_line(self.axes(*curve))).fold(0, usize::saturating_add);
        let count = [ranks.len(), repeat].into_iter().fold(combined, usize::saturating_mul);
        if count > MOST_RUNS {
            root.problem(&[], format!("the study makes {count} runs, more than {MOST_RUNS}; make several studies of it"));
            return None;
        }
        let mut runs = Vec::with_capacity(count);
        for (case, curve) in lines {
            for planned in self.line(case, curve) {
                for (&ranks, repeat) in ranks.iter().flat_map(|ranks| (1..=repeat).map(move |repeat| (ranks, repeat))) {
                    runs.push(PlannedRun { ranks, repeat, ..planned.clone() });
                }
            }
        }
        Some(runs)
    }

    /// Every combination of one case and one curve.
    fn line(&self, case: &PlannedCase, curve: Option<&StudyCurve>) -> Vec<PlannedRun> {
        let (keys, axes) = (self.keys(), self.axes(curve));
        let set: Vec<String> = self.set(curve).map(|setting| overriding(&setting.path, &setting.value)).collect();
        let planned = |values: Vec<&Value>| {
            let moved = axes.iter().zip(&values).map(|(axis, value)| overriding(&axis.path, value));
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

/// The key of a setting, and where it is written.
fn places<T>(setting: &Setting<T>) -> (&[String], &[String]) {
    (&setting.path, &setting.written)
}

/// Tells each key that meets an earlier one, by the places where both are written.
fn one_by_one<'a>(settings: &[(&'a [String], &'a [String])], complain: impl Fn(&'a [String], &'a [String])) {
    for (index, (path, written)) in settings.iter().enumerate() {
        settings[..index].iter().filter(|(other, _)| meet(other, path)).for_each(|(_, other)| complain(written, other));
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
fn combinations<'a>(axes: &[&'a GridAxis]) -> Vec<Vec<&'a Value>> {
    axes.iter().fold(vec![Vec::new()], |so_far, axis| {
        let extended = |values: &Vec<&'a Value>, value: &'a Value| values.iter().copied().chain([value]).collect();
        so_far.iter().flat_map(|values| axis.value.iter().map(move |value| extended(values, value))).collect()
    })
}
