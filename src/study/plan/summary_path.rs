//! A place in `summary.json`.

use serde_json::Value;

use crate::case::error::dotted;
use crate::case::overrides::read_key;
use crate::case::values;

/// The only entry of a table, whatever its name.
pub const ONLY: &str = "*";

/// A dotted path such as `errors.energy`, `contact."a.b".force` or `probe.tip.u.0`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SummaryPath {
    /// As it is written in the study file.
    pub text: String,
    names: Vec<String>,
}

impl SummaryPath {
    /// Reads a path from a value of the study file.
    ///
    /// # Errors
    /// It is not a dotted path.
    pub fn read(value: &toml::Value) -> Result<Self, String> {
        Self::parse(values::name(value)?.trim())
    }

    /// Reads a path by the rules of keys in TOML.
    ///
    /// # Errors
    /// It is not a dotted path.
    pub fn parse(text: &str) -> Result<Self, String> {
        let remedy = "must be a path in summary.json with dots, as in \"errors.energy\"";
        let names = read_key(text).ok_or(remedy)?;
        Ok(Self { text: text.into(), names })
    }

    /// The path of some names.
    pub fn new(names: &[&str]) -> Self {
        let names: Vec<String> = names.iter().map(|name| (*name).to_owned()).collect();
        Self { text: dotted(&names), names }
    }

    /// Whether it asks for the only entry of a table that has several.
    pub fn is_ambiguous(&self, summary: &Value) -> bool {
        let Some(at) = self.names.iter().position(|name| name == ONLY) else { return false };
        let table = self.names[..at].iter().try_fold(summary, |value, name| step(value, name)).and_then(Value::as_object);
        table.is_some_and(|table| table.len() > 1)
    }

    /// What stands there; null if nothing does. A number is a place in a list, from 0, and `*` the only entry of a table.
    pub fn of(&self, summary: &Value) -> Value {
        self.names.iter().try_fold(summary, |value, name| step(value, name)).cloned().unwrap_or(Value::Null)
    }
}

/// What stands under one name of a path.
fn step<'a>(value: &'a Value, name: &str) -> Option<&'a Value> {
    match value {
        Value::Array(list) => list.get(name.parse::<usize>().ok()?),
        Value::Object(table) if name == ONLY && table.len() == 1 => table.values().next(),
        other => other.get(name),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn paths_lead_through_tables_and_lists() {
        let summary =
            json!({ "errors": { "energy": 1e-3 }, "contact": { "a.b": { "force": 2 } }, "probe": { "tip": { "u": [3, 4] } } });
        let table = [
            ("errors.energy", json!(1e-3)),
            ("contact.\"a.b\".force", json!(2)),
            ("probe.tip.u.1", json!(4)),
            ("probe.tip.u", json!([3, 4])),
            ("probe.tip.u.2", Value::Null),
            ("probe.tip.u.x", Value::Null),
            ("contact.\"*\".force", json!(2)),
            ("errors.energy.value", Value::Null),
            ("nothing", Value::Null),
        ];
        for (path, value) in table {
            assert_eq!(SummaryPath::parse(path).unwrap().of(&summary), value, "{path}");
        }
    }

    #[test]
    fn a_path_is_a_dotted_key() {
        for path in ["", "errors..energy", "errors energy", "a = 1\nb"] {
            assert!(SummaryPath::parse(path).is_err(), "{path}");
        }
        assert!(SummaryPath::read(&toml::Value::from(3)).is_err());
    }
}
