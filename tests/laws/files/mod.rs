//! Readers and writers of files: written files can be read back, and no bytes cause a panic.

mod built_scenes;
mod cases;
mod foreign_obj;
mod gltf;
mod models;
pub(crate) mod mutation;
mod pictures;
mod ply;
mod scenes;
mod stl;
