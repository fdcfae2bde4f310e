//! The page of a result: whole, well-formed, of every kind of run.

use crate::support::{Ended, Run, names_in};
use std::fs;
use std::path::Path;
use std::process::Command;

/// Reads a page with Python's parser of XML, and prints what it holds: its figures, what it loads, and its identifiers.
const READ: &str = "
import sys, xml.etree.ElementTree as tree
page = tree.parse(sys.argv[1]).getroot()
bare = lambda name: name.split('}')[-1]
for element in page.iter():
    assert bare(element.tag) != 'script' or not element.attrib
    assert bare(element.tag) not in ('link', 'img', 'image', 'iframe', 'object', 'use'), element.tag
    for name, value in element.attrib.items():
        assert bare(name) not in ('src', 'data', 'action') and not name.startswith('on'), name
        assert bare(name) != 'href' or value.startswith('#'), value
        assert 'url(' not in value, value
names = [element.get('id') for element in page.iter() if element.get('id')]
assert len(names) == len(set(names)), names
links = [element.get('href')[1:] for element in page.iter() if bare(element.tag) == 'a']
assert all(link in names for link in links), links
assert all(figure.find('{http://www.w3.org/2000/svg}svg') is not None for figure in page.iter('{http://www.w3.org/1999/xhtml}figure'))
";

/// The page of a result, which Python has read.
fn page(out: &Path) -> String {
    let file = out.join("report.html");
    let text = fs::read_to_string(&file).unwrap_or_else(|error| panic!("{file:?}: {error}"));
    match Command::new("python3").arg("-c").arg(READ).arg(&file).output() {
        Ok(read) => assert!(read.status.success(), "{}", String::from_utf8_lossy(&read.stderr)),
        Err(error) => println!("skipped: nobody has read the page, since python3 does not start: {error}"),
    }
    text
}

/// The page holds every figure of its folder.
fn check_figures(ended: &Ended, page: &str) {
    let figures: Vec<String> = names_in(&ended.out).into_iter().filter(|name| name.ends_with(".svg")).collect();
    for name in &figures {
        let figure = fs::read_to_string(ended.out.join(name)).expect("a figure");
        let content = figure.split_once('>').expect("a tag").1;
        assert!(page.contains(content.trim()), "{name} is missing");
    }
    assert_eq!(page.matches("<figure>").count(), figures.len(), "{figures:?}");
}

/// Coordinates of the frame of a zoom, by the labels of its axes: the least and the largest of each.
fn labels(svg: &str, anchor: &str) -> [f64; 2] {
    let is_label = |line: &&str| line.starts_with("<text") && line.contains(&format!("text-anchor=\"{anchor}\""));
    let words = |line: &str| Some(line.split_once('>')?.1.strip_suffix("</text>")?.replace('−', "-"));
    let values = svg.lines().filter(is_label).filter_map(|line| words(line)?.parse::<f64>().ok());
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(value), high.max(value)])
}

#[test]
fn a_contact_that_is_small_beside_its_scene_is_shown_large() {
    let ended = Run::case("hertz").set("mesh.refine", 2).set("output.figures", "[\"sigma_1\", \"tau_max\"]").ranks(2).ended();
    let page = page(&ended.out);
    check_figures(&ended, &page);
    let zoom = fs::read_to_string(ended.out.join("deformed_seam_1.svg")).expect("a zoom");
    assert!(zoom.len() < 400_000, "{} bytes", zoom.len());
    let ends = ended.value("/contact/seam/closed_points/0");
    let x = |end: usize| ends[end][0].as_f64().expect("a number");
    let (low, high) = (x(0).min(x(1)), x(0).max(x(1)));
    let [first, last] = labels(&zoom, "middle");
    let width = high - low;
    assert!(first < low && last > high, "{first} to {last} around {low} to {high}");
    assert!(low - first < width && last - high < width, "{first} to {last} around {low} to {high}");
    assert!(ended.out.join("field_sigma_1.svg").exists() && page.contains("largest shear stress τ"));
    assert!(page.contains("Expected values") && page.contains("Estimated errors"));
    assert!(!zoom.contains("body 1") && !page.contains("body 1"));
}

#[test]
fn names_of_files_are_no_markup() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let cases = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/stack");
    let name = "<script>'&";
    let mesh = fs::read_dir(&cases).expect("a case").flatten().map(|entry| entry.path());
    let mesh = mesh.into_iter().find(|path| path.extension().is_some_and(|end| end == "msh")).expect("a mesh");
    let text = fs::read_to_string(mesh).expect("a mesh").replace("\"lower\"", &format!("\"{name}\""));
    fs::write(folder.path().join("scene.msh"), text).expect("a mesh");
    let case = fs::read_to_string(cases.join("case.toml")).expect("a case");
    let case = case.replace("body.lower]", &format!("body.\"{name}\"]"));
    let case: String = case
        .lines()
        .map(|line| match line {
            _ if line.trim_start().starts_with("file") => "file = \"scene.msh\"\n".into(),
            _ if line.starts_with("title") => format!("title = \"{name}\"\n"),
            _ => format!("{line}\n"),
        })
        .collect();
    let file = folder.path().join("case.toml");
    fs::write(&file, case).expect("a case");
    let ended = Run::file(&file).set("mesh.refine", 1).ended();
    assert!(ended.out.exists(), "{}", ended.said());
    let page = page(&ended.out);
    assert!(page.matches("<script").count() == 1 && page.contains("&lt;script&gt;"), "{page}");
    check_figures(&ended, &page);
    assert!(page.contains("Contact first") && page.contains("Contact second"));
}

#[test]
fn steps_adaptation_and_failure_have_their_pages() {
    let adapted = Run::case("bars_accuracy").set("accuracy", "3e-3").ended();
    let text = page(&adapted.out);
    check_figures(&adapted, &text);
    assert!(text.contains("<h3>Accuracy</h3>") && text.contains("<h3>Meshes</h3>"));
    let failed = Run::case("stack")
        .set("mesh.refine", 1)
        .set("exact.must_hold", true)
        .set("exact.energy", "{ value = 1.0, tolerance = 1e-9 }");
    let failed = failed.ended();
    assert_eq!(failed.code, Some(3), "{}", failed.said());
    let text = page(&failed.out);
    assert!(text.contains("<strong>Not converged</strong>") && text.contains(">missed<"), "{text}");
    let bare = Run::case("stack").set("mesh.refine", 1).set("output.fields", false).converged();
    assert!(!bare.out.join("report.html").exists());
}
