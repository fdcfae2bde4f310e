//! Words for solutions that stand on little: gaps that are drawn otherwise than they are declared, large strains, forces at points,
//! mean motions that loads drive, and triangles that are too flat.

use crate::body::{MeanHold, PointLoad, Support};
use crate::contact::GapChoice;
use crate::discretisation::{Contact, Scene};
use crate::geometry::Point;
use crate::mesh::MacroMesh;
use crate::output::summary::MOST_TOLD;
use crate::recovery::{Evaluation, TracePoint};
use crate::run::verdict::limits::{FORMULA_OFF, GAP_OFF, LITTLE_FORCE, MANY_SLIVERS, SLIVER, SMALL_STRAIN, percent};
use crate::run::words::{four_digits, short};

/// Words for boundaries that are drawn apart, or into each other, by more than their polygons can be, though the gap is declared to
/// be another.
pub fn apart(contact: &Contact, points: &[TracePoint]) -> Option<String> {
    let segment = contact.boundary.length() / contact.boundary.segments() as f64;
    let apart = |point: &TracePoint| {
        let drawn = point.distance[1] - point.distance[0];
        let (off, share) = match &contact.pair.gap {
            GapChoice::Geometry => return None,
            GapChoice::Closed => (drawn.abs(), 0.0),
            GapChoice::Formula(formula) => ((drawn - formula.value(&[point.x.x, point.x.y])).abs(), FORMULA_OFF),
        };
        // Boundaries that are drawn as touching say nothing of the gap.
        (drawn.abs().min(off) > GAP_OFF * segment + share * drawn.abs()).then_some((drawn, point.x))
    };
    let all = points.iter().filter(|point| point.is_complete()).filter_map(apart);
    let (drawn, x) = all.max_by(|a, b| a.0.abs().total_cmp(&b.0.abs()))?;
    let ([left, up], off) = ([x.x, x.y].map(short), drawn.abs());
    let how = if drawn > 0.0 { "apart" } else { "into each other" };
    let words = match &contact.pair.gap {
        GapChoice::Formula(formula) => format!(
            "gap = {} is declared, {:.3e} at ({left}, {up}), but the boundaries are drawn {off:.3e} {how} there; the declared gap counts; if the drawn one is meant, give gap = \"geometry\"",
            formula.text(),
            formula.value(&[x.x, x.y])
        ),
        _ => format!(
            "gap = \"closed\", but the boundaries lie up to {off:.3e} apart; if that is no error of the mesh, give gap = \"geometry\""
        ),
    };
    Some(format!("contact {}: {words}", contact.pair.name))
}

/// Bodies that are strained farther than a theory of small strain goes; of many the worst first.
pub fn large_strains(found: &Evaluation) -> Vec<String> {
    let bodies = found.problem.scene.bodies.iter().zip(&found.deformations);
    let mut strained: Vec<_> = bodies.filter(|(_, largest)| largest.strain > SMALL_STRAIN).collect();
    if strained.len() > MOST_TOLD {
        strained.sort_by(|a, b| b.1.strain.total_cmp(&a.1.strain));
    }
    let words = strained.iter().map(|(body, largest)| {
        let (name, strain, [x, y]) = (&body.name, percent(largest.strain), [largest.place.x, largest.place.y].map(short));
        format!(
            "body {name} is strained by {strain} % near ({x}, {y}): the model is that of small strain, and may be off by more than that"
        )
    });
    words.collect()
}

/// Bodies that pass through each other, since the case has no contact there.
pub fn crossed(found: &Evaluation) -> Vec<String> {
    let crossings = found.crossings().into_iter();
    let words = crossings.map(|crossing| {
        let ([a, b], [x, y]) = (&crossing.between, [crossing.place.x, crossing.place.y].map(short));
        format!(
            "\"{a}\" and \"{b}\" are in no contact, and lie in each other by {:.2e} near ({x}, {y}): the bodies pass through each other there; if they are to touch, paste what `mezha check` proposes, [contact.NAME] between = [\"{a}\", \"{b}\"]",
            crossing.depth
        )
    });
    words.collect()
}

/// What is said of an adapted mesh that is too large for its accuracy, if slivers of the file are left in many places.
pub fn slivers(mesh: &MacroMesh) -> Option<String> {
    let angles = (0..mesh.triangles.len()).map(|triangle| mesh.smallest_angle(triangle).to_degrees());
    let flat: Vec<f64> = angles.filter(|angle| *angle < SLIVER).collect();
    let smallest = flat.iter().copied().fold(f64::INFINITY, f64::min);
    (flat.len() as f64 >= MANY_SLIVERS * mesh.triangles.len() as f64).then(|| {
        let (count, all, smallest) = (flat.len(), mesh.triangles.len(), short(smallest));
        format!(
            "{count} of {all} macro triangles have angles below {SLIVER} degrees, down to {smallest}: such slivers need many more unknowns; draw the mesh file without them"
        )
    })
}

/// A warning for each point that carries a force, and for each mean motion that is driven.
pub fn loaded_points(Evaluation { problem, balance, .. }: &Evaluation) -> Vec<String> {
    let little = LITTLE_FORCE * balance.forces;
    let words = |(support, reaction): (&Support, &Point)| {
        let [x, y] = support.at.as_ref()?.place;
        (reaction.norm() > little).then(|| {
            let (name, force) = (&support.name, force_words(*reaction));
            format!(
                "support {name}: the point at ({x}, {y}) carries a force of {force}: the displacement there depends on the mesh, and grows with every refinement like the logarithm of the edge length; where loads are to be carried, support a boundary"
            )
        })
    };
    let loaded = |load: &PointLoad| {
        let (name, [x, y]) = (&load.name, load.at.place);
        format!(
            "load {name}: a force at the point ({x}, {y}) has an infinite energy, and moves its own point without limit as the mesh is refined; what is farther away than some edges is right"
        )
    };
    let first = problem.scene.supports.len() + problem.scene.springs.len();
    let means = problem.scene.means.iter().zip(balance.reactions.iter().skip(first).zip(&balance.mean_moments));
    let means = means.filter_map(|(hold, (reaction, moment))| driven_mean(&problem.scene, hold, *reaction, *moment, little));
    let supports = problem.scene.supports.iter().zip(&balance.reactions).filter_map(words);
    supports.chain(means).chain(problem.scene.point_loads.iter().map(loaded)).collect()
}

/// A warning for a mean motion that a force and a moment drive, if they are more than little.
fn driven_mean(scene: &Scene, hold: &MeanHold, force: Point, moment: f64, little: f64) -> Option<String> {
    let reach = hold.reach;
    let size = force.norm() + moment.abs() / reach;
    (size > little).then(|| {
        let MeanHold { name, body, .. } = hold;
        let (force, moment, remedy) = (force_words(force), four_digits(moment, size * reach), remedy(scene, body));
        format!(
            "support {name}: the mean motion that it holds is driven by a force of {force} and a moment of {moment}, which act on \"{body}\" here like a weight, all over it; {remedy}"
        )
    })
}

/// What is to carry the loads of a body in the place of its mean: its contacts, where it has any, or a support.
fn remedy(scene: &Scene, body: &str) -> String {
    let mesh = &scene.mesh;
    let touches = |name: &str| scene.pairs.iter().any(|pair| pair.between.iter().any(|side| side == name));
    let is_own = |edges: &[u32]| edges.first().is_some_and(|&edge| mesh.bodies[mesh.body_beside(edge)] == body);
    let (touched, free): (Vec<_>, Vec<_>) =
        mesh.boundaries.iter().filter(|own| is_own(&own.edges)).partition(|own| touches(&own.name));
    let is_loaded = |name: &String| scene.loads.iter().any(|load| load.on.contains(name));
    let support = match free.iter().find(|boundary| !boundary.is_union && !is_loaded(&boundary.name)) {
        Some(boundary) => format!("support a boundary, as \"{}\"", boundary.name),
        None => "hold a place of the body, by at = [x, y], whose own displacement depends on the mesh then".into(),
    };
    match touched.is_empty() {
        true => format!("where loads are to be carried, {support}"),
        false => format!(
            "to let contact carry that, leave this support out and hold what `mezha check` then proposes, of a pin in a hole angle = 0.0 alone; where contact cannot, {support}"
        ),
    }
}

/// `(12.3, 0)`: components that are nothing beside the whole are 0.
fn force_words(force: Point) -> String {
    let [x, y] = [force.x, force.y].map(|part| four_digits(part, force.norm()));
    format!("({x}, {y})")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::samples::{columns, two_blocks};

    #[test]
    fn slivers_are_told_and_good_triangles_are_not() {
        assert_eq!(slivers(&two_blocks()), None);
        let words = slivers(&columns(4, 20.0)).expect("columns of 1 x 20");
        assert!(words.starts_with("8 of 8 macro triangles have angles below 10 degrees, down to 2.86: "), "{words}");
    }
}
