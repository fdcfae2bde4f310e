//! Curves of the mesh that bound no body, as rigid tools to paste.

use super::node_circle::NodeCircle;
use super::proposals::{TableNames, common_name, digits, quoted};
use crate::case::Tool;
use crate::contact::Pair;
use crate::geometry::{Curve, Point, cross, turn_right};
use crate::mesh::{Boundary, CurvePiece, LooseCurve, MacroMesh};
use std::f64::consts::TAU;

/// Points that are nearer than this share of its length to the line between the ends of a curve lie on it.
const STRAIGHT: f64 = 1e-6;

/// A tool faces a boundary if the cosine of the angle between their normals is larger than this (60 degrees).
const FACES: f64 = 0.5;

/// A tool that is farther than this share of a curve's size from any of its points is another one.
const ELSEWHERE: f64 = 1e-6;

/// The example moves a tool into the body by this share of the narrow side of the body's box: its nominal strain is no larger.
pub const PRESSED: f64 = 1e-3;

/// A line that lies in a body deeper than this share of its narrow side presses on none: nominal strains of a tenth are not small.
const DEEP: f64 = 0.1;

/// A rigid tool that a curve of the mesh may be drawn for.
pub struct ProposedTool {
    /// Name of the curve.
    curve: String,
    /// The boundary that it presses on, and the tool.
    pub between: [String; 2],
    /// Its tables.
    pub text: String,
}

impl ProposedTool {
    /// Words for a tool that is not proposed.
    pub fn set_aside(&self, why: &str) -> String {
        set_aside(&self.curve, why)
    }
}

fn set_aside(curve: &str, why: &str) -> String {
    format!("curve {} bounds no body, and is not taken for a rigid tool: {why}", quoted(curve))
}

/// The tools that the curves without triangles may be drawn for: those that are straight or circles, face a boundary, do not lie inside of
/// a body, and are none of the tools of the case; and words for each curve that none can be made of.
pub fn proposed_tools(mesh: &MacroMesh, tools: &[Tool], contacts: &[Pair]) -> (Vec<ProposedTool>, Vec<String>) {
    let mut names = TableNames::of(tools.iter().map(|tool| tool.key().trim_start_matches("rigid.").to_owned()));
    let mut names_of_contacts = TableNames::of(contacts.iter().map(|pair| pair.name.clone()));
    let (mut proposed, mut aside) = (Vec::new(), Vec::new());
    for curve in mesh.loose.iter().filter(|curve| !tools.iter().any(|tool| is_drawn(curve, &tool.surface))) {
        match pressing(mesh, tools, curve) {
            Ok((boundary, lines)) => {
                let name = names.fresh(&curve.name);
                let contact = names_of_contacts.fresh(&common_name(&[boundary.clone(), name.clone()]));
                let between = [boundary, format!("rigid.{name}")];
                let sides = between.each_ref().map(|side| quoted(side)).join(", ");
                let text = format!("[rigid.{name}]\n{lines}\n[contact.{contact}]\nbetween = [{sides}]\n");
                proposed.push(ProposedTool { curve: curve.name.clone(), between, text });
            }
            Err(why) => aside.push(set_aside(&curve.name, &why)),
        }
    }
    (proposed, aside)
}

/// The boundary that a curve would press on as a tool, and the lines of its table; or why it is none.
fn pressing(mesh: &MacroMesh, tools: &[Tool], curve: &LooseCurve) -> Result<(String, String), String> {
    let (shape, surface) = shape_of(curve).ok_or("it is neither straight nor a circle")?;
    let (boundary, normal, gap) = pressed(mesh, tools, &surface).ok_or("it faces no boundary that has a name")?;
    let body = mesh.body_beside(boundary.edges[0]);
    let own = mesh.pieces.iter().zip(mesh.bounds()).filter(|(piece, _)| piece.body == body);
    let narrow = own.map(|(_, [low, high])| (high - low).min()).fold(f64::INFINITY, f64::min);
    let of_body = |triangle: &usize| mesh.triangles[*triangle].body as usize == body;
    let holds = |x: &Point| (0..mesh.triangles.len()).filter(of_body).any(|triangle| mesh.locate(triangle, *x).is_some());
    if (!surface.curve.is_line() || -gap > DEEP * narrow) && curve.lines.iter().flatten().all(holds) {
        return Err(format!("it lies inside of body {}", quoted(&mesh.bodies[body])));
    }
    Ok((boundary.name.clone(), format!("{shape}\n{}", moved(normal, gap.max(0.0) + PRESSED * narrow))))
}

/// How the example moves a tool: along one axis, against the normal of what it presses on.
fn moved(normal: Point, way: f64) -> String {
    let axis = normal.iamax();
    let way = -normal[axis].signum() * way;
    let words = "example: how far it is moved; or, in the place of this, force = [fx, fy]";
    let key = |k: usize, key: &str| match k == axis {
        true => format!("{key} = {}   # {words}\n", digits(way, way.abs())),
        false => format!("{key} = 0.0\n"),
    };
    format!("{}{}angle = 0.0\n", key(0, "ux"), key(1, "uy"))
}

/// Whether a curve is that of a tool: all of its points lie on that.
fn is_drawn(curve: &LooseCurve, surface: &[CurvePiece]) -> bool {
    let points = || curve.lines.iter().flatten();
    let size = points().map(|x| (x - curve.lines[0][0]).norm()).fold(0.0, f64::max);
    points().all(|x| surface.iter().any(|part| (foot(part, *x).0 - x).norm() <= ELSEWHERE * size))
}

/// The point of a part that is nearest to another point, and the normal there.
fn foot(part: &CurvePiece, x: Point) -> (Point, Point) {
    let t = part.curve.nearest(x);
    let t = if part.curve.is_line() { t.clamp(part.range[0], part.range[1]) } else { t };
    (part.curve.point(t), turn_right(part.curve.tangent(t)))
}

/// The shape of a curve as a key of its table, and as a surface; nothing where it is neither a circle nor straight.
fn shape_of(curve: &LooseCurve) -> Option<(String, CurvePiece)> {
    if let Some(NodeCircle { centre, radius }) = NodeCircle::through(&curve.lines) {
        let [x, y, radius] = [centre.x, centre.y, radius].map(|part| digits(part, radius));
        let surface = CurvePiece { curve: Curve::Circle { centre: [x, y], radius }.into(), range: [0.0, TAU] };
        return Some((format!("circle = {{ centre = [{x:?}, {y:?}], radius = {radius:?} }}"), surface));
    }
    let points = curve.lines.as_flattened();
    let farthest = |from: Point| points.iter().copied().max_by(|a, b| (a - from).norm().total_cmp(&(b - from).norm()));
    let first = farthest(points[0])?;
    let last = farthest(first)?;
    let (way, size) = (last - first, (last - first).norm());
    let is_straight = points.iter().all(|x| cross(way, x - first).abs() <= STRAIGHT * size * size);
    let ends = [last, first].map(|x| [x.x, x.y].map(|part| digits(part, size)));
    is_straight.then(|| (format!("line = {ends:?}"), CurvePiece { curve: Curve::Line(ends).into(), range: [0.0, 1.0] }))
}

/// The named boundary that a surface faces nearest, its normal there, and how far it is along that (length).
fn pressed<'a>(mesh: &'a MacroMesh, tools: &[Tool], surface: &CurvePiece) -> Option<(&'a Boundary, Point, f64)> {
    let curves = mesh.physical_curves().into_iter().filter(|curve| !tools.iter().any(|tool| tool.has(&curve.name)));
    let named = curves.flat_map(|boundary| boundary.edges.iter().map(move |&edge| (boundary, edge)));
    let places = named.flat_map(|(boundary, edge)| [0.0, 0.5, 1.0].map(|t| (boundary, edge, t)));
    let facing = places.filter_map(|(boundary, edge, t)| {
        let (x, normal) = (mesh.edge_position(edge, t), mesh.edge_normal(edge, t));
        let (foot, across) = foot(surface, x);
        (across.dot(&normal).abs() > FACES).then(|| (foot - x, normal, boundary))
    });
    let (way, normal, boundary) = facing.min_by(|a, b| a.0.norm().total_cmp(&b.0.norm()))?;
    Some((boundary, normal, way.dot(&normal)))
}
