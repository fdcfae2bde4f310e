//! The stiffness of the bodies on each level: rows that are stored, and those inside of even macro triangles or among straight ones, which
//! need not be.
//!
//! # Rows that are not stored
//!
//! Inside a straight macro triangle that is refined evenly all small triangles are translations of one another and of its reflection,
//! so the couplings of its nodes repeat: 7 blocks of 2 × 2 for P1, for P2 two alternating rows of 13 and 7 and of 7 and 7. The rows of such
//! nodes are never assembled:
//!
//! ```text
//! \
//! | \          o   on a side: stored, with contact and supports
//! o   o
//! |     \      =   inside: the couplings of one node stand for all
//! o  =    o
//! |         \
//! o  =  =    o
//! |            \
//! o--o--o--o--o--o
//! ```
//!
//! An even macro triangle of 8 intervals or more (P2: 16) is worked on as a whole (`triangle_lattice.rs`,
//! `stiffness/even_triangles.rs`), several of them side by side: a vector register holds the same node of two or four of
//! them, as the processor allows. Their values, with those of their sides, come into a lattice, which up to
//! some 128 intervals stays in the cache, and where neighbours lie at fixed distances, and the inner nodes go back when they
//! are done. Nodes of different macro triangles do not wait for each other in a sweep, so registers are as full on a lattice of
//! eight intervals as on one of 128, and each macro triangle may have couplings of its own. Residuals are restricted in that
//! lattice, and never stored. Only the nodes of macro edges and vertices have stored rows: at 128 intervals 2 % of all.
//!
//! A lattice of any size is one such triangle. A kernel along the rows of lattices, for those that do not fit into the cache and for
//! the affine pieces of graded macro triangles, saved nothing but on the finest: medians of three in turn, two ranks, example 1:
//! P2 graded, 0.92 million unknowns 2.11 s with it, 2.01 s without, 3.7 million 7.92 and 7.70 s; P1, lattices of 256 intervals,
//! 4.2 million unknowns 3.35 and 3.40 s; of 512, 16.8 million, one run each, 11.4 and 12.7 s.
//!
//! A mesh that is not cut up, as a fine one of Gmsh's, has no such lattices. Of its straight P2 triangles two gradients are kept, and nodes
//! that have none but these around them, all free and of one rank, have no stored rows either, if they do not lie on a boundary, where
//! contact adds to rows: products go through the triangles (`straight_triangles.rs`), and sweeps have rows of their own in single
//! precision. A million triangles, 4.0 million unknowns, bytes for each unknown: 393 on one rank, 445 on two. With all rows stored 655
//! instead of 416 and 746 instead of 481, before vectors and tables of the mesh took less. Whole runs in turn, medians: 9.2 and 6.9 s, with
//! all rows stored 11.3 and 8.2 s, for there are fewer pages to write, and couplings that are zero are left out.
//!
//! Graded and bent macro triangles store all of their rows, as do those of bodies of revolution, whose rings differ. Interpolation is
//! treated alike: whole macro triangles from lattice to lattice (`interpolation/whole.rs`), of others a fine inner row from two
//! coarse ones (`HalvedRow`), the other nodes one by one.
//!
//! Stored rows are mezha's own, too: blocks of 2 × 2 in compressed rows of the nodes that do not lie inside of
//! whole macro triangles, so that nothing is kept for the others. A rank makes the whole rows of its own nodes: it goes through
//! its macro triangles, and through those of other ranks that share a side or a corner with them, of which only the small
//! triangles at the sides are integrated. So nothing is sent, and every sum is made by ascending macro triangles, whatever the
//! ranks. A contact boundary that moves gets a copy in which the rows of Γ_C alone are widened; the even macro triangles are shared.
//!
//! A sweep over whole macro triangles relaxes a node of several of them at once. The instructions (AVX-512, AVX2
//! with multiply-add, or none) are asked for at run time by `pulp`, so that no code of ours is `unsafe`. The nodes on sides of
//! macro triangles come first, those that need no node of another rank before the others: meanwhile the values of other ranks
//! arrive. A level without lattices, as a fine mesh of Gmsh's has, is swept in the order of its nodes, by its couplings in single
//! precision, of which sweeps and residuals read no more than they need (`sweep_rows.rs`); an auxiliary one likewise,
//! but in double precision. On other levels
//! each macro triangle then goes forward and backward while it is in the cache, as no macro triangle couples to another; then the
//! sides again.
//!
//! The cycle (`multigrid/cycle`) works on these rows directly. It is PETSc's preconditioner of field `u` as a shell, so that the
//! MatNest, fieldsplit and the Krylov method around it are PETSc's. Fieldsplit copies the parts of its vectors some ten times;
//! where no option of the user's begins with `-pc_` or `-fieldsplit_`, its function is replaced by one that does the same
//! without copies (`system/solver/block_triangle.rs`, `petsc::ReplacedAction`; it needs PETSc's `private/pcimpl.h`, which PETSc
//! installs), while its kind, parts and set-up stay. Levels of up to 3000 unknowns are on one rank, larger ones on one of every
//! 2, 4, 8, … ranks, so that each of these has about a thousand unknowns or more (`discretisation/levels.rs`); the finest stays on all.
//! From the first level on one rank downwards nothing is sent, and that rank solves the coarsest with a factor
//! (`cycle/coarsest.rs`). Where the macro mesh is larger, auxiliary levels follow below it, with stored rows like its own. All messages go from neighbour to neighbour, and are under way while even macro triangles, or the first sides of a
//! sweep, are worked on. The product of the saddle point is a shell, too (`nest_product`): PETSc's nest finds the parts of its
//! vectors by a sum over all ranks, four in each product. So an iteration of GMRES has two sums over all ranks for its inner
//! products (one of BiCGStab four, for two cycles), and no other collective; `tests/messages.rs` counts them. Only where the cycle
//! finds rigid motions, too, each visit of a level has one, and where steps of CG smooth, each of these has two.
//!
//! PETSc sees a level as a shell (`petsc::Operator`): its product and its norm. Where a preconditioner of PETSc's is asked for
//! (`-fieldsplit_u_pc_type hypre`), it sees a matrix with all rows of the finest level, made from the same storage and changed along
//! with it. Where a factorisation wants one (the last rung of the ladder of solvers, the inf-sup constant), it is made first. Contact
//! changes stored rows alone: nodes of Γ_C lie on sides of macro triangles.
//! After the stencils of hierarchical hybrid grids (Bergen, Hülsemann 2004).
//!
//! On every level the stiffness is assembled from its own elements, and edges between materials are macro edges, so that
//! multigrid sees jumps of the modulus as the finest mesh does: on `cases/rings_bonded` a core that is a thousand times softer
//! or harder than the ring around it changes no solve by more than a few iterations.

mod assembly;
mod block_lanes;
mod couplings;
mod elastic;
mod even_triangles;
mod expanded;
mod lanes;
mod lattice_operator;
mod lattice_rows;
mod pattern;
mod registers;
mod row_kernel;
mod row_stencil;
mod stored_rows;
mod straight_triangles;
mod sweep_order;
mod sweep_rows;
mod triangle_kernel;

pub use elastic::{Elastic, takes_another_preconditioner};
pub use lattice_operator::LatticeOperator;
pub use stored_rows::{BlockPlace, Part, StoredRows};
pub use sweep_order::SweepHalves;
pub use sweep_rows::SweepRows;

use crate::discretisation::SystemError;
use crate::element::Block;
use crate::petsc::{Matrix, Session};
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

/// Nodes that contact couples to each node.
pub type ContactNeighbours = BTreeMap<usize, BTreeSet<usize>>;

/// Where some couplings of a stored row lie.
#[derive(Clone, Copy)]
pub struct RowPlaces<'a> {
    /// The row.
    pub stored: u32,
    /// Whether its diagonal block is to be inverted again: nothing more is added to it.
    pub is_last: bool,
    /// The places of the couplings.
    pub blocks: &'a [BlockPlace],
}

/// What solvers of PETSc's see of a stiffness.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum SolverView {
    /// What it does: a shell.
    Action,
    /// All its rows, in a matrix of PETSc's.
    Entries,
}

/// `K`, or `K + Bᵀ D B`, of one level.
pub struct Stiffness {
    lattice: Rc<LatticeOperator>,
    matrix: Matrix,
    seen: SolverView,
    /// Stored rows that have been added to since the matrix had its entries, each perhaps several times.
    changed: Vec<u32>,
}

impl Stiffness {
    /// From its rows. **Collective**
    fn new(lattice: LatticeOperator, seen: SolverView, session: &Session) -> Result<Self, SystemError> {
        let (unknowns, lattice) = (2 * lattice.own.len(), Rc::new(lattice));
        let mut matrix = match seen {
            SolverView::Action => Matrix::operator(session, unknowns, unknowns, Box::new(lattice.clone()))?,
            SolverView::Entries => lattice.expanded(session)?,
        };
        matrix.set_positive_definite(true)?;
        Ok(Self { lattice, matrix, seen, changed: Vec::new() })
    }

    /// What solvers see.
    pub fn operator(&self) -> &Matrix {
        &self.matrix
    }

    /// Its rows.
    pub fn lattice(&self) -> &Rc<LatticeOperator> {
        &self.lattice
    }

    /// Adds blocks to the couplings of a node of contact, one of this rank's. Holds after [`Stiffness::assemble`].
    pub fn add_to_row(&mut self, places: RowPlaces, blocks: &[Block]) {
        self.lattice.add_to_row(places, blocks);
        if self.seen == SolverView::Entries {
            self.changed.push(places.stored);
        }
    }

    /// Makes added blocks hold. **Collective**
    pub fn assemble(&mut self) -> Result<(), SystemError> {
        self.changed.sort_unstable();
        self.changed.dedup();
        self.lattice.renew(self.changed.drain(..), &mut self.matrix)?;
        // Of a shell PETSc is told that values have changed. It forgets what else it knew.
        self.matrix.assemble()?;
        Ok(self.matrix.set_positive_definite(true)?)
    }

    /// A copy with places for the couplings of a contact boundary. **Collective**
    fn with_places(&self, neighbours: &ContactNeighbours, session: &Session) -> Result<Self, SystemError> {
        Self::new(self.lattice.with_places(neighbours, session), self.seen, session)
    }

    /// With all its rows in a matrix of PETSc's, as factorisations want it; `None` if that is what solvers see. **Collective**
    pub fn expanded(&self, session: &Session) -> Result<Option<Matrix>, SystemError> {
        match self.seen {
            SolverView::Entries => Ok(None),
            SolverView::Action => Ok(Some(self.lattice.expanded(session)?)),
        }
    }
}
