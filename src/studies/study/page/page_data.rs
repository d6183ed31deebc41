//! The data of the page.

use serde::Serialize;

use super::arithmetic::Arithmetic;
use super::programs::PagePrograms;
use super::teapot::Teapot;
use crate::study::{ProgressFn, StudyError};

/// The data that the page's script reads, as JSON.
#[derive(Debug, Serialize)]
pub(super) struct PageData {
    /// Version of the program.
    pub(super) version: &'static str,
    arithmetic: Arithmetic,
    pub(super) teapot: Teapot,
    programs: PagePrograms,
}

impl PageData {
    /// Computes everything. `progress` is called with the name of each part before it starts.
    pub(super) fn compute(progress: &mut ProgressFn<'_>) -> Result<Self, StudyError> {
        progress("arithmetic", 0, 3);
        let arithmetic = Arithmetic::compute();
        progress("the teapot", 1, 3);
        let teapot = Teapot::compute()?;
        progress("programs", 2, 3);
        Ok(Self { version: env!("CARGO_PKG_VERSION"), arithmetic, teapot, programs: PagePrograms::compute()? })
    }
}
