//! Rigid motions that are unknown: of tools that carry a force, of plates that press, of bodies whose mean motion is held.
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
//!
//! A body whose mean motion is held has two unknowns for each component of it: how far the whole body has moved, `q`, a column as
//! of a tool; and the force `μ` that holds it, spread over the body by the weights `M` of the mean, with the column `-M`. The row
//! of `q` is the mean, `M u + M R q` as it was asked for; that of `μ` the balance of the body, `(B R)ᵀ λ - Rᵀ M μ = Rᵀ f`, so that
//! its anchors carry nothing.

use super::mean_motion::{mean_motion, mean_weights, nodes_of_body};
use super::rigid_motions;
use crate::body::{MeanHold, RigidNodes, RigidSet, rigid_mode};
use crate::geometry::Point;
use crate::petsc::Session;
use crate::system::recovery::{SpringForces, internal_forces};
use crate::system::{Coupled, Discretisation, Field, SystemError, nodal_forces};
use nalgebra::{DMatrix, DVector};
use std::collections::BTreeMap;
use std::rc::Rc;

/// Singular values of the border below this share of the largest belong to motions that nothing resists.
const NOTHING: f64 = 1e-13;

/// Gaps below this share of what their terms add up to are rounding.
const ROUNDING: f64 = 1e-12;

/// Forces below this share of those that they are the difference of are rounding.
const LOST: f64 = 16.0 * f64::EPSILON;

/// A column or a row of the border.
#[derive(Clone)]
struct BorderLine {
    /// Its part on this rank's free unknowns, in the nodes' frames.
    displacement: Rc<[f64]>,
    /// Its part on all multipliers.
    pressures: Rc<[f64]>,
}

/// An unknown of the border: a component of a rigid motion, or the force that holds its mean.
struct Component {
    /// Index of what moves: the rigid sets of the scene, then the bodies whose mean motion is held.
    set: usize,
    /// Which of its components.
    k: usize,
    /// Whether it is the force that holds the mean.
    holds: bool,
    /// What it and its row are multiplied and divided by, so that all entries of the border are alike.
    scale: [f64; 2],
    /// `T`.
    column: BorderLine,
    /// `Tᵀ`, or what stands in its place.
    row: BorderLine,
    /// `h`: force or moment to balance, or the mean that is asked for.
    given: f64,
}

/// All unknown components of rigid motions.
pub struct RigidBorder {
    components: Vec<Component>,
    /// `D`.
    corner: DMatrix<f64>,
    /// Nodes of this rank that move along: the place of their unknowns, with what they move, and where they are.
    nodes: Vec<(usize, usize, Point)>,
    /// What each of these motions turns about.
    about: Vec<Point>,
}

impl RigidBorder {
    /// Assembles the columns. **Collective**
    pub fn new(problem: &Discretisation, session: &Session) -> Result<Self, SystemError> {
        let (mesh, sets, means) = (&problem.scene.mesh, &problem.scene.rigid, &problem.scene.means);
        let about = sets.iter().map(|set| set.about).chain(means.iter().map(|hold| hold.middle(mesh))).collect();
        let mut border = Self { components: Vec::new(), corner: DMatrix::zeros(0, 0), nodes: Vec::new(), about };
        if means.is_empty() && sets.iter().all(|set| set.free().next().is_none()) {
            return Ok(border);
        }
        let loads = nodal_forces(problem, session)?;
        let mut rows = Vec::new();
        for (number, set) in sets.iter().enumerate() {
            rows.extend(border.add_set(problem, number, set, &loads, session)?);
        }
        for (at, hold) in means.iter().enumerate() {
            rows.extend(border.add_mean(problem, sets.len() + at, hold, &loads, session)?);
        }
        border.close(problem, &rows, session);
        Ok(border)
    }

    /// Adds the free components of a rigid set, and returns the rows of their balances. **Collective**
    fn add_set(
        &mut self,
        problem: &Discretisation,
        number: usize,
        set: &RigidSet,
        loads: &Field<2>,
        session: &Session,
    ) -> Result<Vec<Field<2>>, SystemError> {
        let space = problem.finest();
        let places = set.places(&problem.scene.mesh, &space.numbering);
        let arm = arm(problem, set, &places, session);
        let moved = moved_nodes(problem, set, &places, session.rank());
        self.nodes.extend(moved.into_iter().map(|(node, x)| (2 * (node - space.own.start), number, x)));
        let mut rows = Vec::new();
        for k in set.free() {
            let row = moved_forces(problem, set, k, &places, session)?;
            let (forces, at_rest) = free_part(problem, &row);
            let own = space.own.clone().zip(loads.own());
            let pushed = own.filter_map(|(node, load)| Some(Point::from(*load).dot(&set.mode(k, *places.get(&node)?))));
            let given = pushed.sum::<f64>() - at_rest;
            let gaps = moved_gaps(problem, session, |coupled| {
                let x = places.get(&coupled.node.number(&problem.scene.mesh, &space.numbering));
                x.map(|x| set.mode(k, *x))
            });
            let (arm, young) = (if k == 2 { arm } else { 1.0 }, largest_young(problem));
            let column = BorderLine { displacement: forces, pressures: gaps };
            let scale = [arm, arm * young];
            self.components.push(Component { set: number, k, holds: false, scale, row: column.clone(), column, given });
            rows.push(row);
        }
        Ok(rows)
    }

    /// Adds the components of a body whose mean is held, and returns the rows of its mean and of its balance. **Collective**
    fn add_mean(
        &mut self,
        problem: &Discretisation,
        number: usize,
        hold: &MeanHold,
        loads: &Field<2>,
        session: &Session,
    ) -> Result<Vec<Field<2>>, SystemError> {
        let (mesh, space, about) = (&problem.scene.mesh, problem.finest(), self.about[number]);
        let nodes = nodes_of_body(problem, &hold.body, session.rank());
        let mut rows = Vec::new();
        for k in hold.held() {
            let weights = mean_weights(problem, hold, k, session)?;
            let (mean, at_rest) = free_part(problem, &weights);
            let force: Rc<[f64]> = mean.iter().map(|weight| -weight).collect();
            let nothing: Rc<[f64]> = vec![0.0; mean.len()].into();
            let gaps = moved_gaps(problem, session, |coupled| {
                let x = coupled.node.place(mesh, &space.numbering);
                (problem.scene.bodies[coupled.body].name == hold.body).then(|| rigid_mode(about, k, x))
            });
            let no_gaps: Rc<[f64]> = vec![0.0; gaps.len()].into();
            let (arm, young) = (if k == 2 { hold.reach(mesh) } else { 1.0 }, largest_young(problem));
            self.components.push(Component {
                set: number,
                k,
                holds: false,
                scale: [arm, 1.0 / arm],
                column: BorderLine { displacement: nothing.clone(), pressures: gaps.clone() },
                row: BorderLine { displacement: mean, pressures: no_gaps.clone() },
                given: -at_rest,
            });
            let pushed = nodes.iter().map(|(&node, &x)| loads.point(node).dot(&rigid_mode(about, k, x)));
            self.components.push(Component {
                set: number,
                k,
                holds: true,
                scale: [1.0 / (arm * young), arm * young],
                column: BorderLine { displacement: force, pressures: no_gaps },
                row: BorderLine { displacement: nothing, pressures: gaps },
                given: pushed.sum(),
            });
            rows.extend([weights, Field::zeros(problem, session)]);
        }
        self.nodes.extend(nodes.into_iter().map(|(node, x)| (2 * (node - space.own.start), number, x)));
        Ok(rows)
    }

    /// Adds up over the ranks what the nodes of each give, and forms `D`. **Collective**
    fn close(&mut self, problem: &Discretisation, rows: &[Field<2>], session: &Session) {
        let (scene, count) = (&problem.scene, self.components.len());
        let mut sums = vec![0.0; count * count + count];
        for (i, row) in rows.iter().enumerate() {
            for (j, other) in self.components.iter().enumerate() {
                let mode = |x: &Point| rigid_mode(self.about[other.set], other.k, *x);
                let own = self.nodes.iter().filter(|(_, set, _)| *set == other.set);
                sums[i * count + j] = own.map(|(at, _, x)| Point::from(row.own()[at / 2]).dot(&mode(x))).sum();
            }
            sums[count * count + i] = self.components[i].given;
        }
        session.sum(&mut sums);
        let all = DMatrix::from_row_slice(count, count, &sums[..count * count]);
        let holds: Vec<bool> = self.components.iter().map(|component| component.holds).collect();
        // Beside each mean stands its force, with `-Rᵀ M` of the same modes and weights.
        self.corner = DMatrix::from_fn(count, count, |i, j| match (holds[i], holds[j]) {
            (false, false) => all[(i, j)],
            (true, true) => -all[(j - 1, i - 1)],
            _ => 0.0,
        });
        for (component, given) in self.components.iter_mut().zip(&sums[count * count..]) {
            let asked = match component.set.checked_sub(scene.rigid.len()) {
                None => scene.rigid[component.set].applied[component.k],
                Some(at) => scene.means[at].mean[component.k].filter(|_| !component.holds).unwrap_or_default(),
            };
            component.given = given + asked;
        }
    }

    /// Number of unknowns.
    pub fn len(&self) -> usize {
        self.components.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.components.is_empty()
    }

    /// The column of an unknown: forces on this rank's unknowns in the nodes' frames, and gaps of all multipliers.
    pub fn column(&self, component: usize) -> (&[f64], &[f64]) {
        let BorderLine { displacement, pressures } = &self.components[component].column;
        (displacement, pressures)
    }

    /// The unknowns that this rank's displacements, in the nodes' frames, have in them; forces that hold a mean begin with nothing.
    /// **Collective**
    pub fn motion_of(&self, problem: &Discretisation, displacement: &[f64], session: &Session) -> Vec<f64> {
        let scene = &problem.scene;
        let sets = rigid_motions(problem, displacement, session);
        let free = scene.rigid.iter().zip(&sets).flat_map(|(set, motion)| set.free().map(|k| motion[k]));
        let means = scene.means.iter().flat_map(|hold| mean_motion(problem, hold, displacement, session));
        free.chain(means.flat_map(|q| [q, 0.0])).collect()
    }

    /// Adds the displacements by a motion to those of this rank, in the nodes' frames.
    pub fn displace(&self, problem: &Discretisation, motion: &[f64], displacement: &mut [f64]) {
        let space = problem.finest();
        for &(at, set, x) in &self.nodes {
            let moves = |(component, _): &(&Component, &f64)| component.set == set && !component.holds;
            for (component, value) in self.components.iter().zip(motion).filter(moves) {
                let u = space.to_frame(space.own.start + at / 2, *value * rigid_mode(self.about[set], component.k, x));
                displacement[at] += u.x;
                displacement[at + 1] += u.y;
            }
        }
    }

    /// `Tᵀ x`, or what stands in its place, from displacements of this rank without those of rigid motions, and pressures of all
    /// multipliers; and the sums of the magnitudes of its terms. **Collective**
    pub fn transposed(&self, displacement: &[f64], pressures: &[f64], session: &Session) -> [DVector<f64>; 2] {
        let dot = |a: &[f64], b: &[f64]| {
            let terms = a.iter().zip(b).map(|(a, b)| a * b);
            terms.fold([0.0; 2], |[sum, whole], term| [sum + term, whole + term.abs()])
        };
        let of_rank = |component: &Component| dot(&component.row.displacement, displacement);
        let mut sums: Vec<[f64; 2]> = self.components.iter().map(of_rank).collect();
        session.sum(sums.as_flattened_mut());
        for (component, sums) in self.components.iter().zip(&mut sums) {
            let pressed = dot(&component.row.pressures, pressures);
            sums.iter_mut().zip(pressed).for_each(|(sum, pressed)| *sum += pressed);
        }
        [0, 1].map(|k| DVector::from_iterator(self.len(), sums.iter().map(|sums| sums[k])))
    }

    /// `Rᵀ f` of the bodies whose mean motion is held, for other nodal forces of this rank in the nodes' frames. **Collective**
    pub fn loaded(&self, problem: &Discretisation, load: &[f64], session: &Session) -> DVector<f64> {
        let space = problem.finest();
        let mut sums = vec![0.0; self.len()];
        for (sum, component) in sums.iter_mut().zip(&self.components).filter(|(_, component)| component.holds) {
            for &(at, _, x) in self.nodes.iter().filter(|(_, set, _)| *set == component.set) {
                let force = space.to_global(space.own.start + at / 2, Point::new(load[at], load[at + 1]));
                *sum += force.dot(&rigid_mode(self.about[component.set], component.k, x));
            }
        }
        session.sum(&mut sums);
        DVector::from_vec(sums)
    }

    /// `h - Tᵀ x - D q`: what sets and bodies are out of balance by, and means are off by; nothing where that is rounding beside
    /// the terms of the three. Nodal forces of a body that hardly changes its volume are thousands of times as large as what they
    /// add up to.
    pub fn unbalanced(&self, [transposed, terms]: &[DVector<f64>; 2], motion: &[f64]) -> DVector<f64> {
        let given = DVector::from_iterator(self.len(), self.components.iter().map(|component| component.given));
        let motion = DVector::from_row_slice(motion);
        let whole = given.abs() + terms + self.corner.abs() * motion.abs();
        let left = given - transposed - &self.corner * motion;
        left.zip_map(&whole, |left, whole| if left.abs() <= LOST * whole { 0.0 } else { left })
    }

    /// The larger of two: forces out of balance over the largest force that is balanced, moments by the size of what moves; and
    /// what means are off by, over the `largest` displacement. Forces that strain by no more than rounding are in balance: bodies
    /// that touch nothing yet have no others.
    pub fn share(&self, unbalanced: &DVector<f64>, pressures: &[f64], largest: f64) -> f64 {
        let (mut out, mut whole, mut off) = (0.0f64, 0.0f64, 0.0f64);
        for (i, (component, left)) in self.components.iter().zip(unbalanced.iter()).enumerate() {
            let left = left.abs() / component.scale[1];
            if self.components.get(i + 1).is_some_and(|next| next.holds) {
                off = off.max(left);
                continue;
            }
            let pressed: f64 = component.row.pressures.iter().zip(pressures).map(|(gap, pressure)| (gap * pressure).abs()).sum();
            out = out.max(left);
            whole = whole.max(pressed.max(component.given.abs()) / component.scale[1]);
        }
        let ratio = |part: f64, whole: f64| if part == 0.0 { 0.0 } else { part / whole };
        let out = if out <= f64::EPSILON * largest { 0.0 } else { out };
        ratio(out, whole).max(ratio(off, largest))
    }

    /// The change of the unknowns that balances sets and bodies: `(D - Tᵀ Z)⁻¹ g`, with `Tᵀ Z` by columns. Motions that nothing
    /// resists stay as they are.
    pub fn correction(&self, responses: &[DVector<f64>], unbalanced: &DVector<f64>) -> DVector<f64> {
        let scales = |of: usize| DVector::from_iterator(self.len(), self.components.iter().map(|component| component.scale[of]));
        let (columns, rows) = (scales(0), scales(1));
        let entry = |i: usize, j: usize| (self.corner[(i, j)] - responses[j][i]) / (rows[i] * columns[j]);
        let schur = DMatrix::from_fn(self.len(), self.len(), entry);
        let least = NOTHING * schur.amax();
        let found = schur.svd(true, true).solve(&unbalanced.component_div(&rows), least);
        found.map_or_else(|_| DVector::zeros(self.len()), |found| found.component_div(&columns))
    }
}

/// Largest Young's modulus of what is no tool: forces are measured by it.
fn largest_young(problem: &Discretisation) -> f64 {
    problem.scene.young().into_iter().filter(|young| young.is_finite()).fold(f64::MIN_POSITIVE, f64::max)
}

/// A row on this rank's free unknowns, in the nodes' frames, and its product with what supports prescribe.
fn free_part(problem: &Discretisation, row: &Field<2>) -> (Rc<[f64]>, f64) {
    let space = problem.finest();
    let (mut free, mut at_rest) = (Vec::with_capacity(space.local_unknowns()), 0.0);
    for (node, value) in space.own.clone().zip(row.own()) {
        let value = Point::from(*value);
        free.extend_from_slice(space.free_part(node, value).as_slice());
        at_rest += value.dot(&space.prescribed(node));
    }
    (free.into(), at_rest)
}

/// `B R` of all multipliers, with the displacement of each coupled node that moves; where all of it cancels it is zero.
/// **Collective**
fn moved_gaps(problem: &Discretisation, session: &Session, moved: impl Fn(&Coupled) -> Option<Point>) -> Rc<[f64]> {
    let coupling = &problem.coupling;
    let gap = |row: usize| {
        let (mut sum, mut whole) = (0.0, 0.0);
        for (coupled, u) in coupling.rows[row].iter().filter_map(|coupled| Some((coupled, moved(coupled)?))) {
            sum += coupled.value.dot(&u);
            whole += coupled.value.norm() * u.norm();
        }
        if sum.abs() <= ROUNDING * whole { 0.0 } else { sum }
    };
    let mut gaps = vec![0.0; coupling.owners.len()];
    coupling.own(0..gaps.len(), session.rank()).for_each(|i| gaps[i] = gap(i));
    session.sum(&mut gaps);
    gaps.into()
}

/// Largest distance from the reference point at which contact acts on a set; of its nodes where none does: a tool may be far longer
/// than what it touches. **Collective**
fn arm(problem: &Discretisation, set: &RigidSet, places: &BTreeMap<usize, Point>, session: &Session) -> f64 {
    let (mesh, numbering) = (&problem.scene.mesh, &problem.finest().numbering);
    let farthest = |x: &mut dyn Iterator<Item = &Point>| x.map(|x| (x - set.about).norm()).fold(0.0, f64::max);
    let mut touched = problem.coupling.rows.iter().flatten().filter_map(|at| places.get(&at.node.number(mesh, numbering)));
    let mut arms = [farthest(&mut touched), farthest(&mut places.values())];
    session.max(&mut arms);
    arms.into_iter().find(|arm| *arm > 0.0).unwrap_or(f64::MIN_POSITIVE)
}

/// Nodes of this rank that move with a set, and where they are: with a tool those within its triangles, too, so that its motion
/// is no force within it.
fn moved_nodes(problem: &Discretisation, set: &RigidSet, places: &BTreeMap<usize, Point>, rank: usize) -> BTreeMap<usize, Point> {
    if let RigidNodes::Body(name) = &set.nodes {
        return nodes_of_body(problem, name, rank);
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_rounding_leaves_of_large_forces_is_in_balance() {
        let nothing = || BorderLine { displacement: Rc::new([]), pressures: Rc::new([]) };
        let (column, row) = (nothing(), nothing());
        let component = Component { set: 0, k: 1, holds: false, scale: [1.0; 2], column, row, given: 1.0 };
        let border =
            RigidBorder { components: vec![component], corner: DMatrix::zeros(1, 1), nodes: Vec::new(), about: Vec::new() };
        let left = |off: f64, terms: f64| border.unbalanced(&[1.0 - off, terms].map(|v| DVector::from_vec(vec![v])), &[0.0])[0];
        assert_eq!(left(1e-12, 1e4), 0.0, "ten thousand times a rounding");
        assert!(left(1e-10, 1e4) > 9e-11 && left(1e-12, 1.0) > 9e-13, "more than that");
    }
}
