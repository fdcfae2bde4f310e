//! Couplings of an interpolation.

use crate::element::Block;

/// What a fine node takes over of a coarse one.
#[derive(Clone, Copy)]
pub struct Parentage {
    /// The fine node.
    pub node: usize,
    /// The coarse one.
    pub parent: usize,
    /// Its share.
    pub weight: f64,
    /// What the fine node would take over of all of it, in their frames; none if these are the axes of the plane, in which both move
    /// freely.
    pub turned: Option<Block>,
}

impl Parentage {
    /// Of the whole of it, times the share.
    pub fn block(&self) -> Block {
        self.turned.unwrap_or([[1.0, 0.0], [0.0, 1.0]]).map(|row| row.map(|value| self.weight * value))
    }
}
