//! Interpolation by nodes: halved rows inside macro triangles, and a list of the other nodes.

use super::halved_rows::{HalvedRow, HalvedRows};
use super::parents::{Here, NodeParents};
use crate::element::Block;
use crate::geometry::Point;
use crate::petsc::{Datum, Halo, Result, Session, Transfer, Vector};
use crate::system::space::Real;
use crate::system::{Scene, Space};
use std::rc::Rc;

/// Linear interpolation from a coarse level to the next finer one. A node takes over the value of its coarse twin, or the
/// weighted mean of its two parents, turned from their frames into its own. Rows of prescribed fine components and columns
/// of prescribed coarse ones are zero.
pub struct NodeInterpolation {
    halved: HalvedRows,
    /// Nodes in the middle of two parents, or on one of them twice.
    even: Vec<[u32; 3]>,
    /// Other couplings: of graded edges and of supports.
    weighted: Vec<(u32, u32, Block)>,
    /// Coarse nodes here, and how many are elsewhere: in lists they come behind those here.
    coarse: usize,
    halo: Option<Halo>,
    far: usize,
}

impl NodeInterpolation {
    /// To the fine nodes that are here; coarse ones of other ranks come through a halo if not all are here. **Collective**
    pub fn new(scene: &Scene, fine: &Space, coarse: &Space, here: &Here, session: &Session) -> Self {
        let halved = HalvedRows::new(scene, fine, coarse, here.triangles, [&here.fine, &here.coarse]);
        let left_out = |j: usize| HalvedRow::places(fine.numbering.level.intervals, j);
        let rows = NodeParents::new(scene, fine, coarse, here, left_out);
        let mut far: Vec<usize> = rows.iter().flat_map(|(_, pair)| pair).filter(|node| !here.coarse.contains(node)).collect();
        far.sort_unstable();
        far.dedup();
        let place = |node: usize| match here.coarse.contains(&node) {
            true => (node - here.coarse.start) as u32,
            false => (here.coarse.len() + far.binary_search(&node).expect("a known node")) as u32,
        };
        let (mut even, mut weighted) = (Vec::new(), Vec::new());
        for (node, pair) in rows.iter() {
            let at = (node - here.fine.start) as u32;
            let weights = rows.weights(node);
            let plain = fine.constraints.get(node).is_none() && pair.iter().all(|&p| coarse.constraints.get(p).is_none());
            if plain && weights == [0.5; 2] {
                even.push([at, place(pair[0]), place(pair[1])]);
                continue;
            }
            for (parent, weight) in pair.into_iter().zip(weights) {
                weighted.push((at, place(parent), turned(fine, coarse, node, parent, weight)));
            }
        }
        // All ranks take the same way here, whatever they own: a halo is made by all of them together.
        let is_shared = session.size() > 1 && !here.is_gathered;
        let halo = is_shared.then(|| Halo::new(session, &here.coarse, &far));
        Self { halved, even, weighted, coarse: here.coarse.len(), halo, far: far.len() }
    }

    /// `y += P x`. **Collective**
    pub fn prolong<T: Real + Datum>(&self, x: &[[T; 2]], y: &mut [[T; 2]]) {
        let mut far = vec![[T::default(); 2]; self.far];
        match &self.halo {
            Some(halo) => halo.fetch(x, &mut far, || self.halved.prolong(x, y)),
            None => self.halved.prolong(x, y),
        }
        let (half, coarse) = (T::of(0.5), self.coarse);
        let value = |at: u32| if (at as usize) < coarse { x[at as usize] } else { far[at as usize - coarse] };
        for &[node, a, b] in &self.even {
            let (a, b) = (value(a), value(b));
            (0..2).for_each(|k| y[node as usize][k] += half * (a[k] + b[k]));
        }
        for &(node, parent, block) in &self.weighted {
            let x = value(parent);
            (0..2).for_each(|k| y[node as usize][k] += T::of(block[k][0]) * x[0] + T::of(block[k][1]) * x[1]);
        }
    }

    /// `x = Pᵀ y`. **Collective**
    pub fn restrict<T: Real + Datum>(&self, y: &[[T; 2]], x: &mut [[T; 2]]) {
        let mut far = vec![[T::default(); 2]; self.far];
        x.fill([T::default(); 2]);
        let (half, coarse) = (T::of(0.5), self.coarse);
        let mut add = |at: u32, value: [T; 2]| {
            let sum = if (at as usize) < coarse { &mut x[at as usize] } else { &mut far[at as usize - coarse] };
            (0..2).for_each(|k| sum[k] += value[k]);
        };
        for &[node, a, b] in &self.even {
            let value = y[node as usize].map(|v| half * v);
            add(a, value);
            add(b, value);
        }
        for &(node, parent, block) in &self.weighted {
            let y = y[node as usize];
            add(parent, [0, 1].map(|k| T::of(block[0][k]) * y[0] + T::of(block[1][k]) * y[1]));
        }
        self.halved.restrict(y, x);
        if let Some(halo) = &self.halo {
            halo.give(&far, x);
        }
    }

    /// Couplings that are not in halved rows.
    pub fn stored(&self) -> usize {
        2 * self.even.len() + self.weighted.len()
    }
}

/// What a coarse node hands to a fine one, in their frames.
pub fn turned(fine: &Space, coarse: &Space, node: usize, parent: usize, weight: f64) -> Block {
    let image = |k: usize| {
        let axis = Point::new(if k == 0 { 1.0 } else { 0.0 }, if k == 1 { 1.0 } else { 0.0 });
        let free = coarse.constraints.get(parent).map_or(axis, |constraint| constraint.free_part(axis));
        fine.free_part(node, coarse.to_global(parent, free)) * weight
    };
    let (x, y) = (image(0), image(1));
    [[x.x, y.x], [x.y, y.y]]
}

/// An interpolation as PETSc's multigrid uses it.
pub struct InterpolationShell(pub Rc<NodeInterpolation>);

impl Transfer for InterpolationShell {
    fn multiply(&self, x: &Vector, y: &mut Vector) -> Result<()> {
        y.set(0.0)?;
        self.multiply_add(x, y)
    }

    fn multiply_add(&self, x: &Vector, y: &mut Vector) -> Result<()> {
        let (x, mut y) = (x.values(), y.values_mut());
        self.0.prolong::<f64>(x.as_chunks().0, y.as_chunks_mut().0);
        Ok(())
    }

    fn multiply_transpose(&self, x: &Vector, y: &mut Vector) -> Result<()> {
        let (x, mut y) = (x.values(), y.values_mut());
        self.0.restrict::<f64>(x.as_chunks().0, y.as_chunks_mut().0);
        Ok(())
    }

    fn work(&self) -> f64 {
        4.0 * self.0.halved.count() as f64 + 4.0 * self.0.stored() as f64
    }
}
