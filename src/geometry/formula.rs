//! Formulas of named variables.

/// A formula of named variables.
#[derive(Clone, Debug, PartialEq)]
pub struct Formula {
    text: String,
}

/// Why a formula cannot be read.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{0}")]
pub struct FormulaError(pub String);

impl Formula {
    /// Reads a formula.
    pub fn parse(text: &str, _variables: &[&str]) -> Result<Self, FormulaError> {
        Ok(Self { text: text.into() })
    }
    /// The formula that is the same everywhere.
    pub fn constant(value: f64) -> Self {
        Self { text: value.to_string() }
    }
    /// Its value, if no variable occurs in it.
    pub fn as_constant(&self) -> Option<f64> {
        None
    }
    /// Value at the given variables, in the order of `parse`.
    pub fn value(&self, _at: &[f64]) -> f64 {
        0.0
    }
    /// Exact partial derivative by variable number `variable`.
    pub fn derivative(&self, _variable: usize, _at: &[f64]) -> f64 {
        0.0
    }
    /// As it was written.
    pub fn text(&self) -> &str {
        &self.text
    }
}
