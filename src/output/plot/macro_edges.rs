//! The macro mesh on the deformed bodies.

use super::outline::line_data;

/// An edge of the macro mesh as the figure shows it: undeformed points from end to end, and their displacements.
#[derive(Clone, Debug)]
pub struct DrawnEdge(pub Vec<([f64; 2], [f64; 2])>);

/// Stroke of the macro mesh, and of edges between two materials.
pub(super) const THIN: &str = "stroke=\"#fff\" stroke-opacity=\"0.75\" stroke-width=\"4\"";
pub(super) const BETWEEN: &str = "stroke=\"#fff\" stroke-width=\"12\"";

/// Macro edges as one path of lines; nothing if there are none, and no edge with a number that is not finite.
pub(super) fn macro_lines(edges: &[DrawnEdge], stroke: &str, scale: f64, place: impl Fn([f64; 2]) -> (i32, i32)) -> String {
    let moved = |(x, u): &([f64; 2], [f64; 2])| [0, 1].map(|axis| x[axis] + scale * u[axis]);
    let placed = |DrawnEdge(points): &DrawnEdge| {
        let places = points.iter().map(moved).map(|x| x.iter().all(|number| number.is_finite()).then(|| place(x)));
        places.collect::<Option<Vec<_>>>()
    };
    let data: String = edges.iter().filter_map(placed).map(|points| line_data(&points)).collect();
    if data.is_empty() {
        return data;
    }
    format!("<path fill=\"none\" {stroke} d=\"{data}\"/>\n")
}
