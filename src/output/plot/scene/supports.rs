//! Marks of supports: triangles on a hatched ground or on rollers, and springs.

use std::fmt::Write;

use super::canvas::{Canvas, flipped, size_of_marks};
use super::drawn::{BoundaryPoint, Grip, SceneFigure};
use crate::output::plot::outline::straight;
use crate::output::plot::palette::{GREEN, hex};
use crate::output::plot::sheet::PIXEL;

/// Distance of two marks of a support (pixels).
const APART: f64 = 34.0;

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

    /// A line from place to place.
    fn line(&self, places: &[[f64; 2]]) -> String {
        straight(places.iter().map(|place| self.point(*place)))
    }

    /// A spring in front of a wall.
    fn spring(&self) -> String {
        let turns = (1..7).map(|k| [2.0 + 1.8 * f64::from(k), if k % 2 == 0 { 3.5 } else { -3.5 }]);
        let all: Vec<[f64; 2]> = [[0.0, 0.0], [2.0, 0.0]].into_iter().chain(turns).chain([[14.6, 0.0], [17.0, 0.0]]).collect();
        self.line(&all) + &self.line(&[[17.0, -6.0], [17.0, 6.0]])
    }

    /// A hatched ground below a triangle.
    fn hatched_ground(&self) -> String {
        let hatch = |k: i32| self.line(&[[9.5, 3.5 * f64::from(k) + 1.0], [13.5, 3.5 * f64::from(k) - 2.0]]);
        self.line(&[[9.5, -8.0], [9.5, 8.0]]) + &(-2..=2).map(hatch).collect::<String>()
    }
}

impl Canvas<'_> {
    /// Supports: lines along their boundaries, and marks.
    pub fn supports(&mut self, figure: &SceneFigure) {
        let size = size_of_marks(figure.supports.len());
        for support in &figure.supports {
            self.along(&support.rows, &hex(GREEN), 2.0 * size, 1.0);
            for BoundaryPoint { place, normal, .. } in self.spread(&support.rows, APART) {
                self.mark(&MarkFrame::new(self.at(place), support.grip, flipped(normal), size), support.grip);
            }
        }
    }

    /// A triangle with its tip at the boundary: on a hatched ground, on rollers, or a spring.
    fn mark(&mut self, frame: &MarkFrame, grip: Grip) {
        let stroke = format!("stroke=\"{}\" stroke-width=\"{:.0}\"", hex(GREEN), 10.0 * frame.size);
        let thin = format!("fill=\"none\" {stroke}");
        if grip == Grip::Springs {
            self.path(&thin, &frame.spring());
        } else {
            let triangle = frame.line(&[[0.5, 0.0], [9.5, -5.5], [9.5, 5.5]]) + "z";
            self.path(&format!("fill=\"#fff\" {stroke}"), &triangle);
            if grip == Grip::Both {
                self.path(&thin, &frame.hatched_ground());
            } else {
                for aside in [-3.0, 3.0] {
                    let [x, y] = frame.point([11.8, aside]).map(|at| f64::from(PIXEL) * at);
                    let radius = 20.0 * frame.size;
                    let _ = writeln!(self.text, "<circle cx=\"{x:.0}\" cy=\"{y:.0}\" r=\"{radius:.0}\" {thin}/>");
                }
                self.path(&thin, &frame.line(&[[14.5, -8.0], [14.5, 8.0]]));
            }
        }
        self.labels.take(frame.point([8.0, 0.0]), 15.0 * frame.size);
    }
}
