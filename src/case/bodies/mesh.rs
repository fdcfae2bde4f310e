//! `[mesh]` and `[mesh.grade]`
//!
//! With κ at the bound `2^(-k/α)`, k the order of the elements and α the exponent of the solution, each layer around the point
//! has an error of one size, and the order comes late (Băcuță, Nistor, Zikatanov 2005). On example 1 (α = 0.818 and 1.057;
//! relative errors of U) P1 with `p0` has 6.6e-6 at 231 428 unknowns with the bound of 0.428 and 0.5, and 4.7e-6 with the 0.281
//! and 0.374 of `"auto"`. Smaller ratios bring nothing more: P1 with 0.25 and 0.35 has 4.6e-6, with 0.184 and 0.269 4.8e-6; P2
//! with 0.15 and 0.194 has 9.7e-8 at 58 372 unknowns, with those of `"auto"` 8.9e-8. On example 2 (α = 0.418), where the full
//! order of P2 would take 0.036, the estimated error in the energy norm at 189 956 unknowns is 1.9e-3 with 0.15 and 1.4e-3 with
//! 0.1.

use crate::case::keys::*;
use crate::element::Order;
use std::path::{Path, PathBuf};
use toml::Value;

/// Refinements of a mesh at most: twelve make 17 million triangles of one.
pub const MOST_REFINE: usize = 12;

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
    const REFINE: usize = key("refine", whole(0, MOST_REFINE as i64)).or("0")
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

declare! {
    /// Refinement towards points, see [method.md](method.md): at each refinement, the new node on an edge that ends at one of them
    /// goes to the fraction `ratio` from it; to the middle if both ends are named.
    static GRADE = table("grade").rules(&[TableRule::OneOf(&[&["ratio"], &["exponent"]])]);
    /// Vertices of the mesh file, of all bodies there, or points (`at`) of supports and loads, as in `[[0, 3], [6, 4]]`.
    const POINTS: Vec<[f64; 2]> = key("points", set(&POINT, "points [x, y] of the mesh file"))
        .required("[[0, 3], [6, 4]]").unit("length");
    /// The fraction, one for all points or one for each; 0.5 is even. `"auto"`: 2^(-1.5/`exponent`) for P1, 2^(-2/`exponent`) for
    /// P2, which keep the order of the elements, within 0.15 and 0.5.
    const RATIO: Value = key("ratio", either(RATIOS, "\"auto\", a number, or a list of them")).or("\"auto\"")
        .refused("must be a number, or a list of them, one per point, from 0.1 to 0.5, or \"auto\"; 0.5 is the middle of the edge");
    /// The displacement goes like r^`exponent` there, for all points or for each; `ratio = "auto"` wants it.
    const EXPONENT: Value = key("exponent", either(EXPONENTS, "a number, or a list of them"))
        .refused("must be a number, or a list of them, one per point, above 0: u ~ r^exponent");
}

/// A fraction of an edge: after twelve refinements by the least one, edges are still longer than rounding.
const FRACTION: FormOf<f64> = number(within(0.1, 0.5));
const RATIOS: &[ValueForm] = &[AUTO, FRACTION.value, list(&FRACTION, "a list of numbers").value];
const EXPONENTS: &[ValueForm] = &[ABOVE_ZERO.value, list(&ABOVE_ZERO, "a list of numbers").value];

/// A point that refinement is graded towards.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grade {
    /// Where (length).
    pub point: [f64; 2],
    /// Fraction κ, from the point, of the new node on an edge.
    pub ratio: f64,
}

/// Bounds of κ that `"auto"` keeps to: smaller ones make triangles flat.
const BOUNDS: [f64; 2] = [0.15, 0.5];

/// Points and ratios of `[mesh.grade]`, for elements of some order.
fn read_grade(section: &Section, order: Option<Order>) -> Option<Vec<Grade>> {
    let points = section.required(POINTS);
    let count = points.as_ref().map_or(1, Vec::len);
    let per_point = |value: Value, words: &str| match values::one_or_each(&value, values::number)? {
        numbers if !value.is_array() => Ok(vec![numbers[0]; count]),
        numbers if numbers.len() == count => Ok(numbers),
        _ => Err(format!("must be a number, or a list of {count}, one per point, {words}")),
    };
    let ratio = section.made("ratio", section.or(RATIO), |ratio| match ratio {
        Value::String(_) => Ok(None),
        ratio => per_point(ratio, "from 0.1 to 0.5, or \"auto\"; 0.5 is the middle of the edge").map(Some),
    });
    let exponent = section.optional(EXPONENT);
    let exponent = section.made("exponent", exponent, |exponent| per_point(exponent, "above 0: u ~ r^exponent"));
    let ratios = match ratio? {
        Some(ratios) => ratios,
        None if !section.has("exponent") => {
            let words = "missing; write exponent = 0.75, if u ~ r^0.75 at these points, or give ratio as a number";
            section.problem(&["exponent"], words);
            return None;
        }
        None => exponent?.into_iter().map(|exponent| automatic(order, exponent)).collect::<Option<_>>()?,
    };
    Some(points?.into_iter().zip(ratios).map(|(point, ratio)| Grade { point, ratio }).collect())
}

/// `2^(-k/exponent)` with `k = 3/2` for P1 and 2 for P2, within bounds. At `k` the order of the elements, each layer around the
/// point has an error of one size: the full order comes late. P1 gains from a smaller ratio; P2, whose triangles would be
/// flat, does not.
fn automatic(order: Option<Order>, exponent: f64) -> Option<f64> {
    let wanted = match order? {
        Order::P1 => 1.5,
        Order::P2 => 2.0,
    };
    Some((-wanted / exponent).exp2().clamp(BOUNDS[0], BOUNDS[1]))
}

#[cfg(test)]
mod tests {
    use crate::case::Case;
    use std::path::Path;

    fn ratios(mesh: &str) -> Vec<f64> {
        let text = format!("mesh = {{ file = 'a.msh', {mesh} }}\nbody.a = {{ young = 1, poisson = 0.3 }}\n");
        let case = Case::parse(&text, Path::new("case.toml"), &[]).expect("a good case");
        case.mesh.grades.iter().map(|grade| grade.ratio).collect()
    }

    #[test]
    fn automatic_ratios_follow_order_and_exponent() {
        let both = |keys: &str| ratios(&format!("grade = {{ points = [[0, 0], [1, 2]], {keys} }}"));
        assert_eq!(both("exponent = 1"), [0.25, 0.25]);
        assert_eq!(both("exponent = [0.4, 2.5]"), [0.15, 0.5], "kept within bounds");
        assert_eq!(both("ratio = [0.2, 0.3], exponent = 1"), [0.2, 0.3], "a number comes first");
        assert_eq!(ratios("order = 1, grade = { points = [[0, 0]], exponent = 0.75 }"), [0.25]);
        assert!(ratios("order = 1, grade = { points = [[0, 0]], exponent = 1 }")[0] < 0.5, "below the bound of the full order");
        assert!(ratios("order = 1").is_empty());
    }
}
