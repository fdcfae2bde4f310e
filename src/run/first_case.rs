//! `mezha new`: a first case from a mesh.
//!
//! Names and places of boundaries tell what is likely meant: what is below is held, what is on top is pressed, what lies close
//! is in contact. What is only an example is said to be one, and the whole is a case that runs as it comes where that can be.

use super::proposals::{TableNames, contact_table, key, proposed_supports, quoted, short};
use super::{RunError, check};
use crate::case::Case;
use crate::contact::{ClosePair, close_pairs};
use crate::geometry::{Point, cross};
use crate::mesh::{Boundary, MacroMesh, parse_joined, read_bytes, touching_surfaces};
use std::collections::HashMap;
use std::fmt::Write;
use std::path::{Component, Path, PathBuf};

/// Young's modulus and Poisson's ratio of the example: steel, in MPa.
const YOUNG: f64 = 210e3;
const POISSON: f64 = 0.3;

/// The example presses with this share of Young's modulus over the width of the narrowest body.
const PRESSED: f64 = 1e-3;

/// Words in names of boundaries that are held, pressed, and of symmetry.
const HELD: [&str; 12] =
    ["bottom", "base", "fixed", "fix", "clamp", "clamped", "ground", "floor", "foot", "foundation", "support", "wall"];
const LOADED: [&str; 9] = ["top", "load", "loaded", "press", "pressed", "force", "punch", "push", "piston"];
const MIRRORED: [&str; 4] = ["symmetry", "sym", "symm", "mirror"];

/// A boundary looks along an axis if its mean normal has this component at least.
const ALONG: f64 = 0.95;

/// Boundaries that are named in comments at most.
const MOST_NAMED: usize = 60;

/// A first case for a mesh file, which the case names as `named`.
///
/// # Errors
/// [`RunError::Input`] if the mesh cannot be used.
pub fn first_case(mesh_file: &Path, named: &str) -> Result<String, RunError> {
    let bytes = read_bytes(mesh_file).map_err(|error| RunError::Input(error.to_string()))?;
    let groups = touching_surfaces(&bytes, mesh_file).map_err(|error| RunError::Input(error.to_string()))?;
    let names = body_names(&groups);
    let parts = groups.iter().zip(&names).flat_map(|(group, body)| group.iter().map(move |part| (part.clone(), body.clone())));
    let joined: HashMap<String, String> = parts.filter(|(part, body)| part != body).collect();
    let mesh = parse_joined(&bytes, mesh_file, joined).map_err(|error| RunError::Input(error.to_string()))?;
    let draft = Draft::new(&mesh, &groups, &names);
    let place = std::path::absolute(mesh_file).unwrap_or_else(|_| mesh_file.to_path_buf());
    let parse = |text: &str| {
        let file = place.with_file_name("case.toml");
        Case::parse(text, &file, &[format!("mesh.file={}", quoted(&place.to_string_lossy()))])
    };
    // The first way of pressing that can be is taken; the last presses nothing.
    let mut text = String::new();
    for press in [Press::Plate, Press::Pressure, Press::Nothing] {
        text = draft.text(named, press);
        let Ok(case) = parse(&text) else { continue };
        let supports = proposed_supports(&case);
        if !supports.is_empty() {
            text += "\n# Nothing else holds these motions; put what you mean in their place.\n";
            text += &supports.join("\n");
        }
        if parse(&text).is_ok_and(|case| check(&case).is_ok_and(|checked| checked.not_held.is_none())) {
            return Ok(text);
        }
    }
    let words = match parse(&text) {
        Ok(case) => check(&case).map_or_else(|error| error.to_string(), |checked| checked.not_held.unwrap_or_default()),
        Err(error) => error.to_string(),
    };
    let words: String = words.lines().map(|line| format!("#   {line}\n")).collect();
    Ok(format!("# This case does not pass `mezha check` yet, which says:\n{words}\n{text}"))
}

/// The path of a mesh file from the folder of a case, or its name alone where that folder is not known: the case then goes
/// beside the mesh.
pub fn path_from(folder: Option<&Path>, mesh_file: &Path) -> String {
    let absolute =
        |path: &Path| path.canonicalize().or_else(|_| std::path::absolute(path)).unwrap_or_else(|_| path.to_path_buf());
    let alone = || mesh_file.file_name().map(PathBuf::from).unwrap_or_default();
    let path = folder.map_or_else(alone, |folder| {
        let (folder, mesh_file) = (absolute(folder), absolute(mesh_file));
        let common = folder.components().zip(mesh_file.components()).take_while(|(a, b)| a == b).count();
        let up = folder.components().skip(common).map(|_| Component::ParentDir);
        up.chain(mesh_file.components().skip(common)).collect()
    });
    path.to_string_lossy().into_owned()
}

/// A name for each group of surfaces that share nodes: that of its surface, or a new one.
fn body_names(groups: &[Vec<String>]) -> Vec<String> {
    let mut names = TableNames::of(groups.iter().flatten().cloned());
    let name = |group: &Vec<String>| match &group[..] {
        [only] => only.clone(),
        many => {
            let is_in_all =
                |&(at, c): &(usize, char)| many.iter().all(|name| name.get(at..).is_some_and(|rest| rest.starts_with(c)));
            let common: String = many[0].char_indices().take_while(is_in_all).map(|(_, c)| c).collect();
            let common = common.trim_end_matches(['.', '_', '-', ' ']);
            names.fresh(if common.is_empty() { "body" } else { common })
        }
    };
    groups.iter().map(name).collect()
}

/// How the example presses.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Press {
    /// By a stiff plate that carries a force.
    Plate,
    /// By a pressure.
    Pressure,
    /// Not at all.
    Nothing,
}

/// A named boundary as it lies.
struct NamedCurve<'a> {
    name: &'a str,
    body: usize,
    is_of_one_piece: bool,
    low: Point,
    high: Point,
    /// Mean of its outward normals by length; shorter than 1 where it is curved.
    normal: Point,
    length: f64,
    is_touched: bool,
}

impl<'a> NamedCurve<'a> {
    fn new(mesh: &MacroMesh, boundary: &'a Boundary, pairs: &[ClosePair]) -> Option<Self> {
        let first = *boundary.edges.first()?;
        let (mut low, mut high) = (Point::repeat(f64::INFINITY), Point::repeat(f64::NEG_INFINITY));
        let (mut normal, mut length) = (Point::zeros(), 0.0);
        for &edge in &boundary.edges {
            for t in [0.0, 0.5, 1.0] {
                let x = mesh.edge_position(edge, t);
                (low, high) = (low.inf(&x), high.sup(&x));
            }
            normal += mesh.edge_length(edge) * mesh.edge_normal(edge, 0.5);
            length += mesh.edge_length(edge);
        }
        let piece = mesh.piece_beside(first);
        Some(Self {
            name: &boundary.name,
            body: mesh.body_beside(first),
            is_of_one_piece: boundary.edges.iter().all(|&edge| mesh.piece_beside(edge) == piece),
            low,
            high,
            normal: normal / length,
            length,
            is_touched: pairs.iter().any(|pair| pair.between.contains(&boundary.name)),
        })
    }

    /// Whether its name has one of some words.
    fn has(&self, words: &[&str]) -> bool {
        let name = self.name.to_lowercase();
        name.split(|c: char| !c.is_alphanumeric())
            .any(|word| words.contains(&word.trim_end_matches(|c: char| c.is_ascii_digit())))
    }
}

/// What the case will say.
struct Draft<'a> {
    mesh: &'a MacroMesh,
    groups: &'a [Vec<String>],
    names: &'a [String],
    curves: Vec<NamedCurve<'a>>,
    pairs: Vec<ClosePair>,
}

impl<'a> Draft<'a> {
    fn new(mesh: &'a MacroMesh, groups: &'a [Vec<String>], names: &'a [String]) -> Self {
        let pairs = close_pairs(mesh);
        let curves = mesh.boundaries.iter().filter_map(|boundary| NamedCurve::new(mesh, boundary, &pairs)).collect();
        Self { mesh, groups, names, curves, pairs }
    }

    /// Boundaries without contact and not of symmetry.
    fn free(&self) -> impl Iterator<Item = &NamedCurve<'a>> {
        self.curves.iter().filter(|curve| !curve.is_touched && !curve.has(&MIRRORED))
    }

    /// The boundary that is held: by its name, or because it is the lowest and looks down.
    fn held(&self) -> Option<&NamedCurve<'a>> {
        let rank = |curve: &&NamedCurve| (curve.has(&HELD), curve.normal.y < -ALONG, -curve.low.y);
        let likely = self.free().filter(|curve| curve.has(&HELD) || curve.normal.y < -ALONG);
        likely.max_by(|a, b| rank(a).partial_cmp(&rank(b)).unwrap_or(std::cmp::Ordering::Equal))
    }

    /// The boundary that is pressed: by its name, or because it is the highest and looks up; on another body, if there is one.
    fn pressed(&self, held: Option<&NamedCurve>) -> Option<&NamedCurve<'a>> {
        let other = |curve: &&NamedCurve| match held {
            Some(held) => curve.name != held.name && (curve.body != held.body || self.mesh.bodies.len() == 1),
            None => true,
        };
        let rank = |curve: &&NamedCurve| (curve.has(&LOADED), curve.normal.y > ALONG, curve.high.y);
        let likely = self.free().filter(other).filter(|curve| curve.has(&LOADED) || curve.normal.y > ALONG);
        let best = likely.max_by(|a, b| rank(a).partial_cmp(&rank(b)).unwrap_or(std::cmp::Ordering::Equal));
        best.filter(|curve| curve.is_of_one_piece)
    }

    fn text(&self, named: &str, press: Press) -> String {
        let mut text = String::new();
        let mut tables = TableNames::default();
        self.head(&mut text, named);
        let held = self.held();
        let weight = self.weight(held).filter(|_| press != Press::Nothing);
        self.bodies(&mut text, weight);
        self.contacts(&mut text);
        self.supports(&mut text, held, &mut tables);
        if weight.is_none() {
            self.load(&mut text, held, press);
        }
        self.rest(&mut text);
        text
    }

    fn head(&self, text: &mut String, named: &str) {
        let title = Path::new(named).file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let _ = write!(
            text,
            "# A first case, made from the mesh by `mezha new`. Numbers marked as examples are examples: put yours in their place.
# `mezha check` draws the case and says what would be solved, `mezha run` solves it.
# Units are your own, consistent ones: with mm and N, stresses are in MPa, and forces in N for each mm of thickness.
title = {}

[mesh]
file = {}          # found from the folder of this file
order = 2
",
            quoted(&title),
            quoted(named),
        );
        let accuracy = match self.pairs.is_empty() {
            true => "energy = 0.02            # the mesh is adapted until the energy norm is good to 2 %",
            false => "pressure = 0.02          # the mesh is adapted until the contact pressure is good to 2 %",
        };
        let _ = write!(text, "\n[accuracy]\n{accuracy}\nmax_unknowns = 200000\n");
    }

    fn bodies(&self, text: &mut String, weight: Option<(usize, f64)>) {
        for (group, name) in self.groups.iter().zip(self.names) {
            let mut material =
                format!("young = {YOUNG:?}         # example: steel, in MPa\npoisson = {POISSON:?}            # example\n");
            if let Some((_, force)) = weight.filter(|(body, _)| self.mesh.bodies[*body] == *name) {
                let words = "# example: presses the body down, force for each volume";
                let _ = writeln!(material, "body_force = [0.0, {:?}]    {words}", -force);
            }
            match &group[..] {
                [only] => {
                    let _ = write!(text, "\n[body.{}]\n{material}", key(only));
                }
                parts => {
                    let _ = write!(text, "\n# These surfaces share nodes: they are parts of one body, bonded to each other.\n");
                    for part in parts {
                        let _ = write!(text, "[body.{}.part.{}]\n{material}", key(name), key(part));
                    }
                }
            }
        }
    }

    fn contacts(&self, text: &mut String) {
        let mut tables = TableNames::default();
        if self.mesh.bodies.len() > 1 && self.pairs.is_empty() {
            *text += "\n# No named boundaries of two bodies lie close and face each other. What may touch is written so:\n";
            *text += "# [contact.NAME]\n# between = [\"boundary of body 1\", \"boundary of body 2\"]\n";
        }
        for pair in &self.pairs {
            let _ = write!(text, "\n{}", contact_table(pair, &mut tables));
        }
    }

    fn supports(&self, text: &mut String, held: Option<&NamedCurve>, tables: &mut TableNames) {
        for curve in self.curves.iter().filter(|curve| curve.has(&MIRRORED) && !curve.is_touched) {
            let _ = write!(
                text,
                "\n[support.{}]       # a line of symmetry, by its name\non = {}\nnormal = 0.0\n",
                tables.fresh(curve.name),
                quoted(curve.name)
            );
        }
        if let Some(curve) = held {
            let why = if curve.has(&HELD) { "by its name" } else { "the lowest boundary that looks down" };
            let _ = write!(
                text,
                "\n[support.{}]       # held: {why}\non = {}\nux = 0.0\nuy = 0.0\n",
                tables.fresh(curve.name),
                quoted(curve.name)
            );
        }
    }

    fn load(&self, text: &mut String, held: Option<&NamedCurve>, press: Press) {
        let Some(curve) = self.pressed(held).filter(|_| press != Press::Nothing) else {
            *text += "\n# Nothing presses yet. A load is written so:\n# [load.NAME]\n# on = \"boundary\"\n# pressure = 1.0\n";
            return;
        };
        let why = if curve.has(&LOADED) { "by its name" } else { "the highest boundary that looks up" };
        let mut tables = TableNames::default();
        let _ = write!(text, "\n[load.{}]          # pressed: {why}\non = {}\n", tables.fresh(curve.name), quoted(curve.name));
        if press == Press::Pressure {
            let _ = writeln!(text, "pressure = {:?}       # example: pushes onto the body", PRESSED * YOUNG);
            return;
        }
        let force = self.force();
        let (push, guided) = match curve.normal {
            n if n.x.abs() > 2.0 * n.y.abs() => (format!("[{:?}, 0.0]", -force * n.x.signum()), "uy"),
            n if n.y < 0.0 => (format!("[0.0, {force:?}]"), "ux"),
            _ => (format!("[0.0, {:?}]", -force), "ux"),
        };
        let _ = write!(
            text,
            "rigid = true              # a stiff plate that is bonded to it carries the force; or leave these lines, and give pressure = ...
force = {push}     # example: force for each length of thickness
{guided} = 0.0                  # the plate is guided,
angle = 0.0               # and does not turn
"
        );
    }

    /// Where bodies may touch and no boundary can be pressed: the highest body that is not held, and an example of a force per
    /// area that presses it down.
    fn weight(&self, held: Option<&NamedCurve>) -> Option<(usize, f64)> {
        let held = held.filter(|held| self.pressed(Some(held)).is_none() && !self.pairs.is_empty())?;
        let middle = |body: usize| {
            let own = self.mesh.pieces.iter().zip(self.mesh.bounds()).filter(|(piece, _)| piece.body == body);
            own.map(|(_, [low, high])| low.y + high.y).fold(f64::NEG_INFINITY, f64::max)
        };
        let others = (0..self.mesh.bodies.len()).filter(|&body| body != held.body);
        let body = others.max_by(|&a, &b| middle(a).total_cmp(&middle(b)))?;
        let own = self.mesh.triangles.iter().filter(|triangle| triangle.body as usize == body);
        let area = |corners: [u32; 3]| {
            let [a, b, c] = corners.map(|corner| self.mesh.vertices[corner as usize]);
            0.5 * cross(b - a, c - a)
        };
        let area: f64 = own.map(|triangle| area(triangle.vertices)).sum();
        Some((body, one_digit(self.force() / area)))
    }

    /// The force of the example, for each length of thickness.
    fn force(&self) -> f64 {
        one_digit(PRESSED * YOUNG * self.narrowest())
    }

    /// Width of the narrowest body.
    fn narrowest(&self) -> f64 {
        self.mesh.bounds().iter().map(|[low, high]| (high - low).min()).fold(f64::INFINITY, f64::min)
    }

    /// All named boundaries, for whoever goes on writing.
    fn rest(&self, text: &mut String) {
        *text += "\n# Boundaries of the mesh, for on = and between =:\n";
        for curve in self.curves.iter().take(MOST_NAMED) {
            let (low, high) = (curve.low, curve.high);
            let _ = writeln!(
                text,
                "#   {}: of {}, length {}, x from {} to {}, y from {} to {}",
                quoted(curve.name),
                quoted(&self.mesh.bodies[curve.body]),
                short(curve.length),
                short(low.x),
                short(high.x),
                short(low.y),
                short(high.y)
            );
        }
        if self.curves.len() > MOST_NAMED {
            let _ = writeln!(text, "#   and {} more", self.curves.len() - MOST_NAMED);
        }
    }
}

/// A number of one digit, for an example.
fn one_digit(value: f64) -> f64 {
    format!("{value:.0e}").parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mesh_is_named_from_the_folder_of_the_case() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let place = |name: &str| folder.path().join(name);
        std::fs::create_dir(place("mine")).expect("a folder");
        std::fs::write(place("mine/a.msh"), "").expect("a file");
        let from = |at: Option<&str>| path_from(at.map(place).as_deref(), &place("mine/a.msh"));
        assert_eq!([from(None), from(Some("mine")), from(Some(""))], ["a.msh", "a.msh", "mine/a.msh"]);
        assert_eq!(path_from(Some(&place("mine")), &place("b.msh")), "../b.msh");
    }

    #[test]
    fn parts_of_one_body_have_a_name_in_common() {
        let names = |groups: &[&[&str]]| {
            body_names(&groups.iter().map(|group| group.iter().map(|name| (*name).to_owned()).collect()).collect::<Vec<_>>())
        };
        assert_eq!(names(&[&["block"], &["shaft.core", "shaft.film"]]), ["block", "shaft"]);
        assert_eq!(names(&[&["core", "film"], &["a", "b"]]), ["body", "body-2"]);
    }
}
