//! Tables that stand for several: supports and loads on each of some bodies, and contacts of all pairs of sides that match and lie close.

use super::expansion::{Expansion, Matched, strings, table_at};
use super::merging::StandsFor;
use super::mesh_names::{MeshNames, point};
use super::wildcard::is_pattern_of;
use crate::case::acting::rigid::{Tool, read_tool};
use crate::case::file::error::{Log, listed};
use crate::case::keys::{LONGEST_NAME, Section};
use crate::case::schema::CASE;
use crate::contact::{CloseSide, close_sides};
use crate::geometry::Quote;
use std::cell::RefCell;
use std::collections::HashSet;
use toml::{Table, Value};

/// Tables of a kind that stand for others, and what each of these has of its own.
#[derive(Default)]
struct SpreadTables {
    tables: Table,
    standing: Vec<StandsFor>,
}

impl SpreadTables {
    /// A table that stands for itself.
    fn keep(&mut self, name: &str, table: &Value) {
        if !self.tables.contains_key(name) {
            self.tables.insert(name.into(), table.clone());
        }
    }

    /// A table that stands for others: what these have of their own, and what the file says of one by its name.
    fn put(&mut self, name: &str, table: &Value, own: Vec<(String, Table)>, written: &Table) {
        let names = own.iter().map(|(name, _)| name.clone()).collect();
        for (name, mut table) in own {
            table.extend(written.get(&name).and_then(Value::as_table).cloned().unwrap_or_default());
            self.tables.insert(name, Value::Table(table));
        }
        self.tables.insert(name.into(), table.clone());
        self.standing.push(StandsFor { name: name.into(), names, is_pattern: false });
    }
}

impl Expansion<'_> {
    /// Takes the tables of a kind from those that were spread.
    fn take(&mut self, kind: &'static str, spread: SpreadTables) {
        self.table.insert(kind.into(), Value::Table(spread.tables));
        self.standing.insert(kind.into(), spread.standing);
    }

    /// Supports and loads with a pattern of bodies, and stiff plates on curves of several.
    pub(super) fn spread_loads(&mut self, mesh: &MeshNames) {
        for kind in ["support", "load"] {
            let Some(tables) = table_at(&self.table, &[kind]).cloned() else { continue };
            let mut spread = SpreadTables::default();
            for (name, table) in &tables {
                let own = self.on_bodies(kind, name, table, mesh);
                match own {
                    Some(own) => spread.put(name, table, own, &tables),
                    None => spread.keep(name, table),
                }
            }
            self.take(kind, spread);
        }
    }

    /// What a support or a load is on each of its bodies, by the name of each; nothing if it stands for itself.
    fn on_bodies(&mut self, kind: &'static str, name: &str, table: &Value, mesh: &MeshNames) -> Option<Vec<(String, Table)>> {
        // Letters of a body that would make its table a pattern give way.
        let mut taken = HashSet::new();
        let mut name_on = |body: &str| {
            let mut fresh = format!("{name}.{}", body.replace(['*', '?'], "-"));
            while !taken.insert(fresh.clone()) {
                fresh.push('-');
            }
            fresh
        };
        let known = &mesh.mesh.bodies;
        if let Some(pattern) = table.get("body").and_then(Value::as_str).filter(|text| is_pattern_of(known, text)) {
            let path = [kind, name, "body"];
            let mut bodies = self.matching(&path, pattern, known, "body");
            if let Some(at) = table.get("at").and_then(point) {
                let all = bodies.len();
                bodies = mesh.holding(&bodies, at);
                if bodies.is_empty() && all > 0 {
                    self.problem(&path, table.get("body"), "none of these bodies has the point of at; move it");
                }
            }
            let own = |body: String| (name_on(&body), Table::from_iter([("body".to_owned(), Value::String(body))]));
            return Some(bodies.into_iter().map(own).collect());
        }
        let on = table.get("on").filter(|on| strings(on).into_iter().any(|name| is_pattern_of(&mesh.boundaries, name)))?;
        if table.get("rigid").and_then(Value::as_bool) != Some(true) {
            return None;
        }
        let curves = self.names(&[kind, name, "on"], on, &mesh.boundaries, "physical curve");
        let own =
            |(body, curves): (&str, Vec<String>)| (name_on(body), Table::from_iter([("on".to_owned(), Value::from(curves))]));
        Some(mesh.of_each_body(curves).into_iter().map(own).collect())
    }
}

/// Physical curves, or a rigid surface, that are one side of a contact.
type SideNames = Vec<String>;

impl Expansion<'_> {
    /// Contacts with patterns become one for each pair that lies close, but for those that the file joins by their names.
    pub(super) fn spread_contacts(&mut self, mesh: &MeshNames) {
        let Some(tables) = table_at(&self.table, &["contact"]).cloned() else { return };
        let log = RefCell::new(Log::default());
        let tools = Section::root(&self.table, &CASE, &log).named("rigid", read_tool);
        let known: Vec<String> = mesh.boundaries.iter().cloned().chain(tools.iter().flat_map(surfaces_of)).collect();
        let is_pattern = |name: &str| is_pattern_of(&known, name);
        let has_patterns =
            |table: &Value| table.get("between").is_some_and(|between| strings(between).into_iter().any(is_pattern));
        let plain = || tables.iter().filter(|(_, table)| !has_patterns(table) && table.get("between").is_some());
        let mut taken: HashSet<String> = plain().map(|(name, _)| name.to_lowercase()).collect();
        let joined: HashSet<[SideNames; 2]> = plain().filter_map(|(_, table)| both_sides(table)).map(in_order).collect();
        let mut spread = SpreadTables::default();
        for (name, table) in &tables {
            let between = table.get("between").and_then(Value::as_array).map(Vec::as_slice);
            let Some([first, second]) = between.filter(|_| has_patterns(table)) else {
                spread.keep(name, table);
                continue;
            };
            let sides = [first, second].map(|side| self.sides(name, side, mesh, (&tools, &known)));
            let is_known = sides.iter().all(|all| !all.is_empty());
            let pairs = if is_known { close(&sides, mesh, &tools) } else { Vec::new() };
            if is_known && pairs.is_empty() {
                let there = |all: &[SideNames]| listed(all.iter().map(|side| format!("\"{}\"", Quote(&side.join(" + ")))));
                let words = format!(
                    "no two of these lie close and face each other: {}, and {}; name two of them, or correct the mesh",
                    there(&sides[0]),
                    there(&sides[1])
                );
                self.problem(&["contact", name, "between"], table.get("between"), words);
            }
            let pairs = pairs.into_iter().filter(|pair| !joined.contains(&in_order(pair.clone())));
            let own: Vec<(String, Table)> =
                pairs.map(|pair| (fresh_name(name, &pair, &mut taken), own_keys(table, [first, second], pair))).collect();
            if !own.is_empty() {
                let place = format!("contact.{name}.between = [{}]", told_sides([first, second]));
                let names = own.iter().map(|(name, _)| name.clone()).collect();
                self.matched.push(Matched { place, kind: "contact", names });
            }
            spread.put(name, table, own, &tables);
        }
        self.take("contact", spread);
    }

    /// The sides that one of a contact stands for: each curve that it matches; of a list those on each body together.
    fn sides(&mut self, contact: &str, side: &Value, mesh: &MeshNames, (tools, known): (&[Tool], &[String])) -> Vec<SideNames> {
        let path = ["contact", contact, "between"];
        let names = strings(side);
        if !names.iter().any(|name| is_pattern_of(known, name)) {
            let is_tool = |name: &str| tools.iter().any(|tool| tool.has(name));
            if let Some(wrong) = names.iter().find(|name| !is_tool(name) && !known.iter().any(|known| known == *name)) {
                let there = listed(known.iter().map(|name| format!("\"{}\"", Quote(name))));
                self.problem(&path, None, format!("there is no physical curve \"{}\"; there are {there}", Quote(wrong)));
                return Vec::new();
            }
            return vec![names.into_iter().map(String::from).collect()];
        }
        let before = self.matched.len();
        let sides = if side.is_array() {
            let all = self.names(&path, side, &mesh.boundaries, "physical curve");
            mesh.of_each_body(all).into_iter().map(|(_, curves)| curves).collect()
        } else {
            let all = self.matching(&path, names[0], known, "physical curve");
            all.into_iter().map(|name| vec![name]).collect()
        };
        self.matched.truncate(before);
        sides
    }
}

/// Pairs of these sides that lie close, each once, in their order.
fn close(sides: &[Vec<SideNames>; 2], mesh: &MeshNames, tools: &[Tool]) -> Vec<[SideNames; 2]> {
    let of: [HashSet<&SideNames>; 2] = sides.each_ref().map(|all| all.iter().collect());
    let (mut seen, mut names, mut places) = (HashSet::new(), Vec::new(), Vec::new());
    for side in sides.iter().flatten().filter(|side| seen.insert(*side)) {
        let boundaries = side.iter().filter_map(|name| mesh.mesh.boundary(name));
        let mut of_tools = tools.iter().flat_map(|tool| side.iter().map(|name| tool.parts_of(name)));
        let place = match of_tools.find(|parts| !parts.is_empty()) {
            Some(parts) => Some(CloseSide::of_tool(parts.iter())),
            None => CloseSide::of_boundaries(&mesh.mesh, boundaries),
        };
        let Some(place) = place else { continue };
        names.push(side);
        places.push(place);
    }
    let among: Vec<[bool; 2]> = names.iter().map(|name| of.each_ref().map(|of| of.contains(name))).collect();
    let is_in_order = |a: usize, b: usize| among[a][0] && among[b][1];
    let pairs = close_sides(&mesh.mesh, &places, |a, b| is_in_order(a, b) || is_in_order(b, a));
    let ordered = |[a, b]: [usize; 2]| {
        let (first, last) = (a.min(b), a.max(b));
        if is_in_order(first, last) { [first, last] } else { [last, first] }
    };
    let mut pairs: Vec<[usize; 2]> = pairs.into_iter().map(ordered).collect();
    pairs.sort_unstable();
    pairs.into_iter().map(|pair| pair.map(|k| names[k].clone())).collect()
}

/// The surfaces of a tool that may be sides: the whole if it is one curve, otherwise each of its lines.
fn surfaces_of(tool: &Tool) -> Vec<String> {
    match tool.surface.len() {
        1 => vec![tool.key().to_owned()],
        count => (1..=count).map(|k| format!("{}.{k}", tool.key())).collect(),
    }
}

/// What one of many contacts has of its own: its sides, and its curve where that is one of them.
fn own_keys(table: &Value, written: [&Value; 2], pair: [SideNames; 2]) -> Table {
    let told = |names: &SideNames| match &names[..] {
        [name] => Value::String(name.clone()),
        names => Value::Array(names.iter().cloned().map(Value::String).collect()),
    };
    let curve = table.get("curve").and_then(|curve| written.iter().position(|side| *side == curve));
    let mut own = Table::from_iter([("between".to_owned(), Value::Array(pair.iter().map(told).collect()))]);
    if let Some(side) = curve {
        own.insert("curve".into(), told(&pair[side]));
    }
    own
}

/// `NAME.ring.roller3`, of letters that may be in file names; with a number where that is taken.
fn fresh_name(name: &str, pair: &[SideNames; 2], taken: &mut HashSet<String>) -> String {
    let plain = |c: char| if c.is_alphanumeric() || "-_.".contains(c) { c } else { '-' };
    let both = pair.iter().map(|side| side.join("-").chars().map(plain).collect::<String>());
    let whole: String = std::iter::once(name.to_owned()).chain(both).collect::<Vec<_>>().join(".");
    let cut = |end: &str| {
        let room = LONGEST_NAME.saturating_sub(end.len());
        let kept = whole.char_indices().map(|(at, c)| at + c.len_utf8()).take_while(|end| *end <= room).last().unwrap_or(0);
        format!("{}{end}", &whole[..kept])
    };
    let wishes = std::iter::once(cut("")).chain((2..).map(|number| cut(&format!("-{number}"))));
    wishes.into_iter().find(|wish| taken.insert(wish.to_lowercase())).unwrap_or(whole.clone())
}

/// The curves of both sides of a contact without patterns.
fn both_sides(table: &Value) -> Option<[SideNames; 2]> {
    let sides = table.get("between")?.as_array()?.iter().map(|side| strings(side).into_iter().map(String::from).collect());
    sides.collect::<Vec<SideNames>>().try_into().ok()
}

fn in_order(mut pair: [SideNames; 2]) -> [SideNames; 2] {
    pair.sort_unstable();
    pair
}

fn told_sides(sides: [&Value; 2]) -> String {
    let told = |side: &Value| match side {
        Value::String(name) => format!("\"{}\"", Quote(name)),
        other => other.to_string(),
    };
    sides.map(told).join(", ")
}
