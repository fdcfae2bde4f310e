//! The two bars of example 1 without contact, for programs that use the crate's parts.

use mezha::body::{Body, Material, Support};
use mezha::discretisation::{Scene, spread};
use mezha::element::{Order, Plane};
use mezha::geometry::Formula;
use mezha::mesh::{MacroMesh, parse_gmsh, read_bytes};
use mezha::petsc::Session;
use std::path::Path;
use std::rc::Rc;

/// The scene, both bars held sideways at the left; refined towards the left end of the contact line if it is to be graded.
pub fn scene(session: &Session, order: Order, refine: usize, graded: bool) -> Scene {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/bars_inclined/bars.msh");
    let mut mesh = parse_gmsh(&read_bytes(&file).expect("the case's file"), &file, Default::default()).expect("the case's mesh");
    if graded {
        mesh.grade([0.0, 3.0].into(), 0.3).expect("a vertex");
    }
    on(mesh, session, order, refine)
}

/// The same scene on a mesh of its own.
pub fn on(mesh: MacroMesh, session: &Session, order: Order, refine: usize) -> Scene {
    let partition = spread(&mesh, &[], order, refine, session).expect("a partition");
    let material = Material { young: 7000.0, poisson: 0.227, plane: Plane::Strain };
    let body = |name: &String| Body::whole(name.clone(), material, [Formula::constant(0.0), Formula::constant(0.0)]);
    let zero = Some(Formula::constant(0.0));
    let wall = Support { name: "wall".into(), on: vec!["left".into()], at: None, ux: zero, uy: None, normal: None };
    Scene {
        bodies: mesh.bodies.iter().map(body).collect(),
        partition: Rc::new(partition),
        order,
        refine,
        supports: vec![wall],
        means: Vec::new(),
        rigid: Vec::new(),
        springs: Vec::new(),
        loads: Vec::new(),
        point_loads: Vec::new(),
        pairs: Vec::new(),
        mesh: Rc::new(mesh),
    }
}
