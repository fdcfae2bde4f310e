//! The recipe of docs/meshes.md: meshes of Abaqus, MED and Exodus keep their names and shapes on the way to Gmsh's format.
//!
//! Set `MEZHA_PYTHON` to an interpreter that has `meshio`, and `h5py` and `netCDF4` for MED and Exodus; without it the test says
//! so and checks nothing.

use crate::support::mesh::read_gmsh;
use std::process::Command;

#[test]
fn names_come_through() {
    let Some(python) = std::env::var_os("MEZHA_PYTHON") else {
        println!("skipped: MEZHA_PYTHON is not set, so nothing has been converted");
        return;
    };
    let folder = tempfile::tempdir().expect("a temporary folder");
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/mesh_recipe.py");
    let run = Command::new(python).arg(script).arg(folder.path()).output().expect("python starts");
    let said = String::from_utf8_lossy(&run.stdout);
    assert!(run.status.success(), "{said}{}", String::from_utf8_lossy(&run.stderr));
    let files: Vec<&str> = said.lines().filter(|line| line.ends_with(".msh")).collect();
    assert!(files.contains(&"inp.msh"), "{said}");
    for file in files {
        let mesh = read_gmsh(&folder.path().join(file)).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(mesh.bodies, ["lower", "upper"], "{file}");
        let mut curves: Vec<(&str, usize)> = mesh.boundaries.iter().map(|b| (b.name.as_str(), b.edges.len())).collect();
        curves.sort_unstable();
        assert_eq!(curves, [("bottom", 2), ("lower.seam", 2), ("top", 1), ("upper.seam", 1)], "{file}");
        assert_eq!(mesh.triangles.len(), 6, "{file}: quadrangles are split");
    }
    println!("{}", said.trim());
}
