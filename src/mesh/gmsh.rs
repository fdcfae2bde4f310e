//! Reader of Gmsh 4.1 ASCII files.

use super::MeshError;
use super::macro_mesh::{MacroMesh, RawMesh};
use super::regular_file::{read_regular, read_start};
use crate::geometry::{Point, Quote, Rounded};
use std::collections::HashMap;
use std::path::Path;
use std::str::FromStr;

/// Reads a Gmsh 4.1 ASCII file: each physical surface becomes a body, physical curves become boundaries.
///
/// # Errors
/// [`MeshError`] with file and line, what was found, and the gmsh command that mends it.
pub fn read_gmsh(file: &Path) -> Result<MacroMesh, MeshError> {
    parse_gmsh(&read_bytes(file)?, file)
}

/// A mesh file of more bytes has more nodes than 32 bits count.
const MOST_BYTES: u64 = 200 << 30;

/// How a mesh file begins.
const BEGIN: &str = "$MeshFormat";

/// Bytes that tell whether a file is a mesh.
const START: usize = 4096;

/// The bytes of a mesh file, for [`parse_gmsh`] on all ranks.
///
/// # Errors
/// [`MeshError::Unreadable`]
pub fn read_bytes(file: &Path) -> Result<Vec<u8>, MeshError> {
    let unreadable = |source| MeshError::Unreadable { file: file.to_path_buf(), source };
    let start = read_start(file, START).map_err(unreadable)?;
    if !String::from_utf8_lossy(&start).trim_start().starts_with(BEGIN) {
        // It is no mesh, however long it may be; the start is enough to say so.
        return Ok(start);
    }
    read_regular(file, MOST_BYTES).map_err(unreadable)
}

/// The mesh of a Gmsh 4.1 ASCII file that has been read; `file` is its name in errors.
///
/// # Errors
/// [`MeshError`] as of [`read_gmsh`].
pub fn parse_gmsh(bytes: &[u8], file: &Path) -> Result<MacroMesh, MeshError> {
    parse_joined(bytes, file, HashMap::new())
}

/// The same, where physical surfaces are joined: `joined` has the name of the body of each surface that is a part of one.
///
/// # Errors
/// [`MeshError`] as of [`read_gmsh`].
pub fn parse_joined(bytes: &[u8], file: &Path, joined: HashMap<String, String>) -> Result<MacroMesh, MeshError> {
    let text = String::from_utf8_lossy(bytes);
    MacroMesh::build(RawMesh { joined, ..Reader::new(file, &text).read()? }, file)
}

/// Names of the physical surfaces of a Gmsh 4.1 ASCII file that has been read, in order.
///
/// # Errors
/// [`MeshError`] as of [`read_gmsh`].
pub fn surfaces(bytes: &[u8], file: &Path) -> Result<Vec<String>, MeshError> {
    let text = String::from_utf8_lossy(bytes);
    let mut names: Vec<String> = Vec::new();
    for name in Reader::new(file, &text).read()?.triangles.into_iter().flat_map(|(_, names, _)| names) {
        if !names.contains(&name) {
            names.push(name);
        }
    }
    Ok(names)
}

/// Whole numbers below this are exact as floating-point ones.
const MOST_EXACT: f64 = 9_007_199_254_740_992.0;

/// Dimension and tag of an elementary entity of the file.
type Entity = (usize, i64);

/// A cursor over the lines of the file.
struct Reader<'a> {
    file: &'a Path,
    lines: std::iter::Enumerate<std::str::Lines<'a>>,
    line: usize,
    convert: String,
    names: HashMap<Entity, String>,
    physical: HashMap<Entity, Vec<i64>>,
    nodes: HashMap<i64, usize>,
    mesh: RawMesh,
}

impl<'a> Reader<'a> {
    fn new(file: &'a Path, text: &'a str) -> Self {
        let name = file.file_name().unwrap_or(file.as_os_str()).to_string_lossy();
        Self {
            file,
            lines: text.lines().enumerate(),
            line: 0,
            convert: format!("`gmsh {name} -save -format msh41 -o converted.msh`"),
            names: HashMap::new(),
            physical: HashMap::new(),
            nodes: HashMap::new(),
            mesh: RawMesh::default(),
        }
    }

    fn error(&self, message: impl Into<String>) -> MeshError {
        MeshError::Syntax { file: self.file.to_path_buf(), line: self.line, message: message.into() }
    }

    /// Next line that is not blank, or nothing at the end of the file.
    fn next_line(&mut self) -> Option<&'a str> {
        for (number, line) in self.lines.by_ref() {
            self.line = number + 1;
            if !line.trim().is_empty() {
                return Some(line.trim());
            }
        }
        None
    }

    fn line_in(&mut self, section: &str) -> Result<&'a str, MeshError> {
        match self.next_line() {
            Some(line) => Ok(line),
            None => Err(self.error(format!("the file ends inside ${section}; it is cut off, save it again"))),
        }
    }

    /// The next line as numbers, at least `least` of them.
    fn numbers<T: FromStr>(&mut self, section: &str, least: usize) -> Result<Vec<T>, MeshError> {
        let line = self.line_in(section)?;
        let found: Result<Vec<T>, _> = line.split_whitespace().map(str::parse).collect();
        match found {
            Ok(values) if values.len() >= least => Ok(values),
            _ => Err(self.error(format!("in ${section}, expected {least} numbers, found `{}`", Quote(line)))),
        }
    }

    /// The line before a block of nodes or elements: dimension, entity, kind, and how many there are.
    fn block(&mut self, section: &str) -> Result<Vec<i64>, MeshError> {
        let block: Vec<i64> = self.numbers(section, 4)?;
        if block[3] < 0 {
            return Err(self.error(format!("in ${section}, expected a count of at least 0, found {}", block[3])));
        }
        Ok(block)
    }

    /// A tag or a count that stands among coordinates.
    fn whole(&self, number: f64) -> Result<i64, MeshError> {
        if number.fract() == 0.0 && number.abs() < MOST_EXACT {
            return Ok(number as i64);
        }
        Err(self
            .error(format!("in $Entities, found {} where a tag or a count stands; it must be a whole number", Rounded(number))))
    }

    fn read(mut self) -> Result<RawMesh, MeshError> {
        match self.next_line() {
            Some(BEGIN) => self.format()?,
            None => return Err(MeshError::unusable(self.file, "is empty; mesh it with `gmsh -2`, and save it as format 4.1")),
            Some(_) => return Err(self.error("not a Gmsh mesh: the first line must be $MeshFormat")),
        }
        let mut seen = Vec::new();
        while let Some(line) = self.next_line() {
            let Some(section) = line.strip_prefix('$') else {
                return Err(self.error(format!("expected the start of a section, found `{}`", Quote(line))));
            };
            match section {
                "PhysicalNames" => self.physical_names()?,
                "Entities" => self.entities()?,
                "Nodes" => self.nodes()?,
                "Elements" => self.elements()?,
                _ => self.skip(section)?,
            }
            if matches!(section, "PhysicalNames" | "Entities" | "Nodes" | "Elements") {
                self.end(section)?;
            }
            seen.push(section);
        }
        for (section, remedy) in [
            (
                "PhysicalNames",
                "name the bodies with `Physical Surface(\"name\") = {...}` and the boundaries with `Physical Curve(\"name\") = {...}` in the .geo file",
            ),
            ("Entities", "save the file as format 4.1"),
            ("Nodes", "mesh it with `gmsh -2`"),
            ("Elements", "mesh it with `gmsh -2`"),
        ] {
            if !seen.contains(&section) {
                return Err(MeshError::unusable(self.file, format!("has no ${section}; {remedy}")));
            }
        }
        Ok(self.mesh)
    }

    fn end(&mut self, section: &str) -> Result<(), MeshError> {
        let line = self.line_in(section)?;
        if line.strip_prefix("$End") == Some(section) {
            return Ok(());
        }
        Err(self.error(format!("expected $End{section}, found `{}`", Quote(line))))
    }

    fn skip(&mut self, section: &str) -> Result<(), MeshError> {
        let end = format!("$End{section}");
        while self.line_in(section)? != end {}
        Ok(())
    }

    fn format(&mut self) -> Result<(), MeshError> {
        let line = self.line_in("MeshFormat")?;
        let mut words = line.split_whitespace();
        let (version, kind) = (words.next().unwrap_or(""), words.next().unwrap_or(""));
        if version != "4.1" {
            return Err(
                self.error(format!("mesh format {version} is not read, only 4.1 ASCII; convert it with {}", self.convert))
            );
        }
        if kind != "0" {
            return Err(self.error(format!(
                "binary files are not read, only ASCII; save it with `Mesh.Binary = 0`, or convert it with {}",
                self.convert
            )));
        }
        self.end("MeshFormat")
    }

    fn physical_names(&mut self) -> Result<(), MeshError> {
        let count: usize = self.numbers("PhysicalNames", 1)?[0];
        for _ in 0..count {
            let line = self.line_in("PhysicalNames")?;
            let mut words = line.splitn(3, ' ');
            let mut number = || words.next().and_then(|word| word.parse::<i64>().ok());
            let (dimension, tag) = (number(), number());
            let name = words.next().map(|word| word.trim().trim_matches('"').to_string());
            let (Some(dimension), Some(tag), Some(name)) = (dimension, tag, name) else {
                return Err(self.error(format!("expected `dimension tag \"name\"`, found `{}`", Quote(line))));
            };
            self.names.insert((dimension as usize, tag), name);
        }
        Ok(())
    }

    fn entities(&mut self) -> Result<(), MeshError> {
        let counts: Vec<usize> = self.numbers("Entities", 4)?;
        for (dimension, count) in counts.into_iter().take(4).enumerate() {
            let first = if dimension == 0 { 4 } else { 7 };
            for _ in 0..count {
                let values: Vec<f64> = self.numbers("Entities", first + 1)?;
                let (entity, count) = (self.whole(values[0])?, self.whole(values[first])?);
                let rest = &values[first + 1..];
                let Some(tags) = usize::try_from(count).ok().and_then(|count| rest.get(..count)) else {
                    let words = format!("expected {count} physical tags, found {} numbers; save the file again", rest.len());
                    return Err(self.error(words));
                };
                // A sign tells the direction of the entity in the group.
                let tags = tags.iter().map(|&tag| Ok(self.whole(tag)?.abs())).collect::<Result<_, MeshError>>()?;
                self.physical.insert((dimension, entity), tags);
            }
        }
        Ok(())
    }

    fn nodes(&mut self) -> Result<(), MeshError> {
        let blocks: usize = self.numbers("Nodes", 4)?[0];
        for _ in 0..blocks {
            let block = self.block("Nodes")?;
            let mut tags = Vec::new();
            for _ in 0..block[3] {
                tags.push(self.numbers::<i64>("Nodes", 1)?[0]);
            }
            for tag in tags {
                let x: Vec<f64> = self.numbers("Nodes", 3)?;
                if x[..3].iter().any(|value| !value.is_finite()) {
                    return Err(self.error(format!("node {tag} has a coordinate that is not a finite number")));
                }
                if x[2].abs() > 1e-12 * (x[0].abs() + x[1].abs() + 1.0) {
                    return Err(self.error(format!("node {tag} has z = {}; the mesh must lie in the plane z = 0", Rounded(x[2]))));
                }
                self.nodes.insert(tag, self.mesh.vertices.len());
                self.mesh.vertices.push(Point::new(x[0], x[1]));
            }
        }
        Ok(())
    }

    fn elements(&mut self) -> Result<(), MeshError> {
        let blocks: usize = self.numbers("Elements", 4)?[0];
        for _ in 0..blocks {
            let block = self.block("Elements")?;
            let (dimension, entity, kind, count) = (block[0] as usize, block[1], block[2], block[3]);
            let corners = match kind {
                1 => 2,
                2 => 3,
                15 => 1,
                _ => return Err(self.error(refused_element(kind))),
            };
            let names = self.names_of((dimension, entity));
            for _ in 0..count {
                let words: Vec<i64> = self.numbers("Elements", 1 + corners)?;
                let corners = self.corners(&words[1..=corners])?;
                match corners[..] {
                    [a, b] => self.mesh.lines.extend(names.iter().map(|name| (name.clone(), [a, b], self.line))),
                    [a, b, c] => self.mesh.triangles.push(([a, b, c], names.clone(), self.line)),
                    _ => {}
                }
            }
        }
        Ok(())
    }

    fn corners(&self, tags: &[i64]) -> Result<Vec<usize>, MeshError> {
        let find = |tag| self.nodes.get(tag).copied().ok_or_else(|| self.error(format!("node {tag} is not among the $Nodes")));
        tags.iter().map(find).collect()
    }

    /// Physical names of an entity; a physical group without a name is known by its tag.
    fn names_of(&self, entity: Entity) -> Vec<String> {
        let tags = self.physical.get(&entity).map(Vec::as_slice).unwrap_or(&[]);
        let name = |tag: &i64| self.names.get(&(entity.0, *tag)).cloned().unwrap_or(tag.to_string());
        tags.iter().map(name).collect()
    }
}

fn refused_element(kind: i64) -> String {
    let (what, remedy) = match kind {
        3 | 10 | 16 => ("quadrangles", "mesh with triangles (drop `Recombine Surface`)"),
        4..=7 | 11..=14 => ("volume elements", "mesh the plane scene with `gmsh -2`"),
        8 | 9 => ("second-order elements", "mesh with `gmsh -2 -order 1`: `mesh.order = 2` in the case makes P2 triangles of it"),
        _ => ("elements of another kind", "mesh with first-order triangles"),
    };
    format!("holds {what} (Gmsh element type {kind}); {remedy}")
}

#[cfg(test)]
mod tests {
    use super::*;

    const SQUARE: &str = "$MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
2
1 7 \"lower edge\"
2 8 \"plate\"
$EndPhysicalNames
$Entities
0 1 1 0
5 0 0 0 1 0 0 1 7 0
6 0 0 0 1 1 0 1 8 0
$EndEntities
$Nodes
1 5 10 14
2 6 0 5
10
11
12
13
14
0 0 0
1 0 0
1 1 0
0 1 0
9 9 0
$EndNodes
$Elements
2 3 1 3
1 5 1 1
1 10 11
2 6 2 2
2 10 11 12
3 10 13 12
$EndElements
";

    fn read(text: &str) -> Result<MacroMesh, String> {
        let file = Path::new("square.msh");
        Reader::new(file, text).read().and_then(|raw| MacroMesh::build(raw, file)).map_err(|error| error.to_string())
    }

    #[test]
    fn names_nodes_and_triangles_are_read_and_clockwise_ones_turned() {
        let mesh = read(SQUARE).expect("a good file");
        assert_eq!(mesh.bodies, ["plate"]);
        assert_eq!(mesh.boundary("lower edge").expect("named").edges.len(), 1);
        assert_eq!((mesh.vertices.len(), mesh.triangles.len(), mesh.edges.len()), (4, 2, 5), "the loose node is dropped");
        for triangle in &mesh.triangles {
            let [a, b, c] = triangle.vertices.map(|v| mesh.vertices[v as usize]);
            assert!(crate::geometry::cross(b - a, c - a) > 0.0);
        }
    }

    #[test]
    fn what_cannot_be_read_is_refused_with_line_and_remedy() {
        let table = [
            ("4.1 0 8", "2.2 0 8", "line 2: mesh format 2.2 is not read, only 4.1 ASCII; convert it with `gmsh square.msh"),
            ("4.1 0 8", "4.1 1 8", "line 2: binary files are not read"),
            ("2 6 2 2", "2 6 3 2", "quadrangles (Gmsh element type 3)"),
            ("2 6 2 2", "2 6 9 2", "`gmsh -2 -order 1`"),
            ("3 10 13 12", "3 10 13 99", "line 34: node 99 is not among the $Nodes"),
            ("0 1 0\n9", "0 1\n9", "expected 3 numbers, found `0 1`"),
            ("1 1 0\n0 1 0", "1 0 0\n0 1 0", "degenerate triangle"),
            ("1 1 0\n0", "1 1 0.5\n0", "plane z = 0"),
            ("5 0 0 0 1 0 0 1 7 0", "5.5 0 0 0 1 0 0 1 7 0", "line 11: in $Entities, found 5.5 where a tag"),
            ("5 0 0 0 1 0 0 1 7 0", "5 0 0 0 1 0 0 1e300 7 0", "found 1e300 where"),
            ("5 0 0 0 1 0 0 1 7 0", "5 0 0 0 1 0 0 9 7 0", "expected 9 physical tags, found 2 numbers"),
            ("1 10 11\n", "1 11 13\n", "\"lower edge\" is not an edge of a triangle"),
            ("1 10 11\n", "1 10 12\n", "\"lower edge\" lies inside a body"),
        ];
        for (good, bad, words) in table {
            let found = read(&SQUARE.replacen(good, bad, 1)).expect_err(words);
            assert!(found.contains(words), "{found} instead of {words}");
        }
        assert!(read("solid\n").expect_err("no mesh").contains("not a Gmsh mesh"));
        assert!(read("\n\n").expect_err("no mesh").contains("square.msh: is empty"));
    }
}
