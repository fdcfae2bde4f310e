//! The bodies without contact: what no contact boundary and no active set changes.

use super::assembly::Assembly;
use super::matrices::assembled;
use super::{ContactNeighbours, Stiffness};
use crate::geometry::Point;
use crate::petsc::{Session, Vector};
use crate::system::user_options::want_entries;
use crate::system::{Discretisation, Form, Space, SystemError};
use std::collections::HashMap;
use std::rc::Rc;

/// Stiffness and load of the bodies.
pub struct Elastic {
    /// `K` on every level, coarsest first; only the finest in the plain form.
    pub stiffness: Vec<Stiffness>,
    /// Nodal forces of this rank's unknowns, those of prescribed displacements included, in the nodes' frames.
    pub load: Vec<f64>,
}

impl Elastic {
    /// Assembles `K` of every level that the form needs, with places for the couplings of contact on each level. `load` are
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
            let assembly = assembly(problem, space, form, session);
            let last = l + 1 == problem.spaces.len();
            let lift = |node, force| {
                if last {
                    *lifted.entry(node).or_insert(Point::zeros()) += force;
                }
            };
            let (stored, strips) = assembled(&assembly, &neighbours[l], lift, session)?;
            let strips = assembly.has_strips().then(|| Rc::new(strips));
            stiffness.push(Stiffness::new(stored, strips.as_ref(), space, session)?);
        }
        subtract(&mut load, &lifted, problem.finest(), session)?;
        Ok(Self { stiffness, load })
    }

    /// The same without places for contact: for boundaries that move, each of which has its own. **Collective**
    pub fn alone(problem: &Discretisation, load: Vec<f64>, form: Form, session: &Session) -> Result<Self, SystemError> {
        Self::new(problem, load, form, &vec![ContactNeighbours::new(); problem.spaces.len()], session)
    }

    /// Copies of the stiffness with places for the couplings of a contact boundary. **Collective**
    pub fn with_places(
        &self,
        problem: &Discretisation,
        form: Form,
        neighbours: &[ContactNeighbours],
        session: &Session,
    ) -> Result<Vec<Stiffness>, SystemError> {
        let levels = problem.spaces.iter().zip(neighbours).skip(first_level(problem, form)).zip(&self.stiffness);
        levels.map(|((space, neighbours), stiffness)| stiffness.with_places(space, neighbours, session)).collect()
    }
}

/// What is to be assembled of a level: with strips, if no option of the user's wants entries.
fn assembly<'a>(problem: &'a Discretisation, space: &'a Space, form: Form, session: &Session) -> Assembly<'a> {
    let (scene, rank) = (&problem.scene, session.rank());
    let is_small = 2 * problem.spaces[0].numbering.node_count() <= 3000;
    if form == Form::Augmented && is_small && !want_entries(session) {
        return Assembly::with_strips(scene, space, rank);
    }
    Assembly::stored(scene, space, rank)
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
