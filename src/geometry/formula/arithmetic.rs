//! What a formula computes with: values at several points at once, or a value with its slope.

/// What a formula does with one number: its sign, and the functions that it may call.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Function {
    Negate,
    Sqrt,
    Sin,
    Cos,
    Exp,
    Log,
}

/// What a formula does with two numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operation {
    Add,
    Subtract,
    Multiply,
    Divide,
    Power,
}

/// A number of formulas.
pub trait Arithmetic: Copy {
    /// One that depends on nothing.
    fn constant(value: f64) -> Self;

    /// A function of it.
    fn apply(self, function: Function) -> Self;

    /// What an operation makes of it and another one, its right operand. A negative base of a power wants a whole, constant
    /// exponent, else the result is NaN.
    fn combine(self, operation: Operation, other: Self) -> Self;
}

/// Values at `N` points: one instruction is read for all of them.
impl<const N: usize> Arithmetic for [f64; N] {
    fn constant(value: f64) -> Self {
        [value; N]
    }

    fn apply(self, function: Function) -> Self {
        match function {
            Function::Negate => self.map(|value| -value),
            Function::Sqrt => self.map(f64::sqrt),
            Function::Sin => self.map(f64::sin),
            Function::Cos => self.map(f64::cos),
            Function::Exp => self.map(f64::exp),
            Function::Log => self.map(f64::ln),
        }
    }

    fn combine(self, operation: Operation, other: Self) -> Self {
        match operation {
            Operation::Add => each(self, other, |a, b| a + b),
            Operation::Subtract => each(self, other, |a, b| a - b),
            Operation::Multiply => each(self, other, |a, b| a * b),
            Operation::Divide => each(self, other, |a, b| a / b),
            Operation::Power => each(self, other, power),
        }
    }
}

fn each<const N: usize>(a: [f64; N], b: [f64; N], of: impl Fn(f64, f64) -> f64) -> [f64; N] {
    std::array::from_fn(|k| of(a[k], b[k]))
}

/// `base ^ n`.
fn power(base: f64, n: f64) -> f64 {
    if n == 2.0 { base * base } else { base.powf(n) }
}
