//! `thickness`: the forces of a case are those of the whole thickness, while everything is solved for a thickness of one.

use super::exact::Exact;
use super::rigid::{Plate, Tool};
use super::section::Section;
use super::values;
use crate::body::{PointLoad, RigidSet};

/// `thickness`, before all tables; 1 if the case has none.
pub fn read_thickness(root: &Section) -> f64 {
    root.optional("thickness", values::number).unwrap_or(1.0)
}

/// Makes everything in a case that is a force, a moment or an energy that of a thickness of one: loads at points, boundaries that
/// stay rigid, rigid tools, expected values.
pub fn per_thickness(thickness: f64, point_loads: &mut [PointLoad], plates: &mut [Plate], tools: &mut [Tool], exact: &mut Exact) {
    if thickness == 1.0 {
        return;
    }
    let share = 1.0 / thickness;
    for load in point_loads {
        load.force = load.force.each_ref().map(|component| component.times(share));
    }
    let scale = |set: &mut RigidSet| set.applied = set.applied.map(|component| share * component);
    plates.iter_mut().for_each(|plate| scale(&mut plate.motion));
    tools.iter_mut().for_each(|tool| scale(&mut tool.motion));
    let forces = exact.contacts.iter_mut().filter_map(|contact| contact.force.as_mut());
    forces.chain(exact.energy.as_mut()).for_each(|expected| expected.value *= share);
}
