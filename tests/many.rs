//! Scenes of many contacts: what is said of them, drawn and written.

use crate::support::mesh::{Mesh, grid, write_scene};
use crate::support::{Ended, Run, mezha_in, names_in};
use std::fs;
use std::path::Path;

/// The rows of `contacts.csv` without its head: cells of each. No name of these cases needs quotes.
fn rows(folder: &Path) -> Vec<Vec<String>> {
    let text = fs::read_to_string(folder.join("contacts.csv")).expect("a table");
    text.lines().skip(1).map(|line| line.split(',').map(String::from).collect()).collect()
}

/// The table says what the summary says, of every contact.
fn check_table(ended: &Ended) -> usize {
    let (rows, summary) = (rows(&ended.out), ended.value("/contact"));
    assert_eq!(rows.len(), summary.as_object().expect("contacts").len());
    for row in &rows {
        let number = |at: usize| row[at].parse::<f64>().unwrap_or_else(|_| panic!("{row:?}"));
        let contact = &summary[&row[0]];
        let value = |key: &str| contact[key].as_f64().expect("a number");
        assert_eq!((number(3), number(9)), (value("force"), value("pressure_max")), "{row:?}");
        let resultant = [0, 1].map(|axis| contact["resultant"][axis].as_f64().expect("a number"));
        let size = resultant[0].hypot(resultant[1]);
        assert!((number(4) * size - resultant[0]).abs() < 1e-9 * size && (number(5) * size - resultant[1]).abs() < 1e-9 * size);
        // The force at its place has the moment of the contact, up to the quadrature of the place.
        let (moment, reach) = (number(6) * resultant[1] - number(7) * resultant[0], value("length") * size);
        assert!((moment - value("moment")).abs() < 0.02 * reach, "{row:?}: {moment} instead of {}", value("moment"));
        assert_eq!(contact["verdict"].as_str(), Some(row[11].as_str()));
    }
    rows.len()
}

#[test]
fn a_result_of_many_contacts_is_summed_up() {
    for ranks in [1, 2] {
        let ended = Run::case("chain_50").ranks(ranks).converged();
        assert_eq!(check_table(&ended), 49);
        let of_contacts: Vec<&str> = ended.output.lines().filter(|line| line.contains("contact")).collect();
        assert!(of_contacts.len() <= 8, "{of_contacts:#?}");
        assert!(ended.output.contains("\n49 contacts: ") && ended.output.contains("; the largest 3: "), "{}", ended.output);
        let names = names_in(&ended.out);
        let count = |start: &str, end: &str| names.iter().filter(|name| name.starts_with(start) && name.ends_with(end)).count();
        assert_eq!(["pressure_", "gap_", "displacement_"].map(|figure| count(figure, ".svg")), [8; 3], "{names:?}");
        assert_eq!((count("contact_", ".csv"), count("contact_", ".vtu")), (49, 8), "{names:?}");
        let page = fs::read_to_string(ended.out.join("report.html")).expect("a page");
        assert!(page.contains("49 contacts: ") && page.contains("the 41 others have none"), "{page}");
        assert!(fs::read_to_string(ended.out.join("deformed.svg")).expect("a figure").contains("contact force, up to"));
    }
}

#[test]
fn figures_of_some_contacts_are_all_there() {
    let ended = Run::case("stack_16").ranks(2).converged();
    assert_eq!(check_table(&ended), 15);
    let names = names_in(&ended.out);
    assert_eq!(names.iter().filter(|name| name.starts_with("pressure_")).count(), 15, "{names:?}");
    assert!(ended.output.contains("\n15 contacts: "), "{}", ended.output);
}

/// A pressed pair of blocks, and one beside the lower one that it hardly touches, because it hardly widens.
#[test]
fn a_contact_that_hardly_carries_anything_is_called_what_it_is() {
    let block = |[x0, x1]: [f64; 2], [y0, y1]: [f64; 2], cells: usize, seed: u64| {
        grid(cells, cells, seed, move |u, v| [x0 + u * (x1 - x0), y0 + v * (y1 - y0)])
    };
    let mesh = Mesh {
        bodies: vec![
            ("lower", block([0.0, 2.0], [0.0, 1.0], 4, 1), ["bottom", "lower.side", "lower.top", "left"]),
            ("upper", block([0.0, 2.0], [1.0, 2.0], 5, 2), ["upper.bottom", "", "top", "left"]),
            ("beside", block([2.0, 3.0], [0.0, 1.0], 3, 3), ["bottom", "right", "", "beside.side"]),
        ],
    };
    let case = r#"
mesh = { file = "mesh.msh", refine = 1 }
body.lower = { young = 7000.0, poisson = 1e-6 }
body.upper = { young = 7000.0, poisson = 0.0 }
body.beside = { young = 7000.0, poisson = 0.0 }
support.table = { on = "bottom", uy = 0.0 }
support.walls = { on = ["left", "right"], ux = 0.0 }
load.top = { on = "top", pressure = 1.0 }
contact.seam = { between = ["lower.top", "upper.bottom"], curve = "line", gap = "closed" }
contact.side = { between = ["lower.side", "beside.side"], curve = "line", gap = "closed" }
"#;
    for ranks in [1, 2] {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let ended = Run::file(&write_scene(folder.path(), &mesh.text(), case)).ranks(ranks).converged();
        assert_eq!(check_table(&ended), 2);
        let force = ended.number("/contact/side/force");
        assert!(force > 0.0 && force < 1e-4 * ended.number("/contact/seam/force"), "{force}");
        let words = "touches; carries less than 1e-4 of the largest force";
        assert_eq!(ended.value("/contact/side/verdict"), words);
        assert_eq!((ended.value("/contact/side/trust"), ended.value("/contact/seam/verdict")), (true.into(), "trusted".into()));
        assert!(ended.output.contains(&format!("contact side {}", words.replace("; ", " and "))), "{}", ended.said());
    }
}

/// Many blocks on one plate: each contact is drawn, and named, where its own block lies.
#[test]
fn a_contact_is_drawn_where_its_sides_lie_close() {
    let count = 70;
    let block = |k: usize, seed: u64| grid(2, 2, seed, move |u, v| [3.0 * k as f64 + u, 1.0 + v]);
    let names = |word: &str| -> Vec<&'static str> { (0..count).map(|k| &*format!("{word}{k}").leak()).collect() };
    let (bodies, feet) = (names("block"), names("foot"));
    let plate = grid(count, 1, 1, |u, v| [3.0 * count as f64 * u, v]);
    let mut all = vec![("plate", plate, ["bottom", "", "plate.top", ""])];
    all.extend((0..count).map(|k| (bodies[k], block(k, k as u64), [feet[k], "", "tops", "walls"])));
    let mut case = "mesh = { file = \"mesh.msh\" }\nbody.plate = { young = 1.0, poisson = 0.3 }\n".to_owned();
    for k in 0..count {
        case += &format!("body.{} = {{ young = 1.0, poisson = 0.3 }}\n", bodies[k]);
        case += &format!("contact.c{k} = {{ between = [\"plate.top\", \"{}\"], gap = \"closed\" }}\n", feet[k]);
    }
    case += "support.table = { on = \"bottom\", ux = 0.0, uy = 0.0 }\nsupport.walls = { on = \"walls\", ux = 0.0 }\n";
    case += "load.top = { on = \"tops\", pressure = 1.0 }\n";
    let folder = tempfile::tempdir().expect("a temporary folder");
    write_scene(folder.path(), &Mesh { bodies: all }.text(), &case);
    let (code, output, errors) = mezha_in(folder.path(), None, &["check", "case.toml", "--draw", "scene.svg"]);
    assert_eq!(code, Some(0), "{output}{errors}");
    assert!(output.contains("\n70 contacts: ") && output.contains("71 bodies or parts (plate, block0, block1"), "{output}");
    let figure = fs::read_to_string(folder.path().join("scene.svg")).expect("a figure");
    // Anchors of the numbers that are left, from left to right.
    let is_number = |line: &&str| line.contains("font-size=\"120\"") && line.contains("bold") && !line.contains("stroke=");
    let named: Vec<&str> = figure.lines().filter(is_number).collect();
    let place = |line: &&str| line.split("x=\"").nth(1).and_then(|rest| rest.split('"').next()?.parse::<f64>().ok());
    let places: Vec<f64> = named.iter().filter_map(place).collect();
    assert!(places.len() > 12 && places.len() <= count, "{named:#?}");
    // Each stands near its block: numbers give way to each other by a tenth of the figure.
    let step = (places[places.len() - 1] - places[0]) / (places.len() - 1) as f64;
    let is_near = |(k, place): (usize, &f64)| (place - places[0] - k as f64 * step).abs() < 1000.0;
    assert!(step > 50.0 && places.iter().enumerate().all(is_near), "{places:?}");
    assert!(figure.contains(" of 70 contacts (rows of contacts.csv)"), "what is left out is counted");
}
