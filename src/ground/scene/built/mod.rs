//! Models built by the project: exact numbers of vertices or faces, the same bits on every platform.
//!
//! Fronts face outwards (inwards in a room). Coordinates are computed in f64 by additions, products, square roots and
//! [`crate::elementary`], and rounded to f32 once.
//!
//! [`meshes`] lists the models by name; `isosurface` makes bodies of rounded pieces, and `resample` gives a closed surface
//! any number of vertices.

mod bodies;
mod bunny;
pub mod flat_models;
mod grid;
pub mod ground;
mod isosurface;
pub mod meshes;
mod resample;
pub mod rooms;
pub mod stand_ins;
pub mod transfer_models;
