//! The triangles of bodies as figures show them, the boundary around them, and what moves along with it.

use std::path::Path;

use crate::element::StressMeasure;
use crate::output::error::OutputError;
use crate::output::plot::diagrams::DrawnContact;
use crate::output::plot::drawing::{Canvas, Chart, Colour, INK, Paint, WHITE, bounds, loops, path_data, tenths, unmatched};
use crate::recovery::TracePoint;

/// Points of a contact boundary that are drawn at most, up to a factor of two.
const MOST_POINTS: usize = 1000;

/// How a contact boundary is drawn: lines that lie on each other.
pub const CONTACT: [Paint; 2] = [Paint::line(INK, 3.0), Paint::line(WHITE, 1.4)];

/// A triangle of a body as the figure shows it: corners alone, stress linear between them.
#[derive(Clone, Copy, Debug)]
pub struct Facet {
    /// Undeformed corners, counter-clockwise.
    pub corners: [[f64; 2]; 3],
    /// Their displacements.
    pub displacement: [[f64; 2]; 3],
    /// Stress (xx, yy, xy, zz) at the corners.
    pub stress: [[f64; 4]; 3],
}

impl Facet {
    /// A measure of the stress at the corners.
    pub fn values(&self, measure: StressMeasure) -> [f64; 3] {
        self.stress.map(|stress| measure.of(stress))
    }

    /// Its corners with their displacements.
    pub fn deformed(&self, scale: f64) -> [[f64; 2]; 3] {
        std::array::from_fn(|k| [0, 1].map(|axis| self.corners[k][axis] + scale * self.displacement[k][axis]))
    }
}

/// Refuses facets that cannot be drawn.
pub fn check_facets(path: &Path, facets: &[Facet]) -> Result<(), OutputError> {
    let finite = |facet: &Facet| {
        let numbers = facet.corners.iter().chain(&facet.displacement).flatten();
        numbers.chain(facet.stress.as_flattened()).all(|number| number.is_finite())
    };
    let reason = match facets {
        [] => "there is no triangle",
        _ if !facets.iter().all(finite) => "a displacement or stress is not finite",
        _ => return Ok(()),
    };
    Err(OutputError::Figure { path: path.into(), reason: reason.into() })
}

/// Lower left and upper right corner of the box around all facets with their displacements.
pub fn facet_bounds(facets: &[Facet], scale: f64) -> [[f64; 2]; 2] {
    bounds(facets.iter().flat_map(|facet| facet.deformed(scale)))
}

/// A corner of a facet by its bits: position, rounded, and displacement, so that bodies that touch keep their own corners.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct FacetCorner([u64; 4]);

impl FacetCorner {
    /// Macro triangles that share a node place it alike up to rounding; here it has one place, a multiple of `unit`.
    fn new(x: [f64; 2], u: [f64; 2], unit: f64) -> FacetCorner {
        let [x, y] = x.map(|x| (x / unit).round() * unit);
        FacetCorner([x, y, u[0], u[1]].map(|number| (number + 0.0).to_bits()))
    }

    fn displacement(self) -> [f64; 2] {
        [self.0[2], self.0[3]].map(f64::from_bits)
    }

    pub fn deformed(self, scale: f64) -> [f64; 2] {
        let u = self.displacement();
        [0, 1].map(|axis| f64::from_bits(self.0[axis]) + scale * u[axis])
    }
}

/// The edges of facets that have a body on one side only.
pub fn boundary_edges(facets: &[Facet]) -> Vec<[FacetCorner; 2]> {
    let [low, high] = facet_bounds(facets, 0.0);
    let far = low.iter().chain(&high).fold(0.0, |far: f64, x| far.max(x.abs()));
    // Coordinates of drawings are seldom halves of this.
    let unit = (1.37e-8 * (high[0] - low[0]).max(high[1] - low[1])).max(1.37e-13 * far).max(f64::MIN_POSITIVE);
    unmatched(facets.iter().flat_map(|facet| {
        let [a, b, c] = [0, 1, 2].map(|k| FacetCorner::new(facet.corners[k], facet.displacement[k], unit));
        [[a, b], [b, c], [c, a]]
    }))
}

/// The displacement at the point of the boundary, deformed by `there`, that is nearest to a point.
pub fn displacement_near(point: [f64; 2], boundary: &[[FacetCorner; 2]], there: f64) -> [f64; 2] {
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

/// A contact boundary moved along with the bodies; of many points so many that none is missed.
pub fn moved_contact(contact: &DrawnContact, boundary: &[[FacetCorner; 2]], scale: f64) -> Vec<[f64; 2]> {
    some_of(contact.points, MOST_POINTS)
        .map(|p| moved_point(contact, p, boundary, scale))
        .filter(|x| x.iter().all(|x| x.is_finite()))
        .collect()
}

/// About so many of the points, spread over all of them, with the first and the last.
pub fn some_of<T>(points: &[T], most: usize) -> impl Iterator<Item = &T> {
    let (every, last) = (points.len().div_ceil(most).max(1), points.len().saturating_sub(1));
    points.iter().enumerate().filter(move |(k, _)| k % every == 0 || *k == last).map(|(_, point)| point)
}

/// One point of it: normal to the boundary by the mean of both bodies' normal displacements, along it with the nearest boundary.
pub fn moved_point(contact: &DrawnContact, p: &TracePoint, boundary: &[[FacetCorner; 2]], scale: f64) -> [f64; 2] {
    let there = if contact.is_deformed { 1.0 } else { 0.0 };
    let u = displacement_near([p.x.x, p.x.y], boundary, there);
    let (along, across) = (p.normal.x * u[1] - p.normal.y * u[0], 0.5 * (p.displacement[0] + p.displacement[1]));
    let left = scale - there;
    [p.x.x + left * (across * p.normal.x - along * p.normal.y), p.x.y + left * (across * p.normal.y + along * p.normal.x)]
}

/// Draws the outlines of the bodies as one path.
pub fn draw_outlines(canvas: &mut Canvas, chart: &Chart, boundary: &[[FacetCorner; 2]], scale: f64, colour: Colour) {
    let placed = |points: Vec<FacetCorner>| points.iter().filter_map(|node| tenths(chart.place(node.deformed(scale)))).collect();
    let loops: Vec<Vec<(i32, i32)>> = loops(boundary).into_iter().map(placed).collect();
    canvas.path(Paint::line(colour, 0.7), &path_data(&loops));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::plot::bodies::samples::block;

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
}
