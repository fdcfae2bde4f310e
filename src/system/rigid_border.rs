//! Rigid motions that are unknown: of tools that carry a force, of plates that press, of bodies whose mean motion is held.
//!
//! Everything moves by `u + R q`: `q` are components of such motions, `R` the displacements of the nodes that move along. With the
//! multipliers `μ` of the means, stationary energy beside the blocks of displacements and contact reads
//!
//! ```text
//! K u + Bᵀ λ + K R q + M μ = f          K R: zero but for plates; R moves all of a tool or a body
//! B u - C λ + B R q        = c
//! (K R)ᵀ u + (B R)ᵀ λ + Rᵀ K R q + μ = F + Rᵀ (f - K u_D)         what the motion is balanced by
//! Mᵀ u + q                 = a          of bodies whose mean is held
//! ```
//! Vertices hold the nodes of such bodies, the others are prescribed: the blocks are those of sets at rest. Here are the parts that
//! no active set changes; [`super::SaddlePoint`] has what becomes of them in a system.

use crate::body::{Motion, RigidNodes, RigidSet, UNIT_MOTIONS, rigid_displacement};
use crate::discretisation::{
    Discretisation, Field, Scene, Space, SpringForces, SystemError, held_motions, holds_of_bodies, internal_forces, nodal_forces,
    rigid_motions,
};
use crate::geometry::Point;
use crate::multigrid::Sparse;
use nalgebra::DMatrix;
use std::collections::{BTreeMap, HashMap};
use std::ops::Range;

/// Gaps below this share of what their terms add up to are rounding.
const ROUNDING: f64 = 1e-12;

/// A component of a rigid motion.
pub struct RigidComponent {
    mode: Motion,
    /// `K R` on this rank's free unknowns, in the nodes' frames.
    pub forces: Sparse,
    /// Its row of `Mᵀ`, the same way, if its mean is held.
    pub mean: Option<Sparse>,
    /// Size that its motion is measured by: one, or for a turn the arm (length).
    pub arm: f64,
    /// `F + Rᵀ (f - K u_D)`: force or moment to balance.
    pub load: f64,
    /// `a - Mᵀ u_D`.
    pub asked: f64,
}

/// All unknown components of rigid motions.
pub struct RigidBorder {
    /// Those of the rigid sets of the scene, then those of the bodies whose mean motion is held.
    pub components: Vec<RigidComponent>,
    /// Components of each.
    of_set: Vec<Range<usize>>,
    /// What each turns about.
    about: Vec<Point>,
    /// `B R` by multipliers: components with their gaps.
    pub gaps: Vec<Vec<(usize, f64)>>,
    /// `Rᵀ K R` of the rigid sets.
    pub stiffness: DMatrix<f64>,
    /// Largest Young's modulus of what is no tool: forces are measured by it.
    pub young: f64,
    /// Nodes of this rank that move along: the place of their unknowns, with what they move, and where they are.
    nodes: Vec<(usize, usize, Point)>,
}

/// Whether rigid motions of a scene are unknown.
pub fn moves_rigidly(scene: &Scene) -> bool {
    !scene.means.is_empty() || scene.rigid.iter().any(|set| set.free().next().is_some())
}

impl RigidBorder {
    /// Assembles them; nothing if there are none. **Collective**
    ///
    /// # Errors
    /// [`SystemError`] from PETSc or an inverted triangle.
    pub fn new(problem: &Discretisation) -> Result<Option<Self>, SystemError> {
        let scene = &problem.scene;
        if !moves_rigidly(scene) {
            return Ok(None);
        }
        let mut border = Self {
            components: Vec::new(),
            of_set: Vec::new(),
            about: Vec::new(),
            gaps: Vec::new(),
            stiffness: DMatrix::zeros(0, 0),
            young: scene.young().into_iter().filter(|young| young.is_finite()).fold(f64::MIN_POSITIVE, f64::max),
            nodes: Vec::new(),
        };
        let loads = nodal_forces(problem)?;
        border.add_sets(problem, &loads)?;
        if !scene.means.is_empty() {
            border.add_held_bodies(problem, &loads)?;
        }
        border.gaps = border.moved_gaps(problem);
        Ok(Some(border))
    }

    /// Adds the free components of the rigid sets. **Collective**
    fn add_sets(&mut self, problem: &Discretisation, loads: &Field<2>) -> Result<(), SystemError> {
        let (mesh, space) = (&problem.scene.mesh, problem.finest());
        let mut rows = Vec::new();
        for (number, set) in problem.scene.rigid.iter().enumerate() {
            let places = set.places(mesh, &space.numbering);
            let arm = arm(problem, set, &places);
            let moved = moved_nodes(problem, set, &places);
            self.nodes.extend(moved.into_iter().map(|(node, x)| (2 * (node - space.own.start), number, x)));
            let first = self.components.len();
            for k in set.free() {
                let row = moved_forces(problem, set, k, &places)?;
                let mut forces = Free::new(problem);
                space.own.clone().zip(row.own()).for_each(|(node, force)| forces.add(node, Point::from(*force)));
                let own = places.iter().filter(|(node, _)| space.own.contains(node));
                let pushed: f64 = own.map(|(&node, &x)| loads.point(node).dot(&set.mode(k, x))).sum();
                self.components.push(RigidComponent {
                    mode: UNIT_MOTIONS[k],
                    arm: if k == 2 { arm } else { 1.0 },
                    load: pushed - forces.at_rest,
                    forces: forces.values,
                    mean: None,
                    asked: 0.0,
                });
                rows.push(row);
            }
            self.of_set.push(first..self.components.len());
            self.about.push(set.about);
        }
        let count = rows.len();
        let mut sums: Vec<f64> = self.components.iter().map(|component| component.load).collect();
        for row in &rows {
            let mut works = vec![0.0; count];
            for &(at, set, x) in &self.nodes {
                let force = Point::from(row.own()[at / 2]);
                self.of_set[set].clone().for_each(|j| works[j] += force.dot(&self.moved(set, j, x)));
            }
            sums.extend(works);
        }
        problem.session.sum(&mut sums);
        self.stiffness = DMatrix::from_row_slice(count, count, &sums[count..]);
        let applied = problem.scene.rigid.iter().flat_map(|set| set.free().map(|k| set.applied[k]));
        for ((component, load), applied) in self.components.iter_mut().zip(sums).zip(applied) {
            component.load = load + applied;
        }
        Ok(())
    }

    /// Adds the modes of bodies whose mean is held. **Collective**
    fn add_held_bodies(&mut self, problem: &Discretisation, loads: &Field<2>) -> Result<(), SystemError> {
        let (scene, space) = (&problem.scene, problem.finest());
        let bodies = problem.held_bodies()?;
        let (sets, first) = (self.of_set.len(), self.components.len());
        let mut means: Vec<Free> = Vec::new();
        for (number, hold) in scene.means.iter().enumerate() {
            self.of_set.push(self.components.len()..self.components.len() + hold.held.len());
            self.about.push(bodies.about[number]);
            for (held, &asked) in hold.held.iter().zip(&bodies.asked[number]) {
                let (arm, forces) = (if held.is_turn() { hold.reach } else { 1.0 }, Sparse::new());
                self.components.push(RigidComponent { mode: held.mode, forces, mean: None, arm, load: 0.0, asked });
                means.push(Free::new(problem));
            }
        }
        let mut pushed = vec![0.0; means.len()];
        for &(node, hold, x) in &bodies.nodes {
            for (weight, j) in bodies.weights(scene, hold, node).into_iter().zip(self.of_set[sets + hold].clone()) {
                means[j - first].add(node, weight);
                pushed[j - first] += loads.point(node).dot(&self.moved(sets + hold, j, x));
            }
            self.nodes.push((2 * (node - space.own.start), sets + hold, x));
        }
        let sums: Vec<f64> = problem.session.sum(pushed.into_iter().chain(means.iter().map(|mean| mean.at_rest)).collect());
        let (pushed, at_rest) = sums.split_at(means.len());
        for (k, (component, mean)) in self.components[first..].iter_mut().zip(means).enumerate() {
            (component.load, component.mean) = (pushed[k], Some(mean.values));
            component.asked -= at_rest[k];
        }
        Ok(())
    }

    /// Displacement of a place when a component of its set is one.
    fn moved(&self, set: usize, component: usize, x: Point) -> Point {
        rigid_displacement(self.about[set], &self.components[component].mode, x)
    }

    /// `B R` by multipliers; what cancels is left out. **Collective**
    fn moved_gaps(&self, problem: &Discretisation) -> Vec<Vec<(usize, f64)>> {
        let (scene, numbering, coupling) = (&problem.scene, &problem.finest().numbering, &problem.coupling);
        let (of_body, mut of_node) = (holds_of_bodies(&problem.scene), HashMap::<usize, Vec<(usize, Point)>>::new());
        for (number, set) in scene.rigid.iter().enumerate().filter(|(number, _)| !self.of_set[*number].is_empty()) {
            let places = set.places(&scene.mesh, numbering);
            places.into_iter().for_each(|(node, x)| of_node.entry(node).or_default().push((number, x)));
        }
        let (mut places, mut values) = (Vec::new(), Vec::new());
        let mut sums = BTreeMap::<usize, [f64; 2]>::new();
        for row in coupling.own(0..coupling.owners.len(), problem.session.rank()) {
            for coupled in &coupling.rows[row] {
                let of_sets = of_node.get(&coupled.node.number(&scene.mesh, numbering)).into_iter().flatten().copied();
                let held =
                    of_body[coupled.body].map(|hold| (scene.rigid.len() + hold, coupled.node.place(&scene.mesh, numbering)));
                for (set, x) in of_sets.chain(held) {
                    for component in self.of_set[set].clone() {
                        let u = self.moved(set, component, x);
                        let [sum, whole] = sums.entry(component).or_default();
                        *sum += coupled.value.dot(&u);
                        *whole += coupled.value.norm() * u.norm();
                    }
                }
            }
            for (component, [sum, whole]) in std::mem::take(&mut sums) {
                if sum.abs() > ROUNDING * whole {
                    places.extend([row, component]);
                    values.push(sum);
                }
            }
        }
        let (places, values) = (problem.session.gather_all(&places), problem.session.gather_all(&values));
        let mut gaps = vec![Vec::new(); coupling.owners.len()];
        places.chunks_exact(2).zip(values).for_each(|(place, value)| gaps[place[0]].push((place[1], value)));
        gaps
    }

    /// The components that this rank's displacements, in the nodes' frames, have in them. **Collective**
    pub fn motion_of(&self, problem: &Discretisation, displacement: &[f64]) -> Vec<f64> {
        let sets = rigid_motions(problem, displacement);
        let free = problem.scene.rigid.iter().zip(&sets).flat_map(|(set, motion)| set.free().map(|k| motion[k]));
        let about = &self.about[problem.scene.rigid.len()..];
        free.chain(held_motions(&problem.scene, problem.finest(), about, displacement, &problem.session).into_iter().flatten())
            .collect()
    }

    /// Adds the displacements by a motion to those of this rank, in the nodes' frames.
    pub fn displace(&self, space: &Space, motion: &[f64], displacement: &mut [f64]) {
        for &(at, set, x) in &self.nodes {
            let u = self.of_set[set].clone().map(|j| motion[j] * self.moved(set, j, x)).sum();
            let u = space.to_frame(space.own.start + at / 2, u);
            displacement[at] += u.x;
            displacement[at + 1] += u.y;
        }
    }

    /// `Rᵀ f` of bodies whose mean is held, for other nodal forces of this rank in the nodes' frames; nothing of rigid sets.
    /// **Collective**
    pub fn loads_of(&self, problem: &Discretisation, load: &[f64]) -> Vec<f64> {
        let space = problem.finest();
        let mut sums = vec![0.0; self.components.len()];
        for &(at, set, x) in &self.nodes {
            for j in self.of_set[set].clone().filter(|&j| self.components[j].mean.is_some()) {
                let force = space.to_global(space.own.start + at / 2, Point::new(load[at], load[at + 1]));
                sums[j] += force.dot(&self.moved(set, j, x));
            }
        }
        problem.session.sum(sums)
    }

    /// `B R q` of all multipliers.
    pub fn gaps_of<'a>(&'a self, motion: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
        self.gaps.iter().map(|row| row.iter().map(|&(j, gap)| gap * motion[j]).sum())
    }
}

/// A row on this rank's free unknowns, in the nodes' frames, and its product with what supports prescribe.
struct Free<'a> {
    space: &'a Space,
    values: Sparse,
    at_rest: f64,
}

impl<'a> Free<'a> {
    fn new(problem: &'a Discretisation) -> Self {
        Self { space: problem.finest(), values: Sparse::new(), at_rest: 0.0 }
    }

    /// Adds an entry of the row, of a node of this rank.
    fn add(&mut self, node: usize, value: Point) {
        self.at_rest += value.dot(&self.space.prescribed(node));
        let (first, free) = (2 * (node - self.space.own.start), self.space.free_part(node, value));
        self.values.extend((0..2).filter(|&k| free[k] != 0.0).map(|k| ((first + k) as u32, free[k])));
    }
}

/// Largest distance from the reference point at which contact acts on a set; of its nodes where none does: a tool may be far longer
/// than what it touches. **Collective**
fn arm(problem: &Discretisation, set: &RigidSet, places: &BTreeMap<usize, Point>) -> f64 {
    let (mesh, numbering) = (&problem.scene.mesh, &problem.finest().numbering);
    let farthest = |x: &mut dyn Iterator<Item = &Point>| x.map(|x| (x - set.about).norm()).fold(0.0, f64::max);
    let mut touched = problem.coupling.rows.iter().flatten().filter_map(|at| places.get(&at.node.number(mesh, numbering)));
    let arms = problem.session.max([farthest(&mut touched), farthest(&mut places.values())]);
    arms.into_iter().find(|arm| *arm > 0.0).unwrap_or(f64::MIN_POSITIVE)
}

/// Nodes of this rank that move with a set, and where they are: with a tool those within its triangles, too, so that its motion
/// is no force within it.
fn moved_nodes(problem: &Discretisation, set: &RigidSet, places: &BTreeMap<usize, Point>) -> BTreeMap<usize, Point> {
    if let RigidNodes::Body(name) = &set.nodes {
        return nodes_of_body(problem, name);
    }
    let own = &problem.finest().own;
    places.iter().filter(|(node, _)| own.contains(node)).map(|(&node, &x)| (node, x)).collect()
}

/// `K R`: forces at all nodes when a set moves by one component, all else at rest; none of a tool. **Collective**
fn moved_forces(
    problem: &Discretisation,
    set: &RigidSet,
    k: usize,
    places: &BTreeMap<usize, Point>,
) -> Result<Field<2>, SystemError> {
    let space = problem.finest();
    if let RigidNodes::Body(_) = set.nodes {
        return Ok(Field::zeros(&problem.scene, space, &problem.session));
    }
    let mut moved = vec![0.0; space.local_unknowns()];
    for (&node, &x) in places.iter().filter(|(node, _)| space.own.contains(node)) {
        moved[2 * (node - space.own.start)..][..2].copy_from_slice(space.to_frame(node, set.mode(k, x)).as_slice());
    }
    let moved = Field::displacement(problem, &moved);
    let (mut forces, springs) = (internal_forces(problem, &moved)?.1, SpringForces::new(problem, &moved));
    forces.add(-1.0, &springs.nodes);
    Ok(forces)
}

/// Nodes of this rank in a body, and where they are.
fn nodes_of_body(problem: &Discretisation, body: &str) -> BTreeMap<usize, Point> {
    let (mesh, space) = (&problem.scene.mesh, problem.finest());
    let mut nodes = BTreeMap::new();
    let is_own = |triangle: &usize| mesh.bodies[mesh.triangles[*triangle].body as usize] == body;
    let own = problem.own_triangles().iter().map(|&triangle| triangle as usize).filter(is_own);
    for (triangle, at, node) in space.numbering.nodes_of(mesh, own).filter(|(.., node)| space.own.contains(node)) {
        nodes.entry(node).or_insert_with(|| mesh.node_position(triangle, space.numbering.level, at));
    }
    nodes
}
