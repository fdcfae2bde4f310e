//! The deformed bodies.

use std::path::Path;

use plotters::element::PathElement;
use plotters::style::{Color, RGBColor, ShapeStyle};

use super::along::DrawnContact;
use super::facets::{Facet, FacetCorner, boundary_edges, check_facets, displacement_near, facet_bounds, outlines};
use super::macro_edges::{BETWEEN, DrawnEdge, THIN, macro_lines};
use super::palette::{GREY, INK, VERMILION};
use super::sheet::line;
use super::stress::{BAR_ROOM, Colours, draw_colour_bar, fills};
use super::ticks::{number_text, round_number};
use super::view::{PlotRoom, View, bounds};
use crate::output::csv::ContactPoint;
use crate::output::error::OutputError;

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
/// The largest displacement is drawn as about this fraction of the size of the bodies.
const SHOWN_DISPLACEMENT: f64 = 0.05;
/// Points of a contact boundary that are drawn at most, up to a factor of two.
const MOST_POINTS: usize = 1000;
/// Room for the plot.
const ROOM: PlotRoom = PlotRoom { most: [640.0, 560.0], least: [320.0, 220.0], around: 0.0 };

/// Draws `deformed.svg`: the deformed bodies coloured by von Mises stress, their undeformed outlines, and the contact boundaries.
///
/// Displacements are multiplied by a round number that makes the largest about 5 % of the size of the bodies. The title
/// states it. Contact boundaries move along: normal to themselves by the mean of both bodies' normal displacements, along
/// themselves with the nearest boundary. Forces are lines, as wide as they are large. Areas of one colour are merged over
/// triangles, which keeps the file small. Macro edges, if there are any, are thin lines on the deformed bodies, those between two
/// materials thicker ones.
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
    let view = view(around(facets, scale));
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

/// The box around the bodies with and without their displacements, and some room.
fn around(facets: &[Facet], scale: f64) -> [[f64; 2]; 2] {
    let [low, high] = bounds([0.0, scale].into_iter().flat_map(|scale| facet_bounds(facets, scale)));
    let room = 0.03 * (high[0] - low[0]).max(high[1] - low[1]);
    [low.map(|x| x - room), high.map(|x| x + room)]
}

/// A box of the plane with room for the bar of colours.
pub(super) fn view(shown: [[f64; 2]; 2]) -> View {
    View::of(shown, &ROOM, |y| [y.room().max(62), BAR_ROOM, 62, 54])
}

/// The round number that makes the largest displacement about 5 % of the size of the bodies; 1 if nothing moves.
fn automatic_scale(facets: &[Facet]) -> f64 {
    let [low, high] = facet_bounds(facets, 0.0);
    let size = (high[0] - low[0]).max(high[1] - low[1]);
    let largest = facets.iter().flat_map(|facet| facet.displacement).map(|[x, y]| x.hypot(y)).fold(0.0, f64::max);
    if largest > 1e-300 * size { round_number(SHOWN_DISPLACEMENT * size / largest) } else { 1.0 }
}

/// A contact boundary moved along with the bodies; of many points so many that none is missed.
pub(super) fn moved_contact(contact: &DrawnContact, boundary: &[[FacetCorner; 2]], scale: f64) -> Vec<(f64, f64)> {
    some_of(contact.points, MOST_POINTS)
        .map(|p| moved_point(contact, p, boundary, scale))
        .filter(|(x, y)| x.is_finite() && y.is_finite())
        .collect()
}

/// About so many of the points, spread over all of them, with the first and the last.
pub(super) fn some_of<T>(points: &[T], most: usize) -> impl Iterator<Item = &T> {
    let (every, last) = (points.len().div_ceil(most).max(1), points.len().saturating_sub(1));
    points.iter().enumerate().filter(move |(k, _)| k % every == 0 || *k == last).map(|(_, point)| point)
}

/// One point of it: normal to the boundary by the mean of both bodies' normal displacements, along it with the nearest boundary.
pub(super) fn moved_point(contact: &DrawnContact, p: &ContactPoint, boundary: &[[FacetCorner; 2]], scale: f64) -> (f64, f64) {
    let there = if contact.is_deformed { 1.0 } else { 0.0 };
    let u = displacement_near([p.x, p.y], boundary, there);
    let (along, across) = (p.nx * u[1] - p.ny * u[0], 0.5 * (p.un_1 + p.un_2));
    let left = scale - there;
    (p.x + left * (across * p.nx - along * p.ny), p.y + left * (across * p.ny + along * p.nx))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::plot::facets::tests::block;

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
