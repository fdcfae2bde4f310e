//! The next mesh of a sequence: refined where the errors lie, and at once again where it can be foreseen that too much is left.
//!
//! Differences are known on cells, sixty-four in each macro triangle, so that the parts of a refined triangle have indicators
//! before anything is solved on them: what lies in their cells, less by what the last refinement has brought there.

use super::across::across;
use super::marking::marked;
use crate::contact::Pair;
use crate::mesh::{BisectedMesh, Cells, Origin};

/// Rounds of refinement before the next solve, at most: parts of a third round are single cells.
const ROUNDS: usize = 3;

/// Unknowns of the next mesh by those of the present one, at most, where it is refined more than once.
const MOST_GROWTH: f64 = 4.0;

/// Shares of the sum of all indicators that the marked triangles hold at least, tried one after the other until the errors are
/// foreseen to be small enough (the last one: Dörfler, SIAM J. Numer. Anal. 33, 1996).
const SHARES: [f64; 2] = [0.4, 0.6];

/// Unknowns that a mesh may always have.
const SMALL: f64 = 4000.0;

/// Share of what is asked for at which an error that is only foreseen counts as reached.
const SURELY: f64 = 0.8;

/// What a macro triangle counts for a goal.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct LocalIndicator {
    /// Where in it.
    pub cells: Cells,
    /// Factor by which that falls if it is quartered.
    pub fall: f64,
}

/// What all macro triangles count for a goal that is missed.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Indicators {
    /// For each of them.
    pub local: Vec<LocalIndicator>,
    /// Estimated error by what is asked for; nothing if it is not known.
    pub error: Option<f64>,
    /// What came of errors that were foreseen before, by what was foreseen.
    pub trust: f64,
    /// Whether the error goes with the root of the sum of the indicators.
    pub is_norm: bool,
}

impl LocalIndicator {
    /// The same for a part of the triangle: halving it brings the root of what quartering does.
    fn of_part(&self, part: &Origin) -> Self {
        let fall = self.fall.powf(-0.5 * part.area().log2());
        Self { cells: self.cells.of_part(part).scaled(fall), fall: self.fall }
    }
}

impl Indicators {
    fn sum(&self) -> f64 {
        self.local.iter().map(|indicator| indicator.cells.sum()).sum()
    }

    /// What is foreseen on a mesh that is refined from the one they are known on.
    fn on(&self, mesh: &BisectedMesh) -> Self {
        let local: Vec<_> = mesh.origins.iter().map(|part| self.local[part.triangle as usize].of_part(part)).collect();
        let next = Self { local, ..*self };
        let fall = next.sum() / self.sum();
        Self { error: self.error.map(|error| error * if self.is_norm { fall.sqrt() } else { fall }), ..next }
    }

    /// Whether it takes another round, as far as can be told.
    fn is_foreseen_to_be_missed(&self) -> bool {
        self.error.is_some_and(|error| self.trust * error > SURELY)
    }

    /// The fewest triangles that hold a share of it.
    fn marked(&self, share: f64) -> Vec<u32> {
        marked(share, &self.local.iter().map(|indicator| indicator.cells.sum()).collect::<Vec<_>>())
    }
}

/// A mesh that is to be solved next, with the error of each goal that is foreseen there, by what is asked for.
pub(super) struct NextMesh {
    pub mesh: BisectedMesh,
    pub errors: Vec<Option<f64>>,
}

/// The next mesh, by the indicators of all goals that are missed; what lies across a contact of `pairs` from fine edges follows
/// them. All triangles are refined if these tell nothing. Nothing if it has more unknowns than `most`.
pub(super) fn next_mesh(
    mesh: &BisectedMesh,
    pairs: &[Pair],
    missed: &[Indicators],
    unknowns: impl Fn(&BisectedMesh) -> usize,
    most: Option<usize>,
) -> Option<NextMesh> {
    let first = mesh.as_first();
    let (mut left, mut next): (Vec<Indicators>, Option<BisectedMesh>) = (missed.to_vec(), None);
    let large = (MOST_GROWTH * unknowns(mesh) as f64).max(SMALL);
    let fits = |mesh: &BisectedMesh, round: usize| {
        let count = unknowns(mesh);
        most.is_none_or(|most| count <= most) && (round == 0 || count as f64 <= large)
    };
    for round in 0..ROUNDS {
        if round > 0 && !left.iter().any(Indicators::is_foreseen_to_be_missed) {
            break;
        }
        let now = next.as_ref().unwrap_or(&first);
        let candidates = SHARES.iter().map(|share| {
            let refined = refined(now, pairs, &left, *share, round == 0);
            let left = missed.iter().map(|goal| goal.on(&refined)).collect();
            (refined, left)
        });
        let Some(found) = enough(candidates.filter(|(mesh, _)| fits(mesh, round))) else { break };
        (next, left) = (Some(found.0), found.1);
    }
    next.map(|mesh| NextMesh { mesh, errors: left.iter().map(|goal| goal.error).collect() })
}

/// A mesh refined where the triangles hold a share of what is left of the errors.
fn refined(mesh: &BisectedMesh, pairs: &[Pair], left: &[Indicators], share: f64, is_first: bool) -> BisectedMesh {
    let open = left.iter().filter(|goal| is_first || goal.is_foreseen_to_be_missed());
    let mut chosen: Vec<u32> = open.flat_map(|goal| goal.marked(share)).collect();
    chosen.extend(across(&mesh.mesh, pairs, &chosen));
    chosen.sort_unstable();
    chosen.dedup();
    if chosen.is_empty() {
        chosen = (0..mesh.mesh.triangles.len() as u32).collect();
    }
    mesh.refined(chosen.into_iter())
}

/// The first that is foreseen to be enough, or the last.
fn enough(candidates: impl Iterator<Item = (BisectedMesh, Vec<Indicators>)>) -> Option<(BisectedMesh, Vec<Indicators>)> {
    let mut last = None;
    for (mesh, left) in candidates {
        let is_enough = !left.is_empty() && !left.iter().any(Indicators::is_foreseen_to_be_missed);
        last = Some((mesh, left));
        if is_enough {
            break;
        }
    }
    last
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::element::Order;
    use crate::geometry::Point;
    use crate::mesh::{Level, MacroMesh, samples::two_blocks};
    use crate::system::node_count;

    fn unknowns(mesh: &BisectedMesh) -> usize {
        2 * node_count(&mesh.mesh, Level { intervals: 8, order: Order::P2 }) as usize
    }

    /// All of the error lies in the cells at a point.
    fn at(mesh: &MacroMesh, point: Point, error: f64) -> Indicators {
        let own = |triangle: usize| {
            let mut cells = Cells::default();
            if let Some(place) = mesh.locate(triangle, point) {
                cells.add([1.0 - place.x - place.y, place.x, place.y], 1.0);
            }
            LocalIndicator { cells, fall: 0.25 }
        };
        let local = (0..mesh.triangles.len()).map(own).collect();
        Indicators { local, error: Some(error), trust: 1.0, is_norm: true }
    }

    #[test]
    fn a_mesh_is_refined_again_until_the_error_is_foreseen_to_be_small() {
        let first = BisectedMesh::new(two_blocks());
        let point = Point::new(0.0, 1.0);
        let sizes = [1.5, 3.0].map(|error| {
            let next = next_mesh(&first, &[], &[at(&first.mesh, point, error)], unknowns, None).expect("no limit");
            let near = (0..next.mesh.mesh.triangles.len()).filter(|&k| next.mesh.mesh.locate(k, point).is_some());
            let foreseen = next.errors[0].expect("known");
            // Each quartering of what lies at the point halves the error; what keeps the mesh conforming may halve it further.
            let edges = near.flat_map(|k| next.mesh.mesh.triangles[k].edges);
            (edges.map(|edge| next.mesh.mesh.edge_length(edge)).fold(0.0, f64::max), foreseen / error)
        });
        for ((length, fall), times) in sizes.iter().zip([1, 2]) {
            assert!((0.4f64.powi(times)..=0.55f64.powi(times)).contains(fall), "{times}: {fall}");
            assert!(*length <= 5f64.sqrt() * 0.5f64.powi(times), "{times}: {length}");
        }
    }

    #[test]
    fn limits_hold_and_nothing_known_refines_everywhere() {
        let first = BisectedMesh::new(two_blocks());
        let point = Point::new(0.0, 1.0);
        let all = next_mesh(&first, &[], &[], unknowns, None).expect("no limit");
        assert_eq!(all.mesh.mesh.triangles.len(), 4 * first.mesh.triangles.len());
        let nothing = Indicators { local: vec![LocalIndicator::default(); 6], error: None, trust: 1.0, is_norm: true };
        let once = next_mesh(&first, &[], &[nothing], unknowns, None).expect("no limit");
        assert_eq!(once.mesh.mesh.triangles.len(), all.mesh.mesh.triangles.len());
        assert!(next_mesh(&first, &[], &[at(&first.mesh, point, 9.0)], unknowns, Some(unknowns(&first))).is_none());
        let far = at(&first.mesh, point, 1e9);
        let next = next_mesh(&first, &[], std::slice::from_ref(&far), unknowns, None).expect("no limit");
        let limit = unknowns(&next.mesh) - 1;
        let less = next_mesh(&first, &[], &[far], unknowns, Some(limit)).expect("one round fits");
        assert!(unknowns(&less.mesh) <= limit);
    }

    #[test]
    fn what_came_of_foreseen_errors_counts() {
        let first = BisectedMesh::new(two_blocks());
        let goal = at(&first.mesh, Point::new(0.0, 1.0), 3.0);
        let count = |trust| {
            let goal = Indicators { trust, ..goal.clone() };
            next_mesh(&first, &[], &[goal], unknowns, None).expect("no limit").mesh.mesh.triangles.len()
        };
        assert!(count(0.4) < count(1.0), "half of what was foreseen came before");
    }
}
