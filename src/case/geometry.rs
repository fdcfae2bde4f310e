//! `[geometry.NAME]`, and curves as such tables say them.

use super::Geometry;
use super::section::Section;
use super::values;
use crate::geometry::{Curve, ParametricCurve};

/// `[geometry.NAME]`
pub fn read_geometry(section: &Section) -> Option<Geometry> {
    let curves = section.required("curves", values::names);
    // What is bad is in the log; the curves alone are enough to look for names.
    let curve = read_surface(section).unwrap_or(Curve::Circle { centre: [0.0; 2], radius: 1.0 });
    Some(Geometry { name: section.name().into(), curves: curves?, curve })
}

/// A curve: `circle`, or `x`, `y`, `t`.
pub fn read_surface(section: &Section) -> Option<Curve> {
    let parametric = ["x", "y", "t"].map(|key| section.has(key));
    match (section.has("circle"), parametric.contains(&true)) {
        (true, true) => {
            section.problem(&["circle"], "stands beside x, y, t; give either circle or formulas".into());
            None
        }
        (true, false) => read_circle(section),
        _ => read_parametric(section),
    }
}

fn read_circle(section: &Section) -> Option<Curve> {
    let circle = section.table("circle");
    let centre = circle.required("centre", values::point);
    let radius = circle.required("radius", values::number);
    Some(Curve::Circle { centre: centre?, radius: radius? })
}

fn read_parametric(section: &Section) -> Option<Curve> {
    let x = section.required("x", values::formula(&["t"]));
    let y = section.required("y", values::formula(&["t"]));
    let range = section.required("t", |value| match values::point(value) {
        Ok(range) if range[0] < range[1] => Ok(range),
        _ => Err("must be two ascending numbers, the range of t".into()),
    });
    let (x, y, range) = (x?, y?, range?);
    if x.as_constant().is_some() && y.as_constant().is_some() {
        section.problem(&["x"], "neither x nor y depends on t, so the curve is a point; use t".into());
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
