//! The elements of a macro triangle on the finest level: the small triangles of its lattice.

use crate::body::{NodePositions, positions, positions_of_one};
use crate::discretisation::field::Field;
use crate::discretisation::levels::Discretisation;
use crate::element::{Heat, PlaneLaw};
use crate::geometry::Point;
use crate::mesh::Level;
use crate::mesh::lattice::{self, Triangle};

/// An element with `N` nodes: its corners counter-clockwise, then its midsides.
pub struct Element<const N: usize> {
    /// Which of the lattice it is.
    pub small: Triangle,
    /// Numbers of its nodes.
    pub nodes: [usize; N],
    /// Where they lie, undeformed (length).
    pub x: [Point; N],
}

/// A macro triangle that is straight and even, with displacements: its elements are one triangle and the point reflections of that.
pub struct EvenTriangle<const N: usize> {
    /// Where the nodes of the first element lie, undeformed (length).
    pub x: [Point; N],
    level: Level,
    /// Row by row.
    displacements: Vec<Point>,
}

impl<const N: usize> EvenTriangle<N> {
    /// Places of the nodes of each element in the lattice, row by row, their displacements, and the sign that slopes by x and y have
    /// there beside those on the first element.
    #[inline]
    pub fn each(&self, mut show: impl FnMut([usize; N], [Point; N], f64)) {
        for small in lattice::triangles(self.level.intervals, self.level.order) {
            let at = small.nodes::<N>().map(|(i, j)| lattice::index(self.level.intervals, i, j));
            show(at, at.map(|node| self.displacements[node]), if small.down { -1.0 } else { 1.0 });
        }
    }
}

impl Discretisation {
    /// A macro triangle with displacements, if it is straight and even, and no body of revolution.
    pub fn even_triangle<const N: usize>(&self, triangle: usize, u: &Field<2>) -> Option<EvenTriangle<N>> {
        let (mesh, level) = (&self.scene.mesh, self.finest().numbering.level);
        if level.is_one_triangle() || mesh.is_graded(triangle) || !mesh.repeats(triangle) {
            return None;
        }
        let x = self.element(triangle, Triangle::at(0, 0, level.order)).x;
        Some(EvenTriangle { x, level, displacements: self.on_lattice(triangle, u) })
    }

    /// Displacements at the nodes of a macro triangle, row by row.
    pub fn on_lattice(&self, triangle: usize, u: &Field<2>) -> Vec<Point> {
        let numbering = &self.finest().numbering;
        let numbers = numbering.triangle(&self.scene.mesh, triangle);
        lattice::nodes(numbering.level.intervals).map(|(i, j)| u.point(numbers.node(i, j))).collect()
    }

    /// The law of a macro triangle, and what heats it.
    pub fn material(&self, triangle: usize) -> (PlaneLaw, Option<&Heat>) {
        let part = self.scene.part(self.scene.mesh.triangles[triangle].part as usize);
        (part.material.law(), part.heat.as_ref())
    }

    /// Shows all elements of a macro triangle, in the order of the lattice.
    ///
    /// # Errors
    /// The first one of `show`.
    #[inline]
    pub fn each_element<const N: usize, E>(
        &self,
        triangle: usize,
        mut show: impl FnMut(&Element<N>) -> Result<(), E>,
    ) -> Result<(), E> {
        let (mesh, numbering) = (&self.scene.mesh, &self.finest().numbering);
        let (level, numbers) = (numbering.level, numbering.triangle(mesh, triangle));
        if level.is_one_triangle() {
            let small = Triangle::at(0, 0, level.order);
            return show(&Element { small, nodes: numbers.of_one(), x: positions_of_one(mesh, triangle, level) });
        }
        let all = NodePositions::new(mesh, triangle, level);
        lattice::triangles(level.intervals, level.order).try_for_each(|small| {
            let at = small.nodes::<N>();
            show(&Element { small, nodes: at.map(|(i, j)| numbers.node(i, j)), x: all.of(&at) })
        })
    }

    /// One element of a macro triangle.
    pub fn element<const N: usize>(&self, triangle: usize, small: Triangle) -> Element<N> {
        let (mesh, numbering, at) = (&self.scene.mesh, &self.finest().numbering, small.nodes::<N>());
        let numbers = numbering.triangle(mesh, triangle);
        Element { small, nodes: at.map(|(i, j)| numbers.node(i, j)), x: positions(mesh, triangle, numbering.level, &at) }
    }
}

impl Field<2> {
    /// Displacements at the nodes of an element.
    #[inline]
    pub fn on<const N: usize>(&self, element: &Element<N>) -> [Point; N] {
        element.nodes.map(|node| self.point(node))
    }
}
