//! Tests of modelled time: the cache, the pipeline model, the command queue, and laws of all of them.

mod cache;
mod laws;
mod model;
mod queue;
#[path = "../common/running.rs"]
mod running;
mod units;
