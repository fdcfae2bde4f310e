//! Formula text to postfix program, by recursive descent.

use super::arithmetic::{Function, Operation};
use super::{DEPTH, FormulaError, Instruction};
use crate::geometry::place::Quote;

/// What a formula may call.
const FUNCTIONS: [(&str, Function); 5] =
    [("sqrt", Function::Sqrt), ("sin", Function::Sin), ("cos", Function::Cos), ("exp", Function::Exp), ("log", Function::Log)];

/// Every name that a formula of some variables may have.
pub fn names<'a>(variables: &'a [&'a str]) -> impl Iterator<Item = &'a str> + Clone {
    variables.iter().copied().chain(["pi"]).chain(FUNCTIONS.iter().map(|(name, _)| *name))
}

/// Deepest nesting of parentheses, signs and powers; keeps the recursion short.
const NESTING: usize = 64;

/// Reads a whole formula; the column of an error counts characters from 1.
pub fn parse(text: &str, variables: &[&str]) -> Result<Vec<Instruction>, FormulaError> {
    let mut parser = Parser { text: text.chars().collect(), next: 0, variables, program: Vec::new(), waiting: 0, nesting: 0 };
    parser.sum()?;
    match parser.peek() {
        None => Ok(parser.program),
        Some(')') => Err(parser.error_here("this parenthesis was never opened")),
        Some(_) => Err(parser.error_here("allowed here: + - * / ^ or the end")),
    }
}

struct Parser<'a> {
    text: Vec<char>,
    /// Index of the next character.
    next: usize,
    variables: &'a [&'a str],
    program: Vec<Instruction>,
    /// Numbers on the stack after the program so far.
    waiting: usize,
    nesting: usize,
}

impl Parser<'_> {
    /// `product ((+ | -) product)*`
    fn sum(&mut self) -> Result<(), FormulaError> {
        self.product()?;
        while let Some(sign @ ('+' | '-')) = self.peek() {
            self.next += 1;
            self.product()?;
            self.push(Instruction::Combine(if sign == '+' { Operation::Add } else { Operation::Subtract }))?;
        }
        Ok(())
    }

    /// `signed ((* | /) signed)*`
    fn product(&mut self) -> Result<(), FormulaError> {
        self.signed()?;
        while let Some(sign @ ('*' | '/')) = self.peek() {
            self.next += 1;
            self.signed()?;
            self.push(Instruction::Combine(if sign == '*' { Operation::Multiply } else { Operation::Divide }))?;
        }
        Ok(())
    }

    /// `(+ | -) signed` or `power`
    fn signed(&mut self) -> Result<(), FormulaError> {
        self.nesting += 1;
        if self.nesting > NESTING {
            return Err(self.error_here("nested too deeply; simplify the formula"));
        }
        match self.peek() {
            Some('-') => {
                self.next += 1;
                self.signed()?;
                self.push(Instruction::Apply(Function::Negate))?;
            }
            Some('+') => {
                self.next += 1;
                self.signed()?;
            }
            _ => self.power()?,
        }
        self.nesting -= 1;
        Ok(())
    }

    /// `atom` or `atom ^ signed`
    fn power(&mut self) -> Result<(), FormulaError> {
        self.atom()?;
        if self.peek() == Some('^') {
            self.next += 1;
            self.signed()?;
            self.push(Instruction::Combine(Operation::Power))?;
        }
        Ok(())
    }

    /// Number, `pi`, variable, `function(sum)` or `(sum)`
    fn atom(&mut self) -> Result<(), FormulaError> {
        match self.peek() {
            Some('(') => self.parenthesis(),
            Some(c) if c.is_ascii_digit() || c == '.' => self.number(),
            Some(c) if is_name(c) => self.name(),
            _ => Err(self.error_here(&format!("allowed here: {}", self.allowed()))),
        }
    }

    fn parenthesis(&mut self) -> Result<(), FormulaError> {
        let opened = self.next;
        self.next += 1;
        self.sum()?;
        if self.peek() != Some(')') {
            let words = format!("allowed here: + - * / ^ or ), which closes the parenthesis of column {}", opened + 1);
            return Err(self.error_here(&words));
        }
        self.next += 1;
        Ok(())
    }

    fn number(&mut self) -> Result<(), FormulaError> {
        let start = self.next;
        self.skip_while(|c| c.is_ascii_digit() || c == '.');
        if matches!(self.text.get(self.next), Some('e' | 'E')) {
            self.next += 1;
            if matches!(self.text.get(self.next), Some('+' | '-')) {
                self.next += 1;
            }
            self.skip_while(|c| c.is_ascii_digit());
        }
        let found: String = self.text[start..self.next].iter().collect();
        match found.parse::<f64>() {
            Ok(value) if value.is_finite() => self.push(Instruction::Number(value)),
            _ => Err(error_at(start, &found, "allowed here: a finite number like 2, 0.5 or 1e-3")),
        }
    }

    fn name(&mut self) -> Result<(), FormulaError> {
        let start = self.next;
        self.skip_while(|c| is_name(c) || c.is_ascii_digit());
        let found: String = self.text[start..self.next].iter().collect();
        if let Some(index) = self.variables.iter().position(|name| *name == found) {
            return self.push(Instruction::Variable(index));
        }
        if found == "pi" {
            return self.push(Instruction::Number(std::f64::consts::PI));
        }
        let Some(&(name, function)) = FUNCTIONS.iter().find(|(name, _)| *name == found) else {
            return Err(error_at(start, &found, &format!("allowed here: {}", self.allowed())));
        };
        if self.peek() != Some('(') {
            return Err(self.error_here(&format!("allowed here: (, as in {name}(...)")));
        }
        self.parenthesis()?;
        self.push(Instruction::Apply(function))
    }

    /// Appends an instruction; those on numbers alone are done at once.
    fn push(&mut self, instruction: Instruction) -> Result<(), FormulaError> {
        let taken = instruction.operands();
        self.waiting = self.waiting - taken + 1;
        if self.waiting > DEPTH {
            return Err(self.error_here("nested too deeply; simplify the formula"));
        }
        let first = self.program.len() - taken;
        let number = |one: &Instruction| if let Instruction::Number(value) = one { Some([*value]) } else { None };
        let operands: Vec<_> = self.program[first..].iter().filter_map(number).collect();
        if taken > 0 && operands.len() == taken {
            let [value] = instruction.compute(&operands, |_| unreachable!("an instruction on numbers has no variable"));
            self.program.truncate(first);
            self.program.push(Instruction::Number(value));
        } else {
            self.program.push(instruction);
        }
        Ok(())
    }

    /// Next character that is not white space.
    fn peek(&mut self) -> Option<char> {
        self.skip_while(char::is_whitespace);
        self.text.get(self.next).copied()
    }

    fn skip_while(&mut self, skip: impl Fn(char) -> bool) {
        while self.text.get(self.next).is_some_and(|c| skip(*c)) {
            self.next += 1;
        }
    }

    /// What may start a value.
    fn allowed(&self) -> String {
        let names: Vec<&str> = names(self.variables).collect();
        format!("a number, {}, - or (", names.join(", "))
    }

    fn error_here(&self, words: &str) -> FormulaError {
        let found = self.text.get(self.next).map_or("the end".into(), |c| c.to_string());
        error_at(self.next, &found, words)
    }
}

fn error_at(index: usize, found: &str, words: &str) -> FormulaError {
    FormulaError(format!("column {}: found `{}`; {words}", index + 1, Quote(found)))
}

fn is_name(c: char) -> bool {
    c.is_alphabetic() || c == '_'
}
