//! `[exact]`: what is known of the result.

use crate::case::bodies::body::region_names;
use crate::case::keys::*;
use crate::element::Plane;
use crate::geometry::Formula;

declare! {
    /// Values that you expect; relative errors go to `summary.json`.
    static EXACT = table("exact");
    /// `true`: a miss is exit code 3.
    const MUST_HOLD: bool = key("must_hold", BOOLEAN).or("false");
    /// `{ value, tolerance }` of the total strain energy, [`energy.stationary`](method.md#energy-and-balance) where there is one.
    const ENERGY: toml::Table = key("energy", inner(&EXPECTED));
    const CONTACTS: toml::Table = key("contact", named(&EXACT_CONTACT));
    const BODIES: toml::Table = key("body", named(&EXACT_BODY));
}

declare! {
    static EXPECTED = table("expected").inline();
    /// The value.
    const VALUE: f64 = key("value", number(NOT_ZERO)).required("1.5");
    ..WITHIN;
}

declare! {
    group WITHIN;
    /// How far off the value may be, as a fraction of it.
    const TOLERANCE: f64 = key("tolerance", ABOVE_ZERO).required("1e-3");
}

declare! {
    static EXACT_CONTACT = table("exact-of-contact");
    /// `{ value, tolerance }` of ∫λ ds.
    const FORCE: toml::Table = key("force", inner(&EXPECTED));
    /// `{ at = [[x, y], ...], value = [...], tolerance }`; at a jump the mean of both values. Points lie at the two boundaries, or
    /// between them; no value is 0, for errors are relative. Or `{ formula = "...", tolerance }`: L2 error; a formula without a
    /// value on Γ_C is an error, or a miss where Γ_C follows the solution.
    const PRESSURE: toml::Table = key("lambda", inner(&LAMBDA));
}

declare! {
    static LAMBDA = table("exact-lambda").inline()
        .rules(&[TableRule::OneOf(&[&["formula"], &["at", "value"]]), TableRule::Alone("formula", &["at", "value"])]);
    ..PLACES;
    /// The values, one for each point.
    const PRESSURES: Vec<f64> = key("value", list(&NONE_ZERO, "a list of numbers")).like("[0.925057], or a formula");
    /// Instead: λ as a formula.
    const FORMULA: Formula = key("formula", IN_PLANE).like("\"1 - x^2\"");
    ..WITHIN;
}

declare! {
    group PLACES;
    /// The points.
    const AT: Vec<[f64; 2]> = key("at", POINTS).like("[[1.2, 3.2]], points on the body").unit("length");
}

declare! {
    static EXACT_BODY = table("exact-of-body");
    /// `{ at, value = [[ux, uy], ...], tolerance }`, relative to the largest displacement.
    const DISPLACEMENT_AT: toml::Table = key("displacement", inner(&DISPLACEMENT));
    /// `["ux", "uy"]`, formulas: errors in the mean square of the nodes, reported only. What is 0 all over, or has no value at a
    /// vertex, is an error.
    const U: [Formula; 2] = key("u", VECTOR);
    /// `["xx", "yy", "xy"]`, and `"zz"`, the hoop stress, of bodies of revolution; formulas: errors in the energy norm, reported
    /// only. What is 0 all over, or has no value at a vertex, is an error.
    const STRESS: Vec<Formula> = key("stress", STRESSES);
}

declare! {
    static DISPLACEMENT = table("exact-displacement").inline().rules(&[TableRule::OneOf(&[&["at", "value"]])]);
    ..PLACES;
    /// The displacements, one for each point.
    const DISPLACEMENTS: Vec<[f64; 2]> = key("value", POINTS).like("[[1e-4, -2e-4]]").unit("length");
    ..WITHIN;
}

const STRESSES: FormOf<Vec<Formula>> = of(ValueForm::List(ListForm {
    count: [3, 4],
    few: "must be a list of 3 or 4 numbers or formulas of x, y",
    ..entries(&IN_PLANE, "a list of 3 or 4 numbers or formulas of x, y")
}));

/// Errors are relative.
const ALL_ZERO: &str = "is 0 all over: the error is relative to it; leave it out";
const NOT_ZERO: NumberRange = NumberRange { zero: false, words: "must not be 0: the error is relative to it", ..ANY };
const NONE_ZERO: FormOf<f64> =
    number(NOT_ZERO.or_words("must not be 0: the error is relative to each value; leave that point out"));

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
    Points(ExpectedAt<f64>),
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
    pub displacement: Option<ExpectedAt<[f64; 2]>>,
    /// Displacement field, formulas of `x, y`.
    pub u: Option<[Formula; 2]>,
    /// Stress field xx, yy, xy, zz, formulas of `x, y`; its error is the energy norm, to which zz counts in bodies of revolution
    /// alone.
    pub stress: Option<[Formula; 4]>,
}

/// What is expected at points.
#[derive(Clone, Debug, PartialEq)]
pub struct ExpectedAt<T> {
    /// Where.
    pub at: Vec<[f64; 2]>,
    /// One per point.
    pub value: Vec<T>,
    /// Relative to each value, of displacements to the largest |u|; > 0.
    pub tolerance: f64,
}

/// `[exact]`; everything that is expected belongs to a contact or a body of the case.
pub fn read_exact(root: &Section, plane: Plane) -> Exact {
    let section = root.table("exact");
    let must_hold = section.or_default(MUST_HOLD);
    let energy = read_expected(&section, "energy");
    let contacts = section.named("contact", |section| read_contact(section, root));
    let bodies = section.named("body", |section| read_body(section, plane, root));
    Exact { must_hold, energy, contacts, bodies }
}

/// `{ value = 1.5, tolerance = 1e-3 }`; None if it is not there.
fn read_expected(section: &Section, key: &'static str) -> Option<Expected> {
    let expected = section.optional_table(key)?;
    let (value, tolerance) = (expected.required(VALUE), expected.required(TOLERANCE));
    Some(Expected { value: value?, tolerance: tolerance? })
}

fn read_contact(section: &Section, root: &Section) -> Option<ContactExact> {
    section.check_name(&[], "contact", section.name(), root.names_below("contact"));
    let force = read_expected(section, "force");
    let lambda = section.optional_table("lambda").and_then(|lambda| read_lambda(&lambda));
    Some(ContactExact { name: section.name().into(), force, lambda })
}

fn read_lambda(section: &Section) -> Option<LambdaExact> {
    let tolerance = section.required(TOLERANCE);
    if !section.has("formula") {
        return read_points(section, PRESSURES, tolerance).map(LambdaExact::Points);
    }
    if section.has_any(&["at", "value"]) {
        section.problem(&["formula"], "stands beside at and value; give either formula or points");
    }
    let formula = section.required(FORMULA);
    check_not_zero(section, "formula", formula.as_slice());
    Some(LambdaExact::Formula { formula: formula?, tolerance: tolerance? })
}

fn read_body(section: &Section, plane: Plane, root: &Section) -> Option<BodyExact> {
    section.check_name(&[], "body", section.name(), region_names(root).into_iter());
    let displacement = section.optional_table("displacement");
    let displacement = displacement.and_then(|inner| read_points(&inner, DISPLACEMENTS, inner.required(TOLERANCE)));
    let (u, stress) = (section.optional(U), section.optional(STRESS));
    let stress: Option<[Formula; 4]> = section.made("stress", stress, |mut all| {
        if all.len() == 3 && plane == Plane::Revolution {
            return Err("lacks the hoop stress of a body of revolution; give [\"xx\", \"yy\", \"xy\", \"zz\"]".into());
        }
        all.resize(4, Formula::constant(0.0));
        all.try_into().map_err(|_| "must be a list of 3 or 4".to_string())
    });
    check_not_zero(section, "u", u.as_ref().map_or(&[], |all| &all[..]));
    check_not_zero(section, "stress", stress.as_ref().map_or(&[], |all| &all[..]));
    Some(BodyExact { name: section.name().into(), displacement, u, stress })
}

/// Not all of some formulas are 0 everywhere.
fn check_not_zero(section: &Section, key: &str, formulas: &[Formula]) {
    if !formulas.is_empty() && formulas.iter().all(|formula| formula.as_constant() == Some(0.0)) {
        section.problem(&[key], ALL_ZERO);
    }
}

/// `at` and `value`, of the same length.
fn read_points<T: FromValue>(section: &Section, value: Key<Vec<T>>, tolerance: Option<f64>) -> Option<ExpectedAt<T>> {
    let (at, value) = (section.required(AT), section.required(value));
    let (at, value) = (at?, value?);
    if at.len() != value.len() {
        let words = format!("holds {} for {} points in at; give one for each point", value.len(), at.len());
        section.problem(&["value"], words);
        return None;
    }
    Some(ExpectedAt { at, value, tolerance: tolerance? })
}
