//! What the solution on a coarser mesh says of the next finer one: where to start, which multipliers are active, where
//! contact boundaries lie.
//!
//! A single open multiplier between others that press comes from the singularity at an end of contact, as beside the wall of
//! example 2. The first solve on the next mesh reduces the residual to a hundredth of that of the start, in two or three
//! iterations: wrong states have shown themselves by then. If all multipliers are closed on the coarser mesh and none has a gap,
//! or if Γ_C itself ends with the pressure, the first solve goes to the tolerance at once. `cases/bars_parabola` with 48, 190
//! and 757 thousand unknowns takes 13, 13 and 11 iterations in two solves; one solve with the final set takes 11, 12 and 11.

use crate::contact::{ContactBoundary, Known};
use crate::discretisation::{
    BoundaryMotion, Contact, ContactPressure, Discretisation, Field, Scene, Solution, Space, SystemError, beside, spaces,
};
use crate::element::{Order, shape};
use crate::geometry::Point;
use crate::mesh::lattice::Triangle;
use crate::mesh::{EdgeNode, Level, MacroMesh, Numbering};
use crate::petsc::Session;
use crate::procedure::boundary::by_place;
use crate::recovery::largest_stresses;
use crate::system::{Preconditioning, Start};

/// Share of the way of an end from one mesh to the next by which it goes on from there to the one after: its error falls by
/// two to four.
const GOES_ON: f64 = 0.3;

/// That way at most, in segments of the coarser mesh.
const MOST_FORESEEN: f64 = 0.1;

/// Multipliers between an end of contact and an open one that comes from the singularity there.
const NEAR_AN_END: usize = 8;

/// A solution on one refinement less.
pub struct CoarseSolution {
    displacement: Field<2>,
    numbering: Numbering,
    /// What it says of the contacts.
    pub(super) contact: ContactSolution,
    /// The largest von Mises stress of each part (stress).
    pub largest: Vec<f64>,
}

/// What a solution says of the contacts of another mesh: where they lie, what presses, and what it takes to solve for that.
pub(super) struct ContactSolution {
    contacts: Vec<Contact>,
    multipliers: Vec<f64>,
    active: Vec<bool>,
    /// Whether the other mesh is the next refinement of the same macro triangles: ends of contact go on as they have come.
    is_refined: bool,
    /// The preconditioner it needed.
    pub preconditioning: Preconditioning,
    /// Whether its active set was hard to find, or that of a mesh before.
    pub is_hard: bool,
}

impl CoarseSolution {
    /// Takes a solution and its contacts over from the mesh they were found on; `needed` are the preconditioner, and whether the
    /// active set was hard to find. **Collective**
    pub fn new(problem: Discretisation, solution: Solution, needed: (Preconditioning, bool)) -> Result<Self, SystemError> {
        let displacement = Field::displacement(&problem, &solution.displacement);
        Ok(Self {
            largest: largest_stresses(&problem, &displacement)?,
            displacement,
            numbering: problem.finest().numbering.clone(),
            contact: ContactSolution::new(problem.contacts, &solution, true, needed),
        })
    }

    /// The next refinement with the contacts where this solution says, and where to start on it. **Collective**
    ///
    /// # Errors
    /// [`SystemError::Case`] if a contact boundary cannot be placed or measured on that mesh.
    pub fn refined(&self, scene: Scene, session: &Session) -> Result<(Discretisation, Start), SystemError> {
        self.contact.start_on(scene, |scene, space| self.displacement(scene, space, session.rank()), session)
    }

    /// The pressure on a contact.
    pub fn pressure(&self, contact: usize) -> ContactPressure<'_> {
        ContactPressure::new(&self.contact.contacts[contact], &self.contact.multipliers, &self.contact.active)
    }

    /// The same displacement on the next refinement: this rank's unknowns in the nodes' frames.
    pub fn displacement(&self, scene: &Scene, space: &Space, rank: usize) -> Vec<f64> {
        let (mesh, level) = (&scene.mesh, space.numbering.level);
        space.unknowns_of(scene, rank, |triangle| {
            let coarse = self.numbering.triangle(mesh, triangle);
            move |_, at| {
                let add = |u, ((k, l), weight): (_, f64)| u + weight * self.displacement.point(coarse.node(k, l));
                coarse_values(mesh, triangle, level, at).fold(Point::zeros(), add)
            }
        })
    }
}

impl ContactSolution {
    /// The contacts with what was found on them, for a refinement of the mesh or for another one, and what that `needed`.
    pub fn new(
        contacts: Vec<Contact>,
        solution: &Solution,
        is_refined: bool,
        (preconditioning, is_hard): (Preconditioning, bool),
    ) -> Self {
        let (multipliers, active) = (solution.multipliers.clone(), solution.active.clone());
        Self { contacts, multipliers, active, is_refined, preconditioning, is_hard }
    }

    /// Another mesh, displaced as `displaced` says (this rank's unknowns in the nodes' frames), with the contacts where this
    /// solution says, and where to start on it. **Collective**
    ///
    /// # Errors
    /// [`SystemError::Case`] if a contact boundary cannot be placed or measured on that mesh.
    pub fn start_on(
        &self,
        scene: Scene,
        displaced: impl FnOnce(&Scene, &Space) -> Vec<f64>,
        session: &Session,
    ) -> Result<(Discretisation, Start), SystemError> {
        let spaces = spaces(&scene, session.rank())?;
        let space = &spaces[spaces.len() - 1];
        let displacement = displaced(&scene, space);
        let (contacts, motion) = self.contacts(&scene, space, &displacement, session)?;
        let problem = Discretisation::with(scene, spaces, contacts, motion, session)?;
        let (pressures, active) = self.multipliers(&problem.contacts);
        Ok((problem, Start { displacement, pressures, active }))
    }

    /// Pressures and states of the multipliers of the same contacts cut anew.
    fn multipliers(&self, contacts: &[Contact]) -> (Vec<f64>, Vec<bool>) {
        let (mut values, mut active) = (Vec::new(), Vec::new());
        for (old, new) in self.contacts.iter().zip(contacts) {
            let (pressures, mut set) = by_place(old, new, (&self.multipliers, &self.active));
            if self.is_refined && !new.boundary.is_closed() {
                carry_single_ones(&self.active[old.range()], &mut set);
            }
            values.extend(pressures);
            active.extend(set);
        }
        (values, active)
    }

    /// Places the contacts of another mesh: those that follow begin where these have ended. **Collective**
    ///
    /// # Errors
    /// [`SystemError::Case`] if a boundary cannot be placed.
    fn contacts(
        &self,
        scene: &Scene,
        space: &Space,
        unknowns: &[f64],
        session: &Session,
    ) -> Result<(Vec<Contact>, BoundaryMotion), SystemError> {
        let motion = BoundaryMotion::new(scene, space, unknowns, session);
        let displacement = |node: EdgeNode| motion.at(node, &scene.mesh, space);
        let mut known = Vec::new();
        for old in &self.contacts {
            let ([first, last], middle) = (old.ends(), old.boundary.parameter_at(0.5 * old.boundary.length()));
            let places = (!old.boundary.is_closed()).then(|| [first, old.boundary.point(middle), last]);
            let beside = beside(scene, &space.numbering, &old.pair, places);
            known.push(Known { coarser: self.is_refined.then(|| old.ends()), touch: old.known.touch, ..beside });
        }
        let mut contacts = Contact::all_again(scene, &space.numbering, session.rank(), &known, &displacement)?;
        if scene.pairs.iter().any(|pair| pair.follows()) {
            for ((known, new), old) in known.iter_mut().zip(&contacts).zip(&self.contacts).filter(|(_, old)| old.has_free_ends())
            {
                let ends = old.boundary.ends();
                let foot = |k: usize| match ends[k] == old.limits[k] {
                    // Where a body ends, it does so on every mesh.
                    true => new.limits[k],
                    false => foreseen(old, &new.boundary, k),
                };
                known.meeting.clone_from(&new.known.meeting);
                known.ends = Some(ascending([foot(0), foot(1)], &new.boundary));
            }
            contacts = Contact::all_again(scene, &space.numbering, session.rank(), &known, &displacement)?;
        }
        Ok((contacts, motion))
    }
}

/// Both ends of a part of a closed curve, which may lie across its seam: the first before the last.
fn ascending([first, last]: [f64; 2], boundary: &ContactBoundary) -> [f64; 2] {
    [first, boundary.period().filter(|_| last <= first).map_or(last, |period| last + period)]
}

/// Where an end will lie on the next mesh, as a parameter of its boundary: it goes on as it has from the mesh before.
fn foreseen(old: &Contact, boundary: &ContactBoundary, end: usize) -> f64 {
    let here = old.ends()[end];
    let Some(before) = old.known.coarser else { return boundary.foot(here) };
    let [here, before] = boundary.directed_feet([here, before[end]]);
    let knots = old.boundary.knots();
    let segment = if end == 0 { knots[1] - knots[0] } else { knots[knots.len() - 1] - knots[knots.len() - 2] };
    let most = MOST_FORESEEN * segment.abs();
    here + (GOES_ON * (here - before)).clamp(-most, most)
}

/// Single open multipliers between those that press. They come from the singularity at an end of contact, and keep their
/// number from there on every mesh: the finer set opens those, and closes what lies at the place of the coarser ones. A gap
/// of more multipliers is one of the bodies, and stays where it is.
fn carry_single_ones(old: &[bool], new: &mut [bool]) {
    let ends = |set: &[bool]| Some([set.iter().position(|&active| active)?, set.iter().rposition(|&active| active)?]);
    let (Some(old_ends), Some(new_ends)) = (ends(old), ends(new)) else { return };
    let inner: Vec<usize> = (old_ends[0]..old_ends[1]).filter(|&i| !old[i]).collect();
    if inner.windows(2).any(|pair| pair[1] == pair[0] + 1) {
        return;
    }
    new[new_ends[0]..=new_ends[1]].fill(true);
    for i in inner {
        let [from_first, from_last] = [i - old_ends[0], old_ends[1] - i];
        let at = if from_first <= from_last { Some(new_ends[0] + from_first) } else { new_ends[1].checked_sub(from_last) };
        if let Some(at) = at.filter(|&at| from_first.min(from_last) <= NEAR_AN_END && at > new_ends[0] && at < new_ends[1]) {
            new[at] = false;
        }
    }
}

/// Nodes of the coarser lattice with the values of their shape functions at node `(i, j)` of a level: those of the
/// coarse triangle that holds it. Zeros are left out.
pub(super) fn coarse_values(
    mesh: &MacroMesh,
    triangle: usize,
    level: Level,
    (i, j): (usize, usize),
) -> impl Iterator<Item = ((usize, usize), f64)> {
    let order = level.order;
    let step = 2 * order.degree();
    let count = level.intervals / step;
    let (mut a, mut b) = (i / step, j / step);
    // On the far edge the last triangle holds it.
    if a + b >= count {
        if a > 0 && i % step == 0 {
            a -= 1
        } else if b > 0 && j % step == 0 {
            b -= 1
        }
    }
    let (x, y) = ((i - a * step) as f64 / step as f64, (j - b * step) as f64 / step as f64);
    let (small, l) = Triangle::holding((a, b), (x, y), count, order);
    let l = mesh.place_in_parent(triangle, level.intervals / 2, small.nodes(), l);
    let weights = match order {
        Order::P1 => [l[0], l[1], l[2], 0.0, 0.0, 0.0],
        Order::P2 => shape::<6>(l),
    };
    small.nodes::<6>().into_iter().zip(weights).filter(|(_, weight)| *weight != 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{lattice, samples::two_blocks};

    #[test]
    fn single_open_multipliers_keep_their_number_from_the_end() {
        let carried = |old: &str, new: &str| {
            let set = |text: &str| text.chars().map(|c| c == '1').collect::<Vec<_>>();
            let mut next = set(new);
            carry_single_ones(&set(old), &mut next);
            next.iter().map(|&active| if active { '1' } else { '0' }).collect::<String>()
        };
        assert_eq!(carried("10111100", "110011111111000"), "101111111111000");
        assert_eq!(carried("01111010", "001111111100110"), "001111111111010");
        assert_eq!(carried("11100111", "111111000011111"), "111111000011111", "a gap of the bodies");
        assert_eq!(carried("1011", "11"), "11", "no room");
        assert_eq!(carried("0000", "10"), "10");
    }

    #[test]
    fn polynomials_of_the_order_are_carried_exactly() {
        let mut graded = two_blocks();
        for (at, ratio) in [([0.0, 1.0], 0.2), ([0.9, 1.0], 0.3), ([2.0, 2.0], 0.15)] {
            graded.grade(at.into(), ratio).expect("a vertex");
        }
        for (mesh, (order, n)) in [two_blocks(), graded]
            .iter()
            .flat_map(|mesh| [(Order::P1, 8), (Order::P2, 8), (Order::P2, 4), (Order::P1, 2)].map(|level| (mesh, level)))
        {
            let [fine, coarse] = [n, n / 2].map(|intervals| Level { intervals, order });
            let squares = if order == Order::P2 { 1.0 } else { 0.0 };
            let value = |x: Point| 1.0 + 2.0 * x.x - x.y + squares * (x.x * x.x - 3.0 * x.x * x.y + 0.5 * x.y * x.y);
            for (triangle, (i, j)) in (0..6).flat_map(|triangle| lattice::nodes(n).map(move |node| (triangle, node))) {
                let found: f64 = coarse_values(mesh, triangle, fine, (i, j))
                    .map(|((k, l), weight)| {
                        assert!(k + l <= n / 2, "({k}, {l}) is a node");
                        weight * value(mesh.node_position(triangle, coarse, (k, l)))
                    })
                    .sum();
                let exact = value(mesh.node_position(triangle, fine, (i, j)));
                assert!((found - exact).abs() < 1e-12, "{order:?} {n} triangle {triangle} ({i}, {j})");
            }
        }
    }
}
