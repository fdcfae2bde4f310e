//! `--set KEY=VALUE`.

use std::path::Path;

use toml::{Table, Value};

use super::error::{CaseError, Log, Problem, told};
use crate::geometry::Quote;

/// A key at the root of a file, and a key below it: a number under the first stands for a table with it under the second.
pub type ShortForm = (&'static str, &'static str);

/// The table of a TOML text after its overrides, and a log that knows these; `file` gives errors their name.
///
/// # Errors
/// [`CaseError`] if the text is no TOML. What is wrong with an override is in the log.
pub fn overridden(text: &str, file: &Path, overrides: &[String], short: &[ShortForm]) -> Result<(Table, Log), CaseError> {
    let mut table: Table = toml::from_str(text).map_err(|error| {
        let here = error.span().map_or("", |span| text[span.start..].trim_start_matches('['));
        let clash = ["duplicate", "cannot extend"].iter().any(|word| error.message().contains(word));
        let twice = short.iter().filter(|(root, _)| clash && here.starts_with(root));
        let remedy = twice.map(|(root, key)| format!("; a number under {root} is short for [{root}] {key}: give one of the two"));
        CaseError::of_syntax(file, text, &error, &remedy.collect::<String>())
    })?;
    let mut log = Log::default();
    for text in overrides {
        match apply_override(&mut table, text, short) {
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
fn apply_override(table: &mut Table, text: &str, short: &[ShortForm]) -> Result<Vec<String>, Problem> {
    let problem = |key: String, words: &str| Problem { key, value: None, words: words.into() };
    let wanted = "must be KEY=VALUE, as in --set body.upper.young=7e6";
    let (key, value) = text.split_once('=').ok_or_else(|| problem(format!("--set {}", Quote(text)), wanted))?;
    let path = read_key(key).ok_or_else(|| problem(format!("--set {}", Quote(text)), wanted))?;
    let value = value.trim();
    let value = value.parse::<Value>().unwrap_or_else(|_| Value::from(value));
    if path.len() > 1 {
        short.iter().filter(|(root, _)| path[0] == *root).for_each(|form| write_out(table, form));
    }
    set_value(table, &path, value).map_err(|above| {
        let words = format!("{above} is a value, not a table; set {above} itself, or another key");
        problem(format!("--set {}", told(&path)), &words)
    })?;
    Ok(path)
}

/// Makes the table of a number that is short for it.
fn write_out(table: &mut Table, (root, key): &ShortForm) {
    if let Some(value) = table.get_mut(*root).filter(|value| value.is_integer() || value.is_float()) {
        *value = Value::Table(Table::from_iter([((*key).to_owned(), value.clone())]));
    }
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
        let refused = || told(&above[..depth]);
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

/// The value at a path, if there is one.
pub fn value_at<'t>(table: &'t Table, path: &[String]) -> Option<&'t Value> {
    let (first, rest) = path.split_first()?;
    rest.iter().try_fold(table.get(first)?, |value, name| value.get(name))
}

/// Names of a dotted key, read by TOML's own rules, but for patterns: `body.*.young` needs no quotes.
pub fn read_key(key: &str) -> Option<Vec<String>> {
    let key = key.trim();
    let quoted = |name: &str| if name.contains(['*', '?']) { format!("\"{name}\"") } else { name.to_owned() };
    let is_quoted = key.contains(['"', '\'']);
    let key = if is_quoted { key.to_owned() } else { key.split('.').map(quoted).collect::<Vec<_>>().join(".") };
    let mut table: Table = toml::from_str(&format!("{key} = 0")).ok()?;
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
