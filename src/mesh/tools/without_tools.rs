//! The mesh of the bodies alone, as a file may hold it.

use crate::mesh::boundaries::Boundary;
use crate::mesh::lists::Kept;
use crate::mesh::macro_mesh::{MacroEdge, MacroMesh, MacroTriangle, NamedPoint};

impl MacroMesh {
    /// The mesh without the layers of rigid tools, which come after all bodies of the file: a case adds its own.
    pub fn without_tools(&self, is_tool: impl Fn(&str) -> bool) -> Self {
        let of_body = |triangle: &&MacroTriangle| !is_tool(&self.bodies[triangle.body as usize]);
        let own = || self.triangles.iter().filter(of_body);
        let vertices = Kept::new(self.vertices.len(), own().flat_map(|triangle| triangle.vertices));
        let edges = Kept::new(self.edges.len(), own().flat_map(|triangle| triangle.edges));
        let numbers = self.triangles.iter().zip(0..).filter(|(triangle, _)| of_body(triangle)).map(|(_, at)| at);
        let triangles = Kept::new(self.triangles.len(), numbers);
        let curve = |boundary: &Boundary| {
            let own = boundary.edges.iter().filter_map(|&edge| edges.at(edge)).collect();
            Boundary { edges: own, ..boundary.clone() }
        };
        let curves = |all: &[Boundary]| all.iter().map(curve).filter(|boundary| !boundary.edges.is_empty()).collect();
        let mut mesh = Self {
            vertices: vertices.of(&self.vertices),
            ratios: self.ratios.iter().filter_map(|(&vertex, &ratio)| Some((vertices.at(vertex)?, ratio))).collect(),
            triangles: triangles.of(&self.triangles),
            edges: edges.of(&self.edges),
            boundaries: curves(&self.boundaries),
            interfaces: curves(&self.interfaces),
            bodies: self.bodies.iter().filter(|name| !is_tool(name)).cloned().collect(),
            parts: self.parts.iter().filter(|part| !is_tool(&part.name)).cloned().collect(),
            pieces: self.pieces.iter().filter(|piece| !is_tool(&self.bodies[piece.body])).cloned().collect(),
            loose: self.loose.clone(),
            has_midsides: self.has_midsides,
            plane: self.plane,
            file: self.file.clone(),
            ..Self::default()
        };
        let kept = "a triangle that is kept keeps its corners and sides";
        for triangle in &mut mesh.triangles {
            triangle.vertices = triangle.vertices.map(|vertex| vertices.at(vertex).expect(kept));
            triangle.edges = triangle.edges.map(|edge| edges.at(edge).expect(kept));
        }
        for MacroEdge { vertices: ends, triangles: beside, .. } in &mut mesh.edges {
            *ends = ends.map(|vertex| vertices.at(vertex).expect(kept));
            *beside = beside.map(|triangle| triangle.and_then(|triangle| triangles.at(triangle)));
        }
        mesh.pieces.iter_mut().for_each(|piece| piece.first = triangles.at(piece.first).unwrap_or(piece.first));
        let point = |point: &NamedPoint| Some(NamedPoint { vertex: vertices.at(point.vertex)?, ..point.clone() });
        mesh.points = self.points.iter().filter_map(point).collect();
        mesh
    }
}

#[cfg(test)]
mod tests {
    use crate::geometry::Curve;
    use crate::mesh::curve_piece::CurvePiece;
    use crate::mesh::samples::two_blocks;

    #[test]
    fn what_is_left_without_a_tool_is_the_mesh_before_it() {
        let before = two_blocks();
        let mut mesh = before.clone();
        let against = mesh.boundary("top").expect("named").edges.clone();
        let line = CurvePiece { curve: Curve::Line([[0.2, 2.1], [1.8, 2.1]]).into(), range: [0.0, 1.0] };
        mesh.add_tool("rigid.die", &[line], &against).expect("a good surface");
        assert!(mesh.to_gmsh().contains("rigid.die"));
        assert_eq!(mesh.without_tools(|name| name == "rigid.die").to_gmsh(), before.to_gmsh());
    }
}
