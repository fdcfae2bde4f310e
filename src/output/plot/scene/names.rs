//! Names of what a scene shows.

use super::drawn::{DrawnLoad, DrawnPart, DrawnSupport, NamedRows, Rows, SceneFigure};
use super::loads::RESULTANT;
use super::scene_plot::{MOST_NAMES, ScenePlot, contact_colour, flipped, size_of_marks};
use crate::output::plot::drawing::{Colour, GREEN, GREY, INK, Letters, Name, Paint, TextAnchor, VERMILION, Wish};
use crate::output::summary::{MOST_TOLD, alike};

/// Of more things than can be named about so many are.
const FEW_NAMES: usize = 6;

/// Letters of a label at most: those of a stiff plate with a force and two motions.
const LONGEST: usize = 60;

/// What contacts are called together.
const CONTACTS: &str = "contacts";

/// A name, its colour, what it names, and where it would rather stand.
type WantedName = (String, Colour, [f64; 2], Wish);

impl ScenePlot {
    /// Names: of bodies first, then of what was asked for, then of all boundaries, whose ends are marked. Of more contacts than are told one
    /// by one the numbers, in the order of the case.
    pub fn names(&mut self, figure: &SceneFigure) {
        let has_numbers = figure.contacts.len() > MOST_TOLD;
        let radius = 1.8 * size_of_marks(figure.boundaries.len());
        for row in figure.boundaries.iter().flat_map(|boundary| &boundary.rows) {
            for end in [row.first(), row.last()].into_iter().flatten() {
                self.canvas.circle(Paint::fill(INK), self.chart.place(end.place), radius);
            }
        }
        let beside = |name: &str, colour: Colour, rows: &Rows, share: f64| {
            let (anchor, towards) = self.middle(rows, share)?;
            Some((name.to_owned(), colour, anchor, Wish::Towards(towards)))
        };
        let of_part = |part: &DrawnPart| Some((part.name.clone(), INK, self.chart.place(part.inside), Wish::There));
        let of_contact = |(number, contact): (usize, &NamedRows)| {
            let place = contact.place.map(|point| (self.chart.place(point.place), flipped(point.normal)));
            let (anchor, [x, y]) = place.or_else(|| self.middle(&contact.rows, 0.5))?;
            let name = if has_numbers { (number + 1).to_string() } else { format!("contact {}", contact.name) };
            Some((name, contact_colour(number), anchor, Wish::Towards([-x, -y])))
        };
        let of_support = |(name, support): (String, &DrawnSupport)| beside(&name, GREEN, &support.rows, 0.5);
        let of_load = |(name, load): (String, &DrawnLoad)| {
            let at = |place: [f64; 2]| self.labels.within(self.chart.place(place), RESULTANT);
            let resultant = || Some((name.clone(), VERMILION, at(load.resultant?.0), Wish::Towards([1.0, 0.0])));
            beside(&name, VERMILION, &load.rows, 0.5).or_else(resultant)
        };
        let supports = once_each("supports", figure.supports.iter().map(|one| (&one.name, &one.words, one)));
        let loads = once_each("loads", figure.loads.iter().map(|one| (&one.name, &one.words, one)));
        let wanted: [(&str, f64, Vec<Option<WantedName>>); 5] = [
            ("bodies", 14.0, figure.parts.iter().map(of_part).collect()),
            (CONTACTS, 12.0, figure.contacts.iter().enumerate().map(of_contact).collect()),
            ("supports", 11.0, supports.into_iter().map(of_support).collect()),
            ("loads", 11.0, loads.into_iter().map(of_load).collect()),
            ("boundaries", 11.0, figure.boundaries.iter().map(|one| beside(&one.name, GREY, &one.rows, 0.3)).collect()),
        ];
        let counts = wanted.into_iter().filter_map(|(kind, size, names)| self.named(&names, kind, size));
        let counts: Vec<String> = counts.collect();
        if !counts.is_empty() {
            let [_, top, right, _] = self.chart.frame.0;
            let letters = Letters::new(10.0, GREY).at(TextAnchor::End);
            self.canvas.text(letters, [right, top - 8.0], &format!("named: {}", counts.join(", ")));
        }
    }

    /// Names of one kind, as far as there is room; tells of how many some are named only.
    fn named(&mut self, all: &[Option<WantedName>], kind: &str, size: f64) -> Option<String> {
        // Numbers take little room, and those without room are left out.
        let has_numbers = kind == CONTACTS && all.len() > MOST_TOLD;
        let every = if all.len() > MOST_NAMES && !has_numbers { all.len().div_ceil(FEW_NAMES) } else { 1 };
        let mut count = 0;
        for (text, colour, anchor, wish) in all.iter().step_by(every).flatten().cloned() {
            let text: String =
                if text.chars().count() > LONGEST { text.chars().take(LONGEST - 1).chain(['…']).collect() } else { text };
            let letters = Letters { is_bold: size > 11.0, ..Letters::new(size, colour) };
            count += usize::from(self.labels.put(&mut self.canvas, &Name { text: &text, letters, anchor, wish }));
        }
        let rows = if has_numbers && all.len() > MOST_NAMES { " (rows of contacts.csv)" } else { "" };
        (count < all.len() || !rows.is_empty()).then(|| format!("{count} of {} {kind}{rows}", all.len()))
    }
}

/// Things with their labels: name and words, or words once for many of which the same is said, beside the first of them.
fn once_each<'a, T>(kind: &str, all: impl Iterator<Item = (&'a String, &'a String, &'a T)>) -> Vec<(String, &'a T)> {
    let label = |(words, own): (String, Vec<(&String, &'a T)>)| match own.len() {
        count if count > MOST_TOLD => vec![(format!("{count} {kind}: {words}"), own[0].1)],
        _ => own.iter().map(|(name, one)| (format!("{name}: {words}"), *one)).collect(),
    };
    alike(all.map(|(name, words, one)| (words.clone(), (name, one)))).into_iter().flat_map(label).collect()
}
