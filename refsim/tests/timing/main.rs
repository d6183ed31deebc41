//! Time: the cache, the pipeline model, the command queue, and laws of all.

mod cache;
mod laws;
mod model;
mod queue;
#[path = "../common/running.rs"]
mod running;
mod units;
