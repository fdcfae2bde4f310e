//! Scenes drawn by lot, the same ones from the same number.

use crate::layers::{Layers, Peak};
use crate::scene::{Body, Bump, Gap, Press, Scene, Settings};
use crate::shape::{Frame, Shape};
use crate::support::mesh::Random;
use std::f64::consts::PI;

/// A lottery over [`Random`].
pub struct Lot(Random);

impl Lot {
    pub fn new(seed: u64) -> Self {
        let mut random = Random(seed.wrapping_mul(0x2545_f491_4f6c_dd1d));
        random.next();
        Self(random)
    }

    pub fn between(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * self.0.next()
    }

    /// Every factor as often.
    pub fn factor(&mut self, from: f64, to: f64) -> f64 {
        self.between(from.ln(), to.ln()).exp()
    }

    pub fn chance(&mut self, share: f64) -> bool {
        self.0.next() < share
    }

    pub fn one<T: Copy>(&mut self, of: &[T]) -> T {
        of[((self.0.next() * of.len() as f64) as usize).min(of.len() - 1)]
    }
}

/// A scene and how it is asked for.
pub fn draw(seed: u64) -> (Scene, Settings) {
    let mut lot = Lot::new(seed);
    let frame = frame(&mut lot);
    let stress = lot.one(&[1.0, 1.0, 1e3, 2.1e5, 2.1e11]);
    let ratio = lot.factor(1e-3, 1e3);
    let young = if lot.chance(0.3) { [1.0, 1.0] } else { [ratio.max(1.0), (1.0 / ratio).max(1.0)] };
    let poisson = [lot.between(0.0, 0.45), lot.between(0.0, 0.45)];
    let depth = [lot.factor(0.25, 1.0), lot.factor(0.25, 1.0)];
    let body =
        |k: usize, seam, walls| Body { seam, range: [0.0, 1.0], depth: depth[k], young: young[k], poisson: poisson[k], walls };
    let softness = (0..2).map(|k| (1.0 - poisson[k] * poisson[k]) / young[k]).sum::<f64>();
    let mean = lot.factor(1e-4, 3e-3);
    let kind = lot.between(0.0, 1.0);
    let mut scene = Scene {
        frame,
        stress,
        bodies: [0, 1].map(|k| body(k, Shape::Line { height: 0.0 }, [true, lot.chance(0.5)])),
        gap: Gap::Closed,
        press: Press::Pressure { mean, tilt: lot.one(&[0.0, 0.3, -0.6]) },
        table: true,
        drawn_aside: 0.0,
        focus: Vec::new(),
    };
    if kind < 0.35 {
        drawn(&mut scene, &mut lot, softness);
    } else {
        if kind < 0.55 {
            curve(&mut scene, &mut lot);
        } else if kind < 0.7 {
            ring(&mut scene, &mut lot, mean);
        } else if lot.chance(0.25) {
            scene.bodies[1].range = [0.0, lot.between(0.4, 0.8)];
        }
        declared_gap(&mut scene, &mut lot, softness, mean);
    }
    let settings = settings(&scene, &mut lot, seed);
    if lot.chance(0.04) && scene.bodies.iter().all(|body| body.seam.is_line()) && !matches!(scene.press, Press::Sides) {
        scene.bodies[1].walls = [false, false];
    }
    (scene, settings)
}

fn frame(lot: &mut Lot) -> Frame {
    if lot.chance(0.3) {
        return Frame::PLAIN;
    }
    let angle = if lot.chance(0.5) { 0.0 } else { lot.between(-PI, PI) };
    let scale = lot.one(&[1e-3, 1.0, 25.0, 1e3, 1e6]);
    Frame { scale, angle, shift: [scale * lot.between(-3.0, 3.0), scale * lot.between(-3.0, 3.0)] }
}

/// Round bodies drawn apart, or touching: the gap is measured.
pub fn drawn(scene: &mut Scene, lot: &mut Lot, softness: f64) {
    let half_width = lot.factor(0.03, 0.2);
    let peak = lot.factor(2e-4, 5e-3);
    let bend = 2.0 * peak * softness / half_width;
    let middle = lot.one(&[0.5, 0.42, 0.61]);
    let apart = if lot.chance(0.3) { lot.factor(0.01, 1.0) * bend * half_width * half_width } else { 0.0 };
    let base = lot.one(&[0.0, 0.0, 1.0, -0.5]) * bend;
    let round = lot.chance(0.5);
    let shape = |bend: f64, height: f64| match (bend == 0.0, round) {
        (true, _) => Shape::Line { height },
        (_, true) if bend.abs() < 1.0 => Shape::Cap { height, radius: 1.0 / bend, middle },
        _ => Shape::Parabola { height, bend: 0.5 * bend, middle },
    };
    let (lower, upper) = if lot.chance(0.25) {
        (
            Shape::Line { height: 0.0 },
            Shape::Wave { height: apart, rise: 2.0 * bend / (4.0 * PI * PI * 4.0), count: 2.0, phase: lot.between(0.0, 1.0) },
        )
    } else if lot.chance(0.5) {
        (shape(base, 0.0), shape(base + bend, apart))
    } else {
        (shape(base - bend, 0.0), shape(base, apart))
    };
    (scene.bodies[0].seam, scene.bodies[1].seam) = (lower, upper);
    scene.gap = Gap::Drawn;
    if let Shape::Wave { phase, .. } = upper {
        for k in 0..3 {
            let at = (phase + k as f64) / 2.0;
            if at < 1.0 {
                scene.focus.push(Peak { at, reach: 1.3 * half_width, edge: half_width / 8.0 });
            }
        }
    } else {
        scene.focus.push(Peak { at: middle, reach: 1.3 * half_width, edge: half_width / 8.0 });
    }
    let mean = 0.5 * PI * peak * half_width * scene.focus.len() as f64;
    scene.press = Press::Pressure { mean, tilt: 0.0 };
    if !matches!(upper, Shape::Wave { .. }) && lot.chance(0.3) {
        scene.drawn_aside = lot.between(-0.4, 0.4) * half_width;
    }
}

/// Both bodies along one parabola.
pub fn curve(scene: &mut Scene, lot: &mut Lot) {
    let shape = Shape::Parabola { height: 0.0, bend: lot.between(-0.4, 0.4), middle: lot.between(0.0, 1.0) };
    for body in &mut scene.bodies {
        body.seam = shape;
        body.depth = body.depth.max(0.6);
    }
}

/// A part of two rings.
pub fn ring(scene: &mut Scene, lot: &mut Lot, mean: f64) {
    let from = lot.between(0.0, 1.0);
    let to = from + lot.between(0.5, 1.6);
    let radius = lot.between(0.8, 2.0);
    for body in &mut scene.bodies {
        body.seam = Shape::Arc { radius, from, to };
        body.depth = lot.between(0.2, 0.6) * radius;
        body.walls = [true, true];
    }
    scene.table = false;
    scene.press = Press::Pressure { mean, tilt: 0.0 };
}

pub fn declared_gap(scene: &mut Scene, lot: &mut Lot, softness: f64, mean: f64) {
    let ring = matches!(scene.bodies[0].seam, Shape::Arc { .. });
    let length = scene.bodies[0].seam.length();
    let [begin, end] = scene.ends();
    let stiffness = 1.0 / (0..2).map(|k| scene.bodies[k].depth / scene.bodies[k].young).sum::<f64>();
    let kind = lot.between(0.0, 1.0);
    if kind < 0.2 {
        if !ring && lot.chance(0.6) {
            scene.press = Press::Bump { peak: mean * 3.0, at: lot.between(begin, end), width: lot.between(0.1, 0.4) };
        }
    } else if kind < 0.35 {
        scene.gap = Gap::Number(-mean / stiffness);
        if !ring {
            scene.press = Press::Move(0.0);
        } else if lot.chance(0.5) {
            scene.press = Press::Sides;
        }
    } else if kind < 0.5 {
        let gap = lot.between(0.1, 1.0) * mean / stiffness;
        scene.gap = Gap::Number(gap);
        if !ring && lot.chance(0.4) {
            scene.press = Press::Move(gap + mean / stiffness);
        }
    } else {
        let count = lot.one(&[1, 2, 3]);
        let share = (end - begin) / count as f64;
        let reached = lot.factor(0.05, 1.2);
        let rise = mean * share * length * softness / (PI * reached);
        let bump = |k: usize, lot: &mut Lot| {
            let width = length * share * lot.factor(0.08, 0.6);
            let at = begin + share * (k as f64 + lot.between(0.3, 0.7));
            Bump { at, width, share: if k == 0 { 1.0 } else { lot.one(&[1.0, 1.0, 0.8]) } }
        };
        let bumps: Vec<Bump> = (0..count).map(|k| bump(k, lot)).collect();
        scene.focus = bumps
            .iter()
            .map(|bump| (bump.at, bump.width / length))
            .map(|(at, width)| Peak { at, reach: width, edge: width / 8.0 })
            .collect();
        let base = if lot.chance(0.25) { lot.between(0.9, 1.05) } else { 1.0 };
        scene.gap = Gap::Bumps { rise, base, bumps };
        if !ring && lot.chance(0.2) {
            scene.press = Press::Bump { peak: mean * 2.0, at: lot.between(begin, end), width: lot.between(0.2, 0.5) };
        }
    }
}

pub fn settings(scene: &Scene, lot: &mut Lot, seed: u64) -> Settings {
    let order = lot.one(&[1, 2]);
    let refine: usize = lot.one(&[1, 2, 2, 3]);
    let finest = if order == 1 { 400.0 } else { 220.0 } * lot.between(0.3, 1.0);
    let across = lot.factor(1.0, 20.0);
    let [fine, coarse] = [finest, finest / across].map(|count| ((count / f64::powi(2.0, refine as i32)) as usize).max(5));
    let counts = if lot.chance(0.5) { [fine, coarse] } else { [coarse, fine] };
    let length = scene.bodies[0].seam.length();
    let layers = [0, 1].map(|k| {
        let body = &scene.bodies[k];
        let own = length * (body.range[1] - body.range[0]);
        let count = ((counts[k] as f64 * (body.range[1] - body.range[0])) as usize).max(4);
        Layers::even(count, body.depth / own, lot.between(0.0, 0.25), seed * 2 + k as u64)
    });
    let straight = scene.bodies.iter().all(|body| body.seam.is_line());
    let conforming = scene.bodies[0].seam == scene.bodies[1].seam;
    let curve = match (conforming, straight) {
        (true, _) if lot.chance(0.3) => "fit",
        (true, true) => "line",
        (true, false) => "geometry",
        (false, _) => "fit",
    };
    let edges = counts[if scene.bodies[0].young < scene.bodies[1].young { 0 } else { 1 }] << refine;
    let segments = if lot.chance(0.65) { None } else { Some(((edges as f64 * lot.factor(0.05, 2.0)) as usize).max(2)) };
    let measured = matches!(scene.gap, Gap::Drawn);
    Settings {
        order,
        refine,
        space: lot.one(&["p0", "p1-discontinuous", "p1-continuous"]),
        segments,
        curve,
        deformed: curve == "fit" && measured && lot.chance(0.5),
        swapped: lot.chance(0.5),
        ranks: 1 + (seed % 3) as usize,
        layers,
    }
}
