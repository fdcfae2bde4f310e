//! How far the sides of a contact face each other within reach, on undeformed bodies.

use crate::contact::{Configuration, CurveChoice, Known, Meeting, Pair, Placed, SmoothSide, point_contact, swings};
use crate::discretisation::contacts::contact::Contact;
use crate::discretisation::contacts::coupling::coupled_here;
use crate::discretisation::scene::Scene;
use crate::geometry::Point;
use crate::mesh::Numbering;

/// Parts of a stretch within reach, about the place where the sides touch first, that are tried one after the other: between round
/// bodies with long edges the normals of its ends may miss one of them.
const PARTS: [f64; 4] = [1.0, 0.5, 0.25, 0.125];

/// What places a contact as far as its sides face each other within reach: the widest stretch, about the place where they touch first,
/// on which the normals of Γ_C meet both; where the sides are drawn nearest, if there is none, or if the curve is declared, or if its
/// ends stay where it is placed. Γ_C comes with it if it was placed for that. All edges are on this rank.
pub fn widest(scene: &Scene, numbering: &Numbering, pair: &Pair) -> (Known, Option<Placed>) {
    let at_rest = |_| Point::zeros();
    if !pair.curve.is_found() || !pair.has_free_ends() {
        return Default::default();
    }
    let sides = SmoothSide::of_pair(&scene.mesh, numbering, pair, &at_rest);
    let lies_between = |contact: &Contact| {
        let Some(meeting) = contact.known.meeting.as_ref().filter(|_| pair.curve == CurveChoice::Fit) else { return true };
        let mut begun = sides.clone();
        meeting.begin(&mut begun);
        !swings(meeting.sides(&begun), &contact.boundary, pair)
    };
    let measured = |known: Known| {
        let placed = Contact::placed(scene, numbering, pair, &known, &at_rest).ok()?;
        let contact = Contact::on(scene, numbering, 0, pair, 0, &known, placed.clone());
        // Beyond the end of a round side its curve goes on straight, where the side itself has no edge.
        let faces = contact.edges.iter().all(|edges| !edges.is_empty());
        let is_measured = faces && lies_between(&contact) && coupled_here(std::slice::from_ref(&contact)).is_ok();
        is_measured.then_some((known, Some(placed)))
    };
    let whole = |meeting: &Meeting| Known { meeting: Some(meeting.clone()), ..Known::default() };
    let parts = |meeting: &Meeting, touch: Option<f64>| {
        let [first, last] = meeting.ends;
        let (middle, half) = (touch.unwrap_or(0.5 * (first + last)), 0.5 * (last - first));
        PARTS.map(|part| Known { ends: Some([middle - part * half, middle + part * half]), ..whole(meeting) })
    };
    let mut meetings = Vec::new();
    for meeting in Meeting::within_reach(&sides, pair) {
        if let Some(widest) = measured(whole(&meeting)) {
            return widest;
        }
        meetings.push(meeting);
    }
    let about = meetings.iter().filter(|meeting| !meeting.goes_round);
    let touches = about.map(|meeting| (meeting, touching(&sides, meeting, pair)));
    let (touched, others): (Vec<_>, Vec<_>) = touches.partition(|(_, touch)| touch.is_some());
    let parts_of = |all: &[(&Meeting, Option<f64>)]| -> Vec<Known> {
        all.iter().flat_map(|(meeting, touch)| parts(meeting, *touch)).collect()
    };
    let about = parts_of(&touched).into_iter().chain(std::iter::once(Known::default())).chain(parts_of(&others));
    about.into_iter().find_map(measured).unwrap_or_default()
}

/// Parameter of Γ_C at which the sides touch first, if it has that of body 1's side, and if that is not at an end of where they meet.
fn touching(sides: &[Vec<SmoothSide>; 2], meeting: &Meeting, pair: &Pair) -> Option<f64> {
    if pair.curve != CurveChoice::Fit {
        return None;
    }
    let mut begun = sides.clone();
    meeting.begin(&mut begun);
    let [first, second] = meeting.sides(&begun);
    let [from, to] = meeting.ends;
    let middle = first.curve(Configuration::Reference).point(0.5 * (from + to));
    let touch = point_contact([first, second], middle, 0.5 * (to - from))?;
    Some(first.nearest(touch.place, Configuration::Reference))
}

/// What places a contact beside where it lay on a coarser mesh, with its open ends there and its middle between them; where its sides are
/// drawn nearest, if it goes all around.
pub fn beside(scene: &Scene, numbering: &Numbering, pair: &Pair, places: Option<[Point; 3]>) -> Known {
    let sides = pair.curve.is_found().then(|| SmoothSide::of_pair(&scene.mesh, numbering, pair, &|_| Point::zeros()));
    let meeting = |sides: &[Vec<SmoothSide>; 2]| match places {
        Some(places) => Meeting::beside(sides, pair, places),
        None => Meeting::at_rest(sides, pair).ok(),
    };
    Known { meeting: sides.as_ref().and_then(meeting), ..Known::default() }
}
