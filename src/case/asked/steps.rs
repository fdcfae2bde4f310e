//! `[steps.NAME]`: named factors that scale loads, prescribed motions and gaps from step to step.
//!
//! A step is the case that the file would be if each scaled value stood in it multiplied: what `--set` makes of it.

use toml::{Table, Value};

use crate::case::bodies::body::with_parts;
use crate::case::file::error::{dotted, suggest};
use crate::case::file::overrides::{read_key, set_value, value_at};
use crate::case::keys::{FormOf, ListForm, NAME, NUMBER, Section, ValueForm, declare, entries, key, of, set, table};

declare! {
    /// A factor that changes from load step to load step, see [load steps](#load-steps); several of them change together.
    static STEPS = table("steps");
    /// One number for each step, `[0.25, 0.5, 1]`; all lists are equally long.
    const FACTORS: Vec<f64> = key("factors", of(ValueForm::List(ONE_A_STEP))).required("[0.5, 1.0], one for each step");
    /// What is multiplied by it: keys of tables, `["load.top", "rigid.die", "contact.seam.gap", "gravity"]`, or of single values,
    /// `["rigid.die.uy"]`.
    const SCALES: Vec<String> = key("scales", SCALED_KEYS).required("[\"load.top\"]");
}

const ONE_A_STEP: ListForm = ListForm { count: [1, 1000], noun: "steps", ..entries(&NUMBER, "a list of numbers") };
const SCALED_KEYS: FormOf<Vec<String>> =
    set(&NAME, "keys of loads, supports, rigid tools, contacts or bodies, as in [\"load.top\", \"contact.seam.gap\"]");

/// Kinds of tables with values that can be scaled.
const SCALED: [(&str, &[&str]); 5] = [
    ("load", &["pressure", "traction", "force", "moment", "ux", "uy", "angle"]),
    ("support", &["ux", "uy", "normal", "angle", "along", "tangential"]),
    ("rigid", &["ux", "uy", "angle", "force", "moment"]),
    ("contact", &["gap"]),
    ("body", &["body_force", "temperature"]),
];

/// The table that weights follow from, and its key.
const GRAVITY: [&str; 2] = ["gravity", "g"];

/// A named factor.
#[derive(Clone, Debug, PartialEq)]
pub struct LoadFactor {
    name: String,
    /// One value for each step.
    values: Vec<f64>,
    /// Keys of tables or of single values, as the case file names them.
    scales: Vec<String>,
}

/// `[steps.NAME]`
pub fn read_factor(section: &Section) -> Option<LoadFactor> {
    let (factors, scales) = (section.required(FACTORS), section.required(SCALES));
    Some(LoadFactor { name: section.name().into(), values: factors?, scales: scales? })
}

/// All lists are equally long, everything that is scaled is there, and once only.
pub fn check_steps(factors: &[LoadFactor], root: &Section) {
    if !root.has("steps") {
        return;
    }
    if root.has("accuracy") && root.names_below("steps").next().is_some() {
        let words = "stands beside an accuracy, which adapts the mesh to one load; adapt it without steps (--set steps={}), and name the adapted.msh of that result as mesh.file here";
        root.problem(&["steps"], words);
    }
    let Some(written) = root.table else { return };
    let mut known: Vec<(Vec<String>, &LoadFactor)> = Vec::new();
    for factor in factors {
        if factor.values.len() != factors[0].values.len() {
            let [own, first] = [factor, &factors[0]].map(|factor| factor.values.len());
            let words =
                format!("lists {own} steps, but steps.{} lists {first}; give each factor one value a step", factors[0].name);
            root.problem(&["steps", &factor.name, "factors"], words);
        }
        for key in &factor.scales {
            let problem = |words: String| root.problem(&["steps", &factor.name, "scales"], format!("\"{key}\" {words}"));
            match places(written, key) {
                Err(words) => problem(words),
                Ok(places) => {
                    let twice = places.iter().find_map(|place| known.iter().find(|(other, _)| other == place));
                    if let Some((place, other)) = twice {
                        let words = format!(
                            "scales {}, which steps.{} scales already; a value has one factor",
                            dotted(place),
                            other.name
                        );
                        problem(words);
                    }
                    known.extend(places.into_iter().map(|place| (place, factor)));
                }
            }
        }
    }
}

/// Paths of the values that a key of a case stands for.
///
/// # Errors
/// Words that follow the key.
fn places(root: &Table, key: &str) -> Result<Vec<Vec<String>>, String> {
    let path = read_key(key).unwrap_or_default();
    let names: Vec<&str> = path.iter().map(String::as_str).collect();
    if names.first() == Some(&GRAVITY[0]) && names.len() == 1 || names == GRAVITY {
        let is_there = root.get(GRAVITY[0]).is_some_and(Value::is_table);
        return is_there.then(|| vec![GRAVITY.map(String::from).to_vec()]).ok_or("is not in the case".into());
    }
    let kinds = || SCALED.map(|(kind, _)| format!("{kind}.NAME")).join(", ");
    let of_kind = |kind: &str| SCALED.iter().find(|(known, _)| *known == kind);
    let (name, part, single) = match names[..] {
        [_, name] => (name, None, None),
        ["body", name, "part", part] => (name, Some(part), None),
        ["body", name, "part", part, single] => (name, Some(part), Some(single)),
        [_, name, single] => (name, None, Some(single)),
        _ => ("", None, None),
    };
    let Some(&(kind, keys)) = names.first().and_then(|kind| of_kind(kind)).filter(|_| !name.is_empty()) else {
        return Err(format!("cannot be scaled; what can is {}, one of their keys, and gravity", kinds()));
    };
    let tables = root.get(kind).and_then(Value::as_table);
    let Some(table) = tables.and_then(|tables| tables.get(name)).and_then(Value::as_table) else {
        let with = |name: &String| dotted(&[&path[..1], std::slice::from_ref(name), &path[2..]].concat());
        let known: Vec<String> = tables.into_iter().flat_map(Table::keys).map(with).collect();
        return Err(format!("is not in the case; {}", suggest(key, known.iter().map(String::as_str))));
    };
    if let Some(single) = single.filter(|single| !keys.contains(single)) {
        return Err(format!("cannot be scaled: of a {kind} that is {}, not {single}", keys.join(", ")));
    }
    let mut found = Vec::new();
    let is_meant = |below: &[String]| part.is_none_or(|part| below.last().is_some_and(|own| own == part));
    for (below, table) in with_parts(table).filter(|(below, _)| is_meant(below)) {
        let scaled = keys.iter().filter(|key| single.is_none_or(|single| single == **key) && table.contains_key(**key));
        found.extend(scaled.map(|key| [&path[..2], &below, &[(*key).to_string()]].concat()));
    }
    if let (true, Some(word @ ("closed" | "geometry"))) = (kind == "contact", table.get(keys[0]).and_then(Value::as_str)) {
        return Err(format!("has gap = \"{word}\", which is no number; only a number or a formula can be scaled"));
    }
    if found.is_empty() {
        return Err(format!("has nothing to scale: it gives no {}", single.map_or(keys.join(", "), String::from)));
    }
    Ok(found)
}

/// The factors of each step, and the table of the case with everything scaled; in the order of the steps. The factors are
/// checked ones. Only the last table keeps what is expected of the result.
pub fn tables(table: &Table, factors: &[LoadFactor]) -> Vec<(Vec<(String, f64)>, Table)> {
    let count = factors.first().map_or(0, |factor| factor.values.len());
    let step = |k: usize| {
        let mut scaled = table.clone();
        scaled.remove("steps");
        if k + 1 < count {
            scaled.remove("exact");
        }
        for factor in factors {
            let all = factor.scales.iter().filter_map(|key| places(table, key).ok()).flatten();
            all.for_each(|place| scale(&mut scaled, &place, factor.values[k]));
        }
        (factors.iter().map(|factor| (factor.name.clone(), factor.values[k])).collect(), scaled)
    };
    (0..count).map(step).collect()
}

/// Multiplies the value at a path.
fn scale(table: &mut Table, place: &[String], factor: f64) {
    if factor == 0.0 && place == GRAVITY {
        without_weight(table);
        return;
    }
    let Some(value) = value_at(table, place).map(|found| times(found, factor)) else { return };
    set_value(table, place, value).expect("a value stands there already");
}

/// Where nothing is heavy there is no gravity, and no density.
fn without_weight(table: &mut Table) {
    table.remove(GRAVITY[0]);
    for body in table.get_mut("body").and_then(Value::as_table_mut).into_iter().flat_map(|bodies| bodies.iter_mut()) {
        let Some(body) = body.1.as_table_mut() else { continue };
        body.remove("density");
        for part in body.get_mut("part").and_then(Value::as_table_mut).into_iter().flat_map(|parts| parts.iter_mut()) {
            part.1.as_table_mut().map(|part| part.remove("density"));
        }
    }
}

/// A number, a formula, or a list of them, multiplied.
fn times(value: &Value, factor: f64) -> Value {
    match value {
        Value::Integer(number) => Value::from(factor * *number as f64),
        Value::Float(number) => Value::from(factor * number),
        // What is nothing is seen to be nothing: nothing acts then.
        Value::String(_) if factor == 0.0 => Value::from(0.0),
        Value::String(formula) => Value::from(format!("{factor:?}*({formula})")),
        Value::Array(list) => Value::from(list.iter().map(|entry| times(entry, factor)).collect::<Vec<_>>()),
        other => other.clone(),
    }
}

#[cfg(test)]
mod tests;
