//! Whether bodies are held, hang together, face each other, and are strained a little only: what is refused, in which words,
//! and right scenes of the same kind that must pass.

use crate::support::mesh::{Block, GOOD, Mesh, grid, write_scene};
use crate::support::{Run, mezha, numbers, ranks_in_turn};
use std::f64::consts::PI;
use std::path::Path;

/// `mezha check` on a scene: exit code, and standard error.
fn checked(mesh: &Mesh, case: &str, settings: &[&str]) -> (Option<i32>, String) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = write_scene(folder.path(), &mesh.text(), case);
    let mut words = vec!["check".to_string(), file.display().to_string()];
    settings.iter().for_each(|setting| words.extend(["--set".to_string(), setting.to_string()]));
    let (code, _, errors) = mezha(None, &words);
    (code, errors)
}

fn loose(mesh: &Mesh, case: &str, settings: &[&str], words: &[&str]) {
    let (code, errors) = checked(mesh, case, settings);
    assert_eq!(code, Some(3), "{settings:?}: {errors}");
    words.iter().for_each(|word| assert!(errors.contains(word), "{settings:?}: no `{word}` in {errors}"));
}

fn refused(mesh: &Mesh, case: &str, settings: &[&str], words: &[&str]) {
    let (code, errors) = checked(mesh, case, settings);
    assert_eq!(code, Some(2), "{settings:?}: {errors}");
    words.iter().for_each(|word| assert!(errors.contains(word), "{settings:?}: no `{word}` in {errors}"));
}

fn right(mesh: &Mesh, case: &str, settings: &[&str]) {
    let (code, errors) = checked(mesh, case, settings);
    assert_eq!(code, Some(0), "{settings:?}: {errors}");
}

/// A block over `[x0, x1] × [y0, y1]`.
fn block([x0, x1]: [f64; 2], [y0, y1]: [f64; 2], cells: [usize; 2], seed: u64) -> Block {
    grid(cells[0], cells[1], seed, |u, v| [x0 + u * (x1 - x0), y0 + v * (y1 - y0)])
}

/// A ring around (0, 1) with the radii .5 and 1, slit on its right: it rolls like a disc. Its sides are the lower half of its
/// rim, the slit, the upper half, and the bore.
fn ring(edges: usize) -> Block {
    let mut ring = grid(edges, 3, 5, move |u, v| {
        let (angle, radius) = (2.0 * PI * (0.001 + 0.998 * u), 0.5 + 0.5 * v);
        [radius * angle.cos(), 1.0 + radius * angle.sin()]
    });
    let [bore, end, rim, start] = ring.sides;
    let height = |edge: &[usize; 2]| ring.points[edge[0]][1] + ring.points[edge[1]][1];
    let (low, high) = rim.into_iter().partition(|edge| height(edge) < 2.0);
    ring.sides = [low, [end, start].concat(), high, bore];
    ring
}

/// A ring between two plates, scaled.
fn between_plates(edges: usize, scale: f64) -> Mesh {
    let base = block([-1.5, 1.5], [-1.0, 0.0], [22, 4], 1);
    let plate = block([-1.5, 1.5], [2.0, 2.5], [20, 3], 2);
    let bodies = vec![
        ("base", base, ["bottom", "", "base.top", ""]),
        ("plate", plate, ["plate.bottom", "wall", "top", "wall"]),
        ("ring", ring(edges), ["rim.low", "slit", "rim.high", "bore"]),
    ];
    Mesh { bodies }.map(|[x, y]| [scale * x, scale * y])
}

const ROLLING: &str = r#"
mesh.file = "mesh.msh"
body.base = { young = 1000.0, poisson = 0.3 }
body.plate = { young = 1000.0, poisson = 0.3 }
body.ring = { young = 1000.0, poisson = 0.3 }
support.table = { on = "bottom", ux = 0.0, uy = 0.0 }
support.wall = { on = "wall", ux = 0.0 }
load.top = { on = "top", pressure = 0.1 }
contact.low = { between = ["base.top", "rim.low"] }
contact.high = { between = ["rim.high", "plate.bottom"] }
"#;

#[test]
fn a_ring_that_rolls_is_found_on_polygons_and_on_circles() {
    let circle = "geometry.rim.circle={ centre = [0, 1], radius = 1 }";
    let held = "support.slit={ on = \"slit\", ux = 0.0, uy = 0.0 }";
    let hold = "hold its mean, for example by a support with mean = true, body = \"ring\" and angle = 0.0";
    let words = ["body ring can turn about (0, 1)", hold];
    for edges in [24, 61] {
        let mesh = between_plates(edges, 1.0);
        for refine in ["mesh.refine=0", "mesh.refine=2"] {
            loose(&mesh, ROLLING, &[refine], &words);
            loose(&mesh, ROLLING, &[refine, "mesh.order=1", circle, "geometry.rim.curves=[\"rim.low\", \"rim.high\"]"], &words);
            right(&mesh, ROLLING, &[refine, held]);
        }
    }
    loose(&between_plates(40, 1.0), ROLLING, &["contact.low.configuration=deformed"], &words);
    for (scale, centre) in [(1e-3, "(0, 0.001)"), (1e6, "(0, 1000000)")] {
        loose(&between_plates(40, scale), ROLLING, &[], &["ring can turn about", centre]);
        right(&between_plates(40, scale), ROLLING, &[held]);
    }
}

/// What is proposed is pasted: the turn is held, then the shift, and then nothing is free.
#[test]
fn the_holds_that_are_proposed_hold() {
    let mesh = between_plates(40, 1.0);
    let turn = "support.hold={ mean = true, body = \"ring\", angle = 0.0 }";
    loose(&mesh, ROLLING, &[turn], &["body ring can move by (1, 0)", "hold it by ux = 0.0 in support.hold, too"]);
    right(&mesh, ROLLING, &[&turn.replace("angle", "ux = 0.0, angle")]);
    // A point holds what loads drive.
    let driven = "load.ring={ on = \"bore\", traction = [1.0, 0.0] }";
    loose(&mesh, ROLLING, &[turn, driven], &["body ring can move by (1, 0)", "hold it, for example by a support with at = ["]);
}

/// The programme of a coarse mesh, which a run begins with, is asked before it: loads that are turned round are found, on fine
/// meshes too, in the load step that has them, and not where another contact stops the body.
#[test]
fn loads_that_drive_a_body_off_its_contacts_are_told_by_check() {
    let mesh = crate::support::mesh::two_blocks([(3, 2, 1), (4, 2, 2)]);
    let words = ["body upper can move by (0, 1): load.top drives it there", "turn the load round"];
    for refine in ["mesh.refine=0", "mesh.refine=2", "mesh.refine=7"] {
        loose(&mesh, GOOD, &[refine, "load.top.pressure=-1.0"], &words);
        right(&mesh, GOOD, &[refine]);
    }
    // The way is that of the load.
    let below = ["support.table={ on = \"top\", uy = 0.0 }", "load.top={ on = \"bottom\", pressure = -1.0 }"];
    loose(&mesh, GOOD, &below, &["body lower can move by (0, -1): load.top drives it there"]);
    let both = "load.edge={ on = \"right\", traction = [0.0, 3.0] }";
    loose(&mesh, GOOD, &["load.top.pressure=-1.0", both], &["body upper can move by (0, 1): load.top, load.edge drive it there"]);
    let steps = |factors: &str| format!("steps.p={{ factors = {factors}, scales = [\"load.top\"] }}");
    loose(&mesh, GOOD, &[&steps("[1, -1, -2]")], &["mezha: step 2 of 3 (p = -1): body upper can move"]);
    loose(&mesh, GOOD, &[&steps("[0, 1, -2]")], &["mezha: step 3 of 3 (p = -2): body upper can move"]);
    right(&mesh, GOOD, &[&steps("[0, 1, 2]")]);
    // A stop above it, with clearance.
    let stop = ["rigid.stop={ line = [[-0.5, 2.1], [2.5, 2.1]] }", "contact.stop={ between = [\"top\", \"rigid.stop\"] }"];
    right(&mesh, GOOD, &[stop[0], stop[1], "body.upper.body_force=[0.0, 1.0]", "load.top.pressure=0.0"]);
}

/// A tool with clearance around a block, which it is driven against: it cannot fall away, though no set that presses may be found.
#[test]
fn what_contact_would_stop_is_not_said_to_be_free() {
    const CASE: &str = r#"
mesh = { file = "mesh.msh", refine = 2 }
body.block = { young = 1000.0, poisson = 0.3 }
support.foot = { on = "foot", ux = 0.0, uy = 0.0 }
rigid.cap = { line = [[-0.05, 0.2], [-0.05, 1.05], [2.05, 1.05], [2.05, 0.2]], force = [2.0, -3.0], moment = 0.0 }
contact.left = { between = ["left", "rigid.cap.1"] }
contact.top = { between = ["top", "rigid.cap.2"] }
contact.right = { between = ["right", "rigid.cap.3"] }
"#;
    let mesh = Mesh { bodies: vec![("block", block([0.0, 2.0], [0.0, 1.0], [6, 3], 1), ["foot", "right", "top", "left"])] };
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = write_scene(folder.path(), &mesh.text(), CASE);
    let ended = Run::file(&file).ended();
    let reason = ended.value("/reason").to_string();
    assert!(!reason.contains("do not hold it"), "{}", ended.said());
    assert!(ended.code == Some(0) || reason.contains("which would hold it"), "{}", ended.said());
    // Away from it nothing stops it.
    let ended = Run::file(&file).set("rigid.cap.force", "[0.0, 3.0]").ended();
    let reason = ended.value("/reason").to_string();
    assert!(ended.code == Some(3) && reason.contains("rigid.cap can move by"), "{}", ended.said());
    assert!(!reason.contains("would hold it"), "{}", ended.said());
}

/// In a smooth round hole, a support along the normal, a ring turns, although the normals of its unequal edges do not meet in
/// the centre.
#[test]
fn a_ring_on_normal_supports_turns() {
    let uneven = |u: f64| u + 0.02 * (7.0 * u).sin() * (1.0 - u);
    let mut ring = ring(48);
    for x in &mut ring.points {
        let [dx, dy] = [x[0], x[1] - 1.0];
        let (radius, angle) = (dx.hypot(dy), dy.atan2(dx).rem_euclid(2.0 * PI));
        let angle = 2.0 * PI * uneven(angle / (2.0 * PI));
        *x = [radius * angle.cos(), 1.0 + radius * angle.sin()];
    }
    let mesh = Mesh { bodies: vec![("ring", ring, ["rim.low", "slit", "rim.high", "bore"])] };
    let case = "mesh = { file = \"mesh.msh\", refine = 1 }\nbody.ring = { young = 1.0, poisson = 0.3 }\n\
                support.hole = { on = [\"rim.low\", \"rim.high\"], normal = 0.0 }";
    loose(&mesh, case, &[], &["body ring can turn about (0, 1)"]);
    right(&mesh, case, &["support.slit={ on = \"slit\", uy = 0.0 }"]);
}

/// The same before a run, on any number of ranks, with a summary that says so.
#[test]
fn a_run_tells_what_rolls_before_it_solves() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = write_scene(folder.path(), &between_plates(40, 1.0).text(), ROLLING);
    for ranks in ranks_in_turn(0) {
        let ended = Run::file(&file).ranks(ranks).ended();
        assert_eq!(ended.code, Some(3), "{}", ended.said());
        assert!(ended.value("/reason").as_str().expect("words").contains("body ring can turn about (0, 1)"));
    }
}

const SEAT: &str = r#"
mesh.file = "mesh.msh"
body.lower = { young = 7000.0, poisson = 0.227 }
body.upper = { young = 3000.0, poisson = 0.3 }
support.table = { on = "bottom", ux = 0.0, uy = 0.0 }
contact.seam = { between = ["lower.seam", "upper.seam"] }
"#;

/// Sides of the lower and of the upper body.
const SIDES: [[&str; 4]; 2] = [["bottom", "side", "lower.seam", "side"], ["upper.seam", "upper.side", "top", "upper.side"]];

fn pair(lower: Block, upper: Block) -> Mesh {
    Mesh { bodies: vec![("lower", lower, SIDES[0]), ("upper", upper, SIDES[1])] }
}

/// A bar a hundred times longer than its seat, which alone keeps it from tipping; a seat of one edge; a wedge of slope 1:50; a
/// groove of 5 degrees; a part of a ring that is held on 2 degrees of its arc.
#[test]
fn bodies_that_are_held_weakly_are_held() {
    let pinned = ["support.pin.on=\"upper.seam\"", "support.pin.ux=0.0", "contact.seam.curve=line", "contact.seam.gap=closed"];
    let base = || block([0.0, 1.0], [0.0, 1.0], [2, 2], 1);
    let bar = pair(base(), block([0.0, 100.0], [1.0, 2.0], [100, 1], 2));
    right(&bar, SEAT, &pinned);
    loose(&bar, SEAT, &pinned[2..], &["body upper can move by (1, 0)", "ux = 0"]);
    right(&pair(block([0.0, 0.01], [0.0, 1.0], [1, 2], 1), block([0.0, 2.0], [1.0, 2.0], [4, 2], 2)), SEAT, &pinned);

    let slope = |x: f64| 1.0 + 0.02 * x;
    let lower = grid(6, 3, 1, |u, v| [3.0 * u, v * slope(3.0 * u)]);
    let upper = grid(4, 3, 2, |u, v| [0.5 + 2.0 * u, slope(0.5 + 2.0 * u) + v]);
    let wedge = pair(lower, upper);
    let on_slope = ["contact.seam.curve=line", "contact.seam.gap=closed"];
    loose(&wedge, SEAT, &on_slope, &["body upper can move by (1, 0.02)"]);
    right(&wedge, SEAT, &[on_slope[0], on_slope[1], "support.roof.on=\"top\"", "support.roof.uy=0.0"]);

    let groove = |x: f64| 1.0 + x.abs() * 5f64.to_radians().tan();
    let lower = grid(12, 3, 1, |u, v| [4.0 * u - 2.0, v * groove(4.0 * u - 2.0)]);
    let upper = grid(10, 3, 2, |u, v| [3.0 * u - 1.5, groove(3.0 * u - 1.5) * (1.0 - v) + 3.0 * v]);
    // The spline through the corner of the groove reaches into the body above, and without a load would push it off.
    right(&pair(lower, upper), SEAT, &["load.top.on=\"top\"", "load.top.pressure=1.0"]);

    let arc = |angle: f64, radius: f64| [radius * angle.sin(), 1.0 - radius * angle.cos()];
    let angle = |u: f64| (2.0 * u - 1.0) * PI / 180.0;
    let lower = grid(3, 3, 1, |u, v| arc(angle(u), 1.5 - 0.5 * v));
    let upper = grid(4, 8, 2, |u, v| arc(angle(u), 1.0 - 0.8 * v));
    let sector = pair(lower, upper);
    let on_arc = [
        "geometry.seam.curves=[\"lower.seam\", \"upper.seam\"]",
        "geometry.seam.circle={ centre = [0, 1], radius = 1 }",
        "contact.seam.curve=geometry",
        "contact.seam.gap=closed",
    ];
    loose(&sector, SEAT, &on_arc, &["body upper can turn about (0, 1)"]);
    right(&sector, SEAT, &[&on_arc[..], &["support.end.on=\"top\"", "support.end.ux=0.0"]].concat());
}

/// Adds another part to a block, with its own points but those that it shares: `(its point, the block's)`.
fn joined(mut block: Block, part: Block, shared: &[(usize, usize)]) -> Block {
    let mut new = vec![0; part.points.len()];
    for (point, place) in part.points.iter().enumerate() {
        new[point] = match shared.iter().find(|(own, _)| *own == point) {
            Some((_, there)) => *there,
            None => {
                block.points.push(*place);
                block.points.len() - 1
            }
        };
    }
    block.triangles.extend(part.triangles.iter().map(|t| t.map(|corner| new[corner])));
    for (side, more) in block.sides.iter_mut().zip(&part.sides) {
        side.extend(more.iter().map(|edge| edge.map(|end| new[end])));
    }
    block
}

/// The good scene with another part of the upper body, from (3, 1) on, or turned and moved.
fn with_part(x: f64, y: f64, shared: &[(usize, usize)]) -> Mesh {
    let upper = block([0.0, 2.0], [1.0, 2.0], [3, 2], 2);
    let part = block([x, x + 1.0], [y, y + 1.0], [2, 2], 3);
    let bodies = vec![
        ("lower", block([0.0, 5.0], [0.0, 1.0], [5, 2], 1), ["bottom", "right", "lower.seam", "left"]),
        ("upper", joined(upper, part, shared), ["upper.seam", "right", "top", "left"]),
    ];
    Mesh { bodies }
}

#[test]
fn a_piece_that_nothing_holds_is_named() {
    let mut mesh = with_part(3.0, 1.5, &[]);
    // The part's own lower side becomes its foot; it shares its left wall with the other.
    let upper = &mut mesh.bodies[1];
    upper.1.sides[1] = upper.1.sides[0].split_off(3);
    upper.2 = ["upper.seam", "foot", "top", "left"];
    let words =
        ["the piece of body upper around (3.", "shares no edge with the rest of the body", "can move by (0, 1)", "uy = 0"];
    loose(&mesh, GOOD, &[], &words);
    right(&mesh, GOOD, &["support.foot={ on = \"foot\", uy = 0.0 }"]);
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = write_scene(folder.path(), &mesh.text(), GOOD);
    for ranks in ranks_in_turn(1) {
        let ended = Run::file(&file).ranks(ranks).ended();
        assert_eq!(ended.code, Some(3), "{}", ended.said());
        assert!(ended.value("/reason").as_str().expect("words").contains(words[0]), "{}", ended.said());
    }
}

#[test]
fn pieces_on_one_node_and_overlaps_are_errors_of_the_mesh() {
    // Point 11 of the upper block is its corner (2, 2), point 0 of the part its own lower left one.
    refused(&with_part(2.0, 2.0, &[(0, 11)]), GOOD, &[], &["mesh.msh", "hang together by nothing but the node at (2, 2)"]);
    refused(&with_part(1.5, 1.5, &[]), GOOD, &[], &["mesh.msh", "triangles of body \"upper\" overlap near"]);
    refused(&with_part(0.0, 1.0, &[]), GOOD, &[], &["triangles of body \"upper\" overlap near"]);
    let mut twice = with_part(3.0, 1.0, &[]);
    let first = twice.bodies[1].1.triangles[0];
    twice.bodies[1].1.triangles.push(first);
    refused(&twice, GOOD, &[], &["overlaps a triangle before it"]);
}

fn two_blocks(lift: f64) -> Mesh {
    let bodies = vec![
        ("lower", block([0.0, 2.0], [0.0, 1.0], [5, 2], 1), ["bottom", "right", "lower.seam", "left"]),
        ("upper", block([0.0, 2.0], [1.0 + lift, 2.0 + lift], [6, 3], 2), ["upper.seam", "right", "top", "left"]),
    ];
    Mesh { bodies }
}

#[test]
fn boundaries_that_do_not_face_each_other_are_refused() {
    let mesh = two_blocks(0.0);
    for between in ["[\"lower.seam\", \"top\"]", "[\"bottom\", \"upper.seam\"]", "[\"bottom\", \"top\"]"] {
        let between = format!("contact.seam.between={between}");
        for gap in ["closed", "geometry", "-0.01", "\"0.01*x\""] {
            refused(&mesh, GOOD, &[&between, &format!("contact.seam.gap={gap}")], &["contact.seam", "do not face each other"]);
        }
    }
    // Thin plates of long edges too.
    let bodies = vec![
        ("lower", block([0.0, 2.0], [0.0, 0.02], [5, 1], 1), ["bottom", "right", "lower.seam", "left"]),
        ("upper", block([0.0, 2.0], [0.02, 0.04], [6, 1], 2), ["upper.seam", "right", "top", "left"]),
    ];
    let between = "contact.seam.between=[\"bottom\", \"top\"]";
    refused(&Mesh { bodies }, GOOD, &[between], &["contact.seam", "do not face each other"]);
    // What touches by declaration is drawn so, but for what polygons lie apart; other gaps may be drawn as one likes.
    refused(&two_blocks(0.5), GOOD, &[], &["gap = \"closed\"", "5.000e-1 apart"]);
    refused(&two_blocks(-0.5), GOOD, &[], &["gap = \"closed\"", "5.000e-1 into each other"]);
    for lift in [0.01, -0.01] {
        right(&two_blocks(lift), GOOD, &[]);
    }
    for (lift, gap) in [(0.5, "-0.001"), (0.5, "geometry"), (-0.05, "geometry"), (-0.5, "0.0"), (0.0, "\"-0.2*x\"")] {
        right(&two_blocks(lift), GOOD, &[&format!("contact.seam.gap={gap}")]);
    }
}

#[test]
fn one_place_bears_one_contact() {
    let words = ["contact.twice", "\"lower.seam\" is in contact.seam too"];
    for curve in ["line", "fit"] {
        let (more, line) = (format!("contact.twice.curve={curve}"), format!("contact.seam.curve={curve}"));
        for between in ["[\"lower.seam\", \"upper.seam\"]", "[\"upper.seam\", \"lower.seam\"]"] {
            let between = format!("contact.twice.between={between}");
            refused(&two_blocks(0.0), GOOD, &[&between, &more, &line], &["contact.twice"]);
        }
    }
    let two = |x: f64| {
        let bodies = vec![
            ("lower", block([0.0, 4.0], [0.0, 1.0], [9, 2], 1), ["bottom", "right", "lower.seam", "left"]),
            ("upper", block([0.0, 2.0], [1.0, 2.0], [5, 2], 2), ["upper.seam", "right", "top", "left"]),
            ("third", block([x, x + 2.0], [1.0, 2.0], [4, 2], 3), ["third.seam", "right", "top", "wall"]),
        ];
        Mesh { bodies }
    };
    let third = ["body.third={ young = 1000.0, poisson = 0.3 }", "support.third={ on = \"wall\", ux = 0.0 }"];
    let line = "contact.twice={ between = [\"lower.seam\", \"third.seam\"], curve = \"line\", gap = \"closed\" }";
    let fit = "contact.twice={ between = [\"lower.seam\", \"third.seam\"] }";
    refused(&two(0.5), GOOD, &[third[0], third[1], line], &words);
    for x in [2.0, 2.3] {
        right(&two(x), GOOD, &[third[0], third[1], line]);
        right(&two(x), GOOD, &[third[0], third[1], fit, "contact.seam.curve=fit"]);
    }
}

#[test]
fn large_strain_is_told_and_not_trusted() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = write_scene(folder.path(), &two_blocks(0.0).text(), GOOD);
    for (pressure, warned, trust) in [(1.0, false, true), (300.0, true, true), (3e6, true, false)] {
        for refine in [0, 2] {
            let run = Run::file(&file).ranks(2).set("load.top.pressure", pressure).set("mesh.refine", refine);
            let ended = run.set("output.fields", false).converged();
            let strain = ended.number("/strain_max/upper");
            // Uniform: p (1 - ν²)/E with free sides.
            let exact = pressure * (1.0 - 0.3 * 0.3) / 3000.0;
            assert!((strain / exact - 1.0).abs() < 0.2, "{strain} for {exact}");
            assert_eq!(ended.errors.contains("body upper is strained by"), warned, "{}", ended.said());
            assert!(trust || ended.value("/contact/seam/trust") == false, "{}", ended.said());
        }
    }
}

/// The scenes of the project are held, and face each other.
#[test]
fn the_cases_of_the_project_pass() {
    let cases = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases");
    for name in ["bars_parabola", "hertz", "hertz_discs", "open_zone", "pin", "punch", "receding_layer", "rings", "stack_16"] {
        let file = cases.join(name).join("case.toml").display().to_string();
        let (code, _, errors) = mezha(None, &["check", file.as_str()]);
        assert_eq!(code, Some(0), "{name}: {errors}");
    }
}

/// A roller at the bottom of a seat that is a little wider, drawn by a force 50 degrees off the vertical: it comes to rest where the
/// normal has that direction, and contact carries the whole force.
#[test]
fn a_roller_that_climbs_its_seat_is_held_there() {
    const CASE: &str = r#"
mesh.file = "mesh.msh"
body.seat = { young = 2e5, poisson = 0.3 }
body.roller = { young = 2e5, poisson = 0.3, body_force = [76.604444312, -64.278760969] }
support.around = { on = "around", ux = 0.0, uy = 0.0 }
support.upright = { body = "roller", mean = true, angle = 0.0 }
contact.seam = { between = ["seat.arc", "roller.arc"] }
accuracy = { force = 1e-2 }
"#;
    let arc = |degrees: f64, radius: f64, height: f64| {
        let angle = degrees.to_radians();
        [radius * angle.sin(), height - radius * angle.cos()]
    };
    let seat = grid(24, 6, 1, |u, v| arc(120.0 * u - 60.0, 1.62 - 0.6 * v, 1.02));
    let roller = grid(34, 8, 2, |u, v| arc(150.0 * u - 75.0, 1.0 - 0.7 * v, 1.0));
    let area = 0.5 * 150f64.to_radians() * (1.0 - 0.3 * 0.3);
    let mesh =
        Mesh { bodies: vec![("seat", seat, ["around", "", "seat.arc", ""]), ("roller", roller, ["roller.arc", "", "", ""])] };
    let folder = tempfile::tempdir().expect("a folder");
    let file = write_scene(folder.path(), &mesh.text(), CASE);
    for ranks in [1, 2] {
        let ended = Run::file(&file).ranks(ranks).converged();
        let [x, y] = numbers(&ended, "/contact/seam/resultant");
        // The arc of the mesh is a polygon, of a thousandth less area.
        assert!((x.hypot(y) / (100.0 * area) - 1.0).abs() < 2e-3, "{x} {y}: {}", ended.said());
        assert!(((x / y).abs() / 50f64.to_radians().tan() - 1.0).abs() < 1e-6, "{x} {y}: {}", ended.said());
    }
}

/// The round side of a nose ends just behind its lowest point, where its curve goes on straight: there it has no edge to lie on.
#[test]
fn a_nose_lies_on_a_table_though_its_side_ends_beside_the_place_that_touches() {
    let nose = |u: f64, v: f64| {
        let angle = (90.0 * u - 96.0).to_radians();
        let seat = [0.3 * angle.cos(), 0.3 + 0.3 * angle.sin()];
        [(1.0 - v) * seat[0] + v * (0.9 * u - 0.6), (1.0 - v) * seat[1] + v * 1.2]
    };
    let mesh = Mesh { bodies: vec![("nose", grid(3, 3, 0, nose), ["seat", "", "top", ""])] };
    let case = r#"
mesh = { file = "mesh.msh" }
body.nose = { young = 1000.0, poisson = 0.3 }
geometry.seat = { curves = ["seat"], circle = { centre = [0.0, 0.3], radius = 0.3 } }
rigid.table = { line = [[-3.0, -0.0005], [2.0, -0.0005]] }
contact.seat = { between = ["seat", "rigid.table"] }
support.upright = { body = "nose", mean = true, ux = 0.0, angle = 0.0 }
load.top = { on = "top", pressure = 0.1 }
"#;
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = write_scene(folder.path(), &mesh.text(), case);
    for refine in [0, 1, 2] {
        let ended = Run::file(&file).set("mesh.refine", refine).ranks(1 + refine).ended();
        assert_eq!(ended.value("/status"), "unresolved", "{}", ended.said());
        assert!((ended.number("/contact/seat/force") - 0.09).abs() < 1e-6, "{}", ended.said());
    }
}

/// Two rings that lie in each other, with clearance around a third: both together are free, and nothing drives them. The turn of each
/// is held.
#[test]
fn bodies_that_are_free_together_within_a_clearance_are_told() {
    let mesh = crate::support::mesh::Mesh {
        bodies: vec![
            ("hub", whole_ring([1.0, 2.0], 24), ["hub.in", "", "hub.out", ""]),
            ("inner", whole_ring([2.0, 3.0], 32), ["inner.in", "", "inner.out", ""]),
            ("outer", whole_ring([3.0, 4.0], 40), ["outer.in", "", "outer.out", ""]),
        ],
    };
    let case = r#"
mesh.file = "mesh.msh"
body.hub = { young = 2e5, poisson = 0.3 }
body.inner = { young = 7e4, poisson = 0.3 }
body.outer = { young = 2e5, poisson = 0.3 }
geometry.first = { curves = ["hub.out", "inner.in"], circle = { centre = [0, 0], radius = 2 } }
geometry.second = { curves = ["inner.out", "outer.in"], circle = { centre = [0, 0], radius = 3 } }
contact.first = { between = ["hub.out", "inner.in"], gap = 0.01 }
contact.second = { between = ["inner.out", "outer.in"], gap = 0.0 }
support.hub = { body = "hub", mean = true, ux = 0.0, uy = 0.0, angle = 0.0 }
support.inner = { body = "inner", mean = true, angle = 0.0 }
support.outer = { body = "outer", mean = true, angle = 0.0 }
load.bore = { on = "hub.in", pressure = 100.0 }
"#;
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = write_scene(folder.path(), &mesh.text(), case);
    for ranks in ranks_in_turn(0) {
        let ended = Run::file(&file).ranks(ranks).ended();
        assert_eq!(ended.code, Some(3), "{}", ended.said());
        assert!(ended.said().contains("no load of its own drives that: hold it by u"), "{}", ended.said());
    }
    let held = Run::file(&file).set("support.inner.ux", 0.0).set("support.inner.uy", 0.0).converged();
    assert!(held.said().contains("nothing presses on contact first"), "{}", held.said());
}

/// A ring pressed between two plates, with clearance to a wall on either side: it may lie anywhere between them, which is said, with the
/// hold that does. A wall was closed, and pulled.
#[test]
fn a_ring_between_walls_that_it_never_reaches_is_told_to_be_free() {
    let plate = |y: [f64; 2], seed: u64| block([-1.5, 1.5], y, [22, 4], seed);
    let wall = |x: [f64; 2], seed: u64| block(x, [-0.9, 0.9], [2, 14], seed);
    let mesh = Mesh {
        bodies: vec![
            ("base", plate([-2.0, -1.0], 1), ["base.low", "", "base.face", ""]),
            ("lid", plate([1.0, 1.5], 2), ["lid.face", "", "lid.high", ""]),
            ("left", wall([-1.45, -1.05], 3), ["", "left.face", "", "wall"]),
            ("right", wall([1.05, 1.45], 4), ["", "wall", "", "right.face"]),
            ("ring", whole_ring([0.5, 1.0], 60), ["bore", "", "rim", ""]),
        ],
    };
    let case = r#"
mesh = { file = "mesh.msh", order = 2, refine = 1 }
body."*" = { young = 1000.0, poisson = 0.3 }
geometry.rim = { curves = "rim", circle = { centre = [0, 0], radius = 1 } }
contact.rim = { between = ["*.face", "rim"] }
support.base = { on = ["base.low", "wall"], ux = 0.0, uy = 0.0 }
support.lid = { on = "lid.high", ux = 0.0, uy = -0.02 }
support.hold = { body = "ring", mean = true, angle = 0.0 }
output.fields = false
"#;
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = write_scene(folder.path(), &mesh.text(), case);
    for ranks in ranks_in_turn(1) {
        let ended = Run::file(&file).ranks(ranks).ended();
        assert_eq!(ended.code, Some(3), "{}", ended.said());
        assert!(ended.said().contains("hold it by ux = 0.0 in support.hold, too"), "{}", ended.said());
    }
    Run::file(&file).set("support.hold.ux", 0.0).converged();
}

/// A ring on a hub, drawn in it and held in its turn alone: where heat opens the joint the ring is held by rounding. It is told what holds
/// it, on one mesh and where meshes are to adapt; where heat closes a clearance, contact holds it.
#[test]
fn a_ring_that_heat_loosens_is_to_be_held() {
    let mesh = Mesh {
        bodies: vec![
            ("hub", whole_ring([4.0, 6.0], 40), ["hub.in", "", "hub.out", ""]),
            ("ring", whole_ring([6.0, 9.0], 30), ["ring.in", "", "ring.out", ""]),
        ],
    };
    let case = r#"
mesh.file = "mesh.msh"
body.hub = { young = 2.1e5, poisson = 0.3, expansion = 1.2e-5, temperature = -60.0 }
body.ring = { young = 7e4, poisson = 0.33, expansion = 2.3e-5, temperature = 20.0 }
geometry.joint = { curves = ["hub.out", "ring.in"], circle = { centre = [0, 0], radius = 6 } }
contact.joint = { between = ["hub.out", "ring.in"], gap = -0.004 }
support.hub = { body = "hub", mean = true, ux = 0.0, uy = 0.0, angle = 0.0 }
support.ring = { body = "ring", mean = true, angle = 0.0 }
load.rim = { on = "ring.out", pressure = 15.0 }
"#;
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = write_scene(folder.path(), &mesh.text(), case);
    let run = |key: &str, value: &str, ranks: usize| Run::file(&file).set(key, value).ranks(ranks);
    for (key, value, ranks) in [("mesh.refine", "0", 1), ("mesh.refine", "2", 2), ("accuracy.energy", "0.01", 2)] {
        let ended = run(key, value, ranks).ended();
        assert_eq!(ended.code, Some(3), "{key}: {}", ended.said());
        assert!(ended.said().contains("hold it by ux = 0.0 and uy = 0.0 in support.ring, too"), "{key}: {}", ended.said());
        let held = run(key, value, ranks).set("support.ring.ux", 0.0).set("support.ring.uy", 0.0).converged();
        assert!(held.said().contains("nothing presses on contact joint"), "{key}: {}", held.said());
    }
    let hot = run("mesh.refine", "1", 2).set("contact.joint.gap", 0.004).set("body.hub.temperature", 90.0).converged();
    assert!(hot.number("/contact/joint/force") > 0.0);
}

/// A ring around the origin; its sides are the bore and the rim.
fn whole_ring([inner, outer]: [f64; 2], edges: usize) -> Block {
    let mut ring = grid(edges, 3, 7, |u, v| {
        let (angle, radius) = (-2.0 * PI * u, inner + v * (outer - inner));
        [radius * angle.cos(), radius * angle.sin()]
    });
    // The last column is the first one.
    let first = |node: usize| if node % (edges + 1) == edges { node - edges } else { node };
    ring.triangles.iter_mut().flatten().for_each(|node| *node = first(*node));
    ring.sides.iter_mut().flatten().flatten().for_each(|node| *node = first(*node));
    let used = |node: &usize| node % (edges + 1) < edges;
    let kept: Vec<usize> = (0..ring.points.len()).filter(used).collect();
    let number = |node: usize| node - node / (edges + 1);
    ring.points = kept.iter().map(|&node| ring.points[node]).collect();
    ring.triangles.iter_mut().flatten().for_each(|node| *node = number(*node));
    ring.sides.iter_mut().flatten().flatten().for_each(|node| *node = number(*node));
    ring
}

/// A block in a rigid box with clearance, on a mesh of which the programme would be dear: of two walls that are equally far it comes
/// to lie at the one that its load drives it to. The other one was closed, and pulled for ever.
#[test]
fn a_body_comes_to_the_wall_that_its_load_drives_it_to() {
    let mesh = Mesh { bodies: vec![("b", block([-5.0, 5.0], [0.0, 8.0], [80, 64], 3), ["bot", "r", "top", "l"])] };
    let case = r#"
mesh = { file = "mesh.msh", order = 2 }
body.b = { young = 2.1e5, poisson = 0.3 }
load.p = { on = "top", pressure = 10.0 }
load.s = { on = "r", pressure = 2.0 }
rigid.fl = { line = [[-8.0, 0.0], [8.0, 0.0]] }
rigid.wl = { line = [[-5.01, 9.0], [-5.01, -1.0]] }
rigid.wr = { line = [[5.01, -1.0], [5.01, 9.0]] }
contact.f = { between = ["bot", "rigid.fl"] }
contact.wl = { between = ["l", "rigid.wl"] }
contact.wr = { between = ["r", "rigid.wr"] }
output.fields = false
"#;
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = write_scene(folder.path(), &mesh.text(), case);
    let turned = "pressure = -2.0";
    assert!(case.contains("pressure = 2.0"));
    let ended = Run::file(&file).ranks(2).converged();
    let force = |ended: &crate::support::Ended, name: &str| ended.number(&format!("/contact/{name}/force"));
    for (name, wanted) in [("f", 100.0), ("wl", 16.0), ("wr", 0.0)] {
        assert!((force(&ended, name) - wanted).abs() < 1e-4, "{name}: {}", ended.said());
    }
    let file = write_scene(folder.path(), &mesh.text(), &case.replace("pressure = 2.0", turned));
    let other = Run::file(&file).converged();
    assert!((force(&other, "wr") - 16.0).abs() < 1e-4 && force(&other, "wl") == 0.0, "{}", other.said());
    // Nothing holds it down: what cannot press is pulled by, and the loads are named.
    let file = write_scene(folder.path(), &mesh.text(), &case.replace("pressure = 10.0", "pressure = -10.0"));
    let driven = Run::file(&file).ranks(2).ended();
    assert_eq!(driven.code, Some(3), "{}", driven.said());
    assert!(driven.said().contains("body b can move by (0, 1): load.p drives it there"), "{}", driven.said());
}
