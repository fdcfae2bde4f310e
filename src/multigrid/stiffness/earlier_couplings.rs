//! Couplings of stored rows with nodes that a sweep relaxes earlier: from zero it needs no others.

use super::stored_rows::StoredRows;
use super::strip_set::Strips;
use super::sweep_order::SweepOrder;

/// For each stored row its couplings with nodes of this rank that a sweep forward comes to earlier.
pub struct EarlierCouplings {
    starts: Vec<u32>,
    /// Columns, each with its place among the near couplings of the row.
    couplings: Vec<[u32; 2]>,
}

impl EarlierCouplings {
    /// Of the rows of a rank that has so many nodes.
    pub fn new(rows: &StoredRows, strips: &Strips, order: &SweepOrder, nodes: usize) -> Self {
        // When the sweep comes to each node; inner nodes of even macro triangles come last, and couple to no stored ones.
        let mut times = vec![u32::MAX; nodes];
        let mut next = 0;
        let mut visit = |node: usize| {
            times[node] = next;
            next += 1;
        };
        order.sides().for_each(|k| visit(rows.nodes()[k] as usize));
        for (triangle, inside) in strips.triangles.iter().zip(&order.inside) {
            let alike = &strips.alike[triangle.alike.clone()];
            alike
                .iter()
                .flat_map(|(of_kind, _)| &strips.nodes[of_kind.clone()])
                .for_each(|strip| strip.range().for_each(&mut visit));
            inside.clone().for_each(|k| visit(rows.nodes()[k] as usize));
        }
        let mut all = Self { starts: vec![0], couplings: Vec::new() };
        for (k, &node) in rows.nodes().iter().enumerate() {
            let columns = rows.near.columns[rows.near.row(k)].iter().zip(0..);
            let earlier = columns.filter(|(column, _)| times[**column as usize] < times[node as usize]);
            all.couplings.extend(earlier.map(|(&column, place)| [column, place]));
            all.starts.push(all.couplings.len() as u32);
        }
        all
    }

    /// Those of row `k`: columns and places.
    #[inline(always)]
    pub fn row(&self, k: usize) -> &[[u32; 2]] {
        &self.couplings[self.starts[k] as usize..self.starts[k + 1] as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::super::assembly::{Assembled, Assembly};
    use super::super::lattice_rows::LatticeRows;
    use super::super::strip_kernel::SweepHalves;
    use super::*;
    use crate::contact::MultiplierSpace;
    use crate::discretisation::samples::{blocks, pair, vector};
    use crate::discretisation::{Scene, Space, spaces};
    use crate::element::Order;
    use crate::geometry::{Curve, Point};
    use crate::mesh::Partition;
    use std::rc::Rc;

    /// Blocks whose macro triangles are even, graded towards a corner, or bent.
    fn scenes(order: Order, refine: usize) -> Vec<Scene> {
        let mut even = Scene { order, refine, ..blocks(pair(MultiplierSpace::P0, 4), |_| Point::zeros(), Vec::new()) };
        even.bodies.iter_mut().flat_map(|body| &mut body.parts).for_each(|part| part.material.poisson = 0.3);
        let [mut graded, mut bent] = [(); 2].map(|()| (*even.mesh).clone());
        let corner = graded.vertices[0];
        graded.grade(corner, 0.3).expect("a vertex");
        let circle = Curve::Circle { centre: [1.0, -2.0], radius: 10f64.sqrt() };
        bent.bend("arc", &["lower.seam".into()], &circle).expect("the ends lie on it");
        let on = |mesh| Scene { mesh: Rc::new(mesh), ..even.clone() };
        vec![even.clone(), on(graded), on(bent)]
    }

    /// On one rank and on each of three.
    #[test]
    fn a_sweep_from_zero_is_a_sweep_through_zeros() {
        for order in [Order::P1, Order::P2] {
            let mut kinds = [0; 4];
            let scenes = scenes(order, 5).into_iter().flat_map(|scene| [1, 3].map(|ranks| (scene.clone(), ranks)));
            for ((mut scene, ranks), rank) in scenes.flat_map(|pair| (0..pair.1).map(move |rank| (pair.clone(), rank))) {
                let owners: Vec<i32> = (0..scene.mesh.triangles.len()).map(|triangle| (triangle % ranks) as i32).collect();
                scene.partition = Rc::new(Partition::new(&scene.mesh, &owners, ranks));
                for space in spaces(&scene, rank).expect("a small mesh") {
                    let found = check(&scene, &space, rank);
                    (0..4).for_each(|k| kinds[k] += found[k]);
                }
            }
            assert!(kinds.iter().all(|count| *count > 0), "{kinds:?}: some of each kind");
        }
    }

    /// Counts earlier couplings, strips, even macro triangles, and sides that need nodes of other ranks.
    fn check(scene: &Scene, space: &Space, rank: usize) -> [usize; 4] {
        let assembly = Assembly::new(scene, space, true, rank);
        let Assembled { rows, strips, even, .. } = assembly.assemble(&Default::default(), |_, _| ()).expect("good triangles");
        let (order, nodes) = (SweepOrder::new(&rows, &strips), space.own.len());
        let earlier = EarlierCouplings::new(&rows, &strips, &order, nodes);
        let couplings: usize = (0..rows.nodes().len()).map(|k| earlier.row(k).len()).sum();
        assert!(2 * couplings <= rows.block_count(), "half of what is off the diagonal, or less");
        let lattice = LatticeRows { strips: &strips, even: &even, stored: &rows, order: &order };
        let (b, mut zero, mut x) = (vector(nodes, 3), vec![[0.0; 2]; nodes], vector(nodes, 8));
        lattice.begin_to_relax(&b, &mut zero);
        lattice.end_to_relax(SweepHalves::Forward, &b, &mut zero, &[]);
        lattice.relax_from_zero(&earlier, &b, &mut x);
        let largest = zero.as_flattened().iter().fold(0.0, |largest: f64, v| largest.max(v.abs()));
        for (x, zero) in x.as_flattened().iter().zip(zero.as_flattened()) {
            // The same products are added in another order.
            assert!((x - zero).abs() <= 1e-14 * largest, "{x} {zero}");
        }
        [couplings, strips.nodes.len(), even.triangles.len(), order.far_sides.len()]
    }
}
