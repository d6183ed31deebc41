//! Stored bits: they fail when they change.

mod foreign;
mod leaky_teapot;
mod probes;
mod timing;
