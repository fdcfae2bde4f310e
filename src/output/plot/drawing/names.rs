//! Names in a figure, none over another.

use std::f64::consts::FRAC_PI_4;
use std::iter::once;

use super::canvas::Canvas;
use super::frame::Frame;
use super::paint::{Letters, Paint, TextAnchor, text_width};

/// Places that are tried: how far from the anchor (pixels).
const AWAY: [f64; 6] = [9.0, 18.0, 30.0, 46.0, 66.0, 92.0];
/// Directions that are tried, from the wanted one (degrees).
const ASIDE: [f64; 9] = [0.0, 25.0, -25.0, 50.0, -50.0, 80.0, -80.0, 130.0, -130.0];
/// Steps up and down that are tried beside an anchor, and their size (pixels).
const STEPS: usize = 120;
const STEP: f64 = 3.0;
/// Room around a name (pixels).
const MARGIN: f64 = 2.0;
/// A leader is drawn to a name that is farther away (pixels).
const LEADER: f64 = 12.0;
/// A name of which other names would hide more than this share is left out.
const MOST_HIDDEN: f64 = 0.1;
/// Points of lines that names are kept away from, about: more would be looked at for each place of each name.
const MOST_POINTS: usize = 4000;

/// Where a name would rather stand.
#[derive(Clone, Copy, Debug)]
pub enum Wish {
    /// On what it names.
    There,
    /// In this direction from there.
    Towards([f64; 2]),
    /// To the right of it. Such a name is never left out.
    Beside,
}

/// A name that wants a place.
pub struct Name<'a> {
    /// The name.
    pub text: &'a str,
    /// Its letters.
    pub letters: Letters,
    /// What it names.
    pub anchor: [f64; 2],
    /// Where it would rather stand.
    pub wish: Wish,
}

/// What has a place already.
pub struct PlacedNames {
    /// The part of the figure that names may stand in.
    room: Frame,
    marks: Vec<Frame>,
    names: Vec<Frame>,
    /// Points of lines that names rather leave free.
    lines: Vec<[f64; 2]>,
}

impl PlacedNames {
    /// No name yet.
    pub fn new(room: Frame, lines: Vec<[f64; 2]>) -> Self {
        let every = lines.len().div_ceil(MOST_POINTS).max(1);
        Self { room, marks: Vec::new(), names: Vec::new(), lines: lines.into_iter().step_by(every).collect() }
    }

    /// Takes a place for something else.
    pub fn take(&mut self, place: [f64; 2], size: f64) {
        self.marks.push(Frame::around(place, [size, size]));
    }

    /// The nearest place that is so far from the border at least.
    pub fn within(&self, place: [f64; 2], far: f64) -> [f64; 2] {
        self.room.shrunk(far).nearest(place)
    }

    /// Draws a name where it is nearest to what it names and hides as little as can be, with a leader if that is far away. Nothing
    /// if there is no room left for it; tells whether there was.
    pub fn put(&mut self, canvas: &mut Canvas, name: &Name) -> bool {
        let size = name.letters.size;
        let extent = [text_width(name.text, size) + 2.0 * MARGIN, size + 2.0 * MARGIN];
        let frames: Vec<Frame> = places(name, extent).into_iter().map(|middle| Frame::around(middle, extent)).collect();
        let Some(reach) = frames.iter().copied().reduce(|all, frame| all.with(&frame)) else { return false };
        let near = self.near(&reach);
        let costs = frames.into_iter().enumerate().map(|(number, frame)| (near.cost(&frame) + number as f64, frame));
        let Some((_, frame)) = costs.min_by(|a, b| a.0.total_cmp(&b.0)) else { return false };
        let hidden: f64 = self.names.iter().map(|other| frame.shared(other)).sum();
        if hidden > MOST_HIDDEN * extent[0] * extent[1] && !matches!(name.wish, Wish::Beside) {
            return false;
        }
        self.names.push(frame);
        let near = frame.nearest(name.anchor);
        if (near[0] - name.anchor[0]).hypot(near[1] - name.anchor[1]) > LEADER {
            canvas.line(Paint::line(name.letters.colour, 0.7).faint(0.6), [name.anchor, near]);
        }
        let [x, y] = frame.middle();
        let (x, anchor) = match name.wish {
            Wish::Beside => (frame.0[0] + MARGIN, TextAnchor::Start),
            _ => (x, TextAnchor::Middle),
        };
        canvas.text(Letters { anchor, has_rim: true, ..name.letters }, [x, y], name.text);
        true
    }

    /// What may lie in a place within reach: of thousands of names and points a few, for some fifty places of each name.
    fn near(&self, reach: &Frame) -> Self {
        let within = |all: &[Frame]| all.iter().filter(|frame| frame.shared(reach) > 0.0).copied().collect();
        let lines = self.lines.iter().filter(|point| reach.holds(**point)).copied().collect();
        Self { room: self.room, marks: within(&self.marks), names: within(&self.names), lines }
    }

    /// How bad a place is.
    fn cost(&self, frame: &Frame) -> f64 {
        let hidden: f64 = self.names.iter().chain(&self.marks).map(|other| frame.shared(other)).sum();
        let crossed = self.lines.iter().filter(|point| frame.holds(**point)).count() as f64;
        20.0 * hidden + 40.0 * frame.outside(&self.room) + 12.0 * crossed
    }
}

/// Middles of boxes to try, the best first.
fn places(name: &Name, [width, height]: [f64; 2]) -> Vec<[f64; 2]> {
    let [x, y] = name.anchor;
    match name.wish {
        Wish::There => {
            let around = AWAY.iter().flat_map(|away| (0..8).map(move |k| (away, f64::from(k) * FRAC_PI_4)));
            once([x, y]).chain(around.map(|(away, angle)| [x + 1.5 * away * angle.cos(), y + away * angle.sin()])).collect()
        }
        Wish::Towards([dx, dy]) => {
            let turned = |away: f64, aside: f64| {
                let (sin, cos) = aside.to_radians().sin_cos();
                let (ux, uy) = (dx * cos - dy * sin, dx * sin + dy * cos);
                // The near side of the box is so far away, not its middle.
                let reach = (0.5 * width * ux.abs()).hypot(0.5 * height * uy.abs()).max(0.5 * height.min(width));
                [x + ux * (away + reach), y + uy * (away + reach)]
            };
            AWAY.iter().flat_map(|away| ASIDE.map(|aside| turned(*away, aside))).collect()
        }
        Wish::Beside => {
            let down = (0..STEPS).flat_map(|step| [-1.0, 1.0].map(|sign| sign * STEP * step as f64));
            down.map(|down| [x + AWAY[0] - MARGIN + 0.5 * width, y + down]).collect()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::plot::drawing::INK;
    use proptest::prelude::*;

    fn put(labels: &mut PlacedNames, text: &str, anchor: [f64; 2], wish: Wish) -> bool {
        let mut canvas = Canvas::new([400.0, 300.0]);
        let is_put = labels.put(&mut canvas, &Name { text, letters: Letters::new(11.0, INK), anchor, wish });
        assert_eq!(canvas.svg().contains("<text"), is_put);
        is_put
    }

    /// No name hides another, and all are in the room.
    fn check(labels: &PlacedNames) {
        for (k, frame) in labels.names.iter().enumerate() {
            assert!(frame.outside(&labels.room) < 1e-9, "{frame:?}");
            assert!(labels.names[..k].iter().all(|other| frame.shared(other) == 0.0), "{frame:?}");
        }
    }

    #[test]
    fn names_of_one_place_do_not_hide_each_other() {
        let mut labels = PlacedNames::new(Frame([0.0, 0.0, 400.0, 300.0]), Vec::new());
        for text in ["bottom", "bottom too", "another name", "left.lower", "<&>"] {
            assert!(put(&mut labels, text, [200.0, 280.0], Wish::Towards([0.0, 1.0])), "room for a few");
        }
        check(&labels);
    }

    #[test]
    fn names_beside_one_mark_stand_below_each_other() {
        let mut labels = PlacedNames::new(Frame([0.0, 40.0, 600.0, 400.0]), Vec::new());
        labels.take([400.0, 200.0], 8.0);
        assert!((0..9).all(|_| put(&mut labels, "line", [400.0, 200.0], Wish::Beside)));
        check(&labels);
        assert!(labels.names.iter().all(|frame| frame.0[0] > 404.0));
        assert_eq!(labels.names.iter().filter(|frame| frame.middle()[1] == 200.0).count(), 1, "one stands at the mark itself");
        assert!((0..99).all(|_| put(&mut labels, "line", [400.0, 200.0], Wish::Beside)), "none is left out");
    }

    proptest! {
        #[test]
        fn names_for_which_there_is_no_room_are_left_out(places in proptest::collection::vec((0.0..300.0, 0.0..200.0), 1..200)) {
            let mut labels = PlacedNames::new(Frame([0.0, 0.0, 300.0, 200.0]), Vec::new());
            let count = places.iter().filter(|(x, y)| put(&mut labels, "a long name", [*x, *y], Wish::There)).count();
            prop_assert!(count >= 1 && count == labels.names.len());
            for (k, frame) in labels.names.iter().enumerate() {
                let hidden: f64 = labels.names[..k].iter().map(|other| frame.shared(other)).sum();
                prop_assert!(hidden <= MOST_HIDDEN * frame.shared(frame), "{frame:?}");
            }
        }
    }
}
