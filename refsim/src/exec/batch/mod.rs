//! The batch executor: programs on whole tiles of fragments, in vector code of the host.

mod evaluate;
mod fixed;
mod float;
mod lane;
mod lanes;
mod odd;
mod ops;
mod power;
mod slots;

pub use evaluate::{LaneOperation, convert, evaluate};
