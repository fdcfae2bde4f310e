//! Even macro triangles and halved rows against stored matrices, on 1, 2 and 3 ranks.

#[path = "../support/bars.rs"]
mod bars;
mod launch;

use launch::{Suite, named};
use mezha::body::Support;
use mezha::discretisation::{Discretisation, Field, Form, Scene, Space, local_strain_energy, spread};
use mezha::element::Order;
use mezha::geometry::{Curve, Formula};
use mezha::mesh::{BisectedMesh, Partition, lattice};
use mezha::multigrid::{ContactNeighbours, Cycle, Elastic, RowPlaces, Stiffness, SweepHalves, interpolations};
use mezha::petsc::{Krylov, Matrix, Session, Vector, options};
use std::rc::Rc;

fn main() -> std::process::ExitCode {
    Suite {
        options: (&[], &[]),
        checks: named![
            even_triangles_act_like_stored_rows,
            straight_triangles_act_like_stored_rows,
            expanded_even_triangles_are_the_stored_matrix,
            the_energy_of_a_product_is_that_of_the_triangles,
            a_sweep_is_symmetric_and_reduces_the_error,
            a_cycle_reduces_the_error,
            solvers_of_petsc_take_even_triangles,
            halved_rows_interpolate_linear_motions_exactly,
            halved_rows_are_transposed,
        ],
        outside: &[],
        scenarios: &[],
    }
    .run()
}

/// Bars without contact, even and refined towards a corner of the contact line, with both elements.
fn problems(session: &Session) -> Vec<Discretisation> {
    let cases = [(Order::P1, 5, false), (Order::P2, 4, false), (Order::P1, 6, true), (Order::P2, 5, true)];
    let problem = |(order, refine, graded)| {
        Discretisation::new(bars::scene(session, order, refine, graded), session).expect("a discretisation")
    };
    cases.into_iter().map(problem).collect()
}

/// Bars whose last rank has one macro triangle, all vertices of which are nodes of the first rank: that one has all nodes of the
/// coarsest level.
fn lopsided(session: &Session) -> Discretisation {
    let mut scene = bars::scene(session, Order::P1, 4, false);
    let shared = |triangle: usize| {
        let others = |vertex: &u32| {
            let all = scene.mesh.triangles.iter().enumerate();
            all.filter(|(other, of)| *other != triangle && of.vertices.contains(vertex)).count() > 0
        };
        scene.mesh.triangles[triangle].vertices.iter().all(others)
    };
    let one = (0..scene.mesh.triangles.len()).find(|&triangle| shared(triangle)).expect("a triangle inside");
    let mut ranks = vec![0; scene.mesh.triangles.len()];
    ranks[one] = session.size() as i32 - 1;
    scene.partition = Rc::new(Partition::new(&scene.mesh, &ranks, session.size()));
    Discretisation::new(scene, session).expect("a discretisation")
}

/// The stiffness with even macro triangles as wholes, and with all rows stored.
fn both(problem: &Discretisation) -> [Elastic; 2] {
    let load = vec![0.0; problem.finest().local_unknowns()];
    [Form::Augmented, Form::Plain].map(|form| Elastic::alone(problem, load.clone(), form).expect("a stiffness"))
}

fn finest(elastic: &Elastic) -> &Matrix {
    elastic.stiffness[elastic.stiffness.len() - 1].operator()
}

/// Erratic values, the same on any number of ranks; zero where displacement is prescribed.
fn erratic(problem: &Discretisation, layout: &Matrix, seed: f64) -> Vector {
    let mut x = layout.create_vectors().expect("vectors").0;
    let first = x.range().start;
    x.values_mut().iter_mut().enumerate().for_each(|(at, v)| *v = ((first + at) as f64 * 12.9898 + seed).sin());
    for (node, constraint) in problem.finest().constraints.iter().filter(|(node, _)| problem.finest().own.contains(node)) {
        let at = 2 * node - first;
        (0..2).filter(|&k| constraint.fixed[k]).for_each(|k| x.values_mut()[at + k] = 0.0);
    }
    x
}

/// Size of `x - y` against that of `y`.
fn apart(mut x: Vector, y: &Vector) -> f64 {
    x.axpy(-1.0, y).expect("of one layout");
    x.norm().expect("a norm") / y.norm().expect("a norm")
}

fn product(matrix: &Matrix, x: &Vector) -> Vector {
    let mut y = x.duplicate().expect("a vector");
    matrix.multiply(x, &mut y).expect("a product");
    y
}

fn even_triangles_act_like_stored_rows(session: &Session) {
    for problem in problems(session) {
        let [whole, stored] = both(&problem);
        let lattice = whole.stiffness[whole.stiffness.len() - 1].lattice();
        assert!(lattice.rows.borrow().nodes.len() < lattice.node_count(), "there is something to compare");
        let (x, b) = (erratic(&problem, finest(&stored), 0.3), erratic(&problem, finest(&stored), 0.7));
        let [left, right] = [&whole, &stored].map(|elastic| {
            let mut r = x.duplicate().expect("a vector");
            let lattice = elastic.stiffness[elastic.stiffness.len() - 1].lattice();
            lattice.residual(b.values().as_chunks().0, x.values().as_chunks().0, r.values_mut().as_chunks_mut().0);
            r
        });
        assert!(apart(left, &right) < 1e-14);
        let (whole, stored) = (finest(&whole), finest(&stored));
        assert!(apart(product(whole, &x), &product(stored, &x)) < 1e-14);
        let [a, b] = [whole, stored].map(|matrix| matrix.norm_infinity().expect("a norm"));
        assert!((a / b - 1.0).abs() < 1e-14);
    }
}

fn expanded_even_triangles_are_the_stored_matrix(session: &Session) {
    for problem in problems(session) {
        let [whole, stored] = both(&problem);
        let expanded = whole.stiffness.last().expect("levels").expanded(session).expect("a matrix").expect("not stored");
        let stored = finest(&stored);
        let x = erratic(&problem, stored, 0.1);
        assert!(apart(product(&expanded, &x), &product(stored, &x)) < 1e-14);
    }
}

/// The bars with a bent top, which is pressed down, and a corner towards which they are refined.
fn bent(session: &Session, order: Order, refine: usize) -> Discretisation {
    let mut scene = bars::scene(session, order, refine, true);
    let mut mesh = (*scene.mesh).clone();
    let (rise, half) = (0.08, 3.0);
    let radius = (half * half + rise * rise) / (2.0 * rise);
    let circle = Curve::Circle { centre: [half, 6.0 + rise - radius], radius };
    mesh.bend("arc", &["top".into()], &circle).expect("the vertices lie near it");
    let down = Some(Formula::constant(-0.25));
    scene.supports.push(Support { name: "press".into(), on: vec!["top".into()], at: None, ux: None, uy: None, normal: down });
    scene.mesh = std::rc::Rc::new(mesh);
    Discretisation::new(scene, session).expect("a discretisation")
}

/// The bars with a bent top, on a fine mesh that is not cut up: some rows are stored, most are not.
fn fine(session: &Session) -> Discretisation {
    let scene = bent(session, Order::P2, 0).scene;
    let mut mesh = BisectedMesh::new((*scene.mesh).clone());
    for _ in 0..3 {
        mesh = mesh.refined(0..mesh.mesh.triangles.len() as u32);
    }
    let mesh = Rc::new(mesh.mesh);
    let partition = Rc::new(spread(&mesh, &[], Order::P2, 0, session).expect("a partition"));
    Discretisation::new(Scene { mesh, partition, ..scene }, session).expect("a discretisation")
}

/// Products, norms, expanded rows, and sweeps, also where contact couples nodes of the boundary.
fn straight_triangles_act_like_stored_rows(session: &Session) {
    let problem = fine(session);
    let of_bodies = both(&problem);
    let stored_rows: Vec<usize> = {
        let (lattice, own) = (of_bodies[0].stiffness[1].lattice(), problem.finest().own.start);
        let rows = lattice.rows.borrow();
        (0..rows.nodes.len()).filter(|&k| rows.is_stored(k)).map(|k| own + k).collect()
    };
    let own = problem.finest().own.len();
    assert!(own == 0 || (1..own / 2).contains(&stored_rows.len()), "{} of {own} rows are stored", stored_rows.len());
    let contact = stored_rows.windows(2).map(|pair| (pair[0], pair.iter().copied().collect())).collect();
    let neighbours = [ContactNeighbours::new(), contact];
    let forms = of_bodies.iter().zip([Form::Augmented, Form::Plain]);
    let [mut straight, mut stored] = forms
        .map(|(elastic, form)| elastic.with_places(&problem, form, &neighbours).expect("places").pop().expect("a level"))
        .collect::<Vec<_>>()
        .try_into()
        .unwrap_or_else(|_| panic!("two"));
    for stiffness in [&mut straight, &mut stored] {
        for pair in stored_rows.windows(2) {
            let mut blocks = Vec::new();
            let k = stiffness.lattice().places(pair[0], pair.iter().copied(), |place| blocks.push(place));
            let places = RowPlaces { stored: k, is_last: true, blocks: &blocks };
            stiffness.add_to_row(places, &[[[7e3, 0.0], [0.0, 9e3]], [[1e3, 2e3], [0.0, 1e3]]]);
        }
        stiffness.assemble().expect("values");
    }
    let expanded = straight.expanded(session).expect("a matrix").expect("not stored");
    let x = erratic(&problem, stored.operator(), 0.3);
    let exact = product(stored.operator(), &x);
    for matrix in [straight.operator(), &expanded] {
        assert!(apart(product(matrix, &x), &exact) < 1e-14);
    }
    let [norm, stored_norm] = [&straight, &stored].map(|stiffness| stiffness.operator().norm_infinity().expect("a norm"));
    assert!((norm / stored_norm - 1.0).abs() < 1e-14);
    let [swept, exact] = [&straight, &stored].map(|stiffness| {
        let (mut sums, lattice) = (x.duplicate().expect("a vector"), stiffness.lattice());
        let (mut sweep, mut r) = (lattice.sweep_rows().expect("no lattices"), vec![[0.0; 2]; lattice.node_count()]);
        let (rows, far) = (lattice.rows.borrow(), vec![[0.5; 2]; lattice.far.len()]);
        let b = x.values();
        sweep.relax_from_zero(&rows, b.as_chunks().0, sums.values_mut().as_chunks_mut().0);
        sweep.residual(&rows, b.as_chunks().0, sums.values().as_chunks().0, &far, &mut r);
        sweep.relax(&rows, &r, sums.values_mut().as_chunks_mut().0, &far);
        sums
    });
    assert!(apart(swept, &exact) < 1e-13);
}

/// A rank that left out what triangles of others add to its rows would have another energy, and other forces.
fn the_energy_of_a_product_is_that_of_the_triangles(session: &Session) {
    for (order, refine) in [(Order::P1, 0), (Order::P1, 1), (Order::P1, 4), (Order::P2, 0), (Order::P2, 1), (Order::P2, 3)] {
        let problem = bent(session, order, refine);
        let elastic = both(&problem);
        let x = erratic(&problem, finest(&elastic[0]), 0.6);
        let energy = |x: &Vector| {
            let u = Field::displacement(&problem, &x.values());
            let mut sum = [local_strain_energy(&problem, &u).expect("an energy").iter().sum::<f64>()];
            session.sum(&mut sum);
            sum[0]
        };
        // With what is prescribed: ½ (u + p)·K (u + p) = ½ u·K u - u·f + E(p), f being the forces of p.
        let mut prescribed = x.duplicate().expect("a vector");
        let space = problem.finest();
        for (node, constraint) in space.constraints.iter().filter(|(node, _)| space.own.contains(node)) {
            let at = 2 * (node - space.own.start);
            prescribed.values_mut()[at..at + 2].copy_from_slice(constraint.prescribed().as_slice());
        }
        let mut sum = x.duplicate().expect("a vector");
        sum.values_mut().copy_from_slice(&x.values());
        sum.axpy(1.0, &prescribed).expect("of one layout");
        for elastic in &elastic {
            let whole = 0.5 * dot(&product(finest(elastic), &x), &x, session);
            let mut work = [elastic.load.iter().zip(x.values().iter()).map(|(force, u)| force * u).sum::<f64>()];
            session.sum(&mut work);
            assert!((whole / energy(&x) - 1.0).abs() < 1e-12, "{order:?}, refine = {refine}: {whole} {}", energy(&x));
            let expected = energy(&sum) - energy(&prescribed) - energy(&x);
            assert!((work[0] + expected).abs() < 1e-10 * whole, "{order:?}, refine = {refine}: {} {expected}", work[0]);
            assert!(expected.abs() > 1e-6 * whole, "there is something to compare");
        }
    }
}

/// Inner product over all ranks. **Collective**
fn dot(x: &Vector, y: &Vector, session: &Session) -> f64 {
    let mut sum = [x.values().iter().zip(y.values().iter()).map(|(x, y)| x * y).sum()];
    session.sum(&mut sum);
    sum[0]
}

/// One sweep from zero.
fn swept(elastic: &Elastic, b: &Vector) -> Vector {
    let mut x = b.duplicate().expect("a vector");
    x.set(0.0).expect("zeros");
    let lattice = elastic.stiffness[elastic.stiffness.len() - 1].lattice();
    lattice.relax(SweepHalves::Both, b.values().as_chunks().0, x.values_mut().as_chunks_mut().0);
    x
}

fn a_sweep_is_symmetric_and_reduces_the_error(session: &Session) {
    for problem in problems(session) {
        let both = both(&problem);
        let stored = finest(&both[1]);
        let [a, b] = [0.2, 0.9].map(|seed| erratic(&problem, stored, seed));
        let [forth, back] = [(&a, &b), (&b, &a)].map(|(a, b)| dot(&swept(&both[0], a), b, session));
        assert!((forth / back - 1.0).abs() < 1e-12, "{forth} {back}");
        // In the energy norm, and not worse than with all rows stored.
        let left = both.each_ref().map(|elastic| {
            let mut error = swept(elastic, &product(stored, &a));
            error.axpy(-1.0, &a).expect("of one layout");
            dot(&product(stored, &error), &error, session)
        });
        let whole = dot(&product(stored, &a), &a, session);
        assert!(left[0] < 0.2 * whole && left[0] < 1.1 * left[1], "{left:?} of {whole}");
    }
}

/// In the energy norm; with steps of CG in the place of a sweep, by more.
fn a_cycle_reduces_the_error(session: &Session) {
    for (order, refine, graded) in [(Order::P1, 5, false), (Order::P2, 4, false), (Order::P1, 6, true)] {
        let mut scene = bars::scene(session, order, refine, graded);
        let zero = Some(Formula::constant(0.0));
        let on = vec!["bottom".into(), "top".into()];
        scene.supports.push(Support { name: "ends".into(), on, at: None, ux: None, uy: zero, normal: None });
        let problem = Discretisation::new(scene, session).expect("a discretisation");
        let [whole, stored] = both(&problem);
        let (interpolations, stored) = (interpolations(&problem), finest(&stored));
        let x = erratic(&problem, stored, 0.2);
        let b = product(stored, &x);
        let energy = dot(&b, &x, session);
        let left = [0, 2, 4].map(|steps| {
            let mut cycle =
                Cycle::new(whole.stiffness.iter().map(Stiffness::lattice), &interpolations, steps, session).expect("a cycle");
            let mut error = x.duplicate().expect("a vector");
            cycle.apply(&mut b.values().to_vec(), &[], &mut error.values_mut());
            error.axpy(-1.0, &x).expect("of one layout");
            dot(&product(stored, &error), &error, session) / energy
        });
        assert!(left[0] < 0.05 && left[1] < 0.5 * left[0] && left[2] < 0.5 * left[1], "{left:?}");
    }
}

fn solvers_of_petsc_take_even_triangles(session: &Session) {
    options::set_default(session, "-whole_ksp_type", "cg").expect("an option");
    options::set_default(session, "-whole_pc_type", "none").expect("an option");
    let problem = &problems(session)[0];
    let [whole, stored] = both(problem);
    let x = erratic(problem, finest(&stored), 0.4);
    let b = product(finest(&stored), &x);
    let krylov = Krylov::new(session, "whole_").expect("a solver");
    krylov.set_operators(finest(&whole), finest(&whole)).expect("operators");
    krylov.set_tolerance(1e-8, 2000).expect("a tolerance");
    krylov.set_from_options().expect("options");
    let mut found = x.duplicate().expect("a vector");
    assert!(krylov.solve_allowing(&b, &mut found).expect("a solve").converged);
    assert!(apart(product(finest(&stored), &found), &b) < 1e-7);
}

/// A linear motion that the supports allow, in the unknowns of a level.
fn linear_motion(problem: &Discretisation, space: &Space, session: &Session) -> Vector {
    let (mesh, level) = (&problem.scene.mesh, space.numbering.level);
    let mut motion = Vector::new(session, space.local_unknowns()).expect("a vector");
    for &triangle in problem.scene.partition.triangles_of(session.rank()) {
        let numbers = space.numbering.triangle(mesh, triangle as usize);
        for (i, j) in lattice::nodes(level.intervals) {
            if let Some(at) = numbers.node(i, j).checked_sub(space.own.start).filter(|at| *at < space.own.len()) {
                let x = mesh.node_position(triangle as usize, level, (i, j));
                motion.values_mut()[2 * at..2 * at + 2].copy_from_slice(&[2.0 * x.x, 1.0 + 3.0 * x.x - x.y]);
            }
        }
    }
    motion
}

fn halved_rows_interpolate_linear_motions_exactly(session: &Session) {
    for problem in problems(session).into_iter().take(2) {
        let all = interpolations(&problem);
        let (fine, coarse) = (problem.finest(), &problem.spaces[problem.spaces.len() - 2]);
        let motion = |space: &Space| linear_motion(&problem, space, session);
        let (x, expected) = (motion(coarse), motion(fine));
        let mut found = expected.duplicate().expect("a vector");
        let nodes = &all[all.len() - 1].nodes;
        nodes.prolong::<false>(x.values().as_chunks().0, found.values_mut().as_chunks_mut().0, &mut Default::default());
        assert!(apart(found, &expected) < 1e-14);
    }
}

fn halved_rows_are_transposed(session: &Session) {
    for problem in problems(session).into_iter().chain([lopsided(session)]) {
        let all = interpolations(&problem);
        let (nodes, mut room) = (&all[all.len() - 1].nodes, Default::default());
        let spaces = [problem.finest(), &problem.spaces[problem.spaces.len() - 2]];
        let [mut y, mut x] = spaces.map(|space| Vector::new(session, space.local_unknowns()).expect("a vector"));
        x.values_mut().iter_mut().enumerate().for_each(|(at, v)| *v = (at as f64).cos());
        y.values_mut().iter_mut().enumerate().for_each(|(at, v)| *v = (at as f64).sin());
        let (mut fine, mut coarse) = (y.duplicate().expect("a vector"), x.duplicate().expect("a vector"));
        nodes.prolong::<false>(x.values().as_chunks().0, fine.values_mut().as_chunks_mut().0, &mut room);
        nodes.restrict(y.values().as_chunks().0, coarse.values_mut().as_chunks_mut().0, &mut room);
        let [forth, back] = [dot(&fine, &y, session), dot(&coarse, &x, session)];
        assert!((forth - back).abs() < 1e-12 * fine.norm().expect("a norm") * y.norm().expect("a norm"));
        nodes.prolong::<true>(x.values().as_chunks().0, fine.values_mut().as_chunks_mut().0, &mut room);
        let mut twice = fine.duplicate().expect("a vector");
        nodes.prolong::<false>(x.values().as_chunks().0, twice.values_mut().as_chunks_mut().0, &mut room);
        twice.values_mut().iter_mut().for_each(|v| *v *= 2.0);
        assert!(apart(fine, &twice) < 1e-14);
    }
}
