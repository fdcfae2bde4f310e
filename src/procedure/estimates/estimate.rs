//! Discretisation errors, estimated from the solutions on successive refinements.
//!
//! Where the spaces are nested, Galerkin's orthogonality gives `e_(l-1)² = e_l² + D_l²` for the errors `e_l = |u - u_l|` and the
//! difference `D_l = |u_l - u_(l-1)|` in the energy norm. If errors fall by the factor `√q` with each refinement,
//! `q = (D_l/D_(l-1))²` and `e_l² = D_l² q/(1 - q)`: no order has to be known, so that corners are seen. Each macro triangle has
//! its own q: beside corners errors fall slowly, elsewhere quickly, and what is small of the difference may be most of what is
//! left. Where active sets or contact boundaries change from mesh to mesh the spaces are not nested, and this is heuristic.

use super::decay::{FORCE_SLOWEST, falls, left};
use super::difference::Difference;
use super::energy_norm::share;
use super::value_estimate::{Both, ValueEstimate};
use super::zone_estimate::{ZoneDifference, ZoneEstimate};
use crate::contact::Zone;
use crate::discretisation::ContactPressure;
use crate::element::Order;
use crate::mesh::Cells;
use crate::recovery::{TracePoint, ZoneErrors, zone_errors};

/// Share of the change of a largest λ by one mesh that the next one adds where it has no bound: about one; where it is bounded a half
/// or less.
const GOES_ON: f64 = 0.75;

/// Error in the energy norm by one difference alone, P1 and P2: halfway between a smooth solution and one with corners.
const ENERGY_BY_ONE: [f64; 2] = [0.7, 0.5];

/// Error in the energy norm by one difference alone on a mesh that is adapted, where what converges quickly is coarse. Between smooth sides .31 to .39 is left, with corners .80
/// to .90 (`chain_5`): the meshes after the first measure it on each macro triangle.
const ENERGY_BY_ONE_ADAPTED: f64 = 0.7;

/// Share of one difference that the energy of finer meshes is foreseen by, and the factor by which squares fall from there, where no mesh
/// before has shown them. What they foretell of the second mesh came true to 15 % on discs, rollers and a pyramid; with .5 and .2 errors
/// were two to three times smaller than foretold, for up to twice the unknowns. Values fall more slowly: `bending` would take 42 cycles
/// for its pressure, in the place of 34.
const FORESEEN_BY_ONE: f64 = 0.4;
const ENERGY_FALLS: f64 = 0.09;

/// λ at both ends of a zone, on the mesh before and on the one before that (stress).
pub(crate) type AtEnds = [Option<[f64; 2]>; 2];

/// Estimated relative errors; nothing where there is not enough to tell.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Estimate {
    /// In the energy norm.
    pub energy: Option<f64>,
    /// The last difference in that norm.
    pub difference: Option<f64>,
    /// Its square on each macro triangle of this rank, in the rank's order.
    pub of_triangles: Vec<f64>,
    /// Square of the share of it that is left there, where the adapted mesh before has shown it; empty if there is none.
    pub shares_left: Vec<Option<f64>>,
    /// Error in the energy norm that finer meshes are foreseen by.
    pub foreseen: Option<f64>,
    /// Square of the error in that norm in the macro triangles of this rank, in the rank's order, of the last difference where
    /// there is but one; only where an accuracy is asked for.
    pub local: Vec<Cells>,
    /// Factor by which the difference has fallen on each of them with the last refinement, in the same order.
    pub falls: Vec<f64>,
    /// The same for the energy, as long as nothing is known of how it falls.
    pub energy_falls: Vec<f64>,
    /// Of `∫λ ds`, for each contact.
    pub force: Vec<Option<f64>>,
    /// Of the largest λ, for each contact.
    pub peak: Vec<Option<f64>>,
    /// Of the ends of contact by the width of its zone, for each contact.
    pub ends: Vec<Option<f64>>,
    /// Of the displacement and of the stress at each probe that a goal is set for.
    pub probes: Vec<[Option<f64>; 2]>,
    /// For each zone of each contact, the last difference and, if the zone was there, the one before.
    pub zones: Vec<Vec<[Option<ZoneDifference>; 2]>>,
}

impl Estimate {
    /// From the differences between successive meshes, the coarsest first. `residual` is that of the solve (relative): no
    /// force is better than it. `sum` adds up what the ranks have. **Collective**
    ///
    /// `shares_left` are the squares of the share of one difference that is left on each macro triangle of this rank, where they are
    /// known; empty if none is.
    pub fn new(
        differences: &[Difference],
        shares_left: Vec<Option<f64>>,
        order: Order,
        residual: f64,
        sum: impl Fn(f64) -> f64,
    ) -> Self {
        let Some((last, earlier)) = differences.split_last() else { return Self::default() };
        let before = earlier.last();
        let contacts = last.contacts.iter().enumerate().map(|(k, now)| (now, before.map(|before| &before.contacts[k])));
        let zones = |(now, then): Both| -> Vec<[Option<ZoneDifference>; 2]> {
            let again = |zone: &ZoneDifference| zone.again(&then?.zones).cloned();
            now.zones.iter().map(|zone| [Some(zone.clone()), again(zone)]).collect()
        };
        let of_triangles: Vec<f64> = match before {
            Some(before) => {
                before.of_triangles.iter().zip(&last.of_triangles).map(|(before, last)| left(*before, *last)).collect()
            }
            None if shares_left.is_empty() => last.of_triangles.clone(),
            None => {
                let left = |(last, share): (&f64, &Option<f64>)| last * share.unwrap_or(ENERGY_BY_ONE_ADAPTED.powi(2));
                last.of_triangles.iter().zip(&shares_left).map(left).collect()
            }
        };
        let whole = sum(of_triangles.iter().sum());
        let falls = falls(last, before, &shares_left);
        let is_first_guess = before.is_none() && sum(shares_left.len() as f64) == 0.0;
        let local = last.cells.iter().zip(last.of_triangles.iter().zip(&of_triangles));
        let local = local.map(|(cells, (last, left))| cells.scaled(share(*left, *last))).collect();
        let energy = match before {
            Some(before) => Some(whole).filter(|_| last.energy <= before.energy),
            None => {
                // A rank may have no macro triangle: all of them must know whether the mesh is adapted.
                let is_adapted = sum(last.cells.len() as f64) > 0.0;
                let share = if is_adapted { ENERGY_BY_ONE_ADAPTED } else { ENERGY_BY_ONE[order.degree() - 1] };
                Some(if is_first_guess { last.energy * share.powi(2) } else { whole })
            }
        };
        let foreseen = if is_first_guess { Some(last.energy * FORESEEN_BY_ONE.powi(2)) } else { energy };
        // The error of a value is a product of two in the energy norm, and falls as the square of that does.
        let slow = before.map_or(0.0, |before| (last.energy / before.energy).min(FORCE_SLOWEST));
        let values = ValueEstimate { order, slow, residual };
        let probe = |k: usize| values.probe(&last.probes[k], before.map(|before| &before.probes[k]));
        Self {
            energy: energy.map(f64::sqrt).filter(|error| error.is_finite()),
            difference: Some(last.energy.sqrt()).filter(|difference| difference.is_finite()),
            of_triangles: last.of_triangles.clone(),
            foreseen: foreseen.map(f64::sqrt).filter(|error| error.is_finite()),
            local,
            energy_falls: if is_first_guess { vec![ENERGY_FALLS; last.of_triangles.len()] } else { falls.clone() },
            falls,
            shares_left,
            force: contacts.clone().map(|both| values.force(both)).collect(),
            peak: contacts.clone().map(|both| values.peak(both)).collect(),
            ends: contacts.clone().map(|both| values.ends(both)).collect(),
            probes: (0..last.probes.len()).map(probe).collect(),
            zones: contacts.map(zones).collect(),
        }
    }

    /// The estimate of each zone of contact `at`, with what λ was at its ends on the mesh before and the one before that;
    /// `points` are the traces of the contact.
    pub fn of_zones(
        &self,
        at: usize,
        pressure: &ContactPressure,
        zones: &[Zone],
        points: &[TracePoint],
    ) -> Vec<(ZoneEstimate, AtEnds)> {
        let errors = zone_errors(pressure.contact, pressure.values, zones, points);
        let one = |(k, errors): (usize, &ZoneErrors)| {
            let differences = self.zones.get(at).and_then(|of_contact| of_contact.get(k));
            let differences = differences.map_or([None, None], |pair| pair.each_ref().map(Option::as_ref));
            let estimate = ZoneEstimate::new(pressure.contact.pair.space, errors, differences);
            (estimate, differences.map(|difference| difference.map(|found| found.at_ends)))
        };
        errors.iter().enumerate().map(one).collect()
    }

    /// Whether the largest λ of each zone of contact `at` changed by about as much on this mesh as on the one before, as where it has
    /// no bound; that is so where there are no two changes to compare.
    pub fn peaks_go_on(&self, at: usize) -> Vec<bool> {
        let goes_on = |pair: &[Option<ZoneDifference>; 2]| match pair {
            [Some(now), Some(before)] => now.peak > GOES_ON * before.peak,
            _ => true,
        };
        self.zones.get(at).map_or(Vec::new(), |zones| zones.iter().map(goes_on).collect())
    }

    /// What λ was at the ends of each zone of contact `at`; nothing if there were no coarser meshes.
    pub(crate) fn at_ends(&self, at: usize) -> Vec<AtEnds> {
        let zones = self.zones.get(at).map_or(&[][..], Vec::as_slice);
        zones.iter().map(|pair| pair.each_ref().map(|difference| difference.as_ref().map(|found| found.at_ends))).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::super::difference::ContactDifference;
    use super::*;

    fn difference(square: f64) -> Difference {
        Difference {
            energy: square,
            of_triangles: vec![square],
            cells: Vec::new(),
            contacts: vec![ContactDifference {
                force: square,
                peak: square,
                above: square,
                ends: square,
                within_segments: (0.01, false),
                zones: Vec::new(),
            }],
            probes: Vec::new(),
        }
    }

    #[test]
    fn errors_that_fall_by_one_factor_are_found_whatever_it_is() {
        for factor in [0.04, 0.25, 0.6] {
            // Errors 1, q, q² in the square; differences of squares.
            let squares = [1.0, factor, factor * factor];
            let differences = [difference(squares[0] - squares[1]), difference(squares[1] - squares[2])];
            let found = Estimate::new(&differences, Vec::new(), Order::P1, 0.0, |own| own);
            assert!((found.energy.expect("two differences") / factor - 1.0).abs() < 1e-12);
        }
        assert!(Estimate::new(&[difference(1.0)], Vec::new(), Order::P1, 0.0, |own| own).energy.is_some_and(|error| error > 0.5));
        assert_eq!(Estimate::new(&[], Vec::new(), Order::P1, 0.0, |own| own), Estimate::default());
    }

    /// Two macro triangles: errors of one fall by 16, of the other, which has a corner, by 2. Of the last difference the latter
    /// is the smaller part.
    #[test]
    fn a_corner_is_seen_beside_what_falls_quickly() {
        let errors = [[1600.0, 100.0, 6.25], [40.0, 20.0, 10.0]];
        let difference = |k: usize| {
            let local = errors.map(|of| of[k] - of[k + 1]).to_vec();
            let cell = |sum: &f64| {
                let mut cells = Cells::default();
                cells.add([0.8, 0.1, 0.1], *sum);
                cells
            };
            Difference {
                energy: local.iter().sum(),
                cells: local.iter().map(cell).collect(),
                of_triangles: local,
                ..difference(1.0)
            }
        };
        let found = Estimate::new(&[difference(0), difference(1)], Vec::new(), Order::P2, 0.0, |own| own);
        assert!((found.energy.expect("two differences") - 16.25_f64.sqrt()).abs() < 1e-12, "{:?}", found.energy);
        assert!(found.local.iter().zip([6.25, 10.0]).all(|(found, wanted)| (found.sum() - wanted).abs() < 1e-12));
    }

    /// Each macro triangle has a share of its own; where none is known, that of a first mesh counts.
    #[test]
    fn shares_hold_where_they_were_measured() {
        let two = |first: f64, second: f64| Difference {
            energy: first + second,
            of_triangles: vec![first, second],
            cells: vec![Cells::default(); 2],
            ..difference(1.0)
        };
        let energy = |shares: Vec<Option<f64>>| {
            let found = Estimate::new(&[two(8.0, 2.0)], shares, Order::P2, 0.0, |own| own);
            (found.energy.expect("known").powi(2), found.foreseen.expect("known").powi(2), found.energy_falls)
        };
        let (left, foreseen, falls) = energy(vec![Some(0.125), Some(1.0)]);
        assert!((left - 3.0).abs() < 1e-12 && left == foreseen, "{left}, {foreseen}");
        assert!((falls[0] - 1.0 / 9.0).abs() < 1e-12 && falls[1] == 0.5, "{falls:?}");
        assert!((energy(vec![Some(0.125), None]).0 - 1.98).abs() < 1e-12);
        let (left, foreseen, falls) = energy(Vec::new());
        assert!((left - 4.9).abs() < 1e-12 && foreseen < left, "what is not known counts for more than what is hoped for");
        assert_eq!(falls, [ENERGY_FALLS; 2]);
    }

    /// Ranks round otherwise: where there is nothing to fall, all of them mark alike.
    #[test]
    fn rounding_falls_by_no_factor_of_its_own() {
        let two = |first: f64, second: f64| Difference { energy: first, of_triangles: vec![first, second], ..difference(1.0) };
        let falls = |rounding: [f64; 2]| {
            let differences = [two(8.0, rounding[0]), two(2.0, rounding[1])];
            Estimate::new(&differences, Vec::new(), Order::P2, 0.0, |own| own).falls
        };
        assert_eq!(falls([3e-28, 1e-29]), falls([1e-29, 3e-28]));
    }

    #[test]
    fn ends_that_stay_are_no_better_than_segments_are_short() {
        let ends =
            |before, last| Estimate::new(&[difference(before), difference(last)], Vec::new(), Order::P2, 0.0, |own| own).ends[0];
        assert_eq!(ends(0.0, 0.0), Some(0.01));
        assert!(ends(0.4, 0.2).is_some_and(|error| error > 0.1));
    }

    #[test]
    fn a_force_is_no_better_than_the_difference_before_allows() {
        let force = |before, last| {
            Estimate::new(&[difference(before), difference(last)], Vec::new(), Order::P1, 1e-8, |own| own).force[0]
        };
        // Errors 16, 4, 1.
        assert!((force(12.0, 3.0).expect("two differences") - 1.0).abs() < 1e-12);
        assert!(force(12.0, 1e-5).expect("two differences") > 1.0 - 1e-12, "a difference that is small by luck");
        assert_eq!(force(0.0, 0.0), Some(1e-8), "a force that supports and loads alone decide");
    }
}
