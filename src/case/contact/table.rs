//! Keys of `[contact.NAME]`, and what their words stand for.

use toml::Value;

use crate::case::keys::{
    AUTO, BOOLEAN, COUNT, FormOf, FromValue, IN_PLANE, ListForm, NAME, NAMES, TableRule, ValueForm, array, declare, either,
    entries, key, number, of, table, whole, within, word, words,
};
use crate::contact::{Configuration, EndRule, GapChoice, Law, MultiplierSpace, SegmentRule};
use crate::geometry::Formula;

declare! {
    /// NAME is part of file names: letters, digits, `-`, `_` and `.`, neither `.` nor `..` alone, 100 bytes at most, and no two that
    /// differ by capital letters only.
    static CONTACT = table("contact").rules(&[TableRule::Beside("points", &["quadrature"])]);
    /// `[boundary of body 1, boundary of body 2]`; n points from 1 to 2. A side of several physical curves of one body is a list
    /// of them: `[["flat", "arc"], "other"]`; messages call it "flat + arc".
    const BETWEEN: [Vec<String>; 2] = key("between", array(&NAMES, "two physical curves, of body 1 and of body 2"))
        .required("[\"lower.seam\", \"upper.seam\"]");
    /// `"line"`: both boundaries are straight, extent their overlap. `"geometry"`: the one `[geometry]` that lists both. `"fit"`:
    /// the spline half-way between both boundaries where they touch or penetrate, fitted again after each solve until it stands,
    /// see [method.md](method.md); curved boundaries without a `[geometry]` are bent onto splines through the nodes of the mesh
    /// file. One of the two boundaries, as in `"rigid.roller"` or `"ring.seam"`: its own undeformed curve, as far as they touch
    /// or penetrate, see [rigid tools and plates](#rigid-tools-and-plates). Boundaries may be whole circles or closed curves: see
    /// [closed boundaries](#closed-boundaries).
    const CURVE: String = key("curve", NAME)
        .or_else("the tool's, if one side is a rigid tool of one curve, or one line of a tool; otherwise `\"fit\"`")
        .refused("must be \"line\", \"geometry\", \"fit\", or one of the two boundaries");
    /// Of a fitted curve: a number, at most a quarter of the nodes where the bodies meet, or `"auto"`: as few as follow the nodes
    /// as well as any number does.
    const SPANS: Option<usize> = key("spans", either(&[AUTO, COUNT.value], "a whole number of at least 1, or \"auto\""))
        .or("\"auto\"");
    /// `"free"`: the contact boundary ends where the pressure does, unless a body ends before. `"fixed"`: it stays as long as it
    /// was placed.
    const ENDS: EndRule = key("ends", word()).or_else("`\"fixed\"` with `\"line\"` and `\"geometry\"`, otherwise `\"free\"`");
    /// Gap of the unloaded bodies. `"closed"`: they touch along the curve, and are drawn so. A number, or a formula of x, y on
    /// the curve; negative is interference. It needs a value wherever the bodies may touch; how far apart they are drawn does not
    /// count then, but a warning tells if that is something else. `"geometry"`: measured between the smooth boundaries:
    /// `[geometry]`, straight lines, or splines through the nodes of the mesh file.
    const GAP: GapChoice = key("gap", either(&[IN_PLANE.value, ValueForm::Word(&["closed", "geometry"])], GAPS))
        .or("\"geometry\"").unit("length");
    /// The space of the contact pressure λ.
    const MULTIPLIER: MultiplierSpace = key("multiplier", word()).or("\"p1-discontinuous\"");
    /// `"auto"`: the safe rule of [method.md](method.md), shorter where the edges are. A number, of equal length, at most 32 to
    /// an edge; or ascending fractions of the length, `[0, 0.2, 1]`.
    const SEGMENTS: SegmentRule = key("segments", either(CUTS, "\"auto\", a whole number >= 1, or fractions like [0, 0.2, 1]"))
        .or("\"auto\"");
    /// Segments shorten from the middle to the ends, by this factor in all; or `[first end, last end]`.
    const GRADING: [f64; 2] = key("grading", either(SHORTER, "a number from 1 to 1000, or two of them")).or("1")
        .refused("must be a number from 1 to 1000, or two of them for the first and the last end: so many times shorter are \
            segments there");
    /// `"unilateral"`: pressure or gap. `"bilateral"`: equal normal displacement, λ of either sign, free sliding.
    const LAW: Law = key("law", word()).or("\"unilateral\"");
    /// Where integrals over Γ_C are evaluated. `"cut"`: between segment ends and projected nodes, exact on straight lines.
    /// `"segment"`: at fixed points of each segment, to repeat the paper; λ is off by per cents, see [method.md](method.md).
    const QUADRATURE: String = key("quadrature", of(ValueForm::Word(&["cut", "segment"]))).or("\"cut\"");
    /// Gauss points of a segment, at least 2 for linear multipliers; beside `quadrature = "segment"` only.
    const POINTS: usize = key("points", whole(1, 20)).or("5");
    /// A jump term; `"auto"`: where the segments are shorter than the safe rule, see [method.md](method.md).
    const STABILISE: Option<bool> = key("stabilise", either(&[AUTO, BOOLEAN.value], "\"auto\", true or false")).or("\"auto\"");
    /// `"reference"`: normals, corresponding points and distances of the undeformed bodies, the linear theory. `"deformed"`: of
    /// the deformed ones; wants `curve = "fit"` and `gap = "geometry"`.
    const CONFIGURATION: Configuration = key("configuration", word()).or("\"reference\"");
}

const GAPS: &str = "\"closed\", \"geometry\", a number or a formula of x, y";
const ASCEND: &str = "must ascend from 0 to 1, as in [0, 0.2, 1]";
/// A fraction of the length of a curve.
const FRACTION: FormOf<f64> = number(within(0.0, 1.0).or_words(ASCEND));
const FRACTIONS: ListForm = ListForm { count: [2, usize::MAX], few: ASCEND, ..entries(&FRACTION, "a list of numbers") };
const CUTS: &[ValueForm] = &[AUTO, COUNT.value, ValueForm::List(FRACTIONS)];
/// How many times shorter segments are at an end.
const TIMES: FormOf<f64> = number(within(1.0, 1000.0));
const BOTH_ENDS: FormOf<[f64; 2]> = array(&TIMES, "two numbers");
const SHORTER: &[ValueForm] = &[TIMES.value, BOTH_ENDS.value];

words! { EndRule: "free" => Free, "fixed" => Fixed }
words! { MultiplierSpace: "p0" => P0, "p1-discontinuous" => P1Discontinuous, "p1-continuous" => P1Continuous }
words! { Law: "unilateral" => Unilateral, "bilateral" => Bilateral }
words! { Configuration: "reference" => Reference, "deformed" => Deformed }

impl FromValue for GapChoice {
    fn from_value(value: &Value, _: &ValueForm) -> Result<Self, String> {
        match value.as_str() {
            Some("closed") => Ok(Self::Closed),
            Some("geometry") => Ok(Self::Geometry),
            _ => match Formula::from_value(value, &IN_PLANE.value) {
                Ok(formula) => Ok(Self::Formula(formula)),
                Err(words) => Err(format!("must be {GAPS}; {words}")),
            },
        }
    }
}

impl FromValue for SegmentRule {
    fn from_value(value: &Value, form: &ValueForm) -> Result<Self, String> {
        match value {
            Value::String(_) => Ok(Self::Auto),
            Value::Array(_) => {
                let fractions = Vec::<f64>::from_value(value, form)?;
                let is_whole = fractions.first() == Some(&0.0) && fractions.last() == Some(&1.0);
                let ascends = is_whole && fractions.is_sorted_by(|a, b| a < b);
                if ascends { Ok(Self::Fractions(fractions)) } else { Err(ASCEND.into()) }
            }
            count => usize::from_value(count, form).map(Self::Count),
        }
    }
}
