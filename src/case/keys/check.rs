//! Files against the tables of keys.

use toml::{Table, Value};

use super::form::*;
use super::values::{self, must_be};
use crate::case::file::error::{decimal_comma, did_you_mean, told};
use crate::geometry::Formula;

/// Neighbours of a key that are listed at most.
const MOST_TOLD: usize = 12;

impl KeyForm {
    /// Words for a value that has not the form of this key.
    pub fn refusal(&self, value: &Value) -> Option<String> {
        let words = self.value.refusal(value)?;
        Some(if self.refusal.is_empty() { words } else { self.refusal.into() })
    }
}

impl ValueForm {
    /// Words for a value that has not this form; tables are looked into by [`TableForm::faults`].
    pub fn refusal(&self, value: &Value) -> Option<String> {
        match self {
            Self::Text => values::text(value).err(),
            Self::Name => values::name(value).err(),
            Self::Short(most) => values::short(value, *most).err(),
            Self::Names => values::names(value).err(),
            Self::Boolean => values::boolean(value).err(),
            Self::Yes => (value.as_bool() != Some(true)).then(|| "must be true".into()),
            Self::Number(range) => values::number(value).map_or_else(Some, |number| range.refusal(number)),
            Self::Whole(range) => whole_refusal(*range, value),
            Self::Word(words) => word_refusal(words, value),
            Self::Formula(variables, range) => match value {
                Value::String(text) if Formula::is_spelt(text, variables) => None,
                Value::String(text) => formula_refusal(text, variables),
                Value::Integer(_) | Value::Float(_) => Self::Number(*range).refusal(value),
                other => Some(must_be(&format!("a number or a formula of {}", variables.join(", ")), other)),
            },
            Self::List(list) => list.refusal(value),
            Self::Either(forms, wanted) => either_refusal(forms, wanted, value),
            Self::Table(_) | Self::Named(_) | Self::CaseKeys | Self::CaseAxes => {
                (!value.is_table()).then(|| must_be("a table", value))
            }
            Self::Tables(_) => {
                let is_list = value.as_array().is_some_and(|list| list.iter().all(Value::is_table));
                (!is_list).then(|| must_be("a list of tables", value))
            }
        }
    }

    /// Whether it takes values of the type that this one has.
    fn takes_type(&self, value: &Value) -> bool {
        match self {
            Self::Text | Self::Name | Self::Short(_) | Self::Word(_) => value.is_str(),
            Self::Names => value.is_str() || value.is_array(),
            Self::Boolean | Self::Yes => value.is_bool(),
            Self::Number(_) => value.is_integer() || value.is_float(),
            Self::Whole(_) => value.is_integer(),
            Self::Formula(..) => value.is_str() || value.is_integer() || value.is_float(),
            Self::List(_) | Self::Tables(_) => value.is_array(),
            Self::Either(forms, _) => forms.iter().any(|form| form.takes_type(value)),
            Self::Table(_) | Self::Named(_) | Self::CaseKeys | Self::CaseAxes => value.is_table(),
        }
    }
}

impl NumberRange {
    /// Words for a number that is not allowed.
    pub(super) fn refusal(&self, number: f64) -> Option<String> {
        let made = match (self.above, self.least, self.most) {
            (Some(above), ..) if number <= above => format!("must be > {above}"),
            (_, Some(least), _) if number < least => format!("must be at least {least}"),
            (.., Some(most)) if number > most => format!("must be at most {most}"),
            _ if !self.zero && number == 0.0 => "must not be 0".into(),
            _ => return None,
        };
        Some(if self.words.is_empty() { made } else { self.words.into() })
    }
}

fn formula_refusal(text: &str, variables: &[&str]) -> Option<String> {
    let error = Formula::parse(text, variables).err()?;
    // Within brackets a comma may stand between arguments.
    let comma = text.split_once(',').filter(|(before, _)| !before.contains('('));
    let comma = comma.and_then(|(before, _)| decimal_comma(before, &text[before.len()..]));
    Some(comma.unwrap_or_else(|| error.to_string()))
}

fn whole_refusal([least, most]: [i64; 2], value: &Value) -> Option<String> {
    if value.as_integer().is_some_and(|number| (least..=most).contains(&number)) {
        return None;
    }
    Some(match most {
        i64::MAX => format!("must be a whole number of at least {least}"),
        most => format!("must be a whole number from {least} to {most}"),
    })
}

fn word_refusal(words: &[&str], value: &Value) -> Option<String> {
    let all = || format!("\"{}\"", words.join("\" or \""));
    match value.as_str() {
        None => Some(must_be(&all(), value)),
        Some(found) if words.contains(&found) => None,
        Some(found) => {
            let near = did_you_mean(found, words).map_or(String::new(), |near| format!("; {near}"));
            Some(format!("must be {}{near}", all()))
        }
    }
}

impl ListForm {
    fn refusal(&self, value: &Value) -> Option<String> {
        let Some(list) = value.as_array() else { return Some(must_be(self.wanted, value)) };
        let [least, most] = self.count;
        if least == most && list.len() != least {
            return Some(must_be(self.wanted, value));
        }
        let entry = |(k, entry): (usize, &Value)| Some(format!("entry {}: {}", k + 1, self.of.refusal(entry)?));
        let wrong: Vec<String> = list.iter().enumerate().filter_map(entry).take(MOST_TOLD).collect();
        if !wrong.is_empty() {
            return Some(wrong.join("; "));
        }
        if list.len() < least {
            let made = || format!("must not be empty: give {}", self.wanted);
            return Some(if self.few.is_empty() { made() } else { self.few.into() });
        }
        if list.len() > most {
            return Some(format!("has {} {}; at most {most} are possible", list.len(), self.noun));
        }
        values::twice(list).filter(|_| self.unique).map(values::told_twice)
    }
}

/// A number or a list that one of the forms could be is refused by the words of that form.
fn either_refusal(forms: &[ValueForm], wanted: &str, value: &Value) -> Option<String> {
    if forms.iter().any(|form| form.refusal(value).is_none()) {
        return None;
    }
    match forms.iter().find(|form| form.takes_type(value)) {
        None => Some(must_be(wanted, value)),
        Some(form @ (ValueForm::Number(_) | ValueForm::List(_) | ValueForm::Names)) => form.refusal(value),
        Some(form @ ValueForm::Formula(..)) => Some(format!("must be {wanted}; {}", form.refusal(value).unwrap_or_default())),
        Some(_) => Some(format!("must be {wanted}")),
    }
}

impl NamedForm {
    /// Whether a table may have this name, as far as the form goes: of letters outside of ASCII the reader says more.
    pub fn allows(&self, name: &str) -> bool {
        let sound = |c: char| !c.is_ascii() || c.is_ascii_alphanumeric() || "-_.".contains(c);
        let is_name = !["", ".", ".."].contains(&name);
        !self.in_files || is_name && name.chars().count() <= LONGEST_NAME && name.chars().all(sound)
    }
}

impl TableForm {
    /// Everything in a table, and in those below it, that has not the form that is wanted: key and words.
    pub fn faults(&self, table: &Table) -> Vec<(String, String)> {
        let mut faults = Faults::default();
        faults.look_into(self, table);
        faults.found
    }

    /// Words for a key that such a table may have, but not beside the others of this one; nothing for a key that it never has.
    pub fn misfit(&self, name: &str, table: &Table) -> Option<String> {
        self.key(name)?;
        let written = |keys: &[&'static str]| keys.iter().copied().find(|key| *key != name && table.contains_key(*key));
        let clash = self.rules.iter().find_map(|rule| match rule {
            TableRule::Alone(key, others) if *key == name => written(others),
            TableRule::Alone(key, others) if others.contains(&name) => written(&[key]),
            _ => None,
        });
        if let Some(other) = clash {
            return Some(format!("does not go with {other}, which stands beside it; leave one of them out"));
        }
        let wanted = self.rules.iter().find_map(|rule| match rule {
            TableRule::Beside(key, others) if *key == name && written(others).is_none() => Some(others.join(" or ")),
            _ => None,
        });
        let others = || table.keys().filter(|key| *key != name).take(MOST_TOLD).cloned().collect::<Vec<_>>().join(", ");
        let none = || format!("does not go with what stands beside it: {}", others());
        Some(wanted.map_or_else(none, |wanted| format!("goes with {wanted} only, which is not here")))
    }
}

/// What is found in a file that has not its form, and where one is in it.
#[derive(Default)]
struct Faults {
    path: Vec<String>,
    found: Vec<(String, String)>,
}

impl Faults {
    fn add(&mut self, words: impl Into<String>) {
        self.found.push((told(&self.path), words.into()));
    }

    fn below(&mut self, name: &str, look: impl FnOnce(&mut Self)) {
        self.path.push(name.into());
        look(self);
        self.path.pop();
    }

    fn look_into(&mut self, form: &TableForm, table: &Table) {
        for (name, value) in table {
            self.below(name, |faults| match form.key(name) {
                None => faults.add("unknown key"),
                Some(key) => {
                    key.refusal(value).into_iter().for_each(|words| faults.add(words));
                    faults.look_below(&key.value, value);
                }
            });
        }
        for key in form.all().filter(|key| key.absent == Absent::Refused && !table.contains_key(key.name)) {
            self.below(key.name, |faults| faults.add("missing"));
        }
        form.rules.iter().filter_map(|rule| rule.broken(table)).for_each(|words| self.add(words));
    }

    /// Looks into the tables that stand under a key.
    fn look_below(&mut self, form: &ValueForm, value: &Value) {
        match (form, value) {
            (ValueForm::Table(form), Value::Table(table)) => self.look_into(form, table),
            (ValueForm::Tables(form), Value::Array(list)) => {
                for (index, table) in list.iter().enumerate().filter_map(|(index, value)| Some((index, value.as_table()?))) {
                    self.below(&(index + 1).to_string(), |faults| faults.look_into(form, table));
                }
            }
            (ValueForm::Named(named), Value::Table(tables)) => self.look_into_named(named, tables),
            (ValueForm::Either(forms, _), value) => {
                let form = forms.iter().find(|form| form.takes_type(value));
                form.into_iter().for_each(|form| self.look_below(form, value));
            }
            (ValueForm::CaseAxes, Value::Table(table)) => {
                for (name, value) in table {
                    self.below(name, |faults| match value {
                        Value::Table(_) => faults.look_below(form, value),
                        Value::Array(list) if !list.is_empty() => {
                            values::twice(list).into_iter().for_each(|number| faults.add(values::told_twice(number)));
                        }
                        _ => faults.add("must be a list of values, as in [2, 3]"),
                    });
                }
            }
            _ => {}
        }
    }

    fn look_into_named(&mut self, named: &NamedForm, tables: &Table) {
        if tables.len() < named.least {
            self.add("is empty");
        }
        for (name, value) in tables {
            self.below(name, |faults| {
                if !named.allows(name) {
                    faults.add(NO_FILE_NAME);
                }
                match value.as_table() {
                    Some(table) => faults.look_into(named.table, table),
                    None => faults.add(must_be("a table", value)),
                }
            });
        }
    }
}

impl TableRule {
    /// Words for a table that breaks it.
    fn broken(&self, table: &Table) -> Option<String> {
        let has = |key: &&str| table.contains_key(*key);
        match self {
            Self::OneOf(groups) if groups.iter().any(|group| group.iter().all(has)) => None,
            Self::OneOf(groups) => {
                let groups: Vec<String> = groups.iter().map(|group| group.join(" and ")).collect();
                Some(format!("wants {}", groups.join(", or ")))
            }
            Self::Beside(key, others) if has(key) && !others.iter().any(has) => {
                Some(format!("{key} stands beside {} only", others.join(" or ")))
            }
            Self::Alone(key, others) if has(key) => {
                others.iter().find(|other| has(other)).map(|other| format!("{key} stands beside {other}; give one of them"))
            }
            _ => None,
        }
    }
}
