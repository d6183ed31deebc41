//! All-frequency transfer: visibility of a model ([`SightOfModel`]), its transfer, compressed and coded segment by
//! segment ([`SegmentedCompression`]), its errors ([`coded_errors`]), and pictures of it ([`AllFrequencyRendering`]).

mod compress;
mod errors;
pub(super) mod exact;
mod lit_model;
mod part;
mod precompute;
mod render;
mod tally;

pub use compress::SegmentedCompression;
pub use errors::{CodedErrors, coded_errors};
pub use lit_model::{LitGround, LitModel};
pub(super) use part::{FrameTimes, Part, singles};
pub use precompute::{FoundSight, SightOfModel};
pub use render::AllFrequencyRendering;
pub use tally::{CompressionTally, SegmentTally};
