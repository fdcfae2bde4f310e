//! Rows of `B` and weighted gaps of all contacts, shared by all ranks.

use super::{Contact, Scene, SystemError};
use crate::contact::{GapChoice, Law, Quadrature, Side, declared_gap, integrate};
use crate::geometry::Point;
use crate::mesh::EdgeNode;
use crate::petsc::Session;

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
        let mut own = Share::new(contacts);
        session.agree(own.integrate(contacts)).map_err(SystemError::Case)?;
        let Share { keys, values, mut gap, mut points } = own;
        session.sum(&mut gap);
        session.sum(&mut points);
        let rows = rows(contacts, &session.gather_all(&keys), &session.gather_all(&values));
        add_declared_gaps(contacts, &mut gap)?;
        let lost = |(contact, points): (&Contact, f64)| match contact.pair.quadrature {
            Quadrature::Cut => 0,
            Quadrature::Segment { points: each } => (2 * each * contact.boundary.segments()).saturating_sub(points as usize),
        };
        let lost = contacts.iter().zip(points).map(lost).collect();
        Ok(Self { rows, gap, owners: contacts.iter().flat_map(|contact| owners(scene, contact)).collect(), lost })
    }
}

/// What the edges of one rank contribute to all contacts.
struct Share {
    /// Number of the contact times two, plus the body's (0, 1); multiplier; edge and position of the node: four for each entry.
    keys: Vec<i32>,
    /// Two components for each entry.
    values: Vec<f64>,
    /// Part of `c`.
    gap: Vec<f64>,
    /// Quadrature points taken in each contact.
    points: Vec<f64>,
}

impl Share {
    fn new(contacts: &[Contact]) -> Self {
        let count = contacts.last().map_or(0, |contact| contact.range().end);
        Self { keys: Vec::new(), values: Vec::new(), gap: vec![0.0; count], points: vec![0.0; contacts.len()] }
    }

    fn integrate(&mut self, contacts: &[Contact]) -> Result<(), SystemError> {
        for (number, contact) in contacts.iter().enumerate() {
            for (k, side) in [Side::First, Side::Second].into_iter().enumerate() {
                let (rule, edges) = (contact.pair.quadrature, &contact.edges[k]);
                let own = integrate(&contact.boundary, &contact.multipliers, rule, side, edges, &contact.distance(k))
                    .map_err(|words| SystemError::Case(format!("contact.{}: {words}", contact.pair.name)))?;
                own.gap.iter().enumerate().for_each(|(i, value)| self.gap[contact.first + i] += value);
                self.points[number] += own.points as f64;
                for entry in own.entries {
                    let [i, edge, position] = [entry.multiplier as u32, entry.node.edge, entry.node.position];
                    self.keys.extend([2 * number as u32 + k as u32, i, edge, position].map(|key| key as i32));
                    self.values.extend([entry.value.x, entry.value.y]);
                }
            }
        }
        Ok(())
    }
}

/// Rows of `B` from the keys and values of all ranks.
fn rows(contacts: &[Contact], keys: &[i32], values: &[f64]) -> Vec<Vec<Coupled>> {
    let mut rows = vec![Vec::new(); contacts.last().map_or(0, |contact| contact.range().end)];
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
    rows
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
                .map_err(|words| SystemError::Case(format!("contact.{}.gap: {words}", contact.pair.name)))?;
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
