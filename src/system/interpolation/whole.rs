//! Interpolation inside a macro triangle from lattice to lattice.

use crate::system::space::Real;
use crate::system::triangle_lattice::row_start;
use std::ops::Range;

/// Values of the inner nodes of a fine lattice with `n` intervals, row by row, from those of a coarse lattice; they are added to
/// those of `y`, or take their place.
pub fn prolong<T: Real, const ADD: bool>(n: usize, coarse: &[[T; 2]], y: &mut [[T; 2]]) {
    pulp::Arch::new().dispatch(
        #[inline(always)]
        || {
            let mut next = 0;
            for j in 1..n - 1 {
                let count = n - 1 - j;
                prolong_row::<T, ADD>(n, j, coarse, &mut y[next..next + count]);
                next += count;
            }
        },
    );
}

#[inline(always)]
fn prolong_row<T: Real, const ADD: bool>(n: usize, j: usize, coarse: &[[T; 2]], y: &mut [[T; 2]]) {
    let half = T::of(0.5);
    let put = |to: &mut [T; 2], a: [T; 2], b: [T; 2]| {
        for k in 0..2 {
            let mean = half * (a[k] + b[k]);
            to[k] = if ADD { to[k] + mean } else { mean };
        }
    };
    let row = |b: usize| &coarse[row_start(n / 2, b)..][..n / 2 + 1 - b];
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

/// What the transposed interpolation makes of a fine lattice, which is zero on its sides, in all of a coarse one.
pub fn restrict<T: Real>(n: usize, fine: &[[T; 2]], coarse: &mut [[T; 2]]) {
    pulp::Arch::new().dispatch(
        #[inline(always)]
        || {
            for b in 0..n / 2 {
                let to = row_start(n / 2, b);
                restrict_row(n, b, fine, &mut coarse[to..=to + n / 2 - b]);
            }
            coarse[row_start(n / 2, n / 2)] = [T::default(); 2];
        },
    );
}

#[inline(always)]
fn restrict_row<T: Real>(n: usize, b: usize, fine: &[[T; 2]], sums: &mut [[T; 2]]) {
    let half = T::of(0.5);
    // Beyond the ends of rows there are zeros: nodes on the sides.
    let pairs = |j: usize, first: isize| -> &[[[T; 2]; 2]] {
        let start = row_start(n, j).wrapping_add_signed(first);
        fine[start..start + 2 * sums.len()].as_chunks().0
    };
    let places: Range<usize> = 0..sums.len();
    let above = pairs(2 * b + 1, -1);
    if b == 0 {
        for a in places {
            sums[a] = [0, 1].map(|k| half * (above[a][0][k] + above[a][1][k]));
        }
        return;
    }
    let (before, own, below) = (pairs(2 * b, -1), pairs(2 * b, 0), pairs(2 * b - 1, 0));
    for a in places {
        sums[a] = [0, 1].map(|k| {
            let beside = (before[a][0][k] + own[a][1][k]) + (below[a][0][k] + below[a][1][k]);
            own[a][0][k] + half * (beside + (above[a][0][k] + above[a][1][k]))
        });
    }
}
