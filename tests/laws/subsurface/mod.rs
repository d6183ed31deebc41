//! Laws of system 3.

mod links_choice;
mod links_factors;
mod links_models;
mod physics;
mod physics_bodies;
mod physics_walk;
