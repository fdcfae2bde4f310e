//! What is said of contacts: of a few one by one, of many by causes.

use crate::case::Case;
use crate::contact::Pair;
use crate::output::Summary;
use crate::output::summary::{self, ContactTrust};
use crate::run::verdict::limits::{Doubt, Remedy};
use std::collections::{BTreeMap, BTreeSet};

/// What a contact is called whose pressure is to be trusted.
pub const TRUSTED: &str = "trusted";

/// What nothing tells of a contact.
pub struct Unknown {
    /// Without figures: contacts are counted by it.
    pub cause: &'static str,
    /// The same with figures.
    pub words: String,
    /// What to do about it, if there is anything.
    pub remedy: Option<&'static str>,
}

/// What is said of one contact.
#[derive(Default)]
pub struct Verdict {
    /// What speaks against its pressure.
    pub doubts: Vec<Doubt>,
    /// What helps against each doubt.
    pub remedies: Vec<&'static str>,
    /// What nothing tells.
    pub unknown: Option<Unknown>,
    /// Whether its pressure is to be trusted.
    pub trust: Option<bool>,
    /// Whether its force is.
    pub trust_force: Option<bool>,
    /// What it is called where it carries nothing that counts.
    pub idle: Option<String>,
}

impl Verdict {
    /// Doubts of a contact, and nothing else.
    pub fn of(doubts: Vec<Doubt>, pair: &Pair, case: &Case) -> Self {
        let remedy = |doubt: &Doubt| doubt.limit.remedy;
        // Segments that are too many for the bodies may overlap between few that press: more of them help nothing.
        let is_unstable = doubts.iter().any(|doubt| matches!(remedy(doubt), Remedy::Stability));
        let helping = doubts.iter().map(remedy).filter(|remedy| !(is_unstable && matches!(remedy, Remedy::MoreSegments)));
        let remedies = helping.map(|remedy| remedy.words(pair, case)).collect();
        Self { doubts, remedies, ..Self::default() }
    }

    /// As the summary has it, in a few words.
    pub fn trust(&self) -> ContactTrust {
        let words = match (self.trust, &self.idle, &self.unknown) {
            (Some(false), ..) if self.doubts.is_empty() => "not trusted: the run has not converged".into(),
            (Some(false), ..) => format!("not trusted: {}", Vec::from_iter(self.causes()).join("; ")),
            (_, Some(idle), _) => idle.clone(),
            (Some(true), ..) => TRUSTED.into(),
            (None, _, unknown) => unknown.as_ref().map_or("nothing tells", |unknown| unknown.cause).into(),
        };
        ContactTrust { trust: self.trust, trust_force: self.trust_force, verdict: Some(words) }
    }

    /// Each cause once, in alphabetical order.
    fn causes(&self) -> BTreeSet<&'static str> {
        self.doubts.iter().map(|doubt| doubt.limit.cause).collect()
    }
}

/// All contacts in the order in which they are told: that of the case; of many the worst first.
pub fn in_order<'a>(summary: &'a Summary, case: &'a Case, verdicts: &BTreeMap<String, Verdict>) -> Vec<&'a str> {
    if verdicts.len() > summary::MOST_TOLD {
        return summary.worst_first();
    }
    case.contacts.iter().map(|pair| pair.name.as_str()).filter(|name| verdicts.contains_key(*name)).collect()
}

/// What speaks against pressures: of many contacts how many have each cause, before the worst of them.
pub fn unreliable(names: &[&str], verdicts: &BTreeMap<String, Verdict>) -> Option<String> {
    let doubtful = names.iter().filter_map(|name| Some((*name, verdicts.get(*name)?)));
    let doubtful: Vec<(&str, &Verdict)> = doubtful.filter(|(_, verdict)| !verdict.doubts.is_empty()).collect();
    let one = |(name, verdict): &(&str, &Verdict)| {
        let figures: Vec<&str> = verdict.doubts.iter().map(|doubt| doubt.figure.as_str()).collect();
        let force = if verdict.trust_force == Some(true) { ", whose force is to be trusted" } else { "" };
        format!("contact {name} ({}){force}", figures.join("; "))
    };
    let is_many = names.len() > summary::MOST_TOLD;
    let few = if is_many { summary::WORST } else { doubtful.len() };
    let mut told = doubtful.iter().take(few).map(one).collect::<Vec<_>>().join(", ");
    if is_many {
        let causes = counted(doubtful.iter().flat_map(|(_, verdict)| verdict.causes()));
        let causes: Vec<String> = causes.iter().map(|(cause, count)| format!("{count} because {cause}")).collect();
        told = format!("{} of {} contacts ({}); the worst: {told}", doubtful.len(), names.len(), causes.join("; "));
    }
    let mut remedies: Vec<&str> = Vec::new();
    for remedy in doubtful.iter().flat_map(|(_, verdict)| &verdict.remedies) {
        if !remedies.contains(remedy) {
            remedies.push(remedy);
        }
    }
    (!doubtful.is_empty()).then(|| format!("{told}; {}", remedies.join("; ")))
}

/// What nothing tells: a sentence for each contact, or for each cause of many.
pub fn unknown(names: &[&str], verdicts: &BTreeMap<String, Verdict>) -> Vec<String> {
    let with = |words: String, remedy: Option<&str>| remedy.map_or(words.clone(), |remedy| format!("{words}; {remedy}"));
    if names.len() <= summary::MOST_TOLD {
        let unknown = names.iter().filter_map(|name| Some((name, verdicts[*name].unknown.as_ref()?)));
        return unknown.map(|(name, unknown)| with(format!("contact {name}: {}", unknown.words), unknown.remedy)).collect();
    }
    let all = || verdicts.iter().filter_map(|(name, verdict)| Some((name, verdict.unknown.as_ref()?)));
    let sentence = |(cause, count): (&str, usize)| {
        let own: Vec<(&String, &Unknown)> = all().filter(|(_, unknown)| unknown.cause == cause).collect();
        let few = summary::listed(&own.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>());
        with(format!("{count} of {} contacts: {cause} ({few})", verdicts.len()), own.first().and_then(|(_, own)| own.remedy))
    };
    counted(all().map(|(_, unknown)| unknown.cause)).into_iter().map(sentence).collect()
}

/// How often each cause comes, the most frequent first.
fn counted<'a>(causes: impl Iterator<Item = &'a str>) -> Vec<(&'a str, usize)> {
    let mut counts = BTreeMap::new();
    causes.for_each(|cause| *counts.entry(cause).or_insert(0) += 1);
    let mut counts: Vec<(&str, usize)> = counts.into_iter().collect();
    counts.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
    counts
}
