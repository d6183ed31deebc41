//! Stored bits: they fail when they change.

mod leaky_page;
mod leaky_teapot;
mod linalg;
mod probes;
mod teapot_study;
mod timing;
