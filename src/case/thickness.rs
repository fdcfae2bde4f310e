//! `thickness`: the forces of a case are those of the whole thickness, while everything is solved for a thickness of one.

use super::exact::Exact;
use super::rigid::{Plate, Tool};
use super::section::Section;
use super::values;
use crate::body::{PointLoad, RigidSet};

/// `thickness`, before all tables; 1 if the case has none.
pub fn read_thickness(root: &Section) -> f64 {
    root.optional("thickness", values::positive).unwrap_or(1.0)
}

/// Everything in a case that is a force, a moment or an energy.
pub struct Forces<'a> {
    /// Loads at points.
    pub point_loads: &'a mut [PointLoad],
    /// Boundaries that stay rigid.
    pub plates: &'a mut [Plate],
    /// Rigid tools.
    pub tools: &'a mut [Tool],
    /// Expected values.
    pub exact: &'a mut Exact,
}

impl Forces<'_> {
    /// Makes them those of a thickness of one.
    pub fn per_thickness(self, thickness: f64) {
        if thickness == 1.0 {
            return;
        }
        let share = 1.0 / thickness;
        for load in self.point_loads {
            load.force = load.force.each_ref().map(|component| component.times(share));
        }
        let scale = |set: &mut RigidSet| set.applied = set.applied.map(|component| share * component);
        self.plates.iter_mut().for_each(|plate| scale(&mut plate.motion));
        self.tools.iter_mut().for_each(|tool| scale(&mut tool.motion));
        let forces = self.exact.contacts.iter_mut().filter_map(|contact| contact.force.as_mut());
        forces.chain(self.exact.energy.as_mut()).for_each(|expected| expected.value *= share);
    }
}
