//! What has been drawn of a scene so far.

use super::drawn::{BoundaryPoint, DrawnPart, Rows, SceneFigure};
use crate::output::plot::drawing::{Canvas, Chart, Colour, GREY, INK, LINES, Paint, PlacedNames, WHITE, edges_around, merged};

/// Marks on one line at most.
const MOST_MARKS: usize = 60;
/// Of more things of one kind some are named only, spread over all of them: a figure has room for some 60 names. Lines, marks and
/// arrows are smaller there, by this factor.
pub const MOST_NAMES: usize = 60;
const SMALLER: f64 = 0.3;
/// Bodies are filled with colours of lines, so faint; rigid tools are grey.
const FILLING: f64 = 0.16;
const RIGID: Paint = Paint::fill(GREY).faint(0.5);

/// What has been drawn so far.
pub struct ScenePlot {
    /// The figure.
    pub canvas: Canvas,
    /// Its axes.
    pub chart: Chart,
    /// What has a place already.
    pub labels: PlacedNames,
}

impl ScenePlot {
    /// Nothing yet; names will keep away from the boundaries of the scene.
    pub fn new(canvas: Canvas, chart: Chart, figure: &SceneFigure) -> Self {
        let points = figure.boundaries.iter().flat_map(|named| named.rows.iter().flatten());
        let labels = PlacedNames::new(chart.frame.shrunk(3.0), points.map(|point| chart.place(point.place)).collect());
        Self { canvas, chart, labels }
    }

    /// Bodies with their macro edges, and contacts, each in its colour.
    pub fn bodies(&mut self, figure: &SceneFigure) {
        let chart = &self.chart;
        let place = |points: &Vec<[f64; 2]>| points.iter().map(|x| chart.place(*x)).collect::<Vec<_>>();
        let outline = |part: &DrawnPart| merged(part.triangles.iter().flat_map(|points| edges_around(place(points))));
        let outlines: Vec<String> = figure.parts.iter().map(outline).collect();
        self.canvas.within(chart.frame, "", |canvas| {
            for (number, (part, data)) in figure.parts.iter().zip(&outlines).enumerate() {
                let filling = Paint::fill(LINES[number % LINES.len()]).faint(FILLING);
                canvas.path(if part.is_rigid { RIGID } else { filling }, data);
            }
            canvas.lines(Paint::line(WHITE, 0.6), figure.edges.iter().map(place));
            outlines.iter().for_each(|data| canvas.path(Paint::line(INK, 1.0), data));
            let width = 4.0 * size_of_marks(figure.contacts.len());
            for (number, contact) in figure.contacts.iter().enumerate() {
                canvas.lines(Paint::line(contact_colour(number), width).faint(0.85), placed(chart, &contact.rows));
            }
        });
    }

    /// Lines along the rows.
    pub fn along(&mut self, rows: &Rows, paint: Paint) {
        self.canvas.lines(paint, placed(&self.chart, rows));
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
        let placed: Vec<[f64; 2]> = row.iter().map(|point| self.chart.place(point.place)).collect();
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
        Some((self.chart.place(point.place), flipped(point.normal)))
    }
}

/// Rows in the figure.
fn placed(chart: &Chart, rows: &Rows) -> impl Iterator<Item = Vec<[f64; 2]>> {
    rows.iter().map(|row| row.iter().map(|point| chart.place(point.place)).collect())
}

/// Colour of a contact.
pub fn contact_colour(number: usize) -> Colour {
    const COLOURS: [usize; 4] = [0, 4, 3, 5];
    LINES[COLOURS[number % COLOURS.len()]]
}

/// How large marks are drawn of which there are so many.
pub fn size_of_marks(count: usize) -> f64 {
    if count > MOST_NAMES { SMALLER } else { 1.0 }
}

/// A direction of the plane in the figure, whose y axis goes down.
pub fn flipped([x, y]: [f64; 2]) -> [f64; 2] {
    [x, -y]
}
