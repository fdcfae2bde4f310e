//! A case that was read: what to solve, on which mesh, and what is known of the result.

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

use nalgebra::{Matrix3, Vector3};
use toml::{Table, Value};

use super::acting::mean::MeanSupport;
use super::acting::rigid::{PREFIX, Plate, Tool};
use super::asked::exact::Exact;
use super::asked::output::{Output, UnitNames};
use super::asked::solver::Solver;
use super::asked::steps::LoadFactor;
use super::bodies::geometry::Geometry;
use super::bodies::mesh::MeshChoice;
use super::contact::sides::{Union, parts};
use super::patterns::Matched;
use crate::accuracy::{Accuracy, ProbePoint};
use crate::body::{Body, BodyPart, Load, MeanHold, PointLoad, RigidSet, Springs, Support};
use crate::contact::Pair;
use crate::element::Plane;
use crate::geometry::Point;
use crate::mesh::MacroMesh;

/// Pieces that an edge is cut into for the mean place over its length.
const PIECES: usize = 16;

/// Vertices on a circle from which on it is one, and no rectangle; and by how much they may be off, by its radius.
const ROUND: usize = 6;
const OFF_CIRCLE: f64 = 1e-6;

/// A checked case: what to solve, on which mesh, and what is known of the result.
#[derive(Clone, Debug)]
pub struct Case {
    /// The case file.
    pub file: PathBuf,
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
    pub probes: Vec<ProbePoint>,
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

    /// The parts of all bodies, each with its body.
    pub fn parts(&self) -> impl Iterator<Item = (&Body, &BodyPart)> {
        self.bodies.iter().flat_map(|body| body.parts.iter().map(move |part| (body, part)))
    }

    /// The bodies whose mean motion is held, on the first mesh of the case; not those of revolution that are held across the axis alone.
    ///
    /// # Errors
    /// Words with the support for a body that has its middle where it is to go around.
    pub fn mean_holds(&self, mesh: &MacroMesh) -> Result<Vec<MeanHold>, String> {
        let hold = |mean: &MeanSupport| mean.hold(mesh).map_err(|words| format!("support.{}: {words}", mean.name));
        self.means.iter().map(hold).filter(|hold| !hold.as_ref().is_ok_and(|hold| hold.held.is_empty())).collect()
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

/// Middle of physical curves: the centre of a whole circle, otherwise the mean place over their length.
fn middle_of(mesh: &MacroMesh, on: &[String]) -> Point {
    let edges: BTreeSet<u32> = mesh.edges_on(on).collect();
    centre_of_circle(mesh, &edges).unwrap_or_else(|| mean_place(mesh, &edges))
}

/// Mean place over the length of edges, in their true shapes.
fn mean_place(mesh: &MacroMesh, edges: &BTreeSet<u32>) -> Point {
    let place = |edge: u32, k: usize| mesh.edge_position(edge, k as f64 / PIECES as f64);
    let pieces = edges.iter().flat_map(|&edge| (0..PIECES).map(move |k| [place(edge, k), place(edge, k + 1)]));
    let (length, moment) = pieces.fold((0.0, Point::zeros()), |(length, moment), [a, b]| {
        let own = (b - a).norm();
        (length + own, moment + 0.5 * own * (a + b))
    });
    moment / length
}

/// Centre of the circle that edges go all around; nothing if they do not.
fn centre_of_circle(mesh: &MacroMesh, edges: &BTreeSet<u32>) -> Option<Point> {
    let mut ends: BTreeMap<u32, usize> = BTreeMap::new();
    edges.iter().flat_map(|&edge| mesh.edges[edge as usize].vertices).for_each(|vertex| *ends.entry(vertex).or_default() += 1);
    if ends.len() < ROUND || ends.values().any(|count| *count != 2) {
        return None;
    }
    let first = mean_place(mesh, edges);
    let arms: Vec<Point> = ends.keys().map(|&vertex| mesh.vertices[vertex as usize] - first).collect();
    // |x - c|² = r² is linear in c and r² - |c|².
    let (mut matrix, mut right) = (Matrix3::zeros(), Vector3::zeros());
    for arm in &arms {
        let row = Vector3::new(2.0 * arm.x, 2.0 * arm.y, 1.0);
        matrix += row * row.transpose();
        right += row * arm.norm_squared();
    }
    let found = matrix.lu().solve(&right)?;
    let centre = Point::new(found.x, found.y);
    let radius = arms.iter().map(|arm| (arm - centre).norm()).sum::<f64>() / arms.len() as f64;
    let is_on = |arm: &Point| ((arm - centre).norm() - radius).abs() <= OFF_CIRCLE * radius;
    arms.iter().all(is_on).then_some(first + centre)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::samples::{fan, two_blocks};

    #[test]
    fn the_middle_of_a_circle_is_its_centre_however_its_vertices_lie() {
        let mut mesh = fan(12);
        let centre = Point::new(3.0, -1.0);
        let rim = ["rim".to_owned()];
        assert!((middle_of(&mesh, &rim) - centre).norm() < 1e-12);
        for x in &mut mesh.vertices {
            // Denser at the right.
            let (radius, angle) = ((*x - centre).norm(), (x.y - centre.y).atan2(x.x - centre.x));
            let angle = angle - 0.3 * angle.sin();
            *x = centre + radius * Point::new(angle.cos(), angle.sin());
        }
        assert!((middle_of(&mesh, &rim) - centre).norm() < 1e-12);
        mesh.vertices[0].x += 0.1;
        let edges = mesh.boundary("rim").expect("named").edges.iter().copied().collect();
        assert_eq!(centre_of_circle(&mesh, &edges), None, "a vertex is off");
    }

    #[test]
    fn the_middle_of_other_curves_is_the_mean_over_their_length() {
        let mesh = two_blocks();
        let middle = |names: &[&str]| middle_of(&mesh, &names.iter().map(|name| name.to_string()).collect::<Vec<_>>());
        assert!((middle(&["upper.seam"]) - Point::new(1.0, 1.0)).norm() < 1e-12, "not that of its vertices");
        assert!((middle(&["bottom", "top"]) - Point::new(1.0, 1.0)).norm() < 1e-12);
    }
}
