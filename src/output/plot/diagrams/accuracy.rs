//! Errors that were asked for, and how they fell from mesh to mesh.

use std::path::Path;

use super::diagram::{Diagram, DiagramLine, LineKind, Mark};
use crate::output::error::OutputError;
use crate::output::plot::drawing::{Axis, Canvas, LegendCell, head_height, number_text};

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

/// Width of the figure, its height without its legend, and what is to the right of the plot (pixels).
const SIZE: [f64; 2] = [820.0, 460.0];
const RIGHT: f64 = 24.0;
/// The order is that of so many meshes.
const LAST: usize = 3;
/// On meshes of the same size, up to rounding, there is no order.
const LEAST_SPREAD: f64 = 1e-9;

impl Sequence {
    /// The exponent p of error ~ N^-p on the last three meshes, by least squares; None on fewer, or if N is the same on all.
    pub fn order(&self) -> Option<f64> {
        let all: Vec<(f64, f64)> = shown(&self.estimates).map(|(n, error)| (n.ln(), error.ln())).collect();
        let last = &all[all.len().checked_sub(LAST)?..];
        let mean = |value: fn(&(f64, f64)) -> f64| last.iter().map(value).sum::<f64>() / LAST as f64;
        let (x, y) = (mean(|point| point.0), mean(|point| point.1));
        let spread: f64 = last.iter().map(|point| (point.0 - x).powi(2)).sum();
        let fall: f64 = last.iter().map(|point| (point.0 - x) * (y - point.1)).sum();
        (spread > LEAST_SPREAD).then(|| fall / spread)
    }

    /// Its row of the legend.
    fn entry(&self, style: usize) -> Vec<LegendCell> {
        let order = match self.order() {
            Some(order) => format!("error ~ N^{:.2} on the last {LAST} meshes", -order).replace("^-", "^−"),
            None => "too few meshes for an order".into(),
        };
        let line = |words: String, kind: LineKind| LegendCell::lines(words, &[kind.paint(style)]);
        let mut row = vec![
            LegendCell::marked(self.name.as_str(), style),
            LegendCell::words(order),
            line(format!("asked {}", number_text(self.asked)), LineKind::Level),
        ];
        row.extend(shown(&self.errors).next().map(|_| line("true error".into(), LineKind::Dashed)));
        row
    }

    /// What was asked for, true errors and estimates as lines of a diagram. Estimates above what was asked for are hollow.
    fn lines(&self, style: usize) -> [DiagramLine; 3] {
        let asked =
            shown(&self.estimates).chain(shown(&self.errors)).map(|(n, _)| Mark::at(n, self.asked, false)).take(1).collect();
        let errors = shown(&self.errors).map(|(n, error)| Mark::at(n, error, false)).collect();
        let estimates = shown(&self.estimates).map(|(n, error)| Mark::at(n, error, error > self.asked)).collect();
        let line = |(kind, marks)| DiagramLine { name: self.name.clone(), style, kind, marks };
        [(LineKind::Level, asked), (LineKind::Dashed, errors), (LineKind::Marked, estimates)].map(line)
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
    if goals.iter().all(|goal| shown(&goal.estimates).next().is_none()) {
        return Err(OutputError::Figure { path: path.into(), reason: "no error is known on any mesh".into() });
    }
    let known = goals.iter().any(|goal| shown(&goal.errors).next().is_some());
    let y = if known { "relative error: estimated, and true (dashed)" } else { "estimated relative error" };
    let diagram = Diagram {
        x: Axis::logarithmic("unknowns N"),
        y: Axis::logarithmic(y),
        lines: goals.iter().enumerate().flat_map(|(style, goal)| goal.lines(style)).collect(),
        ..Diagram::default()
    };
    let legend: Vec<_> = goals.iter().enumerate().map(|(style, goal)| goal.entry(style)).collect();
    let above = head_height(goals.len());
    let mut canvas = Canvas::new([SIZE[0], SIZE[1] + above - head_height(1)]);
    let chart = diagram.chart(canvas.frame(), [above, RIGHT]);
    chart.draw_head(&mut canvas, title, &legend);
    diagram.draw(&mut canvas, &chart);
    canvas.write(path)
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
        assert_eq!(text.matches("<title>").count(), 8, "a value under the pointer for each mesh and goal");
        let thin = text.lines().filter(|line| line.contains("<path") && line.contains("stroke-width=\"7\"")).count();
        assert_eq!(thin, 2 * 2, "a line for each asked value, and its sample");
    }

    #[test]
    fn true_errors_are_a_second_line() {
        let lines = |goal: &Sequence| draw(std::slice::from_ref(goal)).unwrap();
        let mut goal = sequence("energy", 1.0);
        let without = lines(&goal);
        goal.errors = vec![(2_000.0, 1e-4), (30_000.0, 1e-6), (40_000.0, 0.0)];
        let with = lines(&goal);
        assert!(with.contains("true (dashed)") && !without.contains("true (dashed)"));
        let dashes = [with, without].map(|text| text.matches("stroke-dasharray").count());
        assert_eq!(dashes, [2, 0], "the line, and its sample");
    }

    #[test]
    fn meshes_of_nearly_one_size_have_an_axis_with_numbers() {
        let mut goal = sequence("energy", 1.0);
        goal.estimates = [(6.1e3, 1e-2), (6.9e3, 9e-3)].into();
        let text = draw(&[goal]).unwrap();
        let numbers = text.lines().filter(|line| line.contains("text-anchor=\"middle\"") && line.contains("00</text>"));
        assert!(numbers.count() > 2, "{text}");
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
