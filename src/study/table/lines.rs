//! The runs of a study as lines in a diagram: points joined along some keys, with what they say together.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use serde::Serialize;

use super::fit::{PowerLaw, front};
use super::repeats::Spread;
use super::rows::{krylov_iterations, once};
use crate::study::plan::Plan;
use crate::study::plan::planned::PlannedRun;
use crate::study::runs::ended::{Ended, RunStatus};

/// Points that differ in some keys alone, in `mesh.refine` unless the study says otherwise.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Line {
    /// Name of the case.
    pub case: String,
    /// Title of the case.
    pub title: String,
    /// What tells it from the other lines of the case.
    pub name: String,
    /// Number of ranks.
    pub ranks: usize,
    /// For each error of the study: error ~ h^exponent, with h² ~ 1/unknowns, as in the plane.
    pub orders: BTreeMap<String, Option<PowerLaw>>,
    /// time ~ unknowns^exponent.
    pub cost: Option<PowerLaw>,
    /// With ascending numbers of unknowns. A run that has not converged is no point.
    pub points: Vec<LinePoint>,
}

/// All repeats of one run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LinePoint {
    /// Displacement components.
    pub unknowns: f64,
    /// Krylov iterations of all linear solves.
    pub iterations: Option<f64>,
    /// What the study calls time.
    pub time: Option<Spread>,
    /// What it calls errors, as far as they are known.
    pub errors: BTreeMap<String, f64>,
    /// Memory of all ranks, in MiB.
    pub memory: Option<f64>,
    /// Whether the contact pressure is to be trusted, as far as is known.
    pub trusted: bool,
    /// The errors in which no other point of the case is as accurate and as fast.
    pub front: BTreeSet<String>,
    /// Folder of the first result.
    pub result: String,
}

impl LinePoint {
    /// Time and error, if both are known and positive.
    pub fn race(&self, error: &str) -> Option<(f64, f64)> {
        Some((self.time?.median, *self.errors.get(error)?)).filter(|(time, error)| *time > 0.0 && *error > 0.0)
    }
}

/// All lines of a study, in the order of its runs.
pub fn lines(plan: &Plan, results: &[Ended]) -> Vec<Line> {
    let same = |a: &PlannedRun, b: &PlannedRun| {
        let mut values = a.values.iter().zip(&b.values).zip(&plan.keys);
        let same_values = values.all(|((a, b), key)| plan.along.contains(key) || a == b);
        (&a.case, &a.curve, a.ranks) == (&b.case, &b.curve, b.ranks) && same_values
    };
    let mut found: Vec<(&PlannedRun, Vec<Range<usize>>)> = Vec::new();
    for group in plan.groups() {
        let run = &plan.runs[group.start];
        match found.iter_mut().find(|(other, _)| same(other, run)) {
            Some((_, groups)) => groups.push(group),
            None => found.push((run, vec![group])),
        }
    }
    let first: Vec<&PlannedRun> = found.iter().map(|(run, _)| *run).collect();
    let line = |(run, groups): &(&PlannedRun, Vec<Range<usize>>)| {
        let points = groups.iter().filter_map(|group| point(plan, &results[group.clone()])).collect();
        Line::new(plan, run, name(plan, run, &first), points)
    };
    let mut lines: Vec<Line> = found.iter().map(line).collect();
    plan.errors.iter().for_each(|error| mark_fronts(&mut lines, &error.text));
    lines
}

impl Line {
    fn new(plan: &Plan, run: &PlannedRun, name: String, mut points: Vec<LinePoint>) -> Self {
        points.sort_by(|a, b| a.unknowns.total_cmp(&b.unknowns));
        let law = |value: &dyn Fn(&LinePoint) -> Option<f64>| {
            let known = points.iter().filter_map(|point| Some((point.unknowns, value(point)?)));
            PowerLaw::through(&known.collect::<Vec<_>>())
        };
        let order = |error: &str| {
            let law = law(&|point| point.errors.get(error).copied());
            law.map(|law| PowerLaw { exponent: -2.0 * law.exponent, ..law })
        };
        let orders = plan.errors.iter().map(|error| (error.text.clone(), order(&error.text))).collect();
        let cost = law(&|point| Some(point.time?.median));
        Self { case: run.case.clone(), title: run.title.clone(), name, ranks: run.ranks, orders, cost, points }
    }
}

/// What tells a line from all others: its curve, then keys with several values, then ranks.
fn name(plan: &Plan, run: &PlannedRun, all: &[&PlannedRun]) -> String {
    let mut words: Vec<String> = run.curve.iter().cloned().collect();
    for (at, key) in plan.keys.iter().enumerate().filter(|(_, key)| !plan.along.contains(key)) {
        if let Some(value) = run.values[at].as_ref().filter(|_| all.iter().any(|other| other.values[at] != run.values[at])) {
            let last = key.rsplit('.').next().unwrap_or(key);
            words.push(value.as_str().map_or_else(|| format!("{last} {value}"), str::to_owned));
        }
    }
    if all.iter().any(|other| other.ranks != run.ranks) {
        words.push(if run.ranks == 1 { "1 rank".into() } else { format!("{} ranks", run.ranks) });
    }
    if words.is_empty() { run.case.clone() } else { words.join(", ") }
}

/// Repeats as one point; None if none of them converged.
fn point(plan: &Plan, repeats: &[Ended]) -> Option<LinePoint> {
    let converged: Vec<&Ended> = repeats.iter().filter(|ended| ended.status == RunStatus::Converged).collect();
    let first = converged.first()?;
    let summary = &first.summary;
    Some(LinePoint {
        unknowns: summary["unknowns"]["displacement"].as_f64()?,
        iterations: krylov_iterations(summary).map(|count| count as f64),
        time: Spread::of(converged.iter().filter_map(|ended| plan.time.of(&ended.summary).as_f64()).collect()),
        errors: plan.errors.iter().filter_map(|path| Some((path.text.clone(), path.of(summary).as_f64()?))).collect(),
        memory: summary["memory_mib"]["sum"].as_f64(),
        trusted: first.is_good(),
        front: BTreeSet::new(),
        result: first.result.clone(),
    })
}

/// Marks the points of each case that no other point of the case beats in this error.
fn mark_fronts(lines: &mut [Line], error: &str) {
    for case in once(lines.iter().map(|line| line.case.as_str())) {
        let of_case = lines.iter_mut().filter(|line| line.case == case).flat_map(|line| &mut line.points);
        let mut racing: Vec<(&mut LinePoint, (f64, f64))> =
            of_case.filter_map(|point| point.race(error).map(|race| (point, race))).collect();
        let races: Vec<(f64, f64)> = racing.iter().map(|(_, race)| *race).collect();
        let best = racing.iter_mut().zip(front(&races)).filter(|(_, on)| *on);
        best.for_each(|((point, _), _)| {
            point.front.insert(error.into());
        });
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;
    use crate::study::plan::summary_path::SummaryPath;
    use serde_json::json;

    /// Three refinements of two elements on one case, each made twice.
    fn plan() -> Plan {
        let run = |curve: &str, refine: i64, repeat| PlannedRun {
            file: "bars.toml".into(),
            case: "bars".into(),
            title: String::new(),
            curve: Some(curve.into()),
            ranks: 1,
            repeat,
            values: vec![Some(refine.into()), Some("auto".into())],
            overrides: Vec::new(),
        };
        let runs =
            ["P1", "P2"].into_iter().flat_map(|curve| [3, 1, 2].map(|refine| [run(curve, refine, 1), run(curve, refine, 2)]));
        Plan {
            name: "bars".into(),
            keys: vec!["mesh.refine".into(), "solver.name".into()],
            errors: ["errors.energy", "errors.force"].map(|path| SummaryPath::parse(path).unwrap()).to_vec(),
            time: SummaryPath::parse("time_s.total").unwrap(),
            along: vec!["mesh.refine".into()],
            columns: Vec::new(),
            figure: Vec::new(),
            timeout: Duration::from_secs(1),
            runs: runs.flatten().collect(),
        }
    }

    /// error = h^order, time = N.
    fn results(plan: &Plan) -> Vec<Ended> {
        let ended = |run: &PlannedRun| {
            let refine = run.values[0].as_ref().and_then(toml::Value::as_integer).unwrap() as i32;
            let order = if run.curve.as_deref() == Some("P1") { 1 } else { 2 };
            let unknowns = 4_f64.powi(refine);
            Ended {
                status: RunStatus::Converged,
                reason: String::new(),
                summary: json!({
                    "unknowns": { "displacement": unknowns },
                    "solver": { "iterations": [5, 6] },
                    "errors": { "energy": 0.5_f64.powi(order * refine) },
                    "time_s": { "total": unknowns * run.repeat as f64 },
                    "memory_mib": { "sum": 10.0 },
                }),
                wall_s: 1.0,
                timeout_s: 1.0,
                result: "runs/001".into(),
                machine: String::new(),
            }
        };
        plan.runs.iter().map(ended).collect()
    }

    #[test]
    fn points_of_one_curve_are_a_line_with_its_laws() {
        let plan = plan();
        let lines = lines(&plan, &results(&plan));
        assert_eq!(lines.iter().map(|line| line.name.as_str()).collect::<Vec<_>>(), ["P1", "P2"]);
        for (line, order) in lines.iter().zip([1.0, 2.0]) {
            assert_eq!(line.points.iter().map(|point| point.unknowns).collect::<Vec<_>>(), [4.0, 16.0, 64.0]);
            assert!(
                (line.orders["errors.energy"].unwrap().exponent - order).abs() < 1e-12
                    && (line.cost.unwrap().exponent - 1.0).abs() < 1e-12
            );
            let time = line.points[0].time.unwrap();
            assert_eq!((time.least, time.median, time.most, line.points[0].iterations), (4.0, 6.0, 8.0, Some(11.0)));
        }
        let fronts: Vec<bool> =
            lines.iter().flat_map(|line| &line.points).map(|point| point.front.contains("errors.energy")).collect();
        assert_eq!(fronts, [false, false, false, true, true, true]);
        assert!(lines[0].orders["errors.force"].is_none() && lines[0].points[0].errors.len() == 1, "what is not known");
    }

    #[test]
    fn what_has_not_converged_is_no_point() {
        let plan = plan();
        let mut results = results(&plan);
        for index in [0, 1, 2] {
            results[index].status = RunStatus::NotConverged;
        }
        let lines = lines(&plan, &results);
        assert_eq!(lines[0].points.len(), 2);
        assert_eq!(lines[0].points[0].time, Spread::of(vec![8.0]), "the repeat that converged");
        assert!(lines[0].cost.is_none() && lines[1].cost.is_some());
    }

    #[test]
    fn lines_are_told_apart_by_what_differs() {
        let mut plan = plan();
        for (index, run) in plan.runs.iter_mut().enumerate() {
            run.curve = None;
            run.values[1] = Some(if index < 6 { "auto" } else { "direct" }.into());
            run.ranks = if index < 6 { 1 } else { 2 };
        }
        let names = |plan: &Plan| lines(plan, &results(plan)).into_iter().map(|line| line.name).collect::<Vec<_>>();
        assert_eq!(names(&plan), ["auto, 1 rank", "direct, 2 ranks"]);
        plan.along = vec!["solver.name".into()];
        assert_eq!(names(&plan)[..2], ["refine 3, 1 rank", "refine 1, 1 rank"]);
        plan.along.push("mesh.refine".into());
        assert_eq!(names(&plan), ["1 rank", "2 ranks"]);
        for run in &mut plan.runs {
            (run.ranks, run.values) = (1, vec![Some(1.into()), Some("auto".into())]);
        }
        assert_eq!(names(&plan), ["bars"]);
    }
}
