//! Sides of contacts: one physical curve or several, each side in one contact, and the geometry of both.

use std::collections::HashMap;

use crate::case::bodies::geometry::Geometry;
use crate::case::keys::Section;
use crate::contact::{CurveChoice, Pair};

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
