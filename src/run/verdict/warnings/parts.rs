//! Words for bodies whose material or whose strain the model or its elements are not good for.

use crate::body::BodyPart;
use crate::discretisation::Scene;
use crate::element::Order;
use crate::output::summary::MOST_TOLD;
use crate::recovery::Evaluation;
use crate::run::verdict::limits::{P1_STIFF, SMALL_STRAIN, percent};
use crate::run::words::short;

/// Parts that P1 triangles are too stiff for.
pub fn locking(scene: &Scene) -> Vec<String> {
    let locks = |part: &&BodyPart| scene.order == Order::P1 && part.material.poisson_in_plane() > P1_STIFF;
    let words = |part: &BodyPart| {
        format!("body {} has ν = {}: P1 triangles lock towards 0.5; take mesh.order = 2", part.name, part.material.poisson)
    };
    scene.parts().into_iter().filter(locks).map(words).collect()
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
