//! A plot between two axes, with what stands above it.

use super::canvas::Canvas;
use super::frame::Frame;
use super::legend::{LegendCell, ROW, draw_legend};
use super::paint::{GREY, GRID, INK, Letters, Paint, TextAnchor, text_width};
use super::scale::{LABEL, Scale};
use crate::output::units::Unit;

/// Height of the title (pixels); rows of the legend come below it.
const TITLE: f64 = 34.0;
/// Room below a plot for its horizontal axis (pixels).
const BELOW: f64 = 54.0;
/// What is shown behind the axis of revolution, as a share of the largest radius.
const BEHIND_AXIS: f64 = 0.03;
/// Length of the ticks (pixels).
const TICK: f64 = 4.0;
/// Above the plot of a figure: its title, one row of its legend, and some room (pixels).
pub const HEAD: f64 = 62.0;

/// Above a plot: its title, so many rows of its legend, and some room (pixels).
pub fn head_height(rows: usize) -> f64 {
    HEAD + ROW * (rows as f64 - 1.0)
}

/// Draws a title from a place on, and the legend below it. What is too long for a line up to `right` has smaller letters.
pub fn head(canvas: &mut Canvas, [left, top]: [f64; 2], right: f64, title: &str, legend: &[Vec<LegendCell>]) {
    let size = (15.0 * (right - left) / (text_width(title, 15.0) * 1.1)).clamp(9.0, 15.0);
    canvas.text(Letters::bold(size, INK), [left, top + 20.0], title);
    draw_legend(canvas, [left, top + TITLE], right - left, legend);
}

/// A plot and its axes.
pub struct Chart {
    /// The plot itself.
    pub frame: Frame,
    /// The part of the figure that plot, axes, title and legend have.
    pub panel: Frame,
    x: Scale,
    y: Scale,
    /// Whether the line x = 0 is the axis of bodies of revolution.
    pub has_axis: bool,
}

impl Chart {
    /// A plot in a part of a figure, with so much room above and to the right of it (pixels).
    pub fn new(panel: Frame, [above, beside]: [f64; 2], x: Scale, y: Scale) -> Self {
        let [left, top, right, bottom] = panel.0;
        let frame = Frame([left + y.room(), top + above, right - beside, bottom - BELOW]);
        Self { frame, panel, x, y, has_axis: false }
    }

    /// A box of the plane without distortion, given by its lower left and upper right corner; of bodies of revolution with their
    /// axis. `unit` is that of lengths.
    pub fn of_plane([low, high]: [[f64; 2]; 2], room: &PlotRoom, margins: [f64; 2], (has_axis, unit): (bool, Unit)) -> Self {
        let needed = [0, 1].map(|axis| high[axis] - low[axis]);
        let inner = room.most.map(|most| most - 2.0 * room.around);
        let pixels_per_length = (inner[0] / needed[0]).min(inner[1] / needed[1]);
        let pixels = [0, 1].map(|axis| (needed[axis] * pixels_per_length + 2.0 * room.around).max(room.least[axis]).round());
        let across = if has_axis { "radius x" } else { "x" };
        let [x, y] = [(0, across), (1, "y")].map(|(axis, name)| {
            let (middle, half) = (0.5 * (low[axis] + high[axis]), 0.5 * pixels[axis] / pixels_per_length);
            Scale::linear([middle - half, middle + half], (pixels[axis] / 80.0).ceil() as usize, name, unit)
        });
        let extent = [pixels[0] + y.room() + margins[1], pixels[1] + margins[0] + BELOW];
        Self { has_axis, ..Self::new(Frame::at([0.0; 2], extent), margins, x, y) }
    }

    /// Where values of both axes are on the canvas.
    pub fn place(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [left, top, right, bottom] = self.frame.0;
        [left + (right - left) * self.x.share(x), bottom - (bottom - top) * self.y.share(y)]
    }

    /// A horizontal line through the plot at a value.
    pub fn level(&self, y: f64) -> [[f64; 2]; 2] {
        self.x.range.map(|x| self.place([x, y]))
    }

    /// What is drawn by `draw`, without those parts that lie outside the plot, which tells scripts what its linear axes are.
    pub fn within(&self, canvas: &mut Canvas, draw: impl FnOnce(&mut Canvas)) {
        canvas.within(self.frame, &format!(" data-x=\"{}\" data-y=\"{}\"", self.x.told(), self.y.told()), draw);
    }

    /// Draws title and legend above the plot.
    pub fn draw_head(&self, canvas: &mut Canvas, title: &str, legend: &[Vec<LegendCell>]) {
        head(canvas, [self.frame.0[0], self.panel.0[1]], self.panel.0[2] - 10.0, title, legend);
    }

    /// Draws ticks, labels and names of the axes, with a grid or without.
    pub fn draw_axes(&self, canvas: &mut Canvas, has_grid: bool) {
        let [left, top, right, bottom] = self.frame.0;
        let (line, grid) = (Paint::line(GREY, 0.8), Paint::line(GRID, 0.8));
        let label = |anchor| Letters::new(LABEL, INK).at(anchor);
        let across = self.x.ticks().into_iter().map(|(share, words)| (left + share * (right - left), words));
        let up = self.y.ticks().into_iter().map(|(share, words)| (bottom - share * (bottom - top), words));
        let (across, up): (Vec<_>, Vec<_>) = (across.collect(), up.collect());
        if has_grid {
            canvas.lines(grid, across.iter().map(|(x, _)| [[*x, top], [*x, bottom]]));
            canvas.lines(grid, up.iter().map(|(y, _)| [[left, *y], [right, *y]]));
        }
        canvas.lines(line, across.iter().map(|(x, _)| [[*x, bottom], [*x, bottom + TICK]]));
        canvas.lines(line, up.iter().map(|(y, _)| [[left - TICK, *y], [left, *y]]));
        canvas.line(line, [[left, top], [left, bottom], [right, bottom]]);
        across.iter().for_each(|(x, words)| canvas.text(label(TextAnchor::Middle), [*x, bottom + TICK + 9.0], words));
        up.iter().for_each(|(y, words)| canvas.text(label(TextAnchor::End), [left - TICK - 4.0, *y], words));
        let [from, to] = self.x.range;
        if self.has_axis && from <= 0.0 && 0.0 <= to {
            let [x, _] = self.place([0.0, 0.0]);
            canvas.line(Paint::line(GREY, 0.9).dash_dotted(), [[x, top], [x, bottom]]);
        }
        let [middle, height] = self.frame.middle();
        let name = Letters::new(12.0, INK).at(TextAnchor::Middle);
        canvas.text(name, [middle, bottom + BELOW - 16.0], &self.x.name);
        canvas.text(Letters { is_upright: true, ..name }, [self.panel.0[0] + 16.0, height], &self.y.name);
    }
}

/// Room for a plot of the plane (pixels).
pub struct PlotRoom {
    /// Its largest width and height.
    pub most: [f64; 2],
    /// Its smallest ones.
    pub least: [f64; 2],
    /// What lies around the part that is shown.
    pub around: f64,
}

/// A box of the plane with the axis of revolution in it, if that is no farther away than the box is wide.
pub fn up_to_the_axis([low, high]: [[f64; 2]; 2]) -> [[f64; 2]; 2] {
    let width = high[0] - low[0];
    let left = if low[0] <= width { low[0].min(-BEHIND_AXIS * high[0]) } else { low[0] };
    [[left, low[1]], high]
}

/// Lower left and upper right corner of the box around all points; the corners lie at infinity if there are none.
pub fn bounds(points: impl Iterator<Item = [f64; 2]>) -> [[f64; 2]; 2] {
    points.fold([[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]], |[low, high], x| {
        [[0, 1].map(|axis| low[axis].min(x[axis])), [0, 1].map(|axis| high[axis].max(x[axis]))]
    })
}
