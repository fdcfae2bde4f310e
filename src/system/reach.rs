//! How far the sides of a contact face each other within reach, on undeformed bodies.

use super::{Contact, Scene, coupled_here};
use crate::contact::{Known, Meeting, Pair, SmoothSide};
use crate::geometry::Point;
use crate::mesh::Numbering;

/// Parts of a stretch within reach, about its middle, that are tried where the whole cannot be measured: between round bodies with long
/// edges the normals of its ends may miss one of them.
const PARTS: [f64; 2] = [0.5, 0.25];

/// What places a contact as far as its sides face each other within reach: the widest stretch on which the normals of Γ_C meet both;
/// where the sides are drawn nearest, if there is none, or if the curve is declared. All edges are on this rank.
pub fn widest(scene: &Scene, numbering: &Numbering, pair: &Pair) -> Known {
    let at_rest = |_| Point::zeros();
    if !pair.curve.is_found() {
        return Known::default();
    }
    let sides = SmoothSide::of_pair(&scene.mesh, numbering, pair, &at_rest);
    let can_be_measured = |known: &Known| {
        let contact = Contact::new(scene, numbering, 0, pair, 0, known, &at_rest);
        contact.is_ok_and(|contact| coupled_here(std::slice::from_ref(&contact)).is_ok())
    };
    let whole = Meeting::within_reach(&sides, pair).map(|meeting| Known { meeting: Some(meeting), ..Known::default() });
    let part = |meeting: Meeting| {
        let [first, last] = meeting.ends;
        let (middle, half) = (0.5 * (first + last), 0.5 * (last - first));
        PARTS.map(|part| {
            let ends = Some([middle - part * half, middle + part * half]);
            Known { meeting: Some(meeting.clone()), ends, ..Known::default() }
        })
    };
    let parts = Meeting::within_reach(&sides, pair).filter(|meeting| !meeting.goes_round).flat_map(part);
    whole.chain(std::iter::once(Known::default())).chain(parts).find(can_be_measured).unwrap_or_default()
}

/// What places a contact where its sides are drawn nearest, on a mesh of which the ends of Γ_C are known: its curve goes on as far as
/// these.
pub fn nearest(scene: &Scene, numbering: &Numbering, pair: &Pair) -> Known {
    let sides = pair.curve.is_found().then(|| SmoothSide::of_pair(&scene.mesh, numbering, pair, &|_| Point::zeros()));
    Known { meeting: sides.and_then(|sides| Meeting::at_rest(&sides, pair).ok()), ..Known::default() }
}
