//! The saddle-point blocks in PETSc, and their change with the active set.
//!
//! ```text
//! [ K + Bᵀ D B   Bᵀ ] [u]   [ f + Bᵀ D c ]
//! [ B           -C  ] [λ] = [ c          ]
//! ```
//! The system itself is augmented, not only its preconditioner: row 1 plus `Bᵀ D` times row 2 has the same solution,
//! and `K + Bᵀ D B` is definite where `K` alone is singular because a body floats. `C` is zero on active multipliers;
//! an inactive one has a zero row of `B` and `C_ii = 1 / D_ii`, so that sizes and patterns survive every change of
//! the set. Multipliers are scaled by `s_i = E_c / H_i`: `λ = s λ̂`, `B̂ = s B`, `ĉ = s c`, `D̂ = D / s²`; then the
//! residuals of this and of the plain system agree in size.

use super::scene::Contact;
use super::stiffness_matrix::{ContactNeighbours, fill_stiffness, prepare_stiffness};
use super::{Coupling, CouplingRows, Scene, Space, SystemError};
use crate::contact::{ActiveSet, DiagonalBlock, MultiplierSpace};
use crate::geometry::Point;
use crate::petsc::{Matrix, Session, Vector};
use std::collections::HashMap;

/// How the multiplier blocks are set up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// With the augmentation, for the iterative solver.
    Augmented,
    /// Without, for the direct solver.
    Plain,
}

/// Where each multiplier stands: numbered by rank, along the boundaries within a rank.
pub struct MultiplierNumbers {
    /// Number of each multiplier.
    pub number: Vec<usize>,
    /// Multipliers of this rank, in the order of their numbers.
    pub own: Vec<usize>,
}

impl MultiplierNumbers {
    fn new(owners: &[usize], session: &Session) -> Self {
        let mut order: Vec<usize> = (0..owners.len()).collect();
        order.sort_by_key(|&i| (owners[i], i));
        let mut number = vec![0; owners.len()];
        order.iter().enumerate().for_each(|(at, &i)| number[i] = at);
        Self { number, own: order.into_iter().filter(|&i| owners[i] == session.rank()).collect() }
    }
}

/// The blocks, their levels, and the right-hand side.
pub struct SaddlePoint {
    /// `K + Bᵀ D B` on every level, coarsest first; only the finest in the plain form.
    pub stiffness: Vec<Matrix>,
    /// `B̂`.
    pub coupling: Matrix,
    /// `B̂ᵀ`.
    pub transpose: Matrix,
    /// `-Ĉ`.
    pub corner: Matrix,
    /// `-D̂⁻¹`, the approximate Schur complement.
    pub schur: Matrix,
    /// Pattern of the approximate Schur complement.
    pub pattern: SchurPattern,
    /// All four blocks.
    pub nest: Matrix,
    /// Numbers of the multipliers.
    pub numbers: MultiplierNumbers,
    /// `s_i` (stress per length).
    pub scale: Vec<f64>,
    /// `D` of the active multipliers, unscaled, all contacts numbered through.
    weights: Vec<DiagonalBlock>,
    rows: Vec<CouplingRows>,
    form: Form,
    load: Vec<f64>,
    /// `c - B u_D` (length squared).
    pub gap: Vec<f64>,
}

impl SaddlePoint {
    /// Assembles all blocks for an active set. `load` are the nodal forces of this rank's unknowns, in the nodes'
    /// frames, zero where displacement is prescribed; what prescribed displacements add is put in here. **Collective**
    pub fn new(
        scene: &Scene,
        spaces: &[Space],
        contacts: &[Contact],
        coupling: &Coupling,
        mut load: Vec<f64>,
        set: &ActiveSet,
        form: Form,
        session: &Session,
    ) -> Result<Self, SystemError> {
        let groups: Vec<Vec<usize>> = match form {
            Form::Augmented => weights(contacts, &vec![true; coupling.rows.len()]).into_iter().map(|block| block.rows).collect(),
            Form::Plain => Vec::new(),
        };
        let finest = &spaces[spaces.len() - 1];
        let rows = CouplingRows::of_levels(&scene.mesh, coupling, spaces);
        let mut lifted = HashMap::new();
        let mut stiffness = Vec::new();
        for (l, space) in spaces.iter().enumerate() {
            if form == Form::Plain && l + 1 < spaces.len() {
                continue;
            }
            let neighbours: ContactNeighbours = rows[l].neighbours(&groups);
            let mut matrix = prepare_stiffness(scene, space, &neighbours, session)?;
            let last = l + 1 == spaces.len();
            fill_stiffness(&mut matrix, scene, space, &neighbours, session, |node, force| {
                if last {
                    *lifted.entry(node).or_insert(Point::zeros()) += force;
                }
            })?;
            stiffness.push(matrix);
        }
        subtract(&mut load, &lifted, finest, session)?;
        let gap = coupling.gap.iter().zip(&coupling.rows).map(|(c, row)| {
            let moved: f64 = row
                .iter()
                .map(|coupled| coupled.value.dot(&finest.prescribed(coupled.node.number(&scene.mesh, &finest.numbering))))
                .sum();
            c - moved
        });
        let scale: Vec<f64> =
            contacts.iter().flat_map(|c| (0..c.multipliers.count()).map(|i| c.modulus / c.multipliers.length(i))).collect();
        let numbers = MultiplierNumbers::new(&coupling.owners, session);
        let fine_rows = &rows[rows.len() - 1];
        let pattern = SchurPattern::of(contacts);
        let (to_multipliers, transpose) = coupling_matrices(fine_rows, &numbers, finest, session)?;
        let corner = SchurPattern::Diagonal.matrix(&numbers, session)?;
        let schur = pattern.matrix(&numbers, session)?;
        let nest = Matrix::nest(session, [[&stiffness[stiffness.len() - 1], &transpose], [&to_multipliers, &corner]])?;
        let gap = gap.collect();
        let mut system = Self {
            stiffness,
            coupling: to_multipliers,
            transpose,
            corner,
            schur,
            pattern,
            nest,
            numbers,
            scale,
            weights: Vec::new(),
            rows,
            form,
            load,
            gap,
        };
        system.activate(contacts, set.active(), spaces)?;
        Ok(system)
    }

    /// Changes all blocks to another active set; on every level only blocks of changed multipliers. **Collective**
    pub fn activate(&mut self, contacts: &[Contact], active: &[bool], spaces: &[Space]) -> Result<(), SystemError> {
        let next = weights(contacts, active);
        if self.form == Form::Augmented {
            let gone = self.weights.iter().filter(|block| !next.contains(block)).map(|block| {
                let values = block.values.map(|row| row.map(|value| -value));
                DiagonalBlock { rows: block.rows.clone(), values }
            });
            let change: Vec<DiagonalBlock> =
                gone.chain(next.iter().filter(|block| !self.weights.contains(block)).cloned()).collect();
            for ((matrix, rows), space) in self.stiffness.iter_mut().zip(&self.rows).zip(spaces) {
                let mut result = Ok(());
                rows.weighted_square(&change, |a, b, values| {
                    if space.own.contains(&a) && result.is_ok() {
                        result = matrix.add_blocks(&[a as i32], &[b as i32], &values);
                    }
                });
                result?;
                matrix.assemble()?;
            }
        }
        self.weights = next;
        self.fill_coupling(active)?;
        self.fill_corners(contacts, active)?;
        self.nest.refresh()?;
        Ok(())
    }

    fn fill_coupling(&mut self, active: &[bool]) -> Result<(), SystemError> {
        let rows = &self.rows[self.rows.len() - 1];
        let own = self.transpose.row_range();
        for i in 0..rows.count() {
            let number = self.numbers.number[i] as i32;
            let scale = if active[i] { self.scale[i] } else { 0.0 };
            for &(node, value) in rows.row(i) {
                let (column, value) = (2 * node as i32, value * scale);
                if self.coupling.row_range().contains(&(number as usize)) {
                    self.coupling.insert(&[number], &[column, column + 1], &[value.x, value.y])?;
                }
                if own.contains(&(2 * node)) {
                    self.transpose.insert(&[column, column + 1], &[number], &[value.x, value.y])?;
                }
            }
        }
        self.coupling.assemble()?;
        self.transpose.assemble()?;
        Ok(())
    }

    /// `-C` and the Schur complement: zero and `-D⁻¹` on active multipliers, `-1/D_ii` for both on inactive ones.
    fn fill_corners(&mut self, contacts: &[Contact], active: &[bool]) -> Result<(), SystemError> {
        self.corner.zero_entries()?;
        self.schur.zero_entries()?;
        let own = self.corner.row_range();
        for (contact, i) in contacts.iter().flat_map(|contact| contact.range().map(move |i| (contact, i))) {
            let number = self.numbers.number[i];
            if own.contains(&number) {
                let number = [number as i32];
                let alone =
                    contact.multipliers.single_weight(i - contact.first, contact.modulus) / (self.scale[i] * self.scale[i]);
                self.corner.insert(&number, &number, &[if active[i] { 0.0 } else { -1.0 / alone }])?;
                if !active[i] {
                    self.schur.insert(&number, &number, &[-1.0 / alone])?;
                }
            }
        }
        for block in &self.weights {
            let inverse = block.inverse();
            for (p, &i) in block.rows.iter().enumerate() {
                for (q, &j) in block.rows.iter().enumerate() {
                    let (row, column) = (self.numbers.number[i], self.numbers.number[j] as i32);
                    if own.contains(&row) {
                        self.schur.insert(&[row as i32], &[column], &[-self.scale[i] * self.scale[j] * inverse.values[p][q]])?;
                    }
                }
            }
        }
        self.corner.assemble()?;
        self.schur.assemble()?;
        Ok(())
    }

    /// Right-hand side: `f + Bᵀ D c`, and `ĉ` on active multipliers. **Collective**
    pub fn right_hand_side(&self, active: &[bool], space: &Space) -> Result<Vector, SystemError> {
        let (_, mut b) = self.nest.create_vectors()?;
        let mut values = b.values_mut();
        let unknowns = space.local_unknowns();
        values[..unknowns].copy_from_slice(&self.load);
        if self.form == Form::Augmented {
            let weighted = weighted(&self.weights, &self.gap);
            let rows = &self.rows[self.rows.len() - 1];
            for i in (0..active.len()).filter(|&i| active[i]) {
                for &(node, value) in rows.row(i) {
                    if space.own.contains(&node) {
                        let at = 2 * (node - space.own.start);
                        values[at] += weighted[i] * value.x;
                        values[at + 1] += weighted[i] * value.y;
                    }
                }
            }
        }
        for (at, &i) in self.numbers.own.iter().enumerate() {
            values[unknowns + at] = if active[i] { self.scale[i] * self.gap[i] } else { 0.0 };
        }
        drop(values);
        Ok(b)
    }

    /// Relative residual of the plain system, from the residual `r` of this one: `r_u - Bᵀ D r_λ`. **Collective**
    pub fn plain_residual(&self, r: &Vector, b: &Vector, space: &Space, session: &Session) -> Result<f64, SystemError> {
        let values = r.values();
        let unknowns = space.local_unknowns();
        let lower = self.collect(&values[unknowns..], session);
        let unscaled: Vec<f64> = lower.iter().zip(&self.scale).map(|(r, s)| r / s).collect();
        let mut upper = values[..unknowns].to_vec();
        if self.form == Form::Augmented {
            let weighted = weighted(&self.weights, &unscaled);
            for (i, factor) in weighted.iter().enumerate() {
                for &(node, value) in self.rows[self.rows.len() - 1].row(i) {
                    if space.own.contains(&node) {
                        let at = 2 * (node - space.own.start);
                        upper[at] -= factor * value.x;
                        upper[at + 1] -= factor * value.y;
                    }
                }
            }
        }
        let mut square = [upper.iter().chain(&values[unknowns..]).map(|v| v * v).sum::<f64>()];
        session.sum(&mut square);
        let norm = b.norm()?;
        Ok(if norm > 0.0 { square[0].sqrt() / norm } else { 0.0 })
    }

    /// This rank's multiplier entries brought together on every rank, in the order along the boundaries. **Collective**
    pub fn collect(&self, own: &[f64], session: &Session) -> Vec<f64> {
        let mut all = vec![0.0; self.scale.len()];
        self.numbers.own.iter().zip(own).for_each(|(&i, &value)| all[i] = value);
        session.sum(&mut all);
        all
    }

    /// Rows of `B` on the finest level, unscaled, whatever the active set.
    pub fn finest_rows(&self) -> &CouplingRows {
        &self.rows[self.rows.len() - 1]
    }
}

fn weighted(weights: &[DiagonalBlock], r: &[f64]) -> Vec<f64> {
    let mut result = vec![0.0; r.len()];
    for block in weights {
        for (p, &i) in block.rows.iter().enumerate() {
            result[i] += block.rows.iter().enumerate().map(|(q, &j)| block.values[p][q] * r[j]).sum::<f64>();
        }
    }
    result
}

/// `D` of all contacts, numbered through.
fn weights(contacts: &[Contact], active: &[bool]) -> Vec<DiagonalBlock> {
    let own = |contact: &Contact| {
        let mut blocks = contact.multipliers.augmentation(contact.modulus, &active[contact.range()]);
        blocks.iter_mut().flat_map(|block| &mut block.rows).for_each(|row| *row += contact.first);
        blocks
    };
    contacts.iter().flat_map(own).collect()
}

/// Takes the forces of prescribed displacements off the load, wherever their nodes live.
fn subtract(load: &mut [f64], lifted: &HashMap<usize, Point>, space: &Space, session: &Session) -> Result<(), SystemError> {
    if !session.any(!lifted.is_empty()) {
        return Ok(());
    }
    let mut forces = Vector::new(session, space.local_unknowns())?;
    for (&node, force) in lifted {
        forces.add(&[2 * node as i32, 2 * node as i32 + 1], &[-force.x, -force.y])?;
    }
    forces.assemble()?;
    load.iter_mut().zip(forces.values().iter()).for_each(|(sum, force)| *sum += force);
    Ok(())
}

/// Empty `B̂` and `B̂ᵀ` with exact room.
fn coupling_matrices(
    rows: &CouplingRows,
    numbers: &MultiplierNumbers,
    space: &Space,
    session: &Session,
) -> Result<(Matrix, Matrix), SystemError> {
    let unknowns = space.local_unknowns();
    let own = |node: usize| space.own.contains(&node);
    let mut counts = [vec![0; numbers.own.len()], vec![0; numbers.own.len()], vec![0; unknowns], vec![0; unknowns]];
    let at: HashMap<usize, usize> = numbers.own.iter().enumerate().map(|(at, &i)| (i, at)).collect();
    for i in 0..rows.count() {
        for &(node, _) in rows.row(i) {
            if let Some(&at) = at.get(&i) {
                counts[if own(node) { 0 } else { 1 }][at] += 2;
            }
            if own(node) {
                let row = 2 * (node - space.own.start);
                let counts = &mut counts[if at.contains_key(&i) { 2 } else { 3 }];
                counts[row] += 1;
                counts[row + 1] += 1;
            }
        }
    }
    let coupling = Matrix::aij(session, numbers.own.len(), unknowns, 1, &counts[0], &counts[1])?;
    let transpose = Matrix::aij(session, unknowns, numbers.own.len(), 1, &counts[2], &counts[3])?;
    Ok((coupling, transpose))
}

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

    /// An empty matrix of this pattern over the multipliers.
    fn matrix(self, numbers: &MultiplierNumbers, session: &Session) -> Result<Matrix, SystemError> {
        let own = numbers.own.len();
        let (block, most) = match self {
            Self::Diagonal => (1, 1),
            Self::Pairs => (2, 1),
            Self::Mixed => (1, 2),
        };
        Ok(Matrix::aij(session, own, own, block, &vec![most; own / block], &vec![0; own / block])?)
    }
}
