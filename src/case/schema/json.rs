//! JSON Schema (draft 2020-12) of the tables of keys.

use std::collections::BTreeMap;

use serde_json::{Map, Value, json as value};

use crate::case::keys::{Absent, KeyForm, LONGEST_NAME, ListForm, NamedForm, NumberRange, TableForm, TableRule, ValueForm};
use crate::geometry::Formula;

/// White space, as the program has it: classes such as `\s` differ from one dialect to the other.
const WHITE: &str = "\\t\\n\\u000b\\f\\r \\u0085\\u00a0\\u1680\\u2000-\\u200a\\u2028\\u2029\\u202f\\u205f\\u3000";

/// Letters of names that are parts of file names; of letters outside of ASCII the program says more.
const IN_FILES: &str = "^[^\\u0000-,/:-@\\[-^`{-\\u007f]*$";

/// The JSON Schema of a file.
pub fn json(file: &'static TableForm) -> String {
    let mut definitions = BTreeMap::new();
    let mut schema = table(file, &mut definitions);
    schema["$schema"] = value!("https://json-schema.org/draft/2020-12/schema");
    schema["title"] = value!(format!("mezha: {} file", file.name));
    schema["description"] = value!(format!("Keys of a {} file of mezha, made by `mezha schema`.", file.name));
    schema["$defs"] = value!(definitions);
    serde_json::to_string_pretty(&schema).expect("a value of JSON can be written")
}

type Definitions = BTreeMap<&'static str, Value>;

/// What may stand in a table.
fn table(form: &'static TableForm, definitions: &mut Definitions) -> Value {
    let properties: Map<String, Value> = form.all().map(|key| (key.name.into(), property(key, definitions))).collect();
    let required: Vec<&str> = form.all().filter(|key| key.absent == Absent::Refused).map(|key| key.name).collect();
    said(value!({
        "type": "object",
        "properties": properties,
        "additionalProperties": false,
        "required": (!required.is_empty()).then_some(required),
        "description": (!form.sentence.is_empty()).then(|| plain(form.sentence)),
        "allOf": (!form.rules.is_empty()).then(|| form.rules.iter().map(rule).collect::<Vec<_>>()),
    }))
}

/// A schema without what is null in it, which says nothing.
fn said(mut schema: Value) -> Value {
    schema.as_object_mut().into_iter().for_each(|entries| entries.retain(|_, value| !value.is_null()));
    schema
}

/// A key, with all that is said of it.
fn property(key: &KeyForm, definitions: &mut Definitions) -> Value {
    let mut schema = self::form(&key.value, definitions);
    let unit = if key.unit.is_empty() { String::new() } else { format!(" Unit: {}.", key.unit) };
    let default = match key.absent {
        Absent::Words(words) => format!(" Without it: {words}."),
        _ => String::new(),
    };
    let told = plain(&format!("{}{unit}{default}", key.sentence));
    schema["description"] = value!(Some(told.trim()).filter(|told| !told.is_empty()));
    schema["default"] = value!(key.default());
    said(schema)
}

/// What a value may be.
fn form(form: &ValueForm, definitions: &mut Definitions) -> Value {
    match form {
        ValueForm::Text => value!({ "type": "string" }),
        ValueForm::Name => value!({ "type": "string", "pattern": format!("[^{WHITE}]") }),
        ValueForm::Short(most) => value!({ "type": "string", "pattern": format!("[^{WHITE}]"), "maxLength": most }),
        ValueForm::Names => {
            let name = self::form(&ValueForm::Name, definitions);
            value!({ "anyOf": [name, { "type": "array", "items": name, "minItems": 1, "uniqueItems": true }] })
        }
        ValueForm::Boolean => value!({ "type": "boolean" }),
        ValueForm::Yes => value!({ "const": true }),
        ValueForm::Number(range) => numbers(value!("number"), range),
        ValueForm::Whole([least, most]) => {
            said(value!({ "type": "integer", "minimum": least, "maximum": Some(most).filter(|most| **most < i64::MAX) }))
        }
        ValueForm::Word(words) => value!({ "enum": words }),
        ValueForm::Formula(variables, range) => {
            let mut schema = numbers(value!(["number", "string"]), range);
            schema["pattern"] = value!(Formula::pattern(variables));
            schema
        }
        ValueForm::List(list) => self::list(list, definitions),
        ValueForm::Either(forms, _) => {
            let forms: Vec<Value> = forms.iter().map(|form| self::form(form, definitions)).collect();
            value!({ "anyOf": forms })
        }
        ValueForm::Table(table) => reference(table, definitions),
        ValueForm::Tables(table) => value!({ "type": "array", "items": reference(table, definitions) }),
        ValueForm::Named(named) => self::named(named, definitions),
        ValueForm::CaseKeys => value!({ "type": "object" }),
        ValueForm::CaseAxes => {
            let axis = value!({ "type": "array", "minItems": 1, "uniqueItems": true });
            let axes = value!({ "type": "object", "additionalProperties": { "anyOf": [axis, { "$ref": "#/$defs/axes" }] } });
            definitions.insert("axes", axes);
            value!({ "$ref": "#/$defs/axes" })
        }
    }
}

fn list(list: &ListForm, definitions: &mut Definitions) -> Value {
    let [least, most] = list.count;
    said(value!({
        "type": "array",
        "items": self::form(list.of, definitions),
        "minItems": (least > 0).then_some(least),
        "maxItems": (most < usize::MAX).then_some(most),
        "uniqueItems": list.unique.then_some(true),
    }))
}

/// Numbers of some range; a range says nothing of strings.
fn numbers(kind: Value, range: &NumberRange) -> Value {
    let not = (!range.zero).then(|| value!({ "const": 0 }));
    let NumberRange { least, above, most, .. } = range;
    said(value!({ "type": kind, "minimum": least, "exclusiveMinimum": above, "maximum": most, "not": not }))
}

fn named(named: &NamedForm, definitions: &mut Definitions) -> Value {
    let names = value!({ "pattern": IN_FILES, "minLength": 1, "maxLength": LONGEST_NAME, "not": { "enum": [".", ".."] } });
    said(value!({
        "type": "object",
        "patternProperties": { ".*": reference(named.table, definitions) },
        "additionalProperties": false,
        "minProperties": (named.least > 0).then_some(named.least),
        "propertyNames": named.in_files.then_some(names),
    }))
}

/// A table that is defined once.
fn reference(form: &'static TableForm, definitions: &mut Definitions) -> Value {
    if !definitions.contains_key(form.name) {
        definitions.insert(form.name, Value::Null);
        let definition = table(form, definitions);
        definitions.insert(form.name, definition);
    }
    value!({ "$ref": format!("#/$defs/{}", form.name) })
}

/// Which keys stand together.
fn rule(rule: &TableRule) -> Value {
    let required = |keys: &[&str]| value!({ "required": keys });
    let groups = |groups: &mut dyn Iterator<Item = &[&str]>| groups.map(required).collect::<Vec<_>>();
    match rule {
        TableRule::OneOf(all) => value!({ "anyOf": groups(&mut all.iter().copied()) }),
        TableRule::Beside(key, [other]) => value!({ "if": required(&[key]), "then": required(&[other]) }),
        TableRule::Beside(key, others) => {
            value!({ "if": required(&[key]), "then": { "anyOf": groups(&mut others.chunks(1)) } })
        }
        TableRule::Alone(key, others) => {
            let none: Map<String, Value> = others.iter().map(|other| ((*other).into(), value!(false))).collect();
            value!({ "if": required(&[key]), "then": { "properties": none } })
        }
    }
}

/// Markdown without its links.
fn plain(text: &str) -> String {
    let mut parts = text.split('[');
    let mut plain = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        match part.split_once("](").and_then(|(words, rest)| Some((words, rest.split_once(')')?.1))) {
            Some((words, rest)) if !words.contains(']') => plain += &format!("{words}{rest}"),
            _ => plain += &format!("[{part}"),
        }
    }
    plain
}
