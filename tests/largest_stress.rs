//! The largest von Mises stress of each body: its value and its place on any number of ranks, and whether it is believed.

use crate::support::mesh::{Mesh, grid, write_scene};
use crate::support::{Ended, RANKS, Run, close, numbers};

/// A block, 2 long and 1 high, with a notch in the middle of its bottom that is so deep.
fn block(notch: f64) -> Mesh {
    let bottom = move |u: f64| notch * (1.0 - (2.0 * u - 1.0).abs());
    let block = grid(8, 4, 3, move |u, v| [2.0 * u, v + (1.0 - v) * bottom(u)]);
    Mesh { bodies: vec![("block", block, ["bottom", "right", "top", "left"])] }
}

/// A run of the block under these supports and loads on so many ranks.
fn run(notch: f64, acting: &str, ranks: usize) -> Ended {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let case = format!("mesh.file = \"mesh.msh\"\nbody.block = {{ young = 7000.0, poisson = 0.3 }}\n{acting}");
    let file = write_scene(folder.path(), &block(notch).text(), &case);
    Run::file(&file).set("mesh.refine", 2).ranks(ranks).converged()
}

#[test]
fn an_even_stress_is_believed_and_the_same_on_all_ranks() {
    let acting = "support.low = { on = \"bottom\", uy = 0.0 }\nsupport.side = { on = \"left\", ux = 0.0 }\nload.top = { on = \"top\", pressure = 2.0 }";
    for ranks in RANKS {
        let ended = run(0.0, acting, ranks);
        // Plane strain: the stress across the plane is 0.3 of that along y.
        let wanted = 2.0 * (1.0_f64 - 0.3 + 0.09).sqrt();
        close(ended.number("/body/block/von_mises_max"), wanted, 1e3, "an even stress");
        assert_eq!((ended.value("/body/block/is_believed"), ended.value("/body/block/verdict")), (true.into(), ().into()));
        let [x, y] = numbers(&ended, "/body/block/place");
        assert!(x.abs() < 1e-12 && y.abs() < 1e-12, "of equal stresses the first one counts: ({x}, {y})");
        assert!(ended.output.contains("largest von Mises stress: block 1.77764 at (0, 0)\n"), "{}", ended.said());
    }
}

#[test]
fn a_stress_without_bound_is_not_believed_and_its_place_is_named() {
    let pulled = "support.high = { on = \"top\", uy = 0.0 }\nsupport.side = { on = \"left\", ux = 0.0 }\nload.end = { on = \"right\", traction = [2.0, 0.0] }";
    let clamped = "support.low = { on = \"bottom\", ux = 0.0, uy = 0.0 }\nload.top = { on = \"top\", pressure = 2.0 }";
    for (notch, acting, words, place) in [
        (0.5, pulled, "at the corner (1, 0.5), where the stress has no bound: it grows with each mesh", [1.0, 0.5]),
        (0.0, clamped, "at the end of support.low, (0, 0), where the stress has no bound: it grows with each mesh", [0.0, 0.0]),
    ] {
        let all = RANKS.map(|ranks| run(notch, acting, ranks));
        for ended in &all {
            assert_eq!(ended.value("/body/block/is_believed"), false, "{words}");
            assert_eq!(ended.value("/body/block/verdict"), words);
            let [x, y] = numbers(ended, "/body/block/place");
            // Within two edges of 1/16.
            assert!((x - place[0]).hypot(y - place[1]) < 0.13, "{words}: ({x}, {y})");
            assert!(ended.output.contains(&format!("(not to be believed: {words})")), "{}", ended.said());
            let [one, other] = [ended, &all[0]].map(|ended| ended.number("/body/block/von_mises_max"));
            assert!((one / other - 1.0).abs() < 1e-5, "{words}: {one} and {other}");
        }
        let read = |name: &str| std::fs::read_to_string(all[0].out.join(name)).expect("a file of the result");
        assert!(read("report.html").contains("Largest stresses") && read("report.html").contains(words));
        assert_eq!(read("deformed.svg").matches("<circle").count(), 2, "a ring and its rim");
        assert!(read("deformed.svg").contains(", not to be believed</text>"));
    }
}

/// Beside one mesh alone nothing tells an error, and the corner of a punch presses on both bodies.
#[test]
fn one_mesh_alone_tells_nothing_and_a_punch_presses_with_its_corner() {
    let alone = Run::case("bars_inclined").set("mesh.refine", 0).set("exact.must_hold", false).solved();
    let words = alone.value("/body/upper/verdict");
    assert!(words.as_str().is_some_and(|words| words.contains("no coarser refinement was solved")), "{words}");
    assert_eq!(alone.value("/body/upper/is_believed"), false);
    let punch = Run::case("punch").converged();
    let contacts = std::fs::read_to_string(punch.out.join("contacts.csv")).expect("the contacts");
    assert!(contacts.contains("trusted, but for the largest value: λ grows without bound"), "{contacts}");
    for body in ["base", "block"] {
        let words = punch.value(&format!("/body/{body}/verdict"));
        let wanted = "at the pressing corner of contact seam, (1, 0), where the stress has no bound: it grows with each mesh";
        assert_eq!(words, wanted);
    }
}

/// The end is pulled most at its top, so that the largest stress lies there; that of the corner of the notch is more than half of it, and
/// has no bound. Without the notch the same is believed.
#[test]
fn a_place_without_bound_speaks_against_a_larger_stress_elsewhere() {
    let acting = "support.low = { on = \"left\", ux = 0.0 }\nsupport.high = { on = \"top\", uy = 0.0 }\nload.end = { on = \"right\", traction = [\"1 + 18*y^8\", 0.0] }";
    for ranks in [1, 2] {
        let ended = run(0.35, acting, ranks);
        let [x, _] = numbers(&ended, "/body/block/place");
        assert!(x > 1.9, "the largest stress lies at x = {x}");
        let words = "at the corner (1, 0.35), where the stress has no bound: it grows with each mesh";
        assert_eq!(ended.value("/body/block/verdict"), words);
    }
    assert_eq!(run(0.0, acting, 1).value("/body/block/is_believed"), true);
}
