//! The scene of a case before anything is solved: bodies, boundaries, supports, loads and contacts, each with its name.

mod contact_list;
mod drawn;
mod loads;
mod names;
mod scene_plot;
mod supports;

pub use drawn::{BoundaryPoint, DrawnLoad, DrawnPart, DrawnSupport, Grip, NamedRows, Rows, SceneFigure};

use super::drawing::{BLUE, Canvas, Chart, GREEN, HEAD, LegendCell, Letters, Paint, PlotRoom, VERMILION, bounds, up_to_the_axis};
use contact_list::ContactList;
use scene_plot::ScenePlot;

/// Room for the plot, with marks and names around the bodies.
const ROOM: PlotRoom = PlotRoom { most: [760.0, 600.0], least: [360.0, 240.0], around: 74.0 };
/// Of rigid tools as much is shown around the bodies as this share of them.
const TOOLS: f64 = 0.4;
/// Height of a line of remarks (pixels).
const REMARK: f64 = 17.0;
/// What is to the right of the plot (pixels).
const RIGHT: f64 = 18.0;

impl SceneFigure {
    /// The text of an SVG file; None if there is no triangle with finite corners. What is wrong stands below the axes.
    pub fn svg(&self) -> Option<String> {
        let chart = Chart::of_plane(self.shown()?, &ROOM, [HEAD, RIGHT], (self.has_axis, self.units.length()));
        let [width, height] = chart.panel.extent();
        let list = ContactList::new(self.contacts.iter().map(|contact| contact.name.as_str()), width);
        let below = height + REMARK * self.remarks.len() as f64;
        let mut canvas = Canvas::new([width, below + list.height()]);
        list.draw(&mut canvas, below);
        let legend = [("contact", BLUE, 4.0), ("support", GREEN, 2.0), ("load", VERMILION, 2.0)];
        let legend = legend.map(|(words, colour, width)| LegendCell::lines(words, &[Paint::line(colour, width)]));
        chart.draw_head(&mut canvas, &self.title, &[legend.into()]);
        chart.draw_axes(&mut canvas, false);
        for (number, remark) in self.remarks.iter().enumerate() {
            canvas.text(Letters::new(12.0, VERMILION), [12.0, height + REMARK * number as f64 + 4.0], remark);
        }
        let mut plot = ScenePlot::new(canvas, chart, self);
        plot.bodies(self);
        plot.supports(self);
        plot.loads(self);
        plot.names(self);
        Some(plot.canvas.svg())
    }

    /// The bodies, and of a tool that is much larger than them only the part beside them.
    fn shown(&self) -> Option<[[f64; 2]; 2]> {
        let around = |is_shown: fn(&DrawnPart) -> bool| {
            let shown = self.parts.iter().filter(|part| is_shown(part));
            bounds(shown.flat_map(|part| &part.triangles).flatten().copied())
        };
        let [mut low, mut high] = around(|part| !part.is_rigid);
        let [least, most] = around(|_| true);
        let near = TOOLS * (high[0] - low[0]).max(high[1] - low[1]);
        for axis in [0, 1] {
            (low[axis], high[axis]) = (least[axis].max(low[axis] - near), most[axis].min(high[axis] + near));
        }
        if self.has_axis {
            [low, high] = up_to_the_axis([low, high]);
        }
        let is_size = |size: f64| size.is_finite() && size > 0.0;
        (0..2).all(|axis| is_size(high[axis] - low[axis])).then_some([low, high])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A plate with so many contacts along its top, and as many supports of one kind along its bottom.
    fn plate(count: usize) -> String {
        let point = |x: f64, y: f64, up: f64| BoundaryPoint { place: [x, y], normal: [0.0, up], traction: [0.0; 2] };
        let row = |k: usize, y: f64, up: f64| vec![vec![point(k as f64, y, up), point(k as f64 + 0.5, y, up)]];
        let part = DrawnPart {
            name: "plate".into(),
            triangles: vec![vec![[0.0, 0.0], [count as f64, 0.0], [0.0, 5.0]]],
            inside: [0.3 * count as f64, 1.5],
            ..DrawnPart::default()
        };
        let support =
            |k: usize| DrawnSupport { name: format!("s{k}"), words: "ux = 0".into(), rows: row(k, 0.0, -1.0), grip: Grip::Both };
        let contact = |k: usize| NamedRows { name: format!("c{k}"), rows: row(k, 5.0, 1.0), place: None };
        let (contacts, supports) = ((0..count).map(contact).collect(), (0..count).map(support).collect());
        SceneFigure { parts: vec![part], contacts, supports, ..SceneFigure::default() }.svg().expect("a figure")
    }

    /// Each name has a rim, which is a text too; those of the list have none.
    #[test]
    fn many_contacts_have_numbers_and_a_list_and_supports_alike_one_name() {
        let count = |text: &str, words: &str| text.matches(&format!(">{words}<")).count();
        let few = plate(8);
        assert_eq!(["contact c0", "contact c7", "s0: ux = 0", "contacts"].map(|words| count(&few, words)), [2, 2, 2, 0], "{few}");
        let many = plate(12);
        // Ticks have numbers too, which are not bold.
        let bold = many.lines().filter(|line| line.contains("bold")).collect::<String>();
        assert_eq!(["1", "12"].map(|number| count(&bold, number)), [2, 2], "{many}");
        assert_eq!(["1 c0", "12 c11", "12 supports: ux = 0"].map(|words| count(&many, words)), [1, 1, 2], "{many}");
        assert!(!many.contains("contact c") && !many.contains("s0: ") && !many.contains("named: "), "{many}");
    }
}
