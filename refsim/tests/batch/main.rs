//! The batch executor's own code paths against the scalar executor and against `num`.

mod array_operation;
#[path = "../common/environment.rs"]
mod environment;
mod filter_rows;
mod guarded_rows;
mod lanes;
#[path = "../common/random.rs"]
mod random;
#[path = "../common/sampling.rs"]
mod sampling;
