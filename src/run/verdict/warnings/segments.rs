//! Words for segments shorter than the safe rule.

use crate::discretisation::Contact;
use crate::run::words::short;

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
