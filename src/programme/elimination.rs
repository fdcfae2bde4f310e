//! Displacements eliminated block by block: a Cholesky factor of each, its rigid motions apart.

use super::freedoms::Freedoms;
use super::kernel::{Kernel, kernels};
use crate::body::{Applied, MacroStiffness, applied_forces};
use crate::discretisation::{Scene, SystemError};
use crate::element::{Block, times};
use crate::geometry::Point;
use crate::mesh::{Numbering, lattice};
use faer::linalg::solvers::Solve;
use faer::sparse::linalg::solvers::Llt;
use faer::sparse::{SparseColMat, Triplet};
use faer::{Mat, Side};
use nalgebra::DVector;

/// The stiffness of one block, factorised.
pub struct EliminatedBlock {
    /// The factor without the pins of its rigid motions; nothing of a block that does not strain.
    factor: Option<Llt<usize, f64>>,
    /// Place of each unknown in the factor; nothing for a pin, and where nothing strains.
    places: Vec<Option<usize>>,
    count: usize,
    /// Forces of the loads on the unknowns.
    pub load: Vec<f64>,
    /// Its free rigid motions.
    pub kernel: Kernel,
    /// Number of the first of them among those of all blocks.
    pub first: usize,
}

impl EliminatedBlock {
    /// `K⁺` of some columns of forces on the unknowns, by their entries: displacements with the pins at rest.
    pub fn solve(&self, columns: &[Vec<(usize, f64)>]) -> Vec<Vec<f64>> {
        let Some(factor) = &self.factor else { return vec![vec![0.0; self.places.len()]; columns.len()] };
        let mut values = Mat::<f64>::zeros(self.count, columns.len());
        for (column, entries) in columns.iter().enumerate() {
            for &(unknown, value) in entries {
                if let Some(place) = self.places[unknown] {
                    values[(place, column)] += value;
                }
            }
        }
        factor.solve_in_place(values.as_mut());
        let of = |column: usize| self.places.iter().map(|place| place.map_or(0.0, |place| values[(place, column)])).collect();
        (0..columns.len()).map(of).collect()
    }

    /// `Rᵀ` of forces on the unknowns.
    pub fn work(&self, forces: &[(usize, f64)]) -> DVector<f64> {
        let mut work = DVector::zeros(self.kernel.len());
        for &(unknown, value) in forces {
            (0..self.kernel.len()).for_each(|k| work[k] += value * self.kernel.motions[(unknown, k)]);
        }
        work
    }
}

/// All blocks of a scene on one level, on this rank alone.
pub struct Elimination {
    /// How the nodes move.
    pub freedoms: Freedoms,
    /// The blocks.
    pub blocks: Vec<EliminatedBlock>,
}

impl Elimination {
    /// Assembles and factorises.
    ///
    /// # Errors
    /// [`SystemError::Case`] if supports contradict each other, a triangle is turned inside out, or a block has no factor.
    pub fn new(scene: &Scene, numbering: &Numbering) -> Result<Self, SystemError> {
        let freedoms = Freedoms::new(scene, numbering)?;
        let (entries, loads) = assembled(scene, numbering, &freedoms)?;
        let kernels = kernels(scene, numbering, &freedoms);
        let (mut blocks, mut first) = (Vec::new(), 0);
        for ((entries, load), kernel) in entries.into_iter().zip(loads).zip(kernels) {
            let free = kernel.len();
            blocks.push(factorised(entries, load, kernel, first)?);
            first += free;
        }
        Ok(Self { freedoms, blocks })
    }

    /// Number of free rigid motions of all blocks.
    pub fn motions(&self) -> usize {
        self.blocks.last().map_or(0, |block| block.first + block.kernel.len())
    }
}

/// StiffnessEntries of a block on and below the diagonal.
type StiffnessEntries = Vec<Triplet<usize, usize, f64>>;

/// Stiffness and loads of each block.
fn assembled(
    scene: &Scene,
    numbering: &Numbering,
    freedoms: &Freedoms,
) -> Result<(Vec<StiffnessEntries>, Vec<Vec<f64>>), SystemError> {
    let (mesh, laws) = (&scene.mesh, scene.laws());
    let mut loads: Vec<Vec<f64>> = freedoms.sizes.iter().map(|&size| vec![0.0; size]).collect();
    let mut entries: Vec<StiffnessEntries> = freedoms.sizes.iter().map(|_| Vec::new()).collect();
    let mut add = |a: usize, b: usize, stiffness: &Block| {
        let [of_a, of_b] = [a, b].map(|node| freedoms.of(scene, node));
        let held = times(stiffness, &of_b.at_rest);
        for &(i, u) in of_a.terms() {
            loads[of_a.block][i] -= u.dot(&held);
            for &(j, v) in of_b.terms().iter().filter(|(j, _)| *j <= i) {
                entries[of_a.block].push(Triplet::new(i, j, u.dot(&times(stiffness, &v))));
            }
        }
    };
    for (at, triangle) in mesh.triangles.iter().enumerate().filter(|(_, triangle)| !scene.is_rigid(triangle.body as usize)) {
        let stiffness = MacroStiffness::new(mesh, at, numbering.level, &laws[triangle.part as usize])?;
        let numbers = numbering.triangle(mesh, at);
        for (i, j) in lattice::nodes(numbering.level.intervals) {
            for ((k, l), block) in stiffness.row(i, j) {
                add(numbers.node(i, j), numbers.node(k, l), block);
            }
        }
    }
    for springs in &scene.springs {
        for edge in springs.edges(mesh) {
            springs.stiffness(mesh, edge, numbering, |a, b, block| add(a, b, &block));
        }
    }
    let push = |node: usize, force: Point| {
        let motion = freedoms.of(scene, node);
        motion.terms().iter().for_each(|(unknown, u)| loads[motion.block][*unknown] += u.dot(&force));
    };
    let applied = Applied { parts: &scene.parts(), loads: &scene.loads, point_loads: &scene.point_loads };
    applied_forces(mesh, &scene.partition, 0, numbering, &applied, push)?;
    for (set, freedom) in scene.rigid.iter().zip(&freedoms.sets) {
        let free = freedom.unknowns.iter().zip(set.applied).filter_map(|(unknown, force)| Some(((*unknown)?, force)));
        free.for_each(|(unknown, force)| loads[freedom.block][unknown] += force);
    }
    Ok((entries, loads))
}

fn factorised(entries: StiffnessEntries, load: Vec<f64>, kernel: Kernel, first: usize) -> Result<EliminatedBlock, SystemError> {
    let mut places: Vec<Option<usize>> = vec![None; load.len()];
    if entries.is_empty() {
        return Ok(EliminatedBlock { factor: None, places, count: 0, load, kernel, first });
    }
    let pins = kernel.pins();
    let mut count = 0;
    for (_, place) in places.iter_mut().enumerate().filter(|(unknown, _)| !pins.contains(unknown)) {
        *place = Some(count);
        count += 1;
    }
    let kept = |entry: &Triplet<usize, usize, f64>| Some(Triplet::new(places[entry.row]?, places[entry.col]?, entry.val));
    let kept: StiffnessEntries = entries.iter().filter_map(kept).collect();
    let words = "the stiffness on the coarsest mesh is singular but for rounding: a spring, or a part, is so soft beside the others that it does not count; make it stiffer, or leave it out";
    let matrix = SparseColMat::try_new_from_triplets(count, count, &kept);
    let factor = matrix.ok().and_then(|matrix| matrix.sp_cholesky(Side::Lower).ok());
    let factor = factor.ok_or_else(|| SystemError::Case(words.into()))?;
    Ok(EliminatedBlock { factor: Some(factor), places, count, load, kernel, first })
}
