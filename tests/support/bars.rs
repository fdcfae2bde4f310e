//! The two bars of example 1 without contact, for programs that use the crate's parts.

use mezha::body::{Body, Material, Support};
use mezha::element::Order;
use mezha::geometry::Formula;
use mezha::mesh::{Graph, Partition, lattice, read_gmsh};
use mezha::petsc::{Session, Vector, partition};
use mezha::system::{Discretisation, Scene, Space};
use std::path::Path;
use std::rc::Rc;

/// The scene, both bars held sideways at the left; refined towards the left end of the contact line if it is to be graded.
pub fn scene(session: &Session, order: Order, refine: usize, graded: bool) -> Scene {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/bars_inclined/bars.msh");
    let mut mesh = read_gmsh(&file).expect("the case's mesh");
    if graded {
        mesh.grade([0.0, 3.0].into(), 0.3).expect("a vertex");
    }
    let graph = Graph::new(&mesh, &[]);
    let ranks = partition(session, session.size(), &graph.offsets, &graph.neighbours, &graph.weights, None).expect("a partition");
    let body = |name: &String| Body {
        name: name.clone(),
        material: Material { young: 7000.0, poisson: 0.227 },
        force: [Formula::constant(0.0), Formula::constant(0.0)],
    };
    let zero = Some(Formula::constant(0.0));
    let wall = Support { name: "wall".into(), on: vec!["left".into()], ux: zero, uy: None, normal: None };
    Scene {
        bodies: mesh.bodies.iter().map(body).collect(),
        partition: Rc::new(Partition::new(&mesh, &ranks, session.size())),
        order,
        refine,
        supports: vec![wall],
        loads: Vec::new(),
        pairs: Vec::new(),
        mesh,
    }
}

/// A linear motion that the supports allow, in the unknowns of a level.
pub fn linear_motion(problem: &Discretisation, space: &Space, session: &Session) -> Vector {
    let (mesh, level) = (&problem.scene.mesh, space.numbering.level);
    let mut motion = Vector::new(session, space.local_unknowns()).expect("a vector");
    for &triangle in problem.scene.partition.triangles_of(session.rank()) {
        let numbers = space.numbering.triangle(mesh, triangle as usize);
        for (i, j) in lattice::nodes(level.intervals) {
            if let Some(at) = numbers.node(i, j).checked_sub(space.own.start).filter(|at| *at < space.own.len()) {
                let x = mesh.node_position(triangle as usize, level, (i, j));
                motion.values_mut()[2 * at..2 * at + 2].copy_from_slice(&[2.0 * x.x, 1.0 + 3.0 * x.x - x.y]);
            }
        }
    }
    motion
}
