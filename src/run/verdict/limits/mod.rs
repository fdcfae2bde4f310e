//! How far each figure of a result may go: the one place of these numbers, of where they come from, and of what is said beyond
//! them.
//!
//! In comes a value of `summary.json`, out comes a [`Doubt`] in words, or nothing. `table.rs` has a row for each figure, and the
//! bare numbers beside them. docs/method.md, docs/limits.md and docs/hard-cases.md show them to users: a test compares both.

#[rustfmt::skip]
mod table;

pub use table::*;

/// A value that passes its limit by less than this share of it does so by rounding: a zone of just four edges has 3.999999999999 of them.
const ROUNDING: f64 = 1e-9;

/// What helps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Remedy {
    /// These words, on every mesh.
    Words(&'static str),
    /// A finer mesh where contact is.
    Finer,
    /// Shorter segments.
    MoreSegments,
    /// A space of pressures that the displacements control.
    Stability,
}

/// How far a figure may go.
#[derive(Debug)]
pub struct Limit {
    /// The largest value that is not doubted, or the smallest.
    pub value: f64,
    is_least: bool,
    digits: fn(f64) -> String,
    /// What helps.
    pub remedy: Remedy,
    /// What is wrong, without figures: contacts are counted by it.
    pub cause: &'static str,
    /// What is wrong, with `{value}`, `{limit}` or `{bound}`, and in braces what else [`Limit::doubt`] is given.
    words: &'static str,
}

/// A figure that speaks against a pressure.
#[derive(Clone, Debug)]
pub struct Doubt {
    /// The limit that is passed, with the cause and what helps.
    pub limit: &'static Limit,
    /// The cause with its figure and the limit of that.
    pub figure: String,
}

type LimitRow = (f64, fn(f64) -> String, Remedy, &'static str, &'static str);

const fn most((value, digits, remedy, cause, words): LimitRow) -> Limit {
    Limit { value, is_least: false, digits, remedy, cause, words }
}

const fn least(row: LimitRow) -> Limit {
    Limit { is_least: true, ..most(row) }
}

impl Limit {
    /// A doubt if the value is known and passes the limit; `named` are further words of the sentence.
    pub fn judge(&'static self, value: Option<f64>, named: &[(&str, &str)]) -> Option<Doubt> {
        let is_passed = |value: &f64| match self.is_least {
            true => *value < self.value * (1.0 - ROUNDING),
            false => *value > self.value * (1.0 + ROUNDING),
        };
        value.filter(is_passed).map(|value| self.doubt(value, named))
    }

    /// A doubt, whatever the value is.
    pub fn doubt(&'static self, value: f64, named: &[(&str, &str)]) -> Doubt {
        let word = |name: &str| match (named.iter().find(|(known, _)| *known == name), name) {
            (Some((_, word)), _) => (*word).into(),
            // A value that passes its limit by less than its digits tell has more of them.
            (None, "value") if [(self.digits)(self.value), self.value.to_string()].contains(&(self.digits)(value)) => {
                format!("{value:.4}")
            }
            (None, "value") => (self.digits)(value),
            (None, "limit") => self.value.to_string(),
            // In the digits of the value, where both may be near each other.
            (None, "bound") => (self.digits)(self.value),
            _ => String::new(),
        };
        // Names come from files and may hold braces: only those of the sentence are looked for.
        let parts = self.words.split(['{', '}']).enumerate();
        Doubt { limit: self, figure: parts.map(|(at, part)| if at % 2 == 0 { part.into() } else { word(part) }).collect() }
    }
}

#[cfg(test)]
mod tests;
