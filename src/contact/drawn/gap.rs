//! How far apart the sides of a contact are drawn.

use crate::contact::pair::Pair;
use crate::contact::smooth_side::SmoothSide;
use crate::geometry::Point;
use crate::mesh::{MacroMesh, Numbering};

/// Sides that are nearer than this share of the shorter one are drawn touching, and a foot that lies no farther beyond an end is on it.
const TOUCHING: f64 = 1e-6;

/// Gaps at nodes lie on a parabola if their second differences differ by less than this share. At a corner one is larger than its
/// neighbours by far; beside a line, along a circle of thirty even nodes, they differ by 2 %.
const UNEVEN: f64 = 0.2;

/// The least gap between two sides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrawnGap {
    /// Along the normals at the place where the sides come nearest; negative where they reach into each other (length).
    pub least: f64,
    /// Length of the shorter side.
    pub length: f64,
}

impl DrawnGap {
    /// Whether the sides are drawn touching.
    pub fn touches(&self) -> bool {
        self.least.abs() <= TOUCHING * self.length
    }
}

/// The least gap between the sides of a contact where they face each other as they are drawn, curves taken as they are meant; nothing if
/// they face each other nowhere. All edges of the boundaries are on this rank.
pub fn drawn_gap(mesh: &MacroMesh, numbering: &Numbering, pair: &Pair) -> Option<DrawnGap> {
    let [first, second] = SmoothSide::of_pair(mesh, numbering, pair, &|_| Point::zeros());
    let both = || first.iter().flat_map(|one| second.iter().map(move |other| (one, other)));
    let length = both().map(|(one, other)| one.length().min(other.length())).fold(0.0, f64::max);
    let least = |one: &SmoothSide, other: &SmoothSide| {
        let gap = |node: usize| Some([one.parameters[node], one.facing_gaps(node, other, pair, TOUCHING * length)?.at_rest]);
        let gaps: Vec<Option<[f64; 2]>> = (0..one.nodes()).map(gap).collect();
        let at_nodes = gaps.iter().flatten().map(|[_, gap]| *gap);
        at_nodes.chain(gaps.windows(5).filter_map(least_between)).reduce(f64::min)
    };
    let least = both().flat_map(|(one, other)| [least(one, other), least(other, one)]).flatten().reduce(f64::min)?;
    Some(DrawnGap { least, length })
}

/// The least gap about the third of five nodes, where these gaps lie on a parabola, nearly: from their parameters and gaps.
fn least_between(nodes: &[Option<[f64; 2]>]) -> Option<f64> {
    let [a, b, c, d, e] = nodes else { return None };
    let [a, b, c, d, e] = [(*a)?, (*b)?, (*c)?, (*d)?, (*e)?];
    let slope = |[t, g]: [f64; 2], [u, h]: [f64; 2]| (h - g) / (u - t);
    let bend =
        |first: [f64; 2], middle: [f64; 2], last: [f64; 2]| (slope(middle, last) - slope(first, middle)) / (last[0] - first[0]);
    let bends = [bend(a, b, c), bend(b, c, d), bend(c, d, e)];
    let is_even = bends[1] > 0.0 && bends.iter().all(|bend| (bend / bends[1] - 1.0).abs() < UNEVEN);
    // Slope of the parabola through three of them at the middle one.
    let at_middle = slope(b, c) + bends[1] * (c[0] - b[0]);
    let way = -at_middle / (2.0 * bends[1]);
    (is_even && (b[0]..=d[0]).contains(&(c[0] + way))).then(|| c[1] - bends[1] * way * way)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_round_gap_is_found_between_nodes_and_a_corner_is_none() {
        let at = |gap: fn(f64) -> f64| [-0.2, -0.09, 0.01, 0.1, 0.22].map(|t| Some([t, gap(t)]));
        let found = least_between(&at(|t| 1.0 - (1.0 - (t - 0.03).powi(2)).sqrt() - 1e-3)).expect("a minimum");
        assert!((found + 1e-3).abs() < 1e-5, "{found}");
        assert_eq!(least_between(&at(f64::abs)), None);
        assert_eq!(least_between(&at(|t| (t - 1.0).powi(2))), None, "it is elsewhere");
        let mut open = at(|t| t * t);
        open[4] = None;
        assert_eq!(least_between(&open), None);
    }
}
