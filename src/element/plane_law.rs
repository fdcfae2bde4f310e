//! Linear elasticity of figures in the plane: plane strain, plane stress, and bodies of revolution.
//!
//! Displacements in plane stress are those of plane strain with the modulus `E (1 + 2ν)/(1 + ν)²` and the ratio `ν/(1 + ν)`,
//! which is at most 1/3: it is this ratio that counts where P1 is said to lock.

use crate::geometry::{Formula, Point};
use nalgebra::Matrix2;
use std::f64::consts::TAU;

/// What a figure in the plane stands for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Plane {
    /// `ε_zz = 0`: bodies that are long across the plane.
    #[default]
    Strain,
    /// `σ_zz = 0`: sheets.
    Stress,
    /// Bodies of revolution about the axis x = 0: x is the radius, y goes along the axis, z around it; `ε_zz = u_x / x`.
    Revolution,
}

impl Plane {
    /// How far a body extends across the plane at a point, by which integrals in the plane become those of the whole body: one
    /// (no unit) in the plane, where all is per thickness, and the circumference `2 π x` (length) of a body of revolution.
    pub fn width(self, x: Point) -> f64 {
        match self {
            Self::Strain | Self::Stress => 1.0,
            Self::Revolution => TAU * x.x,
        }
    }

    /// Product `s : t` of two stresses (xx, yy, xy, zz), by which their sizes are measured: the one around the axis counts, that across
    /// the plane, which follows from the others, does not.
    pub fn stress_product(self, s: [f64; 4], t: [f64; 4]) -> f64 {
        let around = if self == Self::Revolution { s[3] * t[3] } else { 0.0 };
        s[0] * t[0] + s[1] * t[1] + 2.0 * s[2] * t[2] + around
    }

    /// What is left of a force on a whole body: radial parts of forces around an axis balance each other.
    pub fn resultant(self, force: Point) -> Point {
        match self {
            Self::Strain | Self::Stress => force,
            Self::Revolution => Point::new(0.0, force.y),
        }
    }

    /// What is left of a force and a moment on a whole body: moments in the plane of a section balance each other, too.
    pub fn resultant_with_moment(self, [x, y, moment]: [f64; 3]) -> [f64; 3] {
        match self {
            Self::Strain | Self::Stress => [x, y, moment],
            Self::Revolution => [0.0, y, 0.0],
        }
    }
}

/// The strain at a point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Strain {
    /// Displacement gradient `g[i][j] = ∂u_i/∂x_j`.
    pub gradient: Matrix2<f64>,
    /// Hoop strain `u_x / x` of a body of revolution, zero in the plane.
    pub hoop: f64,
}

impl Strain {
    /// Twice the energy density that a stress (xx, yy, xy, zz) has on it.
    pub fn work(&self, [xx, yy, xy, zz]: [f64; 4]) -> f64 {
        let g = &self.gradient;
        xx * g[(0, 0)] + yy * g[(1, 1)] + xy * (g[(0, 1)] + g[(1, 0)]) + zz * self.hoop
    }
}

/// Lamé constants of a law in the plane (stress): `σ = λ tr(ε) I + 2 μ ε`, `σ_zz = λ_z tr(ε) + 2 μ ε_zz`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaneLaw {
    /// λ, in plane stress that of the plane: `2 λ μ / (λ + 2 μ)` by the material's own.
    pub lambda: f64,
    /// μ, the shear modulus.
    pub mu: f64,
    /// λ_z: zero in plane stress, λ elsewhere.
    pub across: f64,
    /// What the plane stands for.
    pub plane: Plane,
}

/// Heat in a part of a body: it grows by `α ϑ` in all directions.
#[derive(Clone, Debug, PartialEq)]
pub struct Heat {
    /// Coefficient of linear expansion α (1/temperature).
    pub expansion: f64,
    /// Difference ϑ of the temperature to that at which the part has no stress, a formula of `x, y`.
    pub temperature: Formula,
}

impl PlaneLaw {
    /// From Young's modulus and Poisson's ratio, which may be ½ in plane stress only.
    pub fn new(young: f64, poisson: f64, plane: Plane) -> Self {
        let mu = young / (2.0 * (1.0 + poisson));
        match plane {
            Plane::Strain | Plane::Revolution => {
                let lambda = young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
                Self { lambda, mu, across: lambda, plane }
            }
            Plane::Stress => Self { lambda: young * poisson / ((1.0 + poisson) * (1.0 - poisson)), mu, across: 0.0, plane },
        }
    }

    /// Stress (xx, yy, xy, zz).
    pub fn stress(&self, Strain { gradient: g, hoop }: &Strain) -> [f64; 4] {
        let trace = g.trace() + hoop;
        let volumetric = self.lambda * trace;
        [
            volumetric + 2.0 * self.mu * g[(0, 0)],
            volumetric + 2.0 * self.mu * g[(1, 1)],
            self.mu * (g[(0, 1)] + g[(1, 0)]),
            self.across * trace + 2.0 * self.mu * hoop,
        ]
    }

    /// The pressure that keeps a heated material from growing, by its growth `α ϑ`: `3 λ + 2 μ`, and `2 λ + 2 μ` by the λ of plane
    /// stress (stress).
    pub fn pressure_by_growth(&self) -> f64 {
        self.growing() * self.lambda + 2.0 * self.mu
    }

    /// Directions in which growth does work against that pressure: in plane stress none does across the plane.
    pub fn growing(&self) -> f64 {
        if self.plane == Plane::Stress { 2.0 } else { 3.0 }
    }

    /// A stress (xx, yy, xy, zz) with the pressure that heat adds at a point.
    pub fn heated(&self, [xx, yy, xy, zz]: [f64; 4], heat: Option<&Heat>, x: Point) -> [f64; 4] {
        let Some(heat) = heat else { return [xx, yy, xy, zz] };
        let pressure = self.pressure_by_growth() * heat.growth(x);
        [xx - pressure, yy - pressure, xy, if self.plane == Plane::Stress { zz } else { zz - pressure }]
    }

    /// Twice the energy density `σ : C⁻¹ σ` of a stress (xx, yy, xy, zz), of which zz counts for bodies of revolution alone: in
    /// the plane it follows from the others.
    pub fn compliance(&self, [xx, yy, xy, zz]: [f64; 4]) -> f64 {
        let around = if self.plane == Plane::Revolution { zz } else { 0.0 };
        let dimensions = if self.plane == Plane::Revolution { 3.0 } else { 2.0 };
        let (trace, squares) = (xx + yy + around, xx * xx + yy * yy + 2.0 * xy * xy + around * around);
        (squares - self.lambda * trace * trace / (dimensions * self.lambda + 2.0 * self.mu)) / (2.0 * self.mu)
    }
}

impl Heat {
    /// Strain `α ϑ` at a point, the same in all directions.
    pub fn growth(&self, x: Point) -> f64 {
        self.expansion * self.temperature.value(&[x.x, x.y])
    }
}

/// Von Mises stress of (xx, yy, xy, zz).
pub fn von_mises([xx, yy, xy, zz]: [f64; 4]) -> f64 {
    (0.5 * ((xx - yy).powi(2) + (yy - zz).powi(2) + (zz - xx).powi(2)) + 3.0 * xy * xy).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn energy_of_a_stress_is_that_of_its_strain() {
        for (plane, hoop) in [(Plane::Strain, 0.0), (Plane::Stress, 0.0), (Plane::Revolution, -7e-4)] {
            let law = PlaneLaw::new(7000.0, 0.227, plane);
            let strain = Strain { gradient: Matrix2::new(1e-3, 4e-4, -2e-4, 5e-4), hoop };
            let stress = law.stress(&strain);
            assert!((law.compliance(stress) / strain.work(stress) - 1.0).abs() < 1e-13);
        }
    }

    #[test]
    fn a_rotation_has_no_stress_and_uniaxial_strain_its_modulus() {
        let law = PlaneLaw::new(1.0, 0.25, Plane::Strain);
        let of = |a, b, c, d| law.stress(&Strain { gradient: Matrix2::new(a, b, c, d), hoop: 0.0 });
        assert_eq!(of(0.0, -0.1, 0.1, 0.0), [0.0; 4]);
        // Oedometer modulus E (1 - ν) / ((1 + ν)(1 - 2ν)) = 1.2.
        assert!((of(1.0, 0.0, 0.0, 0.0)[0] - 1.2).abs() < 1e-15);
    }

    /// A bar that is pulled along x, free across it: `σ_xx = E ε_xx`, whatever ν, up to ½.
    #[test]
    fn plane_stress_pulls_by_youngs_modulus_and_leaves_nothing_across() {
        for poisson in [-0.9, 0.0, 0.3, 0.5] {
            let strain = Strain { gradient: Matrix2::new(0.1, 0.0, 0.0, -0.1 * poisson), hoop: 0.0 };
            let s = PlaneLaw::new(3.0, poisson, Plane::Stress).stress(&strain);
            assert!((s[0] - 0.3).abs() < 1e-15 && s[1].abs() < 1e-15 && s[3] == 0.0, "{s:?}");
        }
    }

    /// A bar along the axis of revolution that is pulled, and gets thinner all around: `σ_yy = E ε_yy`, whatever ν.
    #[test]
    fn a_round_bar_is_pulled_by_youngs_modulus() {
        for poisson in [-0.9, 0.0, 0.3, 0.499] {
            let strain = Strain { gradient: Matrix2::new(-0.1 * poisson, 0.0, 0.0, 0.1), hoop: -0.1 * poisson };
            let [xx, yy, _, zz] = PlaneLaw::new(3.0, poisson, Plane::Revolution).stress(&strain);
            assert!((yy - 0.3).abs() < 1e-12 && xx.abs() < 1e-12 && zz.abs() < 1e-12);
        }
    }

    #[test]
    fn what_grows_freely_has_no_stress() {
        let heat = Heat { expansion: 1e-5, temperature: Formula::constant(40.0) };
        let all = |plane: Plane, hoop: f64, grown: f64| {
            let law = PlaneLaw::new(7000.0, 0.3, plane);
            let strain = Strain { gradient: Matrix2::identity() * grown, hoop };
            law.heated(law.stress(&strain), Some(&heat), Point::zeros()).map(f64::abs).into_iter().fold(0.0, f64::max)
        };
        assert!(all(Plane::Stress, 0.0, 4e-4) < 1e-12 && all(Plane::Revolution, 4e-4, 4e-4) < 1e-12);
        // In plane strain the plane grows by what is kept from growing across it, too.
        let law = PlaneLaw::new(7000.0, 0.3, Plane::Strain);
        let strain = Strain { gradient: Matrix2::identity() * (1.3 * 4e-4), hoop: 0.0 };
        let [xx, yy, _, zz] = law.heated(law.stress(&strain), Some(&heat), Point::zeros());
        assert!(xx.abs() < 1e-12 && yy.abs() < 1e-12 && (zz + 7000.0 * 4e-4).abs() < 1e-12);
    }

    #[test]
    fn hydrostatic_stress_has_no_von_mises_part() {
        assert_eq!(von_mises([2.0, 2.0, 0.0, 2.0]), 0.0);
        assert!((von_mises([3.0, 0.0, 0.0, 0.0]) - 3.0).abs() < 1e-15);
    }
}
