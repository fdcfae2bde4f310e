//! Accuracy on order: two bars of eight triangles get the error that is asked for, on the same meshes on any number of ranks.

mod support;

use std::path::PathBuf;
use support::mesh::{Block, Mesh, write_scene};
use support::{Ended, RANKS, Run};
use tempfile::TempDir;

/// Strain energy of the bars below.
const ENERGY: f64 = 2.602_599_118_747_502e-3;

const CASE: &str = r#"
mesh.file = "mesh.msh"
body.lower = { young = 7000.0, poisson = 0.227 }
body.upper = { young = 7000.0, poisson = 0.227 }
support.table = { on = "bottom", uy = 0.0 }
support.wall = { on = "left", ux = 0.0 }
load.top = { on = "top", pressure = 1.0 }
contact.seam = { between = ["lower.seam", "upper.seam"], curve = "line", gap = "closed" }
output.fields = false
"#;

/// A bar over 0 ≤ x ≤ 6 between two lines, in four triangles.
fn bar(bottom: [f64; 2], top: [f64; 2]) -> Block {
    let row = |[left, right]: [f64; 2]| [[0.0, left], [3.0, 0.5 * (left + right)], [6.0, right]];
    Block {
        points: [row(bottom), row(top)].concat(),
        triangles: vec![[0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4]],
        sides: [vec![[0, 1], [1, 2]], vec![[2, 5]], vec![[5, 4], [4, 3]], vec![[3, 0]]],
    }
}

/// The case of two bars that slide on the line from (0, 3) to (6, 2), in a folder of its own.
fn bars() -> (TempDir, PathBuf) {
    let seam = [3.0, 2.0];
    let mesh = Mesh {
        bodies: vec![
            ("lower", bar([0.0; 2], seam), ["bottom", "", "lower.seam", "left"]),
            ("upper", bar(seam, [6.0; 2]), ["upper.seam", "", "top", "left"]),
        ],
    };
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = write_scene(folder.path(), &mesh.text(), CASE);
    (folder, file)
}

/// Macro triangles and unknowns of every mesh.
fn sizes(ended: &Ended) -> Vec<[u64; 2]> {
    let steps = ended.value("/accuracy").as_array().expect("a list of steps").clone();
    let count = |step: &serde_json::Value, key: &str| step[key].as_u64().expect("a count");
    steps.iter().map(|step| ["macro_triangles", "unknowns"].map(|key| count(step, key))).collect()
}

/// The estimated error of a goal on the last mesh.
fn last_estimate(ended: &Ended, goal: &str) -> f64 {
    ended.number(&format!("/accuracy/{}/{goal}/estimate", sizes(ended).len() - 1))
}

fn energy(ended: &Ended) -> f64 {
    ended.number("/energy/total")
}

/// No more than what is asked for, and no hundredth of it: the error of U is the square of that in the energy norm.
#[test]
fn bars_get_the_accuracy_on_the_same_meshes_on_all_ranks() {
    let (_folder, file) = bars();
    let runs = RANKS.map(|ranks| Run::file(&file).ranks(ranks).set("accuracy", "1e-3").converged());
    for (run, ranks) in runs.iter().zip(RANKS) {
        let (sizes, error, estimate) = (sizes(run), (energy(run) / ENERGY - 1.0).abs(), last_estimate(run, "energy"));
        println!("{ranks} ranks: {sizes:?}, U off by {error:.2e}, estimate {estimate:.2e}");
        assert!((1e-8..=1e-6).contains(&error), "{ranks} ranks: U off by {error:e}");
        assert!(estimate <= 1e-3, "{ranks} ranks: estimate {estimate:e}");
        let effectivity = estimate / error.sqrt();
        assert!((0.7..=1.5).contains(&effectivity), "{ranks} ranks: estimate {effectivity} times the error");
        assert_eq!(sizes[0][0], 8, "the mesh of the file is the first");
        assert!(sizes.last().is_some_and(|[_, unknowns]| *unknowns <= 16_000), "{ranks} ranks: {sizes:?}");
        assert_eq!(sizes, self::sizes(&runs[0]), "{ranks} ranks");
        let off = (energy(run) / energy(&runs[0]) - 1.0).abs();
        assert!(off <= 1e-7, "{ranks} ranks: U is off by {off:e} from that of 1 rank");
    }
}

#[test]
fn a_run_that_begins_with_the_adapted_mesh_is_there_at_once() {
    let (_folder, file) = bars();
    let first = Run::file(&file).set("accuracy", "1e-2").converged();
    let mesh = format!("{:?}", first.out.join("adapted.msh").display().to_string());
    let second = Run::file(&file).set("mesh.file", mesh).set("accuracy", "1e-2").ranks(2).converged();
    assert_eq!(sizes(&second)[..], sizes(&first)[sizes(&first).len() - 1..], "one mesh, the last one of before");
    let off = (energy(&second) / energy(&first) - 1.0).abs();
    assert!(off <= 1e-7, "U differs by {off:e}");
}

#[test]
fn a_limit_ends_with_what_was_reached_and_what_it_would_take() {
    let (_folder, file) = bars();
    let goals = Run::file(&file).set("accuracy.energy", "1e-3").set("accuracy.force", "1e-3");
    let ended = goals.set("accuracy.max_unknowns", 4000).ended();
    assert_eq!(ended.code, Some(3), "{}", ended.said());
    assert_eq!(ended.value("/status"), "not_converged");
    let reason = ended.value("/reason").as_str().expect("words").to_owned();
    println!("{reason}");
    let in_order =
        ["the accuracy is not reached: energy to ", "(asked 1e-3, which would take some ", " 000 unknowns), force of seam to "];
    let rest = in_order.iter().try_fold(&reason[..], |rest, words| rest.split_once(words).map(|(_, rest)| rest));
    assert!(rest.is_some_and(|rest| rest.contains(" (asked 1e-3): ")), "what holds needs no more: {reason}");
    assert!(reason.contains("; the case allows 4 000 unknowns; "), "{reason}");
    assert!(last_estimate(&ended, "energy") > 1e-3 && last_estimate(&ended, "contact/seam/force") <= 1e-3);
    assert!(ended.out.join("adapted.msh").is_file(), "where a longer run can begin");
}

/// Its solution lies in the spaces, whatever the mesh: one mesh is enough, and a second one where the first cannot tell.
#[test]
fn what_is_exact_needs_no_sequence() {
    let ended = Run::case("patch_flat").set("accuracy", "1e-1").converged();
    assert!(sizes(&ended).len() <= 2, "{:?}", sizes(&ended));
    assert!(last_estimate(&ended, "energy") < 1e-6, "{}", last_estimate(&ended, "energy"));
}

#[test]
fn a_case_that_asks_for_nothing_has_no_steps() {
    let (_folder, file) = bars();
    let ended = Run::file(&file).converged();
    assert!(ended.summary().get("accuracy").is_none() && !ended.out.join("adapted.msh").exists());
    assert_eq!(ended.number("/unknowns/displacement"), 60.0, "the mesh of the file");
}
