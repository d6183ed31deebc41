//! Bi-scale transfer on an emulated card: a picture with its errors and its times, and number formats, varied one after
//! the other.

mod picture;
mod precision;
mod report;
mod subject;

pub use subject::BiScaleOnCard;
