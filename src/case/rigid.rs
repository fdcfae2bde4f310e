//! `[rigid.NAME]`

use toml::Value;

use super::Case;
use super::error::suggest;
use super::geometry::read_surface;
use super::section::Section;
use super::values;
use crate::body::{RigidNodes, RigidSet};
use crate::contact::{Configuration, CurveChoice, Pair, Side};
use crate::element::Plane;
use crate::geometry::{Curve, Point, cross};
use crate::mesh::{MacroMesh, SurfacePart};

/// Lines that turn by less than this (degrees) go straight on, and boundaries that turn by no more than that are taken for smooth.
const STRAIGHT: f64 = 1e-4;
const SMOOTH: f64 = 20.0;

/// What the boundaries of tools begin with.
const PREFIX: &str = "rigid.";

/// A rigid tool: a surface that moves as a rigid body.
#[derive(Clone, Debug, PartialEq)]
pub struct Tool {
    /// Its surface; parts follow each other.
    pub surface: Vec<SurfacePart>,
    /// Its motion.
    pub motion: RigidSet,
}

impl Tool {
    /// Its name as a body and as a boundary of contacts: `rigid.NAME`.
    pub fn key(&self) -> &str {
        &self.motion.key
    }

    /// The curves of a boundary that it has: all, or one.
    pub fn parts_of(&self, boundary: &str) -> impl Iterator<Item = &SurfacePart> {
        let number = boundary.strip_prefix(self.key()).and_then(|rest| rest.strip_prefix('.')?.parse::<usize>().ok());
        self.surface.iter().enumerate().filter(move |(k, _)| number.is_none_or(|number| number == k + 1)).map(|(_, part)| part)
    }

    /// The first corner (from 1) that is too blunt to be taken for one, and its angle in degrees: boundaries that turn by less than
    /// 20 degrees are taken for smooth ones.
    fn blunt_corner(&self) -> Option<(usize, f64)> {
        let turn = |pair: &[SurfacePart]| {
            let (a, b) = (pair[0].curve.tangent(pair[0].range[1]), pair[1].curve.tangent(pair[1].range[0]));
            cross(a, b).atan2(a.dot(&b)).abs().to_degrees()
        };
        let mut corners = self.surface.windows(2).map(turn).enumerate().map(|(k, angle)| (k + 1, angle));
        corners.find(|(_, angle)| (STRAIGHT..=SMOOTH).contains(angle))
    }

    /// Whether a boundary is its surface, or a part of that.
    pub fn has(&self, boundary: &str) -> bool {
        let part = boundary.strip_prefix(self.key()).map(|rest| rest.strip_prefix('.').unwrap_or(rest));
        match part {
            Some("") => boundary == self.key(),
            Some(number) => self.surface.len() > 1 && number.parse().is_ok_and(|k: usize| k >= 1 && k <= self.surface.len()),
            None => false,
        }
    }
}

/// A boundary that stays rigid under a resultant.
#[derive(Clone, Debug, PartialEq)]
pub struct Plate {
    /// Name in the case file.
    pub name: String,
    /// Physical curves that move together.
    pub on: Vec<String>,
    /// Its motion; the reference point is the middle of the curves if the case gives none.
    pub motion: RigidSet,
    /// Whether the case gives the reference point.
    pub has_reference: bool,
}

/// `[load.NAME]` with `rigid = true`, on these curves.
pub fn read_plate(section: &Section, on: Vec<String>) -> Option<Plate> {
    for key in ["pressure", "traction"].into_iter().filter(|key| section.has(key)) {
        section.problem(&[key], "stands beside rigid = true; give force and moment, or make two loads".into());
    }
    if !section.has("force") && !section.has("moment") {
        section.problem(&[], "presses with nothing; give force = [fx, fy], moment, or both beside rigid = true".into());
    }
    let about = section.optional("about", values::point);
    let (prescribed, applied) = read_motion(section)?;
    let about_point = about.map_or_else(Point::zeros, |[x, y]| Point::new(x, y));
    let key = format!("load.{}", section.name());
    let motion = RigidSet { key, nodes: RigidNodes::Boundaries(on.clone()), about: about_point, prescribed, applied };
    Some(Plate { name: section.name().into(), on, motion, has_reference: about.is_some() })
}

/// `[rigid.NAME]`
pub fn read_tool(section: &Section) -> Option<Tool> {
    let surface = read_parts(section);
    let about = section.optional("about", values::point);
    let motion = read_motion(section);
    let (surface, (prescribed, applied)) = (surface?, motion?);
    let about = about.map_or_else(|| middle(&surface), |[x, y]| Point::new(x, y));
    let key = format!("{PREFIX}{}", section.name());
    let nodes = RigidNodes::Body(key.clone());
    Some(Tool { surface, motion: RigidSet { key, nodes, about, prescribed, applied } })
}

/// `ux`, `uy`, `angle`, `force`, `moment`: what is prescribed of the motion, and what acts on the rest.
pub fn read_motion(section: &Section) -> Option<([Option<f64>; 3], [f64; 3])> {
    let given = ["ux", "uy", "angle"].map(|key| section.has(key));
    let [ux, uy, angle] = ["ux", "uy", "angle"].map(|key| section.optional(key, values::number));
    let (has_force, has_moment) = (section.has("force"), section.has("moment"));
    let force = section.optional("force", values::point);
    let moment = section.optional("moment", values::number);
    let mut sound = (force.is_some() || !has_force) && (moment.is_some() || !has_moment);
    let [fx, fy] = force.unwrap_or_default();
    let applied = [fx, fy, moment.unwrap_or(0.0)];
    for (k, (component, load)) in [("ux", "force"), ("uy", "force"), ("angle", "moment")].into_iter().enumerate() {
        if given[k] && applied[k] != 0.0 {
            let part = ["its x component", "its y component", "it"][k];
            section.problem(
                &[load],
                format!("stands beside {component}: where {component} is prescribed the {load} follows; leave {component} out, or make {part} 0"),
            );
            sound = false;
        }
    }
    let free = [has_force, has_force, has_moment];
    let values = [ux, uy, angle];
    let prescribed = [0, 1, 2].map(|k| if given[k] || !free[k] { Some(values[k].unwrap_or(0.0)) } else { None });
    sound.then_some((prescribed, applied))
}

/// Whether a boundary is a rigid tool of one curve as it is written, or one line of a tool of several.
pub fn is_one_curve(boundary: &str, root: &Section) -> bool {
    let Some(name) = boundary.strip_prefix(PREFIX) else { return false };
    let lines =
        |table: &toml::Table| table.get("line").and_then(Value::as_array).map_or(1, |points| points.len().saturating_sub(1));
    match root.below("rigid", name) {
        Some(table) => lines(table) == 1,
        None => name.rsplit_once('.').is_some_and(|(name, _)| root.below("rigid", name).is_some()),
    }
}

/// `line`, `circle`, or `x`, `y`, `t`.
fn read_parts(section: &Section) -> Option<Vec<SurfacePart>> {
    let kinds = [section.has("line"), section.has("circle"), ["x", "y", "t"].iter().any(|key| section.has(key))];
    if kinds.iter().filter(|given| **given).count() != 1 {
        let words = "its surface is one of line = [[0, 1], [2, 1]], circle = { centre = [0, 0], radius = 1 }, or x, y, t; give exactly one of them";
        section.problem(&[], words.into());
        for key in ["line", "circle", "x", "y", "t"] {
            section.has(key);
        }
        return None;
    }
    if kinds[0] {
        return section.optional("line", read_line);
    }
    let curve = read_surface(section)?;
    let range = curve.range();
    Some(vec![SurfacePart { curve, range }])
}

/// Two points or more, each joined to the next.
fn read_line(value: &Value) -> Result<Vec<SurfacePart>, String> {
    let points = values::points(value)?;
    if let Some(pair) = points.windows(2).find(|pair| pair[0] == pair[1]) {
        return Err(format!("lists the point ({}, {}) twice; list each once", pair[0][0], pair[0][1]));
    }
    Ok(points.windows(2).map(|pair| SurfacePart { curve: Curve::Line([pair[0], pair[1]]), range: [0.0, 1.0] }).collect())
}

/// Centre of a circle, otherwise the middle between the ends.
fn middle(surface: &[SurfacePart]) -> Point {
    match &surface[0].curve {
        Curve::Circle { centre: [x, y], .. } => Point::new(*x, *y),
        first => {
            let last = &surface[surface.len() - 1];
            0.5 * (first.point(surface[0].range[0]) + last.curve.point(last.range[1]))
        }
    }
}

/// Middle of the box around physical curves.
fn middle_of(mesh: &MacroMesh, on: &[String]) -> Point {
    let edges = on.iter().filter_map(|name| mesh.boundary(name)).flat_map(|boundary| &boundary.edges);
    let vertices = edges.flat_map(|&edge| mesh.edges[edge as usize].vertices).map(|vertex| mesh.vertices[vertex as usize]);
    let box_of = |[low, high]: [Point; 2], x: Point| [low.inf(&x), high.sup(&x)];
    let [low, high] = vertices.fold([Point::repeat(f64::INFINITY), Point::repeat(f64::NEG_INFINITY)], box_of);
    0.5 * (low + high)
}

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

impl Case {
    /// Everything that moves as a rigid body on a mesh.
    pub fn rigid_sets(&self, mesh: &MacroMesh) -> Vec<RigidSet> {
        let plate = |plate: &Plate| match plate.has_reference {
            true => plate.motion.clone(),
            false => RigidSet { about: middle_of(mesh, &plate.on), ..plate.motion.clone() },
        };
        let sets = self.tools.iter().map(|tool| tool.motion.clone()).chain(self.plates.iter().map(plate));
        sets.map(|set| if self.plane == Plane::Revolution { set.along_axis() } else { set }).collect()
    }

    /// Whether a boundary is named after a table `[rigid.NAME]` of the file, whether or not that could be read.
    pub(crate) fn writes_tool_of(&self, boundary: &str) -> bool {
        let names = self.table.get("rigid").and_then(Value::as_table).into_iter().flat_map(toml::Table::keys);
        let of = |name: &String| boundary.strip_prefix(PREFIX).and_then(|rest| rest.strip_prefix(name.as_str()));
        names.filter_map(of).any(|rest| rest.is_empty() || rest.starts_with('.'))
    }

    /// The tool that a boundary is the surface of, or a part of that.
    pub fn tool_of(&self, boundary: &str) -> Option<&Tool> {
        self.tools.iter().find(|tool| tool.has(boundary))
    }
}
