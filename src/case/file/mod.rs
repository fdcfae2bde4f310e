//! The file of a case or a study: its text, and what the command line changes of it.
//!
//! In come the path and overrides `KEY=VALUE`; out come a table of TOML, fingerprints of the bytes, and errors in words, each with
//! file, key, value and remedy. Nothing here knows
//! which keys there are. The log of what is found while the table is read begins here, with what is wrong with the overrides.

pub mod error;
pub mod fingerprint;
pub mod overrides;
pub mod text;
