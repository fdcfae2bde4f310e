//! A result appears whole or not at all, whoever else writes there.

use super::*;

fn write_result(out: &Path, force: bool, case: &str) -> Result<(), OutputError> {
    let folder = ResultFolder::create(out, force)?;
    write_case(&folder, case);
    folder.commit()
}

/// A summary that tells the name of a case.
fn write_case(folder: &ResultFolder, case: &str) {
    folder.write_summary(&Summary::new(case, 1)).unwrap();
}

/// The case of the result in a folder.
fn case_in(folder: &Path) -> String {
    let summary: serde_json::Value = serde_json::from_slice(&fs::read(folder.join("summary.json")).unwrap()).unwrap();
    summary["case"].as_str().unwrap().into()
}

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<_> =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn result_appears_only_when_committed() {
    let root = tempfile::tempdir().unwrap();
    let out = root.path().join("deep/er/bars");
    let folder = ResultFolder::create(&out, false).unwrap();
    fs::write(folder.path("summary.json"), "{}").unwrap();
    assert!(!out.exists());
    assert_eq!(folder.path("a"), folder.temporary().join("a"));
    assert!(folder.temporary().is_absolute() && folder.temporary().parent() == out.parent());
    folder.commit().unwrap();
    assert_eq!(names(&out), ["summary.json"]);
    assert_eq!(names(out.parent().unwrap()), ["bars"]);
}

#[test]
fn unfinished_result_leaves_nothing() {
    let root = tempfile::tempdir().unwrap();
    let folder = ResultFolder::create(&root.path().join("bars"), false).unwrap();
    fs::write(folder.path("summary.json"), "{}").unwrap();
    drop(folder);
    drop(ResultFolder::create(&root.path().join("deep/er/bars"), false).unwrap());
    assert!(names(root.path()).is_empty());
    let [one, other] = ["deep/one", "deep/other"].map(|out| ResultFolder::create(&root.path().join(out), false).unwrap());
    drop(one);
    assert!(other.temporary().is_dir(), "what somebody else has come into stays");
}

#[test]
fn result_is_replaced_by_force_alone() {
    let root = tempfile::tempdir().unwrap();
    let out = root.path().join("bars");
    let first = ResultFolder::create(&out, false).unwrap();
    fs::write(first.path("fields_7.vtu"), "of the first").unwrap();
    write_case(&first, "first");
    first.commit().unwrap();
    let refusal = write_result(&out, false, "second").unwrap_err();
    assert!(matches!(refusal, OutputError::HoldsResult(_)) && refusal.to_string().contains("--force"));
    assert_eq!(case_in(&out), "first");
    write_result(&out, true, "second").unwrap();
    assert_eq!(case_in(&out), "second");
    assert_eq!(names(&out), ["summary.json"]);
    assert_eq!(names(root.path()), ["bars"]);
}

#[test]
fn abandoned_replacement_keeps_the_old_result() {
    let root = tempfile::tempdir().unwrap();
    let out = root.path().join("bars");
    write_result(&out, false, "first").unwrap();
    drop(ResultFolder::create(&out, true).unwrap());
    assert_eq!(case_in(&out), "first");
}

#[test]
fn foreign_files_survive() {
    let root = tempfile::tempdir().unwrap();
    let out = root.path().join("bars");
    fs::create_dir(&out).unwrap();
    write_result(&out, false, "an empty folder may be taken").unwrap();
    fs::write(out.join("notes.md"), "mine").unwrap();
    fs::create_dir(out.join("paper")).unwrap();
    write_result(&out, true, "second").unwrap();
    assert_eq!(names(&out), ["notes.md", "paper", "summary.json"]);
    fs::remove_file(out.join("summary.json")).unwrap();
    for force in [false, true] {
        assert!(matches!(write_result(&out, force, "third"), Err(OutputError::HoldsOtherFiles(_))));
    }
    assert_eq!(fs::read_to_string(out.join("notes.md")).unwrap(), "mine");
}

#[test]
fn a_summary_of_another_program_is_no_result() {
    let root = tempfile::tempdir().unwrap();
    fs::write(root.path().join("summary.json"), "[1, 2, 3]").unwrap();
    let refusal = write_result(root.path(), true, "mine").unwrap_err();
    assert!(matches!(refusal, OutputError::HoldsOtherFiles(_)), "{refusal}");
}

/// A run that was interrupted before it has read its mesh has no copy of it.
#[test]
fn a_file_that_is_needed_stays() {
    let root = tempfile::tempdir().unwrap();
    let out = root.path().join("bars");
    let write = |kept: &[&str], mesh: bool| {
        let mut folder = ResultFolder::create(&out, true).unwrap();
        kept.iter().for_each(|name| folder.keep(&out.join(name)));
        if mesh {
            fs::write(folder.path("case.msh"), "mesh").unwrap();
        }
        write_case(&folder, "next");
        folder.commit().unwrap();
    };
    write(&[], true);
    write(&["case.msh"], false);
    assert_eq!(names(&out), ["case.msh", "summary.json"]);
}

#[test]
fn a_target_may_end_with_a_dot() {
    let root = tempfile::tempdir().unwrap();
    for out in ["fresh/.", "fresh/./", "deep/./fresh/"] {
        write_result(&root.path().join(out), true, out).unwrap();
        assert_eq!(case_in(&root.path().join(out)), out);
    }
    assert_eq!(
        (names(root.path()), names(&root.path().join("deep"))),
        (vec!["deep".into(), "fresh".into()], vec!["fresh".into()])
    );
}

#[test]
fn files_and_nameless_targets_are_refused() {
    let root = tempfile::tempdir().unwrap();
    let file = root.path().join("file");
    fs::write(&file, "mine").unwrap();
    assert!(matches!(ResultFolder::create(&file, true), Err(OutputError::NotAFolder(_))));
    assert!(matches!(ResultFolder::create(Path::new("."), true), Err(OutputError::NoName(_))));
    assert_eq!(fs::read_to_string(&file).unwrap(), "mine");
}

/// Two results that were begun at the same time: the first that ends stays, whether it replaces one or not.
#[test]
fn the_second_is_told_and_lies_beside() {
    for force in [false, true] {
        let root = tempfile::tempdir().unwrap();
        let out = root.path().join("bars");
        if force {
            write_result(&out, false, "before").unwrap();
        }
        let [first, second] = ["first", "second"].map(|text| {
            let folder = ResultFolder::create(&out, force).unwrap();
            write_case(&folder, text);
            folder
        });
        assert_ne!(first.temporary(), second.temporary());
        first.commit().unwrap();
        let refusal = second.commit().unwrap_err();
        assert_eq!((case_in(&out), case_in(&overtaken(refusal))), ("first".into(), "second".into()));
        assert_eq!(names(root.path()).len(), 2);
    }
}

/// A target that is refused at the end, since a file of its name has come where folders were to be: the result has another name.
#[test]
fn a_result_that_is_refused_is_kept_elsewhere() {
    let root = tempfile::tempdir().unwrap();
    let out = root.path().join("bars");
    write_result(&out, false, "first").unwrap();
    let folder = ResultFolder::create(&out, true).unwrap();
    write_case(&folder, "second");
    let refusal = folder.elsewhere(OutputError::io("make", &out)(std::io::ErrorKind::ResourceBusy.into())).unwrap_err();
    let OutputError::Elsewhere { place, .. } = &refusal else { panic!("{refusal}") };
    assert!(case_in(place) == "second" && refusal.to_string().contains("not lost: the result is in"), "{refusal}");
    assert_eq!((case_in(&out), names(root.path()).len()), ("first".into(), 2));
}

/// Where a result lies whose place another one has taken.
fn overtaken(refusal: OutputError) -> PathBuf {
    match refusal {
        OutputError::Elsewhere { place, source } if matches!(*source, OutputError::Overtaken(_)) => place,
        refusal => panic!("{refusal}"),
    }
}

/// Files move into a target that cannot be renamed, those of the result before go, and others stay.
#[test]
fn a_mount_point_is_filled() {
    let root = tempfile::tempdir().unwrap();
    let out = root.path().join("volume");
    fs::create_dir_all(out.join("lost+found")).unwrap();
    assert!(mounted::is_mount_point(Path::new("/proc")) && !mounted::is_mount_point(&out) && mounted::is_bare(&out).unwrap());
    for text in ["first", "second"] {
        let mut folder = ResultFolder::create(&out.join("inner"), true).unwrap();
        (folder.target, folder.is_mounted) = (out.clone(), true);
        folder.replaced = File::open(out.join(SUMMARY)).ok();
        fs::create_dir_all(folder.path("steps")).unwrap();
        fs::write(folder.path(&format!("steps/{text}.csv")), text).unwrap();
        write_case(&folder, text);
        folder.commit().unwrap();
        assert_eq!(case_in(&out), text);
        fs::write(out.join("notes"), "mine").unwrap();
    }
    assert_eq!(
        (names(&out), names(&out.join("steps"))),
        (["lost+found", "notes", "steps", "summary.json"].map(String::from).into(), vec!["second.csv".into()])
    );
}

/// A file of somebody else's keeps its content under another name, and the result has those that it lists.
#[test]
fn a_file_in_a_mount_point_is_not_taken_for_one_of_the_result() {
    let root = tempfile::tempdir().unwrap();
    let out = root.path().join("volume");
    fs::create_dir_all(&out).unwrap();
    fs::write(out.join("report.html"), "mine").unwrap();
    for text in ["first", "second"] {
        let mut folder = ResultFolder::create(&out.join("inner"), true).unwrap();
        (folder.target, folder.is_mounted) = (out.clone(), true);
        folder.replaced = File::open(out.join(SUMMARY)).ok();
        fs::write(folder.path("report.html"), text).unwrap();
        write_case(&folder, text);
        folder.commit().unwrap();
        let read = |name: &str| fs::read_to_string(out.join(name)).unwrap();
        assert_eq!((read("report.html"), read("report.html.old")), (text.into(), "mine".into()));
        assert_eq!(names(&out), ["report.html", "report.html.old", "summary.json"]);
    }
}

/// Of two results that were begun at the same time in a mount point the first that ends stays.
#[test]
fn the_second_in_a_mount_point_is_told() {
    let root = tempfile::tempdir().unwrap();
    let out = root.path().join("volume");
    fs::create_dir_all(&out).unwrap();
    let [first, second] = ["first", "second"].map(|text| {
        let mut folder = ResultFolder::create(&out.join("inner"), true).unwrap();
        (folder.target, folder.is_mounted) = (out.clone(), true);
        write_case(&folder, text);
        folder
    });
    first.commit().unwrap();
    let place = overtaken(second.commit().unwrap_err());
    assert_eq!((case_in(&out), case_in(&place)), ("first".into(), "second".into()));
    let own = place.file_name().and_then(|name| name.to_str()).map(String::from).unwrap();
    assert_eq!(names(&out), [own, "summary.json".into()]);
}

#[test]
fn a_result_that_was_taken_away_is_not_missed() {
    let root = tempfile::tempdir().unwrap();
    let out = root.path().join("bars");
    write_result(&out, false, "first").unwrap();
    let folder = ResultFolder::create(&out, true).unwrap();
    write_case(&folder, "second");
    fs::remove_dir_all(&out).unwrap();
    folder.commit().unwrap();
    assert_eq!((names(&out), names(root.path())), (vec!["summary.json".into()], vec!["bars".into()]));
}

/// As on file systems that cannot exchange two folders.
#[test]
fn two_steps_do_the_same() {
    let root = tempfile::tempdir().unwrap();
    let out = root.path().join("bars");
    write_result(&out, false, "first").unwrap();
    let [a, b] = [0, 1].map(|_| ResultFolder::create(&out, true).unwrap());
    write_case(&a, "second");
    let old = a.replace_in_two_steps(a.replaced.as_ref().unwrap()).unwrap().unwrap();
    assert_eq!(case_in(&old), "first");
    a.retire(&old).unwrap();
    let refusal = b.replace_in_two_steps(b.replaced.as_ref().unwrap()).unwrap_err();
    assert!(matches!(refusal, OutputError::Overtaken(_)), "{refusal}");
    drop((a, b));
    assert_eq!(case_in(&out), "second");
    assert_eq!(names(root.path()), ["bars"]);
}

/// Many at once, and one at a time: what stands under the name is always whole, and of one run.
#[test]
fn a_race_has_whole_results_only() {
    let root = tempfile::tempdir().unwrap();
    let out = root.path().join("bars");
    write_result(&out, false, "before").unwrap();
    let write = |runner: usize| {
        let mut won = 0;
        for round in 0..50 {
            let Ok(folder) = ResultFolder::create(&out, true) else { continue };
            let text = format!("{runner} {round}");
            fs::write(folder.path("contact_a.csv"), &text).unwrap();
            write_case(&folder, &text);
            match folder.commit() {
                Ok(()) => won += 1,
                Err(refusal) => {
                    let place = overtaken(refusal);
                    // Of three that meet in one moment one may have the place of another.
                    assert_eq!(case_in(&place), fs::read_to_string(place.join("contact_a.csv")).unwrap());
                    fs::remove_dir_all(place).unwrap();
                }
            }
        }
        won
    };
    let won: usize = std::thread::scope(|scope| {
        let runners: Vec<_> = (0..4).map(|runner| scope.spawn(move || write(runner))).collect();
        runners.into_iter().map(|runner| runner.join().unwrap()).sum()
    });
    assert!(won > 0 && case_in(&out) == fs::read_to_string(out.join("contact_a.csv")).unwrap());
    assert_eq!((names(&out).len(), names(root.path())), (2, vec!["bars".into()]));
}
