//! The page that compares a visitor's GPU with the emulator: one HTML file that runs the number library's shaders in
//! WebGPU and holds their results against those of [`refsim::num`] and of the batch executor, which it carries.
//!
//! docs/page.md describes what it shows. The script of the page is in `assets`.

mod arithmetic;
mod encode;
mod markup;
mod operands;
mod page_data;
mod teapot;

use self::page_data::PageData;
use crate::report::ReportError;
use crate::study::{ProgressFn, StudyError};

/// Renders the page as one self-contained HTML file. `progress` is called with the name of each part before it starts.
///
/// # Errors
/// If the card refuses the pictures, or a picture cannot be encoded.
pub fn page(progress: &mut ProgressFn<'_>) -> Result<String, StudyError> {
    let data = PageData::compute(progress)?;
    let json = serde_json::to_string(&data)
        .map_err(|error| ReportError::Encode { format: "JSON", reason: error.to_string() })?;
    Ok(markup::html(&data, &json))
}
