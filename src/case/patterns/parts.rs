//! Parts of bodies, which join surfaces of the mesh before it is read.

use super::expansion::{Expansion, table_at};
use super::mesh_names::MeshNames;
use crate::mesh::{parse_gmsh, surfaces};
use std::collections::HashMap;
use std::path::Path;
use toml::{Table, Value};

impl Expansion<'_> {
    /// Writes out the parts of bodies, which join surfaces of a mesh, and reads it.
    ///
    /// # Errors
    /// Words for a mesh that cannot be read.
    pub(super) fn write_out_parts(&mut self, bytes: &[u8], file: &Path) -> Result<MeshNames, String> {
        let with_parts: Vec<String> = table_at(&self.table, &["body"])
            .into_iter()
            .flatten()
            .filter(|(_, body)| body.get("part").is_some_and(Value::is_table))
            .map(|(name, _)| name.clone())
            .collect();
        if with_parts.is_empty() {
            return parse_gmsh(bytes, file, HashMap::new()).map(MeshNames::new).map_err(|error| error.to_string());
        }
        let surfaces = surfaces(bytes, file).map_err(|error| error.to_string())?;
        for body in &with_parts {
            self.write_out_names(&["body", body, "part"], &surfaces, "physical surface");
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
}
