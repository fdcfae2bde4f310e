//! A contact of the scene, placed and cut, with the edges of this rank.

use crate::contact::{
    Configuration, ContactBoundary, Displacement, Distance, Facing, GapChoice, Jump, Known, MultiplierSpace, Multipliers, Pair,
    Placed, Stabilise, Zone, jumps, place, safe_ratio_of, segment_edge_lengths, segment_ratio,
};
use crate::discretisation::contacts::side_materials::SideMaterials;
use crate::discretisation::error::SystemError;
use crate::discretisation::scene::Scene;
use crate::geometry::{Curve, Point};
use crate::mesh::{BoundaryEdge, Numbering};
use std::cmp::Ordering;
use std::collections::HashSet;

/// Segments are short if they miss the safe ratio by more than rounding to a whole number can.
const SHORT: f64 = 0.95;

/// The same of continuous multipliers, which are stable down to .56 edges with P2 and .75 with P1. Where Γ_C follows the ends of
/// contact its segments become shorter by a fifth, and these ends find no rest beside a jump term that comes and goes.
const SHORT_CONTINUOUS: f64 = 0.75;

/// Corners within a side that are flatter (radians) raise λ by less than 6e-4 of E* from one mesh to the next of half the edges: by
/// E* θ ln 2/(2π), as a wedge does (Johnson, Contact mechanics, 1985, 5.2).
const TELLING_CORNER: f64 = 5e-3;

/// One contact of the scene: its boundary, its multipliers, and the edges of each body that this rank owns.
#[derive(Clone)]
pub struct Contact {
    /// What the case asks for.
    pub pair: Pair,
    /// Γ_C.
    pub boundary: ContactBoundary,
    /// Its multipliers.
    pub multipliers: Multipliers,
    /// Number of its first multiplier among those of all contacts.
    pub first: usize,
    /// Harmonic mean `E_c` of the two moduli beside each segment (stress): it follows the softer body.
    pub moduli: Vec<f64>,
    /// `1/E'₁ + 1/E'₂` by the plane moduli of both surfaces (1/stress), of the softest part of each.
    pub compliance: f64,
    /// E_c for each multiplier.
    pub multiplier_moduli: Vec<f64>,
    /// Indices of body 1 and body 2.
    pub bodies: [usize; 2],
    /// Part of each body beside its boundary; the softest one if there are several.
    pub parts: [usize; 2],
    /// Parameters of Γ_C at which edges between two materials of a body end, or a side has a corner.
    pub joints: Vec<f64>,
    /// Edges of body 1 and of body 2 whose macro triangle this rank owns, where contact is modelled.
    pub edges: [Vec<BoundaryEdge>; 2],
    /// Smallest ratio of a segment's length to the edges of the softer body that it meets.
    pub segment_ratio: f64,
    /// Mean length of the softer body's edges beside each segment.
    pub edge_lengths: Vec<f64>,
    /// Ratio from which the pair of spaces is stable.
    pub safe_ratio: f64,
    /// Smooth boundaries of both bodies, where the gap is measured between them.
    pub shapes: Option<[Vec<Curve>; 2]>,
    /// The jump term, all contacts numbered through; empty if there is none.
    pub jumps: Vec<Jump>,
    /// What it was placed by, to be placed again.
    pub known: Known,
    /// Where its ends were found to lie after the last solve, if they follow the bodies: beside those it was solved on.
    pub found: Option<[Point; 2]>,
    /// Parameters of Γ_C beyond which one of the bodies has no boundary; infinite where both go all around.
    pub limits: [f64; 2],
    /// Displacement of body 1 and of body 2 at both ends of Γ_C, where it lies on deformed bodies; zero elsewhere.
    pub moved: [[Point; 2]; 2],
    /// Whether a load acts on the boundary of body 1, and of body 2: its stress is not that of the contact alone.
    pub loaded: [bool; 2],
    /// Whether body 1, and body 2, is a rigid tool.
    pub rigid: [bool; 2],
}

impl Contact {
    /// Whether Γ_C ends where a body does, at its first end and at its last.
    pub fn ends_with_a_body(&self) -> [bool; 2] {
        let [first, last] = self.boundary.ends();
        [first <= self.limits[0], last >= self.limits[1]]
    }

    /// The contact of a multiplier, of all contacts.
    pub fn of_multiplier(all: &[Self], multiplier: usize) -> &Self {
        &all[all.partition_point(|contact| contact.first <= multiplier) - 1]
    }

    /// The segment at an arc length of Γ_C.
    pub fn segment_at(&self, arc: f64) -> usize {
        let arcs = self.boundary.arcs();
        arcs.partition_point(|&s| s <= arc).clamp(1, arcs.len() - 1) - 1
    }

    /// `E_c` at an arc length of Γ_C (stress).
    pub fn modulus_at(&self, arc: f64) -> f64 {
        self.moduli[self.segment_at(arc)]
    }

    /// Places every contact of the scene on the finest level, on the undeformed bodies.
    ///
    /// # Errors
    /// [`SystemError::Case`] if a boundary cannot be placed, the boundaries of a contact do not face each other, or two contacts
    /// claim the same place.
    pub fn all(scene: &Scene, numbering: &Numbering, rank: usize) -> Result<Vec<Self>, SystemError> {
        let nothing = vec![Known::default(); scene.pairs.len()];
        let contacts = Self::all_again(scene, numbering, rank, &nothing, &|_| Point::zeros())?;
        match not_facing(scene, numbering, &contacts).first() {
            Some((at, why)) => Err(SystemError::Case(format!("contact.{}: {why}", contacts[*at].pair.name))),
            None => Ok(contacts),
        }
    }

    /// Places every contact again, by what is `known` of each, on bodies moved by `displacement`.
    ///
    /// # Errors
    /// [`SystemError::Case`] if a boundary cannot be placed.
    pub fn all_again(
        scene: &Scene,
        numbering: &Numbering,
        rank: usize,
        known: &[Known],
        displacement: Displacement,
    ) -> Result<Vec<Self>, SystemError> {
        let mut first = 0;
        let mut contacts = Vec::new();
        for (pair, known) in scene.pairs.iter().zip(known) {
            let contact = Self::new(scene, numbering, rank, pair, first, known, displacement)?;
            first += contact.multipliers.count();
            contacts.push(contact);
        }
        Ok(contacts)
    }

    /// One contact by itself; `first` counts the multipliers on.
    ///
    /// # Errors
    /// As of [`Contact::all_again`].
    pub(crate) fn new(
        scene: &Scene,
        numbering: &Numbering,
        rank: usize,
        pair: &Pair,
        first: usize,
        known: &Known,
        displacement: Displacement,
    ) -> Result<Self, SystemError> {
        let placed = Self::placed(scene, numbering, pair, known, displacement)?;
        Ok(Self::on(scene, numbering, rank, pair, first, known, placed))
    }

    /// Γ_C of one contact, placed between all of its edges.
    ///
    /// # Errors
    /// As of [`Contact::all_again`].
    pub(crate) fn placed(
        scene: &Scene,
        numbering: &Numbering,
        pair: &Pair,
        known: &Known,
        displacement: Displacement,
    ) -> Result<Placed, SystemError> {
        let young = SideMaterials::new(scene, &sides(scene, pair)).ruling();
        let placed = place(&scene.mesh, numbering, pair, young, known, displacement);
        placed.map_err(|words| SystemError::Case(format!("contact.{}: {words}", pair.name)))
    }

    /// One contact on a Γ_C that was placed and cut for it.
    pub(crate) fn on(
        scene: &Scene,
        numbering: &Numbering,
        rank: usize,
        pair: &Pair,
        first: usize,
        known: &Known,
        placed: Placed,
    ) -> Self {
        let sides = sides(scene, pair);
        let bodies = [0, 1].map(|k: usize| scene.mesh.body_beside(sides[k][0]));
        let materials = SideMaterials::new(scene, &sides);
        let young = materials.ruling();
        let (boundary, all) = (placed.boundary, placed.edges);
        let own = |edge: &&BoundaryEdge| scene.partition.owner(edge.triangle as u32) == rank;
        let edges = all.each_ref().map(|edges| edges.iter().filter(own).cloned().collect());
        let segment_ratio = segment_ratio(&boundary, &all, young);
        let edge_lengths = segment_edge_lengths(&boundary, &all, young);
        let safe_ratio = safe_ratio_of(scene.order, pair.space, &all);
        let multipliers = Multipliers::new(pair.space, &boundary);
        let moduli = materials.moduli(&boundary, &all);
        let mut joints = materials.joints(&boundary, &all, numbering.level);
        joints.extend(corners(scene, pair, &boundary));
        let modulus_of = |i: usize| multipliers.mean_beside(i, &moduli);
        let multiplier_moduli: Vec<f64> = (0..multipliers.count()).map(modulus_of).collect();
        let (multipliers, jumps) = if is_stabilised(pair, segment_ratio < short(pair.space) * safe_ratio) {
            let own = jumps(&multipliers, &edge_lengths, &multiplier_moduli);
            let numbered = own.into_iter().map(|jump| Jump { rows: jump.rows.map(|i| first + i), ..jump });
            (multipliers.stabilised(), numbered.collect())
        } else {
            (multipliers, Vec::new())
        };
        let measured = matches!(pair.gap, GapChoice::Geometry);
        let shapes = measured.then(|| sides.each_ref().map(|edges| scene.mesh.smooth_curves(edges)));
        let (ends, segments) = (Some(boundary.ends()), Some(boundary.segments()));
        Self {
            pair: pair.clone(),
            known: Known { meeting: placed.meeting, ends, segments, coarser: known.coarser, touch: known.touch },
            found: None,
            limits: placed.limits,
            moved: placed.moved,
            rigid: bodies.map(|body| scene.is_rigid(body)),
            loaded: sides.each_ref().map(|edges| is_loaded(scene, edges)),
            boundary,
            multipliers,
            first,
            moduli,
            compliance: materials.softest.iter().map(|&part| scene.compliance(part)).sum(),
            multiplier_moduli,
            bodies,
            parts: materials.softest,
            joints,
            edges,
            segment_ratio,
            edge_lengths,
            safe_ratio,
            shapes,
            jumps,
        }
    }

    /// Whether its segments are shorter than its pair of spaces allows.
    pub fn has_short_segments(&self) -> bool {
        self.segment_ratio < short(self.pair.space) * self.safe_ratio
    }

    /// Length of the longest edge of the softer body that its shortest segment meets.
    pub fn edge_length(&self) -> f64 {
        let shortest = (0..self.boundary.segments()).map(|k| self.boundary.segment_length(k)).fold(f64::INFINITY, f64::min);
        shortest / self.segment_ratio
    }

    /// Edges of the softer body on a zone; of one that begins on the axis of revolution those of its image, too.
    pub fn edges_on(&self, zone: &Zone) -> f64 {
        let count = self.edge_lengths.len();
        let own = zone.segments.clone().map(|k| self.boundary.segment_length(k) / self.edge_lengths[k % count]);
        self.images(zone) as f64 * own.sum::<f64>()
    }

    /// Segments of a zone; of one that begins on the axis of revolution those of its image, too.
    pub fn segments_on(&self, zone: &Zone) -> usize {
        self.images(zone) * zone.segments.len()
    }

    /// Two where a zone goes on beyond the axis of revolution as its own image, else one.
    fn images(&self, zone: &Zone) -> usize {
        let radius = |arc: f64| self.boundary.point(self.boundary.parameter_at(arc)).x;
        let is_on_axis = |arc: f64| radius(arc).abs() <= 1e-9 * self.boundary.length();
        if self.boundary.is_round() && zone.arcs.into_iter().any(is_on_axis) { 2 } else { 1 }
    }

    /// Whether its ends follow the pressure, if it has any.
    pub fn has_free_ends(&self) -> bool {
        self.pair.has_free_ends() && !self.boundary.is_closed()
    }

    /// Both ends of Γ_C, as well as they are known.
    pub fn ends(&self) -> [Point; 2] {
        self.found.unwrap_or_else(|| self.boundary.ends().map(|t| self.boundary.point(t)))
    }

    /// Numbers of its multipliers.
    pub fn range(&self) -> std::ops::Range<usize> {
        self.first..self.first + self.multipliers.count()
    }

    /// How the distance of a body from Γ_C is measured.
    pub fn distance(&self, body: usize) -> Distance<'_> {
        let is_shifted = self.known.meeting.as_ref().is_some_and(|meeting| meeting.shifts[body] != Point::zeros());
        match (&self.shapes, self.pair.configuration) {
            (None, _) => Distance::Declared,
            (Some(shapes), Configuration::Reference) if !is_shifted => Distance::Curves(&shapes[body]),
            (Some(shapes), _) => Distance::Places(&shapes[body]),
        }
    }

    /// Rank that owns body 1's macro triangle at the middle of each segment.
    pub(crate) fn segment_owners(&self, scene: &Scene) -> Vec<usize> {
        let edges = scene.mesh.edges_of(&self.pair.between[0]);
        let feet: Vec<[f64; 2]> = edges
            .iter()
            .map(|&edge| scene.mesh.edges[edge as usize].vertices.map(|v| self.boundary.foot(scene.mesh.vertices[v as usize])))
            .collect();
        let places = Places::new(feet);
        let owner = |ends: &[f64]| {
            let nearest = places.nearest(0.5 * (ends[0] + ends[1]));
            nearest.map_or(0, |k| scene.partition.owner(scene.mesh.beside(edges[k]).0))
        };
        self.boundary.knots().windows(2).map(owner).collect()
    }
}

/// Macro edges of both boundaries of a pair.
fn sides(scene: &Scene, pair: &Pair) -> [Vec<u32>; 2] {
    pair.between.each_ref().map(|name| scene.mesh.edges_of(name).to_vec())
}

/// Edges of a boundary by the parameters of Γ_C that they lie at, one after the other.
struct Places {
    /// Lower and upper parameter, and number of the edge; by their middles.
    ranges: Vec<([f64; 2], usize)>,
}

impl Places {
    fn new(feet: Vec<[f64; 2]>) -> Self {
        let mut ranges: Vec<_> = feet.into_iter().map(|[a, b]| [a.min(b), a.max(b)]).zip(0..).collect();
        ranges.sort_by(|(a, _), (b, _)| (a[0] + a[1]).total_cmp(&(b[0] + b[1])));
        Self { ranges }
    }

    /// The edge at a parameter, or the nearest one. Edges do not overlap, but for one that goes across the end of a closed Γ_C and
    /// seems to be as long as that: of two the shorter one counts.
    fn nearest(&self, t: f64) -> Option<usize> {
        let away = |[low, high]: [f64; 2]| (low - t).max(t - high).max(0.0);
        let after = self.ranges.partition_point(|(range, _)| range[0] + range[1] < 2.0 * t);
        let near = &self.ranges[after.saturating_sub(2)..(after + 2).min(self.ranges.len())];
        let key = |range: [f64; 2]| (away(range), range[1] - range[0]);
        near.iter().min_by(|(a, _), (b, _)| key(*a).partial_cmp(&key(*b)).unwrap_or(Ordering::Equal)).map(|(_, edge)| *edge)
    }
}

/// Parameters of Γ_C at which a side has a corner that tells within its ends.
fn corners(scene: &Scene, pair: &Pair, boundary: &ContactBoundary) -> Vec<f64> {
    let [first, last] = boundary.ends();
    let all = pair.between.iter().flat_map(|name| scene.mesh.corners_left(name));
    let feet = all.filter(|corner| corner.angle > TELLING_CORNER).map(|corner| boundary.foot(corner.place));
    feet.filter(|foot| (first..=last).contains(foot)).collect()
}

/// Whether a load acts on one of these edges.
fn is_loaded(scene: &Scene, edges: &[u32]) -> bool {
    let own: HashSet<u32> = edges.iter().copied().collect();
    scene.loads.iter().flat_map(|load| scene.mesh.edges_on(&load.on)).any(|edge| own.contains(&edge))
}

/// Share of the safe ratio below which segments are short.
fn short(space: MultiplierSpace) -> f64 {
    if space == MultiplierSpace::P1Continuous { SHORT_CONTINUOUS } else { SHORT }
}

/// Whether a contact gets the jump term: as the case asks, or where its segments are short.
fn is_stabilised(pair: &Pair, has_short_segments: bool) -> bool {
    match pair.stabilise {
        Stabilise::On => true,
        Stabilise::Auto => has_short_segments,
        Stabilise::Off => false,
    }
}

/// The boundaries of every contact must face each other, and no two contacts claim the same place: those that do not, and words.
pub(crate) fn not_facing(scene: &Scene, numbering: &Numbering, contacts: &[Contact]) -> Vec<(usize, String)> {
    let facing = contacts.iter().map(|contact| Facing::new(&scene.mesh, numbering, &contact.pair, &contact.boundary));
    Facing::refused(&facing.collect::<Vec<_>>(), &scene.mesh)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discretisation::levels::finest_numbering;
    use crate::discretisation::samples::{blocks, pair};

    #[test]
    fn multipliers_of_all_contacts_are_numbered_through() {
        let mut scene = blocks(pair(MultiplierSpace::P0, 3), |_| Point::zeros(), Vec::new());
        scene.pairs.extend([pair(MultiplierSpace::P1Discontinuous, 4), pair(MultiplierSpace::P1Continuous, 5)]);
        let numbering = finest_numbering(&scene).expect("a small mesh");
        let nothing = vec![Known::default(); 3];
        let all = Contact::all_again(&scene, &numbering, 0, &nothing, &|_| Point::zeros()).expect("they face each other");
        let ranges: Vec<_> = all.iter().map(Contact::range).collect();
        assert_eq!(ranges, [0..3, 3..11, 11..17]);
        assert!(Contact::all(&scene, &numbering, 0).is_err_and(|error| error.to_string().contains("one place of a boundary")));
    }
}
