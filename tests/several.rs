//! Several bodies and contact pairs, under pressure from all sides: σ = -I in every body, λ = 1 on every line, whatever the
//! materials. Bodies that touch two or four others, lines that share a corner, stacks.

use crate::support::mesh::{Block, Mesh, grid, write_scene};
use crate::support::{Run, pairs_on_ranks, ranks_in_turn};
use std::fmt::Write;

const EXACT: f64 = 1e-9;

/// Young's modulus and Poisson's ratio of the bodies, in turn.
const MATERIALS: [(f64, f64); 3] = [(7000.0, 0.227), (1000.0, 0.4), (21000.0, 0.3)];

/// `u = -k (x, y)` under a pressure of 1.
fn compliance(body: usize) -> f64 {
    let (young, poisson) = MATERIALS[body % 3];
    (1.0 + poisson) * (1.0 - 2.0 * poisson) / young
}

/// A block over `[x0, x1] × [y0, y1]`.
fn block([x0, x1]: [f64; 2], [y0, y1]: [f64; 2], cells: [usize; 2], seed: u64) -> Block {
    grid(cells[0], cells[1], seed, |u, v| [x0 + u * (x1 - x0), y0 + v * (y1 - y0)])
}

/// A contact line: its name, its two sides, its length, and the gap.
type Line = (&'static str, [&'static str; 2], f64, f64);

/// A scene on smooth tables (`bottom`) and walls (`wall`), with the pressure 1 on `pressed`.
struct Scene {
    mesh: Mesh,
    lines: Vec<Line>,
}

impl Scene {
    fn case(&self, space: &str) -> String {
        let mut text = String::from(
            "mesh = { file = \"mesh.msh\", refine = 1 }\n\
             support.table = { on = \"bottom\", uy = 0.0 }\n\
             support.wall = { on = \"wall\", ux = 0.0 }\n\
             load.all = { on = \"pressed\", pressure = 1.0 }\n\
             solver = { tolerance = 1e-12, inf_sup = true }\n\
             exact.must_hold = true\n",
        );
        for (body, (name, ..)) in self.mesh.bodies.iter().enumerate() {
            let (young, poisson) = MATERIALS[body % 3];
            writeln!(text, "body.{name} = {{ young = {young:?}, poisson = {poisson:?} }}").unwrap();
            writeln!(text, "exact.body.{name}.stress = [\"-1\", \"-1\", \"0\"]").unwrap();
        }
        for (name, between, length, gap) in &self.lines {
            let rest = format!("gap = {gap:?}, multiplier = \"{space}\"");
            writeln!(text, "contact.{name} = {{ between = {between:?}, curve = \"line\", {rest} }}").unwrap();
            writeln!(text, "exact.contact.{name}.force = {{ value = {length:?}, tolerance = {EXACT:?} }}").unwrap();
            writeln!(text, "exact.contact.{name}.lambda = {{ formula = \"1\", tolerance = {EXACT:?} }}").unwrap();
        }
        text
    }

    /// Runs it with a pair of spaces: exact pressures and stresses, and multipliers that the displacements control.
    fn holds(&self, order: usize, space: &str, ranks: usize) {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let file = write_scene(folder.path(), &self.mesh.text(), &self.case(space));
        let ended = Run::file(&file).ranks(ranks).set("mesh.order", order).converged();
        let words = format!("P{order} and {space}, {ranks} ranks");
        for (name, ..) in &self.mesh.bodies {
            let error = ended.number(&format!("/errors/energy_norm_{name}"));
            assert!(error <= EXACT, "{words}: stress of {name} off by {error:e}");
        }
        for (name, ..) in &self.lines {
            let beta = ended.value(&format!("/contact/{name}/inf_sup"));
            assert!(beta.as_f64().is_some_and(|beta| beta > 0.2), "{words}: inf-sup constant of {name} {beta}");
            for point in ended.trace(name) {
                assert!((point.lambda - 1.0).abs() <= EXACT, "{words}: {name}: {point:?}");
            }
        }
        for balance in ["force", "moment", "energy", "bodies"] {
            let off = ended.number(&format!("/balance/{balance}"));
            assert!(off <= EXACT, "{words}: balance of {balance} {off:e}");
        }
    }

    fn holds_with_all_spaces(&self) {
        pairs_on_ranks().for_each(|(order, space, ranks)| self.holds(order, space, ranks));
    }
}

/// One beam on two blocks of different height and stiffness, each with a wall of its own.
#[test]
fn a_block_on_two_others() {
    let left = block([0.0, 2.0], [0.0, 1.0], [3, 2], 1);
    let right = block([2.0, 4.0], [0.0, 1.0], [4, 2], 2);
    let beam = block([0.0, 4.0], [1.0, 1.5], [5, 1], 3);
    let mesh = Mesh {
        bodies: vec![
            ("left", left, ["bottom", "pressed", "left.top", "wall"]),
            ("right", right, ["bottom", "wall", "right.top", "pressed"]),
            ("beam", beam, ["beam.bottom", "pressed", "pressed", "wall"]),
        ],
    };
    // The beam comes down as far as the left block gives way; the gap over the right one makes up for the difference.
    let gap = compliance(0) - compliance(1);
    let lines = vec![("one", ["left.top", "beam.bottom"], 2.0, 0.0), ("two", ["right.top", "beam.bottom"], 2.0, gap)];
    Scene { mesh, lines }.holds_with_all_spaces();
}

/// Two blocks side by side on a wide one: three lines that meet in a point. `cells` are those of the three blocks along x.
fn three_lines([wide, left, right]: [usize; 3]) -> Scene {
    let wide = block([0.0, 4.0], [0.0, 1.0], [wide, 1], 1);
    let left = block([0.0, 2.0], [1.0, 2.5], [left, 2], 2);
    let right = block([2.0, 4.0], [1.0, 2.5], [right, 3], 3);
    let mesh = Mesh {
        bodies: vec![
            ("wide", wide, ["bottom", "pressed", "wide.top", "wall"]),
            ("left", left, ["left.bottom", "left.right", "pressed", "wall"]),
            ("right", right, ["right.bottom", "pressed", "pressed", "right.left"]),
        ],
    };
    let lines = vec![
        ("under_left", ["wide.top", "left.bottom"], 2.0, 0.0),
        ("under_right", ["wide.top", "right.bottom"], 2.0, 0.0),
        ("upright", ["left.right", "right.left"], 1.5, 0.0),
    ];
    Scene { mesh, lines }
}

#[test]
fn three_lines_that_meet_in_the_middle_of_an_edge() {
    three_lines([5, 3, 4]).holds_with_all_spaces();
}

#[test]
fn three_lines_that_meet_in_a_node_of_every_block() {
    three_lines([4, 3, 2]).holds_with_all_spaces();
}

/// A block that nothing holds but four others around it.
#[test]
fn a_block_among_four_others() {
    let centre = block([1.0, 3.0], [1.0, 2.0], [4, 2], 1);
    let below = block([1.0, 3.0], [0.0, 1.0], [3, 2], 2);
    let above = block([1.0, 3.0], [2.0, 2.5], [3, 1], 3);
    let before = block([0.0, 1.0], [1.0, 2.0], [2, 3], 4);
    let behind = block([3.0, 4.0], [1.0, 2.0], [2, 3], 5);
    let mesh = Mesh {
        bodies: vec![
            ("centre", centre, ["c.bottom", "c.right", "c.top", "c.left"]),
            ("below", below, ["bottom", "pressed", "b.top", "wall"]),
            ("above", above, ["a.bottom", "pressed", "pressed", "wall"]),
            ("before", before, ["bottom", "f.right", "pressed", "wall"]),
            ("behind", behind, ["bottom", "pressed", "pressed", "h.left"]),
        ],
    };
    let lines = vec![
        ("south", ["b.top", "c.bottom"], 2.0, 0.0),
        ("north", ["c.top", "a.bottom"], 2.0, 0.0),
        ("west", ["f.right", "c.left"], 1.0, 0.0),
        ("east", ["c.right", "h.left"], 1.0, 0.0),
    ];
    Scene { mesh, lines }.holds_with_all_spaces();
}

/// Stacks of 2, 5 and 9 blocks; `cases/stack` and `cases/stack_16` have 3 and 16, on inclined lines.
#[test]
fn stacks() {
    for count in [2, 5, 9] {
        let name = |text: &str, k: usize| -> &'static str { format!("{text}{k}").leak() };
        let body = |k: usize| {
            let cells = if k.is_multiple_of(2) { [3, 1] } else { [4, 2] };
            let below = if k == 0 { "bottom" } else { name("above", k) };
            let above = if k + 1 == count { "pressed" } else { name("below", k + 1) };
            let heights = [0.5 * k as f64, 0.5 * (k + 1) as f64];
            (name("block", k), block([0.0, 2.0], heights, cells, k as u64), [below, "pressed", above, "wall"])
        };
        let mesh = Mesh { bodies: (0..count).map(body).collect() };
        let lines = (1..count).map(|k| (name("line", k), [name("below", k), name("above", k)], 2.0, 0.0)).collect();
        let scene = Scene { mesh, lines };
        for ranks in ranks_in_turn(1) {
            scene.holds(2, "p1-discontinuous", ranks);
            scene.holds(1, "p1-continuous", ranks);
        }
    }
}

/// Three bodies in a stack, the upper or the middle one a million times stiffer or softer than the others.
#[test]
fn a_stack_of_stiff_and_soft_bodies_takes_few_iterations() {
    let pairs = [(1, "p0"), (2, "p1-discontinuous")];
    for (body, (order, space)) in ["middle", "upper"].map(|body| pairs.map(|pair| (body, pair))).into_iter().flatten() {
        let of = |(at, young)| ranks_in_turn(at).into_iter().map(move |ranks| (young, ranks));
        for (young, ranks) in ["7e9", "7e-3"].into_iter().enumerate().flat_map(of) {
            let mut run = Run::case("stack").ranks(ranks).set("mesh.order", order).set("mesh.refine", 4 - order);
            for other in ["lower", "middle", "upper"] {
                run = run.set(&format!("body.{other}.young"), if other == body { young } else { "7e3" });
            }
            for line in ["first", "second"] {
                run = run.set(&format!("contact.{line}.multiplier"), space);
            }
            // Under equal pressures λ = 1, which the coarsest mesh finds.
            let run = run
                .set("load.side.pressure", 0.2)
                .set("solver.tolerance", 1e-8)
                .set("solver.inf_sup", false)
                .set("output.fields", false);
            let count = run.set("exact.must_hold", false).converged().iterations();
            let words = format!("{body} with E = {young}, P{order}/{space}, {ranks} ranks: {count} iterations");
            println!("{words}");
            assert!(count <= 20, "{words}");
        }
    }
}
