//! Figures, as SVG: the contact boundary in two diagrams, the deformed bodies, and diagrams of many runs.
//!
//! Units are the user's own, so axes name the quantity: *unit of length*, *unit of stress*. Text is left to the fonts of the
//! viewer; plotters is built without its font libraries, and nothing of the layout hangs on the exact width of a text.

mod accuracy;
mod along;
mod deformed;
mod diagrams;
mod macro_edges;
mod outline;
mod palette;
mod sheet;
mod steps;
mod ticks;

pub use accuracy::{Sequence, write_accuracy};
pub use along::{write_displacement, write_pressure};
pub use deformed::{Facet, write_deformed};
pub use diagrams::{Axis, Diagram, DiagramBlock, LegendRow, Mark, diagrams};
pub use macro_edges::DrawnEdge;
pub use steps::write_step_figure;
