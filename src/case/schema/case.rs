//! The table of all keys of a case file.

use crate::case::acting::load::LOAD;
use crate::case::acting::rigid::RIGID;
use crate::case::acting::support::SUPPORT;
use crate::case::asked::accuracy::ROOT;
use crate::case::asked::exact::EXACT;
use crate::case::asked::output::{NAMED_UNITS, OUTPUT, PROBE};
use crate::case::asked::solver::SOLVER;
use crate::case::asked::steps::STEPS;
use crate::case::bodies::body::{BODY, PLANE_LAW};
use crate::case::bodies::geometry::GEOMETRY;
use crate::case::bodies::gravity::GRAVITY;
use crate::case::bodies::mesh::MESH;
use crate::case::contact::reading::CONTACT;
use crate::case::keys::{ABOVE_ZERO, TEXT, declare, inner, key, named, named_in_files, some_named, table};
use crate::element::Plane;
use toml::Table;

declare! {
    static CASE = table("case");
    /// Shown in output and figures.
    const TITLE: String = key("title", TEXT).or("\"\"");
    /// Strain or stress that is zero across the plane, in all bodies that say nothing else; or "axisymmetric", bodies of
    /// revolution about x = 0; see [materials and the plane](#materials-and-the-plane).
    const PLANE: Plane = key("plane", PLANE_LAW).or("\"strain\"");
    /// What forces, moments and energies are those of, in the case and in `summary.json`; pressures, tractions, stiffnesses and
    /// body forces are per area or volume in any case; see [materials and the plane](#materials-and-the-plane).
    const THICKNESS: f64 = key("thickness", ABOVE_ZERO).or_else("1").unit("length");
    /// The names of the units that the case is in, `{ length = "mm", force = "N" }`. They change no number: figures, the report and
    /// `summary.json` show them; see [units](#units).
    const UNITS: Table = key("units", inner(&NAMED_UNITS));
    const MESHES: Table = key("mesh", inner(&MESH)).required("{ file = \"bars.msh\" }");
    const BODIES: Table = key("body", some_named(&BODY, "NAME")).required("");
    const WEIGHT: Table = key("gravity", inner(&GRAVITY));
    const GEOMETRIES: Table = key("geometry", named(&GEOMETRY));
    const SUPPORTS: Table = key("support", named(&SUPPORT));
    const LOADS: Table = key("load", named(&LOAD));
    const TOOLS: Table = key("rigid", named(&RIGID));
    const CONTACTS: Table = key("contact", named_in_files(&CONTACT));
    const SOLVERS: Table = key("solver", inner(&SOLVER));
    const PROBES: Table = key("probe", named(&PROBE));
    ..ROOT;
    const FACTORS: Table = key("steps", named(&STEPS));
    const WRITTEN: Table = key("output", inner(&OUTPUT));
    const EXPECTED: Table = key("exact", inner(&EXACT));
}
