//! Points of bodies that the case names.

/// A point of a body that the case names.
#[derive(Clone, Debug, PartialEq)]
pub struct Spot {
    /// Where (length).
    pub place: [f64; 2],
    /// The body that is meant, where two may touch.
    pub body: Option<String>,
}

/// A point that the case names, and the vertex there.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedPoint {
    /// What the case says.
    pub spot: Spot,
    /// The vertex.
    pub vertex: u32,
}
