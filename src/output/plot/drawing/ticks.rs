//! Round numbers for axes and colour bars.

use crate::output::units::Unit;

/// An axis with fewer ticks would tell nobody how its values are spread.
const FEW: usize = 3;

/// The ticks of an axis: multiples of 1, 2 or 5 times a power of ten.
#[derive(Clone, Debug, PartialEq)]
pub struct Ticks {
    /// Values, ascending, within the range, each with its label.
    pub labels: Vec<(f64, String)>,
    /// The labels are in units of this power of ten.
    exponent: i32,
}

impl Ticks {
    /// About `count` ticks, and at most one more, for a range of finite length. Labels have a common power of ten where that is
    /// shorter.
    pub fn new(range: [f64; 2], count: usize) -> Ticks {
        let (step, values) = multiples(range, count);
        let largest = values.iter().fold(step, |largest, value| value.abs().max(largest));
        let magnitude = (largest * (1.0 + 1e-9)).log10().floor() as i32;
        let exponent = if (-2..5).contains(&magnitude) { 0 } else { magnitude };
        let decimals = (exponent - (step * (1.0 + 1e-9)).log10().floor() as i32).max(0) as usize;
        let label = |value: f64| {
            let text = format!("{:.*}", decimals, value / 10f64.powi(exponent));
            let is_zero = !text.contains(|digit: char| digit.is_ascii_digit() && digit != '0');
            (value, text.replace('-', if is_zero { "" } else { "−" }))
        };
        Ticks { labels: values.into_iter().map(label).collect(), exponent }
    }

    /// For a logarithmic axis over a range of positive numbers: powers of ten, at most about `count`, where they are few the
    /// numbers 2 and 5 between them, and where these are few too as many numbers as a linear axis has.
    pub fn decades(range: [f64; 2], count: usize) -> Ticks {
        let decades = (range[1] / range[0]).log10();
        let every = ((decades / count as f64).ceil() as i32).max(1);
        let has_powers = decades > 2.5;
        let digits: &[f64] = if has_powers { &[1.0] } else { &[1.0, 2.0, 5.0] };
        let (first, last) = (range[0].log10().floor() as i32, range[1].log10().ceil() as i32);
        let powers = (first..=last).filter(|power| power.rem_euclid(every) == 0);
        let values = powers.flat_map(|power| digits.iter().map(move |digit| digit * 10f64.powi(power)));
        let inside = |value: &f64| *value >= range[0] * (1.0 - 1e-9) && *value <= range[1] * (1.0 + 1e-9);
        let mut values: Vec<f64> = values.filter(inside).collect();
        if decades < 1.0 && values.len() < FEW {
            values = multiples(range, count.min(FEW + 1)).1;
        }
        let label = |value: f64| if has_powers { power_of_ten(value.log10().round() as i32) } else { number_text(value) };
        Ticks { labels: values.into_iter().map(|value| (value, label(value))).collect(), exponent: 0 }
    }

    /// The power of ten that the labels are in units of: `10⁻⁴`; nothing if it is one.
    pub fn power(&self) -> Option<String> {
        (self.exponent != 0).then(|| power_of_ten(self.exponent))
    }

    /// The unit of the labels: `mm`, or `10⁻⁴ mm`.
    pub fn unit(&self, unit: Unit) -> String {
        self.power().map_or_else(|| unit.words(), |power| unit.times(&power))
    }
}

/// The multiples in a range of the round number of which it has about so many, after that number.
fn multiples(range: [f64; 2], count: usize) -> (f64, Vec<f64>) {
    let step = round_number((range[1] - range[0]) / count as f64);
    let (first, last) = ((range[0] / step - 1e-9).ceil() as i64, (range[1] / step + 1e-9).floor() as i64);
    (step, (first..=last).map(|number| number as f64 * step).collect())
}

/// The number 1, 2 or 5 times a power of ten that is nearest to a positive number, by ratio.
pub fn round_number(number: f64) -> f64 {
    let exponent = number.log10().floor() as i32;
    // Negative powers by division: 2 / 10 is the double nearest to 0.2.
    let power = 10f64.powi(exponent.abs());
    let candidates = [1.0, 2.0, 5.0, 10.0].map(|digit| if exponent < 0 { digit / power } else { digit * power });
    let distance = |candidate: &f64| (number / candidate).ln().abs();
    candidates.into_iter().min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(number)
}

/// Where a scale should end so that a peak does not squeeze the rest: at one and a half times the value below which 98 %
/// of the weight lies, if the highest value exceeds three times that one. Pairs of value and weight.
pub fn cut_off(high: f64, mut weighted: Vec<(f64, f64)>) -> Option<f64> {
    weighted.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut peaks = 0.02 * weighted.iter().map(|(_, weight)| weight).sum::<f64>();
    let (usual, _) = weighted.into_iter().find(|(_, weight)| {
        peaks -= weight;
        peaks < 0.0
    })?;
    (usual > 0.0 && high > 3.0 * usual).then_some(1.5 * usual)
}

/// A number for people: four digits, and a power of ten where that is shorter.
pub fn number_text(number: f64) -> String {
    number_to(4, number)
}

/// A number for people with so many digits, and a power of ten where that is shorter.
pub fn number_to(digits: i32, number: f64) -> String {
    let magnitude = if number == 0.0 { 0 } else { (number.abs() * (1.0 + 1e-9)).log10().floor() as i32 };
    let trimmed = |number: f64, decimals: usize| {
        let text = format!("{number:.decimals$}");
        let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
        text.replace('-', "−")
    };
    if (-3..5).contains(&magnitude) {
        return trimmed(number, (digits - 1 - magnitude).max(0) as usize);
    }
    match trimmed(number / 10f64.powi(magnitude), digits as usize - 1) {
        one if one == "1" => power_of_ten(magnitude),
        digits => format!("{digits} × {}", power_of_ten(magnitude)),
    }
}

/// A count in groups of three digits: `21 868`.
pub fn grouped(count: usize) -> String {
    let digits = count.to_string();
    let groups: Vec<&str> = digits.as_bytes().rchunks(3).rev().map(|group| std::str::from_utf8(group).expect("digits")).collect();
    groups.join(" ")
}

/// `10⁻⁴`.
fn power_of_ten(exponent: i32) -> String {
    const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let raised = |letter: char| letter.to_digit(10).map_or('⁻', |digit| RAISED[digit as usize]);
    format!("10{}", exponent.to_string().chars().map(raised).collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::units::Units;

    fn labels(range: [f64; 2], count: usize) -> (Vec<String>, String) {
        let ticks = Ticks::new(range, count);
        let unit = ticks.unit(Units::default().length());
        (ticks.labels.into_iter().map(|(_, label)| label).collect(), unit)
    }

    #[test]
    fn labels_are_short_and_exact() {
        assert_eq!(
            labels([0.0, 6.1], 6),
            (["0", "1", "2", "3", "4", "5", "6"].map(String::from).to_vec(), "unit of length".into())
        );
        assert_eq!(labels([-0.11, 0.21], 3).0, ["−0.1", "0.0", "0.1", "0.2"]);
        assert_eq!(
            labels([-7.6e-4, -3.9e-4], 4),
            (["−7", "−6", "−5", "−4"].map(String::from).to_vec(), "10⁻⁴ units of length".into())
        );
        assert_eq!(labels([0.0, 2.4e5], 3), (["0", "1", "2"].map(String::from).to_vec(), "10⁵ units of length".into()));
        assert_eq!(labels([1000.0, 1000.2], 2).0, ["1000.0", "1000.1", "1000.2"]);
    }

    #[test]
    fn logarithmic_axes_have_powers_of_ten() {
        let labels = |range, count| Ticks::decades(range, count).labels.into_iter().map(|(_, label)| label).collect::<Vec<_>>();
        assert_eq!(labels([3e-7, 2e-3], 6), ["10⁻⁶", "10⁻⁵", "10⁻⁴", "10⁻³"]);
        assert_eq!(labels([0.3, 2.5], 6), ["0.5", "1", "2"]);
        assert_eq!(labels([1e3, 2e7], 6), ["10³", "10⁴", "10⁵", "10⁶", "10⁷"]);
        assert_eq!(labels([1e-12, 1.0], 4), ["10⁻¹²", "10⁻⁹", "10⁻⁶", "10⁻³", "10⁰"]);
        assert_eq!(labels([5.2e5, 8.7e5], 4), ["6 × 10⁵", "7 × 10⁵", "8 × 10⁵"], "no axis is without numbers");
    }

    #[test]
    fn round_numbers_are_nearest_by_ratio() {
        let cases = [(1.3, 1.0), (1.5, 2.0), (3.1, 2.0), (3.2, 5.0), (7.2, 10.0), (0.021, 0.02), (480.0, 500.0), (3e-13, 2e-13)];
        for (number, round) in cases {
            assert_eq!(round_number(number), round, "{number}");
        }
    }

    #[test]
    fn peaks_are_cut_off_only_where_they_squeeze_the_rest() {
        let scale = |peak: f64, width: f64| cut_off(peak, vec![(1.0, 1.0 - width), (peak, width)]);
        assert_eq!(scale(20.0, 0.01), Some(1.5));
        assert_eq!(scale(20.0, 0.03), None);
        assert_eq!(scale(2.5, 0.01), None);
        assert_eq!(cut_off(0.0, vec![(0.0, 1.0)]), None);
        assert_eq!(cut_off(0.0, vec![]), None);
    }

    #[test]
    fn numbers_for_people() {
        let cases = [
            (500.0, "500"),
            (0.5, "0.5"),
            (1e6, "10⁶"),
            (2e6, "2 × 10⁶"),
            (-1.23456, "−1.235"),
            (4.5678e-7, "4.568 × 10⁻⁷"),
            (0.0, "0"),
        ];
        for (number, text) in cases {
            assert_eq!(number_text(number), text);
        }
        assert_eq!([7.780021, 4.5678912e-7].map(|number| number_to(6, number)), ["7.78002", "4.56789 × 10⁻⁷"]);
    }
}
