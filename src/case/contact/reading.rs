//! `[contact.NAME]`: its keys, what their words stand for, and the contact that they describe.

use super::sides::Union;
use crate::case::acting::rigid::is_one_curve;
use crate::case::file::error::suggest;
use crate::case::keys::*;
use crate::contact::{
    Configuration, CurveChoice, EndRule, GapChoice, Law, MultiplierSpace, Pair, Quadrature, SegmentRule, Side, Stabilise,
};
use crate::geometry::Formula;
use toml::Value;

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

/// Words of `curve`, beside the names of both boundaries.
const CURVES: [(&str, CurveChoice); 3] =
    [("line", CurveChoice::Line), ("geometry", CurveChoice::Geometry), ("fit", CurveChoice::Fit)];

/// `[contact.NAME]`; both sides alone are enough to look for names. Sides of several curves have one name made of theirs, and are
/// among `unions` from now on.
pub fn read_contact(section: &Section, root: &Section, unions: &mut Vec<Union>) -> Option<Pair> {
    let between = section.made("between", section.required(BETWEEN), different);
    let configuration = section.or_default(CONFIGURATION);
    let usual_curve = || usual_curve(between.as_ref(), configuration, root);
    let curve = section.made("curve", section.or_else(CURVE, usual_curve), |word| chosen_curve(&word, between.as_ref()));
    let gap = section.or_default(GAP);
    let space = section.or(MULTIPLIER);
    let pair = Pair {
        name: section.name().into(),
        between: between.clone().unwrap_or_default().map(|curves| curves.join(" + ")),
        curve: curve.unwrap_or(CurveChoice::Fit),
        gap,
        space: space.unwrap_or(MultiplierSpace::P1Discontinuous),
        segments: section.or_default(SEGMENTS),
        law: section.or_default(LAW),
        quadrature: read_quadrature(section, space).unwrap_or(Quadrature::Cut),
        stabilise: match section.or_default(STABILISE) {
            Some(true) => Stabilise::On,
            Some(false) => Stabilise::Off,
            None => Stabilise::Auto,
        },
        configuration,
        spans: section.or_default(SPANS),
        grading: section.or_default(GRADING),
        ends: {
            let usual = if curve.is_some_and(CurveChoice::is_found) { "free" } else { "fixed" };
            section.or_else(ENDS, || usual).unwrap_or(EndRule::Fixed)
        },
    };
    check_choices(&pair, section);
    check_name(section);
    for (name, curves) in pair.between.iter().zip(between?) {
        if curves.len() > 1 && !unions.iter().any(|known| known.name == *name) {
            unions.push(Union { name: name.clone(), curves });
        }
    }
    Some(pair)
}

/// What does not go together.
fn check_choices(pair: &Pair, section: &Section) {
    let refuse = |key: &str, words: &str| section.problem(&[key], words);
    let is_deformed = pair.configuration == Configuration::Deformed;
    if pair.curve != CurveChoice::Fit && is_deformed {
        refuse("configuration", "\"deformed\" wants curve = \"fit\": a declared curve does not follow the bodies");
    }
    if pair.curve != CurveChoice::Fit && pair.spans.is_some() {
        refuse("spans", "is for curve = \"fit\"; a declared curve has none");
    }
    if is_deformed && !matches!(pair.gap, GapChoice::Geometry) {
        refuse("gap", "must be \"geometry\" with configuration = \"deformed\": the bodies slide along each other");
    }
    if matches!(pair.segments, SegmentRule::Fractions(_)) && pair.grading != [1.0, 1.0] {
        refuse("grading", "stands beside segments that are given one by one; leave one of them out");
    }
}

/// Its name is part of file names.
fn check_name(section: &Section) {
    let name = section.name();
    if ["", ".", ".."].contains(&name) || !name.chars().all(|c| c.is_alphanumeric() || "-_.".contains(c)) {
        section.problem(&[], NO_FILE_NAME);
    }
    if name.len() > LONGEST_NAME {
        let words = format!("its name has {} bytes and is part of a file name; use {LONGEST_NAME} at most", name.len());
        section.problem(&[], words);
    }
}

fn different(sides: [Vec<String>; 2]) -> Result<[Vec<String>; 2], String> {
    match &sides {
        [first, second] if first.iter().any(|name| second.contains(name)) => {
            Err("must name two different curves, one of each body".into())
        }
        _ => Ok(sides),
    }
}

/// Where a rigid tool of one curve is in contact, that; otherwise a fit.
fn usual_curve(between: Option<&[Vec<String>; 2]>, configuration: Configuration, root: &Section) -> String {
    let tool = between.and_then(|sides| sides.iter().filter_map(|side| only(side)).find(|name| is_one_curve(name, root)));
    match tool {
        Some(name) if configuration != Configuration::Deformed => name.into(),
        _ => "fit".into(),
    }
}

/// The curve of a side that is only one.
fn only(side: &[String]) -> Option<&str> {
    match side {
        [name] => Some(name),
        _ => None,
    }
}

/// A word of [`CURVES`], or one of the two boundaries.
fn chosen_curve(found: &str, between: Option<&[Vec<String>; 2]>) -> Result<CurveChoice, String> {
    let sides = between.into_iter().flatten().zip([Side::First, Side::Second]);
    let own = sides.filter_map(|(side, of)| Some((only(side)?, CurveChoice::Own(of))));
    let all: Vec<(&str, CurveChoice)> = CURVES.into_iter().chain(own).collect();
    match all.iter().find(|(name, _)| *name == found) {
        Some((_, choice)) => Ok(*choice),
        None => {
            let words = CURVES.map(|(word, _)| word).join("\", \"");
            let near = suggest(found, all.iter().map(|(name, _)| *name));
            Err(format!("must be \"{words}\", or one of the two boundaries; {near}"))
        }
    }
}

/// `quadrature`, and `points` beside `"segment"`.
fn read_quadrature(section: &Section, space: Option<MultiplierSpace>) -> Option<Quadrature> {
    section.has("points");
    if section.or(QUADRATURE)? == "cut" {
        section.refuse(
            &["points"],
            "stands beside quadrature = \"cut\", which knows its points; leave it out, or write quadrature = \"segment\"",
        );
        return Some(Quadrature::Cut);
    }
    let points = section.or(POINTS)?;
    if points == 1 && space.is_some_and(|space| space != MultiplierSpace::P0) {
        let words = "cannot tell the two values of a linear multiplier apart; give 2 or more, or multiplier = \"p0\"";
        section.problem(&["points"], words);
    }
    Some(Quadrature::Segment { points })
}
