//! Everything on the contact boundary Γ_C; no PETSc.
//!
//! A [`Pair`] is placed between two boundaries of the mesh ([`place`]), cut into segments, and given a multiplier space
//! ([`Multipliers`]). Each body then couples to Γ_C alone ([`integrate`]), through the traces of its own boundary edges.
//!
//! # The fitted curve, and what was measured
//!
//! Where nobody declares Γ_C, `fit/meeting.rs` finds where the sides meet and `fit/bisector.rs` puts a spline half-way between them. Its
//! points come from the nodes of either side that look at the other (normals at least 120 degrees apart), and from places
//! between nodes that are far apart. Points whose normal misses a body, or meets it far from where it is nearest, are left out:
//! between round bodies with long edges they would bend the ends of the curve.
//!
//! Nodes count up to two edges beyond the ends of Γ_C, of those edges that it meets between them. With longer edges, farther
//! off, the fit was tilted by .02 between round bodies with graded edges, and the small forces of a pile were off by a fifth. A
//! span without data may be anything: a curve between graded nodes went 42 radii away, so that two points fill each span. The
//! number of spans is the smallest power of two whose mean distance from the points is at most 1.5 times the least, so that the
//! scatter of deformed nodes is not followed.
//!
//! `cases/hertz` in 60 variants (three meshes, two numbers of segments, five pairs of spaces, two loads) stands after 3 to 10
//! boundaries, most after 7. The free end of `cases/bars_parabola` comes to x = 3.9025 with 69 segments, .067 long, and to
//! 3.91003 with 140; contact ends at 3.91006.

mod contact_boundary;
mod coupling;
mod cutting;
mod drawn;
mod finite_motion;
mod fit;
mod holding;
mod jump_term;
mod multiplier;
mod pair;
mod penetration;
mod placing;
mod pressure;
mod quadrature;
#[cfg(test)]
pub(crate) mod samples;
mod sets;
mod side;
mod smooth_side;
mod trace;
mod turned_force;

pub use contact_boundary::ContactBoundary;
pub use coupling::{Distance, Entry, Integrals, declared_gap, integrate};
pub use cutting::{safe_ratio_of, segment_edge_lengths, segment_ratio};
pub use drawn::{ClosePair, CloseSide, DrawnGap, Facing, WIDEST_TURN, close_pairs, close_sides, drawn_gap};
pub use finite_motion::{FiniteMotion, GapError, Turn, finite_motion};
pub use fit::{Meeting, PointContact, hertz_width, point_contact, swings};
pub use holding::{
    Condition, Extent, Mechanism, Programme, ProgrammeOutcome, Touch, added_up, changed_forces, describe_motion, find_mechanism,
    needed_contacts, tidy,
};
pub use jump_term::{Jump, SparseRows, jump_matrix, jumps};
pub use multiplier::{DiagonalBlock, Multipliers};
pub use pair::{Configuration, CurveChoice, EndRule, GapChoice, Law, MultiplierSpace, Pair, Quadrature, SegmentRule, Stabilise};
pub use penetration::{Penetration, penetration};
pub use placing::{Known, Placed, place};
pub use pressure::{Roughness, Zone, faded_end, oscillation, recovered_peak, roughness, true_end, zone_counts};
pub use sets::{ActiveSet, SetChange, SetSolution};
pub use side::Side;
pub use smooth_side::{Displacement, SmoothSide};
pub use trace::{EdgeOverlap, Trace, edge_overlaps, trace};
pub use turned_force::{TurnedForce, turned_force, wrench};
