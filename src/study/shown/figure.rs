//! The figures of a study: what an error costs, and lines as diagrams, one block for each case.

use crate::output::plot::{Axis, Diagram, DiagramBlock, LegendRow, Mark, NamedDiagram, NamedLine, diagrams, named_diagrams};
use crate::study::plan::Plan;
use crate::study::plan::summary_path::SummaryPath;
use crate::study::table::fit::PowerLaw;
use crate::study::table::lines::{Line, LinePoint};
use crate::study::table::rows::once;

/// The text of `study.svg`: for each case, time against the first error, or against unknowns without any; None if no line has
/// two points.
///
/// # Errors
/// It cannot be drawn, in words.
pub fn first_figure(plan: &Plan, lines: &[Line]) -> Result<Option<String>, String> {
    named_diagrams(&by_case(lines).iter().map(|case| case.race(plan)).collect::<Vec<_>>())
}

/// The text of `study_all.svg`: all diagrams of all cases; None if no line has two points.
///
/// # Errors
/// It cannot be drawn, in words.
pub fn all_figures(plan: &Plan, lines: &[Line]) -> Result<Option<String>, String> {
    let block = |case: &CaseLines| {
        let legend = case.lines.iter().map(|(style, line)| entry(plan, *style, line)).collect();
        DiagramBlock { title: case.title.clone(), legend, diagrams: case.diagrams(plan) }
    };
    diagrams(&by_case(lines).iter().map(block).collect::<Vec<_>>())
}

/// The lines of each case, with styles by their names; none at all if no line has two points.
fn by_case(lines: &[Line]) -> Vec<CaseLines<'_>> {
    if lines.iter().all(|line| line.points.len() < 2) {
        return Vec::new();
    }
    let (cases, names) = (once(lines.iter().map(|line| line.case.as_str())), once(lines.iter().map(|line| line.name.as_str())));
    let style = |line: &Line| names.iter().position(|name| *name == line.name).unwrap_or_default();
    let of_case = |case: &String| {
        let own = lines.iter().filter(|line| line.case == *case && !line.points.is_empty());
        let own: Vec<(usize, &Line)> = own.map(|line| (style(line), line)).collect();
        let title = own.first().map(|(_, line)| line.title.as_str()).filter(|title| !title.is_empty());
        let title = title.map_or(case.clone(), |title| format!("{case}: {title}"));
        CaseLines { title, lines: own }
    };
    cases.iter().map(of_case).collect()
}

/// A line's row in the legend: its name, its orders, its cost.
fn entry(plan: &Plan, style: usize, line: &Line) -> LegendRow {
    let order = |error: &SummaryPath| law(&format!("{} ~ h", error.text), line.orders.get(&error.text).copied().flatten());
    let cells = [line.name.clone()].into_iter().chain(plan.errors.iter().map(order)).chain([law("time ~ N", line.cost)]);
    LegendRow { style, cells: cells.collect() }
}

/// A power law in words.
pub fn law(words: &str, law: Option<PowerLaw>) -> String {
    match law {
        Some(law) if law.holds() => format!("{words}^{:.2}", law.exponent),
        Some(_) => format!("{words}: no power law"),
        None => format!("{words}: too few points"),
    }
}

/// The lines of one case, with their styles.
struct CaseLines<'a> {
    /// Name and title of the case.
    title: String,
    lines: Vec<(usize, &'a Line)>,
}

impl CaseLines<'_> {
    /// A diagram with logarithmic axes, of the points that have a place in it.
    fn diagram(&self, title: &str, axes: [&str; 2], place: &dyn Fn(&LinePoint) -> Option<Mark>) -> Diagram {
        let [x, y] = axes.map(axis);
        let marks = |line: &Line| line.points.iter().filter_map(place).collect();
        let lines = self.lines.iter().map(|(style, line)| (*style, marks(line))).collect();
        Diagram { title: title.into(), x, y, behind: Vec::new(), lines }
    }

    /// What an error costs, or a size where no error is asked for.
    fn race(&self, plan: &Plan) -> NamedDiagram {
        let error = plan.errors.first().map(|error| error.text.as_str());
        let place =
            |point: &LinePoint| timed(error.map_or(Some(point.unknowns), |error| point.errors.get(error).copied())?, point);
        let line = |(style, line): &(usize, &Line)| {
            let mut marks: Vec<Mark> = line.points.iter().filter_map(place).collect();
            // Names stand where a line has come farthest.
            if error.is_some() && marks.first().zip(marks.last()).is_some_and(|(first, last)| first.x < last.x) {
                marks.reverse();
            }
            NamedLine { name: line.name.clone(), style: *style, marks }
        };
        NamedDiagram {
            title: self.title.clone(),
            x: axis(&error.map_or(UNKNOWNS.to_owned(), |error| format!("{error}, better to the right"))),
            falling: error.is_some(),
            y: axis(&time_axis(plan)),
            behind: error.map_or(Vec::new(), |error| front(&self.lines, error)),
            lines: self.lines.iter().map(line).collect(),
        }
    }

    /// For each error, time against error and error against unknowns; then time and iterations against unknowns, and without
    /// errors memory too.
    fn diagrams(&self, plan: &Plan) -> Vec<Diagram> {
        let time = &time_axis(plan);
        let mut all = Vec::new();
        for SummaryPath { text: error, .. } in &plan.errors {
            let title = "time against error (grey: the Pareto front)";
            let race = self.diagram(title, [error, time], &|point| timed(*point.errors.get(error)?, point));
            let accuracy = |point: &LinePoint| Some(mark(point.unknowns, *point.errors.get(error)?, point));
            all.push(Diagram { behind: front(&self.lines, error), ..race });
            all.push(self.diagram("error against unknowns", [UNKNOWNS, error], &accuracy));
        }
        all.push(self.diagram("time against unknowns", [UNKNOWNS, time], &|point| timed(point.unknowns, point)));
        let iterations = |point: &LinePoint| Some(mark(point.unknowns, point.iterations?, point));
        let words = "Krylov iterations against unknowns";
        let mut iterations = self.diagram(words, [UNKNOWNS, "iterations of all solves"], &iterations);
        iterations.y.logarithmic = false;
        all.push(iterations);
        if plan.errors.is_empty() {
            let memory = |point: &LinePoint| Some(mark(point.unknowns, point.memory?, point));
            all.push(self.diagram("memory against unknowns", [UNKNOWNS, "memory of all ranks [MiB]"], &memory));
        }
        all
    }
}

/// Name of the axis of sizes.
const UNKNOWNS: &str = "unknowns N";

fn time_axis(plan: &Plan) -> String {
    format!("{} [s]", plan.time.text)
}

fn axis(name: &str) -> Axis {
    Axis { name: name.into(), logarithmic: true }
}

fn mark(x: f64, y: f64, point: &LinePoint) -> Mark {
    Mark { x, y, reach: [y, y], hollow: !point.trusted }
}

/// The time of a point over something, if it is known.
fn timed(x: f64, point: &LinePoint) -> Option<Mark> {
    let time = point.time?;
    Some(Mark { reach: [time.least, time.most], ..mark(x, time.median, point) })
}

/// Errors and times of the points that no other beats, from the least accurate on, in steps: between two of them the time of the
/// more accurate one is the least.
fn front(lines: &[(usize, &Line)], error: &str) -> Vec<(f64, f64)> {
    let points = lines.iter().flat_map(|(_, line)| &line.points).filter(|point| point.front.contains(error));
    let mut best: Vec<(f64, f64)> = points.filter_map(|point| point.race(error).map(|(time, error)| (error, time))).collect();
    best.sort_by(|a, b| b.0.total_cmp(&a.0));
    let steps = best.windows(2).flat_map(|pair| [pair[0], (pair[0].0, pair[1].1)]);
    steps.chain(best.last().copied()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::table::repeats::Spread;

    #[test]
    fn laws_are_told_only_where_they_hold() {
        let of = |deviation| Some(PowerLaw { exponent: 1.8249, deviation });
        assert_eq!(law("error ~ h", of(1.1)), "error ~ h^1.82");
        assert_eq!(law("error ~ h", of(2.0)), "error ~ h: no power law");
        assert_eq!(law("error ~ h", None), "error ~ h: too few points");
    }

    fn line(front_errors: &[f64]) -> Line {
        let point = |error: &f64| LinePoint {
            unknowns: 1.0 / error,
            iterations: None,
            time: Spread::of(vec![1.0 / error]),
            errors: [("e".to_string(), *error)].into(),
            memory: None,
            trusted: true,
            front: ["e".to_string()].into(),
            result: String::new(),
        };
        let points = front_errors.iter().map(point).collect();
        let orders = Default::default();
        Line { case: "bars".into(), title: "Two bars".into(), name: "P1".into(), ranks: 1, orders, cost: None, points }
    }

    #[test]
    fn the_front_goes_down_in_steps() {
        let line = line(&[0.1, 0.5, 0.25]);
        assert_eq!(front(&[(0, &line)], "e"), [(0.5, 2.0), (0.5, 4.0), (0.25, 4.0), (0.25, 10.0), (0.1, 10.0)]);
        assert!(front(&[], "e").is_empty());
    }
}
