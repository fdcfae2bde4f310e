//! Dual numbers: a value and its slope along one variable.

use super::arithmetic::{Arithmetic, power};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// `value + slope ε` with `ε² = 0`.
#[derive(Clone, Copy, Debug)]
pub struct Dual {
    /// Value.
    pub value: f64,
    /// Derivative of the value.
    pub slope: f64,
}

impl Dual {
    /// Chain rule. A constant stays one, also where the outer slope is infinite (√x at 0).
    fn chain(self, value: f64, outer_slope: impl FnOnce() -> f64) -> Self {
        let slope = if self.slope == 0.0 { 0.0 } else { outer_slope() * self.slope };
        Self { value, slope }
    }
}

impl Arithmetic for Dual {
    fn constant(value: f64) -> Self {
        Self { value, slope: 0.0 }
    }

    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.chain(root, || 0.5 / root)
    }

    fn sin(self) -> Self {
        self.chain(self.value.sin(), || self.value.cos())
    }

    fn cos(self) -> Self {
        self.chain(self.value.cos(), || -self.value.sin())
    }

    fn exp(self) -> Self {
        let value = self.value.exp();
        self.chain(value, || value)
    }

    fn log(self) -> Self {
        self.chain(self.value.ln(), || 1.0 / self.value)
    }

    fn power(self, exponent: Self) -> Self {
        let (base, n) = (self.value, exponent.value);
        let value = power(base, n);
        let through_base = self.chain(value, || if n == 0.0 { 0.0 } else { n * base.powf(n - 1.0) });
        let through_exponent = exponent.chain(value, || if base == 0.0 && n > 0.0 { 0.0 } else { value * base.ln() });
        Self { value, slope: through_base.slope + through_exponent.slope }
    }
}

impl Neg for Dual {
    type Output = Self;
    fn neg(self) -> Self {
        Self { value: -self.value, slope: -self.slope }
    }
}

impl Add for Dual {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { value: self.value + other.value, slope: self.slope + other.slope }
    }
}

impl Sub for Dual {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self { value: self.value - other.value, slope: self.slope - other.slope }
    }
}

impl Mul for Dual {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self { value: self.value * other.value, slope: self.slope * other.value + self.value * other.slope }
    }
}

impl Div for Dual {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        Self { value, slope: (self.slope - value * other.slope) / other.value }
    }
}
