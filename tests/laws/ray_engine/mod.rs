//! System 1: hits do not depend on the engine's schedule, culling, read-back or executor.

mod beams;
mod culling;
mod devices;
mod ranges;
mod ray_tree;
mod schedules;
mod waiting;
