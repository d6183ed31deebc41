//! Bi-scale transfer on an emulated card: a picture with its errors and its times, and one thing after the other held
//! in fewer bits.

mod picture;
mod precision;
mod report;
mod subject;

pub use subject::{BiScaleCardStudyError, BiScaleOnCard};
