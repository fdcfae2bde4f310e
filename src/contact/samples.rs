//! Contact pairs for unit tests.

use super::{Configuration, CurveChoice, EndRule, GapChoice, Law, MultiplierSpace, Pair, Quadrature, SegmentRule, Stabilise};

/// The contact of the two blocks of [`crate::mesh::samples`] along the line between them, by the drawn gap.
pub fn seam() -> Pair {
    Pair {
        name: "seam".into(),
        between: ["lower.seam", "upper.seam"].map(String::from),
        curve: CurveChoice::Line,
        gap: GapChoice::Geometry,
        space: MultiplierSpace::P0,
        segments: SegmentRule::Auto,
        law: Law::Unilateral,
        quadrature: Quadrature::Cut,
        stabilise: Stabilise::Off,
        configuration: Configuration::Reference,
        spans: None,
        grading: [1.0, 1.0],
        ends: EndRule::Fixed,
    }
}
