//! What a page is made of.

use crate::output::Summary;

/// What a report tells of, beside the figures in the folder of the result.
#[derive(Clone, Copy, Debug)]
pub struct ReportPage<'a> {
    /// Title of the case; may be empty.
    pub title: &'a str,
    /// All numbers.
    pub summary: &'a Summary,
    /// The values that the case expects.
    pub expected: &'a [ExpectedValue],
    /// Names of contacts, each with those of both bodies.
    pub contacts: &'a [(String, [String; 2])],
    /// What was warned of.
    pub warnings: &'a [String],
    /// The case as it ran.
    pub case: &'a str,
}

/// A value that a case expects.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ExpectedValue {
    /// Of what.
    pub name: String,
    /// What is expected, in words or as a number.
    pub expected: String,
    /// The same as found; empty where it is no single number.
    pub found: String,
    /// The relative error; None if it is not known.
    pub error: Option<f64>,
    /// The largest error that is allowed; None if any is.
    pub tolerance: Option<f64>,
}
