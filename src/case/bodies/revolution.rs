//! `plane = "axisymmetric"`: what a body of revolution about the axis x = 0 cannot have.

use super::gravity::Gravity;
use crate::body::Body;
use crate::case::keys::Section;
use crate::case::keys::values::number;
use crate::element::Plane;
use toml::Value;

/// What moves a body across the axis, or turns it.
const NOT_ALONG: [&str; 6] = ["ux", "angle", "moment", "direction", "tangential", "about"];

/// Refuses what only bodies in the plane can have: a plane of their own, a thickness, weights, forces and prescribed motions
/// of whole bodies across the axis.
pub fn check(plane: Plane, bodies: &[Body], gravity: Gravity, root: &Section) {
    let of_bodies = |body: &Body| body.parts.iter().map(|part| part.material.plane).next();
    if let Some(body) =
        bodies.iter().find(|body| of_bodies(body).is_some_and(|own| (own == Plane::Revolution) != (plane == Plane::Revolution)))
    {
        let words = "all bodies are of revolution, or none is; write plane = \"axisymmetric\" once, before all tables";
        root.problem(&["body", &body.name, "plane"], words);
    }
    if plane != Plane::Revolution {
        return;
    }
    if root.has("thickness") {
        root.problem(
            &["thickness"],
            "a body of revolution has none: forces and energies are those of the whole body; leave it out",
        );
    }
    if let Gravity::Acceleration([x, _]) = gravity
        && x != 0.0
    {
        root.problem(&["gravity", "g"], "acts along the axis of revolution alone; its x component must be 0");
    }
    let whole_bodies = [("rigid", None), ("load", Some("rigid")), ("support", Some("body"))];
    for (kind, mark) in whole_bodies {
        for name in root.names_below(kind) {
            let Some(table) = root.below(kind, name).filter(|table| mark.is_none_or(|mark| table.contains_key(mark))) else {
                continue;
            };
            // A case of the plane may hold what is held here anyway.
            let moves = |key: &&str| table.get(*key).is_some_and(|value| number(value) != Ok(0.0));
            for key in NOT_ALONG.into_iter().filter(moves).filter(|key| !(kind == "rigid" && *key == "about")) {
                root.problem(&[kind, name, key], "a body of revolution moves along its axis alone; leave it out");
            }
            let force = table.get("force").and_then(Value::as_array).and_then(|force| force.first());
            if force.is_some_and(|x| number(x).is_ok_and(|x| x != 0.0)) {
                root.problem(&[kind, name, "force"], "acts along the axis of revolution alone; its x component must be 0");
            }
        }
    }
}
