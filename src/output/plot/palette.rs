//! Colours that people with any kind of colour vision can tell apart.

use plotters::style::RGBColor;

/// Text and outlines.
pub(super) const INK: RGBColor = RGBColor(38, 38, 38);
/// Frames and secondary text.
pub(super) const GREY: RGBColor = RGBColor(110, 110, 110);
/// Lines of the grid.
pub(super) const GRID: RGBColor = RGBColor(228, 228, 228);
/// Blue of Okabe and Ito.
pub(super) const BLUE: RGBColor = RGBColor(0, 114, 178);
/// Vermilion of Okabe and Ito.
pub(super) const VERMILION: RGBColor = RGBColor(213, 94, 0);
/// Bluish green of Okabe and Ito.
pub(super) const GREEN: RGBColor = RGBColor(0, 158, 115);

/// Colours of lines in a diagram, in their order: blue, vermilion and green, then orange, purple, sky blue and black of Okabe
/// and Ito.
pub(super) const LINES: [RGBColor; 7] =
    [BLUE, VERMILION, GREEN, RGBColor(230, 159, 0), RGBColor(204, 121, 167), RGBColor(86, 180, 233), INK];

/// Nine equally spaced colours of viridis (van der Walt and Smith).
const VIRIDIS: [[u8; 3]; 9] = [
    [68, 1, 84],
    [71, 44, 122],
    [59, 81, 139],
    [44, 113, 142],
    [33, 144, 141],
    [39, 173, 129],
    [92, 200, 99],
    [170, 220, 50],
    [253, 231, 37],
];

/// A colour as SVG has it.
pub(super) fn hex(RGBColor(red, green, blue): RGBColor) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}

/// Viridis at a fraction of its range; fractions outside 0 to 1 take the colour of the nearest end.
pub(super) fn viridis(fraction: f64) -> RGBColor {
    let place = fraction.clamp(0.0, 1.0) * (VIRIDIS.len() - 1) as f64;
    let below = (place as usize).min(VIRIDIS.len() - 2);
    let weight = place - below as f64;
    let mixed = |channel: usize| {
        let [low, high] = [VIRIDIS[below][channel], VIRIDIS[below + 1][channel]].map(f64::from);
        (low + weight * (high - low)).round() as u8
    };
    RGBColor(mixed(0), mixed(1), mixed(2))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn viridis_brightens_from_end_to_end() {
        let luminance = |RGBColor(r, g, b)| 0.2126 * f64::from(r) + 0.7152 * f64::from(g) + 0.0722 * f64::from(b);
        let values: Vec<f64> = (0..=32).map(|level| luminance(viridis(f64::from(level) / 32.0))).collect();
        assert!(values.windows(2).all(|pair| pair[0] < pair[1]));
        assert_eq!(viridis(-1.0), viridis(0.0));
        assert_eq!(viridis(2.0), RGBColor(253, 231, 37));
    }
}
