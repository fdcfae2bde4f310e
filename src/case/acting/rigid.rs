//! `[rigid.NAME]`: rigid tools; and boundaries of bodies that stay rigid.

use std::slice;

use toml::Value;

use super::motion::{ABOUT, CARRIED, MOTION, read_motion};
use crate::body::{RigidNodes, RigidSet};
use crate::case::bodies::geometry::{SURFACE, read_surface};
use crate::case::keys::{ListForm, POINT, Section, TableRule, ValueForm, declare, entries, key, of, table};
use crate::geometry::{Curve, Point, cross};
use crate::mesh::CurvePiece;

declare! {
    /// A rigid tool; in `between` it is called `"rigid.NAME"`, see [rigid tools and plates](#rigid-tools-and-plates).
    static RIGID = table("rigid").rules(&[
        TableRule::OneOf(&[&["line"], &["circle"], &["x", "y", "t"]]),
        TableRule::Alone("line", &["circle", "x", "y", "t"]),
        TableRule::Alone("circle", &["x", "y", "t"]),
    ]);
    /// Its surface: points, each joined to the next, `[[0, 1], [2, 1]]`. Of several lines each has a name, `"rigid.NAME.1"`, ...;
    /// where they turn by less than 20 degrees, the whole of them is no side of a contact: a spline would round the corner.
    /// Instead: a circle or formulas, as of a `[geometry]`.
    const LINE: Vec<[f64; 2]> = key("line", of(ValueForm::List(CORNERS))).unit("length");
    ..SURFACE;
    ..CARRIED;
    ..MOTION;
}

const CORNERS: ListForm = ListForm {
    count: [2, usize::MAX],
    few: "must list two points or more, as in [[0, 1], [2, 1]]",
    ..entries(&POINT, "a list of points [[x, y], ...]")
};

/// Lines that turn by less than this (degrees) go straight on, and boundaries that turn by no more than that are taken for smooth.
const STRAIGHT: f64 = 1e-4;
const SMOOTH: f64 = 20.0;

/// What the boundaries of tools begin with.
pub const PREFIX: &str = "rigid.";

/// A rigid tool: a surface that moves as a rigid body.
#[derive(Clone, Debug, PartialEq)]
pub struct Tool {
    /// Its surface; parts follow each other.
    pub surface: Vec<CurvePiece>,
    /// Its motion.
    pub motion: RigidSet,
}

impl Tool {
    /// Its name as a body and as a boundary of contacts: `rigid.NAME`.
    pub fn key(&self) -> &str {
        &self.motion.key
    }

    /// The curves of a boundary that it has: all, or one; none of any other boundary.
    pub fn parts_of(&self, boundary: &str) -> &[CurvePiece] {
        let part = |number: &str| self.surface.get(number.strip_prefix('.')?.parse::<usize>().ok()?.checked_sub(1)?);
        match boundary.strip_prefix(self.key()) {
            Some("") => &self.surface,
            Some(number) if self.surface.len() > 1 => part(number).map(slice::from_ref).unwrap_or_default(),
            _ => &[],
        }
    }

    /// The first corner (from 1) that is too blunt to be taken for one, and its angle in degrees: boundaries that turn by less than
    /// 20 degrees are taken for smooth ones.
    pub fn blunt_corner(&self) -> Option<(usize, f64)> {
        let turn = |pair: &[CurvePiece]| {
            let (a, b) = (pair[0].curve.tangent(pair[0].range[1]), pair[1].curve.tangent(pair[1].range[0]));
            cross(a, b).atan2(a.dot(&b)).abs().to_degrees()
        };
        let mut corners = self.surface.windows(2).map(turn).enumerate().map(|(k, angle)| (k + 1, angle));
        corners.find(|(_, angle)| (STRAIGHT..=SMOOTH).contains(angle))
    }

    /// Whether a boundary is its surface, or a part of that.
    pub fn has(&self, boundary: &str) -> bool {
        !self.parts_of(boundary).is_empty()
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
    section.refuse(&["pressure", "traction"], "stands beside rigid = true; give force and moment, or make two loads");
    if !section.has("force") && !section.has("moment") {
        let moved =
            if section.has("ux") || section.has("uy") { "; a boundary that is moved is a [support] with ux and uy" } else { "" };
        let words = "presses with nothing; give force = [fx, fy], moment, or both beside rigid = true";
        section.problem(&[], format!("{words}{moved}"));
    }
    let given = section.optional(ABOUT).map(Point::from);
    let (prescribed, applied) = read_motion(section)?;
    let (key, about) = (format!("load.{}", section.name()), given.unwrap_or_default());
    let motion = RigidSet { key, nodes: RigidNodes::Boundaries(on.clone()), about, prescribed, applied };
    Some(Plate { name: section.name().into(), on, motion, has_reference: given.is_some() })
}

/// `[rigid.NAME]`
pub fn read_tool(section: &Section) -> Option<Tool> {
    let surface = read_parts(section);
    let about = section.optional(ABOUT);
    let motion = read_motion(section);
    let (surface, (prescribed, applied)) = (surface?, motion?);
    let about = about.map_or_else(|| middle(&surface), Point::from);
    let key = format!("{PREFIX}{}", section.name());
    let nodes = RigidNodes::Body(key.clone());
    Some(Tool { surface, motion: RigidSet { key, nodes, about, prescribed, applied } })
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
fn read_parts(section: &Section) -> Option<Vec<CurvePiece>> {
    let kinds = [section.has("line"), section.has("circle"), section.has_any(&["x", "y", "t"])];
    if kinds.iter().filter(|given| **given).count() != 1 {
        let words = "its surface is one of line = [[0, 1], [2, 1]], circle = { centre = [0, 0], radius = 1 }, or x, y, t; give exactly one of them";
        section.problem(&[], words);
        return None;
    }
    if kinds[0] {
        return section.made("line", section.optional(LINE), joined);
    }
    let curve = read_surface(section)?;
    let range = curve.range();
    Some(vec![CurvePiece { curve: curve.into(), range }])
}

/// Two points or more, each joined to the next.
fn joined(points: Vec<[f64; 2]>) -> Result<Vec<CurvePiece>, String> {
    if let Some(pair) = points.windows(2).find(|pair| pair[0] == pair[1]) {
        return Err(format!("lists the point ({}, {}) twice; list each once", pair[0][0], pair[0][1]));
    }
    Ok(points.windows(2).map(|pair| CurvePiece { curve: Curve::Line([pair[0], pair[1]]).into(), range: [0.0, 1.0] }).collect())
}

/// Centre of a circle, otherwise the middle between the ends.
fn middle(surface: &[CurvePiece]) -> Point {
    match &*surface[0].curve {
        Curve::Circle { centre: [x, y], .. } => Point::new(*x, *y),
        first => {
            let last = &surface[surface.len() - 1];
            0.5 * (first.point(surface[0].range[0]) + last.curve.point(last.range[1]))
        }
    }
}
