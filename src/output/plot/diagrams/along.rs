//! Quantities along the contact boundary.

use std::path::Path;

use crate::output::error::OutputError;
use crate::output::plot::drawing::*;
use crate::output::units::{Unit, Units};
use crate::recovery::TracePoint;

/// Width and height of a figure, and what is to the right of the plot (pixels).
const SIZE: [f64; 2] = [820.0, 460.0];
const RIGHT: f64 = 24.0;
/// Columns of a figure within which at most four points of a curve are drawn.
const COLUMNS: f64 = 1500.0;
/// A curve with more jumps is drawn without breaks.
const MOST_JUMPS: usize = 1500;

/// A contact boundary as figures show it.
#[derive(Clone, Copy, Debug)]
pub struct DrawnContact<'a> {
    /// Stands above.
    pub title: &'a str,
    /// Names of body 1 and body 2.
    pub bodies: [&'a str; 2],
    /// In order of arc length.
    pub points: &'a [TracePoint],
    /// Whether they lie on the deformed bodies.
    pub is_deformed: bool,
    /// The units of the case.
    pub units: &'a Units,
}

/// What a figure shows of a contact boundary.
struct AlongFigure<'a> {
    /// The figure is called so, and the contact.
    file: &'static str,
    /// What the vertical axis shows, and its unit.
    quantity: (&'static str, Unit<'a>),
    /// Whether zero is shown in any case.
    has_zero: bool,
    /// Whether peaks that would squeeze the rest are cut off.
    cuts_peaks: bool,
    /// The first is drawn on top.
    curves: Vec<DrawnCurve>,
}

/// A quantity of the contact boundary and how it is drawn.
struct DrawnCurve {
    name: String,
    colour: Colour,
    width: f64,
    value: fn(&TracePoint) -> f64,
}

/// Draws what happens along the contact boundary of a contact: `pressure_NAME.svg` has λ and the normal pressures -σ of both
/// bodies, `gap_NAME.svg` the gap of the deformed bodies, `displacement_NAME.svg` the normal displacements n · u of both bodies.
///
/// Compression points up. Where a quantity jumps, its line ends and a faint one leads to the next value.
/// A peak of pressure far above the rest, as at the corner of a punch, is cut off and named in a remark.
///
/// # Errors
/// No point has a finite value of one of them; the operating system refuses.
pub fn write_along(folder: &Path, name: &str, contact: &DrawnContact) -> [Result<(), OutputError>; 3] {
    let write = |figure: AlongFigure| figure.write(&folder.join(format!("{}_{name}.svg", figure.file)), contact);
    figures(contact.bodies, contact.units).map(write)
}

/// The figures of a contact between two bodies.
fn figures<'a>([one, two]: [&str; 2], units: &'a Units) -> [AlongFigure<'a>; 3] {
    let pressures = vec![
        DrawnCurve { name: "contact pressure λ".into(), colour: BLUE, width: 2.0, value: |p| p.lambda },
        DrawnCurve { name: format!("−σ of {one}"), colour: VERMILION, width: 1.1, value: |p| -p.stress[0] },
        DrawnCurve { name: format!("−σ of {two}"), colour: GREEN, width: 1.1, value: |p| -p.stress[1] },
    ];
    let gap = format!("gap from {one} to {two}, deformed");
    let displacements = vec![
        DrawnCurve { name: format!("n·u of {one}"), colour: VERMILION, width: 1.1, value: |p| p.displacement[0] },
        DrawnCurve { name: format!("n·u of {two}"), colour: GREEN, width: 2.6, value: |p| p.displacement[1] },
    ];
    let figure = |file, quantity, has_zero, curves| AlongFigure { file, quantity, has_zero, cuts_peaks: false, curves };
    [
        AlongFigure { cuts_peaks: true, ..figure("pressure", ("pressure", units.stress()), true, pressures) },
        figure("gap", ("gap", units.length()), true, vec![DrawnCurve { name: gap, colour: BLUE, width: 1.6, value: |p| p.gap }]),
        figure("displacement", ("normal displacement", units.length()), false, displacements),
    ]
}

impl AlongFigure<'_> {
    fn write(&self, path: &Path, DrawnContact { title, points, units, .. }: &DrawnContact) -> Result<(), OutputError> {
        let mut range = finite_range(path, points, &self.curves)?;
        if self.has_zero {
            range = [range[0].min(0.0), range[1].max(0.0)];
        }
        let (range, remark) = if self.cuts_peaks { cut_peaks(range, points, &self.curves) } else { (range, None) };
        let ends = [points[0].arc, points[points.len() - 1].arc];
        let x = Scale::linear(widened(ends, 0.0), 8, "arc length s along the contact boundary", units.length());
        let y = Scale::linear(widened(range, 0.05), 6, self.quantity.0, self.quantity.1);
        let crosses_zero = y.range[0] < 0.0 && y.range[1] > 0.0;
        let mut canvas = Canvas::new(SIZE);
        let chart = Chart::new(canvas.frame(), [HEAD, RIGHT], x, y);
        let legend = self.curves.iter().map(|curve| LegendCell::lines(curve.name.as_str(), &[curve.paint()]));
        chart.draw_head(&mut canvas, title, &[legend.chain(remark.map(LegendCell::words)).collect()]);
        chart.draw_axes(&mut canvas, true);
        chart.within(&mut canvas, |canvas| {
            if crosses_zero {
                canvas.line(Paint::line(GREY, 0.8), chart.level(0.0));
            }
            self.curves.iter().rev().for_each(|curve| curve.draw(canvas, &chart, points));
        });
        canvas.write(path)
    }
}

impl DrawnCurve {
    fn paint(&self) -> Paint {
        Paint::line(self.colour, self.width)
    }

    /// Draws the quantity, broken where it jumps or is not a number. More jumps than can be told apart are no breaks, and of many
    /// points those stay that can be seen.
    fn draw(&self, canvas: &mut Canvas, chart: &Chart, points: &[TracePoint]) {
        let places: Vec<[f64; 2]> = points.iter().map(|p| [p.arc, (self.value)(p)]).collect();
        let is_jump = |a: &[f64; 2], b: &[f64; 2]| a[0] >= b[0] && a[1] != b[1];
        let jumps: Vec<&[[f64; 2]]> = places.windows(2).filter(|pair| is_jump(&pair[0], &pair[1])).collect();
        let breaks = jumps.len() <= MOST_JUMPS;
        let continuous = |a: &[f64; 2], b: &[f64; 2]| !(breaks && is_jump(a, b)) && a[1].is_finite() == b[1].is_finite();
        let placed = move |line: Vec<[f64; 2]>| line.into_iter().map(move |point| chart.place(point));
        let shown = jumps.iter().filter(|_| breaks).map(|pair| placed(pair.to_vec()));
        canvas.lines(Paint::line(self.colour, 0.6).faint(0.45), shown);
        let column = (places[places.len() - 1][0] - places[0][0]) / COLUMNS;
        let runs = places.chunk_by(continuous).filter(|run| run[0][1].is_finite());
        canvas.named(&self.name, |canvas| canvas.lines(self.paint(), runs.map(|run| placed(thinned(run, column)))));
    }
}

/// Of the points in each column of a figure the first, the lowest, the highest and the last, in their order.
fn thinned(run: &[[f64; 2]], column: f64) -> Vec<[f64; 2]> {
    let number = |point: &[f64; 2]| ((point[0] - run[0][0]) / column).floor();
    let of_column = |points: &[[f64; 2]]| {
        let order = |a: &usize, b: &usize| points[*a][1].total_cmp(&points[*b][1]);
        let (lowest, highest) = ((0..points.len()).min_by(order), (0..points.len()).max_by(order));
        let mut kept: Vec<usize> = [0, points.len() - 1].into_iter().chain(lowest).chain(highest).collect();
        kept.sort_unstable();
        kept.dedup();
        kept.into_iter().map(|at| points[at]).collect::<Vec<_>>()
    };
    if run.len() <= 4 { run.to_vec() } else { run.chunk_by(|a, b| number(a) == number(b)).flat_map(of_column).collect() }
}

/// Smallest and largest finite value of all curves.
fn finite_range(path: &Path, points: &[TracePoint], curves: &[DrawnCurve]) -> Result<[f64; 2], OutputError> {
    let values = curves.iter().flat_map(|curve| points.iter().map(curve.value)).filter(|value| value.is_finite());
    let range = range_of(values);
    if range[0] > range[1] {
        return Err(OutputError::Figure { path: path.into(), reason: "no point has a finite value".into() });
    }
    Ok(range)
}

/// Cuts peaks that would squeeze the rest: the range shown, and a remark if it was cut.
fn cut_peaks([low, high]: [f64; 2], points: &[TracePoint], curves: &[DrawnCurve]) -> ([f64; 2], Option<String>) {
    let pieces: Vec<(f64, f64)> = curves
        .iter()
        .flat_map(|curve| points.windows(2).map(|pair| ((curve.value)(&pair[0]), pair[1].arc - pair[0].arc)))
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Point;

    /// A pressure that steps from 1 to 2 at s = 1, and beyond s = 1.99 to `peak`.
    fn stepped(peak: f64) -> Vec<TracePoint> {
        let values = [(0.0, 1.0), (1.0, 1.0), (1.0, 2.0), (1.99, 2.0), (1.99, peak), (2.0, peak)];
        let point = |(s, lambda)| TracePoint {
            arc: s,
            x: s * Point::x(),
            normal: Point::y(),
            lambda,
            stress: [-lambda; 2],
            ..TracePoint::default()
        };
        values.into_iter().map(point).collect()
    }

    fn draw(file: &str, points: &[TracePoint]) -> Result<String, OutputError> {
        let folder = tempfile::tempdir().unwrap();
        let contact = DrawnContact {
            title: "bars\u{1} <1 & 2>\u{1b}[0m",
            bodies: ["<lower>", "upper"],
            points,
            is_deformed: false,
            units: Default::default(),
        };
        let written: Result<(), OutputError> = write_along(folder.path(), "seam", &contact).into_iter().collect();
        written.map(|()| std::fs::read_to_string(folder.path().join(format!("{file}_seam.svg"))).unwrap())
    }

    #[test]
    fn jumps_break_the_line() {
        let figure = draw("pressure", &stepped(2.0)).unwrap();
        let blue: Vec<&str> = figure.lines().filter(|line| line.contains("<path") && line.contains("#0072b2")).collect();
        let count = |is_faint: bool| {
            let lines = blue.iter().filter(|line| line.contains("opacity") == is_faint);
            lines.map(|line| line.matches('M').count()).sum::<usize>()
        };
        assert_eq!((count(false), count(true)), (3, 1), "the legend, two runs, and one jump: {blue:#?}");
        assert!(figure.contains("bars &lt;1 &amp; 2&gt;[0m") && figure.ends_with("</svg>\n"));
        assert!(!figure.contains(['\u{1}', '\u{1b}']), "what XML cannot hold is left out");
        assert!(!figure.contains("peaks"));
        assert!(figure.contains("−σ of &lt;lower&gt;") && figure.contains("−σ of upper"));
    }

    /// What the script of a page reads: the axes of the plot with their units, and each curve in a path with its name.
    #[test]
    fn a_diagram_tells_its_axes_and_the_names_of_its_curves() {
        let folder = tempfile::tempdir().unwrap();
        let units = Units::new(Some("mm"), Some("N"), false);
        let (points, bodies) = (stepped(2.0), ["<lower>", "upper"]);
        let contact = DrawnContact { title: "bars", bodies, points: &points, is_deformed: false, units: &units };
        write_along(folder.path(), "seam", &contact).into_iter().for_each(Result::unwrap);
        let figure = std::fs::read_to_string(folder.path().join("pressure_seam.svg")).unwrap();
        assert_eq!(figure.matches(" data-x=\"0 2 mm\" data-y=\"-0.1 2.1 MPa\">").count(), 1, "{figure}");
        let names = ["−σ of upper", "−σ of &lt;lower&gt;", "contact pressure λ"];
        let groups: Vec<&str> = figure.split("<g data-name=\"").skip(1).collect();
        assert_eq!(groups.len(), names.len());
        for (group, name) in groups.iter().zip(names) {
            let path = group.strip_prefix(name).and_then(|rest| rest.strip_prefix("\">\n<path "));
            let runs = path.and_then(|path| path.split_once("</g>")).map(|(path, _)| path.matches('M').count());
            assert_eq!(runs, Some(2), "{name}: {group}");
        }
    }

    #[test]
    fn long_labels_of_ticks_have_room_beside_the_name_of_the_axis() {
        let mut points = stepped(2.0);
        points.iter_mut().for_each(|point| point.displacement = [-0.0152 - 0.0001 * point.arc, -0.0151]);
        let figure = draw("displacement", &points).unwrap();
        let labels = figure.lines().filter(|line| line.contains(">−0.01") && line.contains("text-anchor=\"end\""));
        let lefts: Vec<f64> = labels
            .map(|line| {
                let right: f64 = line.split(" x=\"").nth(1).unwrap().split('"').next().unwrap().parse().unwrap();
                let words = line.split('>').nth(1).unwrap().trim_end_matches("</text");
                right / 10.0 - crate::output::plot::drawing::text_width(words, 11.0)
            })
            .collect();
        // The name of the axis stands at 10 pixels, upright, in letters of 12.
        assert!(lefts.len() > 3 && lefts.iter().all(|left| *left > 10.0 + 14.0), "{lefts:?}");
    }

    #[test]
    fn a_fine_boundary_makes_no_large_figure() {
        let at = |k: usize| TracePoint { arc: k as f64 / 2.0, lambda: (k as f64 * 0.7).sin(), ..TracePoint::default() };
        let points: Vec<TracePoint> = (0..200_000).map(at).collect();
        let jumping: Vec<TracePoint> = (0..200_000).map(|k| TracePoint { arc: (k / 2) as f64, ..at(k) }).collect();
        for points in [points, jumping] {
            let figure = draw("pressure", &points).unwrap();
            assert!(figure.len() < 300_000, "{} bytes", figure.len());
        }
        let run = [[0.0, 1.0], [0.1, 5.0], [0.2, -3.0], [0.3, 0.0], [0.4, 2.0], [1.5, 7.0]];
        assert_eq!(thinned(&run, 1.0), [[0.0, 1.0], [0.1, 5.0], [0.2, -3.0], [0.4, 2.0], [1.5, 7.0]]);
    }

    #[test]
    fn peaks_are_named_when_cut_off() {
        assert!(draw("pressure", &stepped(40.0)).unwrap().contains("peaks cut off; full range 0 … 40"));
    }

    #[test]
    fn what_is_not_a_number_is_left_out() {
        let mut points = stepped(2.0);
        points[1].displacement[0] = f64::NAN;
        assert!(!draw("displacement", &points).unwrap().contains("NaN"));
        for point in &mut points {
            point.displacement = [f64::NAN, f64::INFINITY];
        }
        assert!(matches!(draw("displacement", &points), Err(OutputError::Figure { .. })));
        assert!(matches!(draw("displacement", &[]), Err(OutputError::Figure { .. })));
    }
}
