//! Fields of the bodies in files: one piece per rank, and the facets of the figure.

use crate::element::{Order, von_mises};
use crate::mesh::lattice::{self, Triangle};
use crate::output::RunError;
use crate::output::plot::{ContactZoom, DrawnEdge, Facet};
use crate::output::vtk::{Piece, PieceNode, write_parallel, write_piece};
use crate::petsc::Session;
use crate::recovery::Evaluation;
use std::collections::HashMap;
use std::path::Path;

/// The file that holds the pieces of several ranks together.
const OF_ALL: &str = "fields.pvtu";

/// Facets of the figure at most, as far as triangles of the mesh file may be shown whole; of more of these than the second some
/// are left out, and their places are empty.
const MOST_FACETS: usize = 20_000;
const MOST_TRIANGLES: usize = 100_000;

/// On a lattice of every so many-th node, or more, the facets of a macro triangle may all lie beside a zoom that shows a part of it.
const COARSE: usize = 4;

/// Writes `fields.vtu` on one rank, `fields.pvtu` and its pieces on several; every rank its own. `stress` is that of a part at a
/// node.
pub fn write(folder: &Path, found: &Evaluation, stress: impl Fn(usize, usize) -> [f64; 4]) -> Result<(), RunError> {
    let session = found.session;
    write_piece(&folder.join(piece_name(session, session.rank())), &piece(found, stress))?;
    if session.size() > 1 && session.rank() == 0 {
        let pieces: Vec<String> = (0..session.size()).map(|rank| piece_name(session, rank)).collect();
        write_parallel(&folder.join(OF_ALL), &pieces, found.problem.scene.is_heated())?;
    }
    Ok(())
}

/// Removes what there is of the fields; every rank its own.
pub fn remove(folder: &Path, session: &Session) {
    let own = [Some(piece_name(session, session.rank())), (session.rank() == 0).then(|| OF_ALL.into())];
    own.iter().flatten().for_each(|name| _ = std::fs::remove_file(folder.join(name)));
}

/// The file of the piece of a rank.
fn piece_name(session: &Session, rank: usize) -> String {
    if session.size() == 1 { "fields.vtu".to_string() } else { format!("fields_{rank:04}.vtu") }
}

/// The piece of this rank: its macro triangles. A node between two parts is there twice, for its stress has two values.
fn piece(Evaluation { problem, session, u, .. }: &Evaluation, stress: impl Fn(usize, usize) -> [f64; 4]) -> Piece {
    let (scene, numbering) = (&problem.scene, &problem.finest().numbering);
    let (mesh, n, order) = (&scene.mesh, numbering.level.intervals, numbering.level.order);
    let (nodes, cells, parts) = (Vec::new(), Vec::new(), Vec::new());
    let mut piece = Piece { order, nodes, cells, parts, is_heated: scene.is_heated(), rank: session.rank() as i32 };
    let mut known: HashMap<[usize; 2], u32> = HashMap::new();
    for &triangle in scene.partition.triangles_of(session.rank()) {
        let numbers = numbering.triangle(mesh, triangle as usize);
        let [body, part] = [mesh.triangles[triangle as usize].body, mesh.triangles[triangle as usize].part];
        let heat = scene.heat(part as usize);
        let mut local = Vec::with_capacity(lattice::node_count(n));
        for (i, j) in lattice::nodes(n) {
            let node = [part as usize, numbers.node(i, j)];
            let next = piece.nodes.len() as u32;
            let inside = matches!(lattice::place(n, i, j), lattice::Place::Inside(_));
            let at = if inside { next } else { *known.entry(node).or_insert(next) };
            if at == next {
                let x = mesh.node_position(triangle as usize, numbering.level, (i, j));
                let (place, stress) = ([x.x, x.y], stress(node[0], node[1]));
                let temperature = heat.map_or(0.0, |heat| heat.temperature.value(&place));
                let (displacement, von_mises) = (u.at(node[1]), von_mises(stress));
                piece.nodes.push(PieceNode { place, displacement, stress, von_mises, temperature });
            }
            local.push(at);
        }
        for small in lattice::triangles(n, order) {
            match order {
                Order::P1 => piece.cells.extend(small.nodes::<3>().map(|(i, j)| local[lattice::index(n, i, j)])),
                Order::P2 => piece.cells.extend(small.nodes::<6>().map(|(i, j)| local[lattice::index(n, i, j)])),
            }
            piece.parts.push([body, part].map(|number| number as i32));
        }
    }
    piece
}

/// Facets for the figure of the deformed bodies, coarse enough to draw, from all ranks. **Collective**
pub fn facets(found: &Evaluation, stress: impl Fn(usize, usize) -> [f64; 4]) -> Vec<Facet> {
    let count = found.problem.scene.mesh.triangles.len();
    let n = found.problem.finest().numbering.level.intervals;
    let (shown, skip) = shown(count, n);
    let own = found.problem.scene.partition.triangles_of(found.session.rank()).iter().copied();
    let drawn: Vec<u32> = own.filter(|&triangle| (triangle as usize).is_multiple_of(skip)).collect();
    gather_facets(found, stress, &drawn, n / shown, |_| true)
}

/// The facets that a zoom shows, as fine as the mesh where there are not too many, from all ranks. **Collective**
pub fn facets_of_zoom(found: &Evaluation, stress: impl Fn(usize, usize) -> [f64; 4], zoom: &ContactZoom) -> Vec<Facet> {
    let Evaluation { problem, session, .. } = found;
    let own = problem.scene.partition.triangles_of(session.rank());
    let mut step = problem.finest().numbering.level.intervals;
    let mut drawn: Vec<u32> = own.iter().copied().filter(|&triangle| may_show(found, zoom, triangle)).collect();
    loop {
        let is_shown = |corners: &[DrawnNode; 3]| zoom.shows(&corners.each_ref().map(DrawnNode::moved));
        let counts: Vec<usize> = drawn.iter().map(|&triangle| corners(found, triangle, step).filter(is_shown).count()).collect();
        let [count] = session.sum([counts.iter().sum::<usize>() as f64]);
        if step == 1 || 4.0 * count > MOST_FACETS as f64 {
            return gather_facets(found, stress, &drawn, step, |corners| zoom.shows(corners));
        }
        // On a coarse lattice a bulge may be missed.
        let mut counts = counts.iter();
        drawn.retain(|_| counts.next().is_some_and(|&count| count > 0) || step > COARSE);
        step /= 2;
    }
}

/// A node of a macro triangle as figures show it.
struct DrawnNode {
    number: usize,
    place: [f64; 2],
    displacement: [f64; 2],
}

impl DrawnNode {
    fn moved(&self) -> [f64; 2] {
        [0, 1].map(|axis| self.place[axis] + self.displacement[axis])
    }
}

/// The nodes of a macro triangle, by their places in its lattice.
fn nodes<'a>(found: &'a Evaluation, triangle: u32) -> impl Fn((usize, usize)) -> DrawnNode + 'a {
    let (mesh, numbering) = (&found.problem.scene.mesh, &found.problem.finest().numbering);
    let numbers = numbering.triangle(mesh, triangle as usize);
    move |(i, j)| {
        let (number, x) = (numbers.node(i, j), mesh.node_position(triangle as usize, numbering.level, (i, j)));
        DrawnNode { number, place: [x.x, x.y], displacement: found.u.at(number) }
    }
}

/// Corners of the facets of a macro triangle on a lattice of every `step`-th node.
fn corners(found: &Evaluation, triangle: u32, step: usize) -> impl Iterator<Item = [DrawnNode; 3]> {
    let node = nodes(found, triangle);
    let facets = lattice::triangles(found.problem.finest().numbering.level.intervals / step, Order::P1);
    facets.map(move |small| Triangle::nodes::<3>(&small).map(|(i, j)| node((step * i, step * j))))
}

/// Whether a zoom may show a macro triangle: with the room around it for edges that are bent.
fn may_show(found: &Evaluation, zoom: &ContactZoom, triangle: u32) -> bool {
    let (n, node) = (found.problem.finest().numbering.level.intervals, nodes(found, triangle));
    let corners = [(0, 0), (n, 0), (0, n)].map(|place| node(place).moved());
    let middle = [0, 1].map(|axis| corners.iter().map(|x| x[axis]).sum::<f64>() / 3.0);
    zoom.shows(&corners.map(|x| [0, 1].map(|axis| middle[axis] + 3.0 * (x[axis] - middle[axis]))))
}

/// Those facets of macro triangles of this rank that are wanted by their deformed corners, of lattices of every `step`-th node,
/// from all ranks. **Collective**
fn gather_facets(
    found: &Evaluation,
    stress: impl Fn(usize, usize) -> [f64; 4],
    triangles: &[u32],
    step: usize,
    wanted: impl Fn(&[[f64; 2]; 3]) -> bool,
) -> Vec<Facet> {
    let mut values: Vec<f64> = Vec::new();
    for &triangle in triangles {
        let part = found.problem.scene.mesh.triangles[triangle as usize].part as usize;
        let shown = corners(found, triangle, step).filter(|corners| wanted(&corners.each_ref().map(DrawnNode::moved)));
        for DrawnNode { number, place, displacement } in shown.flatten() {
            values.extend(place);
            values.extend(displacement);
            values.extend(stress(part, number));
        }
    }
    let facet = |corner: &[[f64; 8]; 3]| Facet {
        corners: corner.map(|v| [v[0], v[1]]),
        displacement: corner.map(|v| [v[2], v[3]]),
        stress: corner.map(|v| [v[4], v[5], v[6], v[7]]),
    };
    found.session.gather_all(&values).as_chunks::<8>().0.as_chunks::<3>().0.iter().map(facet).collect()
}

/// Those macro edges that are wanted for the figure of the deformed bodies, from all ranks; none of a mesh that it shows in part.
/// **Collective**
pub fn macro_edges(found: &Evaluation, wanted: impl Fn(u32) -> bool) -> Vec<DrawnEdge> {
    let Evaluation { problem, session, .. } = found;
    let mesh = &problem.scene.mesh;
    let n = problem.finest().numbering.level.intervals;
    let (shown, skip) = shown(mesh.triangles.len(), n);
    let mut values: Vec<f64> = Vec::new();
    for &triangle in problem.scene.partition.triangles_of(session.rank()).iter().filter(|_| skip == 1) {
        let node = nodes(found, triangle);
        let edges = mesh.triangles[triangle as usize].edges;
        let is_own = |side: usize| mesh.edges[edges[side] as usize].triangles[0] == Some(triangle);
        for side in (0..3).filter(|&side| is_own(side) && wanted(edges[side])) {
            let along = (0..=n).step_by(n / shown).map(|k| node(lattice::side_node(n, side, k)));
            values.extend(along.flat_map(|DrawnNode { place, displacement, .. }| place.into_iter().chain(displacement)));
        }
    }
    let edge = |v: &[f64]| DrawnEdge(v.chunks_exact(4).map(|v| ([v[0], v[1]], [v[2], v[3]])).collect());
    session.gather_all(&values).chunks_exact(4 * (shown + 1)).map(edge).collect()
}

/// Intervals of a macro edge that the figure shows, of `n`, and of how many macro triangles it shows one: a mesh that is fine
/// before refinement is shown in part.
fn shown(macro_triangles: usize, n: usize) -> (usize, usize) {
    let mut shown = n;
    while shown > 1 && macro_triangles * shown * shown > MOST_FACETS {
        shown /= 2;
    }
    (shown, macro_triangles.div_ceil(MOST_TRIANGLES).max(1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_figure_has_as_many_facets_as_it_may() {
        assert_eq!(shown(50, 8), (8, 1), "all of a small mesh");
        for macro_triangles in [1, 50, 83, 5_000, 19_999, 20_000, 20_001, 100_000, 100_001, 1_000_000] {
            for n in [1, 2, 16, 64] {
                let (shown, skip) = shown(macro_triangles, n);
                let facets = |shown: usize, skip: usize| macro_triangles.div_ceil(skip) * shown * shown;
                let words = format!("{macro_triangles} macro triangles, {n} intervals: {shown} shown of every {skip}th");
                let most = if shown == 1 { MOST_TRIANGLES } else { MOST_FACETS };
                assert!(n.is_multiple_of(shown) && facets(shown, skip) <= most, "{words}");
                assert!(shown == n || facets(2 * shown, skip) > MOST_FACETS, "{words}: more would do");
                assert!(skip == 1 || facets(shown, skip - 1) > MOST_TRIANGLES, "{words}: more would do");
            }
        }
    }
}
