//! The deformed bodies.

use std::path::Path;

use plotters::element::{PathElement, Rectangle, Text};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, FontStyle, FontTransform, RGBColor, ShapeStyle};

use super::along::DrawnContact;
use super::macro_edges::{BETWEEN, DrawnEdge, THIN, macro_lines};
use super::outline::{loops, path_data, unmatched};
use super::palette::{GREY, INK, VERMILION, viridis};
use super::sheet::{Area, AxisSpec, DrawResult, PIXEL, Scale, Sheet, line, text_style};
use super::ticks::{Ticks, cut_off, number_text, round_number};
use crate::output::{ContactPoint, OutputError};

/// A triangle of a body as the figure shows it: corners alone, stress linear between them.
#[derive(Clone, Copy, Debug)]
pub struct Facet {
    /// Undeformed corners, counter-clockwise.
    pub corners: [[f64; 2]; 3],
    /// Their displacements.
    pub displacement: [[f64; 2]; 3],
    /// Von Mises stress at the corners.
    pub von_mises: [f64; 3],
}

/// The force of a contact as the figure shows it: a line along it, to both sides of the place where it acts.
#[derive(Clone, Copy, Debug)]
pub struct DrawnForce {
    /// Where it acts.
    pub place: [f64; 2],
    /// The force on one of the bodies.
    pub force: [f64; 2],
    /// How far the line goes to either side (length).
    pub reach: f64,
    /// Whether the place lies on the deformed bodies.
    pub is_deformed: bool,
}

/// Width of the line of the largest force, and of the smallest that is drawn (pixels).
const FORCE_WIDTHS: [f64; 2] = [9.0, 0.2];
/// Steps of the colour bar.
const LEVELS: usize = 40;
/// The largest displacement is drawn as about this fraction of the size of the bodies.
const SHOWN_DISPLACEMENT: f64 = 0.05;
/// Points of a contact boundary that are drawn at most, up to a factor of two.
const MOST_POINTS: usize = 1000;
/// Room for the plot (pixels).
const ROOM: [f64; 2] = [640.0, 560.0];
/// A plot is at least this large (pixels).
const LEAST: [f64; 2] = [320.0, 220.0];
/// Room for the colour bar beside the plot (pixels).
const BAR_ROOM: i32 = 120;

/// Draws `deformed.svg`: the deformed bodies coloured by von Mises stress, their undeformed outlines, and the contact boundaries.
///
/// Displacements are multiplied by a round number that makes the largest about 5 % of the size of the bodies. The title
/// states it. Contact boundaries move along: normal to themselves by the mean of both bodies' normal displacements, along
/// themselves with the nearest boundary. Forces are lines, as wide as they are large. Areas of one colour are merged over triangles, which keeps the file small. Macro edges,
/// if there are any, are thin lines on the deformed bodies, those between two materials thicker ones.
///
/// # Errors
/// There is no facet, or a number is not finite; the operating system refuses.
pub fn write_deformed(
    path: &Path,
    title: &str,
    facets: &[Facet],
    [macro_edges, interfaces]: [&[DrawnEdge]; 2],
    contacts: &[DrawnContact],
    forces: &[DrawnForce],
) -> Result<(), OutputError> {
    check_facets(path, facets)?;
    let scale = automatic_scale(facets);
    let view = View::around(facets, scale);
    let colours = Colours::of(facets);
    let boundary = boundary_edges(facets);
    let ([casing, core], undeformed) = (contact_line(), line(&GREY, 0.7));
    let largest = forces.iter().map(DrawnForce::size).fold(0.0, f64::max);
    let [widest, least] = FORCE_WIDTHS;
    let forces = forces.iter().filter(|force| force.size() * widest > least * largest);
    let lines: Vec<(f64, Vec<(f64, f64)>)> =
        forces.map(|force| (widest * force.size() / largest, force.line(&boundary, scale))).collect();
    view.sheet.write(path, |sheet, area| {
        sheet.draw_title(area, &format!("{title}, displacements × {}", number_text(scale)))?;
        let up_to = format!("contact force, up to {}", number_text(largest));
        let legend = [
            ("undeformed", &[undeformed][..], true),
            ("contact boundary", &[casing, core], !contacts.is_empty()),
            (&up_to, &[line(&VERMILION, 0.5 * widest)], !lines.is_empty()),
        ];
        let legend: Vec<_> = legend.iter().filter(|(_, _, is_drawn)| *is_drawn).map(|(name, style, _)| (*name, *style)).collect();
        sheet.draw_legend(area, &legend)?;
        let mut chart = sheet.draw_axes(area, &view.x, &view.y, false)?;
        for contact in contacts {
            let moved = moved_contact(contact, &boundary, scale);
            chart.draw_series([casing, core].map(|style| PathElement::new(moved.clone(), style)))?;
        }
        chart.draw_series(lines.iter().map(|(width, ends)| PathElement::new(ends.clone(), line(&VERMILION.mix(0.8), *width))))?;
        draw_colour_bar(sheet, area, &colours)?;
        let place = |x: [f64; 2]| chart.backend_coord(&x.into());
        Ok(outlines(&boundary, 0.0, GREY, place)
            + &fills(facets, scale, &colours, place)
            + &macro_lines(macro_edges, THIN, scale, place)
            + &macro_lines(interfaces, BETWEEN, scale, place)
            + &outlines(&boundary, scale, INK, place))
    })
}

impl DrawnForce {
    fn size(&self) -> f64 {
        Some(self.force[0].hypot(self.force[1])).filter(|size| size.is_finite()).unwrap_or(0.0)
    }

    /// Its line, moved along with the nearest boundary.
    fn line(&self, boundary: &[[FacetCorner; 2]], scale: f64) -> Vec<(f64, f64)> {
        let there = if self.is_deformed { 1.0 } else { 0.0 };
        let u = displacement_near(self.place, boundary, there);
        let [x, y] = [0, 1].map(|axis| self.place[axis] + (scale - there) * u[axis]);
        let [dx, dy] = self.force.map(|part| self.reach * part / self.size());
        vec![(x - dx, y - dy), (x + dx, y + dy)]
    }
}

/// Strokes of a contact boundary, which lie on each other.
pub(super) fn contact_line() -> [ShapeStyle; 2] {
    [line(&INK, 3.0), line(&RGBColor(255, 255, 255), 1.4)]
}

pub(super) fn check_facets(path: &Path, facets: &[Facet]) -> Result<(), OutputError> {
    let finite = |facet: &Facet| {
        let numbers = facet.corners.iter().chain(&facet.displacement).flatten();
        numbers.chain(&facet.von_mises).all(|number| number.is_finite())
    };
    let reason = match facets {
        [] => "there is no triangle",
        _ if !facets.iter().all(finite) => "a displacement or stress is not finite",
        _ => return Ok(()),
    };
    Err(OutputError::Figure { path: path.into(), reason: reason.into() })
}

/// The round number that makes the largest displacement about 5 % of the size of the bodies; 1 if nothing moves.
fn automatic_scale(facets: &[Facet]) -> f64 {
    let [low, high] = bounds(facets, 0.0);
    let size = (high[0] - low[0]).max(high[1] - low[1]);
    let largest = facets.iter().flat_map(|facet| facet.displacement).map(|[x, y]| x.hypot(y)).fold(0.0, f64::max);
    if largest > 1e-300 * size { round_number(SHOWN_DISPLACEMENT * size / largest) } else { 1.0 }
}

impl Facet {
    /// Its corners with their displacements.
    pub fn deformed(&self, scale: f64) -> [[f64; 2]; 3] {
        std::array::from_fn(|k| [0, 1].map(|axis| self.corners[k][axis] + scale * self.displacement[k][axis]))
    }
}

/// Lower left and upper right corner of the box around all facets.
fn bounds(facets: &[Facet], scale: f64) -> [[f64; 2]; 2] {
    let start = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
    facets
        .iter()
        .flat_map(|facet| facet.deformed(scale))
        .fold(start, |[low, high], x| [[low[0].min(x[0]), low[1].min(x[1])], [high[0].max(x[0]), high[1].max(x[1])]])
}

/// The part of the plane that is shown, and the sheet that shows it without distortion.
pub(super) struct View {
    pub sheet: Sheet,
    pub x: AxisSpec,
    pub y: AxisSpec,
}

impl View {
    /// Holds the bodies with and without their displacements.
    fn around(facets: &[Facet], scale: f64) -> View {
        let [before, after] = [bounds(facets, 0.0), bounds(facets, scale)];
        let low = [0, 1].map(|axis| before[0][axis].min(after[0][axis]));
        let high = [0, 1].map(|axis| before[1][axis].max(after[1][axis]));
        let room = 0.03 * (high[0] - low[0]).max(high[1] - low[1]);
        View::of([low.map(|x| x - room), high.map(|x| x + room)])
    }

    /// Holds a box, given by its lower left and upper right corner.
    pub fn of([low, high]: [[f64; 2]; 2]) -> View {
        let needed = [0, 1].map(|axis| high[axis] - low[axis]);
        let pixels_per_length = (ROOM[0] / needed[0]).min(ROOM[1] / needed[1]);
        let pixels = [0, 1].map(|axis| (needed[axis] * pixels_per_length).max(LEAST[axis]).round());
        let axis_spec = |axis: usize, name: &str| {
            let (middle, half) = (0.5 * (low[axis] + high[axis]), 0.5 * pixels[axis] / pixels_per_length);
            let range = [middle - half, middle + half];
            let ticks = Ticks::new(range, (pixels[axis] / 80.0).ceil() as usize);
            AxisSpec { scale: Scale::Linear, name: format!("{name} [{}]", ticks.unit("length")), range, ticks }
        };
        let (x, y) = (axis_spec(0, "x"), axis_spec(1, "y"));
        let margins = [y.room().max(62), BAR_ROOM, 62, 54];
        let [width, height] = pixels.map(|pixels| pixels as i32);
        let sheet = Sheet { width: width + margins[0] + margins[1], height: height + margins[2] + margins[3], margins };
        View { sheet, x, y }
    }
}

/// Von Mises stress from zero to `top` in equal steps of colour; peaks above take the last one.
pub(super) struct Colours {
    top: f64,
    peak: Option<f64>,
}

impl Colours {
    pub fn of(facets: &[Facet]) -> Colours {
        let area = |[a, b, c]: [[f64; 2]; 3]| ((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])).abs();
        let weighted: Vec<(f64, f64)> =
            facets.iter().map(|facet| (facet.von_mises.iter().sum::<f64>() / 3.0, area(facet.corners))).collect();
        let high = facets.iter().flat_map(|facet| facet.von_mises).fold(0.0, f64::max);
        match cut_off(high, weighted) {
            Some(top) => Colours { top, peak: Some(high) },
            None => Colours { top: if high > 0.0 { high } else { 1.0 }, peak: None },
        }
    }

    /// Corner values of a facet in steps of colour: level k reaches from k to k + 1.
    fn steps(&self, facet: &Facet) -> [f64; 3] {
        facet.von_mises.map(|value| value / self.top * LEVELS as f64)
    }

    fn level(step: f64) -> usize {
        (step as usize).min(LEVELS - 1)
    }

    fn colour(level: usize) -> RGBColor {
        viridis(level as f64 / (LEVELS - 1) as f64)
    }
}

/// The triangles cut into bands of colour, merged where neighbours have the same. A line of that colour closes the hairlines
/// between merged areas.
pub(super) fn fills(facets: &[Facet], scale: f64, colours: &Colours, place: impl Fn([f64; 2]) -> (i32, i32)) -> String {
    let mut edges = vec![Vec::new(); LEVELS];
    for facet in facets {
        let (corners, steps) = (facet.deformed(scale), colours.steps(facet));
        let [low, high] = [steps.iter().copied().fold(f64::INFINITY, f64::min), steps.iter().copied().fold(0.0, f64::max)];
        let [first, last] = [low, high].map(Colours::level);
        for (level, edges) in edges.iter_mut().enumerate().take(last + 1).skip(first) {
            let upper = if level + 1 < LEVELS { level as f64 + 1.0 } else { f64::INFINITY };
            let polygon: Vec<(i32, i32)> = band(&corners, &steps, [level as f64, upper]).into_iter().map(&place).collect();
            edges.extend((0..polygon.len()).map(|k| [polygon[k], polygon[(k + 1) % polygon.len()]]));
        }
    }
    let path = |(level, edges): (usize, Vec<_>)| {
        let RGBColor(red, green, blue) = Colours::colour(level);
        let data = path_data(&loops(&unmatched(edges)));
        let colour = format!("#{red:02x}{green:02x}{blue:02x}");
        format!("<path fill=\"{colour}\" stroke=\"{colour}\" stroke-width=\"4\" d=\"{data}\"/>\n")
    };
    edges.into_iter().enumerate().filter(|(_, edges)| !edges.is_empty()).map(path).collect()
}

/// The part of a triangle where a value, linear between its corners, lies in a range. Neighbours with the same corner values cut
/// their common edge at the same points.
fn band(corners: &[[f64; 2]; 3], values: &[f64; 3], [low, high]: [f64; 2]) -> Vec<[f64; 2]> {
    let mut points = Vec::with_capacity(5);
    for (from, to) in [(0, 1), (1, 2), (2, 0)] {
        if low <= values[from] && values[from] <= high {
            points.push(corners[from]);
        }
        let rises = values[from] < values[to];
        let [below, above] = if rises { [from, to] } else { [to, from] };
        for limit in if rises { [low, high] } else { [high, low] } {
            if values[below] < limit && limit < values[above] {
                let fraction = (limit - values[below]) / (values[above] - values[below]);
                points.push([0, 1].map(|k| (1.0 - fraction) * corners[below][k] + fraction * corners[above][k]));
            }
        }
    }
    points
}

/// The outlines of the bodies as one path.
pub(super) fn outlines(
    boundary: &[[FacetCorner; 2]],
    scale: f64,
    colour: RGBColor,
    place: impl Fn([f64; 2]) -> (i32, i32),
) -> String {
    let placed = |points: Vec<FacetCorner>| points.into_iter().map(|node| place(node.deformed(scale))).collect();
    let loops: Vec<Vec<(i32, i32)>> = loops(boundary).into_iter().map(placed).collect();
    let RGBColor(red, green, blue) = colour;
    let data = path_data(&loops);
    format!("<path fill=\"none\" stroke=\"#{red:02x}{green:02x}{blue:02x}\" stroke-width=\"7\" d=\"{data}\"/>\n")
}

/// A corner of a facet by its bits: position, rounded, and displacement, so that bodies that touch keep their own corners.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct FacetCorner([u64; 4]);

impl FacetCorner {
    /// Macro triangles that share a node place it alike up to rounding; here it has one place, a multiple of `unit`.
    fn new(x: [f64; 2], u: [f64; 2], unit: f64) -> FacetCorner {
        let [x, y] = x.map(|x| (x / unit).round() * unit);
        FacetCorner([x, y, u[0], u[1]].map(|number| (number + 0.0).to_bits()))
    }

    fn displacement(self) -> [f64; 2] {
        [self.0[2], self.0[3]].map(f64::from_bits)
    }

    fn deformed(self, scale: f64) -> [f64; 2] {
        let u = self.displacement();
        [0, 1].map(|axis| f64::from_bits(self.0[axis]) + scale * u[axis])
    }
}

/// The edges of facets that have a body on one side only.
pub(super) fn boundary_edges(facets: &[Facet]) -> Vec<[FacetCorner; 2]> {
    let [low, high] = bounds(facets, 0.0);
    let far = low.iter().chain(&high).fold(0.0, |far: f64, x| far.max(x.abs()));
    // Coordinates of drawings are seldom halves of this.
    let unit = (1.37e-8 * (high[0] - low[0]).max(high[1] - low[1])).max(1.37e-13 * far).max(f64::MIN_POSITIVE);
    unmatched(facets.iter().flat_map(|facet| {
        let [a, b, c] = [0, 1, 2].map(|k| FacetCorner::new(facet.corners[k], facet.displacement[k], unit));
        [[a, b], [b, c], [c, a]]
    }))
}

/// A contact boundary moved along with the bodies; of many points so many that none is missed.
pub(super) fn moved_contact(contact: &DrawnContact, boundary: &[[FacetCorner; 2]], scale: f64) -> Vec<(f64, f64)> {
    let points = contact.points;
    let every = points.len().div_ceil(MOST_POINTS).max(1);
    let shown = (0..points.len()).filter(|k| k % every == 0 || k + 1 == points.len()).map(|k| &points[k]);
    shown.map(|p| moved_point(contact, p, boundary, scale)).filter(|(x, y)| x.is_finite() && y.is_finite()).collect()
}

/// One point of it: normal to the boundary by the mean of both bodies' normal displacements, along it with the nearest boundary.
pub(super) fn moved_point(contact: &DrawnContact, p: &ContactPoint, boundary: &[[FacetCorner; 2]], scale: f64) -> (f64, f64) {
    let there = if contact.is_deformed { 1.0 } else { 0.0 };
    let u = displacement_near([p.x, p.y], boundary, there);
    let (along, across) = (p.nx * u[1] - p.ny * u[0], 0.5 * (p.un_1 + p.un_2));
    let left = scale - there;
    (p.x + left * (across * p.nx - along * p.ny), p.y + left * (across * p.ny + along * p.nx))
}

/// The displacement at the point of the boundary, deformed by `there`, that is nearest to a point.
fn displacement_near(point: [f64; 2], boundary: &[[FacetCorner; 2]], there: f64) -> [f64; 2] {
    let nearest = boundary.iter().map(|edge| {
        let [a, b] = edge.map(|node| node.deformed(there));
        let (edge_x, edge_y) = (b[0] - a[0], b[1] - a[1]);
        let (from_x, from_y) = (point[0] - a[0], point[1] - a[1]);
        let fraction = ((from_x * edge_x + from_y * edge_y) / (edge_x * edge_x + edge_y * edge_y)).clamp(0.0, 1.0);
        ((from_x - fraction * edge_x).hypot(from_y - fraction * edge_y), fraction, edge)
    });
    nearest.min_by(|a, b| a.0.total_cmp(&b.0)).map_or([0.0; 2], |(_, fraction, edge)| {
        let [first, second] = edge.map(FacetCorner::displacement);
        [0, 1].map(|axis| (1.0 - fraction) * first[axis] + fraction * second[axis])
    })
}

/// Draws the bar of colours at the right of the plot, with its ticks and its name.
pub(super) fn draw_colour_bar(sheet: &Sheet, area: &Area, colours: &Colours) -> DrawResult<()> {
    let left = (sheet.width - BAR_ROOM + 24) * PIXEL;
    let right = left + 16 * PIXEL;
    let [top, bottom] = [sheet.margins[2], sheet.height - sheet.margins[3]].map(|y| y * PIXEL);
    let height_of = |fraction: f64| bottom - (f64::from(bottom - top) * fraction).round() as i32;
    for level in 0..LEVELS {
        let low = height_of(level as f64 / LEVELS as f64); // up to the top: the next ones lie on it, without hairlines between
        area.draw(&Rectangle::new([(left, top), (right, low)], Colours::colour(level).filled()))?;
    }
    area.draw(&Rectangle::new([(left, top), (right, bottom)], line(&GREY, 0.8)))?;
    let ticks = Ticks::new([0.0, colours.top], 5);
    let label = text_style(11.0, FontStyle::Normal, INK).pos(Pos::new(HPos::Left, VPos::Center));
    for &value in &ticks.values {
        let y = height_of(value / colours.top);
        area.draw(&PathElement::new(vec![(right, y), (right + 4 * PIXEL, y)], line(&GREY, 0.8)))?;
        area.draw(&Text::new(ticks.label(value), (right + 7 * PIXEL, y), label.clone()))?;
    }
    let name = format!("von Mises stress [{}]", ticks.unit("stress"));
    let upright = text_style(12.0, FontStyle::Normal, INK).transform(FontTransform::Rotate270);
    let upright = upright.pos(Pos::new(HPos::Center, VPos::Bottom));
    area.draw(&Text::new(name, (right + 62 * PIXEL, (top + bottom) / 2), upright))?;
    match colours.peak {
        Some(peak) => sheet.draw_remark(area, &format!("stress up to {}", number_text(peak))),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square block [x, x+1] × [0, 1] of n × n × 2 facets.
    fn block(x: f64, n: usize, displacement: fn(f64, f64) -> [f64; 2], von_mises: fn(f64, f64) -> f64) -> Vec<Facet> {
        let corner = |i: usize, j: usize| [x + i as f64 / n as f64, j as f64 / n as f64];
        let mut facets = Vec::new();
        for (i, j) in (0..n * n).map(|k| (k % n, k / n)) {
            let [a, b, c, d] = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
            facets.extend([[a, b, c], [a, c, d]].map(|corners| Facet {
                corners,
                displacement: corners.map(|[x, y]| displacement(x, y)),
                von_mises: corners.map(|[x, y]| von_mises(x, y)),
            }));
        }
        facets
    }

    fn drawn(points: &[ContactPoint]) -> DrawnContact<'_> {
        DrawnContact { title: "blocks", bodies: ["left", "right"], points, is_deformed: false }
    }

    fn draw(facets: &[Facet]) -> Result<String, OutputError> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("deformed.svg");
        let contact = [0.0, 0.5, 1.0].map(|s| ContactPoint { s, x: 1.0, y: s, nx: 1.0, ..ContactPoint::default() });
        write_deformed(&path, "blocks", facets, [&[], &[]], &[drawn(&contact)], &[])
            .map(|()| std::fs::read_to_string(path).unwrap())
    }

    #[test]
    fn scale_is_round_and_stated() {
        let facets = block(0.0, 4, |x, _| [3e-5 * x, 0.0], |x, _| x);
        assert_eq!(automatic_scale(&facets), 2000.0);
        assert!(draw(&facets).unwrap().contains("blocks, displacements × 2000"));
        assert_eq!(automatic_scale(&block(0.0, 1, |_, _| [0.0, 0.0], |_, _| 0.0)), 1.0);
    }

    #[test]
    fn twenty_thousand_facets_make_a_small_file() {
        let facets = block(0.0, 100, |x, y| [1e-4 * y, 2e-4 * x * y], |x, y| 1.0 + (7.0 * x).sin() * (9.0 * y).cos());
        let figure = draw(&facets).unwrap();
        assert!(figure.len() < 300_000, "{} bytes", figure.len());
    }

    #[test]
    fn bands_of_colour_make_up_the_triangle() {
        let corners = [[0.0, 0.0], [4.0, 0.0], [1.0, 3.0]];
        let area = |points: Vec<[f64; 2]>| {
            let cross = |[a, b]: [[f64; 2]; 2]| 0.5 * (a[0] * b[1] - a[1] * b[0]);
            (0..points.len()).map(|k| cross([points[k], points[(k + 1) % points.len()]])).sum::<f64>()
        };
        for values in [[0.2, 3.7, 1.4], [2.0, 2.0, 0.0], [1.0, 1.5, 1.0], [2.5; 3]] {
            let sum: f64 = (0..4).map(|level| area(band(&corners, &values, [level as f64, level as f64 + 1.0]))).sum();
            assert!((sum - 6.0).abs() < 1e-14, "{values:?}: {sum}");
        }
        assert_eq!(band(&corners, &[0.0, 4.0, 4.0], [1.0, 2.0]).len(), 4);
    }

    #[test]
    fn bodies_that_touch_keep_their_own_outlines() {
        let mut facets = block(0.0, 3, |_, _| [0.0, 0.0], |_, _| 1.0);
        assert_eq!(boundary_edges(&facets).len(), 12);
        facets.extend(block(1.0, 3, |_, y| [0.0, 1e-6 + y], |_, _| 1.0));
        assert_eq!(boundary_edges(&facets).len(), 24);
        assert_eq!(loops(&boundary_edges(&facets)).len(), 2);
    }

    #[test]
    fn corners_that_differ_by_rounding_are_one() {
        let mut facets = block(0.0, 3, |_, _| [0.0, 0.0], |_, _| 1.0);
        facets[0].corners[0] = [1e-19, -3e-18];
        facets[3].corners[1][0] += 1e-16;
        let edges = boundary_edges(&facets);
        assert_eq!((edges.len(), loops(&edges).len()), (12, 1));
    }

    #[test]
    fn contact_moves_with_the_bodies() {
        let facets = block(0.0, 3, |_, y| [0.0, 0.1 * y], |_, _| 1.0);
        let point = ContactPoint { x: 1.0, y: 0.5, nx: 1.0, un_1: 0.2, un_2: 0.4, ..ContactPoint::default() };
        let edges = boundary_edges(&facets);
        let moved = moved_contact(&drawn(&[point]), &edges, 10.0);
        assert!((moved[0].0 - 4.0).abs() < 1e-6 && (moved[0].1 - 1.0).abs() < 1e-6, "{moved:?}");
        // Where contact is modelled on the deformed bodies it lies there already.
        let there = ContactPoint { y: 0.55, x: 1.3, ..point };
        let moved = moved_contact(&DrawnContact { is_deformed: true, ..drawn(&[there]) }, &edges, 1.0);
        assert_eq!(moved, [(1.3, 0.55)]);
    }

    #[test]
    fn forces_are_lines_as_wide_as_they_are_large() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("deformed.svg");
        let facets = block(0.0, 4, |_, _| [0.0, 1e-3], |_, _| 1.0);
        let force = |x: f64, size: f64| DrawnForce { place: [x, 0.5], force: [0.0, size], reach: 0.25, is_deformed: false };
        let forces = [force(0.2, 8.0), force(0.5, -4.0), force(0.8, 0.0), force(0.9, f64::NAN), force(0.9, 1e-3)];
        write_deformed(&path, "blocks", &facets, [&[], &[]], &[], &forces).unwrap();
        let figure = std::fs::read_to_string(path).unwrap();
        let widths = [90, 45].map(|width| figure.matches(&format!("stroke-width=\"{width}\"")).count());
        // The line of the legend is half as wide as that of the largest force.
        assert_eq!(widths, [1, 2]);
        assert!(figure.contains("contact force, up to 8") && !figure.contains("NaN"));
        let moved = force(0.0, 2.0).line(&boundary_edges(&facets), 100.0);
        assert!((moved[0].1 - 0.35).abs() < 1e-9 && (moved[1].1 - 0.85).abs() < 1e-9, "{moved:?}");
    }

    #[test]
    fn macro_edges_are_thin_lines_that_move_with_the_bodies() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("deformed.svg");
        let facets = block(0.0, 4, |_, y| [0.0, 1e-3 * y], |_, _| 1.0);
        let edge = |x: f64| DrawnEdge([0.0, 0.5, 1.0].map(|y| ([x, y], [0.0, 1e-3 * y])).into());
        let mut edges = vec![edge(0.0), edge(0.25), edge(0.5)];
        edges[2].0[1].1 = [f64::NAN, 0.0];
        write_deformed(&path, "blocks", &facets, [&edges, &[]], &[], &[]).unwrap();
        let figure = std::fs::read_to_string(path).unwrap();
        let lines: Vec<&str> = figure.lines().filter(|line| line.contains("stroke-opacity")).collect();
        let [line] = lines[..] else { panic!("{lines:?}") };
        assert!(line.matches('M').count() == 2 && !line.contains("z\"") && !figure.contains("NaN"), "{line}");
        let moved = macro_lines(&edges[1..2], THIN, 100.0, |[x, y]| ((100.0 * x) as i32, (1000.0 * y).round() as i32));
        assert!(moved.contains("d=\"M25 0l0 1100\""), "{moved}");
        assert!(!draw(&facets).unwrap().contains("stroke-opacity"), "no mesh unless there are macro edges");
    }

    #[test]
    fn peaks_of_stress_take_the_last_colour() {
        let mut facets = block(0.0, 20, |_, _| [0.0, 0.0], |_, _| 2.0);
        facets[0].von_mises = [100.0; 3];
        assert!(draw(&facets).unwrap().contains("stress up to 100"));
        facets[0].von_mises[1] = f64::NAN;
        assert!(matches!(draw(&facets), Err(OutputError::Figure { .. })));
        assert!(matches!(draw(&[]), Err(OutputError::Figure { .. })));
    }
}
