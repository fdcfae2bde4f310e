//! A solution made into a result folder.

use super::Run;
use super::accuracy;
use super::fields;
use super::figures;
use super::interruption;
use super::outcome::outside;
use super::outcome::{Outcome, RunError};
use super::progress;
use super::report::{memory, short};
use super::summarise;
use crate::accuracy::Adaptation;
use crate::contact::{Configuration, GapChoice};
use crate::discretisation::Contact;
use crate::element::Plane;
use crate::geometry::Point;
use crate::mesh::MacroMesh;
use crate::output::report::{ReportPage, write_report};
use crate::output::summary::{self, Status, Summary};
use crate::output::{CONTACTS, ContactPoint, OutputError, ResultFolder, vtk, write_contact, write_contacts};
use crate::procedure::{Solved, Work};
use crate::recovery::{Evaluation, TracePoint};
use crate::run::verdict::expected;
use crate::run::verdict::points;
use crate::run::verdict::slivers;
use crate::run::verdict::trust;
use crate::run::verdict::unresolved;
use crate::run::verdict::zones;
use crate::run::verdict::{Errors, compare};
use std::collections::BTreeSet;
use std::path::Path;

/// Share of the drawn distance by which a declared gap may differ from it.
const MOST_OFF: f64 = 0.25;

impl Run<'_> {
    /// Evaluates and judges a solution, and writes its files; what is left to be known are times and memory. **Collective**
    pub(super) fn summarise(&self, solved: &Solved) -> Result<Summary, RunError> {
        let mut summary = Summary::new(&self.case.name, self.session.size());
        summarise::describe(&mut summary, self.case, solved);
        summary.estimate.energy = solved.estimate.energy;
        let (mut status, mut reason) = ended(solved);
        if solved.is_solved() {
            let _stage = self.stages.output.enter();
            (status, reason) = self.evaluate(&mut summary, solved)?;
        } else if status == Status::Converged {
            (status, reason) = (Status::NotConverged, trust::NO_NUMBERS.into());
        }
        if let Some(adaptation) = accuracy::adaptation(self.case, solved, &self.true_errors.borrow()) {
            summary.accuracy = Some(accuracy::summarise(&adaptation));
            (status, reason) = accuracy::judge(&adaptation, status, &reason);
            let flat = slivers(&solved.problem.scene.mesh).filter(|_| !adaptation.is_reached());
            reason += &flat.map_or(String::new(), |words| format!("; {words}"));
        }
        reason += &remarks(&summary, status);
        summary.status = status;
        summary.reason = Some(reason);
        summary.times_thickness(self.case.thickness);
        let contacts = self.case.contacts.iter().map(|pair| (pair.name.as_str(), &pair.between));
        let has_rows = !summary.contact.is_empty() && self.session.rank() == 0;
        let written = if has_rows { write_contacts(&self.files.join(CONTACTS), contacts, &summary) } else { Ok(()) };
        self.session.agree(written.map_err(|error| error.to_string())).map_err(RunError::Failed)?;
        Ok(summary)
    }

    /// Writes what tells the whole result, and prints the verdict. **Collective**
    pub(super) fn finish(&self, mut summary: Summary, mesh: &MacroMesh) -> Result<Outcome, RunError> {
        summary.time_s = self.report.times(&self.stages, self.session);
        summary.memory_mib = memory(self.session);
        summary.provenance = Some(self.origin.provenance.clone());
        let finished = interruption::finish(|folder, warnings| self.put_in_place(&summary, mesh, folder, warnings));
        let overtaken = self.session.any(matches!(finished, Err(OutputError::Overtaken(_))));
        let kind = if overtaken { RunError::Overtaken } else { RunError::Failed };
        self.session.agree(finished.map_err(|error| error.to_string())).map_err(kind)?;
        self.report.table(&summary);
        summary.contacts_in_words().iter().for_each(|words| self.report.say(words));
        let outcome = match summary.status {
            Status::Converged => Outcome::Converged,
            Status::Unresolved => Outcome::Unresolved,
            Status::NotConverged | Status::Interrupted => Outcome::NotConverged,
        };
        self.report.verdict(outcome, summary.reason.as_deref().unwrap_or_default(), &self.options.out);
        Ok(outcome)
    }

    /// Writes what tells a whole result, with the mesh if it was adapted, and puts the folder in its place.
    fn put_in_place(
        &self,
        summary: &Summary,
        mesh: &MacroMesh,
        folder: ResultFolder,
        warnings: &[String],
    ) -> Result<(), OutputError> {
        progress::write_files();
        self.origin.write(&folder)?;
        if self.case.output.fields {
            let contacts = self.case.contacts.iter().map(|pair| (pair.name.clone(), figures::sides(mesh, pair)));
            let (contacts, expected): (Vec<_>, _) = (contacts.collect(), expected::expected_values(self.case, summary));
            let (title, case) = (self.case.title.as_str(), self.origin.case());
            let page = ReportPage { title, summary, expected: &expected, contacts: &contacts, warnings, case };
            write_report(folder.temporary(), &page)?;
        }
        if summary.accuracy.as_ref().is_some_and(|steps| !steps.is_empty()) {
            let own = mesh.without_tools(|name| self.case.tool_of(name).is_some());
            let path = folder.path(accuracy::ADAPTED_MESH);
            std::fs::write(&path, own.to_gmsh()).map_err(OutputError::io("write", &path))?;
        }
        folder.write_summary(summary)?;
        folder.commit()
    }

    /// Expected values and trust: the status, and the reason so far.
    fn judge(&self, summary: &mut Summary, solved: &Solved, errors: Errors) -> (Status, String) {
        let (mut status, mut reason) = ended(solved);
        if status == Status::Converged && !errors.missed.is_empty() {
            errors.missed.iter().for_each(|missed| self.report.say(&format!("missed: {missed}")));
            if self.case.exact.must_hold {
                status = Status::NotConverged;
                reason = format!("expected values are missed ({})", errors.missed.join("; "));
            }
        }
        let no_result = trust::no_result(summary, self.case);
        if let (Status::Converged, Some(words)) = (status, no_result) {
            (status, reason) = (Status::NotConverged, words);
        }
        if let (Status::Converged, Some(words)) =
            (status, unresolved::unresolved(summary, self.case, solved.ending.still_moved()))
        {
            (status, reason) = (Status::Unresolved, words);
        }
        summary.errors = errors.values;
        let judgement = trust::judge(summary, self.case, solved.ending.is_converged());
        if status == Status::Unresolved {
            for contact in summary.contact.values_mut() {
                if contact.trust != Some(false) {
                    contact.verdict = Some("not trusted: the run is not resolved".into());
                }
                (contact.trust, contact.trust_force) = (Some(false), Some(false));
            }
        }
        if let Some(words) = judgement.unreliable {
            reason = match status {
                Status::Converged => format!("pressure unreliable: {words}"),
                Status::NotConverged | Status::Unresolved | Status::Interrupted => {
                    format!("{reason}; pressure unreliable: {words}")
                }
            };
            self.report.warn(&format!("pressure unreliable: {words}"));
        }
        for words in judgement.unknown {
            reason = format!("{reason}; {words}");
            self.report.warn(&words);
        }
        (status, reason)
    }

    /// Fields, traces, balances and errors, the status and the reason so far; their files too. **Collective**
    fn evaluate(&self, summary: &mut Summary, solved: &Solved) -> Result<(Status, String), RunError> {
        progress::enter(Work::Recovery);
        let found = Evaluation::new(&solved.problem, &solved.solution, self.session)?;
        summarise::balances(summary, &found);
        summarise::deformations(summary, &found);
        summary.displacement_max = Some(found.moved);
        self.report.large_strains(&found);
        self.report.warn_all(&points::loaded_points(&found));
        let (mut traces, mut apart) = (Vec::new(), Vec::new());
        for (at, contact) in solved.problem.contacts.iter().enumerate() {
            let points = found.traces(&found.pressure(at))?;
            apart.extend(apart_words(contact, &points));
            let mut zones = zones::zones(solved, at, &points);
            let mut described = summarise::contact(&found, at, &points);
            let pressing: Vec<[f64; 2]> = zones.iter().filter_map(|zone| zone.ends).collect();
            if contact.pair.configuration == Configuration::Reference {
                let (missing, force) = found.missing_force(at, &pressing, &points);
                (described.missing, described.missing_force) = (missing, Some(force));
                let at_ends = found.slip_at_ends(at, &pressing, &points);
                described.slip_at_ends = at_ends.map(|slip| slip.way);
                described.lost_at_ends = at_ends.map(|slip| slip.lost);
            }
            described.unresolved_force = Some(found.unresolved_force(at, &points));
            summarise::motions(&mut described, &found, at, &points);
            if contact.pair.curve.is_found() {
                let counting: Vec<[f64; 2]> =
                    zones.iter().filter(|zone| zone.counts(&zones)).filter_map(|zone| zone.ends).collect();
                summarise::corners(&mut described, &mut zones, &found.corners(at, &counting));
            }
            zones::without_singular_peaks(&mut zones);
            let force = solved.estimate.force.get(at).copied().flatten();
            summary.estimate.contact.insert(contact.pair.name.clone(), zones::contact_estimate(force, &zones));
            described.zones = zones;
            summary.contact.insert(contact.pair.name.clone(), described);
            // Rank 0 alone writes and draws them.
            traces.push(if self.session.rank() == 0 { points.iter().map(contact_point).collect() } else { Vec::new() });
        }
        self.report.warn_all(&apart);
        let is_round = self.case.plane == Plane::Revolution;
        summary.plane = is_round.then(|| "axisymmetric".into());
        for point in &self.case.probes {
            let region = solved.problem.scene.mesh.region(&point.body).expect("checked names");
            let probed = found.probe(region, Point::new(point.point[0], point.point[1]))?.ok_or_else(|| outside(point.point))?;
            let [xx, yy, xy, zz] = probed.stress;
            let values = summary::ProbeSummary {
                x: Some(point.point),
                u: Some(probed.displacement.into()),
                stress: Some([xx, yy, xy]),
                hoop: is_round.then_some(zz),
            };
            summary.probe.insert(point.name.clone(), values);
        }
        let errors = compare(self.case, &found)?;
        let judged = self.judge(summary, solved, errors);
        let adaptation = accuracy::adaptation(self.case, solved, &self.true_errors.borrow());
        self.write_files(&found, summary, &traces, adaptation.as_ref())?;
        Ok(judged)
    }

    /// Traces, which rank 0 has, in files; fields and figures too, unless the case wants none. **Collective**
    fn write_files(
        &self,
        found: &Evaluation,
        summary: &Summary,
        traces: &[Vec<ContactPoint>],
        adaptation: Option<&Adaptation>,
    ) -> Result<(), RunError> {
        let (case, session) = (self.case, self.session);
        let folder = &self.files;
        let written = if session.rank() == 0 { write_tables(folder, &found.problem.contacts, traces) } else { Ok(()) };
        session.agree(written.map_err(|error| error.to_string())).map_err(RunError::Failed)?;
        if !case.output.fields {
            return Ok(());
        }
        let stress = found.stress()?;
        let at_node = |part: usize, node: usize| stress.at(part, node);
        progress::write_files();
        session.agree(fields::write(folder, found, at_node)).map_err(RunError::Failed)?;
        if session.rank() == 0 {
            let curve = |name: &str| folder.join(format!("contact_{name}.vtu"));
            let shown: BTreeSet<&str> = summary.with_figures().into_iter().collect();
            let pairs = found.problem.contacts.iter().zip(traces);
            let mut pairs = pairs.filter(|(contact, _)| shown.contains(contact.pair.name.as_str()));
            pairs.try_for_each(|(contact, points)| vtk::write_curve(&curve(&contact.pair.name), points))?;
        }
        if self.draws { self.write_figures(found, summary, traces, adaptation, at_node) } else { Ok(()) }
    }
}

/// Words for boundaries that are drawn apart, or into each other, by more than their polygons can be, though the gap is declared to
/// be another.
fn apart_words(contact: &Contact, points: &[TracePoint]) -> Option<String> {
    let segment = contact.boundary.length() / contact.boundary.segments() as f64;
    let apart = |point: &TracePoint| {
        let drawn = point.distance[1] - point.distance[0];
        let (off, share) = match &contact.pair.gap {
            GapChoice::Geometry => return None,
            GapChoice::Closed => (drawn.abs(), 0.0),
            GapChoice::Formula(formula) => ((drawn - formula.value(&[point.x.x, point.x.y])).abs(), MOST_OFF),
        };
        // Boundaries that are drawn as touching say nothing of the gap.
        (drawn.abs().min(off) > 0.1 * segment + share * drawn.abs()).then_some((drawn, point.x))
    };
    let all = points.iter().filter(|point| point.is_complete()).filter_map(apart);
    let (drawn, x) = all.max_by(|a, b| a.0.abs().total_cmp(&b.0.abs()))?;
    let words = match &contact.pair.gap {
        GapChoice::Formula(formula) => format!(
            "gap = {} is declared, {:.3e} at ({}, {}), but the boundaries are drawn {:.3e} {} there; the declared gap counts; if the drawn one is meant, give gap = \"geometry\"",
            formula.text(),
            formula.value(&[x.x, x.y]),
            short(x.x),
            short(x.y),
            drawn.abs(),
            if drawn > 0.0 { "apart" } else { "into each other" }
        ),
        _ => format!(
            "gap = \"closed\", but the boundaries lie up to {:.3e} apart; if that is no error of the mesh, give gap = \"geometry\"",
            drawn.abs()
        ),
    };
    Some(format!("contact {}: {words}", contact.pair.name))
}

/// How the procedure ended: the status, and its words.
fn ended(solved: &Solved) -> (Status, String) {
    let status = if solved.ending.is_converged() { Status::Converged } else { Status::NotConverged };
    (status, solved.ending.to_string())
}

/// What else a reason says: the estimated error, largest values that mean nothing, contacts without pressure.
fn remarks(summary: &Summary, status: Status) -> String {
    let mut remarks = String::new();
    let names = |is: &dyn Fn(&summary::ContactSummary) -> bool| summary::listed(&summary.named(is));
    let is_told = summary.accuracy.iter().flatten().any(|step| step.energy.is_some());
    if let (Status::Converged, Some(error), false) = (status, summary.estimate.energy, is_told) {
        remarks += &format!("; estimated error {error:.1e} in the energy norm");
    }
    let is_singular = |zone: &summary::ZoneSummary, all: &[summary::ZoneSummary]| zone.singular == Some(true) && zone.counts(all);
    let singular = names(&|contact| contact.zones.iter().any(|zone| is_singular(zone, &contact.zones)));
    if status == Status::Converged && !singular.is_empty() {
        remarks += &format!(
            "; towards an end of contact {singular} λ grows without bound, as far as the meshes tell: its largest value says nothing"
        );
    }
    let idle = names(&|contact| contact.closed.as_ref().is_some_and(Vec::is_empty));
    if !idle.is_empty() {
        remarks += &format!("; nothing presses on contact {idle}");
    }
    let is_touching =
        |contact: &&summary::ContactSummary| contact.verdict.as_ref().is_some_and(|words| words.starts_with("touches"));
    let words = summary.contact.values().find(is_touching).and_then(|contact| contact.verdict.as_deref()).unwrap_or_default();
    match summary.named(|contact| is_touching(&contact))[..] {
        [] => {}
        [name] => remarks += &format!("; contact {name} {words}"),
        ref names => {
            let words = words.replace("touches", "touch").replace("carries", "carry");
            remarks += &format!("; {} contacts {words} ({})", names.len(), summary::listed(names));
        }
    }
    remarks
}

/// Writes the table along each contact boundary.
fn write_tables(folder: &Path, contacts: &[Contact], traces: &[Vec<ContactPoint>]) -> Result<(), OutputError> {
    let path = |contact: &Contact| folder.join(format!("contact_{}.csv", contact.pair.name));
    contacts.iter().zip(traces).try_for_each(|(contact, points)| write_contact(&path(contact), points))
}

fn contact_point(p: &TracePoint) -> ContactPoint {
    ContactPoint {
        s: p.arc,
        x: p.x.x,
        y: p.x.y,
        nx: p.normal.x,
        ny: p.normal.y,
        lambda: p.lambda,
        gap: p.gap,
        un_1: p.displacement[0],
        un_2: p.displacement[1],
        sigma_1: p.stress[0],
        sigma_2: p.stress[1],
    }
}
