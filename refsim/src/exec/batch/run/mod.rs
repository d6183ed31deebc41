//! Execution of scheduled steps, 256 lanes at a time.
//!
//! - `slots`: storage of values; `ops`, `loops`, `pack`: lane operations on rows; `guard`: recomputation of results
//!   that fast arithmetics get wrong; `steps`: execution of blocks.
//! - Texture reads: `fetch`: entry point; `table`, `stored`: nearest; `filter`: one level, nearest or linear; `detail`:
//!   level selection; `leveled`: several levels; `address`: coordinates to texels; `corners`: weighted sums
//!   and interpolation; `component`: sources of components; `channel`: texel values.
//! - `flow`: programs with flow control.
//! - `array`: one operation on arrays of any length.

mod address;
mod array;
mod channel;
mod component;
mod corners;
mod detail;
mod fetch;
mod filter;
mod flow;
mod guard;
mod leveled;
mod loops;
mod ops;
mod pack;
mod slots;
mod steps;
mod stored;
mod table;

pub use array::ArrayOperation;
pub(crate) use fetch::{BatchTexture, TextureTables};
pub(crate) use flow::{FlowRun, fill_plan, first_lanes};
pub(crate) use slots::Slots;
pub(crate) use steps::{Surroundings, fill_constants, raw_constants, run_steps};
