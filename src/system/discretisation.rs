//! A scene cut into unknowns: spaces of all levels, contacts, couplings.

use super::{BoundaryMotion, CoarseSolution, Contact, Coupling, Scene, Space, SystemError};
use crate::contact::{Jump, Pair};
use crate::mesh::{Level, levels};
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
    /// Couples the contacts of a scene whose spaces are at hand. **Collective**
    ///
    /// # Errors
    /// [`SystemError::Case`] if a contact boundary cannot be placed or measured.
    pub fn new(scene: Scene, spaces: Vec<Space>, session: &Session) -> Result<Self, SystemError> {
        let finest = &spaces[spaces.len() - 1];
        let contacts = Contact::all(&scene, &finest.numbering, session.rank())?;
        let coupling = Coupling::new(&scene, &contacts, session)?;
        Ok(Self { scene, spaces, contacts, coupling, motion: BoundaryMotion::default() })
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

    /// Goes to another refinement of the same scene, with the given pairs, at rest or where a coarser solution says;
    /// gives that solution's displacements in the new unknowns. **Collective**
    ///
    /// # Errors
    /// [`SystemError::Case`] if a contact boundary cannot be placed or measured on this mesh.
    pub fn refine_to(
        &mut self,
        refine: usize,
        pairs: Vec<Pair>,
        coarse: Option<&CoarseSolution>,
        session: &Session,
    ) -> Result<Option<Vec<f64>>, SystemError> {
        (self.scene.refine, self.scene.pairs) = (refine, pairs);
        self.spaces = spaces(&self.scene, session.rank())?;
        let start = coarse.map(|coarse| coarse.displacement(self, session.rank()));
        let (contacts, motion) = match (coarse, &start) {
            (Some(coarse), Some(start)) => coarse.contacts(self, start, session)?,
            _ => (Contact::all(&self.scene, &self.finest().numbering, session.rank())?, BoundaryMotion::default()),
        };
        self.replace(contacts, motion, session)?;
        Ok(start)
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
    let n = level.intervals as u64;
    let inner = if n < 3 { 0 } else { (n - 1) * (n - 2) / 2 };
    let mesh = &scene.mesh;
    let nodes = mesh.vertices.len() as u64 + mesh.edges.len() as u64 * (n - 1) + mesh.triangles.len() as u64 * inner;
    if 5 * nodes > i32::MAX as u64 {
        let words = format!("mesh.refine = {}: {nodes} nodes are more than 32-bit numbers can count; refine less", scene.refine);
        return Err(SystemError::Case(words));
    }
    Ok(())
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
