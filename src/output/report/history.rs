//! How a run came to its end: load steps, adapted meshes, contact boundaries, active sets.

use std::path::Path;

use super::drawings::drawing;
use super::page::{ReportPage, TableColumn, count, long_table, number, table_of, trust_word};
use super::verdict::word;
use crate::output::markup::{UNKNOWN, subsection};
use crate::output::summary::{AccuracyStep, StepSummary};
use crate::output::units::Units;
use crate::procedure::{BoundaryStep, Pass};

/// Contacts that have columns in the table of load steps; all of them stand in `steps.csv`.
const MOST_COLUMNS: usize = 4;

/// Everything that is known of it.
pub fn history(folder: &Path, page: &ReportPage) -> String {
    let summary = page.summary;
    let mut text = String::new();
    if let Some(steps) = &summary.steps {
        text += &subsection("Load steps");
        let words = "Forces, widths and largest pressures over the load steps; hollow marks have not converged.";
        text += &drawing(folder, "steps.svg", words);
        text += &load_steps(steps, &summary.units);
    }
    if let Some(meshes) = &summary.accuracy {
        text += &subsection("Meshes");
        let words = "Errors against displacement unknowns, mesh by mesh; thin lines are what was asked for.";
        text += &drawing(folder, "accuracy.svg", words);
        text += &meshes_table(meshes);
    }
    let of_last = if summary.steps.is_some() { ", last load step" } else { "" };
    if !summary.boundaries.is_empty() {
        text += &subsection(&format!("Contact boundaries{of_last}"));
        text += &boundaries(&summary.boundaries);
    }
    if !summary.outer.is_empty() {
        text += &subsection(&format!("Active set{of_last}"));
        text += &passes(&summary.outer);
    }
    text
}

fn load_steps(steps: &[StepSummary], units: &Units) -> String {
    let names: Vec<&String> =
        steps.iter().max_by_key(|step| step.contact.len()).map_or(Vec::new(), |step| step.contact.keys().collect());
    let names = &names[..names.len().min(MOST_COLUMNS)];
    let factors: Vec<&String> = steps.first().map_or(Vec::new(), |step| step.factors.keys().collect());
    let of_contact = |name: &&String| {
        let [force, largest, pressure] = ["force", "largest λ", "pressure"].map(|what| format!("{what} of {name}"));
        [units.resultant().of(&force), units.stress().of(&largest), pressure]
    };
    let columns = factors.iter().map(|name| format!("factor of {name}")).chain(names.iter().flat_map(of_contact));
    let columns: Vec<String> = columns.collect();
    let row = |step: &StepSummary| {
        let mut cells = vec![step.step.to_string(), word(step.status).to_lowercase()];
        cells.extend(factors.iter().map(|name| number(step.factors.get(*name).copied())));
        for name in names {
            let contact = step.contact.get(*name);
            cells.push(number(contact.and_then(|contact| contact.force)));
            cells.push(number(contact.and_then(|contact| contact.pressure_max)));
            cells.push(contact.map_or(UNKNOWN.into(), |contact| trust_word(contact.trust)));
        }
        cells.push(step.iterations.iter().sum::<usize>().to_string());
        cells.push(step.seconds.map_or(UNKNOWN.into(), |seconds| format!("{seconds:.2}")));
        cells
    };
    let columns = columns.iter().map(String::as_str);
    let header: Vec<&str> = ["step", "status"].into_iter().chain(columns).chain(["iterations", "seconds"]).collect();
    long_table(&header, steps.iter().map(row).collect(), "steps.csv")
}

fn meshes_table(meshes: &[AccuracyStep]) -> String {
    let columns: [TableColumn<(usize, &AccuracyStep)>; 6] = [
        ("mesh", &|(at, _)| (at + 1).to_string()),
        ("macro triangles", &|(_, mesh)| count(mesh.macro_triangles)),
        ("refined", &|(_, mesh)| mesh.refine.to_string()),
        ("unknowns", &|(_, mesh)| count(mesh.unknowns)),
        ("energy norm", &|(_, mesh)| number(mesh.energy.as_ref().and_then(|goal| goal.estimate))),
        ("seconds so far", &|(_, mesh)| format!("{:.2}", mesh.seconds)),
    ];
    table_of(&columns, meshes.iter().enumerate(), Some("summary.json"))
}

fn boundaries(all: &[BoundaryStep]) -> String {
    let columns: [TableColumn<&BoundaryStep>; 5] = [
        ("boundary", &|one| one.iteration.to_string()),
        ("length", &|one| number(Some(one.length))),
        ("moves next by", &|one| number(one.moved)),
        ("change of the displacement", &|one| number(one.du)),
        ("pressures that changed state", &|one| one.flipped.map_or(UNKNOWN.into(), |count| count.to_string())),
    ];
    table_of(&columns, all.iter(), Some("summary.json"))
}

fn passes(all: &[Pass]) -> String {
    let columns: [TableColumn<&Pass>; 8] = [
        ("pass", &|pass| pass.iteration.to_string()),
        ("active", &|pass| pass.active.to_string()),
        ("added", &|pass| pass.added.to_string()),
        ("released", &|pass| pass.released.to_string()),
        ("iterations", &|pass| pass.krylov_iterations.to_string()),
        ("residual", &|pass| number(Some(pass.residual))),
        ("largest penetration", &|pass| number(Some(pass.max_penetration))),
        ("change of the displacement", &|pass| number(Some(pass.du))),
    ];
    table_of(&columns, all.iter(), Some("summary.json"))
}
