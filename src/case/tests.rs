use std::path::Path;

use super::*;
use crate::body::LoadKind;
use crate::body::Material;
use crate::contact::{CurveChoice, GapChoice, Law, MultiplierSpace, Quadrature, SegmentRule};

/// Every key of the contract that can be given.
const FULL: &str = r#"
title = "Two bars"
[mesh]
file = "bars.msh"
order = 1
refine = 3
[body.lower]
young = 7000
poisson = 0.227
body_force = [0, "-9.81*y"]
[body."upper.left"]
young = 7e6
poisson = -0.2
[geometry.parabola]
curves = ["lower.seam", "upper.seam"]
x = "t"
y = "4 + t - 0.25*t^2"
t = [0, 4]
[geometry.hole]
curves = "hole"
circle = { centre = [1, 2.5], radius = 0.5 }
[support.table]
on = "bottom"
ux = "0.1*x"
uy = 0
[support.roller]
on = ["left", "right"]
normal = 0.0
[load.top]
on = "top"
pressure = "1 + x"
[load.side]
on = ["side"]
traction = [1, "y"]
[contact.seam]
between = ["lower.seam", "upper.seam"]
curve = "geometry"
gap = "1e-3*x^2"
multiplier = "p0"
segments = [0, 0.2, 1]
law = "bilateral"
quadrature = "cut"
stabilise = false
configuration = "reference"
[solver]
name = "direct"
tolerance = 1e-10
[output]
fields = false
[probe.tip]
point = [1, 2.0]
body = "upper.left"
[exact]
must_hold = true
energy = { value = 2.6e-3, tolerance = 2e-5 }
[exact.contact.seam]
force = { value = 6.08, tolerance = 1e-9 }
lambda = { at = [[1.2, 3.2]], value = [0.925], tolerance = 1e-3 }
[exact.body.lower]
displacement = { at = [[6, 4]], value = [[6.3e-4, -7.7e-4]], tolerance = 1e-4 }
u = ["x", 0]
stress = ["1", "x*y", 0.5]
"#;

/// The least that a case can be, and room for one more section.
const LEAST: &str = "mesh.file = 'a.msh'\n[body.a]\nyoung = 1\npoisson = 0.3\n";
const CONTACT: &str = "[contact.c]\nbetween = ['p', 'q']\ncurve = 'line'\n";

fn parse(text: &str, overrides: &[&str]) -> Result<Case, CaseError> {
    let overrides: Vec<String> = overrides.iter().map(ToString::to_string).collect();
    Case::parse(text, Path::new("bars/case.toml"), &overrides)
}

/// The only error of a case, without the name of the file.
fn error_of(text: &str, overrides: &[&str]) -> String {
    let words = parse(text, overrides).map(|case| panic!("accepted: {case:?}")).unwrap_err().to_string();
    assert_eq!(words.lines().count(), 1, "{words}");
    words.strip_prefix("bars/case.toml: ").unwrap().to_owned()
}

#[test]
fn a_full_case_is_read() {
    let case = parse(FULL, &[]).unwrap();
    assert_eq!((case.name.as_str(), case.title.as_str(), case.folder.as_path()), ("bars", "Two bars", Path::new("bars")));
    assert_eq!(case.mesh, MeshChoice { file: "bars/bars.msh".into(), order: Order::P1, refine: 3, grades: Vec::new() });
    let [lower, upper] = &case.bodies[..] else { panic!("{:?}", case.bodies) };
    let [lower_part, upper_part] = [lower, upper].map(|body| &body.parts[0]);
    let Material { young, poisson, .. } = lower_part.material;
    assert_eq!((lower.name.as_str(), young, poisson), ("lower", 7000.0, 0.227));
    assert_eq!(lower_part.force[1].value(&[0.0, 2.0]), -19.62);
    assert_eq!((upper.name.as_str(), upper_part.force[0].as_constant()), ("upper.left", Some(0.0)));
    assert!(
        matches!(&case.geometries[0].curve, Curve::Parametric(curve) if curve.range() == [0.0, 4.0] && curve.point(2.0).y == 5.0)
    );
    assert_eq!(case.geometries[1].curve, Curve::Circle { centre: [1.0, 2.5], radius: 0.5 });
    assert_eq!(case.geometries[1].curves, ["hole"]);
    let [table, roller] = &case.supports[..] else { panic!("{:?}", case.supports) };
    assert_eq!(table.ux.as_ref().unwrap().text(), "0.1*x");
    assert!(table.uy.is_some() && table.normal.is_none() && roller.normal.is_some());
    assert_eq!(roller.on, ["left", "right"]);
    assert!(matches!(&case.loads[0].kind, LoadKind::Pressure(p) if p.value(&[2.0, 0.0]) == 3.0));
    assert!(matches!(&case.loads[1].kind, LoadKind::Traction([_, ty]) if ty.text() == "y"));
    let pair = &case.contacts[0];
    assert_eq!((pair.curve, pair.space, pair.law), (CurveChoice::Geometry, MultiplierSpace::P0, Law::Bilateral));
    assert_eq!(pair.segments, SegmentRule::Fractions(vec![0.0, 0.2, 1.0]));
    assert!(matches!(&pair.gap, GapChoice::Formula(gap) if gap.value(&[2.0, 0.0]) == 4e-3));
    assert_eq!(case.solver, Solver { choice: SolverChoice::Direct, tolerance: Tolerance::Residual(1e-10), inf_sup: None });
    assert!(!case.output.fields);
    assert_eq!(case.probes, [Probe { name: "tip".into(), point: [1.0, 2.0], body: "upper.left".into() }]);
    assert!(case.exact.must_hold);
    assert_eq!(case.exact.energy, Some(Expected { value: 2.6e-3, tolerance: 2e-5 }));
    assert!(matches!(&case.exact.contacts[0].lambda, Some(LambdaExact::Points { value, .. }) if value == &[0.925]));
    let body = &case.exact.bodies[0];
    assert_eq!(body.displacement.as_ref().unwrap().value, [[6.3e-4, -7.7e-4]]);
    assert_eq!(body.stress.as_ref().unwrap()[1].value(&[2.0, 3.0]), 6.0);
}

#[test]
fn defaults_are_those_of_the_contract() {
    let case = parse(&format!("{LEAST}{CONTACT}"), &[]).unwrap();
    assert_eq!((case.mesh.order, case.mesh.refine, case.title.as_str()), (Order::P2, 0, ""));
    assert_eq!(case.solver, Solver { choice: SolverChoice::Auto, tolerance: Tolerance::Residual(1e-8), inf_sup: None });
    assert!(case.output.fields);
    let pair = &case.contacts[0];
    assert_eq!((pair.space, pair.law), (MultiplierSpace::P1Discontinuous, Law::Unilateral));
    assert_eq!(pair.segments, SegmentRule::Auto);
    assert!(matches!(pair.gap, GapChoice::Geometry));
    assert_eq!(case.exact, Exact::default());
}

/// `points` has a default beside `quadrature = "segment"` only.
#[test]
fn the_points_of_a_segment_are_counted() {
    let read = |text: &str| parse(&format!("{LEAST}{CONTACT}{text}"), &[]).unwrap();
    let case = read("quadrature = 'segment'");
    assert_eq!(case.contacts[0].quadrature, Quadrature::Segment { points: 5 });
    assert!(case.resolved().lines().any(|line| line == "points = 5"));
    let case = read("quadrature = 'segment'\npoints = 1\nmultiplier = 'p0'");
    assert_eq!(case.contacts[0].quadrature, Quadrature::Segment { points: 1 });
    let case = read("");
    assert_eq!(case.contacts[0].quadrature, Quadrature::Cut);
    assert!(!case.resolved().contains("points"));
}

#[test]
fn the_resolved_case_is_an_equal_case_from_another_folder() {
    for (text, overrides) in [
        (FULL.to_owned(), vec![]),
        (format!("{LEAST}{CONTACT}"), vec!["contact.c.gap=-1e-3", "exact.energy={value=1, tolerance=0.1}"]),
    ] {
        let case = parse(&text, &overrides).unwrap();
        let resolved = case.resolved();
        let again = Case::parse(&resolved, Path::new("/elsewhere/bars/case.toml"), &[]).unwrap();
        assert!(again.mesh.file.is_absolute());
        assert_eq!(again.resolved(), resolved);
        let here = Case { file: again.file.clone(), folder: again.folder.clone(), table: again.table.clone(), ..case };
        let mesh = MeshChoice { file: std::path::absolute(&here.mesh.file).unwrap(), ..here.mesh };
        assert_eq!(format!("{:?}", Case { mesh, ..here }), format!("{again:?}"));
    }
}

#[test]
fn every_default_is_written_out() {
    let resolved = parse(&format!("{LEAST}{CONTACT}"), &[]).unwrap().resolved();
    for line in [
        "title = \"\"",
        "order = 2",
        "refine = 0",
        "body_force = [0.0, 0.0]",
        "gap = \"geometry\"",
        "multiplier = \"p1-discontinuous\"",
        "segments = \"auto\"",
        "law = \"unilateral\"",
        "quadrature = \"cut\"",
        "stabilise = \"auto\"",
        "configuration = \"reference\"",
        "name = \"auto\"",
        "tolerance = 0.00000001",
        "must_hold = false",
    ] {
        assert!(resolved.lines().any(|found| found == line), "{line} is not in\n{resolved}");
    }
}

#[test]
fn overrides_win_and_are_checked() {
    let case = parse(
        FULL,
        &[
            "body.lower.young=8e6",
            "contact.seam.segments=auto",
            "mesh.refine = 2",
            "body.\"upper.left\".poisson=0",
            "title=a = b",
            "contact.seam.gap=-1e-3",
            "probe.new.point=[0, 1]",
            "probe.new.body=lower",
            "load.top.pressure=2*x",
        ],
    )
    .unwrap();
    assert_eq!((case.bodies[0].parts[0].material.young, case.bodies[1].parts[0].material.poisson), (8e6, 0.0));
    assert_eq!((&case.contacts[0].segments, case.mesh.refine, case.title.as_str()), (&SegmentRule::Auto, 2, "a = b"));
    assert!(matches!(&case.contacts[0].gap, GapChoice::Formula(gap) if gap.as_constant() == Some(-1e-3)));
    assert_eq!(case.probes[1], Probe { name: "new".into(), point: [0.0, 1.0], body: "lower".into() });
    assert!(matches!(&case.loads[0].kind, LoadKind::Pressure(p) if p.text() == "2*x"));

    for (text, expected) in [
        ("mesh.refine=99", "mesh.refine = 99 (--set): must be a whole number from 0 to 12"),
        ("mesh.refin=1", "mesh.refin: unknown key; did you mean \"refine\"?"),
        ("refine", "--set refine: must be KEY=VALUE"),
        ("=1", "--set =1: must be KEY=VALUE"),
        ("a b=1", "--set a b=1: must be KEY=VALUE"),
        ("mesh.refine.x=1", "--set mesh.refine.x: mesh.refine is a value, not a table"),
    ] {
        let words = error_of(FULL, &[text]);
        assert!(words.starts_with(expected), "{text}: {words}");
    }
}

#[test]
fn a_bad_file_is_named() {
    let words = Case::read(Path::new("no/such.toml"), &[]).unwrap_err().to_string();
    assert!(words.starts_with("no/such.toml: cannot be read: "), "{words}");
    let words = error_of("mesh.file = 'a'\n[body.a\n", &[]);
    assert!(words.starts_with("line 2, column 8: "), "{words}");
    assert!(words.ends_with("the file is written in TOML, see toml.io"), "{words}");
}

#[test]
fn names_are_unique() {
    let words = error_of(&format!("{LEAST}[body.a]\nyoung = 2\n"), &[]);
    assert!(words.starts_with("line 5, column 7: duplicate key"), "{words}");
}

#[test]
fn the_file_names_the_case() {
    let name = |file: &str| Case::parse(LEAST, Path::new(file), &[]).unwrap().name;
    assert_eq!(name("cases/two_bars/case.toml"), "two_bars");
    assert_eq!(name("cases/two_bars/fine.toml"), "fine");
    let here = std::env::current_dir().unwrap();
    assert_eq!(name("case.toml"), here.file_name().unwrap().to_str().unwrap());
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

/// Key, value and remedy of one error each, from overrides of a case that is good.
#[test]
fn every_error_names_key_value_and_remedy() {
    let circle = "{centre = [0, 0], radius = 1}";
    let mut missed = Vec::new();
    for (overrides, expected) in [
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
        ("body.a.young=0", "body.a.young = 0 (--set): must lie in [1e-100, 1e100]"),
        ("body.a.young=inf", "must be a finite number"),
        ("body.a.young=soft", "body.a.young = \"soft\" (--set): must be a finite number, not of type string"),
        ("body.a.poisson=-1", "must lie in (-1, 0.5)"),
        (
            "body.a.body_force=[1]",
            "body.a.body_force = [1] (--set): must be a list of 2 numbers or formulas of x, y, not a list of length 1",
        ),
        ("body.a.body_force=['1', 't']", "entry 2: column 1: found `t`; allowed here: a number, x, y"),
        (
            "body.a.left.young=1",
            "body.a.left: unknown key; there are plane, part, young, poisson, body_force, density (a name that holds dots stands in quotes)",
        ),
        ("body.b=1", "body.b = 1 (--set): must be a table; write [body.b]"),
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
        ("support.s.normal=0", "cannot stand beside ux or uy"),
        ("support.r.on=left", "support.r: prescribes nothing; give ux, uy or normal"),
        ("support.s.ux=1/0", "support.s.ux = \"1/0\" (--set): is not finite"),
        ("support.s.ux=true", "must be a number or a formula of x, y, not of type boolean"),
        ("support.s.at=[0, 1]", "support.s.at = [0, 1] (--set): stands beside on; give physical curves or a point"),
        ("support.r={at=[0, 1], normal=0}", "support.r.normal = 0 (--set): stands beside at: a point has no normal"),
        ("support.r={at=[0, 1]}", "support.r: prescribes nothing; give ux, uy or normal"),
        ("support.r={at=[0], ux=0}", "support.r.at = [0] (--set): must be two numbers [x, y], not a list of length 1"),
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
        ("body.a.density=2", "body.a.density = 2 (--set): weighs nothing without gravity; write [gravity]"),
        ("gravity.g=[0, -9.81]", "gravity: acts on nothing; give density"),
        ("gravity={g=[0, 0]}", "gravity.g = [0, 0] (--set): must not be [0, 0]"),
        ("gravity=9.81", "gravity = 9.81 (--set): must be a table"),
        ("gravity={}", "gravity.g: missing; write g = [0.0, -9.81]"),
        ("gravity={g=[0, 1, 2]}", "gravity.g = [0, 1, 2] (--set): must be two numbers [x, y]"),
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
        ("contact.c.law=bonded", "must be \"unilateral\" or \"bilateral\"; there are"),
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
        ("solver.name=Direct", "must be \"auto\" or \"fieldsplit\" or \"direct\"; did you mean \"direct\"?"),
        ("solver.tolerance=0", "must lie in [1e-16, 0.01]"),
        ("solver.tolerance=0.02", "must lie in [1e-16, 0.01]"),
        ("solver.tolerance=fine", "must be a number like 1e-8, or \"discretisation\""),
        ("output.fields=no", "must be true or false, not of type string"),
        ("output.field=false", "unknown key; did you mean \"fields\"?"),
        ("probe.p.body=aa", "probe.p.body = \"aa\" (--set): no such body; did you mean \"a\"?"),
        ("probe.p.point=[0, nan]", "entry 2: must be a finite number"),
        ("exact.must_hold=1", "must be true or false, not of type integer"),
        ("exact.energy.value=0", "exact.energy.value = 0 (--set): must not be 0"),
        ("exact.energy=3", "exact.energy = 3 (--set): must be a table; write [exact.energy]"),
        ("exact.energy={value = 3}", "exact.energy.tolerance: missing; write tolerance = 1e-3"),
        ("exact.contact.d={}", "exact.contact.d: no such contact; did you mean \"c\"?"),
        ("exact.contact.c.lambda.at=[[0, 0], [0, 1]]", "exact.contact.c.lambda.value = [1]: holds 1 for 2 points in at"),
        ("exact.contact.c.lambda.formula=x", "stands beside at and value"),
        ("exact.body.b.u=[\"x\", 0]", "exact.body.b: no such body; did you mean \"a\"?"),
        ("exact.body.a.stress=[0, 0]", "must be a list of 3 numbers or formulas of x, y, not a list of length 2"),
        ("exact.energi=1", "exact.energi: unknown key; did you mean \"energy\"?"),
    ] {
        let words = parse(&good(), &[overrides]).map_or_else(|error| error.to_string(), |_| "accepted".into());
        if !words.contains(expected) || words.lines().count() != 1 {
            missed.push(format!("{overrides}: {words}\n  instead of {expected}"));
        }
    }
    assert!(missed.is_empty(), "{}", missed.join("\n"));
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
fn the_energy_of_a_force_at_a_point_cannot_be_asked_for() {
    for asked in ["accuracy=1e-3", "accuracy.energy=1e-3"] {
        let words = error_of(LEAST, &["load.k={at=[0, 1], force=[0, 1]}", asked]);
        assert!(words.contains("load.k acts at a point, where the energy is infinite"), "{words}");
    }
}

fn good() -> String {
    format!(
        "{LEAST}{CONTACT}
        [geometry.g]\ncurves = 'p'\nx = 't'\ny = 0\nt = [0, 1]
        [support.s]\non = 'left'\nux = 0
        [load.l]\non = 'top'\npressure = 1
        [probe.p]\npoint = [0, 0]\nbody = 'a'
        [exact.energy]\nvalue = 1\ntolerance = 0.1
        [exact.contact.c.lambda]\nat = [[0, 0]]\nvalue = [1]\ntolerance = 0.1\n"
    )
}

#[test]
fn a_pressure_may_be_known_by_formula() {
    let text = format!("{LEAST}{CONTACT}[exact.contact.c]\nlambda = {{ formula = 'sqrt(1 - x^2)', tolerance = 1e-2 }}\n");
    let case = parse(&text, &[]).unwrap();
    assert!(
        matches!(&case.exact.contacts[0].lambda, Some(LambdaExact::Formula { formula, tolerance: 1e-2 }) if formula.value(&[0.6, 0.0]) == 0.8)
    );
}

#[test]
fn long_values_are_cut() {
    let list = vec!["0.123456"; 100].join(", ");
    let words = error_of(LEAST, &[&format!("body.a.poisson=[{list}]")]);
    assert!(words.len() < 200 && words.contains(" ...") && words.contains("not a list of length 100"), "{words}");
}
