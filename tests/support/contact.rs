//! The two bars of example 1 in contact, for programs that use the crate's parts.

use mezha::body::{Load, LoadKind, Support};
use mezha::contact::{
    Configuration, CurveChoice, EndRule, GapChoice, Law, MultiplierSpace, Pair, Quadrature, SegmentRule, Stabilise,
};
use mezha::discretisation::Scene;
use mezha::geometry::Formula;

/// Two bars pressed together by a load on the upper one and by the support of the lower one.
pub fn with_contact(mut scene: Scene, space: MultiplierSpace, segments: usize, stabilise: Stabilise) -> Scene {
    let support = |on: &str, ux: Option<f64>, uy: Option<f64>| {
        let [ux, uy] = [ux, uy].map(|value| value.map(Formula::constant));
        Support { name: on.into(), on: vec![on.into()], at: None, ux, uy, normal: None }
    };
    scene.supports = vec![support("left", Some(0.0), None), support("bottom", None, Some(0.01))];
    let kind = LoadKind::Pressure(Formula::constant(1.0));
    scene.loads = vec![Load { name: "top".into(), on: vec!["top".into()], kind }];
    scene.pairs = vec![Pair {
        name: "seam".into(),
        between: ["lower.seam".into(), "upper.seam".into()],
        curve: CurveChoice::Line,
        gap: GapChoice::Formula(Formula::constant(1e-3)),
        space,
        segments: SegmentRule::Count(segments),
        law: Law::Unilateral,
        quadrature: Quadrature::Cut,
        stabilise,
        configuration: Configuration::Reference,
        spans: None,
        grading: [1.0; 2],
        ends: EndRule::Fixed,
    }];
    scene
}
