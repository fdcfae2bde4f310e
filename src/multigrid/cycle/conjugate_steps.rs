//! A stronger smoother than one sweep: a few steps of CG, preconditioned by symmetric sweeps.

use crate::multigrid::stiffness::LatticeOperator;
use crate::petsc::Session;

/// The steps on one level, with their vectors.
pub struct ConjugateSteps {
    session: Session,
    count: usize,
    /// The residual `b - K x` behind the last step.
    pub r: Vec<[f64; 2]>,
    z: Vec<[f64; 2]>,
    p: Vec<[f64; 2]>,
    q: Vec<[f64; 2]>,
}

impl ConjugateSteps {
    /// So many, on a level with so many nodes here.
    pub fn new(count: usize, nodes: usize, session: &Session) -> Self {
        let [r, z, p, q] = std::array::from_fn(|_| vec![[0.0; 2]; nodes]);
        Self { session: session.clone(), count, r, z, p, q }
    }

    /// Smooths `x`, which begins as zero, whatever it holds, if that is said; `sweep` makes a symmetric sweep from zero.
    /// **Collective**
    pub fn smooth(
        &mut self,
        lattice: &LatticeOperator,
        from_zero: bool,
        mut sweep: impl FnMut(&[[f64; 2]], &mut [[f64; 2]]),
        b: &[[f64; 2]],
        x: &mut [[f64; 2]],
    ) {
        let Self { session, count, r, z, p, q } = self;
        r.copy_from_slice(b);
        if from_zero {
            x.fill([0.0; 2]);
        } else {
            lattice.multiply(x, q);
            add(r, -1.0, q);
        }
        p.fill([0.0; 2]);
        let mut before = 1.0;
        for _ in 0..*count {
            sweep(r, z);
            let now = product(session, r, z);
            p.as_flattened_mut().iter_mut().for_each(|p| *p *= now / before);
            add(p, 1.0, z);
            lattice.multiply(p, q);
            let work = product(session, p, q);
            // Otherwise nothing is left, or rounding.
            let goes_on = now > 0.0 && work > 0.0;
            if !goes_on {
                return;
            }
            add(x, now / work, p);
            add(r, -now / work, q);
            before = now;
        }
    }
}

/// `y += factor x`.
fn add(y: &mut [[f64; 2]], factor: f64, x: &[[f64; 2]]) {
    y.as_flattened_mut().iter_mut().zip(x.as_flattened()).for_each(|(y, x)| *y += factor * x);
}

/// `x · y`. **Collective**
fn product(session: &Session, x: &[[f64; 2]], y: &[[f64; 2]]) -> f64 {
    session.sum([x.as_flattened().iter().zip(y.as_flattened()).map(|(x, y)| x * y).sum()])[0]
}
