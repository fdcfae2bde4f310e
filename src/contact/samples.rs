//! Contact pairs for unit tests.

use super::contact_boundary::ContactBoundary;
use super::pair::{
    Configuration, CurveChoice, EndRule, GapChoice, Law, MultiplierSpace, Pair, Quadrature, SegmentRule, Stabilise,
};
use crate::element::Order;
use crate::geometry::{Curve, Point};
use crate::mesh::samples::two_blocks;
use crate::mesh::{Level, MacroMesh, Numbering, Partition};
use std::rc::Rc;

/// Names of the boundaries on both sides of the line between the two blocks.
pub const SEAM: [&str; 2] = ["lower.seam", "upper.seam"];

/// The contact of the two blocks of [`crate::mesh::samples`] along the line between them, by the drawn gap.
pub fn seam() -> Pair {
    Pair {
        name: "seam".into(),
        between: SEAM.map(String::from),
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

/// The two blocks, each vertex of the upper one moved by a function of its place.
pub fn moved_blocks(upper: impl Fn(Point) -> Point) -> (MacroMesh, Numbering) {
    let mut mesh = two_blocks();
    let body = mesh.bodies.iter().position(|name| name == "upper").expect("a body");
    let own: Vec<u32> = mesh.triangles.iter().filter(|t| t.body as usize == body).flat_map(|t| t.vertices).collect();
    let own: std::collections::BTreeSet<u32> = own.into_iter().collect();
    for vertex in own {
        let x = &mut mesh.vertices[vertex as usize];
        *x += upper(*x);
    }
    let numbering = Numbering::new(Level { intervals: 16, order: Order::P1 }, &Rc::new(Partition::new(&mesh, &[0; 6], 1)));
    (mesh, numbering)
}

/// The part of the line between the two blocks from one x to another.
pub fn line([from, to]: [f64; 2]) -> ContactBoundary {
    ContactBoundary::new(Curve::Line([[from, 1.0], [to, 1.0]]), [0.0, 1.0], Point::new(0.0, 1.0))
}
