//! Numbers and names as a run says them, on the terminal and in its result.

use crate::case::Case;
use crate::element::Plane;
use crate::output::Units;
use crate::procedure::Work;

/// A length to six decimals, in any unit.
pub fn length(v: f64) -> String {
    if (1e-2..1e6).contains(&v) { format!("{v:.6}") } else { format!("{v:.6e}") }
}

/// A number to two digits, however small it is.
pub fn short(v: f64) -> String {
    if v.abs() < 0.01 && v != 0.0 { format!("{v:.1e}") } else { format!("{v:.2}") }
}

/// A number to two digits that say something, beside another of its size.
pub fn two_digits(v: f64) -> String {
    let power = if v == 0.0 { 0.0 } else { v.abs().log10().floor() };
    if (-2.0..2.0).contains(&power) { format!("{v:.*}", (1.0 - power) as usize) } else { format!("{v:.1e}") }
}

/// A number to four digits, beside a whole; what is nothing beside that is 0.
pub fn four_digits(v: f64, whole: f64) -> String {
    let rounded: f64 = format!("{v:.3e}").parse().unwrap_or(v);
    match rounded.abs() {
        size if size <= 1e-6 * whole => "0".into(),
        size if (1e-3..1e6).contains(&size) => rounded.to_string(),
        _ => format!("{rounded:e}"),
    }
}

/// The next larger number of two digits and zeros; rounding makes no number larger.
pub fn rounded_up(number: f64) -> f64 {
    let unit = 10_f64.powf(number.log10().floor() - 1.0);
    (number / unit * (1.0 - 1e-9)).ceil() * unit
}

/// Two digits at most: `8.1e-5`, `4e-4`.
pub fn figure(error: f64) -> String {
    if error == 0.0 { "0".into() } else { format!("{error:.1e}").replace(".0e", "e") }
}

/// A number of the case, however large or small: `0.5`, `1e-300`.
pub fn plain(number: f64) -> String {
    if (1e-4..1e7).contains(&number) { number.to_string() } else { format!("{number:e}") }
}

/// The units that a case names.
pub fn units(case: &Case) -> Units {
    let is_whole = case.plane == Plane::Revolution || case.has_thickness;
    Units::new(case.units.length.as_deref(), case.units.force.as_deref(), is_whole)
}

/// What stands above all that is said of a case.
pub fn title(case: &Case) -> &str {
    if case.title.is_empty() { &case.name } else { &case.title }
}

/// What is done, in words that may follow *while*.
pub fn doing(work: Work) -> &'static str {
    match work {
        Work::Contact => "placing contacts",
        Work::Assembly => "assembling",
        Work::SetUp => "setting up the solver",
        Work::Solve => "solving",
        Work::Recovery => "looking at the solution",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_units_keep_their_digits() {
        assert_eq!([4.0, 6.082e-9, 6.082e9].map(length), ["4.000000", "6.082000e-9", "6.082000e9"]);
        assert_eq!([1.5, 0.25, 6.3e-4].map(short), ["1.50", "0.25", "6.3e-4"]);
        let told = [-1161008551.33, 3.4641, -1e-9, 0.0, 12.0, 4.56789e-5].map(|v| four_digits(v, v.abs().max(1e-2)));
        assert_eq!(told, ["-1.161e9", "3.464", "0", "0", "12", "4.568e-5"]);
        let told = [0.0123, 0.01, 0.25, 1.5, 12.0, 6.3e-4, 0.0].map(two_digits);
        assert_eq!(told, ["0.012", "0.010", "0.25", "1.5", "12", "6.3e-4", "0.0"]);
    }
}
