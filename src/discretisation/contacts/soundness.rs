//! What a look at a scene finds wrong before anything is solved: formulas without a value, triangles turned inside out.

use crate::body::{check_body_forces, check_folding, check_loads, varies};
use crate::contact::{GapChoice, Known, Pair, declared_gap};
use crate::discretisation::contacts::contact::{Contact, not_facing};
use crate::discretisation::contacts::coupling::coupled_here;
use crate::discretisation::error::SystemError;
use crate::discretisation::scene::Scene;
use crate::geometry::Point;
use crate::mesh::{Level, Numbering};

/// Triangles that are looked at, at most: what only a finer mesh shows is told where it is assembled.
const MOST_LOOKED_AT: usize = 20_000;

/// Looks at the formulas of loads, body forces and gaps where they will be integrated, and at the triangles along bent boundaries.
/// The same on every rank.
///
/// # Errors
/// [`SystemError::Case`] with key, formula and point, or with the triangle.
pub fn check_soundness(scene: &Scene, numbering: &Numbering, contacts: &[Contact]) -> Result<(), SystemError> {
    let (mesh, parts) = (&scene.mesh, scene.parts());
    let curved = (0..mesh.triangles.len()).filter(|&triangle| mesh.is_curved(triangle)).count();
    check_folding(mesh, looked_at(scene, curved))?;
    check_loads(mesh, numbering, &scene.loads)?;
    let forced =
        (0..mesh.triangles.len()).filter(|&triangle| parts[mesh.triangles[triangle].part as usize].formulas().any(varies));
    let level = looked_at(scene, forced.clone().count());
    check_body_forces(mesh, forced, level, &parts)?;
    for contact in contacts {
        if let GapChoice::Formula(formula) = &contact.pair.gap {
            declared_gap(&contact.boundary, &contact.multipliers, formula)
                .map_err(|words| format!("contact.{}.gap: {words}", contact.pair.name))?;
        }
    }
    Ok(())
}

/// All contacts of a scene on one rank that cannot be made as they are drawn: the names of each, and why. Of two that claim one place
/// it is the later one.
pub fn refused_contacts<'a>(scene: &'a Scene, numbering: &Numbering) -> Vec<(&'a Pair, String)> {
    let (mut placed, mut refused) = (Vec::new(), Vec::new());
    let place = |pair: &Pair| {
        let contact = Contact::new(scene, numbering, 0, pair, 0, &Known::default(), &|_| Point::zeros())?;
        coupled_here(std::slice::from_ref(&contact)).map(|_| contact)
    };
    for pair in &scene.pairs {
        match place(pair) {
            Ok(contact) => placed.push((pair, contact)),
            Err(error) => {
                let (words, key) = (error.to_string(), format!("contact.{}", pair.name));
                refused.push((pair, words.strip_prefix(&key).unwrap_or(&words).trim_start_matches([':', '.', ' ']).to_owned()));
            }
        }
    }
    let (pairs, placed): (Vec<&Pair>, Vec<Contact>) = placed.into_iter().unzip();
    refused.extend(not_facing(scene, numbering, &placed).into_iter().map(|(at, why)| (pairs[at], why)));
    refused
}

/// The finest level of the scene's elements that has no more triangles in so many macro triangles than are looked at.
fn looked_at(scene: &Scene, count: usize) -> Level {
    let level = |refine: usize| Level { intervals: scene.order.degree() << refine, order: scene.order };
    let is_little = |level: &Level| count.saturating_mul(level.triangles_per_edge().pow(2)) <= MOST_LOOKED_AT;
    (0..=scene.refine).rev().map(level).find(is_little).unwrap_or(Level { intervals: scene.order.degree(), order: scene.order })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::MultiplierSpace;
    use crate::discretisation::finest_numbering;
    use crate::discretisation::samples::{blocks, pair};
    use crate::geometry::Formula;

    /// One look names all that are refused, whatever their names and keys are; of two that claim one place the later one.
    #[test]
    fn all_contacts_that_cannot_be_made_are_named_at_once() {
        let named = |name: &str, between: [&str; 2]| Pair {
            name: name.into(),
            between: between.map(String::from),
            ..pair(MultiplierSpace::P0, 3)
        };
        let seam = ["lower.seam", "upper.seam"];
        let mut scene = blocks(named("good", seam), |_| Point::zeros(), Vec::new());
        let gap = GapChoice::Formula(Formula::parse("1/(x-x)", &["x", "y"]).expect("a formula"));
        scene.pairs.extend([named("back", ["bottom", "upper.seam"]), Pair { gap, ..named("a.b", seam) }, named("twice", seam)]);
        let numbering = finest_numbering(&scene).expect("a small mesh");
        let refused = refused_contacts(&scene, &numbering);
        for (name, why) in [("back", "do not face each other"), ("a.b", "gap: "), ("twice", "one place of a boundary")] {
            let own = refused.iter().find(|(pair, _)| pair.name == name).map(|(_, why)| why.as_str());
            assert!(own.is_some_and(|words| words.contains(why) && !words.contains("contact.a")), "{name}: {refused:?}");
        }
        assert_eq!(refused.len(), 3, "{refused:?}");
    }
}
