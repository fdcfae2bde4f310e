//! Numbers, places and texts of the user's in words, for messages.

use super::Point;
use std::fmt::{self, Display, Formatter};

/// A number to six digits, with an exponent where it would be long without one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rounded(pub f64);

/// A place as `(x, y)`, both to six digits; a coordinate that is rounding beside the other one is 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates(pub Point);

/// Parts of a place below this share of the other one are rounding.
const ROUNDING: f64 = 1e-12;

/// Longest text that is quoted in full.
const LONGEST: usize = 60;

/// A text of the user's on one line, cut if it is long.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Quote<'a>(pub &'a str);

impl<'a> Quote<'a> {
    /// As much of it as is quoted, as it is.
    pub fn head(&self) -> &'a str {
        self.0.char_indices().nth(LONGEST).map_or(self.0, |(end, _)| &self.0[..end])
    }
}

impl Display for Quote<'_> {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        for letter in self.head().chars() {
            if letter.is_control() { write!(f, "{}", letter.escape_default())? } else { write!(f, "{letter}")? }
        }
        f.write_str(if self.head().len() < self.0.len() { " ..." } else { "" })
    }
}

impl Display for Rounded {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        // Adding zero makes zero of minus zero.
        let short = format!("{:.5e}", self.0).parse::<f64>().unwrap_or(self.0) + 0.0;
        let is_short = short == 0.0 || !short.is_finite() || (1e-4..1e7).contains(&short.abs());
        if is_short { write!(f, "{short}") } else { write!(f, "{short:e}") }
    }
}

impl Display for Coordinates {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        let size = self.0.amax();
        let [x, y] = [self.0.x, self.0.y].map(|part| Rounded(if part.abs() < ROUNDING * size { 0.0 } else { part }));
        write!(f, "({x}, {y})")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_texts_are_cut_and_stay_on_one_line() {
        assert_eq!(Quote("two\nlines").to_string(), "two\\nlines");
        assert_eq!(Quote(&"ü".repeat(1000)).to_string(), format!("{} ...", "ü".repeat(60)));
    }

    #[test]
    fn numbers_are_short_whatever_their_size() {
        let told = |number: f64| Rounded(number).to_string();
        assert_eq!([2.0, -0.0, 0.25000000000102973, 1e6].map(told), ["2", "0", "0.25", "1000000"]);
        assert_eq!([1e308, -1.0 / 3e8, 1e-5].map(told), ["1e308", "-3.33333e-9", "1e-5"]);
        assert_eq!([f64::NAN, f64::INFINITY].map(told), ["NaN", "inf"]);
        assert_eq!(Coordinates(Point::new(1.0 / 3.0, -1e300)).to_string(), "(0, -1e300)");
        let told = |x: f64, y: f64| Coordinates(Point::new(x, y)).to_string();
        assert_eq!(told(1.0 / 3.0, 1.22465e-16), "(0.333333, 0)", "a point of a circle");
        assert_eq!([told(1e-9, -2.0), told(0.0, -0.0)], ["(1e-9, -2)", "(0, 0)"]);
    }
}
