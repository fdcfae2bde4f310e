//! Motions of what stays rigid: prescribed, or free under what acts.

use crate::case::keys::{Key, NUMBER, POINT, Section, declare, key};

declare! {
    group CARRIED;
    /// `[fx, fy]` that it carries, of the `thickness`: its shifts are then unknown, but for `ux` or `uy` that is given.
    const FORCE: [f64; 2] = key("force", POINT).unit("force");
}

declare! {
    group MOTION;
    /// Moment about its reference point, positive from x to y: its turn is then unknown.
    const MOMENT: f64 = key("moment", NUMBER).unit("force times length");
    /// Shift of its reference point.
    const UX: f64 = shift("ux");
    /// Shift of its reference point.
    const UY: f64 = shift("uy");
    /// Its turn about its reference point.
    const ANGLE: f64 = key("angle", NUMBER).or_else("0, or free where a `moment` acts").unit("radians");
    /// Its reference point.
    const ABOUT: [f64; 2] = key("about", POINT).or_else("the centre of a circle, otherwise the middle").unit("length");
}

/// Share of a force below which a component of it is none.
const ROUNDING: f64 = 1e-12;

const fn shift(name: &'static str) -> Key<f64> {
    key(name, NUMBER).or_else("0, or free where a `force` acts").unit("length")
}

/// `ux`, `uy`, `angle`, `force`, `moment`: what is prescribed of the motion, and what acts on the rest. The `force` of a load may be of
/// formulas; where a boundary stays rigid it is of numbers, as that of a tool.
pub fn read_motion(section: &Section) -> Option<([Option<f64>; 3], [f64; 3])> {
    let given = ["ux", "uy", "angle"].map(|key| section.has(key));
    let values = [UX, UY, ANGLE].map(|key| section.optional(key));
    let (has_force, has_moment) = (section.has("force"), section.has("moment"));
    let force = section.optional(FORCE);
    let moment = section.optional(MOMENT);
    let mut sound = (force.is_some() || !has_force) && (moment.is_some() || !has_moment);
    let [fx, fy] = force.unwrap_or_default();
    let mut applied = [fx, fy, moment.unwrap_or(0.0)];
    for (k, (component, load)) in [("ux", "force"), ("uy", "force"), ("angle", "moment")].into_iter().enumerate() {
        // A force that is turned by a script has a component that is rounding.
        if given[k] && k < 2 && applied[k].abs() <= ROUNDING * fx.hypot(fy) {
            applied[k] = 0.0;
        }
        if given[k] && applied[k] != 0.0 {
            let part = ["its x component", "its y component", "it"][k];
            section.problem(
                &[load],
                format!("stands beside {component}: where {component} is prescribed the {load} follows; leave {component} out, or make {part} 0"),
            );
            sound = false;
        }
    }
    let free = [has_force, has_force, has_moment];
    let prescribed = [0, 1, 2].map(|k| if given[k] || !free[k] { Some(values[k].unwrap_or(0.0)) } else { None });
    sound.then_some((prescribed, applied))
}
