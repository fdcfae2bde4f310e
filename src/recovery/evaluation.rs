//! A solution looked at: what is computed of it once, and what can be asked of it.

use super::balance::{Balance, balance};
use super::contact_forces::ContactForce;
use super::corners::{Corners, corners};
use super::crossings::{Crossing, crossings};
use super::cut_off::{SmoothJoints, smooth_joints};
use super::deformation::{Deformation, deformations};
use super::end_slip::{EndSlip, slip_at_ends};
use super::held_force::held_forces;
use super::motion_error::{MotionError, growth_by_gap, motion_errors};
use super::overlaps::penetrations;
use super::overlaps::{missing_beyond, missing_force, unresolved_force};
use super::probe::{Probed, Probing, probe};
use super::shape_error::{force_by_shape, shape_error};
use super::stress::{NodalStress, nodal_stress};
use super::traces::{TracePoint, trace_points};
use crate::contact::{GapChoice, Penetration};
use crate::discretisation::{ContactPressure, Discretisation, Field, Solution, SystemError, needed_contacts};
use crate::geometry::Point;
use crate::mesh::Region;
use crate::petsc::Session;
use std::cell::OnceCell;

/// A solution with its displacements at all nodes that this rank sees, its energies and its balances.
pub struct Evaluation<'a> {
    /// What was solved.
    pub problem: &'a Discretisation,
    /// What was found.
    pub solution: &'a Solution,
    /// All ranks.
    pub session: &'a Session,
    /// Displacements.
    pub u: Field<2>,
    /// Largest displacement of a node (length).
    pub moved: f64,
    /// Energies, reactions and balances.
    pub balance: Balance,
    /// Strain and rotation of each body.
    pub deformations: Vec<Deformation>,
    /// What finite motions spoil, for each contact.
    pub motions: Vec<Option<MotionError>>,
    /// How deep the bodies of each contact lie in each other, by their whole sides.
    pub penetrations: Vec<Penetration>,
    /// Stress at the nodes, as soon as somebody has asked for it.
    stress: OnceCell<NodalStress>,
    /// For each contact whether a body could move without it.
    needed: Vec<bool>,
    /// For each contact the force that it may carry though nothing presses, by what nodes leave unknown of its gap.
    forces_by_shape: Vec<f64>,
    /// For each contact what held mean motions take from it.
    pub held_forces: Vec<f64>,
}

impl<'a> Evaluation<'a> {
    /// Computes what is asked of every solution. **Collective**
    ///
    /// # Errors
    /// [`SystemError`] from PETSc or an inverted triangle.
    pub fn new(problem: &'a Discretisation, solution: &'a Solution) -> Result<Self, SystemError> {
        let u = Field::displacement(problem, &solution.displacement);
        let mut moved = [u.own().iter().map(|[x, y]| x.hypot(*y)).fold(0.0, f64::max)];
        problem.session.max(&mut moved);
        let balance = balance(problem, solution, &u)?;
        let (deformations, turns) = deformations(problem, &u)?;
        let (forces_by_shape, active) = may_press(problem, solution, &u)?;
        let needed = needed_contacts(problem, &active);
        let motions = motion_errors((problem, &needed), solution, &balance, (&deformations, &turns));
        let held_forces = held_forces(problem, solution, &balance);
        let forces: Vec<f64> = balance.contacts.iter().map(|contact| contact.force).collect();
        let penetrations = penetrations(problem, solution, &forces);
        Ok(Self {
            problem,
            solution,
            session: &problem.session,
            u,
            moved: moved[0],
            balance,
            deformations,
            motions,
            penetrations,
            stress: OnceCell::new(),
            needed,
            forces_by_shape,
            held_forces,
        })
    }

    /// The pressure on one of the contacts.
    pub fn pressure(&self, contact: usize) -> ContactPressure<'a> {
        self.solution.pressure(&self.problem.contacts[contact])
    }

    /// Boundaries without a contact that lie in each other. **Collective**
    pub fn crossings(&self) -> Vec<Crossing> {
        crossings(self.problem, self.solution, self.moved)
    }

    /// Growth of the bodies of a contact by their turning, relative to the smallest gap at `points`; nothing if it is rounding
    /// beside their displacements.
    pub fn growth_by_gap(&self, contact: usize, points: &[TracePoint]) -> Option<f64> {
        growth_by_gap(self.problem.contacts[contact].bodies.map(|body| &self.deformations[body]), points, self.moved)
    }

    /// What sliding does at the ends of a contact that `zones` reach.
    pub fn slip_at_ends(&self, contact: usize, zones: &[[f64; 2]], points: &[TracePoint]) -> Option<EndSlip> {
        let (all, force) = (&self.problem.contacts, self.balance.contacts[contact].force);
        slip_at_ends((&all[contact], all), &self.problem.scene.mesh, (zones, points), force)
    }

    /// Where another contact goes on smoothly from one.
    pub fn smooth_joints(&self, contact: usize) -> SmoothJoints {
        smooth_joints(contact, self.problem, self.solution)
    }

    /// Corners of the bodies of a contact within `zones`: the arcs that press.
    pub fn corners(&self, contact: usize, zones: &[[f64; 2]]) -> Corners {
        corners(&self.problem.scene, &self.problem.contacts[contact], zones)
    }

    /// Estimated relative errors of λ, and of the force, by what the nodes of undeclared boundaries leave unknown of their shape. Of a
    /// contact without which a body could move equilibrium sets the resultant, and only what presses against itself is off. The points
    /// are the same on every rank. Where nothing presses, by the force that may, as a share of the largest one. **Collective**
    pub fn shape_errors(&self, contact: usize, points: &[TracePoint]) -> Option<[f64; 2]> {
        let largest = self.balance.contacts.iter().map(|contact| contact.force.abs()).fold(0.0, f64::max);
        if self.forces_by_shape[contact] > 0.0 && largest > 0.0 {
            return Some([self.forces_by_shape[contact] / largest; 2]);
        }
        let error = shape_error(&self.problem.contacts[contact], points)?;
        let ContactForce { force, resultants, .. } = &self.balance.contacts[contact];
        let unset: f64 = if self.needed[contact] { 1.0 - resultants[1].norm() / force.abs() } else { 1.0 };
        Some([error, error * unset.max(0.0)])
    }

    /// Force that is missing because bodies overlap where nothing presses, relative to the force found; without a force, the
    /// largest overlap relative to the largest relative displacement, 1 if that is smaller.
    pub fn missing_force(&self, contact: usize, zones: &[[f64; 2]], points: &[TracePoint]) -> (Option<f64>, f64) {
        missing_force(&self.problem.contacts[contact], zones, points, self.balance.contacts[contact].force, self.way(contact))
    }

    /// Force that overlaps all beyond a contact boundary are worth, relative to the force found.
    pub fn missing_beyond(&self, contact: usize) -> Option<f64> {
        missing_beyond(&self.problem.contacts[contact], self.penetrations[contact].beyond, self.balance.contacts[contact].force)
    }

    /// Force that penetration within single segments of a contact is worth (force per thickness).
    pub fn unresolved_force(&self, contact: usize, points: &[TracePoint]) -> f64 {
        unresolved_force(&self.problem.contacts[contact], points, self.way(contact))
    }

    /// The way by which overlaps in a contact are measured (length): where nothing has moved, bodies lie in each other by rounding alone,
    /// unless the case declares their gap.
    fn way(&self, contact: usize) -> f64 {
        let contact = &self.problem.contacts[contact];
        match contact.pair.gap {
            _ if self.moved > 0.0 => self.moved,
            GapChoice::Formula(_) => contact.boundary.length(),
            GapChoice::Geometry | GapChoice::Closed => f64::INFINITY,
        }
    }

    /// Both bodies' traces along a contact boundary. **Collective**
    ///
    /// # Errors
    /// As [`Evaluation::new`].
    pub fn traces(&self, pressure: &ContactPressure) -> Result<Vec<TracePoint>, SystemError> {
        trace_points(self.problem, pressure, &self.u)
    }

    /// Values at a point of a body or of a part of one; nothing if it does not hold the point. **Collective**
    ///
    /// # Errors
    /// As [`Evaluation::new`].
    pub fn probe(&self, region: Region, x: Point) -> Result<Option<Probed>, SystemError> {
        probe(self.problem, (&self.u, Probing::Displacement), region, x)
    }

    /// Stress (xx, yy, xy, zz) at the nodes, of each part by itself. **Collective**
    ///
    /// # Errors
    /// As [`Evaluation::new`].
    pub fn stress(&self) -> Result<&NodalStress, SystemError> {
        match self.stress.get() {
            Some(stress) => Ok(stress),
            None => {
                let stress = nodal_stress(self.problem, &self.u)?;
                Ok(self.stress.get_or_init(|| stress))
            }
        }
    }
}

/// For each contact the force by which it may press though nothing does, since its shape is not known well enough; and the multipliers
/// that are active, with all of such contacts. **Collective**
fn may_press(problem: &Discretisation, solution: &Solution, u: &Field<2>) -> Result<(Vec<f64>, Vec<bool>), SystemError> {
    let (mut forces, mut active) = (Vec::new(), solution.active.clone());
    for contact in &problem.contacts {
        let is_open = contact.shapes.is_some() && !active[contact.range()].contains(&true);
        let force = match is_open {
            true => force_by_shape(contact, &trace_points(problem, &solution.pressure(contact), u)?),
            false => 0.0,
        };
        if force > 0.0 {
            active[contact.range()].fill(true);
        }
        forces.push(force);
    }
    Ok((forces, active))
}
