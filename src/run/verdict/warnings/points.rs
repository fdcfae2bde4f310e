//! What is said of points that carry forces, since the displacement there has no limit in the plane, and of mean motions that loads
//! drive.

use crate::body::{MeanHold, PointLoad, Support};
use crate::discretisation::Scene;
use crate::geometry::Point;
use crate::recovery::Evaluation;
use crate::run::verdict::limits::LITTLE_FORCE;
use crate::run::words::four_digits;

/// A warning for each point that carries a force, and for each mean motion that is driven.
pub fn loaded_points(Evaluation { problem, balance, .. }: &Evaluation) -> Vec<String> {
    let little = LITTLE_FORCE * balance.forces;
    let words = |(support, reaction): (&Support, &Point)| {
        let [x, y] = support.at.as_ref()?.place;
        (reaction.norm() > little).then(|| {
            format!(
                "support {}: the point at ({x}, {y}) carries a force of {}: the displacement there depends on the mesh, and grows with every refinement like the logarithm of the edge length; where loads are to be carried, support a boundary",
                support.name,
                force_words(*reaction)
            )
        })
    };
    let loaded = |load: &PointLoad| {
        let [x, y] = load.at.place;
        format!(
            "load {}: a force at the point ({x}, {y}) has an infinite energy, and moves its own point without limit as the mesh is refined; what is farther away than some edges is right",
            load.name
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
        format!(
            "support {}: the mean motion that it holds is driven by a force of {} and a moment of {}, which act on \"{}\" here like a weight, all over it; {}",
            hold.name,
            force_words(force),
            four_digits(moment, size * reach),
            hold.body,
            remedy(scene, &hold.body)
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
