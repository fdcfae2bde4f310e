//! Which boundaries lie close: seams wherever bodies lie, and quarters of a pin in its hole.

use super::*;
use crate::mesh::samples::{quartered_pin, two_blocks};

/// The two blocks, the upper one moved.
fn moved(by: Point) -> MacroMesh {
    let mut mesh = two_blocks();
    let upper: std::collections::BTreeSet<u32> =
        mesh.triangles.iter().filter(|t| mesh.bodies[t.body as usize] == "upper").flat_map(|t| t.vertices).collect();
    upper.into_iter().for_each(|vertex| mesh.vertices[vertex as usize] += by);
    mesh
}

#[test]
fn the_seam_of_two_blocks_is_found_wherever_they_lie() {
    for (by, distance) in [([0.0, 0.0], 0.0), ([0.3, 0.1], 0.1), ([0.0, 0.9], 0.9), ([0.0, -0.05], -0.05)] {
        let pairs = close_pairs(&moved(by.into()), &[]);
        let [pair] = &pairs[..] else { panic!("{pairs:?}") };
        assert_eq!(pair.between, ["lower.seam", "upper.seam"]);
        assert!((pair.distance - distance).abs() < 1e-12, "{pair:?}");
    }
}

#[test]
fn what_lies_far_or_turns_its_back_is_none() {
    for by in [[0.0, 3.0], [9.0, 0.0], [0.0, -4.0]] {
        assert_eq!(close_pairs(&moved(by.into()), &[]), [], "{by:?}");
    }
}

/// Pairs of quarters as a case gets them that joins each to each, and as they are proposed.
fn pairs_of_quarters(turn: f64, clearance: f64) -> [Vec<String>; 2] {
    let mesh = quartered_pin(turn, clearance);
    let quarters = || mesh.boundaries.iter().filter(|boundary| boundary.name != "outside");
    let sides: Vec<CloseSide> = quarters().filter_map(|one| CloseSide::of_boundaries(&mesh, std::iter::once(one))).collect();
    let names: Vec<&String> = quarters().map(|boundary| &boundary.name).collect();
    let asked = close_sides(&mesh, &sides, |_, _| true).into_iter().map(|[a, b]| format!("{}-{}", names[a], names[b]));
    let proposed = close_pairs(&mesh, &[]).into_iter().map(|pair| pair.between.join("-"));
    let sorted = |mut pairs: Vec<String>| {
        pairs.sort();
        pairs
    };
    [sorted(asked.collect()), sorted(proposed.collect())]
}

#[test]
fn quarters_of_a_pin_join_those_of_its_hole_that_they_face() {
    for (turn, clearance) in [(0.0, 0.02), (0.0, 0.0), (0.25, 0.02)] {
        let [asked, proposed] = pairs_of_quarters(turn, clearance);
        let faced = |k: usize| (k + (4.0 * turn) as usize) % 4;
        let mut all: Vec<String> = (0..4).map(|k| format!("pin{k}-hole{}", faced(k))).collect();
        all.sort();
        assert_eq!((&asked, &proposed), (&all, &all), "turned by {turn}, clearance {clearance}");
    }
    for clearance in [0.02, 0.0] {
        let [asked, proposed] = pairs_of_quarters(0.125, clearance);
        let all: Vec<String> =
            (0..4).flat_map(|k| if k < 3 { [k, k + 1] } else { [0, 3] }.map(|of| format!("pin{k}-hole{of}"))).collect();
        assert_eq!((&asked, &proposed), (&all, &all), "turned by half a quarter, clearance {clearance}");
    }
}
