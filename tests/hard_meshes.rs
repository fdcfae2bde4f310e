//! Accuracy on request from meshes that nobody should draw: slivers, bodies with edges of 20 : 1, next to stiff, incompressible and
//! slender ones. Each gets the error that is asked for, or the verdict says why not.

use crate::support::Run;
use crate::support::mesh::{Block, GOOD, Mesh, grid, write_scene};
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// Two bars that meet on the line from (0, 3) to (6, 2).
fn bars(lower: Block, upper: Block) -> Mesh {
    Mesh {
        bodies: vec![("lower", lower, ["bottom", "", "lower.seam", "left"]), ("upper", upper, ["upper.seam", "", "top", "left"])],
    }
}

fn seam(x: f64) -> f64 {
    3.0 - x / 6.0
}

/// The bar below the line, down to y = 0, in `nx` × `ny` quadrangles, with rows at `rise(v)` of its height.
fn lower(nx: usize, ny: usize, rise: fn(f64) -> f64) -> Block {
    grid(nx, ny, 1, |u, v| [6.0 * u, rise(v) * seam(6.0 * u)])
}

/// The same above the line, `height` high or up to y = 6.
fn upper(nx: usize, ny: usize, rise: fn(f64) -> f64, height: Option<f64>) -> Block {
    grid(nx, ny, 2, |u, v| {
        let x = 6.0 * u;
        [x, seam(x) + rise(v) * height.unwrap_or(6.0 - seam(x))]
    })
}

fn even(v: f64) -> f64 {
    v
}

/// Three rows, of which the first and the last are a twentieth of the height: triangles of 3 degrees.
fn layers(v: f64) -> f64 {
    match v {
        v if v < 1.0 / 3.0 => 0.15 * v,
        v if v < 2.0 / 3.0 => 0.05 + 2.7 * (v - 1.0 / 3.0),
        v => 0.95 + 0.15 * (v - 2.0 / 3.0),
    }
}

/// The case of two bars, E = 7000 and ν = 0.227 unless `settings` say otherwise, in a folder of its own.
fn scene(mesh: &Mesh) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = write_scene(folder.path(), &mesh.text(), GOOD);
    (folder, file)
}

fn run(file: &Path, settings: &[(&str, &str)]) -> Run {
    let same = [("body.upper.young", "7000.0"), ("body.upper.poisson", "0.227"), ("output.fields", "false")];
    same.iter().chain(settings).fold(Run::file(file), |run, (key, value)| run.set(key, value))
}

/// Name, mesh, settings beside those of [`run`], strain energy.
type Scene<'a> = (&'a str, Mesh, &'a [(&'a str, &'a str)], f64);

/// Strain energies are those of runs with estimated errors of 2e-5 to 1e-4 in the energy norm, from good meshes.
#[test]
fn hard_meshes_get_the_accuracy() {
    let nearly_incompressible = [("body.lower.poisson", "0.4999"), ("body.upper.poisson", "0.4999")];
    let scenes: [Scene; 4] = [
        (
            "layers of slivers",
            bars(lower(2, 3, layers), upper(2, 3, layers, None)),
            &[("accuracy.pressure", "1e-3")],
            2.602_599_118_747_502e-3,
        ),
        (
            "edges of 1 : 16, E of 1 : 1e4",
            bars(lower(16, 8, even), upper(1, 1, even, None)),
            &[("body.upper.young", "7e7"), ("accuracy.pressure", "1e-3")],
            9.394_603_521_8e-4,
        ),
        ("nearly incompressible", bars(lower(2, 1, even), upper(2, 1, even, None)), &nearly_incompressible, 2.058_270_135e-3),
        (
            "a stiff plate of 100 : 1 in four triangles",
            bars(lower(2, 1, even), upper(2, 1, even, Some(0.06))),
            &[("body.upper.young", "7e5"), ("accuracy.pressure", "1e-3")],
            9.633_819_198_9e-4,
        ),
    ];
    for (name, mesh, settings, exact) in scenes {
        let (_folder, file) = scene(&mesh);
        let ended = run(&file, settings).set("accuracy.energy", "1e-3").set("accuracy.max_unknowns", 60_000).converged();
        let error = (ended.number("/energy/total") / exact - 1.0).abs().sqrt();
        println!("{name}: {} unknowns, energy norm off by {error:.1e}", ended.value("/unknowns/displacement"));
        assert!(error <= 1e-3, "{name}: {error:e}");
        assert_eq!(ended.errors, "", "{name}: nothing to warn of");
    }
}

/// A plate on the long edges of a block bends at their kinks; refining it alone would never end.
#[test]
fn a_fine_body_on_a_coarse_one_has_that_refined_too() {
    let (_folder, file) = scene(&bars(lower(2, 1, even), upper(2, 1, even, Some(0.06))));
    let ended = run(&file, &[]).set("accuracy", "4e-2").ranks(2).converged();
    // Of a run with an estimated error of 3e-5 in the energy norm.
    let error = (ended.number("/energy/total") / 9.876_676_76e-4 - 1.0).abs().sqrt();
    let unknowns = ended.number("/unknowns/displacement");
    println!("{unknowns} unknowns, energy norm off by {error:.1e}");
    assert!(error <= 4e-2 && unknowns <= 25_000.0, "{unknowns} unknowns: {error:e}");
}

#[test]
fn a_verdict_tells_of_slivers_that_spoil_a_mesh() {
    let (_folder, file) = scene(&bars(lower(20, 1, even), upper(20, 1, even, None)));
    let reason = |limit: u32| {
        let ended = run(&file, &[]).set("accuracy.energy", "1e-3").set("accuracy.max_unknowns", limit).ended();
        assert_eq!(ended.code, Some(3), "{}", ended.said());
        ended.value("/reason").to_string()
    };
    let words = reason(8000);
    assert!(
        words.contains(" macro triangles have angles below 10 degrees, down to ") && words.contains("draw the mesh file"),
        "{words}"
    );
}

/// Without any load nothing moves and nothing presses: that is exact, and no sequence of meshes makes it more so.
#[test]
fn what_nothing_loads_is_exact_at_once() {
    let (_folder, file) = scene(&bars(lower(2, 1, even), upper(2, 1, even, None)));
    for goals in ["{ energy = 1e-3 }", "{ force = 1e-3, pressure = 1e-3, ends = 1e-3 }"] {
        let ended = run(&file, &[]).set("load.top.pressure", "0.0").set("accuracy", goals).ranks(2).converged();
        assert_eq!(ended.value("/accuracy").as_array().map(Vec::len), Some(1), "{goals}");
        let reason = ended.value("/reason").to_string();
        assert!(
            reason.contains("nothing loads, moves or presses the bodies") && reason.contains("nothing presses on contact seam"),
            "{reason}"
        );
    }
}
