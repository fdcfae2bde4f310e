//! Bodies: mesh, material, supports and loads.

mod applied_force;
mod constraint;
mod macro_stiffness;
mod rigid;
mod springs;

pub use applied_force::{Applied, applied_forces};
pub use constraint::{Constraint, Constraints, Holders, SupportError};
pub use macro_stiffness::{MacroStiffness, neighbours, positions};
pub use rigid::{MOTIONS, Motion, RigidNodes, RigidSet};
pub use springs::{SpringStiffness, Springs};

use crate::element::PlaneStrain;
use crate::geometry::{Formula, Point};
use crate::mesh::Spot;

/// Linear elastic material in plane strain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// Young's modulus E > 0 (stress).
    pub young: f64,
    /// Poisson's ratio ν, -1 < ν < 0.5.
    pub poisson: f64,
}

impl Material {
    /// Its law in plane strain.
    pub fn law(&self) -> PlaneStrain {
        PlaneStrain::new(self.young, self.poisson)
    }
}

/// A body: one physical surface of the mesh.
#[derive(Clone, Debug)]
pub struct Body {
    /// Name of the physical surface.
    pub name: String,
    /// Material of the whole body.
    pub material: Material,
    /// Force per area, formulas of `x, y`.
    pub force: [Formula; 2],
}

/// Prescribed displacement components on physical curves, or at a point.
#[derive(Clone, Debug)]
pub struct Support {
    /// Name in the case file.
    pub name: String,
    /// Physical curves it acts on.
    pub on: Vec<String>,
    /// Instead of curves the point that it acts on.
    pub at: Option<Spot>,
    /// Prescribed component `u_x`, a formula of `x, y`.
    pub ux: Option<Formula>,
    /// Prescribed component `u_y`.
    pub uy: Option<Formula>,
    /// Prescribed outward normal component; the tangent stays free.
    pub normal: Option<Formula>,
}

/// Surface load on physical curves.
#[derive(Clone, Debug)]
pub struct Load {
    /// Name in the case file.
    pub name: String,
    /// Physical curves it acts on.
    pub on: Vec<String>,
    /// What acts there.
    pub kind: LoadKind,
}

/// A force at a point of a body.
#[derive(Clone, Debug)]
pub struct PointLoad {
    /// Name in the case file.
    pub name: String,
    /// Where it acts.
    pub at: Spot,
    /// Force per thickness, formulas of `x, y`.
    pub force: [Formula; 2],
}

impl PointLoad {
    /// The force at its point.
    pub fn force(&self) -> Point {
        let x = &self.at.place;
        Point::new(self.force[0].value(x), self.force[1].value(x))
    }
}

/// Kinds of surface load; formulas of `x, y`.
#[derive(Clone, Debug)]
pub enum LoadKind {
    /// Pressure > 0 pushes onto the body.
    Pressure(Formula),
    /// Traction in global axes.
    Traction([Formula; 2]),
}
