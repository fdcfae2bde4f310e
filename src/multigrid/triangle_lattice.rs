//! Macro triangles in lattices of their own, with the nodes on their sides: what is done to their inner nodes needs no others.
//!
//! A lattice holds one macro triangle, or several of them side by side: then the values of the same node of each follow one
//! another, and fill a vector register. Lattices of up to some 128 intervals stay in the cache.

use crate::body::Constraint;
use crate::discretisation::Space;
use crate::element::Block;
use crate::mesh::{TriangleNumbers, lattice};
use std::ops::Range;

/// Memory for a lattice. It begins with a line of the cache: registers that lie in two lines are read twice.
#[derive(Clone, Default)]
pub struct LatticeRoom(Vec<[f64; 2]>);

/// Bytes of a line of the cache.
const LINE: usize = 64;

impl LatticeRoom {
    /// A lattice with `n` intervals for `width` macro triangles; its values are what was there before, or zeros.
    pub fn lattice(&mut self, n: usize, width: usize) -> &mut [[f64; 2]] {
        let (nodes, line) = (width * lattice::node_count(n), LINE / size_of::<[f64; 2]>());
        if self.0.len() < nodes + line {
            self.0 = vec![[0.0; 2]; nodes + line];
        }
        // Where it cannot be told, any place will do.
        let first = self.0.as_ptr().align_offset(LINE).min(line);
        &mut self.0[first..first + nodes]
    }
}

/// The place of one macro triangle in a lattice of several.
#[derive(Clone, Copy, Debug)]
pub struct Lane {
    /// Macro triangles in the lattice.
    pub width: usize,
    /// Those before this one.
    pub at: usize,
}

impl Lane {
    /// Of the only one.
    pub const ALONE: Self = Self { width: 1, at: 0 };

    /// Place of node `(i, j)`.
    #[inline(always)]
    fn node(self, n: usize, i: usize, j: usize) -> usize {
        lattice::index(n, i, j) * self.width + self.at
    }

    /// Places of the inner nodes of row `j`.
    #[inline(always)]
    fn inner(self, n: usize, j: usize) -> impl Iterator<Item = usize> {
        (self.node(n, 1, j)..self.node(n, n - j, j)).step_by(self.width)
    }
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

/// The place of a node: counted from the first of those that are `here`, or behind all of these by its place among those that are
/// `far`, ascending.
///
/// # Panics
/// If it is neither here nor in the list.
pub fn place_among(node: usize, here: &Range<usize>, far: &[usize]) -> u32 {
    let place = match here.contains(&node) {
        true => node - here.start,
        false => here.len() + far.binary_search(&node).expect("a known node"),
    };
    place as u32
}

/// Inner nodes of each row: places in a lattice of one macro triangle, and among all inner nodes.
pub fn inner_rows(n: usize) -> impl Iterator<Item = (Range<usize>, Range<usize>)> {
    (1..n - 1).map(move |j| {
        let (start, first, count) = (lattice::index(n, 1, j), lattice::row_start(n, j), n - 1 - j);
        (start..start + count, first..first + count)
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
        let place = |node: usize| place_among(node, here, far);
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
    pub fn bring(&self, x: &[[f64; 2]], far: &[[f64; 2]], own: &mut [[f64; 2]]) {
        let inner = &x[self.inner.clone()];
        inner_rows(self.n).for_each(|(to, from)| own[to].copy_from_slice(&inner[from]));
        self.bring_sides(x, far, Lane::ALONE, own);
    }

    /// Brings those of the nodes on the sides to their places in a lattice of several macro triangles.
    pub fn bring_sides(&self, x: &[[f64; 2]], far: &[[f64; 2]], lane: Lane, own: &mut [[f64; 2]]) {
        let (n, here) = (self.n, x.len());
        let value = |&at: &u32| match (at as usize).checked_sub(here) {
            None => x[at as usize],
            Some(at) => far.get(at).copied().unwrap_or_default(),
        };
        let (below, rows) = self.sides.split_at(n + 1);
        own[lane.at..].iter_mut().step_by(lane.width).zip(below).for_each(|(to, at)| *to = value(at));
        for (j, ends) in (1..).zip(rows.as_chunks::<2>().0) {
            own[lane.node(n, 0, j)] = value(&ends[0]);
            own[lane.node(n, n - j, j)] = value(&ends[1]);
        }
        own[lane.node(n, 0, n)] = value(&rows[2 * (n - 1)]);
        for (k, frame) in &self.turned {
            let (i, j) = side_node(n, *k as usize);
            let x = &mut own[lane.node(n, i, j)];
            *x = frame.map(|row| row[0] * x[0] + row[1] * x[1]);
        }
    }

    /// Takes the values of the inner nodes from a lattice.
    pub fn take_inner(&self, own: &[[f64; 2]], lane: Lane, x: &mut [[f64; 2]]) {
        let x = &mut x[self.inner.clone()];
        for (j, (_, to)) in (1..).zip(inner_rows(self.n)) {
            x[to].iter_mut().zip(lane.inner(self.n, j)).for_each(|(to, from)| *to = own[from]);
        }
    }

    /// Adds the values of a lattice, which are forces: the transposed of [`TriangleNodes::bring`].
    pub fn give(&self, own: &mut [[f64; 2]], lane: Lane, x: &mut [[f64; 2]], far: &mut [[f64; 2]]) {
        let (n, here) = (self.n, x.len());
        for (k, frame) in &self.turned {
            let (i, j) = side_node(n, *k as usize);
            let x = &mut own[lane.node(n, i, j)];
            *x = [0, 1].map(|k| frame[0][k] * x[0] + frame[1][k] * x[1]);
        }
        let inner = &mut x[self.inner.clone()];
        for (j, (_, to)) in (1..).zip(inner_rows(n)) {
            inner[to].iter_mut().zip(lane.inner(n, j)).for_each(|(to, from)| add(to, &own[from]));
        }
        for (&at, (i, j)) in self.sides.iter().zip(side_nodes(n)) {
            let value = &own[lane.node(n, i, j)];
            match (at as usize).checked_sub(here) {
                None => add(&mut x[at as usize], value),
                Some(at) => add(&mut far[at], value),
            }
        }
    }
}

#[inline(always)]
fn add(sum: &mut [f64; 2], value: &[f64; 2]) {
    sum[0] += value[0];
    sum[1] += value[1];
}

/// Makes zeros of the nodes on the sides of a lattice of so many macro triangles.
pub fn clear_sides(n: usize, width: usize, own: &mut [[f64; 2]]) {
    let mut end = 0;
    for (row, _) in inner_rows(n) {
        own[width * end..width * row.start].fill([0.0; 2]);
        end = row.end;
    }
    own[width * end..].fill([0.0; 2]);
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
    fn lattices_begin_with_lines_of_the_cache() {
        let mut room = LatticeRoom::default();
        for (n, width) in [(8, 2), (16, 4), (8, 1)] {
            let lattice = room.lattice(n, width);
            assert_eq!(lattice.len(), width * lattice::node_count(n));
            assert_eq!(lattice.as_ptr().align_offset(LINE), 0);
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
