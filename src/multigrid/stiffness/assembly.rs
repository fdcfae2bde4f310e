//! Assembly of the stiffness of one level: each rank makes the whole rows of its own nodes, without a word to the others.

mod which_rows;

use super::ContactNeighbours;
use super::couplings::Couplings;
use super::even_triangles::EvenTriangles;
use super::pattern::RowColumns;
use super::stored_rows::{BlockColumn, StoredRows, place};
use super::straight_triangles::StraightTriangles;
use crate::body::{Constraint, MacroStiffness, neighbours, one_stiffness};
use crate::discretisation::{Scene, Space};
use crate::element::{BadJacobian, Block, Order};
use crate::geometry::Point;
use crate::mesh::{Level, TriangleNumbers, lattice};
use crate::multigrid::triangle_lattice::{TriangleNodes, side_nodes};
use std::ops::Range;
use std::rc::Rc;

/// A level to assemble, and what need not be.
pub struct Assembly<'a> {
    scene: &'a Scene,
    space: &'a Space,
    /// Macro triangles with nodes of this rank, ascending: every sum is made in this order, whatever the ranks.
    parts: Vec<AssemblyPart>,
    /// Nodes that do not lie inside of whole macro triangles, ascending, counted from this rank's first.
    nodes: Vec<u32>,
    /// Whether the rows of these nodes are stored.
    is_stored: Vec<bool>,
}

/// What a macro triangle has of this rank's nodes.
struct AssemblyPart {
    triangle: usize,
    numbers: TriangleNumbers,
    /// Whether it is this rank's own; of those of others only nodes on the sides are.
    is_own: bool,
    /// Whether all of its inner rows are alike and not stored.
    is_whole: bool,
    /// Whether it is a single triangle of P2 with the couplings of [`StraightTriangles`].
    is_straight: bool,
}

/// The stiffness of a level on this rank.
pub struct Assembled {
    /// Rows that are stored, with zeros at those couplings of contact that are none of the bodies'.
    pub rows: StoredRows,
    /// Columns of other ranks, ascending.
    pub far: Vec<usize>,
    /// Inner nodes of each macro triangle whose inner rows are stored, ascending.
    pub inside: Rc<[Range<usize>]>,
    /// The rows inside of whole macro triangles.
    pub even: Rc<EvenTriangles>,
    /// Those of the other nodes that have no stored ones.
    pub straight: Rc<StraightTriangles>,
}

impl<'a> Assembly<'a> {
    /// With even macro triangles as wholes, or with all rows stored.
    pub fn new(scene: &'a Scene, space: &'a Space, with_whole: bool, rank: usize) -> Self {
        let level = space.numbering.level;
        let partition = &space.numbering.partition;
        let part = |&triangle: &u32| {
            let triangle = triangle as usize;
            let numbers = space.numbering.triangle(&scene.mesh, triangle);
            let is_own = partition.owner(triangle as u32) == rank;
            let is_whole = is_own && with_whole && scene.mesh.is_whole(triangle, level);
            let is_straight = level.is_one_triangle() && level.order == Order::P2 && scene.mesh.repeats(triangle);
            let part = AssemblyPart { triangle, numbers, is_own, is_whole, is_straight };
            (is_own || touches(level.intervals, space, &part.numbers)).then_some(part)
        };
        let mut triangles = [partition.triangles_of(rank), partition.of_others_with_nodes(rank)].concat();
        triangles.sort_unstable();
        let parts = triangles.iter().filter_map(part).collect();
        let mut assembly = Self { scene, space, parts, nodes: Vec::new(), is_stored: Vec::new() };
        assembly.nodes = assembly.stored_nodes();
        assembly.is_stored = if with_whole { assembly.stored_rows() } else { vec![true; assembly.nodes.len()] };
        assembly
    }

    /// Makes the rows of this rank's nodes, with places for the couplings of contact. Rows and columns of prescribed components
    /// are zero but for the diagonal; what their displacement does to free rows of this rank goes to
    /// `lift(node, force in the node's frame)`.
    ///
    /// # Errors
    /// That of a triangle that is turned inside out.
    pub fn assemble(&self, contact: &ContactNeighbours, mut lift: impl FnMut(usize, Point)) -> Result<Assembled, BadJacobian> {
        let laws = self.scene.laws();
        let (mut rows, far) = self.pattern(contact);
        let (mut inside, mut straight) = (Vec::new(), StraightTriangles::new(&laws));
        let (mut couplings, mut triangles) = (Vec::new(), Vec::new());
        for part in &self.parts {
            let (mesh, level) = (&self.scene.mesh, self.space.numbering.level);
            let law = &laws[mesh.triangles[part.triangle].part as usize];
            if level.is_one_triangle() {
                match level.order {
                    Order::P1 => {
                        let k = one_stiffness::<3>(mesh, part.triangle, level, law)?;
                        self.add_triangle::<3>(part, |a, b| Some(k[a][b]), &far, &mut rows, &mut lift);
                    }
                    Order::P2 if part.is_straight => {
                        let k = self.straight(part, &mut straight)?;
                        self.add_triangle::<6>(part, |a, b| k.coupling(a, b), &far, &mut rows, &mut lift);
                    }
                    Order::P2 => {
                        let k = one_stiffness::<6>(mesh, part.triangle, level, law)?;
                        self.add_triangle::<6>(part, |a, b| Some(k[a][b]), &far, &mut rows, &mut lift);
                    }
                }
                continue;
            }
            let made = if part.is_own { MacroStiffness::new } else { MacroStiffness::of_sides };
            let stiffness = made(mesh, part.triangle, level, law)?;
            self.add_rows(part, &stiffness, &far, &mut rows, &mut lift);
            if part.is_whole {
                couplings.push(Couplings::of_rows(&stiffness, level.order));
                triangles.push(TriangleNodes::new(&part.numbers, self.space, &self.space.own, &far));
            } else if part.is_own {
                inside.push(self.inner_nodes(part));
            }
        }
        self.add_springs(&far, &mut rows, &mut lift);
        (0..rows.nodes.len()).filter(|&k| self.is_stored[k]).for_each(|k| rows.invert(k));
        // Rows of a mesh that is not cut up are alike by chance only.
        if !self.space.numbering.level.is_one_triangle() {
            rows.share(contact.range(self.space.own.clone()).map(|(node, _)| node - self.space.own.start));
        }
        inside.sort_unstable_by_key(|nodes: &Range<usize>| nodes.start);
        let even = EvenTriangles::new(self.space.numbering.level.intervals, Rc::new(couplings), triangles);
        Ok(Assembled { rows, far, inside: inside.into(), even: Rc::new(even), straight: Rc::new(straight) })
    }

    /// The stored rows with zeros, and their columns of other ranks.
    fn pattern(&self, contact: &ContactNeighbours) -> (StoredRows, Vec<usize>) {
        let (level, own) = (self.space.numbering.level, &self.space.own);
        let of_contact = || contact.range(own.clone()).map(|(&row, others)| (self.place(row), others));
        let is_one = level.is_one_triangle();
        let mut counts = vec![u32::from(is_one); self.nodes.len()];
        for part in &self.parts {
            match is_one {
                true => self.each_coupling_of_one(part, |k, _| counts[k] += 1),
                false => self.each_row(part, |k, (i, j)| counts[k] += coupled(level, i, j).count() as u32),
            }
        }
        of_contact().for_each(|(k, others)| counts[k] += others.len() as u32);
        let mut couplings = RowColumns::new(&counts);
        if is_one {
            self.nodes.iter().enumerate().for_each(|(k, &node)| couplings.push(k, own.start + node as usize));
        }
        for part in &self.parts {
            match is_one {
                true => self.each_coupling_of_one(part, |k, node| couplings.push(k, node)),
                false => self.each_row(part, |k, (i, j)| {
                    coupled(level, i, j).for_each(|(a, b)| couplings.push(k, part.numbers.node(a, b)));
                }),
            }
        }
        for (k, others) in of_contact() {
            others.iter().for_each(|&other| couplings.push(k, other));
        }
        let whole = self.parts.iter().filter(|part| part.is_whole);
        let of_sides = whole.flat_map(|part| side_nodes(level.intervals).map(|(i, j)| part.numbers.node(i, j)));
        couplings.into_rows(self.nodes.clone(), own, of_sides, |k| self.is_stored[k])
    }

    /// The place of the row of a node of this rank's that does not lie inside of a whole macro triangle.
    #[inline]
    fn place(&self, node: usize) -> usize {
        place(&self.nodes, node - self.space.own.start).expect("a node that has a row")
    }

    /// Shows the stored rows of this rank that a macro triangle has a part in: place and lattice node.
    #[inline]
    fn each_row(&self, part: &AssemblyPart, mut show: impl FnMut(usize, (usize, usize))) {
        let n = self.space.numbering.level.intervals;
        // Inner nodes come in the order of their numbers: the place of the first one tells the others.
        let mut next = None;
        let mut show = |(i, j): (usize, usize)| {
            let node = part.numbers.node(i, j);
            if !self.space.own.contains(&node) {
                return;
            }
            let k = match lattice::place(n, i, j) {
                lattice::Place::Inside(_) => *next.insert(next.map_or_else(|| self.place(node), |k| k + 1)),
                _ => self.place(node),
            };
            show(k, (i, j));
        };
        if part.is_own && !part.is_whole { lattice::nodes(n).for_each(&mut show) } else { lattice::sides(n).for_each(&mut show) }
    }

    /// Shows the couplings of different nodes in a macro triangle that is a single triangle: the place of the row, and the
    /// other node. Those along an edge are shown by the one of its triangles that it runs along, so that all are shown once. Rows without
    /// blocks leave to earlier ones of their kind what they have in common.
    #[inline]
    fn each_coupling_of_one(&self, part: &AssemblyPart, mut show: impl FnMut(usize, usize)) {
        let own = &self.space.own;
        let mut both = |a: usize, b: usize| {
            for (row, other) in [(a, b), (b, a)].into_iter().filter(|(row, _)| own.contains(row)) {
                let k = self.place(row);
                if self.is_stored[k] || other > row || self.is_stored[other - own.start] {
                    show(k, other);
                }
            }
        };
        let forward = self.scene.mesh.triangles[part.triangle].forward;
        let is_quadratic = self.space.numbering.level.order == Order::P2;
        let [a, b, c, ab, bc, ca] = part.numbers.of_one::<6>();
        for (is_forward, [a, b, ab, bc, opposite]) in
            forward.into_iter().zip([[a, b, ab, bc, c], [b, c, bc, ca, a], [c, a, ca, ab, b]])
        {
            if is_forward {
                both(a, b);
            }
            if is_quadratic {
                if is_forward {
                    both(a, ab);
                    both(b, ab);
                }
                if !part.is_straight {
                    both(opposite, ab);
                }
                both(ab, bc);
            }
        }
    }

    /// Adds the part that a macro triangle has in the stored rows.
    fn add_rows(
        &self,
        part: &AssemblyPart,
        stiffness: &MacroStiffness,
        far: &[usize],
        rows: &mut StoredRows,
        lift: &mut impl FnMut(usize, Point),
    ) {
        let n = self.space.numbering.level.intervals;
        let constraint = |i: usize, j: usize, node: usize| match lattice::place(n, i, j) {
            lattice::Place::Inside(_) => None,
            _ => self.space.constraints.get(node),
        };
        let is_supported = lattice::sides(n).any(|(i, j)| constraint(i, j, part.numbers.node(i, j)).is_some());
        self.each_row(part, |place, (i, j)| {
            let row = part.numbers.node(i, j);
            let held = if is_supported { constraint(i, j, row) } else { None };
            for ((k, l), block) in stiffness.row(i, j) {
                let node = part.numbers.node(k, l);
                let block = match (held, if is_supported { constraint(k, l, node) } else { None }) {
                    (None, None) => *block,
                    (left, right) => constrained(block, left, right, row == node, |force| lift(row, force)),
                };
                rows.add(place, BlockColumn::of(node, &self.space.own, far), &block);
            }
        });
        if part.is_whole && is_supported {
            self.lift_inner(part, stiffness, lift);
        }
    }

    /// Adds the part that a macro triangle has in the stored rows where it is one triangle with these couplings of its nodes.
    fn add_triangle<const N: usize>(
        &self,
        part: &AssemblyPart,
        coupling: impl Fn(usize, usize) -> Option<Block>,
        far: &[usize],
        rows: &mut StoredRows,
        lift: &mut impl FnMut(usize, Point),
    ) {
        let constraint = |node: usize| self.space.constraints.get(node);
        let (nodes, own) = (part.numbers.of_one::<N>(), &self.space.own);
        for (a, row) in nodes.into_iter().enumerate().filter(|(_, row)| own.contains(row)) {
            let (place, held) = (self.place(row), constraint(row));
            if !self.is_stored[place] {
                continue;
            }
            for (b, &node) in nodes.iter().enumerate() {
                let Some(block) = coupling(a, b) else { continue };
                let block = match (held, constraint(node)) {
                    (None, None) => block,
                    (left, right) => constrained(&block, left, right, a == b, |force| lift(row, force)),
                };
                rows.add(place, BlockColumn::of(node, own, far), &block);
            }
        }
    }

    /// Shows what prescribed displacements on the sides of a macro triangle do to its inner nodes.
    fn lift_inner(&self, part: &AssemblyPart, stiffness: &MacroStiffness, lift: &mut impl FnMut(usize, Point)) {
        let n = self.space.numbering.level.intervals;
        for (i, j) in (1..n - 1).flat_map(|j| (1..n - j).map(move |i| (i, j))) {
            let near = |(k, l): &(usize, usize)| !matches!(lattice::place(n, *k, *l), lattice::Place::Inside(_));
            for ((k, l), block) in stiffness.row(i, j).filter(|(other, _)| near(other)) {
                if let Some(column) = self.space.constraints.get(part.numbers.node(k, l)) {
                    constrained(block, None, Some(column), false, |force| lift(part.numbers.node(i, j), force));
                }
            }
        }
    }

    /// Adds the springs of elastic supports: they stand on sides, whose rows are stored.
    fn add_springs(&self, far: &[usize], rows: &mut StoredRows, lift: &mut impl FnMut(usize, Point)) {
        let (mesh, own) = (&self.scene.mesh, &self.space.own);
        let constraint = |node: usize| self.space.constraints.get(node);
        for springs in &self.scene.springs {
            for edge in springs.edges(mesh) {
                springs.stiffness(mesh, edge, &self.space.numbering, |row, node, block| {
                    if own.contains(&row) {
                        let (place, held) = (self.place(row), constraint(row));
                        let block = constrained(&block, held, constraint(node), row == node, |force| lift(row, force));
                        rows.add(place, BlockColumn::of(node, own, far), &block);
                    }
                });
            }
        }
    }
}

/// Whether this rank owns nodes of a macro triangle that it does not own itself.
fn touches(n: usize, space: &Space, numbers: &TriangleNumbers) -> bool {
    (0..3).any(|side| {
        let corner = lattice::side_node(n, side, 0);
        let middle = lattice::side_node(n, side, n / 2);
        [corner, middle].into_iter().any(|(i, j)| space.own.contains(&numbers.node(i, j)))
    })
}

/// Lattice nodes that a node couples to.
fn coupled(level: Level, i: usize, j: usize) -> impl Iterator<Item = (usize, usize)> {
    let nodes = neighbours(level.order, i, j).iter().map(move |&(di, dj)| (i.wrapping_add_signed(di), j.wrapping_add_signed(dj)));
    nodes.filter(move |&(a, b)| a <= level.intervals && b <= level.intervals && a + b <= level.intervals)
}

/// A block in the frames of its nodes, without the couplings of prescribed components.
fn constrained(
    block: &Block,
    row: Option<&Constraint>,
    column: Option<&Constraint>,
    diagonal: bool,
    mut lift: impl FnMut(Point),
) -> Block {
    let mut k = nalgebra::Matrix2::new(block[0][0], block[0][1], block[1][0], block[1][1]);
    if let Some(row) = row {
        k = row.frame().transpose() * k;
    }
    if let Some(column) = column {
        k *= column.frame();
        let force = k * column.prescribed();
        if force != Point::zeros() {
            lift(row.map_or(force, |row| row.free_part(force)));
        }
    }
    let fixed = |constraint: Option<&Constraint>, a: usize| constraint.is_some_and(|c| c.fixed[a]);
    std::array::from_fn(|a| {
        std::array::from_fn(|b| {
            let kept = diagonal && a == b;
            if !kept && (fixed(row, a) || fixed(column, b)) { 0.0 } else { k[(a, b)] }
        })
    })
}
