//! Cases: one shader, its inputs, its geometry, and the expected results, in one TOML file.
//!
//! A case passes through three stages. `schema` defines the file format. [`Setup`] binds it to a device: reads files,
//! assembles and checks programs, decodes images, checks names and lengths. [`run`] draws once and evaluates the
//! probes; [`Loaded`] is the loaded card, and [`compare`] runs a case on two sides. Every error names the file and the
//! position in it. docs/cases.md describes the format.

mod binder;
mod compared;
mod constants;
mod device;
mod error;
mod fixed_function;
mod loaded;
mod run;
mod schema;
mod setup;
mod sides;
mod stages;
mod state;
mod texels;
mod traced;
mod translated;
mod value;
mod vertices;

pub use binder::Overrides;
pub use compared::{ComparedSides, pass_text};
pub use device::{device_named, meant};
pub use error::{CaseError, CaseWarning};
pub use loaded::{Loaded, log, log_observed};
pub use run::{CaseOutcome, run};
pub use setup::Setup;
pub use sides::{Comparison, CountDifference, First, Scope, Side, compare};
pub use state::{ProbeResult, ProbeValue};
pub use texels::CaseTexture;
pub use traced::{PixelTrace, TraceRow, Traced, fate, flag_names, letters, trace};
