//! A scene cut into unknowns: spaces of all levels, contacts, couplings.

use crate::contact::Jump;
use crate::discretisation::contacts::{BoundaryMotion, Contact, Coupling};
use crate::discretisation::error::SystemError;
use crate::discretisation::field::Field;
use crate::discretisation::held_bodies::HeldBodies;
use crate::discretisation::scene::Scene;
use crate::discretisation::space::Space;
use crate::mesh::{Level, MacroMesh, Numbering, lattice, levels};
use crate::petsc::{Index, Session};
use std::cell::OnceCell;
use std::rc::Rc;

/// Unknowns up to which a level is brought together on one rank, and factorised if it is the coarsest: larger ones get auxiliary
/// levels.
pub const SMALL: usize = 3000;

/// Unknowns of a larger level for each of the ranks that it is spread over, at least: with fewer, its messages would take longer
/// than its work.
const LEAST_ON_A_RANK: usize = 1000;

/// Everything that a system is assembled from.
pub struct Discretisation {
    /// All ranks.
    pub session: Session,
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
    /// What holds each body whose mean motion is held: force, and moment about its middle (per thickness).
    pub mean_forces: Vec<[f64; 3]>,
    /// What bodies and loads alone give, once it has been asked for.
    pub without_contact: WithoutContact,
}

/// What does not depend on contact, and is found once on each mesh.
#[derive(Default)]
pub struct WithoutContact {
    /// Nodal forces of loads and body forces, where there are any of these.
    pub(super) applied: OnceCell<Field<2>>,
    held: OnceCell<Rc<HeldBodies>>,
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
        let coupling = Coupling::new(&scene, &spaces, &contacts, session)?;
        let mean_forces = vec![[0.0; 3]; scene.means.len()];
        Ok(Self {
            session: session.clone(),
            scene,
            spaces,
            contacts,
            coupling,
            motion,
            mean_forces,
            without_contact: WithoutContact::default(),
        })
    }

    /// Puts contacts in place that were placed again on moved bodies, and couples them. **Collective**
    ///
    /// # Errors
    /// [`SystemError::Case`] if a contact boundary cannot be measured.
    pub fn replace(&mut self, contacts: Vec<Contact>, motion: BoundaryMotion) -> Result<(), SystemError> {
        self.coupling = Coupling::new(&self.scene, &self.spaces, &contacts, &self.session)?;
        (self.contacts, self.motion) = (contacts, motion);
        Ok(())
    }

    /// Bodies whose mean motion is held. **Collective**
    ///
    /// # Errors
    /// As of [`HeldBodies::new`].
    pub fn held_bodies(&self) -> Result<Rc<HeldBodies>, SystemError> {
        if let Some(found) = self.without_contact.held.get() {
            return Ok(found.clone());
        }
        let found = Rc::new(HeldBodies::new(&self.scene, self.finest(), &self.session)?);
        Ok(self.without_contact.held.get_or_init(|| found).clone())
    }

    /// Whether some contact boundary depends on the solution.
    pub fn follows(&self) -> bool {
        self.contacts.iter().any(|contact| contact.pair.follows())
    }

    /// Space of the finest level: the one that is solved in.
    pub fn finest(&self) -> &Space {
        &self.spaces[self.spaces.len() - 1]
    }

    /// Macro triangles that this rank owns.
    pub fn own_triangles(&self) -> &[u32] {
        self.scene.partition.triangles_of(self.session.rank())
    }

    /// The contact of a multiplier.
    pub fn contact_of(&self, multiplier: usize) -> &Contact {
        Contact::of_multiplier(&self.contacts, multiplier)
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

/// Numbers of 32 bits that a rank has for each of its nodes in its longest lists: it counts 11.5 couplings in stored rows of P2
/// in the mean, without a sign, and 6 corners of triangles in files for ParaView, with one.
const PLACES: usize = 7;

/// PETSc's indices of so many bits must count the five numbers of a node's stress on all ranks, and 32 bits what one rank has.
fn check_size(scene: &Scene, numbering: &Numbering, bits: u32) -> Result<(), SystemError> {
    let nodes = numbering.node_count();
    let refused = |words: String| Err(SystemError::Case(format!("mesh.refine = {}: {words}", scene.refine)));
    if nodes as u64 > (u64::MAX >> (65 - bits)) / 5 {
        return refused(format!(
            "{nodes} nodes are more than PETSc can count with {bits}-bit indices; refine less, or build mezha with a PETSc of 64-bit indices (docs/install.md says how)"
        ));
    }
    let most = (0..scene.partition.size()).map(|rank| numbering.range(rank).len()).max().unwrap_or(0);
    if most > i32::MAX as usize / PLACES {
        return refused(format!(
            "{most} nodes on one rank are more than it can count with 32-bit numbers; refine less, or take more ranks"
        ));
    }
    Ok(())
}

/// Nodes of a level, whoever owns them.
pub fn node_count(mesh: &MacroMesh, level: Level) -> u64 {
    let (on_edge, inside) = (level.intervals as u64 - 1, lattice::inner_count(level.intervals) as u64);
    mesh.vertices.len() as u64 + mesh.edges.len() as u64 * on_edge + mesh.triangles.len() as u64 * inside
}

/// The nodes of the level that is solved in.
///
/// # Errors
/// [`SystemError::Case`] if the mesh is too fine.
pub fn finest_numbering(scene: &Scene) -> Result<Numbering, SystemError> {
    let levels = levels(scene.order, scene.refine);
    let numbering = Numbering::new(levels[levels.len() - 1], &scene.partition);
    check_size(scene, &numbering, Index::BITS)?;
    Ok(numbering)
}

impl Scene {
    /// The nodes of the mesh as it was read.
    ///
    /// # Errors
    /// [`SystemError::Case`] if there are too many.
    pub fn macro_numbering(&self) -> Result<Numbering, SystemError> {
        finest_numbering(&self.coarser(self.refine))
    }
}

/// Ranks in each group, of which one takes all nodes of a level with so many unknowns: a power of two, and all ranks are one group
/// if the level is small.
pub fn ranks_in_group(unknowns: usize, ranks: usize) -> usize {
    let all = ranks.next_power_of_two();
    if unknowns <= SMALL { all } else { (LEAST_ON_A_RANK * ranks).div_ceil(unknowns).next_power_of_two().min(all) }
}

/// Spaces of all levels that multigrid uses, coarsest first. Levels with few unknowns are brought together on fewer ranks.
///
/// # Errors
/// [`SystemError::Case`] if supports contradict each other, or the mesh is too fine.
pub fn spaces(scene: &Scene, rank: usize) -> Result<Vec<Space>, SystemError> {
    finest_numbering(scene)?;
    let levels = levels(scene.order, scene.refine);
    let mut partitions = vec![(1, scene.partition.clone())];
    let mut spaces = Vec::with_capacity(levels.len());
    for &level in levels.iter().rev() {
        let unknowns = 2 * node_count(&scene.mesh, level) as usize;
        let group = if spaces.is_empty() { 1 } else { ranks_in_group(unknowns, scene.partition.size()) };
        if group > partitions[partitions.len() - 1].0 {
            partitions.push((group, Rc::new(scene.partition.brought_together(&scene.mesh, group))));
        }
        spaces.push(Space::new(scene, level, &partitions[partitions.len() - 1].1, rank)?);
    }
    spaces.reverse();
    Ok(spaces)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::MultiplierSpace;
    use crate::discretisation::samples::{blocks, pair};
    use crate::geometry::Point;
    use crate::mesh::Partition;

    /// The two blocks are grids of one and of two cells, each of n by n.
    #[test]
    fn a_mesh_that_cannot_be_counted_is_refused_with_the_number_of_its_nodes() {
        let mut scene = blocks(pair(MultiplierSpace::P0, 4), |_| Point::zeros(), Vec::new());
        let level = |intervals| Level { intervals, order: scene.order };
        let (fine, too_fine, n) = (level(8192), level(16384), 16384u64);
        let words = |nodes: u64, rest: &str| format!("mesh.refine = 14: {nodes} nodes {rest}");
        let all = (n + 1) * (n + 1) + (2 * n + 1) * (n + 1);
        let count = scene.mesh.triangles.len();
        scene.refine = 14;
        // On one rank 32 bits are not enough, however wide PETSc's indices are; on six PETSc's alone decide.
        for (ranks, bits, refusal) in [
            (1, 32, Some(words(all, "are more than PETSc can count with 32-bit indices; refine less, or build"))),
            (1, 64, Some(words(all, "on one rank are more than it can count with 32-bit numbers; refine less, or take more"))),
            (count, 32, Some(words(all, "are more than PETSc can count with 32-bit indices"))),
            (count, 64, None),
        ] {
            let owners: Vec<i32> = (0..count).map(|triangle| (triangle % ranks) as i32).collect();
            scene.partition = Rc::new(Partition::new(&scene.mesh, &owners, ranks));
            let check = |level| check_size(&scene, &Numbering::new(level, &scene.partition), bits);
            assert!(check(fine).is_ok());
            match (check(too_fine), refusal) {
                (Ok(()), None) => {}
                (Err(error), Some(words)) => assert!(error.to_string().contains(&words), "{error}"),
                other => panic!("{ranks} ranks, {bits} bits: {other:?}"),
            }
        }
    }

    #[test]
    fn small_levels_are_on_one_rank_and_large_ones_on_all() {
        for ranks in [1_usize, 2, 3, 5, 64, 10_000] {
            let share = |unknowns: usize| ranks.div_ceil(ranks_in_group(unknowns, ranks));
            assert_eq!([1, 2, SMALL].map(share), [1; 3], "{ranks} ranks");
            assert_eq!(share(LEAST_ON_A_RANK * ranks + SMALL), ranks);
            let mut before = 1;
            for unknowns in (SMALL + 1..4 * LEAST_ON_A_RANK * ranks).step_by(977) {
                let now = share(unknowns);
                // The last group may be incomplete: one rank more. Groups are powers of two: twice as many unknowns on a rank at most.
                assert!(
                    now >= before && (now == 1 || now * LEAST_ON_A_RANK <= unknowns + LEAST_ON_A_RANK),
                    "{unknowns} unknowns on {now} of {ranks}"
                );
                before = now;
            }
        }
    }
}
