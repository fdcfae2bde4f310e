//! Diagrams whose lines bear their names at their ends.

use plotters::element::{PathElement, Rectangle, Text};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, FontStyle, RGBColor};

use super::diagrams::{Axis, Mark, TITLE, colour, draw_line};
use super::palette::GREY;
use super::sheet::{Area, AxisSpec, DrawResult, PIXEL, Sheet, line, text_style, text_width};

/// A diagram of lines with names.
#[derive(Clone, Debug, Default)]
pub struct NamedDiagram {
    /// Stands above it.
    pub title: String,
    /// Horizontal axis; its values fall to the right if it is `falling`.
    pub x: Axis,
    /// Whether the horizontal axis runs from large values to small ones: errors become better to the right.
    pub falling: bool,
    /// Vertical axis.
    pub y: Axis,
    /// Drawn grey and broad, behind the lines.
    pub behind: Vec<(f64, f64)>,
    /// Lines, which end where their names stand.
    pub lines: Vec<NamedLine>,
}

/// A line and its name.
#[derive(Clone, Debug, Default)]
pub struct NamedLine {
    /// Stands at its last mark.
    pub name: String,
    /// Its colour and its marks.
    pub style: usize,
    /// In order.
    pub marks: Vec<Mark>,
}

/// Size of a diagram without the names (pixels), and its margins.
const WIDTH: i32 = 740;
const HEIGHT: i32 = 460;
const MARGINS: [i32; 4] = [66, 24, TITLE + 6, 54];
/// Letters of the names, the height of one, and the way from a mark to its name (pixels).
const LETTERS: f64 = 11.5;
const ROW: f64 = 14.0;
const BESIDE: f64 = 9.0;
/// So much room a mark takes to either side (pixels).
const MARK: f64 = 4.0;
const WHITE: RGBColor = RGBColor(255, 255, 255);

/// A part of the sheet: left, top, right, bottom (pixels).
type NameRoom = [f64; 4];

/// The text of an SVG file with all diagrams one below the other; None if there is no mark in them.
///
/// # Errors
/// What plotters has to say, in words.
pub fn named_diagrams(diagrams: &[NamedDiagram]) -> Result<Option<String>, String> {
    let shown: Vec<NamedDiagram> = diagrams.iter().map(NamedDiagram::visible).filter(|one| !one.lines.is_empty()).collect();
    if shown.is_empty() {
        return Ok(None);
    }
    let names = shown.iter().flat_map(|diagram| &diagram.lines).map(|line| text_width(&line.name, LETTERS));
    let room = names.fold(0.0, f64::max).ceil() as i32 + 2 * BESIDE as i32;
    let height = HEIGHT * shown.len() as i32;
    let sheet = Sheet { width: WIDTH + room, height, margins: MARGINS };
    let drawn = sheet.text(|sheet, area| {
        for (at, diagram) in shown.iter().enumerate() {
            let corner = (0, at as i32 * HEIGHT * PIXEL);
            let part = area.clone().shrink(corner, (sheet.width * PIXEL, HEIGHT * PIXEL));
            draw_named(area, &part, diagram, [f64::from(corner.1 / PIXEL), f64::from(room)])?;
        }
        Ok(String::new())
    });
    drawn.map(Some).map_err(|error| error.to_string())
}

impl NamedDiagram {
    /// With those marks and lines alone that the axes can show.
    fn visible(&self) -> Self {
        let marks = |line: &NamedLine| -> Vec<Mark> {
            let shown = line.marks.iter().filter(|mark| self.x.shows(mark.x) && self.y.shows(mark.y));
            shown.map(|mark| Mark { reach: mark.reach.map(|y| if self.y.shows(y) { y } else { mark.y }), ..*mark }).collect()
        };
        let lines = self.lines.iter().map(|line| NamedLine { marks: marks(line), ..line.clone() });
        Self { lines: lines.filter(|line| !line.marks.is_empty()).collect(), ..self.clone() }
    }

    fn axes(&self) -> [AxisSpec; 2] {
        let marks = || self.lines.iter().flat_map(|line| &line.marks);
        let mut x = self.x.spec(marks().map(|mark| mark.x));
        if self.falling {
            x.range.reverse();
        }
        [x, self.y.spec(marks().flat_map(|mark| [mark.y, mark.reach[0], mark.reach[1]]))]
    }
}

/// Draws one diagram into its part of the sheet, which begins at `top`; names have so much `room` at the right (pixels).
fn draw_named(whole: &Area, part: &Area, diagram: &NamedDiagram, [top, room]: [f64; 2]) -> DrawResult<()> {
    let [x, y] = diagram.axes();
    let own = Sheet { width: WIDTH + room as i32, height: HEIGHT, margins: MARGINS };
    let own = own.with_room_for(&y);
    own.draw_title(part, &diagram.title)?;
    let plot = Sheet { margins: [own.margins[0], MARGINS[1] + room as i32, own.margins[2], own.margins[3]], ..own };
    let mut chart = plot.draw_axes(part, &x, &y, true)?;
    chart.draw_series([PathElement::new(diagram.behind.clone(), line(&GREY.mix(0.3), 7.0))])?;
    for one in &diagram.lines {
        draw_line(whole, &mut chart, one.style, &one.marks)?;
    }
    let pixels = |mark: &Mark| {
        let (x, y) = chart.backend_coord(&(mark.x, mark.y));
        [f64::from(x), f64::from(y)].map(|at| at / f64::from(PIXEL))
    };
    let marks: Vec<Vec<[f64; 2]>> = diagram.lines.iter().map(|one| one.marks.iter().map(pixels).collect()).collect();
    let limits = [top + f64::from(MARGINS[2]), top + f64::from(HEIGHT - MARGINS[3])];
    let places = places(&diagram.lines, &marks, limits);
    for ((one, place), marks) in diagram.lines.iter().zip(&places).zip(&marks) {
        draw_name(whole, one, *place, marks[marks.len() - 1])?;
    }
    Ok(())
}

/// Where names stand: at the ends of their lines, or as near above or below as there is room beside marks and other names.
fn places(lines: &[NamedLine], marks: &[Vec<[f64; 2]>], [top, bottom]: [f64; 2]) -> Vec<NameRoom> {
    let mut taken: Vec<NameRoom> = marks.iter().flatten().map(|[x, y]| [x - MARK, y - MARK, x + MARK, y + MARK]).collect();
    let end = |at: usize| marks[at][marks[at].len() - 1];
    // Names at the right have the least choice.
    let mut order: Vec<usize> = (0..lines.len()).collect();
    order.sort_by(|&a, &b| end(b)[0].total_cmp(&end(a)[0]));
    let mut places = vec![[0.0; 4]; lines.len()];
    for at in order {
        let [x, y] = end(at);
        let room = |away: f64| {
            let left = x + BESIDE;
            [left, y + away - ROW / 2.0, left + text_width(&lines[at].name, LETTERS), y + away + ROW / 2.0]
        };
        let meets = |a: &NameRoom, b: &NameRoom| a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3];
        let steps = (0..120).flat_map(|step| [-1.0, 1.0].map(|sign| room(sign * 3.0 * f64::from(step))));
        let mut inside = steps.filter(|room| room[1] >= top && room[3] <= bottom);
        let free = inside.find(|room| !taken.iter().any(|other| meets(room, other)));
        places[at] = free.unwrap_or_else(|| room(0.0));
        taken.push(places[at]);
    }
    places
}

/// Draws a name, and a thin line to it from the end of its line if it stands away from that.
fn draw_name(whole: &Area, one: &NamedLine, place: NameRoom, [x, y]: [f64; 2]) -> DrawResult<()> {
    let pixels = |x: f64, y: f64| ((x * f64::from(PIXEL)).round() as i32, (y * f64::from(PIXEL)).round() as i32);
    let middle = 0.5 * (place[1] + place[3]);
    let paint = colour(one.style);
    if (middle - y).abs() > ROW / 2.0 {
        let leader = vec![pixels(x, y), pixels(place[0] - 2.0, middle)];
        whole.draw(&PathElement::new(leader, line(&paint.mix(0.6), 0.7)))?;
    }
    let behind = [pixels(place[0] - 2.0, place[1] + 1.0), pixels(place[2], place[3] - 1.0)];
    whole.draw(&Rectangle::new(behind, WHITE.mix(0.8).filled()))?;
    let style = text_style(LETTERS, FontStyle::Normal, paint).pos(Pos::new(HPos::Left, VPos::Center));
    whole.draw(&Text::new(one.name.clone(), pixels(place[0], middle), style))?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn diagram(ends: &[f64]) -> NamedDiagram {
        let axis = |name: &str| Axis { name: name.into(), logarithmic: true };
        let one = |(style, end): (usize, &f64)| {
            let mark = |x: f64, y: f64| Mark { x, y, reach: [y, y], hollow: false };
            NamedLine { name: format!("line <{style}>"), style, marks: vec![mark(0.1, 1.0), mark(*end, 8.0)] }
        };
        let lines = ends.iter().enumerate().map(one).collect();
        NamedDiagram { title: "bars".into(), x: axis("error"), falling: true, y: axis("time"), behind: Vec::new(), lines }
    }

    #[test]
    fn every_line_bears_its_name_and_no_two_names_meet() {
        let same = diagram(&[1e-3; 9]);
        let text = named_diagrams(&[same.clone(), diagram(&[1e-5])]).unwrap().unwrap();
        assert_eq!(text.matches("line &lt;").count(), 10);
        let marks = vec![vec![[50.0, 300.0], [400.0, 200.0]]; 9];
        let places = places(&same.lines, &marks, [40.0, 400.0]);
        for (at, one) in places.iter().enumerate() {
            assert!(one[0] > 400.0 && one[1] >= 40.0 && one[3] <= 400.0, "{one:?}");
            assert!(places[..at].iter().all(|other| one[1] >= other[3] || other[1] >= one[3]), "{places:?}");
        }
        assert_eq!(places.iter().filter(|place| place[1] == 200.0 - ROW / 2.0).count(), 1, "one stands at the end itself");
    }

    #[test]
    fn smaller_errors_are_at_the_right() {
        let [x, _] = diagram(&[1e-3, 1e-6]).axes();
        let place = |value: f64| plotters::coord::ranged1d::Ranged::map(&x, &value, (0, 1000));
        assert!(place(1e-6) > 800 && place(0.1) < 200 && x.ticks.values.len() > 2);
    }

    #[test]
    fn nothing_to_show_is_no_figure() {
        let mut empty = diagram(&[1e-3]);
        empty.lines[0].marks.iter_mut().for_each(|mark| mark.x = 0.0);
        assert_eq!(named_diagrams(&[empty]).unwrap(), None);
        assert_eq!(named_diagrams(&[]).unwrap(), None);
    }
}
