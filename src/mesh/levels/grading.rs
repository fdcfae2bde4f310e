//! Macro meshes that are refined towards some of their vertices: where nodes lie, and what they are made of.
//!
//! At the point itself u is off by the size of the triangle there, to the power α: the displacement of the corner (6, 4) of
//! example 1 by 4.6e-4 and 1.2e-4 of the largest (P2, 15 and 58 thousand unknowns, `"auto"`). An edge with both ends named is
//! cut in the middle first: with (6, 6) named beside (6, 4) across a single edge, U was off twice as far. Triangles next to the
//! point are flat: iterations to 1e-8 (P2 with `p1-discontinuous`, bilateral, κ = 0.15, `refine` 2 to 5) are 11, 10, 10 and 10
//! with two CG steps as the smoother (four today), and with one sweep 16, 18, 22 and more on each level.

use crate::geometry::Point;
use crate::mesh::lattice;
use crate::mesh::lattice::Place;
use crate::mesh::levels::hierarchy::{HierarchyTriangle, Shapes, barycentric, fraction};
use crate::mesh::levels::numbering::Level;
use crate::mesh::macro_mesh::MacroMesh;

/// Points closer to a macro vertex than this share of the mesh's size name it.
const SAME: f64 = 1e-6;

impl MacroMesh {
    /// Refines towards the vertices at a point: new nodes on their edges go to the fraction `ratio` from them.
    ///
    /// # Errors
    /// The nearest vertex, if none lies there.
    pub fn grade(&mut self, at: Point, ratio: f64) -> Result<(), Point> {
        let distance = |x: &Point| (x - at).norm();
        let size = self.vertices.iter().map(|x| (x - self.vertices[0]).norm()).fold(0.0, f64::max);
        let nearest = self.vertices.iter().copied().min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or_default();
        if distance(&nearest) > SAME * size {
            return Err(nearest);
        }
        let named = self.vertices.iter().zip(0..).filter(|(x, _)| distance(x) <= SAME * size);
        self.ratios.extend(named.map(|(_, vertex)| (vertex, ratio)));
        Ok(())
    }

    /// Whether a corner of the macro triangle is graded.
    pub fn is_graded(&self, triangle: usize) -> bool {
        !self.ratios.is_empty() && self.triangles[triangle].vertices.iter().any(|vertex| self.ratios.contains_key(vertex))
    }

    /// The macro triangle as the root of the hierarchy of a level.
    fn whole(&self, triangle: usize, level: Level) -> HierarchyTriangle {
        let ratios = self.triangles[triangle].vertices.map(|vertex| self.ratios.get(&vertex).copied());
        HierarchyTriangle::whole(ratios, level.refinements())
    }

    /// Shapes of the affine pieces of a macro triangle.
    pub fn shapes(&self, triangle: usize, level: Level) -> Shapes {
        Shapes { whole: self.whole(triangle, level), intervals: level.intervals }
    }

    /// Position of lattice node `(i, j)` of a macro triangle at a level.
    pub fn node_position(&self, triangle: usize, level: Level, (i, j): (usize, usize)) -> Point {
        let n = level.intervals as f64;
        let mut at = Point::new(i as f64 / n, j as f64 / n);
        if self.is_graded(triangle) {
            let (affine, [a, b, c]) = self.whole(triangle, level).below(barycentric(at));
            at = affine.corners[0] * a + affine.corners[1] * b + affine.corners[2] * c;
        }
        self.position(triangle, at.x, at.y)
    }

    /// Fraction of a macro edge at which its node `position` lies at a level.
    pub fn edge_fraction(&self, edge: u32, level: Level, position: u32) -> f64 {
        let at = f64::from(position) / level.intervals as f64;
        let [a, b] = self.edges[edge as usize].vertices.map(|vertex| self.ratios.get(&vertex).copied());
        if a.is_none() && b.is_none() {
            return at;
        }
        let (affine, [a, b, c]) =
            HierarchyTriangle::whole([a, b, None], level.refinements()).below(barycentric(Point::new(at, 0.0)));
        affine.corners[0].x * a + affine.corners[1].x * b + affine.corners[2].x * c
    }

    /// Shortest and longest edge of the triangles of a level, straight: those on macro edges, and opposite to graded vertices.
    pub fn shortest_and_longest_edge(&self, level: Level) -> [f64; 2] {
        let (n, step) = (level.intervals, level.order.degree());
        let mut lengths = [f64::INFINITY, 0.0];
        let mut add = |length: f64| lengths = [lengths[0].min(length), lengths[1].max(length)];
        for (edge, ends) in (0..self.edges.len() as u32).zip(self.edges.iter().map(|edge| edge.vertices)) {
            let count = if ends.iter().any(|vertex| self.ratios.contains_key(vertex)) { n / step } else { 1 };
            let place = |k: usize| self.edge_fraction(edge, level, (k * step) as u32);
            (0..count).for_each(|k| add((place(k + 1) - place(k)) * self.edge_length(edge)));
        }
        let graded = (0..self.triangles.len()).filter(|&triangle| self.is_graded(triangle));
        for (triangle, corner) in graded.flat_map(|triangle| (0..3).map(move |corner| (triangle, corner))) {
            if self.ratios.contains_key(&self.triangles[triangle].vertices[corner]) {
                let nodes = [lattice::side_node(n, corner, step), lattice::side_node(n, (corner + 2) % 3, n - step)];
                let [a, b] = nodes.map(|node| self.node_position(triangle, level, node));
                add((b - a).norm());
            }
        }
        lengths
    }

    /// Place in the lattice of a level, as fractions `(i / n, j / n)`, of a point of the macro triangle that is given by
    /// its reference coordinates.
    pub fn lattice_point(&self, triangle: usize, level: Level, at: Point) -> Point {
        if !self.is_graded(triangle) {
            return at;
        }
        let [_, xi, eta] = self.whole(triangle, level).lattice_of(at);
        Point::new(xi, eta)
    }

    /// Barycentric coordinates, in a triangle of a lattice of `n` intervals that is refined once, of the point that has the
    /// coordinates `l` in the triangle's refined lattice; `corners` are those of the triangle.
    pub fn place_in_parent(&self, triangle: usize, n: usize, corners: [(usize, usize); 3], l: [f64; 3]) -> [f64; 3] {
        if !self.is_graded(triangle) {
            return l;
        }
        let (affine, l) = HierarchyTriangle::whole(corners.map(|node| self.ratio(triangle, n, node)), 1).below(l);
        barycentric(affine.corners[0] * l[0] + affine.corners[1] * l[1] + affine.corners[2] * l[2])
    }

    /// κ of lattice node `(i, j)` at `n` intervals, if it is a graded vertex.
    fn ratio(&self, triangle: usize, n: usize, (i, j): (usize, usize)) -> Option<f64> {
        match lattice::place(n, i, j) {
            Place::Corner(corner) => self.ratios.get(&self.triangles[triangle].vertices[corner]).copied(),
            _ => None,
        }
    }

    /// Weights of the two parents of lattice node `(i, j)` of a level, in the order of [`lattice::parents`].
    pub fn parent_weights(&self, triangle: usize, level: Level, (i, j): (usize, usize)) -> [f64; 2] {
        let ratio = |node| self.ratio(triangle, level.intervals / 2, node);
        level.parent_weights(lattice::parents(i, j).map(ratio))
    }
}

impl Level {
    /// How often the macro mesh was refined.
    pub fn refinements(&self) -> u32 {
        self.triangles_per_edge().ilog2()
    }

    /// Weights of a node's two parents from their κ. Midside nodes of P2 are the middle of their edge always.
    pub(crate) fn parent_weights(&self, ratios: [Option<f64>; 2]) -> [f64; 2] {
        let t = if self.order == crate::element::Order::P2 { 0.5 } else { fraction(ratios) };
        [1.0 - t, t]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::element::Order;
    use crate::geometry::{Curve, cross};
    use crate::mesh::samples::two_blocks;

    fn level(refine: usize) -> Level {
        Level { intervals: 1 << refine, order: Order::P1 }
    }

    /// No graded corner in some triangles, one in others, two, and in one all three.
    fn graded() -> MacroMesh {
        let mut mesh = two_blocks();
        for (at, ratio) in [([0.0, 0.0], 0.15), ([0.9, 1.0], 0.3), ([2.0, 1.0], 0.2), ([2.0, 2.0], 0.45)] {
            mesh.grade(at.into(), ratio).expect("a vertex");
        }
        mesh
    }

    #[test]
    fn nodes_stay_where_they_are_at_all_finer_levels() {
        let mesh = graded();
        for (triangle, refine) in (0..mesh.triangles.len()).flat_map(|triangle| (0..6).map(move |refine| (triangle, refine))) {
            let here = level(refine);
            let midsides = Level { intervals: 2 * here.intervals, order: Order::P2 };
            for (i, j) in lattice::nodes(here.intervals) {
                let x = mesh.node_position(triangle, here, (i, j));
                for finer in [level(refine + 1), midsides] {
                    assert!((mesh.node_position(triangle, finer, (2 * i, 2 * j)) - x).norm() < 1e-15);
                }
            }
        }
    }

    /// The sides of all triangles of a level, shortest and longest.
    fn all_sides(mesh: &MacroMesh, level: Level) -> [f64; 2] {
        let n = level.intervals;
        let mut found = [f64::INFINITY, 0.0];
        for (triangle, small) in
            (0..mesh.triangles.len()).flat_map(|triangle| lattice::triangles(n, level.order).map(move |small| (triangle, small)))
        {
            let [a, b, c] = small.nodes::<3>().map(|node| mesh.node_position(triangle, level, node));
            for side in [b - a, c - b, a - c] {
                found = [found[0].min(side.norm()), found[1].max(side.norm())];
            }
        }
        found
    }

    #[test]
    fn the_shortest_and_the_longest_edge_are_those_of_all_triangles() {
        for mesh in [two_blocks(), graded()] {
            for (order, n) in [(Order::P1, 1), (Order::P1, 4), (Order::P2, 2), (Order::P2, 8)] {
                let level = Level { intervals: n, order };
                let found = mesh.shortest_and_longest_edge(level);
                let all = all_sides(&mesh, level);
                assert!((0..2).all(|k| (found[k] / all[k] - 1.0).abs() < 1e-12), "{order:?} {n}: {found:?} instead of {all:?}");
            }
        }
    }

    #[test]
    fn a_node_is_the_weighted_mean_of_its_parents() {
        let mesh = graded();
        for (triangle, refine) in (0..mesh.triangles.len()).flat_map(|triangle| (1..6).map(move |refine| (triangle, refine))) {
            let [coarse, fine] = [level(refine - 1), level(refine)];
            let midsides = Level { order: Order::P2, ..fine };
            for (fine, (i, j)) in
                [fine, midsides].into_iter().flat_map(|f| lattice::nodes(f.intervals).map(move |node| (f, node)))
            {
                let weights = mesh.parent_weights(triangle, fine, (i, j));
                assert!((weights[0] + weights[1] - 1.0).abs() < 1e-15, "constants are kept");
                let parents = lattice::parents(i, j).map(|node| mesh.node_position(triangle, coarse, node));
                let x = mesh.node_position(triangle, fine, (i, j));
                assert!((parents[0] * weights[0] + parents[1] * weights[1] - x).norm() < 1e-15);
            }
        }
    }

    #[test]
    fn edges_shrink_by_the_ratio_at_each_level() {
        let mesh = graded();
        let edge = mesh.boundary("top").expect("named").edges[1];
        let [a, b] = mesh.edges[edge as usize].vertices.map(|vertex| mesh.vertices[vertex as usize]);
        let (corner, graded) = if a.x == 2.0 { (a, 1) } else { (b, 0) };
        for refine in 1..8 {
            let n = level(refine).intervals as u32;
            let position = if graded == 1 { 1 } else { n - 1 };
            let x = mesh.edge_position(edge, mesh.edge_fraction(edge, level(refine), position));
            assert!(((x - corner).norm() / 1.1 - 0.45f64.powi(refine as i32)).abs() < 1e-15, "refine {refine}");
        }
        let seam = mesh.boundary("upper.seam").expect("named").edges[1];
        assert_eq!(mesh.edge_fraction(seam, level(1), 1), 0.5, "between two graded vertices");
        assert_eq!(mesh.edge_fraction(seam, level(2), 2), 0.5);
        let quarters = [1, 3].map(|position| mesh.edge_fraction(seam, level(2), position));
        assert!(quarters == [0.15, 0.9] || quarters == [0.1, 0.85], "{quarters:?}");
    }

    #[test]
    fn every_triangle_has_the_shape_that_it_is_given() {
        let mesh = graded();
        for triangle in (0..mesh.triangles.len()).filter(|&triangle| mesh.is_graded(triangle)) {
            for refine in 0..6 {
                let shapes = mesh.shapes(triangle, level(refine));
                let mut area = 0.0;
                for small in lattice::triangles(1 << refine, Order::P1) {
                    let nodes = small.nodes::<3>();
                    let [a, b, c] = nodes.map(|node| mesh.node_position(triangle, level(refine), node));
                    let [p, q, r] = shapes.corners(shapes.of(nodes)).map(|at| mesh.position(triangle, at.x, at.y));
                    let (size, like) = ((b - a).norm(), (q - p).norm());
                    let sides = [(b - a, q - p), (c - a, r - p)];
                    let turned = if sides[0].0.dot(&sides[0].1) < 0.0 { -1.0 } else { 1.0 };
                    assert!(sides.iter().all(|(own, other)| (own / size - other * turned / like).norm() < 1e-9));
                    assert!(cross(b - a, c - a) > 0.0);
                    area += cross(b - a, c - a);
                }
                let [a, b, c] = mesh.triangles[triangle].vertices.map(|vertex| mesh.vertices[vertex as usize]);
                assert!((area - cross(b - a, c - a)).abs() < 1e-12, "they cover the macro triangle");
            }
        }
    }

    #[test]
    fn the_place_in_the_lattice_is_found_again() {
        let mesh = graded();
        for (triangle, refine) in (0..mesh.triangles.len()).flat_map(|triangle| [0, 1, 4].map(|refine| (triangle, refine))) {
            for (i, j) in lattice::nodes(16) {
                let at = Point::new(i as f64 / 16.0, j as f64 / 16.0);
                let affine = mesh.whole(triangle, level(refine)).below(barycentric(at));
                let x = (0..3).map(|k| affine.0.corners[k] * affine.1[k]).sum();
                assert!((mesh.lattice_point(triangle, level(refine), x) - at).norm() < 1e-12);
            }
        }
    }

    #[test]
    fn a_bent_edge_is_graded_along_its_curve() {
        let mut mesh = two_blocks();
        let circle = Curve::Circle { centre: [1.0, -2.0], radius: 10f64.sqrt() };
        mesh.bend("arc", &["lower.seam".into()], &circle).expect("the ends lie on it");
        mesh.grade(Point::new(0.0, 1.0), 0.2).expect("a vertex");
        let edge = mesh.boundary("lower.seam").expect("it has one").edges[0];
        let whole = 2.0 * 10f64.sqrt().recip().asin();
        let angle = |x: Point| (x.x - 1.0).atan2(x.y + 2.0) + 0.5 * whole;
        let forward = mesh.vertices[mesh.edges[edge as usize].vertices[0] as usize].x == 0.0;
        for (k, fraction) in [(1, 0.04), (2, 0.2), (3, 0.6), (4, 1.0)] {
            let position = if forward { k } else { 4 - k };
            let x = mesh.edge_position(edge, mesh.edge_fraction(edge, level(2), position));
            assert!((angle(x) - fraction * whole).abs() < 1e-14, "{x}");
        }
    }

    #[test]
    fn coinciding_vertices_are_graded_together_and_others_are_not_found() {
        let mut mesh = two_blocks();
        mesh.grade(Point::new(2.0, 1.0), 0.3).expect("a vertex of each block");
        assert_eq!(mesh.ratios.values().filter(|ratio| **ratio == 0.3).count(), 2);
        assert_eq!(mesh.grade(Point::new(1.0, 1.1), 0.3), Err(Point::new(0.9, 1.0)));
    }
}
