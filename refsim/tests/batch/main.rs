//! The batch executor's own code paths against the scalar executor and against `num`.

mod array_operation;
mod filter_rows;
mod flat_tiles;
mod guarded_rows;
mod lanes;
mod packed_lanes;
mod random;
#[path = "../common/sampling.rs"]
mod sampling;
