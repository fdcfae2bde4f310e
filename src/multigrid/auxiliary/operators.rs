//! The stiffness on auxiliary levels.

use super::level::Coarsening;
use super::product::GalerkinProduct;
use crate::discretisation::SystemError;
use crate::multigrid::stiffness::Stiffness;
use crate::petsc::Session;
use std::rc::Rc;

/// Galerkin products `Pᵀ A P`, each of the next finer one, the finest of the coarsest stiffness that is assembled. So contact
/// comes down with the bodies.
#[derive(Default)]
pub struct GalerkinLevels {
    /// Coarsest first, each with how it is made of the next finer one.
    levels: Vec<(GalerkinProduct, Stiffness)>,
}

impl GalerkinLevels {
    /// Below `finest`; the steps lead from the coarsest level up to it. **Collective**
    pub fn new(finest: &Stiffness, steps: &[Rc<Coarsening>], session: &Session) -> Result<Self, SystemError> {
        let mut levels: Vec<(GalerkinProduct, Stiffness)> = Vec::new();
        for step in steps.iter().rev() {
            let above = levels.last().map_or(finest, |(_, stiffness)| stiffness).lattice();
            let (mut product, lattice) = GalerkinProduct::new(above, step, session)?;
            product.refresh(above, 0..above.node_count() as u32, &lattice);
            levels.push((product, Stiffness::of_rows(lattice, session)?));
        }
        levels.reverse();
        Ok(Self { levels })
    }

    /// The same of a stiffness with other values. **Collective**
    pub fn refresh(&mut self, finest: &Stiffness) -> Result<(), SystemError> {
        let mut above = (finest.lattice().clone(), finest.lattice().changed_rows());
        for (product, stiffness) in self.levels.iter_mut().rev() {
            let (lattice, changed) = above;
            let made = product.refresh(&lattice, changed.into_iter(), stiffness.lattice());
            above = (stiffness.lattice().clone(), made.clone());
            stiffness.renew(made)?;
        }
        Ok(())
    }

    /// Coarsest first.
    pub fn iter(&self) -> impl Iterator<Item = &Stiffness> {
        self.levels.iter().map(|(_, stiffness)| stiffness)
    }
}
