//! Shape functions of P1 and P2 on the reference triangle and the reference edge.
//!
//! A triangle's nodes are its corners (0, 0), (1, 0), (0, 1), then for P2 the midsides of (01), (12), (20). An edge's
//! nodes are its ends at 0 and 1, then for P2 the node between them. `N` is the number of nodes.

/// Values at barycentric coordinates `l` (sum 1); `N` = 3 or 6.
pub fn shape<const N: usize>(l: [f64; 3]) -> [f64; N] {
    std::array::from_fn(|a| match (N, a) {
        (3, _) => l[a],
        (_, 0..3) => l[a] * (2.0 * l[a] - 1.0),
        _ => 4.0 * l[a - 3] * l[(a - 2) % 3],
    })
}

/// Derivatives by the reference coordinates `(xi, eta)`, where `l = (1 - xi - eta, xi, eta)`.
pub fn slopes<const N: usize>(l: [f64; 3]) -> [[f64; 2]; N] {
    const D: [[f64; 2]; 3] = [[-1.0, -1.0], [1.0, 0.0], [0.0, 1.0]];
    std::array::from_fn(|a| match (N, a) {
        (3, _) => D[a],
        (_, 0..3) => D[a].map(|d| (4.0 * l[a] - 1.0) * d),
        _ => {
            let (i, j) = (a - 3, (a - 2) % 3);
            std::array::from_fn(|k| 4.0 * (l[i] * D[j][k] + l[j] * D[i][k]))
        }
    })
}

/// Values on an edge at the fraction `t`: two for P1 (the third is zero), three for P2.
pub fn edge_shape(nodes: usize, t: f64) -> [f64; 3] {
    match nodes {
        2 => [1.0 - t, t, 0.0],
        _ => [(1.0 - t) * (1.0 - 2.0 * t), t * (2.0 * t - 1.0), 4.0 * t * (1.0 - t)],
    }
}

/// Derivatives of [`edge_shape`] by `t`.
pub fn edge_slope(nodes: usize, t: f64) -> [f64; 3] {
    match nodes {
        2 => [-1.0, 1.0, 0.0],
        _ => [4.0 * t - 3.0, 4.0 * t - 1.0, 4.0 - 8.0 * t],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const INSIDE: [[f64; 3]; 3] = [[0.2, 0.3, 0.5], [1.0, 0.0, 0.0], [0.0, 0.5, 0.5]];

    fn sums_to_one<const N: usize>() {
        for l in INSIDE {
            assert!((shape::<N>(l).iter().sum::<f64>() - 1.0).abs() < 1e-15);
            for k in 0..2 {
                assert!(slopes::<N>(l).iter().map(|d| d[k]).sum::<f64>().abs() < 1e-14);
            }
        }
    }

    #[test]
    fn shape_functions_sum_to_one_and_their_slopes_to_zero() {
        sums_to_one::<3>();
        sums_to_one::<6>();
        for nodes in [2, 3] {
            assert!((edge_shape(nodes, 0.3).iter().sum::<f64>() - 1.0).abs() < 1e-15);
            assert!(edge_slope(nodes, 0.3).iter().sum::<f64>().abs() < 1e-15);
        }
    }

    #[test]
    fn each_is_one_at_its_own_node_only() {
        let nodes = [[1., 0., 0.], [0., 1., 0.], [0., 0., 1.], [0.5, 0.5, 0.], [0., 0.5, 0.5], [0.5, 0., 0.5]];
        for (a, l) in nodes.into_iter().enumerate() {
            let values = shape::<6>(l);
            assert!((0..6).all(|b| (values[b] - f64::from(a == b)).abs() < 1e-15));
        }
    }

    #[test]
    fn slopes_are_derivatives_of_the_values() {
        let step = 1e-6;
        let at = |xi: f64, eta: f64| shape::<6>([1.0 - xi - eta, xi, eta]);
        let slopes = slopes::<6>([0.5, 0.2, 0.3]);
        for (a, slope) in slopes.iter().enumerate() {
            let dx = (at(0.2 + step, 0.3)[a] - at(0.2 - step, 0.3)[a]) / (2.0 * step);
            let dy = (at(0.2, 0.3 + step)[a] - at(0.2, 0.3 - step)[a]) / (2.0 * step);
            assert!((slope[0] - dx).abs() < 1e-9 && (slope[1] - dy).abs() < 1e-9);
        }
    }
}
