//! What a mesh file says, before it is checked and connected.

use super::FilePlace;
use super::curve_piece::LooseCurve;
use super::lists::Kept;
use crate::geometry::Point;
use std::collections::{HashMap, HashSet};

/// What a mesh file says, before it is checked, each with its place in the file.
#[derive(Default)]
pub(super) struct RawMesh {
    pub vertices: Vec<Point>,
    pub triangles: Vec<RawTriangle>,
    /// Names of physical surfaces that triangles have together.
    pub names: Vec<Vec<String>>,
    pub lines: Vec<(String, [u32; 2], FilePlace)>,
    /// Physical curves that bound no body, once the points that no triangle uses are left out.
    pub loose: Vec<LooseCurve>,
    /// Midside nodes of second-order elements, with the ends of their sides, lower first; one of an inner side comes twice.
    pub midsides: Vec<([u32; 2], Point)>,
    /// Names of bodies, by the physical surfaces that are parts of them; other surfaces are bodies of their own.
    pub joined: HashMap<String, String>,
}

/// A triangle of the file.
#[derive(Clone, Copy)]
pub(super) struct RawTriangle {
    pub corners: [u32; 3],
    /// Place of its names among [`RawMesh::names`].
    pub names: u32,
    pub place: FilePlace,
}

impl RawMesh {
    /// The number of names that triangles have together.
    pub fn number_of(&mut self, names: Vec<String>) -> u32 {
        let known = self.names.iter().position(|known| *known == names);
        known.unwrap_or_else(|| {
            self.names.push(names);
            self.names.len() - 1
        }) as u32
    }

    /// Leaves out the points of the geometry that no triangle uses (centres of circles, say), and the curves that have no others.
    pub fn drop_loose_vertices(&mut self) {
        let kept = Kept::new(self.vertices.len(), self.triangles.iter().flat_map(|triangle| triangle.corners));
        self.leave_out_curves(&kept);
        self.vertices = kept.of(&self.vertices);
        // A line whose end no triangle uses keeps an index that no edge has, and is refused with words.
        let ends = self.lines.iter_mut().flat_map(|(_, ends, _)| ends).chain(self.midsides.iter_mut().flat_map(|(ends, _)| ends));
        ends.chain(self.triangles.iter_mut().flat_map(|triangle| &mut triangle.corners))
            .for_each(|end| *end = kept.at(*end).unwrap_or(u32::MAX));
    }

    /// Sets aside the curves that have no line between two nodes that are `kept`.
    fn leave_out_curves(&mut self, kept: &Kept) {
        let joins_triangles = |ends: &[u32; 2]| ends.iter().all(|&end| kept.at(end).is_some());
        let bound: HashSet<String> =
            self.lines.iter().filter(|(_, ends, _)| joins_triangles(ends)).map(|(name, ..)| name.clone()).collect();
        for (name, ends, _) in self.lines.extract_if(.., |(name, ..)| !bound.contains(name)) {
            let line = ends.map(|end| self.vertices[end as usize]);
            match self.loose.iter_mut().find(|curve| curve.name == name) {
                Some(curve) => curve.lines.push(line),
                None => self.loose.push(LooseCurve { name, lines: vec![line] }),
            }
        }
    }
}
