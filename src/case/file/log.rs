//! What is found while a file is read: everything that is wrong, and the defaults that were used.

use std::collections::HashMap;

use toml::Value;

use super::error::Problem;

/// What was found while reading a file.
#[derive(Default)]
pub struct Log {
    /// Everything that is wrong.
    pub problems: Vec<Problem>,
    /// Defaults that were used: path and value.
    pub defaults: Vec<(Vec<String>, Value)>,
    /// Paths that the command line has set.
    pub overridden: Vec<Vec<String>>,
    /// Paths of tables that patterns of the file have made, and where these are written.
    pub written: HashMap<Vec<String>, Vec<String>>,
}

impl Log {
    /// A path as the file has it: what is wrong with a table that stands for many is told once.
    pub fn as_written(&self, path: Vec<String>) -> Vec<String> {
        let made = (1..=path.len()).find_map(|end| Some((end, self.written.get(&path[..end])?)));
        made.map_or_else(|| path.clone(), |(end, written)| [written.as_slice(), &path[end..]].concat())
    }

    /// Adds a problem, once if a pattern has made tables of many.
    pub fn add(&mut self, problem: Problem) {
        if self.written.is_empty() || !self.problems.contains(&problem) {
            self.problems.push(problem);
        }
    }
}
