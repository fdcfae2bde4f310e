//! Quantities along the contact boundary.

use std::path::Path;

use plotters::element::PathElement;
use plotters::style::{Color, ShapeStyle};

use super::palette::{BLUE, GREEN, GREY, VERMILION};
use super::sheet::{AxisSpec, Chart, DrawResult, Sheet, line};
use super::ticks::{cut_off, number_text};
use crate::output::csv::ContactPoint;
use crate::output::error::OutputError;

const SHEET: Sheet = Sheet { width: 820, height: 460, margins: [68, 24, 62, 54] };

/// Columns of a figure within which at most four points of a curve are drawn.
const COLUMNS: f64 = 1500.0;
/// A curve with more jumps is drawn without breaks.
const MOST_JUMPS: usize = 1500;

/// A quantity of the contact boundary and how it is drawn; in a list, the first is drawn on top.
struct DrawnCurve {
    name: String,
    style: ShapeStyle,
    value: fn(&ContactPoint) -> f64,
}

/// A contact boundary as figures show it.
#[derive(Clone, Copy, Debug)]
pub struct DrawnContact<'a> {
    /// Stands above.
    pub title: &'a str,
    /// Names of body 1 and body 2.
    pub bodies: [&'a str; 2],
    /// In order of arc length.
    pub points: &'a [ContactPoint],
    /// Whether they lie on the deformed bodies.
    pub is_deformed: bool,
}

/// Draws `pressure_NAME.svg`: λ and the normal pressures -σ of both bodies along the contact boundary.
///
/// Compression points up. Where a quantity jumps, its line ends and a faint one leads to the next value.
/// A peak far above the rest, as at the corner of a punch, is cut off and named in a remark.
///
/// # Errors
/// No point has a finite pressure; the operating system refuses.
pub fn write_pressure(path: &Path, contact: &DrawnContact) -> Result<(), OutputError> {
    let [one, two] = contact.bodies;
    let curves = [
        DrawnCurve { name: "contact pressure λ".into(), style: line(&BLUE, 2.0), value: |p| p.lambda },
        DrawnCurve { name: format!("−σ of {one}"), style: line(&VERMILION, 1.1), value: |p| -p.sigma_1 },
        DrawnCurve { name: format!("−σ of {two}"), style: line(&GREEN, 1.1), value: |p| -p.sigma_2 },
    ];
    let mut range = finite_range(path, contact.points, &curves)?;
    range = [range[0].min(0.0), range[1].max(0.0)];
    let (shown, remark) = cut_peaks(range, contact.points, &curves);
    let quantity = DrawnQuantity { name: "pressure", unit: "stress" };
    write_curves(path, contact, &curves, shown, &quantity, remark.as_deref())
}

/// Draws `gap_NAME.svg`: the gap of the deformed bodies along the contact boundary.
///
/// # Errors
/// No point has a finite gap; the operating system refuses.
pub fn write_gap(path: &Path, contact: &DrawnContact) -> Result<(), OutputError> {
    let [one, two] = contact.bodies;
    let name = format!("gap from {one} to {two}, deformed");
    let curves = [DrawnCurve { name, style: line(&BLUE, 1.6), value: |p| p.gap }];
    let [low, high] = finite_range(path, contact.points, &curves)?;
    let quantity = DrawnQuantity { name: "gap", unit: "length" };
    write_curves(path, contact, &curves, [low.min(0.0), high.max(0.0)], &quantity, None)
}

/// Draws `displacement_NAME.svg`: the normal displacements n · u of both bodies along the contact boundary.
///
/// # Errors
/// No point has a finite displacement; the operating system refuses.
pub fn write_displacement(path: &Path, contact: &DrawnContact) -> Result<(), OutputError> {
    let [one, two] = contact.bodies;
    let curves = [
        DrawnCurve { name: format!("n·u of {one}"), style: line(&VERMILION, 1.1), value: |p| p.un_1 },
        DrawnCurve { name: format!("n·u of {two}"), style: line(&GREEN, 2.6), value: |p| p.un_2 },
    ];
    let range = finite_range(path, contact.points, &curves)?;
    let quantity = DrawnQuantity { name: "normal displacement", unit: "length" };
    write_curves(path, contact, &curves, range, &quantity, None)
}

/// What the vertical axis shows.
struct DrawnQuantity {
    name: &'static str,
    unit: &'static str,
}

fn write_curves(
    path: &Path,
    DrawnContact { title, points, .. }: &DrawnContact,
    curves: &[DrawnCurve],
    range: [f64; 2],
    quantity: &DrawnQuantity,
    remark: Option<&str>,
) -> Result<(), OutputError> {
    let ends = [points[0].s, points[points.len() - 1].s];
    let x = AxisSpec::linear(widened(ends, 0.0), 8, "arc length s along the contact boundary", "length");
    let y = AxisSpec::linear(widened(range, 0.05), 6, quantity.name, quantity.unit);
    SHEET.with_room_for(&y).write(path, |sheet, area| {
        sheet.draw_title(area, title)?;
        let legend: Vec<_> = curves.iter().map(|curve| (curve.name.as_str(), std::slice::from_ref(&curve.style))).collect();
        sheet.draw_legend(area, &legend)?;
        if let Some(remark) = remark {
            sheet.draw_remark(area, remark)?;
        }
        let mut chart = sheet.draw_axes(area, &x, &y, true)?;
        if y.range[0] < 0.0 && y.range[1] > 0.0 {
            let zero = vec![(x.range[0], 0.0), (x.range[1], 0.0)];
            chart.draw_series([PathElement::new(zero, line(&GREY, 0.8))])?;
        }
        for curve in curves.iter().rev() {
            draw_curve(&mut chart, points, curve)?;
        }
        Ok(String::new())
    })
}

/// Draws one quantity, broken where it jumps or is not a number. More jumps than can be told apart are no breaks, and of many
/// points those stay that can be seen.
fn draw_curve(chart: &mut Chart, points: &[ContactPoint], curve: &DrawnCurve) -> DrawResult<()> {
    let places: Vec<(f64, f64)> = points.iter().map(|p| (p.s, (curve.value)(p))).collect();
    let faint = ShapeStyle { color: curve.style.color.mix(0.45), stroke_width: 6, ..curve.style };
    let is_jump = |a: &(f64, f64), b: &(f64, f64)| a.0 >= b.0 && a.1 != b.1;
    let jumps: Vec<&[(f64, f64)]> = places.windows(2).filter(|pair| is_jump(&pair[0], &pair[1])).collect();
    let breaks = jumps.len() <= MOST_JUMPS;
    let continuous = |a: &(f64, f64), b: &(f64, f64)| !(breaks && is_jump(a, b)) && a.1.is_finite() == b.1.is_finite();
    let shown = jumps.iter().filter(|pair| breaks && pair.iter().all(|place| place.1.is_finite()));
    chart.draw_series(shown.map(|pair| PathElement::new(pair.to_vec(), faint)))?;
    let runs = places.chunk_by(continuous).filter(|run| run[0].1.is_finite());
    let column = (places[places.len() - 1].0 - places[0].0) / COLUMNS;
    chart.draw_series(runs.map(|run| PathElement::new(thinned(run, column), curve.style)))?;
    Ok(())
}

/// Of the points in each column of a figure the first, the lowest, the highest and the last, in their order.
fn thinned(run: &[(f64, f64)], column: f64) -> Vec<(f64, f64)> {
    let number = |point: &(f64, f64)| ((point.0 - run[0].0) / column).floor();
    let of_column = |points: &[(f64, f64)]| {
        let order = |a: &usize, b: &usize| points[*a].1.total_cmp(&points[*b].1);
        let (lowest, highest) = ((0..points.len()).min_by(order), (0..points.len()).max_by(order));
        let mut kept: Vec<usize> = [0, points.len() - 1].into_iter().chain(lowest).chain(highest).collect();
        kept.sort_unstable();
        kept.dedup();
        kept.into_iter().map(|at| points[at]).collect::<Vec<_>>()
    };
    if run.len() <= 4 { run.to_vec() } else { run.chunk_by(|a, b| number(a) == number(b)).flat_map(of_column).collect() }
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

    fn draw(write: fn(&Path, &DrawnContact) -> Result<(), OutputError>, points: &[ContactPoint]) -> Result<String, OutputError> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("figure.svg");
        let contact =
            DrawnContact { title: "bars\u{1} <1 & 2>\u{1b}[0m", bodies: ["<lower>", "upper"], points, is_deformed: false };
        write(&path, &contact).map(|()| std::fs::read_to_string(path).unwrap())
    }

    #[test]
    fn jumps_break_the_line() {
        let figure = draw(write_pressure, &stepped(2.0)).unwrap();
        let blue: Vec<&str> = figure.lines().filter(|line| line.contains("polyline") && line.contains("#0072B2")).collect();
        let faint = blue.iter().filter(|line| line.contains("opacity")).count();
        assert_eq!((blue.len(), faint), (4, 1), "the legend, one jump, two runs: {blue:#?}");
        assert!(figure.contains("bars &lt;1 &amp; 2&gt;[0m") && figure.ends_with("</svg>\n"));
        assert!(!figure.contains(['\u{1}', '\u{1b}']), "what XML cannot hold is left out");
        assert!(!figure.contains("peaks"));
        assert!(figure.contains("−σ of &lt;lower&gt;") && figure.contains("−σ of upper"));
    }

    #[test]
    fn long_labels_of_ticks_have_room_beside_the_name_of_the_axis() {
        let mut points = stepped(2.0);
        points.iter_mut().for_each(|point| (point.un_1, point.un_2) = (-0.0152 - 0.0001 * point.s, -0.0151));
        let figure = draw(write_displacement, &points).unwrap();
        let lines: Vec<&str> = figure.lines().collect();
        let labels = lines.windows(2).filter(|pair| pair[1].starts_with("−0.01") && pair[0].contains("text-anchor=\"end\""));
        let lefts: Vec<f64> = labels
            .map(|pair| {
                let right: f64 = pair[0].split(" x=\"").nth(1).unwrap().split('"').next().unwrap().parse().unwrap();
                right / 10.0 - crate::output::plot::sheet::text_width(pair[1], 11.0)
            })
            .collect();
        // The name of the axis stands at 10 pixels, upright, in letters of 12.
        assert!(lefts.len() > 3 && lefts.iter().all(|left| *left > 10.0 + 14.0), "{lefts:?}");
    }

    #[test]
    fn a_fine_boundary_makes_no_large_figure() {
        let at = |k: usize| ContactPoint { s: k as f64 / 2.0, lambda: (k as f64 * 0.7).sin(), ..ContactPoint::default() };
        let points: Vec<ContactPoint> = (0..200_000).map(at).collect();
        let jumping: Vec<ContactPoint> = (0..200_000).map(|k| ContactPoint { s: (k / 2) as f64, ..at(k) }).collect();
        for points in [points, jumping] {
            let figure = draw(write_pressure, &points).unwrap();
            assert!(figure.len() < 300_000, "{} bytes", figure.len());
        }
        let run: Vec<(f64, f64)> = [(0.0, 1.0), (0.1, 5.0), (0.2, -3.0), (0.3, 0.0), (0.4, 2.0), (1.5, 7.0)].into();
        assert_eq!(thinned(&run, 1.0), [(0.0, 1.0), (0.1, 5.0), (0.2, -3.0), (0.4, 2.0), (1.5, 7.0)]);
    }

    #[test]
    fn peaks_are_named_when_cut_off() {
        assert!(draw(write_pressure, &stepped(40.0)).unwrap().contains("peaks cut off; full range 0 … 40"));
    }

    #[test]
    fn what_is_not_a_number_is_left_out() {
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
