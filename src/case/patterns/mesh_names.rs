//! The mesh of a case with patterns: what names there are, and what lies where.

use crate::case::keys::values::number;
use crate::geometry::Point;
use crate::mesh::{Boundary, MacroMesh};
use toml::Value;

/// A point lies in a triangle if none of its barycentric coordinates is less: points on the boundary do.
const INSIDE: f64 = -1e-3;
/// Points outside by no more (barycentric) lie between a chord and its arc rather than elsewhere.
const BEHIND_CHORD: f64 = 0.2;

/// Names of a mesh.
pub struct MeshNames {
    pub mesh: MacroMesh,
    /// Physical surfaces that are parts of bodies.
    pub parts: Vec<String>,
    pub boundaries: Vec<String>,
    /// Physical curves between parts of one body.
    pub interfaces: Vec<String>,
}

impl MeshNames {
    pub fn new(mesh: MacroMesh) -> Self {
        let names = |all: &[Boundary]| all.iter().map(|boundary| boundary.name.clone()).collect();
        let parts = mesh.parts.iter().filter(|part| mesh.bodies[part.body as usize] != part.name);
        Self {
            parts: parts.map(|part| part.name.clone()).collect(),
            boundaries: names(&mesh.boundaries),
            interfaces: names(&mesh.interfaces),
            mesh,
        }
    }

    /// Those of some bodies that have a point: on a common boundary all of them.
    pub fn holding(&self, bodies: &[String], x: Point) -> Vec<String> {
        let mesh = &self.mesh;
        let mut deepest = vec![f64::NEG_INFINITY; mesh.bodies.len()];
        for (k, triangle) in mesh.triangles.iter().enumerate() {
            let Some(at) = mesh.locate_near(k, x, BEHIND_CHORD) else { continue };
            let depth = &mut deepest[triangle.body as usize];
            *depth = depth.max(at.min().min(1.0 - at.x - at.y));
        }
        let depth =
            |name: &String| mesh.bodies.iter().position(|body| body == name).map_or(f64::NEG_INFINITY, |body| deepest[body]);
        let inside: Vec<String> = bodies.iter().filter(|name| depth(name) >= INSIDE).cloned().collect();
        let nearest = || bodies.iter().max_by(|a, b| depth(a).total_cmp(&depth(b))).filter(|name| depth(name).is_finite());
        if inside.is_empty() { nearest().into_iter().cloned().collect() } else { inside }
    }

    /// Physical curves by the body that they bound, in their order; those that bound none are of a body without a name.
    pub fn of_each_body(&self, curves: Vec<String>) -> Vec<(&str, Vec<String>)> {
        let mut all: Vec<(&str, Vec<String>)> = Vec::new();
        for curve in curves {
            let body = self.body_beside(&curve).unwrap_or_default();
            match all.iter_mut().find(|(known, _)| *known == body) {
                Some((_, curves)) => curves.push(curve),
                None => all.push((body, vec![curve])),
            }
        }
        all
    }

    /// The body beside a physical curve.
    fn body_beside(&self, curve: &str) -> Option<&str> {
        let edge = *self.mesh.boundary(curve)?.edges.first()?;
        Some(&self.mesh.bodies[self.mesh.body_beside(edge)])
    }
}

/// The point that a value says.
pub fn point(value: &Value) -> Option<Point> {
    match &value.as_array()?[..] {
        [x, y] => Some(Point::new(number(x).ok()?, number(y).ok()?)),
        _ => None,
    }
}
