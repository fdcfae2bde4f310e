//! `[support.NAME]` with `mean = true`: the mean motion of a whole body is held.

use crate::body::{HeldMode, MeanHold, UNIT_MOTIONS};
use crate::case::keys::{Key, NUMBER, POINT, Section, YES, declare, key, number, within};
use crate::element::Plane;
use crate::geometry::Point;
use crate::mesh::MacroMesh;

declare! {
    group HOLDS_MEAN;
    /// Beside `body`: holds the mean motion of a whole body, see [mean motions](#mean-motions); with `ux`, `uy`, `angle`,
    /// `along`, `tangential` (numbers) or several of them.
    const MEAN: bool = key("mean", YES)
        .refused("holds a mean motion only as mean = true; leave it out for a support on = or at =");
}

declare! {
    group MEAN_MOTIONS;
    /// Beside `mean`: the mean turn about the middle of the body.
    const ANGLE: f64 = key("angle", number(within(-SMALL_TURN, SMALL_TURN))).or_else("free").unit("radians")
        .refused("must be a number from -0.1 to 0.1: radians, small ones; draw the body turned instead");
    /// Beside `along`: its direction `[x, y]`, of any length.
    const DIRECTION: [f64; 2] = key("direction", POINT).like("[1.0, 1.0]");
    /// Beside `mean` and `direction`: the mean shift in that direction.
    const ALONG: f64 = shift("along").like("0.0");
    /// Beside `tangential`: the centre `[x, y]`.
    const ABOUT: [f64; 2] = key("about", POINT).unit("length").like("[0.0, 0.0]");
    /// Beside `mean` and `about`: the mean shift of the body around that centre, along the tangent at the middle of the body,
    /// counter-clockwise.
    const TANGENTIAL: f64 = shift("tangential").like("0.0");
}

/// Largest mean turn that can be asked for (radians): beyond it a body would grow by more than half a per cent.
const SMALL_TURN: f64 = 0.1;
/// Keys of formulas, which are numbers where a mean motion is held.
const UX: Key<f64> = shift("ux");
const UY: Key<f64> = shift("uy");

const fn shift(name: &'static str) -> Key<f64> {
    key(name, NUMBER).or_else("free").unit("length")
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
    /// The rigid modes that it holds of the body of a mesh, about its middle there: of a body of revolution its shift along the axis alone.
    ///
    /// # Errors
    /// Words for a body that has its middle where it is to go around.
    pub fn hold(&self, mesh: &MacroMesh) -> Result<MeanHold, String> {
        let mut hold = MeanHold::of_body(&self.name, &self.body, mesh);
        let is_there = |key: &str| mesh.plane != Plane::Revolution || key == UY.form.name;
        for &(key, way, value) in self.held.iter().filter(|(key, ..)| is_there(key)) {
            let mode = match way {
                MeanWay::Along(direction) => [direction.x, direction.y, 0.0],
                MeanWay::Turning => UNIT_MOTIONS[2],
                MeanWay::Around(centre) => {
                    let arm = hold.middle - centre;
                    if arm.norm() <= AT_CENTRE * hold.reach {
                        let at = format!("about = [{}, {}]", centre.x, centre.y);
                        return Err(format!("the middle of \"{}\" is at {at}: it goes around nothing; give angle", self.body));
                    }
                    let out = arm.normalize();
                    [-out.y, out.x, 0.0]
                }
            };
            hold.held.push(HeldMode { key, mode, value });
        }
        Ok(hold.on(mesh))
    }
}

/// The mean motion of a body: `mean = true` beside `body`.
pub fn read_mean(section: &Section, body: Key<String>) -> Option<MeanSupport> {
    section.optional(MEAN);
    section.refuse(
        &["on", "at", "normal", "stiffness"],
        "stands beside mean = true, which holds a whole body; give body, and ux, uy, angle or several of them",
    );
    let [direction, about] = [DIRECTION, ABOUT].map(|key| section.optional(key).map(Point::from));
    for (key, way) in [("along", "direction"), ("tangential", "about")] {
        match (section.has(key), section.has(way)) {
            (true, false) => section.problem(&[key], format!("wants a way; give {way} = [x, y] beside it")),
            (false, true) => section.problem(&[way], format!("holds nothing by itself; give {key} = 0.0 beside it")),
            _ => {}
        }
    }
    let somewhere = |way: Point| match way.norm() > 0.0 {
        true => Ok(way),
        false => Err("must point somewhere: not both of its numbers are 0".into()),
    };
    let direction = section.made("direction", direction, somewhere);
    let ways = [
        (UX, Some(MeanWay::Along(Point::new(1.0, 0.0)))),
        (UY, Some(MeanWay::Along(Point::new(0.0, 1.0)))),
        (ANGLE, Some(MeanWay::Turning)),
        (ALONG, direction.map(|direction| MeanWay::Along(direction.normalize()))),
        (TANGENTIAL, about.map(MeanWay::Around)),
    ];
    if !ways.iter().any(|(key, _)| section.has(key.form.name)) {
        let words = "holds no mean motion; give uy = 0.0; in the plane ux, angle, along beside direction, tangential beside about, or several of them, too";
        section.problem(&[], words);
    }
    let values = ways.map(|(key, way)| (key.form.name, way, section.optional(key)));
    let held = values.into_iter().filter_map(|(key, way, value)| Some((key, way?, value?))).collect();
    let body = section.required(body)?;
    Some(MeanSupport { name: section.name().into(), body, held })
}

/// Bodies whose mean motion is held are bodies of the case, and each motion of one is held once.
pub fn check_means(means: &[MeanSupport], root: &Section) {
    for (at, hold) in means.iter().enumerate() {
        root.check_name(&["support", &hold.name, "body"], "body", &hold.body, root.names_below("body"));
        if let Some(other) = means[..at].iter().find(|other| other.body == hold.body) {
            let words = format!("support.{} holds a mean motion of this body, too; make one support of both", other.name);
            root.problem(&["support", &hold.name, "body"], words);
        }
    }
}
