//! Diagrams whose lines bear their names at their ends.

use super::diagram::Diagram;
use crate::output::plot::drawing::{Canvas, Frame, Letters, Name, PlacedNames, Wish, style_colour, text_width};

/// Size of a diagram without the names, and what is above and to the right of the plot (pixels).
const SIZE: [f64; 2] = [740.0, 460.0];
const MARGINS: [f64; 2] = [40.0, 24.0];
/// Size of the names, and room that a mark takes (pixels).
const LETTERS: f64 = 11.5;
const MARK: f64 = 8.0;
/// Room beside the longest name (pixels).
const BESIDE: f64 = 18.0;

/// The text of an SVG file with all diagrams one below the other; None if there is no mark in them.
pub fn named_diagrams(diagrams: &[Diagram]) -> Option<String> {
    let shown: Vec<Diagram> = diagrams.iter().filter_map(Diagram::visible).collect();
    let widths = shown.iter().flat_map(|diagram| &diagram.lines).map(|line| text_width(&line.name, LETTERS));
    let room = widths.fold(0.0, f64::max).ceil() + BESIDE;
    let panel = [SIZE[0] + room, SIZE[1]];
    let mut canvas = Canvas::new([panel[0], SIZE[1] * shown.len() as f64]);
    for (at, diagram) in shown.iter().enumerate() {
        let chart = diagram.chart(Frame::at([0.0, SIZE[1] * at as f64], panel), [MARGINS[0], MARGINS[1] + room]);
        chart.draw_head(&mut canvas, &diagram.title, &[]);
        diagram.draw(&mut canvas, &chart);
        let ends = diagram.lines.iter().map(|line| line.marks.iter().map(|mark| chart.place([mark.x, mark.y])).collect());
        let places: Vec<Vec<[f64; 2]>> = ends.collect();
        let [left, top, _, bottom] = chart.frame.0;
        let mut names = PlacedNames::new(Frame([left, top, panel[0], bottom]), Vec::new());
        places.iter().flatten().for_each(|place| names.take(*place, MARK));
        let ends = diagram.lines.iter().zip(&places).filter_map(|(line, places)| Some((line, *places.last()?)));
        let mut ends: Vec<_> = ends.collect();
        // Names at the right have the least choice.
        ends.sort_by(|a, b| b.1[0].total_cmp(&a.1[0]));
        for (line, anchor) in ends {
            let letters = Letters::new(LETTERS, style_colour(line.style));
            names.put(&mut canvas, &Name { text: &line.name, letters, anchor, wish: Wish::Beside });
        }
    }
    (!shown.is_empty()).then(|| canvas.svg())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::plot::diagrams::{DiagramLine, Mark};
    use crate::output::plot::drawing::Axis;

    fn diagram(ends: &[f64]) -> Diagram {
        let one = |(style, end): (usize, &f64)| {
            let marks = vec![Mark::at(0.1, 1.0, false), Mark::at(*end, 8.0, false)];
            DiagramLine { name: format!("line <{style}>"), style, marks, ..DiagramLine::default() }
        };
        let lines = ends.iter().enumerate().map(one).collect();
        let x = Axis { falling: true, ..Axis::logarithmic("error") };
        Diagram { title: "bars".into(), x, y: Axis::logarithmic("time"), behind: Vec::new(), lines }
    }

    #[test]
    fn every_line_bears_its_name() {
        let text = named_diagrams(&[diagram(&[1e-3; 9]), diagram(&[1e-5])]).unwrap();
        let count = |tag: &str| text.lines().filter(|line| line.contains(tag) && line.contains("line &lt;")).count();
        // A rim lies below each, and each mark tells it under the pointer.
        assert_eq!([count("<text"), count("<title>")], [2 * 10; 2]);
    }

    #[test]
    fn nothing_to_show_is_no_figure() {
        let mut empty = diagram(&[1e-3]);
        empty.lines[0].marks.iter_mut().for_each(|mark| mark.x = 0.0);
        assert_eq!(named_diagrams(&[empty]), None);
        assert_eq!(named_diagrams(&[]), None);
    }
}
