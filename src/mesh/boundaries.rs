//! Curves of a mesh that have names, found by them: a scene of many bodies asks for each of thousands.

use std::collections::HashMap;
use std::fmt;
use std::ops::Deref;

/// A physical curve: macro edges on the boundary of one body or several.
#[derive(Clone, Debug)]
pub struct Boundary {
    /// Name in the mesh file.
    pub name: String,
    /// Macro edges of the curve.
    pub edges: Vec<u32>,
    /// Whether the case has made it of several physical curves.
    pub is_union: bool,
}

/// Named curves in the order in which they came, each name once.
#[derive(Clone, Default)]
pub struct Boundaries {
    all: Vec<Boundary>,
    places: HashMap<String, usize>,
}

impl Boundaries {
    /// The curve of that name, if there is one.
    pub fn named(&self, name: &str) -> Option<&Boundary> {
        self.places.get(name).map(|&at| &self.all[at])
    }

    /// One more curve.
    pub fn push(&mut self, boundary: Boundary) {
        self.places.insert(boundary.name.clone(), self.all.len());
        self.all.push(boundary);
    }

    /// The edges of the curve of that name, which begins with none, and its place among all.
    pub fn edges_mut(&mut self, name: String) -> (usize, &mut Vec<u32>) {
        let at = self.places.get(&name).copied().unwrap_or_else(|| {
            self.push(Boundary { name, edges: Vec::new(), is_union: false });
            self.all.len() - 1
        });
        (at, &mut self.all[at].edges)
    }
}

impl fmt::Debug for Boundaries {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        self.all.fmt(f)
    }
}

impl Deref for Boundaries {
    type Target = [Boundary];

    fn deref(&self) -> &[Boundary] {
        &self.all
    }
}

impl<'a> IntoIterator for &'a Boundaries {
    type Item = &'a Boundary;
    type IntoIter = std::slice::Iter<'a, Boundary>;

    fn into_iter(self) -> Self::IntoIter {
        self.all.iter()
    }
}

impl FromIterator<Boundary> for Boundaries {
    fn from_iter<I: IntoIterator<Item = Boundary>>(curves: I) -> Self {
        let mut all = Self::default();
        curves.into_iter().for_each(|curve| all.push(curve));
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curves_keep_their_order_and_are_found_by_their_names() {
        let mut all: Boundaries =
            ["b", "a"].map(|name| Boundary { name: name.into(), edges: vec![3], is_union: false }).into_iter().collect();
        all.edges_mut("a".into()).1.push(7);
        assert_eq!(all.edges_mut("c".into()), (2, &mut Vec::new()));
        let names: Vec<&str> = all.iter().map(|curve| &*curve.name).collect();
        assert_eq!(names, ["b", "a", "c"]);
        assert_eq!(all.named("a").map(|curve| &*curve.edges), Some(&[3, 7][..]));
        assert!(all.named("d").is_none());
    }
}
