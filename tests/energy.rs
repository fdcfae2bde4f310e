//! The strain energy from the Lagrangian: the algebraic error enters in the square.

use crate::support::Run;

/// Relative algebraic errors of `total` and `stationary` at a tolerance.
fn errors(run: &Run, tolerance: &str) -> [f64; 2] {
    let energies = |tolerance: &str| {
        let ended = run.clone().set("solver.tolerance", tolerance).set("exact.must_hold", false).ranks(2).converged();
        ["/energy/total", "/energy/stationary"].map(|path| ended.number(path))
    };
    let (exact, found) = (energies("1e-12"), energies(tolerance));
    assert!((exact[1] / exact[0] - 1.0).abs() < 1e-10, "both are the energy of the solution: {exact:?}");
    [0, 1].map(|k| (found[k] / exact[0] - 1.0).abs())
}

/// Where U falls by a factor, the stationary value falls by its square, or nearly so.
fn falls_twice_as_fast(run: Run, words: &str) {
    let [loose, tight] = ["1e-3", "1e-6"].map(|tolerance| errors(&run, tolerance));
    println!("{words}: {loose:?} at 1e-3, {tight:?} at 1e-6");
    assert!(tight[1] < 0.01 * tight[0], "{words}: {tight:?}");
    let [total, stationary] = [0, 1].map(|k| (loose[k] / tight[k]).ln());
    assert!(stationary > 1.5 * total, "{words}: {loose:?} at 1e-3, {tight:?} at 1e-6");
}

fn bars() -> Run {
    Run::case("bars_inclined/graded.toml").set("mesh.refine", 2)
}

#[test]
fn where_loads_alone_do_work() {
    falls_twice_as_fast(bars(), "loads");
    let [total, stationary] = errors(&bars(), "1e-4");
    assert!(total < 1e-7 && stationary < 2e-9, "{total:e}, {stationary:e}");
}

/// Along an axis, and along the normal, in the frame of the nodes.
#[test]
fn where_supports_alone_do() {
    for key in ["uy", "normal"] {
        let run = bars().set("load.top.pressure", 0).set("support.top.on", "top").set(&format!("support.top.{key}"), "-1e-3");
        falls_twice_as_fast(run, key);
    }
}

#[test]
fn where_an_interference_does() {
    falls_twice_as_fast(Run::case("rings").set("mesh.refine", 3), "interference");
}

/// With loads and gaps together it would take another solve, as with heat, and with a jump term the pressure is not free.
#[test]
fn elsewhere_there_is_none() {
    for (key, value) in [
        ("contact.seam.gap", "1e-5"),
        ("support.table.uy", "-1e-6"),
        ("contact.seam.stabilise", "true"),
        ("body.lower.expansion", "1e-6"),
    ] {
        let run = if key.ends_with("expansion") { bars().set("body.lower.temperature", 1) } else { bars() };
        let ended = run.set(key, value).set("exact.must_hold", false).converged();
        assert!(ended.value("/energy/stationary").is_null(), "{key} = {value}");
        assert!(ended.number("/energy/total") > 0.0);
    }
}
