//! A table of a case or a study file, read by the table of its keys, that remembers which of them were asked for.

use std::cell::RefCell;
use std::path::Path;

use toml::{Table, Value};

use super::declaring::Key;
use super::form::{KeyForm, TableForm};
use super::values::FromValue;
use crate::case::file::error::{CaseError, Log, Problem, quoted, suggest, told};

/// One table of a file, read by the table of its keys, which has the form of each value and its default. When it is dropped, keys
/// that nobody asked for are reported: read every key before giving up on one.
///
/// A reader asks for a [`Key`] and gets a value of its type, which has the form of the key; `None` means that it is not there, or
/// that the log knows what is wrong.
///
/// # Panics
/// Where a key is asked for that is not in the table of keys.
pub struct Section<'a> {
    /// This table as it is written; none if it is not in the file: everything has its default.
    pub table: Option<&'a Table>,
    /// The keys that it may have.
    form: &'static TableForm,
    path: Vec<String>,
    log: &'a RefCell<Log>,
    asked: RefCell<Vec<&'static str>>,
}

impl<'a> Section<'a> {
    /// The whole file.
    pub fn root(table: &'a Table, form: &'static TableForm, log: &'a RefCell<Log>) -> Self {
        Self { table: Some(table), form, path: Vec::new(), log, asked: RefCell::default() }
    }

    /// Name of this table.
    pub fn name(&self) -> &str {
        self.path.last().map_or("", String::as_str)
    }

    /// Whether a key is written in the file.
    pub fn has(&self, key: &'static str) -> bool {
        self.get(key).is_some()
    }

    /// Whether a table is written under a key.
    pub fn has_table(&self, key: &'static str) -> bool {
        self.get(key).is_some_and(Value::is_table)
    }

    /// A value that must be given.
    pub fn required<T: FromValue>(&self, key: Key<T>) -> Option<T> {
        let name = key.form.name;
        if !self.has(name) {
            self.problem(&[name], format!("missing; write {name} = {}", self.form_of(name).example));
        }
        self.optional(key)
    }

    /// A value that may be left out.
    pub fn optional<T: FromValue>(&self, key: Key<T>) -> Option<T> {
        self.get(key.form.name).and_then(|value| self.checked(key, value))
    }

    /// A value with a default, which is read in the same way and written into the resolved case.
    pub fn or<T: FromValue>(&self, key: Key<T>) -> Option<T> {
        let name = key.form.name;
        self.or_else(key, || self.default_of(name))
    }

    /// A value with a default, which holds in the place of a bad value, too: of that the log knows.
    pub fn or_default<T: FromValue>(&self, key: Key<T>) -> T {
        let form = key.form;
        let default = || T::from_value(&self.default_of(form.name), &form.value).expect("a default has the form of its key");
        self.or(key).unwrap_or_else(default)
    }

    /// A value with a default that other keys tell.
    pub fn or_else<T: FromValue, D: Into<Value>>(&self, key: Key<T>, default: impl FnOnce() -> D) -> Option<T> {
        if let Some(value) = self.get(key.form.name) {
            return self.checked(key, value);
        }
        let (path, default) = (self.child(key.form.name), default().into());
        let result = self.checked(key, &default);
        self.log.borrow_mut().defaults.push((path, default));
        result
    }

    /// What is made of a value that was read; nothing if it is refused for what else is known.
    pub fn made<T, U>(&self, key: &str, value: Option<T>, make: impl FnOnce(T) -> Result<U, String>) -> Option<U> {
        make(value?).map_err(|words| self.problem(&[key], words)).ok()
    }

    /// Reports each of some keys that is written.
    pub fn refuse(&self, keys: &[&'static str], words: &str) {
        keys.iter().filter(|key| self.has(key)).for_each(|key| self.problem(&[key], words));
    }

    /// Whether one of some keys is written; all are asked for.
    pub fn has_any(&self, keys: &[&'static str]) -> bool {
        keys.iter().filter(|key| self.has(key)).count() > 0
    }

    /// Reports a name at a path below this table if it is none of those that are known.
    pub fn check_name<'n>(&self, below: &[&str], kind: &str, name: &str, known: impl Iterator<Item = &'n str>) {
        let known: Vec<&str> = known.collect();
        if !known.contains(&name) {
            self.problem(below, format!("no such {kind}; {}", suggest(name, known.into_iter())));
        }
    }

    /// The table under a key; an empty one if it is missing.
    pub fn table(&self, key: &'static str) -> Section<'a> {
        self.inner(key, self.child(key), self.tables(key))
    }

    /// The table under a key, if it is in the file.
    pub fn optional_table(&self, key: &'static str) -> Option<Section<'a>> {
        self.has(key).then(|| self.table(key)).filter(|section| section.table.is_some())
    }

    /// Reads every table under a key, as in `[body.lower]`, `[body.upper]`.
    pub fn named<T>(&self, key: &'static str, mut read: impl FnMut(&Section) -> Option<T>) -> Vec<T> {
        let mut results = Vec::new();
        for (name, value) in self.tables(key).into_iter().flatten() {
            let path: Vec<String> = self.child(key).into_iter().chain([name.clone()]).collect();
            match value.as_table() {
                Some(table) => results.extend(read(&self.inner(key, path, Some(table)))),
                None => self.problem(&[key, name.as_str()], format!("must be a table; write [{}]", told(&path))),
            }
        }
        results
    }

    /// Reads every table of a list, as in `[[curve]]`; the first one is called 1.
    pub fn listed<T>(&self, key: &'static str, read: impl Fn(&Section) -> Option<T>) -> Vec<T> {
        let list = match self.get(key) {
            None => return Vec::new(),
            Some(Value::Array(list)) if list.iter().all(Value::is_table) => list,
            Some(_) => {
                self.problem(&[key], format!("must be a list of tables; write [[{}]]", told(&self.child(key))));
                return Vec::new();
            }
        };
        let numbered = list.iter().enumerate().map(|(index, value)| {
            let path = self.child(key).into_iter().chain([(index + 1).to_string()]).collect();
            self.inner(key, path, value.as_table())
        });
        numbered.filter_map(|section| read(&section)).collect()
    }

    /// Reports what is wrong with the value at a path below this table, as found in the file.
    pub fn problem(&self, below: &[&str], words: impl Into<String>) {
        let mut value = None;
        let mut table = self.table;
        for name in below {
            value = table.and_then(|table| table.get(*name));
            table = value.and_then(Value::as_table);
        }
        self.record(below, value.filter(|value| !value.is_table()), words.into());
    }

    /// Names of the tables under a key, whether or not they could be read.
    pub fn names_below(&self, key: &'static str) -> impl Iterator<Item = &'a str> {
        self.get(key).and_then(Value::as_table).into_iter().flat_map(Table::keys).map(String::as_str)
    }

    /// A table under a key, as it is written.
    pub fn below(&self, key: &'static str, name: &str) -> Option<&'a Table> {
        self.get(key)?.as_table()?.get(name)?.as_table()
    }

    /// Names of the tables under `inner` in each table under a key.
    pub fn names_two_below(&self, key: &'static str, inner: &'static str) -> impl Iterator<Item = &'a str> {
        let tables = self.get(key).and_then(Value::as_table).into_iter().flat_map(Table::values);
        let inner = tables.filter_map(move |table| table.get(inner)?.as_table());
        inner.flat_map(Table::keys).map(String::as_str)
    }

    /// The table under a key as it is written, which may be one of tables; something else is reported.
    fn tables(&self, key: &'static str) -> Option<&'a Table> {
        let value = self.get(key)?;
        if !value.is_table() {
            self.problem(&[key], format!("must be a table; write [{}]", told(&self.child(key))));
        }
        value.as_table()
    }

    fn get(&self, key: &'static str) -> Option<&'a Value> {
        let mut asked = self.asked.borrow_mut();
        if !asked.contains(&key) {
            self.form_of(key);
            asked.push(key);
        }
        self.table.and_then(|table| table.get(key))
    }

    /// What the table of keys says of one.
    fn form_of(&self, key: &'static str) -> &'static KeyForm {
        let form = self.form.key(key).unwrap_or_else(|| panic!("{key} is no key of a {}", self.form.name));
        #[cfg(test)]
        super::tests::note(self.form, form);
        form
    }

    /// A table that stands under a key.
    fn inner(&self, key: &'static str, path: Vec<String>, table: Option<&'a Table>) -> Section<'a> {
        let form = self.form_of(key).value.table().unwrap_or_else(|| panic!("{key} of a {} is no table", self.form.name));
        Section { table, form, path, log: self.log, asked: RefCell::default() }
    }

    fn child(&self, key: &str) -> Vec<String> {
        self.path.iter().cloned().chain([key.to_owned()]).collect()
    }

    fn default_of(&self, key: &'static str) -> Value {
        self.form_of(key).default().unwrap_or_else(|| panic!("{key} of a {} has no default", self.form.name))
    }

    fn checked<T: FromValue>(&self, key: Key<T>, value: &Value) -> Option<T> {
        let form = self.form_of(key.form.name);
        let result = form.refusal(value).map_or_else(|| T::from_value(value, &form.value), Err);
        result.map_err(|words| self.record(&[key.form.name], Some(value), words)).ok()
    }

    fn record(&self, below: &[&str], value: Option<&Value>, words: String) {
        let path: Vec<String> = self.path.iter().cloned().chain(below.iter().map(|name| (*name).to_owned())).collect();
        let mut log = self.log.borrow_mut();
        let path = log.as_written(path);
        let from_command_line = log.overridden.iter().any(|overridden| path.starts_with(overridden));
        let source = if from_command_line { " (--set)" } else { "" };
        let value = value.map(|value| format!("{}{source}", quoted(value)));
        log.add(Problem { key: told(&path), value, words });
    }
}

/// What readers make of the table of a whole file, and the log of it. Where they have found nothing wrong, the table of keys has the last
/// word.
///
/// # Errors
/// [`CaseError`] with everything that is wrong.
pub fn read_whole<T>(
    (table, log): (&Table, Log),
    form: &'static TableForm,
    file: &Path,
    read: impl FnOnce(&Section) -> Option<T>,
) -> Result<(T, Log), CaseError> {
    let log = RefCell::new(log);
    let made = read(&Section::root(table, form, &log));
    let mut log = log.into_inner();
    if log.problems.is_empty() {
        let problem = |(key, words)| Problem { key, value: None, words };
        log.problems.extend(form.faults(table).into_iter().map(problem));
    }
    match made {
        Some(made) if log.problems.is_empty() => Ok((made, log)),
        _ => Err(CaseError { file: file.into(), problems: log.problems }),
    }
}

impl Drop for Section<'_> {
    fn drop(&mut self) {
        let asked = self.asked.take();
        for (name, value) in self.table.into_iter().flatten().filter(|(name, _)| !asked.contains(&name.as_str())) {
            let key = told(&self.log.borrow().as_written(self.child(name)));
            if let Some(words) = self.table.and_then(|table| self.form.misfit(name, table)) {
                self.log.borrow_mut().add(Problem { key, value: None, words });
                continue;
            }
            let remedy = suggest(name, asked.iter().copied());
            let quotes = if value.is_table() { " (a name that holds dots stands in quotes)" } else { "" };
            self.log.borrow_mut().add(Problem::unknown(key, &format!("{remedy}{quotes}")));
        }
    }
}
