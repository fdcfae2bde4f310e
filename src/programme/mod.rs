//! The contact problem of a coarse mesh as a quadratic programme, body by body eliminated: which contacts carry, every force and
//! every rigid motion, before any active set is known.
//!
//! In come a scene, its contacts, and the level that is solved on; out comes a [`Prediction`]. One rank does the work for all:
//! the level is the coarsest that is solved. Read `freedoms.rs` (how nodes move), `kernel.rs` (which rigid motions are free),
//! `elimination.rs` (the factors), and then this file.

mod elimination;
mod freedoms;
mod kernel;

use self::elimination::Elimination;
use crate::body::{Applied, BodyPart, Load, MeanHold, PointLoad, applied_forces, body_forces, rigid_displacement};
use crate::contact::{Law, Programme, ProgrammeOutcome, Side, added_up, describe_motion};
use crate::discretisation::{BY_ROUNDING, Contact, Coupled, Scene, SystemError, bilateral, coupled_here};
use crate::geometry::{Formula, Point};
use crate::mesh::Numbering;
use std::slice::from_ref;

/// Columns that a factor solves for together.
const TOGETHER: usize = 64;

/// What a programme says of a scene.
#[derive(Clone, Debug, PartialEq)]
pub enum Prediction {
    /// The contacts hold the bodies.
    Held(FoundByProgramme),
    /// The loads drive a body along a motion that no contact resists.
    Driven {
        /// The body, its motion, what drives it, what helps.
        words: String,
        /// Whether it turns more than it moves.
        turns: bool,
    },
    /// No answer, and why.
    Unknown(String),
}

/// Displacements and pressures that a programme has found.
#[derive(Clone, Debug, PartialEq)]
pub struct FoundByProgramme {
    /// Displacement of each node (length), in global axes.
    pub displacement: Vec<Point>,
    /// Pressures of all multipliers (stress).
    pub pressures: Vec<f64>,
    /// Mean gap over each multiplier (length).
    pub gaps: Vec<f64>,
}

/// Strain by that which pressing an overlap flat would take, below which nothing presses: the programme is solved to 1e-9.
const NO_STRAIN: f64 = 1e-6;

/// Entries of a row on the unknowns of one block.
type UnknownForces = Vec<(usize, f64)>;

/// A row of the programme by blocks: a multiplier, or a mean that is held.
#[derive(Clone, Default)]
struct ProgrammeRow {
    /// Block, unknown, entry.
    entries: Vec<(usize, usize, f64)>,
    /// The row's product with what is at rest.
    at_rest: f64,
}

/// A scene with its displacements eliminated, for the contacts that may be placed on it.
pub struct Predictor<'s> {
    scene: &'s Scene,
    numbering: &'s Numbering,
    elimination: Elimination,
    /// Rows of the means that are held, and their values.
    means: Vec<(ProgrammeRow, f64)>,
}

impl<'s> Predictor<'s> {
    /// Eliminates the displacements. All nodes are on this rank.
    ///
    /// # Errors
    /// [`SystemError::Case`] if supports contradict each other or a triangle is turned inside out.
    pub fn new(scene: &'s Scene, numbering: &'s Numbering) -> Result<Self, SystemError> {
        let elimination = Elimination::new(scene, numbering)?;
        let mut predictor = Self { scene, numbering, elimination, means: Vec::new() };
        predictor.means = predictor.held_means()?;
        Ok(predictor)
    }

    /// Solves for these contacts, whose edges are all on this rank.
    ///
    /// # Errors
    /// [`SystemError::Case`] if a contact cannot be integrated.
    pub fn predict(&self, contacts: &[Contact]) -> Result<Prediction, SystemError> {
        let (coupled, mut gap) = coupled_here(contacts)?;
        let both = bilateral(contacts);
        for contact in contacts {
            for i in contact.range().filter(|&i| !both[i] && !meets_both_sides(&coupled[i])) {
                gap[i] = contact.boundary.length() * contact.multipliers.integral(i - contact.first);
            }
        }
        let mut rows: Vec<ProgrammeRow> = coupled.iter().map(|coupled| self.row_of(coupled)).collect();
        let pushes: Vec<bool> = both.iter().map(|both| !both).collect();
        let right = gap.iter().copied().chain(self.means.iter().map(|(_, value)| *value));
        let right: Vec<f64> = right.collect();
        rows.extend(self.means.iter().map(|(row, _)| row.clone()));
        let programme = self.programme(contacts, &rows, &right, pushes);
        Ok(match programme.solve() {
            ProgrammeOutcome::Found { multipliers, gaps, motions } => {
                if self.scene.is_left_to_interference() && Self::pushes_off(contacts, &gap, &multipliers) {
                    return self.driven(&motions, true);
                }
                let displacement = self.displacement(&rows, &multipliers, &motions);
                let mut gaps = gaps[..gap.len()].to_vec();
                for contact in contacts {
                    contact.range().for_each(|i| gaps[i] /= contact.multipliers.integral(i - contact.first));
                }
                Prediction::Held(FoundByProgramme { displacement, pressures: multipliers[..gap.len()].to_vec(), gaps })
            }
            ProgrammeOutcome::Driven(motion) => self.driven(&motion, false)?,
            ProgrammeOutcome::Unsolved(words) => Prediction::Unknown(words),
        })
    }

    /// Whether contacts that overlap as they are drawn press nowhere: bodies have moved out of them.
    fn pushes_off(contacts: &[Contact], gap: &[f64], multipliers: &[f64]) -> bool {
        // The strain that presses by that which pressing the overlap flat would take.
        let strain = |contact: &Contact| {
            let mean = |i: usize| gap[i] / contact.multipliers.integral(i - contact.first);
            let deepest = contact.range().map(mean).fold(0.0, f64::min);
            let most = contact.range().map(|i| multipliers[i].abs()).fold(0.0, f64::max);
            (-deepest > BY_ROUNDING * contact.boundary.length())
                .then(|| most * contact.compliance * contact.boundary.length() / -deepest)
        };
        let mut overlapping = contacts.iter().filter_map(strain).peekable();
        overlapping.peek().is_some() && overlapping.all(|strain| strain < NO_STRAIN)
    }

    /// The programme of some rows with their right-hand sides; those of contacts come first.
    fn programme(&self, contacts: &[Contact], rows: &[ProgrammeRow], right: &[f64], mut pushes: Vec<bool>) -> Programme {
        pushes.resize(rows.len(), false);
        let mut penetration: Vec<f64> = rows.iter().zip(right).map(|(row, right)| row.at_rest - right).collect();
        let (mut compliance, mut resistance) = (Vec::new(), Vec::new());
        let mut driven = vec![0.0; self.elimination.motions()];
        let mut by_block: Vec<Vec<(usize, UnknownForces)>> = vec![Vec::new(); self.elimination.blocks.len()];
        for (at, row) in rows.iter().enumerate() {
            for &(block, unknown, value) in &row.entries {
                let own = &mut by_block[block];
                match own.last_mut().filter(|(of, _)| *of == at) {
                    Some((_, entries)) => entries.push((unknown, value)),
                    None => own.push((at, vec![(unknown, value)])),
                }
            }
        }
        for (block, own) in self.elimination.blocks.iter().zip(&by_block) {
            let load: Vec<(usize, f64)> = block.load.iter().copied().enumerate().collect();
            let moved = block.solve(from_ref(&load)).remove(0);
            block.work(&load).iter().enumerate().for_each(|(k, work)| driven[block.first + k] = *work);
            for (at, entries) in own {
                penetration[*at] += product(entries, &moved);
                block.work(entries).iter().enumerate().for_each(|(k, value)| resistance.push((block.first + k, *at, *value)));
            }
            for (start, columns) in own.chunks(TOGETHER).enumerate() {
                let forces: Vec<Vec<(usize, f64)>> = columns.iter().map(|(_, entries)| entries.clone()).collect();
                for ((column, (j, _)), answer) in columns.iter().enumerate().zip(block.solve(&forces)) {
                    let upper = &own[..=start * TOGETHER + column];
                    compliance.extend(upper.iter().map(|(i, entries)| (*i, *j, product(entries, &answer))));
                }
            }
        }
        for jump in contacts.iter().flat_map(|contact| &contact.jumps) {
            let [i, j] = jump.rows;
            compliance.extend([(i, i, jump.weight), (j, j, jump.weight), (i.min(j), i.max(j), -jump.weight)]);
        }
        Programme { compliance: added_up(compliance, |i, j| (j, i)), penetration, pushes, resistance, driven }
    }

    /// Displacements of all nodes under multipliers and rigid motions.
    fn displacement(&self, rows: &[ProgrammeRow], multipliers: &[f64], motions: &[f64]) -> Vec<Point> {
        let blocks = &self.elimination.blocks;
        let mut forces: Vec<Vec<(usize, f64)>> =
            blocks.iter().map(|block| block.load.iter().copied().enumerate().collect()).collect();
        for (row, multiplier) in rows.iter().zip(multipliers) {
            row.entries.iter().for_each(|&(block, unknown, value)| forces[block].push((unknown, -multiplier * value)));
        }
        let of_block = |(block, forces): (&elimination::EliminatedBlock, Vec<(usize, f64)>)| {
            let mut moved = block.solve(from_ref(&forces)).remove(0);
            for k in 0..block.kernel.len() {
                let amount = motions[block.first + k];
                moved.iter_mut().enumerate().for_each(|(unknown, u)| *u += amount * block.kernel.motions[(unknown, k)]);
            }
            moved
        };
        let moved: Vec<Vec<f64>> = blocks.iter().zip(forces).map(of_block).collect();
        let freedoms = &self.elimination.freedoms;
        let of_node = |node: usize| {
            let motion = freedoms.of(self.scene, node);
            motion.terms().iter().fold(motion.at_rest, |sum, (unknown, u)| sum + moved[motion.block][*unknown] * u)
        };
        (0..freedoms.count()).map(of_node).collect()
    }

    /// The body that a motion moves most, and what drives it, in words: loads, or an interference that pushes it off.
    fn driven(&self, motion: &[f64], is_pushed_off: bool) -> Result<Prediction, SystemError> {
        let of_block = |block: &elimination::EliminatedBlock| {
            block.kernel.moves_most(self.scene, &motion[block.first..block.first + block.kernel.len()])
        };
        let size = |moves: &[f64; 3]| moves.iter().map(|v| v * v).sum::<f64>();
        let most = self.elimination.blocks.iter().filter_map(of_block).max_by(|(_, a), (_, b)| size(a).total_cmp(&size(b)));
        let Some((piece, mut moves)) = most else { return Ok(Prediction::Unknown("the loads do not come to balance".into())) };
        let turns = moves[2].abs() > moves[0].hypot(moves[1]);
        if is_pushed_off && !turns {
            // What is pushed off turns on its way as it may.
            moves[2] = 0.0;
        }
        let mechanism = describe_motion(piece, &self.scene.extents(), moves);
        let of_piece = &self.elimination.blocks[self.elimination.freedoms.block_of_piece[piece]];
        let own = &motion[of_piece.first..of_piece.first + of_piece.kernel.len()];
        let loads = self.loads_that_drive(self.elimination.freedoms.block_of_piece[piece], own)?;
        let by = match &loads[..] {
            [] if is_pushed_off => "interference".into(),
            [] => "what acts on it".into(),
            loads => loads.join(", "),
        };
        let drive = if loads.len() > 1 { "drive" } else { "drives" };
        let (name, body) = (self.scene.mesh.name_of_piece(piece), &self.scene.bodies[self.scene.mesh.pieces[piece].body].name);
        let motion = &mechanism.motion;
        let is_rigid = self.scene.is_rigid(self.scene.mesh.pieces[piece].body);
        let hold = match turns {
            true if is_rigid => {
                format!("hold its turn: give [{body}] angle = 0.0 in the place of its moment")
            }
            true => {
                format!("hold its turn, in its mean say: [support.{body}] with mean = true, body = \"{body}\" and angle = 0.0")
            }
            false if is_rigid => {
                format!("prescribe ux and uy of [{body}] in the place of its force")
            }
            false => "let a support on one of its boundaries, or at a point of it, carry what acts on it".into(),
        };
        let turned = if is_pushed_off { "" } else { "turn the load round if it is meant to press the bodies together, or " };
        let pulls = self.scene.pairs.iter().any(|pair| pair.law == Law::Bilateral);
        let contact = if pulls { "contact" } else { "contact, which only pushes," };
        let words =
            format!("{name} can {motion}: {by} {drive} it there, and neither {contact} nor a support holds it; {turned}{hold}");
        Ok(Prediction::Driven { words, turns })
    }

    /// Loads, body forces and forces on tools that do most of the work in a motion of a block.
    fn loads_that_drive(&self, block: usize, motion: &[f64]) -> Result<Vec<String>, SystemError> {
        let Scene { mesh, partition, loads, point_loads, rigid, .. } = self.scene;
        let (factor, parts) = (&self.elimination.blocks[block], self.scene.parts());
        let moved = |unknown: usize| motion.iter().enumerate().map(|(k, a)| a * factor.kernel.motions[(unknown, k)]).sum::<f64>();
        let work = |parts: &[&BodyPart], loads: &[Load], point_loads: &[PointLoad]| -> Result<f64, SystemError> {
            let (applied, mut work) = (Applied { parts, loads, point_loads }, 0.0);
            applied_forces(mesh, partition, 0, self.numbering, &applied, |node, force| {
                let node = self.elimination.freedoms.of(self.scene, node);
                if node.block == block {
                    work += node.terms().iter().map(|(unknown, u)| moved(*unknown) * u.dot(&force)).sum::<f64>();
                }
            })?;
            Ok(work)
        };
        let nothing = || [0, 1].map(|_| Formula::constant(0.0));
        let unloaded: Vec<BodyPart> =
            parts.iter().map(|part| BodyPart { force: nothing(), heat: None, ..(*part).clone() }).collect();
        let unloaded: Vec<&BodyPart> = unloaded.iter().collect();
        let mut all = vec![("body_force, gravity or heat".to_string(), work(&parts, &[], &[])?)];
        for load in loads {
            all.push((format!("load.{}", load.name), work(&unloaded, from_ref(load), &[])?));
        }
        for load in point_loads {
            all.push((format!("load.{}", load.name), work(&unloaded, &[], from_ref(load))?));
        }
        for (set, freedom) in rigid.iter().zip(&self.elimination.freedoms.sets).filter(|(_, freedom)| freedom.block == block) {
            let own = freedom.unknowns.iter().zip(set.applied).filter_map(|(unknown, force)| Some(moved((*unknown)?) * force));
            all.push((format!("the force on {}", set.key), own.sum()));
        }
        let most = all.iter().map(|(_, work)| *work).fold(0.0, f64::max);
        Ok(all.into_iter().filter(|(_, work)| *work > 0.5 * most && *work > 0.0).map(|(name, _)| name).collect())
    }

    fn row_of(&self, coupled: &[Coupled]) -> ProgrammeRow {
        let mut row = ProgrammeRow::default();
        for Coupled { node, value, .. } in coupled {
            self.add_node(&mut row, node.number(&self.scene.mesh, self.numbering), *value);
        }
        row.tidied()
    }

    fn add_node(&self, row: &mut ProgrammeRow, node: usize, value: Point) {
        let motion = self.elimination.freedoms.of(self.scene, node);
        row.at_rest += value.dot(&motion.at_rest);
        row.entries.extend(motion.terms().iter().map(|(unknown, u)| (motion.block, *unknown, value.dot(u))));
    }

    /// Rows of the means that are held, `∫ mode · u dA / ∫ |mode|² dA`, and their values.
    fn held_means(&self) -> Result<Vec<(ProgrammeRow, f64)>, SystemError> {
        let mut all = Vec::new();
        for hold in &self.scene.means {
            let about = hold.middle;
            for held in &hold.held {
                let mode = |x: Point| rigid_displacement(about, &held.mode, x);
                let mut weights = self.mean_weights(hold, &mode)?;
                if held.is_turn() {
                    // A turn does not push: it is about the middle of the mesh.
                    let even = self.mean_weights(hold, &|_| Point::new(1.0, 0.0))?;
                    let push: Point = weights.iter().map(|(_, weight)| weight).sum();
                    let area: f64 = even.iter().map(|(_, weight)| weight.x).sum();
                    weights.iter_mut().zip(even).for_each(|((_, weight), (_, even))| *weight -= even.x / area * push);
                }
                let (mut row, mut whole) = (ProgrammeRow::default(), 0.0);
                for (node, weight) in weights {
                    whole += weight.dot(&mode(self.elimination.freedoms.place(node)));
                    self.add_node(&mut row, node, weight);
                }
                row.at_rest /= whole;
                row.entries.iter_mut().for_each(|(_, _, value)| *value /= whole);
                all.push((row.tidied(), held.value));
            }
        }
        Ok(all)
    }

    /// What each node of a body counts in the mean of a mode; a node comes several times.
    fn mean_weights(&self, hold: &MeanHold, mode: &dyn Fn(Point) -> Point) -> Result<Vec<(usize, Point)>, SystemError> {
        let mesh = &self.scene.mesh;
        let mut weights = Vec::new();
        let own = mesh.triangles.iter().enumerate().filter(|(_, triangle)| mesh.bodies[triangle.body as usize] == hold.body);
        for (triangle, _) in own {
            body_forces(mesh, triangle, self.numbering, |points| points.map(mode), &mut |node, weight| {
                weights.push((node, weight));
            })?;
        }
        Ok(weights)
    }
}

impl ProgrammeRow {
    /// Entries by blocks, each unknown once.
    fn tidied(self) -> Self {
        Self { entries: added_up(self.entries, |block, unknown| (block, unknown)), ..self }
    }
}

/// Whether a row has nodes on both sides. One that has not lies beyond a body: no gap is measured there, nothing presses, and a
/// pressure on a rigid tool alone would be as large as it likes.
fn meets_both_sides(coupled: &[Coupled]) -> bool {
    [Side::First, Side::Second].into_iter().all(|side| coupled.iter().any(|coupled| coupled.side == side))
}

fn product(entries: &[(usize, f64)], values: &[f64]) -> f64 {
    entries.iter().map(|&(at, entry)| entry * values[at]).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::{Known, MultiplierSpace};
    use crate::discretisation::finest_numbering;
    use crate::discretisation::samples::{blocks, contact, pair};

    #[test]
    fn beyond_the_end_of_a_body_sides_are_far_apart_and_nothing_presses() {
        let mut scene = blocks(pair(MultiplierSpace::P0, 8), |_| Point::zeros(), Vec::new());
        scene.bodies.iter_mut().flat_map(|body| &mut body.parts).for_each(|part| part.material.poisson = 0.3);
        let mut half = contact(&scene, Known::default());
        half.edges[1].retain(|edge| edge.points.iter().all(|x| x.x < 1.0 + 1e-9));
        let numbering = finest_numbering(&scene).expect("a small mesh");
        let predictor = Predictor::new(&scene, &numbering).expect("good triangles");
        let Prediction::Held(FoundByProgramme { pressures, gaps, .. }) =
            predictor.predict(&[half]).expect("it can be integrated")
        else {
            panic!("nothing drives the blocks");
        };
        assert!(gaps[..4].iter().all(|gap| gap.abs() < 1e-9), "they touch: {gaps:?}");
        assert!(gaps[4..].iter().all(|gap| *gap > 1.0), "there is no upper block: {gaps:?}");
        assert!(pressures.iter().all(|pressure| pressure.abs() < 1e-9), "{pressures:?}");
    }
}
