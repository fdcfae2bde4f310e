//! How macro triangles are dealt to thousands of ranks, computed in one process: neighbours, halo and balance of work.
//!
//! `cargo bench --bench partition --no-run` names the program; `PROGRAM COLUMNS ROWS RANKS` deals two bars of so many cells each,
//! of two macro triangles, and prints a line of JSON for each order. `docs/scaling/make` runs it.

#[path = "../support/mesh.rs"]
#[allow(dead_code)] // Other programs use the rest.
mod meshes;

use meshes::{Mesh, grid};
use mezha::element::Order;
use mezha::mesh::{Graph, MacroMesh, Numbering, Partition, levels, parse_gmsh};
use mezha::petsc::{Session, partition};
use std::collections::HashSet;
use std::rc::Rc;
use std::time::Instant;

/// Refinements: some hundred nodes inside each macro triangle.
const REFINE: usize = 5;

/// Bytes of a node's two components.
const BYTES: usize = 16;

fn main() {
    let words: Vec<usize> = std::env::args().skip(1).filter_map(|word| word.parse().ok()).collect();
    let [columns, rows, size] = words[..] else {
        println!("partition: give COLUMNS ROWS RANKS");
        return;
    };
    let session = Session::start(&[], &[]).expect("PETSc starts");
    let text = two_bars(columns, rows).text();
    let mesh = parse_gmsh(text.as_bytes(), "bars.msh".as_ref(), Default::default()).expect("a mesh");
    for order in [Order::P1, Order::P2] {
        deal(&mesh, order, size, &session);
    }
}

fn two_bars(columns: usize, rows: usize) -> Mesh {
    let (length, height) = (columns as f64, rows as f64);
    let lower = grid(columns, rows, 1, |u, v| [length * u, height * v]);
    let upper = grid(columns - 1, rows, 2, |u, v| [length * u, height * (1.0 + v)]);
    Mesh {
        bodies: vec![
            ("lower", lower, ["bottom", "right", "lower.seam", "left"]),
            ("upper", upper, ["upper.seam", "right", "top", "left"]),
        ],
    }
}

fn deal(mesh: &MacroMesh, order: Order, size: usize, session: &Session) {
    let start = Instant::now();
    let sides = ["lower.seam", "upper.seam"].map(|name| mesh.boundary(name).expect("named").edges.as_slice());
    let (graph, work) = (Graph::new(mesh, &[sides]), mesh.work(order, REFINE));
    let ranks = partition(session, size, &graph.offsets, &graph.neighbours, &graph.connection_weights, &work);
    let dealt = Rc::new(Partition::new(mesh, &ranks.expect("a partition"), size));
    let seconds = start.elapsed().as_secs_f64();
    let works: Vec<f64> =
        (0..size).map(|rank| dealt.triangles_of(rank).iter().map(|&t| f64::from(work[t as usize])).sum()).collect();
    let levels = levels(order, REFINE);
    let numbering = Numbering::new(levels[levels.len() - 1], &dealt);
    let nodes: Vec<f64> = (0..size).map(|rank| numbering.range(rank).len() as f64).collect();
    let halo = Halo::new(mesh, &dealt, &numbering);
    println!(
        "{{\"order\": {}, \"ranks\": {size}, \"triangles\": {}, \"refine\": {REFINE}, \"nodes\": {}, \"seconds\": {seconds:.3}, \
         \"work\": {}, \"owned\": {}, \"neighbours\": {}, \"halo_bytes\": {}}}",
        order.degree(),
        mesh.triangles.len(),
        numbering.node_count(),
        figures(&works),
        figures(&nodes),
        figures(&halo.neighbours),
        figures(&halo.bytes),
    );
}

/// Mean and largest value over the ranks.
fn figures(values: &[f64]) -> String {
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    format!("{{\"mean\": {mean:.3}, \"most\": {:.3}}}", values.iter().copied().fold(0.0, f64::max))
}

/// What each rank receives of others before a sweep on the finest level.
struct Halo {
    neighbours: Vec<f64>,
    bytes: Vec<f64>,
}

impl Halo {
    /// The rows that a rank owns couple to nodes of its own and of others; the inner nodes of a macro triangle to its sides, the
    /// nodes of a side to those of the lattice rows beside it.
    fn new(mesh: &MacroMesh, dealt: &Partition, numbering: &Numbering) -> Self {
        let size = dealt.size();
        let owner_of = |node: usize| {
            let (mut low, mut high) = (0, size);
            while high - low > 1 {
                let middle = (low + high) / 2;
                if numbering.range(middle).start <= node { low = middle } else { high = middle }
            }
            low
        };
        let (n, reach) = (numbering.level.intervals, numbering.level.order.degree());
        let mut wanted: Vec<HashSet<usize>> = vec![HashSet::new(); size];
        for triangle in 0..mesh.triangles.len() {
            let (numbers, own) = (numbering.triangle(mesh, triangle), dealt.owner(triangle as u32));
            let corners = [numbers.node(0, 0), numbers.node(n, 0), numbers.node(0, n)];
            let middles = [numbers.node(1, 0), numbers.node(n - 1, 1), numbers.node(0, 1)];
            let owners = corners.iter().chain(&middles).map(|&node| owner_of(node)).chain([own]).collect::<HashSet<_>>();
            if owners.len() == 1 {
                continue;
            }
            // Nodes near the sides with those that they couple to.
            let near = |i: usize, j: usize| i <= reach || j <= reach || i + j + reach >= n;
            for (i, j) in (0..=n).flat_map(|j| (0..=n - j).map(move |i| (i, j))).filter(|&(i, j)| near(i, j)) {
                let here = owner_of(numbers.node(i, j));
                for (k, l) in around(i, j, n, numbering.level.order) {
                    let node = numbers.node(k, l);
                    if !numbering.range(here).contains(&node) {
                        wanted[here].insert(node);
                    }
                }
            }
        }
        let neighbours = wanted.iter().map(|nodes| nodes.iter().map(|&node| owner_of(node)).collect::<HashSet<_>>().len() as f64);
        Self { neighbours: neighbours.collect(), bytes: wanted.iter().map(|nodes| (BYTES * nodes.len()) as f64).collect() }
    }
}

/// Nodes of the lattice that a node couples to: by its triangles, which span two intervals for P2.
fn around(i: usize, j: usize, n: usize, order: Order) -> Vec<(usize, usize)> {
    let steps = mezha::body::neighbours(order, i, j);
    let at = |&(di, dj): &(isize, isize)| (i.wrapping_add_signed(di), j.wrapping_add_signed(dj));
    steps.iter().map(at).filter(|&(k, l)| k <= n && l <= n && k + l <= n).collect()
}
