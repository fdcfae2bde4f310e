//! Small scenes for unit tests.

use crate::body::{Body, Material, Support};
use crate::contact::{Known, MultiplierSpace, Pair, SegmentRule, samples};
use crate::discretisation::contacts::Contact;
use crate::discretisation::levels::finest_numbering;
use crate::discretisation::scene::Scene;
use crate::element::{Order, Plane};
use crate::geometry::{Formula, Point};
use crate::mesh::samples::two_blocks;
use crate::mesh::{MacroMesh, Partition};
use std::rc::Rc;

/// Values of nodes: numbers between 0 and 1 that repeat late.
pub fn vector(nodes: usize, seed: usize) -> Vec<[f64; 2]> {
    let value = |at: usize| ((at + seed) * 7919 % 1009) as f64 / 1009.0;
    (0..nodes).map(|node| [value(2 * node), value(2 * node + 1)]).collect()
}

/// The contact of the two blocks along the line between them, by the drawn gap, on even segments.
pub fn pair(space: MultiplierSpace, segments: usize) -> Pair {
    Pair { space, segments: SegmentRule::Count(segments), ..samples::seam() }
}

/// The two blocks, the vertices of the upper one moved by a function of their place. E is 2 below and 6 above, ν 0 and 0.5.
pub fn blocks(pair: Pair, upper: impl Fn(Point) -> Point, supports: Vec<Support>) -> Scene {
    let mut mesh: MacroMesh = two_blocks();
    let is_upper = |name: &String| name == "upper";
    let mut of_upper = vec![false; mesh.vertices.len()];
    for triangle in mesh.triangles.iter().filter(|triangle| is_upper(&mesh.bodies[triangle.body as usize])) {
        triangle.vertices.iter().for_each(|&vertex| of_upper[vertex as usize] = true);
    }
    mesh.vertices.iter_mut().zip(of_upper).filter(|(_, of_upper)| *of_upper).for_each(|(x, _)| *x += upper(*x));
    let body = |name: &String| {
        let (young, poisson) = if is_upper(name) { (6.0, 0.5) } else { (2.0, 0.0) };
        let zero = || Formula::constant(0.0);
        Body::whole(name.clone(), Material { young, poisson, plane: Plane::Strain }, [zero(), zero()])
    };
    Scene {
        bodies: mesh.bodies.iter().map(body).collect(),
        partition: Rc::new(Partition::new(&mesh, &vec![0; mesh.triangles.len()], 1)),
        order: Order::P1,
        refine: 3,
        supports,
        means: Vec::new(),
        rigid: Vec::new(),
        springs: Vec::new(),
        loads: Vec::new(),
        point_loads: Vec::new(),
        pairs: vec![pair],
        mesh: Rc::new(mesh),
    }
}

/// Its only contact, placed by what is known of it.
pub fn contact(scene: &Scene, known: Known) -> Contact {
    let numbering = finest_numbering(scene).expect("a small mesh");
    let mut contacts = Contact::all_again(scene, &numbering, 0, &[known], &|_| Point::zeros()).expect("they face each other");
    contacts.remove(0)
}
