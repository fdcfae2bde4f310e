//! `[support.NAME]`: displacements that are prescribed, and springs.

use toml::Value;

use super::Case;
use super::error::suggest;
use super::section::Section;
use super::spot::{Where, read_where};
use super::values::{self, PLANE};
use crate::body::{HeldMode, MOTIONS, MeanHold, SpringStiffness, Springs, Support, UNIT_MOTIONS};
use crate::geometry::{Formula, Point};
use crate::mesh::MacroMesh;

/// What a table `[support.NAME]` says.
pub enum SupportTable {
    /// Displacements are prescribed.
    Fixed(Support),
    /// Springs stand there.
    Elastic(Springs),
    /// The mean motion of a body is held.
    Mean(MeanSupport),
}

/// A body whose mean motion is held, as the case says it.
#[derive(Clone, Debug, PartialEq)]
pub struct MeanSupport {
    /// Name in the case file.
    pub name: String,
    /// Name of the body.
    pub body: String,
    /// The key of each motion that is held, along which way, and how far it is (length, or radians).
    pub held: Vec<(&'static str, MeanWay, f64)>,
}

/// Which way a body is held in the mean.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MeanWay {
    /// In a direction, a unit vector.
    Along(Point),
    /// Around a centre, at the middle of the body, to the left of the line that comes from the centre.
    Around(Point),
    /// Turning about its middle.
    Turning,
}

/// A middle that is nearer to a centre than this share of the size of its body is the centre.
const AT_CENTRE: f64 = 1e-6;

impl MeanSupport {
    /// The rigid modes that it holds of the body of a mesh, about its middle there.
    ///
    /// # Errors
    /// Words for a body that has its middle where it is to go around.
    fn hold(&self, mesh: &MacroMesh) -> Result<MeanHold, String> {
        let mut hold = MeanHold { name: self.name.clone(), body: self.body.clone(), held: Vec::new() };
        let middle = hold.middle(mesh);
        for &(key, way, value) in &self.held {
            let mode = match way {
                MeanWay::Along(direction) => [direction.x, direction.y, 0.0],
                MeanWay::Turning => UNIT_MOTIONS[2],
                MeanWay::Around(centre) => {
                    let arm = middle - centre;
                    if arm.norm() <= AT_CENTRE * hold.reach(mesh) {
                        let at = format!("about = [{}, {}]", centre.x, centre.y);
                        return Err(format!("the middle of \"{}\" is at {at}: it goes around nothing; give angle", self.body));
                    }
                    let out = arm.normalize();
                    [-out.y, out.x, 0.0]
                }
            };
            hold.held.push(HeldMode { key, mode, value });
        }
        Ok(hold)
    }
}

impl Case {
    /// The bodies whose mean motion is held, on the first mesh of the case.
    ///
    /// # Errors
    /// Words with the support for a body that has its middle where it is to go around.
    pub fn mean_holds(&self, mesh: &MacroMesh) -> Result<Vec<MeanHold>, String> {
        let hold = |mean: &MeanSupport| mean.hold(mesh).map_err(|words| format!("support.{}: {words}", mean.name));
        self.means.iter().map(hold).collect()
    }
}

/// The supports that prescribe displacements, the elastic ones, and those that hold mean motions.
pub fn split(all: Vec<SupportTable>) -> (Vec<Support>, Vec<Springs>, Vec<MeanSupport>) {
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
fn read_mean(section: &Section) -> Option<MeanSupport> {
    section.optional("mean", values::boolean);
    for key in ["on", "at", "normal", "stiffness"].into_iter().filter(|key| section.has(key)) {
        let words = "stands beside mean = true, which holds a whole body; give body, and ux, uy, angle or several of them";
        section.problem(&[key], words.into());
    }
    let [direction, about] = ["direction", "about"].map(|key| section.optional(key, values::point).map(Point::from));
    for (key, way) in [("along", "direction"), ("tangential", "about")] {
        match (section.has(key), section.has(way)) {
            (true, false) => section.problem(&[key], format!("wants a way; give {way} = [x, y] beside it")),
            (false, true) => section.problem(&[way], format!("holds nothing by itself; give {key} = 0.0 beside it")),
            _ => {}
        }
    }
    let direction = direction.filter(|way| {
        let is_one = way.norm() > 0.0;
        if !is_one {
            section.problem(&["direction"], "must point somewhere: not both of its numbers are 0".into());
        }
        is_one
    });
    let ways = [
        (MOTIONS[0], Some(MeanWay::Along(Point::new(1.0, 0.0)))),
        (MOTIONS[1], Some(MeanWay::Along(Point::new(0.0, 1.0)))),
        (MOTIONS[2], Some(MeanWay::Turning)),
        ("along", direction.map(|direction| MeanWay::Along(direction.normalize()))),
        ("tangential", about.map(MeanWay::Around)),
    ];
    if !ways.iter().any(|(key, _)| section.has(key)) {
        let words = "holds no mean motion; give ux, uy or angle, along beside direction, tangential beside about, or several of them, as in ux = 0.0";
        section.problem(&[], words.into());
    }
    let held = ways.into_iter().filter_map(|(key, way)| {
        let value = section.optional(key, values::number);
        Some((key, way?, value?))
    });
    let held = held.collect();
    let body = section.required("body", values::name)?;
    Some(MeanSupport { name: section.name().into(), body, held })
}

/// Bodies whose mean motion is held are bodies of the case, and each motion of one is held once.
pub fn check_means(means: &[MeanSupport], root: &Section) {
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
