//! All-frequency transfer: transfer compressed and coded segment by segment ([`SegmentedCompression`]), and pictures of
//! it ([`LitModel`]).

mod compress;
mod model;
mod render;

pub use compress::{SegmentTally, SegmentedCompression};
pub(super) use model::singles;
pub use model::{LitModel, LitPart};
