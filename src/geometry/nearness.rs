//! Which of many discs lie near each other, without a look at every pair.

use super::Point;

/// Direction along which discs are sorted. No boundary is drawn across it but by accident, so few discs of a boundary begin at
/// the same place.
const DIRECTION: Point = Point::new(0.540_302_305_868_139_8, 0.841_470_984_807_896_5);

/// A disc: what may be near lies within its radius.
#[derive(Clone, Copy, Debug)]
pub struct Disc {
    /// Middle of the disc.
    pub middle: Point,
    /// Radius of the disc (length).
    pub radius: f64,
}

impl Disc {
    fn interval(&self) -> [f64; 2] {
        let at = self.middle.dot(&DIRECTION);
        [at - self.radius, at + self.radius]
    }
}

/// Shows every pair of a disc of the first and one of the second list that overlap or touch, by their indices, in no special
/// order. For discs along two boundaries the work is that of sorting them.
pub fn overlapping_discs(first: &[Disc], second: &[Disc], mut show: impl FnMut(usize, usize)) {
    sweep(first, second, |a, b| {
        if (first[a].middle - second[b].middle).norm() <= first[a].radius + second[b].radius {
            show(a, b);
        }
    });
}

/// The pairs that overlap along the direction: discs in the order in which they begin, each against those of the other list that
/// have not ended.
fn sweep(first: &[Disc], second: &[Disc], mut show: impl FnMut(usize, usize)) {
    let of_list = |list: usize, discs: &[Disc]| -> Vec<(f64, usize, usize)> {
        discs.iter().enumerate().map(|(at, disc)| (disc.interval()[0], list, at)).collect()
    };
    let mut beginnings = [of_list(0, first), of_list(1, second)].concat();
    beginnings.sort_by(|a, b| a.0.total_cmp(&b.0));
    let discs = [first, second];
    let mut open: [Vec<usize>; 2] = Default::default();
    for (start, list, at) in beginnings {
        let other = 1 - list;
        open[other].retain(|&k| discs[other][k].interval()[1] >= start);
        for &k in &open[other] {
            if list == 0 { show(at, k) } else { show(k, at) }
        }
        open[list].retain(|&k| discs[list][k].interval()[1] >= start);
        open[list].push(at);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Discs along a path, which touch those before and behind them.
    fn along(count: usize, place: impl Fn(f64) -> Point) -> Vec<Disc> {
        let at = |k: usize| place(k as f64 / count as f64);
        (0..count).map(|k| Disc { middle: 0.5 * (at(k) + at(k + 1)), radius: 0.5 * (at(k + 1) - at(k)).norm() }).collect()
    }

    #[test]
    fn the_number_of_pairs_that_are_looked_at_grows_as_the_number_of_discs() {
        let count = 100_000;
        let paths: [fn(f64) -> Point; 4] = [
            |s| Point::new(s, 0.0),
            |s| Point::new(1e6, 1e6 * s),
            |s| Point::new(s, s),
            |s| Point::new((std::f64::consts::TAU * s).cos(), (std::f64::consts::TAU * s).sin()),
        ];
        for path in paths {
            let discs = along(count, path);
            let (mut looks, mut pairs) = (0, 0);
            sweep(&discs, &discs, |_, _| looks += 1);
            overlapping_discs(&discs, &discs, |_, _| pairs += 1);
            assert!(pairs >= count, "each with itself");
            assert!(looks <= 30 * count, "{looks} pairs were looked at");
        }
    }

    proptest! {
        #[test]
        fn all_pairs_that_overlap_are_found_once(values in proptest::collection::vec((-1.0..1.0, -1.0..1.0, 0.0..0.5), 0..60)) {
            let discs: Vec<Disc> = values.iter().map(|&(x, y, radius)| Disc { middle: Point::new(x, y), radius }).collect();
            let (first, second) = discs.split_at(discs.len() / 3);
            let mut found = Vec::new();
            overlapping_discs(first, second, |a, b| found.push((a, b)));
            found.sort_unstable();
            let near = |a: &Disc, b: &Disc| (a.middle - b.middle).norm() <= a.radius + b.radius;
            let all = (0..first.len()).flat_map(|a| (0..second.len()).map(move |b| (a, b)));
            prop_assert_eq!(found, all.filter(|&(a, b)| near(&first[a], &second[b])).collect::<Vec<_>>());
        }
    }
}
