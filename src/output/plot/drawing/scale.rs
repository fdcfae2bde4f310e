//! Axes, and how values are spread along them.

use super::paint::text_width;
use super::ticks::Ticks;
use crate::output::markup::escape;
use crate::output::units::Unit;

/// Size of the labels of ticks (pixels).
pub const LABEL: f64 = 11.0;
/// Left of a plot, beside the labels of its ticks: the edge of the figure, the name of the axis, the ticks and what lies between
/// them; and all of that at least (pixels).
const BESIDE: f64 = 40.0;
const LEAST_BESIDE: f64 = 66.0;

/// An axis that will fit what is drawn; a linear one begins at zero.
#[derive(Clone, Debug, Default)]
pub struct Axis {
    /// What it shows, with its unit.
    pub name: String,
    /// Whether it is logarithmic; what is not positive is not drawn then.
    pub logarithmic: bool,
    /// Whether it runs from large values to small ones: errors become better to the right.
    pub falling: bool,
    /// Whether a linear one does not begin at zero, but fits what is drawn.
    pub fits: bool,
}

impl Axis {
    /// A logarithmic axis.
    pub fn logarithmic(name: impl Into<String>) -> Self {
        Self { name: name.into(), logarithmic: true, ..Self::default() }
    }

    /// Whether it can show a value.
    pub fn shows(&self, value: f64) -> bool {
        value.is_finite() && (!self.logarithmic || value > 0.0)
    }

    /// The axis with room around these values.
    pub fn around(&self, values: impl Iterator<Item = f64>) -> Scale {
        let [low, high] = range_of(values.filter(|value| self.shows(*value)));
        let (mut range, ticks) = if self.logarithmic {
            let room = (high / low).powf(0.06).max(1.25);
            let range = [low / room, high * room];
            (range, Ticks::decades(range, 7))
        } else {
            let whole = if self.fits { widened([low, high], 0.06) } else { [0.0, 1.12 * high] };
            let range = if self.fits || high > 0.0 { whole } else { [0.0, 1.0] };
            (range, Ticks::new(range, 6))
        };
        if self.falling {
            range.reverse();
        }
        // A power of ten stands before the unit, if there is one.
        let name = match (ticks.power(), self.name.rsplit_once(" [")) {
            (None, _) => self.name.clone(),
            (Some(power), Some((name, unit))) => format!("{name} [{power} {unit}"),
            (Some(power), None) => format!("{} [{power}]", self.name),
        };
        Scale { is_logarithmic: self.logarithmic, range, ticks, name, after: String::new() }
    }
}

/// An axis with its range.
pub struct Scale {
    /// First and last value.
    pub range: [f64; 2],
    /// What is shown, with its unit.
    pub name: String,
    /// Whether equal ratios of values are equal distances, instead of equal differences; all are positive then.
    is_logarithmic: bool,
    ticks: Ticks,
    /// What stands after its numbers.
    after: String,
}

impl Scale {
    /// A linear axis with about so many ticks, named by a quantity and its unit.
    pub fn linear(range: [f64; 2], ticks: usize, name: &str, unit: Unit) -> Self {
        let ticks = Ticks::new(range, ticks);
        Self { is_logarithmic: false, name: format!("{name} [{}]", ticks.unit(unit)), range, ticks, after: unit.after() }
    }

    /// Where a value is, as a share of the way from the first to the last one.
    pub fn share(&self, value: f64) -> f64 {
        let [first, last] = self.range;
        if self.is_logarithmic { (value / first).ln() / (last / first).ln() } else { (value - first) / (last - first) }
    }

    /// The ticks: where they are, as shares, and their labels.
    pub fn ticks(&self) -> Vec<(f64, &str)> {
        self.ticks.labels.iter().map(|(value, label)| (self.share(*value), label.as_str())).collect()
    }

    /// Its first and last value and its unit, for scripts.
    pub fn told(&self) -> String {
        let [first, last] = self.range;
        escape(&format!("{first} {last}{}", self.after))
    }

    /// Room that it takes at the left of a plot if it is vertical (pixels): its name, its widest label, its ticks.
    pub fn room(&self) -> f64 {
        let widths = self.ticks().into_iter().map(|(_, label)| text_width(label, LABEL));
        (BESIDE + widths.fold(0.0, f64::max)).ceil().max(LEAST_BESIDE)
    }
}

/// The least and the largest of some values; without bound, and the other way round, if there are none.
pub fn range_of(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(value), high.max(value)])
}

/// A range with some room on both sides, by this share of it; a single value becomes a range around it.
pub fn widened([low, high]: [f64; 2], fraction: f64) -> [f64; 2] {
    let size = high - low;
    let room = if size > 1e-12 * low.abs().max(high.abs()) { fraction * size } else { low.abs().max(high.abs()).max(1e-12) };
    [low - room, high + room]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_ratios_are_equal_distances() {
        let axis = Axis::logarithmic("").around([1.0, 100.0].into_iter());
        let place = |value: f64| axis.share(value);
        assert!((place(100.0) - 2.0 * place(10.0) + place(1.0)).abs() < 1e-12 && place(1.0) > 0.0 && place(100.0) < 1.0);
    }

    #[test]
    fn an_axis_that_fits_does_not_begin_at_zero() {
        let around = |fits| Axis { fits, ..Axis::default() }.around([-3.0, 97.0].into_iter()).range;
        assert!(around(true) == [-9.0, 103.0] && around(false)[0] == 0.0);
        let [low, high] = Axis { fits: true, ..Axis::default() }.around([5.0].into_iter()).range;
        assert!(low < 5.0 && high > 5.0, "one value is inside");
    }

    #[test]
    fn a_power_of_ten_of_the_labels_is_told() {
        let name = |name: &str, most: f64| Axis { name: name.into(), ..Axis::default() }.around([0.0, most].into_iter()).name;
        assert_eq!([name("young", 2e5), name("force [N]", 2e-4), name("step", 4.0)], ["young [10⁵]", "force [10⁻⁴ N]", "step"]);
    }

    #[test]
    fn smaller_errors_are_at_the_right() {
        let x = Axis { falling: true, ..Axis::logarithmic("error") }.around([0.1, 1e-3, 1e-6].into_iter());
        assert!(x.share(1e-6) > 0.8 && x.share(0.1) < 0.2 && x.ticks().len() > 2);
    }
}
