//! Rigid motions of a block that nothing but contact and held means resists.

use super::freedoms::Freedoms;
use crate::body::{UNIT_MOTIONS, rigid_displacement};
use crate::contact::Extent;
use crate::discretisation::Scene;
use crate::element::{Plane, times};
use crate::geometry::Point;
use crate::mesh::Numbering;
use nalgebra::{DMatrix, SymmetricEigen};
use std::collections::BTreeMap;

/// Share of the strongest hold below which a motion is free: rounding of coordinates leaves less, the weakest support of a curve
/// that bends by a thousandth more.
const FREE: f64 = 1e-9;

/// A motion that a block may have: of one of its pieces, or of a plate or a tool. Turns are scaled by a radius.
#[derive(Clone, Copy)]
enum Mode {
    Piece { piece: usize, k: usize },
    Set { set: usize, k: usize, radius: f64 },
}

/// The free rigid motions of a block.
pub struct Kernel {
    modes: Vec<Mode>,
    /// A column of shares of the modes for each free motion.
    shares: DMatrix<f64>,
    /// Displacements by each free motion: a column of the block's unknowns.
    pub motions: DMatrix<f64>,
}

/// Kernels of all blocks.
pub fn kernels(scene: &Scene, numbering: &Numbering, freedoms: &Freedoms) -> Vec<Kernel> {
    let extents = scene.extents();
    let modes = modes_of_blocks(scene, freedoms, &extents);
    let place = |block: usize, piece: usize, k: usize| {
        modes[block].iter().position(|mode| matches!(mode, Mode::Piece { piece: own, k: of } if (*own, *of) == (piece, k)))
    };
    let first_of_piece: Vec<Option<usize>> =
        freedoms.block_of_piece.iter().enumerate().map(|(piece, &block)| place(block, piece, 0)).collect();
    let mut grams: Vec<DMatrix<f64>> = modes.iter().map(|modes| DMatrix::zeros(modes.len(), modes.len())).collect();
    let mut motions: Vec<DMatrix<f64>> =
        modes.iter().zip(&freedoms.sizes).map(|(modes, &size)| DMatrix::zeros(size, modes.len())).collect();
    if scene.mesh.plane == Plane::Revolution {
        // Rings resist shifts across the axis, and turns.
        let firsts = first_of_piece.iter().zip(&freedoms.block_of_piece).filter_map(|(first, &block)| Some((block, (*first)?)));
        firsts.for_each(|(block, first)| [0, 2].iter().for_each(|k| add_square(&mut grams[block], &[(first + k, 1.0)])));
    }
    for (block, own) in freedoms.own_unknowns() {
        let Some(first) = first_of_piece[own.piece] else { continue };
        let seen = [0, 1, 2].map(|k| own.direction.dot(&unit_displacement(&extents[own.piece], k, own.place)));
        match own.unknown {
            Some(unknown) => (0..3).for_each(|k| motions[block][(unknown, first + k)] = seen[k]),
            None => add_square(&mut grams[block], &[0, 1, 2].map(|k| (first + k, seen[k]))),
        }
    }
    for (at, set) in freedoms.sets.iter().enumerate() {
        for (place, mode) in modes[set.block].iter().enumerate() {
            if let Mode::Set { set: own, k, radius } = *mode
                && own == at
                && let Some(unknown) = set.unknowns[k]
            {
                motions[set.block][(unknown, place)] = if k == 2 { 1.0 / radius } else { 1.0 };
            }
        }
        tie_to_pieces(scene, (at, &set.pieces), &modes[set.block], &first_of_piece, &extents, &mut grams[set.block]);
    }
    add_springs(scene, numbering, freedoms, &motions, &mut grams);
    modes.into_iter().zip(grams).zip(motions).map(|((modes, gram), motions)| Kernel::new(modes, gram, &motions)).collect()
}

impl Kernel {
    fn new(modes: Vec<Mode>, gram: DMatrix<f64>, motions: &DMatrix<f64>) -> Self {
        let count = modes.len();
        if count == 0 {
            return Self { modes, shares: DMatrix::zeros(0, 0), motions: DMatrix::zeros(motions.nrows(), 0) };
        }
        let eigen = SymmetricEigen::new(gram);
        let least = FREE * eigen.eigenvalues.iter().copied().fold(1.0, f64::max);
        let free: Vec<usize> = (0..count).filter(|&k| eigen.eigenvalues[k] <= least).collect();
        // Motions along the axes have the plainest words, and the fewest entries.
        let shares = if free.len() == count { DMatrix::identity(count, count) } else { eigen.eigenvectors.select_columns(&free) };
        let motions = motions * &shares;
        Self { modes, shares, motions }
    }

    /// Number of free motions.
    pub fn len(&self) -> usize {
        self.shares.ncols()
    }

    /// The piece that moves most by these free motions, if it is no plate, with its shift and its turn by its radius; and how far.
    pub fn moves_most(&self, scene: &Scene, motion: &[f64]) -> Option<(usize, [f64; 3])> {
        let amounts = &self.shares * nalgebra::DVector::from_row_slice(motion);
        let mut all: BTreeMap<usize, [f64; 3]> = BTreeMap::new();
        for (mode, amount) in self.modes.iter().zip(amounts.iter()) {
            let (piece, k) = match *mode {
                Mode::Piece { piece, k } => (piece, k),
                Mode::Set { set, k, .. } => match scene.rigid[set].edges(&scene.mesh).first() {
                    Some(&edge) => (scene.mesh.piece_beside(edge), k),
                    None => continue,
                },
            };
            all.entry(piece).or_insert([0.0; 3])[k] = *amount;
        }
        let size = |moves: &[f64; 3]| moves.iter().map(|v| v * v).sum::<f64>();
        all.into_iter().max_by(|(_, a), (_, b)| size(a).total_cmp(&size(b)))
    }

    /// Unknowns of the block, one for each free motion, that stop all of them when they are held: those that move most, one after
    /// the other.
    pub fn pins(&self) -> Vec<usize> {
        let mut left = self.motions.clone();
        let mut pins = Vec::new();
        for _ in 0..self.len() {
            let pin = (0..left.nrows()).max_by(|&a, &b| left.row(a).norm().total_cmp(&left.row(b).norm())).unwrap_or_default();
            let direction = left.row(pin).transpose() / left.row(pin).norm();
            let along = &left * &direction;
            left -= along * direction.transpose();
            pins.push(pin);
        }
        pins
    }
}

/// Displacement at a point by a motion of a piece: a shift by one, or a turn by its radius.
fn unit_displacement(Extent { middle, radius }: &Extent, k: usize, x: Point) -> Point {
    rigid_displacement(*middle, &UNIT_MOTIONS[k], x) / if k == 2 { *radius } else { 1.0 }
}

fn modes_of_blocks(scene: &Scene, freedoms: &Freedoms, extents: &[Extent]) -> Vec<Vec<Mode>> {
    let mut modes: Vec<Vec<Mode>> = vec![Vec::new(); freedoms.sizes.len()];
    for (piece, &block) in freedoms.block_of_piece.iter().enumerate() {
        if !scene.is_rigid(scene.mesh.pieces[piece].body) {
            modes[block].extend([0, 1, 2].map(|k| Mode::Piece { piece, k }));
        }
    }
    for (at, set) in freedoms.sets.iter().enumerate() {
        let radius = set.pieces.first().map_or_else(|| tool_radius(scene, at, extents), |&piece| extents[piece].radius);
        let free = (0..3).filter(|&k| set.unknowns[k].is_some());
        modes[set.block].extend(free.map(|k| Mode::Set { set: at, k, radius }));
    }
    modes
}

fn tool_radius(scene: &Scene, set: usize, extents: &[Extent]) -> f64 {
    let first = scene.rigid[set].edges(&scene.mesh).first().copied();
    first.map_or(1.0, |edge| extents[scene.mesh.piece_beside(edge)].radius)
}

/// A plate and the pieces that it lies on move as one.
fn tie_to_pieces(
    scene: &Scene,
    (at, pieces): (usize, &[usize]),
    modes: &[Mode],
    first_of_piece: &[Option<usize>],
    extents: &[Extent],
    gram: &mut DMatrix<f64>,
) {
    let about = scene.rigid[at].about;
    for &piece in pieces {
        let Some(first) = first_of_piece[piece] else { continue };
        for k in 0..3 {
            let mut row: Vec<(usize, f64)> = (0..3)
                .map(|own| {
                    let moved = unit_displacement(&extents[piece], own, about);
                    (first + own, if k < 2 { moved[k] } else { f64::from(u8::from(own == 2)) })
                })
                .collect();
            let own = modes.iter().position(|mode| matches!(mode, Mode::Set { set, k: of, .. } if (*set, *of) == (at, k)));
            if let Some(own) = own {
                let Mode::Set { radius: of_set, .. } = modes[own] else { continue };
                row.push((own, if k < 2 { -1.0 } else { -extents[piece].radius / of_set }));
            }
            add_square(gram, &row);
        }
    }
}

/// What springs resist, by the strongest of them: how stiff they are is no matter here.
fn add_springs(scene: &Scene, numbering: &Numbering, freedoms: &Freedoms, motions: &[DMatrix<f64>], grams: &mut [DMatrix<f64>]) {
    let mut resisted: Vec<DMatrix<f64>> = grams.iter().map(|gram| DMatrix::zeros(gram.nrows(), gram.nrows())).collect();
    for springs in &scene.springs {
        for edge in springs.edges(&scene.mesh) {
            springs.stiffness(&scene.mesh, edge, numbering, |a, b, stiffness| {
                let [of_a, of_b] = [a, b].map(|node| freedoms.of(scene, node));
                let block = of_a.block;
                for ((i, u), (j, v)) in of_a.terms().iter().flat_map(|left| of_b.terms().iter().map(move |right| (left, right))) {
                    let value = u.dot(&times(&stiffness, v));
                    resisted[block] += value * motions[block].row(*i).transpose() * motions[block].row(*j);
                }
            });
        }
    }
    for (gram, resisted) in grams.iter_mut().zip(resisted) {
        let largest = resisted.amax();
        if largest > 0.0 {
            *gram += resisted / largest;
        }
    }
}

fn add_square(gram: &mut DMatrix<f64>, row: &[(usize, f64)]) {
    for (&(i, left), &(j, right)) in row.iter().flat_map(|left| row.iter().map(move |right| (left, right))) {
        gram[(i, j)] += left * right;
    }
}
