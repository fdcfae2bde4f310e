//! A case is read whole, with its defaults and overrides, and written out again.

use std::path::Path;

use super::*;
use crate::accuracy::ProbePoint;
use crate::body::{LoadKind, Material};
use crate::contact::{CurveChoice, GapChoice, Law, MultiplierSpace, Quadrature, SegmentRule};
use crate::element::Order;
use crate::geometry::Curve;
use crate::system::{SolverChoice, Tolerance};

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
pub(super) const LEAST: &str = "mesh.file = 'a.msh'\n[body.a]\nyoung = 1\npoisson = 0.3\n";
const CONTACT: &str = "[contact.c]\nbetween = ['p', 'q']\ncurve = 'line'\n";

pub(super) fn parse(text: &str, overrides: &[&str]) -> Result<Case, CaseError> {
    let overrides: Vec<String> = overrides.iter().map(ToString::to_string).collect();
    Case::parse(text, Path::new("bars/case.toml"), &overrides)
}

/// The only error of a case, without the name of the file.
pub(super) fn error_of(text: &str, overrides: &[&str]) -> String {
    let words = parse(text, overrides).map(|case| panic!("accepted: {case:?}")).unwrap_err().to_string();
    assert_eq!(words.lines().count(), 1, "{words}");
    words.strip_prefix("bars/case.toml: ").unwrap().to_owned()
}

#[test]
fn a_full_case_is_read() {
    let case = parse(FULL, &[]).unwrap();
    assert_eq!((case.name.as_str(), case.title.as_str()), ("bars", "Two bars"));
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
    assert_eq!(case.probes, [ProbePoint { name: "tip".into(), point: [1.0, 2.0].into(), body: "upper.left".into() }]);
    assert!(case.exact.must_hold);
    assert_eq!(case.exact.energy, Some(Expected { value: 2.6e-3, tolerance: 2e-5 }));
    assert!(matches!(&case.exact.contacts[0].lambda, Some(LambdaExact::Points(exact)) if exact.value == [0.925]));
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
        (format!("{LEAST}{CONTACT}"), vec!["contact.c.gap=-1e-3", "units.length=mm", "exact.energy={value=1, tolerance=0.1}"]),
    ] {
        let case = parse(&text, &overrides).unwrap();
        let resolved = case.resolved();
        let again = Case::parse(&resolved, Path::new("/elsewhere/bars/case.toml"), &[]).unwrap();
        assert!(again.mesh.file.is_absolute());
        assert_eq!(again.resolved(), resolved);
        let here = Case { file: again.file.clone(), table: again.table.clone(), ..case };
        let mesh = MeshChoice { file: std::path::absolute(&here.mesh.file).unwrap(), ..here.mesh };
        assert_eq!(format!("{:?}", Case { mesh, ..here }), format!("{again:?}"));
    }
}

#[test]
fn units_are_names_and_change_no_number() {
    let units = |settings: &[&str]| {
        let case = parse(&format!("{LEAST}{CONTACT}"), settings).unwrap();
        (case.units.length, case.units.force, case.thickness, case.has_thickness)
    };
    assert_eq!(units(&[]), (None, None, 1.0, false));
    let settings = ["units={length = 'mm'}", "units.force=kN", "thickness=2"];
    assert_eq!(units(&settings), (Some("mm".into()), Some("kN".into()), 2.0, true));
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
    assert_eq!(case.probes[1], ProbePoint { name: "new".into(), point: [0.0, 1.0].into(), body: "lower".into() });
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
fn a_tool_has_no_boundary_of_another_whose_name_goes_on() {
    let tools = "[rigid.die]\nline = [[0, 0], [1, 0], [1, 1]]\n[rigid.die2]\nline = [[3, 0], [4, 0]]\n";
    let contacts = "[contact.c]\nbetween = ['p', 'rigid.die.1']\n[contact.d]\nbetween = ['q', 'rigid.die2']\n";
    let case = parse(&format!("{LEAST}{tools}{contacts}"), &[]).unwrap();
    let tool = |boundary: &str| case.tool_of(boundary).map(|tool| (tool.key(), tool.parts_of(boundary).len()));
    assert_eq!((tool("rigid.die"), tool("rigid.die.2")), (Some(("rigid.die", 2)), Some(("rigid.die", 1))));
    assert_eq!((tool("rigid.die2"), tool("rigid.die2.1")), (Some(("rigid.die2", 1)), None));
    assert_eq!([tool("rigid.die.0"), tool("rigid.die.3"), tool("rigid.di")], [None; 3]);
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
fn a_pressure_may_be_known_by_formula() {
    let text = format!("{LEAST}{CONTACT}[exact.contact.c]\nlambda = {{ formula = 'sqrt(1 - x^2)', tolerance = 1e-2 }}\n");
    let case = parse(&text, &[]).unwrap();
    assert!(
        matches!(&case.exact.contacts[0].lambda, Some(LambdaExact::Formula { formula, tolerance: 1e-2 }) if formula.value(&[0.6, 0.0]) == 0.8)
    );
}

/// A case that is good, with one of most things.
pub(super) fn good() -> String {
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
