//! A quadtree over one body, and its continuous bilinear functions.
//!
//! Cells are split in four until they are about as wide as the points in them ask for; cells that touch, be it at a corner,
//! differ by one halving at most. A vertex in the middle of a larger neighbour's edge *hangs*: it takes the mean of the
//! ends of that edge and has no function of its own. Every other vertex has one: 1 there, 0 at the others.
//!
//! Lengths are counted in the smallest cells that there may be, so that vertices are whole numbers, on every tree alike.

/// No children.
const LEAF: u32 = u32::MAX;

/// Values of a bilinear function that may be rounding.
const ROUNDING: f64 = 1e-12;

/// A grid of root cells, which may be halved down to the unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Roots {
    /// Root cells in x and y.
    pub count: [u32; 2],
    /// Halvings from a root cell to the unit.
    pub depth: u32,
}

/// A point (units) and the logarithm of the width that cells should have there.
#[derive(Clone, Copy, Debug)]
pub struct WantedWidth {
    /// Where.
    pub at: [f64; 2],
    /// Logarithm of the width (units).
    pub width: f64,
}

/// A vertex, in units from the lower left corner.
pub type Vertex = [u32; 2];

/// A cell: halvings from a root cell, and its place among the cells of its size.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Cell {
    depth: u32,
    at: [u32; 2],
}

impl Cell {
    fn parent(self) -> Self {
        Self { depth: self.depth - 1, at: self.at.map(|k| k / 2) }
    }
}

/// The tree.
#[derive(Clone, Debug)]
pub struct Tree {
    roots: Roots,
    cells: Vec<Cell>,
    /// First of the four children of each cell.
    children: Vec<u32>,
}

impl Tree {
    fn new(roots: Roots) -> Self {
        let [m, n] = roots.count;
        let cells: Vec<Cell> = (0..n).flat_map(|j| (0..m).map(move |i| Cell { depth: 0, at: [i, j] })).collect();
        Self { roots, children: vec![LEAF; cells.len()], cells }
    }

    /// The tree whose cells are at most √2 times as wide as the geometric mean of the widths wanted in them.
    pub fn around(roots: Roots, widths: &mut [WantedWidth]) -> Self {
        let mut tree = Self::new(roots);
        let mut rest = widths;
        for root in 0..tree.cells.len() {
            let here = |wanted: &WantedWidth| tree.find(wanted.at, 0) == root;
            let count = divide(rest, here);
            let (own, others) = rest.split_at_mut(count);
            tree.grow(root, own);
            rest = others;
        }
        tree.balance();
        tree
    }

    /// The tree of cells twice as wide; none if these are the root cells.
    pub fn coarser(&self) -> Option<Self> {
        let mut tree = Self::new(self.roots);
        let split = self.cells.iter().zip(&self.children).filter(|(_, first)| **first != LEAF);
        for (cell, _) in split.filter(|(cell, _)| cell.depth > 0) {
            let index = tree.reach(cell.parent());
            tree.split(index);
        }
        tree.balance();
        (tree.cells.len() < self.cells.len()).then_some(tree)
    }

    /// Adds the values of the functions that are not zero at a point (units) to a list; they sum to 1.
    pub fn function_values(&self, at: [f64; 2], values: &mut Vec<(Vertex, f64)>) {
        let cell = self.cells[self.find(at, self.roots.depth)];
        let width = self.width(cell.depth);
        let [s, t] = [0, 1].map(|k| (at[k] / f64::from(width) - f64::from(cell.at[k])).clamp(0.0, 1.0));
        let corners = [([0, 0], (1.0 - s) * (1.0 - t)), ([1, 0], s * (1.0 - t)), ([0, 1], (1.0 - s) * t), ([1, 1], s * t)];
        for (corner, value) in corners.into_iter().filter(|(_, value)| *value > ROUNDING) {
            match self.masters(cell, corner) {
                Some(ends) => ends.into_iter().for_each(|end| add(values, end, 0.5 * value)),
                None => add(values, [0, 1].map(|k| (cell.at[k] + corner[k]) * width), value),
            }
        }
    }

    /// Ends of the edge in whose middle the corner of a leaf hangs, if it does.
    fn masters(&self, cell: Cell, corner: [u32; 2]) -> Option<[Vertex; 2]> {
        if cell.depth == 0 {
            return None;
        }
        let parent = cell.parent();
        let place = [0, 1].map(|k| cell.at[k] % 2 + corner[k]);
        let along = match place {
            [1, 0 | 2] => 0,
            [0 | 2, 1] => 1,
            _ => return None,
        };
        let mut beside = parent.at.map(i64::from);
        beside[1 - along] += i64::from(place[1 - along]) - 1;
        let beside = self.inside(parent.depth, beside)?;
        if self.is_split(beside) {
            return None;
        }
        let width = self.width(parent.depth);
        let end = |far: u32| {
            let mut vertex = [0, 1].map(|k| (parent.at[k] + place[k] / 2) * width);
            vertex[along] = (parent.at[along] + far) * width;
            vertex
        };
        Some([end(0), end(1)])
    }

    /// The cell at this place, if it lies on the grid of roots.
    fn inside(&self, depth: u32, at: [i64; 2]) -> Option<Cell> {
        let lies = |k: usize| at[k] >= 0 && at[k] < i64::from(self.roots.count[k]) << depth;
        (lies(0) && lies(1)).then(|| Cell { depth, at: at.map(|k| k as u32) })
    }

    /// Width of the cells after so many halvings (units).
    fn width(&self, depth: u32) -> u32 {
        1 << (self.roots.depth - depth)
    }

    /// The smallest cell with a point (units) in it, after so many halvings at most.
    fn find(&self, at: [f64; 2], depth: u32) -> usize {
        let place = |k: usize, depth: u32| {
            let cell = (at[k] / f64::from(self.width(depth))).max(0.0) as u32;
            cell.min((self.roots.count[k] << depth) - 1)
        };
        let mut index = (place(1, 0) * self.roots.count[0] + place(0, 0)) as usize;
        for level in 1..=depth {
            if self.children[index] == LEAF {
                break;
            }
            index = self.children[index] as usize + (place(0, level) % 2 + 2 * (place(1, level) % 2)) as usize;
        }
        index
    }

    fn is_split(&self, cell: Cell) -> bool {
        let mut index = self.root_of(cell);
        for level in 0..=cell.depth {
            if self.children[index] == LEAF {
                return false;
            }
            if level < cell.depth {
                index = self.child_towards(index, cell);
            }
        }
        true
    }

    fn root_of(&self, cell: Cell) -> usize {
        let [i, j] = cell.at.map(|k| k >> cell.depth);
        (j * self.roots.count[0] + i) as usize
    }

    fn child_towards(&self, index: usize, cell: Cell) -> usize {
        let below = cell.depth - self.cells[index].depth - 1;
        let [i, j] = cell.at.map(|k| (k >> below) % 2);
        self.children[index] as usize + (i + 2 * j) as usize
    }

    /// Splits what lies above a cell, until it is there.
    fn reach(&mut self, cell: Cell) -> usize {
        let mut index = self.root_of(cell);
        while self.cells[index].depth < cell.depth {
            self.split(index);
            index = self.child_towards(index, cell);
        }
        index
    }

    fn split(&mut self, index: usize) {
        if self.children[index] == LEAF {
            self.children[index] = self.cells.len() as u32;
            let Cell { depth, at: [i, j] } = self.cells[index];
            let child = |k: u32| Cell { depth: depth + 1, at: [2 * i + k % 2, 2 * j + k / 2] };
            self.cells.extend((0..4).map(child));
            self.children.extend([LEAF; 4]);
        }
    }

    fn grow(&mut self, index: usize, widths: &mut [WantedWidth]) {
        let Cell { depth, at } = self.cells[index];
        if widths.is_empty() || depth == self.roots.depth {
            return;
        }
        let wanted = widths.iter().map(|wanted| wanted.width).sum::<f64>() / widths.len() as f64;
        if f64::from(self.width(depth)).ln() <= wanted + 0.5 * std::f64::consts::LN_2 {
            return;
        }
        self.split(index);
        let first = self.children[index] as usize;
        let middle = at.map(|k| f64::from((2 * k + 1) * self.width(depth + 1)));
        let below = divide(widths, |wanted| wanted.at[1] < middle[1]);
        let (below, above) = widths.split_at_mut(below);
        for (row, widths) in [below, above].into_iter().enumerate() {
            let left = divide(widths, |wanted| wanted.at[0] < middle[0]);
            let (left, right) = widths.split_at_mut(left);
            self.grow(first + 2 * row, left);
            self.grow(first + 2 * row + 1, right);
        }
    }

    /// Splits until every cell that is split touches cells of its own size, at least.
    fn balance(&mut self) {
        // A cell that is split on the way gets its children at the end of the list, where this loop comes to them later.
        let mut first = (self.roots.count[0] * self.roots.count[1]) as usize;
        while first < self.cells.len() {
            let split = self.cells[first].parent();
            for (di, dj) in (-1..=1).flat_map(|di| (-1..=1).map(move |dj| (di, dj))) {
                let beside = [i64::from(split.at[0]) + di, i64::from(split.at[1]) + dj];
                if let Some(beside) = self.inside(split.depth, beside) {
                    self.reach(beside);
                }
            }
            first += 4;
        }
    }
}

/// Adds to the weight of a vertex.
fn add(values: &mut Vec<(Vertex, f64)>, vertex: Vertex, value: f64) {
    match values.iter_mut().find(|(other, _)| *other == vertex) {
        Some((_, sum)) => *sum += value,
        None => values.push((vertex, value)),
    }
}

/// Brings the wanted widths that satisfy a condition to the front; gives their number.
fn divide(widths: &mut [WantedWidth], first: impl Fn(&WantedWidth) -> bool) -> usize {
    let mut count = 0;
    for k in 0..widths.len() {
        if first(&widths[k]) {
            widths.swap(count, k);
            count += 1;
        }
    }
    count
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::{HashMap, HashSet};

    const ROOTS: Roots = Roots { count: [3, 2], depth: 7 };

    fn function_values(tree: &Tree, at: [f64; 2]) -> Vec<(Vertex, f64)> {
        let mut values = Vec::new();
        tree.function_values(at, &mut values);
        values
    }

    /// Points all over the grid, in no order.
    fn points() -> impl Iterator<Item = [f64; 2]> {
        let fraction = |k: f64| (k * 0.618_033_988_749_895).fract();
        (0..4000).map(move |k| [384.0 * fraction(f64::from(k)), 256.0 * fraction(0.37 + 0.731 * f64::from(k))])
    }

    /// Cells of width 2 at one point, growing with the distance from it, and nothing at all above a line.
    fn graded() -> Tree {
        let distance = |at: [f64; 2]| (at[0] - 130.0).hypot(at[1] - 70.0);
        let wanted = |at| WantedWidth { at, width: (2.0 + 0.3 * distance(at)).ln() };
        let near = (0..400).map(|k| [130.0 + f64::from(k % 20), 60.0 + f64::from(k / 20)]);
        let mut widths: Vec<WantedWidth> = points().chain(near).filter(|at| at[1] < 150.0 + 0.2 * at[0]).map(wanted).collect();
        Tree::around(ROOTS, &mut widths)
    }

    fn all() -> Vec<Tree> {
        std::iter::successors(Some(graded()), Tree::coarser).collect()
    }

    fn leaves(tree: &Tree) -> impl Iterator<Item = Cell> {
        tree.cells.iter().zip(&tree.children).filter(|(_, first)| **first == LEAF).map(|(cell, _)| *cell)
    }

    #[test]
    fn cells_that_touch_differ_by_one_halving_at_most() {
        for tree in all() {
            for cell in leaves(&tree) {
                let width = f64::from(tree.width(cell.depth));
                for (dx, dy) in (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| (f64::from(dx), f64::from(dy)))) {
                    let at = [(f64::from(cell.at[0]) + 0.5 + 0.6 * dx) * width, (f64::from(cell.at[1]) + 0.5 + 0.6 * dy) * width];
                    let other = tree.cells[tree.find(at, ROOTS.depth)];
                    assert!(other.depth + 1 >= cell.depth, "{cell:?} beside {other:?}");
                }
            }
        }
    }

    #[test]
    fn cells_follow_the_samples() {
        let tree = graded();
        let width = |at| tree.width(tree.cells[tree.find(at, ROOTS.depth)].depth);
        assert!(width([135.5, 66.5]) <= 4 && width([380.0, 20.0]) >= 32, "{} {}", width([135.5, 66.5]), width([380.0, 20.0]));
        let counts: Vec<usize> = all().iter().map(|tree| leaves(tree).count()).collect();
        assert!(counts.windows(2).all(|pair| pair[1] < pair[0]) && counts[counts.len() - 1] == 6, "{counts:?}");
    }

    #[test]
    fn linear_functions_are_reproduced() {
        for tree in all() {
            for at in points() {
                let values = function_values(&tree, at);
                let sum = |f: &dyn Fn(Vertex) -> f64| values.iter().map(|(vertex, value)| value * f(*vertex)).sum::<f64>();
                assert!((sum(&|_| 1.0) - 1.0).abs() < 1e-11);
                assert!((0..2).all(|k| (sum(&|vertex| f64::from(vertex[k])) - at[k]).abs() < 1e-8));
            }
        }
    }

    /// Any vertex that carries a function is 1 there and 0 at the others: none hangs.
    #[test]
    fn functions_are_one_at_their_own_vertex_alone() {
        for tree in all() {
            let vertices: HashSet<Vertex> =
                points().flat_map(|at| function_values(&tree, at)).map(|(vertex, _)| vertex).collect();
            for vertex in vertices {
                assert_eq!(function_values(&tree, vertex.map(f64::from)), [(vertex, 1.0)]);
            }
        }
    }

    #[test]
    fn coarse_functions_are_sums_of_finer_ones() {
        let trees = all();
        assert!(trees.len() > 4);
        for pair in trees.windows(2) {
            for at in points() {
                let mut sums: HashMap<Vertex, f64> = HashMap::new();
                for (vertex, value) in function_values(&pair[0], at) {
                    for (coarse, weight) in function_values(&pair[1], vertex.map(f64::from)) {
                        *sums.entry(coarse).or_insert(0.0) += value * weight;
                    }
                }
                function_values(&pair[1], at).into_iter().for_each(|(coarse, value)| *sums.entry(coarse).or_insert(0.0) -= value);
                assert!(sums.values().all(|rest| rest.abs() < 1e-10), "{at:?}");
            }
        }
    }
}
