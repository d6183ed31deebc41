//! Meshes, rays, exact hits, and every path that finds them.

mod bad_geometry;
mod ground_truth;
mod polygons;
mod teapot;
mod tiny_scenes;
