//! The stiffness on auxiliary levels.

use super::level::Coarsening;
use super::product::GalerkinProduct;
use crate::multigrid::stiffness::LatticeOperator;
use crate::petsc::Session;
use std::rc::Rc;

/// Galerkin products `Pᵀ A P`, each of the next finer one, the finest of the coarsest stiffness that is assembled. So contact
/// comes down with the bodies.
pub struct GalerkinLevels {
    /// Coarsest first, each with how it is made of the next finer one.
    levels: Vec<(GalerkinProduct, Rc<LatticeOperator>)>,
}

impl GalerkinLevels {
    /// Below `finest`; the steps lead from the coarsest level up to it. **Collective**
    pub fn new(finest: &LatticeOperator, steps: &[Rc<Coarsening>], session: &Session) -> Self {
        let mut levels: Vec<(GalerkinProduct, Rc<LatticeOperator>)> = Vec::new();
        for step in steps.iter().rev() {
            let above = levels.last().map_or(finest, |(_, rows)| rows);
            let (mut product, rows) = GalerkinProduct::new(above, step, session);
            product.refresh(above, 0..above.node_count() as u32, &rows);
            levels.push((product, Rc::new(rows)));
        }
        levels.reverse();
        Self { levels }
    }

    /// The same of a stiffness with other values. **Collective**
    pub fn refresh(&mut self, finest: &LatticeOperator) {
        let (mut above, mut changed) = (finest, finest.changed_rows());
        for (product, rows) in self.levels.iter_mut().rev() {
            changed = product.refresh(above, changed.into_iter(), rows);
            rows.note_changed(changed.iter().copied());
            above = rows;
        }
    }

    /// Coarsest first.
    pub fn iter(&self) -> impl Iterator<Item = &Rc<LatticeOperator>> {
        self.levels.iter().map(|(_, rows)| rows)
    }
}
