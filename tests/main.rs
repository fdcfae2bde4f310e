//! What must hold for the whole program, a file for each subject: `cargo test --release --test whole -- patch::` runs those of one.
//!
//! They are one program, so that what they share is compiled and linked once.

mod support;

mod accuracy;
mod bad_cases;
mod bars;
mod classics;
mod closed;
mod closed_forms;
mod commands;
mod cycles;
mod effectivity;
mod energy;
mod estimate;
mod everyday;
mod faults;
mod first_case;
mod fit;
mod floors;
mod following;
mod graded;
mod hard;
mod hard_meshes;
mod held;
mod interruption;
mod manufactured;
mod many;
mod materials;
mod mean;
mod mesh_files;
mod mesh_formats;
mod mesh_recipe;
mod messages;
mod paper;
mod patch;
mod patterns;
mod progress;
mod python;
mod repeats;
mod report;
mod rigid;
mod rings;
mod scaling;
mod schema;
mod sets;
mod several;
mod solver;
mod stability;
mod steps;
mod study;
mod supports;
mod three_bodies;
mod turning;
mod vtk_readable;
