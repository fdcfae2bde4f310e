//! Bodies of several materials, and plane stress: exact solutions, jumps of stress, iterations, meshes that adapt.

use crate::support::mesh::write_scene;
use crate::support::{Ended, RANKS, Run, difference};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use std::path::Path;

const CASES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/cases");

/// The numbers of an array of a file of VTK's.
fn array(file: &Path, name: &str) -> Vec<f64> {
    let text = std::fs::read_to_string(file).expect("a file of fields");
    let (head, after) = text.split_once(&format!("Name=\"{name}\"")).expect("the array");
    let is_whole = head.rsplit_once('<').is_some_and(|(_, tag)| tag.contains("Int32"));
    let bytes = STANDARD.decode(after.lines().nth(1).expect("its numbers")).expect("base64");
    match is_whole {
        true => bytes[8..].as_chunks::<4>().0.iter().map(|bytes| f64::from(i32::from_le_bytes(*bytes))).collect(),
        false => bytes[8..].as_chunks::<8>().0.iter().map(|bytes| f64::from_le_bytes(*bytes)).collect(),
    }
}

/// `ux = 0` on both sides: σ_xx is -ν/(1 - ν) in each layer, and σ_yy = -1 goes through all.
#[test]
fn stress_jumps_between_two_materials_in_fields_and_probes() {
    let ended = Run::case("patch_layers")
        .set("mesh.refine", 1)
        .set("probe.below", "{ point = [1, 0.7], body = \"core\" }")
        .set("probe.above", "{ point = [1, 0.7], body = \"layer\" }")
        .converged();
    let wanted = |nu: f64| -nu / (1.0 - nu);
    for (probe, nu) in [("below", 0.227), ("above", 0.4)] {
        let found = [0, 1].map(|k| ended.number(&format!("/probe/{probe}/stress/{k}")));
        assert!(difference(&found, &[wanted(nu), -1.0]) < 1e-9, "{probe}: {found:?}");
    }
    let strains = ["core", "layer"].map(|part| ended.number(&format!("/energy/parts/{part}")));
    assert!((strains[0] + strains[1] - ended.number("/energy/strain/coated")).abs() < 1e-12 * strains[1]);
    let folder = ended.into_folder();
    let file = folder.path().join("result/fields.vtu");
    let (stress, cells, parts) = (array(&file, "stress"), array(&file, "connectivity"), array(&file, "part"));
    let nodes = cells.len() / parts.len();
    for (part, own) in parts.iter().zip(cells.chunks(nodes)) {
        let nu = [0.227, 0.4, 0.3][*part as usize];
        for &node in own {
            let s = &stress[4 * node as usize..][..4];
            let wanted = [wanted(nu), -1.0, 0.0, wanted(nu)];
            assert!(difference(s, &wanted) < 1e-9, "part {part}: {s:?} instead of {wanted:?}");
        }
    }
}

/// Errors of the stress in the energy norm, of all regions.
fn energy_norms(ended: &Ended, regions: &[&str]) -> Vec<f64> {
    regions.iter().map(|region| ended.number(&format!("/errors/energy_norm_{region}"))).collect()
}

#[test]
fn lame_keeps_its_order_across_materials_and_in_plane_stress() {
    for (case, regions) in [("rings_bonded", &["core", "shell", "outer"][..]), ("rings_sheet", &["inner", "outer"])] {
        for (order, least) in [(1, 0.93), (2, 1.85)] {
            let errors = [1, 2].map(|refine| {
                let run = Run::case(case).set("mesh.order", order).set("mesh.refine", refine).set("output.fields", false);
                energy_norms(&run.set("exact.must_hold", false).converged(), regions)
            });
            for (coarse, fine) in errors[0].iter().zip(&errors[1]) {
                let rate = (coarse / fine).log2();
                assert!(rate > least, "{case}, P{order}: {errors:?}, order {rate:.2}");
            }
        }
    }
}

/// A thousand times softer and harder than the ring around it, on one rank and on several.
#[test]
fn unlike_materials_take_few_iterations_and_all_ranks_agree() {
    for young in [20.0, 2e7] {
        let found = RANKS.map(|ranks| {
            let run = Run::case("rings_bonded").ranks(ranks).set("mesh.refine", 2).set("output.fields", false);
            let run = run.set("exact.must_hold", false).set("solver.tolerance", "1e-11");
            let ended = run.set("body.inner.part.core.young", young).converged();
            assert!(ended.iterations() <= 20, "E = {young}, {ranks} ranks: {} iterations", ended.iterations());
            ["force", "pressure_max"].map(|value| ended.number(&format!("/contact/seam/{value}")))
        });
        assert!(found.iter().all(|other| difference(other, &found[0]) < 1e-8), "{found:?}");
    }
}

/// Γ_C lies over two columns, one a thousand times as stiff as the other, on both sides: each is pressed by itself.
#[test]
fn a_contact_over_two_materials_takes_few_iterations() {
    for ranks in [1, 3] {
        let ended = Run::case("patch_columns").ranks(ranks).set("output.fields", false).converged();
        assert!(ended.iterations() <= 20, "{ranks} ranks: {} iterations", ended.iterations());
    }
}

#[test]
fn the_mesh_adapts_to_both_materials_and_keeps_their_names() {
    let run = Run::case("rings_bonded").set("accuracy", 2e-3).set("mesh.refine", 0).set("exact.must_hold", false);
    let ended = run.ranks(2).converged();
    let true_error = energy_norms(&ended, &["core", "shell", "outer"]).into_iter().fold(0.0, f64::max);
    assert!(true_error < 8e-3, "{true_error}");
    let folder = ended.into_folder();
    let adapted = folder.path().join("result/adapted.msh");
    let again = Run::case("rings_bonded").set("mesh.file", format!("\"{}\"", adapted.display())).set("mesh.refine", 0);
    again.set("exact.must_hold", false).set("output.fields", false).converged();
}

/// Plane stress is plane strain with E (1 + 2ν)/(1 + ν)² and ν/(1 + ν), but for what it says across the plane.
#[test]
fn plane_stress_is_plane_strain_of_other_constants() {
    let run = || Run::case("patch_flat").set("mesh.refine", 1).set("solver.tolerance", "1e-12").set("exact.must_hold", false);
    let probed = |run: Run| {
        let ended = run.set("probe.p", "{ point = [1.9, 1.9], body = \"upper\" }").converged();
        let folder_values: Vec<f64> = (0..2).map(|k| ended.number(&format!("/probe/p/u/{k}"))).collect();
        (folder_values, ended.into_folder())
    };
    let other = |young: f64, nu: f64| (young * (1.0 + 2.0 * nu) / (1.0 + nu).powi(2), nu / (1.0 + nu));
    let ([e1, n1], [e2, n2]) = (other(7000.0, 0.227).into(), other(3000.0, 0.3).into());
    let (strain, _) = probed(
        run().set("body.lower.young", e1).set("body.lower.poisson", n1).set("body.upper.young", e2).set("body.upper.poisson", n2),
    );
    let (all, folder) = probed(run().set("plane", "stress"));
    let (each, _) = probed(run().set("body.lower.plane", "stress").set("body.upper.plane", "stress"));
    let (own, _) = probed(run().set("plane", "stress").set("body.lower.plane", "strain").set("body.upper.plane", "strain"));
    let (plain, _) = probed(run());
    assert!(difference(&all, &strain) < 1e-9 && difference(&each, &strain) < 1e-9, "{all:?} {each:?} {strain:?}");
    assert!(difference(&own, &plain) < 1e-9 && difference(&own, &strain) > 1e-2, "a body's own word wins");
    let file = folder.path().join("result/fields.vtu");
    let (stress, mises) = (array(&file, "stress"), array(&file, "von_mises"));
    assert!(stress.chunks(4).all(|s| s[3] == 0.0), "nothing acts across the plane");
    assert!(mises.iter().all(|mises| (mises - 1.0).abs() < 1e-9), "pressed by 1 along y alone");
}

/// Bad inputs by `mezha check`, each with exit code 2 and these words.
#[test]
fn mistakes_are_told_with_key_and_remedy() {
    let case = std::fs::read_to_string(Path::new(CASES).join("patch_layers/case.toml")).expect("the case");
    let (case, _) = case.split_once("[exact]").expect("what is expected");
    let case = case.replace("layers.msh", &format!("{CASES}/patch_layers/layers.msh"));
    let layer = "[body.coated.part.layer]\nyoung   = 70.0\npoisson = 0.4\n";
    let table: [(&str, &str, &[&str]); 14] = [
        (layer, "[body.layer]\nyoung = 70\npoisson = 0.4\n", &["share the node", "[body.NAME.part."]),
        (
            layer,
            "[body.coated.part.layr]\nyoung = 70\npoisson = 0.4\n",
            &["body.coated.part.layr", "\"layr\"", "did you mean \"layer\"?"],
        ),
        (layer, "[body.coated.part.layer]\nyoung = 70\n", &["body.coated.part.layer.poisson: missing", "write poisson"]),
        (layer, &format!("{layer}[body.coated]\nyoung = 70\n"), &["body.coated.young = 70", "stands beside parts"]),
        (
            layer,
            &format!("{layer}[body.cap.part.layer]\nyoung = 70\npoisson = 0.4\n"),
            &["body.cap.young", "stands beside parts"],
        ),
        (
            layer,
            &format!("{layer}[body.more.part.layer]\nyoung = 70\npoisson = 0.4\n"),
            &["body.coated.part.layer", "body.more has this name too"],
        ),
        (
            layer,
            &format!("{layer}[body.coated.part.coated]\nyoung = 70\npoisson = 0.4\n"),
            &["body.coated.part.coated", "the name of its body"],
        ),
        (layer, "[body.empty.part]\n", &["body.empty.part", "names no part"]),
        (layer, &format!("{layer}plane = \"stress\"\n"), &["body.coated.part.layer.plane", "unknown key"]),
        ("poisson = 0.4", "poisson = 0.5", &["body.coated.part.layer.poisson = 0.5", "take 0.49"]),
        ("title", "plane = \"sress\"\ntitle", &["plane = \"sress\"", "\"strain\" or \"stress\""]),
        ("on = \"sides\"", "on = \"between\"", &["support.walls.on", "between two parts", "only [geometry]"]),
        (
            "[support.table]",
            "[probe.p]\npoint = [1, 0.7]\nbody = \"coated\"\n[support.table]",
            &["probe.p.point", "name one of them"],
        ),
        (
            "[support.table]",
            "[probe.p]\npoint = [1, 0.2]\nbody = \"layer\"\n[support.table]",
            &["probe.p.point", "outside body \"layer\""],
        ),
    ];
    for (from, to, words) in table {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let (file, text) = (folder.path().join("case.toml"), case.replacen(from, to, 1));
        assert_ne!(text, case, "the case has no `{from}`");
        std::fs::write(&file, text).expect("a case");
        let (code, _, errors) = crate::support::mezha(None, &["check", file.to_str().expect("a path")]);
        assert_eq!(code, Some(2), "{to}: {errors}");
        assert!(words.iter().all(|word| errors.contains(word)), "{words:?} not in:\n{errors}");
    }
}

/// Parts that touch without common nodes would come apart: the blocks of the flat patch test as parts of one body.
#[test]
fn parts_that_touch_must_share_nodes() {
    let constants = "young = 1\npoisson = 0.3\n";
    let text = format!(
        "mesh.file = \"{CASES}/patch_flat/blocks.msh\"\n[body.whole.part.lower]\n{constants}[body.whole.part.upper]\n{constants}"
    );
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = folder.path().join("case.toml");
    std::fs::write(&file, text).expect("a case");
    let (code, _, errors) = crate::support::mezha(None, &["check", file.to_str().expect("a path")]);
    assert_eq!(code, Some(2), "{errors}");
    assert!(["\"lower\" and \"upper\"", "share no nodes", "Coherence"].iter().all(|word| errors.contains(word)), "{errors}");
}

/// A block of two materials on a base.
const ACROSS: &str = r#"
mesh = { file = "mesh.msh", order = 2 }
body.blk.part = { a = { young = 100, poisson = 0.3 }, b = { young = 150, poisson = 0.3 } }
body.base = { young = 120, poisson = 0.25 }
support.walls = { on = ["bb", "l", "r", "bl", "br"], normal = 0 }
support.top = { on = ["t1", "t2"], ux = 0, uy = -0.01 }
contact.seam = { between = ["bt", ["b1", "b2"]] }
"#;

/// The same block under a load instead.
const PRESSED: &str = "load.top = { on = [\"t1\", \"t2\"], pressure = \"exp(0.5*x)\" }";

/// The pressure grows like a weak power of the distance from the edge between the two materials, .77 to .91 within four meshes. It was
/// "reached to 5e-2".
#[test]
fn a_pressure_without_bound_where_materials_meet_is_told() {
    let mesh = include_str!("meshes/two_materials.msh");
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = write_scene(folder.path(), mesh, ACROSS);
    for ranks in [1, 2] {
        let ended = Run::file(&file).set("accuracy.peak", 0.05).ranks(ranks).ended();
        assert_eq!(ended.code, Some(3), "{}", ended.said());
        assert!(ended.said().contains("where materials meet, or at a corner of a side: it has no value"), "{}", ended.said());
        let place = [0, 1].map(|axis| ended.number(&format!("/contact/seam/zones/0/singular_at/{axis}")));
        assert!((place[0] - 1.0).abs() < 1e-3 && place[1].abs() < 1e-2, "{place:?}");
        let verdict = ended.value("/contact/seam/verdict").to_string();
        assert!(verdict.contains("λ grows without bound at (1"), "{verdict}");
    }
    // One material, and one in all but name, cold or warm.
    let warm = "{ young = 100, poisson = 0.3, expansion = 1e-4, temperature = \"10*x\" }";
    let cold = "{ young = 100.1, poisson = 0.3 }";
    for parts in [[warm, warm], ["{ young = 100, poisson = 0.3 }", cold]] {
        let run = Run::file(&file).set("body.blk.part", format!("{{ a = {}, b = {} }}", parts[0], parts[1]));
        let alike = run.set("accuracy.peak", 0.05).converged();
        assert_eq!(alike.value("/contact/seam/zones/0/singular"), false);
    }
}

/// A soft part touches the contact with its tip alone, so that both edges of the contact beside it are of one material: λ is 1.08 on the
/// first meshes, which agree, and 3.8 on the seventh refinement.
#[test]
fn a_part_that_touches_a_contact_with_its_tip_is_seen() {
    let mesh = include_str!("meshes/tip_of_a_part.msh");
    let case = r#"
mesh = { file = "mesh.msh", order = 2 }
body.blk.part = { in = { young = 100, poisson = 0.3 }, out = { young = 5000, poisson = 0.3 } }
body.base = { young = 3000, poisson = 0.3 }
support.walls = { on = ["l", "r", "bl", "br", "bb"], normal = 0 }
load.top = { on = "t", pressure = 1 }
contact.seam = { between = ["bt", "b"] }
accuracy = { peak = 0.03, max_unknowns = 60000 }
"#;
    let folder = tempfile::tempdir().expect("a temporary folder");
    let ended = Run::file(&write_scene(folder.path(), mesh, case)).ended();
    assert_eq!(ended.code, Some(3), "{}", ended.said());
    assert!(ended.number("/contact/seam/pressure_max") > 2.0, "the meshes have found it: {}", ended.said());
}

/// A steep and convex pressure that goes smoothly over the edge between two materials which are nearly alike: it has a largest value.
#[test]
fn a_smooth_pressure_across_materials_has_a_largest_value() {
    let pressed = ACROSS.replace("support.top = { on = [\"t1\", \"t2\"], ux = 0, uy = -0.01 }", PRESSED);
    assert_ne!(pressed, ACROSS);
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = write_scene(folder.path(), include_str!("meshes/two_materials.msh"), &pressed);
    let ended = Run::file(&file).set("body.blk.part.b.young", 102).set("accuracy.peak", 0.05).converged();
    assert_eq!(ended.value("/contact/seam/zones/0/singular"), false);
    let largest = ended.number("/contact/seam/pressure_max");
    assert!((largest / 2.209 - 1.0).abs() < 0.05, "{largest}");
}

/// What is left of λ in the middle of a zone across both materials, by λ on a mesh for a tenth of it: 1.16e-2 for 1e-2 where the
/// smaller sign of an error was taken.
#[test]
fn a_pressure_across_two_materials_is_as_exact_as_asked() {
    let run = |asked: f64| {
        let mesh = include_str!("meshes/two_materials.msh");
        let folder = tempfile::tempdir().expect("a temporary folder");
        let file = write_scene(folder.path(), mesh, ACROSS);
        let ended = Run::file(&file).set("accuracy.pressure", asked).converged();
        ended.trace("seam").iter().map(|point| [point.s, point.lambda]).collect::<Vec<_>>()
    };
    let [fine, asked] = [1e-3, 1e-2].map(run);
    let at = |pressures: &[[f64; 2]], s: f64| {
        let behind = pressures.partition_point(|[arc, _]| *arc <= s).clamp(1, pressures.len() - 1);
        let [[a, p], [b, q]] = [pressures[behind - 1], pressures[behind]];
        if b > a { p + (q - p) * (s - a) / (b - a) } else { q }
    };
    let sums = (0..4000).map(|k| 0.4 + 1.2 * (f64::from(k) + 0.5) / 4000.0).fold([0.0; 2], |[off, whole], s| {
        let exact = at(&fine, s);
        [off + (at(&asked, s) - exact).powi(2), whole + exact * exact]
    });
    let error = (sums[0] / sums[1]).sqrt();
    assert!((1e-3..1e-2).contains(&error), "{error}");
}

/// A rigid cylinder presses on both materials at once, and λ jumps where they meet. The estimate of its error stood at 1.2 on every mesh,
/// since a tool was taken for a body without stress.
#[test]
fn a_jump_of_the_pressure_under_a_rigid_tool_is_followed() {
    let case = r#"
mesh = { file = "mesh.msh", order = 2 }
body.blk.part = { a = { young = 1000, poisson = 0.3 }, b = { young = 100, poisson = 0.3 } }
body.base = { young = 120, poisson = 0.25 }
support.top = { on = ["t1", "t2"], ux = 0, uy = 0 }
support.base = { on = ["bb", "bt"], ux = 0, uy = 0 }
rigid.roller = { circle = { centre = [1.0, -3.0], radius = 3.0 }, ux = 0.0, force = [0.0, 2.0] }
contact.seam = { between = [["b1", "b2"], "rigid.roller"] }
accuracy = { pressure = 0.03, max_unknowns = 60000 }
output.fields = false
"#;
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = write_scene(folder.path(), include_str!("meshes/two_materials.msh"), case);
    for ranks in [1, 2] {
        let ended = Run::file(&file).ranks(ranks).converged();
        assert!(ended.number("/contact/seam/zones/0/lambda") < 0.03, "{}", ended.said());
        let trace = ended.trace("seam");
        let at = |x: f64| trace.iter().min_by(|a, b| (a.x[0] - x).abs().total_cmp(&(b.x[0] - x).abs())).expect("a trace").lambda;
        assert!(at(0.98) > 2.0 * at(1.02), "{} and {}", at(0.98), at(1.02));
    }
}
