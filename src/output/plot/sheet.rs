//! The sheet a figure is drawn on: plotters' SVG backend with tenths of a pixel, and text of estimated width.

use std::fs;
use std::path::Path;

use plotters::chart::{ChartBuilder, ChartContext};
use plotters::coord::Shift;
use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};
use plotters::prelude::{Cartesian2d, DrawingArea, IntoDrawingArea, PathElement, Rectangle, SVGBackend, Text, TextStyle};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, FontDesc, FontFamily, FontStyle, RGBColor, ShapeStyle};

use super::palette::{GREY, GRID, INK};
use super::ticks::Ticks;
use crate::output::error::OutputError;

/// Plotters' backend takes whole coordinates and line widths; a pixel of the figure has ten of them.
pub(super) const PIXEL: i32 = 10;

/// Size of the labels of ticks (pixels).
const LABEL: f64 = 11.0;
/// Left of a plot, beside the labels of its ticks: the edge of the sheet, the name of the axis, the ticks and what lies between
/// them (pixels).
const BESIDE: f64 = 40.0;

/// The whole figure.
pub(super) type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
/// A chart with its frame and axes drawn.
pub(super) type Chart<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<AxisSpec, AxisSpec>>;
/// Whatever plotters has to say; drawing into a string does not fail.
pub(super) type DrawResult<T> = Result<T, Box<dyn std::error::Error>>;

/// The size of a figure.
pub(super) struct Sheet {
    /// Width of the figure (pixels).
    pub width: i32,
    /// Height of the figure (pixels).
    pub height: i32,
    /// Distances of the plot from the left, right, top and bottom of the figure (pixels).
    pub margins: [i32; 4],
}

/// How far apart values lie on an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scale {
    /// As their difference.
    Linear,
    /// As their ratio; all are positive.
    Logarithmic,
}

/// One axis: its range, its ticks, its name.
#[derive(Clone)]
pub(super) struct AxisSpec {
    /// How values are spread.
    pub scale: Scale,
    /// First and last value.
    pub range: [f64; 2],
    /// Ticks within the range.
    pub ticks: Ticks,
    /// What is shown, with its unit.
    pub name: String,
}

impl Ranged for AxisSpec {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, (first, last): (i32, i32)) -> i32 {
        let [low, high] = self.range;
        let fraction = match self.scale {
            Scale::Linear => (value - low) / (high - low),
            Scale::Logarithmic => (value / low).ln() / (high / low).ln(),
        };
        first + (f64::from(last - first) * fraction).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, _: Hint) -> Vec<f64> {
        self.ticks.values.clone()
    }

    fn range(&self) -> std::ops::Range<f64> {
        self.range[0]..self.range[1]
    }
}

impl ValueFormatter<f64> for AxisSpec {
    fn format(value: &f64) -> String {
        value.to_string()
    }

    fn format_ext(&self, value: &f64) -> String {
        self.ticks.label(*value)
    }
}

impl AxisSpec {
    /// A linear axis with about so many ticks, named by a quantity and its unit.
    pub fn linear(range: [f64; 2], ticks: usize, name: &str, unit: &str) -> Self {
        let ticks = Ticks::new(range, ticks);
        Self { scale: Scale::Linear, name: format!("{name} [{}]", ticks.unit(unit)), range, ticks }
    }

    /// Room that a vertical axis takes at the left of a plot (pixels): its name, its widest label, its ticks.
    pub fn room(&self) -> i32 {
        let widths = self.ticks.values.iter().map(|&value| text_width(&self.ticks.label(value), LABEL));
        (BESIDE + widths.fold(0.0, f64::max)).ceil() as i32
    }
}

impl Sheet {
    /// The sheet with as much room at the left of the plot as a vertical axis takes, if that is more than it has.
    pub fn with_room_for(&self, y: &AxisSpec) -> Sheet {
        let [left, right, top, bottom] = self.margins;
        Sheet { margins: [left.max(y.room()), right, top, bottom], ..*self }
    }

    /// Upper left and lower right corner of the plot (tenths of a pixel).
    pub fn corners(&self) -> [(i32, i32); 2] {
        let [left, right, top, bottom] = self.margins;
        [(left, top), (self.width - right, self.height - bottom)].map(|(x, y)| (x * PIXEL, y * PIXEL))
    }

    /// Draws the frame of the plot, over the ends of lines.
    pub fn draw_frame(&self, area: &Area) -> DrawResult<()> {
        area.draw(&Rectangle::new(self.corners(), line(&GREY, 0.8)))?;
        Ok(())
    }

    /// Draws a figure and writes it. `draw` returns SVG elements that go below everything that it has drawn.
    pub fn write(
        &self,
        path: &Path,
        draw: impl for<'a> FnOnce(&Sheet, &Area<'a>) -> DrawResult<String>,
    ) -> Result<(), OutputError> {
        let drawn = self.text(draw);
        let text = drawn.map_err(|error| OutputError::Figure { path: path.into(), reason: error.to_string() })?;
        fs::write(path, text).map_err(OutputError::io("write", path))
    }

    /// Draws a figure and gives the text of its file, which may stand in a page too. `draw` as in [`Self::write`].
    pub fn text(&self, draw: impl for<'a> FnOnce(&Sheet, &Area<'a>) -> DrawResult<String>) -> DrawResult<String> {
        let (width, height) = (self.width * PIXEL, self.height * PIXEL);
        let mut drawn = String::new();
        let below = {
            let area = SVGBackend::with_string(&mut drawn, (width as u32, height as u32)).into_drawing_area();
            let below = draw(self, &area)?;
            area.present()?;
            below
        };
        let content = drawn.split_once('\n').map_or("", |(_, content)| content);
        Ok(format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}\" height=\"{}\" viewBox=\"0 0 {width} {height}\" \
             stroke-linejoin=\"round\" stroke-linecap=\"round\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n{below}{}",
            self.width,
            self.height,
            content.replace(" opacity=\"1\"", "").replace(not_in_xml, ""),
        ))
    }

    /// Draws the title above the left edge of the plot; a long one in smaller letters.
    pub fn draw_title(&self, area: &Area, title: &str) -> DrawResult<()> {
        let room = f64::from(self.width - self.margins[0] - 10);
        let size = (15.0 * room / (text_width(title, 15.0) * 1.1)).clamp(9.0, 15.0);
        let style = text_style(size, FontStyle::Bold, INK);
        area.draw(&Text::new(title.to_string(), (self.margins[0] * PIXEL, 14 * PIXEL), style))?;
        Ok(())
    }

    /// Draws one row of names below the title, each after its lines, which lie on each other.
    pub fn draw_legend(&self, area: &Area, entries: &[(&str, &[ShapeStyle])]) -> DrawResult<()> {
        let (mut x, y) = (f64::from(self.margins[0]), 44 * PIXEL);
        let across = |x: f64| (x * f64::from(PIXEL)) as i32;
        let label = text_style(12.0, FontStyle::Normal, INK).pos(Pos::new(HPos::Left, VPos::Center));
        for (name, styles) in entries {
            for &style in *styles {
                area.draw(&PathElement::new(vec![(across(x), y), (across(x + 24.0), y)], style))?;
            }
            area.draw(&Text::new(name.to_string(), (across(x + 31.0), y), label.clone()))?;
            x += 31.0 + text_width(name, 12.0) + 22.0;
        }
        Ok(())
    }

    /// Draws a remark at the right end of the row of the legend.
    pub fn draw_remark(&self, area: &Area, remark: &str) -> DrawResult<()> {
        let style = text_style(11.0, FontStyle::Italic, GREY).pos(Pos::new(HPos::Right, VPos::Center));
        area.draw(&Text::new(remark.to_string(), ((self.width - 12) * PIXEL, 44 * PIXEL), style))?;
        Ok(())
    }

    /// Draws frame, ticks and names of the axes, with a grid or without.
    pub fn draw_axes<'a, 'b>(&self, area: &'a Area<'b>, x: &AxisSpec, y: &AxisSpec, grid: bool) -> DrawResult<Chart<'a, 'b>> {
        let [left, right, top, bottom] = self.margins.map(|margin| margin * PIXEL);
        let mut chart = ChartBuilder::on(area)
            .margin_top(top)
            .margin_right(right)
            .margin_left(10 * PIXEL)
            .margin_bottom(10 * PIXEL)
            .x_label_area_size(bottom - 10 * PIXEL)
            .y_label_area_size(left - 10 * PIXEL)
            .build_cartesian_2d(x.clone(), y.clone())?;
        let mut mesh = chart.configure_mesh();
        mesh.bold_line_style(line(if grid { &GRID } else { &RGBColor(255, 255, 255) }, 0.8))
            .light_line_style(RGBColor(255, 255, 255).mix(0.0))
            .axis_style(line(&GREY, 0.8))
            .set_all_tick_mark_size(4 * PIXEL)
            .label_style(text_style(LABEL, FontStyle::Normal, INK))
            .axis_desc_style(text_style(12.0, FontStyle::Normal, INK))
            .x_desc(x.name.as_str())
            .y_desc(y.name.as_str());
        if !grid {
            mesh.disable_mesh();
        }
        mesh.draw()?;
        Ok(chart)
    }
}

/// Whether a letter may not stand in XML 1.0 (section 2.2), in whatever form.
fn not_in_xml(letter: char) -> bool {
    letter.is_control() && !matches!(letter, '\t' | '\n' | '\r') || matches!(letter, '\u{fffe}' | '\u{ffff}')
}

/// A line of a width in pixels.
pub(super) fn line(colour: &impl Color, width: f64) -> ShapeStyle {
    colour.stroke_width((width * f64::from(PIXEL)).round() as u32)
}

/// Letters of a size in pixels; the backend divides sizes by 1.24.
pub(super) fn text_style(size: f64, style: FontStyle, colour: RGBColor) -> TextStyle<'static> {
    let size = size * 1.24 * f64::from(PIXEL);
    let font = FontDesc::new(FontFamily::SansSerif, size, style);
    TextStyle { font, color: colour.to_backend_color(), pos: Pos::default() }
}

/// Estimated width of a text (pixels). The viewer chooses the font, so this is on the wide side of the usual sans-serif ones.
pub(super) fn text_width(text: &str, size: f64) -> f64 {
    let letter = |letter: char| match letter {
        'i' | 'j' | 'l' | '.' | ',' | ':' | '\'' | '|' | 'I' => 0.32,
        ' ' | 'f' | 't' | 'r' | '(' | ')' | '[' | ']' | '-' | '₁' | '₂' => 0.40,
        'm' | 'w' | 'M' | 'W' | '×' | '−' => 0.85,
        letter if letter.is_uppercase() => 0.70,
        _ => 0.60,
    };
    size * text.chars().map(letter).sum::<f64>()
}
