//! Where two bodies touch, so large that it can be seen.

use std::path::Path;

use super::along::DrawnContact;
use super::deformed::{contact_line, moved_contact, moved_point, some_of, view};
use super::facets::{Facet, FacetCorner, boundary_edges, check_facets, outlines};
use super::palette::{BLUE, INK, hex};
use super::sheet::line;
use super::stress::{Colours, draw_colour_bar, fills};
use super::ticks::number_text;
use super::view::bounds;
use crate::output::csv::ContactPoint;
use crate::output::error::OutputError;
use crate::output::markup::escape;

/// An interval of a contact boundary that presses, and the part of the plane around it.
#[derive(Clone, Debug)]
pub struct ContactZoom {
    /// Arc lengths of its ends.
    pub interval: [f64; 2],
    /// Lower left and upper right corner of what is shown.
    pub frame: [[f64; 2]; 2],
}

/// Around the interval there is so much room, by its size.
const MARGIN: f64 = 0.5;
/// The largest pressure is drawn so high, by the size of the interval.
const HEIGHT: f64 = 0.28;
/// Names of bodies stand so far from the contact, by the size of the interval.
const AWAY: f64 = 0.38;
/// Points of the pressure that are drawn at most, up to a factor of two.
const MOST_POINTS: usize = 500;
/// An interval that is smaller than this beside its coordinates cannot be drawn.
const LEAST: f64 = 1e-9;

impl ContactZoom {
    /// The zoom on an interval, in the place where the bodies have gone. `facets` are those of all bodies, however coarse. None if
    /// the interval has no size.
    pub fn new(contact: &DrawnContact, interval: [f64; 2], facets: &[Facet]) -> Option<Self> {
        let boundary = boundary_edges(facets);
        let points: Vec<ContactPoint> = pressing(contact.points, interval).copied().collect();
        let moved = moved_contact(&DrawnContact { points: &points, ..*contact }, &boundary, 1.0);
        let [low, high] = bounds(moved.into_iter().map(<[f64; 2]>::from));
        let size = (high[0] - low[0]).max(high[1] - low[1]);
        let far = low.iter().chain(&high).fold(0.0, |far: f64, x| far.max(x.abs()));
        let frame = [low.map(|x| x - MARGIN * size), high.map(|x| x + MARGIN * size)];
        (size.is_finite() && size > LEAST * far).then_some(Self { interval, frame })
    }

    /// Whether a facet may be seen.
    pub fn shows(&self, corners: &[[f64; 2]; 3]) -> bool {
        let [low, high] = self.frame;
        (0..2).all(|axis| corners.iter().any(|x| x[axis] >= low[axis]) && corners.iter().any(|x| x[axis] <= high[axis]))
    }

    /// The size of the interval.
    fn size(&self) -> f64 {
        let [low, high] = self.frame;
        (high[0] - low[0]).max(high[1] - low[1]) / (1.0 + 2.0 * MARGIN)
    }
}

/// Points of a contact boundary within an interval.
fn pressing(points: &[ContactPoint], [from, to]: [f64; 2]) -> impl Iterator<Item = &ContactPoint> {
    let tiny = 1e-9 * (to - from);
    points.iter().filter(move |p| p.s >= from - tiny && p.s <= to + tiny)
}

/// Draws `deformed_NAME_1.svg` and so on: the bodies around an interval that presses, coloured by von Mises stress, with their
/// names, and the pressure on the contact boundary.
///
/// Displacements are drawn as they are: with any other factor bodies whose gap closes would overlap, or stay apart. The facets
/// are those that [`ContactZoom::shows`].
///
/// # Errors
/// There is no facet, or a number is not finite; the operating system refuses.
pub fn write_zoom(path: &Path, zoom: &ContactZoom, contact: &DrawnContact, facets: &[Facet]) -> Result<(), OutputError> {
    check_facets(path, facets)?;
    let view = view(zoom.frame);
    let colours = Colours::of(facets);
    let boundary = boundary_edges(facets);
    let ([casing, core], pressure) = (contact_line(), line(&BLUE, 1.6));
    let whole = moved_contact(contact, &boundary, 1.0);
    let profile = profile(zoom, contact, &boundary);
    let largest = pressing(contact.points, zoom.interval).map(|p| p.lambda).fold(0.0, f64::max);
    view.sheet.write(path, |sheet, area| {
        let ends = zoom.interval.map(number_text);
        sheet.draw_title(area, &format!("{}, s = {} to {}, displacements × 1", contact.title, ends[0], ends[1]))?;
        let words = format!("contact pressure λ, up to {}", number_text(largest));
        sheet.draw_legend(area, &[("contact boundary", &[casing, core]), (&words, &[pressure])])?;
        let chart = sheet.draw_axes(area, &view.x, &view.y, false)?;
        draw_colour_bar(sheet, area, &colours)?;
        let place = |x: [f64; 2]| chart.backend_coord(&x.into());
        let lines: String = [("#262626", 30), ("#ffffff", 14)]
            .map(|(colour, width)| polyline(whole.iter().copied().map(<[f64; 2]>::from), colour, width, place))
            .concat();
        let bodies = fills(facets, 1.0, &colours, place) + &outlines(&boundary, 1.0, INK, place);
        let names = names(zoom, contact, &boundary, place);
        let inside = bodies + &lines + &envelope(&profile, place) + &names;
        let [(left, top), (right, bottom)] = sheet.corners();
        let (width, height) = (right - left, bottom - top);
        // An element of its own cuts off what lies outside, without a name that other figures of a page might have, too.
        Ok(format!(
            "<svg x=\"{left}\" y=\"{top}\" width=\"{width}\" height=\"{height}\" viewBox=\"{left} {top} {width} {height}\">\n{inside}</svg>\n"
        ))
    })
}

/// Points on the contact boundary where it presses, each with the tip of its pressure, which points into body 2.
fn profile(zoom: &ContactZoom, contact: &DrawnContact, boundary: &[[FacetCorner; 2]]) -> Vec<[[f64; 2]; 2]> {
    let points: Vec<&ContactPoint> = pressing(contact.points, zoom.interval).collect();
    let largest = points.iter().map(|p| p.lambda).fold(0.0, f64::max);
    let tip = |p: &&ContactPoint| {
        let (x, y) = moved_point(contact, p, boundary, 1.0);
        let high = HEIGHT * zoom.size() * p.lambda.max(0.0) / largest;
        [[x, y], [x + high * p.nx, y + high * p.ny]]
    };
    some_of(&points, MOST_POINTS).map(tip).filter(|ends| ends.iter().flatten().all(|x| x.is_finite())).collect()
}

/// The pressure as an area over the contact boundary.
fn envelope(profile: &[[[f64; 2]; 2]], place: impl Fn([f64; 2]) -> (i32, i32)) -> String {
    let tips = profile.iter().map(|[_, tip]| *tip);
    let around = point_list(tips.clone().chain(profile.iter().rev().map(|[foot, _]| *foot)), &place);
    format!("<polygon fill=\"#fff\" fill-opacity=\"0.6\" stroke=\"none\" points=\"{around}\"/>\n")
        + &polyline(tips, &hex(BLUE), 16, place)
}

fn polyline(points: impl Iterator<Item = [f64; 2]>, colour: &str, width: i32, place: impl Fn([f64; 2]) -> (i32, i32)) -> String {
    let list = point_list(points, place);
    format!("<polyline fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\" points=\"{list}\"/>\n")
}

fn point_list(points: impl Iterator<Item = [f64; 2]>, place: impl Fn([f64; 2]) -> (i32, i32)) -> String {
    points.map(place).map(|(x, y)| format!("{x},{y} ")).collect()
}

/// The names of both bodies, each on its side of the middle of the interval.
fn names(
    zoom: &ContactZoom,
    contact: &DrawnContact,
    boundary: &[[FacetCorner; 2]],
    place: impl Fn([f64; 2]) -> (i32, i32),
) -> String {
    let middle = 0.5 * (zoom.interval[0] + zoom.interval[1]);
    let distance = |p: &&ContactPoint| (p.s - middle).abs();
    let Some(p) = pressing(contact.points, zoom.interval).min_by(|a, b| distance(a).total_cmp(&distance(b))) else {
        return String::new();
    };
    let (x, y) = moved_point(contact, p, boundary, 1.0);
    let name = |(name, side): (&str, f64)| {
        let (x, y) = place([x + side * AWAY * zoom.size() * p.nx, y + side * AWAY * zoom.size() * p.ny]);
        format!(
            "<text x=\"{x}\" y=\"{y}\" dy=\"0.35em\" text-anchor=\"middle\" font-family=\"sans-serif\" font-size=\"140\" font-weight=\"bold\" fill=\"#262626\" stroke=\"#fff\" stroke-width=\"40\" paint-order=\"stroke\">{}</text>\n",
            escape(name)
        )
    };
    contact.bodies.into_iter().zip([-1.0, 1.0]).map(name).collect()
}
