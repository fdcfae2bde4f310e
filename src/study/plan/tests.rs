use super::*;
use crate::case::schema::never_asked;

const CASE: &str = "mesh.file = 'a.msh'\n[body.a]\nyoung = 1\npoisson = 0.3\n";

/// A folder with the cases `bars/case.toml`, `rings.toml` and `deep/bars/case.toml`, and what the study in it is.
fn parse(text: &str) -> Result<Plan, String> {
    let folder = tempfile::tempdir().unwrap();
    for file in ["bars/case.toml", "rings.toml", "deep/bars/case.toml"] {
        let path = folder.path().join(file);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, CASE).unwrap();
    }
    let file = folder.path().join("study.toml");
    Plan::parse(text, &file, &[]).map_err(|error| error.to_string().replace(&format!("{}: ", file.display()), ""))
}

fn runs(text: &str) -> Vec<PlannedRun> {
    parse(text).unwrap_or_else(|error| panic!("{error}")).runs
}

fn only_error(text: &str) -> String {
    let words = parse(text).map(|plan| panic!("accepted: {plan:?}")).unwrap_err();
    assert_eq!(words.lines().count(), 1, "{words}");
    words
}

#[test]
fn every_combination_is_a_run() {
    let text = r#"
        cases = ["bars/case.toml", "rings.toml"]
        ranks = [1, 2]
        repeat = 2
        [grid]
        "mesh.refine" = [2, 3, 4]
        "solver.name" = ["auto", "direct"]
        [[curve]]
        name = "P1"
        set = { "mesh.order" = 1, "body.a.young" = 7e6 }
        [[curve]]
        name = "as it stands"
    "#;
    let plan = parse(text).unwrap();
    assert_eq!(plan.keys, ["mesh.refine", "solver.name"]);
    assert_eq!(plan.runs.len(), 2 * 2 * 2 * 3 * 2 * 2);
    let mut different: Vec<String> = plan.runs.iter().map(|run| format!("{run:?}")).collect();
    different.sort();
    different.dedup();
    assert_eq!(different.len(), plan.runs.len());
    let first = &plan.runs[0];
    assert_eq!(
        first.overrides,
        ["mesh.order=1", "body.a.young=7e6", "mesh.refine=2", "solver.name=\"auto\""]
            .map(|text| text.replace("7e6", "7000000.0"))
    );
    assert_eq!((first.case.as_str(), first.curve.as_deref(), first.ranks, first.repeat), ("bars", Some("P1"), 1, 1));
    let order: Vec<_> = plan.runs[..6].iter().map(|run| (run.overrides[3].as_str(), run.ranks, run.repeat)).collect();
    let (auto, direct) = ("solver.name=\"auto\"", "solver.name=\"direct\"");
    assert_eq!(order, [(auto, 1, 1), (auto, 1, 2), (auto, 2, 1), (auto, 2, 2), (direct, 1, 1), (direct, 1, 2)]);
}

/// The readers ask for every key of the table; they panic where they ask for another one.
#[test]
fn readers_ask_for_every_key_of_the_table() {
    never_asked(&STUDY);
    parse("cases = ['rings.toml']\n[[curve]]\nname = 'a'").unwrap();
    let missed = never_asked(&STUDY);
    assert!(missed.is_empty(), "no reader asks for {missed:?}");
}

#[test]
fn columns_of_a_figure_are_named_in_whole_or_by_their_last_part() {
    let with = |figure: &str| {
        let base = "cases = ['rings.toml']\nerror = 'errors.energy'\ncolumns = ['contact.seam.pressure_max']";
        format!("{base}\nfigure = {figure}\n[grid]\n'body.a.young' = [1, 2]\n'accuracy.energy' = [1e-2]")
    };
    let plan = parse(&with("['young', 'pressure_max', 'accuracy.energy']")).unwrap();
    assert_eq!(plan.figure, ["body.a.young", "contact.seam.pressure_max", "accuracy.energy"]);
    assert_eq!(plan.columns.len(), 1);
    let plan = parse(&with("['ranks', 'probe.tip.u.1']")).unwrap();
    assert_eq!(
        (plan.figure[1].as_str(), plan.columns[1].text.as_str()),
        ("probe.tip.u.1", "probe.tip.u.1"),
        "it becomes a column"
    );
    let plan = parse(&with("['young', 'force']")).unwrap();
    assert_eq!(plan.columns[1].text, "contact.\"*\".force", "that of the only contact");
    let refused = |figure: &str| only_error(&with(figure));
    assert!(refused("['young', 'presure_max']").contains("there is no column presure_max; there are "));
    assert!(refused("['young']").contains("two or three names of columns"));
    assert!(refused("['young', 'young']").contains("twice"));
    assert!(refused("['energy', 'unknowns']").contains("energy may be accuracy.energy or errors.energy; write out which"));
}

#[test]
fn the_least_study_is_one_run() {
    let plan = parse("cases = ['rings.toml']").unwrap();
    let [run] = &plan.runs[..] else { panic!("{plan:?}") };
    assert_eq!((run.case.as_str(), run.ranks, run.repeat, run.curve.is_none()), ("rings", 1, 1, true));
    assert!(run.overrides.is_empty() && plan.errors.is_empty() && plan.columns.is_empty());
    assert_eq!(plan.timeout, Duration::from_secs(600));
}

#[test]
fn dots_without_quotes_mean_the_same() {
    let quoted = runs("cases = ['rings.toml']\ngrid.'mesh.refine' = [1, 2]\n[[curve]]\nname = 'a'\nset = { 'mesh.order' = 1 }");
    let bare = runs("cases = ['rings.toml']\ngrid.mesh.refine = [1, 2]\n[[curve]]\nname = 'a'\nset = { mesh.order = 1 }");
    assert_eq!(
        quoted.iter().map(|run| &run.overrides).collect::<Vec<_>>(),
        bare.iter().map(|run| &run.overrides).collect::<Vec<_>>()
    );
    assert_eq!(bare[1].overrides, ["mesh.order=1", "mesh.refine=2"]);
}

#[test]
fn a_curve_may_be_drawn_for_some_cases() {
    let curves = "[[curve]]\nname = 'all'\n[[curve]]\nname = 'one'\ncases = ['rings.toml']";
    let more = "[[curve]]\nname = 'one'\ncases = ['bars/case.toml']\nset = { 'mesh.order' = 1 }";
    let both = runs(&format!("cases = ['bars/case.toml', 'rings.toml']\n{curves}\n{more}"));
    assert_eq!(both.iter().filter(|run| run.curve.as_deref() == Some("one")).count(), 2, "one name, two cases");
    let runs = runs(&format!("cases = ['bars/case.toml', 'rings.toml']\n{curves}"));
    let drawn: Vec<_> = runs.iter().map(|run| (run.case.as_str(), run.curve.as_deref().unwrap())).collect();
    assert_eq!(drawn, [("bars", "all"), ("rings", "all"), ("rings", "one")]);
}

#[test]
fn cases_of_one_name_are_told_apart_by_their_paths() {
    let runs = runs("cases = ['bars/case.toml', 'deep/bars/case.toml', 'rings.toml']");
    let labels: Vec<_> = runs.iter().map(|run| run.case.as_str()).collect();
    assert_eq!(labels, ["bars/case.toml", "deep/bars/case.toml", "rings"]);
}

#[test]
fn values_come_through_as_they_are() {
    let grid = "grid.'contact.a.segments' = ['auto', 30, [0, 0.2, 1]]\ngrid.'contact.a.between' = [['p', 'q']]";
    let runs = runs(&format!("cases = ['rings.toml']\n{grid}"));
    let texts: Vec<_> = runs.iter().map(|run| run.overrides[0].as_str()).collect();
    assert_eq!(texts, ["contact.a.segments=\"auto\"", "contact.a.segments=30", "contact.a.segments=[0, 0.2, 1]"]);
    assert_eq!(runs[0].overrides[1], "contact.a.between=[\"p\", \"q\"]");
}

#[test]
fn what_is_set_for_all_runs_gives_way_to_a_curve() {
    let set = "[set]\n'solver.tolerance' = 1e-5\ncontact.a.segments = 'auto'\n[grid]\n'mesh.order' = [1]\n";
    let curves = "[[curve]]\nname = 'as it stands'\n[[curve]]\nname = 'few'\nset = { 'contact.a.segments' = 3 }";
    let runs = runs(&format!("cases = ['rings.toml']\n{set}{curves}"));
    assert_eq!(runs[0].overrides, ["solver.tolerance=0.00001", "contact.a.segments=\"auto\"", "mesh.order=1"]);
    assert_eq!(runs[1].overrides, ["solver.tolerance=0.00001", "contact.a.segments=3", "mesh.order=1"]);
}

#[test]
fn a_curve_may_have_a_grid_of_its_own() {
    let grid = "[set]\n'mesh.order' = 2\n[grid]\n'mesh.refine' = [1, 2]\n'solver.name' = ['auto']\n";
    let curves = "[[curve]]\nname = 'a'\n[[curve]]\nname = 'b'\ngrid = { 'mesh.refine' = [3, 4, 5], 'mesh.order' = [1] }";
    let plan = parse(&format!("cases = ['rings.toml']\n{grid}{curves}")).unwrap();
    assert_eq!(plan.keys, ["mesh.refine", "solver.name", "mesh.order"]);
    let of = |at: usize| (plan.runs[at].curve.as_deref().unwrap(), plan.runs[at].overrides.join(" "));
    assert_eq!(plan.runs.len(), 5);
    assert_eq!(of(1), ("a", "mesh.order=2 mesh.refine=2 solver.name=\"auto\"".into()));
    assert_eq!(of(2), ("b", "mesh.refine=3 solver.name=\"auto\" mesh.order=1".into()));
    assert_eq!((&plan.runs[0].values[2], &plan.runs[4].values[0]), (&None, &Some(5.into())));
}

#[test]
fn the_command_line_overrides_keys_of_the_study() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("case.toml"), CASE).unwrap();
    let file = folder.path().join("study.toml");
    let read = |overrides: &[&str]| {
        let overrides: Vec<String> = overrides.iter().map(|text| (*text).to_owned()).collect();
        Plan::parse("cases = ['case.toml']\n[grid]\n'mesh.refine' = [1, 2, 3]", &file, &overrides)
    };
    let plan = read(&["repeat=2", "grid.\"mesh.refine\"=[5]", "error=errors.energy"]).unwrap();
    assert_eq!((plan.runs.len(), plan.runs[1].repeat, plan.errors[0].text.as_str()), (2, 2, "errors.energy"));
    assert_eq!(plan.runs[0].overrides, ["mesh.refine=5"]);
    let curves = ["curve=[{name='a'},{name='b',grid={'mesh.refine'=[7,8]}}]", "curve.2.grid.\"mesh.refine\"=[9]"];
    let plan = read(&curves).unwrap();
    assert_eq!((plan.runs.len(), plan.runs[3].overrides[0].as_str()), (4, "mesh.refine=9"));
    let words = read(&[curves[0], "curve.3.name=c"]).unwrap_err().to_string();
    assert!(words.contains("--set curve.3.name: curve is a value, not a table"), "{words}");
    let words = read(&["repeat=0"]).unwrap_err().to_string();
    assert!(words.contains("repeat = 0 (--set): must be a whole number of at least 1"), "{words}");
    let words = read(&["repeats=2"]).unwrap_err().to_string();
    assert!(words.contains("repeats: unknown key; did you mean \"repeat\"?"), "{words}");
}

#[test]
fn points_are_joined_along_a_key_that_moves() {
    let along = |text: &str| parse(&format!("cases = ['rings.toml']\n{text}\ngrid.'contact.a.segments' = [1, 2]"));
    assert_eq!(along("").unwrap().along, ["mesh.refine"]);
    assert_eq!(along("along = 'contact.a.segments'").unwrap().along, ["contact.a.segments"]);
    let both = "along = ['contact.a.segments', 'mesh.order']\ngrid.'mesh.order' = [1, 2]";
    assert_eq!(along(both).unwrap().along, ["contact.a.segments", "mesh.order"]);
    let words = along("along = 'mesh.order'").unwrap_err();
    assert!(words.contains("along = \"mesh.order\": mesh.order stands in no grid; take one of its keys"), "{words}");
}

#[test]
fn the_studies_of_the_project_can_be_made() {
    let cases = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases");
    let studies = std::fs::read_dir(cases.join("studies")).unwrap().map(|entry| entry.unwrap().path());
    let studies = studies.filter(|path| path.extension().is_some_and(|extension| extension == "toml"));
    let mut count = 0;
    for file in studies.chain([cases.join("hard/study.toml")]) {
        let plan = Plan::read(&file, &[]).unwrap_or_else(|error| panic!("{error}"));
        let refused = |run: &&PlannedRun| Case::read(&run.file, &run.overrides).is_err();
        // The hard cases hold some that are refused.
        let found = plan.runs.iter().find(refused).filter(|_| !file.ends_with("hard/study.toml"));
        assert_eq!(found, None, "{}", file.display());
        count += 1;
    }
    assert!(count >= 4, "{count} studies");
}

#[test]
fn a_value_that_the_case_refuses_is_left_to_its_row() {
    assert_eq!(runs("cases = ['rings.toml']\ngrid.'mesh.order' = [7, 1]").len(), 2);
}

#[test]
fn errors_name_key_value_and_remedy() {
    let table = [
        ("ranks = [1]", "cases: missing; write cases = [\"case.toml\"]"),
        ("cases = []", "cases = []: must not be empty: give a list of case files"),
        ("cases = 'rings.toml'", "cases = \"rings.toml\": must be a list of case files, not of type string"),
        ("cases = ['rings.toml', 'rings.toml']", "entry 2 stands there twice"),
        ("cases = ['ring.toml']", "there is no file"),
        ("CASES\nrank = [1]", "rank: unknown key; did you mean \"ranks\"?"),
        ("CASES\nranks = [0]", "ranks = [0]: entry 1: must be a whole number of at least 1"),
        ("CASES\nranks = 2", "ranks = 2: must be a list of numbers of ranks, not of type integer"),
        ("CASES\nrepeat = 1.5", "repeat = 1.5: must be a whole number of at least 1"),
        ("CASES\ntimeout = 0", "timeout = 0: must be > 0"),
        ("CASES\ntimeout = 1e300", "must be at most"),
        ("CASES\nerror = 'errors..energy'", "must be a path in summary.json with dots, as in \"errors.energy\""),
        ("CASES\nerror = ['errors.energy', 'errors.energy']", "entry 2 stands there twice"),
        ("CASES\nerror = []", "must not be empty: give a list of paths in summary.json"),
        ("CASES\ncolumns = 'errors.energy'", "must be a list of paths in summary.json"),
        (
            "CASES\ngrid.'mesh.refine' = 3",
            "grid.\"mesh.refine\" = 3: must be a list of values, as in [2, 3], not of type integer",
        ),
        ("CASES\ngrid.'mesh.refine' = []", "must not be empty"),
        ("CASES\ngrid.'mesh.refine' = [0, 1, 0]", "entry 3 stands there twice; list each once"),
        ("CASES\ngrid.'mesh.grade' = [{ points = [[0, 1]] }, { points = [[0, 1.0]] }]", "entry 2 stands there twice"),
        ("CASES\ngrid.'mesh..refine' = [1]", "grid.\"mesh..refine\" = [1]: must be a key of the case with dots"),
        (
            "CASES\ngrid.'mesh.refin' = [1, 2]",
            "grid.\"mesh.refin\" = [1, 2]: unknown key; did you mean \"refine\"? (asked of case rings)",
        ),
        ("CASES\ngrid.mesh.refin = [1]", "grid.mesh.refin = [1]: unknown key"),
        ("CASES\ngrid = [1]", "grid = [1]: must be a table"),
        ("CASES\n[curve]\nname = 'a'", "curve: must be a list of tables; write [[curve]]"),
        ("CASES\n[[curve]]\nset = {}", "curve.1.name: missing; write name = \"P1/P0\""),
        ("CASES\n[[curve]]\nname = 'a'\nsets = {}", "curve.1.sets: unknown key; did you mean \"set\"?"),
        (
            "CASES\n[[curve]]\nname = 'a'\nset = { 'mesh.ordr' = 1 }",
            "curve.1.set.\"mesh.ordr\": unknown key; did you mean \"order\"?",
        ),
        (
            "CASES\n[[curve]]\nname = 'a'\ngrid = { 'mesh.ordr' = [1] }",
            "curve.1.grid.\"mesh.ordr\": unknown key; did you mean \"order\"?",
        ),
        ("CASES\n[[curve]]\nname = 'a'\ngrid = { 'mesh.order' = 1 }", "must be a list of values, as in [2, 3]"),
        (
            "CASES\n[[curve]]\nname = 'a'\nset = { 'mesh.order' = 1 }\ngrid = { 'mesh.order' = [1] }",
            "curve.1.grid.\"mesh.order\": is also set by curve.1.set.\"mesh.order\"; a key moves in one place",
        ),
        ("CASES\nalong = 'mesh..refine'", "must be a key of the case with dots, as in \"mesh.refine\""),
        ("CASES\ntime = 3", "time = 3: must be a string in quotes"),
        ("CASES\n[[curve]]\nname = 'a'\n[[curve]]\nname = 'a'", "curve.2.name: \"a\" is another curve's name"),
        ("CASES\n[[curve]]\nname = 'a'\ncases = ['rings.toml', 'bars.toml']", "\"bars.toml\" does not stand in cases"),
        (
            "CASES\ngrid.'mesh.order' = [1]\n[[curve]]\nname = 'a'\nset = { 'mesh.order' = 1 }",
            "is also set by grid.\"mesh.order\"; a key moves in one place",
        ),
        (
            "CASES\ngrid.'mesh.order' = [1]\nset.'mesh.order' = 2",
            "set.\"mesh.order\" = 2: is also set by grid.\"mesh.order\"; a key moves in one place",
        ),
        ("CASES\nset.'mesh.ordr' = 2", "set.\"mesh.ordr\" = 2: unknown key; did you mean \"order\"? (asked of case rings)"),
        ("CASES\nset = 2", "set = 2: must be a table"),
        ("CASES\nrepeat = 20000", "the study makes 20000 runs, more than 10000"),
        ("cases = [", "line 1, column"),
    ];
    for (text, words) in table {
        let error = only_error(&text.replace("CASES", "cases = ['rings.toml']"));
        assert!(error.contains(words), "{text}\n{error}");
    }
}

#[test]
fn a_case_that_no_curve_is_drawn_for_has_no_runs_and_is_told() {
    let words = only_error("cases = ['bars/case.toml', 'rings.toml']\n[[curve]]\nname = 'a'\ncases = ['rings.toml']");
    assert!(words.contains("no [[curve]] is drawn for \"bars/case.toml\""), "{words}");
}

#[test]
fn a_file_that_is_not_there_is_told() {
    let words = Plan::read(Path::new("nowhere/study.toml"), &[]).unwrap_err().to_string();
    assert!(words.contains("cannot be read") && words.contains("path of a study file"), "{words}");
}

#[test]
fn the_example_of_the_documentation_is_a_study() {
    let page = include_str!("../../../docs/studies.md");
    let example = page.split("```toml").nth(1).and_then(|rest| rest.split("```").next()).expect("an example");
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("study.toml");
    let plan = Plan::parse(example, &file, &[]).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(plan.runs.len(), 2 * 3 * 2 * 2 * 3);
    for run in &plan.runs {
        Case::read(&run.file, &run.overrides).unwrap_or_else(|error| panic!("{error}"));
    }
}
