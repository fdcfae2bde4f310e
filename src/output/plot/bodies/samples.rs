//! Bodies that tests draw.

use super::facets::Facet;

/// A square block [x, x+1] × [0, 1] of n × n × 2 facets, pulled along x.
pub fn block(x: f64, n: usize, displacement: fn(f64, f64) -> [f64; 2], pull: fn(f64, f64) -> f64) -> Vec<Facet> {
    let corner = |i: usize, j: usize| [x + i as f64 / n as f64, j as f64 / n as f64];
    let mut facets = Vec::new();
    for (i, j) in (0..n * n).map(|k| (k % n, k / n)) {
        let [a, b, c, d] = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
        facets.extend([[a, b, c], [a, c, d]].map(|corners| Facet {
            corners,
            displacement: corners.map(|[x, y]| displacement(x, y)),
            stress: corners.map(|[x, y]| [pull(x, y), 0.0, 0.0, 0.0]),
        }));
    }
    facets
}
