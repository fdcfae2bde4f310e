//! Whether the two boundaries of a contact, as they are drawn, face each other along Γ_C, and no other contact claims the same
//! place.

use crate::contact::drawn::facing::{Across, Facing, Opposite, PLACES, Seen, largest_sagitta};
use crate::contact::pair::GapChoice;
use crate::geometry::Point;
use crate::mesh::MacroMesh;
use std::collections::{BTreeSet, HashMap, HashSet};

/// Share of Γ_C along which boundaries may turn their backs: more is no end that bends away.
const MOST_BACKS: f64 = 0.25;

/// Boundaries that touch lie within this share of the length of Γ_C.
const DRAWN_TOUCHING: f64 = 0.05;

/// Boundaries that touch lie within this share of the longest edge, on a Γ_C shorter than its edges.
const WITHIN_EDGES: f64 = 0.1;

/// Drawn boundaries lie this many times farther behind each other than chords from their arcs, if that means anything.
const POLYGONS: f64 = 4.0;

impl Facing<'_> {
    /// Looks at the contacts of a mesh, each by itself and against those that reach the same edges: of many contacts few do. Returns
    /// the indices of those that are refused, with words: their boundaries turn their backs to each other, lie on the wrong sides of
    /// each other, or are said to touch and lie apart, or another contact before them, which is not refused, claims the same place.
    pub fn refused(all: &[Self], mesh: &MacroMesh) -> Vec<(usize, String)> {
        let of_bodies = mesh.triangles_by_body();
        let (mut reached, mut refused) = (HashMap::<_, Vec<usize>>::new(), Vec::new());
        for (at, facing) in all.iter().enumerate() {
            let keys: HashSet<_> = facing.seen.iter().flatten().filter(|seen| seen.faces).map(Seen::key).collect();
            let others: BTreeSet<usize> = keys.iter().filter_map(|key| reached.get(key)).flatten().copied().collect();
            let clash = || others.into_iter().find_map(|other| facing.clash(&all[other]));
            match facing.check(mesh, &of_bodies).err().or_else(clash) {
                Some(why) => refused.push((at, why)),
                None => keys.into_iter().for_each(|key| reached.entry(key).or_default().push(at)),
            }
        }
        refused
    }

    /// Looks at one contact by itself; `of_bodies` are the triangles of each body.
    fn check(&self, mesh: &MacroMesh, of_bodies: &[Vec<usize>]) -> Result<(), String> {
        let [a, b] = &self.pair.between;
        let (mut backs, mut facing) = (Vec::new(), Vec::new());
        for t in self.places() {
            match self.across(t) {
                Across::Facing(opposite) => facing.push(opposite),
                Across::Back(side) => backs.push((t, side)),
                Across::Nothing => {}
            }
        }
        if let Some((t, side)) = backs.first().filter(|_| backs.len() as f64 > MOST_BACKS * (backs.len() + facing.len()) as f64) {
            let (x, name) = (self.boundary.point(*t), &self.pair.between[*side as usize]);
            return Err(format!(
                "\"{a}\" and \"{b}\" do not face each other: at ({:.6}, {:.6}) \"{name}\" has its body on the side of the other one; name the boundaries that look at each other",
                x.x, x.y
            ));
        }
        self.check_sides(mesh, of_bodies, &facing)?;
        self.check_touching(mesh, &facing)
    }

    /// Drawn boundaries that lie behind each other must lie in each other's bodies: an overlap.
    fn check_sides(&self, mesh: &MacroMesh, of_bodies: &[Vec<usize>], facing: &[Opposite]) -> Result<(), String> {
        let sagittas = largest_sagitta(mesh, &self.seen[0]) + largest_sagitta(mesh, &self.seen[1]);
        let least = POLYGONS * sagittas + 1e-6 * self.boundary.length();
        let behind: Vec<&Opposite> = facing.iter().filter(|opposite| opposite.gap < -least).collect();
        let bodies = [0, 1].map(|k| self.seen[k].first().map(|seen| mesh.triangles[seen.edge.triangle].body as usize));
        let holds = |body: Option<usize>, x: Point| {
            body.is_some_and(|body| of_bodies[body].iter().any(|&triangle| mesh.locate(triangle, x).is_some()))
        };
        let few = behind.iter().step_by(behind.len().div_ceil(PLACES / 8).max(1));
        let (overlapping, apart): (Vec<&Opposite>, Vec<&Opposite>) =
            few.partition(|opposite| holds(bodies[1], opposite.points[0]) || holds(bodies[0], opposite.points[1]));
        match apart.first() {
            Some(opposite) if apart.len() > overlapping.len() && 4 * behind.len() > facing.len() => {
                let ([first, second], x) = (&self.pair.between, self.boundary.point(opposite.parameter));
                Err(format!(
                    "\"{first}\" and \"{second}\" do not face each other: near ({:.6}, {:.6}) each lies {:.3e} behind the other, and outside the other body; name the boundaries that look at each other",
                    x.x, x.y, -opposite.gap
                ))
            }
            _ => Ok(()),
        }
    }

    /// Where the gap is zero by declaration, the middle one of the drawn distances is small.
    fn check_touching(&self, mesh: &MacroMesh, facing: &[Opposite]) -> Result<(), String> {
        if !matches!(self.pair.gap, GapChoice::Closed) || facing.is_empty() {
            return Ok(());
        }
        let mut gaps: Vec<f64> = facing.iter().map(|opposite| opposite.gap).collect();
        gaps.sort_by(|a, b| a.abs().total_cmp(&b.abs()));
        let middle = gaps[gaps.len() / 2];
        if middle.abs() <= (DRAWN_TOUCHING * self.boundary.length()).max(WITHIN_EDGES * self.longest_edge(mesh)) {
            return Ok(());
        }
        let [first, second] = &self.pair.between;
        Err(format!(
            "gap = \"closed\", but \"{first}\" and \"{second}\" are drawn {:.3e} {}, on a length of {:.3e}; name the boundaries that touch, or give gap = \"geometry\" or a number",
            middle.abs(),
            if middle > 0.0 { "apart" } else { "into each other" },
            self.boundary.length()
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::pair::Pair;
    use crate::contact::samples::{SEAM, line, moved_blocks, seam};
    use crate::geometry::Formula;

    fn checked(gap: GapChoice, between: [&str; 2], upper: impl Fn(Point) -> Point) -> Result<(), String> {
        let (mesh, numbering) = moved_blocks(upper);
        let pair = Pair { gap, between: between.map(String::from), ..seam() };
        let refused = Facing::refused(&[Facing::new(&mesh, &numbering, &pair, &line([0.0, 2.0]))], &mesh);
        refused.into_iter().next().map_or(Ok(()), |(_, words)| Err(words))
    }

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
}
