//! Arrows of loads.

use super::drawn::{BoundaryPoint, DrawnLoad, SceneFigure};
use super::scene_plot::{ScenePlot, flipped, size_of_marks};
use crate::output::plot::drawing::{Paint, VERMILION};

/// Distance of two arrows of a load (pixels).
const APART: f64 = 22.0;
/// Length of the longest arrow of a traction (pixels).
const LONGEST: f64 = 30.0;
/// Length of the arrow of a resultant (pixels).
pub const RESULTANT: f64 = 44.0;

impl ScenePlot {
    /// Loads: lines along their boundaries, and arrows.
    pub fn loads(&mut self, figure: &SceneFigure) {
        let size = size_of_marks(figure.loads.len());
        for load in &figure.loads {
            if load.is_plate {
                self.along(&load.rows, Paint::line(VERMILION, 4.5).faint(0.9));
            } else {
                self.along(&load.rows, Paint::line(VERMILION, 2.0));
            }
            match load.resultant {
                Some(resultant) => self.resultant(load, resultant, size),
                None => self.tractions(load, size),
            }
        }
    }

    /// One arrow for all of a load.
    fn resultant(&mut self, load: &DrawnLoad, (place, direction): ([f64; 2], [f64; 2]), size: f64) {
        let strength = direction[0].hypot(direction[1]);
        if strength > 0.0 {
            let normal = load.rows.iter().flatten().next().map_or(direction.map(|part| -part), |point| point.normal);
            let (length, along) = (size * RESULTANT, direction.map(|part| part / strength));
            let at = self.labels.within(self.chart.place(place), length);
            self.arrow(at, flipped(along), flipped(normal), length, 1.8 * size);
        }
    }

    /// Arrows along the boundary, as long as the tractions are large.
    fn tractions(&mut self, load: &DrawnLoad, size: f64) {
        let strength = |point: &BoundaryPoint| point.traction[0].hypot(point.traction[1]);
        let largest = load.rows.iter().flatten().map(strength).fold(0.0, f64::max);
        for point in self.spread(&load.rows, APART) {
            let own = strength(&point);
            if own > 1e-6 * largest && largest.is_finite() {
                let (at, along) = (self.chart.place(point.place), flipped(point.traction.map(|part| part / own)));
                let length = (size * LONGEST * own / largest).max(8.0 * size);
                self.arrow(at, along, flipped(point.normal), length, size);
            }
        }
    }

    /// An arrow outside the body: it ends at the point if it pushes, and begins there if it pulls. Its line is so wide
    /// (pixels).
    fn arrow(&mut self, at: [f64; 2], along: [f64; 2], normal: [f64; 2], length: f64, width: f64) {
        let pushes = along[0] * normal[0] + along[1] * normal[1] <= 0.0;
        let shift = |from: [f64; 2], by: f64, aside: f64| {
            [from[0] + by * along[0] - aside * along[1], from[1] + by * along[1] + aside * along[0]]
        };
        let tip = if pushes { shift(at, -1.0, 0.0) } else { shift(at, length, 0.0) };
        let head = (5.0 + 2.0 * width).min(0.5 * length);
        let [neck, left, right] = [0.0, 0.42, -0.42].map(|aside| shift(tip, -head, aside * head));
        self.canvas.line(Paint::line(VERMILION, width), [shift(tip, -length, 0.0), neck]);
        self.canvas.polygon(Paint::fill(VERMILION), [tip, left, right]);
        for share in [0.2, 0.5, 0.8] {
            self.labels.take(shift(tip, -share * length, 0.0), 9.0);
        }
    }
}
