//! Words for cases and meshes that are likely not what is meant, before anything is solved.

use crate::body::{BodyPart, RigidSet};
use crate::case::Case;
use crate::discretisation::{Contact, Scene};
use crate::element::Order;
use crate::mesh::{MacroMesh, Numbering, Slit};
use crate::run::verdict::limits::{P1_STIFF, ROTATION};
use crate::run::words::short;

/// What is said of a scene in which nothing acts.
pub const IDLE: &str = "nothing loads, moves or presses the bodies, so that they stay as they are drawn";

/// What would act.
const TO_DRIVE: &str = "give a load, a support that moves, heat, or a negative gap";

/// A sentence for a scene in which nothing acts.
pub fn idle(scene: &Scene, numbering: &Numbering) -> Option<String> {
    (!scene.is_driven(numbering)).then(|| format!("{IDLE}; {TO_DRIVE}"))
}

/// A sentence for each body of whose boundary edges some lie on each other.
pub fn slits(mesh: &MacroMesh) -> Vec<String> {
    let words = |Slit { body, pairs, place }: Slit| {
        let edges = if pairs == 1 { "pair of boundary edges that lies" } else { "pairs of boundary edges that lie" };
        let (name, [x, y]) = (&mesh.bodies[body], [place.x, place.y].map(short));
        format!(
            "body \"{name}\" has {pairs} {edges} on each other, near ({x}, {y}): a slit that nothing closes; if none is meant, its nodes were not merged: merge them with `Coherence Mesh` in gmsh"
        )
    };
    mesh.slits().into_iter().map(words).collect()
}

/// Parts that P1 triangles are too stiff for.
pub fn locking(scene: &Scene) -> Vec<String> {
    let strained = scene.bodies.iter().enumerate().filter(|(body, _)| !scene.is_rigid(*body)).flat_map(|(_, body)| &body.parts);
    let locks = |part: &&BodyPart| scene.order == Order::P1 && part.material.poisson_in_plane() > P1_STIFF;
    let words = |part: &BodyPart| {
        format!("body {} has ν = {}: P1 triangles lock towards 0.5; take mesh.order = 2", part.name, part.material.poisson)
    };
    strained.filter(locks).map(words).collect()
}

/// Contacts with such segments, and what is done about them.
pub fn short_segments(contacts: &[Contact]) -> Vec<String> {
    let words = |contact: &Contact| {
        let remedy =
            if contact.jumps.is_empty() { "watch inf_sup and oscillation" } else { "the jump term is added (stabilise)" };
        let (name, ratio, safe) = (&contact.pair.name, short(contact.segment_ratio), contact.safe_ratio);
        format!("contact {name}: segments of {ratio} edges of the softer body, {safe} or more are safe: {remedy}")
    };
    contacts.iter().filter(|contact| contact.has_short_segments()).map(words).collect()
}

/// Words for each rigid tool and each plate whose given angle no theory of small rotations is good for; of load steps the
/// largest angle counts.
pub fn far_turns(case: &Case) -> Vec<String> {
    let largest = |key: &str| {
        let steps = case.steps.iter().flat_map(|step| motions(&step.case));
        let same = steps.chain(motions(case)).filter(|motion| motion.key == key);
        same.filter_map(|motion| motion.prescribed[2]).max_by(|a, b| a.abs().total_cmp(&b.abs()))
    };
    let far = |key: &str| largest(key).filter(|angle| angle.abs() > ROTATION.value);
    let words = |motion: &RigidSet| {
        let (key, most) = (&motion.key, ROTATION.value);
        let angle = far(key)?;
        Some(format!(
            "{key}.angle = {angle}: radians, of which {most} can be trusted at most: the theory is that of small rotations; draw it as it lies after turning, and turn it by less"
        ))
    };
    motions(case).filter_map(words).collect()
}

/// What the case says of the motion of its tools and its plates.
fn motions(case: &Case) -> impl Iterator<Item = &RigidSet> {
    case.tools.iter().map(|tool| &tool.motion).chain(case.plates.iter().map(|plate| &plate.motion))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    #[test]
    fn angles_beyond_small_ones_are_told_of_tools_and_plates_in_any_step() {
        let case = |change: &str| {
            let text = format!(
                "mesh.file = \"a.msh\"\nbody.a = {{ young = 1.0, poisson = 0.3 }}\ncontact.c.between = [\"top\", \"rigid.die\"]\n{change}"
            );
            Case::parse(&text, Path::new("case.toml"), &[]).expect("a good case")
        };
        let turned = |angle: f64| {
            far_turns(&case(&format!(
                "rigid.die = {{ line = [[0, 1], [1, 1]], angle = {angle:?} }}\nload.l = {{ on = \"right\", rigid = true, force = [0, 1], angle = {angle:?} }}"
            )))
        };
        assert_eq!((turned(0.2), turned(-0.2)), (vec![], vec![]));
        let words = turned(-7.0);
        assert_eq!(words.len(), 2);
        assert!(words[0].starts_with("rigid.die.angle = -7: ") && words[1].starts_with("load.l.angle = -7: "), "{words:?}");
        let steps = case(
            "rigid.die = { line = [[0, 1], [1, 1]], angle = 0.1 }\nsteps.turn = { factors = [-4, 1], scales = [\"rigid.die\"] }",
        );
        assert!(far_turns(&steps)[0].starts_with("rigid.die.angle = -0.4: "));
    }
}
