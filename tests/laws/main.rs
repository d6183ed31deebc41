//! Laws: what must hold of every input, by property tests and by formula.

mod bad_geometry;
mod beams;
mod built;
mod cases;
mod comparing;
mod culling;
mod engine;
mod engine_devices;
mod engine_modes;
mod geometry;
mod ground_truth;
mod light;
mod logs;
mod messages;
mod models;
mod mutation;
mod octree;
mod oracle;
mod outputs;
mod ply;
mod radiosity;
mod ranges;
mod ray_tree;
mod scene_files;
mod timing;
mod tiny_scenes;
