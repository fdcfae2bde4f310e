//! Sides of contacts: one physical curve or several, or a rigid tool, each side in one contact, and the geometry of both.

use crate::case::acting::rigid::{PREFIX, Tool};
use crate::case::bodies::geometry::Geometry;
use crate::case::file::error::suggest;
use crate::case::keys::Section;
use crate::contact::{Configuration, CurveChoice, Pair, Side};
use crate::geometry::Curve;
use std::collections::HashMap;

/// Several physical curves that are one side of a contact.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Union {
    /// The name of all of them.
    pub name: String,
    /// The physical curves.
    pub curves: Vec<String>,
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

/// Contacts name tools that there are, each tool is in one of them, and two tools do not press on each other.
pub fn check_tools(tools: &[Tool], contacts: &[Pair], root: &Section) {
    if tools.len() < root.names_below("rigid").count() || contacts.len() < root.names_below("contact").count() {
        return; // One of them could not be read; its own error comes first.
    }
    contacts.iter().for_each(|pair| check_sides(pair, tools, root));
    contacts.iter().for_each(|pair| check_corners(pair, tools, root));
    contacts.iter().for_each(|pair| check_own_side(pair, tools, root));
    tools.iter().for_each(|tool| check_turn(tool, contacts, root));
    for tool in tools {
        if !contacts.iter().any(|pair| pair.between.iter().any(|side| tool.has(side))) {
            let words = format!("nothing touches it; name it in a contact, as in between = [\"block.top\", \"{}\"]", tool.key());
            root.problem(&["rigid", table_name(tool)], words);
        }
    }
}

/// The tool that a side names, as a whole or one of its lines.
fn tool_of<'a>(side: &str, tools: &'a [Tool]) -> Option<&'a Tool> {
    tools.iter().find(|tool| tool.has(side))
}

/// Name of a tool in its table.
fn table_name(tool: &Tool) -> &str {
    &tool.key()[PREFIX.len()..]
}

/// A side that is no tool of the case, or two that are rigid.
fn check_sides(pair: &Pair, tools: &[Tool], root: &Section) {
    let sides = pair.between.each_ref();
    let is_unknown = |side: &&&String| side.starts_with(PREFIX) && tool_of(side, tools).is_none() && !tools.is_empty();
    if let Some(side) = sides.iter().find(is_unknown) {
        let words = format!("\"{side}\" is no rigid tool of the case; {}", suggest(side, tools.iter().map(Tool::key)));
        root.problem(&["contact", &pair.name, "between"], words);
    } else if sides.iter().all(|side| tool_of(side, tools).is_some()) {
        root.problem(&["contact", &pair.name, "between"], "both sides are rigid; a tool presses on a boundary of the mesh");
    }
}

/// Corners of a tool that presses as a whole, which a spline would round.
fn check_corners(pair: &Pair, tools: &[Tool], root: &Section) {
    for tool in tools.iter().filter(|tool| pair.between.iter().any(|side| side == tool.key())) {
        if let Some((k, angle)) = tool.blunt_corner() {
            let words = format!(
                "the tool turns by {angle:.1} degrees between its lines {k} and {}: a spline through its points would round that; name the lines, as \"{}.{k}\", each in a contact of its own, or give the shape by formulas",
                k + 1,
                tool.key()
            );
            root.problem(&["contact", &pair.name, "between"], words);
        }
    }
}

/// A tool of several lines whose own curve is asked for.
fn check_own_side(pair: &Pair, tools: &[Tool], root: &Section) {
    let CurveChoice::Own(of) = pair.curve else { return };
    let side = &pair.between[if of == Side::First { 0 } else { 1 }];
    if let Some(tool) = tool_of(side, tools).filter(|tool| tool.key() == side && tool.surface.len() > 1) {
        let words = format!(
            "the tool has {} lines; name the one that touches in between, as \"{side}.1\", or take curve = \"fit\"",
            tool.surface.len()
        );
        root.problem(&["contact", &pair.name, "curve"], words);
    }
}

/// A tool that is free to turn, though it is a circle, or has contacts that lie where bodies come to be.
fn check_turn(tool: &Tool, contacts: &[Pair], root: &Section) {
    if tool.motion.prescribed[2].is_some() {
        return;
    }
    if matches!(*tool.surface[0].curve, Curve::Circle { .. }) {
        let words = "a circle turns on what it touches: nothing but its curvature resists, which is not modelled; leave moment out, or give angle";
        root.problem(&["rigid", table_name(tool), "moment"], words);
    }
    let deformed = |pair: &&Pair| pair.configuration == Configuration::Deformed && pair.between.iter().any(|side| tool.has(side));
    if let Some(pair) = contacts.iter().find(deformed) {
        let words = format!(
            "contact.{} has configuration = \"deformed\", beside which a tool cannot turn freely: not available yet; leave moment out, or take \"reference\"",
            pair.name
        );
        root.problem(&["rigid", table_name(tool), "moment"], words);
    }
}
