//! System 1: the hits are the same whatever the engine schedules, culls, reads back or runs on.

mod beams;
mod culling;
mod devices;
mod logs;
mod ranges;
mod ray_tree;
mod schedules;
mod waiting;
