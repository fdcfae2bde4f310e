//! The figure that a study asks for: one column against another, in lines by a third one.

use super::format::plain;
use crate::output::plot::{Axis, Diagram, DiagramLine, Mark};
use crate::study::table::repeats::condensed;
use crate::study::table::rows::{ColumnKind, Table, once};

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
    let [low, high] = values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(value), high.max(value)]);
    let logarithmic = low > 0.0 && high > DECADES * low;
    Axis { name, logarithmic, fits: true, ..Axis::default() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::Units;
    use crate::study::runs::ended::RunStatus::{Converged, NotConverged};
    use crate::study::table::rows::Column;
    use serde_json::{Value, json};

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
