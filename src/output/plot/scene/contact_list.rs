//! Names of contacts that are too many to stand in the figure: they have numbers there, and stand in a list below it.

use super::scene_plot::MOST_NAMES;
use crate::output::plot::drawing::{Canvas, INK, Letters, text_width};
use crate::output::summary::MOST_TOLD;

/// Left of the list, between its columns, and its letters and rows (pixels).
const LEFT: f64 = 12.0;
const BETWEEN: f64 = 18.0;
const LETTERS: f64 = 11.0;
const ROW: f64 = 16.0;

/// Numbers and names, column by column.
pub struct ContactList {
    names: Vec<String>,
    rows: usize,
    /// Width of a column (pixels).
    width: f64,
}

impl ContactList {
    /// The list for a figure of a width (pixels); without rows if contacts are so few that their names have room in the figure, or
    /// so many that a list would not be read.
    pub fn new<'a>(contacts: impl ExactSizeIterator<Item = &'a str>, width: f64) -> Self {
        let is_listed = (MOST_TOLD + 1..=MOST_NAMES).contains(&contacts.len());
        let names = contacts.enumerate().filter(|_| is_listed).map(|(at, name)| format!("{} {name}", at + 1));
        let names: Vec<String> = names.collect();
        let widest = names.iter().map(|name| text_width(name, LETTERS)).fold(1.0, f64::max) + BETWEEN;
        let columns = (((width - LEFT) / widest) as usize).max(1);
        Self { rows: names.len().div_ceil(columns), names, width: widest }
    }

    /// Whether contacts have numbers in the figure.
    pub fn is_there(&self) -> bool {
        self.rows > 0
    }

    /// Room that it takes (pixels).
    pub fn height(&self) -> f64 {
        ROW * (self.rows as f64 + f64::from(self.is_there()))
    }

    /// Draws it from a height on.
    pub fn draw(&self, canvas: &mut Canvas, top: f64) {
        if self.is_there() {
            canvas.text(Letters::bold(LETTERS, INK), [LEFT, top + 0.5 * ROW], "contacts");
        }
        for (at, name) in self.names.iter().enumerate() {
            let [column, row] = [at / self.rows, at % self.rows].map(|number| number as f64);
            let place = [LEFT + column * self.width, top + ROW * (row + 1.5)];
            canvas.text(Letters::new(LETTERS, INK), place, name);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_stand_below_each_other_in_columns() {
        let list = |count: usize, width: f64| {
            let names: Vec<String> = (0..count).map(|k| format!("discs.disc{k}.rim")).collect();
            ContactList::new(names.iter().map(String::as_str), width)
        };
        assert!(
            [0, MOST_TOLD, MOST_NAMES + 1]
                .iter()
                .all(|count| !list(*count, 600.0).is_there() && list(*count, 600.0).height() == 0.0)
        );
        assert!(list(MOST_NAMES, 600.0).is_there());
        let narrow = list(9, 10.0);
        assert_eq!((narrow.rows, narrow.height()), (9, 160.0), "a column of names has no room beside another");
        let wide = list(20, 600.0);
        let mut canvas = Canvas::new([600.0, 400.0]);
        wide.draw(&mut canvas, 100.0);
        let text = canvas.svg();
        assert!(wide.rows > 4 && wide.rows < 10 && text.matches("<text").count() == 21, "{text}");
        assert!(text.contains(">1 discs.disc0.rim<") && text.contains(">20 discs.disc19.rim<"), "{text}");
        assert_eq!(
            text.matches(" x=\"120\"").count(),
            wide.rows + 1,
            "the title and those of the first column begin at one place"
        );
    }
}
