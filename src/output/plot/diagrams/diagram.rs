//! Points joined to lines between two axes.

use crate::output::plot::drawing::{Axis, Canvas, Chart, Frame, GREY, Paint, draw_mark, number_text, style_colour};

/// Lines between two axes.
#[derive(Clone, Debug, Default)]
pub struct Diagram {
    /// Stands above it.
    pub title: String,
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// Drawn grey and broad, behind the lines.
    pub behind: Vec<[f64; 2]>,
    /// The lines.
    pub lines: Vec<DiagramLine>,
}

/// A line of a diagram.
#[derive(Clone, Debug, Default)]
pub struct DiagramLine {
    /// What it is called, where lines bear names.
    pub name: String,
    /// Its colour and its marks.
    pub style: usize,
    /// How it is drawn.
    pub kind: LineKind,
    /// Its points in order.
    pub marks: Vec<Mark>,
}

/// How a line of a diagram is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum LineKind {
    /// From mark to mark.
    #[default]
    Marked,
    /// In dashes, without marks.
    Dashed,
    /// Thin, from axis to axis, at the height of its points.
    Level,
}

/// A point of a line.
#[derive(Clone, Copy, Debug, Default)]
pub struct Mark {
    /// Abscissa.
    pub x: f64,
    /// Ordinate.
    pub y: f64,
    /// A bar shows how far the ordinate reaches down and up.
    pub reach: [f64; 2],
    /// Hollow: not to be trusted.
    pub hollow: bool,
}

impl Mark {
    /// A point without a bar.
    pub fn at(x: f64, y: f64, hollow: bool) -> Self {
        Self { x, y, reach: [y, y], hollow }
    }
}

impl LineKind {
    /// How lines of a style are drawn.
    pub fn paint(self, style: usize) -> Paint {
        let line = |width| Paint::line(style_colour(style), width);
        match self {
            Self::Marked => line(1.4),
            Self::Dashed => line(1.2).dashed(),
            Self::Level => line(0.7),
        }
    }
}

impl DiagramLine {
    fn draw(&self, canvas: &mut Canvas, chart: &Chart) {
        let paint = self.kind.paint(self.style);
        if self.kind == LineKind::Level {
            return canvas.lines(paint, self.marks.iter().map(|mark| chart.level(mark.y)));
        }
        let places = || self.marks.iter().map(|mark| chart.place([mark.x, mark.y]));
        if self.kind == LineKind::Dashed {
            return canvas.line(paint, places());
        }
        let bars = self.marks.iter().filter(|mark| mark.reach[0] < mark.reach[1]);
        canvas.lines(Paint::line(style_colour(self.style), 1.0), bars.map(|mark| mark.reach.map(|y| chart.place([mark.x, y]))));
        canvas.line(paint, places());
        for (mark, place) in self.marks.iter().zip(places()) {
            canvas.told(&self.words(mark), |canvas| draw_mark(canvas, place, self.style, mark.hollow));
        }
    }

    /// The values of a point.
    fn words(&self, mark: &Mark) -> String {
        let name = if self.name.is_empty() { String::new() } else { format!("{}: ", self.name) };
        format!("{name}{} at {}", number_text(mark.y), number_text(mark.x))
    }
}

impl Diagram {
    /// With those marks and lines alone that the axes can show, and as much of their reach; None if there are none.
    pub fn visible(&self) -> Option<Self> {
        let cut = |mark: &Mark| Mark { reach: mark.reach.map(|y| if self.y.shows(y) { y } else { mark.y }), ..*mark };
        let marks = |line: &DiagramLine| -> Vec<Mark> {
            line.marks.iter().filter(|mark| self.x.shows(mark.x) && self.y.shows(mark.y)).map(cut).collect()
        };
        let lines = self.lines.iter().map(|line| DiagramLine { marks: marks(line), ..line.clone() });
        let lines: Vec<DiagramLine> = lines.filter(|line| !line.marks.is_empty()).collect();
        (!lines.is_empty()).then(|| Self { lines, ..self.clone() })
    }

    /// Its axes in a part of a figure, with so much room above and to the right.
    pub fn chart(&self, panel: Frame, margins: [f64; 2]) -> Chart {
        let marks = || self.lines.iter().flat_map(|line| &line.marks);
        let x = self.x.around(marks().map(|mark| mark.x));
        let y = self.y.around(marks().flat_map(|mark| [mark.y, mark.reach[0], mark.reach[1]]));
        Chart::new(panel, margins, x, y)
    }

    /// Draws axes and lines.
    pub fn draw(&self, canvas: &mut Canvas, chart: &Chart) {
        chart.draw_axes(canvas, true);
        canvas.line(Paint::line(GREY, 7.0).faint(0.3), self.behind.iter().map(|point| chart.place(*point)));
        self.lines.iter().for_each(|line| line.draw(canvas, chart));
    }
}
