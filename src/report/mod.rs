//! Rows and pictures in the forms that people and programs read.
//!
//! A [`Table`] goes out as text, CSV, JSON or HTML; a [`Chart`] as SVG; a [`picture`] as PNG, or as EXR where the numbers matter; a
//! [`Page`] is one HTML file with everything inside it. Everything here makes bytes: who calls it writes them, whole
//! files at a time, through `io::atomic`.

mod chart;
mod excerpt;
mod exr;
mod page;
pub mod picture;
mod provenance;
mod source_text;
mod table;
pub mod trace;
pub mod visible;

pub use self::chart::{Chart, Line, Scale};
pub use self::excerpt::{Excerpt, quoted_line};
pub use self::exr::{Channel, exr};
pub use page::{Figure, Page};
pub use provenance::Provenance;
pub use source_text::SourceText;
pub use table::{Cell, Table};

/// A picture or table that cannot be encoded.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum ReportError {
    /// The number of samples does not fit the picture's size.
    #[error("expected {expected} samples for a picture of {width}x{height}, found {found}")]
    #[diagnostic(code(crossbar::report::samples))]
    Samples {
        /// Pixels a row.
        width: usize,
        /// Rows.
        height: usize,
        /// Samples that a picture of this size has.
        expected: usize,
        /// Samples given.
        found: usize,
    },
    /// The encoder refused.
    #[error("the {format} file cannot be encoded: {reason}")]
    #[diagnostic(code(crossbar::report::encode))]
    Encode {
        /// `PNG`, `EXR`, `CSV`, `JSON` or `SVG`.
        format: &'static str,
        /// What the encoder said.
        reason: String,
    },
}

impl ReportError {
    fn encode(format: &'static str) -> impl FnOnce(&dyn std::fmt::Display) -> Self {
        move |reason| Self::Encode { format, reason: reason.to_string() }
    }
}

/// `found` samples must fill `width` by `height` pixels of `channels` samples each.
fn expect_samples(width: usize, height: usize, channels: usize, found: usize) -> Result<(), ReportError> {
    let expected = width.checked_mul(height).and_then(|pixels| pixels.checked_mul(channels)).unwrap_or(usize::MAX);
    if found == expected && expected > 0 {
        return Ok(());
    }
    Err(ReportError::Samples { width, height, expected, found })
}
