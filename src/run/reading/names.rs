//! Names of a case against those of its mesh.

use crate::body::Body;
use crate::case::{Case, listed};
use crate::contact::Pair;
use crate::geometry::Quote;
use crate::mesh::{MacroMesh, each_once, surfaces};
use std::collections::BTreeSet;
use std::path::Path;

/// Wrong names that are told one by one.
const MOST_WRONG: usize = 40;

/// Names of a case against those of its mesh.
pub struct Names<'a> {
    pub case: &'a Case,
    pub mesh: &'a MacroMesh,
}

impl Names<'_> {
    /// Words for each name that the mesh does not have, and for each body that the case does not; they begin with the file, all other
    /// errors here with the key.
    pub fn wrong(&self) -> Vec<String> {
        let mut wrong: Vec<String> = self.check_bodies().err().into_iter().collect();
        for (key, boundaries) in self.used() {
            let on_mesh = boundaries.iter().filter(|name| !key.starts_with("contact.") || !self.case.writes_tool_of(name));
            wrong.extend(on_mesh.filter_map(|name| self.check_boundary(&key, name).err()));
        }
        wrong.into_iter().map(|words| format!("{}: {words}", self.case.file.display())).collect()
    }

    fn check_bodies(&self) -> Result<(), String> {
        let known = || self.mesh.parts.iter().map(|part| &part.name);
        for (key, name) in self.case.bodies.iter().flat_map(surfaces_of) {
            if !known().any(|other| other == name) {
                let instead = instead(&self.mesh.file, name, known());
                return Err(format!("{key}: no physical surface \"{}\": {instead}", Quote(name)));
            }
        }
        for name in known() {
            if !self.case.bodies.iter().flat_map(|body| &body.parts).any(|part| part.name == *name) {
                let words = format!("has the physical surface \"{name}\"; give its young and poisson");
                return Err(format!("body.{name}: missing, but {} {words}", self.mesh.file.display()));
            }
        }
        Ok(())
    }

    /// Every key of the case that names physical curves.
    fn used(&self) -> Vec<(String, Vec<String>)> {
        let case = self.case;
        let supports = case.supports.iter().map(|s| (format!("support.{}.on", s.name), s.on.clone()));
        let springs = case.springs.iter().map(|s| (format!("support.{}.on", s.name), s.on.clone()));
        let loads = case.loads.iter().map(|l| (format!("load.{}.on", l.name), l.on.clone()));
        let plates = case.plates.iter().map(|plate| (format!("load.{}.on", plate.name), plate.on.clone()));
        let geometries = case.geometries.iter().map(|g| (format!("geometry.{}.curves", g.name), g.curves.clone()));
        let sides = |pair: &Pair| pair.between.iter().flat_map(|name| case.curves_of(name)).collect();
        let contacts = case.contacts.iter().map(|pair| (format!("contact.{}.between", pair.name), sides(pair)));
        supports.chain(springs).chain(loads).chain(plates).chain(geometries).chain(contacts).collect()
    }

    fn check_boundary(&self, key: &str, name: &str) -> Result<(), String> {
        let is_shape = key.starts_with("geometry.");
        let is_inside = self.mesh.interfaces.named(name).is_some();
        if self.mesh.boundary(name).is_some() || is_shape && is_inside {
            return Ok(());
        }
        if is_inside {
            let words = "lies between two parts of a body, where nothing can act; only [geometry] may name it";
            return Err(format!("{key}: \"{name}\" {words}"));
        }
        if self.mesh.loose.iter().any(|curve| curve.name == name) {
            let words = "bounds no body: none of its lines is an edge of a triangle; if its body lacks a `Physical Surface`, or nodes of its own (`Coherence Mesh` merges them), mend the mesh; if it is a rigid tool, leave it out here, and `mezha check` tells how it is written";
            return Err(format!("{key}: \"{name}\" {words}"));
        }
        let known = self.mesh.boundaries.iter().map(|boundary| &boundary.name);
        Err(format!("{key}: no physical curve \"{}\": {}", Quote(name), instead(&self.mesh.file, name, known)))
    }

    /// A boundary that stays rigid lies on one body, and nothing else touches it.
    pub fn check_plates(&self) -> Result<(), String> {
        for plate in &self.case.plates {
            let key = format!("load.{}.on", plate.name);
            let pieces: BTreeSet<usize> = self.mesh.edges_on(&plate.on).map(|edge| self.mesh.piece_beside(edge)).collect();
            if pieces.len() > 1 {
                return Err(format!("{key}: lies on {} bodies or pieces of one; give each a load of its own", pieces.len()));
            }
            let pressed = |pair: &&Pair| {
                pair.between.iter().flat_map(|name| self.case.curves_of(name)).any(|name| plate.on.contains(&name))
            };
            if let Some(pair) = self.case.contacts.iter().find(pressed) {
                let words = "is there, too; a boundary that stays rigid is no side of a contact";
                return Err(format!("{key}: contact.{} {words}", pair.name));
            }
        }
        Ok(())
    }

    /// A name that is made of those of several curves is no physical curve.
    pub fn check_unions(&self) -> Result<(), String> {
        let clash = self.case.unions.iter().find(|union| self.mesh.boundary(&union.name).is_some());
        clash.map_or(Ok(()), |union| {
            let (name, file) = (&union.name, self.mesh.file.display());
            Err(format!(
                "contact: the side \"{name}\" of several curves has the name of a physical curve of {file}; rename that one"
            ))
        })
    }

    /// Each side of a contact lies on one body, and they are two.
    pub fn check_sides(&self, pair: &str, between: &[String; 2]) -> Result<(), String> {
        let key = format!("contact.{pair}.between");
        let mut bodies = Vec::new();
        for name in between.iter().filter(|name| self.case.tool_of(name).is_none()) {
            let found = each_once(self.mesh.edges_of(name).iter().map(|&edge| self.mesh.body_beside(edge)));
            if let [body] = found[..] {
                bodies.push(body);
            } else {
                let words = "name each body's part by itself in the mesh";
                return Err(format!("{key}: \"{name}\" lies on {} bodies; {words}", found.len()));
            }
        }
        if bodies.len() == 2 && bodies[0] == bodies[1] {
            let name = &self.mesh.bodies[bodies[0]];
            return Err(format!("{key}: both sides lie on body \"{name}\"; contact of a body with itself is not modelled"));
        }
        Ok(())
    }
}

/// One line for each of them; of many the first.
pub fn together(all: &[String]) -> String {
    let first = all[..all.len().min(MOST_WRONG)].join("\n");
    match all.len().saturating_sub(MOST_WRONG) {
        0 => first,
        more => format!("{first}\n{more} more of them; correct these first"),
    }
}

/// Words for a part that is no physical surface of a mesh: that may be why it cannot be connected.
pub fn unknown_part(case: &Case, bytes: &[u8]) -> Option<String> {
    let surfaces = surfaces(bytes, &case.mesh.file).ok()?;
    let mut parts = case.bodies.iter().filter(|body| body.has_parts()).flat_map(surfaces_of);
    let (key, name) = parts.find(|(_, name)| !surfaces.contains(name))?;
    let instead = instead(&case.mesh.file, name, surfaces.iter());
    Some(format!("{key}: no physical surface \"{}\": {instead}", Quote(name)))
}

/// The physical surfaces of a body: the key of each in the case, and its name.
fn surfaces_of(body: &Body) -> impl Iterator<Item = (String, &String)> {
    body.parts.iter().map(move |part| (body.key_of(part), &part.name))
}

/// What a mesh has instead of a name that it has not.
fn instead<'n>(file: &Path, name: &str, known: impl Iterator<Item = &'n String>) -> String {
    let known: Vec<&String> = known.collect();
    let file = file.display();
    if known.is_empty() {
        return format!("{file} has none at all; name them in the .geo file, and mesh it again");
    }
    let distance = |other: &String| strsim::damerau_levenshtein(Quote(name).head(), Quote(other).head());
    let near = known.iter().min_by_key(|other| distance(other)).filter(|other| distance(other) <= 3);
    let guess = near.map_or(String::new(), |other| format!("; did you mean \"{}\"?", Quote(other)));
    format!("{file} has no such name{guess}; it has {}", listed(known.iter().map(|other| format!("\"{}\"", Quote(other)))))
}
