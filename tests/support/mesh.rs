//! Meshes made in the tests: jittered grids of triangles, written as Gmsh 4.1 text.

use mezha::mesh::{MacroMesh, MeshError, parse_gmsh, read_bytes};
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// A case that works on meshes of a lower and an upper body.
pub const GOOD: &str = r#"
mesh.file = "mesh.msh"
body.lower = { young = 7000.0, poisson = 0.227 }
body.upper = { young = 3000.0, poisson = 0.3 }
support.table = { on = "bottom", uy = 0.0 }
support.wall = { on = "left", ux = 0.0 }
load.top = { on = "top", pressure = 1.0 }
contact.seam = { between = ["lower.seam", "upper.seam"], curve = "line", gap = "closed" }
"#;

/// The mesh of a Gmsh file.
pub fn read_gmsh(file: &Path) -> Result<MacroMesh, MeshError> {
    parse_gmsh(&read_bytes(file)?, file, Default::default())
}

/// Random numbers in [0, 1), the same in each run (Steele, Lea, Flood: splitmix).
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// A body with four sides: bottom, right, top, left.
pub struct Block {
    pub points: Vec<[f64; 2]>,
    pub triangles: Vec<[usize; 3]>,
    pub sides: [Vec<[usize; 2]>; 4],
}

/// The unit square in `nx` × `ny` quadrangles with jittered inner corners, each cut along one diagonal or the other, mapped.
pub fn grid(nx: usize, ny: usize, seed: u64, map: impl Fn(f64, f64) -> [f64; 2]) -> Block {
    let mut random = Random(seed);
    let mut jitter = |inner: bool| if inner { 0.4 * random.next() - 0.2 } else { 0.0 };
    let mut points = Vec::new();
    for j in 0..=ny {
        for i in 0..=nx {
            let inner = i > 0 && i < nx && j > 0 && j < ny;
            let (u, v) = (i as f64 + jitter(inner), j as f64 + jitter(inner));
            points.push(map(u / nx as f64, v / ny as f64));
        }
    }
    let at = |i: usize, j: usize| j * (nx + 1) + i;
    let mut triangles = Vec::new();
    for (i, j) in (0..ny).flat_map(|j| (0..nx).map(move |i| (i, j))) {
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        triangles.extend(if random.next() < 0.5 { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] });
    }
    let sides = [
        (0..nx).map(|i| [at(i, 0), at(i + 1, 0)]).collect(),
        (0..ny).map(|j| [at(nx, j), at(nx, j + 1)]).collect(),
        (0..nx).map(|i| [at(i + 1, ny), at(i, ny)]).collect(),
        (0..ny).map(|j| [at(0, j + 1), at(0, j)]).collect(),
    ];
    Block { points, triangles, sides }
}

/// Bodies with their names, and the names of their sides (bottom, right, top, left); `""` is a side without a name.
pub struct Mesh {
    pub bodies: Vec<(&'static str, Block, [&'static str; 4])>,
}

impl Mesh {
    /// The two bars of the inclined contact line: (0,0) (6,0) (6,4) (0,3) below, up to y = 6 above, with about `6n` and `7n`
    /// edges on the line.
    pub fn inclined_bars(n: usize) -> Self {
        let seam = |u: f64| 3.0 + u;
        let lower = grid(6 * n, 4 * n, 1, |u, v| [6.0 * u, v * seam(u)]);
        let upper = grid(7 * n, 3 * n, 2, |u, v| [6.0 * u, seam(u) + v * (6.0 - seam(u))]);
        Self {
            bodies: vec![
                ("lower", lower, ["bottom", "right", "lower.seam", "left"]),
                ("upper", upper, ["upper.seam", "right", "top", "left"]),
            ],
        }
    }

    /// Two bars, `columns` long and 1 high each, below and above y = 1, with one edge for each unit of length below and nine tenths
    /// as many above.
    pub fn long_seam(columns: usize) -> Self {
        let length = columns as f64;
        let lower = grid(columns, 1, 1, |u, v| [length * u, v]);
        let upper = grid(9 * columns / 10, 1, 2, |u, v| [length * u, 1.0 + v]);
        Self {
            bodies: vec![
                ("lower", lower, ["bottom", "right", "lower.seam", "left"]),
                ("upper", upper, ["upper.seam", "right", "top", "left"]),
            ],
        }
    }

    /// Moves every point.
    pub fn map(mut self, f: impl Fn([f64; 2]) -> [f64; 2]) -> Self {
        self.bodies.iter_mut().flat_map(|(_, block, _)| &mut block.points).for_each(|x| *x = f(*x));
        self
    }

    /// Names of the sides, each once: the physical curves, numbered from 1.
    fn curves(&self) -> Vec<&'static str> {
        let mut names: Vec<&str> = Vec::new();
        for name in self.bodies.iter().flat_map(|(_, _, sides)| sides).filter(|name| !name.is_empty()) {
            if !names.contains(name) {
                names.push(name);
            }
        }
        names
    }

    /// The Gmsh 4.1 ASCII file.
    pub fn text(&self) -> String {
        let curves = self.curves();
        let mut text = String::from("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n");
        let mut line = |words: String| writeln!(text, "{words}").expect("a string grows");
        line((curves.len() + self.bodies.len()).to_string());
        for (k, name) in curves.iter().enumerate() {
            line(format!("1 {} \"{name}\"", k + 1));
        }
        for (k, (name, ..)) in self.bodies.iter().enumerate() {
            line(format!("2 {} \"{name}\"", k + 1));
        }
        line("$EndPhysicalNames\n$Entities".into());
        line(format!("0 {} {} 0", curves.len(), self.bodies.len()));
        (1..=curves.len()).for_each(|k| line(format!("{k} 0 0 0 0 0 0 1 {k} 0")));
        (1..=self.bodies.len()).for_each(|k| line(format!("{k} 0 0 0 0 0 0 1 {k} 0")));
        line("$EndEntities\n$Nodes".into());
        let count: usize = self.bodies.iter().map(|(_, block, _)| block.points.len()).sum();
        line(format!("{} {count} 1 {count}", self.bodies.len()));
        let mut first = Vec::new();
        let mut tag = 1;
        for (k, (_, block, _)) in self.bodies.iter().enumerate() {
            first.push(tag);
            line(format!("2 {} 0 {}", k + 1, block.points.len()));
            block.points.iter().enumerate().for_each(|(i, _)| line((tag + i).to_string()));
            block.points.iter().for_each(|[x, y]| line(format!("{x:?} {y:?} 0")));
            tag += block.points.len();
        }
        line("$EndNodes\n$Elements".into());
        let mut blocks = Vec::new();
        for (body, (_, block, sides)) in self.bodies.iter().enumerate() {
            for (name, edges) in sides.iter().zip(&block.sides) {
                if let Some(curve) = curves.iter().position(|curve| curve == name) {
                    let edges = edges.iter().map(|edge| edge.map(|k| first[body] + k).to_vec()).collect();
                    blocks.push((1, curve + 1, 1, edges));
                }
            }
            let triangles: Vec<Vec<usize>> = block.triangles.iter().map(|t| t.map(|k| first[body] + k).to_vec()).collect();
            blocks.push((2, body + 1, 2, triangles));
        }
        let count: usize = blocks.iter().map(|(.., elements)| elements.len()).sum();
        line(format!("{} {count} 1 {count}", blocks.len()));
        let mut tag = 1;
        for (dimension, entity, kind, elements) in &blocks {
            line(format!("{dimension} {entity} {kind} {}", elements.len()));
            for nodes in elements {
                let nodes: Vec<String> = nodes.iter().map(usize::to_string).collect();
                line(format!("{tag} {}", nodes.join(" ")));
                tag += 1;
            }
        }
        line("$EndElements".into());
        text
    }
}

/// Writes `mesh.msh` and `case.toml` into a folder; the case is to name the mesh so. Returns the case file.
pub fn write_scene(folder: &Path, mesh: &str, case: &str) -> PathBuf {
    let file = folder.join("case.toml");
    std::fs::write(folder.join("mesh.msh"), mesh).expect("a mesh can be written");
    std::fs::write(&file, case).expect("a case can be written");
    file
}

/// Two blocks of unequal meshes, one on the other, with the named boundaries `bottom`, `lower.seam`, `upper.seam`, `top`, and
/// `left` and `right` of both; so many edges along and across each, and the seeds of their meshes.
pub fn two_blocks([lower, upper]: [(usize, usize, u64); 2]) -> Mesh {
    let lower = grid(lower.0, lower.1, lower.2, |u, v| [2.0 * u, v]);
    let upper = grid(upper.0, upper.1, upper.2, |u, v| [2.0 * u, 1.0 + v]);
    Mesh {
        bodies: vec![
            ("lower", lower, ["bottom", "right", "lower.seam", "left"]),
            ("upper", upper, ["upper.seam", "right", "top", "left"]),
        ],
    }
}
