//! What the figure of a scene shows: bodies, boundaries, supports, loads and contacts.

use crate::output::units::Units;

/// A point of a boundary and the outward normal there.
#[derive(Clone, Copy, Debug)]
pub struct BoundaryPoint {
    /// Where.
    pub place: [f64; 2],
    /// Outward unit normal.
    pub normal: [f64; 2],
    /// What acts there: a traction, or nothing.
    pub traction: [f64; 2],
}

/// Pieces of a boundary, each a row of points.
pub type Rows = Vec<Vec<BoundaryPoint>>;

/// A body, or a part of one.
#[derive(Clone, Debug, Default)]
pub struct DrawnPart {
    /// What it is called; rigid tools are drawn in grey.
    pub name: String,
    /// Whether it is a rigid tool.
    pub is_rigid: bool,
    /// Its triangles: points around each, counter-clockwise.
    pub triangles: Vec<Vec<[f64; 2]>>,
    /// A point well inside it.
    pub inside: [f64; 2],
}

/// What a support holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Grip {
    /// Both components.
    Both,
    /// The one along this direction.
    Along([f64; 2]),
    /// The normal one.
    Normal,
    /// Springs.
    Springs,
}

/// A support.
#[derive(Clone, Debug)]
pub struct DrawnSupport {
    /// Its name.
    pub name: String,
    /// What it prescribes.
    pub words: String,
    /// Where it stands.
    pub rows: Rows,
    /// What it holds.
    pub grip: Grip,
}

/// A load.
#[derive(Clone, Debug, Default)]
pub struct DrawnLoad {
    /// Its name.
    pub name: String,
    /// What it is.
    pub words: String,
    /// Where it acts, with tractions there.
    pub rows: Rows,
    /// A resultant instead, of a stiff plate, a point or a body: where, and its direction.
    pub resultant: Option<([f64; 2], [f64; 2])>,
    /// Whether a stiff plate carries it.
    pub is_plate: bool,
    /// Number of the part in which it acts as a body force.
    pub part: Option<usize>,
}

/// Something with a name along a boundary.
#[derive(Clone, Debug)]
pub struct NamedRows {
    /// Its name.
    pub name: String,
    /// Where it is.
    pub rows: Rows,
    /// Where its name belongs; nothing if anywhere along it.
    pub place: Option<BoundaryPoint>,
}

/// What is drawn of a scene.
#[derive(Clone, Debug, Default)]
pub struct SceneFigure {
    /// Stands above.
    pub title: String,
    /// Bodies, or their parts.
    pub parts: Vec<DrawnPart>,
    /// Edges of the macro mesh, each a row of points.
    pub edges: Vec<Vec<[f64; 2]>>,
    /// Named boundaries.
    pub boundaries: Vec<NamedRows>,
    /// Contacts, on both bodies.
    pub contacts: Vec<NamedRows>,
    /// Supports.
    pub supports: Vec<DrawnSupport>,
    /// Loads.
    pub loads: Vec<DrawnLoad>,
    /// Whether the bodies are bodies of revolution, drawn with their axis.
    pub has_axis: bool,
    /// The units of the case.
    pub units: Units,
    /// What is wrong with the case.
    pub remarks: Vec<String>,
}

impl BoundaryPoint {
    /// The point at a share of the way to another one.
    pub fn towards(&self, other: &Self, share: f64) -> Self {
        let between = |a: [f64; 2], b: [f64; 2]| [0, 1].map(|axis| a[axis] + share * (b[axis] - a[axis]));
        Self {
            place: between(self.place, other.place),
            normal: between(self.normal, other.normal),
            traction: between(self.traction, other.traction),
        }
    }
}
