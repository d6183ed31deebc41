//! Findings of a study, in the forms that people and programs read.
//!
//! [`Findings`] are text, tables, charts, pictures, files and a verdict; they are encoded as a page (one self-contained
//! HTML file), CSV, a JSON document, SVG, PNG and EXR. All functions return bytes; the caller writes whole files
//! through `io::atomic`.

mod cell;
mod chart;
pub mod digits;
mod downscale;
mod excerpt;
pub mod false_color;
mod findings;
mod fold;
pub mod layout;
mod named_picture;
mod page;
pub mod palette;
mod provenance;
mod source_text;
mod summary;
mod table;
pub mod trace;
pub mod visible;
pub mod words;
mod write;

pub use self::cell::{Cell, Figure};
pub use self::chart::{Chart, Scale, Series};
pub use self::excerpt::{Excerpt, quoted_line};
pub use self::findings::{Findings, FoundTable, Legend, NamedChart, NamedFile, Verdict};
pub use self::fold::Folded;
pub use named_picture::NamedPicture;
pub(crate) use page::sheet as page_style;
pub use provenance::{Provenance, sha256};
pub use source_text::SourceText;
pub use summary::{SummaryLine, TallyEntry, Tone};
pub use table::Table;

use crate::error::InputError;

/// Error of encoding a table, chart or picture.
#[non_exhaustive]
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum ReportError {
    /// A picture cannot be encoded.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Picture(#[from] InputError),
    /// The encoder of `CSV`, `JSON` or `SVG` failed.
    #[error("the {format} file cannot be encoded: {reason}")]
    #[diagnostic(code(crossbar::report::encode))]
    Encode { format: &'static str, reason: String },
}

impl ReportError {
    fn encode(format: &'static str) -> impl FnOnce(&dyn std::fmt::Display) -> Self {
        move |reason| Self::Encode { format, reason: reason.to_string() }
    }
}
