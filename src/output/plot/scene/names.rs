//! Names of what a scene shows.

use std::fmt::Write;

use plotters::style::RGBColor;

use super::canvas::{Canvas, MOST_NAMES, contact_colour, flipped, size_of_marks};
use super::drawn::{DrawnLoad, DrawnPart, DrawnSupport, NamedRows, SceneFigure};
use super::loads::RESULTANT;
use crate::output::plot::labels::Name;
use crate::output::plot::palette::{GREEN, GREY, INK, VERMILION, hex};
use crate::output::plot::sheet::{PIXEL, Sheet};

/// Of more things than can be named about so many are.
const FEW_NAMES: usize = 6;

/// A name, its colour, what it names, and where it would rather stand from there (pixels).
type WantedName = (String, RGBColor, [f64; 2], Option<[f64; 2]>);

impl Canvas<'_> {
    /// Names: of bodies first, then of what was asked for, then of all boundaries.
    pub fn names(&mut self, figure: &SceneFigure) {
        let of_part = |part: &DrawnPart, own: &Self| Some((part.name.clone(), INK, own.at(part.inside), None));
        self.named(&figure.parts, "bodies", 14.0, of_part);
        let numbers: Vec<usize> = (0..figure.contacts.len()).collect();
        let of_contact = |&number: &usize, own: &Self| {
            let contact = &figure.contacts[number];
            let place = contact.place.map(|point| (own.at(point.place), flipped(point.normal)));
            let (anchor, [x, y]) = place.or_else(|| own.middle(&contact.rows, 0.5))?;
            Some((format!("contact {}", contact.name), contact_colour(number), anchor, Some([-x, -y])))
        };
        self.named(&numbers, "contacts", 12.0, of_contact);
        let of_support = |support: &DrawnSupport, own: &Self| {
            let (anchor, towards) = own.middle(&support.rows, 0.5)?;
            Some((support.name.clone(), GREEN, anchor, Some(towards)))
        };
        self.named(&figure.supports, "supports", 11.0, of_support);
        let of_load = |load: &DrawnLoad, own: &Self| {
            let resultant = || load.resultant.map(|(place, _)| (own.labels.within(own.at(place), RESULTANT), [1.0, 0.0]));
            let (anchor, towards) = own.middle(&load.rows, 0.5).or_else(resultant)?;
            Some((load.name.clone(), VERMILION, anchor, Some(towards)))
        };
        self.named(&figure.loads, "loads", 11.0, of_load);
        let size = 18.0 * size_of_marks(figure.boundaries.len());
        for row in figure.boundaries.iter().flat_map(|boundary| &boundary.rows) {
            for end in [row.first(), row.last()].into_iter().flatten() {
                let [x, y] = self.at(end.place).map(|x| f64::from(PIXEL) * x);
                let _ = writeln!(self.text, "<circle cx=\"{x:.0}\" cy=\"{y:.0}\" r=\"{size:.0}\" fill=\"{}\"/>", hex(INK));
            }
        }
        let of_boundary = |boundary: &NamedRows, own: &Self| {
            let (anchor, towards) = own.middle(&boundary.rows, 0.3)?;
            Some((boundary.name.clone(), GREY, anchor, Some(towards)))
        };
        self.named(&figure.boundaries, "boundaries", 11.0, of_boundary);
        self.text += &self.late;
    }

    /// Names of one kind, as far as there is room: text, colour, what is named, and where the name would rather stand from there.
    fn named<T>(&mut self, all: &[T], kind: &str, size: f64, of: impl Fn(&T, &Self) -> Option<WantedName>) {
        let every = if all.len() > MOST_NAMES { all.len().div_ceil(FEW_NAMES) } else { 1 };
        let weight = if size > 11.0 { "bold" } else { "normal" };
        let mut count = 0;
        for one in all.iter().step_by(every) {
            let Some((text, colour, anchor, towards)) = of(one, self) else { continue };
            let text: String = if text.chars().count() > 40 { text.chars().take(39).chain(['…']).collect() } else { text };
            let put = self.labels.put(&Name { text: &text, size, colour: &hex(colour), weight, anchor, towards });
            count += usize::from(put.is_some());
            self.late += &put.unwrap_or_default();
        }
        if count < all.len() {
            self.counts.push(format!("{count} of {} {kind}", all.len()));
        }
    }

    /// Of how many things some are named only, between legend and plot.
    pub fn counts(&mut self, sheet: &Sheet) {
        if !self.counts.is_empty() {
            let [x, y] = [sheet.width - 12, 57].map(|pixels| pixels * PIXEL);
            let words = self.counts.join(", ");
            let _ = writeln!(
                self.text,
                "<text x=\"{x}\" y=\"{y}\" text-anchor=\"end\" font-family=\"sans-serif\" font-size=\"100\" fill=\"{}\">named: {words}</text>",
                hex(GREY)
            );
        }
    }
}
