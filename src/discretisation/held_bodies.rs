//! Bodies whose mean motion is held: their nodes, and what the displacement of each counts in the means.
//!
//! The mean of a mode `r` is `∫ r · u dA / ∫ |r|² dA`. The weights here are those of `q = N⁻¹ ∫ r · u dA` with `N = ∫ r rᵀ dA`, so
//! that each mode has a mean of one of its own and none of the others.

use crate::body::{Anchor, MeanHold, Motion, UNIT_MOTIONS, body_forces, rigid_displacement};
use crate::discretisation::error::SystemError;
use crate::discretisation::field::Field;
use crate::discretisation::scene::Scene;
use crate::discretisation::space::Space;
use crate::geometry::Point;
use crate::mesh::lattice;
use crate::petsc::Session;
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use std::collections::{BTreeMap, HashMap};

/// All of them, in the order of the scene.
pub struct HeldBodies {
    /// What each turns about: the middle of its mesh.
    pub about: Vec<Point>,
    /// Nodes of this rank in them: number, which body, and place.
    pub nodes: Vec<(usize, usize, Point)>,
    /// `∫ N dA` and `∫ N (x - m) dA` of every node in them, with the middle `m` of the macro triangles.
    moments: Field<3>,
    /// From there to the middle of the mesh, whose edges are bent: about any other place a turn would push.
    off: Vec<Point>,
    /// `∫ r rᵀ dA` of shifts and turn.
    all: Vec<Matrix3<f64>>,
    /// `N⁻¹` of the modes that are held.
    inverses: Vec<DMatrix<f64>>,
    /// `q` where each mean is as it was asked for, of one body after the other.
    pub asked: Vec<Vec<f64>>,
}

impl HeldBodies {
    /// Looks once at each triangle. **Collective**
    ///
    /// # Errors
    /// [`SystemError::Case`] if a triangle is turned inside out.
    pub fn new(scene: &Scene, space: &Space, session: &Session) -> Result<Self, SystemError> {
        let (mesh, numbering) = (&scene.mesh, &space.numbering);
        let about: Vec<Point> = scene.means.iter().map(|hold| hold.middle).collect();
        let of_body = holds_of_bodies(scene);
        let (mut moments, mut places) = (Field::<3>::zeros(scene, space, session), BTreeMap::new());
        let mut add_triangle = |triangle: usize, hold: usize| {
            let mut add = |first: usize, node: usize, moment: Point| {
                let sums = moments.at_mut(node);
                sums.iter_mut().skip(first).zip(moment.iter()).for_each(|(sum, part)| *sum += part);
            };
            let arms = |points: &[Point; 6]| points.map(|x| x - about[hold]);
            body_forces(mesh, triangle, numbering, arms, &mut |node, moment| add(1, node, moment))?;
            body_forces(mesh, triangle, numbering, |_| [Point::new(1.0, 0.0); 6], &mut |node, weight| add(0, node, weight))
        };
        let own = scene.partition.triangles_of(session.rank()).iter().map(|&triangle| triangle as usize);
        let mut held = own.filter_map(|triangle| Some((triangle, of_body[mesh.triangles[triangle].body as usize]?)));
        let added = held.try_for_each(|(triangle, hold)| {
            let numbers = numbering.triangle(mesh, triangle);
            for (i, j) in lattice::nodes(numbering.level.intervals).filter(|&(i, j)| space.own.contains(&numbers.node(i, j))) {
                let place = || (hold, mesh.node_position(triangle, numbering.level, (i, j)));
                places.entry(numbers.node(i, j)).or_insert_with(place);
            }
            add_triangle(triangle, hold)
        });
        session.agree(added.map_err(SystemError::from))?;
        let nodes = places.into_iter().map(|(node, (hold, x))| (node, hold, x)).collect();
        let (all, inverses, asked, off) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        let mut bodies = Self { about, nodes, moments: moments.sum(session), off, all, inverses, asked };
        bodies.find_middles(session);
        bodies.weigh(scene, session);
        Ok(bodies)
    }

    /// Finds the middle of each body's mesh. **Collective**
    fn find_middles(&mut self, session: &Session) {
        let mut sums = vec![[0.0; 3]; self.about.len()];
        for &(node, hold, _) in &self.nodes {
            sums[hold].iter_mut().zip(self.moments.at(node)).for_each(|(sum, part)| *sum += part);
        }
        session.sum(sums.as_flattened_mut());
        self.off = sums.iter().map(|[area, x, y]| Point::new(*x, *y) / *area).collect();
        self.about.iter_mut().zip(&self.off).for_each(|(about, off)| *about += off);
    }

    /// Finds `N` of each body, and what follows from it. **Collective**
    fn weigh(&mut self, scene: &Scene, session: &Session) {
        let mut sums = vec![[0.0; 9]; scene.means.len()];
        for &(node, hold, x) in &self.nodes {
            for (i, a) in UNIT_MOTIONS.iter().enumerate() {
                let moment = self.moment(hold, a, node);
                UNIT_MOTIONS.iter().enumerate().for_each(|(j, b)| sums[hold][3 * i + j] += moment.dot(&self.moved(hold, b, x)));
            }
        }
        session.sum(sums.as_flattened_mut());
        for (hold, sums) in scene.means.iter().zip(sums) {
            let (count, all) = (hold.held.len(), Matrix3::from_row_slice(&sums));
            let mode = |i: usize| Vector3::from(hold.held[i].mode);
            let gram = DMatrix::from_fn(count, count, |i, j| mode(i).dot(&(all * mode(j))));
            let whole = DVector::from_fn(count, |i, _| gram[(i, i)] * hold.held[i].value);
            let inverse = gram.try_inverse().unwrap_or_else(|| DMatrix::zeros(count, count));
            self.asked.push((&inverse * whole).as_slice().to_vec());
            self.inverses.push(inverse);
            self.all.push(all);
        }
    }

    /// Shift and turn of the force per area that is spread over a body as a shift or a turn is, with this resultant force and
    /// moment about the middle.
    pub fn spread(&self, hold: usize, force: &Motion) -> Motion {
        std::array::from_fn(|k| force[k] / self.all[hold][(k, k)])
    }

    /// Resultant force and moment of what pushes along the modes that are held by `pushed` each, and is spread as they are.
    pub fn resultant(&self, scene: &Scene, hold: usize, pushed: &[f64; 3]) -> Motion {
        let held = &scene.means[hold].held;
        let shares = &self.inverses[hold] * DVector::from_row_slice(&pushed[..held.len()]);
        let spread: Vector3<f64> = held.iter().zip(shares.iter()).map(|(held, share)| *share * Vector3::from(held.mode)).sum();
        std::array::from_fn(|k| self.all[hold][(k, k)] * spread[k])
    }

    /// Displacement of a place by a mode.
    pub fn moved(&self, hold: usize, mode: &Motion, x: Point) -> Point {
        rigid_displacement(self.about[hold], mode, x)
    }

    /// `∫ N r dA` of a node of a body.
    fn moment(&self, hold: usize, [along, up, turn]: &Motion, node: usize) -> Point {
        let [weight, x, y] = self.moments.at(node);
        let arm = Point::new(x, y) - weight * self.off[hold];
        Point::new(along * weight - turn * arm.y, up * weight + turn * arm.x)
    }

    /// What a node of this rank counts in the mean of each mode that is held.
    pub fn weights(&self, scene: &Scene, hold: usize, node: usize) -> Vec<Point> {
        let moments: Vec<Point> = scene.means[hold].held.iter().map(|held| self.moment(hold, &held.mode, node)).collect();
        let inverse = &self.inverses[hold];
        (0..moments.len()).map(|k| moments.iter().enumerate().map(|(l, moment)| inverse[(k, l)] * moment).sum()).collect()
    }
}

/// The hold of each body of the scene, if it has one.
pub fn holds_of_bodies(scene: &Scene) -> Vec<Option<usize>> {
    let means = &scene.means;
    let numbers: HashMap<&str, usize> = means.iter().enumerate().map(|(number, hold)| (hold.body.as_str(), number)).collect();
    scene.mesh.bodies.iter().map(|body| numbers.get(body.as_str()).copied()).collect()
}

/// How far bodies have been moved rigidly by the modes that are held, one body after the other, with turns `about` these places: from
/// the displacements of their anchors on this rank, in the nodes' frames. **Collective**
pub fn held_motions(scene: &Scene, space: &Space, about: &[Point], displacement: &[f64], session: &Session) -> Vec<Vec<f64>> {
    let moved = |anchor: &Anchor| {
        let node = space.numbering.vertex(anchor.vertex);
        let own = space.own.contains(&node).then(|| 2 * (node - space.own.start));
        let u = own.map(|at| space.to_global(node, Point::new(displacement[at], displacement[at + 1])));
        u.map_or(0.0, |u| u.dot(&anchor.direction))
    };
    let all: Vec<f64> = session.sum(scene.means.iter().flat_map(|hold| &hold.anchors).map(moved).collect());
    let mut all = all.into_iter();
    let solve = |(hold, about): (&MeanHold, &Point)| {
        let anchors = &hold.anchors;
        let along =
            |i: usize, j: usize| rigid_displacement(*about, &hold.held[j].mode, anchors[i].place).dot(&anchors[i].direction);
        let modes = DMatrix::from_fn(anchors.len(), hold.held.len(), along);
        let moved = DVector::from_iterator(anchors.len(), all.by_ref().take(anchors.len()));
        modes.lu().solve(&moved).map_or_else(|| vec![0.0; hold.held.len()], |q| q.as_slice().to_vec())
    };
    scene.means.iter().zip(about).map(solve).collect()
}
