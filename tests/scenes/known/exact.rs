//! Exact pressures: Lamé, Michell, Hertz, Westergaard.

use nalgebra::{Matrix4, Vector4};
use std::f64::consts::PI;

/// An elastic body.
#[derive(Clone, Copy)]
pub struct Material {
    pub young: f64,
    pub poisson: f64,
}

/// 1/E* = (1 - ν₁²)/E₁ + (1 - ν₂²)/E₂.
pub fn stiffness([a, b]: [Material; 2]) -> f64 {
    1.0 / ((1.0 - a.poisson * a.poisson) / a.young + (1.0 - b.poisson * b.poisson) / b.young)
}

/// Radial displacement at `at` of a ring that reaches to `other`, by a unit pressure at `at` and none at `other`; and the
/// same by a pressure cos 2θ, without shear (Lamé; Michell).
fn compliance(ring: Material, at: f64, other: f64) -> [f64; 2] {
    let (nu, twice_shear) = (ring.poisson, ring.young / (1.0 + ring.poisson));
    let b = -1.0 / (at.powi(-2) - other.powi(-2));
    let even = ((1.0 - 2.0 * nu) * (-b / other.powi(2)) * at - b / at) / twice_shear;
    // Stress function (A r² + B r⁴ + C/r² + D) cos 2θ.
    let normal = |r: f64| [-2.0, 0.0, -6.0 * r.powi(-4), -4.0 * r.powi(-2)];
    let shear = |r: f64| [2.0, 6.0 * r * r, -6.0 * r.powi(-4), -2.0 * r.powi(-2)];
    let rows = [normal(at), shear(at), normal(other), shear(other)];
    let matrix = Matrix4::from_fn(|i, j| rows[i][j]);
    let unknown = matrix.lu().solve(&Vector4::new(-1.0, 0.0, 0.0, 0.0)).expect("a ring");
    let radial = [-2.0 * at, -4.0 * nu * at.powi(3), 2.0 * at.powi(-3), 4.0 * (1.0 - nu) / at];
    [even, (0..4).map(|k| radial[k] * unknown[k]).sum::<f64>() / twice_shear]
}

/// λ₀ and λ₂ of λ₀ + λ₂ cos 2θ between two rings of these radii with an interference δ₀ + δ₂ cos 2θ, free elsewhere.
pub fn rings([inner, outer]: [Material; 2], [a, b, c]: [f64; 3], interference: [f64; 2]) -> [f64; 2] {
    let (inside, outside) = (compliance(inner, b, a), compliance(outer, b, c));
    [0, 1].map(|k| interference[k] / (outside[k] - inside[k]))
}

/// Peak and half-width of Hertz for a force and a relative radius.
pub fn hertz(bodies: [Material; 2], force: f64, radius: f64) -> [f64; 2] {
    let peak = (force * stiffness(bodies) / (PI * radius)).sqrt();
    [peak, 2.0 * force / (PI * peak)]
}

/// λ at a distance from the crest of a gap Δ(1 - cos 2πx/L) under a mean pressure below πE*Δ/L (Westergaard).
pub fn westergaard(x: f64, length: f64, share: f64, mean: f64) -> f64 {
    let inside = share - (PI * x / length).sin().powi(2);
    if inside <= 0.0 { 0.0 } else { 2.0 * mean * (PI * x / length).cos().abs() / share * inside.sqrt() }
}

#[test]
fn rings_have_the_pressures_that_are_known() {
    let rings = rings(
        [Material { young: 5000.0, poisson: 0.33 }, Material { young: 11000.0, poisson: 0.2 }],
        [1.0, 2.0, 3.0],
        [0.004, 0.0015],
    );
    assert!((rings[0] - 4.3670).abs() < 1e-4 && (rings[1] - 0.23908).abs() < 1e-5, "{rings:?}");
}
