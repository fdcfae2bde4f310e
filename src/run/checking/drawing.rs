//! The figure of `mezha check`: what of a case can be read, with all names.

use super::proposals::short;
use crate::body::{Load, LoadKind, RigidSet, SpringStiffness, Springs, Support};
use crate::case::{Case, read_text};
use crate::contact::Pair;
use crate::element::Plane;
use crate::geometry::{Formula, Point};
use crate::mesh::{Boundary, MacroMesh, MacroTriangle, Stretch};
use crate::output::plot::{
    BoundaryPoint, DrawnLoad, DrawnPart, DrawnSupport, Grip, NamedRows, Rows, SceneFigure, bounds, number_text,
};
use crate::output::{RunError, Units};
use crate::run::reading::scene;
use crate::run::words::{title, units};
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::rc::Rc;

/// Points of a curved edge in the figure; of a mesh whose edges are too many to be drawn they are small.
const BENDS: usize = 12;
const FEW_BENDS: usize = 2;

/// Macro edges that are drawn at most: more would be a grey field.
const MOST_EDGES: usize = 12_000;

/// Places of a boundary that are looked at for the one that is nearest to another, before those around it.
const LOOKS: usize = 64;

/// Of a boundary that several contacts share, each is drawn as far from its place as this share of the smaller side's size.
const BESIDE: f64 = 0.15;

/// Lines of remarks, and their letters, at most.
const MOST_REMARKS: usize = 8;
const LONGEST_REMARK: usize = 84;

/// Draws a case as it was `read`, or what can be read of its file after the overrides `KEY=VALUE` with the words of the error; `figure`
/// tells from the name of the case where to. Nothing is drawn where there is no mesh to speak of.
///
/// # Errors
/// [`RunError::Input`] if the figure cannot be written, or would take the place of something else.
pub fn draw_case(
    file: &Path,
    overrides: &[String],
    read: Result<&(Case, Rc<MacroMesh>), &RunError>,
    figure: impl Fn(&str) -> PathBuf,
) -> Result<Option<PathBuf>, RunError> {
    let (name, content) = match read {
        Ok((case, mesh)) => (case.name.clone(), content(case, mesh)),
        Err(error) => {
            let Some((case, mesh)) = readable(file, overrides) else { return Ok(None) };
            let remarks = remarks(&error.to_string(), file);
            (case.name.clone(), SceneFigure { remarks, ..content(&case, &mesh) })
        }
    };
    let Some(svg) = content.svg() else { return Ok(None) };
    let path = figure(&name);
    write_figure(&path, &svg)?;
    Ok(Some(path))
}

/// Writes a figure, in the place of an older one at most.
fn write_figure(path: &Path, svg: &str) -> Result<(), RunError> {
    let is_other = std::fs::read(path).is_ok_and(|bytes| !bytes.starts_with(b"<svg") && !bytes.starts_with(b"<?xml"));
    if is_other {
        let words = "is there already, and no figure; name another file, as in --draw scene.svg";
        return Err(RunError::Input(format!("{} {words}", path.display())));
    }
    // The folder of results is made anew; one that the user names has to be there.
    let results = path.parent().filter(|folder| *folder == Path::new("out"));
    let written = results.map_or(Ok(()), std::fs::create_dir_all).and_then(|()| std::fs::write(path, svg));
    written.map_err(|error| RunError::Input(format!("{}: the figure cannot be written: {error}", path.display())))
}

/// A case and its mesh as they are solved, or as far as they can be read.
fn readable(file: &Path, overrides: &[String]) -> Option<(Case, MacroMesh)> {
    let text = read_text(file, "case").ok()?;
    let case = Case::parse(&text, file, overrides).ok().or_else(|| Case::draft(&text, file, overrides))?;
    let bytes = scene::read_mesh_file(&case).ok()?;
    let mesh = scene::read_mesh(&case, &bytes).ok().or_else(|| scene::read_bare_mesh(&case, &bytes))?;
    Some((case, mesh))
}

/// The lines of an error, without the name of the case file, broken where they are long.
fn remarks(words: &str, file: &Path) -> Vec<String> {
    let prefix = format!("{}: ", file.display());
    let mut lines: Vec<String> = Vec::new();
    for text in words.lines().map(|text| text.trim_start_matches(prefix.as_str())).filter(|text| !text.trim().is_empty()) {
        lines.push(String::new());
        for word in text.split_whitespace() {
            let line = lines.last_mut().expect("one was just pushed");
            match line.is_empty() {
                true => line.push_str(word),
                false if line.chars().count() + word.chars().count() < LONGEST_REMARK => *line += &format!(" {word}"),
                false => lines.push(format!("    {word}")),
            }
        }
    }
    lines.iter_mut().for_each(|line| *line = line.chars().take(LONGEST_REMARK + 20).collect());
    let more = (lines.len() > MOST_REMARKS).then(|| "…".to_owned());
    lines.into_iter().take(MOST_REMARKS).chain(more).collect()
}

/// What holds and loads the bodies of a case, as far as it has a place on its mesh.
pub(super) fn acting(case: &Case, mesh: &MacroMesh) -> (Vec<DrawnSupport>, Vec<DrawnLoad>) {
    let on = |names: &[String]| {
        let curves: Vec<String> = names.iter().flat_map(|name| case.curves_of(name)).collect();
        let mut edges: Vec<u32> = mesh.edges_on(&curves).collect();
        edges.dedup();
        rows(mesh, &edges)
    };
    let (mut supports, mut loads) = (supports(case, mesh, &on), loads(case, mesh, &on));
    supports.retain(|support| !support.rows.is_empty());
    loads.retain(|load| !load.rows.is_empty() || load.resultant.is_some());
    (supports, loads)
}

/// Everything of a case that has a place on its mesh.
fn content(case: &Case, mesh: &MacroMesh) -> SceneFigure {
    let (supports, loads) = acting(case, mesh);
    let is_big = mesh.edges.len() > MOST_EDGES;
    let curves = mesh.physical_curves().into_iter().filter(|boundary| case.tool_of(&boundary.name).is_none());
    let named = |boundary: &Boundary| NamedRows { name: boundary.name.clone(), rows: rows(mesh, &boundary.edges), place: None };
    let mut figure = SceneFigure {
        title: title(case).into(),
        parts: parts(case, mesh),
        edges: if is_big { Vec::new() } else { (0..mesh.edges.len() as u32).map(|edge| points(mesh, edge)).collect() },
        boundaries: curves.map(named).collect(),
        contacts: contacts(case, mesh),
        supports,
        loads,
        has_axis: mesh.plane == Plane::Revolution,
        units: units(case),
        remarks: Vec::new(),
    };
    // What has no place on the mesh.
    figure.contacts.retain(|contact| !contact.rows.is_empty());
    figure
}

/// Contacts on both bodies, each with the place where its two sides lie close.
fn contacts(case: &Case, mesh: &MacroMesh) -> Vec<NamedRows> {
    let mut sides: HashMap<&String, (Rows, usize)> = HashMap::new();
    for name in case.contacts.iter().flat_map(|pair| &pair.between) {
        let side = sides.entry(name).or_insert_with(|| {
            let edges: Vec<u32> = mesh.edges_on(&case.curves_of(name)).collect();
            (rows(mesh, &edges), 0)
        });
        side.1 += 1;
    }
    let contact = |pair: &Pair| {
        let both = pair.between.each_ref().map(|name| &sides[name]);
        let place = nearest(both.map(|(rows, _)| rows));
        let is_shared = both.iter().any(|(_, contacts)| *contacts > 1);
        let all = both.iter().flat_map(|(rows, _)| rows);
        let rows = match place {
            Some((place, reach)) if is_shared => all.flat_map(|row| row_beside(row, place.place, reach)).collect(),
            _ => all.cloned().collect(),
        };
        NamedRows { name: pair.name.clone(), rows, place: place.map(|(place, _)| place) }
    };
    case.contacts.iter().map(contact).collect()
}

/// The point of the first boundary that is nearest to the second one, and how far around it a contact of both is drawn.
fn nearest([first, second]: [&Rows; 2]) -> Option<(BoundaryPoint, f64)> {
    let all = [first, second].map(|rows| rows.iter().flatten().copied().collect::<Vec<BoundaryPoint>>());
    let distance = |&[a, b]: &[usize; 2]| {
        let ([x, y], [u, v]) = (all[0][a].place, all[1][b].place);
        (x - u).hypot(y - v)
    };
    let closest = |a: &[usize; 2], b: &[usize; 2]| distance(a).total_cmp(&distance(b));
    let steps = all.each_ref().map(|points| points.len().div_ceil(LOOKS).max(1));
    let pairs = (0..all[0].len()).step_by(steps[0]).flat_map(|a| (0..all[1].len()).step_by(steps[1]).map(move |b| [a, b]));
    let [a, b] = pairs.min_by(closest)?;
    let around = |k: usize, at: usize| at.saturating_sub(steps[k])..(at + steps[k] + 1).min(all[k].len());
    let [a, _] = around(0, a).flat_map(|a| around(1, b).map(move |b| [a, b])).min_by(closest)?;
    let size = |points: &[BoundaryPoint]| {
        let [low, high] = bounds(points.iter().map(|point| point.place));
        (high[0] - low[0]).hypot(high[1] - low[1])
    };
    Some((all[0][a], BESIDE * size(&all[0]).min(size(&all[1]))))
}

/// The parts of a row within a distance of a place.
fn row_beside(row: &[BoundaryPoint], [x, y]: [f64; 2], reach: f64) -> Vec<Vec<BoundaryPoint>> {
    let is_near = |point: &BoundaryPoint| (point.place[0] - x).hypot(point.place[1] - y) <= reach;
    row.chunk_by(|a, b| is_near(a) == is_near(b)).filter(|part| is_near(&part[0])).map(<[_]>::to_vec).collect()
}

/// Points of a curved edge in the figure.
fn bends(mesh: &MacroMesh) -> usize {
    if mesh.edges.len() > MOST_EDGES { FEW_BENDS } else { BENDS }
}

/// Points along an edge.
fn points(mesh: &MacroMesh, edge: u32) -> Vec<[f64; 2]> {
    let count = if mesh.edges[edge as usize].shape.is_some() { bends(mesh) } else { 1 };
    (0..=count).map(|k| mesh.edge_position(edge, k as f64 / count as f64).into()).collect()
}

/// The triangles of each of so many bodies or parts.
fn triangles_of(mesh: &MacroMesh, count: usize, number: impl Fn(&MacroTriangle) -> u32) -> Vec<Vec<usize>> {
    let mut all = vec![Vec::new(); count];
    mesh.triangles.iter().enumerate().for_each(|(k, triangle)| all[number(triangle) as usize].push(k));
    all
}

/// Parts of bodies with their triangles.
fn parts(case: &Case, mesh: &MacroMesh) -> Vec<DrawnPart> {
    let part = |(number, own): (usize, Vec<usize>)| {
        let around = |&triangle: &usize| {
            let triangle = &mesh.triangles[triangle];
            let side = |(edge, forward): (u32, bool)| {
                let mut points = points(mesh, edge);
                if !forward {
                    points.reverse();
                }
                points.pop();
                points
            };
            triangle.edges.into_iter().zip(triangle.forward).flat_map(side).collect()
        };
        let surface = &mesh.parts[number];
        let body = &mesh.bodies[surface.body as usize];
        let name = if *body == surface.name { body.clone() } else { format!("{body}: {}", surface.name) };
        let (is_rigid, triangles) = (case.tool_of(body).is_some(), own.iter().map(around).collect());
        DrawnPart { name, is_rigid, triangles, inside: inside(mesh, &own).into() }
    };
    triangles_of(mesh, mesh.parts.len(), |triangle| triangle.part).into_iter().enumerate().map(part).collect()
}

/// The middle of the triangle that is farthest from the boundary of its part, by the corners of that.
fn inside(mesh: &MacroMesh, own: &[usize]) -> Point {
    let part = own.first().map(|&triangle| mesh.triangles[triangle].part);
    let is_outer = |edge: u32| {
        mesh.edges[edge as usize].triangles.iter().any(|beside| beside.map(|k| mesh.triangles[k as usize].part) != part)
    };
    let mut corners: Vec<Point> = Vec::new();
    for edge in own.iter().flat_map(|&triangle| mesh.triangles[triangle].edges).filter(|&edge| is_outer(edge)) {
        corners.extend([0.0, 0.5].map(|t| mesh.edge_position(edge, t)));
    }
    let step = (corners.len() / 400).max(1);
    let middles = own.iter().step_by((own.len() / 1000).max(1)).map(|&triangle| mesh.position(triangle, 1.0 / 3.0, 1.0 / 3.0));
    let depth = |x: &Point| corners.iter().step_by(step).map(|corner| (corner - x).norm()).fold(f64::INFINITY, f64::min);
    middles.map(|x| (depth(&x), x)).reduce(|a, b| if b.0 > a.0 { b } else { a }).map_or_else(Point::zeros, |(_, x)| x)
}

/// Rows of points of boundary edges, one for each stretch without corners.
fn rows(mesh: &MacroMesh, edges: &[u32]) -> Rows {
    let bends = bends(mesh);
    let point = |(edge, k): (u32, usize)| {
        let (triangle, side) = mesh.beside(edge);
        let t = k as f64 / bends as f64;
        let t = if mesh.triangles[triangle as usize].forward[side] { t } else { 1.0 - t };
        let [place, normal] = [mesh.edge_position(edge, t), mesh.edge_normal(edge, t)].map(Into::into);
        BoundaryPoint { place, normal, traction: [0.0; 2] }
    };
    let row = |stretch: Stretch| stretch.edges.iter().flat_map(|&edge| (0..=bends).map(move |k| (edge, k))).map(point).collect();
    mesh.stretches(edges).into_iter().map(row).collect()
}

/// A point as a row of its own.
fn lone_point(place: [f64; 2]) -> Rows {
    vec![vec![BoundaryPoint { place, normal: [0.0, -1.0], traction: [0.0; 2] }]]
}

/// A number, or dots in the place of a formula.
fn value(formula: &Formula) -> String {
    formula.as_constant().map_or_else(|| "…".into(), short)
}

/// What is prescribed.
fn values(components: &[(&str, Option<&Formula>)]) -> String {
    let given = components.iter().filter_map(|(key, formula)| Some(format!("{key} = {}", value((*formula)?))));
    given.collect::<Vec<_>>().join(", ")
}

/// A support that prescribes displacements.
fn fixed_support(support: &Support, on: &dyn Fn(&[String]) -> Rows) -> DrawnSupport {
    let Support { name, ux, uy, normal, at, on: curves } = support;
    let grip = match (ux, uy, normal) {
        (_, _, Some(_)) => Grip::Normal,
        (Some(_), None, _) => Grip::Along([-1.0, 0.0]),
        (None, Some(_), _) => Grip::Along([0.0, -1.0]),
        _ => Grip::Both,
    };
    let words = values(&[("ux", ux.as_ref()), ("uy", uy.as_ref()), ("normal", normal.as_ref())]);
    let rows = at.as_ref().map_or_else(|| on(curves), |spot| lone_point(spot.place));
    DrawnSupport { name: name.clone(), words, rows, grip }
}

/// A support by springs.
fn elastic_support(springs: &Springs, on: &dyn Fn(&[String]) -> Rows) -> DrawnSupport {
    let words = match &springs.stiffness {
        SpringStiffness::Normal(normal) => values(&[("springs, normal", Some(normal))]),
        SpringStiffness::Axes([x, y]) => values(&[("springs, x", x.as_ref()), ("springs, y", y.as_ref())]),
    };
    DrawnSupport { name: springs.name.clone(), words, rows: on(&springs.on), grip: Grip::Springs }
}

fn supports(case: &Case, mesh: &MacroMesh, on: &dyn Fn(&[String]) -> Rows) -> Vec<DrawnSupport> {
    let of_bodies = if case.means.is_empty() { Vec::new() } else { triangles_of(mesh, mesh.bodies.len(), |k| k.body) };
    let held = case.means.iter().filter_map(|mean| {
        let body = mesh.bodies.iter().position(|name| *name == mean.body)?;
        let rows = lone_point(inside(mesh, &of_bodies[body]).into());
        let held = mean.held.iter().map(|(key, .., way)| format!("{key} = {}", short(*way)));
        let words = format!("mean {}", held.collect::<Vec<_>>().join(", "));
        Some(DrawnSupport { name: mean.name.clone(), words, rows, grip: Grip::Both })
    });
    let fixed = case.supports.iter().map(|support| fixed_support(support, on));
    fixed.chain(case.springs.iter().map(|springs| elastic_support(springs, on))).chain(held).collect()
}

/// A pressure or traction along its boundaries.
fn surface_load(load: &Load, on: &dyn Fn(&[String]) -> Rows) -> DrawnLoad {
    let mut rows = on(&load.on);
    for point in rows.iter_mut().flatten() {
        let value = |formula: &Formula| formula.value(&point.place);
        point.traction = match &load.kind {
            LoadKind::Pressure(pressure) => point.normal.map(|part| -part * value(pressure)),
            LoadKind::Traction(traction) => [value(&traction[0]), value(&traction[1])],
        };
        point.traction = point.traction.map(|part| if part.is_finite() { part } else { 0.0 });
    }
    let words = match &load.kind {
        LoadKind::Pressure(pressure) => values(&[("pressure", Some(pressure))]),
        LoadKind::Traction([x, y]) => values(&[("tx", Some(x)), ("ty", Some(y))]),
    };
    DrawnLoad { name: load.name.clone(), words, rows, ..DrawnLoad::default() }
}

/// Both components of a vector.
pub(super) fn vector(v: Point) -> String {
    format!("({}, {})", number_text(v.x), number_text(v.y))
}

/// What drives a stiff plate or a tool: its force and moment, whole ones in a case with a thickness, and those of its motions that are
/// given.
fn driven_words(motion: &RigidSet, thickness: f64, units: &Units) -> String {
    let [fx, fy, moment] = motion.applied.map(|part| part * thickness);
    let force = Point::new(fx, fy);
    let force = (force != Point::zeros()).then(|| format!("force {}{}", vector(force), units.resultant().after()));
    let moment = (moment != 0.0).then(|| format!("moment {} about {}", number_text(moment), vector(motion.about)));
    let moved = ["ux", "uy", "angle"].iter().zip(motion.prescribed);
    let moved = moved.filter_map(|(key, way)| Some(format!("{key} = {}", short(way?))));
    let all: Vec<String> = force.into_iter().chain(moment).chain(moved).collect();
    match all[..] {
        [] => "free".into(),
        _ if motion.stays() => "stays".into(),
        _ => all.join(", "),
    }
}

fn loads(case: &Case, mesh: &MacroMesh, on: &dyn Fn(&[String]) -> Rows) -> Vec<DrawnLoad> {
    let arrow = |name: &str, words: String, place: [f64; 2], along: [f64; 2]| DrawnLoad {
        name: name.into(),
        words,
        resultant: Some((place, along)),
        ..DrawnLoad::default()
    };
    let units = units(case);
    let sets = case.rigid_sets(mesh);
    let plates = case.plates.iter().zip(&sets[case.tools.len()..]).map(|(plate, motion)| {
        let rows = on(&plate.on);
        let [fx, fy, _] = motion.applied;
        let middle = rows.iter().flatten().nth(rows.iter().flatten().count() / 2).map_or([0.0; 2], |point| point.place);
        let words = format!("stiff plate, {}", driven_words(motion, case.thickness, &units));
        DrawnLoad { rows, is_plate: true, ..arrow(&plate.name, words, middle, [fx, fy]) }
    });
    let at_points = case.point_loads.iter().map(|load| {
        let (place, force) = (load.at.place, load.force().into());
        let words = format!("force {}{}", vector(load.force() * case.thickness), units.resultant().after());
        DrawnLoad { rows: lone_point(place), ..arrow(&load.name, words, place, force) }
    });
    let tools = case.tools.iter().filter_map(|tool| {
        let [fx, fy, _] = tool.motion.applied;
        let moved = [0, 1].map(|k| tool.motion.prescribed[k].unwrap_or(0.0));
        let along = if fx != 0.0 || fy != 0.0 { [fx, fy] } else { moved };
        let words = driven_words(&tool.motion, case.thickness, &units);
        (along != [0.0; 2]).then(|| arrow(tool.key(), words, tool.motion.about.into(), along))
    });
    let of_parts = triangles_of(mesh, mesh.parts.len(), |triangle| triangle.part);
    let weights = case.bodies.iter().flat_map(|body| &body.parts).filter_map(|part| {
        let number = mesh.parts.iter().position(|surface| surface.name == part.name)?;
        let place = inside(mesh, &of_parts[number]);
        let force = [0, 1].map(|k| part.force[k].value(&[place.x, place.y]));
        let acts = force.iter().all(|part| part.is_finite()) && force != [0.0; 2];
        let [x, y] = part.force.each_ref().map(value);
        let words = format!("({x}, {y}) for each volume");
        let acting = || arrow(&format!("force in {}", part.name), words, place.into(), force);
        acts.then(|| DrawnLoad { part: Some(number), ..acting() })
    });
    case.loads.iter().map(|load| surface_load(load, on)).chain(plates).chain(at_points).chain(tools).chain(weights).collect()
}
