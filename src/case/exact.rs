//! `[exact]`: what is known of the result.

use super::error::suggest;
use super::model::region_names;
use super::section::Section;
use super::values::{self, PLANE};
use crate::element::Plane;
use crate::geometry::Formula;

/// Errors are relative.
const ALL_ZERO: &str = "is 0 all over: the error is relative to it; leave it out";

/// Exact or reference values.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Exact {
    /// A miss makes the run fail.
    pub must_hold: bool,
    /// Total strain energy.
    pub energy: Option<Expected>,
    /// Of contact pairs.
    pub contacts: Vec<ContactExact>,
    /// Of bodies.
    pub bodies: Vec<BodyExact>,
}

/// A number that is expected within a relative tolerance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Expected {
    /// Expected value, not zero.
    pub value: f64,
    /// Relative tolerance, > 0.
    pub tolerance: f64,
}

/// What is known of a contact pair.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactExact {
    /// Name of the pair.
    pub name: String,
    /// ∫λ ds.
    pub force: Option<Expected>,
    /// Contact pressure.
    pub lambda: Option<LambdaExact>,
}

/// What is known of a contact pressure.
#[derive(Clone, Debug, PartialEq)]
pub enum LambdaExact {
    /// Values at points; at a segment end the mean of both sides.
    Points {
        /// Where.
        at: Vec<[f64; 2]>,
        /// One per point.
        value: Vec<f64>,
        /// Relative tolerance, > 0.
        tolerance: f64,
    },
    /// A formula of `x, y` on the curve; its error is the L2 norm.
    Formula {
        /// λ(x, y).
        formula: Formula,
        /// Relative tolerance, > 0.
        tolerance: f64,
    },
}

/// What is known of a body.
#[derive(Clone, Debug, PartialEq)]
pub struct BodyExact {
    /// Name of the body, or of a part of one.
    pub name: String,
    /// Displacement at points.
    pub displacement: Option<ExpectedDisplacement>,
    /// Displacement field, formulas of `x, y`.
    pub u: Option<[Formula; 2]>,
    /// Stress field xx, yy, xy, zz, formulas of `x, y`; its error is the energy norm, to which zz counts in bodies of revolution alone.
    pub stress: Option<[Formula; 4]>,
}

/// Displacements that are expected at points.
#[derive(Clone, Debug, PartialEq)]
pub struct ExpectedDisplacement {
    /// Where.
    pub at: Vec<[f64; 2]>,
    /// One per point.
    pub value: Vec<[f64; 2]>,
    /// Relative to the largest |u|, > 0.
    pub tolerance: f64,
}

/// `[exact]`
pub fn read_exact(root: &Section, plane: Plane) -> Exact {
    let section = root.table("exact");
    let must_hold = section.or("must_hold", values::boolean);
    let energy = read_expected(&section, "energy");
    let contacts = section.named("contact", read_contact);
    let bodies = section.named("body", |section| read_body(section, plane));
    Exact { must_hold: must_hold.unwrap_or(false), energy, contacts, bodies }
}

/// `{ value = 1.5, tolerance = 1e-3 }`; None if it is not there.
fn read_expected(section: &Section, key: &'static str) -> Option<Expected> {
    let expected = section.optional_table(key)?;
    let value = expected.required("value", values::number);
    let tolerance = read_tolerance(&expected);
    Some(Expected { value: value?, tolerance: tolerance? })
}

fn read_tolerance(section: &Section) -> Option<f64> {
    section.required("tolerance", values::number)
}

fn read_contact(section: &Section) -> Option<ContactExact> {
    let force = read_expected(section, "force");
    let lambda = section.optional_table("lambda").and_then(|lambda| read_lambda(&lambda));
    Some(ContactExact { name: section.name().into(), force, lambda })
}

fn read_lambda(section: &Section) -> Option<LambdaExact> {
    let tolerance = read_tolerance(section);
    if !section.has("formula") {
        let (at, value) = read_points(section, values::numbers)?;
        return Some(LambdaExact::Points { at, value, tolerance: tolerance? });
    }
    if section.has("at") | section.has("value") {
        section.problem(&["formula"], "stands beside at and value; give either formula or points".into());
    }
    let formula = section.required("formula", values::formula(&PLANE));
    if formula.as_ref().is_some_and(|formula| formula.as_constant() == Some(0.0)) {
        section.problem(&["formula"], ALL_ZERO.into());
    }
    Some(LambdaExact::Formula { formula: formula?, tolerance: tolerance? })
}

fn read_body(section: &Section, plane: Plane) -> Option<BodyExact> {
    let displacement = section.optional_table("displacement").and_then(|displacement| {
        let tolerance = read_tolerance(&displacement);
        let (at, value) = read_points(&displacement, values::points)?;
        Some(ExpectedDisplacement { at, value, tolerance: tolerance? })
    });
    let u = section.optional("u", values::formulas);
    let stress = section.optional("stress", |value| match value.as_array().map(Vec::len) {
        Some(4) => values::formulas::<4>(value),
        Some(3) if plane == Plane::Revolution => {
            Err("lacks the hoop stress of a body of revolution; give [\"xx\", \"yy\", \"xy\", \"zz\"]".into())
        }
        _ => values::formulas::<3>(value).map(|[xx, yy, xy]| [xx, yy, xy, Formula::constant(0.0)]),
    });
    for (key, formulas) in [("u", u.as_ref().map(|u: &[Formula; 2]| &u[..])), ("stress", stress.as_ref().map(|all| &all[..]))] {
        if formulas.is_some_and(|all| all.iter().all(|formula| formula.as_constant() == Some(0.0))) {
            section.problem(&[key], ALL_ZERO.into());
        }
    }
    Some(BodyExact { name: section.name().into(), displacement, u, stress })
}

/// `at` and `value`, of the same length.
fn read_points<T>(section: &Section, read: impl Fn(&toml::Value) -> Result<Vec<T>, String>) -> Option<(Vec<[f64; 2]>, Vec<T>)> {
    let at = section.required("at", values::points);
    let value = section.required("value", read);
    let (at, value) = (at?, value?);
    if at.len() != value.len() {
        let words = format!("holds {} for {} points in at; give one for each point", value.len(), at.len());
        section.problem(&["value"], words);
        return None;
    }
    Some((at, value))
}

/// Everything that is expected belongs to a contact or a body of the case.
pub fn check_exact(exact: &Exact, root: &Section) {
    for contact in &exact.contacts {
        if !root.names_below("contact").any(|name| name == contact.name) {
            let words = format!("no such contact; {}", suggest(&contact.name, root.names_below("contact")));
            root.problem(&["exact", "contact", &contact.name], words);
        }
    }
    for body in &exact.bodies {
        let names = region_names(root);
        if !names.contains(&body.name.as_str()) {
            let words = format!("no such body; {}", suggest(&body.name, names.into_iter()));
            root.problem(&["exact", "body", &body.name], words);
        }
    }
}
