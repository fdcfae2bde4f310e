//! Supports and loads that stand for one on each of several bodies.

use super::expansion::{Expansion, strings, table_at};
use super::merging::StandsFor;
use super::mesh_names::{MeshNames, point};
use super::wildcard::is_pattern;
use toml::{Table, Value};

/// Tables of a kind that stand for others, and what each of these has of its own.
#[derive(Default)]
pub struct SpreadTables {
    tables: Table,
    standing: Vec<StandsFor>,
}

impl SpreadTables {
    /// A table that stands for itself.
    pub fn keep(&mut self, name: &str, table: &Value) {
        if !self.tables.contains_key(name) {
            self.tables.insert(name.into(), table.clone());
        }
    }

    /// A table that stands for others: what these have of their own, and what the file says of one by its name.
    pub fn put(&mut self, name: &str, table: &Value, own: Vec<(String, Table)>, written: &Table) {
        let names = own.iter().map(|(name, _)| name.clone()).collect();
        for (name, mut table) in own {
            table.extend(written.get(&name).and_then(Value::as_table).cloned().unwrap_or_default());
            self.tables.insert(name, Value::Table(table));
        }
        self.tables.insert(name.into(), table.clone());
        self.standing.push(StandsFor { name: name.into(), names, is_pattern: false });
    }
}

impl Expansion<'_> {
    /// Takes the tables of a kind from those that were spread.
    pub(super) fn take(&mut self, kind: &'static str, spread: SpreadTables) {
        self.table.insert(kind.into(), Value::Table(spread.tables));
        self.standing.insert(kind.into(), spread.standing);
    }

    /// Supports and loads with a pattern of bodies, and stiff plates on curves of several.
    pub(super) fn spread_loads(&mut self, mesh: &MeshNames) {
        for kind in ["support", "load"] {
            let Some(tables) = table_at(&self.table, &[kind]).cloned() else { continue };
            let mut spread = SpreadTables::default();
            for (name, table) in &tables {
                let own = self.on_bodies(kind, name, table, mesh);
                match own {
                    Some(own) => spread.put(name, table, own, &tables),
                    None => spread.keep(name, table),
                }
            }
            self.take(kind, spread);
        }
    }

    /// What a support or a load is on each of its bodies, by the name of each; nothing if it stands for itself.
    fn on_bodies(&mut self, kind: &'static str, name: &str, table: &Value, mesh: &MeshNames) -> Option<Vec<(String, Table)>> {
        if let Some(pattern) = table.get("body").and_then(Value::as_str).filter(|text| is_pattern(text)) {
            let path = [kind, name, "body"];
            let mut bodies = self.matching(&path, pattern, &mesh.mesh.bodies, "body");
            if let Some(at) = table.get("at").and_then(point) {
                let all = bodies.len();
                bodies = mesh.holding(&bodies, at);
                if bodies.is_empty() && all > 0 {
                    self.problem(&path, table.get("body"), "none of these bodies has the point of at; move it");
                }
            }
            let own = |body: String| (format!("{name}.{body}"), Table::from_iter([("body".to_owned(), Value::String(body))]));
            return Some(bodies.into_iter().map(own).collect());
        }
        let on = table.get("on").filter(|on| strings(on).into_iter().any(is_pattern))?;
        if table.get("rigid").and_then(Value::as_bool) != Some(true) {
            return None;
        }
        let curves = self.names(&[kind, name, "on"], on, &mesh.boundaries, "physical curve");
        let own = |(body, curves): (&str, Vec<String>)| {
            (format!("{name}.{body}"), Table::from_iter([("on".to_owned(), Value::from(curves))]))
        };
        Some(mesh.of_each_body(curves).into_iter().map(own).collect())
    }
}
