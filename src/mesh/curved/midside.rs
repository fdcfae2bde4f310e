//! Curved sides of second-order elements: curves through the nodes of the mesh file.
//!
//! A boundary side, or one between two parts, whose midside node lies off its chord is an arc of a curve that the mesher knew.
//! Neighbours that go on smoothly are one curve: the circle through their nodes where they lie on one, otherwise the spline
//! through all of them. So refinement follows the body as it was drawn, and not the parabolas of the elements.

use crate::geometry::{Coordinates, Curve, Point, Spline, chord_lengths};
use crate::mesh::MeshError;
use crate::mesh::curved::bow::{Bow, FLAT, go_on, is_inflection, on_one_circle};
use crate::mesh::macro_mesh::MacroMesh;
use nalgebra::{Matrix3, Vector3};
use std::collections::{BTreeMap, HashMap, HashSet};
use std::sync::Arc;

/// Highest arc over a side as a share of the chord; a half circle has 0.5.
const HIGHEST: f64 = 0.45;

/// A midside node stands over this part of its side, on either side of the middle: nodes at a quarter are for tips of cracks.
const MIDDLE: f64 = 0.24;

impl MacroMesh {
    /// Bends sides with a midside node off the chord onto curves through the nodes; `midsides` come with the vertices at the ends
    /// of their sides, lower first. Sides inside a part stay straight.
    ///
    /// # Errors
    /// [`MeshError::Unusable`] for a midside node that no smooth curve over its side can have.
    pub(crate) fn bend_through_midsides(&mut self, midsides: Vec<([u32; 2], Point)>) -> Result<(), MeshError> {
        let outer: Vec<u32> =
            (0..self.edges.len() as u32).filter(|&edge| self.is_outer(edge) || self.is_interface(edge)).collect();
        let key = |edge: u32| {
            let [a, b] = self.edges[edge as usize].vertices;
            [a.min(b), a.max(b)]
        };
        let keys: HashSet<[u32; 2]> = outer.iter().map(|&edge| key(edge)).collect();
        let midsides: HashMap<[u32; 2], Point> = midsides.into_iter().filter(|(ends, _)| keys.contains(ends)).collect();
        let mut bows: [Vec<Bow>; 2] = Default::default();
        for edge in outer {
            if let Some(&middle) = midsides.get(&key(edge)) {
                bows[usize::from(!self.is_outer(edge))].push(self.bow(edge, self.directed(edge), middle)?);
            }
        }
        self.has_midsides = bows.iter().flatten().any(|bow| !bow.is_flat());
        // Sides between parts are chains of their own.
        for chain in bows.iter().flat_map(|bows| chains(bows)) {
            for (curve, bows) in curves(&chain) {
                self.bend_chain(curve, bows);
            }
        }
        Ok(())
    }

    fn bow(&self, edge: u32, ends: [u32; 2], middle: Point) -> Result<Bow, MeshError> {
        let [a, b] = ends.map(|vertex| self.vertices[vertex as usize]);
        let bow = Bow { edge, ends, points: [a, middle, b] };
        let along = (middle - a).dot(&(b - a)) / (b - a).norm_squared();
        if bow.height() > HIGHEST || !bow.is_flat() && (along - 0.5).abs() > MIDDLE {
            return Err(self.unusable(format!(
                "the midside node {} is too far from the middle of its side from {} to {}; mesh the curve with more elements, or with `gmsh -2 -order 1` and a [geometry] in the case",
                Coordinates(middle),
                Coordinates(a),
                Coordinates(b)
            )));
        }
        Ok(bow)
    }

    fn bend_chain(&mut self, curve: Curve, bows: &[Bow]) {
        let knots = match &curve {
            Curve::Spline(spline) => spline.knots().to_vec(),
            _ => Vec::new(),
        };
        let curve = Arc::new(curve);
        for (k, bow) in bows.iter().enumerate() {
            let range = match knots.get(2 * k..2 * k + 3) {
                Some(knots) => [knots[0], knots[2]],
                None => self.onto(&curve, bow),
            };
            self.edges[bow.edge as usize].bend(bow.ends, curve.clone(), range);
        }
    }

    /// Parameters of a side's ends on a circle, which they are moved onto.
    fn onto(&mut self, circle: &Curve, bow: &Bow) -> [f64; 2] {
        let range = self.range_on(circle, bow.ends);
        for (vertex, t) in bow.ends.into_iter().zip(range) {
            let here = self.vertices[vertex as usize];
            let there = self.kept_on_axis(here, circle.point(t));
            if (here - there).norm() > 1e-14 * (here.norm() + bow.chord()) {
                self.vertices[vertex as usize] = there;
                self.bounds.take();
            }
        }
        range
    }
}

/// Sides by the vertices at their ends.
struct Neighbours<'a> {
    bows: &'a [Bow],
    at: BTreeMap<u32, Vec<usize>>,
}

impl<'a> Neighbours<'a> {
    fn new(bows: &'a [Bow]) -> Self {
        let mut at: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
        for (k, bow) in bows.iter().enumerate() {
            bow.ends.iter().for_each(|&end| at.entry(end).or_default().push(k));
        }
        Self { bows, at }
    }

    /// The side behind the second end of one, with its index: of several, the curved one.
    fn behind(&self, bow: &Bow) -> Option<(usize, Bow)> {
        let here = &self.at[&bow.ends[1]];
        let curved: Vec<usize> = here.iter().copied().filter(|&k| !self.bows[k].is_flat()).collect();
        let here = if curved.len() == 2 && !bow.is_flat() { &curved } else { here };
        let &[first, second] = here.as_slice() else { return None };
        let other = if self.bows[first].edge == bow.edge { second } else { first };
        let follows = self.bows[other].ends[0] == bow.ends[1];
        Some((other, if follows { self.bows[other] } else { self.bows[other].reversed() }))
    }

    fn after(&self, bow: Option<Bow>) -> Option<Bow> {
        self.behind(&bow?).map(|(_, after)| after)
    }

    fn before(&self, bow: Option<Bow>) -> Option<Bow> {
        self.after(bow.map(Bow::reversed)).map(Bow::reversed)
    }

    fn inflects(&self, flat: Option<Bow>) -> bool {
        let (before, after) = (self.before(flat), self.after(flat));
        is_inflection([self.before(before), before, flat, after, self.after(after)])
    }

    /// The side, with its index, that goes on smoothly behind the second end of one.
    fn next(&self, bow: &Bow) -> Option<(usize, Bow)> {
        let (number, other) = self.behind(bow)?;
        let (this, that) = (Some(*bow), Some(other));
        let goes_on = go_on([self.before(this), this, that, self.after(that)]) || self.inflects(this) || self.inflects(that);
        goes_on.then_some((number, other))
    }
}

/// Sides in rows that go on smoothly, those rows that are not straight.
fn chains(bows: &[Bow]) -> Vec<Vec<Bow>> {
    let neighbours = Neighbours::new(bows);
    let (mut is_left, mut chains) = (vec![true; bows.len()], Vec::new());
    for start in 0..bows.len() {
        if !std::mem::take(&mut is_left[start]) {
            continue;
        }
        let mut chain = vec![bows[start]];
        // Backwards first, so that an open chain begins at its end.
        for _ in 0..2 {
            chain = chain.into_iter().rev().map(Bow::reversed).collect();
            while let Some((k, bow)) = neighbours.next(&chain[chain.len() - 1]).filter(|(k, _)| is_left[*k]) {
                is_left[k] = false;
                chain.push(bow);
            }
        }
        chains.push(chain);
    }
    chains.retain(|chain| !chain.iter().all(Bow::is_flat));
    chains
}

/// The curves of a chain, each with its sides: one circle, several, or a spline.
fn curves(chain: &[Bow]) -> Vec<(Curve, &[Bow])> {
    if let Some(circle) = circle_through(chain) {
        return vec![(circle, chain)];
    }
    let arcs = chain.chunk_by(on_one_circle);
    let circles: Option<Vec<(Curve, &[Bow])>> =
        arcs.map(|arc| Some((circle_through(arc).filter(|_| arc.len() > 1)?, arc))).collect();
    circles.unwrap_or_else(|| vec![(spline_through(chain), chain)])
}

/// First ends and midside nodes of all sides, and the last end.
fn nodes(chain: &[Bow]) -> Vec<Point> {
    let last = chain.last().map(|bow| bow.points[2]);
    chain.iter().flat_map(|bow| [bow.points[0], bow.points[1]]).chain(last).collect()
}

fn spline_through(chain: &[Bow]) -> Curve {
    let (points, [first, last]) = (nodes(chain), [chain[0], chain[chain.len() - 1]]);
    let beside = |k: usize| Some(chain[k % chain.len()]);
    let count = chain.len();
    let is_closed = count > 2
        && first.ends[0] == last.ends[1]
        && (go_on([beside(count - 2), Some(last), Some(first), beside(1)])
            || is_inflection([beside(count - 3), beside(count - 2), Some(last), Some(first), beside(1)])
            || is_inflection([beside(count - 2), Some(last), Some(first), beside(1), beside(2)]));
    Curve::Spline(Spline::through(chord_lengths(&points), &points, is_closed))
}

/// The circle that is nearest to all nodes, by least squares of the powers of the points, if they lie on it.
fn circle_through(chain: &[Bow]) -> Option<Curve> {
    let points = nodes(chain);
    let middle = points.iter().sum::<Point>() / points.len() as f64;
    let size = points.iter().map(|x| (x - middle).norm()).fold(0.0, f64::max);
    let (mut normal, mut right) = (Matrix3::zeros(), Vector3::zeros());
    for x in points.iter().map(|x| (x - middle) / size) {
        let row = Vector3::new(2.0 * x.x, 2.0 * x.y, 1.0);
        normal += row * row.transpose();
        right += row * x.norm_squared();
    }
    let found = normal.cholesky()?.solve(&right);
    let shift = Point::new(found.x, found.y);
    let centre = middle + size * shift;
    let radius = size * (found.z + shift.norm_squared()).sqrt();
    let shortest = chain.iter().map(Bow::chord).fold(f64::INFINITY, f64::min);
    let is_near = |x: &Point| ((x - centre).norm() - radius).abs() <= FLAT * shortest;
    (radius.is_finite() && points.iter().all(is_near)).then(|| Curve::Circle { centre: centre.into(), radius })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::raw_mesh::RawMesh;
    use std::f64::consts::TAU;
    use std::path::Path;

    /// A fan of so many second-order triangles around the origin, whose rim is a curve of the angle.
    fn fan(count: usize, rim: impl Fn(f64) -> Point) -> RawMesh {
        let angle = |k: f64| TAU * k / count as f64;
        let mut raw = RawMesh { vertices: vec![Point::zeros()], ..Default::default() };
        for k in 0..count {
            let next = (k + 1) % count;
            raw.vertices.push(rim(angle(k as f64)));
            raw.add("disc", [[0, k + 1, next + 1]]);
            raw.add_line("rim", [k + 1, next + 1]);
            let [low, high] = [k.min(next), k.max(next)].map(|k| k as u32 + 1);
            raw.midsides.extend([([low, high], rim(angle(k as f64 + 0.5))), ([0, k as u32 + 1], 0.5 * rim(angle(k as f64)))]);
        }
        raw
    }

    fn built(raw: RawMesh) -> MacroMesh {
        MacroMesh::build(raw, Path::new("fan.msh")).expect("a good mesh")
    }

    /// Farthest points of the bent edges from a curve of the angle.
    fn off(mesh: &MacroMesh, distance: impl Fn(Point) -> f64) -> f64 {
        let rim = &mesh.boundary("rim").expect("named").edges;
        let places = rim.iter().flat_map(|&edge| (0..=8).map(move |k| (edge, f64::from(k) / 8.0)));
        places.map(|(edge, t)| distance(mesh.edge_position(edge, t))).fold(0.0, f64::max)
    }

    #[test]
    fn a_fan_of_a_circle_is_the_circle_itself() {
        let centre = Point::new(0.2, -0.1);
        for count in [4, 5, 12] {
            let mesh = built(fan(count, |angle| centre + 1.3 * Point::new(angle.cos(), angle.sin())));
            let distance = off(&mesh, |x| ((x - centre).norm() - 1.3).abs());
            assert!(distance < 1e-14, "{count} sides: {distance}");
            let edges = mesh.boundary("rim").expect("named").edges.clone();
            assert_eq!(mesh.stretches(&edges).len(), 1, "one curve");
            assert!(mesh.is_closed(&mesh.stretches(&edges)[0].edges));
            let bent = mesh.edges.iter().filter(|edge| edge.shape.is_some()).count();
            assert_eq!(bent, count, "spokes are straight");
        }
    }

    #[test]
    fn an_ellipse_is_followed_to_fourth_order() {
        let at = |angle: f64| Point::new(2.0 * angle.cos(), angle.sin());
        let error = |count| off(&built(fan(count, at)), |x| (Point::new(0.5 * x.x, x.y).norm() - 1.0).abs());
        let (coarse, fine) = (error(12), error(24));
        assert!(coarse < 1e-3 && fine < coarse / 10.0, "{coarse} {fine}");
    }

    /// A rim with three bays, whose curvature goes through zero six times: at nodes, in the middle of sides, or elsewhere.
    #[test]
    fn a_curve_whose_curvature_changes_its_sign_stays_one() {
        for shift in [0.0, 0.013, 0.02] {
            let at = |angle: f64| (1.0 + 0.2 * (3.0 * (angle + shift)).cos()) * Point::new(angle.cos(), angle.sin());
            let error = |count| {
                let mesh = built(fan(count, at));
                let edges = mesh.boundary("rim").expect("named").edges.clone();
                assert_eq!(mesh.stretches(&edges).len(), 1, "one curve of {count} sides");
                off(&mesh, |x| {
                    let angle = x.y.atan2(x.x);
                    (x - at(angle)).norm()
                })
            };
            let (coarse, fine) = (error(48), error(96));
            assert!(coarse < 1e-4 && fine < coarse / 10.0, "{shift}: {coarse} {fine}");
        }
    }

    /// A stadium: lines and half circles with common tangents are curves of their own.
    #[test]
    fn lines_stay_apart_from_arcs_that_go_on_from_them() {
        let at = |angle: f64| {
            let share = (angle / TAU).rem_euclid(1.0) * 4.0;
            let (part, along) = (share.floor(), share.fract());
            let turn = std::f64::consts::PI * (along - 0.5);
            match part as usize {
                0 => Point::new(1.0 + turn.cos(), turn.sin()),
                1 => Point::new(1.0 - 2.0 * along, 1.0),
                2 => Point::new(-1.0 - turn.cos(), -turn.sin()),
                _ => Point::new(2.0 * along - 1.0, -1.0),
            }
        };
        for count in [16, 64] {
            let mesh = built(fan(count, at));
            let bent: Vec<_> = mesh.edges.iter().filter_map(|edge| edge.shape.as_ref()).collect();
            assert!(bent.len() == count / 2 && bent.iter().all(|shape| matches!(*shape.curve, Curve::Circle { .. })));
        }
    }

    #[test]
    fn arcs_that_go_on_with_another_radius_are_two_circles() {
        // From (0, 1) along a half circle of radius 1 to (0, -1), from there with the same tangent along a quarter of radius 2 to
        // (2, 1), and straight back.
        let at = |angle: f64| {
            let share = (angle / TAU + 0.25 + 1e-9).rem_euclid(1.0) - 1e-9;
            match share {
                share if share >= 0.5 - 1e-9 => Point::new(angle.cos(), angle.sin()),
                share if share >= 0.375 => Point::new(2.0 - (share - 0.375) * 16.0, 1.0),
                share => {
                    let turn = (share / 0.375 - 1.0) * 0.25 * TAU;
                    Point::new(2.0 * turn.cos(), 1.0 + 2.0 * turn.sin())
                }
            }
        };
        let mesh = built(fan(16, at));
        let arcs = |x: Point| (x.norm() - 1.0).abs().min(((x - Point::new(0.0, 1.0)).norm() - 2.0).abs());
        let distance = off(&mesh, |x| arcs(x).min((x.y - 1.0).abs()));
        assert!(distance < 1e-13, "{distance}");
        let bent = mesh.edges.iter().filter_map(|edge| edge.shape.as_ref());
        assert!(bent.clone().all(|shape| matches!(*shape.curve, Curve::Circle { .. })) && bent.count() == 14);
    }

    /// A lens of two arcs of one radius, whose corners turn by less than five degrees: no spline goes around them.
    #[test]
    fn a_blunt_corner_between_two_arcs_stays_one() {
        let shift = 0.04;
        let at = |angle: f64| {
            let radius = (1.0 - (shift * angle.sin()).powi(2)).sqrt() - shift * angle.cos().abs();
            radius * Point::new(angle.cos(), angle.sin())
        };
        let mesh = built(fan(24, at));
        let distance = off(&mesh, |x| (Point::new(x.x.abs() + shift, x.y).norm() - 1.0).abs());
        assert!(distance < 1e-13, "{distance}");
        let bent = mesh.edges.iter().filter_map(|edge| edge.shape.as_ref());
        assert!(bent.clone().all(|shape| matches!(*shape.curve, Curve::Circle { .. })) && bent.count() == 24);
    }

    #[test]
    fn a_straight_side_stays_straight_and_a_wild_one_is_refused() {
        let square = |angle: f64| {
            let x = Point::new(angle.cos(), angle.sin());
            x / x.amax()
        };
        let mesh = built(fan(8, square));
        assert!(mesh.edges.iter().all(|edge| edge.shape.is_none()));
        let mut raw = fan(8, square);
        raw.midsides.push(([1, 2], Point::new(2.0, 0.5)));
        let words = MacroMesh::build(raw, Path::new("fan.msh")).expect_err("too high").to_string();
        assert!(words.contains("fan.msh: the midside node (2, 0.5)") && words.contains("more elements"), "{words}");
    }
}
