//! Rows of `B` and weighted gaps of all contacts. A row is on the rank that owns its multiplier, and where it is needed.
//!
//! # In parallel
//!
//! Body 1 and body 2 never meet. Γ_C, its segments and its multipliers are O(√N) numbers, computed by the same pure functions
//! on every rank. Then
//!
//! 1. each rank runs over the boundary edges **it owns**, of any body, projects their ends onto Γ_C, cuts, and integrates ∫ψ_i
//!    N_j n ds and its share of the gap;
//! 2. the entries, some per boundary node, go to the rank that owns the multiplier, which sends the whole row to those that
//!    need it: two exchanges, one sum for the gaps, and the agreement that no rank has failed are the only communication of the
//!    coupling;
//! 3. each rank inserts the rows of B, and of BᵀDB, that it owns. A multiplier belongs to the rank that owns body 1's macro
//!    triangle at the middle of its segment.
//!
//! No rank ever searches the other body's mesh, no parallel search structure exists, and bodies may lie on the ranks in any
//! way. Rows of B on the coarser levels, B_l = B_{l+1} P_{l+1}, follow from the same lists. A rank keeps those rows that it
//! needs: on the finest level those of its own multipliers, and on each level those that couple to a node of its own there.
//! What every rank holds of the whole of Γ_C are a few numbers for each segment: its ends, moduli, λ, gap, weight and state;
//! while it is asked whether contact holds the bodies, what each segment resists; where boundaries follow the solution, the
//! displacement of their nodes; and after the solve the values along Γ_C that are judged. Rank 0 alone writes these.

use crate::contact::{GapChoice, Law, Quadrature, Side, declared_gap, integrate};
use crate::discretisation::contacts::contact::Contact;
use crate::discretisation::error::SystemError;
use crate::discretisation::scene::Scene;
use crate::discretisation::space::Space;
use crate::geometry::Point;
use crate::mesh::EdgeNode;
use crate::petsc::Session;
use std::collections::{BTreeSet, HashMap};
use std::ops::Range;

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

/// All contacts coupled: rows of `B`, and weighted initial gaps `c`, which are the same on every rank.
pub struct Coupling {
    /// For each multiplier of all contacts, the nodes it couples to: whole on the rank that owns the multiplier, and on those that
    /// own a macro edge of these, or an end of one, on some level, also if only a multiplier that the mass matrix couples to it has
    /// such nodes; empty on others.
    pub rows: Vec<Vec<Coupled>>,
    /// `c_i = ∫ψ_i g₀ ds` (length squared).
    pub gap: Vec<f64>,
    /// Rank that owns each multiplier.
    pub owners: Vec<usize>,
    /// Quadrature points of each contact, fixed on its segments, at which a body has no edge; of both bodies together.
    pub lost: Vec<usize>,
}

impl Coupling {
    /// Each rank integrates the edges it owns. What it finds for a multiplier goes to the rank that owns that, which sends the whole
    /// row to those that need it. **Collective**
    ///
    /// # Errors
    /// [`SystemError::Case`] if a normal of Γ_C misses a declared geometry.
    pub fn new(scene: &Scene, spaces: &[Space], contacts: &[Contact], session: &Session) -> Result<Self, SystemError> {
        let mut own = Share::new(contacts);
        session.agree(own.integrate(contacts))?;
        let Share { entries, mut gap, points } = own;
        let count = gap.len();
        gap.extend(points);
        session.sum(&mut gap);
        let points = gap.split_off(count);
        let owners: Vec<usize> = contacts.iter().flat_map(|contact| owners(scene, contact)).collect();
        let to: Vec<usize> = entries.rows().map(|row| owners[row]).collect();
        let own = entries.sent(&to, session).into_rows(contacts);
        let rows = where_needed(scene, spaces, contacts, &own, session);
        add_declared_gaps(contacts, &mut gap)?;
        let lost = |(contact, points): (&Contact, f64)| match contact.pair.quadrature {
            Quadrature::Cut => 0,
            Quadrature::Segment { points: each } => (2 * each * contact.boundary.segments()).saturating_sub(points as usize),
        };
        let lost = contacts.iter().zip(points).map(lost).collect();
        Ok(Self { rows, gap, owners, lost })
    }

    /// Those of some multipliers that a rank owns.
    pub fn own(&self, multipliers: Range<usize>, rank: usize) -> impl Iterator<Item = usize> {
        multipliers.filter(move |&i| self.owners[i] == rank)
    }
}

/// Rows of `B` and weighted gaps of contacts whose edges are all on this rank.
///
/// # Errors
/// As of [`Coupling::new`].
pub fn coupled_here(contacts: &[Contact]) -> Result<(Vec<Vec<Coupled>>, Vec<f64>), SystemError> {
    let mut own = Share::new(contacts);
    own.integrate(contacts)?;
    let Share { entries, mut gap, .. } = own;
    add_declared_gaps(contacts, &mut gap)?;
    Ok((entries.into_rows(contacts), gap))
}

/// What the edges of one rank contribute to all contacts.
struct Share {
    entries: Entries,
    /// Part of `c`.
    gap: Vec<f64>,
    /// Quadrature points taken in each contact.
    points: Vec<f64>,
}

impl Share {
    fn new(contacts: &[Contact]) -> Self {
        let count = contacts.last().map_or(0, |contact| contact.range().end);
        Self { entries: Entries::default(), gap: vec![0.0; count], points: vec![0.0; contacts.len()] }
    }

    fn integrate(&mut self, contacts: &[Contact]) -> Result<(), SystemError> {
        for (number, contact) in contacts.iter().enumerate() {
            for (k, side) in [Side::First, Side::Second].into_iter().enumerate() {
                let (rule, edges) = (contact.pair.quadrature, &contact.edges[k]);
                let own = integrate(&contact.boundary, &contact.multipliers, rule, side, edges, &contact.distance(k))
                    .map_err(|words| format!("contact.{}: {words}", contact.pair.name))?;
                own.gap.iter().enumerate().for_each(|(i, value)| self.gap[contact.first + i] += value);
                self.points[number] += own.points as f64;
                for entry in own.entries {
                    self.entries.add(contact.first + entry.multiplier, k, entry.node, entry.value);
                }
            }
        }
        Ok(())
    }
}

/// Entries of `B` as ranks send them to each other.
#[derive(Default)]
struct Entries {
    /// Multiplier, number of the body (0, 1), edge and position of the node: four for each entry.
    keys: Vec<i32>,
    /// Two components for each entry.
    values: Vec<f64>,
}

impl Entries {
    fn add(&mut self, row: usize, body: usize, node: EdgeNode, value: Point) {
        self.keys.extend([row as u32, body as u32, node.edge, node.position].map(|key| key as i32));
        self.values.extend_from_slice(value.as_slice());
    }

    /// The multiplier of each.
    fn rows(&self) -> impl Iterator<Item = usize> {
        self.keys.iter().step_by(4).map(|row| *row as usize)
    }

    /// What ranks have sent here, if this one sends each entry to a rank. **Collective**
    fn sent(&self, to: &[usize], session: &Session) -> Self {
        Self { keys: session.send_to(to, &self.keys, 4), values: session.send_to(to, &self.values, 2) }
    }

    /// By multipliers, of all contacts.
    fn into_rows(self, contacts: &[Contact]) -> Vec<Vec<Coupled>> {
        let mut rows = vec![Vec::new(); contacts.last().map_or(0, |contact| contact.range().end)];
        for (key, value) in self.keys.chunks_exact(4).zip(self.values.chunks_exact(2)) {
            let (row, k) = (key[0] as usize, key[1] as usize);
            rows[row].push(Coupled {
                node: EdgeNode { edge: key[2] as u32, position: key[3] as u32 },
                body: Contact::of_multiplier(contacts, row).bodies[k],
                side: [Side::First, Side::Second][k],
                value: Point::new(value[0], value[1]),
            });
        }
        rows.iter_mut().for_each(Vec::shrink_to_fit);
        rows
    }
}

/// Rows of `B` where they are needed, from those that their owners have. On coarser levels, of which other ranks may have a part,
/// a node hands its entries to nodes of its macro edge, or to the ends of that. **Collective**
fn where_needed(
    scene: &Scene,
    spaces: &[Space],
    contacts: &[Contact],
    own: &[Vec<Coupled>],
    session: &Session,
) -> Vec<Vec<Coupled>> {
    let mut known: HashMap<u32, BTreeSet<usize>> = HashMap::new();
    let ranks_of = |edge: &u32| spaces.iter().flat_map(|space| space.numbering.ranks_of(&scene.mesh, *edge)).collect();
    let (mut entries, mut to) = (Entries::default(), Vec::new());
    for contact in contacts {
        for group in own[contact.range()].chunks(contact.multipliers.count() / contact.multipliers.groups()).enumerate() {
            let (first, group) = (contact.first + group.0 * group.1.len(), group.1);
            let mut ranks = BTreeSet::from([session.rank()]);
            for coupled in group.iter().flatten() {
                ranks.extend(known.entry(coupled.node.edge).or_insert_with_key(ranks_of).iter());
            }
            for rank in ranks {
                for (row, coupled) in group.iter().enumerate().flat_map(|(k, row)| row.iter().map(move |c| (first + k, c))) {
                    entries.add(row, usize::from(coupled.side == Side::Second), coupled.node, coupled.value);
                    to.push(rank);
                }
            }
        }
    }
    entries.sent(&to, session).into_rows(contacts)
}

/// Rank that owns each multiplier of a contact: that of its segment.
fn owners(scene: &Scene, contact: &Contact) -> Vec<usize> {
    let of_segments = contact.segment_owners(scene);
    (0..contact.multipliers.count()).map(|i| of_segments[contact.multipliers.segment_of(i)]).collect()
}

/// Adds the gaps that formulas declare; afterwards all gaps must be finite.
fn add_declared_gaps(contacts: &[Contact], gap: &mut [f64]) -> Result<(), SystemError> {
    for contact in contacts {
        if let GapChoice::Formula(formula) = &contact.pair.gap {
            let declared = declared_gap(&contact.boundary, &contact.multipliers, formula)
                .map_err(|words| format!("contact.{}.gap: {words}", contact.pair.name))?;
            declared.iter().enumerate().for_each(|(i, value)| gap[contact.first + i] += value);
        }
        if let Some(i) = gap[contact.range()].iter().position(|value| !value.is_finite()) {
            let (boundary, segment) = (&contact.boundary, contact.multipliers.segment_of(i));
            let x = boundary.point(0.5 * (boundary.knots()[segment] + boundary.knots()[segment + 1]));
            return Err(SystemError::Case(format!(
                "contact.{}.gap: it is no finite number near ({:.6}, {:.6}) on the contact boundary; correct the formula: it needs a value wherever the bodies may touch",
                contact.pair.name, x.x, x.y
            )));
        }
    }
    Ok(())
}

/// Which multipliers belong to bilateral contacts.
pub fn bilateral(contacts: &[Contact]) -> Vec<bool> {
    contacts.iter().flat_map(|c| vec![c.pair.law == Law::Bilateral; c.multipliers.count()]).collect()
}
