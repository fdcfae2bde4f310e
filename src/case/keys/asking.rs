//! For tests: which keys readers have asked for.

use std::cell::RefCell;
use std::collections::BTreeSet;

use super::form::{KeyForm, TableForm};

thread_local! {
    /// Keys that readers have asked for, with the names of their tables.
    static ASKED: RefCell<BTreeSet<(&'static str, &'static str)>> = RefCell::default();
}

/// Remembers that a reader has asked for a key.
pub fn note(table: &TableForm, key: &KeyForm) {
    ASKED.with_borrow_mut(|asked| asked.insert((table.name, key.name)));
}

/// Keys of a file that no reader on this thread has asked for since this was asked last, with the names of their tables.
pub fn never_asked(file: &'static TableForm) -> Vec<(&'static str, &'static str)> {
    let asked = ASKED.take();
    let keys = tables(file).into_iter().flat_map(|table| table.all().map(|key| (table.name, key.name)));
    keys.filter(|key| !asked.contains(key)).collect()
}

/// Every table of a file, each once.
pub fn tables(file: &'static TableForm) -> Vec<&'static TableForm> {
    let mut found: Vec<&'static TableForm> = vec![file];
    let mut next = 0;
    while next < found.len() {
        for inner in found[next].all().filter_map(|key| key.value.table()) {
            if found.iter().all(|known| known.name != inner.name) {
                found.push(inner);
            }
        }
        next += 1;
    }
    found
}
