//! Rows of `B` on every level, in the nodes' frames: `B_l = B_{l+1} P_{l+1}`, without any matrix product.

use crate::discretisation::{Coupled, Discretisation, Space};
use crate::geometry::Point;
use crate::mesh::{EdgeNode, Lists, MacroMesh};
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

/// Rows of `B` at one level: for each multiplier, node numbers with their two entries; multipliers that `D` couples have the same
/// nodes. Columns of prescribed components are zero. A rank has those that it needs, whole: of groups that couple to a node of its
/// own on this level, and on the finest level of its own multipliers. The others are empty.
#[derive(Clone, Debug, Default)]
pub struct CouplingRows(Lists<(usize, Point)>);

/// An entry of a row at one level: the node, which finds its parents on the next coarser level, with its number.
#[derive(Clone, Copy)]
struct NodeEntry {
    number: usize,
    node: EdgeNode,
    value: Point,
}

/// All rows of one level with their nodes.
#[derive(Default)]
struct NodeRows(Lists<NodeEntry>);

impl NodeRows {
    /// Ends a row with these entries: those of one node are summed, in their order.
    fn push(&mut self, row: &mut Vec<NodeEntry>, space: &Space) {
        row.sort_by_key(|entry| entry.number);
        self.0.push(row.chunk_by(|a, b| a.number == b.number).map(|of_node| {
            let sum = of_node.iter().map(|entry| entry.value).sum();
            NodeEntry { value: space.free_part(of_node[0].number, sum), ..of_node[0] }
        }));
        row.clear();
    }

    /// One level down: each node hands its entries to its parents, by their weights.
    fn restricted(&self, mesh: &MacroMesh, fine: &Space, coarse: &Space) -> Self {
        let (mut rows, mut row) = (Self::default(), Vec::new());
        for of_multiplier in self.0.iter() {
            for entry in of_multiplier {
                let global = fine.to_global(entry.number, entry.value);
                for (node, weight) in entry.node.parents(mesh, fine.numbering.level) {
                    row.push(NodeEntry { number: node.number(mesh, &coarse.numbering), node, value: weight * global });
                }
            }
            rows.push(&mut row, coarse);
        }
        rows
    }

    /// Without nodes, and without the rows of groups that have no node of a rank and no multiplier that `is_own`.
    fn needed(&self, groups: &[Range<usize>], own: &Range<usize>, is_own: impl Fn(usize) -> bool) -> CouplingRows {
        let mut is_needed = vec![false; self.0.count()];
        for group in groups {
            let needed = group.clone().any(|i| is_own(i) || self.0.of(i).iter().any(|entry| own.contains(&entry.number)));
            is_needed[group.clone()].fill(needed);
        }
        let mut rows = CouplingRows::default();
        for (row, is_needed) in self.0.iter().zip(is_needed) {
            let kept = if is_needed { row } else { &[] };
            rows.0.push(kept.iter().map(|entry| (entry.number, entry.value)));
        }
        rows
    }
}

impl CouplingRows {
    /// Rows of every level, coarsest first, as far as a rank needs them; the finest are those of the coupling, the others follow
    /// by the transposed interpolation, each level dropping its own prescribed components. `groups` are the multipliers that `D`
    /// couples, one after the other.
    pub fn of_levels(problem: &Discretisation, groups: &[Range<usize>], rank: usize) -> Vec<Self> {
        let (mesh, spaces, finest) = (&problem.scene.mesh, &problem.spaces, problem.finest());
        let (mut rows, mut row) = (NodeRows::default(), Vec::new());
        let entry = |coupled: &Coupled, value: Point| {
            let number = coupled.node.number(mesh, &finest.numbering);
            NodeEntry { number, node: coupled.node, value }
        };
        let all = &problem.coupling.rows;
        for (group, i) in groups.iter().flat_map(|group| group.clone().map(move |i| (group, i))) {
            row.extend(all[i].iter().map(|coupled| entry(coupled, coupled.value)));
            let others = group.clone().filter(|&j| j != i).flat_map(|j| &all[j]);
            row.extend(others.map(|coupled| entry(coupled, Point::zeros())));
            rows.push(&mut row, finest);
        }
        let mut levels = vec![rows.needed(groups, &finest.own, |i| problem.coupling.owners[i] == rank)];
        for pair in spaces.windows(2).rev() {
            rows = rows.restricted(mesh, &pair[1], &pair[0]);
            levels.push(rows.needed(groups, &pair[0].own, |_| false));
        }
        levels.reverse();
        levels
    }

    /// Entries of one multiplier, by ascending node number.
    pub fn row(&self, multiplier: usize) -> &[(usize, Point)] {
        self.0.of(multiplier)
    }

    /// Entries of one multiplier on the nodes of a rank, each with the place of their first unknown among its own.
    pub fn own_row<'a>(&'a self, multiplier: usize, own: &'a Range<usize>) -> impl Iterator<Item = (usize, Point)> + 'a {
        let entries = self.row(multiplier).iter().filter(|(node, _)| own.contains(node));
        entries.map(|(node, value)| (2 * (node - own.start), *value))
    }

    /// Adds a multiple of one multiplier's row to the displacement entries of a rank.
    pub fn add_row(&self, multiplier: usize, factor: f64, own: &Range<usize>, sums: &mut [f64]) {
        for (at, value) in self.own_row(multiplier, own) {
            sums[at] += factor * value.x;
            sums[at + 1] += factor * value.y;
        }
    }

    /// Nodes coupled to each of the `own` nodes by `BᵀDB`, whatever the active set; `groups` are the multipliers that `D` couples.
    pub fn neighbours(&self, groups: &[Range<usize>], own: &Range<usize>) -> BTreeMap<usize, BTreeSet<usize>> {
        let mut neighbours: BTreeMap<usize, BTreeSet<usize>> = BTreeMap::new();
        for group in groups {
            let nodes: BTreeSet<usize> = group.clone().flat_map(|i| self.row(i).iter().map(|&(node, _)| node)).collect();
            for &node in nodes.range(own.clone()) {
                neighbours.entry(node).or_default().extend(&nodes);
            }
        }
        neighbours
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::{MultiplierSpace, Side};
    use crate::discretisation::samples::{blocks, pair};
    use crate::discretisation::{BoundaryMotion, Contact, Coupling, WithoutContact, spaces};
    use crate::geometry::Point;
    use crate::mesh::{Numbering, Partition};
    use crate::petsc::Session;
    use crate::system::saddle_point::augmentation::Augmentation;
    use std::rc::Rc;

    const RANKS: usize = 6;

    /// Two blocks of three macro edges on the seam, a rank for each macro triangle; multipliers couple to the nodes whose edges
    /// have their middle in their segment.
    fn problem(space: MultiplierSpace, rank: usize) -> Discretisation {
        let mut scene = blocks(pair(space, 20), |_| Point::zeros(), Vec::new());
        let ranks: Vec<i32> = (0..RANKS as i32).collect();
        scene.partition = Rc::new(Partition::new(&scene.mesh, &ranks, RANKS));
        let spaces = spaces(&scene, rank).expect("a small mesh");
        let numbering: &Numbering = &spaces[spaces.len() - 1].numbering;
        let contacts: Vec<Vec<Contact>> =
            (0..RANKS).map(|rank| Contact::all(&scene, numbering, rank).expect("they face each other")).collect();
        let count = contacts[0][0].multipliers.count();
        let mut rows = vec![Vec::new(); count];
        for edge in contacts.iter().flatten().flat_map(|contact| contact.edges.iter().flatten()) {
            let i = ((0.25 * (edge.points[0].x + edge.points[1].x)) * count as f64) as usize;
            let value = Point::new(0.1 + i as f64, edge.points[0].x);
            rows[i].extend(edge.nodes.iter().map(|&node| Coupled { node, body: 0, side: Side::First, value }));
        }
        let owners = (0..count).map(|i| i * RANKS / count).collect();
        let coupling = Coupling { rows, gap: vec![0.0; count], owners, lost: vec![0] };
        let contacts = contacts.into_iter().next().expect("rank 0");
        Discretisation {
            session: Session::of_unit_tests(),
            scene,
            spaces,
            contacts,
            coupling,
            motion: BoundaryMotion::default(),
            mean_forces: Vec::new(),
            without_contact: WithoutContact::default(),
        }
    }

    #[test]
    fn a_rank_has_whole_what_touches_its_nodes_on_any_level_and_little_else() {
        for space in [MultiplierSpace::P0, MultiplierSpace::P1Discontinuous, MultiplierSpace::P1Continuous] {
            // In one group, all rows of a level are on every rank that has a node of contact there, with zeros for the nodes of
            // the others.
            let without_zeros = |row: &[(usize, Point)]| -> Vec<(usize, Point)> {
                row.iter().copied().filter(|(_, value)| *value != Point::zeros()).collect()
            };
            let of_rank = |rank: usize| {
                let problem = problem(space, rank);
                let all = 0..problem.multiplier_count();
                CouplingRows::of_levels(&problem, std::slice::from_ref(&all), rank)
            };
            let mut everything = of_rank(0);
            for rows in (1..RANKS).map(of_rank) {
                let larger = everything.iter_mut().zip(rows).filter(|(all, rows)| all.0.entries().len() < rows.0.entries().len());
                larger.for_each(|(all, rows)| *all = rows);
            }
            assert!(everything.iter().all(|rows| !rows.0.entries().is_empty()));
            let mut kept = 0;
            for rank in 0..RANKS {
                let problem = problem(space, rank);
                let groups = Augmentation::new(&problem.contacts);
                let own = CouplingRows::of_levels(&problem, &groups.members, rank);
                for (l, ((own, all), space)) in own.iter().zip(&everything).zip(&problem.spaces).enumerate() {
                    let is_finest = l + 1 == problem.spaces.len();
                    for i in 0..problem.multiplier_count() {
                        let is_own = is_finest && problem.coupling.owners[i] == rank;
                        let [here, all] = [own.row(i), all.row(i)].map(without_zeros);
                        let needed = is_own || all.iter().any(|(n, _)| space.own.contains(n));
                        assert!(here == all || own.row(i).is_empty() && !needed, "rank {rank}, row {i}");
                    }
                    for group in &groups.members {
                        let nodes = |i: usize| own.row(i).iter().map(|(node, _)| *node).collect::<Vec<_>>();
                        assert!(group.clone().all(|i| nodes(i) == nodes(group.start)), "{group:?}");
                    }
                    assert!(own.neighbours(&groups.members, &space.own).keys().all(|node| space.own.contains(node)));
                }
                let finest = &own[own.len() - 1];
                kept += (0..problem.multiplier_count()).filter(|&i| !finest.row(i).is_empty()).count();
            }
            let rows = problem(space, 0).multiplier_count();
            assert!(2 * kept < RANKS * rows, "{space:?}: {kept} of {RANKS} times {rows} rows");
        }
    }
}
