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
    let tool_of = |side: &str| tools.iter().find(|tool| tool.has(side));
    for pair in contacts {
        let sides = pair.between.each_ref();
        if let Some(side) = sides.iter().find(|side| side.starts_with(PREFIX) && tool_of(side).is_none() && !tools.is_empty()) {
            let words = format!("\"{side}\" is no rigid tool of the case; {}", suggest(side, tools.iter().map(Tool::key)));
            root.problem(&["contact", &pair.name, "between"], words);
        } else if sides.iter().all(|side| tool_of(side).is_some()) {
            let words = "both sides are rigid; a tool presses on a boundary of the mesh";
            root.problem(&["contact", &pair.name, "between"], words.into());
        }
    }
    for pair in contacts {
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
    for pair in contacts {
        let CurveChoice::Own(of) = pair.curve else { continue };
        let side = &pair.between[if of == Side::First { 0 } else { 1 }];
        if let Some(tool) = tool_of(side).filter(|tool| tool.key() == side && tool.surface.len() > 1) {
            let words = format!(
                "the tool has {} lines; name the one that touches in between, as \"{side}.1\", or take curve = \"fit\"",
                tool.surface.len()
            );
            root.problem(&["contact", &pair.name, "curve"], words);
        }
    }
    for tool in tools.iter().filter(|tool| tool.motion.prescribed[2].is_none()) {
        let name = &tool.key()[PREFIX.len()..];
        if matches!(tool.surface[0].curve, Curve::Circle { .. }) {
            let words = "a circle turns on what it touches: nothing but its curvature resists, which is not modelled; leave moment out, or give angle";
            root.problem(&["rigid", name, "moment"], words.into());
        }
        let deformed =
            |pair: &&Pair| pair.configuration == Configuration::Deformed && pair.between.iter().any(|side| tool.has(side));
        if let Some(pair) = contacts.iter().find(deformed) {
            let words = format!(
                "contact.{} has configuration = \"deformed\", beside which a tool cannot turn freely: not available yet; leave moment out, or take \"reference\"",
                pair.name
            );
            root.problem(&["rigid", name, "moment"], words);
        }
    }
    for tool in tools {
        if !contacts.iter().any(|pair| pair.between.iter().any(|side| tool.has(side))) {
            let name = &tool.key()[PREFIX.len()..];
            let words = format!("nothing touches it; name it in a contact, as in between = [\"block.top\", \"{}\"]", tool.key());
            root.problem(&["rigid", name], words);
        }
    }
}
