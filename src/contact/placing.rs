//! Γ_C of a pair, placed between two boundaries of the mesh and cut by the pair's rule.

use super::fitting::fitted;
use super::{ContactBoundary, CurveChoice, MultiplierSpace, Pair, SegmentRule};
use crate::element::Order;
use crate::geometry::{Curve, Point};
use crate::mesh::{BoundaryEdge, MacroMesh, Numbering};

/// Why no contact boundary can be placed: the key of the case, and words.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("contact.{pair}: {words}")]
pub struct PlacingError {
    /// Name of the pair.
    pub pair: String,
    /// What is wrong and what to do.
    pub words: String,
}

/// Places Γ_C of a pair and cuts it into segments. `young` are the moduli of body 1 and body 2 (stress); `numbering`
/// is that of the finest level, whose edge lengths the automatic rule follows. The same on every rank.
///
/// # Errors
/// [`PlacingError`] if the boundaries are not straight or do not share a geometry, as the pair claims, or do not overlap.
pub fn place(mesh: &MacroMesh, numbering: &Numbering, pair: &Pair, young: [f64; 2]) -> Result<ContactBoundary, PlacingError> {
    let error = |words: String| PlacingError { pair: pair.name.clone(), words };
    let sides = [0, 1].map(|k| mesh.boundary(&pair.between[k]).map(|b| b.edges.as_slice()).unwrap_or(&[]));
    let (curve, range) = match pair.curve {
        CurveChoice::Fit => fitted(mesh, numbering, pair, sides).map_err(error)?,
        CurveChoice::Line => line_between(mesh, pair, sides).map_err(error)?,
        CurveChoice::Geometry => shared_geometry(mesh, pair, sides).map_err(error)?,
    };
    let middle = curve.point(0.5 * (range[0] + range[1]));
    let nearest = sides[0].iter().min_by(|&&a, &&b| {
        let away = |edge| (mesh.edge_position(edge, 0.5) - middle).norm();
        away(a).total_cmp(&away(b))
    });
    let Some(&nearest) = nearest else { return Err(error(format!("\"{}\" has no edges", pair.between[0]))) };
    let towards = mesh.edge_normal(nearest, 0.5);
    let mut boundary = ContactBoundary::new(curve, range, towards);
    check_cover(mesh, pair, sides, &boundary).map_err(error)?;
    boundary.cut(&fractions(mesh, numbering, pair, young, &boundary));
    Ok(boundary)
}

/// Both boundaries must cover Γ_C without a hole, and must not close around it.
fn check_cover(mesh: &MacroMesh, pair: &Pair, sides: [&[u32]; 2], boundary: &ContactBoundary) -> Result<(), String> {
    let (first, last) = (boundary.knots()[0], boundary.knots()[1]);
    let least = 1e-6 * (last - first);
    for (side, edges) in sides.into_iter().enumerate() {
        let part = |edge: &u32| boundary.feet(mesh.edges[*edge as usize].vertices.map(|vertex| mesh.vertices[vertex as usize]));
        let mut parts: Vec<[f64; 2]> = edges.iter().map(part).collect();
        let whole: f64 = parts.iter().map(|[a, b]| b - a).sum();
        if boundary.period().is_some_and(|period| whole > (1.0 - 1e-6) * period) {
            return Err(format!(
                "\"{}\" is a closed curve; closed contact boundaries are not available yet: name an arc of it that is open",
                pair.between[side]
            ));
        }
        parts.sort_by(|a, b| a[0].total_cmp(&b[0]));
        parts.push([last; 2]);
        let mut reached = first;
        for [from, to] in parts.iter().copied().filter(|[_, to]| *to > first) {
            if from.min(last) > reached + least {
                let [a, b] = [reached, from].map(|t| boundary.point(t));
                return Err(format!(
                    "\"{}\" has a hole between ({}, {}) and ({}, {}); give each part a name and a contact of its own",
                    pair.between[side], a.x, a.y, b.x, b.y
                ));
            }
            reached = reached.max(to);
        }
    }
    Ok(())
}

/// A straight line between two straight boundaries, over the extent that both have. It runs to larger x, or upwards if
/// it is vertical: given segments stay where they are, whichever body is named first and however the mesh is numbered.
fn line_between(mesh: &MacroMesh, pair: &Pair, sides: [&[u32]; 2]) -> Result<(Curve, [f64; 2]), String> {
    let mut extents = [[0.0; 2]; 2];
    let mut offsets = [0.0; 2];
    let (mut origin, mut along) = (Point::zeros(), Point::zeros());
    for (side, edges) in sides.into_iter().enumerate() {
        let (a, b) = ends(mesh, edges);
        if side == 0 {
            let towards = (b - a).normalize();
            let falls = towards.x < -1e-9 || (towards.x <= 1e-9 && towards.y < 0.0);
            (origin, along) = (a, if falls { -towards } else { towards });
        }
        let own = (b - a).normalize();
        if (own.dot(&along).abs() - 1.0).abs() > 1e-9 {
            return Err(format!(
                "curve = \"line\", but \"{}\" and \"{}\" are not parallel; give a [geometry] that lists both, and curve = \"geometry\"",
                pair.between[0], pair.between[1]
            ));
        }
        let length = (b - a).norm();
        for &edge in edges {
            let bent = mesh.edges[edge as usize].shape.is_some();
            let off = mesh.edges[edge as usize]
                .vertices
                .iter()
                .any(|&vertex| crate::geometry::cross(own, mesh.vertices[vertex as usize] - a).abs() > 1e-9 * length);
            if bent || off {
                return Err(format!(
                    "curve = \"line\", but \"{}\" is not straight; give a [geometry] that lists both boundaries, and curve = \"geometry\"",
                    pair.between[side]
                ));
            }
        }
        let (s, t) = ((a - origin).dot(&along), (b - origin).dot(&along));
        extents[side] = [s.min(t), s.max(t)];
        offsets[side] = crate::geometry::cross(along, a - origin);
    }
    let (start, end) = (extents[0][0].max(extents[1][0]), extents[0][1].min(extents[1][1]));
    if end - start <= 1e-9 * (extents[0][1] - extents[0][0]) {
        return Err(format!(
            "\"{}\" and \"{}\" do not face each other: they have no extent in common",
            pair.between[0], pair.between[1]
        ));
    }
    // `cross(along, left) = 1`: the mean of both lines, where they lie apart.
    let lift = Point::new(-along.y, along.x) * (0.5 * (offsets[0] + offsets[1]));
    let at = |s: f64| {
        let x = origin + s * along + lift;
        [x.x, x.y]
    };
    Ok((Curve::Line([at(start), at(end)]), [0.0, 1.0]))
}

/// The two vertices of a set of edges that are farthest apart, seen from the first vertex.
fn ends(mesh: &MacroMesh, edges: &[u32]) -> (Point, Point) {
    let points =
        || edges.iter().flat_map(|&edge| mesh.edges[edge as usize].vertices).map(|vertex| mesh.vertices[vertex as usize]);
    let farthest = |from: Point| points().max_by(|a, b| (a - from).norm().total_cmp(&(b - from).norm())).unwrap_or(from);
    let a = points().next().map(farthest).unwrap_or_default();
    (a, farthest(a))
}

/// The declared geometry of both boundaries, over the extent that both have.
fn shared_geometry(mesh: &MacroMesh, pair: &Pair, sides: [&[u32]; 2]) -> Result<(Curve, [f64; 2]), String> {
    let mut common: Option<(Curve, [f64; 2])> = None;
    for (side, edges) in sides.into_iter().enumerate() {
        let mut extent: Option<[f64; 2]> = None;
        for &edge in edges {
            let Some(shape) = &mesh.edges[edge as usize].shape else {
                return Err(format!("curve = \"geometry\", but no curved [geometry] lists \"{}\"", pair.between[side]));
            };
            let middle_of = |[a, b]: [f64; 2]| 0.5 * (a + b);
            let reference = extent.or(common.as_ref().map(|(_, range)| *range)).map(middle_of).filter(|t| t.is_finite());
            let middle = 0.5 * (shape.range[0] + shape.range[1]);
            let turn = match (shape.curve.period(), reference) {
                (Some(period), Some(reference)) => ((reference - middle) / period).round() * period,
                _ => 0.0,
            };
            let [a, b] = shape.range.map(|t| t + turn);
            let [low, high] = extent.unwrap_or([f64::INFINITY, f64::NEG_INFINITY]);
            extent = Some([low.min(a).min(b), high.max(a).max(b)]);
            common.get_or_insert_with(|| ((*shape.curve).clone(), [f64::NEG_INFINITY, f64::INFINITY]));
        }
        if let (Some((_, range)), Some([low, high])) = (&mut common, extent) {
            *range = [range[0].max(low), range[1].min(high)];
        }
    }
    match common {
        Some((curve, range)) if range[1] > range[0] => Ok((curve, range)),
        _ => Err(format!(
            "\"{}\" and \"{}\" do not face each other: they have no extent in common",
            pair.between[0], pair.between[1]
        )),
    }
}

fn fractions(mesh: &MacroMesh, numbering: &Numbering, pair: &Pair, young: [f64; 2], boundary: &ContactBoundary) -> Vec<f64> {
    let equal = |count: usize| (0..=count).map(|k| k as f64 / count as f64).collect();
    match &pair.segments {
        SegmentRule::Fractions(fractions) => fractions.clone(),
        SegmentRule::Count(count) => equal(*count),
        SegmentRule::Auto => {
            let edges = all_edges(mesh, numbering, pair);
            let ratio = safe_ratio_of(numbering.level.order, pair.space, &edges);
            let longest = softer_edge_length(boundary, &edges, young);
            equal(((boundary.length() / (ratio * longest) * (1.0 + 1e-9)) as usize).max(1))
        }
    }
}

/// All element edges of a pair's two boundaries, at the level that is numbered.
pub fn all_edges(mesh: &MacroMesh, numbering: &Numbering, pair: &Pair) -> [Vec<BoundaryEdge>; 2] {
    [0, 1].map(|k| {
        let edges = mesh.boundary(&pair.between[k]).map(|b| b.edges.as_slice()).unwrap_or(&[]);
        edges.iter().flat_map(|&edge| BoundaryEdge::all_of(mesh, edge, numbering)).collect()
    })
}

/// Edges that rule the segment length, as `(part of Γ_C that sees the edge, its length)`: those of the softer body, or
/// of both where the moduli are within a factor 3. Edges beyond the ends of Γ_C are left out.
fn softer_edges<'a>(
    boundary: &'a ContactBoundary,
    edges: &'a [Vec<BoundaryEdge>; 2],
    young: [f64; 2],
) -> impl Iterator<Item = ([f64; 2], f64)> + 'a {
    let counts = [young[0] <= 3.0 * young[1], young[1] <= 3.0 * young[0]];
    let ruling = edges.iter().zip(counts).filter(|(_, counts)| *counts).flat_map(|(edges, _)| edges);
    let knots = boundary.knots();
    let (first, last) = (knots[0], knots[knots.len() - 1]);
    let least = 1e-9 * (last - first);
    ruling.filter_map(move |edge| {
        let feet = boundary.feet([edge.points[0], edge.points[1]]);
        let part = [feet[0].max(first), feet[1].min(last)];
        (part[1] - part[0] > least).then(|| (part, edge.length()))
    })
}

/// Length of the longest ruling edge: the `h` of the jump term.
pub fn softer_edge_length(boundary: &ContactBoundary, edges: &[Vec<BoundaryEdge>; 2], young: [f64; 2]) -> f64 {
    softer_edges(boundary, edges, young).map(|(_, length)| length).fold(0.0, f64::max)
}

/// Smallest ratio of a segment's length to the longest ruling edge that it meets.
pub fn segment_ratio(boundary: &ContactBoundary, edges: &[Vec<BoundaryEdge>; 2], young: [f64; 2]) -> f64 {
    let ruling: Vec<([f64; 2], f64)> = softer_edges(boundary, edges, young).collect();
    let ratio = |(k, ends): (usize, &[f64])| {
        let least = 1e-9 * (ends[1] - ends[0]);
        let meets = |part: &[f64; 2]| part[1] > ends[0] + least && part[0] < ends[1] - least;
        let longest = ruling.iter().filter(|(part, _)| meets(part)).map(|(_, length)| *length).fold(0.0, f64::max);
        boundary.segment_length(k) / longest
    };
    boundary.knots().windows(2).enumerate().map(ratio).fold(f64::INFINITY, f64::min)
}

/// Smallest safe segment length, in edges of the softer body: the discrete inf-sup constant stays above 0.3 with some
/// margin. P2 with discontinuous multipliers needs more where the meshes match.
fn safe_ratio(order: Order, space: MultiplierSpace, matching: bool) -> f64 {
    match (order, space) {
        (Order::P1, MultiplierSpace::P0) => 1.5,
        (Order::P1, MultiplierSpace::P1Continuous) => 1.25,
        (Order::P1, MultiplierSpace::P1Discontinuous) => 3.0,
        (Order::P2, MultiplierSpace::P1Discontinuous) => {
            if matching {
                2.0
            } else {
                1.5
            }
        }
        (Order::P2, _) => 0.75,
    }
}

/// Smallest safe segment length of a pair on its meshes, in edges of the softer body.
pub fn safe_ratio_of(order: Order, space: MultiplierSpace, edges: &[Vec<BoundaryEdge>; 2]) -> f64 {
    safe_ratio(order, space, matching(edges))
}

/// Whether every edge end of body 2 coincides with one of body 1.
fn matching(edges: &[Vec<BoundaryEdge>; 2]) -> bool {
    let near = |a: &BoundaryEdge, b: &BoundaryEdge| {
        let close = |p: Point, q: Point| (p - q).norm() < 1e-6 * a.length();
        close(a.points[0], b.points[1]) && close(a.points[1], b.points[0])
    };
    edges[0].len() == edges[1].len() && edges[0].iter().all(|a| edges[1].iter().any(|b| near(a, b)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::{GapChoice, Law, Quadrature, Stabilise};
    use crate::mesh::samples::two_blocks;
    use crate::mesh::{Level, Partition};
    use std::rc::Rc;

    fn pair(segments: SegmentRule) -> Pair {
        Pair {
            name: "seam".into(),
            between: ["lower.seam".into(), "upper.seam".into()],
            curve: CurveChoice::Line,
            gap: GapChoice::Closed,
            space: MultiplierSpace::P0,
            segments,
            law: Law::Unilateral,
            quadrature: Quadrature::Cut,
            stabilise: Stabilise::Off,
        }
    }

    fn cover(mesh: &MacroMesh, curve: Curve) -> Result<(), String> {
        let sides = ["lower.seam", "upper.seam"].map(|name| mesh.boundary(name).expect("named").edges.as_slice());
        let range = curve.range();
        check_cover(mesh, &pair(SegmentRule::Auto), sides, &ContactBoundary::new(curve, range, Point::new(0.0, 1.0)))
    }

    #[test]
    fn holes_at_any_place_are_refused() {
        let mut mesh = two_blocks();
        assert_eq!(cover(&mesh, Curve::Line([[0.0, 1.0], [2.0, 1.0]])), Ok(()));
        for line in [[[-1.0, 1.0], [2.0, 1.0]], [[0.0, 1.0], [3.0, 1.0]]] {
            assert!(cover(&mesh, Curve::Line(line)).unwrap_err().contains("has a hole between"));
        }
        mesh.boundaries.iter_mut().filter(|b| b.name == "upper.seam").for_each(|b| b.edges.truncate(1));
        assert!(cover(&mesh, Curve::Line([[0.0, 1.0], [2.0, 1.0]])).unwrap_err().contains("\"upper.seam\" has a hole"));
    }

    #[test]
    fn automatic_segments_follow_the_longest_edge() {
        let mesh = two_blocks();
        let partition = Rc::new(Partition::new(&mesh, &vec![0; mesh.triangles.len()], 1));
        let numbering = Numbering::new(Level { intervals: 8, order: Order::P1 }, &partition);
        let boundary = place(&mesh, &numbering, &pair(SegmentRule::Auto), [1.0, 1.0]).expect("a flat seam");
        // Longest edge 2/8, 1.5 of them on a length of 2.
        assert_eq!(boundary.segments(), 5);
        // A stiff lower body leaves the rule to the upper one: longest edge 1.1/8.
        assert_eq!(place(&mesh, &numbering, &pair(SegmentRule::Auto), [10.0, 1.0]).expect("a flat seam").segments(), 9);
        assert!(boundary.normal(0.5).y > 0.0);
    }

    #[test]
    fn boundaries_that_do_not_face_each_other_are_refused() {
        let mut mesh = two_blocks();
        let upper: Vec<u32> = mesh.triangles.iter().filter(|t| t.body == 1).flat_map(|t| t.vertices).collect();
        let moved: std::collections::BTreeSet<u32> = upper.into_iter().collect();
        moved.into_iter().for_each(|vertex| mesh.vertices[vertex as usize].x += 5.0);
        let partition = Rc::new(Partition::new(&mesh, &vec![0; mesh.triangles.len()], 1));
        let numbering = Numbering::new(Level { intervals: 2, order: Order::P1 }, &partition);
        let words = place(&mesh, &numbering, &pair(SegmentRule::Count(3)), [1.0, 1.0]).unwrap_err().to_string();
        assert!(words.starts_with("contact.seam: ") && words.contains("do not face each other"), "{words}");
    }
}
