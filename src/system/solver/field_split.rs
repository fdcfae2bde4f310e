//! The field split of the augmented system: a Krylov method, preconditioned by a block triangle with a multigrid cycle.

use super::block_triangle::BlockTriangle;
use super::bordered::Bordered;
use super::ladder::Rung;
use super::operators::set_operators;
use super::options::{
    CoarseSolver, FIELD_SPLIT, MOST_REDUNDANT, Options, REDUNDANT_FACTOR, is_changed, is_split_changed, lambda_options,
    preconditioning_options,
};
use super::preconditioning::Preconditioning;
use super::prepared::Prepared;
use crate::discretisation::{Form, SystemError};
use crate::multigrid::{Cycle, Expanded, GalerkinLevels, Interpolation, Stiffness};
use crate::petsc::{self, Action, Krylov, MultigridLevel, Preconditioner, ReplacedAction, Session};
use crate::system::saddle_point::SaddlePoint;
use std::rc::Rc;

/// The rung of the field split of a system. **Collective**
///
/// # Errors
/// [`SystemError`] from PETSc.
pub fn field_split(
    system: &SaddlePoint,
    interpolations: &Rc<[Interpolation]>,
    rung: Rung,
    session: &Session,
) -> Result<Prepared, SystemError> {
    let preconditioning = rung.preconditioning;
    set_options(system, interpolations, rung, session)?;
    let krylov = Krylov::new(session, "")?;
    set_operators(&krylov, system, preconditioning, session)?;
    let [u, lambda] = system.nest.nest_index_sets()?;
    let preconditioner = krylov.preconditioner();
    preconditioner.field_split_schur(&[("u", &u), ("lambda", &lambda)], &system.multipliers.schur)?;
    krylov.set_from_options()?;
    krylov.watch()?;
    krylov.set_up()?;
    let (auxiliary, cycle, coarsest) = match preconditioning {
        Preconditioning::Factor => (GalerkinLevels::default(), None, None),
        _ => levels(&preconditioner, system, interpolations, preconditioning, session)?,
    };
    let block_triangle = match cycle.as_ref().filter(|_| !is_split_changed(session)) {
        Some(cycle) => {
            let lower = preconditioner.field_split_solvers()?.pop().expect("two fields");
            Some(BlockTriangle::new(cycle, lower, &system.multipliers.transpose, system.border.clone(), session)?)
        }
        None => None,
    };
    let (_replaced, bordered) = replace_action(&krylov, block_triangle, system, Form::Augmented, session)?;
    let kind = preconditioner.field_split_solvers()?[0].preconditioner().kind();
    let own = kind == "mg" || kind == "shell" || is_factor(&kind) && preconditioning == Preconditioning::Factor;
    let name = if own { name(preconditioning) } else { format!("fieldsplit ({kind})") };
    Ok(Prepared { krylov, _replaced, bordered, auxiliary, cycle, coarsest, name })
}

/// Sets the options of the field split, where the user has set none.
fn set_options(
    system: &SaddlePoint,
    interpolations: &[Interpolation],
    Rung { method, preconditioning, .. }: Rung,
    session: &Session,
) -> Result<(), SystemError> {
    let coarsest = interpolations.first().map_or(0, |interpolation| interpolation.matrix.size().1);
    let coarse = CoarseSolver::of(coarsest);
    let lambda = lambda_options(system.multipliers.pattern, session.size());
    let unknowns = system.finest_stiffness().operator().size().0;
    let method = [("-ksp_type", method)];
    let is_redundant = preconditioning == Preconditioning::Factor && session.size() > 1 && unknowns <= MOST_REDUNDANT;
    let factor: Options = if is_redundant { REDUNDANT_FACTOR } else { &[] };
    // A factor before leaves its package behind, which goes with nothing else.
    for (name, _) in preconditioning_options(Preconditioning::Factor).iter().chain(REDUNDANT_FACTOR) {
        petsc::options::clear(session, name)?;
    }
    let smoother = preconditioning_options(preconditioning);
    for (name, value) in FIELD_SPLIT.iter().chain(lambda).chain(coarse.options()).chain(smoother).chain(&method).chain(factor) {
        petsc::options::set_default(session, name, value)?;
    }
    Ok(())
}

/// Auxiliary levels, and the cycle on all levels as the preconditioner of field `u`: mezha's own where the options allow it,
/// otherwise PETSc's, with the rows of the coarsest level. **Collective**
fn levels(
    preconditioner: &Preconditioner,
    system: &SaddlePoint,
    interpolations: &[Interpolation],
    preconditioning: Preconditioning,
    session: &Session,
) -> Result<(GalerkinLevels, Option<Cycle>, Option<Expanded>), SystemError> {
    let steps: Vec<_> = interpolations.iter().filter_map(|step| step.coarsening.clone()).collect();
    let auxiliary = GalerkinLevels::new(&system.stiffness[0], &steps, session)?;
    let all = || auxiliary.iter().chain(&system.stiffness);
    let solver = preconditioner.field_split_solvers()?.swap_remove(0);
    petsc::options::clear(session, "-fieldsplit_u_pc_type")?;
    let (mut cycle, mut coarsest) = (None, None);
    if preconditioning == Preconditioning::Sweep && !is_changed(session) {
        cycle = Cycle::new(all(), interpolations, session)?;
    }
    match &cycle {
        Some(cycle) => solver.preconditioner().set_action("multigrid F-cycle on strips and stored rows", cycle.action())?,
        None => {
            let lattice = all().next().expect("a coarsest level").lattice();
            let rows = &coarsest.insert(Expanded::new(lattice, session)?).matrix;
            let operators = std::iter::once(rows).chain(all().skip(1).map(Stiffness::operator));
            let steps = std::iter::once(None).chain(interpolations.iter().map(|step| Some(&step.matrix)));
            let levels = operators.zip(steps).map(|(operator, interpolation)| MultigridLevel { operator, interpolation });
            solver.preconditioner().multigrid(&levels.collect::<Vec<_>>())?;
        }
    }
    solver.set_up()?;
    Ok((auxiliary, cycle, coarsest))
}

/// Puts in the place of what the preconditioner does a block triangle, and around it what knows of rigid motions, if there are
/// such. **Collective**
pub(super) fn replace_action(
    krylov: &Krylov,
    block_triangle: Option<Rc<BlockTriangle>>,
    system: &SaddlePoint,
    form: Form,
    session: &Session,
) -> Result<(Option<ReplacedAction>, Option<Rc<Bordered>>), SystemError> {
    let Some(border) = &system.border else {
        let replaced = block_triangle.map(|action| ReplacedAction::new(krylov.preconditioner(), |_| Ok(Box::new(action))));
        return Ok((replaced.transpose()?, None));
    };
    let mut bordered = None;
    let replaced = ReplacedAction::new(krylov.preconditioner(), |of_kind| {
        let of_blocks = block_triangle.clone().map_or(of_kind, |action| Box::new(action) as Box<dyn Action>);
        let action = Bordered::new(of_blocks, block_triangle, border.clone(), form, session);
        bordered = Some(action.clone());
        Ok(Box::new(action))
    })?;
    Ok((Some(replaced), bordered))
}

/// Whether this is the preconditioner that factorises, by all ranks together or by each for itself.
fn is_factor(kind: &str) -> bool {
    kind == "cholesky" || kind == "redundant"
}

/// The solver with a preconditioning, in words.
pub fn name(preconditioning: Preconditioning) -> String {
    format!("fieldsplit ({})", preconditioning.words("multigrid F-cycle"))
}
