//! Figures, as SVG: the contact boundary in diagrams, the deformed bodies, whole and where they touch, and diagrams of many runs.
//!
//! Units are the user's own, so axes name the quantity: *unit of length*, *unit of stress*. Text is left to the fonts of the
//! viewer; plotters is built without its font libraries, and nothing of the layout hangs on the exact width of a text.

mod accuracy;
mod along;
mod deformed;
mod diagrams;
mod facets;
mod labels;
mod macro_edges;
mod named;
mod outline;
mod palette;
mod scene;
mod sheet;
mod steps;
mod stress;
mod ticks;
mod view;
mod zoom;

pub use accuracy::{Sequence, write_accuracy};
pub use along::{DrawnContact, write_displacement, write_gap, write_pressure};
pub use deformed::{DrawnForce, write_deformed};
pub use diagrams::{Axis, Diagram, DiagramBlock, LegendRow, Mark, diagrams};
pub use facets::Facet;
pub use macro_edges::DrawnEdge;
pub use named::{NamedDiagram, NamedLine, named_diagrams};
pub use scene::{BoundaryPoint, DrawnLoad, DrawnPart, DrawnSupport, Grip, NamedRows, Rows, SceneFigure};
pub use steps::write_step_figure;
pub use ticks::{number_text, number_to};
pub use view::bounds;
pub use zoom::{ContactZoom, write_zoom};
