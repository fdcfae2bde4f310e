//! The blocks of the saddle point that have a multiplier side: `B̂`, `B̂ᵀ`, `-Ĉ` and the approximate Schur complement.

use crate::contact::{DiagonalBlock, MultiplierSpace, SparseRows, jump_matrix};
use crate::geometry::Point;
use crate::petsc::{Matrix, Session};
use crate::system::contact::weights;
use crate::system::{Contact, CouplingRows, Discretisation, Space, SystemError};
use std::collections::{BTreeMap, BTreeSet};

/// What the approximate Schur complement couples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SchurPattern {
    /// Each multiplier with itself.
    Diagonal,
    /// The two of each discontinuous segment.
    Pairs,
    /// Contacts of both kinds, or a jump term: a band.
    Mixed,
}

impl SchurPattern {
    fn of(contacts: &[Contact]) -> Self {
        let paired = |contact: &Contact| contact.pair.space == MultiplierSpace::P1Discontinuous;
        let stabilised = contacts.iter().any(|contact| !contact.jumps.is_empty());
        match (stabilised, contacts.iter().any(paired), contacts.iter().all(paired)) {
            (false, false, _) => Self::Diagonal,
            (false, true, true) => Self::Pairs,
            _ => Self::Mixed,
        }
    }

    /// An empty matrix of this pattern over `own` multipliers of this rank.
    fn matrix(self, own: usize, session: &Session) -> Result<Matrix, SystemError> {
        let (block, diagonal, off_diagonal) = match self {
            Self::Diagonal => (1, 1, 0),
            Self::Pairs => (2, 1, 0),
            Self::Mixed => (1, 3, 2),
        };
        let rows = own / block;
        Ok(Matrix::aij(session, own, own, block, &vec![diagonal.min(own as i32); rows], &vec![off_diagonal; rows])?)
    }
}

/// The multiplier blocks, with the numbers and scales of the multipliers.
pub struct MultiplierBlocks {
    /// `B̂ = s B`.
    pub coupling: Matrix,
    /// `B̂ᵀ (I - D̂ Ĉ)`; without a jump term `B̂ᵀ` but for inactive multipliers, whose columns are zero either way.
    pub transpose: Matrix,
    /// `-Ĉ`.
    pub corner: Matrix,
    /// `-(D̂⁻¹ + Ĉ)`.
    pub schur: Matrix,
    /// Pattern of the approximate Schur complement.
    pub pattern: SchurPattern,
    /// `s_i = E_c / H_i` (stress per length).
    pub scale: Vec<f64>,
    /// Multipliers of this rank, in the order of their numbers.
    pub own: Vec<usize>,
    /// Number of each multiplier: by rank, along the boundaries within a rank.
    number: Vec<usize>,
    /// Nodes in each column of the transpose, whatever the active set.
    columns: Vec<BTreeSet<usize>>,
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
        let all = vec![true; owners.len()];
        let jumps = jump_matrix(problem.jumps(), owners.len());
        let columns: Vec<BTreeSet<usize>> = corrected(rows, &weights(&problem.contacts, &all), &jumps)
            .into_iter()
            .map(|column| column.into_keys().collect())
            .collect();
        let corner = if problem.jumps().next().is_some() { SchurPattern::Mixed } else { SchurPattern::Diagonal };
        Ok(Self {
            coupling: coupling_matrix(rows, &own, problem.finest(), session)?,
            transpose: transpose_matrix(&columns, &own, problem.finest(), session)?,
            corner: corner.matrix(own.len(), session)?,
            schur: pattern.matrix(own.len(), session)?,
            pattern,
            scale: problem.contacts.iter().flat_map(scale).collect(),
            own,
            number,
            columns,
        })
    }

    /// Values for an active set with its weights `D` and its jump term `C`: on active multipliers `-C` and
    /// `S = -(D⁻¹ + C)`; an inactive one has a zero row of `B` and `-1/D_ii` in both. **Collective**
    pub fn fill(
        &mut self,
        problem: &Discretisation,
        rows: &CouplingRows,
        active: &[bool],
        weights: &[DiagonalBlock],
        jumps: &SparseRows,
    ) -> Result<(), SystemError> {
        let transposed = corrected(rows, weights, jumps);
        let (own_rows, own_nodes) = (self.coupling.row_range(), &problem.finest().own);
        self.corner.zero_entries()?;
        self.schur.zero_entries()?;
        for i in 0..active.len() {
            let at = [self.number[i] as i32];
            let here = own_rows.contains(&self.number[i]);
            let scale = if active[i] { self.scale[i] } else { 0.0 };
            for &(node, value) in rows.row(i).iter().filter(|_| here) {
                let columns = [2 * node as i32, 2 * node as i32 + 1];
                self.coupling.insert(&at, &columns, &[value.x * scale, value.y * scale])?;
            }
            for node in self.columns[i].iter().filter(|node| own_nodes.contains(node)) {
                let value = transposed[i].get(node).copied().unwrap_or_default() * scale;
                self.transpose.insert(&[2 * *node as i32, 2 * *node as i32 + 1], &at, &[value.x, value.y])?;
            }
            if here {
                let contact = problem.contact_of(i);
                let alone = contact.multipliers.single_weight(i - contact.first, contact.modulus) / self.scale[i].powi(2);
                let value = if active[i] { 0.0 } else { -1.0 / alone };
                self.corner.add(&at, &at, &[value])?;
                self.schur.add(&at, &at, &[value])?;
            }
        }
        self.fill_bands(active, weights, jumps)?;
        for matrix in [&mut self.coupling, &mut self.transpose, &mut self.corner, &mut self.schur] {
            matrix.assemble()?;
        }
        Ok(())
    }

    /// Adds `-D⁻¹` to the Schur complement and `-C` to both, on active multipliers.
    fn fill_bands(&mut self, active: &[bool], weights: &[DiagonalBlock], jumps: &SparseRows) -> Result<(), SystemError> {
        let own = self.coupling.row_range();
        let place = |i: usize, j: usize| ([self.number[i] as i32], [self.number[j] as i32], self.scale[i] * self.scale[j]);
        for block in weights.iter().map(DiagonalBlock::inverse) {
            for (p, &i) in block.rows.iter().enumerate().filter(|(_, i)| own.contains(&self.number[**i])) {
                for (q, &j) in block.rows.iter().enumerate() {
                    let (row, column, scale) = place(i, j);
                    self.schur.add(&row, &column, &[-scale * block.values[p][q]])?;
                }
            }
        }
        for (i, row) in jumps.iter().enumerate().filter(|(i, _)| active[*i] && own.contains(&self.number[*i])) {
            for (&j, value) in row.iter().filter(|(j, _)| active[**j]) {
                let (row, column, scale) = place(i, j);
                self.corner.add(&row, &column, &[-scale * value])?;
                self.schur.add(&row, &column, &[-scale * value])?;
            }
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

/// Columns of `Bᵀ (I - D C)`: for each multiplier its nodes with their entries.
fn corrected(rows: &CouplingRows, weights: &[DiagonalBlock], jumps: &SparseRows) -> Vec<BTreeMap<usize, Point>> {
    let mut columns: Vec<BTreeMap<usize, Point>> = (0..rows.count()).map(|i| rows.row(i).iter().copied().collect()).collect();
    for block in weights {
        for (p, &i) in block.rows.iter().enumerate() {
            for (q, &k) in block.rows.iter().enumerate() {
                for (&j, c) in &jumps[k] {
                    for &(node, value) in rows.row(i) {
                        *columns[j].entry(node).or_default() -= block.values[p][q] * c * value;
                    }
                }
            }
        }
    }
    columns
}

/// Empty `B̂` with exact room.
fn coupling_matrix(rows: &CouplingRows, own: &[usize], space: &Space, session: &Session) -> Result<Matrix, SystemError> {
    let count =
        |i: &usize, here: bool| 2 * rows.row(*i).iter().filter(|(node, _)| space.own.contains(node) == here).count() as i32;
    let [diagonal, off_diagonal] = [true, false].map(|here| own.iter().map(|i| count(i, here)).collect::<Vec<_>>());
    Ok(Matrix::aij(session, own.len(), space.local_unknowns(), 1, &diagonal, &off_diagonal)?)
}

/// Empty `B̂ᵀ (I - D̂ Ĉ)` with exact room for the given columns.
fn transpose_matrix(columns: &[BTreeSet<usize>], own: &[usize], space: &Space, session: &Session) -> Result<Matrix, SystemError> {
    let unknowns = space.local_unknowns();
    let mut counts = [vec![0; unknowns], vec![0; unknowns]];
    let mine: BTreeSet<usize> = own.iter().copied().collect();
    for (i, column) in columns.iter().enumerate() {
        for node in column.range(space.own.clone()) {
            let row = 2 * (node - space.own.start);
            let counts = &mut counts[if mine.contains(&i) { 0 } else { 1 }];
            counts[row] += 1;
            counts[row + 1] += 1;
        }
    }
    Ok(Matrix::aij(session, unknowns, own.len(), 1, &counts[0], &counts[1])?)
}
