//! `[gravity]`, and the `density` of bodies: their weight.

use crate::case::keys::{Key, PLANE, POINT, Section, declare, key, table};
use crate::geometry::Formula;

declare! {
    /// Some body needs a `density`.
    static GRAVITY = table("gravity");
    /// The acceleration, `[0, -9.81]`; not `[0, 0]`.
    const G: [f64; 2] = key("g", POINT).required("[0.0, -9.81]").unit("length per time²");
}

/// What the case says of gravity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Gravity {
    /// Nothing.
    None,
    /// The acceleration.
    Acceleration([f64; 2]),
    /// Something bad, which the log knows.
    Unreadable,
}

/// `[gravity]`
pub fn read_gravity(root: &Section) -> Gravity {
    let Some(section) = root.optional_table("gravity") else {
        return if root.has("gravity") { Gravity::Unreadable } else { Gravity::None };
    };
    let heavy = |g: [f64; 2]| match g {
        [0.0, 0.0] => Err("must not be [0, 0]; leave [gravity] out where nothing is heavy".into()),
        g => Ok(g),
    };
    section.made("g", section.required(G), heavy).map_or(Gravity::Unreadable, Gravity::Acceleration)
}

/// Force per area by the `density` of a body; none without one. Nothing if the log knows what is wrong.
pub fn read_weight(section: &Section, density: Key<f64>, gravity: Gravity) -> Option<[f64; 2]> {
    if !section.has("density") {
        return Some([0.0; 2]);
    }
    let density = section.optional(density);
    match gravity {
        Gravity::None => {
            section.problem(&["density"], "weighs nothing without gravity; write [gravity] with g = [0.0, -9.81]");
            None
        }
        Gravity::Acceleration(g) => Some(g.map(|g| density.map_or(0.0, |density| density * g))).filter(|_| density.is_some()),
        Gravity::Unreadable => None,
    }
}

/// A force per area with a weight added.
pub fn with_weight(force: [Formula; 2], weight: [f64; 2]) -> [Formula; 2] {
    let mut weights = weight.into_iter();
    force.map(|formula| match (weights.next().unwrap_or(0.0), formula.as_constant()) {
        (0.0, _) => formula,
        (weight, Some(constant)) => Formula::constant(constant + weight),
        (weight, None) => Formula::parse(&format!("({}) + ({weight:?})", formula.text()), &PLANE).unwrap_or(formula),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_weight_is_added_to_any_force() {
        let force = ["2*x - 1", "3"].map(|text| Formula::parse(text, &PLANE).expect("a formula"));
        let [fx, fy] = with_weight(force.clone(), [-1.5e-7, 4.0]);
        assert_eq!((fx.value(&[2.0, 0.0]), fy.as_constant()), (3.0 - 1.5e-7, Some(7.0)));
        assert_eq!(with_weight(force.clone(), [0.0; 2]), force);
    }
}
