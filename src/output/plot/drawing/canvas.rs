//! The canvas of a figure: lines, areas and words, each over those before, as elements of SVG.

use std::fmt::{Arguments, Write};
use std::path::Path;

use super::frame::Frame;
use super::outline::{line_data, tenths};
use super::paint::{Letters, Paint, TextAnchor};
use crate::output::data::write_text;
use crate::output::error::OutputError;
use crate::output::markup::escape;

/// What has been drawn so far. Nothing is drawn at a place that is not finite.
pub struct Canvas {
    extent: [f64; 2],
    elements: String,
}

impl Canvas {
    /// A white canvas of a width and a height (pixels).
    pub fn new(extent: [f64; 2]) -> Self {
        Self { extent, elements: String::new() }
    }

    /// The whole of it.
    pub fn frame(&self) -> Frame {
        Frame::at([0.0; 2], self.extent)
    }

    fn add(&mut self, element: Arguments) {
        let _ = writeln!(self.elements, "{element}");
    }

    /// A path of SVG by its data, if there are any.
    pub fn path(&mut self, paint: Paint, data: &str) {
        if !data.is_empty() {
            self.add(format_args!("<path {paint} d=\"{data}\"/>"));
        }
    }

    /// Lines from point to point, as one path.
    pub fn lines<L: IntoIterator<Item = [f64; 2]>>(&mut self, paint: Paint, lines: impl IntoIterator<Item = L>) {
        let placed = |line: L| line.into_iter().map(tenths).collect::<Option<Vec<_>>>();
        let data: String = lines.into_iter().filter_map(placed).map(|points| line_data(&points, false)).collect();
        self.path(paint, &data);
    }

    /// A line from point to point.
    pub fn line(&mut self, paint: Paint, points: impl IntoIterator<Item = [f64; 2]>) {
        self.lines(paint, [points]);
    }

    /// An area within its corners.
    pub fn polygon(&mut self, paint: Paint, corners: impl IntoIterator<Item = [f64; 2]>) {
        let placed: Vec<String> = corners.into_iter().filter_map(tenths).map(|(x, y)| format!("{x},{y}")).collect();
        self.add(format_args!("<polygon {paint} points=\"{}\"/>", placed.join(" ")));
    }

    /// A circle by its centre and its radius.
    pub fn circle(&mut self, paint: Paint, centre: [f64; 2], radius: f64) {
        if let Some((x, y)) = tenths(centre) {
            self.add(format_args!("<circle {paint} cx=\"{x}\" cy=\"{y}\" r=\"{:.0}\"/>", 10.0 * radius));
        }
    }

    /// A box.
    pub fn rectangle(&mut self, paint: Paint, frame: Frame) {
        self.add(format_args!("<rect {paint} {}/>", sides(frame)));
    }

    /// Words at a place. Letters that XML does not know are left out.
    pub fn text(&mut self, letters: Letters, [x, y]: [f64; 2], words: &str) {
        let (Some((across, down)), Some((_, base))) = (tenths([x, y]), tenths([x, y + 0.35 * letters.size])) else { return };
        let anchor = match letters.anchor {
            TextAnchor::Start => "",
            TextAnchor::Middle => " text-anchor=\"middle\"",
            TextAnchor::End => " text-anchor=\"end\"",
        };
        let weight = if letters.is_bold { " font-weight=\"bold\"" } else { "" };
        let turned = if letters.is_upright { format!(" transform=\"rotate(-90 {across} {down})\"") } else { String::new() };
        let (size, words) = ((10.0 * letters.size).round(), escape(words));
        // The rim is a text of its own below: not every viewer knows how to paint strokes first.
        let rim = "fill=\"#fff\" stroke=\"#fff\" stroke-opacity=\"0.85\" stroke-width=\"30\"".to_owned();
        for paint in letters.has_rim.then_some(rim).into_iter().chain([format!("fill=\"{}\"", letters.colour)]) {
            self.add(format_args!(
                "<text x=\"{across}\" y=\"{base}\" font-size=\"{size}\"{anchor}{weight}{turned} {paint}>{words}</text>"
            ));
        }
    }

    /// What is drawn by `draw`, without those parts that lie outside a box, which has these further attributes.
    pub fn within(&mut self, frame: Frame, attributes: &str, draw: impl FnOnce(&mut Self)) {
        let Frame([left, top, right, bottom]) = frame;
        let shown = [left, top, right - left, bottom - top].map(|side| format!("{:.0}", 10.0 * side)).join(" ");
        // An element of its own cuts off, without a name that other figures of a page might have, too.
        self.add(format_args!("<svg {} viewBox=\"{shown}\"{attributes}>", sides(frame)));
        draw(self);
        self.add(format_args!("</svg>"));
    }

    /// What is drawn by `draw`, with a name by which scripts find it.
    pub fn named(&mut self, name: &str, draw: impl FnOnce(&mut Self)) {
        self.group(format_args!("<g data-name=\"{}\">", escape(name)), draw);
    }

    /// What is drawn by `draw`, with words that stand beside the pointer while it is there.
    pub fn told(&mut self, words: &str, draw: impl FnOnce(&mut Self)) {
        self.group(format_args!("<g pointer-events=\"all\"><title>{}</title>", escape(words)), draw);
    }

    fn group(&mut self, opening: Arguments, draw: impl FnOnce(&mut Self)) {
        self.add(opening);
        draw(self);
        self.add(format_args!("</g>"));
    }

    /// The text of an SVG file.
    pub fn svg(&self) -> String {
        let ([width, height], [across, down]) = (self.extent, self.extent.map(|side| 10.0 * side));
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width:.0}\" height=\"{height:.0}\" viewBox=\"0 0 {across:.0} {down:.0}\" \
             font-family=\"sans-serif\" stroke-linejoin=\"round\" stroke-linecap=\"round\">\n\
             <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n{}</svg>\n",
            self.elements
        )
    }

    /// Writes the figure.
    ///
    /// # Errors
    /// The operating system refuses.
    pub fn write(&self, path: &Path) -> Result<(), OutputError> {
        write_text(path, &self.svg())
    }
}

/// A box as attributes.
fn sides(Frame([left, top, right, bottom]): Frame) -> String {
    let [x, y, width, height] = [left, top, right - left, bottom - top].map(|side| 10.0 * side);
    format!("x=\"{x:.0}\" y=\"{y:.0}\" width=\"{width:.0}\" height=\"{height:.0}\"")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::plot::drawing::{BLUE, INK};

    #[test]
    fn figures_are_xml_whatever_their_words_are() {
        let mut canvas = Canvas::new([40.0, 30.0]);
        canvas.text(Letters { has_rim: true, ..Letters::bold(12.0, INK) }, [20.0, 10.0], "bars\u{1} <1 & 2>\u{1b}[0m\u{ffff}");
        let svg = canvas.svg();
        assert_eq!(svg.matches(">bars &lt;1 &amp; 2&gt;[0m</text>").count(), 2, "{svg}");
        assert!(svg.starts_with("<svg xmlns=") && svg.ends_with("</svg>\n") && svg.contains("viewBox=\"0 0 400 300\""));
    }

    #[test]
    fn what_is_not_finite_is_not_drawn() {
        let mut canvas = Canvas::new([40.0, 30.0]);
        canvas.line(Paint::line(BLUE, 1.0), [[0.0, 0.0], [f64::NAN, 1.0]]);
        canvas.circle(Paint::fill(BLUE), [f64::INFINITY, 1.0], 2.0);
        canvas.text(Letters::new(12.0, INK), [f64::NAN, 1.0], "nowhere");
        assert!(canvas.elements.is_empty());
        canvas.lines(Paint::line(BLUE, 1.0), [[[0.0, 0.0], [1.0, -1e300]], [[f64::NAN; 2]; 2]]);
        assert_eq!(canvas.elements, "<path fill=\"none\" stroke=\"#0072b2\" stroke-width=\"10\" d=\"M0 0l10 -10000000\"/>\n");
    }
}
