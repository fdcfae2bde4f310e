//! Readers of Gmsh files: formats 2.2 and 4.1, ASCII and binary.

mod cursor;
mod elements;
mod groups;
#[cfg(test)]
mod tests;
mod version2;
mod version4;

use crate::geometry::Quote;
use crate::mesh::MeshError;
use crate::mesh::file::regular_file::{read_regular, read_start};
use crate::mesh::macro_mesh::MacroMesh;
use crate::mesh::raw_mesh::RawMesh;
use cursor::{Cursor, Encoding};
use std::collections::{HashMap, HashSet};
use std::path::Path;

/// A mesh file of more bytes has more nodes than 32 bits count.
const MOST_BYTES: u64 = 200 << 30;

/// How a mesh file begins.
const BEGIN: &str = "$MeshFormat";

/// Bytes that tell whether a file is a mesh.
const START: usize = 4096;

/// Words for a mesh that is cut into partitions.
const PARTITIONED: &str =
    "is partitioned; save it whole (drop `PartitionMesh` or `-part`): mezha spreads the mesh over its ranks itself";

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

/// The mesh of a Gmsh file that has been read: each physical surface becomes a body, physical curves become boundaries. `file` is its
/// name in errors, `joined` has the name of the body of each surface that is a part of one.
///
/// # Errors
/// [`MeshError`] with file and place, what was found, and the gmsh command that mends it.
pub fn parse_gmsh(bytes: &[u8], file: &Path, joined: HashMap<String, String>) -> Result<MacroMesh, MeshError> {
    MacroMesh::build(RawMesh { joined, ..read(bytes, file)? }, file)
}

/// Names of the physical surfaces of a Gmsh file that has been read, in order.
///
/// # Errors
/// [`MeshError`] as of [`parse_gmsh`].
pub fn surfaces(bytes: &[u8], file: &Path) -> Result<Vec<String>, MeshError> {
    let mesh = read(bytes, file)?;
    let (mut names, mut seen) = (Vec::new(), HashSet::new());
    for together in mesh.triangles.iter().map(|triangle| triangle.names).filter(|&together| seen.insert(together)) {
        names.extend_from_slice(&mesh.names[together as usize]);
    }
    let mut seen = HashSet::new();
    names.retain(|name| seen.insert(name.clone()));
    Ok(names)
}

/// Physical surfaces that share nodes, together: each group is one body. In the order of the file.
///
/// # Errors
/// [`MeshError`] as of [`parse_gmsh`].
pub fn touching_surfaces(bytes: &[u8], file: &Path) -> Result<Vec<Vec<String>>, MeshError> {
    let mut groups: Vec<Vec<String>> = Vec::new();
    let mut group_of: HashMap<String, usize> = HashMap::new();
    let mut at_node: HashMap<u32, usize> = HashMap::new();
    let mesh = read(bytes, file)?;
    for triangle in &mesh.triangles {
        let Some(name) = mesh.names[triangle.names as usize].first() else { continue };
        let mut own = *group_of.entry(name.clone()).or_insert_with(|| {
            groups.push(vec![name.clone()]);
            groups.len() - 1
        });
        for corner in triangle.corners {
            let other = *at_node.entry(corner).or_insert(own);
            if other != own {
                let (first, second) = (own.min(other), own.max(other));
                let moved = std::mem::take(&mut groups[second]);
                moved.iter().for_each(|name| _ = group_of.insert(name.clone(), first));
                groups[first].extend(moved);
                at_node.values_mut().filter(|group| **group == second).for_each(|group| *group = first);
                own = first;
            }
        }
    }
    groups.retain(|group| !group.is_empty());
    Ok(groups)
}

/// The formats.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Version {
    /// 2.0 to 2.2.
    Two,
    /// 4.1.
    Four,
}

/// What a file says, section by section.
fn read(bytes: &[u8], file: &Path) -> Result<RawMesh, MeshError> {
    let mut cursor = Cursor::new(file, bytes);
    let version = match cursor.next_line() {
        Some(line) if line == BEGIN => format(&mut cursor)?,
        None => return Err(MeshError::unusable(file, "is empty; mesh it with `gmsh -2`, and save it as format 4.1")),
        Some(_) => return Err(cursor.error(
            "not a Gmsh mesh: the first line must be $MeshFormat; python/mesh_to_gmsh.py converts Abaqus, VTK and other meshes",
        )),
    };
    let (mut groups, mut elements) = (groups::Groups::default(), elements::Elements::default());
    let mut seen = Vec::new();
    while let Some(line) = cursor.next_line() {
        let Some(section) = line.strip_prefix('$') else {
            return Err(cursor.error(format!("expected the start of a section, found `{}`", Quote(&line))));
        };
        match (section, version) {
            ("PhysicalNames", _) => groups.read_names(&mut cursor)?,
            ("Entities", Version::Four) => groups.read_entities(&mut cursor)?,
            ("Nodes", Version::Four) => version4::read_nodes(&mut cursor, &mut elements)?,
            ("Elements", Version::Four) => version4::read_elements(&mut cursor, &groups, &mut elements)?,
            ("Nodes", Version::Two) => version2::read_nodes(&mut cursor, &mut elements)?,
            ("Elements", Version::Two) => version2::read_elements(&mut cursor, &groups, &mut elements)?,
            ("PartitionedEntities", _) => return Err(cursor.error(PARTITIONED)),
            _ => {
                cursor.skip(section)?;
                continue;
            }
        }
        cursor.end(section)?;
        seen.push(section.to_owned());
    }
    check_sections(&seen, version, file)?;
    check_groups(&elements.mesh, file)?;
    Ok(elements.mesh)
}

/// Every section that is needed is there.
fn check_sections(seen: &[String], version: Version, file: &Path) -> Result<(), MeshError> {
    let mesh = "mesh it with `gmsh -2`";
    for (section, remedy) in [("Entities", "save the file as format 4.1"), ("Nodes", mesh), ("Elements", mesh)] {
        let is_needed = section != "Entities" || version == Version::Four;
        if is_needed && !seen.iter().any(|name| name == section) {
            return Err(MeshError::unusable(file, format!("has no ${section}; {remedy}")));
        }
    }
    Ok(())
}

/// Some triangle belongs to a physical group, with a name or without.
fn check_groups(mesh: &RawMesh, file: &Path) -> Result<(), MeshError> {
    if mesh.triangles.is_empty() || mesh.triangles.iter().any(|triangle| !mesh.names[triangle.names as usize].is_empty()) {
        return Ok(());
    }
    let words = "has no physical surfaces; name the bodies with `Physical Surface(\"name\") = {...}` and the boundaries with `Physical Curve(\"name\") = {...}` in the .geo file; where they are named there, drop `Mesh.SaveAll` or `-save_all`, which loses groups in format 2.2";
    Err(MeshError::unusable(file, words))
}

/// Reads `$MeshFormat`: the version, and how numbers are stored.
fn format(cursor: &mut Cursor) -> Result<Version, MeshError> {
    const SECTION: &str = "MeshFormat";
    let line = cursor.line_in(SECTION)?;
    let mut words = line.split_whitespace();
    let [version, kind, size] = [words.next(), words.next(), words.next()].map(Option::unwrap_or_default);
    let name = cursor.file.file_name().unwrap_or(cursor.file.as_os_str()).to_string_lossy();
    let convert = format!("`gmsh {name} -save -format msh41 -o converted.msh`");
    let read = match version {
        "2" | "2.0" | "2.1" | "2.2" => Version::Two,
        "4.1" => Version::Four,
        _ => {
            let words = format!("mesh format {} is not read, only 2.2 and 4.1; convert it with {convert}", Quote(version));
            return Err(cursor.error(words));
        }
    };
    match (kind, size) {
        ("0", _) => {}
        ("1", "8") => cursor.encoding = byte_order(cursor, &convert)?,
        _ => {
            let words = format!(
                "expected `{version} 0 8` for ASCII or `{version} 1 8` for binary, found `{}`; convert it with {convert}",
                Quote(&line)
            );
            return Err(cursor.error(words));
        }
    }
    cursor.end(SECTION)?;
    Ok(read)
}

/// Which byte of a number comes first, from a one that every binary file has for this purpose.
fn byte_order(cursor: &mut Cursor, convert: &str) -> Result<Encoding, MeshError> {
    match cursor.bytes::<4>("MeshFormat")? {
        [1, 0, 0, 0] => Ok(Encoding::LittleEndian),
        [0, 0, 0, 1] => Ok(Encoding::BigEndian),
        found => Err(cursor.error(format!(
            "the order of bytes of this binary file is not known: expected a 1 as four bytes, found {found:?}; save it again, or convert it with {convert}"
        ))),
    }
}
