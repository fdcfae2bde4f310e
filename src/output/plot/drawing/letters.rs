//! Letters of a figure. The viewer chooses the font, so widths are estimates.

use super::paint::Colour;

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
