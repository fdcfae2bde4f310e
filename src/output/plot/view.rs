//! A part of the plane on a sheet, without distortion.

use super::sheet::{AxisSpec, Sheet};

/// Room for a plot (pixels).
pub(super) struct PlotRoom {
    /// Its largest width and height.
    pub most: [f64; 2],
    /// Its smallest ones.
    pub least: [f64; 2],
    /// What lies around the part that is shown.
    pub around: f64,
}

/// The part of the plane that is shown, and the sheet that shows it.
pub(super) struct View {
    pub sheet: Sheet,
    pub x: AxisSpec,
    pub y: AxisSpec,
}

impl View {
    /// Holds a box, given by its lower left and upper right corner; `margins` are those of the sheet beside its vertical axis.
    pub fn of([low, high]: [[f64; 2]; 2], room: &PlotRoom, margins: impl Fn(&AxisSpec) -> [i32; 4]) -> View {
        let needed = [0, 1].map(|axis| high[axis] - low[axis]);
        let inner = room.most.map(|most| most - 2.0 * room.around);
        let pixels_per_length = (inner[0] / needed[0]).min(inner[1] / needed[1]);
        let pixels = [0, 1].map(|axis| (needed[axis] * pixels_per_length + 2.0 * room.around).max(room.least[axis]).round());
        let [x, y] = [(0, "x"), (1, "y")].map(|(axis, name)| {
            let (middle, half) = (0.5 * (low[axis] + high[axis]), 0.5 * pixels[axis] / pixels_per_length);
            AxisSpec::linear([middle - half, middle + half], (pixels[axis] / 80.0).ceil() as usize, name, "length")
        });
        let margins = margins(&y);
        let [width, height] = pixels.map(|pixels| pixels as i32);
        let sheet = Sheet { width: width + margins[0] + margins[1], height: height + margins[2] + margins[3], margins };
        View { sheet, x, y }
    }
}

/// Lower left and upper right corner of the box around all points; the corners lie at infinity if there are none.
pub fn bounds(points: impl Iterator<Item = [f64; 2]>) -> [[f64; 2]; 2] {
    points.fold([[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]], |[low, high], x| {
        [[0, 1].map(|axis| low[axis].min(x[axis])), [0, 1].map(|axis| high[axis].max(x[axis]))]
    })
}
