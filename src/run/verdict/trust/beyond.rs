//! What speaks against pressures and forces though no difference between meshes shows it: motions and strains beyond the model,
//! locking, a solve that has stopped early, contact within segments.

use crate::body::BodyPart;
use crate::case::Case;
use crate::element::Order;
use crate::output::Summary;
use crate::output::summary::{ContactSummary, ZoneSummary};
use crate::run::verdict::limits::{
    CUT_AT_JOINT, CUT_OFF, Doubt, GROWTH, HELD_FORCE, LITTLE_SLIP, LOST_AT_ENDS, OVERLAP_BEYOND, P1_LOCKS, RESIDUAL, ROTATION,
    SLANT, SLIP, SLIP_AT_ENDS, STRAIN, TURNING, WITHIN_SEGMENTS, percent,
};
use crate::run::words::short;

/// All of it, of one contact. Of one that carries nothing what is measured by its own length or force does not count.
pub fn doubts_beyond(summary: &Summary, contact: &ContactSummary, case: &Case, carries: bool) -> Vec<Doubt> {
    let own =
        slip_doubt(contact).into_iter().chain(end_doubt(contact)).chain(unresolved_doubt(contact)).chain(cut_doubt(contact));
    let own = own.chain(OVERLAP_BEYOND.judge(contact.missing_beyond, &[])).chain(SLANT.judge(contact.slant, &[]));
    let joint = CUT_AT_JOINT.judge(contact.cut_at_joint, &[]).into_iter().chain(HELD_FORCE.judge(contact.held_force, &[]));
    let turning = turning_doubt(contact).filter(|_| carries || contact.zones.is_empty());
    let residual = summary.solver.residual.filter(|_| !case.solver.goes_by_estimate());
    let bodies = strain_doubts(summary).into_iter().chain(rotation_doubts(summary)).chain(locking_doubt(case));
    own.filter(|_| carries).chain(joint).chain(turning).chain(bodies).chain(RESIDUAL.judge(residual, &[])).collect()
}

/// What tells that curved bodies have slid along each other too far for normals of the undeformed ones.
pub fn slip_doubt(contact: &ContactSummary) -> Option<Doubt> {
    let (slip, error) = (contact.slip?, contact.slip_error?);
    let by_turning = contact.rotation_error.is_some_and(|turning| turning > SLIP.value && turning > 0.5 * error);
    SLIP.judge(Some(error).filter(|_| slip > LITTLE_SLIP && !by_turning), &[("slip", &short(slip))])
}

/// What tells that contact goes on beyond the end of its boundary.
fn cut_doubt(contact: &ContactSummary) -> Option<Doubt> {
    let cut_off = ZoneSummary::counting(&contact.zones).filter_map(|zone| zone.cut_off);
    CUT_OFF.judge(cut_off.reduce(f64::max), &[])
}

/// What tells that bodies have slid along each other so far that they have another length in common, or lie elsewhere.
pub fn end_doubt(contact: &ContactSummary) -> Option<Doubt> {
    LOST_AT_ENDS.judge(contact.lost_at_ends, &[]).or_else(|| SLIP_AT_ENDS.judge(contact.slip_at_ends, &[]))
}

/// What tells that bodies have turned too far for a theory that makes larger what turns.
pub fn turning_doubt(contact: &ContactSummary) -> Option<Doubt> {
    if contact.zones.is_empty() {
        return GROWTH.judge(contact.rotation_error, &[]);
    }
    // Sliding and turning may undo each other, as where a round body turns about its centre.
    let is_left = contact.slip_error.is_none_or(|error| error > SLIP.value);
    TURNING.judge(contact.rotation_error.filter(|_| is_left), &[])
}

/// What tells that bodies are strained beyond a theory of small strain.
pub fn strain_doubts(summary: &Summary) -> Vec<Doubt> {
    let most = percent(STRAIN.value);
    let strained = summary.strain_max.iter();
    strained.filter_map(|(body, strain)| STRAIN.judge(*strain, &[("of", body), ("most", &most)])).collect()
}

/// What tells that bodies turn farther than any theory of small rotations goes.
pub fn rotation_doubts(summary: &Summary) -> Vec<Doubt> {
    let far = summary.rotation_max.iter().filter_map(|(body, angle)| Some((body, angle.filter(|a| a.abs() > ROTATION.value)?)));
    far.map(|(body, angle)| ROTATION.doubt(angle, &[("of", body)])).collect()
}

/// What tells that P1 triangles have locked: meshes that all lock alike have differences that say too little.
fn locking_doubt(case: &Case) -> Option<Doubt> {
    let mut parts = case.bodies.iter().flat_map(|body| &body.parts).filter(|_| case.mesh.order == Order::P1);
    parts.find_map(|BodyPart { name, material, .. }| {
        P1_LOCKS.judge(Some(material.poisson_in_plane()), &[("of", name), ("poisson", &material.poisson.to_string())])
    })
}

/// What tells of contact that is narrower than a segment.
pub fn unresolved_doubt(contact: &ContactSummary) -> Option<Doubt> {
    let force = contact.force.unwrap_or(0.0).abs();
    let off = contact.unresolved_force.filter(|off| *off > WITHIN_SEGMENTS.value * force)?;
    let worth = if force > 0.0 {
        format!(": to press them apart would take {} times its force", short(off / force))
    } else {
        String::new()
    };
    Some(WITHIN_SEGMENTS.doubt(off, &[("worth", &worth)]))
}
