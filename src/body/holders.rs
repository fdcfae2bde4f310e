//! Which supports hold each node, and how they share the force there.

use super::Support;
use super::constraint::{HeldBy, Hold, SAME, all_holds};
use crate::geometry::Point;
use crate::mesh::{MacroMesh, Numbering};
use nalgebra::{Matrix2, SMatrix};
use std::collections::HashMap;

/// Which supports hold each node of a level, and in which directions.
#[derive(Clone, Debug, Default)]
pub struct Holders(HashMap<usize, Vec<(usize, Point)>>);

impl Holders {
    /// Supports of all nodes of a level.
    ///
    /// # Errors
    /// Words, if a formula of a support has no finite value at a node.
    pub fn new(mesh: &MacroMesh, numbering: &Numbering, supports: &[Support]) -> Result<Self, String> {
        let number = |by: HeldBy| supports.iter().position(|support| by == HeldBy::Support(&support.name)).unwrap_or_default();
        let of_node = |holds: &[Hold]| holds.iter().map(|hold| (number(hold.by), hold.direction)).collect();
        let all = all_holds(mesh, numbering, supports)?;
        Ok(Self(all.into_iter().map(|(node, (_, holds))| (node, of_node(&holds))).collect()))
    }

    /// What each support has of the reaction at a node: its number and its force. Where several hold one node in one direction
    /// they share the force there, by the least sum of squares.
    pub fn shares(&self, node: usize, reaction: Point) -> impl Iterator<Item = (usize, Point)> {
        let holds = self.0.get(&node).map(Vec::as_slice).unwrap_or(&[]);
        let gram: Matrix2<f64> = holds.iter().map(|(_, direction)| direction * direction.transpose()).sum();
        let inverse: SMatrix<f64, 2, 2> = gram.pseudo_inverse(SAME * SAME).unwrap_or_default();
        let along = inverse * reaction;
        holds.iter().map(move |&(support, direction)| (support, direction * direction.dot(&along)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn supports_share_the_reaction_of_a_node() {
        let (x, y) = (Point::new(1.0, 0.0), Point::new(0.0, 1.0));
        let shares = |holds: Vec<(usize, Point)>, reaction| {
            let mut sums = [Point::zeros(); 3];
            Holders(HashMap::from([(7, holds)])).shares(7, reaction).for_each(|(support, force)| sums[support] += force);
            sums
        };
        let reaction = Point::new(3.0, -2.0);
        assert_eq!(shares(vec![(0, x), (2, y)], reaction), [3.0 * x, Point::zeros(), -2.0 * y]);
        assert_eq!(shares(vec![(0, x), (1, x)], 3.0 * x), [1.5 * x, 1.5 * x, Point::zeros()]);
        let inclined = shares(vec![(0, x), (1, Point::new(0.6, 0.8)), (2, y)], reaction);
        assert!((inclined.iter().sum::<Point>() - reaction).norm() < 1e-14);
    }
}
