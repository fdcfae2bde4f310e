//! The blocks of the saddle point that have a multiplier side: `B̂`, `B̂ᵀ`, `-Ĉ` and the approximate Schur complement.

use super::{Contact, CouplingRows, Discretisation, Space, SystemError};
use crate::contact::{DiagonalBlock, MultiplierSpace};
use crate::petsc::{Matrix, Session};
use std::collections::HashMap;

/// What the approximate Schur complement couples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SchurPattern {
    /// Each multiplier with itself.
    Diagonal,
    /// The two of each discontinuous segment.
    Pairs,
    /// Contacts of both kinds.
    Mixed,
}

impl SchurPattern {
    fn of(contacts: &[Contact]) -> Self {
        let paired = |contact: &Contact| contact.pair.space == MultiplierSpace::P1Discontinuous;
        match (contacts.iter().any(paired), contacts.iter().all(paired)) {
            (false, _) => Self::Diagonal,
            (true, true) => Self::Pairs,
            (true, false) => Self::Mixed,
        }
    }

    /// An empty matrix of this pattern over `own` multipliers of this rank.
    fn matrix(self, own: usize, session: &Session) -> Result<Matrix, SystemError> {
        let (block, most) = match self {
            Self::Diagonal => (1, 1),
            Self::Pairs => (2, 1),
            Self::Mixed => (1, 2),
        };
        Ok(Matrix::aij(session, own, own, block, &vec![most; own / block], &vec![0; own / block])?)
    }
}

/// The multiplier blocks, with the numbers and scales of the multipliers.
pub struct MultiplierBlocks {
    /// `B̂ = s B`.
    pub coupling: Matrix,
    /// `B̂ᵀ`.
    pub transpose: Matrix,
    /// `-Ĉ`.
    pub corner: Matrix,
    /// `-D̂⁻¹`.
    pub schur: Matrix,
    /// Pattern of the approximate Schur complement.
    pub pattern: SchurPattern,
    /// `s_i = E_c / H_i` (stress per length).
    pub scale: Vec<f64>,
    /// Multipliers of this rank, in the order of their numbers.
    pub own: Vec<usize>,
    /// Number of each multiplier: by rank, along the boundaries within a rank.
    number: Vec<usize>,
}

impl MultiplierBlocks {
    /// Empty blocks with exact room; `rows` are those of `B` on the finest level. **Collective**
    pub fn new(problem: &Discretisation, rows: &CouplingRows, session: &Session) -> Result<Self, SystemError> {
        let owners = &problem.coupling.owners;
        let mut order: Vec<usize> = (0..owners.len()).collect();
        order.sort_by_key(|&i| (owners[i], i));
        let mut number = vec![0; owners.len()];
        order.iter().enumerate().for_each(|(at, &i)| number[i] = at);
        let own: Vec<usize> = order.into_iter().filter(|&i| owners[i] == session.rank()).collect();
        let scale = |contact: &Contact| {
            let lengths: Vec<f64> = (0..contact.multipliers.count()).map(|i| contact.multipliers.length(i)).collect();
            let modulus = contact.modulus;
            lengths.into_iter().map(move |length| modulus / length)
        };
        let pattern = SchurPattern::of(&problem.contacts);
        let (coupling, transpose) = coupling_matrices(rows, &own, problem.finest(), session)?;
        Ok(Self {
            coupling,
            transpose,
            corner: SchurPattern::Diagonal.matrix(own.len(), session)?,
            schur: pattern.matrix(own.len(), session)?,
            pattern,
            scale: problem.contacts.iter().flat_map(scale).collect(),
            own,
            number,
        })
    }

    /// Values for an active set with its weights `D`: `-C` is zero and `S = -D⁻¹` on active multipliers; an inactive
    /// one has a zero row of `B` and `-1/D_ii` in both. **Collective**
    pub fn fill(
        &mut self,
        problem: &Discretisation,
        rows: &CouplingRows,
        active: &[bool],
        weights: &[DiagonalBlock],
    ) -> Result<(), SystemError> {
        let (own_rows, own_nodes) = (self.coupling.row_range(), &problem.finest().own);
        self.corner.zero_entries()?;
        self.schur.zero_entries()?;
        for (i, &active) in active.iter().enumerate() {
            let number = self.number[i];
            let here = own_rows.contains(&number);
            let at = [number as i32];
            for &(node, value) in rows.row(i) {
                let (columns, value) = ([2 * node as i32, 2 * node as i32 + 1], value * if active { self.scale[i] } else { 0.0 });
                if here {
                    self.coupling.insert(&at, &columns, &[value.x, value.y])?;
                }
                if own_nodes.contains(&node) {
                    self.transpose.insert(&columns, &at, &[value.x, value.y])?;
                }
            }
            if here {
                let contact = problem.contact_of(i);
                let alone = contact.multipliers.single_weight(i - contact.first, contact.modulus) / self.scale[i].powi(2);
                self.corner.insert(&at, &at, &[if active { 0.0 } else { -1.0 / alone }])?;
                if !active {
                    self.schur.insert(&at, &at, &[-1.0 / alone])?;
                }
            }
        }
        for block in weights {
            let inverse = block.inverse();
            for (p, &i) in block.rows.iter().enumerate() {
                for (q, &j) in block.rows.iter().enumerate() {
                    if own_rows.contains(&self.number[i]) {
                        let value = -self.scale[i] * self.scale[j] * inverse.values[p][q];
                        self.schur.insert(&[self.number[i] as i32], &[self.number[j] as i32], &[value])?;
                    }
                }
            }
        }
        for matrix in [&mut self.coupling, &mut self.transpose, &mut self.corner, &mut self.schur] {
            matrix.assemble()?;
        }
        Ok(())
    }

    /// This rank's multiplier entries brought together on every rank, in the order along the boundaries. **Collective**
    pub fn collect(&self, own: &[f64], session: &Session) -> Vec<f64> {
        let mut all = vec![0.0; self.scale.len()];
        self.own.iter().zip(own).for_each(|(&i, &value)| all[i] = value);
        session.sum(&mut all);
        all
    }
}

/// Empty `B̂` and `B̂ᵀ` with exact room.
fn coupling_matrices(
    rows: &CouplingRows,
    own: &[usize],
    space: &Space,
    session: &Session,
) -> Result<(Matrix, Matrix), SystemError> {
    let unknowns = space.local_unknowns();
    let mut counts = [vec![0; own.len()], vec![0; own.len()], vec![0; unknowns], vec![0; unknowns]];
    let places: HashMap<usize, usize> = own.iter().enumerate().map(|(at, &i)| (i, at)).collect();
    for i in 0..rows.count() {
        for &(node, _) in rows.row(i) {
            let own_node = space.own.contains(&node);
            if let Some(&at) = places.get(&i) {
                counts[if own_node { 0 } else { 1 }][at] += 2;
            }
            if own_node {
                let row = 2 * (node - space.own.start);
                let counts = &mut counts[if places.contains_key(&i) { 2 } else { 3 }];
                counts[row] += 1;
                counts[row + 1] += 1;
            }
        }
    }
    let coupling = Matrix::aij(session, own.len(), unknowns, 1, &counts[0], &counts[1])?;
    let transpose = Matrix::aij(session, unknowns, own.len(), 1, &counts[2], &counts[3])?;
    Ok((coupling, transpose))
}
