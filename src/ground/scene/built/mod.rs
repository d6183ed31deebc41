//! Models built by the project: exact numbers of vertices or faces, the same bits on every platform.
//!
//! Fronts face outwards (inwards in a room). Coordinates are computed in f64 by additions, products, square roots and
//! [`crate::elementary`], and rounded to f32 once.
//!
//! - [`rooms`]: closed rooms with few walls;
//! - [`stand_ins`]: meshes with the face counts of models that a paper shows;
//! - [`transfer_models`]: meshes with normals, texture coordinates and the vertex counts of other papers' models;
//! - `bunny`, `bodies`: the surfaces of these models; `isosurface` makes bodies of rounded pieces, `resample` gives a
//!   closed surface any number of vertices;
//! - [`flat_models`]: models of flat parts with several materials;
//! - [`meshes`]: all of these by name;
//! - [`ground`]: a square below a model that receives its shadow.

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
