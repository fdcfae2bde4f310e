use serde_json::Value;
use std::time::Duration;

use super::super::ended::RunStatus;
use super::*;

const HOUR: Duration = Duration::from_secs(3600);

fn wanted(what: &str, input: &str) -> Wanted {
    let identity = Identity { mezha: "1".into(), program: "2".into(), input: input.into(), ranks: 1, repeat: 1 };
    Wanted { identity, what: what.into(), inputs: Inputs::of(b"", b"") }
}

/// Leaves a run behind that has converged, or a record that says so without a result.
fn finish(folder: &Folder, number: usize, wanted: &Wanted, result: bool) {
    let record = Record {
        study: "bars".into(),
        what: wanted.what.clone(),
        identity: wanted.identity.clone(),
        ended: Ended {
            status: RunStatus::Converged,
            reason: "residual".into(),
            wall_s: number as f64,
            timeout_s: 60.0,
            machine: "here".into(),
            summary: Value::Null,
            result: String::new(),
        },
    };
    folder.keep(number, &record).unwrap();
    if result {
        fs::create_dir_all(folder.result(number)).unwrap();
        fs::write(folder.result(number).join("summary.json"), "{ \"status\": \"converged\" }").unwrap();
    }
}

/// Numbers, and whether they are kept (k), made again (a) or new (n).
fn said(places: &[ResultPlace]) -> String {
    let word = |place: &ResultPlace| match (&place.kept, place.again) {
        (Some(_), _) => 'k',
        (None, true) => 'a',
        (None, false) => 'n',
    };
    places.iter().map(|place| format!("{}{} ", place.number, word(place))).collect::<String>().trim_end().into()
}

fn error(out: &Path, study: &str) -> String {
    match Folder::open(out, study, false) {
        Err(RunError::Input(words)) => words,
        other => panic!("{other:?}"),
    }
}

impl std::fmt::Debug for Folder {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        write!(f, "{} with {:?}", self.out.display(), self.records)
    }
}

/// Opens a folder. For a moment a process that another test starts holds the locks of this one, too.
fn opened(out: &Path, name: &str, force: bool) -> Folder {
    for _ in 0..1000 {
        match Folder::open(out, name, force) {
            Err(RunError::Input(words)) if words.contains("is in use") => std::thread::sleep(Duration::from_millis(4)),
            outcome => return outcome.unwrap(),
        }
    }
    panic!("{} stays in use", out.display());
}

#[test]
fn finished_runs_are_found_wherever_the_study_has_moved_them() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("deep/study");
    let [a, b, c, d] = ["a", "b", "c", "d"].map(|name| wanted(name, name));
    let made = opened(&out, "bars", false);
    assert_eq!(said(&made.places(&[a.clone(), b.clone(), c.clone()], HOUR)), "1n 2n 3n");
    finish(&made, 1, &a, true);
    finish(&made, 2, &b, true);
    finish(&made, 3, &c, false);
    drop(made);
    let made = opened(&out, "bars", false);
    let places = made.places(&[d.clone(), c.clone(), b.clone(), a.clone()], HOUR);
    assert_eq!(said(&places), "4n 3a 2k 1k", "a result that is gone is made again, a new run takes a new number");
    let kept = places[2].kept.as_ref().unwrap();
    assert_eq!((kept.wall_s, kept.result.as_str(), &kept.summary["status"]), (2.0, "runs/002", &"converged".into()));
    assert_eq!(said(&made.places(&[b.clone(), b.clone(), b], HOUR)), "2k 4n 5n", "a result is one row");
}

#[test]
fn a_run_that_has_changed_takes_the_place_of_its_older_self() {
    let folder = tempfile::tempdir().unwrap();
    let made = opened(folder.path(), "bars", false);
    let (a, b) = (wanted("a", "1"), wanted("b", "1"));
    finish(&made, 1, &a, true);
    finish(&made, 2, &b, true);
    drop(made);
    let made = opened(folder.path(), "bars", false);
    assert_eq!(
        said(&made.places(&[wanted("new", "1"), wanted("b", "2")], HOUR)),
        "1k 2a",
        "same input, other words: the same run"
    );
    assert_eq!(said(&made.places(&[wanted("b", "2"), wanted("c", "3")], HOUR)), "2a 3n", "the place of a is kept for it");
    let left = |number: usize| folder.path().join(format!("runs/.{number:03}.elsewhere-7-00000001.partial"));
    [1, 2].into_iter().for_each(|number| fs::create_dir(left(number)).unwrap());
    made.clear(2).unwrap();
    assert!(!made.result(2).exists() && made.result(1).exists());
    assert!(!left(2).exists() && left(1).exists(), "what a run of another host has left goes with its result");
    drop(made);
    let made = opened(folder.path(), "bars", false);
    assert_eq!(said(&made.places(&[wanted("b", "1")], HOUR)), "1k");
    assert_eq!(said(&made.places(&[a, b], HOUR)), "1k 2n");
}

#[test]
fn an_older_study_goes_only_if_it_is_said_and_other_files_stay() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("study");
    let made = opened(&out, "bars", false);
    for name in ["study.csv", "notes.md", "runs/007.stderr", "runs/mine.txt", "runs/008.json", "runs/.009.json.partial"] {
        fs::write(out.join(name), "old").unwrap();
    }
    fs::create_dir(out.join("runs/007")).unwrap();
    drop(made);
    assert!(error(&out, "bars").contains("holds a result, or an older study; choose another folder with --out"));
    assert!(out.join("study.csv").exists());
    let made = opened(&out, "bars", true);
    let there = |name: &str| out.join(name).exists();
    assert!(there("notes.md") && there("runs/mine.txt"));
    assert!(!there("study.csv") && !there("runs/007") && !there("runs/007.stderr") && !there("runs/008.json"));
    assert!(!there("runs/.009.json.partial"));
    finish(&made, 1, &wanted("a", "a"), true);
    drop(made);
    assert!(error(&out, "rings").contains("holds the study bars"));
    assert_eq!(opened(&out, "rings", true).records.len(), 0);
}

#[test]
fn a_folder_serves_one_at_a_time() {
    let folder = tempfile::tempdir().unwrap();
    let made = opened(folder.path(), "bars", false);
    assert!(error(folder.path(), "bars").contains("is in use by another `mezha study`"));
    let left_behind = made.lock().unwrap();
    drop(made);
    assert!(error(folder.path(), "bars").contains("left behind"));
    drop(left_behind);
    opened(folder.path(), "bars", false);
}

#[test]
fn a_file_is_no_folder() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("file");
    fs::write(&out, "mine").unwrap();
    assert!(error(&out, "bars").contains("is no folder"));
}

#[test]
fn tables_that_are_not_made_again_go() {
    let folder = tempfile::tempdir().unwrap();
    let made = opened(folder.path(), "bars", false);
    made.write_tables(&[("study.csv", "a".into()), ("study.svg", "b".into())]).unwrap();
    made.write_tables(&[("study.csv", "c".into())]).unwrap();
    assert_eq!(fs::read_to_string(folder.path().join("study.csv")).unwrap(), "c");
    assert!(!folder.path().join("study.svg").exists());
}
