//! (level, node) -> number, in closed form.

use crate::element::Order;
use crate::mesh::lattice;
use crate::mesh::lattice::Place;
use crate::mesh::macro_mesh::MacroMesh;
use crate::mesh::partition::{Home, Partition};
use std::ops::Range;
use std::rc::Rc;

/// One level of refinement: a lattice and the elements on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Level {
    /// Lattice intervals per macro edge; for P2 two per triangle.
    pub intervals: usize,
    /// Elements.
    pub order: Order,
}

impl Level {
    /// Whether a macro triangle is a single triangle.
    pub fn is_one_triangle(&self) -> bool {
        self.triangles_per_edge() == 1
    }

    /// Triangles along a macro edge.
    pub fn triangles_per_edge(&self) -> usize {
        self.intervals / self.order.degree()
    }
}

/// The levels of a mesh refined `refine` times, coarsest first. Below P2 comes P1 on the same triangles, whose nodes
/// are the corners; the macro mesh itself is the coarsest.
pub fn levels(order: Order, refine: usize) -> Vec<Level> {
    let mut levels: Vec<Level> = (0..=refine).map(|r| Level { intervals: 1 << r, order: Order::P1 }).collect();
    if order == Order::P2 {
        levels.push(Level { intervals: 2 << refine, order });
    }
    levels
}

/// Numbers of the nodes of one level. Each rank has one contiguous range; in it, macro entities follow in the order
/// of the [`Partition`], and inside a macro triangle the lattice rows are contiguous.
#[derive(Clone, Debug)]
pub struct Numbering {
    /// The level that is numbered.
    pub level: Level,
    first: Vec<usize>,
    /// Which rank owns what on it.
    pub partition: Rc<Partition>,
}

impl Numbering {
    /// Numbers a level.
    pub fn new(level: Level, partition: &Rc<Partition>) -> Self {
        let mut first = vec![0];
        for &[vertices, edges, triangles] in &partition.counts {
            let count = vertices as usize
                + edges as usize * (level.intervals - 1)
                + triangles as usize * lattice::inner_count(level.intervals);
            first.push(first[first.len() - 1] + count);
        }
        Self { level, first, partition: partition.clone() }
    }

    /// The nodes of some macro triangles, of each in the order of its lattice: the triangle, the place in its lattice, the number.
    pub fn nodes_of<'a>(
        &'a self,
        mesh: &'a MacroMesh,
        triangles: impl Iterator<Item = usize> + 'a,
    ) -> impl Iterator<Item = (usize, (usize, usize), usize)> + 'a {
        triangles.flat_map(move |triangle| {
            let numbers = self.triangle(mesh, triangle);
            lattice::nodes(self.level.intervals).map(move |(i, j)| (triangle, (i, j), numbers.node(i, j)))
        })
    }

    /// Number of nodes over all ranks.
    pub fn node_count(&self) -> usize {
        self.first[self.first.len() - 1]
    }

    /// Numbers of the nodes that a rank owns.
    pub fn range(&self, rank: usize) -> Range<usize> {
        self.first[rank]..self.first[rank + 1]
    }

    fn start(&self, home: Home) -> usize {
        let n = self.level.intervals;
        self.first[home.rank as usize]
            + home.vertices_before as usize
            + home.edges_before as usize * (n - 1)
            + home.triangles_before as usize * lattice::inner_count(n)
    }

    /// Ranks that own a macro edge and its ends.
    pub fn ranks_of(&self, mesh: &MacroMesh, edge: u32) -> [usize; 3] {
        let [first, last] = mesh.edges[edge as usize].vertices.map(|vertex| self.partition.vertex(vertex));
        [first, last, self.partition.edge(edge)].map(|home| home.rank as usize)
    }

    /// Number of a macro vertex.
    pub fn vertex(&self, vertex: u32) -> usize {
        self.start(self.partition.vertex(vertex))
    }

    /// Number of the node `position` intervals from the first vertex of a macro edge; both ends included.
    pub fn edge_node(&self, mesh: &MacroMesh, edge: u32, position: usize) -> usize {
        match position {
            0 => self.vertex(mesh.edges[edge as usize].vertices[0]),
            p if p == self.level.intervals => self.vertex(mesh.edges[edge as usize].vertices[1]),
            p => self.start(self.partition.edge(edge)) + p - 1,
        }
    }

    /// Numbers of one macro triangle's nodes. What has no nodes is not looked up: on large macro meshes that is the time it takes.
    pub fn triangle(&self, mesh: &MacroMesh, triangle: usize) -> TriangleNumbers {
        let (macro_triangle, n) = (&mesh.triangles[triangle], self.level.intervals);
        let side = |edge: u32| if n > 1 { self.start(self.partition.edge(edge)) } else { 0 };
        TriangleNumbers {
            n,
            corners: macro_triangle.vertices.map(|vertex| self.vertex(vertex)),
            sides: macro_triangle.edges.map(side),
            forward: macro_triangle.forward,
            inside: if n > 2 { self.start(self.partition.triangle(triangle)) } else { 0 },
        }
    }
}

/// Numbers of the nodes of one macro triangle.
#[derive(Clone, Copy, Debug)]
pub struct TriangleNumbers {
    n: usize,
    corners: [usize; 3],
    sides: [usize; 3],
    forward: [bool; 3],
    inside: usize,
}

impl TriangleNumbers {
    /// Numbers of the nodes of a macro triangle that is a single triangle: its corners, then its midsides.
    #[inline]
    pub fn of_one<const N: usize>(&self) -> [usize; N] {
        std::array::from_fn(|a| if a < 3 { self.corners[a] } else { self.sides[a - 3] })
    }

    /// Number of lattice node `(i, j)`.
    #[inline]
    pub fn node(&self, i: usize, j: usize) -> usize {
        match lattice::place(self.n, i, j) {
            Place::Inside(index) => self.inside + index,
            Place::Corner(corner) => self.corners[corner],
            Place::Side { side, position } if self.forward[side] => self.sides[side] + position - 1,
            Place::Side { side, position } => self.sides[side] + self.n - position - 1,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Point;
    use crate::mesh::file::{parse_gmsh, read_bytes};
    use crate::mesh::levels::edge_trace::EdgeNode;
    use std::collections::{HashMap, HashSet};
    use std::path::Path;

    /// Three bodies of 70 triangles, straight.
    fn mesh() -> MacroMesh {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/stack/stack.msh");
        parse_gmsh(&read_bytes(&file).expect("a file"), &file, Default::default()).expect("a mesh")
    }

    /// Macro triangles dealt to ranks as cards are, some ranks with nothing.
    fn deal(mesh: &MacroMesh, size: usize, seed: u64) -> Rc<Partition> {
        let rank = |triangle: usize| ((triangle as u64 + 1).wrapping_mul(seed * 0x9e37_79b9 + 1) >> 7) as usize % size;
        let ranks: Vec<i32> = (0..mesh.triangles.len()).map(|triangle| (rank(triangle) / seed as usize) as i32).collect();
        Rc::new(Partition::new(mesh, &ranks, size))
    }

    /// The same mesh refined towards some vertices.
    fn graded() -> MacroMesh {
        let mut mesh = mesh();
        for (vertex, ratio) in [(0, 0.2), (1, 0.35), (2, 0.15), (20, 0.3)] {
            let at = mesh.vertices[vertex];
            mesh.grade(at, ratio).expect("a vertex");
        }
        mesh
    }

    /// Even and graded, every level of both orders, every number of ranks, several partitions.
    fn everywhere(check: impl Fn(&MacroMesh, &Partition, &Numbering, Option<&Numbering>)) {
        let meshes = [mesh(), graded()];
        let cases = meshes.iter().flat_map(|mesh| (1..=4).flat_map(move |size| (1..=3).map(move |seed| (mesh, size, seed))));
        for (mesh, size, seed) in cases {
            let partition = deal(mesh, size, seed);
            for (order, refine) in [(Order::P1, 3), (Order::P2, 2)] {
                let all = levels(order, refine).into_iter().map(|level| Numbering::new(level, &partition));
                let mut coarse: Option<Numbering> = None;
                for numbering in all {
                    check(mesh, &partition, &numbering, coarse.as_ref());
                    coarse = Some(numbering);
                }
            }
        }
    }

    /// Every node of every macro triangle: its triangle, its place in the lattice, its number, its position.
    fn all_nodes(mesh: &MacroMesh, numbering: &Numbering) -> Vec<(usize, (usize, usize), usize, Point)> {
        let nodes = numbering.nodes_of(mesh, 0..mesh.triangles.len());
        let place = |triangle: usize, at: (usize, usize)| mesh.node_position(triangle, numbering.level, at);
        nodes.map(|(triangle, at, node)| (triangle, at, node, place(triangle, at))).collect()
    }

    /// Positions by number.
    fn positions(mesh: &MacroMesh, numbering: &Numbering) -> HashMap<usize, Point> {
        all_nodes(mesh, numbering).into_iter().map(|(.., number, x)| (number, x)).collect()
    }

    #[test]
    fn numbers_are_a_bijection() {
        everywhere(|mesh, _, numbering, _| {
            let nodes = all_nodes(mesh, numbering);
            let numbers: HashSet<usize> = nodes.iter().map(|(.., number, _)| *number).collect();
            assert_eq!(numbers.len(), numbering.node_count());
            assert_eq!(numbers.into_iter().max(), Some(numbering.node_count() - 1));
        });
    }

    #[test]
    fn one_node_has_one_number_from_whichever_triangle_it_is_seen() {
        everywhere(|mesh, _, numbering, _| {
            let mut seen: HashMap<(u32, i64, i64), usize> = HashMap::new();
            let mut places: HashMap<usize, Point> = HashMap::new();
            for (triangle, _, number, x) in all_nodes(mesh, numbering) {
                let key = (mesh.triangles[triangle].body, (x.x * 1e8).round() as i64, (x.y * 1e8).round() as i64);
                assert_eq!(*seen.entry(key).or_insert(number), number, "two numbers at {x}");
                assert!((places.entry(number).or_insert(x).xy() - x).norm() < 1e-12, "number {number} at two places");
            }
        });
    }

    #[test]
    fn each_rank_has_one_range_of_nodes_that_it_sees() {
        everywhere(|mesh, partition, numbering, _| {
            let ends: Vec<usize> =
                (0..partition.size()).flat_map(|rank| [numbering.range(rank).start, numbering.range(rank).end]).collect();
            assert!(ends[0] == 0 && ends[ends.len() - 1] == numbering.node_count());
            assert!(ends.is_sorted() && ends[1..ends.len() - 1].chunks(2).all(|pair| pair[0] == pair[1]));
            let mut seen = vec![HashSet::new(); partition.size()];
            for (triangle, (i, j), number, _) in all_nodes(mesh, numbering) {
                let rank = partition.owner(triangle as u32);
                seen[rank].insert(number);
                if matches!(lattice::place(numbering.level.intervals, i, j), Place::Inside(_)) {
                    assert!(numbering.range(rank).contains(&number));
                }
            }
            for (rank, seen) in seen.iter().enumerate() {
                assert!(numbering.range(rank).all(|number| seen.contains(&number)), "rank {rank} owns what it does not see");
                assert_eq!(seen.is_empty(), partition.triangles_of(rank).is_empty());
            }
        });
    }

    #[test]
    fn a_macro_triangle_that_is_one_triangle_has_its_corners_and_its_midsides() {
        let mesh = mesh();
        for (order, intervals, nodes) in [(Order::P1, 1, 3), (Order::P2, 2, 6)] {
            let numbering = Numbering::new(Level { intervals, order }, &deal(&mesh, 3, 2));
            assert!(numbering.level.is_one_triangle());
            for triangle in 0..mesh.triangles.len() {
                let numbers = numbering.triangle(&mesh, triangle);
                let all = lattice::Triangle::at(0, 0, order).nodes::<6>().map(|(i, j)| numbers.node(i, j));
                assert_eq!(numbers.of_one::<6>()[..nodes], all[..nodes]);
            }
        }
    }

    #[test]
    fn rows_inside_a_macro_triangle_are_contiguous() {
        everywhere(|mesh, _, numbering, _| {
            let n = numbering.level.intervals;
            let numbers = numbering.triangle(mesh, 5);
            for j in 1..n {
                assert!((2..n - j).all(|i| numbers.node(i, j) == numbers.node(i - 1, j) + 1));
            }
        });
    }

    #[test]
    fn nodes_on_edges_are_those_of_the_triangles_beside() {
        everywhere(|mesh, _, numbering, _| {
            let places = positions(mesh, numbering);
            for node in (0..mesh.edges.len() as u32).flat_map(|edge| EdgeNode::along(edge, numbering.level)) {
                let x = node.place(mesh, numbering);
                assert!((places[&node.number(mesh, numbering)] - x).norm() < 1e-12);
            }
        });
    }

    #[test]
    fn parents_interpolate_linear_functions_exactly() {
        everywhere(|mesh, _, fine, coarse| {
            let Some(coarse) = coarse else { return };
            assert_eq!(fine.level.intervals, 2 * coarse.level.intervals);
            let places = positions(mesh, coarse);
            let linear = |x: Point| 0.3 - 1.7 * x.x + 0.9 * x.y;
            for (triangle, (i, j), _, x) in all_nodes(mesh, fine) {
                let numbers = coarse.triangle(mesh, triangle);
                let [a, b] = lattice::parents(i, j).map(|(i, j)| linear(places[&numbers.node(i, j)]));
                let weights = mesh.parent_weights(triangle, fine.level, (i, j));
                assert!((weights[0] * a + weights[1] * b - linear(x)).abs() < 1e-12);
            }
            for node in (0..mesh.edges.len() as u32).flat_map(|edge| EdgeNode::along(edge, fine.level)) {
                let parents = node.parents(mesh, fine.level);
                let sum: f64 = parents.iter().map(|(parent, weight)| weight * linear(places[&parent.number(mesh, coarse)])).sum();
                assert!((sum - linear(node.place(mesh, fine))).abs() < 1e-12);
            }
        });
    }
}
