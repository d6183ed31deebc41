//! Tests the batch executor: its arithmetic against `num`; rows that leave a format's range and large textures against
//! the scalar executor.

mod array_operation;
#[path = "../common/environment.rs"]
mod environment;
mod guarded_rows;
mod lanes;
mod large_textures;
mod log_table;
mod pieces;
#[path = "../common/random.rs"]
mod random;
#[path = "../common/running.rs"]
mod running;
#[path = "../common/sums.rs"]
mod sums;
