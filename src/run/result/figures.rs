//! Figures of a solution.

use super::fields;
use crate::accuracy::Adaptation;
use crate::case::Case;
use crate::contact::{Configuration, Pair};
use crate::discretisation::{Contact, Scene};
use crate::element::{Plane, StressMeasure};
use crate::mesh::{MacroMesh, each_once};
use crate::output::plot::{self, ContactZoom, DeformedFigure, DrawnContact, DrawnForce, Facet};
use crate::output::summary::{BodySummary, MOST_WITH_FIGURES};
use crate::output::{OutputError, RunError, Summary};
use crate::recovery::{Evaluation, TracePoint};
use crate::run::words::title;
use crate::run::{Run, accuracy};
use std::collections::BTreeSet;
use std::path::Path;

/// Intervals that press are drawn one by one, those with the largest forces.
const MOST_ZOOMS: usize = 6;

/// Lines of forces reach into a body by this share of the smaller side of the box around it: nearly to its middle.
const REACH: f64 = 0.4;

/// An interval that is drawn: its contact, its number in it from 1, and what is shown.
struct Drawing {
    contact: usize,
    number: usize,
    zoom: ContactZoom,
}

/// A solution and what is known of it, as its files and figures show it.
#[derive(Clone, Copy)]
pub struct Shown<'a> {
    pub found: &'a Evaluation<'a>,
    pub summary: &'a Summary,
    /// The points along each contact, on rank 0.
    pub traces: &'a [Vec<TracePoint>],
    /// The largest stress of each body.
    pub peaks: &'a [(String, BodySummary)],
    pub adaptation: Option<&'a Adaptation>,
}

impl Shown<'_> {
    /// The contacts that have figures, each with its number.
    pub fn with_figures(&self) -> impl Iterator<Item = (usize, &Contact)> {
        let shown: BTreeSet<&str> = self.summary.with_figures().into_iter().collect();
        let contacts = self.found.problem.contacts.iter().enumerate();
        contacts.filter(move |(_, contact)| shown.contains(contact.pair.name.as_str()))
    }
}

impl Run<'_> {
    /// Draws everything that is known of one solution. **Collective**
    pub(super) fn write_figures(&self, shown: &Shown, stress: impl Fn(usize, usize) -> [f64; 4]) -> Result<(), RunError> {
        let (folder, Shown { found, summary, traces, peaks, adaptation }) = (&self.files, *shown);
        let contacts = &found.problem.contacts;
        let facets = fields::facets(found, &stress);
        let macro_edges = adaptation.map_or(Vec::new(), |_| fields::macro_edges(found, |_| true));
        let interfaces = fields::macro_edges(found, |edge| found.problem.scene.mesh.is_interface(edge));
        let titles: Vec<String> = contacts.iter().map(|contact| title_of(self.case, &contact.pair.name)).collect();
        let bodies: Vec<[String; 2]> = contacts.iter().map(|contact| sides(&found.problem.scene.mesh, &contact.pair)).collect();
        let drawn = |(at, contact): (usize, &Contact)| DrawnContact {
            title: &titles[at],
            bodies: bodies[at].each_ref().map(String::as_str),
            points: &traces[at],
            is_deformed: contact.pair.configuration == Configuration::Deformed,
            units: &summary.units,
        };
        let drawn: Vec<DrawnContact> = contacts.iter().enumerate().map(drawn).collect();
        let zooms = self.zooms(shown, &drawn, &facets);
        let zoomed = |drawing: Drawing| (fields::facets_of_zoom(found, &stress, &drawing.zoom), drawing);
        let zooms: Vec<(Vec<Facet>, Drawing)> = zooms.into_iter().map(zoomed).collect();
        if self.session.rank() != 0 {
            return Ok(());
        }
        self.write_contacts(shown, &drawn, &zooms);
        let forces = drawn_forces(&found.problem.scene, contacts, summary, self.case.thickness);
        let figure = DeformedFigure {
            title: title(self.case),
            measure: StressMeasure::VonMises,
            facets: &facets,
            macro_edges: &macro_edges,
            interfaces: &interfaces,
            contacts: &drawn,
            are_contacts_many: contacts.len() > MOST_WITH_FIGURES,
            forces: &forces,
            peaks,
            has_axis: self.case.plane == Plane::Revolution,
            units: &summary.units,
        };
        self.spare(figure.write(&folder.join(plot::stress_file(figure.measure))));
        for &measure in &self.case.output.figures {
            self.spare(DeformedFigure { measure, peaks: &[], ..figure }.write(&folder.join(plot::stress_file(measure))));
        }
        self.spare(adaptation.map_or(Ok(()), |adaptation| write_accuracy(folder, title(self.case), adaptation)));
        Ok(())
    }

    /// Draws what is along the contacts that have figures, and the intervals that are drawn of them.
    fn write_contacts(&self, shown: &Shown, drawn: &[DrawnContact], zooms: &[(Vec<Facet>, Drawing)]) {
        for (at, contact) in shown.with_figures() {
            plot::write_along(&self.files, &contact.pair.name, &drawn[at]).into_iter().for_each(|written| self.spare(written));
        }
        let (contacts, count) = (&shown.found.problem.contacts, shown.with_figures().count());
        if count < contacts.len() {
            let words = "those that are trusted least, and those with the largest forces";
            self.report.say(&format!("figures of {count} of {} contacts: {words}", contacts.len()));
        }
        let has_axis = self.case.plane == Plane::Revolution;
        for (facets, drawing) in zooms.iter().filter(|(facets, _)| !facets.is_empty()) {
            let name = format!("deformed_{}_{}.svg", contacts[drawing.contact].pair.name, drawing.number);
            self.spare(drawing.zoom.write(&self.files.join(name), &drawn[drawing.contact], facets, has_axis));
        }
    }

    /// The intervals that are drawn of the contacts that have figures, in the order of contacts and arc length. Rank 0 chooses.
    /// **Collective**
    fn zooms(&self, shown: &Shown, drawn: &[DrawnContact], facets: &[Facet]) -> Vec<Drawing> {
        let mut all: Vec<(f64, Drawing)> = Vec::new();
        for (at, contact) in shown.with_figures() {
            let closed = shown.summary.contact.get(&contact.pair.name).and_then(|contact| contact.closed.as_deref());
            for (number, &interval) in closed.unwrap_or_default().iter().enumerate() {
                let zoom = ContactZoom::new(&drawn[at], interval, facets);
                let force = force_on(drawn[at].points, interval);
                all.extend(zoom.map(|zoom| (force, Drawing { contact: at, number: number + 1, zoom })));
            }
        }
        all.sort_by(|a, b| b.0.total_cmp(&a.0));
        all.truncate(MOST_ZOOMS);
        all.sort_by_key(|(_, drawing)| (drawing.contact, drawing.number));
        let numbers = |(_, Drawing { contact, number, zoom }): &(f64, Drawing)| {
            let [from, to] = zoom.frame;
            [[*contact as f64, *number as f64], zoom.interval, from, to].concat()
        };
        let own = if self.session.rank() == 0 { all.iter().flat_map(numbers).collect() } else { Vec::new() };
        let read = |v: &[[f64; 2]]| {
            let ([contact, number], zoom) = (v[0].map(|v| v as usize), ContactZoom { interval: v[1], frame: [v[2], v[3]] });
            Drawing { contact, number, zoom }
        };
        self.session.gather_all(&own).as_chunks().0.chunks_exact(4).map(read).collect()
    }
}

/// The forces of several contacts, those of a thickness of one in the summary made those of the whole, each with a line that reaches into both bodies by a share of the smaller one.
fn drawn_forces(scene: &Scene, contacts: &[Contact], summary: &Summary, thickness: f64) -> Vec<DrawnForce> {
    if contacts.len() < 2 {
        return Vec::new();
    }
    let mut sizes = vec![f64::INFINITY; scene.mesh.bodies.len()];
    for (piece, [low, high]) in scene.mesh.pieces.iter().zip(scene.mesh.bounds()) {
        sizes[piece.body] = sizes[piece.body].min((high - low).amin());
    }
    let force = |contact: &Contact| {
        let found = summary.contact.get(&contact.pair.name)?;
        let own = contact.bodies.into_iter().filter(|&body| !scene.is_rigid(body)).map(|body| sizes[body]);
        let reach = REACH * own.fold(f64::INFINITY, f64::min);
        let is_deformed = contact.pair.configuration == Configuration::Deformed;
        let force = found.resultant?.map(|part| thickness * part);
        Some(DrawnForce { place: found.place?, force, reach, is_deformed })
    };
    contacts.iter().filter_map(force).collect()
}

/// ∫λ ds over an interval, by trapezoids.
fn force_on(points: &[TracePoint], [from, to]: [f64; 2]) -> f64 {
    let inside = points.windows(2).filter(|pair| pair[0].arc >= from && pair[1].arc <= to);
    inside.map(|pair| 0.5 * (pair[0].lambda + pair[1].lambda) * (pair[1].arc - pair[0].arc)).sum()
}

/// What stands above the figures of a contact, which is named where there are others.
fn title_of(case: &Case, contact: &str) -> String {
    if case.contacts.len() == 1 { title(case).into() } else { format!("{}, contact {contact}", title(case)) }
}

/// Names of both bodies of a contact; those of its boundaries where these do not tell them apart.
pub fn sides(mesh: &MacroMesh, pair: &Pair) -> [String; 2] {
    let bodies = |boundary: &String| each_once(mesh.edges_of(boundary).iter().map(|&edge| mesh.body_beside(edge)));
    match pair.between.each_ref().map(bodies).each_ref().map(Vec::as_slice) {
        [&[one], &[two]] if one != two => [one, two].map(|body| mesh.bodies[body].clone()),
        _ => pair.between.clone(),
    }
}

/// Draws what was reached on each mesh, if there are two of them.
fn write_accuracy(folder: &Path, title: &str, adaptation: &Adaptation) -> Result<(), OutputError> {
    let (sequences, count) = (accuracy::sequences(adaptation), adaptation.accuracy.goals.len());
    let title = match sequences.len() {
        few if few < count => format!("{title}; the {few} worst of {count} goals"),
        _ => title.to_owned(),
    };
    let is_known = sequences.iter().any(|sequence| sequence.estimates.iter().any(|(_, error)| *error > 0.0));
    if adaptation.meshes.len() >= 2 && is_known {
        return plot::write_accuracy(&folder.join("accuracy.svg"), &title, &sequences);
    }
    Ok(())
}
