//! `--set KEY=VALUE`.

use std::path::Path;

use toml::{Table, Value};

use super::error::{CaseError, Problem, dotted};
use super::section::Log;

/// The table of a TOML text after its overrides, and a log that knows these; `file` gives errors their name.
///
/// # Errors
/// [`CaseError`] if the text is no TOML. What is wrong with an override is in the log.
pub fn overridden(text: &str, file: &Path, overrides: &[String]) -> Result<(Table, Log), CaseError> {
    let mut table: Table = toml::from_str(text).map_err(|error| CaseError::of_syntax(file, text, &error))?;
    let mut log = Log::default();
    for text in overrides {
        match apply_override(&mut table, text) {
            Ok(path) => log.overridden.push(path),
            Err(problem) => log.problems.push(problem),
        }
    }
    Ok((table, log))
}

/// Does one override and returns the path of its key. VALUE is read as TOML, and as a string if that fails.
///
/// # Errors
/// A [`Problem`] if the text is not `KEY=VALUE`, or if a table is wanted where a value stands.
fn apply_override(table: &mut Table, text: &str) -> Result<Vec<String>, Problem> {
    let problem = |key: String, words: &str| Problem { key, value: None, words: words.into() };
    let wanted = "must be KEY=VALUE, as in --set body.upper.young=7e6";
    let (key, value) = text.split_once('=').ok_or_else(|| problem(format!("--set {text}"), wanted))?;
    let path = read_key(key).ok_or_else(|| problem(format!("--set {text}"), wanted))?;
    let value = value.trim();
    let value = value.parse::<Value>().unwrap_or_else(|_| Value::from(value));
    set_value(table, &path, value).map_err(|above| {
        let words = format!("{above} is a value, not a table; set {above} itself, or another key");
        problem(format!("--set {}", dotted(&path)), &words)
    })?;
    Ok(path)
}

/// Sets the value at a path; tables that are missing are created. In a list of tables a number is a place, from 1.
///
/// # Errors
/// The dotted key of a value that stands where a table is wanted.
pub fn set_value(table: &mut Table, path: &[String], value: Value) -> Result<(), String> {
    let (last, above) = path.split_last().expect("a key has at least one name");
    let mut inner = table;
    let mut depth = 0;
    while let Some(name) = above.get(depth) {
        depth += 1;
        let next = inner.entry(name.clone()).or_insert_with(|| Value::Table(Table::new()));
        let refused = || dotted(&above[..depth]);
        inner = match (next, above.get(depth)) {
            (Value::Array(list), Some(place)) => {
                let index = place.parse::<usize>().ok().and_then(|place| place.checked_sub(1));
                let entry = index.and_then(|index| list.get_mut(index)).and_then(Value::as_table_mut).ok_or_else(refused)?;
                depth += 1;
                entry
            }
            (next, _) => next.as_table_mut().ok_or_else(refused)?,
        };
    }
    inner.insert(last.clone(), value);
    Ok(())
}

/// Names of a dotted key, read by TOML's own rules.
pub fn read_key(key: &str) -> Option<Vec<String>> {
    let mut table: Table = toml::from_str(&format!("{} = 0", key.trim())).ok()?;
    let mut path = Vec::new();
    loop {
        let name = table.keys().next()?.clone();
        let value = table.remove(&name)?;
        path.push(name);
        match value {
            Value::Integer(0) if table.is_empty() => return Some(path),
            Value::Table(inner) if table.is_empty() => table = inner,
            _ => return None,
        }
    }
}
