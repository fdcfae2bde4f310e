//! `at = [x, y]`, and `body` beside it: points of bodies that are held or loaded.

use super::error::suggest;
use super::section::Section;
use super::values;
use crate::mesh::Spot;

/// Where a support or a load acts: on physical curves, or at a point.
pub struct Where {
    /// Physical curves.
    pub on: Vec<String>,
    /// Instead of curves, a point.
    pub at: Option<Spot>,
}

/// `on`, or `at` and perhaps `body`.
pub fn read_where(section: &Section) -> Option<Where> {
    let at = section.optional("at", values::point);
    let body = section.optional("body", values::name);
    if !section.has("at") {
        if section.has("body") {
            section.problem(&["body"], "stands beside at = [x, y] only: a physical curve tells its body; leave it out".into());
        }
        let on = section.required("on", values::names);
        return Some(Where { on: on?, at: None });
    }
    if section.has("on") {
        section.problem(&["at"], "stands beside on; give physical curves or a point, or make two tables".into());
        return None;
    }
    Some(Where { on: Vec::new(), at: Some(Spot { place: at?, body }) })
}

/// Points ask for bodies of the case; `table` holds them under these names.
pub fn check_spots<'a>(table: &str, all: impl Iterator<Item = (&'a String, &'a Spot)>, root: &Section) {
    for (name, spot) in all {
        let Some(body) = &spot.body else { continue };
        if !root.names_below("body").any(|known| known == body) {
            let words = format!("no such body; {}", suggest(body, root.names_below("body")));
            root.problem(&[table, name, "body"], words);
        }
    }
}
