//! A scene of two bodies one above the other, and what a case file says of it.

use crate::layers::{Layers, Peak};
use crate::shape::{Frame, Shape};
use crate::support::mesh::{Block, Mesh};

/// One of the two bodies, between its seam and a boundary beside it.
#[derive(Clone, Debug)]
pub struct Body {
    pub seam: Shape,
    /// Which part of the seam's shape it has, as parameters.
    pub range: [f64; 2],
    pub depth: f64,
    pub young: f64,
    pub poisson: f64,
    /// Whether its left and its right side slide along a wall.
    pub walls: [bool; 2],
}

/// The gap of the unloaded bodies, in lengths of the scene's frame.
#[derive(Clone, Debug)]
pub enum Gap {
    Closed,
    Number(f64),
    /// `rise` (`base` - Σ share exp(-d²/width²)), d the distance from the seam's point at a parameter.
    Bumps {
        rise: f64,
        base: f64,
        bumps: Vec<Bump>,
    },
    /// A formula of the plane's x and y, in its lengths.
    Formula(String),
    /// As the bodies are drawn.
    Drawn,
}

/// Where the gap is small.
#[derive(Clone, Copy, Debug)]
pub struct Bump {
    pub at: f64,
    pub width: f64,
    pub share: f64,
}

/// What presses the bodies together.
#[derive(Clone, Copy, Debug)]
pub enum Press {
    /// A pressure on the upper body, `mean` (1 + `tilt` (2 x - 1)).
    Pressure { mean: f64, tilt: f64 },
    /// A pressure on the upper body of this peak, about a place.
    Bump { peak: f64, at: f64, width: f64 },
    /// The upper boundary of the upper body goes down.
    Move(f64),
    /// Nothing: the sides hold both bodies.
    Sides,
}

/// How the case asks for it to be solved.
#[derive(Clone, Debug)]
pub struct Settings {
    pub order: usize,
    pub refine: usize,
    pub space: &'static str,
    pub segments: Option<usize>,
    pub curve: &'static str,
    pub deformed: bool,
    pub swapped: bool,
    pub ranks: usize,
    /// How both bodies are meshed.
    pub layers: [Layers; 2],
}

/// The physics.
#[derive(Clone, Debug)]
pub struct Scene {
    pub frame: Frame,
    /// Unit of stress, by which moduli and pressures are multiplied.
    pub stress: f64,
    /// The lower and the upper one.
    pub bodies: [Body; 2],
    pub gap: Gap,
    pub press: Press,
    /// Whether the lower boundary of the lower body is held upright.
    pub table: bool,
    /// Way of the upper body's left wall, to the left.
    pub drawn_aside: f64,
    /// Where the reference is to be fine.
    pub focus: Vec<Peak>,
}

const NAMES: [&str; 2] = ["lower", "upper"];
const SIDES: [[&str; 4]; 2] =
    [["lower.seam", "lower.right", "lower.outer", "lower.left"], ["upper.seam", "upper.right", "upper.outer", "upper.left"]];

impl Scene {
    /// The mesh file.
    pub fn mesh(&self, layers: &[Layers; 2]) -> String {
        Mesh { bodies: self.blocks(layers).into() }.text()
    }

    /// The bodies' meshes with the names of their sides.
    pub fn blocks(&self, layers: &[Layers; 2]) -> [(&'static str, Block, [&'static str; 4]); 2] {
        [0, 1].map(|k| {
            let (body, down) = (&self.bodies[k], if k == 0 { -1.0 } else { 1.0 });
            let [a, b] = body.range;
            let block = layers[k].block(|u, v| {
                let [x, y] = body.seam.at(a + (b - a) * u);
                let [far_x, far_y] = match body.seam {
                    Shape::Arc { .. } => body.seam.moved(down * body.depth).at(a + (b - a) * u),
                    _ => [x, down * body.depth],
                };
                self.frame.place([x + v * (far_x - x), y + v * (far_y - y)])
            });
            (NAMES[k], block, SIDES[k])
        })
    }

    /// The case file.
    pub fn case(&self, settings: &Settings) -> String {
        let mut text = format!("[mesh]\nfile = \"mesh.msh\"\norder = {}\nrefine = {}\n", settings.order, settings.refine);
        for (name, body) in NAMES.iter().zip(&self.bodies) {
            text += &format!("[body.{name}]\nyoung = {:?}\npoisson = {:?}\n", body.young * self.stress, body.poisson);
        }
        text += &self.geometries();
        text += &self.supports();
        text += &self.loads();
        text + &self.contact(settings)
    }

    fn geometries(&self) -> String {
        let [lower, upper] = &self.bodies;
        let mut all = if lower.seam == upper.seam {
            vec![("seam", "[\"lower.seam\", \"upper.seam\"]", lower.seam)]
        } else {
            vec![("one", "[\"lower.seam\"]", lower.seam), ("two", "[\"upper.seam\"]", upper.seam)]
        };
        if let (Shape::Arc { .. }, Shape::Arc { .. }) = (lower.seam, upper.seam) {
            all.push(("inside", "[\"lower.outer\"]", lower.seam.moved(-lower.depth)));
            all.push(("outside", "[\"upper.outer\"]", upper.seam.moved(upper.depth)));
        }
        let line = |(name, curves, shape): (&str, &str, Shape)| {
            let lines = shape.geometry(&self.frame);
            lines.map(|lines| format!("[geometry.{name}]\ncurves = {curves}\n{lines}\n")).unwrap_or_default()
        };
        all.into_iter().map(line).collect()
    }

    fn supports(&self) -> String {
        let mut text = String::new();
        if self.table {
            text += "[support.table]\non = \"lower.outer\"\nnormal = 0.0\n";
        }
        for ((name, body), side) in NAMES.iter().zip(&self.bodies).flat_map(|body| [(body, 0), (body, 1)]) {
            let which = ["left", "right"][side];
            let way = if *name == "upper" && side == 0 { self.drawn_aside * self.frame.scale } else { 0.0 };
            if body.walls[side] {
                text += &format!("[support.{name}_{which}]\non = \"{name}.{which}\"\nnormal = {way:?}\n");
            }
        }
        if let Press::Move(way) = self.press {
            text += &format!("[support.press]\non = \"upper.outer\"\nnormal = {:?}\n", -way * self.frame.scale);
        }
        text
    }

    fn loads(&self) -> String {
        let pressure = match self.press {
            Press::Pressure { mean, tilt } => {
                format!("{:?}*(1+({tilt:?})*(2*{}-1))", mean * self.stress, self.frame.local_x())
            }
            Press::Bump { peak, at, width } => {
                let [x, y] = self.bodies[1].seam.at(at);
                let top = if self.table { [x, self.bodies[1].depth] } else { [x, y] };
                format!("{:?}*{}", peak * self.stress, self.frame.bump(top, width))
            }
            Press::Move(_) | Press::Sides => return String::new(),
        };
        format!("[load.top]\non = \"upper.outer\"\npressure = \"{pressure}\"\n")
    }

    fn contact(&self, settings: &Settings) -> String {
        let names = if settings.swapped { ["upper.seam", "lower.seam"] } else { ["lower.seam", "upper.seam"] };
        let mut text = format!("[contact.c]\nbetween = {names:?}\ncurve = \"{}\"\n", settings.curve);
        text += &match &self.gap {
            Gap::Closed => "gap = \"closed\"\n".to_string(),
            Gap::Number(gap) => format!("gap = {:?}\n", gap * self.frame.scale),
            Gap::Formula(formula) => format!("gap = \"{formula}\"\n"),
            Gap::Drawn => "gap = \"geometry\"\n".to_string(),
            Gap::Bumps { rise, base, bumps } => {
                let near =
                    |bump: &Bump| format!("-({:?})*{}", bump.share, self.frame.bump(self.bodies[0].seam.at(bump.at), bump.width));
                let bumps: String = bumps.iter().map(near).collect();
                format!("gap = \"{:?}*(({base:?}){bumps})\"\n", rise * self.frame.scale)
            }
        };
        text += &format!("multiplier = \"{}\"\n", settings.space);
        if let Some(segments) = settings.segments {
            text += &format!("segments = {segments}\n");
        }
        if settings.deformed {
            text += "configuration = \"deformed\"\n";
        }
        text
    }

    /// Bodies with flat seams and the gap as a formula, where one is drawn flat: the same to the square of the slopes.
    pub fn flattened(&self) -> Option<Self> {
        let [lower, upper] = [self.bodies[0].seam, self.bodies[1].seam];
        let flat = Shape::Line { height: 0.0 };
        if !matches!(self.gap, Gap::Drawn) || lower != flat && upper != flat {
            return None;
        }
        let x = self.frame.local_x();
        let formula = format!("{:?}*(({})-({}))", self.frame.scale, upper.height(&x), lower.height(&x));
        let mut scene = Self { gap: Gap::Formula(formula), drawn_aside: 0.0, ..self.clone() };
        scene.bodies.iter_mut().for_each(|body| body.seam = flat);
        Some(scene)
    }

    /// The parameter on the lower body's seam of a point of the plane.
    pub fn parameter(&self, point: [f64; 2]) -> f64 {
        self.bodies[0].seam.parameter(self.frame.local(point))
    }

    /// Whether contact that reaches this end of the seam, 0 or 1, ends there smoothly: between walls at right angles to it.
    pub fn smooth_end(&self, end: usize) -> bool {
        let [lower, upper] = &self.bodies;
        let square = lower.seam.is_square(end as f64) && upper.seam.is_square(end as f64) && self.gap_is_level(end as f64);
        square && lower.walls[end] && upper.walls[end] && lower.range[end] == upper.range[end]
    }

    /// Whether the gap has no slope at an end. At a wall, the mirror of another gap has a kink: λ is singular like a logarithm.
    fn gap_is_level(&self, end: f64) -> bool {
        let gap = |u: f64| match &self.gap {
            Gap::Bumps { bumps, .. } => {
                let square = |bump: &Bump| {
                    let ([x, y], [a, b]) = (self.bodies[0].seam.at(u), self.bodies[0].seam.at(bump.at));
                    ((x - a).powi(2) + (y - b).powi(2)) / bump.width.powi(2)
                };
                bumps.iter().map(|bump| -bump.share * (-square(bump)).exp()).sum()
            }
            Gap::Drawn => self.bodies[1].seam.at(u)[1] - self.bodies[0].seam.at(u)[1],
            Gap::Closed | Gap::Number(_) | Gap::Formula(_) => 0.0,
        };
        let slope = |u: f64| (gap(u + 1e-4) - gap(u - 1e-4)).abs();
        let most = (1..100).map(|k| slope(k as f64 / 100.0)).fold(0.0, f64::max);
        slope(end) <= 0.02 * most
    }

    /// Where the seam that both bodies have begins and ends, as parameters.
    pub fn ends(&self) -> [f64; 2] {
        let [a, b] = [self.bodies[0].range, self.bodies[1].range];
        [a[0].max(b[0]), a[1].min(b[1])]
    }
}
