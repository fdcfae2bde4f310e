//! Which rank owns what: data made of the macro mesh, the same on every rank.

use super::MacroMesh;
use crate::geometry::Point;

/// The graph that is partitioned: one vertex per macro triangle, compressed rows.
pub struct Graph {
    /// First neighbour of each macro triangle, and the end.
    pub offsets: Vec<i32>,
    /// Neighbours.
    pub neighbours: Vec<i32>,
    /// Weight of each connection.
    pub weights: Vec<i32>,
}

impl Graph {
    /// Shared edges, and the macro triangles that face each other across the boundaries of each contact pair.
    pub fn new(mesh: &MacroMesh, pairs: &[[&[u32]; 2]]) -> Self {
        let mut connections: Vec<(i32, i32)> = Vec::new();
        let mut connect = |a: u32, b: u32| connections.extend([(a as i32, b as i32), (b as i32, a as i32)]);
        for edge in &mesh.edges {
            if let [Some(a), Some(b)] = edge.triangles {
                connect(a, b);
            }
        }
        for [first, second] in pairs {
            for &a in *first {
                for &b in second.iter().filter(|&&b| face(mesh, a, b)) {
                    connect(mesh.beside(a).0, mesh.beside(b).0);
                }
            }
        }
        connections.sort_unstable();
        let mut graph = Self { offsets: vec![0], neighbours: Vec::new(), weights: Vec::new() };
        let mut at = 0;
        for triangle in 0..mesh.triangles.len() as i32 {
            while at < connections.len() && connections[at].0 == triangle {
                let same = connections[at..].iter().take_while(|c| **c == connections[at]).count();
                graph.neighbours.push(connections[at].1);
                graph.weights.push(same as i32);
                at += same;
            }
            graph.offsets.push(graph.neighbours.len() as i32);
        }
        graph
    }
}

/// Whether two boundary edges face each other: seen along the first, they overlap, no farther apart than the longer is long.
fn face(mesh: &MacroMesh, a: u32, b: u32) -> bool {
    let ends = |edge: u32| mesh.edges[edge as usize].vertices.map(|vertex| mesh.vertices[vertex as usize]);
    let ([a0, a1], [b0, b1]) = (ends(a), ends(b));
    let along = (a1 - a0).normalize();
    let (s0, s1) = ((b0 - a0).dot(&along), (b1 - a0).dot(&along));
    let length = (a1 - a0).norm();
    let overlap = s0.max(s1).min(length) - s0.min(s1).max(0.0);
    let apart = crate::geometry::cross(along, 0.5 * (b0 + b1) - a0).abs();
    overlap > 1e-9 * length && apart <= length.max((b1 - b0).norm())
}

/// Owner of a macro entity and what comes before it in its owner's numbers.
#[derive(Clone, Copy, Debug, Default)]
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
    pub(super) vertices: Vec<Home>,
    pub(super) edges: Vec<Home>,
    pub(super) triangles: Vec<Home>,
    /// Vertices, edges and triangles of each rank.
    pub(super) counts: Vec<[u32; 3]>,
    /// Macro triangles of each rank, in its order.
    orders: Vec<Vec<u32>>,
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
            vertices: vec![Home { rank: u32::MAX, ..Home::default() }; mesh.vertices.len()],
            edges: vec![Home { rank: u32::MAX, ..Home::default() }; mesh.edges.len()],
            triangles: vec![Home::default(); mesh.triangles.len()],
            counts: vec![[0; 3]; size],
            orders: Vec::new(),
        };
        for (rank, order) in orders.iter().enumerate() {
            for &triangle in order {
                partition.visit(mesh, rank, triangle as usize);
            }
        }
        partition.orders = orders;
        partition
    }

    fn visit(&mut self, mesh: &MacroMesh, rank: usize, triangle: usize) {
        let counts = &mut self.counts[rank];
        let here = |counts: &[u32; 3]| Home {
            rank: rank as u32,
            vertices_before: counts[0],
            edges_before: counts[1],
            triangles_before: counts[2],
        };
        for &vertex in &mesh.triangles[triangle].vertices {
            if self.vertices[vertex as usize].rank == u32::MAX {
                self.vertices[vertex as usize] = here(counts);
                counts[0] += 1;
            }
        }
        for &edge in &mesh.triangles[triangle].edges {
            if self.edges[edge as usize].rank == u32::MAX {
                self.edges[edge as usize] = here(counts);
                counts[1] += 1;
            }
        }
        self.triangles[triangle] = here(counts);
        counts[2] += 1;
    }

    /// Number of ranks.
    pub fn size(&self) -> usize {
        self.counts.len()
    }

    /// Macro triangles of a rank, in its order.
    pub fn triangles_of(&self, rank: usize) -> &[u32] {
        &self.orders[rank]
    }

    /// Owner of a macro triangle.
    pub fn owner(&self, triangle: u32) -> usize {
        self.triangles[triangle as usize].rank as usize
    }
}

/// Position of each macro triangle along Morton's space-filling curve, body by body.
fn morton_keys(mesh: &MacroMesh) -> Vec<u64> {
    let (mut low, mut high) = (Point::repeat(f64::INFINITY), Point::repeat(f64::NEG_INFINITY));
    for x in &mesh.vertices {
        (low, high) = (low.inf(x), high.sup(x));
    }
    let size = (high - low).max();
    let spread = |v: f64| {
        let bits = (v / size * f64::from(1u32 << 20)) as u64;
        (0..21).fold(0, |key, k| key | ((bits >> k) & 1) << (2 * k))
    };
    let key = |triangle: &super::MacroTriangle| {
        let [a, b, c] = triangle.vertices.map(|vertex| mesh.vertices[vertex as usize]);
        let middle = (a + b + c) / 3.0 - low;
        u64::from(triangle.body) << 44 | spread(middle.x) | spread(middle.y) << 1
    };
    mesh.triangles.iter().map(key).collect()
}
