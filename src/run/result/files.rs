//! The files of a result, and its folder put in its place.

use super::fields;
use super::figures::{self, Shown};
use crate::discretisation::Contact;
use crate::mesh::MacroMesh;
use crate::output::report::{ReportPage, write_report};
use crate::output::summary::{Status, Summary};
use crate::output::{CONTACTS, OutputError, ResultFolder, RunError, contact_table, contacts_table, vtk, write_text};
use crate::recovery::TracePoint;
use crate::run::Run;
use crate::run::accuracy::ADAPTED_MESH;
use crate::run::telling::report::memory;
use crate::run::telling::{interruption, progress};
use crate::run::verdict::exact::expected_values;
use std::path::{Path, PathBuf};

impl Run<'_> {
    /// Writes what tells the whole result, and prints the verdict. **Collective**
    pub(in crate::run) fn finish(&self, summary: Summary, mesh: &MacroMesh) -> Result<Status, RunError> {
        let time_s = self.report.times(&self.stages, self.session);
        let provenance = Some(self.origin.provenance.clone());
        let summary = Summary { time_s, memory_mib: memory(self.session), provenance, ..summary };
        let mut left_out = Vec::new();
        let finished = interruption::finish(|folder, warnings| {
            let mut write = |folder: &ResultFolder| self.write_whole(&summary, mesh, folder, (warnings, &mut left_out));
            match write(&folder) {
                Err(refusal @ OutputError::Io { .. }) => self.put_elsewhere(&folder, refusal, write),
                written => written.and_then(|()| folder.commit()),
            }
        });
        left_out.into_iter().for_each(|refusal| self.spare(Err(refusal)));
        let overtaken = self.session.any(matches!(finished, Err(OutputError::Overtaken(_) | OutputError::Elsewhere { .. })));
        let kind = if overtaken { RunError::Overtaken } else { RunError::Failed };
        self.session.agree(finished.map_err(|error| error.to_string())).map_err(kind)?;
        self.report.table(&summary);
        summary.contact_lines().iter().for_each(|words| self.report.say(words));
        if summary.status == Status::Converged {
            summary.stresses_in_words().iter().for_each(|words| self.report.say(words));
        }
        self.report.verdict(&summary, &self.options.out);
        Ok(summary.status)
    }

    /// Puts the result in another place, where the folder refuses what it cannot do without: nothing that is solved is lost. The working
    /// directory comes first, since what is for temporary files may be gone when a job ends.
    fn put_elsewhere(
        &self,
        folder: &ResultFolder,
        refusal: OutputError,
        mut write: impl FnMut(&ResultFolder) -> Result<(), OutputError>,
    ) -> Result<(), OutputError> {
        let name = self.options.out.file_name().unwrap_or_default().to_string_lossy();
        let name = format!("mezha-{name}-{}", std::process::id());
        let mut put = |place: &PathBuf| {
            let other = folder.begin_elsewhere(place)?;
            write(&other)?;
            other.commit()
        };
        let mut places = [PathBuf::new(), std::env::temp_dir()].map(|parent| parent.join(&name)).into_iter();
        match places.find(|place| put(place).is_ok()) {
            Some(place) => Err(OutputError::Elsewhere { place, source: Box::new(refusal) }),
            None => Err(refusal),
        }
    }

    /// Writes what tells a whole result, with the mesh if it was adapted. What is `left_out` can be told when nobody holds the folder any
    /// more.
    fn write_whole(
        &self,
        summary: &Summary,
        mesh: &MacroMesh,
        folder: &ResultFolder,
        (warnings, left_out): (&[String], &mut Vec<OutputError>),
    ) -> Result<(), OutputError> {
        progress::write_files();
        self.origin.write(folder)?;
        if !summary.contact.is_empty() && !folder.path(CONTACTS).exists() {
            self.write_contact_table(folder.temporary(), summary)?;
        }
        if self.case.output.fields {
            let contacts = self.case.contacts.iter().map(|pair| (pair.name.clone(), figures::sides(mesh, pair)));
            let (contacts, expected): (Vec<_>, _) = (contacts.collect(), expected_values(self.case, summary));
            let (title, case) = (self.case.title.as_str(), self.origin.case.as_str());
            let page = ReportPage { title, summary, expected: &expected, contacts: &contacts, warnings, case };
            left_out.extend(write_report(folder.temporary(), &page).err());
        }
        if summary.accuracy.as_ref().is_some_and(|steps| !steps.is_empty()) {
            let own = mesh.without_tools(|name| self.case.tool_of(name).is_some());
            left_out.extend(write_text(&folder.path(ADAPTED_MESH), &own.to_gmsh()).err());
        }
        folder.write_summary(summary)
    }

    /// Writes the table of all contacts.
    pub(super) fn write_contact_table(&self, folder: &Path, summary: &Summary) -> Result<(), OutputError> {
        let contacts: Vec<_> = self.case.contacts.iter().map(|pair| (pair.name.as_str(), &pair.between)).collect();
        write_text(&folder.join(CONTACTS), &contacts_table(&contacts, summary))
    }

    /// A warning for a file that could not be written, and that the result can do without.
    pub(super) fn spare(&self, written: Result<(), OutputError>) {
        if let Err(refusal) = written {
            self.report.warn(&format!("a file is missing in the result: {refusal}"));
        }
    }

    /// Does something on rank 0; what fails there has failed on all. **Collective**
    pub(super) fn on_first(&self, write: impl FnOnce() -> Result<(), OutputError>) -> Result<(), RunError> {
        let written = if self.session.rank() == 0 { write() } else { Ok(()) };
        self.session.agree(written.map_err(|error| error.to_string())).map_err(RunError::Failed)
    }

    /// Traces, which rank 0 has, in files; fields and figures too, unless the case wants none. **Collective**
    pub(super) fn write_files(&self, shown: &Shown) -> Result<(), RunError> {
        if self.session.rank() == 0 {
            let path = |contact: &Contact| self.files.join(format!("contact_{}.csv", contact.pair.name));
            let tables = shown.found.problem.contacts.iter().zip(shown.traces);
            tables.for_each(|(contact, points)| self.spare(write_text(&path(contact), &contact_table(points))));
        }
        if !self.case.output.fields {
            return Ok(());
        }
        let stress = shown.found.stress()?;
        let at_node = |part: usize, node: usize| stress.at(part, node);
        progress::write_files();
        self.write_fields(shown, at_node);
        if self.draws { self.write_figures(shown, at_node) } else { Ok(()) }
    }

    /// Fields of the bodies and along the contacts that have figures; where there is no room for them the result goes without.
    /// **Collective**
    fn write_fields(&self, shown: &Shown, stress: impl Fn(usize, usize) -> [f64; 4]) {
        let folder = &self.files;
        let own = shown.with_figures().filter(|_| self.session.rank() == 0);
        let curves = own.map(|(at, contact)| (folder.join(format!("contact_{}.vtu", contact.pair.name)), &shown.traces[at]));
        let curves: Vec<(PathBuf, &Vec<TracePoint>)> = curves.collect();
        let write_curves = || curves.iter().try_for_each(|(path, points)| Ok(vtk::write_curve(path, points)?));
        let written = fields::write(folder, shown.found, stress).and_then(|()| write_curves());
        if let Err(refusal) = self.session.agree(written) {
            // They are the largest files: where there is no room for them there may be for all others.
            fields::remove(folder, self.session);
            curves.iter().for_each(|(path, _)| _ = std::fs::remove_file(path));
            // There is room when all ranks have removed their pieces.
            self.session.any(true);
            self.report.warn(&format!("there are no fields in the result: {refusal}"));
        }
    }
}
