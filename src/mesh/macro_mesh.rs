//! The mesh of the file: triangles of named bodies, edges, named boundaries.

use super::boundaries::{Boundaries, Boundary};
use super::curve_piece::{CurvePiece, LooseCurve};
use super::raw_mesh::{RawMesh, RawTriangle};
use super::{FilePlace, MeshError};
use crate::element::Plane;
use crate::geometry::{Coordinates, Curve, Point, Quote, Rounded, cross};
use std::cell::OnceCell;
use std::collections::{BTreeMap, HashMap, HashSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A point of a body that the case names.
#[derive(Clone, Debug, PartialEq)]
pub struct Spot {
    /// Where (length).
    pub place: [f64; 2],
    /// The body that is meant, where two may touch.
    pub body: Option<String>,
}

/// A point that the case names, and the vertex there.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedPoint {
    /// What the case says.
    pub spot: Spot,
    /// The vertex.
    pub vertex: u32,
}

/// A body, or a part of one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Region {
    /// Index of the body.
    Body(u32),
    /// Index of the part.
    Part(u32),
}

impl Region {
    /// Whether a triangle belongs to it.
    pub fn holds(self, triangle: &MacroTriangle) -> bool {
        match self {
            Self::Body(body) => triangle.body == body,
            Self::Part(part) => triangle.part == part,
        }
    }
}

/// A macro triangle, counter-clockwise.
#[derive(Clone, Debug)]
pub struct MacroTriangle {
    /// Corners, as indices of [`MacroMesh::vertices`].
    pub vertices: [u32; 3],
    /// Macro edges; edge `k` joins corner `k` to corner `k + 1` (mod 3).
    pub edges: [u32; 3],
    /// Whether edge `k` runs from corner `k` to corner `k + 1` in its own direction.
    pub forward: [bool; 3],
    /// Index of its body.
    pub body: u32,
    /// Index of its part of the body: what its material is.
    pub part: u32,
    /// Index of its piece of the body.
    pub piece: u32,
}

/// A macro edge, directed from its first vertex to its second.
#[derive(Clone, Debug)]
pub struct MacroEdge {
    /// Ends, as indices of [`MacroMesh::vertices`].
    pub vertices: [u32; 2],
    /// Macro triangles beside it: one on a boundary, two inside a body.
    pub triangles: [Option<u32>; 2],
    /// True shape, where it is not straight.
    pub shape: Option<Box<CurvePiece>>,
}

impl MacroEdge {
    /// Bends the edge onto a curve, whose parameters at the vertices `ends` are `range`.
    pub fn bend(&mut self, ends: [u32; 2], curve: Arc<Curve>, [from, to]: [f64; 2]) {
        self.shape = Some(Box::new(CurvePiece { curve, range: if self.vertices == ends { [from, to] } else { [to, from] } }));
    }
}

/// A physical surface of the file: a body, or a part of one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Surface {
    /// Name in the mesh file.
    pub name: String,
    /// Index of its body.
    pub body: u32,
}

/// Triangles of a body whose edges join them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BodyPiece {
    /// Index of the body.
    pub body: usize,
    /// First macro triangle of the piece.
    pub first: u32,
}

/// The mesh of the file. Every rank holds the whole of it.
#[derive(Clone, Debug, Default)]
pub struct MacroMesh {
    /// File it came from.
    pub file: PathBuf,
    /// Positions of the vertices that triangles use.
    pub vertices: Vec<Point>,
    /// Fraction κ at which refinement puts the next node from a vertex, where it is not even.
    pub ratios: BTreeMap<u32, f64>,
    /// Triangles, each with its body.
    pub triangles: Vec<MacroTriangle>,
    /// Edges, each once.
    pub edges: Vec<MacroEdge>,
    /// Names of the bodies: those of physical surfaces, or of several that the case joins.
    pub bodies: Vec<String>,
    /// Physical surfaces: the parts of the bodies, most of which have one.
    pub parts: Vec<Surface>,
    /// Pieces of the bodies, which hang together by edges; one for each body in most meshes.
    pub pieces: Vec<BodyPiece>,
    /// Physical curves that bound bodies.
    pub boundaries: Boundaries,
    /// Physical curves between parts of one body.
    pub interfaces: Boundaries,
    /// Physical curves that bound no body: they are left aside.
    pub loose: Vec<LooseCurve>,
    /// Vertices at points that the case names.
    pub points: Vec<NamedPoint>,
    /// Whether midside nodes of the file have bent edges.
    pub has_midsides: bool,
    /// What the plane of the mesh stands for.
    pub plane: Plane,
    /// Boxes around the pieces, once somebody has asked for them; whoever moves a vertex or adds a body empties it.
    pub bounds: OnceCell<Vec<[Point; 2]>>,
}

impl MacroMesh {
    /// Checks what a file says and connects it, a large mesh in an order of its own.
    pub(super) fn build(mut raw: RawMesh, file: &Path) -> Result<Self, MeshError> {
        raw.drop_loose_vertices();
        raw.put_in_order();
        let mut mesh = Self {
            file: file.to_path_buf(),
            vertices: raw.vertices,
            loose: raw.loose,
            triangles: Vec::with_capacity(raw.triangles.len()),
            ..Self::default()
        };
        let mut parts = vec![None; raw.names.len()];
        for &RawTriangle { corners, names, place } in &raw.triangles {
            let part = match parts[names as usize] {
                Some(part) => part,
                None => mesh.part_of(&raw.names[names as usize], &raw.joined, place)?,
            };
            parts[names as usize] = Some(part);
            let vertices = mesh.turned(corners, place)?;
            let body = mesh.parts[part as usize].body;
            mesh.triangles.push(MacroTriangle { vertices, edges: [0; 3], forward: [true; 3], body, part, piece: 0 });
        }
        let (edges, overlapping) = mesh.connect();
        if let Some(triangle) = overlapping {
            let words = "overlaps a triangle before it: they lie on the same side of an edge; mesh the scene again";
            return Err(mesh.syntax(raw.triangles[triangle].place, words.into()));
        }
        if mesh.triangles.is_empty() {
            return Err(MeshError::unusable(file, "has no triangles; mesh it with `gmsh -2`"));
        }
        mesh.check_bodies_are_apart()?;
        mesh.find_pieces()?;
        mesh.check_overlap()?;
        mesh.check_parts_are_joined()?;
        let mut placed = HashSet::new();
        for (name, ends, place) in raw.lines {
            let edge = edges.between(&mesh.triangles, ends);
            mesh.add_line(name, edge, place, &mut placed)?;
        }
        mesh.bend_through_midsides(raw.midsides)?;
        Ok(mesh)
    }

    /// The mesh as a whole cannot be used, for the reason in these words.
    pub(super) fn unusable(&self, words: String) -> MeshError {
        MeshError::unusable(&self.file, words)
    }

    fn syntax(&self, place: FilePlace, message: String) -> MeshError {
        MeshError::Syntax { file: self.file.clone(), place, message }
    }

    fn part_of(&mut self, names: &[String], joined: &HashMap<String, String>, place: FilePlace) -> Result<u32, MeshError> {
        let [name] = names else {
            let found = if names.is_empty() { "no physical surface".into() } else { names.join(", ") };
            // `Mesh.SaveAll` saves what has no group, too.
            let remedy = match names.is_empty() {
                true => {
                    "; name its surface with `Physical Surface(\"name\") = {...}`, or, where it is not meant, drop `Mesh.SaveAll` or `-save_all`"
                }
                false => "",
            };
            let words =
                format!("a triangle must lie in exactly one physical surface (its body); found {}{remedy}", Quote(&found));
            return Err(self.syntax(place, words));
        };
        if let Some(part) = self.parts.iter().position(|part| part.name == *name) {
            return Ok(part as u32);
        }
        let of = joined.get(name).unwrap_or(name);
        let body = self.bodies.iter().position(|body| body == of).unwrap_or_else(|| {
            self.bodies.push(of.clone());
            self.bodies.len() - 1
        });
        self.parts.push(Surface { name: name.clone(), body: body as u32 });
        Ok(self.parts.len() as u32 - 1)
    }

    /// The corners counter-clockwise; a clockwise triangle is turned round, a flat one refused.
    fn turned(&self, corners: [u32; 3], place: FilePlace) -> Result<[u32; 3], MeshError> {
        let [a, b, c] = corners.map(|corner| self.vertices[corner as usize]);
        let area = 0.5 * cross(b - a, c - a);
        let longest = (b - a).norm().max((c - b).norm()).max((a - c).norm());
        if area.abs() <= 1e-10 * longest * longest {
            let ([a, b, c], area) = ([a, b, c].map(Coordinates), Rounded(area));
            let words = format!("degenerate triangle with corners {a}, {b}, {c}: its area is {area}; mesh the scene again");
            return Err(self.syntax(place, words));
        }
        let [a, b, c] = corners;
        Ok(if area > 0.0 { [a, b, c] } else { [a, c, b] })
    }

    /// Bodies meet only in contact: no edge and no vertex may belong to two of them.
    fn check_bodies_are_apart(&self) -> Result<(), MeshError> {
        let Some((x, other, triangle)) = self.shared_vertex(|triangle| triangle.body) else { return Ok(()) };
        let [first, second] = [other, triangle.body].map(|body| &self.bodies[body as usize]);
        let part = &self.parts[triangle.part as usize].name;
        Err(self.unusable(format!(
            "bodies \"{first}\" and \"{second}\" share the node at {}; give each body points and lines of its own, contact joins them; if they are one body of several materials, name it once and give each of its parts a table, as in [body.NAME.part.\"{part}\"]",
            Coordinates(x)
        )))
    }

    /// The first vertex that triangles of two owners have: where it is, the owner that it had, and the triangle of the other one.
    pub(super) fn shared_vertex(&self, owner: impl Fn(&MacroTriangle) -> u32) -> Option<(Point, u32, &MacroTriangle)> {
        let mut owners = vec![None; self.vertices.len()];
        self.triangles.iter().flat_map(|triangle| triangle.vertices.map(|vertex| (vertex, triangle))).find_map(
            |(vertex, triangle)| {
                let known = *owners[vertex as usize].get_or_insert(owner(triangle));
                (known != owner(triangle)).then(|| (self.vertices[vertex as usize], known, triangle))
            },
        )
    }

    /// Puts a line on an edge, if it is one, onto its boundary, once; `placed` are the boundaries, by their indices, and edges that
    /// have been.
    fn add_line(
        &mut self,
        name: String,
        edge: Option<u32>,
        place: FilePlace,
        placed: &mut HashSet<(usize, u32)>,
    ) -> Result<(), MeshError> {
        let refused = |what: &str| {
            let curve = Quote(&name);
            let words =
                format!("a line of the physical curve \"{curve}\" {what}; physical curves must bound bodies, or parts of them");
            self.syntax(place, words)
        };
        let Some(edge) = edge else {
            return Err(refused("is not an edge of a triangle (`Coherence Mesh` merges nodes that lie on each other)"));
        };
        let parts = self.edges[edge as usize].triangles.map(|beside| beside.map(|k| self.triangles[k as usize].part));
        if parts[0] == parts[1] {
            return Err(refused("lies inside a body"));
        }
        let bounds_body = parts[1].is_none();
        let other_kind = if bounds_body { &self.interfaces } else { &self.boundaries };
        if other_kind.named(&name).is_some() {
            return Err(refused("lies between parts of a body while others bound one: name them apart"));
        }
        let curves = if bounds_body { &mut self.boundaries } else { &mut self.interfaces };
        let (at, edges) = curves.edges_mut(name);
        if placed.insert((at, edge)) {
            edges.push(edge);
        }
        Ok(())
    }

    /// The body, or the part of one, of that name, if the mesh has it. A body of one part is both.
    pub fn region(&self, name: &str) -> Option<Region> {
        let body = self.bodies.iter().position(|body| body == name).map(|body| Region::Body(body as u32));
        body.or_else(|| self.parts.iter().position(|part| part.name == name).map(|part| Region::Part(part as u32)))
    }

    /// The boundary of that name, if the mesh has it.
    pub fn boundary(&self, name: &str) -> Option<&Boundary> {
        self.boundaries.named(name)
    }

    /// Macro edges of the boundary of that name; none if the mesh has no such.
    pub fn edges_of(&self, name: &str) -> &[u32] {
        self.boundary(name).map_or(&[], |boundary| &boundary.edges)
    }

    /// Macro edges of boundaries, in their order; some may come more than once.
    pub fn edges_on<'a>(&'a self, names: &'a [String]) -> impl Iterator<Item = u32> + 'a {
        names.iter().flat_map(|name| self.edges_of(name)).copied()
    }

    /// The physical curves of the mesh file.
    pub fn physical_curves(&self) -> Vec<&Boundary> {
        self.boundaries.iter().filter(|boundary| !boundary.is_union).collect()
    }

    /// Makes one boundary of several, under a name of its own; one of that name, if there is one, is it.
    pub fn unite(&mut self, name: &str, curves: &[String]) {
        if self.boundary(name).is_some() {
            return;
        }
        let mut seen = HashSet::new();
        let edges = self.edges_on(curves).filter(|edge| seen.insert(*edge)).collect();
        self.boundaries.push(Boundary { name: name.into(), edges, is_union: true });
    }

    /// The triangle beside a boundary edge, and which of its three edges it is.
    pub fn beside(&self, edge: u32) -> (u32, usize) {
        let triangle = self.edges[edge as usize].triangles[0].expect("every macro edge has a first triangle");
        let side = self.triangles[triangle as usize].edges.iter().position(|&e| e == edge);
        (triangle, side.expect("a macro triangle knows its edges"))
    }

    /// Body of a boundary edge.
    pub fn body_beside(&self, edge: u32) -> usize {
        self.triangles[self.beside(edge).0 as usize].body as usize
    }

    /// Whether an edge lies on the outline of its body: one triangle is beside it.
    pub fn is_outer(&self, edge: u32) -> bool {
        self.edges[edge as usize].triangles[1].is_none()
    }

    /// Whether an edge lies between two parts of a body.
    pub fn is_interface(&self, edge: u32) -> bool {
        let [first, second] = self.edges[edge as usize].triangles.map(|beside| beside.map(|k| self.triangles[k as usize].part));
        second.is_some() && first != second
    }

    /// Places of the corners of a macro triangle.
    pub fn corners(&self, triangle: usize) -> [Point; 3] {
        self.triangles[triangle].vertices.map(|vertex| self.vertices[vertex as usize])
    }

    /// Places of the ends of a macro edge.
    pub fn edge_ends(&self, edge: u32) -> [Point; 2] {
        self.edges[edge as usize].vertices.map(|vertex| self.vertices[vertex as usize])
    }

    /// The point on the chord of a macro edge that is nearest to a point.
    pub fn foot_on_chord(&self, edge: u32, x: Point) -> Point {
        let [a, b] = self.edge_ends(edge);
        a + ((x - a).dot(&(b - a)) / (b - a).norm_squared()).clamp(0.0, 1.0) * (b - a)
    }

    /// Straight length of a macro edge.
    pub fn edge_length(&self, edge: u32) -> f64 {
        let [a, b] = self.edges[edge as usize].vertices;
        (self.vertices[b as usize] - self.vertices[a as usize]).norm()
    }

    /// Smallest angle of a macro triangle with straight sides (radians).
    pub fn smallest_angle(&self, triangle: usize) -> f64 {
        smallest_angle(self.corners(triangle))
    }
}

/// Smallest angle of a triangle with these corners (radians).
pub(super) fn smallest_angle(x: [Point; 3]) -> f64 {
    (0..3).map(|k| (x[(k + 1) % 3] - x[k]).angle(&(x[(k + 2) % 3] - x[k]))).fold(f64::INFINITY, f64::min)
}
