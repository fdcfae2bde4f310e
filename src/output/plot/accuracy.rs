//! Errors that were asked for, and how they fell from mesh to mesh.

use std::path::Path;

use plotters::element::{DashedPathElement, PathElement};

use super::diagrams::{Axis, LegendRow, Mark, ROW, TITLE, colour, draw_legend, draw_line};
use super::sheet::{PIXEL, Sheet, line};
use super::ticks::number_text;
use crate::output::error::OutputError;

/// The estimated error of one goal on every mesh where it is known.
#[derive(Clone, Debug, PartialEq)]
pub struct Sequence {
    /// Of what.
    pub name: String,
    /// The largest error that was asked for.
    pub asked: f64,
    /// Unknowns and estimated error, mesh by mesh.
    pub estimates: Vec<(f64, f64)>,
    /// Unknowns and true error, on the meshes where it is known.
    pub errors: Vec<(f64, f64)>,
}

/// Size of the figure without its legend (pixels).
const WIDTH: i32 = 820;
const HEIGHT: i32 = 460;
/// Distances of the plot from the left, right and bottom of the figure, and from the legend (pixels).
const MARGINS: [i32; 4] = [68, 24, 54, 14];
/// Lengths of the dashes of a true error, and of what is between them.
const DASH: i32 = 6 * PIXEL;
const GAP: i32 = 4 * PIXEL;
/// The order is that of so many meshes.
const LAST: usize = 3;
/// On meshes of the same size, up to rounding, there is no order.
const LEAST_SPREAD: f64 = 1e-9;

impl Sequence {
    /// Estimates that a logarithmic diagram can show.
    fn shown(&self) -> impl Iterator<Item = (f64, f64)> {
        shown(&self.estimates)
    }

    /// The exponent p of error ~ N^-p on the last three meshes, by least squares; None on fewer, or if N is the same on all.
    pub fn order(&self) -> Option<f64> {
        let all: Vec<(f64, f64)> = self.shown().map(|(n, error)| (n.ln(), error.ln())).collect();
        let last = &all[all.len().checked_sub(LAST)?..];
        let mean = |value: fn(&(f64, f64)) -> f64| last.iter().map(value).sum::<f64>() / LAST as f64;
        let (x, y) = (mean(|point| point.0), mean(|point| point.1));
        let spread: f64 = last.iter().map(|point| (point.0 - x).powi(2)).sum();
        let fall: f64 = last.iter().map(|point| (point.0 - x) * (y - point.1)).sum();
        (spread > LEAST_SPREAD).then(|| fall / spread)
    }

    /// Its row of the legend.
    fn entry(&self, style: usize) -> LegendRow {
        let order = match self.order() {
            Some(order) => format!("error ~ N^{:.2} on the last {LAST} meshes", -order).replace("^-", "^−"),
            None => "too few meshes for an order".into(),
        };
        LegendRow { style, cells: vec![self.name.clone(), format!("asked {}", number_text(self.asked)), order] }
    }
}

/// Points that a logarithmic diagram can show.
fn shown(points: &[(f64, f64)]) -> impl Iterator<Item = (f64, f64)> {
    points.iter().copied().filter(|(n, error)| [*n, *error].iter().all(|value| value.is_finite() && *value > 0.0))
}

/// Draws `accuracy.svg`: the estimated error of every goal against unknowns, on logarithmic axes, with a thin line at what was
/// asked for, and a dashed one through the true errors where they are known.
///
/// # Errors
/// No error is known on any mesh; the operating system refuses.
pub fn write_accuracy(path: &Path, title: &str, goals: &[Sequence]) -> Result<(), OutputError> {
    if goals.iter().all(|goal| goal.shown().next().is_none()) {
        return Err(OutputError::Figure { path: path.into(), reason: "no error is known on any mesh".into() });
    }
    let axis = |name: &str| Axis { name: name.into(), logarithmic: true };
    let points = || goals.iter().flat_map(|goal| goal.shown().chain(shown(&goal.errors)));
    let known = goals.iter().any(|goal| shown(&goal.errors).next().is_some());
    let x = axis("unknowns N").spec(points().map(|(n, _)| n));
    let y = axis(if known { "relative error: estimated, and true (dashed)" } else { "estimated relative error" })
        .spec(points().map(|(_, error)| error).chain(goals.iter().map(|goal| goal.asked)));
    let top = TITLE + ROW * goals.len() as i32 + MARGINS[3];
    let margins = [MARGINS[0], MARGINS[1], top, MARGINS[2]];
    let sheet = Sheet { width: WIDTH, height: HEIGHT + ROW * goals.len() as i32, margins }.with_room_for(&y);
    sheet.write(path, |sheet, area| {
        sheet.draw_title(area, title)?;
        let legend: Vec<LegendRow> = goals.iter().enumerate().map(|(style, goal)| goal.entry(style)).collect();
        draw_legend(area, f64::from(WIDTH), &legend)?;
        let mut chart = sheet.draw_axes(area, &x, &y, true)?;
        for (style, goal) in goals.iter().enumerate() {
            let asked = x.range.map(|n| (n, goal.asked)).to_vec();
            chart.draw_series([PathElement::new(asked, line(&colour(style), 0.7))])?;
        }
        for (style, goal) in goals.iter().enumerate() {
            let marks: Vec<Mark> = goal.shown().map(|(x, y)| Mark { x, y, reach: [y, y], hollow: y > goal.asked }).collect();
            draw_line(area, &mut chart, style, &marks)?;
            let truth: Vec<(f64, f64)> = shown(&goal.errors).collect();
            chart.draw_series([DashedPathElement::new(truth, DASH, GAP, line(&colour(style), 1.2))])?;
        }
        sheet.draw_frame(area)?;
        Ok(String::new())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Meshes whose errors fall as N^-order, after a first one that is off that law.
    fn sequence(name: &str, order: f64) -> Sequence {
        let points = [600.0, 2_000.0, 7_000.0, 30_000.0].map(|n: f64| (n, 3.0 * n.powf(-order)));
        let mut sequence = Sequence { name: name.into(), asked: 1e-3, estimates: points.into(), errors: Vec::new() };
        sequence.estimates[0].1 *= 40.0;
        sequence
    }

    fn draw(goals: &[Sequence]) -> Result<String, OutputError> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("accuracy.svg");
        write_accuracy(&path, "bars", goals).map(|()| std::fs::read_to_string(path).unwrap())
    }

    #[test]
    fn the_order_is_that_of_the_last_three_meshes() {
        for order in [0.42, 1.0, 2.5] {
            let mut sequence = sequence("energy", order);
            assert!((sequence.order().unwrap() - order).abs() < 1e-12);
            sequence.estimates.push((1e5, f64::NAN));
            assert!((sequence.order().unwrap() - order).abs() < 1e-12, "what is unknown does not count");
        }
        let mut short = sequence("energy", 1.0);
        short.estimates.truncate(2);
        assert_eq!(short.order(), None);
        short.estimates = vec![(600.0, 1e-2); 3];
        assert_eq!(short.order(), None, "one mesh thrice");
    }

    #[test]
    fn every_goal_has_its_line_and_its_row() {
        let text = draw(&[sequence("energy", 0.95), sequence("pressure of seam", 1.2)]).unwrap();
        for words in ["energy", "pressure of seam", "asked 0.001", "error ~ N^−0.95", "error ~ N^−1.20", "unknowns N"] {
            assert!(text.contains(words), "{words}");
        }
        assert!(!text.contains("NaN") && text.ends_with("</svg>\n"));
        let thin = text.lines().filter(|line| line.contains("polyline") && line.contains("stroke-width=\"7\"")).count();
        assert_eq!(thin, 2, "a line for each asked value");
    }

    #[test]
    fn true_errors_are_a_second_line() {
        let lines = |goal: &Sequence| draw(std::slice::from_ref(goal)).unwrap();
        let mut goal = sequence("energy", 1.0);
        let without = lines(&goal);
        goal.errors = vec![(2_000.0, 1e-4), (30_000.0, 1e-6), (40_000.0, 0.0)];
        let with = lines(&goal);
        assert!(with.contains("true (dashed)") && !without.contains("true (dashed)"));
        assert!(with.matches("polyline").count() > without.matches("polyline").count() + 10, "dashes");
    }

    #[test]
    fn few_points_are_a_figure_and_none_are_not() {
        let mut goals = [sequence("energy", 1.0), sequence("force of seam", 1.0)];
        goals[0].estimates.truncate(1);
        goals[1].estimates.clear();
        assert!(draw(&goals).unwrap().contains("too few meshes for an order"));
        goals[0].estimates[0].1 = 0.0;
        assert!(matches!(draw(&goals), Err(OutputError::Figure { .. })));
        assert!(matches!(draw(&[]), Err(OutputError::Figure { .. })));
    }
}
