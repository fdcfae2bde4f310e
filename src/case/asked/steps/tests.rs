//! What steps scale, and in which words they are refused.

use super::*;
use crate::body::{BodyPart, LoadKind};
use crate::case::tests::{error_of, good, parse};
use crate::case::{Case, LoadStep};
use crate::contact::GapChoice;

#[test]
fn numbers_formulas_and_lists_are_multiplied() {
    let table: Table = toml::from_str("a = 3\nb = -0.5\nc = \"x + 1\"\nd = [2, \"y\"]").expect("a table");
    let [a, b, c, d] = ["a", "b", "c", "d"].map(|key| times(&table[key], 0.25));
    assert_eq!((a.as_float(), b.as_float(), c.as_str()), (Some(0.75), Some(-0.125), Some("0.25*(x + 1)")));
    assert_eq!(d.to_string(), "[0.5, \"0.25*(y)\"]");
}

#[test]
fn without_weight_no_density_is_left() {
    let text = "[gravity]\ng = [0, -9.81]\n[body.a]\ndensity = 2\nyoung = 1\n[body.b.part.c]\ndensity = 3";
    let mut table: Table = toml::from_str(text).expect("a table");
    scale(&mut table, &GRAVITY.map(String::from), 0.5);
    assert_eq!(table["gravity"]["g"].to_string(), "[0.0, -4.905]");
    scale(&mut table, &GRAVITY.map(String::from), 0.0);
    assert!(
        !table.to_string().contains("density") && table.get("gravity").is_none() && table["body"]["a"].get("young").is_some()
    );
}

/// Steps of a case that is good, with one mistake each.
#[test]
fn every_error_of_steps_names_key_value_and_remedy() {
    let many = vec!["1"; 1001].join(", ");
    let (press, gap) = ("scales = ['load.l']", "scales = ['contact.c']");
    let mut missed = Vec::new();
    for (steps, expected) in [
        (format!("{{p = {{{press}}}}}"), "steps.p.factors: missing; write factors = [0.5, 1.0], one for each step"),
        (format!("{{p = {{factors = [], {press}}}}}"), "steps.p.factors = [] (--set): must not be empty"),
        (format!("{{p = {{factors = 0.5, {press}}}}}"), "must be a list of numbers, not of type float"),
        (format!("{{p = {{factors = [1, inf], {press}}}}}"), "entry 2: must be a finite number"),
        (format!("{{p = {{factors = [{many}], {press}}}}}"), "has 1001 steps; at most 1000 are possible"),
        ("{p = {factors = [1]}}".into(), "steps.p.scales: missing; write scales = [\"load.top\"]"),
        ("{p = {factors = [1], scales = []}}".into(), "steps.p.scales = [] (--set): must not be empty: give keys of loads"),
        ("{p = {factors = [1], scales = ['load.k']}}".into(), "\"load.k\" is not in the case; did you mean \"load.l\"?"),
        (
            "{p = {factors = [1], scales = ['load.k.pressure']}}".into(),
            "\"load.k.pressure\" is not in the case; did you mean \"load.l.pressure\"?",
        ),
        (
            "{p = {factors = [1], scales = ['probe.p']}}".into(),
            "\"probe.p\" cannot be scaled; what can is load.NAME, support.NAME",
        ),
        ("{p = {factors = [1], scales = ['load.l.on']}}".into(), "cannot be scaled: of a load that is pressure, traction"),
        ("{p = {factors = [1], scales = ['load.l.force']}}".into(), "has nothing to scale: it gives no force"),
        ("{p = {factors = [1], scales = ['support.b']}}".into(), "has nothing to scale: it gives no ux, uy, normal"),
        ("{p = {factors = [1], scales = ['gravity']}}".into(), "\"gravity\" is not in the case"),
        (format!("{{p = {{factors = [1], {gap}}}}}"), "\"contact.c\" has gap = \"closed\", which is no number"),
        (
            format!("{{p = {{factors = [1, 2], {press}}}, q = {{factors = [1], scales = ['support.s']}}}}"),
            "steps.q.factors = [1] (--set): lists 1 steps, but steps.p lists 2; give each factor one value a step",
        ),
        (
            format!("{{p = {{factors = [1], {press}}}, q = {{factors = [1], scales = ['load.l.pressure']}}}}"),
            "\"load.l.pressure\" scales load.l.pressure, which steps.p scales already; a value has one factor",
        ),
        (
            format!("{{p = {{factors = [1, 1e308, 2], {press}}}}}"),
            "load.l.pressure = inf: must be a finite number (in step 2 of 3)",
        ),
        (format!("{{p = {{factor = [1], factors = [1], {press}}}}}"), "steps.p.factor: unknown key; did you mean \"factors\"?"),
        ("3".into(), "steps = 3 (--set): must be a table; write [steps]"),
    ] {
        let overrides = ["load.l.pressure=1e3", "contact.c.gap=closed", "support.b={on='left', stiffness={x=1}}"];
        let steps = format!("steps={steps}");
        let words =
            parse(&good(), &[&overrides[..], &[&steps]].concat()).map_or_else(|error| error.to_string(), |_| "accepted".into());
        if !words.contains(expected) || words.lines().count() != 1 {
            missed.push(format!("{steps}: {words}\n  instead of {expected}"));
        }
    }
    assert!(missed.is_empty(), "{}", missed.join("\n"));
    let words = error_of(&good(), &["accuracy=1e-3", "steps.p={factors=[1], scales=['load.l']}"]);
    assert!(words.contains("stands beside an accuracy") && words.contains("--set steps={}"), "{words}");
    let words = error_of(&good(), &["contact.c.gap=geometry", "steps.p={factors=[1], scales=['contact.c.gap']}"]);
    assert!(words.contains("has gap = \"geometry\", which is no number"), "{words}");
}

#[test]
fn a_step_is_the_case_with_everything_scaled_and_the_last_one_is_the_case() {
    let case = parse(
        &good(),
        &[
            "steps.p={factors=[0, 0.5, 2], scales=['load.l', 'contact.c.gap']}",
            "steps.q={factors=[1, 0, 3], scales=['gravity', 'body.a', 'rigid.r.uy']}",
            "contact.c.gap=x + 1",
            "gravity.g=[0, -10]",
            "body.a={young = 1, poisson = 0.3, density = 2, body_force = [1, 'x']}",
            "rigid.r={line = [[0, 0], [1, 0]], ux = 0.5, uy = -0.25}",
            "contact.d={between = ['k', 'rigid.r'], curve = 'line'}",
        ],
    )
    .unwrap();
    let told = |case: &Case| {
        let [fx, fy] = case.bodies[0].parts[0].force.each_ref().map(|force| force.value(&[4.0, 0.0]));
        let (LoadKind::Pressure(pressure), GapChoice::Formula(gap)) = (&case.loads[0].kind, &case.contacts[0].gap) else {
            panic!("{case:?}")
        };
        (pressure.value(&[0.0, 0.0]), gap.value(&[4.0, 0.0]), [fx, fy], case.tools[0].motion.prescribed)
    };
    let expected = [
        (0.0, 0.0, [1.0, 4.0 - 20.0], [Some(0.5), Some(-0.25), Some(0.0)]),
        (0.5, 2.5, [0.0, 0.0], [Some(0.5), Some(-0.0), Some(0.0)]),
        (2.0, 10.0, [3.0, 12.0 - 60.0], [Some(0.5), Some(-0.75), Some(0.0)]),
    ];
    assert_eq!(case.steps.iter().map(|step| told(&step.case)).collect::<Vec<_>>(), expected);
    assert_eq!(told(&case), expected[2], "the last step is the case");
    assert_eq!(case.steps[1].words(), "step 2 of 3 (p = 0.5, q = 0)");
    let expects = case.steps.iter().map(|step| step.case.exact.energy.is_some()).collect::<Vec<_>>();
    assert_eq!(expects, [false, false, true], "expected values are those of the last step");
    assert!(case.resolved().contains("[steps.p]") && !case.steps[2].case.resolved().contains("steps"));
    assert!(parse(&good(), &["steps={}"]).unwrap().steps.is_empty());
}

#[test]
fn a_formula_times_zero_is_seen_to_be_nothing() {
    let case = parse(&good(), &["load.l.pressure='1 + x'", "steps.p={factors=[0, 1], scales=['load.l']}"]).unwrap();
    let nothing = |step: &LoadStep| step.case.loads[0].kind.formulas().iter().all(|formula| formula.is_zero());
    assert_eq!(case.steps.iter().map(nothing).collect::<Vec<_>>(), [true, false]);
}

#[test]
fn one_part_of_a_body_is_scaled_or_one_value_of_it() {
    let parts = |scales: &str| {
        let part = "{young = 1, poisson = 0.3, body_force = [2, 4], expansion = 1e-5, temperature = 8}";
        let body = format!("body.a={{part = {{core = {part}, rim = {part}}}}}");
        let case = parse(&good(), &[&body, &format!("steps.p={{factors=[0.5], scales=['{scales}']}}")]).unwrap();
        let told = |part: &BodyPart| {
            let temperature = part.heat.as_ref().map(|heat| heat.temperature.value(&[0.0; 2]));
            (part.force[1].value(&[0.0; 2]), temperature.expect("it is heated"))
        };
        case.steps[0].case.bodies[0].parts.iter().map(told).collect::<Vec<_>>()
    };
    assert_eq!(parts("body.a"), [(2.0, 4.0), (2.0, 4.0)]);
    assert_eq!(parts("body.a.part.rim"), [(4.0, 8.0), (2.0, 4.0)]);
    assert_eq!(parts("body.a.part.core.temperature"), [(4.0, 4.0), (4.0, 8.0)]);
    let words = error_of(&good(), &["steps.p={factors=[1], scales=['body.a.part.core']}"]);
    assert!(words.contains("\"body.a.part.core\" has nothing to scale"), "{words}");
}
