//! `mezha study` from its file to its table.

use std::fs;
use std::os::unix::process::CommandExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use rustix::process::{Pid, Signal, kill_process_group};
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

    /// The command that makes the study; `words` are added to it.
    fn command(&self, words: &[&str]) -> Command {
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
        // Runs of other tests must not clear away Open MPI's files of this one.
        for name in ["OMPI_MCA_orte_tmpdir_base", "PRTE_MCA_prte_tmpdir_base"] {
            command.env(name, self.folder.path());
        }
        command.stdin(Stdio::null());
        command
    }

    /// Makes the study; `words` are added to the command.
    fn make(&self, words: &[&str]) -> Output {
        self.command(words).output().expect("mezha starts")
    }

    /// Makes the study, which must give a table, and reads its rows.
    fn rows(&self) -> Vec<Value> {
        self.rows_with(0)
    }

    /// The rows of a study that ends with another exit code.
    fn rows_with(&self, code: i32) -> Vec<Value> {
        let output = self.make(&[]);
        assert_eq!(output.status.code(), Some(code), "{}{}", text(&output.stdout), text(&output.stderr));
        self.json()["rows"].as_array().expect("a list of rows").clone()
    }

    fn json(&self) -> Value {
        serde_json::from_str(&self.read("study.json")).expect("JSON")
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
        assert_eq!((&summary["energy"]["total"], &summary["ranks"]), (&row["energy.total"], &row["ranks"]));
        assert!(row["energy.total"].as_f64().unwrap() > 0.0);
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
    assert_eq!(statuses, ["not_converged", "not_converged", "refused", "refused", "converged", "converged"], "{rows:#?}");
    for row in &rows[..2] {
        assert!(row["reason"].as_str().unwrap().contains("body upper can move by (0, 1)"), "{row}");
    }
    for row in &rows[2..4] {
        assert_eq!(row["reason"], json!("mesh.order = 7 (--set): must be 1 or 2, the order of the displacement"));
        assert!(row["error"].is_null() && row["energy.total"].is_null() && row["result"].is_null(), "{row}");
    }
    assert!(study.read("runs/003.stderr").contains("must be 1 or 2"));
    assert!(study.read("study.md").contains("6 runs, 2 converged"));
}

#[test]
fn a_run_that_takes_too_long_is_a_row() {
    let rows = Study::new("ranks = [1, 2]\ntimeout = 0.001").rows_with(3);
    assert_eq!(rows.len(), 2);
    for row in rows {
        assert_eq!((&row["status"], &row["error"]), (&json!("timeout"), &Value::Null), "{row}");
        assert!(row["reason"].as_str().unwrap().contains("raise timeout"), "{row}");
    }
}

/// Lines that tell of a run that is made.
fn runs_made(output: &Output) -> usize {
    text(&output.stdout).lines().filter(|line| line.starts_with("run ")).count()
}

#[test]
fn finished_runs_are_kept_and_new_ones_added() {
    let study = Study::new("grid.'mesh.refine' = [0, 1]");
    let before = study.rows();
    let again = study.make(&[]);
    assert_eq!((again.status.code(), runs_made(&again)), (Some(0), 0), "{}", text(&again.stdout));
    assert!(text(&again.stdout).contains("2 runs, 2 of them already made"), "{}", text(&again.stdout));
    assert_eq!(study.json()["rows"], json!(before), "to the last digit of the times");
    let more = study.make(&["--set", "grid.\"mesh.refine\"=[2, 1, 0]"]);
    assert!(runs_made(&more) == 1 && text(&more.stdout).contains("run 1 of 3, 0:00: patch_flat  mesh.refine=2  1 rank ... "));
    let rows = study.json()["rows"].as_array().expect("rows").clone();
    assert_eq!((rows.len(), &rows[1], &rows[2]), (3, &before[1], &before[0]));
    assert_eq!(rows[0]["result"], json!("runs/003"));
    assert_eq!(runs_made(&study.make(&["--force"])), 2);
    assert_ne!(study.json()["rows"], json!(before));
}

#[test]
fn a_study_that_was_killed_goes_on_where_it_stopped() {
    let study = Study::new("repeat = 3\ngrid.'mesh.refine' = [3, 4]");
    let mut child = study.command(&[]).process_group(0).stdout(Stdio::null()).spawn().expect("mezha starts");
    let start = Instant::now();
    while !study.out().join("runs/002.json").exists() {
        assert!(start.elapsed() < Duration::from_secs(60) && child.try_wait().expect("a child").is_none());
        std::thread::sleep(Duration::from_millis(2));
    }
    kill_process_group(Pid::from_child(&child), Signal::KILL).expect("a group can be killed");
    child.wait().expect("a child can be waited for");
    let finished: Vec<usize> = (1..=6).filter(|number| study.out().join(format!("runs/{number:03}.json")).exists()).collect();
    assert!(finished.len() >= 2 && finished.len() < 6 && !study.out().join("study.csv").exists(), "{finished:?}");
    let summaries = || finished.iter().map(|number| study.read(&format!("runs/{number:03}/summary.json"))).collect::<Vec<_>>();
    let before = summaries();
    let output = study.make(&[]);
    assert_eq!((output.status.code(), runs_made(&output)), (Some(0), 6 - finished.len()), "{}", text(&output.stdout));
    assert_eq!(summaries(), before);
    assert_eq!(study.json()["rows"].as_array().map(Vec::len), Some(6));
}

/// A run that outlives its study still writes into the folder.
#[test]
fn a_folder_with_a_run_left_behind_is_in_use() {
    let study = Study::new("grid.'mesh.refine' = [5]");
    let mut child = study.command(&[]).stdout(Stdio::null()).spawn().expect("mezha starts");
    let begun = |name: &str| name.starts_with(".001.") && name.ends_with(".partial");
    let names = || fs::read_dir(study.out().join("runs")).into_iter().flatten().flatten().map(|entry| entry.file_name());
    while !names().any(|name| begun(&name.to_string_lossy())) {
        assert!(child.try_wait().expect("a child").is_none());
        std::thread::sleep(Duration::from_millis(2));
    }
    child.kill().expect("a child can be killed");
    child.wait().expect("a child can be waited for");
    let refused = study.make(&[]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(text(&refused.stderr).contains("or by a run that one has left behind"), "{}", text(&refused.stderr));
    let start = Instant::now();
    while study.make(&[]).status.code() != Some(0) {
        assert!(start.elapsed() < Duration::from_secs(120));
        std::thread::sleep(Duration::from_millis(50));
    }
    assert_eq!(study.json()["rows"][0]["status"], json!("converged"));
}

#[test]
fn what_has_changed_is_made_again() {
    let study = Study::new("grid.'mesh.refine' = [0]");
    let folder = study.folder.path();
    let case = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/patch_flat");
    let write = |young: &str| {
        let text = fs::read_to_string(case.join("case.toml")).expect("a case");
        fs::write(folder.join("own.toml"), text.replace("must_hold = true", "must_hold = false") + young).expect("a file");
    };
    fs::copy(case.join("blocks.msh"), folder.join("blocks.msh")).expect("a mesh");
    write("");
    fs::write(folder.join("patch.toml"), "cases = ['own.toml']\n[grid]\n'mesh.refine' = [0, 1]").expect("a file");
    assert_eq!(runs_made(&study.make(&[])), 2);
    write("[probe.top]\npoint = [1, 2]\nbody = 'upper'");
    let output = study.make(&[]);
    assert_eq!(runs_made(&output), 2);
    assert!(text(&output.stdout).contains("2 to be made again"), "{}", text(&output.stdout));
    assert_eq!(study.json()["rows"][0]["result"], json!("runs/001"));
    let mesh = fs::read_to_string(folder.join("blocks.msh")).expect("a mesh");
    fs::write(folder.join("blocks.msh"), mesh + "\n").expect("a mesh");
    assert_eq!(runs_made(&study.make(&[])), 2);
    assert_eq!(runs_made(&study.make(&[])), 0);
}

/// A case that is edited while the study goes on: its rows are of what it was, or they say that they are of nothing.
#[test]
fn a_case_that_changes_meanwhile_gives_no_rows() {
    let study = Study::new("");
    let folder = study.folder.path();
    let case = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/patch_flat");
    let original = fs::read_to_string(case.join("case.toml")).expect("a case").replace("must_hold = true", "must_hold = false");
    let stiffer = original.replace("young = 3000.0", "young = 9000.0").replace("young   = 3000.0", "young = 9000.0");
    assert_ne!(original, stiffer);
    let mesh = fs::read(case.join("blocks.msh")).expect("a mesh");
    fs::write(folder.join("own.toml"), &original).expect("a file");
    fs::write(folder.join("blocks.msh"), &mesh).expect("a mesh");
    fs::write(folder.join("patch.toml"), "cases = ['own.toml']\nranks = [1, 2]\n[grid]\n'mesh.refine' = [2, 1, 0]")
        .expect("a file");
    let stop_after_first = |change: &dyn Fn()| {
        // The runs of the study before would pass for those of this one.
        let _ = fs::remove_dir_all(study.out());
        let mut child = study.command(&[]).stdout(Stdio::null()).spawn().expect("mezha starts");
        while !study.out().join("runs/001.json").exists() {
            assert!(child.try_wait().expect("a child").is_none());
            std::thread::sleep(Duration::from_millis(1));
        }
        change();
        assert_eq!(child.wait().expect("a child can be waited for").code(), Some(0));
        study.json()["rows"].as_array().expect("rows").clone()
    };
    let edits: [&dyn Fn(); 3] = [
        &|| fs::write(folder.join("own.toml"), &stiffer).expect("a file"),
        &|| fs::write(folder.join("own.toml"), "nonsense").expect("a file"),
        &|| fs::write(folder.join("blocks.msh"), [&mesh[..], b"\n"].concat()).expect("a mesh"),
    ];
    for edit in edits {
        let rows = stop_after_first(edit);
        let energy = rows[0]["energy.total"].as_f64().expect("an energy");
        assert_eq!(rows[5]["status"], json!("failed"), "{}", rows[5]);
        assert!(
            rows[5]["reason"].as_str().expect("a reason").contains("has changed since this run was asked for"),
            "{}",
            rows[5]
        );
        for row in &rows {
            match row["energy.total"].as_f64() {
                Some(same) => assert!((same / energy - 1.0).abs() < 1e-6, "{row}"),
                None => assert_eq!((&row["status"], &row["result"]), (&json!("failed"), &Value::Null), "{row}"),
            }
        }
        fs::write(folder.join("own.toml"), &original).expect("a file");
        fs::write(folder.join("blocks.msh"), &mesh).expect("a mesh");
        let again = study.make(&[]);
        let failed = rows.iter().filter(|row| row["status"] == "failed").count();
        assert_eq!(runs_made(&again), failed, "what has failed is made again, and nothing else");
    }
}

#[test]
fn a_folder_holds_one_study() {
    let study = Study::new("grid.'mesh.refine' = [0]");
    study.rows();
    let before = study.read("study.json");
    let other = study.folder.path().join("other.toml");
    fs::copy(study.folder.path().join("patch.toml"), &other).expect("a file");
    let mut command = Command::new(env!("CARGO_BIN_EXE_mezha"));
    let refused = command.arg("study").arg(other).arg("--out").arg(study.out()).output().expect("mezha starts");
    assert_eq!(refused.status.code(), Some(2));
    let errors = text(&refused.stderr);
    assert!(errors.contains("holds the study patch; choose another folder with --out, or replace it with --force"), "{errors}");
    assert_eq!(study.read("study.json"), before);
}

#[test]
fn repeats_have_medians_in_every_table() {
    let study = Study::new("repeat = 3\nerror = 'errors.energy'\ngrid.'mesh.refine' = [0, 1]");
    let rows = study.rows();
    for repeats in rows.chunks(3) {
        let mut times: Vec<f64> = repeats.iter().map(|row| row["time_s.total"].as_f64().expect("a time")).collect();
        times.sort_by(f64::total_cmp);
        for row in repeats {
            let of = |what: &str| row[format!("time_s.total.{what}")].as_f64().expect("a number");
            assert_eq!([of("least"), of("median"), of("most")], times[..], "{row}");
        }
    }
    let page = study.read("study.md");
    assert_eq!(page.lines().filter(|line| line.starts_with("| patch_flat | 1 | 3 | ")).count(), 2, "{page}");
    let points = study.json()["lines"][0]["points"].as_array().expect("points").clone();
    assert_eq!(points.len(), 2);
    assert_eq!(points[0]["time"]["median"], rows[0]["time_s.total.median"]);
    assert_eq!(points[1]["unknowns"].as_f64(), rows[3]["unknowns"].as_f64());
}

/// Python's parser reads figure and page.
#[test]
fn figure_and_page_are_well_formed() {
    let study = Study::new(
        "error = 'errors.energy'\nfigure = ['refine', 'energy.total']\ngrid.'mesh.refine' = [0, 1, 2]\n[[curve]]\nname = 'a < b & \"c\"'\n[[curve]]\nname = 'P1'\nset = { 'mesh.order' = 1 }",
    );
    study.rows();
    let page = study.read("report.html");
    for words in ["<svg ", "Pareto", "Orders and costs", "a &lt; b &amp; &quot;c&quot;", "cores", "BLAS", "patch_flat"] {
        assert!(page.contains(words), "{words} in {page}");
    }
    assert!(!page.contains("http://") || page.matches("http://").count() == page.matches("http://www.w3.org/").count());
    let content = |figure: &str| figure.trim().split_once('>').expect("a tag").1.to_owned();
    let (first, all) = (study.read("study.svg"), study.read("study_all.svg"));
    let asked = study.read("study_figure.svg");
    assert!(page.contains(&content(&asked)) && asked.contains(">patch_flat: energy.total against mesh.refine<"), "{asked}");
    assert!(page.contains(&content(&first)) && page.contains(&content(&all)) && all.matches("<polygon").count() > 8, "{all}");
    assert!(page.find("<figure>") < page.find("<table>"), "the figure stands first");
    let named = |line: &str| line.contains("a &lt; b &amp; &quot;c&quot;");
    let told = |tag: &'static str| first.lines().filter(move |line| line.contains(tag) && named(line));
    let names = told("<text").filter(|line| !line.contains("stroke="));
    assert_eq!(names.count(), 1, "each line bears its name: {first}");
    assert_eq!(told("<title>").count(), 3, "and tells it at each point under the pointer: {first}");
    let program = "import sys, xml.etree.ElementTree as tree\nfor file in sys.argv[1:]: tree.parse(file)";
    let files = ["study_figure.svg", "study.svg", "study_all.svg", "report.html"].map(|name| study.out().join(name));
    match Command::new("python3").arg("-c").arg(program).args(files).output() {
        Ok(read) => assert!(read.status.success(), "{}", text(&read.stderr)),
        Err(error) => println!("skipped: nobody has read the files, since python3 does not start: {error}"),
    }
}

/// `docs/performance/make` finds in `study.json` what it writes of.
#[test]
fn the_page_of_performance_is_made_of_studies() {
    let pairs = [("P1/P0", 1, "p0"), ("P2/P1 continuous", 2, "p1-continuous"), ("P2/P0, graded", 2, "p0")];
    let curve = |(name, order, space): (&str, u8, &str)| {
        format!("[[curve]]\nname = '{name}'\nset = {{ 'mesh.order' = {order}, 'contact.seam.multiplier' = '{space}' }}\n")
    };
    let along = "along = ['mesh.refine', 'accuracy.energy']\ncolumns = ['time_s.mesh']\n";
    let head = "ranks = [1, 2]\nerror = ['errors.energy', 'errors.lambda_seam']\n[grid]\n'mesh.refine' = [0, 1, 2]\n";
    let adapted = "[[curve]]\nname = 'P2/P0, adapted'\nset = { 'contact.seam.multiplier' = 'p0' }\n\
         grid = { 'mesh.refine' = [0], 'accuracy.energy' = [1e-1, 1e-2] }\n";
    let study = Study::new(&format!("{along}{head}{}{adapted}", pairs.map(curve).concat()));
    study.rows();
    let program = "import json, sys\nsys.path.insert(0, sys.argv[1])\nimport words\nstudy = json.load(open(sys.argv[2]))\n\
         studies = {name: study for name in ('speed_against_error', 'scaling', 'brought', 'ranks')}\n\
         solver = lambda line: line['name'].rsplit(', ', 1)[0] + (', fieldsplit' if line['ranks'] == 1 else ', direct')\n\
         studies['solvers'] = dict(study, lines=[dict(line, name=solver(line)) for line in study['lines']])\n\
         print(words.page(studies, False))";
    let words = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/performance");
    let mut python = Command::new("python3");
    python.args(["-B", "-c", program]).arg(words).arg(study.out().join("study.json"));
    let Ok(output) = python.output() else {
        println!("skipped: python3 does not start");
        return;
    };
    let page = text(&output.stdout);
    assert!(output.status.success(), "{}", text(&output.stderr));
    for words in [
        "### patch_flat: ",
        "| pair | energy 10⁻",
        "| P1/P0, 1 rank |",
        "| P2/P0, adapted, 1 rank |",
        "| Krylov iterations |",
        "## Fine meshes from a file",
        "The ratio is the time of `direct`",
        "Energies differ by ",
    ] {
        assert!(page.contains(words), "{words} in {page}");
    }
    assert!(page.contains("× (10⁻") || page.contains("equal within "), "{page}");
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
    let output = command.env("OMPI_COMM_WORLD_RANK", "0").env("OMPI_COMM_WORLD_SIZE", "1").output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).contains("without mpirun"));
}

/// The summaries of runs are known only when they are there: a place that none of them has is told then.
#[test]
fn a_place_that_no_summary_has_is_told() {
    let study = Study::new("columns = ['energy.totl', 'energy.total']\n[grid]\n'mesh.refine' = [0]");
    let said = text(&study.make(&[]).stdout);
    assert!(said.contains("no run has a value at energy.totl"), "{said}");
    assert!(!said.contains("energy.total "), "{said}");
}

#[test]
fn the_only_contact_of_a_case_with_several_is_told() {
    let study = Study::new("");
    let case = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/bending/case.toml");
    let file = format!("cases = [{:?}]\nfigure = ['unknowns', 'force']", case.display().to_string());
    fs::write(study.folder.path().join("patch.toml"), file).expect("a file can be written");
    let said = text(&study.make(&[]).stdout);
    let words = "no run has a value at contact.\"*\".force of its summary.json; `*` means the only one, and there are several";
    assert!(said.contains(words), "{said}");
}
