//! Writer of Gmsh 4.1 ASCII files.

use crate::geometry::{Point, bounds};
use crate::mesh::boundaries::Boundary;
use crate::mesh::macro_mesh::{MacroMesh, MacroTriangle};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

impl MacroMesh {
    /// The text of a Gmsh 4.1 ASCII file of this mesh, with the names of all parts, boundaries and curves between parts.
    ///
    /// Vertices, triangles, edges and boundaries come back in this order and to the last digit from [`crate::mesh::file::gmsh::parse_gmsh`]. An
    /// edge that lies in several boundaries is a line of each. Edges are straight: a `[geometry]` of the case bends them again. Of
    /// a mesh that midside nodes have bent, the triangles beside bent edges have midside nodes again.
    pub fn to_gmsh(&self) -> String {
        let mut text = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n".to_owned();
        section(&mut text, "PhysicalNames", &self.physical_names());
        section(&mut text, "Entities", &self.entities());
        let midsides = self.midside_tags();
        section(&mut text, "Nodes", &self.nodes(&midsides));
        section(&mut text, "Elements", &self.elements(&midsides));
        text
    }

    /// Boundaries, with the curves between parts after them, and parts by name; a tag is a place, from 1.
    fn physical_names(&self) -> String {
        let mut text = format!("{}\n", self.curves().count() + self.parts.len());
        let names = self.curves().map(|curve| (1, &curve.name)).enumerate();
        for (place, (dimension, name)) in names.chain(self.parts.iter().map(|part| (2, &part.name)).enumerate()) {
            line(&mut text, format_args!("{dimension} {} \"{name}\"", place + 1));
        }
        text
    }

    /// One curve for each boundary, one surface for each part, each with its physical tag and the box around it.
    fn entities(&self) -> String {
        let mut text = format!("0 {} {} 0\n", self.curves().count(), self.parts.len());
        for (place, boundary) in self.curves().enumerate() {
            let ends = boundary.edges.iter().flat_map(|&edge| self.edge_ends(edge));
            entity(&mut text, place + 1, bounds(ends));
        }
        for part in 0..self.parts.len() {
            let own = self.triangles.iter().filter(|triangle| triangle.part as usize == part);
            let corners = own.flat_map(|triangle| triangle.vertices.map(|vertex| self.vertices[vertex as usize]));
            entity(&mut text, part + 1, bounds(corners));
        }
        text
    }

    /// Boundaries, then curves between parts.
    fn curves(&self) -> impl Iterator<Item = &Boundary> {
        self.physical_curves().into_iter().chain(&self.interfaces)
    }

    /// Whether an edge is written with its midside node.
    fn is_written_bent(&self, edge: u32) -> bool {
        self.has_midsides && self.edges[edge as usize].shape.is_some()
    }

    /// Whether a triangle is written with its midside nodes.
    fn has_bent_edge(&self, triangle: &MacroTriangle) -> bool {
        triangle.edges.iter().any(|&edge| self.is_written_bent(edge))
    }

    /// Tags of the midside nodes of the edges that need one, behind those of the vertices.
    fn midside_tags(&self) -> BTreeMap<u32, usize> {
        let bent = self.triangles.iter().filter(|triangle| self.has_bent_edge(triangle));
        let edges: BTreeSet<u32> = bent.flat_map(|triangle| triangle.edges).collect();
        edges.into_iter().enumerate().map(|(k, edge)| (edge, self.vertices.len() + k + 1)).collect()
    }

    /// Vertices in their order: a block for as many of one part as follow each other. Midside nodes come behind them.
    fn nodes(&self, midsides: &BTreeMap<u32, usize>) -> String {
        let mut parts = vec![0; self.vertices.len()];
        for triangle in &self.triangles {
            triangle.vertices.iter().for_each(|&vertex| parts[vertex as usize] = triangle.part);
        }
        let (blocks, count) = (parts.chunk_by(|a, b| a == b), self.vertices.len() + midsides.len());
        let block_count = blocks.clone().count() + usize::from(!midsides.is_empty());
        let mut text = format!("{block_count} {count} 1 {count}\n");
        let mut first = 0;
        for block in blocks {
            line(&mut text, format_args!("2 {} 0 {}", block[0] + 1, block.len()));
            (first..first + block.len()).for_each(|vertex| line(&mut text, format_args!("{}", vertex + 1)));
            for x in &self.vertices[first..first + block.len()] {
                line(&mut text, format_args!("{:?} {:?} 0", x.x, x.y));
            }
            first += block.len();
        }
        if !midsides.is_empty() {
            line(&mut text, format_args!("2 1 0 {}", midsides.len()));
            midsides.values().for_each(|tag| line(&mut text, format_args!("{tag}")));
            for x in midsides.keys().map(|&edge| self.edge_position(edge, 0.5)) {
                line(&mut text, format_args!("{:?} {:?} 0", x.x, x.y));
            }
        }
        text
    }

    /// Lines of the curves, then triangles in their order: a block for as many of one kind as follow each other.
    fn elements(&self, midsides: &BTreeMap<u32, usize>) -> String {
        let of_curves: Vec<(usize, &[u32])> = self
            .curves()
            .enumerate()
            .flat_map(|(place, curve)| {
                let alike = curve.edges.chunk_by(|&a, &b| self.is_written_bent(a) == self.is_written_bent(b));
                alike.map(move |edges| (place + 1, edges))
            })
            .collect();
        let blocks = self.triangles.chunk_by(|a, b| a.part == b.part && self.has_bent_edge(a) == self.has_bent_edge(b));
        let count = self.triangles.len() + of_curves.iter().map(|(_, edges)| edges.len()).sum::<usize>();
        let mut text = format!("{} {count} 1 {count}\n", of_curves.len() + blocks.clone().count());
        let mut tag = 0;
        for (place, edges) in of_curves {
            let kind = if self.is_written_bent(edges[0]) { 8 } else { 1 };
            line(&mut text, format_args!("1 {place} {kind} {}", edges.len()));
            for edge in edges {
                let [a, b] = self.edges[*edge as usize].vertices;
                tag += 1;
                let middle = midsides.get(edge).filter(|_| kind == 8).map_or(String::new(), |middle| format!(" {middle}"));
                line(&mut text, format_args!("{tag} {} {}{middle}", a + 1, b + 1));
            }
        }
        for block in blocks {
            let is_bent = self.has_bent_edge(&block[0]);
            line(&mut text, format_args!("2 {} {} {}", block[0].part + 1, if is_bent { 9 } else { 2 }, block.len()));
            for triangle in block {
                let [a, b, c] = triangle.vertices;
                tag += 1;
                let middles = triangle.edges.iter().filter_map(|edge| midsides.get(edge)).filter(|_| is_bent);
                let middles: String = middles.map(|middle| format!(" {middle}")).collect();
                line(&mut text, format_args!("{tag} {} {} {}{middles}", a + 1, b + 1, c + 1));
            }
        }
        text
    }
}

fn section(text: &mut String, name: &str, content: &str) {
    line(text, format_args!("${name}\n{content}$End{name}"));
}

/// An entity that has the physical tag of its own number, and no neighbours.
fn entity(text: &mut String, tag: usize, [low, high]: [Point; 2]) {
    line(text, format_args!("{tag} {:?} {:?} 0 {:?} {:?} 0 1 {tag} 0", low.x, low.y, high.x, high.y));
}

fn line(text: &mut String, words: std::fmt::Arguments) {
    writeln!(text, "{words}").expect("a text takes every line");
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Curve;
    use crate::mesh::file::gmsh::{parse_gmsh, read_bytes};
    use std::path::Path;

    fn mesh_of(file: &str) -> MacroMesh {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(file);
        parse_gmsh(&read_bytes(&file).expect("a file"), &file, Default::default()).expect("a mesh")
    }

    fn case_mesh(file: &str) -> MacroMesh {
        mesh_of(&format!("cases/{file}"))
    }

    fn again(mesh: &MacroMesh) -> MacroMesh {
        parse_gmsh(mesh.to_gmsh().as_bytes(), Path::new("again.msh"), Default::default()).expect("our own reader reads it")
    }

    /// Everything but the file and the shapes of edges, to the last digit.
    fn content(mesh: &MacroMesh) -> String {
        let edges: Vec<_> = mesh.edges.iter().map(|edge| (edge.vertices, edge.triangles)).collect();
        format!(
            "{:?}",
            (
                &mesh.vertices,
                &mesh.triangles,
                edges,
                (&mesh.bodies, &mesh.parts),
                &mesh.pieces,
                (&mesh.boundaries, &mesh.interfaces)
            )
        )
    }

    #[test]
    fn a_mesh_comes_back_to_the_last_digit() {
        for file in ["stack/stack.msh", "rings/rings.msh", "hertz/hertz.msh", "patch_inclined/bars.msh"] {
            let mut mesh = case_mesh(file);
            for (place, x) in mesh.vertices.iter_mut().enumerate() {
                *x = Point::new(x.x / 3.0 + 1e-9 * place as f64, x.y / 7.0) * 1e-3;
            }
            let [edge, last] = [mesh.boundaries[0].edges[0], *mesh.boundaries.last().expect("some").edges.last().expect("some")];
            mesh.boundaries.push(Boundary { name: "in several, \u{3bb}".into(), edges: vec![last, edge], is_union: false });
            assert_eq!(content(&again(&mesh)), content(&mesh), "{file}");
        }
    }

    /// Triangles and vertices of several bodies in turns, as they may lie after bisection.
    #[test]
    fn bodies_may_take_turns() {
        let mesh = case_mesh("stack/stack.msh");
        let text = mesh.to_gmsh();
        let blocks = text.lines().filter(|line| line.starts_with("2 ") && line.split(' ').nth(2) == Some("2")).count();
        assert!(mesh.bodies.len() > 1 && blocks >= mesh.bodies.len(), "{blocks} blocks");
        let mut raw = crate::mesh::raw_mesh::RawMesh { vertices: mesh.vertices.clone(), ..Default::default() };
        for start in 0..7 {
            let turn = mesh.triangles.iter().skip(start).step_by(7);
            turn.for_each(|t| raw.add(&mesh.bodies[t.body as usize], [t.vertices.map(|vertex| vertex as usize)]));
        }
        let mixed = MacroMesh::build(raw, Path::new("mixed.msh")).expect("the same triangles");
        assert_eq!(content(&again(&mixed)), content(&mixed));
    }

    #[test]
    fn curves_bend_it_again() {
        let mut mesh = case_mesh("rings/rings.msh");
        let curve = Curve::Circle { centre: [0.0, 0.0], radius: 1.0 };
        let names: Vec<String> = mesh
            .boundaries
            .iter()
            .filter(|boundary| {
                let ends = boundary.edges.iter().flat_map(|&edge| mesh.edges[edge as usize].vertices);
                ends.map(|vertex| mesh.vertices[vertex as usize]).all(|x| (x.norm() - 1.0).abs() < 1e-6)
            })
            .map(|boundary| boundary.name.clone())
            .collect();
        assert!(!names.is_empty(), "the rings have a boundary of radius 1");
        mesh.bend("ring", &names, &curve).expect("it is a circle");
        let mut read = again(&mesh);
        assert_eq!(content(&read), content(&mesh));
        read.bend("ring", &names, &curve).expect("it still is");
        let moved = mesh.vertices.iter().zip(&read.vertices).map(|(a, b)| (b - a).norm()).fold(0.0, f64::max);
        assert!(moved < 1e-15, "{moved}");
        let bent = |mesh: &MacroMesh| mesh.edges.iter().filter(|edge| edge.shape.is_some()).count();
        assert!(bent(&mesh) > 0 && bent(&read) == bent(&mesh));
    }
    /// A circle of midside nodes is the same circle again, also after bisection.
    #[test]
    fn midside_nodes_bend_it_again() {
        let mut mesh = mesh_of("tests/meshes/disc_4.1_order2_ascii.msh");
        for _ in 0..2 {
            let read = again(&mesh);
            assert_eq!(content(&read), content(&mesh));
            for edge in 0..mesh.edges.len() as u32 {
                let off = (read.edge_position(edge, 0.3) - mesh.edge_position(edge, 0.3)).norm();
                assert!(off < 1e-14, "edge {edge}: {off}");
            }
            let all = 0..mesh.triangles.len() as u32;
            mesh = crate::mesh::refined::BisectedMesh::new(mesh).refined(all).mesh;
        }
    }
}
