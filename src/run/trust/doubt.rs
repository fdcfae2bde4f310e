//! A figure that speaks against a pressure.

/// The figure in words, and what mends it.
pub struct Doubt {
    /// What is wrong, with its limit.
    pub figure: String,
    /// What to do about it.
    pub remedy: &'static str,
}
