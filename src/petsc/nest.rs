//! Matrices made of two by two others.

use super::error::{Result, petsc};
use super::index_set::IndexSet;
use super::matrix::Matrix;
use super::session::Session;
use super::shell::Operator;
use super::vector::Vector;
use super::window::Window;
use std::cell::RefCell;
use std::ptr;

/// The blocks of a nest, with what shows them their parts of vectors.
struct NestProduct {
    blocks: [[Matrix; 2]; 2],
    /// Rows of the upper blocks on this rank.
    upper: usize,
    /// Of the upper and the lower parts: for factors, and for products.
    parts: RefCell<[[Window; 2]; 2]>,
}

impl Operator for NestProduct {
    fn multiply(&self, x: &Vector, y: &mut Vector) -> Result<()> {
        let (x, mut y) = (x.values(), y.values_mut());
        let ((u, lambda), (f, g)) = (x.split_at(self.upper), y.split_at_mut(self.upper));
        let [[a, b], [c, d]] = &self.blocks;
        let [[upper, upper_product], [lower, lower_product]] = &mut *self.parts.borrow_mut();
        upper.read(u, |u| {
            lower.read(lambda, |lambda| {
                upper_product.write(f, |f| a.multiply(u, f).and_then(|()| b.multiply_add(lambda, f)))?;
                lower_product.write(g, |g| c.multiply(u, g).and_then(|()| d.multiply_add(lambda, g)))
            })
        })
    }
}

impl Matrix {
    /// The matrix `[A B; C D]` of four others, which it shares: on each rank the rows of `A` come before those of `C`.
    /// Vectors from [`Matrix::create_vectors`] are plain ones, with a rank's entries in that order. **Collective**
    pub fn nest(session: &Session, blocks: [[&Matrix; 2]; 2]) -> Result<Self> {
        let mut raw = ptr::null_mut();
        let all = blocks.as_flattened().iter().map(|block| block.raw).collect::<Vec<_>>();
        petsc!(MatCreateNest(session.raw(), 2, ptr::null(), 2, ptr::null(), all.as_ptr(), &mut raw))?;
        Ok(Self::from_raw(session, raw))
    }

    /// What a nest of these blocks does to a vector, without the sums over all ranks by which a nest of PETSc's finds the parts
    /// of its vectors. It shares the blocks. **Collective**
    pub fn nest_product(session: &Session, blocks: [[&Matrix; 2]; 2]) -> Result<Self> {
        let [upper, lower] = [blocks[0][0], blocks[1][1]].map(|block| block.local_size().0);
        let parts = [
            [Window::new(session, upper)?, Window::new(session, upper)?],
            [Window::new(session, lower)?, Window::new(session, lower)?],
        ];
        let [[a, b], [c, d]] = blocks;
        let blocks = [[a.share()?, b.share()?], [c.share()?, d.share()?]];
        let product = Box::new(NestProduct { blocks, upper, parts: RefCell::new(parts) });
        Matrix::operator(session, upper + lower, upper + lower, product)
    }

    /// Another reference to the matrix: both have the same entries.
    pub fn share(&self) -> Result<Self> {
        petsc!(PetscObjectReference(self.raw.cast()))?;
        Ok(Self::from_raw(&self.session, self.raw))
    }

    /// Global row numbers of the upper and of the lower blocks.
    ///
    /// # Errors
    /// If the matrix is not a nest.
    pub fn nest_index_sets(&self) -> Result<[IndexSet; 2]> {
        let mut rows = [ptr::null_mut(); 2];
        petsc!(MatNestGetISs(self.raw, rows.as_mut_ptr(), ptr::null_mut()))?;
        let [upper, lower] =
            rows.map(|set| petsc!(PetscObjectReference(set.cast())).map(|()| IndexSet::from_raw(&self.session, set)));
        Ok([upper?, lower?])
    }
}
