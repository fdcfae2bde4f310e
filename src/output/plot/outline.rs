//! From triangles to the loops around them, and paths of SVG.

use std::collections::BTreeMap;
use std::fmt::Write;

use super::sheet::PIXEL;

/// The directed edges without a partner in the opposite direction: of triangles that all run the same way round, their boundary.
pub(super) fn unmatched<K: Ord + Copy>(edges: impl IntoIterator<Item = [K; 2]>) -> Vec<[K; 2]> {
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

/// The edges around a polygon.
pub(super) fn edges_around<K: Copy>(points: &[K]) -> impl Iterator<Item = [K; 2]> {
    (0..points.len()).map(|k| [points[k], points[(k + 1) % points.len()]])
}

/// Joins directed edges head to tail into closed loops. As many edges must leave each point as arrive at it, which holds for
/// every boundary.
pub(super) fn loops<K: Ord + Copy>(edges: &[[K; 2]]) -> Vec<Vec<K>> {
    let mut leaving: BTreeMap<K, Vec<K>> = BTreeMap::new();
    for &[from, to] in edges {
        leaving.entry(from).or_default().push(to);
    }
    let mut found = Vec::new();
    while let Some((&start, _)) = leaving.first_key_value() {
        let mut points = vec![start];
        while let Some(next) = take_edge(&mut leaving, points[points.len() - 1]) {
            points.push(next);
        }
        points.pop(); // the start again
        found.push(points);
    }
    found
}

/// Removes an edge that leaves a point, and returns its other end.
fn take_edge<K: Ord + Copy>(leaving: &mut BTreeMap<K, Vec<K>>, from: K) -> Option<K> {
    let ends = leaving.get_mut(&from)?;
    let end = ends.pop();
    if ends.is_empty() {
        leaving.remove(&from);
    }
    end
}

/// Closed loops of figure coordinates as the `d` of an SVG path; points inside straight runs are left out.
pub(super) fn path_data(loops: &[Vec<(i32, i32)>]) -> String {
    let mut text = String::new();
    for points in loops {
        let mut points = distinct(points);
        if points.len() > 1 && points.first() == points.last() {
            points.pop();
        }
        let corners: Vec<(i32, i32)> = (0..points.len()).filter(|&i| is_corner(&points, i)).map(|i| points[i]).collect();
        if !corners.is_empty() {
            text += &steps(&corners);
            text.push('z');
        }
    }
    text
}

/// An open line of figure coordinates as the `d` of an SVG path; points inside straight runs are left out.
pub(super) fn line_data(points: &[(i32, i32)]) -> String {
    let points = distinct(points);
    let inner = |i: &usize| *i == 0 || i + 1 == points.len() || turns([points[i - 1], points[*i], points[i + 1]]);
    let corners: Vec<(i32, i32)> = (0..points.len()).filter(inner).map(|i| points[i]).collect();
    steps(&corners)
}

/// A line from corner to corner, each by its way from the one before.
fn steps(corners: &[(i32, i32)]) -> String {
    let Some((x, y)) = corners.first() else { return String::new() };
    let mut text = format!("M{x} {y}l");
    for two in corners.windows(2) {
        let _ = write!(text, "{} {} ", two[1].0 - two[0].0, two[1].1 - two[0].1);
    }
    text.trim_end().to_owned()
}

/// A line from point to point, each by its place (pixels).
pub(super) fn straight(points: impl IntoIterator<Item = [f64; 2]>) -> String {
    let p = f64::from(PIXEL);
    let to = |(k, [x, y]): (usize, [f64; 2])| format!("{}{:.0} {:.0}", if k == 0 { 'M' } else { 'L' }, p * x, p * y);
    points.into_iter().enumerate().map(to).collect()
}

/// The points without repeats: of many that fall on one place of a figure, none would be seen to turn.
fn distinct(points: &[(i32, i32)]) -> Vec<(i32, i32)> {
    let mut points = points.to_vec();
    points.dedup();
    points
}

/// Whether a loop changes its direction at a point.
fn is_corner(points: &[(i32, i32)], i: usize) -> bool {
    let count = points.len();
    turns([points[(i + count - 1) % count], points[i], points[(i + 1) % count]])
}

/// Whether the way from point to point changes its direction at the middle one.
fn turns([a, b, c]: [(i32, i32); 3]) -> bool {
    let (first, second) = ((b.0 - a.0, b.1 - a.1), (c.0 - b.0, c.1 - b.1));
    let cross = i64::from(first.0) * i64::from(second.1) - i64::from(first.1) * i64::from(second.0);
    let dot = i64::from(first.0) * i64::from(second.0) + i64::from(first.1) * i64::from(second.1);
    cross != 0 || dot < 0
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
        assert_eq!(line_data(&[(0, 0), (4, 0), (4, 0), (4, 4), (4, 4)]), "M0 0l4 0 0 4");
    }

    #[test]
    fn straight_runs_become_one_line() {
        let found = loops(&unmatched(triangles(&[(0, 0), (1, 0), (2, 0)])));
        assert_eq!(path_data(&found), "M0 0l3 0 0 1 -3 0z");
    }
}
