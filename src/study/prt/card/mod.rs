//! Compressed transfer drawn by an emulated card: how far its pictures are off, by what, and how long a frame takes.

mod picture;
mod precision;
mod report;
mod subject;
mod tables;

pub use subject::{CardError, OnCard};
