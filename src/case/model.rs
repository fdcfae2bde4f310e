//! A case that was read: what to solve, on which mesh, and what is known of the result.

use std::path::PathBuf;

use toml::{Table, Value};

use super::acting::mean::MeanSupport;
use super::acting::rigid::{PREFIX, Plate, Tool};
use super::asked::exact::Exact;
use super::asked::output::{Output, Probe, UnitNames};
use super::asked::solver::Solver;
use super::asked::steps::LoadFactor;
use super::bodies::geometry::Geometry;
use super::bodies::mesh::MeshChoice;
use super::contact::sides::{Union, parts};
use super::patterns::Matched;
use crate::accuracy::Accuracy;
use crate::body::{Body, Load, MeanHold, PointLoad, RigidSet, Springs, Support};
use crate::contact::Pair;
use crate::element::Plane;
use crate::geometry::Point;
use crate::mesh::MacroMesh;

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
    /// Whether the file gives it.
    pub has_thickness: bool,
    /// The names of the units that the case is in.
    pub units: UnitNames,
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
    pub(super) factors: Vec<LoadFactor>,
    /// The file with overrides and defaults written out.
    pub(super) table: Table,
}

/// One load step.
#[derive(Clone, Debug)]
pub struct LoadStep {
    /// Its number, from 1.
    pub number: usize,
    /// Number of all steps.
    pub count: usize,
    /// Names of the factors, and their values in this step.
    pub factors: Vec<(String, f64)>,
    /// The case with everything scaled; expected values are those of the last step.
    pub case: Case,
}

impl LoadStep {
    /// `step 2 of 4 (press = 0.5)`
    pub fn words(&self) -> String {
        let factors: Vec<String> = self.factors.iter().map(|(name, value)| format!("{name} = {value}")).collect();
        format!("step {} of {} ({})", self.number, self.count, factors.join(", "))
    }
}

impl Case {
    /// A TOML text that reproduces the run from any folder: overrides done, every default written out, the mesh by its
    /// absolute path.
    pub fn resolved(&self) -> String {
        let mesh_file = std::path::absolute(&self.mesh.file).unwrap_or_else(|_| self.mesh.file.clone());
        self.resolved_with_mesh(&mesh_file.to_string_lossy())
    }

    /// A TOML text that reproduces the run with the mesh under another name, by its path from the folder that the text is written to.
    pub fn resolved_with_mesh(&self, mesh_file: &str) -> String {
        let mut table = self.table.clone();
        if let Some(mesh) = table.get_mut("mesh").and_then(Value::as_table_mut) {
            mesh.insert("file".into(), Value::from(mesh_file));
        }
        format!("# The case as it was run: all defaults are written out. `mezha run` takes this file.\n{table}")
    }

    /// The physical curves of a side of a contact, from its name.
    pub fn curves_of(&self, side: &String) -> Vec<String> {
        parts(&self.unions, side)
    }

    /// The bodies whose mean motion is held, on the first mesh of the case.
    ///
    /// # Errors
    /// Words with the support for a body that has its middle where it is to go around.
    pub fn mean_holds(&self, mesh: &MacroMesh) -> Result<Vec<MeanHold>, String> {
        let hold = |mean: &MeanSupport| mean.hold(mesh).map_err(|words| format!("support.{}: {words}", mean.name));
        self.means.iter().map(hold).collect()
    }

    /// Everything that moves as a rigid body on a mesh.
    pub fn rigid_sets(&self, mesh: &MacroMesh) -> Vec<RigidSet> {
        let plate = |plate: &Plate| match plate.has_reference {
            true => plate.motion.clone(),
            false => RigidSet { about: middle_of(mesh, &plate.on), ..plate.motion.clone() },
        };
        let sets = self.tools.iter().map(|tool| tool.motion.clone()).chain(self.plates.iter().map(plate));
        sets.map(|set| if self.plane == Plane::Revolution { set.along_axis() } else { set }).collect()
    }

    /// Whether a boundary is named after a table `[rigid.NAME]` of the file, whether or not that could be read.
    pub(crate) fn writes_tool_of(&self, boundary: &str) -> bool {
        let names = self.table.get("rigid").and_then(Value::as_table).into_iter().flat_map(toml::Table::keys);
        let of = |name: &String| boundary.strip_prefix(PREFIX).and_then(|rest| rest.strip_prefix(name.as_str()));
        names.filter_map(of).any(|rest| rest.is_empty() || rest.starts_with('.'))
    }

    /// The tool that a boundary is the surface of, or a part of that.
    pub fn tool_of(&self, boundary: &str) -> Option<&Tool> {
        self.tools.iter().find(|tool| tool.has(boundary))
    }

    /// The case with everything that is a force, a moment or an energy of its thickness made that of a thickness of one: loads at
    /// points, boundaries that stay rigid, rigid tools, expected values.
    pub(super) fn per_thickness(mut self) -> Self {
        if self.thickness == 1.0 {
            return self;
        }
        let share = 1.0 / self.thickness;
        for load in &mut self.point_loads {
            load.force = load.force.each_ref().map(|component| component.times(share));
        }
        let plates = self.plates.iter_mut().map(|plate| &mut plate.motion);
        for motion in plates.chain(self.tools.iter_mut().map(|tool| &mut tool.motion)) {
            motion.applied = motion.applied.map(|component| share * component);
        }
        let forces = self.exact.contacts.iter_mut().filter_map(|contact| contact.force.as_mut());
        forces.chain(self.exact.energy.as_mut()).for_each(|expected| expected.value *= share);
        self
    }
}

/// Middle of the box around physical curves.
fn middle_of(mesh: &MacroMesh, on: &[String]) -> Point {
    let edges = on.iter().filter_map(|name| mesh.boundary(name)).flat_map(|boundary| &boundary.edges);
    let vertices = edges.flat_map(|&edge| mesh.edges[edge as usize].vertices).map(|vertex| mesh.vertices[vertex as usize]);
    let box_of = |[low, high]: [Point; 2], x: Point| [low.inf(&x), high.sup(&x)];
    let [low, high] = vertices.fold([Point::repeat(f64::INFINITY), Point::repeat(f64::NEG_INFINITY)], box_of);
    0.5 * (low + high)
}
