//! The largest von Mises stress of each part of the bodies: how large it is, where, and whether the exact stress has a bound there.

use super::evaluation::Evaluation;
use super::singular_places::{all_singular_places, without_rounding};
use super::stress::{NodalStress, nodal_stress};
use crate::body::SingularPlace;
use crate::discretisation::{Discretisation, Field, SystemError};
use crate::element::von_mises;
use crate::geometry::Point;
use crate::mesh::{MacroMesh, lattice};
use rustc_hash::{FxHashMap, FxHashSet};

/// Of stresses that differ by a smaller share of the largest the first one in a direction counts, so that rounding does not choose
/// between the two sides of a symmetric body.
const ALIKE: f64 = 1e-4;

/// That direction: along none in which bodies are symmetric.
const FIRST: [f64; 2] = [1.0, 0.37];

/// Edges around a singular place within which a largest stress is that of the place.
const NEAR: f64 = 2.0;

/// Share of the largest stress of a part from which that of a singular place elsewhere will be larger on finer meshes: at a re-entrant
/// corner of 90 degrees after two refinements, at the least power that is looked at after seven.
const SOON: f64 = 0.5;

/// By what the stress at a singular place is larger than two edges away, at least: powers above .14 (a bend by 20 degrees has .1).
const CONCENTRATED: f64 = 1.1;

/// The largest von Mises stress of a part.
#[derive(Clone, Debug, PartialEq)]
pub struct StressPeak {
    /// How large it is (stress).
    pub von_mises: f64,
    /// The node, undeformed.
    pub place: Point,
    /// Its displacement.
    pub displacement: Point,
    /// Why the exact stress has no bound there, if it has none.
    pub unbounded: Option<SingularPlace>,
}

/// The largest von Mises stress at the nodes of each part. **Collective**
///
/// # Errors
/// [`SystemError`] from PETSc or an inverted triangle.
pub fn largest_stresses(problem: &Discretisation, u: &Field<2>) -> Result<Vec<f64>, SystemError> {
    let stress = nodal_stress(problem, u)?;
    let mut largest = vec![0.0_f64; problem.scene.mesh.parts.len()];
    for (_, part, node) in all_nodes(problem) {
        largest[part] = largest[part].max(von_mises(stress.at(part, node)));
    }
    problem.session.max(&mut largest);
    Ok(largest)
}

/// A node of a macro triangle of this rank: the triangle, and its place in the lattice.
type LatticeNode = (usize, (usize, usize));

/// All nodes of this rank's macro triangles, each with its part and its number.
fn all_nodes<'a>(problem: &'a Discretisation) -> impl Iterator<Item = (LatticeNode, usize, usize)> + 'a {
    nodes_of(problem, problem.own_triangles())
}

/// All nodes of some macro triangles.
fn nodes_of<'a>(problem: &'a Discretisation, triangles: &'a [u32]) -> impl Iterator<Item = (LatticeNode, usize, usize)> + 'a {
    let mesh = &problem.scene.mesh;
    let nodes = problem.finest().numbering.nodes_of(mesh, triangles.iter().map(|&triangle| triangle as usize));
    nodes.map(|(triangle, at, node)| ((triangle, at), mesh.triangles[triangle].part as usize, node))
}

impl Evaluation<'_> {
    /// The largest von Mises stress of each part; of each contact it is known whether λ `grows` without bound towards an end, and where
    /// it does so at `joints` of materials. **Collective**
    ///
    /// # Errors
    /// As [`Evaluation::new`].
    pub fn stress_peaks(&self, grows: &[bool], joints: &[Vec<Point>]) -> Result<Vec<StressPeak>, SystemError> {
        let (problem, mesh, stress) = (self.problem, &self.problem.scene.mesh, self.stress()?);
        let (level, singular) = (problem.finest().numbering.level, all_singular_places(self, grows, joints));
        let corners = corners_at(mesh, &singular);
        let concentrated = self.concentrated_stresses(singular.len(), &corners, stress);
        let part_of = |triangle: u32| mesh.triangles[triangle as usize].part;
        let touching: FxHashSet<(usize, u32)> = corners.iter().map(|&(at, triangle, _)| (at, part_of(triangle))).collect();
        // Macro triangles where the stress is as large as before them, or nearly: among them are those of the largest one.
        let mut largest = vec![0.0_f64; mesh.parts.len()];
        let mut candidates: Vec<u32> = Vec::new();
        for ((triangle, _), part, node) in all_nodes(problem) {
            let stress = von_mises(stress.at(part, node));
            if stress >= (1.0 - ALIKE) * largest[part] {
                largest[part] = largest[part].max(stress);
                if candidates.last() != Some(&(triangle as u32)) {
                    candidates.push(triangle as u32);
                }
            }
        }
        self.session.max(&mut largest);
        // How far the node lies in the direction, its number, its place and its displacement.
        let mut own = vec![[f64::INFINITY; 6]; largest.len()];
        for ((triangle, at), part, node) in nodes_of(problem, &candidates) {
            if von_mises(stress.at(part, node)) < (1.0 - ALIKE) * largest[part] {
                continue;
            }
            let (x, [ux, uy]) = (mesh.node_position(triangle, level, at), self.u.at(node));
            let along = FIRST[0] * x.x + FIRST[1] * x.y;
            if along < own[part][0] {
                own[part] = [along, node as f64, x.x, x.y, ux, uy];
            }
        }
        let mut firsts = vec![[f64::INFINITY; 6]; largest.len()];
        for (at, found) in self.session.gather_all(own.as_flattened()).as_chunks::<6>().0.iter().enumerate() {
            let first = &mut firsts[at % largest.len()];
            *first = if found[0] < first[0] { *found } else { *first };
        }
        let nodes: Vec<usize> = firsts.iter().map(|first| first[1] as usize).collect();
        let edges = edges_at(problem, &nodes, &candidates);
        let size = mesh.vertices.iter().map(|x| x.amax()).fold(0.0, f64::max);
        let peak = |(part, [_, _, x, y, ux, uy]): (usize, [f64; 6])| {
            let (place, displacement) = (without_rounding(Point::new(x, y), size), Point::new(ux, uy));
            let away =
                |other: &SingularPlace| (if other.is_deformed { place + displacement } else { place } - other.place).norm();
            let is_near =
                |other: &&SingularPlace| other.body == mesh.parts[part].body as usize && away(other) <= NEAR * edges[part];
            let near = singular.iter().filter(is_near).min_by(|a, b| away(a).total_cmp(&away(b)));
            let is_soon_larger = |at: &usize| concentrated[*at] > SOON * largest[part] && touching.contains(&(*at, part as u32));
            let elsewhere = (0..singular.len()).filter(is_soon_larger);
            let elsewhere = elsewhere.max_by(|a, b| concentrated[*a].total_cmp(&concentrated[*b])).map(|at| &singular[at]);
            let unbounded = near.or(elsewhere).cloned();
            StressPeak { von_mises: largest[part], place, displacement, unbounded }
        };
        Ok(firsts.into_iter().enumerate().map(peak).collect())
    }

    /// The von Mises stress at each of some places that have these corners, if it falls away from there; zero elsewhere. **Collective**
    fn concentrated_stresses(&self, places: usize, corners: &[PlacedCorner], stress: &NodalStress) -> Vec<f64> {
        let (mesh, numbering) = (&self.problem.scene.mesh, &self.problem.finest().numbering);
        let n = numbering.level.intervals;
        let away = (2 * numbering.level.order.degree()).min(n);
        // The stress there, and the largest one two edges away.
        let mut found = vec![[0.0_f64; 2]; places];
        let is_own = |triangle: u32| self.problem.scene.partition.owner(triangle) == self.session.rank();
        for &(at, triangle, corner) in corners.iter().filter(|(_, triangle, _)| is_own(*triangle)) {
            let (part, numbers) = (mesh.triangles[triangle as usize].part, numbering.triangle(mesh, triangle as usize));
            let node = |(i, j)| von_mises(stress.at(part as usize, numbers.node(i, j)));
            let there = node(lattice::side_node(n, corner, 0));
            let [ahead, back] = [(corner, away), ((corner + 2) % 3, n - away)].map(|(side, at)| lattice::side_node(n, side, at));
            found[at] = [found[at][0].max(there), found[at][1].max(node(ahead)).max(node(back))];
        }
        self.session.max(found.as_flattened_mut());
        found.into_iter().map(|[there, beside]| if there > CONCENTRATED * beside { there } else { 0.0 }).collect()
    }
}

/// A place that is a vertex, and a macro triangle with a corner there: which one.
type PlacedCorner = (usize, u32, usize);

/// All corners at places that are vertices.
fn corners_at(mesh: &MacroMesh, places: &[SingularPlace]) -> Vec<PlacedCorner> {
    let mut at_vertex: FxHashMap<u32, Vec<usize>> = FxHashMap::default();
    let vertices = places.iter().enumerate().filter_map(|(at, place)| Some((place.vertex?, at)));
    vertices.for_each(|(vertex, at)| at_vertex.entry(vertex).or_default().push(at));
    let corners = (0..).zip(&mesh.triangles).flat_map(|(triangle, own)| (0..).zip(own.vertices).map(move |of| (triangle, of)));
    let own = corners.filter_map(|(triangle, (corner, vertex))| Some((at_vertex.get(&vertex)?, triangle, corner)));
    own.flat_map(|(own, triangle, corner)| own.iter().map(move |&at| (at, triangle, corner))).collect()
}

/// The longest edge of a triangle at a node of each part (length); `triangles` have all that lie there on this rank. **Collective**
fn edges_at(problem: &Discretisation, nodes: &[usize], triangles: &[u32]) -> Vec<f64> {
    let (mesh, level) = (&problem.scene.mesh, problem.finest().numbering.level);
    let step = level.order.degree();
    let mut longest = vec![0.0_f64; nodes.len()];
    for ((triangle, (i, j)), part, _) in nodes_of(problem, triangles).filter(|(_, part, node)| nodes[*part] == *node) {
        let here = mesh.node_position(triangle, level, (i, j));
        let beside = [(i + step, j), (i, j + step)].into_iter().chain(i.checked_sub(step).map(|i| (i, j)));
        let beside = beside.chain(j.checked_sub(step).map(|j| (i, j)));
        for at in beside.filter(|(i, j)| i + j <= level.intervals) {
            longest[part] = longest[part].max((mesh.node_position(triangle, level, at) - here).norm());
        }
    }
    problem.session.max(&mut longest);
    longest
}
