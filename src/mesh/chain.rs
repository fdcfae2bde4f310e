//! Boundaries as chains of vertices, split at corners.

use super::macro_mesh::MacroMesh;
use crate::geometry::{Curve, Point, Spline, chord_lengths, cross};
use std::collections::HashMap;
use std::sync::Arc;

/// A boundary that turns by more than this at a vertex (radians, 20 degrees) has a corner there.
const CORNER: f64 = 20.0 * std::f64::consts::PI / 180.0;

/// Neighbouring edges that turn by less (radians, 55 degrees) may be chords of an arc: a circle of seven turns by 51, a hexagon by 60.
pub const WIDEST_CHORD: f64 = 55.0 * std::f64::consts::PI / 180.0;

/// Neighbouring chords of an arc differ in length by this factor at most.
const ALIKE: f64 = 2.0;

/// A part of a boundary without corners and gaps.
#[derive(Clone, Debug)]
pub struct Stretch {
    /// Edges of the stretch in the order and direction of the boundary, with the body on the left.
    pub edges: Vec<u32>,
    /// Smooth shape of the stretch: the declared geometry where the edges have one, a straight line where they lie on one,
    /// otherwise the spline through their vertices. Never the polygon: its error would enter the gap.
    pub curve: Curve,
}

impl MacroMesh {
    /// The smooth stretches of a set of boundary edges.
    pub fn stretches(&self, edges: &[u32]) -> Vec<Stretch> {
        let stretch = |edges: Vec<u32>| Stretch { curve: self.smooth_curve(&edges), edges };
        self.chains(edges).into_iter().map(stretch).collect()
    }

    /// Smooth shapes of a set of boundary edges, one for each stretch.
    pub fn smooth_curves(&self, edges: &[u32]) -> Vec<Curve> {
        self.stretches(edges).into_iter().map(|stretch| stretch.curve).collect()
    }

    fn smooth_curve(&self, chain: &[u32]) -> Curve {
        if let Some(shape) = &self.edges[chain[0] as usize].shape {
            return (*shape.curve).clone();
        }
        let points = self.chain_points(chain);
        let (first, last) = (points[0], points[points.len() - 1]);
        let straight =
            first != last && points.iter().all(|x| cross(last - first, x - first).abs() <= 1e-12 * (last - first).norm_squared());
        match straight {
            true => Curve::Line([first.into(), last.into()]),
            false => Curve::Spline(Spline::through(chord_lengths(&points), &points, self.is_closed(chain))),
        }
    }

    /// Whether a chain of edges comes back to where it begins, and goes on there without a corner.
    pub fn is_closed(&self, chain: &[u32]) -> bool {
        let [first, last] = [chain[0], chain[chain.len() - 1]];
        chain.len() > 2 && self.directed(first)[0] == self.directed(last)[1] && self.goes_on(last, first)
    }

    /// Edges in the order and direction of the boundary (body on the left), cut at corners and gaps, and where the
    /// shape changes.
    pub(super) fn chains(&self, edges: &[u32]) -> Vec<Vec<u32>> {
        let ends: Vec<[u32; 2]> = edges.iter().map(|&edge| self.directed(edge)).collect();
        let rows = rows(&ends, |a, b| edges[a] != edges[b] && self.goes_on(edges[a], edges[b]));
        rows.into_iter().map(|row| row.into_iter().map(|at| edges[at]).collect()).collect()
    }

    /// Whether a boundary edge goes on as another that begins at its end: without a corner, in the same shape.
    pub(super) fn goes_on(&self, edge: u32, other: u32) -> bool {
        let along = |edge: u32| {
            let [a, b] = self.directed(edge).map(|vertex| self.vertices[vertex as usize]);
            (b - a).normalize()
        };
        match (&self.edges[edge as usize].shape, &self.edges[other as usize].shape) {
            (None, None) => along(edge).dot(&along(other)) > CORNER.cos(),
            (Some(a), Some(b)) => Arc::ptr_eq(&a.curve, &b.curve) || a.curve == b.curve,
            _ => false,
        }
    }

    /// The largest turn (radians) at a corner between two straight edges of a boundary, each a smooth stretch of its own, that may be
    /// chords of a coarsely drawn arc: of like length, and with a turn of less than 55 degrees. Nothing if there is none.
    pub fn turn_of_chords(&self, edges: &[u32]) -> Option<f64> {
        let chains = self.chains(edges);
        let single = chains.iter().filter(|chain| chain.len() == 1).map(|chain| chain[0]);
        let single: Vec<u32> = single.filter(|&edge| self.edges[edge as usize].shape.is_none()).collect();
        let starts: HashMap<u32, u32> = single.iter().map(|&edge| (self.directed(edge)[0], edge)).collect();
        let along = |edge: u32| {
            let points = self.chain_points(&[edge]);
            points[1] - points[0]
        };
        let turn = |&edge: &u32| {
            let [one, next] = [along(edge), along(*starts.get(&self.directed(edge)[1])?)];
            let ratio = one.norm() / next.norm();
            Some(one.angle(&next)).filter(|turn| *turn < WIDEST_CHORD && ratio < ALIKE && ratio > 1.0 / ALIKE)
        };
        single.iter().filter_map(turn).reduce(f64::max)
    }

    /// Vertices of a chain of edges.
    pub(super) fn chain_points(&self, chain: &[u32]) -> Vec<Point> {
        let corner = |edge: u32, end: usize| self.vertices[self.directed(edge)[end] as usize];
        let mut points: Vec<Point> = chain.iter().map(|&edge| corner(edge, 0)).collect();
        points.push(corner(chain[chain.len() - 1], 1));
        points
    }
}

/// Places of directed edges in rows in which each begins where the one before it ends and `goes_on` as it; of several the first
/// one goes on. An open row begins at its first edge, a closed one at the first that is listed.
fn rows(ends: &[[u32; 2]], mut goes_on: impl FnMut(usize, usize) -> bool) -> Vec<Vec<usize>> {
    let mut starts: Vec<(u32, usize)> = ends.iter().map(|ends| ends[0]).zip(0..).collect();
    starts.sort_unstable();
    let mut follows = vec![false; ends.len()];
    let mut next = vec![None; ends.len()];
    for (here, [_, end]) in ends.iter().enumerate() {
        let behind = starts[starts.partition_point(|(start, _)| start < end)..].iter().take_while(|(start, _)| start == end);
        for &(_, other) in behind {
            if goes_on(here, other) {
                follows[other] = true;
                next[here] = next[here].or(Some(other));
            }
        }
    }
    let mut is_left = vec![true; ends.len()];
    let mut rows = Vec::new();
    for first in (0..ends.len()).filter(|&at| !follows[at]).chain(0..ends.len()) {
        let row: Vec<usize> =
            std::iter::successors(Some(first), |&at| next[at]).take_while(|&at| std::mem::take(&mut is_left[at])).collect();
        rows.extend(Some(row).filter(|row| !row.is_empty()));
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::super::samples::{fan, two_blocks};
    use super::*;

    #[test]
    fn chords_of_a_coarse_arc_are_told_from_smooth_sides_and_polygons() {
        let turn = |sides: usize| {
            let mesh = fan(sides);
            mesh.turn_of_chords(mesh.edges_of("rim")).map(|turn| turn.to_degrees().round())
        };
        assert_eq!([40, 19, 16, 8, 7, 6, 4].map(turn), [None, None, Some(23.0), Some(45.0), Some(51.0), None, None]);
        let mesh = two_blocks();
        assert_eq!(mesh.turn_of_chords(mesh.edges_of("upper.seam")), None);
    }

    #[test]
    fn looks_at_pairs_of_edges_grow_as_their_number() {
        let looks = |count: usize| {
            let ends: Vec<[u32; 2]> = (0..count).map(|k| [k as u32, (k + 1) as u32 % count as u32]).collect();
            let mut looks = 0;
            let rows = rows(&ends, |_, _| {
                looks += 1;
                true
            });
            assert_eq!((rows.len(), rows[0].len()), (1, count), "closed");
            looks
        };
        assert_eq!([looks(1000), looks(4000)], [1000, 4000]);
    }

    #[test]
    fn a_straight_boundary_of_many_edges_is_one_line() {
        let mesh = two_blocks();
        let curves = mesh.smooth_curves(&mesh.boundary("upper.seam").expect("named").edges);
        assert_eq!(curves.len(), 1);
        assert!(curves[0].is_line());
    }

    #[test]
    fn corners_and_shapes_split_a_boundary() {
        let mut mesh = two_blocks();
        let mut edges = mesh.boundary("upper.seam").expect("named").edges.clone();
        edges.extend(&mesh.boundary("top").expect("named").edges);
        assert_eq!(mesh.smooth_curves(&edges).len(), 2, "seam and top have no end in common");
        mesh.vertices.iter_mut().filter(|x| x.x == 0.9 && x.y == 1.0).for_each(|x| x.y = 1.3);
        let seam = mesh.boundary("upper.seam").expect("named").edges.clone();
        assert_eq!(mesh.smooth_curves(&seam).len(), 2, "a kink of more than 20 degrees");
        mesh.vertices.iter_mut().filter(|x| x.x == 0.9 && x.y == 1.3).for_each(|x| x.y = 1.1);
        let [Curve::Spline(spline)] = &mesh.smooth_curves(&seam)[..] else { panic!("one spline") };
        assert!((spline.point(spline.range()[0]) - Point::new(0.0, 1.0)).norm() < 1e-14);
    }
}
