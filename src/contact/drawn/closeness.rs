//! Boundaries of different bodies that lie close and face each other: contacts that a case may mean.

mod sight;

use crate::geometry::{Disc, Point, bounds, overlapping_discs, turn_right};
use crate::mesh::{Boundary, CurvePiece, MacroMesh};
use sight::Sight;
use std::collections::{HashMap, HashSet};

/// Parts of an edge at whose ends places are looked at, and places on a boundary at most.
const PLACES: usize = 4;
const MOST_PLACES: usize = 1500;

/// Parts of a rigid curve at whose ends places are looked at.
const PLACES_OF_TOOL: usize = 500;

/// Boundaries nearer than this share of the smaller body are close.
const CLOSE: f64 = 0.1;

/// Boundaries of a body that is close to none may be this share of the smaller body apart, and overlaps as deep.
const APART: f64 = 0.5;

/// A further pair of two bodies is as near as this share of the smaller one.
const TOUCHING: f64 = 0.02;

/// A boundary lies along another one where its normals are against that one's to this cosine (10 degrees), over this share of it at least: a
/// fillet at the end of a flat turns away at once.
const ALONG: f64 = -0.985;
const MOSTLY: f64 = 0.5;

/// Distances that differ by less than this share of the smaller body are alike.
const ALIKE: f64 = 1e-4;

/// Places behind another side that are looked at for whether both bodies are there: that costs a pass over their triangles for each.
const LOOKED_AT: usize = 8;

/// Edges that turn by more than this from one to the next (radians, 31 degrees) meet at a corner: fewer than twelve around a circle
/// are a polygon that may be meant.
pub const WIDEST_TURN: f64 = 0.541;

/// Two named boundaries that may come in contact.
#[derive(Clone, Debug, PartialEq)]
pub struct ClosePair {
    /// Names of the boundaries; the one on the first body of the mesh comes first.
    pub between: [String; 2],
    /// Indices of their bodies.
    pub bodies: [usize; 2],
    /// Least distance at which they face each other (length); where they overlap, the largest depth, negative.
    pub distance: f64,
    /// Size of the smaller body (length).
    pub size: f64,
}

impl ClosePair {
    /// The size of the distance as a share of the smaller body.
    pub fn share(&self) -> f64 {
        self.distance.abs() / self.size
    }
}

/// How a side faces another one.
struct Faced {
    /// Least distance along a normal (length); where they overlap by more than their straight edges do, the largest depth, negative.
    distance: f64,
    /// Whether they lie in the bodies of each other.
    overlaps: bool,
    /// Over which length.
    length: f64,
}

/// What may be one side of a contact: boundaries of one body, or the surface of a rigid tool.
pub struct CloseSide {
    /// Index of the body; nothing of a tool.
    body: Option<usize>,
    /// Macro edges of the boundaries, in ascending order.
    edges: Vec<u32>,
    length: f64,
    sights: Vec<Sight>,
    /// Lowest and highest coordinates, and the largest distance of two places.
    around: [Point; 2],
    spacing: f64,
    /// How far its straight edges lie from the curve that they are drawn for (length).
    bow: f64,
    /// How far the chords of all its edges lie from their curves (length).
    sagitta: f64,
}

/// Whether a body holds a point.
type BodyHolds<'h> = &'h dyn Fn(usize, Point) -> bool;

impl CloseSide {
    /// Boundaries that lie on one body; nothing if they have no edges, or lie on several.
    pub fn of_boundaries<'a>(mesh: &MacroMesh, boundaries: impl Iterator<Item = &'a Boundary>) -> Option<Self> {
        let mut edges: Vec<u32> = boundaries.flat_map(|boundary| boundary.edges.iter().copied()).collect();
        let body = mesh.body_beside(*edges.first()?);
        if edges.iter().any(|&edge| mesh.body_beside(edge) != body) {
            return None;
        }
        let step = (PLACES * edges.len()).div_ceil(MOST_PLACES);
        let on_edge = |&edge: &u32| {
            let spacing = step as f64 * mesh.edge_length(edge) / PLACES as f64;
            (0..=PLACES).map(move |k| {
                let t = k as f64 / PLACES as f64;
                let is_end = k == 0 || k == PLACES;
                Sight { place: mesh.edge_position(edge, t), normal: mesh.edge_normal(edge, t), spacing, is_end }
            })
        };
        let sights = edges.iter().step_by(step).flat_map(on_edge).collect();
        let length = edges.iter().map(|&edge| mesh.edge_length(edge)).sum();
        edges.sort_unstable();
        let [bow, sagitta] = sagittas(mesh, &edges);
        Some(Self { bow, sagitta, ..Self::new(Some(body), edges, length, sights) })
    }

    /// The surface of a rigid tool, which may look to either side of its curves.
    pub fn of_tool<'a>(surface: impl Iterator<Item = &'a CurvePiece>) -> Self {
        let (mut sights, mut length) = (Vec::new(), 0.0);
        for part in surface {
            let [from, to] = part.range;
            let at = |k: usize| from + (to - from) * k as f64 / PLACES_OF_TOOL as f64;
            let points: Vec<Point> = (0..=PLACES_OF_TOOL).map(|k| part.curve.point(at(k))).collect();
            let part_length: f64 = points.windows(2).map(|ends| (ends[1] - ends[0]).norm()).sum();
            length += part_length;
            for (k, &place) in points.iter().enumerate() {
                let normal = turn_right(part.curve.tangent(at(k)));
                let is_end = k == 0 || k == PLACES_OF_TOOL;
                let sight = |normal| Sight { place, normal, spacing: part_length / PLACES_OF_TOOL as f64, is_end };
                sights.extend([sight(normal), sight(-normal)]);
            }
        }
        Self::new(None, Vec::new(), length, sights)
    }

    fn new(body: Option<usize>, edges: Vec<u32>, length: f64, sights: Vec<Sight>) -> Self {
        let around = bounds(sights.iter().map(|sight| sight.place));
        let spacing = sights.iter().map(|sight| sight.spacing).fold(0.0, f64::max);
        Self { body, edges, length, sights, around, spacing, bow: 0.0, sagitta: 0.0 }
    }

    /// Places of the side that are within a distance of the box around another side.
    fn near(&self, other: &Self, distance: f64) -> Vec<&Sight> {
        let [low, high] = [other.around[0].add_scalar(-distance), other.around[1].add_scalar(distance)];
        self.sights.iter().filter(|sight| sight.place >= low && sight.place <= high).collect()
    }

    /// How another side is faced within two shares of a size, behind and ahead: far behind only what lies in both bodies counts.
    fn sight_of(&self, other: &Self, holds: BodyHolds, most: [f64; 2], size: f64) -> Option<Faced> {
        let reach = most.map(|share| share * size);
        let bows = 2.0 * (self.bow + other.bow);
        let (mut nearest, mut deepest, mut is_faced, mut behind) = (None::<f64>, 0.0_f64, false, Vec::new());
        let mut length = 0.0;
        let farthest = 1.5 * reach[1] + self.spacing + other.spacing;
        let others = other.near(self, farthest);
        for a in self.near(other, farthest) {
            let faced = others.iter().filter_map(|b| Some((a.faces(b, reach)?, b)));
            let is_shallow = |along: f64| along >= -CLOSE * reach[1];
            let faced = faced.inspect(|(along, b)| is_faced |= !a.is_end && !b.is_end && is_shallow(*along));
            let Some((along, b)) = faced.min_by(|a, b| a.0.abs().total_cmp(&b.0.abs())) else { continue };
            behind.extend((along < -bows.max(ALIKE * size)).then_some((along, [a.place, b.place])));
            if is_shallow(along) {
                length += a.spacing;
                deepest = deepest.min(along);
                nearest = nearest.into_iter().chain([along]).min_by(|a, b| a.abs().total_cmp(&b.abs()));
            }
        }
        let drawn = nearest.filter(|_| is_faced).map(|nearest| if deepest < -bows { deepest } else { nearest });
        let depth = self.depth(other, holds, behind);
        depth.or(drawn).map(|distance| Faced { distance, overlaps: depth.is_some(), length })
    }

    /// The largest depth of places behind each other, of this side and of another, between which both bodies are, after a quarter of
    /// the way and after three: half-way they are, too, between the far sides of bodies that overlap a little.
    fn depth(&self, other: &Self, holds: BodyHolds, mut behind: Vec<(f64, [Point; 2])>) -> Option<f64> {
        let bodies = [self.body?, other.body?];
        let is_held = |x: Point| bodies.iter().all(|&body| holds(body, x));
        behind.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut few = behind.iter().step_by(behind.len().div_ceil(LOOKED_AT).max(1));
        few.find(|(_, [a, b])| [0.25, 0.75].iter().all(|t| is_held(a + *t * (b - a)))).map(|(along, _)| *along)
    }

    /// Least distance along a normal at which another side is faced within `reach`, and where a third one is not.
    fn distance_beside(&self, other: &Self, third: Option<&Self>, reach: f64) -> Option<f64> {
        let within = [CLOSE * reach, reach];
        let farthest = 1.5 * reach + self.spacing + third.map_or(0.0, |third| third.spacing).max(other.spacing);
        let [others, thirds] = [Some(other), third].map(|side| side.map_or_else(Vec::new, |side| side.near(self, farthest)));
        let places =
            self.near(other, farthest).into_iter().filter(|a| !a.is_end && thirds.iter().all(|b| a.faces(b, within).is_none()));
        places.flat_map(|a| others.iter().filter_map(|b| Some(a.faces(b, within)?.abs()))).reduce(f64::min)
    }

    /// Whether most of its places face another side within reach, all but against its normals.
    fn lies_along(&self, other: &Self, reach: f64) -> bool {
        let others = other.near(self, 1.5 * reach + self.spacing + other.spacing);
        let faces =
            |a: &Sight| others.iter().any(|b| a.normal.dot(&b.normal) <= ALONG && a.faces(b, [CLOSE * reach, reach]).is_some());
        self.sights.iter().filter(|a| faces(a)).count() as f64 >= MOSTLY * self.sights.len() as f64
    }

    /// Whether this side and another have an edge in common.
    fn shares_edges(&self, other: &Self) -> bool {
        let (few, many) = if self.edges.len() < other.edges.len() { (self, other) } else { (other, self) };
        few.edges.iter().any(|edge| many.edges.binary_search(edge).is_ok())
    }
}

/// How far straight edges that follow each other, and the chords of all edges, lie from the curve that they are drawn for (length): an
/// edge h of a curve that turns by θ from one edge to the next, or from its one end to the other, is off by h θ/8. Larger turns
/// between edges are corners.
fn sagittas(mesh: &MacroMesh, edges: &[u32]) -> [f64; 2] {
    let mut before: HashMap<u32, u32> = HashMap::new();
    let [mut straight, mut curved] = [0.0_f64; 2];
    for &edge in edges {
        let length = mesh.edge_length(edge);
        if mesh.edges[edge as usize].shape.is_some() {
            curved = curved.max(length * mesh.edge_normal(edge, 0.0).angle(&mesh.edge_normal(edge, 1.0)) / 8.0);
            continue;
        }
        for vertex in mesh.edges[edge as usize].vertices {
            let Some(other) = before.insert(vertex, edge) else { continue };
            let turn = mesh.edge_normal(edge, 0.5).angle(&mesh.edge_normal(other, 0.5));
            if turn <= WIDEST_TURN {
                straight = straight.max(length.max(mesh.edge_length(other)) * turn / 8.0);
            }
        }
    }
    [straight, straight.max(curved)]
}

/// Two sides of different bodies that face each other, by their indices.
struct FacingSides {
    sides: [usize; 2],
    /// Least distance (length); negative where they overlap.
    distance: f64,
    /// Size of that distance as a share of the smaller body.
    share: f64,
    /// Whether they lie in the bodies of each other.
    overlaps: bool,
    /// Over which share of the shorter one they face each other.
    faced: f64,
    length: f64,
}

/// All pairs of sides that face each other within two shares of the smaller of their bodies, behind and ahead, and are asked for; of
/// a body and a tool the body comes first, of others the first body of the mesh. The nearest come first, and of those as near the ones
/// that face each other all along; of two names for the same place the one of the shorter boundary, which says more.
fn facing_sides(
    mesh: &MacroMesh,
    sides: &[CloseSide],
    most: [f64; 2],
    is_asked: impl Fn(usize, usize) -> bool,
) -> Vec<FacingSides> {
    let sizes = body_sizes(mesh);
    let size = |side: &CloseSide| side.body.map_or(f64::INFINITY, |body| sizes[body]);
    let whole = sizes.iter().copied().fold(0.0, f64::max);
    // Two discs reach each other wherever their boxes come as near as half the sum of what each may reach.
    let disc = |side: &CloseSide| {
        let [low, high] = side.around;
        let radius = 0.5 * (high - low).norm() + 0.75 * most[1] * size(side).min(whole) + side.spacing;
        Disc { middle: 0.5 * (low + high), radius }
    };
    let discs: Vec<Disc> = sides.iter().map(disc).collect();
    let of_bodies = mesh.triangles_by_body();
    let holds = |body: usize, x: Point| of_bodies[body].iter().any(|&triangle| mesh.locate(triangle, x).is_some());
    let mut candidates = Vec::new();
    overlapping_discs(&discs, &discs, |a, b| {
        let bodies = [sides[a].body, sides[b].body];
        if a < b && bodies[0] != bodies[1] && is_asked(a, b) {
            let is_turned = bodies[1].is_some_and(|second| bodies[0].is_none_or(|first| second < first));
            candidates.push(if is_turned { [b, a] } else { [a, b] });
        }
    });
    candidates.sort_unstable();
    let facing = |[a, b]: [usize; 2]| {
        let [first, second] = [&sides[a], &sides[b]];
        let size = size(first).min(size(second));
        let Faced { distance, overlaps, length: faced } = first.sight_of(second, &holds, most, size)?;
        let distance = if distance.abs() < 1e-9 * size { 0.0 } else { distance };
        let faced = (faced / first.length.min(second.length)).min(1.0);
        let (share, length) = (distance.abs() / size, first.length + second.length);
        Some(FacingSides { sides: [a, b], distance, share, overlaps, faced, length })
    };
    let mut pairs: Vec<FacingSides> = candidates.into_iter().filter_map(facing).collect();
    // In steps, so that the order does not hang on the last digit: of a thousandth of the body, and of a quarter of the side.
    let order = |pair: &FacingSides| ((1e3 * pair.share).round(), -(4.0 * pair.faced).round(), pair.length);
    pairs.sort_by(|a, b| order(a).partial_cmp(&order(b)).unwrap_or(std::cmp::Ordering::Equal));
    pairs
}

/// Pairs of named boundaries of different bodies that lie close and face each other, the nearest first. Of two bodies one pair
/// is enough, unless others touch too, elsewhere, or are drawn into each other; a body that is close to none has its nearest pair.
/// Pairs that are `taken` already, of two bodies each, are none of them, and neither is another name for their place.
pub fn close_pairs(mesh: &MacroMesh, taken: &[[String; 2]]) -> Vec<ClosePair> {
    let side = |boundary: &Boundary| CloseSide::of_boundaries(mesh, std::iter::once(boundary));
    let named = mesh.boundaries.iter().filter(|boundary| !boundary.is_union);
    let (boundaries, mut sides): (Vec<&Boundary>, Vec<CloseSide>) =
        named.filter_map(|boundary| Some((boundary, side(boundary)?))).unzip();
    let count = sides.len();
    let (mut chosen, mut met) = (Vec::new(), HashSet::new());
    let mut alike: HashMap<[Option<usize>; 2], Vec<[usize; 2]>> = HashMap::new();
    for between in taken {
        let both = between.each_ref().map(|name| mesh.boundary(name).and_then(side));
        let [Some(mut first), Some(mut second)] = both else { continue };
        if second.body < first.body {
            std::mem::swap(&mut first, &mut second);
        }
        let bodies = [first.body, second.body];
        met.extend(bodies);
        alike.entry(bodies).or_default().push([sides.len(), sides.len() + 1]);
        sides.extend([first, second]);
    }
    let sizes = body_sizes(mesh);
    for pair in facing_sides(mesh, &sides, [APART; 2], |a, b| a < count && b < count) {
        let bodies = pair.sides.map(|side| sides[side].body);
        let [Some(first), Some(second)] = bodies else { continue };
        let size = sizes[first].min(sizes[second]);
        let others = alike.entry(bodies).or_default();
        let is_meant = match others.is_empty() {
            true => pair.overlaps || pair.share <= CLOSE || bodies.iter().any(|body| !met.contains(body)),
            false if pair.overlaps => others.iter().all(|other| pair.shares(&sides, *other) != [true; 2]),
            false => {
                let is_further = |other: &[usize; 2]| pair.is_beside(&sides, *other, size) || pair.goes_on(&sides, *other, size);
                pair.share <= TOUCHING && others.iter().all(is_further)
            }
        };
        if is_meant {
            others.push(pair.sides);
            met.extend(bodies);
            let between = pair.sides.map(|side| boundaries[side].name.clone());
            chosen.push(ClosePair { between, bodies: [first, second], distance: pair.distance, size });
        }
    }
    chosen
}

impl FacingSides {
    /// Whether each side has edges in common with that of another pair.
    fn shares(&self, sides: &[CloseSide], other: [usize; 2]) -> [bool; 2] {
        [0, 1].map(|k| sides[self.sides[k]].shares_edges(&sides[other[k]]))
    }

    /// Whether a side that has no edge in common with that of another pair lies along the other one, and so close that it may press soon: the
    /// crown of a rail beside the shoulder on which a wheel is drawn.
    fn goes_on(&self, sides: &[CloseSide], other: [usize; 2], size: f64) -> bool {
        let shared = self.shares(sides, other);
        let [first, second] = self.sides.map(|side| &sides[side]);
        let lies_along = [(first, second), (second, first)].map(|(own, faced)| own.lies_along(faced, TOUCHING * size));
        shared != [true; 2] && (0..2).all(|k| shared[k] || lies_along[k])
    }

    /// Whether the sides come as close as they do beside another pair of the same bodies of that size, too: they touch elsewhere, and
    /// are no other names for the same place, nor what goes on from there.
    fn is_beside(&self, sides: &[CloseSide], other: [usize; 2], size: f64) -> bool {
        let shared = self.shares(sides, other);
        let [first, second] = self.sides.map(|side| &sides[side]);
        // Between two places of one edge a gap changes by as much as its chord is off.
        let chords = (2.0 * (first.sagitta + second.sagitta)).max(ALIKE * size);
        (0..2).filter(|&k| shared[k] || shared == [false; 2]).all(|k| {
            let [own, faced, third] = [self.sides[k], self.sides[1 - k], other[1 - k]].map(|side| &sides[side]);
            let [all, beside] = [None, Some(third)].map(|third| own.distance_beside(faced, third, TOUCHING * size));
            beside.zip(all).is_some_and(|(beside, all)| beside <= all + chords)
        })
    }
}

/// Pairs of sides, by their indices, that are asked for, lie close and face each other, in their order; an edge of two bodies is in
/// two of them only where these touch beside each other. What is asked for is the same both ways.
pub fn close_sides(mesh: &MacroMesh, sides: &[CloseSide], is_asked: impl Fn(usize, usize) -> bool) -> Vec<[usize; 2]> {
    let mut alike: HashMap<[Result<usize, usize>; 2], Vec<[usize; 2]>> = HashMap::new();
    let sizes = body_sizes(mesh);
    for pair in facing_sides(mesh, sides, [CLOSE * CLOSE, CLOSE], is_asked) {
        // Each tool is a body of its own.
        let others = alike.entry(pair.sides.map(|side| sides[side].body.ok_or(side))).or_default();
        let size = pair.sides.iter().filter_map(|&side| sides[side].body).map(|body| sizes[body]).fold(f64::INFINITY, f64::min);
        let is_meant = |other: &[usize; 2]| pair.shares(sides, *other) == [false; 2] || pair.is_beside(sides, *other, size);
        if others.iter().all(is_meant) {
            others.push(pair.sides);
        }
    }
    let mut chosen: Vec<[usize; 2]> = alike.into_values().flatten().collect();
    chosen.sort_unstable();
    chosen
}

/// Diagonal of the box around each body.
fn body_sizes(mesh: &MacroMesh) -> Vec<f64> {
    let mut boxes = vec![[Point::repeat(f64::INFINITY), Point::repeat(f64::NEG_INFINITY)]; mesh.bodies.len()];
    for (piece, [low, high]) in mesh.pieces.iter().zip(mesh.bounds()) {
        let [least, most] = &mut boxes[piece.body];
        (*least, *most) = (least.inf(low), most.sup(high));
    }
    boxes.iter().map(|[low, high]| (high - low).norm()).collect()
}

#[cfg(test)]
mod tests;
