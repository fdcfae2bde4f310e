//! How well supports and contact hold the bodies, from rigid motions alone: a sparse matrix of three motions for each piece of
//! a body.
//!
//! A motion that slides a body along its own boundary does not change the gap. So a closed contact resists a motion only as
//! far as the true normals say, those of either body: the normals of a fitted Γ_C tilt a little between the two, and would
//! hold a disc that rolls.

use crate::body::rigid_displacement;
use crate::contact::holding::block_factor::{BlockFactor, Blocks, add, least_degrees};
use crate::geometry::Point;
use nalgebra::{Cholesky, DMatrix, DVector, SymmetricEigen, Vector3};

/// A motion of unit size is held if some support or contact sees at least this much of it. A short seat holds a long bar by
/// its length over the bar's, a wedge by its slope: both far more than this. Nodes in a file of six digits make less.
const LEAST_HOLD: f64 = 1e-4;

/// Shares of a motion that count as none.
const NOTHING: f64 = 1e-9;

/// What is added to the diagonal beside the largest entry, so that rounding makes no pivot negative: far less than the square
/// of the least hold.
const LEAST_SHARE: f64 = 1e-12;

/// Share of the resistance (a square) to each motion that must be left where some of it is taken away, or else the motions are looked
/// at: a tenth of its size. What is loose is resisted by a ten-thousandth.
const FIRM: f64 = 1e-2;

/// Share of the resistance (a square) to each motion that must be left where the motion that loses most is known to be held.
const LEAST_LEFT: f64 = 1e-5;

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
    /// Motion of the piece in words.
    pub motion: String,
    /// Displacement of the middle of the piece, and its turn (radians).
    pub moves: (Point, f64),
}

impl Mechanism {
    /// Displacement at a point of the piece with this extent.
    pub fn displacement(&self, extent: &Extent, x: Point) -> Point {
        let (shift, turn) = self.moves;
        rigid_displacement(extent.middle, &[shift.x, shift.y, turn], x)
    }
}

/// Looks for a rigid motion of the pieces that supports and closed contacts resist hardly, whichever body's normals count.
pub fn find_mechanism(pieces: &[Extent], supports: &[Condition], contacts: &[Touch]) -> Option<Mechanism> {
    Holding::new(pieces, supports, contacts).mechanism(None)
}

/// For each closed contact whether some piece can move without it.
pub fn needed_contacts(pieces: &[Extent], supports: &[Condition], contacts: &[Touch]) -> Vec<bool> {
    Holding::new(pieces, supports, contacts).needed()
}

/// For each contact the body whose normals count.
type NormalChoice = Vec<usize>;

/// All that holds the pieces.
struct Holding<'a> {
    pieces: &'a [Extent],
    supports: Conditions<'a>,
    contacts: Vec<[Conditions<'a>; 2]>,
    /// The order in which pieces are eliminated.
    order: Vec<usize>,
}

impl<'a> Holding<'a> {
    fn new(pieces: &'a [Extent], supports: &'a [Condition], contacts: &'a [Touch]) -> Self {
        let supports = Conditions::new(supports);
        let contacts: Vec<[Conditions; 2]> =
            contacts.iter().map(|touch| touch.each_ref().map(|all| Conditions::new(all))).collect();
        let coupled = std::iter::once(&supports).chain(contacts.iter().flatten()).flat_map(|all| all.gram.keys().copied());
        let order = least_degrees(pieces.len(), coupled);
        Self { pieces, supports, contacts, order }
    }

    /// A motion that nothing resists, or nothing but the contact `without`.
    fn mechanism(&self, without: Option<usize>) -> Option<Mechanism> {
        let curved = self.curved();
        let bases = self.bases(&curved);
        let loose = bases.iter().find_map(|choice| self.softest(choice, without));
        if loose.is_some() || curved.len() <= MOST_CHOICES {
            return loose;
        }
        // One piece slides along its own boundary, or along those of all its neighbours.
        let factors: Vec<Option<BlockFactor>> = bases.iter().map(|base| self.factor(base, without)).collect();
        (0..self.pieces.len()).flat_map(|piece| [(piece, 1), (piece, 0)]).find_map(|(piece, base)| {
            let is_own = |[first, _]: &[Conditions; 2]| first.all.iter().any(|condition| condition.piece == piece);
            let slides: Vec<usize> = (0..self.contacts.len()).filter(|&at| is_own(&self.contacts[at])).collect();
            let mut change = Blocks::new();
            for &at in slides.iter().filter(|&&at| Some(at) != without) {
                add(&mut change, &self.contacts[at][1 - base].gram, 1.0);
                add(&mut change, &self.contacts[at][base].gram, -1.0);
            }
            let is_firm = factors[base]
                .as_ref()
                .is_some_and(|factor| Remaining::left(factor, &change).is_some_and(|share| share.is_firm()));
            let mut choice = vec![base; self.contacts.len()];
            slides.iter().for_each(|&at| choice[at] = 1 - base);
            if is_firm { None } else { self.softest(&choice, without) }
        })
    }

    /// For each contact whether it is needed. That is decided by one factor for all of them, where the contact leaves
    /// enough of what resists any motion, or where the motion that it resists most is resisted by nothing else.
    fn needed(&self) -> Vec<bool> {
        if self.mechanism(None).is_some() {
            return vec![true; self.contacts.len()];
        }
        let bases = self.bases(&self.curved());
        let factors: Vec<Option<BlockFactor>> = bases.iter().map(|base| self.factor(base, None)).collect();
        let decided = |contact: usize| {
            let mut firm = true;
            for (choice, factor) in bases.iter().zip(&factors) {
                let mut change = Blocks::new();
                add(&mut change, &self.contacts[contact][choice[contact]].gram, -1.0);
                let factor = factor.as_ref()?;
                let share = Remaining::left(factor, &change)?;
                if !share.is_firm() && self.is_loose(&factor.solve(&share.forces), choice, Some(contact)) {
                    return Some(true);
                }
                firm &= share.left >= LEAST_LEFT;
            }
            firm.then_some(false)
        };
        (0..self.contacts.len()).map(|at| decided(at).unwrap_or_else(|| self.mechanism(Some(at)).is_some())).collect()
    }

    /// Contacts that resist other motions by the normals of the other body.
    fn curved(&self) -> Vec<usize> {
        let differ = |[a, b]: &[Conditions; 2]| a.off(b) > NOTHING * a.largest().max(b.largest());
        (0..self.contacts.len()).filter(|&contact| differ(&self.contacts[contact])).collect()
    }

    /// All combinations for few curved contacts. For many of them the normals of all first bodies, and those of all second ones.
    fn bases(&self, curved: &[usize]) -> Vec<NormalChoice> {
        if curved.len() > MOST_CHOICES {
            return vec![vec![0; self.contacts.len()], vec![1; self.contacts.len()]];
        }
        let choice = |bits: usize| {
            let mut choice = vec![0; self.contacts.len()];
            curved.iter().enumerate().for_each(|(k, &contact)| choice[contact] = bits >> k & 1);
            choice
        };
        (0..1 << curved.len()).map(choice).collect()
    }

    /// Everything that holds, by a choice of normals.
    fn chosen(&self, choice: &NormalChoice, without: Option<usize>) -> impl Iterator<Item = &Conditions<'a>> + Clone {
        let contacts = self.contacts.iter().zip(choice.clone()).enumerate();
        let left = contacts.filter(move |(at, _)| Some(*at) != without).map(|(_, (touch, side))| &touch[side]);
        std::iter::once(&self.supports).chain(left)
    }

    /// Whether nothing resists a motion.
    fn is_loose(&self, motion: &DVector<f64>, choice: &NormalChoice, without: Option<usize>) -> bool {
        let size = (0..self.pieces.len()).map(|piece| motion.rows(3 * piece, 3).norm()).fold(0.0, f64::max);
        let mut all = self.chosen(choice, without).flat_map(|conditions| conditions.all);
        all.all(|condition| condition.resists(motion) <= LEAST_HOLD * size)
    }

    /// The sum of the squares of all conditions.
    fn gram(&self, choice: &NormalChoice, without: Option<usize>) -> Blocks {
        let mut gram = Blocks::new();
        self.chosen(choice, without).for_each(|conditions| add(&mut gram, &conditions.gram, 1.0));
        gram
    }

    /// Factor of the sum of the squares of all conditions, beside as little as rounding allows.
    fn factor(&self, choice: &NormalChoice, without: Option<usize>) -> Option<BlockFactor> {
        let gram = self.gram(choice, without);
        let largest = gram.values().fold(f64::MIN_POSITIVE, |most, block| most.max(block.amax()));
        BlockFactor::new(&gram, &self.order, |_| LEAST_SHARE * largest)
    }

    /// The motion that is resisted least, if that is hardly at all. Motions along one axis come first: they have the plainest
    /// words.
    fn softest(&self, choice: &NormalChoice, without: Option<usize>) -> Option<Mechanism> {
        let all: Vec<&Condition> = self.chosen(choice, without).flat_map(|conditions| conditions.all).collect();
        if all.is_empty() {
            return Some(Mechanism { piece: 0, motion: "move in every direction".into(), moves: (Point::x(), 0.0) });
        }
        let unit = |axis: usize| DVector::from_fn(3 * self.pieces.len(), |i, _| if i == axis { 1.0 } else { 0.0 });
        if let Some(axis) = loose_axis(self.pieces.len(), &all) {
            return Some(describe(axis / 3, self.pieces, &unit(axis)));
        }
        if self.holds_all(&all, &self.gram(choice, without)) {
            return None;
        }
        let motion = self.factor(choice, without)?.softest();
        if !self.is_loose(&motion, choice, without) {
            return None;
        }
        let share = |piece: &usize| motion.rows(3 * piece, 3).norm();
        let piece = (0..self.pieces.len()).max_by(|a, b| share(a).total_cmp(&share(b))).unwrap_or(0);
        Some(describe(piece, self.pieces, &motion))
    }

    /// A proof, for less than the softest motion costs, that no motion is loose; it may fail where none is. A loose motion v is
    /// seen by each of the `n` conditions by less than `LEAST_HOLD` of it and the doubt δ of v on both of its pieces, by the
    /// squares of all less than `2 n LEAST_HOLD² + 4 Σ δ² |v|²`: there is none if `gram` less that has a factor.
    fn holds_all(&self, all: &[&Condition], gram: &Blocks) -> bool {
        let mut least = vec![2.0 * all.len() as f64 * LEAST_HOLD.powi(2); self.pieces.len()];
        for condition in all {
            condition.parts().for_each(|(piece, _)| least[piece] += 4.0 * condition.doubt.powi(2));
        }
        BlockFactor::new(gram, &self.order, |piece| -least[piece]).is_some()
    }
}

/// What is left of the resistance to motions when some of it changes.
struct Remaining {
    /// Least share of the resistance to any motion that is left.
    left: f64,
    /// The forces that move the pieces so.
    forces: DVector<f64>,
}

impl Remaining {
    /// Of the matrix `A` with this factor after a change `S` in few of its rows: the least `vᵀ (A + S) v / vᵀ A v`. With the
    /// rows `Z = C Cᵀ` of `A⁻¹` that is `1 + q`, with the least eigenvalue q of `Cᵀ S C`.
    fn left(factor: &BlockFactor, change: &Blocks) -> Option<Self> {
        let mut rows: Vec<usize> = change.keys().map(|&(row, _)| row).collect();
        rows.dedup();
        if rows.is_empty() {
            return Some(Self { left: 1.0, forces: DVector::zeros(factor.count()) });
        }
        let at = |row: usize| 3 * rows.partition_point(|&other| other < row);
        let mut dense = DMatrix::zeros(3 * rows.len(), 3 * rows.len());
        change.iter().for_each(|(&(row, column), block)| dense.fixed_view_mut::<3, 3>(at(row), at(column)).copy_from(block));
        let root = Cholesky::new(factor.compliance(&rows))?.l();
        let eigen = SymmetricEigen::new(root.transpose() * &dense * &root);
        let least = eigen.eigenvalues.imin();
        let local = dense * root * eigen.eigenvectors.column(least);
        let mut forces = DVector::zeros(factor.count());
        rows.iter().enumerate().for_each(|(k, &row)| forces.rows_mut(3 * row, 3).copy_from(&local.rows(3 * k, 3)));
        Some(Self { left: 1.0 + eigen.eigenvalues[least], forces })
    }

    /// Whether every motion is resisted much as before.
    fn is_firm(&self) -> bool {
        self.left >= FIRM
    }
}

/// A motion of one piece along one axis that nothing resists.
fn loose_axis(pieces: usize, all: &[&Condition]) -> Option<usize> {
    let mut resisted = vec![false; 3 * pieces];
    for condition in all {
        for (piece, sees) in condition.parts() {
            (0..3).for_each(|k| resisted[3 * piece + k] |= sees[k].abs() - condition.doubt > LEAST_HOLD);
        }
    }
    resisted.iter().position(|resisted| !resisted)
}

/// Conditions, and the sum of their squares: a matrix of few entries, because a contact has two pieces.
struct Conditions<'a> {
    all: &'a [Condition],
    gram: Blocks,
}

impl<'a> Conditions<'a> {
    fn new(all: &'a [Condition]) -> Self {
        let mut gram = Blocks::new();
        for condition in all {
            let parts = || condition.parts().map(|(piece, sees)| (piece, Vector3::from(*sees)));
            for ((row, left), (column, right)) in parts().flat_map(|part| parts().map(move |other| (part, other))) {
                *gram.entry((row, column)).or_default() += left * right.transpose();
            }
        }
        Self { all, gram }
    }

    /// The largest entry.
    fn largest(&self) -> f64 {
        self.gram.values().fold(0.0, |largest, block| largest.max(block.amax()))
    }

    /// The largest difference of an entry from that of other conditions.
    fn off(&self, other: &Self) -> f64 {
        let mut difference = self.gram.clone();
        add(&mut difference, &other.gram, -1.0);
        difference.values().fold(0.0, |largest, block| largest.max(block.amax()))
    }
}

fn describe(piece: usize, pieces: &[Extent], motion: &DVector<f64>) -> Mechanism {
    let moves = [0, 1, 2].map(|k| motion[3 * piece + k]);
    // A shift that nothing holds may go both ways; a turn is told without its way.
    let way = if moves[0].abs() < moves[1].abs() { moves[1] } else { moves[0] };
    describe_motion(piece, pieces, moves.map(|part| part * way.signum()))
}

/// A motion of a piece in words: its shift, and its turn by the radius of the piece.
pub fn describe_motion(piece: usize, pieces: &[Extent], moves: [f64; 3]) -> Mechanism {
    let largest = moves.iter().fold(0.0f64, |largest, v| largest.max(v.abs()));
    let unit = moves.map(|v| v / largest);
    let (u, turn) = (Point::new(unit[0], unit[1]), unit[2] / pieces[piece].radius);
    let words = if unit[2].abs() < LEAST_HOLD {
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

pub mod changed_forces;

#[cfg(test)]
mod tests;
