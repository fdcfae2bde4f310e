//! Work and resultants of all forces, node by node.

use crate::body::{Constraint, Holders, RigidSet, Support};
use crate::discretisation::{Discretisation, Field, Solution, SystemError, nodal_forces};
use crate::geometry::{Point, cross};
use crate::mesh::BoundaryEdge;
use crate::petsc::Session;
use std::collections::{HashMap, HashSet};

/// Angle between edges of a boundary (radians) from which on it is curved: nodes in a file of six digits make less.
const BENT: f64 = 1e-3;

/// Work, by what does it.
#[derive(Clone, Copy, Debug, Default)]
pub struct WorkTerms {
    /// `f·u`
    pub loads: f64,
    /// `r·u_D`
    pub supports: f64,
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
    /// The force on a set whose motion is unknown is a load, though no node has it.
    fn of_sets(sets: &[RigidSet], session: &Session) -> Self {
        let unknown = |set: &RigidSet| (0..3).filter(|&k| set.prescribed[k].is_none()).map(|k| set.applied[k].abs()).sum::<f64>();
        let on_sets = if session.rank() == 0 { sets.iter().map(unknown).sum() } else { 0.0 };
        Self { given: [on_sets, 0.0], ..Self::default() }
    }

    /// Adds the work at a node that moves by `u`: of its load, of contact, and of the residual, which where it is held is that of the
    /// support's reaction, too. Gives the reaction.
    fn add_node(&mut self, [load, contact, residual]: [Point; 3], u: Point, constraint: Option<&Constraint>) -> Point {
        self.loads += load.dot(&u);
        self.contact += contact.dot(&u);
        self.given[0] += load.norm();
        let Some(constraint) = constraint else {
            self.unbalanced += residual.dot(&u);
            return Point::zeros();
        };
        let [residual, u] = [residual, u].map(|v| constraint.to_frame(v));
        let free = constraint.free_part(residual);
        let (reaction, prescribed) = (free - residual, constraint.prescribed());
        self.unbalanced += free.dot(&u);
        self.supports += reaction.dot(&prescribed);
        self.missed += reaction.dot(&(u - prescribed));
        self.given[1] += prescribed.norm();
        constraint.to_global(reaction)
    }

    /// Adds up those of all ranks. **Collective**
    fn of_all_ranks(self, session: &Session) -> Self {
        let mut sums = [self.loads, self.supports, self.contact, self.unbalanced, self.missed, self.given[0], self.given[1]];
        session.sum(&mut sums);
        let [loads, supports, contact, unbalanced, missed, ref given @ ..] = sums;
        Self { loads, supports, contact, unbalanced, missed, given: *given }
    }

    /// The strain energy with an error that is quadratic in that of the solution: `U + z·(f - Ku - Bᵀλ) + μ·(c - Bu)`. Its first
    /// variation vanishes if `Kz + Bᵀμ = Ku` on free components, `Bz = 0`, and `z = 0` at supports.
    ///
    /// - Where loads alone do work, that is `z = u`, `μ = 0`, and the value is minus the Lagrangian.
    /// - Where prescribed displacements and gaps alone do work, it is `z = 0`, `μ = -λ`, and the value is the Lagrangian.
    /// - Where both do, `z` is the solution under the loads alone. It would take another solve: nothing.
    pub fn stationary(&self, strain: f64, lambda_gap: f64, gaps: bool) -> Option<f64> {
        let [loaded, moved] = self.given.map(|sum| sum > 0.0);
        match (loaded, moved || gaps) {
            (_, false) => Some(strain + self.unbalanced),
            (false, true) => Some(strain + self.contact - lambda_gap - self.missed),
            (true, true) => None,
        }
    }
}

/// Sums over all nodes.
pub struct NodeSums {
    pub work: WorkTerms,
    /// Loads and reactions of each body.
    pub bodies: Vec<ForceSum>,
    /// Force of each support.
    pub reactions: Vec<Point>,
    /// Force and moment of each rigid set.
    pub rigid: Vec<[f64; 3]>,
    /// For each body `Σ u × r` over the nodes on curved guides.
    pub guided: Vec<f64>,
}

/// Forces added up.
#[derive(Clone, Copy, Default)]
pub struct ForceSum {
    /// Their sum.
    pub force: Point,
    /// The sum of their magnitudes.
    pub magnitudes: f64,
}

impl ForceSum {
    /// Adds a force.
    pub fn add(&mut self, force: Point) {
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

impl NodeSums {
    /// Work and resultants of loads, supports and contact, of the forces `internal` `= Ku` of the bodies and of those of springs.
    /// **Collective**
    pub fn new(
        problem: &Discretisation,
        solution: &Solution,
        u: &Field<2>,
        [internal, springs]: [&Field<2>; 2],
    ) -> Result<Self, SystemError> {
        let space = problem.finest();
        let applied = nodal_forces(problem)?;
        let pressed = contact_forces_of_nodes(problem, solution);
        let body_of = body_of_nodes(problem);
        let (supports, sets) = (&problem.scene.supports, &problem.scene.rigid);
        let holders = Holders::new(&problem.scene.mesh, &space.numbering, supports).map_err(SystemError::Case)?;
        // These carry nothing in a solution: what they do carry is missing in the balance of their body.
        let anchors = anchor_nodes(problem);
        let (set_of, guides) = (set_of_nodes(problem), nodes_on_curved_guides(problem));
        let (reactions, rigid) = (vec![Point::zeros(); supports.len()], vec![[0.0; 3]; sets.len()]);
        let bodies = vec![ForceSum::default(); problem.scene.bodies.len()];
        let guided = vec![0.0; bodies.len()];
        let mut sums = Self { work: WorkTerms::of_sets(sets, &problem.session), bodies, reactions, rigid, guided };
        for (at, node) in space.own.clone().enumerate() {
            let [f, k, pull] = [applied.own()[at], internal.own()[at], springs.own()[at]].map(|[x, y]| Point::new(x, y));
            let (u, push) = (u.point(node), pressed.get(&node).copied().unwrap_or_default());
            let body = &mut sums.bodies[body_of[at]];
            [pull, f].into_iter().for_each(|force| body.add(force));
            // Contact pushes body 1 along -n: K u + Bᵀλ = f + r.
            let constraint = space.constraints.get(node);
            let reaction = sums.work.add_node([f, push, f + pull - k - push], u, constraint);
            if constraint.is_none() {
                continue;
            }
            if !anchors.contains(&node) {
                body.add(reaction);
            }
            sums.guided[body_of[at]] += if guides.contains(&node) { cross(u, reaction) } else { 0.0 };
            if let Some(&(set, x)) = set_of.get(&node) {
                (0..3).for_each(|k| sums.rigid[set][k] += reaction.dot(&sets[set].mode(k, x)));
            }
            holders.shares(node, reaction).for_each(|(support, force)| sums.reactions[support] += force);
        }
        Ok(sums.of_all_ranks(&problem.session))
    }

    /// Adds up those of all ranks. **Collective**
    fn of_all_ranks(mut self, session: &Session) -> Self {
        session.sum(self.rigid.as_flattened_mut());
        session.sum(&mut self.guided);
        let mut reactions: Vec<f64> = self.reactions.iter().flat_map(|force| [force.x, force.y]).collect();
        session.sum(&mut reactions);
        let reactions = reactions.chunks_exact(2).map(|force| Point::new(force[0], force[1])).collect();
        let (work, bodies) = (self.work.of_all_ranks(session), ForceSum::of_all_ranks(&self.bodies, session));
        Self { work, bodies, reactions, ..self }
    }
}

/// The rigid set of each node that is in one, and where the node is.
fn set_of_nodes(problem: &Discretisation) -> HashMap<usize, (usize, Point)> {
    let (scene, numbering) = (&problem.scene, &problem.finest().numbering);
    let places = |(number, set): (usize, &RigidSet)| {
        set.places(&scene.mesh, numbering).into_iter().map(move |(node, x)| (node, (number, x)))
    };
    scene.rigid.iter().enumerate().flat_map(places).collect()
}

/// Nodes that are held along the normals of a boundary which is not straight.
fn nodes_on_curved_guides(problem: &Discretisation) -> HashSet<usize> {
    let (mesh, numbering) = (&problem.scene.mesh, &problem.finest().numbering);
    let of_guide = |support: &Support| {
        let normals = || mesh.edges_on(&support.on).map(|edge| mesh.edge_normal(edge, 0.5));
        let first = normals().next().unwrap_or_default();
        let is_curved = support.normal.is_some() && normals().any(|normal| cross(first, normal).abs() > BENT);
        let edges: Vec<u32> = if is_curved { mesh.edges_on(&support.on).collect() } else { Vec::new() };
        edges.into_iter().flat_map(|edge| BoundaryEdge::all_of(mesh, edge, numbering)).flat_map(|edge| edge.nodes)
    };
    problem.scene.supports.iter().flat_map(of_guide).map(|node| node.number(mesh, numbering)).collect()
}

/// Nodes that hold bodies whose mean motion is held while the system is solved.
fn anchor_nodes(problem: &Discretisation) -> HashSet<usize> {
    let numbering = &problem.finest().numbering;
    let anchors = problem.scene.means.iter().flat_map(|hold| &hold.anchors);
    anchors.map(|anchor| numbering.vertex(anchor.vertex)).collect()
}

/// `Bᵀλ` at the contact nodes of this rank; at others a part of it.
fn contact_forces_of_nodes(problem: &Discretisation, solution: &Solution) -> HashMap<usize, Point> {
    let mut forces = HashMap::new();
    for (row, lambda) in problem.coupling.rows.iter().zip(&solution.multipliers) {
        for coupled in row {
            *forces.entry(coupled.node.number(&problem.scene.mesh, &problem.finest().numbering)).or_insert(Point::zeros()) +=
                *lambda * coupled.value;
        }
    }
    forces
}

/// Body of each owned node.
fn body_of_nodes(problem: &Discretisation) -> Vec<usize> {
    let (scene, space) = (&problem.scene, problem.finest());
    let mut body = vec![0; space.own.len()];
    let own = if scene.bodies.len() > 1 { problem.own_triangles() } else { &[] };
    let triangles = own.iter().map(|&triangle| triangle as usize);
    for (triangle, _, node) in space.numbering.nodes_of(&scene.mesh, triangles).filter(|(.., node)| space.own.contains(node)) {
        body[node - space.own.start] = scene.mesh.triangles[triangle].body as usize;
    }
    body
}
