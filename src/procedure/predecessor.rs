//! What the solution on one adapted mesh says of the next one, which has other macro triangles.

use crate::discretisation::{Discretisation, Field, Scene, Solution, Space, SystemError};
use crate::geometry::Point;
use crate::mesh::{Origin, lattice};
use crate::procedure::coarse_solution::ContactSolution;
use crate::procedure::estimates::{Estimate, energy_apart, share_left};
use crate::procedure::solved::Solved;
use crate::recovery::shapes_at;
use crate::system::Start;

/// A solution on the mesh before, whose macro triangles those of the next mesh are parts of.
pub(crate) struct Predecessor<'s> {
    problem: &'s Discretisation,
    displacement: Field<2>,
    /// What it says of the contacts.
    pub(super) contact: ContactSolution,
    /// Its last difference from a coarser solution, and what is left of it.
    estimate: &'s Estimate,
    /// Where each macro triangle of the next mesh lies.
    origins: &'s [Origin],
}

impl<'s> Predecessor<'s> {
    /// Takes a solution over, for a mesh whose macro triangles have these origins. **Collective**
    pub fn new(solved: &'s Solved, origins: &'s [Origin]) -> Self {
        let Solved { problem, solution, preconditioning, is_hard, estimate, .. } = solved;
        let displacement = Field::displacement(problem, &solution.displacement);
        let contact = ContactSolution::new(problem.contacts.clone(), solution, false, (*preconditioning, *is_hard));
        Self { problem, displacement, contact, estimate, origins }
    }

    /// The next mesh with the contacts where this solution says, and where to start on it. **Collective**
    ///
    /// # Errors
    /// [`SystemError::Case`] if a contact boundary cannot be placed or measured on that mesh.
    pub fn start_on(&self, scene: Scene) -> Result<(Discretisation, Start), SystemError> {
        self.contact.start_on(scene, |scene, space| self.displacement(scene, space), &self.problem.session)
    }

    /// Squares of the shares that are left of the difference of a solution on the next mesh from a coarser one there, on each macro
    /// triangle of this rank; `now` are the squares of that difference. Each share is what it was on the triangle before that this one is
    /// a part of, if enough has gone there; else as it has been, if that is known. Empty if this mesh has no difference. **Collective**
    pub fn shares_left(
        &self,
        problem: &Discretisation,
        solution: &Solution,
        now: &[f64],
    ) -> Result<Vec<Option<f64>>, SystemError> {
        if self.estimate.difference.is_none() {
            return Ok(Vec::new());
        }
        let displacement = self.displacement(&problem.scene, problem.finest());
        let apart = energy_apart(problem, solution, displacement)?;
        let Estimate { of_triangles, shares_left, .. } = self.estimate;
        // Of each triangle of this mesh: its difference, that of its parts, how far these are from it, and its share.
        let mut sums = vec![[0.0; 4]; self.problem.scene.mesh.triangles.len()];
        for (k, &triangle) in self.problem.own_triangles().iter().enumerate() {
            sums[triangle as usize][0] = of_triangles[k];
            sums[triangle as usize][3] = shares_left.get(k).copied().flatten().unwrap_or_default();
        }
        let own = problem.own_triangles();
        for ((&triangle, now), apart) in own.iter().zip(now).zip(&apart) {
            let sums = &mut sums[self.origins[triangle as usize].triangle as usize];
            (sums[1], sums[2]) = (sums[1] + now, sums[2] + apart);
        }
        problem.session.sum(sums.as_flattened_mut());
        let share = |&triangle: &u32| {
            let [before, now, apart, share] = sums[self.origins[triangle as usize].triangle as usize];
            share_left(apart, before, now).or(Some(share).filter(|share| *share > 0.0))
        };
        Ok(own.iter().map(share).collect())
    }

    /// The same displacement on the next mesh: this rank's unknowns in the nodes' frames. Every rank knows it on the macro
    /// triangles that it had, and tells those that have their parts. **Collective**
    fn displacement(&self, scene: &Scene, space: &Space) -> Vec<f64> {
        let session = &self.problem.session;
        let n = space.numbering.level.intervals;
        // Displacement, and how often it was told: a node may lie in several triangles.
        let (mut sums, mut others) = (vec![[0.0; 3]; space.own.len()], Vec::new());
        let known = |origin: &Origin| self.problem.scene.partition.owner(origin.triangle) == session.rank();
        for (triangle, origin) in self.origins.iter().enumerate().filter(|(_, origin)| known(origin)) {
            let numbers = space.numbering.triangle(&scene.mesh, triangle);
            for (i, j) in lattice::nodes(n) {
                let [x, y] = [i, j].map(|k| k as f64 / n as f64);
                let [_, x, y] = origin.point([1.0 - x - y, x, y]);
                let shapes = shapes_at(self.problem, origin.triangle as usize, Point::new(x, y));
                let u: Point =
                    shapes.iter().fold(Point::zeros(), |sum, (node, value)| sum + *value * self.displacement.point(*node));
                let (node, told) = (numbers.node(i, j), [u.x, u.y, 1.0]);
                match sums.get_mut(node.wrapping_sub(space.own.start)) {
                    Some(sum) => (0..3).for_each(|k| sum[k] += told[k]),
                    None => others.push((node, told)),
                }
            }
        }
        session.add_to_owners(&space.own, &mut sums, others);
        let in_frame = |(node, [x, y, told]): (usize, [f64; 3])| <[f64; 2]>::from(space.to_frame(node, Point::new(x, y) / told));
        space.own.clone().zip(sums).flat_map(in_frame).collect()
    }
}
