//! How a scene is solved, and what a run is told of it meanwhile.

use crate::accuracy::{Accuracy, AdaptedMesh, ProbePoint};
use crate::discretisation::{Discretisation, Form, Scene, SystemError, finest_numbering};
use crate::petsc::{Session, StageGuard};
use crate::procedure::at_rest::AtRest;
use crate::procedure::boundary::BoundaryStep;
use crate::procedure::sets::Pass;
use crate::procedure::solved::{CoarseSolve, Solved};
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

/// Parts of the work whose times are kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Work {
    /// Contacts are placed and coupled.
    Contact,
    /// Matrices are assembled.
    Assembly,
    /// Solvers are set up.
    SetUp,
    /// Systems are solved.
    Solve,
    /// Solutions are looked at.
    Recovery,
}

/// What has happened.
pub enum Event<'a> {
    /// The scene is sound, as far as that can be seen at rest; nothing is solved yet.
    AtRest {
        /// The scene.
        scene: &'a Scene,
        /// The mesh of the case with its contacts.
        at_rest: &'a AtRest,
    },
    /// The solver is chosen; in words.
    Solver(&'a str),
    /// A mesh of the way to that of the case is taken up.
    Refinement {
        /// Its refinement.
        refine: usize,
        /// That of the case.
        last: usize,
    },
    /// A coarser mesh was solved first.
    Coarse {
        /// Its size and its iterations.
        solve: &'a CoarseSolve,
        /// Which multipliers are active.
        active: &'a [bool],
        /// The passes of its loops.
        passes: &'a [Pass],
        /// Whether it converged.
        converged: bool,
    },
    /// The mesh of the case is solved next; if boundaries follow the bodies, with the changes of boundary and displacement at
    /// which they stand.
    Begin(Option<[f64; 2]>),
    /// A pass of the loop over active sets on that mesh, with the number of all multipliers.
    Passed(&'a Pass, usize),
    /// A load step has not converged, and is solved once more.
    Again {
        /// Whether it begins with the step before now, or at rest.
        from_before: bool,
    },
    /// A contact boundary that was solved for.
    Placed(&'a BoundaryStep),
    /// One mesh of a sequence that is adapted to an accuracy was solved.
    Adapted {
        /// The accuracy.
        accuracy: &'a Accuracy,
        /// The mesh.
        mesh: &'a AdaptedMesh,
        /// The estimate of each goal at which it counts as reached on this mesh: what was asked for, or less.
        wanted: &'a [f64],
        /// What was found on it.
        solved: &'a Solved,
    },
}

/// Who watches.
pub trait Observer {
    /// Is told of an event, on every rank.
    fn observe(&self, event: Event);

    /// Times a part of the work until the guard is dropped.
    fn enter(&self, work: Work) -> Option<StageGuard<'_>>;
}
