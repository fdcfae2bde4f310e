//! Colours that people with any kind of colour vision can tell apart, and what is painted and written with them. The viewer
//! chooses the font, so widths of letters are estimates.

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

/// Nine equally spaced colours of viridis (van der Walt and Smith), as `#rrggbb`.
const VIRIDIS: [u32; 9] = [0x440154, 0x472c7a, 0x3b518b, 0x2c718e, 0x21908d, 0x27ad81, 0x5cc863, 0xaadc32, 0xfde725];

/// Blue and vermilion of Okabe and Ito between a light middle and dark ends.
const DIVERGING: [u32; 5] = [0x002454, 0x0072b2, 0xf2f2f2, 0xd55e00, 0x5c1800];

/// Viridis at a fraction of its range; fractions outside 0 to 1 take the colour of the nearest end.
pub fn viridis(fraction: f64) -> Colour {
    between(&VIRIDIS, fraction)
}

/// Blue for −1, light for 0, vermilion for 1.
pub fn diverging(value: f64) -> Colour {
    between(&DIVERGING, 0.5 + 0.5 * value)
}

/// The colour at a fraction of a range of equally spaced ones.
fn between(colours: &[u32], fraction: f64) -> Colour {
    let place = fraction.clamp(0.0, 1.0) * (colours.len() - 1) as f64;
    let below = (place as usize).min(colours.len() - 2);
    let weight = place - below as f64;
    let mixed = |shift: u32| {
        let [low, high] = [colours[below], colours[below + 1]].map(|colour| f64::from((colour >> shift) & 0xff));
        (low + weight * (high - low)).round() as u8
    };
    Colour(mixed(16), mixed(8), mixed(0))
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

/// Which part of a text stands at its place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TextAnchor {
    /// Its left end.
    Start,
    /// Its middle.
    Middle,
    /// Its right end.
    End,
}

/// How a text is written.
#[derive(Clone, Copy, Debug)]
pub struct Letters {
    /// Their size (pixels).
    pub size: f64,
    /// Their colour.
    pub colour: Colour,
    /// Where the text stands beside its place; its middle line goes through that.
    pub anchor: TextAnchor,
    /// Whether they are bold.
    pub is_bold: bool,
    /// Whether the text is read from below.
    pub is_upright: bool,
    /// Whether a white rim sets them off from what lies below.
    pub has_rim: bool,
}

impl Letters {
    /// Plain letters, which begin at their place.
    pub const fn new(size: f64, colour: Colour) -> Self {
        Self { size, colour, anchor: TextAnchor::Start, is_bold: false, is_upright: false, has_rim: false }
    }

    /// Bold ones.
    pub const fn bold(size: f64, colour: Colour) -> Self {
        Self { is_bold: true, ..Self::new(size, colour) }
    }

    /// With another part of the text at its place.
    pub const fn at(self, anchor: TextAnchor) -> Self {
        Self { anchor, ..self }
    }
}

/// Estimated width of a text (pixels), on the wide side of the usual sans-serif fonts.
pub fn text_width(text: &str, size: f64) -> f64 {
    let letter = |letter: char| match letter {
        'i' | 'j' | 'l' | '.' | ',' | ':' | '\'' | '|' | 'I' => 0.32,
        ' ' | 'f' | 't' | 'r' | '(' | ')' | '[' | ']' | '-' | '₁' | '₂' => 0.40,
        'm' | 'w' | 'M' | 'W' | '×' | '−' => 0.85,
        letter if letter.is_uppercase() => 0.70,
        _ => 0.60,
    };
    size * text.chars().map(letter).sum::<f64>()
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
