//! What has been drawn of a scene so far.

use std::fmt::Write;

use plotters::style::RGBColor;

use super::drawn::{BoundaryPoint, DrawnPart, Rows, SceneFigure};
use crate::output::plot::labels::{Frame, PlacedNames, escaped};
use crate::output::plot::outline::{edges_around, line_data, loops, path_data, unmatched};
use crate::output::plot::palette::{INK, LINES, VERMILION, hex};
use crate::output::plot::sheet::{PIXEL, Sheet};

/// Marks on one line at most.
const MOST_MARKS: usize = 60;
/// Of more things of one kind some are named only, spread over all of them: a figure has room for some 60 names. Lines, marks and
/// arrows are smaller there, by this factor.
pub const MOST_NAMES: usize = 60;
const SMALLER: f64 = 0.3;
/// Fillings of bodies.
const FILLS: [&str; 6] = ["#d9e6f2", "#f8e3d0", "#dcefe7", "#f3e2ee", "#faf0cd", "#e2e6ea"];

/// What has been drawn so far.
pub struct Canvas<'a> {
    /// All elements of SVG.
    pub text: String,
    place: &'a dyn Fn([f64; 2]) -> (i32, i32),
    /// What has a place already.
    pub labels: PlacedNames,
    /// Names that are put last, over everything.
    pub late: String,
    /// Of each kind of which not all could be named: how many are, of how many.
    pub counts: Vec<String>,
}

impl<'a> Canvas<'a> {
    /// Nothing yet; `place` gives the place of a point of the plane (tenths of a pixel).
    pub fn new(sheet: &Sheet, figure: &SceneFigure, place: &'a dyn Fn([f64; 2]) -> (i32, i32)) -> Self {
        let [left, right, top, bottom] = sheet.margins.map(f64::from);
        let room = Frame([left + 3.0, top + 3.0, f64::from(sheet.width) - right - 3.0, f64::from(sheet.height) - bottom - 3.0]);
        let points = figure.boundaries.iter().flat_map(|named| named.rows.iter().flatten());
        let lines = points.map(|point| pixels(place, point.place)).collect();
        Self { text: String::new(), place, labels: PlacedNames::new(room, lines), late: String::new(), counts: Vec::new() }
    }

    /// The place of a point of the plane in the figure (pixels).
    pub fn at(&self, x: [f64; 2]) -> [f64; 2] {
        pixels(self.place, x)
    }

    /// Adds a path: its attributes, and the `d` that it follows.
    pub fn path(&mut self, attributes: &str, data: &str) {
        let _ = writeln!(self.text, "<path {attributes} d=\"{data}\"/>");
    }

    /// Bodies with their macro edges.
    pub fn bodies(&mut self, figure: &SceneFigure) {
        let placed = |points: &Vec<[f64; 2]>| points.iter().map(|x| (self.place)(*x)).collect::<Vec<_>>();
        let outline = |part: &DrawnPart| {
            let around = |points| edges_around(&placed(points)).collect::<Vec<_>>();
            path_data(&loops(&unmatched(part.triangles.iter().flat_map(around))))
        };
        let outlines: Vec<String> = figure.parts.iter().map(outline).collect();
        let lines: String = figure.edges.iter().map(|row| line_data(&placed(row))).collect();
        for (number, (part, data)) in figure.parts.iter().zip(&outlines).enumerate() {
            let fill = if part.is_rigid { "#b4b4b4" } else { FILLS[number % FILLS.len()] };
            self.path(&format!("fill=\"{fill}\" fill-rule=\"evenodd\""), data);
        }
        if !lines.is_empty() {
            self.path("fill=\"none\" stroke=\"#fff\" stroke-width=\"6\"", &lines);
        }
        let stroke = format!("fill=\"none\" stroke=\"{}\" stroke-width=\"10\"", hex(INK));
        outlines.iter().for_each(|data| self.path(&stroke, data));
    }

    /// Lines along the rows; their width is in pixels.
    pub fn along(&mut self, rows: &Rows, colour: &str, width: f64, opacity: f64) {
        let placed = |row: &Vec<BoundaryPoint>| line_data(&row.iter().map(|point| (self.place)(point.place)).collect::<Vec<_>>());
        let lines: String = rows.iter().map(placed).collect();
        let width = width * f64::from(PIXEL);
        self.path(&format!("fill=\"none\" stroke=\"{colour}\" stroke-opacity=\"{opacity}\" stroke-width=\"{width:.0}\""), &lines);
    }

    /// Contacts, each in its colour.
    pub fn contacts(&mut self, figure: &SceneFigure) {
        for (number, contact) in figure.contacts.iter().enumerate() {
            self.along(&contact.rows, &hex(contact_colour(number)), 4.0 * size_of_marks(figure.contacts.len()), 0.85);
        }
    }

    /// Points of rows, about so many pixels apart.
    pub fn spread(&self, rows: &Rows, apart: f64) -> Vec<BoundaryPoint> {
        rows.iter().flat_map(|row| self.spread_along(row, apart)).collect()
    }

    /// Points of one row.
    fn spread_along(&self, row: &[BoundaryPoint], apart: f64) -> Vec<BoundaryPoint> {
        if row.len() == 1 {
            return row.to_vec();
        }
        let placed: Vec<[f64; 2]> = row.iter().map(|point| self.at(point.place)).collect();
        let steps: Vec<f64> = placed.windows(2).map(|two| (two[1][0] - two[0][0]).hypot(two[1][1] - two[0][1])).collect();
        let length: f64 = steps.iter().sum();
        let count = ((length / apart).round() as usize).clamp(1, MOST_MARKS);
        let (mut passed, mut found) = (0.0, Vec::new());
        for (two, step) in row.windows(2).zip(steps) {
            let next = |found: &[BoundaryPoint]| (found.len() as f64 + 0.5) * length / count as f64;
            while found.len() < count && next(&found) <= passed + step {
                found.push(two[0].towards(&two[1], (next(&found) - passed) / step.max(f64::MIN_POSITIVE)));
            }
            passed += step;
        }
        found
    }

    /// A place at this share of the longest row, and the direction out of the body there, in the figure.
    pub fn middle(&self, rows: &Rows, share: f64) -> Option<([f64; 2], [f64; 2])> {
        let row = rows.iter().max_by_key(|row| row.len())?;
        let point = row.get(((row.len() - 1) as f64 * share).round() as usize)?;
        Some((self.at(point.place), flipped(point.normal)))
    }

    /// Remarks, each a line of this height, from a place on (pixels).
    pub fn remarks(&mut self, [x, y]: [i32; 2], height: i32, remarks: &[String]) {
        for (k, remark) in remarks.iter().enumerate() {
            let _ = writeln!(
                self.text,
                "<text x=\"{}\" y=\"{}\" font-family=\"sans-serif\" font-size=\"120\" fill=\"{}\">{}</text>",
                x * PIXEL,
                (y + height * k as i32 + 8) * PIXEL,
                hex(VERMILION),
                escaped(remark)
            );
        }
    }
}

/// Colour of a contact.
pub fn contact_colour(number: usize) -> RGBColor {
    const COLOURS: [usize; 4] = [0, 4, 3, 5];
    LINES[COLOURS[number % COLOURS.len()]]
}

/// How large marks are drawn of which there are so many.
pub fn size_of_marks(count: usize) -> f64 {
    if count > MOST_NAMES { SMALLER } else { 1.0 }
}

/// A place in pixels.
fn pixels(place: &dyn Fn([f64; 2]) -> (i32, i32), x: [f64; 2]) -> [f64; 2] {
    let (x, y) = place(x);
    [x, y].map(|x| f64::from(x) / f64::from(PIXEL))
}

/// A direction of the plane in the figure, whose y axis goes down.
pub fn flipped([x, y]: [f64; 2]) -> [f64; 2] {
    [x, -y]
}
