//! Formulas of loads and forces where they are integrated: the first that has no finite value there, in words.

use super::applied_force::forces_on_edge;
use super::node_positions::NodePositions;
use super::{BodyPart, Load, LoadKind};
use crate::element::{BadJacobian, by_order, triangle_load};
use crate::geometry::{Formula, Point};
use crate::mesh::{BoundaryEdge, Level, MacroMesh, Numbering, lattice};
use std::cell::RefCell;

/// The first of the loads that has no finite value at a point where a level integrates it.
///
/// # Errors
/// Words that begin with its key.
pub fn check_loads(mesh: &MacroMesh, numbering: &Numbering, loads: &[Load]) -> Result<(), String> {
    for load in loads {
        let key = if matches!(load.kind, LoadKind::Pressure(_)) { "pressure" } else { "traction" };
        let looked_at = Looked::at(load.kind.formulas());
        for small in mesh.edges_on(&load.on).flat_map(|edge| BoundaryEdge::all_of(mesh, edge, numbering)) {
            forces_on_edge(&small.points, numbering.level.intervals, load.kind.is_even(), |x, _| looked_at.point(x));
            looked_at.all_finite().map_err(|words| format!("load.{}.{key}: {words}", load.name))?;
        }
    }
    Ok(())
}

/// The first force per area on one of these macro triangles that has no finite value at a point where a level integrates it;
/// `parts` are those of the mesh, in its order.
///
/// # Errors
/// Words that begin with its key.
pub fn check_body_forces(
    mesh: &MacroMesh,
    triangles: impl Iterator<Item = usize>,
    level: Level,
    parts: &[&BodyPart],
) -> Result<(), String> {
    for triangle in triangles {
        let number = mesh.triangles[triangle].part as usize;
        let temperature = parts[number].heat.as_ref().map(|heat| std::slice::from_ref(&heat.temperature));
        for (key, formulas) in [("body_force", Some(parts[number].force.as_slice())), ("temperature", temperature)] {
            let Some(formulas) = formulas.filter(|formulas| formulas.iter().any(varies)) else { continue };
            let looked_at = Looked::at(formulas);
            // Where a triangle is turned inside out that is what is told.
            let _ = by_order!(level.order, look(mesh, triangle, level, &looked_at));
            looked_at.all_finite().map_err(|words| format!("{}.{key}: {words}", key_of(mesh, number)))?;
        }
    }
    Ok(())
}

/// Whether a formula is another from point to point, or nowhere a finite number.
pub fn varies(formula: &Formula) -> bool {
    formula.as_constant().is_none_or(|constant| !constant.is_finite())
}

fn look<const N: usize>(mesh: &MacroMesh, triangle: usize, level: Level, looked_at: &Looked) -> Result<(), BadJacobian> {
    let all = NodePositions::new(mesh, triangle, level);
    for small in lattice::triangles(level.intervals, level.order) {
        triangle_load::<N>(&all.of(&small.nodes::<N>()), |points| points.map(|x| looked_at.point(x)))?;
    }
    Ok(())
}

/// The key of a part of the mesh in the case.
fn key_of(mesh: &MacroMesh, part: usize) -> String {
    let surface = &mesh.parts[part];
    let body = &mesh.bodies[surface.body as usize];
    if *body == surface.name { format!("body.{body}") } else { format!("body.{body}.part.{}", surface.name) }
}

/// Formulas that are looked at, and the words for the first that had no finite value.
struct Looked<'a> {
    formulas: &'a [Formula],
    words: RefCell<Option<String>>,
}

impl<'a> Looked<'a> {
    fn at(formulas: &'a [Formula]) -> Self {
        Self { formulas, words: RefCell::new(None) }
    }

    /// Looks at a point; no force acts there.
    fn point(&self, x: Point) -> Point {
        if let Some(words) = self.formulas.iter().find_map(|formula| formula.finite_value(x).err()) {
            self.words.borrow_mut().get_or_insert(words);
        }
        Point::zeros()
    }

    fn all_finite(&self) -> Result<(), String> {
        self.words.borrow().clone().map_or(Ok(()), Err)
    }
}
