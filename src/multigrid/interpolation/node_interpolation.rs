//! Interpolation by nodes: whole macro triangles, halved rows inside of others, and a list of the other nodes.

use super::halved_rows::{HalvedRow, HalvedRows};
use super::parents::{NodeParents, Parentage};
use super::whole;
use crate::discretisation::{Scene, Space};
use crate::element::Block;
use crate::geometry::Point;
use crate::mesh::{each_once, lattice};
use crate::multigrid::triangle_lattice::{Lane, LatticeRoom, TriangleNodes, place_among, side_nodes};
use crate::petsc::{Halo, Session};
use std::ops::Range;

/// Linear interpolation from a coarse level to the next finer one. A node takes over the value of its coarse twin, or the
/// weighted mean of its two parents, turned from their frames into its own. Rows of prescribed fine components and columns
/// of prescribed coarse ones are zero.
pub struct NodeInterpolation {
    /// Macro triangles whose inner nodes are worked on as a whole.
    whole: Vec<WholeTriangle>,
    /// Fine lattice intervals.
    n: usize,
    halved: HalvedRows,
    others: CouplingLists,
    /// Nodes that take nothing over.
    unparented: Vec<u32>,
    /// Coarse nodes here, and how many are elsewhere: in lists they come behind those here.
    coarse: usize,
    halo: Halo,
    far: usize,
}

/// Couplings of the nodes that are worked on one by one.
#[derive(Default)]
struct CouplingLists {
    /// Nodes in the middle of two parents, or on one of them twice.
    even: Vec<[u32; 3]>,
    /// Other couplings: of graded edges, of auxiliary levels, and of supports.
    weighted: Vec<(u32, u32, f64)>,
    turned: Vec<(u32, u32, Block)>,
}

impl CouplingLists {
    /// Of the nodes that have these parents; `far` are the coarse nodes of other ranks, ascending.
    fn new(rows: &NodeParents, fine: &Space, coarse: &Space, far: &[usize]) -> Self {
        let place = |node: usize| place_among(node, &coarse.own, far);
        let mut lists = Self::default();
        for (node, pair) in rows.iter() {
            let (at, weights) = ((node - fine.own.start) as u32, rows.weights(node));
            let plain = fine.constraints.get(node).is_none() && pair.iter().all(|&p| coarse.constraints.get(p).is_none());
            if plain && weights == [0.5; 2] {
                lists.even.push([at, place(pair[0]), place(pair[1])]);
                continue;
            }
            for (parent, weight) in pair.into_iter().zip(weights) {
                let coupling = Parentage { node, parent, weight, turned: turned(fine, coarse, node, parent) };
                lists.push(coupling, at, place(parent));
            }
        }
        lists
    }

    /// Adds a coupling of nodes at these places.
    fn push(&mut self, coupling: Parentage, at: u32, parent: u32) {
        match coupling.turned {
            None => self.weighted.push((at, parent, coupling.weight)),
            Some(_) => self.turned.push((at, parent, coupling.block())),
        }
    }
}

/// A macro triangle whose inner nodes are worked on as a whole.
struct WholeTriangle {
    /// Its fine inner nodes, counted from the first that is here.
    fine: Range<usize>,
    coarse: TriangleNodes,
}

/// Lattices to work in: a fine one with zeros on its sides, and a coarse one.
#[derive(Default)]
pub struct InterpolationRoom([LatticeRoom; 2]);

impl InterpolationRoom {
    /// With a fine lattice with `n` intervals, and for so many macro triangles.
    fn lattices(&mut self, n: usize, width: usize) -> [&mut [[f64; 2]]; 2] {
        let [fine, coarse] = &mut self.0;
        [fine.lattice(n, width), coarse.lattice(n / 2, width)]
    }
}

impl NodeInterpolation {
    /// To the fine nodes of this rank; coarse ones of other ranks come through a halo. **Collective**
    pub fn new(scene: &Scene, fine: &Space, coarse: &Space, session: &Session) -> Self {
        let (level, rank) = (fine.numbering.level, session.rank());
        // Where the coarse level is on fewer ranks, a macro triangle may have its coarse nodes on another one: then its fine nodes
        // are in lists.
        let is_here = |triangle: &u32| coarse.numbering.partition.owner(*triangle) == rank;
        let mut here: Vec<u32> = fine.numbering.partition.triangles_of(rank).iter().copied().filter(is_here).collect();
        here.sort_unstable();
        let (whole, others): (Vec<u32>, Vec<u32>) =
            here.into_iter().partition(|&triangle| scene.mesh.is_whole(triangle as usize, level));
        let halved = HalvedRows::new(scene, fine, coarse, &others);
        let n = level.intervals;
        let left_out = |triangle: u32, j: usize| match whole.binary_search(&triangle) {
            Ok(_) if j == 0 || j + 1 >= n => 0..0,
            Ok(_) => 1..n - j,
            Err(_) if is_here(&triangle) => HalvedRow::places(n, j),
            Err(_) => 0..0,
        };
        let rows = NodeParents::new(scene, fine, coarse, rank, left_out);
        let numbers = |triangle: &u32| coarse.numbering.triangle(&scene.mesh, *triangle as usize);
        let sides = whole.iter().flat_map(|triangle| {
            let numbers = numbers(triangle);
            side_nodes(n / 2).map(move |(i, j)| numbers.node(i, j))
        });
        let parents = rows.iter().flat_map(|(_, pair)| pair).chain(sides);
        let far = each_once(parents.filter(|node| !coarse.own.contains(node)));
        let others = CouplingLists::new(&rows, fine, coarse, &far);
        let halo = Halo::new(session, &coarse.own, &far);
        let whole = whole.iter().map(|triangle| {
            let first = fine.numbering.triangle(&scene.mesh, *triangle as usize).node(1, 1) - fine.own.start;
            let coarse = TriangleNodes::new(&numbers(triangle), coarse, &coarse.own, &far);
            WholeTriangle { fine: first..first + lattice::inner_count(n), coarse }
        });
        Self { whole: whole.collect(), n, halved, others, unparented: Vec::new(), coarse: coarse.own.len(), halo, far: far.len() }
    }

    /// From a list of all couplings of the fine nodes of this rank. **Collective**
    pub fn of_couplings(
        couplings: impl Iterator<Item = Parentage> + Clone,
        fine: &Range<usize>,
        coarse: &Range<usize>,
        session: &Session,
    ) -> Self {
        let parents = couplings.clone().map(|coupling| coupling.parent);
        let far = each_once(parents.filter(|parent| !coarse.contains(parent)));
        let (mut others, mut has_parent) = (CouplingLists::default(), vec![false; fine.len()]);
        for coupling in couplings {
            has_parent[coupling.node - fine.start] = true;
            let parent = place_among(coupling.parent, coarse, &far);
            others.push(coupling, (coupling.node - fine.start) as u32, parent);
        }
        let halo = Halo::new(session, coarse, &far);
        let unparented = (0..fine.len() as u32).filter(|&node| !has_parent[node as usize]).collect();
        let (whole, halved) = (Vec::new(), HalvedRows::default());
        Self { whole, n: 0, halved, others, unparented, coarse: coarse.len(), halo, far: far.len() }
    }

    /// Whether its whole macro triangles are these, by their inner nodes.
    pub fn is_of(&self, inner: impl Iterator<Item = Range<usize>>) -> bool {
        self.whole.iter().map(|triangle| triangle.fine.clone()).eq(inner)
    }

    /// `y += P x`, or `y = P x`. **Collective**
    pub fn prolong<const ADD: bool>(&self, x: &[[f64; 2]], y: &mut [[f64; 2]], room: &mut InterpolationRoom) {
        let mut far = vec![[0.0; 2]; self.far];
        self.halo.fetch(x, &mut far, || self.prolong_inside::<ADD>(true, x, &[], y, room));
        self.prolong_inside::<ADD>(false, x, &far, y, room);
        let coarse = self.coarse;
        let value = |at: u32| if (at as usize) < coarse { x[at as usize] } else { far[at as usize - coarse] };
        for &[node, a, b] in &self.others.even {
            let (a, b, to) = (value(a), value(b), &mut y[node as usize]);
            (0..2).for_each(|k| to[k] = 0.5 * (a[k] + b[k]) + if ADD { to[k] } else { 0.0 });
        }
        if !ADD {
            self.unparented.iter().for_each(|&node| y[node as usize] = [0.0; 2]);
            self.others.weighted.iter().for_each(|&(node, ..)| y[node as usize] = [0.0; 2]);
            self.others.turned.iter().for_each(|&(node, ..)| y[node as usize] = [0.0; 2]);
        }
        for &(node, parent, weight) in &self.others.weighted {
            let x = value(parent);
            (0..2).for_each(|k| y[node as usize][k] += weight * x[k]);
        }
        for &(node, parent, block) in &self.others.turned {
            let x = value(parent);
            (0..2).for_each(|k| y[node as usize][k] += block[k][0] * x[0] + block[k][1] * x[1]);
        }
    }

    /// The same inside of macro triangles whose coarse nodes are all here, or not.
    fn prolong_inside<const ADD: bool>(
        &self,
        is_here: bool,
        x: &[[f64; 2]],
        far: &[[f64; 2]],
        y: &mut [[f64; 2]],
        room: &mut InterpolationRoom,
    ) {
        for triangle in self.whole.iter().filter(|triangle| triangle.coarse.is_here == is_here) {
            let [_, coarse] = room.lattices(self.n, 1);
            triangle.coarse.bring(x, far, coarse);
            whole::prolong::<ADD>(self.n, coarse, &mut y[triangle.fine.clone()]);
        }
        if is_here {
            if !ADD {
                self.halved.clear(y);
            }
            self.halved.prolong(x, y);
        }
    }

    /// `x = Pᵀ y`. **Collective**
    pub fn restrict(&self, y: &[[f64; 2]], x: &mut [[f64; 2]], room: &mut InterpolationRoom) {
        let mut far = vec![[0.0; 2]; self.far];
        x.fill([0.0; 2]);
        for triangle in &self.whole {
            let [_, coarse] = room.lattices(self.n, 1);
            whole::restrict_inner(self.n, &y[triangle.fine.clone()], coarse);
            triangle.coarse.give(coarse, Lane::ALONE, x, &mut far);
        }
        self.restrict_others(y, x, far);
    }

    /// The same where `inside` brings what `y` has inside of whole macro triangles into a lattice with zeros on its sides: of these
    /// groups side by side, the first one being group 0. **Collective**
    pub fn restrict_from<'g>(
        &self,
        groups: impl Iterator<Item = (&'g [usize], usize)>,
        mut inside: impl FnMut(usize, &mut [[f64; 2]]),
        y: &[[f64; 2]],
        x: &mut [[f64; 2]],
        room: &mut InterpolationRoom,
    ) {
        let mut far = vec![[0.0; 2]; self.far];
        x.fill([0.0; 2]);
        for (group, (members, width)) in groups.enumerate() {
            let [fine, coarse] = room.lattices(self.n, width);
            inside(group, fine);
            whole::restrict(self.n, width, fine, coarse);
            for (at, &member) in members.iter().enumerate() {
                self.whole[member].coarse.give(coarse, Lane { width, at }, x, &mut far);
            }
        }
        self.restrict_others(y, x, far);
    }

    /// Adds what comes from the nodes that are not inside of whole macro triangles; `far` goes to other ranks. **Collective**
    fn restrict_others(&self, y: &[[f64; 2]], x: &mut [[f64; 2]], mut far: Vec<[f64; 2]>) {
        let coarse = self.coarse;
        let mut add = |at: u32, value: [f64; 2]| {
            let sum = if (at as usize) < coarse { &mut x[at as usize] } else { &mut far[at as usize - coarse] };
            (0..2).for_each(|k| sum[k] += value[k]);
        };
        for &[node, a, b] in &self.others.even {
            let value = y[node as usize].map(|v| 0.5 * v);
            add(a, value);
            add(b, value);
        }
        for &(node, parent, weight) in &self.others.weighted {
            add(parent, y[node as usize].map(|v| weight * v));
        }
        for &(node, parent, block) in &self.others.turned {
            let y = y[node as usize];
            add(parent, [0, 1].map(|k| block[0][k] * y[0] + block[1][k] * y[1]));
        }
        self.halved.restrict(y, x);
        self.halo.give(&far, x);
    }
}

/// What a coarse node hands to a fine one, in their frames, if that is not all of it in the axes of the plane.
pub fn turned(fine: &Space, coarse: &Space, node: usize, parent: usize) -> Option<Block> {
    if fine.constraints.get(node).is_none() && coarse.constraints.get(parent).is_none() {
        return None;
    }
    let image = |k: usize| {
        let axis = Point::new(if k == 0 { 1.0 } else { 0.0 }, if k == 1 { 1.0 } else { 0.0 });
        let free = coarse.constraints.get(parent).map_or(axis, |constraint| constraint.free_part(axis));
        fine.free_part(node, coarse.to_global(parent, free))
    };
    let (x, y) = (image(0), image(1));
    Some([[x.x, y.x], [x.y, y.y]])
}
