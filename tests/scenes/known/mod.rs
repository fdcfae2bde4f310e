//! Scenes whose pressure is known without mezha, or that have none.

mod bands;
mod discs;
mod exact;
mod motions;
mod refused;
mod rings;

use crate::profile::{Apart, Profile};
use crate::run::{Said, run};
use crate::support::mesh::write_scene;
use crate::verdict::is_quiet;
use std::path::PathBuf;

/// Where on the seam a point of the plane lies.
pub type Parameter = Box<dyn Fn([f64; 2]) -> f64 + Sync + Send>;

/// What is known of a scene.
pub enum Answer {
    /// λ along a parameter. The seam ends smoothly. If `centred`, where the middle of contact lies is not asked.
    Pressure { profile: Profile, parameter: Parameter, centred: bool },
    /// The force to a tolerance, and the x of its middle, with a tolerance.
    Force { force: f64, most: f64, at: Option<[f64; 2]> },
    /// Exit code 2, with one of these words.
    Refusal(&'static [&'static str]),
    /// It must be doubted or refused, with one of these words.
    Doubt(&'static [&'static str]),
}

/// A scene, ready to run.
pub struct Known {
    pub name: String,
    pub mesh: String,
    pub case: String,
    pub ranks: usize,
    pub answer: Answer,
}

/// How a scene ended.
pub struct Outcome {
    /// Neither a wrong pressure without a word, nor a wrong word.
    pub good: bool,
    /// Whether a scene with an answer was doubted.
    pub doubted: bool,
    pub line: String,
}

/// Most that λ may be off without a word, and the force.
const MOST: [f64; 2] = [0.05, 0.01];

/// All scenes: five or so of each kind.
pub fn all() -> Vec<Known> {
    [
        rings::all(),
        motions::shifted(),
        discs::grooves(),
        discs::loose(),
        refused::pieces(),
        refused::pairs(),
        refused::strains(),
        bands::all(),
        bands::leaves(),
    ]
    .into_iter()
    .flatten()
    .collect()
}

impl Known {
    /// Runs it; case and mesh stay under `target/scenes`.
    pub fn end(&self) -> Outcome {
        let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).with_file_name("scenes").join(self.name.replace([' ', ','], "_"));
        std::fs::create_dir_all(&folder).expect("a folder");
        let file = write_scene(&folder, &self.mesh, &self.case);
        let plain: Parameter = Box::new(|[x, _]| x);
        let parameter = if let Answer::Pressure { parameter, .. } = &self.answer { parameter } else { &plain };
        let said = run(&file, self.ranks, parameter);
        let (good, figures) = self.judge(&said);
        let quiet = is_quiet(&said);
        let words = if quiet { "" } else { said.reason.trim() };
        let warnings = said.warnings.join(" ");
        let line = format!(
            "{} {:42} ranks {} exit {} trust {:5} {figures} | {} {}",
            if good { " " } else { "!" },
            self.name,
            self.ranks,
            said.code.map_or("-".to_string(), |code| code.to_string()),
            said.trust.map_or("null".to_string(), |trust| trust.to_string()),
            words.replace('\n', " "),
            if words.contains(&warnings) { "" } else { &warnings },
        );
        Outcome { good, doubted: !quiet && !matches!(self.answer, Answer::Doubt(_) | Answer::Refusal(_)), line }
    }

    /// Whether it ended well, with its errors in words.
    fn judge(&self, said: &Said) -> (bool, String) {
        let quiet = is_quiet(said);
        match &self.answer {
            Answer::Doubt(words) | Answer::Refusal(words) => {
                let all = format!("{} {}", said.reason, said.warnings.join(" "));
                let told = words.iter().any(|words| all.contains(words));
                let refused = said.code == Some(2) || matches!(self.answer, Answer::Doubt(_));
                (
                    !quiet && told && refused,
                    if quiet {
                        "no word"
                    } else if told {
                        ""
                    } else {
                        "another word"
                    }
                    .into(),
                )
            }
            Answer::Force { force, most, at } => {
                let error = said.profile.as_ref().map_or(f64::INFINITY, |own| (own.force / force - 1.0).abs());
                let centre = said.profile.as_ref().map_or(f64::NAN, Profile::centre);
                let right = error <= *most && at.is_none_or(|[at, most]| (centre - at).abs() <= most);
                (!quiet || right, format!("force {error:.1e} at {centre:.3}"))
            }
            Answer::Pressure { profile, centred, .. } => {
                let apart = said.profile.as_ref().map(|own| {
                    let by = if *centred { own.centre() - profile.centre() } else { 0.0 };
                    own.moved(-by).apart(profile, [f64::NEG_INFINITY, f64::INFINITY], [true; 2])
                });
                let Apart { mean, peak, part, force, .. } =
                    apart.unwrap_or(Apart { mean: f64::INFINITY, peak: f64::INFINITY, ..Apart::default() });
                let right = mean.max(peak).max(part) <= MOST[0] && force <= MOST[1];
                (!quiet || right, format!("λ {mean:.1e} peak {peak:.1e} part {part:.1e} force {force:.1e}"))
            }
        }
    }
}

/// A profile from a formula between two parameters, one unit of which is so long.
pub fn sampled(from: f64, to: f64, length: f64, lambda: impl Fn(f64) -> f64) -> Profile {
    const COUNT: usize = 4000;
    let points: Vec<[f64; 2]> =
        (0..=COUNT).map(|k| from + (to - from) * k as f64 / COUNT as f64).map(|u| [u, lambda(u)]).collect();
    let force = points.windows(2).map(|pair| 0.5 * (pair[0][1] + pair[1][1]) * (pair[1][0] - pair[0][0])).sum::<f64>() * length;
    Profile::new(points, force)
}
