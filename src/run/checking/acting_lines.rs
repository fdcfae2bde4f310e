//! What acts on a scene, in lines: loads with their resultants, supports with what they hold, contacts with how far apart their
//! sides are drawn.

use super::drawing::{acting, vector};
use super::proposals::short;
use crate::body::{Applied, BodyPart, applied_forces};
use crate::case::Case;
use crate::contact::{GapChoice, Pair, drawn_gap};
use crate::discretisation::Scene;
use crate::geometry::{Formula, Point};
use crate::mesh::Numbering;
use crate::output::Units;
use crate::output::plot::{BoundaryPoint, DrawnLoad, DrawnSupport};
use crate::output::summary::{MOST_TOLD, lines_alike};
use crate::run::words::units;

/// Parts of a resultant below this share of its pieces are rounding.
const ROUNDING: f64 = 1e-9;

/// Of so many things of a kind is found what is said of them; a thousand gaps would take their time.
const MOST_LOOKED_AT: usize = 100;

/// The lines, of each kind as many as are told.
pub fn acting_lines(case: &Case, scene: &Scene, numbering: &Numbering) -> Vec<String> {
    let (units, (supports, loads)) = (units(case), acting(case, &scene.mesh));
    let resultant = |load: &DrawnLoad| {
        let (force, size) = resultant(scene, load)?;
        let force = scene.mesh.plane.resultant(force).map(|part| if part.abs() < ROUNDING * size { 0.0 } else { part });
        Some(format!(", resultant {}{}", vector(force * case.thickness), units.resultant().after()))
    };
    let load = |load: &DrawnLoad| (format!("{}{}", load.words, resultant(load).unwrap_or_default()), load.name.clone());
    let mut lines = few(["load", "loads"], loads.len(), loads.iter().map(load));
    let support = |support: &DrawnSupport| (support.words.clone(), support.name.clone());
    lines.extend(few(["support", "supports"], supports.len(), supports.iter().map(support)));
    let contact = |pair: &Pair| (gap_words(scene, numbering, pair, &units), pair.name.clone());
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

/// The force of tractions along a boundary, or in a part, per thickness, of the whole ring in a body of revolution, and how large its
/// pieces are together; nothing where the words tell the force.
fn resultant(scene: &Scene, load: &DrawnLoad) -> Option<(Point, f64)> {
    let plane = scene.mesh.plane;
    let mut pieces: Vec<Point> = Vec::new();
    if let Some(own) = load.part {
        // The mesh of the file is fine enough for that.
        let numbering = scene.macro_numbering().ok()?;
        let nothing = || [0, 1].map(|_| Formula::constant(0.0));
        let all = scene.parts().into_iter().enumerate().map(|(at, part)| {
            let force = if at == own { part.force.clone() } else { nothing() };
            BodyPart { force, heat: None, ..part.clone() }
        });
        let all: Vec<BodyPart> = all.collect();
        let applied = Applied { parts: &all.iter().collect::<Vec<_>>(), loads: &[], point_loads: &[] };
        applied_forces(&scene.mesh, &scene.partition, 0, &numbering, &applied, |_, force| pieces.push(force)).ok()?;
    } else if load.resultant.is_none() {
        let traction = |two: &[BoundaryPoint]| {
            let [a, b] = [&two[0], &two[1]].map(|end| (Point::from(end.place), Point::from(end.traction)));
            0.5 * (a.1 + b.1) * (b.0 - a.0).norm() * plane.width(0.5 * (a.0 + b.0))
        };
        pieces.extend(load.rows.iter().flat_map(|row| row.windows(2)).map(traction));
    }
    (!pieces.is_empty()).then(|| (pieces.iter().sum(), pieces.iter().map(|piece| piece.norm()).sum()))
}

/// How far the sides of a contact are drawn apart, or into each other, or what gap is given in the place of that.
fn gap_words(scene: &Scene, numbering: &Numbering, pair: &Pair, units: &Units) -> String {
    let length = |length: f64| short(length) + &units.length().after();
    match &pair.gap {
        GapChoice::Closed => return "closed, wherever its sides are drawn".into(),
        GapChoice::Formula(gap) => return format!("a gap of {} is given", gap.text()),
        GapChoice::Geometry => {}
    }
    match drawn_gap(&scene.mesh, numbering, pair) {
        None => "its sides do not face each other as they are drawn".into(),
        Some(gap) if gap.touches() => "its sides are drawn touching".into(),
        Some(gap) if gap.least > 0.0 => format!("its sides are drawn {} apart", length(gap.least)),
        Some(gap) => format!("its sides are drawn {} into each other, which presses", length(-gap.least)),
    }
}
