//! Single values: each reader of a kind gives a checked value, or words that say what it must be; and values that have the form of their
//! key, as the types that readers of sections work with.

use super::declaring::Choice;
use super::form::ValueForm;
use crate::geometry::{Formula, Quote};
use toml::{Table, Value};

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
    // What is a number but for its quotes, its comma, or a digit that its dot lacks.
    let meant =
        value.as_str().and_then(|text| text.trim().replace(',', ".").parse().ok()).filter(|number: &f64| number.is_finite());
    let refusal =
        || meant.map_or_else(|| must_be("a finite number", value), |meant| format!("must be a finite number; write {meant:?}"));
    number.filter(|number| number.is_finite()).ok_or_else(refusal)
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
        Value::Array(list) => {
            let commas = list.len() > 2 && list.iter().all(Value::is_integer);
            let dots = if commas { "; a number has a dot, not a comma" } else { "" };
            format!("must be {wanted}, not a list of length {}{dots}", list.len())
        }
        Value::String(text) if text.is_empty() => format!("must be {wanted}, and is empty"),
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

/// A type that values of a file are read as.
pub trait FromValue: Sized {
    /// Reads a value that has a form.
    ///
    /// # Errors
    /// Words for what the form does not tell, as of a formula without a finite value.
    fn from_value(value: &Value, form: &ValueForm) -> Result<Self, String>;
}

impl<T: Choice> FromValue for T {
    fn from_value(value: &Value, _: &ValueForm) -> Result<Self, String> {
        let place = T::WORDS.iter().position(|word| value.as_str() == Some(word));
        let meaning = place.and_then(|place| T::MEANINGS.get(place));
        meaning.copied().ok_or_else(|| must_be("a word that has a meaning here", value))
    }
}

/// The word `"auto"` is none.
impl<T: FromValue> FromValue for Option<T> {
    fn from_value(value: &Value, form: &ValueForm) -> Result<Self, String> {
        if value.is_str() { Ok(None) } else { T::from_value(value, form).map(Some) }
    }
}

/// A value that is no list is the only entry of one.
impl<T: FromValue> FromValue for Vec<T> {
    fn from_value(value: &Value, form: &ValueForm) -> Result<Self, String> {
        let of = if let ValueForm::List(list) = form { list.of } else { form };
        one_or_each(value, |value| T::from_value(value, of))
    }
}

/// A value that is no list stands for all entries of one.
impl<T: FromValue + Clone, const N: usize> FromValue for [T; N] {
    fn from_value(value: &Value, form: &ValueForm) -> Result<Self, String> {
        let mut all = Vec::<T>::from_value(value, form)?;
        if !value.is_array() {
            all.resize(N, all[0].clone());
        }
        all.try_into().map_err(|_| must_be(&format!("a list of {N}"), value))
    }
}

/// A formula without variables has a finite value, one that a number might have.
impl FromValue for Formula {
    fn from_value(value: &Value, form: &ValueForm) -> Result<Self, String> {
        let ValueForm::Formula(variables, range) = form else { return Err("takes no formula".into()) };
        let formula = match value {
            Value::String(text) => Self::parse(text, variables).map_err(|error| error.to_string())?,
            value => Self::constant(number(value)?),
        };
        match formula.as_constant() {
            Some(constant) if !constant.is_finite() => Err("is not finite; correct the formula".into()),
            Some(constant) => range.refusal(constant).map_or(Ok(formula), Err),
            None => Ok(formula),
        }
    }
}

/// Types that are read in one way, whatever the form.
macro_rules! read_by {
    ($($of:ty: $read:expr;)*) => {$(
        impl FromValue for $of {
            fn from_value(value: &Value, _: &ValueForm) -> Result<Self, String> {
                $read(value)
            }
        }
    )*};
}

read_by! {
    bool: boolean;
    f64: number;
    usize: whole;
    String: text;
    Table: table;
    Value: |value: &Value| Ok(value.clone());
}
