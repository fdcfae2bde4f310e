//! Quantities along the contact boundary.

use std::path::Path;

use plotters::element::PathElement;
use plotters::style::{Color, ShapeStyle};

use super::palette::{BLUE, GREEN, GREY, VERMILION};
use super::sheet::{AxisSpec, Chart, DrawResult, Scale, Sheet, line};
use super::ticks::{Ticks, cut_off, number_text};
use crate::output::{ContactPoint, OutputError};

const SHEET: Sheet = Sheet { width: 820, height: 460, margins: [68, 24, 62, 54] };

/// A quantity of the contact boundary and how it is drawn; in a list, the first is drawn on top.
struct DrawnCurve {
    name: &'static str,
    style: ShapeStyle,
    value: fn(&ContactPoint) -> f64,
}

/// Draws `pressure_NAME.svg`: λ and the normal pressures -σ₁, -σ₂ of both bodies along the contact boundary.
///
/// Compression points up. Where a quantity jumps, its line ends and a faint one leads to the next value.
/// A peak far above the rest, as at the corner of a punch, is cut off and named in a remark.
///
/// # Errors
/// No point has a finite pressure; the operating system refuses.
pub fn write_pressure(path: &Path, title: &str, points: &[ContactPoint]) -> Result<(), OutputError> {
    let curves = [
        DrawnCurve { name: "contact pressure λ", style: line(&BLUE, 2.0), value: |p| p.lambda },
        DrawnCurve { name: "−σ₁ of body 1", style: line(&VERMILION, 1.1), value: |p| -p.sigma_1 },
        DrawnCurve { name: "−σ₂ of body 2", style: line(&GREEN, 1.1), value: |p| -p.sigma_2 },
    ];
    let mut range = finite_range(path, points, &curves)?;
    range = [range[0].min(0.0), range[1].max(0.0)];
    let (shown, remark) = cut_peaks(range, points, &curves);
    let quantity = DrawnQuantity { name: "pressure", unit: "stress" };
    write_curves(path, title, points, &curves, shown, &quantity, remark.as_deref())
}

/// Draws `displacement_NAME.svg`: the normal displacements n · u of both bodies along the contact boundary.
///
/// # Errors
/// No point has a finite displacement; the operating system refuses.
pub fn write_displacement(path: &Path, title: &str, points: &[ContactPoint]) -> Result<(), OutputError> {
    let curves = [
        DrawnCurve { name: "n·u of body 1", style: line(&VERMILION, 1.1), value: |p| p.un_1 },
        DrawnCurve { name: "n·u of body 2", style: line(&GREEN, 2.6), value: |p| p.un_2 },
    ];
    let range = finite_range(path, points, &curves)?;
    let quantity = DrawnQuantity { name: "normal displacement", unit: "length" };
    write_curves(path, title, points, &curves, range, &quantity, None)
}

/// What the vertical axis shows.
struct DrawnQuantity {
    name: &'static str,
    unit: &'static str,
}

fn write_curves(
    path: &Path,
    title: &str,
    points: &[ContactPoint],
    curves: &[DrawnCurve],
    range: [f64; 2],
    quantity: &DrawnQuantity,
    remark: Option<&str>,
) -> Result<(), OutputError> {
    let ends = [points[0].s, points[points.len() - 1].s];
    let x_ticks = Ticks::new(widened(ends, 0.0), 8);
    let x_name = format!("arc length s along the contact boundary [{}]", x_ticks.unit("length"));
    let x = AxisSpec { scale: Scale::Linear, range: widened(ends, 0.0), ticks: x_ticks, name: x_name };
    let y_range = widened(range, 0.05);
    let y_ticks = Ticks::new(y_range, 6);
    let y_name = format!("{} [{}]", quantity.name, y_ticks.unit(quantity.unit));
    let y = AxisSpec { scale: Scale::Linear, range: y_range, ticks: y_ticks, name: y_name };

    SHEET.write(path, |sheet, area| {
        sheet.draw_title(area, title)?;
        let legend: Vec<_> = curves.iter().map(|curve| (curve.name, std::slice::from_ref(&curve.style))).collect();
        sheet.draw_legend(area, &legend)?;
        if let Some(remark) = remark {
            sheet.draw_remark(area, remark)?;
        }
        let mut chart = sheet.draw_axes(area, &x, &y, true)?;
        if y_range[0] < 0.0 && y_range[1] > 0.0 {
            let zero = vec![(x.range[0], 0.0), (x.range[1], 0.0)];
            chart.draw_series([PathElement::new(zero, line(&GREY, 0.8))])?;
        }
        for curve in curves.iter().rev() {
            draw_curve(&mut chart, points, curve)?;
        }
        Ok(String::new())
    })
}

/// Draws one quantity, broken where it jumps or is not a number.
fn draw_curve(chart: &mut Chart, points: &[ContactPoint], curve: &DrawnCurve) -> DrawResult<()> {
    let places: Vec<(f64, f64)> = points.iter().map(|p| (p.s, (curve.value)(p))).collect();
    let faint = ShapeStyle { color: curve.style.color.mix(0.45), stroke_width: 6, ..curve.style };
    let continuous = |a: &(f64, f64), b: &(f64, f64)| a.0 < b.0 && a.1.is_finite() == b.1.is_finite();
    let jumps = places.windows(2).filter(|pair| pair[0].0 >= pair[1].0 && pair[0].1 != pair[1].1);
    chart.draw_series(
        jumps.filter(|pair| pair.iter().all(|place| place.1.is_finite())).map(|pair| PathElement::new(pair.to_vec(), faint)),
    )?;
    let runs = places.chunk_by(continuous).filter(|run| run[0].1.is_finite());
    chart.draw_series(runs.map(|run| PathElement::new(run.to_vec(), curve.style)))?;
    Ok(())
}

/// Smallest and largest finite value of all curves.
fn finite_range(path: &Path, points: &[ContactPoint], curves: &[DrawnCurve]) -> Result<[f64; 2], OutputError> {
    let values = curves.iter().flat_map(|curve| points.iter().map(curve.value)).filter(|value| value.is_finite());
    let range = values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(value), high.max(value)]);
    if range[0] > range[1] {
        return Err(OutputError::Figure { path: path.into(), reason: "no point has a finite value".into() });
    }
    Ok(range)
}

/// Cuts peaks that would squeeze the rest: the range shown, and a remark if it was cut.
fn cut_peaks([low, high]: [f64; 2], points: &[ContactPoint], curves: &[DrawnCurve]) -> ([f64; 2], Option<String>) {
    let pieces: Vec<(f64, f64)> = curves
        .iter()
        .flat_map(|curve| points.windows(2).map(|pair| ((curve.value)(&pair[0]), pair[1].s - pair[0].s)))
        .filter(|(value, _)| value.is_finite())
        .collect();
    let top = cut_off(high, pieces).unwrap_or(high);
    let bottom = low.max(-0.5 * top);
    if top <= 0.0 || (bottom, top) == (low, high) {
        return ([low, high], None);
    }
    let remark = format!("peaks cut off; full range {} … {}", number_text(low), number_text(high));
    ([bottom, top], Some(remark))
}

/// A range with some room on both sides; a single value becomes a range around it.
fn widened([low, high]: [f64; 2], fraction: f64) -> [f64; 2] {
    let size = high - low;
    let room = if size > 1e-12 * low.abs().max(high.abs()) { fraction * size } else { low.abs().max(high.abs()).max(1e-12) };
    [low - room, high + room]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A pressure that steps from 1 to 2 at s = 1, and beyond s = 1.99 to `peak`.
    fn stepped(peak: f64) -> Vec<ContactPoint> {
        let values = [(0.0, 1.0), (1.0, 1.0), (1.0, 2.0), (1.99, 2.0), (1.99, peak), (2.0, peak)];
        let point = |(s, lambda)| ContactPoint {
            s,
            x: s,
            ny: 1.0,
            lambda,
            sigma_1: -lambda,
            sigma_2: -lambda,
            ..ContactPoint::default()
        };
        values.into_iter().map(point).collect()
    }

    fn draw(
        write: fn(&Path, &str, &[ContactPoint]) -> Result<(), OutputError>,
        points: &[ContactPoint],
    ) -> Result<String, OutputError> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("figure.svg");
        write(&path, "bars\u{1} <1 & 2>\u{1b}[0m", points).map(|()| std::fs::read_to_string(path).unwrap())
    }

    #[test]
    fn jumps_break_the_line() {
        let figure = draw(write_pressure, &stepped(2.0)).unwrap();
        let blue: Vec<&str> = figure.lines().filter(|line| line.contains("polyline") && line.contains("#0072B2")).collect();
        let faint = blue.iter().filter(|line| line.contains("opacity")).count();
        assert_eq!((blue.len(), faint), (5, 1), "the legend, one jump, three runs: {blue:#?}");
        assert!(figure.contains("bars &lt;1 &amp; 2&gt;[0m") && figure.ends_with("</svg>\n"));
        assert!(!figure.contains(['\u{1}', '\u{1b}']), "what XML cannot hold is left out");
        assert!(!figure.contains("peaks"));
    }

    #[test]
    fn peaks_are_named_when_cut_off() {
        assert!(draw(write_pressure, &stepped(40.0)).unwrap().contains("peaks cut off; full range 0 … 40"));
    }

    #[test]
    fn gaps_in_the_numbers_are_left_out() {
        let mut points = stepped(2.0);
        points[1].un_1 = f64::NAN;
        assert!(!draw(write_displacement, &points).unwrap().contains("NaN"));
        for point in &mut points {
            (point.un_1, point.un_2) = (f64::NAN, f64::INFINITY);
        }
        assert!(matches!(draw(write_displacement, &points), Err(OutputError::Figure { .. })));
        assert!(matches!(draw(write_displacement, &[]), Err(OutputError::Figure { .. })));
    }
}
