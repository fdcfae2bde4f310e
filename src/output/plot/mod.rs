//! Figures, as SVG: the contact boundary in two diagrams, and the deformed bodies.
//!
//! Units are the user's own, so axes name the quantity: *unit of length*, *unit of stress*. Text is left to the fonts of the viewer;
//! plotters is built without its font libraries, and nothing of the layout hangs on the exact width of a text.

mod along;
mod deformed;
mod outline;
mod palette;
mod sheet;
mod ticks;

pub use along::{write_displacement, write_pressure};
pub use deformed::{Facet, write_deformed};
