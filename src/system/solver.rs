//! Linear solvers of the saddle point.
//!
//! `fieldsplit`: GMRES, preconditioned from the right by the block upper triangle of `K + BᵀDB` and `S = -D⁻¹`; one
//! geometric multigrid F-cycle stands for the inverse of the first, or BoomerAMG where the mesh has no levels (for P2
//! below one smoothing step, on the P1 space of the same triangles).
//! `direct`: MUMPS on the plain system. All settings are PETSc options, which a user's own override; only the
//! tolerance is the case's.

use super::{Form, SaddlePoint, SchurPattern, SolverChoice, SystemError};
use crate::petsc::{Krylov, Level, Matrix, Session, Vector, options};

/// Iterations after which a solve has failed.
const MOST_ITERATIONS: usize = 300;

/// Relative residual above which rounding is no excuse.
const MOST_ROUNDING: f64 = 1e-6;

/// Rows up to which the coarsest level is factorised by all ranks together.
const LARGE: usize = 50_000;

/// Unknowns up to which the coarsest level is factorised on every rank.
const SMALL: usize = 3000;

/// A solver, ready for one system.
pub struct LinearSolver {
    krylov: Krylov,
    session: Session,
    form: Form,
    /// The converted system of the direct solver.
    converted: Option<Matrix>,
    /// What preconditions the displacement block, in words.
    pub name: String,
}

/// How a linear solve ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Ending {
    /// The tolerance is reached.
    Converged,
    /// Rounding allows no smaller residual; in words.
    Rounding(String),
    /// The residual stays too large; in words.
    Failed(String),
}

/// A linear solve in figures.
#[derive(Clone, Debug, PartialEq)]
pub struct LinearSolve {
    /// How it ended.
    pub ending: Ending,
    /// Krylov iterations.
    pub iterations: usize,
    /// True residual of the augmented system, relative to the right-hand side.
    pub residual: f64,
}

impl SolverChoice {
    /// Whether the system is augmented for this solver.
    pub fn form(self) -> Form {
        match self {
            Self::Auto | Self::FieldSplit => Form::Augmented,
            Self::Direct => Form::Plain,
        }
    }
}

impl LinearSolver {
    /// Sets a solver up; `interpolations[l]` leads from level `l` to level `l + 1` (the direct solver wants none).
    /// **Collective**
    pub fn new(
        system: &SaddlePoint,
        interpolations: &[Matrix],
        choice: SolverChoice,
        session: &Session,
    ) -> Result<Self, SystemError> {
        match choice.form() {
            Form::Augmented => Self::field_split(system, interpolations, session),
            Form::Plain => Self::direct(system, session),
        }
    }

    fn field_split(system: &SaddlePoint, interpolations: &[Matrix], session: &Session) -> Result<Self, SystemError> {
        let multigrid = !interpolations.is_empty();
        let coarse = CoarseSolver::of(system.stiffness[0].size().0, system.stiffness.len(), session.size());
        let lambda = lambda_options(system.multipliers.pattern, session.size());
        for (name, value) in FIELD_SPLIT.iter().chain(lambda).chain(coarse.options(multigrid)) {
            options::set_default(session, name, value)?;
        }
        let krylov = Krylov::new(session, "")?;
        krylov.set_operators(&system.nest, &system.nest)?;
        let [u, lambda] = system.nest.nest_index_sets()?;
        let preconditioner = krylov.preconditioner();
        preconditioner.field_split_schur(&[("u", &u), ("lambda", &lambda)], &system.multipliers.schur)?;
        krylov.set_from_options()?;
        krylov.set_up()?;
        if multigrid {
            let solvers = preconditioner.field_split_solvers()?;
            let steps = std::iter::once(None).chain(interpolations.iter().map(Some));
            let levels: Vec<Level> =
                system.stiffness.iter().zip(steps).map(|(operator, interpolation)| Level { operator, interpolation }).collect();
            options::clear(session, "-fieldsplit_u_pc_type")?;
            solvers[0].preconditioner().multigrid(&levels)?;
            solvers[0].set_up()?;
        }
        let name = match preconditioner.field_split_solvers()?[0].preconditioner().kind().as_str() {
            "mg" | "hypre" => format!("fieldsplit ({})", coarse.words(multigrid)),
            other => format!("fieldsplit ({other})"),
        };
        Ok(Self { krylov, session: session.clone(), form: Form::Augmented, converted: None, name })
    }

    fn direct(system: &SaddlePoint, session: &Session) -> Result<Self, SystemError> {
        for (name, value) in [
            ("-ksp_type", "gmres"),
            ("-ksp_pc_side", "right"),
            ("-ksp_norm_type", "unpreconditioned"),
            ("-ksp_divtol", "1e30"),
            ("-pc_type", "cholesky"),
            ("-pc_factor_mat_solver_type", "mumps"),
            // Towards ν = 0.5 good pivots fall short of MUMPS's own 0.01, and those put off outgrow its memory from 0.4999 on.
            ("-mat_mumps_cntl_1", "1e-4"),
            ("-mat_mumps_icntl_14", "100"),
        ] {
            options::set_default(session, name, value)?;
        }
        let krylov = Krylov::new(session, "")?;
        let mut solver =
            Self { krylov, session: session.clone(), form: Form::Plain, converted: None, name: "direct (MUMPS)".into() };
        solver.refresh(system)?;
        solver.krylov.set_from_options()?;
        solver.krylov.set_up()?;
        Ok(solver)
    }

    /// Takes over changed blocks. **Collective**
    pub fn refresh(&mut self, system: &SaddlePoint) -> Result<(), SystemError> {
        if self.form == Form::Plain {
            let mut converted = system.nest.convert_aij()?;
            converted.set_symmetric(true)?;
            self.krylov.set_operators(&converted, &converted)?;
            self.converted = Some(converted);
        } else {
            self.krylov.set_operators(&system.nest, &system.nest)?;
        }
        Ok(())
    }

    /// Options that the user gave and no object of this solver has asked for.
    pub fn unused_options(&self) -> Result<Vec<String>, SystemError> {
        Ok(options::unused(&self.session)?)
    }

    /// Solves from the `x` that is given, until the residual is below `tolerance |b|` or rounding stops it. **Collective**
    pub fn solve(&self, system: &SaddlePoint, b: &Vector, x: &mut Vector, tolerance: f64) -> Result<LinearSolve, SystemError> {
        let norm = b.norm()?;
        if norm == 0.0 {
            x.set(0.0)?;
            return Ok(LinearSolve { ending: Ending::Converged, iterations: 0, residual: 0.0 });
        }
        self.krylov.set_initial_guess_nonzero(true)?;
        self.krylov.set_tolerance(tolerance, MOST_ITERATIONS)?;
        let mut r = b.duplicate()?;
        system.nest.residual(b, x, &mut r)?;
        if r.norm()? > norm {
            x.set(0.0)?;
        }
        let (mut iterations, mut before) = (0, f64::INFINITY);
        loop {
            let solved = self.krylov.solve_allowing(b, x)?;
            iterations += solved.iterations;
            system.nest.residual(b, x, &mut r)?;
            let residual = r.norm()? / norm;
            if residual <= tolerance {
                return Ok(LinearSolve { ending: Ending::Converged, iterations, residual });
            }
            let falls = residual < 0.5 * before;
            if !falls || iterations >= MOST_ITERATIONS {
                let floor = self.rounding(system, x, norm)?;
                let ending = if residual <= floor.min(MOST_ROUNDING) {
                    Ending::Rounding(format!(
                        "the residual stands at {residual:.1e}: rounding allows no less, tolerance {tolerance:.0e} is out of reach"
                    ))
                } else {
                    let reason = if solved.converged { "the residual no longer falls".to_string() } else { solved.reason };
                    Ending::Failed(format!("linear solver: {reason} after {iterations} iterations, residual {residual:.1e}"))
                };
                return Ok(LinearSolve { ending, iterations, residual });
            }
            before = residual;
        }
    }

    /// Size that rounding alone can give the relative residual: `10 ε |K| |x| / |b|`.
    fn rounding(&self, system: &SaddlePoint, x: &Vector, norm: f64) -> Result<f64, SystemError> {
        let stiffness = system.stiffness[system.stiffness.len() - 1].norm_infinity()?;
        Ok(10.0 * f64::EPSILON * stiffness * x.norm()? / norm)
    }
}

/// Names and values of PETSc options.
type Options = &'static [(&'static str, &'static str)];

/// Defaults of the outer method and the block solvers; what a user gives after `--` wins.
const FIELD_SPLIT: Options = &[
    ("-ksp_type", "gmres"),
    ("-ksp_pc_side", "right"),
    ("-ksp_gmres_restart", "60"),
    ("-ksp_norm_type", "unpreconditioned"),
    // A start from another active set may be far off.
    ("-ksp_divtol", "1e30"),
    ("-pc_type", "fieldsplit"),
    ("-fieldsplit_u_ksp_type", "preonly"),
    ("-fieldsplit_lambda_ksp_type", "preonly"),
    ("-fieldsplit_u_mg_levels_ksp_type", "richardson"),
    ("-fieldsplit_u_mg_levels_ksp_max_it", "1"),
    ("-fieldsplit_u_mg_levels_pc_type", "sor"),
    ("-fieldsplit_u_mg_coarse_ksp_type", "preonly"),
];

/// The exact inverse of `S`, for each of its patterns.
fn lambda_options(pattern: SchurPattern, ranks: usize) -> Options {
    match (pattern, ranks) {
        (SchurPattern::Diagonal, _) => &[("-fieldsplit_lambda_pc_type", "jacobi")],
        (SchurPattern::Pairs, _) => &[("-fieldsplit_lambda_pc_type", "pbjacobi")],
        (SchurPattern::Mixed, 1) => &[("-fieldsplit_lambda_pc_type", "lu")],
        (SchurPattern::Mixed, _) => &[("-fieldsplit_lambda_pc_type", "redundant")],
    }
}

/// What solves on the coarsest level.
#[derive(Clone, Copy)]
enum CoarseSolver {
    /// Factorisation by one rank.
    Alone,
    /// Factorisation by every rank for itself.
    Redundant,
    /// Factorisation by all ranks together.
    Shared,
    /// One cycle of BoomerAMG: the mesh has no coarser levels.
    Algebraic,
}

impl CoarseSolver {
    fn of(rows: usize, levels: usize, ranks: usize) -> Self {
        match (rows, levels, ranks) {
            (_, 1, _) => Self::Algebraic,
            (..=SMALL, _, 1) => Self::Alone,
            (..=SMALL, ..) => Self::Redundant,
            (LARGE.., ..) | (_, 2, _) => Self::Algebraic,
            _ => Self::Shared,
        }
    }

    fn words(self, multigrid: bool) -> &'static str {
        match (self, multigrid) {
            (Self::Algebraic, false) => "BoomerAMG",
            (Self::Algebraic, true) => "P2 smoother over BoomerAMG",
            _ => "multigrid F-cycle",
        }
    }

    fn options(self, multigrid: bool) -> Options {
        match (self, multigrid) {
            // Multigrid takes the place of `none` once the block solvers exist.
            (Self::Alone, _) => &[("-fieldsplit_u_pc_type", "none"), ("-fieldsplit_u_mg_coarse_pc_type", "lu")],
            (Self::Redundant, _) => &[
                ("-fieldsplit_u_pc_type", "none"),
                ("-fieldsplit_u_mg_coarse_pc_type", "redundant"),
                ("-fieldsplit_u_mg_coarse_redundant_pc_type", "lu"),
            ],
            (Self::Shared, _) => &[
                ("-fieldsplit_u_pc_type", "none"),
                ("-fieldsplit_u_mg_coarse_pc_type", "cholesky"),
                ("-fieldsplit_u_mg_coarse_pc_factor_mat_solver_type", "mumps"),
            ],
            (Self::Algebraic, true) => &[
                ("-fieldsplit_u_pc_type", "none"),
                ("-fieldsplit_u_mg_coarse_pc_type", "hypre"),
                ("-fieldsplit_u_mg_coarse_pc_hypre_type", "boomeramg"),
                ("-fieldsplit_u_mg_coarse_pc_hypre_boomeramg_coarsen_type", "HMIS"),
                ("-fieldsplit_u_mg_coarse_pc_hypre_boomeramg_interp_type", "ext+i"),
                ("-fieldsplit_u_mg_coarse_pc_hypre_boomeramg_strong_threshold", "0.25"),
            ],
            (Self::Algebraic, false) => &[
                ("-fieldsplit_u_pc_type", "hypre"),
                ("-fieldsplit_u_pc_hypre_type", "boomeramg"),
                ("-fieldsplit_u_pc_hypre_boomeramg_coarsen_type", "HMIS"),
                ("-fieldsplit_u_pc_hypre_boomeramg_interp_type", "ext+i"),
                ("-fieldsplit_u_pc_hypre_boomeramg_strong_threshold", "0.25"),
            ],
        }
    }
}
