//! The timing model: clocks from counts and a profile.
//!
//! The room sees what the machine wrote down ([`crate::event`]) and what a device can do ([`crate::device`]); it never
//! sees a value, so a change in here changes no pixel. [`DrawCost`] is what one draw keeps busy, and how long.
//!
//! All of it is whole numbers: clocks of a unit, and picoseconds on the common axis. The same events on the same
//! profile give the same timeline to the last clock.

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
