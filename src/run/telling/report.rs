//! What a run prints on rank 0 while it lives, and the stages whose times it tells.

use super::{interruption, progress};
use crate::accuracy::{Accuracy, AdaptedMesh};
use crate::case::{Case, LoadStep};
use crate::discretisation::{Contact, Scene};
use crate::element::Order;
use crate::mesh::Numbering;
use crate::output::plot::range_of;
use crate::output::summary::{MOST_TOLD, Memory, Provenance, Status, Time, WORST, clauses, listed};
use crate::output::{RunError, Summary, Units};
use crate::petsc::{Session, Stage};
use crate::procedure::Event;
use crate::run::accuracy;
use crate::run::memory::value;
use crate::run::reading::origin;
use crate::run::run_options::RunOptions;
use crate::run::verdict::warnings::before::{locking, short_segments};
use crate::run::words::{length, title, units};
use std::collections::HashSet;
use std::io::Write;
use std::path::Path;
use std::time::Instant;

/// Stages of a run, as the summary times them.
pub struct Stages {
    /// Reading, partition.
    pub mesh: Stage,
    /// Assembly of matrices.
    pub assemble: Stage,
    /// Placing and coupling of contacts.
    pub contact: Stage,
    /// Setting up solvers.
    pub setup: Stage,
    /// Solving.
    pub solve: Stage,
    /// Looking at solutions, and writing them.
    pub output: Stage,
}

impl Stages {
    /// All stages. **Collective**
    pub fn new(session: &Session) -> Result<Self, RunError> {
        let stage = |name| Stage::new(session, name);
        Ok(Self {
            mesh: stage("mesh")?,
            assemble: stage("assemble")?,
            contact: stage("contact")?,
            setup: stage("setup")?,
            solve: stage("solve")?,
            output: stage("output")?,
        })
    }
}

/// Prints to standard output, on rank 0 only and unless the run is quiet.
#[derive(Clone)]
pub struct Report {
    speaks: bool,
    first: bool,
    ranks: usize,
    started: Instant,
    /// Whether the mesh is adapted: the one of the file, and its segments, are a beginning only.
    adapts: bool,
    units: Units,
    /// What warnings begin with: the load step that they are of.
    of_step: String,
}

impl Report {
    /// A report of a run of a case.
    pub fn new(case: &Case, options: &RunOptions, session: &Session) -> Self {
        let first = session.rank() == 0;
        let (speaks, ranks, adapts) = (first && !options.quiet, session.size(), case.accuracy.is_some());
        Self { speaks, first, ranks, started: options.started, adapts, units: units(case), of_step: String::new() }
    }

    /// The report of a load step, which it announces.
    pub fn of_step(&self, step: &LoadStep) -> Self {
        self.say(&step.words());
        progress::step(step.number, step.count);
        Self { of_step: format!("step {}: ", step.number), ..self.clone() }
    }

    /// Prints a line.
    pub fn say(&self, line: &str) {
        if self.speaks {
            // A reader that has gone away is no reason to stop.
            let _ = progress::aside(|| writeln!(std::io::stdout(), "{line}"));
        }
    }

    /// Title of the case.
    pub fn start(&self, case: &Case) {
        let ranks = if self.ranks == 1 { "1 rank".into() } else { format!("{} ranks", self.ranks) };
        self.say(&format!("mezha {}: {} on {ranks}", env!("CARGO_PKG_VERSION"), title(case)));
    }

    /// Whether a run of the case beside a result repeats it, and if not, what differs.
    pub fn repeats(&self, now: &Provenance, before: &Provenance, case: &Case) {
        let unless = origin::may_end_elsewhere(case.accuracy.as_ref());
        let (words, warns) = origin::repeats(now, before, &case.file, &unless);
        if warns { self.warn(&words) } else { self.say(&words) }
    }

    /// An event of the solution procedure.
    pub fn event(&self, event: &Event) {
        match event {
            Event::AtRest { scene, at_rest } => {
                self.sizes(scene, &at_rest.contacts, &at_rest.numbering);
                if !self.adapts {
                    self.warn_all(&short_segments(&at_rest.contacts));
                }
                self.warn_all(&locking(scene));
            }
            Event::Solver(words) => self.say(&format!("solver: {words}")),
            Event::Coarse { solve, active, passes, converged } => {
                let iterations: Vec<String> = solve.iterations.iter().map(usize::to_string).collect();
                let (iterations, all) = (iterations.join(" "), active.len());
                let active = active.iter().filter(|active| **active).count();
                let end = if *converged { "" } else { "; not converged, not used further" };
                let words = format!("{active}/{all} multipliers in contact, {iterations} iterations{end}");
                self.say(&format!("refine {}: {} unknowns, {words}", solve.refine, solve.unknowns));
                passes.iter().for_each(|pass| self.fallback(pass.fallback.as_deref()));
            }
            Event::Refinement { .. } => {}
            Event::Begin(follows) => self.head(*follows),
            Event::Passed(pass, all) => {
                let (number, active, krylov) = (pass.iteration, pass.active, pass.krylov_iterations);
                let (added, released) = (format!("+{}", pass.added), format!("-{}", pass.released));
                let [residual, penetration, du] = [pass.residual, pass.max_penetration, pass.du];
                let sets = format!("{number:5}  {active:>6}/{all:<6} {added:>3}/{released:<4} {krylov:>4}");
                self.say(&format!("{sets}   {residual:8.1e}  {penetration:11.2e}  {du:8.1e}"));
                self.fallback(pass.fallback.as_deref());
            }
            Event::Placed(step) => {
                let figure = |value: Option<f64>| value.map_or("-".to_string(), |value| format!("{value:.1e}"));
                let flipped = step.flipped.map_or("-".to_string(), |count| count.to_string());
                let (length, unit, moved, du) =
                    (length(step.length), self.units.length().after(), figure(step.moved), figure(step.du));
                self.say(&format!(
                    "boundary {}: length {length}{unit}, moves by {moved}, displacement by {du}, multipliers changed {flipped}",
                    step.iteration
                ));
            }
            Event::Again { from_before } => {
                let from = if *from_before { "with the step before" } else { "with the bodies at rest" };
                self.say(&format!("not converged; begins once more, {from}"));
            }
            Event::Adapted { accuracy: asked, mesh, wanted, .. } => self.adapted(asked, mesh, wanted),
        }
    }

    /// Head of the table of passes, and before it, if boundaries follow the bodies, when they stand.
    fn head(&self, follows: Option<[f64; 2]>) {
        if let Some([boundary, displacement]) = follows {
            self.say(&format!(
                "boundaries follow the bodies until they move by {boundary:.0e} of their length, the displacement by {displacement:.0e} of its norm, and no multiplier changes; or, after coarser meshes, by less than this one is exact for"
            ));
        }
        self.say("outer  active       +/-  Krylov  residual  penetration     du");
    }

    /// One mesh of a sequence.
    fn adapted(&self, asked: &Accuracy, mesh: &AdaptedMesh, wanted: &[f64]) {
        let error = |place: usize| mesh.errors.get(place).copied().flatten();
        let goal = |&place: &usize| accuracy::estimate(&asked.goals[place], error(place), wanted[place]);
        let all: Vec<String> = accuracy::told(asked, Some(mesh)).iter().map(goal).collect();
        let goals = accuracy::of_how_many(asked, Some(mesh)) + &all.join(", ");
        let AdaptedMesh { number, macro_triangles, unknowns, seconds, .. } = mesh;
        self.say(&format!("mesh {number:2}: {macro_triangles} macro triangles, {unknowns} unknowns, {goals}, {seconds:.2} s"));
    }

    /// Sizes of mesh and contacts.
    fn sizes(&self, scene: &Scene, contacts: &[Contact], numbering: &Numbering) {
        let level = numbering.level;
        let order = if level.order == Order::P1 { "P1" } else { "P2" };
        let triangles = scene.mesh.triangles.len() * level.triangles_per_edge().pow(2);
        let unknowns = 2 * numbering.node_count();
        let multipliers: usize = contacts.iter().map(|contact| contact.multipliers.count()).sum();
        let first = if self.adapts { "the first mesh: " } else { "" };
        self.say(&format!("{first}{triangles} {order} triangles, {unknowns} unknowns, {multipliers} multipliers"));
        contact_lines(contacts, &self.units).iter().for_each(|line| self.say(line));
        if level.intervals > 1 {
            self.bent(scene, contacts);
        }
    }

    /// Edges whose shape nobody has declared, and that are taken for chords of something smooth.
    fn bent(&self, scene: &Scene, contacts: &[Contact]) {
        let mut known = HashSet::new();
        let names = contacts.iter().flat_map(|contact| &contact.pair.between).filter(|name| known.insert(*name));
        let bent: Vec<(&String, f64)> = names.map(|name| (name, scene.mesh.bent_by(name))).filter(|(_, by)| *by > 0.0).collect();
        let words =
            "no [geometry] gives its shape; its edges are bent onto a spline through the nodes of the mesh file, by up to";
        if bent.len() <= MOST_TOLD {
            return bent.iter().for_each(|(name, by)| self.say(&format!("boundary {name}: {words} {by:.1e}")));
        }
        let most = bent.iter().map(|(_, by)| *by).fold(0.0, f64::max);
        let names: Vec<&String> = bent.iter().map(|(name, _)| *name).collect();
        self.say(&format!("{} boundaries ({}): {words} {most:.1e}", names.len(), listed(&names)));
    }

    /// A stronger preconditioner, which all solves after it keep.
    fn fallback(&self, words: Option<&str>) {
        if let Some(words) = words {
            self.say(&format!("       slow; went over to {words}"));
        }
    }

    /// Warnings of one kind, a line each; of many the first ones, and how many others there are.
    pub fn warn_all(&self, lines: &[String]) {
        let few = if lines.len() > MOST_TOLD { WORST } else { lines.len() };
        lines[..few].iter().for_each(|line| self.warn(line));
        if few < lines.len() {
            self.warn(&format!("{} more of this kind", lines.len() - few));
        }
    }

    /// A line of warning on standard error, also if the run is quiet.
    pub fn warn(&self, line: &str) {
        if self.first {
            interruption::keep_warning(&format!("{}{line}", self.of_step));
            // The run is worth more than the words.
            let words = format!("mezha: warning: {}{line}\n", self.of_step);
            let _ = progress::aside(|| std::io::stderr().write_all(words.as_bytes()));
        }
    }

    /// The last words: the verdict, and where the results are. A bad one is printed even if the run is quiet.
    pub fn verdict(&self, summary: &Summary, out: &Path) {
        let reason = summary.reason.as_deref().unwrap_or_default();
        let lines = clauses(reason).join("\n    ");
        match summary.status {
            Status::Converged => self.say(&match untrusted(summary) {
                None => format!("mezha: converged: {reason}"),
                Some(contacts) => format!("mezha: converged; pressure NOT trusted ({contacts})\n    {lines}"),
            }),
            Status::NotConverged | Status::Unresolved | Status::Interrupted => {
                let words = if summary.status == Status::Unresolved { "resolved" } else { "converged" };
                let words = format!("mezha: NOT {words}: {lines}");
                if self.first && !self.speaks {
                    let _ = progress::aside(|| writeln!(std::io::stderr(), "{words}"));
                }
                self.say(&words);
            }
        }
        self.say(&format!("results in {}", out.display()));
    }

    /// Times of the stages on the slowest rank. **Collective**
    pub fn times(&self, stages: &Stages, session: &Session) -> Time {
        let Stages { mesh, assemble, contact, setup, solve, output } = stages;
        let [mesh, assemble, contact, setup, solve, output] =
            [mesh, assemble, contact, setup, solve, output].map(|stage| stage.seconds());
        let seconds = [mesh, assemble, contact, setup, solve, output, self.started.elapsed().as_secs_f64()];
        let [mesh, assemble, contact, setup, solve, output, total] = session.max(seconds).map(Some);
        Time { mesh, assemble, contact, setup, solve, output, total }
    }

    /// The table of stages.
    pub fn table(&self, summary: &Summary) {
        let Time { mesh, contact, assemble, setup, solve, output, total } = summary.time_s;
        let [mesh, contact, assemble, setup, solve, output, total] =
            [mesh, contact, assemble, setup, solve, output, total].map(|seconds| seconds.unwrap_or(0.0));
        self.say(&format!(
            "seconds: mesh {mesh:.3}  contact {contact:.3}  assemble {assemble:.3}  setup {setup:.3}  solve {solve:.3}  output {output:.3}  total {total:.3}"
        ));
        let memory = &summary.memory_mib;
        let [largest, sum] = [memory.max_rank, memory.sum].map(|mib| mib.unwrap_or(0.0));
        self.say(&format!("memory: {largest:.0} MiB on the largest rank, {sum:.0} MiB in all"));
    }
}

/// A line for each contact; of many one for all.
pub fn contact_lines(contacts: &[Contact], units: &Units) -> Vec<String> {
    let unit = units.length().after();
    if contacts.len() > MOST_TOLD {
        let [fewest, most] = range_of(contacts.iter().map(|contact| contact.boundary.segments() as f64));
        let [shortest, longest] = range_of(contacts.iter().map(|contact| contact.boundary.length())).map(length);
        let multipliers: usize = contacts.iter().map(|contact| contact.multipliers.count()).sum();
        let count = contacts.len();
        return vec![format!(
            "{count} contacts: {fewest} to {most} segments over lengths of {shortest} to {longest}{unit}, {multipliers} multipliers"
        )];
    }
    let words = |contact: &Contact| {
        let (name, segments, length) = (&contact.pair.name, contact.boundary.segments(), length(contact.boundary.length()));
        let (what, count) = (if segments == 1 { "segment" } else { "segments" }, contact.multipliers.count());
        format!("contact {name}: {segments} {what} over a length of {length}{unit}, {count} multipliers")
    };
    contacts.iter().map(words).collect()
}

/// How many contacts have a pressure that is not to be trusted, of how many; nothing if there are none.
fn untrusted(summary: &Summary) -> Option<String> {
    let (count, all) = (summary.named(|contact| contact.judged.trust == Some(false)).len(), summary.contact.len());
    (count > 0).then(|| format!("{count} of {all} contact{}", if all == 1 { "" } else { "s" }))
}

/// Largest resident memory so far, as the system knows it. **Collective**
pub fn memory(session: &Session) -> Memory {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let own = value(&status, "VmHWM:").unwrap_or(f64::NAN) / 1024.0;
    let [max_rank, sum] = [session.max([own]), session.sum([own])].map(|[value]| Some(value));
    Memory { max_rank, sum }
}
