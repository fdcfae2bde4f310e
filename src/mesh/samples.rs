//! Small meshes for unit tests.

use super::FilePlace;
use super::macro_mesh::{MacroMesh, RawMesh};
use crate::geometry::Point;
use std::path::Path;

/// They come from no file.
const PLACE: FilePlace = FilePlace::Line(0);

/// Two blocks, `[0, 2] x [0, 1]` under `[0, 2] x [1, 2]`: one quadrangle below the line y = 1, two above, each of two
/// triangles. Boundaries "lower.seam", "upper.seam", "bottom", "top".
pub fn two_blocks() -> MacroMesh {
    let mut raw = RawMesh::default();
    block(&mut raw, "lower", &[0.0, 2.0], [0.0, 1.0], ["bottom", "lower.seam"]);
    block(&mut raw, "upper", &[0.0, 0.9, 2.0], [1.0, 2.0], ["upper.seam", "top"]);
    MacroMesh::build(raw, Path::new("blocks.msh")).expect("a good mesh")
}

/// What a file says of a unit square of two triangles, parts "core" and "film" of the body "whole", with a line "bond" between
/// them and "bottom" below.
pub(super) fn two_parts() -> RawMesh {
    let names = ["core", "film"].map(str::to_string);
    RawMesh {
        vertices: [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(Point::from).into(),
        triangles: vec![([0, 1, 2], vec![names[0].clone()], PLACE), ([0, 2, 3], vec![names[1].clone()], PLACE)],
        lines: vec![("bond".into(), [0, 2], PLACE), ("bottom".into(), [0, 1], PLACE)],
        midsides: Default::default(),
        joined: names.into_iter().map(|name| (name, "whole".to_string())).collect(),
    }
}

/// One block of so many columns of width 1 over y = 0, each of two triangles.
pub fn columns(count: usize, height: f64) -> MacroMesh {
    let mut raw = RawMesh::default();
    let xs: Vec<f64> = (0..=count).map(|k| k as f64).collect();
    block(&mut raw, "columns", &xs, [0.0, height], ["bottom", "top"]);
    MacroMesh::build(raw, Path::new("columns.msh")).expect("a good mesh")
}

/// One body, `[0, 2] x [0, 2]`, whose nodes on the line y = 1 are doubled: the triangles below and above it share none.
pub(super) fn slit_block() -> MacroMesh {
    let mut raw = RawMesh::default();
    let xs = [0.0, 1.0, 2.0];
    block(&mut raw, "body", &xs, [0.0, 1.0], ["bottom", "below"]);
    block(&mut raw, "body", &xs, [1.0, 2.0], ["above", "top"]);
    MacroMesh::build(raw, Path::new("slit.msh")).expect("a mesh that can be read")
}

/// A regular polygon of so many sides, "rim", about (3, -1): its corners lie on a circle of radius 2, and its triangles meet in
/// the middle.
pub fn fan(sides: usize) -> MacroMesh {
    let angle = |k: usize| std::f64::consts::TAU * k as f64 / sides as f64;
    let corner = |k: usize| Point::new(3.0 + 2.0 * angle(k).cos(), -1.0 + 2.0 * angle(k).sin());
    let next = |k: usize| (k + 1) % sides;
    let raw = RawMesh {
        vertices: (0..sides).map(corner).chain([Point::new(3.0, -1.0)]).collect(),
        triangles: (0..sides).map(|k| ([k, next(k), sides], vec!["disc".to_string()], PLACE)).collect(),
        lines: (0..sides).map(|k| ("rim".to_string(), [k, next(k)], PLACE)).collect(),
        ..RawMesh::default()
    };
    MacroMesh::build(raw, Path::new("fan.msh")).expect("a good mesh")
}

fn block(raw: &mut RawMesh, body: &str, xs: &[f64], [low, high]: [f64; 2], names: [&str; 2]) {
    let first = raw.vertices.len();
    for &x in xs {
        raw.vertices.extend([Point::new(x, low), Point::new(x, high)]);
    }
    for k in 0..xs.len() - 1 {
        let [a, d, b, c] = [0, 1, 2, 3].map(|corner| first + 2 * k + corner);
        raw.triangles.extend([[a, b, c], [a, c, d]].map(|corners| (corners, vec![body.to_string()], PLACE)));
        raw.lines.extend([(names[0].to_string(), [a, b], PLACE), (names[1].to_string(), [d, c], PLACE)]);
    }
}
