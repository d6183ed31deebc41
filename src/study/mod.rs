//! Studies: one folder a question. Parameters go in, [`Findings`] come out; nothing is printed or written here.
//!
//! docs/command_line.md says what a new study needs.

pub mod configuration;
pub mod leaky_teapot;
pub mod radiosity;
pub mod reproduce;
pub mod shade;
pub mod timeline_trace;

use crate::report::{Findings, Provenance};

/// Hears what is being done, how many steps of it are done, and of how many.
pub type ProgressFn<'a> = dyn FnMut(&str, u64, u64) + 'a;

/// A question with its parameters, ready to be answered.
pub trait Study {
    /// Why there is no answer.
    type Error: miette::Diagnostic + Send + Sync + 'static;

    /// Answers it.
    ///
    /// # Errors
    /// [`Study::Error`].
    fn findings(&self, progress: &mut ProgressFn<'_>) -> Result<Findings, Self::Error>;

    /// Adds devices, switches and seed, as they are used, to where the findings come from.
    fn provenance(&self, provenance: Provenance) -> Provenance;
}
