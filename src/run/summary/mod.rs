//! A solution in the terms of `summary.json`.
//!
//! In comes a solution, out come the structs that the file is made of, each of them whole: `whole.rs` has what is known of all of
//! it, without the fields of the solution and by them, `contact.rs` what they say of a contact and its zones, `bodies.rs` where the
//! stress of each body is largest. Lengths, forces and energies are per thickness here. Whether any of it is to be trusted is left
//! to `verdict`.

pub(super) mod bodies;
pub(super) mod contact;
pub(super) mod whole;
