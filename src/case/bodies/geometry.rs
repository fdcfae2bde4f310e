//! `[geometry.NAME]`, and curves of the plane as such tables and those of rigid tools have them.

use crate::case::keys::*;
use crate::geometry::{Curve, Formula, ParametricCurve};

declare! {
    /// The true shape of boundaries: nodes move onto it, P2 edges are curved, gaps are measured from it.
    static GEOMETRY = table("geometry")
        .rules(&[TableRule::OneOf(&[&["circle"], &["x", "y", "t"]]), TableRule::Alone("circle", &["x", "y", "t"])]);
    /// The physical curves of this shape; also those between parts of a body.
    const CURVES: Vec<String> = key("curves", NAMES).required("[\"lower.seam\", \"upper.seam\"]");
    ..SURFACE;
}

declare! {
    group SURFACE;
    /// The curve, by formulas of t.
    const X: Formula = key("x", ALONG).like("\"t\", or circle = { centre = [0, 0], radius = 1 }").unit("length");
    /// The curve, by formulas of t.
    const Y: Formula = key("y", ALONG).like("\"t^2\", or circle = { centre = [0, 0], radius = 1 }").unit("length");
    /// The range of t, `[0, 4]`; ascending.
    const T: [f64; 2] = key("t", array(&NUMBER, "two numbers")).refused(ASCENDING)
        .like("[0, 1], or circle = { centre = [0, 0], radius = 1 }");
    /// Instead of `x`, `y` and `t`: `{ centre = [0, 0], radius = 1 }`.
    const INNER_CIRCLE: toml::Table = key("circle", inner(&CIRCLE));
}

declare! {
    static CIRCLE = table("circle").inline();
    /// Its centre.
    const CENTRE: [f64; 2] = key("centre", POINT).required("[0, 0]").unit("length");
    /// Its radius.
    const RADIUS: f64 = key("radius", ABOVE_ZERO).required("1.0").unit("length");
}

/// A formula along a curve.
const ALONG: FormOf<Formula> = formula(&["t"], ANY);
const ASCENDING: &str = "must be two ascending numbers, the range of t";

/// True shape of some boundaries.
#[derive(Clone, Debug, PartialEq)]
pub struct Geometry {
    /// Name in the case file.
    pub name: String,
    /// Physical curves that have this shape.
    pub curves: Vec<String>,
    /// The shape.
    pub curve: Curve,
}

/// `[geometry.NAME]`; the curves alone are enough to look for names.
pub fn read_geometry(section: &Section) -> Option<Geometry> {
    let curves = section.required(CURVES);
    let curve = read_surface(section).unwrap_or(Curve::Circle { centre: [0.0; 2], radius: 1.0 });
    Some(Geometry { name: section.name().into(), curves: curves?, curve })
}

/// A curve: `circle`, or `x`, `y`, `t`.
pub fn read_surface(section: &Section) -> Option<Curve> {
    match (section.has_any(&["x", "y", "t"]), section.has("circle")) {
        (true, true) => {
            section.problem(&["circle"], "stands beside x, y, t; give either circle or formulas");
            None
        }
        (false, true) => {
            let circle = section.table("circle");
            let (centre, radius) = (circle.required(CENTRE), circle.required(RADIUS));
            Some(Curve::Circle { centre: centre?, radius: radius? })
        }
        _ => read_parametric(section),
    }
}

fn read_parametric(section: &Section) -> Option<Curve> {
    let (x, y) = (section.required(X), section.required(Y));
    let ascending = |range: [f64; 2]| if range[0] < range[1] { Ok(range) } else { Err(ASCENDING.into()) };
    let range = section.made("t", section.required(T), ascending);
    let (x, y, range) = (x?, y?, range?);
    if x.as_constant().is_some() && y.as_constant().is_some() {
        section.problem(&["x"], "neither x nor y depends on t, so the curve is a point; use t");
        return None;
    }
    for (key, formula) in [("x", &x), ("y", &y)] {
        if let Some(t) = range.iter().find(|t| !formula.value(&[**t]).is_finite()) {
            section.problem(&[key], format!("is not finite at t = {t}; correct the formula or the range of t"));
            return None;
        }
    }
    Some(Curve::Parametric(ParametricCurve::new(x, y, range)))
}

/// A boundary has one shape.
pub fn check_geometries(geometries: &[Geometry], root: &Section) {
    for (index, geometry) in geometries.iter().enumerate() {
        for other in &geometries[..index] {
            if let Some(curve) = geometry.curves.iter().find(|curve| other.curves.contains(curve)) {
                let words = format!("geometry.{} lists \"{curve}\" too; a boundary has one shape", other.name);
                root.problem(&["geometry", &geometry.name, "curves"], words);
            }
        }
    }
}
