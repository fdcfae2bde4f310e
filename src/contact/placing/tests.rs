//! Where contact boundaries are placed, and which are refused.

use super::*;
use crate::contact::pair::GapChoice;
use crate::contact::samples::seam;
use crate::element::Order;
use crate::mesh::samples::two_blocks;
use crate::mesh::{Level, Partition};
use std::rc::Rc;

fn pair(segments: SegmentRule) -> Pair {
    Pair { gap: GapChoice::Closed, segments, ..seam() }
}

fn cover(mesh: &MacroMesh, curve: Curve) -> Result<(), String> {
    let sides = ["lower.seam", "upper.seam"].map(|name| mesh.boundary(name).expect("named").edges.as_slice());
    let range = curve.range();
    check_cover(mesh, &pair(SegmentRule::Auto), sides, &ContactBoundary::new(curve, range, Point::new(0.0, 1.0)))
}

#[test]
fn holes_at_any_place_are_refused() {
    let mut mesh = two_blocks();
    assert_eq!(cover(&mesh, Curve::Line([[0.0, 1.0], [2.0, 1.0]])), Ok(()));
    for line in [[[-1.0, 1.0], [2.0, 1.0]], [[0.0, 1.0], [3.0, 1.0]]] {
        assert!(cover(&mesh, Curve::Line(line)).unwrap_err().contains("has a hole between"));
    }
    mesh.boundaries.edges_mut("upper.seam".into()).1.truncate(1);
    assert!(cover(&mesh, Curve::Line([[0.0, 1.0], [2.0, 1.0]])).unwrap_err().contains("\"upper.seam\" has a hole"));
}

fn at_rest(mesh: &MacroMesh, numbering: &Numbering, rule: SegmentRule, young: [f64; 2]) -> Result<ContactBoundary, String> {
    place(mesh, numbering, &pair(rule), young, &Known::default(), &|_| Point::zeros()).map(|placed| placed.boundary)
}

#[test]
fn automatic_segments_follow_the_edges() {
    let mesh = two_blocks();
    let partition = Rc::new(Partition::new(&mesh, &vec![0; mesh.triangles.len()], 1));
    let numbering = Numbering::new(Level { intervals: 8, order: Order::P1 }, &partition);
    let boundary = at_rest(&mesh, &numbering, SegmentRule::Auto, [1.0, 1.0]).expect("a flat seam");
    // Longest edge 2/8, 1.5 of them on a length of 2.
    assert_eq!(boundary.segments(), 5);
    // A stiff lower body leaves the rule to the upper one: 8 edges of .9/8, 8 of 1.1/8, 1.5 of them and more to a segment.
    let boundary = at_rest(&mesh, &numbering, SegmentRule::Auto, [10.0, 1.0]).expect("a flat seam");
    assert_eq!(boundary.segments(), 10);
    let lengths = [0, 9].map(|k| boundary.segment_length(k));
    assert!((lengths[0] - 1.6 * 0.9 / 8.0).abs() < 1e-12 && (lengths[1] - 1.6 * 1.1 / 8.0).abs() < 1e-12);
    assert!(boundary.normal(0.5).y > 0.0);
}

#[test]
fn rounding_bends_no_line_and_a_bend_is_one_anywhere() {
    for far in [0.0, 1e8] {
        for (bend, straight) in [(0.0, true), (1e-3, false)] {
            let mut mesh = two_blocks();
            ["lower.seam", "upper.seam"].into_iter().for_each(|name| mesh.boundaries.edges_mut(name.into()).1.sort());
            for x in &mut mesh.vertices {
                let bent = if x.y == 1.0 { bend * x.x * (2.0 - x.x) } else { 0.0 };
                // Turned, so that the coordinates of the line are rounded.
                *x = Point::new(far + 0.8 * x.x - 0.6 * (x.y + bent), 3.0 * far + 0.6 * x.x + 0.8 * (x.y + bent));
            }
            let sides = ["lower.seam", "upper.seam"].map(|name| mesh.boundary(name).expect("named").edges.as_slice());
            let line = line_between(&mesh, &pair(SegmentRule::Auto), sides);
            assert_eq!(line.is_ok(), straight, "at {far}, bent by {bend}: {line:?}");
        }
    }
}

#[test]
fn a_number_of_segments_without_measure_is_refused() {
    let mesh = two_blocks();
    let partition = Rc::new(Partition::new(&mesh, &vec![0; mesh.triangles.len()], 1));
    let numbering = Numbering::new(Level { intervals: 2, order: Order::P1 }, &partition);
    let words = at_rest(&mesh, &numbering, SegmentRule::Count(100_000), [1.0, 1.0]).unwrap_err().to_string();
    assert!(words.contains("segments = 100000") && words.contains("give 128 or fewer, or \"auto\""), "{words}");
    assert!(at_rest(&mesh, &numbering, SegmentRule::Count(128), [1.0, 1.0]).is_ok());
}

#[test]
fn boundaries_that_do_not_face_each_other_are_refused() {
    let mut mesh = two_blocks();
    let upper: Vec<u32> = mesh.triangles.iter().filter(|t| t.body == 1).flat_map(|t| t.vertices).collect();
    let moved: std::collections::BTreeSet<u32> = upper.into_iter().collect();
    moved.into_iter().for_each(|vertex| mesh.vertices[vertex as usize].x += 5.0);
    let partition = Rc::new(Partition::new(&mesh, &vec![0; mesh.triangles.len()], 1));
    let numbering = Numbering::new(Level { intervals: 2, order: Order::P1 }, &partition);
    let words = at_rest(&mesh, &numbering, SegmentRule::Count(3), [1.0, 1.0]).unwrap_err();
    assert!(words.contains("do not face each other"), "{words}");
}

/// What is known of an earlier place of Γ_C stays: its ends, no farther than both bodies reach, and its number of segments.
#[test]
fn known_ends_and_segments_stay_within_the_bodies() {
    let mesh = two_blocks();
    let partition = Rc::new(Partition::new(&mesh, &vec![0; mesh.triangles.len()], 1));
    let numbering = Numbering::new(Level { intervals: 8, order: Order::P1 }, &partition);
    let pair = pair(SegmentRule::Auto);
    for (ends, found) in [([0.25, 0.75], [0.25, 0.75]), ([-0.5, 0.4], [0.0, 0.4]), ([0.6, 1.5], [0.6, 1.0])] {
        let known = Known { ends: Some(ends), segments: Some(4), ..Known::default() };
        let placed = place(&mesh, &numbering, &pair, [1.0; 2], &known, &|_| Point::zeros()).expect("a flat seam");
        assert_eq!((placed.limits, placed.boundary.segments()), ([0.0, 1.0], 4));
        let knots = placed.boundary.knots();
        assert!((knots[0] - found[0]).abs() < 1e-12 && (knots[4] - found[1]).abs() < 1e-12, "{knots:?}");
        assert!((placed.boundary.length() - 2.0 * (found[1] - found[0])).abs() < 1e-12);
    }
    for ends in [[1.2, 1.5], [0.5, 0.5 + 1e-300]] {
        let known = Known { ends: Some(ends), ..Known::default() };
        let placed = place(&mesh, &numbering, &pair, [1.0; 2], &known, &|_| Point::zeros());
        assert!(placed.err().expect("nothing there").contains("face each other nowhere over a length"));
    }
}

/// The upper block lies to the right of the lower one and above it; both are turned together.
#[test]
fn a_line_lies_half_way_and_runs_to_larger_x_however_it_is_turned() {
    for angle in [0.0f64, 30.0, 90.0, 135.0, 200.0, 270.0, 300.0] {
        let turn = nalgebra::Rotation2::new(angle.to_radians());
        for shift in [0.3, -0.3] {
            let mut mesh = two_blocks();
            let upper = mesh.bodies.iter().position(|name| name == "upper").expect("a body");
            let own = |t: &&crate::mesh::MacroTriangle| t.body as usize == upper;
            let own: std::collections::BTreeSet<u32> = mesh.triangles.iter().filter(own).flat_map(|t| t.vertices).collect();
            for (vertex, x) in mesh.vertices.iter_mut().enumerate() {
                let moved = if own.contains(&(vertex as u32)) { Point::new(shift, 0.2) } else { Point::zeros() };
                *x = turn * (*x + moved);
            }
            let mut wanted = [Point::new(0f64.max(shift), 1.1), Point::new(2f64.min(2.0 + shift), 1.1)].map(|x| turn * x);
            let along = wanted[1] - wanted[0];
            if along.x < -1e-9 || (along.x < 1e-9 && along.y < 0.0) {
                wanted.reverse();
            }
            for between in [["lower.seam", "upper.seam"], ["upper.seam", "lower.seam"]] {
                let sides = between.map(|name| mesh.boundary(name).expect("named").edges.as_slice());
                let (curve, limits) = line_between(&mesh, &pair(SegmentRule::Auto), sides).expect("two lines");
                assert_eq!(limits, [0.0, 1.0]);
                let off = [0, 1].map(|k| (curve.point(limits[k]) - wanted[k]).norm());
                assert!(off.iter().all(|off| *off < 1e-12), "{angle}, {shift}: {curve:?} instead of {wanted:?}");
            }
        }
    }
}

/// A circle of radius 10 through the seam, of which the upper block has 0.4 to 1.6 only, turned so that its parameter begins
/// anew anywhere on it.
#[test]
fn a_shared_circle_reaches_as_far_as_both_bodies_wherever_its_parameter_begins() {
    let height = 99f64.sqrt();
    for angle in [0.0f64, -90.0, -84.5, -86.5, -92.0, -95.5, 100.0] {
        let turn = nalgebra::Rotation2::new(angle.to_radians());
        let mut mesh = two_blocks();
        let upper = mesh.bodies.iter().position(|name| name == "upper").expect("a body");
        let own = |t: &&crate::mesh::MacroTriangle| t.body as usize == upper;
        let own: std::collections::BTreeSet<u32> = mesh.triangles.iter().filter(own).flat_map(|t| t.vertices).collect();
        for (vertex, x) in mesh.vertices.iter_mut().enumerate() {
            let is_upper = own.contains(&(vertex as u32));
            *x = turn * if is_upper { Point::new(0.4 + 0.6 * x.x, x.y) } else { *x };
        }
        let centre = turn * Point::new(1.0, 1.0 - height);
        let circle = Curve::Circle { centre: [centre.x, centre.y], radius: 10.0 };
        mesh.bend("arc", &["lower.seam".into(), "upper.seam".into()], &circle).expect("near the circle");
        for between in [["lower.seam", "upper.seam"], ["upper.seam", "lower.seam"]] {
            let sides = between.map(|name| mesh.boundary(name).expect("named").edges.as_slice());
            let (curve, [from, to]) = shared_geometry(&mesh, &pair(SegmentRule::Auto), sides).expect("a circle");
            let half = (0.6 / (0.36 + height * height).sqrt()).asin();
            assert!((to - from - 2.0 * half).abs() < 1e-9, "{angle}: {} instead of {}", to - from, 2.0 * half);
            let top = centre + turn * Point::new(0.0, 10.0);
            assert!((curve.point(0.5 * (from + to)) - top).norm() < 1e-9, "{angle}");
        }
    }
}

#[test]
fn bodies_on_other_parts_of_a_circle_do_not_face_each_other() {
    let mut mesh = two_blocks();
    let circle = Curve::Circle { centre: [1.0, 1.0 - 99f64.sqrt()], radius: 10.0 };
    mesh.bend("arc", &["lower.seam".into(), "upper.seam".into()], &circle).expect("near the circle");
    let upper = mesh.boundary("upper.seam").expect("named").edges.clone();
    let (first, second) = (&upper[..1], &upper[1..]);
    let words = shared_geometry(&mesh, &pair(SegmentRule::Auto), [first, second]).expect_err("side by side");
    assert!(words.contains("no extent in common"), "{words}");
}

#[test]
fn edges_that_look_away_from_the_boundary_do_not_face_it() {
    let mesh = two_blocks();
    let partition = Rc::new(Partition::new(&mesh, &vec![0; mesh.triangles.len()], 1));
    let numbering = Numbering::new(Level { intervals: 2, order: Order::P1 }, &partition);
    let line = Curve::Line([[0.0, 1.0], [2.0, 1.0]]);
    let boundary = ContactBoundary::new(line, [0.0, 1.0], Point::new(0.0, 1.0));
    for (name, first, second) in
        [("lower.seam", true, false), ("top", true, false), ("upper.seam", false, true), ("bottom", false, true)]
    {
        let edges = &mesh.boundary(name).expect("named").edges;
        for edge in edges.iter().flat_map(|&edge| BoundaryEdge::all_of(&mesh, edge, &numbering)) {
            let found = [Side::First, Side::Second].map(|side| faces(&boundary, side, &edge));
            assert_eq!(found, [first, second], "{name}");
        }
    }
}

/// Faces of one boundary, one behind the other, as those of two teeth of a gear: the one behind was taken for a part of the contact,
/// whose forces on the two bodies differed by all of one.
#[test]
fn what_lies_behind_another_edge_is_left_out() {
    let mesh = two_blocks();
    let partition = Rc::new(Partition::new(&mesh, &vec![0; mesh.triangles.len()], 1));
    let numbering = Numbering::new(Level { intervals: 2, order: Order::P1 }, &partition);
    let boundary = ContactBoundary::new(Curve::Line([[0.0, 1.0], [2.0, 1.0]]), [0.1, 0.9], Point::new(0.0, 1.0));
    let edges_of = |name: &str| {
        let edges = &mesh.boundary(name).expect("named").edges;
        edges.iter().flat_map(|&edge| BoundaryEdge::all_of(&mesh, edge, &numbering)).collect::<Vec<_>>()
    };
    for names in [["lower.seam", "top"], ["top", "lower.seam"]] {
        let mut edges = names.map(edges_of).concat();
        leave_what_looks_at(&boundary, Side::First, &mut edges);
        assert_eq!(edges.len(), edges_of("lower.seam").len(), "{names:?}");
        assert!(edges.iter().all(|edge| edge.points[0].y == 1.0), "{names:?}");
    }
}

/// The outline of the lower block around a circle in its middle, whole and with an edge left out, for a part of it and for all.
#[test]
fn a_closed_boundary_needs_edges_all_around() {
    let mesh = two_blocks();
    let lower = mesh.bodies.iter().position(|name| name == "lower").expect("a body");
    let outline = |edge: &u32| mesh.edges[*edge as usize].triangles[1].is_none() && mesh.body_beside(*edge) == lower;
    let outline: Vec<u32> = (0..mesh.edges.len() as u32).filter(outline).collect();
    assert_eq!(outline.len(), 4);
    let circle = Curve::Circle { centre: [1.0, 0.5], radius: 0.4 };
    let part = ContactBoundary::new(circle.clone(), [-0.1, 0.1], Point::new(1.0, 0.0));
    let cover = |edges: &[u32]| check_cover(&mesh, &pair(SegmentRule::Auto), [edges, edges], &part);
    let whole = ContactBoundary::new(circle, [1.0, 8.0], Point::new(1.0, 0.0));
    let cover_all = |edges: &[u32]| check_cover(&mesh, &pair(SegmentRule::Auto), [edges, edges], &whole);
    assert_eq!((cover(&outline), cover_all(&outline)), (Ok(()), Ok(())));
    assert!(cover_all(&outline[1..]).expect_err("open").contains("\"lower.seam\" has a hole between"));
    let right = |edge: &u32| mesh.edges[*edge as usize].vertices.iter().all(|&vertex| mesh.vertices[vertex as usize].x == 2.0);
    let kept: Vec<u32> = outline.iter().copied().filter(right).collect();
    assert_eq!((kept.len(), cover(&kept)), (1, Ok(())), "the one before it covers the part");
}

/// Pieces of a circle in any order, each with parameters of some turn of it.
#[test]
fn what_pieces_of_a_circle_cover_is_a_turn_less_the_widest_gap() {
    use std::f64::consts::TAU;
    let near = |found: [f64; 2], wanted: [f64; 2]| {
        let turns = ((wanted[0] - found[0]) / TAU).round() * TAU;
        assert!((0..2).all(|k| (found[k] + turns - wanted[k]).abs() < 1e-9), "{found:?} instead of {wanted:?}");
    };
    for from in [0.0, 1.0, -2.5, 6.2] {
        for width in [0.5, 3.0, 6.0] {
            let piece = |k: u32| {
                let [a, b] = [k, k + 1].map(|k| from + width * f64::from(k) / 10.0);
                [a, b].map(|t| t + f64::from(7 * k % 3) * TAU)
            };
            let pieces: Vec<[f64; 2]> = [3, 9, 0, 5, 7, 1, 2, 8, 6, 4].map(piece).to_vec();
            near(extent(pieces, Some(TAU)), [from, from + width]);
        }
        let whole: Vec<[f64; 2]> = (0..10).map(|k| [k, k + 1].map(|k| from + TAU * f64::from(k) / 10.0)).collect();
        near(extent(whole, Some(TAU)), [0.0, TAU]);
    }
    assert_eq!(extent(vec![[2.0, 3.0], [-1.0, 0.5]], None), [-1.0, 3.0]);
}

#[test]
fn what_two_arcs_have_in_common_may_lie_across_the_seam() {
    use std::f64::consts::TAU;
    let circle = Curve::Circle { centre: [0.0, 0.0], radius: 1.0 };
    let common = |first: [f64; 2], second: [f64; 2]| common_extents([first, second], &circle);
    let whole = [0.0, TAU];
    assert_eq!(common(whole, whole), [whole]);
    assert_eq!(common(whole, [-1.0, 2.0]), [[-1.0, 2.0]]);
    assert_eq!(common([5.0, 7.0], whole), [[5.0, 7.0]]);
    let found = common([-1.0, 1.0], [TAU - 0.5, TAU + 2.0]);
    assert!(found.len() == 1 && (found[0][0] + 0.5).abs() < 1e-9 && (found[0][1] - 1.0).abs() < 1e-9, "{found:?}");
    assert_eq!(common([0.0, 1.0], [2.0, 3.0]), Vec::<[f64; 2]>::new());
    assert_eq!(common([0.0, 1.0], [1.0, TAU]).len(), 0, "they touch at both ends");
    assert_eq!(common([-2.0, 2.0], [1.0, TAU - 1.0]).len(), 2, "on two stretches");
}
