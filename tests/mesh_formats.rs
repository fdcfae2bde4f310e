//! The same scene in all formats of Gmsh that are read, as Gmsh 4.15 has saved it: `tests/meshes/disc.geo`, a half disc on a block.

use crate::support::Run;
use crate::support::mesh::{read_gmsh, write_scene};
use mezha::geometry::{Curve, gauss_points};
use mezha::mesh::{MacroMesh, parse_gmsh};
use std::f64::consts::PI;
use std::path::{Path, PathBuf};

fn file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/meshes").join(format!("{name}.msh"))
}

fn mesh(name: &str) -> MacroMesh {
    read_gmsh(&file(name)).unwrap_or_else(|error| panic!("{error}"))
}

/// Everything but the name of the file.
fn content(mesh: &MacroMesh) -> String {
    format!("{:?}", (&mesh.vertices, &mesh.triangles, &mesh.edges, &mesh.bodies, &mesh.parts, &mesh.boundaries, &mesh.interfaces))
}

/// Area of a body with its curved sides: ½ ∮ x × dx.
fn area(mesh: &MacroMesh, body: &str) -> f64 {
    let body = mesh.bodies.iter().position(|name| name == body).expect("a body") as u32;
    let mut area = 0.0;
    for triangle in mesh.triangles.iter().filter(|triangle| triangle.body == body) {
        for (edge, forward) in triangle.edges.into_iter().zip(triangle.forward) {
            for &(t, weight) in gauss_points(8).iter() {
                let (x, slope) = (mesh.edge_position(edge, t), mesh.edge_slope(edge, t));
                area += 0.5 * weight * (x.x * slope.y - x.y * slope.x) * if forward { 1.0 } else { -1.0 };
            }
        }
    }
    area
}

const WAYS: [&str; 4] = ["2.2_order#_ascii", "2.2_order#_binary", "4.1_order#_ascii", "4.1_order#_binary"];

#[test]
fn one_mesh_saved_in_four_ways_is_one_mesh() {
    for order in ["1", "2"] {
        let meshes = WAYS.map(|way| mesh(&format!("disc_{}", way.replace('#', order))));
        assert_eq!(content(&meshes[2]), content(&meshes[0]), "texts");
        assert_eq!(content(&meshes[3]), content(&meshes[1]), "binary files");
        // Gmsh writes 16 digits of 17 into a text.
        let off = meshes[0].vertices.iter().zip(&meshes[1].vertices).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
        assert!(off < 1e-15 && meshes[0].vertices.len() == meshes[1].vertices.len(), "{off}");
        let content = |mesh: &MacroMesh| format!("{:?}", (&mesh.triangles, &mesh.bodies, &mesh.boundaries));
        assert_eq!(content(&meshes[1]), content(&meshes[0]));
        let mut names: Vec<&str> = meshes[0].boundaries.iter().map(|boundary| boundary.name.as_str()).collect();
        names.sort_unstable();
        assert_eq!(names, ["block.top", "bottom", "disc.rim", "top"]);
        assert_eq!(meshes[0].bodies, ["block", "half disc"]);
    }
    assert_eq!(content(&mesh("disc_4.1_order1_big_endian")), content(&mesh("disc_4.1_order1_binary")));
}

#[test]
fn midside_nodes_make_the_disc_round() {
    let chords = mesh("disc_4.1_order1_ascii");
    let lacking = 1.0 - area(&chords, "half disc") / (0.5 * PI);
    assert!((0.004..0.1).contains(&lacking), "{lacking}");
    for name in ["disc_4.1_order2_ascii", "disc_quadrangles_8_nodes", "disc_quadrangles_9_nodes"] {
        let mesh = mesh(name);
        let (disc, block) = (area(&mesh, "half disc"), area(&mesh, "block"));
        assert!((disc / (0.5 * PI) - 1.0).abs() < 1e-13, "{name}: {disc}");
        assert!((block / 6.0 - 1.0).abs() < 1e-14, "{name}: {block}");
        for &edge in &mesh.boundary("disc.rim").expect("named").edges {
            let shape = mesh.edges[edge as usize].shape.as_ref().expect("it is bent");
            assert!(matches!(*shape.curve, Curve::Circle { .. }), "{name}");
        }
        let bent = mesh.edges.iter().filter(|edge| edge.shape.is_some()).count();
        assert_eq!(bent, mesh.boundary("disc.rim").expect("named").edges.len(), "{name}: all others are straight");
    }
}

#[test]
fn quadrangles_are_two_triangles_each() {
    let mesh = mesh("disc_quadrangles_order1");
    let (disc, block) = (area(&mesh, "half disc"), area(&mesh, "block"));
    assert!(
        (disc / area(&self::mesh("disc_4.1_order1_ascii"), "half disc") - 1.0).abs() < 0.05 && (block / 6.0 - 1.0).abs() < 1e-14
    );
    assert!((0..mesh.triangles.len()).all(|triangle| mesh.smallest_angle(triangle) > 0.3), "no flat triangles");
}

const CASE: &str = r#"
[mesh]
file = "mesh.msh"
[body.block]
young = 1000.0
poisson = 0.3
[body."half disc"]
young = 1000.0
poisson = 0.3
[support.bottom]
on = "bottom"
ux = 0.0
uy = 0.0
[load.top]
on = "top"
rigid = true
force = [0.0, -40.0]
ux = 0.0
angle = 0.0
[contact.c]
between = ["block.top", "disc.rim"]
"#;

/// Pressure and energy of a case on a mesh, refined until the contact is wider than an edge.
fn solved(name: &str, case: &str) -> [f64; 2] {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let scene = write_scene(folder.path(), "", case);
    std::fs::copy(file(name), folder.path().join("mesh.msh")).expect("a mesh can be copied");
    let ended = Run::file(&scene).alone().set("mesh.refine", 2).set("solver.tolerance", 1e-12).solved();
    [ended.number("/contact/c/pressure_max"), ended.number("/energy/total")]
}

#[test]
fn results_do_not_know_the_format() {
    let chords = solved("disc_2.2_order1_ascii", CASE);
    assert_eq!(chords, solved("disc_4.1_order1_ascii", CASE), "to the last digit");
    let circle = "[geometry.disc]\ncurves = [\"disc.rim\"]\ncircle = { centre = [0, 1], radius = 1 }\n";
    let declared = solved("disc_4.1_order1_ascii", &format!("{CASE}{circle}"));
    let drawn = solved("disc_2.2_order2_binary", CASE);
    // They differ by rounding alone: 1e-13 is seen.
    for (declared, drawn) in declared.iter().zip(&drawn) {
        assert!((drawn / declared - 1.0).abs() < 1e-10, "{drawn} instead of {declared}");
    }
    assert!((chords[1] / declared[1] - 1.0).abs() > 5e-6, "chords are something else");
}

#[test]
fn what_is_not_read_is_told() {
    for (name, words) in [
        (
            "refused_4.0",
            "line 2: mesh format 4 is not read, only 2.2 and 4.1; convert it with `gmsh refused_4.0.msh -save -format msh41",
        ),
        ("refused_partitioned_4.1", "is partitioned; save it whole"),
        ("refused_partitioned_2.2", "is partitioned; save it whole"),
        ("refused_order3", "elements of order 3 or higher (Gmsh element type 26); mesh with `gmsh -2 -order 2`"),
    ] {
        let found = read_gmsh(&file(name)).expect_err("it is refused").to_string();
        assert!(found.contains(words), "{found}");
    }
}

#[test]
fn a_binary_file_that_is_cut_off_is_told_wherever() {
    for name in ["disc_2.2_order2_binary", "disc_4.1_order1_binary"] {
        let bytes = std::fs::read(file(name)).expect("a mesh");
        for length in 0..bytes.len() - "$EndElements\n".len() {
            let words =
                parse_gmsh(&bytes[..length], Path::new("a.msh"), Default::default()).expect_err("it is cut off").to_string();
            assert!(words.len() < 400, "{length}: {words}");
        }
        // Counts that lie ask for no memory.
        let at = bytes.windows(7).position(|window| window == b"$Nodes\n").expect("nodes") + 7;
        let mut lying = bytes.clone();
        lying[at..at + 6].fill(if name.contains("4.1") { 0xff } else { b'9' });
        parse_gmsh(&lying, Path::new("a.msh"), Default::default()).expect_err("there are not so many");
    }
}
