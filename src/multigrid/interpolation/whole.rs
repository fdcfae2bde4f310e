//! Interpolation inside a macro triangle from lattice to lattice.

use crate::mesh::lattice;

/// Values of the inner nodes of a fine lattice with `n` intervals, row by row, from those of a coarse lattice; they are added to
/// those of `y`, or take their place.
pub fn prolong<const ADD: bool>(n: usize, coarse: &[[f64; 2]], y: &mut [[f64; 2]]) {
    pulp::Arch::new().dispatch(
        #[inline(always)]
        || {
            let mut next = 0;
            for j in 1..n - 1 {
                let count = n - 1 - j;
                prolong_row::<ADD>(n, j, coarse, &mut y[next..next + count]);
                next += count;
            }
        },
    );
}

#[inline(always)]
fn prolong_row<const ADD: bool>(n: usize, j: usize, coarse: &[[f64; 2]], y: &mut [[f64; 2]]) {
    let put = |to: &mut [f64; 2], a: [f64; 2], b: [f64; 2]| {
        for k in 0..2 {
            let mean = 0.5 * (a[k] + b[k]);
            to[k] = if ADD { to[k] + mean } else { mean };
        }
    };
    let row = |b: usize| &coarse[lattice::index(n / 2, 0, b)..][..n / 2 + 1 - b];
    // A node with even i lies between a[i / 2] and b[i / 2], the next one between a[i / 2 + 1] and b[i / 2].
    let (a, b) = (row(j / 2), row(j.div_ceil(2)));
    put(&mut y[0], a[1], b[0]);
    let (pairs, last) = y[1..].as_chunks_mut::<2>();
    let count = pairs.len();
    let (a, next, b) = (&a[1..][..=count], &a[2..][..count], &b[1..]);
    for (((pair, a), next), b) in pairs.iter_mut().zip(a).zip(next).zip(b) {
        put(&mut pair[0], *a, *b);
        put(&mut pair[1], *next, *b);
    }
    if let [last] = last {
        put(last, a[count], b[count]);
    }
}

/// What the transposed interpolation makes of the values of the inner nodes of a fine lattice, row by row, in all of a coarse one.
pub fn restrict_inner(n: usize, y: &[[f64; 2]], coarse: &mut [[f64; 2]]) {
    pulp::Arch::new().dispatch(
        #[inline(always)]
        || {
            for b in 0..=n / 2 {
                let to = lattice::index(n / 2, 0, b);
                restrict_inner_row(n, b, y, &mut coarse[to..=to + n / 2 - b]);
            }
        },
    );
}

#[inline(always)]
fn restrict_inner_row(n: usize, b: usize, y: &[[f64; 2]], sums: &mut [[f64; 2]]) {
    let zero = [0.0; 2];
    // The inner nodes of a row, from the first one on; none in rows that lie on sides.
    let row = |j: usize| if (1..n - 1).contains(&j) { &y[lattice::row_start(n, j)..][..n - 1 - j] } else { &[] };
    let (below, own, above) = (if b == 0 { &[] } else { row(2 * b - 1) }, row(2 * b), row(2 * b + 1));
    let value = |row: &[[f64; 2]], k: usize| row.get(k).copied().unwrap_or(zero);
    let put = |sum: &mut [f64; 2], own: [[f64; 2]; 3], below: [[f64; 2]; 2], above: [[f64; 2]; 2]| {
        *sum = [0, 1].map(|k| {
            let beside = (own[0][k] + own[2][k]) + (below[0][k] + below[1][k]);
            own[1][k] + 0.5 * (beside + (above[0][k] + above[1][k]))
        });
    };
    let last = sums.len() - 1;
    put(&mut sums[0], [zero, zero, value(own, 0)], [zero, value(below, 0)], [zero; 2]);
    if last == 0 {
        return;
    }
    put(&mut sums[last], [value(own, 2 * last - 2), zero, zero], [value(below, 2 * last - 1), zero], [zero; 2]);
    if b == 0 {
        for (sum, above) in sums[1..last].iter_mut().zip(above.as_chunks().0) {
            put(sum, [zero; 3], [zero; 2], *above);
        }
        return;
    }
    let (below, own, above) = (&below[..2 * last], &own[..2 * last - 1], &above[..2 * last - 2]);
    for (k, sum) in (0..).step_by(2).zip(&mut sums[1..last]) {
        put(sum, [own[k], own[k + 1], own[k + 2]], [below[k + 1], below[k + 2]], [above[k], above[k + 1]]);
    }
}

/// What the transposed interpolation makes of fine lattices, which are zero on their sides, in all of coarse ones: of so many
/// macro triangles side by side.
pub fn restrict(n: usize, width: usize, fine: &[[f64; 2]], coarse: &mut [[f64; 2]]) {
    match width {
        2 => restrict_side_by_side::<2>(n, fine, coarse),
        4 => restrict_side_by_side::<4>(n, fine, coarse),
        _ => panic!("registers hold 2 or 4 nodes, not {width}"),
    }
}

fn restrict_side_by_side<const WIDTH: usize>(n: usize, fine: &[[f64; 2]], coarse: &mut [[f64; 2]]) {
    let (fine, coarse) = (fine.as_chunks::<WIDTH>().0, coarse.as_chunks_mut::<WIDTH>().0);
    pulp::Arch::new().dispatch(
        #[inline(always)]
        || {
            for b in 0..n / 2 {
                let to = lattice::index(n / 2, 0, b);
                restrict_row(n, b, fine, &mut coarse[to..=to + n / 2 - b]);
            }
            coarse[lattice::index(n / 2, 0, n / 2)] = [[0.0; 2]; WIDTH];
        },
    );
}

#[inline(always)]
fn restrict_row<const WIDTH: usize>(n: usize, b: usize, fine: &[[[f64; 2]; WIDTH]], sums: &mut [[[f64; 2]; WIDTH]]) {
    // Beyond the ends of rows there are zeros: nodes on the sides.
    let pairs = |j: usize, first: isize| -> &[[[[f64; 2]; WIDTH]; 2]] {
        let start = lattice::index(n, 0, j).wrapping_add_signed(first);
        fine[start..start + 2 * sums.len()].as_chunks().0
    };
    let above = pairs(2 * b + 1, -1);
    let each = |sum: fn(f64, f64) -> f64| {
        move |a: &[[f64; 2]; WIDTH], b: &[[f64; 2]; WIDTH]| -> [[f64; 2]; WIDTH] {
            std::array::from_fn(|lane| [0, 1].map(|k| sum(a[lane][k], b[lane][k])))
        }
    };
    let add = each(|a, b| a + b);
    let halved = |a: [[f64; 2]; WIDTH]| a.map(|node| node.map(|v| 0.5 * v));
    if b == 0 {
        sums.iter_mut().zip(above).for_each(|(sum, above)| *sum = halved(add(&above[0], &above[1])));
        return;
    }
    let (before, own, below) = (pairs(2 * b, -1), pairs(2 * b, 0), pairs(2 * b - 1, 0));
    for ((((sum, before), own), below), above) in sums.iter_mut().zip(before).zip(own).zip(below).zip(above) {
        let beside = add(&add(&before[0], &own[1]), &add(&below[0], &below[1]));
        *sum = add(&own[0], &halved(add(&beside, &add(&above[0], &above[1]))));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discretisation::samples::vector;

    fn product(a: &[[f64; 2]], b: &[[f64; 2]]) -> f64 {
        a.as_flattened().iter().zip(b.as_flattened()).map(|(a, b)| a * b).sum()
    }

    #[test]
    fn restriction_is_the_transposed_interpolation() {
        for n in [4, 8, 14, 32] {
            let (y, coarse) = (vector(lattice::inner_count(n), 3), vector(lattice::node_count(n / 2), 55));
            let (mut fine, mut sums) = (y.clone(), coarse.clone());
            prolong::<false>(n, &coarse, &mut fine);
            restrict_inner(n, &y, &mut sums);
            let (left, right) = (product(&fine, &y), product(&coarse, &sums));
            assert!((left - right).abs() < 1e-12 * left, "n = {n}: {left} {right}");
            let mut more = y.clone();
            prolong::<true>(n, &coarse, &mut more);
            let apart = more.iter().zip(&fine).zip(&y).flat_map(|((more, fine), y)| [0, 1].map(|k| more[k] - fine[k] - y[k]));
            assert!(apart.fold(0.0, |most: f64, v| most.max(v.abs())) < 1e-14, "n = {n}");
        }
    }

    #[test]
    fn macro_triangles_side_by_side_are_restricted_as_each_alone() {
        for (n, width) in [(4, 2), (8, 4), (14, 2), (32, 4)] {
            let each: Vec<_> = (0..width).map(|lane| vector(lattice::inner_count(n), 7 * lane)).collect();
            let mut fine = vec![[0.0; 2]; width * lattice::node_count(n)];
            let mut coarse = vec![[9.0; 2]; width * lattice::node_count(n / 2)];
            for (lane, y) in each.iter().enumerate() {
                for (i, j) in (1..n - 1).flat_map(|j| (1..n - j).map(move |i| (i, j))) {
                    fine[lattice::index(n, i, j) * width + lane] = y[lattice::row_start(n, j) + i - 1];
                }
            }
            restrict(n, width, &fine, &mut coarse);
            for (lane, y) in each.iter().enumerate() {
                let mut alone = vec![[5.0; 2]; lattice::node_count(n / 2)];
                restrict_inner(n, y, &mut alone);
                let found = coarse.iter().skip(lane).step_by(width);
                assert!(found.zip(&alone).all(|(a, b)| (0..2).all(|k| (a[k] - b[k]).abs() < 1e-14)), "n = {n}, lane {lane}");
            }
        }
    }
}
