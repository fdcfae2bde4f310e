//! The one layer that all figures are drawn with: a canvas with lines, areas and words, axes, legends, and names that do not hide
//! each other. Lengths and places are pixels, places from the upper left corner of the canvas to the right and down.
//!
//! Text is left to the fonts of the viewer: nothing of the layout hangs on the exact width of a text.

mod canvas;
mod chart;
mod frame;
mod legend;
mod names;
mod outline;
mod paint;
mod scale;
mod ticks;

pub use canvas::Canvas;
pub use chart::{Chart, HEAD, PlotRoom, bounds, head, head_height, up_to_the_axis};
pub use frame::Frame;
pub use legend::{LegendCell, draw_mark, style_colour};
pub use names::{Name, PlacedNames, Wish};
pub use outline::{edges_around, loops, merged, path_data, tenths, unmatched};
pub use paint::{
    BLUE, Colour, GREEN, GREY, INK, LINES, Letters, Paint, TextAnchor, VERMILION, WHITE, diverging, text_width, viridis,
};
pub use scale::{Axis, Scale, range_of, widened};
pub use ticks::{cut_off, grouped, number_text, number_to, round_number};
