//! The bodies without contact: what no contact boundary and no active set changes.

use super::assembly::Assembly;
use super::lattice_operator::LatticeOperator;
use super::{ContactNeighbours, SolverView, Stiffness};
use crate::discretisation::{Discretisation, Form, SMALL, SystemError};
use crate::geometry::Point;
use crate::petsc::{Session, options};

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
    ) -> Result<Self, SystemError> {
        let mut stiffness = Vec::new();
        for (l, space) in problem.spaces.iter().enumerate().skip(first_level(problem, form)) {
            let last = l + 1 == problem.spaces.len();
            let lift = |node, force: Point| {
                let at = 2 * (node - space.own.start);
                if last {
                    (load[at], load[at + 1]) = (load[at] - force.x, load[at + 1] - force.y);
                }
            };
            let assembly = Assembly::new(&problem.scene, space, form == Form::Augmented, problem.session.rank());
            let assembled = assembly.assemble(&neighbours[l], lift).map_err(SystemError::from);
            let assembled = problem.session.agree(assembled).map_err(SystemError::Case)?;
            let lattice = LatticeOperator::new(assembled, &space.own, &problem.session);
            stiffness.push(Stiffness::new(lattice, seen(problem, last, form), &problem.session)?);
        }
        Ok(Self { stiffness, load })
    }

    /// The same without places for contact: for boundaries that move, each of which has its own. **Collective**
    pub fn alone(problem: &Discretisation, load: Vec<f64>, form: Form) -> Result<Self, SystemError> {
        let elastic = Self::new(problem, load, form, &vec![ContactNeighbours::new(); problem.spaces.len()])?;
        elastic.stiffness.iter().for_each(|stiffness| stiffness.lattice().rows.borrow_mut().keep());
        Ok(elastic)
    }

    /// Copies of the stiffness with places for the couplings of a contact boundary. **Collective**
    pub fn with_places(
        &self,
        problem: &Discretisation,
        form: Form,
        neighbours: &[ContactNeighbours],
    ) -> Result<Vec<Stiffness>, SystemError> {
        let levels = neighbours.iter().skip(first_level(problem, form)).zip(&self.stiffness);
        levels.map(|(neighbours, stiffness)| stiffness.with_places(neighbours, &problem.session)).collect()
    }
}

/// What solvers of PETSc's see of a level: all rows of the finest one, where more than its products is wanted, or where there is no
/// other, so that a factor stands in the place of the cycle.
fn seen(problem: &Discretisation, is_finest: bool, form: Form) -> SolverView {
    let is_alone = problem.spaces.len() == 1 && 2 * problem.finest().numbering.node_count() <= SMALL;
    let are_wanted = form == Form::Plain || is_finest && (is_alone || takes_another_preconditioner(&problem.session));
    if are_wanted { SolverView::Entries } else { SolverView::Action }
}

/// Whether the user has chosen what preconditions the displacements: then it is a preconditioner of PETSc's, which wants all rows.
pub fn takes_another_preconditioner(session: &Session) -> bool {
    options::any_of_user(session, |name| name == "-fieldsplit_u_pc_type")
}

fn first_level(problem: &Discretisation, form: Form) -> usize {
    match form {
        Form::Augmented => 0,
        Form::Plain => problem.spaces.len() - 1,
    }
}
