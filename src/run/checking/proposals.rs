//! What a case may lack, as TOML to paste: contacts of boundaries that lie close, and supports of what can move.

use crate::body::MOTIONS;
use crate::case::Case;
use crate::case::error::dotted;
use crate::contact::{ClosePair, Mechanism, close_pairs, drawn_gap};
use crate::discretisation::{self, Scene};
use crate::element::Order;
use crate::geometry::Point;
use crate::mesh::{Level, MacroMesh, Numbering, Partition, Spot};
use crate::procedure::Procedure;
use crate::run::reading::checks::coarse_arcs;
use crate::run::reading::scene;
use std::rc::Rc;
use toml::Value;

/// Supports that are proposed at most: whoever lacks more has to think anyway.
const MOST_SUPPORTS: usize = 100;

/// Boundaries that are proposed for a contact are nearer than this share of the smaller body.
const CLOSE: f64 = 0.02;

/// Of so many pairs is found how far apart they are drawn; a thousand would take their time.
const MOST_MEASURED: usize = 100;

/// Parts of an edge of the mesh between the places at which sides are compared.
const PARTS: usize = 8;

/// Those that are nearer than this share of it are drawn touching.
const TOUCHING: f64 = 1e-6;

/// Coordinates below this share of a size are 0.
const ROUNDING: f64 = 1e-9;

/// A name as a TOML string.
pub(crate) fn quoted(name: &str) -> String {
    Value::String(name.into()).to_string()
}

/// A name as a TOML key.
pub(crate) fn key(name: &str) -> String {
    dotted(&[name.into()])
}

/// Names of tables, none twice.
#[derive(Clone, Default)]
pub(crate) struct TableNames(Vec<String>);

impl TableNames {
    pub fn of(names: impl Iterator<Item = String>) -> Self {
        Self(names.collect())
    }

    /// This name, or with a number behind it if it is there already. Only letters that may be in file names.
    pub fn fresh(&mut self, wish: &str) -> String {
        let plain = |c: char| if c.is_ascii_alphanumeric() || c == '_' { c } else { '-' };
        let wish: String = wish.chars().map(plain).take(60).collect();
        let wish = if wish.chars().all(|c| c == '-') { "part".to_owned() } else { wish };
        let is_new = |name: &String| !self.0.iter().any(|other| other.eq_ignore_ascii_case(name));
        let numbered = (2..).map(|number| format!("{wish}-{number}"));
        let name = std::iter::once(wish.clone()).chain(numbered).find(is_new).unwrap_or(wish);
        self.0.push(name.clone());
        name
    }
}

/// What two boundaries are called together: what their names end with, `seam` of `lower.seam` and `upper.seam`, or both names.
pub(crate) fn common_name([first, second]: &[String; 2]) -> String {
    let last = |name: &str| name.rsplit(['.', '_', ' ', '-']).next().unwrap_or_default().to_owned();
    let (a, b) = (last(first), last(second));
    if a == b && a.contains(char::is_alphabetic) && a.len() < first.len() { a } else { format!("{first}-{second}") }
}

/// `[contact.NAME]` of a pair.
pub(crate) fn contact_table(pair: &ClosePair, names: &mut TableNames) -> String {
    let [a, b] = pair.between.each_ref().map(|name| quoted(name));
    format!("[contact.{}]\nbetween = [{a}, {b}]{}\n", names.fresh(&common_name(&pair.between)), distance_words(pair))
}

/// How far apart a pair is drawn, as a comment.
fn distance_words(pair: &ClosePair) -> String {
    match pair.distance {
        _ if pair.share() < TOUCHING => "   # they are drawn touching".into(),
        apart if apart > 0.0 => format!("   # they are drawn {} apart", short(apart)),
        into => format!("   # they are drawn {} into each other", short(-into)),
    }
}

/// A length with three digits.
pub(crate) fn short(value: f64) -> String {
    format!("{value:.2e}").parse::<f64>().unwrap_or(value).to_string()
}

/// A coordinate with ten digits; one that is rounding beside a size of what it belongs to is 0.
pub(crate) fn digits(value: f64, size: f64) -> f64 {
    if value.abs() < ROUNDING * size { 0.0 } else { format!("{value:.9e}").parse::<f64>().unwrap_or(value) }
}

/// Contacts that a case may have forgotten: boundaries that lie close, of bodies between which it has none, or elsewhere than those
/// that it has; and what is said of those of which no contact can be made.
pub(crate) fn proposed_contacts(case: &Case, mesh: &MacroMesh) -> [Vec<String>; 2] {
    let taken: Vec<[String; 2]> = case.contacts.iter().map(|contact| contact.between.clone()).collect();
    let names = TableNames::of(case.contacts.iter().map(|pair| pair.name.clone()));
    let is_close = |pair: &ClosePair| pair.distance <= CLOSE * pair.size;
    let mut close: Vec<ClosePair> = close_pairs(mesh, &taken).into_iter().filter(is_close).collect();
    let tables = |close: &[ClosePair], mut names: TableNames| close.iter().map(|pair| contact_table(pair, &mut names)).collect();
    let with = |pairs: &[ClosePair]| with_tables(case, tables(pairs, names.clone()));
    if let Some(case) = with(&close) {
        measure(&mut close, &case);
    }
    let told = |(pair, why): (ClosePair, String)| {
        let [a, b] = pair.between.each_ref().map(|name| quoted(name));
        format!("the boundaries {a} and {b} lie close; as they are drawn no contact can be made of them: {why}")
    };
    let refused = take_refused(&mut close, |pair| &pair.between, with).into_iter().map(told).collect();
    [tables(&close, names.clone()), refused]
}

/// A case with further tables, if that is one.
pub(crate) fn with_tables(case: &Case, tables: Vec<String>) -> Option<Case> {
    Case::parse(&format!("{}\n{}", case.resolved(), tables.join("\n")), &case.file, &[]).ok()
}

/// Takes away what stands for contacts between two sides that cannot be made as they are drawn, with the reasons; `with` is the case
/// with some of them. One look names all that are refused, a second one sees that no other is.
pub(crate) fn take_refused<T>(
    items: &mut Vec<T>,
    between: impl Fn(&T) -> &[String; 2],
    with: impl Fn(&[T]) -> Option<Case>,
) -> Vec<(T, String)> {
    let mut taken = Vec::new();
    while !items.is_empty() {
        let refused = with(items).map_or_else(Vec::new, |case| refused_contacts(&case));
        let before = taken.len();
        for item in std::mem::take(items) {
            match refused.iter().find(|(sides, _)| sides == between(&item)) {
                Some((_, why)) => taken.push((item, why.clone())),
                None => items.push(item),
            }
        }
        if taken.len() == before {
            break;
        }
    }
    taken
}

/// The sides of all contacts of a case that cannot be made as they are drawn, and why; plates that are in their way do not count.
pub(crate) fn refused_contacts(case: &Case) -> Vec<([String; 2], String)> {
    let mut case = case.clone();
    case.plates.clear();
    let Ok(bytes) = scene::read_mesh_file(&case) else { return Vec::new() };
    let coarse = scene::read_bare_mesh(&case, &bytes).map(|mesh| coarse_arcs(&case, &mesh)).unwrap_or_default();
    if !coarse.is_empty() {
        return coarse.into_iter().map(|(pair, why)| (pair.between.clone(), why)).collect();
    }
    let mesh = scene::read_mesh(&case, &bytes);
    let Some(scene) = mesh.ok().and_then(|mesh| scene::first(&case, mesh).ok()) else { return Vec::new() };
    let Ok(numbering) = discretisation::finest_numbering(&scene) else { return Vec::new() };
    let refused = discretisation::refused_contacts(&scene, &numbering);
    refused.into_iter().map(|(pair, why)| (pair.between.clone(), why)).collect()
}

/// Gives pairs the distances at which a case draws its contacts, curves taken as they are meant; where that cannot be told they keep
/// those of their edges.
pub(crate) fn measure(pairs: &mut [ClosePair], case: &Case) {
    let Ok(mesh) = scene::read_mesh_file(case).and_then(|bytes| scene::read_mesh(case, &bytes)) else { return };
    let partition = Partition::new(&mesh, &vec![0; mesh.triangles.len()], 1);
    let numbering = Numbering::new(Level { intervals: PARTS, order: Order::P1 }, &Rc::new(partition));
    for pair in pairs.iter_mut().take(MOST_MEASURED) {
        let contact = case.contacts.iter().find(|contact| contact.between.iter().all(|name| pair.between.contains(name)));
        if let Some(gap) = contact.and_then(|contact| drawn_gap(&mesh, &numbering, contact)) {
            pair.distance = if gap.touches() { 0.0 } else { gap.least };
        }
    }
}

/// Supports that are proposed.
#[derive(Default)]
pub(crate) struct ProposedSupports {
    /// The tables.
    pub tables: Vec<String>,
    /// Whether loads drive a motion that one of them holds, so that it carries what contact does not.
    pub are_driven: bool,
}

/// Supports that would hold what can move though contact is closed everywhere, one after the other; none if all is held, or
/// if that cannot be told.
pub(crate) fn proposed_supports(case: &Case) -> ProposedSupports {
    let known = case.supports.iter().map(|support| support.name.clone());
    let known = known.chain(case.means.iter().map(|mean| mean.name.clone()));
    let mut names = TableNames::of(known.chain(case.springs.iter().map(|springs| springs.name.clone())));
    let (mut proposed, mut are_driven) = (Vec::<Proposed>::new(), false);
    for _ in 0..MOST_SUPPORTS {
        let with = with_tables(case, proposed.iter().map(Proposed::table).collect());
        let next = with.and_then(|case| next_support(&case, &proposed, &mut names));
        are_driven |= next.as_ref().is_some_and(|(_, is_driven)| *is_driven);
        match next.map(|(support, _)| support) {
            Some(Proposed::Mean(mean)) => {
                let same = proposed.iter_mut().find_map(|other| match other {
                    Proposed::Mean(other) if other.body == mean.body => Some(&mut other.held),
                    _ => None,
                });
                match same {
                    Some(held) if mean.held.iter().all(|key| held.contains(key)) => break,
                    Some(held) => {
                        held.extend(mean.held);
                        held.sort_by_key(|line| (line.starts_with("angle"), line.clone()));
                        held.dedup();
                    }
                    None => proposed.push(Proposed::Mean(mean)),
                }
            }
            Some(point) => proposed.push(point),
            None => break,
        }
    }
    ProposedSupports { tables: proposed.iter().map(Proposed::table).collect(), are_driven }
}

/// A support of the mean motion of a body: lines that say which of its motions are held.
pub(crate) struct MeanProposal {
    pub name: String,
    pub body: String,
    pub held: Vec<String>,
}

impl MeanProposal {
    /// The table, with a comment behind the name of the body.
    pub fn table(&self, comment: &str) -> String {
        let keys: String = self.held.iter().map(|line| format!("{line}\n")).collect();
        format!("[support.{}]\nbody = {}{comment}\nmean = true\n{keys}", self.name, quoted(&self.body))
    }

    /// Lines that hold these of its two shifts and its turn.
    pub fn lines(moves: [bool; 3]) -> Vec<String> {
        (0..3).filter(|&k| moves[k]).map(|k| format!("{} = 0.0", MOTIONS[k])).collect()
    }
}

/// A support that is proposed.
enum Proposed {
    Mean(MeanProposal),
    /// Of a point: the table.
    Point(String),
}

impl Proposed {
    fn table(&self) -> String {
        match self {
            Self::Mean(mean) => mean.table("   # its mean motion: a hold that carries nothing where loads balance"),
            Self::Point(table) => table.clone(),
        }
    }

    /// It, if it is of the mean motion of this body.
    fn mean_of(&self, body: &str) -> Option<&MeanProposal> {
        match self {
            Self::Mean(mean) if mean.body == body => Some(mean),
            _ => None,
        }
    }
}

/// A support for the first motion that is free in a case, and whether loads drive that.
fn next_support(case: &Case, proposed: &[Proposed], names: &mut TableNames) -> Option<(Proposed, bool)> {
    let mesh = scene::read_mesh_file(case).and_then(|bytes| scene::read_mesh(case, &bytes)).ok()?;
    // As `check` looks at it: contacts that are found on the first refined mesh may not be found on that of the file.
    let scene = scene::first(case, mesh).ok()?;
    let loose = Procedure::look(&scene, 0).and_then(|at_rest| at_rest.free_motion(&scene)).ok()??;
    let motion = (&loose.mechanism, loose.slanted);
    support_for(case, &scene, motion, proposed, names).map(|support| (support, loose.is_driven))
}

/// A support that holds one free motion: of a whole body by its mean, where nothing else holds it, and else of a point, on a
/// boundary that is in no contact if there is one.
fn support_for(
    case: &Case,
    scene: &Scene,
    (motion, slanted): (&Mechanism, Option<[String; 2]>),
    own: &[Proposed],
    names: &mut TableNames,
) -> Option<Proposed> {
    let (mesh, extent) = (&scene.mesh, scene.extents()[motion.piece]);
    let body = mesh.pieces[motion.piece].body;
    let name = &mesh.bodies[body];
    let boundary_piece = |name: &String| {
        let edge = mesh.boundary(name).and_then(|boundary| boundary.edges.first());
        edge.map(|&edge| mesh.piece_beside(edge))
    };
    let holds = |on: &[String]| on.iter().any(|name| boundary_piece(name) == Some(motion.piece));
    // What a plate moves is held by the keys of the plate, which are named beside the motion.
    if case.plates.iter().any(|plate| holds(&plate.on)) {
        return None;
    }
    let ours = own.iter().find_map(|own| own.mean_of(name));
    let is_held = case.supports.iter().any(|support| holds(&support.on) || support.at.is_some())
        || case.springs.iter().any(|springs| holds(&springs.on))
        || case.means.iter().any(|mean| mean.body == *name && ours.is_none());
    let is_whole = mesh.pieces.iter().filter(|piece| piece.body == body).count() == 1;
    let (shift, turn) = motion.moves;
    let parts = [shift.x, shift.y, turn * extent.radius];
    let largest = parts.iter().fold(0.0f64, |largest, part| largest.max(part.abs()));
    let is_free = motion.motion == "move in every direction";
    if is_whole && !is_held {
        // One component for one motion: another one may be what loads drive.
        let most = parts.iter().position(|part| part.abs() == largest);
        let moves = [0, 1, 2].map(|k| is_free || most == Some(k));
        let is_first_shift = ours.is_none_or(|ours| ours.held.iter().all(|line| line.starts_with("angle")));
        let slanted = slanted.filter(|_| !is_free && is_first_shift);
        let held = slanted.map_or_else(|| MeanProposal::lines(moves), Vec::from);
        // A hold that is there already is completed.
        let fresh = if ours.is_some() { String::new() } else { names.fresh(&format!("{name}-still")) };
        return Some(Proposed::Mean(MeanProposal { name: fresh, body: name.clone(), held }));
    }
    let touched = |boundary: &str| case.contacts.iter().any(|pair| pair.between.iter().any(|side| side == boundary));
    let is_own = |edges: &[u32]| edges.iter().all(|&edge| mesh.piece_beside(edge) == motion.piece);
    let curves = mesh.physical_curves().into_iter().filter(|curve| !touched(&curve.name) && is_own(&curve.edges));
    let mut vertices: Vec<u32> =
        curves.flat_map(|curve| &curve.edges).flat_map(|&edge| mesh.edges[edge as usize].vertices).collect();
    if vertices.is_empty() {
        let own = mesh.triangles.iter().filter(|triangle| triangle.piece as usize == motion.piece);
        vertices = own.flat_map(|triangle| triangle.vertices).collect();
    }
    // The point that moves most, of those that no other piece of the body has, too.
    let size = |x: &Point| (1e6 * motion.displacement(&extent, *x).amax()).round();
    let mut places: Vec<Point> = vertices.into_iter().map(|vertex| mesh.vertices[vertex as usize]).collect();
    places.sort_by(|a, b| size(b).total_cmp(&size(a)));
    let is_of_one = |x: &Point| mesh.piece_at(&Spot { place: [x.x, x.y], body: Some(name.clone()) }, |_| true).is_ok();
    let place = places.into_iter().find(is_of_one)?;
    let component = ["ux", "uy"][motion.displacement(&extent, place).iamax()];
    let keys = if is_free { "ux = 0.0\nuy = 0.0\n".to_owned() } else { format!("{component} = 0.0\n") };
    let [x, y] = [place.x, place.y].map(|x| digits(x, extent.radius));
    let fresh = names.fresh(&format!("{name}-point"));
    Some(Proposed::Point(format!("[support.{fresh}]\nat = [{x:?}, {y:?}]\nbody = {}\n{keys}", quoted(name))))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_keys_and_files() {
        let mut names = TableNames::default();
        let fresh = ["seam", "Seam", "a b/c", "---", "über"].map(|wish| names.fresh(wish));
        assert_eq!(fresh, ["seam", "Seam-2", "a-b-c", "part", "-ber"]);
        assert_eq!([key("disc"), key("half disc"), key("a.b"), key("")], ["disc", "\"half disc\"", "\"a.b\"", "\"\""]);
        let common = |a: &str, b: &str| common_name(&[a.into(), b.into()]);
        assert_eq!([common("lower.seam", "upper.seam"), common("top", "rim"), common("a", "b.a")], ["seam", "top-rim", "a-b.a"]);
        assert_eq!(common("pin_2", "hole_2"), "pin_2-hole_2", "a number says nothing");
    }
}
