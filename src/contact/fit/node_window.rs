//! Which nodes of two sides lie between two ends of Γ_C, and some edges beyond: the curve half-way is fitted to those.

use crate::contact::pair::Configuration;
use crate::contact::smooth_side::SmoothSide;
use std::ops::Range;

/// The part of two sides between two ends of Γ_C, and some edges beyond.
pub struct NodeWindow<'a> {
    sides: [&'a SmoothSide; 2],
    configuration: Configuration,
    /// Parameters of body 1's side between which it lies.
    limits: [f64; 2],
}

impl<'a> NodeWindow<'a> {
    /// From so many edges before the first of these ends to as many behind the last, which are parameters of body 1's side.
    pub fn new(sides: [&'a SmoothSide; 2], configuration: Configuration, ends: [f64; 2], edges: f64) -> Self {
        let beyond = edges * longest_edge(sides, configuration, ends);
        Self { sides, configuration, limits: [ends[0] - beyond, ends[1] + beyond] }
    }

    /// Whether a node of one of the sides lies in it, on body 2's side by its foot on body 1's.
    fn holds(&self, k: usize, node: usize) -> bool {
        let [first, second] = self.sides;
        let parameter = match k {
            0 => first.parameters[node],
            _ => first.nearest(second.positions(self.configuration)[node], self.configuration),
        };
        (self.limits[0]..=self.limits[1]).contains(&parameter)
    }

    /// Leaves out nodes at the ends of the ranges that lie outside; where all do, the range stays.
    pub fn leave_outer(&self, nodes: &mut [Range<usize>; 2]) {
        for (k, range) in nodes.iter_mut().enumerate() {
            let mut kept = range.clone().filter(|&node| self.holds(k, node));
            if let Some(from) = kept.next() {
                *range = from..kept.next_back().unwrap_or(from) + 1;
            }
        }
    }

    /// Takes in nodes beside the ranges that lie inside and look at the other side.
    pub fn take_in(&self, nodes: &mut [Range<usize>; 2]) {
        for (k, range) in nodes.iter_mut().enumerate() {
            while range.start > 0 && self.faces(k, range.start - 1) {
                range.start -= 1;
            }
            while range.end < self.sides[k].points.len() && self.faces(k, range.end) {
                range.end += 1;
            }
        }
    }

    fn faces(&self, k: usize, node: usize) -> bool {
        let (side, other) = (self.sides[k], self.sides[1 - k]);
        let foot = other.nearest(side.positions(self.configuration)[node], self.configuration);
        self.holds(k, node) && side.looks_at(side.parameters[node], other, foot, self.configuration)
    }
}

/// The longest edge of both sides that Γ_C meets between these ends (length): long ones beside fine ones are no measure of it.
fn longest_edge([first, second]: [&SmoothSide; 2], configuration: Configuration, ends: [f64; 2]) -> f64 {
    let far = ends.map(|t| second.nearest(first.curve(configuration).point(t), configuration));
    let longest = |side: &SmoothSide, [a, b]: [f64; 2]| {
        let beside = |t: f64| side.parameters.partition_point(|parameter| *parameter < t);
        side.edge_length(beside(a.min(b)).saturating_sub(1), beside(a.max(b)))
    };
    longest(first, ends).max(longest(second, far))
}
