//! Laws of the meshed atlas.

mod meshes;
mod odd;
mod seams;
mod texels;
mod tree;
