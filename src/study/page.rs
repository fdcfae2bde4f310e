//! `study.html`: figure and tables in one file, which needs nothing else.

use super::figure::law;
use super::fit::{FARTHEST, FITTED};
use super::format::{Readable, about};
use super::lines::{Line, LinePoint};
use super::table::Table;

const STYLE: &str = "body { font: 15px/1.45 sans-serif; color: #262626; margin: 2em auto; padding: 0 1em; max-width: 70em }\n\
h1, h2 { line-height: 1.2 }\n\
table { border-collapse: collapse; font-size: 13px }\n\
th, td { border: 1px solid #ddd; padding: .2em .5em; text-align: left }\n\
th { background: #f4f4f4 }\n\
td.number { text-align: right; white-space: nowrap }\n\
div.wide { overflow-x: auto }\n\
svg { max-width: 100%; height: auto }\n";

/// The page. It is well-formed XML too.
pub fn html(table: &Table, lines: &[Line], figure: Option<&str>) -> String {
    let mut sections = vec![paragraph(&about(table))];
    if let Some(figure) = figure {
        sections.push(format!("<div class=\"wide\">\n{figure}</div>\n"));
        sections.push(heading("Orders and costs"));
        sections.push(paragraph(&[
            "N is the number of unknowns, h the edge length with h² ~ 1/N.".into(),
            format!("Exponents are fitted through the {FITTED} points of a line with most unknowns."),
            format!("Where one of them is further from the fit than by a factor of {FARTHEST}, it is no power law."),
        ]));
        sections.push(laws(table, lines));
    }
    for error in &table.errors {
        if lines.iter().flat_map(|line| &line.points).any(|point| point.front.contains(error)) {
            sections.push(heading(&format!("The Pareto front of {error}")));
            sections.push(paragraph(&["No other run of the case is both as fast and as accurate.".into()]));
            sections.push(front(table, lines, error));
        }
    }
    sections.push(heading("All runs"));
    let all = Readable::new(table);
    let header: Vec<&str> = all.header.iter().map(String::as_str).collect();
    sections.push(format!("<div class=\"wide\">\n{}</div>\n", rows(&header, &all.rows)));
    format!(
        "<!DOCTYPE html>\n<html xmlns=\"http://www.w3.org/1999/xhtml\" lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n\
         <title>Study {name}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n<h1>Study {name}</h1>\n{}</body>\n</html>\n",
        sections.concat(),
        name = escape(&table.study),
    )
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

/// A table.
fn rows(header: &[&str], rows: &[Vec<String>]) -> String {
    let cell = |text: &String| {
        let is_number = text.split([' ', '^']).next().is_some_and(|word| word.parse::<f64>().is_ok());
        format!("<td{}>{}</td>", if is_number { " class=\"number\"" } else { "" }, escape(text))
    };
    let row = |cells: &Vec<String>| format!("<tr>{}</tr>\n", cells.iter().map(cell).collect::<String>());
    let names: String = header.iter().map(|name| format!("<th>{}</th>", escape(name))).collect();
    format!("<table>\n<tr>{names}</tr>\n{}</table>\n", rows.iter().map(row).collect::<String>())
}

fn heading(text: &str) -> String {
    format!("<h2>{}</h2>\n", escape(text))
}

fn paragraph(sentences: &[String]) -> String {
    format!("<p>{}</p>\n", escape(&sentences.join(" ")))
}

/// Text that is no markup.
fn escape(text: &str) -> String {
    let visible: String = text.chars().filter(|letter| !letter.is_control() || *letter == '\n').collect();
    visible.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::fit::PowerLaw;
    use crate::study::repeats::Spread;
    use crate::study::table::{Column, ColumnKind};

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
        let page = html(&table, std::slice::from_ref(&line), Some("<svg></svg>\n"));
        for words in ["<h1>Study a &lt; b</h1>", "<svg></svg>", "P1 &amp; &lt;P0&gt;", "h^2.00", "too few points", "runs/004"] {
            assert!(page.contains(words), "{words}: {page}");
        }
        assert_eq!(page.matches("runs/004").count(), 1, "one of both points is on the front");
        let bare = html(&Table { errors: Vec::new(), ..table }, &[], None);
        assert!(!bare.contains("svg>") && !bare.contains("Pareto") && !bare.contains("Orders"), "{bare}");
    }
}
