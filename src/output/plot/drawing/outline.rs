//! From triangles to the loops around them, and paths of SVG, whose coordinates are tenths of a pixel.

use std::collections::BTreeMap;

/// Coordinates beyond this are drawn there (pixels): far from every figure, and differences of them are numbers too.
const FARTHEST: f64 = 1e6;

/// A place (pixels) as paths have it; None if it is not finite.
pub fn tenths(place: [f64; 2]) -> Option<(i32, i32)> {
    let [x, y] = place.map(|at| (10.0 * at.clamp(-FARTHEST, FARTHEST)).round() as i32);
    place.iter().all(|at| at.is_finite()).then_some((x, y))
}

/// The directed edges without a partner in the opposite direction: of triangles that all run the same way round, their boundary.
pub fn unmatched<K: Ord + Copy>(edges: impl IntoIterator<Item = [K; 2]>) -> Vec<[K; 2]> {
    let sorted = |[from, to]: [K; 2]| if from < to { ([from, to], 1) } else { ([to, from], -1) };
    let mut edges: Vec<([K; 2], i32)> = edges.into_iter().filter(|[from, to]| from != to).map(sorted).collect();
    edges.sort_unstable();
    let surplus = edges.chunk_by(|a, b| a.0 == b.0).flat_map(|same| {
        let ([low, high], count) = (same[0].0, same.iter().map(|(_, direction)| direction).sum::<i32>());
        let edge = if count > 0 { [low, high] } else { [high, low] };
        std::iter::repeat_n(edge, count.unsigned_abs() as usize)
    });
    surplus.collect()
}

/// The edges around a polygon, given by its corners (pixels).
pub fn edges_around(corners: impl IntoIterator<Item = [f64; 2]>) -> impl Iterator<Item = [(i32, i32); 2]> {
    let points: Vec<(i32, i32)> = corners.into_iter().filter_map(tenths).collect();
    (0..points.len()).map(move |k| [points[k], points[(k + 1) % points.len()]])
}

/// The path around the areas that polygons make up together; edges that two of them share are no part of it.
pub fn merged(edges: impl IntoIterator<Item = [(i32, i32); 2]>) -> String {
    path_data(&loops(&unmatched(edges)))
}

/// Joins directed edges head to tail into closed loops. As many edges must leave each point as arrive at it, which holds for
/// every boundary.
pub fn loops<K: Ord + Copy>(edges: &[[K; 2]]) -> Vec<Vec<K>> {
    let mut leaving: BTreeMap<K, Vec<K>> = BTreeMap::new();
    for &[from, to] in edges {
        leaving.entry(from).or_default().push(to);
    }
    let mut found = Vec::new();
    for [start, _] in edges {
        let mut points = vec![*start];
        while let Some(next) = leaving.get_mut(&points[points.len() - 1]).and_then(Vec::pop) {
            points.push(next);
        }
        points.pop(); // the start again
        found.extend((!points.is_empty()).then_some(points));
    }
    found
}

/// Closed loops as the `d` of an SVG path.
pub fn path_data(loops: &[Vec<(i32, i32)>]) -> String {
    loops.iter().map(|points| line_data(points, true)).collect()
}

/// A line from point to point, or a closed one, as the `d` of an SVG path; points inside straight runs are left out. Nothing if
/// all of it is one point.
pub fn line_data(points: &[(i32, i32)], is_closed: bool) -> String {
    // Of many points that fall on one place of a figure, none would be seen to turn.
    let mut points = points.to_vec();
    points.dedup();
    if is_closed && points.first() == points.last() {
        points.pop();
    }
    let count = points.len();
    let around = |i: usize| [points[(i + count - 1) % count], points[i], points[(i + 1) % count]];
    let is_corner = |i: &usize| !is_closed && (*i == 0 || *i + 1 == count) || turns(around(*i));
    let corners: Vec<(i32, i32)> = (0..count).filter(is_corner).map(|i| points[i]).collect();
    let [(x, y), _, ..] = corners[..] else { return String::new() };
    let steps: Vec<String> = corners.windows(2).map(|two| format!("{} {}", two[1].0 - two[0].0, two[1].1 - two[0].1)).collect();
    format!("M{x} {y}l{}{}", steps.join(" "), if is_closed { "z" } else { "" })
}

/// Whether the way from point to point changes its direction at the middle one.
fn turns([a, b, c]: [(i32, i32); 3]) -> bool {
    let [x, y, u, v] = [b.0 - a.0, b.1 - a.1, c.0 - b.0, c.1 - b.1].map(i64::from);
    x * v != y * u || x * u + y * v < 0
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two triangles of each unit square, counter-clockwise.
    fn triangles(squares: &[(i32, i32)]) -> Vec<[(i32, i32); 2]> {
        let mut edges = Vec::new();
        for &(x, y) in squares {
            let [a, b, c, d] = [(x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)];
            for [p, q, r] in [[a, b, c], [a, c, d]] {
                edges.extend([[p, q], [q, r], [r, p]]);
            }
        }
        edges
    }

    /// Twice the area inside loops: counter-clockwise positive, holes negative.
    fn twice_area(loops: &[Vec<(i32, i32)>]) -> i32 {
        let cross = |p: (i32, i32), q: (i32, i32)| p.0 * q.1 - p.1 * q.0;
        loops.iter().map(|points| (0..points.len()).map(|i| cross(points[i], points[(i + 1) % points.len()])).sum::<i32>()).sum()
    }

    #[test]
    fn ring_of_squares_has_two_loops() {
        let squares: Vec<(i32, i32)> = (0..9).filter(|&i| i != 4).map(|i| (i % 3, i / 3)).collect();
        let found = loops(&unmatched(triangles(&squares)));
        assert_eq!(found.len(), 2);
        assert_eq!(twice_area(&found), 16);
    }

    #[test]
    fn collapsed_and_doubled_triangles_keep_the_balance() {
        let mut edges = triangles(&[(0, 0), (5, 5), (5, 5)]);
        edges.extend([[(0, 0), (1, 0)], [(1, 0), (1, 0)], [(1, 0), (0, 0)]]);
        let found = loops(&unmatched(edges));
        assert_eq!(twice_area(&found), 6);
    }

    #[test]
    fn corners_of_many_points_stay() {
        let square = [(0, 0), (0, 0), (2, 0), (4, 0), (4, 0), (4, 0), (4, 4), (0, 4), (0, 0)];
        assert_eq!(path_data(&[square.to_vec()]), "M0 0l4 0 0 4 -4 0z");
        assert_eq!(line_data(&[(0, 0), (4, 0), (4, 0), (4, 4), (4, 4)], false), "M0 0l4 0 0 4");
        assert_eq!([true, false].map(|is_closed| line_data(&[(3, 4), (3, 4)], is_closed)), ["", ""], "a point is no line");
    }

    #[test]
    fn straight_runs_become_one_line() {
        assert_eq!(merged(triangles(&[(0, 0), (1, 0), (2, 0)])), "M0 1l0 -1 3 0 0 1z");
    }
}
