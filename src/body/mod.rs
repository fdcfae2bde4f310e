//! Bodies: mesh, material, supports and loads.

mod applied_force;
mod constraint;
mod formula_check;
mod holders;
mod macro_stiffness;
mod mean_hold;
mod node_positions;
mod rigid;
mod singular_place;
mod springs;

pub use applied_force::{Applied, applied_forces, body_forces, heat_forces};
pub use constraint::{Constraint, Constraints};
pub use formula_check::{check_body_forces, check_loads, varies};
pub use holders::Holders;
pub use macro_stiffness::{MacroStiffness, neighbours, one_stiffness};
pub use mean_hold::{Anchor, HeldMode, MeanHold};
pub use node_positions::{NodePositions, check_folding, positions, positions_of_one};
pub use rigid::{MOTIONS, Motion, RigidNodes, RigidSet, UNIT_MOTIONS, rigid_displacement};
pub use singular_place::{CHORDS, SingularPlace, Unbounded, singular_places};
pub use springs::{SpringStiffness, Springs};

use crate::element::{Heat, Plane, PlaneLaw};
use crate::geometry::{AXES, Formula, Point};
use crate::mesh::Spot;

/// Linear elastic material, and what is zero across the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// Young's modulus E > 0 (stress).
    pub young: f64,
    /// Poisson's ratio ν, -1 < ν < 0.5; 0.5 too in plane stress.
    pub poisson: f64,
    /// Plane strain, plane stress, or a body of revolution.
    pub plane: Plane,
}

impl Material {
    /// Law of the material in the plane.
    pub fn law(&self) -> PlaneLaw {
        PlaneLaw::new(self.young, self.poisson, self.plane)
    }

    /// Ratio by which elements lock in the plane: the one that has the same law in plane strain. It is at most 1/3 in plane
    /// stress.
    pub fn poisson_in_plane(&self) -> f64 {
        match self.plane {
            Plane::Strain | Plane::Revolution => self.poisson,
            Plane::Stress => self.poisson / (1.0 + self.poisson),
        }
    }

    /// Stress by strain of a half-plane, `E` in plane stress and `E / (1 - ν²)` elsewhere: beside a contact that is small against
    /// its radius a body of revolution is as in plane strain.
    pub fn plane_modulus(&self) -> f64 {
        match self.plane {
            Plane::Strain | Plane::Revolution => self.young / (1.0 - self.poisson * self.poisson),
            Plane::Stress => self.young,
        }
    }
}

/// A body: what hangs together, of one material or several.
#[derive(Clone, Debug)]
pub struct Body {
    /// Name in the case file.
    pub name: String,
    /// Parts of the body: one of the same name, unless the case gives parts.
    pub parts: Vec<BodyPart>,
}

/// Stiffnesses that differ by no more make powers of the distance below .001 where they meet (.034 for 1 : 2; Bogy 1971).
const ALIKE: f64 = 0.01;

/// A part of a body: one physical surface of the mesh.
#[derive(Clone, Debug)]
pub struct BodyPart {
    /// Name of the physical surface.
    pub name: String,
    /// Material of the part.
    pub material: Material,
    /// Force per area, formulas of `x, y`.
    pub force: [Formula; 2],
    /// What it is heated by.
    pub heat: Option<Heat>,
}

impl BodyPart {
    /// Whether next to nothing jumps between it and another part: materials of one stiffness, and one heat.
    pub fn is_alike(&self, other: &Self) -> bool {
        let [a, b] = [&self.material, &other.material];
        let is_one = (a.young - b.young).abs() <= ALIKE * a.young.max(b.young) && (a.poisson - b.poisson).abs() <= ALIKE;
        is_one && a.plane == b.plane && self.heat == other.heat
    }

    /// Whether forces act all over it: a force per area, or heat.
    pub fn is_loaded(&self) -> bool {
        self.heat.is_some() || self.force.iter().any(|formula| !formula.is_zero())
    }

    /// The formulas that are integrated over it.
    pub fn formulas(&self) -> impl Iterator<Item = &Formula> {
        self.force.iter().chain(self.heat.as_ref().map(|heat| &heat.temperature))
    }
}

impl Body {
    /// A body of one material.
    pub fn whole(name: String, material: Material, force: [Formula; 2]) -> Self {
        Self { name: name.clone(), parts: vec![BodyPart { name, material, force, heat: None }] }
    }

    /// Whether the case gives parts of it.
    pub fn has_parts(&self) -> bool {
        self.parts.iter().any(|part| part.name != self.name)
    }

    /// What the case calls one of its parts.
    pub fn key_of(&self, part: &BodyPart) -> String {
        if part.name == self.name { format!("body.{}", self.name) } else { format!("body.{}.part.{}", self.name, part.name) }
    }
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

impl Support {
    /// The axes along which it prescribes a component, with the formulas of these.
    pub fn axes(&self) -> impl Iterator<Item = (&Formula, Point)> {
        [&self.ux, &self.uy].into_iter().zip(AXES).filter_map(|(formula, axis)| Some((formula.as_ref()?, axis)))
    }
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
    /// Force per thickness, or of the whole ring in a body of revolution, formulas of `x, y`.
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
