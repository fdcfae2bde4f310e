//! A scene cut into unknowns: spaces of all levels, contacts, couplings.

use super::{BoundaryMotion, Contact, Coupling, Scene, Space, SystemError, rigid_motions};
use crate::contact::Jump;
use crate::mesh::{Level, MacroMesh, Numbering, levels};
use crate::petsc::Session;

/// Everything that a system is assembled from.
pub struct Discretisation {
    /// The physics.
    pub scene: Scene,
    /// Displacement spaces, coarsest first: the macro mesh with P1.
    pub spaces: Vec<Space>,
    /// The contacts, on the finest level.
    pub contacts: Vec<Contact>,
    /// Their couplings.
    pub coupling: Coupling,
    /// Displacement of the boundary nodes by which contacts on deformed bodies were placed.
    pub motion: BoundaryMotion,
}

impl Discretisation {
    /// A scene with its contacts at rest. **Collective**
    ///
    /// # Errors
    /// [`SystemError::Case`] if supports contradict each other, the mesh is too fine, or a contact boundary cannot be placed or
    /// measured.
    pub fn new(scene: Scene, session: &Session) -> Result<Self, SystemError> {
        let spaces = spaces(&scene, session.rank())?;
        let contacts = Contact::all(&scene, &spaces[spaces.len() - 1].numbering, session.rank())?;
        Self::with(scene, spaces, contacts, BoundaryMotion::default(), session)
    }

    /// Couples contacts that are placed, on bodies that have moved. **Collective**
    ///
    /// # Errors
    /// [`SystemError::Case`] if a contact boundary cannot be measured.
    pub fn with(
        scene: Scene,
        spaces: Vec<Space>,
        contacts: Vec<Contact>,
        motion: BoundaryMotion,
        session: &Session,
    ) -> Result<Self, SystemError> {
        let coupling = Coupling::new(&scene, &contacts, session)?;
        Ok(Self { scene, spaces, contacts, coupling, motion })
    }

    /// Puts contacts in place that were placed again on moved bodies, and couples them. **Collective**
    ///
    /// # Errors
    /// [`SystemError::Case`] if a contact boundary cannot be measured.
    pub fn replace(&mut self, contacts: Vec<Contact>, motion: BoundaryMotion, session: &Session) -> Result<(), SystemError> {
        self.coupling = Coupling::new(&self.scene, &contacts, session)?;
        (self.contacts, self.motion) = (contacts, motion);
        Ok(())
    }

    /// Puts the nodes of rigid sets where a solution has moved them, given by this rank's displacements in the nodes' frames: what
    /// comes after the solve takes their displacement for a prescribed one. **Collective**
    pub fn settle(&mut self, displacement: &[f64], session: &Session) {
        let motions = rigid_motions(self, displacement, session);
        let finest = self.spaces.len() - 1;
        let Space { constraints, numbering, .. } = &mut self.spaces[finest];
        for (set, motion) in self.scene.rigid.iter().zip(&motions) {
            constraints.move_rigidly(&self.scene.mesh, numbering, set, motion);
        }
    }

    /// Whether some contact boundary depends on the solution.
    pub fn follows(&self) -> bool {
        self.contacts.iter().any(|contact| contact.pair.follows())
    }

    /// Space of the finest level: the one that is solved in.
    pub fn finest(&self) -> &Space {
        &self.spaces[self.spaces.len() - 1]
    }

    /// The contact of a multiplier.
    pub fn contact_of(&self, multiplier: usize) -> &Contact {
        let at = self.contacts.partition_point(|contact| contact.first <= multiplier);
        &self.contacts[at - 1]
    }

    /// The jump terms of all contacts.
    pub fn jumps(&self) -> impl Iterator<Item = &Jump> {
        self.contacts.iter().flat_map(|contact| &contact.jumps)
    }

    /// Number of displacement unknowns of all ranks.
    pub fn unknown_count(&self) -> usize {
        2 * self.finest().numbering.node_count()
    }

    /// Number of multipliers of all contacts.
    pub fn multiplier_count(&self) -> usize {
        self.coupling.gap.len()
    }
}

/// PETSc counts with 32 bits: the five numbers of a node's stress must still be counted.
fn check_size(scene: &Scene, level: Level) -> Result<(), SystemError> {
    let nodes = node_count(&scene.mesh, level);
    if 5 * nodes > i32::MAX as u64 {
        let words = format!("mesh.refine = {}: {nodes} nodes are more than 32-bit numbers can count; refine less", scene.refine);
        return Err(SystemError::Case(words));
    }
    Ok(())
}

/// Nodes of a level, whoever owns them.
pub fn node_count(mesh: &MacroMesh, level: Level) -> u64 {
    let n = level.intervals as u64;
    let inner = if n < 3 { 0 } else { (n - 1) * (n - 2) / 2 };
    mesh.vertices.len() as u64 + mesh.edges.len() as u64 * (n - 1) + mesh.triangles.len() as u64 * inner
}

/// The nodes of the level that is solved in.
///
/// # Errors
/// [`SystemError::Case`] if the mesh is too fine.
pub fn finest_numbering(scene: &Scene) -> Result<Numbering, SystemError> {
    let levels = levels(scene.order, scene.refine);
    let finest = levels[levels.len() - 1];
    check_size(scene, finest)?;
    Ok(Numbering::new(finest, &scene.partition))
}

/// Spaces of all levels that multigrid uses, coarsest first.
///
/// # Errors
/// [`SystemError::Case`] if supports contradict each other, or the mesh is too fine.
pub fn spaces(scene: &Scene, rank: usize) -> Result<Vec<Space>, SystemError> {
    let levels = levels(scene.order, scene.refine);
    check_size(scene, levels[levels.len() - 1])?;
    levels.into_iter().map(|level| Space::new(scene, level, rank)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::MultiplierSpace;
    use crate::geometry::Point;
    use crate::system::samples::{blocks, pair};

    /// The two blocks are grids of one and of two cells, each of n by n.
    #[test]
    fn a_mesh_that_32_bits_cannot_count_is_refused_with_the_number_of_its_nodes() {
        let mut scene = blocks(pair(MultiplierSpace::P0, 4), |_| Point::zeros(), Vec::new());
        let level = |intervals| Level { intervals, order: scene.order };
        assert!(check_size(&scene, level(8192)).is_ok());
        let (refused, n) = (level(16384), 16384u64);
        scene.refine = 14;
        let words = check_size(&scene, refused).expect_err("too fine").to_string();
        assert!(
            words.contains(&format!("mesh.refine = 14: {} nodes are more", (n + 1) * (n + 1) + (2 * n + 1) * (n + 1))),
            "{words}"
        );
    }
}
