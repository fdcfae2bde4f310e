//! Smooth convex bodies by their support functions: discs, and triangles, squares, ... with round corners.

use crate::support::mesh::Block;
use std::f64::consts::{PI, TAU};

/// `h(θ) = size (1 + wave cos m(θ - turn))` is how far a body reaches from its centre along θ; m is the number of its corners.
#[derive(Clone, Copy, Debug)]
pub struct Round {
    pub centre: [f64; 2],
    pub size: f64,
    pub wave: f64,
    pub corners: f64,
    pub turn: f64,
}

/// Along an angle.
pub fn direction(angle: f64) -> [f64; 2] {
    [angle.cos(), angle.sin()]
}

pub fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

pub fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

pub fn minus(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

impl Round {
    /// How far it reaches along an angle, the slope of that, and its second derivative.
    pub fn reach(&self, angle: f64) -> [f64; 3] {
        let (s, c) = (self.corners * (angle - self.turn)).sin_cos();
        let (size, m) = (self.size, self.corners);
        [size * (1.0 + self.wave * c), -size * self.wave * m * s, -size * self.wave * m * m * c]
    }

    /// The point of the boundary whose outward normal has an angle.
    pub fn point(&self, angle: f64) -> [f64; 2] {
        let ([reach, slope, _], [c, s]) = (self.reach(angle), direction(angle));
        [self.centre[0] + reach * c - slope * s, self.centre[1] + reach * s + slope * c]
    }

    /// Its area: `∫ h (h + h'') dθ / 2`.
    pub fn area(&self) -> f64 {
        PI * self.size.powi(2) * (1.0 - 0.5 * self.wave.powi(2) * (self.corners.powi(2) - 1.0))
    }

    /// The distance of another one, below zero where they overlap, and the angle of the normal towards it: the largest
    /// `(c₂ - c₁)·n - h₁(θ) - h₂(θ + π)`.
    pub fn apart(&self, other: &Self) -> (f64, f64) {
        let way = minus(other.centre, self.centre);
        let at = |angle: f64| {
            let (a, b, n) = (self.reach(angle), other.reach(angle + PI), direction(angle));
            let along = [dot(way, n), cross(n, way), -dot(way, n)];
            [0, 1, 2].map(|k| along[k] - a[k] - b[k])
        };
        let samples = (0..64).map(|k| TAU * k as f64 / 64.0);
        let best = samples.max_by(|a, b| at(*a)[0].total_cmp(&at(*b)[0])).unwrap_or_default();
        let angle = (0..30).fold(best, |angle, _| {
            let [_, slope, bend] = at(angle);
            angle - (slope / bend).clamp(-0.05, 0.05)
        });
        (at(angle)[0], angle)
    }

    /// Its shape as formulas of t.
    pub fn formulas(&self) -> [String; 2] {
        let Self { centre: [x, y], size, wave, corners, turn } = self;
        let (reach, slope) = (
            format!("(1 + {wave:?}*cos({corners:?}*(t - {turn:?})))"),
            format!("({:?}*sin({corners:?}*(t - {turn:?})))", wave * corners),
        );
        [
            format!("{x:?} + {size:?}*({reach}*cos(t) + {slope}*sin(t))"),
            format!("{y:?} + {size:?}*({reach}*sin(t) - {slope}*cos(t))"),
        ]
    }

    /// Triangles between closed rows of nodes, `count` on the boundary; its first side is all of the boundary.
    pub fn mesh(&self, count: usize) -> Block {
        let edge = TAU / count as f64;
        let (mut points, mut triangles, mut rows) = (Vec::new(), Vec::new(), Vec::new());
        let mut share = 1.0;
        while share > 0.7 * edge {
            let number = ((count as f64 * share).round() as usize).max(5);
            let first = points.len();
            points.extend((0..number).map(|k| {
                let rim = self.point(TAU * k as f64 / number as f64);
                [0, 1].map(|c| self.centre[c] + share * (rim[c] - self.centre[c]))
            }));
            rows.push((first, number));
            share -= 0.9 * edge;
        }
        points.push(self.centre);
        rows.push((points.len() - 1, 1));
        for pair in rows.windows(2) {
            triangles.extend(between(pair[0], pair[1]));
        }
        let rim = (0..count).map(|k| [k, (k + 1) % count]).collect();
        Block { points, triangles, sides: [rim, Vec::new(), Vec::new(), Vec::new()] }
    }
}

/// Triangles between two closed rows (first node, number of nodes), the second one inside.
fn between((a, n): (usize, usize), (b, m): (usize, usize)) -> Vec<[usize; 3]> {
    let (mut i, mut j, mut triangles) = (0, 0, Vec::new());
    let m_steps = if m == 1 { 0 } else { m };
    while i < n || j < m_steps {
        let outer = j == m_steps || i < n && (i + 1) * m <= (j + 1) * n;
        if outer {
            triangles.push([a + i % n, a + (i + 1) % n, b + j % m]);
            i += 1;
        } else {
            triangles.push([a + i % n, b + (j + 1) % m, b + j % m]);
            j += 1;
        }
    }
    triangles
}
