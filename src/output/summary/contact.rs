//! What the summary says of a contact, of the zones that press, and of the errors that are estimated of it.

use serde::Serialize;

use crate::contact::zone_counts;
use crate::geometry::{Coordinates, Point};

/// One contact.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct ContactSummary {
    /// Length of the contact boundary.
    pub length: Option<f64>,
    /// Number of its segments.
    pub segments: Option<usize>,
    /// Multiplier space, as in the case: `p0`, `p1-discontinuous`, `p1-continuous`.
    pub multiplier: Option<String>,
    /// Length of the shortest segment, in edges of the softer body.
    pub h_ratio: Option<f64>,
    /// Inf-sup constant.
    pub inf_sup: Option<f64>,
    /// The two ends of the contact boundary.
    pub ends: Option<[[f64; 2]; 2]>,
    /// Intervals of arc length in contact.
    pub closed: Option<Vec<[f64; 2]>>,
    /// Number of edges of the softer body on that interval of `closed` that has most of them.
    pub closed_edges: Option<f64>,
    /// The ends of the intervals of `closed` as points in the plane.
    pub closed_points: Option<Vec<[[f64; 2]; 2]>>,
    /// ∫ λ ds (force per thickness).
    pub force: Option<f64>,
    /// Force that penetration within single segments is worth (force per thickness).
    pub unresolved_force: Option<f64>,
    /// Resultant on body 2 (force per thickness).
    pub resultant: Option<[f64; 2]>,
    /// Where it acts: the centre of the pressure; where nothing presses, the point with the smallest gap.
    pub place: Option<[f64; 2]>,
    /// Moment on body 2 about the origin.
    pub moment: Option<f64>,
    /// Largest contact pressure.
    pub pressure_max: Option<f64>,
    /// Oscillation figure of the contact pressure.
    pub oscillation: Option<f64>,
    /// Quadrature points without a corresponding point.
    pub lost_points: Option<usize>,
    /// Way of the bodies along each other, by the length that presses; of curved fits on undeformed bodies only.
    pub slip: Option<f64>,
    /// The same at an end of the contact boundary where the bodies press and one of them ends, in all contacts of undeformed
    /// bodies.
    pub slip_at_ends: Option<f64>,
    /// What sliding there, or towards an end, takes from the length that the bodies have in common.
    pub lost_at_ends: Option<f64>,
    /// Estimated relative error of force or pressure by that way, and by the turning of the bodies.
    pub slip_error: Option<f64>,
    /// The same by their turning alone, in all contacts; where nothing presses, the growth of what turns by the smallest gap.
    pub rotation_error: Option<f64>,
    /// Angle between the contact boundary and the side on which a corner of the other one presses (radians).
    pub slant: Option<f64>,
    /// What forces on the same free bodies have along the force of this contact once the bodies have moved, and not before, by that force.
    pub direction_error: Option<f64>,
    /// λ where another contact goes on smoothly from this one and only one of both presses, by its largest; 0 elsewhere.
    pub cut_at_joint: Option<f64>,
    /// By how much its force would change if contact carried what mean motions are held against, by that force.
    pub held_force: Option<f64>,
    /// The contacts that go on smoothly from it, and press where they meet, too.
    pub shares_with: Vec<String>,
    /// Sharpest corner of a body within what presses, in degrees; of fitted curves only.
    pub corner_angle: Option<f64>,
    /// Estimated relative error of λ by that corner.
    pub corner_error: Option<f64>,
    /// Estimated relative error of λ by what the nodes of boundaries without a declared shape leave unknown of it.
    pub shape_error: Option<f64>,
    /// The same of the force: of the share that no load sets.
    pub shape_error_force: Option<f64>,
    /// Intervals of arc length that press, each with what is estimated of it.
    pub zones: Vec<ZoneSummary>,
    /// Force that is missing because the bodies overlap where no segment presses, relative to `force`; where nothing presses,
    /// the largest overlap relative to the largest displacement.
    pub missing: Option<f64>,
    /// The same as a force (force per thickness), on undeformed bodies.
    pub missing_force: Option<f64>,
    /// Force that overlaps all beyond the contact boundary are worth, relative to `force`.
    pub missing_beyond: Option<f64>,
    /// Deepest place of one body in the other, by their whole sides (length).
    pub depth: Option<f64>,
    /// Where that is.
    pub deepest: Option<[f64; 2]>,
    /// How far the sides have come together since they touched first, or have parted that were drawn in each other (length).
    pub approach: Option<f64>,
    /// Whether it can be trusted; on the same level of the file as the figures that this is judged by.
    #[serde(flatten)]
    pub judged: ContactTrust,
}

/// Whether a contact can be trusted. `run/verdict` judges it by all figures of a summary.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct ContactTrust {
    /// Whether the contact pressure can be trusted; null if nothing tells, or if the corner of a body presses on too
    /// few edges: the reason says which.
    pub trust: Option<bool>,
    /// Whether ∫ λ ds can be trusted to one per cent; null if nothing estimates it.
    pub trust_force: Option<bool>,
    /// The verdict in a few words: `trusted`, why not, or that the contact only touches.
    pub verdict: Option<String>,
}

impl ContactSummary {
    /// Whether λ grows without bound on a zone that anyone would look at, as far as the meshes tell.
    pub fn is_singular(&self) -> bool {
        self.singular_zones().next().is_some()
    }

    /// Whether it does so towards an end of the contact boundary.
    pub fn is_singular_at_end(&self) -> bool {
        self.singular_zones().any(|zone| zone.singular_at_end == Some(true))
    }

    /// The points at which materials meet, or a side has a corner, where it does so.
    pub fn singular_places(&self) -> Vec<Point> {
        self.singular_zones().filter_map(|zone| zone.singular_at.map(Into::into)).collect()
    }

    /// Where it does so, in words: towards an end, at such a point, or both.
    pub fn singular_words(&self) -> Option<String> {
        let end = self.is_singular_at_end().then(|| "towards an end".to_owned());
        let joint = |place: &Point| {
            format!("at {}, where an edge between two materials ends or a side has a corner", Coordinates(*place))
        };
        let words: Vec<String> = end.into_iter().chain(self.singular_places().first().map(joint)).collect();
        (!words.is_empty()).then(|| words.join(" and "))
    }

    fn singular_zones(&self) -> impl Iterator<Item = &ZoneSummary> {
        ZoneSummary::counting(&self.zones).filter(|zone| zone.singular == Some(true))
    }

    /// Length of all intervals in contact.
    pub fn width(&self) -> Option<f64> {
        self.closed.as_ref().map(|intervals| intervals.iter().fold(0.0, |sum, [first, last]| sum + last - first))
    }
}

/// An interval of a contact that presses.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct ZoneSummary {
    /// Arc lengths of its ends.
    pub ends: Option<[f64; 2]>,
    /// Edges of the softer body on it.
    pub edges: Option<f64>,
    /// Segments on it.
    pub segments: Option<usize>,
    /// Its share of the force.
    pub share: Option<f64>,
    /// Width that its force asks for between smooth convex sides (length); null elsewhere.
    pub hertz_width: Option<f64>,
    /// Largest contact pressure.
    pub pressure_max: Option<f64>,
    /// Estimated relative error of λ in its middle, root mean square.
    pub lambda: Option<f64>,
    /// The same all over it, without the tenth beside an end of the contact boundary.
    pub whole: Option<f64>,
    /// The largest of all signs of an error of λ; where it is small, so is the error.
    pub worst: Option<f64>,
    /// Estimated relative error of its force.
    pub force: Option<f64>,
    /// Estimated relative error of its largest pressure; null where that is singular.
    pub peak: Option<f64>,
    /// Whether its largest pressure lies beside an end of the contact boundary, in the tenth that `whole` leaves out.
    pub peak_at_end: Option<bool>,
    /// Whether λ grows without bound towards an end of the contact boundary, where materials meet, or at a corner of a side, as far
    /// as can be seen.
    pub singular: Option<bool>,
    /// Whether it does so towards an end.
    pub singular_at_end: Option<bool>,
    /// Where materials meet, or a side has a corner, and λ grows without bound.
    pub singular_at: Option<[f64; 2]>,
    /// λ at an end of the contact boundary beyond which both bodies go on smoothly and no other contact takes over, by its largest
    /// pressure; 0 where there is no such end.
    pub cut_off: Option<f64>,
    /// Whether it lies at an end of the contact boundary where one body has a corner and the other goes on.
    pub corner: Option<bool>,
}

impl ZoneSummary {
    /// Those of all zones of a contact that anyone would look at.
    pub fn counting(all: &[Self]) -> impl Iterator<Item = &Self> {
        let highest = all.iter().filter_map(|zone| zone.pressure_max).fold(0.0, f64::max);
        let counts = move |zone: &Self, share| zone_counts(share, zone.pressure_max.unwrap_or(f64::NAN), highest);
        all.iter().filter(move |zone| zone.share.is_none_or(|share| counts(zone, share)))
    }
}

/// Estimated relative errors of a contact.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct ContactEstimate {
    /// Of ∫ λ ds.
    pub force: Option<f64>,
    /// Of λ in the middle of its worst zone, root mean square, with what nobody knows of the shapes of the sides.
    pub lambda: Option<f64>,
    /// Of the largest λ, with the same; null where that is singular.
    pub peak: Option<f64>,
}
