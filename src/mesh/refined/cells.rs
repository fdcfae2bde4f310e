//! Macro triangles cut into cells, all alike, so that something can be told to lie in one part of them or another.

use crate::mesh::refined::origin::Origin;

/// Cells along each side.
const INTERVALS: usize = 8;

/// A value for each cell of a macro triangle: how much of something lies there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cells([f64; INTERVALS * INTERVALS]);

impl Default for Cells {
    fn default() -> Self {
        Self::new(|_| 0.0)
    }
}

impl Cells {
    /// How many there are.
    pub const COUNT: usize = INTERVALS * INTERVALS;

    /// A value for each.
    pub fn new(value: impl Fn(usize) -> f64) -> Self {
        Self(std::array::from_fn(value))
    }

    /// Values that each cell gets from how much of two others it has.
    pub fn combined(&self, other: &Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Self(std::array::from_fn(|k| f(self.0[k], other.0[k])))
    }

    /// The values.
    pub fn values(&self) -> &[f64] {
        &self.0
    }

    /// All of it.
    pub fn sum(&self) -> f64 {
        self.0.iter().sum()
    }

    /// Adds what lies at a point, given by its barycentric coordinates.
    pub fn add(&mut self, point: [f64; 3], value: f64) {
        self.0[cell_at(point)] += value;
    }

    /// Multiplied by a factor.
    pub fn scaled(&self, factor: f64) -> Self {
        Self(self.0.map(|value| factor * value))
    }

    /// The share of a part of the triangle: each of its cells takes from the cell that its middle lies in.
    pub fn of_part(&self, part: &Origin) -> Self {
        let area = part.area();
        Self(std::array::from_fn(|k| area * self.0[cell_at(part.point(middle(k)))]))
    }
}

/// Cells before row `j`.
fn row_start(j: usize) -> usize {
    j * (2 * INTERVALS - j)
}

/// The cell that a point lies in.
fn cell_at([_, x, y]: [f64; 3]) -> usize {
    let n = INTERVALS as f64;
    let j = ((n * y).max(0.0) as usize).min(INTERVALS - 1);
    let i = ((n * x).max(0.0) as usize).min(INTERVALS - 1 - j);
    let is_down = i + j + 2 <= INTERVALS && n * (x + y) > (i + j + 1) as f64;
    row_start(j) + 2 * i + usize::from(is_down)
}

/// Middle of a cell.
fn middle(cell: usize) -> [f64; 3] {
    let j = (1..INTERVALS).take_while(|&j| row_start(j) <= cell).count();
    let (i, is_down) = ((cell - row_start(j)) / 2, (cell - row_start(j)) % 2 == 1);
    let third = if is_down { 2.0 } else { 1.0 } / 3.0;
    let [x, y] = [i, j].map(|k| (k as f64 + third) / INTERVALS as f64);
    [1.0 - x - y, x, y]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_cell_holds_its_middle() {
        for cell in 0..Cells::COUNT {
            let point = middle(cell);
            assert!(point.iter().all(|&l| l > 0.0) && (point.iter().sum::<f64>() - 1.0).abs() < 1e-15);
            assert_eq!(cell_at(point), cell);
        }
        for corner in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] {
            let inside = corner.map(|l| 0.9 * l + 0.1 / 3.0);
            assert_eq!(cell_at(corner), cell_at(inside), "a corner lies in the cell beside it");
        }
    }

    #[test]
    fn parts_share_what_the_whole_has() {
        let mut whole = Cells::new(|_| 3.0 / Cells::COUNT as f64);
        whole.add([0.9, 0.05, 0.05], 2.0);
        let (a, b, c, m) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.5, 0.5]);
        let halves = [[m, a, b], [m, c, a]].map(|corners| whole.of_part(&Origin { triangle: 0, corners }));
        assert!((halves[0].sum() + halves[1].sum() - 5.0).abs() < 1e-12, "{halves:?}");
        let (p, q) = ([0.5, 0.5, 0.0], [0.5, 0.0, 0.5]);
        let quarters = [[p, m, a], [p, b, m], [q, m, c], [q, a, m]];
        let quarters = quarters.map(|corners| whole.of_part(&Origin { triangle: 0, corners }).sum());
        assert!((quarters.iter().sum::<f64>() - 5.0).abs() < 1e-12);
        assert!((quarters[1] - 0.75).abs() < 1e-12 && (quarters[2] - 0.75).abs() < 1e-12, "far from the point: {quarters:?}");
    }
}
