//! Rigid tools: one layer of triangles behind a curve, as fine as the boundaries that it faces.
//!
//! A tool does not strain, so what lies behind its surface does not matter. The layer gives it nodes, edges with their true shape,
//! and a boundary like those of any body.

use crate::element::Plane;
use crate::geometry::{Curve, Point, cross, turn_right};
use crate::mesh::boundaries::Boundary;
use crate::mesh::curve_piece::CurvePiece;
use crate::mesh::macro_mesh::{BodyPiece, MacroMesh, MacroTriangle, Surface};
use std::f64::consts::TAU;

/// Points of a curve at which sizes are asked for.
const SAMPLES: usize = 4000;

/// Growth of the edges with the distance from the boundary that they face.
const GROWTH: f64 = 0.5;

/// Turn along one edge at most (radians, 15 degrees).
const MOST_TURN: f64 = std::f64::consts::PI / 12.0;

/// Depth of the layer in lengths of its edges.
const DEPTH: f64 = 0.6;

/// Edges of a tool at most.
const MOST_EDGES: f64 = 5000.0;

/// Longest step into a corner of the surface, in depths.
const LONGEST_MITRE: f64 = 3.0;

/// Angle of a circle that nothing faces from which it is cut open there (radians, 90 degrees), and the angle that is left out.
const LEAST_OPENING: f64 = std::f64::consts::FRAC_PI_2;
const OPENING: f64 = 1e-2;

/// Cosine of the angle between the normals of a tool and of a body from which they face each other.
const FACES: f64 = 0.1;

/// Of a part of a tool's surface; parts follow each other.
impl CurvePiece {
    /// Unit normal to the right of the direction of travel.
    fn right(&self, share: f64) -> Point {
        turn_right(self.curve.tangent(self.parameter(share)))
    }

    /// Whether it closes in itself.
    fn is_closed(&self) -> bool {
        (self.point(1.0) - self.point(0.0)).norm() <= 1e-9 * (self.point(0.5) - self.point(0.0)).norm()
    }
}

/// A vertex on the surface.
struct SurfacePoint {
    x: Point,
    /// Unit normal to the right; at a corner that of the bisector.
    right: Point,
    /// Depth of the layer here, along the normal.
    depth: f64,
}

/// An edge on the surface: its part, and the parameters of its ends.
struct SurfaceEdge {
    part: usize,
    range: [f64; 2],
}

impl MacroMesh {
    /// Adds a rigid tool as a body and a boundary of this name; each of several parts is a boundary, too: `NAME.1`, ... The
    /// edges that it faces (`against`) tell on which side it is solid, and how long its own edges are.
    ///
    /// # Errors
    /// Words that say what is wrong with the surface.
    pub fn add_tool(&mut self, name: &str, parts: &[CurvePiece], against: &[u32]) -> Result<(), String> {
        let parts = &self.opened(parts, against);
        let solid_right = self.is_solid_right(parts, against)?;
        let sizes = Sizes::new(self, against);
        let is_closed = parts.len() == 1 && parts[0].is_closed();
        let (mut places, mut sides) = (Vec::new(), Vec::new());
        for (number, part) in parts.iter().enumerate() {
            let shares = sizes.cut(part, is_closed)?;
            for pair in shares.windows(2) {
                sides.push(SurfaceEdge { part: number, range: [part.parameter(pair[0]), part.parameter(pair[1])] });
            }
            for (k, &share) in shares.iter().enumerate() {
                let x = self.rounded_to_axis(part.point(share), part);
                let place = SurfacePoint { x, right: part.right(share), depth: DEPTH * step(part, &shares, k) };
                match places.last_mut() {
                    Some(last) if k == 0 => join(last, &place),
                    _ => places.push(place),
                }
            }
        }
        if is_closed {
            places.pop();
        }
        self.add_layer(name, parts, &places, &sides, if solid_right { 1.0 } else { -1.0 })
    }

    /// A circle that is faced on a part of it only is cut open where it is not: an arc has ends, as most boundaries have. Of one about
    /// a point of the axis of revolution its half at the right of that is left.
    fn opened(&self, parts: &[CurvePiece], against: &[u32]) -> Vec<CurvePiece> {
        let [CurvePiece { curve, range }] = parts else { return parts.to_vec() };
        let Curve::Circle { centre, .. } = **curve else { return parts.to_vec() };
        let open = |range: [f64; 2]| vec![CurvePiece { curve: curve.clone(), range }];
        if self.plane == Plane::Revolution && centre[0] == 0.0 {
            return open([-0.25 * TAU, 0.25 * TAU]);
        }
        let mut angles: Vec<f64> = against.iter().map(|&edge| curve.nearest(self.edge_position(edge, 0.5))).collect();
        angles.sort_by(f64::total_cmp);
        let next = |k: usize| angles.get(k + 1).copied().unwrap_or(angles[0] + TAU);
        let widest = (0..angles.len()).map(|k| [angles[k], next(k)]).max_by(|a, b| (a[1] - a[0]).total_cmp(&(b[1] - b[0])));
        let middle = widest.filter(|[from, to]| to - from >= LEAST_OPENING).map(|[from, to]| 0.5 * (from + to));
        open(middle.map_or(*range, |middle| [middle + 0.5 * OPENING, middle + TAU - 0.5 * OPENING]))
    }

    /// Whether the tool lies to the right of its surface: where it faces the nearest edge, its outward normal is against that of
    /// the body.
    fn is_solid_right(&self, parts: &[CurvePiece], against: &[u32]) -> Result<bool, String> {
        let mut nearest = (f64::INFINITY, 0.0);
        for part in parts {
            for share in (0..=SAMPLES / 10).map(|k| k as f64 * 10.0 / SAMPLES as f64) {
                let (x, right) = (part.point(share), part.right(share));
                for &edge in against {
                    let across = right.dot(&self.edge_normal(edge, 0.5));
                    let away = (self.edge_position(edge, 0.5) - x).norm();
                    if across.abs() > FACES && away < nearest.0 {
                        nearest = (away, across);
                    }
                }
            }
        }
        if nearest.0.is_finite() {
            Ok(nearest.1 > 0.0)
        } else {
            Err("its surface faces none of the boundaries that it is in contact with; move or turn it".into())
        }
    }

    /// A point of a surface, on the axis of revolution if it misses that by rounding.
    fn rounded_to_axis(&self, x: Point, part: &CurvePiece) -> Point {
        let size = (part.point(0.5) - part.point(0.0)).norm();
        let is_on_axis = self.plane == Plane::Revolution && x.x.abs() <= 1e-12 * size;
        if is_on_axis { Point::new(0.0, x.y) } else { x }
    }

    /// The direction of the layer behind a vertex: on an axis of revolution along that.
    fn away(&self, place: &SurfacePoint) -> Point {
        match self.plane == Plane::Revolution && place.x.x == 0.0 {
            true => Point::new(0.0, place.right.y.signum()),
            false => place.right,
        }
    }

    /// Triangles between the surface and a row of vertices behind it.
    fn add_layer(
        &mut self,
        name: &str,
        parts: &[CurvePiece],
        places: &[SurfacePoint],
        sides: &[SurfaceEdge],
        behind: f64,
    ) -> Result<(), String> {
        let first = self.vertices.len() as u32;
        let ends = |k: usize| [k, (k + 1) % places.len()].map(|at| first + 2 * at as u32);
        for place in places {
            self.vertices.push(place.x);
            self.vertices.push(place.x + behind * place.depth * self.away(place));
            if self.plane == Plane::Revolution && place.x.x < 0.0 {
                return Err(format!(
                    "its surface lies at the left of the axis of revolution near ({:.6}, {:.6}); give its part with x >= 0",
                    place.x.x, place.x.y
                ));
            }
        }
        self.bounds.take();
        let (body, piece, start) = (self.bodies.len() as u32, self.pieces.len() as u32, self.triangles.len() as u32);
        let part = self.parts.len() as u32;
        self.bodies.push(name.into());
        self.parts.push(Surface { name: name.into(), body });
        self.pieces.push(BodyPiece { body: body as usize, first: start });
        for (k, place) in places.iter().enumerate().take(sides.len()) {
            let new = |vertices| MacroTriangle { vertices, edges: [0; 3], forward: [true; 3], body, part, piece };
            let corners = self.layer_corners(ends(k), behind > 0.0).ok_or_else(|| {
                let [x, y] = [place.x.x, place.x.y];
                format!("its surface turns too sharply near ({x:.6}, {y:.6}); make it smoother, or of several tools")
            })?;
            self.triangles.extend(corners.map(new));
        }
        let shapes: Vec<_> = self.edges.iter_mut().map(|edge| edge.shape.take()).collect();
        let (edges, _) = self.connect();
        self.edges.iter_mut().zip(shapes).for_each(|(edge, shape)| edge.shape = shape);
        let mut surface = Vec::new();
        for (k, side) in sides.iter().enumerate() {
            let edge = edges.between(&self.triangles, ends(k)).expect("a side of the first triangle there");
            let curve = &parts[side.part].curve;
            if !curve.is_line() {
                self.edges[edge as usize].bend(ends(k), curve.clone(), side.range);
            }
            surface.push((side.part, edge));
        }
        let whole = surface.iter().map(|&(_, edge)| edge).collect();
        self.boundaries.push(Boundary { name: name.into(), edges: whole, is_union: false });
        for number in (0..parts.len()).filter(|_| parts.len() > 1) {
            let own = surface.iter().filter(|(part, _)| *part == number).map(|&(_, edge)| edge).collect();
            self.boundaries.push(Boundary { name: format!("{name}.{}", number + 1), edges: own, is_union: false });
        }
        Ok(())
    }

    /// Corners of the two triangles behind a side from vertex `a` to vertex `b`, the vertex behind each being the next one; nothing
    /// where they are turned inside out.
    fn layer_corners(&self, [a, b]: [u32; 2], is_behind: bool) -> Option<[[u32; 3]; 2]> {
        let [c, d] = [b + 1, a + 1];
        let corners = [[a, b, c], [a, c, d]].map(|[x, y, z]| if is_behind { [x, z, y] } else { [x, y, z] });
        let is_good = |corners: &[u32; 3]| {
            let [x, y, z] = corners.map(|corner| self.vertices[corner as usize]);
            cross(y - x, z - x) > 0.0
        };
        corners.iter().all(is_good).then_some(corners)
    }
}

/// Mean length of the edges beside a vertex of a part.
fn step(part: &CurvePiece, shares: &[f64], k: usize) -> f64 {
    let length = |a: f64, b: f64| (part.point(b) - part.point(a)).norm();
    let before = k.checked_sub(1).map(|before| length(shares[before], shares[k]));
    let after = shares.get(k + 1).map(|&after| length(shares[k], after));
    before.into_iter().chain(after).fold(f64::INFINITY, f64::min)
}

/// The vertex where two parts meet: the layer goes along the bisector of both normals.
fn join(last: &mut SurfacePoint, next: &SurfacePoint) {
    let half = last.right + next.right;
    let bisector = half / half.norm().max(f64::MIN_POSITIVE);
    let cosine = bisector.dot(&next.right).max(1.0 / LONGEST_MITRE);
    (last.right, last.depth) = (bisector, last.depth.min(next.depth) / cosine);
}

/// Lengths of edges: those of the boundaries faced, growing with the distance from these.
struct Sizes {
    /// Middle and length of each edge faced.
    edges: Vec<(Point, f64)>,
}

impl Sizes {
    fn new(mesh: &MacroMesh, against: &[u32]) -> Self {
        Self { edges: against.iter().map(|&edge| (mesh.edge_position(edge, 0.5), mesh.edge_length(edge))).collect() }
    }

    fn at(&self, x: Point) -> f64 {
        self.edges.iter().map(|(middle, length)| length + GROWTH * (middle - x).norm()).fold(f64::INFINITY, f64::min)
    }

    /// Shares of a part's parameter that cut it into edges.
    fn cut(&self, part: &CurvePiece, is_closed: bool) -> Result<Vec<f64>, String> {
        let share = |k: usize| k as f64 / SAMPLES as f64;
        let mut counts = vec![0.0];
        for k in 0..SAMPLES {
            let [a, b] = [k, k + 1].map(|k| part.point(share(k)));
            let [before, after] = [k, k + 1].map(|k| part.right(share(k)));
            let turn = cross(before, after).atan2(before.dot(&after)).abs();
            let edges = ((b - a).norm() / self.at(0.5 * (a + b))).max(turn / MOST_TURN);
            if !edges.is_finite() {
                return Err("its curve has no finite tangent somewhere; correct its formulas or their range".into());
            }
            counts.push(counts[k] + edges);
        }
        let all = counts[SAMPLES];
        if all > MOST_EDGES {
            return Err(format!(
                "its surface would take {all:.0} edges as long as those of the body that it faces; shorten the surface to the part that can touch"
            ));
        }
        let count = (all.ceil() as usize).max(if is_closed { 8 } else { 2 });
        let cut = |number: usize| {
            let wanted = all * number as f64 / count as f64;
            let k = counts.partition_point(|&reached| reached < wanted).clamp(1, SAMPLES);
            share(k - 1) + (wanted - counts[k - 1]) / (counts[k] - counts[k - 1]) * (share(k) - share(k - 1))
        };
        Ok(std::iter::once(0.0).chain((1..count).map(cut)).chain([1.0]).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::samples::two_blocks;

    fn with_tool(parts: &[CurvePiece], faced: &str) -> MacroMesh {
        let mut mesh = two_blocks();
        let against = mesh.boundary(faced).expect("named").edges.clone();
        mesh.add_tool("rigid.tool", parts, &against).expect("a good surface");
        mesh
    }

    fn line(from: [f64; 2], to: [f64; 2]) -> CurvePiece {
        CurvePiece { curve: Curve::Line([from, to]).into(), range: [0.0, 1.0] }
    }

    fn circle(centre: [f64; 2], radius: f64) -> CurvePiece {
        CurvePiece { curve: Curve::Circle { centre, radius }.into(), range: [0.0, TAU] }
    }

    #[test]
    fn a_tool_is_solid_away_from_what_it_faces_whichever_way_its_curve_runs() {
        for (part, faced, down) in [
            (line([0.2, 2.1], [1.8, 2.1]), "top", true),
            (line([1.8, 2.1], [0.2, 2.1]), "top", true),
            (line([0.2, -0.1], [1.8, -0.1]), "bottom", false),
            (circle([1.0, 3.0], 1.0), "top", true),
        ] {
            let mesh = with_tool(&[part], faced);
            let edges = &mesh.boundary("rigid.tool").expect("added").edges;
            let lowest = |edge: &&u32| (if down { 1.0 } else { -1.0 }) * mesh.edge_position(**edge, 0.5).y;
            let edge = *edges.iter().min_by(|a, b| lowest(a).total_cmp(&lowest(b))).expect("some");
            let normal = mesh.edge_normal(edge, 0.5);
            assert!(if down { normal.y < -0.9 } else { normal.y > 0.9 }, "{normal}");
            assert_eq!(mesh.body_beside(edge), 2);
        }
    }

    /// A ring of triangles, no edge of which is left open but those of both its circles. It is faced from all around.
    #[test]
    fn a_circle_closes_and_its_edges_lie_on_it() {
        let mut mesh = two_blocks();
        let is_outer = |edge: &u32| mesh.edges[*edge as usize].triangles[1].is_none();
        let all: Vec<u32> = (0..mesh.edges.len() as u32).filter(is_outer).collect();
        mesh.add_tool("rigid.tool", &[circle([1.0, 1.0], 3.0)], &all).expect("a good surface");
        let edges = &mesh.boundary("rigid.tool").expect("added").edges;
        let own: Vec<_> = mesh.triangles.iter().filter(|triangle| triangle.body == 2).collect();
        assert_eq!(own.len(), 2 * edges.len());
        for &edge in edges {
            for t in [0.0, 0.3, 1.0] {
                let x = mesh.edge_position(edge, t);
                assert!(((x - Point::new(1.0, 1.0)).norm() - 3.0).abs() < 1e-14, "{x}");
            }
        }
        let open =
            own.iter().flat_map(|triangle| triangle.edges).filter(|&edge| mesh.edges[edge as usize].triangles[1].is_none());
        assert_eq!(open.count(), 2 * edges.len());
    }

    #[test]
    fn a_wedge_of_two_lines_has_a_boundary_for_each() {
        let mesh = with_tool(&[line([0.0, 3.0], [1.0, 2.0]), line([1.0, 2.0], [2.0, 3.0])], "top");
        let count = |name: &str| mesh.boundary(name).expect("added").edges.len();
        assert_eq!(count("rigid.tool"), count("rigid.tool.1") + count("rigid.tool.2"));
        let area: f64 = (0..mesh.triangles.len())
            .map(|t| mesh.triangles[t].vertices.map(|v| mesh.vertices[v as usize]))
            .map(|[a, b, c]| cross(b - a, c - a))
            .fold(f64::INFINITY, f64::min);
        assert!(area > 0.0);
    }

    #[test]
    fn a_surface_that_faces_nothing_is_told() {
        let mut mesh = two_blocks();
        let against = mesh.boundary("top").expect("named").edges.clone();
        let upright = [line([1.0, 2.1], [1.0, 3.0])];
        assert!(mesh.add_tool("rigid.tool", &upright, &against).unwrap_err().contains("faces none"));
    }
}
