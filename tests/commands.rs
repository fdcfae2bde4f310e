//! The commands of `mezha`, what they print, and what they leave on the disk.

mod support;

use serde_json::Value;
use std::time::{Duration, Instant};
use support::{Run, difference, mezha, names_in};

/// What "ends all ranks" may take.
const SOON: Duration = Duration::from_secs(20);

fn words(line: &str) -> Vec<String> {
    line.split(' ').map(String::from).collect()
}

/// Two bars on a coarse mesh, with as many segments as it bears.
fn coarse(name: &str) -> Run {
    let run = Run::case(name).set("mesh.refine", 2).set("exact.must_hold", false);
    run.set("contact.seam.segments", "auto")
}

fn case(name: &str) -> String {
    format!("{}/cases/{name}/case.toml", env!("CARGO_MANIFEST_DIR"))
}

#[test]
fn info_names_versions_and_ranks() {
    for (ranks, told) in [(None, "ranks 1"), (Some(2), "ranks 2")] {
        let (code, output, _) = mezha(ranks, &["info"]);
        assert_eq!(code, Some(0));
        let version = format!("mezha {}", env!("CARGO_PKG_VERSION"));
        for word in [&version, "PETSc 3.", "Open MPI", "BLAS", told] {
            assert_eq!(output.matches(word).count(), 1, "{word} in {output}");
        }
    }
}

#[test]
fn check_says_what_would_be_solved() {
    let (code, output, errors) = mezha(None, &["check", &case("bars_inclined")]);
    assert_eq!(code, Some(0), "{errors}");
    for word in ["bars_inclined", "64 macro triangles", "16384 P2 triangles", "body lower", "E = 7000", "seam", "30 segments"] {
        assert!(output.contains(word), "{word} in {output}");
    }
    let (code, output, _) = mezha(None, &["check", &case("bars_inclined"), "--set", "mesh.order=1", "--set", "mesh.refine=0"]);
    assert_eq!(code, Some(0));
    assert!(output.contains("64 P1 triangles"), "{output}");
}

#[test]
fn check_refuses_what_run_refuses() {
    for change in ["body.lower.young=-1", "support.table.on=nowhere", "support.x={on=\"bottom\",uy=1.0}", "mesh.file=no.msh"] {
        let (code, output, errors) = mezha(None, &["check", &case("patch_flat"), "--set", change]);
        assert_eq!((code, output.as_str()), (Some(2), ""), "{change}: {errors}");
        assert!(errors.starts_with("mezha: ") && errors.contains("case.toml"), "{errors}");
    }
}

#[test]
fn usage_errors_end_with_code_2() {
    for line in ["run", "solve x.toml", "run x.toml -ksp_view", "check x.toml --out y"] {
        for ranks in [None, Some(2)] {
            let (code, _, errors) = mezha(ranks, &words(line));
            assert_eq!(code, Some(2), "{line}");
            assert_eq!(errors.matches("Usage: ").count(), 1, "{line}: {errors}");
        }
    }
}

/// Every file that other tools rely on, and nothing else.
#[test]
fn the_result_folder_is_complete() {
    let every = ["case.toml", "deformed.svg", "summary.json"];
    let of_contact = |name: &str| [format!("contact_{name}.csv"), format!("contact_{name}.vtu")].to_vec();
    let figures = |name: &str| [format!("displacement_{name}.svg"), format!("pressure_{name}.svg")].to_vec();
    for (ranks, fields) in [
        (None, vec!["fields.vtu"]),
        (Some(1), vec!["fields.vtu"]),
        (Some(3), vec!["fields.pvtu", "fields_0000.vtu", "fields_0001.vtu", "fields_0002.vtu"]),
    ] {
        let run = Run::case("stack").set("mesh.refine", 1);
        let ended = ranks.map_or(run.clone().alone(), |ranks| run.clone().ranks(ranks)).converged();
        let mut wanted: Vec<String> = every.iter().chain(&fields).map(|name| name.to_string()).collect();
        ["first", "second"].iter().for_each(|name| wanted.extend([of_contact(name), figures(name)].concat()));
        wanted.sort();
        assert_eq!(names_in(&ended.out), wanted);
        assert_eq!(ended.left_behind(), ["result"]);
        assert_eq!(ended.value("/ranks"), ranks.unwrap_or(1));
        for name in names_in(&ended.out) {
            let text = std::fs::read(ended.out.join(&name)).expect("a file");
            assert!(text.len() > 200, "{name} has {} bytes", text.len());
        }
    }
}

#[test]
fn a_result_without_fields_has_all_the_numbers() {
    for ranks in [1, 2] {
        let run = Run::case("stack").set("mesh.refine", 1).ranks(ranks);
        let (whole, bare) = (run.clone().converged(), run.set("output.fields", false).converged());
        assert_eq!(names_in(&bare.out), ["case.toml", "contact_first.csv", "contact_second.csv", "summary.json"]);
        for table in ["contact_first.csv", "contact_second.csv"] {
            let read = |ended: &support::Ended| std::fs::read_to_string(ended.out.join(table)).expect("a table");
            assert_eq!(read(&whole).lines().count(), read(&bare).lines().count());
        }
        assert!((whole.number("/energy/total") / bare.number("/energy/total") - 1.0).abs() < 1e-12);
    }
}

/// Names that benchmarks and scripts read; a key that does not apply is null, not missing.
#[test]
fn the_summary_has_every_name() {
    let ended = Run::case("patch_flat").set("probe.top.point", "[1, 2]").set("probe.top.body", "upper").ranks(2).converged();
    let summary = ended.summary();
    let paths = "mezha case status reason ranks mesh/triangles mesh/vertices mesh/order mesh/h_min mesh/h_max \
         unknowns/displacement unknowns/multiplier outer/0/iteration outer/0/active outer/0/added outer/0/released \
         outer/0/krylov_iterations outer/0/residual outer/0/max_penetration outer/0/du contact/seam/length \
         contact/seam/segments contact/seam/multiplier contact/seam/h_ratio contact/seam/inf_sup contact/seam/ends/1/1 \
         contact/seam/closed/0/1 contact/seam/closed_edges contact/seam/closed_points/0/1/1 contact/seam/force contact/seam/resultant/1 \
         contact/seam/moment contact/seam/pressure_max contact/seam/oscillation contact/seam/lost_points \
         contact/seam/trust energy/strain/lower energy/total energy/stationary energy/external_work estimate/energy balance/force \
         balance/moment balance/energy probe/top/x/1 probe/top/u/1 probe/top/stress/2 solver/name solver/krylov \
         solver/iterations/0 solver/residual solver/plain_residual solver/blas time_s/mesh time_s/assemble time_s/contact \
         time_s/setup time_s/solve time_s/output time_s/total memory_mib/max_rank memory_mib/sum errors/energy \
         errors/force_seam errors/lambda_seam errors/displacement_lower errors/energy_norm_upper";
    for path in paths.split_whitespace() {
        assert!(summary.pointer(&format!("/{path}")).is_some(), "summary.json has no {path}: {summary:#}");
    }
    assert_eq!(summary["status"], "converged");
    let total = ended.number("/time_s/total");
    assert!(total > 0.0 && total < ended.time.as_secs_f64(), "{total} s of {:?}", ended.time);
}

#[test]
fn a_run_tells_that_it_lives_unless_it_is_quiet() {
    let run = coarse("bars_parabola").ranks(2);
    let ended = run.clone().converged();
    let last = ended.output.lines().rfind(|line| line.starts_with("mezha: ")).expect("a verdict");
    assert!(last.starts_with("mezha: converged"), "{}", ended.output);
    let passes = ended.value("/outer").as_array().map(Vec::len).expect("a list");
    let told = ended.output.lines().filter(|line| line.trim_start().starts_with(|c: char| c.is_ascii_digit()));
    assert!(passes > 1 && told.count() >= passes, "{}", ended.output);
    let quiet = run.word("--quiet").converged();
    assert_eq!((quiet.output.as_str(), quiet.errors.as_str()), ("", ""));
}

#[test]
fn the_resolved_case_reproduces_the_run() {
    let first = coarse("bars_inclined").set("body.upper.young", "9e3").ranks(2).converged();
    let again = Run::file(&first.out.join("case.toml")).ranks(2).converged();
    let numbers = |path: &str| [first.number(path), again.number(path)];
    for path in ["/energy/total", "/contact/seam/force", "/unknowns/displacement", "/contact/seam/segments", "/solver/residual"] {
        let [a, b] = numbers(path);
        assert!((a - b).abs() <= 1e-12 * a.abs(), "{path}: {a} and {b}");
    }
    let lambda = |run: &support::Ended| run.trace("seam").iter().map(|point| point.lambda).collect::<Vec<_>>();
    assert!(difference(&lambda(&first), &lambda(&again)) <= 1e-12);
    let text = |run: &support::Ended| std::fs::read_to_string(run.out.join("case.toml")).expect("a case");
    assert_eq!(text(&first), text(&again));
}

#[test]
fn petsc_options_reach_their_objects() {
    let run = coarse("bars_inclined").ranks(2);
    let monitored = run.clone().petsc("-ksp_monitor").converged();
    let lines = monitored.output.lines().filter(|line| line.contains("KSP Residual norm")).count();
    assert!(lines > 5, "{}", monitored.output);
    let energy = monitored.number("/energy/total");
    for options in ["-fieldsplit_u_mg_levels_ksp_max_it 2", "-ksp_type fgmres", "-ksp_view", "-log_view"] {
        let ended = run.clone().petsc(options).converged();
        assert!((ended.number("/energy/total") / energy - 1.0).abs() < 1e-9, "{options}");
    }
}

/// A factorisation in place of one multigrid cycle: fewer iterations.
#[test]
fn the_displacement_block_takes_another_preconditioner() {
    let run = coarse("bars_inclined").set("contact.seam.law", "bilateral");
    let multigrid = run.clone().converged().iterations();
    for (ranks, options) in
        [(1, "-fieldsplit_u_pc_type lu"), (2, "-fieldsplit_u_pc_type lu -fieldsplit_u_pc_factor_mat_solver_type mumps")]
    {
        for refine in [0, 2] {
            let run = run.clone().set("mesh.refine", refine).ranks(ranks);
            let ended = run.petsc(options).petsc("-ksp_view").converged();
            let (view, words) = (&ended.output, format!("{options}, refine {refine}"));
            assert!(view.contains("type: lu") && !view.contains("type: mg"), "{words}: {view}");
            assert!(!view.contains("type: hypre"), "{words}: {view}");
            let found = ended.iterations();
            assert!(found < multigrid, "{options}, refine {refine}: {found} against {multigrid} by multigrid");
        }
    }
}

#[test]
fn nothing_leaks() {
    for case in ["bars_inclined", "bars_parabola"] {
        for refine in [0, 2] {
            for solver in ["fieldsplit", "direct"] {
                let run = coarse(case).set("mesh.refine", refine).set("solver.name", solver);
                let ended = run.ranks(2).word("--quiet").petsc("-malloc_debug -malloc_dump -objects_dump").converged();
                assert_eq!(ended.said(), "", "{case}, refine {refine}, {solver}");
            }
        }
    }
}

/// A probe outside its body shows after the solve: the run ends without a result.
#[test]
fn a_late_error_leaves_nothing() {
    for ranks in [1, 2, 3] {
        let run = Run::case("patch_flat").set("probe.far.point", "[9, 9]").set("probe.far.body", "upper").ranks(ranks);
        let ended = run.ended();
        assert_eq!(ended.code, Some(2), "{}", ended.said());
        assert!(ended.errors.contains("probe.far.point"), "{}", ended.errors);
        assert_eq!(ended.left_behind(), Vec::<String>::new());
    }
}

/// Rank 0 finds a file where its folder should be: all ranks end.
#[test]
fn a_folder_that_cannot_be_made_ends_all_ranks() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    std::fs::write(folder.path().join("result"), "a file").expect("a file");
    let ended = Run::case("patch_flat").ranks(3).ended_in(folder);
    assert_eq!(ended.code, Some(2), "{}", ended.said());
    assert!(ended.time < SOON && ended.errors.contains("is not a folder"), "{}", ended.said());
}

/// Ranks of one run with different words: what rank 1 alone cannot do ends rank 0, which would wait for it for ever.
#[test]
fn an_error_on_one_rank_ends_all() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let out = folder.path().join("result").display().to_string();
    let good = case("patch_flat");
    for (bad, code, told) in [
        (format!("run no/case.toml --out {out}"), 2, "no/case.toml"),
        (format!("run {good} --out {out} --set body.lower.young=-1"), 2, "body.lower.young"),
        (format!("run {good} --out {out} --set mesh.file=no.msh"), 2, "no.msh"),
        (format!("run {good} --out {out} -- -ksp_type nonsense"), 1, "nonsense"),
    ] {
        let line = format!("run {good} --out {out} : -n 1 {} {bad}", env!("CARGO_BIN_EXE_mezha"));
        let start = Instant::now();
        let (found, output, errors) = mezha(Some(1), &words(&line));
        assert_eq!(found, Some(code), "{bad}: {output}{errors}");
        assert!(start.elapsed() < SOON && errors.contains(told), "{bad}: {output}{errors}");
        assert!(!folder.path().join("result").exists(), "{bad}: a result is left");
    }
}

/// A solver that does not exist, on every rank alike.
#[test]
fn words_of_petsc_end_the_run() {
    for ranks in [1, 3] {
        let ended = Run::case("patch_flat").ranks(ranks).petsc("-ksp_type nonsense").ended();
        assert_eq!(ended.code, Some(1), "{}", ended.said());
        assert!(ended.time < SOON && ended.errors.contains("nonsense"), "{}", ended.said());
        assert!(!ended.out.exists());
    }
}

#[test]
fn a_missed_value_that_must_hold_is_exit_code_3() {
    for ranks in [1, 2] {
        let ended = Run::case("patch_flat").set("exact.energy.value", "5e-4").set("mesh.refine", 0).ranks(ranks).ended();
        assert_eq!(ended.code, Some(3), "{}", ended.said());
        assert_eq!(ended.value("/status"), Value::from("not_converged"));
        assert!(ended.output.contains("mezha: NOT converged: ") && ended.output.contains("energy"), "{}", ended.output);
    }
}
