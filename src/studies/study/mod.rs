//! Studies: one folder per question. Parameters go in, [`Findings`] come out; nothing is printed or written here.
//!
//! docs/contributing.md describes how to add a study.

pub mod atlas;
pub mod caster;
pub mod configuration;
mod error;
pub mod framing;
mod glossy_model;
pub mod leaky_teapot;
mod marble_model;
pub mod matrix_product;
pub mod measure;
pub mod page;
pub mod picture_difference;
pub mod precision;
pub mod prt;
pub mod radiosity;
pub mod reproduce;
pub mod shade;
pub mod subsurface;
pub mod timeline_trace;
pub mod tour;

use crate::report::{Findings, Provenance};

pub use error::StudyError;

/// Called with the current step's name, the number of units done, and their total.
pub type ProgressFn<'a> = dyn FnMut(&str, u64, u64) + 'a;

/// A question with its parameters.
pub trait Study {
    /// Runs the study. Fails if the input does not suit the study, or a library refuses it.
    fn findings(&self, progress: &mut ProgressFn<'_>) -> Result<Findings, StudyError>;

    /// Adds the devices, switches and seed that are used; the default adds nothing.
    fn provenance(&self, provenance: Provenance) -> Provenance {
        provenance
    }
}

/// A study of any kind.
impl Study for Box<dyn Study> {
    fn findings(&self, progress: &mut ProgressFn<'_>) -> Result<Findings, StudyError> {
        (**self).findings(progress)
    }

    fn provenance(&self, provenance: Provenance) -> Provenance {
        (**self).provenance(provenance)
    }
}
