//! Contacts of a case: which sides may touch, and how their contact is modelled.
//!
//! In come the tables `[contact.NAME]`; out come pairs of sides, and the sides that are made of several physical curves. A side is
//! the name of a curve or of a rigid tool, or the names of several curves joined by ` + `. A contact whose sides can be read has a
//! name for each of them, whatever else is bad.

pub mod reading;
pub mod sides;
