//! Small meshes for unit tests.

use super::FilePlace;
use super::macro_mesh::MacroMesh;
use super::raw_mesh::{RawMesh, RawTriangle};
use crate::geometry::Point;
use std::path::Path;

/// They come from no file.
const PLACE: FilePlace = FilePlace::Line(0);

impl RawMesh {
    /// Adds triangles of one physical surface.
    pub fn add(&mut self, name: &str, triangles: impl IntoIterator<Item = [usize; 3]>) {
        let names = self.number_of(vec![name.to_string()]);
        let triangle = |corners: [usize; 3]| RawTriangle { corners: corners.map(|corner| corner as u32), names, place: PLACE };
        self.triangles.extend(triangles.into_iter().map(triangle));
    }

    /// Adds a line of a physical curve.
    pub fn add_line(&mut self, name: &str, ends: [usize; 2]) {
        self.lines.push((name.to_string(), ends.map(|end| end as u32), PLACE));
    }
}

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
    let mut raw = RawMesh {
        vertices: [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(Point::from).into(),
        joined: ["core", "film"].map(|name| (name.to_string(), "whole".to_string())).into(),
        ..RawMesh::default()
    };
    raw.add("core", [[0, 1, 2]]);
    raw.add("film", [[0, 2, 3]]);
    raw.add_line("bond", [0, 2]);
    raw.add_line("bottom", [0, 1]);
    raw
}

/// The unit square of the two parts "core" and "film".
pub fn parted_square() -> MacroMesh {
    MacroMesh::build(two_parts(), Path::new("parts.msh")).expect("a good mesh")
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
    let mut raw = RawMesh { vertices: (0..sides).map(corner).chain([Point::new(3.0, -1.0)]).collect(), ..RawMesh::default() };
    raw.add("disc", (0..sides).map(|k| [k, next(k), sides]));
    (0..sides).for_each(|k| raw.add_line("rim", [k, next(k)]));
    MacroMesh::build(raw, Path::new("fan.msh")).expect("a good mesh")
}

/// A pin of radius 1, turned by a part of a turn, in the hole of a ring, with a clearance all around: chords of a thirty-second of a
/// turn, and quarters "pin0" to "pin3" and "hole0" to "hole3", anticlockwise.
pub fn quartered_pin(turn: f64, clearance: f64) -> MacroMesh {
    const CHORDS: usize = 32;
    let circle = |radius: f64, turn: f64| {
        let angle = move |k: usize| std::f64::consts::TAU * (turn + k as f64 / CHORDS as f64);
        (0..CHORDS).map(move |k| radius * Point::new(angle(k).cos(), angle(k).sin()))
    };
    let vertices = circle(1.0, turn).chain(circle(1.0 + clearance, 0.0)).chain(circle(1.5, 0.0)).chain([Point::zeros()]);
    let mut raw = RawMesh { vertices: vertices.collect(), ..RawMesh::default() };
    let at = |circle: usize, k: usize| CHORDS * circle + k % CHORDS;
    for k in 0..CHORDS {
        raw.add("pin", [[3 * CHORDS, at(0, k), at(0, k + 1)]]);
        raw.add("ring", [[at(1, k), at(2, k), at(2, k + 1)], [at(1, k), at(2, k + 1), at(1, k + 1)]]);
        raw.add_line(&format!("pin{}", 4 * k / CHORDS), [at(0, k), at(0, k + 1)]);
        raw.add_line(&format!("hole{}", 4 * k / CHORDS), [at(1, k + 1), at(1, k)]);
        raw.add_line("outside", [at(2, k), at(2, k + 1)]);
    }
    MacroMesh::build(raw, Path::new("pin.msh")).expect("a good mesh")
}

fn block(raw: &mut RawMesh, body: &str, xs: &[f64], [low, high]: [f64; 2], names: [&str; 2]) {
    let first = raw.vertices.len();
    for &x in xs {
        raw.vertices.extend([Point::new(x, low), Point::new(x, high)]);
    }
    for k in 0..xs.len() - 1 {
        let [a, d, b, c] = [0, 1, 2, 3].map(|corner| first + 2 * k + corner);
        raw.add(body, [[a, b, c], [a, c, d]]);
        raw.add_line(names[0], [a, b]);
        raw.add_line(names[1], [d, c]);
    }
}
