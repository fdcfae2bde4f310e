//! The weights `D` of the active multipliers, and how they change with them.

use crate::contact::DiagonalBlock;
use crate::system::Contact;
use std::collections::BTreeSet;

/// `D` of all contacts, numbered through: block diagonal, a block for each group of multipliers that the mass matrix couples.
pub struct Augmentation {
    /// `D` over the active multipliers of each group, if there are any.
    blocks: Vec<Option<DiagonalBlock>>,
    /// Multipliers of each group.
    members: Vec<Vec<usize>>,
    /// Group of each multiplier.
    group: Vec<usize>,
}

impl Augmentation {
    /// With no multiplier active.
    pub fn new(contacts: &[Contact]) -> Self {
        let mut members: Vec<Vec<usize>> = Vec::new();
        let mut group = Vec::new();
        for contact in contacts {
            let first = members.len();
            members.resize(first + contact.multipliers.groups(), Vec::new());
            for i in contact.range() {
                let own = first + contact.multipliers.group_of(i - contact.first);
                members[own].push(i);
                group.push(own);
            }
        }
        Self { blocks: vec![None; members.len()], members, group }
    }

    /// Multipliers of each group.
    pub fn members(&self) -> &[Vec<usize>] {
        &self.members
    }

    /// Groups of some multipliers, ascending.
    pub fn groups_of(&self, multipliers: impl IntoIterator<Item = usize>) -> BTreeSet<usize> {
        multipliers.into_iter().map(|i| self.group[i]).collect()
    }

    /// Takes these groups over as they are in another active set. Gives what that adds to `D`: the old blocks with their
    /// signs changed, then the new ones.
    pub fn change(&mut self, groups: &BTreeSet<usize>, contacts: &[Contact], active: &[bool]) -> Vec<DiagonalBlock> {
        let (mut gone, mut come) = (Vec::new(), Vec::new());
        for &group in groups {
            let now = self.block(group, contacts, active);
            let before = std::mem::replace(&mut self.blocks[group], now.clone());
            if before != now {
                gone.extend(before.map(|block| block.negative()));
                come.extend(now);
            }
        }
        gone.append(&mut come);
        gone
    }

    fn block(&self, group: usize, contacts: &[Contact], active: &[bool]) -> Option<DiagonalBlock> {
        let first = self.members[group][0];
        let contact = &contacts[contacts.partition_point(|contact| contact.first <= first) - 1];
        let own = contact.multipliers.group_of(first - contact.first);
        let modulus = contact.multiplier_moduli[first - contact.first];
        let mut block = contact.multipliers.augmentation(own, modulus, &active[contact.range()])?;
        block.rows.iter_mut().for_each(|row| *row += contact.first);
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
    use crate::geometry::Point;
    use crate::system::Scene;
    use crate::system::samples::{blocks, contact, pair};

    #[test]
    fn a_change_of_the_set_hands_over_the_blocks_that_change_and_no_others() {
        for space in [MultiplierSpace::P0, MultiplierSpace::P1Discontinuous, MultiplierSpace::P1Continuous] {
            let scene = Scene { refine: 11, ..blocks(pair(space, 50_000), |_| Point::zeros(), Vec::new()) };
            let contacts = [contact(&scene, Known::default())];
            let mut active = vec![true; contacts[0].multipliers.count()];
            let mut augmentation = Augmentation::new(&contacts);
            let all = augmentation.groups_of(0..active.len());
            assert_eq!(augmentation.change(&all, &contacts, &active).len(), augmentation.members().len());
            let changed = [7, 20_000, 20_001, 40_000];
            changed.iter().for_each(|&i| active[i] = false);
            let groups = augmentation.groups_of(changed);
            assert!(groups.len() <= changed.len());
            let change = augmentation.change(&groups, &contacts, &active);
            assert!(change.len() <= 2 * changed.len(), "{space:?}: {} blocks", change.len());
            let touched = change.iter().flat_map(|block| &block.rows).all(|&i| groups.contains(&augmentation.group[i]));
            assert!(touched && augmentation.change(&groups, &contacts, &active).is_empty());
        }
    }
}
