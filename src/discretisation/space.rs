//! Displacement space of one level: numbers, constraints, and vectors in the nodes' frames.

use crate::body::Constraints;
use crate::discretisation::error::SystemError;
use crate::discretisation::scene::Scene;
use crate::geometry::Point;
use crate::mesh::{Level, Numbering, Partition};
use std::ops::Range;
use std::rc::Rc;

/// Two components at a node.
pub type Components = [f64; 2];

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
        let constraints = Constraints::new(&scene.mesh, &numbering, &scene.supports, &scene.means, &scene.rigid);
        let constraints = constraints.map_err(|e| SystemError::Case(e.0))?;
        let own = numbering.range(rank);
        Ok(Self { numbering, constraints, own })
    }

    /// Scalar unknowns of this rank.
    pub fn local_unknowns(&self) -> usize {
        2 * self.own.len()
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
