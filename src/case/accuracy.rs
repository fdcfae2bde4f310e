//! `[accuracy]`: relative errors that the mesh is adapted to.

use super::Probe;
use super::error::suggest;
use super::section::Section;
use super::values;
use crate::accuracy::{Accuracy, Goal, ProbePoint, Quantity};
use crate::body::PointLoad;
use crate::contact::{Law, Pair};
use crate::geometry::Point;

/// A number at the root of a case under this name stands for a table with that number under this key.
pub const SHORT: [(&str, &str); 1] = [("accuracy", "energy")];

/// What an empty `[accuracy]` may hold.
const SOME_GOAL: &str = "asks for nothing; give energy = 1e-4, say, or force, pressure, peak, ends, displacement, stress";

/// Goals that a contact may have.
const OF_CONTACTS: [&str; 4] = ["force", "pressure", "peak", "ends"];

/// Tolerances of the goals that a contact may have.
#[derive(Clone, Copy, Default)]
struct OfContact {
    force: Option<f64>,
    pressure: Option<f64>,
    peak: Option<f64>,
    ends: Option<f64>,
}

/// `[accuracy.contact.NAME]`
struct Single {
    name: String,
    own: OfContact,
    is_empty: bool,
}

/// `accuracy = 1e-4`, or `[accuracy]`; nothing if the case has neither, or if the log knows what is wrong.
pub fn read_accuracy(root: &Section, contacts: &[Pair], probes: &[Probe]) -> Option<Accuracy> {
    if !root.has("accuracy") {
        return None;
    }
    if !root.has_table("accuracy") {
        let goals = vec![Goal { quantity: Quantity::Energy, tolerance: root.optional("accuracy", values::number)? }];
        return Some(Accuracy { goals, most_unknowns: None, most_seconds: None });
    }
    let section = root.table("accuracy");
    let energy = section.optional("energy", values::number);
    let all = read_contact_goals(&section);
    let single = section.named("contact", |section| {
        Some(Single { name: section.name().into(), own: read_contact_goals(section), is_empty: is_empty(section) })
    });
    let [displacement, stress] = ["displacement", "stress"].map(|key| section.optional(key, values::number));
    let most_unknowns = section.optional("max_unknowns", values::whole);
    let most_seconds = section.optional("max_seconds", values::number);
    check_contacts(&section, root, &single);
    check_ends(&section, contacts, &single);
    if probes.is_empty() && root.names_below("probe").next().is_none() {
        let words = "there is no point to look at; write [probe.NAME] with point and body";
        given(&section, ["displacement", "stress"]).for_each(|key| section.problem(&[key], words.into()));
    }
    if is_empty(&section) && given(&section, ["energy", "displacement", "stress"]).next().is_none() && single.is_empty() {
        section.problem(&[], SOME_GOAL.into());
    }
    let mut goals: Vec<Goal> = energy.map(|tolerance| Goal { quantity: Quantity::Energy, tolerance }).into_iter().collect();
    for pair in contacts {
        let own = single.iter().find(|single| single.name == pair.name).map_or(OfContact::default(), |single| single.own);
        goals.extend(goals_of(pair, all, own));
    }
    goals.extend(probes.iter().flat_map(|probe| goals_at(probe, displacement, stress)));
    Some(Accuracy { goals, most_unknowns, most_seconds })
}

/// The energy of a force at a point is infinite in the plane: no mesh reaches it.
pub fn check_energy(accuracy: Option<&Accuracy>, loads: &[PointLoad], root: &Section) {
    let energy = accuracy.is_some_and(|accuracy| accuracy.goals.iter().any(|goal| goal.quantity == Quantity::Energy));
    if let Some(load) = loads.first().filter(|_| energy) {
        let key: &[&str] = if root.has_table("accuracy") { &["accuracy", "energy"] } else { &["accuracy"] };
        let words = format!(
            "load.{} acts at a point, where the energy is infinite: ask for force, pressure, displacement or stress, or spread the load over a boundary",
            load.name
        );
        root.problem(key, words);
    }
}

/// What is asked of all contacts, or of one.
fn read_contact_goals(section: &Section) -> OfContact {
    let [force, pressure, peak, ends] = OF_CONTACTS.map(|key| section.optional(key, values::number));
    OfContact { force, pressure, peak, ends }
}

/// Whether a table asks for nothing of contacts.
fn is_empty(section: &Section) -> bool {
    given(section, OF_CONTACTS).next().is_none()
}

/// Those keys that a table has.
fn given<const N: usize>(section: &Section, keys: [&'static str; N]) -> impl Iterator<Item = &'static str> {
    keys.into_iter().filter(|key| section.has(key))
}

/// What is asked of contacts has contacts that it can be asked of.
fn check_contacts(section: &Section, root: &Section, single: &[Single]) {
    for Single { name, is_empty, .. } in single {
        if !root.names_below("contact").any(|known| known == name) {
            let words = format!("no such contact; {}", suggest(name, root.names_below("contact")));
            section.problem(&["contact", name], words);
        } else if *is_empty {
            section.problem(&["contact", name], "asks for nothing; give force, pressure, peak or ends".into());
        }
    }
    if root.names_below("contact").next().is_none() {
        let words = "there is no contact in this case; leave it out, or ask for energy";
        given(section, OF_CONTACTS).for_each(|key| section.problem(&[key], words.into()));
    }
}

/// Only unilateral contact ends where the solution says.
fn check_ends(section: &Section, contacts: &[Pair], single: &[Single]) {
    let words = |which: &str| {
        format!(
            "{which} bilateral, presses and pulls all along, and has no ends to be found; leave it out, or give law = \"unilateral\""
        )
    };
    for Single { name, own, .. } in single {
        let is_bilateral = contacts.iter().any(|pair| pair.name == *name && pair.law == Law::Bilateral);
        if own.ends.is_some() && is_bilateral {
            section.problem(&["contact", name, "ends"], words(&format!("contact.{name} is")));
        }
    }
    if section.has("ends") && !contacts.is_empty() && contacts.iter().all(|pair| pair.law == Law::Bilateral) {
        section.problem(&["ends"], words("every contact is"));
    }
}

/// Goals of one contact: its own before those of all. The ends of bilateral contact are known.
fn goals_of(pair: &Pair, all: OfContact, own: OfContact) -> Vec<Goal> {
    let ends = own.ends.or(all.ends).filter(|_| pair.law == Law::Unilateral);
    let name = || pair.name.clone();
    let tolerances = [
        (Quantity::Force(name()), own.force.or(all.force)),
        (Quantity::Pressure(name()), own.pressure.or(all.pressure)),
        (Quantity::Peak(name()), own.peak.or(all.peak)),
        (Quantity::Ends(name()), ends),
    ];
    tolerances.into_iter().filter_map(|(quantity, tolerance)| Some(Goal { quantity, tolerance: tolerance? })).collect()
}

/// Goals at one point.
fn goals_at(probe: &Probe, displacement: Option<f64>, stress: Option<f64>) -> Vec<Goal> {
    let [x, y] = probe.point;
    let place = ProbePoint { name: probe.name.clone(), body: probe.body.clone(), point: Point::new(x, y) };
    let displacement = displacement.map(|tolerance| Goal { quantity: Quantity::Displacement(place.clone()), tolerance });
    let stress = stress.map(|tolerance| Goal { quantity: Quantity::Stress(place), tolerance });
    displacement.into_iter().chain(stress).collect()
}

#[cfg(test)]
mod tests;
