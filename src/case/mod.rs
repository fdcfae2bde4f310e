//! The case file: TOML text to checked values.
//!
//! In come the path of a case file and overrides `KEY=VALUE`; out comes a [`Case`], or everything that is wrong at once, each with
//! file, key, value and remedy. What is checked here needs no mesh, but for names that are patterns.
//!
//! | room | what it does |
//! |---|---|
//! | `file` | text, overrides, fingerprints, errors in words |
//! | `keys` | the language of tables of keys, and sections read with it |
//! | `bodies`, `acting`, `contact`, `asked` | the keys and readers of each section |
//! | `schema` | the tables of whole files, JSON Schema, documentation |
//! | `patterns` | names with `*` and `?`, written out |
//! | `reading.rs`, `model.rs` | all sections together, and the case that comes of them |
//!
//! - A key is declared once, beside its reader.
//! - Every section is read before the case is refused, and problems come in the order in which they are found.
//! - The table of a case is its file with overrides, patterns and defaults written out: read again, it is an equal case.

mod acting;
mod asked;
mod bodies;
mod contact;
mod file;
mod keys;
mod model;
mod patterns;
mod reading;
pub mod schema;

pub use acting::mean::{MeanSupport, MeanWay};
pub use acting::rigid::{Plate, Tool};
pub use asked::accuracy::NO_CONTACT;
pub use asked::exact::{BodyExact, ContactExact, Exact, Expected, ExpectedAt, LambdaExact};
pub use asked::output::{Output, UnitNames};
pub use asked::solver::Solver;
pub use asked::steps::LoadFactor;
pub use bodies::geometry::Geometry;
pub use bodies::mesh::{Grade, MOST_REFINE, MeshChoice};
pub use contact::sides::Union;
pub(crate) use file::error::listed;
pub use file::error::{CaseError, Problem};
pub use file::fingerprint::{Inputs, fingerprint, sha256};
pub(crate) use file::text::{name_of, read_text};
pub(crate) use file::{error, overrides};
pub use keys::Choice;
pub(crate) use keys::{section, values};
pub use model::{Case, LoadStep};
pub use patterns::Matched;

#[cfg(test)]
mod tests;
