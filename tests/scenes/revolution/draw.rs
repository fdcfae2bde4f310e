//! Scenes of revolution drawn by lot, the same ones from the same number.

use super::case::{Heat, Round, Upper};
use super::exact;
use crate::draw::{self, Lot};
use crate::layers::{Layers, Peak};
use crate::scene::{Body, Gap, Press, Scene, Settings};
use crate::shape::{Frame, Shape};
use std::f64::consts::{FRAC_PI_2, PI};

/// A scene and how it is asked for.
pub fn draw(seed: u64) -> (Round, Settings) {
    let mut lot = Lot::new(seed);
    let scale = lot.one(&[1.0, 1.0, 1e-3, 25.0, 1e3]);
    let ratio = lot.factor(1e-3, 1e3);
    let young = if lot.chance(0.3) { [1.0, 1.0] } else { [ratio.max(1.0), (1.0 / ratio).max(1.0)] };
    let bodies = [0, 1].map(|k| Body {
        seam: Shape::Line { height: 0.0 },
        range: [0.0, 1.0],
        depth: lot.factor(0.25, 1.0),
        young: young[k],
        poisson: if lot.chance(0.15) { 0.49 } else { lot.between(0.0, 0.45) },
        walls: [true, lot.chance(0.5)],
    });
    let scene = Scene {
        frame: Frame { scale, ..Frame::PLAIN },
        stress: lot.one(&[1.0, 1e3, 2.1e5, 1e-6, 1e9]),
        bodies,
        gap: Gap::Closed,
        press: Press::Sides,
        table: true,
        drawn_aside: 0.0,
        focus: Vec::new(),
    };
    let bare_axis = lot.chance(0.5);
    let mut round = Round {
        kind: "",
        scene,
        upper: Upper::Body,
        hot: [None, None],
        bare_axis: false,
        ends: [0.0; 2],
        accuracy: None,
        tolerance: 1e-11,
        exact: None,
    };
    let kind = lot.between(0.0, 1.0);
    if kind < 0.3 {
        round.bare_axis = bare_axis;
        balls(&mut round, &mut lot);
    } else if kind < 0.55 {
        rings(&mut round, &mut lot);
    } else if kind < 0.82 {
        fit(&mut round, &mut lot);
    } else {
        round.bare_axis = bare_axis;
        tool(&mut round, &mut lot);
    }
    if round.kind != "fit" && lot.chance(0.15) {
        let k = if round.is_tool() { 0 } else { lot.one(&[0, 1]) };
        round.hot[k] = Some(Heat { strain: lot.one(&[1.0, -1.0]) * lot.factor(1e-4, 2e-3), slope: lot.one(&[0.0, 0.3]) });
        round.exact = None;
    }
    let mut settings = draw::settings(&round.scene, &mut lot, seed);
    if settings.curve == "fit" && round.is_tool() && !settings.deformed {
        settings.curve = lot.one(&["fit", "rigid.tool"]);
    }
    // As a user draws it: finer about the point of contact.
    for (body, layers) in round.scene.bodies.iter().zip(&mut settings.layers).filter(|_| round.scene.frame.angle == 0.0) {
        let (peaks, edges) = (&round.scene.focus, lot.factor(0.8, 2.5));
        let own = |peak: &Peak| Peak { edge: peak.edge / edges * f64::powi(2.0, settings.refine as i32), ..*peak };
        layers.peaks = peaks.iter().filter(|_| body.range == [0.0, 1.0]).map(own).collect();
    }
    if lot.chance(0.2) {
        round.accuracy = Some(lot.one(&[1e-2, 2e-2]));
        settings.refine = 1;
        settings.layers = [0, 1].map(|k| Layers::even(lot.one(&[6, 9, 14]), settings.layers[k].depth, 0.1, seed * 2 + k as u64));
    }
    (round, settings)
}

fn softness(scene: &Scene) -> f64 {
    scene.bodies.iter().map(|body| (1.0 - body.poisson * body.poisson) / body.young).sum()
}

/// Round bodies on the axis: balls on blocks, balls and hollows.
fn balls(round: &mut Round, lot: &mut Lot) {
    round.kind = "balls";
    let a = lot.factor(0.03, 0.2);
    let peak = lot.factor(2e-4, 3e-3);
    let scene = &mut round.scene;
    // Hertz: p₀ = 2 E* a/πR.
    let bend = FRAC_PI_2 * peak * softness(scene) / a;
    let base = bend * if bend < 0.15 { lot.one(&[0.0, 0.0, 1.0, -0.5, 3.0]) } else { 0.0 };
    let apart = if lot.chance(0.3) { lot.factor(0.01, 1.0) * bend * a * a } else { 0.0 };
    let round_shape = lot.chance(0.7);
    let shape = |bend: f64, height: f64| match (bend == 0.0, round_shape) {
        (true, _) => Shape::Line { height },
        (_, true) => Shape::Cap { height, radius: 1.0 / bend, middle: 0.0 },
        _ => Shape::Parabola { height, bend: 0.5 * bend, middle: 0.0 },
    };
    let (lower, upper) = if lot.chance(0.5) { (base, base + bend) } else { (base - bend, base) };
    (scene.bodies[0].seam, scene.bodies[1].seam) = (shape(lower, 0.0), shape(upper, apart));
    for body in &mut scene.bodies {
        body.depth = body.depth.max(0.6);
    }
    scene.gap = Gap::Drawn;
    scene.focus.push(Peak { at: 0.0, reach: 1.3 * a, edge: a / 8.0 });
    let force = 2.0 / 3.0 * PI * peak * a * a;
    match lot.one(&[0, 0, 1, 1, 2]) {
        0 => scene.press = Press::Pressure { mean: force / PI, tilt: 0.0 },
        1 => round.upper = Upper::Plate(force),
        _ => scene.press = Press::Move(apart + bend * a * a),
    }
    if a < 0.06 && !matches!(scene.press, Press::Move(_)) {
        round.exact = Some(exact::hertz(round, force, bend));
    }
}

/// Rings beside the axis, one above the other or pressed together by cones.
fn rings(round: &mut Round, lot: &mut Lot) {
    round.kind = "rings";
    let scene = &mut round.scene;
    scene.frame.angle = lot.one(&[0.0, 1.0, -1.0]) * lot.between(0.1, 1.2);
    let (soft, mean) = (softness(scene), lot.factor(1e-4, 3e-3));
    scene.press = Press::Pressure { mean, tilt: lot.one(&[0.0, 0.0, 0.3]) };
    let kind = lot.between(0.0, 1.0);
    if kind < 0.35 {
        draw::drawn(scene, lot, soft);
        scene.drawn_aside = 0.0;
    } else {
        if kind < 0.55 {
            draw::curve(scene, lot);
        } else if kind < 0.7 {
            draw::ring(scene, lot, mean);
        } else if lot.chance(0.3) {
            scene.bodies[1].range = [0.0, lot.between(0.4, 0.8)];
        }
        draw::declared_gap(scene, lot, soft, mean);
    }
    let coarse = [0, 1].map(|k| Layers::even(20, scene.bodies[k].depth, 0.0, 1));
    let points = scene.blocks(&coarse).into_iter().flat_map(|(_, block, _)| block.points);
    let least = points.map(|[x, _]| x).fold(f64::INFINITY, f64::min);
    scene.frame.shift = [scene.frame.scale * lot.factor(0.1, 3.0) - least, scene.frame.scale * lot.between(-2.0, 2.0)];
}

/// One body around another.
fn fit(round: &mut Round, lot: &mut Lot) {
    round.kind = "fit";
    let scene = &mut round.scene;
    let radius = lot.factor(0.3, 3.0);
    let side = lot.one(&[-1.0, 1.0]);
    scene.frame.angle = side * FRAC_PI_2;
    scene.frame.shift = [scene.frame.scale * radius, scene.frame.scale * lot.between(-2.0, 2.0)];
    scene.table = false;
    // Turned to the right, the lower body is the inner one.
    let inner = if side < 0.0 { 0 } else { 1 };
    let solid = lot.chance(0.4);
    let depth = &mut scene.bodies[inner].depth;
    *depth = if solid { radius } else { depth.min(0.85 * radius) };
    let is_long = lot.chance(0.6);
    scene.bodies.iter_mut().for_each(|body| body.walls[1] = is_long);
    let mean = lot.factor(1e-4, 2e-3);
    let compliance = scene.bodies.iter().map(|body| radius / body.depth.min(radius) / body.young).sum::<f64>();
    let size = radius * (mean * compliance).min(4e-3);
    let mut gap = size * lot.between(0.1, 1.5);
    match lot.one(&["interference", "pressure", "heat", "heat", "bumps"]) {
        "interference" => gap = -size,
        "pressure" if !(solid && inner == 1) => scene.press = Press::Pressure { mean, tilt: lot.one(&[0.0, 0.0, 0.3]) },
        "bumps" if is_long && !(solid && inner == 1) => {
            scene.press = Press::Pressure { mean, tilt: 0.0 };
            let soft = softness(scene);
            draw::declared_gap(scene, lot, soft, mean);
            if matches!(scene.press, Press::Move(_)) {
                scene.press = Press::Pressure { mean, tilt: 0.0 };
            }
            return;
        }
        _ => {
            let k = lot.one(&[0, 1]);
            let grows = if k == inner { 1.0 } else { -1.0 };
            let slope = if lot.chance(0.5) { 0.0 } else { lot.between(-0.2, 0.2) };
            round.hot[k] = Some(Heat { strain: grows * (size + gap) / radius, slope });
            if lot.chance(0.3) {
                gap = -0.5 * size;
            }
        }
    }
    if lot.chance(0.3) {
        scene.bodies[1].range = [0.0, lot.between(0.4, 0.8)];
        scene.bodies[1].walls[1] = false;
    }
    scene.gap = Gap::Number(gap);
    if lot.chance(0.4) {
        (scene.gap, scene.bodies[1].seam) = (Gap::Drawn, Shape::Line { height: gap });
    }
    if let Some(lame) = exact::lame(round, lot.chance(0.35)) {
        round.ends = lame.along;
        round.exact = Some(exact::constant(lame.pressure, round));
    }
}

/// A rigid tool on a block, or on a ring: round, a cone, or flat with an edge.
fn tool(round: &mut Round, lot: &mut Lot) {
    let scene = &mut round.scene;
    let on_axis = lot.chance(0.7);
    if !on_axis {
        scene.frame.shift = [scene.frame.scale * lot.factor(0.2, 3.0), 0.0];
    }
    let body = scene.bodies[0].clone();
    let soft = (1.0 - body.poisson * body.poisson) / body.young;
    let (a, peak) = (lot.factor(0.05, 0.3), lot.factor(2e-4, 3e-3));
    let middle = if on_axis { 0.0 } else { 0.5 };
    scene.bodies[1].walls = [true, false];
    let bend = FRAC_PI_2 * peak * soft * body.young / a;
    let (kind, seam, way, reach) = match lot.one(&[0, 1, 2]) {
        0 if on_axis => ("cone", Shape::Cone { height: 0.0, slope: bend * a }, FRAC_PI_2 * bend * a * a, 1.0),
        1 => ("flat punch", Shape::Line { height: 0.0 }, peak, lot.between(0.3, 0.7)),
        _ => ("round tool", Shape::Parabola { height: 0.0, bend: 0.5 * bend, middle }, bend * a * a, 1.0),
    };
    round.kind = kind;
    (scene.bodies[1].seam, scene.bodies[1].range) = (seam, [0.0, reach]);
    scene.gap = if kind == "flat punch" { Gap::Closed } else { Gap::Drawn };
    let width = if kind == "flat punch" { reach } else { a };
    scene.focus.push(Peak { at: middle, reach: 1.3 * width, edge: width / 8.0 });
    let around = scene.frame.shift[0] / scene.frame.scale;
    let area = if on_axis { width * width } else { 4.0 * width * (around + middle) };
    let force = 2.0 * peak * body.young * area;
    round.upper = if lot.chance(0.5) { Upper::Tool(force) } else { Upper::Moved(way) };
}
