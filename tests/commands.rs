//! The commands of `mezha`, what they print, and what they leave on the disk.

use crate::support::{Run, difference, mezha, mezha_in, names_in};
use serde_json::Value;
use std::path::Path;
use std::time::{Duration, Instant};

/// What "ends all ranks" may take.
const SOON: Duration = Duration::from_secs(20);

fn words(line: &str) -> Vec<String> {
    line.split(' ').map(String::from).collect()
}

/// Whether this `mpirun` starts two programs at once: that of Open MPI 5.0.7, Debian 13's, ends with a segmentation fault.
fn starts_two_programs() -> bool {
    let mut command = std::process::Command::new("mpirun");
    command.args(["-n", "1", "--oversubscribe", "true", ":", "-n", "1", "true"]);
    crate::support::process::finish(command).0 == Some(0)
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
        let width = format!(", {}-bit indices", mezha::petsc::Index::BITS);
        for word in [&version, "PETSc 3.", &width, "Open MPI", "BLAS", told] {
            assert_eq!(output.matches(word).count(), 1, "{word} in {output}");
        }
    }
}

#[test]
fn version_names_commit_petsc_and_mpi_once_on_any_number_of_ranks() {
    for (ranks, flag) in [(None, "--version"), (None, "-V"), (Some(2), "--version")] {
        let (code, output, errors) = mezha(ranks, &[flag]);
        assert_eq!((code, output.lines().count()), (Some(0), 3), "{output}{errors}");
        let first = format!("mezha {}, commit {}", env!("CARGO_PKG_VERSION"), mezha::origin::COMMIT);
        assert!(output.starts_with(&first) && output.contains("\nPETSc 3.") && output.contains("\nMPI   Open MPI"), "{output}");
    }
}

#[test]
fn help_has_examples_exit_codes_and_the_place_of_the_keys() {
    for line in [&["--help"][..], &["run", "--help"]] {
        let (code, output, _) = mezha(None, line);
        assert_eq!(code, Some(0));
        for word in ["Examples:\n  mezha ", "mpirun -n 4 mezha run", "Exit codes:\n  0  ", "docs/case.md"] {
            assert!(output.contains(word), "{word} in {output}");
        }
    }
}

/// mpirun gives its ranks terminals of its own, though the words end in a file.
#[test]
fn words_that_mpirun_hands_on_have_no_colours() {
    for (line, code) in [("--help", 0), ("run --help", 0), ("run --forec", 2)] {
        let ended = mezha(Some(2), &words(line));
        let said = format!("{}{}", ended.1, ended.2);
        assert!(ended.0 == Some(code) && said.contains("Usage: mezha"), "{line}: {said}");
        assert!(!said.contains('\u{1b}'), "{line}: {said:?}");
    }
}

#[test]
fn angles_beyond_small_ones_are_warned_of_by_check() {
    let turned = |angle: &str| {
        let set = format!("rigid.punch.angle={angle}");
        mezha(None, &["check", "cases/rigid_tools/flat.toml", "--set", "mesh.refine=0", "--set", &set])
    };
    let (code, _, errors) = turned("7");
    assert!(code == Some(0) && errors.contains("mezha: warning: rigid.punch.angle = 7: radians, of which 0.2"), "{errors}");
    let (code, _, errors) = turned("0.1");
    assert_eq!((code, errors.as_str()), (Some(0), ""));
}

#[test]
fn check_says_what_would_be_solved() {
    let (code, output, errors) = mezha(None, &["check", &case("bars_inclined")]);
    assert_eq!(code, Some(0), "{errors}");
    for word in [
        "bars_inclined",
        "64 macro triangles",
        "16384 P2 triangles",
        "body lower",
        "E = 7000",
        "seam",
        "30 segments",
        "memory: some ",
    ] {
        assert!(output.contains(word), "{word} in {output}");
    }
    assert!(!output.contains("accuracy"), "{output}");
    let set = ["--set", "accuracy=1e-4", "--set", "accuracy.pressure=1e-3"];
    let (code, output, _) = mezha(None, &[&["check", &case("bars_inclined")], &set[..]].concat());
    let words = "accuracy asked for: energy to 1e-4, pressure of seam to 1e-3; the mesh is adapted to it";
    assert!(code == Some(0) && output.lines().any(|line| line == words), "{output}");
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
    let every = ["case.msh", "case.toml", "contacts.csv", "deformed.svg", "report.html", "summary.json"];
    let of_contact = |name: &str| [format!("contact_{name}.csv"), format!("contact_{name}.vtu")].to_vec();
    let figures = |name: &str| {
        let along = ["displacement", "gap", "pressure"].map(|figure| format!("{figure}_{name}.svg"));
        [along.to_vec(), vec![format!("deformed_{name}_1.svg")]].concat()
    };
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
        let tables = ["contact_first.csv", "contact_second.csv", "contacts.csv"];
        assert_eq!(names_in(&bare.out), [&["case.msh", "case.toml"][..], &tables, &["summary.json"]].concat());
        for table in ["contact_first.csv", "contact_second.csv"] {
            let read = |ended: &crate::support::Ended| -> Vec<f64> {
                let text = std::fs::read_to_string(ended.out.join(table)).expect("a table");
                let rows = text.lines().skip_while(|line| line.starts_with('#')).skip(1);
                rows.flat_map(|row| row.split(',').map(|number| number.parse().expect("a number")).collect::<Vec<f64>>())
                    .collect()
            };
            assert!(read(&whole).len() > 100 && difference(&read(&bare), &read(&whole)) < 1e-9, "{table}");
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
    let lambda = |run: &crate::support::Ended| run.trace("seam").iter().map(|point| point.lambda).collect::<Vec<_>>();
    assert!(difference(&lambda(&first), &lambda(&again)) <= 1e-12);
    let text = |run: &crate::support::Ended| std::fs::read_to_string(run.out.join("case.toml")).expect("a case");
    assert_eq!(text(&first), text(&again));
}

#[test]
fn petsc_options_reach_their_objects() {
    let run = coarse("bars_inclined").ranks(2);
    let monitored = run.clone().petsc("-ksp_monitor").converged();
    let lines = monitored.output.lines().filter(|line| line.contains("KSP Residual norm")).count();
    assert!(lines > 5, "{}", monitored.output);
    let energy = monitored.number("/energy/total");
    for options in
        ["-fieldsplit_u_ksp_type gmres -fieldsplit_u_ksp_max_it 2 -ksp_type fgmres", "-ksp_type fgmres", "-ksp_view", "-log_view"]
    {
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

/// Where there are no multipliers, field `u` is the whole system.
#[test]
fn a_body_without_contact_takes_another_preconditioner() {
    let run = Run::case("hot_cylinder");
    let energy = run.clone().converged().number("/energy/total");
    for (ranks, options) in [(1, "-fieldsplit_u_pc_type gamg"), (2, "-fieldsplit_u_pc_type gamg -ksp_type gmres")] {
        let ended = run.clone().ranks(ranks).petsc(options).petsc("-ksp_view").converged();
        assert!(ended.output.contains("type: gamg"), "{}", ended.output);
        assert!((ended.number("/energy/total") / energy - 1.0).abs() < 1e-6, "{options}");
    }
}

#[test]
fn nothing_leaks() {
    for case in ["bars_inclined", "bars_parabola"] {
        for refine in [0, 2] {
            for solver in ["fieldsplit", "direct"] {
                let run = coarse(case).set("mesh.refine", refine).set("solver.name", solver);
                let ended = run.ranks(2).word("--quiet").petsc("-malloc_debug -malloc_dump -objects_dump").converged();
                // On meshes as coarse as these pressures are not to be trusted: that is no leak.
                let said = ended.said();
                let is_of_pressure =
                    |line: &&str| ["pressure unreliable", "error of its pressure"].iter().any(|words| line.contains(words));
                let other: Vec<&str> = said.lines().filter(|line| !is_of_pressure(line)).collect();
                assert!(other.is_empty(), "{case}, refine {refine}, {solver}: {other:?}");
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
    assert!(ended.time < SOON && ended.errors.contains("is no folder, or a link to one"), "{}", ended.said());
}

/// Ranks of one run with different words: all end, and are told which.
#[test]
fn ranks_with_different_words_do_not_start() {
    if !starts_two_programs() {
        eprintln!("this mpirun cannot start two programs at once: nothing is tested");
        return;
    }
    let folder = tempfile::tempdir().expect("a temporary folder");
    let out = folder.path().join("result").display().to_string();
    let good = format!("run {} --out {out}", case("patch_flat"));
    for bad in [
        format!("run no/case.toml --out {out}"),
        format!("{good} --set body.lower.young=-1"),
        format!("{good} -- -ksp_type nonsense"),
        format!("{good} -- -log_view"),
        "info".into(),
        format!("check {}", case("patch_flat")),
        "--help".into(),
    ] {
        let line = format!("{good} : -n 1 {} {bad}", env!("CARGO_BIN_EXE_mezha"));
        let start = Instant::now();
        let (found, output, errors) = mezha(Some(2), &words(&line));
        assert_eq!(found, Some(2), "{bad}: {output}{errors}");
        let told = format!("rank 2 was started with other words than rank 0: `{bad}`");
        assert!(start.elapsed() < SOON && errors.matches(&told).count() == 1, "{bad}: {output}{errors}");
        assert_eq!(names_in(folder.path()), Vec::<String>::new(), "{bad}: a result is left");
    }
}

/// What rank 0 alone cannot do ends the others, which would wait for it for ever.
#[test]
fn an_error_on_one_rank_ends_all() {
    for (solver, option) in [("direct", "-ksp_view"), ("fieldsplit", "-ksp_view"), ("direct", "-mat_view")] {
        let run = Run::case("patch_flat").ranks(3).set("solver.name", solver);
        let ended = run.petsc(&format!("{option} :no/such/folder/x.txt")).ended();
        assert_eq!(ended.code, Some(1), "{}", ended.said());
        assert!(ended.time < SOON && ended.errors.contains("mezha: ") && ended.errors.contains("no/such/folder"));
        assert!(!ended.out.exists());
    }
}

/// PETSc fails on rank 0 before it has told the others what to do.
#[test]
fn a_start_of_petsc_that_fails_ends_all_ranks() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let line = format!("run {} --out result", case("patch_flat"));
    for (options, file, told) in [
        (" -- -options_file /no/such/file", "", "Unable to open options file /no/such/file"),
        (" -- -log_trace /no/such/file", "", "Unable to open trace file: /no/such/file"),
        (" -- -help intro", "", "a library has ended the program"),
        ("", "unreadable \" words\n", "Unknown first token in options file"),
    ] {
        std::fs::write(folder.path().join(".petscrc"), file).expect("a file");
        for ranks in [None, Some(1), Some(2), Some(3)] {
            let start = Instant::now();
            let (code, output, errors) = mezha_in(folder.path(), ranks, &words(&format!("{line}{options}")));
            assert_eq!(code, Some(1), "{options} {ranks:?}: {output}{errors}");
            let said = errors.lines().any(|line| line.trim_start().starts_with("mezha: ") && line.contains(told));
            assert!(start.elapsed() < SOON && said, "{options} {ranks:?}: {output}{errors}");
            assert_eq!(names_in(folder.path()), [".petscrc"]);
        }
    }
}

/// PETSc fails at its end, on rank 0 alone or on all, when the result is there.
#[test]
fn an_end_of_petsc_that_fails_is_no_success() {
    for options in ["-log_view :no/such/folder/x.txt", "-malloc_view no/such/folder/x"] {
        for run in [1, 2, 3].map(|ranks| Run::case("patch_flat").set("mesh.refine", 0).ranks(ranks)) {
            let ended = run.petsc(options).ended();
            assert_eq!(ended.code, Some(1), "{options}: {}", ended.said());
            let told = "; the result is written and whole, but what PETSc was asked to say at its end is not";
            assert!(ended.time < SOON && ended.errors.contains(told), "{options}: {}", ended.said());
            assert!(ended.errors.contains("no/such/folder/x"), "{options}: {}", ended.said());
            assert_eq!(ended.value("/status"), "converged");
            assert_eq!(ended.left_behind(), ["result"]);
        }
    }
}

/// Rank 1 would find another case and another mesh under the same names: it works on those of rank 0.
#[test]
fn all_ranks_work_on_what_rank_0_has_read() {
    if !starts_two_programs() {
        eprintln!("this mpirun cannot start two programs at once: nothing is tested");
        return;
    }
    let folders = [1.0, 1.7].map(|pressure| {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let original = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/patch_flat");
        let text = std::fs::read_to_string(original.join("case.toml")).expect("a case").replace("must_hold = true", "");
        let text = text.replace("pressure = 1.0", &format!("pressure = {pressure}"));
        std::fs::write(folder.path().join("case.toml"), text).expect("a file");
        let mesh = std::fs::read(original.join("blocks.msh")).expect("a mesh");
        let mesh = if pressure == 1.0 { mesh } else { mesh[..mesh.len() / 2].to_vec() };
        std::fs::write(folder.path().join("blocks.msh"), mesh).expect("a file");
        folder
    });
    let [here, there] = [folders[0].path(), folders[1].path()];
    let line = "run case.toml --out result";
    let elsewhere = format!(" : -n 2 -wdir {} {} {line}", there.display(), env!("CARGO_BIN_EXE_mezha"));
    let (code, output, errors) = mezha_in(here, Some(1), &words(&format!("{line}{elsewhere}")));
    assert_eq!(code, Some(0), "{output}{errors}");
    let text = std::fs::read_to_string(here.join("result/summary.json")).expect("a summary");
    let summary: Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(summary["ranks"], 3);
    let force = summary["contact"]["seam"]["force"].as_f64().expect("a force");
    assert!((force - 2.0).abs() < 1e-8, "{force}");
    assert!((0..3).all(|rank| here.join(format!("result/fields_000{rank}.vtu")).is_file()));
    assert_eq!(names_in(there), ["blocks.msh", "case.toml"]);
}

/// Runs that are started at the same time: the folder is of one of them, and the others are told.
#[test]
fn a_folder_is_of_one_run() {
    let (rounds, mut told) = (8, 0);
    for (round, force) in (0..rounds).flat_map(|round| [(round, false), (round, true)]) {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let run = |load: usize| {
            let line = format!("run {} --out result --quiet --set load.top.pressure={load}", case("patch_flat"));
            let more = " --set exact.must_hold=false --set mesh.refine=1";
            let line = line + more + if force { " --force" } else { "" };
            mezha_in(folder.path(), if round == 0 { Some(2) } else { None }, &words(&line))
        };
        let ended: Vec<_> = std::thread::scope(|scope| {
            let runs: Vec<_> = (1..=3).map(|load| scope.spawn(move || run(load))).collect();
            runs.into_iter().map(|run| run.join().expect("a run ends")).collect()
        });
        for (code, _, errors) in ended.iter().filter(|(code, _, _)| *code != Some(0)) {
            let words =
                if *code == Some(1) { "another run, or somebody else, has put files into" } else { "already holds a result" };
            assert!(errors.contains(words) && (*code == Some(1) || !force && *code == Some(2)), "{code:?}: {errors}");
            told += usize::from(*code == Some(1));
        }
        let won = ended.iter().filter(|(code, _, _)| *code == Some(0)).count();
        assert!(won == 1 || force && won > 1, "{won} runs have won");
        // Those that came too late lie beside it.
        let late = ended.iter().filter(|(code, _, _)| *code == Some(1)).count();
        assert_eq!(names_in(folder.path()).len(), 1 + late, "{:?}", names_in(folder.path()));
        let read = |name: &str| std::fs::read_to_string(folder.path().join("result").join(name)).expect(name);
        let summary: Value = serde_json::from_str(&read("summary.json")).expect("JSON");
        let load = summary["contact"]["seam"]["force"].as_f64().expect("a force") / 2.0;
        let table = read("contact_seam.csv");
        let lambda: f64 = table.lines().next_back().and_then(|line| line.split(',').nth(5)?.parse().ok()).expect("a number");
        assert!((lambda / load - 1.0).abs() < 1e-6, "λ = {lambda} beside a load of {load}");
        assert!(read("case.toml").contains(&format!("pressure = {load:.0}\n")), "{load}: {}", read("case.toml"));
    }
    assert!(told > 0, "no two runs of {rounds} rounds have met");
}

/// A run that was killed leaves half a result under a name of its own; the next one clears it away.
#[test]
fn what_a_killed_run_has_left_is_cleared_away() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let line = format!("run {} --out result --quiet", case("patch_flat"));
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_mezha"));
    command.args(words(&format!("{line} --set mesh.refine=6"))).current_dir(folder.path());
    let mut child = command.spawn().expect("mezha starts");
    while names_in(folder.path()).is_empty() {
        assert!(child.try_wait().expect("a child").is_none());
        std::thread::sleep(Duration::from_millis(2));
    }
    child.kill().expect("a child can be killed");
    child.wait().expect("a child can be waited for");
    let left = names_in(folder.path());
    assert!(left.len() == 1 && left[0].starts_with(".result.") && left[0].ends_with(".partial"), "{left:?}");
    let (code, _, errors) = mezha_in(folder.path(), Some(2), &words(&line));
    assert_eq!((code, names_in(folder.path())), (Some(0), vec!["result".into()]), "{errors}");
}

/// Under a limit to the memory of each process a mesh that is too fine is refused before anything large is taken, with the
/// refinement that fits; nothing is left of the run. One that fits is solved.
#[test]
fn a_mesh_that_memory_is_too_small_for_is_refused_with_the_refinement_that_fits() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = format!("{}/cases/bars_inclined/even.toml", env!("CARGO_MANIFEST_DIR"));
    let limited = |ranks: usize, order: usize, refine: usize| {
        let mezha = env!("CARGO_BIN_EXE_mezha");
        let settings = "--set contact.seam.segments=auto --set exact.must_hold=false --set output.fields=false --quiet --force";
        let line = format!("run {file} --out result --set mesh.refine={refine} --set mesh.order={order} {settings}");
        let mpirun = format!("mpirun -n {ranks} --oversubscribe --bind-to none {mezha} {line}");
        let mut command = std::process::Command::new("sh");
        command.args(["-c", &format!("ulimit -v 2500000 && exec {mpirun}")]).current_dir(folder.path());
        crate::support::process::finish(command)
    };
    for (ranks, order) in [(1, 1), (2, 2)] {
        let (code, _, errors) = limited(ranks, order, 9 + 2 - order);
        assert_eq!(code, Some(2), "{errors}");
        let told = ["even.toml: mesh.refine = ", "unknowns take some", " GB of memory, and ", " fits, with "];
        assert!(told.iter().all(|words| errors.contains(words)), "{errors}");
        assert_eq!(names_in(folder.path()), Vec::<String>::new(), "nothing is left");
    }
    let (code, _, errors) = limited(2, 1, 4);
    assert_eq!(code, Some(0), "{errors}");
}

/// Nobody listens: the exit code is what it would be.
#[test]
fn words_that_nobody_can_read_change_nothing() {
    let full = || std::fs::File::options().write(true).open("/dev/full").expect("/dev/full");
    let good = case("patch_flat");
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (line, code) in [
        (format!("run {good} --out result --set mesh.refine=0"), 0),
        (format!("run {good} --out other --set body.lower.young=-1"), 2),
        (format!("run {good} --out lifted --set load.top.pressure=-1.0 --quiet"), 3),
        (format!("check {good} --set mesh.file=no.msh"), 2),
        (format!("check {good}"), 1),
        ("info".into(), 1),
    ] {
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_mezha"));
        command.args(words(&line)).current_dir(folder.path()).stdout(full()).stderr(full());
        assert_eq!(command.status().expect("mezha starts").code(), Some(code), "{line}");
    }
}

/// A solver that does not exist, on every rank alike.
#[test]
fn words_of_petsc_end_the_run() {
    for (options, code, told) in [
        ("-pc_type nonsense", 1, "nonsense"),
        ("-ksp_type nonsense", 2, "-ksp_type nonsense: the outer method is one"),
        ("-ksp_type preonly", 2, "gmres, fgmres"),
        ("-ksp_type richardson", 2, "gmres, fgmres"),
        ("-fieldsplit_u_pc_mg_levels 50", 2, "mesh.refine"),
        ("-fieldsplit_u_pc_type mg", 2, "mezha's own cycle"),
        ("-fp_trap", 2, "-fp_trap"),
    ] {
        for ranks in [1, 3] {
            let ended = Run::case("patch_flat").ranks(ranks).petsc(options).with_grace().ended();
            assert_eq!(ended.code, Some(code), "{}", ended.said());
            assert!(ended.time < SOON && ended.errors.contains(told), "{}", ended.said());
            assert_eq!(ended.left_behind(), Vec::<String>::new());
        }
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
