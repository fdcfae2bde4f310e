//! The nearest of the points along a curve, without a look at every one.

use super::Point;
use std::ops::Range;

/// Points, or groups of them, in one group of the next level. It changes no result; values beside it were not timed.
const IN_A_GROUP: usize = 8;

/// Points in the order of a curve, so that those that follow each other lie close together.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PointRow {
    points: Vec<Point>,
    /// Groups of points, groups of these, and so on: discs that hold them.
    levels: Vec<Vec<(Point, f64)>>,
}

/// A point that was found: the square of its distance, and its number.
type Found = (f64, usize);

impl PointRow {
    /// Of points in their order.
    pub fn new(points: Vec<Point>) -> Self {
        let mut levels = Vec::new();
        let mut members: Vec<(Point, f64)> = points.iter().map(|point| (*point, 0.0)).collect();
        while members.len() > IN_A_GROUP {
            members = members.chunks(IN_A_GROUP).map(around).collect();
            levels.push(members.clone());
        }
        Self { points, levels }
    }

    /// All points shifted by a vector (length).
    pub fn shift(&mut self, by: Point) {
        self.points.iter_mut().chain(self.levels.iter_mut().flatten().map(|(middle, _)| middle)).for_each(|point| *point += by);
    }

    /// Number of the point nearest to `p`, the first of those that are as near.
    pub fn nearest(&self, p: Point) -> usize {
        self.least(&mut |point| (point - p).norm_squared())
    }

    /// Number of the point with the least square of a distance.
    fn least(&self, square: &mut impl FnMut(Point) -> f64) -> usize {
        let mut best = (f64::INFINITY, 0);
        let highest = self.levels.last().map_or(self.points.len(), Vec::len);
        self.search(self.levels.len(), 0..highest, square, &mut best);
        best.1
    }

    /// Looks through some groups of a level, the nearest one first; the lowest level is that of the points.
    fn search(&self, level: usize, members: Range<usize>, square: &mut impl FnMut(Point) -> f64, best: &mut Found) {
        let Some(below) = level.checked_sub(1) else {
            let found = members.map(|k| (square(self.points[k]), k));
            *best = found.fold(*best, |best, found| if found < best { found } else { best });
            return;
        };
        let groups = &self.levels[below];
        let count = if below == 0 { self.points.len() } else { self.levels[below - 1].len() };
        // Rounding must not hide a point as near as the best.
        let mut least = |(middle, radius): (Point, f64)| (square(middle).sqrt() * (1.0 - 1e-12) - radius).max(0.0).powi(2);
        let mut near = [(f64::INFINITY, 0); IN_A_GROUP];
        near.iter_mut().zip(members.clone()).for_each(|(near, k)| *near = (least(groups[k]), k));
        let near = &mut near[..members.len()];
        near.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        for &mut (away, k) in near {
            if away <= best.0 {
                self.search(below, IN_A_GROUP * k..count.min(IN_A_GROUP * (k + 1)), square, best);
            }
        }
    }
}

/// A disc around some discs.
fn around(members: &[(Point, f64)]) -> (Point, f64) {
    let middle = members.iter().map(|(point, _)| point).sum::<Point>() / members.len() as f64;
    (middle, members.iter().map(|(point, radius)| (point - middle).norm() + radius).fold(0.0, f64::max))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn the_work_hardly_grows_with_the_number_of_points() {
        let looks = |count: usize| {
            let row = PointRow::new((0..=count).map(|k| Point::new(k as f64 / count as f64, 0.0)).collect());
            let mut looks = 0;
            for k in 0..100 {
                let p = Point::new(0.01 * f64::from(k), 1e-3);
                row.least(&mut |point| {
                    looks += 1;
                    (point - p).norm_squared()
                });
            }
            looks
        };
        let [few, many] = [10_000, 40_000].map(looks);
        assert!(many < 2 * few && many < 100 * 200, "{few} and {many} looks");
    }

    proptest! {
        #[test]
        fn it_is_the_first_of_the_nearest(
            places in proptest::collection::vec((-9..9, -9..9), 1..200), p in (-9..9, -9..9), by in -1e3..1e3,
        ) {
            let point = |(x, y): (i32, i32)| Point::new(f64::from(x), f64::from(y));
            let (points, p): (Vec<Point>, Point) = (places.into_iter().map(point).collect(), point(p));
            let away = |k: &usize| (points[*k] - p).norm_squared();
            let exact = (0..points.len()).min_by(|a, b| away(a).total_cmp(&away(b))).expect("a point");
            let mut row = PointRow::new(points.clone());
            prop_assert_eq!(row.nearest(p), exact);
            // Whole numbers stay exact.
            let by = Point::new(f64::round(by), -f64::round(by));
            row.shift(by);
            prop_assert_eq!(row.nearest(p + by), exact);
        }
    }
}
