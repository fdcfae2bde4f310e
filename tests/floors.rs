//! Imports go down only: reads every path in `src` and finds those that go up a floor.

use std::path::{Path, PathBuf};

/// Modules and their floors. A module imports from lower floors, from itself, and from its own floor where
/// [`SIDEWAYS`] says so.
const FLOORS: [(&str, u8); 13] = [
    ("petsc", 0),
    ("geometry", 0),
    ("element", 1),
    ("mesh", 2),
    ("body", 3),
    ("contact", 4),
    ("system", 5),
    ("case", 6),
    ("output", 6),
    ("arguments", 6),
    ("run", 7),
    ("study", 7),
    ("main", 8),
];

/// Modules of the kernels, which return values and never see PETSc.
const KERNELS: [&str; 5] = ["geometry", "element", "mesh", "body", "contact"];

fn floor(module: &str) -> Option<u8> {
    FLOORS.iter().find(|(name, _)| *name == module).map(|(_, floor)| *floor)
}

/// The code of a file without comments; strings stay, doc comments go.
fn code(text: &str) -> String {
    text.lines().map(|line| line.split("//").next().unwrap_or_default()).collect::<Vec<_>>().join("\n")
}

/// First names of all paths that start with one of these prefixes; `crate::{a, b::c}` gives `a` and `b`.
fn imported(code: &str, prefix: &str) -> Vec<String> {
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    let mut names = Vec::new();
    for (at, _) in code.match_indices(prefix) {
        if code[..at].ends_with(is_word) {
            continue;
        }
        let rest = &code[at + prefix.len()..];
        match rest.strip_prefix('{') {
            None => names.push(rest.chars().take_while(|c| is_word(*c)).collect()),
            Some(list) => names.extend(first_names(list)),
        }
    }
    names
}

/// First names of the entries of a list, up to the brace that closes it.
fn first_names(list: &str) -> Vec<String> {
    let (mut depth, mut names, mut name) = (0, Vec::new(), String::new());
    let mut open = true;
    for c in list.chars() {
        match c {
            '{' => depth += 1,
            '}' if depth == 0 => break,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                names.push(std::mem::take(&mut name));
                open = true;
            }
            ':' | ' ' if !name.is_empty() => open = false,
            c if depth == 0 && open && !c.is_whitespace() => name.push(c),
            _ => {}
        }
    }
    names.push(name);
    names.into_iter().filter(|name| !name.is_empty()).collect()
}

/// Whether a word stands in the code as a whole.
fn has_word(code: &str, word: &str) -> bool {
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    code.match_indices(word).any(|(at, _)| {
        let (before, after) = (&code[..at], &code[at + word.len()..]);
        !before.ends_with(is_word) && !after.starts_with(is_word)
    })
}

/// Everything that a file of a module may not do.
fn complaints(module: &str, text: &str) -> Vec<String> {
    let code = code(text);
    let Some(own) = floor(module) else { return vec![format!("module {module} stands on no floor; give it one in FLOORS")] };
    let mut found = Vec::new();
    let mut names = imported(&code, "crate::");
    if module == "main" {
        names.extend(imported(&code, "mezha::"));
    }
    for name in names.iter().filter(|name| *name != module) {
        match floor(name) {
            Some(other) if other < own => {}
            Some(other) => found.push(format!("{module} (floor {own}) imports {name} (floor {other})")),
            None => found.push(format!("{module} imports crate::{name}, which stands on no floor")),
        }
        if name == "petsc" && KERNELS.contains(&module) {
            found.push(format!("{module} imports petsc"));
        }
        if name == "case" && module == "contact" {
            found.push("contact imports case".into());
        }
    }
    if module != "petsc" {
        if has_word(&code, "unsafe") {
            found.push(format!("{module} has unsafe code"));
        }
        let crates = imported(&code, "use ").into_iter().chain(imported(&code, "::"));
        if crates.into_iter().any(|name| name == "mpi") || code.contains("mpi::") {
            found.push(format!("{module} imports mpi"));
        }
    }
    found
}

/// Every Rust file below a folder.
fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path());
    let found = entries.flat_map(|path| if path.is_dir() { files(&path) } else { vec![path] });
    found.filter(|path| path.extension().is_some_and(|extension| extension == "rs")).collect()
}

#[test]
fn imports_go_down_only() {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut found = Vec::new();
    let all = files(&src);
    assert!(all.len() > 50, "{all:?}");
    for file in all.iter().filter(|file| **file != src.join("lib.rs")) {
        let below = file.strip_prefix(&src).expect("a file below src");
        let first = below.components().next().expect("a name").as_os_str().to_string_lossy().into_owned();
        let text = std::fs::read_to_string(file).expect("a file can be read");
        let module = first.trim_end_matches(".rs");
        found.extend(complaints(module, &text).into_iter().map(|words| format!("{}: {words}", below.display())));
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn the_library_lists_its_floors_from_the_ground_up() {
    let text = include_str!("../src/lib.rs");
    let code = code(text);
    let listed: Vec<&str> = code.lines().filter_map(|line| line.strip_prefix("pub mod ")?.strip_suffix(';')).collect();
    let named: Vec<&str> = FLOORS.iter().map(|(name, _)| *name).filter(|name| *name != "main").collect();
    assert_eq!(listed.len(), named.len(), "{listed:?}");
    let floors: Vec<u8> = listed.iter().map(|name| floor(name).expect("a floor")).collect();
    assert!(floors.is_sorted(), "{listed:?}");
    assert!(text.contains("#![deny(unsafe_code)]"));
    assert_eq!(text.matches("#[allow(unsafe_code)]\npub mod petsc;").count(), 1);
    assert_eq!(text.matches("allow(unsafe_code)").count(), 1);
}

#[test]
fn an_upward_import_is_found_however_it_is_written() {
    for (module, text) in [
        ("mesh", "use crate::body::Body;"),
        ("mesh", "fn f() -> crate::system::Scene {}"),
        ("contact", "use crate::{geometry::Point, case::Case};"),
        ("contact", "use crate::{\n    geometry::{Point, cross},\n    system::{Scene, Space},\n};"),
        ("body", "pub use crate::petsc::Vector;"),
        ("geometry", "use crate::petsc::Vector;"),
        ("petsc", "use crate::geometry::Point;"),
        ("case", "use crate::output::Summary;"),
        ("system", "use mpi::topology::Communicator;"),
        ("system", "let world = ::mpi::initialize();"),
        ("run", "unsafe { f() }"),
        ("novelty", ""),
        ("mesh", "use crate::novelty::Thing;"),
        ("run", "use crate::main;"),
    ] {
        assert!(!complaints(module, text).is_empty(), "{module}: {text}");
    }
}

#[test]
fn a_downward_import_is_none_of_its_business() {
    for (module, text) in [
        ("system", "use crate::petsc::{Matrix, Vector};\nuse crate::{body, contact::{Pair, Law}};"),
        ("mesh", "// use crate::body::Body; unsafe\nuse crate::geometry::Point;\nuse crate::mesh::lattice;"),
        ("petsc", "use mpi::ffi;\nunsafe { f() }"),
        ("main", "use mezha::run::{self, Outcome};\nuse mezha::case::Case;"),
        ("element", "/// See crate::system.\nlet simple = not_crate::body();"),
    ] {
        assert_eq!(complaints(module, text), Vec::<String>::new(), "{module}: {text}");
    }
}
