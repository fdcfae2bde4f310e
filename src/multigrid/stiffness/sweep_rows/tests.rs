//! Sweeps by half of the rows against sweeps by all of them.

use super::*;
use crate::contact::MultiplierSpace;
use crate::discretisation::samples::{blocks, pair, vector};
use crate::discretisation::{Scene, spaces};
use crate::element::Order;
use crate::geometry::Point;
use crate::mesh::Partition;
use crate::multigrid::stiffness::assembly::{Assembled, Assembly};
use crate::multigrid::stiffness::stored_rows::BlockColumn;
use std::rc::Rc;

/// Stored rows of all nodes, on one rank and on each of three, and how many nodes of other ranks they need.
fn all_rows() -> Vec<(StoredRows, usize)> {
    let mut found = Vec::new();
    for (order, ranks) in [(Order::P1, 1), (Order::P2, 1), (Order::P1, 3), (Order::P2, 3)] {
        let mut scene = Scene { order, refine: 0, ..blocks(pair(MultiplierSpace::P0, 4), |_| Point::zeros(), Vec::new()) };
        scene.bodies.iter_mut().flat_map(|body| &mut body.parts).for_each(|part| part.material.poisson = 0.4);
        let owners: Vec<i32> = (0..scene.mesh.triangles.len()).map(|triangle| (triangle % ranks) as i32).collect();
        scene.partition = Rc::new(Partition::new(&scene.mesh, &owners, ranks));
        for rank in 0..ranks {
            let space = spaces(&scene, rank).expect("a small mesh").pop().expect("a finest level");
            let assembly = Assembly::new(&scene, &space, false, rank);
            let Assembled { rows, far, .. } = assembly.assemble(&Default::default(), |_, _| ()).expect("good triangles");
            assert_eq!(rows.nodes.len(), space.own.len());
            found.push((rows, far.len()));
        }
    }
    found
}

fn largest(values: &[[f64; 2]]) -> f64 {
    values.as_flattened().iter().fold(0.0, |largest, value| largest.max(value.abs()))
}

/// To a precision.
fn check(found: &[[f64; 2]], exact: &[[f64; 2]], size: f64, precision: f64) {
    let differences = found.as_flattened().iter().zip(exact.as_flattened()).map(|(a, b)| (a - b).abs());
    let most = differences.fold(0.0, f64::max);
    assert!(most <= precision * size, "{most:e} beside {size:e}");
}

#[test]
fn sweeps_and_residuals_are_those_of_the_rows_to_their_precision() {
    let mut with_others = 0;
    for ((rows, others), is_single) in all_rows().into_iter().flat_map(|rows| [(rows.clone(), true), (rows, false)]) {
        let (count, mut sweep) =
            (rows.nodes.len(), SweepRows::new(&rows, &Default::default(), is_single).expect("they share nothing"));
        let check =
            |found: &[[f64; 2]], exact: &[[f64; 2]], size: f64| check(found, exact, size, if is_single { 1e-5 } else { 1e-13 });
        with_others += sweep.far.len();
        let (b, start, far) = (vector(count, 3), vector(count, 8), vector(others, 5));
        let (mut x, mut exact, mut r, mut exact_r) = (start.clone(), start, b.clone(), b.clone());
        sweep.relax(&rows, &b, &mut x, &far);
        rows.forward(0..count, &b, &mut exact, &far);
        rows.backward(0..count, &b, &mut exact, &far);
        check(&x, &exact, largest(&exact));
        // Other ranks have gone on meanwhile.
        let far = vector(others, 6);
        let forces = rows.norm_infinity() * largest(&x).max(largest(&far));
        sweep.residual(&rows, &b, &x, &far, &mut r);
        rows.residual(0..count, &b, &x, &far, &mut exact_r);
        check(&r, &exact_r, forces);
        // From zero the values that stand there do not matter.
        sweep.relax_from_zero(&rows, &b, &mut x);
        exact.fill([0.0; 2]);
        rows.forward(0..count, &b, &mut exact, &[]);
        check(&x, &exact, largest(&exact));
        sweep.residual(&rows, &b, &x, &far, &mut r);
        rows.residual(0..count, &b, &x, &far, &mut exact_r);
        check(&r, &exact_r, forces);
    }
    assert!(with_others > 0, "some rows need nodes of other ranks");
}

#[test]
fn a_translation_keeps_its_forces_to_the_last_digit() {
    for (rows, _) in all_rows() {
        let sweep = SweepRows::new(&rows, &Default::default(), true).expect("rows of all nodes");
        let halves = sweep.halves(&rows.near, sweep.blocks.as_ref().expect("single precision"));
        let mut sums: Vec<Block> = sweep.inverses.iter().map(|own| inverse(own).expect("an inverse has one")).collect();
        for k in 0..rows.nodes.len() {
            let (columns, blocks) = halves.later(k);
            for (&column, block) in columns.iter().zip(blocks) {
                for (a, b) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                    let value = f64::from(block[2 * a + b]) * sweep.unit;
                    sums[k][a][b] += value;
                    sums[column as usize][b][a] += value;
                }
            }
        }
        for (k, sum) in sums.iter().enumerate() {
            let size = rows.diagonal(k).as_flattened().iter().fold(0.0_f64, |size, v| size.max(v.abs()));
            let exact = rows
                .near
                .couplings(k)
                .fold([0.0; 4], |sum, (_, block)| std::array::from_fn(|at| sum[at] + block[at / 2][at % 2]));
            assert!((0..4).all(|at| (sum[at / 2][at % 2] - exact[at]).abs() <= 1e-13 * size), "row {k}: {sum:?}, {exact:?}");
        }
    }
}

#[test]
fn units_and_changed_rows_are_followed() {
    for factor in [1e-150, 1e150] {
        let (mut rows, others) = all_rows().swap_remove(0);
        rows.near.blocks.as_flattened_mut().as_flattened_mut().iter_mut().for_each(|value| *value *= factor);
        (0..rows.nodes.len()).for_each(|k| rows.invert(k));
        let (count, mut sweep) = (rows.nodes.len(), SweepRows::new(&rows, &Default::default(), true).expect("rows of all nodes"));
        let b: Vec<[f64; 2]> = vector(count, 3).into_iter().map(|b| b.map(|b| b * factor)).collect();
        // A support under one node, much stiffer than the body.
        let (changed, stiff) = (count / 2, 1e3 * factor);
        rows.add(changed, BlockColumn::Near(changed as u32), &[[stiff, 0.0], [0.0, stiff]]);
        rows.invert(changed);
        sweep.refresh(&rows, std::iter::once(changed));
        let (mut x, mut exact, far) = (vec![[0.0; 2]; count], vec![[0.0; 2]; count], vector(others, 5));
        sweep.relax(&rows, &b, &mut x, &far);
        rows.forward(0..count, &b, &mut exact, &far);
        rows.backward(0..count, &b, &mut exact, &far);
        check(&x, &exact, largest(&exact), 1e-5);
        assert!(largest(&x[changed..=changed]) < 0.05 * largest(&x), "it is held");
        assert!(SweepRows::new(&rows, &Default::default(), true).is_some_and(|sweep| sweep.blocks.is_some()));
        // Springs along an inclined line.
        let spring = 1e8 * rows.diagonal(0)[0][0];
        rows.add(0, BlockColumn::Near(0), &[[0.36 * spring, 0.48 * spring], [0.48 * spring, 0.64 * spring]]);
        let sweep = SweepRows::new(&rows, &Default::default(), true).expect("they share nothing");
        assert!(sweep.blocks.is_none(), "single precision would lose the body beside the spring");
    }
}
