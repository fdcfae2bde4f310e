//! Displacements at the nodes that a rank can see.

use crate::discretisation::field::Field;
use crate::discretisation::levels::Discretisation;
use crate::geometry::Point;

impl Field<2> {
    /// Displacements in global axes, from this rank's unknowns in the nodes' frames. **Collective**
    pub fn displacement(problem: &Discretisation, unknowns: &[f64]) -> Self {
        let mut field = Self::zeros(&problem.scene, problem.finest(), &problem.session);
        let space = problem.finest();
        for (at, (own, u)) in field.own.iter_mut().zip(unknowns.chunks_exact(2)).enumerate() {
            let u = space.to_global(space.own.start + at, Point::new(u[0], u[1]));
            *own = [u.x, u.y];
        }
        field.fetch(&problem.session);
        field
    }

    /// Displacement of a node.
    #[inline]
    pub fn point(&self, node: usize) -> Point {
        let [x, y] = self.at(node);
        Point::new(x, y)
    }

    /// Adds a vector to what a node has.
    #[inline]
    pub fn add_at(&mut self, node: usize, vector: Point) {
        let sum = self.at_mut(node);
        sum[0] += vector.x;
        sum[1] += vector.y;
    }
}
