//! Unknown rigid motions in a system: eliminated, exactly and for nothing, from every product.
//!
//! To the blocks `A x = b` of displacements and multipliers come the motions `q` and the multipliers `μ` of held means
//! ([`RigidBorder`]), here `p = (q, μ)`. Augmented by `(B R)ᵀ D` times the row of the gaps, as that of the displacements is by
//! `Bᵀ D`, they read
//!
//! ```text
//! [ A   V ] [x]   [b]        V = [ K R + Bᵀ D B R   M ]       E = [ Rᵀ K R + (B R)ᵀ D B R   1 ]
//! [ Wᵀ  E ] [p] = [h]            [ B R              0 ]           [ 1                       0 ]
//! ```
//! with `W = V` but for `(I - C D) B R` beside the multipliers, and in the plain form `K R` in the place of `K R + Bᵀ D B R` in `V`
//! alone. `E` is regular where contact or springs of a mesh resist: of means the last row tells `q` and the one before `μ`, of
//! rigid sets there is a small matrix left. So `(A - V E⁻¹ Wᵀ) x = b - V E⁻¹ h` is the system of the unknowns `x` alone, at the
//! price of one sum over ranks for each product, however many motions there are. A mean that no active multiplier knows of has its
//! columns, too: loads may drive it.

use super::augmentation::Augmentation;
use super::coupling_rows::CouplingRows;
use super::multiplier_blocks::MultiplierBlocks;
use crate::discretisation::{Discretisation, Form, Space};
use crate::multigrid::Sparse;
use crate::petsc::Session;
use crate::system::rigid_border::{RigidBorder, RigidComponent};
use nalgebra::{DMatrix, SymmetricEigen};
use std::collections::BTreeMap;
use std::rc::Rc;

/// Eigenvalues of the scaled matrix of rigid sets below this share of the largest belong to motions that nothing resists.
const NOTHING: f64 = 1e-13;

/// `V`, `W` and `E` of one active set at a time.
pub struct BorderBlocks {
    /// What no set changes.
    pub border: Rc<RigidBorder>,
    pub(super) form: Form,
    weights: Augmentation,
    pub(super) session: Session,
    /// This rank's displacement unknowns.
    pub(super) unknowns: usize,
    /// Columns of each component.
    pub(super) columns: Vec<BorderColumn>,
    /// Rows of `Rᵀ K R + (B R)ᵀ D B R` of all components.
    pub(super) stiffness: Vec<BTreeMap<usize, f64>>,
    /// Scaled pseudo-inverse of those of rigid sets, and the projection on what it cannot tell.
    pub(super) inverse: DMatrix<f64>,
    pub(super) untold: DMatrix<f64>,
}

/// Columns of a component.
pub(super) struct BorderColumn {
    /// `K R + Bᵀ D B R` on this rank's unknowns.
    pub(super) forces: Sparse,
    /// `s B R` on this rank's multipliers.
    pub(super) gaps: Sparse,
    /// `s (I - C D) B R` on these.
    pub(super) balance: Sparse,
}

/// An unknown of the border.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BorderUnknown {
    /// The motion of a component.
    Motion(usize),
    /// The multiplier of its mean.
    Mean(usize),
}

impl BorderBlocks {
    /// Blocks for no set yet.
    pub fn new(problem: &Discretisation, border: Rc<RigidBorder>, form: Form) -> Self {
        let (weights, unknowns) = (Augmentation::new(&problem.contacts), problem.finest().local_unknowns());
        let none = DMatrix::zeros(0, 0);
        Self {
            border,
            form,
            weights,
            session: problem.session.clone(),
            unknowns,
            columns: Vec::new(),
            stiffness: Vec::new(),
            inverse: none.clone(),
            untold: none,
        }
    }

    /// Goes over to an active set; the work is that of the gaps. `rows` are those of `B` on the finest level.
    pub fn set(&mut self, problem: &Discretisation, rows: &CouplingRows, multipliers: &MultiplierBlocks, active: &[bool]) {
        let all = self.weights.groups_of(0..active.len());
        self.weights.change(&all, &problem.contacts, active);
        let (weighted, rigid) = (self.weighted_gaps(), self.border.stiffness.nrows());
        self.stiffness = (0..self.border.components.len()).map(|_| BTreeMap::new()).collect();
        for (i, j) in (0..rigid).flat_map(|i| (0..rigid).map(move |j| (i, j))) {
            self.stiffness[i].insert(j, self.border.stiffness[(i, j)]);
        }
        for (row, weighted) in weighted.iter().enumerate().filter(|(row, _)| active[*row]) {
            for &(a, gap) in &self.border.gaps[row] {
                weighted.iter().for_each(|&(b, other)| *self.stiffness[a].entry(b).or_default() += gap * other);
            }
        }
        let column = |component: &RigidComponent| BorderColumn {
            forces: component.forces.clone(),
            gaps: Sparse::new(),
            balance: Sparse::new(),
        };
        self.columns = self.border.components.iter().map(column).collect();
        self.fill(rows, multipliers, active, &weighted, problem.finest());
        self.invert();
    }

    /// `D B R` by multipliers.
    pub(super) fn weighted_gaps(&self) -> Vec<Vec<(usize, f64)>> {
        let mut all = vec![Vec::new(); self.border.gaps.len()];
        for block in self.weights.iter() {
            for (p, i) in block.rows.clone().enumerate() {
                let mut sums = BTreeMap::<usize, f64>::new();
                for (q, k) in block.rows.clone().enumerate() {
                    self.border.gaps[k].iter().for_each(|&(j, gap)| *sums.entry(j).or_default() += block.values[p][q] * gap);
                }
                all[i] = sums.into_iter().collect();
            }
        }
        all
    }

    /// Adds what contact has in the columns.
    fn fill(
        &mut self,
        rows: &CouplingRows,
        multipliers: &MultiplierBlocks,
        active: &[bool],
        weighted: &[Vec<(usize, f64)>],
        space: &Space,
    ) {
        for (i, weighted) in weighted.iter().enumerate().filter(|(_, weighted)| !weighted.is_empty()) {
            for (at, value) in rows.own_row(i, &space.own) {
                let at = at as u32;
                for &(j, weight) in weighted {
                    self.columns[j].forces.extend([(at, weight * value.x), (at + 1, weight * value.y)]);
                }
            }
        }
        self.columns.iter_mut().for_each(|column| add_up(&mut column.forces));
        for (at, &i) in multipliers.own.iter().enumerate().filter(|(_, i)| active[**i]) {
            let (at, scale) = (at as u32, multipliers.scale[i]);
            for &(j, gap) in &self.border.gaps[i] {
                self.columns[j].gaps.push((at, scale * gap));
                self.columns[j].balance.push((at, scale * gap));
            }
            for (&k, jump) in &multipliers.jumps[i] {
                weighted[k].iter().for_each(|&(j, gap)| self.columns[j].balance.push((at, -scale * jump * gap)));
            }
        }
    }

    /// Inverts what `E` has of rigid sets.
    fn invert(&mut self) {
        let count = self.border.stiffness.nrows();
        if count == 0 {
            return;
        }
        let arm = |j: usize| self.border.components[j].arm;
        let entry = |i: usize, j: usize| self.stiffness[i].get(&j).copied().unwrap_or_default() / (arm(i) * arm(j));
        let SymmetricEigen { eigenvectors, eigenvalues } = SymmetricEigen::new(DMatrix::from_fn(count, count, entry));
        let least = NOTHING * eigenvalues.amax();
        let with =
            |of: &dyn Fn(f64) -> f64| &eigenvectors * DMatrix::from_diagonal(&eigenvalues.map(of)) * eigenvectors.transpose();
        self.inverse = with(&|value| if value > least { 1.0 / value } else { 0.0 });
        self.untold = with(&|value| if value > least { 0.0 } else { 1.0 });
    }

    /// Unknowns that a preconditioner of sets at rest has to be told of: the motions of rigid sets, and the held means that contact
    /// resists most, by a share of what the body itself does.
    pub fn resisted(&self, share: f64, most: usize) -> Vec<BorderUnknown> {
        let rigid = self.border.stiffness.nrows();
        let resisted = |j: usize| {
            let whole = self.border.young * self.border.components[j].arm.powi(2);
            self.stiffness[j].get(&j).copied().unwrap_or_default() / whole
        };
        let mut held: Vec<usize> = (rigid..self.columns.len()).filter(|&j| resisted(j) > share).collect();
        held.sort_by(|&a, &b| resisted(b).total_cmp(&resisted(a)));
        held.truncate(most);
        let held = held.into_iter().flat_map(|j| [BorderUnknown::Motion(j), BorderUnknown::Mean(j)]);
        (0..rigid).map(BorderUnknown::Motion).chain(held).collect()
    }

    /// An entry of `E`.
    pub fn entry(&self, row: BorderUnknown, column: BorderUnknown) -> f64 {
        match (row, column) {
            (BorderUnknown::Motion(i), BorderUnknown::Motion(j)) => self.stiffness[i].get(&j).copied().unwrap_or_default(),
            (BorderUnknown::Mean(_), BorderUnknown::Mean(_)) => 0.0,
            (BorderUnknown::Motion(i), BorderUnknown::Mean(j)) | (BorderUnknown::Mean(i), BorderUnknown::Motion(j)) => {
                if i == j {
                    1.0
                } else {
                    0.0
                }
            }
        }
    }

    /// What an unknown is measured by: entries of `E` over those of their row and their column are alike.
    pub fn scale(&self, unknown: BorderUnknown) -> f64 {
        let of = |j: usize| self.border.components[j].arm * self.border.young.sqrt();
        match unknown {
            BorderUnknown::Motion(j) => of(j),
            BorderUnknown::Mean(j) => 1.0 / of(j),
        }
    }
}

/// Sorts entries, and adds up those of one place.
fn add_up(entries: &mut Sparse) {
    entries.sort_by_key(|entry| entry.0);
    entries.dedup_by(|next, sum| {
        let same = next.0 == sum.0;
        if same {
            sum.1 += next.1;
        }
        same
    });
}
