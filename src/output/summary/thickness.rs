//! Results of a thickness of one as those of the whole thickness.

use super::Summary;

impl Summary {
    /// Multiplies everything that is a force, a moment or an energy by a thickness.
    pub fn times_thickness(&mut self, thickness: f64) {
        let scale = |value: &mut Option<f64>| *value = value.map(|value| thickness * value);
        let scale_both = |value: &mut Option<[f64; 2]>| *value = value.map(|value| value.map(|one| thickness * one));
        for contact in self.contact.values_mut() {
            let forces = [&mut contact.force, &mut contact.unresolved_force, &mut contact.missing_force, &mut contact.moment];
            forces.into_iter().for_each(scale);
            scale_both(&mut contact.resultant);
        }
        for support in self.support.values_mut() {
            scale(&mut support.moment);
            scale_both(&mut support.reaction);
        }
        for rigid in self.rigid.values_mut() {
            scale(&mut rigid.moment);
            scale_both(&mut rigid.force);
        }
        let energy = &mut self.energy;
        energy.strain.values_mut().chain(energy.parts.values_mut()).for_each(scale);
        [&mut energy.total, &mut energy.stationary, &mut energy.springs, &mut energy.external_work].into_iter().for_each(scale);
    }
}
