//! What a mesh is likely meant to be: what is held, what is pressed, what touches.

use super::named_curve::{ALONG, NamedCurve, PULLED};
use crate::contact::{ClosePair, close_pairs};
use crate::geometry::{Point, cross};
use crate::mesh::{Boundary, MacroMesh, each_once};
use crate::output::plot::range_of;
use crate::run::checking::tools::{PRESSED as MOVED, ProposedTool, proposed_tools};
use std::cmp::Ordering;

/// Young's modulus and Poisson's ratio of the example: steel, in MPa.
pub const YOUNG: f64 = 210e3;
pub const POISSON: f64 = 0.3;

/// The example presses with this share of Young's modulus over the width of the narrowest body, or of what is pressed if that is less:
/// the nominal strain. Where a round body of that width touches, Hertz has 0.6 times its root, 0.6 % of the modulus.
const PRESSED: f64 = 1e-4;

/// Bodies whose outlines are nearer than this share of the smaller one may be meant to touch.
const NEAR: f64 = 0.1;

/// A line of symmetry holds an axis if its normal has more than this along it.
const ACROSS: f64 = 1e-6;

/// Heights that differ by less than this share of a body's are the same.
const LEVEL: f64 = 1e-6;

/// Coordinates below this share of the width of a mesh are 0.
const ROUNDING: f64 = 1e-9;

/// Bodies that reach into each other by more than this share of the smaller one are meant to.
const DRAWN: f64 = 1e-6;

/// A load opens a contact whose mean normal is against it by more than this; a shorter mean normal says nothing.
pub const AWAY: f64 = 0.1;

/// Boundaries of a body whose names differ in their numbers only, from which on they are parts that repeat, as roots of threads.
/// Two may be two feet.
const MANY: usize = 3;

/// How the example presses.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Press {
    /// By a stiff plate that carries a force.
    Plate,
    /// By a pressure.
    Pressure,
    /// Not at all.
    Nothing,
}

/// Directions in which the example may press bodies by a force per area, and their words: the first one that contact carries is taken.
pub const DOWN: [(Point, &str); 4] = [
    (Point::new(0.0, -1.0), "down"),
    (Point::new(0.0, 1.0), "up"),
    (Point::new(-1.0, 0.0), "to the left"),
    (Point::new(1.0, 0.0), "to the right"),
];

/// A body that its own weight presses, as it were.
pub struct Weight {
    pub body: usize,
    /// Force per area along what is down.
    pub force: f64,
}

/// A mesh and what is guessed of it.
pub struct Guesses<'a> {
    pub mesh: &'a MacroMesh,
    pub curves: Vec<NamedCurve<'a>>,
    /// Named boundaries that may touch.
    pub pairs: Vec<ClosePair>,
    /// Rigid tools that curves without triangles may be.
    pub tools: Vec<ProposedTool>,
    /// Words for each of these curves that no tool can be made of.
    pub aside: Vec<String>,
    /// Pairs that no contact can be made of as they are drawn, and why.
    pub refused: Vec<(ClosePair, String)>,
    /// Bodies that lie close, though no named boundaries of theirs do.
    pub unnamed: Vec<[usize; 2]>,
    /// Whether the interference of bodies that are drawn into each other loads them.
    pub interference_loads: bool,
    /// What is down for a force per area, as a unit vector, and in words.
    pub down: (Point, &'static str),
}

impl<'a> Guesses<'a> {
    pub fn new(mesh: &'a MacroMesh) -> Self {
        let pairs = close_pairs(mesh, &[]);
        let (tools, aside) = proposed_tools(mesh, &[], &[]);
        let mut curves: Vec<_> = mesh.boundaries.iter().filter_map(|boundary| NamedCurve::new(mesh, boundary, &pairs)).collect();
        curves.iter_mut().for_each(|curve| curve.is_touched |= tools.iter().any(|tool| tool.between[0] == curve.name));
        let kinds: Vec<_> = curves.iter().map(|curve| (curve.body, curve.words())).collect();
        let is_many = |kind| kinds.iter().filter(|other| *other == kind).count() >= MANY;
        curves.iter_mut().zip(&kinds).for_each(|(curve, kind)| curve.is_one_of_many = is_many(kind));
        let is_known = |bodies: &[usize; 2]| pairs.iter().any(|pair| pair.bodies == *bodies);
        let unnamed = close_outlines(mesh).into_iter().filter(|bodies| !is_known(bodies)).collect();
        Self { mesh, curves, pairs, tools, aside, refused: Vec::new(), unnamed, interference_loads: true, down: DOWN[0] }
    }

    /// Leaves out the pair or the tool of these names, in any order; says whether there is one.
    pub fn refuse(&mut self, between: &[String; 2], why: &str) -> bool {
        let is_it = |sides: &[String; 2]| sides.iter().all(|name| between.contains(name));
        if let Some(at) = self.tools.iter().position(|tool| is_it(&tool.between)) {
            let tool = self.tools.remove(at);
            self.aside.push(tool.set_aside(why));
            let pairs = self.pairs.iter().chain(self.refused.iter().map(|(pair, _)| pair)).map(|pair| &pair.between);
            let touched: Vec<&String> = pairs.chain(self.tools.iter().map(|tool| &tool.between)).flatten().collect();
            self.curves.iter_mut().for_each(|curve| curve.is_touched &= touched.iter().any(|name| *name == curve.name));
            return true;
        }
        let found = self.pairs.iter().position(|pair| is_it(&pair.between)).map(|at| (self.pairs.remove(at), why.to_owned()));
        let is_there = found.is_some();
        self.refused.extend(found);
        is_there
    }

    /// Boundaries without contact and not of symmetry.
    fn free(&self) -> impl Iterator<Item = &NamedCurve<'a>> {
        self.curves.iter().filter(|curve| !curve.is_touched && !curve.is_mirrored())
    }

    /// The boundaries that are held: of each body one that says so by its name, or else the lowest of all that look down. Where that would
    /// be all bodies but those that lie between them, as rollers between two rings, and neither a name nor an interference loads one, nothing
    /// would act: the highest is left to a load then.
    pub fn held(&self) -> Vec<&NamedCurve<'a>> {
        let rank = |curve: &&NamedCurve| (curve.is_seat(), curve.normal.y < -ALONG, -curve.low.y);
        let likeliest = |a: &&NamedCurve, b: &&NamedCurve| rank(a).partial_cmp(&rank(b)).unwrap_or(Ordering::Equal);
        let is_held = |curve: &&NamedCurve| curve.is_held() && !(curve.is_seat() && self.is_pressed_all_round(curve.body));
        let by_name = |body: usize| self.free().filter(|curve| curve.body == body).filter(is_held).max_by(likeliest);
        let mut held: Vec<&NamedCurve> = (0..self.mesh.bodies.len()).filter_map(by_name).collect();
        if held.is_empty() {
            let is_below = |curve: &&NamedCurve| 2.0 * curve.low.y < self.reach(curve.body, Point::y()).iter().sum();
            held.extend(self.free().filter(|curve| curve.normal.y < -ALONG).filter(is_below).max_by(likeliest));
        }
        let is_loaded = self.is_pressed_in() || self.free().any(|curve| curve.is_loaded() && !curve.is_held());
        let is_base = |body: usize| held.iter().any(|curve| curve.body == body);
        let lies_between = |body: usize| {
            let partners = self.partners(body);
            partners.len() > 1 && partners.into_iter().all(is_base) && !self.free().any(|curve| curve.body == body)
        };
        let acts_nowhere = (0..self.mesh.bodies.len()).all(|body| is_base(body) || lies_between(body));
        if held.len() > 1 && acts_nowhere && !is_loaded {
            held.sort_by(|a, b| a.low.y.total_cmp(&b.low.y));
            held.pop();
        }
        held
    }

    /// Where no boundary is held, but bodies may touch: the lowest body, of those that reach as low the largest, and which of its
    /// mean motions are held, so that the others rest on it.
    pub fn foundation(&self) -> Option<(usize, [bool; 3])> {
        if self.pairs.is_empty() || !self.held().is_empty() {
            return None;
        }
        let low = |body: usize| self.ends(body)[0];
        let lowest = (0..self.mesh.bodies.len()).map(low).fold(f64::INFINITY, f64::min);
        let reaches = |&body: &usize| low(body) - lowest <= LEVEL * (self.ends(body)[1] - low(body));
        let body = (0..self.mesh.bodies.len()).filter(reaches).max_by(|&a, &b| self.area(a).total_cmp(&self.area(b)))?;
        self.unresisted(body, [true; 3]).map(|motions| (body, motions))
    }

    /// Those of some mean motions of a body that its lines of symmetry leave free; nothing if none is, or if it has no mean motion.
    fn unresisted(&self, body: usize, mut motions: [bool; 3]) -> Option<[bool; 3]> {
        let mirrored = self.curves.iter().filter(|curve| curve.is_mirrored() && !curve.is_touched);
        let edges = mirrored.filter_map(|curve| self.mesh.boundary(curve.name)).flat_map(|boundary| &boundary.edges);
        for &edge in edges.filter(|&&edge| self.mesh.body_beside(edge) == body) {
            let normal = self.mesh.edge_normal(edge, 0.5);
            motions = [motions[0] && normal.x.abs() < ACROSS, motions[1] && normal.y.abs() < ACROSS, false];
        }
        let is_whole = self.mesh.pieces.iter().filter(|piece| piece.body == body).count() == 1;
        (is_whole && motions.contains(&true)).then_some(motions)
    }

    /// Bodies that a body may touch, each once.
    fn partners(&self, body: usize) -> Vec<usize> {
        let pairs = self.pairs.iter().filter(|pair| pair.bodies.contains(&body));
        each_once(pairs.flat_map(|pair| pair.bodies).filter(|&other| other != body))
    }

    /// Bodies that are held as a whole, by a boundary or by their mean motion.
    fn bases(&self) -> Vec<usize> {
        self.held().iter().map(|held| held.body).chain(self.foundation().map(|(body, _)| body)).collect()
    }

    /// Whether a body has lost all its contacts, since these are refused: nothing would carry a load on it.
    pub fn is_cut_off(&self, body: usize) -> bool {
        let is_in = |pair: &ClosePair| pair.bodies.contains(&body);
        self.refused.iter().any(|(pair, _)| is_in(pair)) && !self.pairs.iter().any(is_in) && !self.bases().contains(&body)
    }

    /// The boundary that is pressed: by its name, or because it is the highest and looks up; on a body that is not held, unless a name loads one that is.
    /// That of a body that is drawn into another is an example alone: what presses is the interference.
    pub fn pressed(&self) -> Option<&NamedCurve<'a>> {
        let (bases, held, is_alone) = (self.bases(), self.held(), self.mesh.bodies.len() == 1);
        let is_held = |curve: &NamedCurve| held.iter().any(|held| held.name == curve.name);
        let is_free = |curve: &NamedCurve| is_alone || !bases.contains(&curve.body) || curve.is_loaded();
        let other = |curve: &&NamedCurve| is_free(curve) && !is_held(curve) && !self.is_cut_off(curve.body);
        let rank = |curve: &&NamedCurve| (curve.is_loaded(), curve.normal.y > ALONG, curve.is_held(), curve.high.y);
        let likely = self.free().filter(other);
        let likely = likely.filter(|curve| curve.is_loaded() || curve.is_held() || curve.normal.y > ALONG);
        let best = likely.max_by(|a, b| rank(a).partial_cmp(&rank(b)).unwrap_or(Ordering::Equal));
        best.filter(|curve| curve.is_of_one_piece)
    }

    /// Whether bodies are drawn into each other: that interference is the load.
    pub fn is_pressed_in(&self) -> bool {
        self.interference_loads && self.pairs.iter().any(|pair| pair.distance < 0.0 && pair.share() > DRAWN)
    }

    /// Whether a body is drawn into another all round, as a shaft into a hub: a bore that were held could not give way.
    fn is_pressed_all_round(&self, body: usize) -> bool {
        let is_round = |name: &String| self.curves.iter().any(|curve| curve.name == name && curve.normal.norm() < AWAY);
        let is_pressed = |pair: &ClosePair| pair.bodies.contains(&body) && pair.distance < 0.0 && pair.share() > DRAWN;
        self.interference_loads && self.pairs.iter().any(|pair| is_pressed(pair) && pair.between.iter().all(is_round))
    }

    /// The axis along which a boundary is pushed: against its normal, or, if no contact of its body would feel that, into these; down if it
    /// has no mean normal, as a hole.
    pub fn push(&self, curve: &NamedCurve) -> Point {
        let axis = |n: Point| match n {
            n if n.norm() < AWAY => None,
            n if n.x.abs() > 2.0 * n.y.abs() => Some(Point::new(n.x.signum(), 0.0)),
            n => Some(Point::new(0.0, n.y.signum())),
        };
        let touched = || self.curves.iter().filter(|other| other.body == curve.body && other.is_touched);
        let own = axis(-curve.normal).unwrap_or(Point::new(0.0, -1.0));
        let is_felt = touched().next().is_none() || touched().any(|other| other.normal.dot(&own).abs() > AWAY);
        let into = || {
            axis(
                touched().map(|other| other.length * other.normal).sum::<Point>()
                    / touched().map(|other| other.length).sum::<f64>(),
            )
        };
        if is_felt { own } else { into().unwrap_or(own) }
    }

    /// What a boundary is loaded along (1), or against (-1), if a push onto it is along a direction: one that is pulled by its name is,
    /// and so is one whose push would open every contact of its body.
    pub fn sense(&self, curve: &NamedCurve, push: Point) -> f64 {
        let mut touched = self.curves.iter().filter(|other| other.body == curve.body && other.is_touched).peekable();
        let opens = touched.peek().is_some() && touched.all(|other| other.normal.dot(&push) < -AWAY);
        if curve.has(PULLED) || opens { -1.0 } else { 1.0 }
    }

    /// Bodies that rest on others and would lie loose there, since nothing presses them: neither a boundary nor a body that is
    /// higher. To each an example of a force per area that presses it down.
    pub fn weights(&self) -> Vec<Weight> {
        if self.is_pressed_in() {
            return Vec::new();
        }
        let bases = self.bases();
        if bases.is_empty() {
            return Vec::new();
        }
        let pressed = self.pressed().map(|curve| curve.body);
        // A load moves such a ring towards some of the bodies between it and the other one, and no weight is to drive these along it.
        let ring = self.pressed().filter(|curve| curve.is_held()).map(|curve| curve.body);
        let middle = |body: usize| self.ends(body).iter().sum::<f64>();
        let is_higher =
            |body: usize, other: usize| middle(other) - middle(body) > LEVEL * (self.ends(body)[1] - self.ends(body)[0]);
        let rests = |&body: &usize| {
            let partners = self.partners(body);
            let presses = |&other: &usize| !bases.contains(&other) && is_higher(body, other) || ring == Some(other);
            !partners.is_empty() && !partners.iter().any(presses)
        };
        let loose = (0..self.mesh.bodies.len()).filter(|&body| !bases.contains(&body) && Some(body) != pressed).filter(rests);
        loose.map(|body| Weight { body, force: one_digit(PRESSED * YOUNG * self.narrowest() / self.area(body)) }).collect()
    }

    /// Whether weights may have this direction, another one than down on the drawing: there are some, on bodies that are drawn touching, and
    /// no line of symmetry carries them. In a pile that nothing holds by a name, three discs for example, they would open contacts.
    pub fn may_turn_weights(&self) -> bool {
        let touches = |body: usize| self.pairs.iter().any(|pair| pair.bodies.contains(&body) && pair.share() <= DRAWN);
        let is_pile = |body: usize| self.foundation().is_some() && self.partners(body).len() > 1;
        let [across, along] = [self.down.0.x, self.down.0.y].map(|part| part != 0.0);
        let goes_there = |motions: [bool; 3]| across && motions[0] || along && motions[1];
        let is_free = |body: usize| self.unresisted(body, [true; 3]).is_some_and(goes_there);
        let may_turn = |body: usize| touches(body) && !is_pile(body) && is_free(body);
        let weights = self.weights();
        !weights.is_empty() && weights.iter().all(|weight| may_turn(weight.body))
    }

    /// The force of the example on a boundary, for each length of thickness.
    pub fn force(&self, curve: &NamedCurve) -> f64 {
        one_digit(PRESSED * YOUNG * self.narrowest().min(curve.extent()))
    }

    /// The pressure of the example on a boundary, whose resultant is no larger than that force.
    pub fn pressure(&self, curve: &NamedCurve) -> f64 {
        one_digit(PRESSED * YOUNG * (self.narrowest() / curve.extent()).min(1.0))
    }

    /// Width of the narrowest body.
    fn narrowest(&self) -> f64 {
        self.mesh.bounds().iter().map(|[low, high]| (high - low).min()).fold(f64::INFINITY, f64::min)
    }

    /// How far the example moves a tool.
    pub fn tool_way(&self) -> f64 {
        one_digit(MOVED * self.narrowest())
    }

    /// Whether the mesh may be half a section of bodies of revolution: it has a side on x = 0, and nothing lies beyond.
    pub fn may_be_round(&self) -> bool {
        let (bounds, mesh) = (self.mesh.bounds(), self.mesh);
        let on_axis = ROUNDING * bounds.iter().map(|[_, high]| high.x).fold(0.0, f64::max);
        let lies_there = |&vertex: &u32| mesh.vertices[vertex as usize].x.abs() <= on_axis;
        bounds.iter().all(|[low, _]| low.x >= -on_axis) && mesh.edges.iter().any(|edge| edge.vertices.iter().all(lies_there))
    }

    /// How low and how high a body reaches.
    fn ends(&self, body: usize) -> [f64; 2] {
        self.reach(body, -self.down.0)
    }

    /// From where to where a body reaches along a direction.
    fn reach(&self, body: usize, along: Point) -> [f64; 2] {
        let own = self.mesh.pieces.iter().zip(self.mesh.bounds()).filter(|(piece, _)| piece.body == body);
        range_of(own.flat_map(|(_, ends)| ends.map(|end| end.dot(&along))))
    }

    fn area(&self, body: usize) -> f64 {
        let own = (0..self.mesh.triangles.len()).filter(|&triangle| self.mesh.triangles[triangle].body as usize == body);
        own.map(|triangle| self.mesh.corners(triangle)).map(|[a, b, c]| 0.5 * cross(b - a, c - a)).sum()
    }
}

/// Bodies whose outlines lie close and face each other, with names or without.
fn close_outlines(mesh: &MacroMesh) -> Vec<[usize; 2]> {
    let outline = |(name, edges): (&String, Vec<u32>)| Boundary { name: name.clone(), edges, is_union: false };
    let outlines = MacroMesh { boundaries: mesh.bodies.iter().zip(mesh.outer_edges()).map(outline).collect(), ..mesh.clone() };
    close_pairs(&outlines, &[]).into_iter().filter(|pair| pair.share() <= NEAR).map(|pair| pair.bodies).collect()
}

/// A number of one digit, for an example.
fn one_digit(value: f64) -> f64 {
    format!("{value:.0e}").parse().unwrap_or(value)
}
