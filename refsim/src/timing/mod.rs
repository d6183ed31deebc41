//! The timing model: durations from event counts and a device profile.
//!
//! Its input is the machine's log ([`crate::event`]) and the device's speeds ([`crate::device`]), never pixel values,
//! so it cannot change an image. [`DrawCost`] is the cost of one draw.
//!
//! All arithmetic is in integers: clocks of a unit, and picoseconds on the common time axis. Equal events and profiles
//! give exactly equal timelines.

pub mod cache;
mod cost;
mod error;
pub mod host;
mod model;
pub mod pipeline;
pub mod queue;
pub mod replay;
pub mod timeline;
mod units;

pub use cost::{Bottleneck, DrawCost};
pub use error::TimingError;
pub use model::{Level, Model};
pub use units::{Clocks, Hertz, Picoseconds};
