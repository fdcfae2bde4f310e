//! Linear solvers of the saddle point.
//!
//! `fieldsplit`: GMRES (BiCGStab on many unknowns), preconditioned from the right by the block upper triangle of
//! `K + BᵀDB` and `S = -D⁻¹`; one multigrid F-cycle stands for the inverse of the first, on the levels of the mesh and
//! auxiliary ones below (`multigrid/auxiliary`). A solve that is slow or stuck goes up a ladder of stronger ones, in the end to a
//! Cholesky factor (`ladder.rs`). `direct`: MUMPS on the plain system. All settings are PETSc options, which a user's
//! own override; only the tolerance is the case's.
//!
//! # The choices, and what was measured
//!
//! The blocks are a MatNest with fields `u` and `lambda`, reachable as `-fieldsplit_u_...` and `-fieldsplit_lambda_...`. The
//! recipe, with the measurement behind each choice (an independent prototype; example 1, 264 thousand unknowns, GMRES
//! iterations to 1e-8, P1/P0 and P2/P1 discontinuous, unless said otherwise):
//!
//! - **augment the system itself, K_γ = K + BᵀDB**: K is singular where a body floats. Augmenting only the preconditioner: 23
//!   and 25 instead of 11 and 11. Not at all: no convergence in 1000, even with an exact factor of K. Augmentation as in Benzi,
//!   Golub, Liesen 2005 and Benzi, Olshanskii 2006.
//! - **γ_i = 3 E_c/H_i, local, E_c the harmonic mean**: flat from 2 to 7 (the figures of this list are at 5); at a million
//!   unknowns on 3 ranks 13 at most for every pair of spaces, against 16 at 5; one global γ on segments graded to 2⁻⁸: 36 and
//!   45 instead of 11 and 12. With E₂/E₁ from 1e-6 to 1e6: 10 to 13.
//! - **right-preconditioned GMRES (above half a million unknowns flexible BiCGStab: 5 or 6 iterations of two cycles instead of
//!   9 or 10 of one, nine vectors instead of fifteen, a tenth less time to 1e-8 at a million unknowns), block upper triangle, S
//!   = -D⁻¹**: the true residual decides; `full` costs two cycles for one iteration less; block diagonal 28 and 35; MINRES
//!   stops too early in its own norm.
//! - **one F-cycle on K_γ, one symmetric SOR sweep**: 11 iterations at 17 thousand as at 4 million unknowns; V-cycle 15 → 24
//!   from 17 thousand to 1 million; more sweeps cost what they save; the half sweep backward before the coarse corrections of
//!   levels below the finest saves one iteration in a hundred (616 of all cases together with it, 622 without) and takes about
//!   a tenth of a solve of a million unknowns with P1 (1 to 16 % in three comparisons on a noisy machine), 3 to 16 % with P2.
//! - **a sweep keeps nothing of its forward half for the backward half, as PETSc's SOR keeps L x**: in even macro triangles
//!   opposite couplings are added first: ten multiply-adds in either half, 14 and 6 with L and U apart; on sides L is one
//!   coupling of seven; in the stored rows of bent macro triangles, where by count up to a half of the way back is saved,
//!   solves of `pin_full` (P1, 1.4 million unknowns) and `hertz_discs` (P2, 724 thousand) took .5 % longer and .4 % less,
//!   medians of seven.
//! - **what limits the iterations is shared: the cycle and S**: on `bars_inclined/even.toml`, P1/P0, one rank, the eigenvalues
//!   of the cycle alone go down to .57, the worst of them, by a two-grid analysis of K, in a macro triangle with an angle of
//!   111 degrees; those of S with an exact K_γ go down to .55. A sweep that is better in flat macro triangles (overrelaxed by
//!   2/(1 + sin α)), one more sweep of the sides, γ at 5, a pentadiagonal S⁻¹: each by itself saves one of fourteen iterations
//!   to 1e-12, or none.
//! - **unknown rigid motions, and multipliers of held means, are unknowns of the cycle (`multigrid/cycle/border.rs`)**: sweeps
//!   leave them as they are, and what solves on the coarsest level finds them. 20 bodies, half of them not round, turns held, one rank,
//!   to 1e-11: all solves on the finest mesh 73 iterations instead of 251, the run 7 s instead of 28. Two such unknowns or less, and
//!   more than 128, are left to what stands around the cycle (`bordered.rs`), as beside other preconditioners.
//! - **fine segments on every level: B_l = B_{l+1} P_{l+1}**: the F-cycle needs the variational property; aggregated ones stall
//!   or diverge once γ is 3 to 10 times as large, depending on the space.
//! - **multipliers scaled by E_c/H_i**: without, GMRES reports 1e-8 while the plain system is at 5.6e-6.
//! - **inactive multipliers stay, as identity**: same counts as dropping them; sizes, index sets and patterns survive the
//!   active-set loop.
//! - **loop at 1e-4, last solve at `tolerance`**: the right set in 10 of 10 runs; 1e-2 gives wrong ones.
//!
//! The stored rows of K_γ are assembled once with places for every coupling of Γ_C, and a change of the set writes to these
//! places alone, which are looked for once (`contact_places.rs`); where PETSc sees the rows, those
//! that change are handed to it whole. `System::set_active` adds the difference of BᵀDB on every level and writes the rows and
//! columns of the multipliers that change, no others: at a million unknowns and 500 segments one that opens takes a hundredth
//! of a millisecond, all of them less than one. Blocks, right-hand side and solver cannot belong to different sets, since
//! `System` alone changes them. Below a macro mesh of more than 3000 unknowns, that of a fine file say, come auxiliary levels:
//! their rows are Galerkin products, of which those above changed rows are made again.
//! `direct` gives the plain system, converted to AIJ, to MUMPS: the reference for the other.

mod block_triangle;
mod bordered;
mod direct;
mod field_split;
mod inf_sup;
mod ladder;
mod linear_solve;
mod linear_solver;
mod options;
mod preconditioning;
mod prepared;
mod solving;

pub use inf_sup::inf_sup;
pub use ladder::MANY;
pub use linear_solve::{LinearEnding, LinearSolve, Residual};
pub use linear_solver::LinearSolver;
pub use preconditioning::Preconditioning;
pub use solving::MOST_ROUNDING;
