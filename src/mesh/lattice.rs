//! The lattice of one macro triangle: `n` intervals per edge, nodes `(i, j)` with `i, j >= 0`, `i + j <= n`.
//!
//! ```text
//!  corner 2 = (0, n)
//!     | \            edge 0: j = 0,     from corner 0 to corner 1
//!     |  \           edge 1: i + j = n, from corner 1 to corner 2
//!     |   \          edge 2: i = 0,     from corner 2 to corner 0
//!  corner 0 - corner 1 = (n, 0)
//! ```
//! Rows of equal `j` are contiguous in every numbering. Node `(i, j)` stands at the barycentric coordinates
//! `(1 - (i + j) / n, i / n, j / n)`.

use crate::element::Order;

/// Where a lattice node lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// At corner 0, 1 or 2.
    Corner(usize),
    /// On edge `side`, `position` intervals (0 < position < n) from the edge's first corner.
    Side {
        /// Edge 0, 1 or 2.
        side: usize,
        /// Intervals from corner `side`.
        position: usize,
    },
    /// Inside, so many nodes after the first inner node.
    Inside(usize),
}

/// Place of node `(i, j)` at `n` intervals.
#[inline]
pub fn place(n: usize, i: usize, j: usize) -> Place {
    let k = n - i - j;
    match (k, i, j) {
        (_, 0, 0) => Place::Corner(0),
        (0, _, 0) => Place::Corner(1),
        (0, 0, _) => Place::Corner(2),
        (_, _, 0) => Place::Side { side: 0, position: i },
        (0, _, _) => Place::Side { side: 1, position: j },
        (_, 0, _) => Place::Side { side: 2, position: n - j },
        _ => Place::Inside(row_start(n, j) + i - 1),
    }
}

/// Inner nodes before row `j` (1 <= j).
#[inline]
pub fn row_start(n: usize, j: usize) -> usize {
    (j - 1) * (n - 1) - (j - 1) * j / 2
}

/// Number of inner nodes.
pub fn inner_count(n: usize) -> usize {
    if n < 3 { 0 } else { (n - 1) * (n - 2) / 2 }
}

/// Number of all nodes.
pub fn node_count(n: usize) -> usize {
    (n + 1) * (n + 2) / 2
}

/// Index of node `(i, j)` among all nodes of the lattice, row by row.
#[inline]
pub fn index(n: usize, i: usize, j: usize) -> usize {
    j * (n + 1) - j * (j.saturating_sub(1)) / 2 + i
}

/// All nodes, row by row.
pub fn nodes(n: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..=n).flat_map(move |j| (0..=n - j).map(move |i| (i, j)))
}

/// Node at `position` intervals along edge `side`, counted from corner `side`.
pub fn side_node(n: usize, side: usize, position: usize) -> (usize, usize) {
    match side {
        0 => (position, 0),
        1 => (n - position, position),
        _ => (0, n - position),
    }
}

/// Nodes on the sides, around the triangle from corner 0 on.
pub fn sides(n: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..3).flat_map(move |side| (0..n).map(move |position| side_node(n, side, position)))
}

/// Triangles of the lattice for an element order: their nodes, corners first, then the midsides of (01), (12), (20).
///
/// A triangle that points up comes with `false`, its point reflection with `true`; both have the corner order that
/// makes them counter-clockwise, so a straight macro triangle has one element matrix for all of them.
pub fn triangles(n: usize, order: Order) -> impl Iterator<Item = Triangle> {
    let step = order.degree();
    let count = n / step;
    (0..count).flat_map(move |j| (0..count - j).flat_map(move |i| pair(i, j, step, count)))
}

/// The triangle at place `i` of row `j` that points up, and the one behind it that points down, if there is one.
#[inline]
fn pair(i: usize, j: usize, step: usize, count: usize) -> impl Iterator<Item = Triangle> {
    let up = Triangle { i: step * i, j: step * j, step, down: false };
    let down = Triangle { i: step * (i + 1), j: step * (j + 1), step, down: true };
    [Some(up), (i + j + 2 <= count).then_some(down)].into_iter().flatten()
}

/// Those triangles of the lattice that have a node on one of its sides, in the order of [`triangles`].
pub fn side_triangles(n: usize, order: Order) -> impl Iterator<Item = Triangle> {
    let step = order.degree();
    let count = n / step;
    (0..count).flat_map(move |j| {
        // The first of a row, and the last two: the hypotenuses of the others lie inside.
        let last = (count - j).saturating_sub(2).max(1);
        let middle = if j == 0 { 1..last } else { last..last };
        (0..1).chain(middle).chain(last..count - j).flat_map(move |i| pair(i, j, step, count))
    })
}

/// One triangle of a lattice.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Triangle {
    i: usize,
    j: usize,
    step: usize,
    /// Whether it is the point reflection of the upward triangle.
    pub down: bool,
}

impl Triangle {
    /// The triangle that points up and whose first corner is `(i, j)`.
    pub fn at(i: usize, j: usize, order: Order) -> Self {
        Self { i, j, step: order.degree(), down: false }
    }

    /// The triangle of the parallelogram at place `i` of row `j` that holds a point, at the fractions `(x, y)` of its sides, in a
    /// lattice with `count` triangles on an edge; and the barycentric coordinates there.
    pub fn holding((i, j): (usize, usize), (x, y): (f64, f64), count: usize, order: Order) -> (Self, [f64; 3]) {
        let step = order.degree();
        match x + y > 1.0 && i + j + 2 <= count {
            true => (Self { i: step * (i + 1), j: step * (j + 1), step, down: true }, [x + y - 1.0, 1.0 - x, 1.0 - y]),
            false => (Self { i: step * i, j: step * j, step, down: false }, [1.0 - x - y, x, y]),
        }
    }

    /// The `N` nodes of the triangle: 3 for P1, 6 for P2.
    #[inline]
    pub fn nodes<const N: usize>(&self) -> [(usize, usize); N] {
        let half = self.step as isize;
        let offsets: [(isize, isize); 6] = if self.step == 1 {
            [(0, 0), (1, 0), (0, 1), (0, 0), (0, 0), (0, 0)]
        } else {
            [(0, 0), (half, 0), (0, half), (1, 0), (1, 1), (0, 1)]
        };
        std::array::from_fn(|a| {
            let (di, dj) = offsets[a];
            let sign = if self.down { -1 } else { 1 };
            ((self.i as isize + sign * di) as usize, (self.j as isize + sign * dj) as usize)
        })
    }
}

/// The two nodes of the lattice with `n / 2` intervals whose mean is node `(i, j)` of the lattice with `n`; the same
/// node twice where the coarse lattice has it.
#[inline]
pub fn parents(i: usize, j: usize) -> [(usize, usize); 2] {
    let (a, b) = (i / 2, j / 2);
    match (i % 2, j % 2) {
        (0, 0) => [(a, b), (a, b)],
        (1, 0) => [(a, b), (a + 1, b)],
        (0, _) => [(a, b), (a, b + 1)],
        _ => [(a + 1, b), (a, b + 1)],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;

    #[test]
    fn inner_nodes_are_contiguous_row_by_row() {
        for n in 1..=9 {
            let inner: Vec<usize> = nodes(n)
                .filter_map(|(i, j)| match place(n, i, j) {
                    Place::Inside(index) => Some(index),
                    _ => None,
                })
                .collect();
            assert_eq!(inner, (0..inner_count(n)).collect::<Vec<_>>());
            assert_eq!(nodes(n).count(), node_count(n));
            assert!(nodes(n).enumerate().all(|(k, (i, j))| index(n, i, j) == k));
        }
    }

    #[test]
    fn sides_run_from_corner_to_corner() {
        for side in 0..3 {
            assert_eq!(side_node(5, side, 0), side_node(5, (side + 2) % 3, 5));
            for position in 1..5 {
                let (i, j) = side_node(5, side, position);
                assert_eq!(place(5, i, j), Place::Side { side, position });
            }
        }
    }

    #[test]
    fn triangles_cover_the_macro_triangle_once() {
        for (order, n) in [(Order::P1, 5), (Order::P2, 6)] {
            let count = n / order.degree();
            let all: Vec<_> = triangles(n, order).map(|t| t.nodes::<3>()).collect();
            assert_eq!(all.len(), count * count);
            assert_eq!(all.iter().collect::<HashSet<_>>().len(), count * count);
            for [a, b, c] in all {
                let d = |p: (usize, usize)| (p.0 as i64 - a.0 as i64, p.1 as i64 - a.1 as i64);
                let (b, c) = (d(b), d(c));
                assert_eq!(b.0 * c.1 - b.1 * c.0, (order.degree() * order.degree()) as i64, "counter-clockwise");
            }
        }
    }

    #[test]
    fn triangles_at_the_sides_are_those_with_a_node_there() {
        let on_side = |n, (i, j)| !matches!(place(n, i, j), Place::Inside(_));
        for (order, counts) in [(Order::P1, 1..10), (Order::P2, 1..7)] {
            for n in counts.map(|count| count * order.degree()) {
                let found: HashSet<_> = side_triangles(n, order).map(|t| t.nodes::<3>()).collect();
                let all = triangles(n, order).map(|t| t.nodes::<3>());
                let wanted: HashSet<_> = all.filter(|nodes| nodes.iter().any(|&node| on_side(n, node))).collect();
                assert!(wanted.is_subset(&found), "n = {n}");
                assert!(found.len() == side_triangles(n, order).count() && found.len() <= wanted.len() + n, "n = {n}: each once");
            }
        }
    }

    #[test]
    fn midsides_lie_between_their_corners() {
        for triangle in triangles(8, Order::P2) {
            let n = triangle.nodes::<6>();
            for k in 0..3 {
                let (a, b, m) = (n[k], n[(k + 1) % 3], n[3 + k]);
                assert_eq!((2 * m.0, 2 * m.1), (a.0 + b.0, a.1 + b.1));
            }
        }
    }

    #[test]
    fn a_node_is_the_mean_of_its_parents() {
        for (i, j) in nodes(8) {
            let [a, b] = parents(i, j);
            assert_eq!((a.0 + b.0, a.1 + b.1), (i, j));
            assert!(a.0 + a.1 <= 4 && b.0 + b.1 <= 4);
        }
    }
}
