//! The safe layer over PETSc and MPI: the only module with `unsafe`, and the only one that names either library's own types.
//!
//! A [`Session`] starts both libraries; every other object holds a clone of it, so that both end when the last object is gone.
//! Each wrapper owns one reference that PETSc counts, gives it back when dropped, and checks every code PETSc returns.
//! Sizes and ranges are `usize`, indices inside arrays are [`Index`] as PETSc stores them; where a matrix takes
//! values, negative ones are skipped.
//! Functions marked **Collective** must be called by all ranks in the same order, and so must the drop of any object.

mod allocation;
mod blas;
mod broadcast;
mod collective;
mod environment;
mod error;
mod exchange;
mod ffi;
mod field_split;
mod halo;
mod index_set;
mod krylov;
mod matrix;
mod nest;
pub mod options;
mod partition;
mod preconditioner;
mod session;
mod shell;
mod stage;
mod vector;
pub mod versions;
mod watch;
mod window;

pub use allocation::{TellingAllocator, share_memory_among_threads, when_memory_is_refused};
pub use collective::Datum;
pub use error::{Error, Result, errors_are_final};
pub use ffi::Index;
pub use halo::Halo;
pub use index_set::IndexSet;
pub use krylov::{Krylov, KrylovEnding};
pub use matrix::Matrix;
pub use partition::partition;
pub use preconditioner::Preconditioner;
pub use session::{Session, end_all_ranks, is_name};
pub use shell::{Action, Operator, ReplacedAction};
pub use stage::{Stage, StageGuard};
pub use vector::Vector;
pub use watch::{SolveAtWork, WatchedSolve, solve_at_work};
pub use window::Window;
