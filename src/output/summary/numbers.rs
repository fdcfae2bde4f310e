//! Vectors of `summary.json` read back.

use serde::{Deserialize, Deserializer};

/// Reads a vector whose numbers may be null; those become NaN.
pub(super) fn numbers<'de, D, const N: usize>(source: D) -> Result<Option<[f64; N]>, D::Error>
where
    D: Deserializer<'de>,
    [Option<f64>; N]: Deserialize<'de>,
{
    let vector = Option::<[Option<f64>; N]>::deserialize(source)?;
    Ok(vector.map(|vector| vector.map(|number| number.unwrap_or(f64::NAN))))
}
