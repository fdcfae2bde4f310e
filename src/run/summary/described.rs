//! What is known of a solution without its fields.

use crate::case::Case;
use crate::element::Order;
use crate::output::summary::{CoarseSolveSummary, Mesh, SolverSummary, Summary, Unknowns};
use crate::petsc::versions;
use crate::procedure::Solved;
use crate::run::words::units;

/// A summary with all that is known without the fields; what `before` tells else stays.
pub fn described(before: Summary, case: &Case, solved: &Solved) -> Summary {
    let Solved { problem, solution, .. } = solved;
    let (scene, numbering) = (&problem.scene, &problem.finest().numbering);
    let count = numbering.level.triangles_per_edge();
    let [shortest, longest] = scene.mesh.shortest_and_longest_edge(numbering.level);
    let midsides = if scene.order == Order::P1 { 0 } else { edge_count(solved) };
    let coarse = solved.coarse.iter().map(|solve| CoarseSolveSummary {
        refine: solve.refine,
        unknowns: solve.unknowns,
        iterations: solve.iterations.clone(),
    });
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
        outer: solved.passes.iter().map(Into::into).collect(),
        boundaries: solved.boundaries.iter().map(Into::into).collect(),
        solver: SolverSummary {
            name: Some(case.solver.choice.name().into()),
            krylov: Some(solved.solver.clone()),
            iterations: solved.passes.iter().map(|step| step.krylov_iterations).collect(),
            coarse: coarse.collect(),
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
