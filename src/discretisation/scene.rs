//! The physics that is solved: mesh, bodies, supports, loads and contacts, spread over ranks.

use crate::body::{Body, BodyPart, Load, MeanHold, PointLoad, RigidNodes, RigidSet, Springs, Support};
use crate::contact::{Extent, Pair};
use crate::element::{Heat, Order, PlaneLaw};
use crate::geometry::{Point, bounds};
use crate::mesh::{BodyPiece, Graph, MacroMesh, Partition};
use crate::petsc::{self, Session, partition};
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
    /// Bodies whose mean motion is held, on this mesh.
    pub means: Vec<MeanHold>,
    /// Nodes that move together as rigid bodies.
    pub rigid: Vec<RigidSet>,
    /// Elastic supports.
    pub springs: Vec<Springs>,
    /// Loads.
    pub loads: Vec<Load>,
    /// Forces at points.
    pub point_loads: Vec<PointLoad>,
    /// Contact pairs.
    pub pairs: Vec<Pair>,
}

impl Scene {
    /// The same scene on a mesh that is `times` refinements coarser, with as many segments less.
    pub fn coarser(&self, times: usize) -> Self {
        let pairs = self.pairs.iter().map(|pair| pair.coarser(times)).collect();
        Self { refine: self.refine - times, pairs, ..self.clone() }
    }

    /// The same scene on another mesh of the same bodies, spread over the ranks. **Collective**
    ///
    /// # Errors
    /// What PETSc says.
    pub fn on(&self, mesh: MacroMesh, session: &Session) -> petsc::Result<Self> {
        let partition = Rc::new(spread(&mesh, &self.pairs, self.order, self.refine, session)?);
        let means = self.means.iter().map(|hold| hold.on(&mesh)).collect();
        Ok(Self { mesh: Rc::new(mesh), partition, means, ..self.clone() })
    }

    /// The same scene with all of its mesh on this rank.
    pub fn on_one_rank(&self) -> Self {
        let ranks = vec![0; self.mesh.triangles.len()];
        Self { partition: Rc::new(Partition::new(&self.mesh, &ranks, 1)), ..self.clone() }
    }

    /// The rigid tool that a body is, if it is one.
    pub fn tool(&self, body: usize) -> Option<&RigidSet> {
        let name = &self.mesh.bodies[body];
        self.rigid.iter().find(|set| matches!(&set.nodes, RigidNodes::Body(own) if own == name))
    }

    /// Whether a body is a rigid tool.
    pub fn is_rigid(&self, body: usize) -> bool {
        self.tool(body).is_some()
    }

    /// The largest Poisson's ratio, as in plane strain, of all parts that deform.
    pub fn poisson(&self) -> f64 {
        let elastic = (0..self.bodies.len()).filter(|&body| !self.is_rigid(body));
        elastic.flat_map(|body| &self.bodies[body].parts).map(|part| part.material.poisson_in_plane()).fold(0.0, f64::max)
    }

    /// Young's modulus of each part as contacts see it, in the order of the mesh: without bound for a rigid tool.
    pub fn young(&self) -> Vec<f64> {
        (0..self.mesh.parts.len()).map(|part| self.young_of(part)).collect()
    }

    /// Young's modulus of a part as contacts see it: without bound for a rigid tool.
    pub fn young_of(&self, part: usize) -> f64 {
        let is_rigid = self.is_rigid(self.mesh.parts[part].body as usize);
        if is_rigid { f64::INFINITY } else { self.part(part).material.young }
    }

    /// Compliance of the surface of a part (1/stress): none of a rigid tool.
    pub fn compliance(&self, part: usize) -> f64 {
        let is_rigid = self.is_rigid(self.mesh.parts[part].body as usize);
        if is_rigid { 0.0 } else { 1.0 / self.part(part).material.plane_modulus() }
    }

    /// Whether each macro triangle of a rank has a corner at which a load acts: the energy there has no limit.
    pub fn has_point_load(&self, rank: usize) -> Vec<bool> {
        let loaded: Vec<u32> = self.point_loads.iter().filter_map(|load| self.mesh.vertex_at(&load.at)).collect();
        let own = self.partition.triangles_of(rank).iter();
        own.map(|&triangle| self.mesh.triangles[triangle as usize].vertices.iter().any(|vertex| loaded.contains(vertex)))
            .collect()
    }

    /// The parts of all bodies, in the order of the mesh.
    pub fn parts(&self) -> Vec<&BodyPart> {
        (0..self.mesh.parts.len()).map(|part| self.part(part)).collect()
    }

    /// A part of the mesh.
    pub(super) fn part(&self, part: usize) -> &BodyPart {
        let surface = &self.mesh.parts[part];
        let mut parts = self.bodies[surface.body as usize].parts.iter();
        parts.find(|part| part.name == surface.name).expect("every physical surface has its constants")
    }

    /// What a part of the mesh is heated by.
    pub fn heat(&self, part: usize) -> Option<&Heat> {
        self.part(part).heat.as_ref()
    }

    /// Whether any part is heated.
    pub fn is_heated(&self) -> bool {
        self.bodies.iter().flat_map(|body| &body.parts).any(|part| part.heat.is_some())
    }

    /// By how much the bodies would grow with what heats them (length), and the stress by which it would press if nothing gave way, at
    /// the vertices; zeros if nothing is heated.
    pub fn growth(&self) -> [f64; 2] {
        let size = self.extents().iter().map(|extent| extent.radius).fold(0.0, f64::max);
        let (parts, mut growth) = (self.parts(), [0.0f64; 2]);
        for triangle in self.mesh.triangles.iter().filter(|triangle| parts[triangle.part as usize].heat.is_some()) {
            let part = parts[triangle.part as usize];
            let at = |vertex: u32| part.heat.as_ref().map_or(0.0, |heat| heat.growth(self.mesh.vertices[vertex as usize]).abs());
            let strain = triangle.vertices.map(at).into_iter().fold(0.0, f64::max);
            growth = [growth[0].max(strain * size), growth[1].max(strain * part.material.young)];
        }
        growth
    }

    /// The law of each part, in the order of the mesh.
    pub fn laws(&self) -> Vec<PlaneLaw> {
        self.parts().into_iter().map(|part| part.material.law()).collect()
    }

    /// Middle and half size of each piece of the bodies. A tool counts no farther than what it faces.
    pub fn extents(&self) -> Vec<Extent> {
        let extent = |[low, high]: [Point; 2]| Extent { middle: 0.5 * (low + high), radius: 0.5 * (high - low).norm() };
        let of_piece = |(own, piece): ([Point; 2], &BodyPiece)| {
            let (own, faced) = (extent(own), self.faced_by_tool(piece.body).map(extent));
            faced.filter(|faced| faced.radius < own.radius).unwrap_or(own)
        };
        self.mesh.bounds().iter().copied().zip(&self.mesh.pieces).map(of_piece).collect()
    }

    /// The box around the boundaries that a tool is in contact with; nothing if a body is no tool.
    fn faced_by_tool(&self, body: usize) -> Option<[Point; 2]> {
        self.tool(body)?;
        let edges = |name: &String| self.mesh.edges_of(name);
        let is_own = |name: &String| edges(name).first().is_some_and(|&edge| self.mesh.body_beside(edge) == body);
        let pairs = self.pairs.iter().filter(|pair| pair.between.iter().any(is_own));
        let faced = pairs.flat_map(|pair| pair.between.iter().filter(|name| !is_own(name))).flat_map(edges);
        let ends = faced.flat_map(|&edge| self.mesh.edges[edge as usize].vertices).map(|v| self.mesh.vertices[v as usize]);
        Some(bounds(ends))
    }
}

/// Spreads macro triangles over the ranks: each has about the same work at this order and refinement, and those that share an
/// edge, or face each other in a contact, lie together if they can. **Collective**
///
/// # Errors
/// What PETSc says.
pub fn spread(mesh: &MacroMesh, pairs: &[Pair], order: Order, refine: usize, session: &Session) -> petsc::Result<Partition> {
    if session.size() == 1 {
        return Ok(Partition::new(mesh, &vec![0; mesh.triangles.len()], 1));
    }
    let sides: Vec<[&[u32]; 2]> = pairs.iter().map(|pair| pair.between.each_ref().map(|name| mesh.edges_of(name))).collect();
    let graph = Graph::new(mesh, &sides);
    let (size, work) = (session.size(), mesh.work(order, refine));
    let ranks = partition(session, size, &graph.offsets, &graph.neighbours, &graph.connection_weights, &work)?;
    Ok(Partition::new(mesh, &ranks, size))
}
