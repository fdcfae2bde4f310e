//! A macro triangle in a lattice of its own, with the nodes on its sides: what is done to its inner nodes needs no others.
//!
//! Row follows row, so that a step leads equally far from each node of a row. A lattice of few hundred intervals fits into the
//! cache.

use super::Space;
use super::space::Real;
use crate::body::Constraint;
use crate::element::{Block, Order};
use crate::mesh::{Level, TriangleNumbers, lattice};
use std::ops::Range;

/// Places before the first row of a lattice, and behind its last one, that vector registers may touch.
const MARGIN: usize = 24;

/// Places of a row come in so many: those of the largest vector register.
const WIDTH: usize = 8;

/// Place of the first node of row `j` of a lattice with `n` intervals. Each row fills whole registers, and as many places as one
/// has are free behind it.
#[inline(always)]
pub fn row_start(n: usize, j: usize) -> usize {
    // Rows have n + 1 - j nodes; those before row j are whole groups of eight, and the rest of the longest ones.
    let rows = |last: usize| {
        let (groups, rest) = (last / WIDTH, last % WIDTH);
        WIDTH * (groups * (groups + 1) / 2 * WIDTH + rest * (groups + 1))
    };
    MARGIN + WIDTH * j + rows(n + 1) - rows(n + 1 - j)
}

/// Zeros for a lattice with `n` intervals.
pub fn zeros<T: Real>(n: usize) -> Vec<[T; 2]> {
    vec![[T::default(); 2]; row_start(n, n + 1) + MARGIN]
}

/// Whether macro triangles of a level are worked on as a whole. On coarser lattices the work is less than that of bringing them
/// there; finer ones do not fit into the cache. With P1 the rows alone are faster by a tenth: they have few couplings, and the
/// sides no more than two in a hundred of the nodes.
pub fn is_whole(level: Level) -> bool {
    level.order == Order::P2 && (16..=256).contains(&level.intervals)
}

/// The nodes on the sides of a lattice, row by row.
pub fn side_nodes(n: usize) -> impl Iterator<Item = (usize, usize)> {
    let rows = (1..n).flat_map(move |j| [(0, j), (n - j, j)]);
    (0..=n).map(|i| (i, 0)).chain(rows).chain([(0, n)])
}

/// The `k`-th of [`side_nodes`].
fn side_node(n: usize, k: usize) -> (usize, usize) {
    match k.checked_sub(n + 1) {
        None => (k, 0),
        Some(k) if k / 2 + 1 == n => (0, n),
        Some(k) => (if k % 2 == 0 { 0 } else { n - (k / 2 + 1) }, k / 2 + 1),
    }
}

/// Inner nodes of each row: places in a lattice, and among all inner nodes.
pub fn inner_rows(n: usize) -> impl Iterator<Item = (Range<usize>, Range<usize>)> {
    let mut next = 0;
    (1..n - 1).map(move |j| {
        let (start, count) = (row_start(n, j) + 1, n - 1 - j);
        next += count;
        (start..start + count, next - count..next)
    })
}

/// Where a macro triangle lies among nodes of a rank, or of all ranks.
#[derive(Clone, Debug)]
pub struct TriangleNodes {
    /// Lattice intervals.
    n: usize,
    /// Its inner nodes, counted from the first node that is here.
    pub inner: Range<usize>,
    /// The nodes on its sides, in the order of [`side_nodes`]: counted from the first node that is here, and those that are
    /// elsewhere behind all of these, by their places in a list.
    pub sides: Vec<u32>,
    /// Which of them have frames or prescribed components, and what makes global axes of their free ones.
    pub turned: Vec<(u32, Block)>,
    /// Whether all of them are here.
    pub is_here: bool,
}

impl TriangleNodes {
    /// From the numbers of its nodes, of which `here` are here and `far`, ascending, elsewhere.
    ///
    /// # Panics
    /// If a node is neither here nor in the list.
    pub fn new(numbers: &TriangleNumbers, space: &Space, here: &Range<usize>, far: &[usize]) -> Self {
        let n = space.numbering.level.intervals;
        let first = numbers.node(1, 1) - here.start;
        let nodes = || side_nodes(n).map(|(i, j)| numbers.node(i, j));
        let place = |node: usize| match here.contains(&node) {
            true => (node - here.start) as u32,
            false => (here.len() + far.binary_search(&node).expect("a known node")) as u32,
        };
        let turned = nodes().zip(0..).filter_map(|(node, k)| Some((k, free_frame(space.constraints.get(node)?))));
        Self {
            n,
            inner: first..first + lattice::inner_count(n),
            turned: turned.collect(),
            sides: nodes().map(place).collect(),
            is_here: nodes().all(|node| here.contains(&node)),
        }
    }

    /// The same with other places of nodes elsewhere; `here` nodes are here.
    pub fn moved(&self, here: usize, moved: &[u32]) -> Self {
        let place = |at: u32| (at as usize).checked_sub(here).map_or(at, |far| here as u32 + moved[far]);
        Self { sides: self.sides.iter().map(|&at| place(at)).collect(), ..self.clone() }
    }

    /// Brings the values of all nodes into a lattice, in global axes; without values of nodes elsewhere these are zero.
    pub fn bring<T: Real>(&self, x: &[[T; 2]], far: &[[T; 2]], own: &mut [[T; 2]]) {
        self.bring_inner(x, own);
        self.bring_sides(x, far, own);
    }

    /// Brings those of the nodes on the sides.
    pub fn bring_sides<T: Real>(&self, x: &[[T; 2]], far: &[[T; 2]], own: &mut [[T; 2]]) {
        let (n, here) = (self.n, x.len());
        let value = |&at: &u32| match (at as usize).checked_sub(here) {
            None => x[at as usize],
            Some(at) => far.get(at).copied().unwrap_or_default(),
        };
        let (below, rows) = self.sides.split_at(n + 1);
        own[row_start(n, 0)..][..=n].iter_mut().zip(below).for_each(|(to, at)| *to = value(at));
        for (j, ends) in (1..).zip(rows.as_chunks::<2>().0) {
            let start = row_start(n, j);
            own[start] = value(&ends[0]);
            own[start + n - j] = value(&ends[1]);
        }
        own[row_start(n, n)] = value(&rows[2 * (n - 1)]);
        for (k, frame) in &self.turned {
            let (i, j) = side_node(n, *k as usize);
            let x = &mut own[row_start(n, j) + i];
            *x = frame.map(|row| T::of(row[0]) * x[0] + T::of(row[1]) * x[1]);
        }
    }

    /// Brings the values of the inner nodes.
    pub fn bring_inner<T: Real>(&self, x: &[[T; 2]], own: &mut [[T; 2]]) {
        let x = &x[self.inner.clone()];
        inner_rows(self.n).for_each(|(to, from)| own[to].copy_from_slice(&x[from]));
    }

    /// Takes the values of the inner nodes from a lattice.
    pub fn take_inner<T: Real>(&self, own: &[[T; 2]], x: &mut [[T; 2]]) {
        let x = &mut x[self.inner.clone()];
        inner_rows(self.n).for_each(|(from, to)| x[to].copy_from_slice(&own[from]));
    }

    /// Adds the values of a lattice, which are forces: the transposed of [`TriangleNodes::bring`].
    pub fn give<T: Real>(&self, own: &mut [[T; 2]], x: &mut [[T; 2]], far: &mut [[T; 2]]) {
        let (n, here) = (self.n, x.len());
        for (k, frame) in &self.turned {
            let (i, j) = side_node(n, *k as usize);
            let x = &mut own[row_start(n, j) + i];
            *x = [0, 1].map(|k| T::of(frame[0][k]) * x[0] + T::of(frame[1][k]) * x[1]);
        }
        let inner = &mut x[self.inner.clone()];
        inner_rows(n).for_each(|(from, to)| inner[to].iter_mut().zip(&own[from]).for_each(|(to, from)| add(to, from)));
        for (&at, (i, j)) in self.sides.iter().zip(side_nodes(n)) {
            let value = &own[row_start(n, j) + i];
            match (at as usize).checked_sub(here) {
                None => add(&mut x[at as usize], value),
                Some(at) => add(&mut far[at], value),
            }
        }
    }
}

#[inline(always)]
fn add<T: Real>(sum: &mut [T; 2], value: &[T; 2]) {
    sum[0] += value[0];
    sum[1] += value[1];
}

/// Makes zeros of all places of a lattice but those of its inner nodes.
pub fn clear_sides<T: Real>(n: usize, own: &mut [[T; 2]]) {
    let mut end = 0;
    for (row, _) in inner_rows(n) {
        own[end..row.start].fill([T::default(); 2]);
        end = row.end;
    }
    own[end..].fill([T::default(); 2]);
}

/// What makes global axes of the free components of a node.
fn free_frame(constraint: &Constraint) -> Block {
    let frame = constraint.frame();
    std::array::from_fn(|a| std::array::from_fn(|b| if constraint.fixed[b] { 0.0 } else { frame[(a, b)] }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_fill_registers_and_leave_room() {
        for n in 1..40 {
            assert_eq!(row_start(n, 0), MARGIN);
            for j in 0..=n {
                let places = (n + 1 - j).div_ceil(WIDTH) * WIDTH + WIDTH;
                assert_eq!(row_start(n, j + 1) - row_start(n, j), places, "n = {n}, j = {j}");
            }
        }
    }

    #[test]
    fn nodes_on_sides_are_found_by_their_places() {
        for n in [1, 2, 3, 8] {
            let all: Vec<_> = side_nodes(n).collect();
            assert_eq!(all.len(), 3 * n);
            assert!(all.iter().all(|&(i, j)| !matches!(lattice::place(n, i, j), lattice::Place::Inside(_))));
            assert!((0..3 * n).all(|k| side_node(n, k) == all[k]));
        }
    }
}
