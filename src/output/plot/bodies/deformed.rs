//! The deformed bodies.

use std::path::Path;

use super::facets::{
    CONTACT, Facet, FacetCorner, boundary_edges, check_facets, displacement_near, draw_outlines, facet_bounds, moved_contact,
};
use super::peaks::draw_peaks;
use super::stress::{BAR_ROOM, Colours, draw_colour_bar, draw_stress};
use crate::element::StressMeasure;
use crate::output::error::OutputError;
use crate::output::plot::diagrams::DrawnContact;
use crate::output::plot::drawing::*;
use crate::output::summary::BodySummary;
use crate::output::units::Units;

/// An edge of the macro mesh as the figure shows it: undeformed points from end to end, and their displacements.
#[derive(Clone, Debug)]
pub struct DrawnEdge(pub Vec<([f64; 2], [f64; 2])>);

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
/// Bodies that press are drawn over each other, or apart, by this share of their size at most: a few pixels.
const SHOWN_OVERLAP: f64 = 0.01;
/// A contact presses where its pressure is more than this share of the largest.
const PRESSES: f64 = 1e-3;
/// The macro mesh, and edges between two materials.
const THIN: Paint = Paint::line(WHITE, 0.4).faint(0.75);
const BETWEEN: Paint = Paint::line(WHITE, 1.2);
/// Room for the plot.
const ROOM: PlotRoom = PlotRoom { most: [640.0, 560.0], least: [320.0, 220.0], around: 0.0 };

/// What `deformed.svg` and `field_sigma_1.svg` show: the deformed bodies coloured by a measure of the stress, their undeformed
/// outlines, and the contact boundaries.
///
/// Displacements are multiplied by a round number that makes the largest about 5 % of the size of the bodies, or by less where bodies
/// that press would be drawn into each other. The title states it. Contact boundaries move along: normal to themselves by the mean of both bodies' normal displacements, along
/// themselves with the nearest boundary. Areas of one colour are merged over triangles, which keeps the file small.
#[derive(Clone, Copy, Debug, Default)]
pub struct DeformedFigure<'a> {
    /// Stands above.
    pub title: &'a str,
    /// What the colours are of.
    pub measure: StressMeasure,
    /// All bodies.
    pub facets: &'a [Facet],
    /// Edges of the macro mesh, thin lines on the deformed bodies.
    pub macro_edges: &'a [DrawnEdge],
    /// Edges between two materials, thicker ones.
    pub interfaces: &'a [DrawnEdge],
    /// Contact boundaries.
    pub contacts: &'a [DrawnContact<'a>],
    /// Whether they are so many that the lines of their forces alone say where they are.
    pub are_contacts_many: bool,
    /// Forces: lines, as wide as they are large.
    pub forces: &'a [DrawnForce],
    /// The largest stress of each body, by its name.
    pub peaks: &'a [(String, BodySummary)],
    /// Whether bodies of revolution are shown, with their axis.
    pub has_axis: bool,
    /// The units of the case.
    pub units: &'a Units,
}

impl DeformedFigure<'_> {
    /// Draws it.
    ///
    /// # Errors
    /// There is no facet, or a number is not finite; the operating system refuses.
    pub fn write(&self, path: &Path) -> Result<(), OutputError> {
        let Self { facets, contacts, .. } = *self;
        check_facets(path, facets)?;
        let (scale, colours, boundary) =
            (automatic_scale(facets, contacts), Colours::of(facets, self.measure), boundary_edges(facets));
        let contacts = if self.are_contacts_many { &[][..] } else { contacts };
        let shown = around(facets, scale);
        let (mut canvas, chart) = plane(if self.has_axis { up_to_the_axis(shown) } else { shown }, self.has_axis, self.units);
        let largest = self.forces.iter().map(DrawnForce::size).fold(0.0, f64::max);
        let mut legend = vec![LegendCell::lines("undeformed", &[Paint::line(GREY, 0.7)])];
        if !contacts.is_empty() {
            legend.push(LegendCell::lines("contact boundary", &CONTACT));
        }
        if largest > 0.0 {
            let words = format!("contact force, up to {}{}", number_text(largest), self.units.resultant().after());
            legend.push(LegendCell::lines(words, &[Paint::line(VERMILION, 0.5 * FORCE_WIDTHS[0])]));
        }
        legend.extend(colours.remark(self.units.stress()));
        chart.draw_head(&mut canvas, &format!("{}, displacements × {}", self.title, number_text(scale)), &[legend]);
        draw_outlines(&mut canvas, &chart, &boundary, 0.0, GREY);
        draw_stress(&mut canvas, &chart, facets, scale, &colours);
        for (edges, paint) in [(self.macro_edges, THIN), (self.interfaces, BETWEEN)] {
            canvas.lines(paint, edges.iter().map(|edge| edge.moved(scale).map(|x| chart.place(x))));
        }
        draw_outlines(&mut canvas, &chart, &boundary, scale, INK);
        for contact in contacts {
            let moved = moved_contact(contact, &boundary, scale);
            CONTACT.iter().for_each(|paint| canvas.line(*paint, moved.iter().map(|x| chart.place(*x))));
        }
        let [widest, least] = FORCE_WIDTHS;
        for force in self.forces.iter().filter(|force| force.size() * widest > least * largest) {
            let paint = Paint::line(VERMILION, widest * force.size() / largest).faint(0.8);
            canvas.line(paint, force.line(&boundary, scale).map(|x| chart.place(x)));
        }
        draw_peaks(&mut canvas, &chart, self.peaks, (scale, self.units.stress()));
        chart.draw_axes(&mut canvas, false);
        draw_colour_bar(&mut canvas, &chart, &colours, self.units.stress());
        canvas.write(path)
    }
}

impl DrawnEdge {
    fn moved(&self, scale: f64) -> impl Iterator<Item = [f64; 2]> {
        self.0.iter().map(move |(x, u)| [0, 1].map(|axis| x[axis] + scale * u[axis]))
    }
}

impl DrawnForce {
    fn size(&self) -> f64 {
        Some(self.force[0].hypot(self.force[1])).filter(|size| size.is_finite()).unwrap_or(0.0)
    }

    /// Its line, moved along with the nearest boundary.
    fn line(&self, boundary: &[[FacetCorner; 2]], scale: f64) -> [[f64; 2]; 2] {
        let there = if self.is_deformed { 1.0 } else { 0.0 };
        let u = displacement_near(self.place, boundary, there);
        let [x, y] = [0, 1].map(|axis| self.place[axis] + (scale - there) * u[axis]);
        let [dx, dy] = self.force.map(|part| self.reach * part / self.size());
        [[x - dx, y - dy], [x + dx, y + dy]]
    }
}

/// The box around the bodies with and without their displacements, and some room.
fn around(facets: &[Facet], scale: f64) -> [[f64; 2]; 2] {
    let [low, high] = bounds([0.0, scale].into_iter().flat_map(|scale| facet_bounds(facets, scale)));
    let room = 0.03 * (high[0] - low[0]).max(high[1] - low[1]);
    [low.map(|x| x - room), high.map(|x| x + room)]
}

/// A canvas for a box of the plane, with room for the bar of colours.
pub fn plane(shown: [[f64; 2]; 2], has_axis: bool, units: &Units) -> (Canvas, Chart) {
    let chart = Chart::of_plane(shown, &ROOM, [HEAD, BAR_ROOM], (has_axis, units.length()));
    (Canvas::new(chart.panel.extent()), chart)
}

/// The round number that makes the largest displacement about 5 % of the size of the bodies, or a smaller one where bodies that press
/// would be drawn into each other, or apart, by more than can be overlooked; 1 if nothing moves.
fn automatic_scale(facets: &[Facet], contacts: &[DrawnContact]) -> f64 {
    let [low, high] = facet_bounds(facets, 0.0);
    let size = (high[0] - low[0]).max(high[1] - low[1]);
    let largest = facets.iter().flat_map(|facet| facet.displacement).map(|[x, y]| x.hypot(y)).fold(0.0, f64::max);
    let scale = if largest > 1e-300 * size { round_number(SHOWN_DISPLACEMENT * size / largest) } else { 1.0 };
    // What presses has closed a gap, which the factor makes an overlap: less one, times the gap.
    let closed = contacts.iter().map(closed_gap).fold(0.0, f64::max);
    let most = 1.0 + SHOWN_OVERLAP * size / closed;
    if scale <= most { scale } else { floor_number(most) }
}

/// The widest gap, or the deepest overlap, of the bodies as they are drawn that a contact has closed where it presses.
fn closed_gap(contact: &DrawnContact) -> f64 {
    let largest = contact.points.iter().map(|point| point.lambda).fold(0.0, f64::max);
    let pressing = contact.points.iter().filter(|point| point.lambda > PRESSES * largest);
    pressing.map(|point| (point.displacement[0] - point.displacement[1]).abs()).fold(0.0, f64::max)
}

/// The largest of the numbers 1, 2 and 5 times a power of ten that is not above a positive number.
fn floor_number(number: f64) -> f64 {
    let nearest = round_number(number);
    if nearest > number { round_number(nearest / 2.2) } else { nearest }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Point;
    use crate::output::plot::bodies::samples::block;
    use crate::output::plot::drawing::{diverging, viridis};
    use crate::recovery::TracePoint;

    fn drawn(points: &[TracePoint]) -> DrawnContact<'_> {
        DrawnContact { title: "blocks", bodies: ["left", "right"], points, is_deformed: false, units: Default::default() }
    }

    fn draw(facets: &[Facet]) -> Result<String, OutputError> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("deformed.svg");
        let contact =
            [0.0, 0.5, 1.0].map(|s| TracePoint { arc: s, x: Point::new(1.0, s), normal: Point::x(), ..TracePoint::default() });
        let figure = DeformedFigure { title: "blocks", facets, contacts: &[drawn(&contact)], ..DeformedFigure::default() };
        figure.write(&path).map(|()| std::fs::read_to_string(path).unwrap())
    }

    #[test]
    fn scale_is_round_and_stated() {
        let facets = block(0.0, 4, |x, _| [3e-5 * x, 0.0], |x, _| x);
        assert_eq!(automatic_scale(&facets, &[]), 2000.0);
        assert!(draw(&facets).unwrap().contains("blocks, displacements × 2000"));
        assert_eq!(automatic_scale(&block(0.0, 1, |_, _| [0.0, 0.0], |_, _| 0.0), &[]), 1.0);
    }

    /// Bodies of size 1 that have closed a gap of 1e-4: an overlap of .01 is that of a factor of 101.
    #[test]
    fn bodies_that_press_are_drawn_touching() {
        let facets = block(0.0, 4, |x, _| [3e-5 * x, 0.0], |x, _| x);
        let point = |lambda, un_1, un_2| TracePoint { lambda, displacement: [un_1, un_2], ..TracePoint::default() };
        let scale = |points: &[TracePoint]| automatic_scale(&facets, &[drawn(points)]);
        assert_eq!(scale(&[point(1.0, 0.6e-4, -0.4e-4), point(0.0, 1.0, 0.0)]), 100.0);
        assert_eq!(scale(&[point(1.0, -1e-2, 1e-2)]), 1.0);
        assert_eq!(scale(&[point(1.0, 1e-5, 1e-5)]), 2000.0, "they have moved together");
        assert_eq!([1.0, 1.9, 4.99, 7.2, 99.0, 0.3].map(floor_number), [1.0, 1.0, 2.0, 5.0, 50.0, 0.2]);
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
        let point = TracePoint { x: Point::new(1.0, 0.5), normal: Point::x(), displacement: [0.2, 0.4], ..TracePoint::default() };
        let edges = boundary_edges(&facets);
        let moved = moved_contact(&drawn(&[point]), &edges, 10.0);
        assert!((moved[0][0] - 4.0).abs() < 1e-6 && (moved[0][1] - 1.0).abs() < 1e-6, "{moved:?}");
        // Where contact is modelled on the deformed bodies it lies there already.
        let there = TracePoint { x: Point::new(1.3, 0.55), ..point };
        let moved = moved_contact(&DrawnContact { is_deformed: true, ..drawn(&[there]) }, &edges, 1.0);
        assert_eq!(moved, [[1.3, 0.55]]);
    }

    #[test]
    fn forces_are_lines_as_wide_as_they_are_large() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("deformed.svg");
        let facets = block(0.0, 4, |_, _| [0.0, 1e-3], |_, _| 1.0);
        let force = |x: f64, size: f64| DrawnForce { place: [x, 0.5], force: [0.0, size], reach: 0.25, is_deformed: false };
        let forces = [force(0.2, 8.0), force(0.5, -4.0), force(0.8, 0.0), force(0.9, f64::NAN), force(0.9, 1e-3)];
        DeformedFigure { facets: &facets, forces: &forces, ..DeformedFigure::default() }.write(&path).unwrap();
        let figure = std::fs::read_to_string(path).unwrap();
        let widths = [90, 45].map(|width| figure.matches(&format!("stroke-width=\"{width}\"")).count());
        // The line of the legend is half as wide as that of the largest force.
        assert_eq!(widths, [1, 2]);
        assert!(figure.contains("contact force, up to 8") && !figure.contains("NaN"));
        let moved = force(0.0, 2.0).line(&boundary_edges(&facets), 100.0);
        assert!((moved[0][1] - 0.35).abs() < 1e-9 && (moved[1][1] - 0.85).abs() < 1e-9, "{moved:?}");
    }

    #[test]
    fn macro_edges_are_thin_lines_that_move_with_the_bodies() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("deformed.svg");
        let facets = block(0.0, 4, |_, y| [0.0, 1e-3 * y], |_, _| 1.0);
        let edge = |x: f64| DrawnEdge([0.0, 0.5, 1.0].map(|y| ([x, y], [0.0, 1e-3 * y])).into());
        let mut edges = vec![edge(0.0), edge(0.25), edge(0.5)];
        edges[2].0[1].1 = [f64::NAN, 0.0];
        DeformedFigure { facets: &facets, macro_edges: &edges, ..DeformedFigure::default() }.write(&path).unwrap();
        let figure = std::fs::read_to_string(path).unwrap();
        let is_mesh = |line: &&str| line.contains("opacity=\"0.75\"");
        let lines: Vec<&str> = figure.lines().filter(is_mesh).collect();
        let [line] = lines[..] else { panic!("{lines:?}") };
        assert!(line.matches('M').count() == 2 && !line.contains("z\"") && !figure.contains("NaN"), "{line}");
        let moved: Vec<[f64; 2]> = edges[1].moved(100.0).collect();
        assert!(moved[0] == [0.25, 0.0] && (moved[2][1] - 1.1).abs() < 1e-12, "{moved:?}");
        assert!(!draw(&facets).unwrap().lines().any(|line| is_mesh(&line)), "no mesh unless there are macro edges");
    }

    /// The axis is shown where bodies are no farther from it than they are wide; where it lies far away, the title of x says radius.
    #[test]
    fn bodies_of_revolution_are_drawn_with_their_axis() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("deformed.svg");
        for (left, axes) in [(0.0, 1), (0.8, 1), (3.0, 0)] {
            let facets = block(left, 4, |_, _| [0.0, 1e-3], |_, _| 1.0);
            let figure = DeformedFigure { facets: &facets, has_axis: true, ..DeformedFigure::default() };
            figure.write(&path).unwrap();
            let text = std::fs::read_to_string(&path).unwrap();
            assert_eq!(text.matches("stroke-dasharray=\"120 30 20 30\"").count(), axes, "bodies from x = {left} on");
            assert!(text.contains("radius x"));
            DeformedFigure { has_axis: false, ..figure }.write(&path).unwrap();
            let text = std::fs::read_to_string(&path).unwrap();
            assert!(!text.contains("stroke-dasharray") && !text.contains("radius"), "in the plane there is none");
        }
    }

    /// A bar pulled by 2 at its left and pushed by 1 at its right: colours of both signs, and as strong as their values are large.
    #[test]
    fn stress_with_a_sign_has_two_colours_and_light_for_zero() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("field.svg");
        let facets = block(0.0, 30, |_, _| [0.0, 0.0], |x, _| 2.0 - 3.0 * x);
        let figure = DeformedFigure { measure: StressMeasure::Xx, facets: &facets, ..DeformedFigure::default() };
        figure.write(&path).unwrap();
        let text = std::fs::read_to_string(&path).unwrap();
        let has = |value: f64| text.contains(&format!("<path fill=\"{}\"", diverging(value)));
        let levels = (0..40).map(|level| (-1.0 + (f64::from(level) + 0.5) / 40.0 * 3.0) / 2.0);
        assert!(levels.clone().all(has) && !has(-1.0) && levels.count() == 40, "{text}");
        assert!(
            [">−1.0<", ">0.0<", ">2.0<", ">stress σ xx [unit of stress]<"].iter().all(|words| text.contains(words)),
            "{text}"
        );
        DeformedFigure { measure: StressMeasure::Shear, ..figure }.write(&path).unwrap();
        let text = std::fs::read_to_string(&path).unwrap();
        assert!(text.contains("largest shear stress τ") && !text.contains(">−") && text.contains(&viridis(1.0).to_string()));
    }

    #[test]
    fn peaks_of_stress_take_the_last_colour() {
        let mut facets = block(0.0, 20, |_, _| [0.0, 0.0], |_, _| 2.0);
        facets[0].stress = [[100.0, 0.0, 0.0, 0.0]; 3];
        assert!(draw(&facets).unwrap().contains("stress up to 100"));
        facets[0].stress[1][2] = f64::NAN;
        assert!(matches!(draw(&facets), Err(OutputError::Figure { .. })));
        assert!(matches!(draw(&[]), Err(OutputError::Figure { .. })));
    }
}
