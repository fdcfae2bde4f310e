//! Errors: what PETSc says, and where.

use super::ffi;
use mpi::topology::SimpleCommunicator;
use mpi::traits::Communicator;
use std::cell::{Cell, RefCell};
use std::ffi::{CStr, c_char, c_int, c_void};
use std::sync::atomic::{AtomicBool, Ordering};

/// What every call to PETSc returns.
pub type Result<T> = std::result::Result<T, Error>;

/// Why a call to PETSc or MPI did not do its work.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Error {
    /// PETSc returned an error code.
    #[error("{call}: {message} (PETSc error {code})")]
    Petsc {
        /// Name of the C function that was called.
        call: &'static str,
        /// PETSc's code.
        code: i32,
        /// PETSc's own words, from the innermost function that failed.
        message: String,
    },
    /// The matrix of the coarsest level has no factor.
    #[error("linear solver: the coarsest level has a zero pivot: its matrix is singular")]
    Singular,
    /// Memory has run out.
    #[error("memory: {call} could get no more of it")]
    OutOfMemory {
        /// Who asked for it, in words or as the name of a C function.
        call: String,
    },
    /// Ranks of one run that were to do different things.
    #[error("rank {rank} was started with other words than rank 0: `{words}`; start all ranks with the same")]
    UnequalWords {
        /// The lowest such rank.
        rank: usize,
        /// Words that this rank was started with.
        words: String,
    },
    /// MPI runs once in the life of a process.
    #[error("MPI has already been started in this process")]
    AlreadyStarted,
}

thread_local! {
    /// What the error handler has been told since the last check: the message of the innermost failure.
    static DEEPEST: RefCell<Option<String>> = const { RefCell::new(None) };
    /// Whether that failure was one of PETSc's allocator.
    static NO_MEMORY: Cell<bool> = const { Cell::new(false) };
}

/// Calls a PETSc function and makes a [`Result`] of its code: `petsc!(VecSet(vector, 1.0))?`.
macro_rules! petsc {
    ($function:ident ( $($argument:expr),* $(,)? )) => {
        // The arguments are handles that a wrapper keeps alive, and memory of the lengths that the wrapper has checked.
        $crate::petsc::error::check(stringify!($function), unsafe { $crate::petsc::ffi::$function($($argument),*) })
    };
}
pub(super) use petsc;

/// Result of a PETSc call, from its code.
#[inline]
pub(super) fn check(call: &'static str, code: ffi::PetscErrorCode) -> Result<()> {
    if code == 0 { Ok(()) } else { Err(failure(call, code)) }
}

/// PETSc's code for memory that it cannot get (PETSC_ERR_MEM); it does not always come through.
const OUT_OF_MEMORY: ffi::PetscErrorCode = 55;
/// Functions of PETSc's that get memory. In 3.18 they mix up what they tell: a line number stands for the code, the name of the
/// caller for the message.
const ALLOCATORS: [&str; 4] = ["PetscMallocAlign", "PetscReallocAlign", "PetscTrMallocDefault", "PetscTrReallocDefault"];

/// Whether an error of PETSc is the end of all ranks.
static FINAL: AtomicBool = AtomicBool::new(false);
/// Whether there has been one.
static LEAVING: AtomicBool = AtomicBool::new(false);

/// From now on an error of PETSc is the end: where there are several ranks, nothing is given back after it, since that takes all
/// of them (a factor of MUMPS, say), and those without the error wait elsewhere. The caller prints it and ends them all.
pub fn errors_are_final() {
    FINAL.store(true, Ordering::Relaxed);
}

/// Drops a wrapper by giving back the one reference of PETSc's that it owns: `given_back!(Vector, raw, VecDestroy);`. **Collective**
macro_rules! given_back {
    ($wrapper:ident, $handle:tt, $destroy:ident) => {
        impl Drop for $wrapper {
            fn drop(&mut self) {
                $crate::petsc::error::give_back(|| unsafe { $crate::petsc::ffi::$destroy(&mut self.$handle) });
            }
        }
    };
}
pub(super) use given_back;

/// Gives back a reference that PETSc counts, unless all ranks are about to be ended.
pub(super) fn give_back(destroy: impl FnOnce() -> ffi::PetscErrorCode) {
    if !LEAVING.load(Ordering::Relaxed) {
        destroy();
    }
}

/// Whether there are several ranks.
pub(super) fn has_others() -> bool {
    mpi::environment::is_initialized() && !mpi::environment::is_finalized() && SimpleCommunicator::world().size() > 1
}

#[cold]
fn failure(call: &'static str, code: ffi::PetscErrorCode) -> Error {
    LEAVING.store(FINAL.load(Ordering::Relaxed) && has_others(), Ordering::Relaxed);
    if NO_MEMORY.replace(false) || code == OUT_OF_MEMORY {
        DEEPEST.set(None);
        return Error::OutOfMemory { call: call.into() };
    }
    let deepest = DEEPEST.take().filter(|message| !message.is_empty());
    Error::Petsc { call, code, message: deepest.unwrap_or_else(|| general_message(code)) }
}

/// Calls PETSc at its start or end, when [`remember`] is not in place: what PETSc would print about an error is kept instead.
pub(super) fn with_message(call: &'static str, function: impl FnOnce() -> ffi::PetscErrorCode) -> Result<()> {
    unsafe { ffi::mezha_keep_messages(ffi::flag(true)) };
    let code = function();
    unsafe { ffi::mezha_keep_messages(ffi::flag(false)) };
    DEEPEST.set(Some(essence(&words(unsafe { ffi::mezha_kept_message() }))));
    let outcome = check(call, code);
    DEEPEST.set(None);
    outcome
}

/// The error itself in what PETSc prints about it: between a ruler and the hints.
fn essence(printed: &str) -> String {
    let is_hint = |line: &&str| !["WARNING!", "See http"].iter().any(|start| line.starts_with(start));
    let lines = printed.lines().map(str::trim).skip_while(|line| !line.starts_with("----")).skip(1);
    lines.take_while(is_hint).filter(|line| !line.is_empty()).last().unwrap_or_default().to_owned()
}

/// What PETSc says in general about a code.
fn general_message(code: ffi::PetscErrorCode) -> String {
    let mut text: *const c_char = std::ptr::null();
    let unknown = unsafe { ffi::PetscErrorMessage(code, &mut text, std::ptr::null_mut()) };
    if unknown != 0 || text.is_null() { "unknown error".into() } else { words(text) }
}

/// Rust's copy of a C string without spaces at its ends; empty if there is none.
pub(super) fn words(text: *const c_char) -> String {
    if text.is_null() {
        return String::new();
    }
    unsafe { CStr::from_ptr(text) }.to_string_lossy().trim().to_owned()
}

/// PETSc's error handler: keeps the words of the function where the error arose, stays silent, hands the code on.
pub(super) unsafe extern "C" fn remember(
    _comm: mpi::ffi::MPI_Comm,
    _line: c_int,
    function: *const c_char,
    _file: *const c_char,
    code: ffi::PetscErrorCode,
    kind: ffi::PetscErrorType,
    message: *const c_char,
    _context: *mut c_void,
) -> ffi::PetscErrorCode {
    if kind == ffi::PetscErrorType::PETSC_ERROR_INITIAL {
        DEEPEST.set(Some(words(message)));
        NO_MEMORY.set(ALLOCATORS.contains(&words(function).as_str()));
    }
    code
}
