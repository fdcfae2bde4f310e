//! Rings around the largest stresses.

use crate::output::plot::drawing::{Canvas, Chart, INK, Letters, Name, Paint, PlacedNames, WHITE, Wish, number_text};
use crate::output::units::Unit;

/// Of so many bodies each has a ring, of more the one with the largest stress alone.
const MOST_RINGS: usize = 4;
/// Radius of a ring (pixels).
const RADIUS: f64 = 5.0;

/// The largest von Mises stress of a body as the figure shows it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrawnPeak {
    /// Where it is, undeformed.
    pub place: [f64; 2],
    /// Displacement of that place.
    pub displacement: [f64; 2],
    /// How large it is.
    pub von_mises: f64,
    /// Whether it can be believed.
    pub is_believed: bool,
}

/// Draws a ring around the largest stress of each body, or of all, with the number beside it.
pub fn draw_peaks(canvas: &mut Canvas, chart: &Chart, peaks: &[DrawnPeak], (scale, unit): (f64, Unit)) {
    let mut shown: Vec<&DrawnPeak> = peaks.iter().filter(|peak| peak.von_mises > 0.0).collect();
    shown.sort_by(|a, b| b.von_mises.total_cmp(&a.von_mises));
    if peaks.len() > MOST_RINGS {
        shown.truncate(1);
    }
    let mut names = PlacedNames::new(chart.frame, Vec::new());
    let place = |peak: &DrawnPeak| chart.place([0, 1].map(|axis| peak.place[axis] + scale * peak.displacement[axis]));
    shown.iter().for_each(|peak| names.take(place(peak), 2.0 * RADIUS));
    for peak in shown {
        let (at, ring) = (place(peak), Paint::line(INK, 1.2));
        canvas.circle(Paint::line(WHITE, 3.0).faint(0.85), at, RADIUS);
        canvas.circle(if peak.is_believed { ring } else { ring.dashed() }, at, RADIUS);
        let against = if peak.is_believed { "" } else { ", not to be believed" };
        let text = format!("{}{}{against}", number_text(peak.von_mises), unit.after());
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
        let peak = |k: usize| DrawnPeak {
            place: [0.1 + 0.2 * k as f64, 0.5],
            displacement: [0.0, 1e-3],
            von_mises: 10.0 * k as f64,
            is_believed: k != 2,
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
        let many = drawn(9);
        assert_eq!((many.matches("<circle").count(), many.matches(">80 MPa<").count()), (2, 2), "{many}");
    }
}
