//! A figure that speaks against a pressure.

/// The figure in words, and what mends it.
#[derive(Clone, Debug)]
pub struct Doubt {
    /// What is wrong, without figures: contacts are counted by it.
    pub cause: &'static str,
    /// The same with its figure and the limit of that.
    pub figure: String,
    /// What to do about it.
    pub remedy: &'static str,
}
