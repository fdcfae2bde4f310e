//! `[mesh]`

use std::path::{Path, PathBuf};

use toml::Value;

use super::grade::{GRADE, Grade, read_grade};
use crate::case::keys::{FromValue, NAME, Section, ValueForm, declare, inner, key, table, whole};
use crate::element::Order;

declare! {
    static MESH = table("mesh");
    /// A Gmsh file, 2.2 or 4.1, ASCII or binary, relative to the case; see [meshes.md](meshes.md). Physical surfaces are bodies,
    /// or [parts](#materials-and-the-plane) of bodies, physical curves boundaries. A body may be of several pieces, if each is
    /// held.
    const FILE: String = key("file", NAME).required("\"bars.msh\", a mesh file of Gmsh");
    /// Order of the displacement: P1 or P2.
    const ORDER: Order = key("order", whole(1, 2)).or("2").refused("must be 1 or 2, the order of the displacement");
    /// How often each triangle is quartered. A run that would take more memory than is left (of the machine, of control groups,
    /// of `ulimit -v` and `-d`) ends with exit code 2 before it begins, and names the refinement that fits; `mezha check` tells
    /// the memory that a run takes, and warns if this machine has less.
    const REFINE: usize = key("refine", whole(0, 12)).or("0")
        .refused("must be a whole number from 0 to 12; each one quarters every triangle");
    const GRADED: toml::Table = key("grade", inner(&GRADE));
}

/// Which mesh, and what is made of it.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshChoice {
    /// Gmsh file, found from the folder of the case.
    pub file: PathBuf,
    /// Order of the displacement.
    pub order: Order,
    /// Refinements after reading.
    pub refine: usize,
    /// Points that they are graded towards.
    pub grades: Vec<Grade>,
}

impl FromValue for Order {
    fn from_value(value: &Value, _: &ValueForm) -> Result<Self, String> {
        Ok(if value.as_integer() == Some(1) { Self::P1 } else { Self::P2 })
    }
}

/// `[mesh]`; the file alone is enough to look for names.
pub fn read_mesh(root: &Section, folder: &Path) -> Option<MeshChoice> {
    let section = root.table("mesh");
    let file = section.required(FILE);
    let order = section.or(ORDER);
    let refine = section.or_default(REFINE);
    let grades = section.optional_table("grade").and_then(|section| read_grade(&section, order));
    Some(MeshChoice { file: folder.join(file?), order: order.unwrap_or(Order::P2), refine, grades: grades.unwrap_or_default() })
}
