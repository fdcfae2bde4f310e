//! Linear solvers of the saddle point.
//!
//! `fieldsplit`: GMRES, preconditioned from the right by the block upper triangle of `K + BᵀDB` and `S = -D⁻¹`; one
//! geometric multigrid F-cycle stands for the inverse of the first, or BoomerAMG where the mesh has no levels (for P2
//! below one smoothing step, on the P1 space of the same triangles).
//! `direct`: MUMPS on the plain system. All settings are PETSc options, which a user's own override.

use super::{Contact, Discretisation, Form, SaddlePoint, SchurPattern, SolverChoice, SystemError, interpolation};
use crate::petsc::{Krylov, Level, Matrix, Session, Vector, options};

/// Iterations after which a solve has failed.
const MOST_ITERATIONS: usize = 300;

/// Unknowns up to which the coarsest level is factorised on every rank.
const SMALL: usize = 3000;

/// Accuracy and length of the solve that shows the inf-sup constant.
const INF_SUP_TOLERANCE: f64 = 1e-5;
const INF_SUP_ITERATIONS: usize = 40;

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
    /// Sets a solver up. **Collective**
    pub fn new(
        problem: &Discretisation,
        system: &SaddlePoint,
        choice: SolverChoice,
        session: &Session,
    ) -> Result<Self, SystemError> {
        match choice.form() {
            Form::Augmented => {
                let steps = problem.spaces.windows(2).map(|pair| interpolation(&problem.scene, &pair[1], &pair[0], session));
                Self::field_split(system, &steps.collect::<Result<Vec<_>, _>>()?, session)
            }
            Form::Plain => Self::direct(system, session),
        }
    }

    /// `interpolations[l]` leads from level `l` to level `l + 1`.
    fn field_split(system: &SaddlePoint, interpolations: &[Matrix], session: &Session) -> Result<Self, SystemError> {
        let multigrid = !interpolations.is_empty();
        let coarse = CoarseSolver::of(system.stiffness[0].size().0, system.stiffness.len(), session.size());
        let lambda = lambda_options(system.multipliers.pattern, session.size());
        for (name, value) in FIELD_SPLIT.iter().chain(lambda).chain(coarse.options(multigrid)) {
            options::set_default(session, name, value)?;
        }
        let krylov = Krylov::new(session, "")?;
        krylov.keep_eigenvalues()?;
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
        let name = format!("fieldsplit ({})", coarse.words(multigrid));
        Ok(Self { krylov, session: session.clone(), form: Form::Augmented, converted: None, name })
    }

    fn direct(system: &SaddlePoint, session: &Session) -> Result<Self, SystemError> {
        for (name, value) in [
            ("-ksp_type", "gmres"),
            ("-ksp_pc_side", "right"),
            ("-ksp_norm_type", "unpreconditioned"),
            ("-pc_type", "cholesky"),
            ("-pc_factor_mat_solver_type", "mumps"),
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
                let ending = if residual <= floor {
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

    /// Discrete inf-sup constant of one contact, `β² = g / (α (1 - g))` with `g` the smallest eigenvalue of
    /// `D (B K_γ⁻¹ Bᵀ)` over the active multipliers: the preconditioned system has no other eigenvalues but 1, so the
    /// Ritz values of one solve with an erratic right-hand side on the contact's own multipliers show it. Nothing for
    /// the direct solver, and beside a jump term, which makes up for a small one. **Collective**
    pub fn inf_sup(&self, system: &SaddlePoint, contact: &Contact, active: &[bool]) -> Result<Option<f64>, SystemError> {
        let own = contact.range();
        if self.form == Form::Plain || !contact.jumps.is_empty() || !own.clone().any(|i| active[i]) {
            return Ok(None);
        }
        let (mut x, mut b) = system.nest.create_vectors()?;
        let unknowns = b.local_len() - system.multipliers.own.len();
        for (at, &i) in system.multipliers.own.iter().enumerate().filter(|(_, i)| own.contains(i) && active[**i]) {
            // A fixed erratic sequence, the same for every number of ranks.
            b.values_mut()[unknowns + at] = (12.9898 * (i + 1) as f64).sin().mul_add(43758.5453, 0.5).rem_euclid(1.0) - 0.5;
        }
        self.krylov.set_initial_guess_nonzero(false)?;
        self.krylov.set_tolerance(INF_SUP_TOLERANCE, INF_SUP_ITERATIONS)?;
        let solved = self.krylov.solve_allowing(&b, &mut x)?;
        let ritz = self.krylov.eigenvalues(solved.iterations)?;
        Ok(ritz.first().map(|g| {
            let g = g.clamp(0.0, 1.0 - 1e-12);
            (g / (contact.multipliers.alpha * (1.0 - g))).sqrt()
        }))
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
            (_, 2, _) => Self::Algebraic,
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
