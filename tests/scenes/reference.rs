//! What is true of a scene: its own finest runs, kept under `target/scenes`.

use crate::layers::{Layers, Peak};
use crate::profile::Profile;
use crate::run::{Folder, solve};
use crate::scene::{Gap, Scene, Settings};
use serde::{Deserialize, Serialize};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::PathBuf;

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

/// A mesh as fine on both sides, finer where contact may be narrow and at the bodies' ends; P2.
fn finest(scene: &Scene, refine: usize, seed: u64) -> Settings {
    let length = scene.bodies[0].seam.length();
    let layers = [0, 1].map(|k| {
        let body = &scene.bodies[k];
        let [a, b] = body.range;
        let own = b - a;
        let mut peaks: Vec<Peak> = scene.focus.clone();
        let ends = scene.ends();
        for end in [0, 1].into_iter().filter(|end| !scene.smooth_end(*end)) {
            peaks.push(Peak { at: ends[end], reach: 0.0, edge: 1.0 / 500.0 });
        }
        for peak in &mut peaks {
            *peak = Peak { at: (peak.at - a) / own, reach: peak.reach / own, edge: peak.edge / own };
        }
        let edge = (if k == 0 { 1.0 / 40.0 } else { 1.0 / 44.0 }) / own;
        Layers { peaks, ..Layers { edge, ..Layers::even(40, body.depth / (length * own), 0.1, seed + k as u64) } }
    });
    let straight = scene.bodies.iter().all(|body| body.seam.is_line());
    let measured = matches!(scene.gap, Gap::Drawn);
    let curve = if measured { "fit" } else if straight { "line" } else { "geometry" };
    Settings {
        order: 2,
        refine,
        space: "p1-discontinuous",
        segments: None,
        curve,
        deformed: measured,
        swapped: false,
        ranks: 1,
        layers,
    }
}

/// The truth of a scene, from the last time or from new runs.
pub fn truth(scene: &Scene, seed: u64) -> Truth {
    let mut hasher = DefaultHasher::new();
    let coarse = finest(scene, 1, seed);
    (scene.case(&coarse), scene.mesh(&coarse.layers)).hash(&mut hasher);
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).with_file_name("scenes");
    std::fs::create_dir_all(&folder).expect("target/scenes can be made");
    let file = folder.join(format!("{seed}-{:016x}.json", hasher.finish()));
    if let Some(truth) = std::fs::read_to_string(&file).ok().and_then(|text| serde_json::from_str(&text).ok()) {
        return truth;
    }
    let truth = converge(scene, seed);
    std::fs::write(&file, serde_json::to_string(&truth).expect("JSON")).expect("target/scenes can be written");
    truth
}

fn converge(scene: &Scene, seed: u64) -> Truth {
    let mut last: Option<Profile> = None;
    let mut words = String::new();
    for refine in 1..=3 {
        let settings = finest(scene, refine, seed);
        let ended = solve(scene, &settings, &Folder::Lost);
        let Some(found) = ended.profile.filter(|_| ended.code == Some(0)) else {
            words = format!("refine {refine}: exit {:?}, {}", ended.code, ended.reason);
            if ended.reason.contains("can move") {
                break;
            }
            continue;
        };
        if found.force == 0.0 {
            return Truth::Unknown("nothing presses".into());
        }
        if let Some(last) = &last {
            let apart = last.apart(&found, scene.ends(), [scene.smooth_end(0), scene.smooth_end(1)]);
            if apart.lambda().max(apart.force) < AGREED {
                return Truth::Known(found);
            }
            words = format!("refine {refine} and the one before are {:.3} apart", apart.lambda().max(apart.force));
        }
        last = Some(found);
    }
    Truth::Unknown(words)
}
