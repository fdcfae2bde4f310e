//! Linear elasticity in plane strain.

use nalgebra::Matrix2;

/// Lamé constants (stress): `σ = λ tr(ε) I + 2 μ ε`, `σ_zz = λ tr(ε)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaneStrain {
    /// λ.
    pub lambda: f64,
    /// μ, the shear modulus.
    pub mu: f64,
}

impl PlaneStrain {
    /// From Young's modulus and Poisson's ratio.
    pub fn new(young: f64, poisson: f64) -> Self {
        Self { lambda: young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson)), mu: young / (2.0 * (1.0 + poisson)) }
    }

    /// Stress (xx, yy, xy, zz) of a displacement gradient `g[i][j] = ∂u_i/∂x_j`.
    pub fn stress(&self, g: &Matrix2<f64>) -> [f64; 4] {
        let volumetric = self.lambda * g.trace();
        [
            volumetric + 2.0 * self.mu * g[(0, 0)],
            volumetric + 2.0 * self.mu * g[(1, 1)],
            self.mu * (g[(0, 1)] + g[(1, 0)]),
            volumetric,
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
        let law = PlaneStrain::new(7000.0, 0.227);
        let g = Matrix2::new(1e-3, 4e-4, -2e-4, 5e-4);
        let s = law.stress(&g);
        let twice = s[0] * g[(0, 0)] + s[1] * g[(1, 1)] + s[2] * (g[(0, 1)] + g[(1, 0)]);
        assert!((law.compliance([s[0], s[1], s[2]]) / twice - 1.0).abs() < 1e-13);
    }

    #[test]
    fn a_rotation_has_no_stress_and_uniaxial_strain_its_modulus() {
        let law = PlaneStrain::new(1.0, 0.25);
        assert_eq!(law.stress(&Matrix2::new(0.0, -0.1, 0.1, 0.0)), [0.0; 4]);
        // Oedometer modulus E (1 - ν) / ((1 + ν)(1 - 2ν)) = 1.2.
        assert!((law.stress(&Matrix2::new(1.0, 0.0, 0.0, 0.0))[0] - 1.2).abs() < 1e-15);
    }

    #[test]
    fn hydrostatic_stress_has_no_von_mises_part() {
        assert_eq!(von_mises([2.0, 2.0, 0.0, 2.0]), 0.0);
        assert!((von_mises([3.0, 0.0, 0.0, 0.0]) - 3.0).abs() < 1e-15);
    }
}
