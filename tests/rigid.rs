//! Rigid tools and boundaries that stay rigid, against exact solutions and against bodies a million times stiffer.

use crate::support::mesh::{Mesh, grid, write_scene};
use crate::support::{Ended, PAIRS, Run, TracePoint, ranks_in_turn};

const EXACT: f64 = 1e-9;

/// A block [0, 2] × [0, 1], its left side free to slide up and down.
fn block() -> Mesh {
    Mesh { bodies: vec![("block", grid(5, 3, 21, |u, v| [2.0 * u, v]), ["bottom", "right", "top", "left"])] }
}

const BLOCK: &str = r#"
mesh = { file = "mesh.msh", refine = 1 }
body.block = { young = 1000.0, poisson = 0.3 }
support.bottom = { on = "bottom", uy = 0.0 }
solver.tolerance = 1e-12
"#;

/// Plane-strain modulus of the block.
const MODULUS: f64 = 1000.0 / 0.91;

fn in_folder<T>(mesh: &Mesh, case: &str, with: impl FnOnce(Run) -> T) -> T {
    in_folder_of(&mesh.text(), case, with)
}

/// The same with the text of a mesh file.
fn in_folder_of<T>(mesh: &str, case: &str, with: impl FnOnce(Run) -> T) -> T {
    let folder = tempfile::tempdir().expect("a temporary folder");
    with(Run::file(&write_scene(folder.path(), mesh, case)))
}

fn close(found: f64, wanted: f64, size: f64, words: &str) {
    assert!((found - wanted).abs() <= EXACT * size, "{words}: {found} instead of {wanted}");
}

/// A flat tool, wider than the block, moved down or pressed: the pressure is the same everywhere.
#[test]
fn a_flat_tool_presses_evenly() {
    let flat = format!(
        "{BLOCK}support.left = {{ on = \"left\", ux = 0.0 }}\ncontact.top = {{ between = [\"top\", \"rigid.die\"], curve = \"line\", gap = \"closed\" }}\n"
    );
    let pressure = 0.01 * MODULUS;
    for motion in ["uy = -0.01".to_string(), format!("ux = 0.0, force = [0.0, {:?}]", -2.0 * pressure)] {
        let case = format!("{flat}rigid.die = {{ line = [[-0.5, 1.0], [2.5, 1.0]], {motion} }}\n");
        for (at, (order, space)) in PAIRS.into_iter().enumerate() {
            let ended = in_folder(&block(), &case, |run| {
                run.set("mesh.order", order).set("contact.top.multiplier", space).ranks(1 + at % 3).converged()
            });
            let words = format!("P{order} and {space}, {motion}");
            for point in ended.trace("top") {
                close(point.lambda, pressure, pressure, &words);
            }
            close(ended.number("/rigid/die/motion/1"), -0.01, 0.01, &words);
            close(ended.number("/rigid/die/force/1"), -2.0 * pressure, 2.0 * pressure, &words);
            for balance in ["force", "moment", "energy", "bodies"] {
                assert!(ended.number(&format!("/balance/{balance}")) < EXACT, "{words}: {balance}");
            }
        }
    }
}

/// A force beside the middle turns the tool: `p = P/2 (1 + 3 e (x - 1))` with the eccentricity `e`, and the turn is that of
/// pure bending.
#[test]
fn a_force_beside_the_middle_turns_the_tool() {
    let (force, eccentricity) = (4.0, 0.2);
    let case = format!(
        "{BLOCK}support.foot = {{ at = [1.0, 0.0], ux = 0.0 }}
contact.top = {{ between = [\"top\", \"rigid.die\"], curve = \"line\", gap = \"closed\" }}
rigid.die = {{ line = [[3.0, 1.0], [-1.0, 1.0]], ux = 0.0, force = [0.0, -{force}], moment = -{} }}\n",
        force * eccentricity
    );
    for ranks in ranks_in_turn(0) {
        let ended = in_folder(&block(), &case, |run| run.ranks(ranks).converged());
        for point in ended.trace("top") {
            let wanted = 0.5 * force * (1.0 + 3.0 * eccentricity * (point.x[0] - 1.0));
            close(point.lambda, wanted, force, &format!("{point:?}"));
        }
        let turn = -0.5 * force * 3.0 * eccentricity / MODULUS;
        close(ended.number("/rigid/die/motion/2"), turn, turn.abs(), "turn");
        close(ended.number("/rigid/die/moment"), -force * eccentricity, force, "moment");
    }
}

/// The same with a tool that is far longer than the block: what lies where no body is does not count.
#[test]
fn a_long_tool_turns_as_a_short_one() {
    let case = |half: f64| {
        format!(
            "{BLOCK}support.foot = {{ at = [1.0, 0.0], ux = 0.0 }}
contact.top = {{ between = [\"top\", \"rigid.die\"], gap = \"closed\" }}
rigid.die = {{ line = [[-{half:?}, 1.0], [{half:?}, 1.0]], about = [1.0, 1.0], ux = 0.0, force = [0.0, -4.0], moment = -0.8 }}\n"
        )
    };
    for half in [10.0, 1e4] {
        let ended = in_folder(&block(), &case(half), Run::converged);
        let turn = ended.number("/rigid/die/motion/2");
        assert!((turn * MODULUS / -1.2 - 1.0).abs() < 1e-6, "{half}: {turn}");
    }
}

/// A block with edges that shorten towards the middle of its top, and beside it a part of a ring that is a million times stiffer.
fn roller_scene(with_ring: bool) -> Mesh {
    let flat = grid(12, 5, 31, |u, v| {
        let s = 2.0 * u - 1.0;
        [2.0 * s * s.abs(), 2.0 * v - 2.0]
    });
    let ring = grid(13, 2, 32, |u, v| {
        let (s, r) = (2.0 * u - 1.0, 3.0 - 0.5 * v);
        let angle = 0.6 * s * s.abs();
        [r * angle.sin(), 3.0 - r * angle.cos()]
    });
    let mut bodies = vec![("block", flat, ["bottom", "right", "top", "left"])];
    if with_ring {
        bodies.push(("ring", ring, ["ring.seam", "", "ring.top", ""]));
    }
    Mesh { bodies }
}

const ROLLER: &str = r#"
mesh = { file = "mesh.msh", refine = 2 }
body.block = { young = 1000.0, poisson = 0.3 }
support.bottom = { on = "bottom", ux = 0.0, uy = 0.0 }
solver.tolerance = 1e-10
"#;

/// Γ_C lies on the same circle. What is left is the strain of the ring itself, a millionth of that of the block.
#[test]
fn a_rigid_roller_is_a_stiff_one() {
    let stiff = format!(
        "{ROLLER}body.ring = {{ young = 1e9, poisson = 0.3 }}
support.held = {{ on = \"ring.top\", ux = 0.0, uy = -0.02 }}
geometry.round = {{ curves = [\"ring.seam\"], circle = {{ centre = [0, 3], radius = 3 }} }}
contact.seam = {{ between = [\"top\", \"ring.seam\"], curve = \"ring.seam\" }}\n"
    );
    let rigid = format!(
        "{ROLLER}rigid.roller = {{ circle = {{ centre = [0, 3], radius = 3 }}, uy = -0.02 }}
contact.seam = {{ between = [\"top\", \"rigid.roller\"] }}\n"
    );
    let stiff = in_folder(&roller_scene(true), &stiff, Run::converged);
    let moved = in_folder(&roller_scene(false), &rigid, Run::converged);
    let same = |a: &Ended, b: &Ended, path: &str, most: f64| {
        let [a, b] = [a, b].map(|ended| ended.number(path));
        assert!((a / b - 1.0).abs() < most, "{path}: {a} and {b}");
    };
    for path in ["/contact/seam/force", "/contact/seam/pressure_max", "/energy/strain/block"] {
        same(&moved, &stiff, path, 1e-5);
    }
    let [one, other] = [&moved, &stiff].map(|ended| ended.trace("seam"));
    let most = moved.number("/contact/seam/pressure_max");
    for point in &one {
        let off = lambda_at(&other, point.s).map(|lambda| (lambda - point.lambda).abs()).fold(f64::INFINITY, f64::min);
        assert!(off < 1e-5 * most, "{point:?}: off by {off}");
    }
    // The same roller, pressed by the force that moved it.
    let force = format!("[0.0, {:?}]", -moved.number("/contact/seam/resultant/1").abs());
    let pressed = rigid.replace("uy = -0.02", &format!("ux = 0.0, force = {force}"));
    for ranks in ranks_in_turn(1) {
        let pressed = in_folder(&roller_scene(false), &pressed, |run| run.ranks(ranks).converged());
        assert!((pressed.number("/rigid/roller/motion/1") + 0.02).abs() < 1e-6, "{}", pressed.number("/rigid/roller/motion/1"));
        same(&pressed, &moved, "/contact/seam/pressure_max", 1e-4);
    }
}

/// λ at an arc length between two lines of a trace: of each of the intervals that may hold it.
fn lambda_at(trace: &[TracePoint], s: f64) -> impl Iterator<Item = f64> {
    let near = 1e-6 * trace.last().expect("some").s;
    let holds = move |two: &&[TracePoint]| two[0].s - near <= s && s <= two[1].s + near && two[1].s > two[0].s;
    trace
        .windows(2)
        .filter(holds)
        .map(move |two| two[0].lambda + (s - two[0].s) / (two[1].s - two[0].s) * (two[1].lambda - two[0].lambda))
}

/// Where a tool and a block are drawn nearest lies beside the line of the force: one of them tilts by a hundredth before they lie
/// on each other.
#[test]
fn what_must_tilt_lies_flat_in_the_end() {
    let tool = format!(
        "{BLOCK}support.foot = {{ at = [1.0, 0.0], ux = 0.0 }}
rigid.die = {{ line = [[-0.5, 1.0], [2.5, 1.03]], about = [1.0, 1.0], ux = 0.0, force = [0.0, -4.0], moment = 0.0 }}
contact.top = {{ between = [\"top\", \"rigid.die\"] }}\n"
    );
    let block_on_it = format!(
        "{}support.foot = {{ at = [1.0, 0.5], ux = 0.0 }}
load.top = {{ on = \"top\", pressure = 2.0 }}
rigid.die = {{ line = [[-0.5, -0.03], [2.5, 0.0]] }}
contact.top = {{ between = [\"bottom\", \"rigid.die\"] }}\n",
        BLOCK.replace("support.bottom = { on = \"bottom\", uy = 0.0 }", "")
    );
    for case in [tool, block_on_it] {
        for ranks in [1, 3] {
            let ended = in_folder(&block(), &case, |run| run.ranks(ranks).converged());
            let force = ended.number("/contact/top/force");
            assert!((force - 4.0).abs() < 1e-3 && ended.number("/contact/top/pressure_max") < 2.2, "{force}: {}", ended.said());
        }
    }
}

/// What a contact does to its two sides is in balance to nine digits at the usual tolerance, and what acts on a body to that tolerance.
#[test]
fn a_tool_is_in_balance_at_the_usual_tolerance() {
    let usual = ROLLER.replace("solver.tolerance = 1e-10", "");
    for motion in ["force = [0.0, -8.0]", "uy = -0.02"] {
        let case = format!(
            "{usual}rigid.roller = {{ circle = {{ centre = [0, 3], radius = 3 }}, ux = 0.0, {motion} }}
contact.seam = {{ between = [\"top\", \"rigid.roller\"] }}\n"
        );
        let ended = in_folder(&roller_scene(false), &case, Run::converged);
        for (balance, most) in [("force", EXACT), ("moment", EXACT), ("bodies", 1e-8), ("energy", 1e-8)] {
            let off = ended.number(&format!("/balance/{balance}"));
            assert!(off < most, "{motion}: {balance} off by {off}");
        }
    }
}

/// Γ_C on the block may grow under a roller, whose circle is open at its top: an end of a side that looks away from the curve is no limit.
/// It ended where that circle is open, 0.03 wide. A component of the force that is rounding does not stand against `ux`.
#[test]
fn a_contact_boundary_on_the_block_grows_under_a_roller() {
    let case = format!(
        "{ROLLER}rigid.roller = {{ circle = {{ centre = [0, 3], radius = 3 }}, ux = 0.0, force = [-3e-15, -40.0] }}
contact.seam = {{ between = [\"top\", \"rigid.roller\"], curve = \"top\" }}\n"
    );
    let ended = in_folder(&roller_scene(false), &case, Run::converged);
    let hertz = (40.0 * 1000.0 / (1.0 - 0.09) / (3.0 * std::f64::consts::PI)).sqrt();
    let found = ended.number("/contact/seam/pressure_max");
    assert!((found / hertz - 1.0).abs() < 0.06, "{found} instead of {hertz}");
    assert_eq!(ended.value("/contact/seam/trust"), true, "{}", ended.said());
}

/// The force is so small beside the gap that the roller must come down first.
#[test]
fn a_roller_comes_down_onto_the_block() {
    let case = format!(
        "{ROLLER}rigid.roller = {{ circle = {{ centre = [0, 3.5], radius = 3 }}, ux = 0.0, force = [0.0, -5.0] }}
contact.seam = {{ between = [\"top\", \"rigid.roller\"] }}\n"
    );
    let ended = in_folder(&roller_scene(false), &case, Run::converged);
    assert!((ended.number("/contact/seam/resultant/1").abs() - 5.0).abs() < 1e-7, "{}", ended.said());
    let down = ended.number("/rigid/roller/motion/1");
    assert!(down < -0.5 && down > -0.53, "{down}");
    // It presses as one that is drawn where it will lie.
    let near = in_folder(&roller_scene(false), &case.replace("[0, 3.5]", "[0, 3]"), Run::converged);
    let [far, near] = [&ended, &near].map(|ended| ended.number("/contact/seam/pressure_max"));
    assert!((far / near - 1.0).abs() < 1e-5, "{far} and {near}");
}

/// A roller that may turn is held by force and curvature: its contact lies where the moment wants it, at M/F, if it turns about the
/// place where it presses. About one that lies above by h it lies off by h/(R - h) of that, since normals are those of where it is
/// drawn.
#[test]
fn a_roller_that_turns_is_known_where_it_turns_about_its_contact() {
    let case = |about: f64, moment: f64| {
        format!(
            "{ROLLER}rigid.roller = {{ x = \"3*sin(t)\", y = \"3 - 3*cos(t)\", t = [-0.5, 0.5], about = [0.0, {about}], ux = 0.0, force = [0.0, -20.0], moment = {moment} }}
contact.seam = {{ between = [\"top\", \"rigid.roller\"] }}\n"
        )
    };
    let ended = |about, moment, ranks| in_folder(&roller_scene(false), &case(about, moment), |run| run.ranks(ranks).ended());
    for ranks in ranks_in_turn(0) {
        let near = ended(0.0, 0.4, ranks);
        assert_eq!(near.code, Some(0), "{}", near.said());
        assert!((near.number("/contact/seam/place/0") + 0.02).abs() < 2e-4, "{}", near.number("/contact/seam/place/0"));
        assert!(near.number("/contact/seam/rotation_error") < 0.01, "{}", near.said());
    }
    let above = ended(0.5, 0.4, 2);
    let [place, length] = ["place/0", "length"].map(|key| above.number(&format!("/contact/seam/{key}")));
    let off = (place + 0.02).abs() / (0.5 * length);
    let told = above.number("/contact/seam/rotation_error");
    assert!((place / -0.02 - 3.0 / 2.5).abs() < 0.02 && told > off && told < 2.0 * off, "{place}: {off}, told {told}");
    let centre = ended(1.5, 0.4, 1);
    assert_eq!(centre.code, Some(3), "{}", centre.said());
    assert!(centre.said().contains("lay the reference point (about)"), "{}", centre.said());
}

/// A line whose force acts beyond its end tips: it is to be held by a key of its own, since no support is one of a tool.
#[test]
fn a_tool_that_tips_is_told_to_hold_its_turn_itself() {
    let tool = "rigid.die = { line = [[0.2, 1.0], [1.2, 1.0]], about = [1.6, 1.0], ux = 0.0, force = [0.0, -5.0]";
    let case = format!(
        "{BLOCK}support.left = {{ on = \"left\", ux = 0.0 }}\ncontact.top = {{ between = [\"top\", \"rigid.die\"] }}\n{tool}"
    );
    let tips = in_folder(&block(), &format!("{case}, moment = 0.0 }}\n"), |run| run.ranks(2).ended());
    assert!(
        tips.code == Some(3) && tips.said().contains("hold its turn: give [rigid.die] angle = 0.0 in the place of its moment"),
        "{}",
        tips.said()
    );
    let held = in_folder(&block(), &format!("{case}, angle = 0.0 }}\n"), |run| run.ranks(2).converged());
    close(held.number("/contact/top/force"), 5.0, 5.0, "it is pressed down");
    let lifted = format!("{case}, angle = 0.0 }}\n").replace("[0.0, -5.0]", "[0.0, 5.0]");
    let lifted = in_folder(&block(), &lifted, |run| run.ranks(2).ended());
    let words = "prescribe ux and uy of [rigid.die] in the place of its force";
    assert!(lifted.code == Some(3) && lifted.said().contains(words), "{}", lifted.said());
}

/// A wave presses with its force on any mesh: one on which it lies in the block by a tenth of what it has come down is refined all the same.
#[test]
fn a_force_that_is_given_leaves_no_mesh_on_which_bodies_lie_in_each_other() {
    let case = format!(
        "{BLOCK}support.left = {{ on = \"left\", ux = 0.0 }}\ncontact.top = {{ between = [\"top\", \"rigid.wave\"] }}\naccuracy.force = 1e-2
         rigid.wave = {{ x = \"t\", y = \"1 + 0.005*(1 - cos(8*t))\", t = [-0.5, 2.5], ux = 0.0, angle = 0.0, force = [0.0, -2.0] }}\n"
    );
    for ranks in [1, 2] {
        let ended = in_folder(&block(), &case, |run| run.set("mesh.refine", 0).ranks(ranks).converged());
        let meshes = ended.value("/accuracy").as_array().map_or(0, Vec::len);
        let [depth, approach] = ["depth", "approach"].map(|key| ended.number(&format!("/contact/top/{key}")));
        assert!(meshes > 1 && depth < 0.1 * approach, "{meshes} meshes, {depth} of {approach}: {}", ended.said());
    }
}

#[test]
fn a_roller_that_nothing_holds_is_told() {
    let case = format!(
        "{ROLLER}rigid.roller = {{ circle = {{ centre = [0, 3], radius = 3 }}, force = [0.0, -5.0] }}
contact.seam = {{ between = [\"top\", \"rigid.roller\"] }}\n"
    );
    let ended = in_folder(&roller_scene(false), &case, Run::ended);
    assert_eq!(ended.code, Some(3), "{}", ended.said());
    assert!(ended.said().contains("prescribe ux, uy or angle of rigid.roller"), "{}", ended.said());
    assert!(ended.said().contains("rigid.roller") && ended.said().contains("move by (1, 0)"), "{}", ended.said());
}

/// A plate that is bonded to the top presses as a prescribed displacement does.
#[test]
fn a_plate_presses_with_its_resultant() {
    let pressed = format!(
        "{BLOCK}support.foot = {{ at = [0.0, 0.0], ux = 0.0 }}
load.plate = {{ on = \"top\", rigid = true, force = [1.0, -6.0], moment = 0.5 }}\n"
    )
    .replace("uy = 0.0 }", "ux = 0.0, uy = 0.0 }");
    for ranks in ranks_in_turn(0) {
        let plate = in_folder(&block(), &pressed, |run| run.ranks(ranks).converged());
        for (path, wanted) in [("/rigid/plate/force/0", 1.0), ("/rigid/plate/force/1", -6.0), ("/rigid/plate/moment", 0.5)] {
            close(plate.number(path), wanted, 6.0, path);
        }
        let [ux, uy, turn] = [0, 1, 2].map(|k| plate.number(&format!("/rigid/plate/motion/{k}")));
        let held = format!(
            "{}support.plate = {{ on = \"top\", ux = {ux:?}, uy = \"{uy:?} + {turn:?} * (x - 1)\" }}\n",
            pressed.split("load.plate").next().expect("some")
        );
        let held = in_folder(&block(), &held, |run| run.ranks(ranks).converged());
        let energy = plate.number("/energy/total");
        close(held.number("/energy/total"), energy, energy, "energy");
        close(held.number("/support/plate/reaction/1"), -6.0, 6.0, "reaction");
        close(plate.number("/energy/external_work"), 2.0 * energy, energy, "work");
    }
}

/// A plate takes its body with it: what is proposed is a component of the plate, which a mean of the body would hold twice.
#[test]
fn a_plate_that_nothing_holds_is_to_be_held_itself() {
    let case = r#"
mesh = { file = "mesh.msh" }
body.block = { young = 1000.0, poisson = 0.3 }
rigid.floor = { line = [[-3.0, 0.0], [5.0, 0.0]] }
load.plate = { on = "top", rigid = true, force = [0.0, -2.0], moment = 0.0 }
contact.foot = { between = ["bottom", "rigid.floor"], gap = "closed" }
"#;
    let ended = in_folder(&block(), case, Run::ended);
    assert_eq!(ended.code, Some(3), "{}", ended.said());
    assert!(ended.said().contains("prescribe ux, uy or angle of load.plate"), "{}", ended.said());
    in_folder(&block(), &case.replace("rigid = true,", "rigid = true, ux = 0.0,"), Run::converged);
}

/// Nodal forces of a body that hardly changes its volume are thousands of times as large as what they add up to: rounding of
/// these is no force on the plate, however exact the solve is to be.
#[test]
fn a_plate_on_rubber_comes_to_balance_whatever_is_asked() {
    let rubber = r#"
mesh = { file = "mesh.msh", refine = 2, order = 2 }
body.block = { young = 3.0, poisson = 0.4999 }
rigid.floor = { line = [[-3.0, 0.0], [5.0, 0.0]] }
load.plate = { on = "top", rigid = true, ux = 0.0, force = [0.0, -0.02], moment = 0.0 }
contact.foot = { between = ["bottom", "rigid.floor"], gap = "closed" }
"#;
    for (at, tolerance) in [1e-9, 1e-10, 1e-11, 1e-12].into_iter().enumerate() {
        let ended = in_folder(&block(), rubber, |run| run.set("solver.tolerance", tolerance).ranks(1 + at % 3).converged());
        close(ended.number("/rigid/plate/force/1"), -0.02, 0.02, "the force on the plate");
        close(ended.number("/rigid/floor/force/1"), 0.02, 0.02, "the force on the floor");
    }
}

/// Exit code 2 and these words, from `check` and from `run`.
#[test]
fn mistakes_are_told() {
    let contact = "contact.top = { between = [\"top\", \"rigid.die\"], curve = \"line\", gap = \"closed\" }\n";
    let line = "line = [[-0.5, 1.0], [2.5, 1.0]]";
    for (words, told) in [
        (format!("{contact}rigid.die = {{ uy = 0.1 }}"), "rigid.die: its surface is one of line"),
        (format!("{contact}rigid.die = {{ {line}, circle = {{ centre = [0, 0], radius = 1 }} }}"), "give exactly one of them"),
        (format!("{contact}rigid.die = {{ line = [[0, 1]] }}"), "rigid.die.line"),
        (format!("{contact}rigid.die = {{ line = [[0, 1], [0, 1]] }}"), "twice"),
        (
            "contact.top = { between = [\"top\", \"rigid.die\"] }\nrigid.die = { line = [[0, 1.06], [1, 1], [2, 1.06]] }".into(),
            "turns by 6.9 degrees between its lines 1 and 2: a spline through its points would round that",
        ),
        (format!("{contact}rigid.die = {{ {line}, uy = 0.1, force = [0, -1] }}"), "stands beside uy"),
        (format!("{contact}rigid.die = {{ {line}, angle = 0.1, moment = 2 }}"), "stands beside angle"),
        (format!("{contact}rigid.die = {{ circle = {{ centre = [1, 2], radius = 1 }}, force = [0, -1], moment = 0 }}"), "a circle turns on what it touches"),
        (
            "contact.top = { between = [\"top\", \"rigid.die\"], configuration = \"deformed\" }\nrigid.die = { line = [[0, 1], [2, 1]], moment = 1 }".into(),
            "beside which a tool cannot turn freely",
        ),
        (format!("{contact}rigid.dye = {{ {line} }}"), "\"rigid.die\" is no rigid tool"),
        (format!("{contact}rigid.die = {{ {line} }}\nrigid.other = {{ {line} }}"), "rigid.other: nothing touches it"),
        (format!("{contact}rigid.die = {{ line = [[3, 1], [3, 2]] }}"), "faces none of the boundaries"),
        (format!("{contact}rigid.die = {{ {line}, young = 3 }}"), "young"),
        (format!("{}rigid.die = {{ {line} }}", contact.replace("\"line\"", "\"rigid.dye\"")), "or one of the two boundaries; did you mean"),
        (format!("{}rigid.die = {{ {line} }}", contact.replace("\"line\"", "\"left\"")), "contact.top.curve = \"left\""),
        (format!("{}rigid.die = {{ {line} }}", contact.replace("\"line\"", "3")), "contact.top.curve"),
        (format!("{}rigid.die = {{ {line} }}", contact.replace("\"line\"", "\"rigid.die\", spans = 3")), "contact.top.spans"),
        (format!("{}rigid.die = {{ {line} }}", contact.replace("\"line\", gap = \"closed\"", "\"rigid.die\", configuration = \"deformed\"")), "\"deformed\" wants curve = \"fit\""),
        (format!("{}rigid.die = {{ line = [[0, 1], [1, 1], [2, 1]] }}", contact.replace("\"line\"", "\"rigid.die\"")), "name the one that touches in between, as \"rigid.die.1\""),
        ("contact.top = { between = [\"rigid.a\", \"rigid.b\"] }\nrigid.a = { line = [[0, 1], [1, 1]] }\nrigid.b = { line = [[0, 1], [1, 1]] }".into(), "both sides are rigid"),
        ("load.plate = { on = \"top\", rigid = true }".into(), "presses with nothing"),
        ("load.plate = { on = \"top\", rigid = true, uy = -1e-3 }".into(), "is moved is a [support] with ux and uy"),
        ("load.plate = { on = \"top\", rigid = true, force = [0, 1], pressure = 2 }".into(), "stands beside rigid"),
        ("load.plate = { on = \"top\", force = [0, 1] }".into(), "rigid = true"),
        ("load.plate = { on = \"tap\", rigid = true, force = [0, 1] }".into(), "load.plate.on"),
        ("load.plate = { on = [\"top\", \"bottom\"], rigid = true, force = [0, 1] }".into(), "support.bottom holds a node"),
        (format!("{contact}rigid.die = {{ {line} }}\nload.plate = {{ on = \"top\", rigid = true, force = [0, 1] }}"), "contact.top is there, too"),
    ] {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let file = write_scene(folder.path(), &block().text(), &format!("{BLOCK}{words}\n"));
        let ended = Run::file(&file).ended();
        assert_eq!(ended.code, Some(2), "{words}: {}", ended.said());
        assert!(ended.errors.contains(told) && ended.errors.contains("case.toml"), "{words}: no `{told}` in {}", ended.errors);
        let (code, _, errors) = crate::support::mezha(None, &["check", &file.to_string_lossy()]);
        assert_eq!(code, Some(2), "check, {words}: {errors}");
    }
}

/// Each case with the error of its pressure on two meshes.
#[test]
fn the_tools_of_the_cases_hold_their_values() {
    for (at, (case, contact)) in [
        ("rigid_tools", "seam"),
        ("rigid_tools/rounded.toml", "seam"),
        ("rigid_tools/flat.toml", "seam"),
        ("rigid_tools/wedge.toml", "seam"),
        ("rigid_strip", "upper"),
    ]
    .into_iter()
    .enumerate()
    {
        let fine = Run::case(case).ranks(1 + at % 3).converged();
        let coarse = Run::case(case).set("mesh.refine", 2).set("exact.must_hold", false).ranks(3 - at % 3).converged();
        let [coarse, fine] = [coarse, fine].map(|ended| ended.number(&format!("/errors/lambda_{contact}")));
        assert!(fine < coarse / 4.0, "{case}: {coarse} and {fine}");
    }
}

/// A mesh that was adapted beside a tool begins another run of the same case.
#[test]
fn an_adapted_mesh_is_that_of_the_bodies() {
    let case = format!(
        "{ROLLER}rigid.roller = {{ circle = {{ centre = [0, 3], radius = 3 }}, ux = 0.0, force = [0.0, -8.0] }}
contact.seam = {{ between = [\"top\", \"rigid.roller\"] }}
[accuracy]
pressure = 5e-3\n"
    );
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = write_scene(folder.path(), &roller_scene(false).text(), &case);
    let first = Run::file(&file).ranks(2).converged();
    let text = std::fs::read_to_string(first.out.join("adapted.msh")).expect("a mesh");
    assert!(!text.contains("rigid"), "bodies of the file alone");
    let again = in_folder_of(&text, &case, |run| run.ranks(3).converged());
    for path in ["/contact/seam/force", "/contact/seam/pressure_max"] {
        let [one, other] = [&first, &again].map(|ended| ended.number(path));
        assert!((one / other - 1.0).abs() < 5e-3, "{path}: {one} and {other}");
    }
}

/// Far motions of a tool are beyond the linear theory: a circle that turns about its centre, or goes along, sinks as before.
#[test]
fn far_motions_of_a_loaded_tool_are_not_trusted() {
    for (motion, trusted) in [("ux = 0.0", true), ("ux = 0.0, angle = 0.1", false), ("ux = 0.6", false)] {
        for configuration in ["reference", "deformed"] {
            let case = format!(
                "{ROLLER}rigid.roller = {{ circle = {{ centre = [0, 3], radius = 3 }}, {motion}, force = [0.0, -8.0] }}
contact.seam = {{ between = [\"top\", \"rigid.roller\"], configuration = \"{configuration}\" }}\n"
            );
            let ended = in_folder(&roller_scene(false), &case, Run::ended);
            if ended.code == Some(0) && (configuration == "reference" || !motion.contains("0.6")) {
                let told = ended.errors.contains("the bodies turn") || ended.errors.contains("the bodies slide");
                assert_eq!(told, !trusted, "{motion}, {configuration}: {}", ended.said());
            }
        }
    }
}

/// A rigid U hangs around a block with clearance on three sides, and is pushed aside and down: it comes to two of them, on coarse meshes
/// and on fine ones, and statics gives both forces.
#[test]
fn a_tool_with_clearance_comes_to_the_sides_that_its_force_drives_it_to() {
    let block = grid(4, 4, 3, |u, v| [2.0 * u - 1.0, 2.0 * v]);
    let mesh = Mesh { bodies: vec![("block", block, ["bottom", "block.right", "block.top", "block.left"])] };
    let case = r#"
mesh.file = "mesh.msh"
body.block = { young = 1000.0, poisson = 0.3 }
support.ground = { on = "bottom", ux = 0.0, uy = 0.0 }
rigid.u = { line = [[-1.01, 0.5], [-1.01, 2.01], [1.01, 2.01], [1.01, 0.5]], force = [2.0, -3.0], moment = 0.0 }
contact.left = { between = ["block.left", "rigid.u.1"], gap = "geometry" }
contact.top = { between = ["block.top", "rigid.u.2"], gap = "geometry" }
contact.right = { between = ["block.right", "rigid.u.3"], gap = "geometry" }
"#;
    for (refine, ranks) in [(2, 1), (2, 2), (4, 2)] {
        let ended = in_folder(&mesh, case, |run| run.set("mesh.refine", refine).ranks(ranks).converged());
        for (contact, wanted) in [("left", 2.0), ("top", 3.0), ("right", 0.0)] {
            let force = ended.number(&format!("/contact/{contact}/force"));
            assert!((force - wanted).abs() < 1e-6, "refine {refine}, {ranks} ranks: {contact} carries {force}");
        }
    }
}

/// A tool with a force and a moment: λ is linear, and its centre is where statics puts it.
#[test]
fn the_centre_of_a_linear_pressure_is_exact() {
    let mesh = Mesh { bodies: vec![("block", grid(4, 2, 5, |u, v| [2.0 * u, v]), ["bottom", "", "top", ""])] };
    let case = r#"
mesh = { file = "mesh.msh", refine = 1 }
body.block = { young = 10.0, poisson = 0.3 }
support.bottom = { on = "bottom", uy = 0.0 }
support.pin = { at = [0.0, 0.0], ux = 0.0 }
rigid.tool = { line = [[-0.5, 1.0], [2.5, 1.0]], about = [0.3, 2.0], force = [0.0, -0.01], moment = -0.005, ux = 0.0 }
contact.face = { between = ["top", "rigid.tool"] }
solver.tolerance = 1e-11
"#;
    for ranks in [1, 2] {
        let ended = in_folder(&mesh, case, |run| run.ranks(ranks).converged());
        let place = ended.number("/contact/face/place/0");
        assert!((place - 0.8).abs() < 1e-9, "{place}");
    }
}

/// A flat tool of two pieces that go on in a straight line: a contact with the first alone leaves out what presses on the second.
#[test]
fn contact_that_goes_on_beyond_its_boundary_is_not_trusted() {
    let case = format!(
        "{BLOCK}support.left = {{ on = \"left\", ux = 0.0 }}\n\
         rigid.die = {{ line = [[-0.5, 1.0], [1.0, 1.0], [2.5, 1.0]], uy = -0.01 }}\n\
         contact.first = {{ between = [\"top\", \"rigid.die.1\"] }}\n"
    );
    for ranks in [1, 2] {
        let words = "both bodies go on beyond";
        let alone = in_folder(&block(), &case, |run| run.ranks(ranks).set("mesh.refine", 3).converged());
        assert!(alone.value("/contact/first/trust") == false && alone.errors.contains(words), "{}", alone.said());
        let joined = in_folder(&block(), &case, |run| run.ranks(ranks).set("contact.first.law", "bilateral").converged());
        assert!(!joined.errors.contains(words), "what is joined may end where it likes: {}", joined.said());
        let chamfer = "rigid.die = { line = [[-0.5, 1.0], [1.0, 1.0], [2.5, 1.2]], uy = -0.01 }";
        let ended = case.replace("rigid.die = { line = [[-0.5, 1.0], [1.0, 1.0], [2.5, 1.0]], uy = -0.01 }", chamfer);
        let ended = in_folder(&block(), &ended, |run| run.ranks(ranks).set("mesh.refine", 3).converged());
        assert!(!ended.errors.contains(words), "the tool turns away by eight degrees: {}", ended.said());
        let both = format!("{case}contact.second = {{ between = [\"top\", \"rigid.die.2\"] }}\n");
        let both = in_folder(&block(), &both, |run| run.ranks(ranks).set("mesh.refine", 3).converged());
        assert!(!both.errors.contains(words), "{}", both.said());
    }
}
