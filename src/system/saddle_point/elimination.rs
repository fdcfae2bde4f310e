//! Products of a system from which rigid motions are eliminated, its right-hand side, and the motions that belong to its unknowns.

use super::border_blocks::{BorderBlocks, BorderColumn, BorderUnknown};
use crate::discretisation::Form;
use crate::multigrid::{Border, Sparse, add_multiple, dot};
use crate::petsc::{Matrix, Operator, Result, Vector};
use crate::system::rigid_border::RigidComponent;
use nalgebra::{DMatrix, DVector};
use std::cell::RefCell;
use std::rc::Rc;

/// Loads below this share of the largest are rounding.
const UNLOADED: f64 = 1e-9;

/// `p`, or a right-hand side beside it, of all components: motions with their balances, and multipliers of means with the means.
#[derive(Clone, Debug, Default)]
pub struct BorderValues {
    /// `q`, or forces that balance.
    pub motion: Vec<f64>,
    /// `μ`, or means; zero for rigid sets.
    pub mean: Vec<f64>,
}

impl BorderValues {
    fn zeros(count: usize) -> Self {
        Self { motion: vec![0.0; count], mean: vec![0.0; count] }
    }

    /// The value of an unknown, or of its row.
    pub fn of(&self, unknown: BorderUnknown) -> f64 {
        match unknown {
            BorderUnknown::Motion(j) => self.motion[j],
            BorderUnknown::Mean(j) => self.mean[j],
        }
    }
}

impl BorderBlocks {
    fn arms(&self) -> DVector<f64> {
        let rigid = &self.border.components[..self.border.stiffness.nrows()];
        DVector::from_iterator(rigid.len(), rigid.iter().map(|component| component.arm))
    }

    /// `Wᵀ x`. **Collective**
    pub fn sums(&self, x: &[f64]) -> BorderValues {
        let (u, lambda) = x.split_at(self.unknowns);
        let row = |(column, component): (&BorderColumn, &RigidComponent)| {
            let mean = component.mean.as_ref();
            [dot(&column.forces, u) + dot(&column.balance, lambda), mean.map_or(0.0, |mean| dot(mean, u))]
        };
        let mut sums: Vec<[f64; 2]> = self.columns.iter().zip(&self.border.components).map(row).collect();
        self.session.sum(sums.as_flattened_mut());
        let (motion, mean) = sums.into_iter().map(<(f64, f64)>::from).unzip();
        BorderValues { motion, mean }
    }

    /// What multipliers of this rank do to rows of unknowns. **Collective**
    pub fn balances(&self, unknowns: &[BorderUnknown], lambda: &[f64]) -> Vec<f64> {
        let row = |unknown: &BorderUnknown| match unknown {
            BorderUnknown::Motion(j) => dot(&self.columns[*j].balance, lambda),
            BorderUnknown::Mean(_) => 0.0,
        };
        self.session.sum(unknowns.iter().map(row).collect())
    }

    /// Unknowns beside the displacements, as the cycle takes them.
    pub fn for_cycle(&self, unknowns: &[BorderUnknown]) -> Border {
        let column = |unknown: &BorderUnknown| match unknown {
            BorderUnknown::Motion(j) => self.columns[*j].forces.clone(),
            BorderUnknown::Mean(j) => self.border.components[*j].mean.clone().unwrap_or_default(),
        };
        Border {
            columns: unknowns.iter().map(column).collect(),
            corner: DMatrix::from_fn(unknowns.len(), unknowns.len(), |i, j| self.entry(unknowns[i], unknowns[j])),
            scales: unknowns.iter().map(|&unknown| self.scale(unknown)).collect(),
        }
    }

    /// `E⁻¹ r`: zero in what rigid sets cannot tell.
    fn pivot(&self, r: &BorderValues) -> BorderValues {
        let mut p = BorderValues::zeros(r.motion.len());
        let rigid = self.border.stiffness.nrows();
        p.motion[rigid..].copy_from_slice(&r.mean[rigid..]);
        let product = |j: usize, q: &[f64]| self.stiffness[j].iter().map(|(&k, value)| value * q[k]).sum::<f64>();
        let arms = self.arms();
        let left = DVector::from_fn(rigid, |j, _| (r.motion[j] - product(j, &p.motion)) / arms[j]);
        let found = (&self.inverse * left).component_div(&arms);
        p.motion[..rigid].copy_from_slice(found.as_slice());
        for j in rigid..r.motion.len() {
            p.mean[j] = r.motion[j] - product(j, &p.motion);
        }
        p
    }

    /// `V` of an unknown, added to a vector; in the plain form, or where `whole`, with its gaps.
    pub fn add_column(&self, unknown: BorderUnknown, factor: f64, whole: bool, y: &mut [f64]) {
        let (upper, lower) = y.split_at_mut(self.unknowns);
        match unknown {
            BorderUnknown::Mean(j) => {
                add_multiple(self.border.components[j].mean.as_ref().unwrap_or(&Sparse::new()), factor, upper);
            }
            BorderUnknown::Motion(j) => {
                let (of, column) = (&self.border.components[j], &self.columns[j]);
                add_multiple(if self.form == Form::Plain { &of.forces } else { &column.forces }, factor, upper);
                if whole {
                    add_multiple(&column.gaps, factor, lower);
                }
            }
        }
    }

    /// `y - V p`.
    fn subtract_moved(&self, p: &BorderValues, y: &mut [f64]) {
        for j in 0..p.motion.len() {
            self.add_column(BorderUnknown::Motion(j), -p.motion[j], true, y);
            if p.mean[j] != 0.0 {
                self.add_column(BorderUnknown::Mean(j), -p.mean[j], true, y);
            }
        }
    }

    /// `y - V E⁻¹ Wᵀ x`. **Collective**
    fn subtract_eliminated(&self, x: &[f64], y: &mut [f64]) {
        self.subtract_moved(&self.pivot(&self.sums(x)), y);
    }

    /// `h` from what is given, loads and means, and gaps of all multipliers.
    fn right_hand_side(&self, given: &BorderValues, gap: &[f64]) -> BorderValues {
        let mut h = given.clone();
        for (row, weighted) in self.weighted_gaps().iter().enumerate() {
            weighted.iter().for_each(|&(j, weight)| h.motion[j] += weight * gap[row]);
        }
        h
    }

    /// Loads and means of the scene.
    pub fn given(&self) -> BorderValues {
        let components = self.border.components.iter();
        let (motion, mean) = components.map(|component| (component.load, component.asked)).unzip();
        BorderValues { motion, mean }
    }

    /// `b - V E⁻¹ h`.
    pub fn subtract_given(&self, given: &BorderValues, gap: &[f64], b: &mut [f64]) {
        self.subtract_moved(&self.pivot(&self.right_hand_side(given, gap)), b);
    }

    /// `q = E⁻¹ (h - Wᵀ x)`, where rigid sets cannot tell as it was `before`. **Collective**
    pub fn motion(&self, x: &[f64], given: &BorderValues, gap: &[f64], before: &[f64]) -> Vec<f64> {
        let (mut left, sums) = (self.right_hand_side(given, gap), self.sums(x));
        left.motion.iter_mut().zip(sums.motion).for_each(|(left, sum)| *left -= sum);
        left.mean.iter_mut().zip(sums.mean).for_each(|(left, mean)| *left -= mean);
        let (mut found, arms) = (self.pivot(&left).motion, self.arms());
        let kept = &self.untold * DVector::from_fn(arms.len(), |j, _| before[j] * arms[j]);
        found.iter_mut().zip(kept.component_div(&arms).iter()).for_each(|(q, kept)| *q += kept);
        found
    }

    /// Whether loads drive a rigid set where nothing resists.
    pub fn is_driven_freely(&self) -> bool {
        let arms = self.arms();
        let loads = DVector::from_fn(arms.len(), |j, _| self.border.components[j].load / arms[j]);
        !arms.is_empty() && (&self.untold * &loads).amax() > UNLOADED * loads.amax()
    }
}

/// A product of blocks, and the motions eliminated from it.
pub struct BorderedProduct {
    /// That of the blocks.
    pub blocks: Matrix,
    /// What is eliminated.
    pub border: Rc<RefCell<BorderBlocks>>,
}

impl Operator for BorderedProduct {
    fn multiply(&self, x: &Vector, y: &mut Vector) -> Result<()> {
        self.blocks.multiply(x, y)?;
        self.border.borrow().subtract_eliminated(&x.values(), &mut y.values_mut());
        Ok(())
    }
}
