//! The grid that the trees of all bodies are cut from, and the nodes of the mesh on it.

use super::level::{LevelNode, LevelNodes};
use super::tree::{Roots, Tree, WantedWidth};
use crate::discretisation::Space;
use crate::geometry::{AXES, Point, bounds};
use crate::mesh::MacroMesh;

/// Width of the cells of the finest trees, in edges of the mesh: with 1.5 and 2 as many iterations, but dearer ones.
const WIDTH: f64 = 2.5;

/// Halvings at most.
const DEEPEST: u32 = 20;

/// Where cells lie: the same for all bodies, so that the traces of two bodies in contact match on coarse levels.
pub struct Grid<'a> {
    mesh: &'a MacroMesh,
    /// Mean length of the edges at each vertex.
    lengths: Vec<f64>,
    bodies: Vec<usize>,
    low: Point,
    /// Size of the unit.
    unit: Point,
    roots: Roots,
}

impl<'a> Grid<'a> {
    /// Root cells that fill the box around all bodies.
    pub fn new(mesh: &'a MacroMesh) -> Self {
        let lengths = edge_lengths(mesh);
        let [low, high] = bounds(mesh.vertices.iter().copied());
        let usual = WIDTH * (lengths.iter().map(|length| length.ln()).sum::<f64>() / lengths.len() as f64).exp();
        let least = WIDTH * lengths.iter().copied().fold(f64::INFINITY, f64::min);
        let size = high - low;
        // From four root cells on, side by side, some power of two times the usual width fits to an eighth.
        let root = usual * (size.min() / usual / 4.0).log2().floor().max(0.0).exp2();
        let count = [size.x, size.y].map(|size| (size / root).round().max(1.0) as u32);
        let depth = ((root / least).log2().ceil() as u32).min(DEEPEST);
        let unit = Point::new(size.x / f64::from(count[0] << depth), size.y / f64::from(count[1] << depth));
        Self { mesh, lengths, bodies: bodies(mesh), low, unit, roots: Roots { count, depth } }
    }

    fn place(&self, vertex: usize) -> [f64; 2] {
        let x = self.mesh.vertices[vertex] - self.low;
        [x.x / self.unit.x, x.y / self.unit.y]
    }

    /// The finest tree of each body.
    pub fn trees(&self) -> Vec<Tree> {
        let unit = (self.unit.x * self.unit.y).sqrt();
        let mut widths: Vec<Vec<WantedWidth>> = vec![Vec::new(); self.mesh.bodies.len()];
        for (vertex, &body) in self.bodies.iter().enumerate() {
            widths[body].push(WantedWidth { at: self.place(vertex), width: (WIDTH * self.lengths[vertex] / unit).ln() });
        }
        widths.iter_mut().map(|widths| Tree::around(self.roots, widths)).collect()
    }

    /// The nodes of the coarsest space, which are the vertices of the macro mesh.
    pub fn nodes(&self, space: &Space, ranks: usize) -> LevelNodes {
        let numbering = &space.numbering;
        let mut vertices = vec![0; self.mesh.vertices.len()];
        (0..vertices.len()).for_each(|vertex| vertices[numbering.vertex(vertex as u32)] = vertex);
        let node = |(number, vertex): (usize, usize)| {
            let fixed = space.constraints.get(number).map_or([false; 2], |constraint| constraint.fixed);
            LevelNode {
                body: self.bodies[vertex],
                at: self.place(vertex),
                axes: AXES.map(|axis| space.to_global(number, axis)),
                is_free: fixed.map(|is_fixed| !is_fixed),
            }
        };
        let first = (0..ranks).map(|rank| numbering.range(rank).start).chain([numbering.node_count()]).collect();
        LevelNodes { all: vertices.into_iter().enumerate().map(node).collect(), first }
    }
}

fn edge_lengths(mesh: &MacroMesh) -> Vec<f64> {
    let mut sums = vec![(0.0, 0.0); mesh.vertices.len()];
    for (edge, ends) in mesh.edges.iter().map(|edge| edge.vertices).enumerate() {
        let length = mesh.edge_length(edge as u32);
        for vertex in ends {
            let (sum, count) = &mut sums[vertex as usize];
            (*sum, *count) = (*sum + length, *count + 1.0);
        }
    }
    sums.into_iter().map(|(sum, count)| sum / count).collect()
}

/// Body of each vertex.
fn bodies(mesh: &MacroMesh) -> Vec<usize> {
    let mut bodies = vec![0; mesh.vertices.len()];
    for triangle in &mesh.triangles {
        triangle.vertices.iter().for_each(|&vertex| bodies[vertex as usize] = triangle.body as usize);
    }
    bodies
}
