//! What a study prints while it goes on.

use std::io::{Write, stdout};
use std::path::Path;
use std::time::Instant;

use super::ended::{Ended, RunStatus};
use super::folder::ResultPlace;
use crate::output::clock;
use crate::study::plan::Plan;
use crate::study::plan::planned::PlannedRun;

/// Prints to standard output; a reader that has gone away is no reason to stop.
pub struct Progress {
    started: Instant,
    keys: Vec<String>,
    runs: usize,
}

impl Progress {
    /// The first line: what the study is, and how much of it has been made.
    pub fn start(plan: &Plan, places: &[ResultPlace]) -> Self {
        let kept = places.iter().filter(|place| place.kept.is_some()).count();
        let again = places.iter().filter(|place| place.again).count();
        let all = count(plan.runs.len(), "run");
        say(&format!("mezha {}: study {}, {all}{}\n", env!("CARGO_PKG_VERSION"), plan.name, already(kept, again)));
        Self { started: Instant::now(), keys: plan.keys.clone(), runs: plan.runs.len() }
    }

    /// What is made next: run k of n, time since the start, case, curve, keys, ranks. The line stays open until the run has ended.
    pub fn begin(&self, index: usize, run: &PlannedRun) {
        let number = format!("{:>width$}", index + 1, width = self.runs.to_string().len());
        let elapsed = clock(self.started.elapsed());
        say(&format!("run {number} of {}, {elapsed}: {} ... ", self.runs, describe(&self.keys, run)));
    }

    /// How it ended, on the same line.
    pub fn ended(&self, ended: &Ended) {
        let words = format!("{} in {:.2} s", ended.status.words().replace('_', " "), ended.wall_s);
        say(&if ended.is_good() { format!("{words}\n") } else { format!("{words}: {}\n", ended.reason) });
    }

    /// That it was given up, on the same line.
    pub fn interrupted(&self) {
        say("interrupted\n");
    }

    /// The last lines: what is asked of the results and none has, how many runs ended how, and where the page is.
    pub fn end(&self, plan: &Plan, results: &[Ended], has_figure: bool, page: &Path) {
        for path in plan.errors.iter().chain([&plan.time]).chain(&plan.columns) {
            let has_summary = results.iter().any(Ended::has_result);
            if has_summary && results.iter().all(|ended| path.of(&ended.summary).is_null()) {
                let is_ambiguous = results.iter().any(|ended| path.is_ambiguous(&ended.summary));
                let remedy = if is_ambiguous {
                    "`*` means the only one, and there are several: write its name"
                } else {
                    "is it spelt right?"
                };
                say(&format!("mezha: no run has a value at {} of its summary.json; {remedy}\n", path.text));
            }
        }
        if let ([x, y, ..], false) = (&plan.figure[..], has_figure) {
            say(&format!("mezha: there is no figure of {y} against {x}: no run that converged has numbers of both\n"));
        }
        say(&format!("mezha: {}; {} in all; see {}\n", verdict(results), clock(self.started.elapsed()), page.display()));
    }
}

fn say(words: &str) {
    let mut out = stdout();
    let _ = out.write_all(words.as_bytes()).and_then(|()| out.flush());
}

/// How many runs are there, and how many were made before but have changed or failed.
fn already(kept: usize, again: usize) -> String {
    let kept = if kept == 0 { String::new() } else { format!(", {kept} of them already made") };
    let again =
        if again == 0 { String::new() } else { format!(", {again} to be made again since they failed or something changed") };
    kept + &again
}

/// Case, curve, keys that move, ranks, repeat.
fn describe(keys: &[String], run: &PlannedRun) -> String {
    let moved = keys.iter().zip(&run.values).filter_map(|(key, value)| Some(format!("{key}={}", value.as_ref()?)));
    let repeat = (run.repeat > 1).then(|| format!("repeat {}", run.repeat));
    let words = [run.case.clone()].into_iter().chain(run.curve.clone()).chain(moved).chain([count(run.ranks, "rank")]);
    words.chain(repeat).collect::<Vec<_>>().join("  ")
}

/// How many runs ended how, and the usual ending first.
fn verdict(results: &[Ended]) -> String {
    let of = |status: RunStatus| results.iter().filter(|ended| ended.status == status).count();
    let counts = RunStatus::ALL.map(|(status, words)| (words, of(status)));
    let some = counts.iter().filter(|(words, number)| *number > 0 || *words == RunStatus::Converged.words());
    let words: Vec<String> = some.map(|(words, number)| format!("{number} {}", words.replace('_', " "))).collect();
    format!("{}: {}", count(results.len(), "run"), words.join(", "))
}

/// `1 run`, `2 runs`
fn count(number: usize, thing: &str) -> String {
    if number == 1 { format!("1 {thing}") } else { format!("{number} {thing}s") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_is_told_by_what_moves() {
        let mut run = PlannedRun {
            file: "bars.toml".into(),
            case: "bars".into(),
            title: String::new(),
            curve: Some("P1/P0".into()),
            ranks: 2,
            repeat: 1,
            values: vec![Some(3.into()), None],
            overrides: Vec::new(),
        };
        let keys = ["mesh.refine".to_string(), "solver.name".to_string()];
        assert_eq!(describe(&keys, &run), "bars  P1/P0  mesh.refine=3  2 ranks");
        (run.repeat, run.ranks, run.curve) = (2, 1, None);
        assert_eq!(describe(&keys, &run), "bars  mesh.refine=3  1 rank  repeat 2");
    }

    #[test]
    fn the_first_line_tells_what_is_there() {
        assert_eq!(already(0, 0), "");
        assert_eq!(already(3, 0), ", 3 of them already made");
        assert_eq!(already(3, 2), ", 3 of them already made, 2 to be made again since they failed or something changed");
    }
}
