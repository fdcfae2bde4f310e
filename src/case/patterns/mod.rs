//! Patterns wherever a name of a body, a boundary or a contact stands: the case with all of them written out.
//!
//! What is read afterwards has no patterns, so that a case with them is the one that somebody would have written by hand, to the
//! last digit, and the resolved case says what they stood for.

mod expansion;
mod merging;
mod mesh_names;
mod spreading;
mod wildcard;

pub use expansion::Matched;

use super::file::error::Log;
use crate::mesh::{parse_gmsh, surfaces};
use expansion::{Expansion, strings, table_at};
use mesh_names::MeshNames;
use std::collections::HashMap;
use std::path::Path;
use toml::{Table, Value};
use wildcard::is_pattern;

/// Reads the bytes of a mesh by its path, or says why not.
pub type ReadMesh<'a> = &'a dyn Fn(&Path) -> Result<Vec<u8>, String>;

/// Tables with names of bodies and contacts.
const NAMED: [&[&str]; 7] =
    [&["body"], &["support"], &["load"], &["contact"], &["exact", "body"], &["exact", "contact"], &["accuracy", "contact"]];

/// Values that are such names.
const VALUES: [(&str, &str); 8] = [
    ("support", "on"),
    ("support", "body"),
    ("load", "on"),
    ("load", "body"),
    ("probe", "body"),
    ("geometry", "curves"),
    ("contact", "between"),
    ("steps", "scales"),
];

/// Whether a name of a case is a pattern.
pub fn has_patterns(table: &Table) -> bool {
    let named = NAMED.iter().filter_map(|path| table_at(table, path)).flat_map(Table::keys);
    let bodies = table_at(table, &["body"]).into_iter().flat_map(Table::values);
    let parts = bodies.filter_map(|body| body.get("part")?.as_table()).flat_map(Table::keys);
    let values = VALUES.iter().flat_map(|(kind, key)| {
        let tables = table_at(table, &[kind]).into_iter().flat_map(Table::values);
        tables.filter_map(|table| table.get(*key)).flat_map(strings)
    });
    named.chain(parts).map(String::as_str).chain(values).any(is_pattern)
}

/// The case without patterns, and what they have matched; `bytes` reads the mesh of the case by its path. What is wrong is in the
/// log afterwards.
pub fn written_out(table: Table, folder: &Path, log: &mut Log, bytes: ReadMesh) -> (Table, Vec<Matched>) {
    let Some(file) = table_at(&table, &["mesh"]).and_then(|mesh| mesh.get("file")?.as_str()).map(|file| folder.join(file)) else {
        return (table, Vec::new()); // The readers say what is missing.
    };
    let mut all = Expansion { table, matched: Vec::new(), standing: HashMap::new(), log };
    let mesh = bytes(&file).and_then(|bytes| all.write_out_parts(&bytes, &file));
    match mesh {
        Ok(mesh) => all.write_out(&mesh),
        Err(words) => all.problem(&["mesh", "file"], None, words),
    }
    (all.table, all.matched)
}

impl Expansion<'_> {
    /// Writes out the parts of bodies, which join surfaces of a mesh, and reads it.
    ///
    /// # Errors
    /// Words for a mesh that cannot be read.
    fn write_out_parts(&mut self, bytes: &[u8], file: &Path) -> Result<MeshNames, String> {
        let bodies = table_at(&self.table, &["body"]).into_iter().flatten();
        let with_parts = bodies.filter(|(_, body)| body.get("part").is_some_and(Value::is_table));
        let with_parts: Vec<String> = with_parts.map(|(name, _)| name.clone()).collect();
        if !with_parts.is_empty() {
            let surfaces = surfaces(bytes, file).map_err(|error| error.to_string())?;
            with_parts.iter().for_each(|body| self.write_out_names(&["body", body, "part"], &surfaces, "physical surface"));
        }
        parse_gmsh(bytes, file, self.joined(&with_parts)).map(MeshNames::new).map_err(|error| error.to_string())
    }

    /// The body of each physical surface that is a part of one.
    fn joined(&self, bodies: &[String]) -> HashMap<String, String> {
        let parts = |body: &String| {
            let parts = table_at(&self.table, &["body", body, "part"]).into_iter().flat_map(Table::keys);
            parts.map(|part| (part.clone(), body.clone())).collect::<Vec<_>>()
        };
        bodies.iter().flat_map(parts).collect()
    }

    /// Writes out everything else, by the names of the mesh.
    fn write_out(&mut self, mesh: &MeshNames) {
        self.write_out_names(&["body"], &mesh.mesh.bodies, "body");
        self.write_out_values("geometry", "curves", &[&mesh.boundaries[..], &mesh.interfaces].concat(), "physical curve");
        self.spread_loads(mesh);
        for kind in ["support", "load"] {
            self.write_out_values(kind, "on", &mesh.boundaries, "physical curve");
            self.write_out_names(&[kind], &self.own_names(kind), kind);
        }
        self.write_out_probes(mesh);
        self.spread_contacts(mesh);
        let contacts = self.own_names("contact");
        for path in [&["contact"][..], &["accuracy", "contact"], &["exact", "contact"]] {
            self.write_out_names(path, &contacts, "contact");
        }
        self.write_out_names(&["exact", "body"], &[&mesh.mesh.bodies[..], &mesh.parts].concat(), "body");
        self.write_out_scales();
    }
}
