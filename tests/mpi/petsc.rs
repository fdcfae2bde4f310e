//! The layer over PETSc and MPI on 1, 2 and 3 ranks.

mod launch;
mod support;

use launch::{LIST_LEAKS, Suite, alone, mpirun, named};
use mezha::petsc::{
    Error, Halo, Index, Krylov, Matrix, Operator, Session, Stage, Vector, errors_are_final, options, partition, versions,
};
use std::time::{Duration, Instant};
use support::{HeldString, clear, laplacian, ramp, share, sparse};

const DEFAULTS: &[&str] = &["-test_default", "1", "-test_both", "1"];
const USER: &[&str] = &[
    "-test_both 2",
    "-test_mistyped 7",
    "-test_flag",
    "-test_below -1.5",
    "-other_fieldsplit_u_pc_type lu",
    "-other_fieldsplit_u_pc_factor_mat_solver_type mumps",
];

fn main() -> std::process::ExitCode {
    Suite {
        options: (DEFAULTS, USER),
        checks: named![
            options_of_the_user_win,
            options_without_use_are_listed,
            versions_are_known,
            ranks_tell_each_other,
            ranks_agree,
            ranks_share_what_the_first_has,
            ranks_meet,
            vector_algebra,
            owners_add_in_the_order_of_the_ranks,
            entries_arrive_by_rank_in_the_order_of_each,
            a_halo_brings_values_and_gives_sums_back,
            matrix_of_exact_counts,
            matrix_in_blocks,
            a_nest_sees_what_becomes_of_its_blocks,
            wrong_calls_give_words,
            nest_is_its_blocks,
            operator_acts,
            operator_errors_are_reported,
            krylov_converges,
            krylov_names_its_failure,
            schur_complement_with_a_preconditioner_of_the_user,
            partition_is_balanced_and_cheap,
            stages_add_up,
        ],
        outside: named![
            a_panic_ends_all_ranks,
            a_rank_alone_gives_up,
            an_error_beside_a_factor_ends_all_ranks,
            a_leak_is_listed,
            a_second_start_is_an_error,
            a_session_needs_no_mpirun,
        ],
        scenarios: named![panic_on_the_last_rank, meet_nobody, fail_beside_a_factor, leak_a_solver, start_twice, solve_alone],
    }
    .run()
}

fn options_of_the_user_win(session: &Session) {
    assert_eq!(options::get(session, "-test_default").as_deref(), Some("1"));
    assert_eq!(options::get(session, "-test_both").as_deref(), Some("2"));
    assert_eq!(options::get(session, "-test_below").as_deref(), Some("-1.5"));
    assert_eq!(options::get(session, "-test_flag").as_deref(), Some(""));
    assert_eq!(options::get(session, "-test_nobody"), None);
    for name in ["-test_both", "-test_default", "-test_new"] {
        options::set_default(session, name, "3").unwrap();
    }
    assert_eq!(options::get(session, "-test_both").as_deref(), Some("2"));
    assert_eq!(options::get(session, "-test_default").as_deref(), Some("3"));
    options::set_default(session, "-test_new", "4").unwrap();
    assert_eq!(options::get(session, "-test_new").as_deref(), Some("4"));
    for name in ["-test_both", "-test_new"] {
        options::clear(session, name).unwrap();
    }
    assert_eq!(options::get(session, "-test_both").as_deref(), Some("2"));
    assert_eq!(options::get(session, "-test_new"), None);
}

fn options_without_use_are_listed(session: &Session) {
    let mut unused = options::unused(session).unwrap();
    unused.sort();
    let mut given = USER.to_vec();
    given.sort();
    assert_eq!(unused, given);
}

fn versions_are_known(_session: &Session) {
    assert!(versions::petsc().starts_with("3."), "{}", versions::petsc());
    assert!([32, 64].contains(&versions::index_bits()));
    assert!(versions::mpi().starts_with("Open MPI v"), "{}", versions::mpi());
    assert!(versions::blas().contains(".so"), "{}", versions::blas());
}

fn ranks_tell_each_other(session: &Session) {
    let (rank, size) = (session.rank(), session.size());
    assert_eq!(session.gather_counts(10 + rank), (0..size).map(|r| 10 + r).collect::<Vec<_>>());
    // Rank r sends r numbers.
    let numbers: Vec<usize> = (0..size).flat_map(|r| vec![r; r]).collect();
    assert_eq!(session.gather_all(&vec![rank as f64; rank]), numbers.iter().map(|r| *r as f64).collect::<Vec<_>>());
    assert_eq!(session.gather_all(&vec![rank as i32; rank]), numbers.iter().map(|r| *r as i32).collect::<Vec<_>>());
    assert_eq!(session.gather_all(&vec![rank as u64; rank]), numbers.iter().map(|r| *r as u64).collect::<Vec<_>>());
    assert_eq!(session.gather_all(&vec![rank as u8; rank]), numbers.iter().map(|r| *r as u8).collect::<Vec<_>>());

    let mut sums = [1.0, 0.1 * (rank as f64 + 1.0), 1e16 / (rank as f64 + 3.0)];
    session.sum(&mut sums);
    assert_eq!(sums[0], size as f64);
    let bits = session.gather_all(&sums.map(f64::to_bits));
    assert!(bits.chunks(3).all(|others| others == &bits[..3]), "the same bits on every rank");
    let mut high = [rank as f64, -1.0];
    session.max(&mut high);
    assert_eq!(high, [size as f64 - 1.0, -1.0]);
    assert!(session.any(rank + 1 == size) && !session.any(false));
}

fn ranks_agree(session: &Session) {
    assert_eq!(session.agree(Ok::<_, String>(session.rank())), Ok(session.rank()));
    let here = if session.rank() == 0 { Ok(()) } else { Err(format!("no luck on {}", session.rank())) };
    let expected = match (session.size(), session.rank()) {
        (1, _) => Ok(()),
        (_, 0) => Err("another rank failed: no luck on 1".into()),
        (_, rank) => Err(format!("no luck on {rank}")),
    };
    assert_eq!(session.agree(here), expected);
}

fn ranks_share_what_the_first_has(session: &Session) {
    for length in [0, 1, 100_000] {
        let own: Vec<u8> = (0..length).map(|i| (i % 251) as u8).collect();
        let read = || if session.rank() == 0 { Ok::<_, String>(own.clone()) } else { panic!("only rank 0 reads") };
        assert_eq!(session.share(read), Ok(own.clone()));
    }
    assert_eq!(session.share(|| Err("no such file")), Err("no such file".to_string()), "the same words on every rank");
}

/// A rank that nobody joins does not wait for ever; one that is late is waited for.
fn ranks_meet(session: &Session) {
    let late = session.rank() + 1 == session.size();
    if late {
        std::thread::sleep(Duration::from_millis(50));
    }
    assert!(session.meet(Duration::from_secs(60)));
}

fn vector_algebra(session: &Session) {
    // Rank r owns r entries, the first rank none.
    let (rank, size) = (session.rank(), session.size());
    let mut x = Vector::new(session, rank).unwrap();
    assert_eq!(x.local_len(), rank);
    assert_eq!(x.range(), rank * rank.saturating_sub(1) / 2..rank * (rank + 1) / 2);
    x.values_mut().fill(2.0);
    let n = (size * (size - 1) / 2) as f64;
    let mut y = x.duplicate().unwrap();
    y.set(-1.0).unwrap();
    y.axpy(2.0, &x).unwrap();
    assert!(y.values().iter().all(|value| *value == 3.0));
    x.copy_from(&y).unwrap();
    assert!((x.norm().unwrap() - 3.0 * n.sqrt()).abs() < 1e-12);
}

/// Numbers of very unequal size: their sum depends on the order, which is own values first and then rank after rank.
fn owners_add_in_the_order_of_the_ranks(session: &Session) {
    let (rank, size) = (session.rank(), session.size());
    let part = |rank: usize, block: usize| [1e16 / 7f64.powi(2 * rank as i32 + block as i32 % 3), 1.0, rank as f64];
    let own = 2 * rank..2 * rank + 2;
    let far = (0..2 * size).rev().filter(|block| !own.contains(block));
    let others: Vec<_> = far.map(|block| (block, part(rank, block))).collect();
    let mut sums: Vec<[f64; 3]> = own.clone().map(|block| part(rank, block)).collect();
    session.add_to_owners(&own, &mut sums, others);
    for (block, sum) in own.zip(sums) {
        let mut expected = part(rank, block);
        for other in (0..size).filter(|other| *other != rank) {
            part(other, block).iter().zip(&mut expected).for_each(|(value, sum)| *sum += value);
        }
        assert_eq!(sum.map(f64::to_bits), expected.map(f64::to_bits));
    }
    session.add_to_owners::<1>(&(0..0), &mut [], Vec::new());
}

/// Each rank sends some to every other, and to some none.
fn entries_arrive_by_rank_in_the_order_of_each(session: &Session) {
    let (rank, size) = (session.rank(), session.size());
    let to: Vec<usize> = (0..5 * size).map(|k| (3 * k + rank) % size).filter(|to| *to <= rank).collect();
    let entries: Vec<i32> = (0..to.len() as i32).flat_map(|k| [rank as i32, k]).collect();
    let arrived = session.send_to(&to, &entries, 2);
    let expected: Vec<i32> = (rank..size)
        .flat_map(|from| {
            let to = (0..5 * size).map(move |k| (3 * k + from) % size).filter(move |to| *to <= from);
            to.enumerate().filter(|(_, to)| *to == rank).flat_map(move |(k, _)| [from as i32, k as i32]).collect::<Vec<_>>()
        })
        .collect();
    assert_eq!(arrived, expected);
    assert!(session.send_to::<f64>(&[], &[], 3).is_empty());
}

/// Every rank needs all nodes of all others.
fn a_halo_brings_values_and_gives_sums_back(session: &Session) {
    let own = share(session, 7);
    let far: Vec<usize> = (0..7).filter(|node| !own.contains(node)).collect();
    let value = |node: usize| [0.0, 10.0, 20.0].map(|more| node as f64 + more);
    let mut here: Vec<[f64; 3]> = own.clone().map(value).collect();
    let mut there = vec![[0.0; 3]; far.len()];
    let halo = Halo::new(session, &own, &far);
    halo.fetch(&here, &mut there, || ());
    assert_eq!(there, far.iter().map(|&node| value(node)).collect::<Vec<_>>());
    halo.give(&there, &mut here);
    assert!(own.zip(here).all(|(node, sum)| sum == value(node).map(|value| session.size() as f64 * value)));
}

fn matrix_of_exact_counts(session: &Session) {
    let n = 10;
    let mut a = laplacian(session, n, |_| 0.0);
    assert_eq!((a.size(), a.row_range()), ((n, n), share(session, n)));
    assert_eq!(a.local_size(), (share(session, n).len(), share(session, n).len()));
    assert_eq!(a.norm_infinity().unwrap(), 4.0);

    let x = ramp(session, n);
    let (mut y, mut r) = a.create_vectors().unwrap();
    a.multiply(&x, &mut y).unwrap();
    // The second difference of a ramp vanishes but at its ends.
    let ends = [(0, -1.0), (n - 1, n as f64)];
    let at = |i| ends.iter().find(|end| end.0 == i).map_or(0.0, |end| end.1);
    let expected: Vec<f64> = share(session, n).map(at).collect();
    assert_eq!(*y.values(), *expected);
    a.residual(&y, &x, &mut r).unwrap();
    assert_eq!(r.norm().unwrap(), 0.0);
    a.multiply_add(&x, &mut r).unwrap();
    r.axpy(-1.0, &y).unwrap();
    assert_eq!(r.norm().unwrap(), 0.0);
    clear(&mut a);
    assert_eq!(a.norm_infinity().unwrap(), 0.0);
}

fn matrix_in_blocks(session: &Session) {
    // One 2 x 2 block per rank on the diagonal, and one in the column of rank 0, filled by rank 0 from afar.
    let (rank, size) = (session.rank() as Index, session.size() as Index);
    let mut a = Matrix::aij(session, 2, 2, 2, &[1], &[Index::from(rank > 0)]).unwrap();
    a.insert_blocks(&[rank], &[rank, -1], &[1.0, 2.0, 9.0, 9.0, 3.0, 4.0, 9.0, 9.0]).unwrap();
    if rank == 0 {
        for other in 1..size {
            a.insert_blocks(&[other], &[0], &[5.0, 6.0, 7.0, 8.0]).unwrap();
        }
    }
    a.assemble().unwrap();
    let mut x = Vector::new(session, 2).unwrap();
    x.values_mut().copy_from_slice(&[1.0, 10.0]);
    let mut y = x.duplicate().unwrap();
    a.multiply(&x, &mut y).unwrap();
    assert_eq!(*y.values(), if rank == 0 { [21.0, 43.0] } else { [86.0, 130.0] });
    a.insert(&[2 * rank], &[2 * rank, -1], &[0.0, 9.0]).unwrap();
    a.assemble().unwrap();
    a.multiply(&x, &mut y).unwrap();
    assert_eq!(y.values()[0], if rank == 0 { 20.0 } else { 85.0 });
}

fn a_nest_sees_what_becomes_of_its_blocks(session: &Session) {
    let zero = || sparse(session, 2, 2, |i| vec![(i, 0.0)]);
    let (mut a, one) = (laplacian(session, 2, |_| 0.0), laplacian(session, 2, |_| 0.0));
    let nest = Matrix::nest(session, [[&a, &zero()], [&zero(), &one]]).unwrap();
    clear(&mut a);
    drop((a, one));
    let (mut x, mut y) = nest.create_vectors().unwrap();
    x.set(1.0).unwrap();
    nest.multiply(&x, &mut y).unwrap();
    // The upper half is zero now, the lower one (2 - 1, 2 - 1).
    assert_eq!(y.norm().unwrap().powi(2).round(), 2.0);
}

fn wrong_calls_give_words(session: &Session) {
    let words = |outcome: Result<(), Error>| match outcome {
        Err(Error::Petsc { call, message, .. }) => format!("{call}: {message}"),
        other => panic!("not an error of PETSc's: {other:?}"),
    };
    let krylov = Krylov::new(session, "").unwrap();
    let text = words(krylov.preconditioner().set_kind("nonsense"));
    assert!(text.starts_with("PCSetType: Unable to find requested PC type nonsense"), "{text}");

    let mut a = laplacian(session, 10, |_| 0.0);
    let row = a.row_range().start as Index;
    let text = words(a.insert(&[row], &[(row + 4) % 10], &[1.0]));
    assert!(text.starts_with("MatSetValues: ") && text.contains("nonzero"), "{text}");

    let a = laplacian(session, 10, |_| 0.0);
    let (x, mut short) = (ramp(session, 10), ramp(session, 9));
    let text = words(a.multiply(&x, &mut short));
    assert!(text.contains("10") && text.contains('9'), "{text}");
    assert!(a.nest_index_sets().is_err());
}

fn nest_is_its_blocks(session: &Session) {
    let (n, m) = (8, 3);
    let mut k = laplacian(session, n, |_| 0.0);
    let b = sparse(session, m, n, |i| vec![(i, 1.0), (i + 4, -1.0)]);
    let b_transpose = sparse(session, n, m, |j| {
        (0..m).filter(|i| j == *i || j == i + 4).map(|i| (i, if j == i { 1.0 } else { -1.0 })).collect()
    });
    let zero = sparse(session, m, m, |i| vec![(i, 0.0)]);
    let mut nest = Matrix::nest(session, [[&k, &b_transpose], [&b, &zero]]).unwrap();
    assert_eq!(nest.size(), (n + m, n + m));

    let [upper, lower] = nest.nest_index_sets().unwrap();
    let (own_n, own_m) = (share(session, n).len(), share(session, m).len());
    let first = nest.row_range().start as Index;
    assert_eq!(upper.indices().unwrap(), (first..first + own_n as Index).collect::<Vec<_>>());
    assert_eq!(lower.indices().unwrap().len(), own_m);

    // Product by blocks.
    let (u, lambda) = (ramp(session, n), ramp(session, m));
    let (mut top, mut bottom) = (u.duplicate().unwrap(), lambda.duplicate().unwrap());
    k.multiply(&u, &mut top).unwrap();
    b_transpose.multiply_add(&lambda, &mut top).unwrap();
    b.multiply(&u, &mut bottom).unwrap();
    let expected = [&*top.values(), &*bottom.values()].concat();
    let (mut x, mut y) = nest.create_vectors().unwrap();
    x.values_mut().copy_from_slice(&[&*u.values(), &*lambda.values()].concat());
    nest.multiply(&x, &mut y).unwrap();
    assert_eq!(*y.values(), *expected);

    let converted = nest.convert_aij().unwrap();
    converted.multiply(&x, &mut y).unwrap();
    assert_eq!(*y.values(), *expected);

    // The nest shares its blocks.
    clear(&mut k);
    nest.assemble().unwrap();
    b_transpose.multiply(&lambda, &mut top).unwrap();
    nest.multiply(&x, &mut y).unwrap();
    assert_eq!(y.values()[..own_n], *top.values());
}

/// A diagonal matrix by its action; says no where it is told to.
struct Diagonal {
    value: f64,
    broken: bool,
}

impl Operator for Diagonal {
    fn multiply(&self, x: &Vector, y: &mut Vector) -> Result<(), Error> {
        y.set(0.0)?;
        y.axpy(self.value, x)?;
        if self.broken { Err(Error::AlreadyStarted) } else { Ok(()) }
    }

    fn norm_infinity(&self) -> Result<f64, Error> {
        Ok(self.value)
    }

    fn work(&self) -> f64 {
        1.0
    }
}

fn operator_acts(session: &Session) {
    let own = share(session, 6).len();
    let a = Matrix::operator(session, own, own, Box::new(Diagonal { value: 0.5, broken: false })).unwrap();
    let b = ramp(session, 6);
    let mut x = b.duplicate().unwrap();
    let krylov = Krylov::new(session, "").unwrap();
    krylov.set_operators(&a, &a).unwrap();
    krylov.preconditioner().set_kind("none").unwrap();
    let solved = krylov.solve_allowing(&b, &mut x).unwrap();
    assert!(solved.converged && solved.iterations == 1, "{solved:?}");
    let mut r = b.duplicate().unwrap();
    a.residual(&b, &x, &mut r).unwrap();
    assert!(r.norm().unwrap() < 1e-12);
    assert_eq!(a.norm_infinity().unwrap(), 0.5);
}

fn operator_errors_are_reported(session: &Session) {
    let a = Matrix::operator(session, 1, 1, Box::new(Diagonal { value: 1.0, broken: true })).unwrap();
    let x = Vector::new(session, 1).unwrap();
    let mut y = x.duplicate().unwrap();
    let Err(Error::Petsc { call, message, .. }) = a.multiply(&x, &mut y) else { panic!("the error was lost") };
    assert_eq!(call, "MatMult");
    assert_eq!(message, Error::AlreadyStarted.to_string());
    let sound = Matrix::operator(session, 1, 1, Box::new(Diagonal { value: 3.0, broken: false })).unwrap();
    y.set(2.0).unwrap();
    let mut z = y.duplicate().unwrap();
    sound.multiply(&y, &mut z).unwrap();
    assert_eq!(z.values()[0], 6.0);
}

fn krylov_converges(session: &Session) {
    let n = 40;
    let mut a = laplacian(session, n, |_| 0.0);
    a.set_symmetric(true).unwrap();
    a.set_positive_definite(true).unwrap();
    options::set_default(session, "-line_ksp_type", "cg").unwrap();
    options::set_default(session, "-line_pc_type", "jacobi").unwrap();
    let krylov = Krylov::new(session, "line_").unwrap();
    krylov.set_operators(&a, &a).unwrap();
    krylov.set_tolerance(1e-10, 100).unwrap();
    krylov.set_from_options().unwrap();
    krylov.set_up().unwrap();
    let exact = ramp(session, n);
    let (mut x, mut b) = a.create_vectors().unwrap();
    a.multiply(&exact, &mut b).unwrap();
    let solved = krylov.solve_allowing(&b, &mut x).unwrap();
    assert!(solved.converged && solved.reason.starts_with("KSP_CONVERGED") && solved.iterations <= n, "{solved:?}");
    let history = krylov.residual_history();
    assert_eq!(history.len(), solved.iterations + 1);
    assert_eq!(history.last(), Some(&solved.residual));
    x.axpy(-1.0, &exact).unwrap();
    assert!(x.norm().unwrap() < 1e-7);

    // From the solution there is nothing left to do.
    krylov.set_initial_guess_nonzero(true).unwrap();
    x.copy_from(&exact).unwrap();
    let solved = krylov.solve_allowing(&b, &mut x).unwrap();
    assert!(solved.converged && solved.iterations == 0, "{solved:?}");
}

fn krylov_names_its_failure(session: &Session) {
    let a = laplacian(session, 40, |_| 0.0);
    let b = ramp(session, 40);
    let mut x = b.duplicate().unwrap();
    let krylov = Krylov::new(session, "short_").unwrap();
    krylov.set_operators(&a, &a).unwrap();
    krylov.set_tolerance(1e-10, 2).unwrap();
    krylov.preconditioner().set_kind("jacobi").unwrap();
    let solved = krylov.solve_allowing(&b, &mut x).unwrap();
    assert!(!solved.converged && solved.iterations == 2 && solved.residual > 0.0, "{solved:?}");
    assert_eq!(solved.reason, "KSP_DIVERGED_ITS");

    // A factorisation of a singular matrix.
    let mut a = laplacian(session, 4, |_| 0.0);
    clear(&mut a);
    let b = ramp(session, 4);
    let mut x = b.duplicate().unwrap();
    let krylov = Krylov::new(session, "singular_").unwrap();
    krylov.set_operators(&a, &a).unwrap();
    options::set_default(session, "-singular_pc_type", "redundant").unwrap();
    krylov.set_from_options().unwrap();
    let solved = krylov.solve_allowing(&b, &mut x).unwrap();
    assert!(!solved.converged, "{solved:?}");
    assert_eq!(solved.reason, "KSP_DIVERGED_PC_FAILED (an inner preconditioner failed)");
}

fn schur_complement_with_a_preconditioner_of_the_user(session: &Session) {
    let problem = HeldString::new(session);
    // For the nodes of the second solver the user has chosen another preconditioner.
    for (prefix, kind) in [("string_", "redundant"), ("other_", "lu")] {
        let krylov = problem.solver(prefix);
        let fields = krylov.preconditioner().field_split_solvers().unwrap();
        assert_eq!(fields[0].preconditioner().kind(), kind);
        let (b, exact) = (problem.right_hand_side(), problem.solution());
        let mut x = b.duplicate().unwrap();
        let solved = krylov.solve_allowing(&b, &mut x).unwrap();
        assert!(solved.converged && solved.iterations < 15, "{prefix} {solved:?}");
        x.axpy(-1.0, &exact).unwrap();
        assert!(x.norm().unwrap() < 1e-7 * exact.norm().unwrap(), "{prefix}");
    }
}

fn partition_is_balanced_and_cheap(session: &Session) {
    // A strip of 20 x 4 vertices with heavy edges along x in its lower half.
    let (nx, ny) = (20, 4);
    let (mut offsets, mut neighbours) = (vec![0], Vec::new());
    for v in 0..nx * ny {
        let (x, y) = (v % nx, v / nx);
        neighbours.extend((x > 0).then(|| v as i32 - 1));
        neighbours.extend((x + 1 < nx).then(|| v as i32 + 1));
        neighbours.extend((y > 0).then(|| (v - nx) as i32));
        neighbours.extend((y + 1 < ny).then(|| (v + nx) as i32));
        offsets.push(neighbours.len() as i32);
    }
    let cut = |part: &[i32]| -> usize {
        (0..nx * ny)
            .map(|v| {
                neighbours[offsets[v] as usize..offsets[v + 1] as usize].iter().filter(|w| part[v] != part[**w as usize]).count()
            })
            .sum::<usize>()
            / 2
    };
    let (light, even) = (vec![1; neighbours.len()], vec![1; nx * ny]);
    assert_eq!(partition(session, 1, &offsets, &neighbours, &light, &even).unwrap(), vec![0; nx * ny]);
    for parts in 2..4 {
        let part = partition(session, parts, &offsets, &neighbours, &light, &even).unwrap();
        let counts: Vec<usize> = (0..parts as i32).map(|p| part.iter().filter(|q| **q == p).count()).collect();
        assert!(counts.iter().all(|count| count.abs_diff(nx * ny / parts) <= nx * ny / 10), "{counts:?}");
        assert!(cut(&part) <= 6 * (parts - 1), "{}", cut(&part));
        let all = session.gather_all(&part);
        assert!(all.chunks(part.len()).all(|other| other == part), "the same on every rank");
        assert_eq!(partition(session, parts, &offsets, &neighbours, &light, &even).unwrap(), part);
    }
    // Two vertices, fewer than there may be ranks; and one that has no neighbour.
    let mut part = partition(session, 2, &[0, 1, 2], &[1, 0], &[1, 1], &[1; 2]).unwrap();
    part.sort();
    assert_eq!(part, [0, 1]);
    assert_eq!(partition(session, 2, &[0, 0, 1, 2], &[2, 1], &[1, 1], &[1, 2, 1]).unwrap().len(), 3);

    // Heavy edges along x: the cut goes along the strip, where a plain one goes across.
    let across: Vec<i32> = (0..nx * ny)
        .flat_map(|v| {
            neighbours[offsets[v] as usize..offsets[v + 1] as usize]
                .iter()
                .map(move |w| if v.abs_diff(*w as usize) == 1 { 50 } else { 1 })
        })
        .collect();
    let part = partition(session, 2, &offsets, &neighbours, &across, &even).unwrap();
    assert!((0..nx * ny).all(|v| part[v] == part[v / nx * nx]), "rows stay whole: {part:?}");

    // The left quarter weighs nine times as much as the rest, three quarters of the whole: parts are equal by weight.
    let weights: Vec<i32> = (0..nx * ny).map(|v| if v % nx < nx / 4 { 9 } else { 1 }).collect();
    for parts in 2..4 {
        let part = partition(session, parts, &offsets, &neighbours, &light, &weights).unwrap();
        let weight = |p: i32| (0..nx * ny).filter(|&v| part[v] == p).map(|v| weights[v]).sum::<i32>();
        let share = weights.iter().sum::<i32>() / parts as i32;
        assert!((0..parts as i32).all(|p| (weight(p) - share).abs() <= share / 5), "{part:?}");
    }
}

fn stages_add_up(session: &Session) {
    let (outer, inner) = (Stage::new(session, "outer").unwrap(), Stage::new(session, "inner").unwrap());
    for _ in 0..2 {
        let _outer = outer.enter();
        let _inner = inner.enter();
        std::thread::sleep(Duration::from_millis(5));
    }
    assert!(inner.seconds() >= 0.01 && outer.seconds() >= inner.seconds());
    assert_eq!(Stage::new(session, "inner").unwrap().seconds(), 0.0);
}

fn a_panic_ends_all_ranks() {
    let start = Instant::now();
    let ended = mpirun(3, Some("panic_on_the_last_rank"), &[], "");
    assert!(ended.code.is_some_and(|code| code != 0), "{:?}", ended.code);
    assert!(start.elapsed() < Duration::from_secs(20), "{:?}", start.elapsed());
    assert_eq!(ended.errors.matches("a rank lost its way").count(), 1, "{}", ended.errors);
}

fn panic_on_the_last_rank() {
    let session = Session::start(&[], &[]).unwrap();
    assert!(session.rank() + 1 < session.size(), "a rank lost its way");
    session.any(true);
}

fn a_rank_alone_gives_up() {
    for ranks in 2..=3 {
        let ended = mpirun(ranks, Some("meet_nobody"), &[], "");
        assert_eq!(ended.code, Some(7), "{}", ended.errors);
    }
}

/// Rank 0 waits in another call.
fn meet_nobody() {
    let session = Session::start(&[], &[]).unwrap();
    if session.rank() > 0 {
        assert!(!session.meet(Duration::from_millis(200)));
        session.abort(7);
    }
    session.any(true);
}

/// Giving back a factor of MUMPS takes all ranks; rank 0 has an error, and the others wait in another call.
fn an_error_beside_a_factor_ends_all_ranks() {
    let ended = mpirun(2, Some("fail_beside_a_factor"), &[], "-ksp_type preonly -pc_type lu -pc_factor_mat_solver_type mumps");
    assert_eq!(ended.code, Some(7), "{}", ended.errors);
}

fn fail_beside_a_factor() {
    errors_are_final();
    let session = Session::start(&[], &[]).unwrap();
    if session.rank() == 0 {
        // Ends this process where nothing else does.
        std::thread::spawn(|| {
            std::thread::sleep(Duration::from_secs(20));
            std::process::exit(9);
        });
    }
    let matrix = laplacian(&session, 40, |_| 0.0);
    let krylov = Krylov::new(&session, "").unwrap();
    krylov.set_operators(&matrix, &matrix).unwrap();
    krylov.set_from_options().unwrap();
    krylov.set_up().unwrap();
    if session.rank() == 0 {
        krylov.set_tolerance(-7.0, 1).unwrap_err();
        drop((krylov, matrix));
        session.abort(7);
    }
    session.any(true);
}

fn a_leak_is_listed() {
    for ranks in 1..=2 {
        let ended = mpirun(ranks, Some("leak_a_solver"), &[], LIST_LEAKS);
        let text = ended.output + &ended.errors;
        assert!(text.contains("KSP"), "the leaked solver is listed: {text}");
    }
}

fn leak_a_solver() {
    let session = Session::start(&[], &[]).unwrap();
    std::mem::forget(Krylov::new(&session, "").unwrap());
    // The forgotten solver has a share in the session, which would never end: give that share back.
    drop(unsafe { std::ptr::read(&session) });
}

fn a_second_start_is_an_error() {
    let ended = mpirun(1, Some("start_twice"), &[], "");
    assert_eq!(ended.code, Some(0), "{}", ended.errors);
}

fn start_twice() {
    let session = Session::start(&[], &[]).unwrap();
    assert_eq!(Session::start(&[], &[]).err(), Some(Error::AlreadyStarted));
    drop(session);
    assert_eq!(Session::start(&[], &[]).err(), Some(Error::AlreadyStarted));
}

fn a_session_needs_no_mpirun() {
    let ended = alone("solve_alone");
    assert_eq!((ended.code, ended.output.as_str()), (Some(0), ""), "{}", ended.errors);
}

fn solve_alone() {
    let session = Session::start(&[], &[]).unwrap();
    assert_eq!((session.rank(), session.size()), (0, 1));
    krylov_converges(&session);
}
