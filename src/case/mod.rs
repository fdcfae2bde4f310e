//! The case file: TOML text to checked values.
//!
//! Everything that needs no mesh is checked here, and all that is wrong is reported at once, each with file, key, value and
//! remedy.

mod accuracy;
mod contact;
pub(crate) mod error;
mod exact;
mod fingerprint;
mod geometry;
mod grade;
mod gravity;
mod model;
pub(crate) mod overrides;
mod patterns;
mod revolution;
mod rigid;
pub mod schema;
pub(crate) mod section;
mod spot;
mod steps;
mod support;
mod thickness;
pub(crate) mod values;

use std::cell::RefCell;
use std::path::{Path, PathBuf};

use toml::{Table, Value};

use crate::accuracy::Accuracy;
use crate::body::{Body, Load, PointLoad, Springs, Support};
use crate::contact::Pair;
use crate::element::{Order, Plane};
use crate::geometry::Curve;
use crate::mesh::read_bytes;
use crate::system::{SolverChoice, Tolerance};

pub(crate) use error::listed;
pub use error::{CaseError, Problem};
pub use exact::{BodyExact, ContactExact, Exact, Expected, ExpectedDisplacement, LambdaExact};
pub use fingerprint::{Inputs, fingerprint, sha256};
pub use patterns::Matched;
pub use rigid::{Plate, Tool};
pub(crate) use section::read_text;
pub use steps::{LoadFactor, LoadStep};
pub use support::{MeanSupport, MeanWay};

use overrides::{overridden, set_value};
use section::{Log, Section};

/// A checked case: what to solve, on which mesh, and what is known of the result.
#[derive(Clone, Debug)]
pub struct Case {
    /// The case file.
    pub file: PathBuf,
    /// Folder of the case file; other files are relative to it.
    pub folder: PathBuf,
    /// Name of the folder if the file is called `case.toml`, else the file's stem.
    pub name: String,
    /// What it shows, in words.
    pub title: String,
    /// Mesh and discretisation.
    pub mesh: MeshChoice,
    /// Bodies, in the order of the file.
    pub bodies: Vec<Body>,
    /// Rigid tools.
    pub tools: Vec<Tool>,
    /// Thickness that forces, moments and energies of the file and of the results are those of (length); those of this case are of
    /// a thickness of one.
    pub thickness: f64,
    /// What the plane stands for in bodies that say nothing else.
    pub plane: Plane,
    /// True shapes of boundaries.
    pub geometries: Vec<Geometry>,
    /// Prescribed displacements.
    pub supports: Vec<Support>,
    /// Elastic supports.
    pub springs: Vec<Springs>,
    /// Bodies whose mean motion is held.
    pub means: Vec<MeanSupport>,
    /// Surface loads.
    pub loads: Vec<Load>,
    /// Forces at points.
    pub point_loads: Vec<PointLoad>,
    /// Boundaries that stay rigid under a resultant.
    pub plates: Vec<Plate>,
    /// Contact pairs.
    pub contacts: Vec<Pair>,
    /// Sides of contacts that are made of several physical curves.
    pub unions: Vec<Union>,
    /// Linear solver.
    pub solver: Solver,
    /// The accuracy that the mesh is adapted to; nothing if it stays as it is.
    pub accuracy: Option<Accuracy>,
    /// What is written of the result.
    pub output: Output,
    /// Points to report.
    pub probes: Vec<Probe>,
    /// Exact or reference values.
    pub exact: Exact,
    /// Load steps, none if everything acts at once; the case itself is that of the last one.
    pub steps: Vec<LoadStep>,
    /// What the patterns of the file stand for.
    pub matched: Vec<Matched>,
    /// What scales it from step to step.
    factors: Vec<LoadFactor>,
    /// The file with overrides and defaults written out.
    table: Table,
}

/// Which mesh, and what is made of it.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshChoice {
    /// Gmsh file, found from the folder of the case.
    pub file: PathBuf,
    /// Order of the displacement.
    pub order: Order,
    /// Refinements after reading.
    pub refine: usize,
    /// Points that they are graded towards.
    pub grades: Vec<Grade>,
}

/// A point that refinement is graded towards.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grade {
    /// Where (length).
    pub point: [f64; 2],
    /// Fraction κ, from the point, of the new node on an edge.
    pub ratio: f64,
}

/// True shape of some boundaries.
#[derive(Clone, Debug, PartialEq)]
pub struct Geometry {
    /// Name in the case file.
    pub name: String,
    /// Physical curves that have this shape.
    pub curves: Vec<String>,
    /// The shape.
    pub curve: Curve,
}

/// Several physical curves that are one side of a contact.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Union {
    /// The name of all of them.
    pub name: String,
    /// The physical curves.
    pub curves: Vec<String>,
}

/// How the linear systems are solved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solver {
    /// Which solver.
    pub choice: SolverChoice,
    /// Relative residual of the scaled augmented system, in [1e-16, 0.01], or by the discretisation error.
    pub tolerance: Tolerance,
    /// Whether the inf-sup constants are reported; by default where that is cheap.
    pub inf_sup: Option<bool>,
}

impl Solver {
    /// Whether the discretisation error says how far it solves.
    pub fn goes_by_estimate(&self) -> bool {
        self.tolerance == Tolerance::Discretisation
    }
}

/// What is written of the result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Output {
    /// Whether fields and figures are; the numbers always are.
    pub fields: bool,
}

/// A point whose displacement and stress are reported.
#[derive(Clone, Debug, PartialEq)]
pub struct Probe {
    /// Name in the case file.
    pub name: String,
    /// Where (length).
    pub point: [f64; 2],
    /// Body that is asked, or part of one; two of them may touch there.
    pub body: String,
}

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
        Self::parse_with(text, file, overrides, read_mesh_bytes)
    }

    /// The same, where `bytes` reads the mesh by its path, which is needed where names of the case are patterns.
    ///
    /// # Errors
    /// [`CaseError`] with everything that is wrong.
    pub fn parse_with(
        text: &str,
        file: &Path,
        overrides: &[String],
        bytes: impl FnOnce(&Path) -> Result<Vec<u8>, String>,
    ) -> Result<Self, CaseError> {
        let (table, log, matched) = Self::written_out(text, file, overrides, bytes)?;
        let case = Self::from_table(table, log, file)?;
        Self { matched, ..case }.with_steps()
    }

    /// The table of a text after its overrides, with all patterns written out, a log, and what the patterns stand for.
    ///
    /// # Errors
    /// [`CaseError`] if the text is no TOML, or a pattern stands for nothing.
    fn written_out(
        text: &str,
        file: &Path,
        overrides: &[String],
        bytes: impl FnOnce(&Path) -> Result<Vec<u8>, String>,
    ) -> Result<(Table, Log, Vec<Matched>), CaseError> {
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
        let log = RefCell::new(log);
        let draft = Self::from_section(&Section::root(&table, &schema::CASE, &log), file);
        let mut log = log.into_inner();
        log.add_faults(&schema::CASE, &table);
        let Some(mut case) = draft.filter(|_| log.problems.is_empty()) else {
            return Err(CaseError { file: file.into(), problems: log.problems });
        };
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
        let (table, log, _) = Self::written_out(text, file, overrides, read_mesh_bytes).ok()?;
        let draft = Self::from_section(&Section::root(&table, &schema::CASE, &RefCell::new(log)), file);
        draft.map(|draft| Self { table, ..draft })
    }

    /// A TOML text that reproduces the run from any folder: overrides done, every default written out, the mesh by its
    /// absolute path.
    pub fn resolved(&self) -> String {
        let mesh_file = std::path::absolute(&self.mesh.file).unwrap_or_else(|_| self.mesh.file.clone());
        self.resolved_with_mesh(&mesh_file.to_string_lossy())
    }

    /// The same with the mesh under another name, by its path from the folder that the text is written to.
    pub fn resolved_with_mesh(&self, mesh_file: &str) -> String {
        let mut table = self.table.clone();
        if let Some(mesh) = table.get_mut("mesh").and_then(Value::as_table_mut) {
            mesh.insert("file".into(), Value::from(mesh_file));
        }
        format!("# The case as it was run: all defaults are written out. `mezha run` takes this file.\n{table}")
    }

    /// The physical curves of a side of a contact, from its name.
    pub fn curves_of(&self, side: &String) -> Vec<String> {
        contact::parts(&self.unions, side)
    }

    /// Reads every section, then checks what lies between them. None if there is no mesh to speak of; of what else is missing or
    /// bad the log knows.
    fn from_section(root: &Section, file: &Path) -> Option<Self> {
        let folder = file.parent().unwrap_or(Path::new("")).to_path_buf();
        let title = root.or("title", values::text);
        let mesh = model::read_mesh(root, &folder);
        let (plane, gravity) = (model::read_plane(root), gravity::read_gravity(root));
        let bodies = root.named("body", |section| model::read_body(section, plane, gravity));
        let mut tools = root.named("rigid", rigid::read_tool);
        let geometries = root.named("geometry", geometry::read_geometry);
        let (supports, springs, means) = support::split(root.named("support", support::read_support));
        let (loads, mut point_loads, mut plates) = model::split_loads(root.named("load", model::read_load));
        let (contacts, unions) = contact::split_contacts(root.named("contact", |section| contact::read_contact(section, root)));
        let (solver, output) = (model::read_solver(root), model::read_output(root));
        let probes = root.named("probe", model::read_probe);
        let mut exact = exact::read_exact(root, plane);
        let accuracy = accuracy::read_accuracy(root, &contacts, &probes);
        let factors = root.named("steps", steps::read_factor);
        model::check_bodies(root);
        model::check_parts(&bodies, root);
        gravity::check_gravity(gravity, root);
        geometry::check_geometries(&geometries, root);
        model::check_probes(&probes, root);
        support::check_means(&means, root);
        spot::check_spots("support", supports.iter().filter_map(|support| Some((&support.name, support.at.as_ref()?))), root);
        spot::check_spots("load", point_loads.iter().map(|load| (&load.name, &load.at)), root);
        accuracy::check_energy(accuracy.as_ref(), &point_loads, root);
        contact::check_contacts(&contacts, &unions, &geometries, root);
        rigid::check_tools(&tools, &contacts, root);
        exact::check_exact(&exact, root);
        steps::check_steps(&factors, root);
        revolution::check(plane, &bodies, gravity, root);
        let thickness = thickness::read_thickness(root);
        thickness::per_thickness(thickness, &mut point_loads, &mut plates, &mut tools, &mut exact);
        Some(Self {
            plane,
            thickness,
            name: name_of(file, "case.toml"),
            file: file.into(),
            folder,
            title: title.unwrap_or_default(),
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
            solver: solver.unwrap_or(Solver { choice: SolverChoice::Auto, tolerance: Tolerance::Residual(1e-8), inf_sup: None }),
            accuracy,
            output: output.unwrap_or(Output { fields: true }),
            probes,
            exact,
            steps: Vec::new(),
            matched: Vec::new(),
            factors,
            table: Table::new(),
        })
    }
}

/// The bytes of a mesh, for those who are alone.
fn read_mesh_bytes(file: &Path) -> Result<Vec<u8>, String> {
    read_bytes(file).map_err(|error| error.to_string())
}

/// Name of the folder if the file is called as most are, `case.toml`, say; else the file's stem.
pub(crate) fn name_of(file: &Path, usual: &str) -> String {
    let stem = file.file_stem().unwrap_or_default();
    if file.file_name() != Some(usual.as_ref()) {
        return stem.to_string_lossy().into_owned();
    }
    let here = file.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let folder = here.canonicalize().or_else(|_| std::path::absolute(here)).unwrap_or_default();
    folder.file_name().unwrap_or(stem).to_string_lossy().into_owned()
}

#[cfg(test)]
mod tests;
