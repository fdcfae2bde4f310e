//! Γ_C as a spline fitted between two bodies, where they touch or penetrate each other.

use super::smooth_side::SmoothSide;
use super::{Configuration, ContactBoundary, Pair};
use crate::geometry::{Curve, Point, Spline};
use std::ops::Range;

/// Before anything is solved, nodes closer to the other body than this share of the boundary's length count as touching.
const NEAR: f64 = 1e-3;

/// The same once displacements are known.
const TOUCHING: f64 = 1e-4;

/// Spans at most.
const MOST_SPANS: usize = 64;

/// Where two sides meet: what Γ_C is fitted to, and its ends.
#[derive(Clone, Debug, PartialEq)]
pub struct Meeting {
    /// Which stretch of each boundary.
    pub stretches: [usize; 2],
    /// Nodes of each that the curve is fitted to.
    pub nodes: [Range<usize>; 2],
    /// Parameters of the ends of Γ_C, on body 1's stretch.
    pub ends: [f64; 2],
}

/// Nodes of one stretch that are near the other body: first and last.
type Near = Option<[usize; 2]>;

impl Meeting {
    /// Where undeformed bodies touch, or are about to: the tolerance grows until both have two nodes in reach.
    ///
    /// # Errors
    /// Words, if they are far apart, or touch on more than one stretch.
    pub fn at_rest(sides: &[Vec<SmoothSide>; 2], pair: &Pair) -> Result<Self, String> {
        for factor in [1.0, 4.0, 16.0, 64.0] {
            if let Some(found) = Self::within(sides, pair, factor * NEAR)? {
                return Ok(found);
            }
        }
        let [first, second] = &pair.between;
        if let Some(x) = nearest_node(sides, 64.0 * NEAR) {
            return Err(format!(
                "curve = \"fit\", but \"{first}\" and \"{second}\" come near each other at one node only, at ({}, {}): a corner, or edges too long; refine the mesh there, or declare the curve",
                x.x, x.y
            ));
        }
        Err(format!(
            "curve = \"fit\", but \"{first}\" and \"{second}\" lie farther apart than 6 % of their length; move the bodies together, or declare the curve"
        ))
    }

    /// Where the bodies touch or penetrate each other as they lie now; nothing if they are apart.
    ///
    /// # Errors
    /// Words, if they touch on more than one stretch.
    pub fn now(sides: &[Vec<SmoothSide>; 2], pair: &Pair) -> Result<Option<Self>, String> {
        Self::within(sides, pair, TOUCHING)
    }

    fn within(sides: &[Vec<SmoothSide>; 2], pair: &Pair, share: f64) -> Result<Option<Self>, String> {
        let near: [Vec<Near>; 2] = [0, 1].map(|k| sides[k].iter().map(|side| near_nodes(side, &sides[1 - k], share)).collect());
        let mut stretches = [0; 2];
        for k in 0..2 {
            let Some(found) = only_stretch(&sides[k], &near[k]).map_err(|count| {
                format!(
                    "\"{}\" has corners of more than 20 degrees, and {count} of its smooth stretches touch \"{}\"; give each a name and a contact of its own",
                    pair.between[k], pair.between[1 - k]
                )
            })?
            else {
                return Ok(None);
            };
            stretches[k] = found;
        }
        let of = |k: usize| (&sides[k][stretches[k]], near[k][stretches[k]].unwrap_or([0; 2]));
        Ok(Some(Self::between([of(0), of(1)], stretches)))
    }

    /// From the first to the last node that is near, where both bodies have such nodes, and one element farther.
    fn between(sides: [(&SmoothSide, [usize; 2]); 2], stretches: [usize; 2]) -> Self {
        let [(first, own), (second, other)] = sides;
        let foot = |k: usize| first.nearest(second.points[k], Configuration::Deformed);
        let far = other.map(foot);
        let [low, high] = [far[0].min(far[1]), far[0].max(far[1])];
        let element = first.edge_length(own[0], own[1]).max(second.edge_length(other[0], other[1]));
        let ends = [first.parameters[own[0]].max(low) - element, first.parameters[own[1]].min(high) + element];
        let inside = |t: f64| t >= ends[0] - element && t <= ends[1] + element;
        let range = |count: usize, parameter: &dyn Fn(usize) -> f64| {
            let from = (0..count).find(|&k| inside(parameter(k))).unwrap_or(0);
            let to = (from..count).rev().find(|&k| inside(parameter(k))).unwrap_or(from);
            from..to + 1
        };
        let nodes = [range(first.points.len(), &|k| first.parameters[k]), range(second.points.len(), &foot)];
        Self { stretches, nodes, ends }
    }

    /// How deep nodes of body 1 lie in body 2 as they are now, more than `margin` beyond the ends of Γ_C.
    pub fn depth_beyond(&self, sides: &[Vec<SmoothSide>; 2], boundary: &ContactBoundary, margin: f64) -> f64 {
        let [first, second] = [0, 1].map(|k| &sides[k][self.stretches[k]]);
        let knots = boundary.knots();
        let [low, high] = [knots[0] - margin, knots[knots.len() - 1] + margin];
        let beyond = first.parameters.iter().zip(&first.points).filter(|(t, _)| **t < low || **t > high);
        let depth = beyond.filter_map(|(_, x)| second.outside(*x, 1e-9 * second.length())).map(|outside| -outside);
        depth.fold(0.0, f64::max)
    }

    /// Fits a spline to the nodes of both sides in a configuration: least squares, each node weighted by the length it
    /// stands for, so that a finer body does not pull the curve. Its parameter is that of body 1's stretch. Without a wish
    /// the data choose the number of spans. The range goes as far as both stretches do.
    ///
    /// # Errors
    /// Words, if the pair wants more spans than the nodes bear.
    pub fn fit(&self, sides: &[Vec<SmoothSide>; 2], pair: &Pair) -> Result<(Curve, [f64; 2]), String> {
        let configuration = pair.configuration;
        let both = [0, 1].map(|k| &sides[k][self.stretches[k]]);
        let mut samples: Vec<Sample> = Vec::new();
        for (k, side) in both.into_iter().enumerate() {
            samples.extend(self.nodes[k].clone().map(|node| {
                let x = side.positions(configuration)[node];
                let t = if k == 0 { side.parameters[node] } else { both[0].nearest(x, configuration) };
                (t, x, side.weight(node))
            }));
        }
        let most = (samples.len() / 4).max(1);
        if let Some(spans) = pair.spans.filter(|&spans| spans > most) {
            return Err(format!(
                "spans = {spans}: where they meet, \"{}\" and \"{}\" have {} nodes, which bear {most}; give {most} or fewer, or \"auto\", or refine the mesh",
                pair.between[0],
                pair.between[1],
                samples.len()
            ));
        }
        let curve = Curve::Spline(fit_by_the_data(&samples, pair.spans));
        let [mut first, mut last] = [f64::NEG_INFINITY, f64::INFINITY];
        for side in both {
            let positions = side.positions(configuration);
            let feet = [positions[0], positions[positions.len() - 1]].map(|x| curve.nearest(x));
            first = first.max(feet[0].min(feet[1]));
            last = last.min(feet[0].max(feet[1]));
        }
        Ok((curve, [first, last]))
    }
}

/// A node of either side that is near the other body.
fn nearest_node(sides: &[Vec<SmoothSide>; 2], share: f64) -> Option<Point> {
    let near = |side: &SmoothSide, others: &[SmoothSide]| {
        let close = |x: &&Point| others.iter().any(|other| other.is_near(**x, share * side.length().max(other.length())));
        side.points.iter().find(close).copied()
    };
    (0..2).find_map(|k| sides[k].iter().find_map(|side| near(side, &sides[1 - k])))
}

/// A node of the cloud: its parameter on body 1's boundary, its place, and the length it stands for.
type Sample = (f64, Point, f64);

/// First and last node of a side that is near some stretch of the other body.
fn near_nodes(side: &SmoothSide, others: &[SmoothSide], share: f64) -> Near {
    let near = |x: &Point| others.iter().any(|other| other.is_near(*x, share * side.length().max(other.length())));
    let first = side.points.iter().position(near)?;
    let last = side.points.iter().rposition(near)?;
    (last > first).then_some([first, last])
}

/// The stretch that touches; others may do so at a corner only. Nothing if none does.
///
/// # Errors
/// Number of stretches that touch, if there are several.
fn only_stretch(sides: &[SmoothSide], near: &[Near]) -> Result<Option<usize>, usize> {
    let length = |k: usize| near[k].map_or(0.0, |[a, b]| sides[k].parameters[b] - sides[k].parameters[a]);
    let longest = (0..sides.len()).max_by(|&a, &b| length(a).total_cmp(&length(b)));
    let Some(longest) = longest.filter(|&k| near[k].is_some()) else { return Ok(None) };
    match (0..sides.len()).filter(|&k| length(k) > 0.05 * length(longest)).count() {
        1 => Ok(Some(longest)),
        several => Err(several),
    }
}

/// The fewest spans whose mean distance from the samples is as small as that of any number, but for a half: more would
/// follow the scatter between the two bodies.
fn fit_by_the_data(samples: &[Sample], wish: Option<usize>) -> Spline {
    if let Some(spans) = wish {
        return Spline::fit(samples, spans);
    }
    let most = (samples.len() / 4).clamp(1, MOST_SPANS);
    let counts = std::iter::successors(Some(1), |count| (2 * count <= most).then_some(2 * count));
    let fits: Vec<(f64, Spline)> = counts
        .map(|count| {
            let spline = Spline::fit(samples, count);
            let squares: f64 = samples.iter().map(|(t, x, weight)| weight * (spline.point(*t) - x).norm_squared()).sum();
            (squares.sqrt(), spline)
        })
        .collect();
    let size = samples.iter().map(|(_, x, weight)| weight * x.norm_squared()).sum::<f64>().sqrt();
    let least = fits.iter().map(|fit| fit.0).fold(f64::INFINITY, f64::min);
    let good = fits.iter().position(|fit| fit.0 <= (1.5 * least).max(1e-14 * size)).unwrap_or(0);
    fits.into_iter().nth(good).map(|fit| fit.1).unwrap_or_else(|| Spline::fit(samples, 1))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn on_arc(radius: f64, count: usize) -> Vec<Sample> {
        let sample = |k: usize| {
            let a = k as f64 / count as f64;
            (a, Point::new(radius * a.sin(), radius * a.cos()), 1.0 / count as f64)
        };
        (0..=count).map(sample).collect()
    }

    #[test]
    fn the_data_choose_the_spans() {
        assert!(fit_by_the_data(&on_arc(1.0, 200), None).spans() >= 16, "an arc wants many");
        let straight: Vec<Sample> = (0..40).map(|k| (f64::from(k), Point::new(f64::from(k), 2.0), 1.0)).collect();
        assert_eq!(fit_by_the_data(&straight, None).spans(), 1);
        let mut scattered = on_arc(1.0, 60);
        scattered.extend(on_arc(1.01, 47));
        assert!(fit_by_the_data(&scattered, None).spans() <= 2, "scatter between two bodies is not followed");
        assert_eq!(fit_by_the_data(&on_arc(1.0, 200), Some(7)).spans(), 7);
    }
}
