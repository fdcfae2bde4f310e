//! The text of a first case.

use super::guesses::{Guesses, POISSON, Press, Weight, YOUNG};
use super::named_curve::{LOADED, NamedCurve, PULLED};
use crate::contact::ClosePair;
use crate::run::checking::node_circle::NodeCircle;
use crate::run::checking::proposals::{MeanProposal, TableNames, contact_table, digits, key, quoted, short};
use std::fmt::Write;
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
        let mut text = String::new();
        let mut tables = TableNames::default();
        self.head(&mut text, named);
        let weights = if press == Press::Nothing { Vec::new() } else { self.guesses.weights() };
        self.bodies(&mut text, &weights);
        self.circles(&mut text);
        self.contacts(&mut text);
        self.tools(&mut text);
        self.supports(&mut text, &mut tables);
        if weights.is_empty() || self.guesses.pressed().is_some() {
            self.load(&mut text, press);
        }
        self.wanted_names(&mut text);
        self.rest(&mut text);
        text
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
        let left_out = |(pair, why): &(ClosePair, String)| {
            let [first, second] = &pair.between;
            format!("the contact of \"{first}\" and \"{second}\" is left out: {why}")
        };
        let Guesses { unnamed, refused, aside, .. } = &self.guesses;
        unnamed.iter().map(close).chain(refused.iter().map(left_out)).chain(aside.iter().cloned()).chain(self.no_load()).collect()
    }

    /// Words for a load that is left out with the contact that would carry it.
    fn no_load(&self) -> Option<String> {
        let body = (0..self.names.len()).find(|&body| self.guesses.is_cut_off(body))?;
        Some(format!("the contact that would carry a load of {} is left out", quoted(&self.guesses.mesh.bodies[body])))
    }

    fn head(&self, text: &mut String, named: &str) {
        let title = Path::new(named).file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let _ = write!(
            text,
            "#:schema case.schema.json

# A first case, made from the mesh by `mezha new`. Numbers marked as examples are examples: put yours in their place.
# `mezha check` draws the case and says what would be solved, `mezha run` solves it.
# `mezha schema > case.schema.json` beside this file lets editors that read the first line (Taplo) complete and explain keys.
# Units are your own, consistent ones: with mm and N, stresses are in MPa, and forces in N for each mm of thickness.
title = {}
units = {{ length = \"mm\", force = \"N\" }}   # names alone: they change no number
{}
[mesh]
file = {}          # found from the folder of this file
order = 2
",
            quoted(&title),
            if self.guesses.may_be_round() { ROUND } else { "" },
            quoted(named),
        );
        let accuracy = match self.guesses.pairs.is_empty() && self.guesses.tools.is_empty() {
            true => "energy = 0.02            # the mesh is adapted until the energy norm is good to 2 %",
            false => "pressure = 0.01          # the mesh is adapted until the contact pressure is good to 1 %",
        };
        // The first mesh cuts each triangle into sixteen, which have some four unknowns each with P2.
        let most = MOST_UNKNOWNS.max(ROOM * 4 * 16 * self.guesses.mesh.triangles.len());
        let _ = write!(text, "\n[accuracy]\n{accuracy}\nmax_unknowns = {most}\n");
    }

    fn bodies(&self, text: &mut String, weights: &[Weight]) {
        for (group, name) in self.groups.iter().zip(self.names) {
            let mut material =
                format!("young = {YOUNG:?}         # example: steel, in MPa\npoisson = {POISSON:?}            # example\n");
            if let Some(weight) = weights.iter().find(|weight| self.guesses.mesh.bodies[weight.body] == *name) {
                let words = "# example: presses the body down, force for each volume";
                let _ = writeln!(material, "body_force = [0.0, {:?}]    {words}", -weight.force);
            }
            match &group[..] {
                [only] => {
                    let _ = write!(text, "\n[body.{}]\n{material}", key(only));
                }
                parts => {
                    let _ = write!(text, "\n# These surfaces share nodes: they are parts of one body, bonded to each other.\n");
                    for part in parts {
                        let _ = write!(text, "[body.{}.part.{}]\n{material}", key(name), key(part));
                    }
                }
            }
        }
    }

    /// The true shape of boundaries in contact that are drawn as polygons, where their nodes tell it.
    fn circles(&self, text: &mut String) {
        let mut tables = TableNames::default();
        for curve in self.guesses.curves.iter().filter(|curve| curve.is_touched) {
            let Some(NodeCircle { centre, radius, .. }) = curve.circle else { continue };
            let [x, y, radius] = [centre.x, centre.y, radius].map(|part| digits(part, radius));
            let (name, own) = (tables.fresh(curve.name), quoted(curve.name));
            let why = "its nodes lie on this circle; leave this out if it is meant with straight sides";
            let _ = write!(text, "\n[geometry.{name}]       # {why}\ncurves = {own}\n");
            let _ = writeln!(text, "circle = {{ centre = [{x:?}, {y:?}], radius = {radius:?} }}");
        }
    }

    fn contacts(&self, text: &mut String) {
        let mut tables = TableNames::default();
        let has_any = !self.guesses.pairs.is_empty() || !self.guesses.tools.is_empty();
        if self.guesses.mesh.bodies.len() > 1 && !has_any && self.guesses.refused.is_empty() {
            *text += "\n# No named boundaries of two bodies lie close and face each other. What may touch is written so:\n";
            *text += "# [contact.NAME]\n# between = [\"boundary of body 1\", \"boundary of body 2\"]\n";
        }
        for pair in &self.guesses.pairs {
            let _ = write!(text, "\n{}", contact_table(pair, &mut tables));
        }
        for (pair, why) in &self.guesses.refused {
            let _ = write!(text, "\n# Left out, since `mezha check` refuses it:\n#   {why}\n");
            contact_table(pair, &mut tables).lines().for_each(|line| *text += &format!("# {line}\n"));
        }
    }

    /// The rigid tools that are drawn in the mesh. What may press on a body that is alone without them: one above the boundary that is
    /// pressed, as a comment.
    fn tools(&self, text: &mut String) {
        for words in &self.guesses.aside {
            let _ = write!(text, "\n# Left out: {words}\n");
        }
        if !self.guesses.tools.is_empty() {
            *text += "\n# Curves of the mesh that bound no body are taken for rigid tools.\n";
            let tables: Vec<&str> = self.guesses.tools.iter().map(|tool| tool.text.as_str()).collect();
            *text += &tables.join("\n");
            return;
        }
        let is_below = |curve: &&NamedCurve| curve.normal.y > 0.0 && curve.high.x > curve.low.x && !curve.has(PULLED);
        let pressed = self.guesses.pressed().filter(is_below).filter(|_| self.guesses.mesh.bodies.len() == 1);
        let Some(curve) = pressed else { return };
        let [left, right, high] = [curve.low.x, curve.high.x, curve.high.y].map(|x| digits(x, curve.length));
        let _ = write!(
            text,
            "
# A rigid tool, which needs no mesh, may press on the body instead of a load:
# [rigid.tool]
# line = [[{left:?}, {high:?}], [{right:?}, {high:?}]]   # or circle = {{ centre = [x, y], radius = r }}
# ux = 0.0
# uy = {:?}                # example: how far it is moved; or force = [0.0, -1.0]
# angle = 0.0
# [contact.tool]
# between = [{}, \"rigid.tool\"]
",
            -self.guesses.tool_way(),
            quoted(curve.name)
        );
    }

    fn supports(&self, text: &mut String, tables: &mut TableNames) {
        for curve in self.guesses.curves.iter().filter(|curve| curve.is_mirrored() && !curve.is_touched) {
            let (name, own) = (tables.fresh(curve.name), quoted(curve.name));
            let _ = write!(text, "\n[support.{name}]       # a line of symmetry, by its name\non = {own}\nnormal = 0.0\n");
        }
        for curve in self.guesses.held() {
            let why = if curve.is_held() { "by its name" } else { "the lowest boundary that looks down" };
            let (name, own) = (tables.fresh(curve.name), quoted(curve.name));
            let _ = write!(text, "\n[support.{name}]       # held: {why}\non = {own}\nux = 0.0\nuy = 0.0\n");
        }
        if let Some((body, motions)) = self.guesses.foundation() {
            *text += "\n# No named boundary looks like one that is held, so the mean motion of the lowest body is. That carries the load all over\n# the body; where it stands on something, name that line in the mesh, hold it, and leave this out.\n";
            let body = &self.guesses.mesh.bodies[body];
            let hold = MeanProposal { name: tables.fresh(&format!("{body}-still")), body: body.clone(), moves: motions };
            *text += &hold.table("");
        }
    }

    fn load(&self, text: &mut String, press: Press) {
        let (is_pressed_in, pressed) = (self.guesses.is_pressed_in(), self.guesses.pressed());
        let has_tools = !self.guesses.tools.is_empty();
        let Some(curve) = pressed.filter(|_| press != Press::Nothing && !is_pressed_in && !has_tools) else {
            let on = pressed.map_or("boundary", |curve| curve.name);
            *text += &match (is_pressed_in, pressed) {
                _ if has_tools => "\n# The rigid tools press. A further load is written so:\n".into(),
                (true, _) => {
                    "\n# Bodies are drawn into each other: that interference is the load. A further one is written so:\n".into()
                }
                (_, Some(curve)) => format!(
                    "\n# Nothing presses yet: `mezha check` refuses a load on {}, as the bodies are held here. A load is written so:\n",
                    quoted(curve.name)
                ),
                (_, None) => {
                    let why = self.no_load().map_or(String::new(), |why| format!(": {why}"));
                    format!("\n# Nothing presses yet{why}. A load is written so:\n")
                }
            };
            let table = format!("# [load.NAME]\n# on = {}\n# pressure = 1.0\n", quoted(on));
            *text += &(table + "# or, all over a body, as a line of its table:\n# body_force = [0.0, -1.0]\n");
            return;
        };
        let direction = self.guesses.push(curve);
        let guided = if direction.x == 0.0 { "ux" } else { "uy" };
        let sense = self.guesses.sense(curve, direction);
        let what = if sense < 0.0 { "pulled" } else { "pressed" };
        let why = match curve {
            _ if sense < 0.0 && !curve.has(PULLED) => "a push would open every contact of its body",
            _ if curve.has(LOADED) => "by its name",
            _ if curve.is_held() => "its name says that it is held, but then nothing would act",
            _ => "the highest boundary that looks up",
        };
        let mut tables = TableNames::default();
        let _ = write!(text, "\n[load.{}]          # {what}: {why}\non = {}\n", tables.fresh(curve.name), quoted(curve.name));
        // A plate on a body of revolution moves along the axis alone.
        if press == Press::Pressure || direction.x != 0.0 && self.guesses.may_be_round() {
            let pressure = sense * self.guesses.pressure(curve);
            let _ = writeln!(text, "pressure = {pressure:?}       # example: pushes onto the body if it is positive");
            return;
        }
        let [x, y] = (sense * self.guesses.force(curve) * direction).map(|part| if part == 0.0 { 0.0 } else { part }).into();
        let _ = write!(
            text,
            "rigid = true              # a stiff plate that is bonded to it carries the force; or leave these lines, and give pressure = ...
force = [{x:?}, {y:?}]     # example: force for each length of thickness
{guided} = 0.0                  # the plate is guided,
angle = 0.0               # and does not turn
"
        );
    }

    /// Names that the mesh wants, as lines of the .geo file.
    fn wanted_names(&self, text: &mut String) {
        let Guesses { mesh, curves, unnamed, .. } = &self.guesses;
        if !curves.is_empty() && unnamed.is_empty() {
            return;
        }
        *text += "\n# Contact, supports and loads stand on named curves, and the mesh has too few. Write such lines into the .geo file, with\n# the numbers of its curves, mesh it again, and make this case anew:\n";
        let mut line = |name: &str, words: &str| {
            let _ = writeln!(text, "#   Physical Curve({}) = {{...}};   // {words}", quoted(name));
        };
        for &[a, b] in unnamed {
            for (own, other) in [(a, b), (b, a)] {
                let [own, other] = [own, other].map(|body| &mesh.bodies[body]);
                line(&format!("{own}.{other}"), &format!("where \"{own}\" may touch \"{other}\", which lies close"));
            }
        }
        if curves.is_empty() {
            line("bottom", "what is held");
            line("top", "what is pressed, on another body");
        }
    }

    /// The supports that are proposed for what nothing else holds; those of bodies whose contacts are left out are comments. Returns
    /// words for such bodies.
    pub fn proposed_supports(&self, text: &mut String, supports: &[String]) -> Option<String> {
        let cut_off = (0..self.names.len()).filter(|&body| self.guesses.is_cut_off(body));
        let cut_off: Vec<String> = cut_off.map(|body| quoted(&self.guesses.mesh.bodies[body])).collect();
        let body_of = |table: &str| cut_off.iter().find(|body| table.contains(&format!("body = {body}")));
        let (unheld, others): (Vec<&String>, Vec<&String>) = supports.iter().partition(|table| body_of(table).is_some());
        if !others.is_empty() {
            *text += "\n# Neither supports nor contact hold these motions, and the load of the example does not drive them; put what you mean in their place.\n";
            *text += &others.iter().map(|table| table.as_str()).collect::<Vec<_>>().join("\n");
        }
        for table in &unheld {
            let body = body_of(table)?;
            let _ = write!(text, "\n# Body {body} has neither contact nor support. This would hold it:\n");
            table.lines().for_each(|line| *text += &format!("# {line}\n"));
        }
        let body = body_of(unheld.first()?)?;
        let remedy = "mend the contact that is left out, or hold the body: the last lines tell how";
        Some(format!("body {body} has neither contact nor support; {remedy}"))
    }

    /// All named boundaries, for whoever goes on writing.
    fn rest(&self, text: &mut String) {
        let curves = &self.guesses.curves;
        if curves.is_empty() {
            return;
        }
        *text += "\n# Boundaries of the mesh, for on = and between =:\n";
        for curve in curves.iter().take(MOST_NAMED) {
            let (name, body) = (quoted(curve.name), quoted(&self.guesses.mesh.bodies[curve.body]));
            let sizes = [curve.length, curve.low.x, curve.high.x, curve.low.y, curve.high.y];
            let [length, left, right, low, high] = sizes.map(|size| short(digits(size, curve.length)));
            let _ = writeln!(text, "#   {name}: of {body}, length {length}, x from {left} to {right}, y from {low} to {high}");
        }
        if curves.len() > MOST_NAMED {
            let _ = writeln!(text, "#   and {} more", curves.len() - MOST_NAMED);
        }
    }
}
