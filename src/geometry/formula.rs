//! Formulas of named variables.
//!
//! A formula is read once into a postfix program. It is evaluated at several points at once, or with dual numbers, so that
//! derivatives are exact.
//!
//! | precedence, weakest first | associates |
//! |---|---|
//! | `a + b`, `a - b` | to the left |
//! | `a * b`, `a / b` | to the left |
//! | `-a` | `-x^2` is `-(x^2)` |
//! | `a ^ b` | to the right: `2^3^2` is `2^9`; `2^-1` is one half |

mod arithmetic;
mod dual;
mod parser;
mod spelling;

use super::Point;
use super::place::{Coordinates, Quote};
use arithmetic::{Arithmetic, Function, Operation};
use dual::Dual;

/// A formula of named variables.
#[derive(Clone, Debug, PartialEq)]
pub struct Formula {
    text: String,
    /// Postfix; leaves exactly one number on the stack and never more than [`DEPTH`].
    program: Vec<Instruction>,
}

/// Why a formula cannot be read: column, what was found, what is allowed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{0}")]
pub struct FormulaError(pub String);

/// Most numbers that wait on the stack at a time.
const DEPTH: usize = 24;

/// One instruction of a program: pushes a number, or takes its operands from the stack and pushes the result.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Instruction {
    Number(f64),
    Variable(usize),
    Apply(Function),
    Combine(Operation),
}

impl Formula {
    /// Reads a formula of the named variables: `+ - * / ^ ( )`, `sqrt`, `sin`, `cos`, `exp`, `log`, `pi`, numbers.
    ///
    /// # Errors
    /// [`FormulaError`] with the column (from 1) of the first character that cannot stand there.
    pub fn parse(text: &str, variables: &[&str]) -> Result<Self, FormulaError> {
        let program = parser::parse(text, variables)?;
        Ok(Self { text: text.into(), program })
    }

    /// The formula that is the same everywhere.
    pub fn constant(value: f64) -> Self {
        Self { text: format!("{value:?}"), program: vec![Instruction::Number(value)] }
    }

    /// The formula with a number added to it.
    pub fn plus(&self, value: f64) -> Self {
        let added = [Instruction::Number(value), Instruction::Combine(Operation::Add)];
        Self { text: format!("{} + {value:?}", self.text), program: self.program.iter().copied().chain(added).collect() }
    }

    /// The formula multiplied by a number.
    pub fn times(&self, factor: f64) -> Self {
        if let Some(value) = self.as_constant() {
            return Self::constant(factor * value);
        }
        let multiplied = [Instruction::Number(factor), Instruction::Combine(Operation::Multiply)];
        Self { text: format!("({}) * {factor:?}", self.text), program: self.program.iter().copied().chain(multiplied).collect() }
    }

    /// Value of the formula, if no variable occurs in it.
    pub fn as_constant(&self) -> Option<f64> {
        match self.program[..] {
            [Instruction::Number(value)] => Some(value),
            _ => None,
        }
    }

    /// Whether it is zero everywhere, and no variable occurs in it.
    pub fn is_zero(&self) -> bool {
        self.as_constant() == Some(0.0)
    }

    /// Value at the given variables, in the order of `parse`. NaN or infinite where the formula is not defined.
    ///
    /// # Panics
    /// If `at` is shorter than the variables that the formula uses.
    pub fn value(&self, at: &[f64]) -> f64 {
        self.evaluate(|index| [at[index]])[0]
    }

    /// Values at some points, as a formula of x, y: the same as one after the other, in less time.
    ///
    /// # Panics
    /// If the formula uses more variables than these two.
    pub fn values<const N: usize>(&self, at: &[Point; N]) -> [f64; N] {
        self.evaluate(|index| at.map(|x| x[index]))
    }

    /// Exact partial derivative by variable number `variable`.
    ///
    /// # Panics
    /// If `at` is shorter than the variables that the formula uses.
    pub fn derivative(&self, variable: usize, at: &[f64]) -> f64 {
        self.evaluate(|index| Dual { value: at[index], slope: f64::from(u8::from(index == variable)) }).slope
    }

    /// Value at a point, as a formula of x, y.
    ///
    /// # Errors
    /// Words on the formula and the point, if it has no finite value there.
    pub fn finite_value(&self, x: Point) -> Result<f64, String> {
        let value = self.value(&[x.x, x.y]);
        if value.is_finite() {
            return Ok(value);
        }
        Err(format!("\"{}\" has no finite value at {}; correct the formula", Quote(&self.text), Coordinates(x)))
    }

    /// The formula as it was written.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Runs the program on variables given by their numbers.
    fn evaluate<V: Arithmetic>(&self, variable: impl Fn(usize) -> V) -> V {
        if let Some(value) = self.as_constant() {
            return V::constant(value);
        }
        let mut stack = [V::constant(0.0); DEPTH];
        let mut top = 0;
        for instruction in &self.program {
            let taken = instruction.operands();
            let result = instruction.compute(&stack[top - taken..top], &variable);
            top -= taken;
            stack[top] = result;
            top += 1;
        }
        stack[0]
    }
}

impl Instruction {
    /// How many numbers it takes from the stack.
    fn operands(&self) -> usize {
        match self {
            Instruction::Number(_) | Instruction::Variable(_) => 0,
            Instruction::Apply(_) => 1,
            Instruction::Combine(_) => 2,
        }
    }

    /// Its result on as many operands as it takes.
    fn compute<V: Arithmetic>(&self, operands: &[V], variable: impl Fn(usize) -> V) -> V {
        match *self {
            Instruction::Number(value) => V::constant(value),
            Instruction::Variable(index) => variable(index),
            Instruction::Apply(function) => operands[0].apply(function),
            Instruction::Combine(operation) => operands[0].combine(operation, operands[1]),
        }
    }
}

#[cfg(test)]
mod tests;
