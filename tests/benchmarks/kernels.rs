//! The kernels of the cycle at a million unknowns: sweep, residual, product and interpolation, against what the memory and
//! the core of the machine can do.
//!
//! `cargo bench --bench kernels --no-run` names the program; `mpirun -n 1 PROGRAM [P1] [P2]` runs it. Prints a line for each
//! kernel: nanoseconds for each node (a sweep has two directions), the least bytes that it must move and its operations, and
//! the shares of the STREAM triad and of the peak that these are. Medians of 25.

#[path = "../support/bars.rs"]
mod bars;

use mezha::discretisation::{Discretisation, Form};
use mezha::element::Order;
use mezha::multigrid::{Elastic, SweepHalves, interpolations};
use mezha::petsc::Session;
use std::hint::black_box;
use std::time::Instant;

fn main() {
    let session = Session::start(&[], &[]).expect("PETSc starts");
    let (bandwidth, peak) = (stream(), peak());
    println!("STREAM triad on one core: {bandwidth:.1} GB/s; peak of one core: {peak:.1} GFlop/s, by multiply-adds in registers");
    let wanted: Vec<String> = std::env::args().skip(1).filter(|word| word.starts_with('P')).collect();
    for (order, refine, couplings) in [(Order::P1, 7, 7.0), (Order::P2, 6, 8.5)] {
        if !wanted.is_empty() && !wanted.contains(&format!("{order:?}")) {
            continue;
        }
        let problem = Discretisation::new(bars::scene(&session, order, refine, false), &session).expect("a discretisation");
        let load = vec![0.0; problem.finest().local_unknowns()];
        let elastic = Elastic::alone(&problem, load, Form::Augmented).expect("a stiffness");
        let all = interpolations(&problem);
        let (step, mut room) = (&all[all.len() - 1].nodes, Default::default());
        let lattice = elastic.stiffness[elastic.stiffness.len() - 1].lattice();
        let mut coarse = values(problem.spaces[problem.spaces.len() - 2].own.len());
        let (mut x, b) = (values(lattice.node_count()), values(lattice.node_count()));
        let mut r = b.clone();
        let nodes = b.len() as f64;
        let show = |name: &str, seconds: f64, bytes: f64, flops: f64| {
            println!(
                "{order:?}, n = 128, {name}: {:.2} ns for each node, {bytes:.0} bytes and {flops:.0} operations: {:.0} % of STREAM, \
                 {:.0} % of the peak",
                1e9 * seconds / nodes,
                100.0 * bytes * nodes / seconds / (1e9 * bandwidth),
                100.0 * flops * nodes / seconds / (1e9 * peak)
            );
        };
        // Components are two numbers of eight bytes; what is written is not counted as read before.
        let sweep = median(|| lattice.relax(SweepHalves::Both, &b, &mut x));
        show("sweep, both directions", sweep, 48.0, 2.0 * 8.0 * couplings);
        show("residual", median(|| lattice.residual(&b, &x, &mut r)), 48.0, 8.0 * couplings);
        show("product", median(|| lattice.multiply(&x, &mut r)), 32.0, 8.0 * couplings);
        show("interpolation", median(|| step.prolong::<true>(&coarse, &mut x, &mut room)), 36.0, 6.0);
        show("restriction", median(|| step.restrict(&r, &mut coarse, &mut room)), 20.0, 6.0);
    }
}

fn values(count: usize) -> Vec<[f64; 2]> {
    let value = |at: usize| ((at * 7919) % 1013) as f64 / 1013.0;
    (0..count).map(|at| [value(2 * at), value(2 * at + 1)]).collect()
}

/// Median of 25 timings, seconds.
fn median(mut work: impl FnMut()) -> f64 {
    let mut times: Vec<f64> = (0..25)
        .map(|_| {
            let start = Instant::now();
            work();
            start.elapsed().as_secs_f64()
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times[12]
}

/// The triad `a = b + s c` on vectors of 128 MiB, GB/s.
fn stream() -> f64 {
    let n = 1 << 24;
    let (mut a, b, c) = (vec![0.0; n], vec![1.0; n], vec![2.0; n]);
    let seconds = median(|| {
        let scale = black_box(3.0);
        a.iter_mut().zip(b.iter().zip(&c)).for_each(|(a, (b, c))| *a = b + scale * c);
        black_box(&a);
    });
    24e-9 * n as f64 / seconds
}

/// Multiply-adds on sixteen vectors of eight numbers, none of which waits for another; GFlop/s.
fn peak() -> f64 {
    const ROUNDS: usize = 1_000_000;
    struct Rounds(f64);
    impl pulp::WithSimd for Rounds {
        type Output = (f64, usize);

        #[inline(always)]
        fn with_simd<S: pulp::Simd>(self, simd: S) -> Self::Output {
            let (a, b) = (simd.splat_f64s(self.0), simd.splat_f64s(1e-9));
            let mut sums = [simd.splat_f64s(0.0); 12];
            for _ in 0..ROUNDS {
                for sum in &mut sums {
                    *sum = simd.mul_add_e_f64s(*sum, a, b);
                }
            }
            (sums.into_iter().map(|sum| simd.reduce_sum_f64s(sum)).sum(), 2 * 12 * ROUNDS * S::F64_LANES)
        }
    }
    let arch = pulp::Arch::new();
    let mut operations = 0;
    let seconds = median(|| operations = black_box(arch.dispatch(Rounds(black_box(0.999)))).1);
    1e-9 * operations as f64 / seconds
}
