//! Laws of system 3.

mod on_card;
mod on_card_views;
mod physics;
mod physics_bodies;
mod physics_traced;
mod physics_walk;
