//! The scene of a case before anything is solved: bodies, boundaries, supports, loads and contacts, each with its name.

mod canvas;
mod drawn;
mod loads;
mod names;
mod supports;

pub use drawn::{BoundaryPoint, DrawnLoad, DrawnPart, DrawnSupport, Grip, NamedRows, Rows, SceneFigure};

use super::palette::{BLUE, GREEN, VERMILION};
use super::sheet::{Area, DrawResult, PIXEL, Sheet, line};
use super::view::{PlotRoom, View, bounds};
use canvas::Canvas;

/// Room for the plot, with marks and names around the bodies.
const ROOM: PlotRoom = PlotRoom { most: [760.0, 600.0], least: [360.0, 240.0], around: 74.0 };
/// Of rigid tools as much is shown around the bodies as this share of them.
const TOOLS: f64 = 0.4;
/// Height of a line of remarks (pixels).
const REMARK: i32 = 17;

impl SceneFigure {
    /// The text of an SVG file.
    ///
    /// # Errors
    /// Words if there is nothing to draw.
    pub fn svg(&self) -> Result<String, String> {
        let view = self.view().ok_or("there is no triangle with finite corners")?;
        view.sheet.text(|sheet, area| self.draw(sheet, area, &view)).map_err(|error| error.to_string())
    }

    /// The bodies, and of a tool that is much larger than them only the part beside them.
    fn view(&self) -> Option<View> {
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
        let is_size = |size: f64| size.is_finite() && size > 0.0;
        let margins = [66, 18, 62, 54 + self.remarks_height()];
        (0..2).all(|axis| is_size(high[axis] - low[axis])).then(|| View::of([low, high], &ROOM, |_| margins))
    }

    /// Height of all remarks, which stand below the axes (pixels).
    fn remarks_height(&self) -> i32 {
        REMARK * self.remarks.len() as i32
    }

    fn draw(&self, sheet: &Sheet, area: &Area, view: &View) -> DrawResult<String> {
        sheet.draw_title(area, &self.title)?;
        let [contact, support, load] = [line(&BLUE, 4.0), line(&GREEN, 2.0), line(&VERMILION, 2.0)];
        sheet.draw_legend(area, &[("contact", &[contact]), ("support", &[support]), ("load", &[load])])?;
        let height = sheet.height - self.remarks_height();
        let (upper, _) = area.split_vertically(height * PIXEL);
        let [left, right, top, bottom] = sheet.margins;
        let axes = Sheet { height, width: sheet.width, margins: [left, right, top, bottom - self.remarks_height()] };
        let chart = axes.draw_axes(&upper, &view.x, &view.y, false)?;
        let place = |x: [f64; 2]| chart.backend_coord(&x.into());
        let mut canvas = Canvas::new(sheet, self, &place);
        let [(x, y), (end, floor)] = sheet.corners();
        canvas.text = format!(
            "<clipPath id=\"plot\"><rect x=\"{x}\" y=\"{y}\" width=\"{}\" height=\"{}\"/></clipPath>\n<g clip-path=\"url(#plot)\">\n",
            end - x,
            floor - y
        );
        canvas.bodies(self);
        canvas.contacts(self);
        canvas.text += "</g>\n";
        canvas.supports(self);
        canvas.loads(self);
        canvas.names(self);
        canvas.remarks([12, height], REMARK, &self.remarks);
        canvas.counts(sheet);
        Ok(canvas.text)
    }
}
