//! Matrices known by their actions alone: PETSc's Krylov methods use them like any other.

use super::error::{Result, check, petsc};
use super::ffi;
use super::matrix::Matrix;
use super::preconditioner::Preconditioner;
use super::session::Session;
use super::vector::{Lent, Vector, length};
use std::ffi::{CString, c_void};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::{mem, ptr};

/// A matrix by what it does; it need not know what it is not asked for. **Collective**, all of it; an error must be one on all
/// ranks.
pub trait Operator {
    /// `y = A x`.
    fn multiply(&self, x: &Vector, y: &mut Vector) -> Result<()>;

    /// Largest sum of magnitudes in a row of this rank, or of all.
    fn norm_infinity(&self) -> Result<f64> {
        unreachable!("a matrix whose norm is not known")
    }

    /// Floating-point operations of a product on this rank, for PETSc's log.
    fn work(&self) -> f64 {
        0.0
    }
}

/// What a preconditioner does. **Collective**; an error must be one on all ranks.
pub trait Action {
    /// `y = M⁻¹ x`.
    fn apply(&self, x: &Vector, y: &mut Vector) -> Result<()>;
}

/// What PETSc keeps of a shell.
struct Context<T: ?Sized> {
    action: Box<T>,
    session: Session,
}

type Acting = dyn Action;
type Multiplying = dyn Operator;
type Code = ffi::PetscErrorCode;

impl Matrix {
    /// A matrix with `rows` × `columns` on this rank that knows its products and its norm. **Collective**
    pub fn operator(session: &Session, rows: usize, columns: usize, action: Box<dyn Operator>) -> Result<Self> {
        let any = ffi::mezha_determine;
        let context = Box::into_raw(Box::new(Context { action, session: session.clone() }));
        let mut raw = ptr::null_mut();
        petsc!(MatCreateShell(session.raw(), length(rows), length(columns), any, any, context.cast(), &mut raw))?;
        let matrix = Self::from_raw(session, raw);
        petsc!(mezha_set_context_destructor(raw, Some(drop_context)))?;
        // PETSc stores every operation as a function without arguments and calls it as what it is.
        matrix.set_operation(ffi::MatOperation::MATOP_MULT, unsafe { mem::transmute::<Two, Plain>(multiply) })?;
        matrix.set_operation(ffi::MatOperation::MATOP_NORM, unsafe { mem::transmute::<Norm, Plain>(norm) })?;
        Ok(matrix)
    }

    fn set_operation(&self, operation: ffi::MatOperation, function: Plain) -> Result<()> {
        petsc!(MatShellSetOperation(self.raw, operation, Some(function)))
    }
}

type Plain = unsafe extern "C" fn();
type Two = unsafe extern "C" fn(ffi::Mat, ffi::Vec, ffi::Vec) -> Code;
type Norm = unsafe extern "C" fn(ffi::Mat, ffi::NormType, *mut f64) -> Code;

impl Preconditioner {
    /// Makes this an action; `name` is what PETSc shows of it. **Collective**
    pub fn set_action(&self, name: &str, action: Box<dyn Action>) -> Result<()> {
        self.set_kind("shell")?;
        let name = CString::new(name).expect("a name has no zero byte");
        petsc!(PCShellSetName(self.raw, name.as_ptr()))?;
        let context = Box::into_raw(Box::new(Context::<dyn Action> { action, session: self.session.clone() }));
        petsc!(PCShellSetContext(self.raw, context.cast()))?;
        petsc!(PCShellSetDestroy(self.raw, Some(drop_action)))?;
        petsc!(PCShellSetApply(self.raw, Some(apply)))
    }
}

/// An action in place of what the kind of a preconditioner does, for as long as this lives. Set-up, options, parts and what PETSc
/// shows of the preconditioner stay those of its kind.
pub struct ReplacedAction {
    preconditioner: Preconditioner,
    before: ffi::mezha_apply,
    _context: Box<Context<dyn Action>>,
}

/// What the kind of a preconditioner does.
struct ActionOfKind {
    preconditioner: Preconditioner,
    apply: ffi::mezha_apply,
}

impl Action for ActionOfKind {
    fn apply(&self, x: &Vector, y: &mut Vector) -> Result<()> {
        let apply = self.apply.expect("the kind of a preconditioner does something");
        check("PCApply", unsafe { apply(self.preconditioner.raw, x.raw, y.raw) })
    }
}

impl ReplacedAction {
    /// Puts an action in the place, which may make use of what the kind does. The preconditioner is set up. **Collective**
    pub fn new(preconditioner: Preconditioner, make: impl FnOnce(Box<dyn Action>) -> Result<Box<dyn Action>>) -> Result<Self> {
        let session = preconditioner.session.clone();
        let mut before = None;
        petsc!(mezha_replace_apply(preconditioner.raw, Some(apply_replaced), &mut before))?;
        let of_kind = ActionOfKind { preconditioner: Preconditioner::share(&session, preconditioner.raw)?, apply: before };
        let mut context = Box::new(Context::<dyn Action> { action: make(Box::new(of_kind))?, session });
        petsc!(PCSetApplicationContext(preconditioner.raw, ptr::from_mut(&mut *context).cast()))?;
        Ok(Self { preconditioner, before, _context: context })
    }
}

impl Drop for ReplacedAction {
    /// The kind does again what it did before.
    fn drop(&mut self) {
        let mut replaced = None;
        unsafe { ffi::mezha_replace_apply(self.preconditioner.raw, self.before, &mut replaced) };
    }
}

/// [`ReplacedAction`] as PETSc calls it.
unsafe extern "C" fn apply_replaced(preconditioner: ffi::PC, x: ffi::Vec, y: ffi::Vec) -> Code {
    let find = |context: *mut c_void| petsc!(PCGetApplicationContext(preconditioner, context));
    act(find, |action: &Acting, session| action.apply(&Lent::new(session, x), &mut Lent::new(session, y)))
}

/// Drops the action with the preconditioner.
unsafe extern "C" fn drop_action(preconditioner: ffi::PC) -> Code {
    let mut context = ptr::null_mut::<c_void>();
    let code = unsafe { ffi::PCShellGetContext(preconditioner, ptr::from_mut(&mut context).cast()) };
    if code == 0 {
        drop(unsafe { Box::from_raw(context.cast::<Context<dyn Action>>()) });
    }
    code
}

/// [`Action`] as PETSc calls it.
unsafe extern "C" fn apply(preconditioner: ffi::PC, x: ffi::Vec, y: ffi::Vec) -> Code {
    let find = |context: *mut c_void| petsc!(PCShellGetContext(preconditioner, context));
    act(find, |action: &Acting, session| action.apply(&Lent::new(session, x), &mut Lent::new(session, y)))
}

/// Runs an action on the context that `find` writes to a place it is given.
fn act<T: ?Sized>(find: impl FnOnce(*mut c_void) -> Result<()>, action: impl FnOnce(&T, &Session) -> Result<()>) -> Code {
    report(|| {
        let mut context = ptr::null_mut::<c_void>();
        find(ptr::from_mut(&mut context).cast())?;
        let context = unsafe { &*context.cast::<Context<T>>() };
        action(&context.action, &context.session)
    })
}

/// The outcome of an action as PETSc wants it. No panic crosses into C, even where the hook that ends all ranks is replaced.
fn report(action: impl FnOnce() -> Result<()>) -> Code {
    let outcome = catch_unwind(AssertUnwindSafe(action));
    let message = match outcome {
        Ok(Ok(())) => return 0,
        Ok(Err(error)) => error.to_string(),
        Err(_) => "panic in the action of a shell".into(),
    };
    let message = CString::new(message.replace('\0', " ")).expect("no zero byte is left");
    unsafe { ffi::mezha_callback_error(message.as_ptr()) }
}

/// Drops the action with the matrix.
unsafe extern "C" fn drop_context(given: *mut c_void) -> Code {
    let context = unsafe { ffi::mezha_context_to_destroy(given) };
    drop(unsafe { Box::from_raw(context.cast::<Context<Multiplying>>()) });
    0
}

// [`Operator`] as PETSc calls it.

unsafe extern "C" fn multiply(matrix: ffi::Mat, x: ffi::Vec, y: ffi::Vec) -> Code {
    let find = |context: *mut c_void| petsc!(MatShellGetContext(matrix, context));
    act(find, |action: &Multiplying, session| {
        action.multiply(&Lent::new(session, x), &mut Lent::new(session, y))?;
        petsc!(mezha_log_work(action.work()))
    })
}

unsafe extern "C" fn norm(matrix: ffi::Mat, kind: ffi::NormType, norm: *mut f64) -> Code {
    let find = |context: *mut c_void| petsc!(MatShellGetContext(matrix, context));
    act(find, |action: &Multiplying, session| {
        assert_eq!(kind, ffi::NormType::NORM_INFINITY, "the one norm that shells have");
        unsafe { [*norm] = session.max([action.norm_infinity()?]) };
        Ok(())
    })
}
