//! Clustered principal components on an emulated card: a picture with its errors and its time, and number formats, maps
//! and targets, varied one after the other.

mod picture;
mod precision;
mod report;
mod subject;
mod tables;

pub use subject::OnCard;
