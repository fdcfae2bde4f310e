//! What mesh and case file say of an assembly, and what statics asks of it.

use super::pile::{Assembly, Member, Shape, Side, Touch};
use super::round::{Round, cross, minus};
use super::statics::Statics;
use crate::support::mesh::{Block, Mesh, grid};
use std::f64::consts::TAU;

const POISSON: f64 = 0.3;

impl Assembly {
    /// The motions that nothing but contact holds: the member, and x, y or turn.
    pub fn motions(&self) -> Vec<(usize, usize)> {
        let of = |(k, member): (usize, &Member)| {
            let free = [!member.guided, true, !member.upright];
            (0..3).filter(move |c| free[*c]).map(move |c| (k, c))
        };
        self.members.iter().enumerate().flat_map(of).collect()
    }

    /// Equilibrium, in units of the loads.
    pub fn statics(&self) -> Statics {
        let motions = self.motions();
        let column = |touch: &Touch| {
            let push = |(k, c): &(usize, usize)| {
                let sign = match touch.pair.iter().position(|side| *side == Side::Member(*k)) {
                    Some(0) => -1.0,
                    Some(_) => 1.0,
                    None => 0.0,
                };
                let turn = cross(minus(touch.at, self.members[*k].middle()), touch.normal);
                // A disc's is rounding alone.
                sign * [touch.normal[0], touch.normal[1], if turn.abs() < 1e-9 { 0.0 } else { turn }][*c]
            };
            motions.iter().map(push).collect()
        };
        let wanted = motions.iter().map(|(k, c)| if *c < 2 { -self.members[*k].load[*c] } else { 0.0 });
        Statics { columns: self.touches.iter().map(column).collect(), wanted: wanted.collect() }
    }

    /// The name of a side in `between`.
    fn side(&self, side: Side) -> String {
        match side {
            Side::Member(k) if self.members[k].rigid => format!("rigid.b{k}"),
            Side::Member(k) => format!("b{k}.rim"),
            Side::Wall(k) if !self.walls[k].rigid => format!("w{k}.face"),
            Side::Wall(_) if self.walls.len() == 1 => "rigid.walls".into(),
            Side::Wall(k) => format!("rigid.walls.{}", k + 1),
        }
    }

    /// The mesh file, with edges of some third of a body's size.
    pub fn mesh(&self) -> String {
        let walls = (0..self.walls.len())
            .filter(|k| !self.walls[*k].rigid)
            .map(|k| (format!("w{k}"), self.wall_block(k), "face", "back"));
        let elastic = (0..self.members.len()).filter(|k| !self.members[*k].rigid);
        let members = elastic.map(|k| (format!("b{k}"), member_block(&self.members[k], 14 + k % 4), "rim", "top"));
        // The names of a test live as long as it does.
        let leak = |name: String| -> &'static str { name.leak() };
        let bodies = walls.chain(members).map(|(name, mut block, face, back)| {
            block.points.iter_mut().for_each(|x| *x = self.place(*x));
            let sides = [leak(format!("{name}.{face}")), "", leak(format!("{name}.{back}")), ""];
            (leak(name), block, sides)
        });
        Mesh { bodies: bodies.collect() }.text()
    }

    fn place(&self, x: [f64; 2]) -> [f64; 2] {
        x.map(|x| self.scale * x)
    }

    /// An elastic wall, 1.5 thick; two walls do not share the corner where they meet.
    fn wall_block(&self, k: usize) -> Block {
        let wall = &self.walls[k];
        let ([x, y], n) = (minus(wall.to, wall.from), wall.inward());
        let length = x.hypot(y);
        let short = if self.walls.len() == 1 { 0.0 } else { 0.1 / length };
        let begin = if k == 1 { short } else { 0.0 };
        grid((1.3 * length) as usize + 2, 3, 7 + k as u64, |u, v| {
            let u = begin + (1.0 - short) * u;
            [wall.from[0] + u * x - 1.5 * v * n[0], wall.from[1] + u * y - 1.5 * v * n[1]]
        })
    }

    /// The case file.
    pub fn case(&self) -> String {
        let young = format!("young = {:?}\npoisson = {POISSON}\n", self.young);
        let mut text =
            // A residual of 1e-10 of 50 000 unknowns may add up to 2e-8 on one body.
            String::from("output.fields = false\nsolver.tolerance = 1e-11\naccuracy.force = 1e-2\nmesh.file = \"mesh.msh\"\n");
        for (k, _) in self.walls.iter().enumerate().filter(|(_, wall)| !wall.rigid) {
            text += &format!("[body.w{k}]\n{young}[support.w{k}]\non = \"w{k}.back\"\nux = 0.0\nuy = 0.0\n");
        }
        if self.walls[0].rigid {
            let corners = std::iter::once(self.walls[0].from).chain(self.walls.iter().map(|wall| wall.to));
            text += &format!("[rigid.walls]\nline = {:?}\n", corners.map(|x| self.place(x)).collect::<Vec<_>>());
        }
        for (k, member) in self.members.iter().enumerate() {
            text += &self.member_text(k, member, &young);
            if !member.rigid && (member.upright || member.guided) {
                let held = [(member.upright, "angle = 0.0\n"), (member.guided, "ux = 0.0\n")];
                let held: String = held.iter().filter(|(is_held, _)| *is_held).map(|(_, words)| *words).collect();
                text += &format!("[support.b{k}]\nbody = \"b{k}\"\nmean = true\n{held}");
            }
        }
        for (k, touch) in self.touches.iter().enumerate() {
            let [a, b] = touch.pair.map(|side| self.side(side));
            text += &format!("[contact.c{k}]\nbetween = [\"{a}\", \"{b}\"]\n");
        }
        text
    }

    /// A body's material, shape and load.
    fn member_text(&self, k: usize, member: &Member, young: &str) -> String {
        let force = member.load.map(|load| load * self.young * self.scale);
        match member.shape {
            Shape::Plate { half, .. } => {
                let pressure = -force[1] / (2.0 * half * self.scale);
                format!("[body.b{k}]\n{young}[load.b{k}]\non = \"b{k}.top\"\npressure = {pressure:?}\n")
            }
            Shape::Round { round, clearance } => {
                let own = Round { centre: self.place(round.centre), size: self.scale * (round.size - clearance), ..round };
                let circle = format!("circle = {{ centre = {:?}, radius = {:?} }}\n", own.centre, own.size);
                if member.rigid {
                    return format!("[rigid.b{k}]\n{circle}force = {force:?}\n");
                }
                let [x, y] = own.formulas();
                let shape = if own.wave == 0.0 { circle } else { format!("x = \"{x}\"\ny = \"{y}\"\nt = [0.0, {TAU:?}]\n") };
                let density = force.map(|force| force / own.area());
                format!("[body.b{k}]\n{young}body_force = {density:?}\n[geometry.b{k}]\ncurves = [\"b{k}.rim\"]\n{shape}")
            }
        }
    }
}

/// A body's triangles, with so many edges around it.
fn member_block(member: &Member, count: usize) -> Block {
    match member.shape {
        Shape::Round { round, clearance } => Round { size: round.size - clearance, ..round }.mesh(count),
        Shape::Plate { middle: [x, y], half, depth } => {
            grid((2.6 * half) as usize + 3, 2 + depth as usize, 5, |u, v| [x + half * (2.0 * u - 1.0), y + depth * v])
        }
    }
}
