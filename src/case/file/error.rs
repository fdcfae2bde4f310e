//! What is wrong with a case or a study, in words, and what else is found while it is read.

use std::collections::HashMap;
use std::fmt::{self, Display, Formatter};
use std::path::{Path, PathBuf};

use toml::Value;

use crate::geometry::Quote;

/// Longest value that is quoted in full.
const LONGEST_VALUE: usize = 60;
/// Longest words of the reader of TOML that are told: they have names of the file in them.
const LONGEST_MESSAGE: usize = 200;
/// Problems that are told one by one.
const MOST_PROBLEMS: usize = 40;
/// Names that are listed where none is near.
const MOST_NAMES: usize = 20;
/// How the words begin for a key that does not exist.
const UNKNOWN: &str = "unknown key";

/// Everything that is wrong with a case file or a study file, one line each.
#[derive(Clone, Debug, thiserror::Error)]
pub struct CaseError {
    /// The file.
    pub file: PathBuf,
    /// At least one, in the order found.
    pub problems: Vec<Problem>,
}

/// One thing that is wrong with a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// Dotted key; empty if the whole file is meant.
    pub key: String,
    /// Value found there, as TOML, and ` (--set)` if it comes from the command line.
    pub value: Option<String>,
    /// What is wrong and what to do about it.
    pub words: String,
}

impl CaseError {
    /// An error of the file as a whole.
    pub(crate) fn of_file(file: &Path, words: String) -> Self {
        Self { file: file.into(), problems: vec![Problem { key: String::new(), value: None, words }] }
    }

    /// An error of TOML itself, with a remedy if one is known.
    pub(crate) fn of_syntax(file: &Path, text: &str, error: &toml::de::Error, remedy: &str) -> Self {
        let (before, behind) = text.split_at(error.span().map_or(0, |span| span.start));
        let line = before.matches('\n').count() + 1;
        let column = before.chars().rev().take_while(|c| *c != '\n').count() + 1;
        let message = decimal_comma(before, behind).unwrap_or_else(|| plain_syntax(error.message()));
        Self::of_file(file, format!("line {line}, column {column}: {message}{remedy}; the file is written in TOML, see toml.io"))
    }
}

impl Problem {
    /// A key that does not exist.
    pub(crate) fn unknown(key: String, remedy: &str) -> Self {
        Self { key, value: None, words: format!("{UNKNOWN}; {remedy}") }
    }

    /// Whether the key does not exist.
    pub(crate) fn is_unknown(&self) -> bool {
        self.words.starts_with(UNKNOWN)
    }
}

impl Display for CaseError {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        for (index, problem) in self.problems.iter().take(MOST_PROBLEMS).enumerate() {
            let separator = if index == 0 { "" } else { "\n" };
            write!(f, "{separator}{}: {problem}", self.file.display())?;
        }
        match self.problems.len().saturating_sub(MOST_PROBLEMS) {
            0 => Ok(()),
            more => write!(f, "\n{}: {more} more of them; correct these first", self.file.display()),
        }
    }
}

impl Display for Problem {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        match (&self.key[..], &self.value) {
            ("", _) => write!(f, "{}", self.words),
            (key, None) => write!(f, "{key}: {}", self.words),
            (key, Some(value)) => write!(f, "{key} = {value}: {}", self.words),
        }
    }
}

/// Words for a number with a comma in the place of its dot, if the text breaks off at one.
pub(crate) fn decimal_comma(before: &str, behind: &str) -> Option<String> {
    let digits = |text: &str| text.chars().take_while(char::is_ascii_digit).count();
    let whole = before.len() - before.trim_end_matches(|c: char| c.is_ascii_digit()).len();
    let decimals = digits(behind.strip_prefix(',')?);
    let exponent = behind[1 + decimals..].strip_prefix(['e', 'E']).map_or(0, |power| {
        let sign = usize::from(power.starts_with(['+', '-']));
        Some(digits(&power[sign..])).filter(|digits| *digits > 0).map_or(0, |digits| 1 + sign + digits)
    });
    let number = format!("{}.{}", &before[before.len() - whole..], &behind[1..1 + decimals + exponent]);
    (whole > 0 && decimals > 0).then(|| format!("a number has a dot, not a comma; write {number}"))
}

/// What the reader of TOML says, in words for those who have written the file.
fn plain_syntax(message: &str) -> String {
    if message.contains("as i128") || message.contains("number too large") {
        return "a whole number has more than 18 digits; write it with a dot or an exponent, as 1e20".into();
    }
    if message.contains("invalid mantissa") || message.contains("invalid fraction") {
        return "a number has digits before and behind its dot; write 0.5 and 2.0".into();
    }
    message.replace('\n', ", ").chars().filter(|letter| !letter.is_control()).take(LONGEST_MESSAGE).collect()
}

/// Dotted key for people: names on one line, cut if they are long.
pub(crate) fn told(path: &[impl AsRef<str>]) -> String {
    let short = |name: &str| if name.chars().any(char::is_control) { format!("\"{}\"", Quote(name)) } else { cut(name) };
    path.iter().map(|name| short(name.as_ref())).collect::<Vec<_>>().join(".")
}

/// A name as [`dotted`] has it, but for what is too long.
fn cut(name: &str) -> String {
    let head = Quote(name).head();
    let whole = dotted(&[head.to_owned()]);
    if head.len() < name.len() { format!("{whole}...") } else { whole }
}

/// Dotted key as TOML wants it: names with dots in quotes.
pub(crate) fn dotted(path: &[String]) -> String {
    let bare = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
    let quote = |name: &String| match !name.is_empty() && name.chars().all(bare) {
        true => name.clone(),
        false => Value::from(name.as_str()).to_string(),
    };
    path.iter().map(quote).collect::<Vec<_>>().join(".")
}

/// A value as TOML on one line, cut if long.
pub(crate) fn quoted(value: &Value) -> String {
    let text = match value {
        Value::Float(number) => format!("{number:?}").to_lowercase(),
        Value::String(text) if text.len() > LONGEST_VALUE => format!("\"{}\"", Quote(text)),
        value => value.to_string().split_whitespace().collect::<Vec<_>>().join(" "),
    };
    match text.char_indices().nth(LONGEST_VALUE) {
        None => text,
        Some((end, _)) => format!("{} ...", &text[..end]),
    }
}

/// `did you mean "young"?` for the nearest of some names, or the list of them.
pub(crate) fn suggest<'a>(found: &str, names: impl Iterator<Item = &'a str>) -> String {
    let names: Vec<&str> = names.collect();
    did_you_mean(found, &names).unwrap_or_else(|| match names.is_empty() {
        true => "there are none".into(),
        false => format!("there are {}", listed(names.iter().map(|name| Quote(name).to_string()))),
    })
}

/// `did you mean "young"?` for the nearest of some names, if one is near.
pub(crate) fn did_you_mean(found: &str, names: &[&str]) -> Option<String> {
    let lower = |name: &str| Quote(name).head().to_lowercase();
    let distance = |name: &str| strsim::damerau_levenshtein(&lower(found), &lower(name));
    let nearest = names.iter().min_by_key(|name| distance(name));
    let near = nearest.filter(|name| distance(name) <= 1.max(lower(found).len().max(lower(name).len()) / 3));
    near.map(|name| format!("did you mean \"{}\"?", Quote(name)))
}

/// Names one after the other; of many the first.
pub(crate) fn listed(names: impl Iterator<Item = String>) -> String {
    let all: Vec<String> = names.collect();
    match all.len().saturating_sub(MOST_NAMES) {
        0 => all.join(", "),
        more => format!("{} and {more} more", all[..MOST_NAMES].join(", ")),
    }
}

/// What was found while reading a file.
#[derive(Default)]
pub struct Log {
    /// Everything that is wrong.
    pub problems: Vec<Problem>,
    /// Defaults that were used: path and value.
    pub defaults: Vec<(Vec<String>, Value)>,
    /// Paths that the command line has set.
    pub overridden: Vec<Vec<String>>,
    /// Paths of tables that patterns of the file have made, and where these are written.
    pub written: HashMap<Vec<String>, Vec<String>>,
}

impl Log {
    /// A path as the file has it: what is wrong with a table that stands for many is told once.
    pub fn as_written(&self, path: Vec<String>) -> Vec<String> {
        let made = (1..=path.len()).find_map(|end| Some((end, self.written.get(&path[..end])?)));
        made.map_or_else(|| path.clone(), |(end, written)| [written.as_slice(), &path[end..]].concat())
    }

    /// Adds a problem, once if a pattern has made tables of many.
    pub fn add(&mut self, problem: Problem) {
        if self.written.is_empty() || !self.problems.contains(&problem) {
            self.problems.push(problem);
        }
    }
}

#[cfg(test)]
mod tests;
