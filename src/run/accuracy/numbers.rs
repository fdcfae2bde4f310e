//! Errors, counts and limits of an accuracy as its words have them.

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

/// A count in groups of three digits: `21 868`.
pub fn grouped(count: usize) -> String {
    let digits = count.to_string();
    let groups: Vec<&str> = digits.as_bytes().rchunks(3).rev().map(|group| std::str::from_utf8(group).expect("digits")).collect();
    groups.join(" ")
}
