//! How the solution on one mesh differs from that on the mesh before: in the energy norm and in each value that is estimated.

use crate::accuracy::{Accuracy, ProbePoint};
use crate::discretisation::{Discretisation, Field, Solution, SystemError, local_strain_energy};
use crate::mesh::Cells;
use crate::petsc::Session;
use crate::procedure::coarse_solution::CoarseSolution;
use crate::procedure::estimates::end_estimate::{ends_within_segments, way_of_ends};
use crate::procedure::estimates::energy_norm::{share, whole_energy, without_points};
use crate::procedure::estimates::zone_estimate::ZoneDifference;
use crate::recovery::{Probing, cell_energies, probe, stress_around};

/// How a solution differs from that on the mesh before.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// Square of the relative energy norm.
    pub energy: f64,
    /// Its part on each macro triangle of this rank, in the rank's order.
    pub of_triangles: Vec<f64>,
    /// Where in these triangles; only where an accuracy is asked for.
    pub cells: Vec<Cells>,
    /// Relative difference of `∫λ ds`, for each contact.
    pub force: Vec<f64>,
    /// Relative difference of the largest pressure, recovered from means of λ, for each contact.
    pub peak: Vec<f64>,
    /// How far the largest λ is from that, relative, for each contact.
    pub above: Vec<f64>,
    /// Largest way of an end of contact by the width of its zone, for each contact.
    pub ends: Vec<f64>,
    /// Error of these ends as they lie at ends of segments, by the same width; and whether that is all of it.
    pub within_segments: Vec<(f64, bool)>,
    /// Relative differences at each probe that a goal is set for.
    pub probes: Vec<ProbeDifference>,
    /// The zones of each contact.
    pub zones: Vec<Vec<ZoneDifference>>,
}

/// Relative differences at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProbeDifference {
    /// Of the displacement.
    pub displacement: f64,
    /// Of the stress there, and in the mean over the triangle, by the stress there: each is compared with its own kind on the mesh
    /// before, since at some places a stress is good by luck.
    pub stress: [f64; 2],
}

impl Difference {
    /// Compares a solution with the one before, as far as an accuracy that may be asked for wants it. **Collective**
    pub fn new(
        problem: &Discretisation,
        solution: &Solution,
        coarse: &CoarseSolution,
        accuracy: Option<&Accuracy>,
        session: &Session,
    ) -> Result<Self, SystemError> {
        let mut apart = coarse.displacement(&problem.scene, problem.finest(), session.rank());
        apart.iter_mut().zip(&solution.displacement).for_each(|(before, now)| *before = now - *before);
        let u = Field::displacement(problem, &solution.displacement, session)?;
        let whole = whole_energy(problem, &u, session)?;
        let apart = Field::displacement(problem, &apart, session)?;
        let probes = accuracy.map_or_else(Vec::new, Accuracy::probes);
        let probes = probes.iter().map(|point| at_probe(problem, point, &u, &apart, session)).collect::<Result<_, _>>()?;
        let cells = if accuracy.is_some() { cell_energies(problem, &apart, session)? } else { Vec::new() };
        let of_triangles = without_points(problem, local_strain_energy(problem, &apart, session)?, session);
        let left_out = problem.scene.has_point_load(session.rank());
        let cells = cells.into_iter().zip(&left_out).map(|(cells, &is_out)| if is_out { Cells::default() } else { cells });
        let mut apart = [of_triangles.iter().sum::<f64>()];
        session.sum(&mut apart);
        let (mut force, mut ends, mut within_segments, mut zones) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        let (mut peak, mut above) = (Vec::new(), Vec::new());
        for (at, (contact, before)) in problem.contacts.iter().zip(coarse.forces()).enumerate() {
            let pressure = solution.pressure(contact);
            let now = pressure.force();
            force.push(share((now - before).abs(), now.abs()));
            let [now, before] = [pressure.recovered_peak(), coarse.pressure(at).recovered_peak()];
            let is_open = pressure.zones().is_empty() && coarse.pressure(at).zones().is_empty();
            let unknown = if is_open { 0.0 } else { f64::NAN };
            peak.push(now.zip(before).map_or(unknown, |(now, before)| (before / now - 1.0).abs()));
            above.push(now.map_or(unknown, |now| (pressure.largest() / now - 1.0).abs()));
            ends.push(way_of_ends(&pressure, &coarse.pressure(at)));
            within_segments.push(ends_within_segments(&pressure, &coarse.pressure(at)));
            let before = |x| coarse.pressure(at).at_foot(x);
            zones.push(pressure.zones().iter().map(|zone| ZoneDifference::new(contact, pressure.values, zone, before)).collect());
        }
        let of_triangles = of_triangles.into_iter().map(|part| share(part, whole)).collect();
        let cells = cells.map(|part| part.scaled(if whole == 0.0 { 0.0 } else { 1.0 / whole })).collect();
        let energy = if whole.is_nan() { f64::NAN } else { share(apart[0], whole) };
        Ok(Self { energy, of_triangles, cells, force, peak, above, ends, within_segments, probes, zones })
    }
}

/// Relative differences at a point; not a number where no body holds it. **Collective**
fn at_probe(
    problem: &Discretisation,
    point: &ProbePoint,
    u: &Field<2>,
    apart: &Field<2>,
    session: &Session,
) -> Result<ProbeDifference, SystemError> {
    let unknown = ProbeDifference { displacement: f64::NAN, stress: [f64::NAN; 2] };
    let Some(region) = problem.scene.mesh.region(&point.body) else { return Ok(unknown) };
    let both = [(u, Probing::Displacement), (apart, Probing::Difference)];
    let [whole, part] = both.map(|field| probe(problem, field, region, point.point, session));
    let (Some(whole), Some(part)) = (whole?, part?) else { return Ok(unknown) };
    let around = stress_around(problem, apart, region, point.point, session)?;
    let plane = problem.scene.mesh.plane;
    let size = |stress: [f64; 4]| plane.stress_product(stress, stress).sqrt();
    let stress = [size(part.stress), around].map(|apart| apart / size(whole.stress));
    Ok(ProbeDifference { displacement: part.displacement.norm() / whole.displacement.norm(), stress })
}
