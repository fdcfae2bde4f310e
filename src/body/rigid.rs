//! Nodes that move together as a rigid body: those of a rigid tool, or of a boundary under a stiff plate.

use crate::geometry::Point;
use crate::mesh::{EdgeNode, MacroMesh, Numbering, each_once};
use std::collections::BTreeMap;

/// A rigid motion of small angle: shift along x and y (length), and turn about the reference point (radians).
pub type Motion = [f64; 3];

/// The motions of one component each.
pub const UNIT_MOTIONS: [Motion; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// Displacement at a point by a rigid motion: shifts along x and y, and the turn about a point.
pub fn rigid_displacement(about: Point, [along, up, turn]: &Motion, x: Point) -> Point {
    let arm = x - about;
    Point::new(along - turn * arm.y, up + turn * arm.x)
}

/// Which nodes move together.
#[derive(Clone, Debug, PartialEq)]
pub enum RigidNodes {
    /// The nodes on all macro edges of a body; what lies within its triangles follows.
    Body(String),
    /// The nodes on physical curves.
    Boundaries(Vec<String>),
}

/// Nodes that move together as a rigid body, and what is known of their motion.
#[derive(Clone, Debug, PartialEq)]
pub struct RigidSet {
    /// Key of the set in the case file, as in `rigid.die`.
    pub key: String,
    /// Nodes of the set.
    pub nodes: RigidNodes,
    /// Reference point, which it turns about.
    pub about: Point,
    /// Components of its motion that are prescribed; the others follow from its balance.
    pub prescribed: [Option<f64>; 3],
    /// Force, and moment about the reference point, that act on it (force per thickness, its moment).
    pub applied: [f64; 3],
}

impl RigidSet {
    /// Whether it is held where it is.
    pub fn stays(&self) -> bool {
        self.prescribed == [Some(0.0); 3]
    }

    /// The set where it can move along the axis of revolution alone.
    pub fn along_axis(self) -> Self {
        let [_, along, _] = self.prescribed;
        Self { prescribed: [Some(0.0), along, Some(0.0)], ..self }
    }

    /// Displacement at a point when component `k` of the motion is one.
    pub fn mode(&self, k: usize, x: Point) -> Point {
        rigid_displacement(self.about, &UNIT_MOTIONS[k], x)
    }

    /// Displacement at a point.
    pub fn displacement(&self, motion: &Motion, x: Point) -> Point {
        rigid_displacement(self.about, motion, x)
    }

    /// Motion of the set where every component that is not prescribed is zero.
    pub fn prescribed_motion(&self) -> Motion {
        self.prescribed.map(|component| component.unwrap_or(0.0))
    }

    /// Components of the motion that are unknown.
    pub fn free(&self) -> impl Iterator<Item = usize> + use<> {
        let prescribed = self.prescribed;
        (0..3).filter(move |&k| prescribed[k].is_none())
    }

    /// Macro edges on which its nodes lie, each once.
    pub fn edges(&self, mesh: &MacroMesh) -> Vec<u32> {
        match &self.nodes {
            RigidNodes::Body(name) => {
                let own = mesh.triangles.iter().filter(|triangle| mesh.bodies[triangle.body as usize] == *name);
                each_once(own.flat_map(|triangle| triangle.edges))
            }
            RigidNodes::Boundaries(names) => each_once(mesh.edges_on(names)),
        }
    }

    /// Numbers and places of its nodes on a level, the same on every rank.
    pub fn places(&self, mesh: &MacroMesh, numbering: &Numbering) -> BTreeMap<usize, Point> {
        let mut places = BTreeMap::new();
        for node in self.edges(mesh).into_iter().flat_map(|edge| EdgeNode::along(edge, numbering.level)) {
            places.entry(node.number(mesh, numbering)).or_insert_with(|| node.place(mesh, numbering));
        }
        places
    }
}

/// Shifts and turns of rigid sets in words, as errors name them.
pub const MOTIONS: [&str; 3] = ["ux", "uy", "angle"];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_motion_is_the_sum_of_its_modes_and_strains_nothing() {
        let set = RigidSet {
            key: "rigid.die".into(),
            nodes: RigidNodes::Boundaries(Vec::new()),
            about: Point::new(2.0, -1.0),
            prescribed: [Some(0.5), None, None],
            applied: [0.0; 3],
        };
        let motion = [0.3, -0.2, 1e-3];
        let (a, b) = (Point::new(0.4, 0.7), Point::new(-3.0, 2.5));
        let [u, v] = [a, b].map(|x| set.displacement(&motion, x));
        assert!((v - u).dot(&(b - a)).abs() < 1e-15, "the distance of two points stays");
        assert_eq!(set.displacement(&motion, set.about), Point::new(0.3, -0.2));
        assert_eq!((set.prescribed_motion(), set.free().collect::<Vec<_>>()), ([0.5, 0.0, 0.0], vec![1, 2]));
    }
}
