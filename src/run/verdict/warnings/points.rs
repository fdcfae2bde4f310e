//! What is said of points that carry forces: the displacement there has no limit in the plane.

use crate::body::{MeanHold, PointLoad, Support};
use crate::geometry::Point;
use crate::recovery::Evaluation;
use crate::run::verdict::limits::LITTLE_FORCE;
use crate::run::words::short;

/// A warning for each point that carries a force.
pub fn loaded_points(Evaluation { problem, balance, .. }: &Evaluation) -> Vec<String> {
    let words = |(support, reaction): (&Support, &Point)| {
        let [x, y] = support.at.as_ref()?.place;
        (reaction.norm() > LITTLE_FORCE * balance.forces).then(|| {
            format!(
                "support {}: the point at ({x}, {y}) carries a force of ({}, {}): the displacement there depends on the mesh, and grows with every refinement like the logarithm of the edge length; where loads are to be carried, support a boundary",
                support.name,
                short(reaction.x),
                short(reaction.y)
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
    let driven = |(hold, (reaction, moment)): (&MeanHold, (&Point, &f64))| {
        let reach = hold.reach(&problem.scene.mesh);
        (reaction.norm() + moment.abs() / reach > LITTLE_FORCE * balance.forces).then(|| {
            format!(
                "support {}: the mean motion that it holds is driven by a force of ({}, {}) and a moment of {}, which act on \"{}\" here like a weight, all over it; where loads are to be carried, support a boundary",
                hold.name,
                short(reaction.x),
                short(reaction.y),
                short(*moment),
                hold.body
            )
        })
    };
    let means = problem.scene.means.iter().zip(balance.reactions.iter().skip(first).zip(&balance.mean_moments));
    let means = means.filter_map(driven);
    let supports = problem.scene.supports.iter().zip(&balance.reactions).filter_map(words);
    supports.chain(means).chain(problem.scene.point_loads.iter().map(loaded)).collect()
}
