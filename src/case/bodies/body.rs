//! `[body.NAME]` and its parts: materials, and forces all over a body.

use toml::{Table, Value};

use super::gravity::{Gravity, read_weight, with_weight};
use crate::body::{Body, BodyPart, Material};
use crate::case::keys::*;
use crate::element::{Heat, Plane};
use crate::geometry::Formula;

declare! {
    /// NAME is the physical surface, or the name of a body of several, which are its parts; every surface of the mesh needs its
    /// constants.
    static BODY = table("body").rules(&[
        TableRule::OneOf(&[&["part"], &["young", "poisson"]]),
        TableRule::Alone("part", &["young", "poisson", "body_force", "density", "expansion", "temperature"]),
    ]);
    ..CONSTANTS;
    /// In this body and all of its parts.
    const PLANE: Plane = key("plane", PLANE_LAW).or_else("that before all tables");
    const PARTS: toml::Table = key("part", some_named(&PART, "SURFACE"));
}

declare! {
    /// SURFACE is a physical surface that is a part of this body, and has its constants in the place of the body's own: see
    /// [materials and the plane](#materials-and-the-plane).
    static PART = table("part").rules(&[TableRule::OneOf(&[&["young", "poisson"]])]);
    ..CONSTANTS;
}

declare! {
    group CONSTANTS;
    /// Young's modulus E.
    const YOUNG: f64 = key("young", number(within(1e-100, 1e100).or_words("must be above 0, and lie in [1e-100, 1e100]")))
        .like("7000.0").unit("force per area");
    /// Poisson's ratio ν; 0.5 in plane stress only.
    const POISSON: f64 = key("poisson", number(RATIOS)).like("0.3");
    /// `[fx, fy]`, force per area and thickness.
    const BODY_FORCE: [Formula; 2] = key("body_force", VECTOR).or("[0.0, 0.0]").unit("force per volume");
    /// Mass per area and thickness; with `[gravity]` the force per area density · g is added to `body_force`.
    const DENSITY: f64 = key("density", ABOVE_ZERO).or_else("no weight").unit("mass per volume");
    /// Coefficient of linear expansion α, beside `temperature`; see [heat](#heat).
    const EXPANSION: f64 = key("expansion", NUMBER).like("1.2e-5").unit("1/temperature");
    /// Difference ϑ to the temperature without stress, beside `expansion`: strains `α ϑ` in all directions.
    const TEMPERATURE: Formula = key("temperature", IN_PLANE).like("\"100.0 - 2.0*x\"").unit("temperature");
}

/// What the plane may stand for.
pub const PLANE_LAW: FormOf<Plane> = word();
const RATIOS: NumberRange =
    NumberRange { above: Some(-1.0), most: Some(0.5), words: "must lie in (-1, 0.5); in plane stress 0.5 may be, too", ..ANY };

words! { Plane: "strain" => Strain, "stress" => Stress, "axisymmetric" => Revolution }

/// `[body.NAME]`; `plane` holds where it says nothing else.
pub fn read_body(section: &Section, plane: Plane, gravity: Gravity) -> Option<Body> {
    let plane = section.optional(PLANE).unwrap_or(plane);
    let name = section.name().to_owned();
    if !section.has("part") {
        let part = read_part(section, plane, gravity)?;
        return Some(Body { name, parts: vec![part] });
    }
    section.refuse(
        &["young", "poisson", "body_force", "density", "expansion", "temperature"],
        "stands beside parts of this body; give it in each of their tables",
    );
    let parts = section.named("part", |section| read_part(section, plane, gravity));
    if section.names_below("part").next().is_none() {
        section.problem(&["part"], format!("names no part; write [body.{name}.part.SURFACE] for each physical surface of it"));
    }
    if section.names_below("part").any(|part| part == name) {
        section.problem(&["part", &name], "a part cannot have the name of its body; give the body another one");
    }
    Some(Body { name, parts })
}

/// The constants of a physical surface; where they are bad, there is a body of this name all the same.
fn read_part(section: &Section, plane: Plane, gravity: Gravity) -> Option<BodyPart> {
    let young = section.required(YOUNG);
    let poisson = section.made("poisson", section.required(POISSON), |ratio| match (ratio, plane) {
        (0.5, Plane::Strain | Plane::Revolution) => {
            Err("must lie in (-1, 0.5); 0.5 is incompressible, for which displacement elements lock: take 0.49".into())
        }
        _ => Ok(ratio),
    });
    let force = section.or_default(BODY_FORCE);
    let (weight, heat) = (read_weight(section, DENSITY, gravity), read_heat(section));
    let material = Material { young: young.unwrap_or(1.0), poisson: poisson.unwrap_or(0.0), plane };
    let force = with_weight(force, weight.unwrap_or_default());
    Some(BodyPart { name: section.name().into(), material, force, heat })
}

/// `expansion` and `temperature`: each of them alone does nothing.
fn read_heat(section: &Section) -> Option<Heat> {
    let (expansion, temperature) = (section.optional(EXPANSION), section.optional(TEMPERATURE));
    match (section.has("expansion"), section.has("temperature")) {
        (false, true) => {
            section.problem(&["temperature"], "strains nothing without expansion, the strain by degree; give it, too");
        }
        (true, false) => {
            let words = "does nothing without temperature, the difference to that without stress; give it, too";
            section.problem(&["expansion"], words);
        }
        _ => {}
    }
    Some(Heat { expansion: expansion?, temperature: temperature? })
}

/// A physical surface belongs to one body.
pub fn check_parts(bodies: &[Body], root: &Section) {
    for (at, body) in bodies.iter().enumerate() {
        for part in body.parts.iter().filter(|_| body.has_parts()) {
            let mut others = bodies.iter().enumerate().filter(|(other, _)| *other != at).map(|(_, other)| other);
            let has = |other: &&Body| other.name == part.name || other.parts.iter().any(|theirs| theirs.name == part.name);
            if let Some(other) = others.find(has) {
                let words = format!("body.{} has this name too; a physical surface belongs to one body", other.name);
                root.problem(&["body", &body.name, "part", &part.name], words);
            }
        }
    }
}

/// Names of all bodies, and of their parts.
pub fn region_names<'a>(root: &Section<'a>) -> Vec<&'a str> {
    root.names_below("body").chain(root.names_two_below("body", "part")).collect()
}

/// The table of a body, and those of its parts if it has any, each with its path from there.
pub fn with_parts(body: &Table) -> impl Iterator<Item = (Vec<String>, &Table)> {
    let parts = body.get("part").and_then(Value::as_table).into_iter().flatten();
    let parts = parts.filter_map(|(name, part)| Some((vec!["part".to_owned(), name.clone()], part.as_table()?)));
    [(Vec::new(), body)].into_iter().chain(parts)
}

/// Gravity wants bodies that are heavy.
pub fn check_gravity(gravity: Gravity, root: &Section) {
    let is_heavy = |body: &Table| with_parts(body).any(|(_, table)| table.contains_key("density"));
    let mut bodies = root.names_below("body").filter_map(|name| root.below("body", name));
    if matches!(gravity, Gravity::Acceleration(_)) && !bodies.any(is_heavy) {
        root.problem(&["gravity"], "acts on nothing; give density, mass per area and thickness, in some [body.NAME]");
    }
}

/// There is something to solve for.
pub fn check_bodies(root: &Section) {
    if root.names_below("body").next().is_none() {
        root.problem(&["body"], "missing; write [body.NAME] for every physical surface of the mesh");
    }
}
