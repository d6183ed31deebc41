//! Readers and writers of files: what is written reads back, and no bytes cause a panic.

mod cases;
mod foreign_obj;
mod gltf;
mod models;
mod mutation;
mod pictures;
mod ply;
mod scenes;
mod stl;
