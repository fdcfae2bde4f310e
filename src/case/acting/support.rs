//! `[support.NAME]`: displacements that are prescribed.

use super::mean::{HOLDS_MEAN, MEAN_MOTIONS, MeanSupport, read_mean};
use super::spot::{Where, read_where};
use super::springs::{STIFFNESS, read_springs};
use crate::body::{Springs, Support};
use crate::case::keys::{IN_PLANE, Key, NAME, NAMES, POINT, Section, TableRule, declare, inner, key, table};
use crate::geometry::Formula;

declare! {
    static SUPPORT = table("support").rules(RULES);
    /// The physical curves that are held.
    const ON: Vec<String> = key("on", NAMES).like("\"bottom\", or at = [0.0, 1.0] for a point");
    /// Instead of `on`: a point of a body, whether the mesh has a vertex there or not, see [points](#points); with `ux`, `uy` or
    /// both.
    const AT: [f64; 2] = key("at", POINT).unit("length");
    /// Beside `at`, where two bodies touch: the one that is held. Beside `mean`: the body. A [pattern](#patterns) stands for a
    /// support on each body.
    const BODY: String = key("body", NAME).or_else("the one that is there").like("\"disc\"");
    ..HOLDS_MEAN;
    /// Prescribed displacement.
    const UX: Formula = prescribed("ux");
    /// Prescribed displacement.
    const UY: Formula = prescribed("uy");
    ..MEAN_MOTIONS;
    /// Instead of `ux` and `uy`: displacement along the outward normal, tangent free.
    const NORMAL: Formula = prescribed("normal");
    /// Instead, on physical curves: springs, as force per length of the boundary and per displacement. `{ normal = 100 }`, which
    /// pull as well as push, or `{ x = 100, y = 50 }`, or one of these; nowhere below 0.
    const SPRINGS: toml::Table = key("stiffness", inner(&STIFFNESS)).or_else("no springs");
}

const fn prescribed(name: &'static str) -> Key<Formula> {
    key(name, IN_PLANE).or_else("free").unit("length")
}

const RULES: &[TableRule] = &[
    TableRule::OneOf(&[&["ux"], &["uy"], &["normal"], &["angle"], &["along"], &["tangential"], &["stiffness"]]),
    TableRule::OneOf(&[&["on"], &["at"], &["body", "mean"]]),
    TableRule::Beside("body", &["at", "mean"]),
    TableRule::Beside("angle", &["mean"]),
    TableRule::Beside("along", &["mean"]),
    TableRule::Beside("tangential", &["mean"]),
    TableRule::Beside("along", &["direction"]),
    TableRule::Beside("direction", &["along"]),
    TableRule::Beside("tangential", &["about"]),
    TableRule::Beside("about", &["tangential"]),
    TableRule::Alone("at", &["on", "normal", "stiffness"]),
    TableRule::Alone("mean", &["on", "at", "normal", "stiffness"]),
    TableRule::Alone("normal", &["ux", "uy"]),
    TableRule::Alone("stiffness", &["ux", "uy", "normal", "body", "angle"]),
];

/// What all tables `[support.NAME]` say.
#[derive(Default)]
pub struct Supports {
    /// Where displacements are prescribed.
    pub supports: Vec<Support>,
    /// Where springs stand.
    pub springs: Vec<Springs>,
    /// Where the mean motion of a body is held.
    pub means: Vec<MeanSupport>,
}

/// `[support.NAME]`, put with those of its kind; nothing if it is bad.
pub fn read_support(section: &Section, root: &Section, all: &mut Supports) -> Option<()> {
    if section.has("mean") {
        return read_mean(section, BODY).map(|support| all.means.push(support));
    }
    if section.has("stiffness") {
        return read_springs(section, ON).map(|support| all.springs.push(support));
    }
    let place = read_where(section, root, ON, AT, BODY);
    let given = ["ux", "uy", "normal"].map(|key| section.has(key));
    let [ux, uy, normal] = [UX, UY, NORMAL].map(|key| section.optional(key));
    match given {
        [false, false, false] => {
            section.problem(&[], "prescribes nothing; give ux, uy or normal, or stiffness = { normal = 1.0 } for springs")
        }
        [_, _, true] if given[0] || given[1] => {
            section.problem(&["normal"], "cannot stand beside ux or uy; make two supports on different curves");
        }
        [_, _, true] if section.has("at") => {
            section.problem(&["normal"], "stands beside at: a point has no normal; give ux, uy or both");
        }
        _ => {}
    }
    let Where { on, at } = place?;
    all.supports.push(Support { name: section.name().into(), on, at, ux, uy, normal });
    Some(())
}
