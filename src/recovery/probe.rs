//! Displacement and stress at a point of a body.

use crate::discretisation::{Discretisation, Element, Field, SystemError, agreed};
use crate::element::{SIX_POINTS, by_order, heated_stress, shape, stress};
use crate::geometry::{AXES, Point};
use crate::mesh::Region;
use crate::mesh::lattice::Triangle;

/// How far outside a macro triangle a point may lie (barycentric): as far as on the mesh of the file first; a point that lies as
/// little outside of that is farther out by the size of its triangles where these are small.
const OUTSIDE: [f64; 4] = [1e-8, 1e-6, 1e-4, 1e-2];

/// Barycentric coordinates of the middle of a triangle: a stress of P2 is linear, and has its mean there.
const MIDDLE: [f64; 3] = [1.0 / 3.0; 3];

/// Values at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Probed {
    /// Displacement.
    pub displacement: Point,
    /// Stress (xx, yy, xy, zz).
    pub stress: [f64; 4],
}

/// What the stress at a point is that of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Probing {
    /// A displacement of bodies that may be heated.
    Displacement,
    /// The difference of two displacements, on which heat has no part.
    Difference,
}

/// Values at a point of a body or of a part of one, the same on every rank; nothing if it does not hold the point. On an edge
/// between macro triangles it is the mean over them. **Collective**
///
/// # Errors
/// [`SystemError`] where a triangle is inverted.
pub fn probe(
    problem: &Discretisation,
    (u, probing): (&Field<2>, Probing),
    region: Region,
    x: Point,
) -> Result<Option<Probed>, SystemError> {
    for near in OUTSIDE {
        let mut sums = [0.0; 7];
        let added = holding_nearly(problem, region, x, near).into_iter().try_for_each(|(triangle, at)| {
            let values = by_order!(problem.finest().numbering.level.order, values_at(problem, (u, probing), triangle, at))?;
            values.iter().chain(&[1.0]).zip(&mut sums).for_each(|(value, sum)| *sum += value);
            Ok::<(), SystemError>(())
        });
        agreed(&problem.session, added)?;
        problem.session.sum(&mut sums);
        if sums[6] > 0.0 {
            let [x, y, stress @ .., _] = sums.map(|sum| sum / sums[6]);
            return Ok(Some(Probed { displacement: Point::new(x, y), stress }));
        }
    }
    Ok(None)
}

/// Nodes of the triangle at reference coordinates of a macro triangle, and the values of their shape functions there.
pub fn shapes_at(problem: &Discretisation, triangle: usize, at: Point) -> Vec<(usize, f64)> {
    by_order!(problem.finest().numbering.level.order, nodes_with_shapes(problem, triangle, at))
}

fn nodes_with_shapes<const N: usize>(problem: &Discretisation, triangle: usize, at: Point) -> Vec<(usize, f64)> {
    let (element, l) = element_at::<N>(problem, triangle, at);
    element.nodes.into_iter().zip(shape::<N>(l)).collect()
}

/// Root mean square of the size of the stress over the triangles of the lattice that hold a point; zero if no body holds it.
/// **Collective**
///
/// # Errors
/// [`SystemError`] where a triangle is inverted.
pub fn stress_around(problem: &Discretisation, u: &Field<2>, region: Region, x: Point) -> Result<f64, SystemError> {
    let mut sums = [0.0; 2];
    let added = holding(problem, region, x).into_iter().try_for_each(|(triangle, at)| {
        by_order!(problem.finest().numbering.level.order, add_squares(problem, u, triangle, at, &mut sums))
    });
    agreed(&problem.session, added)?;
    problem.session.sum(&mut sums);
    Ok(if sums[1] > 0.0 { (sums[0] / sums[1]).sqrt() } else { 0.0 })
}

fn add_squares<const N: usize>(
    problem: &Discretisation,
    u: &Field<2>,
    triangle: usize,
    at: Point,
    sums: &mut [f64; 2],
) -> Result<(), SystemError> {
    let (element, _) = element_at::<N>(problem, triangle, at);
    let ((law, _), nodal) = (problem.material(triangle), u.on(&element));
    for &(l, weight) in SIX_POINTS {
        let s = stress(&element.x, &nodal, l, &law)?;
        sums[0] += weight * law.plane.stress_product(s, s);
        sums[1] += weight;
    }
    Ok(())
}

/// This rank's macro triangles of a body, or of a part of one, that hold a point, and its reference coordinates in them.
pub fn holding(problem: &Discretisation, region: Region, x: Point) -> Vec<(usize, Point)> {
    holding_nearly(problem, region, x, OUTSIDE[0])
}

/// The same, of a point that may lie outside by the distance `near` (barycentric).
fn holding_nearly(problem: &Discretisation, region: Region, x: Point, near: f64) -> Vec<(usize, Point)> {
    let mesh = &problem.scene.mesh;
    let own = problem.own_triangles().iter().map(|&triangle| triangle as usize);
    let own = own.filter(|&triangle| region.holds(&mesh.triangles[triangle]));
    own.filter_map(|triangle| Some((triangle, mesh.locate_near(triangle, x, near)?))).collect()
}

/// Nodal forces of the functional `v ↦ s : σ(v)`, mean over the triangles of the lattice that hold a point, where s is the
/// mean of the stress of `u` on them, of any size: the direction in which it points. All zero if no body holds the point.
/// **Collective**
///
/// # Errors
/// [`SystemError`] where a triangle is inverted.
pub fn stress_forces(problem: &Discretisation, u: &Field<2>, region: Region, x: Point) -> Result<Field<2>, SystemError> {
    let mut forces = Field::<2>::zeros(&problem.scene, problem.finest(), &problem.session);
    let added = holding(problem, region, x).into_iter().try_for_each(|(triangle, at)| {
        by_order!(problem.finest().numbering.level.order, add_stress_forces(problem, u, triangle, at, &mut forces))
    });
    agreed(&problem.session, added)?;
    Ok(forces.sum(&problem.session))
}

fn add_stress_forces<const N: usize>(
    problem: &Discretisation,
    u: &Field<2>,
    triangle: usize,
    at: Point,
    forces: &mut Field<2>,
) -> Result<(), SystemError> {
    let (element, _) = element_at::<N>(problem, triangle, at);
    let (law, _) = problem.material(triangle);
    let mean = |u: &[Point; N]| stress(&element.x, u, MIDDLE, &law);
    let pointing = mean(&u.on(&element))?;
    for (k, node) in element.nodes.into_iter().enumerate() {
        let sum = forces.at_mut(node);
        for (c, axis) in AXES.into_iter().enumerate() {
            let mut moved = [Point::zeros(); N];
            moved[k] = axis;
            let found = mean(&moved)?;
            sum[c] += law.plane.stress_product(pointing, found);
        }
    }
    Ok(())
}

/// Displacement and stress at reference coordinates of a macro triangle.
fn values_at<const N: usize>(
    problem: &Discretisation,
    (u, probing): (&Field<2>, Probing),
    triangle: usize,
    at: Point,
) -> Result<[f64; 6], SystemError> {
    let (law, heat) = problem.material(triangle);
    let heat = heat.filter(|_| probing == Probing::Displacement);
    let (element, l) = element_at::<N>(problem, triangle, at);
    let nodal = u.on(&element);
    let moved = nodal.iter().zip(shape::<N>(l)).fold(Point::zeros(), |sum, (u, value)| sum + value * u);
    let s = heated_stress(&element.x, &nodal, l, &law, heat)?;
    Ok([moved.x, moved.y, s[0], s[1], s[2], s[3]])
}

/// The element of a macro triangle at reference coordinates, and the barycentric ones in it.
fn element_at<const N: usize>(problem: &Discretisation, triangle: usize, at: Point) -> (Element<N>, [f64; 3]) {
    let level = problem.finest().numbering.level;
    let count = level.triangles_per_edge();
    let scaled = problem.scene.mesh.lattice_point(triangle, level, at).map(|v| v.max(0.0)) * count as f64;
    let [mut i, mut j] = [scaled.x as usize, scaled.y as usize].map(|k| k.min(count - 1));
    while i + j >= count {
        if i > j { i -= 1 } else { j -= 1 }
    }
    let (small, l) = Triangle::holding((i, j), (scaled.x - i as f64, scaled.y - j as f64), count, level.order);
    (problem.element(triangle, small), l)
}
