//! The physics that is solved: mesh, bodies, supports, loads and contacts, spread over ranks.

use super::SystemError;
use crate::body::{Body, Load, Support};
use crate::contact::{
    ContactBoundary, Distance, Extent, GapChoice, Jump, Law, MultiplierSpace, Multipliers, Pair, Quadrature, Side, Stabilise,
    all_edges, declared_gap, integrate, jumps, place, safe_ratio_of, segment_ratio, softer_edge_length,
};
use crate::element::{Order, PlaneStrain};
use crate::geometry::{Curve, Point};
use crate::mesh::{BoundaryEdge, EdgeNode, MacroMesh, Numbering, Partition};
use crate::petsc::Session;
use std::rc::Rc;

/// Segments are short if they miss the safe ratio by more than rounding to a whole number can.
const SHORT: f64 = 0.95;

/// Everything that defines the system, the same on every rank.
pub struct Scene {
    /// The macro mesh, bent onto its geometries.
    pub mesh: MacroMesh,
    /// Which rank owns what.
    pub partition: Rc<Partition>,
    /// Displacement elements.
    pub order: Order,
    /// Refinements of the macro mesh.
    pub refine: usize,
    /// Bodies, in the order of the mesh.
    pub bodies: Vec<Body>,
    /// Supports.
    pub supports: Vec<Support>,
    /// Loads.
    pub loads: Vec<Load>,
    /// Contact pairs.
    pub pairs: Vec<Pair>,
}

impl Scene {
    /// Plane-strain law of each body.
    pub fn laws(&self) -> Vec<PlaneStrain> {
        self.bodies.iter().map(|body| PlaneStrain::new(body.material.young, body.material.poisson)).collect()
    }

    /// Middle and half size of each body.
    pub fn extents(&self) -> Vec<Extent> {
        let extent = |body| {
            let [low, high] = self.mesh.bounds(body);
            Extent { middle: 0.5 * (low + high), radius: 0.5 * (high - low).norm() }
        };
        (0..self.bodies.len()).map(extent).collect()
    }
}

/// One contact of the scene: its boundary, its multipliers, and the edges of each body that this rank owns.
pub struct Contact {
    /// What the case asks for.
    pub pair: Pair,
    /// Γ_C.
    pub boundary: ContactBoundary,
    /// Its multipliers.
    pub multipliers: Multipliers,
    /// Number of its first multiplier among those of all contacts.
    pub first: usize,
    /// Harmonic mean `E_c` of the two moduli (stress): it follows the softer body.
    pub modulus: f64,
    /// Indices of body 1 and body 2.
    pub bodies: [usize; 2],
    /// Edges of body 1 and of body 2 whose macro triangle this rank owns.
    pub edges: [Vec<BoundaryEdge>; 2],
    /// Smallest ratio of a segment's length to the edges of the softer body that it meets.
    pub segment_ratio: f64,
    /// Ratio from which the pair of spaces is stable.
    pub safe_ratio: f64,
    /// Smooth boundaries of both bodies, where the gap is measured between them.
    pub shapes: Option<[Vec<Curve>; 2]>,
    /// The jump term, all contacts numbered through; empty if there is none.
    pub jumps: Vec<Jump>,
}

impl Contact {
    /// Places every contact of the scene on the finest level. `first` counts the multipliers on.
    ///
    /// # Errors
    /// [`SystemError::Case`] if a boundary cannot be placed.
    pub fn all(scene: &Scene, numbering: &Numbering, rank: usize) -> Result<Vec<Self>, SystemError> {
        let mut first = 0;
        let mut contacts = Vec::new();
        for pair in &scene.pairs {
            let contact = Self::new(scene, numbering, rank, pair, first)?;
            first += contact.multipliers.count();
            contacts.push(contact);
        }
        Ok(contacts)
    }

    fn new(scene: &Scene, numbering: &Numbering, rank: usize, pair: &Pair, first: usize) -> Result<Self, SystemError> {
        let sides = [0, 1].map(|k| scene.mesh.boundary(&pair.between[k]).map(|b| b.edges.clone()).unwrap_or_default());
        let bodies = [0, 1].map(|k: usize| scene.mesh.body_beside(sides[k][0]));
        let young = bodies.map(|body| scene.bodies[body].material.young);
        let boundary = place(&scene.mesh, numbering, pair, young)?;
        let own = |edge: &&u32| scene.partition.owner(scene.mesh.beside(**edge).0) == rank;
        let edges = sides
            .each_ref()
            .map(|edges| edges.iter().filter(own).flat_map(|&edge| BoundaryEdge::all_of(&scene.mesh, edge, numbering)).collect());
        let all = all_edges(&scene.mesh, numbering, pair);
        let segment_ratio = segment_ratio(&boundary, &all, young);
        let safe_ratio = safe_ratio_of(scene.order, pair.space, &all);
        let multipliers = Multipliers::new(pair.space, &boundary);
        let modulus = 2.0 / (1.0 / young[0] + 1.0 / young[1]);
        let stabilised = pair.space != MultiplierSpace::P1Continuous
            && match pair.stabilise {
                Stabilise::On => true,
                Stabilise::Auto => segment_ratio < SHORT * safe_ratio,
                Stabilise::Off => false,
            };
        let (multipliers, jumps) = if stabilised {
            let own = jumps(&multipliers, softer_edge_length(&boundary, &all, young), modulus);
            let numbered = own.into_iter().map(|jump| Jump { rows: jump.rows.map(|i| first + i), ..jump });
            (multipliers.stabilised(), numbered.collect())
        } else {
            (multipliers, Vec::new())
        };
        let measured = matches!(pair.gap, GapChoice::Geometry);
        let shapes = measured.then(|| sides.each_ref().map(|edges| scene.mesh.smooth_curves(edges)));
        Ok(Self {
            pair: pair.clone(),
            boundary,
            multipliers,
            first,
            modulus,
            bodies,
            edges,
            segment_ratio,
            safe_ratio,
            shapes,
            jumps,
        })
    }

    /// Whether its segments are shorter than its pair of spaces allows.
    pub fn has_short_segments(&self) -> bool {
        self.segment_ratio < SHORT * self.safe_ratio
    }

    /// Numbers of its multipliers.
    pub fn range(&self) -> std::ops::Range<usize> {
        self.first..self.first + self.multipliers.count()
    }

    /// Rank that owns body 1's macro triangle at the middle of each segment.
    fn segment_owners(&self, scene: &Scene) -> Vec<usize> {
        let edges = scene.mesh.boundary(&self.pair.between[0]).map(|b| b.edges.as_slice()).unwrap_or(&[]);
        let feet: Vec<[f64; 2]> = edges
            .iter()
            .map(|&edge| scene.mesh.edges[edge as usize].vertices.map(|v| self.boundary.foot(scene.mesh.vertices[v as usize])))
            .collect();
        let away = |t: f64, [a, b]: [f64; 2]| (a.min(b) - t).max(t - a.max(b)).max(0.0);
        let owner = |ends: &[f64]| {
            let t = 0.5 * (ends[0] + ends[1]);
            let nearest = (0..edges.len()).min_by(|&a, &b| away(t, feet[a]).total_cmp(&away(t, feet[b])));
            nearest.map_or(0, |k| scene.partition.owner(scene.mesh.beside(edges[k]).0))
        };
        self.boundary.knots().windows(2).map(owner).collect()
    }
}

/// One node's part in a multiplier's row of `B`, in global axes.
#[derive(Clone, Copy, Debug)]
pub struct Coupled {
    /// The node.
    pub node: EdgeNode,
    /// Index of its body.
    pub body: usize,
    /// Which body of the pair it is.
    pub side: Side,
    /// `± ∫ψ_i N_j n ds` (length).
    pub value: Point,
}

/// All contacts coupled: rows of `B` and weighted initial gaps `c`, the same on every rank.
pub struct Coupling {
    /// For each multiplier of all contacts, the nodes it couples to.
    pub rows: Vec<Vec<Coupled>>,
    /// `c_i = ∫ψ_i g₀ ds` (length squared).
    pub gap: Vec<f64>,
    /// Rank that owns each multiplier.
    pub owners: Vec<usize>,
    /// Quadrature points of each contact, fixed on its segments, at which a body has no edge; of both bodies together.
    pub lost: Vec<usize>,
}

impl Coupling {
    /// Each rank integrates the edges it owns; the results, O(√N) numbers, are then shared. **Collective**
    ///
    /// # Errors
    /// [`SystemError::Case`] if a normal of Γ_C misses a declared geometry.
    pub fn new(scene: &Scene, contacts: &[Contact], session: &Session) -> Result<Self, SystemError> {
        let count = contacts.last().map_or(0, |contact| contact.range().end);
        let (mut keys, mut values, mut gap) = (Vec::new(), Vec::new(), vec![0.0; count]);
        let mut points = vec![0.0; contacts.len()];
        let mut integrate_all = || -> Result<(), SystemError> {
            for (number, contact) in contacts.iter().enumerate() {
                for (k, side) in [Side::First, Side::Second].into_iter().enumerate() {
                    let distance = match &contact.shapes {
                        Some(shapes) => Distance::Curves(&shapes[k]),
                        None => Distance::Declared,
                    };
                    let (rule, edges) = (contact.pair.quadrature, &contact.edges[k]);
                    let own = integrate(&contact.boundary, &contact.multipliers, rule, side, edges, &distance)
                        .map_err(|words| SystemError::Case(format!("contact.{}: {words}", contact.pair.name)))?;
                    own.gap.iter().enumerate().for_each(|(i, value)| gap[contact.first + i] += value);
                    points[number] += own.points as f64;
                    for entry in own.entries {
                        let [i, edge, position] = [entry.multiplier as u32, entry.node.edge, entry.node.position];
                        keys.extend([2 * number as u32 + k as u32, i, edge, position].map(|key| key as i32));
                        values.extend([entry.value.x, entry.value.y]);
                    }
                }
            }
            Ok(())
        };
        session.agree(integrate_all()).map_err(SystemError::Case)?;
        session.sum(&mut gap);
        session.sum(&mut points);
        let (keys, values) = (session.gather_all(&keys), session.gather_all(&values));
        let mut rows = vec![Vec::new(); count];
        for (key, value) in keys.chunks_exact(4).zip(values.chunks_exact(2)) {
            let contact = &contacts[key[0] as usize / 2];
            let k = key[0] as usize % 2;
            rows[contact.first + key[1] as usize].push(Coupled {
                node: EdgeNode { edge: key[2] as u32, position: key[3] as u32 },
                body: contact.bodies[k],
                side: [Side::First, Side::Second][k],
                value: Point::new(value[0], value[1]),
            });
        }
        let mut owners = Vec::with_capacity(count);
        for contact in contacts {
            if let GapChoice::Formula(formula) = &contact.pair.gap {
                let declared = declared_gap(&contact.boundary, &contact.multipliers, formula);
                declared.iter().enumerate().for_each(|(i, value)| gap[contact.first + i] += value);
            }
            let segments = contact.segment_owners(scene);
            owners.extend((0..contact.multipliers.count()).map(|i| segments[contact.multipliers.segment_of(i)]));
        }
        for contact in contacts {
            if gap[contact.range()].iter().any(|value| !value.is_finite()) {
                let words = "its gap has no finite value somewhere on the contact boundary; correct the formula";
                return Err(SystemError::Case(format!("contact.{}.gap: {words}", contact.pair.name)));
            }
        }
        let lost = |(contact, points): (&Contact, f64)| match contact.pair.quadrature {
            Quadrature::Cut => 0,
            Quadrature::Segment { points: each } => (2 * each * contact.boundary.segments()).saturating_sub(points as usize),
        };
        Ok(Self { rows, gap, owners, lost: contacts.iter().zip(points).map(lost).collect() })
    }
}

/// Which multipliers belong to bilateral contacts.
pub fn bilateral(contacts: &[Contact]) -> Vec<bool> {
    contacts.iter().flat_map(|c| vec![c.pair.law == Law::Bilateral; c.multipliers.count()]).collect()
}
