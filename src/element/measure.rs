//! Single numbers of a stress: what figures show in colours.

use super::plane_law::von_mises;

/// A number that a stress (xx, yy, xy, zz) has at each point. Tension is positive.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum StressMeasure {
    /// Von Mises stress.
    #[default]
    VonMises,
    /// The larger principal stress in the plane.
    First,
    /// The smaller one.
    Second,
    /// Half of the largest difference between any two of the three principal stresses.
    Shear,
    /// Along x, which is the radius of bodies of revolution.
    Xx,
    /// Along y, which is their axis.
    Yy,
    /// Shear between x and y.
    Xy,
    /// Across the plane.
    Zz,
    /// Along the radius, of bodies of revolution.
    Radial,
    /// Around the axis, of bodies of revolution.
    Hoop,
}

/// Names of all measures but von Mises stress, in the order of [`MEASURES`].
pub const MEASURE_NAMES: [&str; 9] =
    ["sigma_1", "sigma_2", "tau_max", "sigma_xx", "sigma_yy", "sigma_xy", "sigma_zz", "sigma_rr", "sigma_tt"];
/// The measures of [`MEASURE_NAMES`].
pub const MEASURES: [StressMeasure; 9] = {
    use StressMeasure::{First, Hoop, Radial, Second, Shear, Xx, Xy, Yy, Zz};
    [First, Second, Shear, Xx, Yy, Xy, Zz, Radial, Hoop]
};

impl StressMeasure {
    /// Its value.
    pub fn of(self, stress: [f64; 4]) -> f64 {
        let [xx, yy, xy, zz] = stress;
        let (middle, radius) = (0.5 * (xx + yy), (0.5 * (xx - yy)).hypot(xy));
        match self {
            Self::VonMises => von_mises(stress),
            Self::First => middle + radius,
            Self::Second => middle - radius,
            Self::Shear => 0.5 * ((middle + radius).max(zz) - (middle - radius).min(zz)),
            Self::Xx | Self::Radial => xx,
            Self::Yy => yy,
            Self::Xy => xy,
            Self::Zz | Self::Hoop => zz,
        }
    }

    /// Whether it may be below zero.
    pub fn is_signed(self) -> bool {
        !matches!(self, Self::VonMises | Self::Shear)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Principal stresses 5 and −5 in the plane, at an angle, with one of 1 across it; then all of them tension.
    #[test]
    fn measures_of_a_stress() {
        let of = |stress| MEASURES.map(|measure| measure.of(stress));
        assert_eq!(of([3.0, -3.0, 4.0, 1.0]), [5.0, -5.0, 5.0, 3.0, -3.0, 4.0, 1.0, 3.0, 1.0]);
        assert_eq!(of([8.0, 2.0, 0.0, 0.0])[..3], [8.0, 2.0, 4.0], "the smallest principal stress is that across the plane");
        assert_eq!(of([2.0, 2.0, 0.0, 8.0])[..3], [2.0, 2.0, 3.0], "and here the largest one");
        assert_eq!(StressMeasure::default().of([3.0, 0.0, 0.0, 0.0]), 3.0);
        assert!(MEASURES.iter().all(|measure| measure.is_signed() != (*measure == StressMeasure::Shear)));
    }
}
