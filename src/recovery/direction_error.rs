//! What contacts take up of each other's forces once these have turned with the bodies.
//!
//! On undeformed bodies a contact presses along normals of Γ_C. Where a body rolls or slides along it, the sides have another normal in
//! common, and press elsewhere: their force and its moment turn. A body that turns carries its loads to other places, too. What supports
//! hold goes to the supports. A free body is in balance by its other contacts, and beside a large force that turns a little a small one is
//! wrong by much: of a rocker of radius 4 on a stiff flat, under 20 off its centre by .1, that .4 push onto a wall, the wall had .0988, and
//! 3.05 of itself too little by this estimate.
//!
//! What is out of balance is distributed body by body, each in its turn with its neighbours at rest, until nothing is left that contacts
//! resist (the moment distribution of H. Cross, Trans. ASCE 96, 1932).

use crate::contact::TurnedForce;
use crate::discretisation::{Contact, Discretisation, Freedom};
use nalgebra::{Matrix3, Vector3};

/// Change of any error in a round, below which the rounds end: a thousandth of what is doubted. A row of bodies hands on ever less.
const LITTLE: f64 = 1e-5;

/// Rounds at most: what a row of ten bodies leaves then is a thousandth, each of which hands on half.
const ROUNDS: usize = 100;

/// For each contact what it takes up of forces and moments out of balance, by its own force; zero where nothing presses. `moments` is what
/// the motion of the bodies has added to the moment of all that acts on each, where it acts on what the bodies are made of.
pub fn direction_errors(
    problem: &Discretisation,
    freedoms: Vec<Option<Freedom>>,
    forces: &[TurnedForce],
    moments: &[f64],
) -> Vec<f64> {
    Framework::new(problem, freedoms, forces, moments).settled()
}

/// Bodies and the contacts between them, with what is out of balance.
struct Framework {
    bodies: Vec<Option<FreeBody>>,
    struts: Vec<Strut>,
}

/// A body that supports do not hold.
struct FreeBody {
    /// Its contacts, and which of their bodies it is.
    struts: Vec<(usize, usize)>,
    freedom: Freedom,
    /// Its motion by what is out of balance.
    compliance: Matrix3<f64>,
    /// Force and moment out of balance, in its frame.
    left: Vector3<f64>,
}

/// A contact that presses.
struct Strut {
    bodies: [usize; 2],
    force: f64,
    /// Of shifts and turns about its middle, by the stiffness that all contacts have.
    resistance: Matrix3<f64>,
    /// From its middle into the frame of either body.
    into: [Matrix3<f64>; 2],
    /// Force and moment about its middle that it has taken up.
    taken: Vector3<f64>,
}

impl Framework {
    fn new(problem: &Discretisation, mut freedoms: Vec<Option<Freedom>>, forces: &[TurnedForce], moments: &[f64]) -> Self {
        // Springs count beside contacts, which are about as stiff as their bodies.
        let moduli = problem.contacts.iter().flat_map(|contact| &contact.multiplier_moduli).copied();
        let stiffness = moduli.fold(f64::MIN_POSITIVE, f64::max);
        freedoms.iter_mut().flatten().for_each(|freedom| freedom.springs /= stiffness);
        let strut = |(contact, own): (&Contact, &TurnedForce)| Strut {
            bodies: contact.bodies,
            force: own.force,
            resistance: if own.force > 0.0 { own.resistance / own.force } else { Matrix3::zeros() },
            into: contact
                .bodies
                .map(|body| freedoms[body].as_ref().map_or(Matrix3::zeros(), |freedom| freedom.frame(own.middle))),
            taken: Vector3::zeros(),
        };
        let struts: Vec<Strut> = problem.contacts.iter().zip(forces).map(strut).collect();
        let body = |(at, freedom): (usize, Option<Freedom>)| {
            let freedom = freedom?;
            let of_joint = |(k, strut): (usize, &Strut)| Some((k, strut.bodies.iter().position(|&body| body == at)?));
            let own: Vec<(usize, usize)> = struts.iter().enumerate().filter_map(of_joint).collect();
            let resistance = own.iter().map(|&(k, side)| struts[k].seen(side, side)).sum();
            let turned: Vector3<f64> = own.iter().map(|&(k, side)| struts[k].into[side] * forces[k].turned[side]).sum();
            let moment = Vector3::new(0.0, 0.0, moments[at] / freedom.extent.radius);
            let left = turned + moment;
            Some(FreeBody { struts: own, compliance: freedom.compliance(&resistance), freedom, left })
        };
        Self { bodies: freedoms.into_iter().enumerate().map(body).collect(), struts }
    }

    /// What each contact has taken up in the end, by its own force.
    fn settled(mut self) -> Vec<f64> {
        let mut errors = vec![0.0; self.struts.len()];
        for _ in 0..ROUNDS {
            (0..self.bodies.len()).for_each(|body| self.distribute(body));
            let before = std::mem::replace(&mut errors, self.errors());
            if before.iter().zip(&errors).all(|(before, now)| (now - before).abs() < LITTLE) {
                break;
            }
        }
        errors
    }

    /// What each contact has taken up, by its own force.
    fn errors(&self) -> Vec<f64> {
        let error = |strut: &Strut| if strut.force > 0.0 { strut.taken.xy().norm() / strut.force } else { 0.0 };
        self.struts.iter().map(error).collect()
    }

    /// Moves a body by what is out of balance on it, so that its contacts and springs take that up, or hand it on.
    fn distribute(&mut self, at: usize) {
        let Some(body) = &mut self.bodies[at] else { return };
        let moves = body.compliance * body.left;
        body.left -= body.freedom.springs * moves;
        for (k, side) in body.struts.clone() {
            let strut = &mut self.struts[k];
            strut.taken += strut.resistance * strut.into[side].transpose() * moves * if side == 0 { 1.0 } else { -1.0 };
            for (of, sign) in [(side, -1.0), (1 - side, 1.0)] {
                let handed = strut.seen(of, side) * moves;
                if let Some(body) = &mut self.bodies[strut.bodies[of]] {
                    body.left += sign * handed;
                }
            }
        }
    }
}

impl Strut {
    /// Force and moment on one of its bodies by a motion of one of them.
    fn seen(&self, on: usize, by: usize) -> Matrix3<f64> {
        self.into[on] * self.resistance * self.into[by].transpose()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::Extent;
    use crate::geometry::Point;

    /// A row of free bodies between two walls, all pressed by one; the first is pushed along the row and across it.
    fn row(count: usize) -> Framework {
        let freedom = || Freedom {
            extent: Extent { middle: Point::zeros(), radius: 1.0 },
            free: Matrix3::identity(),
            springs: Matrix3::zeros(),
        };
        let normal = Vector3::new(1.0, 0.0, 0.0);
        let is_wall = |body: usize| body == 0 || body > count;
        let strut = |at: usize| Strut {
            bodies: [at, at + 1],
            force: 1.0,
            resistance: normal * normal.transpose(),
            into: [at, at + 1].map(|body| if is_wall(body) { Matrix3::zeros() } else { Matrix3::identity() }),
            taken: Vector3::zeros(),
        };
        let struts: Vec<Strut> = (1..=count).map(strut).collect();
        let body = |at: usize| {
            let of_joint = |(k, strut): (usize, &Strut)| Some((k, strut.bodies.iter().position(|&body| body == at)?));
            let own: Vec<(usize, usize)> = struts.iter().enumerate().filter_map(of_joint).collect();
            let resistance = own.iter().map(|&(k, side)| struts[k].seen(side, side)).sum();
            let left = if at == 1 { Vector3::new(0.3, 9.0, 0.0) } else { Vector3::zeros() };
            (!is_wall(at)).then(|| FreeBody {
                struts: own,
                compliance: freedom().compliance(&resistance),
                freedom: freedom(),
                left,
            })
        };
        Framework { bodies: (0..count + 2).map(body).collect(), struts }
    }

    /// The first wall does not touch: all that pushes the first body goes through the row, and nothing of what pushes it across.
    #[test]
    fn a_force_goes_through_a_whole_row_of_bodies() {
        for count in [1, 2, 6] {
            let errors = row(count).settled();
            assert!(errors.iter().all(|error| (error - 0.3).abs() < 2e-3), "{count}: {errors:?}");
        }
    }
}
