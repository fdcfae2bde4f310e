//! Colours that people with any kind of colour vision can tell apart, and what is painted with them.

use std::fmt::{self, Display, Formatter};

/// Red, green and blue.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Colour(pub u8, pub u8, pub u8);

/// Text and outlines.
pub const INK: Colour = Colour(38, 38, 38);
/// Frames and secondary text.
pub const GREY: Colour = Colour(110, 110, 110);
/// Lines of the grid.
pub const GRID: Colour = Colour(228, 228, 228);
/// What lies below everything.
pub const WHITE: Colour = Colour(255, 255, 255);
/// Blue of Okabe and Ito.
pub const BLUE: Colour = Colour(0, 114, 178);
/// Vermilion of Okabe and Ito.
pub const VERMILION: Colour = Colour(213, 94, 0);
/// Bluish green of Okabe and Ito.
pub const GREEN: Colour = Colour(0, 158, 115);

/// Colours of lines in a diagram, in their order: blue, vermilion and green, then orange, purple, sky blue and black of Okabe
/// and Ito.
pub const LINES: [Colour; 7] = [BLUE, VERMILION, GREEN, Colour(230, 159, 0), Colour(204, 121, 167), Colour(86, 180, 233), INK];

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

/// Blue and vermilion of Okabe and Ito between a light middle and dark ends.
const DIVERGING: [[u8; 3]; 5] = [[0, 36, 84], [0, 114, 178], [242, 242, 242], [213, 94, 0], [92, 24, 0]];

/// Viridis at a fraction of its range; fractions outside 0 to 1 take the colour of the nearest end.
pub fn viridis(fraction: f64) -> Colour {
    between(&VIRIDIS, fraction)
}

/// Blue for −1, light for 0, vermilion for 1.
pub fn diverging(value: f64) -> Colour {
    between(&DIVERGING, 0.5 + 0.5 * value)
}

/// The colour at a fraction of a range of equally spaced ones.
fn between(colours: &[[u8; 3]], fraction: f64) -> Colour {
    let place = fraction.clamp(0.0, 1.0) * (colours.len() - 1) as f64;
    let below = (place as usize).min(colours.len() - 2);
    let weight = place - below as f64;
    let mixed = |channel: usize| {
        let [low, high] = [colours[below][channel], colours[below + 1][channel]].map(f64::from);
        (low + weight * (high - low)).round() as u8
    };
    Colour(mixed(0), mixed(1), mixed(2))
}

impl Display for Colour {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        write!(f, "#{:02x}{:02x}{:02x}", self.0, self.1, self.2)
    }
}

/// How a line is drawn, or an area with the line around it; as text, attributes of SVG.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Paint {
    fill: Option<Colour>,
    line: Option<(Colour, f64)>,
    opacity: f64,
    dashes: Option<&'static str>,
}

impl Paint {
    /// A line of a width (pixels).
    pub const fn line(colour: Colour, width: f64) -> Self {
        Self { fill: None, line: Some((colour, width)), opacity: 1.0, dashes: None }
    }

    /// An area of one colour.
    pub const fn fill(colour: Colour) -> Self {
        Self { fill: Some(colour), line: None, opacity: 1.0, dashes: None }
    }

    /// An area with a line around it, of a width (pixels).
    pub const fn edged(self, colour: Colour, width: f64) -> Self {
        Self { line: Some((colour, width)), ..self }
    }

    /// With what lies below to be seen through it; 0 cannot be seen at all, 1 is opaque.
    pub const fn faint(self, opacity: f64) -> Self {
        Self { opacity, ..self }
    }

    /// In dashes.
    pub const fn dashed(self) -> Self {
        Self { dashes: Some("60 40"), ..self }
    }

    /// In dashes and dots, as axes are.
    pub const fn dash_dotted(self) -> Self {
        Self { dashes: Some("120 30 20 30"), ..self }
    }
}

impl Display for Paint {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        match self.fill {
            Some(colour) => write!(f, "fill=\"{colour}\"")?,
            None => write!(f, "fill=\"none\"")?,
        }
        if let Some((colour, width)) = self.line {
            write!(f, " stroke=\"{colour}\" stroke-width=\"{:.0}\"", 10.0 * width)?;
        }
        if let Some(dashes) = self.dashes {
            write!(f, " stroke-dasharray=\"{dashes}\"")?;
        }
        if self.opacity < 1.0 { write!(f, " opacity=\"{}\"", self.opacity) } else { Ok(()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn viridis_brightens_from_end_to_end_and_diverging_colours_to_zero() {
        let luminance = |Colour(r, g, b)| 0.2126 * f64::from(r) + 0.7152 * f64::from(g) + 0.0722 * f64::from(b);
        let side = |sign: f64| (0..=16).map(|level| luminance(diverging(sign * f64::from(level) / 16.0))).collect::<Vec<_>>();
        assert!([1.0, -1.0].iter().all(|sign| side(*sign).windows(2).all(|pair| pair[0] > pair[1])));
        assert_eq!([-9.0, -0.5, 0.5].map(diverging), [Colour(0, 36, 84), BLUE, VERMILION]);
        let values: Vec<f64> = (0..=32).map(|level| luminance(viridis(f64::from(level) / 32.0))).collect();
        assert!(values.windows(2).all(|pair| pair[0] < pair[1]));
        assert_eq!(viridis(-1.0), viridis(0.0));
        assert_eq!(viridis(2.0), Colour(253, 231, 37));
    }

    #[test]
    fn paint_is_told_as_attributes() {
        assert_eq!(Paint::line(INK, 0.7).to_string(), "fill=\"none\" stroke=\"#262626\" stroke-width=\"7\"");
        assert_eq!(Paint::fill(WHITE).faint(0.6).to_string(), "fill=\"#ffffff\" opacity=\"0.6\"");
    }
}
