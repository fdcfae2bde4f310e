//! All strips of a rank.

use super::strip_kernel::StripKernel;
use super::strips::{Couplings, StripNodes};
use std::ops::Range;

/// Strips of this rank, with what they have in common.
#[derive(Default)]
pub struct Strips {
    /// Couplings; few strips have their own.
    pub couplings: Vec<Couplings>,
    /// The work on each of these.
    pub kernels: Vec<Box<dyn StripKernel>>,
    /// The nodes of each strip.
    pub nodes: Vec<StripNodes>,
    /// Consecutive strips with the same couplings, and these.
    pub alike: Vec<(Range<usize>, usize)>,
    /// Those of each macro triangle.
    pub triangles: Vec<TriangleStrips>,
}

/// The inner nodes of a macro triangle, which couple to each other and to nodes on its sides alone.
#[derive(Clone, Debug)]
pub struct TriangleStrips {
    /// All of them.
    pub nodes: Range<usize>,
    /// Those of [`Strips::alike`] that lie in it.
    pub alike: Range<usize>,
}
