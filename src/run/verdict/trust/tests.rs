//! What speaks against pressures.

use super::contact::*;
use super::samples::*;
use super::zones::*;
use super::*;
use crate::output::summary::{self, BalanceSummary, ContactEstimate, EstimateSummary, SupportSummary, ZoneSummary};
use crate::run::verdict::limits::ENERGY;
use crate::run::verdict::no_result::balance_doubts;
use crate::run::verdict::unresolved::unresolved;

/// How the advice begins that asks for a finer mesh.
const FINER: &str = "take mesh.refine = ";

fn words_of(zones: Vec<ZoneSummary>, missing: f64) -> String {
    let contact = ContactSummary { zones, missing: Some(missing), ..ContactSummary::default() };
    zone_doubts(&contact, Some(true)).into_iter().map(|doubt| doubt.figure).collect::<Vec<_>>().join("; ")
}

fn words(change: impl Fn(&mut ZoneSummary)) -> String {
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
    assert!(words(|zone| zone.whole = Some(0.07)).contains("up to the ends of contact 0.07"));
    assert!(words(|zone| zone.peak = Some(0.2)).contains("of the largest λ 0.20"));
    // What `whole` does not see is judged as strictly.
    assert_eq!(words(|zone| zone.peak = Some(0.08)), "");
    let at_end = |zone: &mut ZoneSummary| (zone.peak, zone.peak_at_end) = (Some(0.08), Some(true));
    assert!(words(at_end).contains("of the largest λ, at an end of Γ_C, 0.08"));
    let mut steps = zone();
    at_end(&mut steps);
    let steps = ContactSummary { zones: vec![steps], multiplier: Some("p0".into()), ..ContactSummary::default() };
    assert_eq!(zone_doubts(&steps, Some(true)).len(), 0);
    assert!(words_of(vec![zone()], 0.5).contains("overlap"));
    let case = case(&[]);
    let far = |energy, force| {
        let summary = Summary {
            estimate: EstimateSummary { energy: Some(energy), ..EstimateSummary::default() },
            balance: BalanceSummary { force: Some(force), ..BalanceSummary::default() },
            ..Summary::default()
        };
        ENERGY
            .judge(summary.estimate.energy, &[])
            .into_iter()
            .chain(balance_doubts(&summary, &case))
            .map(|doubt| doubt.figure)
            .collect::<Vec<_>>()
            .join("; ")
    };
    assert_eq!(far(0.02, 1e-15), "");
    assert!(far(0.6, 1e-15).contains("energy norm 0.60"));
    assert!(far(0.02, 1.0).contains("differ by 1.0,"));
    let within = |force: f64, off: f64| {
        let contact = ContactSummary { force: Some(force), unresolved_force: Some(off), ..ContactSummary::default() };
        unresolved_doubt(&contact).map_or(String::new(), |doubt| doubt.figure)
    };
    assert_eq!((within(5.4, 0.2), within(0.0, 0.0)), (String::new(), String::new()));
    assert!(within(5.4, 4.2).contains("apart would take 0.78 times its force") && within(0.0, 4.2).contains("within segments"));
}

#[test]
fn far_rotations_are_doubted_wherever_contact_is() {
    let told = |angle| {
        let rotation_max = [("arm".to_string(), Some(angle))].into();
        rotation_doubts(&Summary { rotation_max, ..Summary::default() }).into_iter().map(|doubt| doubt.figure).collect::<String>()
    };
    assert_eq!(told(0.1), "");
    assert!(told(-0.4).contains("body arm turns by -0.40"));
}

#[test]
fn sliding_is_doubted_unless_turning_is() {
    let told = |slip_error, rotation_error| {
        let [slip, slip_error, rotation_error] = [0.3, slip_error, rotation_error].map(Some);
        let contact = ContactSummary { slip, slip_error, rotation_error, zones: vec![zone()], ..ContactSummary::default() };
        [slip_doubt(&contact).is_some(), turning_doubt(&contact).is_some()]
    };
    assert_eq!(told(0.015, 0.0), [true, false]);
    assert_eq!(told(0.015, 0.009), [true, false]);
    assert_eq!(told(0.03, 0.02), [false, true]);
    assert_eq!(told(0.005, 0.02), [false, false], "the one undoes the other");
}

#[test]
fn bodies_are_doubted_that_are_strained_by_more_than_a_fifth() {
    let told = |strain| {
        let strain_max = [("block".to_string(), Some(strain))].into();
        strain_doubts(&Summary { strain_max, ..Summary::default() }).into_iter().map(|doubt| doubt.figure).collect::<String>()
    };
    assert_eq!(told(0.19), "");
    assert!(told(0.21).starts_with("body block strained by 21 %"), "{}", told(0.21));
}

#[test]
fn the_force_of_a_zone_is_doubted_unless_the_zone_is_small_beside_the_others() {
    let with = |share| words(|zone| (zone.force, zone.share) = (Some(0.2), Some(share)));
    assert!(with(0.06).contains("of the force 0.20"), "{}", with(0.06));
    assert_eq!(with(0.04), "");
}

#[test]
fn every_zone_that_counts_is_judged() {
    let narrow = ZoneSummary { ends: Some([0.6, 0.62]), edges: Some(0.9), share: Some(0.05), ..zone() };
    assert!(words_of(vec![zone(), narrow.clone()], 0.0).contains("contact at s = 0.60 to 0.62 0.9 edges wide"));
    let faint = ZoneSummary { share: Some(1e-4), pressure_max: Some(1e-3), ..narrow };
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
    let corner = ZoneSummary { edges: Some(1.5), corner: Some(true), lambda: None, worst: None, ..zone() };
    let contact = ContactSummary { zones: vec![corner], ..ContactSummary::default() };
    assert!(zone_doubts(&contact, Some(true)).is_empty());
    assert!(unknown_of(&contact, Some(true), FINER.into()).is_some_and(|unknown| unknown.words.contains("singular")));
    assert!(!zone_doubts(&contact, Some(false)).is_empty());
}

#[test]
fn what_nothing_estimates_is_told() {
    let told = |lambda| {
        let zones = vec![ZoneSummary { lambda, ..zone() }];
        unknown_of(&ContactSummary { zones, ..ContactSummary::default() }, None, FINER.into())
    };
    assert!(told(Some(0.01)).is_none());
    assert!(told(None).is_some_and(|unknown| unknown.words.contains("nothing estimates")));
}

/// `trust`, `trust_force` and the words of a contact with one good zone.
fn judged(converged: bool, change: impl Fn(&mut Summary), settings: &[&str]) -> (Option<bool>, Option<bool>, String) {
    let case = case(settings);
    let mut summary = Summary::default();
    summary.contact.insert("seam".into(), ContactSummary { zones: vec![zone()], force: Some(5.0), ..ContactSummary::default() });
    let estimate = ContactEstimate { force: Some(1e-3), lambda: Some(0.01), peak: Some(0.02) };
    summary.estimate.contact.insert("seam".into(), estimate);
    change(&mut summary);
    let words = judge(&mut summary, &case, converged, None).unreliable.unwrap_or_default();
    (summary.contact["seam"].judged.trust, summary.contact["seam"].judged.trust_force, words)
}

#[test]
fn a_solve_that_failed_has_nothing_to_trust() {
    assert_eq!(judged(true, |_| (), &[]), (Some(true), Some(true), String::new()));
    assert_eq!(judged(false, |_| (), &[]), (Some(false), Some(false), String::new()));
}

#[test]
fn noise_between_bodies_that_have_only_moved_is_no_pressure() {
    let moved = |energy, error| {
        let change = move |summary: &mut Summary| {
            (summary.displacement_max, summary.energy.total) = (Some(0.1), Some(energy));
            summary.contact.get_mut("seam").expect("it is there").zones[0].lambda = Some(error);
        };
        judged(true, change, &[])
    };
    assert_eq!(moved(1e-20, 0.9), (None, None, String::new()));
    assert_eq!(moved(1e-20, 0.01).0, Some(true), "meshes agree on it");
    assert_eq!(moved(1e-3, 0.9).0, Some(false), "they are strained");
}

#[test]
fn what_is_beyond_the_model_spoils_the_force_too() {
    let turned = judged(true, |summary| _ = summary.rotation_max.insert("upper".into(), Some(0.5)), &[]);
    assert!(turned.0 == Some(false) && turned.1 == Some(false) && turned.2.contains("body upper turns"), "{turned:?}");
    let (locked, words) = (["mesh.order=1", "body.upper.poisson=0.499"], "body upper has ν = 0.499 with P1 triangles");
    let found = judged(true, |_| (), &locked);
    assert!(found.0 == Some(false) && found.1 == Some(false) && found.2.contains(words), "{found:?}");
    assert_eq!(judged(true, |_| (), &["mesh.order=2", "body.upper.poisson=0.499"]).0, Some(true));
    let early = |summary: &mut Summary| summary.solver.residual = Some(8e-3);
    let found = judged(true, early, &["solver.tolerance=0.01"]);
    assert!(found.0 == Some(false) && found.1 == Some(false) && found.2.contains("a residual of 8.0e-3"), "{found:?}");
    assert_eq!(judged(true, early, &["solver.tolerance=\"discretisation\""]).0, Some(true));
    let seam = |change: &'static dyn Fn(&mut ContactSummary)| {
        judged(true, move |summary| change(summary.contact.get_mut("seam").expect("it is there")), &[])
    };
    let found = seam(&|seam| seam.unresolved_force = Some(4.0));
    assert!(found.0 == Some(false) && found.1 == Some(false) && found.2.contains("within segments"), "{found:?}");
    let found = seam(&|seam| seam.lost_at_ends = Some(0.3));
    assert!(found.0 == Some(false) && found.1 == Some(false) && found.2.contains("have in common"), "{found:?}");
    let found = seam(&|seam| seam.zones[0].cut_off = Some(0.5));
    assert!(found.0 == Some(false) && found.1 == Some(false) && found.2.contains("name what lies beyond"), "{found:?}");
    // Of a force that is asked for to 1e-3 the direction may be off by no more.
    let turned = |summary: &mut Summary| summary.contact.get_mut("seam").expect("it is there").direction_error = Some(4e-3);
    assert_eq!([judged(true, turned, &[]).1, judged(true, turned, &["accuracy.force=1e-2"]).1], [Some(true); 2]);
    let found = judged(true, turned, &["accuracy.force=1e-3"]);
    assert!(found.1 == Some(false) && found.2.contains("wrong by about 4.0e-3 (relative), at most 1.0e-3 wanted"), "{found:?}");
    let noise = ZoneSummary { share: Some(1e-4), pressure_max: Some(1e-3), cut_off: Some(1.0), ..zone() };
    let beside =
        judged(true, move |summary| summary.contact.get_mut("seam").expect("it is there").zones.push(noise.clone()), &[]);
    assert_eq!(beside.0, Some(true), "a zone that nobody looks at: {}", beside.2);
    let found = seam(&|seam| seam.zones[0].lambda = Some(0.2));
    assert!(found.0 == Some(false) && found.1 == Some(true) && found.2.contains("whose force is to be trusted"), "{found:?}");
}

#[test]
fn what_helps_stands_beside_its_cause() {
    let rough = |summary: &mut Summary| {
        let contact = summary.contact.get_mut("seam").expect("it is there");
        (contact.missing, contact.inf_sup, contact.zones[0].lambda) = (Some(0.5), Some(0.01), Some(0.2));
    };
    let (.., words) = judged(true, rough, &["contact.seam.segments=30", "mesh.refine=2"]);
    let clauses = summary::clauses(&words);
    let is = |clause: &str, parts: [&str; 3]| parts.iter().all(|part| clause.contains(part));
    assert_eq!(clauses.len(), 2, "{clauses:?}");
    assert!(is(clauses[0], ["contact seam (inf-sup", "overlap", "trusted: take fewer segments"]), "{clauses:?}");
    assert!(
        is(clauses[1], ["contact seam (estimated error of λ 0.20", ": take mesh.refine = 3", "[accuracy] with pressure = 1e-2"]),
        "{clauses:?}"
    );
}

/// What is not resolved asks for as fine a mesh as each doubt about it.
#[test]
fn all_advice_on_a_mesh_names_the_same_refinement() {
    let narrow = |summary: &mut Summary| {
        let contact = summary.contact.get_mut("seam").expect("it is there");
        (contact.zones[0].edges, contact.zones[0].lambda) = (Some(0.1), Some(0.2));
        assert!(unresolved(summary, &case(&[]), None).is_some_and(|words| words.contains("take mesh.refine = 6,")));
    };
    let (.., words) = judged(true, narrow, &[]);
    let named = words.matches("mesh.refine = ").count();
    assert!(named > 0 && words.matches("mesh.refine = 6,").count() == named, "{words}");
    // No case can have sixteen.
    let narrower = |summary: &mut Summary| summary.contact.get_mut("seam").expect("it is there").zones[0].edges = Some(1e-4);
    let (.., words) = judged(true, narrower, &[]);
    assert!(!words.contains(FINER) && words.contains("take a mesh that is adapted"), "{words}");
}

/// With an accuracy the mesh and its segments are the program's own.
#[test]
fn advice_names_nothing_that_an_accuracy_overrides() {
    let rough = |summary: &mut Summary| {
        let contact = summary.contact.get_mut("seam").expect("it is there");
        (contact.missing, contact.inf_sup, contact.zones[0].lambda) = (Some(0.5), Some(0.01), Some(0.2));
    };
    let given = "contact.seam.segments=30";
    let (.., without) = judged(true, rough, &[given]);
    assert!(!without.contains("take more segments") && without.contains("take fewer segments"), "{without}");
    let overlapping = |summary: &mut Summary| summary.contact.get_mut("seam").expect("it is there").missing = Some(0.5);
    assert!(judged(true, overlapping, &[given]).2.contains("take more segments"));
    let (.., with) = judged(true, rough, &[given, "accuracy=1e-3"]);
    assert!(with.contains("ask for a smaller error"), "{with}");
    assert!(!with.contains("segments (") && !with.contains("more segments") && !with.contains(FINER), "{with}");
    let (trust, force, _) = judged(true, |_| (), &["contact.seam.quadrature=segment"]);
    assert_eq!((trust, force), (None, Some(true)), "no mesh tells what its integrals miss");
    let (.., sampled) = judged(true, rough, &[given, "accuracy=1e-3", "contact.seam.quadrature=segment"]);
    assert!(sampled.contains("take quadrature = \"cut\"") && !sampled.contains("ask for"), "{sampled}");
}

#[test]
fn bodies_out_of_balance_are_nothing_to_trust() {
    let of = |bodies, moment| {
        move |summary: &mut Summary| {
            summary.balance.bodies = Some(bodies);
            summary.support.insert("held".into(), SupportSummary { moment, ..Default::default() });
        }
    };
    assert_eq!(judged(true, of(1e-3, Some(0.0)), &[]).0, Some(true));
    assert_eq!(judged(true, of(0.5, None), &[]).0, Some(true), "supports carry all");
    let found = judged(true, of(0.03, Some(0.0)), &[]);
    assert!(found.0 == Some(false) && found.1 == Some(false) && found.2.contains("out of balance by 0.03"), "{found:?}");
}

/// [`CASE`] with so many contacts, after some overrides.
fn case_of(count: usize, settings: &[&str]) -> Case {
    let contacts: String =
        (0..count).map(|k| format!("contact.c{k} = {{ between = [\"lower.s{k}\", \"upper.s{k}\"] }}\n")).collect();
    parsed(&CASE.replace("contact.seam = { between = [\"lower.seam\", \"upper.seam\"] }\n", &contacts), settings)
}

/// A scene of so many contacts: that of number `k` carries `force(k)`, on zones of so many edges.
fn scene(count: usize, force: impl Fn(usize) -> f64, edges: impl Fn(usize) -> f64, settings: &[&str]) -> (Summary, Judgement) {
    let case = case_of(count, settings);
    let mut summary = Summary::default();
    for k in 0..count {
        let zones = vec![ZoneSummary { edges: Some(edges(k)), ..zone() }];
        let (force, unresolved_force, missing_force) = (Some(force(k)), Some(0.0), Some(0.0));
        let contact = ContactSummary { zones, force, unresolved_force, missing_force, ..ContactSummary::default() };
        summary.contact.insert(format!("c{k}"), contact);
    }
    let judgement = judge(&mut summary, &case, true, None);
    (summary, judgement)
}

/// The verdict on a pressure that is to be trusted, but grows towards an end on each mesh.
#[test]
fn a_largest_pressure_that_means_nothing_is_told_in_the_verdict() {
    let verdict = |at_end: bool, singular_at: Option<[f64; 2]>| {
        let singular = Some(at_end || singular_at.is_some());
        let zones = vec![ZoneSummary { singular, singular_at_end: Some(at_end), singular_at, ..zone() }];
        let (force, nothing) = (Some(5.0), Some(0.0));
        let contact =
            ContactSummary { zones, force, unresolved_force: nothing, missing_force: nothing, ..ContactSummary::default() };
        let mut summary = Summary { contact: [("seam".to_owned(), contact)].into(), ..Summary::default() };
        judge(&mut summary, &parsed(CASE, &[]), true, None);
        let judged = summary.contact["seam"].judged.clone();
        (judged.trust, judged.verdict.unwrap_or_default())
    };
    assert_eq!(verdict(false, None), (Some(true), "trusted".into()));
    let words = "trusted, but for the largest value: λ grows without bound";
    assert_eq!(verdict(true, None), (Some(true), format!("{words} towards an end")));
    let joint = "at (1, 0.5), where an edge between two materials ends or a side has a corner";
    assert_eq!(verdict(false, Some([1.0, 0.5])), (Some(true), format!("{words} {joint}")));
    assert_eq!(verdict(true, Some([1.0, 0.5])), (Some(true), format!("{words} towards an end and {joint}")));
}

#[test]
fn a_contact_that_carries_next_to_nothing_holds_up_no_verdict() {
    let verdict = |share: f64, settings: &[&str]| {
        let (summary, judgement) = scene(2, |k| [-5.0, 5.0 * share][k], |k| [8.0, 1.0][k], settings);
        let contact = summary.contact["c1"].judged.clone();
        assert_eq!(summary.contact["c0"].judged.verdict.as_deref(), Some("trusted"));
        assert_eq!(judgement.unreliable.is_some(), contact.trust == Some(false));
        (contact.trust, contact.verdict.expect("a verdict"))
    };
    let touches = |share| (Some(true), format!("touches; carries less than {share} of the largest force"));
    let narrow = (Some(false), "not trusted: contact is narrower than four edges".to_owned());
    assert_eq!([verdict(9e-5, &[]), verdict(1.1e-4, &[])], [touches("1e-4"), narrow.clone()]);
    let allowed = (None, "touches; carries less than 1e-2 of the largest force; its pressure is not resolved".to_owned());
    let asked = ["accuracy=1e-2"];
    assert_eq!([9e-5, 9e-3, 1.1e-2].map(|share| verdict(share, &asked)), [touches("1e-2"), allowed, narrow]);
}

#[test]
fn of_many_contacts_causes_are_counted_and_the_worst_are_named() {
    let (summary, judgement) = scene(40, |k| 1.0 + k as f64, |k| if k < 14 { 1.0 } else { 8.0 }, &[]);
    let words = judgement.unreliable.expect("words");
    assert!(
        words
            .starts_with("14 of 40 contacts: contact is narrower than four edges, the worst contact c13 (contact 1.0 edges wide"),
        "{words}"
    );
    assert_eq!(words.matches("contact c").count(), 1, "{words}");
    assert!(
        words.contains(&format!(": {FINER}"))
            && summary.contact["c13"].judged.trust == Some(false)
            && summary.contact["c39"].judged.trust == Some(true)
    );
    let (_, few) = scene(summary::MOST_TOLD, |k| 1.0 + k as f64, |_| 1.0, &[]);
    let few = few.unreliable.expect("words");
    assert!(few.starts_with("contacts c0, c1, ") && few.matches("edges wide").count() == 1, "what is alike is said once: {few}");
}

#[test]
fn a_force_on_one_or_two_segments_is_trusted_where_it_is_known_far_better() {
    let trusted = |segments, error| {
        let change = |summary: &mut Summary| {
            summary.contact.get_mut("seam").expect("it is there").zones[0].segments = Some(segments);
            summary.estimate.contact.get_mut("seam").expect("it is there").force = Some(error);
        };
        judged(true, change, &[]).1
    };
    assert_eq!([trusted(3, 5.5e-3), trusted(2, 5.5e-3), trusted(2, 1e-3)], [true, false, true].map(Some));
}

/// What a contact lacks beside a smooth joint the other one has: 7401 of a true 7177 was trusted beside 1300 for 1412.
#[test]
fn a_force_that_goes_on_in_another_contact_is_trusted_with_that_ones_only() {
    let (mut summary, _) = scene(3, |_| 1.0, |_| 8.0, &[]);
    let trusted = |summary: &Summary| ["c0", "c1", "c2"].map(|name| summary.contact[name].judged.trust_force);
    let estimates = [("c0", 1e-3), ("c1", 0.03), ("c2", 1e-3)];
    for (name, error) in estimates {
        summary.estimate.contact.insert(name.into(), ContactEstimate { force: Some(error), ..ContactEstimate::default() });
    }
    let case = case_of(3, &[]);
    for (shares_with, force, wanted) in [(&[][..], 1.0, true), (&["c1"], 1.0, false), (&["c1"], 5e-3, true), (&["c2"], 1.0, true)]
    {
        let contact = summary.contact.get_mut("c0").expect("it is there");
        contact.shares_with = shares_with.iter().map(ToString::to_string).collect();
        summary.contact.get_mut("c1").expect("it is there").force = Some(force);
        judge(&mut summary, &case, true, None);
        assert_eq!(trusted(&summary), [wanted, false, true].map(Some), "{shares_with:?}, {force}");
    }
}
