//! The next mesh of a sequence: refined where the errors lie, and at once again where it can be foreseen that too much is left.
//!
//! Differences are known on cells, sixty-four in each macro triangle, so that the parts of a refined triangle have indicators
//! before anything is solved on them: what lies in their cells, less by what the last refinement has brought there.

use crate::contact::Pair;
use crate::mesh::{BisectedMesh, Cells, MacroMesh, Origin, each_once};
use crate::procedure::sequence::across::across;
use crate::procedure::sequence::marking::marked;

/// How far the next mesh may go at once.
#[derive(Clone, Copy)]
pub(crate) struct Reach {
    /// Rounds of refinement before the next solve, at most.
    rounds: usize,
    /// Unknowns of the next mesh by those of the present one, at most, where it is refined more than once.
    most_growth: f64,
}

/// Parts of a third round are single cells.
const NEAR: Reach = Reach { rounds: 3, most_growth: 4.0 };

/// Where the energy alone is missed, with one refinement below each mesh. It saves `packing/case`, `discs_3` and `discs_14` the
/// third mesh, and the latter two a third of their time. With two refinements, errors fall faster than it is foreseen from the
/// first meshes: `hertz` to 1e-2 of its energy would have 48 000 unknowns where 25 000 do. Pressures need less: `bending` would
/// have 99 000 where 54 000 do.
const FAR: Reach = Reach { rounds: 4, most_growth: 6.0 };

/// Shares of the sum of all indicators that the marked triangles hold at least, tried one after the other until the errors are
/// foreseen to be small enough (the last one: Dörfler, SIAM J. Numer. Anal. 33, 1996).
const SHARES: [f64; 3] = [0.2, 0.4, 0.6];

/// Unknowns of the next mesh by those of the present one, at least, where an error is not known.
const LEAST_GROWTH: f64 = 1.5;

/// Unknowns that a mesh may always have.
const SMALL: f64 = 4000.0;

/// Largest power of the fall of the indicators that errors are taken to go with.
const MOST_PACE: f64 = 1.8;

/// The smallest: where an error has not fallen as foreseen the next mesh goes farther at once. With one at least, a stress at a point
/// beside a wedge took 20 meshes, each by 1 to 3 % larger, and 9 s, instead of 3 meshes and 1.2 s.
const LEAST_PACE: f64 = 0.25;

/// Macro triangles smaller than this share of the scene are not refined: rounding of their corners would turn them round. Only
/// where a force acts at a point does an error go on to ask for it.
const SMALLEST: f64 = 1e-10;

/// Share of what is asked for at which an error that is only foreseen counts as reached.
const SURELY: f64 = 0.8;

/// Share of an error that is left on the next mesh, at most: what one difference leaves is told by how it falls from mesh to mesh, and
/// next to nothing of it that has gone tells nothing: its square must fall below .7 (`energy_norm::LEAST_GONE`), the error below .84.
const LEAST_FALL: f64 = 0.75;

/// What a macro triangle counts for a goal.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct LocalIndicator {
    /// Where in it.
    pub cells: Cells,
    /// Factor by which that falls if it is quartered.
    pub fall: f64,
}

/// What all macro triangles count for a goal that is missed.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Indicators {
    /// For each of them.
    pub local: Vec<LocalIndicator>,
    /// Estimated error by what is asked for; nothing if it is not known.
    pub error: Option<f64>,
    /// The power of the fall of the indicators that errors go with, as this mesh has shown of what was foreseen on the one before;
    /// one, if there is none.
    pub pace: f64,
    /// Whether the error goes with the root of the sum of the indicators.
    pub is_norm: bool,
}

impl LocalIndicator {
    /// The same for a part of the triangle: halving it brings the root of what quartering does.
    fn of_part(&self, part: &Origin) -> Self {
        if part.is_whole() {
            return *self;
        }
        let fall = self.fall.powf(-0.5 * part.area().log2());
        Self { cells: self.cells.of_part(part).scaled(fall), fall: self.fall }
    }
}

impl Reach {
    /// With so many refinements below each mesh, and goals of which the energy may be the only one.
    pub fn of(refine: usize, is_energy_alone: bool) -> Self {
        if is_energy_alone && refine < 2 { FAR } else { NEAR }
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
        Self { error: self.error.map(|error| error * self.fall(&next).powf(self.pace)), ..next }
    }

    /// Factor by which the error falls with the indicators, at a pace of one.
    fn fall(&self, next: &Self) -> f64 {
        let fall = next.sum() / self.sum();
        if self.is_norm { fall.sqrt() } else { fall }
    }

    /// Whether it takes another round, as far as can be told; `grown` is by how much the mesh has.
    fn is_foreseen_to_be_missed(&self, first: &Self, grown: f64) -> bool {
        let most = |error: f64| SURELY.min(LEAST_FALL * error);
        self.error.map_or(grown < LEAST_GROWTH, |error| error > first.error.map_or(SURELY, most))
    }

    /// The fewest triangles that hold a share of it, without those that are too small.
    fn marked(&self, share: f64, too_small: &[bool]) -> Vec<u32> {
        let count = |(indicator, &is_out): (&LocalIndicator, &bool)| if is_out { 0.0 } else { indicator.cells.sum() };
        marked(share, &self.local.iter().zip(too_small).map(count).collect::<Vec<_>>())
    }
}

/// A mesh that is to be solved next.
pub(crate) struct NextMesh {
    pub mesh: BisectedMesh,
    /// For each goal, its error on the mesh before and the factor by which it falls at a pace of one.
    pub foreseen: Vec<Option<Foreseen>>,
}

/// An error by what is asked for, and the factor by which it was foreseen to fall at a pace of one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Foreseen {
    error: f64,
    fall: f64,
}

impl Foreseen {
    /// The pace at which the error has fallen to what it is `now`.
    pub fn pace(self, now: f64) -> f64 {
        let pace = (now / self.error).ln() / self.fall.ln();
        if pace.is_finite() { pace.clamp(LEAST_PACE, MOST_PACE) } else { 1.0 }
    }
}

/// The next mesh, by the indicators of all goals that are missed; what lies across a contact of `pairs` from fine edges follows
/// them. All triangles are refined if these tell nothing. Nothing if it has more unknowns than `most`.
pub(crate) fn next_mesh(
    mesh: &BisectedMesh,
    pairs: &[Pair],
    (missed, reach): (&[Indicators], Reach),
    unknowns: impl Fn(&BisectedMesh) -> usize,
    most: Option<usize>,
) -> Option<NextMesh> {
    let first = mesh.as_first();
    let (mut left, mut next): (Vec<Indicators>, Option<BisectedMesh>) = (missed.to_vec(), None);
    let size = unknowns(mesh) as f64;
    let grown = |mesh: &BisectedMesh| unknowns(mesh) as f64 / size;
    let fits = |mesh: &BisectedMesh, round: usize| {
        let count = unknowns(mesh);
        most.is_none_or(|most| count <= most) && (round == 0 || count as f64 <= (reach.most_growth * size).max(SMALL))
    };
    for round in 0..reach.rounds {
        let now = next.as_ref().unwrap_or(&first);
        let is_missed =
            |(goal, first): (&Indicators, &Indicators), mesh: &BisectedMesh| goal.is_foreseen_to_be_missed(first, grown(mesh));
        let open = left.iter().zip(missed).filter(|pair| round == 0 || is_missed(*pair, now));
        let open: Vec<&Indicators> = open.map(|(goal, _)| goal).collect();
        if round > 0 && open.is_empty() {
            break;
        }
        let candidates = SHARES.iter().map(|share| {
            let refined = refined(now, pairs, &open, *share);
            let left: Vec<Indicators> = missed.iter().map(|goal| goal.on(&refined)).collect();
            (refined, left)
        });
        let is_enough = |(mesh, left): &(BisectedMesh, Vec<Indicators>)| {
            !left.is_empty() && !left.iter().zip(missed).any(|pair| is_missed(pair, mesh))
        };
        let Some(found) = first_or_last(candidates.filter(|(mesh, _)| fits(mesh, round)), is_enough) else { break };
        (next, left) = (Some(found.0), found.1);
    }
    let foreseen = |(goal, left): (&Indicators, &Indicators)| Some(Foreseen { error: goal.error?, fall: goal.fall(left) });
    next.map(|mesh| NextMesh { mesh, foreseen: missed.iter().zip(&left).map(foreseen).collect() })
}

/// A mesh refined where the triangles hold a share of what is left of the errors.
fn refined(mesh: &BisectedMesh, pairs: &[Pair], open: &[&Indicators], share: f64) -> BisectedMesh {
    let too_small = too_small(&mesh.mesh);
    let mut chosen: Vec<u32> = open.iter().flat_map(|goal| goal.marked(share, &too_small)).collect();
    chosen.extend(across(&mesh.mesh, pairs, &chosen));
    chosen = each_once(chosen);
    if chosen.is_empty() {
        chosen = (0..mesh.mesh.triangles.len() as u32).collect();
    }
    mesh.refined(chosen.into_iter())
}

/// Which macro triangles are too small to be refined.
fn too_small(mesh: &MacroMesh) -> Vec<bool> {
    let size = mesh.bounds().iter().map(|[low, high]| (high - low).norm()).fold(0.0, f64::max);
    let longest = |edges: [u32; 3]| edges.map(|edge| mesh.edge_length(edge)).into_iter().fold(0.0, f64::max);
    mesh.triangles.iter().map(|triangle| longest(triangle.edges) < SMALLEST * size).collect()
}

/// The first candidate that is enough, or the last.
fn first_or_last<T>(candidates: impl Iterator<Item = T>, is_enough: impl Fn(&T) -> bool) -> Option<T> {
    let mut last = None;
    for candidate in candidates {
        let ends = is_enough(&candidate);
        last = Some(candidate);
        if ends {
            break;
        }
    }
    last
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discretisation::node_count;
    use crate::element::Order;
    use crate::geometry::Point;
    use crate::mesh::{
        Level,
        samples::{columns, two_blocks},
    };

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
        Indicators { local, error: Some(error), pace: 1.0, is_norm: true }
    }

    #[test]
    fn a_mesh_is_refined_again_until_the_error_is_foreseen_to_be_small() {
        let first = BisectedMesh::new(two_blocks());
        let point = Point::new(0.0, 1.0);
        let sizes = [1.5, 3.0].map(|error| {
            let next = next_mesh(&first, &[], (&[at(&first.mesh, point, error)], NEAR), unknowns, None).expect("no limit");
            let near = (0..next.mesh.mesh.triangles.len()).filter(|&k| next.mesh.mesh.locate(k, point).is_some());
            let foreseen = next.foreseen[0].expect("known");
            // Each quartering of what lies at the point halves the error; what keeps the mesh conforming may halve it further.
            let edges = near.flat_map(|k| next.mesh.mesh.triangles[k].edges);
            (edges.map(|edge| next.mesh.mesh.edge_length(edge)).fold(0.0, f64::max), foreseen.fall)
        });
        for ((length, fall), times) in sizes.iter().zip([1, 2]) {
            assert!((0.4f64.powi(times)..=0.55f64.powi(times)).contains(fall), "{times}: {fall}");
            assert!(*length <= 5f64.sqrt() * 0.5f64.powi(times), "{times}: {length}");
        }
    }

    /// What is foreseen to be small already, and is not known to be: a mesh that is next to the same would tell no more.
    #[test]
    fn the_next_mesh_is_finer_enough_to_tell_something() {
        let first = BisectedMesh::new(columns(40, 1.0));
        let everywhere = (0..first.mesh.triangles.len()).map(|k| {
            let cells = Cells::new(|_| (1.0 + 0.01 * k as f64) / Cells::COUNT as f64);
            LocalIndicator { cells, fall: 0.25 }
        });
        let goal = Indicators { local: everywhere.collect(), error: Some(0.79), pace: 1.0, is_norm: true };
        let next = next_mesh(&first, &[], (&[goal], NEAR), unknowns, None).expect("no limit");
        let fall = next.foreseen[0].expect("known").fall;
        assert!(fall <= 0.75, "{fall}, .91 if the fewest triangles do");
    }

    #[test]
    fn limits_hold_and_nothing_known_refines_everywhere() {
        let first = BisectedMesh::new(two_blocks());
        let point = Point::new(0.0, 1.0);
        let all = next_mesh(&first, &[], (&[], NEAR), unknowns, None).expect("no limit");
        assert_eq!(all.mesh.mesh.triangles.len(), 4 * first.mesh.triangles.len());
        let nothing = Indicators { local: vec![LocalIndicator::default(); 6], error: None, pace: 1.0, is_norm: true };
        let once = next_mesh(&first, &[], (&[nothing], NEAR), unknowns, None).expect("no limit");
        assert_eq!(once.mesh.mesh.triangles.len(), all.mesh.mesh.triangles.len());
        assert!(next_mesh(&first, &[], (&[at(&first.mesh, point, 9.0)], NEAR), unknowns, Some(unknowns(&first))).is_none());
        let far = at(&first.mesh, point, 1e9);
        let next = next_mesh(&first, &[], (std::slice::from_ref(&far), NEAR), unknowns, None).expect("no limit");
        let limit = unknowns(&next.mesh) - 1;
        let less = next_mesh(&first, &[], (&[far], NEAR), unknowns, Some(limit)).expect("one round fits");
        assert!(unknowns(&less.mesh) <= limit);
    }

    #[test]
    fn what_is_as_small_as_rounding_is_left_alone() {
        let mut mesh = BisectedMesh::new(two_blocks());
        let point = Point::new(0.0, 1.0);
        for _ in 0..60 {
            let goal = at(&mesh.mesh, point, 1e9);
            mesh = refined(&mesh, &[], &[&goal], 0.6);
            if too_small(&mesh.mesh).contains(&true) {
                break;
            }
        }
        let goal = at(&mesh.mesh, point, 1e9);
        let least = |mesh: &BisectedMesh| {
            let edges = 0..mesh.mesh.edges.len() as u32;
            edges.map(|edge| mesh.mesh.edge_length(edge)).fold(f64::INFINITY, f64::min)
        };
        assert!(goal.marked(0.6, &too_small(&mesh.mesh)).len() < goal.marked(0.6, &vec![false; mesh.mesh.triangles.len()]).len());
        assert!(least(&mesh) > 1e-12, "{}", least(&mesh));
    }

    #[test]
    fn meshes_go_farther_for_the_energy_with_one_refinement_below_them() {
        let first = BisectedMesh::new(two_blocks());
        let goal = at(&first.mesh, Point::new(0.0, 1.0), 64.0);
        // So few that no limit holds.
        let count = |mesh: &BisectedMesh| mesh.mesh.triangles.len();
        let falls = [(1, true), (2, true), (1, false)].map(|(refine, is_energy_alone)| {
            let next = next_mesh(&first, &[], (std::slice::from_ref(&goal), Reach::of(refine, is_energy_alone)), count, None);
            next.expect("no limit").foreseen[0].expect("known").fall
        });
        assert!(falls[0] < 0.8 * falls[1] && falls[1] == falls[2], "one round more at the point: {falls:?}");
    }

    #[test]
    fn what_came_of_foreseen_errors_counts() {
        let first = BisectedMesh::new(two_blocks());
        let goal = at(&first.mesh, Point::new(0.0, 1.0), 3.0);
        let count = |pace| {
            let goal = Indicators { pace, ..goal.clone() };
            next_mesh(&first, &[], (&[goal], NEAR), unknowns, None).expect("no limit").mesh.mesh.triangles.len()
        };
        assert!(count(1.8) < count(1.0) && count(1.0) < count(LEAST_PACE), "errors fell faster before, or more slowly");
        let foreseen = Foreseen { error: 8.0, fall: 0.5 };
        assert!([0.4, 1.0, 1.5].iter().all(|&pace| (foreseen.pace(8.0 * 0.5f64.powf(pace)) - pace).abs() < 1e-12));
        assert_eq!((foreseen.pace(7.9), foreseen.pace(1e-3)), (LEAST_PACE, MOST_PACE));
        assert_eq!(Foreseen { error: 8.0, fall: 1.0 }.pace(4.0), 1.0, "nothing was foreseen to fall");
    }
}
