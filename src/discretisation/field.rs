//! Values at the nodes that a rank can see: those of the macro triangles it owns.

use crate::discretisation::scene::Scene;
use crate::discretisation::space::Space;
use crate::mesh::{each_once, lattice};
use crate::petsc::{Halo, Session};
use std::collections::HashMap;

/// `K` numbers at every node of the macro triangles that this rank owns.
#[derive(Clone)]
pub struct Field<const K: usize> {
    first: usize,
    pub(super) own: Vec<[f64; K]>,
    others: HashMap<usize, [f64; K]>,
}

impl<const K: usize> Field<K> {
    /// Zeros.
    pub fn zeros(scene: &Scene, space: &Space, session: &Session) -> Self {
        let others = seen_nodes(scene, space, session.rank()).into_iter().map(|node| (node, [0.0; K])).collect();
        let own = space.own.clone();
        Self { first: own.start, own: vec![[0.0; K]; own.len()], others }
    }

    /// Values at a node.
    ///
    /// # Panics
    /// If this rank owns no macro triangle with that node.
    #[inline]
    pub fn at(&self, node: usize) -> [f64; K] {
        match self.own.get(node.wrapping_sub(self.first)) {
            Some(values) => *values,
            None => self.others[&node],
        }
    }

    /// Values at a node, to change.
    #[inline]
    pub fn at_mut(&mut self, node: usize) -> &mut [f64; K] {
        match self.own.get_mut(node.wrapping_sub(self.first)) {
            Some(values) => values,
            None => self.others.get_mut(&node).expect("a node of a macro triangle of this rank"),
        }
    }

    /// Values at the nodes that this rank owns.
    pub fn own(&self) -> &[[f64; K]] {
        &self.own
    }

    /// Adds a multiple of another field of the same nodes.
    pub fn add(&mut self, factor: f64, other: &Self) {
        let plus = |values: &mut [f64; K], others: [f64; K]| (0..K).for_each(|k| values[k] += factor * others[k]);
        self.own.iter_mut().zip(&other.own).for_each(|(values, others)| plus(values, *others));
        self.others.iter_mut().for_each(|(node, values)| plus(values, other.others[node]));
    }

    /// Other values, each of those at the same node.
    pub fn map<const M: usize>(&self, f: impl Fn([f64; K]) -> [f64; M]) -> Field<M> {
        let others = self.others.iter().map(|(&node, &values)| (node, f(values))).collect();
        Field { first: self.first, own: self.own.iter().map(|&values| f(values)).collect(), others }
    }

    /// Adds up what all ranks have gathered at each node, and shares the sums. **Collective**
    pub fn sum(mut self, session: &Session) -> Self {
        let (far, halo) = self.halo(session);
        let mut values: Vec<[f64; K]> = far.iter().map(|node| self.others[node]).collect();
        halo.give(&values, &mut self.own);
        halo.fetch(&self.own, &mut values, || ());
        self.others.extend(far.into_iter().zip(values));
        self
    }

    /// Takes the values of other ranks' nodes from their owners. **Collective**
    pub(super) fn fetch(&mut self, session: &Session) {
        let (far, halo) = self.halo(session);
        let mut values = vec![[0.0; K]; far.len()];
        halo.fetch(&self.own, &mut values, || ());
        self.others.extend(far.into_iter().zip(values));
    }

    /// The nodes of other ranks, and the way to their owners. **Collective**
    fn halo(&self, session: &Session) -> (Vec<usize>, Halo) {
        let far = each_once(self.others.keys().copied());
        let halo = Halo::new(session, &(self.first..self.first + self.own.len()), &far);
        (far, halo)
    }
}

/// Nodes of this rank's macro triangles that other ranks own.
fn seen_nodes(scene: &Scene, space: &Space, rank: usize) -> Vec<usize> {
    let n = space.numbering.level.intervals;
    let seen = scene.partition.with_nodes_of_others(rank).iter().flat_map(|&triangle| {
        let numbers = space.numbering.triangle(&scene.mesh, triangle as usize);
        lattice::sides(n).map(move |(i, j)| numbers.node(i, j))
    });
    each_once(seen.filter(|node| !space.own.contains(node)))
}
