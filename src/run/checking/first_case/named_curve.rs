//! Named boundaries, as `mezha new` looks at them.

use crate::contact::ClosePair;
use crate::geometry::Point;
use crate::mesh::{Boundary, MacroMesh};
use crate::run::checking::node_circle::NodeCircle;

/// Words in names of boundaries that are held, loaded, those of them that are pulled, and of symmetry, with blanks between them.
const HELD: &str =
    "bottom base fixed fix clamp clamped ground floor foundation support wall root grip hold held mount anchor encastre casing";
const LOADED: &str = "top load loaded press pressed pressure force punch push piston pull pulled tension drag lift traction";
pub const PULLED: &str = "pull pulled tension drag lift traction";
const MIRRORED: &str = "symmetry sym symm mirror symx symy symmx symmy xsym ysym xsymm ysymm";

/// Last words in names of what sits on or in something that holds it. Before other words they name the body, or a part of it:
/// `hub.outside` and `foot.left` are free.
const SEATS: [&str; 11] = ["foot", "bore", "axle", "axis", "hub", "shaft", "housing", "case", "frame", "carrier", "block"];

/// Words of so many letters at least are known at the beginning and at the end of a longer one, too: `clampleft`, `leftclamp`.
const LONG: usize = 5;

/// What lies nearer to x = 0 than this share of its length lies there.
const ON_AXIS: f64 = 1e-6;

/// A boundary looks along an axis if its mean normal has this component at least.
pub const ALONG: f64 = 0.95;

/// A named boundary as it lies.
pub struct NamedCurve<'a> {
    pub name: &'a str,
    pub body: usize,
    pub is_of_one_piece: bool,
    pub low: Point,
    pub high: Point,
    /// Mean of its outward normals by length; shorter than 1 where it is curved.
    pub normal: Point,
    pub length: f64,
    pub is_touched: bool,
    /// Whether three or more boundaries of its body differ in their numbers only: roots of threads or teeth, of which none is held
    /// or loaded by its name.
    pub is_one_of_many: bool,
    /// The circle that its nodes lie on, where the edges of the mesh are straight.
    pub circle: Option<NodeCircle>,
}

impl<'a> NamedCurve<'a> {
    pub fn new(mesh: &MacroMesh, boundary: &'a Boundary, pairs: &[ClosePair]) -> Option<Self> {
        let first = *boundary.edges.first()?;
        let (mut low, mut high) = (Point::repeat(f64::INFINITY), Point::repeat(f64::NEG_INFINITY));
        let (mut normal, mut length) = (Point::zeros(), 0.0);
        for &edge in &boundary.edges {
            for t in [0.0, 0.5, 1.0] {
                let x = mesh.edge_position(edge, t);
                (low, high) = (low.inf(&x), high.sup(&x));
            }
            normal += mesh.edge_length(edge) * mesh.edge_normal(edge, 0.5);
            length += mesh.edge_length(edge);
        }
        let piece = mesh.piece_beside(first);
        Some(Self {
            name: &boundary.name,
            body: mesh.body_beside(first),
            is_of_one_piece: boundary.edges.iter().all(|&edge| mesh.piece_beside(edge) == piece),
            low,
            high,
            normal: normal / length,
            length,
            is_one_of_many: false,
            circle: NodeCircle::of_edges(mesh, &boundary.edges),
            is_touched: pairs.iter().any(|pair| pair.between.contains(&boundary.name)),
        })
    }

    /// How far it reaches: the diagonal of its box (length).
    pub fn extent(&self) -> f64 {
        (self.high - self.low).norm()
    }

    /// Whether its name has one of some words, in any case, with a number behind it or not.
    pub fn has(&self, words: &str) -> bool {
        let is_known =
            |own: &String, word: &str| own == word || word.len() >= LONG && (own.starts_with(word) || own.ends_with(word));
        self.words().iter().any(|own| words.split(' ').any(|word| is_known(own, word)))
    }

    /// Whether its name says that it is a line of symmetry, or the axis, which lies on x = 0.
    pub fn is_mirrored(&self) -> bool {
        let lies_there = [self.low, self.high].iter().all(|x| x.x.abs() <= ON_AXIS * self.length);
        self.has(MIRRORED) || lies_there && self.has("axis")
    }

    /// Whether its name says that it is held.
    pub fn is_held(&self) -> bool {
        !self.is_one_of_many && self.has(HELD) || self.is_seat()
    }

    /// Whether its name says that it sits on or in something that holds it.
    pub fn is_seat(&self) -> bool {
        !self.is_one_of_many && self.words().last().is_some_and(|last| SEATS.contains(&last.as_str()))
    }

    /// Whether its name says that it is loaded.
    pub fn is_loaded(&self) -> bool {
        !self.is_one_of_many && self.has(LOADED)
    }

    /// The words of its name, in small letters and without numbers: `Seal.gripLeft2` has three.
    pub fn words(&self) -> Vec<String> {
        let letters: Vec<char> = self.name.chars().collect();
        let begins = |at: usize| at > 0 && letters[at].is_uppercase() && letters[at - 1].is_lowercase();
        let spaced = letters.iter().enumerate().flat_map(|(at, &c)| begins(at).then_some(' ').into_iter().chain([c]));
        let spaced: String = spaced.flat_map(char::to_lowercase).collect();
        spaced.split(|c: char| !c.is_alphabetic()).filter(|word| !word.is_empty()).map(str::to_owned).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn named(name: &str) -> NamedCurve<'_> {
        let [low, high, normal] = [Point::zeros(); 3];
        let [is_touched, is_one_of_many] = [false; 2];
        NamedCurve {
            name,
            body: 0,
            is_of_one_piece: true,
            low,
            high,
            normal,
            length: 1.0,
            is_touched,
            is_one_of_many,
            circle: None,
        }
    }

    #[test]
    fn words_are_known_in_any_case_and_with_others_around_them() {
        for name in [
            "root",
            "Lever.Root",
            "gripLeft",
            "GRIP_2",
            "clampleft",
            "leftclamp",
            "wheel axle",
            "hub",
            "gear.bore1",
            "base-3",
            "seal.housing",
        ] {
            assert!(named(name).is_held(), "{name}");
        }
        for name in ["hub.outside", "block.top left", "basalt", "seam", "routed", "axle.left flank"] {
            assert!(!named(name).is_held(), "{name}");
        }
        let away = NamedCurve { high: Point::new(1.0, 0.0), ..named("bolt.axis") };
        assert!(named("bolt.axis2").is_mirrored() && !away.is_mirrored() && away.is_held(), "an axis lies on x = 0");
        assert!(named("bolt.pull").has(PULLED) && named("PullRight").is_loaded() && !named("pulley").is_loaded());
    }
}
