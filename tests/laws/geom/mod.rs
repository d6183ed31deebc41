//! Meshes, rays, exact hits, and every way to compute hits.

mod bad_geometry;
mod ground_truth;
mod polygons;
mod teapot;
mod tiny_scenes;
