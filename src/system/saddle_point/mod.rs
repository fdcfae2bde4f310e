//! The saddle point in PETSc, and its change with the active set.
//!
//! ```text
//! [ K + Bᵀ D B   Bᵀ (I - D C) ] [u]   [ f + Bᵀ D c ]
//! [ B           -C            ] [λ] = [ c          ]
//! ```
//! The system itself is augmented, not only its preconditioner: row 1 plus `Bᵀ D` times row 2 has the same solution,
//! and `K + Bᵀ D B` is definite where `K` alone is singular because a body floats. `C` is zero on active multipliers
//! but for a jump term;
//! an inactive one has a zero row of `B` and `C_ii = 1 / D_ii`, so that sizes and patterns survive every change of
//! the set. Multipliers are scaled by `s_i = E_c / H_i`: `λ = s λ̂`, `B̂ = s B`, `ĉ = s c`, `D̂ = D / s²`; then the
//! residuals of this and of the plain system agree in size.

mod coupling_rows;
mod multiplier_blocks;

pub use coupling_rows::CouplingRows;
pub use multiplier_blocks::{MultiplierBlocks, SchurPattern};

use super::contact::weights;
use super::stiffness::{ContactNeighbours, Elastic, Stiffness};
use super::{Discretisation, Form, Space, SystemError};
use crate::contact::{DiagonalBlock, SparseRows, jump_matrix};
use crate::petsc::{Matrix, Session, Vector};

/// The blocks, their levels, and the right-hand side.
pub struct SaddlePoint {
    /// `K + Bᵀ D B` on every level, coarsest first; only the finest in the plain form.
    pub stiffness: Vec<Stiffness>,
    /// The blocks with a multiplier side.
    pub multipliers: MultiplierBlocks,
    /// All four blocks.
    pub nest: Matrix,
    /// `c - B u_D` (length squared).
    pub gap: Vec<f64>,
    /// `D` of the active multipliers, unscaled, all contacts numbered through.
    weights: Vec<DiagonalBlock>,
    /// `C` of the active multipliers, unscaled.
    jumps: SparseRows,
    rows: Vec<CouplingRows>,
    form: Form,
    load: Vec<f64>,
}

impl SaddlePoint {
    /// Assembles all blocks, with every multiplier active. `load` are the nodal forces of this rank's unknowns, in the nodes'
    /// frames, zero where displacement is prescribed; what prescribed displacements add is put in here. **Collective**
    pub fn new(problem: &Discretisation, load: Vec<f64>, form: Form, session: &Session) -> Result<Self, SystemError> {
        let rows = CouplingRows::of_levels(&problem.scene.mesh, &problem.coupling, &problem.spaces);
        let neighbours = neighbours(problem, &rows, form);
        let elastic = Elastic::new(problem, load, form, &neighbours, session)?;
        Self::with(problem, rows, elastic.stiffness, elastic.load, form, session)
    }

    /// Assembles the blocks of contact around the stiffness of the bodies, which is kept. **Collective**
    pub fn around(problem: &Discretisation, elastic: &Elastic, form: Form, session: &Session) -> Result<Self, SystemError> {
        let rows = CouplingRows::of_levels(&problem.scene.mesh, &problem.coupling, &problem.spaces);
        let neighbours = neighbours(problem, &rows, form);
        let stiffness = elastic.with_places(problem, form, &neighbours, session)?;
        Self::with(problem, rows, stiffness, elastic.load.clone(), form, session)
    }

    fn with(
        problem: &Discretisation,
        rows: Vec<CouplingRows>,
        stiffness: Vec<Stiffness>,
        load: Vec<f64>,
        form: Form,
        session: &Session,
    ) -> Result<Self, SystemError> {
        let blocks = MultiplierBlocks::new(problem, &rows[rows.len() - 1], session)?;
        let finest = &stiffness[stiffness.len() - 1];
        let nest = Matrix::nest(session, [[finest.operator(), &blocks.transpose], [&blocks.coupling, &blocks.corner]])?;
        let gap = moved_gap(problem);
        let mut system =
            Self { stiffness, multipliers: blocks, nest, gap, weights: Vec::new(), jumps: Vec::new(), rows, form, load };
        system.activate(problem, &vec![true; problem.multiplier_count()])?;
        Ok(system)
    }

    /// Changes all blocks to another active set; on every level only those of changed multipliers. **Collective**
    pub fn activate(&mut self, problem: &Discretisation, active: &[bool]) -> Result<(), SystemError> {
        let next = weights(&problem.contacts, active);
        if self.form == Form::Augmented {
            self.augment(problem, &next)?;
        }
        let jumps = jump_matrix(problem.jumps(), active.len());
        let in_transpose = if self.form == Form::Augmented { next.as_slice() } else { &[] };
        self.multipliers.fill(problem, &self.rows[self.rows.len() - 1], active, in_transpose, &jumps)?;
        self.jumps = jumps;
        self.weights = next;
        self.nest.refresh()?;
        Ok(())
    }

    /// Adds `Bᵀ D B` of the weights that come, and takes off that of the weights that go.
    fn augment(&mut self, problem: &Discretisation, next: &[DiagonalBlock]) -> Result<(), SystemError> {
        let gone = self.weights.iter().filter(|block| !next.contains(block)).map(DiagonalBlock::negative);
        let come = next.iter().filter(|block| !self.weights.contains(block)).cloned();
        let change: Vec<DiagonalBlock> = gone.chain(come).collect();
        for ((matrix, rows), space) in self.stiffness.iter_mut().zip(&self.rows).zip(&problem.spaces) {
            let mut result = Ok(());
            rows.weighted_square(&change, |a, b, values| {
                if space.own.contains(&a) && result.is_ok() {
                    result = matrix.add_block(a, b, &values);
                }
            });
            result?;
            matrix.assemble()?;
        }
        Ok(())
    }

    /// The system with all rows of the stiffness stored, as factorisations of `K + Bᵀ D B` want it; `None` if they are.
    /// **Collective**
    pub fn stored_nest(&self, session: &Session) -> Result<Option<Matrix>, SystemError> {
        if self.multipliers.scale.is_empty() {
            // Of a nest whose other blocks are empty PETSc takes the whole nest for `K`.
            return Ok(Some(self.nest.convert_aij()?));
        }
        let Some(stiffness) = self.finest_stiffness().expanded(session)? else { return Ok(None) };
        let blocks = &self.multipliers;
        Ok(Some(Matrix::nest(session, [[&stiffness, &blocks.transpose], [&blocks.coupling, &blocks.corner]])?))
    }

    /// `K + Bᵀ D B` on the finest level.
    pub fn finest_stiffness(&self) -> &Stiffness {
        &self.stiffness[self.stiffness.len() - 1]
    }

    /// `C λ` (length squared).
    pub fn jump_term(&self, lambda: &[f64]) -> Vec<f64> {
        self.jumps.iter().map(|row| row.iter().map(|(&j, value)| value * lambda[j]).sum()).collect()
    }

    /// Rows of `B` on the finest level, unscaled, whatever the active set.
    pub fn finest_rows(&self) -> &CouplingRows {
        &self.rows[self.rows.len() - 1]
    }

    /// Right-hand side: `f + Bᵀ D c`, and `ĉ` on active multipliers. **Collective**
    pub fn right_hand_side(&self, active: &[bool], space: &Space) -> Result<Vector, SystemError> {
        let (_, mut b) = self.nest.create_vectors()?;
        let mut values = b.values_mut();
        let unknowns = space.local_unknowns();
        values[..unknowns].copy_from_slice(&self.load);
        if self.form == Form::Augmented {
            self.add_weighted(&self.gap, 1.0, &mut values[..unknowns], space);
        }
        for (at, &i) in self.multipliers.own.iter().enumerate() {
            values[unknowns + at] = if active[i] { self.multipliers.scale[i] * self.gap[i] } else { 0.0 };
        }
        drop(values);
        Ok(b)
    }

    /// Relative residual of the plain system, from the residual `r` of this one: `r_u - Bᵀ D r_λ`. **Collective**
    pub fn plain_residual(&self, r: &Vector, b: &Vector, space: &Space, session: &Session) -> Result<f64, SystemError> {
        let values = r.values();
        let unknowns = space.local_unknowns();
        let mut upper = values[..unknowns].to_vec();
        if self.form == Form::Augmented {
            let lower = self.multipliers.collect(&values[unknowns..], session);
            let unscaled: Vec<f64> = lower.iter().zip(&self.multipliers.scale).map(|(r, s)| r / s).collect();
            self.add_weighted(&unscaled, -1.0, &mut upper, space);
        }
        let mut square = [upper.iter().chain(&values[unknowns..]).map(|v| v * v).sum::<f64>()];
        session.sum(&mut square);
        let norm = b.norm()?;
        Ok(if norm > 0.0 { square[0].sqrt() / norm } else { 0.0 })
    }

    /// Adds `factor Bᵀ D r` to this rank's displacement entries.
    fn add_weighted(&self, r: &[f64], factor: f64, sums: &mut [f64], space: &Space) {
        for block in &self.weights {
            for (p, &i) in block.rows.iter().enumerate() {
                let weighted: f64 = block.rows.iter().enumerate().map(|(q, &j)| block.values[p][q] * r[j]).sum();
                for &(node, value) in self.finest_rows().row(i).iter().filter(|(node, _)| space.own.contains(node)) {
                    let at = 2 * (node - space.own.start);
                    sums[at] += factor * weighted * value.x;
                    sums[at + 1] += factor * weighted * value.y;
                }
            }
        }
    }
}

/// Nodes that contact couples, on every level.
fn neighbours(problem: &Discretisation, rows: &[CouplingRows], form: Form) -> Vec<ContactNeighbours> {
    let groups = match form {
        Form::Augmented => weights(&problem.contacts, &vec![true; problem.multiplier_count()]),
        Form::Plain => Vec::new(),
    };
    let groups: Vec<Vec<usize>> = groups.into_iter().map(|block| block.rows).collect();
    rows.iter().map(|rows| rows.neighbours(&groups)).collect()
}

/// `c - B u_D`.
fn moved_gap(problem: &Discretisation) -> Vec<f64> {
    let (mesh, space) = (&problem.scene.mesh, problem.finest());
    let prescribed = |node: crate::mesh::EdgeNode| space.prescribed(node.number(mesh, &space.numbering));
    let moved = |row: &Vec<super::Coupled>| row.iter().map(|coupled| coupled.value.dot(&prescribed(coupled.node))).sum::<f64>();
    problem.coupling.gap.iter().zip(&problem.coupling.rows).map(|(c, row)| c - moved(row)).collect()
}
