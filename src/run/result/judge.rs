//! The status of a run, and its reason.

use crate::output::summary::{ContactSummary, Status, Summary, listed};
use crate::procedure::Solved;
use crate::run::Run;
use crate::run::verdict::no_result::no_result;
use crate::run::verdict::trust;
use crate::run::verdict::unresolved::unresolved;
use std::collections::BTreeSet;

impl Run<'_> {
    /// Expected values and trust: the status, and the reason so far. `missed` are values that the case expects.
    pub(super) fn judge(&self, summary: &mut Summary, solved: &Solved, missed: &[String]) -> (Status, String) {
        let (mut status, mut reason) = ended(solved);
        if status == Status::Converged {
            missed.iter().for_each(|missed| self.report.say(&format!("missed: {missed}")));
            let missed = (self.case.exact.must_hold && !missed.is_empty())
                .then(|| format!("expected values are missed ({})", missed.join("; ")));
            let stopped = missed.or_else(|| no_result(summary, self.case)).map(|words| (Status::NotConverged, words));
            let coarse = || Some((Status::Unresolved, unresolved(summary, self.case, solved.ending.still_moved())?));
            (status, reason) = stopped.or_else(coarse).unwrap_or((status, reason));
        }
        let judgement = trust::judge(summary, self.case, solved.ending.is_converged());
        if status == Status::Unresolved {
            trust::distrust(summary);
        }
        if let Some(words) = judgement.unreliable {
            let words = format!("pressure unreliable: {words}");
            self.report.warn(&words);
            reason = if status == Status::Converged { words } else { format!("{reason}; {words}") };
        }
        for words in judgement.unknown {
            self.report.warn(&words);
            reason = format!("{reason}; {words}");
        }
        (status, reason)
    }
}

/// How the procedure ended: the status, and its words.
pub fn ended(solved: &Solved) -> (Status, String) {
    let status = if solved.ending.is_converged() { Status::Converged } else { Status::NotConverged };
    (status, solved.ending.to_string())
}

/// What else a reason says: the estimated error, largest values that mean nothing, contacts without pressure.
pub fn remarks(summary: &Summary) -> String {
    let mut remarks = String::new();
    let names = |is: &dyn Fn(&ContactSummary) -> bool| listed(&summary.named(is));
    let is_told = summary.accuracy.iter().flatten().any(|step| step.energy.is_some());
    if let (Status::Converged, Some(error), false) = (summary.status, summary.estimate.energy, is_told) {
        remarks += &format!("; estimated error {error:.1e} in the energy norm");
    }
    let singular = names(&ContactSummary::is_singular);
    let places = summary.contact.values().filter_map(ContactSummary::singular_words).collect::<BTreeSet<_>>();
    if summary.status == Status::Converged && !singular.is_empty() {
        remarks += &format!(
            "; λ of contact {singular} grows without bound {}, as far as the meshes tell: its largest value says nothing",
            listed(&places.into_iter().collect::<Vec<_>>())
        );
    }
    let idle = names(&|contact| contact.closed.as_ref().is_some_and(Vec::is_empty));
    if !idle.is_empty() {
        remarks += &format!("; nothing presses on contact {idle}");
    }
    let verdict = |contact: &ContactSummary| contact.judged.verdict.clone().filter(|words| words.starts_with("touches"));
    let words = summary.contact.values().find_map(verdict).unwrap_or_default();
    match summary.named(|contact| verdict(contact).is_some())[..] {
        [] => {}
        [name] => remarks += &format!("; contact {name} {}", words.replace("; ", " and ")),
        ref names => {
            let words = words.replace("touches; carries", "touch and carry");
            remarks += &format!("; {} contacts {words} ({})", names.len(), listed(names));
        }
    }
    remarks
}
