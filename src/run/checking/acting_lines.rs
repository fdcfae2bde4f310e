//! What acts on a scene, in lines: loads with their resultants, supports with what they hold, contacts with how far apart their
//! sides are drawn.

use super::drawing::acting;
use super::proposals::short;
use crate::case::Case;
use crate::contact::{GapChoice, Pair, drawn_gap};
use crate::discretisation::Scene;
use crate::element::Plane;
use crate::geometry::Point;
use crate::mesh::Numbering;
use crate::output::plot::{BoundaryPoint, DrawnLoad, DrawnSupport, number_text};
use crate::output::summary::{MOST_TOLD, lines_alike};

/// Of so many things of a kind is found what is said of them; a thousand gaps would take their time.
const MOST_LOOKED_AT: usize = 100;

/// The lines, of each kind as many as are told.
pub fn acting_lines(case: &Case, scene: &Scene, numbering: &Numbering) -> Vec<String> {
    let (plane, (supports, loads)) = (scene.mesh.plane, acting(case, &scene.mesh));
    let load = |load: &DrawnLoad| (format!("{}{}", load.words, resultant_words(load, plane)), load.name.clone());
    let mut lines = few(["load", "loads"], loads.len(), loads.iter().map(load));
    let support = |support: &DrawnSupport| (support.words.clone(), support.name.clone());
    lines.extend(few(["support", "supports"], supports.len(), supports.iter().map(support)));
    let contact = |pair: &Pair| (gap_words(scene, numbering, pair), pair.name.clone());
    lines.extend(few(["contact", "contacts"], scene.pairs.len(), scene.pairs.iter().map(contact)));
    lines
}

/// As many lines as are told, and how many more there are.
fn few(kind: [&str; 2], count: usize, all: impl Iterator<Item = (String, String)>) -> Vec<String> {
    let told: Vec<(usize, String)> = lines_alike(kind, all.take(MOST_LOOKED_AT)).into_iter().take(MOST_TOLD).collect();
    let more = count - told.iter().map(|(own, _)| own).sum::<usize>();
    // Figures have a minus sign of their own.
    let lines = told.into_iter().map(|(_, line)| line.replace('−', "-"));
    lines.chain((more > 0).then(|| format!("and {more} more {}", kind[1]))).collect()
}

/// The force of tractions along a boundary, of the whole ring in a body of revolution; nothing where the name tells the force.
fn resultant_words(load: &DrawnLoad, plane: Plane) -> String {
    if load.resultant.is_some() || load.rows.is_empty() {
        return String::new();
    }
    let part = |two: &[BoundaryPoint]| {
        let [a, b] = [&two[0], &two[1]].map(|end| (Point::from(end.place), Point::from(end.traction)));
        0.5 * (a.1 + b.1) * (b.0 - a.0).norm() * plane.width(0.5 * (a.0 + b.0))
    };
    let sum: Point = load.rows.iter().flat_map(|row| row.windows(2)).map(part).sum();
    let size = load.rows.iter().flat_map(|row| row.windows(2)).map(|two| part(two).norm()).sum::<f64>();
    let [x, y] = plane.resultant(sum).map(|part| if part.abs() < 1e-9 * size { 0.0 } else { part }).into();
    format!(", resultant ({}, {})", number_text(x), number_text(y))
}

/// How far the sides of a contact are drawn apart, or into each other, or what gap is given in the place of that.
fn gap_words(scene: &Scene, numbering: &Numbering, pair: &Pair) -> String {
    match &pair.gap {
        GapChoice::Closed => return "closed, wherever its sides are drawn".into(),
        GapChoice::Formula(gap) => return format!("a gap of {} is given", gap.text()),
        GapChoice::Geometry => {}
    }
    match drawn_gap(&scene.mesh, numbering, pair) {
        None => "its sides do not face each other as they are drawn".into(),
        Some(gap) if gap.touches() => "its sides are drawn touching".into(),
        Some(gap) if gap.least > 0.0 => format!("its sides are drawn {} apart", short(gap.least)),
        Some(gap) => format!("its sides are drawn {} into each other, which presses", short(-gap.least)),
    }
}
