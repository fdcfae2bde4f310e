//! Bodies between others: three that meet in a point, a wedge, a strip between jaws, a chain of fifty.

use crate::support::mesh::{Mesh, grid, write_scene};
use crate::support::{Ended, PAIRS, RANKS, Run, difference, pairs_on_ranks};
use serde_json::Value;

const EXACT: f64 = 1e-9;

fn spaces(run: Run, contacts: &[&str], space: &str) -> Run {
    contacts.iter().fold(run, |run, contact| run.set(&format!("contact.{contact}.multiplier"), space))
}

/// No linear solve takes more than 20 iterations.
fn is_quick(ended: &Ended, words: &str) {
    for count in ended.value("/solver/iterations").as_array().expect("a list") {
        assert!(count.as_u64().is_some_and(|count| count <= 20), "{words}: {count} iterations");
    }
}

/// Besides, λ swings nowhere.
fn is_calm(ended: &Ended, words: &str) {
    is_quick(ended, words);
    for (name, contact) in ended.value("/contact").as_object().expect("contacts") {
        let oscillation = contact["oscillation"].as_f64();
        assert!(oscillation.is_none_or(|share| share <= 0.05), "{words}: λ of {name} swings by {oscillation:?}");
    }
}

/// All errors and balances of a patch test are at rounding.
fn is_exact(ended: &Ended, words: &str) {
    for (name, error) in ended.value("/errors").as_object().expect("errors by name") {
        assert!(error.as_f64().is_some_and(|error| error <= EXACT), "{words}: {name} {error}");
    }
    for balance in ["force", "moment", "energy"] {
        let off = ended.number(&format!("/balance/{balance}"));
        assert!(off <= EXACT, "{words}: balance of {balance} {off:e}");
    }
}

/// Uniform stresses where three lines of contact meet in a point, at right angles and at 120 degrees, and in a wedge.
#[test]
fn uniform_stresses_with_all_spaces() {
    let table: [(&str, &[&str]); 3] = [
        ("three_bodies/patch.toml", &["upright", "under_left", "under_right"]),
        ("three_bodies/sectors.toml", &["up", "lower_left", "lower_right"]),
        ("wedge/patch.toml", &["left", "right"]),
    ];
    for (case, contacts) in table {
        for (order, space, ranks) in pairs_on_ranks() {
            let words = format!("{case}, P{order}, {space}, {ranks} ranks");
            let run = Run::case(case).ranks(ranks).set("mesh.order", order).set("solver.inf_sup", true);
            let ended = spaces(run, contacts, space).converged();
            is_exact(&ended, &words);
            is_calm(&ended, &words);
            for contact in contacts {
                let constant = ended.number(&format!("/contact/{contact}/inf_sup"));
                assert!(constant > 0.1, "{words}: inf-sup constant {constant} of {contact}");
            }
        }
    }
}

/// Largest error of those whose names begin so.
fn largest(errors: &Value, start: &str) -> f64 {
    let errors = errors.as_object().expect("errors by name").iter();
    errors.filter(|(name, _)| name.starts_with(start)).map(|(_, e)| e.as_f64().expect("a number")).fold(0.0, f64::max)
}

/// Pressures that vary up to the point where the three meet: the orders are those of two bodies.
#[test]
fn pressures_that_vary_where_three_bodies_meet() {
    let contacts = ["upright", "under_left", "under_right"];
    for (order, space, coarsest, least) in [
        (2, "p1-discontinuous", 1, [1.9, 1.9]),
        (2, "p1-continuous", 1, [1.9, 1.9]),
        (2, "p0", 1, [1.8, 0.95]),
        (1, "p0", 2, [0.9, 0.9]),
    ] {
        let errors = [coarsest, coarsest + 2].map(|refine| {
            let run = Run::case("three_bodies").ranks(2).set("mesh.order", order).set("mesh.refine", refine);
            let ended = spaces(run, &contacts, space).set("exact.must_hold", false).converged();
            is_calm(&ended, &format!("P{order}, {space}, refine {refine}"));
            let errors = ended.value("/errors");
            ["energy_norm_", "lambda_"].map(|start| largest(&errors, start))
        });
        for (k, name) in ["energy", "pressure"].into_iter().enumerate() {
            let found = (errors[0][k] / errors[1][k]).log2() / 2.0;
            println!("P{order}, {space}: {name} of order {found:.2}: {errors:?}");
            assert!(found >= least[k], "P{order}, {space}: {name} of order {found}: {errors:?}");
        }
    }
}

/// Statics alone: N₁ = F cos β/sin(α + β), N₂ = F cos α/sin(α + β) on faces α and β from upright, and the moment of the load
/// about the point where the faces meet. However the pressures are distributed.
#[test]
fn a_wedge_presses_as_statics_say() {
    let known = [2.873326578304445, 3.1177420095782487];
    for (order, space) in PAIRS {
        let run = Run::case("wedge").ranks(2).set("mesh.refine", 1).set("mesh.order", order).set("exact.must_hold", false);
        let ended = spaces(run, &["left", "right"], space).converged();
        let words = format!("P{order}, {space}");
        // λ is singular at the corners, and swings beside them.
        is_quick(&ended, &words);
        for (contact, known) in ["left", "right"].into_iter().zip(known) {
            let found = ended.number(&format!("/contact/{contact}/force"));
            assert!((found / known - 1.0).abs() <= EXACT, "{words}: {contact} carries {found}, statics say {known}");
        }
        let moment = ended.number("/contact/left/moment") + ended.number("/contact/right/moment");
        let (a, b) = (-2.5 * 20.0_f64.to_radians().tan(), 2.5 * 30.0_f64.to_radians().tan());
        let load = 0.5 * (b * b - a * a) + 0.1 * (b * b * b - a * a * a);
        assert!((moment - load).abs() <= 1e-8 * load, "{words}: moment {moment}, of the load {load}");
    }
    let force = |ranks| {
        let ended = Run::case("wedge").ranks(ranks).set("mesh.refine", 2).set("exact.must_hold", false).converged();
        ended.trace("left").iter().map(|point| point.lambda).collect::<Vec<f64>>()
    };
    let [one, two, three] = RANKS.map(force);
    for other in [two, three] {
        assert!(difference(&other, &one) <= 1e-8, "ranks differ by {:e}", difference(&other, &one));
    }
}

/// A strip between two crowned jaws: it is pressed from both sides at one place. Meshes differ, what is found does not.
#[test]
fn a_strip_between_two_jaws_is_pressed_alike_from_both_sides() {
    let block = |y: [f64; 2], cells: usize, seed: u64| {
        grid(cells, cells / 2, seed, move |u, v| [4.0 * u - 2.0, y[0] + v * (y[1] - y[0])])
    };
    let mesh = Mesh {
        bodies: vec![
            ("lower", block([-2.0, 0.0], 11, 1), ["bottom", "", "lower.top", "axis"]),
            ("strip", block([0.0, 1.0], 13, 2), ["strip.bottom", "", "strip.top", "strip.left"]),
            ("upper", block([1.0, 3.0], 12, 3), ["upper.bottom", "", "top", "axis"]),
        ],
    };
    let case = r#"
mesh = { file = "mesh.msh", refine = 2 }
body.lower = { young = 7000.0, poisson = 0.3 }
body.strip = { young = 1000.0, poisson = 0.3 }
body.upper = { young = 7000.0, poisson = 0.3 }
support.table = { on = "bottom", uy = 0.0 }
support.walls = { on = ["axis", "strip.left"], ux = 0.0 }
load.top = { on = "top", pressure = 1.0 }
contact.below = { between = ["lower.top", "strip.bottom"], curve = "line", gap = "1e-3*x^2", ends = "free" }
contact.above = { between = ["strip.top", "upper.bottom"], curve = "line", gap = "1e-3*x^2", ends = "free" }
"#;
    let folder = tempfile::tempdir().expect("a temporary folder");
    let ended = Run::file(&write_scene(folder.path(), &mesh.text(), case)).ranks(2).converged();
    is_calm(&ended, "strip");
    let of = |contact: &str| {
        ["force", "pressure_max", "ends/0/0", "ends/1/0"].map(|name| ended.number(&format!("/contact/{contact}/{name}")))
    };
    let (below, above) = (of("below"), of("above"));
    println!("{below:?} below, {above:?} above");
    for (k, limit) in [1e-6, 1e-2, 2e-2, 2e-2].into_iter().enumerate() {
        assert!((below[k] / above[k] - 1.0).abs() <= limit, "below {below:?}, above {above:?}");
    }
    assert!((above[0] - 4.0).abs() <= 4e-6, "all of the load: {above:?}");
}

/// Every line carries the load, and all but those near the ends the same pressure.
#[test]
fn a_chain_of_fifty_blocks_carries_its_load() {
    let runs = RANKS.map(|ranks| Run::case("chain_50").ranks(ranks).converged());
    let pressures = runs.each_ref().map(|ended| {
        is_calm(ended, "chain");
        let force = |i: usize| ended.number(&format!("/contact/line{i:02}/force"));
        (1..50).for_each(|i| assert!((force(i) - 1.0).abs() <= EXACT, "line {i} carries {}", force(i)));
        let lambda = |i: usize| ended.trace(&format!("line{i:02}")).iter().map(|point| point.lambda).collect::<Vec<f64>>();
        (1..50).map(lambda).collect::<Vec<_>>()
    });
    for other in &pressures[1..] {
        for (found, one) in other.iter().zip(&pressures[0]) {
            assert!(difference(found, one) <= 1e-8, "ranks differ by {:e}", difference(found, one));
        }
    }
    // Every other line has the same bodies below and above.
    let peak = |i: usize| pressures[0][i - 1].iter().fold(0.0, |peak: f64, lambda| peak.max(*lambda));
    for i in (11..=37).step_by(2) {
        assert!((peak(i) / peak(i + 2) - 1.0).abs() <= 1e-5, "lines {i} and {}: {} and {}", i + 2, peak(i), peak(i + 2));
    }
}
