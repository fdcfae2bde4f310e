//! Tables whose names stand for several: one for each of these.

use super::wildcard::plain_letters;
use crate::case::file::error::{Problem, told};
use std::collections::{HashMap, HashSet};
use toml::{Table, Value};

/// A table that stands for several.
pub struct StandsFor {
    /// Its name in the file: a pattern, or that of a table that has patterns in it.
    pub name: String,
    /// The names of those that it stands for.
    pub names: Vec<String>,
    /// Whether its name is the pattern, which says more of a table than one with patterns in it.
    pub is_pattern: bool,
}

impl StandsFor {
    fn rank(&self) -> usize {
        if self.is_pattern { 1 + plain_letters(&self.name) } else { 0 }
    }
}

/// Tables without those that stand for several, each of which gives its keys to its own, in its place where they are not there
/// yet. Of two that give the same key the one with more letters of its own wins, and a table of the name itself over both.
/// A body with parts takes nothing. Two that are equal and say different things are a problem.
pub fn merged(path: &[String], tables: &Table, standing: &[StandsFor], problems: &mut Vec<Problem>) -> Table {
    let mut above: HashMap<&str, Vec<&StandsFor>> = HashMap::new();
    for one in standing {
        one.names.iter().for_each(|name| above.entry(name).or_default().push(one));
    }
    above.values_mut().for_each(|all| all.sort_by_key(|one| one.rank()));
    let gone: HashSet<&str> = standing.iter().map(|one| one.name.as_str()).collect();
    let above = |name: &str| above.get(name).map(Vec::as_slice).unwrap_or_default();
    let mut result = Table::new();
    for (name, value) in tables {
        if !gone.contains(name.as_str()) {
            let mut value = value.clone();
            if let Value::Table(own) = &mut value
                && !own.contains_key("part")
            {
                let mut all = given(path, name, Some(own), tables, above(name), problems);
                all.extend(std::mem::take(own));
                *own = all;
            }
            result.insert(name.clone(), value);
            continue;
        }
        for fresh in standing.iter().filter(|one| one.name == *name).flat_map(|one| &one.names) {
            if !tables.contains_key(fresh) && !result.contains_key(fresh) {
                result.insert(fresh.clone(), Value::Table(given(path, fresh, None, tables, above(fresh), problems)));
            }
        }
    }
    result
}

/// What tables that stand for several, those that say least first, give to one of them.
fn given(
    path: &[String],
    name: &str,
    own: Option<&Table>,
    tables: &Table,
    above: &[&StandsFor],
    problems: &mut Vec<Problem>,
) -> Table {
    let mut all = Table::new();
    let mut from: HashMap<&String, &StandsFor> = HashMap::new();
    for one in above {
        for (key, value) in tables.get(&one.name).and_then(Value::as_table).into_iter().flatten() {
            let other = from.insert(key, one).filter(|other| other.rank() == one.rank() && all.get(key) != Some(value));
            if let Some(other) = other.filter(|_| !own.is_some_and(|own| own.contains_key(key))) {
                let at = |names: &[&str]| told(&[path, &names.iter().map(|name| (*name).into()).collect::<Vec<_>>()].concat());
                let words = format!(
                    "{} and {} say different things of it; give \"{name}\" a table of its own, or make one pattern longer",
                    at(&[&other.name]),
                    at(&[&one.name])
                );
                problems.push(Problem { key: at(&[name, key]), value: None, words });
            }
            all.insert(key.clone(), value.clone());
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    fn standing(name: &str, names: &[&str]) -> StandsFor {
        StandsFor { name: name.into(), names: names.iter().map(|name| (*name).into()).collect(), is_pattern: true }
    }

    fn merge(text: &str, all: &[StandsFor]) -> (String, usize) {
        let mut problems = Vec::new();
        let tables: Table = text.parse().expect("TOML");
        let names: Vec<String> = ["body".to_owned()].into();
        (merged(&names, &tables, all, &mut problems).to_string(), problems.len())
    }

    #[test]
    fn what_says_more_wins_key_by_key() {
        let text = "[\"r*\"]\na = 1\nb = 1\nc = 1\n[r2]\nc = 3\n[\"*\"]\na = 0\nd = 0\n[s.part]\nx = 1";
        let all = [standing("r*", &["r1", "r2"]), standing("*", &["r1", "r2", "s"])];
        let wanted = "[r1]\na = 1\nd = 0\nb = 1\nc = 1\n\n[r2]\na = 1\nd = 0\nb = 1\nc = 3\n\n[s.part]\nx = 1\n";
        assert_eq!(merge(text, &all), (wanted.into(), 0));
    }

    #[test]
    fn equals_that_differ_are_a_problem_unless_the_name_itself_tells() {
        let all = || [standing("r*", &["r1"]), standing("*1", &["r1"])];
        assert_eq!(merge("\"r*\".a = 1\n\"*1\".a = 2", &all()).1, 1);
        assert_eq!(merge("\"r*\".a = 1\n\"*1\".a = 1", &all()).1, 0);
        assert_eq!(merge("\"r*\".a = 1\n\"*1\".a = 2\nr1.a = 3", &all()).1, 0);
    }
}
