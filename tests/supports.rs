//! Inclined supports, prescribed displacements, body forces and tractions against exact solutions.

use crate::support::mesh::{Mesh, grid, write_scene};
use crate::support::{Ended, PAIRS, Run};

const EXACT: f64 = 1e-9;
const ANGLE: f64 = 37.0 * std::f64::consts::PI / 180.0;

fn turn([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    let (sin, cos) = angle.sin_cos();
    [cos * x - sin * y, sin * x + cos * y]
}

/// Two blocks [0, 2] × [0, 1] and [0, 2] × [1, 2] with 5 against 6 edges on the contact line, turned about the origin.
fn blocks(angle: f64) -> Mesh {
    let lower = grid(5, 3, 11, |u, v| [2.0 * u, v]);
    let upper = grid(6, 3, 12, |u, v| [2.0 * u, 1.0 + v]);
    let mesh = Mesh {
        bodies: vec![
            ("lower", lower, ["bottom", "right", "lower.seam", "left"]),
            ("upper", upper, ["upper.seam", "upper.right", "top", "left"]),
        ],
    };
    mesh.map(|x| turn(x, angle))
}

const TWO_BODIES: &str = r#"
mesh = { file = "mesh.msh", refine = 2 }
body.lower = { young = 7000.0, poisson = 0.227 }
body.upper = { young = 3000.0, poisson = 0.3 }
contact.seam = { between = ["lower.seam", "upper.seam"], curve = "line", gap = "closed" }
solver.tolerance = 1e-12
"#;

fn run(mesh: &Mesh, case: &str, check: impl Fn(&str, Ended)) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = write_scene(folder.path(), &mesh.text(), case);
    for (order, space) in PAIRS {
        for ranks in [1, 2] {
            let run = Run::file(&file).ranks(ranks).set("mesh.order", order);
            let run = if case.contains("contact.seam") { run.set("contact.seam.multiplier", space) } else { run };
            check(&format!("P{order} and {space}, {ranks} ranks"), run.converged());
        }
    }
}

/// λ = p and n·σn = -p along the seam.
fn pressed(ended: &Ended, p: f64, words: &str) {
    for point in ended.trace("seam") {
        let errors = [point.lambda - p, point.sigma[0] + p, point.sigma[1] + p];
        assert!(errors.iter().all(|error| error.abs() <= EXACT * p), "{words}: {point:?}");
    }
}

fn close(found: f64, wanted: f64, size: f64, words: &str) {
    assert!((found - wanted).abs() <= EXACT * size, "{words}: {found} instead of {wanted}");
}

/// The displacement at probe `p`, and its stress.
fn probed(ended: &Ended) -> ([f64; 2], [f64; 3]) {
    let number = |key: &str, k: usize| ended.number(&format!("/probe/p/{key}/{k}"));
    ([0, 1].map(|k| number("u", k)), [0, 1, 2].map(|k| number("stress", k)))
}

/// patch_flat, turned by 37 degrees: its supports become inclined, on every level.
#[test]
fn a_turned_patch_on_inclined_supports() {
    let corner = turn([2.0, 2.0], ANGLE);
    let case = format!(
        "{TWO_BODIES}
         support.all = {{ on = [\"bottom\", \"left\"], normal = 0.0 }}
         load.top = {{ on = \"top\", pressure = 1.0 }}
         probe.p = {{ point = {corner:?}, body = \"upper\" }}"
    );
    let exact = turn([0.00026, -0.00043882919047619], ANGLE);
    for refine in [0, 2] {
        let case = case.replace("refine = 2", &format!("refine = {refine}"));
        run(&blocks(ANGLE), &case, |words, ended| {
            pressed(&ended, 1.0, words);
            let (u, _) = probed(&ended);
            (0..2).for_each(|k| close(u[k], exact[k], 4e-4, words));
            close(ended.number("/contact/seam/force"), 2.0, 2.0, words);
        });
    }
}

/// The top face moves by a given amount; the pressure follows from both bodies' stiffness in series.
#[test]
fn a_prescribed_displacement_presses_evenly() {
    let [low, up] = [(1.0 - 0.227f64.powi(2)) / 7000.0, (1.0 - 0.3f64.powi(2)) / 3000.0];
    let pressure = 1e-3 / (low + up);
    let u_x = 0.3 * 1.3 / 3000.0 * pressure * 2.0;
    for angle in [0.0, ANGLE] {
        let corner = turn([2.0, 2.0], angle);
        let support = if angle == 0.0 { "uy = -1e-3" } else { "normal = -1e-3" };
        let case = format!(
            "{TWO_BODIES}
             support.all = {{ on = [\"bottom\", \"left\"], normal = 0.0 }}
             support.top = {{ on = \"top\", {support} }}
             probe.p = {{ point = {corner:?}, body = \"upper\" }}"
        );
        let exact = turn([u_x, -1e-3], angle);
        run(&blocks(angle), &case, |words, ended| {
            pressed(&ended, pressure, words);
            let (u, _) = probed(&ended);
            (0..2).for_each(|k| close(u[k], exact[k], 1e-3, words));
            let energy = ended.number("/energy/total");
            close(energy, 0.5 * pressure * 1e-3 * 2.0, energy, words);
            close(ended.number("/energy/external_work"), 2.0 * energy, energy, words);
            assert!(ended.number("/balance/energy") <= EXACT, "{words}: {}", ended.number("/balance/energy"));
        });
    }
}

/// Tractions in place of the pressure, and shear that the wall takes: σ = [[-2, 0], [0, -1]] in both bodies.
#[test]
fn tractions_in_global_axes() {
    let case = format!(
        "{TWO_BODIES}
         support.bottom = {{ on = \"bottom\", uy = 0.0 }}
         support.left = {{ on = \"left\", ux = 0.0 }}
         load.top = {{ on = \"top\", traction = [0, -1] }}
         load.side = {{ on = [\"right\", \"upper.right\"], traction = [\"-2\", 0] }}
         probe.p = {{ point = [1.3, 1.6], body = \"upper\" }}"
    );
    run(&blocks(0.0), &case, |words, ended| {
        pressed(&ended, 1.0, words);
        let (_, stress) = probed(&ended);
        (0..3).for_each(|k| close(stress[k], [-2.0, -1.0, 0.0][k], 2.0, words));
    });
}

/// One block under its own weight between smooth walls: σ_y = -ρ (1 - y), u_y a parabola, which P2 has exactly.
#[test]
fn a_block_under_its_weight() {
    let mesh = Mesh { bodies: vec![("block", grid(4, 5, 5, |u, v| [2.0 * u, v]), ["bottom", "right", "top", "left"])] };
    let case = r#"
        mesh = { file = "mesh.msh", refine = 2 }
        body.block = { young = 1000.0, poisson = 0.3, body_force = [0, "-3"] }
        support.walls = { on = ["bottom", "left", "right"], normal = 0.0 }
        solver.tolerance = 1e-12
        probe.p = { point = [0.7, 0.4], body = "block" }
        "#;
    let stiffness = 1000.0 * 0.7 / (1.3 * 0.4);
    let exact = [0.0, -3.0 / stiffness * (0.4 - 0.08)];
    let stress = [-1.8 * 0.3 / 0.7, -1.8, 0.0];
    run(&mesh, case, |words, ended| {
        let energy = 3.0 / stiffness;
        if words.starts_with("P2") {
            let (u, found) = probed(&ended);
            (0..2).for_each(|k| close(u[k], exact[k], 1e-3, words));
            (0..3).for_each(|k| close(found[k], stress[k], 2.0, words));
            close(ended.number("/energy/total"), energy, energy, words);
        }
        assert!((ended.number("/energy/total") / energy - 1.0).abs() < 1e-2, "{words}");
    });
}

/// A pure shear traction all around one block gives σ_xy = 1.
#[test]
fn shear_all_around() {
    let mesh = Mesh { bodies: vec![("block", grid(4, 3, 6, |u, v| [2.0 * u, v]), ["bottom", "right", "top", "left"])] };
    let case = r#"
        mesh = { file = "mesh.msh", refine = 1 }
        body.block = { young = 1000.0, poisson = 0.3 }
        support.base = { on = "bottom", ux = 0.0, uy = 0.0 }
        load.top = { on = "top", traction = [1, 0] }
        load.right = { on = "right", traction = [0, 1] }
        load.left = { on = "left", traction = [0, -1] }
        solver.tolerance = 1e-12
        probe.p = { point = [1.1, 0.7], body = "block" }
        "#;
    run(&mesh, case, |words, ended| {
        let (u, stress) = probed(&ended);
        (0..3).for_each(|k| close(stress[k], [0.0, 0.0, 1.0][k], 1.0, words));
        (0..2).for_each(|k| close(u[k], [0.7 * 2.6 / 1000.0, 0.0][k], 1e-3, words));
    });
}
