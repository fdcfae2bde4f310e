//! Where two bodies touch, so large that it can be seen.

use std::path::Path;

use super::deformed::plane;
use super::facets::{
    CONTACT, Facet, FacetCorner, boundary_edges, check_facets, draw_outlines, moved_contact, moved_point, some_of,
};
use super::stress::{Colours, draw_colour_bar, draw_stress};
use crate::element::StressMeasure;
use crate::output::error::OutputError;
use crate::output::plot::diagrams::DrawnContact;
use crate::output::plot::drawing::*;
use crate::recovery::TracePoint;

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
        let points: Vec<TracePoint> = pressing(contact.points, interval).copied().collect();
        let moved = moved_contact(&DrawnContact { points: &points, ..*contact }, &boundary, 1.0);
        let [low, high] = bounds(moved.into_iter());
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

    /// Draws `deformed_NAME_1.svg` and so on: the bodies around an interval that presses, coloured by von Mises stress, with their
    /// names, and the pressure on the contact boundary.
    ///
    /// Displacements are drawn as they are: with any other factor bodies whose gap closes would overlap, or stay apart. The facets
    /// are those that [`Self::shows`]; bodies of revolution have an axis.
    ///
    /// # Errors
    /// There is no facet, or a number is not finite; the operating system refuses.
    pub fn write(&self, path: &Path, contact: &DrawnContact, facets: &[Facet], has_axis: bool) -> Result<(), OutputError> {
        check_facets(path, facets)?;
        let (colours, boundary) = (Colours::of(facets, StressMeasure::VonMises), boundary_edges(facets));
        let (mut canvas, chart) = plane(self.frame, has_axis, contact.units);
        let (profile, largest) = profile(self, contact, &boundary);
        let [from, to] = self.interval.map(number_text);
        let title = format!("{}, s = {from} to {to}, displacements × 1", contact.title);
        let pressure = Paint::line(BLUE, 1.6);
        let words = format!("contact pressure λ, up to {}{}", number_text(largest), contact.units.stress().after());
        let mut legend = vec![LegendCell::lines("contact boundary", &CONTACT), LegendCell::lines(words, &[pressure])];
        legend.extend(colours.remark(contact.units.stress()));
        chart.draw_head(&mut canvas, &title, &[legend]);
        canvas.within(chart.frame, "", |canvas| {
            draw_stress(canvas, &chart, facets, 1.0, &colours);
            draw_outlines(canvas, &chart, &boundary, 1.0, INK);
            let whole = moved_contact(contact, &boundary, 1.0);
            CONTACT.iter().for_each(|paint| canvas.line(*paint, whole.iter().map(|x| chart.place(*x))));
            let chart = &chart;
            let [feet, tips] = [0, 1].map(|end| profile.iter().map(move |ends| chart.place(ends[end])));
            canvas.polygon(Paint::fill(WHITE).faint(0.6), tips.clone().chain(feet.rev()));
            canvas.line(pressure, tips);
            draw_names(canvas, chart, self, contact, &boundary);
        });
        chart.draw_axes(&mut canvas, false);
        draw_colour_bar(&mut canvas, &chart, &colours, contact.units.stress());
        canvas.write(path)
    }

    /// The size of the interval.
    fn size(&self) -> f64 {
        let [low, high] = self.frame;
        (high[0] - low[0]).max(high[1] - low[1]) / (1.0 + 2.0 * MARGIN)
    }
}

/// Points of a contact boundary within an interval.
fn pressing(points: &[TracePoint], [from, to]: [f64; 2]) -> impl Iterator<Item = &TracePoint> {
    let tiny = 1e-9 * (to - from);
    points.iter().filter(move |p| p.arc >= from - tiny && p.arc <= to + tiny)
}

/// Points on the contact boundary where it presses, each with the tip of its pressure, which points into body 2; and the largest
/// pressure.
fn profile(zoom: &ContactZoom, contact: &DrawnContact, boundary: &[[FacetCorner; 2]]) -> (Vec<[[f64; 2]; 2]>, f64) {
    let points: Vec<&TracePoint> = pressing(contact.points, zoom.interval).collect();
    let largest = points.iter().map(|p| p.lambda).fold(0.0, f64::max);
    let tip = |p: &&TracePoint| {
        let [x, y] = moved_point(contact, p, boundary, 1.0);
        let high = HEIGHT * zoom.size() * p.lambda.max(0.0) / largest;
        [[x, y], [x + high * p.normal.x, y + high * p.normal.y]]
    };
    let is_finite = |ends: &[[f64; 2]; 2]| ends.iter().flatten().all(|x| x.is_finite());
    (some_of(&points, MOST_POINTS).map(tip).filter(is_finite).collect(), largest)
}

/// Draws the names of both bodies, each on its side of the middle of the interval.
fn draw_names(canvas: &mut Canvas, chart: &Chart, zoom: &ContactZoom, contact: &DrawnContact, boundary: &[[FacetCorner; 2]]) {
    let middle = 0.5 * (zoom.interval[0] + zoom.interval[1]);
    let distance = |p: &&TracePoint| (p.arc - middle).abs();
    let nearest = pressing(contact.points, zoom.interval).min_by(|a, b| distance(a).total_cmp(&distance(b)));
    let Some(p) = nearest else { return };
    let [x, y] = moved_point(contact, p, boundary, 1.0);
    let letters = Letters { has_rim: true, ..Letters::bold(14.0, INK).at(TextAnchor::Middle) };
    for (name, side) in contact.bodies.into_iter().zip([-AWAY, AWAY]) {
        canvas.text(letters, chart.place([x + side * zoom.size() * p.normal.x, y + side * zoom.size() * p.normal.y]), name);
    }
}
