//! The two boundaries of a contact as they are drawn, seen along the normals of Γ_C.

use crate::contact::contact_boundary::ContactBoundary;
use crate::contact::pair::Pair;
use crate::contact::placing::{all_edges, faces};
use crate::contact::side::Side;
use crate::geometry::Point;
use crate::mesh::{BoundaryEdge, EdgeNode, MacroMesh, Numbering, SmoothNormals, each_once};

/// Places along Γ_C that are looked at, at most.
pub const PLACES: usize = 64;

/// The boundaries of one contact as they are drawn, seen along the normals of Γ_C.
pub struct Facing<'a> {
    pub(crate) pair: &'a Pair,
    pub(crate) boundary: &'a ContactBoundary,
    /// For each body its edges that see Γ_C.
    pub(crate) seen: [Vec<Seen>; 2],
}

/// An edge that sees a part of Γ_C.
pub struct Seen {
    pub(crate) edge: BoundaryEdge,
    /// Parameters of Γ_C at its ends, lower first, and its ends in that order.
    pub(crate) feet: [f64; 2],
    ends: [Point; 2],
    /// Whether its outward normal points at the other body.
    pub(crate) faces: bool,
}

impl Seen {
    /// What other contacts know the edge by.
    pub(crate) fn key(&self) -> [EdgeNode; 2] {
        [self.edge.nodes[0], self.edge.nodes[1]]
    }
}

/// What stands across Γ_C at one of its points.
pub enum Across {
    /// Both bodies look at it.
    Facing(Opposite),
    /// One of them has its back to it only.
    Back(Side),
    /// One of them has nothing there.
    Nothing,
}

/// Points of both drawn boundaries across one place of Γ_C.
#[derive(Clone, Copy)]
pub struct Opposite {
    /// Parameter of the place.
    pub parameter: f64,
    /// The points of body 1 and of body 2.
    pub points: [Point; 2],
    /// Distance of body 2 from body 1 along the normal (length); negative where they lie behind each other.
    pub gap: f64,
}

impl<'a> Facing<'a> {
    /// Looks at the undeformed boundaries of a pair on the level that is numbered.
    pub fn new(mesh: &MacroMesh, numbering: &Numbering, pair: &'a Pair, boundary: &'a ContactBoundary) -> Self {
        let [of_first, of_second] = all_edges(mesh, numbering, pair, &|_| Point::zeros());
        let seen = [(Side::First, of_first), (Side::Second, of_second)].map(|(side, edges)| {
            let see = |edge: BoundaryEdge| {
                let corners = [edge.points[0], edge.points[1]];
                let parts: Vec<[f64; 2]> = boundary.parts(corners).collect();
                if parts.is_empty() {
                    return Vec::new();
                }
                let [from, to] = boundary.directed_feet(corners);
                let ends = if from <= to { corners } else { [corners[1], corners[0]] };
                let faces = faces(boundary, side, &edge);
                parts.into_iter().map(|feet| Seen { edge: edge.clone(), feet, ends, faces }).collect()
            };
            edges.into_iter().flat_map(see).collect()
        });
        Self { pair, boundary, seen }
    }

    /// Parameters between the ends of Γ_C, evenly.
    pub(crate) fn places(&self) -> impl Iterator<Item = f64> {
        let [first, last] = self.boundary.ends();
        (0..PLACES).map(move |k| first + (last - first) * (k as f64 + 0.5) / PLACES as f64)
    }

    /// What stands across Γ_C at parameter `t`: of each body the point nearest to it.
    pub(crate) fn across(&self, t: f64) -> Across {
        let x = self.boundary.point(t);
        let mut points = [x; 2];
        for (k, side) in [Side::First, Side::Second].into_iter().enumerate() {
            let there = self.seen[k].iter().filter(|seen| seen.feet[0] <= t && t <= seen.feet[1]);
            let (front, back): (Vec<&Seen>, Vec<&Seen>) = there.partition(|seen| seen.faces);
            let place = |seen: &&Seen| {
                let share = (t - seen.feet[0]) / (seen.feet[1] - seen.feet[0]).max(f64::MIN_POSITIVE);
                seen.ends[0] + share * (seen.ends[1] - seen.ends[0])
            };
            let nearest = front.iter().map(place).min_by(|a, b| (a - x).norm().total_cmp(&(b - x).norm()));
            match nearest {
                Some(point) => points[k] = point,
                None if back.is_empty() => return Across::Nothing,
                None => return Across::Back(side),
            }
        }
        Across::Facing(Opposite { parameter: t, points, gap: (points[1] - points[0]).dot(&self.boundary.normal(t)) })
    }

    /// Length of the longest macro edge of both boundaries.
    pub(crate) fn longest_edge(&self, mesh: &MacroMesh) -> f64 {
        let edges = self.seen.iter().flatten().map(|seen| seen.edge.nodes[0].edge);
        edges.map(|edge| mesh.edge_length(edge)).fold(0.0, f64::max)
    }
}

/// How far chords of one boundary lie from their arcs at most (length): declared ones from the small edges, others from those of the
/// mesh file.
pub fn largest_sagitta(mesh: &MacroMesh, seen: &[Seen]) -> f64 {
    let edges = each_once(seen.iter().map(|seen| seen.edge.nodes[0].edge));
    let normals = SmoothNormals::new(mesh, &edges);
    let small = |edge: u32| seen.iter().filter(|seen| seen.edge.nodes[0].edge == edge).count().max(1) as f64;
    let sagitta = |&edge: &u32| {
        let [a, b] = mesh.edge_ends(edge);
        let height = (normals.at(mesh, edge, 0.5).place - 0.5 * (a + b)).norm();
        if mesh.edges[edge as usize].shape.is_some() { height / small(edge).powi(2) } else { height }
    };
    edges.iter().map(sagitta).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::samples::{moved_blocks, seam};
    use crate::geometry::Curve;

    /// Places lie evenly within the part that Γ_C is; across each are a point of the flat side and one of the rising side over it.
    #[test]
    fn points_across_lie_on_the_normal_line_of_their_place() {
        let (mesh, numbering) = moved_blocks(|x| Point::new(0.0, 0.1 * x.x));
        let pair = seam();
        let curve = Curve::Line([[0.0, 1.0], [2.0, 1.0]]);
        let boundary = ContactBoundary::new(curve, [0.25, 0.35], Point::new(0.0, 1.0));
        let facing = Facing::new(&mesh, &numbering, &pair, &boundary);
        let places: Vec<f64> = facing.places().collect();
        let (step, count) = (0.1 / PLACES as f64, PLACES as f64);
        assert!((places[0] - 0.25 - 0.5 * step).abs() < 1e-12 && (places.iter().sum::<f64>() / count - 0.3).abs() < 1e-12);
        assert!(places.windows(2).all(|two| (two[1] - two[0] - step).abs() < 1e-12));
        for t in places {
            let Across::Facing(Opposite { points: [below, above], .. }) = facing.across(t) else {
                panic!("both are there at {t}")
            };
            let (x, y) = (2.0 * t, 1.0 + 0.2 * t);
            assert!((below - Point::new(x, 1.0)).norm() < 1e-12 && (above - Point::new(x, y)).norm() < 1e-12, "{t}: {above}");
        }
        assert!(matches!(facing.across(-0.1), Across::Nothing) && matches!(facing.across(1.1), Across::Nothing));
    }
}
