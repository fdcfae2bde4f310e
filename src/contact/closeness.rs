//! Boundaries of different bodies that lie close and face each other: contacts that a case may mean.

use crate::geometry::Point;
use crate::mesh::{Boundary, MacroMesh};

/// Parts of an edge at whose ends places are looked at, and places on a boundary at most.
const PLACES: usize = 4;
const MOST_PLACES: usize = 1500;

/// Cosine of the angle between two outward normals that face each other, at most (120 degrees).
const OPPOSITE: f64 = -0.5;

/// Boundaries nearer than this share of the smaller body are close.
const CLOSE: f64 = 0.1;

/// Boundaries of a body that is close to none may be this share of the smaller body apart.
const APART: f64 = 0.5;

/// A further pair of two bodies is as near as this share of the smaller one.
const TOUCHING: f64 = 0.02;

/// Two named boundaries that may come in contact.
#[derive(Clone, Debug, PartialEq)]
pub struct ClosePair {
    /// Names of the boundaries; the one on the first body of the mesh comes first.
    pub between: [String; 2],
    /// Indices of their bodies.
    pub bodies: [usize; 2],
    /// Least distance at which they face each other (length); negative where they overlap.
    pub distance: f64,
    /// The same as a share of the smaller body.
    pub share: f64,
    /// Length of both boundaries.
    length: f64,
}

/// A place of a boundary: where it is, its outward normal, and how far the next place is.
#[derive(Clone, Copy)]
struct Sight {
    place: Point,
    normal: Point,
    spacing: f64,
    /// Whether it is an end of an edge, where boundaries that look elsewhere may meet.
    is_end: bool,
}

/// A boundary that lies on one body.
struct NamedSide<'a> {
    boundary: &'a Boundary,
    body: usize,
    length: f64,
    sights: Vec<Sight>,
}

impl<'a> NamedSide<'a> {
    fn new(mesh: &MacroMesh, boundary: &'a Boundary) -> Option<Self> {
        let body = mesh.body_beside(*boundary.edges.first()?);
        if boundary.is_union || boundary.edges.iter().any(|&edge| mesh.body_beside(edge) != body) {
            return None;
        }
        let step = (PLACES * boundary.edges.len()).div_ceil(MOST_PLACES);
        let on_edge = |&edge: &u32| {
            let spacing = step as f64 * mesh.edge_length(edge) / PLACES as f64;
            (0..=PLACES).map(move |k| {
                let t = k as f64 / PLACES as f64;
                let is_end = k == 0 || k == PLACES;
                Sight { place: mesh.edge_position(edge, t), normal: mesh.edge_normal(edge, t), spacing, is_end }
            })
        };
        let length = boundary.edges.iter().map(|&edge| mesh.edge_length(edge)).sum();
        Some(Self { boundary, body, length, sights: boundary.edges.iter().step_by(step).flat_map(on_edge).collect() })
    }

    /// Least distance along a normal at which another side is faced within `reach`, over a length.
    fn distance(&self, other: &Self, reach: f64) -> Option<f64> {
        let (mut least, mut is_faced) = (None::<f64>, false);
        for a in &self.sights {
            for b in other.sights.iter().filter(|b| a.normal.dot(&b.normal) < OPPOSITE) {
                let way = b.place - a.place;
                let along = way.dot(&a.normal);
                let aside = (way - along * a.normal).norm();
                // What lies behind is an overlap only if it is small.
                let near = (-CLOSE * reach..=reach).contains(&along) && aside <= 0.5 * along.abs() + a.spacing + b.spacing;
                is_faced |= near && !a.is_end && !b.is_end;
                if near && least.is_none_or(|least| along.abs() < least.abs()) {
                    least = Some(along);
                }
            }
        }
        least.filter(|_| is_faced)
    }
}

/// Pairs of named boundaries of different bodies that lie close and face each other, the nearest first. Of two bodies one pair
/// is enough, unless others touch too; a body that is close to none has its nearest pair.
pub fn close_pairs(mesh: &MacroMesh) -> Vec<ClosePair> {
    let sides: Vec<NamedSide> = mesh.boundaries.iter().filter_map(|boundary| NamedSide::new(mesh, boundary)).collect();
    let sizes = body_sizes(mesh);
    let mut candidates = Vec::new();
    for (k, first) in sides.iter().enumerate() {
        for second in sides[k + 1..].iter().filter(|second| second.body != first.body) {
            let (first, second) = if first.body < second.body { (first, second) } else { (second, first) };
            let size = sizes[first.body].min(sizes[second.body]);
            let Some(distance) = first.distance(second, APART * size) else { continue };
            candidates.push(ClosePair {
                between: [first, second].map(|side| side.boundary.name.clone()),
                bodies: [first.body, second.body],
                distance: if distance.abs() < 1e-9 * size { 0.0 } else { distance },
                share: distance.abs() / size,
                length: first.length + second.length,
            });
        }
    }
    // Of two names for the same place the one of the shorter boundary says more.
    let order = |pair: &ClosePair| ((1e3 * pair.share).round(), pair.length);
    candidates.sort_by(|a, b| order(a).partial_cmp(&order(b)).unwrap_or(std::cmp::Ordering::Equal));
    let mut chosen: Vec<ClosePair> = Vec::new();
    for pair in candidates {
        let is_lone = |body: usize| !chosen.iter().any(|other| other.bodies.contains(&body));
        let alike: Vec<&ClosePair> = chosen.iter().filter(|other| other.bodies == pair.bodies).collect();
        let is_meant = match alike.is_empty() {
            true => pair.share <= CLOSE || is_lone(pair.bodies[0]) || is_lone(pair.bodies[1]),
            false => pair.share <= TOUCHING && !alike.iter().any(|other| shares_edges(mesh, other, &pair)),
        };
        if is_meant {
            chosen.push(pair);
        }
    }
    chosen
}

/// Whether two pairs have an edge in common.
fn shares_edges(mesh: &MacroMesh, one: &ClosePair, other: &ClosePair) -> bool {
    let edges = |name: &String| mesh.boundary(name).map(|boundary| boundary.edges.as_slice()).unwrap_or_default();
    let both = |k: usize| {
        let own = edges(&other.between[k]);
        edges(&one.between[k]).iter().any(|edge| own.contains(edge))
    };
    both(0) || both(1)
}

/// Diagonal of the box around each body.
fn body_sizes(mesh: &MacroMesh) -> Vec<f64> {
    let mut boxes = vec![[Point::repeat(f64::INFINITY), Point::repeat(f64::NEG_INFINITY)]; mesh.bodies.len()];
    for (piece, [low, high]) in mesh.pieces.iter().zip(mesh.bounds()) {
        let [least, most] = &mut boxes[piece.body];
        (*least, *most) = (least.inf(&low), most.sup(&high));
    }
    boxes.iter().map(|[low, high]| (high - low).norm()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::samples::two_blocks;

    /// The two blocks, the upper one moved.
    fn moved(by: Point) -> MacroMesh {
        let mut mesh = two_blocks();
        let upper: std::collections::BTreeSet<u32> =
            mesh.triangles.iter().filter(|t| mesh.bodies[t.body as usize] == "upper").flat_map(|t| t.vertices).collect();
        upper.into_iter().for_each(|vertex| mesh.vertices[vertex as usize] += by);
        mesh
    }

    #[test]
    fn the_seam_of_two_blocks_is_found_wherever_they_lie() {
        for (by, distance) in [([0.0, 0.0], 0.0), ([0.3, 0.1], 0.1), ([0.0, 0.9], 0.9), ([0.0, -0.05], -0.05)] {
            let pairs = close_pairs(&moved(by.into()));
            let [pair] = &pairs[..] else { panic!("{pairs:?}") };
            assert_eq!(pair.between, ["lower.seam", "upper.seam"]);
            assert!((pair.distance - distance).abs() < 1e-12, "{pair:?}");
        }
    }

    #[test]
    fn what_lies_far_or_turns_its_back_is_none() {
        for by in [[0.0, 3.0], [9.0, 0.0], [0.0, -4.0]] {
            assert_eq!(close_pairs(&moved(by.into())), [], "{by:?}");
        }
    }
}
