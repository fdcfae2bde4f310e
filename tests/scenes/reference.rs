//! What is true of a scene: its own finest runs, kept under `target/scenes`.

use crate::layers::{Layers, Peak};
use crate::profile::{Profile, Zone};
use crate::run::{Said, solve};
use crate::scene::{Gap, Scene, Settings};
use serde::{Deserialize, Serialize};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};

/// The finest pressure of a scene.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub enum Truth {
    /// The last two meshes agree.
    Known(Profile),
    /// No two meshes agree, or no run converges: in words.
    Unknown(String),
}

/// Two meshes agree in every zone's mean square, peak and force.
const AGREED: f64 = 0.01;

/// A mesh as fine on both sides, finer about these places and at the bodies' ends; P2.
fn finest(scene: &Scene, focus: &[Peak], refine: usize, seed: u64) -> Settings {
    let length = scene.bodies[0].seam.length();
    let layers = [0, 1].map(|k| {
        let body = &scene.bodies[k];
        let [a, b] = body.range;
        let own = b - a;
        let mut peaks: Vec<Peak> = focus.to_vec();
        let ends = scene.ends();
        for end in [0, 1].into_iter().filter(|end| !scene.smooth_end(*end)) {
            peaks.push(Peak { at: ends[end], reach: 0.0, edge: 1.0 / 120.0 });
        }
        for peak in &mut peaks {
            *peak = Peak { at: (peak.at - a) / own, reach: peak.reach / own, edge: peak.edge / own };
        }
        // A curved edge must not reach through the row of triangles below it.
        let across = if body.seam.is_line() { 1.0 } else { 3.0 };
        let edge = (if k == 0 { 1.0 / 12.0 } else { 1.0 / 13.0 }) / (own * across);
        Layers { peaks, edge, ..Layers::even(20, body.depth / (length * own), 0.1, seed + k as u64) }
    });
    let straight = scene.bodies.iter().all(|body| body.seam.is_line());
    let measured = matches!(scene.gap, Gap::Drawn);
    let curve = match (measured, straight) {
        (true, _) => "fit",
        (_, true) => "line",
        _ => "geometry",
    };
    Settings {
        order: 2,
        refine,
        space: "p1-continuous",
        segments: None,
        curve,
        deformed: measured,
        swapped: false,
        ranks: 1,
        layers,
    }
}

/// The truth of a scene, from the last time or from new runs; their cases stay beside it.
pub fn truth(scene: &Scene, seed: u64) -> Truth {
    let smooth = [scene.smooth_end(0), scene.smooth_end(1)];
    let flat = scene.flattened();
    let scene = flat.as_ref().unwrap_or(scene);
    kept(scene, smooth, seed, &folder(seed), |settings| scene.case(settings), |settings, folder| solve(scene, settings, folder))
}

/// The same with cases and runs of another kind of scene, in a folder.
pub fn kept(
    scene: &Scene,
    smooth: [bool; 2],
    seed: u64,
    folder: &Path,
    case: impl Fn(&Settings) -> String,
    solve: impl Fn(&Settings, &Path) -> Said,
) -> Truth {
    let mut hasher = DefaultHasher::new();
    let first = finest(scene, &scene.focus, 1, seed);
    (case(&first), scene.mesh(&first.layers)).hash(&mut hasher);
    std::fs::create_dir_all(folder).expect("a folder in target can be made");
    let file = folder.join(format!("truth-{:016x}.json", hasher.finish()));
    if let Some(truth) = std::fs::read_to_string(&file).ok().and_then(|text| serde_json::from_str(&text).ok()) {
        return truth;
    }
    let reference = |settings: &Settings, name: &str| pressure(solve(settings, &folder.join(name)), name);
    let truth = converge(scene, smooth, seed, reference);
    std::fs::write(&file, serde_json::to_string(&truth).expect("JSON")).expect("target/scenes can be written");
    truth
}

/// Where everything of a scene is kept.
pub fn folder(seed: u64) -> PathBuf {
    PathBuf::from(env!("CARGO_TARGET_TMPDIR")).with_file_name("scenes").join(seed.to_string())
}

/// A pressure that converged, or words why there is none.
fn pressure(said: Said, name: &str) -> Result<Profile, String> {
    let converged = said.code == Some(0);
    let profile = said.profile.filter(|_| converged);
    profile.ok_or_else(|| format!("{name}: exit {:?}, {}", said.code, said.reason.trim()))
}

/// A first run tells where the bodies press; meshes that are fine there follow until two agree.
fn converge(
    scene: &Scene,
    smooth: [bool; 2],
    seed: u64,
    reference: impl Fn(&Settings, &str) -> Result<Profile, String>,
) -> Truth {
    let first = match reference(&finest(scene, &scene.focus, 1, seed), "first") {
        Ok(first) if first.force == 0.0 => return Truth::Unknown("nothing presses".into()),
        Ok(first) => Some(first),
        Err(words) if words.contains("can move") => return Truth::Unknown(words),
        Err(_) => None,
    };
    let near = |zone: &Zone| {
        let width = zone.to - zone.from;
        Peak { at: 0.5 * (zone.from + zone.to), reach: 0.6 * width, edge: width / 14.0 }
    };
    let focus = first.map_or_else(|| scene.focus.clone(), |first| first.zones().iter().map(near).collect());
    let (mut last, mut words): (Option<Profile>, _) = (None, String::new());
    for refine in 1..=3 {
        match reference(&finest(scene, &focus, refine, seed), &format!("finest-{refine}")) {
            Ok(found) => {
                if let Some(last) = &last {
                    let apart = last.apart(&found, scene.ends(), smooth);
                    if apart.lambda().max(apart.force) < AGREED {
                        return Truth::Known(found);
                    }
                    words = format!("refine {refine} and the one before are {apart:.3?} apart");
                }
                last = Some(found);
            }
            Err(error) => words = error,
        }
    }
    Truth::Unknown(words)
}
