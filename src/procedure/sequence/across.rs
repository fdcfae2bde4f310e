//! Macro triangles across a contact from marked ones.
//!
//! A body that lies on the long edges of another follows their kinks: its error, however large, is made by them, and does not
//! fall while it alone is refined.

use crate::contact::Pair;
use crate::geometry::Point;
use crate::mesh::MacroMesh;

/// An edge may be so many times as long as a marked one that it faces.
const UNLIKE: f64 = 4.0;

/// Distances that differ by less than this share of an edge are taken for equal.
const EQUAL: f64 = 1e-6;

/// Triangles whose edges on a contact are much longer than those of marked triangles that they face. Each may occur repeatedly.
pub(crate) fn across(mesh: &MacroMesh, pairs: &[Pair], marked: &[u32]) -> Vec<u32> {
    let mut is_marked = vec![false; mesh.triangles.len()];
    marked.iter().for_each(|&triangle| is_marked[triangle as usize] = true);
    let edges = |name: &String| mesh.edges_of(name);
    let triangle = |edge: u32| mesh.edges[edge as usize].triangles[0];
    let mut all = Vec::new();
    for pair in pairs {
        let [one, other] = pair.between.each_ref().map(edges);
        for (own, facing) in [(one, other), (other, one)] {
            let near = own.iter().filter(|&&edge| triangle(edge).is_some_and(|triangle| is_marked[triangle as usize]));
            all.extend(near.flat_map(|&edge| longer(mesh, edge, facing)).filter_map(triangle));
        }
    }
    all
}

/// The edges that face an edge and are much longer: the nearest to its middle, if that is no farther than they are long.
fn longer(mesh: &MacroMesh, edge: u32, facing: &[u32]) -> Vec<u32> {
    let (length, middle) = (mesh.edge_length(edge), mesh.edge_position(edge, 0.5));
    let apart: Vec<f64> = facing.iter().map(|&other| distance(mesh, middle, other)).collect();
    let nearest = apart.iter().copied().fold(f64::INFINITY, f64::min);
    let faces = facing.iter().zip(apart).filter(|(_, apart)| *apart <= nearest + EQUAL * length);
    let is_longer = |&other: &u32| mesh.edge_length(other) > (UNLIKE * length).max(nearest);
    faces.map(|(&other, _)| other).filter(is_longer).collect()
}

/// Distance of a point from the chord of an edge.
pub(crate) fn distance(mesh: &MacroMesh, x: Point, edge: u32) -> f64 {
    (mesh.foot_on_chord(edge, x) - x).norm()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::samples::seam;
    use crate::mesh::samples::two_blocks;
    use crate::mesh::{BisectedMesh, each_once};

    /// The blocks, the upper one refined at (1, 1.1) until its edges on the line there are so long at most.
    fn refined_above(longest: f64) -> (MacroMesh, u32) {
        let (mut bisected, place) = (BisectedMesh::new(two_blocks()), Point::new(1.0, 1.0));
        loop {
            let mesh = &bisected.mesh;
            let upper = &mesh.boundary("upper.seam").expect("named").edges;
            let near = upper.iter().copied().find(|&edge| distance(mesh, place, edge) < 1e-12).expect("an edge there");
            let triangle = mesh.edges[near as usize].triangles[0].expect("beside it");
            if mesh.edge_length(near) <= longest {
                return (mesh.clone(), triangle);
            }
            bisected = bisected.refined([triangle].into_iter());
        }
    }

    #[test]
    fn long_edges_across_from_short_ones_are_found_and_no_others() {
        let pairs = [seam()];
        let (mesh, marked) = refined_above(0.3);
        let beside = |name: &str| mesh.edges[mesh.boundary(name).expect("named").edges[0] as usize].triangles[0];
        assert_eq!(across(&mesh, &pairs, &[marked]), [beside("lower.seam").expect("a triangle")]);
        assert!(across(&mesh, &[], &[marked]).is_empty() && across(&mesh, &pairs, &[]).is_empty());
        let (mesh, marked) = refined_above(0.6);
        assert!(across(&mesh, &pairs, &[marked]).is_empty(), "not so much longer");
        assert!(across(&mesh, &pairs, &[beside("lower.seam").expect("a triangle")]).is_empty(), "shorter");
    }

    #[test]
    fn what_is_farther_than_it_is_long_does_not_face() {
        let (mut mesh, marked) = refined_above(0.3);
        let moved = each_once(mesh.triangles.iter().filter(|t| t.body == 0).flat_map(|t| t.vertices));
        moved.iter().for_each(|&vertex| mesh.vertices[vertex as usize].y -= 2.5);
        assert!(across(&mesh, &[seam()], &[marked]).is_empty());
    }
}
