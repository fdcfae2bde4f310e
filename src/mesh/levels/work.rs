//! Which macro triangles solvers work on as a whole, and how much work each one is: what ranks are dealt equal shares of.

use crate::element::Order;
use crate::mesh::lattice;
use crate::mesh::levels::numbering::{Level, levels};
use crate::mesh::macro_mesh::MacroMesh;

/// Bytes that a smoother moves for each node of an even macro triangle: right-hand side, unknowns read, unknowns written.
const NODE: f64 = 48.0;

/// Bytes that stand for each coupling of such a node. Its block stays in the processor; its four products cost as much time as so
/// many bytes.
const EVEN_COUPLING: f64 = 4.0;

/// Bytes that a smoother moves for each coupling of a stored row: a block and the number of its column.
const STORED_COUPLING: f64 = 36.0;

/// The same inside of a graded macro triangle, whose rows share their blocks: the number of the column, and the time of the products.
const SHARED_COUPLING: f64 = 4.0 + EVEN_COUPLING;

/// Bytes that a smoother moves for the inverse of the diagonal block of a stored row.
const INVERSE: f64 = 32.0;

/// Weights are no finer than this share of the smallest one; enough for a balance of 1 %.
const FINEST: f64 = 64.0;

/// Sum of all weights at most: partitioners count with 32 bits.
const MOST: f64 = (1 << 30) as f64;

/// Lattice intervals from which an even macro triangle is worked on as a whole, P1 and P2. On coarser lattices the work is less than
/// that of bringing their values together.
const WHOLE_FROM: [usize; 2] = [8, 16];

impl MacroMesh {
    /// Whether all triangles of a macro triangle at a level have one stiffness: they are translations and point reflections of one
    /// another, in the plane.
    pub fn is_even(&self, triangle: usize, level: Level) -> bool {
        self.repeats(triangle) && self.shapes(triangle, level).is_one()
    }

    /// Whether the inner nodes of a macro triangle are worked on as a whole, so that their rows are not stored.
    pub fn is_whole(&self, triangle: usize, level: Level) -> bool {
        level.intervals >= WHOLE_FROM[usize::from(level.order == Order::P2)] && self.is_even(triangle, level)
    }

    /// Work of each macro triangle in one cycle of multigrid, as weights for a partitioner: whole numbers without a common
    /// divisor, all 1 if all macro triangles are alike.
    ///
    /// Counted are the bytes that a sweep moves, on each level as often as an F-cycle comes there (`k + 1` times on the `k`-th
    /// level below the finest). An inner node of an even macro triangle that is worked on as a whole costs its values alone; of a
    /// stored row all couplings are read, 7 for P1, 11.5 for P2 in the mean, but the rows inside of a graded one share their blocks. So a
    /// bent macro triangle is several times the work of an even straight one, and a graded one lies between them.
    pub fn work(&self, order: Order, refine: usize) -> Vec<i32> {
        let levels = levels(order, refine);
        let mut known = [None; 3];
        let works: Vec<f64> = (0..self.triangles.len())
            .map(|triangle| {
                let kind = usize::from(self.repeats(triangle)) + usize::from(self.is_even(triangle, levels[levels.len() - 1]));
                *known[kind].get_or_insert_with(|| self.cycle_work(triangle, &levels))
            })
            .collect();
        whole_numbers(&works)
    }

    fn cycle_work(&self, triangle: usize, levels: &[Level]) -> f64 {
        let visits = levels.iter().rev().zip(1..);
        visits.map(|(level, visits)| f64::from(visits) * self.sweep_work(triangle, *level)).sum()
    }

    /// Bytes of a sweep over the nodes of one macro triangle, each of its sides being shared with another.
    fn sweep_work(&self, triangle: usize, level: Level) -> f64 {
        let nodes = 0.5 * (level.intervals * level.intervals) as f64;
        let couplings = if level.order == Order::P1 { 7.0 } else { 11.5 };
        let inside = if self.repeats(triangle) { lattice::inner_count(level.intervals) as f64 } else { 0.0 };
        let of_inside = match self.is_whole(triangle, level) {
            true => EVEN_COUPLING * couplings,
            false => INVERSE + SHARED_COUPLING * couplings,
        };
        NODE * nodes + of_inside * inside + (INVERSE + STORED_COUPLING * couplings) * (nodes - inside).max(0.0)
    }
}

fn whole_numbers(works: &[f64]) -> Vec<i32> {
    let least = works.iter().copied().fold(f64::INFINITY, f64::min);
    let whole: f64 = works.iter().map(|work| work / least).sum();
    let unit = FINEST.min(MOST / whole).max(1.0);
    let weights: Vec<i32> = works.iter().map(|work| (unit * work / least).round() as i32).collect();
    let divisor = weights.iter().copied().fold(0, greatest_common_divisor).max(1);
    weights.into_iter().map(|weight| weight / divisor).collect()
}

fn greatest_common_divisor(a: i32, b: i32) -> i32 {
    if b == 0 { a } else { greatest_common_divisor(b, a % b) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Curve;
    use crate::mesh::samples::two_blocks;

    #[test]
    fn macro_triangles_that_are_alike_are_equal_work() {
        let mesh = two_blocks();
        for (order, refine) in [(Order::P1, 0), (Order::P1, 6), (Order::P2, 5)] {
            assert_eq!(mesh.work(order, refine), vec![1; mesh.triangles.len()]);
        }
    }

    #[test]
    fn bent_ones_are_the_most_work_and_graded_ones_more_than_even_ones() {
        let mut mesh = two_blocks();
        let circle = Curve::Circle { centre: [1.0, -2.0], radius: 10f64.sqrt() };
        mesh.bend("arc", &["lower.seam".into()], &circle).expect("the ends lie on it");
        mesh.grade([2.0, 2.0].into(), 0.2).expect("a vertex");
        for (order, refine) in [(Order::P1, 6), (Order::P2, 6)] {
            let work = mesh.work(order, refine);
            let of = |kind: fn(&MacroMesh, usize) -> bool| {
                let own = (0..work.len()).filter(|&triangle| kind(&mesh, triangle)).map(|triangle| f64::from(work[triangle]));
                own.collect::<Vec<_>>()
            };
            let (bent, graded) = (of(|mesh, t| mesh.is_curved(t)), of(|mesh, t| mesh.is_graded(t)));
            let even = of(|mesh, t| !mesh.is_graded(t) && !mesh.is_curved(t));
            assert!(even.iter().all(|work| *work == even[0]) && bent.len() == 1);
            assert!(
                !graded.is_empty() && graded.iter().all(|work| (1.05 * even[0]..bent[0]).contains(work)),
                "{graded:?} {even:?}"
            );
            assert!(bent[0] > 2.0 * even[0], "{order:?}: {bent:?} {even:?}");
        }
    }

    #[test]
    fn even_macro_triangles_of_any_size_are_worked_on_as_a_whole_and_no_others() {
        let mut mesh = two_blocks();
        let level = |order, intervals| Level { order, intervals };
        for (order, from) in [(Order::P1, 8), (Order::P2, 16)] {
            let whole = [from / 2, from, 32 * from].map(|intervals| mesh.is_whole(0, level(order, intervals)));
            assert_eq!(whole, [false, true, true], "{order:?}");
        }
        let circle = Curve::Circle { centre: [1.0, -2.0], radius: 10f64.sqrt() };
        mesh.bend("arc", &["lower.seam".into()], &circle).expect("the ends lie on it");
        mesh.grade([2.0, 2.0].into(), 0.2).expect("a vertex");
        for triangle in (0..mesh.triangles.len()).filter(|&t| mesh.is_graded(t) || mesh.is_curved(t)) {
            assert!(!mesh.is_whole(triangle, level(Order::P2, 32)), "{triangle}");
        }
        mesh.plane = crate::element::Plane::Revolution;
        assert!((0..mesh.triangles.len()).all(|triangle| !mesh.is_whole(triangle, level(Order::P1, 32))), "rings differ");
    }

    #[test]
    fn a_mesh_without_refinement_has_equal_work() {
        let mut mesh = two_blocks();
        let circle = Curve::Circle { centre: [1.0, -2.0], radius: 10f64.sqrt() };
        mesh.bend("arc", &["lower.seam".into()], &circle).expect("the ends lie on it");
        assert_eq!(mesh.work(Order::P2, 0), vec![1; mesh.triangles.len()]);
    }

    #[test]
    fn weights_stay_below_what_32_bits_count() {
        let many = [vec![1.0; 3_000_000], vec![1000.0; 1_000_000]].concat();
        let weights = whole_numbers(&many);
        assert!(weights.iter().map(|&weight| i64::from(weight)).sum::<i64>() <= i64::from(i32::MAX));
        assert!(weights.iter().all(|&weight| weight >= 1));
    }
}
