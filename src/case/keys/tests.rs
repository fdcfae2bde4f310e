//! A table is declared, and read; and which keys readers have asked for.

use std::cell::RefCell;
use std::collections::BTreeSet;

use toml::Table;

use super::*;
use crate::case::file::error::Log;

declare! {
    /// A table whose comment
    /// has two lines.
    static TRIED = table("tried").inline();
    ..FIRST;
    /// How many, in "words".
    const COUNTED: usize = key("counted", whole(1, 3)).or("2").unit("pieces");
    ..LAST;
}

declare! {
    group FIRST;
    const NAMED: Vec<String> = key("named", NAMES).required("\"a\"");
}

declare! {
    group LAST;
    /// One or both.
    const BOTH: [f64; 2] = key("both", either(ONE_OR_BOTH, "a number, or two"));
}

const ONE_OR_BOTH: &[ValueForm] = &[NUMBER.value, POINT.value];

/// What is read of a text, and what the log says of it.
fn read<T>(text: &str, read: impl Fn(&Section) -> T) -> (T, Vec<String>) {
    let table: Table = text.parse().expect("TOML");
    let log = RefCell::new(Log::default());
    let found = read(&Section::root(&table, &TRIED, &log));
    (found, log.into_inner().problems.iter().map(ToString::to_string).collect())
}

#[test]
fn comments_are_meanings_and_keys_stand_in_their_order() {
    let keys: Vec<(&str, &str, &str)> = TRIED.all().map(|key| (key.name, key.sentence, key.unit)).collect();
    assert_eq!(keys, [("named", "", ""), ("counted", "How many, in \"words\".", "pieces"), ("both", "One or both.", "")]);
    assert_eq!((TRIED.sentence, TRIED.inline), ("A table whose comment has two lines.", true));
}

#[test]
fn values_are_read_by_the_type_of_their_key() {
    let all = |section: &Section| (section.required(NAMED), section.or(COUNTED), section.optional(BOTH));
    let names = || Some(vec!["a".to_owned()]);
    assert_eq!(read("named = 'a'\nboth = 3", all), ((names(), Some(2), Some([3.0, 3.0])), vec![]));
    assert_eq!(read("named = ['a']\ncounted = 1\nboth = [3, 4]", all), ((names(), Some(1), Some([3.0, 4.0])), vec![]));
    let (found, words) = read("counted = 9\nboth = [1, 2, 3]", all);
    assert_eq!(found, (None, None, None));
    let wanted =
        ["named: missing; write named = \"a\"", "counted = 9: must be a whole number from 1 to 3", "both = [1, 2, 3]: must be"];
    assert!(words.len() == 3 && words.iter().zip(wanted).all(|(words, wanted)| words.starts_with(wanted)), "{words:?}");
}

#[test]
fn a_default_stands_in_the_place_of_a_bad_value() {
    let (found, words) = read("named = 'a'\ncounted = 'many'", |section| {
        section.required(NAMED);
        (section.or_default(COUNTED), section.optional(BOTH))
    });
    assert_eq!((found, words.len()), ((2, None), 1), "{words:?}");
}

#[test]
#[should_panic(expected = "other is no key of a tried")]
fn a_key_that_is_not_in_the_table_cannot_be_asked_for() {
    read("", |section| section.optional(key("other", NUMBER)));
}

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
