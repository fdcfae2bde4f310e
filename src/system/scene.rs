//! The physics that is solved: mesh, bodies, supports, loads and contacts, spread over ranks.

use crate::body::{Body, Load, Support};
use crate::contact::{Extent, Pair};
use crate::element::{Order, PlaneStrain};
use crate::geometry::Point;
use crate::mesh::{MacroMesh, Partition};
use std::rc::Rc;

/// Everything that defines the system, the same on every rank. Copies share the mesh.
#[derive(Clone)]
pub struct Scene {
    /// The macro mesh, bent onto its geometries.
    pub mesh: Rc<MacroMesh>,
    /// Which rank owns what.
    pub partition: Rc<Partition>,
    /// Displacement elements.
    pub order: Order,
    /// Refinements of the macro mesh.
    pub refine: usize,
    /// Bodies, in the order of the mesh.
    pub bodies: Vec<Body>,
    /// Supports.
    pub supports: Vec<Support>,
    /// Loads.
    pub loads: Vec<Load>,
    /// Contact pairs.
    pub pairs: Vec<Pair>,
}

impl Scene {
    /// The same scene on a mesh that is `times` refinements coarser, with as many segments less.
    pub fn coarser(&self, times: usize) -> Self {
        let pairs = self.pairs.iter().map(|pair| pair.coarser(times)).collect();
        Self { refine: self.refine - times, pairs, ..self.clone() }
    }

    /// Plane-strain law of each body.
    pub fn laws(&self) -> Vec<PlaneStrain> {
        self.bodies.iter().map(|body| body.material.law()).collect()
    }

    /// Middle and half size of each piece of the bodies.
    pub fn extents(&self) -> Vec<Extent> {
        let extent = |[low, high]: [Point; 2]| Extent { middle: 0.5 * (low + high), radius: 0.5 * (high - low).norm() };
        self.mesh.bounds().into_iter().map(extent).collect()
    }
}
