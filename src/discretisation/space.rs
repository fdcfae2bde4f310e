//! Displacement space of one level: numbers, constraints, and vectors in the nodes' frames.

use crate::body::Constraints;
use crate::discretisation::error::SystemError;
use crate::discretisation::scene::Scene;
use crate::geometry::Point;
use crate::mesh::{Level, Numbering, Partition, lattice};
use std::ops::Range;
use std::rc::Rc;

/// Numbers and constraints of one level. Component `k` of node `j` is unknown `2 j + k`, in the node's frame.
pub struct Space {
    /// Numbers of the nodes.
    pub numbering: Numbering,
    /// Supports at the nodes.
    pub constraints: Constraints,
    /// Nodes that this rank owns.
    pub own: Range<usize>,
}

impl Space {
    /// The space of a level, spread over the ranks as a partition says.
    ///
    /// # Errors
    /// [`SystemError::Case`] if supports contradict each other.
    pub fn new(scene: &Scene, level: Level, partition: &Rc<Partition>, rank: usize) -> Result<Self, SystemError> {
        let numbering = Numbering::new(level, partition);
        let constraints = Constraints::new(&scene.mesh, &numbering, &scene.supports, &scene.means, &scene.rigid)?;
        let own = numbering.range(rank);
        Ok(Self { numbering, constraints, own })
    }

    /// Scalar unknowns of this rank.
    pub fn local_unknowns(&self) -> usize {
        2 * self.own.len()
    }

    /// This rank's unknowns, in the nodes' frames, of a displacement that is told for each of its macro triangles, by the numbers and
    /// the lattice places of their nodes.
    pub fn unknowns_of<F: Fn(usize, (usize, usize)) -> Point>(
        &self,
        scene: &Scene,
        rank: usize,
        of_triangle: impl Fn(usize) -> F,
    ) -> Vec<f64> {
        let mut values = vec![0.0; self.local_unknowns()];
        for triangle in scene.partition.triangles_of(rank).iter().map(|&triangle| triangle as usize) {
            let (numbers, displacement) = (self.numbering.triangle(&scene.mesh, triangle), of_triangle(triangle));
            for (i, j) in lattice::nodes(self.numbering.level.intervals) {
                let node = numbers.node(i, j);
                if self.own.contains(&node) {
                    let (at, u) = (2 * (node - self.own.start), self.to_frame(node, displacement(node, (i, j))));
                    (values[at], values[at + 1]) = (u.x, u.y);
                }
            }
        }
        values
    }

    /// Unknowns of this rank that are prescribed, counted from its first, with their values.
    pub fn fixed(&self) -> impl Iterator<Item = (usize, f64)> {
        let own = self.constraints.iter().filter(|(node, _)| self.own.contains(node));
        own.flat_map(move |(node, of)| {
            (0..2).filter(|&k| of.fixed[k]).map(move |k| (2 * (node - self.own.start) + k, of.value[k]))
        })
    }

    /// A force on a node, in its frame, with the part on prescribed components left out.
    #[inline]
    pub fn free_part(&self, node: usize, force: Point) -> Point {
        match self.constraints.get(node) {
            Some(constraint) => constraint.free_part(constraint.to_frame(force)),
            None => force,
        }
    }

    /// A vector in global axes, in the node's frame.
    #[inline]
    pub fn to_frame(&self, node: usize, v: Point) -> Point {
        self.constraints.get(node).map_or(v, |constraint| constraint.to_frame(v))
    }

    /// A vector in the node's frame, in global axes.
    #[inline]
    pub fn to_global(&self, node: usize, v: Point) -> Point {
        self.constraints.get(node).map_or(v, |constraint| constraint.to_global(v))
    }

    /// Prescribed displacement of a node in global axes; zero where nothing is prescribed.
    #[inline]
    pub fn prescribed(&self, node: usize) -> Point {
        self.constraints.get(node).map_or(Point::zeros(), |constraint| constraint.to_global(constraint.prescribed()))
    }
}
