//! What lines and marks of a figure mean, in rows below its title.

use std::f64::consts::FRAC_PI_2;

use super::canvas::Canvas;
use super::paint::{Colour, INK, LINES, Letters, Paint, WHITE, text_width};

/// Height of a row (pixels).
pub const ROW: f64 = 19.0;
/// In a row: the length of a sample, the way from there to its words, the height of letters, and the room between two cells
/// (pixels).
const SAMPLE: f64 = 26.0;
const BESIDE: f64 = 7.0;
const LETTERS: f64 = 12.0;
const BETWEEN: f64 = 22.0;
/// Corners of the marks, on a circle: their number, and the angle of the first one in right angles. None: the circle itself.
const MARKS: [Option<(usize, f64)>; 5] = [None, Some((4, 0.5)), Some((3, -1.0)), Some((4, 0.0)), Some((3, 1.0))];
/// Radius of the marks (pixels).
const RADIUS: f64 = 4.0;

/// Words of a legend, with a sample of what they name or without; cells of several rows stand in columns.
#[derive(Clone, Debug, Default)]
pub struct LegendCell {
    /// Lines that lie on each other.
    lines: Vec<Paint>,
    /// The style of a mark upon them.
    mark: Option<usize>,
    words: String,
}

impl LegendCell {
    /// Words alone.
    pub fn words(words: impl Into<String>) -> Self {
        Self { words: words.into(), ..Self::default() }
    }

    /// The name of what is drawn by lines that lie on each other.
    pub fn lines(words: impl Into<String>, lines: &[Paint]) -> Self {
        Self { lines: lines.to_vec(), ..Self::words(words) }
    }

    /// The name of a line of a diagram, by its style.
    pub fn marked(words: impl Into<String>, style: usize) -> Self {
        Self { mark: Some(style), ..Self::lines(words, &[Paint::line(style_colour(style), 1.6)]) }
    }

    /// Room that the sample takes beside the words (pixels).
    fn before(&self) -> f64 {
        if self.lines.is_empty() { 0.0 } else { SAMPLE + BESIDE }
    }

    fn width(&self) -> f64 {
        self.before() + text_width(&self.words, LETTERS) + BETWEEN
    }

    fn draw(&self, canvas: &mut Canvas, [x, y]: [f64; 2], smaller: f64) {
        self.lines.iter().for_each(|paint| canvas.line(*paint, [[x, y], [x + smaller * SAMPLE, y]]));
        if let Some(style) = self.mark {
            draw_mark(canvas, [x + 0.5 * smaller * SAMPLE, y], style, false);
        }
        canvas.text(Letters::new(smaller * LETTERS, INK), [x + smaller * self.before(), y], &self.words);
    }
}

/// Draws rows of cells in columns, from a place on; all of it smaller where `width` is too little.
pub fn draw_legend(canvas: &mut Canvas, [left, top]: [f64; 2], width: f64, legend: &[Vec<LegendCell>]) {
    let columns = legend.iter().map(Vec::len).max().unwrap_or(0);
    let widest = |column: usize| legend.iter().filter_map(|row| row.get(column)).map(LegendCell::width).fold(0.0, f64::max);
    let widths: Vec<f64> = (0..columns).map(widest).collect();
    let smaller = (width / (widths.iter().sum::<f64>() - BETWEEN)).clamp(0.0, 1.0);
    for (row, cells) in legend.iter().enumerate() {
        let (mut x, y) = (left, top + ROW * (row as f64 + 0.5));
        for (cell, width) in cells.iter().zip(&widths) {
            cell.draw(canvas, [x, y], smaller);
            x += smaller * width;
        }
    }
}

/// Draws the mark of a style around a place; a hollow one is not to be trusted.
pub fn draw_mark(canvas: &mut Canvas, [x, y]: [f64; 2], style: usize, is_hollow: bool) {
    let colour = style_colour(style);
    let paint = Paint::fill(if is_hollow { WHITE } else { colour }).edged(colour, 1.2);
    let Some((corners, first)) = MARKS[style % MARKS.len()] else { return canvas.circle(paint, [x, y], RADIUS) };
    let corner = |k: usize| {
        let angle = FRAC_PI_2 * (first + 4.0 * k as f64 / corners as f64);
        [x + RADIUS * angle.cos(), y + RADIUS * angle.sin()]
    };
    canvas.polygon(paint, (0..corners).map(corner));
}

/// The colour of a style.
pub fn style_colour(style: usize) -> Colour {
    LINES[style % LINES.len()]
}
