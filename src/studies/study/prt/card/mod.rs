//! Compressed transfer drawn by an emulated card: how far its pictures are off, by what, and how long a frame takes.
//! [`OnCard`] is about transfer of low frequency, [`AllFrequencyOnCard`] of all frequencies, [`BiScaleOnCard`] about
//! bi-scale transfer.

mod bi_scale;
mod difference;
mod factored;
mod frame;
mod picture;
mod precision;
mod report;
mod subject;
mod tables;

pub use bi_scale::{BiScaleCardStudyError, BiScaleOnCard};
pub use difference::PixelErrors;
pub use factored::{
    AllFrequencyCardError, AllFrequencyOnCard, FactoredPrecision, factored_precision, factored_precision_table,
};
pub use subject::{CardError, OnCard};
