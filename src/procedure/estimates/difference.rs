//! How the solution on one mesh differs from that on the mesh before: in the energy norm and in each value that is estimated.

use crate::accuracy::{Accuracy, ProbePoint};
use crate::body::Unbounded;
use crate::discretisation::{ContactPressure, Discretisation, Field, Solution, SystemError, local_strain_energy};
use crate::mesh::Cells;
use crate::procedure::coarse_solution::CoarseSolution;
use crate::procedure::estimates::end_estimate::{ends_within_segments, way_of_ends};
use crate::procedure::estimates::energy_norm::{share, whole_energy, without_points};
use crate::procedure::estimates::zone_estimate::ZoneDifference;
use crate::recovery::{Probing, cell_energies, probe, stress_around, unbounded_at};

/// How a solution differs from that on the mesh before.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// Square of the relative energy norm.
    pub energy: f64,
    /// Its part on each macro triangle of this rank, in the rank's order.
    pub of_triangles: Vec<f64>,
    /// Where in these triangles; only where an accuracy is asked for.
    pub cells: Vec<Cells>,
    /// On each contact.
    pub contacts: Vec<ContactDifference>,
    /// Relative differences at each probe that a goal is set for.
    pub probes: Vec<ProbeDifference>,
}

/// How λ of a contact differs from that on the mesh before.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactDifference {
    /// Relative difference of `∫λ ds`.
    pub force: f64,
    /// Relative difference of the largest pressure, recovered from means of λ.
    pub peak: f64,
    /// How far the largest λ is from that, relative.
    pub above: f64,
    /// Largest way of an end of contact by the width of its zone.
    pub ends: f64,
    /// Error of these ends as they lie at ends of segments, by the same width; and whether that is all of it.
    pub within_segments: (f64, bool),
    /// Its zones.
    pub zones: Vec<ZoneDifference>,
}

/// Relative differences at a point.
#[derive(Clone, Debug, PartialEq)]
pub struct ProbeDifference {
    /// Of the displacement.
    pub displacement: f64,
    /// Of the stress there, and in the mean over the triangle, by the stress there: each is compared with its own kind on the mesh
    /// before, since at some places a stress is good by luck.
    pub stress: [f64; 2],
    /// Why the stress has no bound there, if so.
    pub unbounded: Option<Unbounded>,
}

impl Difference {
    /// Compares a solution with the one before, as far as an accuracy that may be asked for wants it. **Collective**
    pub fn new(
        problem: &Discretisation,
        solution: &Solution,
        coarse: &CoarseSolution,
        accuracy: Option<&Accuracy>,
    ) -> Result<Self, SystemError> {
        let mut apart = coarse.displacement(&problem.scene, problem.finest(), problem.session.rank());
        apart.iter_mut().zip(&solution.displacement).for_each(|(before, now)| *before = now - *before);
        let u = Field::displacement(problem, &solution.displacement);
        let whole = whole_energy(problem, &u)?;
        let apart = Field::displacement(problem, &apart);
        let probes = accuracy.map_or_else(Vec::new, Accuracy::probes);
        let probes = probes.iter().map(|point| at_probe((problem, solution), point, [&u, &apart])).collect::<Result<_, _>>()?;
        let cells = if accuracy.is_some() { cell_energies(problem, &apart)? } else { Vec::new() };
        let of_triangles = without_points(problem, local_strain_energy(problem, &apart)?);
        let left_out = problem.scene.has_point_load(problem.session.rank());
        let cells = cells.into_iter().zip(&left_out).map(|(cells, &is_out)| if is_out { Cells::default() } else { cells });
        let [apart] = problem.session.sum([of_triangles.iter().sum()]);
        let contacts = problem.contacts.iter().enumerate();
        let contacts = contacts.map(|(at, contact)| ContactDifference::new(&solution.pressure(contact), &coarse.pressure(at)));
        let contacts = contacts.collect();
        let of_triangles = of_triangles.into_iter().map(|part| share(part, whole)).collect();
        let cells = cells.map(|part| part.scaled(if whole == 0.0 { 0.0 } else { 1.0 / whole })).collect();
        let energy = if whole.is_nan() { f64::NAN } else { share(apart, whole) };
        Ok(Self { energy, of_triangles, cells, contacts, probes })
    }
}

impl ContactDifference {
    fn new(now: &ContactPressure, before: &ContactPressure) -> Self {
        let (zones, zones_before) = (now.zones(), before.zones());
        let unknown = if zones.is_empty() && zones_before.is_empty() { 0.0 } else { f64::NAN };
        let [peak, peak_before] = [now, before].map(ContactPressure::recovered_peak);
        let largest = now.values.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
        let of_zone = |zone| ZoneDifference::new(now.contact, now.values, zone, |x| before.at_foot(x));
        Self {
            force: share((now.force() - before.force()).abs(), now.force().abs()),
            peak: peak.zip(peak_before).map_or(unknown, |(now, before)| (before / now - 1.0).abs()),
            above: peak.map_or(unknown, |peak| (largest / peak - 1.0).abs()),
            ends: way_of_ends(now, before),
            within_segments: ends_within_segments(now, before),
            zones: zones.iter().map(of_zone).collect(),
        }
    }
}

/// Relative differences at a point; not a number where no body holds it. **Collective**
fn at_probe(
    (problem, solution): (&Discretisation, &Solution),
    point: &ProbePoint,
    [u, apart]: [&Field<2>; 2],
) -> Result<ProbeDifference, SystemError> {
    let unknown = ProbeDifference { displacement: f64::NAN, stress: [f64::NAN; 2], unbounded: None };
    let Some(region) = problem.scene.mesh.region(&point.body) else { return Ok(unknown) };
    let both = [(u, Probing::Displacement), (apart, Probing::Difference)];
    let [whole, part] = both.map(|field| probe(problem, field, region, point.point));
    let (Some(whole), Some(part)) = (whole?, part?) else { return Ok(unknown) };
    let around = stress_around(problem, apart, region, point.point)?;
    let plane = problem.scene.mesh.plane;
    let size = |stress: [f64; 4]| plane.stress_product(stress, stress).sqrt();
    let stress = [size(part.stress), around].map(|apart| apart / size(whole.stress));
    let displacement = share(part.displacement.norm(), whole.displacement.norm());
    let unbounded = unbounded_at(problem, solution, (&point.body, point.point));
    Ok(ProbeDifference { displacement, stress, unbounded })
}
