//! Diagrams of many runs, in blocks with a legend each.

use super::diagram::Diagram;
use crate::output::plot::drawing::{Canvas, Frame, INK, LegendCell, Letters, head, head_height};

/// Diagrams that share a legend.
#[derive(Clone, Debug, Default)]
pub struct DiagramBlock {
    /// Stands above all.
    pub title: String,
    /// One row for each line.
    pub legend: Vec<Vec<LegendCell>>,
    /// Two stand side by side; one without a mark is left out.
    pub diagrams: Vec<Diagram>,
}

/// Size of a diagram with its axes, and what is above and to the right of the plot in it (pixels).
const PANEL: [f64; 2] = [450.0, 324.0];
const MARGINS: [f64; 2] = [38.0, 18.0];
const COLUMNS: usize = 2;
/// Left of title and legend (pixels).
const LEFT: f64 = 18.0;

/// The text of an SVG file with all blocks one below the other; None if there is no mark in them.
pub fn diagrams(blocks: &[DiagramBlock]) -> Option<String> {
    let visible = |block: &DiagramBlock| block.diagrams.iter().filter_map(Diagram::visible).collect::<Vec<_>>();
    let shown = blocks.iter().map(|block| (block, visible(block))).filter(|(_, diagrams)| !diagrams.is_empty());
    let shown: Vec<(&DiagramBlock, Vec<Diagram>)> = shown.collect();
    let head_of = |block: &DiagramBlock| head_height(block.legend.len());
    let rows = |diagrams: &[Diagram]| diagrams.len().div_ceil(COLUMNS) as f64;
    let height = shown.iter().map(|(block, diagrams)| head_of(block) + PANEL[1] * rows(diagrams)).sum();
    let mut canvas = Canvas::new([PANEL[0] * COLUMNS as f64, height]);
    let mut top = 0.0;
    for (block, diagrams) in &shown {
        head(&mut canvas, [LEFT, top], PANEL[0] * COLUMNS as f64 - LEFT, &block.title, &block.legend);
        top += head_of(block);
        for (index, diagram) in diagrams.iter().enumerate() {
            let [column, row] = [index % COLUMNS, index / COLUMNS].map(|number| number as f64);
            let chart = diagram.chart(Frame::at([column * PANEL[0], top + row * PANEL[1]], PANEL), MARGINS);
            let [left, upper, ..] = chart.frame.0;
            canvas.text(Letters::bold(12.5, INK), [left, upper - 16.0], &diagram.title);
            diagram.draw(&mut canvas, &chart);
        }
        top += PANEL[1] * rows(diagrams);
    }
    (!shown.is_empty()).then(|| canvas.svg())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::plot::diagrams::{DiagramLine, Mark};
    use crate::output::plot::drawing::{Axis, text_width};

    /// Error against unknowns for two lines of these orders, and a diagram without a mark.
    fn block(orders: [f64; 2]) -> DiagramBlock {
        let mark = |order: f64, n: f64| Mark { reach: [n.powf(-order) / 2.0; 2], ..Mark::at(n, n.powf(-order), n > 1e4) };
        let marks = |order: f64| [1e3, 4e3, 1.6e4].map(|n| mark(order, n)).to_vec();
        let line = |(style, order)| DiagramLine { style, marks: marks(order), ..DiagramLine::default() };
        let full = Diagram {
            title: "error & unknowns".into(),
            x: Axis::logarithmic("unknowns"),
            y: Axis::logarithmic("error <1>"),
            behind: vec![[1e3, 1e-3], [1.6e4, 1e-6]],
            lines: orders.into_iter().enumerate().map(line).collect(),
        };
        let entry = |style| vec![LegendCell::marked(format!("line {style}"), style), LegendCell::words("a law")];
        DiagramBlock { title: "bars".into(), legend: vec![entry(0), entry(1)], diagrams: vec![full, Diagram::default()] }
    }

    fn count(text: &str, word: &str) -> usize {
        text.matches(word).count()
    }

    /// Marks of the first two styles: circles and squares.
    fn drawn(text: &str) -> usize {
        count(text, "<circle") + count(text, "<polygon")
    }

    #[test]
    fn every_line_has_its_marks_and_its_row() {
        let text = diagrams(&[block([0.5, 1.0])]).unwrap();
        assert!(text.starts_with("<svg xmlns=") && text.ends_with("</svg>\n"), "{text}");
        assert_eq!(drawn(&text), 2 * 3 + 2, "marks, and samples in the legend");
        assert!(text.contains("error &amp; unknowns") && text.contains("error &lt;1&gt;") && !text.contains("NaN"));
        assert_eq!((count(&text, "line 0"), count(&text, "a law")), (1, 2));
        let two = diagrams(&[block([0.5, 1.0]), block([0.1, 0.2])]).unwrap();
        assert_eq!(drawn(&two), 2 * drawn(&text));
    }

    /// Places and sizes of all texts with these words (tenths of a pixel).
    fn texts(svg: &str, words: &str) -> Vec<(f64, f64)> {
        let value = |tag: &str, name: &str| tag.split(&format!(" {name}=\"")).nth(1)?.split('"').next()?.parse().ok();
        let lines = svg.lines().filter(|line| line.contains(&format!(">{words}")));
        lines.map(|line| (value(line, "x").expect("a place"), value(line, "font-size").expect("a size"))).collect()
    }

    #[test]
    fn a_long_legend_is_drawn_smaller_and_stays_on_the_sheet() {
        let mut long = block([0.5, 1.0]);
        let short = diagrams(&[long.clone()]).unwrap();
        long.legend[1] = vec![LegendCell::words("the name of a line"); 10];
        let text = diagrams(&[long]).unwrap();
        let (found, usual) = (texts(&text, "the name"), texts(&short, "a law")[0].1);
        let (last, size) = found[found.len() - 1];
        assert_eq!(found.len(), 10);
        assert!(size < usual && last + text_width("the name of a line", size) <= 10.0 * 2.0 * PANEL[0], "{found:?}");
    }

    #[test]
    fn what_an_axis_cannot_show_is_left_out() {
        let mut bad = block([0.5, 1.0]);
        let marks = &mut bad.diagrams[0].lines[0].marks;
        (marks[0].y, marks[1].y, marks[2].reach) = (0.0, f64::NAN, [-1.0, 1.0]);
        let text = diagrams(&[bad.clone()]).unwrap();
        assert!(drawn(&text) == 1 + 3 + 2 && !text.contains("NaN"), "{text}");
        bad.diagrams[0].lines.clear();
        assert_eq!(diagrams(&[bad]), None);
        assert_eq!(diagrams(&[]), None);
    }

    #[test]
    fn one_point_is_a_diagram_and_zero_is_one_too() {
        let mut single = block([0.5, 1.0]);
        single.diagrams[0].lines.truncate(1);
        single.diagrams[0].lines[0].marks.truncate(1);
        assert!(diagrams(&[single.clone()]).is_some());
        single.diagrams[0].y.logarithmic = false;
        single.diagrams[0].lines[0].marks[0].y = 0.0;
        assert!(!diagrams(&[single]).unwrap().contains("NaN"));
    }
}
