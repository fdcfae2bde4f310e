//! Linear elasticity in the plane: plane strain and plane stress.
//!
//! Displacements in plane stress are those of plane strain with the modulus `E (1 + 2ν)/(1 + ν)²` and the ratio `ν/(1 + ν)`,
//! which is at most 1/3: it is this ratio that counts where P1 is said to lock.

use nalgebra::Matrix2;

/// What is zero across the plane.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Plane {
    /// `ε_zz = 0`: bodies that are long across the plane.
    #[default]
    Strain,
    /// `σ_zz = 0`: sheets.
    Stress,
}

/// Lamé constants of a law in the plane (stress): `σ = λ tr(ε) I + 2 μ ε`, `σ_zz = λ_z tr(ε)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaneLaw {
    /// λ, in plane stress that of the plane: `2 λ μ / (λ + 2 μ)` by the material's own.
    pub lambda: f64,
    /// μ, the shear modulus.
    pub mu: f64,
    /// λ_z: λ in plane strain, zero in plane stress.
    pub across: f64,
}

impl PlaneLaw {
    /// From Young's modulus and Poisson's ratio, which may be ½ in plane stress only.
    pub fn new(young: f64, poisson: f64, plane: Plane) -> Self {
        let mu = young / (2.0 * (1.0 + poisson));
        match plane {
            Plane::Strain => {
                let lambda = young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
                Self { lambda, mu, across: lambda }
            }
            Plane::Stress => Self { lambda: young * poisson / ((1.0 + poisson) * (1.0 - poisson)), mu, across: 0.0 },
        }
    }

    /// Stress (xx, yy, xy, zz) of a displacement gradient `g[i][j] = ∂u_i/∂x_j`.
    pub fn stress(&self, g: &Matrix2<f64>) -> [f64; 4] {
        let (trace, volumetric) = (g.trace(), self.lambda * g.trace());
        [
            volumetric + 2.0 * self.mu * g[(0, 0)],
            volumetric + 2.0 * self.mu * g[(1, 1)],
            self.mu * (g[(0, 1)] + g[(1, 0)]),
            self.across * trace,
        ]
    }

    /// Twice the energy density of an in-plane stress (xx, yy, xy): `σ : C⁻¹ σ`.
    pub fn compliance(&self, s: [f64; 3]) -> f64 {
        let trace = s[0] + s[1];
        let shear = s[0] * s[0] + s[1] * s[1] + 2.0 * s[2] * s[2];
        (shear - self.lambda * trace * trace / (2.0 * (self.lambda + self.mu))) / (2.0 * self.mu)
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
        for plane in [Plane::Strain, Plane::Stress] {
            let law = PlaneLaw::new(7000.0, 0.227, plane);
            let g = Matrix2::new(1e-3, 4e-4, -2e-4, 5e-4);
            let s = law.stress(&g);
            let twice = s[0] * g[(0, 0)] + s[1] * g[(1, 1)] + s[2] * (g[(0, 1)] + g[(1, 0)]);
            assert!((law.compliance([s[0], s[1], s[2]]) / twice - 1.0).abs() < 1e-13);
        }
    }

    #[test]
    fn a_rotation_has_no_stress_and_uniaxial_strain_its_modulus() {
        let law = PlaneLaw::new(1.0, 0.25, Plane::Strain);
        assert_eq!(law.stress(&Matrix2::new(0.0, -0.1, 0.1, 0.0)), [0.0; 4]);
        // Oedometer modulus E (1 - ν) / ((1 + ν)(1 - 2ν)) = 1.2.
        assert!((law.stress(&Matrix2::new(1.0, 0.0, 0.0, 0.0))[0] - 1.2).abs() < 1e-15);
    }

    /// A bar that is pulled along x, free across it: `σ_xx = E ε_xx`, whatever ν, up to ½.
    #[test]
    fn plane_stress_pulls_by_youngs_modulus_and_leaves_nothing_across() {
        for poisson in [-0.9, 0.0, 0.3, 0.5] {
            let s = PlaneLaw::new(3.0, poisson, Plane::Stress).stress(&Matrix2::new(0.1, 0.0, 0.0, -0.1 * poisson));
            assert!((s[0] - 0.3).abs() < 1e-15 && s[1].abs() < 1e-15 && s[3] == 0.0, "{s:?}");
        }
    }

    #[test]
    fn hydrostatic_stress_has_no_von_mises_part() {
        assert_eq!(von_mises([2.0, 2.0, 0.0, 2.0]), 0.0);
        assert!((von_mises([3.0, 0.0, 0.0, 0.0]) - 3.0).abs() < 1e-15);
    }
}
