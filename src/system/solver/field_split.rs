//! The field split of the augmented system: a Krylov method, preconditioned by a block triangle with a multigrid cycle.

use super::block_triangle::BlockTriangle;
use super::bordered::Bordered;
use super::ladder::Rung;
use super::options::{FACTOR, FIELD_SPLIT, Options, REDUNDANT_FACTOR, is_split_changed, lambda_options, redundant_factor};
use super::preconditioning::Preconditioning;
use super::prepared::{Prepared, set_operators};
use crate::discretisation::{Form, SystemError};
use crate::multigrid::{Cycle, GalerkinLevels, Interpolation, Stiffness, takes_another_preconditioner};
use crate::petsc::{self, Action, Krylov, Preconditioner, ReplacedAction};
use crate::system::saddle_point::SaddlePoint;
use std::cell::RefCell;
use std::rc::Rc;

/// The rung of the field split of a system. **Collective**
///
/// # Errors
/// [`SystemError`] from PETSc.
pub fn field_split(system: &SaddlePoint, interpolations: &Rc<[Interpolation]>, rung: Rung) -> Result<Prepared, SystemError> {
    let preconditioning = rung.preconditioning;
    set_options(system, rung)?;
    let krylov = Krylov::new(&system.session, "")?;
    set_operators(&krylov, system, preconditioning)?;
    let [u, lambda] = system.nest.nest_index_sets()?;
    let preconditioner = krylov.preconditioner();
    preconditioner.field_split_schur(&[("u", &u), ("lambda", &lambda)], &system.multipliers.schur)?;
    krylov.set_from_options()?;
    krylov.watch()?;
    krylov.set_up()?;
    let levels = match preconditioning {
        Preconditioning::Factor => None,
        _ if takes_another_preconditioner(&system.session) => {
            // Without multipliers PETSc takes the whole nest for its first block: no preconditioner makes anything of a nest. With
            // multipliers this is the block that it has.
            let stiffness = system.finest_stiffness().operator();
            preconditioner.field_split_solvers()?[0].set_operators(stiffness, stiffness)?;
            None
        }
        _ => Some(levels(&preconditioner, system, interpolations, preconditioning)?),
    };
    let cycle = levels.as_ref().map(|(_, cycle)| cycle);
    let block_triangle = match cycle.filter(|_| !is_split_changed(&system.session)) {
        Some(cycle) => {
            let lower = preconditioner.field_split_solvers()?.pop().expect("two fields");
            Some(BlockTriangle::new(cycle, lower, system)?)
        }
        None => None,
    };
    let (_replaced, bordered) = replace_action(&krylov, block_triangle, system, Form::Augmented)?;
    let kind = preconditioner.field_split_solvers()?[0].preconditioner().kind();
    // A factor is made by all ranks together, or by each for itself.
    let is_factor = preconditioning == Preconditioning::Factor && ["cholesky", "redundant"].contains(&kind.as_str());
    let name = if is_factor || kind == "shell" { name(preconditioning) } else { format!("fieldsplit ({kind})") };
    Ok(Prepared { krylov, _replaced, bordered, levels, name })
}

/// Sets the options of the field split, where the user has set none.
fn set_options(system: &SaddlePoint, Rung { method, preconditioning, .. }: Rung) -> Result<(), SystemError> {
    let lambda = lambda_options(system.multipliers.pattern, system.session.size());
    let method = [("-ksp_type", method)];
    // A factor before leaves its package behind, which goes with nothing else.
    for (name, _) in FACTOR.iter().chain(REDUNDANT_FACTOR) {
        petsc::options::clear(&system.session, name)?;
    }
    let is_factor = preconditioning == Preconditioning::Factor;
    let (whole, factor): (Options, Options) = if is_factor { (FACTOR, redundant_factor(system)) } else { (&[], &[]) };
    for (name, value) in FIELD_SPLIT.iter().chain(lambda).chain(whole).chain(&method).chain(factor) {
        petsc::options::set_default(&system.session, name, value)?;
    }
    Ok(())
}

/// Auxiliary levels, and the cycle on all levels as the preconditioner of field `u`. **Collective**
fn levels(
    preconditioner: &Preconditioner,
    system: &SaddlePoint,
    interpolations: &[Interpolation],
    preconditioning: Preconditioning,
) -> Result<(GalerkinLevels, Rc<RefCell<Cycle>>), SystemError> {
    let steps: Vec<_> = interpolations.iter().filter_map(|step| step.coarsening.clone()).collect();
    let auxiliary = GalerkinLevels::new(system.stiffness[0].lattice(), &steps, &system.session);
    let all = auxiliary.iter().chain(system.stiffness.iter().map(Stiffness::lattice));
    let cycle = Rc::new(RefCell::new(Cycle::new(all, interpolations, preconditioning.conjugate_steps(), &system.session)?));
    let solver = preconditioner.field_split_solvers()?.swap_remove(0);
    let action = Box::new(cycle.clone());
    solver.preconditioner().set_action("multigrid F-cycle on even macro triangles and stored rows", action)?;
    solver.set_up()?;
    Ok((auxiliary, cycle))
}

/// Puts in the place of what the preconditioner does a block triangle, and around it what knows of rigid motions, if there are
/// such. **Collective**
pub(super) fn replace_action(
    krylov: &Krylov,
    block_triangle: Option<Rc<BlockTriangle>>,
    system: &SaddlePoint,
    form: Form,
) -> Result<(Option<ReplacedAction>, Option<Rc<Bordered>>), SystemError> {
    let Some(border) = &system.border else {
        let replaced = block_triangle.map(|action| ReplacedAction::new(krylov.preconditioner(), |_| Ok(Box::new(action))));
        return Ok((replaced.transpose()?, None));
    };
    let mut bordered = None;
    let replaced = ReplacedAction::new(krylov.preconditioner(), |of_kind| {
        let of_blocks = block_triangle.clone().map_or(of_kind, |action| Box::new(action) as Box<dyn Action>);
        let action = Bordered::new(of_blocks, block_triangle, border.clone(), form);
        bordered = Some(action.clone());
        Ok(Box::new(action))
    })?;
    Ok((Some(replaced), bordered))
}

/// The solver with a preconditioning, in words.
pub fn name(preconditioning: Preconditioning) -> String {
    format!("fieldsplit ({})", preconditioning.words("multigrid F-cycle"))
}
