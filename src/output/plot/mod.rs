//! Figures, as SVG: the contact boundary in diagrams, the deformed bodies, whole and where they touch, the scene of a case, and
//! diagrams of many runs. All of them are drawn on one layer, `drawing`.
//!
//! Units are the user's own. Where the case names none, axes name the quantity: *unit of length*, *unit of stress*.

mod bodies;
mod diagrams;
mod drawing;
mod scene;

pub use bodies::{ContactZoom, DeformedFigure, DrawnEdge, DrawnForce, Facet, stress_file};
pub use diagrams::{
    Diagram, DiagramBlock, DiagramLine, DrawnContact, Mark, Sequence, diagrams, named_diagrams, write_accuracy, write_along,
    write_step_figure,
};
pub use drawing::{Axis, LegendCell, bounds, grouped, number_text, number_to, range_of};
pub use scene::{BoundaryPoint, DrawnLoad, DrawnPart, DrawnSupport, Grip, NamedRows, Rows, SceneFigure};
