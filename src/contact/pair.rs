//! A contact pair as the case asks for it.

use super::side::Side;
use crate::geometry::{Formula, Point};

/// Two boundaries that may touch, and how their contact is modelled.
#[derive(Clone, Debug)]
pub struct Pair {
    /// Name in the case file.
    pub name: String,
    /// Physical curves of body 1 and of body 2; the normal points from 1 to 2.
    pub between: [String; 2],
    /// Where the contact boundary comes from.
    pub curve: CurveChoice,
    /// Initial gap.
    pub gap: GapChoice,
    /// Space of the contact pressure.
    pub space: MultiplierSpace,
    /// Cutting of the contact boundary.
    pub segments: SegmentRule,
    /// Contact law.
    pub law: Law,
    /// Where the integrals over the contact boundary are evaluated.
    pub quadrature: Quadrature,
    /// Whether the jump term is added.
    pub stabilise: Stabilise,
    /// Where contact is modelled.
    pub configuration: Configuration,
    /// Spans of a fitted curve; by the data if not given.
    pub spans: Option<usize>,
    /// How many times shorter the segments at the first and at the last end are than those in the middle.
    pub grading: [f64; 2],
    /// Whether the ends of the contact boundary follow the pressure.
    pub ends: EndRule,
}

impl Pair {
    /// The pair on a mesh that is `times` refinements coarser, with as many segments less.
    pub fn coarser(&self, times: usize) -> Self {
        let segments = match &self.segments {
            SegmentRule::Auto => SegmentRule::Auto,
            SegmentRule::Count(count) => SegmentRule::Count((count >> times).max(1)),
            SegmentRule::Fractions(fractions) => {
                let inner = fractions[..fractions.len() - 1].iter().step_by(1 << times);
                SegmentRule::Fractions(inner.copied().chain([1.0]).collect())
            }
        };
        Self { segments, ..self.clone() }
    }

    /// Whether its contact boundary depends on the solution.
    pub fn follows(&self) -> bool {
        self.curve.is_found() || self.has_free_ends()
    }

    /// Whether the ends of its contact boundary follow the pressure: a bilateral one has no end.
    pub fn has_free_ends(&self) -> bool {
        self.ends == EndRule::Free && self.law == Law::Unilateral
    }
}

/// Where normals, corresponding points and distances are taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Configuration {
    /// On the undeformed bodies: the linear theory.
    Reference,
    /// On the deformed bodies.
    Deformed,
}

/// What becomes of the ends of a contact boundary.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EndRule {
    /// They stay where the curve is placed.
    Fixed,
    /// They move to where the pressure ends.
    Free,
}

/// Where the integrals over the contact boundary are evaluated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quadrature {
    /// Between segment ends and the feet of the body's boundary nodes: exact on straight boundaries.
    Cut,
    /// At a fixed number of Gauss points on each segment, whatever lies beside it.
    Segment {
        /// Gauss points of a segment, 1 to 20.
        points: usize,
    },
}

/// When the jump term is added to the multiplier block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stabilise {
    /// Where the segments are shorter than the safe rule allows.
    Auto,
    /// Always.
    On,
    /// Never.
    Off,
}

/// Where the contact boundary comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CurveChoice {
    /// A spline fitted to the nodes of both boundaries where they touch or penetrate, again and again while they deform.
    Fit,
    /// Both boundaries are straight; the line between them over their overlap.
    Line,
    /// The declared geometry that lists both boundaries.
    Geometry,
    /// The undeformed shape of one of the two boundaries, where they touch or penetrate: a rigid tool's own curve.
    Own(Side),
}

impl CurveChoice {
    /// Whether its extent is found where the boundaries touch or penetrate each other.
    pub fn is_found(self) -> bool {
        matches!(self, Self::Fit | Self::Own(_))
    }

    /// The body whose shape it has, if it has that of one.
    pub fn own_side(self) -> Option<Side> {
        match self {
            Self::Own(side) => Some(side),
            Self::Fit | Self::Line | Self::Geometry => None,
        }
    }
}

/// Gap of the unloaded configuration.
#[derive(Clone, Debug)]
pub enum GapChoice {
    /// The bodies touch along the curve: zero.
    Closed,
    /// Measured between the bodies' smooth boundaries: declared geometries, straight lines, or splines through nodes.
    Geometry,
    /// A formula of `x, y` on the curve (a number is a constant formula; negative: interference).
    Formula(Formula),
}

impl GapChoice {
    /// Gap of the unloaded bodies at a point of Γ_C, from the distances of both along the normal from there.
    pub fn at_rest(&self, x: Point, distance: [f64; 2]) -> f64 {
        match self {
            Self::Closed => 0.0,
            Self::Formula(formula) => formula.value(&[x.x, x.y]),
            Self::Geometry => distance[1] - distance[0],
        }
    }
}

/// Space of the contact pressure on the segments.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MultiplierSpace {
    /// One value per segment.
    P0,
    /// Two values per segment.
    P1Discontinuous,
    /// One value per segment end.
    P1Continuous,
}

/// How the contact boundary is cut into segments.
#[derive(Clone, Debug, PartialEq)]
pub enum SegmentRule {
    /// By the safe rule: a multiple of the softer body's edge length.
    Auto,
    /// This number of segments of equal arc length.
    Count(usize),
    /// At these fractions of the arc length, from 0 to 1, ascending; along the parameter of a geometry, along a line to
    /// larger x (upwards if it is vertical).
    Fractions(Vec<f64>),
}

/// Contact law.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Law {
    /// Pressure or gap: λ ≥ 0, g ≥ 0, λ g = 0.
    Unilateral,
    /// Equal normal displacement, λ of either sign, free sliding.
    Bilateral,
}
