//! How every node of a scene can move: by unknowns of the block that it belongs to.
//!
//! A block is a piece of a body, or several that one plate moves together. Supports take unknowns away, plates and tools put those of
//! a rigid motion in their place.

use crate::body::{Constraints, RigidNodes, RigidSet};
use crate::discretisation::{Scene, SystemError};
use crate::geometry::Point;
use crate::mesh::{MacroTriangle, Numbering, each_once};

/// What moves a node.
#[derive(Clone, Copy)]
enum NodeFreedom {
    /// Its own two components along `axis` and across it, as far as they are free.
    Own { axis: Point, unknowns: [Option<usize>; 2], at_rest: Point },
    /// A rigid set.
    Set(usize),
}

/// A node of a block.
struct BlockNode {
    block: usize,
    piece: usize,
    place: Point,
    freedom: NodeFreedom,
}

/// How all nodes of a scene can move.
pub struct Freedoms {
    nodes: Vec<BlockNode>,
    /// Block of each piece.
    pub block_of_piece: Vec<usize>,
    /// Number of unknowns of each block.
    pub sizes: Vec<usize>,
    /// Unknowns of the components of each rigid set that are free, its motion at rest, and its block.
    pub sets: Vec<SetFreedom>,
}

/// How a rigid set can move.
pub struct SetFreedom {
    /// Its block.
    pub block: usize,
    /// Unknowns of its free components.
    pub unknowns: [Option<usize>; 3],
    /// Pieces of which it moves some nodes; none of a tool, which it moves as a whole.
    pub pieces: Vec<usize>,
}

/// How a node moves by unknowns of its block.
pub struct NodeMotion {
    /// The block.
    pub block: usize,
    /// Displacement where all unknowns are zero.
    pub at_rest: Point,
    terms: [(usize, Point); 3],
    count: usize,
}

impl NodeMotion {
    /// Unknowns, and the displacement by each.
    pub fn terms(&self) -> &[(usize, Point)] {
        &self.terms[..self.count]
    }

    fn push(&mut self, unknown: Option<usize>, displacement: Point) {
        if let Some(unknown) = unknown {
            self.terms[self.count] = (unknown, displacement);
            self.count += 1;
        }
    }
}

impl Freedoms {
    /// Those of a scene whose nodes are all on this rank.
    ///
    /// # Errors
    /// [`SystemError::Case`] if supports contradict each other.
    pub fn new(scene: &Scene, numbering: &Numbering) -> Result<Self, SystemError> {
        let mesh = &scene.mesh;
        // Held means have no anchors here: they are equations of the programme.
        let constraints = Constraints::new(mesh, numbering, &scene.supports, &[], &scene.rigid)?;
        let mut joined: Vec<usize> = (0..mesh.pieces.len()).collect();
        let mut sets = Vec::new();
        for set in &scene.rigid {
            let pieces = each_once(set.edges(mesh).into_iter().map(|edge| mesh.piece_beside(edge)));
            let roots: Vec<usize> = pieces.iter().map(|&piece| root(&mut joined, piece)).collect();
            roots.windows(2).for_each(|two| joined[two[1]] = two[0]);
            let block = roots[0];
            let is_tool = matches!(set.nodes, RigidNodes::Body(_));
            sets.push(SetFreedom { block, unknowns: [None; 3], pieces: if is_tool { Vec::new() } else { pieces } });
        }
        let roots: Vec<usize> = (0..joined.len()).map(|piece| root(&mut joined, piece)).collect();
        let blocks = each_once(roots.iter().copied());
        let number = |root: usize| blocks.binary_search(&root).unwrap_or_default();
        let block_of_piece: Vec<usize> = roots.iter().map(|&root| number(root)).collect();
        let mut sizes = vec![0; blocks.len()];
        for (set, freedom) in scene.rigid.iter().zip(&mut sets) {
            freedom.block = number(root(&mut joined, freedom.block));
            for k in set.free() {
                freedom.unknowns[k] = Some(sizes[freedom.block]);
                sizes[freedom.block] += 1;
            }
        }
        let nodes = nodes_of_blocks(scene, numbering, &constraints, &block_of_piece, &mut sizes);
        Ok(Self { nodes, block_of_piece, sizes, sets })
    }

    /// How a node moves.
    pub fn of(&self, scene: &Scene, node: usize) -> NodeMotion {
        let BlockNode { block, place, freedom, .. } = &self.nodes[node];
        let mut motion = NodeMotion { block: *block, at_rest: Point::zeros(), terms: [(0, Point::zeros()); 3], count: 0 };
        match *freedom {
            NodeFreedom::Own { axis, unknowns, at_rest } => {
                motion.at_rest = at_rest;
                motion.push(unknowns[0], axis);
                motion.push(unknowns[1], Point::new(-axis.y, axis.x));
            }
            NodeFreedom::Set(at) => {
                let set = &scene.rigid[at];
                motion.at_rest = set.displacement(&set.prescribed_motion(), *place);
                (0..3).for_each(|k| motion.push(self.sets[at].unknowns[k], set.mode(k, *place)));
            }
        }
        motion
    }

    /// Number of nodes.
    pub fn count(&self) -> usize {
        self.nodes.len()
    }

    /// Where a node is.
    pub fn place(&self, node: usize) -> Point {
        self.nodes[node].place
    }

    /// Unknowns of the nodes that move by themselves, each with its piece, its place and its direction.
    pub fn own_unknowns(&self) -> impl Iterator<Item = (usize, OwnUnknown)> {
        self.nodes.iter().flat_map(|node| {
            let both = match node.freedom {
                NodeFreedom::Own { axis, unknowns, .. } => [(unknowns[0], axis), (unknowns[1], Point::new(-axis.y, axis.x))],
                NodeFreedom::Set(_) => [(None, Point::zeros()); 2],
            };
            let own = |(unknown, direction)| OwnUnknown { unknown, piece: node.piece, place: node.place, direction };
            let is_own = matches!(node.freedom, NodeFreedom::Own { .. });
            both.map(|both| (node.block, own(both))).into_iter().filter(move |_| is_own)
        })
    }
}

/// A component of a node that moves by itself.
pub struct OwnUnknown {
    /// Its number in the block; nothing if a support holds it.
    pub unknown: Option<usize>,
    /// Piece of the node.
    pub piece: usize,
    /// Where the node is.
    pub place: Point,
    /// Unit vector of the component.
    pub direction: Point,
}

/// The piece that stands for all that are joined with one.
fn root(joined: &mut [usize], mut piece: usize) -> usize {
    while joined[piece] != piece {
        joined[piece] = joined[joined[piece]];
        piece = joined[piece];
    }
    piece
}

/// Counts the unknowns of all nodes.
fn nodes_of_blocks(
    scene: &Scene,
    numbering: &Numbering,
    constraints: &Constraints,
    block_of_piece: &[usize],
    sizes: &mut [usize],
) -> Vec<BlockNode> {
    let mesh = &scene.mesh;
    let mut set_of: Vec<Option<usize>> = vec![None; numbering.node_count()];
    for (at, set) in scene.rigid.iter().enumerate() {
        set.places(mesh, numbering).into_keys().for_each(|node| set_of[node] = Some(at));
    }
    // What lies within a tool follows it, though no edge of it is there.
    let tool_of = |body: &String| {
        let is_tool = |set: &RigidSet| matches!(&set.nodes, RigidNodes::Body(name) if name == body);
        scene.rigid.iter().position(is_tool)
    };
    let tools: Vec<Option<usize>> = mesh.bodies.iter().map(tool_of).collect();
    let mut nodes: Vec<Option<BlockNode>> = (0..numbering.node_count()).map(|_| None).collect();
    for (triangle, at, node) in numbering.nodes_of(mesh, 0..mesh.triangles.len()) {
        if nodes[node].is_some() {
            continue;
        }
        let MacroTriangle { piece, body, .. } = mesh.triangles[triangle];
        let (piece, block) = (piece as usize, block_of_piece[piece as usize]);
        let freedom = match set_of[node].or(tools[body as usize]) {
            Some(set) => NodeFreedom::Set(set),
            None => own_freedom(constraints, node, &mut sizes[block]),
        };
        let place = mesh.node_position(triangle, numbering.level, at);
        nodes[node] = Some(BlockNode { block, piece, place, freedom });
    }
    nodes.into_iter().flatten().collect()
}

fn own_freedom(constraints: &Constraints, node: usize, size: &mut usize) -> NodeFreedom {
    let mut unknown = |fixed: bool| {
        let next = (!fixed).then_some(*size);
        *size += usize::from(!fixed);
        next
    };
    match constraints.get(node) {
        None => {
            NodeFreedom::Own { axis: Point::new(1.0, 0.0), unknowns: [unknown(false), unknown(false)], at_rest: Point::zeros() }
        }
        Some(held) => {
            let unknowns = held.fixed.map(&mut unknown);
            NodeFreedom::Own { axis: held.axis, unknowns, at_rest: held.to_global(held.prescribed()) }
        }
    }
}
