//! Boundaries of bodies.

use super::*;

/// A square block [x, x+1] × [0, 1] of n × n × 2 facets.
pub(in crate::output::plot) fn block(
    x: f64,
    n: usize,
    displacement: fn(f64, f64) -> [f64; 2],
    von_mises: fn(f64, f64) -> f64,
) -> Vec<Facet> {
    let corner = |i: usize, j: usize| [x + i as f64 / n as f64, j as f64 / n as f64];
    let mut facets = Vec::new();
    for (i, j) in (0..n * n).map(|k| (k % n, k / n)) {
        let [a, b, c, d] = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
        facets.extend([[a, b, c], [a, c, d]].map(|corners| Facet {
            corners,
            displacement: corners.map(|[x, y]| displacement(x, y)),
            von_mises: corners.map(|[x, y]| von_mises(x, y)),
        }));
    }
    facets
}

#[test]
fn bodies_that_touch_keep_their_own_outlines() {
    let mut facets = block(0.0, 3, |_, _| [0.0, 0.0], |_, _| 1.0);
    assert_eq!(boundary_edges(&facets).len(), 12);
    facets.extend(block(1.0, 3, |_, y| [0.0, 1e-6 + y], |_, _| 1.0));
    assert_eq!(boundary_edges(&facets).len(), 24);
    assert_eq!(loops(&boundary_edges(&facets)).len(), 2);
}

#[test]
fn corners_that_differ_by_rounding_are_one() {
    let mut facets = block(0.0, 3, |_, _| [0.0, 0.0], |_, _| 1.0);
    facets[0].corners[0] = [1e-19, -3e-18];
    facets[3].corners[1][0] += 1e-16;
    let edges = boundary_edges(&facets);
    assert_eq!((edges.len(), loops(&edges).len()), (12, 1));
}
