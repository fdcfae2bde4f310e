//! The deformed bodies, whole and where they touch.

mod deformed;
mod facets;
mod peaks;
#[cfg(test)]
mod samples;
mod stress;
mod zoom;

pub use deformed::{DeformedFigure, DrawnEdge, DrawnForce};
pub use facets::Facet;
pub use stress::stress_file;
pub use zoom::ContactZoom;
