//! What a run's words are worth beside the truth, and the table of many.

use crate::profile::Apart;
use crate::run::Said;

/// What a run is, beside the truth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Right, and says so.
    Right,
    /// Wrong or impossible, and says so.
    Alarm,
    /// Right, but says otherwise, or refuses.
    FalseAlarm,
    /// Wrong by more than 5 %, without a word.
    Quiet,
    /// Wrong by more than 10 %, without a word.
    Loud,
}

/// One line of the table.
pub struct Row {
    pub seed: u64,
    pub kind: Kind,
    pub apart: Option<Apart>,
    pub said: Said,
    pub words: String,
}

/// Whether a run gives no reason to doubt its pressure. A warning that segments are short is none: the case asked for them.
pub fn is_quiet(said: &Said) -> bool {
    let doubts = said.warnings.iter().filter(|words| !words.contains("or more are safe"));
    said.code == Some(0) && said.trust != Some(false) && doubts.count() == 0
}

/// What a run is worth; `apart` is missing where the scene has no answer, which it must say.
pub fn judge(said: &Said, apart: Option<&Apart>) -> Kind {
    let error = apart.map_or(f64::INFINITY, |apart| apart.lambda().max(apart.force));
    match (is_quiet(said), error) {
        (true, error) if error <= 0.05 => Kind::Right,
        (true, error) if error <= 0.1 => Kind::Quiet,
        (true, _) => Kind::Loud,
        (false, error) if error <= 0.05 => Kind::FalseAlarm,
        (false, _) => Kind::Alarm,
    }
}

impl Row {
    /// The line.
    pub fn line(&self) -> String {
        let number = |value: Option<f64>| value.map_or("-".to_string(), |value| format!("{value:.1e}"));
        let of = |pick: fn(&Apart) -> f64| number(self.apart.as_ref().map(pick));
        format!(
            "{:6} {:10} exit {} trust {:5} λ {:7} peak {:7} part {:7} force {:7} ends {:7} estimate {:7} {:7} {} | {}",
            self.seed,
            format!("{:?}", self.kind),
            self.said.code.map_or("-".to_string(), |code| code.to_string()),
            self.said.trust.map_or("null".to_string(), |trust| trust.to_string()),
            of(|apart| apart.mean),
            of(|apart| apart.peak),
            of(|apart| apart.part),
            of(|apart| apart.force),
            of(|apart| apart.ends),
            number(self.said.estimate[0]),
            number(self.said.estimate[1]),
            self.words,
            if is_quiet(&self.said) { "" } else { self.said.reason.trim() },
        )
    }
}
