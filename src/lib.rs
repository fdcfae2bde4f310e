#![deny(unsafe_code)]
#![warn(missing_docs)]
//! mezha: contact of elastic bodies on a boundary of its own.

// The floors, from the ground up: a module imports only from those above it in this list.
#[allow(unsafe_code)]
pub mod petsc;

pub mod geometry;

pub mod element;

pub mod mesh;

pub mod body;

pub mod contact;

pub mod system;

pub mod case;
pub mod output;

pub mod arguments;

pub mod run;
pub mod study;
