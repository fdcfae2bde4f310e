//! What a run is told of the procedure while it works.

use crate::accuracy::{Accuracy, AdaptedMesh};
use crate::discretisation::Scene;
use crate::petsc::StageGuard;
use crate::procedure::at_rest::AtRest;
use crate::procedure::boundary::BoundaryStep;
use crate::procedure::sets::Pass;
use crate::procedure::solved::{CoarseSolve, Solved};

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
