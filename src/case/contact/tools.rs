//! Rigid tools as sides of contacts.

use crate::case::acting::rigid::{PREFIX, Tool};
use crate::case::file::error::suggest;
use crate::case::keys::Section;
use crate::contact::{Configuration, CurveChoice, Pair, Side};
use crate::geometry::Curve;

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
            root.problem(&["rigid", name(tool)], words);
        }
    }
}

/// The tool that a side names, as a whole or one of its lines.
fn tool_of<'a>(side: &str, tools: &'a [Tool]) -> Option<&'a Tool> {
    tools.iter().find(|tool| tool.has(side))
}

/// Name of a tool in its table.
fn name(tool: &Tool) -> &str {
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
        root.problem(&["rigid", name(tool), "moment"], words);
    }
    let deformed = |pair: &&Pair| pair.configuration == Configuration::Deformed && pair.between.iter().any(|side| tool.has(side));
    if let Some(pair) = contacts.iter().find(deformed) {
        let words = format!(
            "contact.{} has configuration = \"deformed\", beside which a tool cannot turn freely: not available yet; leave moment out, or take \"reference\"",
            pair.name
        );
        root.problem(&["rigid", name(tool), "moment"], words);
    }
}
