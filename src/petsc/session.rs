//! Start and end of PETSc and MPI.

use super::error::{Error, Result, petsc, remember};
use super::{environment, ffi};
use mpi::environment::Universe;
use mpi::topology::{Communicator, SimpleCommunicator};
use mpi::traits::CommunicatorCollectives;
use std::cell::RefCell;
use std::collections::BTreeSet;
use std::ffi::{CString, c_char, c_int};
use std::ptr;
use std::rc::Rc;
use std::sync::Once;

/// PETSc and MPI, started together and ended together. Every wrapper holds a clone; when the last one is dropped,
/// PETSc and then MPI end. A session stays on the thread that started it.
#[derive(Clone)]
pub struct Session(Rc<Inner>);

struct Inner {
    world: SimpleCommunicator,
    /// Names of options that mezha has set, the user has not.
    defaults: RefCell<BTreeSet<String>>,
    /// PETSc keeps pointers to its arguments until it ends: the array, and the words in it.
    _arguments: (Vec<*mut c_char>, Vec<CString>),
    /// Ends MPI when dropped, hence after PETSc.
    _universe: Universe,
}

impl Session {
    /// Starts MPI and PETSc, with `defaults` and then the `user`'s words as options (`["-ksp_type", "gmres"]`):
    /// where both name an option, the user's value holds. **Collective**
    ///
    /// From here on a panic on any rank ends all ranks with exit code 1, after its message has been printed.
    ///
    /// # Errors
    /// [`Error::AlreadyStarted`] on a second start, even after the end of the first; else PETSc's own.
    pub fn start(defaults: &[&str], user: &[String]) -> Result<Self> {
        environment::prepare();
        let universe = mpi::initialize().ok_or(Error::AlreadyStarted)?;
        let world = universe.world();

        let given = user.iter().map(String::as_str);
        let words: Vec<CString> = ["mezha", "-no_signal_handler", "-options_left", "no"]
            .into_iter()
            .chain(defaults.iter().copied())
            .chain(given.clone())
            .map(|word| CString::new(word).expect("an option has no zero byte"))
            .collect();
        let mut pointers: Vec<*mut c_char> = words.iter().map(|word| word.as_ptr().cast_mut()).chain([ptr::null_mut()]).collect();
        let mut count = words.len() as c_int;
        let mut array = pointers.as_mut_ptr();
        petsc!(PetscInitialize(&mut count, &mut array, ptr::null(), ptr::null()))?;
        petsc!(PetscPushErrorHandler(Some(remember), ptr::null_mut()))?;
        end_all_ranks_on_panic();

        let mut own: BTreeSet<String> = defaults.iter().filter(|word| is_name(word)).map(|word| word.to_lowercase()).collect();
        for name in given.filter(|word| is_name(word)) {
            own.remove(&name.to_lowercase());
        }
        Ok(Self(Rc::new(Inner { world, defaults: RefCell::new(own), _arguments: (pointers, words), _universe: universe })))
    }

    /// Number of this rank, from 0.
    pub fn rank(&self) -> usize {
        self.0.world.rank() as usize
    }

    /// Number of ranks.
    pub fn size(&self) -> usize {
        self.0.world.size() as usize
    }

    /// Waits for all ranks. **Collective**
    pub fn barrier(&self) {
        self.0.world.barrier();
    }

    /// Ends all ranks at once with this exit code.
    pub fn abort(&self, code: i32) -> ! {
        self.0.world.abort(code)
    }

    pub(super) fn world(&self) -> &SimpleCommunicator {
        &self.0.world
    }

    /// The communicator of all ranks, as PETSc takes it.
    pub(super) fn raw(&self) -> mpi::ffi::MPI_Comm {
        use mpi::traits::AsRaw;
        self.0.world.as_raw()
    }

    /// Names of options that mezha has set, the user has not; in small letters.
    pub(super) fn defaults(&self) -> &RefCell<BTreeSet<String>> {
        &self.0.defaults
    }
}

impl Drop for Inner {
    /// Ends PETSc; MPI follows. **Collective**
    fn drop(&mut self) {
        unsafe {
            ffi::PetscPopErrorHandler();
            ffi::PetscFinalize();
        }
    }
}

/// Whether a word of the command line is the name of an option: one or two minuses and a letter.
pub(super) fn is_name(word: &str) -> bool {
    let rest = word.strip_prefix("--").or_else(|| word.strip_prefix('-'));
    rest.is_some_and(|rest| rest.starts_with(|first: char| first.is_ascii_alphabetic()))
}

/// A rank that panics would leave the others waiting: it prints its message and ends them all.
fn end_all_ranks_on_panic() {
    static INSTALLED: Once = Once::new();
    INSTALLED.call_once(|| {
        let print = std::panic::take_hook();
        let abort = Once::new();
        std::panic::set_hook(Box::new(move |panic| {
            abort.call_once(|| {
                print(panic);
                if !mpi::environment::is_finalized() {
                    SimpleCommunicator::world().abort(1);
                }
            });
        }));
    });
}
