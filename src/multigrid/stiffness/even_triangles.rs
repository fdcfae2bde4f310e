//! Inner nodes of even macro triangles: all of them have the couplings of their row, which are not stored. Macro triangles are
//! worked on in lattices of their own, several side by side.

use super::couplings::Couplings;
use super::registers::{side_by_side, triangles_kernel};
use super::sweep_order::SweepHalves;
use super::triangle_kernel::{InnerNodes, TriangleKernel, TriangleTask};
use crate::element::Block;
use crate::element::block::product;
use crate::mesh::lattice;
use crate::multigrid::triangle_lattice::{Lane, LatticeRoom, TriangleNodes, clear_sides, side_nodes};
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;

/// Even macro triangles of this rank that are worked on as a whole.
#[derive(Default)]
pub struct EvenTriangles {
    /// Lattice intervals.
    pub n: usize,
    /// Couplings of the rows of each of them.
    pub couplings: Rc<Vec<Vec<Couplings>>>,
    /// Those that are worked on side by side.
    groups: Rc<Vec<Group>>,
    /// Where they lie.
    pub triangles: Vec<TriangleNodes>,
    /// Lattices to work in.
    room: RefCell<[LatticeRoom; 2]>,
}

/// Macro triangles side by side.
struct Group {
    /// Which they are.
    members: Vec<usize>,
    /// Their first inner nodes.
    first: Vec<usize>,
    /// Whether the nodes on the sides of all of them are here; otherwise none of them has all here.
    is_here: bool,
    kernel: Box<dyn TriangleKernel>,
}

impl Group {
    /// Does a task on inner nodes of lattices with `n` intervals; `own` has the values of the nodes on the sides.
    fn work(&self, n: usize, own: &mut [[f64; 2]], task: TriangleTask) {
        self.kernel.work(InnerNodes { n, first: &self.first }, own, task);
    }
}

impl EvenTriangles {
    /// Of triangles with these couplings.
    pub fn new(n: usize, couplings: Rc<Vec<Vec<Couplings>>>, triangles: Vec<TriangleNodes>) -> Self {
        let mut groups = Vec::new();
        for is_here in [true, false] {
            let all: Vec<usize> = (0..triangles.len()).filter(|&k| triangles[k].is_here == is_here).collect();
            let mut rest = all.as_slice();
            while !rest.is_empty() {
                let (members, others) = rest.split_at(side_by_side(rest.len()));
                let of_members: Vec<&[Couplings]> = members.iter().map(|&k| couplings[k].as_slice()).collect();
                let first = members.iter().map(|&k| triangles[k].inner.start).collect();
                groups.push(Group { members: members.to_vec(), first, is_here, kernel: triangles_kernel(&of_members) });
                rest = others;
            }
        }
        Self { n, couplings, groups: Rc::new(groups), triangles, room: RefCell::default() }
    }

    /// Which macro triangles are worked on side by side, and how many a lattice has room for.
    pub fn groups(&self) -> impl Iterator<Item = (&[usize], usize)> {
        self.groups.iter().map(|group| (group.members.as_slice(), group.kernel.width()))
    }

    /// The values of the nodes on the sides of a group, in a lattice; lanes that are left over repeat the last one.
    fn sides<'a>(&self, group: &Group, x: &[[f64; 2]], far: &[[f64; 2]], room: &'a mut LatticeRoom) -> &'a mut [[f64; 2]] {
        let width = group.kernel.width();
        let own = room.lattice(self.n, width);
        for at in 0..width {
            let member = group.members[at.min(group.members.len() - 1)];
            self.triangles[member].bring_sides(x, far, Lane { width, at }, own);
        }
        own
    }

    /// `y = K x` at inner nodes of those macro triangles whose sides are all here, or not; `far` are the values of other ranks, none
    /// stands for zeros.
    pub fn multiply(&self, is_here: bool, x: &[[f64; 2]], far: &[[f64; 2]], y: &mut [[f64; 2]]) {
        let [room, own] = &mut *self.room.borrow_mut();
        for group in self.groups.iter().filter(|group| group.is_here == is_here) {
            let room = room.lattice(self.n, group.kernel.width());
            group.work(self.n, self.sides(group, x, far, own), TriangleTask::Multiply { x, room, y });
        }
    }

    /// `r = b - K x` at inner nodes of those macro triangles whose sides are all here, or not.
    pub fn residual(&self, is_here: bool, b: &[[f64; 2]], x: &[[f64; 2]], far: &[[f64; 2]], r: &mut [[f64; 2]]) {
        let [room, own] = &mut *self.room.borrow_mut();
        for group in self.groups.iter().filter(|group| group.is_here == is_here) {
            let width = group.kernel.width();
            let room = room.lattice(self.n, width);
            group.work(self.n, self.sides(group, x, far, own), TriangleTask::Residual { b, x, r: room });
            for (at, &member) in group.members.iter().enumerate() {
                self.triangles[member].take_inner(room, Lane { width, at }, r);
            }
        }
    }

    /// The residual of one of [`EvenTriangles::groups`] in a lattice, with zeros on its sides.
    pub fn residual_of(&self, group: usize, b: &[[f64; 2]], x: &[[f64; 2]], far: &[[f64; 2]], r: &mut [[f64; 2]]) {
        let [_, own] = &mut *self.room.borrow_mut();
        let group = &self.groups[group];
        group.work(self.n, self.sides(group, x, far, own), TriangleTask::Residual { b, x, r });
        clear_sides(self.n, group.kernel.width(), r);
    }

    /// A Gauss-Seidel sweep over the inner nodes of all macro triangles: they do not couple.
    pub fn relax(&self, sweep: SweepHalves, b: &[[f64; 2]], x: &mut [[f64; 2]], far: &[[f64; 2]]) {
        let [_, own] = &mut *self.room.borrow_mut();
        for group in &*self.groups {
            group.work(self.n, self.sides(group, x, far, own), TriangleTask::Relax { sweep, b, x });
        }
    }
}

impl EvenTriangles {
    /// The same with other places for the columns of other ranks; this rank has `near` nodes.
    pub fn moved(&self, near: usize, moved: &[u32]) -> Self {
        let triangles = self.triangles.iter().map(|triangle| triangle.moved(near, moved)).collect();
        Self { n: self.n, couplings: self.couplings.clone(), groups: self.groups.clone(), triangles, room: RefCell::default() }
    }

    /// Shows the rows of all inner nodes: the node, and its couplings, that with itself first; columns are counted as
    /// [`TriangleNodes::sides`].
    pub fn each_row(&self, mut show: impl FnMut(usize, &[(usize, Block)])) {
        let n = self.n;
        let mut row = Vec::new();
        let on_sides: BTreeMap<(usize, usize), u32> = side_nodes(n).zip(0..).collect();
        for (triangle, couplings) in self.triangles.iter().zip(&*self.couplings) {
            let turned: BTreeMap<_, _> = triangle.turned.iter().copied().collect();
            for (i, j) in (1..n - 1).flat_map(|j| (1..n - j).map(move |i| (i, j))) {
                row.clear();
                row.extend(couplings[j % couplings.len()].of(i).iter().map(|&((di, dj), block)| {
                    let (k, l) = (i.wrapping_add_signed(di as isize), j.wrapping_add_signed(dj as isize));
                    if let lattice::Place::Inside(place) = lattice::place(n, k, l) {
                        return (triangle.inner.start + place, block);
                    }
                    let side = on_sides[&(k, l)];
                    (triangle.sides[side as usize] as usize, turned.get(&side).map_or(block, |frame| product(&block, frame)))
                }));
                show(triangle.inner.start + lattice::row_start(n, j) + i - 1, &row);
            }
        }
    }
}
