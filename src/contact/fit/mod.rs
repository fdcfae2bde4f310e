//! The curve half-way between two boundaries that meet: which nodes it is made of, where it ends, and whether it may stand.

mod bisector;
mod boundary_check;
mod halfway;
mod hertz;
mod meeting;
mod near_part;
mod nearest_place;
mod node_window;
mod own_curve;

pub use boundary_check::{stray, swings};
pub use hertz::hertz_width;
pub use meeting::Meeting;
pub use nearest_place::{PointContact, point_contact};
