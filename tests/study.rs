//! `mezha study` from its file to its table.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use serde_json::{Value, json};
use tempfile::TempDir;

/// A folder with a study, whose case is `patch_flat`.
struct Study {
    folder: TempDir,
}

impl Study {
    /// Writes the study file: the case, and what else is given.
    fn new(text: &str) -> Self {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let case = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/patch_flat/case.toml");
        let text = format!("cases = [{:?}]\n{text}", case.display().to_string());
        fs::write(folder.path().join("patch.toml"), text).expect("a file can be written");
        Self { folder }
    }

    fn out(&self) -> PathBuf {
        self.folder.path().join("out")
    }

    /// Makes the study; `words` are added to the command.
    fn make(&self, words: &[&str]) -> Output {
        let mut command = Command::new(env!("CARGO_BIN_EXE_mezha"));
        command.arg("study").arg(self.folder.path().join("patch.toml")).arg("--out").arg(self.out()).args(words);
        for (name, value) in [
            ("OMPI_ALLOW_RUN_AS_ROOT", "1"),
            ("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1"),
            ("OMPI_MCA_mpi_yield_when_idle", "1"),
            ("OMP_NUM_THREADS", "1"),
            ("OPENBLAS_NUM_THREADS", "1"),
        ] {
            command.env(name, value);
        }
        // Runs at the same time must not clear away each other's session folders.
        command.env("OMPI_MCA_orte_tmpdir_base", self.folder.path());
        command.stdin(Stdio::null()).output().expect("mezha starts")
    }

    /// Makes the study, which must give a table, and reads its rows.
    fn rows(&self) -> Vec<Value> {
        let output = self.make(&[]);
        assert_eq!(output.status.code(), Some(0), "{}{}", text(&output.stdout), text(&output.stderr));
        let table: Value = serde_json::from_str(&self.read("study.json")).expect("JSON");
        table["rows"].as_array().expect("a list of rows").clone()
    }

    fn read(&self, name: &str) -> String {
        fs::read_to_string(self.out().join(name)).expect("a file of the study")
    }
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

#[test]
fn a_grid_of_two_by_two_is_four_rows() {
    let study =
        Study::new("ranks = [1, 2]\nerror = 'errors.energy'\ncolumns = ['mesh.triangles']\n[grid]\n'mesh.refine' = [0, 1]");
    let rows = study.rows();
    let moved: Vec<Value> = rows.iter().map(|row| json!([row["mesh.refine"], row["ranks"]])).collect();
    assert_eq!(moved, [json!([0, 1]), json!([0, 2]), json!([1, 1]), json!([1, 2])]);
    for (row, number) in rows.iter().zip(1..) {
        assert_eq!((&row["case"], &row["status"]), (&json!("patch_flat"), &json!("converged")), "{row}");
        assert!(row["error"].as_f64().unwrap() < 1e-9 && row["error"] == row["errors.energy"]);
        assert!((row["contact.seam.force"].as_f64().unwrap() - 2.0).abs() < 1e-9);
        assert!(row["krylov_iterations"].is_u64() && row["outer_iterations"].as_u64().unwrap() > 0);
        assert!(row["time_s.total"].as_f64().unwrap() > 0.0 && row["memory_mib.sum"].as_f64().unwrap() > 0.0);
        let summary = study.read(&format!("runs/{number:03}/summary.json"));
        let summary: Value = serde_json::from_str(&summary).unwrap();
        assert_eq!((&summary["energy"]["U"], &summary["ranks"]), (&row["energy.U"], &row["ranks"]));
    }
    let triangles: Vec<u64> = rows.iter().map(|row| row["mesh.triangles"].as_u64().unwrap()).collect();
    assert_eq!(triangles, [69, 69, 276, 276]);

    let csv = study.read("study.csv");
    assert!(csv.starts_with("case,curve,ranks,repeat,mesh.refine,status,reason,") && csv.lines().count() == 5, "{csv}");
    let page = study.read("study.md");
    assert!(page.starts_with("# Study patch\n\n4 runs, 4 converged"), "{page}");
    assert_eq!(page.lines().filter(|line| line.starts_with("| patch_flat |")).count(), 4, "{page}");
}

#[test]
fn a_run_that_fails_is_a_row_with_its_reason() {
    let curves = "[[curve]]\nname = 'lifted'\nset = { 'load.top.pressure' = -1.0 }\n[[curve]]\nname = 'wrong'\nset = { 'mesh.order' = 7 }\n";
    let study = Study::new(&format!(
        "ranks = [1, 2]\nerror = 'errors.energy'\ngrid.'mesh.refine' = [0]\n{curves}[[curve]]\nname = 'good'"
    ));
    let rows = study.rows();
    let statuses: Vec<&str> = rows.iter().map(|row| row["status"].as_str().unwrap()).collect();
    assert_eq!(statuses, ["not_converged", "not_converged", "refused", "refused", "converged", "converged"]);
    for row in &rows[..2] {
        assert!(row["reason"].as_str().unwrap().contains("body upper can move by (0, 1)"), "{row}");
    }
    for row in &rows[2..4] {
        assert_eq!(row["reason"], json!("mesh.order = 7 (--set): must be 1 or 2, the order of the displacement"));
        assert!(row["error"].is_null() && row["energy.U"].is_null() && row["result"].is_null(), "{row}");
    }
    assert!(study.read("runs/003.stderr").contains("must be 1 or 2"));
    assert!(study.read("study.md").contains("6 runs, 2 converged"));
}

#[test]
fn a_run_that_takes_too_long_is_a_row() {
    let rows = Study::new("ranks = [1, 2]\ntimeout = 0.001").rows();
    assert_eq!(rows.len(), 2);
    for row in rows {
        assert_eq!((&row["status"], &row["error"]), (&json!("timeout"), &Value::Null), "{row}");
        assert!(row["reason"].as_str().unwrap().contains("raise timeout"), "{row}");
    }
}

#[test]
fn a_study_is_not_overwritten_unless_it_is_said() {
    let study = Study::new("grid.'mesh.refine' = [0]");
    assert_eq!(study.rows().len(), 1);
    let before = study.read("study.json");
    let refused = study.make(&[]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(text(&refused.stderr).contains("already holds a study") && text(&refused.stderr).contains("--force"));
    assert_eq!(study.read("study.json"), before);
    assert_eq!(study.make(&["--force"]).status.code(), Some(0));
    assert_ne!(study.read("study.json"), before);
}

#[test]
fn a_bad_study_file_is_told_in_words_and_nothing_is_written() {
    let study = Study::new("rank = [2]\nrepeat = 0\n[grid]\n'mesh.refin' = [0, 1]\n'solver.name' = 'auto'");
    let output = study.make(&[]);
    let errors = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{errors}");
    for words in [
        "patch.toml: repeat = 0: must be a whole number of at least 1",
        "grid.\"mesh.refin\" = [0, 1]: unknown key; did you mean \"refine\"? (asked of case patch_flat)",
        "grid.\"solver.name\" = \"auto\": must be a list of values, as in [2, 3]",
        "rank: unknown key; did you mean \"ranks\"?",
    ] {
        assert!(errors.contains(words), "{words}\n{errors}");
    }
    assert!(!study.out().exists());
}

#[test]
fn a_study_starts_its_ranks_itself() {
    let study = Study::new("");
    let mut command = Command::new(env!("CARGO_BIN_EXE_mezha"));
    command.arg("study").arg(study.folder.path().join("patch.toml")).arg("--out").arg(study.out());
    let output = command.env("OMPI_COMM_WORLD_RANK", "0").output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).contains("without mpirun"));
}
