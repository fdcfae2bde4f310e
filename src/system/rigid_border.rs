//! Rigid sets whose motion is unknown: tools that carry a force, plates that press.
//!
//! The nodes of such a set are prescribed, by a motion `q` that follows from its balance. Beside the blocks `A x = b` of
//! displacements and multipliers stands a border,
//!
//! ```text
//! [ A   T ] [x]   [b]        T = [ K R ]        R: displacements of the set's nodes by each free component of its motion
//! [ Tᵀ  D ] [q] = [h]            [ B R ]        D = Rᵀ K R,   h = F + Rᵀ (f - K u_D)
//! ```
//! `R` moves all of a tool, so that `K R = 0`: its border is that of the gaps alone. The border
//! is eliminated: `(D - Tᵀ A⁻¹ T) q = h - Tᵀ A⁻¹ b`, with one solve for each free component and active set. `A` is that
//! of sets at rest, so that nothing in its solver has to know of them.

use crate::body::{Motion, RigidNodes, RigidSet};
use crate::geometry::Point;
use crate::mesh::lattice;
use crate::petsc::Session;
use crate::system::recovery::{SpringForces, internal_forces};
use crate::system::{Discretisation, Field, SystemError, nodal_forces};
use nalgebra::{DMatrix, DVector};
use std::collections::BTreeMap;

/// Singular values of the border below this share of the largest belong to motions that nothing resists.
const NOTHING: f64 = 1e-13;

/// A free component of the motion of a rigid set.
struct Component {
    /// Index of the set in the scene.
    set: usize,
    /// Which of its components.
    k: usize,
    /// Length by which it is measured: 1 for a shift, the size of the set for a turn.
    arm: f64,
    /// `K R` on this rank's free unknowns, in the nodes' frames.
    forces: Vec<f64>,
    /// `B R` of all multipliers (length).
    gaps: Vec<f64>,
    /// `h`: force or moment to balance.
    given: f64,
}

/// All free components of all rigid sets.
pub struct RigidBorder {
    components: Vec<Component>,
    /// `D`.
    corner: DMatrix<f64>,
    /// Nodes of this rank that move with a set: the place of their unknowns, the set, and where they are.
    nodes: Vec<(usize, usize, Point)>,
}

impl RigidBorder {
    /// Assembles the columns. **Collective**
    pub fn new(problem: &Discretisation, session: &Session) -> Result<Self, SystemError> {
        let mut border = Self { components: Vec::new(), corner: DMatrix::zeros(0, 0), nodes: Vec::new() };
        let sets = &problem.scene.rigid;
        if sets.iter().all(|set| set.free().next().is_none()) {
            return Ok(border);
        }
        let (mesh, space) = (&problem.scene.mesh, problem.finest());
        let loads = nodal_forces(problem, session)?;
        let places: Vec<BTreeMap<usize, Point>> = sets.iter().map(|set| set.places(mesh, &space.numbering)).collect();
        let mut columns = Vec::new();
        for (number, set) in sets.iter().enumerate() {
            let arm = places[number].values().map(|x| (x - set.about).norm()).fold(f64::MIN_POSITIVE, f64::max);
            let moved = moved_nodes(problem, set, &places[number], session.rank());
            border.nodes.extend(moved.into_iter().map(|(node, x)| (2 * (node - space.own.start), number, x)));
            for k in set.free() {
                let column = moved_forces(problem, set, k, &places[number], session)?;
                let arm = if k == 2 { arm } else { 1.0 };
                let component = border.component(problem, &column, &loads, &places[number], (number, k, arm));
                border.components.push(component);
                columns.push(column);
            }
        }
        border.close(problem, &columns, session);
        Ok(border)
    }

    fn component(
        &self,
        problem: &Discretisation,
        column: &Field<2>,
        loads: &Field<2>,
        places: &BTreeMap<usize, Point>,
        (number, k, arm): (usize, usize, f64),
    ) -> Component {
        let (mesh, space) = (&problem.scene.mesh, problem.finest());
        let set = &problem.scene.rigid[number];
        let (mut forces, mut given) = (Vec::with_capacity(space.local_unknowns()), 0.0);
        for (at, node) in space.own.clone().enumerate() {
            let force = Point::from(column.own()[at]);
            forces.extend_from_slice(space.free_part(node, force).as_slice());
            given -= force.dot(&space.prescribed(node));
            if let Some(x) = places.get(&node) {
                given += Point::from(loads.own()[at]).dot(&set.mode(k, *x));
            }
        }
        let gap = |coupled: &crate::system::Coupled| {
            let x = places.get(&coupled.node.number(mesh, &space.numbering));
            x.map_or(0.0, |x| coupled.value.dot(&set.mode(k, *x)))
        };
        let gaps = problem.coupling.rows.iter().map(|row| row.iter().map(gap).sum()).collect();
        Component { set: number, k, arm, forces, gaps, given }
    }

    /// Adds up over the ranks what the nodes of each give, and forms `D`. **Collective**
    fn close(&mut self, problem: &Discretisation, columns: &[Field<2>], session: &Session) {
        let (sets, count) = (&problem.scene.rigid, self.components.len());
        let mut sums = vec![0.0; count * count + count];
        for (i, column) in columns.iter().enumerate() {
            for (j, other) in self.components.iter().enumerate() {
                let own = self.nodes.iter().filter(|(_, set, _)| *set == other.set);
                let work =
                    |(at, set, x): &(usize, usize, Point)| Point::from(column.own()[at / 2]).dot(&sets[*set].mode(other.k, *x));
                sums[i * count + j] = own.map(work).sum();
            }
            sums[count * count + i] = self.components[i].given;
        }
        session.sum(&mut sums);
        self.corner = DMatrix::from_row_slice(count, count, &sums[..count * count]);
        for (component, given) in self.components.iter_mut().zip(&sums[count * count..]) {
            component.given = given + sets[component.set].applied[component.k];
        }
    }

    /// Number of free components.
    pub fn len(&self) -> usize {
        self.components.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.components.is_empty()
    }

    /// The column of a component: forces on this rank's unknowns in the nodes' frames, and gaps of all multipliers.
    pub fn column(&self, component: usize) -> (&[f64], &[f64]) {
        let found = &self.components[component];
        (&found.forces, &found.gaps)
    }

    /// The free components among the motions of all sets.
    pub fn free_of(&self, motions: &[Motion]) -> Vec<f64> {
        self.components.iter().map(|component| motions[component.set][component.k]).collect()
    }

    /// Adds the displacements of nodes that move with rigid sets, by the free components of their motion, to those of this rank, in
    /// the nodes' frames, which are the global ones there.
    pub fn displace(&self, sets: &[RigidSet], motion: &[f64], displacement: &mut [f64]) {
        for &(at, set, x) in &self.nodes {
            for (component, value) in self.components.iter().zip(motion).filter(|(component, _)| component.set == set) {
                let u = *value * sets[set].mode(component.k, x);
                displacement[at] += u.x;
                displacement[at + 1] += u.y;
            }
        }
    }

    /// `Tᵀ x`, from displacements of this rank without those of rigid nodes, and pressures of all multipliers. **Collective**
    pub fn transposed(&self, displacement: &[f64], pressures: &[f64], session: &Session) -> DVector<f64> {
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let mut sums: Vec<f64> = self.components.iter().map(|component| dot(&component.forces, displacement)).collect();
        session.sum(&mut sums);
        let all = self.components.iter().zip(sums).map(|(component, sum)| sum + dot(&component.gaps, pressures));
        DVector::from_iterator(self.len(), all)
    }

    /// `h - Tᵀ x - D q`: what the sets are out of balance by.
    pub fn unbalanced(&self, transposed: &DVector<f64>, motion: &[f64]) -> DVector<f64> {
        let given = DVector::from_iterator(self.len(), self.components.iter().map(|component| component.given));
        given - transposed - &self.corner * DVector::from_row_slice(motion)
    }

    /// Forces out of balance over the largest force on a rigid set, moments by the size of the set.
    pub fn share(&self, unbalanced: &DVector<f64>, pressures: &[f64]) -> f64 {
        let (mut out, mut whole) = (0.0f64, 0.0f64);
        for (component, left) in self.components.iter().zip(unbalanced.iter()) {
            let pressed: f64 = component.gaps.iter().zip(pressures).map(|(gap, pressure)| (gap * pressure).abs()).sum();
            out = out.max(left.abs() / component.arm);
            whole = whole.max(pressed.max(component.given.abs()) / component.arm);
        }
        if out == 0.0 { 0.0 } else { out / whole }
    }

    /// The change of the motion that balances the sets: `(D - Tᵀ Z)⁻¹ g`, with `Tᵀ Z` by columns. Motions that nothing resists
    /// stay as they are.
    pub fn correction(&self, responses: &[DVector<f64>], unbalanced: &DVector<f64>) -> DVector<f64> {
        let arms = DVector::from_iterator(self.len(), self.components.iter().map(|component| component.arm));
        let entry = |i: usize, j: usize| (self.corner[(i, j)] - responses[j][i]) / (arms[i] * arms[j]);
        let schur = DMatrix::from_fn(self.len(), self.len(), entry);
        let least = NOTHING * schur.amax();
        let found = schur.svd(true, true).solve(&unbalanced.component_div(&arms), least);
        found.map_or_else(|_| DVector::zeros(self.len()), |found| found.component_div(&arms))
    }
}

/// Nodes of this rank that move with a set, and where they are: with a tool those within its triangles, too, so that its motion
/// is no force within it.
fn moved_nodes(problem: &Discretisation, set: &RigidSet, places: &BTreeMap<usize, Point>, rank: usize) -> BTreeMap<usize, Point> {
    let (scene, space) = (&problem.scene, problem.finest());
    let level = space.numbering.level;
    let mut moved: BTreeMap<usize, Point> =
        places.iter().filter(|(node, _)| space.own.contains(node)).map(|(&node, &x)| (node, x)).collect();
    let RigidNodes::Body(name) = &set.nodes else { return moved };
    let is_own = |triangle: &&u32| scene.mesh.bodies[scene.mesh.triangles[**triangle as usize].body as usize] == *name;
    for &triangle in scene.partition.triangles_of(rank).iter().filter(is_own) {
        let numbers = space.numbering.triangle(&scene.mesh, triangle as usize);
        for (i, j) in lattice::nodes(level.intervals) {
            let node = numbers.node(i, j);
            if space.own.contains(&node) {
                moved.entry(node).or_insert_with(|| scene.mesh.node_position(triangle as usize, level, (i, j)));
            }
        }
    }
    moved
}

/// `K R`: forces at all nodes when a set moves by one component, all else at rest; none of a tool. **Collective**
fn moved_forces(
    problem: &Discretisation,
    set: &RigidSet,
    k: usize,
    places: &BTreeMap<usize, Point>,
    session: &Session,
) -> Result<Field<2>, SystemError> {
    if let RigidNodes::Body(_) = set.nodes {
        return Ok(Field::zeros(problem, session));
    }
    let space = problem.finest();
    let mut moved = vec![0.0; space.local_unknowns()];
    for (&node, &x) in places.iter().filter(|(node, _)| space.own.contains(node)) {
        let (at, u) = (2 * (node - space.own.start), space.to_frame(node, set.mode(k, x)));
        (moved[at], moved[at + 1]) = (u.x, u.y);
    }
    let moved = Field::displacement(problem, &moved, session)?;
    let (mut forces, springs) = (internal_forces(problem, &moved, session)?.1, SpringForces::new(problem, &moved, session)?);
    forces.subtract(&springs.nodes);
    Ok(forces)
}
