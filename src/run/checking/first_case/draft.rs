//! The text of a first case.

use super::guesses::{AWAY, Guesses, POISSON, Press, Weight, YOUNG};
use super::named_curve::{ALONG, NamedCurve, PULLED};
use crate::contact::ClosePair;
use crate::output::summary::MOST_TOLD;
use crate::run::checking::node_circle::NodeCircle;
use crate::run::checking::proposals::{MeanProposal, ProposedSupports, TableNames, contact_table, digits, key, quoted, short};
use std::path::Path;

/// Boundaries that are named in comments at most.
const MOST_NAMED: usize = 60;

/// Unknowns that the example may have, and times those of the first mesh at least, so that there is room to adapt it.
const MOST_UNKNOWNS: usize = 200_000;
const ROOM: usize = 4;

/// What is said of a mesh that may be half a section.
const ROUND: &str = "# plane = \"axisymmetric\"   # the mesh has a side on x = 0: write this if the bodies are turned about that line; forces are whole ones then\n";

/// What the case will say.
pub struct Draft<'a> {
    pub guesses: Guesses<'a>,
    /// Surfaces of each body, and its name.
    pub groups: &'a [Vec<String>],
    pub names: &'a [String],
}

impl Draft<'_> {
    pub fn text(&self, named: &str, press: Press) -> String {
        let weights = if press == Press::Nothing { Vec::new() } else { self.guesses.weights() };
        let is_loaded = weights.is_empty() || self.guesses.pressed().is_some();
        let load = if is_loaded { self.load(press) } else { String::new() };
        let drawn = [self.head(named), self.bodies(&weights), self.circles(), self.contacts(), self.tools()];
        drawn.concat() + &[self.supports(), load, self.wanted_names(), self.rest()].concat()
    }

    /// What keeps the case from being one, a sentence each.
    pub fn remarks(&self) -> Vec<String> {
        let bodies = &self.guesses.mesh.bodies;
        if self.guesses.curves.is_empty() {
            let words = "no curve of the mesh bounds a body and has a name; contact, supports and loads stand on named curves";
            return vec![format!("{words}: the case says which are wanted")];
        }
        let close = |&[a, b]: &[usize; 2]| {
            format!(
                "bodies \"{}\" and \"{}\" lie close, but no named curves of theirs do: name the curve of each where they may touch",
                bodies[a], bodies[b]
            )
        };
        let names =
            |(ClosePair { between: [first, second], .. }, _): &(ClosePair, String)| format!("\"{first}\" and \"{second}\"");
        let left_out = |all: &[(ClosePair, String)]| match all {
            [one] => format!("the contact of {} is left out: {}", names(one), one.1),
            all => {
                let all: Vec<String> = all.iter().map(names).collect();
                format!("{} contacts are left out, each with its reason in the case: {}", all.len(), all.join("; "))
            }
        };
        let Guesses { unnamed, refused, aside, .. } = &self.guesses;
        let each = if refused.len() > MOST_TOLD { refused.len() } else { 1 };
        unnamed
            .iter()
            .map(close)
            .chain(refused.chunks(each).map(left_out))
            .chain(aside.iter().cloned())
            .chain(self.no_load())
            .collect()
    }

    /// Words for a load that is left out with the contact that would carry it.
    fn no_load(&self) -> Option<String> {
        let body = (0..self.names.len()).find(|&body| self.guesses.is_cut_off(body))?;
        Some(format!("the contact that would carry a load of {} is left out", quoted(&self.guesses.mesh.bodies[body])))
    }

    fn head(&self, named: &str) -> String {
        let title = Path::new(named).file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let round = if self.guesses.may_be_round() { ROUND } else { "" };
        let accuracy = match self.guesses.pairs.is_empty() && self.guesses.tools.is_empty() {
            true => "energy = 0.02            # the mesh is adapted until the energy norm is good to 2 %",
            false => "pressure = 0.01          # the mesh is adapted until the contact pressure is good to 1 %",
        };
        // The first mesh cuts each triangle into sixteen, which have some four unknowns each with P2.
        let most = MOST_UNKNOWNS.max(ROOM * 4 * 16 * self.guesses.mesh.triangles.len());
        let (title, file) = (quoted(&title), quoted(named));
        format!(include_str!("head.txt"), title = title, round = round, file = file, accuracy = accuracy, most = most)
    }

    fn bodies(&self, weights: &[Weight]) -> String {
        let mut text = String::new();
        for (group, name) in self.groups.iter().zip(self.names) {
            let weight = weights.iter().find(|weight| self.guesses.mesh.bodies[weight.body] == *name);
            let force = weight.map_or(String::new(), |weight| {
                let (down, words) = self.guesses.down;
                let [x, y] = (weight.force * down).map(|part| if part == 0.0 { 0.0 } else { part }).into();
                format!("body_force = [{x:?}, {y:?}]    # example: presses the body {words}, force for each volume\n")
            });
            let material = format!(
                "young = {YOUNG:?}         # example: steel, in MPa\npoisson = {POISSON:?}            # example\n{force}"
            );
            match &group[..] {
                [only] => text += &format!("\n[body.{}]\n{material}", key(only)),
                parts => {
                    let part = |part: &String| format!("[body.{}.part.{}]\n{material}", key(name), key(part));
                    text += "\n# These surfaces share nodes: they are parts of one body, bonded to each other.\n";
                    text.extend(parts.iter().map(part));
                }
            }
        }
        text
    }

    /// The true shape of boundaries in contact that are drawn as polygons, where their nodes tell it.
    fn circles(&self) -> String {
        let mut tables = TableNames::default();
        let circle = |curve: &NamedCurve| {
            let NodeCircle { centre, radius } = curve.circle?;
            let [x, y, radius] = [centre.x, centre.y, radius].map(|part| digits(part, radius));
            let (name, own) = (tables.fresh(curve.name), quoted(curve.name));
            let why = "its nodes lie on this circle; leave this out if it is meant with straight sides";
            let circle = format!("circle = {{ centre = [{x:?}, {y:?}], radius = {radius:?} }}");
            Some(format!("\n[geometry.{name}]       # {why}\ncurves = {own}\n{circle}\n"))
        };
        self.guesses.curves.iter().filter(|curve| curve.is_touched).filter_map(circle).collect()
    }

    fn contacts(&self) -> String {
        let (mut text, mut tables) = (String::new(), TableNames::default());
        let has_any = !self.guesses.pairs.is_empty() || !self.guesses.tools.is_empty();
        if self.guesses.mesh.bodies.len() > 1 && !has_any && self.guesses.refused.is_empty() {
            text += "\n# No named boundaries of two bodies lie close and face each other. What may touch is written so:\n";
            text += "# [contact.NAME]\n# between = [\"boundary of body 1\", \"boundary of body 2\"]\n";
        }
        for pair in &self.guesses.pairs {
            text += &format!("\n{}", contact_table(pair, &mut tables));
        }
        for (pair, why) in &self.guesses.refused {
            let table = commented(&contact_table(pair, &mut tables));
            text += &format!("\n# Left out, since `mezha check` refuses it:\n#   {why}\n{table}");
        }
        text
    }

    /// The rigid tools that are drawn in the mesh. What may press on a body that is alone without them: one above the boundary that is
    /// pressed, as a comment.
    fn tools(&self) -> String {
        let aside: String = self.guesses.aside.iter().map(|words| format!("\n# Left out: {words}\n")).collect();
        if !self.guesses.tools.is_empty() {
            let tables: Vec<&str> = self.guesses.tools.iter().map(|tool| tool.text.as_str()).collect();
            return aside + "\n# Curves of the mesh that bound no body are taken for rigid tools.\n" + &tables.join("\n");
        }
        let is_below = |curve: &&NamedCurve| curve.normal.y > 0.0 && curve.high.x > curve.low.x && !curve.has(PULLED);
        let pressed = self.guesses.pressed().filter(is_below).filter(|_| self.guesses.mesh.bodies.len() == 1);
        let Some(curve) = pressed else { return aside };
        let [left, right, high] = [curve.low.x, curve.high.x, curve.high.y].map(|x| digits(x, curve.length));
        let (way, name) = (-self.guesses.tool_way(), quoted(curve.name));
        aside + &format!(include_str!("tool.txt"), left = left, right = right, high = high, way = way, name = name)
    }

    fn supports(&self) -> String {
        let mut tables = TableNames::default();
        let mirrored = self.guesses.curves.iter().filter(|curve| curve.is_mirrored() && !curve.is_touched);
        let mirrored = mirrored.map(|curve| (curve, "a line of symmetry, by its name", "normal = 0.0\n"));
        let held = self.guesses.held().into_iter().map(|curve| match curve.is_held() {
            true => (curve, "held: by its name", "ux = 0.0\nuy = 0.0\n"),
            false => (curve, "held: the lowest boundary that looks down", "ux = 0.0\nuy = 0.0\n"),
        });
        let support = |(curve, why, keys): (&NamedCurve, &str, &str)| {
            let (name, own) = (tables.fresh(curve.name), quoted(curve.name));
            format!("\n[support.{name}]       # {why}\non = {own}\n{keys}")
        };
        let text: String = mirrored.chain(held).map(support).collect();
        let Some((body, moves)) = self.guesses.foundation() else { return text };
        let words = "\n# No named boundary looks like one that is held, so the mean motion of the lowest body is. That carries the load all over\n# the body; where it stands on something, name that line in the mesh, hold it, and leave this out.\n";
        let body = self.guesses.mesh.bodies[body].clone();
        text + words
            + &MeanProposal { name: tables.fresh(&format!("{body}-still")), body, held: MeanProposal::lines(moves) }.table("")
    }

    fn load(&self, press: Press) -> String {
        let is_pressed_in = self.guesses.is_pressed_in() || !self.guesses.tools.is_empty();
        let Some(curve) = self.guesses.pressed().filter(|_| press != Press::Nothing && !is_pressed_in) else {
            return self.further_load();
        };
        let direction = self.guesses.push(curve);
        let guided = if direction.x == 0.0 { "ux" } else { "uy" };
        let sense = self.guesses.sense(curve, direction);
        let what = if sense < 0.0 { "pulled" } else { "pressed" };
        let why = match curve {
            _ if sense < 0.0 && !curve.has(PULLED) => "a push would open every contact of its body",
            _ if curve.is_loaded() => "by its name",
            _ if curve.is_held() => "its name says that it is held, but then nothing would act",
            _ => "the highest boundary that looks up",
        };
        let (table, on) = (TableNames::default().fresh(curve.name), quoted(curve.name));
        let head = format!("\n[load.{table}]          # {what}: {why}\non = {on}\n");
        // A plate on a body of revolution moves along the axis alone, a guided one along an axis, and a pressure along the normal.
        let is_across = direction.dot(&curve.normal).abs() < AWAY && !curve.has(PULLED);
        let is_oblique = curve.normal.norm() > ALONG && curve.normal.amax() < ALONG;
        if !is_across && (press == Press::Pressure || is_oblique || direction.x != 0.0 && self.guesses.may_be_round()) {
            let pressure = sense * self.guesses.pressure(curve);
            return head + &format!("pressure = {pressure:?}       # example: pushes onto the body if it is positive\n");
        }
        let [x, y] = (sense * self.guesses.force(curve) * direction).map(|part| if part == 0.0 { 0.0 } else { part }).into();
        head + &format!(include_str!("plate.txt"), x = x, y = y, guided = guided)
    }

    /// How a load is written, as a comment, and why there is none.
    fn further_load(&self) -> String {
        let pressed = self.guesses.pressed().map(|curve| quoted(curve.name));
        let why = match &pressed {
            _ if !self.guesses.tools.is_empty() => "The rigid tools press. A further load is written so:".into(),
            _ if self.guesses.is_pressed_in() => {
                "Bodies are drawn into each other: that interference is the load. A further one is written so:".into()
            }
            Some(on) => format!(
                "Nothing presses yet: `mezha check` refuses a load on {on}, as the bodies are held here. A load is written so:"
            ),
            None => {
                let why = self.no_load().map_or(String::new(), |why| format!(": {why}"));
                format!("Nothing presses yet{why}. A load is written so:")
            }
        };
        let table = format!("# [load.NAME]\n# on = {}\n# pressure = 1.0\n", pressed.unwrap_or(quoted("boundary")));
        format!("\n# {why}\n{table}# or, all over a body, as a line of its table:\n# body_force = [0.0, -1.0]\n")
    }

    /// Names that the mesh wants, as lines of the .geo file.
    fn wanted_names(&self) -> String {
        let Guesses { mesh, curves, unnamed, .. } = &self.guesses;
        if !curves.is_empty() && unnamed.is_empty() {
            return String::new();
        }
        let head = "\n# Contact, supports and loads stand on named curves, and the mesh has too few. Write such lines into the .geo file, with\n# the numbers of its curves, mesh it again, and make this case anew:\n";
        let line = |(name, words): (String, String)| format!("#   Physical Curve({}) = {{...}};   // {words}\n", quoted(&name));
        let close = unnamed.iter().flat_map(|&[a, b]| [(a, b), (b, a)]).map(|(own, other)| {
            let [own, other] = [own, other].map(|body| &mesh.bodies[body]);
            (format!("{own}.{other}"), format!("where \"{own}\" may touch \"{other}\", which lies close"))
        });
        let usual = [("bottom", "what is held"), ("top", "what is pressed, on another body")];
        let usual = usual.map(|(name, words)| (name.into(), words.into())).into_iter().filter(|_| curves.is_empty());
        head.to_owned() + &close.chain(usual).map(line).collect::<String>()
    }

    /// The supports that are proposed for what nothing else holds; those of bodies whose contacts are left out are comments. Returns
    /// words for such bodies.
    pub fn proposed_supports(
        &self,
        text: &mut String,
        ProposedSupports { tables, are_driven }: &ProposedSupports,
    ) -> Option<String> {
        let cut_off = (0..self.names.len()).filter(|&body| self.guesses.is_cut_off(body));
        let cut_off: Vec<String> = cut_off.map(|body| quoted(&self.guesses.mesh.bodies[body])).collect();
        let body_of = |table: &str| cut_off.iter().find(|body| table.contains(&format!("body = {body}")));
        let (unheld, others): (Vec<&String>, Vec<&String>) = tables.iter().partition(|table| body_of(table).is_some());
        if !others.is_empty() {
            let what = if *are_driven { "so that these carry what drives them" } else { "which the example does not drive" };
            *text += &format!("\n# Neither supports nor contact hold these motions, {what}; put what you mean in their place.\n");
            *text += &others.iter().map(|table| table.as_str()).collect::<Vec<_>>().join("\n");
        }
        for table in &unheld {
            let (body, table) = (body_of(table)?, commented(table));
            *text += &format!("\n# Body {body} has neither contact nor support. This would hold it:\n{table}");
        }
        let body = body_of(unheld.first()?)?;
        let remedy = "mend the contact that is left out, or hold the body: the last lines tell how";
        Some(format!("body {body} has neither contact nor support; {remedy}"))
    }

    /// All named boundaries, for whoever goes on writing.
    fn rest(&self) -> String {
        let curves = &self.guesses.curves;
        if curves.is_empty() {
            return String::new();
        }
        let line = |curve: &NamedCurve| {
            let (name, body) = (quoted(curve.name), quoted(&self.guesses.mesh.bodies[curve.body]));
            let sizes = [curve.length, curve.low.x, curve.high.x, curve.low.y, curve.high.y];
            let [length, left, right, low, high] = sizes.map(|size| short(digits(size, curve.length)));
            format!("#   {name}: of {body}, length {length}, x from {left} to {right}, y from {low} to {high}\n")
        };
        let lines: String = curves.iter().take(MOST_NAMED).map(line).collect();
        let more = curves.len().saturating_sub(MOST_NAMED);
        let more = if more > 0 { format!("#   and {more} more\n") } else { String::new() };
        format!("\n# Boundaries of the mesh, for on = and between =:\n{lines}{more}")
    }
}

/// Lines as comments.
fn commented(lines: &str) -> String {
    lines.lines().map(|line| format!("# {line}\n")).collect()
}
