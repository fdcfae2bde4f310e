//! `[support.NAME]`: displacements that are prescribed, and springs.

use toml::Value;

use super::error::suggest;
use super::section::Section;
use super::spot::{Where, read_where};
use super::values::{self, PLANE};
use crate::body::{MOTIONS, MeanHold, SpringStiffness, Springs, Support};
use crate::geometry::Formula;

/// What a table `[support.NAME]` says.
pub enum SupportTable {
    /// Displacements are prescribed.
    Fixed(Support),
    /// Springs stand there.
    Elastic(Springs),
    /// The mean motion of a body is held.
    Mean(MeanHold),
}

/// The supports that prescribe displacements, the elastic ones, and those that hold mean motions.
pub fn split(all: Vec<SupportTable>) -> (Vec<Support>, Vec<Springs>, Vec<MeanHold>) {
    let (mut supports, mut springs, mut means) = (Vec::new(), Vec::new(), Vec::new());
    for support in all {
        match support {
            SupportTable::Fixed(support) => supports.push(support),
            SupportTable::Elastic(support) => springs.push(support),
            SupportTable::Mean(support) => means.push(support),
        }
    }
    (supports, springs, means)
}

/// `[support.NAME]`
pub fn read_support(section: &Section) -> Option<SupportTable> {
    if section.has("mean") {
        return read_mean(section).map(SupportTable::Mean);
    }
    if section.has("stiffness") {
        return read_springs(section).map(SupportTable::Elastic);
    }
    let place = read_where(section);
    let given = ["ux", "uy", "normal"].map(|key| section.has(key));
    let component = |key| section.optional(key, values::formula(&PLANE));
    let [ux, uy, normal] = ["ux", "uy", "normal"].map(component);
    match given {
        [false, false, false] => {
            section.problem(&[], "prescribes nothing; give ux, uy or normal, or stiffness = { normal = 1.0 } for springs".into())
        }
        [_, _, true] if given[0] || given[1] => {
            section.problem(&["normal"], "cannot stand beside ux or uy; make two supports on different curves".into());
        }
        [_, _, true] if section.has("at") => {
            section.problem(&["normal"], "stands beside at: a point has no normal; give ux, uy or both".into());
        }
        _ => {}
    }
    let Where { on, at } = place?;
    Some(SupportTable::Fixed(Support { name: section.name().into(), on, at, ux, uy, normal }))
}

/// The mean motion of a body: `mean = true` beside `body`.
fn read_mean(section: &Section) -> Option<MeanHold> {
    section.optional("mean", values::boolean);
    for key in ["on", "at", "normal", "stiffness"].into_iter().filter(|key| section.has(key)) {
        let words = "stands beside mean = true, which holds a whole body; give body, and ux, uy, angle or several of them";
        section.problem(&[key], words.into());
    }
    let mean = MOTIONS.map(|key| section.optional(key, values::number));
    if !MOTIONS.iter().any(|key| section.has(key)) {
        section.problem(&[], "holds no mean motion; give ux, uy or angle, or several of them, as in ux = 0.0".into());
    }
    let body = section.required("body", values::name)?;
    Some(MeanHold { name: section.name().into(), body, mean })
}

/// Bodies whose mean motion is held are bodies of the case, and each motion of one is held once.
pub fn check_means(means: &[MeanHold], root: &Section) {
    for (at, hold) in means.iter().enumerate() {
        if !root.names_below("body").any(|known| *known == hold.body) {
            let words = format!("no such body; {}", suggest(&hold.body, root.names_below("body")));
            root.problem(&["support", &hold.name, "body"], words);
        }
        if let Some(other) = means[..at].iter().find(|other| other.body == hold.body) {
            let words = format!("support.{} holds a mean motion of this body, too; make one support of both", other.name);
            root.problem(&["support", &hold.name, "body"], words);
        }
    }
}

/// Springs: `stiffness` instead of displacements.
fn read_springs(section: &Section) -> Option<Springs> {
    for key in ["ux", "uy", "normal"].into_iter().filter(|key| section.has(key)) {
        section.problem(&[key], "stands beside stiffness: springs prescribe nothing; make two supports, or leave one out".into());
    }
    let on = if section.has("at") {
        let words = "stands beside stiffness: springs stand on physical curves, by their length; give on";
        section.problem(&["at"], words.into());
        section.optional("on", values::names)
    } else {
        section.required("on", values::names)
    };
    if !section.has_table("stiffness") {
        section.problem(&["stiffness"], "must be a table, as { normal = 100.0 } or { x = 100.0, y = 50.0 }".into());
        return None;
    }
    let stiffness = section.table("stiffness");
    let normal = stiffness.optional("normal", spring);
    let [x, y] = ["x", "y"].map(|key| stiffness.optional(key, spring));
    let axes = stiffness.has("x") || stiffness.has("y");
    match (stiffness.has("normal"), axes) {
        (false, false) => {
            stiffness.problem(&[], "holds nothing; give normal, or x and y: force per length and displacement".into())
        }
        (true, true) => stiffness.problem(&["normal"], "stands beside x or y; make two supports".into()),
        _ => {}
    }
    let kind =
        if axes { SpringStiffness::Axes([x, y]) } else { SpringStiffness::Normal(normal.unwrap_or(Formula::constant(0.0))) };
    Some(Springs { name: section.name().into(), on: on?, stiffness: kind })
}

/// A stiffness: a formula, or a number above zero.
fn spring(value: &Value) -> Result<Formula, String> {
    let formula = values::formula(&PLANE)(value)?;
    match formula.as_constant() {
        Some(constant) if constant <= 0.0 => Err("must be > 0: force per length and displacement".into()),
        _ => Ok(formula),
    }
}
