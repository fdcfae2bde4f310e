//! `[contact.NAME]`

use std::collections::HashMap;

use toml::Value;

use super::error::suggest;
use super::rigid::is_one_curve;
use super::schema::{LONGEST_NAME, NO_FILE_NAME};
use super::section::Section;
use super::values::{self, PLANE, choice, must_be};
use super::{Geometry, Union};
use crate::contact::{
    Configuration, CurveChoice, EndRule, GapChoice, Law, MultiplierSpace, Pair, Quadrature, SegmentRule, Side, Stabilise,
};

const CURVES: [(&str, CurveChoice); 3] =
    [("line", CurveChoice::Line), ("geometry", CurveChoice::Geometry), ("fit", CurveChoice::Fit)];
const BODIES: [Side; 2] = [Side::First, Side::Second];
const SPACES: [(&str, MultiplierSpace); 3] = [
    ("p0", MultiplierSpace::P0),
    ("p1-discontinuous", MultiplierSpace::P1Discontinuous),
    ("p1-continuous", MultiplierSpace::P1Continuous),
];
const LAWS: [(&str, Law); 2] = [("unilateral", Law::Unilateral), ("bilateral", Law::Bilateral)];
const CONFIGURATIONS: [(&str, Configuration); 2] =
    [("reference", Configuration::Reference), ("deformed", Configuration::Deformed)];
const END_RULES: [(&str, EndRule); 2] = [("free", EndRule::Free), ("fixed", EndRule::Fixed)];

/// What a table `[contact.NAME]` says.
pub struct ReadContact {
    /// The contact; a side of several curves has one name made of theirs.
    pub pair: Pair,
    /// The curves of each side.
    pub sides: [Vec<String>; 2],
}

/// The contacts, and the sides that are made of several curves.
pub fn split_contacts(all: Vec<ReadContact>) -> (Vec<Pair>, Vec<Union>) {
    let mut unions: Vec<Union> = Vec::new();
    let mut pairs = Vec::new();
    for ReadContact { pair, sides } in all {
        for (name, curves) in pair.between.iter().zip(sides) {
            if curves.len() > 1 && !unions.iter().any(|known| known.name == *name) {
                unions.push(Union { name: name.clone(), curves });
            }
        }
        pairs.push(pair);
    }
    (pairs, unions)
}

/// `[contact.NAME]`
pub fn read_contact(section: &Section, root: &Section) -> Option<ReadContact> {
    let between = section.required("between", read_between);
    let configuration = section.or("configuration", choice(&CONFIGURATIONS));
    let usual_curve = || usual_curve(between.as_ref(), configuration, root);
    let curve = section.or_else("curve", usual_curve, read_curve(between.as_ref()));
    let gap = section.or("gap", read_gap);
    let space = section.or("multiplier", choice(&SPACES));
    let segments = section.or("segments", read_segments);
    let law = section.or("law", choice(&LAWS));
    let quadrature = read_quadrature(section, space);
    let stabilise = section.or("stabilise", read_stabilise);
    let spans = section.or("spans", read_spans);
    let grading = section.or("grading", read_grading);
    let usual_ends = || if curve.is_some_and(CurveChoice::is_found) { "free" } else { "fixed" };
    let ends = section.or_else("ends", usual_ends, choice(&END_RULES));
    if curve.is_some_and(|curve| curve != CurveChoice::Fit) {
        check_declared_curve(section, configuration, spans);
    }
    if configuration == Some(Configuration::Deformed) && gap.as_ref().is_some_and(|gap| !matches!(gap, GapChoice::Geometry)) {
        let words = "must be \"geometry\" with configuration = \"deformed\": the bodies slide along each other";
        section.problem(&["gap"], words.into());
    }
    if matches!(segments, Some(SegmentRule::Fractions(_))) && grading.is_some_and(|grading| grading != [1.0, 1.0]) {
        section.problem(&["grading"], "stands beside segments that are given one by one; leave one of them out".into());
    }
    if (space, stabilise) == (Some(MultiplierSpace::P1Continuous), Some(Stabilise::On)) {
        let words = "\"p1-continuous\" has no jumps to weigh; take fewer segments, or another multiplier";
        section.problem(&["stabilise"], words.into());
    }
    let name = section.name();
    if ["", ".", ".."].contains(&name) || !name.chars().all(|c| c.is_alphanumeric() || "-_.".contains(c)) {
        section.problem(&[], NO_FILE_NAME.into());
    }
    if section.name().len() > LONGEST_NAME {
        let words = format!("its name has {} bytes and is part of a file name; use {LONGEST_NAME} at most", section.name().len());
        section.problem(&[], words);
    }
    let sides = between?;
    // What is bad is in the log; both sides alone are enough to look for names.
    let pair = Pair {
        name: section.name().into(),
        between: sides.each_ref().map(|curves| curves.join(" + ")),
        curve: curve.unwrap_or(CurveChoice::Fit),
        gap: gap.unwrap_or(GapChoice::Geometry),
        space: space.unwrap_or(MultiplierSpace::P1Discontinuous),
        segments: segments.unwrap_or(SegmentRule::Auto),
        law: law.unwrap_or(Law::Unilateral),
        quadrature: quadrature.unwrap_or(Quadrature::Cut),
        stabilise: stabilise.unwrap_or(Stabilise::Auto),
        configuration: configuration.unwrap_or(Configuration::Reference),
        spans: spans.flatten(),
        grading: grading.unwrap_or([1.0; 2]),
        ends: ends.unwrap_or(EndRule::Fixed),
    };
    Some(ReadContact { pair, sides })
}

/// Where a rigid tool of one curve is in contact, that; otherwise a fit.
fn usual_curve(between: Option<&[Vec<String>; 2]>, configuration: Option<Configuration>, root: &Section) -> String {
    let tool = between.and_then(|sides| sides.iter().filter_map(|side| only(side)).find(|name| is_one_curve(name, root)));
    match tool {
        Some(name) if configuration != Some(Configuration::Deformed) => name.into(),
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
fn read_curve(between: Option<&[Vec<String>; 2]>) -> impl Fn(&Value) -> Result<CurveChoice, String> {
    let names = between.map(|sides| sides.each_ref().map(|side| only(side).map(String::from)));
    let names: Vec<(String, Side)> =
        names.into_iter().flatten().zip(BODIES).filter_map(|(name, side)| Some((name?, side))).collect();
    move |value| {
        let words = CURVES.iter().map(|(word, _)| *word);
        let wanted = || format!("\"{}\", or one of the two boundaries", words.clone().collect::<Vec<_>>().join("\", \""));
        let found = value.as_str().ok_or_else(|| must_be(&wanted(), value))?;
        if let Some((_, choice)) = CURVES.iter().find(|(word, _)| *word == found) {
            return Ok(*choice);
        }
        let side = names.iter().find(|(name, _)| name == found).map(|(_, side)| CurveChoice::Own(*side));
        let all = words.clone().chain(names.iter().map(|(name, _)| name.as_str()));
        side.ok_or_else(|| format!("must be {}; {}", wanted(), suggest(found, all)))
    }
}

/// What a curve that is declared cannot have: it neither follows the bodies nor is it fitted.
fn check_declared_curve(section: &Section, configuration: Option<Configuration>, spans: Option<Option<usize>>) {
    if configuration == Some(Configuration::Deformed) {
        let words = "\"deformed\" wants curve = \"fit\": a declared curve does not follow the bodies";
        section.problem(&["configuration"], words.into());
    }
    if spans.is_some_and(|spans| spans.is_some()) {
        section.problem(&["spans"], "is for curve = \"fit\"; a declared curve has none".into());
    }
}

/// `quadrature`, and `points` beside `"segment"`.
fn read_quadrature(section: &Section, space: Option<MultiplierSpace>) -> Option<Quadrature> {
    let given = section.has("points");
    let problem = |words: &str| section.problem(&["points"], words.into());
    let fixed = section.or("quadrature", choice(&[("cut", false), ("segment", true)]))?;
    if !fixed {
        if given {
            problem(
                "stands beside quadrature = \"cut\", which knows its points; leave it out, or write quadrature = \"segment\"",
            );
        }
        return Some(Quadrature::Cut);
    }
    let points = section.or("points", values::whole)?;
    if points == 1 && space.is_some_and(|space| space != MultiplierSpace::P0) {
        problem("cannot tell the two values of a linear multiplier apart; give 2 or more, or multiplier = \"p0\"");
    }
    Some(Quadrature::Segment { points })
}

/// The curves of each side: one name, or a list of them.
fn read_between(value: &Value) -> Result<[Vec<String>; 2], String> {
    let wanted = || must_be("two physical curves, of body 1 and of body 2", value);
    let list = value.as_array().ok_or_else(wanted)?;
    let names = list.iter().map(values::names).collect::<Result<Vec<_>, _>>()?;
    match <[Vec<String>; 2]>::try_from(names).map_err(|_| wanted())? {
        [first, second] if first.iter().any(|name| second.contains(name)) => {
            Err("must name two different curves, one of each body".into())
        }
        pair => Ok(pair),
    }
}

fn read_gap(value: &Value) -> Result<GapChoice, String> {
    match value.as_str() {
        Some("closed") => Ok(GapChoice::Closed),
        Some("geometry") => Ok(GapChoice::Geometry),
        _ => values::formula(&PLANE)(value)
            .map(GapChoice::Formula)
            .map_err(|words| format!("must be \"closed\", \"geometry\", a number or a formula of x, y; {words}")),
    }
}

fn read_segments(value: &Value) -> Result<SegmentRule, String> {
    match value {
        Value::String(_) => Ok(SegmentRule::Auto),
        Value::Array(_) => read_fractions(value),
        count => values::whole(count).map(SegmentRule::Count),
    }
}

fn read_stabilise(value: &Value) -> Result<Stabilise, String> {
    Ok(match value.as_bool() {
        Some(true) => Stabilise::On,
        Some(false) => Stabilise::Off,
        None => Stabilise::Auto,
    })
}

/// Spans of a fitted curve; None lets the data choose.
fn read_spans(value: &Value) -> Result<Option<usize>, String> {
    match value {
        Value::String(_) => Ok(None),
        count => values::whole(count).map(Some),
    }
}

/// One factor for both ends, or one for each.
fn read_grading(value: &Value) -> Result<[f64; 2], String> {
    match value {
        Value::Array(_) => values::point(value),
        value => values::number(value).map(|factor| [factor; 2]),
    }
}

fn read_fractions(value: &Value) -> Result<SegmentRule, String> {
    let fractions = values::numbers(value)?;
    let whole = fractions.first() == Some(&0.0) && fractions.last() == Some(&1.0);
    if !whole || !fractions.is_sorted_by(|a, b| a < b) {
        return Err("must ascend from 0 to 1, as in [0, 0.2, 1]".into());
    }
    Ok(SegmentRule::Fractions(fractions))
}

/// The physical curves of a side.
pub fn parts(unions: &[Union], name: &String) -> Vec<String> {
    unions.iter().find(|union| union.name == *name).map_or_else(|| vec![name.clone()], |union| union.curves.clone())
}

/// A contact on a declared geometry needs one that lists both boundaries.
pub fn check_contacts(contacts: &[Pair], unions: &[Union], geometries: &[Geometry], root: &Section) {
    if geometries.len() < root.names_below("geometry").count() {
        return; // A geometry could not be read; its own error comes first.
    }
    let (mut joined, mut named) = (HashMap::new(), HashMap::new());
    for pair in contacts {
        let mut sides = pair.between.each_ref();
        sides.sort_unstable();
        if let Some(other) = joined.get(&sides) {
            let words = format!("contact.{other} joins the same boundaries; leave one of them out");
            root.problem(&["contact", &pair.name, "between"], words);
        }
        joined.entry(sides).or_insert(&pair.name);
        if let Some(other) = named.get(&pair.name.to_lowercase()) {
            let words = format!(
                "differs from contact.{other} by capital letters only: their files would be one on some disks; rename one of them",
            );
            root.problem(&["contact", &pair.name], words);
        }
        named.entry(pair.name.to_lowercase()).or_insert(&pair.name);
    }
    for pair in contacts.iter().filter(|pair| pair.curve == CurveChoice::Geometry) {
        let [first, second] = &pair.between;
        let lists = |geometry: &&Geometry, name| parts(unions, name).iter().all(|curve| geometry.curves.contains(curve));
        if geometries.iter().filter(|geometry| lists(geometry, first) && lists(geometry, second)).count() == 1 {
            continue;
        }
        let mut found = Vec::new();
        for name in [first, second] {
            let shapes = geometries.iter().filter(|geometry| lists(geometry, name));
            found.extend(shapes.map(|geometry| format!("geometry.{} lists \"{name}\"", geometry.name)));
        }
        let found = if found.is_empty() { "none lists either".into() } else { found.join(", ") };
        let curves = [first, second].map(|name| parts(unions, name)).concat();
        let words = format!("needs one [geometry] with curves = [\"{}\"]; {found}", curves.join("\", \""));
        root.problem(&["contact", &pair.name, "curve"], words);
    }
}
