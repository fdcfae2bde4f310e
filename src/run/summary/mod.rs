//! A solution in the terms of `summary.json`.
//!
//! In comes a solution, out come the structs that the file is made of, each of them whole: `described.rs` has what is known without
//! the fields of the solution, `fields.rs` what these say of bodies and supports, `contact.rs` and `zones.rs` what they say of a
//! contact, `bodies.rs` where the stress of each body is largest. Lengths, forces and energies are per thickness here. Whether any of it is to be trusted is left to `verdict`.

pub(super) mod bodies;
pub(super) mod contact;
pub(super) mod described;
pub(super) mod fields;
mod zones;
