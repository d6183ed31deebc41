//! Device profiles: the cards as data.
//!
//! A profile is a TOML file in `profiles/`, embedded in the library. It says how a card computes ([`Rules`]: what
//! executors obey), what it allows ([`Limits`]: what [`crate::check`] obeys) and how fast it is ([`Rates`], [`Bus`]:
//! what the timing model obeys). Every figure carries its source and how sure we are of it; what nobody has published
//! is a *switch*, a figure with several allowed values whose default is marked as a guess, so that a study can run all
//! of them. docs/devices.md is the guided tour.
//!
//! Besides the cards there is `ideal-<format>` for any number format: no limits, no time, the rules of r300.

mod error;
mod figure;
mod limits;
mod profile;
mod rules;
mod switch;

pub use error::DeviceError;
pub use figure::{Confidence, FigureRow};
pub use limits::{Bus, DEFAULT_STEP_BUDGET, Limits, Rates};
pub use profile::Profile;
pub use rules::{
    ColorIterator, ConstantStorage, LrpMode, MadMode, ResultRange, Rules, SignedTexelMinimum, TargetRounding,
    TexcrdOverflow, TexdepthDenominator, TexkillComponents,
};
pub use switch::Switch;
