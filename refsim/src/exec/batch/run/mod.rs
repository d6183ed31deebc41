//! Carrying out scheduled steps, 256 lanes at a time.
//!
//! - `slots`: where values are kept; `ops`, `loops`, `pack`: lane operations on rows; `guard`: what fast
//!   arithmetics leave to the general one; `steps`: blocks of operations.
//! - Texture reads: `fetch` chooses; `table`, `stored`: nearest; `filter`: one level, linear or not; `detail`: which
//!   levels; `leveled`: several; `address`: from coordinates to texels; `corners`: their weighted sums; `channel`:
//!   values of texels.
//! - `flow`: programs with flow control.

mod address;
mod channel;
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

pub(crate) use fetch::{BatchTexture, TextureTables};
pub(crate) use flow::{FlowObserver, FlowRun, fill_plan, first_lanes};
pub(crate) use slots::Slots;
pub(crate) use steps::{Surroundings, fill_constants, raw_constants, run_steps};
