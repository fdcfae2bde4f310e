//! How far the bodies are strained and turned: whether a theory of small strains and rotations holds.

use crate::discretisation::{Discretisation, Field, SystemError, agreed};
use crate::element::{Plane, Strain, by_order, jacobian, place_of, strain};
use crate::geometry::{Point, cross};
use crate::mesh::{MacroMesh, MacroTriangle};
use crate::petsc::Session;
use nalgebra::Matrix2;
use std::collections::BTreeMap;

/// Refinements from which on a macro triangle alone is a region of many triangles.
const MANY: usize = 2;

/// Length of a square, by the radius of the body, within which macro triangles that are smaller count together. Of those of adapted meshes,
/// where λ grows without bound at the end of a contact, one alone had turned by .22 on a bolt that nothing bends.
const SQUARE: f64 = 1e-3;

/// How far a body is deformed and turned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deformation {
    /// Mean, over a macro triangle, of the larger principal strain by magnitude: the largest (no unit).
    pub strain: f64,
    /// Middle of that macro triangle.
    pub place: Point,
    /// Mean rotation, anticlockwise (radians).
    pub rotation: f64,
    /// Mean rotation of a macro triangle, the largest by magnitude (radians): both halves of a strip that is bent turn, its mean does not.
    pub turned: f64,
    /// `∫(ω² - ε²) tr σ` where the rotation ω is larger than the strain ε: twice the work of the stresses on the growth that a
    /// linear theory gives to what turns (energy per thickness).
    pub growth: f64,
    /// `-∫ω tr σ`: moment that all forces on the body have gained as it has turned, if they act on what it is made of (per thickness).
    pub moment: f64,
    /// Middle of the body.
    pub middle: Point,
    /// Largest distance of a vertex from there (length).
    pub radius: f64,
}

/// Integrals over a macro triangle: of the larger principal strain, of 1, of the rotation, of the work on its growth, of the moment that its
/// forces gain.
type TriangleIntegrals = [f64; 5];

/// Integrals over a body: of 1, of the rotation, of the work on its growth, of the moment that its forces gain, of the place.
type BodyIntegrals = [f64; 6];

/// Strain, rotation and growth of each body, and the rotation of each macro triangle beside contacts, the same on all ranks. Strain and
/// rotation of a macro triangle are means over it, where triangles are hardly refined over it and its neighbours, and where they are very
/// small over all such in a square. So a corner where the strain is singular counts by what its surroundings see, on fine meshes as on
/// coarse ones. **Collective**
///
/// # Errors
/// [`SystemError`] from an inverted triangle.
pub fn deformations(problem: &Discretisation, u: &Field<2>) -> Result<(Vec<Deformation>, Vec<f64>), SystemError> {
    let mesh = &problem.scene.mesh;
    let mut totals = vec![BodyIntegrals::default(); mesh.bodies.len()];
    // What neighbours need of a macro triangle: its strain, its area and its rotation.
    let mut sums = vec![[0.0; 3]; mesh.triangles.len()];
    let own = problem.own_triangles();
    let added = own.iter().try_for_each(|&at| {
        let triangle = &mesh.triangles[at as usize];
        let found = by_order!(problem.finest().numbering.level.order, integrals(problem, u, at as usize))?;
        add_to_body(&mut totals[triangle.body as usize], &found, centroid(mesh, triangle));
        sums[at as usize] = [found[0], found[1], found[2]];
        Ok(())
    });
    agreed(&problem.session, added)?;
    problem.session.sum(totals.as_flattened_mut());
    let mut found = whole_bodies(mesh, &totals);
    let is_own = |triangle: u32| problem.scene.partition.owner(triangle) == problem.session.rank();
    let beside = |edge: &u32| mesh.edges[*edge as usize].triangles.into_iter().flatten();
    let at_others =
        |&&triangle: &&u32| mesh.triangles[triangle as usize].edges.iter().flat_map(beside).any(|other| !is_own(other));
    let borders: Vec<u32> = own.iter().filter(|triangle| problem.session.size() > 1 && at_others(triangle)).copied().collect();
    for _ in problem.scene.refine..MANY {
        tell(&mut sums, &borders, &problem.session);
        sums = with_neighbours(mesh, own, &sums);
    }
    add_largest(problem, &small_together(problem, &sums), &mut found);
    let sides = problem.contacts.iter().flat_map(|contact| mesh.edges_on(&contact.pair.between));
    let pressed = sides.map(|edge| mesh.beside(edge).0).filter(|&triangle| is_own(triangle));
    tell(&mut sums, &pressed.collect::<Vec<_>>(), &problem.session);
    Ok((found, sums.iter().map(|sum| sum[2] / sum[1]).collect()))
}

/// The sums of this rank's macro triangles, of small ones those of all small ones of the body in the same square. **Collective**
fn small_together(problem: &Discretisation, sums: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let mesh = &problem.scene.mesh;
    let mut squares = vec![0.0f64; mesh.bodies.len()];
    for (piece, [low, high]) in mesh.pieces.iter().zip(mesh.bounds()) {
        squares[piece.body] = squares[piece.body].max(SQUARE * 0.5 * (high - low).norm());
    }
    let square = |at: u32| {
        let body = mesh.triangles[at as usize].body as usize;
        let [a, b, c] = mesh.corners(at as usize);
        let place = ((a + b + c) / (3.0 * squares[body])).map(f64::floor);
        (cross(b - a, c - a) < squares[body].powi(2)).then_some([body as i64, place.x as i64, place.y as i64])
    };
    let mut own: BTreeMap<[i64; 3], [f64; 3]> = BTreeMap::new();
    let small: Vec<(u32, [i64; 3])> = problem.own_triangles().iter().filter_map(|&at| Some((at, square(at)?))).collect();
    for &(at, square) in &small {
        own.entry(square).or_default().iter_mut().zip(sums[at as usize]).for_each(|(sum, value)| *sum += value);
    }
    let (places, values): (Vec<[i64; 3]>, Vec<[f64; 3]>) = own.into_iter().unzip();
    let places = problem.session.gather_all(places.as_flattened());
    let values = problem.session.gather_all(values.as_flattened());
    let mut together: BTreeMap<[i64; 3], [f64; 3]> = BTreeMap::new();
    for (square, own) in places.as_chunks().0.iter().zip(values.as_chunks::<3>().0) {
        together.entry(*square).or_default().iter_mut().zip(own).for_each(|(sum, value)| *sum += value);
    }
    let mut found = sums.to_vec();
    small.into_iter().for_each(|(at, square)| found[at as usize] = together[&square]);
    found
}

/// Tells every rank the sums of these macro triangles of this one. **Collective**
fn tell(sums: &mut [[f64; 3]], triangles: &[u32], session: &Session) {
    let places = session.gather_all(triangles);
    let known: Vec<[f64; 3]> = triangles.iter().map(|&triangle| sums[triangle as usize]).collect();
    let known = session.gather_all(known.as_flattened());
    places.iter().zip(known.as_chunks().0).for_each(|(&triangle, sum)| sums[triangle as usize] = *sum);
}

/// How large something is, the macro triangle of which, and itself.
type Largest = [f64; 3];

/// The larger one; of two alike that of the first macro triangle.
fn larger(a: Largest, b: Largest) -> Largest {
    if b[0] > a[0] || b[0] == a[0] && b[1] < a[1] { b } else { a }
}

/// Adds the largest strain and the largest rotation of its macro triangles to each body, and how far it reaches. **Collective**
fn add_largest(problem: &Discretisation, sums: &[[f64; 3]], found: &mut [Deformation]) {
    let mesh = &problem.scene.mesh;
    let mut all = vec![[[0.0, -1.0, 0.0]; 3]; found.len()];
    for &at in problem.own_triangles() {
        let (triangle, [strain, area, rotation]) = (&mesh.triangles[at as usize], sums[at as usize]);
        let (strain, rotation, body) = (strain / area, rotation / area, triangle.body as usize);
        let away = |vertex: u32| (mesh.vertices[vertex as usize] - found[body].middle).norm();
        let farthest = triangle.vertices.map(away).into_iter().fold(0.0, f64::max);
        let values = [(strain, strain), (rotation.abs(), rotation), (farthest, farthest)];
        all[body].iter_mut().zip(values).for_each(|(most, (size, value))| *most = larger(*most, [size, f64::from(at), value]));
    }
    let of_ranks = problem.session.gather_all(all.as_flattened().as_flattened());
    for (at, of_body) in of_ranks.as_chunks::<3>().0.as_chunks::<3>().0.iter().enumerate() {
        let known = &mut all[at % found.len()];
        (0..3).for_each(|k| known[k] = larger(known[k], of_body[k]));
    }
    for (of_body, [strain, rotation, farthest]) in found.iter_mut().zip(all) {
        let place = (strain[1] >= 0.0).then(|| centroid(mesh, &mesh.triangles[strain[1] as usize]));
        (of_body.strain, of_body.place) = (strain[2], place.unwrap_or(of_body.place));
        (of_body.turned, of_body.radius) = (rotation[2], farthest[2]);
    }
}

/// Adds the integrals over a macro triangle with this centroid to those of its body.
fn add_to_body(sum: &mut BodyIntegrals, [_, area, rotation, growth, moment]: &TriangleIntegrals, centroid: Point) {
    let values = [*area, *rotation, *growth, *moment, centroid.x * area, centroid.y * area];
    sum.iter_mut().zip(values).for_each(|(sum, value)| *sum += value);
}

/// What is known of each body as a whole; what [`add_largest`] adds is left at zero.
fn whole_bodies(mesh: &MacroMesh, totals: &[BodyIntegrals]) -> Vec<Deformation> {
    let whole = |&[area, rotation, growth, moment, x, y]: &BodyIntegrals| {
        let middle = Point::new(x, y) / area;
        Deformation { strain: 0.0, place: middle, rotation: rotation / area, turned: 0.0, growth, moment, middle, radius: 0.0 }
    };
    let mut found: Vec<Deformation> = totals.iter().map(whole).collect();
    if mesh.plane == Plane::Revolution {
        // A body around the axis cannot turn; the section of a ring can.
        let is_on_axis = |vertex: &u32| mesh.vertices[*vertex as usize].x == 0.0;
        for triangle in mesh.triangles.iter().filter(|triangle| triangle.vertices.iter().any(is_on_axis)) {
            let of_body = &mut found[triangle.body as usize];
            (of_body.rotation, of_body.growth) = (0.0, 0.0);
        }
    }
    found
}

fn centroid(mesh: &MacroMesh, triangle: &MacroTriangle) -> Point {
    triangle.vertices.map(|vertex| mesh.vertices[vertex as usize]).into_iter().sum::<Point>() / 3.0
}

/// Each sum of these macro triangles with those of the ones beside it.
fn with_neighbours(mesh: &MacroMesh, own: &[u32], sums: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let mut wider = vec![[0.0; 3]; sums.len()];
    for &triangle in own {
        let sum = &mut wider[triangle as usize];
        *sum = sums[triangle as usize];
        for edge in mesh.triangles[triangle as usize].edges {
            for other in mesh.edges[edge as usize].triangles.into_iter().flatten().filter(|&other| other != triangle) {
                (0..3).for_each(|k| sum[k] += sums[other as usize][k]);
            }
        }
    }
    wider
}

/// The integrals over a macro triangle: one point for each element.
fn integrals<const N: usize>(problem: &Discretisation, u: &Field<2>, triangle: usize) -> Result<TriangleIntegrals, SystemError> {
    const MIDDLE: [f64; 3] = [1.0 / 3.0; 3];
    let (law, heat) = problem.material(triangle);
    let mut sums = TriangleIntegrals::default();
    if let Some(even) = problem.even_triangle::<N>(triangle, u).filter(|_| heat.is_none()) {
        let (slopes, area) = jacobian(&even.x, MIDDLE)?;
        even.each(|_, u, sign| {
            let gradient = u.iter().zip(&slopes).fold(Matrix2::zeros(), |sum, (u, slope)| sum + u * slope.transpose());
            let found = Strain { gradient: sign * gradient, hoop: 0.0 };
            add_element(&mut sums, area, &found, law.stress(&found), 1.0);
        });
        return Ok(sums);
    }
    problem.each_element::<N, _>(triangle, |element| {
        let (found, area) = strain(&element.x, &u.on(element), MIDDLE, &law)?;
        let middle = place_of(&element.x, MIDDLE);
        add_element(&mut sums, area, &found, law.heated(law.stress(&found), heat, middle), law.plane.width(middle));
        Ok::<(), SystemError>(())
    })?;
    Ok(sums)
}

/// Adds an element by its strain and its stress in the middle, and the width there; `area` is twice its area.
#[inline]
fn add_element(sums: &mut TriangleIntegrals, area: f64, found: &Strain, [xx, yy, ..]: [f64; 4], width: f64) {
    let gradient = &found.gradient;
    let rotation = 0.5 * (gradient[(1, 0)] - gradient[(0, 1)]);
    let size = principal(gradient).max(found.hoop.abs());
    let growth = 0.5 * (rotation * rotation - size * size).max(0.0) * width;
    let values = [size, 1.0, rotation, growth * (xx + yy), -0.5 * rotation * (xx + yy) * width];
    sums.iter_mut().zip(values).for_each(|(sum, value)| *sum += area * value);
}

/// The larger principal strain of a displacement gradient, by magnitude.
fn principal(gradient: &Matrix2<f64>) -> f64 {
    let mean = 0.5 * (gradient[(0, 0)] + gradient[(1, 1)]);
    let half = 0.5 * (gradient[(0, 0)] - gradient[(1, 1)]);
    let shear = 0.5 * (gradient[(0, 1)] + gradient[(1, 0)]);
    mean.abs() + half.hypot(shear)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn principal_strains_do_not_see_rotations() {
        assert_eq!(principal(&Matrix2::new(0.0, -0.3, 0.3, 0.0)), 0.0);
        assert!((principal(&Matrix2::new(0.1, 0.0, 0.0, -0.4)) - 0.4).abs() < 1e-15);
        assert!((principal(&Matrix2::new(0.0, 0.2, 0.0, 0.0)) - 0.1).abs() < 1e-15);
    }

    #[test]
    fn a_body_turns_by_the_mean_over_its_area() {
        let mesh = crate::mesh::samples::two_blocks();
        let body = mesh.bodies.iter().position(|name| name == "lower").expect("a body");
        let own: Vec<usize> = (0..mesh.triangles.len()).filter(|&k| mesh.triangles[k].body as usize == body).collect();
        let mut totals = vec![[9.0; 6]; mesh.bodies.len()];
        totals[body] = BodyIntegrals::default();
        for (triangle, integrals) in own.iter().zip([[0.0, 1.0, 0.02, 0.3, 0.1], [0.0, 3.0, 0.18, 0.5, 0.2]]) {
            add_to_body(&mut totals[body], &integrals, centroid(&mesh, &mesh.triangles[*triangle]));
        }
        let found = &whole_bodies(&mesh, &totals)[body];
        assert!((found.rotation - 0.05).abs() < 1e-12 && (found.growth - 0.8).abs() < 1e-12);
        let [a, b] = [0, 1].map(|k| centroid(&mesh, &mesh.triangles[own[k]]));
        assert!((found.middle - (0.25 * a + 0.75 * b)).norm() < 1e-12);
    }
}
