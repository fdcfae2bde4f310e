//! What is left of the differences of single values: forces, largest pressures, ends of contact, displacements and stresses at points.

use super::decay::{SHARES, value_left};
use super::difference::{ContactDifference, ProbeDifference};
use crate::body::Unbounded;
use crate::element::Order;

/// Factors by which errors of a force fall on a smooth solution, P1 and P2.
const FORCE_FALLS: [f64; 2] = [0.25, 0.125];

/// Factor by which errors of the largest pressure fall on a smooth solution.
const PEAK_FALLS: f64 = 0.25;

/// Factor by which errors of the ends of contact fall: they lie at ends of segments.
const ENDS_FALL: f64 = 0.5;

/// Factors by which errors of displacement and of stress at a point fall on a smooth solution, P1 and P2; none for the stress of
/// P1, which is constant on each triangle.
const PROBES_FALL: [[Option<f64>; 2]; 2] = [[Some(0.25), Some(0.125)], [None, Some(0.25)]];

/// Factor by which the displacement at a corner falls where its edges are halved: with the root of the distance at a crack, hardly faster
/// at a re-entrant corner of 90 degrees. Taken as smooth, errors there were 2 to 7 times as large as estimated.
const AT_CORNER: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// Share of the last difference of a force that is left, where it says nothing of how it falls, and at least: its errors have either
/// sign, so that they may seem to fall more quickly than they do.
const FORCE_SHARES: [f64; 2] = [0.6, 0.3];

/// Shares of the last difference of a force that are left where the energy norm tells that it falls more slowly than on a smooth
/// solution.
const FORCE_SLOW_SHARES: [f64; 2] = [0.3, 0.3];

/// What a contact differs by now, and differed by on the mesh before, if that is known.
pub type Both<'d> = (&'d ContactDifference, Option<&'d ContactDifference>);

/// What errors of values are estimated by; each is no better than the residual of the solve.
pub struct ValueEstimate {
    /// The elements.
    pub order: Order,
    /// Factor by which values fall at least, as the energy norm tells; zero where it tells nothing.
    pub slow: f64,
    /// Relative residual of the solve.
    pub residual: f64,
}

impl ValueEstimate {
    /// Relative error of the force of a contact.
    pub fn force(&self, (now, then): Both) -> Option<f64> {
        let smooth = FORCE_FALLS[self.order.degree() - 1];
        let left = |fall: f64, shares| value_left(then.map(|then| then.force), now.force, fall, shares);
        let error = left(smooth, FORCE_SHARES)?.max(left(smooth.max(self.slow), FORCE_SLOW_SHARES)?);
        Some(error.max(self.residual))
    }

    /// Relative error of its largest pressure.
    pub fn peak(&self, (now, then): Both) -> Option<f64> {
        let left = value_left(then.map(|then| then.peak), now.peak, PEAK_FALLS, SHARES)?;
        Some((left + now.above).max(self.residual))
    }

    /// Error of its ends, by its width.
    pub fn ends(&self, (now, then): Both) -> Option<f64> {
        let (within, is_all) = now.within_segments;
        if is_all {
            return Some(within.max(self.residual));
        }
        // Ends that stay where they are from mesh to mesh are no better for it than the segments are short.
        let left = value_left(then.map(|then| then.ends), now.ends, ENDS_FALL, SHARES)?;
        Some(left.max(within).max(self.residual))
    }

    /// Relative errors of displacement and stress at a point; none of what has no value there.
    pub fn probe(&self, now: &ProbeDifference, then: Option<&ProbeDifference>) -> [Option<f64>; 2] {
        if let Some(why) = &now.unbounded {
            let left = now.displacement * AT_CORNER / (1.0 - AT_CORNER);
            return [Some(left.max(self.residual)).filter(|left| left.is_finite() && *why != Unbounded::Point), None];
        }
        let left = |what: usize, of: &dyn Fn(&ProbeDifference) -> f64| {
            let (now, then) = (of(now), then.map(of));
            let left = match PROBES_FALL[what][self.order.degree() - 1] {
                Some(fall) => value_left(then, now, fall.max(self.slow), SHARES),
                // Stresses of P1 jump from triangle to triangle: no difference is small but by luck.
                None => Some(now.max(then.unwrap_or(now))).filter(|left| left.is_finite()),
            };
            left.map(|error| error.max(self.residual))
        };
        let [at_point, around] = [0, 1].map(|of: usize| left(1, &|probe| probe.stress[of]));
        [left(0, &|probe| probe.displacement), at_point.zip(around).map(|(point, around)| point.max(around))]
    }
}
