//! What a study is made of: its cases, and the runs of them.

use super::settings::StudyCurve;
use std::path::PathBuf;
use toml::Value;

/// One run of a study.
#[derive(Clone, Debug, PartialEq)]
pub struct PlannedRun {
    /// The case file.
    pub file: PathBuf,
    /// Name of the case in the table: that of its results, or its path in the study if another one is called the same.
    pub case: String,
    /// Title of the case.
    pub title: String,
    /// Name of the curve.
    pub curve: Option<String>,
    /// Number of ranks.
    pub ranks: usize,
    /// Which of the repeats this is, from 1.
    pub repeat: usize,
    /// Values of [`super::Plan::keys`]; None where the key does not move.
    pub values: Vec<Option<Value>>,
    /// `KEY=VALUE` of `[set]`, curve and grid.
    pub overrides: Vec<String>,
}

/// A case of the study.
pub struct PlannedCase {
    /// As it stands in `cases`.
    pub written: String,
    /// The case file.
    pub file: PathBuf,
    /// A name that no other has.
    pub label: String,
    /// Title of the case.
    pub title: String,
}

impl PlannedCase {
    /// The curves of this case; one that is none if the study has no curves.
    pub fn curves<'a>(&self, curves: &'a [StudyCurve]) -> Vec<Option<&'a StudyCurve>> {
        if curves.is_empty() {
            return vec![None];
        }
        let drawn = |curve: &&StudyCurve| curve.cases.as_ref().is_none_or(|cases| cases.contains(&self.written));
        curves.iter().filter(drawn).map(Some).collect()
    }
}
