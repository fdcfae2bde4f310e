//! The weights `D` of the active multipliers, and how they change with them.

use crate::contact::DiagonalBlock;
use crate::discretisation::Contact;
use crate::mesh::each_once;
use std::ops::Range;

/// `D` of all contacts, numbered through: block diagonal, a block for each group of multipliers that the mass matrix couples.
pub struct Augmentation {
    /// `D` over the active multipliers of each group, if there are any.
    blocks: Vec<Option<DiagonalBlock>>,
    /// Multipliers of each group.
    pub members: Vec<Range<usize>>,
    /// Group of each multiplier.
    group: Vec<usize>,
}

impl Augmentation {
    /// With no multiplier active.
    pub fn new(contacts: &[Contact]) -> Self {
        let mut members: Vec<Range<usize>> = Vec::new();
        let mut group = Vec::new();
        for contact in contacts {
            let groups = contact.multipliers.groups();
            let each = contact.multipliers.count() / groups;
            let of_group = |own: usize| contact.first + each * own..contact.first + each * (own + 1);
            group.extend(contact.range().map(|i| members.len() + contact.multipliers.group_of(i - contact.first)));
            members.extend((0..groups).map(of_group));
        }
        Self { blocks: vec![None; members.len()], members, group }
    }

    /// Group of a multiplier.
    pub fn group_of(&self, multiplier: usize) -> usize {
        self.group[multiplier]
    }

    /// Groups of some multipliers, ascending.
    pub fn groups_of(&self, multipliers: impl IntoIterator<Item = usize>) -> Vec<usize> {
        each_once(multipliers.into_iter().map(|i| self.group[i]))
    }

    /// Takes these groups over as they are in another active set. Gives what that adds to `D`, each with its group: the old blocks
    /// with their signs changed, then the new ones.
    pub fn change(&mut self, groups: &[usize], contacts: &[Contact], active: &[bool]) -> Vec<(usize, DiagonalBlock)> {
        let (mut gone, mut come) = (Vec::new(), Vec::new());
        for &group in groups {
            let now = self.block(group, contacts, active);
            let before = std::mem::replace(&mut self.blocks[group], now.clone());
            if before != now {
                gone.extend(before.map(|block| (group, block.negative())));
                come.extend(now.map(|block| (group, block)));
            }
        }
        gone.append(&mut come);
        gone
    }

    fn block(&self, group: usize, contacts: &[Contact], active: &[bool]) -> Option<DiagonalBlock> {
        let first = self.members[group].start;
        let contact = Contact::of_multiplier(contacts, first);
        let own = contact.multipliers.group_of(first - contact.first);
        let modulus = contact.multiplier_moduli[first - contact.first];
        let mut block = contact.multipliers.augmentation(own, modulus, &active[contact.range()])?;
        block.rows = block.rows.start + contact.first..block.rows.end + contact.first;
        Some(block)
    }

    /// The block of a group, over its active multipliers.
    pub fn of(&self, group: usize) -> Option<&DiagonalBlock> {
        self.blocks[group].as_ref()
    }

    /// All blocks, by ascending multipliers.
    pub fn iter(&self) -> impl Iterator<Item = &DiagonalBlock> {
        self.blocks.iter().flatten()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::{Known, MultiplierSpace};
    use crate::discretisation::Scene;
    use crate::discretisation::samples::{blocks, contact, pair};
    use crate::geometry::Point;

    #[test]
    fn a_change_of_the_set_hands_over_the_blocks_that_change_and_no_others() {
        for space in [MultiplierSpace::P0, MultiplierSpace::P1Discontinuous, MultiplierSpace::P1Continuous] {
            let scene = Scene { refine: 11, ..blocks(pair(space, 50_000), |_| Point::zeros(), Vec::new()) };
            let contacts = [contact(&scene, Known::default())];
            let mut active = vec![true; contacts[0].multipliers.count()];
            let mut augmentation = Augmentation::new(&contacts);
            let all = augmentation.groups_of(0..active.len());
            assert_eq!(augmentation.change(&all, &contacts, &active).len(), augmentation.members.len());
            let changed = [7, 20_000, 20_001, 40_000];
            changed.iter().for_each(|&i| active[i] = false);
            let groups = augmentation.groups_of(changed);
            assert!(groups.len() <= changed.len());
            let change = augmentation.change(&groups, &contacts, &active);
            assert!(change.len() <= 2 * changed.len(), "{space:?}: {} blocks", change.len());
            let touched =
                change.iter().flat_map(|(_, block)| block.rows.clone()).all(|i| groups.contains(&augmentation.group[i]));
            assert!(touched && augmentation.change(&groups, &contacts, &active).is_empty());
        }
    }
}
