//! The commands of docs/paper.md, on the coarsest meshes: the studies are made, and the script draws what they give.

use std::fs;
use std::path::Path;
use std::process::Command;

/// Makes a study of the project with some of its words changed, into a folder beside it.
fn make(file: &str, changes: &[(&str, &str)], folder: &Path, name: &str) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut text = fs::read_to_string(root.join(file)).expect("a study");
    for (from, to) in changes {
        assert!(text.contains(from), "{file} has no {from}");
        text = text.replace(from, to);
    }
    let study = folder.join(format!("{name}.toml"));
    fs::write(&study, text).expect("a file can be written");
    let words = ["study", &study.display().to_string(), "--out", &folder.join(name).display().to_string()];
    let (code, output, errors) = crate::support::mezha(None, &words);
    assert_eq!(code, Some(0), "{output}{errors}");
    assert!(!output.contains("failed") && !output.contains("timeout"), "{output}{errors}");
}

#[test]
fn the_figures_and_tables_are_made() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let folder = tempfile::tempdir().expect("a temporary folder");
    let cases = root.join("cases/gls").display().to_string();
    let files = ["inclined", "parabola", "inclined_graded", "parabola_graded"];
    let places: Vec<[String; 2]> = files.map(|file| [format!("\"{file}.toml"), format!("\"{cases}/{file}.toml")]).to_vec();
    let mut changes: Vec<(&str, &str)> = places.iter().map(|[from, to]| (from.as_str(), to.as_str())).collect();
    changes.extend([("ranks   = [2]", ""), ("\"exact.must_hold\" = false", "\"exact.must_hold\" = false, \"mesh.refine\" = 1")]);
    make("cases/gls/study.toml", &changes, folder.path(), "gls");
    let changes = [
        ("../../cases/gls", cases.as_str()),
        ("\"mesh.refine\" = 3", "\"mesh.refine\" = 1"),
        ("5, 10, 20, 30, 60, 120, 240", "5"),
    ];
    make("docs/paper/study.toml", &changes, folder.path(), "paper");
    let changes = [("../../cases/gls", cases.as_str()), ("ranks   = [2]", ""), ("false }", "false, \"mesh.refine\" = 1 }")];
    make("docs/paper/points.toml", &changes, folder.path(), "points");

    let place = |name: &str| folder.path().join(name).display().to_string();
    let script = root.join("docs/paper/draw.py").display().to_string();
    let drawn = Command::new("python3")
        .args(["-B", &script, &place("gls"), &place("paper"), &place("points"), &place("")])
        .output()
        .expect("python3 starts");
    assert!(drawn.status.success(), "{}", String::from_utf8_lossy(&drawn.stderr));
    for name in ["figure_4.svg", "figure_6.svg", "errors.svg"] {
        let figure = fs::read_to_string(place(name)).expect("a figure");
        assert!(figure.starts_with("<svg ") && figure.matches("<polyline").count() > 100 && !figure.contains("nan"), "{name}");
    }
    for name in ["graded", "curves", "corner", "points", "segments"] {
        let table = fs::read_to_string(place(&format!("{name}.csv"))).expect("a table");
        let fields = |line: &str| line.matches(',').count();
        let (head, rows) = table.split_once('\n').expect("a head");
        assert!(!rows.is_empty() && rows.lines().all(|row| fields(row) == fields(head)), "{name}:\n{table}");
        match name {
            "curves" => assert!(rows.lines().any(|row| row.starts_with("figure 4,P2/P1 disc.,30,uncut,")), "{table}"),
            "segments" => assert!(head.split(',').any(|column| column == "oscillation"), "{table}"),
            _ => {}
        }
    }
}
