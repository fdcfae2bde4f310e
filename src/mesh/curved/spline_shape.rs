//! Boundaries of which nobody has declared the shape, bent onto the splines through the nodes of the mesh file.
//!
//! Contact takes such a boundary for smooth: its normals and gaps are those of the spline. Chords that are only refined would
//! keep the corners between them, and the pressure would jump at each of them.
//!
//! Measured on two quarter rings (radii 1, 2 and 3; n against n + 1 chords; drawn as touching, `gap = -0.01`; P2 with
//! `p1-discontinuous`), the largest error of λ in the middle 60 % at `refine` 1, 2 and 3. What is left at n = 8 is the polygon
//! of bore and rim, which are not in contact. With `gap = "geometry"`, on rings that overlap by 0.01, the gap between the
//! splines of 8 and 9 chords is itself off: λ by 1.7 % in the mean square, with 12 chords by 0.6 %.
//!
//! | n | chords as they are | bent | declared circle |
//! |---|---|---|---|
//! | 8 | 9.5 %, 11 %, 14 % | 0.3 %, 0.3 %, 0.2 % | |
//! | 12 | 7.0 %, 8.8 %, 12 % | 0.2 %, 0.1 %, 0.1 % | 0.2 % (`refine = 1`) |
//! | 18 | 5.3 %, 6.6 %, 7.9 % | 0.1 %, 0.1 %, 0.1 % | |

use crate::geometry::{Curve, Point};
use crate::mesh::curve_piece::CurvePiece;
use crate::mesh::macro_mesh::MacroMesh;
use std::sync::Arc;

/// A corner that is so many times sharper than those beside it is no part of an arc: it is meant as it is drawn.
const SHARPER: f64 = 4.0;

/// Corners below this share of the sharpest one are none.
const FAINT: f64 = 0.1;

/// A line that turns by less (radians) is one whose points are rounded.
const ROUNDED: f64 = 1e-5;

impl CurvePiece {
    /// Whether it is a spline through nodes, which nobody has declared.
    pub fn is_spline(&self) -> bool {
        matches!(*self.curve, Curve::Spline(_))
    }
}

impl MacroMesh {
    /// Bends the edges of these boundaries, where they are curved and have no declared shape, onto the splines through their
    /// vertices, one for each stretch without corners. Straight pieces with a corner between them stay as they are.
    pub fn bend_onto_splines(&mut self, boundaries: &[&String]) {
        let edges_of = |name: &&String| self.boundary(name).map(|found| found.edges.clone());
        let mut all: Vec<Vec<u32>> = boundaries.iter().filter_map(edges_of).collect();
        // A part of another boundary keeps to the shape of the whole.
        all.sort_by_key(|edges| std::cmp::Reverse(edges.len()));
        for stretch in all.iter().flat_map(|edges| self.stretches(edges)).collect::<Vec<_>>() {
            let bare = stretch.edges.iter().all(|&edge| self.edges[edge as usize].shape.is_none());
            let Curve::Spline(spline) = &stretch.curve else { continue };
            let is_closed = self.is_closed(&stretch.edges);
            if !bare || !is_arc(&self.points_with_turns(&stretch.edges), is_closed) {
                continue;
            }
            let curve = Arc::new(stretch.curve.clone());
            for (&edge, ends) in stretch.edges.iter().zip(spline.knots().windows(2)) {
                let directed = self.directed(edge);
                self.edges[edge as usize].bend(directed, curve.clone(), [ends[0], ends[1]]);
            }
        }
    }

    /// The corners within the smooth stretches of a boundary that is not bent: all of its chords have them.
    pub fn corners_left(&self, boundary: &str) -> Vec<Corner> {
        let chains = self.chains(self.edges_of(boundary)).into_iter();
        let unbent = chains.filter(|chain| self.edges[chain[0] as usize].shape.is_none());
        let corner = |three: &[Point]| Corner { place: three[1], angle: turn(three) };
        let all = unbent.flat_map(|chain| self.points_with_turns(&chain).windows(3).map(corner).collect::<Vec<_>>());
        all.filter(|corner| corner.angle > ROUNDED).collect()
    }

    /// Vertices of a chain of edges, of a closed one with the second again behind the last, so that all of its turns are between
    /// three of them.
    fn points_with_turns(&self, chain: &[u32]) -> Vec<Point> {
        let mut points = self.chain_points(chain);
        if self.is_closed(chain) {
            points.push(points[1]);
        }
        points
    }

    /// How far the farthest chord of a boundary lies from the spline that it is bent onto (length); 0 if none is.
    pub fn bent_by(&self, boundary: &str) -> f64 {
        let edges = self.edges_of(boundary);
        let bent = |edge: &&u32| self.edges[**edge as usize].shape.as_ref().is_some_and(|shape| shape.is_spline());
        let height = |&edge: &u32| {
            let [a, b] = self.edge_ends(edge);
            (self.edge_position(edge, 0.5) - 0.5 * (a + b)).norm()
        };
        edges.iter().filter(bent).map(height).fold(0.0, f64::max)
    }
}

/// A corner between two edges.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner {
    /// Where it is.
    pub place: Point,
    /// By how much the boundary turns there (radians).
    pub angle: f64,
}

/// Whether a chain of points lies on an arc: it turns, and nowhere is a corner between pieces that are straight beside it. In a
/// closed chain the last turn comes before the first.
fn is_arc(points: &[Point], closed: bool) -> bool {
    let turns: Vec<f64> = points.windows(3).map(turn).collect();
    let largest = turns.iter().copied().fold(0.0, f64::max);
    let beside = |k: usize| {
        let outside = |turn: Option<&f64>| if closed { turn.copied() } else { None }.unwrap_or(0.0);
        let before = if k == 0 { outside(turns.last()) } else { turns[k - 1] };
        before.max(turns.get(k + 1).copied().unwrap_or_else(|| outside(turns.first())))
    };
    let sharp = |k: usize| turns.len() > 1 && turns[k] > FAINT * largest && turns[k] > SHARPER * beside(k);
    largest > ROUNDED && !(0..turns.len()).any(sharp)
}

/// By how much the way through three points turns at the second (radians).
fn turn(three: &[Point]) -> f64 {
    (three[1] - three[0]).angle(&(three[2] - three[1]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::samples::two_blocks;

    /// Two blocks whose seam is lifted by a function of x.
    fn lifted(by: impl Fn(f64) -> f64) -> MacroMesh {
        let mut mesh = two_blocks();
        mesh.vertices.iter_mut().filter(|x| x.y == 1.0).for_each(|x| x.y += by(x.x));
        mesh
    }

    #[test]
    fn an_arc_of_chords_is_bent_and_what_is_straight_is_not() {
        let name = "upper.seam".to_string();
        let mut mesh = lifted(|x| 0.05 * x * (2.0 - x));
        assert_eq!(mesh.bent_by(&name), 0.0);
        mesh.bend_onto_splines(&[&name, &name]);
        let edges = mesh.boundary(&name).expect("named").edges.clone();
        for &edge in &edges {
            let [a, b] = mesh.edge_ends(edge);
            assert!(
                (mesh.edge_position(edge, 1e-9) - a).norm() < 1e-8 && (mesh.edge_position(edge, 1.0 - 1e-9) - b).norm() < 1e-8
            );
        }
        assert!((mesh.bent_by(&name) / (0.05 * 1.1f64.powi(2) / 4.0) - 1.0).abs() < 0.02, "{}", mesh.bent_by(&name));
        assert_eq!(mesh.stretches(&edges).len(), 1);
        let mut flat = two_blocks();
        flat.bend_onto_splines(&[&name]);
        assert!(flat.edges.iter().all(|edge| edge.shape.is_none()));
    }

    /// Of a closed chain the last turn and the first are neighbours.
    #[test]
    fn a_closed_arc_has_no_ends() {
        let points: Vec<Point> = (0..22).map(|k| 0.3 * f64::from(k)).map(|a| Point::new(a.cos(), a.sin())).collect();
        assert!(is_arc(&points, true));
        // It turns at its end and at its beginning, which is a corner only if these are not neighbours.
        let turns = [0.1, 0.0, 0.0, 0.0, 0.0, 0.0, 0.3];
        let (mut angle, mut x) = (0.0f64, Point::zeros());
        let mut open = vec![x];
        for turn in turns.into_iter().chain([0.0]) {
            x += Point::new(angle.cos(), angle.sin());
            open.push(x);
            angle += turn;
        }
        assert!(is_arc(&open, true) && !is_arc(&open, false));
    }

    #[test]
    fn a_corner_between_straight_pieces_is_one() {
        let points = |turns: &[f64]| {
            let (mut angle, mut x) = (0.0f64, Point::zeros());
            let mut all = vec![x];
            for turn in turns.iter().copied().chain([0.0]) {
                x += Point::new(angle.cos(), angle.sin());
                all.push(x);
                angle += turn;
            }
            all
        };
        for (turns, arc) in [
            (vec![0.1; 6], true),
            (vec![0.0, 0.1, 0.2, 0.2, 0.1, 0.0], true),
            (vec![0.2, 0.1, 0.0, -0.1, -0.2], true),
            (vec![0.2], true),
            (vec![1e-16, 0.0, 0.1, 0.2, 0.2], true),
            (vec![1e-7, -1e-7, 1e-7], false),
            (vec![0.0, 0.0, 0.2, 0.0], false),
            (vec![0.05, 0.05, 0.3, 0.05], false),
            (vec![0.2, 0.0, 0.0], false),
        ] {
            assert_eq!(is_arc(&points(&turns), false), arc, "{turns:?}");
        }
    }
}
