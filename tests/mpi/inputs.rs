//! A table of bad inputs, each refused by `check` and by `run` with the same words, which name file, key and remedy, on 1, 2 and 3
//! ranks; nothing is written.

mod launch;
#[path = "../support/mesh.rs"]
#[allow(dead_code)] // Other programs use the rest.
mod meshes;

use launch::{Suite, named};
use meshes::{GOOD, Mesh, grid, two_blocks, write_scene};
use mezha::arguments::ShowProgress;
use mezha::output::RunError;
use mezha::petsc::Session;
use mezha::run::{self, RunOptions};
use std::cell::RefCell;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Kinds of bad input at least.
const KINDS: usize = 200;

/// Keys of the good case, values and words.
const KEYS: &str = include_str!("inputs/keys.txt");

/// A piece of the good mesh, what stands in its place, and what the words have beside the file.
const MESHES: [(&str, &str, &str); 36] = [
    ("$MeshFormat\n", "", "first line must be $MeshFormat"),
    ("$MeshFormat\n", "# a comment\n", "first line must be $MeshFormat"),
    ("4.1 0 8", "4 0 8", "-format msh41"),
    ("4.1 0 8", "4.1 1 8", "the order of bytes of this binary file is not known"),
    ("4.1 0 8", "", "only 2.2 and 4.1"),
    ("$EndMeshFormat", "$EndMesh", "expected $EndMeshFormat"),
    ("$PhysicalNames\n", "$Comments\n", "cut off"),
    ("$PhysicalNames\n8", "$PhysicalNames\nmany", "expected 1 numbers"),
    ("$PhysicalNames\n8", "$PhysicalNames\n9", "dimension tag"),
    ("$PhysicalNames\n8", "$PhysicalNames\n-8", "expected 1 numbers"),
    ("1 1 \"bottom\"", "1 1", "dimension tag"),
    ("1 1 \"bottom\"", "1 1 \"low\"", "no physical curve \"bottom\""),
    ("2 1 \"lower\"", "2 1 \"lover\"", "did you mean \"lover\""),
    ("\n1 0 0 0 0 0 0 1 1 0\n", "\n1.7 0 0 0 0 0 0 1 1 0\n", "must be a whole number"),
    ("\n1 0 0 0 0 0 0 1 1 0\n", "\n1 0 0 0 0 0 0 1e300 1 0\n", "must be a whole number"),
    ("\n1 0 0 0 0 0 0 1 1 0\n", "\n1 0 0 0 0 0 0 9 1 0\n", "expected 9 physical tags"),
    ("\n1 0 0 0 0 0 0 1 1 0\n", "\n1 0 0 0 0 0 0 -1 1 0\n", "expected -1 physical tags"),
    ("\n1 0 0 0 0 0 0 1 1 0\n", "\n1 0 0 0 0\n", "expected 8 numbers"),
    ("$Entities\n", "$Entities\nnone\n", "expected 4 numbers"),
    ("$EndEntities", "$EndEntitys", "expected $EndEntities"),
    ("$Nodes\n", "$Nodes\n2\n", "expected 4 numbers"),
    ("$Nodes\n", "$Nodes\n2 27 1 1e9\n", "expected 4 numbers"),
    ("\n0.0 0.0 0\n", "\n0.0 0.0 0.5\n", "plane z = 0"),
    ("\n0.0 0.0 0\n", "\n0.0 nan 0\n", "not a finite number"),
    ("\n0.0 0.0 0\n", "\n0.0 1e999 0\n", "not a finite number"),
    ("\n0.0 0.0 0\n", "\n0.0 0.0\n", "expected 3 numbers"),
    ("\n0.0 0.0 0\n", "\nzero 0.0 0\n", "expected 3 numbers"),
    ("\n0.0 0.0 0\n", "\n2.0 0.0 0\n", "mesh"),
    ("$Elements\n", "$Elemente\n", "cut off"),
    ("\n2 1 2 12\n", "\n2 1 3 12\n", "expected 5 numbers"),
    ("\n2 1 2 12\n", "\n2 1 21 12\n", "-order 1"),
    ("\n2 1 2 12\n", "\n2 1 4 12\n", "gmsh -2"),
    ("\n2 1 2 12\n", "\n2 9 2 12\n", "exactly one physical surface"),
    ("\n2 1 2 12\n", "\n2 1 2 13\n", "mesh.msh, line"),
    ("\n2 1 2 12\n", "\n2 1 2 -1\n", "expected"),
    ("$EndElements\n", "", "cut off"),
];

/// Texts after the good case, and what the words have beside the file.
const TEXTS: [(&str, &str); 24] = [
    ("=", "line 9"),
    ("a = ", "line 9"),
    ("[mesh", "line 9"),
    ("mesh.file = \"other.msh\"", "duplicate key"),
    ("body.lower.young = 1", "cannot extend value"),
    ("x = 99999999999999999999", "write it with a dot or an exponent"),
    ("x = 1e", "line 9"),
    ("x = \"open", "line 9"),
    ("x = 'open", "line 9"),
    ("x = [1, 2", "unclosed array"),
    ("x = { a = 1", "unclosed inline table"),
    ("x = 2024-99-99", "line 9"),
    ("x = \u{1}", "line 9"),
    ("\u{feff}x = 1", "line 9"),
    ("young = 7000", "unknown key"),
    ("[bodies.lower]", "bodies: unknown key; there are title, mesh"),
    ("support.\"a.b\".ux = 0", "missing; write on"),
    ("plane = \"axisymmetric\"\nthickness = 2.0", "a body of revolution has none"),
    ("plane = \"axisymmetric\"\ngravity.g = [1, 0]", "along the axis of revolution alone"),
    ("plane = \"axisymmetric\"\nsupport.m = { body = \"upper\", mean = true, ux = 1.0 }", "moves along its axis alone"),
    ("plane = \"axisymmetric\"\nload.m = { on = \"top\", rigid = true, moment = 1.0 }", "moves along its axis alone"),
    ("plane = \"axisymmetric\"\nrigid.m = { circle = { centre = [0, 3], radius = 1 }, ux = 1.0 }", "moves along its axis alone"),
    ("plane = \"axisymmetric\"\nload.p = { at = [0, 0], force = [1, 0] }", "nothing is radial"),
    ("plane = \"axisymmetric\"\nexact.body.upper = { stress = [\"1\", \"1\", \"0\"] }", "lacks the hoop stress"),
];

fn main() -> std::process::ExitCode {
    Suite {
        options: (&[], &[]),
        checks: named![
            keys_are_refused_alike,
            meshes_are_refused_alike,
            texts_are_refused_alike,
            scenes_are_refused_alike,
            names_and_keys_are_told_at_once,
            long_inputs_are_told_in_few_words,
            there_are_many_kinds,
        ],
        outside: &[],
        scenarios: &[],
    }
    .run()
}

fn blocks() -> Mesh {
    two_blocks([(3, 2, 1), (4, 2, 2)])
}

/// Rows of the table of keys: key, value, words.
fn keys() -> Vec<[&'static str; 3]> {
    let rows = KEYS.lines().filter(|line| !line.starts_with('#'));
    rows.map(|line| line.split(" | ").collect::<Vec<_>>().try_into().expect("key | value | words")).collect()
}

/// A folder that all ranks see, and the first one clears away.
struct Place {
    folder: PathBuf,
    _own: Option<tempfile::TempDir>,
    /// What was not as it should be.
    wrong: RefCell<Vec<String>>,
}

impl Place {
    fn new(session: &Session) -> Self {
        let mut own = None;
        let make = || {
            let folder = tempfile::tempdir().map_err(|error| error.to_string())?;
            let path = folder.path().to_string_lossy().into_owned().into_bytes();
            own = Some(folder);
            Ok::<_, String>(path)
        };
        let path = session.share(make).expect("a temporary folder");
        Self { folder: PathBuf::from(String::from_utf8(path).expect("a path")), _own: own, wrong: RefCell::default() }
    }

    /// Writes a scene, and gives its case file.
    fn write(&self, session: &Session, mesh: &str, case: &str) -> PathBuf {
        let write = || Ok::<_, String>(write_scene(&self.folder, mesh, case).to_string_lossy().into_owned().into_bytes());
        let path = session.share(write).expect("a scene can be written");
        PathBuf::from(String::from_utf8(path).expect("a path"))
    }

    /// What `run` says of a case.
    fn run(&self, session: &Session, file: &Path, overrides: &[String]) -> Result<(), RunError> {
        let out = self.folder.join("result");
        let options =
            RunOptions { out, inputs: None, force: false, quiet: true, progress: ShowProgress::Auto, started: Instant::now() };
        let case = run::read_case(file, overrides, None, session)?;
        run::run(&case, &options, session).map(|_| ())
    }

    /// Refused by both with the same words, which have these in them, and nothing written. Gives the words; what is not so is told
    /// at the end.
    fn refused(&self, session: &Session, file: &Path, overrides: &[String], words: &[&str]) -> String {
        let by_run = self.run(session, file, overrides).err();
        let by_check = run::check_file(file, overrides).err();
        let codes = [&by_run, &by_check].map(|error| error.as_ref().map(RunError::code));
        let [by_run, by_check] = [by_run, by_check].map(|error| error.map_or("nothing".into(), |error| error.to_string()));
        let folders = || std::fs::read_dir(&self.folder).expect("a folder").map(|entry| entry.expect("an entry").path());
        let missing = words.iter().find(|word| !by_check.contains(**word));
        let wrong = if codes != [Some(2); 2] {
            format!("codes of run and check {codes:?}")
        } else if by_run != by_check {
            format!("run says otherwise: {by_run}")
        } else if let Some(word) = missing {
            format!("no `{word}`")
        } else if by_check.len() > 20_000
            || by_check.lines().count() > 50
            || by_check.chars().any(|c| c.is_control() && c != '\n')
        {
            format!("{} bytes on {} lines", by_check.len(), by_check.lines().count())
        } else if let Some(folder) = folders().filter(|_| session.rank() == 0).find(|path| path.is_dir()) {
            let _ = std::fs::remove_dir_all(&folder);
            format!("{} is left", folder.display())
        } else {
            String::new()
        };
        if !wrong.is_empty() {
            let given: String = format!("{overrides:?} {words:?}").chars().take(300).collect();
            let check: String = by_check.chars().take(300).collect();
            self.wrong.borrow_mut().push(format!("{given}: {wrong}; check says: {check}"));
        }
        // The next scene is written when all have read this one.
        session.any(false);
        by_check
    }

    /// Everything was as it should be.
    fn end(&self) {
        let wrong = self.wrong.borrow();
        assert!(wrong.is_empty(), "{} inputs:\n{}", wrong.len(), wrong.join("\n"));
    }
}

fn keys_are_refused_alike(session: &Session) {
    let place = Place::new(session);
    let file = place.write(session, &blocks().text(), GOOD);
    for [key, value, words] in keys() {
        let first = key.split(['.', '=']).next().unwrap_or_default();
        // A file that is named is told by its own name.
        let wanted = if key == "mesh.file" { "/" } else { first };
        place.refused(session, &file, &[format!("{key}={value}")], &[words, wanted, &*place.folder.to_string_lossy()]);
    }
    place.end();
}

fn meshes_are_refused_alike(session: &Session) {
    let (place, good) = (Place::new(session), blocks().text());
    for (from, to, words) in MESHES {
        let text = good.replacen(from, to, 1);
        assert_ne!(text, good, "the mesh has no `{from}`");
        let file = place.write(session, &text, GOOD);
        place.refused(session, &file, &[], &[words, "mesh.msh"]);
    }
    let file = place.write(session, "", GOOD);
    place.refused(session, &file, &[], &["mesh.msh: is empty"]);
    place.end();
}

fn texts_are_refused_alike(session: &Session) {
    let place = Place::new(session);
    for (text, words) in TEXTS {
        let file = place.write(session, &blocks().text(), &format!("{GOOD}{text}\n"));
        place.refused(session, &file, &[], &[words, "case.toml"]);
    }
    place.refused(session, &place.folder.join("nothing.toml"), &[], &["nothing.toml: cannot be read"]);
    place.refused(session, Path::new("/dev/zero"), &[], &["/dev/zero: cannot be read", "no regular file"]);
    let file = place.write(session, &blocks().text(), GOOD);
    for (words, told) in [("a", "must be KEY=VALUE"), ("=1", "must be KEY=VALUE"), ("mesh.file.x=1", "is a value, not a table")] {
        place.refused(session, &file, &[words.into()], &[told, "--set"]);
    }
    place.end();
}

/// Meshes and curves that do not go together.
fn scenes_are_refused_alike(session: &Session) {
    let place = Place::new(session);
    let refused = |mesh: &Mesh, case: &str, overrides: &[&str], words: &[&str]| {
        let file = place.write(session, &mesh.text(), case);
        let overrides: Vec<String> = overrides.iter().map(|text| (*text).to_owned()).collect();
        place.refused(session, &file, &overrides, words);
    };
    let folded = |below: f64| {
        let lower = grid(1, 1, 1, |u, v| [2.0 * u, below * v]);
        let upper = grid(1, 1, 2, |u, v| [2.0 * u, below + v]);
        Mesh {
            bodies: vec![
                ("lower", lower, ["bottom", "right", "lower.seam", "left"]),
                ("upper", upper, ["upper.seam", "right", "top", "left"]),
            ],
        }
    };
    let circle = "geometry.arc = { curves = [\"lower.seam\", \"upper.seam\"], circle = { centre = [1.0, 0.8201562118716424], radius = 1.05 } }\n";
    let arc = GOOD.replace("curve = \"line\"", "curve = \"geometry\"") + circle;
    for overrides in
        [&["mesh.refine=2"][..], &["mesh.refine=0"], &["mesh.order=1", "mesh.refine=3"], &["mesh.refine=2", "solver.name=direct"]]
    {
        refused(&folded(0.5), &arc, overrides, &["turned inside out", "the triangle around (", "[geometry]", "case.toml"]);
    }
    let mut apart = blocks();
    apart.bodies[1].1.points.iter_mut().for_each(|x| x[0] += 5.0);
    refused(&apart, GOOD, &[], &["contact.seam", "do not face each other"]);
    refused(&apart, GOOD, &["contact.seam.curve=fit"], &["contact.seam"]);
    let mut pieces = blocks();
    pieces.bodies[1].1.sides[0].remove(1);
    refused(&pieces, GOOD, &["contact.seam.curve=fit"], &["of pieces that do not hang together"]);
    let steps = blocks().map(|[x, y]| [x, if y == 1.0 { y + 0.3 * (x - 1.0).abs() } else { y }]);
    refused(&steps, GOOD, &["contact.seam.curve=fit"], &["has corners of more than 20 degrees"]);
    refused(&steps, GOOD, &[], &["is not straight"]);
    let huge = blocks().map(|x| x.map(|x| 1e308 * x));
    refused(&huge, GOOD, &[], &["mesh.msh"]);
    for gap in ["sqrt(x-5)", "1/(x-x)", "sqrt(x-1)"] {
        let gap = format!("contact.seam.gap={gap}");
        refused(&blocks(), GOOD, &["contact.seam.curve=fit", &gap], &["contact.seam", "is no number at"]);
    }
    let name = "n".repeat(300);
    let case = GOOD.replace("contact.seam", &format!("contact.{name}"));
    refused(&blocks(), &case, &[], &["300 bytes", "file name"]);
    place.end();
}

/// Keys, values and names of one file are told together.
fn names_and_keys_are_told_at_once(session: &Session) {
    let place = Place::new(session);
    let case = GOOD.replace("on = \"top\"", "on = \"topp\"").replace("\"upper.seam\"", "\"uper.seam\"");
    let more = "extra = 1\n[solver]\ntolerance = 2\n";
    let file = place.write(session, &blocks().text(), &format!("{case}{more}"));
    let told = ["extra: unknown key", "solver.tolerance = 2", "\"top\"?", "\"upper.seam\"?"];
    let words = place.refused(session, &file, &[], &told);
    assert_eq!(words.lines().count(), 4, "{words}");
    // Names are looked for where other values of their tables are bad, too; a body with a bad value is not said to be missing.
    let case = case.replace("curve = \"line\"", "curve = \"lines\"").replace("pressure = 1.0", "pressure = \"1+\"");
    let case = case.replace("poisson = 0.227", "poisson = 0.7");
    let file = place.write(session, &blocks().text(), &format!("{case}{more}"));
    let bad = ["contact.seam.curve = \"lines\"", "load.top.pressure = \"1+\"", "body.lower.poisson = 0.7"];
    let words = place.refused(session, &file, &[], &[&told[..], &bad].concat());
    assert_eq!(words.lines().count(), 7, "{words}");
    // A tool that cannot be read is no name that the mesh lacks.
    let case = GOOD.replace("\"upper.seam\"", "\"rigid.die\"");
    let file =
        place.write(session, &blocks().text(), &format!("{case}rigid.die = {{ line = [[0, 1], [2, 1]], uy = \"down\" }}\n"));
    let words = place.refused(session, &file, &[], &["rigid.die.uy = \"down\""]);
    assert_eq!(words.lines().count(), 1, "{words}");
    place.end();
}

fn long_inputs_are_told_in_few_words(session: &Session) {
    let place = Place::new(session);
    let long = "n".repeat(1 << 20);
    let many: String = (0..20_000).map(|k| format!("key{k} = 1\n")).collect();
    let file = place.write(session, &blocks().text(), &(GOOD.replacen("mesh.file", &format!("{many}mesh.file"), 1)));
    place.refused(session, &file, &[], &["key0: unknown key", "19960 more of them"]);
    for extra in [
        format!("{long} = 1"),
        format!("x = \"{long}\""),
        format!("title = {long}"),
        format!("support.{long} = {{ on = \"right\", ux = 0, uz = 1 }}"),
        format!("support.a = {{ on = \"{long}\", ux = 0 }}"),
        format!("support.a = {{ on = \"right\", ux = \"{long}\" }}"),
        format!("probe.a = {{ point = [1, 1], body = \"{long}\" }}"),
        format!("load.a = {{ on = \"right\", pressure = \"1/(x-x) + 0*{}x\" }}", "1*".repeat(100_000)),
    ] {
        let file = place.write(session, &blocks().text(), &format!("{GOOD}{extra}\n"));
        place.refused(session, &file, &[], &[]);
    }
    for (from, to) in [
        ("1 1 \"bottom\"", format!("1 1 \"{long}\"")),
        ("$Nodes\n", format!("$Nodes\n{long}\n")),
        ("$Nodes\n", format!("{long}\n")),
    ] {
        let file = place.write(session, &blocks().text().replacen(from, &to, 1), GOOD);
        place.refused(session, &file, &[], &[]);
    }
    place.end();
}

fn there_are_many_kinds(_session: &Session) {
    let mut all: Vec<String> = keys().iter().map(|row| row.concat()).collect();
    all.extend(MESHES.iter().map(|(from, to, _)| format!("{from}{to}")));
    all.extend(TEXTS.iter().map(|(text, _)| (*text).to_owned()));
    let count = all.len();
    all.sort();
    all.dedup();
    assert_eq!(all.len(), count, "each once");
    assert!(count >= KINDS, "{count} kinds of bad input");
}
