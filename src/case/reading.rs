//! A case file read: overrides, patterns, sections, and what lies between them.

use std::cell::RefCell;
use std::path::Path;

use toml::Table;

use super::acting::load::{Loads, read_load};
use super::acting::mean::check_means;
use super::acting::rigid::read_tool;
use super::acting::support::{Supports, read_support};
use super::asked::solver::read_solver;
use super::asked::{accuracy, exact, output, steps};
use super::bodies::gravity::read_gravity;
use super::bodies::mesh::read_mesh;
use super::bodies::{body, geometry, revolution};
use super::contact::reading::read_contact;
use super::contact::sides;
use super::file::error::{CaseError, Log};
use super::file::overrides::{overridden, set_value};
use super::file::text::{name_of, read_text};
use super::keys::Section;
use super::keys::section::read_whole;
use super::model::{Case, LoadStep};
use super::patterns::{self, Matched, ReadMesh};
use super::schema::case::{CASE, PLANE, THICKNESS, TITLE};
use crate::mesh::read_bytes;

/// A table with its log, and what its patterns stand for.
type WrittenOut = (Table, Log, Vec<Matched>);

impl Case {
    /// Reads and checks a case file, after the overrides `KEY=VALUE`.
    ///
    /// # Errors
    /// [`CaseError`] with everything that is wrong.
    pub fn read(file: &Path, overrides: &[String]) -> Result<Self, CaseError> {
        Self::parse(&read_text(file, "case")?, file, overrides)
    }

    /// Checks the text of a case file; `file` gives names to the case and to errors, and a folder to the mesh.
    ///
    /// # Errors
    /// [`CaseError`] with everything that is wrong.
    pub fn parse(text: &str, file: &Path, overrides: &[String]) -> Result<Self, CaseError> {
        Self::parse_with(text, file, overrides, &read_mesh_bytes)
    }

    /// Checks the text of a case file, where `bytes` reads the mesh by its path, which is needed where names of the case are patterns.
    ///
    /// # Errors
    /// [`CaseError`] with everything that is wrong.
    pub fn parse_with(text: &str, file: &Path, overrides: &[String], bytes: ReadMesh) -> Result<Self, CaseError> {
        let (table, log, matched) = Self::written_out(text, file, overrides, bytes)?;
        let case = Self::from_table(table, log, file)?;
        Self { matched, ..case }.with_steps()
    }

    /// The table of a text after its overrides, with all patterns written out, a log, and what the patterns stand for.
    ///
    /// # Errors
    /// [`CaseError`] if the text is no TOML, or a pattern stands for nothing.
    fn written_out(text: &str, file: &Path, overrides: &[String], bytes: ReadMesh) -> Result<WrittenOut, CaseError> {
        let (table, mut log) = overridden(text, file, overrides, &accuracy::SHORT)?;
        if !patterns::has_patterns(&table) {
            return Ok((table, log, Vec::new()));
        }
        let (table, matched) = patterns::written_out(table, file.parent().unwrap_or(Path::new("")), &mut log, bytes);
        match log.problems.is_empty() {
            true => Ok((table, log, matched)),
            false => Err(CaseError { file: file.into(), problems: log.problems }),
        }
    }

    /// Checks a table.
    ///
    /// # Errors
    /// [`CaseError`] with everything that is wrong.
    fn from_table(mut table: Table, log: Log, file: &Path) -> Result<Self, CaseError> {
        let (mut case, log) = read_whole((&table, log), &CASE, file, |root| Self::from_section(root, file))?;
        for (path, value) in log.defaults {
            set_value(&mut table, &path, value).expect("a default stands in a table that was just read");
        }
        case.table = table;
        Ok(case)
    }

    /// The case with its load steps, as that of the last one; itself if it has none.
    ///
    /// # Errors
    /// [`CaseError`] if a value is bad where it is scaled.
    fn with_steps(self) -> Result<Self, CaseError> {
        let tables = steps::tables(&self.table, &self.factors);
        let count = tables.len();
        let mut steps = Vec::with_capacity(count);
        for (k, (factors, table)) in tables.into_iter().enumerate() {
            let case = Self::from_table(table, Log::default(), &self.file).map_err(|mut error| {
                error.problems.iter_mut().for_each(|problem| problem.words += &format!(" (in step {} of {count})", k + 1));
                error
            })?;
            steps.push(LoadStep { number: k + 1, count, factors, case });
        }
        Ok(match steps.last().map(|last: &LoadStep| last.case.clone()) {
            Some(last) => Self { table: self.table, factors: self.factors, matched: self.matched, steps, ..last },
            None => self,
        })
    }

    /// What can be read of a text that has errors, so that more of them may be found; nothing if there is no mesh to speak of.
    pub(crate) fn draft(text: &str, file: &Path, overrides: &[String]) -> Option<Self> {
        let (table, log, _) = Self::written_out(text, file, overrides, &read_mesh_bytes).ok()?;
        let draft = Self::from_section(&Section::root(&table, &CASE, &RefCell::new(log)), file);
        draft.map(|draft| Self { table, ..draft })
    }

    /// Reads every section, then checks what lies between them. None if there is no mesh to speak of; of what else is missing or
    /// bad the log knows.
    fn from_section(root: &Section, file: &Path) -> Option<Self> {
        let title = root.or_default(TITLE);
        let mesh = read_mesh(root, file.parent().unwrap_or(Path::new("")));
        let (plane, gravity) = (root.or_default(PLANE), read_gravity(root));
        let bodies = root.named("body", |section| body::read_body(section, plane, gravity));
        let tools = root.named("rigid", read_tool);
        let geometries = root.named("geometry", geometry::read_geometry);
        let (mut supports, mut loads) = (Supports::default(), Loads::default());
        root.named("support", |section| read_support(section, root, &mut supports));
        root.named("load", |section| read_load(section, root, &mut loads));
        let (Supports { supports, springs, means }, Loads { loads, point_loads, plates }) = (supports, loads);
        let mut unions = Vec::new();
        let contacts = root.named("contact", |section| read_contact(section, root, &mut unions));
        let (solver, output) = (read_solver(root), output::read_output(root, plane));
        let probes = root.named("probe", |section| output::read_probe(section, root));
        let (exact, factors) = (exact::read_exact(root, plane), root.named("steps", steps::read_factor));
        let accuracy = accuracy::read_accuracy(root, &contacts, &probes);
        body::check_bodies(root);
        body::check_parts(&bodies, root);
        body::check_gravity(gravity, root);
        geometry::check_geometries(&geometries, root);
        check_means(&means, root);
        accuracy::check_energy(accuracy.as_ref(), &point_loads, root);
        sides::check_contacts(&contacts, &unions, &geometries, root);
        sides::check_tools(&tools, &contacts, root);
        steps::check_steps(&factors, root);
        revolution::check(plane, &bodies, gravity, root);
        let case = Self {
            plane,
            thickness: root.optional(THICKNESS).unwrap_or(1.0),
            has_thickness: root.has("thickness"),
            units: output::read_units(root),
            name: name_of(file, "case.toml"),
            file: file.into(),
            title,
            mesh: mesh?,
            bodies,
            tools,
            geometries,
            supports,
            springs,
            means,
            loads,
            point_loads,
            plates,
            contacts,
            unions,
            solver,
            accuracy,
            output,
            probes,
            exact,
            steps: Vec::new(),
            matched: Vec::new(),
            factors,
            table: Table::new(),
        };
        Some(case.per_thickness())
    }
}

/// The bytes of a mesh, for those who are alone.
fn read_mesh_bytes(file: &Path) -> Result<Vec<u8>, String> {
    read_bytes(file).map_err(|error| error.to_string())
}
