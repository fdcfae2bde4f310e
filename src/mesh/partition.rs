//! Which rank owns what: data made of the macro mesh, the same on every rank.

use super::macro_mesh::MacroMesh;
use super::morton::MortonCurve;
use crate::geometry::{Disc, overlapping_discs};

/// The graph that is partitioned: one vertex per macro triangle, compressed rows.
pub struct Graph {
    /// First neighbour of each macro triangle, and the end.
    pub offsets: Vec<i32>,
    /// Neighbours.
    pub neighbours: Vec<i32>,
    /// Weight of each connection.
    pub connection_weights: Vec<i32>,
}

impl Graph {
    /// Shared edges, and the macro triangles that face each other across the boundaries of each contact pair.
    pub fn new(mesh: &MacroMesh, pairs: &[[&[u32]; 2]]) -> Self {
        let mut facing = facing(mesh, pairs);
        facing.sort_unstable();
        let mut graph = Self { offsets: vec![0], neighbours: Vec::new(), connection_weights: Vec::new() };
        let (mut others, mut facing) = (Vec::new(), facing.into_iter().peekable());
        for (at, triangle) in (0..).zip(&mesh.triangles) {
            let across = triangle.edges.iter().flat_map(|&edge| mesh.edges[edge as usize].triangles).flatten();
            others.extend(across.filter(|&other| other != at));
            others.extend(std::iter::from_fn(|| facing.next_if(|[from, _]| *from == at)).map(|[_, to]| to));
            others.sort_unstable();
            for alike in others.chunk_by(|a, b| a == b) {
                graph.neighbours.push(alike[0] as i32);
                graph.connection_weights.push(alike.len() as i32);
            }
            graph.offsets.push(graph.neighbours.len() as i32);
            others.clear();
        }
        graph
    }
}

/// Macro triangles that face each other across the boundaries of contact pairs, from either side.
fn facing(mesh: &MacroMesh, pairs: &[[&[u32]; 2]]) -> Vec<[u32; 2]> {
    let mut facing = Vec::new();
    for [first, second] in pairs {
        let discs = [first, second].map(|edges| edges.iter().map(|&edge| reach(mesh, edge)).collect::<Vec<_>>());
        overlapping_discs(&discs[0], &discs[1], |a, b| {
            if face(mesh, first[a], second[b]) {
                let [a, b] = [mesh.beside(first[a]).0, mesh.beside(second[b]).0];
                facing.extend([[a, b], [b, a]]);
            }
        });
    }
    facing
}

/// Two edges that face each other have discs that overlap: along the first their middles are half their lengths apart at most,
/// across it the longer one's length.
fn reach(mesh: &MacroMesh, edge: u32) -> Disc {
    let [a, b] = mesh.edge_ends(edge);
    Disc { middle: 0.5 * (a + b), radius: 1.25 * (b - a).norm() }
}

/// Whether two boundary edges face each other: seen along the first, they overlap, no farther apart than the longer is long.
fn face(mesh: &MacroMesh, a: u32, b: u32) -> bool {
    let ends = |edge: u32| mesh.edge_ends(edge);
    let ([a0, a1], [b0, b1]) = (ends(a), ends(b));
    let along = (a1 - a0).normalize();
    let (s0, s1) = ((b0 - a0).dot(&along), (b1 - a0).dot(&along));
    let length = (a1 - a0).norm();
    let overlap = s0.max(s1).min(length) - s0.min(s1).max(0.0);
    let apart = crate::geometry::cross(along, 0.5 * (b0 + b1) - a0).abs();
    overlap > 1e-9 * length && apart <= length.max((b1 - b0).norm())
}

/// No place.
const NOWHERE: u32 = u32::MAX;

/// Owner of a macro entity and what comes before it in its owner's numbers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Home {
    pub rank: u32,
    pub vertices_before: u32,
    pub edges_before: u32,
    pub triangles_before: u32,
}

/// Owners of all macro triangles, edges and vertices. A node belongs to the owner of its entity; each rank numbers
/// its entities in the order of its first visit along a space-filling curve through its macro triangles.
#[derive(Debug)]
pub struct Partition {
    /// Four times the place of the macro triangle by which each vertex is visited first, and how many of it were before.
    vertices: Vec<u32>,
    /// The same of each edge.
    edges: Vec<u32>,
    /// Place of each macro triangle, counted through all ranks, where each has one more for its end.
    triangles: Vec<u32>,
    /// Vertices and edges that its rank has visited before each place.
    before: Vec<[u32; 2]>,
    /// First place of each rank, and the end.
    firsts: Vec<u32>,
    /// Vertices, edges and triangles of each rank.
    pub(super) counts: Vec<[u32; 3]>,
    /// Macro triangles of each rank, in its order.
    orders: Vec<Vec<u32>>,
    /// Macro triangles of each rank that have edges or vertices of other ranks.
    borders: Vec<Vec<u32>>,
    /// Macro triangles of other ranks that have edges or vertices of each rank.
    guests: Vec<Vec<u32>>,
}

impl Partition {
    /// From the rank of each macro triangle.
    pub fn new(mesh: &MacroMesh, ranks: &[i32], size: usize) -> Self {
        let mut orders = vec![Vec::new(); size];
        for (triangle, &rank) in ranks.iter().enumerate() {
            orders[rank as usize].push(triangle as u32);
        }
        let keys = morton_keys(mesh);
        orders.iter_mut().for_each(|order| order.sort_by_key(|&triangle| (keys[triangle as usize], triangle)));
        let mut partition = Self {
            vertices: vec![NOWHERE; mesh.vertices.len()],
            edges: vec![NOWHERE; mesh.edges.len()],
            triangles: vec![NOWHERE; mesh.triangles.len()],
            before: Vec::with_capacity(mesh.triangles.len() + size),
            firsts: vec![0],
            counts: vec![[0; 3]; size],
            orders: Vec::new(),
            borders: vec![Vec::new(); size],
            guests: vec![Vec::new(); size],
        };
        for (rank, order) in orders.iter().enumerate() {
            for &triangle in order {
                partition.visit(mesh, rank, triangle as usize);
            }
            let [vertices, edges, _] = partition.counts[rank];
            partition.before.push([vertices, edges]);
            partition.firsts.push(partition.before.len() as u32);
        }
        partition.orders = orders;
        partition
    }

    fn visit(&mut self, mesh: &MacroMesh, rank: usize, triangle: usize) {
        let (place, number) = (self.before.len() as u32, triangle as u32);
        let [vertices, edges, triangles] = &mut self.counts[rank];
        self.before.push([*vertices, *edges]);
        self.triangles[triangle] = place;
        *triangles += 1;
        let triangle = &mesh.triangles[triangle];
        let own = [(&mut self.vertices, triangle.vertices, vertices), (&mut self.edges, triangle.edges, edges)];
        for (visits, entities, count) in own {
            let before = *count;
            for entity in entities {
                let visit = &mut visits[entity as usize];
                if *visit == NOWHERE {
                    *visit = 4 * place + (*count - before);
                    *count += 1;
                } else if *visit / 4 < self.firsts[rank] {
                    let other = self.firsts.partition_point(|first| *first <= *visit / 4) - 1;
                    [&mut self.borders[rank], &mut self.guests[other]]
                        .into_iter()
                        .filter(|of| of.last() != Some(&number))
                        .for_each(|of| of.push(number));
                }
            }
        }
    }

    /// Where a place is: its rank, and what comes before it.
    fn at(&self, place: u32) -> Home {
        let rank = self.firsts.partition_point(|first| *first <= place) - 1;
        let [vertices_before, edges_before] = self.before[place as usize];
        Home { rank: rank as u32, vertices_before, edges_before, triangles_before: place - self.firsts[rank] }
    }

    /// Home of a macro vertex.
    pub(super) fn vertex(&self, vertex: u32) -> Home {
        let visit = self.vertices[vertex as usize];
        let home = self.at(visit / 4);
        Home { vertices_before: home.vertices_before + visit % 4, ..home }
    }

    /// Home of a macro edge: behind the vertices of its triangle.
    pub(super) fn edge(&self, edge: u32) -> Home {
        let visit = self.edges[edge as usize];
        let home = self.at(visit / 4);
        let [vertices_before, _] = self.before[visit as usize / 4 + 1];
        Home { vertices_before, edges_before: home.edges_before + visit % 4, ..home }
    }

    /// Home of a macro triangle: behind its vertices and edges.
    pub(super) fn triangle(&self, triangle: usize) -> Home {
        let place = self.triangles[triangle];
        let [vertices_before, edges_before] = self.before[place as usize + 1];
        Home { vertices_before, edges_before, ..self.at(place) }
    }

    /// The partition in which each `group` ranks with consecutive numbers have given all that they own to the middle one.
    /// Partitioners give neighbouring parts of the mesh to ranks with neighbouring numbers.
    pub fn brought_together(&self, mesh: &MacroMesh, group: usize) -> Self {
        let middle = |triangle: u32| middle_of_group(self.owner(triangle), group, self.size()) as i32;
        Self::new(mesh, &(0..self.triangles.len() as u32).map(middle).collect::<Vec<_>>(), self.size())
    }

    /// Number of ranks.
    pub fn size(&self) -> usize {
        self.counts.len()
    }

    /// Macro triangles of a rank, in its order.
    pub fn triangles_of(&self, rank: usize) -> &[u32] {
        &self.orders[rank]
    }

    /// Macro triangles of a rank with nodes of other ranks, in its order.
    pub fn with_nodes_of_others(&self, rank: usize) -> &[u32] {
        &self.borders[rank]
    }

    /// Macro triangles of other ranks with nodes of this one.
    pub fn of_others_with_nodes(&self, rank: usize) -> &[u32] {
        &self.guests[rank]
    }

    /// Owner of a macro triangle.
    pub fn owner(&self, triangle: u32) -> usize {
        let place = self.triangles[triangle as usize];
        self.firsts.partition_point(|first| *first <= place) - 1
    }
}

/// The rank that works for the group of `rank`: the middle one. So groups of 2, 4, 8, … ranks choose different ranks, and no
/// single rank has the coarse levels of all sizes.
pub fn middle_of_group(rank: usize, group: usize, ranks: usize) -> usize {
    (rank / group * group + (group - 1) / 2).min(ranks - 1)
}

/// Position of each macro triangle along Morton's space-filling curve, body by body.
fn morton_keys(mesh: &MacroMesh) -> Vec<u64> {
    let curve = MortonCurve::around(&mesh.vertices);
    let place = |triangle: &super::macro_mesh::MacroTriangle| curve.place(&mesh.vertices, triangle.vertices);
    mesh.triangles.iter().map(|triangle| u64::from(triangle.body) << 44 | place(triangle)).collect()
}

#[cfg(test)]
mod tests {
    use super::super::raw_mesh::RawMesh;
    use super::super::samples::two_blocks;
    use super::*;
    use crate::geometry::Point;
    use std::collections::HashSet;
    use std::path::Path;

    const CELLS: usize = 8;

    /// Two squares beside each other, of 8 x 8 cells each of two triangles, which stand in the file in no order.
    fn squares() -> MacroMesh {
        let mut raw = RawMesh::default();
        for (body, left) in [("first", 0.0), ("second", 10.0)] {
            let first = raw.vertices.len();
            let at = |i: usize, j: usize| first + j * (CELLS + 1) + i;
            for j in 0..=CELLS {
                raw.vertices.extend((0..=CELLS).map(|i| Point::new(left + i as f64, j as f64)));
            }
            for cell in (0..CELLS * CELLS).map(|k| (k * 37 + 11) % (CELLS * CELLS)) {
                let (i, j) = (cell % CELLS, cell / CELLS);
                let corners = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                raw.add(body, [[corners[0], corners[1], corners[2]], [corners[0], corners[2], corners[3]]]);
            }
        }
        MacroMesh::build(raw, Path::new("squares.msh")).expect("a good mesh")
    }

    /// Neighbours of a macro triangle with their weights.
    fn beside(graph: &Graph, triangle: u32) -> Vec<(i32, i32)> {
        let row = graph.offsets[triangle as usize] as usize..graph.offsets[triangle as usize + 1] as usize;
        graph.neighbours[row.clone()].iter().copied().zip(graph.connection_weights[row].iter().copied()).collect()
    }

    fn edges<'a>(mesh: &'a MacroMesh, name: &str) -> &'a [u32] {
        &mesh.boundary(name).expect("a boundary").edges
    }

    #[test]
    fn triangles_that_share_an_edge_or_face_each_other_are_connected() {
        let mesh = two_blocks();
        let alone = Graph::new(&mesh, &[]);
        let [lower, upper] = ["lower.seam", "upper.seam"].map(|name| edges(&mesh, name));
        let facing = Graph::new(&mesh, &[[lower, upper]]);
        let [below] = lower.iter().map(|&edge| mesh.beside(edge).0).collect::<Vec<_>>()[..] else { panic!("one edge below") };
        let above: Vec<i32> = upper.iter().map(|&edge| mesh.beside(edge).0 as i32).collect();
        assert_eq!(above.len(), 2);
        for triangle in 0..mesh.triangles.len() as u32 {
            let body = mesh.triangles[triangle as usize].body;
            assert!(beside(&alone, triangle).iter().all(|(other, _)| mesh.triangles[*other as usize].body == body));
            let mut expected = beside(&alone, triangle);
            if triangle == below {
                expected.extend(above.iter().map(|&other| (other, 1)));
            }
            if above.contains(&(triangle as i32)) {
                expected.push((below as i32, 1));
            }
            expected.sort_unstable();
            assert_eq!(beside(&facing, triangle), expected);
        }
        assert_eq!(alone.neighbours.len(), 2 * (1 + 3), "inner edges of both blocks, from both sides");
        // Connected twice, they weigh twice.
        let twice = Graph::new(&mesh, &[[lower, upper], [lower, upper]]);
        assert!(beside(&twice, below).iter().all(|(other, weight)| *weight == if above.contains(other) { 2 } else { 1 }));
    }

    #[test]
    fn edges_face_each_other_that_overlap_and_are_near() {
        let mesh = two_blocks();
        let at = |name: &str, x: f64| -> u32 {
            let middle = |edge: u32| {
                let [a, b] = mesh.edge_ends(edge);
                0.5 * (a.x + b.x)
            };
            *edges(&mesh, name).iter().find(|&&edge| (middle(edge) - x).abs() < 1e-12).expect("an edge")
        };
        let [seam, other, top] = [at("upper.seam", 0.45), at("upper.seam", 1.45), at("top", 0.45)];
        assert!(face(&mesh, at("lower.seam", 1.0), seam) && face(&mesh, at("lower.seam", 1.0), other));
        assert!(!face(&mesh, seam, other) && !face(&mesh, other, seam), "they touch at their ends alone");
        assert!(!face(&mesh, seam, top), "0.9 long, and 1 apart");
        assert!(face(&mesh, at("bottom", 1.0), seam), "1 apart, and one of them is 2 long");
    }

    /// A space-filling curve: what follows each other lies together, in quarters of quarters.
    #[test]
    fn triangles_of_a_rank_follow_a_curve_that_fills_one_body_after_the_other() {
        let mesh = squares();
        let count = mesh.triangles.len();
        let partition = Partition::new(&mesh, &vec![0; count], 1);
        let order = partition.triangles_of(0);
        assert_eq!(order.iter().collect::<HashSet<_>>().len(), count);
        let middle = |triangle: u32| {
            let [a, b, c] = mesh.corners(triangle as usize);
            (a + b + c) / 3.0
        };
        for (body, triangles) in order.chunks(count / 2).enumerate() {
            assert!(triangles.iter().all(|&triangle| mesh.triangles[triangle as usize].body as usize == body));
        }
        // Cells of the curve are squares of the size of the whole, 18, by powers of two: fewer cells than triangles.
        for level in 1..4 {
            let size = 18.0 / f64::from(1 << level);
            for body in 0..2 {
                let mut squares: Vec<[i32; 2]> = order
                    .iter()
                    .filter(|&&triangle| mesh.triangles[triangle as usize].body as usize == body)
                    .map(|&triangle| [middle(triangle).x, middle(triangle).y].map(|x| (x / size) as i32))
                    .collect();
                squares.dedup();
                let different: HashSet<_> = squares.iter().collect();
                assert_eq!(squares.len(), different.len(), "level {level}: no square is come back to");
            }
        }
    }

    #[test]
    fn one_of_each_group_of_ranks_owns_what_all_of_them_did() {
        let mesh = squares();
        let ranks: Vec<i32> = (0..mesh.triangles.len() as i32).map(|k| k / 11 % 7).collect();
        let all = Partition::new(&mesh, &ranks, 7);
        for (group, middle_of) in [(2, [0, 0, 2, 2, 4, 4, 6]), (4, [1, 1, 1, 1, 5, 5, 5]), (8, [3; 7])] {
            let fewer = all.brought_together(&mesh, group);
            assert_eq!(fewer.size(), 7);
            for (triangle, &rank) in ranks.iter().enumerate() {
                assert_eq!(fewer.owner(triangle as u32), middle_of[rank as usize]);
            }
            let sums = |partition: &Partition| {
                let sum = |k: usize| partition.counts.iter().map(|counts| counts[k]).sum::<u32>();
                [sum(0), sum(1), sum(2)]
            };
            assert_eq!(sums(&fewer), sums(&all));
        }
    }

    #[test]
    fn every_entity_belongs_to_the_rank_of_a_triangle_that_has_it() {
        let mesh = squares();
        let ranks: Vec<i32> = (0..mesh.triangles.len() as i32).map(|k| k / 7 % 3).collect();
        let partition = Partition::new(&mesh, &ranks, 3);
        let mut counts = [[0; 3]; 3];
        for (at, triangle) in mesh.triangles.iter().enumerate() {
            let rank = partition.triangle(at).rank;
            assert!(triangle.vertices.iter().all(|&v| partition.vertex(v).rank <= rank), "the first that has it");
            assert!(triangle.edges.iter().all(|&e| partition.edge(e).rank <= rank));
            counts[rank as usize][2] += 1;
        }
        (0..mesh.vertices.len() as u32).for_each(|vertex| counts[partition.vertex(vertex).rank as usize][0] += 1);
        (0..mesh.edges.len() as u32).for_each(|edge| counts[partition.edge(edge).rank as usize][1] += 1);
        assert_eq!(partition.counts, counts);
        for (triangle, &rank) in ranks.iter().enumerate() {
            assert_eq!(partition.owner(triangle as u32), rank as usize);
            assert!(partition.triangles_of(rank as usize).contains(&(triangle as u32)));
        }
    }
}
