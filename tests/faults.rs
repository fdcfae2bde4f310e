//! What hosts do to runs: starts at the same time, memory and files that are limited, variables that others have set. The long
//! form is `ci/faults`.

use crate::support::mesh::Mesh;
use crate::support::process::finish;
use crate::support::{is_long, names_in};
use serde_json::Value;
use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;

const MEZHA: &str = env!("CARGO_BIN_EXE_mezha");

/// Runs a line of `sh` in a folder.
fn shell(folder: &Path, line: &str) -> (Option<i32>, String, String) {
    let mut command = Command::new("sh");
    command.args(["-c", line]).current_dir(folder);
    finish(command)
}

fn case(name: &str) -> String {
    format!("{}/cases/{name}", env!("CARGO_MANIFEST_DIR"))
}

/// Processes without mpirun have no folder of MPI's in common, even where they share the one for temporary files.
#[test]
fn many_starts_at_once_do_not_meet() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let line = format!("seq 40 | xargs -P 8 -I{{}} sh -c '{MEZHA} info > /dev/null || echo failed'");
    let (code, output, errors) = shell(folder.path(), &line);
    assert_eq!((code, output.as_str()), (Some(0), ""), "{errors}");
}

/// Memory that nobody has forecast: no abort, and words that say so, whoever did not get it.
#[test]
fn memory_that_is_refused_is_told_as_such() {
    let bars = case("bars_inclined/even.toml");
    let settings = "--set contact.seam.segments=auto --set exact.must_hold=false --set accuracy.energy=1e-6 --set accuracy.max_unknowns=1000000";
    // The first one is too little for BLAS, which would ask again for ever.
    for megabytes in [230, 350, 400, 460] {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let line =
            format!("ulimit -v {megabytes}000 && exec {MEZHA} run {bars} {settings} --set mesh.refine=5 --out result --quiet");
        let (code, _, errors) = shell(folder.path(), &line);
        assert_eq!(code, Some(1), "{megabytes}: {errors}");
        assert!(errors.contains("mezha: memory: "), "{megabytes}: {errors}");
        assert_eq!(names_in(folder.path()), Vec::<String>::new(), "{megabytes}: something is left");
    }
}

#[test]
fn a_check_tells_what_a_run_takes_and_that_it_is_too_much() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let check = format!("exec {MEZHA} check {} --set mesh.order=1 --set mesh.refine=9", case("bars_inclined/even.toml"));
    let (code, output, errors) = shell(folder.path(), &format!("ulimit -v 1500000 && {check}"));
    assert!(output.contains("memory: some ") && output.contains(" GB on one rank"), "{output}");
    assert!(errors.contains("mezha: warning: a run takes some ") && errors.contains("it would be refused here"), "{errors}");
    assert_eq!(code, Some(0), "{errors}");
}

/// The forecast is what a run takes, to a quarter: of rows that are worked on as a whole, of such as all lie in a fine mesh of the
/// file, and of those of boundaries that move and tools.
#[test]
fn the_forecast_of_memory_is_true() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let fine = folder.path().join("fine.msh");
    std::fs::write(&fine, Mesh::inclined_bars(28).text()).expect("a mesh can be written");
    let bars = format!("{} --set contact.seam.segments=auto --set exact.must_hold=false", case("bars_inclined/even.toml"));
    forecast_is_true(folder.path(), &format!("{bars} --set mesh.refine=5"));
    forecast_is_true(folder.path(), &format!("{bars} --set mesh.refine=0 --set mesh.file={}", fine.display()));
    forecast_is_true(folder.path(), &format!("{} --set mesh.refine=5 --set output.fields=false", case("rigid_strip/case.toml")));
}

fn forecast_is_true(folder: &Path, words: &str) {
    let (_, output, _) = shell(folder, &format!("{MEZHA} check {words}"));
    let told = output.lines().find_map(|line| line.strip_prefix("memory: some ")).expect("a forecast");
    let numbers: Vec<&str> = told.split_whitespace().collect();
    let amount = |unit: &(usize, &&str)| ["MB", "GB"].contains(unit.1);
    let mut amounts = numbers.iter().enumerate().filter(amount).map(|(at, unit)| {
        let number: f64 = numbers[at - 1].parse().expect("a number");
        if *unit == "GB" { 1e3 * number } else { number }
    });
    let [first, further] = [(); 2].map(|()| amounts.next().expect("an amount"));
    for (ranks, forecast) in [(1, first), (2, first + further)] {
        let run = format!("mpirun -n {ranks} --oversubscribe --bind-to none {MEZHA} run {words} --out result --force --quiet");
        let (code, _, errors) = shell(folder, &run);
        assert_eq!(code, Some(0), "{errors}");
        let text = std::fs::read_to_string(folder.join("result/summary.json")).expect("a summary");
        let summary: Value = serde_json::from_str(&text).expect("JSON");
        let taken = summary["memory_mib"]["sum"].as_f64().expect("a number") * 1.048576;
        assert!((forecast / taken - 1.0).abs() < 0.25, "{words} on {ranks}: {forecast} MB forecast, {taken:.0} MB taken");
    }
}

/// A file that grows beyond `ulimit -f` is told, and is no signal.
#[test]
fn files_that_are_limited_end_a_run_in_order() {
    // Under mpirun the limit is first that of MPI's own files.
    let folder = tempfile::tempdir().expect("a temporary folder");
    let run = format!("{MEZHA} run {} --set mesh.refine=1 --out deep/result --quiet", case("patch_flat/case.toml"));
    let (code, _, errors) = shell(folder.path(), &format!("ulimit -f 3 && exec {run}"));
    assert_eq!(code, Some(1), "{errors}");
    assert!(errors.contains("mezha: cannot ") && errors.contains("File too large"), "{errors}");
    assert_eq!(names_in(folder.path()), Vec::<String>::new(), "something is left");
}

/// What libraries do not survive is told before they start: a stack that overflows in MPI, and files too small for what its ranks share.
#[test]
fn limits_that_mpi_does_not_survive_are_told() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let info = format!("exec {MEZHA} info");
    let ranks = format!("exec mpirun -n 2 --oversubscribe --bind-to none sh -c 'ulimit -f 2000 && {info}'");
    for (line, words) in [
        (format!("ulimit -s 64 && {info}"), "the stack may have 65536 bytes here, and 131072 at least are wanted: say ulimit -s"),
        (ranks, "the files of MPI may have 1024000 bytes here, and 8388608 at least are wanted: say ulimit -f"),
    ] {
        let (code, output, errors) = shell(folder.path(), &line);
        assert!(code == Some(1) && errors.contains(words), "{line}: {code:?}: {output}{errors}");
        assert_eq!(errors.matches("at least are wanted").count(), 1, "rank 0 speaks for all: {errors}");
    }
}

/// Fields are the largest files: a run that has no room for them has a result without.
#[test]
fn a_result_for_which_there_is_no_room_has_no_fields() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let run = format!("{MEZHA} run {} --set mesh.refine=4 --out result --quiet", case("patch_flat/case.toml"));
    let (code, _, errors) = shell(folder.path(), &format!("ulimit -f 300 && exec {run}"));
    assert_eq!(code, Some(0), "{errors}");
    assert!(errors.contains("mezha: warning: there are no fields in the result: cannot write"), "{errors}");
    let names = names_in(&folder.path().join("result"));
    assert!(names.contains(&"summary.json".into()) && !names.contains(&"fields.vtu".into()), "{names:?}");
}

/// A limit below figures and report takes these alone: the numbers are there, and the summary lists what is.
#[test]
fn a_result_for_which_there_is_little_room_has_its_numbers() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let run = format!("{MEZHA} run {} --set mesh.refine=3 --out result --quiet", case("patch_flat/case.toml"));
    let (code, _, errors) = shell(folder.path(), &format!("ulimit -f 20 && exec {run}"));
    assert_eq!(code, Some(0), "{errors}");
    for file in ["deformed_seam_1.svg", "report.html"] {
        let told =
            errors.lines().any(|line| line.contains("a file is missing in the result: cannot write") && line.contains(file));
        assert!(told && errors.contains("; make room there (ulimit -f, quota, disk)"), "{file}: {errors}");
    }
    let names = names_in(&folder.path().join("result"));
    let has = |name: &str| names.contains(&name.into());
    assert!(["summary.json", "contacts.csv", "case.toml"].into_iter().all(has), "{names:?}");
    assert!(!has("deformed_seam_1.svg") && has("gap_seam.svg") && !has("report.html") && !has("fields.vtu"), "{names:?}");
    let text = std::fs::read_to_string(folder.path().join("result/summary.json")).expect("a summary");
    let summary: Value = serde_json::from_str(&text).expect("JSON");
    assert!(!summary["files"].to_string().contains("report.html"), "{text}");
}

/// Where a system is factorised and small, each rank does so by itself: MUMPS adds in the order in which messages come.
#[test]
fn the_same_command_gives_the_same_digits() {
    let settings = "--set mesh.order=1 --set exact.must_hold=false --set contact.seam.segments=auto --quiet --force";
    for (refine, times) in [(0, 8), (2, 4)] {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let run = format!("run {} {settings} --set mesh.refine={refine} --out result", case("bars_inclined/even.toml"));
        let found: BTreeSet<String> = (0..times)
            .map(|_| {
                let (code, _, errors) =
                    shell(folder.path(), &format!("mpirun -n 2 --oversubscribe --bind-to none {MEZHA} {run}"));
                assert_eq!(code, Some(0), "{errors}");
                let read = |name: &str| std::fs::read_to_string(folder.path().join("result").join(name)).expect(name);
                let mut summary: Value = serde_json::from_str(&read("summary.json")).expect("JSON");
                let all = summary.as_object_mut().expect("a table");
                ["time_s", "memory_mib", "provenance"].iter().for_each(|name| drop(all.remove(*name)));
                format!("{summary:#}\n{}{}", read("contact_seam.csv"), read("fields_0001.vtu"))
            })
            .collect();
        assert_eq!(found.len(), 1, "refine {refine}: different digits");
    }
}

/// Where three ranks and more know a part of a node's value, the order of the sum is not that of the messages: an adapted mesh
/// begins from such sums.
#[test]
fn an_adapted_run_on_four_ranks_gives_the_same_digits() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let settings = "--set mesh.order=2 --set mesh.refine=1 --set accuracy.energy=1e-2 --set accuracy.max_unknowns=20000";
    let run =
        format!("run {} {settings} --set exact.must_hold=false --quiet --force --out result", case("bars_parabola/case.toml"));
    let found: BTreeSet<String> = (0..if is_long() { 6 } else { 3 })
        .map(|_| {
            let (code, _, errors) = shell(folder.path(), &format!("mpirun -n 4 --oversubscribe --bind-to none {MEZHA} {run}"));
            assert_eq!(code, Some(0), "{errors}");
            let read = |name: &str| std::fs::read_to_string(folder.path().join("result").join(name)).expect(name);
            let summary: Value = serde_json::from_str(&read("summary.json")).expect("JSON");
            let [energy, contact] = ["energy", "contact"].map(|key| &summary[key]);
            format!("{energy}\n{contact}\n{}", read("contact_seam.csv"))
        })
        .collect();
    assert_eq!(found.len(), 1, "different digits");
}

/// A rank without a number of ranks is none of mpirun's.
#[test]
fn a_rank_that_somebody_else_has_set_silences_nothing() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for words in ["check nosuch.toml", "run nosuch.toml", "nonsense"] {
        let (code, _, errors) = shell(folder.path(), &format!("PMI_RANK=1 {MEZHA} {words}"));
        assert!(code == Some(2) && !errors.is_empty(), "{words}: {code:?} {errors}");
    }
}
