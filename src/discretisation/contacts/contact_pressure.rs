//! The pressure on one contact boundary.

use crate::contact::{Zone, faded_end, oscillation, recovered_peak, zone_counts};
use crate::discretisation::contacts::contact::Contact;
use crate::discretisation::solution::Solution;
use crate::geometry::{Formula, Point};

/// Share of the sizes of its parts below which a force is none: solves that stop at the error of the mesh leave up to 1e-4, and what is
/// left of a moment alone would act at any distance.
const NO_FORCE: f64 = 1e-3;

/// λ of one contact, with the set that it was solved for.
#[derive(Clone, Copy)]
pub struct ContactPressure<'a> {
    /// The contact.
    pub contact: &'a Contact,
    /// Values of its multipliers (stress).
    pub values: &'a [f64],
    /// Which of them are active.
    pub active: &'a [bool],
}

impl<'a> ContactPressure<'a> {
    /// Out of the multipliers of all contacts.
    pub fn new(contact: &'a Contact, multipliers: &'a [f64], active: &'a [bool]) -> Self {
        Self { contact, values: &multipliers[contact.range()], active: &active[contact.range()] }
    }

    /// λ at the fraction `z` of segment `k`.
    pub fn value(&self, k: usize, z: f64) -> f64 {
        self.contact.multipliers.value(self.values, k, z)
    }

    /// The size of λ there: a bilateral contact may pull.
    pub fn size(&self, k: usize, z: f64) -> f64 {
        self.value(k, z).abs()
    }

    /// λ at the foot of a point; at a segment end the mean of both values, so that rounding does not choose one of them.
    pub fn at_foot(&self, x: Point) -> f64 {
        let boundary = &self.contact.boundary;
        let [first, end] = boundary.ends();
        let (k, z) = boundary.locate(boundary.foot(x).clamp(first, end));
        let near = 1e-9;
        let (here, last) = (self.value(k, z.clamp(0.0, 1.0)), boundary.segments() - 1);
        if z < near && (k > 0 || boundary.is_closed()) {
            0.5 * (here + self.value(k.checked_sub(1).unwrap_or(last), 1.0))
        } else if z > 1.0 - near && (k < last || boundary.is_closed()) {
            0.5 * (here + self.value(k + 1, 0.0))
        } else {
            here
        }
    }

    /// `∫λ ds` (force per thickness).
    pub fn force(&self) -> f64 {
        self.values.iter().enumerate().map(|(i, value)| value * self.contact.multipliers.integral(i)).sum()
    }

    /// Where the force of λ acts: its centre, beyond its ends where it pulls on one side as it presses on the other; that of its size
    /// where nothing but a moment is left; nothing if nothing presses.
    pub fn centre(&self) -> Option<Point> {
        let boundary = &self.contact.boundary;
        let parts = boundary.gauss_on(0..boundary.segments(), 3).map(|(k, z, _, length)| {
            let t = boundary.parameter_on(k, z);
            let force = self.value(k, z) * length * boundary.width(t);
            [force, force.abs()].map(|force| (force, force * boundary.point(t)))
        });
        let none = [(0.0, Point::zeros()); 2];
        let [(force, moment), (size, of_size)] =
            parts.fold(none, |sum, part| [0, 1].map(|k| (sum[k].0 + part[k].0, sum[k].1 + part[k].1)));
        (size > 0.0).then(|| if force.abs() > NO_FORCE * size { moment / force } else { of_size / size })
    }

    /// The largest value of a multiplier.
    pub fn largest(&self) -> f64 {
        self.values.iter().copied().fold(f64::NEG_INFINITY, f64::max)
    }

    /// The zones that press, in order of arc length.
    pub fn zones(&self) -> Vec<Zone> {
        Zone::all(&self.contact.boundary, &self.contact.multipliers, self.values, self.active)
    }

    /// What there is `of` those of its zones that anyone would look at.
    pub fn counting<T>(&self, zones: &[Zone], of: impl IntoIterator<Item = T>) -> impl Iterator<Item = T> {
        let peaks: Vec<f64> = zones.iter().map(|zone| self.peak_of(zone)).collect();
        let highest = peaks.iter().copied().fold(0.0, f64::max);
        let figures = self.shares(zones).into_iter().zip(peaks);
        of.into_iter().zip(figures).filter(move |(_, (share, peak))| zone_counts(*share, *peak, highest)).map(|(of, _)| of)
    }

    /// Shares that its zones have of all forces.
    pub fn shares(&self, zones: &[Zone]) -> Vec<f64> {
        let forces: Vec<f64> = zones.iter().map(|zone| self.force_of(zone)).collect();
        let whole: f64 = forces.iter().map(|force| force.abs()).sum();
        forces.into_iter().map(|force| force / whole).collect()
    }

    /// `∫λ ds` of one zone.
    pub fn force_of(&self, zone: &Zone) -> f64 {
        zone.force(&self.contact.multipliers, self.values)
    }

    /// The largest size of λ on one zone.
    pub fn peak_of(&self, zone: &Zone) -> f64 {
        zone.peak(&self.contact.multipliers, self.values)
    }

    /// Whether the largest λ of one zone lies beside an end of Γ_C.
    pub fn peaks_at_end(&self, zone: &Zone) -> bool {
        zone.peaks_at_end(&self.contact.boundary, &self.contact.multipliers, self.values)
    }

    /// The largest value of a smooth pressure with the means of λ; nothing where λ is largest on a zone of less than three
    /// segments.
    pub fn recovered_peak(&self) -> Option<f64> {
        let zones = self.zones();
        let highest = zones.iter().max_by(|a, b| self.peak_of(a).total_cmp(&self.peak_of(b)))?;
        recovered_peak(&self.contact.boundary, &self.contact.multipliers, self.values, highest)
    }

    /// Arc length at which the pressure of a zone fades out at one of its ends (0 or 1); nothing where it does not.
    pub fn faded_end(&self, zone: &Zone, end: usize) -> Option<f64> {
        faded_end(&self.contact.boundary, &self.contact.multipliers, self.values, zone, end)
    }

    /// How much of it is checkerboard; nothing if there is not enough to tell.
    pub fn oscillation(&self) -> Option<f64> {
        oscillation(&self.contact.boundary, &self.contact.multipliers, self.values, self.active)
    }

    /// Root mean square error over the middle of the worst zone that counts, against a formula of `x, y`, by that of the formula;
    /// nothing where nothing presses.
    pub fn middle_error(&self, exact: &Formula) -> Option<f64> {
        let boundary = &self.contact.boundary;
        let error = |zone: &Zone| {
            let points = boundary.gauss_on(zone.segments.clone(), 8);
            let middle = points.filter(|(_, _, arc, _)| zone.has_in_its_middle(*arc));
            self.mean_error(exact, middle.map(|(k, z, _, length)| (k, z, boundary.parameter_on(k, z), length)))
        };
        let zones = self.zones();
        self.counting(&zones, &zones).map(error).reduce(f64::max)
    }

    /// Relative error of the largest value, against the largest one of a formula of `x, y` on Γ_C.
    pub fn peak_error(&self, exact: &Formula) -> f64 {
        let boundary = &self.contact.boundary;
        let places = boundary.gauss_by_parameter(8).map(|(_, _, t, _)| t).chain(boundary.knots().iter().copied());
        let values = places.map(|t| boundary.point(t)).map(|x| exact.value(&[x.x, x.y]));
        (self.largest() / values.fold(f64::NEG_INFINITY, f64::max) - 1.0).abs()
    }

    /// Relative L2 error on Γ_C against a formula of `x, y`.
    pub fn error(&self, exact: &Formula) -> f64 {
        self.mean_error(exact, self.contact.boundary.gauss_by_parameter(8))
    }

    /// The same over some points, each by its segment, its fraction of that, its parameter and its length.
    fn mean_error(&self, exact: &Formula, points: impl Iterator<Item = (usize, f64, f64, f64)>) -> f64 {
        let mut sums = [0.0; 2];
        for (k, z, t, length) in points {
            let x = self.contact.boundary.point(t);
            let wanted = exact.value(&[x.x, x.y]);
            sums[0] += length * (self.value(k, z) - wanted).powi(2);
            sums[1] += length * wanted * wanted;
        }
        (sums[0] / sums[1]).sqrt()
    }
}

impl Solution {
    /// The pressure on one of the contacts that were solved for.
    pub fn pressure<'a>(&'a self, contact: &'a Contact) -> ContactPressure<'a> {
        ContactPressure::new(contact, &self.multipliers, &self.active)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::{Known, MultiplierSpace};
    use crate::discretisation::samples::{blocks, contact, pair};

    /// On four segments of a seam over [0, 2] that may pull: the force acts where its moment says.
    #[test]
    fn a_force_acts_where_its_moment_is_its_own() {
        let contact = contact(&blocks(pair(MultiplierSpace::P0, 4), |_| Point::zeros(), Vec::new()), Known::default());
        let place = |values: [f64; 4]| ContactPressure { contact: &contact, values: &values, active: &[true; 4] }.centre();
        let at = |values| place(values).expect("it presses").x;
        assert!((at([1.0, 1.0, 1.0, 1.0]) - 1.0).abs() < 1e-12 && (at([0.0, 0.0, 3.0, 0.0]) - 1.25).abs() < 1e-12);
        assert!((at([-1.0, 0.0, 0.0, 2.0]) - 3.25).abs() < 1e-12, "beyond the seam");
        assert!((at([-1.0, 0.0, 0.0, 1.0]) - 1.0).abs() < 1e-12, "a moment alone");
        assert!((at([-1.0, 0.0, 0.0, 1.0001]) - 1.0).abs() < 1e-3, "a moment and what a solve leaves");
        assert_eq!(place([0.0; 4]), None);
    }
}
