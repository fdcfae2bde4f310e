//! Mesh, bodies, geometry, loads, solver and probes.

use std::path::Path;

use toml::Value;

use super::error::suggest;
use super::grade::read_grade;
use super::gravity::{Gravity, read_weight, with_weight};
use super::rigid::{Plate, read_plate};
use super::section::Section;
use super::spot::read_where;
use super::values::{self, Choice, PLANE};
use super::{MeshChoice, Output, Probe, Solver};
use crate::body::{Body, BodyPart, Load, LoadKind, Material, PointLoad};
use crate::element::{Heat, Order, Plane};
use crate::geometry::Formula;
use crate::system::{SolverChoice, Tolerance};

/// What the plane may stand for.
const PLANES: [Choice<Plane>; 3] = [("strain", Plane::Strain), ("stress", Plane::Stress), ("axisymmetric", Plane::Revolution)];

/// What a body, or each of its parts, is given.
const CONSTANTS: [&str; 6] = ["young", "poisson", "body_force", "density", "expansion", "temperature"];

/// `[mesh]`
pub fn read_mesh(root: &Section, folder: &Path) -> Option<MeshChoice> {
    let section = root.table("mesh");
    let file = section.required("file", values::name);
    let order = section.or("order", |value| Ok(if values::whole(value)? == 1 { Order::P1 } else { Order::P2 }));
    let refine = section.or("refine", values::whole);
    let grades = section.optional_table("grade").map_or(Some(Vec::new()), |section| read_grade(&section, order));
    // What is bad is in the log; the file alone is enough to look for names.
    let (order, refine) = (order.unwrap_or(Order::P2), refine.unwrap_or_default());
    Some(MeshChoice { file: folder.join(file?), order, refine, grades: grades.unwrap_or_default() })
}

/// `plane`, before all tables.
pub fn read_plane(root: &Section) -> Plane {
    root.or("plane", values::choice(&PLANES)).unwrap_or_default()
}

/// `[body.NAME]`; `plane` holds where it says nothing else.
pub fn read_body(section: &Section, plane: Plane, gravity: Gravity) -> Option<Body> {
    let plane = section.optional("plane", values::choice(&PLANES)).unwrap_or(plane);
    let name = section.name().to_owned();
    if !section.has("part") {
        let part = read_part(section, plane, gravity)?;
        return Some(Body { name, parts: vec![part] });
    }
    for key in CONSTANTS.into_iter().filter(|key| section.has(key)) {
        section.problem(&[key], "stands beside parts of this body; give it in each of their tables".into());
    }
    let parts = section.named("part", |section| read_part(section, plane, gravity));
    if section.names_below("part").next().is_none() {
        section.problem(&["part"], format!("names no part; write [body.{name}.part.SURFACE] for each physical surface of it"));
    }
    if section.names_below("part").any(|part| part == name) {
        section.problem(&["part", &name], "a part cannot have the name of its body; give the body another one".into());
    }
    Some(Body { name, parts })
}

/// The constants of a physical surface.
fn read_part(section: &Section, plane: Plane, gravity: Gravity) -> Option<BodyPart> {
    let young = section.required(CONSTANTS[0], values::number);
    let poisson = section.required(CONSTANTS[1], |value| match (values::number(value)?, plane) {
        (0.5, Plane::Strain | Plane::Revolution) => {
            Err("must lie in (-1, 0.5); 0.5 is incompressible, for which displacement elements lock: take 0.49".into())
        }
        (ratio, _) => Ok(ratio),
    });
    let force = section.or(CONSTANTS[2], values::formulas);
    let weight = read_weight(section, gravity);
    let heat = read_heat(section);
    // What is bad is in the log; a body of this name is there.
    let material = Material { young: young.unwrap_or(1.0), poisson: poisson.unwrap_or(0.0), plane };
    let force = force.unwrap_or_else(|| [0.0; 2].map(Formula::constant));
    Some(BodyPart { name: section.name().into(), material, force: with_weight(force, weight.unwrap_or_default()), heat })
}

/// `expansion` and `temperature`: each of them alone does nothing.
fn read_heat(section: &Section) -> Option<Heat> {
    let expansion = section.optional("expansion", values::number);
    let temperature = section.optional("temperature", values::formula(&PLANE));
    match (section.has("expansion"), section.has("temperature")) {
        (false, true) => {
            section.problem(
                &["temperature"],
                "strains nothing without an expansion; give expansion, the strain by degree, too".into(),
            );
        }
        (true, false) => {
            section.problem(
                &["expansion"],
                "does nothing without a temperature; give temperature, the difference to that without stress, too".into(),
            );
        }
        _ => {}
    }
    Some(Heat { expansion: expansion?, temperature: temperature? })
}

/// A physical surface belongs to one body.
pub fn check_parts(bodies: &[Body], root: &Section) {
    for (at, body) in bodies.iter().enumerate() {
        for part in body.parts.iter().filter(|_| body.has_parts()) {
            let mut others = bodies.iter().enumerate().filter(|(other, _)| *other != at).map(|(_, other)| other);
            let has = |other: &&Body| other.name == part.name || other.parts.iter().any(|theirs| theirs.name == part.name);
            if let Some(other) = others.find(has) {
                let words = format!("body.{} has this name too; a physical surface belongs to one body", other.name);
                root.problem(&["body", &body.name, "part", &part.name], words);
            }
        }
    }
}

/// Names of all bodies, and of their parts.
pub fn region_names<'a>(root: &Section<'a>) -> Vec<&'a str> {
    root.names_below("body").chain(root.names_two_below("body", "part")).collect()
}

/// What a table `[load.NAME]` says.
pub enum LoadTable {
    /// It acts on physical curves.
    OnCurves(Load),
    /// It acts at a point.
    AtPoint(PointLoad),
    /// A resultant on a boundary that stays rigid.
    OnPlate(Plate),
}

/// The loads on curves, those at points, and those on boundaries that stay rigid.
pub fn split_loads(all: Vec<LoadTable>) -> (Vec<Load>, Vec<PointLoad>, Vec<Plate>) {
    let (mut loads, mut point_loads, mut plates) = (Vec::new(), Vec::new(), Vec::new());
    for load in all {
        match load {
            LoadTable::OnCurves(load) => loads.push(load),
            LoadTable::AtPoint(load) => point_loads.push(load),
            LoadTable::OnPlate(plate) => plates.push(plate),
        }
    }
    (loads, point_loads, plates)
}

/// `[load.NAME]`
pub fn read_load(section: &Section) -> Option<LoadTable> {
    let place = read_where(section);
    let name = section.name().to_string();
    if section.has("at") {
        for key in ["pressure", "traction"].into_iter().filter(|key| section.has(key)) {
            section.problem(&[key], "acts on physical curves; at a point give force = [fx, fy]".into());
        }
        let force = section.required("force", values::formulas::<2>);
        return Some(LoadTable::AtPoint(PointLoad { name, at: place?.at?, force: force? }));
    }
    if section.or("rigid", values::boolean)? {
        return read_plate(section, place?.on).map(LoadTable::OnPlate);
    }
    for key in ["force", "moment"].into_iter().filter(|key| section.has(key)) {
        let words =
            "acts at a point, at = [x, y], or on curves that stay rigid, rigid = true; otherwise give pressure or traction";
        section.problem(&[key], words.into());
    }
    let given = [section.has("pressure"), section.has("traction")];
    let pressure = section.optional("pressure", values::formula(&PLANE)).map(LoadKind::Pressure);
    let traction = section.optional("traction", values::formulas::<2>).map(LoadKind::Traction);
    match given {
        [false, false] => section.problem(&[], "loads nothing; give pressure or traction = [tx, ty]".into()),
        [true, true] => section.problem(&["pressure"], "stands beside traction; give one of them, or two loads".into()),
        _ => {}
    }
    // What is bad is in the log; the curves alone are enough to look for names.
    let kind = pressure.or(traction).unwrap_or(LoadKind::Pressure(Formula::constant(0.0)));
    Some(LoadTable::OnCurves(Load { name, on: place?.on, kind }))
}

/// `[solver]`
pub fn read_solver(root: &Section) -> Option<Solver> {
    let section = root.table("solver");
    let choice = section.or(
        "name",
        values::choice(&[
            ("auto", SolverChoice::Auto),
            ("fieldsplit", SolverChoice::FieldSplit),
            ("direct", SolverChoice::Direct),
        ]),
    );
    let tolerance = section.or("tolerance", |value| match value {
        Value::String(_) => Ok(Tolerance::Discretisation),
        number => values::number(number).map(Tolerance::Residual),
    });
    let inf_sup = section.or("inf_sup", |value| Ok(value.as_bool()));
    Some(Solver { choice: choice?, tolerance: tolerance?, inf_sup: inf_sup? })
}

/// `[output]`
pub fn read_output(root: &Section) -> Option<Output> {
    let fields = root.table("output").or("fields", values::boolean);
    Some(Output { fields: fields? })
}

/// `[probe.NAME]`
pub fn read_probe(section: &Section) -> Option<Probe> {
    let point = section.required("point", values::point);
    let body = section.required("body", values::name);
    Some(Probe { name: section.name().into(), point: point?, body: body? })
}

/// There is something to solve for.
pub fn check_bodies(root: &Section) {
    if root.names_below("body").next().is_none() {
        root.problem(&["body"], "missing; write [body.NAME] for every physical surface of the mesh".into());
    }
}

/// Probes ask bodies of the case, or parts of them.
pub fn check_probes(probes: &[Probe], root: &Section) {
    for probe in probes {
        let names = region_names(root);
        if !names.contains(&probe.body.as_str()) {
            let words = format!("no such body; {}", suggest(&probe.body, names.into_iter()));
            root.problem(&["probe", &probe.name, "body"], words);
        }
    }
}
