//! Pressures that are known without mezha: Lamé's of long rings, Hertz's of balls.

use super::case::{Heat, Round};
use crate::profile::Profile;
use crate::scene::{Gap, Press};
use crate::shape::Shape;
use std::f64::consts::{FRAC_PI_2, PI};

/// A long ring between two radii: its radial displacement is linear in both pressures.
struct Ring {
    radii: [f64; 2],
    young: f64,
    poisson: f64,
    /// Free thermal strain.
    growth: f64,
    /// Whether its ends are free to move, and stay plane; otherwise they are held.
    free: bool,
}

impl Ring {
    /// Radial displacement at a radius under pressures on the inner and on the outer side.
    fn moves(&self, r: f64, [inside, outside]: [f64; 2]) -> f64 {
        let Self { radii: [a, b], young, poisson: nu, growth, free } = *self;
        let area = b * b - a * a;
        let even = (inside * a * a - outside * b * b) / area;
        let around = a * a * b * b * (inside - outside) / area;
        let along = if free { growth - 2.0 * nu * even / young } else { 0.0 };
        (1.0 + nu) * ((1.0 - 2.0 * nu) * even * r + around / r) / young + ((1.0 + nu) * growth - nu * along) * r
    }
}

/// λ all along the seam of two rings whose ends all are held, or all stay plane; 0 where they do not meet. `None`: not such.
pub fn lame(round: &Round) -> Option<f64> {
    let scene = &round.scene;
    let even = |heat: &Option<Heat>| heat.is_none_or(|heat| heat.slope == 0.0);
    let whole = scene.bodies.iter().all(|body| body.walls == [true, true] && body.range == [0.0, 1.0] && body.seam.is_line());
    if !whole || scene.table || scene.frame.angle.abs() != FRAC_PI_2 || !round.hot.iter().all(even) {
        return None;
    }
    let gap = match (&scene.gap, scene.bodies[1].seam) {
        (Gap::Closed, _) => 0.0,
        (Gap::Number(gap), _) => *gap,
        (Gap::Drawn, Shape::Line { height }) => height,
        _ => return None,
    };
    let load = match scene.press {
        Press::Pressure { mean, tilt: 0.0 } => mean,
        Press::Sides => 0.0,
        _ => return None,
    };
    let seam = scene.frame.shift[0] / scene.frame.scale;
    // The lower body is the inner one of a frame that is turned to the right.
    let inner = if scene.frame.angle < 0.0 { 0 } else { 1 };
    let rings = [inner, 1 - inner].map(|k| {
        let body = &scene.bodies[k];
        let radii = if k == inner { [seam - body.depth, seam] } else { [seam, seam + body.depth] };
        let growth = round.hot[k].map_or(0.0, |heat| heat.strain);
        Ring { radii, young: body.young, poisson: body.poisson, growth, free: round.free_ends }
    });
    // The load is on the outer side of the upper body.
    let loads = if inner == 0 { [0.0, load] } else { [load, 0.0] };
    let opens = |p: f64| gap + rings[1].moves(seam, [p, loads[1]]) - rings[0].moves(seam, [loads[0], p]);
    Some((-opens(0.0) / (opens(1.0) - opens(0.0))).max(0.0) * scene.stress)
}

/// The same as a profile.
pub fn constant(pressure: f64, round: &Round) -> Profile {
    let frame = round.scene.frame;
    Profile::new(vec![[0.0, pressure], [1.0, pressure]], pressure * 2.0 * PI * frame.shift[0] * frame.scale)
}

/// Hertz's pressure of this force, in the units of the frame, between balls whose curvatures add up to this.
pub fn hertz(round: &Round, force: f64, bend: f64) -> Profile {
    let scene = &round.scene;
    let softness = scene.bodies.iter().map(|body| (1.0 - body.poisson * body.poisson) / body.young).sum::<f64>();
    let a = (0.75 * force * softness / bend).cbrt();
    let peak = 1.5 * force / (PI * a * a) * scene.stress;
    let at = |k: usize| {
        let u = a * (k as f64 / 400.0);
        [u, peak * (1.0 - (u / a).powi(2)).max(0.0).sqrt()]
    };
    Profile::new((0..=400).map(at).chain([[1.0, 0.0]]).collect(), force * scene.stress * scene.frame.scale.powi(2))
}
