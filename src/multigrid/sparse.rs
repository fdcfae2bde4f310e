//! Vectors most of whose values are zero.

/// Values at displacement unknowns or multipliers of this rank, by their places.
pub type Sparse = Vec<(u32, f64)>;

/// What of values is not zero.
pub fn sparse(values: &[f64]) -> Sparse {
    values.iter().enumerate().filter(|(_, value)| **value != 0.0).map(|(at, &value)| (at as u32, value)).collect()
}

/// The product of both.
pub fn dot(row: &Sparse, x: &[f64]) -> f64 {
    row.iter().map(|&(at, value)| value * x[at as usize]).sum()
}

/// Adds a multiple of the first to the second.
pub fn add_multiple(column: &Sparse, factor: f64, y: &mut [f64]) {
    column.iter().for_each(|&(at, value)| y[at as usize] += factor * value);
}
