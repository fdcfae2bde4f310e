//! Names in a figure, none over another.

use super::outline::straight;
use super::sheet::{PIXEL, text_width};
use std::fmt::Write;

/// Places that are tried: how far from the anchor (pixels).
const AWAY: [f64; 6] = [9.0, 18.0, 30.0, 46.0, 66.0, 92.0];

/// Directions that are tried, from the wanted one (degrees).
const ASIDE: [f64; 9] = [0.0, 25.0, -25.0, 50.0, -50.0, 80.0, -80.0, 130.0, -130.0];

/// Room around a name (pixels).
const MARGIN: f64 = 2.0;

/// A leader is drawn to a name that is farther away (pixels).
const LEADER: f64 = 16.0;

/// A name of which other names would hide more than this share is left out.
const MOST_HIDDEN: f64 = 0.1;

/// Points of lines that names are kept away from, about: more would be looked at for each place of each name.
const MOST_POINTS: usize = 4000;

/// A box in the figure: left, top, right, bottom (pixels).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Frame(pub [f64; 4]);

impl Frame {
    fn around([x, y]: [f64; 2], [width, height]: [f64; 2]) -> Self {
        Self([x - 0.5 * width, y - 0.5 * height, x + 0.5 * width, y + 0.5 * height])
    }

    /// Area that two boxes share.
    fn shared(&self, other: &Self) -> f64 {
        let (a, b) = (self.0, other.0);
        let along = |low: usize| (a[low + 2].min(b[low + 2]) - a[low].max(b[low])).max(0.0);
        along(0) * along(1)
    }

    fn holds(&self, [x, y]: [f64; 2]) -> bool {
        let [left, top, right, bottom] = self.0;
        (left..=right).contains(&x) && (top..=bottom).contains(&y)
    }

    fn outside(&self, other: &Self) -> f64 {
        let [left, top, right, bottom] = self.0;
        (right - left) * (bottom - top) - self.shared(other)
    }
}

/// A name that wants a place.
pub(super) struct Name<'a> {
    pub text: &'a str,
    pub size: f64,
    pub colour: &'a str,
    pub weight: &'a str,
    /// What it names (pixels).
    pub anchor: [f64; 2],
    /// Where it would rather stand from there; nothing to stand on the anchor itself.
    pub towards: Option<[f64; 2]>,
}

/// What has a place already.
pub(super) struct PlacedNames {
    /// The part of the figure that names may stand in.
    room: Frame,
    marks: Vec<Frame>,
    names: Vec<Frame>,
    /// Points of lines that names rather leave free.
    lines: Vec<[f64; 2]>,
}

impl PlacedNames {
    pub fn new(room: Frame, lines: Vec<[f64; 2]>) -> Self {
        let every = lines.len().div_ceil(MOST_POINTS).max(1);
        Self { room, marks: Vec::new(), names: Vec::new(), lines: lines.into_iter().step_by(every).collect() }
    }

    /// Takes a place for something else.
    pub fn take(&mut self, place: [f64; 2], size: f64) {
        self.marks.push(Frame::around(place, [size, size]));
    }

    /// The nearest place that is so far from the border at least.
    pub fn within(&self, [x, y]: [f64; 2], far: f64) -> [f64; 2] {
        let [left, top, right, bottom] = self.room.0;
        [x.max(left + far).min(right - far), y.max(top + far).min(bottom - far)]
    }

    /// Puts a name where it is nearest to what it names and hides as little as can be, with a leader if that is far away. Nothing
    /// if there is no room left for it.
    pub fn put(&mut self, name: &Name) -> Option<String> {
        let extent = [text_width(name.text, name.size) + 2.0 * MARGIN, name.size + 2.0 * MARGIN];
        let mut best: Option<(f64, [f64; 2])> = None;
        for (number, middle) in places(name, extent).into_iter().enumerate() {
            let frame = Frame::around(middle, extent);
            let hidden: f64 = self.names.iter().chain(&self.marks).map(|other| frame.shared(other)).sum();
            let crossed = self.lines.iter().filter(|point| frame.holds(**point)).count() as f64;
            let cost = 20.0 * hidden + 40.0 * frame.outside(&self.room) + 12.0 * crossed + number as f64;
            if best.is_none_or(|(least, _)| cost < least) {
                best = Some((cost, middle));
            }
        }
        let (_, [x, y]) = best?;
        let frame = Frame::around([x, y], extent);
        let hidden: f64 = self.names.iter().map(|other| frame.shared(other)).sum();
        if hidden > MOST_HIDDEN * extent[0] * extent[1] {
            return None;
        }
        self.names.push(frame);
        let mut text = String::new();
        let [left, top, right, bottom] = frame.0;
        let near = [name.anchor[0].clamp(left, right), name.anchor[1].clamp(top, bottom)];
        let p = f64::from(PIXEL);
        if (near[0] - name.anchor[0]).hypot(near[1] - name.anchor[1]) > LEADER {
            let _ = writeln!(
                text,
                "<path fill=\"none\" stroke=\"{}\" stroke-opacity=\"0.6\" stroke-width=\"7\" d=\"{}\"/>",
                name.colour,
                straight([name.anchor, near])
            );
        }
        // A white one below: not every viewer knows how to paint strokes first.
        for paint in [
            "fill=\"#fff\" stroke=\"#fff\" stroke-opacity=\"0.85\" stroke-width=\"30\"".to_owned(),
            format!("fill=\"{}\"", name.colour),
        ] {
            let _ = writeln!(
                text,
                "<text x=\"{:.0}\" y=\"{:.0}\" text-anchor=\"middle\" font-family=\"sans-serif\" font-size=\"{:.0}\" font-weight=\"{}\" {paint}>{}</text>",
                p * x,
                p * (y + 0.35 * name.size),
                p * name.size,
                name.weight,
                escaped(name.text)
            );
        }
        Some(text)
    }
}

/// Middles of boxes to try, the best first.
fn places(name: &Name, [width, height]: [f64; 2]) -> Vec<[f64; 2]> {
    let [x, y] = name.anchor;
    let Some([dx, dy]) = name.towards else {
        let around = AWAY.iter().flat_map(|away| (0..8).map(move |k| (away, f64::from(k) * std::f64::consts::FRAC_PI_4)));
        let beside = around.map(|(away, angle)| [x + 1.5 * away * angle.cos(), y + away * angle.sin()]);
        return std::iter::once([x, y]).chain(beside).collect();
    };
    let mut all = Vec::new();
    for away in AWAY {
        for aside in ASIDE {
            let (sin, cos) = f64::sin_cos(aside.to_radians());
            let (ux, uy) = (dx * cos - dy * sin, dx * sin + dy * cos);
            // The near side of the box is so far away, not its middle.
            let reach = (0.5 * width * ux.abs()).hypot(0.5 * height * uy.abs()).max(0.5 * height.min(width));
            all.push([x + ux * (away + reach), y + uy * (away + reach)]);
        }
    }
    all
}

/// A text as it stands in XML.
pub(super) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn names_of_one_place_do_not_hide_each_other() {
        let room = Frame([0.0, 0.0, 400.0, 300.0]);
        let mut labels = PlacedNames::new(room, Vec::new());
        for text in ["bottom", "bottom too", "another name", "left.lower", "<&>"] {
            let towards = Some([0.0, 1.0]);
            let name = Name { text, size: 11.0, colour: "#262626", weight: "normal", anchor: [200.0, 280.0], towards };
            let drawn = labels.put(&name).expect("room for a few");
            assert!(drawn.contains("<text") && !drawn.contains("<&>"));
        }
        for (k, frame) in labels.names.iter().enumerate() {
            assert!(frame.outside(&room) < 1e-9, "{frame:?}");
            assert!(labels.names[..k].iter().all(|other| frame.shared(other) == 0.0), "{frame:?}");
        }
    }

    proptest! {
        #[test]
        fn names_for_which_there_is_no_room_are_left_out(places in proptest::collection::vec((0.0..300.0, 0.0..200.0), 1..200)) {
            let mut labels = PlacedNames::new(Frame([0.0, 0.0, 300.0, 200.0]), Vec::new());
            let name = |anchor| Name { text: "a long name", size: 12.0, colour: "#000", weight: "bold", anchor, towards: None };
            let put = places.iter().filter(|(x, y)| labels.put(&name([*x, *y])).is_some()).count();
            prop_assert!(put >= 1 && put == labels.names.len());
            for (k, frame) in labels.names.iter().enumerate() {
                let hidden: f64 = labels.names[..k].iter().map(|other| frame.shared(other)).sum();
                prop_assert!(hidden <= MOST_HIDDEN * frame.outside(&Frame([0.0; 4])), "{frame:?}");
            }
        }
    }
}
