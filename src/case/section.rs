//! A table of a case or a study file that remembers which of its keys were asked for.

use std::cell::RefCell;
use std::path::Path;

use toml::{Table, Value};

use super::error::{CaseError, Problem, quoted, suggest, told};
use crate::mesh::read_regular;

/// A case or a study file is never as large.
const MOST_BYTES: u64 = 64 << 20;

/// Text of a file; `kind` says which one the command wants.
///
/// # Errors
/// The file cannot be read.
pub fn read_text(file: &Path, kind: &str) -> Result<String, CaseError> {
    let refused = |words: String| {
        CaseError::of_file(file, format!("cannot be read: {words}; the first argument is the path of a {kind} file"))
    };
    let bytes = read_regular(file, MOST_BYTES).map_err(|error| refused(error.to_string()))?;
    String::from_utf8(bytes).map_err(|_| refused("it is no text in UTF-8".into()))
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
}

/// One table of a file. When it is dropped, keys that nobody asked for are reported: read every key before giving up on one.
///
/// Readers turn a value into a checked one, or into words that name the remedy; `None` means that the log knows what is wrong.
pub struct Section<'a> {
    /// None: the table is not in the file, everything has its default.
    table: Option<&'a Table>,
    path: Vec<String>,
    log: &'a RefCell<Log>,
    asked: RefCell<Vec<&'static str>>,
}

impl<'a> Section<'a> {
    /// The whole file.
    pub fn root(table: &'a Table, log: &'a RefCell<Log>) -> Self {
        Self { table: Some(table), path: Vec::new(), log, asked: RefCell::default() }
    }

    /// Name of this table.
    pub fn name(&self) -> &str {
        self.path.last().map_or("", String::as_str)
    }

    /// This table as it is written, if it is in the file.
    pub fn written(&self) -> Option<&'a Table> {
        self.table
    }

    /// Whether a key is written in the file.
    pub fn has(&self, key: &'static str) -> bool {
        self.get(key).is_some()
    }

    /// Whether a table is written under a key.
    pub fn has_table(&self, key: &'static str) -> bool {
        self.get(key).is_some_and(Value::is_table)
    }

    /// A value that must be given; `example` shows how.
    pub fn required<T>(&self, key: &'static str, example: &str, read: impl Fn(&Value) -> Result<T, String>) -> Option<T> {
        match self.get(key) {
            Some(value) => self.checked(key, value, read),
            None => {
                self.problem(&[key], format!("missing; write {key} = {example}"));
                None
            }
        }
    }

    /// A value that may be left out.
    pub fn optional<T>(&self, key: &'static str, read: impl Fn(&Value) -> Result<T, String>) -> Option<T> {
        self.get(key).and_then(|value| self.checked(key, value, read))
    }

    /// A value with a default, which is read in the same way and written into the resolved case.
    pub fn or<T>(&self, key: &'static str, default: impl Into<Value>, read: impl Fn(&Value) -> Result<T, String>) -> Option<T> {
        if let Some(value) = self.get(key) {
            return self.checked(key, value, read);
        }
        let default = default.into();
        let result = self.checked(key, &default, read);
        self.log.borrow_mut().defaults.push((self.child(key), default));
        result
    }

    /// The table under a key; an empty one if it is missing.
    pub fn table(&self, key: &'static str) -> Section<'a> {
        let value = self.get(key);
        if value.is_some_and(|value| !value.is_table()) {
            self.problem(&[key], format!("must be a table; write [{}]", told(&self.child(key))));
        }
        Section { table: value.and_then(Value::as_table), path: self.child(key), log: self.log, asked: RefCell::default() }
    }

    /// The table under a key, if it is in the file.
    pub fn optional_table(&self, key: &'static str) -> Option<Section<'a>> {
        self.has(key).then(|| self.table(key)).filter(|section| section.table.is_some())
    }

    /// Reads every table under a key, as in `[body.lower]`, `[body.upper]`.
    pub fn named<T>(&self, key: &'static str, read: impl Fn(&Section) -> Option<T>) -> Vec<T> {
        let tables = self.table(key);
        let mut results = Vec::new();
        for (name, value) in tables.table.into_iter().flatten() {
            let path: Vec<String> = tables.path.iter().chain([name]).cloned().collect();
            let Some(table) = value.as_table() else {
                tables.problem(&[name.as_str()], format!("must be a table; write [{}]", told(&path)));
                continue;
            };
            let section = Section { table: Some(table), path, log: self.log, asked: RefCell::default() };
            results.extend(read(&section));
        }
        tables.forgive();
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
            Section { table: value.as_table(), path, log: self.log, asked: RefCell::default() }
        });
        numbered.filter_map(|section| read(&section)).collect()
    }

    /// Reports what is wrong with the value at a path below this table, as found in the file.
    pub fn problem(&self, below: &[&str], words: String) {
        let mut value = None;
        let mut table = self.table;
        for name in below {
            value = table.and_then(|table| table.get(*name));
            table = value.and_then(Value::as_table);
        }
        self.record(below, value.filter(|value| !value.is_table()), words);
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

    fn get(&self, key: &'static str) -> Option<&'a Value> {
        let mut asked = self.asked.borrow_mut();
        if !asked.contains(&key) {
            asked.push(key);
        }
        self.table.and_then(|table| table.get(key))
    }

    fn child(&self, key: &str) -> Vec<String> {
        self.path.iter().cloned().chain([key.to_owned()]).collect()
    }

    fn checked<T>(&self, key: &str, value: &Value, read: impl Fn(&Value) -> Result<T, String>) -> Option<T> {
        read(value).map_err(|words| self.record(&[key], Some(value), words)).ok()
    }

    fn record(&self, below: &[&str], value: Option<&Value>, words: String) {
        let path: Vec<String> = self.path.iter().cloned().chain(below.iter().map(|name| (*name).to_owned())).collect();
        let mut log = self.log.borrow_mut();
        let from_command_line = log.overridden.iter().any(|overridden| path.starts_with(overridden));
        let source = if from_command_line { " (--set)" } else { "" };
        let value = value.map(|value| format!("{}{source}", quoted(value)));
        log.problems.push(Problem { key: told(&path), value, words });
    }

    /// Lets any key stand: this table holds names that the user chose.
    fn forgive(mut self) {
        self.table = None;
    }
}

impl Drop for Section<'_> {
    fn drop(&mut self) {
        let asked = self.asked.take();
        for (name, value) in self.table.into_iter().flatten().filter(|(name, _)| !asked.contains(&name.as_str())) {
            let remedy = suggest(name, asked.iter().copied());
            let quotes = if value.is_table() { " (a name that holds dots stands in quotes)" } else { "" };
            let key = told(&self.child(name));
            self.log.borrow_mut().problems.push(Problem::unknown(key, &format!("{remedy}{quotes}")));
        }
    }
}
