//! Contacts as the programme of the first mesh has them, and where Γ_C lies by what it says of them.

use crate::accuracy::{Accuracy, share_of_nothing};
use crate::body::Body;
use crate::contact::{Known, MultiplierSpace, Pair, PointContact, SegmentRule, SmoothSide, Stabilise, point_contact};
use crate::discretisation::{Contact, Scene, SystemError, widest};
use crate::geometry::Point;
use crate::mesh::{EdgeNode, Numbering};
use crate::procedure::sequence::LoadedPlace;
use crate::programme::{FoundByProgramme, Prediction};

/// Segments of the programme where no place is known to touch first.
const EVEN: usize = 16;

/// Segments, at least, where the programme is asked again: those of a quarter of a circle turn by less than three degrees each.
const FINE: usize = 32;

/// The shortest segment of the programme as a share of the contact, on either side of the place that touches first, and how segments
/// grow from there. Its mean gap is that of s²/2R over a thousandth of R: less than what bodies of E = 1000 p bulge by.
const SHORTEST: f64 = 2e-3;
const GROWTH: f64 = 3.0;

/// Segments beside what presses that a contact boundary begins with: an end that lies too far in is seen only if there is pressure
/// beside it, one too far out costs a multiplier that opens.
const ROOM: usize = 1;

/// A contact as the programme has it: as far as the sides face each other within reach, with constant pressures on segments that
/// become short towards the place where the sides touch first.
pub(crate) struct WideContact {
    /// What it is placed by.
    pub known: Known,
    /// The contact.
    pub contact: Contact,
    /// Where smooth sides touch first.
    touch: Option<PointContact>,
}

impl WideContact {
    /// The force of what presses.
    fn force(&self, pressures: &[f64]) -> f64 {
        let contact = &self.contact;
        contact.range().map(|i| pressures[i].max(0.0) * contact.multipliers.integral(i - contact.first)).sum()
    }

    /// Arc of the place where the sides touch first, and how far a force presses to either side of it, if they touch at a point.
    fn pressed_by(&self, force: f64) -> Option<[f64; 2]> {
        let Self { contact, touch, .. } = self;
        let (touch, boundary) = ((*touch)?, &contact.boundary);
        Some([boundary.arc(boundary.foot(touch.place)), touch.half_width(force, contact.compliance)?])
    }

    /// Whether a force that counts presses farther from the place where the sides touch first than it is wide there: bodies have to
    /// move so far before contact holds them that their theory is that of another scene.
    fn presses_elsewhere(&self, pressures: &[f64], least: f64) -> bool {
        let (contact, force) = (&self.contact, self.force(pressures));
        let Some([at, half]) = self.pressed_by(force).filter(|_| force > least && contact.has_free_ends()) else { return false };
        self.moment(pressures, at, 1).abs() > force * half
    }

    /// The forces of what presses, each by a power of the way of its segment from an arc length.
    fn moment(&self, pressures: &[f64], at: f64, power: i32) -> f64 {
        let Contact { boundary, multipliers, first, .. } = &self.contact;
        let way = |own: usize| boundary.segment_arcs(multipliers.segment_of(own)).iter().sum::<f64>() * 0.5 - at;
        let moment = |i: usize| pressures[i].max(0.0) * multipliers.integral(i - first) * way(i - first).powi(power);
        self.contact.range().map(moment).sum()
    }

    /// Γ_C about the place where the sides touch first, as wide as its force presses there.
    fn as_drawn(&self, pressures: &[f64], least: f64) -> Known {
        let Some([at, half]) = self.pressed_by(self.force(pressures).max(least)) else { return self.known.clone() };
        let boundary = &self.contact.boundary;
        let ends = [(at - half).max(0.0), (at + half).min(boundary.length())];
        Known { ends: Some(ends.map(|arc| boundary.parameter_at(arc))), touch: self.touch, ..self.known.clone() }
    }

    /// Its force, and where it acts if the sides touch at a point.
    pub fn loaded(&self, at: usize, pressures: &[f64]) -> LoadedPlace {
        let contact = &self.contact;
        let force = self.force(pressures);
        let width = self.touch.and_then(|touch| Some((touch.place, touch.half_width(force, contact.compliance)?)));
        LoadedPlace { contact: at, force, width }
    }
}

/// How the programme cuts a contact.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Fineness {
    /// By segments that grow from where the sides touch first.
    Graded,
    /// By these, none longer than a small share of the contact.
    Fine,
}

/// Contacts of undeformed bodies as the programme has them.
pub(crate) fn wide_contacts(scene: &Scene, numbering: &Numbering, fineness: Fineness) -> Result<Vec<WideContact>, SystemError> {
    let (mut all, mut first, thin) = (Vec::new(), 0, thinness(scene));
    for pair in &scene.pairs {
        let wide = wide_contact(scene, numbering, (pair, fineness), first, &thin)?;
        first = wide.contact.range().end;
        all.push(wide);
    }
    Ok(all)
}

/// The contacts themselves.
pub(crate) fn drawn_contacts(wide: &[WideContact]) -> Vec<Contact> {
    wide.iter().map(|wide| wide.contact.clone()).collect()
}

/// The largest force of a contact that is nothing by the accuracy that is asked for.
pub(crate) fn least_force(wide: &[WideContact], pressures: &[f64], accuracy: Option<&Accuracy>) -> f64 {
    share_of_nothing(accuracy) * wide.iter().map(|wide| wide.force(pressures)).fold(0.0, f64::max)
}

/// What a programme says of contacts, with them. Where it lets a body go it is asked again on fine segments: one long segment pushes
/// along its mean normal alone, and a roller that climbs to the end of its seat needs that of the end. Where what presses on a contact
/// lies elsewhere than the contact as it is drawn, it is asked of that, too: a body may have to turn before contact holds it. A force
/// that is nothing by the `accuracy` does not count. **Collective** where `predict` is.
pub(crate) fn asked(
    scene: &Scene,
    numbering: &Numbering,
    mut wide: Vec<WideContact>,
    accuracy: Option<&Accuracy>,
    predict: impl Fn(&[Contact]) -> Result<Prediction, SystemError>,
) -> Result<(Vec<WideContact>, Prediction), SystemError> {
    let mut answer = predict(&drawn_contacts(&wide))?;
    if let Prediction::Driven { .. } = answer {
        wide = wide_contacts(scene, numbering, Fineness::Fine)?;
        answer = predict(&drawn_contacts(&wide))?;
    }
    let Prediction::Held(FoundByProgramme { pressures, .. }) = &answer else { return Ok((wide, answer)) };
    let least = least_force(&wide, pressures, accuracy);
    if wide.iter().any(|wide| wide.presses_elsewhere(pressures, least)) {
        let drawn: Vec<Known> = wide.iter().map(|wide| wide.as_drawn(pressures, least)).collect();
        // Where a contact cannot lie, nothing is said.
        if let Ok(contacts) = Contact::all_again(scene, numbering, 0, &drawn, &|_: EdgeNode| Point::zeros())
            && let tips @ Prediction::Driven { turns: true, .. } = predict(&contacts)?
        {
            answer = tips;
        }
    }
    Ok((wide, answer))
}

fn wide_contact(
    scene: &Scene,
    numbering: &Numbering,
    (pair, fineness): (&Pair, Fineness),
    first: usize,
    thin: &[Thinness],
) -> Result<WideContact, SystemError> {
    let at_rest = |_: EdgeNode| Point::zeros();
    let even = Pair { space: MultiplierSpace::P0, stabilise: Stabilise::Off, ..pair.clone() };
    let (known, placed) = widest(scene, numbering, &even);
    let placed = placed.map_or_else(|| Contact::placed(scene, numbering, &even, &known, &at_rest), Ok)?;
    let contact = Contact::on(scene, numbering, 0, &even, first, &known, placed.clone());
    let cut = |pair: &Pair| placed.cut(numbering.level.order, pair, known.segments);
    if !contact.has_free_ends() {
        // Where ends stay, so do the segments: what presses is told as the case has it.
        let contact = Contact::on(scene, numbering, 0, pair, first, &known, cut(pair));
        return Ok(WideContact { known, contact, touch: None });
    }
    let (boundary, touch) = (&contact.boundary, touch(scene, numbering, &contact, thin));
    let at = |touch: &PointContact| boundary.arc(boundary.foot(touch.place)) / boundary.length();
    let is_inside = |at: &f64| (SHORTEST..=1.0 - SHORTEST).contains(at);
    let at = touch.map(|touch| if touch.is_at_pole() { at(&touch).round() } else { at(&touch) });
    let mut fractions = graded_towards(at.filter(|at| is_inside(at) || touch.is_some_and(|touch| touch.is_at_pole())));
    if fineness == Fineness::Fine {
        fractions = cut_to(&fractions, FINE);
    }
    let graded = Pair { segments: SegmentRule::Fractions(fractions), grading: [1.0, 1.0], ..even };
    let contact = Contact::on(scene, numbering, 0, &graded, first, &known, cut(&graded));
    Ok(WideContact { known, contact, touch })
}

/// Where the smooth sides of a contact of undeformed bodies touch first, if they do so at a point.
fn touch(scene: &Scene, numbering: &Numbering, contact: &Contact, thin: &[Thinness]) -> Option<PointContact> {
    let sides = SmoothSide::of_pair(&scene.mesh, numbering, &contact.pair, &|_| Point::zeros());
    let boundary = &contact.boundary;
    let (middle, half) = (boundary.point(boundary.parameter_at(0.5 * boundary.length())), 0.5 * boundary.length());
    let nearest = |stretches: &'_ [SmoothSide]| {
        let away = |side: &SmoothSide| (side.nearest_place(middle).0 - middle).norm();
        (0..stretches.len()).min_by(|&a, &b| away(&stretches[a]).total_cmp(&away(&stretches[b])))
    };
    let [one, other] = [nearest(&sides[0])?, nearest(&sides[1])?];
    let touch = point_contact([&sides[0][one], &sides[1][other]], middle, half)?;
    // Each body counts as it strains: how thin a stiff one is does not matter beside a soft one.
    let [one, other] = contact.bodies.map(|body| thin[body]);
    let thinness = (one.compliance / one.extent + other.compliance / other.extent) / (one.compliance + other.compliance);
    // Two layers that press over a width of 1.8 times their thickness had .8 of this width and twice the true peak by Hertz.
    Some(PointContact { width: scene.mesh.plane.width(touch.place), roundest: touch.roundest.max(0.5 * thinness), ..touch })
}

/// How thin a body is, and how much it strains.
#[derive(Clone, Copy)]
struct Thinness {
    /// Smallest side of the boxes around its pieces (length); rigid tools are as thick as one likes.
    extent: f64,
    /// One by the smallest modulus of its parts (1/stress); none of rigid tools.
    compliance: f64,
}

/// Of each body.
fn thinness(scene: &Scene) -> Vec<Thinness> {
    let of_body = |(at, body): (usize, &Body)| {
        let softest = body.parts.iter().map(|part| part.material.young).fold(f64::INFINITY, f64::min);
        let compliance = if scene.is_rigid(at) { 0.0 } else { 1.0 / softest };
        Thinness { extent: f64::INFINITY, compliance }
    };
    let mut all: Vec<Thinness> = scene.bodies.iter().enumerate().map(of_body).collect();
    for (piece, [low, high]) in scene.mesh.pieces.iter().zip(scene.mesh.bounds()).filter(|(piece, _)| !scene.is_rigid(piece.body))
    {
        all[piece.body].extent = all[piece.body].extent.min((high - low).amin());
    }
    all
}

/// What contacts that lie as they are drawn are placed by later on: where they touch first, if they do so at a point.
pub(crate) fn with_touch(scene: &Scene, numbering: &Numbering, drawn: &[Contact]) -> Vec<Known> {
    let thin = thinness(scene);
    let touch = |contact: &Contact| contact.has_free_ends().then(|| touch(scene, numbering, contact, &thin)).flatten();
    drawn.iter().map(|contact| Known { touch: touch(contact), ..contact.known.clone() }).collect()
}

/// Segment ends as fractions of the length: growing from one place to both sides, or even without one.
fn graded_towards(place: Option<f64>) -> Vec<f64> {
    let Some(place) = place else { return (0..=EVEN).map(|k| k as f64 / EVEN as f64).collect() };
    let ways: Vec<f64> = std::iter::successors(Some(SHORTEST), |way| Some(GROWTH * way)).take_while(|way| *way < 1.0).collect();
    // The last way before an end would leave a sliver.
    let side = |room: f64| ways.iter().copied().filter(move |way| way * 0.5 * (1.0 + GROWTH) < room);
    let mut all: Vec<f64> = side(place).map(|way| place - way).chain(side(1.0 - place).map(|way| place + way)).collect();
    all.extend([0.0, 1.0]);
    all.sort_by(f64::total_cmp);
    all
}

/// Segment ends between which more are put, so that none is longer than one of so many even ones.
fn cut_to(fractions: &[f64], even: usize) -> Vec<f64> {
    let cut = |ends: &[f64]| {
        let (from, length) = (ends[0], ends[1] - ends[0]);
        let parts = (length * even as f64 - 1e-9).ceil().max(1.0);
        (0..parts as usize).map(move |k| from + length * k as f64 / parts)
    };
    fractions.windows(2).flat_map(cut).chain(fractions.last().copied()).collect()
}

/// Where a contact whose ends are free lies: as far as its force, or the `least` one that counts, presses sides that touch at a point
/// (Hertz); else what presses, and a segment on either side of it; what does not press lies where the gap is smallest.
pub(crate) fn narrowed(wide: &WideContact, active: &[bool], found: &FoundByProgramme, least: f64) -> Known {
    let WideContact { known, contact, touch } = wide;
    if !contact.has_free_ends() {
        return known.clone();
    }
    let (boundary, multipliers) = (&contact.boundary, &contact.multipliers);
    let segment = |i: usize| multipliers.segment_of(i - contact.first);
    let mut pressing: Vec<usize> = contact.range().filter(|&i| active[i]).map(segment).collect();
    if pressing.is_empty() {
        let nearest = contact.range().min_by(|&a, &b| found.gaps[a].total_cmp(&found.gaps[b]));
        pressing.extend(nearest.map(segment));
    }
    let (Some(first), Some(last)) = (pressing.iter().min(), pressing.iter().max()) else { return known.clone() };
    let arcs = boundary.arcs();
    let mut ends = [arcs[first.saturating_sub(ROOM)], arcs[(last + 1 + ROOM).min(boundary.segments())]];
    let mut narrow = None;
    let force = wide.force(&found.pressures);
    if let Some(touch) = touch {
        let at = boundary.arc(boundary.foot(touch.place));
        let half = touch.half_width(force.max(least), contact.compliance);
        let reach = half.unwrap_or(boundary.length());
        // What presses farther from the place than the force alone would, or than the edge there bends, has another reason: a corner,
        // sides that conform.
        let near = reach.max(contact.edge_length());
        let is_narrow = force <= least || wide.moment(&found.pressures, at, 2) <= force * near * near;
        if is_narrow && half.is_some() {
            let middle = 0.5 * (ends[0] + ends[1]);
            let middle = if ends[0] <= at && at <= ends[1] { at } else { middle };
            ends = [(middle - reach).max(0.0), (middle + reach).min(boundary.length())];
            narrow = Some(*touch);
        }
    }
    Known { ends: Some(ends.map(|arc| boundary.parameter_at(arc))), touch: narrow, ..known.clone() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fine_segments_keep_the_graded_ends_and_are_never_long() {
        let graded = graded_towards(Some(0.3));
        let fine = cut_to(&graded, FINE);
        assert!(graded.iter().all(|end| fine.contains(end)), "{fine:?}");
        let lengths: Vec<f64> = fine.windows(2).map(|ends| ends[1] - ends[0]).collect();
        assert!(lengths.iter().all(|length| *length > 0.0 && *length < 1.0 / FINE as f64 + 1e-9), "{lengths:?}");
        assert_eq!(cut_to(&[0.0, 0.5, 1.0], 2), [0.0, 0.5, 1.0], "they are short enough");
    }
}
