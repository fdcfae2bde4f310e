//! Which contacts of many are told one by one, and how the others are summed up.

use super::Summary;
use super::contact::ContactSummary;
use crate::geometry::Rounded;
use std::cmp::Ordering;
use std::collections::HashMap;

/// Contacts that are told one by one, at most: with a line or two for each they fill half of a screen of 24 lines.
pub const MOST_TOLD: usize = 8;

/// Contacts that have figures of their own, at most: three or four for each are some hundred files. Of more those have them that
/// are told.
pub const MOST_WITH_FIGURES: usize = 24;

/// Of more so many are told: the worst, by trust, then by the force that they carry.
pub const WORST: usize = 3;

/// Share of the forces that strain bodies from which the largest force of a contact is one. Times the share that counts (1e-4) it is 1e-9, a
/// tenth of the residual to which solves go: no force is lost that they tell. Three rings, of which one is loaded by 100 and touches
/// nothing, had 1e-13 between the others.
const LEFT_OF_FORCES: f64 = 1e-5;

/// Things of which the same is said, in the order of the first of each.
pub fn alike<T>(all: impl IntoIterator<Item = (String, T)>) -> Vec<(String, Vec<T>)> {
    let (mut groups, mut places) = (Vec::<(String, Vec<T>)>::new(), HashMap::new());
    for (words, one) in all {
        let place = *places.entry(words.clone()).or_insert(groups.len());
        if place == groups.len() {
            groups.push((words, Vec::new()));
        }
        groups[place].1.push(one);
    }
    groups
}

/// A line for each of some things, given by words and names, or one for many of which the same is said; and of how many each line
/// tells. `kind` is the word for one and for several of them.
pub fn lines_alike(kind: [&str; 2], all: impl IntoIterator<Item = (String, String)>) -> Vec<(usize, String)> {
    let lines = |(words, names): (String, Vec<String>)| match names.len() {
        count if count > MOST_TOLD => vec![(count, format!("{count} {} ({}): {words}", kind[1], listed(&names)))],
        _ => names.iter().map(|name| (1, format!("{} {name}: {words}", kind[0]))).collect(),
    };
    alike(all).into_iter().flat_map(lines).collect()
}

/// Names in a sentence: all of a few, of many the first ones and how many others there are.
pub fn listed<S: AsRef<str>>(names: &[S]) -> String {
    let few = if names.len() > MOST_TOLD { WORST } else { names.len() };
    let named = names[..few].iter().map(AsRef::as_ref).collect::<Vec<_>>().join(", ");
    if few < names.len() { format!("{named} and {} others", names.len() - few) } else { named }
}

/// The clauses of a reason, which semicolons outside of brackets part.
pub fn clauses(reason: &str) -> Vec<&str> {
    let mut depth = 0_i32;
    let parts = reason.split(|letter| {
        match letter {
            '(' => depth += 1,
            // A bracket that nothing has opened closes nothing.
            ')' => depth = (depth - 1).max(0),
            _ => {}
        }
        letter == ';' && depth == 0
    });
    parts.map(str::trim).filter(|part| !part.is_empty()).collect()
}

/// With a capital letter at its beginning.
pub fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}

impl Summary {
    /// Names of those contacts of which this is true.
    pub fn named(&self, is: impl Fn(&ContactSummary) -> bool) -> Vec<&str> {
        self.contact.iter().filter(|(_, contact)| is(contact)).map(|(name, _)| name.as_str()).collect()
    }

    /// The largest force of a contact, or what is as small as rounding beside the forces that strain bodies, if that is larger.
    pub fn largest_force(&self) -> f64 {
        // What is kept from growing moves nowhere.
        let moved = self.displacement_max.map(|moved| moved.max(self.growth));
        let strains = self.energy.total.zip(moved).map_or(0.0, |(energy, most)| 2.0 * energy.abs() / most);
        let least = if strains.is_finite() { LEFT_OF_FORCES * strains } else { 0.0 };
        self.contact.values().filter_map(|contact| contact.force).fold(least, |most: f64, force| most.max(force.abs()))
    }

    /// Names of all contacts: those that are not to be trusted before those of which nothing tells, these before the others, and
    /// of each kind those with the largest forces first.
    pub fn worst_first(&self) -> Vec<&str> {
        let trust = |contact: &ContactSummary| contact.judged.trust.map_or(1, |trust| if trust { 2 } else { 0 });
        self.sorted(|a, b| trust(a).cmp(&trust(b)).then_with(|| by_force(a, b)))
    }

    /// Names of the contacts that are told one by one, in alphabetical order: all of a few; of many the worst, and those with the
    /// largest forces.
    pub fn told(&self) -> Vec<&str> {
        if self.contact.len() <= MOST_TOLD {
            return self.named(|_| true);
        }
        let mut told: Vec<&str> = self.worst_first().into_iter().take(WORST).collect();
        let largest = self.sorted(by_force);
        let others: Vec<&str> = largest.into_iter().filter(|name| !told.contains(name)).take(MOST_TOLD - WORST).collect();
        told.extend(others);
        told.sort_unstable();
        told
    }

    /// Names of the contacts that have figures of their own.
    pub fn with_figures(&self) -> Vec<&str> {
        if self.contact.len() <= MOST_WITH_FIGURES { self.named(|_| true) } else { self.told() }
    }

    /// The contacts that are told, with what is known of them.
    pub fn contacts_told(&self) -> impl Iterator<Item = (&str, &ContactSummary)> {
        self.told().into_iter().filter_map(|name| Some((name, self.contact.get(name)?)))
    }

    /// What the contacts are, and the worst of them, of more than [`MOST_TOLD`].
    pub fn contacts_in_words(&self) -> Option<String> {
        let (count, largest) = (self.contact.len(), self.largest_force());
        if count <= MOST_TOLD {
            return None;
        }
        let says = |contact: &ContactSummary, word| contact.judged.verdict.as_ref().is_some_and(|words| words.starts_with(word));
        let kind = |contact: &ContactSummary| match contact.judged.trust {
            _ if says(contact, "touches") => "touch or are open",
            Some(true) if says(contact, "nothing presses") => "touch or are open",
            Some(true) => "are trusted",
            Some(false) => "are not trusted",
            None => "nothing tells of",
        };
        let kinds = ["are trusted", "touch or are open", "are not trusted", "nothing tells of"];
        let kinds = kinds.map(|words| (self.named(|contact| kind(contact) == words).len(), words));
        let kinds: Vec<String> = kinds.iter().filter(|(own, _)| *own > 0).map(|(own, words)| format!("{own} {words}")).collect();
        let one = |name: &&str| {
            let contact = self.contact.get(*name)?;
            let (force, verdict) =
                (contact.force.unwrap_or(f64::NAN), contact.judged.verdict.as_deref().unwrap_or("nothing tells"));
            let unit = self.units.resultant().after();
            Some(format!("{name} (force {force:.4e}{unit}, {:.2} of the largest; {verdict})", force.abs() / largest))
        };
        let worst: Vec<String> = self.worst_first().iter().take(WORST).filter_map(one).collect();
        let is_good = self.contact.values().all(|contact| contact.judged.trust == Some(true));
        let which = if is_good { "largest" } else { "worst" };
        Some(format!("{count} contacts: {}; the {which} {WORST}: {}", kinds.join(", "), worst.join(", ")))
    }

    /// What the run says of its contacts at the end: a line for each of a few, one of many.
    pub fn contact_lines(&self) -> Vec<String> {
        if let Some(words) = self.contacts_in_words() {
            return vec![words];
        }
        let (force_unit, stress_unit) = (self.units.resultant().after(), self.units.stress().after());
        let line = |(name, contact): (&String, &ContactSummary)| {
            let own = self.estimate.contact.get(name);
            let figure = |what: &str, value: Option<f64>, unit: &str, error: Option<f64>| {
                let error = error.map_or(String::new(), |error| format!(" (estimated error {error:.1e})"));
                value.map(|value| format!("{what} {}{unit}{error}", Rounded(value)))
            };
            let force = figure("force", contact.force, &force_unit, own.and_then(|own| own.force));
            let peak = figure("largest λ", contact.pressure_max, &stress_unit, own.and_then(|own| own.peak));
            let figures: Vec<String> = force.into_iter().chain(peak).collect();
            Some(format!("contact {name}: {}; {}", figures.join(", "), contact.judged.verdict.as_ref()?))
        };
        self.contact.iter().filter_map(line).collect()
    }

    fn sorted(&self, order: impl Fn(&ContactSummary, &ContactSummary) -> Ordering) -> Vec<&str> {
        let mut all: Vec<(&String, &ContactSummary)> = self.contact.iter().collect();
        all.sort_by(|a, b| order(a.1, b.1));
        all.into_iter().map(|(name, _)| name.as_str()).collect()
    }
}

/// The larger force first.
fn by_force(a: &ContactSummary, b: &ContactSummary) -> Ordering {
    let force = |contact: &ContactSummary| contact.force.map_or(0.0, f64::abs);
    force(b).total_cmp(&force(a))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::summary::{ContactEstimate, ContactTrust};
    use crate::output::units::Units;
    use proptest::prelude::*;

    fn summary(contacts: &[(Option<bool>, f64)]) -> Summary {
        let contact = |(at, &(trust, force)): (usize, &(Option<bool>, f64))| {
            let verdict = Some(if trust == Some(true) { "trusted" } else { "not trusted: narrow" }.to_owned());
            let judged = ContactTrust { trust, verdict, ..ContactTrust::default() };
            (format!("c{at:03}"), ContactSummary { force: Some(force), judged, ..ContactSummary::default() })
        };
        Summary { contact: contacts.iter().enumerate().map(contact).collect(), ..Summary::default() }
    }

    /// Between rings that touch, while another one is loaded, is nothing but rounding.
    #[test]
    fn a_force_is_none_that_is_rounding_beside_those_that_strain() {
        let mut noise = summary(&[(None, 0.0), (None, -2.5e-13)]);
        assert_eq!(noise.largest_force(), 2.5e-13, "nothing is strained");
        (noise.energy.total, noise.displacement_max) = (Some(1.0), Some(0.02));
        assert!((noise.largest_force() - 1e-3).abs() < 1e-15, "{}", noise.largest_force());
        let mut pressed = summary(&[(None, 3.0)]);
        (pressed.energy.total, pressed.displacement_max) = (Some(1.0), Some(0.02));
        assert_eq!(pressed.largest_force(), 3.0);
        pressed.displacement_max = Some(1e-15);
        assert!(pressed.largest_force() > 3.0);
        pressed.growth = 0.02;
        assert_eq!(pressed.largest_force(), 3.0, "what is kept from growing is strained, and moves nowhere");
    }

    proptest! {
        #[test]
        fn of_many_contacts_the_worst_and_the_largest_are_told(
            contacts in proptest::collection::vec((proptest::option::of(proptest::bool::ANY), -1.0..1.0), 0..60)
        ) {
            let summary = summary(&contacts);
            let (told, worst) = (summary.told(), summary.worst_first());
            prop_assert_eq!(worst.len(), contacts.len());
            prop_assert_eq!(told.len(), contacts.len().min(MOST_TOLD));
            prop_assert!(told.is_sorted() && worst.iter().take(WORST).all(|name| told.contains(name)));
            let force = |name: &&str| summary.contact[*name].force.unwrap_or(0.0).abs();
            let left = worst.iter().filter(|name| !told.contains(name)).map(force).fold(0.0, f64::max);
            prop_assert!(told.iter().filter(|name| force(name) >= left).count() >= told.len().saturating_sub(WORST));
            let key = |name: &&str| (summary.contact[*name].judged.trust.map_or(1, |trust| 2 * usize::from(trust)), -force(name));
            prop_assert!(worst.iter().map(key).is_sorted_by(|a, b| a <= b));
            let words = summary.contacts_in_words();
            prop_assert_eq!(words.is_some(), contacts.len() > MOST_TOLD);
            let bad = contacts.iter().filter(|(trust, _)| *trust == Some(false)).count();
            let counts = words.is_none_or(|words| bad == 0 || words.contains(&format!("{bad} are not trusted")));
            prop_assert!(counts);
        }
    }

    #[test]
    fn few_contacts_have_a_line_each_with_figures_and_verdict() {
        let mut few =
            Summary { units: Units::new(Some("mm"), Some("N"), false), ..summary(&[(Some(true), 7.5), (Some(false), 2.0)]) };
        few.contact.get_mut("c000").expect("it is there").pressure_max = Some(135.0);
        few.estimate.contact.insert("c000".into(), ContactEstimate { force: Some(1e-3), ..ContactEstimate::default() });
        let first = "contact c000: force 7.5 N/mm (estimated error 1.0e-3), largest λ 135 MPa; trusted";
        assert_eq!(few.contact_lines(), [first, "contact c001: force 2 N/mm; not trusted: narrow"]);
        assert_eq!(summary(&[(None, 1.0); 9]).contact_lines().len(), 1);
    }

    #[test]
    fn many_of_which_the_same_is_said_have_one_line() {
        let all = (0..12).map(|k| (if k == 3 { "ux = 0" } else { "mean angle" }.to_owned(), format!("s{k}")));
        let lines = lines_alike(["support", "supports"], all.clone());
        assert_eq!(lines, [(11, "11 supports (s0, s1, s2 and 8 others): mean angle".into()), (1, "support s3: ux = 0".into())]);
        let few = lines_alike(["support", "supports"], all.take(3));
        assert_eq!(few.iter().map(|(count, _)| count).sum::<usize>(), 3);
        assert_eq!(few[2].1, "support s2: mean angle");
    }

    #[test]
    fn a_reason_is_parted_outside_of_brackets() {
        let reason = "the set stands; contact a (inf-sup 0.05; oscillation .2); take fewer";
        assert_eq!(clauses(reason), ["the set stands", "contact a (inf-sup 0.05; oscillation .2)", "take fewer"]);
        assert!(clauses("").is_empty() && clauses("one") == ["one"]);
        assert_eq!((capital("äs"), capital("")), ("Äs".into(), String::new()));
    }

    #[test]
    fn names_of_many_are_counted() {
        let names: Vec<String> = (0..30).map(|k| format!("c{k}")).collect();
        assert_eq!((listed(&names[..2]), listed(&names)), ("c0, c1".into(), "c0, c1, c2 and 27 others".into()));
    }
}
