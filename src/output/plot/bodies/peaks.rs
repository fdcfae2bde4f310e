//! Rings around the largest stresses.

use crate::geometry::{Coordinates, Point};
use crate::output::plot::drawing::{Canvas, Chart, INK, Letters, Name, Paint, PlacedNames, WHITE, Wish, number_text};
use crate::output::summary::BodySummary;
use crate::output::units::Unit;

/// Of so many bodies each has a ring, of more the one with the largest stress alone.
const MOST_RINGS: usize = 4;
/// Radius of a ring (pixels).
const RADIUS: f64 = 5.0;

/// Draws a ring around the largest stress of each body, or of all, with the number beside it.
pub fn draw_peaks(canvas: &mut Canvas, chart: &Chart, bodies: &[(String, BodySummary)], (scale, unit): (f64, Unit)) {
    let peaks = bodies.iter().filter_map(|(_, body)| {
        let stress = body.von_mises_max.filter(|stress| *stress > 0.0)?;
        let place = [0, 1].map(|axis| body.place.map_or(f64::NAN, |place| place[axis]) + scale * body.displacement[axis]);
        Some((stress, chart.place(place), body))
    });
    let mut shown: Vec<(f64, [f64; 2], &BodySummary)> = peaks.collect();
    shown.sort_by(|a, b| b.0.total_cmp(&a.0));
    if bodies.len() > MOST_RINGS {
        shown.truncate(1);
    }
    let mut names = PlacedNames::new(chart.frame, Vec::new());
    shown.iter().for_each(|(_, at, _)| names.take(*at, 2.0 * RADIUS));
    for (stress, at, body) in shown {
        let ring = Paint::line(INK, 1.2);
        let against = if body.is_believed { "" } else { ", not to be believed" };
        let text = format!("{}{}{against}", number_text(stress), unit.after());
        let place = Coordinates(body.place.map_or(Point::zeros(), Point::from));
        canvas.told(&format!("{text}, at {place}"), |canvas| {
            canvas.circle(Paint::line(WHITE, 3.0).faint(0.85), at, RADIUS);
            canvas.circle(if body.is_believed { ring } else { ring.dashed() }, at, RADIUS);
        });
        names.put(canvas, &Name { text: &text, letters: Letters::new(11.0, INK), anchor: at, wish: Wish::There });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::plot::drawing::PlotRoom;
    use crate::output::units::Units;

    fn drawn(count: usize) -> String {
        let units = Units::new(Some("mm"), Some("N"), false);
        let room = PlotRoom { most: [640.0, 560.0], least: [320.0, 220.0], around: 0.0 };
        let chart = Chart::of_plane([[0.0, 0.0], [2.0, 1.0]], &room, [60.0, 0.0], (false, units.length()));
        let mut canvas = Canvas::new(chart.panel.extent());
        let peak = |k: usize| {
            let (place, displacement) = (Some([0.1 + 0.2 * k as f64, 0.5]), [0.0, 1e-3]);
            let von_mises_max = Some(10.0 * k as f64);
            (k.to_string(), BodySummary { place, displacement, von_mises_max, is_believed: k != 2, ..BodySummary::default() })
        };
        draw_peaks(&mut canvas, &chart, &(0..count).map(peak).collect::<Vec<_>>(), (100.0, units.stress()));
        canvas.svg()
    }

    #[test]
    fn few_bodies_have_a_ring_each_and_many_have_one() {
        let few = drawn(4);
        // Each ring has a rim, and each number too; a body without stress has none.
        assert_eq!((few.matches("<circle").count(), few.matches(">20 MPa, not to be believed<").count()), (6, 2), "{few}");
        assert!(few.contains(">30 MPa<") && few.contains(">10 MPa<") && few.matches("dasharray").count() == 1);
        assert!(few.contains("<title>20 MPa, not to be believed, at (0.5, 0.5)</title>"), "the value under the pointer");
        let many = drawn(9);
        assert_eq!((many.matches("<circle").count(), many.matches(">80 MPa<").count()), (2, 2), "{many}");
    }
}
