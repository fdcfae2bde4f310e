//! A load step: the scene of the step before with other loads, prescribed motions or gaps.
//!
//! What a step comes to does not depend on the one before, as long as both converge: that one is where it begins. Where contact
//! boundaries follow the bodies, they stand to a tolerance that is wider than that of the solver, and where they stand within it
//! does depend on where they began. Such steps begin at rest, as the scene would by itself, and with the step before only if
//! that comes to nothing.

use crate::discretisation::{Scene, SystemError};
use crate::mesh::Origin;
use crate::procedure::ending::{Ending, Failure};
use crate::procedure::predecessor::Predecessor;
use crate::procedure::settings::{Event, Procedure};
use crate::procedure::solved::Solved;

impl Procedure<'_> {
    /// Solves a scene that differs from the one before by loads, prescribed values and gaps only. **Collective**
    ///
    /// # Errors
    /// As [`Procedure::solve`].
    pub(super) fn solve_after(&self, scene: Scene, before: &Solved) -> Result<Solved, SystemError> {
        let follows = scene.pairs.iter().any(|pair| pair.follows());
        let origins: Vec<Origin> = (0..scene.mesh.triangles.len()).map(Origin::whole).collect();
        let begin = |from_before: bool| from_before.then(|| Predecessor::new(before, &origins));
        let found = self.solve_on_mesh(scene.clone(), begin(!follows).as_ref())?;
        if !may_come_to_more(&found.ending) {
            return Ok(found);
        }
        self.observer.observe(Event::Again { from_before: follows });
        let again = self.solve_on_mesh(scene, begin(follows).as_ref())?;
        // What the scene comes to by itself is the result, unless only the step before leads to one.
        Ok(if again.ending.is_converged() || !follows { again } else { found })
    }
}

/// Whether another start may lead to a solution: not where a body is loose.
fn may_come_to_more(ending: &Ending) -> bool {
    !matches!(ending, Ending::Converged(_) | Ending::NotConverged(Failure::NotHeld(_)))
}
