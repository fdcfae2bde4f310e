//! Case and mesh brought together: names resolved, geometries applied, macro triangles spread over ranks.

use crate::body::{Body, PointLoad};
use crate::case::{Case, CaseError, LoadStep};
use crate::discretisation::{self, Scene};
use crate::element::Plane;
use crate::geometry::{Coordinates, Formula, Point, Rounded};
use crate::mesh::{MacroMesh, Partition, each_once, parse_gmsh, read_bytes, touching_surfaces};
use crate::output::RunError;
use crate::petsc::Session;
use crate::procedure::Procedure;
use crate::run::reading::checks::{check_exact, check_means, check_moduli, coarse_arcs};
use crate::run::reading::names::{Names, together, unknown_part};
use std::collections::HashMap;
use std::rc::Rc;

/// Parts of a macro edge at whose ends a stiffness of springs is looked at.
const SAMPLES: usize = 8;

/// The bytes of the mesh file of a case.
///
/// # Errors
/// Words with file, key and remedy.
pub fn read_mesh_file(case: &Case) -> Result<Vec<u8>, String> {
    read_bytes(&case.mesh.file)
        .map_err(|error| format!("{}: mesh.file: {error}; name a Gmsh file by its path from the case file", case.file.display()))
}

/// The mesh of a case from the bytes of its file: bends and grades it, and checks that every name of the case is in it.
///
/// # Errors
/// Words with file, key, value and remedy.
pub fn read_mesh(case: &Case, bytes: &[u8]) -> Result<MacroMesh, String> {
    let in_file = |words: String| format!("{}: {words}", case.file.display());
    let mesh = parse_gmsh(bytes, &case.mesh.file, joined(case));
    let mut mesh = mesh.map_err(|error| unknown_part(case, bytes).map_or_else(|| error.to_string(), in_file))?;
    mesh.set_plane(case.plane).map_err(|error| error.to_string())?;
    let names = Names { case, mesh: &mesh };
    let wrong = names.wrong();
    if !wrong.is_empty() {
        return Err(together(&wrong));
    }
    names.check_unions().and_then(|()| names.check_plates()).map_err(in_file)?;
    case.unions.iter().for_each(|union| mesh.unite(&union.name, &union.curves));
    let names = Names { case, mesh: &mesh };
    case.contacts.iter().try_for_each(|pair| names.check_sides(&pair.name, &pair.between)).map_err(in_file)?;
    for geometry in &case.geometries {
        mesh.bend(&geometry.name, &geometry.curves, &geometry.curve).map_err(|error| error.to_string())?;
    }
    completed(case, mesh).map_err(in_file)
}

/// A mesh that has the names of its case, with tools, shapes and points, and checked.
///
/// # Errors
/// Words that begin with the key.
fn completed(case: &Case, mut mesh: MacroMesh) -> Result<MacroMesh, String> {
    add_tools(case, &mut mesh)?;
    if let Some((pair, words)) = coarse_arcs(case, &mesh).first() {
        return Err(format!("contact.{}.between: {words}", pair.name));
    }
    let fitted = case.contacts.iter().filter(|pair| pair.curve.is_found()).flat_map(|pair| &pair.between);
    let fitted = fitted.filter(|name| case.tool_of(name).is_none());
    mesh.bend_onto_splines(&fitted.collect::<Vec<_>>());
    let mirrors: Vec<u32> = case.supports.iter().flat_map(|support| support.mirrors(&mesh)).collect();
    mesh.square_splines(mirrors.into_iter());
    add_points(case, &mut mesh)?;
    add_grades(case, &mut mesh)?;
    check_moduli(case)?;
    check_means(case, &mesh)?;
    check_springs(case, &mesh)?;
    check_temperatures(case, &mesh)?;
    check_loads_on_axis(case, &mesh)?;
    check_points(case, &mesh)?;
    check_exact(case, &mesh)?;
    Ok(mesh)
}

/// The mesh of a case that cannot be read whole: with the shapes that it can have, whatever is wrong with names. Nothing if the
/// file is no mesh.
pub fn read_bare_mesh(case: &Case, bytes: &[u8]) -> Option<MacroMesh> {
    let mut mesh = parse_gmsh(bytes, &case.mesh.file, joined(case)).ok().or_else(|| {
        let groups = touching_surfaces(bytes, &case.mesh.file).ok()?;
        let together = |group: &Vec<String>| group.iter().map(|name| (name.clone(), group[0].clone())).collect::<Vec<_>>();
        parse_gmsh(bytes, &case.mesh.file, groups.iter().flat_map(together).collect()).ok()
    })?;
    for geometry in &case.geometries {
        let mut bent = mesh.clone();
        if bent.bend(&geometry.name, &geometry.curves, &geometry.curve).is_ok() {
            mesh = bent;
        }
    }
    Some(mesh)
}

/// What is wrong with a case file, and with the names of what could be read of it if its mesh can be read: all of it at once.
pub fn told_with_names(error: &CaseError, draft: Option<Case>) -> String {
    let wrong = |case: Case| {
        let mesh = parse_gmsh(&read_mesh_file(&case).ok()?, &case.mesh.file, joined(&case)).ok()?;
        Some(Names { case: &case, mesh: &mesh }.wrong())
    };
    together(&[vec![error.to_string()], draft.and_then(wrong).unwrap_or_default()].concat())
}

/// Adds the rigid tools, as fine as what they face.
fn add_tools(case: &Case, mesh: &mut MacroMesh) -> Result<(), String> {
    for tool in &case.tools {
        let error = |words: String| format!("{}: {words}", tool.key());
        if mesh.bodies.iter().any(|name| name == tool.key()) || mesh.boundary(tool.key()).is_some() {
            return Err(error(format!("{} has a physical group of that name, too; rename the tool", mesh.file.display())));
        }
        let pairs = case.contacts.iter().filter(|pair| pair.between.iter().any(|side| tool.has(side)));
        let faced = pairs.flat_map(|pair| pair.between.iter().filter(|side| !tool.has(side)));
        let against: Vec<u32> =
            faced.filter_map(|side| mesh.boundary(side)).flat_map(|side| side.edges.iter().copied()).collect();
        mesh.add_tool(tool.key(), &tool.surface, &against).map_err(error)?;
    }
    Ok(())
}

/// The body of each physical surface that is a part of one.
fn joined(case: &Case) -> HashMap<String, String> {
    let parts = case.parts().map(|(body, part)| (&part.name, &body.name));
    parts.filter(|(part, body)| part != body).map(|(part, body)| (part.clone(), body.clone())).collect()
}

/// A scene with its macro triangles spread over the ranks. **Collective**
pub fn spread(case: &Case, mesh: MacroMesh, session: &Session) -> Result<Scene, RunError> {
    let partition = discretisation::spread(&mesh, &case.contacts, case.mesh.order, case.mesh.refine, session)?;
    Ok(assemble(case, mesh, partition))
}

/// The scene that a case begins with, on one rank: with an accuracy that on the first mesh of the sequence.
pub fn first(case: &Case, mesh: impl Into<Rc<MacroMesh>>) -> Result<Scene, RunError> {
    let mesh = mesh.into();
    let partition = Partition::new(&mesh, &vec![0; mesh.triangles.len()], 1);
    let scene = assemble(case, mesh, partition);
    Ok(match &case.accuracy {
        Some(accuracy) => Procedure::first_of_sequence(scene, accuracy)?,
        None => scene,
    })
}

/// The scene of a case on a mesh that is spread already.
pub fn assemble(case: &Case, mesh: impl Into<Rc<MacroMesh>>, partition: impl Into<Rc<Partition>>) -> Scene {
    let mesh = mesh.into();
    let body = |name: &String| match case.bodies.iter().find(|body| body.name == *name) {
        Some(body) => body.clone(),
        // What a tool consists of does not matter: it does not strain.
        None => Body::whole(name.clone(), case.bodies[0].parts[0].material, [Formula::constant(0.0), Formula::constant(0.0)]),
    };
    Scene {
        bodies: mesh.bodies.iter().map(body).collect(),
        partition: partition.into(),
        order: case.mesh.order,
        refine: case.mesh.refine,
        supports: case.supports.clone(),
        means: case.mean_holds(&mesh).unwrap_or_default(),
        rigid: case.rigid_sets(&mesh),
        springs: case.springs.clone(),
        loads: case.loads.clone(),
        point_loads: case.point_loads.clone(),
        pairs: case.contacts.clone(),
        mesh,
    }
}

/// The scene of a load step, on the mesh of another one.
pub fn of_step(step: &LoadStep, other: &Scene) -> Scene {
    assemble(&step.case, other.mesh.clone(), other.partition.clone())
}

/// Grades the mesh towards the points that the case names.
fn add_grades(case: &Case, mesh: &mut MacroMesh) -> Result<(), String> {
    for grade in &case.mesh.grades {
        let [x, y] = grade.point;
        mesh.grade(Point::new(x, y), grade.ratio).map_err(|nearest| {
            let ([x, y], file) = ([x, y].map(Rounded), mesh.file.display());
            let words = format!("the nearest is [{}, {}]: name that, or draw a point there", nearest.x, nearest.y);
            format!("mesh.grade.points: [{x}, {y}] is no vertex of {file}; {words}")
        })?;
    }
    Ok(())
}

/// Makes the points at which bodies are held or loaded vertices of the mesh.
fn add_points(case: &Case, mesh: &mut MacroMesh) -> Result<(), String> {
    let supports = case.supports.iter().map(|support| (format!("support.{}.at", support.name), support.at.as_ref()));
    let loads = case.point_loads.iter().map(|load| (format!("load.{}.at", load.name), Some(&load.at)));
    for (key, spot) in supports.chain(loads).filter_map(|(key, spot)| Some((key, spot?))) {
        let [x, y] = spot.place;
        let is_body = |name: &str| case.bodies.iter().any(|body| body.name == name);
        mesh.add_point(spot, is_body).map_err(|words| format!("{key} = [{}, {}]: {words}", Rounded(x), Rounded(y)))?;
    }
    let bad = case.point_loads.iter().find(|load| load.force().iter().any(|component| !component.is_finite()));
    if let Some(load) = bad {
        let ([x, y], name) = (load.at.place.map(Rounded), &load.name);
        return Err(format!("load.{name}.force: has no finite value at its point ({x}, {y}); correct the formula"));
    }
    let is_radial = |load: &&PointLoad| mesh.plane == Plane::Revolution && load.at.place[0] == 0.0 && load.force()[0] != 0.0;
    if let Some(load) = case.point_loads.iter().find(is_radial) {
        let words = "acts on the axis of revolution, where nothing is radial; its x component must be 0 there";
        return Err(format!("load.{}.force: {words}", load.name));
    }
    Ok(())
}

/// A boundary on the axis of revolution has no area that a load could act on.
fn check_loads_on_axis(case: &Case, mesh: &MacroMesh) -> Result<(), String> {
    let on_axis = |&edge: &u32| mesh.edges[edge as usize].vertices.iter().all(|&v| mesh.vertices[v as usize].x == 0.0);
    let is_there = |edges: &[u32]| !edges.is_empty() && edges.iter().all(on_axis);
    let lies_there = |name: &&String| mesh.plane == Plane::Revolution && is_there(mesh.edges_of(name));
    let named = case.loads.iter().find_map(|load| Some((&load.name, load.on.iter().find(lies_there)?)));
    named.map_or(Ok(()), |(load, name)| {
        Err(format!("load.{load}.on: \"{name}\" lies on the axis of revolution, and has no area there; leave it out"))
    })
}

/// A temperature has a value at every vertex of what it heats, where stresses are shown.
fn check_temperatures(case: &Case, mesh: &MacroMesh) -> Result<(), String> {
    for (body, part) in case.parts() {
        let Some(heat) = &part.heat else { continue };
        let own = mesh.triangles.iter().filter(|triangle| mesh.parts[triangle.part as usize].name == part.name);
        for vertex in own.flat_map(|triangle| triangle.vertices) {
            let value = heat.temperature.finite_value(mesh.vertices[vertex as usize]);
            value.map_err(|words| format!("{}.temperature: {words}", body.key_of(part)))?;
        }
    }
    Ok(())
}

/// Springs push back: their stiffness is a number >= 0 all along, and above 0 somewhere.
fn check_springs(case: &Case, mesh: &MacroMesh) -> Result<(), String> {
    for springs in &case.springs {
        let error = |words: &str| format!("support.{}.stiffness: {words}", springs.name);
        let mut largest = 0.0f64;
        for edge in springs.edges(mesh) {
            for t in (0..=SAMPLES).map(|k| k as f64 / SAMPLES as f64) {
                let x = mesh.edge_position(edge, t);
                for (_, k) in springs.stiffness.at(x, mesh.edge_normal(edge, t)) {
                    if !(k.is_finite() && k >= 0.0) {
                        let words = format!("is {k} at {}; a spring wants a finite number >= 0 everywhere", Coordinates(x));
                        return Err(error(&words));
                    }
                    largest = largest.max(k);
                }
            }
        }
        if largest == 0.0 {
            return Err(error("is 0 all along the boundary; leave the support out, or correct the formula"));
        }
    }
    Ok(())
}

/// Points of probes and of exact displacements lie in their bodies.
fn check_points(case: &Case, mesh: &MacroMesh) -> Result<(), String> {
    let probes = case.probes.iter().map(|probe| (format!("probe.{}.point", probe.name), &probe.body, probe.point.into()));
    let exact = case.exact.bodies.iter().flat_map(|exact| {
        let points = exact.displacement.iter().flat_map(|displacement| &displacement.at);
        points.map(|&point| (format!("exact.body.{}.displacement.at", exact.name), &exact.name, point))
    });
    for (key, name, [x, y]) in probes.chain(exact) {
        let own = |triangle: &usize| mesh.region(name).is_some_and(|region| region.holds(&mesh.triangles[*triangle]));
        let holds = |triangle: &usize| mesh.locate(*triangle, Point::new(x, y)).is_some();
        let holding = (0..mesh.triangles.len()).filter(own).filter(holds);
        let parts = each_once(holding.map(|k| &mesh.parts[mesh.triangles[k].part as usize].name));
        let words = match parts[..] {
            [] => format!("lies outside body \"{name}\"; move it inside"),
            [first, second, ..] if key.starts_with("probe.") => format!(
                "lies between parts \"{first}\" and \"{second}\" of body \"{name}\", where the stress jumps; name one of them as the body of the probe"
            ),
            _ => continue,
        };
        return Err(format!("{key} = [{}, {}]: {words}", Rounded(x), Rounded(y)));
    }
    Ok(())
}
