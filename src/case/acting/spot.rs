//! `at = [x, y]`, and `body` beside it: points of bodies that are held or loaded.

use crate::case::keys::{Key, Section};
use crate::mesh::Spot;

/// Where a support or a load acts: on physical curves, or at a point.
pub struct Where {
    /// Physical curves.
    pub on: Vec<String>,
    /// Instead of curves, a point.
    pub at: Option<Spot>,
}

/// `on`, or `at` and perhaps `body`, which is one of the case.
pub fn read_where(
    section: &Section,
    root: &Section,
    on: Key<Vec<String>>,
    at: Key<[f64; 2]>,
    body: Key<String>,
) -> Option<Where> {
    let (at, body) = (section.optional(at), section.optional(body));
    if !section.has("at") {
        if section.has("body") {
            section.problem(&["body"], "stands beside at = [x, y] only: a physical curve tells its body; leave it out");
        }
        let on = section.required(on);
        return Some(Where { on: on?, at: None });
    }
    if section.has("on") {
        section.problem(&["at"], "stands beside on; give physical curves or a point, or make two tables");
        return None;
    }
    let place = at?;
    if let Some(body) = &body {
        section.check_name(&["body"], "body", body, root.names_below("body"));
    }
    Some(Where { on: Vec::new(), at: Some(Spot { place, body }) })
}
