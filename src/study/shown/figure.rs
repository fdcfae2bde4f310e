//! The figures of a study: one column against another, in lines by a third one; what an error costs; and lines as diagrams, one block
//! for each case.

use super::format::plain;
use crate::output::plot::{Axis, Diagram, DiagramBlock, DiagramLine, LegendCell, Mark, range_of};
use crate::study::plan::Plan;
use crate::study::plan::summary_path::SummaryPath;
use crate::study::table::fit::PowerLaw;
use crate::study::table::lines::{Line, LinePoint};
use crate::study::table::repeats::condensed;
use crate::study::table::rows::{ColumnKind, Table, once};

/// What a diagram shows of the size of a run.
const UNKNOWNS: &str = "unknowns N";

/// What `study.svg` has one below the other: for each case, time against the first error, or against unknowns without any; none if
/// no line has two points.
pub fn first_diagrams(plan: &Plan, lines: &[Line]) -> Vec<Diagram> {
    by_case(lines).iter().map(|case| case.race(plan)).collect()
}

/// What `study_all.svg` has: all diagrams of each case; none if no line has two points.
pub fn all_diagrams(plan: &Plan, lines: &[Line]) -> Vec<DiagramBlock> {
    let block = |case: &CaseLines| {
        let legend = case.lines.iter().map(|(style, line)| entry(plan, *style, line)).collect();
        DiagramBlock { title: case.title.clone(), legend, diagrams: case.diagrams(plan) }
    };
    by_case(lines).iter().map(block).collect()
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
fn entry(plan: &Plan, style: usize, line: &Line) -> Vec<LegendCell> {
    let order = |error: &SummaryPath| law(&format!("{} ~ h", error.text), line.orders.get(&error.text).copied().flatten());
    let laws = plan.errors.iter().map(order).chain([law("time ~ N", line.cost)]).map(LegendCell::words);
    [LegendCell::marked(line.name.as_str(), style)].into_iter().chain(laws).collect()
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
    fn diagram(&self, title: &str, [x, y]: [&str; 2], place: &dyn Fn(&LinePoint) -> Option<Mark>) -> Diagram {
        let drawn = |(style, line): &(usize, &Line)| DiagramLine {
            name: line.name.clone(),
            style: *style,
            marks: line.points.iter().filter_map(place).collect(),
            ..DiagramLine::default()
        };
        let lines = self.lines.iter().map(drawn).collect();
        Diagram { title: title.into(), x: Axis::logarithmic(x), y: Axis::logarithmic(y), behind: Vec::new(), lines }
    }

    /// Time against an error.
    fn time_against(&self, title: &str, error: &str, [x, y]: [&str; 2]) -> Diagram {
        let race = self.diagram(title, [x, y], &|point| timed(*point.errors.get(error)?, point));
        Diagram { behind: front(&self.lines, error), ..race }
    }

    /// What an error costs, or a size where no error is asked for.
    fn race(&self, plan: &Plan) -> Diagram {
        let time = format!("{} [s]", plan.time.text);
        let Some(SummaryPath { text: error, .. }) = plan.errors.first() else {
            return self.diagram(&self.title, [UNKNOWNS, &time], &|point| timed(point.unknowns, point));
        };
        let mut race = self.time_against(&self.title, error, [&format!("{error}, better to the right"), &time]);
        race.x.falling = true;
        // Names stand where a line has come farthest.
        for line in &mut race.lines {
            if line.marks.first().zip(line.marks.last()).is_some_and(|(first, last)| first.x < last.x) {
                line.marks.reverse();
            }
        }
        race
    }

    /// For each error, time against error and error against unknowns; then time and iterations against unknowns, and without
    /// errors memory too.
    fn diagrams(&self, plan: &Plan) -> Vec<Diagram> {
        let time = &format!("{} [s]", plan.time.text);
        let mut all = Vec::new();
        for SummaryPath { text: error, .. } in &plan.errors {
            all.push(self.time_against("time against error (grey: the Pareto front)", error, [error, time]));
            let place = |point: &LinePoint| sized(point, point.errors.get(error).copied());
            all.push(self.diagram("error against unknowns", [UNKNOWNS, error], &place));
        }
        all.push(self.diagram("time against unknowns", [UNKNOWNS, time], &|point| timed(point.unknowns, point)));
        let iterations = self.diagram("Krylov iterations against unknowns", [UNKNOWNS, "iterations of all solves"], &|point| {
            sized(point, point.iterations)
        });
        all.push(Diagram { y: Axis { logarithmic: false, ..iterations.y }, ..iterations });
        if plan.errors.is_empty() {
            let memory = [UNKNOWNS, "memory of all ranks [MiB]"];
            all.push(self.diagram("memory against unknowns", memory, &|point| sized(point, point.memory)));
        }
        all
    }
}

/// What is known of a point above its size.
fn sized(point: &LinePoint, y: Option<f64>) -> Option<Mark> {
    Some(Mark::at(point.unknowns, y?, !point.trusted))
}

/// The time of a point, with its spread.
fn timed(x: f64, point: &LinePoint) -> Option<Mark> {
    let time = point.time?;
    Some(Mark { reach: [time.least, time.most], ..Mark::at(x, time.median, !point.trusted) })
}

/// Errors and times of the points that no other beats, from the least accurate on, in steps: between two of them the time of the
/// more accurate one is the least.
fn front(lines: &[(usize, &Line)], error: &str) -> Vec<[f64; 2]> {
    let points = lines.iter().flat_map(|(_, line)| &line.points).filter(|point| point.front.contains(error));
    let mut best: Vec<[f64; 2]> = points.filter_map(|point| point.race(error).map(|(time, error)| [error, time])).collect();
    best.sort_by(|a, b| b[0].total_cmp(&a[0]));
    let steps = best.windows(2).flat_map(|pair| [pair[0], [pair[0][0], pair[1][1]]]);
    steps.chain(best.last().copied()).collect()
}

/// Values whose largest is so many times the smallest have a logarithmic axis.
const DECADES: f64 = 30.0;

/// A diagram for each case, of the runs that have converged, with the columns of these names: what is across, what is up, and by
/// what lines are told apart, which otherwise is everything that the study has asked for and that differs.
pub fn asked_diagrams(table: &Table, names: &[String]) -> Vec<Diagram> {
    let table = condensed(table);
    let places: Option<Vec<usize>> = names.iter().map(|name| table.place(name)).collect();
    let (Some([x, y, by @ ..]), Some(case)) = (places.as_deref(), table.place("case")) else { return Vec::new() };
    let of_case = |name: &String| {
        let converged = table.converged(0..table.rows.len());
        let rows: Vec<usize> = converged.filter(|&row| table.rows[row][case] == name.as_str()).collect();
        let differs = |&at: &usize| rows.iter().any(|&row| table.rows[row][at] != table.rows[rows[0]][at]);
        let given = (0..table.columns.len()).filter(|&at| table.columns[at].kind == ColumnKind::Given && at != *x);
        let by = if by.is_empty() {
            given.filter(|&at| table.columns[at].name != "repeat").filter(differs).collect()
        } else {
            by.to_vec()
        };
        let points: Vec<(String, Mark)> = rows.iter().filter_map(|&row| point(&table, row, [*x, *y], &by)).collect();
        let line = |(style, name): (usize, String)| {
            let own = points.iter().filter(|(other, _)| *other == name);
            let mut marks: Vec<Mark> = own.map(|(_, mark)| *mark).collect();
            marks.sort_by(|a, b| a.x.total_cmp(&b.x));
            DiagramLine { name, style, marks, ..DiagramLine::default() }
        };
        let mut lines = once(points.iter().map(|(name, _)| name.as_str()));
        lines.extend(points.iter().any(|(name, _)| name.is_empty()).then(String::new));
        Diagram {
            title: format!("{name}: {} against {}", names[1], names[0]),
            x: axis(table.units.of_place(&names[0]), points.iter().map(|(_, mark)| mark.x)),
            y: axis(table.units.of_place(&names[1]), points.iter().map(|(_, mark)| mark.y)),
            lines: lines.into_iter().enumerate().map(line).collect(),
            ..Diagram::default()
        }
    };
    let cases = once(table.rows.iter().filter_map(|row| row[case].as_str()));
    cases.iter().map(of_case).filter(|diagram| !diagram.lines.is_empty()).collect()
}

/// The point of a row, if both columns hold numbers, and the name of its line.
fn point(table: &Table, row: usize, [x, y]: [usize; 2], by: &[usize]) -> Option<(String, Mark)> {
    let cells = &table.rows[row];
    let word = |at: &usize| match cells[*at].as_str() {
        Some(word) => word.to_owned(),
        None => format!("{} {}", table.columns[*at].name.rsplit('.').next().unwrap_or_default(), plain(&cells[*at])),
    };
    let name: Vec<String> = by.iter().filter(|at| !cells[**at].is_null()).map(word).collect();
    Some((name.join(", "), Mark::at(cells[x].as_f64()?, cells[y].as_f64()?, !table.good[row])))
}

/// An axis around values, logarithmic where they span decades.
fn axis(name: String, values: impl Iterator<Item = f64>) -> Axis {
    let [low, high] = range_of(values);
    let logarithmic = low > 0.0 && high > DECADES * low;
    Axis { name, logarithmic, fits: true, ..Axis::default() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::Units;
    use crate::study::runs::ended::RunStatus::{Converged, NotConverged};
    use crate::study::table::repeats::Spread;
    use crate::study::table::rows::Column;
    use serde_json::{Value, json};

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
        assert_eq!(front(&[(0, &line)], "e"), [[0.5, 2.0], [0.5, 4.0], [0.25, 4.0], [0.25, 10.0], [0.1, 10.0]]);
        assert!(front(&[], "e").is_empty());
    }

    /// Two spaces on three stiffnesses, and a run that has not converged.
    fn table() -> Table {
        let (given, main) = (ColumnKind::Given, ColumnKind::Main);
        let columns =
            [("case", given), ("curve", given), ("ranks", given), ("repeat", given), ("body.a.young", given), ("c.space", given)];
        let columns = columns.into_iter().chain([("status", main), ("reason", main), ("contact.seam.pressure_max", main)]);
        let row =
            |young: f64, space: &str, status: &str, most: Value| json!(["bars", null, 1, 1, young, space, status, "", most]);
        let rows = [
            row(1000.0, "p0", "converged", json!(3.0)),
            row(10.0, "p0", "converged", json!(1.0)),
            row(10.0, "p1", "converged", json!(-1.5)),
            row(1000.0, "p1", "converged", json!(2.5)),
            row(100.0, "p1", "not_converged", json!(9.0)),
            row(100.0, "p0", "converged", Value::Null),
        ];
        Table {
            columns: columns.map(|(name, kind)| Column::new(name, kind)).collect(),
            rows: rows.map(|row| row.as_array().expect("a list").clone()).to_vec(),
            groups: (0..6).map(|row| row..row + 1).collect(),
            statuses: vec![Converged, Converged, Converged, Converged, NotConverged, Converged],
            good: vec![true, true, false, true, true, true],
            ..Table::default()
        }
    }

    #[test]
    fn a_column_is_drawn_against_another_in_lines_by_a_third() {
        let names = |by: Option<&str>| {
            ["body.a.young", "contact.seam.pressure_max"].into_iter().chain(by).map(String::from).collect::<Vec<_>>()
        };
        let drawn = |by: Option<&str>| asked_diagrams(&table(), &names(by));
        let [by_space] = &drawn(Some("c.space"))[..] else { panic!("one case") };
        assert_eq!(by_space.title, "bars: contact.seam.pressure_max against body.a.young");
        assert!(by_space.x.logarithmic && !by_space.y.logarithmic, "a pressure below zero has no logarithm");
        let named = Table { units: Units::new(Some("mm"), Some("N"), false), ..table() };
        assert_eq!(asked_diagrams(&named, &names(None))[0].y.name, "contact.seam.pressure_max [MPa]");
        let lines: Vec<(&str, Vec<[f64; 2]>)> = by_space
            .lines
            .iter()
            .map(|line| (line.name.as_str(), line.marks.iter().map(|mark| [mark.x, mark.y]).collect()))
            .collect();
        assert_eq!(lines, [("p0", vec![[10.0, 1.0], [1000.0, 3.0]]), ("p1", vec![[10.0, -1.5], [1000.0, 2.5]])]);
        assert!(by_space.lines[1].marks[0].hollow && !by_space.lines[1].marks[1].hollow);
        let named = |by: Option<&str>| drawn(by)[0].lines.iter().map(|line| line.name.clone()).collect::<Vec<_>>();
        assert_eq!(named(None), ["p0", "p1"], "what differs, but for what is across");
        assert_eq!(named(Some("ranks")), ["ranks 1"], "all points in one line");
        let mut alone = table();
        alone.rows.truncate(2);
        alone.groups.truncate(2);
        let diagrams = asked_diagrams(&alone, &names(None));
        assert_eq!((diagrams[0].lines.len(), diagrams[0].lines[0].marks.len()), (1, 2), "one line needs no name");
        assert!(asked_diagrams(&table(), &["body.a.young".into(), "c.space".into()]).is_empty(), "words are no numbers");
        assert!(asked_diagrams(&table(), &["body.a.young".into(), "nothing".into()]).is_empty());
    }
}
