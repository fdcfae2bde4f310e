//! Assembly of the stiffness of one level: counts and entries, for whoever makes a matrix of them.

use super::lattice_operator::{Strips, TriangleStrips};
use super::preallocation::{ContactNeighbours, Counts};
use super::precision::Precision;
use super::strips::{Couplings, StripNodes};
use crate::body::{Constraint, MacroStiffness, neighbours};
use crate::element::{BadJacobian, Block};
use crate::geometry::Point;
use crate::mesh::{Strip, TriangleNumbers, lattice};
use crate::system::{Scene, Space};
use std::collections::BTreeMap;

/// A level to assemble, and what need not be: the strips of each macro triangle of this rank.
pub struct Assembly<'a> {
    scene: &'a Scene,
    space: &'a Space,
    rank: usize,
    strips: BTreeMap<usize, Vec<Strip>>,
    has_strips: bool,
}

impl<'a> Assembly<'a> {
    /// With all rows stored.
    pub fn stored(scene: &'a Scene, space: &'a Space, rank: usize) -> Self {
        Self { scene, space, rank, strips: BTreeMap::new(), has_strips: false }
    }

    /// With strips.
    pub fn with_strips(scene: &'a Scene, space: &'a Space, rank: usize) -> Self {
        let own = scene.partition.triangles_of(rank).iter().map(|&triangle| triangle as usize);
        let level = space.numbering.level;
        let strips = own.map(|triangle| (triangle, scene.mesh.strips(triangle, level))).collect();
        Self { scene, space, rank, strips, has_strips: true }
    }

    /// Whether rows are left to strips, on this rank or another.
    pub fn has_strips(&self) -> bool {
        self.has_strips
    }

    /// Whether strips hold most nodes of this rank.
    pub fn is_mostly_strips(&self) -> bool {
        2 * self.strips.values().flatten().map(|strip| strip.i.len()).sum::<usize>() > self.space.own.len()
    }

    /// The space of the level.
    pub fn space(&self) -> &Space {
        self.space
    }

    /// Exact numbers of blocks in the rows that are stored, the couplings of contact among them: those in this rank's own
    /// columns, and those in others'.
    pub fn counts(&self, contact: &ContactNeighbours) -> (Vec<i32>, Vec<i32>) {
        let (scene, space) = (self.scene, self.space);
        let mut counts = Counts::new(space, contact);
        for (&triangle, strips) in &self.strips {
            for nodes in strips.iter().map(|strip| self.strip_nodes(triangle, strip)) {
                counts.leave_out(nodes.range());
            }
        }
        let n = space.numbering.level.intervals;
        for triangle in 0..scene.mesh.triangles.len() {
            let numbers = space.numbering.triangle(&scene.mesh, triangle);
            if scene.partition.owner(triangle as u32) == self.rank {
                let rows = outside(n, self.strips_of(triangle));
                rows.for_each(|node| count_row(scene, space, triangle, node, &mut counts));
            } else if touches(n, space, &numbers) {
                sides(n).for_each(|node| count_row(scene, space, triangle, node, &mut counts));
            }
        }
        counts.finish()
    }

    /// Hands the stiffness of the macro triangles that this rank owns to `add(row node, column nodes, their blocks row by row)`,
    /// to be summed. Rows and columns of prescribed components are zero but for the diagonal; what their displacement does to
    /// free rows goes to `lift(node, force in the node's frame)`. Gives the rows that are not stored.
    ///
    /// # Errors
    /// That of a triangle that is turned inside out, and those of `add`.
    pub fn entries<E: From<BadJacobian>>(
        &self,
        mut add: impl FnMut(usize, &[usize], &[f64]) -> Result<(), E>,
        mut lift: impl FnMut(usize, Point),
    ) -> Result<Strips, E> {
        let laws = self.scene.laws();
        let mut strips = Strips::default();
        for &triangle in self.scene.partition.triangles_of(self.rank) {
            let law = &laws[self.scene.mesh.triangles[triangle as usize].body as usize];
            let level = self.space.numbering.level;
            let stiffness = MacroStiffness::new(&self.scene.mesh, triangle as usize, level, law)?;
            self.add_triangle(triangle as usize, &stiffness, &mut add, &mut lift)?;
            self.add_strips(triangle as usize, &stiffness, &mut strips);
        }
        Ok(strips)
    }

    fn add_triangle<E>(
        &self,
        triangle: usize,
        stiffness: &MacroStiffness,
        add: &mut impl FnMut(usize, &[usize], &[f64]) -> Result<(), E>,
        lift: &mut impl FnMut(usize, Point),
    ) -> Result<(), E> {
        let n = self.space.numbering.level.intervals;
        let numbers = self.space.numbering.triangle(&self.scene.mesh, triangle);
        let constraint = |i: usize, j: usize, node: usize| match lattice::place(n, i, j) {
            lattice::Place::Inside(_) => None,
            _ => self.space.constraints.get(node),
        };
        let supported = sides(n).any(|(i, j)| constraint(i, j, numbers.node(i, j)).is_some());
        let mut columns: Vec<usize> = Vec::with_capacity(19);
        let mut values: Vec<f64> = vec![0.0; 4 * 19];
        for (i, j) in outside(n, self.strips_of(triangle)) {
            let row = numbers.node(i, j);
            let held = if supported { constraint(i, j, row) } else { None };
            columns.clear();
            let count = stiffness.row(i, j).count();
            for (slot, ((k, l), block)) in stiffness.row(i, j).enumerate() {
                let column = numbers.node(k, l);
                let block = match (held, if supported { constraint(k, l, column) } else { None }) {
                    (None, None) => *block,
                    (left, right) => constrained(block, left, right, row == column, |force| lift(row, force)),
                };
                columns.push(column);
                for (a, parts) in block.iter().enumerate() {
                    values[2 * (a * count + slot)] = parts[0];
                    values[2 * (a * count + slot) + 1] = parts[1];
                }
            }
            add(row, &columns, &values[..4 * count])?;
        }
        Ok(())
    }

    /// Adds the strips of a macro triangle: one stencil for each shape, and for P2 for even and odd rows.
    fn add_strips(&self, triangle: usize, stiffness: &MacroStiffness, strips: &mut Strips) {
        let order = self.space.numbering.level.order;
        let mut known = BTreeMap::new();
        let first = strips.alike.len();
        for strip in self.strips_of(triangle) {
            let kind = *known.entry((strip.shape, strip.j % order.degree())).or_insert_with(|| {
                strips.couplings.push(Couplings::new(stiffness, order, strip));
                strips.kernels.push(f64::kernel(&strips.couplings[strips.couplings.len() - 1]));
                strips.couplings.len() - 1
            });
            let at = strips.nodes.len();
            strips.nodes.push(self.strip_nodes(triangle, strip));
            let part = strips.alike.len();
            match strips.alike.last_mut().filter(|(_, last)| part > first && *last == kind) {
                Some((alike, _)) => alike.end = at + 1,
                None => strips.alike.push((at..at + 1, kind)),
            }
        }
        let numbers = self.space.numbering.triangle(&self.scene.mesh, triangle);
        let n = self.space.numbering.level.intervals;
        let start = if n < 3 { 0 } else { numbers.node(1, 1) - self.space.own.start };
        let nodes = start..start + lattice::inner_count(n);
        strips.triangles.push(TriangleStrips { nodes, alike: first..strips.alike.len() });
    }

    fn strips_of(&self, triangle: usize) -> &[Strip] {
        self.strips.get(&triangle).map_or(&[], Vec::as_slice)
    }

    /// Where a strip lies among the nodes of this rank.
    fn strip_nodes(&self, triangle: usize, strip: &Strip) -> StripNodes {
        let numbers = self.space.numbering.triangle(&self.scene.mesh, triangle);
        let first = numbers.node(strip.i.start, strip.j) - self.space.own.start;
        StripNodes { first, count: strip.i.len(), width: self.space.numbering.level.intervals - 1 - strip.j }
    }
}

/// Counts the couplings of an owned node within one macro triangle; those along an edge with its first triangle alone.
fn count_row(scene: &Scene, space: &Space, triangle: usize, (i, j): (usize, usize), counts: &mut Counts) {
    let level = space.numbering.level;
    let n = level.intervals;
    let numbers = space.numbering.triangle(&scene.mesh, triangle);
    let row = numbers.node(i, j);
    if !space.own.contains(&row) {
        return;
    }
    let on_sides = [0, 1, 2].map(|side| on_side(n, side, i, j));
    let counted = |k: usize, l: usize| {
        let edges = scene.mesh.triangles[triangle].edges;
        let first = |side: usize| scene.mesh.edges[edges[side] as usize].triangles[0] == Some(triangle as u32);
        (0..3).any(|side| on_sides[side] && on_side(n, side, k, l) && !first(side))
    };
    for &(di, dj) in neighbours(level.order, i, j) {
        let (k, l) = (i.wrapping_add_signed(di), j.wrapping_add_signed(dj));
        if (di, dj) != (0, 0) && k <= n && l <= n && k + l <= n && !counted(k, l) {
            counts.add(row, numbers.node(k, l));
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

/// Nodes on the sides of a lattice.
fn sides(n: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..3).flat_map(move |side| (0..n).map(move |position| lattice::side_node(n, side, position)))
}

/// Nodes of a lattice outside of its strips, row by row.
fn outside(n: usize, strips: &[Strip]) -> impl Iterator<Item = (usize, usize)> + '_ {
    (0..=n).flat_map(move |j| {
        let of_row = strips.partition_point(|strip| strip.j < j)..strips.partition_point(|strip| strip.j <= j);
        let starts = std::iter::once(0).chain(strips[of_row.clone()].iter().map(|strip| strip.i.end));
        let ends = strips[of_row].iter().map(|strip| strip.i.start).chain([n + 1 - j]);
        starts.zip(ends).flat_map(move |(start, end)| (start..end).map(move |i| (i, j)))
    })
}

/// Whether a lattice node lies on a side, corners included.
fn on_side(n: usize, side: usize, i: usize, j: usize) -> bool {
    match side {
        0 => j == 0,
        1 => i + j == n,
        _ => i == 0,
    }
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
