//! Marks of supports: triangles on a hatched ground or on rollers, and springs.

use super::drawn::{BoundaryPoint, Grip, SceneFigure};
use super::scene_plot::{ScenePlot, flipped, size_of_marks};
use crate::output::plot::drawing::{Canvas, GREEN, Paint, WHITE};

/// Distance of two marks of a support (pixels).
const APART: f64 = 34.0;

/// Lines of a spring in front of a wall, by their places away from the body and aside (pixels).
const SPRING: [&[[f64; 2]]; 3] = [
    &[[0.0, 0.0], [2.0, 0.0], [3.8, -3.5], [5.6, 3.5], [7.4, -3.5], [9.2, 3.5]],
    &[[9.2, 3.5], [11.0, -3.5], [12.8, 3.5], [14.6, 0.0], [17.0, 0.0]],
    &[[17.0, -6.0], [17.0, 6.0]],
];
/// Lines of a hatched ground below a triangle.
const HATCHED_GROUND: [&[[f64; 2]]; 6] = [
    &[[9.5, -8.0], [9.5, 8.0]],
    &[[9.5, -6.0], [13.5, -9.0]],
    &[[9.5, -2.5], [13.5, -5.5]],
    &[[9.5, 1.0], [13.5, -2.0]],
    &[[9.5, 4.5], [13.5, 1.5]],
    &[[9.5, 8.0], [13.5, 5.0]],
];

/// Where a mark stands in the figure (pixels).
struct MarkFrame {
    /// The point of the boundary that its tip touches.
    tip: [f64; 2],
    /// The direction away from the body.
    out: [f64; 2],
    /// How large it is beside others, which are 1.
    size: f64,
}

impl MarkFrame {
    fn new(tip: [f64; 2], grip: Grip, normal: [f64; 2], size: f64) -> Self {
        let out = match grip {
            Grip::Along(axis) => {
                let axis = flipped(axis);
                if axis[0] * normal[0] + axis[1] * normal[1] < 0.0 { axis.map(|part| -part) } else { axis }
            }
            _ => normal,
        };
        Self { tip, out, size }
    }

    /// A place so far away from the body, and so far aside.
    fn point(&self, place: [f64; 2]) -> [f64; 2] {
        let ([away, aside], [x, y]) = (place.map(|way| self.size * way), self.out);
        [self.tip[0] + away * x - aside * y, self.tip[1] + away * y + aside * x]
    }

    /// Draws lines from place to place.
    fn lines(&self, canvas: &mut Canvas, lines: &[&[[f64; 2]]]) {
        let points = |line: &&[[f64; 2]]| line.iter().map(|place| self.point(*place)).collect::<Vec<_>>();
        canvas.lines(Paint::line(GREEN, self.size), lines.iter().map(points));
    }
}

impl ScenePlot {
    /// Supports: lines along their boundaries, and marks.
    pub fn supports(&mut self, figure: &SceneFigure) {
        let size = size_of_marks(figure.supports.len());
        for support in &figure.supports {
            self.along(&support.rows, Paint::line(GREEN, 2.0 * size));
            for BoundaryPoint { place, normal, .. } in self.spread(&support.rows, APART) {
                self.mark(&MarkFrame::new(self.chart.place(place), support.grip, flipped(normal), size), support.grip);
            }
        }
    }

    /// A triangle with its tip at the boundary: on a hatched ground, on rollers, or a spring.
    fn mark(&mut self, frame: &MarkFrame, grip: Grip) {
        self.labels.take(frame.point([8.0, 0.0]), 15.0 * frame.size);
        if grip == Grip::Springs {
            return frame.lines(&mut self.canvas, &SPRING);
        }
        let corners = [[0.5, 0.0], [9.5, -5.5], [9.5, 5.5]].map(|place| frame.point(place));
        self.canvas.polygon(Paint::fill(WHITE).edged(GREEN, frame.size), corners);
        if grip == Grip::Both {
            return frame.lines(&mut self.canvas, &HATCHED_GROUND);
        }
        for roller in [[11.8, -3.0], [11.8, 3.0]] {
            self.canvas.circle(Paint::line(GREEN, frame.size), frame.point(roller), 2.0 * frame.size);
        }
        frame.lines(&mut self.canvas, &[&[[14.5, -8.0], [14.5, 8.0]]]);
    }
}
