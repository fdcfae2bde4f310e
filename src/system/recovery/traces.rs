//! Both bodies' traces along Γ_C.

use super::{agreed, nodal};
use crate::body::positions;
use crate::contact::{Distance, edge_overlaps, trace};
use crate::element::{Order, PlaneLaw, stress};
use crate::geometry::{Point, gauss_points};
use crate::mesh::BoundaryEdge;
use crate::petsc::Session;
use crate::system::{Contact, ContactPressure, Discretisation, Field, SystemError};

/// Gauss points of each part of Γ_C that results are given at.
const POINTS: usize = 2;

/// Sums of each body at a point: a count, and the values of [`on_edge`].
const VALUES: usize = 5;

/// Values at one point of Γ_C.
#[derive(Clone, Copy, Debug, PartialEq)]
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
pub fn trace_points(
    problem: &Discretisation,
    pressure: &ContactPressure,
    u: &Field<2>,
    session: &Session,
) -> Result<Vec<TracePoint>, SystemError> {
    let (contact, laws) = (pressure.contact, problem.scene.laws());
    let own = [0, 1].map(|k| edge_overlaps(&contact.boundary, &contact.edges[k]));
    let (parameters, segments) =
        parameters(contact, &own.iter().flatten().flat_map(|overlap| overlap.range).collect::<Vec<_>>(), session);
    // Sums over ranks of (count, displacement, stress, distance, displacement along Γ_C) for both bodies.
    let mut sums = vec![[0.0; 2 * VALUES]; parameters.len()];
    let tolerance = 1e-12 * (parameters[parameters.len() - 1] - parameters[0]);
    let mut add = |k: usize| -> Result<(), SystemError> {
        for overlap in &own[k] {
            let [from, to] = overlap.range;
            let first = parameters.partition_point(|&t| t < from - tolerance);
            let last = parameters.partition_point(|&t| t <= to + tolerance);
            for at in first..last {
                let small = &contact.edges[k][overlap.edge];
                let values = on_edge(problem, &laws, contact, k, small, parameters[at], u)?;
                sums[at][VALUES * k] += 1.0;
                values.iter().enumerate().for_each(|(i, value)| sums[at][VALUES * k + 1 + i] += value);
            }
        }
        Ok(())
    };
    let added = add(0).and_then(|()| add(1));
    agreed(session, added)?;
    session.sum(sums.as_flattened_mut());
    let knots = contact.boundary.knots();
    let point = |(at, &t): (usize, &f64)| {
        let k = segments[at];
        let mean = |side: usize, i: usize| sums[at][VALUES * side + 1 + i] / sums[at][VALUES * side];
        let z = ((t - knots[k]) / (knots[k + 1] - knots[k])).clamp(0.0, 1.0);
        let (x, distance) = (contact.boundary.point(t), [mean(0, 2), mean(1, 2)]);
        let displacement = [mean(0, 0), mean(1, 0)];
        TracePoint {
            arc: contact.boundary.arc(t),
            x,
            normal: contact.boundary.normal(t),
            lambda: pressure.value(k, z),
            displacement,
            slip: mean(1, 3) - mean(0, 3),
            stress: [mean(0, 1), mean(1, 1)],
            distance,
            gap: contact.pair.gap.at_rest(x, distance) + displacement[1] - displacement[0],
        }
    };
    Ok(parameters.iter().enumerate().map(point).collect())
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
        for (z, _) in gauss_points(POINTS) {
            parameters.push(ends[0] + z * (ends[1] - ends[0]));
            segments.push(segment);
        }
    }
    parameters.push(knots[knots.len() - 1]);
    segments.push(contact.boundary.segments() - 1);
    (parameters, segments)
}

/// Normal displacement, `n·σn`, distance, and displacement along Γ_C, of the trace on one edge of body 1 (0) or 2 (1).
fn on_edge(
    problem: &Discretisation,
    laws: &[PlaneLaw],
    contact: &Contact,
    body: usize,
    small: &BoundaryEdge,
    t: f64,
    u: &Field<2>,
) -> Result<[f64; VALUES - 1], SystemError> {
    let here = trace(&contact.boundary, small, t);
    let normal = contact.boundary.normal(t);
    let moved = small.nodes.iter().zip(here.values).fold(Point::zeros(), |sum, (node, value)| {
        sum + value * u.point(node.number(&problem.scene.mesh, &problem.finest().numbering))
    });
    let law = &laws[problem.scene.mesh.triangles[small.triangle].part as usize];
    let s = match problem.finest().numbering.level.order {
        Order::P1 => stress_beside::<3>(problem, small, here.fraction, u, law)?,
        Order::P2 => stress_beside::<6>(problem, small, here.fraction, u, law)?,
    };
    let pressure = s[0] * normal.x * normal.x + s[1] * normal.y * normal.y + 2.0 * s[2] * normal.x * normal.y;
    let x = contact.boundary.point(t);
    let distance = match contact.distance(body) {
        // Boundaries that are said to touch: how far they do is seen on the mesh.
        Distance::Declared => (here.place - x).dot(&normal),
        measured => measured.at(x, normal, here.place).map_err(SystemError::Case)?,
    };
    Ok([moved.dot(&normal), pressure, distance, moved.dot(&contact.boundary.tangent(t))])
}

/// Stress on a boundary edge, in the triangle beside it.
fn stress_beside<const N: usize>(
    problem: &Discretisation,
    small: &BoundaryEdge,
    fraction: f64,
    u: &Field<2>,
    law: &PlaneLaw,
) -> Result<[f64; 4], SystemError> {
    let x = positions(&problem.scene.mesh, small.triangle, problem.finest().numbering.level, &small.beside.nodes::<N>());
    let nodal = nodal::<N>(problem, u, small.triangle, &small.beside);
    Ok(stress(&x, &nodal, small.barycentric(fraction), law)?)
}
