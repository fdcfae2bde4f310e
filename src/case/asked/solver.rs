//! `[solver]`

use toml::Value;

use crate::case::keys::{AUTO, BOOLEAN, FromValue, Section, ValueForm, declare, either, key, number, table, within, word, words};
use crate::system::{SolverChoice, Tolerance};

declare! {
    static SOLVER = table("solver");
    /// `"fieldsplit"`: GMRES with multigrid (BiCGStab above half a million unknowns); where there is one small level only, as
    /// with P1 and `refine = 0`, with a Cholesky factor. `"direct"`: MUMPS on the plain system. `"auto"`: fieldsplit; without
    /// levels (`refine = 0`) and up to 3000 unknowns with a Cholesky factor of K + BᵀDB in the place of multigrid. The run says
    /// which, and why.
    const NAME: SolverChoice = key("name", word()).or("\"auto\"");
    /// Relative residual; see [method.md](method.md). `"discretisation"`: until the algebraic error is a tenth of the
    /// discretisation error, in λ too.
    const TOLERANCE: Tolerance = key("tolerance", either(TOLERANCES, "a number like 1e-8, or \"discretisation\"")).or("1e-8");
    /// Whether the inf-sup constants are computed (a factorisation); `"auto"`: up to 10 000 unknowns, and up to 200 000 after a
    /// solve that failed or whose active set was found by rising energy.
    const INF_SUP: Option<bool> = key("inf_sup", either(&[AUTO, BOOLEAN.value], "\"auto\", true or false")).or("\"auto\"");
}

const TOLERANCES: &[ValueForm] = &[
    ValueForm::Word(&["discretisation"]),
    number(within(1e-16, 1e-2).or_words("must lie in [1e-16, 0.01]; 1e-8 is the default")).value,
];

/// How the linear systems are solved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solver {
    /// Which solver.
    pub choice: SolverChoice,
    /// Relative residual of the scaled augmented system, in [1e-16, 0.01], or by the discretisation error.
    pub tolerance: Tolerance,
    /// Whether the inf-sup constants are reported; by default where that is cheap.
    pub inf_sup: Option<bool>,
}

impl Solver {
    /// Whether the discretisation error says how far it solves.
    pub fn goes_by_estimate(&self) -> bool {
        self.tolerance == Tolerance::Discretisation
    }
}

words! { SolverChoice: "auto" => Auto, "fieldsplit" => FieldSplit, "direct" => Direct }

impl FromValue for Tolerance {
    fn from_value(value: &Value, form: &ValueForm) -> Result<Self, String> {
        if value.is_str() { Ok(Self::Discretisation) } else { f64::from_value(value, form).map(Self::Residual) }
    }
}

/// `[solver]`
pub fn read_solver(root: &Section) -> Solver {
    let section = root.table("solver");
    let (choice, tolerance) = (section.or_default(NAME), section.or_default(TOLERANCE));
    Solver { choice, tolerance, inf_sup: section.or_default(INF_SUP) }
}
