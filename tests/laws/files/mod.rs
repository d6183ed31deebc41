//! Readers and writers of files: what is written reads back, and no bytes cause a panic.

mod cases;
mod foreign_obj;
mod models;
mod mutation;
mod pictures;
mod ply;
mod scenes;
