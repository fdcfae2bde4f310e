//! Strips: parts of lattice rows in which all nodes look alike.

use crate::element::Order;
use crate::mesh::lattice;
use crate::mesh::levels::numbering::Level;
use crate::mesh::macro_mesh::MacroMesh;
use std::ops::Range;

/// Fewer nodes are not worth a strip.
const SHORTEST: usize = 4;

/// Consecutive nodes `(i, j)` of a lattice row whose triangles are translations of one another and whose neighbours all lie
/// inside the macro triangle: their couplings repeat, with the node's parity for P2, whose strips begin at an even `i`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Strip {
    /// Row of the lattice.
    pub j: usize,
    /// Places in the row.
    pub i: Range<usize>,
    /// Shape of the triangles around ([`crate::mesh::levels::hierarchy::Shapes`]).
    pub shape: usize,
}

impl MacroMesh {
    /// Whether all triangles of a macro triangle at a level have one stiffness: they are translations and point reflections of one
    /// another, in the plane.
    pub fn is_even(&self, triangle: usize, level: Level) -> bool {
        self.repeats(triangle) && self.shapes(triangle, level).is_one()
    }

    /// The strips of a macro triangle at a level, row by row; one without repeated stiffnesses has none.
    pub fn strips(&self, triangle: usize, level: Level) -> Vec<Strip> {
        if !self.repeats(triangle) {
            return Vec::new();
        }
        let shapes = self.shapes(triangle, level);
        if shapes.is_one() {
            return rows(level).filter_map(|(j, i)| strip(level.order, j, i, 0)).collect();
        }
        let n = level.intervals;
        let mut known = vec![Around::Nothing; lattice::node_count(n)];
        for small in lattice::triangles(n, level.order) {
            let shape = Around::One(shapes.of(small.nodes::<3>()));
            let nodes = small.nodes::<6>();
            for &(i, j) in &nodes[..level.order.nodes()] {
                let around = &mut known[lattice::index(n, i, j)];
                *around = if *around == Around::Nothing || *around == shape { shape } else { Around::Several };
            }
        }
        let alike = |j: usize, i: Range<usize>| {
            let around = known[lattice::index(n, i.start, j)..][..i.len()].to_vec();
            let mut at = i.start;
            let parts: Vec<_> = around.chunk_by(|a, b| a == b).map(|part| (part[0], part.len())).collect();
            parts.into_iter().filter_map(move |(around, count)| {
                at += count;
                match around {
                    Around::One(shape) => strip(level.order, j, at - count..at, shape),
                    _ => None,
                }
            })
        };
        rows(level).flat_map(|(j, i)| alike(j, i).collect::<Vec<_>>()).collect()
    }
}

/// Lattice intervals at which strips of graded triangles are counted: finer ones have as many more rows beside the lines where
/// shapes meet as these are longer.
const COUNTED: usize = 64;

impl Level {
    /// Whether even macro triangles are worked on as a whole, without strips. On coarser lattices the work is less than that of
    /// bringing their values together; on finer ones of P1, which do not fit into the cache, strips are faster, and finer ones of
    /// P2 would take much memory.
    pub fn is_whole(self) -> bool {
        match self.order {
            Order::P1 => (8..=128).contains(&self.intervals),
            Order::P2 => (16..=1024).contains(&self.intervals),
        }
    }

    /// Nodes in the strips of an even macro triangle.
    pub fn nodes_in_strips(self) -> usize {
        rows(self).filter_map(|(j, i)| strip(self.order, j, i, 0)).map(|strip| strip.i.len()).sum()
    }
}

impl MacroMesh {
    /// Nodes in the strips of a macro triangle at a level, of which an even one has `even`; roughly for a graded one.
    pub fn nodes_in_strips(&self, triangle: usize, level: Level, even: usize) -> usize {
        if !self.repeats(triangle) {
            return 0;
        }
        if !self.is_graded(triangle) {
            return even;
        }
        let counted = Level { intervals: level.intervals.min(COUNTED), ..level };
        let in_strips: usize = self.strips(triangle, counted).iter().map(|strip| strip.i.len()).sum();
        let stored = lattice::inner_count(counted.intervals) - in_strips;
        lattice::inner_count(level.intervals).saturating_sub(stored * (level.intervals / counted.intervals))
    }
}

/// Shapes of the triangles around a node.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Around {
    Nothing,
    One(usize),
    Several,
}

/// Nodes whose neighbours all lie inside, row by row.
fn rows(level: Level) -> impl Iterator<Item = (usize, Range<usize>)> {
    let (n, margin) = (level.intervals, level.order.degree() + 1);
    (margin..n.saturating_sub(2 * margin - 1)).map(move |j| (j, margin..n + 1 - margin - j))
}

fn strip(order: Order, j: usize, mut i: Range<usize>, shape: usize) -> Option<Strip> {
    if order == Order::P2 {
        i.start += i.start % 2;
    }
    (i.end >= i.start + SHORTEST).then_some(Strip { j, i, shape })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::lattice::Place;
    use crate::mesh::samples::two_blocks;

    #[test]
    fn strips_of_an_even_triangle_hold_all_nodes_but_those_near_its_sides() {
        let mesh = two_blocks();
        let covered = |n, order| mesh.strips(1, Level { intervals: n, order }).iter().map(|strip| strip.i.len()).sum::<usize>();
        assert_eq!(covered(32, Order::P1), (28 * 27) / 2 - 1 - 2 - 3, "the last three rows are too short");
        assert_eq!(covered(64, Order::P2), (55 * 56) / 2 - 1 - 2 - 3, "strips begin at even places");
        assert_eq!(covered(4, Order::P1), 0);
    }

    #[test]
    fn neighbours_of_strips_lie_inside_and_have_one_shape() {
        let mut mesh = two_blocks();
        mesh.grade([0.9, 1.0].into(), 0.2).expect("a vertex");
        mesh.grade([2.0, 2.0].into(), 0.3).expect("a vertex");
        for (triangle, order) in (0..mesh.triangles.len()).flat_map(|t| [(t, Order::P1), (t, Order::P2)]) {
            let level = Level { intervals: 32, order };
            let reach = order.degree();
            let shapes = mesh.shapes(triangle, level);
            let strips = mesh.strips(triangle, level);
            assert!(!strips.is_empty());
            for Strip { j, i, shape } in strips {
                assert!(order == Order::P1 || i.start % 2 == 0);
                for (k, l) in [(i.start - reach, j), (i.end - 1 + reach, j), (i.start, j - reach), (i.end - 1, j + reach)] {
                    assert!(matches!(lattice::place(32, k, l), Place::Inside(_)));
                }
                let near = lattice::triangles(32, order)
                    .map(|small| small.nodes::<3>())
                    .filter(|nodes| nodes.iter().any(|&(k, l)| l == j && i.contains(&k)));
                near.for_each(|nodes| assert_eq!(shapes.of(nodes), shape, "triangle {triangle}, row {j}"));
            }
        }
    }

    #[test]
    fn strips_are_counted_without_being_made() {
        let mut mesh = two_blocks();
        mesh.grade([2.0, 2.0].into(), 0.3).expect("a vertex");
        for (triangle, order) in (0..mesh.triangles.len()).flat_map(|t| [(t, Order::P1), (t, Order::P2)]) {
            for intervals in [2, 16, 64, 256] {
                let level = Level { intervals, order };
                let made: usize = mesh.strips(triangle, level).iter().map(|strip| strip.i.len()).sum();
                let counted = mesh.nodes_in_strips(triangle, level, level.nodes_in_strips());
                let stored = |count: usize| (lattice::inner_count(intervals) - count) as f64;
                let exact = intervals <= 64 || !mesh.is_graded(triangle);
                let apart = (stored(counted) - stored(made)).abs();
                assert!(apart <= if exact { 0.0 } else { 0.15 * stored(made) }, "{triangle} {level:?}: {counted} of {made}");
            }
        }
    }

    #[test]
    fn a_bent_triangle_has_none() {
        let mut mesh = two_blocks();
        let circle = crate::geometry::Curve::Circle { centre: [1.0, -2.0], radius: 10f64.sqrt() };
        mesh.bend("arc", &["lower.seam".into()], &circle).expect("the ends lie on it");
        let bent = (0..2).find(|&t| mesh.is_curved(t)).expect("one triangle has the arc");
        assert!(mesh.strips(bent, Level { intervals: 32, order: Order::P1 }).is_empty());
    }
}
