//! Device profiles: descriptions of the cards as data (docs/devices.md).
//!
//! A profile is a TOML file in `profiles/`, embedded in the library. It holds a card's arithmetic ([`Rules`], for the
//! executors), limits ([`Limits`], for [`crate::check`]) and speeds ([`Rates`], [`Bus`], for the timing model). Every
//! figure has a source and a [`Confidence`]. A *switch* is a figure with several allowed values.
//!
//! The device `ideal-<format>`, for any number format, has the rules of r300, and neither limits nor timing.

mod accumulator;
mod cards;
mod device_file;
mod error;
mod figure;
mod instruction_formats;
mod limits;
mod pixel_sums;
mod profile;
mod profile_file;
mod rule_values;
mod rules;
mod storage_formats;
mod switch;

pub(crate) use accumulator::PRODUCTS;
pub use error::DeviceError;
pub use figure::{Confidence, FigureRow, MeasuredCounts};
pub use instruction_formats::{InstructionFormats, MAX_INSTRUCTION_FORMATS, takes_format};
pub use limits::{Bus, DEFAULT_STEP_BUDGET, Limits, Rates};
pub use pixel_sums::SumRules;
pub use profile::Profile;
pub use rule_values::*;
pub use rules::Rules;
pub(crate) use storage_formats::MAX_PROGRAM_FORMATS;
pub use storage_formats::{Storage, StorageFormats};
pub use switch::Switch;
