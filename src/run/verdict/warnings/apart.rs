//! Words for boundaries that are drawn otherwise than their gap is declared.

use crate::contact::GapChoice;
use crate::discretisation::Contact;
use crate::recovery::TracePoint;
use crate::run::verdict::limits::{FORMULA_OFF, GAP_OFF};
use crate::run::words::short;

/// Words for boundaries that are drawn apart, or into each other, by more than their polygons can be, though the gap is declared to
/// be another.
pub fn apart(contact: &Contact, points: &[TracePoint]) -> Option<String> {
    let segment = contact.boundary.length() / contact.boundary.segments() as f64;
    let apart = |point: &TracePoint| {
        let drawn = point.distance[1] - point.distance[0];
        let (off, share) = match &contact.pair.gap {
            GapChoice::Geometry => return None,
            GapChoice::Closed => (drawn.abs(), 0.0),
            GapChoice::Formula(formula) => ((drawn - formula.value(&[point.x.x, point.x.y])).abs(), FORMULA_OFF),
        };
        // Boundaries that are drawn as touching say nothing of the gap.
        (drawn.abs().min(off) > GAP_OFF * segment + share * drawn.abs()).then_some((drawn, point.x))
    };
    let all = points.iter().filter(|point| point.is_complete()).filter_map(apart);
    let (drawn, x) = all.max_by(|a, b| a.0.abs().total_cmp(&b.0.abs()))?;
    let words = match &contact.pair.gap {
        GapChoice::Formula(formula) => format!(
            "gap = {} is declared, {:.3e} at ({}, {}), but the boundaries are drawn {:.3e} {} there; the declared gap counts; if the drawn one is meant, give gap = \"geometry\"",
            formula.text(),
            formula.value(&[x.x, x.y]),
            short(x.x),
            short(x.y),
            drawn.abs(),
            if drawn > 0.0 { "apart" } else { "into each other" }
        ),
        _ => format!(
            "gap = \"closed\", but the boundaries lie up to {:.3e} apart; if that is no error of the mesh, give gap = \"geometry\"",
            drawn.abs()
        ),
    };
    Some(format!("contact {}: {words}", contact.pair.name))
}
