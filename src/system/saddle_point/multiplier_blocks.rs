//! The blocks of the saddle point that have a multiplier side: `B̂`, `B̂ᵀ`, `-Ĉ` and the approximate Schur complement.

use super::augmentation::Augmentation;
use super::coupling_rows::CouplingRows;
use crate::contact::{DiagonalBlock, MultiplierSpace, SparseRows, jump_matrix};
use crate::discretisation::{Contact, Discretisation, Form, Space, SystemError};
use crate::geometry::Point;
use crate::mesh::each_once;
use crate::petsc::{Index, Matrix, Session};
use std::borrow::Cow;
use std::collections::BTreeMap;

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
        Ok(Matrix::aij(session, own, own, block, &vec![diagonal.min(own as Index); rows], &vec![off_diagonal; rows])?)
    }
}

/// The multiplier blocks, with the numbers and scales of the multipliers.
pub struct MultiplierBlocks {
    session: Session,
    /// `B̂ = s B`.
    pub coupling: Matrix,
    /// `B̂ᵀ (I - D̂ Ĉ)`; without a jump term `B̂ᵀ`.
    pub transpose: Matrix,
    /// Whether that has entries of its own: with a jump term, and in the plain form.
    is_stored: bool,
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
    /// Nodes of this rank in each column of the transpose, whatever the active set; none if that has no entries of its own.
    columns: Vec<Vec<usize>>,
    /// `C`, unscaled.
    pub(super) jumps: SparseRows,
    /// Room for a row of `-Ĉ` and one of the approximate Schur complement.
    row_of: [MultiplierRow; 2],
}

impl MultiplierBlocks {
    /// Empty blocks with exact preallocation; `rows` are those of `B` on the finest level, `all` are the weights of all
    /// multipliers. The plain form is made into one matrix, so that all entries are wanted.
    /// **Collective**
    pub fn new(problem: &Discretisation, rows: &CouplingRows, all: &Augmentation, form: Form) -> Result<Self, SystemError> {
        let owners = &problem.coupling.owners;
        let mut order: Vec<usize> = (0..owners.len()).collect();
        order.sort_by_key(|&i| (owners[i], i));
        let mut number = vec![0; owners.len()];
        order.iter().enumerate().for_each(|(at, &i)| number[i] = at);
        let own: Vec<usize> = order.into_iter().filter(|&i| owners[i] == problem.session.rank()).collect();
        let scale = |contact: &Contact| {
            let moduli = contact.multiplier_moduli.iter().enumerate();
            moduli.map(|(i, modulus)| modulus / contact.multipliers.length(i)).collect::<Vec<f64>>()
        };
        let pattern = SchurPattern::of(&problem.contacts);
        let jumps = jump_matrix(problem.jumps(), owners.len());
        let space = problem.finest();
        let own_nodes = |j: usize| -> Vec<usize> {
            let column = corrected(rows, all, &jumps, j);
            column.iter().map(|(node, _)| *node).filter(|node| space.own.contains(node)).collect()
        };
        let is_stored = form == Form::Plain || problem.jumps().next().is_some();
        let columns: Vec<Vec<usize>> = if is_stored { (0..owners.len()).map(own_nodes).collect() } else { Vec::new() };
        let corner = if problem.jumps().next().is_some() { SchurPattern::Mixed } else { SchurPattern::Diagonal };
        let coupling = coupling_matrix(rows, &own, space, &problem.session)?;
        let transpose = match is_stored {
            true => transpose_matrix(&columns, owners, own.len(), space, &problem.session)?,
            false => coupling.transposed()?,
        };
        Ok(Self {
            session: problem.session.clone(),
            coupling,
            transpose,
            is_stored,
            corner: corner.matrix(own.len(), &problem.session)?,
            schur: pattern.matrix(own.len(), &problem.session)?,
            pattern,
            scale: problem.contacts.iter().flat_map(scale).collect(),
            own,
            number,
            columns,
            jumps,
            row_of: Default::default(),
        })
    }

    /// Values for another active set: those of all `changed` multipliers and of what these touch. On active multipliers `-C` and
    /// `S = -(D⁻¹ + C)`; an inactive one has a zero row of `B` and `-1/D_ii` in both. **Collective**
    pub fn set(
        &mut self,
        problem: &Discretisation,
        rows: &CouplingRows,
        active: &[bool],
        augmentation: &Augmentation,
        changed: &[usize],
    ) -> Result<(), SystemError> {
        let own_rows = self.coupling.row_range();
        let mut entries = ScaledEntries::default();
        for i in self.touched(augmentation, changed) {
            let at = [self.number[i] as Index];
            let scale = if active[i] { self.scale[i] } else { 0.0 };
            if own_rows.contains(&self.number[i]) {
                entries.put(rows.row(i).iter().copied(), scale);
                self.coupling.insert(&at, entries.unknowns.as_flattened(), entries.values.as_flattened())?;
                self.set_corner(problem, active, augmentation, i)?;
            }
            if !self.is_stored {
                continue;
            }
            let column = corrected(rows, augmentation, &self.jumps, i);
            if column.is_empty() && self.jumps[i].is_empty() {
                continue;
            }
            let value = |node: &usize| column.binary_search_by_key(node, |entry| entry.0).map_or(Point::zeros(), |k| column[k].1);
            entries.put(self.columns[i].iter().map(|node| (*node, value(node))), scale);
            self.transpose.insert(entries.unknowns.as_flattened(), &at, entries.values.as_flattened())?;
        }
        let stored = self.is_stored.then_some(&mut self.transpose);
        for matrix in [&mut self.coupling, &mut self.corner, &mut self.schur].into_iter().chain(stored) {
            matrix.assemble()?;
        }
        Ok(())
    }

    /// Multipliers whose rows and columns are others after a change: those of the groups that have changed, and those that a
    /// jump term couples to them.
    fn touched(&self, augmentation: &Augmentation, changed: &[usize]) -> Vec<usize> {
        let groups = augmentation.groups_of(changed.iter().copied());
        let members = groups.into_iter().flat_map(|group| augmentation.members[group].clone());
        each_once(members.flat_map(|i| self.jumps[i].keys().copied().chain([i])))
    }

    /// Row `i` of `-C` and of `S`, whole: what is no longer there is zero.
    fn set_corner(
        &mut self,
        problem: &Discretisation,
        active: &[bool],
        augmentation: &Augmentation,
        i: usize,
    ) -> Result<(), SystemError> {
        let contact = problem.contact_of(i);
        let alone = contact.multipliers.single_weight(i - contact.first, contact.multiplier_moduli[i - contact.first])
            / self.scale[i].powi(2);
        let diagonal = if active[i] { 0.0 } else { -1.0 / alone };
        let scaled = |j: usize, value: f64| -(self.scale[i] * self.scale[j]) * value;
        let ([corner, schur], group) = (&mut self.row_of, augmentation.group_of(i));
        corner.begin(self.number[i], diagonal);
        schur.begin(self.number[i], diagonal);
        augmentation.members[group].clone().for_each(|j| schur.add(self.number[j], 0.0));
        if let Some(inverse) = augmentation.of(group).filter(|_| active[i]).map(DiagonalBlock::inverse) {
            let of_row = inverse.values[i - inverse.rows.start];
            inverse.rows.zip(of_row).for_each(|(j, value)| schur.add(self.number[j], scaled(j, value)));
        }
        for (&j, &value) in &self.jumps[i] {
            let value = if active[i] && active[j] { scaled(j, value) } else { 0.0 };
            corner.add(self.number[j], value);
            schur.add(self.number[j], value);
        }
        for (matrix, row) in [(&mut self.corner, corner), (&mut self.schur, schur)] {
            matrix.insert(&[self.number[i] as Index], &row.columns, &row.values)?;
        }
        Ok(())
    }

    /// `C λ` (length squared).
    pub fn jump_term(&self, lambda: &[f64]) -> Vec<f64> {
        self.jumps.iter().map(|row| row.iter().map(|(&j, value)| value * lambda[j]).sum()).collect()
    }

    /// This rank's multiplier entries brought together on every rank, in the order along the boundaries. **Collective**
    pub fn collect(&self, own: &[f64]) -> Vec<f64> {
        let mut all = vec![0.0; self.scale.len()];
        self.own.iter().zip(own).for_each(|(&i, &value)| all[i] = value);
        self.session.sum(all)
    }
}

/// Unknowns of some nodes with the entries of a multiplier.
#[derive(Default)]
struct ScaledEntries {
    unknowns: Vec<[Index; 2]>,
    values: Vec<[f64; 2]>,
}

impl ScaledEntries {
    /// Puts the entries of these nodes, times a factor, in place of those before.
    fn put(&mut self, entries: impl Iterator<Item = (usize, Point)>, factor: f64) {
        self.unknowns.clear();
        self.values.clear();
        for (node, value) in entries {
            self.unknowns.push([2 * node as Index, 2 * node as Index + 1]);
            self.values.push([value.x * factor, value.y * factor]);
        }
    }
}

/// A row of a matrix between multipliers.
#[derive(Default)]
struct MultiplierRow {
    columns: Vec<Index>,
    values: Vec<f64>,
}

impl MultiplierRow {
    fn begin(&mut self, column: usize, value: f64) {
        self.columns.clear();
        self.values.clear();
        self.add(column, value);
    }

    /// Adds to the value of a column: a row has few.
    fn add(&mut self, column: usize, value: f64) {
        match self.columns.iter().position(|&other| other == column as Index) {
            Some(at) => self.values[at] += value,
            None => {
                self.columns.push(column as Index);
                self.values.push(value);
            }
        }
    }
}

/// Column `j` of `Bᵀ (I - D C)`: nodes, ascending, with their entries; without a jump term that of `Bᵀ`.
fn corrected<'a>(rows: &'a CouplingRows, augmentation: &Augmentation, jumps: &SparseRows, j: usize) -> Cow<'a, [(usize, Point)]> {
    if jumps[j].is_empty() {
        return Cow::Borrowed(rows.row(j));
    }
    let mut column: BTreeMap<usize, Point> = rows.row(j).iter().copied().collect();
    for block in augmentation.groups_of(jumps[j].keys().copied()).into_iter().filter_map(|group| augmentation.of(group)) {
        for (p, i) in block.rows.clone().enumerate() {
            for (q, k) in block.rows.clone().enumerate() {
                let Some(c) = jumps[j].get(&k) else { continue };
                for &(node, value) in rows.row(i) {
                    *column.entry(node).or_default() -= block.values[p][q] * c * value;
                }
            }
        }
    }
    Cow::Owned(column.into_iter().collect())
}

/// Empty `B̂` with exact preallocation.
fn coupling_matrix(rows: &CouplingRows, own: &[usize], space: &Space, session: &Session) -> Result<Matrix, SystemError> {
    let count =
        |i: &usize, here: bool| 2 * rows.row(*i).iter().filter(|(node, _)| space.own.contains(node) == here).count() as Index;
    let [diagonal, off_diagonal] = [true, false].map(|here| own.iter().map(|i| count(i, here)).collect::<Vec<_>>());
    Ok(Matrix::aij(session, own.len(), space.local_unknowns(), 1, &diagonal, &off_diagonal)?)
}

/// Empty `B̂ᵀ (I - D̂ Ĉ)` with exact preallocation for this rank's nodes in each column; `own` multipliers are this rank's.
fn transpose_matrix(
    columns: &[Vec<usize>],
    owners: &[usize],
    own: usize,
    space: &Space,
    session: &Session,
) -> Result<Matrix, SystemError> {
    let unknowns = space.local_unknowns();
    let mut counts = [vec![0; unknowns], vec![0; unknowns]];
    for (nodes, &owner) in columns.iter().zip(owners) {
        let counts = &mut counts[if owner == session.rank() { 0 } else { 1 }];
        for node in nodes {
            let row = 2 * (node - space.own.start);
            counts[row] += 1;
            counts[row + 1] += 1;
        }
    }
    Ok(Matrix::aij(session, unknowns, own, 1, &counts[0], &counts[1])?)
}
