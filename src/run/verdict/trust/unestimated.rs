//! What speaks against pressures and forces though no difference between meshes shows it: motions and strains beyond the model,
//! locking, a solve that has stopped early, contact within segments.

use super::doubt::Doubt;
use crate::body::BodyPart;
use crate::case::Case;
use crate::element::Order;
use crate::output::Summary;
use crate::output::summary;
use crate::run::report::short;

/// Sliding by less than this share of the length in contact changes no normal.
const LITTLE_SLIP: f64 = 0.02;

/// Largest share of the length in contact that bodies may lose by sliding at their ends, and by which one may slide along another
/// that goes on: the pressure on that one lies elsewhere by so much.
const MOST_LOST_AT_ENDS: f64 = 0.02;
const MOST_SLIP_AT_ENDS: f64 = 0.1;

/// Largest error of force and pressure by sliding, or by turning.
const MOST_SLIP_ERROR: f64 = 0.01;

/// Largest growth of bodies that turn, relative to the smallest gap of a contact where nothing presses.
const MOST_GROWTH: f64 = 0.5;

/// Largest mean strain of a macro triangle at which a theory of small strain still means something.
const MOST_STRAIN: f64 = 0.2;

/// Largest mean rotation of a body (radians): forces and lengths are off by half its square.
pub(crate) const MOST_ROTATION: f64 = 0.2;

/// Largest ν of P1 triangles whose pressure may be believed.
const MOST_POISSON: f64 = 0.495;

/// Share of the force that penetration within single segments may be worth: more is contact narrower than they are.
const MOST_UNRESOLVED: f64 = 0.1;

/// What mends a solution whose bodies turn too far.
const TURN_LESS: &str = "the theory is that of small rotations: draw the bodies as they lie after turning, and turn them by less";

/// Largest relative residual of the linear solve that no estimate has allowed: errors of force and pressure are up to a hundred
/// times as large.
const MOST_RESIDUAL: f64 = 1e-4;

/// All of it, of one contact. Of one that carries nothing what is measured by its own length or force does not count.
pub fn unestimated_doubts(
    summary: &Summary,
    contact: &summary::ContactSummary,
    case: &Case,
    shorter: &'static str,
    carries: bool,
) -> Vec<Doubt> {
    let own = slip_doubt(contact).into_iter().chain(end_doubt(contact)).chain(unresolved_doubt(contact, shorter));
    let turning = turning_doubt(contact).filter(|_| carries || contact.zones.is_empty());
    let bodies = strain_doubts(summary).into_iter().chain(rotation_doubts(summary)).chain(locking_doubt(case));
    own.filter(|_| carries).chain(turning).chain(bodies).chain(residual_doubt(summary, case)).collect()
}

/// What tells that curved bodies have slid along each other too far for normals of the undeformed ones.
pub(crate) fn slip_doubt(contact: &summary::ContactSummary) -> Option<Doubt> {
    let (slip, error) = (contact.slip?, contact.slip_error?);
    let by_turning = contact.rotation_error.is_some_and(|turning| turning > MOST_SLIP_ERROR && turning > 0.5 * error);
    (slip > LITTLE_SLIP && error > MOST_SLIP_ERROR && !by_turning).then(|| Doubt {
        cause: "the bodies slide too far along each other",
        figure: format!(
            "the bodies slide along each other by {} of the length in contact: force or pressure wrong by about {} (relative), at most {MOST_SLIP_ERROR} wanted",
            short(slip),
            short(error)
        ),
        remedy: "take configuration = \"deformed\"",
    })
}

/// What tells that bodies have slid along each other so far that they have another length in common, or lie elsewhere.
pub(crate) fn end_doubt(contact: &summary::ContactSummary) -> Option<Doubt> {
    let lost = contact.lost_at_ends.filter(|lost| *lost > MOST_LOST_AT_ENDS).map(|lost| {
        format!(
            "sliding takes {} of the length in contact from what the bodies have in common, at most {MOST_LOST_AT_ENDS} wanted: force or pressure wrong by about as much",
            short(lost)
        )
    });
    let slid = || {
        contact.slip_at_ends.filter(|slip| *slip > MOST_SLIP_AT_ENDS).map(|slip| {
            format!(
                "one body slides along the other by {} of the length in contact, at most {MOST_SLIP_AT_ENDS} wanted: the pressure lies elsewhere",
                short(slip)
            )
        })
    };
    Some(Doubt {
        cause: "sliding changes what the bodies have in common",
        figure: lost.or_else(slid)?,
        remedy: "draw the bodies as they lie after sliding, or take curve = \"fit\" with configuration = \"deformed\"",
    })
}

/// What tells that bodies have turned too far for a theory that makes larger what turns.
pub(crate) fn turning_doubt(contact: &summary::ContactSummary) -> Option<Doubt> {
    let error = contact.rotation_error?;
    let (cause, remedy) = ("the bodies turn too far", TURN_LESS);
    if contact.zones.is_empty() {
        let figure =
            format!("nothing presses, but bodies that turn grow in this theory, by {} times the smallest gap", short(error));
        return (error > MOST_GROWTH).then_some(Doubt { cause, figure, remedy });
    }
    // Sliding and turning may undo each other, as where a round body turns about its centre.
    let wrong = error > MOST_SLIP_ERROR && contact.slip_error.is_none_or(|error| error > MOST_SLIP_ERROR);
    let figure = || {
        format!("the bodies turn: force or pressure wrong by about {} (relative), at most {MOST_SLIP_ERROR} wanted", short(error))
    };
    wrong.then(|| Doubt { cause, figure: figure(), remedy })
}

/// What tells that bodies are strained beyond a theory of small strain.
pub(crate) fn strain_doubts(summary: &Summary) -> Vec<Doubt> {
    let large =
        summary.strain_max.iter().filter_map(|(body, strain)| Some((body, strain.filter(|strain| *strain > MOST_STRAIN)?)));
    let words = |(body, strain): (&String, f64)| {
        format!("body {body} strained by {:.0} %, at most {:.0} % wanted", 100.0 * strain, 100.0 * MOST_STRAIN)
    };
    let remedy = "press less, or correct the units of E, loads and displacements: the model is that of small strain";
    large.map(|found| Doubt { cause: "a body is strained too much", figure: words(found), remedy }).collect()
}

/// What tells that bodies turn farther than any theory of small rotations goes.
pub(crate) fn rotation_doubts(summary: &Summary) -> Vec<Doubt> {
    let far = summary.rotation.iter().filter_map(|(body, angle)| Some((body, angle.filter(|a| a.abs() > MOST_ROTATION)?)));
    let words = |(body, angle): (&String, f64)| format!("body {body} turns by {angle:.2}, at most {MOST_ROTATION} wanted");
    far.map(|found| Doubt { cause: "a body turns too far", figure: words(found), remedy: TURN_LESS }).collect()
}

/// What tells that P1 triangles have locked: meshes that all lock alike have differences that say too little.
pub(crate) fn locking_doubt(case: &Case) -> Option<Doubt> {
    let locks = |part: &&BodyPart| case.mesh.order == Order::P1 && part.material.poisson_in_plane() > MOST_POISSON;
    let part = case.bodies.iter().flat_map(|body| &body.parts).find(locks)?;
    let figure = format!("body {} has ν = {} with P1 triangles, at most {MOST_POISSON} wanted", part.name, part.material.poisson);
    Some(Doubt { cause: "P1 triangles lock", figure, remedy: "take mesh.order = 2: P1 triangles lock" })
}

/// What tells that the linear solve has stopped too early for its forces.
pub(crate) fn residual_doubt(summary: &Summary, case: &Case) -> Option<Doubt> {
    let residual = summary.solver.residual.filter(|residual| *residual > MOST_RESIDUAL)?;
    (!case.solver.goes_by_estimate()).then(|| Doubt {
        cause: "the linear solve has stopped early",
        figure: format!("the linear solve has stopped at a residual of {}, at most {MOST_RESIDUAL} wanted", short(residual)),
        remedy: "take a smaller solver.tolerance, or \"discretisation\"",
    })
}

/// What tells of contact that is narrower than a segment.
pub(crate) fn unresolved_doubt(contact: &summary::ContactSummary, shorter: &'static str) -> Option<Doubt> {
    let force = contact.force.unwrap_or(0.0).abs();
    let off = contact.unresolved_force.filter(|off| *off > MOST_UNRESOLVED * force)?;
    let worth = if force > 0.0 { format!(", which is worth {} of its force", short(off / force)) } else { String::new() };
    let cause = "the bodies penetrate each other within segments";
    Some(Doubt { cause, figure: format!("{cause}{worth}"), remedy: shorter })
}
