//! Start and end of PETSc and MPI.

use super::blas::start_blas;
use super::broadcast::odd_one;
use super::error::{Error, Result, has_others, petsc, remember, with_message};
use super::{environment, ffi};
use mpi::environment::Universe;
use mpi::topology::{Communicator, SimpleCommunicator};
use mpi::traits::CommunicatorCollectives;
use std::cell::RefCell;
use std::collections::BTreeSet;
use std::ffi::{CString, c_char, c_int};
use std::io::Write;
use std::mem::{ManuallyDrop, forget};
use std::ptr;
use std::rc::Rc;
use std::sync::Once;
use std::thread::sleep;
use std::time::{Duration, Instant};

/// How often it is asked whether all ranks have come.
const PULSE: Duration = Duration::from_millis(1);

/// PETSc and MPI, started together and ended together. Every wrapper holds a clone; when the last one is dropped,
/// PETSc and then MPI end. A session stays on the thread that started it.
#[derive(Clone)]
pub struct Session(Rc<Inner>);

struct Inner {
    world: SimpleCommunicator,
    /// For [`Session::meet`] alone, so that it is not mistaken for something else; given back by the end of MPI.
    farewell: ManuallyDrop<SimpleCommunicator>,
    /// Names of options that mezha has set, the user has not.
    defaults: RefCell<BTreeSet<String>>,
    /// PETSc keeps pointers to its arguments until it ends: the array, and the words in it.
    _arguments: (Vec<*mut c_char>, Vec<CString>),
    /// Ends MPI when dropped; None when PETSc has ended.
    universe: Option<Universe>,
}

impl Session {
    /// Starts MPI and PETSc, with `defaults` and then the `user`'s words as options (`["-ksp_type", "gmres"]`):
    /// where both name an option, the user's value holds. **Collective**
    ///
    /// From here on a panic on any rank ends all ranks with exit code 1, after its message has been printed.
    ///
    /// # Errors
    /// [`Error::AlreadyStarted`] on a second start, even after the end of the first; [`Error::UnequalWords`] on every rank, if
    /// their command lines differ; else PETSc's own, perhaps on this rank
    /// alone: MPI is not ended then, since that would wait for ranks that PETSc has left in the middle; [`end_all_ranks`] is.
    pub fn start(defaults: &[&str], user: &[String]) -> Result<Self> {
        environment::prepare();
        let universe = mpi::initialize().ok_or(Error::AlreadyStarted)?;
        let world = universe.world();
        end_all_ranks_on_panic();
        refuse_unequal_words(&world)?;
        let farewell = ManuallyDrop::new(world.duplicate());

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
        let initialize = || unsafe { ffi::PetscInitialize(&mut count, &mut array, ptr::null(), ptr::null()) };
        the_end_is_ours(true);
        let started = with_message("PetscInitialize", initialize);
        let handled = started.and_then(|()| petsc!(PetscPushErrorHandler(Some(remember), ptr::null_mut())));
        if let Err(error) = handled.and_then(|()| start_blas()) {
            the_end_is_ours(false);
            if world.size() > 1 {
                forget(universe);
            }
            return Err(error);
        }

        let mut own: BTreeSet<String> = defaults.iter().filter(|word| is_name(word)).map(|word| word.to_lowercase()).collect();
        for name in given.filter(|word| is_name(word)) {
            own.remove(&name.to_lowercase());
        }
        Ok(Self(Rc::new(Inner {
            world,
            farewell,
            defaults: RefCell::new(own),
            _arguments: (pointers, words),
            universe: Some(universe),
        })))
    }

    /// A session that is not started: it can be held, and asked for nothing. Unit tests have no MPI.
    #[cfg(test)]
    pub fn of_unit_tests() -> Self {
        let (farewell, defaults) = (ManuallyDrop::new(SimpleCommunicator::world()), RefCell::default());
        let world = SimpleCommunicator::world();
        Self(Rc::new(Inner { world, farewell, defaults, _arguments: (Vec::new(), Vec::new()), universe: None }))
    }

    /// Ends PETSc and MPI, if nothing else holds the session. **Collective**
    ///
    /// # Errors
    /// PETSc's own, perhaps on this rank alone: the others wait then, and [`end_all_ranks`] ends them.
    pub fn end(self) -> Result<()> {
        Rc::try_unwrap(self.0).map_or(Ok(()), |mut inner| inner.end())
    }

    /// Waits for all ranks, but not for ever: whether all have come here. A rank that nobody has joined goes on to
    /// [`abort`](Self::abort), since the others may wait elsewhere. **Collective**
    pub fn meet(&self, patience: Duration) -> bool {
        let start = Instant::now();
        let mut all_here = self.0.farewell.immediate_barrier();
        while start.elapsed() < patience {
            match all_here.test() {
                Ok(_) => return true,
                Err(waiting) => all_here = waiting,
            }
            sleep(PULSE);
        }
        forget(all_here);
        false
    }

    /// Number of this rank, from 0.
    pub fn rank(&self) -> usize {
        self.0.world.rank() as usize
    }

    /// Number of ranks.
    pub fn size(&self) -> usize {
        self.0.world.size() as usize
    }

    /// Ends all ranks at once with this exit code.
    pub fn abort(&self, code: i32) -> ! {
        the_end_is_ours(false);
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

impl Inner {
    /// Ends PETSc, and MPI if PETSc has ended well. **Collective**
    fn end(&mut self) -> Result<()> {
        let Some(universe) = self.universe.take() else { return Ok(()) };
        unsafe { ffi::PetscPopErrorHandler() };
        let ended = with_message("PetscFinalize", || unsafe { ffi::PetscFinalize() });
        the_end_is_ours(false);
        if ended.is_err() && self.world.size() > 1 {
            forget(universe);
        }
        ended
    }
}

impl Drop for Inner {
    /// Ends PETSc and MPI; a failure has nobody else left to tell. **Collective**
    fn drop(&mut self) {
        if let Err(error) = self.end() {
            let _ = std::io::stderr().write_all(format!("mezha: {error}\n").as_bytes());
            end_all_ranks(1);
        }
    }
}

/// Ends all ranks at once with this exit code, from a rank that cannot end with them; returns if there are no others.
pub fn end_all_ranks(code: i32) {
    the_end_is_ours(false);
    if has_others() {
        SimpleCommunicator::world().abort(code);
    }
}

/// Whether a library that ends this process, as PETSc does after some options, cuts a run short: exit code 1 then.
fn the_end_is_ours(ours: bool) {
    unsafe { ffi::mezha_end_is_ours(ffi::flag(ours)) };
}

/// Ranks with different words would wait for each other, or mix two cases. **Collective**
fn refuse_unequal_words(world: &SimpleCommunicator) -> Result<()> {
    let words = std::env::args_os().skip(1).collect::<Vec<_>>().join(" ".as_ref());
    match odd_one(world, words.as_encoded_bytes()) {
        None => Ok(()),
        Some((rank, words)) => Err(Error::UnequalWords { rank, words: String::from_utf8_lossy(&words).into_owned() }),
    }
}

/// Whether a word of the command line is the name of an option: one or two minuses and a letter.
pub fn is_name(word: &str) -> bool {
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
                the_end_is_ours(false);
                if !mpi::environment::is_finalized() {
                    SimpleCommunicator::world().abort(1);
                }
            });
        }));
    });
}
