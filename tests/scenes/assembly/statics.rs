//! Equilibrium of rigid bodies that push each other at points: are there forces, none of which pulls, and are they the only
//! ones? A question of linear algebra, answered here by non-negative least squares.

/// `columns · forces = wanted`, forces not negative.
#[derive(Clone, Debug, Default)]
pub struct Statics {
    /// One for each contact: what it does to each motion that nothing else holds.
    pub columns: Vec<Vec<f64>>,
    /// What has to be balanced, for each motion.
    pub wanted: Vec<f64>,
}

/// What statics says of a scene.
#[derive(Clone, Debug, PartialEq)]
pub enum Finding {
    /// The forces are these, and there are no others.
    Forces(Vec<f64>),
    /// There are forces; which ones, elasticity says.
    Indeterminate,
    /// Nothing resists some motion, and nothing drives it.
    Loose,
    /// No forces balance the loads.
    Driven,
}

const ROUNDING: f64 = 1e-9;

/// Forces that are less than this part of the largest, or that miss the loads by less, are no clear finding.
const CLEAR: f64 = 0.02;

/// Motions are told to six digits, and contacts have a width: how far off one may be.
const MOTION: f64 = 1e-2;

impl Statics {
    pub fn finding(&self) -> Finding {
        let (forces, rest) = self.least_squares();
        let size = norm(&self.wanted);
        if rest > ROUNDING * size.max(f64::MIN_POSITIVE) {
            return Finding::Driven;
        }
        match self.rank() {
            rank if rank < self.wanted.len() => Finding::Loose,
            rank if rank < self.columns.len() => Finding::Indeterminate,
            _ => Finding::Forces(forces),
        }
    }

    /// Whether the finding stays the same where normals differ a little, as along a contact that has a width.
    pub fn is_clear(&self) -> bool {
        let (forces, miss) = self.least_squares();
        match self.finding() {
            Finding::Driven => miss > CLEAR * norm(&self.wanted),
            Finding::Forces(_) => forces.iter().all(|force| *force > CLEAR * forces.iter().copied().fold(0.0, f64::max)),
            Finding::Indeterminate | Finding::Loose => true,
        }
    }

    /// Whether a motion that is known in some rows only can be completed so that no contact closes, and not against the loads.
    pub fn is_free(&self, motion: &[Option<f64>]) -> bool {
        let mut rates = self.columns.clone();
        rates.push(self.wanted.iter().map(|wanted| -wanted / norm(&self.wanted).max(f64::MIN_POSITIVE)).collect());
        // rates · motion = slack, none negative; a free row is a difference of two unknowns.
        let free = (0..motion.len()).filter(|row| motion[*row].is_none());
        let along = |row: usize, sign: f64| rates.iter().map(|rate| sign * rate[row]).collect::<Vec<_>>();
        let mut columns: Vec<Vec<f64>> = free.flat_map(|row| [along(row, 1.0), along(row, -1.0)]).collect();
        columns.extend((0..rates.len()).map(|k| (0..rates.len()).map(|i| f64::from(i == k)).collect()));
        let known = |rate: &Vec<f64>| motion.iter().zip(rate).filter_map(|(own, push)| own.map(|own| own * push)).sum();
        let wanted: Vec<f64> = rates.iter().map(known).collect();
        let size = norm(&motion.iter().flatten().copied().collect::<Vec<_>>());
        Self { columns, wanted }.least_squares().1 <= MOTION * size
    }

    fn rank(&self) -> usize {
        let mut rows = self.columns.clone();
        let mut rank = 0;
        for pivot in 0..self.wanted.len() {
            let Some(best) = (rank..rows.len()).max_by(|a, b| rows[*a][pivot].abs().total_cmp(&rows[*b][pivot].abs())) else {
                break;
            };
            if rows[best][pivot].abs() < ROUNDING {
                continue;
            }
            rows.swap(rank, best);
            let own = rows[rank].clone();
            for row in &mut rows[rank + 1..] {
                let share = row[pivot] / own[pivot];
                row.iter_mut().zip(&own).for_each(|(value, own)| *value -= share * own);
            }
            rank += 1;
        }
        rank
    }

    /// The forces, none negative, that come closest, and by how much they miss (Lawson and Hanson).
    fn least_squares(&self) -> (Vec<f64>, f64) {
        let count = self.columns.len();
        let mut forces = vec![0.0; count];
        let mut inside = vec![false; count];
        for _ in 0..10 * count.max(1) {
            let rest = self.rest(&forces);
            let gain = |k: usize| dot(&self.columns[k], &rest) / norm(&self.columns[k]).max(f64::MIN_POSITIVE);
            let next = (0..count).filter(|k| !inside[*k]).max_by(|a, b| gain(*a).total_cmp(&gain(*b)));
            let Some(next) = next.filter(|k| gain(*k) > 1e-11 * norm(&self.wanted)) else { break };
            inside[next] = true;
            loop {
                let chosen: Vec<usize> = (0..count).filter(|k| inside[*k]).collect();
                let found = self.solve(&chosen);
                let step = chosen.iter().zip(&found).filter(|(_, new)| **new <= 0.0);
                let step = step.map(|(k, new)| forces[*k] / (forces[*k] - new)).fold(1.0, f64::min);
                for (k, new) in chosen.iter().zip(&found) {
                    forces[*k] += step * (new - forces[*k]);
                }
                if step == 1.0 {
                    break;
                }
                for k in chosen {
                    inside[k] &= forces[k] > 1e-14 * norm(&self.wanted);
                }
            }
        }
        let miss = norm(&self.rest(&forces));
        (forces, miss)
    }

    fn rest(&self, forces: &[f64]) -> Vec<f64> {
        let mut rest = self.wanted.clone();
        for (column, force) in self.columns.iter().zip(forces) {
            rest.iter_mut().zip(column).for_each(|(rest, value)| *rest -= force * value);
        }
        rest
    }

    /// Least squares over some columns, orthogonalised one after the other, twice.
    fn solve(&self, chosen: &[usize]) -> Vec<f64> {
        let (mut basis, mut upper): (Vec<Vec<f64>>, Vec<Vec<f64>>) = (Vec::new(), Vec::new());
        for k in chosen {
            let mut own = self.columns[*k].clone();
            let mut shares = vec![0.0; basis.len()];
            for _ in 0..2 {
                for (q, share) in basis.iter().zip(&mut shares) {
                    let part = dot(q, &own);
                    *share += part;
                    own.iter_mut().zip(q).for_each(|(value, q)| *value -= part * q);
                }
            }
            let size = norm(&own).max(f64::MIN_POSITIVE);
            shares.push(size);
            basis.push(own.iter().map(|value| value / size).collect());
            upper.push(shares);
        }
        let mut found = vec![0.0; chosen.len()];
        for k in (0..chosen.len()).rev() {
            let later: f64 = (k + 1..chosen.len()).map(|j| upper[j][k] * found[j]).sum();
            found[k] = (dot(&basis[k], &self.wanted) - later) / upper[k][k];
        }
        found
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

/// A ball between two planes, one that hangs beside a plane, one that may roll, one on three planes.
#[test]
fn statics_of_a_ball() {
    let of = |columns: &[[f64; 2]]| Statics { columns: columns.iter().map(|c| c.to_vec()).collect(), wanted: vec![0.0, 1.0] };
    let half = 0.5f64.sqrt();
    let Finding::Forces(forces) = of(&[[half, half], [-half, half]]).finding() else { panic!("two planes hold it") };
    forces.iter().for_each(|force| assert!((force - half).abs() < 1e-12));
    assert_eq!(of(&[[half, half]]).finding(), Finding::Driven);
    assert_eq!(of(&[[0.0, 1.0]]).finding(), Finding::Loose);
    assert_eq!(of(&[[half, half], [-half, half], [0.0, 1.0]]).finding(), Finding::Indeterminate);
    assert!(of(&[[half, half]]).is_free(&[Some(1.0), Some(-1.0)]), "along the plane");
    assert!(!of(&[[half, half]]).is_free(&[Some(0.0), Some(-1.0)]), "into it");
    assert!(of(&[[half, half]]).is_free(&[None, Some(-1.0)]), "down, and aside");
}
