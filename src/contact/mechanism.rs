//! How well supports and contact hold the bodies, from rigid motions alone: a dense matrix of three motions for each piece of
//! a body.
//!
//! A motion that slides a body along its own boundary does not change the gap. So a closed contact resists a motion only as
//! far as the true normals say, those of either body: the normals of a fitted Γ_C tilt a little between the two, and would
//! hold a disc that rolls.

use crate::geometry::Point;
use nalgebra::{Cholesky, DMatrix, DVector, SymmetricEigen};
use std::collections::BTreeMap;

/// A motion of unit size is held if some support or contact sees at least this much of it. A short seat holds a long bar by
/// its length over the bar's, a wedge by its slope: both far more than this. Nodes in a file of six digits make less.
const LEAST_HOLD: f64 = 1e-4;

/// Shares of a motion that count as none.
const NOTHING: f64 = 1e-9;

/// Contacts on curved boundaries up to which all choices of the normals are tried.
const MOST_CHOICES: usize = 6;

/// One condition on rigid motions: the mean displacement of some points of a piece, each in its own direction, against the
/// same points moved with another piece, or against the ground.
#[derive(Clone, Copy, Debug)]
pub struct Condition {
    /// The piece that is held.
    pub piece: usize,
    /// The piece that holds it; nothing if a support does.
    pub against: Option<usize>,
    /// What it sees of shifts of either piece, and of turns by their radius.
    pub sees: [[f64; 3]; 2],
    /// By how much the directions are uncertain (radians).
    pub doubt: f64,
}

impl Condition {
    /// A condition on points of a piece, by places and weighted directions; nothing if it resists nothing.
    pub fn new(extents: &[Extent], piece: usize, against: Option<usize>, terms: &[(Point, Point)], doubt: f64) -> Option<Self> {
        let size: f64 = terms.iter().map(|(_, direction)| direction.norm()).sum();
        if size == 0.0 || against == Some(piece) {
            return None;
        }
        let seen = |(piece, sign): (usize, f64)| {
            let Extent { middle, radius } = extents[piece];
            let mut sums = [0.0; 3];
            for (x, direction) in terms {
                let arm = (x - middle) / radius;
                let values = [direction.x, direction.y, direction.y * arm.x - direction.x * arm.y];
                (0..3).for_each(|k| sums[k] += sign / size * values[k]);
            }
            sums
        };
        let sees = [seen((piece, 1.0)), against.map_or([0.0; 3], |piece| seen((piece, -1.0)))];
        Some(Self { piece, against, sees, doubt })
    }

    /// Both pieces, or the one, with what it sees of them.
    fn parts(&self) -> impl Iterator<Item = (usize, &[f64; 3])> {
        std::iter::once(self.piece).chain(self.against).zip(&self.sees)
    }

    /// How much of a motion it certainly resists. What the motion does across the direction may be mistaken for resistance,
    /// by the doubt about the direction.
    fn resists(&self, motion: &DVector<f64>) -> f64 {
        let (mut seen, mut size) = (0.0, 0.0);
        for (piece, sees) in self.parts() {
            let of_piece = [0, 1, 2].map(|k| motion[3 * piece + k]);
            seen += (0..3).map(|k| sees[k] * of_piece[k]).sum::<f64>();
            size += of_piece.iter().map(|v| v * v).sum::<f64>().sqrt();
        }
        seen.abs() - self.doubt * size
    }
}

/// What a contact resists: by the normals of body 1, and by those of body 2. One of them is enough to let go.
pub type Touch = [Vec<Condition>; 2];

/// Middle and half size of a piece, which scale its rotation.
#[derive(Clone, Copy, Debug)]
pub struct Extent {
    /// Middle of the piece.
    pub middle: Point,
    /// Half the diagonal of its box (length).
    pub radius: f64,
}

/// A piece that can move without resistance.
#[derive(Clone, Debug, PartialEq)]
pub struct Mechanism {
    /// Index of the piece that moves most.
    pub piece: usize,
    /// Its motion in words.
    pub motion: String,
    /// Its displacement at the middle, and its turn (radians).
    pub moves: (Point, f64),
}

impl Mechanism {
    /// Displacement at a point of the piece with this extent.
    pub fn displacement(&self, extent: &Extent, x: Point) -> Point {
        let (arm, (shift, turn)) = (x - extent.middle, self.moves);
        shift + turn * Point::new(-arm.y, arm.x)
    }
}

/// Looks for a rigid motion of the pieces that supports and closed contacts resist hardly, whichever body's normals count.
pub fn find_mechanism(pieces: &[Extent], supports: &[Condition], contacts: &[Touch]) -> Option<Mechanism> {
    let supports = Conditions::new(supports);
    let contacts: Vec<[Conditions; 2]> = contacts.iter().map(|touch| touch.each_ref().map(|own| Conditions::new(own))).collect();
    let differ = |[a, b]: &[Conditions; 2]| a.off(b) > NOTHING * a.largest().max(b.largest());
    let curved: Vec<usize> = (0..contacts.len()).filter(|&contact| differ(&contacts[contact])).collect();
    choices(&contacts, &curved).into_iter().find_map(|choice| {
        let chosen = contacts.iter().zip(&choice).map(|(touch, &side)| &touch[side]);
        softest(pieces, &std::iter::once(&supports).chain(chosen).collect::<Vec<_>>())
    })
}

/// For each contact the body whose normals count: all combinations for few curved contacts. For many of them those in which
/// one piece slides along its own boundary, or along those of all its neighbours.
fn choices(contacts: &[[Conditions; 2]], curved: &[usize]) -> Vec<Vec<usize>> {
    if curved.len() <= MOST_CHOICES {
        let choice = |bits: usize| {
            let mut choice = vec![0; contacts.len()];
            curved.iter().enumerate().for_each(|(k, &contact)| choice[contact] = bits >> k & 1);
            choice
        };
        return (0..1 << curved.len()).map(choice).collect();
    }
    let pieces =
        contacts.iter().flatten().flat_map(|conditions| conditions.all).map(|condition| condition.piece + 1).max().unwrap_or(0);
    let of =
        |piece: usize, [first, _]: &[Conditions; 2]| usize::from(!first.all.iter().any(|condition| condition.piece == piece));
    let along = |piece: usize| contacts.iter().map(|touch| of(piece, touch)).collect::<Vec<usize>>();
    let other = |choice: Vec<usize>| choice.into_iter().map(|side| 1 - side).collect::<Vec<usize>>();
    let ends = [vec![0; contacts.len()], vec![1; contacts.len()]];
    ends.into_iter().chain((0..pieces).flat_map(|piece| [along(piece), other(along(piece))])).collect()
}

/// Conditions, and the sum of their squares: a matrix of few entries, because a contact has two pieces.
struct Conditions<'a> {
    all: &'a [Condition],
    gram: BTreeMap<(usize, usize), f64>,
}

impl<'a> Conditions<'a> {
    fn new(all: &'a [Condition]) -> Self {
        let mut gram = BTreeMap::new();
        for condition in all {
            for ((one, left), (other, right)) in
                condition.parts().flat_map(|part| condition.parts().map(move |other| (part, other)))
            {
                for (i, j) in (0..3).flat_map(|i| (0..3).map(move |j| (i, j))) {
                    *gram.entry((3 * one + i, 3 * other + j)).or_insert(0.0) += left[i] * right[j];
                }
            }
        }
        Self { all, gram }
    }

    /// The largest entry.
    fn largest(&self) -> f64 {
        self.gram.values().fold(0.0, |largest, entry| largest.max(entry.abs()))
    }

    /// The largest difference of an entry from that of other conditions.
    fn off(&self, other: &Self) -> f64 {
        let entry = |gram: &BTreeMap<(usize, usize), f64>, at| gram.get(at).copied().unwrap_or(0.0);
        let places = self.gram.keys().chain(other.gram.keys());
        places.map(|at| (entry(&self.gram, at) - entry(&other.gram, at)).abs()).fold(0.0, f64::max)
    }
}

/// The motion that is resisted least, if that is hardly at all. Motions along one axis come first: they have the plainest
/// words.
fn softest(pieces: &[Extent], holding: &[&Conditions]) -> Option<Mechanism> {
    let count = 3 * pieces.len();
    let loose = |motion: &DVector<f64>| {
        let size = (0..pieces.len()).map(|piece| motion.rows(3 * piece, 3).norm()).fold(0.0, f64::max);
        holding.iter().flat_map(|conditions| conditions.all).all(|condition| condition.resists(motion) <= LEAST_HOLD * size)
    };
    let unit = |axis: usize| DVector::from_fn(count, |i, _| if i == axis { 1.0 } else { 0.0 });
    if holding.iter().all(|conditions| conditions.all.is_empty()) {
        let shift = Point::new(1.0, 0.0);
        return Some(Mechanism { piece: 0, motion: "move in every direction".into(), moves: (shift, 0.0) });
    }
    let mut gram = DMatrix::zeros(count, count);
    for conditions in holding {
        conditions.gram.iter().for_each(|(&at, entry)| gram[at] += entry);
    }
    if holds_all(holding, &gram) {
        return None;
    }
    if let Some(axis) = (0..count).find(|&axis| loose(&unit(axis))) {
        return Some(describe(axis / 3, pieces, &unit(axis)));
    }
    let eigen = SymmetricEigen::new(gram);
    let motion = eigen.eigenvectors.column(eigen.eigenvalues.imin()).into_owned();
    if !loose(&motion) {
        return None;
    }
    let share = |piece: &usize| motion.rows(3 * piece, 3).norm();
    let piece = (0..pieces.len()).max_by(|a, b| share(a).total_cmp(&share(b))).unwrap_or(0);
    Some(describe(piece, pieces, &motion))
}

/// A proof, for a hundredth of what the eigenvalues cost, that no motion is loose; it may fail where none is. The `n` conditions
/// see `τ` of the square of every motion in all if `gram - τ` has a factor, so one of them at least `√(τ/n)` of it; a loose
/// motion would be seen by less than `LEAST_HOLD` and twice the doubt.
fn holds_all(holding: &[&Conditions], gram: &DMatrix<f64>) -> bool {
    let all = || holding.iter().flat_map(|conditions| conditions.all);
    let seen = LEAST_HOLD + 2.0 * all().map(|condition| condition.doubt).fold(0.0, f64::max);
    let least = 2.0 * all().count() as f64 * seen * seen;
    let mut shifted = gram.clone();
    (0..gram.nrows()).for_each(|i| shifted[(i, i)] -= least);
    Cholesky::new(shifted).is_some()
}

fn describe(piece: usize, pieces: &[Extent], motion: &DVector<f64>) -> Mechanism {
    let own = motion.rows(3 * piece, 3);
    let own = own / own.amax();
    let (u, turn) = (Point::new(own[0], own[1]), own[2] / pieces[piece].radius);
    let words = if own[2].abs() < LEAST_HOLD {
        let u = u * u[u.iamax()].signum();
        format!("move by ({}, {})", tidy(u.x, 1.0), tidy(u.y, 1.0))
    } else {
        // Centre of the rotation: u + turn * (-(y - y0), x - x0) = 0.
        let centre = pieces[piece].middle + Point::new(-u.y, u.x) / turn;
        format!("turn about ({}, {})", tidy(centre.x, pieces[piece].radius), tidy(centre.y, pieces[piece].radius))
    };
    Mechanism { piece, motion: words, moves: (u, turn) }
}

/// A number to about four digits of what counts as large.
pub fn tidy(v: f64, large: f64) -> String {
    let decimals = (4.0 - large.log10().floor()).max(0.0) as usize;
    if v.abs() < 1e-4 * large {
        "0".into()
    } else if decimals > 9 {
        format!("{v:.4e}")
    } else {
        let text = format!("{v:.decimals$}");
        if decimals > 0 { text.trim_end_matches('0').trim_end_matches('.').into() } else { text }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const X: Point = Point::new(1.0, 0.0);
    const Y: Point = Point::new(0.0, 1.0);

    fn two() -> [Extent; 2] {
        [Extent { middle: Point::new(1.0, 0.5), radius: 1.0 }, Extent { middle: Point::new(1.0, 1.5), radius: 1.0 }]
    }

    fn hold(piece: usize, x: f64, y: f64, direction: Point) -> Condition {
        one_point(&two(), piece, None, x, y, direction)
    }

    fn one_point(pieces: &[Extent], piece: usize, against: Option<usize>, x: f64, y: f64, direction: Point) -> Condition {
        Condition::new(pieces, piece, against, &[(Point::new(x, y), direction)], 0.0).expect("it resists something")
    }

    fn held(piece: usize) -> Vec<Condition> {
        vec![hold(piece, 0.0, 0.0, X), hold(piece, 0.0, 0.0, Y), hold(piece, 2.0, 0.0, Y)]
    }

    /// Closed contact of two flat boundaries at these places.
    fn touching(pieces: &[Extent], places: &[f64]) -> Touch {
        let at = |piece: usize, sign: f64| {
            let one = |&x: &f64| one_point(pieces, piece, Some(1 - piece), x, 1.0, sign * Y);
            places.iter().map(one).collect()
        };
        [at(0, 1.0), at(1, -1.0)]
    }

    /// The disc of radius 1 on top of a flat body that is held, touching over an angle; its normals are off by `doubt`.
    fn disc(angle: f64, doubt: f64) -> ([Extent; 2], Vec<Condition>, Touch) {
        let pieces = [two()[0], Extent { middle: Point::new(1.0, 2.0), radius: 1.5 }];
        let places: Vec<f64> = (-3..=3).map(|k| f64::from(k) / 3.0 * angle).collect();
        let round = |a: &f64| {
            let normal = Point::new((a + doubt).sin(), -(a + doubt).cos());
            let x = Point::new(1.0 + a.sin(), 2.0 - a.cos());
            Condition { doubt, ..one_point(&pieces, 1, Some(0), x.x, x.y, normal) }
        };
        let [flat, _] = touching(&pieces, &places.iter().map(|a| 1.0 + a.sin()).collect::<Vec<_>>());
        (pieces, held(0), [flat, places.iter().map(round).collect()])
    }

    #[test]
    fn two_held_bodies_are_held() {
        let mut supports = held(0);
        supports.extend(held(1));
        assert_eq!(find_mechanism(&two(), &supports, &[]), None);
    }

    #[test]
    fn contact_holds_a_floating_body_against_the_normal_only() {
        let mut supports = held(0);
        let contact = [touching(&two(), &[0.2, 1.7])];
        let found = find_mechanism(&two(), &supports, &contact).expect("it slides");
        assert_eq!((found.piece, found.motion.as_str()), (1, "move by (1, 0)"));
        supports.push(hold(1, 0.0, 2.0, X));
        assert_eq!(find_mechanism(&two(), &supports, &contact), None);
    }

    #[test]
    fn a_short_seat_holds_a_long_body() {
        let mut supports = held(0);
        supports.push(hold(1, 0.0, 2.0, X));
        assert_eq!(find_mechanism(&two(), &supports, &[touching(&two(), &[0.9, 0.901])]), None);
        assert!(find_mechanism(&two(), &supports, &[touching(&two(), &[0.9, 0.900001])]).is_some(), "as good as a point");
    }

    #[test]
    fn a_disc_rolls_however_wide_it_touches_until_it_is_held() {
        for (angle, doubt) in [(0.05, 0.0), (1.0, 0.0), (0.3, 1e-3)] {
            let (pieces, mut supports, contact) = disc(angle, doubt);
            let found = |supports: &[Condition]| find_mechanism(&pieces, supports, std::slice::from_ref(&contact));
            assert_eq!(found(&supports).expect("it slides").motion, "move by (1, 0)");
            supports.push(one_point(&pieces, 1, None, 1.0, 2.0, X));
            assert_eq!(found(&supports).expect("it rolls").motion, "turn about (1, 2)");
            supports.push(one_point(&pieces, 1, None, 1.0, 3.0, X));
            assert_eq!(found(&supports), None);
        }
    }

    #[test]
    fn a_long_chain_is_held_and_its_loose_link_is_found() {
        let pieces: Vec<Extent> = (0..50).map(|k| Extent { middle: Point::new(1.0, f64::from(k) + 0.5), radius: 1.0 }).collect();
        let line = |k: usize| {
            let of = |piece: usize, against: usize, sign: f64| {
                let one = |x: f64| one_point(&pieces, piece, Some(against), x, k as f64 + 1.0, sign * Y);
                vec![one(0.2), one(1.7)]
            };
            [of(k, k + 1, 1.0), of(k + 1, k, -1.0)]
        };
        let lines: Vec<Touch> = (0..49).map(line).collect();
        let mut supports: Vec<Condition> = (0..50).map(|k| one_point(&pieces, k, None, 0.0, k as f64 + 0.5, X)).collect();
        supports.extend([0.0, 2.0].map(|x| one_point(&pieces, 0, None, x, 0.0, Y)));
        assert_eq!(find_mechanism(&pieces, &supports, &lines), None);
        supports.remove(25);
        let found = find_mechanism(&pieces, &supports, &lines).expect("it slides");
        assert_eq!((found.piece, found.motion.as_str()), (25, "move by (1, 0)"));
    }

    #[test]
    fn a_body_on_one_pin_turns_about_it() {
        let mut supports = held(0);
        supports.extend([hold(1, 0.25, 1.0, X), hold(1, 0.25, 1.0, Y)]);
        let found = find_mechanism(&two(), &supports, &[]).expect("it turns");
        assert_eq!((found.piece, found.motion.as_str()), (1, "turn about (0.25, 1)"));
    }

    #[test]
    fn words_have_the_digits_of_the_body_in_any_unit() {
        let table = [
            (0.25, 1.0, "0.25"),
            (-0.60181502, 1.0, "-0.6018"),
            (3e-5, 1.0, "0"),
            (-1.0, 1.0, "-1"),
            (20.0, 30.0, "20"),
            (1234567.891, 5e3, "1234567.9"),
            (6e17, 3e9, "600000000000000000"),
            (-2.5e-9, 1e-9, "-2.5000e-9"),
        ];
        for (v, large, words) in table {
            assert_eq!(tidy(v, large), words);
        }
    }
}
