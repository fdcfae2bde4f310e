//! Energies, reactions, and the balances of forces, moments and energy.

use crate::body::{Holders, Motion, RigidSet};
use crate::contact::{Configuration, Side};
use crate::discretisation::SpringForces;
use crate::discretisation::internal_forces;
use crate::discretisation::{Contact, Discretisation, Field, Solution, SystemError, nodal_forces, rigid_motions};
use crate::element::Plane;
use crate::geometry::{Point, cross};
use crate::mesh::{EdgeNode, lattice};
use crate::petsc::Session;
use crate::recovery::heat::heat_energies;
use std::collections::HashMap;
use std::collections::HashSet;

/// Forces on a body below this share of those on another are what a solve leaves: nothing acts on it.
const UNLOADED: f64 = 1e-6;

/// Work below this share of the largest is none: gaps measured where bodies touch are rounding.
const ROUNDING: f64 = 1e-12;

/// Resultants of one contact, from each body's own integrals.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ContactForce {
    /// `∫λ ds` (force per thickness).
    pub force: f64,
    /// Force on body 1 and on body 2.
    pub resultants: [Point; 2],
    /// Their moments about the origin.
    pub moments: [f64; 2],
}

/// Energies and balances of a solution.
#[derive(Clone, Debug, PartialEq)]
pub struct Balance {
    /// Strain energy of each body, `½∫σ:ε`.
    pub strain: Vec<f64>,
    /// The same of each part of the bodies, in the order of the mesh.
    pub strain_of_parts: Vec<f64>,
    /// Strain energy in all, from the stationary value of the Lagrangian: its algebraic error is the square of that of `u` and
    /// `λ`. Nothing where loads act together with gaps or prescribed displacements, a jump term is added, or springs act.
    pub stationary: Option<f64>,
    /// `f·u + r·u_D`.
    pub external_work: f64,
    /// Resultants of each contact.
    pub contacts: Vec<ContactForce>,
    /// Energy in elastic supports, `½∫k u²`; nothing if there are none.
    pub springs: Option<f64>,
    /// Force of each support on the bodies (per thickness), those of elastic ones and then those of mean motions after the others.
    pub reactions: Vec<Point>,
    /// Moment of each hold of a mean motion about the middle of its body (per thickness).
    pub mean_moments: Vec<f64>,
    /// Force of each rigid set on the bodies, and its moment about the reference point (per thickness).
    pub rigid: Vec<[f64; 3]>,
    /// Motion of each rigid set.
    pub motions: Vec<Motion>,
    /// Sum of the magnitudes of all forces on bodies: loads and reactions of their nodes, contact (per thickness).
    pub forces: f64,
    /// Largest `|F₁ + F₂| / |F₂|`; of a closed contact, where `F₂` may vanish, by `∫λ ds`.
    pub force: Option<f64>,
    /// Largest `|M₁ + M₂| / (|F₂| length)`, about the middle of Γ_C; nothing in bodies of revolution, which cannot turn.
    pub moment: Option<f64>,
    /// `|2U + 2S - (f·u + r·u_D - λᵀc - λᵀCλ)|`, `S` being the energy in springs, over the largest of the terms.
    pub energy: Option<f64>,
    /// Largest `|loads + reactions + contact|` of a body over the sum of magnitudes of these.
    pub bodies: Option<f64>,
}

/// Integrates energies and reactions of a solution. **Collective**
///
/// # Errors
/// [`SystemError`] from PETSc or an inverted triangle.
pub fn balance(problem: &Discretisation, solution: &Solution, u: &Field<2>, session: &Session) -> Result<Balance, SystemError> {
    let Discretisation { contacts, coupling, .. } = problem;
    let (mut strain_of_parts, internal) = internal_forces(problem, u, session)?;
    session.sum(&mut strain_of_parts);
    let heat = heat_energies(problem, u, session)?;
    strain_of_parts.iter_mut().zip(&heat).for_each(|(strain, heat)| *strain += heat.kept - heat.work);
    // By how much the work of loads and supports exceeds that of stresses on elastic strains.
    let grown: f64 = heat.iter().map(|heat| heat.work - 2.0 * heat.kept).sum();
    let mut strain = vec![0.0; problem.scene.bodies.len()];
    let of_parts = problem.scene.mesh.parts.iter().zip(&strain_of_parts);
    of_parts.for_each(|(part, energy)| strain[part.body as usize] += energy);
    let springs = SpringForces::new(problem, u, session)?;
    let NodeSums { work, bodies, mut reactions, rigid } =
        sum_over_nodes(problem, solution, u, &internal, &springs.nodes, session)?;
    reactions.extend(springs.reactions);
    reactions.extend(problem.mean_forces.iter().map(|&[x, y, _]| Point::new(x, y)));
    let plane = problem.scene.mesh.plane;
    let reactions = reactions.into_iter().map(|force| plane.resultant(force)).collect();
    let rigid = rigid.into_iter().map(|force| plane.resultant_with_moment(force)).collect();
    let has_springs = !problem.scene.springs.is_empty();
    let forces = contact_forces_of_all(problem, solution, session);
    let lambda_gap: f64 = solution.multipliers.iter().zip(&coupling.gap).map(|(lambda, gap)| lambda * gap).sum();
    let gaps: f64 = solution.multipliers.iter().zip(&coupling.gap).map(|(lambda, gap)| (lambda * gap).abs()).sum();
    let jumped: f64 = problem
        .jumps()
        .map(|jump| jump.weight * (solution.multipliers[jump.rows[0]] - solution.multipliers[jump.rows[1]]).powi(2))
        .sum();
    let pushed: f64 = heat.iter().map(|heat| heat.work).sum();
    let (total, external) = (strain.iter().sum::<f64>(), work.loads + work.supports - pushed);
    let largest =
        [2.0 * (total + springs.energy), work.loads, work.supports, lambda_gap].into_iter().map(f64::abs).fold(0.0, f64::max);
    let worst = |ratio: &dyn Fn(&Contact, &ContactForce) -> f64| {
        contacts.iter().zip(&forces).map(|(contact, force)| ratio(contact, force)).filter(|v| v.is_finite()).reduce(f64::max)
    };
    Ok(Balance {
        external_work: external,
        force: worst(&|contact, force| (force.resultants[0] + force.resultants[1]).norm() / force.size(contact)),
        moment: worst(&|contact, force| {
            if plane == Plane::Revolution {
                return f64::NAN;
            }
            let middle = contact.boundary.point(contact.boundary.parameter_at(0.5 * contact.boundary.length()));
            let sum = force.moments[0] + force.moments[1] - cross(middle, force.resultants[0] + force.resultants[1]);
            sum.abs() / (force.size(contact) * contact.boundary.length())
        }),
        energy: (largest > 0.0)
            .then(|| (2.0 * (total + springs.energy) - (external - lambda_gap - jumped - grown)).abs() / largest),
        springs: has_springs.then_some(springs.energy),
        stationary: if has_springs || problem.scene.is_heated() || jumped > ROUNDING * largest {
            None
        } else {
            work.stationary(total, lambda_gap, gaps > ROUNDING * largest)
        },
        bodies: body_balance(plane, contacts, &forces, &bodies),
        strain,
        strain_of_parts,
        reactions,
        mean_moments: problem.mean_forces.iter().map(|&[_, _, moment]| moment).collect(),
        rigid,
        motions: rigid_motions(problem, &solution.displacement, session),
        forces: magnitudes(contacts, &forces, &bodies),
        contacts: forces,
    })
}

impl ContactForce {
    /// What the forces of a contact are measured by: all around a ring, or an axis of revolution, they may cancel.
    fn size(&self, contact: &Contact) -> f64 {
        let resultant = self.resultants[1].norm();
        if contact.boundary.is_closed() || contact.boundary.is_round() { resultant.max(self.force.abs()) } else { resultant }
    }
}

/// Work, by what does it.
#[derive(Clone, Copy, Debug, Default)]
struct WorkTerms {
    /// `f·u`
    loads: f64,
    /// `r·u_D`
    supports: f64,
    /// `(Bᵀλ)·u`
    contact: f64,
    /// `(f - Ku - Bᵀλ)·u` on all components that are free: zero but for the algebraic error.
    unbalanced: f64,
    /// `r·(u - u_D)`: zero but for the algebraic error.
    missed: f64,
    /// `Σ|f|` and `Σ|u_D|`: whether there are loads, and displacements prescribed.
    given: [f64; 2],
}

impl WorkTerms {
    /// The strain energy with an error that is quadratic in that of the solution: `U + z·(f - Ku - Bᵀλ) + μ·(c - Bu)`. Its first
    /// variation vanishes if `Kz + Bᵀμ = Ku` on free components, `Bz = 0`, and `z = 0` at supports.
    ///
    /// - Where loads alone do work, that is `z = u`, `μ = 0`, and the value is minus the Lagrangian.
    /// - Where prescribed displacements and gaps alone do work, it is `z = 0`, `μ = -λ`, and the value is the Lagrangian.
    /// - Where both do, `z` is the solution under the loads alone. It would take another solve: nothing.
    fn stationary(&self, strain: f64, lambda_gap: f64, gaps: bool) -> Option<f64> {
        let [loaded, moved] = self.given.map(|sum| sum > 0.0);
        match (loaded, moved || gaps) {
            (_, false) => Some(strain + self.unbalanced),
            (false, true) => Some(strain + self.contact - lambda_gap - self.missed),
            (true, true) => None,
        }
    }
}

/// Sums over all nodes.
struct NodeSums {
    work: WorkTerms,
    /// Loads and reactions of each body.
    bodies: Vec<ForceSum>,
    /// Force of each support.
    reactions: Vec<Point>,
    /// Force and moment of each rigid set.
    rigid: Vec<[f64; 3]>,
}

/// Forces added up.
#[derive(Clone, Copy, Default)]
struct ForceSum {
    /// Their sum.
    force: Point,
    /// The sum of their magnitudes.
    magnitudes: f64,
}

impl ForceSum {
    fn add(&mut self, force: Point) {
        self.force += force;
        self.magnitudes += force.norm();
    }

    /// Adds up those of all ranks. **Collective**
    fn of_all_ranks(own: &[Self], session: &Session) -> Vec<Self> {
        let mut sums: Vec<f64> = own.iter().flat_map(|sum| [sum.force.x, sum.force.y, sum.magnitudes]).collect();
        session.sum(&mut sums);
        sums.chunks_exact(3).map(|sum| Self { force: Point::new(sum[0], sum[1]), magnitudes: sum[2] }).collect()
    }
}

/// Work and resultants of loads, supports and contact, of the forces `internal` `= Ku` of the bodies and those
/// of `springs`. **Collective**
fn sum_over_nodes(
    problem: &Discretisation,
    solution: &Solution,
    u: &Field<2>,
    internal: &Field<2>,
    springs: &Field<2>,
    session: &Session,
) -> Result<NodeSums, SystemError> {
    let space = problem.finest();
    let applied = nodal_forces(problem, session)?;
    let pressed = contact_forces(problem, solution);
    let body_of = body_of_nodes(problem, session.rank());
    let supports = &problem.scene.supports;
    let holders = Holders::new(&problem.scene.mesh, &space.numbering, supports).map_err(|error| SystemError::Case(error.0))?;
    // These carry nothing in a solution: what they do carry is missing in the balance of their body.
    let anchors = anchor_nodes(problem);
    let mut reactions = vec![0.0; 2 * supports.len()];
    let sets = &problem.scene.rigid;
    let set_of = set_of_nodes(problem);
    let mut rigid = vec![0.0; 3 * sets.len()];
    let mut bodies = vec![ForceSum::default(); problem.scene.bodies.len()];
    // The force on a set whose motion is unknown is a load, though no node has it.
    let unknown = |set: &RigidSet| (0..3).filter(|&k| set.prescribed[k].is_none()).map(|k| set.applied[k].abs()).sum::<f64>();
    let on_sets = if session.rank() == 0 { sets.iter().map(unknown).sum() } else { 0.0 };
    let mut work = WorkTerms { given: [on_sets, 0.0], ..WorkTerms::default() };
    for (at, node) in space.own.clone().enumerate() {
        let [f, k, pull] = [applied.own()[at], internal.own()[at], springs.own()[at]].map(|[x, y]| Point::new(x, y));
        let (u, push) = (u.point(node), pressed.get(&node).copied().unwrap_or_default());
        work.loads += f.dot(&u);
        work.contact += push.dot(&u);
        work.given[0] += f.norm();
        // Contact pushes body 1 along -n: K u + Bᵀλ = f + r.
        let residual = f + pull - k - push;
        bodies[body_of[at]].add(pull);
        let Some(constraint) = space.constraints.get(node) else {
            work.unbalanced += residual.dot(&u);
            bodies[body_of[at]].add(f);
            continue;
        };
        let [residual, u] = [residual, u].map(|v| constraint.to_frame(v));
        let free = constraint.free_part(residual);
        let (reaction, prescribed) = (free - residual, constraint.prescribed());
        work.unbalanced += free.dot(&u);
        work.supports += reaction.dot(&prescribed);
        work.missed += reaction.dot(&(u - prescribed));
        work.given[1] += prescribed.norm();
        bodies[body_of[at]].add(f);
        let reaction = constraint.to_global(reaction);
        if !anchors.contains(&node) {
            bodies[body_of[at]].add(reaction);
        }
        if let Some(&(set, x)) = set_of.get(&node) {
            (0..3).for_each(|k| rigid[3 * set + k] += reaction.dot(&sets[set].mode(k, x)));
        }
        for (support, force) in holders.shares(node, reaction) {
            reactions[2 * support] += force.x;
            reactions[2 * support + 1] += force.y;
        }
    }
    session.sum(&mut reactions);
    session.sum(&mut rigid);
    let rigid = rigid.as_chunks().0.to_vec();
    let reactions = reactions.chunks_exact(2).map(|force| Point::new(force[0], force[1])).collect();
    let mut sums = [work.loads, work.supports, work.contact, work.unbalanced, work.missed, work.given[0], work.given[1]];
    session.sum(&mut sums);
    let [loads, supports, contact, unbalanced, missed, ref given @ ..] = sums;
    let bodies = ForceSum::of_all_ranks(&bodies, session);
    Ok(NodeSums { work: WorkTerms { loads, supports, contact, unbalanced, missed, given: *given }, bodies, reactions, rigid })
}

/// The rigid set of each node that is in one, and where the node is.
fn set_of_nodes(problem: &Discretisation) -> HashMap<usize, (usize, Point)> {
    let (scene, numbering) = (&problem.scene, &problem.finest().numbering);
    let places = |(number, set): (usize, &RigidSet)| {
        set.places(&scene.mesh, numbering).into_iter().map(move |(node, x)| (node, (number, x)))
    };
    scene.rigid.iter().enumerate().flat_map(places).collect()
}

/// Nodes that hold bodies whose mean motion is held while the system is solved.
fn anchor_nodes(problem: &Discretisation) -> HashSet<usize> {
    let numbering = &problem.finest().numbering;
    let anchors = problem.scene.means.iter().flat_map(|hold| &hold.anchors);
    anchors.map(|anchor| numbering.vertex(anchor.vertex)).collect()
}

/// Sum of the magnitudes of the forces on all bodies.
fn magnitudes(contacts: &[Contact], forces: &[ContactForce], outer: &[ForceSum]) -> f64 {
    let pressed: f64 = contacts.iter().zip(forces).map(|(contact, force)| 2.0 * force.size(contact)).sum();
    pressed + outer.iter().map(|sum| sum.magnitudes).sum::<f64>()
}

/// Largest sum of loads, reactions and contact forces on a body, along the axis alone in a body of revolution, over the sum of
/// their magnitudes.
fn body_balance(plane: Plane, contacts: &[Contact], forces: &[ContactForce], outer: &[ForceSum]) -> Option<f64> {
    let sum = |(body, &outer): (usize, &ForceSum)| {
        let mut all = outer;
        for (contact, force) in contacts.iter().zip(forces) {
            for k in (0..2).filter(|&k| contact.bodies[k] == body) {
                all.add(force.resultants[k]);
                all.magnitudes += force.size(contact) - force.resultants[1].norm();
            }
        }
        (plane.resultant(all.force).norm(), all.magnitudes)
    };
    let all: Vec<(f64, f64)> = outer.iter().enumerate().map(sum).collect();
    let largest = all.iter().map(|(_, magnitudes)| *magnitudes).fold(0.0, f64::max);
    let acts = |&(_, magnitudes): &(f64, f64)| magnitudes > UNLOADED * largest;
    all.into_iter().filter(acts).map(|(sum, magnitudes)| sum / magnitudes).filter(|v| v.is_finite()).reduce(f64::max)
}

/// `Bᵀλ` at the contact nodes of this rank; at others a part of it.
fn contact_forces(problem: &Discretisation, solution: &Solution) -> HashMap<usize, Point> {
    let mut forces = HashMap::new();
    for (row, lambda) in problem.coupling.rows.iter().zip(&solution.multipliers) {
        for coupled in row {
            *forces.entry(coupled.node.number(&problem.scene.mesh, &problem.finest().numbering)).or_insert(Point::zeros()) +=
                *lambda * coupled.value;
        }
    }
    forces
}

/// Force, resultants and moments of each contact. **Collective**
fn contact_forces_of_all(problem: &Discretisation, solution: &Solution, session: &Session) -> Vec<ContactForce> {
    let of_rank = |contact: &Contact| {
        let ContactForce { force, resultants: [a, b], moments } = contact_force(problem, contact, solution, session.rank());
        [force, a.x, a.y, b.x, b.y, moments[0], moments[1]]
    };
    let mut sums: Vec<[f64; 7]> = problem.contacts.iter().map(of_rank).collect();
    session.sum(sums.as_flattened_mut());
    let whole = |[force, ax, ay, bx, by, first, second]: [f64; 7]| ContactForce {
        force,
        resultants: [Point::new(ax, ay), Point::new(bx, by)],
        moments: [first, second],
    };
    sums.into_iter().map(whole).collect()
}

/// The part of one contact that the multipliers of a rank have.
fn contact_force(problem: &Discretisation, contact: &Contact, solution: &Solution, rank: usize) -> ContactForce {
    let mut sum = ContactForce::default();
    let (mesh, space) = (&problem.scene.mesh, problem.finest());
    let moves = contact.pair.configuration == Configuration::Deformed;
    // A side that is drawn apart from Γ_C will lie there.
    let shifts = contact.known.meeting.as_ref().map_or([Point::zeros(); 2], |meeting| meeting.shifts);
    let place = |node: EdgeNode| {
        let x = node.place(mesh, &space.numbering);
        if moves { x + problem.motion.at(node, mesh, space) } else { x }
    };
    for i in problem.coupling.own(contact.range(), rank) {
        let lambda = solution.multipliers[i];
        sum.force += lambda * contact.multipliers.integral(i - contact.first);
        for coupled in &problem.coupling.rows[i] {
            let k = if coupled.side == Side::First { 0 } else { 1 };
            let force = -lambda * coupled.value;
            sum.resultants[k] += mesh.plane.resultant(force);
            sum.moments[k] += cross(place(coupled.node) + shifts[k], force);
        }
    }
    sum
}

/// Body of each owned node.
fn body_of_nodes(problem: &Discretisation, rank: usize) -> Vec<usize> {
    let (scene, space) = (&problem.scene, problem.finest());
    let mut body = vec![0; space.own.len()];
    for &triangle in scene.partition.triangles_of(rank) {
        let numbers = space.numbering.triangle(&scene.mesh, triangle as usize);
        for (i, j) in lattice::nodes(space.numbering.level.intervals) {
            if let Some(at) = numbers.node(i, j).checked_sub(space.own.start).filter(|&at| at < body.len()) {
                body[at] = scene.mesh.triangles[triangle as usize].body as usize;
            }
        }
    }
    body
}
