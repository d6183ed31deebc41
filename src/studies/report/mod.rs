//! Findings of a study, in the forms that people and programs read.
//!
//! [`Findings`] are text, tables, charts, pictures, files and a verdict; they are encoded as a page (one self-contained
//! HTML file), CSV, a JSON document, SVG, PNG and EXR. All functions return bytes; the caller writes whole files
//! through `io`.

mod cell;
mod chart;
pub mod digits;
mod excerpt;
pub mod false_color;
mod findings;
pub mod layout;
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

pub use self::cell::{Cell, Figure, Folded};
pub use self::chart::{Chart, Scale, Series};
pub use self::excerpt::{Excerpt, quoted_line};
pub use self::findings::{Findings, FoundTable, Legend, NamedChart, NamedFile, NamedPicture, Verdict};
pub(crate) use page::sheet as page_style;
pub use provenance::{Provenance, sha256};
pub use source_text::SourceText;
pub use summary::{SummaryLine, TallyEntry, Tone};
pub use table::Table;

use std::fmt::Display;

use crate::error::{InputError, input_error};

/// Error of an encoder of `CSV`, `JSON` or `SVG`.
pub(crate) fn not_encoded(format: &str, reason: impl Display) -> InputError {
    input_error!("crossbar::report::encode" => "the {format} file cannot be encoded: {reason}")
}
