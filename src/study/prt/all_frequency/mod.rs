//! All-frequency transfer: visibility of a model ([`SightOfModel`]), its transfer segment by segment through
//! compression and coding ([`SegmentedCompression`]), how far that is off ([`coded_errors`]), and pictures of it
//! ([`AllFrequencyRendering`]).

mod compress;
mod errors;
mod exact;
mod precompute;
mod render;

pub use compress::{CompressionTally, SegmentTally, SegmentedCompression, SegmentedError};
pub use errors::{CodedErrors, coded_errors};
pub use precompute::SightOfModel;
pub use render::{AllFrequencyError, AllFrequencyRendering};
