//! The bodies without contact: what no contact boundary and no active set changes.

use super::stiffness_matrix::{ContactNeighbours, contact_room, fill_stiffness, prepare_stiffness};
use super::{Discretisation, Form, Space, SystemError};
use crate::geometry::Point;
use crate::petsc::{Matrix, Session, Vector};
use std::collections::HashMap;

/// Stiffness and load of the bodies.
pub struct Elastic {
    /// `K` on every level, coarsest first; only the finest in the plain form.
    pub stiffness: Vec<Matrix>,
    /// Nodal forces of this rank's unknowns, those of prescribed displacements included, in the nodes' frames.
    pub load: Vec<f64>,
}

impl Elastic {
    /// Assembles `K` of every level that the form needs, with room for the couplings of contact on each level. `load` are
    /// nodal forces, zero where displacement is prescribed; what prescribed displacements add is put in here.
    /// **Collective**
    pub fn new(
        problem: &Discretisation,
        mut load: Vec<f64>,
        form: Form,
        neighbours: &[ContactNeighbours],
        session: &Session,
    ) -> Result<Self, SystemError> {
        let mut lifted = HashMap::new();
        let mut stiffness = Vec::new();
        for (l, space) in problem.spaces.iter().enumerate().skip(first_level(problem, form)) {
            let mut matrix = prepare_stiffness(&problem.scene, space, &neighbours[l], session)?;
            let last = l + 1 == problem.spaces.len();
            fill_stiffness(&mut matrix, &problem.scene, space, &neighbours[l], session, |node, force| {
                if last {
                    *lifted.entry(node).or_insert(Point::zeros()) += force;
                }
            })?;
            stiffness.push(matrix);
        }
        subtract(&mut load, &lifted, problem.finest(), session)?;
        Ok(Self { stiffness, load })
    }

    /// The same without room for contact: for boundaries that move, each of which has its own. **Collective**
    pub fn alone(problem: &Discretisation, load: Vec<f64>, form: Form, session: &Session) -> Result<Self, SystemError> {
        Self::new(problem, load, form, &vec![ContactNeighbours::new(); problem.spaces.len()], session)
    }

    /// Copies of the stiffness with room for the couplings of a contact boundary. **Collective**
    pub fn with_room(
        &self,
        problem: &Discretisation,
        form: Form,
        neighbours: &[ContactNeighbours],
        session: &Session,
    ) -> Result<Vec<Matrix>, SystemError> {
        let first = first_level(problem, form);
        let levels = problem.spaces.iter().zip(neighbours).skip(first).zip(&self.stiffness);
        levels
            .map(|((space, neighbours), stiffness)| {
                let mut sum = stiffness.sum(&contact_room(space, neighbours, session)?)?;
                sum.set_positive_definite(true)?;
                Ok(sum)
            })
            .collect()
    }
}

fn first_level(problem: &Discretisation, form: Form) -> usize {
    match form {
        Form::Augmented => 0,
        Form::Plain => problem.spaces.len() - 1,
    }
}

/// Takes the forces of prescribed displacements off the load, wherever their nodes live.
fn subtract(load: &mut [f64], lifted: &HashMap<usize, Point>, space: &Space, session: &Session) -> Result<(), SystemError> {
    if !session.any(!lifted.is_empty()) {
        return Ok(());
    }
    let mut forces = Vector::new(session, space.local_unknowns())?;
    for (&node, force) in lifted {
        forces.add(&[2 * node as i32, 2 * node as i32 + 1], &[-force.x, -force.y])?;
    }
    forces.assemble()?;
    load.iter_mut().zip(forces.values().iter()).for_each(|(sum, force)| *sum += force);
    Ok(())
}
