//! Bodies that nothing holds, found from rigid motions alone: a dense matrix of three motions per body.

use crate::geometry::Point;
use nalgebra::{DMatrix, DVector, SymmetricEigen};

/// A motion costs nothing if its share of what resists is below this.
const NOTHING: f64 = 1e-12;

/// One condition on rigid motions: the displacement of one point of a body in one direction, or a weighted sum of such.
pub type Condition = Vec<(usize, Point, Point)>;

/// Middle and half size of each body, which scale its rotation.
#[derive(Clone, Copy, Debug)]
pub struct Extent {
    /// Middle of the body.
    pub middle: Point,
    /// Half the diagonal of its box (length).
    pub radius: f64,
}

/// A body that can move without resistance.
#[derive(Clone, Debug, PartialEq)]
pub struct Mechanism {
    /// Index of the body that moves most.
    pub body: usize,
    /// Its motion in words.
    pub motion: String,
}

/// Looks for a rigid motion of the bodies that no condition resists. Each condition lists
/// `(body, point, weighted direction)`: supports and the active multipliers.
pub fn find_mechanism(bodies: &[Extent], conditions: &[Condition]) -> Option<Mechanism> {
    let mut gram = DMatrix::<f64>::zeros(3 * bodies.len(), 3 * bodies.len());
    for condition in conditions {
        let mut row = DVector::<f64>::zeros(3 * bodies.len());
        for (body, point, direction) in condition {
            let arm = (point - bodies[*body].middle) / bodies[*body].radius;
            row[3 * body] += direction.x;
            row[3 * body + 1] += direction.y;
            row[3 * body + 2] += direction.y * arm.x - direction.x * arm.y;
        }
        let size: f64 = condition.iter().map(|(.., direction)| direction.norm()).sum();
        if size > 0.0 {
            row /= size;
            gram.ger(1.0, &row, &row, 1.0);
        }
    }
    let resistance = |motion: &DVector<f64>| (&gram * motion).norm() / (gram.norm() * motion.norm()).max(f64::MIN_POSITIVE);
    if gram.norm() == 0.0 {
        return Some(Mechanism { body: 0, motion: "move in every direction".into() });
    }
    for (body, axis) in (0..bodies.len()).flat_map(|body| (0..3).map(move |axis| (body, axis))) {
        let mut motion = DVector::zeros(3 * bodies.len());
        motion[3 * body + axis] = 1.0;
        if resistance(&motion) < NOTHING {
            return Some(describe(body, bodies, &motion));
        }
    }
    let eigen = SymmetricEigen::new(gram.clone());
    let softest = eigen.eigenvalues.imin();
    let motion = eigen.eigenvectors.column(softest).into_owned();
    if eigen.eigenvalues[softest] > NOTHING * eigen.eigenvalues.max() {
        return None;
    }
    let share = |body: &usize| motion.rows(3 * body, 3).norm();
    let body = (0..bodies.len()).max_by(|a, b| share(a).total_cmp(&share(b))).unwrap_or(0);
    Some(describe(body, bodies, &motion))
}

fn describe(body: usize, bodies: &[Extent], motion: &DVector<f64>) -> Mechanism {
    let own = motion.rows(3 * body, 3);
    let own = own / own.amax();
    let (u, turn) = (Point::new(own[0], own[1]), own[2] / bodies[body].radius);
    let words = if own[2].abs() < 1e-6 {
        let u = u * u[u.iamax()].signum();
        format!("move by ({}, {})", tidy(u.x, 1.0), tidy(u.y, 1.0))
    } else {
        // Centre of the rotation: u + turn * (-(y - y0), x - x0) = 0.
        let centre = bodies[body].middle + Point::new(-u.y, u.x) / turn;
        format!("turn about ({}, {})", tidy(centre.x, bodies[body].radius), tidy(centre.y, bodies[body].radius))
    };
    Mechanism { body, motion: words }
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

    fn held(body: usize) -> Vec<Condition> {
        vec![vec![(body, Point::new(0.0, 0.0), X)], vec![(body, Point::new(0.0, 0.0), Y)], vec![(body, Point::new(2.0, 0.0), Y)]]
    }

    fn touching(x: f64) -> Condition {
        vec![(0, Point::new(x, 1.0), Y), (1, Point::new(x, 1.0), -Y)]
    }

    #[test]
    fn two_held_bodies_are_held() {
        let mut conditions = held(0);
        conditions.extend(held(1));
        assert_eq!(find_mechanism(&two(), &conditions), None);
    }

    #[test]
    fn contact_holds_a_floating_body_against_the_normal_only() {
        let mut conditions = held(0);
        conditions.extend([touching(0.2), touching(1.7)]);
        let found = find_mechanism(&two(), &conditions).expect("it slides");
        assert_eq!((found.body, found.motion.as_str()), (1, "move by (1, 0)"));
        conditions.push(vec![(1, Point::new(0.0, 2.0), X)]);
        assert_eq!(find_mechanism(&two(), &conditions), None);
    }

    #[test]
    fn a_body_on_one_pin_turns_about_it() {
        let mut conditions = held(0);
        conditions.extend([vec![(1, Point::new(0.25, 1.0), X)], vec![(1, Point::new(0.25, 1.0), Y)]]);
        let found = find_mechanism(&two(), &conditions).expect("it turns");
        assert_eq!((found.body, found.motion.as_str()), (1, "turn about (0.25, 1)"));
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
