//! `report.html` of a study: figures and tables in one file, which needs nothing else.

use super::figure::law;
use super::format::{about, readable};
use crate::output::markup::{document, figure, grid, header, list, paragraph, section, table as rows};
use crate::output::plot::{Diagram, DiagramBlock, diagrams, named_diagrams};
use crate::study::table::fit::{FARTHEST, FITTED};
use crate::study::table::lines::{Line, LinePoint};
use crate::study::table::rows::Table;
use std::slice::from_ref;

/// The figures of a study.
#[derive(Default)]
pub struct Figures {
    /// What it asks for, case by case.
    pub asked: Vec<Diagram>,
    /// What an error or a size costs, case by case.
    pub first: Vec<Diagram>,
    /// All diagrams, case by case.
    pub all: Vec<DiagramBlock>,
}

/// The page, with the figures that there are, one for each case side by side. It is well-formed XML too.
pub fn html(table: &Table, lines: &[Line], figures: &Figures) -> String {
    let mut sections = Vec::new();
    if !figures.asked.is_empty() {
        let words = "What the study asks for. Hollow marks have a pressure that is not to be trusted.";
        sections.extend([paragraph(words), grid(figures.asked.iter().filter_map(named))]);
    }
    if !figures.first.is_empty() {
        let words = match table.errors.first() {
            Some(error) => format!(
                "What an error costs: {} against {error}, which becomes better to the right. Grey: the Pareto front. Hollow marks are not to be trusted; bars reach from the fastest to the slowest repeat.",
                table.time
            ),
            None => format!("What a size costs: {} against displacement unknowns.", table.time),
        };
        sections.extend([paragraph(&words), grid(figures.first.iter().filter_map(named))]);
    }
    for (number, error) in table.errors.iter().enumerate() {
        if lines.iter().flat_map(|line| &line.points).any(|point| point.front.contains(error)) {
            sections.push(section(&format!("front-{}", number + 1), &format!("The Pareto front of {error}")));
            sections.push(paragraph("No other run of the case is both as fast and as accurate."));
            sections.push(front(table, lines, error));
        }
    }
    if !figures.first.is_empty() {
        sections.push(section("laws", "Orders and costs"));
        sections.push(paragraph(&format!(
            "N is the number of unknowns, h the edge length with h² ~ 1/N. Exponents are fitted through the {FITTED} points of a line with most unknowns. Where one of them is further from the fit than by a factor of {FARTHEST}, it is no power law."
        )));
        sections.push(laws(table, lines));
    }
    if !figures.all.is_empty() {
        sections.push(section("diagrams", "All diagrams"));
        let block = |block: &DiagramBlock| Some(figure(&diagrams(from_ref(block))?, &block.title));
        sections.extend([paragraph("Errors, times, iterations of all lines."), grid(figures.all.iter().filter_map(block))]);
    }
    sections.push(section("runs", "All runs"));
    let (header_row, all) = readable(table);
    sections.push(rows(&header_row, &all));
    let body = header("Study", &table.study) + &list(&about(table)) + &sections.concat();
    document(&format!("Study {}", table.study), &body)
}

/// A diagram of one case.
fn named(diagram: &Diagram) -> Option<String> {
    Some(figure(&named_diagrams(from_ref(diagram))?, &diagram.title))
}

/// Orders and costs of all lines.
fn laws(table: &Table, lines: &[Line]) -> String {
    let errors = || table.errors.iter().map(String::as_str);
    let header: Vec<&str> = ["case", "line"].into_iter().chain(errors()).chain([table.time.as_str()]).collect();
    let row = |line: &Line| {
        let mut cells = vec![line.case.clone(), line.name.clone()];
        cells.extend(errors().map(|error| law("h", line.orders.get(error).copied().flatten())));
        cells.push(law("N", line.cost));
        cells
    };
    rows(&header, &lines.iter().map(row).collect::<Vec<_>>())
}

/// The points that no other beats, from the fastest to the most accurate one.
fn front(table: &Table, lines: &[Line], error: &str) -> String {
    let header = ["case", "line", "unknowns", &table.time, error, "result"];
    let mut best: Vec<(&Line, &LinePoint, (f64, f64))> = Vec::new();
    for line in lines {
        let points = line.points.iter().filter(|point| point.front.contains(error));
        best.extend(points.filter_map(|point| Some((line, point, point.race(error)?))));
    }
    let place = |case: &str| lines.iter().position(|line| line.case == case);
    best.sort_by(|a, b| place(&a.0.case).cmp(&place(&b.0.case)).then(a.2.0.total_cmp(&b.2.0)));
    let row = |(line, point, (time, error)): &(&Line, &LinePoint, (f64, f64))| {
        let numbers = [format!("{}", point.unknowns), format!("{time:.3}"), format!("{error:.2e}")];
        [line.case.clone(), line.name.clone()].into_iter().chain(numbers).chain([point.result.clone()]).collect()
    };
    rows(&header, &best.iter().map(row).collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::plot::{Axis, DiagramLine, Mark};
    use crate::study::table::fit::PowerLaw;
    use crate::study::table::repeats::Spread;
    use crate::study::table::rows::{Column, ColumnKind};

    #[test]
    fn the_page_holds_figure_laws_front_and_escaped_words() {
        let point = |unknowns: f64, front: &[&str]| LinePoint {
            unknowns,
            iterations: Some(5.0),
            time: Spread::of(vec![0.5]),
            errors: [("errors.energy".to_string(), 1e-3)].into(),
            memory: None,
            trusted: true,
            front: front.iter().map(|error| (*error).to_owned()).collect(),
            result: "runs/004".into(),
        };
        let points = vec![point(1e3, &["errors.energy"]), point(4e3, &[])];
        let law = Some(PowerLaw { exponent: 2.0, deviation: 1.0 });
        let orders = [("errors.energy".to_string(), law)].into();
        let line = Line {
            case: "bars".into(),
            title: "Two bars".into(),
            name: "P1 & <P0>".into(),
            ranks: 1,
            orders,
            cost: None,
            points,
        };
        let table = Table { study: "a < b".into(), errors: vec!["errors.energy".into()], ..Table::default() };
        let table =
            Table { columns: ["status", "reason", "repeat"].map(|name| Column::new(name, ColumnKind::Main)).to_vec(), ..table };
        let diagram = |x: &str| Diagram {
            x: Axis::logarithmic(x),
            lines: vec![DiagramLine { marks: vec![Mark::at(1.0, 2.0, false)], ..DiagramLine::default() }],
            ..Diagram::default()
        };
        let figures = Figures {
            asked: ["young", "size"].map(diagram).to_vec(),
            first: vec![diagram("errors")],
            all: vec![DiagramBlock { diagrams: vec![diagram("unknowns")], ..DiagramBlock::default() }],
        };
        let page = html(&table, from_ref(&line), &figures);
        for words in [
            "<h1>a &lt; b</h1>",
            ">young<",
            ">size<",
            ">errors<",
            ">unknowns<",
            "errors.energy, which becomes better",
            "P1 &amp; &lt;P0&gt;",
            "h^2.00",
            "too few points",
            "runs/004",
        ] {
            assert!(page.contains(words), "{words}: {page}");
        }
        assert_eq!(page.matches("runs/004").count(), 1, "one of both points is on the front");
        assert_eq!((page.matches("<div class=\"grid\">").count(), page.matches("<figure>").count()), (3, 4), "{page}");
        let bare = html(&Table { errors: Vec::new(), ..table }, &[], &Figures::default());
        assert!(!bare.contains("svg>") && !bare.contains("Pareto") && !bare.contains("Orders"), "{bare}");
    }
}
