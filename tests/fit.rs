//! A contact boundary that nobody gives: fitted through the boundary nodes, gaps between splines.

mod support;

use support::mesh::{Mesh, grid, write_scene};
use support::{PAIRS, RANKS, Run};

#[test]
fn patches_hold_on_a_fitted_line() {
    for case in ["patch_flat/case.toml", "patch_inclined/case.toml"] {
        for (order, space) in PAIRS {
            for ranks in RANKS {
                let run = Run::case(case).ranks(ranks).set("mesh.order", order).set("contact.seam.multiplier", space);
                // The case's own expected values hold to 1e-9, or it would end with exit code 3.
                run.set("contact.seam.curve", "fit").set("contact.seam.gap", "geometry").converged();
            }
        }
    }
}

#[test]
fn a_fit_through_bent_edges_is_as_good_as_the_declared_circle() {
    let rings =
        |curve: &str| Run::case("rings/case.toml").ranks(2).set("contact.seam.curve", curve).set("solver.tolerance", "1e-11");
    let [fitted, declared] = ["fit", "geometry"].map(|curve| rings(curve).converged().number("/errors/lambda_seam"));
    assert!(fitted < 1.05 * declared, "{fitted} against {declared}");
}

/// Two quarter rings of straight edges that overlap by 1e-3, `n` and `5/4 n` edges along the seam.
fn polygons(n: usize) -> Mesh {
    let ring = |nx: usize, ny: usize, seed: u64, inner: f64, outer: f64| {
        grid(nx, ny, seed, move |u, v| {
            let (r, angle) = (inner + u * (outer - inner), 0.5 * std::f64::consts::PI * v);
            [r * angle.cos(), r * angle.sin()]
        })
    };
    let inner = ring(n / 2, n, 1, 1.0, 2.0005);
    let outer = ring(n / 2, n + n / 4, 2, 1.9995, 3.0);
    Mesh {
        bodies: vec![
            ("inner", inner, ["flat", "inner.seam", "upright", "inner.rim"]),
            ("outer", outer, ["flat", "outer.rim", "upright", "outer.seam"]),
        ],
    }
}

const RINGS: &str = r#"
mesh = { file = "mesh.msh", order = 1 }
body.inner = { young = 7000.0, poisson = 0.227 }
body.outer = { young = 7000.0, poisson = 0.227 }
support.flat = { on = "flat", uy = 0.0 }
support.upright = { on = "upright", ux = 0.0 }
contact.seam = { between = ["inner.seam", "outer.seam"], multiplier = "p0" }
exact.contact.seam.lambda = { formula = "0.864878841841237", tolerance = 0.02 }
"#;

#[test]
fn polygons_get_their_gap_from_splines() {
    for ranks in [1, 2] {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let errors = [16, 32, 64].map(|n| {
            let file = write_scene(folder.path(), &polygons(n).text(), RINGS);
            Run::file(&file).ranks(ranks).converged().number("/errors/lambda_seam")
        });
        println!("{errors:?}");
        assert!(errors[2] <= 0.02, "{errors:?}");
    }
}
