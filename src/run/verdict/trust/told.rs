//! What is said of contacts: of a few one by one, of many by causes.

use super::remedies::Mended;
use crate::case::Case;
use crate::output::Summary;
use crate::output::summary::{self, ContactTrust};
use crate::run::verdict::limits::{Doubt, Remedy};
use std::collections::{BTreeMap, BTreeSet};

/// What a contact is called whose pressure is to be trusted.
pub const TRUSTED: &str = "trusted";

/// What is said against a pressure, or that nothing tells of it.
pub struct Objection {
    /// Without figures: contacts are counted by it.
    pub cause: &'static str,
    /// The same with figures.
    pub words: String,
    /// What to do about it, if there is anything.
    pub remedy: Option<String>,
}

/// What is said of one contact.
#[derive(Default)]
pub struct Verdict {
    /// What speaks against its pressure.
    pub doubts: Vec<Objection>,
    /// What nothing tells.
    pub unknown: Option<Objection>,
    /// Whether its pressure is to be trusted.
    pub trust: Option<bool>,
    /// Whether its force is.
    pub trust_force: Option<bool>,
    /// What it is called where it carries nothing that counts.
    pub idle: Option<String>,
}

impl Verdict {
    /// Doubts of a contact, and nothing else.
    pub fn of(doubts: Vec<Doubt>, contact: Mended) -> Self {
        // Segments that are too many for the bodies may overlap between few that press: more of them help nothing.
        let is_unstable = doubts.iter().any(|doubt| matches!(doubt.limit.remedy, Remedy::Stability));
        let helping = |remedy| if is_unstable && remedy == Remedy::MoreSegments { Remedy::Stability } else { remedy };
        let objection = |Doubt { limit, figure }| {
            let remedy = contact.by(helping(limit.remedy));
            Objection { cause: limit.cause, words: figure, remedy: Some(remedy) }
        };
        Self { doubts: doubts.into_iter().map(objection).collect(), ..Self::default() }
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
        self.doubts.iter().map(|doubt| doubt.cause).collect()
    }
}

/// All contacts in the order in which they are told: that of the case; of many the worst first.
pub fn in_order<'a>(summary: &'a Summary, case: &'a Case, verdicts: &BTreeMap<String, Verdict>) -> Vec<&'a str> {
    if verdicts.len() > summary::MOST_TOLD {
        return summary.worst_first();
    }
    case.contacts.iter().map(|pair| pair.name.as_str()).filter(|name| verdicts.contains_key(*name)).collect()
}

/// What is said of contacts, a clause for each thing that helps; of many contacts for each cause, with the worst of them.
pub fn clauses(names: &[&str], verdicts: &BTreeMap<String, Verdict>, of: fn(&Verdict) -> &[Objection]) -> Vec<String> {
    let is_many = names.len() > summary::MOST_TOLD;
    let all = names.iter().flat_map(|name| of(&verdicts[*name]).iter().map(move |objection| (*name, objection)));
    let key = |objection: &Objection| match &objection.remedy {
        _ if is_many => objection.cause.to_owned(),
        remedy => remedy.clone().unwrap_or_default(),
    };
    let mut groups = summary::alike(all.map(|(name, objection)| (key(objection), (name, objection))));
    let contacts = |group: &[(&str, &Objection)]| group.iter().map(|(name, _)| *name).collect::<BTreeSet<_>>().len();
    groups.sort_by_key(|(_, group)| std::cmp::Reverse(if is_many { contacts(group) } else { 0 }));
    let clause = |(cause, group): (String, Vec<(&str, &Objection)>)| {
        let remedy = group[0].1.remedy.as_ref().map_or(String::new(), |remedy| format!(": {remedy}"));
        let told = summary::alike(group.into_iter().map(|(name, objection)| (name.to_owned(), objection.words.as_str())));
        let said = |(name, words): &(String, Vec<&str>)| {
            let force = if verdicts[name].trust_force == Some(true) { ", whose force is to be trusted" } else { "" };
            (format!("({}){force}", words.join("; ")), name.clone())
        };
        let few = if is_many { 1 } else { told.len() };
        let alike = summary::alike(told.iter().take(few).map(said)).into_iter();
        let contacts = |(words, names): (String, Vec<String>)| {
            format!("contact{} {} {words}", if names.len() > 1 { "s" } else { "" }, names.join(", "))
        };
        let few = alike.map(contacts).collect::<Vec<_>>().join(", ");
        match told.len() {
            count if is_many && count > 1 => format!("{count} of {} contacts: {cause}, the worst {few}{remedy}", names.len()),
            _ => format!("{few}{remedy}"),
        }
    };
    groups.into_iter().map(clause).collect()
}
