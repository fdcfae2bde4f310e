//! Named boundaries, as `mezha new` looks at them.

use super::node_circle::NodeCircle;
use crate::contact::ClosePair;
use crate::geometry::Point;
use crate::mesh::{Boundary, MacroMesh};

/// Words in names of boundaries that are held, pressed, and of symmetry.
pub const HELD: [&str; 12] =
    ["bottom", "base", "fixed", "fix", "clamp", "clamped", "ground", "floor", "foot", "foundation", "support", "wall"];
pub const LOADED: [&str; 9] = ["top", "load", "loaded", "press", "pressed", "force", "punch", "push", "piston"];
pub const MIRRORED: [&str; 4] = ["symmetry", "sym", "symm", "mirror"];

/// A boundary looks along an axis if its mean normal has this component at least.
pub const ALONG: f64 = 0.95;

/// A named boundary as it lies.
pub struct NamedCurve<'a> {
    pub name: &'a str,
    pub body: usize,
    pub is_of_one_piece: bool,
    pub low: Point,
    pub high: Point,
    /// Mean of its outward normals by length; shorter than 1 where it is curved.
    pub normal: Point,
    pub length: f64,
    pub is_touched: bool,
    /// The circle that its nodes lie on, where the edges of the mesh are straight.
    pub circle: Option<NodeCircle>,
}

impl<'a> NamedCurve<'a> {
    pub fn new(mesh: &MacroMesh, boundary: &'a Boundary, pairs: &[ClosePair]) -> Option<Self> {
        let first = *boundary.edges.first()?;
        let (mut low, mut high) = (Point::repeat(f64::INFINITY), Point::repeat(f64::NEG_INFINITY));
        let (mut normal, mut length) = (Point::zeros(), 0.0);
        for &edge in &boundary.edges {
            for t in [0.0, 0.5, 1.0] {
                let x = mesh.edge_position(edge, t);
                (low, high) = (low.inf(&x), high.sup(&x));
            }
            normal += mesh.edge_length(edge) * mesh.edge_normal(edge, 0.5);
            length += mesh.edge_length(edge);
        }
        let piece = mesh.piece_beside(first);
        Some(Self {
            name: &boundary.name,
            body: mesh.body_beside(first),
            is_of_one_piece: boundary.edges.iter().all(|&edge| mesh.piece_beside(edge) == piece),
            low,
            high,
            normal: normal / length,
            length,
            circle: NodeCircle::through(mesh, &boundary.edges),
            is_touched: pairs.iter().any(|pair| pair.between.contains(&boundary.name)),
        })
    }

    /// Whether its name has one of some words.
    pub fn has(&self, words: &[&str]) -> bool {
        let name = self.name.to_lowercase();
        name.split(|c: char| !c.is_alphanumeric())
            .any(|word| words.contains(&word.trim_end_matches(|c: char| c.is_ascii_digit())))
    }
}
