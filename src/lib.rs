#![deny(unsafe_code)]
#![warn(missing_docs)]
//! mezha: contact of elastic bodies on a boundary of its own.
//!
//! # Model
//!
//! Bodies 1, 2, ... in plane strain or plane stress, or of revolution, each of one material or several: `ε = sym ∇u`,
//! `σ = C (ε - α ϑ I)`, `div σ + b = 0`; small strain, no friction. A contact pair names body 1 and body 2. Integrals are over the plane; in
//! bodies of revolution about x = 0 each has the factor `2πx`, and `ε` the hoop strain `u_x / x`.
//!
//! - `Γ_C` is a curve between the two with unit normal `n` **from body 1 to body 2**. The *corresponding points*
//!   `x⁽¹⁾`, `x⁽²⁾` of `x` on `Γ_C` are where the line through `x` along `n` meets the undeformed boundaries of the bodies.
//! - **Gap** `g = n · (x⁽²⁾ - x⁽¹⁾)` with `x⁽ⁱ⁾ = X⁽ⁱ⁾ + u⁽ⁱ⁾`: open `g > 0`, touching `0`, penetration `g < 0`; `g₀`
//!   is that of the unloaded bodies.
//! - **Multiplier** `λ = -n · σ n`, the contact pressure, positive in compression. Unilateral: `λ ≥ 0`, `g ≥ 0`,
//!   `λ g = 0`; bilateral: `g = 0`.
//!
//! The Lagrangian `½ uᵀKu - fᵀu - ∫ λ g ds` with `λ = Σ ψ_i λ_i` on the segments of `Γ_C` gives, stationary in `u` and `λ`,
//!
//! ```text
//! [ K₁   0    B₁ᵀ ] [u₁]   [f₁]
//! [ 0    K₂  -B₂ᵀ ] [u₂] = [f₂]        λ ≥ 0,  B₁u₁ - B₂u₂ ≤ c,  complementary
//! [ B₁  -B₂   0   ] [λ ]   [c ]
//!
//! [Bₖ]_ij = ∫_Γ_C ψ_i n·N_j⁽ᵏ⁾ ds        c_i = ∫_Γ_C ψ_i g₀ ds
//! ```
//!
//! Each body is coupled to `Γ_C` alone. `K` may be singular: contact may be all that holds a body.
//!
//! - **Energy** `U = ½ ∫ σ:ε`; `2U = f·u + r·u_D - λᵀc - λᵀCλ` with the reactions `r` of the supports, the prescribed
//!   `u_D`, and `C` the jump term (`Bu - Cλ = c`; zero where none is added). `external_work = f·u + r·u_D`; `balance.energy` is
//!   the difference of both sides over the largest term. `energy.stationary` is `U` again, from the Lagrangian.
//! - **Balance**: `Fₖ`, `Mₖ` are the resultants of `λ` through body k's own integrals, `Mₖ` about the middle of `Γ_C`.
//!   `balance.force = |F₁ + F₂| / |F₂|`, `balance.moment = |M₁ + M₂| / (|F₂| length)`; `balance.bodies` is what is left of
//!   loads + reactions + contact of a body, over the sum of their magnitudes.
//!
//! # Symbols
//!
//! | symbol | meaning |
//! |---|---|
//! | `E`, `ν` | Young's modulus, Poisson's ratio of a body or a part of one; `E_c = 2 / (1/E₁ + 1/E₂)` of what lies beside a segment |
//! | `K`, `B`, `C`, `f`, `c` | stiffness, coupling, multiplier block, loads, weighted initial gaps |
//! | `ψ_i`, `N_j` | shape functions of multiplier `i` and of node `j` |
//! | `H`, `h` | length of a segment, of a triangle edge |
//! | `D`, `γ`, `W` | augmentation `D = √γ W⁻¹ √γ`, `γ = α E_c / H`, multiplier mass |
//! | `s`, `t` | arc length along `Γ_C` and its parameter (the scaling of multipliers is `s_i`) |
//!
//! # References
//!
//! - The independent contact boundary: Galanin, Lukin, Solomentseva, Herald of the Bauman Moscow State Technical
//!   University, Natural Sciences, 2022, no. 6, 17-32, doi 10.18698/1812-3368-2022-6-17-32.
//! - The active set: Hintermüller, Ito, Kunisch, SIAM Journal on Optimization 13 (2002), 865-888.
//! - Augmentation of saddle points: Benzi, Golub, Liesen, Acta Numerica 14 (2005), 1-137; Benzi, Olshanskii, SIAM
//!   Journal on Scientific Computing 28 (2006), 2095-2113.
//! - Macro triangles refined regularly: Bergen, Hülsemann, *Numerical Linear Algebra with Applications* 11 (2004), 279-291;
//!   towards corners: Băcuță, Nistor, Zikatanov, Numerische Mathematik 100 (2005), 165-184.

// The floors, from the ground up: a module imports only from those above it in this list.
#[allow(unsafe_code)]
pub mod petsc;

pub mod geometry;
pub mod origin;

pub mod accuracy;
pub mod element;

pub mod mesh;

pub mod body;

pub mod contact;

pub mod discretisation;

pub mod multigrid;
pub mod programme;
pub mod recovery;

pub mod system;

pub mod procedure;

pub mod case;
pub mod output;

pub mod arguments;

pub mod run;
pub mod study;
