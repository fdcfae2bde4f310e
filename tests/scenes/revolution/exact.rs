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
    /// Whether its ends move apart as they like, and stay plane; otherwise they are held.
    free: bool,
}

/// λ all along the seam, and how far the ends of both rings move apart, by their length.
pub struct Lame {
    pub pressure: f64,
    pub along: [f64; 2],
}

impl Ring {
    /// Half of the sum of both stresses across the axis under pressures on the inner and on the outer side.
    fn even(&self, [inside, outside]: [f64; 2]) -> f64 {
        let [a, b] = self.radii;
        (inside * a * a - outside * b * b) / (b * b - a * a)
    }

    /// Strain along the axis.
    fn along(&self, pressures: [f64; 2]) -> f64 {
        if self.free { self.growth - 2.0 * self.poisson * self.even(pressures) / self.young } else { 0.0 }
    }

    /// Radial displacement at a radius.
    fn moves(&self, r: f64, pressures: [f64; 2]) -> f64 {
        let Self { radii: [a, b], young, poisson: nu, growth, .. } = *self;
        let around = a * a * b * b * (pressures[0] - pressures[1]) / (b * b - a * a);
        let (even, along) = (self.even(pressures), self.along(pressures));
        (1.0 + nu) * ((1.0 - 2.0 * nu) * even * r + around / r) / young + ((1.0 + nu) * growth - nu * along) * r
    }
}

/// Two rings whose ends are all held, or all free and plane; λ is 0 where they do not meet. `None`: the scene is no such.
pub fn lame(round: &Round, free: bool) -> Option<Lame> {
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
        Ring { radii, young: body.young, poisson: body.poisson, growth, free }
    });
    // The load is on the outer side of the upper body.
    let loads = if inner == 0 { [0.0, load] } else { [load, 0.0] };
    let on = |p: f64| [[loads[0], p], [p, loads[1]]];
    let opens = |p: f64| gap + rings[1].moves(seam, on(p)[1]) - rings[0].moves(seam, on(p)[0]);
    let pressure = (-opens(0.0) / (opens(1.0) - opens(0.0))).max(0.0);
    let along = [0, 1].map(|k| rings[k].along(on(pressure)[k]));
    Some(Lame { pressure: pressure * scene.stress, along: if inner == 0 { along } else { [along[1], along[0]] } })
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
