//! A case on its way to one without patterns: what names and values they give way to.

use super::merging::{StandsFor, merged};
use super::mesh_names::{MeshNames, point};
use super::wildcard::{is_pattern, is_pattern_of, matches};
use crate::case::file::error::{Log, Problem, dotted, listed, quoted, told};
use crate::case::file::overrides::{read_key, set_value, value_at};
use crate::geometry::Quote;
use std::collections::{HashMap, HashSet};
use toml::{Table, Value};

/// What a pattern of a case has matched.
#[derive(Clone, Debug, PartialEq)]
pub struct Matched {
    /// Where it stands, as `support.cage.body = "roller*"` or `body."roller*"`.
    pub place: String,
    /// What it stands for, one of them in words: body, physical curve, contact.
    pub kind: &'static str,
    /// Their names.
    pub names: Vec<String>,
}

/// A case on its way to one without patterns.
pub struct Expansion<'a> {
    pub table: Table,
    pub matched: Vec<Matched>,
    /// Tables of supports, loads and contacts that have patterns in them, with those that they stand for.
    pub standing: HashMap<String, Vec<StandsFor>>,
    pub log: &'a mut Log,
}

impl Expansion<'_> {
    pub fn problem(&mut self, path: &[&str], value: Option<&Value>, words: impl Into<String>) {
        let words = words.into();
        self.log.problems.push(Problem { key: told(path), value: value.map(quoted), words });
    }

    /// The names that a pattern at a key stands for; one that stands for none is a problem.
    pub fn matching(&mut self, path: &[&str], pattern: &str, known: &[String], kind: &'static str) -> Vec<String> {
        let names: Vec<String> = known.iter().filter(|name| matches(pattern, name)).cloned().collect();
        if names.is_empty() {
            let there = known.iter().map(|name| format!("\"{}\"", Quote(name)));
            let there = if known.is_empty() { "there is none".into() } else { format!("there are {}", listed(there)) };
            let words = format!("no {kind} has a name like \"{}\"; {there}", Quote(pattern));
            self.problem(path, None, words);
        } else {
            let is_key = path.last() == Some(&pattern);
            let place = if is_key { told(path) } else { format!("{} = \"{}\"", told(path), Quote(pattern)) };
            self.matched.push(Matched { place, kind, names: names.clone() });
        }
        names
    }

    /// Names of tables of a kind that stand for themselves.
    pub fn own_names(&self, kind: &str) -> Vec<String> {
        let standing: HashSet<&String> = self.standing.get(kind).into_iter().flatten().map(|one| &one.name).collect();
        let names = table_at(&self.table, &[kind]).into_iter().flat_map(Table::keys);
        names.filter(|name| !standing.contains(name) && !is_pattern(name)).cloned().collect()
    }

    /// What a table that has patterns in it stands for.
    fn stands_for(&self, kind: &str, name: &str) -> Option<Vec<String>> {
        let one = self.standing.get(kind).into_iter().flatten().find(|one| one.name == name);
        one.map(|one| one.names.clone())
    }

    /// The value of a key in each table of a kind that has it, with the name of the table.
    fn values(&self, kind: &str, key: &str) -> Vec<(String, Value)> {
        let tables = table_at(&self.table, &[kind]).into_iter().flatten();
        tables.filter_map(|(name, table)| Some((name.clone(), table.get(key)?.clone()))).collect()
    }

    /// Writes another value in the place of one.
    fn replace(&mut self, path: [&str; 3], value: Value) {
        set_value(&mut self.table, &path.map(str::to_owned), value).expect("a value stands there already");
    }

    /// Tables whose names are patterns, or of tables with patterns in them, become tables of what they stand for.
    pub fn write_out_names(&mut self, path: &[&str], known: &[String], kind: &'static str) {
        let Some(tables) = table_at(&self.table, path).cloned() else { return };
        let of_kind = path[path.len() - 1];
        let mut standing = Vec::new();
        let own: HashSet<&String> = known.iter().collect();
        for name in tables.keys().filter(|name| !own.contains(name)) {
            let (names, is_pattern) = match self.stands_for(of_kind, name) {
                Some(names) => (names, false),
                None if is_pattern(name) => (self.matching(&[path, &[name]].concat(), name, known, kind), true),
                None => continue,
            };
            standing.push(StandsFor { name: name.clone(), names, is_pattern });
        }
        if standing.is_empty() {
            return;
        }
        let path: Vec<String> = path.iter().map(|name| (*name).to_owned()).collect();
        let mut result = merged(&path, &tables, &standing, &mut self.log.problems);
        for one in &standing {
            let written = [path.as_slice(), std::slice::from_ref(&one.name)].concat();
            self.set_again(&written, one, &mut result);
            for name in one.names.iter().filter(|name| !tables.contains_key(*name) || !one.is_pattern) {
                self.log.written.entry([path.as_slice(), std::slice::from_ref(name)].concat()).or_insert(written.clone());
            }
        }
        *table_at_mut(&mut self.table, &path) = result;
    }

    /// What the command line says of a pattern holds for tables of one's own name, too, unless it speaks of these.
    pub fn set_again(&self, written: &[String], one: &StandsFor, tables: &mut Table) {
        let depth = written.len();
        for path in self.log.overridden.iter().filter(|path| path.len() > depth && path.starts_with(written)) {
            let Some(value) = value_at(&self.table, path) else { continue };
            for name in &one.names {
                let own = [&path[..depth - 1], std::slice::from_ref(name), &path[depth..]].concat();
                if one.is_pattern && !self.log.overridden.contains(&own) {
                    _ = set_value(tables, &own[depth - 1..], value.clone());
                }
            }
        }
    }

    /// Values that are names, or lists of them.
    pub fn write_out_values(&mut self, kind: &'static str, key: &'static str, known: &[String], what: &'static str) {
        for (name, value) in self.values(kind, key) {
            if strings(&value).into_iter().any(is_pattern) {
                let path = [kind, &name, key];
                let names = self.names(&path, &value, known, what);
                self.replace(path, names.into());
            }
        }
    }

    /// Names of a value with those that its patterns stand for, each of these once.
    pub fn names(&mut self, path: &[&str], value: &Value, known: &[String], kind: &'static str) -> Vec<String> {
        let mut names: Vec<String> = Vec::new();
        for name in strings(value) {
            if !is_pattern_of(known, name) {
                names.push(name.into());
                continue;
            }
            let seen: HashSet<String> = names.iter().cloned().collect();
            names.extend(self.matching(path, name, known, kind).into_iter().filter(|name| !seen.contains(name)));
        }
        names
    }

    /// A probe asks the body that has its point.
    pub fn write_out_probes(&mut self, mesh: &MeshNames) {
        for (name, value) in self.values("probe", "body") {
            let Some(pattern) = value.as_str().filter(|text| is_pattern_of(&mesh.mesh.bodies, text)) else { continue };
            let path = ["probe", name.as_str(), "body"];
            let all = self.matching(&path, pattern, &mesh.mesh.bodies, "body");
            let point = table_at(&self.table, &path[..2]).and_then(|probe| point(probe.get("point")?));
            let holding = point.map_or_else(Vec::new, |point| mesh.holding(&all, point));
            match &holding[..] {
                [body] => self.replace(path, body.as_str().into()),
                [] if all.is_empty() || point.is_none() => {}
                [] => self.problem(&path, Some(&value), "none of these bodies has the point of the probe; move it inside"),
                [first, second, ..] => {
                    let words = format!("\"{first}\" and \"{second}\" touch at the point of the probe; name one of them");
                    self.problem(&path, Some(&value), words);
                }
            }
        }
    }

    /// Keys that load steps scale: those of all tables that a name stands for.
    pub fn write_out_scales(&mut self) {
        for (name, value) in self.values("steps", "scales") {
            let path = ["steps", name.as_str(), "scales"];
            let mut scales: Vec<String> = Vec::new();
            for key in strings(&value) {
                let parts = read_key(key).unwrap_or_default();
                let known = parts.first().map(|kind| keys_of(&self.table, kind)).unwrap_or_default();
                let names = match &parts[..] {
                    [kind, of, ..] if is_pattern_of(&known, of) && self.stands_for(kind, of).is_none() => {
                        Some(self.matching(&path, of, &known, "table"))
                    }
                    [kind, of, ..] => self.stands_for(kind, of),
                    _ => None,
                };
                match names {
                    None => scales.push(key.into()),
                    Some(names) => {
                        scales.extend(names.into_iter().map(|name| dotted(&[&parts[..1], &[name], &parts[2..]].concat())))
                    }
                }
            }
            if strings(&value) != scales {
                self.replace(path, scales.into());
            }
        }
    }
}

/// All strings of a value, and of lists in it.
pub fn strings(value: &Value) -> Vec<&str> {
    match value {
        Value::String(text) => vec![text],
        Value::Array(list) => list.iter().flat_map(strings).collect(),
        _ => Vec::new(),
    }
}

pub fn table_at<'t>(table: &'t Table, path: &[&str]) -> Option<&'t Table> {
    path.iter().try_fold(table, |table, name| table.get(*name)?.as_table())
}

/// The table at a path, which is there.
pub fn table_at_mut<'t>(table: &'t mut Table, path: &[String]) -> &'t mut Table {
    path.iter().fold(table, |table, name| table.get_mut(name).and_then(Value::as_table_mut).expect("a table that was read"))
}

pub fn keys_of(table: &Table, kind: &str) -> Vec<String> {
    table_at(table, &[kind]).into_iter().flat_map(Table::keys).cloned().collect()
}
