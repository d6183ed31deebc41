//! Laws of system 3.

mod physics;
mod physics_bodies;
mod physics_walk;
