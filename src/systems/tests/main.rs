//! Facts of the systems, through the crate's public items, by room.

mod radiosity;
mod ray_engine;
mod renderer;
mod subsurface;
