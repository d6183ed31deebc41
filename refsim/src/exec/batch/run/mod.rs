//! Execution of scheduled steps, 256 lanes at a time.
//!
//! - `steps`: execution of blocks.
//! - Texture reads: `fetch`: entry point; `filter`: one level; `detail`, `log_table`: level selection; `leveled`: several
//!   levels; `address`: coordinates to texels; `corners`: weighted sums and interpolation; `component`: sources of
//!   components; `channel`: texel values.
//! - `flow`: programs with flow control.

mod address;
mod channel;
mod component;
mod corners;
mod detail;
mod fetch;
mod filter;
mod flow;
mod leveled;
mod log_table;
mod steps;

pub(crate) use fetch::{BatchTexture, TextureTables};
pub(crate) use flow::{FlowRun, fill_plan, first_lanes};
pub(crate) use steps::{Surroundings, fill_constants, raw_constants, run_steps};
