//! Vertices and their frames, reflectance, the cube of light texels and light over it.

mod brdf;
mod grid;
mod vertices;
