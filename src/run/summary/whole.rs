//! What is known of a whole solution: of its mesh and its solver without the fields, and what these say of bodies, supports and what
//! is rigid.

use crate::accuracy::ProbePoint;
use crate::case::Case;
use crate::element::{Order, Plane};
use crate::geometry::Point;
use crate::output::RunError;
use crate::output::summary::{
    BalanceSummary, Energy, Mesh, ProbeSummary, RigidSummary, SolverSummary, Summary, SupportSummary, Unknowns,
};
use crate::petsc::versions;
use crate::procedure::Solved;
use crate::recovery::Evaluation;
use crate::run::outcome::outside;
use crate::run::words::units;
use std::collections::BTreeMap;

/// A summary with all that is known without the fields; what `before` tells else stays.
pub fn described(before: Summary, case: &Case, solved: &Solved) -> Summary {
    let Solved { problem, solution, .. } = solved;
    let (scene, numbering) = (&problem.scene, &problem.finest().numbering);
    let count = numbering.level.triangles_per_edge();
    let [shortest, longest] = scene.mesh.shortest_and_longest_edge(numbering.level);
    let midsides = if scene.order == Order::P1 { 0 } else { edge_count(solved) };
    Summary {
        mesh: Mesh {
            triangles: Some((scene.mesh.triangles.len() * count * count) as u64),
            vertices: Some((numbering.node_count() - midsides) as u64),
            order: Some(scene.order.degree() as u8),
            h_min: Some(shortest),
            h_max: Some(longest),
        },
        unknowns: Unknowns {
            displacement: Some(2 * numbering.node_count() as u64),
            multiplier: Some(problem.multiplier_count() as u64),
        },
        units: units(case),
        outer: solved.passes.clone(),
        boundaries: solved.boundaries.clone(),
        solver: SolverSummary {
            name: Some(case.solver.choice.name().into()),
            krylov: Some(solved.solver.clone()),
            iterations: solved.passes.iter().map(|step| step.krylov_iterations).collect(),
            coarse: solved.coarse.clone(),
            cycles: Some(solved.work()),
            residual: Some(solution.residual),
            plain_residual: Some(solution.plain_residual),
            blas: Some(versions::blas()),
        },
        ..before
    }
}

/// Triangle edges of the finest level: the midside nodes of P2.
fn edge_count(Solved { problem, .. }: &Solved) -> usize {
    let count = problem.finest().numbering.level.triangles_per_edge();
    let mesh = &problem.scene.mesh;
    mesh.edges.len() * count + mesh.triangles.len() * (3 * count * (count - 1) / 2)
}

/// A summary with energies and balances, supports, rigid bodies, deformations and probes; what `before` tells else stays.
/// **Collective**
///
/// # Errors
/// A probe lies outside of its body, or PETSc fails.
pub fn with_fields(before: Summary, case: &Case, found: &Evaluation) -> Result<Summary, RunError> {
    let bodies = || found.problem.scene.bodies.iter().map(|body| body.name.clone());
    Ok(Summary {
        support: supports(found),
        rigid: rigid(found),
        energy: energy(found),
        balance: balance(found),
        strain_max: bodies().zip(found.deformations.iter().map(|body| Some(body.strain))).collect(),
        rotation: bodies().zip(found.deformations.iter().map(|body| Some(body.rotation))).collect(),
        rotation_max: bodies().zip(found.deformations.iter().map(|body| Some(body.turned))).collect(),
        displacement_max: Some(found.moved),
        growth: found.problem.scene.growth()[0],
        probe: probes(case, found)?,
        plane: (case.plane == Plane::Revolution).then(|| "axisymmetric".into()),
        ..before
    })
}

/// Reactions of supports and springs, and what drives held mean motions.
fn supports(Evaluation { problem, balance, .. }: &Evaluation) -> BTreeMap<String, SupportSummary> {
    let scene = &problem.scene;
    let names = scene.supports.iter().map(|support| &support.name).chain(scene.springs.iter().map(|springs| &springs.name));
    let moments = names.clone().map(|_| None).chain(balance.mean_moments.iter().map(|moment| Some(*moment)));
    let names = names.chain(scene.means.iter().map(|hold| &hold.name));
    let told = |(reaction, moment): (&Point, _)| SupportSummary { reaction: Some((*reaction).into()), moment };
    names.zip(balance.reactions.iter().zip(moments)).map(|(name, found)| (name.clone(), told(found))).collect()
}

/// Tools, and boundaries that stay rigid.
fn rigid(Evaluation { problem, balance, .. }: &Evaluation) -> BTreeMap<String, RigidSummary> {
    let rigid = problem.scene.rigid.iter().zip(&balance.rigid).zip(&balance.motions);
    let told = rigid.map(|((set, &[x, y, moment]), motion)| {
        let about = Some(set.about.into());
        let told = RigidSummary { motion: Some(*motion), about, force: Some([x, y]), moment: Some(moment) };
        (set.key.split_once('.').map_or(set.key.as_str(), |(_, name)| name).to_string(), told)
    });
    told.collect()
}

fn energy(Evaluation { problem, balance, .. }: &Evaluation) -> Energy {
    let bodies = &problem.scene.bodies;
    let parts = problem.scene.mesh.parts.iter().zip(&balance.strain_of_parts);
    let parts = parts.filter(|(part, _)| bodies[part.body as usize].has_parts());
    Energy {
        strain: bodies.iter().map(|body| body.name.clone()).zip(balance.strain.iter().map(|&u| Some(u))).collect(),
        parts: parts.map(|(part, &u)| (part.name.clone(), Some(u))).collect(),
        total: Some(balance.strain.iter().sum()),
        stationary: balance.stationary,
        springs: balance.springs,
        external_work: Some(balance.external_work),
    }
}

fn balance(Evaluation { balance, .. }: &Evaluation) -> BalanceSummary {
    BalanceSummary { force: balance.force, moment: balance.moment, energy: balance.energy, bodies: balance.bodies }
}

/// **Collective**
fn probes(case: &Case, found: &Evaluation) -> Result<BTreeMap<String, ProbeSummary>, RunError> {
    let probe = |asked: &ProbePoint| -> Result<(String, ProbeSummary), RunError> {
        let region = found.problem.scene.mesh.region(&asked.body).expect("checked names");
        let probed = found.probe(region, asked.point)?.ok_or_else(|| outside(asked.point.into()))?;
        let [xx, yy, xy, zz] = probed.stress;
        let (x, u) = (Some(asked.point.into()), Some(probed.displacement.into()));
        let hoop = (case.plane == Plane::Revolution).then_some(zz);
        let told = ProbeSummary { x, u, stress: Some([xx, yy, xy]), hoop };
        Ok((asked.name.clone(), told))
    };
    case.probes.iter().map(probe).collect()
}
