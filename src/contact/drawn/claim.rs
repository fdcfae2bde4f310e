//! Whether two contacts claim the same place of a boundary, which bears the pressure of one contact only.

use crate::contact::drawn::facing::{Facing, Seen};
use std::collections::HashMap;

/// Share of the shorter of two contacts that another may claim too, if its second body is another.
const MOST_SHARED: f64 = 0.5;

/// Edges that two contacts of the same boundaries may both reach, because each ends somewhere on one.
const SHARED_EDGES: f64 = 1.5;

impl Facing<'_> {
    /// Words, if this contact and another claim the same place of a boundary.
    pub(crate) fn clash(&self, other: &Self) -> Option<String> {
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
        let here = self.seen[k].iter().filter(|seen| seen.faces);
        let both = here.filter_map(|seen| Some(self.share(seen).min(*theirs.get(&seen.key())?) * seen.edge.length()));
        both.sum()
    }

    /// Share of an edge that lies across Γ_C.
    fn share(&self, seen: &Seen) -> f64 {
        let [first, last] = self.boundary.ends();
        let [from, to] = seen.feet;
        (to.min(last) - from.max(first)).max(0.0) / (to - from).max(f64::MIN_POSITIVE)
    }
}

#[cfg(test)]
mod tests {
    use crate::contact::drawn::facing::Facing;
    use crate::contact::pair::Pair;
    use crate::contact::samples::{SEAM, line, moved_blocks, seam};
    use crate::geometry::Point;

    /// Words of two contacts of the two blocks, on parts of the line; edges have lengths of up to 0.125.
    fn clash(first: ([&str; 2], [f64; 2]), second: ([&str; 2], [f64; 2])) -> Option<String> {
        let (mesh, numbering) = moved_blocks(|_| Point::zeros());
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
}
