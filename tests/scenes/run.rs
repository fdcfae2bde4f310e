//! One run of a scene, and what it says.

use crate::profile::Profile;
use crate::scene::{Scene, Settings};
use crate::support::mesh::write_scene;
use crate::support::process::PATIENCE;
use crate::support::{Run, TracePoint};
use serde_json::Value;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::time::Duration;

/// How a run ended.
#[derive(Clone, Debug, Default)]
pub struct Said {
    /// Nothing if it had to be ended.
    pub code: Option<i32>,
    pub trust: Option<bool>,
    /// The reason of the summary, or what stands on standard error.
    pub reason: String,
    /// Lines of warning.
    pub warnings: Vec<String>,
    pub profile: Option<Profile>,
    /// Estimated errors of ∫λ ds and of λ, all over its worst zone.
    pub estimate: [Option<f64>; 2],
    /// All of `summary.json`, and the trace.
    pub summary: Value,
    pub trace: Vec<TracePoint>,
}

/// Runs a scene on as many ranks as its settings say; case and mesh stay in the folder.
pub fn solve(scene: &Scene, settings: &Settings, folder: &Path) -> Said {
    std::fs::create_dir_all(folder).expect("a folder");
    let file = write_scene(folder, &scene.mesh(&settings.layers), &scene.case(settings));
    run(&file, settings.ranks, |x| scene.parameter(x))
}

/// Runs a case of one contact `c`; `parameter` says where on the seam a point lies.
pub fn run(file: &Path, ranks: usize, parameter: impl Fn([f64; 2]) -> f64) -> Said {
    run_within(PATIENCE, file, ranks, parameter)
}

/// The same; after this time it is ended.
pub fn run_within(patience: Duration, file: &Path, ranks: usize, parameter: impl Fn([f64; 2]) -> f64) -> Said {
    let run = Run::file(file).within(patience);
    let run = if ranks == 1 { run.alone() } else { run.ranks(ranks) };
    let Ok(ended) = catch_unwind(AssertUnwindSafe(|| run.ended())) else {
        return Said { reason: "it does not end".into(), ..Said::default() };
    };
    let warnings: Vec<String> = ended.errors.lines().filter(|line| line.contains("warning:")).map(String::from).collect();
    let mut said = Said { code: ended.code, reason: ended.errors.clone(), warnings, ..Said::default() };
    if !ended.out.join("summary.json").exists() {
        return said;
    }
    // What it said stays beside the case, to be looked at.
    let kept = file.with_file_name("said.json");
    std::fs::copy(ended.out.join("summary.json"), kept).expect("the folder of the case can be written");
    let summary = ended.summary();
    said.reason = summary["reason"].as_str().unwrap_or_default().to_string();
    let contact = &summary["contact"]["c"];
    let all: Vec<_> = summary["contact"].as_object().into_iter().flatten().map(|(_, own)| own["trust"].as_bool()).collect();
    said.trust = if all.contains(&Some(false)) { Some(false) } else { (!all.is_empty() && !all.contains(&None)).then_some(true) };
    let zones = contact["zones"].as_array().into_iter().flatten();
    let whole = zones.filter(|zone| zone["share"].as_f64().is_some_and(|share| share > 0.01)).map(|zone| zone["whole"].as_f64());
    let worst = whole.collect::<Option<Vec<f64>>>().and_then(|all| all.into_iter().reduce(f64::max));
    said.estimate = [summary["estimate"]["c"]["force"].as_f64(), worst];
    if let Some(force) = contact["force"].as_f64().filter(|_| ended.out.join("contact_c.csv").exists()) {
        said.trace = ended.trace("c");
        let points = said.trace.iter().map(|point| [parameter(point.x), point.lambda]).collect();
        said.profile = Some(Profile::new(points, force));
    }
    said.summary = summary;
    said
}
