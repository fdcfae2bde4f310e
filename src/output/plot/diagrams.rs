//! Diagrams of many runs: points joined to lines, in blocks with a legend each.

use plotters::element::{Circle, PathElement, Polygon, Text};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, FontStyle, RGBColor, ShapeStyle};

use super::palette::{GREY, INK, LINES};
use super::sheet::{Area, AxisSpec, Chart, DrawResult, PIXEL, Scale, Sheet, line, text_style, text_width};
use super::ticks::Ticks;

/// Diagrams that share a legend.
#[derive(Clone, Debug, Default)]
pub struct DiagramBlock {
    /// Stands above all.
    pub title: String,
    /// One row for each line.
    pub legend: Vec<LegendRow>,
    /// Two stand side by side; one without a mark is left out.
    pub diagrams: Vec<Diagram>,
}

/// A row of the legend.
#[derive(Clone, Debug, Default)]
pub struct LegendRow {
    /// Style of the line: its colour and its marks.
    pub style: usize,
    /// Its name, and what else is to be said of it, in columns.
    pub cells: Vec<String>,
}

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
    pub behind: Vec<(f64, f64)>,
    /// Styles and marks.
    pub lines: Vec<(usize, Vec<Mark>)>,
}

/// An axis fits what is drawn; a linear one begins at zero.
#[derive(Clone, Debug, Default)]
pub struct Axis {
    /// What it shows, with its unit.
    pub name: String,
    /// Whether it is logarithmic; what is not positive is not drawn then.
    pub logarithmic: bool,
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

/// Size of a diagram with its axes (pixels).
const PANEL: Sheet = Sheet { width: 450, height: 320, margins: [66, 18, 38, 50] };
const COLUMNS: usize = 2;
/// Above the diagrams of a block: its title, and each row of its legend (pixels).
pub(super) const TITLE: i32 = 34;
pub(super) const ROW: i32 = 19;
/// In a row of the legend: its sample, the height of letters, and the room between two cells (pixels).
const SAMPLE: f64 = 56.0;
const LETTERS: f64 = 12.0;
const BETWEEN: f64 = 24.0;
/// Below the diagrams of a block (pixels).
const GAP: i32 = 14;
/// Corners of the marks, on a circle: their number, and the angle of the first one in right angles. None: the circle itself.
const MARKS: [Option<(usize, f64)>; 5] = [None, Some((4, 0.5)), Some((3, -1.0)), Some((4, 0.0)), Some((3, 1.0))];
/// Radius of the marks (pixels).
const RADIUS: f64 = 4.0;
const WHITE: RGBColor = RGBColor(255, 255, 255);

/// The text of an SVG file with all blocks one below the other; None if there is no mark in them.
///
/// # Errors
/// What plotters has to say, in words.
pub fn diagrams(blocks: &[DiagramBlock]) -> Result<Option<String>, String> {
    let shown: Vec<(&DiagramBlock, Vec<&Diagram>)> = blocks
        .iter()
        .map(|block| (block, block.diagrams.iter().filter(|diagram| diagram.marks().next().is_some()).collect()))
        .filter(|(_, diagrams): &(&DiagramBlock, Vec<&Diagram>)| !diagrams.is_empty())
        .collect();
    if shown.is_empty() {
        return Ok(None);
    }
    let height = |(block, diagrams): &(&DiagramBlock, Vec<&Diagram>)| {
        TITLE + ROW * block.legend.len() as i32 + PANEL.height * diagrams.len().div_ceil(COLUMNS) as i32 + GAP
    };
    let sheet = Sheet { width: PANEL.width * COLUMNS as i32, height: shown.iter().map(height).sum(), margins: [16, 0, 0, 0] };
    let drawn = sheet.text(|sheet, area| {
        let mut top = 0;
        for block in &shown {
            let (width, high) = (sheet.width * PIXEL, height(block) * PIXEL);
            draw_block(sheet, area, &area.clone().shrink((0, top), (width, high)), block.0, &block.1)?;
            top += high;
        }
        Ok(String::new())
    });
    drawn.map(Some).map_err(|error| error.to_string())
}

/// Draws title, legend and diagrams into the part of the sheet that is theirs.
fn draw_block(sheet: &Sheet, whole: &Area, part: &Area, block: &DiagramBlock, diagrams: &[&Diagram]) -> DrawResult<()> {
    sheet.draw_title(part, &block.title)?;
    draw_legend(part, f64::from(sheet.width), &block.legend)?;
    let top = TITLE + ROW * block.legend.len() as i32;
    for (index, diagram) in diagrams.iter().enumerate() {
        let (column, row) = ((index % COLUMNS) as i32, (index / COLUMNS) as i32);
        let corner = (column * PANEL.width * PIXEL, (top + row * PANEL.height) * PIXEL);
        let panel = part.clone().shrink(corner, (PANEL.width * PIXEL, PANEL.height * PIXEL));
        draw_diagram(whole, &panel, diagram)?;
    }
    Ok(())
}

/// Draws one row for each line: its sample, its name, and what else is said of it; in smaller letters where `width` (pixels) is
/// too little.
pub(super) fn draw_legend(part: &Area, width: f64, legend: &[LegendRow]) -> DrawResult<()> {
    let columns = legend.iter().map(|entry| entry.cells.len()).max().unwrap_or(0);
    let cell = |entry: &LegendRow, column: usize| entry.cells.get(column).map_or(0.0, |cell| text_width(cell, LETTERS) + BETWEEN);
    let widest = |column| legend.iter().map(|entry| cell(entry, column)).fold(0.0, f64::max);
    let widths: Vec<f64> = (0..columns).map(widest).collect();
    let smaller = ((width - SAMPLE) / widths.iter().sum::<f64>()).min(1.0);
    let style = text_style(LETTERS * smaller, FontStyle::Normal, INK).pos(Pos::new(HPos::Left, VPos::Center));
    for (row, entry) in legend.iter().enumerate() {
        let y = (TITLE + ROW * row as i32 + ROW / 2) * PIXEL;
        let across = |x: f64| (x * f64::from(PIXEL)) as i32;
        part.draw(&PathElement::new(vec![(across(18.0), y), (across(46.0), y)], line(&colour(entry.style), 1.6)))?;
        draw_mark(part, (across(32.0), y), entry.style, false)?;
        let mut x = SAMPLE;
        for (cell, width) in entry.cells.iter().zip(&widths) {
            part.draw(&Text::new(cell.clone(), (across(x), y), style.clone()))?;
            x += width * smaller;
        }
    }
    Ok(())
}

/// Draws one diagram; `whole` is the sheet, on which marks are placed.
fn draw_diagram(whole: &Area, panel: &Area, diagram: &Diagram) -> DrawResult<()> {
    let title = text_style(12.5, FontStyle::Bold, INK);
    panel.draw(&Text::new(diagram.title.clone(), (PANEL.margins[0] * PIXEL, 14 * PIXEL), title))?;
    let marks: Vec<&Mark> = diagram.marks().collect();
    let across = diagram.x.spec(marks.iter().map(|mark| mark.x));
    let up = diagram.y.spec(marks.iter().flat_map(|mark| [mark.y, mark.reach[0], mark.reach[1]]));
    let sheet = PANEL.with_room_for(&up);
    let mut chart = sheet.draw_axes(panel, &across, &up, true)?;
    chart.draw_series([PathElement::new(diagram.behind.clone(), line(&GREY.mix(0.3), 7.0))])?;
    for (style, marks) in &diagram.lines {
        draw_line(whole, &mut chart, *style, &diagram.shown(marks))?;
    }
    sheet.draw_frame(panel)
}

pub(super) fn draw_line(whole: &Area, chart: &mut Chart, style: usize, marks: &[Mark]) -> DrawResult<()> {
    let places: Vec<(f64, f64)> = marks.iter().map(|mark| (mark.x, mark.y)).collect();
    let reaches = marks.iter().filter(|mark| mark.reach[0] < mark.reach[1]);
    let bars = reaches.map(|mark| PathElement::new(mark.reach.map(|y| (mark.x, y)).to_vec(), line(&colour(style), 1.0)));
    chart.draw_series(bars)?;
    chart.draw_series([PathElement::new(places.clone(), line(&colour(style), 1.4))])?;
    for (mark, place) in marks.iter().zip(&places) {
        draw_mark(whole, chart.backend_coord(place), style, mark.hollow)?;
    }
    Ok(())
}

/// Draws a mark around a place on the sheet.
fn draw_mark(area: &Area, (x, y): (i32, i32), style: usize, hollow: bool) -> DrawResult<()> {
    let fill = ShapeStyle::from(if hollow { WHITE } else { colour(style) }).filled();
    let Some((corners, first)) = MARKS[style % MARKS.len()] else {
        for style in [fill, line(&colour(style), 1.2)] {
            area.draw(&Circle::new((x, y), (RADIUS * f64::from(PIXEL)) as u32, style))?;
        }
        return Ok(());
    };
    let corner = |k: usize| {
        let angle = std::f64::consts::FRAC_PI_2 * (first + 4.0 * k as f64 / corners as f64);
        let across = |part: f64| (RADIUS * f64::from(PIXEL) * part).round() as i32;
        (x + across(angle.cos()), y + across(angle.sin()))
    };
    let outline: Vec<(i32, i32)> = (0..=corners).map(corner).collect();
    area.draw(&Polygon::new(outline.clone(), fill))?;
    area.draw(&PathElement::new(outline, line(&colour(style), 1.2)))?;
    Ok(())
}

pub(super) fn colour(style: usize) -> RGBColor {
    LINES[style % LINES.len()]
}

impl Diagram {
    /// Every mark that the axes can show.
    fn marks(&self) -> impl Iterator<Item = &Mark> {
        self.lines.iter().flat_map(|(_, marks)| marks).filter(|mark| self.x.shows(mark.x) && self.y.shows(mark.y))
    }

    /// Those marks of a line that the axes can show, and as much of their reach.
    fn shown(&self, marks: &[Mark]) -> Vec<Mark> {
        let shown = marks.iter().filter(|mark| self.x.shows(mark.x) && self.y.shows(mark.y));
        let cut = |mark: &Mark| Mark { reach: mark.reach.map(|y| if self.y.shows(y) { y } else { mark.y }), ..*mark };
        shown.map(cut).collect()
    }
}

impl Axis {
    /// Whether it can show a value.
    pub(super) fn shows(&self, value: f64) -> bool {
        value.is_finite() && (!self.logarithmic || value > 0.0)
    }

    /// The axis with room around these values.
    pub(super) fn spec(&self, values: impl Iterator<Item = f64>) -> AxisSpec {
        let shown = values.filter(|value| self.shows(*value));
        let [low, high] = shown.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(value), high.max(value)]);
        let (scale, range, ticks) = if self.logarithmic {
            let room = (high / low).powf(0.06).max(1.25);
            let range = [low / room, high * room];
            (Scale::Logarithmic, range, Ticks::decades(range, 7))
        } else {
            let range = [0.0, if high > 0.0 { 1.12 * high } else { 1.0 }];
            (Scale::Linear, range, Ticks::new(range, 6))
        };
        AxisSpec { scale, range, ticks, name: self.name.clone() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Error against unknowns for two lines of these orders, and a diagram without a mark.
    fn block(orders: [f64; 2]) -> DiagramBlock {
        let mark = |order: f64, n: f64| Mark { x: n, y: n.powf(-order), reach: [n.powf(-order) / 2.0; 2], hollow: n > 1e4 };
        let marks = |order: f64| [1e3, 4e3, 1.6e4].map(|n| mark(order, n)).to_vec();
        let axis = |name: &str| Axis { name: name.into(), logarithmic: true };
        let full = Diagram {
            title: "error & unknowns".into(),
            x: axis("unknowns"),
            y: axis("error <1>"),
            behind: vec![(1e3, 1e-3), (1.6e4, 1e-6)],
            lines: orders.into_iter().enumerate().map(|(style, order)| (style, marks(order))).collect(),
        };
        let entry = |style| LegendRow { style, cells: vec![format!("line {style}"), "a law".into()] };
        DiagramBlock { title: "bars".into(), legend: vec![entry(0), entry(1)], diagrams: vec![full, Diagram::default()] }
    }

    fn count(text: &str, word: &str) -> usize {
        text.matches(word).count()
    }

    /// Marks of the first two styles: circles, drawn twice, and squares.
    fn drawn(text: &str) -> usize {
        count(text, "<circle") / 2 + count(text, "<polygon")
    }

    #[test]
    fn every_line_has_its_marks_and_its_row() {
        let text = diagrams(&[block([0.5, 1.0])]).unwrap().unwrap();
        assert!(text.starts_with("<svg xmlns=") && text.ends_with("</svg>\n"), "{text}");
        assert_eq!(drawn(&text), 2 * 3 + 2, "marks, and samples in the legend");
        assert!(text.contains("error &amp; unknowns") && text.contains("error &lt;1&gt;") && !text.contains("NaN"));
        assert_eq!((count(&text, "line 0"), count(&text, "a law")), (1, 2));
        let two = diagrams(&[block([0.5, 1.0]), block([0.1, 0.2])]).unwrap().unwrap();
        assert_eq!(drawn(&two), 2 * drawn(&text));
    }

    /// Places and sizes of all texts with these words.
    fn texts(svg: &str, words: &str) -> Vec<(f64, f64)> {
        let lines: Vec<&str> = svg.lines().collect();
        let value = |tag: &str, name: &str| tag.split(&format!("{name}=\"")).nth(1)?.split('"').next()?.parse().ok();
        let place = |pair: &[&str]| pair[1].starts_with(words).then(|| (value(pair[0], " x"), value(pair[0], "font-size")));
        lines.windows(2).filter_map(place).map(|(x, size)| (x.expect("a place"), size.expect("a size"))).collect()
    }

    #[test]
    fn a_long_legend_is_drawn_smaller_and_stays_on_the_sheet() {
        let mut long = block([0.5, 1.0]);
        let short = diagrams(&[long.clone()]).unwrap().unwrap();
        long.legend[1].cells = vec!["the name of a line".into(); 10];
        let text = diagrams(&[long]).unwrap().unwrap();
        let (found, usual) = (texts(&text, "the name"), texts(&short, "a law")[0].1);
        let (last, size) = found[found.len() - 1];
        assert_eq!(found.len(), 10);
        assert!(size < usual && last + text_width("the name of a line", size) <= f64::from(PANEL.width * 2 * PIXEL), "{found:?}");
    }

    #[test]
    fn equal_ratios_are_equal_distances() {
        let axis = Axis { name: String::new(), logarithmic: true }.spec([1.0, 100.0].into_iter());
        let place = |value: f64| plotters::coord::ranged1d::Ranged::map(&axis, &value, (0, 1000));
        assert!((place(100.0) - place(10.0) - (place(10.0) - place(1.0))).abs() <= 1 && place(1.0) > 0 && place(100.0) < 1000);
    }

    #[test]
    fn what_an_axis_cannot_show_is_left_out() {
        let mut bad = block([0.5, 1.0]);
        let marks = &mut bad.diagrams[0].lines[0].1;
        (marks[0].y, marks[1].y, marks[2].reach) = (0.0, f64::NAN, [-1.0, 1.0]);
        let text = diagrams(&[bad.clone()]).unwrap().unwrap();
        assert!(drawn(&text) == 1 + 3 + 2 && !text.contains("NaN"), "{text}");
        bad.diagrams[0].lines.clear();
        assert_eq!(diagrams(&[bad]).unwrap(), None);
        assert_eq!(diagrams(&[]).unwrap(), None);
    }

    #[test]
    fn one_point_is_a_diagram_and_zero_is_one_too() {
        let mut single = block([0.5, 1.0]);
        single.diagrams[0].lines.truncate(1);
        single.diagrams[0].lines[0].1.truncate(1);
        assert!(diagrams(&[single.clone()]).unwrap().is_some());
        single.diagrams[0].y.logarithmic = false;
        single.diagrams[0].lines[0].1[0].y = 0.0;
        assert!(!diagrams(&[single]).unwrap().unwrap().contains("NaN"));
    }
}
