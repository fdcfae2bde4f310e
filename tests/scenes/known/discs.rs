//! Thick rings that lie in a groove, between plates or on a block: their contact is that of a disc (Hertz).

use super::exact::{Material, hertz};
use super::{Answer, Known, Parameter, sampled};
use crate::layers::{Layers, Peak};
use crate::profile::Profile;
use crate::support::mesh::{Block, Mesh};
use std::f64::consts::{FRAC_PI_2, PI};

/// Radius of the hole; the rim has radius 1.
const HOLE: f64 = 0.3;

/// A ring around `centre`, or the part of it between two angles, with short edges on the rim where it touches.
fn ring([from, to]: [f64; 2], touches: &[f64], edge: f64, centre: [f64; 2], size: f64) -> Block {
    let length = to - from;
    let peak = |angle: &f64| Peak { at: (angle - from) / length, reach: 8.0 * edge / length, edge: edge / length };
    let layers = Layers {
        peaks: touches.iter().map(peak).collect(),
        ..Layers::even((10.0 * length).round() as usize, (1.0 - HOLE) / length, 0.1, 5)
    };
    layers.block(|u, v| {
        let (s, c) = (from + u * length).sin_cos();
        let r = 1.0 - v * (1.0 - HOLE);
        [size * (centre[0] + r * c), size * (centre[1] + r * s)]
    })
}

/// Closes a full ring: nodes of the last ray are those of the first. The rim is cut into a lower and an upper half.
fn closed(mut block: Block) -> Block {
    let [rim, right, hole, left] = block.sides;
    let ends = |side: &[[usize; 2]]| side.iter().flatten().copied().collect::<Vec<_>>();
    let pairs: Vec<_> = ends(&right).into_iter().zip(ends(&left)).collect();
    let one = |k: usize| pairs.iter().find(|(from, _)| *from == k).map_or(k, |(_, to)| *to);
    let edges = |side: &[[usize; 2]]| side.iter().map(|edge| edge.map(one)).collect::<Vec<_>>();
    let (rim, hole) = (edges(&rim), edges(&hole));
    let middle = block.points.iter().map(|x| x[1]).fold(f64::INFINITY, f64::min)
        + block.points.iter().map(|x| x[1]).fold(f64::NEG_INFINITY, f64::max);
    let (low, up) = rim.into_iter().partition(|[a, b]| block.points[*a][1] + block.points[*b][1] < middle);
    block.triangles.iter_mut().for_each(|triangle| *triangle = triangle.map(one));
    block.sides = [low, up, hole, Vec::new()];
    without_strays(block)
}

/// Leaves out the points that no triangle has.
fn without_strays(block: Block) -> Block {
    let mut used = vec![false; block.points.len()];
    block.triangles.iter().flatten().for_each(|k| used[*k] = true);
    let new: Vec<usize> = used
        .iter()
        .scan(0, |next, used| {
            *next += usize::from(*used);
            Some(next.saturating_sub(1))
        })
        .collect();
    Block {
        points: block.points.into_iter().zip(&used).filter(|(_, used)| **used).map(|(x, _)| x).collect(),
        triangles: block.triangles.into_iter().map(|triangle| triangle.map(|k| new[k])).collect(),
        sides: block.sides.map(|side| side.into_iter().map(|edge| edge.map(|k| new[k])).collect()),
    }
}

/// A block 1.6 wide and .8 deep whose flat side has its middle at `middle`, turned by an angle.
fn plate(middle: [f64; 2], angle: f64, edge: f64, size: f64) -> Block {
    let width = 1.6;
    let fine = Peak { at: 0.5, reach: 8.0 * edge / width, edge: edge / width };
    let layers = Layers { peaks: vec![fine], ..Layers::even(9, 0.5, 0.1, 6) };
    let (s, c) = angle.sin_cos();
    layers.block(|u, v| {
        let (x, y) = (width * (u - 0.5), -0.8 * v);
        [size * (middle[0] + c * x - s * y), size * (middle[1] + s * x + c * y)]
    })
}

fn bodies(young: &[(&str, f64)], weight: f64) -> String {
    let one = |(name, young): &(&str, f64)| {
        let force = if *name == "disc" && weight != 0.0 { format!("body_force = [0.0, {:?}]\n", -weight) } else { String::new() };
        format!("[body.{name}]\nyoung = {young:?}\npoisson = 0.3\n{force}")
    };
    young.iter().map(one).collect()
}

fn circles(rim: &str, centre: [f64; 2], size: f64) -> String {
    let circle = |name: &str, curves: &str, radius: f64| {
        let [x, y] = centre.map(|x| x * size);
        format!("[geometry.{name}]\ncurves = {curves}\ncircle = {{ centre = [{x:?}, {y:?}], radius = {:?} }}\n", radius * size)
    };
    circle("rim", rim, 1.0) + &circle("hole", "[\"hole\"]", HOLE)
}

/// λ of Hertz about 0, and how a point on the rim counts: by the angle.
fn round(materials: [Material; 2], force: f64, centre: [f64; 2], size: f64, from: f64) -> (Profile, Parameter) {
    let [peak, half_width] = hertz(materials, force, size);
    let half_angle = half_width / size;
    let profile = sampled(-half_angle, half_angle, size, |u| peak * (1.0 - (u / half_angle).powi(2)).max(0.0).sqrt());
    let angle = move |x: [f64; 2]| {
        let turn = (x[1] - size * centre[1]).atan2(x[0] - size * centre[0]) - from;
        turn - 2.0 * PI * (turn / (2.0 * PI)).round()
    };
    (profile, Box::new(angle))
}

struct Groove {
    angle: f64,
    half_width: f64,
    young: [f64; 2],
    size: f64,
    order: usize,
    space: &'static str,
    swapped: bool,
    deformed: bool,
}

impl Groove {
    /// Half a ring beside its plane of symmetry, on one plane of the groove, under its weight.
    fn known(&self, name: &str, ranks: usize) -> Known {
        let (materials, size) = (self.young.map(|young| Material { young, poisson: 0.3 }), self.size);
        let (s, c) = self.angle.to_radians().sin_cos();
        let force = PI * super::exact::stiffness(materials) * self.half_width.powi(2) / 4.0 * size;
        let area = FRAC_PI_2 * (1.0 - HOLE * HOLE) * size * size;
        let touch = self.angle.to_radians() - FRAC_PI_2;
        let edge = self.half_width / 2.5;
        let mesh = Mesh {
            bodies: vec![
                (
                    "block",
                    plate([s, -c], self.angle.to_radians(), edge, size),
                    ["block.top", "block.right", "bottom", "block.left"],
                ),
                ("disc", ring([-FRAC_PI_2, FRAC_PI_2], &[touch], edge, [0.0; 2], size), ["rim", "axis", "hole", "axis"]),
            ],
        };
        let pair = if self.swapped { "[\"rim\", \"block.top\"]" } else { "[\"block.top\", \"rim\"]" };
        let case = format!(
            "[mesh]\nfile = \"mesh.msh\"\norder = {}\nrefine = 2\n{}{}[support.table]\non = [\"bottom\", \"block.left\", \"block.right\"]\nnormal = 0.0\n[support.axis]\non = \"axis\"\nux = 0.0\n[contact.c]\nbetween = {pair}\nmultiplier = \"{}\"\n{}",
            self.order,
            bodies(&[("block", self.young[0]), ("disc", self.young[1])], force * c / area),
            circles("[\"rim\"]", [0.0; 2], size),
            self.space,
            if self.deformed { "configuration = \"deformed\"\n" } else { "" },
        );
        let (profile, parameter) = round(materials, force, [0.0; 2], size, touch);
        let answer = Answer::Pressure { profile, parameter, centred: true };
        Known { name: format!("groove, {name}"), mesh: mesh.text(), case, ranks, answer }
    }
}

pub fn grooves() -> Vec<Known> {
    let plain = Groove {
        angle: 30.0,
        half_width: 0.05,
        young: [1000.0, 1000.0],
        size: 1.0,
        order: 2,
        space: "p1-discontinuous",
        swapped: false,
        deformed: false,
    };
    vec![
        plain.known("30 degrees", 1),
        Groove { angle: 45.0, space: "p1-continuous", ..plain }.known("45 degrees", 2),
        Groove { angle: 20.0, young: [1e5, 1e3], size: 1e3, swapped: true, ..plain }.known("20 degrees, stiff below", 3),
        Groove { angle: 60.0, half_width: 0.03, size: 1e-3, ..plain }.known("60 degrees, in metres", 1),
        Groove { angle: 35.0, young: [1e3, 2e4], order: 1, space: "p0", ..plain }.known("35 degrees, soft below, P1", 2),
        Groove { deformed: true, ..plain }.known("30 degrees, deformed", 3),
    ]
}

struct Loose {
    half_width: f64,
    size: f64,
    /// Whether the hole is held sideways, which stops rolling.
    held: bool,
    /// A plate above with a load, or the ring's weight.
    plate: bool,
    space: &'static str,
}

impl Loose {
    fn known(&self, name: &str, ranks: usize) -> Known {
        let (young, size) = (1000.0, self.size);
        let materials = [Material { young, poisson: 0.3 }; 2];
        let force = PI * super::exact::stiffness(materials) * self.half_width.powi(2) / 4.0 * size;
        let edge = self.half_width / 2.5;
        let touches = [-FRAC_PI_2, FRAC_PI_2];
        let full = closed(ring([-PI, PI], &touches[..1 + usize::from(self.plate)], edge, [0.0, 1.0], size));
        let mut all = vec![
            ("base", plate([0.0; 2], 0.0, edge, size), ["base.top", "wall", "bottom", "wall"]),
            ("disc", full, ["rim.low", "rim.up", "hole", ""]),
        ];
        let mut moduli = vec![("base", young), ("disc", young)];
        let mut rest = String::new();
        if self.plate {
            all.push(("plate", plate([0.0, 2.0], PI, edge, size), ["plate.low", "wall", "top", "wall"]));
            moduli.push(("plate", young));
            rest += &format!(
                "[load.top]\non = \"top\"\npressure = {:?}\n[contact.d]\nbetween = [\"rim.up\", \"plate.low\"]\n",
                force / (1.6 * size)
            );
        }
        if self.held {
            rest += "[support.hole]\non = \"hole\"\nux = 0.0\n";
        }
        let weight = if self.plate { 0.0 } else { force / (PI * (1.0 - HOLE * HOLE) * size * size) };
        let case = format!(
            "[mesh]\nfile = \"mesh.msh\"\norder = 2\nrefine = 2\n{}{}[support.table]\non = \"bottom\"\nuy = 0.0\n[support.wall]\non = \"wall\"\nux = 0.0\n{rest}[contact.c]\nbetween = [\"base.top\", \"rim.low\"]\nmultiplier = \"{}\"\n",
            bodies(&moduli, weight),
            circles("[\"rim.low\", \"rim.up\"]", [0.0, 1.0], size),
            self.space,
        );
        let (profile, parameter) = round(materials, force, [0.0, 1.0], size, -FRAC_PI_2);
        let answer = if self.held { Answer::Pressure { profile, parameter, centred: true } } else { Answer::Doubt(&["disc"]) };
        Known { name: format!("disc, {name}"), mesh: Mesh { bodies: all }.text(), case, ranks, answer }
    }
}

pub fn loose() -> Vec<Known> {
    let plain = Loose { half_width: 0.06, size: 1.0, held: false, plate: true, space: "p1-discontinuous" };
    vec![
        plain.known("free between plates", 1),
        Loose { size: 1e3, half_width: 0.04, space: "p1-continuous", ..plain }.known("free between plates, large", 2),
        Loose { plate: false, ..plain }.known("free on a block", 3),
        Loose { plate: false, size: 1e-3, half_width: 0.1, space: "p0", ..plain }.known("free on a block, in metres", 1),
        Loose { held: true, ..plain }.known("held between plates", 2),
        Loose { held: true, plate: false, size: 1e-3, ..plain }.known("held on a block", 3),
    ]
}
