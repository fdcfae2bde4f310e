//! Meshes as other people write them: any order of blocks, tags, corners and sections gives the same scene.

use crate::support::mesh::{GOOD, Mesh, Random, read_gmsh, write_scene};
use crate::support::{Run, difference};
use mezha::mesh::Boundary;
use std::collections::HashMap;
use std::path::Path;
use std::process::Command;

/// Shuffles a list (Fisher, Yates).
fn shuffle<T>(list: &mut [T], random: &mut Random) {
    for k in (1..list.len()).rev() {
        list.swap(k, (random.next() * (k + 1) as f64) as usize);
    }
}

/// The lines of a section.
fn section<'a>(text: &'a str, name: &str) -> Vec<&'a str> {
    let (begin, end) = (format!("${name}\n"), format!("$End{name}"));
    let from = text.find(&begin).expect("a section") + begin.len();
    text[from..text.find(&end).expect("its end")].lines().collect()
}

/// A list of blocks: a header whose fourth number counts, and the lines that follow.
fn blocks<'a>(lines: &[&'a str], lines_per_entry: usize) -> Vec<(&'a str, Vec<&'a str>)> {
    let (mut at, mut found) = (1, Vec::new());
    while at < lines.len() {
        let count: usize = lines[at].split(' ').nth(3).expect("a count").parse().expect("a number");
        let end = at + 1 + count * lines_per_entry;
        found.push((lines[at], lines[at + 1..end].to_vec()));
        at = end;
    }
    found
}

/// The same mesh, jumbled: tags of nodes far apart and in no order, blocks, elements and corners shuffled, some triangles
/// clockwise, nodes that nobody uses, points as elements, blank lines, and sections that do not matter.
fn jumbled(text: &str, seed: u64) -> String {
    let mut random = Random(seed);
    let mut nodes: Vec<(String, String)> = Vec::new();
    let mut names: HashMap<String, String> = HashMap::new();
    for (_, lines) in blocks(&section(text, "Nodes"), 2) {
        let (tags, places) = lines.split_at(lines.len() / 2);
        nodes.extend(tags.iter().zip(places).map(|(tag, place)| (tag.to_string(), place.to_string())));
    }
    let mut tags: Vec<usize> = (0..nodes.len()).map(|k| 1000 + 17 * k).collect();
    shuffle(&mut tags, &mut random);
    for ((old, _), new) in nodes.iter().zip(&tags) {
        names.insert(old.clone(), new.to_string());
    }
    nodes.push(("loose".into(), "-77.5 3e2 0".into()));
    names.insert("loose".into(), "7".into());
    shuffle(&mut nodes, &mut random);
    let mut elements = blocks(&section(text, "Elements"), 1);
    shuffle(&mut elements, &mut random);
    let mut out = format!(
        "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n\n$Comments\nas exported\n$EndComments\n$PhysicalNames\n{}\n$EndPhysicalNames\n",
        section(text, "PhysicalNames").join("\n")
    );
    out += &format!("$Entities\n{}\n$EndEntities\n", section(text, "Entities").join("\n"));
    let half = nodes.len() / 2;
    out += &format!("$Nodes\n3 {} 7 99999\n", nodes.len());
    for (entity, part) in [("2 1 0", &nodes[..half]), ("1 1 0", &[]), ("2 2 0", &nodes[half..])] {
        out += &format!("{entity} {}\n", part.len());
        part.iter().for_each(|(tag, _)| out += &format!("{}\n", names[tag]));
        part.iter().for_each(|(_, place)| out += &format!("{place}\n"));
    }
    out += &format!("$EndNodes\n$Elements\n{} 99 1 99\n", elements.len() + 1);
    out += "0 1 15 1\n4711 1000\n\n";
    for (header, mut lines) in elements {
        shuffle(&mut lines, &mut random);
        out += &format!("{header}\n");
        for line in lines {
            let words: Vec<&str> = line.split(' ').collect();
            let mut corners: Vec<&String> = words[1..].iter().map(|tag| &names[*tag]).collect();
            shuffle(&mut corners, &mut random);
            out += &format!("{} ", (random.next() * 1e6) as usize);
            out += &corners.iter().map(|tag| tag.as_str()).collect::<Vec<_>>().join("  ");
            out += "\n";
        }
    }
    out + "$EndElements\n$Periodic\n0\n$EndPeriodic\n"
}

#[test]
fn a_jumbled_mesh_is_the_same_scene() {
    let good = Mesh::inclined_bars(1).text();
    let folder = tempfile::tempdir().expect("a temporary folder");
    let results = |text: &str| {
        let ended = Run::file(&write_scene(folder.path(), text, GOOD))
            .ranks(2)
            .set("mesh.refine", 1)
            .set("solver.tolerance", 1e-12)
            .converged();
        let lambda = ended.trace("seam").iter().map(|point| point.lambda).collect::<Vec<_>>();
        (ended.number("/energy/total"), lambda, ended.number("/mesh/vertices"))
    };
    let wanted = results(&good);
    for seed in 1..=4 {
        let found = results(&jumbled(&good, seed));
        assert!((found.0 / wanted.0 - 1.0).abs() < 1e-9, "U = {} instead of {}", found.0, wanted.0);
        assert!(difference(&found.1, &wanted.1) < 1e-8);
        assert_eq!(found.2, wanted.2, "loose nodes are left out");
    }
}

#[test]
fn a_jumbled_mesh_has_the_same_bodies_and_boundaries() {
    let good = Mesh::inclined_bars(2).text();
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = folder.path().join("mesh.msh");
    let mut measures = Vec::new();
    for text in std::iter::once(good.clone()).chain((1..=9).map(|seed| jumbled(&good, seed))) {
        std::fs::write(&file, text).expect("a mesh can be written");
        let mesh = read_gmsh(&file).expect("a mesh");
        let area = |body: &str| -> f64 {
            let body = mesh.bodies.iter().position(|name| name == body).expect("a body") as u32;
            let area = |corners: [u32; 3]| {
                let [a, b, c] = corners.map(|corner| mesh.vertices[corner as usize]);
                0.5 * ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x))
            };
            let areas: Vec<f64> = mesh.triangles.iter().filter(|t| t.body == body).map(|t| area(t.vertices)).collect();
            assert!(areas.iter().all(|area| *area > 0.0), "counter-clockwise");
            areas.iter().sum()
        };
        let length =
            |name: &str| mesh.boundary(name).expect("a boundary").edges.iter().map(|&e| mesh.edge_length(e)).sum::<f64>();
        let names = ["bottom", "right", "lower.seam", "upper.seam", "top", "left"];
        measures.push([vec![area("lower"), area("upper")], names.iter().map(|name| length(name)).collect()].concat());
    }
    let wanted = [21.0, 15.0, 6.0, 6.0, 37f64.sqrt(), 37f64.sqrt(), 6.0, 6.0];
    assert!(measures.iter().all(|found| difference(found, &wanted) < 1e-12), "{measures:?}");
}

/// What `to_gmsh` writes is read by others to the same counts: `MEZHA_PYTHON` is an interpreter that has `meshio`, and gmsh if
/// it shall be asked, too.
#[test]
fn others_read_what_is_written() {
    let Some(python) = std::env::var_os("MEZHA_PYTHON") else {
        println!("skipped: MEZHA_PYTHON is not set, so nobody has read the files");
        return;
    };
    let cases = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases");
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut wanted = String::new();
    for name in ["bars", "rings", "stack"] {
        let place = if name == "bars" { "patch_inclined" } else { name };
        let mut mesh = read_gmsh(&cases.join(place).join(format!("{name}.msh"))).expect("a mesh");
        let twice = mesh.boundaries[0].edges.clone();
        mesh.boundaries.push(Boundary { name: "twice".into(), edges: twice, is_union: false });
        std::fs::write(folder.path().join(format!("{name}.msh")), mesh.to_gmsh()).expect("a mesh can be written");
        let bodies = mesh
            .bodies
            .iter()
            .enumerate()
            .map(|(body, name)| (name, mesh.triangles.iter().filter(|triangle| triangle.body as usize == body).count()));
        let mut counts: Vec<_> = bodies.chain(mesh.boundaries.iter().map(|b| (&b.name, b.edges.len()))).collect();
        counts.sort();
        let counts: Vec<String> = counts.iter().map(|(name, count)| format!("{name} {count}")).collect();
        wanted += &format!("{name}.msh: {} points; {}\n", mesh.vertices.len(), counts.join("; "));
    }
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/mesh_readable.py");
    let run = Command::new(python).arg(script).arg(folder.path()).output().expect("python starts");
    let said = String::from_utf8_lossy(&run.stdout);
    assert!(run.status.success(), "{said}{}", String::from_utf8_lossy(&run.stderr));
    // meshio prints blank lines of its own.
    let found: Vec<&str> = said.lines().filter(|line| !line.is_empty()).collect();
    assert_eq!(found, wanted.lines().collect::<Vec<_>>());
}
