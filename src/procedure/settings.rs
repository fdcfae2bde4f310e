//! How a scene is solved.

use crate::accuracy::{Accuracy, ProbePoint};
use crate::discretisation::{Discretisation, Form, Scene, SystemError, finest_numbering};
use crate::petsc::Session;
use crate::procedure::observer::Observer;
use crate::system::{SolverChoice, Tolerance, memory_need, memory_of_macro_mesh};

/// Displacement unknowns up to which a solve that failed, or whose active set was hard to find, is looked into.
const LARGE_INF_SUP: usize = 200_000;

/// Displacement unknowns up to which the inf-sup constants take less than a tenth of a run.
const CHEAP_INF_SUP: usize = 10_000;

/// How a scene is solved.
pub struct Procedure<'a> {
    /// The linear solver.
    pub choice: SolverChoice,
    /// How far it solves.
    pub tolerance: Tolerance,
    /// Whether the inf-sup constants are wanted; nothing leaves it to their cost.
    pub inf_sup: Option<bool>,
    /// The accuracy that is asked for; nothing if the mesh of the case is the mesh.
    pub accuracy: Option<&'a Accuracy>,
    /// All ranks.
    pub session: &'a Session,
    /// Who is told of its events.
    pub observer: &'a dyn Observer,
}

impl Procedure<'_> {
    /// Unknowns of the displacement of a scene with so many refinements, and the bytes that this rank will take for it.
    ///
    /// # Errors
    /// [`SystemError::Case`] if the mesh is too fine to be counted.
    pub fn need(&self, scene: &Scene, refine: usize) -> Result<(usize, f64), SystemError> {
        let unknowns = 2 * finest_numbering(&Scene { refine, ..scene.clone() })?.node_count();
        Ok((unknowns, memory_need(scene, refine, (self.choice, self.tolerance), self.session.rank())))
    }

    /// Bytes that a scene on one rank takes, and those that its macro mesh takes on each further one.
    pub fn look_at_need(scene: &Scene, choice: SolverChoice, tolerance: Tolerance) -> [f64; 2] {
        [memory_need(scene, scene.refine, (choice, tolerance), 0), memory_of_macro_mesh(scene)]
    }

    /// The points that goals are set for.
    pub(super) fn probes(&self) -> Vec<ProbePoint> {
        self.accuracy.map_or_else(Vec::new, Accuracy::probes)
    }

    /// Whether the inf-sup constants are to be measured: they are cheap, asked for, or may tell why a solve has failed or an
    /// active set was hard to find.
    pub(super) fn wants_inf_sup(&self, problem: &Discretisation, is_hard: bool) -> bool {
        // Too many multipliers are one reason why a set is hard to find.
        let hard = is_hard && problem.unknown_count() <= LARGE_INF_SUP;
        let cheap = problem.unknown_count() <= CHEAP_INF_SUP;
        let possible = self.choice.form() == Form::Augmented && !problem.contacts.is_empty();
        possible && self.inf_sup.unwrap_or(cheap || hard)
    }
}
