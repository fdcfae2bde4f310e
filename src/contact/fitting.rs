//! Γ_C as a spline fitted to the boundary nodes of both bodies that touch or penetrate the other body unloaded.

use super::Pair;
use crate::geometry::{Curve, Point, Spline};
use crate::mesh::{EdgeNode, MacroMesh, Numbering};

/// Nodes closer to the other body than this share of the boundaries' size belong to the cloud.
const NEAR: f64 = 1e-3;

/// Spans at most.
const MOST_SPANS: usize = 64;

/// A node of the cloud: its parameter on body 1's boundary, its place, and the length it stands for.
type Sample = (f64, Point, f64);

/// Fits a spline to the cloud: least squares, each node weighted by its edges so that a finer body does not pull the
/// curve, a quarter as many spans as nodes (four at least). Its parameter is that of body 1's smooth boundary; the
/// range is the part where both bodies have nodes in the cloud. Smooth boundaries, not polygons, decide who is near.
///
/// # Errors
/// Words, if a boundary has corners, or the cloud has fewer than two nodes of one body.
pub fn fitted(mesh: &MacroMesh, numbering: &Numbering, pair: &Pair, sides: [&[u32]; 2]) -> Result<(Curve, [f64; 2]), String> {
    let mut shapes = Vec::new();
    for (name, edges) in pair.between.iter().zip(sides) {
        let [shape] = <[Curve; 1]>::try_from(mesh.smooth_curves(edges)).map_err(|pieces| {
            format!(
                "curve = \"fit\" wants smooth boundaries, but \"{name}\" has corners or gaps: {} pieces; name each by itself",
                pieces.len()
            )
        })?;
        shapes.push(shape);
    }
    let [low, high] = shapes[0].range();
    let size = (shapes[0].point(high) - shapes[0].point(low))
        .norm()
        .max((shapes[0].point(0.5 * (low + high)) - shapes[0].point(low)).norm());
    let mut clouds = [Vec::new(), Vec::new()];
    for (k, cloud) in clouds.iter_mut().enumerate() {
        for (x, weight) in nodes(mesh, numbering, sides[k]) {
            if is_near(mesh, &shapes[1 - k], sides[1 - k], x, NEAR * size) {
                cloud.push((shapes[0].nearest(x), x, weight));
            }
        }
        if cloud.len() < 2 {
            return Err(format!(
                "curve = \"fit\", but fewer than two nodes of \"{}\" touch \"{}\" before loading; a fit that follows the deformed bodies is not available yet: declare the curve",
                pair.between[k],
                pair.between[1 - k]
            ));
        }
    }
    let samples: Vec<Sample> = clouds.iter().flatten().copied().collect();
    let spans = (samples.len() / 4).clamp(4, MOST_SPANS);
    let curve = Curve::Spline(Spline::fit(&samples, spans));
    let extent = |cloud: &Vec<Sample>| {
        let feet = cloud.iter().map(|(_, x, _)| curve.nearest(*x));
        feet.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], t| [a.min(t), b.max(t)])
    };
    let ([a, b], [c, d]) = (extent(&clouds[0]), extent(&clouds[1]));
    let range = [a.max(c), b.min(d)];
    if range[1] - range[0] <= 1e-9 * (b - a) {
        return Err(format!("\"{}\" and \"{}\" touch nowhere over a length", pair.between[0], pair.between[1]));
    }
    Ok((curve, range))
}

/// Nodes of a boundary with the lengths they stand for: those of the finest level on bent edges, otherwise the
/// vertices, because what lies between them on a chord says nothing of the shape.
fn nodes(mesh: &MacroMesh, numbering: &Numbering, edges: &[u32]) -> Vec<(Point, f64)> {
    let mut all = Vec::new();
    for &edge in edges {
        let n = numbering.level.intervals;
        let step = if mesh.edges[edge as usize].shape.is_some() { 1 } else { n };
        let weight = 0.5 * mesh.edge_length(edge) * step as f64 / n as f64;
        for position in (0..=n).step_by(step) {
            let inner = position > 0 && position < n;
            let node = EdgeNode { edge, position: position as u32 };
            all.push((node.place(mesh, numbering), if inner { 2.0 * weight } else { weight }));
        }
    }
    all
}

/// Whether a point lies in the other body or outside it by less than `tolerance`, with its foot on the boundary.
fn is_near(mesh: &MacroMesh, shape: &Curve, edges: &[u32], x: Point, tolerance: f64) -> bool {
    let away = |edge: &&u32| (mesh.edge_position(**edge, 0.5) - x).norm();
    let Some(&edge) = edges.iter().min_by(|a, b| away(a).total_cmp(&away(b))) else { return false };
    let [first, last] = shape.range();
    let t = match shape.period() {
        Some(_) => shape.nearest(x),
        None => shape.nearest(x).clamp(first, last),
    };
    let offset = x - shape.point(t);
    let beyond = offset.dot(&shape.tangent(t)).abs() > tolerance;
    let outside = offset.dot(&mesh.edge_normal(edge, 0.5));
    !beyond && outside < tolerance && outside > -mesh.edge_length(edge)
}
