//! Cases: one shader, everything it reads and draws, and what must come out, in one TOML file.
//!
//! A case passes through three hands. [`schema`] says what may be written. [`Setup`] binds it to a device: files are
//! read, programs assembled and judged, images decoded, names and lengths checked. [`run`] draws once and answers the
//! probes. Every error names the file and the place in it. docs/cases.md describes the format.

mod error;
mod probe;
mod run;
pub mod schema;
mod setup;
mod state;
mod texels;
mod value;
mod vertices;

pub use error::CaseError;
pub use probe::{Found, ProbeResult};
pub use run::{Outcome, Picture, ShaderSlots, run};
pub use setup::Setup;
pub use value::{Number, OneOrMany};
