//! Whether contact pressures are to be trusted, and what to do where they are not.

use super::report::short;
use crate::case::Case;
use crate::contact::{MultiplierSpace, Pair, SegmentRule};
use crate::element::Order;
use crate::output::Summary;
use crate::output::summary;

/// A contact whose inf-sup constant is below this has pressures that its displacements do not control.
const LEAST_INF_SUP: f64 = 0.1;

/// A pressure with more alternation than this is not one.
const MOST_OSCILLATION: f64 = 0.05;

/// On fewer edges, or fewer segments, the pressure of a zone is off by tens of per cent, unless the estimate proves it good.
pub(super) const LEAST_PARTS: f64 = 4.0;

/// The largest sign of an error that proves a pressure good.
pub(super) const PROVES: f64 = 0.05;

/// Signs of error that prove a pressure on one or two segments, too.
const NEXT_TO_NOTHING: f64 = 1e-3;

/// Largest estimated relative error in the energy norm.
const MOST_ERROR: f64 = 0.3;

/// The same of λ in the middle of a zone that presses, and of the force of a zone.
const MOST_PRESSURE_ERROR: f64 = 0.08;

/// The same of the largest λ of a zone.
const MOST_PEAK_ERROR: f64 = 0.15;

/// The same of a force that is to be trusted.
const MOST_FORCE_ERROR: f64 = 0.01;

/// Share of the force of a contact from which that of a zone is judged.
const LEAST_SHARE: f64 = 0.05;

/// Largest force, relative to that found, that overlaps of the bodies beside the zones may ask for; where nothing presses, the
/// largest overlap relative to the displacements.
const MOST_MISSING: [f64; 2] = [0.1, 1e-5];

/// Largest difference of the forces on both bodies, relative: the pressure is off by as much at least.
const MOST_UNBALANCED: f64 = 0.01;

/// Sliding by less than this share of the length in contact changes no normal.
const LITTLE_SLIP: f64 = 0.02;

/// Largest error of force and pressure by sliding.
const MOST_SLIP_ERROR: f64 = 0.01;

/// Largest error of the pressure by corners within a contact.
const MOST_CORNER_ERROR: f64 = 0.04;

/// Largest mean strain of a macro triangle at which a theory of small strain still means something.
const MOST_STRAIN: f64 = 0.2;

/// Share of the force that penetration within single segments may be worth: more is contact narrower than they are.
const MOST_UNRESOLVED: f64 = 0.1;

/// A figure that speaks against a pressure, and what mends it.
struct Doubt {
    figure: String,
    remedy: &'static str,
}

/// What is said of the pressures of a run.
#[derive(Debug, Default)]
pub struct Judgement {
    /// Figures that speak against pressures, with what to do about them.
    pub unreliable: Option<String>,
    /// What nothing tells, a sentence each.
    pub unknown: Vec<String>,
}

/// Sets `trust` of every contact: false if a figure speaks against its pressure, or if the solve it comes from has not
/// `converged`; null if nothing tells, or if the corner of a body presses on too few
/// edges. Sets `trust_force`, too.
pub fn judge(summary: &mut Summary, case: &Case, converged: bool) -> Judgement {
    let (mut told, mut remedies) = (Vec::new(), Vec::new());
    let mut judgement = Judgement::default();
    for pair in &case.contacts {
        let Some(contact) = summary.contact.get(&pair.name) else { continue };
        let force = summary.estimate.contact.get(&pair.name).and_then(|own| own.force);
        let mut trust_force =
            if converged { force.map(|error| error <= MOST_FORCE_ERROR && is_balanced(summary)) } else { Some(false) };
        let mut doubts = stability_doubts(contact, pair, case);
        let mut unknown = None;
        if converged {
            doubts.extend(zone_doubts(contact, trust_force));
            doubts.extend(size_doubts(summary));
            doubts.extend(force_doubt(force));
            let beyond_the_model: Vec<Doubt> = slip_doubt(contact).into_iter().chain(strain_doubts(summary)).collect();
            trust_force = trust_force.map(|trust| trust && beyond_the_model.is_empty());
            doubts.extend(beyond_the_model);
            doubts.extend(unresolved_doubt(contact));
            doubts.extend(corner_doubt(contact, pair.between.each_ref().map(String::as_str)));
            unknown = unknown_words(contact, &pair.name, trust_force);
        }
        let trust = if doubts.is_empty() && converged { unknown.is_none().then_some(true) } else { Some(false) };
        if trust.is_none() {
            judgement.unknown.extend(unknown);
        }
        if !doubts.is_empty() {
            let mut figures: Vec<String> = doubts.iter().map(|doubt| doubt.figure.clone()).collect();
            figures.extend(contact.h_ratio.map(|ratio| format!("shortest segment {} edges of the softer body", short(ratio))));
            told.push(format!("contact {} ({})", pair.name, figures.join("; ")));
        }
        let new = doubts.into_iter().map(|doubt| doubt.remedy);
        new.for_each(|remedy| {
            if !remedies.contains(&remedy) {
                remedies.push(remedy)
            }
        });
        if let Some(contact) = summary.contact.get_mut(&pair.name) {
            contact.trust = trust;
            contact.trust_force = trust_force;
        }
    }
    judgement.unreliable = (!told.is_empty()).then(|| format!("{}; {}", told.join(", "), remedies.join("; ")));
    judgement
}

/// What tells that the displacements do not control the pressure; it may be why a solve has failed.
fn stability_doubts(contact: &summary::Contact, pair: &Pair, case: &Case) -> Vec<Doubt> {
    let unstable = contact.inf_sup.filter(|beta| *beta < LEAST_INF_SUP);
    let unstable = unstable.map(|beta| format!("inf-sup constant {beta:.3}, at least {LEAST_INF_SUP} wanted"));
    // Beside a singular end λ swings without harm to its middle, which the estimate tells.
    let harmless = contact.zones.iter().filter(|zone| zone.counts(&contact.zones)).all(|zone| is_proved(zone.lambda));
    let rough = contact.oscillation.filter(|share| *share > MOST_OSCILLATION && !harmless);
    let rough = rough.map(|share| format!("oscillation {share:.3}, at most {MOST_OSCILLATION} wanted"));
    let remedy = stability(pair, case);
    [unstable, rough].into_iter().flatten().map(|figure| Doubt { figure, remedy }).collect()
}

/// What tells that zones are too narrow, or too coarse, for their pressure.
fn zone_doubts(contact: &summary::Contact, trust_force: Option<bool>) -> Vec<Doubt> {
    let finer = "refine the mesh where contact is";
    let shorter = "take more segments (\"auto\" takes as many as the mesh bears), or refine the mesh where contact is";
    let mut doubts = Vec::new();
    let zones = &contact.zones;
    for zone in zones.iter().filter(|zone| zone.counts(zones)) {
        let place = if zones.len() > 1 {
            zone.ends.map_or(String::new(), |[a, b]| format!(" at s = {} to {}", short(a), short(b)))
        } else {
            String::new()
        };
        let (edges, segments) = (zone.edges.unwrap_or(f64::NAN), zone.segments.unwrap_or(0));
        if is_concentrated(zone, trust_force) {
            continue;
        }
        let proved = is_proved(zone.worst) && edges >= 1.0 && is_divided(zone);
        let good = proved || is_proved(zone.lambda) && zone.worst.is_some_and(|worst| worst <= MOST_PEAK_ERROR);
        if edges < LEAST_PARTS && !proved {
            doubts.push(Doubt {
                figure: format!("contact{place} {edges:.1} edges wide, at least {LEAST_PARTS} wanted"),
                remedy: finer,
            });
        } else if (segments as f64) < LEAST_PARTS && !good {
            let words = format!("contact{place} on {segments} segments, at least {LEAST_PARTS} wanted");
            doubts.push(Doubt { figure: words, remedy: shorter });
        }
        let force = zone.force.filter(|_| zone.share.is_some_and(|share| share.abs() >= LEAST_SHARE));
        let errors = [
            ("of λ", zone.lambda, MOST_PRESSURE_ERROR),
            ("of the largest λ", zone.peak, MOST_PEAK_ERROR),
            ("of the force", force, MOST_PRESSURE_ERROR),
        ];
        for (what, error, most) in errors {
            let wrong = error.filter(|error| *error > most);
            let figure = |error| format!("estimated error {what}{place} {error:.2}, at most {most} wanted");
            doubts.extend(wrong.map(|error| Doubt { figure: figure(error), remedy: finer }));
        }
    }
    let [most, most_alone] = MOST_MISSING;
    let missing = contact.missing.filter(|missing| *missing > if zones.is_empty() { most_alone } else { most });
    doubts.extend(missing.map(|_| Doubt { figure: "the bodies overlap where no segment presses".into(), remedy: shorter }));
    doubts
}

/// What tells that a solution is too far from the bodies' own to have their pressure.
fn size_doubts(summary: &Summary) -> Vec<Doubt> {
    let mut doubts = Vec::new();
    let wrong = summary.estimate.energy.filter(|error| *error > MOST_ERROR);
    let words = |error| format!("estimated error in the energy norm {error:.2}, at most {MOST_ERROR} wanted");
    doubts.extend(wrong.map(|error| (words(error), "refine the mesh where contact is")));
    let off = summary.balance.force.filter(|_| !is_balanced(summary));
    let words = |off| format!("forces on the two bodies differ by {}, at most {MOST_UNBALANCED} wanted", short(off));
    doubts.extend(off.map(|off| (words(off), "see lost_points: the bodies must face each other all along the boundary")));
    doubts.into_iter().map(|(figure, remedy)| Doubt { figure, remedy }).collect()
}

/// What tells that the force of a contact is not known.
fn force_doubt(error: Option<f64>) -> Option<Doubt> {
    let error = error.filter(|error| *error > MOST_PRESSURE_ERROR)?;
    Some(Doubt {
        figure: format!("estimated error of the whole force {error:.2}, at most {MOST_PRESSURE_ERROR} wanted"),
        remedy: "refine the mesh where contact is",
    })
}

/// What tells that curved bodies have slid along each other too far for normals of the undeformed ones.
fn slip_doubt(contact: &summary::Contact) -> Option<Doubt> {
    let (slip, error) = (contact.slip?, contact.slip_error?);
    (slip > LITTLE_SLIP && error > MOST_SLIP_ERROR).then(|| Doubt {
        figure: format!(
            "the bodies slide along each other by {} of the length in contact, which changes pressures by about {}",
            short(slip),
            short(error)
        ),
        remedy: "take configuration = \"deformed\"",
    })
}

/// What tells that bodies are strained beyond a theory of small strain.
fn strain_doubts(summary: &Summary) -> Vec<Doubt> {
    let large =
        summary.strain_max.iter().filter_map(|(body, strain)| Some((body, strain.filter(|strain| *strain > MOST_STRAIN)?)));
    let words = |(body, strain): (&String, f64)| {
        format!("body {body} strained by {:.0} %, at most {:.0} % wanted", 100.0 * strain, 100.0 * MOST_STRAIN)
    };
    let remedy = "press less, or correct the units of E, loads and displacements: the model is that of small strain";
    large.map(|found| Doubt { figure: words(found), remedy }).collect()
}

/// What tells of contact that is narrower than a segment.
fn unresolved_doubt(contact: &summary::Contact) -> Option<Doubt> {
    let off = contact.unresolved_force.filter(|off| *off > MOST_UNRESOLVED * contact.force.unwrap_or(0.0).abs())?;
    Some(Doubt {
        figure: format!("the bodies penetrate each other within segments, worth a force of {}", short(off)),
        remedy: "take more segments, and refine the mesh where contact is",
    })
}

/// What tells that bodies press with corners that the smooth contact boundary has not.
fn corner_doubt(contact: &summary::Contact, [a, b]: [&str; 2]) -> Option<Doubt> {
    let error = contact.corner_error.filter(|error| *error > MOST_CORNER_ERROR)?;
    let angle = contact.corner_angle.unwrap_or(f64::NAN);
    Some(Doubt {
        figure: format!(
            "\"{a}\" or \"{b}\" has corners of up to {angle:.0} degrees within the contact, which change λ by about {}",
            short(error)
        ),
        remedy: "if these are chords of a curve, give it by a [geometry]; if the corners are meant, name the pieces between them, each with a contact of its own",
    })
}

/// What neither speaks for a pressure nor against it, in words.
fn unknown_words(contact: &summary::Contact, name: &str, trust_force: Option<bool>) -> Option<String> {
    let zones = &contact.zones;
    let counting = || zones.iter().filter(|zone| zone.counts(zones));
    if let Some(zone) = counting().find(|zone| is_concentrated(zone, trust_force)) {
        let edges = zone.edges.unwrap_or(f64::NAN);
        return Some(format!(
            "contact {name}: the corner of a body presses on {edges:.1} edges: its force is to be trusted, its pressure is singular there"
        ));
    }
    counting()
        .any(|zone| zone.lambda.is_none() && !(is_proved(zone.worst) && is_divided(zone)))
        .then(|| format!("contact {name}: nothing estimates the error of its pressure; refine the mesh, or take more segments"))
}

/// A reaction at the corner of a body that no mesh resolves: the force is right.
fn is_concentrated(zone: &summary::Zone, trust_force: Option<bool>) -> bool {
    zone.corner == Some(true) && zone.edges.is_some_and(|edges| edges < LEAST_PARTS) && trust_force == Some(true)
}

/// Whether its signs of error can tell anything: on one or two segments they may all be small beside the error, unless they
/// are next to nothing, as where the pressure is even.
fn is_divided(zone: &summary::Zone) -> bool {
    zone.segments.is_some_and(|segments| segments > 2) || zone.worst.is_some_and(|worst| worst <= NEXT_TO_NOTHING)
}

fn is_proved(worst: Option<f64>) -> bool {
    worst.is_some_and(|worst| worst <= PROVES)
}

fn is_balanced(summary: &Summary) -> bool {
    summary.balance.force.is_none_or(|off| off <= MOST_UNBALANCED)
}

/// What mends a space too rich for the displacements; P1 has locked before its multipliers are too many.
fn stability(pair: &Pair, case: &Case) -> &'static str {
    let locked = case.mesh.order == Order::P1 && case.bodies.iter().any(|body| body.material.poisson > super::report::LOCKING);
    match (locked, pair.segments == SegmentRule::Auto, pair.space) {
        (true, ..) => "take mesh.order = 2: P1 triangles lock",
        (_, true, MultiplierSpace::P1Continuous) => "take another multiplier space, or refine the mesh",
        (_, true, _) => "take stabilise = true, another multiplier space, or refine the mesh",
        (_, _, MultiplierSpace::P1Continuous) => "take fewer segments (\"auto\" is safe), or another multiplier space",
        _ => "take fewer segments (\"auto\" is safe), stabilise = true, or another multiplier space",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::summary::{Balance, Contact, Estimate, Zone};

    fn zone() -> Zone {
        Zone {
            ends: Some([0.0, 0.4]),
            edges: Some(8.0),
            segments: Some(6),
            share: Some(1.0),
            pressure_max: Some(2.0),
            lambda: Some(0.01),
            worst: Some(0.08),
            force: Some(0.001),
            peak: Some(0.02),
            singular: Some(false),
            corner: Some(false),
        }
    }

    fn words_of(zones: Vec<Zone>, missing: f64) -> String {
        let contact = Contact { zones, missing: Some(missing), ..Contact::default() };
        zone_doubts(&contact, Some(true)).into_iter().map(|doubt| doubt.figure).collect::<Vec<_>>().join("; ")
    }

    fn words(change: impl Fn(&mut Zone)) -> String {
        let mut zone = zone();
        change(&mut zone);
        words_of(vec![zone], 0.0)
    }

    #[test]
    fn a_pressure_is_doubted_by_what_is_far_off() {
        assert_eq!(words(|_| ()), "");
        assert!(words(|zone| zone.edges = Some(1.5)).starts_with("contact 1.5 edges wide"));
        assert!(words(|zone| (zone.segments, zone.worst) = (Some(3), Some(0.2))).starts_with("contact on 3 segments"));
        assert!(words(|zone| zone.lambda = Some(0.9)).contains("of λ 0.90"));
        assert!(words(|zone| zone.peak = Some(0.2)).contains("of the largest λ 0.20"));
        assert!(words_of(vec![zone()], 0.5).contains("overlap"));
        let far = |energy, force| {
            let summary = Summary {
                estimate: Estimate { energy: Some(energy), ..Estimate::default() },
                balance: Balance { force: Some(force), ..Balance::default() },
                ..Summary::default()
            };
            size_doubts(&summary).into_iter().map(|doubt| doubt.figure).collect::<Vec<_>>().join("; ")
        };
        assert_eq!(far(0.02, 1e-15), "");
        assert!(far(0.6, 1e-15).contains("energy norm 0.60"));
        assert!(far(0.02, 1.0).contains("differ by 1.00"));
        let within = |force: f64, off: f64| {
            let contact = Contact { force: Some(force), unresolved_force: Some(off), ..Contact::default() };
            unresolved_doubt(&contact).map_or(String::new(), |doubt| doubt.figure)
        };
        assert_eq!((within(5.4, 0.2), within(0.0, 0.0)), (String::new(), String::new()));
        assert!(within(5.4, 4.2).contains("worth a force of 4.20") && within(0.0, 4.2).contains("within segments"));
    }

    #[test]
    fn corners_are_doubted_by_what_they_do() {
        let pair = |error| Contact { corner_angle: Some(11.25), corner_error: Some(error), ..Contact::default() };
        let told = |error| corner_doubt(&pair(error), ["a", "b"]).map(|doubt| doubt.figure);
        assert_eq!(told(0.03), None);
        assert!(told(0.07).is_some_and(|words| words.contains("\"a\" or \"b\" has corners of up to 11 degrees")));
    }

    #[test]
    fn every_zone_that_counts_is_judged() {
        let narrow = Zone { ends: Some([0.6, 0.62]), edges: Some(0.9), share: Some(0.05), ..zone() };
        assert!(words_of(vec![zone(), narrow.clone()], 0.0).contains("contact at s = 0.60 to 0.62 0.9 edges wide"));
        let faint = Zone { share: Some(1e-4), pressure_max: Some(1e-3), ..narrow };
        assert_eq!(words_of(vec![zone(), faint], 0.0), "");
    }

    #[test]
    fn a_narrow_zone_may_be_proved_good() {
        let patch = |edges| words(|zone| (zone.edges, zone.segments, zone.worst) = (Some(edges), Some(1), Some(1e-9)));
        assert_eq!(patch(2.0), "");
        assert!(patch(0.5).contains("0.5 edges wide"));
    }

    #[test]
    fn bodies_that_overlap_where_nothing_presses_are_told() {
        assert_eq!(words_of(Vec::new(), 1e-9), "");
        assert!(words_of(Vec::new(), 0.05).contains("overlap"));
    }

    #[test]
    fn the_pressure_at_a_corner_is_left_open_if_the_force_is_right() {
        let corner = Zone { edges: Some(1.5), corner: Some(true), lambda: None, worst: None, ..zone() };
        let contact = Contact { zones: vec![corner], ..Contact::default() };
        assert!(zone_doubts(&contact, Some(true)).is_empty());
        assert!(unknown_words(&contact, "seam", Some(true)).is_some_and(|words| words.contains("singular")));
        assert!(!zone_doubts(&contact, Some(false)).is_empty());
    }

    #[test]
    fn what_nothing_estimates_is_told() {
        let told =
            |lambda| unknown_words(&Contact { zones: vec![Zone { lambda, ..zone() }], ..Contact::default() }, "seam", None);
        assert_eq!(told(Some(0.01)), None);
        assert!(told(None).is_some_and(|words| words.contains("nothing estimates")));
    }
}
