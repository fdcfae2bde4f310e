//! `[accuracy]`: relative errors that the mesh is adapted to.

use crate::accuracy::{Accuracy, Goal, ProbePoint, Quantity};
use crate::body::PointLoad;
use crate::case::keys::*;
use crate::contact::{Law, Pair};

declare! {
    group ROOT;
    /// The relative error that the mesh is adapted to: `accuracy = 1e-4` before all tables is short for `energy = 1e-4` in
    /// `[accuracy]`, which follows below.
    const ACCURACY_OR_ENERGY: f64 = key("accuracy", either(NUMBER_OR_TABLE, WANTED_OR_TABLE)).or_else("not adapted")
        .refused("must be a number from 1e-8 to 0.5, the relative error that is asked for; or a table [accuracy] of such numbers");
}

declare! {
    /// Relative errors that the mesh is adapted to, see [accuracy](#accuracy); at least one. `force`, `pressure`, `peak` and `ends`
    /// are of every contact, `displacement` and `stress` at every `[probe]`, by their own size.
    static ACCURACY = table("accuracy").rules(&[TableRule::OneOf(&[
        &["energy"], &["force"], &["pressure"], &["peak"], &["ends"], &["displacement"], &["stress"], &["contact"],
    ])]);
    /// Of the displacement in the energy norm.
    const ENERGY: f64 = goal("energy");
    ..OF_CONTACTS;
    /// Of the displacement at every `[probe]`.
    const DISPLACEMENT: f64 = goal("displacement");
    /// Of the stress at every `[probe]`.
    const STRESS: f64 = goal("stress");
    /// Displacement unknowns of the finest mesh, at most; a mesh file that has more alone is refused.
    const MAX_UNKNOWNS: usize = key("max_unknowns", whole(100, i64::MAX))
        .or_else("half of the memory that is left to all ranks: what each machine has, what cgroups (batch jobs, containers) and \
            `ulimit -v` leave of it, shared by the ranks there")
        .refused("must be a whole number of at least 100, such as 100000");
    /// After so many seconds no further mesh is begun.
    const MAX_SECONDS: f64 = key("max_seconds", ABOVE_ZERO).or_else("none").unit("seconds");
    const SINGLE: toml::Table = key("contact", named(&ONE_CONTACT));
}

declare! {
    /// Of one contact, instead of those of all or beside them.
    static ONE_CONTACT = table("accuracy-of-contact")
        .rules(&[TableRule::OneOf(&[&["force"], &["pressure"], &["peak"], &["ends"]])]);
    ..OF_CONTACTS;
}

declare! {
    group OF_CONTACTS;
    /// Of ∫λ ds.
    const FORCE: f64 = goal("force");
    /// Of λ in the mean square over the middle 60 % of each zone that presses and counts (`lambda` in `summary.json`).
    const PRESSURE: f64 = goal("pressure");
    /// Of the largest λ (`pressure_max`), which is never reached where λ grows without bound.
    const PEAK: f64 = goal("peak");
    /// Of the ends of contact, by its width; of unilateral contacts only.
    const ENDS: f64 = goal("ends");
}

/// A number at the root of a case under this name stands for a table with that number under this key.
pub const SHORT: [(&str, &str); 1] = [("accuracy", "energy")];

/// Words for goals of contacts where there are none.
pub const NO_CONTACT: &str = "there is no contact in this case";

/// What an empty `[accuracy]` may hold.
const SOME_GOAL: &str = "asks for nothing; give energy = 1e-4, say, or force, pressure, peak, ends, displacement, stress";

/// A relative error: below 1e-8 rounding begins; above 0.5 an error says nothing.
const RELATIVE: FormOf<f64> = number(within(1e-8, 0.5).or_words(WANTED));
const WANTED: &str = "must be a number from 1e-8 to 0.5, the relative error that is asked for";
const NUMBER_OR_TABLE: &[ValueForm] = &[RELATIVE.value, ValueForm::Table(&ACCURACY)];
const WANTED_OR_TABLE: &str =
    "a number from 1e-8 to 0.5, the relative error that is asked for; or a table [accuracy] of such numbers";

/// Goals that a contact may have, in the order of the quantities.
const GOALS: [Key<f64>; 4] = [FORCE, PRESSURE, PEAK, ENDS];
const GOAL_KEYS: [&str; 4] = ["force", "pressure", "peak", "ends"];
const QUANTITIES: [fn(String) -> Quantity; 4] = [Quantity::Force, Quantity::Pressure, Quantity::Peak, Quantity::Ends];
const ENDS_AT: usize = 3;

/// A relative error that the mesh is adapted to.
const fn goal(name: &'static str) -> Key<f64> {
    key(name, RELATIVE).refused(WANTED)
}

/// Tolerances of [`GOALS`].
type ContactTolerances = [Option<f64>; 4];

/// `accuracy = 1e-4`, or `[accuracy]`; nothing if the case has neither, or if the log knows what is wrong.
pub fn read_accuracy(root: &Section, contacts: &[Pair], probes: &[ProbePoint]) -> Option<Accuracy> {
    if !root.has("accuracy") {
        return None;
    }
    if !root.has_table("accuracy") {
        let goals = vec![Goal { quantity: Quantity::Energy, tolerance: root.optional(ACCURACY_OR_ENERGY)? }];
        return Some(Accuracy { goals, most_unknowns: None, most_seconds: None });
    }
    let section = root.table("accuracy");
    let energy = section.optional(ENERGY);
    let all = GOALS.map(|key| section.optional(key));
    let single = section.named("contact", |section| read_single(section, contacts, root));
    let [displacement, stress] = [DISPLACEMENT, STRESS].map(|key| section.optional(key));
    let (most_unknowns, most_seconds) = (section.optional(MAX_UNKNOWNS), section.optional(MAX_SECONDS));
    if root.names_below("contact").next().is_none() {
        section.refuse(&GOAL_KEYS, &format!("{NO_CONTACT}; leave it out, or ask for energy"));
    }
    if section.has("ends") && !contacts.is_empty() && contacts.iter().all(|pair| pair.law == Law::Bilateral) {
        section.problem(&["ends"], no_ends("every contact is"));
    }
    if probes.is_empty() && root.names_below("probe").next().is_none() {
        section.refuse(&["displacement", "stress"], "there is no point to look at; write [probe.NAME] with point and body");
    }
    if !section.has_any(&GOAL_KEYS) && !section.has_any(&["energy", "displacement", "stress"]) && single.is_empty() {
        section.problem(&[], SOME_GOAL);
    }
    let mut goals: Vec<Goal> = energy.map(|tolerance| Goal { quantity: Quantity::Energy, tolerance }).into_iter().collect();
    for pair in contacts {
        let own = single.iter().find(|(name, _)| *name == pair.name).map_or_else(Default::default, |(_, own)| *own);
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

/// `[accuracy.contact.NAME]`: a contact of the case, and what is asked of it.
fn read_single(section: &Section, contacts: &[Pair], root: &Section) -> Option<(String, ContactTolerances)> {
    let name = section.name();
    let own = GOALS.map(|key| section.optional(key));
    section.check_name(&[], "contact", name, root.names_below("contact"));
    if !section.has_any(&GOAL_KEYS) && root.names_below("contact").any(|known| known == name) {
        section.problem(&[], "asks for nothing; give force, pressure, peak or ends");
    }
    if own[ENDS_AT].is_some() && contacts.iter().any(|pair| pair.name == name && pair.law == Law::Bilateral) {
        section.problem(&["ends"], no_ends(&format!("contact.{name} is")));
    }
    Some((name.into(), own))
}

/// Words for ends that are asked of bilateral contact: only unilateral contact ends where the solution says.
fn no_ends(which: &str) -> String {
    format!(
        "{which} bilateral, presses and pulls all along, and has no ends to be found; leave it out, or give law = \"unilateral\""
    )
}

/// Goals of one contact: its own before those of all. The ends of bilateral contact are known.
fn goals_of(pair: &Pair, all: ContactTolerances, own: ContactTolerances) -> impl Iterator<Item = Goal> {
    let asked = |k: usize| k != ENDS_AT || pair.law == Law::Unilateral;
    let goal = move |k: usize| Some(Goal { quantity: QUANTITIES[k](pair.name.clone()), tolerance: own[k].or(all[k])? });
    (0..own.len()).filter(move |k| asked(*k)).filter_map(goal)
}

/// Goals at one point.
fn goals_at(probe: &ProbePoint, displacement: Option<f64>, stress: Option<f64>) -> impl Iterator<Item = Goal> {
    let displacement = displacement.map(|tolerance| Goal { quantity: Quantity::Displacement(probe.clone()), tolerance });
    displacement.into_iter().chain(stress.map(|tolerance| Goal { quantity: Quantity::Stress(probe.clone()), tolerance }))
}

#[cfg(test)]
mod tests;
