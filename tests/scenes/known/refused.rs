//! Scenes that cannot be right: loose pieces, boundaries that do not face each other, large strain.

use super::{Answer, Known};
use crate::layers::Layers;
use crate::scene::{Body, Gap, Press, Scene, Settings};
use crate::shape::{Frame, Shape};
use crate::support::mesh::{Block, Mesh};

/// Two blocks, one on the other, held at their walls, under a pressure.
fn blocks(size: f64, pressure: f64, walls: [bool; 2]) -> (Scene, Settings) {
    let body = |depth: f64, young: f64| Body {
        seam: Shape::Line { height: 0.0 },
        range: [0.0, 1.0],
        depth,
        young,
        poisson: 0.227,
        walls,
    };
    let scene = Scene {
        frame: Frame { scale: size, ..Frame::PLAIN },
        stress: 1.0,
        bodies: [body(0.7, 7000.0), body(0.5, 3000.0)],
        gap: Gap::Closed,
        press: Press::Pressure { mean: pressure, tilt: 0.0 },
        table: true,
        drawn_aside: 0.0,
        focus: Vec::new(),
    };
    let settings = Settings {
        order: 2,
        refine: 2,
        space: "p1-discontinuous",
        segments: None,
        curve: "line",
        deformed: false,
        swapped: false,
        ranks: 1,
        layers: [Layers::even(6, 0.7, 0.1, 1), Layers::even(8, 0.5, 0.1, 2)],
    };
    (scene, settings)
}

/// Adds two triangles to a body that share at most a node with it: the square from a corner, of a width.
fn add_square(block: &mut Block, at: [f64; 2], width: f64, shared: Option<usize>) {
    let first = block.points.len();
    let corners = [[0.0, 0.0], [1.0, 0.1], [1.1, 1.0], [0.0, 1.0]];
    block.points.extend(corners.map(|[x, y]| [at[0] + width * x, at[1] + width * y]));
    let node = |k: usize| if k == 0 { shared.unwrap_or(first) } else { first + k };
    block.triangles.extend([[node(0), node(1), node(2)], [node(0), node(2), node(3)]]);
    if shared.is_some() {
        block.points.remove(first);
        let added = block.triangles.len() - 2;
        block.triangles[added..].iter_mut().flatten().filter(|k| **k > first).for_each(|k| *k -= 1);
    }
}

pub fn pieces() -> Vec<Known> {
    let words: &[&str] = &["piece", "hang together", "connected", "can move", "overlap"];
    let known = |name: &str, size: f64, order: usize, ranks: usize, change: &dyn Fn(&mut [Block; 2])| {
        let (scene, settings) = blocks(size, 1.0, [true, true]);
        let settings = Settings { order, ..settings };
        let [(lower, one, a), (upper, two, b)] = scene.blocks(&settings.layers);
        let mut both = [one, two];
        change(&mut both);
        let [one, two] = both;
        let mesh = Mesh { bodies: vec![(lower, one, a), (upper, two, b)] }.text();
        Known { name: format!("pieces, {name}"), mesh, case: scene.case(&settings), ranks, answer: Answer::Doubt(words) }
    };
    let highest = |block: &Block| {
        let top = |k: &usize| block.points[*k][1];
        (0..block.points.len()).max_by(|a, b| top(a).total_cmp(&top(b))).expect("a node")
    };
    vec![
        known("one beside the upper block", 1.0, 2, 1, &|both| add_square(&mut both[1], [1.3, 0.2], 0.1, None)),
        known("one above, in metres", 1e-3, 1, 2, &|both| add_square(&mut both[1], [2e-4, 6e-4], 1e-4, None)),
        known("one below the lower block", 1e3, 2, 3, &|both| add_square(&mut both[0], [400.0, -900.0], 100.0, None)),
        known("one on a node", 1.0, 2, 1, &|both| {
            let node = highest(&both[1]);
            let at = both[1].points[node];
            add_square(&mut both[1], at, 0.1, Some(node));
        }),
        known("one within the upper block", 1.0, 1, 2, &|both| add_square(&mut both[1], [0.4, 0.2], 0.1, None)),
        known("one whose edge lies on the block", 1.0, 2, 3, &|both| add_square(&mut both[1], [0.4, 0.5], 0.1, None)),
    ]
}

pub fn pairs() -> Vec<Known> {
    let known = |name: &str, size: f64, pairs: &[[&str; 2]], curve: &'static str, ranks: usize| {
        let (scene, settings) = blocks(size, 1.0, [true, true]);
        let case = scene.case(&Settings { curve, ..settings.clone() });
        let (head, contact) = case.split_once("between = [\"lower.seam\", \"upper.seam\"]").expect("a contact");
        let mut text = format!("{head}between = {:?}{contact}", pairs[0]);
        for (k, pair) in pairs.iter().enumerate().skip(1) {
            text += &format!("[contact.c{k}]\nbetween = {pair:?}{contact}");
        }
        let words: &[&str] =
            &["face", "opposed", "parallel", "apart", "twice", "same body", "one body", "another contact", "overlap"];
        Known {
            name: format!("pairs, {name}"),
            mesh: scene.mesh(&settings.layers),
            case: text,
            ranks,
            answer: Answer::Refusal(words),
        }
    };
    vec![
        known("seam and top", 1.0, &[["lower.seam", "upper.outer"]], "line", 1),
        known("bottom and top", 1e3, &[["lower.outer", "upper.outer"]], "line", 2),
        known("bottom and seam", 1.0, &[["lower.outer", "upper.seam"]], "fit", 3),
        known("seam and wall", 1e-3, &[["lower.seam", "upper.left"]], "fit", 1),
        known("wall and wall", 1.0, &[["lower.left", "upper.right"]], "line", 2),
        known("the seam twice", 1.0, &[["lower.seam", "upper.seam"], ["lower.seam", "upper.seam"]], "line", 3),
    ]
}

pub fn strains() -> Vec<Known> {
    let known = |name: &str, size: f64, pressure: f64, order: usize, ranks: usize| {
        let (scene, settings) = blocks(size, pressure, [true, false]);
        let settings = Settings { order, ..settings };
        let mesh = scene.mesh(&settings.layers);
        Known { name: format!("strain, {name}"), mesh, case: scene.case(&settings), ranks, answer: Answer::Doubt(&["strain"]) }
    };
    vec![
        known("a tenth", 1.0, 300.0, 2, 1),
        known("a fifth, in metres", 1e-3, 700.0, 2, 2),
        known("a half", 1e3, 1500.0, 1, 3),
        known("ten", 1.0, 3e4, 2, 1),
        known("a thousand", 1.0, 3e6, 1, 2),
    ]
}
