//! A system whose active set changes, on 1, 2 and 3 ranks: against its own definition, block by block, and against a system that
//! has never had another set.

#[path = "../support/bars.rs"]
mod bars;
#[path = "../support/contact.rs"]
mod contact;
mod launch;
#[path = "../support/mesh.rs"]
#[allow(dead_code)] // Other programs use the rest.
mod meshes;

use contact::with_contact;
use launch::{Suite, named};
use mezha::body::{HeldMode, MeanHold, RigidNodes, RigidSet, Support, UNIT_MOTIONS};
use mezha::contact::{MultiplierSpace, Stabilise, jump_matrix};
use mezha::discretisation::{Contact, Coupled, Discretisation, Form, load, nodal_forces};
use mezha::element::Order;
use mezha::geometry::{Curve, Formula, ParametricCurve, Point};
use mezha::mesh::{Graph, parse_gmsh};
use mezha::multigrid::{Elastic, Interpolation, interpolations};
use mezha::petsc::{Matrix, Session, Vector, partition};
use mezha::system::{LinearEnding, Preconditioning, SaddlePoint, SolverChoice, Start, System};
use std::collections::BTreeMap;
use std::rc::Rc;

fn main() -> std::process::ExitCode {
    Suite {
        options: (&[], &[]),
        checks: named![
            blocks_and_right_hand_side_are_those_of_the_set,
            every_level_is_the_galerkin_product_of_the_next,
            the_solution_does_not_know_the_sets_before,
            a_factor_leaves_nothing_behind_for_the_solvers_after_it,
            a_plain_system_has_the_solution_of_the_augmented_one,
            the_plain_residual_is_that_of_the_system_without_augmentation,
            responses_are_those_of_load_and_gap_and_reciprocal,
            rigid_motions_are_those_of_every_solver_and_set,
            multipliers_live_where_body_one_does,
            rows_of_b_are_whole_where_they_are_needed_and_nowhere_else,
            ranks_are_dealt_equal_work,
        ],
        outside: &[],
        scenarios: &[],
    }
    .run()
}

/// All pairs of spaces, with and without a jump term; on many levels, and on auxiliary ones below a large macro mesh.
fn problems(session: &Session) -> Vec<Discretisation> {
    use MultiplierSpace::*;
    let bars = |order, refine, space, segments, stabilise| {
        with_contact(bars::scene(session, order, refine, false), space, segments, stabilise)
    };
    let text = meshes::Mesh::inclined_bars(6).text();
    let large = || parse_gmsh(text.as_bytes(), "large.msh".as_ref(), Default::default()).expect("a mesh");
    let scenes = [
        bars(Order::P1, 4, P0, 24, Stabilise::Off),
        bars(Order::P1, 2, P0, 30, Stabilise::On),
        with_contact(bars::on(large(), session, Order::P1, 0), P1Discontinuous, 16, Stabilise::Off),
        bars(Order::P2, 1, P1Continuous, 10, Stabilise::Off),
        bars(Order::P1, 2, P1Discontinuous, 20, Stabilise::On),
        bars(Order::P2, 2, P1Discontinuous, 12, Stabilise::Off),
        with_contact(bars::on(large(), session, Order::P1, 1), P0, 20, Stabilise::Off),
    ];
    scenes.into_iter().map(|scene| Discretisation::new(scene, session).expect("a discretisation")).collect()
}

/// The upper bar held by its mean along x and against turning, of which contact resists both, or under a plate that presses; the
/// line between them is inclined.
fn moving_problems(session: &Session) -> Vec<Discretisation> {
    let scene = |space, stabilise| {
        let mut scene = with_contact(bars::scene(session, Order::P2, 2, false), space, 12, stabilise);
        let (zero, table) = (Some(Formula::constant(0.0)), vec!["bottom".into()]);
        scene.supports = vec![Support { name: "table".into(), on: table, at: None, ux: zero.clone(), uy: zero, normal: None }];
        scene
    };
    let mut held = scene(MultiplierSpace::P1Discontinuous, Stabilise::Off);
    let modes = [("ux", 0, 2e-3), ("angle", 2, 1e-3)];
    let modes = modes.map(|(key, k, value)| HeldMode { key, mode: UNIT_MOTIONS[k], value });
    let hold = MeanHold::of_body("mean", &held.mesh.bodies[1], &held.mesh);
    held.means = vec![MeanHold { held: modes.into(), ..hold }.on(&held.mesh)];
    let mut plate = scene(MultiplierSpace::P0, Stabilise::On);
    let (nodes, about) = (RigidNodes::Boundaries(vec!["top".into()]), Point::new(3.0, 6.0));
    let (prescribed, applied) = ([Some(1e-3), None, None], [0.0, -5.0, 0.5]);
    plate.rigid = vec![RigidSet { key: "load.plate".into(), nodes, about, prescribed, applied }];
    [held, plate].map(|scene| Discretisation::new(scene, session).expect("a discretisation")).into()
}

fn system(problem: &Discretisation, choice: SolverChoice) -> (System<'_>, Rc<[Interpolation]>) {
    system_from(problem, choice, Preconditioning::Sweep)
}

/// A system whose solver begins with a preconditioning.
fn system_from<'a>(
    problem: &'a Discretisation,
    choice: SolverChoice,
    first: Preconditioning,
) -> (System<'a>, Rc<[Interpolation]>) {
    let load = load(problem, &nodal_forces(problem).expect("loads"));
    let blocks = SaddlePoint::new(problem, load, choice.form()).expect("blocks");
    let interpolations: Rc<[Interpolation]> = match choice.form() {
        Form::Augmented => interpolations(problem).into(),
        Form::Plain => Rc::new([]),
    };
    let system = System::new(problem, blocks, &interpolations, choice, first).expect("a system");
    (system, interpolations)
}

/// Erratic numbers in [-1, 1], the same on any number of ranks.
fn erratic(i: usize, seed: f64) -> f64 {
    (12.9898 * (i + 1) as f64 + seed).sin()
}

/// Active sets one after the other: some, others, single changes, none, all but one, a last one.
fn sets(count: usize) -> Vec<Vec<bool>> {
    let by = |seed: f64| -> Vec<bool> { (0..count).map(|i| erratic(i, seed) > -0.3).collect() };
    let mut near = by(1.0);
    near[count / 2] ^= true;
    let mut all = vec![true; count];
    all[3] = false;
    vec![by(0.0), by(1.0), near, vec![false; count], all, by(2.0)]
}

/// What is known of a system from its definition, without any of its matrices but `K`.
struct Definition<'a> {
    problem: &'a Discretisation,
    session: &'a Session,
    /// `K` with all rows stored.
    stiffness: Matrix,
    /// `s_i = E_c / H_i`.
    scale: Vec<f64>,
    /// Rows of `B` in the nodes' frames.
    rows: Vec<BTreeMap<usize, Point>>,
}

impl<'a> Definition<'a> {
    fn new(problem: &'a Discretisation, session: &'a Session) -> Self {
        let load = vec![0.0; problem.finest().local_unknowns()];
        let mut elastic = Elastic::alone(problem, load, Form::Plain).expect("a stiffness");
        let stiffness = elastic.stiffness.pop().expect("a level").operator().share().expect("shared");
        let scale = |contact: &Contact| -> Vec<f64> {
            (0..contact.multipliers.count()).map(|i| contact.multiplier_moduli[i] / contact.multipliers.length(i)).collect()
        };
        let space = problem.finest();
        let row = |coupled: &Vec<Coupled>| {
            let mut sums = BTreeMap::new();
            for entry in coupled {
                let node = entry.node.number(&problem.scene.mesh, &space.numbering);
                *sums.entry(node).or_insert(Point::zeros()) += space.free_part(node, entry.value);
            }
            sums
        };
        let rows = problem.coupling.rows.iter().map(row).collect();
        Self { problem, session, stiffness, scale: problem.contacts.iter().flat_map(scale).collect(), rows }
    }

    /// `D v` over the active multipliers, the blocks of the mass matrix inverted.
    fn weigh(&self, active: &[bool], v: &[f64]) -> Vec<f64> {
        let mut product = vec![0.0; v.len()];
        for contact in &self.problem.contacts {
            for group in 0..contact.multipliers.groups() {
                let block = contact.multipliers.augmentation(group, contact.moduli[0], &active[contact.range()]);
                for (p, q, block) in block.iter().flat_map(|b| [(0, 0), (0, 1), (1, 0), (1, 1)].map(|(p, q)| (p, q, b))) {
                    if let (Some(i), Some(j)) = (block.rows.clone().nth(p), block.rows.clone().nth(q)) {
                        product[contact.first + i] += block.values[p][q] * v[contact.first + j];
                    }
                }
            }
        }
        product
    }

    /// `B u` of all multipliers, the same on every rank.
    fn couple(&self, u: &[f64]) -> Vec<f64> {
        let own = &self.problem.finest().own;
        let on_row = |row: &BTreeMap<usize, Point>| -> f64 {
            row.range(own.clone()).map(|(node, b)| b.dot(&Point::from_column_slice(&u[2 * (node - own.start)..][..2]))).sum()
        };
        let mut sums: Vec<f64> = self.rows.iter().map(on_row).collect();
        self.session.sum(&mut sums);
        sums
    }

    /// Adds `Bᵀ v` over the active multipliers.
    fn add_transposed(&self, active: &[bool], v: &[f64], sum: &mut [f64]) {
        let own = &self.problem.finest().own;
        for (row, v) in self.rows.iter().zip(v).zip(active).filter(|(_, active)| **active).map(|(pair, _)| pair) {
            for (node, b) in row.range(own.clone()) {
                let at = 2 * (node - own.start);
                sum[at] += v * b.x;
                sum[at + 1] += v * b.y;
            }
        }
    }

    /// `c - B u_D` of all multipliers.
    fn gap(&self) -> Vec<f64> {
        let (problem, space) = (self.problem, self.problem.finest());
        let moved = |row: &Vec<Coupled>| -> f64 {
            let number = |entry: &Coupled| entry.node.number(&problem.scene.mesh, &space.numbering);
            row.iter().map(|entry| entry.value.dot(&space.prescribed(number(entry)))).sum()
        };
        let mut sums = vec![0.0; problem.coupling.gap.len()];
        self.own().into_iter().for_each(|i| sums[i] = moved(&problem.coupling.rows[i]));
        self.session.sum(&mut sums);
        problem.coupling.gap.iter().zip(sums).map(|(c, moved)| c - moved).collect()
    }

    /// `f`, with what prescribed displacements add.
    fn load(&self) -> Vec<f64> {
        let load = load(self.problem, &nodal_forces(self.problem).expect("loads"));
        Elastic::alone(self.problem, load, Form::Plain).expect("a stiffness").load
    }

    /// Multipliers of this rank.
    fn own(&self) -> Vec<usize> {
        let owners = &self.problem.coupling.owners;
        (0..owners.len()).filter(|&i| owners[i] == self.session.rank()).collect()
    }

    /// The augmented system of a set times unknowns of displacement and all scaled multipliers: row by row as the module of
    /// the saddle point says it.
    fn product(&self, active: &[bool], u: &Vector, multipliers: &[f64]) -> Vec<f64> {
        let jumps = jump_matrix(self.problem.jumps(), active.len());
        let lambda: Vec<f64> = (0..active.len()).map(|i| if active[i] { self.scale[i] * multipliers[i] } else { 0.0 }).collect();
        let jumped: Vec<f64> = jumps.iter().map(|row| row.iter().map(|(&j, c)| c * lambda[j]).sum()).collect();
        let coupled = self.couple(&u.values());
        let active_only = |v: Vec<f64>| -> Vec<f64> { v.iter().zip(active).map(|(v, a)| if *a { *v } else { 0.0 }).collect() };
        let difference = active_only(coupled.iter().zip(&jumped).map(|(b, c)| b - c).collect());
        let weighted = self.weigh(active, &difference);
        let mut upper = u.duplicate().expect("a vector");
        self.stiffness.multiply(u, &mut upper).expect("a product");
        let mut rows = upper.values().to_vec();
        let transposed: Vec<f64> = weighted.iter().zip(&lambda).map(|(d, l)| d + l).collect();
        self.add_transposed(active, &transposed, &mut rows);
        for i in self.own() {
            let contact = self.problem.contact_of(i);
            let alone = contact.multipliers.single_weight(i - contact.first, contact.moduli[0]) / self.scale[i].powi(2);
            rows.push(if active[i] { self.scale[i] * difference[i] } else { -multipliers[i] / alone });
        }
        rows
    }
}

/// Largest difference of two lists of numbers on any rank, by the largest of the second.
fn apart(session: &Session, a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    let largest = |values: &mut dyn Iterator<Item = f64>| {
        let mut most = [values.map(f64::abs).fold(0.0, f64::max)];
        session.max(&mut most);
        most[0]
    };
    let whole = largest(&mut b.iter().copied());
    largest(&mut a.iter().zip(b).map(|(a, b)| a - b)) / whole
}

fn blocks_and_right_hand_side_are_those_of_the_set(session: &Session) {
    for problem in problems(session) {
        let definition = Definition::new(&problem, session);
        let (mut system, _) = system(&problem, SolverChoice::FieldSplit);
        let space = problem.finest();
        let mut u = Vector::new(session, space.local_unknowns()).expect("a vector");
        let first = 2 * space.own.start;
        u.values_mut().iter_mut().enumerate().for_each(|(at, v)| *v = 1e-3 * erratic(first + at, 0.3));
        for (node, constraint) in space.constraints.iter().filter(|(node, _)| space.own.contains(node)) {
            (0..2).filter(|&k| constraint.fixed[k]).for_each(|k| u.values_mut()[2 * node - first + k] = 0.0);
        }
        let multipliers: Vec<f64> = (0..problem.multiplier_count()).map(|i| erratic(i, 0.7)).collect();
        for active in sets(problem.multiplier_count()) {
            system.set_active(&active).expect("a set");
            assert_eq!(system.active(), active);
            let (mut x, mut y) = system.matrix().create_vectors().expect("vectors");
            let own = definition.own();
            x.values_mut()[..u.local_len()].copy_from_slice(&u.values());
            own.iter().enumerate().for_each(|(at, &i)| x.values_mut()[u.local_len() + at] = multipliers[i]);
            system.matrix().multiply(&x, &mut y).expect("a product");
            let expected = definition.product(&active, &u, &multipliers);
            let (upper, lower) = expected.split_at(u.local_len());
            assert!(apart(session, &y.values()[..u.local_len()], upper) < 1e-12);
            assert!(apart(session, &y.values()[u.local_len()..], lower) < 1e-12);
            check_right_hand_side(&definition, &system, &active);
        }
    }
}

/// `f + Bᵀ D c`, and `s c` on active multipliers; what prescribed displacements add is that of the first set, without contact.
fn check_right_hand_side(definition: &Definition, system: &System, active: &[bool]) {
    let session = definition.session;
    let gap = definition.gap();
    let closed: Vec<f64> = gap.iter().zip(active).map(|(c, active)| if *active { *c } else { 0.0 }).collect();
    let mut expected = definition.load();
    definition.add_transposed(active, &definition.weigh(active, &closed), &mut expected);
    let b = system.right_hand_side().expect("a right-hand side").values().to_vec();
    let unknowns = expected.len();
    assert!(apart(session, &b[..unknowns], &expected) < 1e-12);
    let own: Vec<f64> = definition.own().into_iter().map(|i| definition.scale[i] * closed[i]).collect();
    let none = !active.contains(&true);
    assert!(none || apart(session, &b[unknowns..], &own) < 1e-12);
}

fn prolong(interpolation: &Interpolation, x: &Vector, y: &mut Vector) {
    interpolation.nodes.prolong::<false>(x.values().as_chunks().0, y.values_mut().as_chunks_mut().0, &mut Default::default());
}

fn restrict(interpolation: &Interpolation, x: &Vector, y: &mut Vector) {
    interpolation.nodes.restrict(x.values().as_chunks().0, y.values_mut().as_chunks_mut().0, &mut Default::default());
}

fn every_level_is_the_galerkin_product_of_the_next(session: &Session) {
    let mut most = 0;
    for problem in problems(session) {
        let (mut system, interpolations) = system(&problem, SolverChoice::FieldSplit);
        for active in sets(problem.multiplier_count()).into_iter().skip(1).step_by(2) {
            system.set_active(&active).expect("a set");
            let levels = system.levels().expect("levels");
            assert_eq!(levels.len(), interpolations.len() + 1);
            most = most.max(levels.len());
            for (l, interpolation) in interpolations.iter().enumerate() {
                let [mut x, mut fine] = [l, l + 1].map(|l| Vector::new(session, 2 * levels[l].node_count()).expect("a vector"));
                let first = x.range().start;
                x.values_mut().iter_mut().enumerate().for_each(|(at, v)| *v = erratic(first + at, 0.3));
                // What is prescribed on the coarse level moves nothing on the fine one.
                prolong(interpolation, &x, &mut fine);
                let mut reached = x.duplicate().expect("a vector");
                restrict(interpolation, &fine, &mut reached);
                x.values_mut()
                    .iter_mut()
                    .zip(reached.values().iter())
                    .filter(|(_, reached)| **reached == 0.0)
                    .for_each(|(v, _)| *v = 0.0);
                let (mut product, mut coarse, mut found) =
                    (fine.duplicate().expect("a vector"), x.duplicate().expect("a vector"), x.duplicate().expect("a vector"));
                levels[l + 1].multiply(fine.values().as_chunks().0, product.values_mut().as_chunks_mut().0);
                restrict(interpolation, &product, &mut coarse);
                levels[l].multiply(x.values().as_chunks().0, found.values_mut().as_chunks_mut().0);
                assert!(apart(session, &found.values(), &coarse.values()) < 1e-8, "level {l} of {}", levels.len());
            }
        }
    }
    assert!(most > 4, "some problem has many levels");
}

fn the_solution_does_not_know_the_sets_before(session: &Session) {
    for problem in problems(session).into_iter().step_by(2) {
        let all = sets(problem.multiplier_count());
        let last = &all[all.len() - 1];
        let [mut travelled, mut fresh] = [0; 2].map(|_| system(&problem, SolverChoice::FieldSplit).0);
        for (k, set) in all.iter().enumerate() {
            travelled.set_active(set).expect("a set");
            // The solver has seen two of the sets.
            if k == 0 || k == 2 {
                travelled.solve(1e-3).expect("a solve");
            }
        }
        fresh.set_active(last).expect("a set");
        let [a, b] = [&mut travelled, &mut fresh].map(|system| {
            assert_eq!(system.solve(1e-11).expect("a solve").ending, LinearEnding::Converged);
            assert!(system.residual().expect("a residual").relative() <= 1e-11);
            (system.pressures(), system.displacement())
        });
        assert!(apart(session, &a.0, &b.0) < 1e-7, "pressures");
        assert!(apart(session, &a.1, &b.1) < 1e-8, "displacements");
        assert!(a.0.iter().zip(last).all(|(pressure, active)| *active || pressure.abs() < 1e-12));
    }
}

/// The second of two sweeps behind a factor had that one's package and no kind of its own, which PETSc refuses on one rank.
fn a_factor_leaves_nothing_behind_for_the_solvers_after_it(session: &Session) {
    use Preconditioning::{Factor, Steps, Sweep};
    let problem = &problems(session)[0];
    let pressures = [Factor, Sweep, Steps, Sweep, Factor, Sweep].map(|first| {
        let (mut system, _) = system_from(problem, SolverChoice::FieldSplit, first);
        assert_eq!(system.solve(1e-11).expect("a solve").ending, LinearEnding::Converged);
        system.pressures()
    });
    pressures.iter().for_each(|own| assert!(apart(session, &pressures[0], own) < 1e-7));
}

fn a_plain_system_has_the_solution_of_the_augmented_one(session: &Session) {
    let all = problems(session);
    for problem in &all[1..3] {
        let sets = sets(problem.multiplier_count());
        let [a, b] = [SolverChoice::FieldSplit, SolverChoice::Direct].map(|choice| {
            let (mut system, _) = system(problem, choice);
            sets[..3].iter().for_each(|set| system.set_active(set).expect("a set"));
            assert_eq!(system.solve(1e-11).expect("a solve").ending, LinearEnding::Converged);
            assert!(system.both_residuals().expect("a residual").1 < 1e-9);
            (system.pressures(), system.displacement())
        });
        assert!(apart(session, &a.0, &b.0) < 1e-7 && apart(session, &a.1, &b.1) < 1e-8);
    }
}

/// Dual problems are other right-hand sides of the same system: its own one gives its solution, forces act on each other's
/// displacements alike (Betti), and gaps are met where contact is closed.
fn responses_are_those_of_load_and_gap_and_reciprocal(session: &Session) {
    for problem in problems(session).into_iter().step_by(3) {
        let definition = Definition::new(&problem, session);
        let (mut system, _) = system(&problem, SolverChoice::FieldSplit);
        let set = &sets(problem.multiplier_count())[1];
        system.set_active(set).expect("a set");
        let mut respond = |load: &[f64], gap: &[f64]| system.response(load, gap, 1e-11).expect("a response");
        let (load, gap) = (definition.load(), definition.gap());
        let own = respond(&load, &gap);
        let first = problem.finest().own.start;
        let erratic_load = |seed: f64| -> Vec<f64> {
            let free = |(k, value): (usize, f64)| if load_is_free(&problem, first, k) { value } else { 0.0 };
            (0..load.len()).map(|k| erratic(2 * first + k, seed)).enumerate().map(free).collect()
        };
        let none = vec![0.0; gap.len()];
        let [f, g] = [0.3, 4.0].map(erratic_load);
        let (by_f, by_g) = (respond(&f, &none), respond(&g, &none));
        let mut works = [(&f, &by_g), (&g, &by_f)].map(|(force, way)| force.iter().zip(way).map(|(a, b)| a * b).sum::<f64>());
        session.sum(&mut works);
        assert!((works[0] / works[1] - 1.0).abs() < 1e-7, "{works:?}");
        let wanted: Vec<f64> = (0..gap.len()).map(|i| if set[i] { 1e-3 * erratic(i, 7.0) } else { 0.0 }).collect();
        if problem.jumps().next().is_none() {
            let met = definition.couple(&respond(&vec![0.0; load.len()], &wanted));
            let closed = |v: &[f64]| -> Vec<f64> { v.iter().zip(set).filter(|(_, active)| **active).map(|(v, _)| *v).collect() };
            assert!(apart(session, &closed(&met), &closed(&wanted)) < 1e-7);
        }
        assert_eq!(system.solve(1e-11).expect("a solve").ending, LinearEnding::Converged, "responses leave the system as it was");
        assert!(apart(session, &own, &system.with_free_displacement(<[f64]>::to_vec)) < 1e-7);
    }
}

/// Motions that are no unknowns of the blocks: the direct solver finds the same ones, and so does a system that has had other
/// sets; forces that act on nodes act on each other's displacements alike.
fn rigid_motions_are_those_of_every_solver_and_set(session: &Session) {
    for problem in &moving_problems(session) {
        let all = sets(problem.multiplier_count());
        let found = [SolverChoice::FieldSplit, SolverChoice::Direct, SolverChoice::FieldSplit].map(|choice| {
            let mut system = system(problem, choice).0;
            for (k, set) in all.iter().enumerate().filter(|(k, _)| *k != 3) {
                system.set_active(set).expect("a set");
                if k == 0 || k == 2 {
                    system.solve(1e-3).expect("a solve");
                }
            }
            let solved = system.solve(1e-11).expect("a solve");
            assert_eq!(solved.ending, LinearEnding::Converged);
            assert!(choice == SolverChoice::FieldSplit || solved.iterations <= 8, "a factor: {} iterations", solved.iterations);
            (system.pressures(), system.displacement())
        });
        let mut fresh = system(problem, SolverChoice::FieldSplit).0;
        fresh.set_active(&all[all.len() - 1]).expect("a set");
        assert_eq!(fresh.solve(1e-11).expect("a solve").ending, LinearEnding::Converged);
        for (pressures, displacement) in &found {
            assert!(apart(session, pressures, &fresh.pressures()) < 1e-6, "pressures");
            assert!(apart(session, displacement, &fresh.displacement()) < 1e-7, "displacements");
        }
        let (first, count) = (problem.finest().own.start, problem.finest().local_unknowns());
        let free = |k: usize, value: f64| if load_is_free(problem, first, k) { value } else { 0.0 };
        let [f, g] = [0.3, 4.0].map(|seed| (0..count).map(|k| free(k, erratic(2 * first + k, seed))).collect::<Vec<f64>>());
        let none = vec![0.0; problem.multiplier_count()];
        let [by_f, by_g] = [&f, &g].map(|load| fresh.response(load, &none, 1e-11).expect("a response"));
        let mut works = [(&f, &by_g), (&g, &by_f)].map(|(force, way)| force.iter().zip(way).map(|(a, b)| a * b).sum::<f64>());
        session.sum(&mut works);
        assert!((works[0] / works[1] - 1.0).abs() < 1e-6, "{works:?}");
    }
}

/// Whether no support holds component `k` of this rank.
fn load_is_free(problem: &Discretisation, first: usize, k: usize) -> bool {
    problem.finest().constraints.get(first + k / 2).is_none_or(|constraint| !constraint.fixed[k % 2])
}

/// For unknowns that solve nothing: `f - K u - Bᵀ λ`, and `s (c - B u + C λ)` on active multipliers, by `|b|` of the system.
fn the_plain_residual_is_that_of_the_system_without_augmentation(session: &Session) {
    for problem in &problems(session)[1..4] {
        let definition = Definition::new(problem, session);
        let (mut system, _) = system(problem, SolverChoice::FieldSplit);
        let space = problem.finest();
        let (count, first) = (problem.multiplier_count(), 2 * space.own.start);
        let mut u = Vector::new(session, space.local_unknowns()).expect("a vector");
        u.values_mut().iter_mut().enumerate().for_each(|(at, v)| *v = 1e-3 * erratic(first + at, 0.3));
        for (node, constraint) in space.constraints.iter().filter(|(node, _)| space.own.contains(node)) {
            (0..2).filter(|&k| constraint.fixed[k]).for_each(|k| u.values_mut()[2 * node - first + k] = 0.0);
        }
        for active in &sets(count)[..3] {
            let lambda: Vec<f64> = (0..count).map(|i| if active[i] { erratic(i, 0.7) } else { 0.0 }).collect();
            let start = Start { displacement: u.values().to_vec(), pressures: lambda.clone(), active: active.clone() };
            system.begin(&start).expect("a start");
            let (gap, mut upper) = (definition.gap(), definition.load());
            let mut product = u.duplicate().expect("a vector");
            definition.stiffness.multiply(&u, &mut product).expect("a product");
            upper.iter_mut().zip(product.values().iter()).for_each(|(f, k)| *f -= k);
            let pulled: Vec<f64> = lambda.iter().map(|v| -v).collect();
            definition.add_transposed(active, &pulled, &mut upper);
            let coupled = definition.couple(&u.values());
            let jumps = jump_matrix(problem.jumps(), count);
            let jumped = |i: usize| -> f64 { jumps[i].iter().map(|(&j, c)| c * lambda[j]).sum() };
            let lower = definition.own().into_iter().filter(|&i| active[i]);
            let lower = lower.map(|i| definition.scale[i] * (gap[i] - coupled[i] + jumped(i)));
            let mut square = [upper.into_iter().chain(lower).map(|v| v * v).sum::<f64>()];
            session.sum(&mut square);
            let expected = square[0].sqrt() / system.right_hand_side().expect("a right-hand side").norm().expect("a norm");
            let found = system.both_residuals().expect("a residual").1;
            assert!((found / expected - 1.0).abs() < 1e-10, "{found} instead of {expected}");
        }
    }
}

/// The rank that owns a multiplier owns a macro triangle of body 1 that holds the middle of its segment.
fn multipliers_live_where_body_one_does(session: &Session) {
    let mut elsewhere = 0;
    for problem in problems(session) {
        let (mesh, partition) = (&problem.scene.mesh, &problem.scene.partition);
        let contact = &problem.contacts[0];
        let knots = contact.boundary.knots();
        assert_eq!(problem.coupling.owners.len(), contact.multipliers.count());
        for (i, &owner) in problem.coupling.owners.iter().enumerate() {
            let k = contact.multipliers.segment_of(i);
            let middle = contact.boundary.point(0.5 * (knots[k] + knots[k + 1]));
            let holds = |t: &usize| mesh.triangles[*t].body as usize == contact.bodies[0] && mesh.locate(*t, middle).is_some();
            let mut ranks = (0..mesh.triangles.len()).filter(holds).map(|t| partition.owner(t as u32));
            assert!(ranks.any(|rank| rank == owner), "multiplier {i} belongs to rank {owner}");
            elsewhere += usize::from(owner > 0);
        }
    }
    assert!(session.size() == 1 || elsewhere > 0, "all multipliers belong to the first rank");
}

/// Owners of multipliers, and ranks that own a macro edge of the row, or an end of one, on some level.
fn rows_of_b_are_whole_where_they_are_needed_and_nowhere_else(session: &Session) {
    let (mut missing, rank) = (0, session.rank());
    for problem in problems(session) {
        let (mesh, coupling, spaces) = (&problem.scene.mesh, &problem.coupling, &problem.spaces);
        // All rows, from the ranks that own them.
        let own: Vec<usize> = coupling.own(0..coupling.owners.len(), rank).collect();
        let entries = || own.iter().flat_map(|&i| coupling.rows[i].iter().map(move |coupled| (i, coupled)));
        let keys = |(i, coupled): (usize, &Coupled)| [i as i32, coupled.node.edge as i32, coupled.node.position as i32];
        let keys = session.gather_all(&entries().flat_map(keys).collect::<Vec<_>>());
        let values =
            session.gather_all(&entries().flat_map(|(_, coupled)| [coupled.value.x, coupled.value.y]).collect::<Vec<_>>());
        let mut whole = vec![Vec::new(); coupling.owners.len()];
        for (key, value) in keys.chunks_exact(3).zip(values.chunks_exact(2)) {
            whole[key[0] as usize].push((key[1] as u32, key[2] as u32, [value[0], value[1]]));
        }
        for contact in &problem.contacts {
            for i in contact.range() {
                let group = contact.multipliers.group_of(i - contact.first);
                let together = contact.range().filter(|j| contact.multipliers.group_of(j - contact.first) == group);
                let ranks = together
                    .flat_map(|j| &whole[j])
                    .flat_map(|(edge, _, _)| spaces.iter().flat_map(|space| space.numbering.ranks_of(mesh, *edge)));
                let is_needed = coupling.owners[i] == rank || ranks.into_iter().any(|other| other == rank);
                let here = coupling.rows[i].iter().map(|c| (c.node.edge, c.node.position, [c.value.x, c.value.y]));
                let here: Vec<_> = here.collect();
                assert!(if is_needed { here == whole[i] } else { here.is_empty() }, "row {i}");
                assert!(!whole[i].is_empty(), "row {i}");
                missing += usize::from(!is_needed);
            }
        }
    }
    let missing: usize = session.gather_counts(missing).into_iter().sum();
    assert!(session.size() < 3 || missing > 0, "all rows are everywhere");
}

/// The lower bar between bent sides, the upper one straight.
fn ranks_are_dealt_equal_work(session: &Session) {
    let text = meshes::Mesh::inclined_bars(1).text();
    let mut mesh = parse_gmsh(text.as_bytes(), "bars.msh".as_ref(), Default::default()).expect("a mesh");
    for (name, slope, start) in [("bottom", 0.0, 0.0), ("lower.seam", 1.0 / 6.0, 3.0)] {
        let formula = format!("{start} + {slope} * t + 0.002 * t * (6 - t)");
        let read = |text: &str| Formula::parse(text, &["t"]).expect("a formula");
        let curve = Curve::Parametric(ParametricCurve::new(read("t"), read(&formula), [0.0, 6.0]));
        mesh.bend("arc", &[name.into()], &curve).expect("the ends of the edges lie near it");
    }
    let graph = Graph::new(&mesh, &[]);
    for order in [Order::P1, Order::P2] {
        let work = mesh.work(order, 6);
        let most = |weights: &[i32]| {
            let (offsets, neighbours) = (&graph.offsets, &graph.neighbours);
            let ranks = partition(session, session.size(), offsets, neighbours, &graph.connection_weights, weights);
            let mut sums = vec![0; session.size()];
            ranks.expect("a partition").into_iter().zip(&work).for_each(|(rank, work)| sums[rank as usize] += work);
            let mean = f64::from(sums.iter().sum::<i32>()) / session.size() as f64;
            f64::from(sums.into_iter().max().expect("a rank")) / mean
        };
        let [weighed, counted] = [most(&work), most(&vec![1; work.len()])];
        assert!(weighed < 1.05, "{order:?}: a rank has {weighed} times the mean work");
        assert!(session.size() == 1 || counted > 1.08, "{order:?}: equal numbers would do as well: {counted}");
    }
}
