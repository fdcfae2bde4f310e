//! What is told of a case that is wrong.

use std::path::Path;

use crate::case::Case;
use crate::case::tests::{LEAST, error_of, good, parse};

#[test]
fn a_bad_file_is_named() {
    let words = Case::read(Path::new("no/such.toml"), &[]).unwrap_err().to_string();
    assert!(words.starts_with("no/such.toml: cannot be read: "), "{words}");
    let words = error_of("mesh.file = 'a'\n[body.a\n", &[]);
    assert!(words.starts_with("line 2, column 8: "), "{words}");
    assert!(words.ends_with("the file is written in TOML, see toml.io"), "{words}");
}

#[test]
fn numbers_that_toml_does_not_read_are_told() {
    for (text, words) in [
        ("[body.a]\nyoung = 7000,0\n", "line 2, column 13: a number has a dot, not a comma; write 7000.0; "),
        ("poisson = .3", "line 1, column 11: a number has digits before and behind its dot; write 0.5 and 2.0; "),
        ("x = -1.e5", "line 1, column 8: a number has digits before and behind its dot; write 0.5 and 2.0; "),
        ("x = -0,25", "line 1, column 7: a number has a dot, not a comma; write 0.25; "),
        ("x = 2,1e5", "line 1, column 6: a number has a dot, not a comma; write 2.1e5; "),
    ] {
        assert!(error_of(text, &[]).starts_with(words), "{}", error_of(text, &[]));
    }
    for text in ["x = 1,", "x = 1,y", "x = 'a',5"] {
        assert!(!error_of(text, &[]).contains("comma; write"), "{}", error_of(text, &[]));
    }
}

#[test]
fn names_are_unique() {
    let words = error_of(&format!("{LEAST}[body.a]\nyoung = 2\n"), &[]);
    assert!(words.starts_with("line 5, column 7: duplicate key"), "{words}");
}

#[test]
fn all_errors_are_reported_at_once() {
    let text = "[body.a]\nyung = 1\npoisson = 0.5\n[probe.p]\npoint = [1]\nbody = 'b'\n[contact.c]\n[exact.contact.d]\n";
    let words = parse(text, &[]).unwrap_err().to_string();
    for expected in [
        "bars/case.toml: mesh.file: missing; write file = \"bars.msh\"",
        "bars/case.toml: body.a.young: missing; write young = ",
        "bars/case.toml: body.a.yung: unknown key; did you mean \"young\"?",
        "bars/case.toml: body.a.poisson = 0.5: must lie in (-1, 0.5); 0.5 is incompressible",
        "bars/case.toml: probe.p.point = [1]: must be two numbers",
        "bars/case.toml: contact.c.between: missing",
        "bars/case.toml: exact.contact.d: no such contact; did you mean \"c\"?",
    ] {
        assert!(words.lines().any(|line| line.starts_with(expected)), "{expected}\nis not in\n{words}");
    }
    assert_eq!(words.lines().count(), 7, "{words}");
}

/// Each override of a case that is good makes one error, with key, value and remedy in these words.
fn assert_refused(all: &[(&str, &str)]) {
    let mut missed = Vec::new();
    for (overrides, expected) in all {
        let words = parse(&good(), &[overrides]).map_or_else(|error| error.to_string(), |_| "accepted".into());
        if !words.contains(expected) || words.lines().count() != 1 {
            missed.push(format!("{overrides}: {words}\n  instead of {expected}"));
        }
    }
    assert!(missed.is_empty(), "{}", missed.join("\n"));
}

#[test]
fn errors_of_meshes_and_of_unknown_tables_name_key_value_and_remedy() {
    assert_refused(&[
        ("mesh.order=3", "mesh.order = 3 (--set): must be 1 or 2"),
        ("mesh.refine=-1", "must be a whole number from 0 to 12"),
        ("mesh.refine=1.0", "must be a whole number from 0 to 12"),
        ("mesh.file=7", "mesh.file = 7 (--set): must be a string in quotes, not of type integer"),
        ("mesh.file=''", "must not be empty"),
        ("mesh.grade.points=[[0, 3]]", "mesh.grade.exponent: missing; write exponent = 0.75, if u ~ r^0.75"),
        ("mesh.grade.ratio=0.2", "mesh.grade.points: missing; write points = [[0, 3], [6, 4]]"),
        ("mesh.grade={points = [[0, 3], [0, 3]], ratio = 0.2}", "entry 2 stands there twice"),
        (
            "mesh.grade={points = [[0, 3]], ratio = 0.6}",
            "mesh.grade.ratio = 0.6 (--set): must be a number, or a list of them, one per point, from 0.1",
        ),
        ("mesh.grade={points = [[0, 3]], ratio = [0.2, 0.3]}", "a list of 1, one per point, from 0.1 to 0.5, or \"auto\""),
        ("mesh.grade={points = [[0, 3]], exponent = 0}", "one per point, above 0: u ~ r^exponent"),
        ("solver=3", "solver = 3 (--set): must be a table; write [solver]"),
        ("meshes.a=1", "meshes: unknown key; did you mean \"mesh\"?"),
        ("cases=1", "cases: unknown key; there are title, mesh, plane, gravity, body, rigid"),
    ]);
}

#[test]
fn errors_of_bodies_and_of_their_weight_name_key_value_and_remedy() {
    assert_refused(&[
        ("body.a.young=0", "body.a.young = 0 (--set): must be above 0, and lie in [1e-100, 1e100]"),
        ("body.a.young=inf", "must be a finite number"),
        ("body.a.poisson=0,3", "body.a.poisson = \"0,3\" (--set): must be a finite number; write 0.3"),
        ("body.a.poisson=.3", "must be a finite number; write 0.3"),
        ("body.a.young=\"2e5\"", "must be a finite number; write 200000.0"),
        ("body.a.young=soft", "body.a.young = \"soft\" (--set): must be a finite number, not of type string"),
        ("body.a.poisson=-1", "must lie in (-1, 0.5)"),
        (
            "body.a.body_force=[1]",
            "body.a.body_force = [1] (--set): must be a list of 2 numbers or formulas of x, y, not a list of length 1",
        ),
        ("body.a.body_force=['1', 't']", "entry 2: column 1: found `t`; allowed here: a number, x, y"),
        (
            "body.a.left.young=1",
            "body.a.left: unknown key; there are plane, part, young, poisson, body_force, density, expansion, temperature (a name that holds dots stands in quotes)",
        ),
        ("body.b=1", "body.b = 1 (--set): must be a table; write [body.b]"),
        ("body.a.density=2", "body.a.density = 2 (--set): weighs nothing without gravity; write [gravity]"),
        ("gravity.g=[0, -9.81]", "gravity: acts on nothing; give density"),
        ("gravity={g=[0, 0]}", "gravity.g = [0, 0] (--set): must not be [0, 0]"),
        ("gravity=9.81", "gravity = 9.81 (--set): must be a table"),
        ("gravity={}", "gravity.g: missing; write g = [0.0, -9.81]"),
        ("gravity={g=[0, 1, 2]}", "gravity.g = [0, 1, 2] (--set): must be two numbers [x, y]"),
    ]);
}

#[test]
fn errors_of_geometries_name_key_value_and_remedy() {
    let circle = "{centre = [0, 0], radius = 1}";
    assert_refused(&[
        ("geometry.g.curves=[]", "must list at least one physical curve"),
        ("geometry.g.curves=['p', 'p']", "lists \"p\" twice"),
        ("geometry.g.curves=3", "must be a physical curve, or a list of them"),
        ("geometry.g.t=[1, 1]", "must be two ascending numbers"),
        ("geometry.g.x=1", "neither x nor y depends on t"),
        ("geometry.g.x=1/t", "geometry.g.x = \"1/t\" (--set): is not finite at t = 0"),
        ("geometry.g.x=x", "found `x`; allowed here: a number, t, pi"),
        (&format!("geometry.g.circle={circle}"), "geometry.g.circle: stands beside x, y, t"),
        ("geometry.h={curves='h', circle={centre=[0, 0], radius=0}}", "geometry.h.circle.radius = 0 (--set): must be > 0"),
        (&format!("geometry.h={{curves='p', circle={circle}}}"), "geometry.h.curves = \"p\" (--set): geometry.g lists \"p\" too"),
    ]);
}

#[test]
fn errors_of_supports_name_key_value_and_remedy() {
    assert_refused(&[
        ("support.s.normal=0", "cannot stand beside ux or uy"),
        ("support.r.on=left", "support.r: prescribes nothing; give ux, uy or normal"),
        ("support.s.ux=1/0", "support.s.ux = \"1/0\" (--set): is not finite"),
        ("support.s.ux=true", "must be a number or a formula of x, y, not of type boolean"),
        ("support.s.at=[0, 1]", "support.s.at = [0, 1] (--set): stands beside on; give physical curves or a point"),
        ("support.r={at=[0, 1], normal=0}", "support.r.normal = 0 (--set): stands beside at: a point has no normal"),
        ("support.r={at=[0, 1]}", "support.r: prescribes nothing; give ux, uy or normal"),
        ("support.r={at=[0], ux=0}", "support.r.at = [0] (--set): must be two numbers [x, y], not a list of length 1"),
        (
            "support.r={at=[0,5, 1,5], ux=0}",
            "must be two numbers [x, y], not a list of length 4; a number has a dot, not a comma",
        ),
        ("support.r={ux=0}", "support.r.on: missing; write on = \"bottom\", or at = [0.0, 1.0] for a point"),
        ("support.r={at=[0, 1], ux=0, body='b'}", "support.r.body = \"b\" (--set): no such body; did you mean \"a\"?"),
        ("support.s.body=a", "support.s.body = \"a\" (--set): stands beside at = [x, y] only"),
        ("support.s.stiffness={normal=1}", "support.s.ux = 0: stands beside stiffness: springs prescribe nothing"),
        ("support.r={at=[0, 1], stiffness={x=1}}", "support.r.at = [0, 1] (--set): stands beside stiffness"),
        ("support.r={on='left', stiffness=3}", "support.r.stiffness = 3 (--set): must be a table, as { normal = 100.0 }"),
        ("support.r={on='left', stiffness={}}", "support.r.stiffness: holds nothing; give normal, or x and y"),
        ("support.r={on='left', stiffness={x=1, normal=2}}", "support.r.stiffness.normal = 2 (--set): stands beside x or y"),
        ("support.r={on='left', stiffness={x=-1}}", "support.r.stiffness.x = -1 (--set): must be > 0"),
        ("support.r={on='left', stiffness={z=1, x=1}}", "support.r.stiffness.z: unknown key"),
    ]);
}

#[test]
fn errors_of_loads_name_key_value_and_remedy() {
    assert_refused(&[
        ("load.k={at=[0, 1]}", "load.k.force: missing; write force = [0.0, -1.0], per thickness"),
        ("load.k={at=[0, 1], force=1}", "load.k.force = 1 (--set): must be a list of 2 numbers"),
        (
            "load.k={at=[0, 1], force=[0, 1], pressure=2}",
            "load.k.pressure = 2 (--set): acts on physical curves; at a point give force",
        ),
        ("load.l.force=[0, 1]", "load.l.force = [0, 1] (--set): acts at a point, at = [x, y]"),
        ("load.k={at=[0, 1], force=[0, 1], body='b'}", "load.k.body = \"b\" (--set): no such body"),
        ("load.l.traction=[0, 1]", "load.l.pressure = 1: stands beside traction"),
        ("load.l.angle=0.1", "load.l.angle: goes with rigid only, which is not here"),
        ("load.k.on=top", "load.k: loads nothing; give pressure or traction"),
    ]);
}

#[test]
fn errors_of_contacts_name_key_value_and_remedy() {
    assert_refused(&[
        ("contact.c.between=['p', 'p']", "must name two different curves"),
        ("contact.'a/b'={between=['p', 'r'], curve='line'}", "contact.\"a/b\": its name is part of a file name; use"),
        ("contact.\"\"={between=['p', 'r'], curve='line'}", "contact.\"\": its name is part of a file name; use"),
        ("contact.'..'={between=['p', 'r'], curve='line'}", "contact.\"..\": its name is part of a file name; use"),
        ("contact.c.between=[['p', 'p'], 'q']", "lists \"p\" twice; list each physical curve once"),
        ("contact.c.between=[['p', 'q'], 'q']", "must name two different curves"),
        ("contact.c.between=[[], 'q']", "must list at least one physical curve"),
        ("contact.c.between=[['p', 3], 'q']", "must be a string in quotes, not of type integer"),
        ("contact.c.between=['p', 'q', 'r']", "must be two physical curves, of body 1 and of body 2, not a list of length 3"),
        ("contact.c={between=[['p', 'r'], 'q'], curve='geometry'}", "needs one [geometry] with curves = [\"p\", \"r\", \"q\"]"),
        ("contact.c.between=p", "must be two physical curves, of body 1 and of body 2, not of type string"),
        ("contact.c.curve=lines", "did you mean \"line\"?"),
        ("contact.c.curve=geometry", "needs one [geometry] with curves = [\"p\", \"q\"]; geometry.g lists \"p\""),
        ("contact.c.gap=clsoed", "must be \"closed\", \"geometry\", a number or a formula of x, y; column 1: found `clsoed`"),
        ("contact.c.multiplier=p1", "must be \"p0\" or \"p1-discontinuous\" or \"p1-continuous\"; did you mean \"p0\"?"),
        ("contact.c.multiplier=0", "not of type integer"),
        ("contact.c.segments=0", "must be \"auto\", a whole number >= 1, or fractions"),
        ("contact.c.segments=many", "must be \"auto\", a whole number >= 1, or fractions"),
        ("contact.c.segments=[0, 0.5]", "must ascend from 0 to 1"),
        ("contact.c.segments=[0, 0.5, 0.5, 1]", "must ascend from 0 to 1"),
        ("contact.c.law=bonded", "must be \"unilateral\" or \"bilateral\""),
        ("contact.c.quadrature=segments", "must be \"cut\" or \"segment\"; did you mean \"segment\"?"),
        ("contact.c.points=5", "contact.c.points = 5 (--set): stands beside quadrature = \"cut\""),
        ("contact.c={between=['p', 'q'], curve='line', quadrature='segment', points=21}", "must be a whole number from 1 to 20"),
        (
            "contact.c={between=['p', 'q'], curve='line', quadrature='segment', points=1}",
            "give 2 or more, or multiplier = \"p0\"",
        ),
        ("contact.c.stabilise=1", "must be \"auto\", true or false"),
        ("contact.c.configuration=deformed", "\"deformed\" wants curve = \"fit\""),
        ("contact.c.spans=3", "contact.c.spans = 3 (--set): is for curve = \"fit\""),
        ("contact.c.spans=0", "must be a whole number of at least 1, or \"auto\""),
        ("contact.c.grading=0.5", "must be a number from 1 to 1000"),
        ("contact.c.ends=loose", "must be \"free\" or \"fixed\""),
    ]);
}

#[test]
fn errors_of_solver_output_and_probes_name_key_value_and_remedy() {
    assert_refused(&[
        ("solver.name=Direct", "must be \"auto\" or \"fieldsplit\" or \"direct\"; did you mean \"direct\"?"),
        ("solver.tolerance=0", "must lie in [1e-16, 0.01]"),
        ("solver.tolerance=0.02", "must lie in [1e-16, 0.01]"),
        ("solver.tolerance=fine", "must be a number like 1e-8, or \"discretisation\""),
        ("units.length=kilometres per h", "must have at most 12 letters, not 16"),
        ("units.forces=N", "unknown key; did you mean \"force\"?"),
        ("output.fields=no", "must be true or false, not of type string"),
        ("output.figures=[\"sigma_1\", \"sigma_3\"]", "entry 2: must be \"sigma_1\" or \"sigma_2\" or \"tau_max\""),
        ("output.figures=[\"mises\", \"all\"]", "or \"sigma_zz\" or \"sigma_rr\" or \"sigma_tt\"; entry 2: must be"),
        ("output.figures=[\"sigma_tt\"]", "write \"sigma_xx\", and \"sigma_zz\" for the stress across the plane"),
        ("output.field=false", "unknown key; did you mean \"fields\"?"),
        ("probe.p.body=aa", "probe.p.body = \"aa\" (--set): no such body; did you mean \"a\"?"),
        ("probe.p.point=[0, nan]", "entry 2: must be a finite number"),
    ]);
}

#[test]
fn errors_of_exact_values_name_key_value_and_remedy() {
    assert_refused(&[
        ("exact.must_hold=1", "must be true or false, not of type integer"),
        ("exact.energy.value=0", "exact.energy.value = 0 (--set): must not be 0"),
        ("exact.energy=3", "exact.energy = 3 (--set): must be a table; write [exact.energy]"),
        ("exact.energy={value = 3}", "exact.energy.tolerance: missing; write tolerance = 1e-3"),
        ("exact.contact.d={}", "exact.contact.d: no such contact; did you mean \"c\"?"),
        ("exact.contact.c.lambda.at=[[0, 0], [0, 1]]", "exact.contact.c.lambda.value = [1]: holds 1 for 2 points in at"),
        ("exact.contact.c.lambda.formula=x", "stands beside at and value"),
        ("exact.body.b.u=[\"x\", 0]", "exact.body.b: no such body; did you mean \"a\"?"),
        ("exact.body.a.stress=[0, 0]", "must be a list of 3 or 4 numbers or formulas of x, y"),
        ("exact.energi=1", "exact.energi: unknown key; did you mean \"energy\"?"),
    ]);
}

#[test]
fn the_energy_of_a_force_at_a_point_cannot_be_asked_for() {
    for asked in ["accuracy=1e-3", "accuracy.energy=1e-3"] {
        let words = error_of(LEAST, &["load.k={at=[0, 1], force=[0, 1]}", asked]);
        assert!(words.contains("load.k acts at a point, where the energy is infinite"), "{words}");
    }
}

#[test]
fn long_values_are_cut() {
    let list = vec!["0.123456"; 100].join(", ");
    let words = error_of(LEAST, &[&format!("body.a.poisson=[{list}]")]);
    assert!(words.len() < 200 && words.contains(" ...") && words.contains("not a list of length 100"), "{words}");
}
