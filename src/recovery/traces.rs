//! Both bodies' traces along Γ_C.

use crate::contact::{Distance, EdgeOverlap, GapChoice, edge_overlaps, trace};
use crate::discretisation::{Contact, ContactPressure, Discretisation, Field, SystemError, agreed};
use crate::element::{by_order, heated_stress};
use crate::geometry::{Point, gauss_points};
use crate::mesh::BoundaryEdge;
use crate::petsc::Session;

/// Gauss points of each part of Γ_C that results are given at.
const POINTS: usize = 2;

/// Parts of the way between two nodes at whose ends a declared gap is looked at: a hump a thirtieth of it wide is seen.
const SAMPLES: usize = 32;

/// Sums of each body at a point: a count, and the values of [`BodyTrace::on_edge`].
const VALUES: usize = 5;

/// Points whose values are added up over the ranks at once.
const AT_ONCE: usize = 1 << 14;

/// Values at one point of Γ_C. Where λ jumps, two points with the same arc length carry both values.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TracePoint {
    /// Arc length from the start.
    pub arc: f64,
    /// The point.
    pub x: Point,
    /// Normal, from body 1 to body 2.
    pub normal: Point,
    /// Contact pressure.
    pub lambda: f64,
    /// Normal displacement of body 1 and of body 2; not a number where a body has no corresponding point.
    pub displacement: [f64; 2],
    /// Way of body 2 along body 1, to where the arc length grows.
    pub slip: f64,
    /// `n·σn` of each body.
    pub stress: [f64; 2],
    /// Undeformed distance along the normal from Γ_C to each corresponding point.
    pub distance: [f64; 2],
    /// Distance of the deformed bodies, as the contact conditions mean it.
    pub gap: f64,
}

impl TracePoint {
    /// The larger one of both normal displacements, by magnitude (length).
    pub fn largest_displacement(&self) -> f64 {
        self.displacement[0].abs().max(self.displacement[1].abs())
    }

    /// Whether both bodies have a corresponding point here.
    pub fn is_complete(&self) -> bool {
        self.displacement.iter().all(|u| u.is_finite())
    }
}

/// Values along Γ_C at both ends, at the Gauss points of the union of segment ends and both bodies' projected nodes,
/// and on both sides of every jump of λ; in order of arc length, the same on every rank. **Collective**
///
/// # Errors
/// [`SystemError`] where a triangle is inverted.
pub fn trace_points(problem: &Discretisation, pressure: &ContactPressure, u: &Field<2>) -> Result<Vec<TracePoint>, SystemError> {
    let contact = pressure.contact;
    let own = [0, 1].map(|body| {
        let overlaps = edge_overlaps(&contact.boundary, &contact.edges[body]);
        BodyTrace { problem, contact, body, overlaps }
    });
    let cuts: Vec<f64> = own.iter().flat_map(|trace| &trace.overlaps).flat_map(|overlap| overlap.range).collect();
    let (parameters, segments) = parameters(contact, &cuts, &problem.session);
    let mut points = Vec::with_capacity(parameters.len());
    for (parameters, segments) in parameters.chunks(AT_ONCE).zip(segments.chunks(AT_ONCE)) {
        let mut sums = vec![[0.0; 2 * VALUES]; parameters.len()];
        let added = own.iter().try_for_each(|trace| trace.add(parameters, u, &mut sums));
        agreed(&problem.session, added)?;
        problem.session.sum(sums.as_flattened_mut());
        points.extend((0..parameters.len()).map(|at| point(pressure, parameters[at], segments[at], &sums[at])));
    }
    Ok(points)
}

/// The trace of one body on the edges of this rank.
struct BodyTrace<'a> {
    problem: &'a Discretisation,
    contact: &'a Contact,
    /// Which body: 1 (0) or 2 (1).
    body: usize,
    overlaps: Vec<EdgeOverlap>,
}

impl BodyTrace<'_> {
    /// Adds its values to the sums of some points, ascending: a count, displacement, stress, distance, and displacement along Γ_C.
    fn add(&self, parameters: &[f64], u: &Field<2>, sums: &mut [[f64; 2 * VALUES]]) -> Result<(), SystemError> {
        let [start, end] = self.contact.boundary.ends();
        let tolerance = 1e-12 * (end - start);
        for overlap in &self.overlaps {
            let [from, to] = overlap.range;
            let first = parameters.partition_point(|&t| t < from - tolerance);
            let last = parameters.partition_point(|&t| t <= to + tolerance);
            for at in first..last {
                let edge = &self.contact.edges[self.body][overlap.edge];
                let values = self.on_edge(edge, parameters[at], u)?;
                let sums = &mut sums[at][VALUES * self.body..VALUES * (self.body + 1)];
                sums.iter_mut().zip(std::iter::once(1.0).chain(values)).for_each(|(sum, value)| *sum += value);
            }
        }
        Ok(())
    }

    /// Normal displacement, `n·σn`, distance, and displacement along Γ_C, of the trace on one edge.
    fn on_edge(&self, small: &BoundaryEdge, t: f64, u: &Field<2>) -> Result<[f64; VALUES - 1], SystemError> {
        let Self { problem, contact, .. } = self;
        let boundary = &contact.boundary;
        let here = trace(boundary, small, t);
        let normal = boundary.normal(t);
        let moved = small.nodes.iter().zip(here.values).fold(Point::zeros(), |sum, (node, value)| {
            sum + value * u.point(node.number(&problem.scene.mesh, &problem.finest().numbering))
        });
        let s = by_order!(problem.finest().numbering.level.order, stress_beside(problem, small, here.fraction, u))?;
        let pressure = s[0] * normal.x * normal.x + s[1] * normal.y * normal.y + 2.0 * s[2] * normal.x * normal.y;
        let x = boundary.point(t);
        let distance = match contact.distance(self.body) {
            // Boundaries that are said to touch: how far they do is seen on the mesh.
            Distance::Declared => (here.place - x).dot(&normal),
            measured => measured.at(x, normal, here.place).map_err(SystemError::Case)?,
        };
        Ok([moved.dot(&normal), pressure, distance, moved.dot(&boundary.tangent(t))])
    }
}

/// The point at a parameter, from what the ranks have added up.
fn point(pressure: &ContactPressure, t: f64, segment: usize, sums: &[f64; 2 * VALUES]) -> TracePoint {
    let (contact, knots) = (pressure.contact, pressure.contact.boundary.knots());
    let mean = |side: usize, i: usize| sums[VALUES * side + 1 + i] / sums[VALUES * side];
    let z = ((t - knots[segment]) / (knots[segment + 1] - knots[segment])).clamp(0.0, 1.0);
    let (x, distance) = (contact.boundary.point(t), [mean(0, 2), mean(1, 2)]);
    let displacement = [mean(0, 0), mean(1, 0)];
    TracePoint {
        arc: contact.boundary.arc(t),
        x,
        normal: contact.boundary.normal(t),
        lambda: pressure.value(segment, z),
        displacement,
        slip: mean(1, 3) - mean(0, 3),
        stress: [mean(0, 1), mean(1, 1)],
        distance,
        gap: contact.pair.gap.at_rest(x, distance) + displacement[1] - displacement[0],
    }
}

/// Parameters of all points, ascending, and the segment each belongs to.
fn parameters(contact: &Contact, cuts: &[f64], session: &Session) -> (Vec<f64>, Vec<usize>) {
    let knots = contact.boundary.knots();
    let mut all = session.gather_all(cuts);
    all.extend_from_slice(knots);
    all.sort_by(f64::total_cmp);
    let least = 1e-10 * (knots[knots.len() - 1] - knots[0]);
    all.dedup_by(|b, a| *b - *a < least);
    let (mut parameters, mut segments) = (vec![knots[0]], vec![0]);
    for ends in all.windows(2) {
        let segment = contact.boundary.locate(0.5 * (ends[0] + ends[1])).0;
        if segment != segments[segments.len() - 1] {
            // Both values of a jump.
            parameters.extend([knots[segment], knots[segment]]);
            segments.extend([segment - 1, segment]);
        }
        let mut points: Vec<f64> = gauss_points(POINTS).iter().map(|(z, _)| ends[0] + z * (ends[1] - ends[0])).collect();
        points.extend(narrow_dip(contact, [ends[0], points[0], points[1], ends[1]]));
        points.sort_by(f64::total_cmp);
        segments.extend(points.iter().map(|_| segment));
        parameters.extend(points);
    }
    parameters.push(knots[knots.len() - 1]);
    segments.push(contact.boundary.segments() - 1);
    (parameters, segments)
}

/// Where a gap that the case declares is lowest between points, if it is lower by more than it differs among them: a hump that is narrower
/// than an edge. That of a parabola is at most half as deep, and of a constant there is none but by rounding.
fn narrow_dip(contact: &Contact, points: [f64; 4]) -> Option<f64> {
    let GapChoice::Formula(formula) = &contact.pair.gap else { return None };
    let gap = |t: f64| {
        let x = contact.boundary.point(t);
        formula.value(&[x.x, x.y])
    };
    let [least, most] = [f64::min, f64::max].map(|pick| points.map(gap).into_iter().reduce(pick).unwrap_or(f64::NAN));
    let between = (1..SAMPLES).map(|k| points[0] + k as f64 / SAMPLES as f64 * (points[3] - points[0]));
    let lowest = between.min_by(|a, b| gap(*a).total_cmp(&gap(*b)))?;
    (least - gap(lowest) > (most - least).max(1e-12 * least.abs())).then_some(lowest)
}

/// Stress on a boundary edge, in the triangle beside it.
fn stress_beside<const N: usize>(
    problem: &Discretisation,
    small: &BoundaryEdge,
    fraction: f64,
    u: &Field<2>,
) -> Result<[f64; 4], SystemError> {
    let (law, heat) = problem.material(small.triangle);
    let element = problem.element::<N>(small.triangle, small.beside);
    Ok(heated_stress(&element.x, &u.on(&element), small.barycentric(fraction), &law, heat)?)
}
