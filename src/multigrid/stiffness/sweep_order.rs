//! In which order a sweep goes through the nodes of a rank.

use super::stored_rows::StoredRows;
use std::ops::Range;

/// Which halves of a symmetric Gauss-Seidel sweep.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SweepHalves {
    /// The forward half alone.
    Forward,
    /// The forward half alone, from zero, whatever the inner nodes of even macro triangles hold; all others hold zeros.
    ForwardFromZero,
    /// Both halves, the forward one first.
    Both,
}

/// Which stored rows belong to nodes on sides of macro triangles, and which lie inside of one.
///
/// A sweep goes forward through the sides, those first that need no node of another rank: meanwhile the values of these arrive.
/// Then it goes forward and backward through one macro triangle after the other, and backward through the sides. Macro triangles
/// do not couple to each other: so this is one symmetric sweep through all nodes, and on the way back those of a triangle are
/// still in the cache.
#[derive(Clone, Debug, Default)]
pub struct SweepOrder {
    /// Stored rows on sides that need no node of another rank.
    pub near_sides: Vec<Range<usize>>,
    /// The others.
    pub far_sides: Vec<Range<usize>>,
    /// Stored rows inside of each macro triangle.
    pub inside: Vec<Range<usize>>,
}

impl SweepOrder {
    /// Of the stored rows of some nodes; `inside` are the inner nodes of each macro triangle whose inner rows are stored, ascending.
    pub fn new(rows: &StoredRows, inside: &[Range<usize>]) -> Self {
        let at = |node: usize| rows.nodes.partition_point(|&stored| (stored as usize) < node);
        let inside: Vec<Range<usize>> = inside.iter().map(|nodes| at(nodes.start)..at(nodes.end)).collect();
        let starts = std::iter::once(0).chain(inside.iter().map(|range| range.end));
        let ends = inside.iter().map(|range| range.start).chain([rows.nodes.len()]);
        let mut sides = [Vec::new(), Vec::new()];
        for k in starts.zip(ends).flat_map(|(start, end)| start..end) {
            let of_kind: &mut Vec<Range<usize>> = &mut sides[usize::from(rows.needs_far(k))];
            match of_kind.last_mut().filter(|last| last.end == k) {
                Some(last) => last.end += 1,
                None => of_kind.push(k..k + 1),
            }
        }
        let [near_sides, far_sides] = sides;
        Self { near_sides, far_sides, inside }
    }
}
