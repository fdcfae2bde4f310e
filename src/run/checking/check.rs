//! `mezha check`.

use crate::body::{Applied, Body, BodyPart, Material, applied_forces};
use crate::case::{Case, CaseError, Matched, NO_CONTACT, Tool, read_text};
use crate::contact::{GapChoice, Pair, drawn_gap};
use crate::discretisation::Scene;
use crate::element::{Heat, Order, Plane};
use crate::geometry::{Formula, Point};
use crate::mesh::{MacroMesh, Numbering};
use crate::output::plot::{BoundaryPoint, DrawnLoad, DrawnSupport};
use crate::output::summary::{MOST_TOLD, lines_alike};
use crate::output::{RunError, Units};
use crate::procedure::Procedure;
use crate::run::checking::drawing::{acting, vector};
use crate::run::checking::proposals::{proposed_contacts, proposed_supports, short, take_refused, with_tables};
use crate::run::checking::tools::{ProposedTool, proposed_tools};
use crate::run::reading::checks::check_pressures;
use crate::run::reading::{origin, scene};
use crate::run::telling::report::contact_lines;
use crate::run::verdict::warnings::before::{far_turns, idle, slits};
use crate::run::verdict::warnings::loose::pulled_off;
use crate::run::words::units;
use crate::run::{accuracy, memory};
use std::path::Path;
use std::rc::Rc;

/// Names that a pattern stands for which are told.
const MOST_MATCHED: usize = 5;

/// What a look at a case finds.
#[derive(Clone, Debug)]
pub struct Checked {
    /// What would be solved.
    pub words: String,
    /// Words for bodies with a slit, for tools and plates that turn too far, and for a run that would be refused on this machine, for want of memory.
    pub warnings: Vec<String>,
    /// Words for a body that can move though contact is closed everywhere, or that its loads drive off all its contacts; nothing if
    /// all are held.
    pub not_held: Option<String>,
    /// Contacts, rigid tools and supports that may be missing, as TOML to paste, with words before them; empty if there is nothing to
    /// propose.
    pub proposals: String,
    /// The case and its mesh, as they were read, to be drawn.
    pub read: (Case, Rc<MacroMesh>),
}

/// The same of a case file, after the overrides `KEY=VALUE`.
///
/// # Errors
/// [`RunError::Input`] with everything that is wrong.
pub fn check_file(file: &Path, overrides: &[String]) -> Result<Checked, RunError> {
    let text = read_text(file, "case").map_err(|error| RunError::Input(error.to_string()))?;
    let case = Case::parse(&text, file, overrides).map_err(|error| refused(&error, Case::draft(&text, file, overrides)))?;
    check(&case)
}

/// Words for a case that cannot be read whole, with the contacts that it may want where it lacks any for what it asks for.
fn refused(error: &CaseError, draft: Option<Case>) -> RunError {
    let words = scene::told_with_names(error, draft.clone());
    let draft = draft.filter(|_| words.contains(NO_CONTACT));
    let mesh = |case: &Case| scene::read_bare_mesh(case, &scene::read_mesh_file(case).ok()?);
    let proposed = draft.and_then(|case| Some(proposals(&case, &mesh(&case)?, false))).filter(|text| !text.is_empty());
    RunError::Input(words + &proposed.map_or(String::new(), |text| format!("\n\n{text}")))
}

/// Reads everything, solves nothing on the mesh of the case, and says what would be solved, and whether contact would hold all bodies:
/// closed everywhere, and, as far as a coarse mesh tells it at little cost, under the loads.
///
/// # Errors
/// [`RunError::Input`] with words.
pub fn check(case: &Case) -> Result<Checked, RunError> {
    describe(case).map_err(|error| error.in_case(case))
}

fn describe(case: &Case) -> Result<Checked, RunError> {
    let bytes = scene::read_mesh_file(case).map_err(RunError::Input)?;
    origin::result_before(case, &bytes).map_err(RunError::Input)?;
    let mesh = Rc::new(scene::read_mesh(case, &bytes).map_err(RunError::Input)?);
    let slits = slits(&mesh);
    let scene = scene::first(case, Rc::clone(&mesh))?;
    let not_held_before = check_steps(case, &scene)?;
    let at_rest = Procedure::look(&scene, 0)?;
    check_pressures(case, &at_rest.contacts).map_err(RunError::Key)?;
    let triangles = scene.mesh.triangles.len() * at_rest.numbering.level.triangles_per_edge().pow(2);
    let order = if scene.order == Order::P1 { "P1" } else { "P2" };
    let (whole, refine, unknowns) = (scene.mesh.triangles.len(), scene.refine, 2 * at_rest.numbering.node_count());
    let words = format!("{triangles} {order} triangles after {refine} refinements, {unknowns} unknowns of displacement");
    let mut lines = vec![format!("{}: {}", case.name, case.title), format!("mesh: {whole} macro triangles, {words}")];
    lines.extend(case.matched.iter().map(matched));
    let is_tool = |name: &str| case.tools.iter().any(|tool| tool.key().strip_prefix("rigid.") == Some(name));
    let aside = scene.mesh.loose.iter().map(|curve| &curve.name).filter(|name| !is_tool(name));
    lines.extend(aside.map(|name| format!("curve {name}: bounds no body, and is left aside")));
    lines.extend(body_lines(case));
    lines.extend(contact_lines(&at_rest.contacts, &units(case)));
    lines.extend(acting_lines(case, &scene, &at_rest.numbering));
    if let Some(accuracy) = &case.accuracy {
        lines.push(format!("accuracy asked for: {}; the mesh is adapted to it", accuracy::request(accuracy)));
    }
    if let Some(last) = case.steps.last() {
        lines.push(format!("{} load steps; the last one is {}", last.count, last.words()));
    }
    let [need, of_macro_mesh] = Procedure::look_at_need(&scene, case.solver.choice, case.solver.tolerance);
    // An accuracy has a limit to its meshes.
    let (memory, warning) = if case.accuracy.is_none() { memory::told(need, of_macro_mesh) } else { Default::default() };
    lines.extend((!memory.is_empty()).then_some(memory));
    let idle = idle(&scene, &at_rest.numbering).filter(|_| case.steps.is_empty());
    let warnings = slits.into_iter().chain(far_turns(case)).chain(idle).chain(warning).collect();
    let last = |words: String| case.steps.last().map_or_else(|| words.clone(), |step| format!("{}: {words}", step.words()));
    let not_held = match not_held_before {
        None => match at_rest.not_held(&scene)? {
            // What a hold would carry unseen is told before it.
            Some(words) => Some(pulled_off(&scene).map_or(words.clone(), |pulled| format!("{pulled}; and {words}"))),
            None => driven_off(case, &scene),
        }
        .map(last),
        before => before,
    };
    let proposals = proposals(case, &scene.mesh, not_held.is_some());
    Ok(Checked { words: lines.join("\n"), warnings, not_held, proposals, read: (case.clone(), mesh) })
}

/// What a pattern of the case stands for: of many the number and the first.
fn matched(Matched { place, kind, names }: &Matched) -> String {
    let kind = match (names.len(), *kind) {
        (1, kind) => kind.to_owned(),
        (_, "body") => "bodies".into(),
        (_, kind) => format!("{kind}s"),
    };
    let first = names[..names.len().min(MOST_MATCHED)].join(", ");
    let more = if names.len() > MOST_MATCHED { ", ..." } else { "" };
    format!("{place}: {} {kind}: {first}{more}", names.len())
}

/// A line for each part of a body, and for each rigid tool; of many one for each material.
fn body_lines(case: &Case) -> Vec<String> {
    let stress = units(case);
    let stress = stress.stress().after();
    let words = |(body, part): (&Body, &BodyPart)| {
        let Material { young, poisson, plane } = part.material;
        let plane = match plane {
            Plane::Strain => "",
            Plane::Stress => ", plane stress",
            Plane::Revolution => ", of revolution",
        };
        let heat = part
            .heat
            .as_ref()
            .map(|Heat { expansion, temperature }| format!(", heated: α = {expansion:?}, ϑ = {}", temperature.text()));
        let of = if body.has_parts() { format!("{}, part {}", body.name, part.name) } else { body.name.clone() };
        (format!("E = {young}{stress}, ν = {poisson}{plane}{}", heat.unwrap_or_default()), of)
    };
    let tool = |tool: &Tool| (if tool.motion.stays() { "rigid, stays" } else { "rigid" }.to_owned(), tool.key().to_owned());
    let all = case.parts().map(words).chain(case.tools.iter().map(tool));
    lines_alike(["body", "bodies or parts"], all).into_iter().map(|(_, line)| line).collect()
}

/// What may be missing, as TOML to paste.
fn proposals(case: &Case, mesh: &MacroMesh, is_loose: bool) -> String {
    let [contacts, mut refused] = proposed_contacts(case, mesh);
    let supports = if is_loose { proposed_supports(case).tables } else { Vec::new() };
    let (mut tools, _) = proposed_tools(mesh, &case.tools, &case.contacts);
    let tables = |tools: &[ProposedTool]| -> Vec<String> { tools.iter().map(|tool| tool.text.clone()).collect() };
    let aside = take_refused(&mut tools, |tool| &tool.between, |tools| with_tables(case, tables(tools)));
    refused.extend(aside.into_iter().map(|(tool, why)| tool.set_aside(&why)));
    let mut text = String::new();
    for (tables, words) in [
        (contacts, "these boundaries lie close and are in no contact; if they may touch, paste this into the case:"),
        (tables(&tools), "these curves of the mesh bound no body; if they are rigid tools, paste this into the case:"),
        (supports, "supports like these would hold the bodies; paste into the case what you mean:"),
    ] {
        if !tables.is_empty() {
            text += &format!("\n{words}\n\n{}", tables.join("\n"));
        }
    }
    refused.iter().for_each(|words| text += &format!("\n{words}\n"));
    text.trim_end().to_owned()
}

/// Looks at all load steps but the last, which is the case itself: words for the first that is refused.
fn check_steps(case: &Case, last: &Scene) -> Result<Option<String>, RunError> {
    for step in case.steps.iter().rev().skip(1).rev() {
        let scene = scene::of_step(step, last);
        let words = Procedure::look(&scene, 0).and_then(|at_rest| at_rest.not_held(&scene));
        let words = words.map_err(|error| RunError::from(error).in_step(step))?;
        if let Some(words) = words.or_else(|| driven_off(case, &scene)) {
            return Ok(Some(format!("{}: {words}", step.words())));
        }
    }
    Ok(None)
}

/// Words for a body that the loads of a scene drive off all its contacts.
fn driven_off(case: &Case, scene: &Scene) -> Option<String> {
    Procedure::driven_off(scene, case.accuracy.as_ref(), case.steps.len().max(1))
}

/// Parts of a resultant below this share of its pieces are rounding.
const ROUNDING: f64 = 1e-9;

/// Of so many things of a kind is found what is said of them; a thousand gaps would take their time.
const MOST_LOOKED_AT: usize = 100;

/// What acts on a scene, in lines, of each kind as many as are told: loads with their resultants, supports with what they hold, contacts
/// with how far apart their sides are drawn.
fn acting_lines(case: &Case, scene: &Scene, numbering: &Numbering) -> Vec<String> {
    let (units, (supports, loads)) = (units(case), acting(case, &scene.mesh));
    // The mesh of the file is fine enough for resultants.
    let coarse = scene.macro_numbering().ok();
    let idle =
        scene.parts().into_iter().map(|part| BodyPart { force: [0.0; 2].map(Formula::constant), heat: None, ..part.clone() });
    let idle: Vec<BodyPart> = idle.collect();
    let resultant = |load: &DrawnLoad| {
        let (force, size) = resultant(scene, (coarse.as_ref()?, &idle), load)?;
        let force = scene.mesh.plane.resultant(force).map(|part| if part.abs() < ROUNDING * size { 0.0 } else { part });
        Some(format!(", resultant {}{}", vector(force * case.thickness), units.resultant().after()))
    };
    let load = |load: &DrawnLoad| (format!("{}{}", load.words, resultant(load).unwrap_or_default()), load.name.clone());
    let mut lines = few(["load", "loads"], loads.len(), loads.iter().map(load));
    let support = |support: &DrawnSupport| (support.words.clone(), support.name.clone());
    lines.extend(few(["support", "supports"], supports.len(), supports.iter().map(support)));
    let contact = |pair: &Pair| (gap_words(scene, numbering, pair, &units), pair.name.clone());
    lines.extend(few(["contact", "contacts"], scene.pairs.len(), scene.pairs.iter().map(contact)));
    lines
}

/// As many lines as are told, and how many more there are.
fn few(kind: [&str; 2], count: usize, all: impl Iterator<Item = (String, String)>) -> Vec<String> {
    let told: Vec<(usize, String)> = lines_alike(kind, all.take(MOST_LOOKED_AT)).into_iter().take(MOST_TOLD).collect();
    let more = count - told.iter().map(|(own, _)| own).sum::<usize>();
    // Figures have a minus sign of their own.
    let lines = told.into_iter().map(|(_, line)| line.replace('−', "-"));
    lines.chain((more > 0).then(|| format!("and {more} more {}", kind[1]))).collect()
}

/// The force of tractions along a boundary, or in a part of a mesh whose parts are `idle`, per thickness, of the whole ring in a body of
/// revolution, and how large its pieces are together; nothing where the words tell the force.
fn resultant(scene: &Scene, (numbering, idle): (&Numbering, &[BodyPart]), load: &DrawnLoad) -> Option<(Point, f64)> {
    let plane = scene.mesh.plane;
    let mut pieces: Vec<Point> = Vec::new();
    if let Some(own) = load.part {
        let loaded = BodyPart { heat: None, ..scene.parts()[own].clone() };
        let mut parts: Vec<&BodyPart> = idle.iter().collect();
        parts[own] = &loaded;
        let applied = Applied { parts: &parts, loads: &[], point_loads: &[] };
        applied_forces(&scene.mesh, &scene.partition, 0, numbering, &applied, |_, force| pieces.push(force)).ok()?;
    } else if load.resultant.is_none() {
        let traction = |two: &[BoundaryPoint]| {
            let [a, b] = [&two[0], &two[1]].map(|end| (Point::from(end.place), Point::from(end.traction)));
            0.5 * (a.1 + b.1) * (b.0 - a.0).norm() * plane.width(0.5 * (a.0 + b.0))
        };
        pieces.extend(load.rows.iter().flat_map(|row| row.windows(2)).map(traction));
    }
    (!pieces.is_empty()).then(|| (pieces.iter().sum(), pieces.iter().map(|piece| piece.norm()).sum()))
}

/// How far the sides of a contact are drawn apart, or into each other, or what gap is given in the place of that.
fn gap_words(scene: &Scene, numbering: &Numbering, pair: &Pair, units: &Units) -> String {
    let length = |length: f64| short(length) + &units.length().after();
    match &pair.gap {
        GapChoice::Closed => return "closed, wherever its sides are drawn".into(),
        GapChoice::Formula(gap) => return format!("a gap of {} is given", gap.text()),
        GapChoice::Geometry => {}
    }
    match drawn_gap(&scene.mesh, numbering, pair) {
        None => "its sides do not face each other as they are drawn".into(),
        Some(gap) if gap.touches() => "its sides are drawn touching".into(),
        Some(gap) if gap.least > 0.0 => format!("its sides are drawn {} apart", length(gap.least)),
        Some(gap) => format!("its sides are drawn {} into each other, which presses", length(-gap.least)),
    }
}
