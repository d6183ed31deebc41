//! Laws of system 3.

mod all_pairs;
mod links_blocks;
mod links_choice;
mod links_factors;
mod links_long;
mod links_models;
mod on_card;
mod on_card_views;
mod physics;
mod physics_bodies;
mod physics_walk;
pub(super) mod polygon;
mod thickness;
