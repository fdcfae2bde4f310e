//! A result tells what made it, and its folder alone repeats the run.

use crate::support::{mezha_in, names_in};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// A folder with copies of the files of a case of the project, in `source/scene`.
fn copied(case: &str, files: &[&str]) -> TempDir {
    let root = tempfile::tempdir().expect("a temporary folder");
    let (from, to) = (Path::new(env!("CARGO_MANIFEST_DIR")).join(case), root.path().join("source/scene"));
    std::fs::create_dir_all(&to).expect("a folder");
    for file in files {
        std::fs::copy(from.join(file), to.join(file)).expect("a copy");
    }
    root
}

/// Runs mezha with words that are separated by blanks; it must converge.
fn run(root: &Path, ranks: usize, line: &str) -> String {
    let words: Vec<&str> = line.split(' ').collect();
    let (code, output, errors) = mezha_in(root, Some(ranks), &words);
    assert_eq!(code, Some(0), "{line}: {output}{errors}");
    output + &errors
}

fn summary(folder: &Path) -> Value {
    let text = std::fs::read_to_string(folder.join("summary.json")).expect("a summary");
    serde_json::from_str(&text).expect("JSON")
}

/// All files of a result and of its steps, without times, of which the reason of an adapted run has one, and provenance.
fn digits(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut found = BTreeMap::new();
    let mut folders = vec![PathBuf::new()];
    while let Some(inner) = folders.pop() {
        for name in names_in(&folder.join(&inner)) {
            let path = inner.join(name);
            match std::fs::read(folder.join(&path)) {
                Ok(bytes) => drop(found.insert(path, bytes)),
                Err(_) => folders.push(path),
            }
        }
    }
    // A report tells times and provenance, too.
    found.remove(Path::new("report.html"));
    // The last column of the table of steps has times.
    if let Some(table) = found.get_mut(Path::new("steps.csv")) {
        let text = String::from_utf8_lossy(table).into_owned();
        let rows = text.lines().filter_map(|line| line.rsplit_once(',').map(|(rest, _)| rest));
        *table = rows.collect::<Vec<_>>().join("\n").into_bytes();
    }
    let mut summary = summary(folder);
    without_times(&mut summary);
    found.insert("summary.json".into(), summary.to_string().into_bytes());
    found
}

fn without_times(value: &mut Value) {
    match value {
        Value::Object(table) => {
            ["time_s", "memory_mib", "provenance", "seconds", "reason"].iter().for_each(|name| drop(table.remove(*name)));
            table.values_mut().for_each(without_times);
        }
        Value::Array(list) => list.iter_mut().for_each(without_times),
        _ => {}
    }
}

/// The source of the case is gone, and the result lies elsewhere.
#[test]
fn a_result_folder_alone_repeats_its_run() {
    let first = ["case.toml", "strip.msh"];
    let steps = ["case.toml", "blocks.msh"];
    let small = "--set mesh.refine=1";
    let changed = "--set mesh.refine=1 --set body.strip.young=9e4 --set contact.seam.segments=7";
    let accurate =
        "--set mesh.refine=1 --set accuracy.energy=0.008 --set accuracy.max_unknowns=50000 --set exact.must_hold=false";
    for (case, files, words, options, ranks) in [
        ("docs/first", first, small, "", 1),
        ("docs/first", first, changed, " -- -ksp_type gcr", 2),
        ("docs/first", first, accurate, "", 2),
        ("cases/closing_gap", steps, small, "", 2),
    ] {
        let root = copied(case, &files);
        let root = root.path();
        run(root, ranks, &format!("run source/scene/case.toml --out first/scene {words}{options}"));
        let before = digits(&root.join("first/scene"));
        std::fs::remove_dir_all(root.join("source")).expect("a folder");
        std::fs::create_dir(root.join("copy")).expect("a folder");
        std::fs::rename(root.join("first/scene"), root.join("copy/scene")).expect("a folder");
        let said = run(root, ranks, &format!("run copy/scene --out again/scene{options}"));
        assert!(said.contains("repeats the result beside the case file"), "{said}");
        let again = digits(&root.join("again/scene"));
        assert_eq!(before.keys().collect::<Vec<_>>(), again.keys().collect::<Vec<_>>());
        let other: Vec<_> = before.keys().filter(|name| before[*name] != again[*name]).collect();
        assert!(other.is_empty(), "{case} {words}, {ranks} ranks: {other:?}");
        let [then, now] = ["copy/scene", "again/scene"].map(|folder| summary(&root.join(folder))["provenance"].clone());
        for key in ["case_hash", "mesh_hash", "petsc_options", "ranks", "petsc", "mpi", "blas", "cpu", "host"] {
            assert!(!then[key].is_null() && then[key] == now[key], "{key}: {then} {now}");
        }
        if case == "cases/closing_gap" {
            a_changed_mesh_is_refused_for_a_step(root);
        }
    }
}

/// A load step names the mesh of its result; `check` refuses what `run` refuses.
fn a_changed_mesh_is_refused_for_a_step(root: &Path) {
    let checked = |more: &[&str]| mezha_in(root, None, &[&["check", "copy/scene/steps/0001"], more].concat());
    assert_ne!(checked(&[]).0, Some(2));
    let mesh = root.join("copy/scene/case.msh");
    let text = std::fs::read_to_string(&mesh).expect("a mesh");
    std::fs::write(&mesh, text + "\n").expect("a file");
    let run = mezha_in(root, None, &["run", "copy/scene/steps/0001", "--out", "never"]);
    for (code, _, errors) in [run, checked(&[])] {
        assert!(code == Some(2) && errors.contains("the result with this load step"), "{code:?} {errors}");
    }
    assert_ne!(checked(&["--set", "mesh.refine=0"]).0, Some(2), "another case");
}

#[test]
fn what_is_not_the_same_run_is_told() {
    let root = copied("docs/first", &["case.toml", "strip.msh"]);
    let root = root.path();
    let coarse = "--set mesh.refine=1 --set output.fields=false";
    run(root, 1, &format!("run source/scene --out result {coarse} -- -ksp_type gcr"));
    let provenance = &summary(&root.join("result"))["provenance"];
    assert_eq!(provenance["petsc_options"], "-ksp_type gcr");
    let command = provenance["command"].as_str().expect("a command");
    assert!(command.ends_with("-- -ksp_type gcr") && !command.starts_with("mpirun"), "{command}");
    let date = provenance["date"].as_str().expect("a date");
    assert!(date.len() == 20 && date.starts_with("20") && date.ends_with('Z'), "{date}");

    let said = run(root, 1, "run result --out bare");
    assert!(
        said.contains("warning: not the same run") && said.contains("mezha run result/case.toml -- -ksp_type gcr` repeats"),
        "{said}"
    );
    let said = run(root, 2, "run result --out wider -- -ksp_type gcr");
    assert!(said.contains("ranks: 2 instead of 1") && !said.contains("warning"), "{said}");
    let said = run(root, 1, "run result --out other --set contact.seam.segments=5");
    assert!(!said.contains("the result beside"), "another case: {said}");

    let mesh = root.join("result/case.msh");
    let text = std::fs::read_to_string(&mesh).expect("a mesh");
    std::fs::write(&mesh, text + "\n").expect("a file");
    let (code, _, errors) = mezha_in(root, Some(2), &["run", "result", "--out", "never"]);
    assert_eq!(code, Some(2), "{errors}");
    let hash = provenance["mesh_hash"].as_str().expect("a hash");
    assert!(
        ["result/case.toml: mesh.file", "has changed", hash, "put the old mesh back"].iter().all(|word| errors.contains(word)),
        "{errors}"
    );
    assert_eq!(errors.matches("mezha: ").count(), 1, "{errors}");
    assert!(!root.join("never").exists());
    let (code, _, errors) = mezha_in(root, None, &["check", "result"]);
    assert!(code == Some(2) && errors.contains("has changed"), "{errors}");

    let said = run(root, 1, "run result --out another --set mesh.file=../source/scene/strip.msh");
    assert!(!said.contains("the result beside"), "another mesh file: {said}");
    let (code, output, errors) = mezha_in(root, None, &["check", "another"]);
    assert_eq!(code, Some(0), "{output}{errors}");
}

/// A mesh above 4 MiB is not copied, but where it lies in the result that is replaced there may be no other. Files of the user's
/// stay, whatever their names are.
#[test]
fn replacing_a_result_keeps_what_it_has_not_written() {
    let root = copied("docs/first", &["case.toml", "strip.msh"]);
    let root = root.path();
    let coarse = "--set mesh.refine=1 --set output.fields=false";
    run(root, 1, &format!("run source/scene --out result {coarse} --set title=first"));
    let result = root.join("result");
    let written = names_in(&result);
    let files: Vec<String> = serde_json::from_value(summary(&result)["files"].clone()).expect("a list");
    assert_eq!(files, written);
    let mesh = std::fs::read_to_string(result.join("case.msh")).expect("a mesh") + &"\n".repeat(5 << 20);
    std::fs::write(result.join("case.msh"), &mesh).expect("a file");
    let mine = ["case_mine.toml", "contact_measured.csv", "steps/mine.txt", "summary_mine.json"];
    std::fs::create_dir(result.join("steps")).expect("a folder");
    mine.iter().for_each(|name| std::fs::write(result.join(name), name).expect("a file"));
    run(root, 1, "run result --set title=second --out result/. --force");
    assert_eq!(summary(&result)["files"], serde_json::json!(files));
    mine.iter().for_each(|name| assert_eq!(&std::fs::read_to_string(result.join(name)).expect("a file"), name));
    assert!(std::fs::read_to_string(result.join("case.msh")).expect("a mesh") == mesh, "the large mesh is gone");
    let said = run(root, 1, "run result --out again");
    assert!(said.contains("repeats the result beside the case file"), "{said}");
    assert!(!root.join("again/case.msh").exists());
}

/// Runs of a study lie in folders like any other.
#[test]
fn a_run_of_a_study_is_repeated() {
    let root = copied("docs/first", &["case.toml", "strip.msh"]);
    let root = root.path();
    let study = "cases = ['scene/case.toml']\nranks = [2]\nerror = 'errors.force_seam'\n[grid]\n'mesh.refine' = [0, 1]\n";
    std::fs::write(root.join("source/study.toml"), study).expect("a file");
    let (code, output, errors) = mezha_in(root, None, &["study", "source", "--out", "made"]);
    assert_eq!(code, Some(0), "{output}{errors}");
    std::fs::remove_dir_all(root.join("source")).expect("a folder");
    let runs = names_in(&root.join("made/runs"));
    let folders: Vec<&String> = runs.iter().filter(|name| root.join("made/runs").join(name).is_dir()).collect();
    assert_eq!(folders.len(), 2, "{runs:?}");
    let name = folders[1];
    let said = run(root, 2, &format!("run made/runs/{name} --out again/{name}"));
    assert!(said.contains("repeats the result beside the case file"), "{said}");
    let mut before = digits(&root.join("made/runs").join(name));
    let mut again = digits(&root.join("again").join(name));
    // The case of the study has the name of its own folder.
    assert!(before.remove(Path::new("summary.json")) != again.remove(Path::new("summary.json")));
    assert!(before == again);
}
