//! How the procedure ends, and why.

/// Way of the ends of a contact boundary, as a share of its length, beyond which it moves.
pub const MOVES: f64 = 1e-2;

/// How the procedure ended.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Ending {
    /// Everything stands still within its tolerance.
    #[error("{0}")]
    Converged(Standing),
    /// It does not, or a body is not held.
    #[error("{0}")]
    NotConverged(Failure),
}

impl Ending {
    /// Whether everything stands.
    pub fn is_converged(&self) -> bool {
        matches!(self, Self::Converged(_))
    }

    /// By what share of its length a contact boundary would still move that stands to what the mesh is exact for; zero if none would.
    pub fn would_move(&self) -> f64 {
        match self {
            Self::Converged(Standing::Boundary { way, .. }) => way.unwrap_or(0.0),
            _ => 0.0,
        }
    }

    /// How far the ends of a contact boundary, which stand because they are held, had moved last, as a share of its length;
    /// nothing if they came to rest.
    pub fn still_moved(&self) -> Option<f64> {
        match self {
            Self::Converged(Standing::Boundary { held: Some(held), .. }) => Some(held.way.unwrap_or(1.0)),
            _ => None,
        }
    }
}

/// What stands.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Standing {
    /// The residual is below its tolerance, and no multiplier may be released.
    #[error("the residual is below its tolerance")]
    Residual,
    /// The active set, and the residual is below its tolerance.
    #[error("the active set stands and the residual is below its tolerance")]
    ActiveSet,
    /// The active set, but rounding allows no residual as small as asked for.
    #[error("the residual stands at {residual:.1e}: rounding allows no less, tolerance {tolerance:.0e} is out of reach")]
    Rounding {
        /// The relative residual.
        residual: f64,
        /// What was asked for.
        tolerance: f64,
    },
    /// Not the active set, which goes round, but each set of the round that meets the contact conditions as well as they are
    /// asked for; and the residual is below its tolerance.
    #[error(
        "the active set goes round at {places}, but this set meets the contact conditions to {violation:.0e} of the largest pressure, and the residual is below its tolerance"
    )]
    Round {
        /// Where the sets differ, in words.
        places: String,
        /// Largest violation of the contact conditions, as a share of the largest pressure.
        violation: f64,
    },
    /// The contact boundary.
    #[error("{}; {within}", boundary_stands(*.fits, *.held, *.way))]
    Boundary {
        /// Boundaries that were solved for.
        fits: usize,
        /// Where its ends had to be held.
        held: Option<HeldEnds>,
        /// Where it stands to what the mesh is exact for: by how much it would still move, as a share of its length.
        way: Option<f64>,
        /// What stands on the last of them.
        within: Box<Standing>,
    },
}

/// Ends of a contact boundary that did not come to rest by themselves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeldEnds {
    /// Number of the boundary after which they were held.
    pub fit: usize,
    /// How far they had moved last, as a share of the length; nothing if the segments were others.
    pub way: Option<f64>,
    /// Whether they are held where they have reached farthest.
    pub farthest: bool,
}

/// Words for a contact boundary that stands.
fn boundary_stands(fits: usize, held: Option<HeldEnds>, way: Option<f64>) -> String {
    match (held, way) {
        (Some(HeldEnds { fit, way, farthest }), _) => {
            let last = way.map_or("an unknown part".into(), |way| format!("{way:.0e}"));
            let held = if farthest { "held where they reached farthest" } else { "held" };
            format!(
                "the ends of the contact boundary still moved by {last} of its length at fit {fit} and are {held}; it stands after {fits}"
            )
        }
        (None, Some(way)) => format!(
            "the contact boundary stands after {fits} fit{} to what the mesh is exact for: it would move by {way:.0e} of its length",
            if fits == 1 { "" } else { "s" }
        ),
        (None, None) if fits == 1 => "the contact boundary fits what touches".into(),
        (None, None) => format!("the contact boundary stands after {fits} fits, and so does the displacement"),
    }
}

/// What does not stand.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Failure {
    /// A body that supports and contact do not hold, with what would.
    #[error("{0}")]
    NotHeld(String),
    /// The linear solver.
    #[error("linear solver: {reason} after {iterations} iterations, residual {residual:.1e}")]
    LinearSolver {
        /// Why it gave up.
        reason: String,
        /// Krylov iterations.
        iterations: usize,
        /// The relative residual.
        residual: f64,
    },
    /// The contact conditions, at the place where they are violated most, with what helps.
    #[error("{0}")]
    ConditionsViolated(String),
    /// The active set, with the multipliers that changed last and what helps.
    #[error("{0}")]
    SetChanges(String),
    /// The contact boundary.
    #[error(
        "the contact boundary still moves after {fits} fits: by {} of its length, the displacement by {} of its norm, {} multipliers change; refine the mesh where contact is, or, without [accuracy], take another number of segments",
        figure(.moved), figure(.du), .flipped.map_or("all".to_string(), |count| count.to_string())
    )]
    BoundaryMoves {
        /// Boundaries that were solved for.
        fits: usize,
        /// Largest way of a segment end, relative to the length; nothing if the segments are others.
        moved: Option<f64>,
        /// Change of the displacement, relative to its norm.
        du: Option<f64>,
        /// Multipliers that changed.
        flipped: Option<usize>,
    },
    /// Bodies penetrate each other where the contact boundary has ended.
    #[error(
        "contact {contact}: the bodies penetrate each other by {depth:.1e} beyond the ends of the contact boundary; refine the mesh there, or, without [accuracy], take more segments"
    )]
    Beyond {
        /// Name of the contact.
        contact: String,
        /// How deep (length).
        depth: f64,
    },
    /// A boundary that can no longer be placed.
    #[error("{0}")]
    BoundaryLost(String),
}

fn figure(value: &Option<f64>) -> String {
    value.map_or("an unknown part".to_string(), |value| format!("{value:.1e}"))
}
