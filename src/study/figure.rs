//! The figure of a study: lines as diagrams, one block for each case.

use super::fit::PowerLaw;
use super::lines::{Line, Point};
use super::plan::Plan;
use crate::output::plot::{Axis, Block, Diagram, Entry, Mark, diagrams};

/// The text of `study.svg`; None if no line has two points.
///
/// # Errors
/// It cannot be drawn, in words.
pub fn figure(plan: &Plan, lines: &[Line]) -> Result<Option<String>, String> {
    if lines.iter().all(|line| line.points.len() < 2) {
        return Ok(None);
    }
    let mut cases: Vec<&str> = Vec::new();
    let mut names: Vec<&str> = Vec::new();
    for line in lines {
        if !cases.contains(&line.case.as_str()) {
            cases.push(&line.case);
        }
        if !names.contains(&line.name.as_str()) {
            names.push(&line.name);
        }
    }
    let style = |line: &Line| names.iter().position(|name| *name == line.name).unwrap_or_default();
    let block = |case: &&str| {
        let own: Vec<(usize, &Line)> =
            lines.iter().filter(|line| line.case == **case && !line.points.is_empty()).map(|line| (style(line), line)).collect();
        let title = own.first().map(|(_, line)| line.title.as_str()).filter(|title| !title.is_empty());
        let title = title.map_or((*case).to_owned(), |title| format!("{case}: {title}"));
        Block { title, legend: own.iter().map(entry).collect(), diagrams: of_case(plan, &own) }
    };
    diagrams(&cases.iter().map(block).collect::<Vec<_>>())
}

/// A line's row in the legend: its name, its order, its cost.
fn entry((style, line): &(usize, &Line)) -> Entry {
    let mut cells = vec![line.name.clone()];
    if line.points.iter().any(|point| point.error.is_some()) {
        cells.push(law("error ~ h", line.order));
    }
    cells.push(law("time ~ N", line.cost));
    Entry { style: *style, cells }
}

/// A power law in words.
pub fn law(words: &str, law: Option<PowerLaw>) -> String {
    match law {
        Some(law) if law.holds() => format!("{words}^{:.2}", law.exponent),
        Some(_) => format!("{words}: no power law"),
        None => format!("{words}: too few points"),
    }
}

/// How a point is drawn in a diagram.
type Reading = fn(&Point) -> Option<Mark>;

fn mark(x: f64, y: f64, point: &Point) -> Mark {
    Mark { x, y, reach: [y, y], hollow: !point.trusted }
}

/// Diagrams of one case: with errors, time against error and error, iterations and time against unknowns; without, memory too.
fn of_case(plan: &Plan, lines: &[(usize, &Line)]) -> Vec<Diagram> {
    let axis = |name: String, logarithmic| Axis { name, logarithmic };
    let unknowns = || axis("unknowns N".into(), true);
    let time = || axis(format!("{} [s]", plan.time.text), true);
    let error = || axis(plan.error.as_ref().map_or(String::new(), |path| path.text.clone()), true);
    let diagram = |title: &str, x: Axis, y: Axis, reading: Reading| Diagram {
        title: title.into(),
        x,
        y,
        behind: Vec::new(),
        lines: lines.iter().map(|(style, line)| (*style, line.points.iter().filter_map(reading).collect())).collect(),
    };
    let mut race = diagram("time against error (grey: the Pareto front)", error(), time(), |point| {
        let (time, error) = (point.time?, point.error?);
        Some(Mark { reach: [time.least, time.most], ..mark(error, time.median, point) })
    });
    race.behind = front(lines);
    let accuracy =
        diagram("error against unknowns", unknowns(), error(), |point| Some(mark(point.unknowns, point.error?, point)));
    let speed = diagram("time against unknowns", unknowns(), time(), |point| {
        let time = point.time?;
        Some(Mark { reach: [time.least, time.most], ..mark(point.unknowns, time.median, point) })
    });
    let iterations =
        diagram("Krylov iterations against unknowns", unknowns(), axis("iterations of all solves".into(), false), |point| {
            Some(mark(point.unknowns, point.iterations?, point))
        });
    let memory = diagram("memory against unknowns", unknowns(), axis("memory of all ranks [MiB]".into(), true), |point| {
        Some(mark(point.unknowns, point.memory?, point))
    });
    if plan.error.is_some() { vec![race, accuracy, speed, iterations] } else { vec![speed, iterations, memory] }
}

/// Errors and times of the points that no other beats, from the least accurate on, in steps: between two of them the time of the
/// more accurate one is the least.
fn front(lines: &[(usize, &Line)]) -> Vec<(f64, f64)> {
    let points = lines.iter().flat_map(|(_, line)| &line.points).filter(|point| point.front);
    let mut best: Vec<(f64, f64)> = points.filter_map(|point| point.race().map(|(time, error)| (error, time))).collect();
    best.sort_by(|a, b| b.0.total_cmp(&a.0));
    let steps = best.windows(2).flat_map(|pair| [pair[0], (pair[0].0, pair[1].1)]);
    steps.chain(best.last().copied()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn laws_are_told_only_where_they_hold() {
        let of = |deviation| Some(PowerLaw { exponent: 1.8249, deviation });
        assert_eq!(law("error ~ h", of(1.1)), "error ~ h^1.82");
        assert_eq!(law("error ~ h", of(2.0)), "error ~ h: no power law");
        assert_eq!(law("error ~ h", None), "error ~ h: too few points");
    }

    fn line(front_errors: &[f64]) -> Line {
        let point = |error: &f64| Point {
            unknowns: 1.0 / error,
            iterations: None,
            time: super::super::repeats::Spread::of(vec![1.0 / error]),
            error: Some(*error),
            memory: None,
            trusted: true,
            front: true,
            result: String::new(),
        };
        let points = front_errors.iter().map(point).collect();
        Line { case: "bars".into(), title: "Two bars".into(), name: "P1".into(), ranks: 1, order: None, cost: None, points }
    }

    #[test]
    fn the_front_goes_down_in_steps() {
        let line = line(&[0.1, 0.5, 0.25]);
        assert_eq!(front(&[(0, &line)]), [(0.5, 2.0), (0.5, 4.0), (0.25, 4.0), (0.25, 10.0), (0.1, 10.0)]);
        assert!(front(&[]).is_empty());
    }
}
