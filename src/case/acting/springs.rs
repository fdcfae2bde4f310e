//! `[support.NAME]` with `stiffness`: springs.

use crate::body::{SpringStiffness, Springs};
use crate::case::keys::{Key, PLANE, POSITIVE, Section, TableRule, declare, formula, key, table};
use crate::geometry::Formula;

declare! {
    static STIFFNESS = table("stiffness").inline()
        .rules(&[TableRule::OneOf(&[&["normal"], &["x"], &["y"]]), TableRule::Alone("normal", &["x", "y"])]);
    /// Springs along the outward normal.
    const NORMAL: Formula = spring("normal");
    /// Springs along the axes.
    const X: Formula = spring("x");
    /// Springs along the axes.
    const Y: Formula = spring("y");
}

const fn spring(name: &'static str) -> Key<Formula> {
    let range = POSITIVE.or_words("must be > 0: force per length and displacement");
    key(name, formula(&PLANE, range)).unit("force per volume")
}

/// Springs: `stiffness` instead of displacements.
pub fn read_springs(section: &Section, on: Key<Vec<String>>) -> Option<Springs> {
    section.refuse(
        &["ux", "uy", "normal"],
        "stands beside stiffness: springs prescribe nothing; make two supports, or leave one out",
    );
    let on = if section.has("at") {
        section.problem(&["at"], "stands beside stiffness: springs stand on physical curves, by their length; give on");
        section.optional(on)
    } else {
        section.required(on)
    };
    if !section.has_table("stiffness") {
        section.problem(&["stiffness"], "must be a table, as { normal = 100.0 } or { x = 100.0, y = 50.0 }");
        return None;
    }
    let stiffness = section.table("stiffness");
    let [normal, x, y] = [NORMAL, X, Y].map(|key| stiffness.optional(key));
    let axes = stiffness.has("x") || stiffness.has("y");
    match (stiffness.has("normal"), axes) {
        (false, false) => stiffness.problem(&[], "holds nothing; give normal, or x and y: force per length and displacement"),
        (true, true) => stiffness.problem(&["normal"], "stands beside x or y; make two supports"),
        _ => {}
    }
    let kind =
        if axes { SpringStiffness::Axes([x, y]) } else { SpringStiffness::Normal(normal.unwrap_or(Formula::constant(0.0))) };
    Some(Springs { name: section.name().into(), on: on?, stiffness: kind })
}
