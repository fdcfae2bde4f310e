//! JSON Schema and program say the same of case and study files, for they are made of one table.
//!
//! `MEZHA_WRITE=1` writes the schemas anew. `MEZHA_PYTHON` names an interpreter with `jsonschema`, an independent reader of the
//! schemas; without it the test that wants it says so and checks nothing. `MEZHA_SCHEMA_MUTANTS` is the number of changed files that
//! are looked at, `MEZHA_SCHEMA_FROM` the number of the first one.

#[path = "fuzz/mutate.rs"]
mod mutate;

use mezha::case::Case;
use mezha::case::schema::{self, TableForm};
use mezha::study::Plan;
use mutate::{Random, mutated};
use serde_json::json;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use toml::{Table, Value};

/// Changed files that are looked at where nothing else is asked for.
const MUTANTS: u64 = 3000;

/// What people write, and the schema of each kind.
const KINDS: [(&str, &TableForm, &str); 2] =
    [("case", &schema::CASE, "docs/case.schema.json"), ("study", &schema::STUDY, "docs/study.schema.json")];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// All files of TOML that come with mezha, with the kind of each.
fn files() -> Vec<(&'static str, PathBuf)> {
    let of = |folder: PathBuf| fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path());
    let docs = ["docs/first", "docs/paper"].map(|folder| root().join(folder));
    let folders = of(root().join("cases")).filter(|path| path.is_dir()).chain(docs);
    let mut files: Vec<PathBuf> = folders.flat_map(of).filter(|path| path.extension().is_some_and(|end| end == "toml")).collect();
    files.sort();
    let of_studies = |folder: &Path| folder.ends_with("studies") || folder.ends_with("paper");
    let is_study = |file: &Path| file.ends_with("study.toml") || file.parent().is_some_and(of_studies);
    files.into_iter().map(|file| (if is_study(&file) { "study" } else { "case" }, file)).collect()
}

/// The file has this text; it is written if that is asked for.
fn holds(file: &Path, text: &str) {
    if std::env::var_os("MEZHA_WRITE").is_some() {
        fs::write(file, text).expect("a file can be written");
    }
    let found = fs::read_to_string(file).unwrap_or_default();
    assert!(found == text, "{} is old; MEZHA_WRITE=1 cargo test --release --test whole schema:: writes it anew", file.display());
}

#[test]
fn schemas_are_made_of_the_table_of_keys() {
    for (_, table, file) in KINDS {
        holds(&root().join(file), &format!("{}\n", schema::json(table)));
    }
}

/// `mezha schema` prints what is checked in.
#[test]
fn the_command_prints_the_schemas() {
    for (words, file) in [(&["schema"][..], KINDS[0].2), (&["schema", "case"], KINDS[0].2), (&["schema", "study"], KINDS[1].2)] {
        let output = Command::new(env!("CARGO_BIN_EXE_mezha")).args(words).output().expect("mezha starts");
        let expected = fs::read_to_string(root().join(file)).expect("a schema");
        assert!(output.status.success() && output.stdout == expected.as_bytes(), "{words:?}: {output:?}");
    }
}

/// Editors find the schema by the first line.
#[test]
fn every_file_names_its_schema() {
    for (kind, file) in files() {
        let text = fs::read_to_string(&file).expect("a file");
        let named = text.lines().next().and_then(|line| line.strip_prefix("#:schema ")).unwrap_or_default();
        let schema = file.parent().expect("a folder").join(named);
        let meant = KINDS.iter().find(|known| known.0 == kind).map(|known| root().join(known.2));
        assert_eq!(schema.canonicalize().ok(), meant.and_then(|meant| meant.canonicalize().ok()), "{}", file.display());
    }
}

/// Files of one kind, and how the program reads them.
struct Corpus {
    kind: &'static str,
    table: &'static TableForm,
    texts: Vec<Vec<u8>>,
    /// Values that stand somewhere.
    values: Vec<Value>,
}

impl Corpus {
    fn new(kind: &'static str, table: &'static TableForm) -> Self {
        let texts: Vec<Vec<u8>> =
            files().iter().filter(|file| file.0 == kind).map(|file| fs::read(&file.1).expect("a file")).collect();
        let mut values: Vec<Value> = bad_keys().map(|(_, value)| value).collect();
        for text in &texts {
            let table: Table = toml::from_str(&String::from_utf8_lossy(text)).expect("a good file");
            collect(&Value::Table(table), &mut values);
        }
        Self { kind, table, texts, values }
    }

    /// Whether the program takes a text.
    fn accepts(&self, text: &str) -> bool {
        match self.kind {
            "case" => Case::parse(text, Path::new("cases/bars/case.toml"), &[]).is_ok(),
            _ => Plan::parse(text, &root().join("cases/bars_inclined/study.toml"), &[]).is_ok(),
        }
    }

    /// What the program says of a text, for the other reader.
    fn line(&self, text: &str, explain: bool) -> String {
        let form = has_form(self.table, text);
        let accepts = self.accepts(text);
        format!("{}\n", json!({ "kind": self.kind, "text": text, "accepts": accepts, "form": form, "explain": explain }))
    }

    /// A file with some keys left out, put in, renamed, or set to values that stand elsewhere.
    fn changed(&self, random: &mut Random) -> String {
        let text = &self.texts[random.below(self.texts.len())];
        let mut table: Table = toml::from_str(&String::from_utf8_lossy(text)).expect("a good file");
        for _ in 0..=random.below(3) {
            self.change(&mut table, random);
        }
        table.to_string()
    }

    fn change(&self, table: &mut Table, random: &mut Random) {
        let names: Vec<String> = table.keys().cloned().collect();
        let Some(name) = names.get(random.below(names.len().max(1))) else { return };
        let inner = table.get_mut(name).and_then(Value::as_table_mut).filter(|inner| !inner.is_empty());
        if let Some(inner) = inner.filter(|_| random.below(8) > 0) {
            return self.change(inner, random);
        }
        let value = self.values[random.below(self.values.len())].clone();
        let known = self.names();
        match random.below(5) {
            0 => drop(table.remove(name)),
            1 => drop(table.insert(known[random.below(known.len())].into(), value)),
            2 => {
                let moved = table.remove(name).expect("a key that is there");
                table.insert(known[random.below(known.len())].into(), moved);
            }
            _ => drop(table.insert(name.clone(), value)),
        }
    }

    /// Names of keys, and a few that are none.
    fn names(&self) -> Vec<&'static str> {
        const NAMES: [&str; 24] = [
            "young",
            "at",
            "on",
            "body",
            "force",
            "moment",
            "ux",
            "uy",
            "normal",
            "angle",
            "about",
            "rigid",
            "mean",
            "stiffness",
            "part",
            "circle",
            "line",
            "x",
            "points",
            "ratio",
            "between",
            "contact",
            "a/b",
            "",
        ];
        self.table.all().map(|key| key.name).chain(NAMES).collect()
    }
}

/// Whether a text has the form of a table, if it is TOML at all.
fn has_form(table: &TableForm, text: &str) -> Option<bool> {
    toml::from_str(text).ok().map(|file| table.faults(&file).is_empty())
}

/// All values below one.
fn collect(value: &Value, found: &mut Vec<Value>) {
    match value {
        Value::Table(table) => table.values().for_each(|value| collect(value, found)),
        Value::Array(list) => list.iter().for_each(|value| collect(value, found)),
        _ => {}
    }
    found.push(value.clone());
}

/// Keys and bad values of the table of bad inputs.
fn bad_keys() -> impl Iterator<Item = (&'static str, Value)> {
    let rows = include_str!("mpi/inputs/keys.txt").lines().filter(|line| !line.starts_with('#'));
    rows.map(|line| {
        let mut parts = line.split(" | ");
        let (key, value) = (parts.next().expect("a key"), parts.next().expect("a value"));
        (key, value.parse().unwrap_or_else(|_| Value::from(value)))
    })
}

/// A scene in which nothing is wrong with one key of it set to something bad.
fn bad_cases() -> Vec<String> {
    let good: Table = toml::from_str(crate::support::mesh::GOOD).expect("a good case");
    let set = |(key, value): (&str, Value)| {
        let path: Table = toml::from_str(&format!("{key} = 0")).expect("a key");
        let mut table = good.clone();
        put(&mut table, &path, &value);
        table.to_string()
    };
    bad_keys().map(set).collect()
}

/// Puts a value where a table with one key at a time ends.
fn put(table: &mut Table, path: &Table, value: &Value) {
    let (name, below) = path.iter().next().expect("a name");
    match below {
        Value::Table(below) => {
            let inner = table.entry(name.clone()).or_insert_with(|| Value::Table(Table::new()));
            if let Some(inner) = inner.as_table_mut() {
                put(inner, below, value);
            }
        }
        _ => drop(table.insert(name.clone(), value.clone())),
    }
}

/// Neither refuses what the other takes, as far as the form goes: the files of the project, the table of bad inputs, and changed files
/// of both kinds, changed letter by letter and key by key.
#[test]
fn an_independent_reader_of_the_schemas_agrees_with_the_program() {
    let Some(python) = std::env::var_os("MEZHA_PYTHON") else {
        eprintln!("MEZHA_PYTHON is not set: schemas are not compared with the program");
        return;
    };
    let number = |name: &str| std::env::var(name).ok().and_then(|text| text.parse::<u64>().ok());
    let (mutants, from) = (number("MEZHA_SCHEMA_MUTANTS").unwrap_or(MUTANTS), number("MEZHA_SCHEMA_FROM").unwrap_or(0));
    let schemas = KINDS.map(|(kind, _, file)| format!("{kind}={}", root().join(file).display()));
    let mut reader = Command::new(python)
        .arg(root().join("tests/schema.py"))
        .args(schemas)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the interpreter of MEZHA_PYTHON starts");
    let [cases, studies] = [0, 1].map(|k| Corpus::new(KINDS[k].0, KINDS[k].1));
    let lines = {
        let whole = [&cases, &studies].into_iter().flat_map(|corpus| {
            corpus.texts.iter().map(|text| {
                let text = String::from_utf8_lossy(text);
                assert_eq!(has_form(corpus.table, &text), Some(true), "{text}");
                corpus.line(&text, true)
            })
        });
        let bad = bad_cases().into_iter().map(|text| cases.line(&text, true));
        let changed = (from..from + mutants).map(|number| {
            let mut random = Random(number.wrapping_mul(0x9e37_79b9_7f4a_7c15));
            let corpus = if number % 8 == 7 { &studies } else { &cases };
            let text = match number / 8 % 2 {
                0 => String::from_utf8_lossy(&mutated(&corpus.texts, &mut random)).into_owned(),
                _ => corpus.changed(&mut random),
            };
            corpus.line(&text, false)
        });
        whole.chain(bad).chain(changed)
    };
    let mut input = reader.stdin.take().expect("a pipe");
    for line in lines {
        if input.write_all(line.as_bytes()).is_err() {
            break; // The reader has ended, and says why.
        }
    }
    drop(input);
    let output = reader.wait_with_output().expect("the reader ends");
    let words = String::from_utf8_lossy(&output.stdout);
    println!("{words}");
    assert!(output.status.success(), "{words}{}", String::from_utf8_lossy(&output.stderr));
}
