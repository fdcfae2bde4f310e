//! `[contact.NAME]`

use super::sides::Union;
use super::table::{
    BETWEEN, CONFIGURATION, CURVE, ENDS, GAP, GRADING, LAW, MULTIPLIER, POINTS, QUADRATURE, SEGMENTS, SPANS, STABILISE,
};
use crate::case::acting::rigid::is_one_curve;
use crate::case::file::error::suggest;
use crate::case::keys::{LONGEST_NAME, NO_FILE_NAME, Section};
use crate::contact::{
    Configuration, CurveChoice, EndRule, GapChoice, MultiplierSpace, Pair, Quadrature, SegmentRule, Side, Stabilise,
};

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
