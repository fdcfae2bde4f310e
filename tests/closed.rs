//! Contact all around closed curves: whole rings against their quarters and halves, seams anywhere, a pin loose in its hole.

use crate::support::mesh::write_scene;
use crate::support::{Ended, PAIRS, Run, difference};
use std::f64::consts::TAU;
use std::path::Path;

/// A file of the cases.
fn read(name: &str) -> String {
    std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("cases").join(name)).expect("a file of the cases")
}

/// A case of `rings_full` on another mesh, with words of it replaced; changed by `set`.
fn scene(mesh: &str, case: &str, words: &[(&str, &str)], set: impl Fn(Run) -> Run) -> Ended {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut text = read(&format!("rings_full/{case}")).replace("rings.msh", "mesh.msh");
    if mesh != "rings_full/rings.msh" {
        // Expected values are those of the whole.
        text.truncate(text.find("[exact]").expect("expected values"));
    }
    for (from, to) in words {
        assert!(text.contains(from), "the case has no `{from}`");
        text = text.replace(from, to);
    }
    let file = write_scene(folder.path(), &read(mesh), &text);
    set(Run::file(&file).set("exact.must_hold", false).set("output.fields", false)).ended()
}

fn converged(ended: Ended) -> Ended {
    assert_eq!(ended.code, Some(0), "{}", ended.said());
    ended
}

/// Angle from the x axis, pressure and normal displacements along Γ_C.
fn around(ended: &Ended) -> Vec<[f64; 4]> {
    let points = ended.trace("seam");
    points.iter().map(|p| [p.x[1].atan2(p.x[0]).rem_euclid(TAU), p.lambda, p.un[0], p.un[1]]).collect()
}

/// Values of one kind at both ends of each segment and between, in their order; the second as far as the first goes.
fn apart(part: &[[f64; 4]], whole: &[[f64; 4]], kind: usize) -> f64 {
    let values = |points: &[[f64; 4]]| points[..part.len()].iter().map(|point| point[kind]).collect::<Vec<_>>();
    assert!(part.iter().zip(whole).all(|(a, b)| (a[0] - b[0]).abs() < 1e-9), "the same points");
    difference(&values(whole), &values(part))
}

/// A case on the quarter: symmetry on the cuts holds what points hold in the whole.
fn quarter(case: &str, set: impl Fn(Run) -> Run) -> Ended {
    let cuts = "[support.x_axis]\non = \"axis.x\"\nuy = 0.0\n\n[support.y_axis]\non = \"axis.y\"\nux = 0.0\n\n";
    match case {
        "case.toml" => scene("rings/rings.msh", case, &[("[contact.seam]", &format!("{cuts}[contact.seam]"))], set),
        _ => {
            let text = read(&format!("rings_full/{case}"));
            let points = &text[text.find("[support.").expect("points")..text.find("[load.").expect("a load")];
            scene("rings/rings.msh", case, &[(points, cuts)], set)
        }
    }
}

#[test]
fn whole_rings_are_their_quarters() {
    for (at, (order, space)) in PAIRS.into_iter().enumerate() {
        let case = ["case.toml", "michell.toml"][at % 2];
        let run = |run: Run, segments: usize| {
            let run = run.set("mesh.order", order).set("contact.seam.multiplier", space).set("mesh.refine", 1);
            run.set("contact.seam.segments", segments).set("solver.tolerance", "1e-12")
        };
        let quarter = converged(quarter(case, |own| run(own, 6)));
        let whole = converged(scene("rings_full/rings.msh", case, &[], |own| run(own, 24).ranks(1 + at % 3)));
        let [part, all] = [&quarter, &whole].map(around);
        for kind in 1..4 {
            let off = apart(&part[..part.len() - 1], &all, kind);
            assert!(off < 1e-9, "P{order}, {space}, {case}, kind {kind}: {off}");
        }
        for path in ["/contact/seam/force", "/energy/total", "/contact/seam/length"] {
            let [part, all] = [&quarter, &whole].map(|ended| ended.number(path));
            assert!((all / part / 4.0 - 1.0).abs() < 1e-9, "P{order}, {space}, {case}: {path} {all} and {part}");
        }
        let points = whole.trace("seam");
        let [first, last] = [points[0], points[points.len() - 1]];
        assert!((0..2).all(|k| (first.x[k] - last.x[k]).abs() < 1e-12) && first.s == 0.0, "it ends where it begins");
        let summary = whole.value("/contact/seam");
        assert_eq!(summary["zones"].as_array().map(Vec::len), Some(1), "{summary:#}");
        assert!(order == 1 || summary["trust"] == true, "{summary:#}");
        assert!(whole.number("/balance/energy") < 1e-9 && whole.number("/balance/force") < 1e-9);
    }
}

/// The same circle as formulas that begin elsewhere, and run the other way round; segments lie where they were.
#[test]
fn the_seam_changes_nothing() {
    let circle = "circle = { centre = [0, 0], radius = 2 }";
    let turned = "x = \"2*cos(2*pi*5/24 - t)\"\ny = \"2*sin(2*pi*5/24 - t)\"\nt = [0, 6.283185307179586]";
    for (order, space, stabilise, ranks) in
        [(1, "p0", "true", 1), (2, "p1-discontinuous", "true", 2), (2, "p1-continuous", "auto", 3)]
    {
        let run = |run: Run| {
            let run = run.set("mesh.order", order).set("contact.seam.multiplier", space).set("mesh.refine", 1).ranks(ranks);
            run.set("contact.seam.segments", 24).set("solver.tolerance", "1e-12").set("contact.seam.stabilise", stabilise)
        };
        let [one, other] =
            [&[][..], &[(circle, turned)]].map(|words| converged(scene("rings_full/rings.msh", "michell.toml", words, run)));
        for path in ["/contact/seam/force", "/energy/total", "/contact/seam/pressure_max"] {
            let [a, b] = [&one, &other].map(|ended| ended.number(path));
            assert!((a / b - 1.0).abs() < 1e-9, "P{order}, {space}: {path} {a} and {b}");
        }
        // Values on both sides of an angle at which λ jumps are two; only those at other angles are compared.
        let [a, b] = [&one, &other].map(|ended| {
            let mut points = around(ended);
            points.retain(|p| ((p[0] * 24.0 / TAU).round() - p[0] * 24.0 / TAU).abs() > 1e-6);
            points.sort_by(|a, b| a[0].total_cmp(&b[0]));
            points
        });
        assert_eq!(a.len(), b.len());
        for kind in 1..4 {
            assert!(apart(&a, &b, kind) < 1e-9, "P{order}, {space}, kind {kind}: {}", apart(&a, &b, kind));
        }
    }
}

/// Nobody declares a curve: the fit goes round as well.
#[test]
fn a_closed_fit_is_as_good_as_the_declared_circle() {
    for (order, space, ranks) in [(2, "p1-discontinuous", 2), (2, "p1-continuous", 1), (1, "p0", 3)] {
        let run = |curve: &'static str| {
            move |run: Run| {
                let run = run.set("mesh.order", order).set("contact.seam.multiplier", space).ranks(ranks);
                run.set("contact.seam.curve", curve).set("solver.tolerance", "1e-11")
            }
        };
        let [fitted, declared] = ["fit", "geometry"].map(|curve| {
            let ended = converged(scene("rings_full/rings.msh", "michell.toml", &[], run(curve)));
            assert!(order == 1 || ended.value("/contact/seam/trust") == true, "{}", ended.said());
            ended.number("/errors/lambda_seam")
        });
        assert!(fitted < 1.1 * declared, "P{order}, {space}: {fitted} against {declared}");
    }
}

#[test]
fn a_ring_that_only_contact_holds_can_turn() {
    let free = ("[support.housing]\non = \"outer.rim\"\nux = 0.0\nuy = 0.0\n", "");
    for curve in ["geometry", "fit"] {
        let ended = scene("rings_full/rings.msh", "case.toml", &[free], |run| run.set("contact.seam.curve", curve).ranks(2));
        assert_eq!(ended.code, Some(3), "{}", ended.said());
        let words = "body outer can turn about (0, 0): supports and contact do not hold it";
        assert!(ended.said().contains(words), "{}", ended.said());
    }
}

/// The inner ring is a pin, smaller than its hole by 1e-3 and drawn in the middle of it; a force along x drives it against the
/// hole, around the seam of the circle, and only contact holds it in that direction.
const LOOSE: [(&str, &str); 3] = [
    ("gap        = -1e-3", "gap        = 1e-3"),
    ("on = \"inner.bore\"\nux = 0.0\nuy = 0.0", "on = \"inner.bore\"\nuy = 0.0"),
    ("[body.inner]\n", "[body.inner]\nbody_force = [0.5, 0.0]\n"),
];

const CUT: (&str, &str) = ("[contact.seam]", "[support.x_axis]\non = \"axis.x\"\nuy = 0.0\n\n[contact.seam]");

#[test]
fn a_loose_pin_finds_its_place_in_a_whole_hole() {
    let half_words = [&LOOSE[..], &[CUT]].concat();
    for (at, (order, space)) in [(2, "p1-discontinuous"), (2, "p1-continuous"), (1, "p0")].into_iter().enumerate() {
        let run = |run: Run, segments: usize| {
            let run = run.set("mesh.order", order).set("contact.seam.multiplier", space).set("solver.tolerance", "1e-11");
            run.set("contact.seam.segments", segments)
        };
        let half = converged(scene("rings_full/half.msh", "case.toml", &half_words, |own| run(own, 40)));
        let whole = converged(scene("rings_full/rings.msh", "case.toml", &LOOSE, |own| run(own, 80).ranks(1 + at)));
        let [part, all] = [&half, &whole].map(around);
        assert!(apart(&part[..part.len() - 1], &all, 1) < 1e-7, "P{order}, {space}: {}", apart(&part[..part.len() - 1], &all, 1));
        let force = [&half, &whole].map(|ended| ended.number("/contact/seam/force"));
        assert!((force[1] / force[0] / 2.0 - 1.0).abs() < 1e-7, "{force:?}");
        let summary = whole.value("/contact/seam");
        assert_eq!(summary["zones"].as_array().map(Vec::len), Some(1), "one zone across the seam: {summary:#}");
        assert_eq!(summary["closed"].as_array().map(Vec::len), Some(2), "cut there: {summary:#}");
        // All of the load goes through the contact.
        let load = 0.5 * 0.5 * TAU * 3.0;
        assert!((whole.number("/contact/seam/resultant/0") / load - 1.0).abs() < 2e-3, "{summary:#}");
    }
}

/// Γ_C is cut off where the pressure ends, across the seam of the circle, or fitted to a part of both closed sides.
#[test]
fn a_loose_pin_has_free_ends() {
    let run = |curve: &'static str, ends: &'static str, segments: usize| {
        move |run: Run| {
            let run = run.set("contact.seam.curve", curve).set("contact.seam.ends", ends).set("mesh.refine", 2);
            run.set("contact.seam.segments", segments)
        }
    };
    let half_words = [&LOOSE[..], &[CUT]].concat();
    let half = converged(scene("rings_full/half.msh", "case.toml", &half_words, run("geometry", "free", 15)));
    let width = 2.0 * half.number("/contact/seam/length");
    for (curve, ranks) in [("geometry", 1), ("fit", 2)] {
        let whole = converged(scene("rings_full/rings.msh", "case.toml", &LOOSE, |own| run(curve, "free", 30)(own).ranks(ranks)));
        let found = whole.number("/contact/seam/length");
        assert!((found / width - 1.0).abs() < 5e-3, "{curve}: {found} instead of {width}");
        let peaks = [&half, &whole].map(|ended| ended.number("/contact/seam/pressure_max"));
        assert!((peaks[1] / peaks[0] - 1.0).abs() < 2e-3, "{curve}: {peaks:?}");
        let ends = [0, 1].map(|k| whole.number(&format!("/contact/seam/ends/{k}/1")));
        assert!((ends[0] + ends[1]).abs() < 1e-3 * width, "{curve}: {ends:?}");
    }
}

#[test]
fn what_goes_all_around_has_no_ends_to_grade_towards() {
    for (key, value, words) in [
        ("contact.seam.grading", "[4, 4]", ["grading = [4, 4]", "leave grading out"]),
        ("contact.seam.segments", "100000", ["segments = 100000", "or \"auto\""]),
    ] {
        let ended = scene("rings_full/rings.msh", "case.toml", &[], |run| run.set(key, value));
        assert_eq!(ended.code, Some(2), "{}", ended.said());
        assert!(words.iter().all(|word| ended.errors.contains(word)), "{}", ended.errors);
    }
    let ended =
        scene("rings_full/rings.msh", "case.toml", &[], |run| run.set("contact.seam.curve", "fit").set("contact.seam.spans", 3));
    assert_eq!(ended.code, Some(2), "{}", ended.said());
    assert!(ended.errors.contains("a closed curve has 4 spans or more; give 4, or \"auto\""), "{}", ended.errors);
}
