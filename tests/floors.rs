//! Imports go down only: reads every path in `src` and finds those that go up a floor, and cycles of imports among the files
//! and folders of a module, or by way of the file of their folder. No two types bear one name.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// Modules and their floors. A module imports from lower floors and from itself.
const FLOORS: [(&str, u8); 20] = [
    ("petsc", 0),
    ("geometry", 0),
    ("origin", 0),
    ("accuracy", 1),
    ("element", 1),
    ("mesh", 2),
    ("body", 3),
    ("contact", 4),
    ("discretisation", 5),
    ("multigrid", 6),
    ("programme", 6),
    ("recovery", 6),
    ("system", 7),
    ("procedure", 8),
    ("case", 9),
    ("output", 9),
    ("arguments", 9),
    ("run", 10),
    ("study", 10),
    ("main", 11),
];

/// Modules of the kernels, which return values and never see PETSc.
const KERNELS: [&str; 6] = ["accuracy", "geometry", "element", "mesh", "body", "contact"];

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
        ("discretisation", "use crate::multigrid::Elastic;"),
        ("multigrid", "use crate::recovery::Evaluation;"),
        ("system", "use crate::procedure::Ending;"),
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
        ("main", "use mezha::run::{self, RunError};\nuse mezha::case::Case;"),
        ("element", "/// See crate::system.\nlet simple = not_crate::body();"),
    ] {
        assert_eq!(complaints(module, text), Vec::<String>::new(), "{module}: {text}");
    }
}

/// Parts of a module are its files and folders; what the module's own file defines is a part called `mod`. Imports of one
/// part from another, by the names that the module's file gives them.
struct Parts {
    /// Path of the module.
    module: Vec<String>,
    names: BTreeSet<String>,
    /// Part that each name comes from which the module's file takes from one of them.
    exported: BTreeMap<String, String>,
    imports: BTreeMap<String, BTreeSet<String>>,
}

const OWN: &str = "mod";

impl Parts {
    fn new(module: &[String], files: &[(Vec<String>, String)]) -> Self {
        let inside = files.iter().filter(|(path, _)| path.len() > module.len() && path.starts_with(module));
        let names: BTreeSet<String> = inside.map(|(path, _)| path[module.len()].clone()).collect();
        let own = files.iter().find(|(path, _)| path == module).map_or("", |(_, code)| code.as_str());
        let mut parts = Self { module: module.to_vec(), names, exported: BTreeMap::new(), imports: BTreeMap::new() };
        for statement in own.split(';').map(str::trim) {
            let (start, shown) = match statement.rsplit_once("use ") {
                Some((before, path)) if before.is_empty() || before.ends_with(['\n', ' ', ')']) => {
                    (path, before.trim_end().ends_with("pub") || before.trim_end().ends_with(')'))
                }
                _ => continue,
            };
            for path in trees(start) {
                if parts.names.contains(&path[0]) {
                    parts.exported.insert(path[path.len() - 1].clone(), path[0].clone());
                    if !shown {
                        parts.add(OWN, path[0].clone());
                    }
                }
            }
        }
        for (path, code) in files.iter().filter(|(path, _)| path.starts_with(module)) {
            let from = path.get(module.len()).map_or(OWN, String::as_str);
            let found: Vec<String> = absolute(path, code).iter().filter_map(|to| parts.part_of(to)).collect();
            for to in found {
                parts.add(from, to);
            }
        }
        parts
    }

    fn add(&mut self, from: &str, to: String) {
        if from != to {
            self.imports.entry(from.into()).or_default().insert(to);
        }
    }

    /// The part that a path leads to, if it leads into this module.
    fn part_of(&self, path: &[String]) -> Option<String> {
        let name = path.strip_prefix(self.module.as_slice())?.first()?;
        match (self.names.contains(name), self.exported.get(name)) {
            (true, _) => Some(name.clone()),
            (false, Some(part)) => Some(part.clone()),
            (false, None) => (name != "*").then(|| OWN.to_string()),
        }
    }

    /// Parts that import each other in a cycle.
    fn cycle(&self) -> Option<String> {
        let mut done = BTreeSet::new();
        self.imports.keys().find_map(|start| self.path_back(start, &mut Vec::new(), &mut done))
    }

    fn path_back(&self, at: &str, path: &mut Vec<String>, done: &mut BTreeSet<String>) -> Option<String> {
        if let Some(first) = path.iter().position(|part| part == at) {
            return Some(format!("{}: {} → {at}", self.module.join("::"), path[first..].join(" → ")));
        }
        if done.contains(at) {
            return None;
        }
        path.push(at.into());
        let found = self.imports.get(at).into_iter().flatten().find_map(|next| self.path_back(next, path, done));
        path.pop();
        done.insert(at.into());
        found
    }
}

/// Every path of a use tree such as `a::{B, c::D as E}`, up to its end.
fn trees(text: &str) -> Vec<Vec<String>> {
    let (mut open, mut path, mut name, mut found) = (Vec::new(), Vec::new(), String::new(), Vec::new());
    let mut characters = text.chars().peekable();
    loop {
        let next = characters.next();
        match next {
            Some(c) if c.is_alphanumeric() || c == '_' || c == '*' => name.push(c),
            Some(':') if characters.peek() == Some(&':') => {
                characters.next();
                path.push(std::mem::take(&mut name));
            }
            Some('{') if name.is_empty() && !path.is_empty() => open.push(path.len()),
            Some(c) if c.is_whitespace() && name.is_empty() && !open.is_empty() => {}
            Some(',' | '}') if !open.is_empty() => {
                if !name.is_empty() {
                    path.push(std::mem::take(&mut name));
                    found.push(path.clone());
                }
                if next == Some('}') {
                    path.truncate(open.pop().unwrap_or(0));
                    if open.is_empty() {
                        return found;
                    }
                }
                path.truncate(*open.last().unwrap_or(&0));
            }
            _ => {
                if !name.is_empty() {
                    path.push(name);
                }
                if open.is_empty() && !path.is_empty() {
                    found.push(path);
                }
                return found;
            }
        }
    }
}

/// Every path of a file that begins with `crate`, `super` or `self`, from the root of the crate on.
fn absolute(module: &[String], code: &str) -> Vec<Vec<String>> {
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    let mut found = Vec::new();
    for start in ["crate::", "super::", "self::"] {
        for (at, _) in code.match_indices(start) {
            if code[..at].ends_with(|c: char| is_word(c) || c == ':') {
                continue;
            }
            for path in trees(&code[at..]) {
                let supers = path.iter().take_while(|name| *name == "super").count();
                let base = if path[0] == "crate" { &[] } else { &module[..module.len() - supers.min(module.len())] };
                let rest = path.iter().skip(supers.max(usize::from(path[0] != "super")));
                found.push(base.iter().chain(rest).cloned().collect());
            }
        }
    }
    found
}

/// Every file of the library by its module, without its tests and comments.
fn modules() -> Vec<(Vec<String>, String)> {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let module = |file: &PathBuf| -> Vec<String> {
        let below = file.strip_prefix(&src).expect("a file below src").with_extension("");
        let names = below.components().map(|name| name.as_os_str().to_string_lossy().into_owned());
        names.filter(|name| name != "mod").collect()
    };
    let text = |file: &PathBuf| {
        let code = code(&std::fs::read_to_string(file).expect("a file can be read"));
        code.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default().to_string()
    };
    let all = files(&src).into_iter().filter(|file| !file.ends_with("tests.rs"));
    all.map(|file| (module(&file), text(&file))).collect()
}

fn cycles(files: &[(Vec<String>, String)]) -> Vec<String> {
    let parents: BTreeSet<&[String]> = files.iter().flat_map(|(path, _)| (1..path.len()).map(|end| &path[..end])).collect();
    parents.into_iter().filter_map(|module| Parts::new(module, files).cycle()).collect()
}

#[test]
fn parts_of_a_module_import_each_other_in_no_cycle() {
    let found = cycles(&modules());
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn a_cycle_is_found_however_it_is_written() {
    let file = |path: &str, code: &str| (path.split("::").map(String::from).collect::<Vec<_>>(), code.to_string());
    let own = "mod a;\nmod b;\npub use a::{One, Other};\npub use b::two;\n";
    for (a, b, own) in [
        ("use super::b::two;", "use super::a::One;", own),
        ("use crate::m::two;", "use super::One;", own),
        ("fn f() { crate::m::two() }", "use super::{\n    Other,\n    One,\n};", own),
        ("use super::two;", "fn f() -> super::One {}", own),
        ("use super::Own;", "", "mod a;\nmod b;\nuse a::One;\npub struct Own(One);\n"),
    ] {
        assert_eq!(cycles(&[file("m", own), file("m::a", a), file("m::b", b)]).len(), 1, "{a} {b}");
    }
    let deep = [file("m", own), file("m::a::c", "use crate::m::two;"), file("m::b::d", "use super::super::a::One;")];
    assert_eq!(cycles(&deep).len(), 1);
    let down = [file("m", own), file("m::a", "use super::two;\nuse crate::n::One;"), file("m::b", "use crate::n::{One, Other};")];
    assert_eq!(cycles(&down), Vec::<String>::new());
}

/// Names that files of a folder take from the file of the folder, which has them from other files of it.
fn roundabout(files: &[(Vec<String>, String)]) -> Vec<String> {
    let folders = files.iter().map(|(path, _)| path).filter(|path| !path.is_empty() && path[0] != "lib");
    let all: Vec<Parts> = folders.map(|path| Parts::new(path, files)).filter(|parts| !parts.names.is_empty()).collect();
    let mut found = Vec::new();
    for (path, code) in files {
        for parts in all.iter().filter(|parts| path.len() > parts.module.len() && path.starts_with(&parts.module)) {
            let through =
                absolute(path, code).into_iter().filter_map(|to| to.strip_prefix(parts.module.as_slice())?.first().cloned());
            let shown = through.filter(|name| !parts.names.contains(name) && parts.exported.contains_key(name));
            found.extend(shown.map(|name| format!("{} takes {name} from {}", path.join("::"), parts.module.join("::"))));
        }
    }
    found
}

#[test]
fn files_of_a_folder_import_from_each_other() {
    let found = roundabout(&modules());
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn an_import_through_the_file_of_the_folder_is_found() {
    let file = |path: &str, code: &str| (path.split("::").map(String::from).collect::<Vec<_>>(), code.to_string());
    let own = "mod a;\nmod b;\npub use a::One;\npub struct Own;\n";
    for code in ["use super::One;", "use crate::m::{One, Own};", "fn f() -> crate::m::One {}"] {
        assert_eq!(roundabout(&[file("m", own), file("m::a", ""), file("m::b", code)]), ["m::b takes One from m"], "{code}");
    }
    for code in ["use super::a::One;", "use super::Own;", "use crate::n::One;"] {
        assert_eq!(roundabout(&[file("m", own), file("m::a", ""), file("m::b", code)]), [""; 0], "{code}");
    }
}

/// What one module names of another, by the names under which that one shows it.
fn named(files: &[(Vec<String>, String)], user: &str, used: &str) -> BTreeSet<String> {
    let own = files.iter().filter(|(path, _)| path[0] == user);
    let paths = own.flat_map(|(path, code)| absolute(path, code));
    paths.filter(|path| path[0] == used && path.len() > 1).map(|path| path.join("::")).collect()
}

#[test]
fn a_run_names_few_items_of_what_solves_its_scene() {
    let solving = ["discretisation", "multigrid", "programme", "recovery", "system", "procedure"];
    let names: BTreeSet<String> = solving.iter().flat_map(|used| named(&modules(), "run", used)).collect();
    assert!(names.len() <= 12, "{}: {names:?}", names.len());
    assert!(names.contains("procedure::Procedure") && names.contains("recovery::Evaluation"), "{names:?}");
    assert!(!names.iter().any(|name| name.starts_with("multigrid") || name.starts_with("system")), "{names:?}");
}

/// Names of the types that a file defines: structs, enums, unions, traits and type aliases. Types that belong to an
/// implementation, such as `Output` of an operator, have no name of their own.
fn types(code: &str) -> Vec<&str> {
    let defined = code.lines().filter_map(|line| {
        let mut words = line.split_whitespace().skip_while(|word| word.starts_with("pub") || *word == "unsafe");
        let (kind, name) = (words.next()?, words.next()?);
        // Aliases that are indented belong to an implementation.
        let is_type = ["struct", "enum", "union", "trait"].contains(&kind) || kind == "type" && !line.starts_with(' ');
        is_type.then(|| name.split(|c: char| !c.is_alphanumeric() && c != '_').next().unwrap_or_default())
    });
    defined.collect()
}

/// Names that several types bear, with their modules.
fn shared_names(files: &[(Vec<String>, String)]) -> Vec<String> {
    let mut modules: BTreeMap<&str, Vec<String>> = BTreeMap::new();
    for (module, code) in files {
        types(code).into_iter().for_each(|name| modules.entry(name).or_default().push(module.join("::")));
    }
    let shared = modules.into_iter().filter(|(_, modules)| modules.len() > 1);
    shared.map(|(name, modules)| format!("{name}: {}", modules.join(", "))).collect()
}

#[test]
fn every_type_has_a_name_of_its_own() {
    let found = shared_names(&modules());
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn two_types_of_one_name_are_found_however_they_are_written() {
    let file = |path: &str, code: &str| (vec![path.to_string()], code.to_string());
    let own = file("a", "pub struct One<'a> {\n    one: One,\n}\nimpl Add for One {\n    type Output = One;\n}");
    for code in ["pub(super) enum One {", "struct One;", "pub struct One(f64);", "unsafe trait One: Other {", "type One<T> = T;"]
    {
        assert_eq!(shared_names(&[own.clone(), file("b", code)]), ["One: a, b"], "{code}");
    }
    for code in ["pub struct Two(One);", "impl Add for Two {\n    type Output = Two;\n}", "// struct One", "fn one() -> One {}"] {
        assert_eq!(shared_names(&[own.clone(), file("b", code)]), [""; 0], "{code}");
    }
}
