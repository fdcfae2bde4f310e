//! Files for ParaView: displacement and stress of the bodies, and the contact boundary.
//!
//! VTK's XML format with base64 data in place, which the `vtk` and `meshio` packages of Python read too.
//! Coordinates are those of the undeformed bodies; *Warp By Vector* shows them deformed. Vectors have a third component, zero.

use std::fs::File;
use std::io::{self, BufWriter, IntoInnerError, Write};
use std::path::Path;

use base64::engine::general_purpose::STANDARD;
use base64::write::EncoderWriter;

use super::SIGNS;
use super::tables::TRACE_COLUMNS;
use crate::element::Order;
use crate::output::error::OutputError;
use crate::output::markup::escape;
use crate::recovery::TracePoint;

const STRESS_COMPONENTS: [&str; 4] = ["XX", "YY", "XY", "ZZ"];
/// Bytes that are encoded together: they stay in the cache.
const CHUNK: usize = 3 << 13;

/// A kind of cells: its number in VTK, and how many nodes each has.
type CellKind = (u8, usize);
const LINE: CellKind = (3, 2);
const TRIANGLE: CellKind = (5, 3);
const QUADRATIC_TRIANGLE: CellKind = (22, 6);

/// A node of a piece, with the solution there.
#[derive(Clone, Copy, Debug)]
pub struct PieceNode {
    /// Where it is, undeformed.
    pub place: [f64; 2],
    /// Its displacement.
    pub displacement: [f64; 2],
    /// Stress xx, yy, xy, zz.
    pub stress: [f64; 4],
    /// Von Mises stress.
    pub von_mises: f64,
    /// Temperature; zero of what is not heated.
    pub temperature: f64,
}

/// The triangles of one rank with the solution at their nodes; nodes are numbered within the piece.
#[derive(Clone, Debug)]
pub struct Piece {
    /// P1 or P2.
    pub order: Order,
    /// Their nodes.
    pub nodes: Vec<PieceNode>,
    /// Nodes of the triangles, 3 each (P1) or 6 (P2: corners, then the midsides of edges 01, 12, 20).
    pub cells: Vec<u32>,
    /// Number of the body, and of the part, the physical surface, of each triangle.
    pub parts: Vec<[i32; 2]>,
    /// Whether a body is heated, so that temperatures are told.
    pub is_heated: bool,
    /// The rank, shown as a field of the triangles.
    pub rank: i32,
}

/// Writes the triangles of one rank: `fields.vtu`, or a piece of `fields.pvtu`.
///
/// # Errors
/// The operating system refuses.
pub fn write_piece(path: &Path, piece: &Piece) -> Result<(), OutputError> {
    write_file(path, "UnstructuredGrid", |out| piece.write(out))
}

/// Writes `fields.pvtu`, which joins the pieces of all ranks; their names are relative to its folder, and they have the field of
/// temperatures or not.
///
/// # Errors
/// The operating system refuses.
pub fn write_parallel<S: AsRef<str>>(path: &Path, piece_file_names: &[S], is_heated: bool) -> Result<(), OutputError> {
    write_file(path, "PUnstructuredGrid", |out| {
        writeln!(out, "<PPoints>\n{}\n</PPoints>", declaration("PDataArray", "Float64", "Points", 3, &[]) + "/>")?;
        writeln!(out, "<PPointData>")?;
        let always = [("displacement", 3, &[][..]), ("stress", 4, &STRESS_COMPONENTS), ("von_mises", 1, &[])];
        for (name, components, labels) in always.into_iter().chain(is_heated.then_some(("temperature", 1, &[][..]))) {
            writeln!(out, "{}/>", declaration("PDataArray", "Float64", name, components, labels))?;
        }
        writeln!(out, "</PPointData>\n<PCellData>")?;
        for name in ["body", "part", "rank"] {
            writeln!(out, "{}/>", declaration("PDataArray", "Int32", name, 1, &[]))?;
        }
        writeln!(out, "</PCellData>")?;
        piece_file_names.iter().try_for_each(|name| writeln!(out, "<Piece Source=\"{}\"/>", escape(name.as_ref())))
    })
}

/// Writes `contact_NAME.vtu`: the contact boundary as lines, with the columns of `contact_NAME.csv` at its points; places and normals
/// are vectors.
///
/// Two points at the same place, where λ jumps, are not joined.
///
/// # Errors
/// The operating system refuses.
pub fn write_curve(path: &Path, points: &[TracePoint]) -> Result<(), OutputError> {
    let joined = |&i: &usize| points[i].arc < points[i + 1].arc;
    let starts: Vec<usize> = (0..points.len().saturating_sub(1)).filter(joined).collect();
    let scalars = TRACE_COLUMNS.iter().filter(|(name, _)| !["x", "y", "nx", "ny"].contains(name));
    write_file(path, "UnstructuredGrid", |out| {
        write_mesh(
            out,
            points.iter().map(|p| [p.x.x, p.x.y]),
            starts.iter().flat_map(|&start| [start as i32, start as i32 + 1]),
            (starts.len(), LINE),
        )?;
        writeln!(out, "<PointData Scalars=\"lambda\" Normals=\"normal\">")?;
        for (name, value) in scalars {
            write_array(out, name, 1, &[], points.len(), points.iter().map(|p| value(p).to_le_bytes()))?;
        }
        let normals = points.iter().flat_map(|p| [p.normal.x, p.normal.y, 0.0].map(f64::to_le_bytes));
        write_array(out, "normal", 3, &[], 3 * points.len(), normals)?;
        writeln!(out, "</PointData>\n</Piece>")
    })
}

/// Writes a `.pvd` file, which ParaView opens as a series: times, and the file of each, by its path from the folder of the series.
///
/// # Errors
/// The operating system refuses.
pub fn write_series<S: AsRef<str>>(path: &Path, files: &[(f64, S)]) -> Result<(), OutputError> {
    write_file(path, "Collection", |out| {
        files.iter().try_for_each(|(time, file)| {
            writeln!(out, "<DataSet timestep=\"{time}\" part=\"0\" file=\"{}\"/>", escape(file.as_ref()))
        })
    })
}

impl Piece {
    fn write(&self, out: &mut impl Write) -> io::Result<()> {
        let (points, cells) = (self.nodes.len(), self.parts.len());
        let kind = match self.order {
            Order::P1 => TRIANGLE,
            Order::P2 => QUADRATIC_TRIANGLE,
        };
        let (places, connectivity) = (self.nodes.iter().map(|node| node.place), self.cells.iter().map(|&node| node as i32));
        write_mesh(out, places, connectivity, (cells, kind))?;

        writeln!(out, "<PointData Vectors=\"displacement\" Scalars=\"von_mises\">")?;
        let displacement =
            self.nodes.iter().flat_map(|node| [node.displacement[0], node.displacement[1], 0.0].map(f64::to_le_bytes));
        write_array(out, "displacement", 3, &[], 3 * points, displacement)?;
        write_array(
            out,
            "stress",
            4,
            &STRESS_COMPONENTS,
            4 * points,
            self.nodes.iter().flat_map(|node| node.stress.map(f64::to_le_bytes)),
        )?;
        write_array(out, "von_mises", 1, &[], points, self.nodes.iter().map(|node| node.von_mises.to_le_bytes()))?;
        if self.is_heated {
            write_array(out, "temperature", 1, &[], points, self.nodes.iter().map(|node| node.temperature.to_le_bytes()))?;
        }
        writeln!(out, "</PointData>\n<CellData>")?;
        for (at, name) in ["body", "part"].into_iter().enumerate() {
            write_array(out, name, 1, &[], cells, self.parts.iter().map(|numbers| numbers[at].to_le_bytes()))?;
        }
        write_array(out, "rank", 1, &[], cells, std::iter::repeat_n(self.rank.to_le_bytes(), cells))?;
        writeln!(out, "</CellData>\n</Piece>")
    }
}

/// Opens a piece and writes its points and so many cells of one kind.
fn write_mesh(
    out: &mut impl Write,
    points: impl ExactSizeIterator<Item = [f64; 2]>,
    connectivity: impl Iterator<Item = i32>,
    (count, (kind, nodes)): (usize, CellKind),
) -> io::Result<()> {
    writeln!(out, "<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{count}\">\n<Points>", points.len())?;
    write_array(out, "Points", 3, &[], 3 * points.len(), points.flat_map(|x| [x[0], x[1], 0.0].map(f64::to_le_bytes)))?;
    writeln!(out, "</Points>\n<Cells>")?;
    write_array(out, "connectivity", 1, &[], count * nodes, connectivity.map(i32::to_le_bytes))?;
    write_array(out, "offsets", 1, &[], count, (1..=count).map(|cell| ((cell * nodes) as i32).to_le_bytes()))?;
    write_array(out, "types", 1, &[], count, std::iter::repeat_n([kind], count))?;
    writeln!(out, "</Cells>")
}

/// Writes a file of VTK's XML format around a data set of the given kind.
fn write_file(path: &Path, kind: &str, body: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>) -> Result<(), OutputError> {
    let write = || {
        let mut out = BufWriter::with_capacity(1 << 20, File::create(path)?);
        writeln!(out, "<?xml version=\"1.0\"?>\n<!--\n{}\n-->", SIGNS.join("\n"))?;
        writeln!(out, "<VTKFile type=\"{kind}\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">")?;
        writeln!(out, "<{kind}{}>", if kind.starts_with('P') { " GhostLevel=\"0\"" } else { "" })?;
        body(&mut out)?;
        writeln!(out, "</{kind}>\n</VTKFile>")?;
        out.flush()
    };
    write().map_err(OutputError::unwritten(path))
}

/// The opening tag of an array, up to its last attribute. One component goes unsaid: meshio would make columns of scalars.
fn declaration(tag: &str, kind: &str, name: &str, components: usize, labels: &[&str]) -> String {
    let mut text = format!("<{tag} type=\"{kind}\" Name=\"{name}\"");
    if components > 1 {
        text += &format!(" NumberOfComponents=\"{components}\"");
    }
    for (number, label) in labels.iter().enumerate() {
        text += &format!(" ComponentName{number}=\"{label}\"");
    }
    text
}

/// Writes `count` numbers of so many bytes, low byte first, as base64, preceded by the size of all.
fn write_array<const N: usize>(
    out: &mut impl Write,
    name: &str,
    components: usize,
    labels: &[&str],
    count: usize,
    values: impl Iterator<Item = [u8; N]>,
) -> io::Result<()> {
    let kind = match N {
        8 => "Float64",
        4 => "Int32",
        _ => "UInt8",
    };
    writeln!(out, "{} format=\"binary\">", declaration("DataArray", kind, name, components, labels))?;
    // Numbers are encoded together: one by one they would take a multiple of the time.
    let mut bytes = BufWriter::with_capacity(CHUNK, EncoderWriter::new(&mut *out, &STANDARD));
    bytes.write_all(&((count * N) as u64).to_le_bytes())?;
    values.into_iter().try_for_each(|value| bytes.write_all(&value))?;
    bytes.into_inner().map_err(IntoInnerError::into_error)?.finish()?;
    writeln!(out, "\n</DataArray>")
}

#[cfg(test)]
mod tests {
    use super::*;
    use base64::Engine;

    /// The bytes of the numbers of an array, without the count before them, which is checked.
    fn decoded(text: &str, name: &str) -> Vec<u8> {
        let (_, after) = text.split_once(&format!("Name=\"{name}\"")).unwrap();
        let bytes = STANDARD.decode(after.lines().nth(1).unwrap()).unwrap();
        let (count, numbers) = bytes.split_at(8);
        assert_eq!(u64::from_le_bytes(count.try_into().unwrap()), numbers.len() as u64, "{name}");
        numbers.to_vec()
    }

    fn doubles(bytes: &[u8]) -> Vec<f64> {
        bytes.chunks_exact(8).map(|number| f64::from_le_bytes(number.try_into().unwrap())).collect()
    }

    #[test]
    fn arrays_survive_every_chunk_boundary() {
        for count in [0, 1, 2, 3_070, 3_071, 3_072, 10_000] {
            let mut text = Vec::new();
            write_array(&mut text, "a", 1, &[], count, (0..count).map(|i| (i as f64 / 3.0).to_le_bytes())).unwrap();
            let text = String::from_utf8(text).unwrap();
            let values = doubles(&decoded(&text, "a"));
            assert!(values.len() == count && values.iter().enumerate().all(|(i, &value)| value == i as f64 / 3.0), "{count}");
        }
    }

    #[test]
    fn piece_holds_what_was_given() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("fields.vtu");
        let node = |(place, von_mises, temperature): ([f64; 2], f64, f64)| PieceNode {
            place,
            displacement: place,
            stress: [1.0, 2.0, 3.0, 4.0],
            von_mises,
            temperature,
        };
        let nodes = [([0.0, 0.0], 5.0, 20.0), ([1.0, 0.0], 6.0, -3.0), ([0.0, 1.0], 7.0, 1e3)].map(node).into();
        let (order, cells, parts) = (Order::P1, vec![0, 1, 2], vec![[9, 7]]);
        let piece = Piece { order, nodes, cells, parts, is_heated: true, rank: 4 };
        write_piece(&path, &piece).unwrap();
        let text = std::fs::read_to_string(&path).unwrap();
        assert_eq!(doubles(&decoded(&text, "displacement")), [0., 0., 0., 1., 0., 0., 0., 1., 0.]);
        assert_eq!(doubles(&decoded(&text, "stress")), [1.0, 2.0, 3.0, 4.0].repeat(3));
        assert_eq!(doubles(&decoded(&text, "temperature")), [20.0, -3.0, 1e3]);
        assert_eq!(doubles(&decoded(&text, "von_mises")), [5.0, 6.0, 7.0]);
        assert_eq!(decoded(&text, "connectivity"), [0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0]);
        assert_eq!(decoded(&text, "offsets"), [3, 0, 0, 0]);
        assert_eq!(decoded(&text, "types"), [TRIANGLE.0]);
        assert_eq!(["body", "part", "rank"].map(|name| decoded(&text, name)), [9, 7, 4].map(|number| vec![number, 0, 0, 0]));
        assert!(text.contains("ComponentName3=\"ZZ\"") && SIGNS.iter().all(|sign| text.contains(sign)));
    }

    #[test]
    fn curve_of_no_points_is_a_file() {
        let folder = tempfile::tempdir().unwrap();
        write_curve(&folder.path().join("contact_a.vtu"), &[]).unwrap();
        write_parallel(&folder.path().join("fields.pvtu"), &["a&b.vtu"], true).unwrap();
        assert!(std::fs::read_to_string(folder.path().join("fields.pvtu")).unwrap().contains("Source=\"a&amp;b.vtu\""));
    }
}
