//! Whether the two boundaries of a contact, as they are drawn, face each other along Γ_C, and no other contact claims the same
//! place.

use super::{ContactBoundary, GapChoice, Pair, Side, all_edges, faces};
use crate::geometry::Point;
use crate::mesh::{BoundaryEdge, EdgeNode, MacroMesh, Numbering, SmoothNormals};
use std::collections::{BTreeSet, HashMap, HashSet};

/// Places along Γ_C that are looked at, at most.
const PLACES: usize = 64;

/// Share of Γ_C along which boundaries may turn their backs: more is no end that bends away.
const MOST_BACKS: f64 = 0.25;

/// Boundaries that touch lie within this share of the length of Γ_C.
const DRAWN_TOUCHING: f64 = 0.05;

/// The same as a share of the edges, on a Γ_C shorter than these.
const WITHIN_EDGES: f64 = 0.1;

/// Drawn boundaries lie this many times farther behind each other than chords from their arcs, if that means anything.
const POLYGONS: f64 = 4.0;

/// Share of the shorter of two contacts that another may claim too, if its second body is another.
const MOST_SHARED: f64 = 0.5;

/// Edges that two contacts of the same boundaries may both reach, because each ends somewhere on one.
const SHARED_EDGES: f64 = 1.5;

/// The boundaries of one contact as they are drawn, seen along the normals of Γ_C.
pub struct Facing<'a> {
    pair: &'a Pair,
    boundary: &'a ContactBoundary,
    /// For each body its edges that see Γ_C.
    seen: [Vec<Seen>; 2],
}

/// An edge that sees a part of Γ_C.
struct Seen {
    edge: BoundaryEdge,
    /// Parameters of Γ_C at its ends, lower first, and its ends in that order.
    feet: [f64; 2],
    ends: [Point; 2],
    /// Whether its outward normal points at the other body.
    faces: bool,
}

impl Seen {
    /// What other contacts know the edge by.
    fn key(&self) -> [EdgeNode; 2] {
        [self.edge.nodes[0], self.edge.nodes[1]]
    }
}

/// What stands across Γ_C at one of its points.
enum Across {
    /// Both bodies look at it: the places of body 1 and of body 2.
    Facing([Point; 2]),
    /// One of them has its back to it only.
    Back(Side),
    /// One of them has nothing there.
    Nothing,
}

impl<'a> Facing<'a> {
    /// Looks at the undeformed boundaries of a pair on the level that is numbered.
    pub fn new(mesh: &MacroMesh, numbering: &Numbering, pair: &'a Pair, boundary: &'a ContactBoundary) -> Self {
        let all = all_edges(mesh, numbering, pair, &|_| Point::zeros());
        let mut sides = [Side::First, Side::Second].into_iter();
        let seen = all.map(|edges| {
            let side = sides.next().unwrap_or(Side::Second);
            let see = |edge: BoundaryEdge| {
                let corners = [edge.points[0], edge.points[1]];
                let parts: Vec<[f64; 2]> = boundary.parts(corners).collect();
                if parts.is_empty() {
                    return Vec::new();
                }
                let [from, to] = boundary.directed_feet(corners);
                let ends = if from <= to { corners } else { [corners[1], corners[0]] };
                let faces = faces(boundary, side, &edge);
                parts.into_iter().map(|feet| Seen { edge: edge.clone(), feet, ends, faces }).collect()
            };
            edges.into_iter().flat_map(see).collect()
        });
        Self { pair, boundary, seen }
    }

    /// Looks at the contacts of a mesh, each by itself and against those that reach the same edges: of many contacts few do.
    ///
    /// # Errors
    /// The index of a contact and words, if its boundaries turn their backs to each other, lie on the wrong sides of each other,
    /// or are said to touch and lie apart, or if another contact claims the same place.
    pub fn check_all(all: &[Self], mesh: &MacroMesh) -> Result<(), (usize, String)> {
        let mut of_bodies = vec![Vec::new(); mesh.bodies.len()];
        (0..mesh.triangles.len()).for_each(|triangle| of_bodies[mesh.triangles[triangle].body as usize].push(triangle));
        let mut reached: HashMap<_, Vec<usize>> = HashMap::new();
        for (at, facing) in all.iter().enumerate() {
            facing.check(mesh, &of_bodies).map_err(|why| (at, why))?;
            let keys: HashSet<_> = facing.seen.iter().flatten().filter(|seen| seen.faces).map(Seen::key).collect();
            let mut others = BTreeSet::new();
            for key in keys {
                let there = reached.entry(key).or_default();
                others.extend(there.iter().copied());
                there.push(at);
            }
            let clash = others.into_iter().find_map(|other| facing.clash(&all[other]));
            clash.map_or(Ok(()), |why| Err((at, why)))?;
        }
        Ok(())
    }

    fn check(&self, mesh: &MacroMesh, of_bodies: &[Vec<usize>]) -> Result<(), String> {
        let [a, b] = &self.pair.between;
        let (mut backs, mut facing) = (Vec::new(), Vec::new());
        for t in self.places() {
            match self.across(t) {
                Across::Facing(points) => facing.push((t, points)),
                Across::Back(side) => backs.push((t, side)),
                Across::Nothing => {}
            }
        }
        if let Some((t, side)) = backs.first().filter(|_| backs.len() as f64 > MOST_BACKS * (backs.len() + facing.len()) as f64) {
            let (x, name) = (self.boundary.point(*t), if *side == Side::First { a } else { b });
            return Err(format!(
                "\"{a}\" and \"{b}\" do not face each other: at ({:.6}, {:.6}) \"{name}\" has its body on the side of the other one; name the boundaries that look at each other",
                x.x, x.y
            ));
        }
        self.check_sides(mesh, of_bodies, &facing)?;
        self.check_touching(mesh, &facing)
    }

    /// Drawn boundaries that lie behind each other must lie in each other's bodies: an overlap.
    fn check_sides(&self, mesh: &MacroMesh, of_bodies: &[Vec<usize>], facing: &[(f64, [Point; 2])]) -> Result<(), String> {
        let least = POLYGONS * self.largest_sagitta(mesh) + 1e-6 * self.boundary.length();
        let behind: Vec<&(f64, [Point; 2])> = facing.iter().filter(|(t, points)| self.gap(*t, points) < -least).collect();
        let few = behind.iter().step_by(behind.len().div_ceil(PLACES / 8).max(1));
        let bodies = [0, 1].map(|k| self.seen[k].first().map(|seen| mesh.triangles[seen.edge.triangle].body as usize));
        let holds = |body: Option<usize>, x: Point| {
            body.is_some_and(|body| of_bodies[body].iter().any(|&triangle| mesh.locate(triangle, x).is_some()))
        };
        let apart = |points: &[Point; 2]| !holds(bodies[1], points[0]) && !holds(bodies[0], points[1]);
        let (mut count, mut wrong) = (0, Vec::new());
        for place in few {
            count += 1;
            if apart(&place.1) {
                wrong.push(*place);
            }
        }
        match wrong.first() {
            Some((t, points)) if 2 * wrong.len() > count && 4 * behind.len() > facing.len() => {
                let x = self.boundary.point(*t);
                Err(format!(
                    "\"{}\" and \"{}\" do not face each other: near ({:.6}, {:.6}) each lies {:.3e} behind the other, and outside the other body; name the boundaries that look at each other",
                    self.pair.between[0],
                    self.pair.between[1],
                    x.x,
                    x.y,
                    -self.gap(*t, points)
                ))
            }
            _ => Ok(()),
        }
    }

    /// Where the gap is zero by declaration, the middle one of the drawn distances is small.
    fn check_touching(&self, mesh: &MacroMesh, facing: &[(f64, [Point; 2])]) -> Result<(), String> {
        if !matches!(self.pair.gap, GapChoice::Closed) || facing.is_empty() {
            return Ok(());
        }
        let mut gaps: Vec<f64> = facing.iter().map(|(t, points)| self.gap(*t, points)).collect();
        gaps.sort_by(|a, b| a.abs().total_cmp(&b.abs()));
        let middle = gaps[gaps.len() / 2];
        if middle.abs() <= (DRAWN_TOUCHING * self.boundary.length()).max(WITHIN_EDGES * self.longest_edge(mesh)) {
            return Ok(());
        }
        Err(format!(
            "gap = \"closed\", but \"{}\" and \"{}\" are drawn {:.3e} {}, on a length of {:.3e}; name the boundaries that touch, or give gap = \"geometry\" or a number",
            self.pair.between[0],
            self.pair.between[1],
            middle.abs(),
            if middle > 0.0 { "apart" } else { "into each other" },
            self.boundary.length()
        ))
    }

    /// Drawn distance of body 2 from body 1.
    fn gap(&self, t: f64, points: &[Point; 2]) -> f64 {
        (points[1] - points[0]).dot(&self.boundary.normal(t))
    }

    /// Parameters between the ends of Γ_C, evenly.
    fn places(&self) -> impl Iterator<Item = f64> {
        let [first, last] = ends(self.boundary);
        (0..PLACES).map(move |k| first + (last - first) * (k as f64 + 0.5) / PLACES as f64)
    }

    fn across(&self, t: f64) -> Across {
        let x = self.boundary.point(t);
        let mut points = [x; 2];
        for (k, side) in [Side::First, Side::Second].into_iter().enumerate() {
            let there = self.seen[k].iter().filter(|seen| seen.feet[0] <= t && t <= seen.feet[1]);
            let (front, back): (Vec<&Seen>, Vec<&Seen>) = there.partition(|seen| seen.faces);
            let place = |seen: &&Seen| {
                let share = (t - seen.feet[0]) / (seen.feet[1] - seen.feet[0]).max(f64::MIN_POSITIVE);
                seen.ends[0] + share * (seen.ends[1] - seen.ends[0])
            };
            let nearest = front.iter().map(place).min_by(|a, b| (a - x).norm().total_cmp(&(b - x).norm()));
            match nearest {
                Some(point) => points[k] = point,
                None if back.is_empty() => return Across::Nothing,
                None => return Across::Back(side),
            }
        }
        Across::Facing(points)
    }

    /// Longest macro edge of both boundaries.
    fn longest_edge(&self, mesh: &MacroMesh) -> f64 {
        let edges = self.seen.iter().flatten().map(|seen| seen.edge.nodes[0].edge);
        edges.map(|edge| mesh.edge_length(edge)).fold(0.0, f64::max)
    }

    /// How far chords of both boundaries lie from their arcs at most: declared ones from the small edges, others from those of
    /// the mesh file.
    fn largest_sagitta(&self, mesh: &MacroMesh) -> f64 {
        let of = |seen: &[Seen]| {
            let mut edges: Vec<u32> = seen.iter().map(|seen| seen.edge.nodes[0].edge).collect();
            edges.sort_unstable();
            edges.dedup();
            let normals = SmoothNormals::new(mesh, &edges);
            let small = |edge: u32| seen.iter().filter(|seen| seen.edge.nodes[0].edge == edge).count().max(1) as f64;
            let sagitta = |&edge: &u32| {
                let [a, b] = mesh.edges[edge as usize].vertices.map(|vertex| mesh.vertices[vertex as usize]);
                let height = (normals.at(mesh, edge, 0.5).place - 0.5 * (a + b)).norm();
                if mesh.edges[edge as usize].shape.is_some() { height / small(edge).powi(2) } else { height }
            };
            edges.iter().map(sagitta).fold(0.0, f64::max)
        };
        of(&self.seen[0]) + of(&self.seen[1])
    }

    /// Words, if this contact and another claim the same place of a boundary.
    fn clash(&self, other: &Self) -> Option<String> {
        let shared = [0, 1].map(|k| [0, 1].map(|l| self.shared(k, other, l)));
        let longest = |of: &Self| of.seen.iter().flatten().map(|seen| seen.edge.length()).fold(0.0, f64::max);
        let edge = longest(self).max(longest(other));
        let shorter = self.boundary.length().min(other.boundary.length());
        // Both boundaries are the other's too, in either order.
        let both = shared[0][0].min(shared[1][1]).max(shared[0][1].min(shared[1][0]));
        let most = shared.iter().flatten().copied().fold(0.0, f64::max);
        if both <= SHARED_EDGES * edge && most <= (MOST_SHARED * shorter).max(SHARED_EDGES * edge) {
            return None;
        }
        let (k, _) = (0..4).map(|at| (at, shared[at / 2][at % 2])).max_by(|a, b| a.1.total_cmp(&b.1))?;
        Some(format!(
            "\"{}\" is in contact.{} too, over {:.3e} of the same length: one place of a boundary can bear the pressure of one contact only; leave one of them out, or name parts of the boundary",
            self.pair.between[k / 2],
            other.pair.name,
            most
        ))
    }

    /// Length of body `k`'s boundary here that is body `l`'s boundary there, where both contacts reach.
    fn shared(&self, k: usize, other: &Self, l: usize) -> f64 {
        let mut theirs: HashMap<_, f64> = HashMap::new();
        for seen in other.seen[l].iter().filter(|seen| seen.faces) {
            *theirs.entry(seen.key()).or_default() += other.share(seen);
        }
        let own = self.seen[k].iter().filter(|seen| seen.faces);
        let both = own.filter_map(|seen| Some(self.share(seen).min(*theirs.get(&seen.key())?) * seen.edge.length()));
        both.sum()
    }

    /// Share of an edge that lies across Γ_C.
    fn share(&self, seen: &Seen) -> f64 {
        let [first, last] = ends(self.boundary);
        let [from, to] = seen.feet;
        (to.min(last) - from.max(first)).max(0.0) / (to - from).max(f64::MIN_POSITIVE)
    }
}

fn ends(boundary: &ContactBoundary) -> [f64; 2] {
    let knots = boundary.knots();
    [knots[0], knots[knots.len() - 1]]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::samples::seam;
    use crate::element::Order;
    use crate::geometry::{Curve, Formula};
    use crate::mesh::samples::two_blocks;
    use crate::mesh::{Level, Partition};
    use std::rc::Rc;

    /// The two blocks, each vertex of the upper one moved by a function of its place.
    fn blocks(upper: impl Fn(Point) -> Point) -> (MacroMesh, Numbering) {
        let mut mesh = two_blocks();
        let body = mesh.bodies.iter().position(|name| name == "upper").expect("a body");
        let own: Vec<u32> = mesh.triangles.iter().filter(|t| t.body as usize == body).flat_map(|t| t.vertices).collect();
        let own: std::collections::BTreeSet<u32> = own.into_iter().collect();
        for vertex in own {
            let x = &mut mesh.vertices[vertex as usize];
            *x += upper(*x);
        }
        let numbering = Numbering::new(Level { intervals: 16, order: Order::P1 }, &Rc::new(Partition::new(&mesh, &[0; 6], 1)));
        (mesh, numbering)
    }

    fn line([from, to]: [f64; 2]) -> ContactBoundary {
        ContactBoundary::new(Curve::Line([[from, 1.0], [to, 1.0]]), [0.0, 1.0], Point::new(0.0, 1.0))
    }

    fn checked(gap: GapChoice, between: [&str; 2], upper: impl Fn(Point) -> Point) -> Result<(), String> {
        let (mesh, numbering) = blocks(upper);
        let pair = Pair { gap, between: between.map(String::from), ..seam() };
        Facing::check_all(&[Facing::new(&mesh, &numbering, &pair, &line([0.0, 2.0]))], &mesh).map_err(|(_, words)| words)
    }

    const SEAM: [&str; 2] = ["lower.seam", "upper.seam"];

    #[test]
    fn bodies_behind_each_other_must_overlap_there() {
        let lifted = |y: f64| checked(GapChoice::Geometry, SEAM, move |_| Point::new(0.0, y));
        for y in [0.0, 3.0, -1e-7, -0.1, -0.5, -0.99] {
            assert_eq!(lifted(y), Ok(()), "by {y}");
        }
        // Each lies wholly below the other; so does a half of them.
        for (y, distance) in [(-2.2, "2.200e0"), (-3.0, "3.000e0")] {
            let words = lifted(y).expect_err("apart");
            assert!(words.contains(&format!("each lies {distance} behind the other, and outside")), "{words}");
        }
    }

    /// The upper block rises steeply out of the lower one, or falls below it, over a part of the length.
    #[test]
    fn a_small_part_behind_and_outside_is_left_alone() {
        let below = |share: f64| checked(GapChoice::Geometry, SEAM, move |x| Point::new(0.0, -40.0 * (share - 0.5 * x.x)));
        assert_eq!((below(0.05), below(0.2)), (Ok(()), Ok(())));
        assert!(below(0.5).expect_err("half of it").contains("do not face each other: near (") && below(0.9).is_err());
    }

    #[test]
    fn what_is_said_to_touch_must_be_drawn_so() {
        let drawn = |y: f64| checked(GapChoice::Closed, SEAM, move |_| Point::new(0.0, y));
        // A tenth of the longest macro edge, which is 2.
        assert_eq!([drawn(0.0), drawn(0.19), drawn(-0.19)], [Ok(()), Ok(()), Ok(())]);
        let [apart, into] = [drawn(0.21), drawn(-0.21)].map(|found| found.expect_err("too far"));
        assert!(apart.contains("are drawn 2.100e-1 apart, on a length of 2.000e0"), "{apart}");
        assert!(into.contains("are drawn 2.100e-1 into each other"), "{into}");
        // The middle one of the distances tells: more than a half of them are small here, and less than a half there.
        let tilted = |share: f64| checked(GapChoice::Closed, SEAM, move |x| Point::new(0.0, 0.2 * 0.5 * x.x / share));
        assert!(tilted(0.6).is_ok() && tilted(0.4).is_err());
        let number = GapChoice::Formula(Formula::constant(0.0));
        assert_eq!(checked(number, SEAM, |_| Point::new(0.0, 0.5)), Ok(()), "a declared gap is believed");
    }

    #[test]
    fn a_boundary_that_turns_its_back_is_named() {
        for (between, name) in
            [(["bottom", "upper.seam"], "bottom"), (["lower.seam", "top"], "top"), (["upper.seam", "lower.seam"], "upper.seam")]
        {
            let words = checked(GapChoice::Geometry, between, |_| Point::zeros()).expect_err("a back");
            assert!(words.contains(&format!("\"{name}\" has its body on the side of the other one")), "{words}");
        }
    }

    /// Words of two contacts of the two blocks, on parts of the line; edges have lengths of up to 0.125.
    fn clash(first: ([&str; 2], [f64; 2]), second: ([&str; 2], [f64; 2])) -> Option<String> {
        let (mesh, numbering) = blocks(|_| Point::zeros());
        let [one, other] =
            [first, second].map(|(between, ends)| (Pair { between: between.map(String::from), ..seam() }, line(ends)));
        let facing = [&one, &other].map(|(pair, boundary)| Facing::new(&mesh, &numbering, pair, boundary));
        let [there, back] = [facing[0].clash(&facing[1]), facing[1].clash(&facing[0])];
        assert_eq!(there.is_some(), back.is_some());
        there
    }

    #[test]
    fn two_contacts_of_the_same_boundaries_share_an_edge_and_a_half_at_most() {
        assert_eq!(clash((SEAM, [0.0, 1.0]), (SEAM, [1.0, 2.0])), None);
        assert_eq!(clash((SEAM, [0.0, 1.05]), (SEAM, [0.95, 2.0])), None);
        let words = clash((SEAM, [0.0, 1.25]), (SEAM, [0.75, 2.0])).expect("half the length");
        assert!(words.contains("is in contact.seam too, over 5.000e-1 of the same length"), "{words}");
        assert!(clash((SEAM, [0.0, 2.0]), (SEAM, [0.5, 1.0])).is_some());
    }

    #[test]
    fn contacts_with_another_body_share_half_the_shorter_one_at_most() {
        let other = ["lower.seam", "top"];
        assert_eq!(clash((SEAM, [0.0, 1.0]), (other, [0.7, 2.0])), None);
        let words = clash((SEAM, [0.0, 1.0]), (other, [0.3, 2.0])).expect("most of the first");
        assert!(words.contains("\"lower.seam\" is in contact.seam too"), "{words}");
        assert!(clash((other, [0.3, 2.0]), (SEAM, [0.0, 1.0])).is_some());
    }

    /// Places lie evenly within the part that Γ_C is; across each are a point of the flat side and one of the rising side over it.
    #[test]
    fn points_across_lie_on_the_normal_line_of_their_place() {
        let (mesh, numbering) = blocks(|x| Point::new(0.0, 0.1 * x.x));
        let pair = seam();
        let curve = Curve::Line([[0.0, 1.0], [2.0, 1.0]]);
        let boundary = ContactBoundary::new(curve, [0.25, 0.35], Point::new(0.0, 1.0));
        let facing = Facing::new(&mesh, &numbering, &pair, &boundary);
        let places: Vec<f64> = facing.places().collect();
        let (step, count) = (0.1 / PLACES as f64, PLACES as f64);
        assert!((places[0] - 0.25 - 0.5 * step).abs() < 1e-12 && (places.iter().sum::<f64>() / count - 0.3).abs() < 1e-12);
        assert!(places.windows(2).all(|two| (two[1] - two[0] - step).abs() < 1e-12));
        for t in places {
            let Across::Facing([below, above]) = facing.across(t) else { panic!("both are there at {t}") };
            let (x, y) = (2.0 * t, 1.0 + 0.2 * t);
            assert!((below - Point::new(x, 1.0)).norm() < 1e-12 && (above - Point::new(x, y)).norm() < 1e-12, "{t}: {above}");
        }
        assert!(matches!(facing.across(-0.1), Across::Nothing) && matches!(facing.across(1.1), Across::Nothing));
    }
}
