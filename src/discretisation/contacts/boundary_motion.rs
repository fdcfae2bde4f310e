//! Displacements of the nodes on contact boundaries, known to all ranks.

use crate::discretisation::scene::Scene;
use crate::discretisation::space::Space;
use crate::geometry::Point;
use crate::mesh::{EdgeNode, MacroMesh};
use crate::petsc::Session;
use std::collections::HashMap;

/// Displacement of every node on a boundary that some contact names, `O(√N)` numbers; none is a body at rest.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BoundaryMotion {
    displacement: HashMap<usize, Point>,
}

impl BoundaryMotion {
    /// Each rank gives those of its nodes, from its unknowns in the nodes' frames. **Collective**
    pub fn new(scene: &Scene, space: &Space, unknowns: &[f64], session: &Session) -> Self {
        let mesh = &scene.mesh;
        let (mut keys, mut values) = (Vec::new(), Vec::new());
        for node in contact_nodes(scene, space).map(|node| node.number(mesh, &space.numbering)).filter(|n| space.own.contains(n))
        {
            let at = 2 * (node - space.own.start);
            let u = space.to_global(node, Point::new(unknowns[at], unknowns[at + 1]));
            keys.push(node as u64);
            values.extend([u.x, u.y]);
        }
        let (keys, values) = (session.gather_all(&keys), session.gather_all(&values));
        let pairs = keys.iter().zip(values.chunks_exact(2));
        Self { displacement: pairs.map(|(&node, u)| (node as usize, Point::new(u[0], u[1]))).collect() }
    }

    /// Displacement of a node; zero for one that no contact names.
    pub fn at(&self, node: EdgeNode, mesh: &MacroMesh, space: &Space) -> Point {
        if self.displacement.is_empty() {
            return Point::zeros();
        }
        self.displacement.get(&node.number(mesh, &space.numbering)).copied().unwrap_or_default()
    }
}

/// Every node of the boundaries of all contacts, those between two edges twice.
fn contact_nodes<'a>(scene: &'a Scene, space: &Space) -> impl Iterator<Item = EdgeNode> + use<'a> {
    let (mesh, level) = (&scene.mesh, space.numbering.level);
    let names = scene.pairs.iter().flat_map(|pair| &pair.between);
    names.flat_map(|name| mesh.edges_of(name)).flat_map(move |&edge| EdgeNode::along(edge, level))
}
