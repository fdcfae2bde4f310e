//! The stiffness of a level with most of its rows as strips: what PETSc's solvers see of it.

use super::stored_rows::{StoredRows, far_columns};
use super::lattice_rows::{LatticeRows, Order};
use super::precision::Precision;
use super::strip_kernel::StripKernel;
use super::strips::{Couplings, StripNodes};
use crate::element::Block;
use crate::petsc::{Gather, Halo, Matrix, Operator, Result, Session, Vector};
use crate::system::space::Components;
use std::cell::{Ref, RefCell};
use std::ops::Range;
use std::rc::Rc;

/// Strips of this rank, with what they have in common.
#[derive(Default)]
pub struct Strips<T = f64> {
    /// Couplings; few strips have their own.
    pub couplings: Vec<Couplings>,
    /// The work on each of these.
    pub kernels: Vec<Box<dyn StripKernel<T>>>,
    /// The nodes of each strip.
    pub nodes: Vec<StripNodes>,
    /// Consecutive strips with the same couplings, and these.
    pub alike: Vec<(Range<usize>, usize)>,
    /// Those of each macro triangle.
    pub triangles: Vec<TriangleStrips>,
}

/// The inner nodes of a macro triangle, which couple to each other and to nodes on its sides alone.
#[derive(Clone, Debug)]
pub struct TriangleStrips {
    /// All of them.
    pub nodes: Range<usize>,
    /// Those of [`Strips::alike`] that lie in it.
    pub alike: Range<usize>,
}

impl<T: Precision> Strips<T> {
    /// The same in another precision.
    pub fn converted<U: Precision>(&self) -> Strips<U> {
        Strips {
            kernels: self.couplings.iter().map(U::kernel).collect(),
            couplings: self.couplings.clone(),
            nodes: self.nodes.clone(),
            alike: self.alike.clone(),
            triangles: self.triangles.clone(),
        }
    }
}

/// Stored rows and strips together.
pub struct LatticeOperator {
    own: Range<usize>,
    strips: Rc<Strips>,
    stored: RefCell<Matrix>,
    rows: Rc<RefCell<StoredRows>>,
    /// Couplings of all nodes in strips.
    in_strips: f64,
    /// Columns of other ranks, and what fetches their values.
    far: Vec<usize>,
    gather: Option<RefCell<Gather>>,
    halo: Rc<Halo>,
    order: Order,
}

impl LatticeOperator {
    /// From the stored rows, assembled: those of nodes in strips are empty. **Collective**
    pub fn new(stored: Matrix, own: &Range<usize>, strips: &Rc<Strips>, session: &Session) -> Result<Self> {
        let mut in_strip = vec![false; own.len()];
        strips.nodes.iter().for_each(|nodes| in_strip[nodes.range()].fill(true));
        let nodes: Vec<u32> = (0..own.len()).filter(|&node| !in_strip[node]).map(|node| node as u32).collect();
        let far = far_columns(&stored, own, &nodes)?;
        let gather = match session.size() {
            1 => None,
            _ => {
                let wanted: Vec<i32> = far.iter().flat_map(|&node| [2 * node as i32, 2 * node as i32 + 1]).collect();
                Some(RefCell::new(Gather::new(&stored.create_vectors()?.0, &wanted)?))
            }
        };
        let rows = Rc::new(RefCell::new(StoredRows::read(&stored, own, &nodes, &far)?));
        let couplings = |(alike, kind): &(Range<usize>, usize)| {
            let [even, odd] = [0, 1].map(|k| strips.couplings[*kind].of(k).len());
            strips.nodes[alike.clone()].iter().map(|nodes| 0.5 * (nodes.count * (even + odd)) as f64).sum::<f64>()
        };
        let in_strips = strips.alike.iter().map(couplings).sum();
        let order = Order::new(&rows.borrow(), strips);
        let halo = Rc::new(Halo::new(session, own, &far));
        Ok(Self { in_strips, own: own.clone(), halo, order, strips: strips.clone(), stored: RefCell::new(stored), rows, far, gather })
    }

    /// Adds a block to the couplings of two nodes. Holds after [`LatticeOperator::assemble`].
    pub fn add_block(&self, row: usize, column: usize, block: &[f64; 4]) -> Result<()> {
        self.stored.borrow_mut().add_blocks(&[row as i32], &[column as i32], block)
    }

    /// Brings added blocks to their ranks, and reads the rows of these nodes again (ascending): the others have not changed.
    /// **Collective**
    pub fn assemble(&self, changed: impl Iterator<Item = usize>) -> Result<()> {
        let mut stored = self.stored.borrow_mut();
        stored.assemble()?;
        let mut rows = self.rows.borrow_mut();
        changed.into_iter().try_for_each(|node| rows.read_again(&stored, &self.own, node, &self.far))
    }

    /// The matrix of the stored rows; those of nodes in strips are empty.
    pub fn stored(&self) -> Ref<'_, Matrix> {
        self.stored.borrow()
    }

    /// The nodes whose rows are stored.
    pub fn stored_nodes(&self) -> Vec<u32> {
        self.rows.borrow().nodes().to_vec()
    }

    /// In which order rows are worked on.
    pub fn order(&self) -> &Order {
        &self.order
    }

    fn lattice_rows<'a>(&'a self, stored: &'a StoredRows) -> LatticeRows<'a, f64> {
        LatticeRows { strips: &self.strips, stored, order: &self.order }
    }

    /// The stored rows.
    pub fn rows(&self) -> &Rc<RefCell<StoredRows>> {
        &self.rows
    }

    /// What brings the values of other ranks' nodes.
    pub fn halo(&self) -> &Rc<Halo> {
        &self.halo
    }

    /// Nodes of this rank.
    pub fn node_count(&self) -> usize {
        self.own.len()
    }

    /// Nodes of other ranks that the rows here couple to.
    pub fn far_count(&self) -> usize {
        self.far.len()
    }

    /// The rows of all ranks, on every rank. **Collective**
    pub fn gathered(&self, session: &Session) -> StoredRows {
        let (mut columns, mut values) = (Vec::new(), Vec::new());
        let mut add = |node: usize, couplings: &[(usize, Block)]| {
            columns.extend([(self.own.start + node) as u32, couplings.len() as u32]);
            columns.extend(couplings.iter().map(|c| c.0 as u32));
            values.extend(couplings.iter().flat_map(|c| c.1.as_flattened()));
        };
        self.each_row(|node, couplings| {
            let columns = couplings.iter().map(|&(distance, block)| ((self.own.start + node).wrapping_add_signed(distance), block));
            add(node, &columns.collect::<Vec<_>>());
        });
        self.rows.borrow().each_row(|node, near, far| {
            let near = near.map(|(column, block)| (self.own.start + column, block));
            add(node, &near.chain(far.map(|(column, block)| (self.far[column], block))).collect::<Vec<_>>());
        });
        StoredRows::of_all(&session.gather_all(&columns), &session.gather_all(&values))
    }

    /// The strips.
    pub fn strips(&self) -> &Rc<Strips> {
        &self.strips
    }

    /// Shows the rows of all nodes in strips: couplings as distances in node numbers.
    pub fn each_row(&self, mut show: impl FnMut(usize, &[(isize, Block)])) {
        for (strips, kind) in &self.strips.alike {
            for nodes in &self.strips.nodes[strips.clone()] {
                let couplings = &self.strips.couplings[*kind];
                let distances = |k| couplings.of(k).iter().map(|&(step, block)| (nodes.distance(step), block)).collect();
                let kinds: [Vec<(isize, Block)>; 2] = [0, 1].map(distances);
                (0..nodes.count).for_each(|k| show(nodes.first + k, &kinds[k % 2]));
            }
        }
    }

    /// Calls `with` with the values of other ranks' nodes that the stored rows want. **Collective**
    fn with_far<T>(&self, x: &Vector, with: impl FnOnce(&[Components]) -> T) -> Result<T> {
        Ok(match &self.gather {
            Some(gather) => with(gather.borrow_mut().read(x)?.as_chunks().0),
            None => with(&[]),
        })
    }
}

impl Operator for Rc<LatticeOperator> {
    fn multiply(&self, x: &Vector, y: &mut Vector) -> Result<()> {
        self.with_far(x, |far| {
            let (x, mut y) = (x.values(), y.values_mut());
            let (x, y) = (x.as_chunks().0, y.as_chunks_mut().0);
            let stored = self.rows.borrow();
            stored.multiply(0..stored.nodes().len(), x, far, y);
            self.lattice_rows(&stored).multiply_in_strips(x, y);
        })
    }

    fn residual(&self, b: &Vector, x: &Vector, r: &mut Vector) -> Result<()> {
        self.with_far(x, |far| {
            let (b, x, mut r) = (b.values(), x.values(), r.values_mut());
            let (b, x, r) = (b.as_chunks().0, x.as_chunks().0, r.as_chunks_mut().0);
            let stored = self.rows.borrow();
            stored.residual(0..stored.nodes().len(), b, x, far, r);
            self.lattice_rows(&stored).residual_in_strips(b, x, r);
        })
    }

    fn relax(&self, b: &Vector, x: &mut Vector, from_zero: bool) -> Result<()> {
        let sweep = |far: &[Components], b: &Vector, x: &mut Vector| {
            let (b, mut x) = (b.values(), x.values_mut());
            let (b, x) = (b.as_chunks().0, x.as_chunks_mut().0);
            self.lattice_rows(&self.rows.borrow()).relax(b, x, far);
        };
        if from_zero {
            x.set(0.0)?;
            sweep(&[], b, x);
            return Ok(());
        }
        match &self.gather {
            Some(gather) => sweep(gather.borrow_mut().read(x)?.as_chunks().0, b, x),
            None => sweep(&[], b, x),
        }
        Ok(())
    }

    fn diagonal(&self, diagonal: &mut Vector) -> Result<()> {
        self.stored.borrow().diagonal(diagonal)?;
        let mut values = diagonal.values_mut();
        let pairs = values.as_chunks_mut::<2>().0;
        self.each_row(|node, couplings| pairs[node] = [couplings[0].1[0][0], couplings[0].1[1][1]]);
        Ok(())
    }

    fn norm_infinity(&self) -> Result<f64> {
        let stored = self.stored.borrow().norm_infinity()?;
        Ok(self.strips.couplings.iter().map(Couplings::norm_infinity).fold(stored, f64::max))
    }

    fn work(&self) -> f64 {
        8.0 * (self.rows.borrow().block_count() as f64 + self.in_strips)
    }
}
