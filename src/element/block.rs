//! Blocks of two by two: couplings of two nodes, and frames.

use crate::geometry::Point;

/// Coupling of two nodes: `[row component][column component]`.
pub type Block = [[f64; 2]; 2];

/// The block that changes nothing.
pub const IDENTITY: Block = [[1.0, 0.0], [0.0, 1.0]];

/// Adds a block to another one.
#[inline(always)]
pub fn add(sum: &mut Block, block: &Block) {
    for a in 0..2 {
        for b in 0..2 {
            sum[a][b] += block[a][b];
        }
    }
}

/// A block the other way round.
#[inline(always)]
pub fn transpose([[a, b], [c, d]]: &Block) -> Block {
    [[*a, *c], [*b, *d]]
}

/// Inverse of a block, if it has one.
pub fn inverse(k: &Block) -> Option<Block> {
    // No product of entries leaves the range of numbers.
    let scale = 1.0 / k[0][0].abs().max(k[0][1].abs()).max(k[1][0].abs()).max(k[1][1].abs());
    let [[a, b], [c, d]] = [[k[0][0] * scale, k[0][1] * scale], [k[1][0] * scale, k[1][1] * scale]];
    let factor = scale / (a * d - b * c);
    let inverse = [[d * factor, -b * factor], [-c * factor, a * factor]];
    inverse.as_flattened().iter().all(|v| v.is_finite()).then_some(inverse)
}

/// Product of two blocks.
#[inline(always)]
pub fn product(a: &Block, b: &Block) -> Block {
    a.map(|row| [0, 1].map(|j| row[0] * b[0][j] + row[1] * b[1][j]))
}

/// Product of a block with a vector.
pub fn times(block: &Block, v: &Point) -> Point {
    Point::new(block[0][0] * v.x + block[0][1] * v.y, block[1][0] * v.x + block[1][1] * v.y)
}
