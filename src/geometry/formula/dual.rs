//! Dual numbers: a value and its slope along one variable.

use super::arithmetic::{Arithmetic, Function, Operation};

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

    /// The power of this `value`.
    fn power(self, exponent: Self, value: f64) -> Self {
        let (base, n) = (self.value, exponent.value);
        let through_base = self.chain(value, || if n == 0.0 { 0.0 } else { n * base.powf(n - 1.0) });
        let through_exponent = exponent.chain(value, || if base == 0.0 && n > 0.0 { 0.0 } else { value * base.ln() });
        Self { value, slope: through_base.slope + through_exponent.slope }
    }
}

impl Arithmetic for Dual {
    fn constant(value: f64) -> Self {
        Self { value, slope: 0.0 }
    }

    fn apply(self, function: Function) -> Self {
        let [value] = [self.value].apply(function);
        match function {
            Function::Negate => Self { value, slope: -self.slope },
            Function::Sqrt => self.chain(value, || 0.5 / value),
            Function::Sin => self.chain(value, || self.value.cos()),
            Function::Cos => self.chain(value, || -self.value.sin()),
            Function::Exp => self.chain(value, || value),
            Function::Log => self.chain(value, || 1.0 / self.value),
        }
    }

    fn combine(self, operation: Operation, other: Self) -> Self {
        let [value] = [self.value].combine(operation, [other.value]);
        let slope = match operation {
            Operation::Add => self.slope + other.slope,
            Operation::Subtract => self.slope - other.slope,
            Operation::Multiply => self.slope * other.value + self.value * other.slope,
            Operation::Divide => (self.slope - value * other.slope) / other.value,
            Operation::Power => return self.power(other, value),
        };
        Self { value, slope }
    }
}
