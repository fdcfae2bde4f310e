//! Options of PETSc that a run refuses.

use crate::output::RunError;
use crate::petsc::{Session, options};

/// Outer methods that the systems can be solved with; what else PETSc has wants another side, norm or start.
const METHODS: &str =
    "gmres, fgmres, lgmres, dgmres, pgmres, pipefgmres, gcr, bcgs, fbcgs, fbcgsr, bcgsl, pipebcgs, qmrcgs, tfqmr, tcqmr, cgs";

/// What the case says is not said again to PETSc, and what would end in one of its crashes is not said at all.
pub fn refuse_options(session: &Session) -> Result<(), RunError> {
    const REFUSED: [(&str, &str); 4] = [
        ("-ksp_rtol", "has no effect here: give `--set solver.tolerance=...`"),
        ("-ksp_max_it", "has no effect here: it is 300; a solve that needs more has failed"),
        ("-fieldsplit_u_pc_mg_levels", "cannot be: the levels are those of the mesh; give `--set mesh.refine=...`"),
        ("-fp_trap", "cannot be: infinite values are looked at where they arise, and are no errors"),
    ];
    if let Some((name, why)) = REFUSED.iter().find(|(name, _)| options::get(session, name).is_some()) {
        return Err(RunError::Input(format!("PETSc option {name} {why}")));
    }
    if options::get(session, "-fieldsplit_u_pc_type").is_some_and(|kind| kind.eq_ignore_ascii_case("mg")) {
        let why = "PETSc does not know the levels; without this option mezha's own cycle works on them";
        return Err(RunError::Input(format!("PETSc option -fieldsplit_u_pc_type mg cannot be: {why}")));
    }
    let is_known = |method: &str| METHODS.split(", ").any(|known| known.eq_ignore_ascii_case(method));
    match options::get(session, "-ksp_type").filter(|method| !is_known(method)) {
        None => Ok(()),
        Some(method) => Err(RunError::Input(format!(
            "PETSc option -ksp_type {method}: the outer method is one that takes a nonsymmetric preconditioner from the right and an initial guess: {METHODS}"
        ))),
    }
}
