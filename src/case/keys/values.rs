//! Single values. Each reader gives a checked value, or words that say what it must be.

use toml::{Table, Value};

use crate::geometry::Quote;

/// A string.
pub fn text(value: &Value) -> Result<String, String> {
    value.as_str().map(str::to_owned).ok_or_else(|| must_be("a string in quotes", value))
}

/// A string that says something.
pub fn name(value: &Value) -> Result<String, String> {
    text(value).and_then(|text| if text.trim().is_empty() { Err("must not be empty".into()) } else { Ok(text) })
}

/// A string that says something, in so many letters at most.
pub fn short(value: &Value, most: usize) -> Result<String, String> {
    let name = name(value)?;
    let count = name.chars().count();
    if count <= most { Ok(name) } else { Err(format!("must have at most {most} letters, not {count}")) }
}

/// One name or a list of names, each once.
pub fn names(value: &Value) -> Result<Vec<String>, String> {
    let names = match value {
        Value::Array(list) => list.iter().map(name).collect::<Result<Vec<_>, _>>()?,
        single => vec![name(single).map_err(|_| must_be("a physical curve, or a list of them", single))?],
    };
    if names.is_empty() {
        return Err("must list at least one physical curve".into());
    }
    match names.iter().enumerate().find(|(index, name)| names[..*index].contains(name)) {
        Some((_, twice)) => Err(format!("lists \"{}\" twice; list each physical curve once", Quote(twice))),
        None => Ok(names),
    }
}

/// `true` or `false`.
pub fn boolean(value: &Value) -> Result<bool, String> {
    value.as_bool().ok_or_else(|| must_be("true or false", value))
}

/// A finite number.
pub fn number(value: &Value) -> Result<f64, String> {
    let number = value.as_float().or(value.as_integer().map(|integer| integer as f64));
    number.filter(|number| number.is_finite()).ok_or_else(|| must_be("a finite number", value))
}

/// A whole number that is not negative.
pub fn whole(value: &Value) -> Result<usize, String> {
    let number = value.as_integer().and_then(|number| usize::try_from(number).ok());
    number.ok_or_else(|| must_be("a whole number", value))
}

/// A table.
pub fn table(value: &Value) -> Result<Table, String> {
    value.as_table().cloned().ok_or_else(|| must_be("a table", value))
}

/// `must be WANTED, not an integer`
pub fn must_be(wanted: &str, found: &Value) -> String {
    match found {
        Value::Float(number) if !number.is_finite() => format!("must be {wanted}"),
        Value::Array(list) => format!("must be {wanted}, not a list of length {}", list.len()),
        found => format!("must be {wanted}, not of type {}", found.type_str()),
    }
}

/// The entries of a list, or a single value that is no list.
pub fn one_or_each<T>(value: &Value, read: impl Fn(&Value) -> Result<T, String>) -> Result<Vec<T>, String> {
    let Value::Array(list) = value else { return Ok(vec![read(value)?]) };
    let numbered = |(index, entry)| read(entry).map_err(|words| format!("entry {}: {words}", index + 1));
    list.iter().enumerate().map(numbered).collect()
}

/// A list of at least one value, each once.
pub fn list(wanted: &str, value: &Value) -> Result<Vec<Value>, String> {
    let list = value.as_array().ok_or_else(|| must_be(wanted, value))?;
    match twice(list) {
        _ if list.is_empty() => Err(format!("must not be empty: give {wanted}")),
        Some(number) => Err(told_twice(number)),
        None => Ok(list.clone()),
    }
}

/// The number, from 1, of the first entry that is the same as one before.
pub fn twice(list: &[Value]) -> Option<usize> {
    (0..list.len()).find(|&k| list[..k].iter().any(|other| alike(other, &list[k]))).map(|k| k + 1)
}

/// Words for an entry that stands in a list twice.
pub fn told_twice(number: usize) -> String {
    format!("entry {number} stands there twice; list each once")
}

/// Whether two values are the same; 1 and 1.0 are.
fn alike(a: &Value, b: &Value) -> bool {
    match (a, b) {
        (Value::Integer(a), Value::Float(b)) | (Value::Float(b), Value::Integer(a)) => *a as f64 == *b,
        (Value::Array(a), Value::Array(b)) => a.len() == b.len() && a.iter().zip(b).all(|(a, b)| alike(a, b)),
        (Value::Table(a), Value::Table(b)) => {
            a.len() == b.len() && a.iter().all(|(key, a)| b.get(key).is_some_and(|b| alike(a, b)))
        }
        _ => a == b,
    }
}
