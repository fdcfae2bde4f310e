//! The two bodies of a pair.

/// Which body of a pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The body that the normal leaves.
    First,
    /// The body that the normal enters.
    Second,
}

impl Side {
    /// Sign of its displacement in the penetration `B₁u₁ - B₂u₂`.
    pub fn sign(self) -> f64 {
        match self {
            Self::First => 1.0,
            Self::Second => -1.0,
        }
    }
}
