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

mod augmentation;
mod border_blocks;
mod contact_places;
mod coupling_rows;
mod elimination;
mod load;
mod multiplier_blocks;

pub use border_blocks::{BorderBlocks, BorderUnknown};
pub use elimination::BorderValues;
pub use multiplier_blocks::SchurPattern;

use crate::contact::DiagonalBlock;
use crate::discretisation::{Coupled, Discretisation, Form, Space, SystemError};
use crate::multigrid::{ContactNeighbours, Elastic, Stiffness};
use crate::petsc::{Matrix, Session, Vector};
use crate::system::rigid_border::RigidBorder;
use augmentation::Augmentation;
use contact_places::ContactPlaces;
use coupling_rows::CouplingRows;
use elimination::BorderedProduct;
use load::KeptLoad;
use multiplier_blocks::MultiplierBlocks;
use std::cell::RefCell;
use std::rc::Rc;

/// The blocks and their levels for one active set at a time.
pub struct SaddlePoint {
    /// All ranks.
    pub session: Session,
    /// `K + Bᵀ D B` on every level, coarsest first; only the finest in the plain form.
    pub stiffness: Vec<Stiffness>,
    /// The blocks with a multiplier side.
    pub multipliers: MultiplierBlocks,
    /// All four blocks.
    pub nest: Matrix,
    /// What they, and the unknown rigid motions that are eliminated, do to a vector, with as few messages as can be.
    pub product: Matrix,
    /// Unknown rigid motions, if there are any.
    pub border: Option<Rc<RefCell<BorderBlocks>>>,
    /// `c - B u_D` (length squared), what moves rigidly at rest.
    gap: Vec<f64>,
    /// The set that all blocks are those of.
    active: Vec<bool>,
    /// `D` of the active multipliers, unscaled; nothing in the plain form.
    augmentation: Augmentation,
    rows: Vec<CouplingRows>,
    /// Where `Bᵀ D B` lies in the stiffness of each level; nothing in the plain form.
    places: Vec<ContactPlaces>,
    form: Form,
    load: KeptLoad,
}

impl SaddlePoint {
    /// Assembles all blocks, with every multiplier active. `load` are the nodal forces of this rank's unknowns, in the nodes'
    /// frames, zero where displacement is prescribed; what prescribed displacements add is put in here. **Collective**
    pub fn new(problem: &Discretisation, load: Vec<f64>, form: Form) -> Result<Self, SystemError> {
        let (rows, neighbours) = rows_and_neighbours(problem, form);
        let elastic = Elastic::new(problem, load, form, &neighbours)?;
        Self::with(problem, rows, elastic.stiffness, elastic.load, form)
    }

    /// Assembles the blocks of contact around the stiffness of the bodies, which is kept. **Collective**
    pub fn around(problem: &Discretisation, elastic: &Elastic, form: Form) -> Result<Self, SystemError> {
        let (rows, neighbours) = rows_and_neighbours(problem, form);
        let stiffness = elastic.with_places(problem, form, &neighbours)?;
        Self::with(problem, rows, stiffness, elastic.load.clone(), form)
    }

    fn with(
        problem: &Discretisation,
        rows: Vec<CouplingRows>,
        stiffness: Vec<Stiffness>,
        load: Vec<f64>,
        form: Form,
    ) -> Result<Self, SystemError> {
        let all: Vec<usize> = (0..problem.multiplier_count()).collect();
        let active = vec![true; all.len()];
        let mut augmentation = Augmentation::new(&problem.contacts);
        let groups = if form == Form::Augmented { augmentation.groups_of(all.iter().copied()) } else { Default::default() };
        let change = augmentation.change(&groups, &problem.contacts, &active);
        let multipliers = MultiplierBlocks::new(problem, &rows[rows.len() - 1], &augmentation, form)?;
        let finest = &stiffness[stiffness.len() - 1];
        let blocks = [[finest.operator(), &multipliers.transpose], [&multipliers.coupling, &multipliers.corner]];
        let (nest, product) = (Matrix::nest(&problem.session, blocks)?, Matrix::nest_product(&problem.session, blocks)?);
        let (gap, load) = (moved_gap(problem), KeptLoad::new(load));
        let places = if form == Form::Augmented {
            let levels = rows.iter().zip(&problem.spaces).zip(&stiffness);
            levels.map(|((rows, space), matrix)| ContactPlaces::new(rows, &augmentation.members, &space.own, matrix)).collect()
        } else {
            Vec::new()
        };
        let mut system = Self {
            session: problem.session.clone(),
            stiffness,
            multipliers,
            nest,
            product,
            border: None,
            gap,
            active,
            augmentation,
            rows,
            places,
            form,
            load,
        };
        system.augment(&change)?;
        system.fill(problem, &all)?;
        Ok(system)
    }

    /// The set that the blocks are those of.
    pub fn active(&self) -> &[bool] {
        &self.active
    }

    /// Goes to another active set. The work is that of the multipliers that change, on every level. **Collective**
    pub fn set_active(&mut self, problem: &Discretisation, active: &[bool]) -> Result<(), SystemError> {
        let changed: Vec<usize> = (0..active.len()).filter(|&i| active[i] != self.active[i]).collect();
        if changed.is_empty() {
            return Ok(());
        }
        self.active.copy_from_slice(active);
        if self.form == Form::Augmented {
            let groups = self.augmentation.groups_of(changed.iter().copied());
            let change = self.augmentation.change(&groups, &problem.contacts, active);
            self.augment(&change)?;
        }
        self.fill(problem, &changed)?;
        self.set_border(problem);
        Ok(())
    }

    /// Takes unknown rigid motions in. **Collective**
    pub fn with_border(mut self, problem: &Discretisation, border: Rc<RigidBorder>) -> Result<Self, SystemError> {
        let border = Rc::new(RefCell::new(BorderBlocks::new(problem, border, self.form)));
        let rows = self.product.local_size().0;
        let product = BorderedProduct { blocks: self.product.share()?, border: border.clone() };
        (self.product, self.border) = (Matrix::operator(&problem.session, rows, rows, Box::new(product))?, Some(border));
        self.set_border(problem);
        Ok(self)
    }

    fn set_border(&self, problem: &Discretisation) {
        if let Some(border) = &self.border {
            border.borrow_mut().set(problem, self.finest_rows(), &self.multipliers, &self.active);
        }
    }

    /// How far what moves rigidly has moved, beside these unknowns, for what [`Self::right_hand_side_of`] takes, with the gaps of the
    /// scene or others; where nothing tells, as `before`. **Collective**
    pub fn motion(&self, x: &Vector, given: &BorderValues, gap: Option<&[f64]>, before: &[f64]) -> Vec<f64> {
        let gap = gap.unwrap_or(&self.gap);
        self.border.as_ref().map_or_else(Vec::new, |border| border.borrow().motion(&x.values(), given, gap, before))
    }

    /// Adds `Bᵀ D B` of a change of the weights to every level. **Collective**
    fn augment(&mut self, change: &[(usize, DiagonalBlock)]) -> Result<(), SystemError> {
        if change.is_empty() {
            return Ok(());
        }
        for ((matrix, rows), places) in self.stiffness.iter_mut().zip(&self.rows).zip(&self.places) {
            places.add(rows, change, matrix)?;
        }
        Ok(())
    }

    /// Brings the blocks with a multiplier side to the present set. **Collective**
    fn fill(&mut self, problem: &Discretisation, changed: &[usize]) -> Result<(), SystemError> {
        self.multipliers.set(problem, &self.rows[self.rows.len() - 1], &self.active, &self.augmentation, changed)?;
        // So preconditioners are built again.
        Ok(self.nest.assemble()?)
    }

    /// The system with all rows of the stiffness stored, as factorisations of `K + Bᵀ D B` want it; `None` if they are.
    /// **Collective**
    pub fn stored_nest(&self) -> Result<Option<Matrix>, SystemError> {
        let blocks = &self.multipliers;
        let expanded = self.finest_stiffness().expanded(&self.session)?;
        if blocks.scale.is_empty() {
            // Of a nest whose other blocks are empty PETSc takes the whole nest for `K`.
            return Ok(Some(expanded.map_or_else(|| self.finest_stiffness().operator().convert_aij(), Ok)?));
        }
        let nest = |stiffness| Matrix::nest(&self.session, [[stiffness, &blocks.transpose], [&blocks.coupling, &blocks.corner]]);
        Ok(expanded.as_ref().map(nest).transpose()?)
    }

    /// `K + Bᵀ D B` on the finest level.
    pub fn finest_stiffness(&self) -> &Stiffness {
        &self.stiffness[self.stiffness.len() - 1]
    }

    /// Rows of `B` on the finest level, unscaled, whatever the active set.
    fn finest_rows(&self) -> &CouplingRows {
        &self.rows[self.rows.len() - 1]
    }

    /// `(B (u + R q) - c)_i` of all multipliers, for this rank's displacements and the motion beside them (length squared).
    /// **Collective**
    pub fn penetration(&self, u: &[f64], motion: &[f64], space: &Space) -> Vec<f64> {
        let mut all = vec![0.0; self.gap.len()];
        for (i, sum) in all.iter_mut().enumerate() {
            let entries = self.finest_rows().own_row(i, &space.own);
            entries.for_each(|(at, entry)| *sum += entry.x * u[at] + entry.y * u[at + 1]);
        }
        self.session.sum(&mut all);
        all.iter_mut().zip(&self.gap).for_each(|(sum, gap)| *sum -= gap);
        if let Some(border) = &self.border {
            all.iter_mut().zip(border.borrow().border.gaps_of(motion)).for_each(|(sum, moved)| *sum += moved);
        }
        all
    }

    /// Loads and means of unknown rigid motions, as the scene asks for them.
    pub fn given(&self) -> BorderValues {
        self.border.as_ref().map_or_else(Default::default, |border| border.borrow().given())
    }

    /// Right-hand side: `f + Bᵀ D c`, and `ĉ` on active multipliers, without what rigid motions do. **Collective**
    pub fn right_hand_side(&self, space: &Space) -> Result<Vector, SystemError> {
        self.right_hand_side_of(|values| self.load.put(values), &self.gap, &self.given(), space)
    }

    /// The same for other nodal forces of this rank, which are put where zeros were, other gaps, and others of [`Self::given`].
    /// **Collective**
    pub fn right_hand_side_of(
        &self,
        load: impl FnOnce(&mut [f64]),
        gap: &[f64],
        given: &BorderValues,
        space: &Space,
    ) -> Result<Vector, SystemError> {
        let (_, mut b) = self.nest.create_vectors()?;
        b.set(0.0)?;
        let mut values = b.values_mut();
        let unknowns = space.local_unknowns();
        load(&mut values[..unknowns]);
        if self.form == Form::Augmented {
            self.add_weighted(gap, 1.0, &mut values[..unknowns], space);
        }
        for (at, &i) in self.multipliers.own.iter().enumerate() {
            values[unknowns + at] = if self.active[i] { self.multipliers.scale[i] * gap[i] } else { 0.0 };
        }
        if let Some(border) = &self.border {
            border.borrow().subtract_given(given, gap, &mut values);
        }
        drop(values);
        Ok(b)
    }

    /// Norm of the nodal forces of the load, and of those of pressures on all multipliers. **Collective**
    pub fn force_norms(&self, pressures: &[f64], space: &Space) -> Result<[f64; 2], SystemError> {
        let (_, mut forces) = self.nest.create_vectors()?;
        let unknowns = space.local_unknowns();
        forces.set(0.0)?;
        self.load.put(&mut forces.values_mut()[..unknowns]);
        let loads = forces.norm()?;
        forces.set(0.0)?;
        let mut values = forces.values_mut();
        for (i, pressure) in pressures.iter().enumerate().filter(|(_, pressure)| **pressure != 0.0) {
            self.finest_rows().add_row(i, *pressure, &space.own, &mut values);
        }
        drop(values);
        Ok([loads, forces.norm()?])
    }

    /// Relative residual of the plain system, from the residual `r` of this one, which becomes that: `r_u - Bᵀ D r_λ`.
    /// **Collective**
    pub fn plain_residual(&self, mut r: Vector, b: &Vector, space: &Space) -> Result<f64, SystemError> {
        if self.form == Form::Augmented {
            let mut values = r.values_mut();
            let (upper, lower) = values.split_at_mut(space.local_unknowns());
            let lower = self.multipliers.collect(lower);
            let unscaled: Vec<f64> = lower.iter().zip(&self.multipliers.scale).map(|(r, s)| r / s).collect();
            self.add_weighted(&unscaled, -1.0, upper, space);
        }
        let (residual, norm) = (r.norm()?, b.norm()?);
        Ok(if norm > 0.0 { residual / norm } else { 0.0 })
    }

    /// Adds `factor Bᵀ D r` to this rank's displacement entries.
    fn add_weighted(&self, r: &[f64], factor: f64, sums: &mut [f64], space: &Space) {
        for block in self.augmentation.iter() {
            for (p, i) in block.rows.clone().enumerate() {
                let weighted: f64 = block.rows.clone().enumerate().map(|(q, j)| block.values[p][q] * r[j]).sum();
                self.finest_rows().add_row(i, factor * weighted, &space.own, sums);
            }
        }
    }
}

/// Rows of `B` that this rank needs, and the nodes that contact couples to its own, on every level.
fn rows_and_neighbours(problem: &Discretisation, form: Form) -> (Vec<CouplingRows>, Vec<ContactNeighbours>) {
    let augmentation = Augmentation::new(&problem.contacts);
    let rows = CouplingRows::of_levels(problem, &augmentation.members, problem.session.rank());
    let groups = if form == Form::Augmented { augmentation.members.as_slice() } else { &[] };
    let neighbours = rows.iter().zip(&problem.spaces).map(|(rows, space)| rows.neighbours(groups, &space.own)).collect();
    (rows, neighbours)
}

/// `c - B u_D`. **Collective**
fn moved_gap(problem: &Discretisation) -> Vec<f64> {
    let (mesh, space, coupling) = (&problem.scene.mesh, problem.finest(), &problem.coupling);
    let prescribed = |coupled: &Coupled| coupled.value.dot(&space.prescribed(coupled.node.number(mesh, &space.numbering)));
    let mut moved = vec![0.0; coupling.gap.len()];
    coupling.own(0..moved.len(), problem.session.rank()).for_each(|i| moved[i] = coupling.rows[i].iter().map(prescribed).sum());
    coupling.gap.iter().zip(problem.session.sum(moved)).map(|(c, moved)| c - moved).collect()
}
