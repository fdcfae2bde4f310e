//! A solution made into a summary, with its files, its status and its reason.

use super::figures::Shown;
use crate::output::RunError;
use crate::output::summary::{ContactSummary, EstimateSummary, Status, Summary, listed};
use crate::procedure::{Solved, Work};
use crate::recovery::Evaluation;
use crate::run::summary::bodies::largest_stresses;
use crate::run::summary::contact::contact;
use crate::run::summary::whole::{described, with_fields};
use crate::run::telling::progress;
use crate::run::verdict::exact::compare;
use crate::run::verdict::no_result::{NO_NUMBERS, no_result};
use crate::run::verdict::trust;
use crate::run::verdict::unresolved::{pressed_by_rounding, pulled, unresolved};
use crate::run::verdict::warnings::after::{apart, crossed, large_strains, loaded_points, slivers};
use crate::run::verdict::warnings::before::IDLE;
use crate::run::{Run, accuracy};
use std::collections::{BTreeMap, BTreeSet};

impl Run<'_> {
    /// Evaluates and judges a solution, and writes its files; what is left to be known are times and memory. **Collective**
    pub(in crate::run) fn summarise(&self, solved: &Solved) -> Result<Summary, RunError> {
        let estimate = EstimateSummary { energy: solved.estimate.energy, ..EstimateSummary::default() };
        let before = Summary { estimate, ..Summary::new(&self.case.name, self.session.size()) };
        let summary = described(before, self.case, solved);
        let (summary, mut status, mut reason) = match ended(solved) {
            _ if solved.is_solved() => {
                let _stage = self.stages.output.enter();
                self.evaluate(summary, solved)?
            }
            (Status::Converged, _) => (summary, Status::NotConverged, NO_NUMBERS.into()),
            (status, reason) => (summary, status, reason),
        };
        let adaptation = accuracy::adaptation(self.case, solved, &self.true_errors.borrow());
        if let Some(adaptation) = &adaptation {
            (status, reason) = accuracy::judge(adaptation, status, &reason);
            let flat = slivers(&solved.problem.scene.mesh).filter(|_| !adaptation.is_reached());
            reason += &flat.map_or(String::new(), |words| format!("; {words}"));
        }
        if solved.is_idle() {
            (status, reason) = (Status::Converged, IDLE.into());
        }
        let accuracy = adaptation.as_ref().map(accuracy::summarise);
        let summary = Summary { accuracy, status, ..summary };
        let mut summary = Summary { reason: Some(reason + &remarks(&summary)), ..summary };
        summary.times_thickness(self.case.thickness);
        if self.session.rank() == 0 && !summary.contact.is_empty() {
            self.spare(self.write_contact_table(&self.files, &summary));
        }
        Ok(summary)
    }

    /// Fields, traces, balances and errors, the status and the reason so far; their files too. **Collective**
    fn evaluate(&self, summary: Summary, solved: &Solved) -> Result<(Summary, Status, String), RunError> {
        progress::enter(Work::Recovery);
        let found = Evaluation::new(&solved.problem, &solved.solution)?;
        self.report.warn_all(&large_strains(&found));
        self.report.warn_all(&crossed(&found));
        if !solved.is_idle() {
            self.report.warn_all(&loaded_points(&found));
        }
        let (mut contacts, mut estimates) = (BTreeMap::new(), BTreeMap::new());
        let (mut traces, mut warnings) = (Vec::new(), Vec::new());
        for (at, placed) in solved.problem.contacts.iter().enumerate() {
            let points = found.traces(&found.pressure(at))?;
            warnings.extend(apart(placed, &points));
            let (figures, estimate) = contact(solved, &found, at, &points);
            contacts.insert(placed.pair.name.clone(), figures);
            estimates.insert(placed.pair.name.clone(), estimate);
            // Rank 0 alone writes and draws them.
            traces.push(if self.session.rank() == 0 { points } else { Vec::new() });
        }
        self.report.warn_all(&warnings);
        let summary = with_fields(summary, self.case, &found)?;
        let errors = compare(self.case, &found)?;
        let estimate = EstimateSummary { contact: estimates, ..summary.estimate };
        let mut summary = Summary { contact: contacts, estimate, errors: errors.values, ..summary };
        let (status, reason) = self.judge(&mut summary, solved, &errors.missed);
        let peaks = largest_stresses(&found, solved, self.case, (&summary, status))?;
        summary.body = peaks.iter().cloned().collect();
        let adaptation = accuracy::adaptation(self.case, solved, &self.true_errors.borrow());
        let adaptation = adaptation.as_ref();
        self.write_files(&Shown { found: &found, summary: &summary, traces: &traces, peaks: &peaks, adaptation })?;
        Ok((summary, status, reason))
    }
}

impl Run<'_> {
    /// Expected values and trust: the status, and the reason so far. `missed` are values that the case expects. **Collective**
    fn judge(&self, summary: &mut Summary, solved: &Solved, missed: &[String]) -> (Status, String) {
        // Where nothing happens, rounding is all that a residual tells.
        let idle = solved.is_idle();
        let (mut status, mut reason) = if idle { (Status::Converged, IDLE.into()) } else { ended(solved) };
        let (converged, mut none) = (status == Status::Converged, None);
        let loose = if idle || !converged && !solved.violates_contact() { None } else { adrift(self, summary, solved) };
        if converged && !idle {
            missed.iter().for_each(|missed| self.report.say(&format!("missed: {missed}")));
            let missed = (self.case.exact.must_hold && !missed.is_empty())
                .then(|| format!("expected values are missed ({})", missed.join("; ")));
            none = no_result(summary, self.case);
            let stopped = missed.or_else(|| none.clone()).map(|words| (Status::NotConverged, words));
            let coarse = || unresolved(summary, self.case, solved.ending.still_moved());
            let coarse = || Some((Status::Unresolved, loose.clone().or_else(coarse)?));
            (status, reason) = stopped.or_else(coarse).unwrap_or((status, reason));
        } else if let Some(words) = &loose {
            reason.clone_from(words);
        }
        let unresolved = (status == Status::Unresolved).then_some("is not resolved");
        let why = none.map(|_| "has not converged").or(unresolved);
        let judgement = trust::judge(summary, self.case, converged, why);
        if loose.is_some() {
            // Figures of rounding say nothing.
            return (status, reason);
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

/// Words for a body that is held by contacts alone on which rounding presses, or of which nothing but a pull was found, and that nothing
/// drives. **Collective**
fn adrift(run: &Run, summary: &Summary, solved: &Solved) -> Option<String> {
    let pressed = pressed_by_rounding(summary, run.case);
    let pulled = if solved.violates_contact() { pulled(summary, run.case) } else { Vec::new() };
    let told = |(names, words): (Vec<String>, &str)| {
        Some(format!("contact {}: {words}: {}", names.first()?, solved.adrift_without(&names)?))
    };
    let all =
        [(pressed, "what presses is rounding, so that where its bodies lie is not told"), (pulled, "nothing presses on it")];
    all.into_iter().find_map(told)
}

/// How the procedure ended: the status, and its words.
fn ended(solved: &Solved) -> (Status, String) {
    let status = if solved.ending.is_converged() { Status::Converged } else { Status::NotConverged };
    (status, solved.ending.to_string())
}

/// What else a reason says: the estimated error, largest values that mean nothing, contacts without pressure.
fn remarks(summary: &Summary) -> String {
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
