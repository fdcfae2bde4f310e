//! What a formula computes with: values at several points at once, or a value with its slope.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// A number of formulas.
pub trait Arithmetic:
    Copy + Neg<Output = Self> + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    /// One that depends on nothing.
    fn constant(value: f64) -> Self;

    fn sqrt(self) -> Self;

    fn sin(self) -> Self;

    fn cos(self) -> Self;

    fn exp(self) -> Self;

    /// The natural logarithm.
    fn log(self) -> Self;

    /// `self ^ exponent`; a negative base wants a whole, constant exponent, else the result is NaN.
    fn power(self, exponent: Self) -> Self;
}

/// Values at `N` points: one instruction is read for all of them.
#[derive(Clone, Copy, Debug)]
pub struct PointValues<const N: usize>(pub [f64; N]);

impl<const N: usize> PointValues<N> {
    fn with(self, other: Self, of: impl Fn(f64, f64) -> f64) -> Self {
        Self(std::array::from_fn(|k| of(self.0[k], other.0[k])))
    }
}

impl<const N: usize> Arithmetic for PointValues<N> {
    fn constant(value: f64) -> Self {
        Self([value; N])
    }

    fn sqrt(self) -> Self {
        Self(self.0.map(f64::sqrt))
    }

    fn sin(self) -> Self {
        Self(self.0.map(f64::sin))
    }

    fn cos(self) -> Self {
        Self(self.0.map(f64::cos))
    }

    fn exp(self) -> Self {
        Self(self.0.map(f64::exp))
    }

    fn log(self) -> Self {
        Self(self.0.map(f64::ln))
    }

    fn power(self, exponent: Self) -> Self {
        self.with(exponent, power)
    }
}

impl<const N: usize> Neg for PointValues<N> {
    type Output = Self;
    fn neg(self) -> Self {
        Self(self.0.map(|value| -value))
    }
}

impl<const N: usize> Add for PointValues<N> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.with(other, |a, b| a + b)
    }
}

impl<const N: usize> Sub for PointValues<N> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self.with(other, |a, b| a - b)
    }
}

impl<const N: usize> Mul for PointValues<N> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        self.with(other, |a, b| a * b)
    }
}

impl<const N: usize> Div for PointValues<N> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        self.with(other, |a, b| a / b)
    }
}

/// `base ^ n`.
pub fn power(base: f64, n: f64) -> f64 {
    if n == 2.0 { base * base } else { base.powf(n) }
}
